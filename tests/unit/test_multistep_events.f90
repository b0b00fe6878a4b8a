!> Events by the multistep methods: none missed, each once, on the wall to round-off, as accurate as the motion.
module test_multistep_events
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use event_description, only: check_description, run_through, description_t
   use integrator, only: advance_too_many_evaluations, advance_too_many_steps, advance_too_small, integrator_t
   use integrator_controls, only: controls_t
   use integrator_registry, only: find_integrator
   use kinds, only: i8, pi, wp
   use ode_examples, only: kepler_t, new_kepler, new_particles, particles_t, run_to
   implicit none (type, external)
   private
   public :: run_test_multistep_events

   character(6), parameter :: methods(3) = [character(6) :: "adams", "bdf", "ida"]  !! the methods

contains

   subroutine run_test_multistep_events(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("times_follow_the_tolerance", test_spring)
      call suite%test("bouncing_ball", test_bouncing_ball)
      call suite%test("in_and_out_within_a_step", test_in_and_out)
      call suite%test("simultaneous", test_simultaneous)
      call suite%test("start_on_the_wall", test_start_on_the_wall)
      call suite%test("controls", test_controls)
      call suite%test("checkpoint", test_checkpoint)
   end subroutine run_test_multistep_events

   !> x = sin t through a wall at 1/2: the times are as accurate as the motion.
   subroutine test_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(particles_t) :: system
      type(description_t) :: description
      real(wp) :: errors(4)
      integer :: i, k

      do i = 1, size(methods)
         do k = 1, size(errors)
            call find_integrator(trim(methods(i)), method)
            method%controls%tolerance = 0.01_wp**(k + 1)
            call new_particles([0.0_wp], [1.0_wp], [1], [0.5_wp], [1.0_wp], system)
            call run_through(system, [0.0_wp, 1.0_wp], 10.0_wp, method, description)
            call check_description(error, description, 4, 1.0e-14_wp, methods(i)//": spring")
            errors(k) = maxval(abs(description%time(1:4) - [1.0_wp, 5.0_wp, 13.0_wp, 17.0_wp]*pi/6.0_wp))
            call check_true(error, errors(k) < 300.0_wp*0.01_wp**(k + 1), methods(i)//": times")
         end do
         call check_true(error, all(errors(2:) < errors(:3)/8.0_wp), methods(i)//": they follow the tolerance")
      end do
   end subroutine test_spring

   !> A ball that keeps 0.9 of its speed: ten bounces, at sqrt(2 h/g) (1 + 2 e + 2 e^2 + ...).
   subroutine test_bouncing_ball(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: restitution = 0.9_wp, first = sqrt(6.0_wp/9.81_wp)
      class(integrator_t), allocatable :: method
      type(particles_t) :: system
      type(description_t) :: description
      real(wp) :: time
      integer :: i, k

      time = first*(1.0_wp + 2.0_wp*sum([(restitution**k, k=1, 9)]))
      do i = 1, size(methods)
         call find_integrator(trim(methods(i)), method)
         method%controls%tolerance = 1.0e-8_wp
         call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
         call run_through(system, [3.0_wp, 0.0_wp], time + 0.01_wp, method, description, restitution)
         call check_description(error, description, 10, 1.0e-13_wp, methods(i)//": bouncing ball")
         call check_close(error, description%time(1), first, 1.0e-7_wp, methods(i)//": first bounce", relative=.true.)
         call check_close(error, description%time(10), time, 1.0e-6_wp, methods(i)//": tenth bounce", relative=.true.)
      end do
   end subroutine test_bouncing_ball

   !> Two visits above the wall that are short against the steps.
   subroutine test_in_and_out(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: depth = 1.0e-5_wp
      class(integrator_t), allocatable :: method
      type(particles_t) :: system
      type(description_t) :: description
      real(wp) :: half
      integer :: i

      half = acos(1.0_wp - depth)
      do i = 1, size(methods)
         call find_integrator(trim(methods(i)), method)
         method%controls%tolerance = 1.0e-9_wp
         call new_particles([0.0_wp], [1.0_wp], [1], [1.0_wp - depth], [1.0_wp], system)
         call run_through(system, [0.0_wp, 1.0_wp], 10.0_wp, method, description)
         call check_description(error, description, 4, 1.0e-14_wp, methods(i)//": in and out")
         call check_close(error, description%time(1:4), 0.5_wp*pi + [-half, half, 2.0_wp*pi - half, 2.0_wp*pi + half], 2.0e-5_wp, &
                          methods(i)//": times")
      end do
   end subroutine test_in_and_out

   !> Walls met at one instant are one event each.
   subroutine test_simultaneous(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(particles_t) :: system
      type(description_t) :: description
      integer :: i, k

      do i = 1, size(methods)
         call find_integrator(trim(methods(i)), method)
         call new_particles([-1.0_wp, 0.0_wp, 2.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], [1, 1, 2, 3], &
                            [0.0_wp, 0.0_wp, 1.1_wp, 1.21_wp], [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp], system)
         call run_through(system, [0.605_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], 2.0_wp, method, description)
         call check_equal(error, description%n_event, 4, methods(i)//": events")
         call check_close(error, description%time(1:4), [(1.1_wp, k=1, 4)], 1.0e-6_wp, methods(i)//": times")
         call check_true(error, all([(any(description%number(1:4) == k), k=1, 4)]), methods(i)//": each of them once")
         call check_true(error, description%is_complete, methods(i)//": comes to its end")
      end do
   end subroutine test_simultaneous

   !> An event just handled leaves its function at zero: no second event on the way off.
   subroutine test_start_on_the_wall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: place(3) = [1.0e-18_wp, 0.0_wp, -1.0e-18_wp]
      class(integrator_t), allocatable :: method
      type(particles_t) :: system
      type(description_t) :: description
      integer :: i, k

      do i = 1, size(methods)
         do k = 1, 3
            call find_integrator(trim(methods(i)), method)
            call new_particles([1.0_wp], [0.0_wp], [1], [0.0_wp], [1.0_wp], system)
            call run_through(system, [place(k), -1.0_wp], 3.0_wp, method, description)
            call check_equal(error, description%n_event, 1, methods(i)//": event on the way back")
            call check_close(error, description%time(1), 2.0_wp, 1.0e-6_wp, methods(i)//": its time")
            call check_true(error, description%is_complete, methods(i)//": comes to its end")
         end do
      end do
   end subroutine test_start_on_the_wall

   !> First, minimum and maximum step, and the limits of the work.
   subroutine test_controls(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(kepler_t) :: system
      real(wp) :: longest, y(4)
      integer :: i, status

      call new_kepler(0.5_wp, system, y)
      do i = 1, size(methods)
         call begin(controls_t(initial_step=1.234e-6_wp))
         call method%advance(system, 10.0_wp, status)
         call check_close(error, method%t, 1.234e-6_wp, 1.0e-12_wp, methods(i)//": first step", relative=.true.)
         call begin(controls_t(tolerance=1.0e-3_wp, maximum_step=0.02_wp))
         longest = 0.0_wp
         do while (method%t < 3.0_wp .and. status >= 0)
            call method%advance(system, 3.0_wp, status)
            longest = max(longest, method%step%h)
         end do
         call check_close(error, longest, 0.02_wp, 1.0e-10_wp, methods(i)//": longest step")
         call begin(controls_t(tolerance=1.0e-10_wp, minimum_step=0.05_wp))
         call run_to(method, system, 10.0_wp, status)
         call check_equal(error, status, advance_too_small, methods(i)//": least step")
         call begin(controls_t(maximum_steps=7_i8))
         call run_to(method, system, 10.0_wp, status)
         call check_equal(error, status, advance_too_many_steps, methods(i)//": too many steps")
         call check_equal(error, int(method%count%n_steps), 7, methods(i)//": steps")
         call begin(controls_t(maximum_evaluations=100_i8))
         call run_to(method, system, 10.0_wp, status)
         call check_equal(error, status, advance_too_many_evaluations, methods(i)//": too many evaluations")
         call check_true(error, method%count%n_evaluations <= 100 .and. method%count%n_evaluations > 90, &
                         methods(i)//": evaluations")
         call check_close(error, method%step%y1, system%exact(method%t), 1.0e-5_wp, methods(i)//": state before the failure")
      end do

   contains

      !> A planet at its pericentre, with an integrator started.
      subroutine begin(controls)
         type(controls_t), intent(in) :: controls   !! controls

         call find_integrator(trim(methods(i)), method)
         method%controls = controls
         call method%start(system, 0.0_wp, y, 10.0_wp, status)
      end subroutine begin

   end subroutine test_controls

   !> A checkpoint holds no history: what continues from it is the same every time, and agrees with the run that was not
   !> interrupted to the tolerance.
   subroutine test_checkpoint(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method, other
      type(kepler_t) :: system
      type(archive_t) :: archive, saved
      real(wp) :: resumed(4, 2), y(4)
      integer :: i, k, status

      call new_kepler(0.5_wp, system, y)
      do i = 1, size(methods)
         call find_integrator(trim(methods(i)), method)
         call method%start(system, 0.0_wp, y, 5.0_wp, status)
         call run_to(method, system, 2.5_wp, status)
         saved = archive_t()
         call method%save(saved)
         do k = 1, 2
            call find_integrator(trim(methods(i)), other)
            call other%start(system, 0.0_wp, y, 5.0_wp, status)
            ! the second is loaded in the middle of a run of its own
            if (k == 2) call run_to(other, system, 1.0_wp, status)
            archive = saved
            call other%load(archive)
            call check_true(error, archive%is_at_end(), methods(i)//": as many numbers loaded as saved")
            call check_equal(error, int(other%count%n_steps), int(method%count%n_steps), methods(i)//": steps so far")
            call check_close(error, other%t, 2.5_wp, 0.0_wp, methods(i)//": time")
            call run_to(other, system, 5.0_wp, status)
            resumed(:, k) = other%step%y1
         end do
         call run_to(method, system, 5.0_wp, status)
         call check_close(error, resumed(:, 2), resumed(:, 1), 0.0_wp, methods(i)//": goes on the same every time")
         call check_close(error, resumed(:, 1), method%step%y1, 1.0e-5_wp, methods(i)//": goes on as if not interrupted")
         call check_close(error, resumed(:, 1), system%exact(5.0_wp), 1.0e-5_wp, methods(i)//": exact state")
      end do
   end subroutine test_checkpoint

end module test_multistep_events
