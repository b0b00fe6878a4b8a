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
!> Signs: the reaction on the bodies is -Phi_q^T lambda. M is diagonal, n_v entries a body, and a row has 2 n_v columns: three and
!> six in the plane; six and twelve in space, with rates of rotation about the principal axes of a body. No more than these
!> numbers reports the plane from space here. Source: Flores et al. (2008), eqs. (2.14)-(2.18), (2.34). Limits: rows that contradict
!> one another have no solution; what is left over of them decides whether that is an error.
module augmented
   use archive, only: archive_t
   use body_kernels, only: body_accelerations, row_residuals
   use rows, only: rows_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: augmented_t, direct_t, min_pivots

   ! of the diagonal they came from: of independent rows as a rule; of bodies with one light inertia; then what counts as none
   real(wp), parameter :: min_pivots(3) = [1.0e-5_wp, 1.0e-7_wp, 1.0e-9_wp]  !! (3) minimum pivots [1]
   real(wp), parameter :: converged = 1.0e-15_wp  !! residual of the rows, of the maximum term, that is round-off [1]
   real(wp), parameter :: stagnant = 0.5_wp       !! ratio of successive residuals that is no progress [1]

   !> A way of solving the augmented equations.
   type, abstract :: augmented_t
      integer(i8) :: n_factorisations = 0      !! factorisations made
      logical :: tests_pivots = .false.        !! whether small pivots show dependent rows, see `set_min_pivot`
      logical :: is_iterative = .false.        !! whether `solve_damped` may end without a solution of regular rows
      real(wp) :: left_over = 0.0_wp           !! maximum residual after `solve_damped`, of the maximum term [1]
      real(wp), allocatable :: residual(:)     !! (solved rows) residuals Phi_q a - b after it [m/s^2 or rad/s^2]
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(prepare_interface), deferred :: prepare
      procedure(solve_interface), deferred :: solve
      procedure(solve_damped_interface), deferred :: solve_damped
      procedure :: name => augmented_name
      procedure :: set_penalty => augmented_set_penalty
      procedure :: set_min_pivot => augmented_set_min_pivot
      procedure :: save => augmented_save
      procedure :: load => augmented_load
   end type augmented_t

   !> A way that has factors: a damped solution is refined with them.
   type, abstract, extends(augmented_t) :: direct_t
   contains
      procedure(factorise_interface), deferred :: factorise
      procedure(back_solve_interface), deferred :: back_solve
      procedure :: solve_damped => direct_solve_damped
   end type direct_t

   abstract interface
      !> Description of the solver: the word for it in a deck, and how it solves.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name, as in `solver = name`, and help
      end function info_interface

      !> Structure and workspace for a number of bodies and declared rows.
      subroutine prepare_interface(self, n_body, rows)
         import :: augmented_t, rows_t
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self  !! the solver
         integer, intent(in) :: n_body              !! number of bodies
         type(rows_t), intent(in) :: rows           !! rows, of which the bodies are read
      end subroutine prepare_interface

      !> Accelerations of the unknown bodies and multipliers of the solved rows. The inverse masses of the ground and of
      !> prescribed bodies are zero. No allocation.
      subroutine solve_interface(self, inverse_mass, rows, g, b, a, lambda, bad_row)
         import :: augmented_t, rows_t, wp
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self                !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
         type(rows_t), intent(in) :: rows                         !! rows, of which the Jacobian is read
         real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied forces and moments [N or N.m]
         real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
         real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
         real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers, set of solved rows [N or N.m]
         integer, intent(out) :: bad_row                          !! row that depends on others, or nearly so, 0: none
      end subroutine solve_interface

      !> Accelerations and multipliers where rows may depend on one another. No allocation.
      subroutine solve_damped_interface(self, inverse_mass, rows, g, b, damping, n_refinement, a, lambda, bad_row)
         import :: augmented_t, rows_t, wp
         implicit none (type, external)
         class(augmented_t), intent(inout) :: self                !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
         type(rows_t), intent(in) :: rows                         !! rows
         real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied forces and moments [N or N.m]
         real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
         real(wp), intent(in) :: damping                          !! of S, relative to its diagonal [1]
         integer, intent(in) :: n_refinement                      !! refinements after the first solution, at most
         real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
         real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers, set of solved rows [N or N.m]
         integer, intent(out) :: bad_row                          !! row at which there is no solution, 0: none
      end subroutine solve_damped_interface

      !> Factors of S + damping D, in whatever form. No allocation.
      subroutine factorise_interface(self, inverse_mass, rows, damping, bad_row)
         import :: direct_t, rows_t, wp
         implicit none (type, external)
         class(direct_t), intent(inout) :: self                   !! the solver
         real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
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

   !> The word for the solver in a deck.
   function augmented_name(self) result(name)
      class(augmented_t), intent(in) :: self  !! the solver
      character(:), allocatable :: name       !! as in `solver = name`

      type(kind_info_t) :: info

      info = self%info()
      name = info%name
   end function augmented_name

   !> Take the penalty of a way that works with penalties: nothing to take, unless the way says otherwise.
   subroutine augmented_set_penalty(self, penalty)
      class(augmented_t), intent(inout) :: self   !! the solver
      real(wp), intent(in) :: penalty             !! of a violated row, of its inverse effective mass [1]
   end subroutine augmented_set_penalty

   !> Take the minimum pivot of independent rows, of the diagonal it came from: nothing to take for a way that has no such pivots.
   subroutine augmented_set_min_pivot(self, minimum)
      class(augmented_t), intent(inout) :: self   !! the solver
      real(wp), intent(in) :: minimum               !! the minimum pivot [1]
   end subroutine augmented_set_min_pivot

   !> Write what the solver remembers.
   subroutine augmented_save(self, archive)
      class(augmented_t), intent(in) :: self     !! the solver
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine augmented_save

   !> Read what the solver remembers.
   subroutine augmented_load(self, archive)
      class(augmented_t), intent(inout) :: self  !! the solver
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine augmented_load

   !> Accelerations and multipliers where rows may depend on one another.
   subroutine direct_solve_damped(self, inverse_mass, rows, g, b, damping, n_refinement, a, lambda, bad_row)
      class(direct_t), intent(inout) :: self                   !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied forces and moments [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
      real(wp), intent(in) :: damping                          !! of S, relative to its diagonal [1]
      integer, intent(in) :: n_refinement                      !! refinements after the first solution, at most
      real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers, set of solved rows [N or N.m]
      integer, intent(out) :: bad_row                          !! row at which there is no solution, 0: none

      real(wp) :: before, maximum, now
      integer :: k, n, n_body

      n = rows%n_solve
      n_body = ubound(g, 2)
      call self%factorise(inverse_mass, rows, damping, bad_row)
      if (bad_row > 0) return
      lambda(:n) = 0.0_wp
      before = huge(1.0_wp)
      maximum = tiny(1.0_wp)
      do k = 0, n_refinement + 1
         call body_accelerations(rows, rows%n_unknown, rows%unknown, n_body, inverse_mass, rows%jac, g, lambda, a)
         call row_residuals(rows, n, n_body, rows%jac, a, b, self%residual)
         if (n == 0) return
         now = maxval(abs(self%residual(:n)))
         if (k == 0) maximum = max(maximum, now, maxval(abs(b(:n))))
         self%left_over = now/maximum
         if (k > n_refinement .or. now <= converged*maximum .or. .not. now <= stagnant*before) return
         before = now
         call self%back_solve(self%residual)
         lambda(:n) = lambda(:n) + self%residual(:n)
      end do
   end subroutine direct_solve_damped

end module augmented
