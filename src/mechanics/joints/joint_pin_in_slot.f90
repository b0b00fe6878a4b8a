!> Pin in a slot (revolute-translational joint): a point of body j stays on a line fixed in body i.
!>
!> With the unit axis s = A_i s' through the point of i, n = R90 s and d = r_j^P - r_i^P:
!> Phi = n . d                                                              (1 row)
!> Phi_q = [ -n^T, -s . (r_j^P - r_i), n^T, s . s_j ]
!> gamma = (n . d) w_i^2 + 2 w_i (s . d') + n . (s_j w_j^2 - s_i w_i^2)
!>
!> Signs: the force on the body of j, at its pin, is -n lambda; the force on i is the opposite, at the same
!> place. Source: Flores et al. (2008), eq. (2.8), first row of joint.translational. Limits: the line has no
!> ends and no clearance.
module joint_pin_in_slot
   use joint_set, only: add_joint_channels
   use joint_translational, only: add_axis_columns, joint_translational_t
   use item, only: item_t
   use kind_info, only: add_reference, in_plane, kind_info_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: joint_pin_in_slot_t

   !> All pins in slots of a planar scene.
   type, extends(joint_translational_t) :: joint_pin_in_slot_t
   contains
      procedure, nopass :: info => pin_info
      procedure :: prepare => pin_prepare
   end type joint_pin_in_slot_t

contains

   !> Description of the kind.
   function pin_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.pin_in_slot"
      info%space = in_plane
      info%help = "ideal slot: a point of j stays on a line of i; rotation is free"
      info%source = "Flores et al. (2008), eq. (2.8)"
      info%n_row = 1
      call add_reference(info, "i", "points", "point of the slot's centre line")
      call add_reference(info, "j", "points", "the pin")
      call add_axis_columns(info, "slot")
      call add_joint_channels(info)
   end function pin_info

   !> Axis of each item.
   subroutine pin_prepare(self, items, angle)
      class(joint_pin_in_slot_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)               !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                  !! (0:bodies) angles at the start [rad]

      call self%set_axes(items, angle)
   end subroutine pin_prepare

end module joint_pin_in_slot
