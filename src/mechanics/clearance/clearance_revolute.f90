!> Planar: a revolute joint with clearance, a journal (pin) of body j in a bearing (hole) of body i.
!>
!> Equations: `round_contacts`; forces: `point_contacts`; films: `bearing_films`. The law is fitted to an internal contact of radii
!> R and R - c. `level` says what there is between the surfaces: dry contact (`clearance`), a film that holds them apart
!> (`lubricated`: the run ends where e = eps_max c), or both (`hybrid`): with e_t0 the film goes out and the contact comes in
!> between e = c and c + e_t0, and the film has the clearance c + e_t1, eq. (5.23); without it the film keeps its shape beyond
!> eps_max and the contact adds to it.
!>
!> Signs: the reported force is that on the journal, world frame; the friction force is its component along t = R90 n; the
!> eccentricity is the journal's centre from the bearing's, world frame.
!> Wear (`wear_law`): the driving work is that of the resultant; it is shared out over the arc in which the surfaces overlap, by the
!> cosine of the angle from the normal where they are round (`wear_arc`), by the overlap where they are worn (`surface_overlap`).
!> The geometry of contact is that of the start within a run.
!> Source: Flores et al. (2008), section 4.2, corrected: see `round_contacts`; `form = book` does as the book prints.
!> Limits: surfaces round, or round but for wear; one contact per joint.
module clearance_revolute
   use bodies, only: material_t
   use clearance_set, only: loss_friction, n_integrand, normal_impulse
   use friction_law, only: memory_slip
   use item, only: item_t, place_of
   use joint_level, only: level_lubricated, level_of
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use planar_contacts, only: planar_sliding
   use point_contact, only: point_contact_t
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force
   use revolute_level, only: add_film_channels, add_film_columns, describe_hole, find_level_mistake
   use round_contacts, only: round_contacts_t
   use surfaces, only: surfaces_t
   use text, only: to_text
   use wear_arc, only: half_angles
   use wear_contact, only: wear_contact_t
   use worn_contacts, only: worn_arc
   implicit none (type, external)
   private
   public :: clearance_revolute_t

   !> Journals in bearings, in the plane.
   type, extends(round_contacts_t) :: clearance_revolute_t
   contains
      procedure, nopass :: info => revolute_info
      procedure, nopass :: ideal_kind => revolute_ideal_kind
      procedure :: prepare => revolute_prepare
      procedure, nopass :: mistake => revolute_mistake
      procedure, nopass :: describe => revolute_describe
      procedure :: wear_rates => revolute_wear_rates
      procedure :: wear_at => revolute_wear_at
   end type clearance_revolute_t

contains

   !> Description of the geometry.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.revolute"
      info%space = in_plane
      info%help = "a pin with clearance in a hole: dry contact, or a journal bearing with lubricant film"
      info%source = "Flores et al. (2008), section 4.2"
      call add_reference(info, "bearing", "points", "centre of the hole")
      call add_reference(info, "journal", "points", "centre of the pin")
      call add_number(info, "bearing_radius", dim_length, "radius of the hole", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "clearance", dim_length, "radial clearance, radius of the hole minus radius of the pin", &
                      lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of hole and pin, for dry contact", default="none")
      call add_reference(info, "journal_material", "material", "material of the pin, if different", default="none")
      call add_word(info, "level", "model: an ideal pin joint, dry contact, a film, or film and dry contact", &
                    default="clearance", choices="ideal clearance lubricated hybrid")
      call add_reference(info, "law", "contact.", "normal law of dry contact, a row of a contact table", default="none")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_word(info, "form", "formulas: corrected, or as printed in Flores et al. (2008)", default="corrected", &
                    choices="corrected book")
      call add_number(info, "length", dim_length, "length of the bearing along its axis, for laws of cylinders; 0: unknown", &
                      default="0 m", lower=0.0_wp)
      call add_reference(info, "wear", "wear.", "wear law, a row of a wear table, or none; needs a length", default="none")
      call add_film_columns(info, .false.)
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the journal relative to that of the bearing", &
                       of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the journal", of_force)
      call add_film_channels(info)
      call add_contact_channels(info, "journal", "t = R90 n")
   end function revolute_info

   !> Without clearance a revolute joint.
   function revolute_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.revolute"
   end function revolute_ideal_kind

   !> Form of each item.
   subroutine revolute_prepare(self, items)
      class(clearance_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                !! (n) rows of the table

      integer :: k

      self%traits%is_round = .true.
      call self%make_journals()
      do k = 1, self%n
         associate (item => items(k), journal => self%journal(k))
            journal%is_book = item%word("form") == "book"
            if (journal%is_book) journal%share = 0.0_wp
         end associate
      end do
   end subroutine revolute_prepare

   !> A pin in a hole.
   pure subroutine revolute_describe(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      call describe_hole(item, materials, pair)
      pair%length = item%number("length")
   end subroutine revolute_describe

   !> The journal must have a radius, and the row what its level needs.
   subroutine revolute_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      associate (radius => item%number("bearing_radius"), clearance => item%number("clearance"))
         if (.not. clearance < radius) then
            column = place_of(item, "clearance")
            message = "clearance must be smaller than bearing_radius"
            help = "the journal radius is bearing_radius minus clearance: here "//to_text(1.0e3_wp*(radius - clearance))//" mm"
            return
         end if
      end associate
      call find_level_mistake(item, column, message, help)
   end subroutine revolute_mistake

   !> Rates of the driving work of wear: F_N |v_T|, or the power of friction.
   pure subroutine revolute_wear_rates(self, motion, integrands, rate)
      class(clearance_revolute_t), intent(in) :: self   !! the set, with a wear law, evaluated
      type(motion_t), intent(in) :: motion              !! positions and velocities of the evaluation
      real(wp), intent(in) :: integrands(n_integrand, self%n_contact)  !! (3, contacts) power lost and normal force [W and N]
      real(wp), intent(out) :: rate(self%n_contact)                    !! (contacts) rates [W]

      integer :: k

      do k = 1, self%n_contact
         rate(k) = 0.0_wp
         if (.not. self%contact(k)%is_touching) cycle
         if (self%laws%wear%by_friction) then
            rate(k) = integrands(loss_friction, k)
         else
            associate (i => self%items%body(1, k), j => self%items%body(2, k))
               rate(k) = integrands(normal_impulse, k)*speed_of(self, k, planar_sliding(self%work%contacts(k), motion%v(:, i), &
                                                                           motion%omega(3, i), motion%v(:, j), motion%omega(3, j)))
            end associate
         end if
      end do
   end subroutine revolute_wear_rates

   !> |v_T| of the material points where forces act, for wear. Of a contact that may stick it is the speed along its slip, and none
   !> while it sticks: what is left of its sliding then is no motion.
   pure real(wp) function speed_of(self, k, v_t) result(speed)
      class(clearance_revolute_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                          !! contact of the set
      real(wp), intent(in) :: v_t                       !! sliding velocity [m/s]

      speed = abs(v_t)
      if (self%stick_slip%memory /= memory_slip) return
      speed = 0.0_wp
      if (abs(self%stick_slip%slip(k)) == 1) speed = self%stick_slip%slip(k)*v_t
   end function speed_of

   !> What a contact does to its surfaces at a motion: its arc is that in which the surfaces overlap, of round ones in the
   !> directions of the normal. Friction that remembers is taken as that of steady sliding.
   subroutine revolute_wear_at(self, k, motion, wear)
      class(clearance_revolute_t), intent(in) :: self   !! the set, with a wear law
      integer, intent(in) :: k                          !! contact of the set, which touches
      type(motion_t), intent(in) :: motion              !! positions and velocities
      type(wear_contact_t), intent(inout) :: wear       !! force, sliding and arc

      type(point_contact_t) :: contact
      real(wp) :: f_elastic(1), f_n(1), f_t(1), normal(2), speed_i, speed_j, turn
      integer :: body, side

      call self%measure(k, .true., motion, contact)
      call self%press(k, [contact], f_n, f_elastic)
      wear%force = f_n(1)
      call self%turning(k, motion, contact, turn, speed_i, speed_j)
      wear%speed = max(speed_of(self, k, contact%v_t_work), 0.0_wp)
      wear%power = wear%force*wear%speed
      if (self%laws%wear%by_friction) then
         call self%laws%friction%force(1, [wear%force], [wear%speed], f_t)
         wear%power = f_t(1)*wear%speed
      end if
      do side = 1, size(wear%direction)
         body = self%items%body(side, k)
         normal = matmul(contact%normal(1:2), motion%rot(1:2, 1:2, body))
         wear%direction(side) = atan2(normal(2), normal(1))
         wear%turn(side) = turn - motion%omega(3, body)
      end do
      call find_place(self, k, motion, contact, wear)
      associate (pair => self%items%pairs(k))
         wear%is_worn = allocated(pair%worn)
         if (wear%is_worn) then
            call worn_arc(pair, self%journal(k)%body, self%journal(k)%s_i, self%journal(k)%s_j, motion, wear%arc)
         else
            wear%half_angle = half_angles(pair%radius_i, pair%radius_j, pair%clearance + contact%delta)
         end if
      end associate
   end subroutine revolute_wear_at

   !> Where the pin is in its hole, and the exponent of the normal law at its penetration.
   subroutine find_place(self, k, motion, contact, wear)
      class(clearance_revolute_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                          !! contact of the set
      type(motion_t), intent(in) :: motion              !! positions and velocities
      type(point_contact_t), intent(in) :: contact      !! its kinematics
      type(wear_contact_t), intent(inout) :: wear       !! place, turned and exponent are set

      real(wp), parameter :: small = 1.0e-3_wp   ! part of the penetration [1]
      type(point_contact_t) :: probe(2)
      real(wp) :: f_elastic(1), f_n(1, 2)
      integer :: i

      associate (body => self%journal(k)%body, s_i => self%journal(k)%s_i, s_j => self%journal(k)%s_j)
         associate (rot_i => motion%rot(1:2, 1:2, body(1)), rot_j => motion%rot(1:2, 1:2, body(2)))
            wear%place = motion%r(1:2, body(2)) - motion%r(1:2, body(1)) + matmul(rot_j, s_j)
            wear%place = matmul(wear%place, rot_i) - s_i
         end associate
         wear%turned = motion%angle(body(2)) - motion%angle(body(1))
      end associate
      probe = contact
      probe%rate = 0.0_wp
      probe(2)%delta = (1.0_wp + small)*contact%delta
      do i = 1, 2
         call self%press(k, probe(i:i), f_n(:, i), f_elastic)
      end do
      wear%exponent = 0.0_wp
      if (minval(f_n) > 0.0_wp) wear%exponent = log(f_n(1, 2)/f_n(1, 1))/log(1.0_wp + small)
   end subroutine find_place

end module clearance_revolute
