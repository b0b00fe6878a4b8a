!> Planar revolute joint with clearance: a journal (pin) of body j loose in a bearing (hole) of body i.
!>
!> e = r_j^P - r_i^P,  n = e / |e|,  t = R90 n,  delta = |e| - c,  rate = e' . n    eqs. (4.1)-(4.5)
!> v_T = t . (v_j - v_i), velocities of the material points at C = (Q_i + Q_j) / 2, Q_k = P_k + R_k n
!> force on the journal f_j = -F_N n - F_T sign(v_T) t, on the bearing f_i = -f_j; both act at C.
!>
!> Signs: the reported force is that on the journal, world frame; the friction force is its
!> component along t; the eccentricity is the journal's centre from the bearing's, world frame.
!> With e = 0 the normal is taken along e' and delta = -c. Beside a disc (`clearance_discs`) |e|, n, c and the disc's radius have
!> the other sign, and all of this holds as it stands.
!>
!> Source: Flores et al. (2008), section 4.2, corrected: the book differentiates the geometric
!> contact point, (4.7) and (4.9), so that a spinning journal does not slide, and lets f_i act at
!> Q_i and f_j at Q_j, (4.10)-(4.13), which leaves a couple delta F_T. `form = book` does as the
!> book prints. Limits: both surfaces round; one contact per joint.
module clearance_revolute
   use bodies, only: material_t
   use clearance_set, only: clearance_set_t, loss_contact, loss_friction
   use contact_memory, only: contact_memory_t
   use contact_grip, only: tangent_t
   use friction_law, only: memory_none
   use item, only: item_t
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_length, kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use surfaces, only: set_materials, shape_internal, surfaces_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: clearance_revolute_t, contact_t, journal_t, measure, measure_sliding

   integer, parameter :: column_radius = 3            !! column of bearing_radius
   integer, parameter :: column_clearance = 4         !! column of clearance
   integer, parameter :: column_material = 5          !! column of material
   integer, parameter :: column_journal_material = 6  !! column of journal_material
   integer, parameter :: column_form = 10             !! column of form
   integer, parameter :: column_length = 11           !! column of length

   !> The surfaces of one joint.
   type :: journal_t
      real(wp) :: radius_i = 0.0_wp         !! radius of the bearing; negative: a disc that the journal touches from outside [m]
      real(wp) :: radius_j = 0.0_wp         !! radius of the journal [m]
      real(wp) :: clearance = 0.0_wp        !! radius_i less radius_j [m]
      real(wp) :: side = 1.0_wp             !! 1: the journal is in a hole; -1: beside a disc, distance and normal reversed [1]
      real(wp) :: share = 0.5_wp            !! part of the penetration from a surface to where the forces act [1]
      logical :: is_book = .false.          !! formulas as the book prints them
   end type journal_t

   !> Kinematics of one contact.
   type :: contact_t
      real(wp) :: e(2) = 0.0_wp             !! (2) eccentricity, world frame [m]
      real(wp) :: normal(2) = 0.0_wp        !! (2) unit vector from bearing to journal, reversed beside a disc [1]
      real(wp) :: distance = 0.0_wp         !! of the centres, negative beside a disc [m]
      real(wp) :: delta = 0.0_wp            !! penetration [m]
      real(wp) :: rate = 0.0_wp             !! penetration rate [m/s]
      real(wp) :: v_t = 0.0_wp              !! sliding velocity of the journal along t, for the friction law [m/s]
      real(wp) :: v_t_work = 0.0_wp         !! the same of the points where the forces act, for their power [m/s]
      real(wp) :: arm_i(2) = 0.0_wp         !! (2) where the force on i acts, from its centre of mass [m]
      real(wp) :: arm_j(2) = 0.0_wp         !! (2) where the force on j acts, from its centre of mass [m]
   end type contact_t

   !> Journals in bearings, in the plane.
   type, extends(clearance_set_t) :: clearance_revolute_t
      type(journal_t), allocatable :: journal(:)       !! (n) the surfaces
      ! scratch of one evaluation
      type(contact_t), allocatable :: kinematics(:)    !! (n) kinematics
      real(wp), allocatable :: delta(:)                !! (n) penetration [m]
      real(wp), allocatable :: rate(:)                 !! (n) its rate [m/s]
      real(wp), allocatable :: impact_speed(:)         !! (n) impact speed [m/s]
      real(wp), allocatable :: speed(:)                !! (n) magnitude of the sliding velocity [m/s]
      real(wp), allocatable :: f_n(:)                  !! (n) normal force [N]
      real(wp), allocatable :: f_elastic(:)            !! (n) its elastic part [N]
      real(wp), allocatable :: df_ddelta(:)            !! (n) its derivative by penetration [N/m]
      real(wp), allocatable :: df_drate(:)             !! (n) its derivative by rate [N.s/m]
      real(wp), allocatable :: f_t(:)                  !! (n) friction force on the journal along t, zero without friction law [N]
   contains
      procedure, nopass :: info => revolute_info
      procedure, nopass :: ideal_kind => revolute_ideal_kind
      procedure :: prepare => revolute_prepare
      procedure :: make_room => revolute_make_room
      procedure, nopass :: mistake => revolute_mistake
      procedure, nopass :: describe => revolute_describe
      procedure :: evaluate => revolute_evaluate
      procedure :: gaps => revolute_gaps
      procedure :: watch => revolute_watch
      procedure :: lie => revolute_lie
      procedure :: report => revolute_report
      procedure :: elastic_energy => revolute_elastic_energy
   end type clearance_revolute_t

   interface
      !> How a contact lies. The normal turns with e' . t / |e|, and the point of contact goes along with it: of its velocity only
      !> the part along the normal counts, that of the centre P_k and the rate at which it comes nearer to it.
      module subroutine revolute_lie(self, k, motion, tangent)
         implicit none (type, external)
         class(clearance_revolute_t), intent(in) :: self  !! the set
         integer, intent(in) :: k                         !! item
         type(motion_t), intent(in) :: motion             !! positions and velocities
         type(tangent_t), intent(inout) :: tangent        !! how it lies
      end subroutine revolute_lie

      !> Penetration and its rate for all items.
      module subroutine revolute_gaps(self, motion, delta, rate)
         implicit none (type, external)
         class(clearance_revolute_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion             !! positions and velocities
         real(wp), intent(inout) :: delta(:)              !! (all contacts) penetration [m]
         real(wp), intent(inout) :: rate(:)               !! (all contacts) its rate [m/s]
      end subroutine revolute_gaps

      !> Normal force of a touching item and its rate:
      !> F' = dF/ddelta delta' + dF/drate delta'',  delta'' = n . e'' + (|e'|^2 - delta'^2) / |e|.
      module subroutine revolute_watch(self, k, motion, delta, rate, force, force_rate)
         implicit none (type, external)
         class(clearance_revolute_t), intent(in) :: self  !! the set
         integer, intent(in) :: k                         !! item
         type(motion_t), intent(in) :: motion             !! positions, velocities and accelerations
         real(wp), intent(out) :: delta                   !! penetration [m]
         real(wp), intent(out) :: rate                    !! its rate [m/s]
         real(wp), intent(out) :: force                   !! normal force [N]
         real(wp), intent(out) :: force_rate              !! its rate [N/s]
      end subroutine revolute_watch

      !> Values of a channel for all items.
      module subroutine revolute_report(self, channel, motion, values)
         implicit none (type, external)
         class(clearance_revolute_t), intent(in) :: self  !! the set
         character(*), intent(in) :: channel              !! name of the channel
         type(motion_t), intent(in) :: motion             !! positions and velocities
         real(wp), intent(inout) :: values(:, :)          !! (components, all items or contacts) values [any]
      end subroutine revolute_report

      !> Elastic energy that the touching items store.
      module function revolute_elastic_energy(self, motion) result(energy)
         implicit none (type, external)
         class(clearance_revolute_t), intent(in) :: self  !! the set
         type(motion_t), intent(in) :: motion             !! positions
         real(wp) :: energy                               !! energy stored [J]
      end function revolute_elastic_energy
   end interface

contains

   !> What the geometry says of itself.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.revolute"
      info%help = "a pin loose in a hole: dry contact of a journal in a bearing"
      info%source = "Flores et al. (2008), section 4.2"
      call add_reference(info, "bearing", "points", "centre of the hole")
      call add_reference(info, "journal", "points", "centre of the pin")
      call add_number(info, "bearing_radius", dim_length, "radius of the hole", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "clearance", dim_length, "radial clearance, radius of the hole less that of the pin", &
                      lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of hole and pin")
      call add_reference(info, "journal_material", "material", "material of the pin, if another", default="none")
      call add_word(info, "level", "fidelity: an ideal pin joint, or clearance", default="clearance", &
                    choices="ideal clearance")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_word(info, "form", "formulas: corrected, or as the book prints them", default="corrected", &
                    choices="corrected book")
      call add_number(info, "length", dim_length, "length of the bearing along its axis, for laws of cylinders; 0: not known", &
                      default="0 m", lower=0.0_wp)
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the journal from that of the bearing")
      call add_channel(info, "force", "N", "world", 2, "force on the journal")
      call add_channel(info, "penetration", "m", "none", 1, "penetration of the surfaces, 0 when apart")
      call add_channel(info, "penetration_rate", "m/s", "none", 1, "rate of the penetration, positive when approaching")
      call add_channel(info, "normal_force", "N", "none", 1, "normal contact force")
      call add_channel(info, "friction_force", "N", "none", 1, "friction force on the journal along t = R90 n")
      call add_channel(info, "state", "1", "none", 1, "0 free, 1 contact, 2 film, 3 mixed")
   end function revolute_info

   !> Without clearance a revolute joint.
   function revolute_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.revolute"
   end function revolute_ideal_kind

   !> Radii, clearance and form of each item.
   subroutine revolute_prepare(self, items)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                !! (n) rows of the table

      integer :: k

      self%is_round = .true.
      call self%make_room()
      do k = 1, self%n
         associate (values => items(k)%values, journal => self%journal(k))
            self%clearance(k) = values(column_clearance)%number
            journal%radius_i = values(column_radius)%number
            journal%radius_j = journal%radius_i - self%clearance(k)
            journal%clearance = self%clearance(k)
            journal%is_book = values(column_form)%text == "book"
            if (journal%is_book) journal%share = 0.0_wp
         end associate
      end do
   end subroutine revolute_prepare

   !> Room for surfaces and the scratch of an evaluation.
   subroutine revolute_make_room(self)
      class(clearance_revolute_t), intent(inout) :: self  !! the set

      allocate (self%journal(self%n), self%kinematics(self%n))
      allocate (self%delta(self%n), self%rate(self%n), self%impact_speed(self%n), self%speed(self%n), self%f_n(self%n), &
                self%f_elastic(self%n), self%df_ddelta(self%n), self%df_drate(self%n), self%f_t(self%n), source=0.0_wp)
   end subroutine revolute_make_room

   !> A pin in a hole.
   pure subroutine revolute_describe(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      integer :: journal_material

      pair%shape = shape_internal
      pair%radius_i = item%values(column_radius)%number
      pair%clearance = item%values(column_clearance)%number
      pair%radius_j = pair%radius_i - pair%clearance
      pair%length = item%values(column_length)%number
      journal_material = item%values(column_journal_material)%index
      if (journal_material == 0) journal_material = item%values(column_material)%index
      call set_materials(pair, materials(item%values(column_material)%index), materials(journal_material))
   end subroutine revolute_describe

   !> The journal must have a radius.
   subroutine revolute_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      associate (radius => item%values(column_radius)%number, clearance => item%values(column_clearance)%number)
         if (clearance < radius) return
         column = column_clearance
         message = "clearance must be less than bearing_radius"
         help = "the journal's radius is bearing_radius less clearance: here "//to_text(1.0e3_wp*(radius - clearance))//" mm"
      end associate
   end subroutine revolute_mistake

   !> Eccentricity, normal, penetration and rate; enough for gaps and frictionless forces.
   pure subroutine measure(self, k, motion, contact)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(contact_t), intent(inout) :: contact        !! kinematics; v_t is left alone

      call measure_journal(self%body(:, k), self%s_i(:, k), self%s_j(:, k), self%journal(k), &
                           ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, contact)
   end subroutine measure

   !> The same on plain arrays.
   pure subroutine measure_journal(body, s_bearing, s_journal, journal, n_body, r, rot, v, omega, contact)
      integer, intent(in) :: body(2)                 !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(3)           !! (3) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(3)           !! (3) centre of the journal, frame of its body [m]
      type(journal_t), intent(in) :: journal         !! the surfaces
      integer, intent(in) :: n_body                  !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)         !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)    !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)         !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)     !! (3, 0:bodies) angular velocities [rad/s]
      type(contact_t), intent(inout) :: contact      !! kinematics; v_t is left alone

      real(wp) :: distance, e(2), e_dot(2), normal(2), s_i(2), s_j(2), speed
      integer :: i, j

      i = body(1)
      j = body(2)
      s_i(1) = rot(1, 1, i)*s_bearing(1) + rot(1, 2, i)*s_bearing(2)
      s_i(2) = rot(2, 1, i)*s_bearing(1) + rot(2, 2, i)*s_bearing(2)
      s_j(1) = rot(1, 1, j)*s_journal(1) + rot(1, 2, j)*s_journal(2)
      s_j(2) = rot(2, 1, j)*s_journal(1) + rot(2, 2, j)*s_journal(2)
      e(1) = r(1, j) + s_j(1) - r(1, i) - s_i(1)
      e(2) = r(2, j) + s_j(2) - r(2, i) - s_i(2)
      e_dot(1) = v(1, j) - omega(3, j)*s_j(2) - v(1, i) + omega(3, i)*s_i(2)
      e_dot(2) = v(2, j) + omega(3, j)*s_j(1) - v(2, i) - omega(3, i)*s_i(1)
      distance = journal%side*sqrt(e(1)**2 + e(2)**2)
      if (abs(distance) > tiny(1.0_wp)) then
         normal(1) = e(1)/distance
         normal(2) = e(2)/distance
      else
         speed = sqrt(e_dot(1)**2 + e_dot(2)**2)
         normal = [1.0_wp, 0.0_wp]
         if (speed > tiny(1.0_wp)) normal = e_dot/speed
      end if
      contact%e(1) = e(1)
      contact%e(2) = e(2)
      contact%normal(1) = normal(1)
      contact%normal(2) = normal(2)
      contact%distance = distance
      contact%delta = distance - journal%clearance
      contact%rate = e_dot(1)*normal(1) + e_dot(2)*normal(2)
      contact%arm_i(1) = s_i(1) + (journal%radius_i + journal%share*contact%delta)*normal(1)
      contact%arm_i(2) = s_i(2) + (journal%radius_i + journal%share*contact%delta)*normal(2)
      contact%arm_j(1) = s_j(1) + (journal%radius_j - journal%share*contact%delta)*normal(1)
      contact%arm_j(2) = s_j(2) + (journal%radius_j - journal%share*contact%delta)*normal(2)
   end subroutine measure_journal

   !> Kinematics of the touching items; at the others the law is to find no penetration.
   pure subroutine measure_touching(n, memory, body, s_i, s_j, journal, n_body, r, rot, v, omega, contact, delta, &
                                    rate, impact_speed, losses)
      integer, intent(in) :: n                         !! number of items
      type(contact_memory_t), intent(in) :: memory(n)  !! (n) state of the contacts
      integer, intent(in) :: body(2, n)                !! (2, n) bodies of bearing and journal
      real(wp), intent(in) :: s_i(3, n)                !! (3, n) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_j(3, n)                !! (3, n) centre of the journal, frame of its body [m]
      type(journal_t), intent(in) :: journal(n)        !! (n) the surfaces
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)           !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)      !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)           !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)       !! (3, 0:bodies) angular velocities [rad/s]
      type(contact_t), intent(inout) :: contact(n)     !! (n) kinematics of the touching items
      real(wp), intent(inout) :: delta(n)              !! (n) penetration, 0 where nothing touches [m]
      real(wp), intent(inout) :: rate(n)               !! (n) its rate [m/s]
      real(wp), intent(inout) :: impact_speed(n)       !! (n) impact speed [m/s]
      real(wp), intent(inout) :: losses(2, n)          !! (2, n) power lost, set to zero [W]

      integer :: k

      do k = 1, n
         losses(loss_contact, k) = 0.0_wp
         losses(loss_friction, k) = 0.0_wp
         if (.not. memory(k)%is_touching) then
            delta(k) = 0.0_wp
            rate(k) = 0.0_wp
            impact_speed(k) = 1.0_wp
            cycle
         end if
         call measure_journal(body(:, k), s_i(:, k), s_j(:, k), journal(k), n_body, r, rot, v, omega, contact(k))
         delta(k) = contact(k)%delta
         rate(k) = contact(k)%rate
         impact_speed(k) = memory(k)%impact_speed
      end do
   end subroutine measure_touching

   !> Add the forces of the touching items to the loads, and what damping takes to the losses.
   pure subroutine add_forces(n, memory, body, contact, f_n, f_elastic, f_t, n_body, force, moment, losses)
      integer, intent(in) :: n                         !! number of items
      type(contact_memory_t), intent(in) :: memory(n)  !! (n) state of the contacts
      integer, intent(in) :: body(2, n)                !! (2, n) bodies of bearing and journal
      type(contact_t), intent(in) :: contact(n)        !! (n) kinematics of the touching items
      real(wp), intent(in) :: f_n(n)                   !! (n) normal forces [N]
      real(wp), intent(in) :: f_elastic(n)             !! (n) their elastic parts [N]
      real(wp), intent(in) :: f_t(n)                   !! (n) friction forces on the journals along t [N]
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(inout) :: force(3, 0:n_body)    !! (3, 0:bodies) forces [N]
      real(wp), intent(inout) :: moment(3, 0:n_body)   !! (3, 0:bodies) moments about the centres of mass [N.m]
      real(wp), intent(inout) :: losses(2, n)          !! (2, n) power lost [W]

      real(wp) :: f(2)
      integer :: i, j, k

      do k = 1, n
         if (.not. memory(k)%is_touching) cycle
         i = body(1, k)
         j = body(2, k)
         f(1) = -f_n(k)*contact(k)%normal(1) - f_t(k)*contact(k)%normal(2)
         f(2) = -f_n(k)*contact(k)%normal(2) + f_t(k)*contact(k)%normal(1)
         force(1, i) = force(1, i) - f(1)
         force(2, i) = force(2, i) - f(2)
         force(1, j) = force(1, j) + f(1)
         force(2, j) = force(2, j) + f(2)
         moment(3, i) = moment(3, i) - (contact(k)%arm_i(1)*f(2) - contact(k)%arm_i(2)*f(1))
         moment(3, j) = moment(3, j) + (contact(k)%arm_j(1)*f(2) - contact(k)%arm_j(2)*f(1))
         losses(loss_contact, k) = (f_n(k) - f_elastic(k))*contact(k)%rate
      end do
   end subroutine add_forces

   !> Sliding velocities, after `measure`.
   pure subroutine measure_sliding(self, k, motion, contact)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(contact_t), intent(inout) :: contact        !! kinematics

      real(wp) :: tangent(2), v_i(2), v_j(2)
      integer :: i, j

      i = self%body(1, k)
      j = self%body(2, k)
      tangent = [-contact%normal(2), contact%normal(1)]
      v_i = motion%v(1:2, i) + motion%omega(3, i)*[-contact%arm_i(2), contact%arm_i(1)]
      v_j = motion%v(1:2, j) + motion%omega(3, j)*[-contact%arm_j(2), contact%arm_j(1)]
      contact%v_t_work = dot_product(v_j - v_i, tangent)
      contact%v_t = contact%v_t_work
      if (self%journal(k)%is_book) then
         ! of the geometric contact points: delta times the rate of the normal's direction
         contact%v_t = contact%v_t_work - self%journal(k)%radius_j*motion%omega(3, j) + self%journal(k)%radius_i*motion%omega(3, i)
         contact%v_t = contact%v_t*contact%delta/max(contact%distance, tiny(1.0_wp))
      end if
   end subroutine measure_sliding

   !> Add the contact forces of the touching items.
   subroutine revolute_evaluate(self, motion, loads, losses)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(loads_t), intent(inout) :: loads               !! loads on the bodies
      real(wp), intent(inout), contiguous :: losses(:, :) !! (2, all contacts) power lost [W]

      integer :: n_body

      if (self%n_touching == 0) then
         losses(:, self%first_contact + 1:self%first_contact + self%n) = 0.0_wp
         return
      end if
      n_body = ubound(motion%angle, 1)
      call measure_touching(self%n, self%contact, self%body, self%s_i, self%s_j, self%journal, n_body, motion%r, &
                            motion%rot, motion%v, motion%omega, self%kinematics, self%delta, self%rate, self%impact_speed, &
                            losses(:, self%first_contact + 1:))
      call self%press(1, self%n, self%delta, self%rate, self%impact_speed, self%f_n, self%df_ddelta, self%df_drate, self%f_elastic)
      if (allocated(self%friction)) call evaluate_friction(self, motion, losses)
      call add_forces(self%n, self%contact, self%body, self%kinematics, self%f_n, self%f_elastic, self%f_t, n_body, &
                      loads%force, loads%moment, losses(:, self%first_contact + 1:))
   end subroutine revolute_evaluate

   !> Friction of the touching items from their normal forces: signed along t, on the journal.
   subroutine evaluate_friction(self, motion, losses)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion                !! positions and velocities
      real(wp), intent(inout), contiguous :: losses(:, :) !! (2, all contacts) power lost [W]

      integer :: k

      if (self%grip%memory /= memory_none) then
         call self%rub(motion, self%f_n, self%f_t, losses)
         return
      end if
      do k = 1, self%n
         self%speed(k) = 0.0_wp
         if (.not. self%contact(k)%is_touching) cycle
         call measure_sliding(self, k, motion, self%kinematics(k))
         self%speed(k) = abs(self%kinematics(k)%v_t)
      end do
      call self%friction%force(self%n, self%f_n, self%speed, self%f_t)
      do k = 1, self%n
         if (.not. self%contact(k)%is_touching) cycle
         self%f_t(k) = -sign(self%f_t(k), self%kinematics(k)%v_t)
         losses(loss_friction, self%first_contact + k) = -self%f_t(k)*self%kinematics(k)%v_t_work
      end do
   end subroutine evaluate_friction

end module clearance_revolute
