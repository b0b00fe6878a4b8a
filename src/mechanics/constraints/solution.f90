!> Accelerations and multipliers of constrained bodies: the right-hand side, the solver, and what to do where rows depend on one
!> another.
!>
!> [ M  Phi_q^T ] [ a      ]   [ g ]
!> [ Phi_q   0  ] [ lambda ] = [ b ],   b = gamma - 2 alpha Phi' - beta^2 Phi,   Phi' = Phi_q v + Phi_t.
!>
!> Where rows depend on one another, or nearly so, the damped solution answers: it stays finite, and the control of the step
!> decides what is good enough.
!> Signs: the reaction on the bodies is -Phi_q^T lambda. Source: Flores et al. (2008), eqs. (2.15), (2.23).
module solution
   use augmented, only: augmented_t, min_pivots
   use rows, only: rows_t
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: find_free, solution_t

   real(wp), parameter :: damping(2) = [1.0e-9_wp, 1.0e-5_wp]  !! (2) of rows nearly, or always, dependent; round-off over it
                                                               !! shows in reactions that are not unique [1]
   integer, parameter :: n_refinement(2) = [3, 30]   !! refinements of these solutions, at most
   integer, parameter :: n_level = 3                 !! dampings tried where rows always depend on others
   real(wp), parameter :: finer = 1.0e-2_wp          !! each of them over the one before [1]
   real(wp), parameter :: left = 1.0e-9_wp           !! residual of the rows, of the maximum term, that is small enough [1]
   real(wp), parameter :: better = 0.1_wp            !! part of the residual that a finer damping must leave, to be taken [1]
   real(wp), parameter :: contradiction = 1.0e-2_wp  !! residual of rows always dependent that is an error [1]
   real(wp), parameter :: round_off = 1.0e-10_wp     !! residual that is round-off, over the square of the characteristic rate [1]

   !> The last solution, and how it is found.
   type :: solution_t
      class(augmented_t), allocatable :: solver          !! way of solving the augmented equations
      logical :: is_redundant = .false.                  !! whether rows depend on one another from the start
      real(wp) :: alpha = 0.0_wp                         !! Baumgarte's gain on the rate of violation [1/s]
      real(wp) :: beta = 0.0_wp                          !! Baumgarte's gain on the violation [1/s]
      real(wp), allocatable :: row_weight(:)             !! (rows) one over the size of the bodies, or one for angles [1/m or 1/rad]
      real(wp) :: rate = 0.0_wp                          !! characteristic rate of the mechanism [1/s]
      real(wp), allocatable :: phi_dot(:)                !! (rows) rate of the violation [m/s or rad/s]
      real(wp), allocatable :: b(:)                      !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
      real(wp), allocatable :: a(:, :)                   !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), allocatable :: lambda(:)                 !! (rows) multipliers [N or N.m]
      integer(i8) :: n_damped = 0                        !! evaluations in which rows were dependent, or nearly so
      integer, allocatable :: left_out(:)                !! rows that the form of index 2 omits, which depend on others
      integer, allocatable :: set_aside(:)               !! redundant rows that do not quite agree, held by no one: `closing_fit`
      real(wp) :: min_pivot = min_pivots(1)          !! of independent rows, of the diagonal it came from [1]
      integer :: bad_row = 0                             !! row at which the last evaluation was singular, 0: none
   contains
      procedure :: find => solution_find, set_gains => solution_set_gains
      procedure :: judge_pivots, take_min_pivot
   end type solution_t

contains

   !> Set the gains of the stabilisation.
   subroutine solution_set_gains(self, alpha, beta)
      class(solution_t), intent(inout) :: self   !! the solution
      real(wp), intent(in) :: alpha              !! gain on the rate of violation [1/s]
      real(wp), intent(in) :: beta               !! gain on the violation [1/s]

      self%alpha = alpha
      self%beta = beta
   end subroutine solution_set_gains

   !> Find the minimum pivot of independent rows, at a start where no rows depend on others. A body that is light about one axis,
   !> as a thin rod, makes small pivots of rows that are independent: where those of the start are small for that reason, smaller
   !> ones mean dependence.
   subroutine judge_pivots(self, inverse_mass, rows)
      class(solution_t), intent(inout) :: self                 !! the solution
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses, 0 if known [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows, evaluated at the start

      real(wp), allocatable :: a(:, :), b(:), g(:, :), lambda(:)
      integer(i8) :: n_before
      integer :: bad_row, level

      if (.not. self%solver%tests_pivots .or. rows%n_solve == 0) return
      allocate (a, g, mold=self%a)
      allocate (b, lambda, mold=self%b)
      g = 0.0_wp
      b = 0.0_wp
      n_before = self%solver%n_factorisations
      do level = 1, 2
         call self%take_min_pivot(min_pivots(level))
         call self%solver%solve(inverse_mass, rows, g, b, a, lambda, bad_row)
         if (bad_row == 0) exit
      end do
      call self%take_min_pivot(min_pivots(merge(3, 1, level == 2)))
      self%solver%n_factorisations = n_before  ! those of the motion are counted
   end subroutine judge_pivots

   !> Take the minimum pivot of independent rows.
   subroutine take_min_pivot(self, minimum)
      class(solution_t), intent(inout) :: self   !! the solution
      real(wp), intent(in) :: minimum              !! of the diagonal it came from [1]

      self%min_pivot = minimum
      call self%solver%set_min_pivot(minimum)
   end subroutine take_min_pivot

   !> Accelerations of the unknown bodies and multipliers of the solved rows, of which there are some, as rows and b were set.
   !> Status 1 if rows that always depend on others contradict them, or if there is no solution.
   subroutine solution_find(self, inverse_mass, rows, g, must_agree, status)
      class(solution_t), intent(inout) :: self                 !! the solution
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses, 0 if known [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows, evaluated
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) loads [N or N.m]
      logical, intent(in) :: must_agree                        !! whether a contradiction counts: that of a correction is round-off
      integer, intent(out) :: status                           !! 0: found

      integer :: k

      status = 0
      self%bad_row = 1
      if (.not. self%is_redundant) call self%solver%solve(inverse_mass, rows, g, self%b, self%a, self%lambda, self%bad_row)
      if (self%bad_row == 0) return
      self%n_damped = self%n_damped + 1
      k = merge(2, 1, self%is_redundant)
      call self%solver%solve_damped(inverse_mass, rows, g, self%b, damping(k), n_refinement(k), self%a, self%lambda, self%bad_row)
      if (self%is_redundant .and. self%solver%left_over > left) call find_finer(self, inverse_mass, rows, g)
      if (self%bad_row == 0 .and. must_agree .and. (self%is_redundant .or. self%solver%is_iterative)) then
         if (.not. self%solver%left_over <= contradiction) self%bad_row = contradicting_row(self, rows%n_solve)
      end if
      if (self%bad_row > 0) status = 1
   end subroutine solution_find

   !> The row with the maximum residual; 0 if that is round-off, as it is where every right-hand side is round-off.
   pure integer function contradicting_row(self, n) result(row)
      class(solution_t), intent(in) :: self   !! the solution
      integer, intent(in) :: n                !! solved rows

      row = max(1, maxloc(abs(self%solver%residual(:n))*self%row_weight(:n), dim=1))
      if (abs(self%solver%residual(row))*self%row_weight(row) <= round_off*self%rate**2) row = 0
   end function contradicting_row

   !> Accelerations of bodies that nothing holds.
   pure subroutine find_free(n, body, n_v, n_body, inverse_mass, g, a)
      integer, intent(in) :: n                              !! number of bodies that are not known
      integer, intent(in) :: body(n)                        !! (n) these bodies
      integer, intent(in) :: n_v                            !! rates of a body
      integer, intent(in) :: n_body                         !! number of bodies
      real(wp), intent(in) :: inverse_mass(n_v, 0:n_body)   !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      real(wp), intent(in) :: g(n_v, 0:n_body)              !! (n_v, 0:bodies) loads [N or N.m]
      real(wp), intent(inout) :: a(n_v, 0:n_body)           !! (n_v, 0:bodies) accelerations, these are set [m/s^2 or rad/s^2]

      integer :: k

      do k = 1, n
         a(:, body(k)) = inverse_mass(:, body(k))*g(:, body(k))
      end do
   end subroutine find_free

   !> Less damping, where refinement does not get over it: rows that do not depend on others may still hold little, as about the
   !> axis of a thin rod. What is left of rows that do not quite agree, off the constraints, is no reason for it.
   subroutine find_finer(self, inverse_mass, rows, g)
      class(solution_t), intent(inout) :: self                 !! the solution, damped
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses, 0 if known [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows, evaluated
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) loads [N or N.m]

      real(wp) :: before
      integer :: level

      do level = 2, n_level
         before = self%solver%left_over
         call solve_at(level)
         if (self%bad_row > 0 .or. .not. self%solver%left_over <= better*before) then
            call solve_at(level - 1)
            return
         end if
         if (self%solver%left_over <= left) return
      end do

   contains

      !> The solution with one of the dampings.
      subroutine solve_at(level)
         integer, intent(in) :: level   !! which, 1: the first

         call self%solver%solve_damped(inverse_mass, rows, g, self%b, damping(2)*finer**(level - 1), n_refinement(2), self%a, &
                                       self%lambda, self%bad_row)
      end subroutine solve_at

   end subroutine find_finer

end module solution
