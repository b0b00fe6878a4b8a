!> The contract of solvers of the augmented equations of motion, and what they share.
!>
!> [ M  Phi_q^T ] [ a      ]   [ g ]
!> [ Phi_q   0  ] [ lambda ] = [ b ]                                         eq. (2.15)
!>
!> Where rows depend on one another, or nearly so, `solve` says so and `solve_damped` answers: with S = Phi_q M^-1 Phi_q^T
!> and D its diagonal, multipliers come from S + damping D by iterative refinement,
!>
!> lambda_0 = 0,   (S + damping D) d = Phi_q a_k - b,   lambda_k+1 = lambda_k + d,   a_k = M^-1 (g - Phi_q^T lambda_k).
!>
!> Directions in which S is much larger than the damping are solved to round-off; in the others lambda stays small, which
!> gives the multipliers of least norm, each measured by the root of its entry of D. One step is the regularised solution.
!>
!> Signs: the reaction on the bodies is -Phi_q^T lambda. A planar mass matrix is diagonal, three
!> entries per body. Source: Flores et al. (2008), eqs. (2.14)-(2.18), (2.34). Limits: rows that contradict one another
!> have no solution; what is left over of them decides whether that is an error.
module augmented
   use rows, only: rows_t
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: augmented_t, body_accelerations, direct_t, row_residuals

   real(wp), parameter :: converged = 1.0e-15_wp  !! residual of the rows, of the greatest term, that is round-off [1]
   real(wp), parameter :: stagnant = 0.5_wp       !! ratio of successive residuals that is no progress [1]

   !> A way of solving the augmented equations.
   type, abstract :: augmented_t
      integer(i8) :: n_factorisations = 0      !! factorisations made
      logical :: is_iterative = .false.        !! whether `solve_damped` may end without a solution of regular rows
      real(wp) :: left_over = 0.0_wp           !! greatest residual after `solve_damped`, of the greatest term [1]
      real(wp), allocatable :: residual(:)     !! (solved rows) residuals Phi_q a - b after it [m/s^2 or rad/s^2]
   contains
      procedure(name_interface), nopass, deferred :: name
      procedure(prepare_interface), deferred :: prepare
      procedure(solve_interface), deferred :: solve
      procedure(solve_damped_interface), deferred :: solve_damped
      procedure :: set_penalty => augmented_set_penalty
   end type augmented_t

   !> A way that has factors: a damped solution is refined with them.
   type, abstract, extends(augmented_t) :: direct_t
   contains
      procedure(factorise_interface), deferred :: factorise
      procedure(back_solve_interface), deferred :: back_solve
      procedure :: solve_damped => direct_solve_damped
   end type direct_t

   abstract interface
      !> The word for it in a deck.
      function name_interface() result(name)
         implicit none (type, external)
         character(:), allocatable :: name  !! as in `solver = name`
      end function name_interface

      !> Structure and workspace for a number of bodies and declared rows.
      subroutine prepare_interface(self, n_body, rows)
         import :: augmented_t, rows_t
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self  !! the solver
         integer, intent(in) :: n_body              !! number of bodies
         type(rows_t), intent(in) :: rows           !! rows, of which the bodies are read
      end subroutine prepare_interface

      !> Accelerations of the unknown bodies and multipliers of the solved rows. The inverse masses of the ground and of
      !> known bodies are zero. No allocation.
      subroutine solve_interface(self, inverse_mass, rows, g, b, a, lambda, bad_row)
         import :: augmented_t, rows_t, wp
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self                !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
         type(rows_t), intent(in) :: rows                         !! rows, of which the Jacobian is read
         real(wp), intent(in), contiguous :: g(:, 0:)             !! (3, 0:bodies) applied forces and moments [N, N, N.m]
         real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
         real(wp), intent(inout), contiguous :: a(:, 0:)          !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
         real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers, set of solved rows [N or N.m]
         integer, intent(out) :: bad_row                          !! row that depends on others, or nearly so, 0: none
      end subroutine solve_interface

      !> Accelerations and multipliers where rows may depend on one another. No allocation.
      subroutine solve_damped_interface(self, inverse_mass, rows, g, b, damping, n_refinement, a, lambda, bad_row)
         import :: augmented_t, rows_t, wp
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self                !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
         type(rows_t), intent(in) :: rows                         !! rows
         real(wp), intent(in), contiguous :: g(:, 0:)             !! (3, 0:bodies) applied forces and moments [N, N, N.m]
         real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
         real(wp), intent(in) :: damping                          !! of S, relative to its diagonal [1]
         integer, intent(in) :: n_refinement                      !! refinements after the first solution, at most
         real(wp), intent(inout), contiguous :: a(:, 0:)          !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
         real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers, set of solved rows [N or N.m]
         integer, intent(out) :: bad_row                          !! row at which there is no solution, 0: none
      end subroutine solve_damped_interface

      !> Factors of S + damping D, in whatever form. No allocation.
      subroutine factorise_interface(self, inverse_mass, rows, damping, bad_row)
         import :: direct_t, rows_t, wp
         implicit none (type, external)
         class(direct_t), intent(inout) :: self                   !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
         type(rows_t), intent(in) :: rows                         !! rows, of which the Jacobian is read
         real(wp), intent(in) :: damping                          !! added to the diagonal, of its entries [1]
         integer, intent(out) :: bad_row                          !! row at which there are no factors all the same, 0: none
      end subroutine factorise_interface

      !> Solution of (S + damping D) x = r with these factors. No allocation.
      subroutine back_solve_interface(self, x)
         import :: direct_t, wp
         implicit none (type, external)
         class(direct_t), intent(inout) :: self      !! the solver, factorised
         real(wp), intent(inout), contiguous :: x(:) !! (solved rows) r, then x [any]
      end subroutine back_solve_interface
   end interface

contains

   !> Take the penalty of a way that works with penalties: nothing to take, unless the way says otherwise.
   subroutine augmented_set_penalty(self, penalty)
      class(augmented_t), intent(inout) :: self   !! the solver
      real(wp), intent(in) :: penalty             !! of a violated row, of its inverse effective mass [1]
   end subroutine augmented_set_penalty

   !> Accelerations and multipliers where rows may depend on one another.
   subroutine direct_solve_damped(self, inverse_mass, rows, g, b, damping, n_refinement, a, lambda, bad_row)
      class(direct_t), intent(inout) :: self                   !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (3, 0:bodies) applied forces and moments [N, N, N.m]
      real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
      real(wp), intent(in) :: damping                          !! of S, relative to its diagonal [1]
      integer, intent(in) :: n_refinement                      !! refinements after the first solution, at most
      real(wp), intent(inout), contiguous :: a(:, 0:)          !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers, set of solved rows [N or N.m]
      integer, intent(out) :: bad_row                          !! row at which there is no solution, 0: none

      real(wp) :: before, greatest, now
      integer :: k, n

      n = rows%n_solve
      call self%factorise(inverse_mass, rows, damping, bad_row)
      if (bad_row > 0) return
      lambda(:n) = 0.0_wp
      before = huge(1.0_wp)
      greatest = tiny(1.0_wp)
      do k = 0, n_refinement + 1
         call body_accelerations(size(g, 2) - 1, rows%n, rows%n_unknown, rows%unknown, rows%n_side, rows%side, rows%last_side, &
                                 inverse_mass, rows%jac, g, lambda, a)
         call row_residuals(size(g, 2) - 1, rows%n, n, rows%n_side, rows%side, rows%jac, a, b, self%residual)
         if (n == 0) return
         now = maxval(abs(self%residual(:n)))
         if (k == 0) greatest = max(greatest, now, maxval(abs(b(:n))))
         self%left_over = now/greatest
         if (k > n_refinement .or. now <= converged*greatest .or. .not. now <= stagnant*before) return
         before = now
         call self%back_solve(self%residual)
         lambda(:n) = lambda(:n) + self%residual(:n)
      end do
   end subroutine direct_solve_damped

   !> a = M^-1 (g - Phi_q^T lambda) of the unknown bodies.
   pure subroutine body_accelerations(n_body, n_row, n_unknown, unknown, n_side, side, last_side, inverse_mass, jac, g, lambda, a)
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      integer, intent(in) :: n_unknown                     !! number of unknown bodies
      integer, intent(in) :: unknown(n_unknown)            !! (unknown bodies) their numbers
      integer, intent(in) :: n_side                        !! sides of rows that are unknown bodies
      integer, intent(in) :: side(3, n_side)               !! (3, sides) row, place in the Jacobian, body
      integer, intent(in) :: last_side(0:n_body)           !! (0:bodies) last side of each body
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)    !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: jac(6*n_row)                 !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: g(3, 0:n_body)               !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: lambda(n_row)                !! (rows) multipliers [N or N.m]
      real(wp), intent(inout) :: a(3, 0:n_body)            !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]

      real(wp) :: f1, f2, f3, multiplier
      integer :: body, i, k, place

      do i = 1, n_unknown
         body = unknown(i)
         f1 = g(1, body)
         f2 = g(2, body)
         f3 = g(3, body)
         !GCC$ novector
         do k = last_side(body - 1) + 1, last_side(body)
            place = side(2, k)
            multiplier = lambda(side(1, k))
            f1 = f1 - jac(place + 1)*multiplier
            f2 = f2 - jac(place + 2)*multiplier
            f3 = f3 - jac(place + 3)*multiplier
         end do
         a(1, body) = f1*inverse_mass(1, body)
         a(2, body) = f2*inverse_mass(2, body)
         a(3, body) = f3*inverse_mass(3, body)
      end do
   end subroutine body_accelerations

   !> r = Phi_q a - b of the solved rows.
   pure subroutine row_residuals(n_body, n_row, n_solve, n_side, side, jac, a, b, r)
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      integer, intent(in) :: n_solve                       !! rows that are solved for
      integer, intent(in) :: n_side                        !! sides of rows that are unknown bodies
      integer, intent(in) :: side(3, n_side)               !! (3, sides) row, place in the Jacobian, body
      real(wp), intent(in) :: jac(6*n_row)                 !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: a(3, 0:n_body)               !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(in) :: b(n_row)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(out) :: r(n_solve)                  !! (solved rows) residuals [m/s^2 or rad/s^2]

      integer :: body, k, place, row

      !GCC$ novector
      do row = 1, n_solve
         r(row) = -b(row)
      end do
      !GCC$ novector
      do k = 1, n_side
         row = side(1, k)
         place = side(2, k)
         body = side(3, k)
         r(row) = r(row) + (jac(place + 1)*a(1, body) + jac(place + 2)*a(2, body) + jac(place + 3)*a(3, body))
      end do
   end subroutine row_residuals

end module augmented
