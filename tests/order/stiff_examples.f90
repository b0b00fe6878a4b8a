!> Small stiff systems, for the tests of the method that chooses.
module stiff_examples
   use check, only: check_close, check_equal
   use errors, only: error_t
   use integrator, only: advance_step, integrator_t
   use kinds, only: wp
   use ode_examples, only: growth_t, plain_t
   implicit none (type, external)
   private
   public :: crossing_t, follower_t, n_most, new_crossing, new_follower, robertson_t, run_from, van_der_pol_t

   integer, parameter :: n_most = 2000000   !! steps of a run, at most

   !> y' = -decay (y - sin t) + cos t, which follows the sine, beside one that swings; the decay is fast between two times only.
   type, extends(growth_t) :: follower_t
      real(wp) :: decay = 0.0_wp             !! of the difference between the times [1/s]
      real(wp) :: from = -huge(1.0_wp)       !! when it becomes fast [s]
      real(wp) :: to = huge(1.0_wp)          !! and when it is slow again [s]
   contains
      procedure :: evaluate => follower_evaluate
   end type follower_t

   !> The same with an event where it passes a half.
   type, extends(follower_t) :: crossing_t
      real(wp) :: side = 1.0_wp              !! 1: it is below, -1: it is above [1]
   contains
      procedure :: events => crossing_events
   end type crossing_t

   !> Van der Pol's oscillator x'' = mu (1 - x^2) x' - x: it crawls, and then it leaps.
   type, extends(plain_t) :: van_der_pol_t
      real(wp) :: mu = 0.0_wp   !! [1/s]
   contains
      procedure :: evaluate => van_der_pol_evaluate
   end type van_der_pol_t

   !> Robertson's reaction.
   type, extends(plain_t) :: robertson_t
   contains
      procedure :: evaluate => robertson_evaluate
   end type robertson_t

contains

   subroutine follower_evaluate(self, t, y, ydot, status)
      class(follower_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(in) :: y(self%n)          !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)      !! (n) its derivative [any]
      integer, intent(out) :: status             !! outcome

      real(wp) :: decay

      decay = merge(self%decay, 1.0_wp, t >= self%from .and. t <= self%to)
      ydot(1) = -decay*(y(1) - sin(t)) + cos(t)
      ydot(2) = y(3)
      ydot(3) = -y(2)
      status = 0
   end subroutine follower_evaluate

   subroutine van_der_pol_evaluate(self, t, y, ydot, status)
      class(van_der_pol_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                    !! time [s]
      real(wp), intent(in) :: y(self%n)            !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)        !! (n) its derivative [any]
      integer, intent(out) :: status               !! outcome

      ydot = [y(2), self%mu*(1.0_wp - y(1)**2)*y(2) - y(1)]
      status = 0
   end subroutine van_der_pol_evaluate

   subroutine robertson_evaluate(self, t, y, ydot, status)
      class(robertson_t), intent(inout) :: self    !! the system
      real(wp), intent(in) :: t                    !! time [s]
      real(wp), intent(in) :: y(self%n)            !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)        !! (n) its derivative [any]
      integer, intent(out) :: status               !! outcome

      ydot(1) = -0.04_wp*y(1) + 1.0e4_wp*y(2)*y(3)
      ydot(3) = 3.0e7_wp*y(2)**2
      ydot(2) = -ydot(1) - ydot(3)
      status = 0
   end subroutine robertson_evaluate

   !> A follower of the sine, and what swings.
   subroutine new_follower(decay, from, to, system)
      real(wp), intent(in) :: decay                !! [1/s]
      real(wp), intent(in) :: from                 !! when it is that [s]
      real(wp), intent(in) :: to                   !! and no longer [s]
      type(follower_t), intent(out) :: system      !! the system

      system%n = 3
      system%n_position = 0
      system%decay = decay
      system%from = from
      system%to = to
      system%rate = [1.0_wp, 1.0_wp, 1.0_wp]
      system%scale = system%rate
   end subroutine new_follower

   !> From a state to a time.
   subroutine run_from(method, system, y, t_end, error)
      class(integrator_t), intent(inout) :: method       !! the integrator, not started
      class(plain_t), intent(inout) :: system            !! the system
      real(wp), intent(in) :: y(:)                       !! (n) state at t = 0 [any]
      real(wp), intent(in) :: t_end                      !! end [s]
      type(error_t), allocatable, intent(inout) :: error !! it did not get there

      integer :: k, status

      call method%start(system, 0.0_wp, y, t_end, status)
      do k = 1, n_most
         if (status /= advance_step .or. method%t >= t_end) exit
         call method%advance(system, t_end, status)
      end do
      call check_equal(error, status, advance_step, "status")
      call check_close(error, method%t, t_end, 0.0_wp, "end")
   end subroutine run_from

   !> A follower with an event where it passes a half.
   subroutine new_crossing(system)
      type(crossing_t), intent(out) :: system     !! the system

      system%n = 3
      system%n_position = 0
      system%n_event = 1
      system%decay = 1.0e4_wp
      system%rate = [1.0_wp, 1.0_wp, 1.0_wp]
      system%scale = system%rate
   end subroutine new_crossing

   subroutine crossing_events(self, t, y, g, rate)
      class(crossing_t), intent(inout) :: self     !! the system
      real(wp), intent(in) :: t                    !! time [s]
      real(wp), intent(in) :: y(:)                 !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)    !! (n_event) beyond a half [any]
      real(wp), intent(out), contiguous :: rate(:) !! (n_event) its rate [any]

      g = self%side*(y(1) - 0.5_wp)
      rate = self%side*(cos(t) - merge(self%decay, 1.0_wp, t >= self%from .and. t <= self%to)*(y(1) - sin(t)))
   end subroutine crossing_events

end module stiff_examples
