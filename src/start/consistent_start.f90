!> A start that fulfils the constraints: positions by Newton's iteration, velocities in one step.
!>
!> Each correction is the least one, with lengths measured in sizes of the bodies and angles in
!> radians: the bodies stay as near to where the deck puts them as the joints let them.
!> Phi_q dq = -Phi until Phi is at round-off;  Phi_q dv = -(Phi_q v + Phi_t).
!> Velocities that the deck leaves out give way before those that it gives.
!> Rank and least-norm solutions come from singular values (LAPACK dgelsd), dependent rows from a
!> column-pivoted QR factorisation of Phi_q^T (dgeqp3); both of `sparse_start` where there are many rows.
!> Source: Flores et al. (2008), section 2.2, eqs. (2.10), (2.13). Limits: a position near the start
!> that the deck gives.
module consistent_start
   use branches, only: check_branches
   use errors, only: error_t, exit_assembly, set_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use lapack, only: dgelsd, dgeqp3, dtrtrs
   use linkage, only: linkage_t
   use sparse_start, only: new_sparse_start, sparse_start_t
   use text, only: real_text, to_text
   implicit none (type, external)
   private
   public :: assemble, assembly_t, choose_dependent, find_dependent
   public :: evaluate_rows, least_correction, limit_step, rank_tolerance, rates, scaled_jacobian, worst_violation

   real(wp), parameter :: rank_tolerance = 1.0e-9_wp    !! least ratio of singular values [1]
   real(wp), parameter :: share = 1.0e-6_wp             !! least part of a scaled row in a combination that vanishes [1]
   real(wp), parameter :: agreed = 1.0e-8_wp            !! greatest rate left over of consistent velocities, of the rates [1]
   real(wp), parameter :: closed = 1.0e-10_wp           !! greatest scaled violation of an assembled mechanism [1]
   real(wp), parameter :: round_off = 1.0e-15_wp        !! scaled violation at which Newton stops early [1]
   real(wp), parameter :: give_way = 1.0e4_wp           !! how much easier a velocity changes that is not given [1]
   integer, parameter :: n_newton = 50                  !! corrections of positions allowed
   integer, parameter :: few_rows = 400                 !! rows up to which matrices are dense

   !> How an assembly went.
   type :: assembly_t
      integer :: rank = 0                        !! independent constraint rows
      integer :: corrections = 0                 !! Newton corrections made
      real(wp) :: moved = 0.0_wp                 !! greatest change of a coordinate, angles times the size of the bodies [m]
      real(wp) :: residual = 0.0_wp              !! greatest violation left [m or rad]
      real(wp) :: rate_changed = 0.0_wp          !! greatest change of a given velocity, angles times the size of the bodies [m/s]
      integer :: changed_body = 0                !! the body it belongs to
      integer, allocatable :: dependent(:)       !! rows that depend on others
      integer, allocatable :: shared(:)          !! rows, those among them, whose multipliers are not unique
   end type assembly_t

contains

   !> Make positions and velocities consistent with the constraints at t = 0.
   subroutine assemble(linkage, q, v, report, error, is_sparse)
      type(linkage_t), intent(inout) :: linkage          !! all joints ideal
      real(wp), intent(inout) :: q(:)                    !! (n_q bodies) coordinates [any]
      real(wp), intent(inout) :: v(:)                    !! (n_v bodies) their rates [m/s or rad/s]
      type(assembly_t), intent(out) :: report            !! how it went
      type(error_t), allocatable, intent(out) :: error   !! cannot be assembled, names the worst joint
      logical, intent(in), optional :: is_sparse         !! whether matrices are sparse; absent: where there are many rows

      type(sparse_start_t) :: sparse
      logical :: with_sparse
      real(wp) :: largest
      real(wp), allocatable :: correction(:), ease(:), q_given(:), right(:), v_given(:)
      integer :: k, n

      n = size(v)
      allocate (report%dependent(0), report%shared(0))
      if (linkage%rows%n == 0) return
      allocate (correction(n), right(linkage%rows%n))
      allocate (ease(n), source=1.0_wp)
      with_sparse = wants_sparse(linkage, is_sparse)
      if (with_sparse) call new_sparse_start(linkage%bodies%n, linkage%rows, sparse)
      q_given = q
      call close_positions()
      if (allocated(error)) return
      call evaluate_rows(linkage, 0.0_wp, q, v)
      report%residual = maxval(abs(linkage%rows%phi))
      call linkage%coordinates%difference(linkage%bodies%n, q_given, q, correction)
      report%moved = maxval(abs(correction)*coordinate_scale(linkage))
      if (.not. worst_violation(linkage) <= closed) then
         call position_error(linkage, q_given, v, error)
         return
      end if
      call check_branches(linkage, error)
      if (allocated(error)) return
      call check_finite(linkage, linkage%rows%phi_t, error)
      if (allocated(error)) return
      ease = merge(1.0_wp, give_way, reshape(linkage%bodies%is_rate_given, [n]))
      v_given = v
      do k = 1, merge(1, 2, with_sparse)  ! the second takes away the round-off of the first, as refinement does
         call rates(linkage, v, right)
         call correct(-right)
         v = v + correction
      end do
      correction = merge(abs(v - v_given)*coordinate_scale(linkage), 0.0_wp, ease <= 1.0_wp)
      report%rate_changed = maxval(correction)
      report%changed_body = (maxloc(correction, dim=1) - 1)/linkage%coordinates%n_v + 1
      call rates(linkage, v, right)
      largest = maxval(max(abs(v), abs(v_given))*coordinate_scale(linkage))  ! where nothing is left free v is round-off alone
      if (maxval(abs(right)*linkage%solution%row_weight) > agreed*(largest &
                                                          + maxval(abs(linkage%rows%phi_t)*linkage%solution%row_weight))) then
         call velocity_error(linkage, right, error)
      end if

   contains

      !> Newton's iteration on the positions, until round-off or no longer better.
      subroutine close_positions()
         real(wp) :: before, now
         integer :: i

         before = huge(1.0_wp)
         do i = 1, n_newton
            call evaluate_rows(linkage, 0.0_wp, q, v)
            call check_finite(linkage, linkage%rows%phi, error)
            if (allocated(error)) return
            now = worst_violation(linkage)
            if (now <= round_off .or. (now <= closed .and. now >= 0.5_wp*before)) exit
            before = now
            call correct(-linkage%rows%phi)
            call linkage%coordinates%add_change(linkage%bodies%n, limit_step(linkage, correction), q)
            report%corrections = i
         end do
      end subroutine close_positions

      !> The least change of positions or velocities.
      subroutine correct(change)
         real(wp), intent(in) :: change(:)  !! (rows) what the rows should change by [m or rad, or rates]

         if (with_sparse) then
            call sparse%correct(linkage%rows%jac, weights(linkage, ease), change, correction, report%rank)
         else
            call least_correction(linkage, change, ease, correction, report%rank)
         end if
      end subroutine correct

   end subroutine assemble

   !> Whether matrices are sparse.
   pure logical function wants_sparse(linkage, is_sparse)
      type(linkage_t), intent(in) :: linkage  !! the bodies and their rows
      logical, intent(in), optional :: is_sparse    !! what the caller wants; absent: sparse where there are many rows

      wants_sparse = linkage%rows%n > few_rows
      if (present(is_sparse)) wants_sparse = is_sparse
   end function wants_sparse

   !> Squares of how much each coordinate may change, for lengths in sizes of the bodies; nothing for the ground.
   pure function weights(linkage, ease) result(weight)
      type(linkage_t), intent(in) :: linkage                           !! the bodies and their rows
      real(wp), intent(in) :: ease(:)                                  !! (n_v bodies) how easily each coordinate changes [1]
      real(wp) :: weight(linkage%coordinates%n_v, 0:linkage%bodies%n)  !! (n_v, 0:bodies) weights [m^2 or 1]

      associate (coordinates => linkage%coordinates, n => linkage%bodies%n)
         weight(:, 0) = 0.0_wp
         weight(:, 1:) = reshape(ease**2*coordinates%scales(linkage%scales%length**2, n), [coordinates%n_v, n])
      end associate
   end function weights

   !> Rows at a state, without accelerations.
   subroutine evaluate_rows(linkage, t, q, v)
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) coordinates [any]
      real(wp), intent(in) :: v(:)                     !! (n_v bodies) their rates [m/s or rad/s]

      integer :: k

      call linkage%place_bodies(q, v)
      linkage%motion%t = t
      do k = 1, size(linkage%joints)
         call linkage%joints(k)%set%evaluate(linkage%piece%inside(t), linkage%motion, linkage%rows)
      end do
      do k = 1, size(linkage%ideal)
         call linkage%ideal(k)%set%evaluate(linkage%piece%inside(t), linkage%motion, linkage%rows)
      end do
   end subroutine evaluate_rows

   !> Rates of the violations, Phi_q v + Phi_t.
   subroutine rates(linkage, v, right)
      type(linkage_t), intent(in) :: linkage        !! the bodies and their rows, rows evaluated
      real(wp), intent(in) :: v(:)                  !! (n_v bodies) rates of the coordinates [m/s or rad/s]
      real(wp), intent(out) :: right(:)             !! (rows) rates of the violations [m/s or rad/s]

      integer :: body, row, side

      associate (rows => linkage%rows, n_v => linkage%coordinates%n_v)
         do row = 1, rows%n
            right(row) = rows%phi_t(row)
            do side = 1, 2
               body = rows%body(side, row)
               if (body == 0) cycle
               right(row) = right(row) + dot_product(rows%jac(n_v*(side - 1) + 1:n_v*side, row), v(n_v*(body - 1) + 1:n_v*body))
            end do
         end do
      end associate
   end subroutine rates

   !> One for lengths, the size of the bodies for angles.
   function coordinate_scale(linkage) result(scale)
      type(linkage_t), intent(in) :: linkage                         !! the bodies and their rows
      real(wp) :: scale(linkage%coordinates%n_v*linkage%bodies%n)    !! (n_v bodies) scales [1 or m]

      scale = linkage%coordinates%change_scales(linkage%scales%length, linkage%bodies%n)
   end function coordinate_scale

   !> Greatest scaled violation.
   real(wp) function worst_violation(linkage) result(worst)
      type(linkage_t), intent(in) :: linkage  !! the bodies and their rows, rows evaluated

      worst = maxval(abs(linkage%rows%phi)*linkage%solution%row_weight)
   end function worst_violation

   !> The scaled Jacobian: rows in sizes or radians, columns per size or radian.
   subroutine scaled_jacobian(linkage, jac)
      type(linkage_t), intent(in) :: linkage           !! the system, rows evaluated
      real(wp), allocatable, intent(out) :: jac(:, :)  !! (rows, n_v bodies) scaled Jacobian [1]

      real(wp) :: column_scale(linkage%coordinates%n_v)
      integer :: body, row, side

      associate (rows => linkage%rows, n_v => linkage%coordinates%n_v)
         allocate (jac(rows%n, n_v*linkage%bodies%n), source=0.0_wp)
         column_scale = linkage%coordinates%scales(linkage%scales%length, 1)
         do row = 1, rows%n
            do side = 1, 2
               body = rows%body(side, row)
               if (body == 0) cycle
               associate (part => jac(row, n_v*(body - 1) + 1:n_v*body))
                  part = part + rows%jac(n_v*(side - 1) + 1:n_v*side, row)*linkage%solution%row_weight(row)*column_scale
               end associate
            end do
         end do
      end associate
   end subroutine scaled_jacobian

   !> Least change x of the coordinates (or rates) with Phi_q x = right, in the scaled norm of x / ease.
   subroutine least_correction(linkage, right, ease, x, rank, tolerance)
      type(linkage_t), intent(in) :: linkage        !! the bodies and their rows, rows evaluated
      real(wp), intent(in) :: right(:)              !! (rows) what the rows should change by [m or rad, or rates]
      real(wp), intent(in) :: ease(:)               !! (n_v bodies) how easily each of them changes [1]
      real(wp), intent(out) :: x(:)                 !! (n_v bodies) change [m or rad, or rates]
      integer, intent(out) :: rank                  !! independent rows
      real(wp), intent(in), optional :: tolerance   !! least ratio of singular values of theirs, if another than usual [1]

      real(wp), allocatable :: b(:, :), jac(:, :), s(:), work(:)
      real(wp) :: least
      integer, allocatable :: iwork(:)
      integer :: info, k, length, m, n

      least = rank_tolerance
      if (present(tolerance)) least = tolerance
      m = linkage%rows%n
      n = size(x)
      call scaled_jacobian(linkage, jac)
      do k = 1, n
         jac(:, k) = jac(:, k)*ease(k)
      end do
      allocate (b(max(m, n), 1), s(min(m, n)), work(1), source=0.0_wp)
      allocate (iwork(max(1, 40*min(m, n))), source=0)
      b(1:m, 1) = right*linkage%solution%row_weight
      call dgelsd(m, n, 1, jac, m, b, max(m, n), s, least, rank, work, -1, iwork, info)
      length = int(work(1))
      deallocate (work)
      allocate (work(length), source=0.0_wp)
      call dgelsd(m, n, 1, jac, m, b, max(m, n), s, least, rank, work, size(work), iwork, info)
      x = b(1:n, 1)*ease*linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n)
   end subroutine least_correction

   !> A correction cut so that no body turns by more than a third of a radian.
   pure function limit_step(linkage, x) result(limited)
      type(linkage_t), intent(in) :: linkage        !! the bodies and their rows
      real(wp), intent(in), contiguous :: x(:)      !! (n_v bodies) correction [m or rad]
      real(wp) :: limited(size(x))                  !! (n_v bodies) the same or shorter [m or rad]

      real(wp), parameter :: longest_turn = 1.0_wp/3.0_wp  ! of a body in one correction [rad]

      limited = x*min(1.0_wp, longest_turn/max(linkage%coordinates%greatest_turn(linkage%bodies%n, x), longest_turn))
   end function limit_step

   !> Rows that depend on others at an assembled position: `choose_dependent` there.
   subroutine find_dependent(linkage, q, v, report)
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) coordinates [any]
      real(wp), intent(in) :: v(:)                     !! (n_v bodies) their rates [m/s or rad/s]
      type(assembly_t), intent(inout) :: report        !! rank and dependent rows are set

      if (linkage%rows%n > 0) call evaluate_rows(linkage, 0.0_wp, q, v)
      call choose_dependent(linkage, report)
   end subroutine find_dependent

   !> Rows, as evaluated, that depend on others, and all rows whose multipliers are therefore not unique: those that
   !> occur in a combination of rows that vanishes, Phi_q^T x = 0. From the factors R = [ R_1, R_2; 0, 0 ] of the rows in the
   !> order of their pivots, x = ( -R_1^-1 R_2, 1 ).
   subroutine choose_dependent(linkage, report, is_sparse)
      type(linkage_t), intent(in) :: linkage           !! the bodies and their rows
      type(assembly_t), intent(inout) :: report        !! rank and dependent rows are set
      logical, intent(in), optional :: is_sparse       !! whether matrices are sparse; absent: where there are many rows

      type(sparse_start_t) :: sparse
      real(wp), allocatable :: ease(:), jac(:, :), tau(:), transposed(:, :), work(:)
      integer, allocatable :: order(:)
      logical, allocatable :: is_shared(:)
      integer :: info, k, m, n

      report%dependent = [integer ::]
      report%shared = [integer ::]
      if (linkage%rows%n == 0) return
      if (wants_sparse(linkage, is_sparse)) then
         call new_sparse_start(linkage%bodies%n, linkage%rows, sparse)
         allocate (ease(linkage%coordinates%n_v*linkage%bodies%n), source=1.0_wp)
         call sparse%find_dependent(linkage%rows%jac, weights(linkage, ease), linkage%solution%row_weight, share, &
                                    report%dependent, report%shared)
         report%rank = linkage%rows%n - size(report%dependent)
         return
      end if
      call scaled_jacobian(linkage, jac)
      transposed = transpose(jac)
      n = size(transposed, 1)
      m = size(transposed, 2)
      allocate (order(m), source=0)
      allocate (tau(min(m, n)), work(max(1, 64*(m + 1))), source=0.0_wp)
      call dgeqp3(n, m, transposed, n, order, tau, work, size(work), info)
      report%rank = 0
      do k = 1, min(m, n)
         if (abs(transposed(k, k)) > rank_tolerance*abs(transposed(1, 1))) report%rank = k
      end do
      report%dependent = order(report%rank + 1:m)
      if (report%rank == m) return
      call dtrtrs("U", "N", "N", report%rank, m - report%rank, transposed, n, transposed(:, report%rank + 1:), n, info)
      allocate (is_shared(m), source=.true.)
      is_shared(order(:report%rank)) = any(abs(transposed(:report%rank, report%rank + 1:)) > share, dim=2)
      report%shared = pack([(k, k=1, m)], is_shared)
   end subroutine choose_dependent

   !> The mechanism does not close: say where and by how much. A joint whose axes no small turn brings nearer where the deck puts
   !> the bodies is to blame, whichever joint is torn where the search ended: from there on the corrections are as good as chance.
   subroutine position_error(linkage, q, v, error)
      type(linkage_t), intent(inout) :: linkage          !! the system, rows evaluated where the search ended
      real(wp), intent(in) :: q(:)                       !! (n_q bodies) coordinates of the deck [any]
      real(wp), intent(in) :: v(:)                       !! (n_v bodies) rates [m/s or rad/s]
      type(error_t), allocatable, intent(out) :: error   !! the message

      character(:), allocatable :: hint, place
      real(wp) :: open
      integer :: dead, row

      row = maxloc(abs(linkage%rows%phi)*linkage%solution%row_weight, dim=1)
      open = abs(linkage%rows%phi(row))
      place = "stays open"
      call evaluate_rows(linkage, 0.0_wp, q, v)
      dead = dead_row(linkage)
      if (dead > 0) then
         row = dead
         open = abs(linkage%rows%phi(row))
         place = "is open where the deck puts its bodies,"
         hint = "its axes stand at right angles where they should be parallel, or the other way round, and nothing tells "// &
                "which way to turn"//new_line("a")//"  = give other axes, or turn one of its bodies in the deck"
      else
         hint = "the bodies were moved as little as possible from where the deck puts them, without success"//new_line("a")// &
                "  = check the points of this joint, the lengths of the loop, and the start positions"
      end if
      call set_error(error, exit_assembly, "the mechanism cannot be assembled: joint '"//linkage%row_name(row)// &
                     "' "//place//" by "//real_text(open, 4)// &
                     trim(merge(" rad", " m  ", linkage%rows%is_angle(row)))//new_line("a")//"  = "//hint)
   end subroutine position_error

   !> The row between axes, far from zero, that small turns help least; 0: they help all. Of axes with an angle theta between them
   !> it is cos(theta), which changes by sin(theta) with it.
   pure integer function dead_row(linkage) result(row)
      type(linkage_t), intent(in) :: linkage     !! the system, rows evaluated

      real(wp), parameter :: far = 0.5_wp        ! least violation of such a row [1]
      real(wp), parameter :: dead = 0.05_wp      ! greatest entry, of the violation, of a row that small turns hardly help [1]
      real(wp) :: help, least
      integer :: k

      row = 0
      least = dead
      do k = 1, linkage%rows%n
         if (.not. (linkage%rows%is_angle(k) .and. abs(linkage%rows%phi(k)) > far)) cycle
         help = maxval(abs(linkage%rows%jac(:, k)))/abs(linkage%rows%phi(k))
         if (help >= least) cycle
         row = k
         least = help
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
      call set_error(error, exit_assembly, "the start cannot be found: '"//linkage%row_name(row)// &
                     "' or its rate is not a finite number at t = 0"//new_line("a")// &
                     "  = look for a driver that begins with an infinite speed")
   end subroutine check_finite

   !> The velocities contradict each other.
   subroutine velocity_error(linkage, right, error)
      type(linkage_t), intent(in) :: linkage             !! the system
      real(wp), intent(in) :: right(:)                   !! (rows) rates of the violations left [m/s or rad/s]
      type(error_t), allocatable, intent(out) :: error   !! the message

      real(wp), parameter :: guilty = 0.1_wp  ! least share of the greatest residual of a row that is named too [1]
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
      if (len(others) > 0) others = new_line("a")//"  = against it stand "//others(3:)
      call set_error(error, exit_assembly, "no velocities fulfil the constraints: joint or driver '"// &
                     linkage%row_name(row)//"' is left with "//to_text(abs(right(row)))// &
                     trim(merge(" rad/s", " m/s  ", linkage%rows%is_angle(row)))//others//new_line("a")// &
                     "  = two drivers or initial speeds may contradict each other, or the mechanism is in a dead point that a "// &
                     "driver wants to pass")
   end subroutine velocity_error

end module consistent_start
