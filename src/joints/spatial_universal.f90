!> Universal (Hooke) joint: two points coincide, and the arm of the cross in i is at right angles to that in j.
!>
!> Phi = [ P_i - P_j,  z_i . z_j ]                                          (4 rows)
!>
!> Signs, frames: `spatial_joint`. Source: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), section 7.2.3.
!> Limits: the axis of j must be given, since that of i is not it.
module spatial_universal
   use item, only: item_t
   use kind_info, only: add_direction, kind_info_t, leaves_angles
   use kinds, only: wp
   use spatial_joint, only: across, add_joint_columns, add_spatial_channels, at_point, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_universal_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_universal_t
   contains
      procedure, nopass :: info => universal_info
      procedure :: prepare => universal_prepare
   end type spatial_universal_t

contains

   !> What the kind says of itself.
   function universal_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.universal"
      info%help = "universal joint: two points coincide and two axes stay at right angles"
      info%source = "Nikravesh (1988), section 7.2.3"
      info%n_row = 4
      info%leaves = leaves_angles
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "arm of the cross, in the frame of the body of i")
      call add_direction(info, "axis_j", "arm of the cross, in the frame of the body of j")
      call add_spatial_channels(info)
   end function universal_info

   !> Elements of the joint.
   subroutine universal_prepare(self, items, angle)
      class(spatial_universal_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [at_point, across(3, 3)])
   end subroutine universal_prepare

end module spatial_universal
