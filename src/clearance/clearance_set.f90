!> The contract of joints with clearance: all items that share a geometry, a normal law and a friction law.
!>
!> Body i carries the bearing, guide or plane, body j the journal, slider or ball. An item has one contact or several, as
!> many as its geometry has labels: contact m is number (m - 1) mod n_contact_item + 1 of its item. A contact is free or
!> touching; it changes only at located events: the impact speed is stored at the onset and the force acts between onset
!> and end. Forces act on both bodies with action equal to reaction; the power that damping and friction take is given to
!> the energy ledger, contact by contact.
module clearance_set
   use bodies, only: material_t, points_t
   use catalogue, only: state_contact, state_free, state_name
   use contact_grip, only: grip_t, n_grip_memory, new_grip, slip_force, tangent_t
   use contact_memory, only: contact_memory_t, n_contact_memory, rests
   use floors, only: gentle
   use friction_law, only: friction_law_t, memory_none
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: not_a_number, pi, wp
   use motion, only: loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use recorder, only: event_t
   use surfaces, only: surfaces_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_fit_law, clearance_set_t, clearance_slot_t, loss_contact, loss_friction
   public :: no_ideal_kind, no_mistake

   integer, parameter :: loss_contact = 1   !! power taken by contact damping
   integer, parameter :: loss_friction = 2  !! power taken by friction

   !> All items that share a geometry and its laws.
   type, abstract :: clearance_set_t
      integer :: n = 0                                      !! number of items
      integer :: n_contact_item = 1                         !! contacts of an item
      integer :: n_contact = 0                              !! contacts of all items
      integer :: n_touching = 0                             !! number of contacts that touch
      integer :: first = 0                                  !! items of earlier sets
      integer :: first_contact = 0                          !! contacts of earlier sets
      logical :: is_round = .false.                         !! the clearance is a radial one
      logical :: has_faces = .false.                        !! contacts of an item share a face, and what it stores
      logical :: energy_jumps = .false.                     !! stored energy and forces may jump where a contact begins or ends
      type(text_t), allocatable :: names(:)                 !! (n) names
      type(text_t), allocatable :: labels(:)                !! (n_contact_item) names of the contacts of an item
      integer, allocatable :: body(:, :)                    !! (2, n) bodies of bearing and journal, 0: ground
      real(wp), allocatable :: s_i(:, :)                    !! (3, n) centre of the bearing, frame of its body [m]
      real(wp), allocatable :: s_j(:, :)                    !! (3, n) centre of the journal, frame of its body [m]
      real(wp), allocatable :: clearance(:)                 !! (n) clearance [m]
      integer, allocatable :: leaves(:)                     !! (n) of items tied by a joint: what that leaves, see `kind_info`
      real(wp), allocatable :: way(:, :)                    !! (2, n) and the axis of one that leaves a way, frame of i [1]
      type(surfaces_t), allocatable :: pairs(:)             !! (n) the surfaces
      real(wp), allocatable :: parameters(:, :)             !! (n_law_parameter, n_contact) of the normal law, fitted to them [any]
      class(normal_law_t), allocatable :: law               !! normal law of all items
      class(normal_law_t), allocatable :: face_law          !! normal law of faces, where the geometry has some; unallocated: none
      class(friction_law_t), allocatable :: friction        !! friction law of all items; unallocated: none
      type(contact_memory_t), allocatable :: contact(:)     !! (n_contact) state of the contacts
      type(grip_t) :: grip                                  !! what the contacts remember of their friction
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure, nopass :: contact_labels => clearance_contact_labels
      procedure(ideal_interface), nopass, deferred :: ideal_kind
      procedure(prepare_interface), deferred :: prepare
      procedure(mistake_interface), nopass, deferred :: mistake
      procedure(describe_interface), nopass, deferred :: describe
      procedure(evaluate_interface), deferred :: evaluate
      procedure(gaps_interface), deferred :: gaps
      procedure(watch_interface), deferred :: watch
      procedure(lie_interface), deferred :: lie
      procedure(report_interface), deferred :: report
      procedure(energy_interface), deferred :: elastic_energy
      procedure :: new => clearance_new
      procedure :: item_of => clearance_item_of
      procedure :: span_of => clearance_span_of
      procedure :: press => clearance_press
      procedure :: rub => clearance_rub
      procedure :: fit_law => clearance_fit_law
      procedure :: begin_contact => clearance_begin_contact
      procedure :: note_swing => clearance_note_swing
      procedure :: adopt => clearance_adopt
      procedure :: end_contact => clearance_end_contact
      procedure :: contact_time => clearance_contact_time
      procedure :: memory_size => clearance_memory_size
      procedure :: save => clearance_save
      procedure :: load => clearance_load
   end type clearance_set_t

   !> A place for a set of any geometry.
   type :: clearance_slot_t
      class(clearance_set_t), allocatable :: set  !! the set
   end type clearance_slot_t

   abstract interface
      !> What the geometry says of itself.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name, columns and channels (those of the contacts too)
      end function info_interface

      !> The joint that the geometry is without clearance: its first columns are those of the geometry.
      function ideal_interface() result(kind)
         implicit none (type, external)
         character(:), allocatable :: kind  !! name of the kind of joint; blank: there is none, and no column `level`
      end function ideal_interface

      !> Take the geometry's own parameters, the clearance among them. Names, bodies, points and laws are set already.
      subroutine prepare_interface(self, items)
         import :: clearance_set_t, item_t
         implicit none (type, external)
         class(clearance_set_t), intent(inout) :: self  !! the set
         type(item_t), intent(in) :: items(:)           !! (n) rows of the table, references resolved
      end subroutine prepare_interface

      !> The surfaces of a row, but for the masses of the bodies.
      pure subroutine describe_interface(item, materials, pair)
         import :: item_t, material_t, surfaces_t
         implicit none (type, external)
         type(item_t), intent(in) :: item              !! the row, references resolved
         type(material_t), intent(in) :: materials(:)  !! (materials) all materials
         type(surfaces_t), intent(out) :: pair         !! its surfaces
      end subroutine describe_interface

      !> What is wrong with a row as a whole.
      subroutine mistake_interface(item, column, message, help)
         import :: item_t
         implicit none (type, external)
         type(item_t), intent(in) :: item                       !! the row
         integer, intent(out) :: column                         !! column at fault, 0: all is well
         character(:), allocatable, intent(out) :: message      !! what is wrong
         character(:), allocatable, intent(out) :: help         !! what would be right
      end subroutine mistake_interface

      !> Add the contact forces of the touching contacts, and the power they lose. No allocation.
      subroutine evaluate_interface(self, motion, loads, losses)
         import :: clearance_set_t, loads_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(inout) :: self   !! the set
         type(motion_t), intent(in) :: motion            !! positions and velocities
         type(loads_t), intent(inout) :: loads           !! loads on the bodies, added to
         real(wp), intent(inout), contiguous :: losses(:, :)  !! (2, all contacts) power lost by damping and friction, set here [W]
      end subroutine evaluate_interface

      !> Penetration and its rate for all contacts, touching or not. No allocation.
      subroutine gaps_interface(self, motion, delta, rate)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion        !! positions and velocities
         real(wp), intent(inout) :: delta(:)         !! (all contacts) penetration, negative: apart [m]
         real(wp), intent(inout) :: rate(:)          !! (all contacts) its rate [m/s]
      end subroutine gaps_interface

      !> Normal force of a touching contact and its rate, for the location of its maximum.
      subroutine watch_interface(self, k, motion, delta, rate, force, force_rate)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         integer, intent(in) :: k                    !! contact of the set
         type(motion_t), intent(in) :: motion        !! positions, velocities and accelerations
         real(wp), intent(out) :: delta              !! penetration [m]
         real(wp), intent(out) :: rate               !! its rate [m/s]
         real(wp), intent(out) :: force              !! normal force [N]
         real(wp), intent(out) :: force_rate         !! its rate [N/s]
      end subroutine watch_interface

      !> How a contact lies, whether it touches or not: tangent, arms, sliding velocity of the material points and the part of
      !> its rate that does not depend on accelerations. Forces are left alone. No allocation.
      subroutine lie_interface(self, k, motion, tangent)
         import :: clearance_set_t, motion_t, tangent_t
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         integer, intent(in) :: k                    !! contact of the set
         type(motion_t), intent(in) :: motion        !! positions and velocities
         type(tangent_t), intent(inout) :: tangent   !! how it lies
      end subroutine lie_interface

      !> Values of a channel for all items, or for all contacts if it is one of theirs.
      subroutine report_interface(self, channel, motion, values)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         character(*), intent(in) :: channel         !! name of the channel
         type(motion_t), intent(in) :: motion        !! positions and velocities
         real(wp), intent(inout) :: values(:, :)     !! (components, all items or contacts) values; others are left alone [any]
      end subroutine report_interface

      !> Elastic energy that the touching contacts store.
      function energy_interface(self, motion) result(energy)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion        !! positions
         real(wp) :: energy                          !! energy stored [J]
      end function energy_interface
   end interface

contains

   !> Set up the common part.
   subroutine clearance_new(self, items, bearing, journal, points, law, friction)
      class(clearance_set_t), intent(inout) :: self                   !! the set
      type(item_t), intent(in) :: items(:)                            !! (n) rows of the table
      integer, intent(in) :: bearing(:)                               !! (n) point at the bearing's centre
      integer, intent(in) :: journal(:)                               !! (n) point at the journal's centre
      type(points_t), intent(in) :: points                            !! all points
      class(normal_law_t), intent(in) :: law                          !! normal law
      class(friction_law_t), allocatable, intent(in) :: friction      !! friction law, unallocated: none

      integer :: k

      self%n = size(items)
      self%labels = self%contact_labels()
      self%n_contact_item = size(self%labels)
      self%n_contact = self%n*self%n_contact_item
      allocate (self%names(self%n), self%body(2, self%n), self%s_i(3, self%n), self%s_j(3, self%n))
      allocate (self%clearance(self%n), self%parameters(n_law_parameter, self%n_contact), source=0.0_wp)
      allocate (self%pairs(self%n))
      allocate (self%contact(self%n_contact))
      allocate (self%law, source=law)
      if (allocated(friction)) then
         if (friction%is_active()) allocate (self%friction, source=friction)
         if (friction%is_active()) call new_grip(self%n_contact, friction, self%grip)
      end if
      do k = 1, self%n
         self%names(k)%s = items(k)%name
         self%body(1, k) = points%body(bearing(k))
         self%body(2, k) = points%body(journal(k))
         self%s_i(:, k) = points%s(:, bearing(k))
         self%s_j(:, k) = points%s(:, journal(k))
      end do
   end subroutine clearance_new

   !> One contact per item, without a name of its own; a geometry with several overrides this.
   function clearance_contact_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (contacts of an item) names

      allocate (labels(1))
      labels(1)%s = ""
   end function clearance_contact_labels

   !> The item that a contact belongs to.
   pure integer function clearance_item_of(self, contact) result(item)
      class(clearance_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact              !! contact of the set

      item = (contact - 1)/self%n_contact_item + 1
   end function clearance_item_of

   !> How far what takes part in a contact is from the centres of mass of both bodies, for bounds of round-off; the clearance and
   !> lengths like it count too.
   pure function clearance_span_of(self, contact) result(span)
      class(clearance_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact              !! contact of the set
      real(wp) :: span(2)                         !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%s_i(:, item))), sum(abs(self%s_j(:, item))) + self%clearance(item)]
      end associate
   end function clearance_span_of

   !> Normal forces of some contacts. A law whose force jumps from F_a to F_p where the penetration turns follows the course of the
   !> contact, which changes at located events only; one that rests has (F_a + F_p)/2 + (F_a - F_p)/2 rate/rest_speed.
   pure subroutine clearance_press(self, first, last, delta, rate, impact_speed, f, df_ddelta, df_drate, f_elastic)
      class(clearance_set_t), intent(in) :: self             !! the set
      integer, intent(in) :: first                           !! first contact
      integer, intent(in) :: last                            !! last contact
      real(wp), intent(in) :: delta(first:last)              !! (first:last) penetration [m]
      real(wp), intent(in) :: rate(first:last)               !! (first:last) its rate [m/s]
      real(wp), intent(in) :: impact_speed(first:last)       !! (first:last) impact speed [m/s]
      real(wp), intent(out) :: f(first:last)                 !! (first:last) normal force [N]
      real(wp), intent(out) :: df_ddelta(first:last)         !! (first:last) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(first:last)          !! (first:last) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(first:last)         !! (first:last) its elastic part [N]

      if (self%law%jumps_at_turn) then
         call press_in_course(self, first, last, delta, rate, impact_speed, f, df_ddelta, df_drate, f_elastic)
      else
         call self%law%force(last - first + 1, delta, rate, impact_speed, self%parameters(:, first:last), f, df_ddelta, &
                             df_drate, f_elastic)
      end if
   end subroutine clearance_press

   !> The same with a law whose force jumps where the penetration turns.
   pure subroutine press_in_course(self, first, last, delta, rate, impact_speed, f, df_ddelta, df_drate, f_elastic)
      class(clearance_set_t), intent(in) :: self             !! the set
      integer, intent(in) :: first                           !! first contact
      integer, intent(in) :: last                            !! last contact
      real(wp), intent(in) :: delta(first:last)              !! (first:last) penetration [m]
      real(wp), intent(in) :: rate(first:last)               !! (first:last) its rate [m/s]
      real(wp), intent(in) :: impact_speed(first:last)       !! (first:last) impact speed [m/s]
      real(wp), intent(out) :: f(first:last)                 !! (first:last) normal force [N]
      real(wp), intent(out) :: df_ddelta(first:last)         !! (first:last) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(first:last)          !! (first:last) its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_elastic(first:last)         !! (first:last) its elastic part [N]

      real(wp), dimension(first:last) :: parting, parting_ddelta, parting_drate, speed, weight

      speed = max(abs(rate), tiny(1.0_wp))
      call self%law%force(last - first + 1, delta, -speed, impact_speed, self%parameters(:, first:last), parting, parting_ddelta, &
                          parting_drate, f_elastic)
      call self%law%force(last - first + 1, delta, speed, impact_speed, self%parameters(:, first:last), f, df_ddelta, df_drate, &
                          f_elastic)
      associate (contact => self%contact(first:last))
         weight = 0.5_wp*real(1 + contact%course, wp)
         where (contact%course == rests) weight = 0.5_wp + 0.5_wp*rate/contact%rest_speed
         df_drate = weight*df_drate + (1.0_wp - weight)*parting_drate
         where (contact%course == rests) df_drate = df_drate + 0.5_wp*(f - parting)/contact%rest_speed
      end associate
      f = weight*f + (1.0_wp - weight)*parting
      df_ddelta = weight*df_ddelta + (1.0_wp - weight)*parting_ddelta
   end subroutine press_in_course

   !> Friction of the touching contacts by a law with a memory, and the power that it takes.
   subroutine clearance_rub(self, motion, f_n, f_t, losses)
      class(clearance_set_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion           !! positions and velocities
      real(wp), intent(in) :: f_n(:)                 !! (n_contact) normal forces [N]
      real(wp), intent(out) :: f_t(:)                !! (n_contact) friction force on body j along t = R90 n [N]
      real(wp), intent(inout) :: losses(:, :)        !! (2, all contacts) power lost by damping and friction [W]

      integer :: k

      do k = 1, self%n_contact
         f_t(k) = 0.0_wp
         if (.not. self%contact(k)%is_touching) cycle
         call self%lie(k, motion, self%grip%tangent(k))
         self%grip%tangent(k)%f_n = f_n(k)
         call slip_force(self%grip, self%friction, k)
         f_t(k) = self%grip%tangent(k)%f_t
         losses(loss_friction, self%first_contact + k) = -f_t(k)*self%grip%tangent(k)%v
      end do
   end subroutine clearance_rub

   !> Of geometries that hold nothing together: no ideal joint.
   function no_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! blank

      kind = ""
   end function no_ideal_kind

   !> Of geometries of which any row makes sense.
   subroutine no_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! 0: all is well
      character(:), allocatable, intent(out) :: message      !! blank
      character(:), allocatable, intent(out) :: help         !! blank

      column = 0
      message = repeat("", len(item%name))
      help = ""
   end subroutine no_mistake

   !> Fit the normal law to the surfaces. A law that does not fit was a mistake of the deck, unless the joint is an ideal
   !> one that is taken as loose for its channels only: no contact is evaluated then. A body that drivers move cannot be pushed;
   !> between two of them the masses of the deck are all there is.
   subroutine clearance_fit_law(self, items, materials, mass, is_driven)
      class(clearance_set_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      type(material_t), intent(in) :: materials(:)   !! (materials) all materials
      real(wp), intent(in) :: mass(:)                !! (bodies) masses of the bodies [kg]
      logical, intent(in) :: is_driven(:)            !! (bodies) whether drivers alone say how they move

      character(:), allocatable :: help, message
      real(wp) :: parameters(n_law_parameter)
      integer, allocatable :: bodies(:)
      integer :: c, k

      do k = 1, self%n
         call self%describe(items(k), materials, self%pairs(k))
         bodies = pack(self%body(:, k), self%body(:, k) > 0)
         if (.not. all(is_driven(bodies))) bodies = pack(bodies, .not. is_driven(bodies))
         self%pairs(k)%inverse_mass = sum(1.0_wp/mass(bodies))
         call self%law%fit(self%pairs(k), parameters, message, help)
         parameters(parameter_gentle) = gentle**2*self%pairs(k)%inverse_mass
         do c = (k - 1)*self%n_contact_item + 1, k*self%n_contact_item
            self%parameters(:, c) = parameters
         end do
      end do
   end subroutine clearance_fit_law

   !> A contact begins: store its impact speed.
   subroutine clearance_begin_contact(self, k, t, impact_speed, loss)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! contact of the set
      real(wp), intent(in) :: t                      !! time of the onset [s]
      real(wp), intent(in) :: impact_speed           !! penetration rate at the onset [m/s]
      real(wp), intent(in) :: loss                   !! what the ledger has lost in the contact by now [J]

      self%contact(k) = contact_memory_t(is_touching=.true., onset=t, impact_speed=impact_speed, loss_at_onset=loss)
      self%n_touching = self%n_touching + 1
      call self%grip%forget(k)
   end subroutine clearance_begin_contact

   !> How fast a contact that has begun swings: as an impact with its speed, or as one that gets as deep as it is, which one that
   !> begins overlapping is without any speed. 0 if that is not known.
   pure subroutine clearance_note_swing(self, k, delta)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! contact of the set
      real(wp), intent(in) :: delta                  !! its penetration [m]

      real(wp) :: speed, time
      integer :: item

      item = self%item_of(k)
      associate (inverse_mass => self%pairs(item)%inverse_mass)
         speed = sqrt(2.0_wp*inverse_mass*self%law%potential(max(delta, 0.0_wp), self%parameters(:, k)))
         time = self%law%contact_time(self%parameters(:, k), max(speed, self%contact(k)%impact_speed), inverse_mass)
      end associate
      if (time > 0.0_wp) self%contact(k)%swing = pi/time
   end subroutine clearance_note_swing

   !> Take over what a contact of another set of the same laws remembers; deflections of bristles are in the state.
   subroutine clearance_adopt(self, k, other, k_other)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! contact of the set
      class(clearance_set_t), intent(in) :: other    !! the other set
      integer, intent(in) :: k_other                 !! contact of it

      self%n_touching = self%n_touching + merge(1, 0, other%contact(k_other)%is_touching) &
                        - merge(1, 0, self%contact(k)%is_touching)
      self%contact(k) = other%contact(k_other)
      call self%grip%adopt(k, other%grip, k_other)
   end subroutine clearance_adopt

   !> A contact ends, or the run ends within it: tell its story in one row.
   subroutine clearance_end_contact(self, k, t, release_speed, loss, is_over, event)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! contact of the set
      real(wp), intent(in) :: t                      !! time of the end [s]
      real(wp), intent(in) :: release_speed          !! separation speed [m/s]
      real(wp), intent(in) :: loss                   !! what the ledger has lost in the contact by now; NaN: no ledger [J]
      logical, intent(in) :: is_over                 !! .false.: the run ended within the contact
      type(event_t), intent(out) :: event            !! the row

      associate (contact => self%contact(k))
         event%time = contact%onset
         event%kind = "contact"
         event%item = self%names(self%item_of(k))%s
         event%contact = self%labels(modulo(k - 1, self%n_contact_item) + 1)%s
         event%impact_speed = contact%impact_speed
         event%peak_force = contact%peak_force
         event%peak_penetration = contact%peak_penetration
         event%energy_lost = loss - contact%loss_at_onset
         event%state_before = state_name(state_free)
         if (is_over) then
            event%duration = t - contact%onset
            event%release_speed = release_speed
            event%state_after = state_name(state_free)
            contact%is_touching = .false.
            self%n_touching = self%n_touching - 1
            call self%grip%forget(k)
         else
            event%duration = not_a_number()
            event%release_speed = not_a_number()
            event%state_after = state_name(state_contact)
         end if
      end associate
   end subroutine clearance_end_contact

   !> Duration of an elastic impact of the two bodies, if they were free.
   pure real(wp) function clearance_contact_time(self, k, speed, inverse_mass) result(time)
      class(clearance_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! contact of the set
      real(wp), intent(in) :: speed               !! impact speed [m/s]
      real(wp), intent(in) :: inverse_mass(0:)    !! (0:bodies) one over the mass, 0 for the ground [1/kg]

      integer :: item

      item = self%item_of(k)
      time = self%law%contact_time(self%parameters(:, k), speed, &
                                   inverse_mass(self%body(1, item)) + inverse_mass(self%body(2, item)))
   end function clearance_contact_time

   !> Numbers that the set must keep in a checkpoint.
   integer function clearance_memory_size(self) result(n)
      class(clearance_set_t), intent(in) :: self  !! the set

      n = n_contact_memory*self%n_contact
      if (self%grip%memory /= memory_none) n = n + n_grip_memory*self%n_contact
   end function clearance_memory_size

   !> Write what the set remembers.
   subroutine clearance_save(self, row, place)
      class(clearance_set_t), intent(in) :: self  !! the set
      real(wp), intent(inout) :: row(:)           !! (any) checkpoint [any]
      integer, intent(inout) :: place             !! last place used

      integer :: k

      do k = 1, self%n_contact
         call self%contact(k)%save(row, place)
      end do
      call self%grip%save(row, place)
   end subroutine clearance_save

   !> Read what the set remembers.
   subroutine clearance_load(self, row, place)
      class(clearance_set_t), intent(inout) :: self  !! the set
      real(wp), intent(in) :: row(:)                 !! (any) checkpoint [any]
      integer, intent(inout) :: place                !! last place used

      integer :: k

      do k = 1, self%n_contact
         call self%contact(k)%load(row, place)
      end do
      self%n_touching = count(self%contact%is_touching)
      call self%grip%load(row, place)
   end subroutine clearance_load

end module clearance_set
