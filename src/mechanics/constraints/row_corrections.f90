!> Rows at a state, and the minimum change of coordinates or rates that changes them as requested.
!>
!> Lengths are measured in sizes of the bodies, angles in radians: Phi_q x = r with the minimum |x| in these measures. Rank and
!> least-norm solutions come from singular values (LAPACK dgelsd).
!> Source: Golub and Van Loan, Matrix Computations, section 5.5. Limits: dense; of many rows `sparse_start` finds the change.
module row_corrections
   use kinds, only: wp
   use lapack, only: dgelsd
   use linkage, only: linkage_t
   implicit none (type, external)
   private
   public :: change_weights, coordinate_scale, evaluate_rows, min_correction, limit_step, rank_tolerance, rates, &
      scaled_jacobian, wants_sparse, worst_violation

   real(wp), parameter :: rank_tolerance = 1.0e-9_wp    !! minimum ratio of singular values [1]
   integer, parameter :: few_rows = 400                 !! rows up to which matrices are dense

contains

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
         call linkage%joints(k)%set%evaluate(linkage%segment%inside(t), linkage%motion, linkage%rows)
      end do
      do k = 1, size(linkage%ideal)
         call linkage%ideal(k)%set%evaluate(linkage%segment%inside(t), linkage%motion, linkage%rows)
      end do
      if (size(linkage%solution%set_aside) > 0) call linkage%set_rows_aside()
   end subroutine evaluate_rows

   !> Rates of the violations, Phi_q v + Phi_t.
   subroutine rates(linkage, v, right)
      type(linkage_t), intent(in) :: linkage        !! the bodies and their rows, rows evaluated
      real(wp), intent(in) :: v(:)                  !! (n_v bodies) rates of the coordinates [m/s or rad/s]
      real(wp), intent(out) :: right(:)             !! (rows) rates of the violations [m/s or rad/s]

      integer :: block, body, row, side

      associate (rows => linkage%rows, n_v => linkage%coordinates%n_v)
         right(:rows%n) = rows%phi_t
         do block = 1, rows%n_block
            row = rows%owner(block)
            do side = 1, 2
               body = rows%body(side, block)
               if (body == 0) cycle
               right(row) = right(row) + dot_product(rows%jac(n_v*(side - 1) + 1:n_v*side, block), v(n_v*(body - 1) + 1:n_v*body))
            end do
         end do
      end associate
   end subroutine rates

   !> Maximum scaled violation.
   real(wp) function worst_violation(linkage) result(worst)
      type(linkage_t), intent(in) :: linkage  !! the bodies and their rows, rows evaluated

      worst = maxval(abs(linkage%rows%phi)*linkage%solution%row_weight)
   end function worst_violation

   !> The scaled Jacobian: rows in sizes or radians, columns per size or radian.
   subroutine scaled_jacobian(linkage, jac)
      type(linkage_t), intent(in) :: linkage           !! the system, rows evaluated
      real(wp), allocatable, intent(out) :: jac(:, :)  !! (rows, n_v bodies) scaled Jacobian [1]

      real(wp) :: column_scale(linkage%coordinates%n_v)
      integer :: block, body, row, side

      associate (rows => linkage%rows, n_v => linkage%coordinates%n_v)
         allocate (jac(rows%n, n_v*linkage%bodies%n), source=0.0_wp)
         column_scale = linkage%coordinates%scales(linkage%scales%length, 1)
         do block = 1, rows%n_block
            row = rows%owner(block)
            do side = 1, 2
               body = rows%body(side, block)
               if (body == 0) cycle
               associate (part => jac(row, n_v*(body - 1) + 1:n_v*body))
                  part = part + rows%jac(n_v*(side - 1) + 1:n_v*side, block)*linkage%solution%row_weight(row)*column_scale
               end associate
            end do
         end do
      end associate
   end subroutine scaled_jacobian

   !> Minimum change x of the coordinates (or rates) with Phi_q x = right, in the scaled norm of x / ease.
   subroutine min_correction(linkage, right, ease, x, rank, tolerance)
      type(linkage_t), intent(in) :: linkage        !! the bodies and their rows, rows evaluated
      real(wp), intent(in) :: right(:)              !! (rows) what the rows should change by [m or rad, or rates]
      real(wp), intent(in) :: ease(:)               !! (n_v bodies) how easily each of them changes [1]
      real(wp), intent(out) :: x(:)                 !! (n_v bodies) change [m or rad, or rates]
      integer, intent(out) :: rank                  !! independent rows
      real(wp), intent(in), optional :: tolerance   !! minimum ratio of singular values of theirs, if another than usual [1]

      real(wp), allocatable :: b(:, :), jac(:, :), s(:), work(:)
      real(wp) :: minimum
      integer, allocatable :: iwork(:)
      integer :: info, k, length, m, n

      minimum = rank_tolerance
      if (present(tolerance)) minimum = tolerance
      m = linkage%rows%n
      n = size(x)
      call scaled_jacobian(linkage, jac)
      do k = 1, n
         jac(:, k) = jac(:, k)*ease(k)
      end do
      allocate (b(max(m, n), 1), s(min(m, n)), work(1), source=0.0_wp)
      allocate (iwork(max(1, 40*min(m, n))), source=0)
      b(1:m, 1) = right*linkage%solution%row_weight
      call dgelsd(m, n, 1, jac, m, b, max(m, n), s, minimum, rank, work, -1, iwork, info)
      length = int(work(1))
      deallocate (work)
      allocate (work(length), source=0.0_wp)
      call dgelsd(m, n, 1, jac, m, b, max(m, n), s, minimum, rank, work, size(work), iwork, info)
      x = b(1:n, 1)*ease*linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n)
   end subroutine min_correction

   !> A correction cut so that no body turns by more than a third of a radian.
   pure function limit_step(linkage, x) result(limited)
      type(linkage_t), intent(in) :: linkage        !! the bodies and their rows
      real(wp), intent(in), contiguous :: x(:)      !! (n_v bodies) correction [m or rad]
      real(wp) :: limited(size(x))                  !! (n_v bodies) the same or shorter [m or rad]

      real(wp), parameter :: longest_turn = 1.0_wp/3.0_wp  ! of a body in one correction [rad]

      limited = x*min(1.0_wp, longest_turn/max(linkage%coordinates%max_turn(linkage%bodies%n, x), longest_turn))
   end function limit_step

   !> Squares of how much each coordinate may change, for lengths in sizes of the bodies; nothing for the ground.
   pure function change_weights(linkage, ease) result(weight)
      type(linkage_t), intent(in) :: linkage                           !! the bodies and their rows
      real(wp), intent(in) :: ease(:)                                  !! (n_v bodies) how easily each coordinate changes [1]
      real(wp) :: weight(linkage%coordinates%n_v, 0:linkage%bodies%n)  !! (n_v, 0:bodies) weights [m^2 or 1]

      associate (coordinates => linkage%coordinates, n => linkage%bodies%n)
         weight(:, 0) = 0.0_wp
         weight(:, 1:) = reshape(ease**2*coordinates%scales(linkage%scales%length**2, n), [coordinates%n_v, n])
      end associate
   end function change_weights

   !> One for lengths, the size of the bodies for angles.
   function coordinate_scale(linkage) result(scale)
      type(linkage_t), intent(in) :: linkage                         !! the bodies and their rows
      real(wp) :: scale(linkage%coordinates%n_v*linkage%bodies%n)    !! (n_v bodies) scales [1 or m]

      scale = linkage%coordinates%change_scales(linkage%scales%length, linkage%bodies%n)
   end function coordinate_scale

   !> Whether matrices are sparse.
   pure logical function wants_sparse(linkage, is_sparse)
      type(linkage_t), intent(in) :: linkage  !! the bodies and their rows
      logical, intent(in), optional :: is_sparse    !! what the caller needs; absent: sparse where there are many rows

      wants_sparse = linkage%rows%n > few_rows
      if (present(is_sparse)) wants_sparse = is_sparse
   end function wants_sparse

end module row_corrections
