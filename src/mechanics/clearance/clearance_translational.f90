!> Planar: a translational joint with clearance, a slider of body j between two straight surfaces of body i.
!>
!> The guide's line goes through its point P along the unit axis s, fixed in body i; its surfaces lie on both sides of it, at
!> half the slider's height plus the gap of the side: upper along R90 s (normal n = R90 s, into the material), lower against it
!> (n = -R90 s). The slider is a rectangle, length along its own axis, height across, about its centre. Its corners are A, B, C, D,
!> counter-clockwise from the one behind and below. Each corner may touch each surface: contacts A_upper ... D_lower, with
!> delta = n . (r_A - r_P) - (height/2 + gap), rates as in `flat_contacts`, forces as in `point_contacts`, at the corner.
!> Guides that end, at guide_start and guide_end along s, have a front there, which a corner that comes at it touches
!> (`flat_contacts`); with faces a contact lasts while guide_start <= s . (r_A - r_P) <= guide_end.
!>
!> Faces, where both corners of a long side are at one surface (column `faces`): see `slider_contacts`.
!>
!> `corners` is the default: it is what the book's study of the slider-crank uses, it needs no width and no second law, and two
!> rounded corners are what touches first.
!>
!> Signs: the reported force is that on the slider, world frame; the eccentricity is the slider's centre from the guide's line,
!> perpendicular to it, world frame; the moment is that of the contact forces on the slider about its centre.
!> Source: Flores et al. (2008), section 4.3, (4.14)-(4.27), corrected: see `flat_contacts`; (4.26) with the stiffness of a
!> rectangle. Limits: short sides have corners only; see `slider_contacts` for the ends of guides with faces.
module clearance_translational
   use bodies, only: material_t
   use clearance_set, only: clearance_fit
   use floors, only: gentle
   use item, only: item_t, place_of
   use joint_translational, only: add_axis_columns
   use kind_info, only: add_channel, add_number, add_reference, add_word, dim_angle, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use normal_law, only: n_law_parameter, parameter_gentle
   use point_contacts, only: add_contact_channels, of_eccentricity, of_force, of_moment
   use slider_contacts, only: faces_blend, faces_book, faces_corners, faces_foundation, lower, n_corner, slider_contacts_t, upper
   use surfaces, only: shape_face, shape_plane, surfaces_t, take_materials
   use text, only: to_text
   implicit none (type, external)
   private
   public :: add_guide_ends, clearance_translational_t, describe_corner, find_end_mistake

   real(wp), parameter :: corner_x(n_corner) = [-0.5_wp, 0.5_wp, 0.5_wp, -0.5_wp]   !! of the length [1]
   real(wp), parameter :: corner_y(n_corner) = [-0.5_wp, -0.5_wp, 0.5_wp, 0.5_wp]   !! of the height [1]

   !> Sliders in guides, in the plane.
   type, extends(slider_contacts_t) :: clearance_translational_t
   contains
      procedure, nopass :: info => translational_info
      procedure, nopass :: ideal_kind => translational_ideal_kind
      procedure :: prepare => translational_prepare
      procedure, nopass :: mistake => translational_mistake
      procedure, nopass :: describe => describe_corner
      procedure :: fit => translational_fit
   end type clearance_translational_t

contains

   !> Description of the geometry.
   function translational_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.translational"
      info%space = in_plane
      info%help = "a slider with clearance in a straight guide: dry contact of its corners or faces with two surfaces"
      info%source = "Flores et al. (2008), section 4.3"
      call add_reference(info, "guide", "points", "point on the guide axis")
      call add_reference(info, "slider", "points", "centre of the slider")
      call add_axis_columns(info, "guide")
      call add_number(info, "length", dim_length, "length of the slider, along its axis", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "height", dim_length, "height of the slider, across the guide", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "width", dim_length, "width of the slider, normal to the plane, for the face law; 0: unknown", &
                      default="0 m", lower=0.0_wp)
      call add_number(info, "gap", dim_length, "clearance on each side; gap_upper and gap_lower override it", &
                      default="0 m", lower=0.0_wp)
      call add_number(info, "gap_upper", dim_length, "clearance on the side of R90 axis; default: gap", default="0 m", &
                      lower=0.0_wp)
      call add_number(info, "gap_lower", dim_length, "clearance on the other side; default: gap", default="0 m", lower=0.0_wp)
      call add_number(info, "corner_radius", dim_length, "radius of the slider corners, for the contact stiffness", lower=0.0_wp, &
                      open_lower=.true.)
      call add_word(info, "slider_axis", "direction of the slider length: an axis of its body", default="x", choices="x y")
      call add_number(info, "slider_angle", dim_angle, "angle from that axis to the slider length, counter-clockwise", &
                      default="0 rad")
      call add_guide_ends(info)
      call add_reference(info, "material", "material", "material of slider and guide")
      call add_reference(info, "guide_material", "material", "material of the guide, if different", default="none")
      call add_word(info, "level", "model: an ideal translational joint, or clearance", default="clearance", &
                    choices="ideal clearance")
      call add_reference(info, "law", "contact.", "normal law of the corners, a row of a contact table")
      call add_reference(info, "face_law", "contact.", "normal law of the faces, a row of contact.plane_face, or none", &
                         default="none")
      call add_word(info, "faces", "contact of both corners of a long side: separate corners, the discontinuous switch of "// &
         "Flores et al. (2008) to the " &
                    //"face law (book), or continuous transitions (blend, foundation)", default="corners", &
                    choices="corners book blend foundation")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "eccentricity", "m", "world", 2, "centre of the slider relative to the guide axis", &
                       of_eccentricity)
      call add_channel(info, "force", "N", "world", 2, "force on the slider", of_force)
      call add_channel(info, "moment", "N.m", "world", 1, "moment on the slider about its centre", of_moment)
      call add_contact_channels(info, "slider", "t = R90 n")
   end function translational_info

   !> Columns of the ends of a guide.
   subroutine add_guide_ends(info)
      type(kind_info_t), intent(inout) :: info  !! the geometry

      call add_number(info, "guide_start", dim_length, "start of the guide surfaces, along the axis from the point guide", &
                      default="0 m")
      call add_number(info, "guide_end", dim_length, "end of the guide surfaces; both 0: unlimited", default="0 m")
   end subroutine add_guide_ends

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

      call self%make_planes()
      self%traits%is_gap = .true.
      allocate (self%guide%axis(2, self%n), self%guide%ends(2, self%n), self%guide%face_parameters(n_law_parameter, self%n), &
                source=0.0_wp)
      allocate (self%guide%faces(self%n), source=faces_corners)
      do k = 1, self%n
         associate (item => items(k))
            self%guide%axis(:, k) = direction(item%word("axis"), item%number("axis_angle"))
            along = direction(item%word("slider_axis"), item%number("slider_angle"))
            gap = item%number("gap")
            if (item%is_given("gap_upper")) gap(upper) = item%number("gap_upper")
            if (item%is_given("gap_lower")) gap(lower) = item%number("gap_lower")
            self%items%pairs(k)%clearance = minval(gap)
            self%guide%ends(:, k) = [item%number("guide_start"), item%number("guide_end")]
            if (maxval(abs(self%guide%ends(:, k))) <= 0.0_wp) self%guide%ends(:, k) = [-huge(1.0_wp), huge(1.0_wp)]
            do side = upper, lower
               do c = 1, n_corner
                  m = (k - 1)*self%n_contact_item + (side - 1)*n_corner + c
                  self%plane%normal_i(:, m) = merge(1.0_wp, -1.0_wp, side == upper)*[-self%guide%axis(2, k), self%guide%axis(1, k)]
                  self%plane%point_j(:, m) = self%items%s_j(1:2, k) + corner_x(c)*item%number("length")*along &
                                       + corner_y(c)*item%number("height")*[-along(2), along(1)]
                  self%plane%height(m) = 0.5_wp*item%number("height") + gap(side)
               end do
            end do
            select case (item%word("faces"))
            case ("book"); self%guide%faces(k) = faces_book
            case ("blend"); self%guide%faces(k) = faces_blend
            case ("foundation"); self%guide%faces(k) = faces_foundation
            end select
            if (self%guide%faces(k) /= faces_corners) cycle
            do m = (k - 1)*self%n_contact_item + 1, k*self%n_contact_item
               self%plane%axis_i(:, m) = self%guide%axis(:, k)
               self%plane%ends(:, m) = self%guide%ends(:, k)
            end do
         end associate
      end do
      self%traits%has_faces = any(self%guide%faces /= faces_corners)
      self%plane%has_ends = any(self%plane%ends(2, :) < huge(1.0_wp))
      self%traits%energy_jumps = any(self%guide%faces == faces_book) .or. &
                                 any(self%guide%faces /= faces_corners .and. self%guide%ends(2, :) < huge(1.0_wp))
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

      call find_end_mistake(item, column, message, help)
      if (column > 0) return
      if (.not. item%is_given("gap") .and. .not. (item%is_given("gap_upper") .and. item%is_given("gap_lower"))) then
         column = place_of(item, "gap")
         message = "the clearance is missing"
         help = "give the column gap, or gap_upper and gap_lower"
      else if (item%word("faces") /= "corners" .and. item%reference("face_law") == 0) then
         column = place_of(item, "faces")
         message = "faces = "//item%word("faces")//" needs the column face_law"
         help = "name a row of contact.plane_face there, or set faces = corners"
      end if
   end subroutine translational_mistake

   !> Ends of a guide must be in order, and hold the slider.
   subroutine find_end_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = ""
      help = ""
      associate (length => item%number("guide_end") - item%number("guide_start"))
         if (length >= item%number("length") .or. &
             .not. max(abs(item%number("guide_start")), abs(item%number("guide_end"))) > 0.0_wp) return
         column = place_of(item, "guide_end")
         if (length > 0.0_wp) then
            message = "the guide is "//to_text(length)//" m long, shorter than the block: its corners cannot all be inside"
            help = "contact acts at single corners: set guide_start and guide_end at least "//to_text(item%number("length")) &
                   //" m apart"
         else
            message = "guide_end must be beyond guide_start"
            help = "for unlimited surfaces omit both, or set both to 0"
         end if
      end associate
   end subroutine find_end_mistake

   !> A rounded corner of a slider on a plane, with the sides of the face it belongs to.
   pure subroutine describe_corner(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      pair%shape = shape_plane
      pair%radius_j = item%number("corner_radius")
      pair%length = item%number("length")
      pair%width = item%number("width")
      call take_materials(pair, materials, item%reference("guide_material"), item%reference("material"))
   end subroutine describe_corner

   !> Fit the corner law, and the face law if there is one.
   subroutine translational_fit(self, k)
      class(clearance_translational_t), intent(inout) :: self  !! the set
      integer, intent(in) :: k                                 !! the item

      type(surfaces_t) :: pair
      character(:), allocatable :: help, message

      call clearance_fit(self, k)
      if (.not. allocated(self%laws%face)) return
      pair = self%items%pairs(k)
      pair%shape = shape_face
      call self%laws%face%fit(pair, self%guide%face_parameters(:, k), message, help)
      self%guide%face_parameters(parameter_gentle, k) = gentle**2*pair%inverse_mass
   end subroutine translational_fit

end module clearance_translational
