!> Planar translational joint with clearance: a slider of body j loose between two straight surfaces of body i.
!>
!> The guide's line goes through its point P along the unit axis s, fixed in body i; its surfaces lie on both sides of it, at
!> half the slider's height plus the gap of the side: upper along R90 s (normal n = R90 s, into the material), lower against it
!> (n = -R90 s). The slider is a rectangle, length along its own axis, height across, about its centre. Its corners are A, B, C, D,
!> counter-clockwise from the one behind and below. Each corner may touch each surface: contacts A_upper ... D_lower, with
!> delta = n . (r_A - r_P) - (height/2 + gap), forces and friction as in `flat_contacts`, acting on both bodies at the corner.
!> A contact lasts while the corner is between the ends of the guide, guide_start <= s . (r_A - r_P) <= guide_end.
!>
!> Faces, where both corners of a long side are at one surface, penetrating by d_1 and d_2, L the length, K_f that of `face_law`:
!> corners     each corner for itself, with the normal law
!> book        the face law instead: F = K_f (d_1 + d_2)/2 at L/3 (d_1 + 2 d_2)/(d_1 + d_2) from corner 1; it begins and ends
!>             with the located onset and end of the second corner, with a jump of the force
!> blend       (1 - w) corners + w face, w = S(min(d_1, d_2)/max(d_1, d_2)), S(r) = r^2 (3 - 2 r): no jump
!> foundation  springs K_f/L per length under the part that penetrates; of one corner l = L d_1/(d_1 - d_2), F = K_f d_1 l/(2 L)
!>             at l/3: no jump, and no corner law
!> The face force is damped with the rate at its point of application and the impact speed (v_1 d_1 + v_2 d_2)/(d_1 + d_2), that
!> of the corners weighted by their depth, so that a corner that comes or goes changes nothing. It acts as two forces at the
!> corners with the same resultant. What blend gives beyond the gradient of its own energy (1 - w) U_corners + w U_face is
!> counted as lost in contact (it may be negative: weights that depend on the position have no potential).
!>
!> `corners` is the default: it is what the book's study of the slider-crank uses, it needs no width and no second law, and two
!> rounded corners are what touches first.
!>
!> Signs: the reported force is that on the slider, world frame; the eccentricity is the slider's centre from the guide's line,
!> perpendicular to it, world frame; the moment is that of the contact forces on the slider about its centre.
!> Source: Flores et al. (2008), section 4.3, (4.14)-(4.27), corrected: see `flat_contacts`; (4.26) with the stiffness of a
!> rectangle. Limits: short sides have corners only; the ends of the guide cut corners, not the part of a face; a corner that
!> enters between the surfaces from beyond an end begins its contact there.
module clearance_translational
   use bodies, only: material_t
   use clearance_set, only: clearance_fit_law
   use flat_contacts, only: add_contact_channels, flat_contacts_t, flat_gaps, flat_report, flat_t
   use floors, only: gentle
   use item, only: item_t
   use joint_translational, only: add_axis_columns
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_angle, dim_length, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use normal_law, only: n_law_parameter, parameter_gentle
   use slider_faces, only: bedding_energy, blend_energy, find_blend, find_face
   use surfaces, only: set_materials, shape_face, shape_plane, surfaces_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_translational_t

   integer, parameter :: column_axis = 3             !! column of axis
   integer, parameter :: column_angle = 4            !! column of axis_angle
   integer, parameter :: column_length = 5           !! column of length
   integer, parameter :: column_height = 6           !! column of height
   integer, parameter :: column_width = 7            !! column of width
   integer, parameter :: column_gap = 8              !! column of gap
   integer, parameter :: column_upper = 9            !! column of gap_upper
   integer, parameter :: column_lower = 10           !! column of gap_lower
   integer, parameter :: column_radius = 11          !! column of corner_radius
   integer, parameter :: column_slider_axis = 12     !! column of slider_axis
   integer, parameter :: column_slider_angle = 13    !! column of slider_angle
   integer, parameter :: column_start = 14           !! column of guide_start
   integer, parameter :: column_end = 15             !! column of guide_end
   integer, parameter :: column_material = 16        !! column of material
   integer, parameter :: column_guide_material = 17  !! column of guide_material
   integer, parameter :: column_face_law = 20        !! column of face_law
   integer, parameter :: column_faces = 21           !! column of faces

   integer, parameter :: n_corner = 4                !! corners
   integer, parameter :: upper = 1                   !! contacts 1 to 4: corners at the upper surface
   integer, parameter :: lower = 2                   !! contacts 5 to 8: corners at the lower surface
   integer, parameter :: side_1(2) = [1, 4]          !! first corners of the long sides: A and D
   integer, parameter :: side_2(2) = [2, 3]          !! second corners: B and C
   real(wp), parameter :: corner_x(n_corner) = [-0.5_wp, 0.5_wp, 0.5_wp, -0.5_wp]   !! of the length [1]
   real(wp), parameter :: corner_y(n_corner) = [-0.5_wp, -0.5_wp, 0.5_wp, 0.5_wp]   !! of the height [1]

   integer, parameter :: faces_corners = 0     !! ways of treating faces
   integer, parameter :: faces_book = 1        !! the same
   integer, parameter :: faces_blend = 2       !! the same
   integer, parameter :: faces_foundation = 3  !! the same

   !> Sliders between surfaces, in the plane.
   type, extends(flat_contacts_t) :: clearance_translational_t
      real(wp), allocatable :: axis(:, :)              !! (2, n) unit axis of the guide, frame of i [1]
      real(wp), allocatable :: ends(:, :)              !! (2, n) ends of the guide along it, from P [m]
      integer, allocatable :: faces(:)                 !! (n) way of treating faces
      real(wp), allocatable :: face_parameters(:, :)   !! (n_law_parameter, n) of the face law [any]
   contains
      procedure, nopass :: info => translational_info
      procedure, nopass :: contact_labels => translational_contact_labels
      procedure, nopass :: ideal_kind => translational_ideal_kind
      procedure :: prepare => translational_prepare
      procedure, nopass :: mistake => translational_mistake
      procedure, nopass :: describe => translational_describe
      procedure :: fit_law => translational_fit_law
      procedure :: gaps => translational_gaps
      procedure :: report => translational_report
      procedure :: share_faces => translational_share_faces
      procedure :: face_energy => translational_face_energy
   end type clearance_translational_t

contains

   !> What the geometry says of itself.
   function translational_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.translational"
      info%help = "a slider loose in a straight guide: dry contact of its corners or faces with two surfaces"
      info%source = "Flores et al. (2008), section 4.3"
      call add_reference(info, "guide", "points", "point on the guide's line")
      call add_reference(info, "slider", "points", "centre of the slider")
      call add_axis_columns(info, "guide")
      call add_number(info, "length", dim_length, "length of the slider, along its axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "height", dim_length, "height of the slider, across", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "width", dim_length, "width of the slider, out of the plane, for the face law; 0: not known", &
                      default="0 m", lower=0.0_wp)
      call add_number(info, "gap", dim_length, "clearance on each side, where gap_upper or gap_lower does not say otherwise", &
                      default="0 m", lower=0.0_wp)
      call add_number(info, "gap_upper", dim_length, "clearance on the side of R90 axis; left out: gap", default="0 m", &
                      lower=0.0_wp)
      call add_number(info, "gap_lower", dim_length, "clearance on the other side; left out: gap", default="0 m", lower=0.0_wp)
      call add_number(info, "corner_radius", dim_length, "radius of the slider's corners, for their stiffness", lower=0.0_wp, &
                      open_lower=.true.)
      call add_word(info, "slider_axis", "direction of the slider's length: an axis of its body", default="x", choices="x y")
      call add_number(info, "slider_angle", dim_angle, "angle from that axis to the slider's length, counter-clockwise", &
                      default="0 rad")
      call add_number(info, "guide_start", dim_length, "where the surfaces begin, along the axis from the point guide", &
                      default="0 m")
      call add_number(info, "guide_end", dim_length, "where they end; both 0: they do not end", default="0 m")
      call add_reference(info, "material", "material", "material of slider and guide")
      call add_reference(info, "guide_material", "material", "material of the guide, if another", default="none")
      call add_word(info, "level", "fidelity: an ideal translational joint, or clearance", default="clearance", &
                    choices="ideal clearance")
      call add_reference(info, "law", "contact.", "normal law of the corners, a row of a contact table")
      call add_reference(info, "face_law", "contact.", "normal law of the faces, a row of contact.plane_face, or none", &
                         default="none")
      call add_word(info, "faces", "both corners of a long side at one surface: each for itself, the book's switch to the " &
                    //"face law with its jump, or one of two ways without", default="corners", &
                    choices="corners book blend foundation")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the slider from the guide's line")
      call add_channel(info, "force", "N", "world", 2, "force on the slider")
      call add_channel(info, "moment", "N.m", "world", 1, "moment on the slider about its centre")
      call add_contact_channels(info, "slider")
   end function translational_info

   !> Corners A to D at the upper, then at the lower surface.
   function translational_contact_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (8) names

      integer :: c

      allocate (labels(2*n_corner))
      do c = 1, n_corner
         labels(c)%s = achar(iachar("A") + c - 1)//"_upper"
         labels(n_corner + c)%s = achar(iachar("A") + c - 1)//"_lower"
      end do
   end function translational_contact_labels

   !> Without clearance a translational joint.
   function translational_ideal_kind() result(kind)
      character(:), allocatable :: kind  !! name of the kind of joint

      kind = "joint.translational"
   end function translational_ideal_kind

   !> Surfaces, corners and ends of each item.
   subroutine translational_prepare(self, items)
      class(clearance_translational_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                     !! (n) rows of the table

      real(wp) :: along(2), gap(2)
      integer :: c, k, m, side

      call self%make_room()
      allocate (self%axis(2, self%n), self%ends(2, self%n), self%face_parameters(n_law_parameter, self%n), source=0.0_wp)
      allocate (self%faces(self%n), source=faces_corners)
      do k = 1, self%n
         associate (values => items(k)%values)
            self%axis(:, k) = direction(values(column_axis)%text, values(column_angle)%number)
            along = direction(values(column_slider_axis)%text, values(column_slider_angle)%number)
            gap = values(column_gap)%number
            if (values(column_upper)%given) gap(upper) = values(column_upper)%number
            if (values(column_lower)%given) gap(lower) = values(column_lower)%number
            self%clearance(k) = minval(gap)
            self%ends(:, k) = [values(column_start)%number, values(column_end)%number]
            if (maxval(abs(self%ends(:, k))) <= 0.0_wp) self%ends(:, k) = [-huge(1.0_wp), huge(1.0_wp)]
            do side = upper, lower
               do c = 1, n_corner
                  m = (k - 1)*self%n_contact_item + (side - 1)*n_corner + c
                  self%normal_i(:, m) = merge(1.0_wp, -1.0_wp, side == upper)*[-self%axis(2, k), self%axis(1, k)]
                  self%point_j(:, m) = self%s_j(1:2, k) + corner_x(c)*values(column_length)%number*along &
                                       + corner_y(c)*values(column_height)%number*[-along(2), along(1)]
                  self%height(m) = 0.5_wp*values(column_height)%number + gap(side)
               end do
            end do
            select case (values(column_faces)%text)
            case ("book"); self%faces(k) = faces_book
            case ("blend"); self%faces(k) = faces_blend
            case ("foundation"); self%faces(k) = faces_foundation
            end select
         end associate
      end do
      self%has_faces = any(self%faces /= faces_corners)
      self%energy_jumps = any(self%faces == faces_book) .or. any(self%ends(2, :) < huge(1.0_wp))
   end subroutine translational_prepare

   !> Unit vector at an angle from an axis of a body.
   pure function direction(axis, angle) result(unit)
      character(*), intent(in) :: axis  !! x or y
      real(wp), intent(in) :: angle     !! counter-clockwise [rad]
      real(wp) :: unit(2)               !! (2) in the body's frame [1]

      unit = merge([cos(angle), sin(angle)], [-sin(angle), cos(angle)], axis == "x")
   end function direction

   !> Gaps must be there, ends in order, and a face needs its law.
   subroutine translational_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      associate (values => item%values)
         if (.not. values(column_gap)%given .and. .not. (values(column_upper)%given .and. values(column_lower)%given)) then
            column = column_gap
            message = "no clearance is given"
            help = "give the column gap, or gap_upper and gap_lower"
         else if (values(column_end)%number <= values(column_start)%number .and. &
                  max(abs(values(column_start)%number), abs(values(column_end)%number)) > 0.0_wp) then
            column = column_end
            message = "guide_end must be beyond guide_start"
            help = "leave both out, or give 0, for surfaces without ends"
         else if (values(column_faces)%text /= "corners" .and. values(column_face_law)%index == 0) then
            column = column_faces
            message = "faces = "//values(column_faces)%text//" needs the column face_law"
            help = "name a row of contact.plane_face there, or take faces = corners"
         end if
      end associate
   end subroutine translational_mistake

   !> A rounded corner on a plane, with the sides of the face it belongs to.
   pure subroutine translational_describe(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      integer :: guide_material

      pair%shape = shape_plane
      pair%radius_j = item%values(column_radius)%number
      pair%length = item%values(column_length)%number
      pair%width = item%values(column_width)%number
      guide_material = item%values(column_guide_material)%index
      if (guide_material == 0) guide_material = item%values(column_material)%index
      call set_materials(pair, materials(guide_material), materials(item%values(column_material)%index))
   end subroutine translational_describe

   !> Fit the corner law, and the face law if there is one.
   subroutine translational_fit_law(self, items, materials, mass, is_driven)
      class(clearance_translational_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                     !! (n) rows of the table
      type(material_t), intent(in) :: materials(:)             !! (materials) all materials
      real(wp), intent(in) :: mass(:)                          !! (bodies) masses of the bodies [kg]
      logical, intent(in) :: is_driven(:)                      !! (bodies) whether drivers alone say how they move

      type(surfaces_t) :: pair
      character(:), allocatable :: help, message
      integer :: k

      call clearance_fit_law(self, items, materials, mass, is_driven)
      if (.not. allocated(self%face_law)) return
      do k = 1, self%n
         pair = self%pairs(k)
         pair%shape = shape_face
         call self%face_law%fit(pair, self%face_parameters(:, k), message, help)
         self%face_parameters(parameter_gentle, k) = gentle**2*pair%inverse_mass
      end do
   end subroutine translational_fit_law

   !> Penetrations and rates; of a corner beyond an end of the guide how far it is beyond, negative, if that is less.
   subroutine translational_gaps(self, motion, delta, rate)
      class(clearance_translational_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      real(wp), intent(inout) :: delta(:)                   !! (all contacts) penetration [m]
      real(wp), intent(inout) :: rate(:)                    !! (all contacts) its rate [m/s]

      type(flat_t) :: contact
      real(wp) :: d(2), inside(2), s(2), speed, v(2)
      integer :: c, i, j, k, m

      call flat_gaps(self, motion, delta, rate)
      do k = 1, self%n
         if (self%ends(2, k) >= huge(1.0_wp)) cycle
         i = self%body(1, k)
         j = self%body(2, k)
         s = motion%rot(1:2, 1, i)*self%axis(1, k) + motion%rot(1:2, 2, i)*self%axis(2, k)
         do c = 1, self%n_contact_item
            m = (k - 1)*self%n_contact_item + c
            call self%measure(m, motion, contact)
            d = contact%arm_i - motion%rot(1:2, 1, i)*self%s_i(1, k) - motion%rot(1:2, 2, i)*self%s_i(2, k)
            v = motion%v(1:2, j) + motion%omega(3, j)*[-contact%arm_j(2), contact%arm_j(1)] &
                - motion%v(1:2, i) - motion%omega(3, i)*[-contact%arm_i(2), contact%arm_i(1)]
            speed = dot_product(s, v)
            inside = [dot_product(s, d) - self%ends(1, k), self%ends(2, k) - dot_product(s, d)]
            if (minval(inside) >= delta(self%first_contact + m)) cycle
            delta(self%first_contact + m) = minval(inside)
            rate(self%first_contact + m) = merge(speed, -speed, inside(1) < inside(2))
         end do
      end do
   end subroutine translational_gaps

   !> Values of a channel: eccentricity and moment here, the rest as of all flat contacts.
   subroutine translational_report(self, channel, motion, values)
      class(clearance_translational_t), intent(in) :: self  !! the set
      character(*), intent(in) :: channel                   !! name of the channel
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      real(wp), intent(inout) :: values(:, :)               !! (components, all items or contacts) values [any]

      real(wp) :: across(2), arm(2)
      integer :: i, j, k

      if (channel /= "eccentricity") then
         call flat_report(self, channel, motion, values)
         return
      end if
      do k = 1, self%n
         i = self%body(1, k)
         j = self%body(2, k)
         across = motion%rot(1:2, 2, i)*self%axis(1, k) - motion%rot(1:2, 1, i)*self%axis(2, k)
         arm = motion%r(1:2, j) + matmul(motion%rot(1:2, 1:2, j), self%s_j(1:2, k)) &
               - motion%r(1:2, i) - matmul(motion%rot(1:2, 1:2, i), self%s_i(1:2, k))
         values(:, self%first + k) = dot_product(across, arm)*across
      end do
   end subroutine translational_report

   !> The contacts of the two corners of a long side at a surface: number q of the four of an item.
   pure function corners_of(q) result(c)
      integer, intent(in) :: q  !! sides 1, 2 at the upper, 3, 4: at the lower surface
      integer :: c(2)           !! (2) contacts of the item

      integer :: side

      side = modulo(q - 1, 2) + 1
      c = (q - side)/2*n_corner + [side_1(side), side_2(side)]
   end function corners_of

   !> Let faces of an item take over from their corners.
   subroutine translational_share_faces(self, item, contacts, f_n, f_elastic, f_rub)
      class(clearance_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                           !! the item
      type(flat_t), intent(in) :: contacts(:)               !! (8) penetrations and rates of its contacts
      real(wp), intent(inout) :: f_n(:)                     !! (8) normal forces, as the normal law gives them [N]
      real(wp), intent(inout) :: f_elastic(:)               !! (8) derivatives of the stored energy by the penetrations [N]
      real(wp), intent(inout) :: f_rub(:)                   !! (8) normal forces that friction feels [N]

      real(wp) :: d(2), f(2), f_d(2), impact_speed(2), rate(2)
      integer :: c(2), q
      logical :: is_touching(2)

      f_rub = f_n
      if (self%faces(item) == faces_corners) return
      do q = 1, n_corner
         c = corners_of(q)
         associate (memory => self%contact((item - 1)*self%n_contact_item + c))
            is_touching = memory%is_touching
            impact_speed = merge(memory%impact_speed, 0.0_wp, is_touching)
         end associate
         if (.not. any(is_touching) .or. (self%faces(item) /= faces_foundation .and. .not. all(is_touching))) cycle
         if (.not. all(is_touching)) impact_speed = sum(impact_speed)
         d = contacts(c)%delta
         rate = contacts(c)%rate
         f = f_n(c)
         f_d = f_elastic(c)
         if (self%faces(item) == faces_blend) then
            call find_blend(self%face_law, self%face_parameters(:, item), d, rate, impact_speed, corner_energy(self, item, c, d), &
                            f, f_d)
         else
            call find_face(self%face_law, self%face_parameters(:, item), d, rate, impact_speed, f, f_d)
         end if
         f_n(c) = f
         f_elastic(c) = f_d
         f_rub(c) = merge(merge(f, sum(f), all(is_touching)), 0.0_wp, is_touching)
      end do
   end subroutine translational_share_faces

   !> Elastic energy of two corners.
   function corner_energy(self, item, c, d) result(energy)
      class(clearance_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                           !! the item
      integer, intent(in) :: c(2)                           !! (2) contacts of the item
      real(wp), intent(in) :: d(2)                          !! (2) their penetrations [m]
      real(wp) :: energy                                    !! of those that touch [J]

      integer :: k, m

      energy = 0.0_wp
      do k = 1, 2
         m = (item - 1)*self%n_contact_item + c(k)
         if (self%contact(m)%is_touching) energy = energy + self%law%potential(d(k), self%parameters(:, m))
      end do
   end function corner_energy

   !> Elastic energy of the corners and faces of an item.
   function translational_face_energy(self, item, contacts) result(energy)
      class(clearance_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: item                           !! the item
      type(flat_t), intent(in) :: contacts(:)               !! (8) penetrations and rates of its contacts
      real(wp) :: energy                                    !! energy stored [J]

      real(wp) :: d(2), of_corners
      integer :: c(2), q
      logical :: is_touching(2)

      energy = 0.0_wp
      do q = 1, n_corner
         c = corners_of(q)
         is_touching = self%contact((item - 1)*self%n_contact_item + c)%is_touching
         if (.not. any(is_touching)) cycle
         d = contacts(c)%delta
         of_corners = corner_energy(self, item, c, d)
         if (self%faces(item) == faces_foundation) then
            energy = energy + bedding_energy(self%face_law, self%face_parameters(:, item), d)
         else if (self%faces(item) == faces_corners .or. .not. all(is_touching)) then
            energy = energy + of_corners
         else if (self%faces(item) == faces_blend) then
            energy = energy + blend_energy(self%face_law, self%face_parameters(:, item), d, of_corners)
         else
            energy = energy + bedding_energy(self%face_law, self%face_parameters(:, item), d)
         end if
      end do
   end function translational_face_energy

end module clearance_translational
