!> Augmented equations by the Schur complement of the mass matrix.
!>
!> S = Phi_q M^-1 Phi_q^T,   S lambda = Phi_q M^-1 g - b,   a = M^-1 (g - Phi_q^T lambda)
!>
!> S is assembled from a list, fixed at set-up, of the pairs of rows that share a body, and
!> factorised as L D L^T within its envelope, with a pivot test against the diagonal.
!> Source: Flores et al. (2008), eqs. (2.16)-(2.18). Limits: independent rows.
module augmented_schur
   use augmented, only: augmented_t
   use envelope, only: envelope_t, factorise_and_solve, new_envelope
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
      integer, allocatable :: pair(:, :)          !! (3, pairs) entry of Phi_q M^-1, entry of Phi_q, place in S
      real(wp), allocatable :: jac_m(:)           !! (6 rows) Phi_q M^-1, row by row [any]
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
      allocate (self%pair(3, self%n_pair))
      do i = 1, self%n_pair
         self%pair(:, i) = [6*(pairs(1, i) - 1) + pairs(2, i), 6*(pairs(3, i) - 1) + pairs(4, i), &
                            self%s%start(pairs(1, i)) + pairs(3, i)]
      end do
      allocate (self%jac_m(6*n), source=0.0_wp)
   end subroutine schur_prepare

   !> Accelerations and multipliers.
   subroutine schur_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)      !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                 !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)                 !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in), contiguous :: b(:)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(out), contiguous :: a(:, 0:)                !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(out), contiguous :: lambda(:)               !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                  !! row at which the system is singular, 0: none

      call weigh_rows(self%n_body, rows%n, rows%n_side, rows%side, inverse_mass, rows%jac, g, b, self%jac_m, lambda)
      call multiply_pairs(6*rows%n, self%n_pair, size(self%s%a), self%pair, self%jac_m, rows%jac, self%s%a)
      call factorise_and_solve(rows%n, size(self%s%a), self%s%first, self%s%start, threshold, self%s%a, self%s%inverse, &
                               self%s%row, lambda, bad_row)
      self%n_factorisations = self%n_factorisations + 1
      if (bad_row > 0) return
      call accelerations(self%n_body, rows%n, rows%n_side, rows%side, rows%last_side, inverse_mass, self%jac_m, g, lambda, a)
   end subroutine schur_solve

   !> Phi_q M^-1, and the right-hand side of the multipliers. The ground has inverse mass zero.
   pure subroutine weigh_rows(n_body, n_row, n_side, side, inverse_mass, jac, g, b, jac_m, x)
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      integer, intent(in) :: n_side                        !! sides of rows that are bodies
      integer, intent(in) :: side(3, n_side)               !! (3, sides) row, place in the Jacobian, body
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)    !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: jac(6*n_row)                 !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: g(3, 0:n_body)               !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: b(n_row)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout) :: jac_m(6*n_row)            !! (6 rows) Phi_q M^-1, row by row [any]
      real(wp), intent(out) :: x(n_row)                    !! (rows) right-hand side of the multipliers [m/s^2 or rad/s^2]

      integer :: body, k, place, row

      !GCC$ novector
      do row = 1, n_row
         x(row) = -b(row)
      end do
      !GCC$ novector
      do k = 1, n_side
         row = side(1, k)
         place = side(2, k)
         body = side(3, k)
         jac_m(place + 1) = jac(place + 1)*inverse_mass(1, body)
         jac_m(place + 2) = jac(place + 2)*inverse_mass(2, body)
         jac_m(place + 3) = jac(place + 3)*inverse_mass(3, body)
         x(row) = x(row) + (jac_m(place + 1)*g(1, body) + jac_m(place + 2)*g(2, body) + jac_m(place + 3)*g(3, body))
      end do
   end subroutine weigh_rows

   !> The Schur complement from the list of pairs.
   pure subroutine multiply_pairs(n, n_pair, n_entry, pair, jac_m, jac, s)
      integer, intent(in) :: n                   !! entries of the Jacobian, six per row
      integer, intent(in) :: n_pair              !! pairs of rows that share a body
      integer, intent(in) :: n_entry             !! entries of the envelope
      integer, intent(in) :: pair(3, n_pair)     !! (3, pairs) entry of Phi_q M^-1, entry of Phi_q, place in S
      real(wp), intent(in) :: jac_m(n)           !! (n) Phi_q M^-1, row by row [any]
      real(wp), intent(in) :: jac(n)             !! (n) Phi_q, row by row [1 or m]
      real(wp), intent(out) :: s(n_entry)        !! (entries) Schur complement [any]

      integer :: c, d, k, place

      !GCC$ novector
      do k = 1, n_entry
         s(k) = 0.0_wp
      end do
      !GCC$ novector
      do k = 1, n_pair
         c = pair(1, k)
         d = pair(2, k)
         place = pair(3, k)
         s(place) = s(place) + (jac_m(c)*jac(d) + jac_m(c + 1)*jac(d + 1) + jac_m(c + 2)*jac(d + 2))
      end do
   end subroutine multiply_pairs

   !> a = M^-1 (g - Phi_q^T lambda).
   pure subroutine accelerations(n_body, n_row, n_side, side, last_side, inverse_mass, jac_m, g, lambda, a)
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      integer, intent(in) :: n_side                        !! sides of rows that are bodies
      integer, intent(in) :: side(3, n_side)               !! (3, sides) row, place in the Jacobian, body
      integer, intent(in) :: last_side(0:n_body)           !! (0:bodies) last side of each body
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)    !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: jac_m(6*n_row)               !! (6 rows) Phi_q M^-1, row by row [any]
      real(wp), intent(in) :: g(3, 0:n_body)               !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: lambda(n_row)                !! (rows) multipliers [N or N.m]
      real(wp), intent(out) :: a(3, 0:n_body)              !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]

      real(wp) :: a1, a2, a3
      integer :: body, k, place

      a(:, 0) = 0.0_wp
      do body = 1, n_body
         a1 = g(1, body)*inverse_mass(1, body)
         a2 = g(2, body)*inverse_mass(2, body)
         a3 = g(3, body)*inverse_mass(3, body)
         !GCC$ novector
         do k = last_side(body - 1) + 1, last_side(body)
            place = side(2, k)
            a1 = a1 - jac_m(place + 1)*lambda(side(1, k))
            a2 = a2 - jac_m(place + 2)*lambda(side(1, k))
            a3 = a3 - jac_m(place + 3)*lambda(side(1, k))
         end do
         a(1, body) = a1
         a(2, body) = a2
         a(3, body) = a3
      end do
   end subroutine accelerations

end module augmented_schur
