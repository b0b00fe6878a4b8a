!> Contacts that start and end within a step, where onsets are searched at the ends of steps only.
!>
!> The interpolant of the step is looked at wherever the gaps at its ends leave storage for a contact, at eight places and at least
!> as often as the output asks for, as located onsets are. A gap function (positive: the surfaces overlap) that rises above zero and
!> is not above it, or falls, where the step ends belongs to a contact that is passed over: it never gets a force. A function that
!> starts the step within its round-off must rise above that, so that a contact that has just ended is none.
!>
!> Nothing of the motion follows from this; it is counted, and the run reports it. Signs: event functions of onsets are
!> penetrations. Source: none, the search is that of `event_location`. Limits: what the interpolant shows at these places and at the
!> maxima between them.
module passed_onsets
   use event_chance, only: is_long, may_happen
   use event_search, only: state_at
   use integrator, only: integrator_t
   use kinds, only: i8, wp
   use ode_system, only: contact_onset, ode_system_t
   implicit none (type, external)
   private
   public :: note_passed

   integer, parameter :: n_sample = 8      !! places of a step looked at, at least
   integer, parameter :: n_bisect = 30     !! halvings in search of a maximum on the interpolant

contains

   !> Count the contacts that the last step passed over.
   subroutine note_passed(system, method, last)
      class(ode_system_t), intent(inout) :: system   !! the system, last evaluated at the end of the step; and left there
      class(integrator_t), intent(inout) :: method   !! the integrator, after a step; its scratch is used
      real(wp), intent(in) :: last                   !! up to where the step stands, 0 to 1 [1]

      real(wp), allocatable :: y(:)
      real(wp) :: s, s_before
      integer(i8) :: i, n
      integer :: k

      if (.not. is_long(system, method)) then
         if (.not. any([(leaves_room(system, method, k), k=1, system%n_event)])) return
      end if
      associate (passed => method%onset%passed, events => method%events)
         call system%event_noise(events%noise)
         passed%top = 0.0_wp
         passed%rate_before = method%onset%rate
         call move_alloc(method%scratch, y)  ! the room of the integrator, while it itself is asked for states
         n = max(int(n_sample, i8), ceiling(last*method%step%h/events%look, i8))
         s_before = 0.0_wp
         do i = 1, n
            s = last*(real(i, wp)/real(n, wp))
            if (s < 1.0_wp) then
               call state_at(system, method, s, y)
               call system%events(method%step%t0 + s*method%step%h, y, passed%gap, passed%rate)
            else
               passed%gap = method%onset%end_gap
               passed%rate = method%onset%end_rate
            end if
            do k = 1, system%n_event
               if (system%contact_change(k) == contact_onset) call follow(system, method, k, s_before, s, y)
            end do
            passed%rate_before = passed%rate
            s_before = s
         end do
         do k = 1, system%n_event  ! overlapping where the step ends, but no longer approaching: that starts no contact
            if (last >= 1.0_wp .and. passed%top(k) > 0.0_wp .and. passed%rate(k) <= 0.0_wp) call count_one(method, k)
         end do
         call system%settle(method%step%t0 + method%step%h, method%step%y1, passed%gap, passed%rate)
         call move_alloc(y, method%scratch)
      end associate
   end subroutine note_passed

   !> Whether the ends of the step leave storage for a contact.
   logical function leaves_room(system, method, k)
      class(ode_system_t), intent(in) :: system      !! the system
      class(integrator_t), intent(in) :: method      !! the integrator, after a step
      integer, intent(in) :: k                       !! event function

      leaves_room = .false.
      if (system%contact_change(k) /= contact_onset) return
      associate (onset => method%onset, h => method%step%h)
         leaves_room = may_happen(onset%gap(k), h*onset%rate(k), onset%end_gap(k), h*onset%end_rate(k))
      end associate
   end function leaves_room

   !> A function from one place to the next: it stays above what it must exceed, falls from there, or may have had a maximum
   !> between.
   subroutine follow(system, method, k, a, b, y)
      class(ode_system_t), intent(inout) :: system   !! the system
      class(integrator_t), intent(inout) :: method   !! the integrator, after a step; functions at b are known
      integer, intent(in) :: k                       !! event function
      real(wp), intent(in) :: a                      !! place before [1]
      real(wp), intent(in) :: b                      !! this place [1]
      real(wp), intent(inout) :: y(:)                !! (n) scratch state [any]

      real(wp) :: threshold

      threshold = max(method%onset%gap(k) + method%events%noise(k), 0.0_wp)
      associate (passed => method%onset%passed, step => method%step)
         if (passed%gap(k) > threshold) then
            call raise(method, k, passed%gap(k), b)
            if (passed%rate(k) < 0.0_wp .and. passed%rate_before(k) > 0.0_wp) call climb(system, method, k, a, b, y)
            return
         end if
         if (passed%rate(k) < 0.0_wp .and. passed%rate_before(k) > 0.0_wp) then
            if (passed%gap(k) - passed%rate(k)*step%h*(b - a) > threshold) call climb(system, method, k, a, b, y)
         end if
         if (passed%top(k) > threshold) call count_one(method, k)
         passed%top(k) = 0.0_wp
      end associate
   end subroutine follow

   !> Follow a function to its maximum between two places: it rises at the first and falls at the second.
   subroutine climb(system, method, k, a, b, y)
      class(ode_system_t), intent(inout) :: system   !! the system
      class(integrator_t), intent(inout) :: method   !! the integrator, after a step; its scratch is used
      integer, intent(in) :: k                       !! event function
      real(wp), intent(in) :: a                      !! place where it rises [1]
      real(wp), intent(in) :: b                      !! place where it falls [1]
      real(wp), intent(inout) :: y(:)                !! (n) scratch state [any]

      real(wp) :: left, place, right
      integer :: i

      left = a
      right = b
      associate (g => method%events%g, rate => method%events%rate, step => method%step)
         do i = 1, n_bisect
            place = 0.5_wp*(left + right)
            call state_at(system, method, place, y)
            call system%events(step%t0 + place*step%h, y, g, rate)
            call raise(method, k, g(k), place)
            if (rate(k) > 0.0_wp) then
               left = place
            else
               right = place
            end if
            if (abs(rate(k))*step%h*(right - left) < 1.0e-3_wp*abs(g(k))) exit
         end do
      end associate
   end subroutine climb

   !> The maximum value of a function since it is above zero.
   subroutine raise(method, k, value, s)
      class(integrator_t), intent(inout) :: method   !! the integrator
      integer, intent(in) :: k                       !! event function
      real(wp), intent(in) :: value                  !! its value [any]
      real(wp), intent(in) :: s                      !! place in the step [1]

      associate (passed => method%onset%passed)
         if (value <= passed%top(k)) return
         passed%top(k) = value
         passed%top_at(k) = method%step%t0 + s*method%step%h
      end associate
   end subroutine raise

   !> One contact more was passed over.
   subroutine count_one(method, k)
      class(integrator_t), intent(inout) :: method   !! the integrator
      integer, intent(in) :: k                       !! event function

      associate (passed => method%onset%passed)
         passed%n(k) = passed%n(k) + 1
         if (passed%n(k) == 1) passed%first(k) = passed%top_at(k)
         if (passed%top(k) <= passed%deepest(k)) return
         passed%deepest(k) = passed%top(k)
         passed%at(k) = passed%top_at(k)
      end associate
   end subroutine count_one

end module passed_onsets
