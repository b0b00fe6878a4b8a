!> The queue by time against a search for the minimum.
module test_time_queue
   use check, only: check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use time_queue, only: time_queue_t
   implicit none (type, external)
   private
   public :: run_test_time_queue

contains

   subroutine run_test_time_queue(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("against_search", test_against_search)
   end subroutine run_test_time_queue

   !> Forty things that come back later by whole numbers of ticks, so that many have the same time: each time all that are earliest
   !> come out, by number.
   subroutine test_against_search(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 40
      type(time_queue_t) :: queue
      type(random_t) :: random
      real(wp) :: at(n), time
      integer :: expected(n), first(n), i, k, n_expected, n_first

      random%state = 11_i8
      call queue%start(n)
      do k = 1, n
         at(k) = real(int(8.0_wp*random%between(0.0_wp, 1.0_wp)), wp)
         call queue%add(at(k), k)
      end do
      do i = 1, 500
         call queue%take_first(time, first, n_first)
         n_expected = 0
         do k = 1, n
            if (at(k) > minval(at)) cycle
            n_expected = n_expected + 1
            expected(n_expected) = k
         end do
         call check_equal(error, n_first, n_expected, "how many")
         call check_true(error, abs(time - minval(at)) <= 0.0_wp, "their time")
         if (allocated(error)) return
         do k = 1, n_first
            call check_equal(error, first(k), expected(k), "which")
            at(first(k)) = time + 1.0_wp + real(int(5.0_wp*random%between(0.0_wp, 1.0_wp)), wp)
            call queue%add(at(first(k)), first(k))
         end do
      end do
   end subroutine test_against_search

end module test_time_queue
