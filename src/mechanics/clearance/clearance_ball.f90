!> A ball of body j against a plane fixed in body i, in space.
!>
!> With the outward normal N of the plane, C the centre of the ball and P a point of the plane:
!> delta = R - N . (r_C - r_P),   n = -N,   h = -R in `plane_contacts`; forces: `point_contacts`.
!>
!> Signs: the reported force is that on the ball, world frame; the friction force is along its sliding velocity.
!> Source: Flores et al. (2008), section 3.6, with the surfaces of space, (3.5) for the stiffness of a ball on a plane. Limits: a
!> plane without ends; the ball is a half space of its radius for the stiffness; friction has no moment about the normal.
module clearance_ball
   use clearance_plane, only: describe_ball
   use item, only: item_t
   use kind_info, only: add_channel, add_direction, add_number, add_reference, dim_length, in_space, kind_info_t
   use kinds, only: wp
   use plane_contacts, only: plane_contacts_t
   use point_contacts, only: add_contact_channels, of_force
   implicit none (type, external)
   private
   public :: clearance_ball_t

   !> Balls on planes, in space.
   type, extends(plane_contacts_t) :: clearance_ball_t
   contains
      procedure, nopass :: info => ball_info
      procedure :: prepare => ball_prepare
      procedure, nopass :: describe => describe_ball
   end type clearance_ball_t

contains

   !> Description of the geometry.
   function ball_info() result(info)
      type(kind_info_t) :: info  !! name, columns and channels

      info%name = "clearance.plane"
      info%space = in_space
      info%help = "a ball on a plane; --ideal keeps its contact, as no ideal joint corresponds to it"
      info%source = "Flores et al. (2008), sections 3.1 and 3.6"
      call add_reference(info, "plane", "points", "a point of the plane")
      call add_reference(info, "ball", "points", "centre of the ball")
      call add_direction(info, "axis_i", "outward normal of the plane, in the frame of the body of the plane", &
                         default='"0 0 1"')
      call add_number(info, "radius", dim_length, "radius of the ball", lower=0.0_wp, open_lower=.true.)
      call add_reference(info, "material", "material", "material of plane and ball")
      call add_reference(info, "ball_material", "material", "material of the ball, if different", default="none")
      call add_reference(info, "law", "contact.", "normal law, a row of a contact table")
      call add_reference(info, "friction", "friction.", "friction law, a row of a friction table, or none", default="none")
      call add_channel(info, "force", "N", "world", 2, "force on the ball", of_force)
      call add_contact_channels(info, "ball", "its sliding velocity")
   end function ball_info

   !> Plane and radius of each item.
   subroutine ball_prepare(self, items)
      class(clearance_ball_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)            !! (n) rows of the table

      integer :: k

      call self%make_planes(items)
      do k = 1, self%n
         self%planes%normal(:, k) = [0.0_wp, 0.0_wp, -1.0_wp]
         self%planes%radius(k) = items(k)%number("radius")
         self%planes%height(k) = -self%planes%radius(k)
         self%items%pairs(k)%clearance = self%planes%radius(k)
      end do
   end subroutine ball_prepare

end module clearance_ball
