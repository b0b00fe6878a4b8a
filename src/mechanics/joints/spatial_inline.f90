!> Inline primitive: the point of j stays on the line through that of i along its axis.
!>
!> Phi = [ x_i . d,  y_i . d ]                                             (2 rows)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements. Limits: none.
module spatial_inline
   use item, only: item_t
   use kind_info, only: add_direction, kind_info_t
   use kinds, only: wp
   use spatial_joint, only: add_joint_columns, add_slide_channels, add_spatial_channels, beside, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_inline_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_inline_t
   contains
      procedure, nopass :: info => inline_info
      procedure :: prepare => inline_prepare
   end type spatial_inline_t

contains

   !> Description of the kind.
   function inline_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.inline"
      info%help = "a point of j stays on an axis of i"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 2
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "line of the point of j, in the frame of the body of i", default='"0 0 1"')
      call add_spatial_channels(info)
      call add_slide_channels(info)
   end function inline_info

   !> Elements of the joint.
   subroutine inline_prepare(self, items, angle)
      class(spatial_inline_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [beside(1), beside(2)])
   end subroutine inline_prepare

end module spatial_inline
