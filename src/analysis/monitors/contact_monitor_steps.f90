!> What the monitor over contacts sees at the end of a step.
submodule(contact_monitor) contact_monitor_steps
   use contact_peaks, only: add_peak, find_force_peak, find_penetration_peak, has_peak_above
   use cut_off, only: follow_cut_off
   implicit none (type, external)

   !> What a contact had at most in a step.
   type :: max_t
      real(wp) :: depth       !! penetration [m]
      real(wp) :: depth_at    !! when [s]
      real(wp) :: force       !! maximum of the force within the step; negative: none was found [N]
      real(wp) :: force_at    !! when [s]
   end type max_t

contains

   !> Look for maxima of force and penetration within the last step, whether a force is cut off, and what surfaces lose.
   module procedure after_step
      integer :: i, k

      self%n_peak = 0
      do k = 1, system%clearance_joints%n_set
         associate (set => system%clearance_joints%sets(k)%set)
            if (set%n_touching == 0) cycle
            call system%linkage%set_acceleration(method%step%f1)
            do i = 1, set%n_contact
               if (set%contact(i)%is_touching) call see_contact(k, i)
            end do
         end associate
      end do
      if (system%n_wear > 0) call self%wear%after_step(system, method)

   contains

      !> Look at a contact that touches. Where its maximum force stood at the start of the step and the step does not go beyond it,
      !> the row that is owed is reported now.
      subroutine see_contact(slot, item)
         integer, intent(in) :: slot                     !! set of the contact
         integer, intent(in) :: item                     !! contact of the set

         type(trend_t) :: force, penetration
         type(max_t) :: most
         real(wp) :: maximum   ! force before the step [N]
         real(wp) :: minimum      ! force that a maximum worth telling has at least [N]
         integer :: number, place
         logical :: has_force_peak, has_peak, is_max

         associate (set => system%clearance_joints%sets(slot)%set)
            call set%monitor(item, system%linkage%motion, penetration%value, penetration%rate, force%value, force%rate)
            maximum = set%contact(item)%peak_force
            number = set%before%contacts + item
            place = system%place_of_impulse(number)
            has_peak = self%penetration(number)%rate >= 0.0_wp .and. penetration%rate < 0.0_wp
            has_force_peak = self%force(number)%rate >= 0.0_wp .and. force%rate <= 0.0_wp
            minimum = maximum
            if (self%tells_all) minimum = min(maximum, self%low(1, number) + ripple*maximum)
            if (has_force_peak) has_force_peak = has_peak_above(self%force(number), force, penetration, method%step%h, minimum)
            most = max_t(penetration%value, method%t, -1.0_wp, method%t)
            if (has_peak .or. has_force_peak) then
               call find_peaks(self, system, method, slot, item, has_peak, has_force_peak, force, penetration, most)
            end if
            is_max = force%value >= max(maximum, most%force)
            if (self%owes_row(number) .and. max(force%value, most%force) <= maximum) then
               call tell(self, number, peak_t(method%step%t0, maximum, method%step%y0))
            end if
            if (most%force <= force%value) then
               most%force = force%value
               most%force_at = method%t
            end if
            call set%note_step(item, most%depth, most%depth_at, most%force, most%force_at, &
                               method%step%y1(place) - method%step%y0(place))
            self%owes_row(number) = is_max
            if (is_max) self%owes_row(number) = force%value > (1.0_wp + noise)*self%told(number)
            if (system%ledger%is_kept) then
               call follow_cut_off(set, item, penetration%value, force%value, &
                                   method%step%y1(system%in_state(place_of_loss(number, loss_contact))))
            end if
         end associate
         self%force(number) = force
         self%penetration(number) = penetration
         self%low(:, number) = min(self%low(:, number), [force%value, penetration%value])
      end subroutine see_contact

   end procedure after_step

   !> Find maxima within the step; a force that is the maximum so far is reported. The system comes back to the end of the step.
   subroutine find_peaks(self, system, method, slot, item, has_peak, has_force_peak, force, penetration, most)
      class(contact_monitor_t), intent(inout) :: self   !! the monitor
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method    !! the integrator, after a step
      integer, intent(in) :: slot                     !! set of the contact
      integer, intent(in) :: item                     !! contact of the set
      logical, intent(in) :: has_peak                 !! the penetration has a maximum there
      logical, intent(in) :: has_force_peak           !! the force has one
      type(trend_t), intent(in) :: force              !! the force at the end of the step
      type(trend_t), intent(in) :: penetration        !! the penetration there
      type(max_t), intent(inout) :: most         !! what was at most, so far the end of the step

      type(peak_t) :: peak
      real(wp) :: deepest
      integer :: number
      logical :: is_reported

      associate (set => system%clearance_joints%sets(slot)%set)
         number = set%before%contacts + item
         if (has_peak) then
            call find_penetration_peak(system, method, slot, item, self%penetration(number), penetration, self%y, deepest, peak)
            if (penetration%value <= deepest) then
               most%depth = deepest
               most%depth_at = peak%t
               is_reported = deepest > self%low(2, number) + ripple*max(deepest, set%contact(item)%peak_penetration)
               if (self%tells_all .and. is_reported) then
                  call add_peak(peak, self%peaks, self%n_peak)
                  self%low(2, number) = deepest
               end if
            end if
         end if
         if (has_force_peak) then
            call find_force_peak(system, method, slot, item, self%force(number), force, self%y, self%ydot, peak)
            most%force = peak%force
            most%force_at = peak%t
            is_reported = peak%force > max(set%contact(item)%peak_force, force%value) &
                      .and. peak%force > (1.0_wp + noise)*self%told(number)
            if (self%tells_all) is_reported = is_reported .or. (peak%force > force%value .and. &
                                          peak%force > self%low(1, number) + ripple*max(peak%force, set%contact(item)%peak_force))
            if (is_reported) call tell(self, number, peak)
         end if
      end associate
      call system%linkage%set_state(method%t, method%step%y1, method%step%f1)
   end subroutine find_peaks

   !> Report of a force.
   subroutine tell(self, number, peak)
      class(contact_monitor_t), intent(inout) :: self   !! the monitor
      integer, intent(in) :: number                   !! number of the contact
      type(peak_t), intent(in) :: peak                !! the force and where it is

      call add_peak(peak, self%peaks, self%n_peak)
      self%told(number) = max(self%told(number), peak%force)
      self%low(1, number) = peak%force
   end subroutine tell

end submodule contact_monitor_steps
