!> Events: none missed, none made up, each as accurate as the step that leads to it.
module test_events
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use integrator, only: advance_event
   use kinds, only: pi, wp
   use ode_examples, only: new_particles, particles_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_events

   integer, parameter :: most_steps = 2000  !! more are an endless loop

   !> What happened in a run.
   type :: story_t
      integer :: n_step = 0                       !! steps
      integer :: n_event = 0                      !! events
      integer :: number(most_steps) = 0           !! (events) number of the function
      real(wp) :: time(most_steps) = 0.0_wp       !! (events) when [s]
      real(wp) :: residual = 0.0_wp               !! greatest |g| at an event [m]
      real(wp) :: overlap = 0.0_wp                !! greatest g at the end of a step without event [m]
      logical :: is_complete = .false.            !! the end was reached
   end type story_t

contains

   subroutine run_test_events(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("uniform_motion", test_uniform_motion)
      call suite%test("falling_ball", test_falling_ball)
      call suite%test("bouncing_ball", test_bouncing_ball)
      call suite%test("spring", test_spring)
      call suite%test("in_and_out_within_a_step", test_in_and_out)
      call suite%test("grazing_by_a_nanometre", test_grazing)
      call suite%test("grazing_of_a_spring", test_grazing_spring)
      call suite%test("touching_only", test_touching)
      call suite%test("two_in_one_step", test_two_in_one_step)
      call suite%test("brief_one_before_another", test_brief_before_another)
      call suite%test("simultaneous", test_simultaneous)
      call suite%test("start_on_the_wall", test_start_on_the_wall)
      call suite%test("leaving_for_ever", test_leaving_for_ever)
      call suite%test("zero_for_ever", test_zero_for_ever)
      call suite%test("fixed_steps", test_fixed_steps)
      call suite%test("at_the_end_of_a_step", test_at_the_end_of_a_step)
   end subroutine run_test_events

   !> Run to the end. At an event the particle goes on through the wall: the function changes its sign.
   subroutine run_through(system, y, t_end, method, story, restitution)
      type(particles_t), intent(inout) :: system         !! the system
      real(wp), intent(in) :: y(:)                       !! (n) state at t = 0 [any]
      real(wp), intent(in) :: t_end                      !! end [s]
      type(verner_t), intent(inout) :: method            !! the integrator, with its controls
      type(story_t), intent(out) :: story                !! what happened
      real(wp), intent(in), optional :: restitution      !! the particles bounce instead of going on [1]

      real(wp) :: g(system%n_event), rate(system%n_event)
      integer :: k, n, status

      n = system%n_position
      call method%start(system, 0.0_wp, y, t_end, status)
      do while (method%t < t_end .and. status >= 0 .and. story%n_step < most_steps)
         call method%advance(system, t_end, status)
         story%n_step = story%n_step + 1
         call system%events(method%t, method%step%y1, g, rate)
         if (status /= advance_event) then
            story%overlap = max(story%overlap, maxval(g))
            cycle
         end if
         do k = 1, method%n_happened
            associate (number => method%happened(k))
               story%n_event = story%n_event + 1
               story%number(story%n_event) = number
               story%time(story%n_event) = method%t
               story%residual = max(story%residual, abs(g(number)))
               if (present(restitution)) then
                  method%step%y1(n + system%subject(number)) = -restitution*method%step%y1(n + system%subject(number))
               else
                  system%side(number) = -system%side(number)
               end if
            end associate
         end do
         call method%restart(system, 0.0_wp, status)
      end do
      story%is_complete = method%t == t_end .and. status >= 0
   end subroutine run_through

   !> The run came to its end, with this many events, no overlap, all at round-off.
   subroutine check_story(error, story, n_event, round_off, what)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      type(story_t), intent(in) :: story                   !! what happened
      integer, intent(in) :: n_event                       !! events expected
      real(wp), intent(in) :: round_off                    !! greatest |g| at an event [m]
      character(*), intent(in) :: what                     !! the case

      call check_true(error, story%is_complete, what//": comes to its end")
      call check_equal(error, story%n_event, n_event, what//": events")
      call check_close(error, story%residual, 0.0_wp, round_off, what//": event function at the events")
      call check_close(error, story%overlap, 0.0_wp, round_off, what//": event function at the ends of other steps")
   end subroutine check_story

   subroutine test_uniform_motion(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(story_t) :: story

      call new_particles([0.0_wp], [0.0_wp], [1], [0.3_wp], [1.0_wp], system)
      call run_through(system, [0.0_wp, 0.7_wp], 1.0_wp, method, story)
      call check_story(error, story, 1, 1.0e-16_wp, "uniform motion")
      call check_close(error, story%time(1), 0.3_wp/0.7_wp, 1.0e-15_wp, "time", relative=.true.)
      call check_true(error, story%n_step < 20, "few steps")
   end subroutine test_uniform_motion

   !> From 3 m at 9.81 m/s^2, whatever the tolerance: the path is a polynomial.
   subroutine test_falling_ball(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      integer :: k

      do k = 2, 12, 2
         allocate (method)
         method%controls%tolerance = 0.1_wp**k
         call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
         call run_through(system, [3.0_wp, 0.0_wp], 2.0_wp, method, story)
         call check_story(error, story, 1, 2.0e-15_wp, "falling ball")
         call check_close(error, story%time(1), sqrt(6.0_wp/9.81_wp), 1.0e-15_wp, "time", relative=.true.)
         deallocate (method)
      end do
   end subroutine test_falling_ball

   !> A ball that keeps 0.9 of its speed: twenty bounces, at sqrt(2 h/g) (1 + 2 e + 2 e^2 + ...).
   subroutine test_bouncing_ball(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: restitution = 0.9_wp, first = sqrt(6.0_wp/9.81_wp)
      type(particles_t) :: system
      type(verner_t) :: method
      type(story_t) :: story
      real(wp) :: time
      integer :: k

      call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
      time = first*(1.0_wp + 2.0_wp*sum([(restitution**k, k=1, 19)]))
      call run_through(system, [3.0_wp, 0.0_wp], time + 0.01_wp, method, story, restitution)
      call check_story(error, story, 20, 1.0e-14_wp, "bouncing ball")
      call check_close(error, story%time(20), time, 1.0e-13_wp, "twentieth bounce", relative=.true.)
      call check_true(error, story%n_step < 200, "few steps")
   end subroutine test_bouncing_ball

   !> x = sin t through a wall at 1/2: the state at an event is on the wall to round-off at any
   !> tolerance, the time as accurate as the motion.
   subroutine test_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: sixth = pi/6.0_wp
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      integer :: k

      do k = 2, 12, 2
         allocate (method)
         method%controls%tolerance = 0.1_wp**k
         call new_particles([0.0_wp], [1.0_wp], [1], [0.5_wp], [1.0_wp], system)
         call run_through(system, [0.0_wp, 1.0_wp], 10.0_wp, method, story)
         call check_story(error, story, 4, 4.0e-16_wp, "spring")
         call check_close(error, story%time(1:4), [1.0_wp, 5.0_wp, 13.0_wp, 17.0_wp]*sixth, 10.0_wp*0.1_wp**k + 2.0e-15_wp, &
                          "times")
         deallocate (method)
      end do
   end subroutine test_spring

   !> A throw that is above the wall for a small part of one long step, wherever that part is.
   subroutine test_in_and_out(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 2.0_wp
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: depth, half, top
      integer :: i, k

      do k = 1, 6
         depth = 10.0_wp**(-k)
         half = sqrt(2.0_wp*depth)
         do i = 1, 50
            top = half + (step - 2.0_wp*half)*i/50.0_wp
            if (top < 1.01_wp*half) cycle
            allocate (method)
            method%controls%initial_step = step
            call new_particles([-1.0_wp], [0.0_wp], [1], [0.5_wp*top**2 - depth], [1.0_wp], system)
            call run_through(system, [0.0_wp, top], 1.5_wp*step, method, story)
            call check_story(error, story, 2, 1.0e-15_wp, "in and out")
            call check_close(error, story%time(1:2), [top - half, top + half], 1.0e-11_wp, "times")
            call check_true(error, story%n_step <= 6, "few steps")
            deallocate (method)
         end do
      end do
   end subroutine test_in_and_out

   !> A throw whose top is 1e-9 m above the wall is seen, one whose top is 1e-9 m below it is not.
   subroutine test_grazing(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: depth, top
      integer :: i, k

      do k = 1, 2
         depth = merge(1.0e-9_wp, -1.0e-9_wp, k == 1)
         do i = 1, 200
            top = 0.01_wp*i
            allocate (method)
            method%controls%initial_step = 1.9_wp
            call new_particles([-1.0_wp], [0.0_wp], [1], [0.5_wp*top**2 - depth], [1.0_wp], system)
            call run_through(system, [0.0_wp, top], 4.0_wp, method, story)
            call check_story(error, story, merge(2, 0, k == 1), 1.0e-15_wp, "grazing")
            if (k == 1) call check_close(error, story%time(1:2), top + sqrt(2.0_wp*depth)*[-1.0_wp, 1.0_wp], 1.0e-10_wp, "times")
            deallocate (method)
         end do
      end do
   end subroutine test_grazing

   !> The same with x = sin t, whose path is no polynomial, at the tolerance that this needs.
   subroutine test_grazing_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: phase
      integer :: i, k

      do k = 1, 2
         do i = 1, 40
            phase = 0.037_wp*i
            allocate (method)
            method%controls%tolerance = 1.0e-12_wp
            call new_particles([0.0_wp], [1.0_wp], [1], [1.0_wp - merge(1.0e-9_wp, -1.0e-9_wp, k == 1)], [1.0_wp], system)
            call run_through(system, [sin(phase), cos(phase)], 4.0_wp*pi, method, story)
            call check_story(error, story, merge(4, 0, k == 1), 1.0e-15_wp, "grazing spring")
            deallocate (method)
         end do
      end do
   end subroutine test_grazing_spring

   !> A top exactly on the wall is an event or none, but the run goes on.
   subroutine test_touching(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: top
      integer :: i

      do i = 1, 100
         top = 0.017_wp*i
         allocate (method)
         method%controls%initial_step = 1.9_wp
         call new_particles([-1.0_wp], [0.0_wp], [1], [0.5_wp*top**2], [1.0_wp], system)
         call run_through(system, [0.0_wp, top], 4.0_wp, method, story)
         call check_true(error, story%n_event <= 2, "at most an onset and an end")
         call check_story(error, story, story%n_event, 1.0e-14_wp, "touching")
         call check_true(error, story%n_step < 20, "few steps")
         deallocate (method)
      end do
   end subroutine test_touching

   !> Two walls in one step; the first comes first, whatever its number.
   subroutine test_two_in_one_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: gap(5) = [0.3_wp, 0.02_wp, 1.0e-4_wp, 1.0e-8_wp, 1.0e-12_wp]
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      integer :: i, k

      do k = 1, size(gap)
         do i = 1, 2
            allocate (method)
            method%controls%initial_step = 1.0_wp
            call new_particles([0.0_wp], [0.0_wp], [1, 1], [0.41_wp, 0.41_wp + gap(k)], [1.0_wp, 1.0_wp], system)
            if (i == 2) system%wall = system%wall(2:1:-1)
            call run_through(system, [0.0_wp, 1.0_wp], 1.0_wp, method, story)
            call check_story(error, story, 2, 2.0e-16_wp, "two in one step")
            call check_close(error, story%time(1:2), [0.41_wp, 0.41_wp + gap(k)], 1.0e-15_wp, "times")
            if (gap(k) > 1.0e-8_wp) call check_equal(error, story%number(1), i, "the first")
            call check_true(error, story%n_step <= 5, "few steps")
            deallocate (method)
         end do
      end do
   end subroutine test_two_in_one_step

   !> One particle is above its wall only briefly, just before another meets its own.
   subroutine test_brief_before_another(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: half = 1.0e-3_wp  ! of the brief contact [s]
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: top
      integer :: i, k

      do k = 1, 2
         do i = 1, 90
            top = 0.01_wp*i
            allocate (method)
            method%controls%initial_step = 1.0_wp
            call new_particles([-1.0_wp, 0.0_wp], [0.0_wp, 0.0_wp], [k, 3 - k], [0.0_wp, 0.0_wp], [1.0_wp, 1.0_wp], system)
            system%wall(k) = 0.5_wp*(top**2 - half**2)
            system%wall(3 - k) = top + 0.004_wp
            call run_through(system, [0.0_wp, 0.0_wp, top, 1.0_wp], 1.0_wp, method, story)
            call check_story(error, story, 3, 1.0e-15_wp, "a brief contact before another")
            call check_close(error, story%time(1:3), top + [-half, half, 0.004_wp], 1.0e-11_wp, "times")
            deallocate (method)
         end do
      end do
   end subroutine test_brief_before_another

   !> Walls met at one instant are one event each, near the origin and far from it, where the last
   !> digits of the event functions are noise.
   subroutine test_simultaneous(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: far, time
      integer :: i, k

      do i = 0, 100
         far = 17.3_wp*i
         time = sqrt(1.2_wp + 0.01_wp*i)
         allocate (method)
         call new_particles([-1.0_wp, 0.0_wp, 2.0_wp], [0.0_wp, 0.0_wp, 0.0_wp], [1, 1, 2, 3], &
                            [far, far, far + time, far + time**2], [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp], system)
         call run_through(system, [far + 0.5_wp*time**2, far, far, 0.0_wp, 1.0_wp, 0.0_wp], 2.0_wp, method, story)
         call check_story(error, story, 4, 1.0e-15_wp*max(far, 1.0_wp), "simultaneous")
         call check_close(error, story%time(1:4), [(time, k=1, 4)], 2.0e-15_wp*max(far, 1.0_wp), "times")
         call check_true(error, all([(any(story%number(1:4) == k), k=1, 4)]), "each of them once")
         call check_true(error, story%n_step < 20, "few steps")
         deallocate (method)
      end do
   end subroutine test_simultaneous

   !> An event just handled leaves its function at zero, give or take the last digits: no second event.
   subroutine test_start_on_the_wall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: place(3) = [1.0e-18_wp, 0.0_wp, -1.0e-18_wp]
      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      integer :: k

      do k = 1, 3
         ! away from the wall, and back to it at t = 2
         allocate (method)
         call new_particles([1.0_wp], [0.0_wp], [1], [0.0_wp], [1.0_wp], system)
         call run_through(system, [place(k), -1.0_wp], 3.0_wp, method, story)
         call check_equal(error, story%n_event, 1, "event on the way back")
         call check_close(error, story%time(1), 2.0_wp, 2.0e-15_wp, "its time")
         call check_true(error, story%is_complete .and. story%n_step < 20, "few steps")
         deallocate (method)
         ! through the wall at once
         allocate (method)
         call new_particles([0.0_wp], [0.0_wp], [1], [0.0_wp], [1.0_wp], system)
         call run_through(system, [place(k), 1.0_wp], 3.0_wp, method, story)
         call check_equal(error, story%n_event, 1, "event at the start")
         call check_close(error, story%time(1), 0.0_wp, 1.0e-15_wp, "its time")
         call check_true(error, story%is_complete .and. story%n_step < 20, "few steps")
         deallocate (method)
      end do
   end subroutine test_start_on_the_wall

   !> The same far from the origin, and away for ever, faster and faster: no event.
   subroutine test_leaving_for_ever(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t), allocatable :: method
      type(story_t) :: story
      real(wp) :: far, speed
      integer :: i, k

      far = 1000.0_wp
      do k = 1, 12
         speed = 10.0_wp**(2 - k)
         do i = -2, 2
            allocate (method)
            call new_particles([-1.0_wp], [0.0_wp], [1], [far], [1.0_wp], system)
            call run_through(system, [far + i*spacing(far), -speed], 1.0_wp, method, story)
            call check_equal(error, story%n_event, 0, "no event")
            call check_true(error, story%is_complete .and. story%n_step < 20, "few steps")
            deallocate (method)
         end do
      end do
   end subroutine test_leaving_for_ever

   !> A particle that lies on its wall for ever is no event.
   subroutine test_zero_for_ever(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(story_t) :: story

      call new_particles([0.0_wp, 0.0_wp], [0.0_wp, 1.0_wp], [1, 2], [0.3_wp, 0.5_wp], [1.0_wp, 1.0_wp], system)
      call run_through(system, [0.3_wp, 0.0_wp, 0.0_wp, 1.0_wp], 3.0_wp, method, story)
      call check_story(error, story, 2, 1.0e-15_wp, "one lies, the other passes")
      call check_true(error, all(story%number(1:2) == 2), "only the second")
   end subroutine test_zero_for_ever

   !> Events within fixed steps; the grid goes on from the event.
   subroutine test_fixed_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(story_t) :: story

      method%controls%fixed_step = 0.1_wp
      call new_particles([-9.81_wp], [0.0_wp], [1], [0.0_wp], [-1.0_wp], system)
      call run_through(system, [3.0_wp, 0.0_wp], 1.0_wp, method, story)
      call check_story(error, story, 1, 2.0e-15_wp, "fixed steps")
      call check_close(error, story%time(1), sqrt(6.0_wp/9.81_wp), 1.0e-15_wp, "time", relative=.true.)
      call check_equal(error, story%n_step, 11, "steps: 7 and a part, then 2 and a part")
   end subroutine test_fixed_steps

   !> The event falls on the end of a step, where its function is exactly zero.
   subroutine test_at_the_end_of_a_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(verner_t) :: method
      type(story_t) :: story

      method%controls%fixed_step = 0.25_wp
      call new_particles([0.0_wp], [0.0_wp], [1], [0.5_wp], [1.0_wp], system)
      call run_through(system, [0.0_wp, 1.0_wp], 1.0_wp, method, story)
      call check_story(error, story, 1, 2.0e-16_wp, "at the end of a step")
      call check_close(error, story%time(1), 0.5_wp, 1.0e-15_wp, "time")
   end subroutine test_at_the_end_of_a_step

end module test_events
