!> Events of multistep methods: a step is shortened on its own polynomial until it ends at its first event.
submodule(multistep) multistep_events
   use event_location, only: dismiss_event, note_events
   implicit none (type, external)

   integer, parameter :: n_halving = 60   !! halvings of the bracket of an event

contains

   !> Shorten the step so that it ends at an event: halve between "none positive" and "one positive". A function that falls
   !> there is at no event: the error of the step is more than the way that the function has gone. Such a step is doubtful; one that
   !> is too short to be repeated stands, and the function is dismissed for the first of the others.
   module procedure go_to_event
      logical :: is_found
      real(wp) :: place

      do while (event > 0)
         call halve(self, system, low, high, event, is_found, status)
         if (status /= 0 .or. is_found) exit
         self%last%is_doubtful = self%events%g(event) > 0.0_wp .and. can_be_repeated(self, event)
         if (self%last%is_doubtful) exit
         call dismiss_event(system, self, 0.0_wp, event, low, high, place)
      end do
      if (status == 0 .and. is_found) then
         self%step%h = high*self%last%h_whole
         self%t = self%step%t0 + self%step%h
         self%step%y1 = self%trial
         call note_events(self, event, self%last%h_whole)
      end if
      if (status == 0 .and. .not. self%last%is_doubtful) call self%evaluate_end(system, status)  ! the whole step stands
      status = merge(merge(advance_event, advance_step, is_found), advance_failed_evaluation, status == 0)
   end procedure go_to_event

   !> Whether a shorter step may report more of an event function: its rate is known as well as its value, and there is time to
   !> divide.
   pure logical function can_be_repeated(self, event)
      class(multistep_t), intent(in) :: self   !! the integrator
      integer, intent(in) :: event             !! the event function

      can_be_repeated = self%events%noise(event) > 0.0_wp .and. &
                        shorter*self%last%h_whole > max(tiny_step*eps*abs(self%t), self%controls%minimum_step)
   end function can_be_repeated

   !> Halve the bracket of an event down to the spacing of time.
   subroutine halve(self, system, low, high, event, is_found, status)
      class(multistep_t), intent(inout) :: self     !! the integrator; `trial`, `g` and `rate` are those at the upper end
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(inout) :: low                !! place before the event [1]
      real(wp), intent(inout) :: high               !! place after it [1]
      integer, intent(inout) :: event               !! by the search; then the first event function, or one that is at none
      logical, intent(out) :: is_found              !! whether it rises there
      integer, intent(out) :: status                !! of holding the states

      real(wp) :: middle
      integer :: i

      is_found = .false.
      call look(high)
      if (status == 0 .and. all(self%events%g <= 0.0_wp)) then
         ! on held states it is not there, or later
         low = high
         high = 1.0_wp
         if (all(self%events%g1 <= self%events%threshold)) return
      else if (status == 0 .and. system%holds) then
         ! nor earlier
         call look(low)
         if (any(self%events%g > 0.0_wp)) then
            high = low
            low = 0.0_wp
         end if
      end if
      do i = 1, n_halving
         if (status /= 0 .or. (high - low)*self%last%h_whole <= eps*abs(self%step%t0 + high*self%last%h_whole)) exit
         middle = 0.5_wp*(low + high)
         call look(middle)
         if (any(self%events%g > 0.0_wp)) then
            high = middle
         else
            low = middle
         end if
      end do
      if (status == 0) call look(high)
      if (status /= 0) return
      event = maxloc(self%events%g, dim=1, mask=self%events%rate > 0.0_wp .and. self%events%g > 0.0_wp)
      is_found = event > 0
      if (.not. is_found) event = maxloc(self%events%g, dim=1)

   contains

      !> The state at a place of the step, held, into `trial`, and its event functions.
      subroutine look(s)
         real(wp), intent(in) :: s  !! place in the whole step [1]

         call self%held_state(system, s, self%trial, status)
         if (status /= 0) return
         call self%look_at_events(system, self%step%t0 + s*self%last%h_whole, self%trial, self%events%g, self%events%rate)
      end subroutine look

   end subroutine halve

end submodule multistep_events
