!> Whether an event may be within a step, or a part of it, from the event functions at its ends.
module event_chance
   use integrator, only: integrator_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: is_long, is_worth_a_search, leaves_room, may_any_happen, may_happen, only_rises

contains

   !> Whether any function may become positive within the last step, or may do so unseen between two looks.
   pure logical function is_worth_a_search(system, method) result(is_worth)
      class(ode_system_t), intent(in) :: system     !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, after a step

      is_worth = is_long(system, method)
      if (.not. is_worth) is_worth = may_any_happen(system, method)
   end function is_worth_a_search

   !> Whether the last step is longer than events may stay unseen.
   pure logical function is_long(system, method)
      class(ode_system_t), intent(in) :: system     !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, after a step

      is_long = system%n_event > 0 .and. method%step%h > method%events%look
   end function is_long

   !> Whether the ends of the last step leave storage for a function to become positive.
   pure logical function may_any_happen(system, method) result(may)
      class(ode_system_t), intent(in) :: system     !! the system
      class(integrator_t), intent(in) :: method     !! the integrator, after a step

      integer :: k

      may = .false.
      do k = 1, system%n_event
         may = may_happen(method%events%g0(k) - method%events%threshold(k), method%step%h*method%events%rate0(k), &
                          method%events%g1(k) - method%events%threshold(k), method%step%h*method%events%rate1(k))
         if (may) return
      end do
   end function may_any_happen

   !> Whether a function with these end values and rates (times the step) may become positive within.
   pure logical function may_happen(g0, r0, g1, r1)
      real(wp), intent(in) :: g0  !! value at the start [any]
      real(wp), intent(in) :: r0  !! rate at the start times the step [any]
      real(wp), intent(in) :: g1  !! value at the end [any]
      real(wp), intent(in) :: r1  !! rate at the end times the step [any]

      real(wp) :: curvature

      may_happen = g1 > 0.0_wp
      if (may_happen) return
      curvature = curvature_of(g0, r0, g1, r1)
      if (r0 < 0.0_wp .and. r1 < 0.0_wp .and. curvature < min(-r0, -r1)) return
      may_happen = max(g0, g1) + 0.125_wp*curvature > 0.0_wp
   end function may_happen

   !> The same of a part of a step that is searched, where it is reported apart how far each end keeps the function below zero: with
   !> a curvature up to c, g0 + r0 s + c s^2/2 < 0 from the left end on and g1 - r1 s + c s^2/2 < 0 from the right end back.
   pure logical function leaves_room(g0, r0, g1, r1)
      real(wp), intent(in) :: g0  !! value at the start [any]
      real(wp), intent(in) :: r0  !! rate at the start times the part [any]
      real(wp), intent(in) :: g1  !! value at the end [any]
      real(wp), intent(in) :: r1  !! rate at the end times the part [any]

      real(wp) :: curvature

      leaves_room = may_happen(g0, r0, g1, r1)
      if (.not. leaves_room .or. g0 > 0.0_wp .or. g1 > 0.0_wp) return
      curvature = curvature_of(g0, r0, g1, r1)
      leaves_room = sqrt(r0*r0 - 2.0_wp*curvature*g0) - r0 + sqrt(r1*r1 - 2.0_wp*curvature*g1) + r1 <= curvature
   end function leaves_room

   !> Whether a function with these end values and rates (times the part) rises all the way.
   pure logical function only_rises(g0, r0, g1, r1)
      real(wp), intent(in) :: g0  !! value at the start [any]
      real(wp), intent(in) :: r0  !! rate at the start times the part [any]
      real(wp), intent(in) :: g1  !! value at the end [any]
      real(wp), intent(in) :: r1  !! rate at the end times the part [any]

      only_rises = r0 > 0.0_wp .and. r1 > 0.0_wp .and. curvature_of(g0, r0, g1, r1) < min(r0, r1)
   end function only_rises

   !> Bound of the second derivative of a function, times the square of the part: twice that of the cubic of Hermite.
   pure real(wp) function curvature_of(g0, r0, g1, r1) result(curvature)
      real(wp), intent(in) :: g0  !! value at the start [any]
      real(wp), intent(in) :: r0  !! rate at the start times the part [any]
      real(wp), intent(in) :: g1  !! value at the end [any]
      real(wp), intent(in) :: r1  !! rate at the end times the part [any]

      curvature = 2.0_wp*max(abs(6.0_wp*(g1 - g0) - 4.0_wp*r0 - 2.0_wp*r1), abs(6.0_wp*(g0 - g1) + 2.0_wp*r0 + 4.0_wp*r1))
   end function curvature_of

end module event_chance
