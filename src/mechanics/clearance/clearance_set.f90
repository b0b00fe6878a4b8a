!> The contract of joints with clearance: all items that share a geometry, a normal law and a friction law.
!>
!> Body i carries the bearing, guide or plane, body j the journal, slider or ball. Contacts and what they remember: see
!> `contact_states`. The force of a contact acts between its onset and its end, on both bodies with action equal to reaction; the
!> power that damping and friction take is given to the energy ledger, contact by contact. Where the normal law has a force between
!> surfaces that are apart (`acts_apart`, as a film has), a contact that is free acts too, wherever that force is positive; onset
!> and end are still where the surfaces meet, and friction is that of surfaces which touch.
module clearance_set
   use bodies, only: material_t, points_t
   use clearance_parts, only: clearance_items_t, clearance_laws_t, clearance_traits_t
   use contact_stick_slip, only: new_stick_slip, tangent_t
   use contact_states, only: contact_states_t
   use floors, only: gentle
   use friction_law, only: friction_law_t, memory_slip
   use item, only: item_t
   use joint_set, only: joint_set_t
   use kind_info, only: in_space, kind_info_t
   use kinds, only: not_a_number, pi, wp
   use motion, only: loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use readings, only: readings_t
   use surfaces, only: surfaces_t
   use wear_contact, only: wear_contact_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_fit, clearance_note_contact_rate, clearance_set_t, clearance_slot_t, loss_contact, loss_friction, &
      n_integrand, normal_impulse

   ! what is integrated of a contact
   integer, parameter :: loss_contact = 1    !! power taken by contact damping
   integer, parameter :: loss_friction = 2   !! power taken by friction
   integer, parameter :: normal_impulse = 3  !! normal force
   integer, parameter :: n_integrand = 3     !! how many these are

   !> All items that share a geometry and its laws.
   type, abstract, extends(contact_states_t) :: clearance_set_t
      type(clearance_traits_t) :: traits   !! what the geometry is like
      type(clearance_items_t) :: items     !! where the items are, and their surfaces
      type(clearance_laws_t) :: laws       !! laws of all items
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure, nopass :: ideal_kind => no_ideal_kind
      procedure(prepare_interface), deferred :: prepare
      procedure, nopass :: mistake => no_mistake
      procedure(describe_interface), nopass, deferred :: describe
      procedure(evaluate_interface), deferred :: evaluate
      procedure(gaps_interface), deferred :: gaps
      procedure(monitor_interface), deferred :: monitor
      procedure(lie_interface), deferred :: lie
      procedure(report_interface), deferred :: report
      procedure(energy_interface), deferred :: elastic_energy
      procedure :: new => clearance_new
      procedure :: take_joint => clearance_take_joint
      procedure :: set_start => clearance_set_start
      procedure :: span_of => clearance_span_of
      procedure, non_overridable :: take_surfaces => clearance_take_surfaces
      procedure :: fit => clearance_fit
      procedure :: note_contact_rate => clearance_note_contact_rate
      procedure :: lay => clearance_lay
      procedure :: follow_sliding => clearance_follow_sliding
      procedure :: contact_time => clearance_contact_time
      procedure :: load_on_j => clearance_load_on_j
      procedure :: wear_rates => clearance_wear_rates
      procedure :: wear_at => clearance_wear_at
   end type clearance_set_t

   !> A place for a set of any geometry.
   type :: clearance_slot_t
      class(clearance_set_t), allocatable :: set  !! the set
   end type clearance_slot_t

   abstract interface
      !> Description of the geometry.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name, columns and channels (those of the contacts too)
      end function info_interface

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

      !> Add the forces of the contacts that act, and set what is integrated of them. No allocation.
      subroutine evaluate_interface(self, motion, loads, integrands)
         import :: clearance_set_t, loads_t, motion_t, n_integrand, wp
         implicit none (type, external)
         class(clearance_set_t), intent(inout) :: self   !! the set
         type(motion_t), intent(in) :: motion            !! positions and velocities
         type(loads_t), intent(inout) :: loads           !! loads on the bodies, added to
         real(wp), intent(inout) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) set: power lost, force [W and N]
      end subroutine evaluate_interface

      !> Penetration and its rate for all contacts, touching or not. No allocation.
      subroutine gaps_interface(self, motion, delta, rate)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion        !! positions and velocities
         real(wp), intent(inout), contiguous :: delta(:)  !! (all contacts) penetration, negative: apart [m]
         real(wp), intent(inout), contiguous :: rate(:)   !! (all contacts) its rate [m/s]
      end subroutine gaps_interface

      !> Normal force of a contact that acts and its rate, for the location of its maximum.
      subroutine monitor_interface(self, k, motion, delta, rate, force, force_rate)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         integer, intent(in) :: k                    !! contact of the set
         type(motion_t), intent(in) :: motion        !! positions, velocities and accelerations
         real(wp), intent(out) :: delta              !! penetration [m]
         real(wp), intent(out) :: rate               !! its rate [m/s]
         real(wp), intent(out) :: force              !! normal force [N]
         real(wp), intent(out) :: force_rate         !! its rate [N/s]
      end subroutine monitor_interface

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

      !> Values that are read, of all items, or of all contacts if a channel is one of theirs. No allocation.
      subroutine report_interface(self, readings, motion, values)
         import :: clearance_set_t, motion_t, readings_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         type(readings_t), intent(in) :: readings    !! channels that are read, as `info` numbers them
         type(motion_t), intent(in) :: motion        !! positions and velocities
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine report_interface

      !> Elastic energy that the contacts store which act.
      function energy_interface(self, motion) result(energy)
         import :: clearance_set_t, motion_t, wp
         implicit none (type, external)
         class(clearance_set_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion        !! positions
         real(wp) :: energy                          !! energy stored [J]
      end function energy_interface
   end interface

contains

   !> Force of all contacts of an item on its body j, and their moment about its centre of mass. None is known here. No allocation.
   subroutine clearance_load_on_j(self, item, motion, force, moment)
      class(clearance_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                 !! the item
      type(motion_t), intent(in) :: motion        !! positions and velocities
      real(wp), intent(out) :: force(3)           !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)          !! (3) world frame [N.m]

      force = not_a_number()
      moment = force + 0.0_wp*(item + self%n + size(motion%angle))
   end subroutine clearance_load_on_j

   !> Rates of the driving work of wear of all contacts, as of the last evaluation: none, unless the geometry says otherwise. No
   !> allocation.
   pure subroutine clearance_wear_rates(self, motion, integrands, rate)
      class(clearance_set_t), intent(in) :: self   !! the set, with a wear law, evaluated
      type(motion_t), intent(in) :: motion         !! positions and velocities of the evaluation
      real(wp), intent(in) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) power lost and normal force [W and N]
      real(wp), intent(out) :: rate(self%n_contact)                    !! (contacts) rates [W]

      rate = 0.0_wp
   end subroutine clearance_wear_rates

   !> What a contact does to its surfaces: nothing, unless the geometry says otherwise. No allocation.
   subroutine clearance_wear_at(self, k, motion, wear)
      class(clearance_set_t), intent(in) :: self   !! the set, with a wear law
      integer, intent(in) :: k                     !! contact of the set, which touches
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(wear_contact_t), intent(inout) :: wear  !! force, sliding and arc; here none

      wear%force = 0.0_wp
      wear%power = 0.0_wp
   end subroutine clearance_wear_at

   !> Set up the common part.
   subroutine clearance_new(self, items, bearing, journal, points, law, friction)
      class(clearance_set_t), intent(inout) :: self                   !! the set
      type(item_t), intent(in) :: items(:)                            !! (n) rows of the table
      integer, intent(in) :: bearing(:)                               !! (n) point at the bearing's centre
      integer, intent(in) :: journal(:)                               !! (n) point at the journal's centre
      type(points_t), intent(in) :: points                            !! all points
      class(normal_law_t), intent(in) :: law                          !! normal law
      class(friction_law_t), allocatable, intent(in) :: friction      !! friction law, unallocated: none

      type(kind_info_t) :: info
      type(text_t), allocatable :: labels(:)  ! gfortran does not free those of a result that nobody is given
      integer :: k

      self%n = size(items)
      labels = self%contact_labels()
      self%n_contact_item = size(labels)
      self%n_contact = self%n*self%n_contact_item
      allocate (self%names(self%n), self%items%body(2, self%n), self%items%s_i(3, self%n), self%items%s_j(3, self%n))
      allocate (self%items%pairs(self%n), self%contact(self%n_contact))
      allocate (self%laws%parameters(n_law_parameter, self%n_contact), source=0.0_wp)
      allocate (self%laws%normal, source=law)
      if (allocated(friction)) then
         if (friction%is_active()) then
            allocate (self%laws%friction, source=friction)
            info = self%info()
            call new_stick_slip(self%n_contact, info%space == in_space, friction, self%stick_slip)
         end if
      end if
      do k = 1, self%n
         self%names(k)%s = items(k)%name
         self%items%body(1, k) = points%body(bearing(k))
         self%items%body(2, k) = points%body(journal(k))
         self%items%s_i(:, k) = points%s(:, bearing(k))
         self%items%s_j(:, k) = points%s(:, journal(k))
      end do
   end subroutine clearance_new

   !> Take what an item needs of the joint that its row names: nothing, unless the geometry says otherwise.
   subroutine clearance_take_joint(self, k, joint)
      class(clearance_set_t), intent(inout) :: self  !! the set, prepared
      integer, intent(in) :: k                       !! item
      class(joint_set_t), intent(in) :: joint        !! a set of one item, the joint, with its start
   end subroutine clearance_take_joint

   !> Take what the deck omits from where it puts the bodies at the start: nothing, unless the geometry says otherwise.
   subroutine clearance_set_start(self, motion)
      class(clearance_set_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion           !! bodies where the deck puts them
   end subroutine clearance_set_start

   !> How far what takes part in a contact is from the centres of mass of both bodies, for bounds of round-off; the clearance and
   !> lengths like it count too.
   pure function clearance_span_of(self, contact) result(span)
      class(clearance_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: contact              !! contact of the set
      real(wp) :: span(2)                         !! (2) in bodies i and j [m]

      associate (item => self%item_of(contact))
         span = [sum(abs(self%items%s_i(:, item))), sum(abs(self%items%s_j(:, item))) + self%items%pairs(item)%clearance]
      end associate
   end function clearance_span_of

   !> The joint that the geometry is without clearance, whose first columns are those of the geometry: none, unless the geometry
   !> says otherwise. Where there is none, there is no column `level`.
   function no_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! blank

      kind = ""
   end function no_ideal_kind

   !> What is wrong with a row as a whole: nothing, unless the geometry says otherwise.
   subroutine no_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! 0: all is well
      character(:), allocatable, intent(out) :: message      !! blank
      character(:), allocatable, intent(out) :: help         !! blank

      column = 0
      message = repeat("", len(item%name))
      help = ""
   end subroutine no_mistake

   !> Take the surfaces of the rows. A body that drivers move cannot be pushed; between two of them the masses of the deck are all
   !> there is.
   subroutine clearance_take_surfaces(self, items, materials, mass, is_driven)
      class(clearance_set_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      type(material_t), intent(in) :: materials(:)   !! (materials) all materials
      real(wp), intent(in) :: mass(:)                !! (bodies) masses of the bodies [kg]
      logical, intent(in) :: is_driven(:)            !! (bodies) whether drivers alone say how they move

      integer, allocatable :: bodies(:)
      integer :: k

      do k = 1, self%n
         call self%describe(items(k), materials, self%items%pairs(k))
         bodies = pack(self%items%body(:, k), self%items%body(:, k) > 0)
         if (.not. all(is_driven(bodies))) bodies = pack(bodies, .not. is_driven(bodies))
         self%items%pairs(k)%inverse_mass = sum(1.0_wp/mass(bodies))
      end do
   end subroutine clearance_take_surfaces

   !> Fit normal law and film of an item to its surfaces, at the start and after any change of them. A law that does not match was
   !> an error of the deck, unless the joint is an ideal one that has a clearance for its channels only: no contact is evaluated
   !> then.
   subroutine clearance_fit(self, k)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! the item

      character(:), allocatable :: help, message
      real(wp) :: parameters(n_law_parameter)
      integer :: c

      associate (pair => self%items%pairs(k))
         call self%laws%normal%fit(pair, parameters, message, help)
         parameters(parameter_gentle) = gentle**2*pair%inverse_mass
         do c = (k - 1)*self%n_contact_item + 1, k*self%n_contact_item
            self%laws%parameters(:, c) = parameters
         end do
         if (allocated(self%laws%films)) call self%laws%films%fit(k, pair)
      end associate
   end subroutine clearance_fit

   !> How fast a contact that has started swings: as an impact with its speed, or as one that gets as deep as it is, which one that
   !> starts overlapping is without any speed. 0 if that is not known. And whether it starts beyond the transition of a film.
   pure subroutine clearance_note_contact_rate(self, k, delta)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! contact of the set
      real(wp), intent(in) :: delta                  !! its penetration [m]

      real(wp) :: speed, time
      integer :: item

      item = self%item_of(k)
      associate (inverse_mass => self%items%pairs(item)%inverse_mass)
         ! a law of expressions may attract: no speed has the energy of that
         speed = sqrt(2.0_wp*inverse_mass*max(0.0_wp, self%laws%normal%potential(max(delta, 0.0_wp), self%laws%parameters(:, k))))
         time = self%laws%normal%contact_time(self%laws%parameters(:, k), max(speed, self%contact(k)%impact_speed), inverse_mass)
      end associate
      if (time > 0.0_wp) self%contact(k)%contact_rate = pi/time
      self%evaluated_at = 0
      if (allocated(self%laws%films)) then
         if (self%laws%films%fades()) self%contact(k)%is_dry = delta > self%laws%films%place(item)%depth
      end if
   end subroutine clearance_note_contact_rate

   !> Keep how a contact lies at a motion, for its friction, which remembers; its forces are left alone.
   subroutine clearance_lay(self, k, motion)
      class(clearance_set_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                       !! contact of the set
      type(motion_t), intent(in) :: motion           !! positions and velocities

      type(tangent_t) :: tangent

      tangent = self%stick_slip%tangent(k)
      call self%lie(k, motion, tangent)
      self%stick_slip%tangent(k) = tangent
   end subroutine clearance_lay

   !> Let the ways of contacts in space that may stick follow their sliding, at the end of a step. One that is next to none along
   !> its way, or against it, says nothing of a way: turned by what is left over, step by step, no slip would end.
   subroutine clearance_follow_sliding(self, motion)
      class(clearance_set_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion           !! positions and velocities

      integer :: k

      if (self%stick_slip%memory /= memory_slip .or. self%stick_slip%n_tangent == 1 .or. self%n_touching == 0) return
      do k = 1, self%n_contact
         if (.not. self%contact(k)%is_touching) cycle
         call self%lay(k, motion)
         associate (tangent => self%stick_slip%tangent(k))
            tangent%slip_direction = tangent%t(:, 1)
            if (self%stick_slip%slip(k) /= 1 .or. tangent%v(1) < max(self%stick_slip%still(k), self%stick_slip%slow(k))) cycle
            call self%slip_toward(k, tangent%v)
            self%stick_slip%band(k) = 0.0_wp
            self%stick_slip%slow(k) = 0.0_wp
         end associate
      end do
   end subroutine clearance_follow_sliding

   !> Duration of an elastic impact of the two bodies, if they were free.
   pure real(wp) function clearance_contact_time(self, k, speed, inverse_mass) result(time)
      class(clearance_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                    !! contact of the set
      real(wp), intent(in) :: speed               !! impact speed [m/s]
      real(wp), intent(in) :: inverse_mass(0:)    !! (0:bodies) one over the mass, 0 for the ground [1/kg]

      integer :: item

      item = self%item_of(k)
      time = self%laws%normal%contact_time(self%laws%parameters(:, k), speed, &
                                   inverse_mass(self%items%body(1, item)) + inverse_mass(self%items%body(2, item)))
   end function clearance_contact_time

end module clearance_set
