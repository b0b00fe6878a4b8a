!> Ways of meeting the onset of a contact other than locating it: what programs without event location do.
!>
!> A contact is found at the end of the first step at which its penetration delta is positive. Then
!>
!> interpolate   t_c = t_- - delta_- / (delta_+ - delta_-) h and the state linearly between the ends of the step,
!>               q_c = q_- + (q_+ - q_-) (t_c - t_-)/h, velocities and quadratures alike, brought back onto the constraints;
!>               the contact starts there
!> reject        the step is halved and made again until delta_+ <= limit; the contact starts at its end
!> uncontrolled  the contact starts at the end of the step, however deep that is
!>
!> and the impact speed is the rate of penetration where the contact starts. A contact that starts at a penetration
!> gets the energy of its spring for nothing. The residual of the energy ledger shows it, except for sets with `energy_jumps`: there
!> the ledger has a negative loss. Separations and all other events are located in each of these. A contact that starts and ends
!> within a step is left out and counted (`passed_onsets`).
!>
!> Signs: event functions of onsets are penetrations. Source: Flores et al. (2008), section 3.5, procedures 1 and 2, eqs.
!> (3.18)-(3.24), corrected: the printed (3.20) has the wrong sign before the fraction, (3.22) and (3.23) the wrong one in the
!> numerators. Limits: one-step methods; with `interpolate` the time of the onset is of second order in the step.
module onset_control
   use integrator, only: advance_event, advance_failed_evaluation, advance_step, integrator_t
   use integrator_controls, only: onset_interpolate
   use kinds, only: wp
   use ode_system, only: contact_onset, ode_system_t
   use passed_onsets, only: note_passed
   implicit none (type, external)
   private
   public :: begin_control, end_controlled_step, is_too_deep, meet_onsets

   real(wp), parameter :: near = 1.0e-9_wp   !! of a step: onsets closer than this are one [1]

contains

   !> The integration starts, or starts anew: the event functions there are in g1 and rate1 of the integrator.
   subroutine begin_control(system, method)
      class(ode_system_t), intent(in) :: system      !! the system
      class(integrator_t), intent(inout) :: method   !! the integrator

      method%onset%gap = method%events%g1
      method%onset%rate = method%events%rate1
      method%onset%is_waiting = method%events%g1 > 0.0_wp .and. method%events%rate1 < 0.0_wp
      call hide(system, method)
   end subroutine begin_control

   !> Which event functions are not searched for, and what they look like then.
   subroutine hide(system, method)
      class(ode_system_t), intent(in) :: system      !! the system
      class(integrator_t), intent(inout) :: method   !! the integrator, g1 and rate1 as the system has them

      integer :: k

      do k = 1, system%n_event
         method%events%is_hidden(k) = system%contact_change(k) == contact_onset .or. method%onset%is_waiting(k)
      end do
      call method%hide_events(method%events%g1, method%events%rate1)
   end subroutine hide

   !> Whether a trial step ends with a contact that has just started deeper than the limit.
   logical function is_too_deep(system, method, t, y)
      class(ode_system_t), intent(inout) :: system   !! the system, last evaluated at the end of the step
      class(integrator_t), intent(inout) :: method   !! the integrator
      real(wp), intent(in) :: t                      !! time there [s]
      real(wp), intent(in) :: y(:)                   !! (n) state there [any]

      integer :: k

      call system%last_events(t, y, method%onset%end_gap, method%onset%end_rate)
      is_too_deep = .false.
      do k = 1, system%n_event
         if (system%contact_change(k) /= contact_onset .or. method%onset%gap(k) > method%controls%onset_limit) cycle
         is_too_deep = is_too_deep .or. method%onset%end_gap(k) > method%controls%onset_limit
      end do
   end function is_too_deep

   !> A step was made: keep the event functions at its end, and hide those that are not searched for.
   subroutine end_controlled_step(method)
      class(integrator_t), intent(inout) :: method   !! the integrator, g1 and rate1 as the system has them

      method%onset%end_gap = method%events%g1
      method%onset%end_rate = method%events%rate1
      call method%hide_events(method%events%g1, method%events%rate1)
   end subroutine end_controlled_step

   !> After the search for located events: onsets at the end of the step, which a located event may have made shorter.
   subroutine meet_onsets(system, method, status)
      class(ode_system_t), intent(inout) :: system   !! the system, last evaluated at the end of the step
      class(integrator_t), intent(inout) :: method   !! the integrator, after the step
      integer, intent(inout) :: status               !! advance_step or advance_event, then what it is now

      integer :: k
      logical :: has_begun(system%n_event)

      if (status == advance_event) call system%last_events(method%t, method%step%y1, method%onset%end_gap, method%onset%end_rate)
      do k = 1, system%n_event
         has_begun(k) = system%contact_change(k) == contact_onset .and. method%onset%end_gap(k) > 0.0_wp &
                        .and. method%onset%end_rate(k) > 0.0_wp &
                        .and. .not. method%onset%is_waiting(k)
      end do
      if (.not. any(has_begun)) then
         call note_passed(system, method, 1.0_wp)
         if (status == advance_event) return  ! the integrator starts anew
         method%onset%gap = method%onset%end_gap
         method%onset%rate = method%onset%end_rate
         method%onset%is_waiting = method%onset%is_waiting .and. method%onset%end_gap > 0.0_wp .and. method%onset%end_rate < 0.0_wp
         method%events%g1 = method%onset%end_gap
         method%events%rate1 = method%onset%end_rate
         call hide(system, method)
         return
      end if
      status = advance_event
      if (method%controls%onset == onset_interpolate) then
         call go_back(system, method, has_begun, status)
      else
         call note_passed(system, method, 1.0_wp)
      end if
      do k = 1, system%n_event
         if (.not. has_begun(k)) cycle
         method%events%n_happened = method%events%n_happened + 1
         method%events%happened(method%events%n_happened) = k
      end do
   end subroutine meet_onsets

   !> Linearly back to the first onset of the step.
   subroutine go_back(system, method, has_begun, status)
      class(ode_system_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator; the step ends at the onset
      logical, intent(inout) :: has_begun(:)            !! (n_event) onsets of the step, then the first of them only
      integer, intent(inout) :: status                  !! advance_event, or a failure

      real(wp) :: first, place(size(has_begun))

      place = 2.0_wp
      where (has_begun) place = max(-method%onset%gap, 0.0_wp)/(method%onset%end_gap - min(method%onset%gap, 0.0_wp))
      first = minval(place)
      has_begun = place <= first + near
      call note_passed(system, method, first)
      method%events%n_happened = 0  ! a located event at the end of the step comes again, after the onset
      associate (step => method%step)
         step%h = first*step%h
         step%y1 = step%y0 + first*(step%y1 - step%y0)
         method%t = step%t0 + step%h
         call system%project_state(method%t, step%y1, status)
         if (status == 0) call system%evaluate(method%t, step%y1, step%f1, status)
      end associate
      method%count%n_evaluations = method%count%n_evaluations + 1
      status = merge(advance_event, advance_failed_evaluation, status == 0)
   end subroutine go_back

end module onset_control
