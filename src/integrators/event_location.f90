!> Where in a step an event function first becomes positive, from the step's interpolant.
!>
!> A sign change at the ends is not enough: a contact may begin and end within a step. The
!> interpolant is searched wherever the values and rates at the ends leave room for a maximum above
!> zero, at eight places, and everywhere at least once in an interval that the caller sets (that of the output), so that no
!> function is above zero there unseen. Where the ends leave no room, a glance at that interval says whether to search. What is
!> found is a bracket, the same one whatever that interval is; the integrator goes into it by its own means (a one-step method
!> re-steps, so that the event is as accurate as the step, not as the interpolant).
!>
!> Noise: an event function g is known to its round-off r only (`event_noise`), the time of an event to some spacings of time. So
!> - a function that begins a step at g_0 > -r must rise above g_0 + r, its threshold, to be at its event: one that has just had it,
!>   or parts from it, is at none, whatever its last digits say; all others have the threshold zero;
!> - an event wants a rate > 0: a function found above its threshold that does not rise is at none in this step;
!> - all functions that rise, at zero to r and to the spacing of time, are at their events together with the first one.
module event_location
   use event_chance, only: is_long, is_worth_a_search, may_any_happen
   use integrator, only: integrator_t
   use kinds, only: eps, i8, wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: dismiss_event, find_first_event, first_of, note_events, state_at, time_resolution

   integer, parameter :: n_sample = 8      !! places of a step looked at, at least
   integer, parameter :: n_bisect = 30     !! halvings in search of a maximum on the interpolant
   integer, parameter :: n_narrow = 72     !! places looked at to narrow the bracket of an event, at most
   real(wp), parameter :: narrow_enough = 2.0_wp**(-28)  !! width of that bracket: re-stepping does the rest [1]
   real(wp), parameter :: round_off = 100.0_wp  !! spacings of time: events closer than this are one [1]

contains

   !> Look for the first event of a step.
   !>
   !> At the start of a step every event function counts as negative, whatever its last digits say:
   !> an event just handled leaves its function at zero.
   subroutine find_first_event(system, method, event, low, high)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step; its scratch is used
      integer, intent(out) :: event                 !! which function, 0: none
      real(wp), intent(out) :: low                  !! place in the step before the event [1]
      real(wp), intent(out) :: high                 !! place in the step after it [1]

      logical :: is_seen

      event = 0
      low = 0.0_wp
      high = 1.0_wp
      method%events%threshold = 0.0_wp
      if (.not. may_any_happen(system, method)) then
         if (.not. is_long(system, method)) return
         call glance(system, method, is_seen)
         if (.not. is_seen) return
      end if
      call set_thresholds(system, method)
      if (is_worth_a_search(system, method)) call search(system, method, event, low, high)
   end subroutine find_first_event

   !> A function that was found is at no event in this step after all: look for the first of the others.
   subroutine dismiss_event(system, method, event, low, high)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step; its scratch is used
      integer, intent(inout) :: event               !! the function; then which other one, 0: none
      real(wp), intent(out) :: low                  !! place in the step before the event [1]
      real(wp), intent(out) :: high                 !! place in the step after it [1]

      method%events%threshold(event) = huge(1.0_wp)
      event = 0
      low = 0.0_wp
      high = 1.0_wp
      if (is_worth_a_search(system, method)) call search(system, method, event, low, high)
   end subroutine dismiss_event

   !> State at a place of the step, from its interpolant; no event depends on quadratures.
   subroutine state_at(system, method, s, y)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, after a step
      real(wp), intent(in) :: s                     !! the place [1]
      real(wp), intent(inout) :: y(system%n)        !! (n) the state [any]

      system%traits%with_quadratures = .false.
      call method%within(system, s, y)
      system%traits%with_quadratures = .true.
   end subroutine state_at

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

   !> The search itself, at places of the step and between them.
   subroutine search(system, method, event, low, high)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step
      integer, intent(out) :: event                 !! which function, 0: none
      real(wp), intent(out) :: low                  !! place in the step before the event [1]
      real(wp), intent(out) :: high                 !! place in the step after it [1]

      real(wp), allocatable :: g(:), rate(:), y(:)
      real(wp) :: a, b
      integer(i8) :: n_inner
      integer :: i

      ! the room of the integrator, while it itself is asked for states
      call move_alloc(method%scratch, y)
      call move_alloc(method%events%g, g)
      call move_alloc(method%events%rate, rate)
      event = 0
      low = 0.0_wp
      high = 1.0_wp
      a = 0.0_wp
      n_inner = ceiling(method%step%h/n_sample/method%events%look, i8)
      do i = 1, n_sample
         b = real(i, wp)/n_sample
         call look_at(b)
         if (event /= 0) exit
         a = b
      end do
      if (event == 0) then
         call system%settle(method%step%t0 + method%step%h, method%step%y1, g, rate)
      else
         low = a
         high = b
         call narrow(low, high)
      end if
      call move_alloc(y, method%scratch)
      call move_alloc(g, method%events%g)
      call move_alloc(rate, method%events%rate)

   contains

      !> Look for an event at a place of the step, and between the place before and it.
      subroutine look_at(s)
         real(wp), intent(inout) :: s  !! place; one before it, if there is an event there [1]

         integer :: k

         call values_at_place(s)
         do k = 1, system%n_event
            if (g(k) > 0.0_wp) event = k
         end do
         ! a maximum between two places: look at it if it may be above zero, even if another function is by now
         do k = 1, system%n_event
            if (g(k) <= 0.0_wp .and. rate(k) < 0.0_wp .and. g(k) - rate(k)*method%step%h*(s - a) > 0.0_wp) call climb(k, a, s)
         end do
         if (n_inner > 1) call look_between(a, s)
      end subroutine look_at

      !> Event functions at a place of the step, from its interpolant.
      subroutine values_at(s)
         real(wp), intent(in) :: s  !! place [1]

         call state_at(system, method, s, y)
         call method%look_at_events(system, method%step%t0 + s*method%step%h, y, g, rate)
      end subroutine values_at

      !> Event functions at a place of the step; at its end they are known.
      subroutine values_at_place(s)
         real(wp), intent(in) :: s  !! place [1]

         if (s < 1.0_wp) then
            call values_at(s)
         else
            g = method%events%g1 - method%events%threshold
            rate = method%events%rate1
         end if
      end subroutine values_at_place

      !> Look at places between two: for an event there that is over by the upper place. The bracket of one that is not stays
      !> what it is.
      subroutine look_between(a, b)
         real(wp), intent(inout) :: a   !! place before the event [1]
         real(wp), intent(inout) :: b   !! place after it, the event functions are there [1]

         logical :: is_above(system%n_event)
         real(wp) :: before, found, s
         integer(i8) :: i
         integer :: k

         is_above = g > 0.0_wp
         if (event > 0) is_above(event) = .true.
         k = 0
         before = a
         found = b
         do i = 1, n_inner - 1
            s = a + (b - a)*(real(i, wp)/n_inner)
            call values_at(s)
            if (k > 0) then
               if (g(k) > 0.0_wp) cycle
               is_above(k) = .false.
               exit
            else if (all(g <= 0.0_wp)) then
               before = s
            else
               k = maxloc(g, dim=1)
               found = s
               if (.not. is_above(k)) exit
            end if
         end do
         if (k > 0) then
            if (.not. is_above(k)) then
               event = k
               a = before
               b = found
            end if
         end if
         call values_at_place(b)
      end subroutine look_between

      !> Follow function k to its maximum between two places; if that is above zero, it is the event
      !> and b the place of the maximum.
      subroutine climb(k, a, b)
         integer, intent(in) :: k       !! event function
         real(wp), intent(in) :: a      !! place where it may rise [1]
         real(wp), intent(inout) :: b   !! place where it falls; the place of the maximum if that is an event [1]

         real(wp) :: left, place, right
         integer :: i

         call values_at(a)
         if (rate(k) <= 0.0_wp) then
            ! it only falls; values at b again, for the other functions
            call values_at(b)
            return
         end if
         left = a
         right = b
         do i = 1, n_bisect
            place = 0.5_wp*(left + right)
            call values_at(place)
            if (g(k) > 0.0_wp) then
               event = k
               b = place
               return
            end if
            if (rate(k) > 0.0_wp) then
               left = place
            else
               right = place
            end if
            if (g(k) + abs(rate(k))*method%step%h*(right - left) < 0.0_wp) exit
         end do
         ! values at b again, for the other functions
         call values_at(b)
      end subroutine climb

      !> Narrow the bracket of an event; the event functions are at its upper end. Where several are positive, the first to become
      !> so decides. By Newton's method, a little beyond the root so that the next place is on its other side, and by halves where
      !> it does not close in twice as fast.
      subroutine narrow(low, high)
         real(wp), intent(inout) :: low   !! place before the event [1]
         real(wp), intent(inout) :: high  !! place after it [1]

         real(wp) :: beyond, change, next, place
         integer :: i, k

         place = high
         change = high - low
         do i = 1, n_narrow
            if (high - low <= narrow_enough) exit
            k = maxloc(g, dim=1)
            beyond = sign(0.4_wp*narrow_enough, -g(k))
            next = 0.5_wp*(low + high)
            if (abs(g(k)) < 0.5_wp*change*method%step%h*rate(k)) next = place - g(k)/(method%step%h*rate(k)) + beyond
            if (.not. (next > low .and. next < high)) next = 0.5_wp*(low + high)
            change = max(abs(next - place), narrow_enough)
            place = next
            call values_at(place)
            if (any(g > 0.0_wp)) then
               high = place
               event = maxloc(g, dim=1)
            else
               low = place
            end if
         end do
      end subroutine narrow

   end subroutine search

end module event_location
