!> The analysis: what it hands to a recorder, when, and how it ends.
module test_dynamic
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use catalogue_rooms, only: room_bodies
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t, exit_audit, exit_file, exit_integration
   use integrator, only: advance_event
   use kinds, only: i8, pi, wp
   use ode_system, only: ode_system_t
   use recorder, only: status_complete, status_failed, summary_t
   use rk4, only: rk4_t
   use run_audit, only: limits_t
   implicit none (type, external)
   private
   public :: run_test_dynamic

   character(*), parameter :: nl = new_line("a")

   !> A wheel turned to and fro: angle = 0.5 rad (1 - cos(2 t)).
   character(*), parameter :: wheel = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rotor 2 0.1 0 0"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"axle ground 0 0"//nl//"hub rotor 0 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"bearing axle hub"//nl// &
      "[force.torque]"//nl//"name body moment"//nl//"motor rotor {0.2 N.m*cos(2 rad/s*t)}"//nl
   character(*), parameter :: settings = "[analysis.dynamic]"//nl//"coordinates = full"//nl// &
      "start = given"//nl//"tolerance = 1e-10"//nl//"stabilise = baumgarte"//nl

   !> A pin of 0.3 kg, free in a ring of the ground, thrown along x at 2 m/s from the middle. Elastic.
   character(*), parameter :: pin = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]"//nl//"pin 0.3 1e-4 0 0 2"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hole ground 0 0"//nl//"centre pin 0 0"//nl// &
      "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
      "[clearance.revolute]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law"//nl// &
      "ring hole centre 10 0.5 steel hertz"//nl//"[contact.hertz]"//nl//"name"//nl//"hertz"//nl
   real(wp), parameter :: mass = 0.3_wp, speed = 2.0_wp, clearance = 0.5e-3_wp  !! of the pin [kg, m/s, m]

   !> An integrator that finds the first event again and again.
   type, extends(rk4_t) :: stuck_t
   contains
      procedure :: advance => stuck_advance
   end type stuck_t

contains

   subroutine run_test_dynamic(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("samples_on_the_grid", test_samples)
      call suite%test("samples_from_a_time", test_samples_from)
      call suite%test("grid_that_does_not_fit", test_grid_that_does_not_fit)
      call suite%test("thousand_intervals_by_default", test_default_grid)
      call suite%test("values_of_samples", test_values)
      call suite%test("events_of_an_elastic_pin", test_elastic_pin)
      call suite%test("open_contact_at_the_end", test_open_contact)
      call suite%test("without_ledger", test_without_ledger)
      call suite%test("summary", test_summary)
      call suite%test("progress", test_progress)
      call suite%test("too_many_steps", test_too_many_steps)
      call suite%test("load_that_is_not_a_number", test_not_a_number)
      call suite%test("energy_limit", test_energy_limit)
      call suite%test("violation_limit", test_violation_limit)
      call suite%test("recorder_fails", test_recorder_fails)
      call suite%test("events_without_end", test_events_without_end)
   end subroutine run_test_dynamic

   !> Run a deck to its end.
   subroutine run_text(text, keeper, summary, error, limits)
      character(*), intent(in) :: text                    !! the deck
      type(keeper_t), intent(inout) :: keeper             !! keeps the results
      type(summary_t), intent(out) :: summary             !! cost and errors
      type(error_t), allocatable, intent(out) :: error    !! the run failed
      type(limits_t), intent(in), optional :: limits      !! what the results must fulfil

      type(loaded_t) :: loaded

      call load_text(text, loaded, error)
      if (allocated(error)) error%code = -error%code  ! a mistake of the test
      if (.not. allocated(error)) call run_to_end(loaded, keeper, summary, error, limits)
   end subroutine run_text

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

   !> The last instant is then before the end; the motion goes on to the end all the same.
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

      keeper%room = room_bodies
      keeper%channel = "angle"
      call run_text(wheel//settings//"end = 3 s"//nl//"[output]"//nl//"every = 7 ms"//nl, keeper, summary, error)
      if (allocated(error)) return
      call check_true(error, keeper%n_sample > 400 .and. summary%count%steps < 200, "many samples within few steps")
      associate (n => keeper%n_sample)
         call check_close(error, keeper%value(:n), 0.5_wp*(1.0_wp - cos(2.0_wp*keeper%time(:n))), 1.0e-9_wp, "angle")
      end associate
   end subroutine test_values

   !> Energy m v^2/2 = 2 K d^2.5 / 5 at the greatest penetration d; duration 2.9432 d/v. Source: Hertz (1882).
   subroutine test_elastic_pin(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: shape = 0.8_wp*sqrt(pi)*gamma(0.4_wp)/gamma(0.9_wp)  ! 2.9432 [1]
      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: depth, duration, stiffness
      integer :: k

      call run_text(pin//settings//"end = 2.3 ms"//nl, keeper, summary, error)
      if (allocated(error)) return
      ! 4 sqrt(R) / (3 (s_i + s_j)) with 1/R = 1/9.5 mm - 1/10 mm, s = (1 - nu^2)/E
      stiffness = 4.0_wp/3.0_wp*sqrt(10.0e-3_wp*9.5e-3_wp/0.5e-3_wp)*207.0e9_wp/(2.0_wp*0.91_wp)
      depth = (5.0_wp*mass*speed**2/(4.0_wp*stiffness))**0.4_wp
      duration = shape*depth/speed
      call check_equal(error, keeper%n_event, 4, "contacts")
      if (allocated(error)) return
      do k = 1, 4
         associate (event => keeper%events(k))
            call check_close(error, event%time, (2*k - 1)*clearance/speed + (k - 1)*duration, 1.0e-12_wp, "onset")
            call check_close(error, event%impact_speed, speed, 1.0e-7_wp, "impact speed")
            call check_close(error, event%release_speed, speed, 1.0e-7_wp, "release speed")
            call check_close(error, event%duration, duration, 1.0e-8_wp, "duration", relative=.true.)
            call check_close(error, event%peak_force, stiffness*depth**1.5_wp, 1.0e-7_wp, "peak force", relative=.true.)
            call check_close(error, event%peak_penetration, depth, 1.0e-7_wp, "peak penetration", relative=.true.)
            call check_close(error, event%energy_lost, 0.0_wp, 1.0e-15_wp, "energy lost")
            call check_equal(error, event%kind, "contact", "kind")
            call check_equal(error, event%item, "ring", "joint")
            call check_equal(error, event%state_before, "free", "state before")
            call check_equal(error, event%state_after, "free", "state after")
         end associate
      end do
      call check_equal(error, summary%count%contacts, 4, "contacts in the summary")
      call check_equal(error, summary%count%events, 8, "onsets and ends")
   end subroutine test_elastic_pin

   !> The run ends in the middle of the second contact: a row without duration.
   subroutine test_open_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(pin//settings//"end = 0.875 ms"//nl, keeper, summary, error)
      if (allocated(error)) return
      call check_equal(error, keeper%n_event, 2, "contacts")
      if (allocated(error)) return
      call check_true(error, .not. ieee_is_nan(keeper%events(1)%duration), "the first has ended")
      associate (event => keeper%events(2))
         call check_true(error, event%time < 0.875e-3_wp .and. event%time > 0.7e-3_wp, "onset before the end")
         call check_true(error, ieee_is_nan(event%duration), "no duration")
         call check_true(error, ieee_is_nan(event%release_speed), "no release speed")
         call check_true(error, event%peak_force > 1.0e3_wp .and. event%peak_penetration > 0.0_wp, "peaks so far")
         call check_close(error, event%impact_speed, speed, 1.0e-7_wp, "impact speed")
         call check_equal(error, event%state_after, "contact", "state after")
      end associate
      call check_equal(error, summary%count%contacts, 2, "contacts in the summary")
      call check_equal(error, summary%count%events, 3, "located events")
      call check_equal(error, summary%status, status_complete, "status")
   end subroutine test_open_contact

   !> Nothing is claimed of the energy; the motion is the same to the last bit.
   subroutine test_without_ledger(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: with, without
      type(summary_t) :: summary

      call run_text(pin//settings//"end = 2 ms"//nl, with, summary, error)
      if (allocated(error)) return
      call check_true(error, summary%quality%has_ledger .and. .not. ieee_is_nan(summary%quality%energy_residual_max), "a ledger")
      call check_close(error, summary%quality%energy_max, 0.5_wp*mass*speed**2, 1.0e-8_wp, "greatest energy", relative=.true.)
      call run_text(pin//settings//"end = 2 ms"//nl//"ledger = off"//nl, without, summary, error)
      if (allocated(error)) return
      call check_true(error, .not. summary%quality%has_ledger, "no ledger")
      call check_true(error, ieee_is_nan(summary%quality%energy_residual_max), "no residual")
      call check_true(error, ieee_is_nan(without%events(1)%energy_lost), "no loss")
      call check_equal(error, without%n_event, with%n_event, "contacts")
      if (allocated(error)) return
      call check_close(error, without%events(:4)%time, with%events(:4)%time, 0.0_wp, "onsets")
   end subroutine test_without_ledger

   subroutine test_summary(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call run_text(wheel//settings//"end = 3 s"//nl//"[output]"//nl//"every = 0.1 s"//nl, keeper, summary, error)
      if (allocated(error)) return
      call check_equal(error, summary%status, status_complete, "status")
      call check_equal(error, summary%message, "", "message")
      call check_equal(error, summary%method%integrator, "verner", "method")
      call check_equal(error, summary%method%solver, "schur", "solver")
      call check_equal(error, summary%count%samples, 31, "samples")
      call check_close(error, [summary%time_start, summary%time_end], [0.0_wp, 3.0_wp], 0.0_wp, "times")
      call check_close(error, summary%method%tolerance, 1.0e-10_wp, 0.0_wp, "tolerance")
      call check_true(error, summary%count%steps > 10, "steps")
      call check_equal(error, int(summary%count%rhs_evaluations - summary%count%output_evaluations), &
                       1 + 8*int(summary%count%steps) + 7*int(summary%count%rejected_steps), "evaluations of the solution")
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

   !> A failed run: its exit code, its story, finish is called and the samples so far are kept.
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

      call run_text(wheel//settings//"end = 3 s"//nl//"maximum_steps = 12"//nl//"[output]"//nl//"every = 10 ms"//nl, &
                    keeper, summary, mistake)
      call check_failure(error, mistake, keeper, summary, exit_integration, "maximum_steps")
      if (allocated(error)) return
      call check_equal(error, int(summary%count%steps), 12, "steps")
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
      call check_failure(error, mistake, strict, summary, exit_audit, "ledger")
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

   !> A contact that begins and ends and no time passes: said so, not for ever.
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
      call check_failure(error, mistake, keeper, summary, exit_integration, "one event follows another at 'ring'")
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

end module test_dynamic
