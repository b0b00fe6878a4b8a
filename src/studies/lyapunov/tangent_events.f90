!> What events and instants do to a small change of a motion: saltation.
!>
!> A neighbouring motion meets an event function g at another time, by
!> $$ \delta t = -\frac{\partial_y g \cdot w}{\dot g^-}, \quad w^+ = w^- + (f^- - f^+) \, \delta t, $$
!> f- and f+ the right-hand sides before and behind it: the saltation matrix S = I + (f+ - f-) n^T/(n^T f- + g_t), n = d_y g.
!> Where forces start smoothly f+ = f- and S = I; they jump with dashpots, with sticking and with slip. What is set at the event
!> jumps too: the impact speed u = d' of a contact that starts, and the deflection of bristles, which starts anew,
!> $$ w_u^+ = \partial_y \dot d \cdot w^- + \ddot d^- \, \delta t, \quad w_z^+ = -f_z^+ \, \delta t . $$
!> Instants at which functions of time are not smooth are the same for all motions: there w continues, but where velocities of
!> drivers jump, it is carried by that jump.
!>
!> Source: R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems (2004), chapter 7 (saltation
!> matrix); P. C. Mueller, Chaos, Solitons & Fractals 5 (1995) 1671-1681.
!> Limits: of events at one instant the first alone moves in time; the speed at which a contact rests (`turn_monitor`) is held.
module tangent_events
   use contact_peaks, only: look, trend_t
   use contact_places, only: touch_function
   use errors, only: error_t
   use friction_law, only: memory_bristle
   use kinds, only: eps, wp
   use moving_part, only: handle_part_events, moving_part_t, pass_part_instant
   use recorder, only: recorder_t
   use run_tally, only: run_tally_t
   use tangent, only: tangent_t
   use velocity_jumps, only: velocity_jumps_t
   implicit none (type, external)
   private
   public :: cross_events, cross_instant

   real(wp), parameter :: nearness = 1.0e-9_wp   !! of the states beside the motion, of the scales [1]
   real(wp), parameter :: spacings = 16.0_wp     !! of coordinates, within which forces of contacts are not looked at [1]
   real(wp), parameter :: latest = 1.0e3_wp  !! time that an event may shift by a change of one scale, over 1/characteristic rate
                                             !! [1]

contains

   !> Handle the events at the end of the last step; the change goes across.
   subroutine cross_events(tangent, part, tally, recorder, error)
      type(tangent_t), intent(inout) :: tangent          !! the change, as it comes to the events
      type(moving_part_t), intent(inout) :: part         !! the mechanism, at events that are not handled yet
      type(run_tally_t), intent(inout) :: tally          !! of the run
      class(recorder_t), intent(inout) :: recorder       !! keeps the results
      type(error_t), allocatable, intent(out) :: error   !! no way to continue

      real(wp), allocatable :: after(:), before(:), impact(:)
      real(wp) :: aside, shift
      integer :: status

      allocate (after(part%system%n), before(part%system%n), source=0.0_wp)
      associate (system => part%system, method => part%method, m => part%system%n - part%system%n_quadrature)
         call time_shift(tangent, part, aside, shift)
         tangent%t_event = method%t
         call system%evaluate(method%t - aside, method%step%y1 - aside*method%step%f1, before, status)
         if (status /= 0) before = method%step%f1
         impact = changed_speeds(tangent, part, shift)
         call system%evaluate(method%t, method%step%y1, after, status)  ! the system is at the events again
         call handle_part_events(part, tally, recorder, error)
         if (allocated(error)) return
         call system%evaluate(method%t + aside, method%step%y1 + aside*method%step%f1, after, status)
         if (status /= 0) after = method%step%f1
         call drop_deflections(tangent, part, before)
         tangent%w(:m) = tangent%w(:m) + (before(:m) - after(:m))*shift
         tangent%impact = impact
         call tangent%renew(system)
         call system%evaluate(method%t, method%step%y1, after, status)
      end associate
   end subroutine cross_events

   !> When the neighbouring motion meets the event, against this one.
   subroutine time_shift(tangent, part, aside, shift)
      type(tangent_t), intent(inout) :: tangent          !! the change
      type(moving_part_t), intent(inout) :: part         !! the mechanism, at the events
      real(wp), intent(out) :: aside                     !! time in which a contact comes out of round-off [s]
      real(wp), intent(out) :: shift                     !! how much later it does; of a change of length one [s]

      real(wp), parameter :: most_aside = 1.0e-7_wp   ! change of rates at which event functions are looked at [1]
      real(wp), dimension(part%system%n_event) :: g, minus, plus, rate, unused
      real(wp) :: near

      aside = 0.0_wp
      shift = 0.0_wp
      associate (system => part%system, method => part%method, event => part%method%events%happened(1))
         if (method%events%n_happened > 1) tangent%n_together = tangent%n_together + 1
         near = tangent%part_of(system, tangent%w, most_aside)
         call tangent%take_speeds(system)
         call tangent%give_speeds(system, near)
         call system%events(method%t, method%step%y1 + near*tangent%w, plus, unused)
         call tangent%give_speeds(system, -near)
         call system%events(method%t, method%step%y1 - near*tangent%w, minus, unused)
         call tangent%give_speeds(system, 0.0_wp)
         call system%events(method%t, method%step%y1, g, rate)
         if (rate(event) > 0.0_wp) shift = -(plus(event) - minus(event))/(2.0_wp*near*rate(event))
         if (.not. rate(event) > 0.0_wp .or. abs(shift)*tangent%pace(system) > latest) then
            tangent%n_grazed = tangent%n_grazed + 1
            shift = 0.0_wp
            return
         end if
         tangent%n_crossed = tangent%n_crossed + 1
         if (system%clearance_joints%functions%kind_of(event) /= touch_function) return
         aside = spacings*eps*max(system%linkage%scales%length, maxval(abs(method%step%y1(:system%n_position))))
         aside = (abs(g(event)) + aside)/rate(event) + spacings*eps*method%t
      end associate
   end subroutine time_shift

   !> Changes of impact speeds behind the events: those of contacts that start there, of others that touch as they are, else none.
   function changed_speeds(tangent, part, shift) result(impact)
      type(tangent_t), intent(in) :: tangent             !! the change
      type(moving_part_t), intent(inout) :: part         !! the mechanism, at the events
      real(wp), intent(in) :: shift                      !! when the neighbour meets them [s]
      real(wp) :: impact(part%system%clearance_joints%n_contact)          !! (contacts) changes of the speeds [m/s]

      real(wp) :: along, beside, moment
      integer :: i, k, n

      impact = tangent%impact
      associate (system => part%system, method => part%method)
         moment = system%time_of_difference(method%t)
         do n = 1, method%events%n_happened
            if (system%clearance_joints%functions%kind_of(method%events%happened(n)) /= touch_function) cycle
            call system%find_contact(method%events%happened(n), k, i)
            impact(method%events%happened(n)) = 0.0_wp
            if (system%clearance_joints%sets(k)%set%contact(i)%is_touching) cycle
            beside = (rate_at(0.0_wp, nearness*tangent%w) - rate_at(0.0_wp, -nearness*tangent%w))/(2.0_wp*nearness)
            along = (rate_at(moment, moment*method%step%f1) - rate_at(-moment, -moment*method%step%f1))/(2.0_wp*moment)
            impact(method%events%happened(n)) = beside + along*shift
         end do
      end associate

   contains

      !> Rate of the penetration of contact i of set k beside the present state.
      real(wp) function rate_at(later, change) result(rate)
         real(wp), intent(in) :: later        !! how much later [s]
         real(wp), intent(in) :: change(:)    !! (n) of the state [any]

         type(trend_t) :: force, penetration

         call part%system%linkage%set_motion(part%method%t + later, part%method%step%y1 + change)
         call look(part%system, k, i, force, penetration)
         rate = penetration%rate
      end function rate_at

   end function changed_speeds

   !> Deflections of bristles of contacts that have just started or ended start at nothing, whenever that is.
   subroutine drop_deflections(tangent, part, before)
      type(tangent_t), intent(inout) :: tangent          !! the change
      type(moving_part_t), intent(in) :: part            !! the mechanism, behind the events
      real(wp), intent(inout) :: before(:)               !! (n) derivative before them; none of such deflections [any]

      integer :: i, k, n

      do n = 1, part%method%events%n_happened
         if (part%system%clearance_joints%functions%kind_of(part%method%events%happened(n)) /= touch_function) cycle
         call part%system%find_contact(part%method%events%happened(n), k, i)
         associate (stick_slip => part%system%clearance_joints%sets(k)%set%stick_slip, place => part%system%bristle_place(k, i))
            if (stick_slip%memory /= memory_bristle) cycle
            tangent%w(place + 1:place + stick_slip%n_component) = 0.0_wp
            before(place + 1:place + stick_slip%n_component) = 0.0_wp
         end associate
      end do
   end subroutine drop_deflections

   !> Pass an instant at which functions of time are not smooth; where velocities jump the change goes with them.
   subroutine cross_instant(tangent, part, tally, recorder, error)
      type(tangent_t), intent(inout) :: tangent          !! the change, as it comes to the instant
      type(moving_part_t), intent(inout) :: part         !! the mechanism, at the instant
      type(run_tally_t), intent(inout) :: tally          !! of the run
      class(recorder_t), intent(inout) :: recorder       !! keeps the results
      type(error_t), allocatable, intent(out) :: error   !! no way to continue

      real(wp), allocatable :: before(:), behind(:), minus(:), plus(:), ydot(:)
      integer :: status

      before = part%method%step%y1
      tangent%t_event = part%method%t
      call pass_part_instant(part, tally, recorder, error)
      if (.not. allocated(error) .and. part%method%events%n_happened > 0) call handle_part_events(part, tally, recorder, error)
      if (allocated(error)) return
      behind = part%method%step%y1
      associate (m => part%system%n - part%system%n_quadrature)
         if (all(abs(behind(:m) - before(:m)) <= 0.0_wp)) return
         plus = carried(nearness)
         minus = carried(-nearness)
         part%method%step%y1 = behind
         tangent%w(:m) = (plus(:m) - minus(:m))/(2.0_wp*nearness)
      end associate
      call tangent%renew(part%system)
      allocate (ydot(part%system%n))
      call part%system%evaluate(part%method%t, behind, ydot, status)

   contains

      !> A state beside the motion behind the jump.
      function carried(distance) result(y)
         real(wp), intent(in) :: distance       !! how far beside [1]
         real(wp) :: y(size(before))            !! (n) the state [any]

         type(velocity_jumps_t) :: jumps

         jumps = part%jumps
         part%method%step%y1 = before + distance*tangent%w
         call jumps%after_instant(part%system, part%method, status)
         y = part%method%step%y1
      end function carried

   end subroutine cross_instant

end module tangent_events
