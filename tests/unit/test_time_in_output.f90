!> Processor time spent aside.
module test_time_in_output
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use time_in_output, only: output_time_t
   implicit none (type, external)
   private
   public :: run_test_time_in_output

contains

   subroutine run_test_time_in_output(suite)
      type(suite_t), intent(inout) :: suite  !! tests of the program

      call suite%test("what_is_spent_aside_is_told", what_is_spent_aside_is_told)
   end subroutine run_test_time_in_output

   !> Use the processor for some time.
   subroutine work(seconds)
      real(wp), intent(in) :: seconds   !! for so long [s]

      real(wp) :: begin, now

      call cpu_time(begin)
      do
         call cpu_time(now)
         if (now - begin >= seconds) return
      end do
   end subroutine work

   !> Twenty short stretches aside among as many of three times their length, one of them longer than a millisecond.
   subroutine what_is_spent_aside_is_told(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(output_time_t) :: aside
      real(wp) :: begin, end, spent, told, whole
      integer :: k

      call cpu_time(begin)
      call aside%begin(0.5_wp)
      spent = 0.0_wp
      do k = 1, 20
         call work(merge(6.0e-3_wp, 6.0e-4_wp, k == 7))
         call aside%leave()
         call work(merge(4.0e-3_wp, 2.0e-4_wp, k == 12))
         call aside%come_back()
      end do
      told = aside%seconds() - 0.5_wp
      call cpu_time(end)
      whole = end - begin
      spent = 19*2.0e-4_wp + 4.0e-3_wp
      call check_close(error, told, spent, 0.35_wp*spent, "time aside [s]")
      call check_true(error, told < 0.6_wp*whole, "less than the whole")
      call aside%begin(told)
      call check_close(error, aside%seconds(), told, 1.0e-4_wp, "what was counted before stays [s]")
   end subroutine what_is_spent_aside_is_told

end module test_time_in_output
