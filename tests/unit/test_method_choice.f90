!> What the method that chooses decides by: rates, stretches of steps that stability keeps short, trials.
module test_method_choice
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: i8, wp
   use method_choice, only: method_choice_t
   use stability_limit, only: rate_between, stability_limit_t
   implicit none (type, external)
   private
   public :: run_test_method_choice

contains

   subroutine run_test_method_choice(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rate_between_two_states", test_rate)
      call suite%test("stretches_of_short_steps_are_seen", test_stretches)
      call suite%test("trials_that_fail_wait_longer", test_trials)
   end subroutine run_test_method_choice

   subroutine test_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: a(3) = [1.0_wp, 2.0_wp, 3.0_wp], b(3) = [1.5_wp, 1.0_wp, 3.0_wp]

      call check_close(error, rate_between(3, a, -7.0_wp*a, b, -7.0_wp*b, [1.0_wp, 10.0_wp, 1.0_wp]), 7.0_wp, 1.0e-14_wp, "decay")
      call check_close(error, rate_between(1, a, a, a, b, [1.0_wp]), 0.0_wp, 0.0_wp, "no difference")
   end subroutine test_rate

   !> 25 looks near the bound make a stretch of stiff steps, six below in a row end it; far from the bound every eighth step is seen.
   subroutine test_stretches(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(stability_limit_t) :: seen
      integer :: k, n_look

      n_look = 0
      do k = 1, 80
         if (.not. seen%is_due()) cycle
         n_look = n_look + 1
         call seen%note(0.1_wp, 1.0_wp, 4.0_wp, 0.1_wp*k, int(k, i8))
      end do
      call check_equal(error, n_look, 10, "looks while calm")
      do k = 1, 24
         call seen%note(0.1_wp, 39.0_wp, 4.0_wp, 0.1_wp*k, int(10*k, i8))
      end do
      call check_true(error, .not. seen%is_stiff, "not yet")
      call check_true(error, seen%is_due(), "every step is looked at")
      call seen%note(0.1_wp, 39.0_wp, 4.0_wp, 2.5_wp, 250_i8)
      call check_true(error, seen%is_stiff, "stiff")
      call check_close(error, seen%t_from, 0.1_wp, 1.0e-15_wp, "since")
      do k = 1, 5
         call seen%note(0.1_wp, 1.0_wp, 4.0_wp, 2.5_wp, 250_i8)
      end do
      call check_true(error, seen%is_stiff, "still")
      call seen%note(0.1_wp, 1.0_wp, 4.0_wp, 2.5_wp, 250_i8)
      call check_true(error, .not. seen%is_stiff, "no longer")
      call check_true(error, .not. seen%is_due(), "seldom again")
   end subroutine test_stretches

   !> A trial in which the implicit method takes as many evaluations fails; the next one waits for twenty times what it cost, then
   !> forty times. One in which it takes a hundredth of them does not.
   subroutine test_trials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(method_choice_t) :: choice
      integer(i8) :: cost, n, n_before, waited(2)
      real(wp) :: t
      integer :: k

      n = 1000
      t = 0.0_wp
      do k = 1, 2
         n_before = n
         call choice%begin_implicit(1.0e4_wp, 4.0_wp, 1.0e-3_wp, t, n)
         call go_on(1.0e-3_wp, 10_i8)
         call check_true(error, .not. choice%is_implicit, "it fails")
         cost = n - n_before
         waited(k) = 0
         do while (.not. choice%may_leave(n + waited(k)))
            waited(k) = waited(k) + 1
         end do
         call check_close(error, real(waited(k), wp)/real(cost, wp), 20.0_wp*k, 0.0_wp, "waits")
         n = n + waited(k)
      end do
      call choice%begin_implicit(1.0e4_wp, 4.0_wp, 1.0e-3_wp, t, n)
      call go_on(0.1_wp, 10_i8)
      call check_true(error, choice%is_implicit, "it stays")
      call choice%note_radius(1.0e4_wp, 10, n)
      call check_true(error, choice%is_implicit, "it stays where it is stiff")
      call choice%note_radius(100.0_wp, 10, n)
      call check_true(error, .not. choice%is_implicit, "it ends where it is not")

   contains

      !> Implicit steps.
      subroutine go_on(h, n_each)
         real(wp), intent(in) :: h           !! length of each [s]
         integer(i8), intent(in) :: n_each   !! evaluations of each

         integer :: i

         do i = 1, 30
            t = t + h
            n = n + n_each
            call choice%note_step(h, t, n_each, n)
            if (.not. choice%is_implicit) return
         end do
      end subroutine go_on

   end subroutine test_trials

end module test_method_choice
