!> Planar: a journal (pin) of body j, round, in a round bearing (hole) of body i, or beside a disc of it.
!>
!> e = r_j^P - r_i^P,  n = e / |e|,  t = R90 n,  delta = |e| - c,  rate = e' . n    eqs. (4.1)-(4.5)
!> delta'' = n . e'' + (|e'|^2 - rate^2) / |e|
!> v_T = t . (v_j - v_i), velocities of the material points at C = (Q_i + Q_j) / 2, Q_k = P_k + R_k n
!>
!> With e = 0 the normal is taken along e' and delta = -c. Beside a disc |e|, n, c and the disc's radius have the other sign, and
!> all of this holds as it stands. Forces: see `point_contacts`. Surfaces that are worn: see `worn_contacts`.
!>
!> Source: Flores et al. (2008), section 4.2, corrected: the book differentiates the geometric contact point, (4.7) and (4.9), so
!> that a spinning journal does not slide, and lets f_i act at Q_i and f_j at Q_j, (4.10)-(4.13), which leaves a couple delta F_T.
!> `is_book` does as the book prints. Limits: both surfaces round; one contact per joint.
module round_contacts
   use clearance_set, only: loss_contact, loss_friction, n_integrand, normal_impulse
   use contact_laws, only: press_in_course
   use contact_memory, only: contact_memory_t
   use deep_damping, only: damp_deep
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use normal_law, only: n_law_parameter, normal_law_t, parameter_gentle
   use planar_contacts, only: planar_sliding
   use point_contact, only: point_contact_t
   use planar_points, only: planar_points_t
   use readings, only: readings_t
   use surfaces, only: surfaces_t
   use worn_contacts, only: measure_worn
   implicit none (type, external)
   private
   public :: journal_t, round_contacts_t

   !> Where the surfaces of one joint are, as an evaluation reads it.
   type :: journal_t
      integer :: body(2) = 0                !! (2) bodies of bearing and journal
      real(wp) :: s_i(2) = 0.0_wp           !! (2) centre of the bearing, frame of its body [m]
      real(wp) :: s_j(2) = 0.0_wp           !! (2) centre of the journal, frame of its body [m]
      real(wp) :: side = 1.0_wp             !! 1: the journal is in a hole; -1: beside a disc, distance and normal reversed [1]
      real(wp) :: share = 0.5_wp            !! part of the penetration from a surface to where the forces act [1]
      logical :: is_book = .false.          !! formulas as the book prints them
   end type journal_t

   !> Journals in bearings or beside discs. `prepare` of a geometry says where they are.
   type, abstract, extends(planar_points_t) :: round_contacts_t
      type(journal_t), allocatable :: journal(:)       !! (n) where the surfaces are
   contains
      procedure, non_overridable :: make_journals
      procedure :: evaluate => round_evaluate
      procedure :: measure => measure_one
      procedure :: penetration_acceleration => round_penetration_acceleration
      procedure :: turning => round_turning
      procedure :: lever_growth => round_lever_growth
      procedure :: report => round_report
      procedure :: report_item => round_report_item
   end type round_contacts_t

   interface
      !> Values that are read: of films here, and what they add to those of contacts. What is read of contacts is reported from
      !> where the evaluation of this motion found it, if it did.
      module subroutine round_report(self, readings, motion, values)
         implicit none (type, external)
         class(round_contacts_t), intent(in) :: self  !! the set
         type(readings_t), intent(in) :: readings     !! channels that are read
         type(motion_t), intent(in) :: motion         !! positions and velocities
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine round_report

      !> The eccentricity: the journal's centre from the bearing's, world frame.
      module subroutine round_report_item(self, code, item, motion, contacts, f_n, f_t, value)
         implicit none (type, external)
         class(round_contacts_t), intent(in) :: self         !! the set
         integer, intent(in) :: code                         !! the channel
         integer, intent(in) :: item                         !! the item
         type(motion_t), intent(in) :: motion                !! positions and velocities
         type(point_contact_t), intent(in) :: contacts(self%n_contact_item)  !! (n_contact_item) kinematics of its contact
         real(wp), intent(in) :: f_n(self%n_contact_item)    !! (n_contact_item) normal force [N]
         real(wp), intent(in) :: f_t(self%n_contact_item)    !! (n_contact_item) friction force on j along t [N]
         real(wp), intent(inout), contiguous :: value(:)     !! (2) the value [m]
      end subroutine round_report_item

      !> Rate of the rate of a penetration.
      pure module function round_penetration_acceleration(self, k, motion, contact) result(acceleration)
         implicit none (type, external)
         class(round_contacts_t), intent(in) :: self    !! the set
         integer, intent(in) :: k                       !! contact
         type(motion_t), intent(in) :: motion           !! positions, velocities and accelerations
         type(point_contact_t), intent(in) :: contact   !! its kinematics
         real(wp) :: acceleration                       !! [m/s^2]
      end function round_penetration_acceleration

      !> Growth of a lever.
      pure module function round_lever_growth(self, k, motion) result(growth)
         implicit none (type, external)
         class(round_contacts_t), intent(in) :: self    !! the set
         integer, intent(in) :: k                       !! contact
         type(motion_t), intent(in) :: motion           !! positions and velocities
         real(wp) :: growth                             !! lambda'/lambda [1/s]
      end function round_lever_growth

      !> The normal turns with e' . t / |e|, and the point of contact goes along with it.
      pure module subroutine round_turning(self, k, motion, contact, turn, speed_i, speed_j)
         implicit none (type, external)
         class(round_contacts_t), intent(in) :: self    !! the set
         integer, intent(in) :: k                       !! contact
         type(motion_t), intent(in) :: motion           !! positions and velocities
         type(point_contact_t), intent(in) :: contact   !! its kinematics
         real(wp), intent(out) :: turn                  !! rate at which the normal turns towards t [rad/s]
         real(wp), intent(out) :: speed_i               !! n . s_i', from the centre of mass of i [m/s]
         real(wp), intent(out) :: speed_j               !! n . s_j', from the centre of mass of j [m/s]
      end subroutine round_turning
   end interface

contains

   !> Storage for the contacts, their surfaces where the points of the items are.
   subroutine make_journals(self)
      class(round_contacts_t), intent(inout) :: self   !! the set, its items placed

      integer :: k

      call self%make_storage()
      allocate (self%journal(self%n))
      do k = 1, self%n
         self%journal(k)%body = self%items%body(:, k)
         self%journal(k)%s_i = self%items%s_i(1:2, k)
         self%journal(k)%s_j = self%items%s_j(1:2, k)
      end do
   end subroutine make_journals

   !> Add the contact forces of the touching contacts.
   subroutine round_evaluate(self, motion, loads, integrands)
      class(round_contacts_t), intent(inout) :: self        !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(loads_t), intent(inout) :: loads                 !! loads on the bodies
      real(wp), intent(inout) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) power lost and normal force [W and N]

      if (self%n_touching > 0 .and. self%laws%normal%hertz_damping > 0.0_wp .and. .not. allocated(self%laws%friction) &
          .and. .not. self%traits%is_worn) then
         self%evaluated_at = motion%number
         call press_journals(self%n, self%laws%normal%hertz_damping, self%laws%parameters, self%contact, self%journal, &
                             self%items%pairs, ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, &
                             self%work%contacts, self%work%f_n, self%work%slope_delta, self%work%slope_rate, &
                             self%work%f_elastic, loads%force, loads%moment, integrands)
         return
      end if
      include "point_way.inc"
   end subroutine round_evaluate

   include "../contact/hertz_force.inc"
   include "push.inc"
   include "planar_loads.inc"

   !> One evaluation of contacts without friction whose law is Hertz's with hysteresis damping, contact by contact: what the law
   !> gets and gives goes through no array, which takes as long as a root.
   pure subroutine press_journals(n, hysteresis, parameters, memory, journal, pairs, n_body, r, rot, v, omega, contacts, f_n, &
                                  slope_delta, slope_rate, f_elastic, force, moment, integrands)
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: hysteresis                     !! h of the law [1]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) of the law, fitted to them [any]
      type(contact_memory_t), intent(in) :: memory(n)        !! (n) states
      type(journal_t), intent(in) :: journal(n)              !! (n) where the surfaces are
      type(surfaces_t), intent(in) :: pairs(n)               !! (n) the surfaces
      integer, intent(in) :: n_body                          !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)                 !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)            !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)                 !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)             !! (3, 0:bodies) angular velocities [rad/s]
      type(point_contact_t), intent(inout) :: contacts(n)    !! (n) kinematics of those that touch
      real(wp), intent(inout) :: f_n(n)                      !! (n) normal forces [N]
      real(wp), intent(inout) :: slope_delta(n)              !! (n) their derivatives by the penetration [N/m]
      real(wp), intent(inout) :: slope_rate(n)               !! (n) their derivatives by its rate [N.s/m]
      real(wp), intent(inout) :: f_elastic(n)                !! (n) their elastic parts [N]
      real(wp), intent(inout) :: force(3, 0:n_body)          !! (3, 0:bodies) forces, added to [N]
      real(wp), intent(inout) :: moment(3, 0:n_body)         !! (3, 0:bodies) moments about the centres of mass, added to [N.m]
      real(wp), intent(inout) :: integrands(n_integrand, n)  !! (3, n) power lost and normal force, set [W and N]

      real(wp) :: distance
      integer :: k
      logical :: any_deep, is_deep

      any_deep = .false.
      do k = 1, n
         if (.not. memory(k)%is_touching) then
            f_n(k) = 0.0_wp
            slope_delta(k) = 0.0_wp
            slope_rate(k) = 0.0_wp
            f_elastic(k) = 0.0_wp
            integrands(:, k) = 0.0_wp
            cycle
         end if
         call measure_journal(journal(k)%body, journal(k)%s_i, journal(k)%s_j, journal(k), pairs(k), n_body, r, rot, v, omega, &
                              contacts(k), distance)
         call press_hertz(hysteresis, contacts(k)%delta, contacts(k)%rate, memory(k)%impact_speed, parameters(:, k), f_n(k), &
                          slope_delta(k), slope_rate(k), f_elastic(k), is_deep)
         if (is_deep) then
            any_deep = .true.
            f_n(k) = -1.0_wp  ! marked
            cycle
         end if
         call add_load(journal(k)%body(1), journal(k)%body(2), contacts(k), f_n(k), f_elastic(k), 0.0_wp, n_body, force, moment, &
                       integrands(:, k))
      end do
      if (.not. any_deep) return
      do k = 1, n
         if (f_n(k) >= 0.0_wp) cycle  ! but those marked above
         call damp_deep(hysteresis, contacts(k)%delta, contacts(k)%rate, memory(k)%impact_speed, &
                        parameters(parameter_gentle, k), f_elastic(k), f_n(k), slope_delta(k), slope_rate(k))
         call add_load(journal(k)%body(1), journal(k)%body(2), contacts(k), f_n(k), f_elastic(k), 0.0_wp, n_body, force, moment, &
                       integrands(:, k))
      end do
   end subroutine press_journals

   !> Measure the contacts that touch, all of them where they act apart, with their sliding velocities where there is friction, and
   !> take what the law gets of them.
   subroutine measure_touching(self, motion)
      class(round_contacts_t), intent(inout) :: self  !! the set; kinematics are set
      type(motion_t), intent(in) :: motion            !! positions and velocities

      integer :: k

      if (self%traits%is_worn) then
         do k = 1, self%n
            if (self%contact(k)%is_touching .or. self%laws%normal%acts_apart) then
               call measure_one(self, k, allocated(self%laws%friction), motion, self%work%contacts(k))
            end if
            call take_contact(self%contact(k), self%work%contacts(k), self%laws%normal%acts_apart, self%work%delta(k), &
                              self%work%rate(k), self%work%impact_speed(k))
         end do
         return
      end if
      call measure_journals(self%n, self%laws%normal%acts_apart, self%contact, self%journal, &
                            self%items%pairs, ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, &
                            allocated(self%laws%friction), self%work%contacts, self%work%delta, self%work%rate, &
                            self%work%impact_speed)
   end subroutine measure_touching

   !> The same on plain arrays.
   pure subroutine measure_journals(n, all_act, memory, journal, pairs, n_body, r, rot, v, omega, with_sliding, contacts, &
                                    delta, rate, impact_speed)
      integer, intent(in) :: n                            !! number of contacts
      logical, intent(in) :: all_act                      !! those that are free too
      type(contact_memory_t), intent(in) :: memory(n)     !! (n) states
      type(journal_t), intent(in) :: journal(n)           !! (n) where the surfaces are
      type(surfaces_t), intent(in) :: pairs(n)            !! (n) the surfaces
      integer, intent(in) :: n_body                       !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)              !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)         !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)              !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)          !! (3, 0:bodies) angular velocities [rad/s]
      logical, intent(in) :: with_sliding                 !! their sliding velocities too
      type(point_contact_t), intent(inout) :: contacts(n) !! (n) kinematics of those that act
      real(wp), intent(inout) :: delta(n)                 !! (n) penetration, as `take_contact` has it [m]
      real(wp), intent(inout) :: rate(n)                  !! (n) its rate [m/s]
      real(wp), intent(inout) :: impact_speed(n)          !! (n) impact speed [m/s]

      real(wp) :: distance
      integer :: k

      do k = 1, n
         if (memory(k)%is_touching .or. all_act) then
            call measure_journal(journal(k)%body, journal(k)%s_i, journal(k)%s_j, journal(k), pairs(k), n_body, r, rot, v, &
                                 omega, contacts(k), distance)
            if (with_sliding) call measure_sliding(journal(k), pairs(k), distance, journal(k)%body, n_body, v, omega, contacts(k))
         end if
         call take_contact(memory(k), contacts(k), all_act, delta(k), rate(k), impact_speed(k))
      end do
   end subroutine measure_journals

   !> Normal, penetration, its rate and arms of a contact; its sliding velocity where it is asked for.
   pure subroutine measure_one(self, k, with_sliding, motion, contact)
      class(round_contacts_t), intent(in) :: self      !! the set
      integer, intent(in) :: k                         !! contact
      logical, intent(in) :: with_sliding              !! its sliding velocity too
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(point_contact_t), intent(inout) :: contact  !! its kinematics

      real(wp) :: distance

      if (allocated(self%items%pairs(k)%worn)) then
         call measure_worn(self%items%pairs(k), self%items%body(:, k), self%journal(k)%s_i, self%journal(k)%s_j, motion, contact)
         return
      end if
      call measure_journal(self%journal(k)%body, self%journal(k)%s_i, self%journal(k)%s_j, self%journal(k), &
                           self%items%pairs(k), ubound(motion%angle, 1), motion%r, motion%rot, motion%v, motion%omega, contact, &
                           distance)
      if (with_sliding) then
         call measure_sliding(self%journal(k), self%items%pairs(k), distance, self%items%body(:, k), ubound(motion%angle, 1), &
                              motion%v, motion%omega, contact)
      end if
   end subroutine measure_one

   !> All but the sliding velocity.
   pure subroutine measure_journal(body, s_bearing, s_journal, journal, pair, n_body, r, rot, v, omega, contact, distance)
      integer, intent(in) :: body(2)                     !! (2) bodies of bearing and journal
      real(wp), intent(in) :: s_bearing(2)               !! (2) centre of the bearing, frame of its body [m]
      real(wp), intent(in) :: s_journal(2)               !! (2) centre of the journal, frame of its body [m]
      type(journal_t), intent(in) :: journal             !! where the surfaces are
      type(surfaces_t), intent(in) :: pair               !! the surfaces
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in) :: r(3, 0:n_body)             !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(in) :: rot(3, 3, 0:n_body)        !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(in) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities [rad/s]
      type(point_contact_t), intent(inout) :: contact    !! its kinematics
      real(wp), intent(out) :: distance                  !! of the centres, negative beside a disc [m]

      real(wp) :: e(2), e_dot(2), normal(2), s_i(2), s_j(2), speed
      integer :: i, j

      include "eccentricity.inc"
      distance = journal%side*sqrt(e(1)**2 + e(2)**2)
      if (abs(distance) > tiny(1.0_wp)) then
         normal(1) = e(1)/distance
         normal(2) = e(2)/distance
      else
         speed = sqrt(e_dot(1)**2 + e_dot(2)**2)
         normal = [1.0_wp, 0.0_wp]
         if (speed > tiny(1.0_wp)) normal = e_dot/speed
      end if
      contact%normal(1) = normal(1)
      contact%normal(2) = normal(2)
      contact%delta = distance - pair%touch
      contact%rate = e_dot(1)*normal(1) + e_dot(2)*normal(2)
      contact%arm_i(1) = s_i(1) + (journal%side*pair%radius_i + journal%share*contact%delta)*normal(1)
      contact%arm_i(2) = s_i(2) + (journal%side*pair%radius_i + journal%share*contact%delta)*normal(2)
      contact%arm_j(1) = s_j(1) + (pair%radius_j - journal%share*contact%delta)*normal(1)
      contact%arm_j(2) = s_j(2) + (pair%radius_j - journal%share*contact%delta)*normal(2)
   end subroutine measure_journal

   !> Sliding velocities, once normal and arms are known.
   pure subroutine measure_sliding(journal, pair, distance, body, n_body, v, omega, contact)
      type(journal_t), intent(in) :: journal             !! where the surfaces are
      type(surfaces_t), intent(in) :: pair               !! the surfaces
      real(wp), intent(in) :: distance                   !! of the centres, negative beside a disc [m]
      integer, intent(in) :: body(2)                     !! (2) bodies of bearing and journal
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in) :: v(3, 0:n_body)             !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)         !! (3, 0:bodies) angular velocities [rad/s]
      type(point_contact_t), intent(inout) :: contact    !! sliding velocities are set

      associate (i => body(1), j => body(2))
         contact%v_t_work = planar_sliding(contact, v(:, i), omega(3, i), v(:, j), omega(3, j))
         contact%v_t = contact%v_t_work
         if (.not. journal%is_book) return
         ! of the geometric contact points: delta times the rate of the normal's direction
         contact%v_t = contact%v_t_work - pair%radius_j*omega(3, j) + pair%radius_i*omega(3, i)
         contact%v_t = contact%v_t*contact%delta/max(distance, tiny(1.0_wp))
      end associate
   end subroutine measure_sliding

end module round_contacts
