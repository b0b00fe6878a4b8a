!> Events whose functions have noise far above the spacing of time: each once, together where they are so, none on the way off.
module test_event_noise
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use integrator, only: advance_event, integrator_t
   use integrator_registry, only: find_integrator
   use kinds, only: eps, pi, wp
   use ode_examples, only: new_particles, particles_t
   implicit none (type, external)
   private
   public :: run_test_event_noise

   integer, parameter :: n_wall = 30         !! walls at one place
   integer, parameter :: most_steps = 20000  !! more are an endless loop
   character(6), parameter :: methods(6) = [character(6) :: "verner", "dop853", "rk4", "adams", "bdf", "ida"]  !! the methods

   !> Particles whose distances from walls are differences of large numbers.
   type, extends(particles_t) :: distant_t
      real(wp), allocatable :: far(:)   !! (n_event) how far the origin is, as each wall sees it [m]
   contains
      procedure :: events => distant_events
      procedure :: event_noise => distant_event_noise
   end type distant_t

   !> What happened in a run.
   type :: description_t
      integer :: n_event = 0                    !! events
      integer :: count(n_wall) = 0              !! (walls) events of each
      real(wp) :: error = 0.0_wp                !! maximum distance of an event from the nearest crossing [s]
      real(wp) :: min_rate = huge(1.0_wp)     !! minimum rate of a function at its event [m/s]
      integer :: n_meeting = 0                  !! steps that ended at events
      logical :: is_complete = .false.          !! the end was reached
   end type description_t

contains

   subroutine run_test_event_noise(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("walls_at_one_place", test_walls_at_one_place)
      call suite%test("parting_in_the_noise", test_parting)
      call suite%test("approaching_in_the_noise", test_approaching)
   end subroutine run_test_event_noise

   subroutine distant_events(self, t, y, g, rate)
      class(distant_t), intent(inout) :: self     !! the system
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(in) :: y(:)                !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)               !! (n_event) distance beyond the wall [m]
      real(wp), intent(out), contiguous :: rate(:)            !! (n_event) its rate [m/s]

      g = self%side*((y(self%subject) + self%far) - (self%wall + self%far))
      rate = self%side*y(self%n_position + self%subject)
   end subroutine distant_events

   subroutine distant_event_noise(self, noise)
      class(distant_t), intent(in) :: self   !! the system
      real(wp), intent(out) :: noise(:)      !! (n_event) bounds [m]

      noise = 4.0_wp*eps*(self%far + abs(self%wall) + 1.0_wp)
   end subroutine distant_event_noise

   !> A system with walls at one place, each observed from afar in its own way.
   subroutine new_distant(pull, stiffness, wall, system)
      real(wp), intent(in) :: pull, stiffness    !! of the particle [m/s^2, 1/s^2]
      real(wp), intent(in) :: wall               !! place of the walls [m]
      type(distant_t), intent(out) :: system     !! the system

      integer :: k

      call new_particles([pull], [stiffness], [(1, k=1, n_wall)], [(wall, k=1, n_wall)], [(1.0_wp, k=1, n_wall)], &
                         system%particles_t)
      system%far = [(1.0e3_wp*real(k, wp)**1.7_wp/pi, k=1, n_wall)]
   end subroutine new_distant

   !> Run to the end. At an event the particle continues through the wall: the function changes its sign.
   subroutine follow(system, y, t_end, crossings, method, description)
      type(distant_t), intent(inout) :: system       !! the system
      real(wp), intent(in) :: y(:)                   !! (n) state at t = 0 [any]
      real(wp), intent(in) :: t_end                  !! end [s]
      real(wp), intent(in) :: crossings(:)           !! (any) when the wall is crossed [s]
      class(integrator_t), intent(inout) :: method   !! the integrator, with its controls
      type(description_t), intent(out) :: description            !! what happened

      real(wp) :: g(n_wall), rate(n_wall)
      integer :: i, k, status

      call method%start(system, 0.0_wp, y, t_end, status)
      do i = 1, most_steps
         if (status < 0 .or. method%t >= t_end) exit
         call method%advance(system, t_end, status)
         if (status /= advance_event) cycle
         call system%events(method%t, method%step%y1, g, rate)
         description%n_meeting = description%n_meeting + 1
         do k = 1, method%events%n_happened
            associate (number => method%events%happened(k))
               description%n_event = description%n_event + 1
               description%count(number) = description%count(number) + 1
               description%min_rate = min(description%min_rate, rate(number))
               description%error = max(description%error, minval(abs(crossings - method%t)))
               system%side(number) = -system%side(number)
            end associate
         end do
         call method%restart(system, 0.0_wp, status)
      end do
      description%is_complete = method%t >= t_end .and. status >= 0
   end subroutine follow

   !> A method by its name, with a small error.
   subroutine make(name, method)
      character(*), intent(in) :: name                            !! the method
      class(integrator_t), allocatable, intent(out) :: method     !! the integrator

      call find_integrator(trim(name), method)
      method%controls%tolerance = 1.0e-9_wp
      if (name == "rk4") method%controls%fixed_step = 0.01_wp
   end subroutine make

   !> x = sin t through thirty walls at 1/2, four times.
   subroutine test_walls_at_one_place(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(distant_t) :: system
      type(description_t) :: description
      integer :: i

      do i = 1, size(methods)
         call make(methods(i), method)
         call new_distant(0.0_wp, 1.0_wp, 0.5_wp, system)
         call follow(system, [0.0_wp, 1.0_wp], 10.0_wp, [1.0_wp, 5.0_wp, 13.0_wp, 17.0_wp]*pi/6.0_wp, method, description)
         call check_true(error, description%is_complete, methods(i)//": comes to its end")
         call check_true(error, all(description%count == 4), methods(i)//": each wall at each crossing once")
         call check_true(error, description%min_rate > 0.0_wp, methods(i)//": functions rise at their events")
         call check_close(error, description%error, 0.0_wp, 1.0e-6_wp, methods(i)//": times")
         ! the place of the noisiest may be a step off for the others
         call check_true(error, description%n_meeting <= 8, methods(i)//": together")
      end do
   end subroutine test_walls_at_one_place

   !> A particle that leaves the walls has no event, however its last digits lie, until it comes back.
   subroutine test_parting(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(distant_t) :: system
      type(description_t) :: description
      integer :: i, k

      do i = 1, size(methods)
         do k = 0, 6
            call make(methods(i), method)
            method%controls%initial_step = 0.1_wp**(2*k)
            call new_distant(1.0_wp, 0.0_wp, 1.0_wp/3.0_wp, system)
            call follow(system, [1.0_wp/3.0_wp, -1.0_wp], 3.0_wp, [2.0_wp], method, description)
            call check_true(error, description%is_complete, methods(i)//": comes to its end")
            call check_true(error, all(description%count == 1), methods(i)//": each wall once, on the way back")
            call check_close(error, description%error, 0.0_wp, 1.0e-7_wp, methods(i)//": time")
         end do
      end do
   end subroutine test_parting

   !> One that starts at the walls and approaches is at its events at once.
   subroutine test_approaching(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(distant_t) :: system
      type(description_t) :: description
      integer :: i

      do i = 1, size(methods)
         call make(methods(i), method)
         call new_distant(0.0_wp, 0.0_wp, 1.0_wp/3.0_wp, system)
         call follow(system, [1.0_wp/3.0_wp, 1.0_wp], 1.0_wp, [0.0_wp], method, description)
         call check_true(error, description%is_complete, methods(i)//": comes to its end")
         call check_true(error, all(description%count == 1), methods(i)//": each wall once")
         call check_close(error, description%error, 0.0_wp, 1.0e-9_wp, methods(i)//": at once")
      end do
   end subroutine test_approaching

end module test_event_noise
