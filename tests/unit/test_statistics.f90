!> What contacts do in a window, from made-up events; histograms.
module test_statistics
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use event_list, only: event_list_t
   use kinds, only: not_a_number, wp
   use recorder, only: event_t
   use contact_statistics, only: histogram, joint_statistics, joint_statistics_t
   implicit none (type, external)
   private
   public :: run_test_statistics

contains

   subroutine run_test_statistics(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("contacts_of_a_joint_are_joined", contacts_of_a_joint_are_joined)
      call suite%test("what_lies_outside_does_not_count", what_lies_outside_does_not_count)
      call suite%test("histogram_counts_all", histogram_counts_all)
   end subroutine run_test_statistics

   !> Report a contact.
   subroutine tell(events, item, label, onset, duration, speed)
      type(event_list_t), intent(inout) :: events  !! the list
      character(*), intent(in) :: item             !! joint
      character(*), intent(in) :: label            !! contact within it
      real(wp), intent(in) :: onset                !! time [s]
      real(wp), intent(in) :: duration             !! NaN: not ended [s]
      real(wp), intent(in) :: speed                !! impact speed [m/s]

      type(event_t) :: event
      logical :: is_added

      event%time = onset
      event%duration = duration
      event%impact_speed = speed
      event%peak_force = 10.0_wp*speed
      event%kind = "contact"
      event%item = item
      event%contact = label
      event%state_before = "free"
      event%state_after = "free"
      call events%add(event, is_added)
   end subroutine tell

   !> Two corners of a slider: times with both closed count once; the other joint and other events do not count.
   subroutine contacts_of_a_joint_are_joined(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(event_list_t) :: events
      logical :: is_added
      type(event_t) :: slip
      type(joint_statistics_t) :: joint

      ! reported when they end, so not in the order of their onsets
      call tell(events, "guide", "B", 2.0_wp, 1.0_wp, 2.0_wp)
      call tell(events, "guide", "A", 1.0_wp, 4.0_wp, 1.0_wp)
      call tell(events, "other", "", 0.0_wp, 10.0_wp, 9.0_wp)
      call tell(events, "guide", "B", 4.5_wp, 1.0_wp, 3.0_wp)
      call tell(events, "guide", "A", 9.0_wp, not_a_number(), 4.0_wp)
      slip%kind = "slip"
      slip%item = "guide"
      slip%time = 7.0_wp
      slip%duration = 1.0_wp
      call events%add(slip, is_added)
      call joint_statistics("guide", events, 0.0_wp, 10.0_wp, joint)
      call check_close(error, joint%contact_fraction, 0.55_wp, 1.0e-15_wp, "from 1 to 5.5 and from 9 to 10")
      call check_true(error, size(joint%speeds) == 4, "four impacts")
      if (allocated(error)) return
      call check_close(error, joint%speeds, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], 0.0_wp, "in the order of their onsets")
      call check_close(error, joint%forces, 10.0_wp*joint%speeds, 0.0_wp, "forces beside speeds")
   end subroutine contacts_of_a_joint_are_joined

   !> A contact that started before the window is closed in it, but no impact of it; one that ends behind it is cut.
   subroutine what_lies_outside_does_not_count(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(event_list_t) :: events
      type(joint_statistics_t) :: joint

      call tell(events, "pin", "", 0.5_wp, 1.0_wp, 1.0_wp)
      call tell(events, "pin", "", 1.8_wp, 5.0_wp, 2.0_wp)
      call tell(events, "pin", "", 7.0_wp, 1.0_wp, 3.0_wp)
      call joint_statistics("pin", events, 1.0_wp, 2.0_wp, joint)
      call check_close(error, joint%contact_fraction, 0.7_wp, 1.0e-14_wp, "0.5 and 0.2 of a second")
      call check_true(error, size(joint%speeds) == 1, "one impact")
   end subroutine what_lies_outside_does_not_count

   !> Every value is in one bin; the maximum in the last, an edge in the upper one.
   subroutine histogram_counts_all(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: counts(4)
      real(wp) :: edges(5)

      call histogram([0.0_wp, 0.9_wp, 1.0_wp, 3.5_wp, 4.0_wp], edges, counts)
      call check_close(error, edges, [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], 0.0_wp, "edges")
      call check_true(error, all(counts == [2, 1, 0, 2]), "counts")
      call histogram([real(wp) ::], edges, counts)
      call check_true(error, all(counts == 0), "nothing")
   end subroutine histogram_counts_all

end module test_statistics
