!> Planar revolute joint with clearance: a journal (pin) of body j loose in a bearing (hole) of body i.
!>
!> e = r_j^P - r_i^P,  n = e / |e|,  t = R90 n,  delta = |e| - c,  rate = e' . n    eqs. (4.1)-(4.5)
!> v_T = t . (v_j - v_i), velocities of the material points at C = (Q_i + Q_j) / 2, Q_k = P_k + R_k n
!> force on the journal f_j = -F_N n - F_T sign(v_T) t, on the bearing f_i = -f_j; both act at C.
!>
!> Signs: the reported force is that on the journal, world frame; the friction force is its
!> component along t; the eccentricity is the journal's centre from the bearing's, world frame.
!> With e = 0 the normal is taken along e' and delta = -c.
!>
!> Source: Flores et al. (2008), section 4.2, corrected: the book differentiates the geometric
!> contact point, (4.7) and (4.9), so that a spinning journal does not slide, and lets f_i act at
!> Q_i and f_j at Q_j, (4.10)-(4.13), which leaves a couple delta F_T. `form = book` does as the
!> book prints. Limits: both surfaces round; one contact per joint.
module clearance_revolute
   use bodies, only: material_t
   use catalogue, only: state_contact, state_free
   use clearance_set, only: clearance_set_t, loss_contact, loss_friction
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
   public :: clearance_revolute_t

   integer, parameter :: column_radius = 3            !! column of bearing_radius
   integer, parameter :: column_clearance = 4         !! column of clearance
   integer, parameter :: column_material = 5          !! column of material
   integer, parameter :: column_journal_material = 6  !! column of journal_material
   integer, parameter :: column_form = 10             !! column of form
   integer, parameter :: column_length = 11           !! column of length

   !> Kinematics of one contact.
   type :: contact_t
      real(wp) :: e(2) = 0.0_wp             !! (2) eccentricity, world frame [m]
      real(wp) :: normal(2) = 0.0_wp        !! (2) unit vector from bearing to journal [1]
      real(wp) :: delta = 0.0_wp            !! penetration [m]
      real(wp) :: rate = 0.0_wp             !! penetration rate [m/s]
      real(wp) :: v_t = 0.0_wp              !! sliding velocity of the journal along t, for the friction law [m/s]
      real(wp) :: v_t_work = 0.0_wp         !! the same of the points where the forces act, for their power [m/s]
      real(wp) :: arm_i(2) = 0.0_wp         !! (2) where the force on i acts, from its centre of mass [m]
      real(wp) :: arm_j(2) = 0.0_wp         !! (2) where the force on j acts, from its centre of mass [m]
   end type contact_t

   !> Journals in bearings, in the plane.
   type, extends(clearance_set_t) :: clearance_revolute_t
      real(wp), allocatable :: radius_i(:)     !! (n) radius of the bearing [m]
      real(wp), allocatable :: radius_j(:)     !! (n) radius of the journal [m]
      logical, allocatable :: is_book(:)       !! (n) formulas as the book prints them
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
      procedure, nopass :: mistake => revolute_mistake
      procedure, nopass :: describe => revolute_describe
      procedure :: evaluate => revolute_evaluate
      procedure :: gaps => revolute_gaps
      procedure :: watch => revolute_watch
      procedure :: lie => revolute_lie
      procedure :: report => revolute_report
      procedure :: elastic_energy => revolute_elastic_energy
   end type clearance_revolute_t

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
      allocate (self%radius_i(self%n), self%radius_j(self%n), self%is_book(self%n))
      allocate (self%kinematics(self%n))
      allocate (self%delta(self%n), self%rate(self%n), self%impact_speed(self%n), self%speed(self%n), self%f_n(self%n), &
                self%f_elastic(self%n), self%df_ddelta(self%n), self%df_drate(self%n), self%f_t(self%n), source=0.0_wp)
      do k = 1, self%n
         associate (values => items(k)%values)
            self%radius_i(k) = values(column_radius)%number
            self%clearance(k) = values(column_clearance)%number
            self%radius_j(k) = self%radius_i(k) - self%clearance(k)
            self%is_book(k) = values(column_form)%text == "book"
         end associate
      end do
   end subroutine revolute_prepare

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

      real(wp) :: e, e_dot(2), s_i(2), s_j(2), speed
      integer :: i, j

      i = self%body(1, k)
      j = self%body(2, k)
      s_i = motion%rot(1:2, 1, i)*self%s_i(1, k) + motion%rot(1:2, 2, i)*self%s_i(2, k)
      s_j = motion%rot(1:2, 1, j)*self%s_j(1, k) + motion%rot(1:2, 2, j)*self%s_j(2, k)
      contact%e = motion%r(1:2, j) + s_j - motion%r(1:2, i) - s_i
      e_dot(1) = motion%v(1, j) - motion%omega(3, j)*s_j(2) - motion%v(1, i) + motion%omega(3, i)*s_i(2)
      e_dot(2) = motion%v(2, j) + motion%omega(3, j)*s_j(1) - motion%v(2, i) - motion%omega(3, i)*s_i(1)
      e = sqrt(contact%e(1)**2 + contact%e(2)**2)
      if (e > tiny(1.0_wp)) then
         contact%normal = contact%e/e
      else
         speed = sqrt(e_dot(1)**2 + e_dot(2)**2)
         contact%normal = [1.0_wp, 0.0_wp]
         if (speed > tiny(1.0_wp)) contact%normal = e_dot/speed
      end if
      contact%delta = e - self%clearance(k)
      contact%rate = e_dot(1)*contact%normal(1) + e_dot(2)*contact%normal(2)
      if (self%is_book(k)) then
         contact%arm_i = s_i + self%radius_i(k)*contact%normal
         contact%arm_j = s_j + self%radius_j(k)*contact%normal
      else
         contact%arm_i = s_i + (self%radius_i(k) + 0.5_wp*contact%delta)*contact%normal
         contact%arm_j = s_j + (self%radius_j(k) - 0.5_wp*contact%delta)*contact%normal
      end if
   end subroutine measure

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
      if (self%is_book(k)) then
         ! of the geometric contact points: delta times the rate of the normal's direction
         contact%v_t = contact%v_t_work - self%radius_j(k)*motion%omega(3, j) + self%radius_i(k)*motion%omega(3, i)
         contact%v_t = contact%v_t*contact%delta/max(contact%delta + self%clearance(k), tiny(1.0_wp))
      end if
   end subroutine measure_sliding

   !> Normal force and signed friction force of one item from the set's laws.
   subroutine evaluate_item(self, k, motion, contact, f_n, df_ddelta, df_drate, f_t)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(contact_t), intent(out) :: contact          !! kinematics
      real(wp), intent(out) :: f_n                     !! normal force [N]
      real(wp), intent(out) :: df_ddelta               !! its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate                !! its derivative by rate [N.s/m]
      real(wp), intent(out) :: f_t                     !! friction force on the journal along t [N]

      real(wp) :: elastic(1), f(1), slope_delta(1), slope_rate(1)

      call measure(self, k, motion, contact)
      f_n = 0.0_wp
      f_t = 0.0_wp
      df_ddelta = 0.0_wp
      df_drate = 0.0_wp
      if (.not. self%contact(k)%is_touching) return
      call self%press(k, k, [contact%delta], [contact%rate], [self%contact(k)%impact_speed], f, slope_delta, slope_rate, elastic)
      f_n = f(1)
      df_ddelta = slope_delta(1)
      df_drate = slope_rate(1)
      if (.not. allocated(self%friction)) return
      if (self%grip%memory /= memory_none) then
         f_t = self%grip%tangent(k)%f_t  ! of the last evaluation: it is no function of the motion alone
         return
      end if
      call measure_sliding(self, k, motion, contact)
      call self%friction%force(1, [f_n], [abs(contact%v_t)], f)
      f_t = -sign(f(1), contact%v_t)
   end subroutine evaluate_item

   !> Add the contact forces of the touching items.
   subroutine revolute_evaluate(self, motion, loads, losses)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion                !! positions and velocities
      type(loads_t), intent(inout) :: loads               !! loads on the bodies
      real(wp), intent(inout) :: losses(:, :)             !! (2, all contacts) power lost [W]

      real(wp) :: f(2)
      integer :: i, j, k

      do k = 1, self%n
         losses(loss_contact, self%first_contact + k) = 0.0_wp
         losses(loss_friction, self%first_contact + k) = 0.0_wp
      end do
      if (self%n_touching == 0) return
      do k = 1, self%n
         self%delta(k) = 0.0_wp
         self%rate(k) = 0.0_wp
         self%impact_speed(k) = 1.0_wp
         if (.not. self%contact(k)%is_touching) cycle
         call measure(self, k, motion, self%kinematics(k))
         self%delta(k) = self%kinematics(k)%delta
         self%rate(k) = self%kinematics(k)%rate
         self%impact_speed(k) = self%contact(k)%impact_speed
      end do
      if (self%law%jumps_at_turn) then
         call self%press(1, self%n, self%delta, self%rate, self%impact_speed, self%f_n, self%df_ddelta, self%df_drate, &
                         self%f_elastic)
      else
         call self%law%force(self%n, self%delta, self%rate, self%impact_speed, self%parameters, self%f_n, self%df_ddelta, &
                             self%df_drate, self%f_elastic)
      end if
      if (allocated(self%friction)) call evaluate_friction(self, motion, losses)
      do k = 1, self%n
         if (.not. self%contact(k)%is_touching) cycle
         associate (contact => self%kinematics(k))
            f(1) = -self%f_n(k)*contact%normal(1) - self%f_t(k)*contact%normal(2)
            f(2) = -self%f_n(k)*contact%normal(2) + self%f_t(k)*contact%normal(1)
            losses(loss_contact, self%first_contact + k) = (self%f_n(k) - self%f_elastic(k))*contact%rate
            i = self%body(1, k)
            j = self%body(2, k)
            loads%force(1:2, i) = loads%force(1:2, i) - f
            loads%force(1:2, j) = loads%force(1:2, j) + f
            loads%moment(3, i) = loads%moment(3, i) - (contact%arm_i(1)*f(2) - contact%arm_i(2)*f(1))
            loads%moment(3, j) = loads%moment(3, j) + (contact%arm_j(1)*f(2) - contact%arm_j(2)*f(1))
         end associate
      end do
   end subroutine revolute_evaluate

   !> Friction of the touching items from their normal forces: signed along t, on the journal.
   subroutine evaluate_friction(self, motion, losses)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion                !! positions and velocities
      real(wp), intent(inout) :: losses(:, :)             !! (2, all contacts) power lost [W]

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

   !> How a contact lies. The normal turns with e' . t / |e|, and the point of contact goes along with it: of its velocity only
   !> the part along the normal counts, that of the centre P_k and the rate at which it comes nearer to it.
   subroutine revolute_lie(self, k, motion, tangent)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(tangent_t), intent(inout) :: tangent        !! how it lies

      type(contact_t) :: contact
      real(wp) :: longer, p_i(2), p_j(2), s_i(2), s_j(2), turn
      integer :: i, j

      i = self%body(1, k)
      j = self%body(2, k)
      call measure(self, k, motion, contact)
      call measure_sliding(self, k, motion, contact)
      tangent%t = [-contact%normal(2), contact%normal(1)]
      tangent%arm_i = contact%arm_i
      tangent%arm_j = contact%arm_j
      tangent%v = contact%v_t_work
      longer = merge(0.0_wp, 0.5_wp*contact%rate, self%is_book(k))  ! rate of the distance from the bearing's centre
      s_i = motion%rot(1:2, 1, i)*self%s_i(1, k) + motion%rot(1:2, 2, i)*self%s_i(2, k)
      s_j = motion%rot(1:2, 1, j)*self%s_j(1, k) + motion%rot(1:2, 2, j)*self%s_j(2, k)
      p_i = motion%omega(3, i)*[-s_i(2), s_i(1)]  ! of the centres, from those of mass
      p_j = motion%omega(3, j)*[-s_j(2), s_j(1)]
      turn = dot_product(motion%v(1:2, j) + p_j - motion%v(1:2, i) - p_i, tangent%t)/max(contact%delta + self%clearance(k), &
                                                                                          tiny(1.0_wp))
      tangent%drift = -turn*contact%rate + motion%omega(3, j)*(dot_product(contact%normal, p_j) - longer) &
                      - motion%omega(3, i)*(dot_product(contact%normal, p_i) + longer)
   end subroutine revolute_lie

   !> Penetration and its rate for all items.
   subroutine revolute_gaps(self, motion, delta, rate)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      real(wp), intent(inout) :: delta(:)              !! (all contacts) penetration [m]
      real(wp), intent(inout) :: rate(:)               !! (all contacts) its rate [m/s]

      type(contact_t) :: contact
      integer :: k

      do k = 1, self%n
         call measure(self, k, motion, contact)
         delta(self%first_contact + k) = contact%delta
         rate(self%first_contact + k) = contact%rate
      end do
   end subroutine revolute_gaps

   !> Normal force of a touching item and its rate:
   !> F' = dF/ddelta delta' + dF/drate delta'',  delta'' = n . e'' + (|e'|^2 - delta'^2) / |e|.
   subroutine revolute_watch(self, k, motion, delta, rate, force, force_rate)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                         !! item
      type(motion_t), intent(in) :: motion             !! positions, velocities and accelerations
      real(wp), intent(out) :: delta                   !! penetration [m]
      real(wp), intent(out) :: rate                    !! its rate [m/s]
      real(wp), intent(out) :: force                   !! normal force [N]
      real(wp), intent(out) :: force_rate              !! its rate [N/s]

      type(contact_t) :: contact
      real(wp) :: acceleration(2), arm_i(2), arm_j(2), df_ddelta, df_drate, e_dot(2), f_t
      integer :: i, j

      i = self%body(1, k)
      j = self%body(2, k)
      call evaluate_item(self, k, motion, contact, force, df_ddelta, df_drate, f_t)
      delta = contact%delta
      rate = contact%rate
      arm_i = motion%rot(1:2, 1, i)*self%s_i(1, k) + motion%rot(1:2, 2, i)*self%s_i(2, k)
      arm_j = motion%rot(1:2, 1, j)*self%s_j(1, k) + motion%rot(1:2, 2, j)*self%s_j(2, k)
      e_dot = motion%v(1:2, j) - motion%v(1:2, i) + motion%omega(3, j)*[-arm_j(2), arm_j(1)] &
              - motion%omega(3, i)*[-arm_i(2), arm_i(1)]
      acceleration = motion%a(1:2, j) - motion%a(1:2, i) &
                     + motion%alpha(3, j)*[-arm_j(2), arm_j(1)] - motion%omega(3, j)**2*arm_j &
                     - motion%alpha(3, i)*[-arm_i(2), arm_i(1)] + motion%omega(3, i)**2*arm_i
      force_rate = df_ddelta*rate + df_drate*(contact%normal(1)*acceleration(1) + contact%normal(2)*acceleration(2) &
                   + (e_dot(1)**2 + e_dot(2)**2 - rate**2)/max(delta + self%clearance(k), tiny(1.0_wp)))
   end subroutine revolute_watch

   !> Values of a channel for all items.
   subroutine revolute_report(self, channel, motion, values)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      character(*), intent(in) :: channel              !! name of the channel
      type(motion_t), intent(in) :: motion             !! positions and velocities
      real(wp), intent(inout) :: values(:, :)          !! (components, all items or contacts) values [any]

      type(contact_t) :: contact
      real(wp) :: df_ddelta, df_drate, f_n, f_t
      integer :: column, contact_column, k

      do k = 1, self%n
         column = self%first + k
         contact_column = self%first_contact + k
         call evaluate_item(self, k, motion, contact, f_n, df_ddelta, df_drate, f_t)
         select case (channel)
         case ("eccentricity")
            values(:, column) = contact%e
         case ("force")
            values(:, column) = -f_n*contact%normal + f_t*[-contact%normal(2), contact%normal(1)]
         case ("penetration")
            values(1, contact_column) = max(contact%delta, 0.0_wp)
         case ("penetration_rate")
            values(1, contact_column) = merge(contact%rate, 0.0_wp, self%contact(k)%is_touching)
         case ("normal_force")
            values(1, contact_column) = f_n
         case ("friction_force")
            values(1, contact_column) = f_t
         case ("state")
            values(1, contact_column) = real(merge(state_contact, state_free, self%contact(k)%is_touching), wp)
         end select
      end do
   end subroutine revolute_report

   !> Elastic energy that the touching items store.
   function revolute_elastic_energy(self, motion) result(energy)
      class(clearance_revolute_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion             !! positions
      real(wp) :: energy                               !! energy stored [J]

      type(contact_t) :: contact
      integer :: k

      energy = 0.0_wp
      do k = 1, self%n
         if (.not. self%contact(k)%is_touching) cycle
         call measure(self, k, motion, contact)
         energy = energy + self%law%potential(contact%delta, self%parameters(:, k))
      end do
   end function revolute_elastic_energy

end module clearance_revolute
