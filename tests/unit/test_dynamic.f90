!> The analysis: what it hands to a recorder, and when.
module test_dynamic
   use groups_of_catalogue, only: group_bodies
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t
   use dynamic_fixture, only: run_text, settings, wheel
   use errors, only: error_t
   use kinds, only: i8, wp
   use recorder, only: status_complete, summary_t
   use scene_fixture, only: nl
   implicit none (type, external)
   private
   public :: run_test_dynamic

contains

   subroutine run_test_dynamic(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("samples_on_the_grid", test_samples)
      call suite%test("samples_from_a_time", test_samples_from)
      call suite%test("grid_that_does_not_fit", test_grid_that_does_not_fit)
      call suite%test("thousand_intervals_by_default", test_default_grid)
      call suite%test("values_of_samples", test_values)
      call suite%test("summary", test_summary)
      call suite%test("progress", test_progress)
   end subroutine run_test_dynamic

   !> The times that were sampled are first, first + every ...
   subroutine check_grid(error, keeper, n, first, every)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      type(keeper_t), intent(in) :: keeper                 !! what was kept
      integer, intent(in) :: n                             !! samples expected
      real(wp), intent(in) :: first                        !! first of them [s]
      real(wp), intent(in) :: every                        !! interval [s]

      integer :: k

      if (allocated(error)) return
      call check_equal(error, keeper%n_start, 1, "calls of start")
      call check_equal(error, keeper%n_finish, 1, "calls of finish")
      call check_equal(error, keeper%n_sample, n, "samples")
      if (.not. allocated(error)) then
         call check_close(error, keeper%time(:n), [(first + every*(k - 1), k=1, n)], 1.0e-14_wp, "times")
      end if
   end subroutine check_grid

   !> Both ends belong to the grid, though seven times 0.1 is a little more than 0.7.
   subroutine test_samples(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 0.7 s"//nl//"[output]"//nl//"every = 0.1 s"//nl, keeper, summary, error)
      call check_grid(error, keeper, 8, 0.0_wp, 0.1_wp)
      if (.not. allocated(error)) call check_close(error, keeper%time(8), 0.7_wp, 0.0_wp, "the last is the end")
   end subroutine test_samples

   subroutine test_samples_from(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: grid = wheel//settings//"end = 3 s"//nl//"[output]"//nl//"every = 10 ms"//nl
      type(keeper_t) :: first, last
      type(summary_t) :: summary

      call run_text(grid//"from = 2.5 s"//nl, first, summary, error)
      call check_grid(error, first, 51, 2.5_wp, 0.01_wp)
      if (allocated(error)) return
      call run_text(grid//"last = 0.2 s"//nl, last, summary, error)
      call check_grid(error, last, 21, 2.8_wp, 0.01_wp)
   end subroutine test_samples_from

   !> The last instant is then before the end; the motion continues to the end all the same.
   subroutine test_grid_that_does_not_fit(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 1 s"//nl//"[output]"//nl//"every = 0.3 s"//nl, keeper, summary, error)
      call check_grid(error, keeper, 4, 0.0_wp, 0.3_wp)
      call check_close(error, summary%time_end, 1.0_wp, 0.0_wp, "end of the motion")
   end subroutine test_grid_that_does_not_fit

   subroutine test_default_grid(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 0.7 s"//nl, keeper, summary, error)
      call check_grid(error, keeper, 1001, 0.0_wp, 0.7e-3_wp)
   end subroutine test_default_grid

   !> Samples between steps are as right as the steps.
   subroutine test_values(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      keeper%item_group = group_bodies
      keeper%channel = "angle"
      call run_text(wheel//settings//"end = 3 s"//nl//"[output]"//nl//"every = 7 ms"//nl, keeper, summary, error)
      if (allocated(error)) return
      call check_true(error, keeper%n_sample > 400 .and. summary%count%steps < 200, "many samples within few steps")
      associate (n => keeper%n_sample)
         call check_close(error, keeper%value(:n), 0.5_wp*(1.0_wp - cos(2.0_wp*keeper%time(:n))), 1.0e-9_wp, "angle")
      end associate
   end subroutine test_values

   subroutine test_summary(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 3 s"//nl//"[output]"//nl//"every = 0.1 s"//nl, keeper, summary, error)
      if (allocated(error)) return
      call check_equal(error, summary%status, status_complete, "status")
      call check_equal(error, summary%message, "", "message")
      call check_equal(error, summary%method%integrator, "auto (dop853)", "method")
      call check_equal(error, summary%method%solver, "schur", "solver")
      call check_equal(error, summary%count%samples, 31, "samples")
      call check_close(error, [summary%time_start, summary%time_end], [0.0_wp, 3.0_wp], 0.0_wp, "times")
      call check_close(error, summary%method%tolerance, 1.0e-10_wp, 0.0_wp, "tolerance")
      call check_true(error, summary%count%steps > 10, "steps")
      call check_equal(error, int(summary%count%rhs_evaluations - summary%count%output_evaluations), &
                       1 + 12*int(summary%count%steps) + 11*int(summary%count%rejected_steps), "evaluations of the solution")
      call check_true(error, summary%count%output_evaluations >= 31, "evaluations for output")
      call check_equal(error, int(summary%count%factorisations), int(summary%count%rhs_evaluations), "factorisations")
      call check_equal(error, summary%count%contacts + summary%count%events, 0, "events")
      call check_true(error, summary%quality%energy_residual_max < 1.0e-9_wp*summary%quality%energy_max, "ledger")
      call check_close(error, summary%quality%energy_max, 0.05_wp, 1.0e-2_wp, "greatest energy", relative=.true.)
      call check_equal(error, keeper%summary%count%samples, 31, "the recorder was told the same")
   end subroutine test_summary

   subroutine test_progress(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 3 s"//nl//"step = 1 ms"//nl, keeper, summary, error)
      if (allocated(error)) return
      call check_close(error, summary%method%tolerance, 0.0_wp, 0.0_wp, "no tolerance with fixed steps")
      call check_true(error, summary%count%steps >= 3000, "steps")
      call check_equal(error, keeper%n_progress, int(summary%count%steps/256_i8), "reports, never backwards")
      call check_true(error, keeper%fraction > 0.9_wp .and. keeper%fraction <= 1.0_wp, "the last of them")
   end subroutine test_progress

end module test_dynamic
