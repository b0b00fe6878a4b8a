!> Parallel-axes primitive: two axes stay parallel, and the bodies move freely.
!>
!> Phi = [ x_i . z_j,  y_i . z_j ]                                         (2 rows)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements. Limits: none.
module spatial_parallel_axes
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_spatial_channels, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_parallel_axes_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_parallel_axes_t
   contains
      procedure, nopass :: info => parallel_info
      procedure :: prepare => parallel_prepare
   end type spatial_parallel_axes_t

contains

   !> Description of the kind.
   function parallel_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.parallel_axes"
      info%help = "an axis of one body stays parallel to an axis of the other"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 2
      call add_joint_columns(info)
      call add_axis_columns(info, "axis that stays parallel")
      call add_spatial_channels(info)
   end function parallel_info

   !> Elements of the joint.
   subroutine parallel_prepare(self, items, angle)
      class(spatial_parallel_axes_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [across(1, 3), across(2, 3)])
   end subroutine parallel_prepare

end module spatial_parallel_axes
