!> Perpendicular primitive: two axes stay at right angles, and the bodies move freely.
!>
!> Phi = [ z_i . z_j ]                                                     (1 row)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements.
!> Limits: the axis of j must be given, since that of i is not it.
module spatial_perpendicular
   use item, only: item_t
   use kind_info, only: add_direction, kind_info_t
   use kinds, only: wp
   use spatial_joint, only: across, add_joint_columns, add_spatial_channels, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_perpendicular_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_perpendicular_t
   contains
      procedure, nopass :: info => perpendicular_info
      procedure :: prepare => perpendicular_prepare
   end type spatial_perpendicular_t

contains

   !> Description of the kind.
   function perpendicular_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.perpendicular"
      info%help = "an axis of one body stays perpendicular to an axis of the other"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 1
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "axis, in the frame of the body of i")
      call add_direction(info, "axis_j", "axis, in the frame of the body of j")
      call add_spatial_channels(info)
   end function perpendicular_info

   !> Elements of the joint.
   subroutine perpendicular_prepare(self, items, angle)
      class(spatial_perpendicular_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [across(3, 3)])
   end subroutine perpendicular_prepare

end module spatial_perpendicular
