!> Control of the step, and the events that it looks ahead to.
module test_step_control
   use archive, only: archive_t
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use event_prediction, only: predict_event
   use integrator, only: event_values_t
   use kinds, only: eps, wp
   use step_control, only: step_control_t
   use step_course, only: course_even, course_from_root, course_to_root
   implicit none (type, external)
   private
   public :: run_test_step_control

contains

   subroutine run_test_step_control(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("smooth_errors_are_met_with_the_order", test_smooth)
      call suite%test("a_rough_start_takes_one_rejection", test_rough_start)
      call suite%test("a_norm_that_swings_is_damped", test_contact_rate)
      call suite%test("contacts_begin_with_what_the_last_one_took", test_contact_start)
      call suite%test("contacts_end_in_one_step", test_contact_end)
      call suite%test("a_second_rejection_shows_the_order", test_second_rejection)
      call suite%test("a_step_ends_behind_an_event", test_across)
      call suite%test("the_way_to_a_rough_event", test_way_to_event)
      call suite%test("a_disturbance_keeps_the_step_of_before", test_disturbance)
      call suite%test("what_is_remembered_comes_back", test_memory)
      call suite%test("events_of_parabolas_are_foretold", test_parabolas)
      call suite%test("what_is_not_foretold", test_none)
   end subroutine run_test_step_control

   !> E = (h/h_1)^p of a method of order p: after a rejection the next step has E = 0.93^p; longer by four, shorter by ten.
   subroutine test_smooth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace
      real(wp) :: h

      pace = step_control_t(order=6.0_wp, h_next=0.5_wp)
      call pace%begin()
      h = pace%length()
      call pace%accept(h, h**6, .false.)
      call check_close(error, pace%h_next, 0.93_wp*0.5_wp**(1.0_wp - 0.8125_wp), 4.0_wp*eps, "longer")
      call pace%begin()
      call pace%reject(2.0_wp, 2.0_wp**6)
      call check_close(error, pace%length(), 0.93_wp, 4.0_wp*eps, "shorter")
      call pace%accept(0.93_wp, 1.0e-3_wp, .false.)
      call check_close(error, pace%h_next, 0.93_wp, 4.0_wp*eps, "no longer after a rejection")
      call pace%begin()
      call pace%accept(1.0e-3_wp, 1.0e-18_wp, .false.)
      call check_close(error, pace%h_next, 4.0e-3_wp, 1.0e-18_wp, "four times at most")
      call pace%reject(1.0_wp, huge(1.0_wp))
      call check_close(error, pace%h_next, 0.1_wp, 1.0e-15_wp, "a tenth at least")
   end subroutine test_smooth

   !> E = (h/h_1)^2.5 where a force starts.
   subroutine test_rough_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace

      pace = step_control_t(order=8.0_wp, h_next=1.0_wp)
      call pace%disturb(1.0_wp, .false.)
      call pace%begin()
      call pace%reject(1.0_wp, 100.0_wp)
      call check_close(error, pace%length(), 0.93_wp*100.0_wp**(-0.4_wp), 4.0_wp*eps, "after one rejection")
   end subroutine test_rough_start

   !> Steps of E = (h/h_1)^8 settle where 0.93 E^(-0.5625/8) is one; an estimate that now and then is much too small is not followed
   !> by a step that is rejected.
   subroutine test_contact_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace
      integer :: k

      pace = step_control_t(order=8.0_wp, h_next=0.1_wp)
      do k = 1, 60
         call pace%begin()
         call pace%accept(pace%h_next, pace%h_next**8, .false.)
      end do
      call check_close(error, pace%h_next, 0.93_wp**(1.0_wp/0.5625_wp), 1.0e-12_wp, "settled")
      call pace%begin()
      call pace%accept(pace%h_next, 0.03_wp*pace%h_next**8, .false.)
      call check_true(error, pace%h_next > 1.0_wp, "one that is too small is followed")
      call pace%reject(pace%h_next, pace%h_next**8)
      call pace%accept(pace%h_next, pace%h_next**8, .false.)
      call check_true(error, pace%h_next < 1.0_wp, "the next one not")
   end subroutine test_contact_rate

   !> E = (h/h_1)^4.5 where time goes as a square, E = (h/h_1)^2.5 where it does not; h_1 = 0.02, a hint of 0.01.
   subroutine test_contact_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace
      real(wp) :: h, power
      logical :: bends
      integer :: k

      do k = 1, 2
         bends = k == 1
         power = merge(4.5_wp, 2.5_wp, bends)
         pace = step_control_t(order=8.0_wp, h_next=1.0_wp, bends=bends)
         call pace%disturb(0.01_wp, .true.)
         call pace%begin()
         h = pace%length()
         call check_close(error, h, 0.01_wp, eps, "the first contact as hinted at")
         call check_true(error, pace%course == merge(course_from_root, course_even, bends), "how time goes")
         call pace%accept(h, 0.5_wp**power, .false.)
         call check_true(error, pace%h_next >= 2.0_wp*h, "what comes after it is smooth")
         call pace%begin()
         h = pace%length()
         call check_true(error, pace%course == course_even, "and time even")
         call pace%accept(h, 0.5_wp, .false.)
         call pace%disturb(0.0_wp, .false.)
         call check_close(error, pace%length(), 1.0_wp, eps, "between contacts")
         call pace%disturb(0.005_wp, .true.)
         call check_close(error, pace%length(), 0.93_wp*0.01_wp, 1.0e-15_wp, "twice the hint, less the safety")
         call pace%begin()
         call pace%reject(0.0093_wp, 3.0_wp**power)
         call check_close(error, pace%length(), 0.93_wp*0.0093_wp/3.0_wp, 1.0e-15_wp, "rejected")
      end do
   end subroutine test_contact_start

   !> A force that ends at t = 1: steps of 0.2, the last one of E = (h/0.05)^4.5.
   subroutine test_contact_end(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace
      real(wp) :: h, norm, t
      integer :: k, n_bent, n_rejected

      pace = step_control_t(order=8.0_wp, h_next=1.0_wp, bends=.true.)
      call pace%disturb(0.05_wp, .true.)
      call pace%begin()
      t = pace%length()
      call pace%accept(t, 0.5_wp, .false.)
      pace%h_next = 0.2_wp
      n_bent = 0
      n_rejected = 0
      do k = 1, 40
         call pace%begin()
         pace%h_event = 1.0_wp - t
         pace%is_parting = .true.
         h = pace%length()
         norm = (h/0.2_wp)**8
         if (t + h > 1.0_wp) then
            norm = 1.0e4_wp*h**2.5_wp
            if (pace%course == course_to_root) norm = (h/0.05_wp)**4.5_wp
         end if
         if (norm > 1.0_wp) then
            n_rejected = n_rejected + 1
            call pace%reject(h, norm)
            cycle
         end if
         if (pace%course == course_to_root) n_bent = n_bent + 1
         call pace%accept(h, norm, .false.)
         t = t + h
         if (t >= 1.0_wp) exit
      end do
      call check_true(error, t >= 1.0_wp, "it arrives")
      call check_true(error, n_bent == 1, "by one step of time as a square")
      call check_true(error, n_rejected == 0, "none is rejected")
      call check_true(error, k <= 9, "few steps")
   end subroutine test_contact_end

   subroutine test_second_rejection(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: pace

      pace = step_control_t(order=8.0_wp, h_next=1.0_wp)
      call pace%accept(1.0_wp, 1.0_wp, .false.)
      call pace%begin()
      call pace%reject(0.4_wp, 1000.0_wp*0.4_wp**3)
      call pace%reject(0.2_wp, 1000.0_wp*0.2_wp**3)
      call check_close(error, pace%h_next, 0.093_wp, 1.0e-15_wp, "E = (h/0.1)^3")
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
      call pace%disturb(1.0e-3_wp, .false.)
      call check_close(error, pace%length(), 1.0e-3_wp, eps, "the step that was hinted at")
      call pace%disturb(1.0e-4_wp, .false.)
      call pace%disturb(0.0_wp, .false.)
      call check_close(error, pace%length(), 1.0_wp, eps, "the step of before")
   end subroutine test_disturbance

   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_control_t) :: other, pace
      type(archive_t) :: archive

      pace = step_control_t(order=6.0_wp, h_next=1.0_wp, h_event=0.5_wp)
      call pace%disturb(0.25_wp, .true.)
      call pace%accept(0.25_wp, 0.7_wp, .false.)
      call pace%disturb(0.25_wp, .false.)
      pace%h_event = 0.2_wp
      call check_close(error, pace%length(), 0.204_wp, eps, "across")
      call pace%reject(0.204_wp, 50.0_wp)
      other = step_control_t(order=6.0_wp)
      call pace%save(archive)
      call other%load(archive)
      call check_true(error, archive%is_at_end(), "as many numbers read as written")
      call check_close(error, other%length(), pace%length(), 0.0_wp, "length")
      call other%disturb(0.0_wp, .false.)
      call pace%disturb(0.0_wp, .false.)
      call check_close(error, other%length(), pace%length(), 0.0_wp, "length of before")
      call other%disturb(0.25_wp, .true.)
      call pace%disturb(0.25_wp, .true.)
      call check_close(error, other%length(), pace%length(), 0.0_wp, "length in a contact")
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

   !> Time to the event that is predicted.
   real(wp) function ahead(events, h) result(time)
      type(event_values_t), intent(in) :: events   !! the functions
      real(wp), intent(in) :: h                    !! length of the step [s]

      integer :: event

      call predict_event(events, h, time, event)
      if (event > 0) then
         if (events%is_hidden(event) .or. events%rate1(event) <= 0.0_wp) time = -1.0_wp  ! it cannot be that one
      else if (time < huge(1.0_wp)) then
         time = -1.0_wp
      end if
   end function ahead

   !> g = 3 s^2 + s - 2 has its zero at 2/3; the later zero of 4 s - 4 at 1; steps of length 0.2 that end at s = 0.3.
   subroutine test_parabolas(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(event_values_t) :: events

      call fill(events, [g(0.1_wp), -3.6_wp], [1.6_wp, 4.0_wp], [g(0.3_wp), -2.8_wp], [2.8_wp, 4.0_wp])
      call check_close(error, ahead(events, 0.2_wp), 2.0_wp/3.0_wp - 0.3_wp, 8.0_wp*eps, "the first one")
      events%is_hidden(1) = .true.
      call check_close(error, ahead(events, 0.2_wp), 0.7_wp, 64.0_wp*eps, "that which is not hidden")

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
      call check_true(error, ahead(events, 0.1_wp) >= huge(1.0_wp), "none")
      call fill(events, [0.0_wp], [0.0_wp], [0.0_wp], [0.0_wp])
      call check_true(error, ahead(events, 0.1_wp) >= huge(1.0_wp), "nothing moves")
   end subroutine test_none

end module test_step_control
