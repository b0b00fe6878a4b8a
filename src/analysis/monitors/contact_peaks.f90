!> Maxima of the penetration and of the normal force of a contact within a step.
!>
!> A maximum lies where the rate changes from positive to negative. The place is sought as the maximum of the cubic of Hermite
!> through the ends of a bracket, which narrows around it; from the sixth on every third place is the middle, for forces that are
!> not smooth.
module contact_peaks
   use integrator, only: integrator_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: add_peak, drop_peaks, find_force_peak, find_penetration_peak, has_peak_above, look, may_exceed, peak_t, trend_t

   real(wp), parameter :: near_depth = 1.0e-8_wp  !! what may be missing to a maximum of the penetration, of it [1]
   real(wp), parameter :: near_force = 1.0e-8_wp  !! what may be missing to a maximum of the force, of it [1]
   real(wp), parameter :: close_by = 0.25_wp      !! rise above the ends of a step that are near a maximum, of them [1]
   integer, parameter :: n_search = 24            !! places looked at in search of a maximum
   integer, parameter :: n_halving = 3            !! one of so many is the middle
   integer, parameter :: n_smooth = 5             !! places before the first middle

   !> A value and its rate.
   type :: trend_t
      real(wp) :: value = 0.0_wp  !! force or penetration [N or m]
      real(wp) :: rate = 0.0_wp   !! its rate [N/s or m/s]
   end type trend_t

   !> The maximum force found, and the state there.
   type :: peak_t
      real(wp) :: t = 0.0_wp            !! time [s]
      real(wp) :: force = 0.0_wp        !! normal force; negative: none found [N]
      real(wp), allocatable :: y(:)     !! (n) state [any]
   end type peak_t

   !> Part of a step that holds a maximum: the value rises at its left end and falls at its right end.
   type :: bracket_t
      real(wp) :: place_a = 0.0_wp  !! left end, of the step [1]
      real(wp) :: place_b = 1.0_wp  !! right end, of the step [1]
      real(wp) :: h = 0.0_wp        !! length of the step [s]
      type(trend_t) :: a            !! what is at the left end
      type(trend_t) :: b            !! what is at the right end
   end type bracket_t

contains

   !> Force and penetration of a contact at the present motion.
   subroutine look(system, slot, item, force, penetration)
      type(mechanism_t), intent(in) :: system     !! the system, motion and accelerations set
      integer, intent(in) :: slot                     !! set of the contact
      integer, intent(in) :: item                     !! contact of the set
      type(trend_t), intent(out) :: force             !! normal force
      type(trend_t), intent(out) :: penetration       !! penetration

      call system%clearance_joints%sets(slot)%set%monitor(item, system%linkage%motion, penetration%value, penetration%rate, &
                                             force%value, force%rate)
   end subroutine look

   !> Maximum of the penetration within the last step: the place is found on its interpolant, the value is that of a row there.
   !> Where it is far above the ends the step is long for the contact, as steps of stiff methods are at rest, and the interpolant
   !> may be poor: then the value is that of a state that the method itself reaches.
   subroutine find_penetration_peak(system, method, slot, item, left, right, y, maximum, peak)
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step
      integer, intent(in) :: slot                       !! set of the contact
      integer, intent(in) :: item                       !! contact of the set
      type(trend_t), intent(in) :: left                 !! penetration at the start of the step
      type(trend_t), intent(in) :: right                !! penetration at its end
      real(wp), intent(inout), contiguous :: y(:)       !! (n) scratch state [any]
      real(wp), intent(out) :: maximum                 !! the maximum penetration found; 0: none [m]
      type(peak_t), intent(inout) :: peak               !! time and state there, with the force

      type(bracket_t) :: bracket
      type(trend_t) :: force, here
      real(wp) :: place
      integer(i8) :: n_output
      integer :: k, status

      maximum = 0.0_wp
      peak%t = method%step%t0
      bracket = bracket_t(h=method%step%h, a=left, b=right)
      do k = 1, n_search
         place = place_in(bracket, k)
         call method%within(system, place, y)
         call system%linkage%set_motion(method%step%t0 + place*method%step%h, y)
         call look(system, slot, item, force, here)
         if (here%value > maximum) then
            maximum = here%value
            peak%t = method%step%t0 + place*method%step%h
         end if
         if (missing(here, bracket) <= near_depth*abs(here%value)) exit
         call narrow(place, here, bracket)
      end do
      if (maximum <= (1.0_wp + close_by)*max(left%value, right%value)) then
         n_output = method%count%n_output_evaluations  ! these are made whether there is output or not
         call method%reach(system, peak%t, y)
         method%count%n_output_evaluations = n_output
      else
         maximum = 0.0_wp
         call method%refine(system, (peak%t - method%step%t0)/method%step%h, y, status)
         if (status /= 0) return
      end if
      call system%linkage%set_motion(peak%t, y)
      call look(system, slot, item, force, here)
      maximum = here%value
      peak%force = force%value
      peak%y = y
   end subroutine find_penetration_peak

   !> Whether a force has a maximum within a step that may be greater than a value. Where a contact ends its force may have no rate.
   pure logical function has_peak_above(left, right, end_penetration, h, value) result(has_peak)
      type(trend_t), intent(in) :: left              !! the force at the start of the step
      type(trend_t), intent(in) :: right             !! the force at its end
      type(trend_t), intent(in) :: end_penetration   !! penetration at its end
      real(wp), intent(in) :: h                      !! length of the step [s]
      real(wp), intent(in) :: value                  !! the value [N]

      has_peak = left%rate >= 0.0_wp .and. (right%rate < 0.0_wp .or. (right%rate <= 0.0_wp .and. end_penetration%rate < 0.0_wp))
      if (has_peak) has_peak = may_exceed(left, right, h, value)
   end function has_peak_above

   !> Whether a maximum within a step may be greater than a value. It is not if the ends are near it and the cubic of Hermite
   !> through them would have to rise above them more than twice as high as it does.
   pure logical function may_exceed(left, right, h, value)
      type(trend_t), intent(in) :: left    !! what is at the start of the step
      type(trend_t), intent(in) :: right   !! what is at its end
      real(wp), intent(in) :: h            !! length of the step [s]
      real(wp), intent(in) :: value        !! the value [N or m]

      real(wp) :: greater, rise, s
      type(bracket_t) :: bracket

      bracket = bracket_t(h=h, a=left, b=right)
      s = maximum_in(bracket)
      greater = max(left%value, right%value)
      rise = left%value*(1.0_wp + 2.0_wp*s)*(1.0_wp - s)**2 + right%value*s*s*(3.0_wp - 2.0_wp*s) &
             + h*s*(1.0_wp - s)*(left%rate*(1.0_wp - s) - right%rate*s) - greater
      may_exceed = .not. (rise <= close_by*greater .and. min(left%value, right%value) > 0.5_wp*greater &
                          .and. greater + 2.0_wp*rise < value)
   end function may_exceed

   !> Maximum of the normal force within the last step, on its interpolant. That of an explicit method is as good as its steps but
   !> where the maximum is far above their ends, see `find_penetration_peak`. Else the place that was found, and others if it is not
   !> the one, are reached by the method itself.
   subroutine find_force_peak(system, method, slot, item, left, right, y, ydot, peak)
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step
      integer, intent(in) :: slot                       !! set of the contact
      integer, intent(in) :: item                       !! contact of the set
      type(trend_t), intent(in) :: left                 !! force at the start of the step
      type(trend_t), intent(in) :: right                !! force at its end
      real(wp), intent(inout), contiguous :: y(:)       !! (n) scratch state [any]
      real(wp), intent(inout), contiguous :: ydot(:)    !! (n) scratch derivative [any]
      type(peak_t), intent(inout) :: peak               !! the maximum force that was found

      type(bracket_t) :: bracket
      type(trend_t) :: here
      real(wp) :: bend, place
      integer(i8) :: n_output
      integer :: k, status

      peak%force = -1.0_wp
      status = 0
      if (method%is_explicit()) then
         n_output = method%count%n_output_evaluations  ! these are made whether there is output or not
         call method%prepare_output(system, status)
         method%count%n_output_evaluations = n_output
      end if
      if (status /= 0) return
      bracket = bracket_t(h=method%step%h, a=left, b=right)
      do k = 1, n_search
         place = place_in(bracket, k)
         call method%within(system, place, y)
         call look_from(y, status)
         if (status /= 0) return
         call keep_greater()
         if (missing(here, bracket) <= near_force*abs(here%value)) exit
         call narrow(place, here, bracket)
      end do
      if (method%is_explicit() .and. peak%force <= (1.0_wp + close_by)*max(left%value, right%value)) return
      peak%force = -1.0_wp
      bend = bend_of(bracket)
      bracket = bracket_t(h=method%step%h, a=left, b=right)
      do k = 1, n_search
         call method%refine(system, place, y, status)
         if (status == 0) call look_from(y, status)
         if (status /= 0) return
         call keep_greater()
         if (missing(here, bracket) <= near_force*abs(here%value)) exit
         if (0.5_wp*here%rate**2 <= near_force*abs(here%value)*bend) exit
         call narrow(place, here, bracket)
         if (abs(here%rate) < bend*method%step%h) place = place + here%rate/(bend*method%step%h)
         if (place <= bracket%place_a .or. place >= bracket%place_b) place = place_in(bracket, k)
      end do

   contains

      !> The force at a place, with the accelerations there.
      subroutine look_from(state, status)
         real(wp), intent(in), contiguous :: state(:)  !! (n) state at the place [any]
         integer, intent(out) :: status    !! of the evaluation

         type(trend_t) :: penetration
         real(wp) :: t

         t = method%step%t0 + place*method%step%h
         call system%evaluate(t, state, ydot, status)
         method%count%n_evaluations = method%count%n_evaluations + 1
         if (status /= 0) return
         call system%linkage%set_state(t, state, ydot)
         call look(system, slot, item, here, penetration)
      end subroutine look_from

      !> Keep the force at the place if it is the maximum so far.
      subroutine keep_greater()
         if (.not. here%value > peak%force) return
         peak%t = method%step%t0 + place*method%step%h
         peak%force = here%value
         peak%y = y
      end subroutine keep_greater

   end subroutine find_force_peak

   !> Put a peak in its place in a list, by time; one at a time that is there already is reported with it.
   subroutine add_peak(peak, list, n)
      type(peak_t), intent(in) :: peak                       !! the peak
      type(peak_t), allocatable, intent(inout) :: list(:)    !! (n or more) peaks by time
      integer, intent(inout) :: n                            !! how many

      integer :: k, place

      place = 1
      do k = 1, n
         if (list(k)%t >= peak%t) exit
         place = k + 1
      end do
      if (place <= n) then
         if (list(place)%t <= peak%t) return
      end if
      if (n == size(list)) list = [list, list]
      do k = n, place, -1
         list(k + 1) = list(k)
      end do
      list(place) = peak
      n = n + 1
   end subroutine add_peak

   !> Take peaks up to a time off a list.
   subroutine drop_peaks(t, list, n)
      real(wp), intent(in) :: t                  !! the time [s]
      type(peak_t), intent(inout) :: list(:)     !! (n or more) peaks by time
      integer, intent(inout) :: n                !! how many

      integer :: k, n_reported

      n_reported = count(list(:n)%t <= t)
      n = n - n_reported
      do k = 1, n
         list(k) = list(k + n_reported)
      end do
   end subroutine drop_peaks

   !> Put a place in for that end of the bracket that is on its side of the maximum.
   pure subroutine narrow(place, here, bracket)
      real(wp), intent(in) :: place               !! a place between [1]
      type(trend_t), intent(in) :: here           !! what is there
      type(bracket_t), intent(inout) :: bracket   !! the bracket

      if (here%rate >= 0.0_wp) then
         bracket%place_a = place
         bracket%a = here
      else
         bracket%place_b = place
         bracket%b = here
      end if
   end subroutine narrow

   !> How fast the rate falls on average within a bracket; it rises at one end and falls at the other.
   pure real(wp) function bend_of(bracket) result(bend)
      type(bracket_t), intent(in) :: bracket   !! the bracket

      real(wp) :: time  ! length of the bracket [s]

      time = (bracket%place_b - bracket%place_a)*bracket%h
      bend = max(bracket%a%rate - bracket%b%rate, tiny(1.0_wp))/time
   end function bend_of

   !> What is missing to the maximum of a parabola with the curvature of the bracket.
   pure real(wp) function missing(here, bracket) result(rest)
      type(trend_t), intent(in) :: here        !! a place between
      type(bracket_t), intent(in) :: bracket   !! the bracket

      rest = 0.5_wp*here%rate**2/bend_of(bracket)
   end function missing

   !> Place to look at: the maximum of the cubic, or now and then the middle.
   pure real(wp) function place_in(bracket, k) result(place)
      type(bracket_t), intent(in) :: bracket   !! the bracket
      integer, intent(in) :: k                 !! number of the place, from 1

      if (k > n_smooth .and. modulo(k, n_halving) == 0) then
         place = 0.5_wp*(bracket%place_a + bracket%place_b)
      else
         place = maximum_in(bracket)
      end if
   end function place_in

   !> Place of the maximum of the cubic of Hermite through the ends of a bracket, kept off the ends.
   pure real(wp) function maximum_in(bracket) result(place)
      type(bracket_t), intent(in) :: bracket   !! the bracket

      real(wp), parameter :: margin = 1.0e-3_wp  ! of the bracket [1]
      real(wp) :: c2, c3, rate_a, rate_b, rise, root, s

      rate_a = bracket%a%rate*bracket%h*(bracket%place_b - bracket%place_a)
      rate_b = bracket%b%rate*bracket%h*(bracket%place_b - bracket%place_a)
      rise = bracket%b%value - bracket%a%value
      c2 = 3.0_wp*rise - 2.0_wp*rate_a - rate_b
      c3 = rate_a + rate_b - 2.0_wp*rise
      root = sqrt(max(c2*c2 - 3.0_wp*c3*rate_a, 0.0_wp))
      s = 0.5_wp
      if (c2 > 0.0_wp .and. c3 < 0.0_wp) then
         s = -(c2 + root)/(3.0_wp*c3)
      else if (root - c2 > 0.0_wp) then
         s = rate_a/(root - c2)
      end if
      s = min(max(s, margin), 1.0_wp - margin)
      place = bracket%place_a + s*(bracket%place_b - bracket%place_a)
   end function maximum_in

end module contact_peaks
