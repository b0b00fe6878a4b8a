!> Cylindrical joint: an axis through a point of i and one through a point of j are one line.
!>
!> Phi = [ x_i . z_j,  y_i . z_j,  x_i . d,  y_i . d ]                      (4 rows)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2.4. Limits: none.
module spatial_cylindrical
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_slide_channels, add_spatial_channels, &
      add_turn_channels, beside, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_cylindrical_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_cylindrical_t
   contains
      procedure, nopass :: info => cylindrical_info
      procedure :: prepare => cylindrical_prepare
   end type spatial_cylindrical_t

contains

   !> Description of the kind.
   function cylindrical_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.cylindrical"
      info%help = "a shaft that rotates and slides in a hole"
      info%source = "Nikravesh (1988), section 7.2.4"
      info%n_row = 4
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the shaft")
      call add_spatial_channels(info)
      call add_turn_channels(info)
      call add_slide_channels(info)
   end function cylindrical_info

   !> Elements of the joint.
   subroutine cylindrical_prepare(self, items, angle)
      class(spatial_cylindrical_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [across(1, 3), across(2, 3), beside(1), beside(2)])
   end subroutine cylindrical_prepare

end module spatial_cylindrical
