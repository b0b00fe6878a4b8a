!> Rigid joint in space: two points coincide, and the bodies keep the orientation in which the deck puts them.
!>
!> Phi = [ P_i - P_j,  x_i . z_j,  y_i . z_j,  x_i . y_j ]                  (6 rows)
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements. Limits: none.
module spatial_rigid
   use item, only: item_t
   use kind_info, only: kind_info_t, free_none
   use kinds, only: wp
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_spatial_channels, at_point, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_rigid_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_rigid_t
   contains
      procedure, nopass :: info => rigid_info
      procedure :: prepare => rigid_prepare
   end type spatial_rigid_t

contains

   !> Description of the kind.
   function rigid_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.rigid"
      info%help = "two bodies move as one rigid body"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 6
      info%free = free_none
      call add_joint_columns(info)
      call add_axis_columns(info, "any axis of the joint")
      call add_spatial_channels(info)
   end function rigid_info

   !> Elements of the joint.
   subroutine rigid_prepare(self, items, angle)
      class(spatial_rigid_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      self%axes%holds_turn = .true.
      call self%take_axes(items, [at_point, across(1, 3), across(2, 3), across(1, 2)])
   end subroutine rigid_prepare

end module spatial_rigid
