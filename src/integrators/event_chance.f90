!> Whether a step leaves room for an event, from the event functions at its ends.
module event_chance
   use integrator, only: integrator_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: is_long, is_worth_a_search, may_any_happen, may_happen

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

   !> Whether the ends of the last step leave room for a function to become positive.
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
   !> The curvature is taken from the cubic of Hermite, twice over.
   pure logical function may_happen(g0, r0, g1, r1)
      real(wp), intent(in) :: g0  !! value at the start [any]
      real(wp), intent(in) :: r0  !! rate at the start times the step [any]
      real(wp), intent(in) :: g1  !! value at the end [any]
      real(wp), intent(in) :: r1  !! rate at the end times the step [any]

      real(wp) :: curvature

      may_happen = g1 > 0.0_wp
      if (may_happen) return
      curvature = 2.0_wp*max(abs(6.0_wp*(g1 - g0) - 4.0_wp*r0 - 2.0_wp*r1), abs(6.0_wp*(g0 - g1) + 2.0_wp*r0 + 4.0_wp*r1))
      if (r0 < 0.0_wp .and. r1 < 0.0_wp .and. curvature < min(-r0, -r1)) return
      may_happen = max(g0, g1) + 0.125_wp*curvature > 0.0_wp
   end function may_happen

end module event_chance
