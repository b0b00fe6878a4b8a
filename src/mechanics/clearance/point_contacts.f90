!> The one way of contacts at points: measure -> press -> rub -> loads and integrands, and what is asked of them beside that.
!>
!> A geometry measures: where its surfaces meet and how deep (`measure`), the second derivative of the penetration
!> (`penetration_acceleration`), how its contacts lie (`lie`). The rest is here:
!>
!> press   F_N of all contacts at once from the normal law
!> rub     F_T from F_N and the sliding velocity, by the friction law or by what the contact remembers (`contact_stick_slip`)
!> loads   f_j = -F_N n + F_T t on body j, -f_j on body i, both at C (`point_contact`); what damping and friction take:
!>         (F_N - F_elastic) delta', -F_T v_T
!> monitor   F_N and its rate, F' = dF/ddelta delta' + dF/drate delta''
!>
!> An evaluation is one virtual call, of text that each geometry includes (`point_way.inc`): what it measures is inlined there.
!> Source: Flores et al. (2008), sections 3.6 and 4.2 to 4.4. Limits: a contact is a point; contacts that share a face
!> (`has_faces`): see `faced_contacts`.
module point_contacts
   use clearance_set, only: clearance_set_t
   use contact_stick_slip, only: slip_force, tangent_t
   use contact_laws, only: friction_by_law
   use friction_law, only: memory_none
   use kind_info, only: add_channel, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use readings, only: readings_t
   use point_contact, only: contact_work_t, most_of_item, new_work, point_contact_t
   implicit none (type, external)
   private
   public :: add_contact_channels, point_contacts_t, point_elastic_energy, point_gaps, point_report, point_monitor
   public :: take_friction  ! for its submodule
   public :: named_channels
   public :: of_axial_displacement, of_contact_point, of_eccentricity, of_force, of_friction_force, of_moment, of_normal_force
   public :: of_penetration, of_penetration_rate, of_state, of_tilt

   ! channels
   integer, parameter :: of_force = 1             !! force on j
   integer, parameter :: of_penetration = 2       !! of a contact
   integer, parameter :: of_penetration_rate = 3  !! of a contact
   integer, parameter :: of_normal_force = 4      !! of a contact
   integer, parameter :: of_friction_force = 5    !! of a contact
   integer, parameter :: of_state = 6             !! of a contact
   integer, parameter :: of_eccentricity = 7      !! a geometry's own
   integer, parameter :: of_contact_point = 8     !! of a contact
   integer, parameter :: of_moment = 9            !! a geometry's own
   integer, parameter :: of_tilt = 41             !! a geometry's own
   integer, parameter :: of_axial_displacement = 42 !! a geometry's own
   integer, parameter :: of_contact_angle = 101   !! of a contact in the plane; these four only where they are named
   integer, parameter :: of_sliding_speed = 102   !! of a contact
   integer, parameter :: of_contact_power = 103   !! of a contact
   integer, parameter :: of_p_v = 104             !! of a contact

   character(*), parameter :: named_channels = " contact_angle sliding_speed contact_power p_v "
      !! channels of contacts that `*` does not stand for: they are reported where they are named

   !> Contacts at points, of any geometry. `prepare` of a geometry calls `make_storage`; `evaluate` is made of `point_way.inc`.
   type, abstract, extends(clearance_set_t) :: point_contacts_t
      type(contact_work_t) :: work   !! of one evaluation
   contains
      procedure, non_overridable :: make_storage
      procedure(measure_interface), deferred :: measure
      procedure(acceleration_interface), deferred :: penetration_acceleration
      procedure, non_overridable :: share_faces => point_share_faces
      procedure :: share_item => point_share_item
      procedure :: report_item => point_report_item
      procedure, non_overridable :: press => point_press
      procedure, non_overridable :: rub => point_friction
      procedure :: gaps => point_gaps
      procedure :: cut_at_ends => point_cut_at_ends
      procedure :: lever_growth => point_lever_growth
      procedure :: monitor => point_monitor
      procedure(point_force_interface), nopass, deferred :: force_on_j
      procedure :: report => point_report
      procedure :: load_on_j => point_load_on_j
      procedure :: elastic_energy => point_elastic_energy
   end type point_contacts_t

   abstract interface
      !> Normal, penetration, its rate and arms of a contact; its sliding velocity where it is asked for. No allocation.
      pure subroutine measure_interface(self, k, with_sliding, motion, contact)
         import :: motion_t, point_contact_t, point_contacts_t
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self      !! the set
         integer, intent(in) :: k                         !! contact
         logical, intent(in) :: with_sliding              !! its sliding velocity too
         type(motion_t), intent(in) :: motion             !! positions and velocities
         type(point_contact_t), intent(inout) :: contact  !! its kinematics
      end subroutine measure_interface

      !> Rate of the rate of a penetration.
      pure real(wp) function acceleration_interface(self, k, motion, contact) result(acceleration)
         import :: motion_t, point_contact_t, point_contacts_t, wp
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self    !! the set
         integer, intent(in) :: k                       !! contact
         type(motion_t), intent(in) :: motion           !! positions, velocities and accelerations
         type(point_contact_t), intent(in) :: contact   !! its kinematics
      end function acceleration_interface

      !> Force of a contact on body j.
      pure function point_force_interface(contact, f_n, f_t) result(f)
         import :: point_contact_t, wp
         implicit none (type, external)
         type(point_contact_t), intent(in) :: contact   !! its kinematics
         real(wp), intent(in) :: f_n                    !! normal force [N]
         real(wp), intent(in) :: f_t                    !! friction force on j along t [N]
         real(wp) :: f(3)                               !! (3) world frame [N]
      end function point_force_interface
   end interface

   interface
      !> Penetration and its rate for all contacts.
      module subroutine point_gaps(self, motion, delta, rate)
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion         !! positions and velocities
         real(wp), intent(inout), contiguous :: delta(:)  !! (all contacts) penetration [m]
         real(wp), intent(inout), contiguous :: rate(:)   !! (all contacts) its rate [m/s]
      end subroutine point_gaps

      !> Normal force of a touching contact and its rate, F' = dF/ddelta delta' + dF/drate delta''.
      module subroutine point_monitor(self, k, motion, delta, rate, force, force_rate)
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self  !! the set
         integer, intent(in) :: k                     !! contact
         type(motion_t), intent(in) :: motion         !! positions, velocities and accelerations
         real(wp), intent(out) :: delta               !! penetration [m]
         real(wp), intent(out) :: rate                !! its rate [m/s]
         real(wp), intent(out) :: force               !! normal force [N]
         real(wp), intent(out) :: force_rate          !! its rate [N/s]
      end subroutine point_monitor

      !> Values that are read: those of the contacts and the force on j here, others as the geometry has them. The contacts of an
      !> item are found once for all of them.
      module subroutine point_report(self, readings, motion, values)
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self  !! the set
         type(readings_t), intent(in) :: readings     !! channels that are read
         type(motion_t), intent(in) :: motion         !! positions and velocities
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine point_report

      !> Force of the contacts of an item on its body j, and their moment about its centre of mass.
      module subroutine point_load_on_j(self, item, motion, force, moment)
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self  !! the set
         integer, intent(in) :: item                  !! the item
         type(motion_t), intent(in) :: motion         !! positions and velocities
         real(wp), intent(out) :: force(3)            !! (3) world frame [N]
         real(wp), intent(out) :: moment(3)           !! (3) world frame [N.m]
      end subroutine point_load_on_j

      !> Elastic energy that the touching contacts store.
      module function point_elastic_energy(self, motion) result(energy)
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion         !! positions
         real(wp) :: energy                           !! energy stored [J]
      end function point_elastic_energy

      !> Normal forces of the contacts of an item, zero of those that are free.
      module subroutine point_press(self, item, contacts, f_n, f_elastic)
         implicit none (type, external)
         class(point_contacts_t), intent(in) :: self        !! the set
         integer, intent(in) :: item                        !! the item
         type(point_contact_t), intent(in) :: contacts(:)   !! (n_contact_item) penetrations and rates of its contacts
         real(wp), intent(out) :: f_n(:)                    !! (n_contact_item) normal forces, as the normal law gives them [N]
         real(wp), intent(out) :: f_elastic(:)              !! (n_contact_item) their elastic parts [N]
      end subroutine point_press
   end interface

contains

   !> The channels that every contact has.
   subroutine add_contact_channels(info, who, along)
      type(kind_info_t), intent(inout) :: info  !! the geometry
      character(*), intent(in) :: who           !! what has the friction force, as "slider"
      character(*), intent(in) :: along         !! what it is measured along

      call add_channel(info, "penetration", "m", "none", 1, "penetration of the surfaces, 0 without contact", of_penetration)
      call add_channel(info, "penetration_rate", "m/s", "none", 1, "penetration rate, positive when approaching", &
                       of_penetration_rate)
      call add_channel(info, "normal_force", "N", "none", 1, "normal contact force", of_normal_force)
      call add_channel(info, "friction_force", "N", "none", 1, "friction force on the "//who//" along "//along, of_friction_force)
      call add_channel(info, "state", "1", "none", 1, "0 free, 1 contact, 2 film, 3 mixed", of_state)
      call add_channel(info, "contact_point", "m", "world", 2, "point of action of the force on the "//who//"; of the "// &
         "possible contact if "// &
         "separated", of_contact_point)
      if (info%space == in_plane) then
         call add_channel(info, "contact_angle", "rad", "body", 1, "direction of the normal force of the "//who//", in the "// &
            "frame of " &
                          //"the body of i, from -pi to pi", of_contact_angle)
      end if
      call add_channel(info, "sliding_speed", "m/s", "none", 1, "sliding speed of the "//who//" at the " &
                       //"contact point, 0 without contact", of_sliding_speed)
      call add_channel(info, "contact_power", "W", "none", 1, "power dissipated by damping and friction of the contact", &
                       of_contact_power)
      call add_channel(info, "p_v", "Pa.m/s", "none", 1, "normal force over diameter and length of a pin, times the sliding " &
                       //"speed", of_p_v)
   end subroutine add_contact_channels

   !> Storage for what an evaluation finds.
   subroutine make_storage(self)
      class(point_contacts_t), intent(inout) :: self  !! the set

      call new_work(self%n_contact, self%work)
   end subroutine make_storage

   !> Friction of all contacts in an evaluation, by the law or by what it remembers; that of a contact that sticks is found with the
   !> accelerations.
   subroutine point_friction(self, motion)
      class(point_contacts_t), intent(inout) :: self  !! the set, its contacts measured and pressed
      type(motion_t), intent(in) :: motion            !! positions and velocities

      integer :: k

      if (.not. self%traits%has_faces) self%work%f_friction = self%work%f_n
      if (self%stick_slip%memory == memory_none) then
         call friction_by_law(self%n_contact, self%laws%friction, self%contact, self%work%contacts, self%work%f_friction, &
                              self%work%speed, &
                         self%work%f_t)
         return
      end if
      do k = 1, self%n_contact
         self%work%f_t(k) = 0.0_wp
         if (.not. self%contact(k)%is_touching) cycle
         call self%lay(k, motion)
         self%stick_slip%tangent(k)%f_n = self%work%f_friction(k)
         call slip_force(self%stick_slip, self%laws%friction, k)
         call take_friction(self%stick_slip%n_tangent, self%stick_slip%tangent(k), self%work%contacts(k), self%work%f_t(k))
      end do
   end subroutine point_friction

   !> Friction of a contact that remembers, as those that do not have it: in space t is against it.
   pure subroutine take_friction(n_tangent, tangent, contact, f_t)
      integer, intent(in) :: n_tangent                   !! tangents of a contact: 1 in the plane, 2 in space
      type(tangent_t), intent(in) :: tangent             !! how the contact lies, with its friction
      type(point_contact_t), intent(inout) :: contact    !! its kinematics; in space t and the velocity along it are set
      real(wp), intent(out) :: f_t                       !! friction force on j along t [N]

      f_t = tangent%f_t(1)
      if (n_tangent == 1) return
      f_t = -hypot(tangent%f_t(1), tangent%f_t(2))
      if (.not. f_t < 0.0_wp) return
      contact%tangent = matmul(tangent%t, tangent%f_t/f_t)
      contact%v_t_work = dot_product(tangent%v, tangent%f_t/f_t)
   end subroutine take_friction

   !> Cut a penetration where the surface ends: a geometry whose measure does not know of ends does it here.
   pure subroutine point_cut_at_ends(self, k, motion, contact, delta, rate)
      class(point_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                        !! contact
      type(motion_t), intent(in) :: motion            !! positions and velocities
      type(point_contact_t), intent(in) :: contact    !! its kinematics
      real(wp), intent(inout) :: delta                !! penetration [m]
      real(wp), intent(inout) :: rate                 !! its rate [m/s]
   end subroutine point_cut_at_ends

   !> Growth of a lever, lambda'/lambda: none, unless surfaces are worn.
   pure real(wp) function point_lever_growth(self, k, motion) result(growth)
      class(point_contacts_t), intent(in) :: self     !! the set
      integer, intent(in) :: k                        !! contact
      type(motion_t), intent(in) :: motion            !! positions and velocities

      growth = 0.0_wp
   end function point_lever_growth

   !> A channel of a geometry's own; there is none here, and the value is left alone.
   subroutine point_report_item(self, code, item, motion, contacts, f_n, f_t, value)
      class(point_contacts_t), intent(in) :: self         !! the set
      integer, intent(in) :: code                         !! the channel
      integer, intent(in) :: item                         !! the item
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) kinematics of its contacts
      real(wp), intent(in) :: f_n(self%n_contact_item)    !! (n_contact_item) normal forces [N]
      real(wp), intent(in) :: f_t(self%n_contact_item)    !! (n_contact_item) friction forces on j along t [N]
      real(wp), intent(inout), contiguous :: value(:)     !! (components) the value [any]
   end subroutine point_report_item

   !> Let faces take over from the contacts that share them, in an evaluation.
   subroutine point_share_faces(self)
      class(point_contacts_t), intent(inout) :: self  !! the set, its contacts measured and pressed

      real(wp), dimension(most_of_item) :: f_elastic, f_n, f_friction
      integer :: first, item, last, n

      n = self%n_contact_item
      do item = 1, self%n
         first = (item - 1)*n + 1
         last = item*n
         f_n(:n) = self%work%f_n(first:last)
         f_elastic(:n) = self%work%f_elastic(first:last)
         f_friction(:n) = f_n(:n)
         call self%share_item(item, self%work%contacts(first:last), f_n(:n), f_elastic(:n), f_friction(:n))
         self%work%f_n(first:last) = f_n(:n)
         self%work%f_elastic(first:last) = f_elastic(:n)
         self%work%f_friction(first:last) = f_friction(:n)
      end do
   end subroutine point_share_faces

   !> Let faces of an item take over from its contacts: a geometry without faces leaves the forces as they are.
   subroutine point_share_item(self, item, contacts, f_n, f_elastic, f_friction)
      class(point_contacts_t), intent(in) :: self        !! the set
      integer, intent(in) :: item                        !! the item
      type(point_contact_t), intent(in) :: contacts(:)   !! (n_contact_item) penetrations and rates of its contacts
      real(wp), intent(inout) :: f_n(:)                  !! (n_contact_item) normal forces, as the normal law gives them [N]
      real(wp), intent(inout) :: f_elastic(:)            !! (n_contact_item) derivatives of the stored energy by penetrations [N]
      real(wp), intent(inout) :: f_friction(:)                !! (n_contact_item) normal forces that friction feels [N]
   end subroutine point_share_item

end module point_contacts
