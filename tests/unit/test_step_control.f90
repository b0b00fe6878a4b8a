!> Control of the step, and the events that it looks ahead to.
module test_step_control
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use event_prediction, only: time_to_event
   use integrator, only: event_values_t
   use kinds, only: eps, wp
   use step_control, only: n_control_number, step_control_t
   implicit none (type, external)
   private
   public :: run_test_step_control

contains

   subroutine run_test_step_control(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("smooth_errors_are_met_with_the_order", test_smooth)
      call suite%test("a_rough_start_takes_one_rejection", test_rough_start)
      call suite%test("a_second_rejection_shows_the_order", test_second_rejection)
      call suite%test("a_step_ends_behind_an_event", test_across)
      call suite%test("the_way_to_a_rough_event", test_way_to_event)
      call suite%test("a_disturbance_keeps_the_step_of_before", test_disturbance)
      call suite%test("what_is_remembered_comes_back", test_memory)
      call suite%test("events_of_parabolas_are_foretold", test_parabolas)
      call suite%test("what_is_not_foretold", test_none)
   end subroutine run_test_step_control

   !> E = (h/h_1)^p of a method of order p: the next step has E = 0.9^p, after a rejection too; longer by four, shorter by ten.
   subroutine test_smooth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace
      real(wp) :: h

      pace = step_control_t(order=6.0_wp, h_next=0.5_wp)
      call pace%begin()
      h = pace%length()
      call pace%accept(h, h**6, .false.)
      call check_close(error, pace%h_next, 0.9_wp, 4.0_wp*eps, "longer")
      call pace%begin()
      call pace%reject(2.0_wp, 2.0_wp**6)
      call check_close(error, pace%length(), 0.9_wp, 4.0_wp*eps, "shorter")
      call pace%accept(0.9_wp, 0.9_wp**6, .false.)
      call check_close(error, pace%h_next, 0.9_wp, 4.0_wp*eps, "no longer after a rejection")
      call pace%begin()
      call pace%accept(1.0e-3_wp, 1.0e-18_wp, .false.)
      call check_close(error, pace%h_next, 4.0e-3_wp, 1.0e-18_wp, "four times at most")
      call pace%reject(1.0_wp, huge(1.0_wp))
      call check_close(error, pace%h_next, 0.1_wp, 1.0e-15_wp, "a tenth at least")
   end subroutine test_smooth

   !> E = (h/h_1)^2.5 where a force begins.
   subroutine test_rough_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace

      pace = step_control_t(order=8.0_wp, h_next=1.0_wp)
      call pace%disturb(1.0_wp)
      call pace%begin()
      call pace%reject(1.0_wp, 100.0_wp)
      call check_close(error, pace%length(), 0.9_wp*100.0_wp**(-0.4_wp), 4.0_wp*eps, "after one rejection")
   end subroutine test_rough_start

   subroutine test_second_rejection(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace

      pace = step_control_t(order=8.0_wp, h_next=1.0_wp)
      call pace%accept(1.0_wp, 1.0_wp, .false.)
      call pace%begin()
      call pace%reject(0.4_wp, 1000.0_wp*0.4_wp**3)
      call pace%reject(0.2_wp, 1000.0_wp*0.2_wp**3)
      call check_close(error, pace%h_next, 0.09_wp, 1.0e-15_wp, "E = (h/0.1)^3")
      call pace%reject(0.1_wp, 8.0_wp)
      call check_close(error, pace%h_next, 0.1_wp*0.1_wp, 0.1_wp, "an estimate that does not fall")
   end subroutine test_second_rejection

   subroutine test_across(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace

      pace = step_control_t(order=8.0_wp, h_next=1.0_wp, h_event=0.5_wp)
      call check_close(error, pace%length(), 0.51_wp, eps, "a little behind it")
      call pace%accept(0.51_wp, 1.0e-2_wp, .false.)
      call check_close(error, pace%h_next, 1.0_wp, eps, "says little about the next one")
      pace%h_event = 0.9995_wp
      call check_close(error, pace%length(), 0.6_wp*0.9995_wp, eps, "a step that would end at the event")
      pace%h_event = 1.0e-3_wp
      call check_close(error, pace%length(), 1.0_wp, eps, "an event too near to be worth it")
   end subroutine test_across

   !> t^1.5 that ends at t = 1: steps come nearer until one across will do, and each passes.
   subroutine test_way_to_event(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace
      real(wp) :: h, norm, t
      integer :: k, n_rejected

      pace = step_control_t(order=8.0_wp, h_next=2.0_wp)
      call pace%accept(2.0_wp, 1.0e-9_wp, .true.)
      t = 0.0_wp
      n_rejected = 0
      do k = 1, 40
         pace%h_event = 1.0_wp - t
         h = pace%length()
         norm = 1.0e-3_wp
         if (t + h > 1.0_wp) norm = 1.0e5_wp*h**2.5_wp
         if (norm > 1.0_wp) then
            n_rejected = n_rejected + 1
            call pace%reject(h, norm)
            cycle
         end if
         call pace%accept(h, norm, .false.)
         t = t + h
         if (t >= 1.0_wp) exit
         call pace%begin()
      end do
      call check_true(error, t >= 1.0_wp, "it arrives")
      call check_true(error, n_rejected == 1, "one rejection")
      call check_true(error, k <= 8, "few steps")
   end subroutine test_way_to_event

   subroutine test_disturbance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace

      pace = step_control_t(order=6.0_wp, h_next=1.0_wp, h_event=0.1_wp)
      call pace%disturb(1.0e-3_wp)
      call check_close(error, pace%length(), 1.0e-3_wp, eps, "the step that was hinted at")
      call pace%disturb(1.0e-4_wp)
      call pace%disturb(0.0_wp)
      call check_close(error, pace%length(), 1.0_wp, eps, "the step of before")
   end subroutine test_disturbance

   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: other, pace
      real(wp) :: row(n_control_number)
      integer :: place

      pace = step_control_t(order=6.0_wp, h_next=1.0_wp, h_event=0.5_wp)
      call pace%disturb(0.25_wp)
      pace%h_event = 0.2_wp
      call check_close(error, pace%length(), 0.204_wp, eps, "across")
      call pace%reject(0.204_wp, 50.0_wp)
      other = step_control_t(order=6.0_wp)
      place = 0
      call pace%save(row, place)
      call check_true(error, place == n_control_number, "numbers written")
      place = 0
      call other%load(row, place)
      call check_true(error, place == n_control_number, "numbers read")
      call check_close(error, other%length(), pace%length(), 0.0_wp, "length")
      call other%disturb(0.0_wp)
      call pace%disturb(0.0_wp)
      call check_close(error, other%length(), pace%length(), 0.0_wp, "length of before")
   end subroutine test_memory

   !> Values and rates at the ends of a step of one function each.
   subroutine fill(events, g0, rate0, g1, rate1)
      type(event_values_t), intent(out) :: events   !! the functions
      real(wp), intent(in) :: g0(:), rate0(:)       !! (n) at the start [any]
      real(wp), intent(in) :: g1(:), rate1(:)       !! (n) at the end [any]

      events%g0 = g0
      events%rate0 = rate0
      events%g1 = g1
      events%rate1 = rate1
      allocate (events%is_hidden(size(g1)), source=.false.)
   end subroutine fill

   !> g = 3 s^2 + s - 2 has its zero at 2/3; the later zero of 4 s - 4 at 1; steps of length 0.2 that end at s = 0.3.
   subroutine test_parabolas(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(event_values_t) :: events

      call fill(events, [g(0.1_wp), -3.6_wp], [1.6_wp, 4.0_wp], [g(0.3_wp), -2.8_wp], [2.8_wp, 4.0_wp])
      call check_close(error, time_to_event(events, 0.2_wp), 2.0_wp/3.0_wp - 0.3_wp, 8.0_wp*eps, "the first one")
      events%is_hidden(1) = .true.
      call check_close(error, time_to_event(events, 0.2_wp), 0.7_wp, 64.0_wp*eps, "that which is not hidden")

   contains

      pure real(wp) function g(s)
         real(wp), intent(in) :: s  !! place [s]

         g = 3.0_wp*s**2 + s - 2.0_wp
      end function g

   end subroutine test_parabolas

   !> Functions that are above zero, fall, or turn before they reach it.
   subroutine test_none(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(event_values_t) :: events

      call fill(events, [0.5_wp, -1.0_wp, -1.0_wp], [1.0_wp, -1.0_wp, 0.3_wp], [0.6_wp, -1.1_wp, -0.985_wp], &
                [1.0_wp, -1.0_wp, 1.0e-3_wp])
      call check_true(error, time_to_event(events, 0.1_wp) >= huge(1.0_wp), "none")
      call fill(events, [0.0_wp], [0.0_wp], [0.0_wp], [0.0_wp])
      call check_true(error, time_to_event(events, 0.1_wp) >= huge(1.0_wp), "nothing moves")
   end subroutine test_none

end module test_step_control
