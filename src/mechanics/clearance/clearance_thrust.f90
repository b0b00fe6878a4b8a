!> A thrust bearing with clearance in space: two collars of body j between the faces of a bearing of body i.
!>
!> The faces of the bearing are across its axis z, half of `length` either side of its point. The collars are beyond them, so that
!> each has the clearance `gap` where the pin's point is in the middle. Face and collar meet on a circle of `face_radius` about
!> the pin's axis, in six points of the collar: contacts a_1 ... a_6 at the end of -z, b_1 ... b_6 at the other, the first along x,
!> the others counter-clockwise about z; x is `x_i` as far as it is across the axis. With n = +z (a) and -z (b) and h = -length/2
!> in `plane_contacts`. Six points resist a tilt alike in all directions as long as all touch; how far a collar may tilt until it
!> touches differs by 15 %, as cos 30 deg, between the direction of a point and that between two.
!>
!> Signs: the reported force is that on the collars, world frame; the moment is that of the contact forces on them about the pin's
!> point. Friction at the points gives the moment about the axis. Source: Flores et al. (2008), section 6.3, where the pin is held
!> along its axis by nothing; stiffness that of a rounded edge on a plane. Limits: faces reach as far as the collars tilt and
!> wander across; the axis itself is held by another joint.
module clearance_thrust
   use bodies, only: material_t
   use item, only: item_t
   use kind_info, only: add_channel, add_direction, add_number, add_reference, dim_length, in_space, kind_info_t
   use kinds, only: pi, wp
   use plane_contacts, only: plane_contacts_t
   use point_contacts, only: add_contact_channels, of_axial_displacement, of_force, of_moment, of_tilt
   use surfaces, only: shape_plane, surfaces_t, take_materials
   use text, only: text_t
   implicit none (type, external)
   private
   public :: clearance_thrust_t

   integer, parameter :: n_point = 6  !! points of a collar

   !> Collars between faces.
   type, extends(plane_contacts_t) :: clearance_thrust_t
   contains
      procedure, nopass :: info => thrust_info
      procedure, nopass :: contact_labels => thrust_labels
      procedure :: prepare => thrust_prepare
      procedure, nopass :: describe => thrust_describe
   end type clearance_thrust_t

contains

   !> Description of the geometry.
   function thrust_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.thrust"
      info%space = in_space
      info%help = "two collars with clearance between the faces of a bearing; --ideal keeps the contact, as no ideal joint "// &
         "corresponds to it"
      info%source = "Flores et al. (2008), section 6.3, and the definition"
      call add_reference(info, "bearing", "points", "middle between the faces, on the bearing's axis")
      call add_reference(info, "journal", "points", "middle between the collars, on the pin's axis")
      call add_direction(info, "axis_i", "axis of the bearing, in the frame of its body", default='"0 0 1"')
      call add_direction(info, "axis_j", "axis of the pin, in the frame of its body; default: consistent with the given "// &
         "positions", &
                         default="")
      call add_direction(info, "x_i", "direction of the first points from the axis, in the frame of the body of the bearing; left &
                         &out: that of its axes which comes after the one nearest to the axis", default="")
      call add_number(info, "length", dim_length, "distance between the faces", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "gap", dim_length, "axial clearance at each end", lower=0.0_wp, open_lower=.true.)
      call add_number(info, "face_radius", dim_length, "radius of the contact circle of faces and collars", lower=0.0_wp, &
                      open_lower=.true.)
      call add_number(info, "edge_radius", dim_length, "edge radius of a collar, for the contact stiffness", lower=0.0_wp, &
                      open_lower=.true.)
      call add_reference(info, "material", "material", "material of bearing and collars")
      call add_reference(info, "journal_material", "material", "material of the collars, if different", default="none")
      call add_reference(info, "law", "contact.", "normal law of the contact points, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "force", "N", "world", 2, "force on the collars", of_force)
      call add_channel(info, "moment", "N.m", "world", 2, "moment on the collars about the pin's point", of_moment)
      call add_channel(info, "tilt", "rad", "joint", 1, "angle between the axes of bearing and pin", of_tilt)
      call add_channel(info, "axial_displacement", "m", "joint", 1, "middle of the pin relative to that of the bearing, along "// &
         "its axis", &
                       of_axial_displacement)
      call add_contact_channels(info, "collar", "its sliding velocity")
   end function thrust_info

   !> The points of both collars.
   pure function thrust_labels() result(labels)
      type(text_t), allocatable :: labels(:)  !! (contacts of an item) names

      integer :: m

      allocate (labels(2*n_point))
      do m = 1, n_point
         labels(m)%s = "a_"//achar(iachar("0") + m)
         labels(n_point + m)%s = "b_"//achar(iachar("0") + m)
      end do
   end function thrust_labels

   !> Points of the collars and faces of each item.
   subroutine thrust_prepare(self, items)
      class(clearance_thrust_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)              !! (n) rows of the table

      real(wp) :: angle, half
      integer :: end_sign, k, m, p

      call self%make_planes(items)
      self%traits%is_gap = .true.
      m = 0
      do k = 1, self%n
         associate (item => items(k))
            self%items%pairs(k)%clearance = item%number("gap")
            half = 0.5_wp*item%number("length")
            do end_sign = -1, 1, 2
               do p = 1, n_point
                  m = m + 1
                  angle = 2.0_wp*pi*real(p - 1, wp)/real(n_point, wp)
                  self%planes%normal(:, m) = [0.0_wp, 0.0_wp, -real(end_sign, wp)]
                  self%planes%point(1:2, m) = item%number("face_radius")*[cos(angle), sin(angle)]
                  self%planes%point(3, m) = real(end_sign, wp)*(half + item%number("gap"))
                  self%planes%height(m) = -half
               end do
            end do
         end associate
      end do
   end subroutine thrust_prepare

   !> A rounded edge on a plane.
   pure subroutine thrust_describe(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      pair%shape = shape_plane
      pair%radius_j = item%number("edge_radius")
      call take_materials(pair, materials, item%reference("material"), item%reference("journal_material"))
   end subroutine thrust_describe

end module clearance_thrust
