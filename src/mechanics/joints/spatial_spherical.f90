!> Spherical joint: two points coincide.
!>
!> Phi = r_i + A_i s_i - r_j - A_j s_j                                      (3 rows)
!>
!> Signs: the force on body i is -lambda. Source: Flores et al. (2008), eq. (6.14). Limits: none.
module spatial_spherical
   use item, only: item_t
   use kind_info, only: kind_info_t, free_spherical
   use kinds, only: wp
   use spatial_joint, only: add_joint_columns, add_spatial_channels, at_point, spatial_joint_t
   implicit none (type, external)
   private
   public :: spatial_spherical_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_spherical_t
   contains
      procedure, nopass :: info => spherical_info
      procedure :: prepare => spherical_prepare
   end type spatial_spherical_t

contains

   !> Description of the kind.
   function spherical_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.spherical"
      info%help = "ball in a socket: two points coincide"
      info%source = "Flores et al. (2008), eq. (6.14)"
      info%n_row = 3
      info%free = free_spherical
      call add_joint_columns(info)
      call add_spatial_channels(info)
   end function spherical_info

   !> Elements of the joint.
   subroutine spherical_prepare(self, items, angle)
      class(spatial_spherical_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [at_point])
   end subroutine spherical_prepare

end module spatial_spherical
