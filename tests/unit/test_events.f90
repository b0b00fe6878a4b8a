!> Events: each once, in order, as accurate as the step that leads to it.
module test_events
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use event_description, only: check_description, run_through, description_t
   use kinds, only: pi, wp
   use ode_examples, only: new_particles, particles_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_events

contains

   subroutine run_test_events(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("uniform_motion", test_uniform_motion)
      call suite%test("falling_ball", test_falling_ball)
      call suite%test("bouncing_ball", test_bouncing_ball)
      call suite%test("spring", test_spring)
      call suite%test("many_springs", test_many_springs)
      call suite%test("two_in_one_step", test_two_in_one_step)
      call suite%test("simultaneous", test_simultaneous)
      call suite%test("fixed_steps", test_fixed_steps)
      call suite%test("at_the_end_of_a_step", test_at_the_end_of_a_step)
   end subroutine run_test_events

   subroutine test_uniform_motion(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(description_t) :: description

      call new_particles([0.0_wp], [0.0_wp], [1], [0.3_wp], [1.0_wp], system)
      call run_through(system, [0.0_wp, 0.7_wp], 1.0_wp, method, description)
      call check_description(error, description, 1, 1.0e-16_wp, "uniform motion")
      call check_close(error, description%time(1), 0.3_wp/0.7_wp, 1.0e-15_wp, "time", relative=.true.)
      call check_true(error, description%n_step < 20, "few steps")
   end subroutine test_uniform_motion

   !> From 3 m at 9.81 m/s^2, whatever the tolerance: the path is a polynomial.
   subroutine test_falling_ball(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      integer :: k

      do k = 2, 12, 2
         allocate (method)
         method%controls%tolerance = 0.1_wp**k
         call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
         call run_through(system, [3.0_wp, 0.0_wp], 2.0_wp, method, description)
         call check_description(error, description, 1, 2.0e-15_wp, "falling ball")
         call check_close(error, description%time(1), sqrt(6.0_wp/9.81_wp), 1.0e-15_wp, "time", relative=.true.)
         deallocate (method)
      end do
   end subroutine test_falling_ball

   !> A ball that keeps 0.9 of its speed: twenty bounces, at sqrt(2 h/g) (1 + 2 e + 2 e^2 + ...).
   subroutine test_bouncing_ball(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: restitution = 0.9_wp, first = sqrt(6.0_wp/9.81_wp)
      type(particles_t) :: system
      type(verner_t) :: method
      type(description_t) :: description
      real(wp) :: time
      integer :: k

      call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
      time = first*(1.0_wp + 2.0_wp*sum([(restitution**k, k=1, 19)]))
      call run_through(system, [3.0_wp, 0.0_wp], time + 0.01_wp, method, description, restitution)
      call check_description(error, description, 20, 1.0e-14_wp, "bouncing ball")
      call check_close(error, description%time(20), time, 1.0e-13_wp, "twentieth bounce", relative=.true.)
      call check_true(error, description%n_step < 200, "few steps")
   end subroutine test_bouncing_ball

   !> x = sin t through a wall at 1/2: the state at an event is on the wall to round-off at any
   !> tolerance, the time as accurate as the motion.
   subroutine test_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: sixth = pi/6.0_wp
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      integer :: k

      do k = 2, 12, 2
         allocate (method)
         method%controls%tolerance = 0.1_wp**k
         call new_particles([0.0_wp], [1.0_wp], [1], [0.5_wp], [1.0_wp], system)
         call run_through(system, [0.0_wp, 1.0_wp], 10.0_wp, method, description)
         call check_description(error, description, 4, 4.0e-16_wp, "spring")
         call check_close(error, description%time(1:4), [1.0_wp, 5.0_wp, 13.0_wp, 17.0_wp]*sixth, 10.0_wp*0.1_wp**k + 2.0e-15_wp, &
                          "times")
         deallocate (method)
      end do
   end subroutine test_spring

   !> Two walls in one step; the first comes first, whatever its number.
   subroutine test_two_in_one_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: gap(5) = [0.3_wp, 0.02_wp, 1.0e-4_wp, 1.0e-8_wp, 1.0e-12_wp]
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      integer :: i, k

      do k = 1, size(gap)
         do i = 1, 2
            allocate (method)
            method%controls%initial_step = 1.0_wp
            call new_particles([0.0_wp], [0.0_wp], [1, 1], [0.41_wp, 0.41_wp + gap(k)], [1.0_wp, 1.0_wp], system)
            if (i == 2) system%wall = system%wall(2:1:-1)
            call run_through(system, [0.0_wp, 1.0_wp], 1.0_wp, method, description)
            call check_description(error, description, 2, 2.0e-16_wp, "two in one step")
            call check_close(error, description%time(1:2), [0.41_wp, 0.41_wp + gap(k)], 1.0e-15_wp, "times")
            if (gap(k) > 5.0e-9_wp) call check_equal(error, description%number(1), i, "the first")
            call check_true(error, description%n_step <= 5, "few steps")
            deallocate (method)
         end do
      end do
   end subroutine test_two_in_one_step

   !> Walls met at one instant are one event each, near the origin and far from it, where the last
   !> digits of the event functions are noise.
   subroutine test_simultaneous(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: far, time
      integer :: i, k

      do i = 0, 100
         far = 17.3_wp*i
         time = sqrt(1.2_wp + 0.01_wp*i)
         allocate (method)
         call new_particles([-1.0_wp, 0.0_wp, 2.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], [1, 1, 2, 3], &
                            [far, far, far + time, far + time**2], [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp], system)
         call run_through(system, [far + 0.5_wp*time**2, far, far, 0.0_wp, 1.0_wp, 0.0_wp], 2.0_wp, method, description)
         call check_description(error, description, 4, 1.0e-15_wp*max(far, 1.0_wp), "simultaneous")
         call check_close(error, description%time(1:4), [(time, k=1, 4)], 2.0e-15_wp*max(far, 1.0_wp), "times")
         call check_true(error, all([(any(description%number(1:4) == k), k=1, 4)]), "each of them once")
         call check_true(error, description%n_step < 20, "few steps")
         deallocate (method)
      end do
   end subroutine test_simultaneous

   !> Events within fixed steps; the grid continues from the event.
   subroutine test_fixed_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(description_t) :: description

      method%controls%fixed_step = 0.1_wp
      call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
      call run_through(system, [3.0_wp, 0.0_wp], 1.0_wp, method, description)
      call check_description(error, description, 1, 2.0e-15_wp, "fixed steps")
      call check_close(error, description%time(1), sqrt(6.0_wp/9.81_wp), 1.0e-15_wp, "time", relative=.true.)
      call check_equal(error, description%n_step, 11, "steps: 7 and a part, then 2 and a part")
   end subroutine test_fixed_steps

   !> The event falls on the end of a step, where its function is exactly zero.
   subroutine test_at_the_end_of_a_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(description_t) :: description

      method%controls%fixed_step = 0.25_wp
      call new_particles([0.0_wp], [0.0_wp], [1], [0.5_wp], [1.0_wp], system)
      call run_through(system, [0.0_wp, 1.0_wp], 1.0_wp, method, description)
      call check_description(error, description, 1, 2.0e-16_wp, "at the end of a step")
      call check_close(error, description%time(1), 0.5_wp, 1.0e-15_wp, "time")
   end subroutine test_at_the_end_of_a_step

   !> Springs of all sorts with a wall each: every crossing is an event, at the time that arc sines give.
   subroutine test_many_springs(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 6, n_case = 20
      real(wp), parameter :: t_end = 20.0_wp
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: frequency(n), phase(n), wall(n), y(2*n)
      real(wp), allocatable :: times(:)
      integer :: k, trial

      do trial = 1, n_case
         ! numbers without a pattern
         frequency = [(0.5_wp + modulo(0.7548776662466927_wp*(k + 17*trial), 1.0_wp)*2.5_wp, k=1, n)]
         phase = [(modulo(0.5698402909980532_wp*(k + 31*trial), 1.0_wp)*6.0_wp, k=1, n)]
         wall = [(modulo(0.8191725133961645_wp*(k + 13*trial), 1.0_wp)*1.9_wp - 0.95_wp, k=1, n)]
         y = [sin(phase), frequency*cos(phase)]
         call new_particles([(0.0_wp, k=1, n)], frequency**2, [(k, k=1, n)], wall, sign(1.0_wp, wall - sin(phase)), system)
         allocate (method)
         method%controls%tolerance = 1.0e-10_wp
         call run_through(system, y, t_end, method, description)
         times = crossings()
         call check_description(error, description, size(times), 1.0e-13_wp, "many springs")
         if (allocated(error)) return
         call check_close(error, description%time(:size(times)), times, 1.0e-6_wp, "times")
         deallocate (method)
      end do

   contains

      !> Times of all crossings, in order.
      function crossings() result(list)
         real(wp), allocatable :: list(:)  !! (crossings) times [s]

         real(wp) :: angle
         integer :: i, side, turn

         allocate (list(0))
         do i = 1, n
            do side = 0, 1
               do turn = -1, 12
                  angle = merge(asin(wall(i)), pi - asin(wall(i)), side == 0) + 2.0_wp*pi*turn
                  associate (time => (angle - phase(i))/frequency(i))
                     if (time > 0.0_wp .and. time < t_end) list = [pack(list, list < time), time, pack(list, list >= time)]
                  end associate
               end do
            end do
         end do
      end function crossings

   end subroutine test_many_springs

end module test_events
