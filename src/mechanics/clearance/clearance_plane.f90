!> Planar: a disc or a ball of body j against a plane fixed in body i.
!>
!> With the outward normal N of the plane, C the centre of the ball and P a point of the plane:
!> delta = R - N . (r_C - r_P),   n = -N,   rates: see `flat_contacts`, forces: `point_contacts`.
!>
!> Signs: the reported force is that on the ball, world frame; the friction force is its component along t = R90 n, which
!> is N turned by a right angle clockwise: +x of a floor below.
!> Source: Flores et al. (2008), section 3.6 (figure 3.12), (3.5) for the stiffness of a ball on a plane; (3.18) with its sign
!> put right. Limits: a plane without ends; the ball is a half space of its radius for the stiffness.
module clearance_plane
   use bodies, only: material_t
   use flat_contacts, only: flat_contacts_t
   use item, only: item_t
   use joint_translational, only: add_axis_columns
   use kind_info, only: add_channel, add_number, add_reference, dim_length, in_plane, kind_info_t
   use kinds, only: wp
   use point_contacts, only: add_contact_channels, of_force
   use surfaces, only: shape_plane, surfaces_t, take_materials
   implicit none (type, external)
   private
   public :: clearance_plane_t, describe_ball

   !> Balls on planes.
   type, extends(flat_contacts_t) :: clearance_plane_t
   contains
      procedure, nopass :: info => plane_info
      procedure :: prepare => plane_prepare
      procedure, nopass :: describe => describe_ball
   end type clearance_plane_t

contains

   !> Description of the geometry.
   function plane_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.plane"
      info%space = in_plane
      info%help = "a ball or disc on a plane; --ideal keeps its contact, as no ideal joint corresponds to it"
      info%source = "Flores et al. (2008), sections 3.1 and 3.6"
      call add_reference(info, "plane", "points", "a point of the plane")
      call add_reference(info, "ball", "points", "centre of the ball or disc")
      call add_axis_columns(info, "outward normal of the plane,")
      call add_number(info, "radius", dim_length, "radius of the ball", lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of plane and ball")
      call add_reference(info, "ball_material", "material", "material of the ball, if different", default="none")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "force", "N", "world", 2, "force on the ball", of_force)
      call add_contact_channels(info, "ball", "t = R90 n")
   end function plane_info

   !> Normal and radius of each item.
   subroutine plane_prepare(self, items)
      class(clearance_plane_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)             !! (n) rows of the table

      real(wp) :: c, s
      integer :: k

      call self%make_planes()
      do k = 1, self%n
         associate (item => items(k))
            c = cos(item%number("axis_angle"))
            s = sin(item%number("axis_angle"))
            self%plane%normal_i(:, k) = -merge([c, s], [-s, c], item%word("axis") == "x")
            self%plane%radius(k) = item%number("radius")
            self%plane%height(k) = -self%plane%radius(k)
            self%plane%point_j(:, k) = self%items%s_j(1:2, k)
            self%items%pairs(k)%clearance = self%plane%radius(k)
         end associate
      end do
   end subroutine plane_prepare

   !> A ball on a plane.
   pure subroutine describe_ball(item, materials, pair)
      type(item_t), intent(in) :: item              !! the row
      type(material_t), intent(in) :: materials(:)  !! (materials) all materials
      type(surfaces_t), intent(out) :: pair         !! its surfaces

      pair%shape = shape_plane
      pair%radius_j = item%number("radius")
      call take_materials(pair, materials, item%reference("material"), item%reference("ball_material"))
   end subroutine describe_ball

end module clearance_plane
