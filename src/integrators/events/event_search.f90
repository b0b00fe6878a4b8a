!> The search for the first event of a step on its interpolant; `event_location` decides whether to search.
!>
!> The step is halved, down to eighths: only parts whose ends leave storage for an event are looked into, the first ones first, and
!> a part is not halved where all functions that may become positive in it only rise. Where a step is longer than events may stay
!> unseen, all eighths are looked at besides, and places in them, up to what was found.
!>
!> The bracket of an event is narrowed by Newton's iteration, its tangent bent as the cubic of Hermite through the place before is,
!> and by halves where that does not close in, until the event is reported as closely as the caller asks for, or the bracket is
!> narrow.
module event_search
   use event_chance, only: is_long, leaves_room, only_rises
   use integrator, only: integrator_t, kept_places
   use kinds, only: i8, wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: search, state_at

   integer, parameter :: n_level = kept_places - 2   !! times that a step is halved
   integer, parameter :: n_sample = 2**n_level       !! places of a long step looked at, at least
   integer, parameter :: n_bisect = 30     !! halvings in search of a maximum on the interpolant
   integer, parameter :: n_narrow = 72     !! places looked at to narrow the bracket of an event, at most
   real(wp), parameter :: narrow_enough = 2.0_wp**(-28)  !! width of that bracket: the integrator does the rest [1]

contains

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

   !> The search itself, at places of the step and between them.
   subroutine search(system, method, near, event, low, high, place)
      class(ode_system_t), intent(inout) :: system  !! the system
      class(integrator_t), intent(inout) :: method  !! the integrator, after a step
      real(wp), intent(in) :: near                  !! how closely the event is to be reported; 0: by a narrow bracket [1]
      integer, intent(out) :: event                 !! which function, 0: none
      real(wp), intent(out) :: low                  !! place in the step before the event [1]
      real(wp), intent(out) :: high                 !! place after it [1]
      real(wp), intent(out) :: place                !! where the event is, between them [1]

      real(wp), allocatable :: g(:), kept_g(:, :), kept_rate(:, :), rate(:), y(:)

      ! the room of the integrator, while it itself is asked for states
      call move_alloc(method%scratch, y)
      call move_alloc(method%events%g, g)
      call move_alloc(method%events%rate, rate)
      call move_alloc(method%events%kept_g, kept_g)
      call move_alloc(method%events%kept_rate, kept_rate)
      event = 0
      place = 1.0_wp
      call look_into_halves(low, high)
      if (is_long(system, method)) call look_everywhere(low, high)
      if (event > 0) call narrow(low, high, place)
      if (event == 0) call system%settle(method%step%t0 + method%step%h, method%step%y1, g, rate)
      call move_alloc(y, method%scratch)
      call move_alloc(g, method%events%g)
      call move_alloc(rate, method%events%rate)
      call move_alloc(kept_g, method%events%kept_g)
      call move_alloc(kept_rate, method%events%kept_rate)

   contains

      !> Look into those halves, and halves of them, that leave storage for an event. What is known at the left end of a part is
      !> kept in the first column, at its right end and those of the parts that it belongs to in the others.
      subroutine look_into_halves(low, high)
         real(wp), intent(out) :: low    !! place before the event, if there is one [1]
         real(wp), intent(out) :: high   !! place after it [1]

         integer :: level
         logical :: bends, has_capacity
         real(wp) :: left, right(0:n_level)

         left = 0.0_wp
         kept_g(:, 1) = method%events%g0 - method%events%threshold
         kept_rate(:, 1) = method%events%rate0
         level = 0
         right(0) = 1.0_wp
         call values_at_place(right(0), kept_g(:, 2), kept_rate(:, 2))
         do
            call judge(level, (right(level) - left)*method%step%h, has_capacity, bends)
            if (bends .and. n_sample*(right(level) - left) > 1.0_wp) then
               level = level + 1
               right(level) = 0.5_wp*(left + right(level - 1))
               call values_at(right(level), kept_g(:, level + 2), kept_rate(:, level + 2))
               cycle
            end if
            if (has_capacity) then
               g = kept_g(:, level + 2)
               rate = kept_rate(:, level + 2)
               low = left
               high = right(level)
               call look_at(low, high)
               if (event > 0) return
            end if
            if (level == 0) exit
            left = right(level)
            kept_g(:, 1) = kept_g(:, level + 2)
            kept_rate(:, 1) = kept_rate(:, level + 2)
            level = level - 1
         end do
         low = 0.0_wp
         high = 1.0_wp
      end subroutine look_into_halves

      !> Whether an event may be within a part, and whether a function that may become positive there does not only rise.
      pure subroutine judge(level, h, has_capacity, bends)
         integer, intent(in) :: level       !! halvings that led to the part
         real(wp), intent(in) :: h          !! length of the part [s]
         logical, intent(out) :: has_capacity   !! it leaves room
         logical, intent(out) :: bends      !! and there may be a maximum in it

         integer :: k

         has_capacity = .false.
         bends = .false.
         do k = 1, system%n_event
            if (.not. leaves_room(kept_g(k, 1), h*kept_rate(k, 1), kept_g(k, level + 2), h*kept_rate(k, level + 2))) cycle
            has_capacity = .true.
            bends = bends .or. .not. only_rises(kept_g(k, 1), h*kept_rate(k, 1), kept_g(k, level + 2), h*kept_rate(k, level + 2))
         end do
      end subroutine judge

      !> Look at all eighths of the step, and at places in them, up to an event that is known.
      subroutine look_everywhere(low, high)
         real(wp), intent(inout) :: low    !! place before the event, if there is one [1]
         real(wp), intent(inout) :: high   !! place after it [1]

         integer :: i, known
         real(wp) :: a, b, last

         known = event
         event = 0
         last = merge(low, 1.0_wp, known > 0)
         a = 0.0_wp
         kept_rate(:, 1) = method%events%rate0
         do i = 1, n_sample
            if (a >= last) exit
            b = min(real(i, wp)/n_sample, last)
            call values_at_place(b, g, rate)
            call look_at(a, b)
            call look_between(a, b)
            if (event /= 0) then
               low = a
               high = b
               return
            end if
            a = b
            kept_rate(:, 1) = rate
         end do
         event = known
         if (event == 0) return
         call values_at_place(high, g, rate)
         call look_between(low, high)
      end subroutine look_everywhere

      !> Look for an event at a place of the step, whose event functions are known, and between the place before, whose rates are
      !> kept, and it.
      subroutine look_at(a, s)
         real(wp), intent(in) :: a     !! place before [1]
         real(wp), intent(inout) :: s  !! place; one before it, if there is an event there [1]

         integer :: k

         do k = 1, system%n_event
            if (g(k) > 0.0_wp) event = k
         end do
         ! a maximum between two places: look at it if it may be above zero, even if another function is by now
         do k = 1, system%n_event
            if (kept_rate(k, 1) <= 0.0_wp .or. g(k) > 0.0_wp .or. rate(k) >= 0.0_wp) cycle
            if (g(k) - rate(k)*method%step%h*(s - a) > 0.0_wp) call climb(k, a, s)
         end do
      end subroutine look_at

      !> Event functions at a place of the step, from its interpolant.
      subroutine values_at(s, g, rate)
         real(wp), intent(in) :: s                      !! place [1]
         real(wp), intent(out), contiguous :: g(:)      !! (n_event) event functions less their thresholds [any]
         real(wp), intent(out), contiguous :: rate(:)   !! (n_event) their rates [any]

         call state_at(system, method, s, y)
         call method%look_at_events(system, method%step%t0 + s*method%step%h, y, g, rate)
      end subroutine values_at

      !> Event functions at a place of the step; at its end they are known.
      subroutine values_at_place(s, g, rate)
         real(wp), intent(in) :: s                      !! place [1]
         real(wp), intent(out), contiguous :: g(:)      !! (n_event) event functions less their thresholds [any]
         real(wp), intent(out), contiguous :: rate(:)   !! (n_event) their rates [any]

         if (s < 1.0_wp) then
            call values_at(s, g, rate)
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
         integer(i8) :: i, n
         integer :: k

         n = ceiling(method%step%h/n_sample/method%events%look, i8)*ceiling((b - a)*n_sample)
         if (n < 2) return
         is_above = g > 0.0_wp
         if (event > 0) is_above(event) = .true.
         k = 0
         before = a
         found = b
         do i = 1, n - 1
            s = a + (b - a)*(real(i, wp)/n)
            call values_at(s, g, rate)
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
         call values_at_place(b, g, rate)
      end subroutine look_between

      !> Follow function k to its maximum between two places; if that is above zero, it is the event
      !> and b the place of the maximum.
      subroutine climb(k, a, b)
         integer, intent(in) :: k       !! event function
         real(wp), intent(in) :: a      !! place where it rises [1]
         real(wp), intent(inout) :: b   !! place where it falls; the place of the maximum if that is an event [1]

         real(wp) :: left, place, right
         integer :: i

         left = a
         right = b
         do i = 1, n_bisect
            place = 0.5_wp*(left + right)
            call values_at(place, g, rate)
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
         call values_at_place(b, g, rate)  ! again, for the other functions
      end subroutine climb

      !> Narrow the bracket of an event; the event functions are at its upper end. Where several are positive, the first to become
      !> so decides. By Newton's method, a little beyond the root so that the next place is on its other side, and by halves where
      !> it does not close in twice as fast.
      subroutine narrow(low, high, place)
         real(wp), intent(inout) :: low    !! place before the event [1]
         real(wp), intent(inout) :: high   !! place after it [1]
         real(wp), intent(out) :: place    !! where it is, between them [1]

         real(wp) :: before, change, g_before, next, rate_before, way
         integer :: i, k, k_before

         place = high
         change = high - low
         k_before = 0
         do i = 1, n_narrow
            k = maxloc(g, dim=1)
            if (k_before == 0) then
               before = 0.0_wp
               g_before = method%events%g0(k) - method%events%threshold(k)
               rate_before = method%events%rate0(k)
               k_before = k
            end if
            next = 0.5_wp*(low + high)
            if (high - low <= narrow_enough) exit
            if (abs(g(k)) < 0.5_wp*change*method%step%h*rate(k)) then
               way = way_to_zero(k, (place - before)*method%step%h, k == k_before, g_before, rate_before)
               if (abs(way) <= near .and. place + way > low .and. place + way < high) then
                  next = place + way
                  event = k
                  exit
               end if
               next = place + way + sign(0.4_wp*narrow_enough, way)
            end if
            if (.not. (next > low .and. next < high)) next = 0.5_wp*(low + high)
            change = max(abs(next - place), narrow_enough)
            before = place
            g_before = g(k)
            rate_before = rate(k)
            k_before = k
            place = next
            call values_at(place, g, rate)
            if (any(g > 0.0_wp)) then
               high = place
               event = maxloc(g, dim=1)
            else
               low = place
            end if
         end do
         place = next
      end subroutine narrow

      !> Way from the last place to where function k is zero.
      pure real(wp) function way_to_zero(k, from_before, has_before, g_before, rate_before) result(way)
         integer, intent(in) :: k                !! event function, rising
         real(wp), intent(in) :: from_before     !! time from the place before to the last one [s]
         logical, intent(in) :: has_before       !! it is known there
         real(wp), intent(in) :: g_before        !! its value there [any]
         real(wp), intent(in) :: rate_before     !! its rate [any]

         real(wp) :: bend, time

         time = -g(k)/rate(k)
         if (has_before) then
            bend = (6.0_wp*(g_before - g(k))/from_before + 2.0_wp*rate_before + 4.0_wp*rate(k))/from_before
            if (abs(bend*time) < 0.5_wp*rate(k)) time = time - 0.5_wp*bend*time*time/rate(k)
         end if
         way = time/method%step%h
      end function way_to_zero

   end subroutine search

end module event_search
