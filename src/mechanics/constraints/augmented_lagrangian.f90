!> Augmented equations by iteration with penalties: the augmented Lagrangian of the book.
!>
!> (M + Phi_q^T alpha Phi_q) a_k+1 = M a_k + Phi_q^T alpha b,   lambda_k+1 = lambda_k + alpha (Phi_q a_k+1 - b),   M a_0 = g
!>
!> with alpha = penalty / D for each row, D the diagonal of Phi_q M^-1 Phi_q^T: the penalty is a number without unit. An
!> iteration takes the error down to 1 / (1 + penalty mu), mu the minimum eigenvalue of D^-1/2 S D^-1/2 that is not zero. It
!> solves for the change d of a; then lambda_k+1 = lambda_k + alpha (Phi_q (a_k + d) - b), and a_k+1 = M^-1 (g - Phi_q^T
!> lambda_k+1) anew, so that round-off does not grow with the penalty. The matrix is factorised once
!> as L D L^T, in the envelope of the bodies' coordinates. Rows may depend on one another; multipliers are then those of
!> least norm.
!> Source: Flores et al. (2008), eqs. (2.32)-(2.35), with Phi_q v + Phi_t where (2.34) prints Phi_q a.
!> Limits: slow where mu is small; multipliers lose as many digits as the penalty has.
module augmented_lagrangian
   use augmented, only: augmented_t
   use body_kernels, only: body_accelerations, row_residuals
   use envelope, only: envelope_t, factorise_and_solve, new_envelope, solve_factored
   use rows, only: body_of_side, coordinate_place, list_sides_of_rows, n_v_planar, place_of_side, rows_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use matrix_kernels_planar, only: planar_loads => penalty_loads, planar_matrix => penalty_matrix, &
                                    planar_penalties => row_penalties
   use matrix_kernels_spatial, only: spatial_loads => penalty_loads, spatial_matrix => penalty_matrix, &
                                     spatial_penalties => row_penalties
   use ordering, only: envelope_of, reverse_cuthill_mckee
   implicit none (type, external)
   private
   public :: augmented_lagrangian_t

   real(wp), parameter :: converged = 1.0e-15_wp  !! change of an acceleration, of the maximum, that ends the iteration [1]
   real(wp), parameter :: stagnant = 0.98_wp      !! ratio of successive changes that is round-off [1]
   real(wp), parameter :: solved = 1.0e-12_wp     !! last change, of the maximum acceleration, of a solution [1]
   real(wp), parameter :: stronger = 1.0e3_wp     !! factor of the penalty where the iteration does not converge [1]
   integer, parameter :: n_iteration = 40         !! iterations, at most

   !> Penalty matrix with its structure.
   !> Components: five are of every solver, the rest are the matrix and what one iteration leaves to the next.
   type, extends(augmented_t) :: augmented_lagrangian_t
      real(wp) :: penalty = 1.0e5_wp              !! of a violated row, of its inverse effective mass [1]
      type(envelope_t) :: k                       !! penalty matrix, then its factors
      integer, allocatable :: place(:)            !! (0:bodies) place before the coordinates of an unknown body
      integer :: n_pair = 0                       !! pairs of sides of the same row
      integer, allocatable :: pair(:, :)          !! (5, pairs) row, places of both sides in Phi_q, of their coordinates
      real(wp) :: change = 0.0_wp                 !! of the accelerations in the last iteration, of the maximum [1]
      real(wp), allocatable :: alpha(:)           !! (solved rows) penalties [any]
      real(wp), allocatable :: d(:, :)            !! (n_v, 0:bodies) change of a [any]
      real(wp), allocatable :: last(:, :)         !! (n_v, 0:bodies) a of the iteration before [any]
      real(wp), allocatable :: rest(:)            !! (solved rows) residual after the change [any]
      real(wp), allocatable :: x(:)               !! (coordinates) right-hand side and change of a [any]
   contains
      procedure, nopass :: info => lagrangian_info
      procedure :: prepare => lagrangian_prepare
      procedure :: set_penalty => lagrangian_set_penalty
      procedure :: solve => lagrangian_solve
      procedure :: solve_damped => lagrangian_solve_damped
   end type augmented_lagrangian_t

contains

   !> Take a penalty.
   subroutine lagrangian_set_penalty(self, penalty)
      class(augmented_lagrangian_t), intent(inout) :: self   !! the solver
      real(wp), intent(in) :: penalty                        !! of a violated row, of its inverse effective mass [1]

      self%penalty = penalty
   end subroutine lagrangian_set_penalty

   !> Description of the solver.
   function lagrangian_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "augmented_lagrangian"
      info%help = "penalties"
      info%source = "Flores et al. (2008), eqs. (2.32)-(2.35)"
   end function lagrangian_info

   !> Order of the bodies, envelope of their coordinates, pairs of sides.
   subroutine lagrangian_prepare(self, n_body, rows)
      class(augmented_lagrangian_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                         !! number of bodies
      type(rows_t), intent(in) :: rows                      !! rows, of which the bodies are read

      integer, allocatable :: first(:), first_body(:), last(:), neighbour(:), order(:), other(:), sides(:), start(:)
      integer :: body, c, k, m, n, other_body, pass
      real :: cost, other_cost

      n = rows%n_unknown
      call list_sides_of_rows(rows, last, sides)
      call list_bodies(n_body, rows, last, sides, start, neighbour)
      order = [(k, k=1, n)]
      first_body = order
      call envelope_of(start, neighbour, order, first_body, cost)
      call reverse_cuthill_mckee(start, neighbour, other)
      allocate (first(n))
      call envelope_of(start, neighbour, other, first, other_cost)
      if (other_cost < cost) then
         order = other
         first_body = first
      end if
      allocate (self%place(0:n_body), source=0)
      self%place(rows%unknown(order)) = coordinate_place(rows%n_v, [(k, k=1, n)])
      call new_envelope([((coordinate_place(rows%n_v, first_body(k)) + 1, c=1, rows%n_v), k=1, n)], self%k)
      do pass = 1, 2
         self%n_pair = 0
         do k = 1, rows%n_solve
            do c = last(k - 1) + 1, last(k)
               do m = last(k - 1) + 1, last(k)
                  body = self%place(body_of_side(rows, rows%side(sides(c))))
                  other_body = self%place(body_of_side(rows, rows%side(sides(m))))
                  if (body < other_body) cycle
                  self%n_pair = self%n_pair + 1
                  if (pass == 1) cycle
                  self%pair(:, self%n_pair) = [k, place_of_side(rows%n_v, rows%side(sides([c, m]))), body, &
                                               other_body]
               end do
            end do
         end do
         if (pass == 1) allocate (self%pair(5, self%n_pair), source=0)
      end do
      self%is_iterative = .true.
      allocate (self%alpha(rows%n_solve), self%residual(rows%n_solve), self%rest(rows%n_solve), self%x(self%k%n), source=0.0_wp)
      allocate (self%d(rows%n_v, 0:n_body), self%last(rows%n_v, 0:n_body), source=0.0_wp)
   end subroutine lagrangian_prepare

   !> For each unknown body those that share a row with it.
   subroutine list_bodies(n_body, rows, last, sides, start, neighbour)
      integer, intent(in) :: n_body                       !! number of bodies
      type(rows_t), intent(in) :: rows                    !! rows
      integer, intent(in) :: last(0:)                     !! (0:solved rows) last place of each row in the list
      integer, intent(in) :: sides(:)                     !! (sides) sides of the rows, row by row
      integer, allocatable, intent(out) :: start(:)       !! (unknown bodies + 1) place of the first neighbour of each
      integer, allocatable, intent(out) :: neighbour(:)   !! (any) neighbours, numbered among the unknown bodies

      integer :: i, k, m, number(0:n_body), row

      number = 0
      number(rows%unknown) = [(k, k=1, rows%n_unknown)]
      allocate (start(rows%n_unknown + 1), neighbour(sum((last(1:) - last(:rows%n_solve - 1))**2)))
      start(1) = 1
      do i = 1, rows%n_unknown
         start(i + 1) = start(i)
         do k = rows%last_side(rows%unknown(i) - 1) + 1, rows%last_side(rows%unknown(i))
            row = rows%side_row(k)
            do m = last(row - 1) + 1, last(row)
               if (sides(m) == k) cycle
               neighbour(start(i + 1)) = number(body_of_side(rows, rows%side(sides(m))))
               start(i + 1) = start(i + 1) + 1
            end do
         end do
      end do
   end subroutine list_bodies

   !> Accelerations and multipliers.
   subroutine lagrangian_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_lagrangian_t), intent(inout) :: self     !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                          !! row that has not converged, 0: none

      call iterate(self, self%penalty, inverse_mass, rows, g, b, a, lambda, bad_row)
      if (bad_row == 0 .and. .not. self%change <= solved) bad_row = maxloc(abs(self%residual), dim=1)
   end subroutine lagrangian_solve

   !> The same, with a stronger penalty where that does not converge. The penalty stands for the damping.
   subroutine lagrangian_solve_damped(self, inverse_mass, rows, g, b, damping, n_refinement, a, lambda, bad_row)
      class(augmented_lagrangian_t), intent(inout) :: self     !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(in) :: damping                          !! of other solvers [1]
      integer, intent(in) :: n_refinement                      !! of other solvers
      real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                          !! row at which there is no solution, 0: none

      call iterate(self, self%penalty, inverse_mass, rows, g, b, a, lambda, bad_row)
      if (bad_row == 0 .and. self%change <= solved) return
      call iterate(self, stronger*self%penalty, inverse_mass, rows, g, b, a, lambda, bad_row)
   end subroutine lagrangian_solve_damped

   !> Iterate with a penalty until the accelerations no longer change. Their change is the measure, not the residual: that of
   !> rows that are nearly dependent is small before their multipliers are right.
   subroutine iterate(self, penalty, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_lagrangian_t), intent(inout) :: self     !! the solver
      real(wp), intent(in) :: penalty                          !! of a violated row, of its inverse effective mass [1]
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                          !! row at which there is no solution, 0: none

      real(wp) :: before, change, maximum, largest
      integer :: k, n, n_body

      n = rows%n_solve
      n_body = size(g, 2) - 1
      call assemble(self, penalty, inverse_mass, rows)
      self%x = 0.0_wp
      call factorise_and_solve(1, self%k%n, self%k%n, size(self%k%a), self%k%first, self%k%start, 0.0_wp, self%k%a, &
                               self%k%row, self%x, bad_row)
      self%n_factorisations = self%n_factorisations + 1
      if (bad_row > 0) then
         bad_row = 1
         return
      end if
      self%left_over = 0.0_wp
      self%change = 0.0_wp
      lambda(:n) = 0.0_wp
      maximum = tiny(1.0_wp)
      largest = tiny(1.0_wp)/epsilon(1.0_wp)
      before = huge(1.0_wp)
      do k = 0, n_iteration
         self%last = a
         call body_accelerations(rows, rows%n_unknown, rows%unknown, n_body, inverse_mass, rows%jac, g, lambda, a)
         if (n == 0) return
         call row_residuals(rows, n, n_body, rows%jac, a, b, self%residual)
         if (k == 0) maximum = max(maximum, maxval(abs(self%residual)), maxval(abs(b(:n))))
         self%left_over = maxval(abs(self%residual))/maximum
         call compare(rows, self%last, a, change, largest)
         if (k > 0) then
            self%change = change/largest
            if (self%change <= converged .or. self%change >= stagnant*before) exit
            before = self%change
         end if
         call change_accelerations(self, rows)
         call row_residuals(rows, n, n_body, rows%jac, self%d, -self%residual, self%rest)
         lambda(:n) = lambda(:n) + self%alpha*self%rest
      end do
   end subroutine iterate

   !> M + Phi_q^T alpha Phi_q.
   subroutine assemble(self, penalty, inverse_mass, rows)
      class(augmented_lagrangian_t), intent(inout) :: self     !! the solver
      real(wp), intent(in) :: penalty                          !! of a violated row, of its inverse effective mass [1]
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows

      integer :: n_body

      n_body = ubound(inverse_mass, 2)
      associate (k => self%k, n => rows%n_solve)
         if (rows%n_v == n_v_planar) then
            call planar_penalties(n_body, rows%n_block, n, rows%n_side, rows%side, rows%side_row, rows%body, penalty, &
                                  rows%jac, inverse_mass, self%alpha)
            call planar_matrix(n_body, rows%n_block, n, rows%n_unknown, rows%unknown, self%place, self%n_pair, self%pair, k%n, &
                               k%start, size(k%a), self%alpha, inverse_mass, rows%jac, k%a)
         else
            call spatial_penalties(n_body, rows%n_block, n, rows%n_side, rows%side, rows%side_row, rows%body, penalty, &
                                   rows%jac, inverse_mass, self%alpha)
            call spatial_matrix(n_body, rows%n_block, n, rows%n_unknown, rows%unknown, self%place, self%n_pair, self%pair, k%n, &
                               k%start,  size(k%a), self%alpha, inverse_mass, rows%jac, k%a)
         end if
      end associate
   end subroutine assemble

   !> Maximum change of an acceleration of unknown bodies, and the maximum acceleration so far.
   pure subroutine compare(rows, last, a, change, largest)
      type(rows_t), intent(in) :: rows             !! rows
      real(wp), intent(in) :: last(:, 0:)          !! (n_v, 0:bodies) accelerations before [any]
      real(wp), intent(in) :: a(:, 0:)             !! (n_v, 0:bodies) accelerations now [any]
      real(wp), intent(out) :: change              !! maximum change [any]
      real(wp), intent(inout) :: largest           !! maximum acceleration so far, raised [any]

      integer :: k

      change = 0.0_wp
      do k = 1, rows%n_unknown
         associate (body => rows%unknown(k))
            change = max(change, maxval(abs(a(:, body) - last(:, body))))
            largest = max(largest, maxval(abs(a(:, body))))
         end associate
      end do
   end subroutine compare

   !> (M + Phi_q^T alpha Phi_q) d = -Phi_q^T alpha r.
   subroutine change_accelerations(self, rows)
      class(augmented_lagrangian_t), intent(inout) :: self     !! the solver, factorised, residuals set
      type(rows_t), intent(in) :: rows                         !! rows

      integer :: i, k, n_body

      n_body = ubound(self%place, 1)
      if (rows%n_v == n_v_planar) then
         call planar_loads(n_body, rows%n_block, rows%n_solve, rows%n_side, rows%side, rows%side_row, rows%body, self%place, &
                           self%k%n, self%alpha, rows%jac, self%residual, self%x)
      else
         call spatial_loads(n_body, rows%n_block, rows%n_solve, rows%n_side, rows%side, rows%side_row, rows%body, self%place, &
                            self%k%n, self%alpha, rows%jac, self%residual, self%x)
      end if
      call solve_factored(self%k%n, size(self%k%a), self%k%first, self%k%start, self%k%a, self%x)
      do k = 1, rows%n_unknown
         i = self%place(rows%unknown(k))
         self%d(:, rows%unknown(k)) = self%x(i + 1:i + rows%n_v)
      end do
   end subroutine change_accelerations

end module augmented_lagrangian
