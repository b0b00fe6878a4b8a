!> Follows the contacts of a motion: their onset, their maxima, their end, one row for each.
!>
!> The maximum force of a contact is one that the motion had at an instant that can be reported: a maximum within a step, which is
!> reported at once (`peaks`), or the force at the end of a step, of which a row is owed (`owes_row`) until one is written there or
!> a greater force is found. What is greater by no more than the noise of an integration is not reported anew. Where rows at
!> contacts are requested (`tells_all`), every maximum of force and penetration is reported that rises by more than `ripple` above
!> the minimum before.
module contact_monitor
   use archive, only: archive_t
   use clearance_set, only: clearance_set_t, loss_contact, loss_friction
   use contact_peaks, only: drop_peaks, look, peak_t, trend_t
   use contact_places, only: place_of_loss, slip_function, touch_function, transition_function, turn_function
   use cut_off, only: lost_by_damping
   use floors, only: at_rest
   use force_jumps, only: find_derivative_behind, law_jumps, time_to_see
   use integrator, only: integrator_t
   use integrator_controls, only: onset_located
   use kinds, only: not_a_number, pi, wp
   use mechanism, only: mechanism_t
   use recorder, only: event_t
   use slip_monitor, only: handle_slip
   use turn_monitor, only: handle_turn
   use wear_monitor, only: new_wear_monitor, wear_monitor_t
   implicit none (type, external)
   private
   public :: close_open, contact_monitor_t, new_contact_monitor

   real(wp), parameter :: first_step = 0.01_wp   !! first step of a contact, of the duration of an elastic impact [1]
   real(wp), parameter :: noise = 1.0e-7_wp      !! of a force that a row has reported: more than that is worth another row [1]
   real(wp), parameter :: ripple = 1.0e-4_wp     !! rise to a maximum that is none, of the maximum value of the contact [1]

   !> What is known of each contact at the end of the last step.
   type :: contact_monitor_t
      type(peak_t), allocatable :: peaks(:)          !! (n_peak or more) maximum forces so far that lie within the last step
      integer :: n_peak = 0                          !! how many
      logical, allocatable :: owes_row(:)            !! (contacts) the present force is the maximum so far, and no row reports it
      real(wp), allocatable :: told(:)               !! (contacts) the maximum force of the contact that a row reports [N]
      logical :: tells_all = .false.                 !! maxima are reported that are not the maximum so far, too
      real(wp), allocatable :: low(:, :)             !! (2, contacts) minimum force and penetration since the last maximum [N, m]
      real(wp) :: made = 0.0_wp                      !! energy that the contact of the last event started with, from nothing [J]
      real(wp) :: shift = 0.0_wp                     !! time from the last onset to where a force that jumps there is seen [s]
      type(trend_t), allocatable :: force(:)         !! (contacts) normal force
      type(trend_t), allocatable :: penetration(:)   !! (contacts) penetration
      type(wear_monitor_t) :: wear                   !! what surfaces lose
      real(wp), allocatable :: y(:)                  !! (n) scratch state [any]
      real(wp), allocatable :: ydot(:)               !! (n) scratch derivative [any]
      real(wp), allocatable :: g(:), g_rate(:)       !! (contacts) scratch event functions and rates [m, m/s]
   contains
      procedure :: after_step
      procedure :: note_row
      procedure :: drop_peaks => monitor_drop_peaks
      procedure :: extrapolate
      procedure :: after_restart
      procedure :: handle_event
      procedure :: save => monitor_save
      procedure :: load => monitor_load
   end type contact_monitor_t

   interface

      !> Look for maxima of force and penetration within the last step, whether a force is cut off, and what surfaces lose.
      module subroutine after_step(self, system, method)
         implicit none (type, external)
         class(contact_monitor_t), intent(inout) :: self   !! the monitor
         type(mechanism_t), intent(inout) :: system      !! the system
         class(integrator_t), intent(inout) :: method    !! the integrator, after a step; the system is at its end
      end subroutine after_step

      !> Write what the monitor remembers.
      module subroutine monitor_save(self, archive)
         implicit none (type, external)
         class(contact_monitor_t), intent(in) :: self  !! the monitor
         type(archive_t), intent(inout) :: archive     !! the checkpoint
      end subroutine monitor_save

      !> Read what the monitor remembers.
      module subroutine monitor_load(self, archive)
         implicit none (type, external)
         class(contact_monitor_t), intent(inout) :: self  !! the monitor
         type(archive_t), intent(inout) :: archive        !! the checkpoint
      end subroutine monitor_load

   end interface

contains

   !> Storage for the contacts of a system.
   subroutine new_contact_monitor(system, monitor)
      type(mechanism_t), intent(in) :: system   !! the system
      type(contact_monitor_t), intent(out) :: monitor   !! the monitor

      allocate (monitor%peaks(1))
      call new_wear_monitor(system, monitor%wear)
      allocate (monitor%owes_row(system%clearance_joints%n_contact), source=.false.)
      allocate (monitor%told(system%clearance_joints%n_contact), source=0.0_wp)
      allocate (monitor%low(2, system%clearance_joints%n_contact), source=0.0_wp)
      allocate (monitor%force(system%clearance_joints%n_contact), monitor%penetration(system%clearance_joints%n_contact))
      allocate (monitor%y(system%n), monitor%ydot(system%n), source=0.0_wp)
      allocate (monitor%g(system%clearance_joints%n_contact), monitor%g_rate(system%clearance_joints%n_contact), source=0.0_wp)
   end subroutine new_contact_monitor

   !> Peaks up to a time are reported.
   subroutine monitor_drop_peaks(self, t)
      class(contact_monitor_t), intent(inout) :: self     !! the monitor
      real(wp), intent(in) :: t                         !! the time [s]

      call drop_peaks(t, self%peaks, self%n_peak)
   end subroutine monitor_drop_peaks

   !> A row was written at the present state: nothing is owed.
   subroutine note_row(self)
      class(contact_monitor_t), intent(inout) :: self     !! the monitor

      where (self%owes_row) self%told = self%force%value
      self%owes_row = .false.
   end subroutine note_row

   !> What the events at the end of the last step are going to be; to be asked before they are handled.
   subroutine extrapolate(self, system, method, has_end, has_onset, has_jump)
      class(contact_monitor_t), intent(inout) :: self     !! the monitor
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(in) :: method         !! the integrator, at the events
      logical, intent(out) :: has_end                   !! a contact ends
      logical, intent(out) :: has_onset                 !! a contact starts
      logical, intent(out) :: has_jump                  !! a normal force may jump

      type(trend_t) :: force, penetration
      integer :: i, k, n, number

      has_end = .false.
      has_onset = .false.
      has_jump = .false.
      self%shift = 0.0_wp
      do n = 1, method%events%n_happened
         number = method%events%happened(n)
         if (system%clearance_joints%functions%kind_of(number) /= touch_function) then
            has_jump = has_jump .or. system%clearance_joints%functions%kind_of(number) == turn_function
            cycle
         end if
         call system%find_contact(number, k, i)
         call system%linkage%set_motion(method%t, method%step%y1)
         call look(system, k, i, force, penetration)
         associate (set => system%clearance_joints%sets(k)%set)
            if (set%contact(i)%is_touching) then
               has_end = .true.
               has_jump = has_jump .or. set%traits%energy_jumps .or. law_jumps(set, i, penetration%rate, &
                                                                               set%contact(i)%impact_speed)
               cycle
            end if
            has_onset = .true.
            has_jump = has_jump .or. set%traits%energy_jumps .or. method%controls%onset /= onset_located
            if (.not. law_jumps(set, i, penetration%rate, max(penetration%rate, 0.0_wp))) cycle
            has_jump = .true.
            self%shift = max(self%shift, time_to_see(system, method, penetration%value, penetration%rate))
         end associate
      end do
   end subroutine extrapolate

   !> After a start or events: forces start anew, and count at once. A force that jumps at an onset is that of the moment after, and
   !> so is the derivative that the next step starts with: at the onset itself the surfaces just meet, and round-off decides whether
   !> there is a force. It is extrapolated back from two such moments.
   subroutine after_restart(self, system, method)
      class(contact_monitor_t), intent(inout) :: self     !! the monitor
      type(mechanism_t), intent(inout) :: system    !! the system, at the present state
      class(integrator_t), intent(inout) :: method      !! the integrator, started again; its derivative may change

      integer :: i, k, number, status

      status = 1
      if (self%shift > 0.0_wp) call find_derivative_behind(system, method, self%shift, self%y, self%ydot, status)
      if (status /= 0) then
         self%shift = 0.0_wp
         call system%linkage%set_state(method%t, method%step%y1, method%step%f1)
      end if
      do k = 1, size(system%clearance_joints%sets)
         if (system%clearance_joints%sets(k)%set%n_touching == 0) cycle
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               number = set%before%contacts + i
               call look(system, k, i, self%force(number), self%penetration(number))
               call set%note_depth(i, self%penetration(number)%value, method%t)
               call set%note_force(i, self%force(number)%value, method%t)
               self%owes_row(number) = self%force(number)%value >= set%contact(i)%peak_force .and. &
                                       self%force(number)%value > (1.0_wp + noise)*self%told(number)
            end do
         end associate
      end do
      if (self%shift > 0.0_wp) call system%linkage%set_state(method%t, method%step%y1, method%step%f1)
   end subroutine after_restart

   !> A located event: a contact starts or ends, turns, slips or sticks. Where the energy that the contacts store jumps with it,
   !> what is gone counts as lost in this contact: it is negative where the energy grows.
   subroutine handle_event(self, system, method, number, is_over, row, step_hint)
      class(contact_monitor_t), intent(inout) :: self     !! the monitor
      type(mechanism_t), intent(inout) :: system    !! the system; the contact's state is changed
      class(integrator_t), intent(inout) :: method      !! the integrator, at the event; the ledger of its state may change
      integer, intent(in) :: number                     !! number of the event function
      logical, intent(out) :: is_over                   !! there is something to report: a contact ended
      type(event_t), intent(out) :: row                 !! what there is to report
      real(wp), intent(out) :: step_hint                !! step that suits what starts; 0: as before [s]

      real(wp) :: loss, lost, rate, stored
      integer :: i, k, z
      type(trend_t) :: force, penetration

      self%made = 0.0_wp
      call system%find_contact(number, k, i)
      if (system%clearance_joints%functions%kind_of(number) /= touch_function) then
         is_over = .false.
         select case (system%clearance_joints%functions%kind_of(number))
         case (slip_function); call handle_slip(system, k, i)
         case (turn_function); call handle_turn(system, method%t, method%step%y1, k, i)
         case (transition_function); call system%clearance_joints%sets(k)%set%cross_transition(i)
         end select
         step_hint = step_in_contact()
         return
      end if
      call system%events(method%t, method%step%y1, self%g, self%g_rate)
      call look(system, k, i, force, penetration)
      rate = penetration%rate  ! the normal one: at an end of a guide with faces that of the event is axial
      associate (set => system%clearance_joints%sets(k)%set)
         stored = 0.0_wp
         if (set%traits%energy_jumps) stored = set%elastic_energy(system%linkage%motion)
         is_over = set%contact(i)%is_touching
         self%owes_row(number) = .false.
         self%told(number) = 0.0_wp
         self%low(:, number) = 0.0_wp
         if (is_over) then
            loss = loss_of(system, method%step%y1, k, i)
            if (system%ledger%is_kept) then
               z = system%in_state(place_of_loss(number, loss_contact))
               method%step%y1(z) = lost_by_damping(set, i, system%linkage%motion, method%step%y1(z))
            end if
            call set%end_contact(i, method%t, -rate, loss, .true., row)
            step_hint = 0.0_wp
         else
            rate = max(rate, 0.0_wp)
            call set%begin_contact(i, method%t, rate, loss_of(system, method%step%y1, k, i))
            call set%note_contact_rate(i, penetration%value)
            step_hint = step_in_contact()
         end if
      end associate
      if (system%clearance_joints%sets(k)%set%traits%energy_jumps .and. system%ledger%is_kept) call book_jump()

   contains

      !> What the stored energy jumped by. A contact that starts where the surfaces overlap came over an end of its guide, and
      !> started with an energy from nothing.
      subroutine book_jump()
         lost = stored - system%clearance_joints%sets(k)%set%elastic_energy(system%linkage%motion)
         z = system%in_state(place_of_loss(number, loss_contact))
         method%step%y1(z) = method%step%y1(z) + lost
         if (is_over) then
            row%energy_lost = row%energy_lost + lost
         else if (method%controls%onset == onset_located .and. penetration%value > 2.0_wp*method%events%noise(number)) then
            self%made = -lost
         end if
      end subroutine book_jump

      !> Step that suits the contact: a part of its swing; of that of the slowest impact if it has neither speed nor depth.
      real(wp) function step_in_contact() result(step)
         associate (set => system%clearance_joints%sets(k)%set)
            if (set%contact(i)%contact_rate > 0.0_wp) then
               step = first_step*pi/set%contact(i)%contact_rate
            else
               step = first_step*set%contact_time(i, at_rest*system%linkage%scales%pace*system%linkage%scales%length, &
                                                  system%linkage%inverse_mass(1, :))
            end if
         end associate
      end function step_in_contact

   end subroutine handle_event

   !> The run ends within a contact: report of the first open one, and take it off the list.
   subroutine close_open(system, method, is_open, row)
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(in) :: method         !! the integrator, at the end
      logical, intent(out) :: is_open                   !! there was one: `row` reports of it
      type(event_t), intent(out) :: row                 !! the contact

      integer :: i, k

      is_open = .false.
      if (.not. allocated(method%step%y1)) return  ! the run did not start
      call system%linkage%set_motion(method%t, method%step%y1)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               call set%end_contact(i, method%t, 0.0_wp, loss_of(system, method%step%y1, k, i), .false., row)
               call set%take_off(i)
               is_open = .true.
               return
            end do
         end associate
      end do
   end subroutine close_open

   !> What the ledger has lost in a contact at the present motion; NaN without a ledger.
   real(wp) function loss_of(system, y, slot, item) result(loss)
      type(mechanism_t), intent(in) :: system  !! the system, its motion that of the state
      real(wp), intent(in) :: y(:)                 !! (n) state [any]
      integer, intent(in) :: slot                  !! set of the contact
      integer, intent(in) :: item                  !! contact of the set

      integer :: z

      loss = not_a_number()
      if (.not. system%ledger%is_kept) return
      associate (set => system%clearance_joints%sets(slot)%set)
         z = system%in_state(place_of_loss(set%before%contacts + item, loss_contact))
         loss = lost_by_damping(set, item, system%linkage%motion, y(z))
         z = system%in_state(place_of_loss(set%before%contacts + item, loss_friction))
         loss = loss + y(z)
      end associate
   end function loss_of

end module contact_monitor
