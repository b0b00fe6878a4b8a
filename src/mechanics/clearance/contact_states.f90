!> The contacts of all items of a set: which there are, which touch, and what they remember.
!>
!> An item has one contact or several, as many as it has labels: contact m is number (m - 1) mod n_contact_item + 1 of its item.
!> A contact is free or touching; it changes only at located events, and only by the procedures below: the impact speed is stored
!> at the onset, the maximum force and penetration as steps find them, and the end makes a row of the list of events.
module contact_states
   use archive, only: archive_t
   use contact_stick_slip, only: gives_way, stick_slip_t
   use contact_memory, only: contact_memory_t
   use kinds, only: i8, not_a_number, wp
   use recorder, only: event_t
   use states_of_contacts, only: state_contact, state_free, state_name
   use text, only: text_t
   implicit none (type, external)
   private
   public :: contact_states_t

   !> Numbers of earlier sets.
   type :: numbers_before_t
      integer :: items = 0      !! items of earlier sets
      integer :: contacts = 0   !! contacts of earlier sets
   end type numbers_before_t

   !> The contacts of a set.
   type :: contact_states_t
      integer :: n = 0                                    !! number of items
      integer :: n_contact_item = 1                       !! contacts of an item
      integer :: n_contact = 0                            !! contacts of all items
      integer :: n_touching = 0                           !! number of contacts that touch
      integer(i8) :: evaluated_at = 0                     !! number of the motion at which forces were found last; 0: none, or
                                                          !! a contact has changed since
      type(numbers_before_t) :: before                    !! of earlier sets
      type(text_t), allocatable :: names(:)               !! (n) names
      type(contact_memory_t), allocatable :: contact(:)   !! (n_contact) state of the contacts
      type(stick_slip_t) :: stick_slip                                !! what the contacts remember of their friction
   contains
      procedure :: item_of
      procedure :: label_of
      procedure, nopass :: contact_labels => states_contact_labels
      procedure :: begin_contact
      procedure :: set_impact_speed
      procedure :: end_contact
      procedure :: take_off
      procedure :: adopt => states_adopt
      procedure :: touch_where
      procedure :: begin_at_rest
      procedure :: note_depth
      procedure :: note_force
      procedure :: note_step
      procedure :: set_course
      procedure :: cross_transition
      procedure :: open_decision
      procedure :: slip_as
      procedure :: slip_toward
      procedure :: note_decision
      procedure :: note_shared
      procedure :: stick_with
      procedure :: place_bristles
      procedure :: bend_bristles
      procedure :: save => states_save
      procedure :: load => states_load
   end type contact_states_t

contains

   !> The item that a contact belongs to.
   pure integer function item_of(self, contact) result(item)
      class(contact_states_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact               !! contact of the set

      item = (contact - 1)/self%n_contact_item + 1
   end function item_of

   !> The name of a contact among those of its item, blank if it is the only one.
   pure function label_of(self, contact) result(label)
      class(contact_states_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact               !! contact of the set
      character(:), allocatable :: label           !! the name

      type(text_t), allocatable :: labels(:)
      integer :: place

      labels = self%contact_labels()
      place = modulo(contact - 1, self%n_contact_item) + 1
      label = labels(place)%s
   end function label_of

   !> Names of the contacts of an item: one without a name.
   pure function states_contact_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (contacts of an item) names

      allocate (labels(1))
      labels(1)%s = ""
   end function states_contact_labels

   !> A contact starts: store its impact speed.
   subroutine begin_contact(self, k, t, impact_speed, loss)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: t                       !! time of the onset [s]
      real(wp), intent(in) :: impact_speed            !! penetration rate at the onset [m/s]
      real(wp), intent(in) :: loss                    !! what the ledger has lost in the contact by now [J]

      type(contact_memory_t) :: begun

      begun%is_touching = .true.
      begun%onset = t
      begun%impact_speed = impact_speed
      begun%loss_at_onset = loss
      begun%went%force_at = t
      begun%went%penetration_at = t
      self%contact(k) = begun
      self%n_touching = self%n_touching + 1
      self%evaluated_at = 0
      call self%stick_slip%forget(k)
   end subroutine begin_contact

   !> A contact that touches is to have started with another speed: so a neighbouring motion has it.
   pure subroutine set_impact_speed(self, k, impact_speed)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: impact_speed            !! penetration rate at its onset [m/s]

      self%contact(k)%impact_speed = impact_speed
      self%evaluated_at = 0
   end subroutine set_impact_speed

   !> A contact ends, or the run ends within it: report its description in one row.
   subroutine end_contact(self, k, t, release_speed, loss, is_over, event)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: t                       !! time of the end [s]
      real(wp), intent(in) :: release_speed           !! separation speed [m/s]
      real(wp), intent(in) :: loss                    !! what the ledger has lost in the contact by now; NaN: no ledger [J]
      logical, intent(in) :: is_over                  !! .false.: the run ended within the contact
      type(event_t), intent(out) :: event             !! the row

      associate (contact => self%contact(k))
         event%time = contact%onset
         event%kind = "contact"
         event%item = self%names(self%item_of(k))%s
         event%contact = self%label_of(k)
         event%impact_speed = contact%impact_speed
         event%peak_force = contact%peak_force
         event%peak_penetration = contact%peak_penetration
         event%energy_lost = loss - contact%loss_at_onset
         event%impulse = contact%went%impulse
         event%peak_force_time = contact%went%force_at
         event%peak_penetration_time = contact%went%penetration_at
         event%state_before = state_name(state_free)
         if (is_over) then
            event%duration = t - contact%onset
            event%release_speed = release_speed
            event%state_after = state_name(state_free)
            contact%is_touching = .false.
            self%n_touching = self%n_touching - 1
            self%evaluated_at = 0
            call self%stick_slip%forget(k)
         else
            event%duration = not_a_number()
            event%release_speed = not_a_number()
            event%state_after = state_name(state_contact)
         end if
      end associate
   end subroutine end_contact

   !> A contact that the end of the run cut short is reported of: it is off the list of those that touch.
   pure subroutine take_off(self, k)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set

      self%contact(k)%is_touching = .false.
      self%n_touching = self%n_touching - 1
      self%evaluated_at = 0
   end subroutine take_off

   !> Take over what a contact of another set of the same laws remembers; deflections of bristles are in the state.
   subroutine states_adopt(self, k, other, k_other)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      class(contact_states_t), intent(in) :: other    !! the other set
      integer, intent(in) :: k_other                  !! contact of it

      self%n_touching = self%n_touching + merge(1, 0, other%contact(k_other)%is_touching) &
                        - merge(1, 0, self%contact(k)%is_touching)
      self%contact(k) = other%contact(k_other)
      self%evaluated_at = 0
      call self%stick_slip%adopt(k, other%stick_slip, k_other)
   end subroutine states_adopt

   !> Contacts touch where their surfaces overlap, whatever they did before: so a search of an equilibrium takes them.
   pure subroutine touch_where(self, delta)
      class(contact_states_t), intent(inout) :: self  !! the set
      real(wp), intent(in) :: delta(:)                !! (all contacts) penetrations [m]

      self%contact%is_touching = delta(self%before%contacts + 1:self%before%contacts + self%n_contact) > 0.0_wp
      self%n_touching = count(self%contact%is_touching)
      self%evaluated_at = 0
   end subroutine touch_where

   !> The contacts that touch in an equilibrium start there, at t = 0 and without a speed.
   subroutine begin_at_rest(self)
      class(contact_states_t), intent(inout) :: self  !! the set

      integer :: k

      self%n_touching = 0
      do k = 1, self%n_contact
         if (self%contact(k)%is_touching) call self%begin_contact(k, 0.0_wp, 0.0_wp, 0.0_wp)
      end do
   end subroutine begin_at_rest

   !> Raise the maximum penetration that a contact remembers.
   pure subroutine note_depth(self, k, delta, t)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: delta                   !! penetration that it had [m]
      real(wp), intent(in) :: t                       !! when [s]

      associate (contact => self%contact(k))
         if (delta <= contact%peak_penetration) return
         contact%peak_penetration = delta
         contact%went%penetration_at = t
      end associate
   end subroutine note_depth

   !> Raise the maximum force that a contact remembers.
   pure subroutine note_force(self, k, force, t)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: force                   !! normal force that it had [N]
      real(wp), intent(in) :: t                       !! when [s]

      associate (contact => self%contact(k))
         if (force <= contact%peak_force) return
         contact%peak_force = force
         contact%went%force_at = t
      end associate
   end subroutine note_force

   !> What a step made of a contact that touches: maximum penetration and force, and the impulse that it gave.
   pure subroutine note_step(self, k, delta, delta_at, force, force_at, impulse)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: delta                   !! maximum penetration of the step [m]
      real(wp), intent(in) :: delta_at                !! when [s]
      real(wp), intent(in) :: force                   !! maximum normal force of the step [N]
      real(wp), intent(in) :: force_at                !! when [s]
      real(wp), intent(in) :: impulse                 !! of the normal force over the step [N.s]

      call note_depth(self, k, delta, delta_at)
      call note_force(self, k, force, force_at)
      self%contact(k)%went%impulse = self%contact(k)%went%impulse + impulse
   end subroutine note_step

   !> A contact crosses the end of the transition from a film, one way or the other.
   pure subroutine cross_transition(self, k)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set

      self%contact(k)%is_dry = .not. self%contact(k)%is_dry
   end subroutine cross_transition

   !> A contact continues in another course: it approaches, parts, or rests.
   pure subroutine set_course(self, k, course, rest_speed)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      integer, intent(in) :: course                   !! approaches, parts or rests
      real(wp), intent(in), optional :: rest_speed    !! maximum rate of one that rests [m/s]

      self%contact(k)%course = course
      self%evaluated_at = 0
      if (present(rest_speed)) self%contact(k)%rest_speed = rest_speed
   end subroutine set_course

   !> It is to be decided anew whether a contact slides.
   pure subroutine open_decision(self, k, slip)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      integer, intent(in) :: slip                     !! what it does until then

      self%stick_slip%was(k) = merge(gives_way, self%stick_slip%slip(k), slip == gives_way)
      self%stick_slip%slip(k) = slip
   end subroutine open_decision

   !> It is decided that a contact slides this way or sticks.
   pure subroutine slip_as(self, k, slip)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      integer, intent(in) :: slip                     !! sign of its sliding velocity, 0: it sticks

      self%stick_slip%slip(k) = slip
   end subroutine slip_as

   !> It is decided that a contact slides along a vector of its tangents, as it lies.
   pure subroutine slip_toward(self, k, direction)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: direction(2)            !! (2) along its tangents, of any length; in the plane the sign counts [any]

      real(wp) :: way(3)

      if (self%stick_slip%n_tangent == 1) then
         self%stick_slip%slip(k) = nint(sign(1.0_wp, direction(1)))
         return
      end if
      self%stick_slip%slip(k) = 1
      way = matmul(self%stick_slip%tangent(k)%t, direction)
      if (.not. any(abs(way) > 0.0_wp)) return
      way = way/maxval(abs(way))  ! squares of small numbers are zero
      self%stick_slip%tangent(k)%slip_direction = way/norm2(way)
   end subroutine slip_toward

   !> When it was decided, and the speed the wrong way at which its slip is to end next.
   pure subroutine note_decision(self, k, t, band, still, slow)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: band                    !! speed against the slip at which it ends [m/s]
      real(wp), intent(in) :: still                   !! speed that is next to none [m/s]
      real(wp), intent(in) :: slow                    !! the same until it has been exceeded [m/s]

      self%stick_slip%since(k) = t
      self%stick_slip%band(k) = band
      self%stick_slip%still(k) = still
      self%stick_slip%slow(k) = slow
   end subroutine note_decision

   !> The friction force of a contact that sticks is not unique at a time.
   pure subroutine note_shared(self, k, t)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: t                       !! time [s]

      self%stick_slip%shared_from(k) = min(self%stick_slip%shared_from(k), t)
   end subroutine note_shared

   !> Friction of a contact that sticks, as found with the accelerations.
   pure subroutine stick_with(self, k, force, is_driven)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                        !! contact of the set
      real(wp), intent(in) :: force(2)                !! (2) on body j along its tangents [N]
      logical, intent(in) :: is_driven                !! drivers alone prescribe how it slides

      self%stick_slip%tangent(k)%f_t = force
      self%stick_slip%tangent(k)%is_driven = is_driven
   end subroutine stick_with

   !> Where the deflections of the bristles are among those of all sets.
   pure subroutine place_bristles(self, first)
      class(contact_states_t), intent(inout) :: self  !! the set
      integer, intent(in) :: first                    !! deflections of earlier sets

      self%stick_slip%first_bristle = first
   end subroutine place_bristles

   !> Take the deflections of bristles from a state.
   pure subroutine bend_bristles(self, state)
      class(contact_states_t), intent(inout) :: self  !! the set, with friction that has bristles
      real(wp), intent(in) :: state(:)                !! (n_component n_contact) the entries of the state [m]

      self%stick_slip%z = reshape(state, shape(self%stick_slip%z)) - self%stick_slip%origin
   end subroutine bend_bristles

   !> Write what the set remembers.
   subroutine states_save(self, archive)
      class(contact_states_t), intent(in) :: self  !! the set
      type(archive_t), intent(inout) :: archive    !! the checkpoint

      integer :: k

      do k = 1, self%n_contact
         call self%contact(k)%save(archive)
      end do
      call self%stick_slip%save(archive)
   end subroutine states_save

   !> Read what the set remembers.
   subroutine states_load(self, archive)
      class(contact_states_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive       !! the checkpoint

      integer :: k

      do k = 1, self%n_contact
         call self%contact(k)%load(archive)
      end do
      self%n_touching = count(self%contact%is_touching)
      call self%stick_slip%load(archive)
   end subroutine states_load

end module contact_states
