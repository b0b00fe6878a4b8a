!> Loads at a state, and the reactions that go with given accelerations.
!>
!> $$ \Phi_q^T \lambda = g - M a $$
!>
!> Signs: the reaction on a body is -Phi_q^T lambda, as in the equations of motion. Where rows are
!> redundant, lambda is the one of least norm, forces times the size of the bodies against moments.
!> What the rows cannot take stays unbalanced; its norm is returned.
!> Source: Flores et al. (2008), section 2.5, eq. (2.14). Limits: dense, by singular values
!> (LAPACK dgelsd).
module inverse_dynamics
   use consistent_start, only: rank_tolerance, row_scale, scaled_jacobian
   use kinds, only: wp
   use lapack, only: dgelsd
   use motion, only: set_some_acceleration
   use planar_system, only: planar_system_t
   implicit none (type, external)
   private
   public :: find_loads, find_reactions

contains

   !> Loads of gravity, force elements and touching contacts at the present motion.
   subroutine find_loads(system, t)
      class(planar_system_t), intent(inout) :: system  !! the system, motion set; loads and g are set
      real(wp), intent(in) :: t                        !! time [s]

      integer :: k

      system%loads%force = system%weight
      system%loads%moment = 0.0_wp
      system%load_power = 0.0_wp
      do k = 1, size(system%forces)
         call system%forces(k)%set%evaluate(system%piece%inside(t), system%motion, system%loads, system%load_power)
      end do
      do k = 1, size(system%clearances)
         call system%clearances(k)%set%evaluate(system%motion, system%loads, system%losses)
      end do
      system%g(1:2, :) = system%loads%force(1:2, :)
      system%g(3, :) = system%loads%moment(3, :)
   end subroutine find_loads

   !> Multipliers that go with accelerations, and what stays unbalanced. The motion takes the accelerations.
   subroutine find_reactions(system, a, unbalanced)
      class(planar_system_t), intent(inout) :: system  !! the system, rows and loads evaluated; lambda is set
      real(wp), intent(in), contiguous :: a(:)                  !! (3 bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(out) :: unbalanced              !! norm of g - M a - Phi_q^T lambda, forces times the size [N.m]

      real(wp), allocatable :: b(:, :), jac(:, :), rest(:), right(:), s(:), transposed(:, :), work(:)
      integer, allocatable :: iwork(:)
      integer :: info, k, length, m, n, rank

      m = system%rows%n
      n = size(a)
      call set_some_acceleration(system%n_body, [(k, k=1, system%n_body)], a, system%motion)
      allocate (right(n), source=0.0_wp)
      do k = 1, system%n_body
         right(3*k - 2:3*k) = system%g(:, k) - a(3*k - 2:3*k)*system%mass(:, k)
         right(3*k - 2:3*k - 1) = right(3*k - 2:3*k - 1)*system%length_scale
      end do
      unbalanced = norm2(right)
      if (m == 0) return
      call scaled_jacobian(system, jac)
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
      system%lambda = b(1:m, 1)*row_scale(system)
   end subroutine find_reactions

end module inverse_dynamics
