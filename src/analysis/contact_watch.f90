!> Follows the contacts of a motion: their onset, their maxima, their end, one row for each.
module contact_watch
   use integrator, only: integrator_t
   use kinds, only: not_a_number, wp
   use memory, only: get, put
   use planar_system, only: n_ledger, planar_system_t
   use recorder, only: event_t
   use slip_watch, only: handle_slip
   use turn_watch, only: handle_turn
   implicit none (type, external)
   private
   public :: close_open, contact_watch_t, new_contact_watch

   real(wp), parameter :: first_step = 0.01_wp   !! first step of a contact, of the duration of an elastic impact [1]
   real(wp), parameter :: near = 1.0e-9_wp       !! error of a maximum, the square of what the parabola adds [1]
   integer, parameter :: n_search = 8            !! places looked at in search of a maximum

   !> A value and its rate.
   type :: trend_t
      real(wp) :: value = 0.0_wp  !! force or penetration [N or m]
      real(wp) :: rate = 0.0_wp   !! its rate [N/s or m/s]
   end type trend_t

   !> Part of a step that holds a maximum: the value rises at its left end and falls at its right end.
   type :: bracket_t
      real(wp) :: place_a = 0.0_wp  !! left end, of the step [1]
      real(wp) :: place_b = 1.0_wp  !! right end, of the step [1]
      real(wp) :: h = 0.0_wp        !! length of the step [s]
      type(trend_t) :: a            !! what is at the left end
      type(trend_t) :: b            !! what is at the right end
   end type bracket_t

   !> What is known of each contact at the end of the last step.
   type :: contact_watch_t
      type(trend_t), allocatable :: force(:)         !! (contacts) normal force
      type(trend_t), allocatable :: penetration(:)   !! (contacts) penetration
      real(wp), allocatable :: y(:)                  !! (n) scratch state [any]
      real(wp), allocatable :: ydot(:)               !! (n) scratch derivative [any]
      real(wp), allocatable :: g(:), g_rate(:)       !! (contacts) scratch event functions and rates [m, m/s]
   contains
      procedure :: after_step
      procedure :: after_restart
      procedure :: handle_event
      procedure :: memory_size => watch_memory_size
      procedure :: save => watch_save
      procedure :: load => watch_load
   end type contact_watch_t

contains

   !> Room for the contacts of a system.
   subroutine new_contact_watch(system, watch)
      type(planar_system_t), intent(in) :: system   !! the system
      type(contact_watch_t), intent(out) :: watch   !! the watch

      allocate (watch%force(system%n_contact), watch%penetration(system%n_contact))
      allocate (watch%y(system%n), watch%ydot(system%n), source=0.0_wp)
      allocate (watch%g(system%n_contact), watch%g_rate(system%n_contact), source=0.0_wp)
   end subroutine new_contact_watch

   !> Look for maxima of force and penetration within the last step.
   subroutine after_step(self, system, method)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step; the system is at its end

      type(trend_t) :: force, penetration
      integer :: i, k, number
      logical :: has_force_peak, has_peak

      do k = 1, size(system%clearances)
         if (system%clearances(k)%set%n_touching == 0) cycle
         call system%set_acceleration(method%step%f1)
         do i = 1, system%clearances(k)%set%n_contact
            if (.not. system%clearances(k)%set%contact(i)%is_touching) cycle
            number = system%clearances(k)%set%first_contact + i
            call look(system, k, i, force, penetration)
            call keep_peaks(system, k, i, penetration%value, force%value)
            has_peak = self%penetration(number)%rate >= 0.0_wp .and. penetration%rate < 0.0_wp
            has_force_peak = self%force(number)%rate >= 0.0_wp .and. force%rate < 0.0_wp
            if (has_peak) call find_penetration_peak(self, system, method, k, i, self%penetration(number), penetration)
            if (has_force_peak) call find_force_peak(self, system, method, k, i, self%force(number), force)
            if (has_peak .or. has_force_peak) call system%set_state(method%t, method%step%y1, method%step%f1)
            self%force(number) = force
            self%penetration(number) = penetration
         end do
      end do
   end subroutine after_step

   !> After events: forces that jumped with them begin anew, and count as peaks at once.
   subroutine after_restart(self, system, method)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system, at the present state
      class(integrator_t), intent(in) :: method         !! the integrator, begun again

      integer :: i, k, number

      do k = 1, size(system%clearances)
         if (.not. system%clearances(k)%set%energy_jumps .or. system%clearances(k)%set%n_touching == 0) cycle
         call system%set_acceleration(method%step%f1)
         do i = 1, system%clearances(k)%set%n_contact
            if (.not. system%clearances(k)%set%contact(i)%is_touching) cycle
            number = system%clearances(k)%set%first_contact + i
            call look(system, k, i, self%force(number), self%penetration(number))
            call keep_peaks(system, k, i, self%penetration(number)%value, self%force(number)%value)
         end do
      end do
   end subroutine after_restart

   !> Force and penetration of a contact at the present motion.
   subroutine look(system, slot, item, force, penetration)
      type(planar_system_t), intent(in) :: system     !! the system, motion and accelerations set
      integer, intent(in) :: slot                     !! set of the contact
      integer, intent(in) :: item                     !! contact of the set
      type(trend_t), intent(out) :: force             !! normal force
      type(trend_t), intent(out) :: penetration       !! penetration

      call system%clearances(slot)%set%watch(item, system%motion, penetration%value, penetration%rate, &
                                             force%value, force%rate)
   end subroutine look

   !> Raise the peaks that a contact remembers.
   subroutine keep_peaks(system, slot, item, delta, force)
      type(planar_system_t), intent(inout) :: system  !! the system
      integer, intent(in) :: slot                     !! set of the contact
      integer, intent(in) :: item                     !! contact of the set
      real(wp), intent(in) :: delta                   !! penetration [m]
      real(wp), intent(in) :: force                   !! normal force [N]

      associate (contact => system%clearances(slot)%set%contact(item))
         contact%peak_force = max(contact%peak_force, force)
         contact%peak_penetration = max(contact%peak_penetration, delta)
      end associate
   end subroutine keep_peaks

   !> Maximum of the penetration within the last step, on its interpolant.
   subroutine find_penetration_peak(self, system, method, slot, item, left, right)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(in) :: method         !! the integrator, after a step
      integer, intent(in) :: slot                       !! set of the contact
      integer, intent(in) :: item                       !! contact of the set
      type(trend_t), intent(in) :: left                 !! penetration at the start of the step
      type(trend_t), intent(in) :: right                !! penetration at its end

      type(bracket_t) :: bracket
      type(trend_t) :: force, here
      real(wp) :: place
      integer :: k

      bracket = bracket_t(h=method%step%h, a=left, b=right)
      do k = 1, n_search
         place = maximum_in(bracket)
         call method%within(system, place, self%y)
         call system%set_motion(method%step%t0 + place*method%step%h, self%y)
         call look(system, slot, item, force, here)
         call keep_peaks(system, slot, item, here%value + missing(here, bracket), 0.0_wp)
         if (missing(here, bracket) <= sqrt(near)*abs(here%value)) exit
         call narrow(place, here, bracket)
      end do
   end subroutine find_penetration_peak

   !> Maximum of the normal force within the last step: each place looked at is reached by the method
   !> itself, so that the force is as accurate as the step. What is still missing to the maximum of
   !> the parabola through the place is added.
   subroutine find_force_peak(self, system, method, slot, item, left, right)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step
      integer, intent(in) :: slot                       !! set of the contact
      integer, intent(in) :: item                       !! contact of the set
      type(trend_t), intent(in) :: left                 !! force at the start of the step
      type(trend_t), intent(in) :: right                !! force at its end

      type(bracket_t) :: bracket
      type(trend_t) :: here, penetration
      real(wp) :: place
      integer :: k, status

      bracket = bracket_t(h=method%step%h, a=left, b=right)
      do k = 1, n_search
         place = maximum_in(bracket)
         call method%refine(system, place, self%y, status)
         if (status /= 0) return
         call system%evaluate(method%step%t0 + place*method%step%h, self%y, self%ydot, status)
         if (status /= 0) return
         call system%set_state(method%step%t0 + place*method%step%h, self%y, self%ydot)
         call look(system, slot, item, here, penetration)
         call keep_peaks(system, slot, item, 0.0_wp, here%value + missing(here, bracket))
         if (missing(here, bracket) <= sqrt(near)*abs(here%value)) exit
         call narrow(place, here, bracket)
      end do
   end subroutine find_force_peak

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

   !> What is missing to the maximum of a parabola with the curvature of the bracket.
   pure real(wp) function missing(here, bracket) result(rest)
      type(trend_t), intent(in) :: here        !! a place between
      type(bracket_t), intent(in) :: bracket   !! the bracket

      real(wp) :: time  ! length of the bracket [s]

      time = (bracket%place_b - bracket%place_a)*bracket%h
      rest = 0.5_wp*here%rate**2*time/max(bracket%a%rate - bracket%b%rate, tiny(1.0_wp))
   end function missing

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

   !> A located event: a contact begins or ends, turns, slips or sticks. Where the energy that the contacts store jumps with it,
   !> what is gone counts as lost in this contact: it is negative where the energy grows.
   subroutine handle_event(self, system, method, number, is_over, row, step_hint)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system; the contact's state is changed
      class(integrator_t), intent(inout) :: method      !! the integrator, at the event; the ledger of its state may change
      integer, intent(in) :: number                     !! number of the event function
      logical, intent(out) :: is_over                   !! there is something to tell: a contact ended, or its friction changed
      type(event_t), intent(out) :: row                 !! what there is to tell
      real(wp), intent(out) :: step_hint                !! step that suits what begins; 0: as before [s]

      real(wp) :: lost, rate, stored
      integer :: i, k, z
      type(trend_t) :: force, penetration

      call system%find_contact(number, k, i)
      if (number > system%n_contact) then
         is_over = .not. (system%first_turn > 0 .and. number > system%first_turn)
         if (is_over) then
            call handle_slip(system, method%t, method%step%y1, k, i, row)
         else
            call handle_turn(system, method%t, method%step%y1, k, i)
         end if
         step_hint = step_in_contact(system%clearances(k)%set%contact(i)%impact_speed)
         return
      end if
      call system%events(method%t, method%step%y1, self%g, self%g_rate)
      call look(system, k, i, force, penetration)
      rate = penetration%rate  ! the normal one: at an end of a guide that of the event is axial
      associate (set => system%clearances(k)%set)
         stored = 0.0_wp
         if (set%energy_jumps) stored = set%elastic_energy(system%motion)
         is_over = set%contact(i)%is_touching
         if (is_over) then
            call set%end_contact(i, method%t, -rate, loss_of(system, method%step%y1, number), .true., row)
            step_hint = 0.0_wp
         else
            rate = max(rate, 0.0_wp)
            call set%begin_contact(i, method%t, rate, loss_of(system, method%step%y1, number))
            self%force(number) = trend_t(0.0_wp, 0.0_wp)
            self%penetration(number) = trend_t(0.0_wp, rate)
            step_hint = step_in_contact(rate)
         end if
         if (.not. (set%energy_jumps .and. system%with_ledger)) return
         lost = stored - set%elastic_energy(system%motion)
         z = loss_place(system, number)
         method%step%y1(z) = method%step%y1(z) + lost
         if (is_over) row%energy_lost = row%energy_lost + lost
      end associate

   contains

      !> Step that suits the contact.
      real(wp) function step_in_contact(speed) result(step)
         real(wp), intent(in) :: speed  !! its impact speed [m/s]

         step = first_step*system%clearances(k)%set%contact_time(i, max(speed, tiny(1.0_wp)), system%inverse_mass(1, :))
      end function step_in_contact

   end subroutine handle_event

   !> The run ends within a contact: tell of the first open one, and take it off the list.
   subroutine close_open(system, method, is_open, row)
      type(planar_system_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(in) :: method         !! the integrator, at the end
      logical, intent(out) :: is_open                   !! there was one: `row` tells of it
      type(event_t), intent(out) :: row                 !! the contact

      integer :: i, k, number

      is_open = .false.
      do k = 1, size(system%clearances)
         associate (set => system%clearances(k)%set)
            do i = 1, set%n_contact
               number = set%first_contact + i
               if (.not. set%contact(i)%is_touching) cycle
               call set%end_contact(i, method%t, 0.0_wp, loss_of(system, method%step%y1, number), .false., row)
               set%contact(i)%is_touching = .false.
               set%n_touching = set%n_touching - 1
               is_open = .true.
               return
            end do
         end associate
      end do
   end subroutine close_open

   !> Numbers that a checkpoint needs.
   integer function watch_memory_size(self) result(n)
      class(contact_watch_t), intent(in) :: self  !! the watch

      n = 4*size(self%force)
   end function watch_memory_size

   !> Write what the watch remembers.
   subroutine watch_save(self, row, place)
      class(contact_watch_t), intent(in) :: self  !! the watch
      real(wp), intent(inout) :: row(:)           !! (any) checkpoint [any]
      integer, intent(inout) :: place             !! last place used

      integer :: k

      do k = 1, size(self%force)
         call put(row, place, [self%force(k)%value, self%force(k)%rate, self%penetration(k)%value, self%penetration(k)%rate])
      end do
   end subroutine watch_save

   !> Read what the watch remembers.
   subroutine watch_load(self, row, place)
      class(contact_watch_t), intent(inout) :: self  !! the watch
      real(wp), intent(in) :: row(:)                 !! (any) checkpoint [any]
      integer, intent(inout) :: place                !! last place used

      integer :: k

      do k = 1, size(self%force)
         call get(row, place, self%force(k)%value)
         call get(row, place, self%force(k)%rate)
         call get(row, place, self%penetration(k)%value)
         call get(row, place, self%penetration(k)%rate)
      end do
   end subroutine watch_load

   !> What the ledger has lost in a contact; NaN without a ledger.
   real(wp) function loss_of(system, y, number) result(loss)
      type(planar_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: y(:)                 !! (n) state [any]
      integer, intent(in) :: number                !! number of the contact

      integer :: z

      loss = not_a_number()
      if (.not. system%with_ledger) return
      z = loss_place(system, number)
      loss = y(z) + y(z + 1)
   end function loss_of

   !> Place in the state of what the ledger lost by damping in a contact; what it lost by friction is the next.
   pure integer function loss_place(system, number) result(z)
      type(planar_system_t), intent(in) :: system  !! the system, with a ledger
      integer, intent(in) :: number                !! number of the contact

      z = system%n - system%n_quadrature + n_ledger + 2*number - 1
   end function loss_place

end module contact_watch
