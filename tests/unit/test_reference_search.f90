!> Which of the tight runs is the reference, and what confirms it; reasons of failures.
module test_reference_search
   use check, only: check_equal, check_true, suite_t
   use errors, only: error_t
   use failure_reasons, only: is_same_reason, reason_t, reasons_of
   use kept_run, only: sort_positions
   use kinds, only: wp
   use precision_info, only: setting_t
   use precision_reference, only: reference_t
   use precision_results, only: precision_t, tol_run_done, tol_run_failed, tol_run_t
   use reference_search, only: choose_pair
   implicit none (type, external)
   private
   public :: run_test_reference_search

contains

   !> Register the tests.
   subroutine run_test_reference_search(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("tightest_of_any_integrator", test_tightest_of_any_integrator)
      call suite%test("alike_as_tight", test_alike_as_tight)
      call suite%test("one_integrator_only", test_one_integrator_only)
      call suite%test("reasons", test_reasons)
   end subroutine run_test_reference_search

   !> A run of one number at two instants, so far from the truth, which is 1 at the end.
   type(reference_t) function run_of(method, asked, error) result(run)
      character(*), intent(in) :: method   !! its integrator
      real(wp), intent(in) :: asked        !! its tolerance [1]
      real(wp), intent(in) :: error        !! its error at the end [1]

      run%is_there = .true.
      run%setting = setting_t(method, "", "")
      run%asked = asked
      run%run%n = 2
      run%run%sort = [sort_positions]
      run%run%t = [0.0_wp, 1.0_wp]
      run%run%values = reshape([0.0_wp, 1.0_wp + error], [1, 2])
   end function run_of

   !> A study of nothing that needs an error of 1e-3.
   subroutine new_study(study)
      type(precision_t), intent(out) :: study  !! the study

      allocate (study%tol_sweeps(0))
      study%accuracy = 1.0e-3_wp
   end subroutine new_study

   !> A run of the integrator that comes first is no reference where others are tighter, though runs as coarse as it agree with it.
   subroutine test_tightest_of_any_integrator(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(precision_t) :: study
      type(reference_t) :: runs(4)
      integer :: other, own

      call new_study(study)
      runs(1) = run_of("verner", 1.0e-6_wp, 1.0e-6_wp)
      runs(2) = run_of("dop853", 1.0e-6_wp, 1.000001e-6_wp)
      runs(3) = run_of("ida", 1.0e-12_wp, 1.0e-11_wp)
      runs(4) = run_of("bdf", 1.0e-13_wp, 1.0e-12_wp)
      call choose_pair(study, runs, own, other)
      call check_equal(error, own, 4, "the tightest run")
      call check_equal(error, other, 3, "what goes with it")
   end subroutine test_tightest_of_any_integrator

   !> Of runs within a decade that which another integrator confirms best; of equal tolerances the first one.
   subroutine test_alike_as_tight(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(precision_t) :: study
      type(reference_t) :: runs(3)
      integer :: other, own

      call new_study(study)
      runs(1) = run_of("adams", 1.0e-13_wp, 1.0e-5_wp)
      runs(2) = run_of("ida", 1.0e-12_wp, 1.0e-11_wp)
      runs(3) = run_of("bdf", 1.0e-12_wp, 1.0e-12_wp)
      call choose_pair(study, runs, own, other)
      call check_equal(error, own, 2, "not the one that goes elsewhere")
      call check_equal(error, other, 3, "what goes with it")
   end subroutine test_alike_as_tight

   !> Nothing confirms a run but another integrator.
   subroutine test_one_integrator_only(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(precision_t) :: study
      type(reference_t) :: runs(2)
      integer :: other, own

      call new_study(study)
      runs(1) = run_of("verner", 1.0e-9_wp, 1.0e-9_wp)
      runs(2) = run_of("verner", 1.0e-12_wp, 1.0e-12_wp)
      call choose_pair(study, runs, own, other)
      call check_equal(error, own, 2, "the tighter one")
      call check_equal(error, other, 0, "no other integrator")
   end subroutine test_one_integrator_only

   !> Each reason once, whatever its numbers are.
   subroutine test_reasons(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(tol_run_t) :: tol_runs(5)
      type(reason_t), allocatable :: reasons(:)

      tol_runs%state = tol_run_failed
      tol_runs(1)%reason = "a step of 0.1 s is too long at t = 1.5e-3 s"
      tol_runs(2)%reason = "out of memory"
      tol_runs(3)%reason = "a step of 0.02 s is too long at t = 12 s"
      tol_runs(4)%reason = ""
      tol_runs(4)%state = tol_run_done
      tol_runs(5)%reason = "out of memory"
      reasons = reasons_of(tol_runs, tol_run_failed)
      call check_equal(error, size(reasons), 2, "two reasons")
      call check_equal(error, reasons(1)%first, 1, "the first run of the first")
      call check_equal(error, reasons(1)%n, 2, "runs of the first")
      call check_equal(error, reasons(2)%first, 2, "the first run of the second")
      call check_equal(error, reasons(2)%n, 2, "runs of the second")
      call check_true(error, .not. is_same_reason("2 steps", "2 turns"), "words are no numbers")
   end subroutine test_reasons

end module test_reference_search
