!> Revolute joint in space: two points coincide, and an axis of i is parallel to one of j.
!>
!> Phi = [ P_i - P_j,  x_i . z_j,  y_i . z_j ]                               (5 rows)
!>
!> Signs, frames: `spatial_joint`. Source: Flores et al. (2008), eqs. (6.14), (6.15): of the three rows of its cross product two are
!> independent; these two are taken. Limits: none.
module spatial_revolute
   use item, only: item_t
   use kind_info, only: kind_info_t, leaves_turn
   use kinds, only: wp
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_spatial_channels, add_turn_channels, at_point, &
      spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_revolute_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_revolute_t
   contains
      procedure, nopass :: info => revolute_info
      procedure :: prepare => revolute_prepare
   end type spatial_revolute_t

contains

   !> What the kind says of itself.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.revolute"
      info%help = "pin: two points coincide and two axes are parallel"
      info%source = "Flores et al. (2008), eqs. (6.14), (6.15)"
      info%n_row = 5
      info%leaves = leaves_turn
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the pin")
      call add_spatial_channels(info)
      call add_turn_channels(info)
   end function revolute_info

   !> Elements of the joint.
   subroutine revolute_prepare(self, items, angle)
      class(spatial_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [at_point, across(1, 3), across(2, 3)])
   end subroutine revolute_prepare

end module spatial_revolute
