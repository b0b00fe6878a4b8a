!> Where in a step an event function first becomes positive, from the step's interpolant.
!>
!> A sign change at the ends is not enough: a contact may start and end within a step. The
!> interpolant is searched (`event_search`) wherever the values and rates at the ends leave storage for a maximum above
!> zero, and everywhere at least once in an interval that the caller sets (that of the output), so that no
!> function is above zero there unseen. Where the ends leave no storage, a glance at that interval says whether to search. What is
!> found is a bracket, the same one whatever that interval is, and a place in it; the integrator goes there by its own means (a
!> one-step method re-steps, so that the event is as accurate as the step, not as the interpolant).
!>
!> Noise: an event function g is known to its round-off r only (`event_noise`), the time of an event to some spacings of time. So
!> - a function that starts a step at g_0 > -r must rise above g_0 + r, its threshold, to be at its event: one that has just had it,
!>   or parts from it, is at none, whatever its last digits say; all others have the threshold zero;
!> - an event needs a rate > 0: a function found above its threshold that does not rise is at none in this step;
!> - all functions that rise, at zero to r and to the spacing of time, are at their events together with the first one.
module event_location
   use event_chance, only: is_long, is_worth_a_search, may_any_happen
   use event_search, only: search, state_at
   use integrator, only: integrator_t
   use kinds, only: eps, i8, wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: dismiss_event, find_first_event, first_of, note_events, time_resolution

   real(wp), parameter :: round_off = 100.0_wp  !! spacings of time: events closer than this are one [1]

contains

   !> Look for the first event of a step.
   !>
   !> At the start of a step every event function counts as negative, whatever its last digits say:
   !> an event just handled leaves its function at zero.
   subroutine find_first_event(system, method, near, event, low, high, place)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step; its scratch is used
      real(wp), intent(in) :: near                  !! how closely the event is to be reported; 0: by a narrow bracket [1]
      integer, intent(out) :: event                 !! which function, 0: none
      real(wp), intent(out) :: low                  !! place in the step before the event [1]
      real(wp), intent(out) :: high                 !! place after it [1]
      real(wp), intent(out) :: place                !! where the event is, between them [1]

      logical :: is_seen

      event = 0
      low = 0.0_wp
      high = 1.0_wp
      place = 1.0_wp
      method%events%threshold = 0.0_wp
      if (.not. may_any_happen(system, method)) then
         if (.not. is_long(system, method)) return
         call glance(system, method, is_seen)
         if (.not. is_seen) return
      end if
      call set_thresholds(system, method)
      if (is_worth_a_search(system, method)) call search(system, method, near, event, low, high, place)
   end subroutine find_first_event

   !> A function that was found is at no event in this step after all: look for the first of the others.
   subroutine dismiss_event(system, method, near, event, low, high, place)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step; its scratch is used
      real(wp), intent(in) :: near                  !! how closely the event is to be reported; 0: by a narrow bracket [1]
      integer, intent(inout) :: event               !! the function; then which other one, 0: none
      real(wp), intent(out) :: low                  !! place in the step before the event [1]
      real(wp), intent(out) :: high                 !! place after it [1]
      real(wp), intent(out) :: place                !! where the event is, between them [1]

      method%events%threshold(event) = huge(1.0_wp)
      event = 0
      low = 0.0_wp
      high = 1.0_wp
      place = 1.0_wp
      if (is_worth_a_search(system, method)) call search(system, method, near, event, low, high, place)
   end subroutine dismiss_event

   !> What each function must exceed in the last step to be at its event. Of functions without known noise nothing is asked.
   subroutine set_thresholds(system, method)
      class(ode_system_t), intent(in) :: system     !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step

      call system%event_noise(method%events%noise)
      where (method%events%noise > 0.0_wp) method%events%threshold = max(method%events%g0 + method%events%noise, 0.0_wp)
   end subroutine set_thresholds

   !> Look at a step as often as the caller asks for: whether any function is above zero there, or by its tangent just before.
   subroutine glance(system, method, is_seen)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step; its scratch is used
      logical, intent(out) :: is_seen               !! whether one is

      real(wp), allocatable :: g(:), rate(:), y(:)
      real(wp) :: part
      integer(i8) :: i, n

      ! the room of the integrator, while it itself is asked for states
      call move_alloc(method%scratch, y)
      call move_alloc(method%events%g, g)
      call move_alloc(method%events%rate, rate)
      associate (step => method%step, events => method%events)
         n = ceiling(step%h/events%look, i8)
         part = step%h/real(n, wp)
         is_seen = is_above(system%n_event, events%g1, events%rate1, part)
         do i = 1, n - 1
            if (is_seen) exit
            call state_at(system, method, real(i, wp)/real(n, wp), y)
            call method%look_at_events(system, step%t0 + real(i, wp)*part, y, g, rate)
            is_seen = is_above(system%n_event, g, rate, part)
         end do
         call system%settle(step%t0 + step%h, step%y1, g, rate)
      end associate
      call move_alloc(y, method%scratch)
      call move_alloc(g, method%events%g)
      call move_alloc(rate, method%events%rate)
   end subroutine glance

   !> Whether any function is above zero, or falls from there by its tangent.
   pure logical function is_above(n, g, rate, time)
      integer, intent(in) :: n           !! functions
      real(wp), intent(in) :: g(n)       !! (n) event functions [any]
      real(wp), intent(in) :: rate(n)    !! (n) their rates [any]
      real(wp), intent(in) :: time       !! how far back the tangent counts [s]

      integer :: k

      is_above = .false.
      do k = 1, n
         is_above = is_above .or. g(k) > 0.0_wp .or. (rate(k) < 0.0_wp .and. g(k) - rate(k)*time > 0.0_wp)
      end do
   end function is_above

   !> Time within which events are one.
   pure real(wp) function time_resolution(method, h) result(time)
      class(integrator_t), intent(in) :: method  !! the integrator
      real(wp), intent(in) :: h                  !! length of its step, with what lies behind the event [s]

      time = round_off*eps*max(abs(method%step%t0 + h), h)
   end function time_resolution

   !> Of the functions that rise above their thresholds at a place, the one that has done so for longest, by its tangent.
   pure integer function first_of(method, at_least) result(event)
      class(integrator_t), intent(in) :: method    !! the integrator, `g` and `rate` as `look_at_events` gives them
      real(wp), intent(in) :: at_least             !! time for which it must have done so [s]

      real(wp) :: longest
      integer :: k

      event = 0
      longest = at_least
      associate (events => method%events)
         do k = 1, size(events%g)
            if (events%rate(k) <= 0.0_wp .or. events%g(k) - events%noise(k) <= longest*events%rate(k)) cycle
            longest = (events%g(k) - events%noise(k))/events%rate(k)
            event = k
         end do
      end associate
   end function first_of

   !> Events of the last step: the one that it was ended for, and all that come with it. They are one
   !> event, because whatever is left of a function that is about to become positive would have to be located anew, with a
   !> step of round-off.
   pure subroutine note_events(method, event, h)
      class(integrator_t), intent(inout) :: method  !! the integrator, `g` and `rate` as `look_at_events` gives them at the event
      integer, intent(in) :: event                  !! number of the event function
      real(wp), intent(in) :: h                     !! length of the step, with what lies behind the event [s]

      real(wp) :: reach, time
      integer :: k

      time = time_resolution(method, h)
      associate (events => method%events)
         events%n_happened = 1
         events%happened(1) = event
         do k = 1, size(events%g)
            if (k == event .or. events%rate(k) <= 0.0_wp .or. events%threshold(k) >= huge(1.0_wp)) cycle
            reach = events%noise(k) + events%threshold(k) + time*events%rate(k)
            if (abs(events%g(k) + events%threshold(k)) > reach) cycle
            events%n_happened = events%n_happened + 1
            events%happened(events%n_happened) = k
         end do
      end associate
   end subroutine note_events

end module event_location
