!> The analysis: what it reports of contacts, in rows of events, and of the energy.
module test_contact_rows
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t
   use dynamic_fixture, only: clearance, mass, pin, run_text, settings, speed
   use errors, only: error_t
   use kinds, only: pi, wp
   use recorder, only: status_complete, summary_t
   use scene_fixture, only: nl
   implicit none (type, external)
   private
   public :: run_test_contact_rows

contains

   subroutine run_test_contact_rows(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("events_of_an_elastic_pin", test_elastic_pin)
      call suite%test("open_contact_at_the_end", test_open_contact)
      call suite%test("without_ledger", test_without_ledger)
   end subroutine run_test_contact_rows

   !> Energy m v^2/2 = 2 K d^2.5 / 5 at the maximum penetration d; duration 2.9432 d/v. Source: Hertz (1882).
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

end module test_contact_rows
