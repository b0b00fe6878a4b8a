!> The analysis: how it ends when it cannot continue, or when the results do not fulfil what they must.
module test_failed_runs
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use dynamic_fixture, only: pin, run_text, settings, wheel
   use errors, only: error_t, exit_audit, exit_file, exit_integration
   use integrator, only: advance_event
   use kinds, only: wp
   use ode_system, only: ode_system_t
   use recorder, only: status_complete, status_failed, summary_t
   use rk4, only: rk4_t
   use run_audit, only: limits_t
   use scene_fixture, only: nl
   implicit none (type, external)
   private
   public :: run_test_failed_runs

   !> An integrator that finds the first event again and again.
   type, extends(rk4_t) :: stuck_t
   contains
      procedure :: advance => stuck_advance
   end type stuck_t

contains

   subroutine run_test_failed_runs(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("too_many_steps", test_too_many_steps)
      call suite%test("load_that_is_not_a_number", test_not_a_number)
      call suite%test("energy_limit", test_energy_limit)
      call suite%test("violation_limit", test_violation_limit)
      call suite%test("recorder_fails", test_recorder_fails)
      call suite%test("events_without_end", test_events_without_end)
   end subroutine run_test_failed_runs

   !> A failed run: its exit code, its description, finish is called and the samples so far are kept.
   subroutine check_failure(error, mistake, keeper, summary, code, words)
      type(error_t), allocatable, intent(inout) :: error    !! first failure
      type(error_t), allocatable, intent(in) :: mistake     !! what the run says
      type(keeper_t), intent(in) :: keeper                  !! what was kept
      type(summary_t), intent(in) :: summary                !! as returned
      integer, intent(in) :: code                           !! exit code expected
      character(*), intent(in) :: words                     !! part of the message

      call check_true(error, allocated(mistake), "the run failed")
      if (allocated(error)) return
      call check_equal(error, mistake%code, code, "exit code: "//mistake%message)
      call check_true(error, index(mistake%message, words) > 0, "'"//words//"' in: "//mistake%message)
      call check_equal(error, keeper%n_finish, 1, "calls of finish")
      call check_equal(error, keeper%summary%status, status_failed, "status told to the recorder")
      call check_equal(error, summary%status, status_failed, "status")
      call check_equal(error, keeper%summary%message, mistake%message, "message told to the recorder")
      call check_equal(error, summary%count%samples, keeper%n_sample, "samples")
   end subroutine check_failure

   subroutine test_too_many_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: mistake
      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 3 s"//nl//"method = verner"//nl//"maximum_steps = 24"//nl//"[output]"//nl// &
                    "every = 10 ms"//nl, keeper, summary, mistake)
      call check_failure(error, mistake, keeper, summary, exit_integration, "maximum_steps")
      if (allocated(error)) return
      call check_equal(error, int(summary%count%steps), 24, "steps")
      call check_true(error, summary%time_end < 3.0_wp, "not to the end")
      call check_equal(error, keeper%n_sample, 1 + floor(summary%time_end/0.01_wp), "samples up to where it came")
      call check_true(error, keeper%n_sample > 10, "some samples")
   end subroutine test_too_many_steps

   !> A load that does not exist after one second.
   subroutine test_not_a_number(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: force = "[force.point]"//nl//"name point fx"//nl//"f hub {sqrt(1 - t/(1 s))*1 N}"//nl
      type(error_t), allocatable :: mistake
      type(keeper_t) :: keeper, unlucky
      type(summary_t) :: summary

      call run_text(wheel//force//settings//"end = 3 s"//nl//"[output]"//nl//"every = 10 ms"//nl, keeper, summary, mistake)
      call check_failure(error, mistake, keeper, summary, exit_integration, "t = ")
      if (allocated(error)) return
      call check_close(error, summary%time_end, 1.0_wp, 1.0e-9_wp, "time reached")
      call check_true(error, keeper%n_sample == 100 .or. keeper%n_sample == 101, "samples up to one second")
      ! nothing but the very start exists
      call run_text(wheel//"[force.point]"//nl//"name point fx"//nl//"f hub {sqrt(-t/(1 s))*1 N}"//nl// &
                    settings//"end = 3 s"//nl, unlucky, summary, mistake)
      call check_failure(error, mistake, unlucky, summary, exit_integration, "t = 0")
   end subroutine test_not_a_number

   !> The audit's verdict comes after the run: everything is kept, the exit code is its own.
   subroutine test_energy_limit(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: mistake
      type(keeper_t) :: strict, tolerant
      type(summary_t) :: summary
      character(*), parameter :: deck = wheel//settings//"end = 3 s"//nl//"step = 0.2 s"//nl

      call run_text(deck, strict, summary, mistake, limits_t(energy=1.0e-12_wp))
      call check_failure(error, mistake, strict, summary, exit_audit, "the energy error reached")
      if (allocated(error)) return
      call check_equal(error, strict%n_sample, 1001, "samples")
      call check_close(error, summary%time_end, 3.0_wp, 0.0_wp, "end")
      call run_text(deck, tolerant, summary, error, limits_t(energy=1.0e-3_wp))
      if (.not. allocated(error)) call check_equal(error, summary%status, status_complete, "status")
   end subroutine test_energy_limit

   !> A pendulum with long steps drifts off its pin.
   subroutine test_violation_limit(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: pendulum = "deck = 1"//nl//"[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"bob 2 0.1 0.5 0"//nl// &
         "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye bob -0.5 0"//nl// &
         "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl//settings//"end = 3 s"//nl//"step = 50 ms"//nl
      type(error_t), allocatable :: mistake
      type(keeper_t) :: strict, tolerant
      type(summary_t) :: summary

      call run_text(pendulum, strict, summary, mistake, limits_t(violation=1.0e-12_wp))
      call check_failure(error, mistake, strict, summary, exit_audit, "constraint")
      if (allocated(error)) return
      associate (violation => summary%quality%violation_max)
         call check_true(error, violation > 1.0e-12_wp .and. violation < 1.0e-2_wp, "violation")
      end associate
      call run_text(pendulum, tolerant, summary, error, limits_t(violation=1.0e-2_wp))
   end subroutine test_violation_limit

   !> A sample that cannot be written ends the run; finish is still called.
   subroutine test_recorder_fails(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: mistake
      type(keeper_t) :: keeper
      type(summary_t) :: summary

      keeper%n_broken = 42
      call run_text(wheel//settings//"end = 3 s"//nl, keeper, summary, mistake)
      call check_failure(error, mistake, keeper, summary, exit_file, "disk")
      call check_equal(error, keeper%n_sample, 41, "samples before")
   end subroutine test_recorder_fails

   !> A contact that starts and ends and no time passes: said so, not for ever.
   subroutine test_events_without_end(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: mistake
      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(stuck_t) :: stuck
      type(summary_t) :: summary

      call load_text(pin//settings//"end = 2.3 ms"//nl, loaded, error)
      if (allocated(error)) return
      deallocate (loaded%method)
      allocate (loaded%method, source=stuck)
      call run_to_end(loaded, keeper, summary, mistake)
      call check_failure(error, mistake, keeper, summary, exit_integration, "events accumulate at 'ring'")
      call check_true(error, keeper%n_event > 100, "events were told before")
   end subroutine test_events_without_end

   !> No step: the first event function, now.
   subroutine stuck_advance(self, system, t_stop, status)
      class(stuck_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! always advance_event

      self%events%n_happened = 1
      self%events%happened(1) = 1
      status = advance_event
   end subroutine stuck_advance

end module test_failed_runs
