!> Events of one-step methods: a step is shortened by re-stepping until it ends at its first event.
submodule(one_step) one_step_events
   use event_location, only: dismiss_event, first_of, note_events, time_resolution
   use ode_system, only: contact_onset
   implicit none (type, external)

   real(wp), parameter :: near = 1.0e-9_wp   !! of a step: corrections below it may be noise [1]
   real(wp), parameter :: zero = 0.25_wp     !! of a function's noise: what is below is zero [1]
   real(wp), parameter :: missed = 1.0e-3_wp   !! of the tolerance: what the rest of the way to an event may miss [1]
   integer, parameter :: n_rest = 3            !! times that a rest of the way is gone without the method
   integer, parameter :: n_newton = 16       !! re-steps towards an event
   integer, parameter :: n_halving = 60      !! halvings if these do not converge

contains

   !> Shorten the step so that it ends at an event. A function of known noise that does not rise where it was found is at none.
   module procedure go_to_event
      real(wp) :: h, low
      logical :: is_found

      do while (event > 0)
         call close_in(self, system, event, place, h, is_found, status)
         if (status == 0 .and. .not. is_found) call halve(self, system, high, h, event, is_found, status)
         if (status /= 0 .or. is_found) exit
         call dismiss_event(system, self, near_event, event, low, high, place)
      end do
      if (status == 0 .and. is_found) then
         call note_events(self, event, self%step%h)
         self%step%h = h
         self%t = self%step%t0 + h
         self%step%y1 = self%trial
      end if
      if (status == 0) then  ! without an event the whole step stands
         call system%evaluate(self%t, self%step%y1, self%step%f1, status)
         self%count%n_evaluations = self%count%n_evaluations + 1
      end if
      status = merge(merge(advance_event, advance_step, is_found), advance_failed_evaluation, status == 0)
   end procedure go_to_event

   !> The state after a part of the step, with the event functions there, into `g` and `rate`.
   subroutine step_by(self, system, h, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the part [s]
      integer, intent(out) :: status                !! of the evaluations

      call self%make_part(system, h, status)
      if (status == 0) call self%look_at_events(system, self%step%t0 + h, self%trial, self%events%g, self%events%rate)
   end subroutine step_by

   !> Newton's iteration on the length of the step towards an event, its tangent bent as the cubic of Hermite through the start of
   !> the step is: from a place that the interpolant predicted the first correction is the last one, and so small that few stages
   !> lead there. Where another function has clearly been above its threshold for longer, it continues towards that one.
   subroutine close_in(self, system, event, place, h, is_found, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(inout) :: event               !! the event function, by the interpolant; then the first one
      real(wp), intent(in) :: place                 !! where it is, by the interpolant [1]
      real(wp), intent(out) :: h                    !! length of the step to the event [s]
      logical, intent(out) :: is_found              !! whether it was found, and no other one comes clearly earlier
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: before, full, h_before, h_new, resolution
      integer :: earlier, i, k, n_stage

      full = self%step%h
      resolution = time_resolution(self, full)
      h = place*full
      before = huge(1.0_wp)
      h_before = h
      is_found = .false.
      do i = 1, n_newton
         call step_by(self, system, h, status)
         if (status /= 0) exit
         earlier = first_of(self, resolution)
         if (earlier > 0 .and. earlier /= event) then
            event = earlier
            before = huge(1.0_wp)
         end if
         if (self%events%rate(event) <= 0.0_wp) exit
         h_new = h + correction(self, event, h)
         ! at round-off the function no longer falls
         is_found = abs(h_new - h) <= near*full .and. abs(self%events%g(event)) >= 0.25_wp*before
         is_found = is_found .or. abs(self%events%g(event)) <= zero*self%events%noise(event)
         is_found = is_found .or. abs(h_new - h) <= eps*h
         do k = 1, n_rest
            n_stage = stages_to(self, system, event, h, h_new)
            if (is_found .or. n_stage == 0) exit
            call go_on(self, system, n_stage, h, h_new, status)
            if (status /= 0) exit
            h = h_new
            is_found = abs(self%events%g(event)) <= self%events%noise(event)
            if (.not. is_found) h_new = h + correction(self, event, h)
         end do
         if (status /= 0) exit
         if (is_found .or. h_new <= 0.0_wp .or. h_new > 1.5_wp*full) exit
         before = abs(self%events%g(event))
         h_before = h
         h = h_new
      end do
      if (is_found .and. abs(self%events%g(event)) > before) then
         h = h_before  ! the last correction was noise
         call step_by(self, system, h, status)
         is_found = status == 0
      end if
      ! it must rise, and no other one may have come and gone before
      if (is_found) is_found = self%events%rate(event) > 0.0_wp
      if (is_found) is_found = .not. any(self%events%g - self%events%noise > near*full*abs(self%events%rate) .and. &
                                                [(i /= event, i=1, size(self%events%g))])
   end subroutine close_in

   !> Stages that lead from the end of a part on to where the event is: one, along the derivative, where the path does not bend so
   !> far; four of the classical method of Runge and Kutta before a contact starts, where forces are smooth, but not with methods
   !> for stiff ones; 0: the method itself is asked. Only of functions with known noise it can be reported that they did.
   integer function stages_to(self, system, event, h, h_new) result(n)
      class(one_step_t), intent(in) :: self      !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      integer, intent(in) :: event               !! the event function
      real(wp), intent(in) :: h                  !! length of the part [s]
      real(wp), intent(in) :: h_new              !! length up to the event [s]

      real(wp) :: rest

      n = 0
      if (self%controls%fixed_step > 0.0_wp .or. system%holds .or. .not. self%events%noise(event) > 0.0_wp) return
      rest = abs(h_new - h)/h
      if (rest**2 <= missed*self%controls%tolerance) then
         n = 1
      else if (rest**5 <= missed*self%controls%tolerance .and. self%is_explicit()) then
         if (system%contact_change(event) == contact_onset) n = 4
      end if
   end function stages_to

   !> From the end of a part of a step on to where the event is.
   subroutine go_on(self, system, n_stage, h, h_new, status)
      class(one_step_t), intent(inout) :: self      !! the integrator, `trial` at the end of the part; then at the event
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(in) :: n_stage                !! stages, 1 or 4
      real(wp), intent(in) :: h                     !! length of the part [s]
      real(wp), intent(in) :: h_new                 !! length up to the event [s]
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: sum(size(self%trial)), rest
      integer :: stage

      rest = h_new - h
      call derive(h, self%trial)
      sum = self%scratch
      if (n_stage == 4) then
         do stage = 2, 4
            if (status == 0) call derive(h + merge(rest, 0.5_wp*rest, stage == 4), &
                                         self%trial + merge(rest, 0.5_wp*rest, stage == 4)*self%scratch)
            sum = sum + merge(1.0_wp, 2.0_wp, stage == 4)*self%scratch
         end do
         sum = sum/6.0_wp
      end if
      if (status /= 0) return
      self%trial = self%trial + rest*sum
      call self%look_at_events(system, self%step%t0 + h_new, self%trial, self%events%g, self%events%rate)

   contains

      !> The derivative at a state, into `scratch`.
      subroutine derive(after, y)
         real(wp), intent(in) :: after   !! how long after the start of the step [s]
         real(wp), intent(in) :: y(:)    !! (n) the state [any]

         call system%evaluate(self%step%t0 + after, y, self%scratch, status)
         self%count%n_evaluations = self%count%n_evaluations + 1
      end subroutine derive

   end subroutine go_on

   !> What is left to the zero of an event function at the end of a step, to second order: g + g' d + g'' d^2/2 = 0.
   pure real(wp) function correction(self, event, h) result(d)
      class(one_step_t), intent(in) :: self   !! the integrator, event functions looked at
      integer, intent(in) :: event            !! the event function, rising
      real(wp), intent(in) :: h               !! length of the step [s]

      real(wp) :: bend, g_0

      associate (events => self%events, g => self%events%g(event), rate => self%events%rate(event))
         g_0 = events%g0(event) - events%threshold(event)
         bend = (6.0_wp*(g_0 - g)/h + 2.0_wp*events%rate0(event) + 4.0_wp*rate)/h
         d = -g/rate
         if (abs(bend*d) < 0.5_wp*rate) d = d - 0.5_wp*bend*d*d/rate
      end associate
   end function correction

   !> A grazing contact, or a function that came and went before: halve between "none positive" and "one positive".
   subroutine halve(self, system, high, h, event, is_found, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: high                  !! place after the event, by the interpolant [1]
      real(wp), intent(out) :: h                    !! length of the step to the event [s]
      integer, intent(inout) :: event               !! by the interpolant; then the first event function, or one that is at none
      logical, intent(out) :: is_found              !! whether it rises there
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: h_high, h_low
      integer :: i

      is_found = .false.
      h_low = 0.0_wp
      h_high = high*self%step%h
      call step_by(self, system, h_high, status)
      if (status == 0 .and. all(self%events%g <= 0.0_wp)) then
         h_high = self%step%h  ! the interpolant's maximum was not there
         if (all(self%events%g1 <= self%events%threshold)) return
      end if
      do i = 1, n_halving
         h = 0.5_wp*(h_low + h_high)
         if (h_high - h_low <= eps*abs(self%step%t0 + h)) exit
         call step_by(self, system, h, status)
         if (status /= 0) exit
         if (any(self%events%g > 0.0_wp)) then
            h_high = h
         else
            h_low = h
         end if
      end do
      h = h_high
      if (status == 0) call step_by(self, system, h, status)
      if (status /= 0) return
      event = maxloc(self%events%g, dim=1, mask=self%events%rate > 0.0_wp .and. self%events%g > 0.0_wp)
      is_found = event > 0
      if (is_found) return
      event = maxloc(self%events%g, dim=1)
      is_found = self%events%noise(event) <= 0.0_wp  ! its rate may be poorer than the place
   end subroutine halve

end submodule one_step_events
