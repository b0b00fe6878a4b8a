!> Changes of the positions with the parameters: Phi_q dq = right for several right-hand sides with one factorisation.
!>
!> Singular values of the scaled Jacobian (lengths in sizes of the bodies, angles in radians); each solution is refined once.
!> Source: G. H. Golub, C. F. Van Loan, Matrix Computations (2013), sections 2.4 and 5.5.
module tangents
   use kinds, only: wp
   use lapack, only: dgesvd
   use linkage, only: linkage_t
   use row_corrections, only: rank_tolerance, rates, scaled_jacobian
   implicit none (type, external)
   private
   public :: solve_tangents

contains

   !> Changes of the positions that change the rows as requested.
   subroutine solve_tangents(linkage, right, x, is_regular)
      type(linkage_t), intent(in) :: linkage       !! the bodies and their rows, evaluated
      real(wp), intent(in) :: right(:, :)          !! (rows, sides) what the rows should change by [m or rad]
      real(wp), intent(out) :: x(:, :)             !! (n_v bodies, sides) changes [m or rad]
      logical, intent(out) :: is_regular           !! .false.: fewer independent rows than coordinates

      real(wp), allocatable :: jac(:, :), s(:), u(:, :), vt(:, :), work(:)
      real(wp) :: left(size(right, 1)), scale(size(x, 1))
      integer :: info, k, m, n, turn

      m = size(right, 1)
      n = size(x, 1)
      call scaled_jacobian(linkage, jac)
      scale = linkage%coordinates%scales(linkage%scales%length, linkage%bodies%n)
      allocate (s(min(m, n)), u(m, min(m, n)), vt(min(m, n), n), work(1), source=0.0_wp)
      call dgesvd("S", "S", m, n, jac, m, s, u, m, vt, min(m, n), work, -1, info)
      k = int(work(1))
      deallocate (work)
      allocate (work(k), source=0.0_wp)
      call dgesvd("S", "S", m, n, jac, m, s, u, m, vt, min(m, n), work, k, info)
      x = 0.0_wp
      is_regular = info == 0 .and. m >= n
      if (is_regular) is_regular = s(n) > rank_tolerance*s(1)
      if (.not. is_regular) return
      do k = 1, size(right, 2)
         left = right(:, k)
         do turn = 1, 2
            x(:, k) = x(:, k) + matmul(matmul(left*linkage%solution%row_weight, u)/s, vt)*scale
            call rates(linkage, x(:, k), left)
            left = right(:, k) - (left - linkage%rows%phi_t)
         end do
      end do
   end subroutine solve_tangents

end module tangents
