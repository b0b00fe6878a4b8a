!> What is said of a mechanism that cannot be assembled: where, by how much, and what may be the matter.
module start_errors
   use assembly_report, only: assembly_t
   use closing_fit, only: between, misfit_words
   use errors, only: error_t, exit_assembly, set_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: pi, wp
   use linkage, only: linkage_t
   use mobility, only: drives
   use row_corrections, only: evaluate_rows
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: check_finite, name_misfit, position_error, velocity_error

contains

   !> The mechanism does not close: say where and by how much. A joint whose axes no small turn brings nearer where the deck puts
   !> the bodies is to blame, whichever joint is torn where the search ended: from there on the corrections are as good as chance.
   subroutine position_error(linkage, q, v, misfit, error)
      type(linkage_t), intent(inout) :: linkage          !! the system, rows evaluated where the search ended
      real(wp), intent(in) :: q(:)                       !! (n_q bodies) coordinates of the deck [any]
      real(wp), intent(in) :: v(:)                       !! (n_v bodies) rates [m/s or rad/s]
      character(*), intent(in) :: misfit                 !! misfit in least squares; blank: not known
      type(error_t), allocatable, intent(out) :: error   !! the message

      character(:), allocatable :: given, hint, place
      real(wp) :: open
      integer :: dead, row
      logical :: is_alone

      row = maxloc(abs(linkage%rows%phi)*linkage%solution%row_weight, dim=1)
      open = abs(linkage%rows%phi(row))
      place = "has a residual of "
      call evaluate_rows(linkage, 0.0_wp, q, v)
      call find_open_joints(linkage, is_alone, given)
      dead = dead_row(linkage)
      if (dead > 0) then
         row = dead
         open = abs(linkage%rows%phi(row))
         place = "has, at the given positions of the bodies, a residual of "
         hint = "its axes"//between(linkage, row)//" are perpendicular but must be parallel, or vice versa: 90 deg off, so the "// &
                "direction of rotation is undetermined"//new_line("a")//"  = give other axes, or rotate one of its bodies in "// &
                "the deck"
      else if (is_alone) then
         call set_error(error, exit_assembly, "the mechanism cannot be assembled: at the given positions of the bodies "//given// &
                        ", all other joints are closed, and no positions nearby close all"//new_line("a")//"  = "//misfit// &
                        new_line("a")//"  = correct the axes of this joint, or the initial angles of its bodies")
         return
      else
         hint = "assembly moved the bodies as little as possible from the given positions and did not converge"//new_line("a")// &
                "  = check the points of this joint, the lengths of the loop, and the initial positions"
      end if
      if (dead == 0) hint = "at the given positions of the bodies "//given//new_line("a")//"  = "//hint
      if (misfit /= "" .and. dead == 0) hint = misfit//new_line("a")//"  = "//hint
      call set_error(error, exit_assembly, "the mechanism cannot be assembled: joint '"//linkage%row_name(row)// &
                     "' "//place//real_text(open, 4)// &
                     trim(merge(" rad", " m  ", linkage%rows%is_angle(row)))//new_line("a")//"  = "//hint)
   end subroutine position_error

   !> Joints that are open at the positions where rows were evaluated, and by how much the first of them.
   subroutine find_open_joints(linkage, is_alone, words)
      type(linkage_t), intent(in) :: linkage                !! the system, rows evaluated
      logical, intent(out) :: is_alone                      !! one joint is open, no driver, by an angle between its axes
      character(:), allocatable, intent(out) :: words       !! as "'q' between 'a' and 'b' is off by 0 mm and 0.573 deg"

      real(wp), parameter :: closed = 1.0e-9_wp  ! scaled violation [1]
      logical, dimension(linkage%rows%n) :: is_driver, is_open
      integer :: k, row

      is_driver = drives(linkage)
      is_open = abs(linkage%rows%phi)*linkage%solution%row_weight > closed
      row = findloc(is_open, .true., dim=1)
      is_alone = row > 0
      do k = 1, linkage%rows%n
         if (.not. is_open(k)) cycle
         is_alone = is_alone .and. linkage%rows%is_angle(k) .and. .not. is_driver(k) .and. &
                    linkage%row_name(k) == linkage%row_name(row)
      end do
      words = misfit_words(linkage, with_bodies=.true.)
   end subroutine find_open_joints

   !> Say by how much joints are off at positions of the minimum misfit.
   subroutine name_misfit(linkage, q, report)
      type(linkage_t), intent(inout) :: linkage          !! the system; rows are evaluated there
      real(wp), intent(in) :: q(:)                       !! (n_q bodies) these positions [any]
      type(assembly_t), intent(inout) :: report          !! its misfit is set

      call evaluate_rows(linkage, 0.0_wp, q, spread(0.0_wp, 1, size(linkage%mass)))
      report%misfit = "in the least-squares fit "//misfit_words(linkage)//"; allowed: closing_tolerance "// &
                      real_text(linkage%scales%misfit, 3)//", here "//real_text(1.0e3_wp*linkage%scales%misfit &
                      *linkage%scales%length, 3)//" mm and "//real_text(linkage%scales%misfit*180.0_wp/pi, 3)//" deg"
   end subroutine name_misfit

   !> The row between axes, far from zero, that small turns help minimum; 0: they help all. Of axes with an angle theta between them
   !> it is cos(theta), which changes by sin(theta) with it.
   pure integer function dead_row(linkage) result(row)
      type(linkage_t), intent(in) :: linkage     !! the system, rows evaluated

      real(wp), parameter :: far = 0.5_wp        ! minimum violation of such a row [1]
      real(wp), parameter :: dead = 0.05_wp      ! maximum entry, of the violation, of a row that small turns hardly help [1]
      real(wp) :: help, minimum
      integer :: k

      row = 0
      minimum = dead
      do k = 1, linkage%rows%n
         if (.not. (linkage%rows%is_angle(k) .and. abs(linkage%rows%phi(k)) > far)) cycle
         help = maxval(abs(linkage%rows%jac(:, k)))/abs(linkage%rows%phi(k))
         if (help >= minimum) cycle
         row = k
         minimum = help
      end do
   end function dead_row

   !> A driver that has no value or no rate at the start.
   subroutine check_finite(linkage, values, error)
      type(linkage_t), intent(in) :: linkage             !! the system
      real(wp), intent(in) :: values(:)                  !! (rows) of the rows [m or rad, or rates]
      type(error_t), allocatable, intent(out) :: error   !! one of them is not finite

      integer :: row

      row = findloc(ieee_is_finite(values), .false., dim=1)
      if (row == 0) return
      call set_error(error, exit_assembly, "no initial state exists: '"//linkage%row_name(row)// &
                     "', or its rate, is not finite at t = 0"//new_line("a")// &
                     "  = check for a driver with infinite initial speed")
   end subroutine check_finite

   !> The velocities contradict each other.
   subroutine velocity_error(linkage, right, error)
      type(linkage_t), intent(in) :: linkage             !! the system
      real(wp), intent(in) :: right(:)                   !! (rows) rates of the violations left [m/s or rad/s]
      type(error_t), allocatable, intent(out) :: error   !! the message

      real(wp), parameter :: guilty = 0.1_wp  ! minimum share of the maximum residual of a row that is named too [1]
      character(:), allocatable :: others
      real(wp) :: scaled(linkage%rows%n)
      integer :: k, row

      scaled = abs(right)*linkage%solution%row_weight
      row = maxloc(scaled, dim=1)
      others = ""
      do k = 1, linkage%rows%n
         if (scaled(k) < guilty*scaled(row) .or. linkage%row_name(k) == linkage%row_name(row)) cycle
         if (index(others//",", " '"//linkage%row_name(k)//"',") == 0) others = others//", '"//linkage%row_name(k)//"'"
      end do
      if (len(others) > 0) others = new_line("a")//"  = in conflict with "//others(3:)
      call set_error(error, exit_assembly, "no velocities satisfy the constraints: joint or driver '"// &
                     linkage%row_name(row)//"' has a residual of "//to_text(abs(right(row)))// &
                     trim(merge(" rad/s", " m/s  ", linkage%rows%is_angle(row)))//others//new_line("a")// &
                     "  = drivers or initial speeds contradict each other, or a driver acts at a dead centre of the mechanism")
   end subroutine velocity_error

end module start_errors
