!> The reactions that go with given accelerations.
!>
!> $$ \Phi_q^T \lambda = g - M a $$
!>
!> Signs: the reaction on a body is -Phi_q^T lambda, as in the equations of motion. Where rows are
!> redundant, lambda is the one of least norm, forces times the size of the bodies against moments.
!> What the rows cannot take stays unbalanced; its norm is returned.
!> Source: Flores et al. (2008), section 2.5, eq. (2.14). Limits: dense, by singular values
!> (LAPACK dgelsd).
module inverse_dynamics
   use kinds, only: wp
   use lapack, only: dgelsd
   use linkage, only: linkage_t
   use row_corrections, only: rank_tolerance, scaled_jacobian
   implicit none (type, external)
   private
   public :: find_reactions

contains

   !> Multipliers that go with accelerations, and what stays unbalanced. The motion takes the accelerations.
   subroutine find_reactions(linkage, g, a, unbalanced)
      type(linkage_t), intent(inout) :: linkage  !! the linkage, rows evaluated; lambda is set
      real(wp), intent(in) :: g(:, 0:)           !! (n_v, 0:bodies) loads on the rates [N or N.m]
      real(wp), intent(in), contiguous :: a(:)   !! (n_v bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(out) :: unbalanced        !! norm of g - M a - Phi_q^T lambda, forces times the size [N.m]

      real(wp), allocatable :: b(:, :), jac(:, :), rest(:), right(:), s(:), transposed(:, :), work(:)
      integer, allocatable :: iwork(:)
      integer :: info, k, length, m, n, rank

      m = linkage%rows%n
      n = size(a)
      call linkage%coordinates%accelerate(linkage%bodies%n, [(k, k=1, linkage%bodies%n)], a, linkage%motion)
      right = (reshape(g(:, 1:), [n]) - a*reshape(linkage%mass, [n]))*linkage%coordinates%scales(linkage%scales%length, &
                                                                                                 linkage%bodies%n)
      unbalanced = norm2(right)
      if (m == 0) return
      call scaled_jacobian(linkage, jac)
      transposed = transpose(jac)
      allocate (b(max(m, n), 1), s(min(m, n)), work(1), source=0.0_wp)
      allocate (iwork(max(1, 40*min(m, n))), source=0)
      b(1:n, 1) = right
      call dgelsd(n, m, 1, transposed, n, b, max(m, n), s, rank_tolerance, rank, work, -1, iwork, info)
      length = int(work(1))
      deallocate (work)
      allocate (work(length), source=0.0_wp)
      call dgelsd(n, m, 1, transposed, n, b, max(m, n), s, rank_tolerance, rank, work, length, iwork, info)
      rest = right - matmul(b(1:m, 1), jac)
      unbalanced = norm2(rest)
      linkage%solution%lambda = b(1:m, 1)*linkage%solution%row_weight
   end subroutine find_reactions

end module inverse_dynamics
