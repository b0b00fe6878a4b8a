!> Runs that fail or are not right: what the message names, which warnings are given, what is kept.
module test_failures
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t, exit_integration, exit_internal, set_error
   use kinds, only: wp
   use recorder, only: status_complete, status_failed, summary_t
   use text, only: replace, text_t
   implicit none (type, external)
   private
   public :: run_test_failures

   character(*), parameter :: nl = new_line("a")

   character(*), parameter :: shallow = "shallow hole_1 centre_1 10 0.25 steel hertz"
   character(*), parameter :: deep = "deep hole_2 centre_2 10 0.5 steel hertz"

   !> Two pins in two holes reach them at the same time; the second goes deeper.
   character(*), parameter :: pins = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]"//nl// &
      "slow 0.3 1e-4 0 0 1"//nl//"fast 0.3 1e-4 1 0 2"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hole_1 ground 0 0"//nl//"hole_2 ground 1 0"//nl// &
      "centre_1 slow 0 0"//nl//"centre_2 fast 0 0"//nl// &
      "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
      "[clearance.revolute]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law"//nl// &
      shallow//nl//deep//nl// &
      "[contact.hertz]"//nl//"name"//nl//"hertz"//nl// &
      "[analysis.dynamic]"//nl//"start = given"//nl//"end = 10 ms"//nl
   real(wp), parameter :: onset = 0.25e-3_wp  !! of both contacts [s]

   !> A pendulum without gravity, for drivers and loads, and its analysis.
   character(*), parameter :: pendulum = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"bob 2 0.05 0.4 0"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye bob -0.4 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl
   character(*), parameter :: second = "[analysis.dynamic]"//nl//"end = 1 s"//nl

contains

   subroutine run_test_failures(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("open_contacts_are_kept", test_open_contacts)
      call suite%test("deepest_contact", test_deepest_contact)
      call suite%test("driver_not_finite", test_driver_not_finite)
      call suite%test("load_not_finite", test_load_not_finite)
      call suite%test("worst_constraint", test_worst_constraint)
      call suite%test("constraints_lost", test_constraints_lost)
      call suite%test("step_that_does_not_advance", test_tiny_step)
      call suite%test("jump_of_a_driver", test_jump)
      call suite%test("ledger_that_does_not_close", test_ledger)
      call suite%test("nothing_to_warn_of", test_no_warning)
   end subroutine run_test_failures

   !> Run a deck; it must end as expected.
   subroutine run_text(text, has_failed, keeper, summary, mistake, error)
      character(*), intent(in) :: text                              !! the deck
      logical, intent(in) :: has_failed                             !! whether the integration must fail
      type(keeper_t), intent(inout) :: keeper                       !! keeps the results
      type(summary_t), intent(out) :: summary                       !! cost, errors, warnings
      character(:), allocatable, intent(out) :: mistake             !! message of the failure, else blank
      type(error_t), allocatable, intent(inout) :: error            !! first failure of the test

      type(error_t), allocatable :: reason
      type(loaded_t) :: loaded

      mistake = ""
      if (allocated(error)) return
      call load_text(text, loaded, error)
      if (allocated(error)) return
      call run_to_end(loaded, keeper, summary, reason)
      if (allocated(reason)) mistake = reason%message
      if (allocated(reason) .neqv. has_failed) then
         call set_error(error, exit_internal, "the run must fail or not, but says '"//mistake//"'")
         return
      end if
      if (has_failed) call check_equal(error, reason%code, exit_integration, "exit code")
      if (has_failed) call check_equal(error, summary%status, status_failed, "status")
      if (.not. has_failed) call check_equal(error, summary%status, status_complete, "status")
   end subroutine run_text

   !> Fail unless a text says something.
   subroutine check_says(error, text, words)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: text                    !! a message
      character(*), intent(in) :: words                   !! part of it

      call check_true(error, index(text, words) > 0, "'"//text//"' says '"//words//"'")
   end subroutine check_says

   !> All warnings in one text.
   pure function all_of(warnings) result(text)
      type(text_t), intent(in) :: warnings(:)   !! (any) warnings
      character(:), allocatable :: text         !! each in brackets

      integer :: k

      text = ""
      do k = 1, size(warnings)
         text = text//"["//warnings(k)%s//"]"
      end do
   end function all_of

   !> Steps are used up while both pins touch: each contact has its row, without an end.
   subroutine test_open_contacts(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      character(:), allocatable :: message
      integer :: k

      call run_text(pins//"step = 5 us"//nl//"maximum_steps = 56"//nl, .true., keeper, summary, message, error)
      call check_says(error, message, "maximum_steps")
      if (allocated(error)) return
      call check_true(error, summary%time_end > onset .and. summary%time_end < onset + 4.0e-5_wp, "within the contacts")
      call check_equal(error, summary%count%contacts, 2, "contacts that began")
      call check_equal(error, keeper%n_event, 2, "rows")
      if (allocated(error)) return
      do k = 1, 2
         associate (row => keeper%events(k), speed => merge(1.0_wp, 2.0_wp, keeper%events(k)%item == "shallow"))
            call check_equal(error, row%kind, "contact", "kind")
            call check_close(error, row%time, onset, 1.0e-14_wp, "onset")
            call check_close(error, row%impact_speed, speed, 1.0e-12_wp, "impact speed")
            call check_true(error, row%peak_force > 1.0e3_wp, "force so far")
            call check_true(error, ieee_is_nan(row%duration) .and. ieee_is_nan(row%release_speed), "no end")
            call check_equal(error, row%state_after, "contact", "state")
         end associate
      end do
      call check_true(error, keeper%events(1)%item /= keeper%events(2)%item, "one row for each")
   end subroutine test_open_contacts

   !> Of two touching pins the deeper one is named, before the contact none.
   subroutine test_deepest_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: before, other, within
      type(summary_t) :: summary
      character(:), allocatable :: message, swapped

      call run_text(pins//"step = 5 us"//nl//"maximum_steps = 56"//nl, .true., within, summary, message, error)
      ! 2 m/s for some 0.025 ms
      call check_says(error, message, "deepest contact there: 'deep', penetration ")
      call check_says(error, message, "e-5 m")
      swapped = replace(pins, shallow//nl//deep, deep//nl//shallow)
      call run_text(swapped//"step = 5 us"//nl//"maximum_steps = 56"//nl, .true., other, summary, message, error)
      call check_says(error, message, "deepest contact there: 'deep', penetration ")
      call run_text(pins//"step = 5 us"//nl//"maximum_steps = 40"//nl, .true., before, summary, message, error)
      if (.not. allocated(error)) call check_equal(error, index(message, "deepest"), 0, "nothing touches: place of the word")
   end subroutine test_deepest_contact

   !> A driver that ends at half a second: smooth up to there, then not a number. It is named, and not its joint, also where
   !> its body is known and another one hangs on that.
   subroutine test_driver_not_finite(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: driver = "[driver.angle]"//nl//"name joint angle"//nl// &
                                 "motor pin {0.3 rad*(1 - t/(0.5 s))^2.5}"//nl
      type(keeper_t) :: keeper, other
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pendulum//driver//second, .true., keeper, summary, message, error)
      call check_says(error, message, "'motor', or one of its derivatives, is not finite")
      call check_says(error, message, "at t = 0.5")
      call run_text(replace(replace(pendulum, "[points]", "tail 1 0.05 1.2 0"//nl//"[points]"), "[joint.revolute]", &
                            "toe bob 0.4 0"//nl//"top tail -0.4 0"//nl//"[joint.revolute]")//"low toe top"//nl//driver//second, &
                    .true., other, summary, message, error)
      call check_says(error, message, "'motor', or one of its derivatives, is not finite")
      call check_says(error, message, "at t = 0.5")
   end subroutine test_driver_not_finite

   !> So does a load, named by its force element.
   subroutine test_load_not_finite(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper, other
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pendulum//"[force.point]"//nl//"name point fx"//nl//"wind eye {sqrt(1 - t/(0.5 s))*1 N}"//nl// &
                    second, .true., keeper, summary, message, error)
      call check_says(error, message, "the load of force element 'wind' is not finite")
      call check_says(error, message, "at t = 0.5 s")
      call run_text(pendulum//"[force.torque]"//nl//"name body moment"//nl//"twist bob {log(1 - t/(0.25 s))*1 N.m}"//nl// &
                    second//"step = 10 ms"//nl, .true., other, summary, message, error)
      call check_says(error, message, "the equations of motion cannot be solved: the load of force element 'twist' is not "// &
                      "finite")
   end subroutine test_load_not_finite

   !> The worst constraint with its unit: a driver is off by radians, a pin by metres.
   subroutine test_worst_constraint(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: motor = "[driver.angle]"//nl//"name joint angle"//nl//"motor pin "
      type(keeper_t) :: angle, length
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pendulum//motor//"{0.3 rad*step(t - 0.5 s)}"//nl//second//"step = 1 ms"//nl//"maximum_steps = 501"//nl, &
                    .true., angle, summary, message, error)
      call check_says(error, message, "largest constraint violation there: 'motor', violated by 0.3 rad"//nl)
      call run_text(pendulum//"[force.torque]"//nl//"name body moment"//nl//"twist bob 1e3N.m"//nl//second//"step = 5 ms"//nl// &
                    "coordinates = full"//nl// &
                    "maximum_steps = 20"//nl, .true., length, summary, message, error)
      call check_says(error, message, "largest constraint violation there: 'pin', violated by ")
      call check_says(error, message, " m"//nl)
   end subroutine test_worst_constraint

   !> A driver that jumps by a whole turn is lost at once: exit code, and a warning that names it.
   subroutine test_constraints_lost(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pendulum//"[driver.angle]"//nl//"name joint angle"//nl// &
                    "motor pin {atan2(sin(10 rad/s*t), cos(10 rad/s*t))}"//nl//second, .true., keeper, summary, message, error)
      call check_says(error, message, "the constraints are violated: a joint is open by")
      call check_says(error, message, "'motor', violated by 6.28 rad")
      if (allocated(error)) return
      call check_says(error, all_of(summary%warnings), "'motor' was violated by 6.28 rad")
      call check_true(error, summary%time_end < 0.32_wp, "soon after the jump at 0.314 s")
   end subroutine test_constraints_lost

   !> A fixed step that cannot arrive fails at once.
   subroutine test_tiny_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pendulum//second//"step = 1e-30 s"//nl//"maximum_steps = 1000"//nl, .true., keeper, summary, message, error)
      call check_says(error, message, "the error exceeds the tolerance even at the minimum step")
      if (.not. allocated(error)) call check_true(error, summary%count%steps < 10, "no steps in place")
   end subroutine test_tiny_step

   !> A jump by less than a radian: the run is complete, and a warning names the driver.
   subroutine test_jump(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pendulum//"[driver.angle]"//nl//"name joint angle"//nl//"motor pin {0.3 rad*step(t - 0.5 s)}"//nl// &
                    second, .false., keeper, summary, message, error)
      if (allocated(error)) return
      call check_says(error, all_of(summary%warnings), "'motor' was violated by 0.3 rad; check for a jump of a driver")
   end subroutine test_jump

   !> Far too large a tolerance: contacts that the steps hardly see.
   subroutine test_ledger(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: with, without
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pins//"tolerance = 1e-2"//nl, .false., with, summary, message, error)
      if (allocated(error)) return
      call check_true(error, summary%quality%energy_residual_max > 1.0e-3_wp*summary%quality%energy_max, "the ledger is open")
      call check_equal(error, size(summary%warnings), 1, "warnings")
      call check_says(error, all_of(summary%warnings), "energy balance violated: the energy error reached 0.")
      call run_text(pins//"tolerance = 1e-2"//nl//"ledger = off"//nl, .false., without, summary, message, error)
      if (.not. allocated(error)) call check_equal(error, all_of(summary%warnings), "", "warnings without a ledger")
   end subroutine test_ledger

   subroutine test_no_warning(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: driven, clearance_joints
      type(summary_t) :: summary
      character(:), allocatable :: message

      call run_text(pins, .false., clearance_joints, summary, message, error)
      if (.not. allocated(error)) call check_equal(error, all_of(summary%warnings), "", "warnings of the pins")
      call run_text(pendulum//"[driver.angle]"//nl//"name joint angle"//nl//"motor pin {0.3 rad*sin(20 rad/s*t)}"//nl// &
                    second, .false., driven, summary, message, error)
      if (.not. allocated(error)) call check_equal(error, all_of(summary%warnings), "", "warnings of the driven pendulum")
   end subroutine test_no_warning

end module test_failures
