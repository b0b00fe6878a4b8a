!> Augmented equations by the Schur complement of the mass matrix.
!>
!> S = Phi_q M^-1 Phi_q^T,   S lambda = Phi_q M^-1 g - b,   a = M^-1 (g - Phi_q^T lambda)
!>
!> S is assembled from a list, fixed at set-up, of the pairs of rows that share a body, and
!> factorised as L D L^T within its envelope, with a pivot test against the diagonal.
!> Source: Flores et al. (2008), eqs. (2.16)-(2.18). Limits: independent rows.
module augmented_schur
   use augmented, only: augmented_t
   use envelope, only: envelope_t, factorise, new_envelope, solve
   use joint_set, only: rows_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: augmented_schur_t

   real(wp), parameter :: threshold = 1.0e-13_wp  !! least pivot, as a part of its diagonal [1]

   !> Schur complement in an envelope.
   type, extends(augmented_t) :: augmented_schur_t
      integer :: n_body = 0                       !! number of bodies
      type(envelope_t) :: s                       !! Schur complement
      integer :: n_pair = 0                       !! pairs of rows that share a body
      integer, allocatable :: pair(:, :)          !! (5, pairs) row, first column in it; row, first column; place in S
      real(wp), allocatable :: jac_m(:, :)        !! (6, rows) Phi_q M^-1 [any]
      real(wp), allocatable :: x(:)               !! (rows) right-hand side, solution [any]
   contains
      procedure, nopass :: name => schur_name
      procedure :: prepare => schur_prepare
      procedure :: solve => schur_solve
   end type augmented_schur_t

contains

   !> The word for it in a deck.
   function schur_name() result(name)
      character(:), allocatable :: name  !! as in `solver = name`

      name = "schur"
   end function schur_name

   !> Envelope and list of pairs.
   subroutine schur_prepare(self, n_body, rows)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                    !! number of bodies
      type(rows_t), intent(in) :: rows                 !! rows, of which the bodies are read

      integer, allocatable :: first(:), pairs(:, :)
      integer :: i, j, n, pass, side_i, side_j

      n = rows%n
      self%n_body = n_body
      allocate (first(n))
      first = [(i, i=1, n)]
      allocate (pairs(4, 0))
      do pass = 1, 2
         self%n_pair = 0
         do i = 1, n
            do j = 1, i
               do side_i = 1, 2
                  if (rows%body(side_i, i) == 0) cycle
                  do side_j = 1, 2
                     if (rows%body(side_i, i) /= rows%body(side_j, j)) cycle
                     self%n_pair = self%n_pair + 1
                     first(i) = min(first(i), j)
                     if (pass == 2) pairs(:, self%n_pair) = [i, 3*side_i - 2, j, 3*side_j - 2]
                  end do
               end do
            end do
         end do
         if (pass == 1) then
            deallocate (pairs)
            allocate (pairs(4, self%n_pair))
         end if
      end do
      call new_envelope(first, self%s)
      allocate (self%pair(5, self%n_pair))
      do i = 1, self%n_pair
         self%pair(:, i) = [pairs(:, i), self%s%start(pairs(1, i)) + pairs(3, i)]
      end do
      allocate (self%jac_m(6, n), self%x(n), source=0.0_wp)
   end subroutine schur_prepare

   !> Accelerations and multipliers.
   subroutine schur_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      real(wp), intent(in) :: inverse_mass(:, :)       !! (3, bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                 !! rows
      real(wp), intent(in) :: g(:, :)                  !! (3, bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: b(:)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(out) :: a(:, :)                 !! (3, bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(out) :: lambda(:)               !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                  !! row at which the system is singular, 0: none

      integer :: c, d, i, j, k, row

      do row = 1, rows%n
         i = rows%body(1, row)
         j = rows%body(2, row)
         self%x(row) = -b(row)
         if (i > 0) then
            self%jac_m(1:3, row) = rows%jac(1:3, row)*inverse_mass(:, i)
            self%x(row) = self%x(row) + dot_product(self%jac_m(1:3, row), g(:, i))
         end if
         if (j > 0) then
            self%jac_m(4:6, row) = rows%jac(4:6, row)*inverse_mass(:, j)
            self%x(row) = self%x(row) + dot_product(self%jac_m(4:6, row), g(:, j))
         end if
      end do
      self%s%a = 0.0_wp
      do k = 1, self%n_pair
         c = self%pair(2, k)
         d = self%pair(4, k)
         self%s%a(self%pair(5, k)) = self%s%a(self%pair(5, k)) &
                                     + dot_product(self%jac_m(c:c + 2, self%pair(1, k)), rows%jac(d:d + 2, self%pair(3, k)))
      end do
      call factorise(self%s, threshold, bad_row)
      self%n_factorisations = self%n_factorisations + 1
      if (bad_row > 0) return
      call solve(self%s, self%x)
      lambda = self%x
      a = g*inverse_mass
      do row = 1, rows%n
         i = rows%body(1, row)
         j = rows%body(2, row)
         if (i > 0) a(:, i) = a(:, i) - self%jac_m(1:3, row)*self%x(row)
         if (j > 0) a(:, j) = a(:, j) - self%jac_m(4:6, row)*self%x(row)
      end do
   end subroutine schur_solve

end module augmented_schur
