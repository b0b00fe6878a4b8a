!> The hooks of a system: the step is reported, the states given out are held, by every method of the registry.
module test_hold
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use integrator, only: advance_event, advance_failed_evaluation, integrator_t
   use integration_method, only: abilities_t, steps_fixed
   use integrator_registry, only: n_integrator_kinds, new_integrator
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: run_test_hold

   real(wp), parameter :: t_end = 20.0_wp  !! of the runs [s]

   !> A point on the unit circle, x' = -f y, y' = f x with f = 1 + p (r^2 - 1): off the circle its speed is another one.
   !> An event is a rise of x through a wall.
   type, extends(ode_system_t) :: circle_t
      real(wp) :: pull = 0.0_wp          !! p [1]
      real(wp) :: wall = 2.0_wp          !! place of the wall [m]
      real(wp) :: last = huge(1.0_wp)    !! time after which a state cannot be held [s]
      integer :: failure = 0             !! status then
      integer :: n_hold = 0              !! calls of hold
      integer :: n_set = 0               !! calls of set_step
      real(wp) :: told = 0.0_wp          !! the last step reported [s]
   contains
      procedure :: evaluate => circle_evaluate
      procedure :: weights => circle_weights
      procedure :: events => circle_events
      procedure :: set_step => circle_set_step
      procedure :: hold => circle_hold
   end type circle_t

contains

   subroutine run_test_hold(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("states_are_held", test_states_are_held)
      call suite%test("held_before_the_derivative", test_derivative)
      call suite%test("events_refer_to_held_states", test_events)
      call suite%test("steps_are_told", test_steps_are_told)
      call suite%test("hold_that_fails", test_failure)
   end subroutine run_test_hold

   subroutine circle_evaluate(self, t, y, ydot, status)
      class(circle_t), intent(inout) :: self         !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      real(wp) :: speed

      speed = 1.0_wp + self%pull*(sum(y**2) - 1.0_wp)
      ydot = speed*[-y(2), y(1)]
      status = 0
   end subroutine circle_evaluate

   subroutine circle_weights(self, y, scale)
      class(circle_t), intent(in) :: self    !! the system
      real(wp), intent(in) :: y(self%n)           !! (n) state [any]
      real(wp), intent(out) :: scale(self%n)      !! (n) scales [any]

      scale = 1.0_wp
   end subroutine circle_weights

   subroutine circle_events(self, t, y, g, rate)
      class(circle_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                !! time [s]
      real(wp), intent(in) :: y(:)             !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)            !! (1) distance beyond the wall [m]
      real(wp), intent(out), contiguous :: rate(:)         !! (1) its rate [m/s]

      g = y(1) - self%wall
      rate = -y(2)
   end subroutine circle_events

   subroutine circle_set_step(self, h)
      class(circle_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: h                !! length of the step [s]

      self%n_set = self%n_set + 1
      self%told = h
   end subroutine circle_set_step

   !> Back onto the circle along the radius.
   subroutine circle_hold(self, t, y, status)
      class(circle_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                !! time [s]
      real(wp), intent(inout) :: y(:)          !! (n) state [any]
      integer, intent(out) :: status           !! outcome

      self%n_hold = self%n_hold + 1
      status = merge(self%failure, 0, t > self%last)
      if (status == 0) y = y/norm2(y)
   end subroutine circle_hold

   !> A circle and a method of the registry at its start, tolerance 1e-6 or two hundred steps.
   subroutine begin(k, holds, wall, system, method, name)
      integer, intent(in) :: k                                    !! number of the method
      logical, intent(in) :: holds                                !! whether states are held
      real(wp), intent(in) :: wall                                !! place of the wall [m]
      type(circle_t), intent(inout) :: system                     !! the system
      class(integrator_t), allocatable, intent(out) :: method     !! the integrator, started
      character(:), allocatable, intent(out) :: name              !! its name

      type(abilities_t) :: can
      type(kind_info_t) :: info
      integer :: status

      system%n = 2
      system%n_position = 0
      system%n_event = 1
      system%holds = holds
      system%wall = wall
      call new_integrator(k, method)
      info = method%info()
      name = info%name
      method%controls%tolerance = 1.0e-6_wp
      can = method%abilities()
      if (can%steps == steps_fixed) method%controls%fixed_step = 0.1_wp
      call method%start(system, 0.0_wp, [1.0_wp, 0.0_wp], t_end, status)
   end subroutine begin

   !> The radius at every accepted state and at states within steps; without hold it drifts.
   subroutine test_states_are_held(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      character(:), allocatable :: name
      type(circle_t) :: system
      real(wp) :: drift, inner(2)
      integer :: k, status

      do k = 1, n_integrator_kinds()
         system%pull = 0.0_wp
         call begin(k, .true., 2.0_wp, system, method, name)
         do while (method%t < t_end)
            call method%advance(system, t_end, status)
            call check_equal(error, status, 0, name//": status")
            if (allocated(error)) return
            call check_close(error, norm2(method%step%y1), 1.0_wp, 4.0e-16_wp, name//": radius at the end of a step")
            call method%refine(system, 0.4_wp, inner, status)
            call check_close(error, norm2(inner), 1.0_wp, 4.0e-16_wp, name//": radius within")
         end do
         call check_close(error, method%step%y1, [cos(t_end), sin(t_end)], 1.0e-3_wp, name//": state at the end")
         call begin(k, .false., 2.0_wp, system, method, name)
         system%n_hold = 0
         drift = 0.0_wp
         do while (method%t < t_end)
            call method%advance(system, t_end, status)
            drift = max(drift, abs(norm2(method%step%y1) - 1.0_wp))
         end do
         call check_true(error, drift > 1.0e-8_wp, name//": the radius drifts if it is not held")
         call check_equal(error, system%n_hold, 0, name//": hold is not called")
      end do
   end subroutine test_states_are_held

   !> The derivative at the end of a step is that of the held state: its speed is one, whatever happens off the circle.
   subroutine test_derivative(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      character(:), allocatable :: name
      type(circle_t) :: system
      integer :: k, status

      do k = 1, n_integrator_kinds()
         system%pull = 1.0e3_wp
         call begin(k, .true., 2.0_wp, system, method, name)
         do while (method%t < 1.0_wp)
            call method%advance(system, 1.0_wp, status)
            call check_close(error, method%step%f1, [-method%step%y1(2), method%step%y1(1)], 1.0e-12_wp, name//": derivative")
         end do
      end do
   end subroutine test_derivative

   !> x rises through a wall once a turn: on the circle and on the wall, at the time that the arc cosine gives.
   subroutine test_events(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: wall = 0.6_wp
      class(integrator_t), allocatable :: method
      character(:), allocatable :: name
      type(circle_t) :: system
      integer :: k, n_event, status

      do k = 1, n_integrator_kinds()
         system%pull = 0.0_wp
         call begin(k, .true., 2.0_wp, system, method, name)
         ! from the left of the circle, so that the first event is a rise
         call method%start(system, 0.0_wp, [-1.0_wp, 0.0_wp], t_end, status)
         system%wall = wall
         call method%restart(system, 0.0_wp, status)
         n_event = 0
         do while (method%t < t_end)
            call method%advance(system, t_end, status)
            call check_true(error, status >= 0, name//": status")
            if (allocated(error)) return
            if (status /= advance_event) cycle
            n_event = n_event + 1
            call check_close(error, norm2(method%step%y1), 1.0_wp, 4.0e-16_wp, name//": radius at an event")
            if (modulo(n_event, 2) == 1) then
               call check_close(error, method%step%y1(1), wall, 1.0e-14_wp, name//": on the wall")
               call check_close(error, method%t, pi - acos(wall) + pi*(n_event - 1), 1.0e-3_wp, name//": time of the event")
               ! continue beyond the wall: the next event is the wall on the other side of the turn
               system%wall = 2.0_wp
               call method%restart(system, 0.0_wp, status)
               call pass(method, system, status)
               system%wall = wall
               call method%restart(system, 0.0_wp, status)
               n_event = n_event + 1
            end if
         end do
         call check_equal(error, n_event, 6, name//": three turns")
      end do

   contains

      !> Half a turn on, without a wall.
      subroutine pass(method, system, status)
         class(integrator_t), intent(inout) :: method   !! the integrator
         type(circle_t), intent(inout) :: system        !! the system
         integer, intent(out) :: status                 !! of the last step

         real(wp) :: stop

         stop = method%t + pi
         do while (method%t < stop)
            call method%advance(system, stop, status)
         end do
      end subroutine pass

   end subroutine test_events

   !> Every step is reported before it is made; of a step that is accepted at once it is the length.
   subroutine test_steps_are_told(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      character(:), allocatable :: name
      type(circle_t) :: system
      real(wp) :: told
      integer :: k, n_right, status

      do k = 1, n_integrator_kinds()
         system%pull = 0.0_wp
         call begin(k, .false., 2.0_wp, system, method, name)
         system%n_set = 0
         n_right = 0
         do while (method%t < t_end)
            call method%advance(system, t_end, status)
            told = system%told
            if (abs(told - method%step%h) <= 1.0e-9_wp*method%step%h) n_right = n_right + 1
         end do
         call check_true(error, system%n_set >= method%count%n_steps, name//": told for every step")
         call check_true(error, n_right >= 9*method%count%n_steps/10, name//": told the right length")
      end do
   end subroutine test_steps_are_told

   !> A state that cannot be held ends the run there, whether it may be tried again or not.
   subroutine test_failure(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      character(:), allocatable :: name
      type(circle_t) :: system
      integer :: failure, k, status

      do k = 1, n_integrator_kinds()
         do failure = -1, 1, 2
            system%pull = 0.0_wp
            call begin(k, .true., 2.0_wp, system, method, name)
            system%last = 3.0_wp
            system%failure = failure
            status = 0
            do while (method%t < t_end .and. status >= 0)
               call method%advance(system, t_end, status)
            end do
            call check_true(error, status < 0, name//": the run ends")
            if (failure < 0) call check_equal(error, status, advance_failed_evaluation, name//": for good")
            call check_true(error, method%t <= 3.0_wp .and. method%t > 2.0_wp, name//": just before the state that cannot be held")
            call check_close(error, norm2(method%step%y1), 1.0_wp, 4.0e-16_wp, name//": the last good state stands")
            system%last = huge(1.0_wp)
         end do
      end do
   end subroutine test_failure

end module test_hold
