!> The search for an event within one long step: what it finds, and how often it looks.
module test_event_search
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use integrator, only: advance_event, advance_step
   use kinds, only: wp
   use ode_examples, only: new_particles, particles_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_event_search

   integer, parameter :: most_looks = 1000   !! looks after which the function has no event any more, so that a search ends

   !> A particle whose event function is a parabola of time, above - (t - apex)^2.
   type, extends(particles_t) :: parabola_t
      real(wp) :: apex = 0.0_wp    !! where it is largest [s]
      real(wp) :: above = 0.0_wp   !! its value there [s^2]
      integer :: n_look = 0        !! times that it was asked for
   contains
      procedure :: events => parabola_events
   end type parabola_t

contains

   subroutine run_test_event_search(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("apex_at_the_end_of_the_step", test_apex)
      call suite%test("above_for_a_moment", test_moment)
   end subroutine run_test_event_search

   subroutine parabola_events(self, t, y, g, rate)
      class(parabola_t), intent(inout) :: self           !! the system
      real(wp), intent(in) :: t                          !! time [s]
      real(wp), intent(in) :: y(:)                       !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)          !! (1) the parabola [s^2]
      real(wp), intent(out), contiguous :: rate(:)       !! (1) its rate [s]

      self%n_look = self%n_look + 1
      g = self%above - (t - self%apex)**2
      rate = -2.0_wp*(t - self%apex)
      if (self%n_look > most_looks) g = -1.0_wp
      if (self%n_look > most_looks) rate = 0.0_wp
   end subroutine parabola_events

   !> A function that is just below zero where the step ends, and level there, leaves room at its end however short a part is.
   subroutine test_apex(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(parabola_t) :: system
      integer :: status

      call one_step(1.0_wp, -1.0e-40_wp, system, status)
      call check_equal(error, status, advance_step, "no event")
      call check_true(error, system%n_look < 20, "parts are no shorter than an eighth")
   end subroutine test_apex

   !> A function that is above zero within the step only: wherever that is, its onset is found.
   subroutine test_moment(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: width = 0.01_wp  ! half the time for which it is above zero [s]
      type(parabola_t) :: system
      real(wp) :: apex, t
      integer :: k, status

      do k = 1, 47
         apex = 0.02_wp*k + 0.013_wp
         call one_step(apex, width**2, system, status, t)
         call check_equal(error, status, advance_event, "an event")
         call check_close(error, t, apex - width, 1.0e-13_wp, "its time")
         call check_true(error, system%n_look < 60, "few looks")
         if (allocated(error)) return
      end do
   end subroutine test_moment

   !> A step of one second from the start.
   subroutine one_step(apex, above, system, status, t)
      real(wp), intent(in) :: apex                !! where the event function is largest [s]
      real(wp), intent(in) :: above               !! its value there [s^2]
      type(parabola_t), intent(out) :: system     !! the system
      integer, intent(out) :: status              !! how the step ended
      real(wp), intent(out), optional :: t        !! when it ended [s]

      type(verner_t) :: method

      call new_particles([0.0_wp], [0.0_wp], [1], [9.0_wp], [1.0_wp], system%particles_t)
      system%apex = apex
      system%above = above
      method%controls%fixed_step = 1.0_wp
      call method%start(system, 0.0_wp, [0.0_wp, 1.0_wp], 1.0_wp, status)
      call method%advance(system, 1.0_wp, status)
      if (present(t)) t = method%t
   end subroutine one_step

end module test_event_search
