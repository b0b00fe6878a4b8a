!> What the method that chooses decides by: rates, stretches of steps that stability keeps short, trials.
module test_method_choice
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: i8, wp
   use method_choice, only: method_choice_t
   use method_trial, only: trial_t
   use stability_limit, only: rate_between, stability_limit_t
   implicit none (type, external)
   private
   public :: run_test_method_choice

contains

   subroutine run_test_method_choice(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rate_between_two_states", test_rate)
      call suite%test("stretches_of_short_steps_are_seen", test_stretches)
      call suite%test("trials", test_trials)
      call suite%test("trial_that_comes_nowhere", test_no_way)
   end subroutine run_test_method_choice

   subroutine test_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: a(3) = [1.0_wp, 2.0_wp, 3.0_wp], b(3) = [1.5_wp, 1.0_wp, 3.0_wp]

      call check_close(error, rate_between(3, a, -7.0_wp*a, b, -7.0_wp*b, [1.0_wp, 10.0_wp, 1.0_wp]), 7.0_wp, 1.0e-14_wp, "decay")
      call check_close(error, rate_between(1, a, a, a, b, [1.0_wp]), 0.0_wp, 0.0_wp, "no difference")
   end subroutine test_rate

   !> 25 looks near the bound make a stretch of stiff steps, six below in a row end it; far from the bound every eighth step is
   !> looked at.
   subroutine test_stretches(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(stability_limit_t) :: seen
      integer :: k, n_look

      n_look = 0
      seen%bound = 4.0_wp
      do k = 1, 80
         if (.not. seen%is_due()) cycle
         n_look = n_look + 1
         call seen%note(0.1_wp, 1.0_wp, 0.1_wp*k)
      end do
      call check_equal(error, n_look, 10, "looks while calm")
      do k = 1, 24
         call seen%note(0.1_wp, 39.0_wp, 0.1_wp*k)
      end do
      call check_true(error, .not. seen%is_stiff, "not yet")
      call check_true(error, seen%is_due(), "every step is looked at")
      call seen%note(0.1_wp, 39.0_wp, 2.5_wp)
      call check_true(error, seen%is_stiff, "stiff")
      call check_close(error, seen%t_from, 0.1_wp, 1.0e-15_wp, "since")
      do k = 1, 5
         call seen%note(0.1_wp, 1.0_wp, 2.5_wp)
      end do
      call check_true(error, seen%is_stiff, "still")
      call seen%note(0.1_wp, 1.0_wp, 2.5_wp)
      call check_true(error, .not. seen%is_stiff, "no longer")
      call check_true(error, .not. seen%is_due(), "seldom again")
   end subroutine test_stretches

   !> A trial of 100 evaluations that leads through 1 s. The explicit method with 100 evaluations a second remains, and the next
   !> trial waits for 20, then 40 times those 100. One with 400 a second is left as soon as it has taken 200, one with 4000 as
   !> soon as it has taken 100.
   subroutine test_trials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(method_choice_t) :: choice
      integer(i8) :: n, n_trial
      real(wp) :: t
      integer :: k

      call check_true(error, choice%wants_trial(0_i8, .true.), "at once where it is stiff")
      call check_true(error, .not. choice%wants_trial(5999_i8, .false.), "not yet where it is not")
      call check_true(error, choice%wants_trial(6000_i8, .false.), "in any case")
      n = 1000
      t = 0.0_wp
      do k = 1, 2
         call try_and_go_on(100.0_wp)
         call check_true(error, .not. (choice%is_implicit .or. choice%is_comparing), "the explicit method remains")
         call check_true(error, .not. choice%wants_trial(n_trial + 2000_i8*k - 1, .true.), "waits")
         n = n_trial + 2000_i8*k
         call check_true(error, choice%wants_trial(n, .true.), "no longer")
      end do
      call try_and_go_on(400.0_wp)
      call check_true(error, choice%is_implicit .and. n - n_trial == 200, "the implicit method is better")
      call check_close(error, choice%t_change(1), t, 0.0_wp, "the change is kept")
      call check_close(error, choice%product(1), 4.0_wp, 0.0_wp, "with its reason")
      call check_true(error, .not. choice%wants_trial(n + 1999_i8, .true.), "the explicit one is not tried at once")
      call check_true(error, choice%wants_trial(n + 2000_i8, .false.), "but then")
      choice%is_at_event = .true.
      call check_true(error, choice%wants_trial(n + 500_i8, .false.), "sooner after an event")
      call try_and_go_on(95.0_wp)
      call check_true(error, choice%is_implicit, "the implicit method remains")
      call try_and_go_on(105.0_wp)
      call check_true(error, .not. choice%is_implicit .and. choice%n_change == 2, "the explicit one is better")
      call try_and_go_on(4000.0_wp)
      call check_true(error, choice%is_implicit .and. n - n_trial == 120, "the implicit method is far better")

   contains

      !> A trial, and steps of a hundredth of a second by the present method.
      subroutine try_and_go_on(rate)
         real(wp), intent(in) :: rate    !! evaluations of the present method [1/s]

         integer(i8) :: n_first
         integer :: i
         logical :: was_implicit

         was_implicit = choice%is_implicit
         n_trial = n
         n_first = n
         call choice%note_trial(trial_t(t, t + 1.0_wp, 0.1_wp, 100_i8), n, 4.0_wp)
         do i = 1, 100
            t = t + 0.01_wp
            n = n_first + nint(rate*0.01_wp*real(i, wp), i8)
            call choice%compare(t, n)
            if (.not. choice%is_comparing .or. (choice%is_implicit .neqv. was_implicit)) return
         end do
      end subroutine try_and_go_on

   end subroutine test_trials

   !> A trial that comes nowhere is no comparison.
   subroutine test_no_way(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(method_choice_t) :: choice

      call choice%note_trial(trial_t(1.0_wp, 1.0_wp, 0.1_wp, 100_i8), 1000_i8, 0.0_wp)
      call choice%compare(2.0_wp, 2000_i8)
      call check_true(error, .not. (choice%is_implicit .or. choice%is_comparing), "the explicit method remains")
   end subroutine test_no_way

end module test_method_choice
