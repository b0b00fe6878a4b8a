!> Inplane primitive: the point of j stays in the plane through that of i across its axis.
!>
!> Phi = [ z_i . d ]                                                       (1 row)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements. Limits: none.
module spatial_inplane
   use item, only: item_t
   use kind_info, only: add_direction, kind_info_t
   use kinds, only: wp
   use spatial_joint, only: add_joint_columns, add_spatial_channels, beside, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_inplane_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_inplane_t
   contains
      procedure, nopass :: info => inplane_info
      procedure :: prepare => inplane_prepare
   end type spatial_inplane_t

contains

   !> Description of the kind.
   function inplane_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.inplane"
      info%help = "a point of j stays in a plane of i"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 1
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "normal of the plane, in the frame of the body of i", default='"0 0 1"')
      call add_spatial_channels(info)
   end function inplane_info

   !> Elements of the joint.
   subroutine inplane_prepare(self, items, angle)
      class(spatial_inplane_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [beside(3)])
   end subroutine inplane_prepare

end module spatial_inplane
