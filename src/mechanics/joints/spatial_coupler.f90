!> Coupler in space: see `joint_coupler`. A cylindrical joint gives its angle or its displacement.
!>
!> Signs, source, limits: `joint_coupler`.
module spatial_coupler
   use joint_coupler, only: add_coupler_columns, joint_coupler_t
   use kind_info, only: in_space, kind_info_t
   implicit none (type, external)
   private
   public :: spatial_coupler_t

   !> All couplers of a spatial scene.
   type, extends(joint_coupler_t) :: spatial_coupler_t
   contains
      procedure, nopass :: info => coupler_info
   end type spatial_coupler_t

contains

   !> Description of the kind.
   function coupler_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%space = in_space
      call add_coupler_columns(info, "joint.revolute joint.translational joint.cylindrical", "own angle displacement")
   end function coupler_info

end module spatial_coupler
