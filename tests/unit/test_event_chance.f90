!> Which parts of a step are looked into for an event.
module test_event_chance
   use check, only: check_true, suite_t
   use errors, only: error_t
   use event_chance, only: leaves_room, only_rises
   use fixed_random, only: random_t, seed_of
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_event_chance

   integer, parameter :: n_function = 4000   !! functions tried
   integer, parameter :: n_place = 200       !! places of each looked at

contains

   subroutine run_test_event_chance(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("no_event_where_there_is_no_room", test_room)
      call suite%test("ends_that_tell_enough", test_told)
   end subroutine run_test_event_chance

   !> Quartics that bend up to half as much again as the cubic of Hermite through their ends: none is above zero where no storage is
   !> reported, and none falls that is reported to rise only.
   subroutine test_room(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(random_t) :: random
      real(wp) :: bend, c(4), extra, g(0:n_place), s, r(0:n_place)
      integer :: i, k, n_none, n_rising

      random = random_t(seed_of("event_chance", 0))
      n_none = 0
      n_rising = 0
      do i = 1, n_function
         c = [random%between(-0.3_wp, 0.0_wp), random%between(-2.0_wp, 2.0_wp), random%between(-2.0_wp, 2.0_wp), &
              random%between(-2.0_wp, 2.0_wp)]
         if (modulo(i, 3) == 0) c(3:4) = 0.1_wp*c(3:4)
         if (modulo(i, 2) == 0) c(1) = -1.0e-18_wp*i  ! as behind an event
         bend = max(abs(2.0_wp*c(3)), abs(2.0_wp*c(3) + 6.0_wp*c(4)))
         extra = random%between(-0.25_wp, 0.25_wp)*bend
         do k = 0, n_place
            s = real(k, wp)/n_place
            g(k) = c(1) + s*(c(2) + s*(c(3) + s*c(4))) + extra*(s*(1.0_wp - s))**2
            r(k) = c(2) + s*(2.0_wp*c(3) + 3.0_wp*s*c(4)) + 2.0_wp*extra*s*(1.0_wp - s)*(1.0_wp - 2.0_wp*s)
         end do
         if (.not. leaves_room(g(0), r(0), g(n_place), r(n_place))) then
            n_none = n_none + 1
            call check_true(error, all(g(1:) <= 0.0_wp), "below zero all the way")
         end if
         if (only_rises(g(0), r(0), g(n_place), r(n_place))) then
            n_rising = n_rising + 1
            call check_true(error, all(r >= 0.0_wp), "rises all the way")
         end if
      end do
      call check_true(error, n_none > n_function/10 .and. n_rising > n_function/100, "both are told of many")
   end subroutine test_room

   !> What is reported of parabolas.
   subroutine test_told(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_true(error, leaves_room(-1.0_wp, 1.0_wp, 0.1_wp, 1.2_wp), "above zero at the end")
      call check_true(error, leaves_room(-0.1_wp, 1.0_wp, -0.1_wp, -1.0_wp), "above zero between")
      call check_true(error, .not. leaves_room(-1.0e-18_wp, -1.0_wp, -0.1_wp, 0.8_wp), "away and partly back")
      call check_true(error, .not. leaves_room(-1.0_wp, 0.5_wp, -0.5_wp, 0.5_wp), "on its way up")
      call check_true(error, only_rises(-1.0_wp, 1.0_wp, 0.1_wp, 1.2_wp), "rises at an even pace")
      call check_true(error, .not. only_rises(-1.0_wp, -0.1_wp, 0.1_wp, 2.3_wp), "falls at first")
      call check_true(error, .not. only_rises(-1.0_wp, 6.0_wp, 0.1_wp, 0.1_wp), "may bend over")
   end subroutine test_told

end module test_event_chance
