!> Assemblies at a position where rows lose rank and a motion that starts there cannot continue: shaky ones, and dead centres.
!>
!> See `second_order` for the test. A self-stress in which a driver takes part is a dead centre: the driver holds, or asks for, what
!> the mechanism cannot give there to first order.
!>
!> Source and limits: `second_order`; rows up to those whose matrices are dense.
module shaky
   use errors, only: error_t, exit_assembly, set_error
   use kinds, only: pi, wp
   use linkage, only: linkage_t
   use mobility, only: drives, find_mobility, joint_names, mobility_t, moving_bodies, split_space
   use row_corrections, only: evaluate_rows, scaled_jacobian, wants_sparse, worst_violation
   use second_order, only: find_definite, find_forms, most_free
   use text, only: real_text
   implicit none (type, external)
   private
   public :: dead_centre_line, find_dead_centre, find_shaky, name_dead_centre

   real(wp), parameter :: dependent = 1.0e-6_wp   !! singular value that counts as none: positions are known to its square [1]
   real(wp), parameter :: takes_part = 1.0e-3_wp  !! minimum part of a row in a self-stress [1]

contains

   !> Refuse an assembly whose joints make it infinitesimally mobile. Drivers are omitted: with them it is a dead centre.
   subroutine find_shaky(linkage, q, error)
      type(linkage_t), intent(inout) :: linkage          !! the bodies and their rows; evaluated at rest
      real(wp), intent(in) :: q(:)                       !! (n_q bodies) assembled positions [any]
      type(error_t), allocatable, intent(out) :: error   !! it is, and where

      real(wp), allocatable :: combination(:), form(:, :, :), free(:, :), held(:), modes(:, :), stress(:, :)
      character(:), allocatable :: joints, moving
      logical :: is_found

      call find_spaces(linkage, q, .false., free, stress)
      if (size(free, 2) == 0 .or. size(free, 2) > most_free .or. size(stress, 2) == 0) return
      call find_forms(linkage, q, free, stress, form)
      allocate (combination(size(stress, 2)))
      call find_definite(form, combination, modes, is_found)
      if (.not. is_found) return
      held = matmul(stress, combination)
      joints = joint_names(linkage, abs(held) > takes_part*maxval(abs(held)))
      moving = moving_bodies(linkage, moved_by(linkage, matmul(free, modes)))
      call set_error(error, exit_assembly, "the assembly is infinitesimally mobile (shaky): "//moving//" can start to move "// &
                     "here, but no finite motion exists"//new_line("a")//"  = rows of "//joints//" are linearly dependent "// &
                     "at this position and resist that motion only to second order: no finite reactions balance a load along it" &
                     //new_line("a")//"  = move these joints off their common line or plane, remove one of them, "// &
                     "or replace one by a spring or a bushing")
   end subroutine find_shaky

   !> Say whether drivers that seem to be in excess stand at a dead centre: what they prescribe, other rows prescribe here to first
   !> order only.
   subroutine name_dead_centre(linkage, q, is_excess, error)
      type(linkage_t), intent(inout) :: linkage          !! the bodies and their rows; evaluated at rest
      real(wp), intent(in) :: q(:)                       !! (n_q bodies) assembled positions [any]
      logical, intent(in) :: is_excess(:)                !! (rows) rows of such drivers
      type(error_t), allocatable, intent(out) :: error   !! they do

      real(wp), allocatable :: form(:, :, :), free(:, :), held(:, :), stress(:, :)
      logical, allocatable :: is_in(:)
      integer :: k, row

      call find_spaces(linkage, q, .true., free, stress)
      if (size(free, 2) == 0 .or. size(free, 2) > most_free .or. size(stress, 2) == 0) return
      do row = 1, size(is_excess)
         if (.not. is_excess(row)) cycle
         held = matmul(stress, reshape(stress(row, :), [size(stress, 2), 1]))  ! the self-stress that strains the driver most
         call find_forms(linkage, q, free, held, form)
         if (.not. maxval(abs(form)) > 0.0_wp) cycle
         is_in = abs(held(:, 1)) > takes_part*maxval(abs(held))
         call refuse_dead_centre(linkage, [(k == row, k=1, size(is_excess))], is_in, moved_by(linkage, free), error)
         return
      end do
   end subroutine name_dead_centre

   !> Say whether a driver stands at a dead centre, where no velocities satisfy the rows at positions that do.
   subroutine find_dead_centre(linkage, q, error)
      type(linkage_t), intent(inout) :: linkage            !! the bodies and their rows; evaluated at rest
      real(wp), intent(in) :: q(:)                         !! (n_q bodies) positions [any]
      type(error_t), allocatable, intent(inout) :: error   !! why it cannot start; replaced if it is a dead centre

      type(error_t), allocatable :: dead_centre
      type(mobility_t) :: mobility
      real(wp), parameter :: closed = 1.0e-10_wp  ! scaled violation [1]

      if (linkage%rows%n == 0 .or. wants_sparse(linkage)) return
      call evaluate_rows(linkage, 0.0_wp, q, spread(0.0_wp, 1, size(linkage%mass)))
      if (.not. worst_violation(linkage) <= closed) return
      call find_mobility(linkage, mobility)
      call name_dead_centre(linkage, q, mobility%is_excess, dead_centre)
      if (allocated(dead_centre)) call move_alloc(dead_centre, error)
   end subroutine find_dead_centre

   !> The loop that comes nearest to a dead centre, and how its bodies lie; blank if all rows are far from dependent.
   function dead_centre_line(linkage) result(words)
      type(linkage_t), intent(in) :: linkage    !! the bodies and their rows, evaluated
      character(:), allocatable :: words        !! a line of a message

      real(wp), parameter :: near = 0.01_wp     ! singular value, of the maximum, of a loop near a dead centre [1]
      real(wp), parameter :: shares = 0.05_wp   ! minimum part of a row or body in it, of the maximum [1]
      real(wp), allocatable :: free(:, :), jac(:, :), left(:, :), part(:)
      logical, allocatable :: is_driver(:)
      integer :: rank

      words = ""
      if (linkage%rows%n == 0 .or. wants_sparse(linkage)) return
      is_driver = drives(linkage)
      if (.not. any(is_driver)) return
      call scaled_jacobian(linkage, jac)
      call split_space(jac, rank, left, free, near)
      if (rank == linkage%rows%n) return
      associate (stress => abs(left(:, linkage%rows%n)))
         if (.not. any(is_driver .and. stress > shares*maxval(stress))) return
         part = moved_by(linkage, free)
         where (part < shares) part = 0.0_wp
         words = new_line("a")//"  = near a dead centre: the loop of "//joint_names(linkage, stress > shares*maxval(stress) .and. &
                 .not. is_driver)//" can hardly be moved there by driver "// &
                 joint_names(linkage, stress > shares*maxval(stress) .and. is_driver)//angles(linkage, part)
      end associate
   end function dead_centre_line

   !> Angles of bodies that take part in a motion, those of the plane.
   function angles(linkage, part) result(words)
      type(linkage_t), intent(in) :: linkage    !! the bodies, placed
      real(wp), intent(in) :: part(:)           !! (bodies) how much each moves [1]
      character(:), allocatable :: words        !! as `; angles: 'crank' 0 deg, 'rod' 0 deg`; blank in space

      integer :: k

      words = ""
      if (allocated(linkage%motion%spatial%p)) return
      do k = 1, size(part)
         if (.not. part(k) > 0.0_wp) cycle
         words = words//trim(merge("; angles:", ",        ", words == ""))//" '"//linkage%bodies%names(k)%s//"' "// &
                 real_text(atan2(linkage%motion%rot(2, 1, k), linkage%motion%rot(1, 1, k))*180.0_wp/pi, 4)//" deg"
      end do
   end function angles

   !> Free motions and self-stresses at a position.
   subroutine find_spaces(linkage, q, with_drivers, free, stress)
      type(linkage_t), intent(inout) :: linkage             !! the bodies and their rows; evaluated at rest
      real(wp), intent(in) :: q(:)                          !! (n_q bodies) positions [any]
      logical, intent(in) :: with_drivers                   !! rows of drivers take part
      real(wp), allocatable, intent(out) :: free(:, :)      !! (n_v bodies, any) scaled free motions [1]
      real(wp), allocatable, intent(out) :: stress(:, :)    !! (rows, any) self-stresses of the scaled rows [1]

      real(wp), allocatable :: jac(:, :), left(:, :)
      logical :: is_out(linkage%rows%n)
      integer :: k, rank

      allocate (free(0, 0), stress(0, 0))
      if (linkage%rows%n == 0 .or. wants_sparse(linkage)) return
      call evaluate_rows(linkage, 0.0_wp, q, spread(0.0_wp, 1, size(linkage%mass)))
      call scaled_jacobian(linkage, jac)
      is_out = .not. with_drivers .and. drives(linkage)
      do k = 1, size(jac, 2)
         where (is_out) jac(:, k) = 0.0_wp
      end do
      deallocate (free)
      call split_space(jac, rank, left, free, dependent)
      stress = left(:, rank + 1:)
      do k = 1, size(stress, 2)
         where (is_out) stress(:, k) = 0.0_wp
      end do
   end subroutine find_spaces

   !> How much each body takes part in some motions.
   pure function moved_by(linkage, motions) result(part)
      type(linkage_t), intent(in) :: linkage   !! the bodies
      real(wp), intent(in) :: motions(:, :)    !! (n_v bodies, any) scaled motions [1]
      real(wp) :: part(linkage%bodies%n)       !! (bodies) maximum part of each, of that of the body that moves most [1]

      integer :: k

      associate (n_v => linkage%coordinates%n_v)
         do k = 1, size(part)
            part(k) = maxval(norm2(motions(n_v*(k - 1) + 1:n_v*k, :), dim=1))
         end do
      end associate
      part = part/max(maxval(part), tiny(1.0_wp))
      where (part < takes_part) part = 0.0_wp
   end function moved_by

   !> A driver at a dead centre.
   subroutine refuse_dead_centre(linkage, is_driver, is_in, part, error)
      type(linkage_t), intent(in) :: linkage             !! the bodies and their rows, at the position
      logical, intent(in) :: is_driver(:)                !! (rows) rows of the driver
      logical, intent(in) :: is_in(:)                    !! (rows) rows that depend on one another
      real(wp), intent(in) :: part(:)                    !! (bodies) how much each can still move [1]
      type(error_t), allocatable, intent(out) :: error   !! the message

      call set_error(error, exit_assembly, "the mechanism is at a dead centre of driver "//joint_names(linkage, is_driver)// &
                     " at t = 0 s"//new_line("a")//"  = rows of "//joint_names(linkage, is_in .and. .not. is_driver)// &
                     " block the driver here, but "//moving_bodies(linkage, part)//" can move without it"//angles(linkage, part) &
                     //new_line("a")//"  = start some degrees away from the dead centre (initial angles in [bodies], driver to "// &
                     "match), or drive another joint of the loop")
   end subroutine refuse_dead_centre

end module shaky
