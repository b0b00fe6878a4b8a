!> Planar joint: a plane of j through its point stays in the plane of i through its own; the axis is normal to both.
!>
!> Phi = [ x_i . z_j,  y_i . z_j,  z_i . d ]                                (3 rows)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements. Limits: none.
module spatial_planar
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_spatial_channels, add_turn_channels, beside, &
      spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_planar_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_planar_t
   contains
      procedure, nopass :: info => planar_info
      procedure :: prepare => planar_prepare
   end type spatial_planar_t

contains

   !> Description of the kind.
   function planar_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.planar"
      info%help = "a plane of one body moves in a plane of the other"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 3
      call add_joint_columns(info)
      call add_axis_columns(info, "normal of the plane")
      call add_spatial_channels(info)
      call add_turn_channels(info)
   end function planar_info

   !> Elements of the joint.
   subroutine planar_prepare(self, items, angle)
      class(spatial_planar_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [across(1, 3), across(2, 3), beside(3)])
   end subroutine planar_prepare

end module spatial_planar
