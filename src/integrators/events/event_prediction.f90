!> How far ahead the next event is, if the event functions continue as in the last step.
!>
!> A function g at the end of a step of length h, on its way up to zero, is continued by the parabola with the curvature of the
!> cubic of Hermite there:
!>
!> $$ g_1 + g_1' s + g_1'' s^2/2 = 0, \qquad g_1'' = (6 (g_0 - g_1)/h + 2 g_0' + 4 g_1')/h $$
!>
!> Where the motion is not smooth at an event (a contact ends, a stick starts) a step across it has an error of the order of what
!> bends there, and is rejected again and again until hardly anything of it lies beyond; a step that ends a little behind the place
!> predicted is not. What is predicted only shortens a step: whether there is an event, and where, is found in the step.
!>
!> Source: Hermite's interpolation. Limits: functions that rise at the end of the last step.
module event_prediction
   use integrator, only: event_values_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: predict_event

contains

   !> Time from the end of the last step to the first event predicted; huge if there is none.
   pure subroutine predict_event(events, h, time, event)
      type(event_values_t), intent(in) :: events  !! event functions at both ends of the last step
      real(wp), intent(in) :: h                   !! its length [s]
      real(wp), intent(out) :: time               !! to the event [s]
      integer, intent(out) :: event               !! its function, 0: none

      real(wp) :: ahead, bend, per_h, root
      integer :: k

      per_h = 1.0_wp/h
      time = huge(1.0_wp)
      event = 0
      do k = 1, size(events%g1)
         if (events%is_hidden(k) .or. events%g1(k) >= 0.0_wp .or. events%rate1(k) <= 0.0_wp) cycle
         bend = (6.0_wp*(events%g0(k) - events%g1(k))*per_h + 2.0_wp*events%rate0(k) + 4.0_wp*events%rate1(k))*per_h
         root = events%rate1(k)**2 - 2.0_wp*bend*events%g1(k)
         if (root <= 0.0_wp) cycle
         ahead = -2.0_wp*events%g1(k)/(events%rate1(k) + sqrt(root))
         if (ahead >= time) cycle
         time = ahead
         event = k
      end do
   end subroutine predict_event

end module event_prediction
