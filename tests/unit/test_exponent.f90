!> What the largest Lyapunov exponent means, by one method or by two.
module test_exponent
   use check, only: check_equal, check_true, suite_t
   use errors, only: error_t
   use exponent, only: horizon_t, verdict, verdict_apart, verdict_differ, verdict_even, verdict_together, verdict_unknown
   use horizon_text, only: add_horizon
   use kinds, only: wp
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: run_test_exponent

contains

   !> Register the tests.
   subroutine run_test_exponent(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("verdict_of_one_method", test_verdict_of_one_method)
      call suite%test("verdict_of_two_methods", test_verdict_of_two_methods)
   end subroutine run_test_exponent

   !> A stretch of 100 s, exponents by a tangent and a reference run, neither of them known yet.
   subroutine new_horizon(horizon)
      type(horizon_t), intent(out) :: horizon  !! the horizon

      integer :: i

      horizon%t = [(real(i, wp), i=0, 100)]
      horizon%after = 25.0_wp
      horizon%tangent%reason = "not determined"
      horizon%twin%reason = "not determined"
   end subroutine new_horizon

   !> The method that is known reports.
   subroutine test_verdict_of_one_method(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(horizon_t) :: horizon

      call new_horizon(horizon)
      call check_equal(error, verdict(horizon), verdict_unknown, "neither is known")
      horizon%twin%reason = ""
      horizon%twin%rate%value = -2.0_wp
      horizon%twin%rate%half = 0.1_wp
      call check_equal(error, verdict(horizon), verdict_together, "by the twin")
      horizon%twin%rate%value = 0.01_wp
      call check_equal(error, verdict(horizon), verdict_even, "as a power of time")
   end subroutine test_verdict_of_one_method

   !> Two that differ by more than their intervals carries no information, whatever each of them says.
   subroutine test_verdict_of_two_methods(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(buffer_t) :: lines
      type(horizon_t) :: horizon

      call new_horizon(horizon)
      horizon%tangent%reason = ""
      horizon%twin%reason = ""
      horizon%tangent%rate%value = 2.0_wp
      horizon%tangent%rate%half = 0.1_wp
      horizon%twin%rate%value = 2.1_wp
      horizon%twin%rate%half = 0.1_wp
      horizon%is_agreed = .true.
      call check_equal(error, verdict(horizon), verdict_apart, "both say so")
      horizon%twin%rate%value = 3.0_wp
      horizon%is_agreed = .false.
      call check_equal(error, verdict(horizon), verdict_differ, "both part, at other rates")
      call add_horizon(lines, horizon)
      call check_true(error, index(lines%get(), "undecided: the two methods differ") > 0, "the words")
      call check_true(error, index(lines%get(), "neighbouring trajectories") == 0, "neither is claimed")
      horizon%twin%rate%value = -3.0_wp
      call check_equal(error, verdict(horizon), verdict_differ, "one parts, one does not")
   end subroutine test_verdict_of_two_methods

end module test_exponent
