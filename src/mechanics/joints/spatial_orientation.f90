!> Orientation primitive: the axes of both bodies stay as the deck puts them against each other.
!>
!> Phi = [ x_i . z_j,  y_i . z_j,  x_i . y_j ]                             (3 rows)
!>
!> The third row is of perpendicular axes: with parallel ones it would lose its rank.
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2, from its elements. Limits: none.
module spatial_orientation
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use spatial_joint, only: across, add_joint_columns, add_spatial_channels, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_orientation_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_orientation_t
   contains
      procedure, nopass :: info => orientation_info
      procedure :: prepare => orientation_prepare
   end type spatial_orientation_t

contains

   !> Description of the kind.
   function orientation_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.orientation"
      info%help = "constant relative orientation of two bodies; translation is free"
      info%source = "Nikravesh (1988), section 7.2"
      info%n_row = 3
      call add_joint_columns(info)
      call add_spatial_channels(info)
   end function orientation_info

   !> Elements of the joint.
   subroutine orientation_prepare(self, items, angle)
      class(spatial_orientation_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      self%axes%holds_turn = .true.
      call self%take_axes(items, [across(1, 3), across(2, 3), across(1, 2)])
   end subroutine orientation_prepare

end module spatial_orientation
