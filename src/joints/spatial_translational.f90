!> Translational (prismatic) joint in space: a cylindrical joint that does not turn.
!>
!> Phi = [ x_i . z_j,  y_i . z_j,  x_i . y_j,  x_i . d,  y_i . d ]          (5 rows)
!>
!> The third row is of perpendicular axes: with parallel ones it would lose its rank. The frame of j is that of i where the deck
!> puts the bodies, unless the deck gives the axis of j.
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2.4. Limits: none.
module spatial_translational
   use item, only: item_t
   use kind_info, only: kind_info_t, leaves_way
   use kinds, only: wp
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_slide_channels, add_spatial_channels, beside, &
      spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_translational_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_translational_t
   contains
      procedure, nopass :: info => translational_info
      procedure :: prepare => translational_prepare
   end type spatial_translational_t

contains

   !> What the kind says of itself.
   function translational_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.translational"
      info%help = "a slider in a guide: it slides along an axis and does not turn"
      info%source = "Nikravesh (1988), section 7.2.4"
      info%n_row = 5
      info%leaves = leaves_way
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the guide")
      call add_spatial_channels(info)
      call add_slide_channels(info)
   end function translational_info

   !> Elements of the joint.
   subroutine translational_prepare(self, items, angle)
      class(spatial_translational_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      self%axes%holds_turn = .true.
      call self%take_axes(items, [across(1, 3), across(2, 3), across(1, 2), beside(1), beside(2)])
   end subroutine translational_prepare

end module spatial_translational
