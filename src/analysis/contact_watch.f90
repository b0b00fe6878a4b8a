!> Follows the contacts of a motion: their onset, their maxima, their end, one row for each.
module contact_watch
   use integrator, only: integrator_t
   use interpolation, only: interpolate
   use kinds, only: not_a_number, wp
   use planar_system, only: n_ledger, planar_system_t
   use recorder, only: event_t
   implicit none (type, external)
   private
   public :: close_open, contact_watch_t, new_contact_watch

   real(wp), parameter :: first_step = 0.01_wp   !! first step of a contact, of the duration of an elastic impact [1]
   real(wp), parameter :: golden = 0.6180339887498949_wp  !! ratio of the golden section [1]
   integer, parameter :: n_section = 40          !! sections in search of a maximum

   !> What is known of each contact at the end of the last step.
   type :: contact_watch_t
      real(wp), allocatable :: force_rate(:)   !! (contacts) rate of the normal force; positive until it has been seen [N/s]
      real(wp), allocatable :: rate(:)         !! (contacts) rate of penetration [m/s]
      real(wp), allocatable :: y(:)            !! (n) scratch state [any]
      real(wp), allocatable :: ydot(:)         !! (n) scratch derivative [any]
   contains
      procedure :: after_step
      procedure :: handle_event
   end type contact_watch_t

contains

   !> Room for the contacts of a system.
   subroutine new_contact_watch(system, watch)
      type(planar_system_t), intent(in) :: system   !! the system
      type(contact_watch_t), intent(out) :: watch   !! the watch

      allocate (watch%force_rate(system%n_loose), watch%rate(system%n_loose), source=huge(1.0_wp))
      allocate (watch%y(system%n), watch%ydot(system%n), source=0.0_wp)
   end subroutine new_contact_watch

   !> Look for maxima of force and penetration within the last step.
   subroutine after_step(self, system, method)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step

      real(wp) :: delta, force, force_rate, rate
      integer :: i, k, number
      logical :: has_force_peak, has_peak

      do k = 1, size(system%clearances)
         if (system%clearances(k)%set%n_touching == 0) cycle
         call system%set_state(method%step%y1, method%step%f1)
         do i = 1, system%clearances(k)%set%n
            if (.not. system%clearances(k)%set%contact(i)%is_touching) cycle
            number = system%clearances(k)%set%first + i
            call system%clearances(k)%set%watch(i, system%motion, delta, rate, force, force_rate)
            call keep_peaks(system, k, i, delta, force)
            has_peak = self%rate(number) > 0.0_wp .and. rate < 0.0_wp
            has_force_peak = self%force_rate(number) > 0.0_wp .and. force_rate < 0.0_wp
            if (has_peak) call find_maximum(self, system, method, k, i, .false.)
            if (has_force_peak) call find_maximum(self, system, method, k, i, .true.)
            if (has_peak .or. has_force_peak) call system%set_state(method%step%y1, method%step%f1)
            self%force_rate(number) = force_rate
            self%rate(number) = rate
         end do
      end do
   end subroutine after_step

   !> Raise the peaks that a contact remembers.
   subroutine keep_peaks(system, slot, item, delta, force)
      type(planar_system_t), intent(inout) :: system  !! the system
      integer, intent(in) :: slot                     !! set of the contact
      integer, intent(in) :: item                     !! item of the set
      real(wp), intent(in) :: delta                   !! penetration [m]
      real(wp), intent(in) :: force                   !! normal force [N]

      associate (contact => system%clearances(slot)%set%contact(item))
         contact%peak_force = max(contact%peak_force, force)
         contact%peak_penetration = max(contact%peak_penetration, delta)
      end associate
   end subroutine keep_peaks

   !> Maximum of force or penetration within the last step: golden section on the interpolant, then
   !> the state there by the method itself.
   subroutine find_maximum(self, system, method, slot, item, is_force)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator
      integer, intent(in) :: slot                       !! set of the contact
      integer, intent(in) :: item                       !! item of the set
      logical, intent(in) :: is_force                   !! of the force, else of the penetration

      real(wp) :: a, b, c, d, delta, f_c, f_d, force, force_rate, rate
      integer :: k, status

      a = 0.0_wp
      b = 1.0_wp
      c = b - golden*(b - a)
      d = a + golden*(b - a)
      f_c = value_at(c)
      f_d = value_at(d)
      do k = 1, n_section
         if (f_c > f_d) then
            b = d
            d = c
            f_d = f_c
            c = b - golden*(b - a)
            f_c = value_at(c)
         else
            a = c
            c = d
            f_c = f_d
            d = a + golden*(b - a)
            f_d = value_at(d)
         end if
      end do
      call method%refine(system, 0.5_wp*(a + b), self%y, status)
      if (status /= 0) return
      call system%set_motion(self%y)
      call system%clearances(slot)%set%watch(item, system%motion, delta, rate, force, force_rate)
      call keep_peaks(system, slot, item, delta, force)

   contains

      !> Force or penetration at a place of the step.
      real(wp) function value_at(s)
         real(wp), intent(in) :: s  !! place in the step, 0 to 1 [1]

         call interpolate(method%step, system%n_position, s, self%y)
         call system%set_motion(self%y)
         call system%clearances(slot)%set%watch(item, system%motion, delta, rate, force, force_rate)
         value_at = merge(force, delta, is_force)
      end function value_at

   end subroutine find_maximum

   !> A located event: a contact begins or ends.
   subroutine handle_event(self, system, method, number, is_over, row, step_hint)
      class(contact_watch_t), intent(inout) :: self     !! the watch
      type(planar_system_t), intent(inout) :: system    !! the system; the contact's state is changed
      class(integrator_t), intent(in) :: method         !! the integrator, at the event
      integer, intent(in) :: number                     !! number of the loose joint
      logical, intent(out) :: is_over                   !! a contact ended: `row` tells of it
      type(event_t), intent(out) :: row                 !! the contact that ended
      real(wp), intent(out) :: step_hint                !! step that suits what begins; 0: as before [s]

      real(wp) :: rate
      integer :: i, k

      call system%find_loose(number, k, i)
      call system%events(method%t, method%step%y1, system%delta, system%rate)
      associate (set => system%clearances(k)%set)
         is_over = set%contact(i)%is_touching
         if (is_over) then
            rate = -system%rate(number)
            call set%end_contact(i, method%t, -rate, loss_of(system, method%step%y1, number), .true., row)
            step_hint = 0.0_wp
         else
            rate = system%rate(number)
            call set%begin_contact(i, method%t, rate, loss_of(system, method%step%y1, number))
            self%force_rate(number) = huge(1.0_wp)
            self%rate(number) = huge(1.0_wp)
            step_hint = first_step*set%contact_time(i, max(rate, tiny(1.0_wp)), &
                                                    system%inverse_mass(1, :))
         end if
      end associate
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
            do i = 1, set%n
               number = set%first + i
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

   !> What the ledger has lost in a loose joint; NaN without a ledger.
   real(wp) function loss_of(system, y, number) result(loss)
      type(planar_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: y(:)                 !! (n) state [any]
      integer, intent(in) :: number                !! number of the loose joint

      integer :: z

      loss = not_a_number()
      if (.not. system%with_ledger) return
      z = 6*system%n_body + n_ledger + 2*number
      loss = y(z - 1) + y(z)
   end function loss_of

end module contact_watch
