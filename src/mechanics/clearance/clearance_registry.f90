!> The geometries of joints with clearance: two lines each (`use`, `case`), and their number.
module clearance_registry
   use clearance_ball, only: clearance_ball_t
   use clearance_balls, only: clearance_balls_t
   use clearance_block, only: clearance_block_t
   use clearance_bushing, only: clearance_bushing_t
   use clearance_cam, only: clearance_cam_t
   use clearance_discs, only: clearance_discs_t
   use clearance_limits, only: clearance_limits_t
   use clearance_plane, only: clearance_plane_t
   use clearance_revolute, only: clearance_revolute_t
   use clearance_set, only: clearance_set_t
   use clearance_slot, only: clearance_slot_kind_t
   use clearance_spherical, only: clearance_spherical_t
   use clearance_stop, only: clearance_stop_t
   use clearance_thrust, only: clearance_thrust_t
   use clearance_translational, only: clearance_translational_t
   implicit none (type, external)
   private
   public :: n_clearance_kinds, new_clearance_set

contains

   !> Number of geometries.
   pure integer function n_clearance_kinds()
      n_clearance_kinds = 14
   end function n_clearance_kinds

   !> An empty set of geometry number k, 1 to `n_clearance_kinds`.
   subroutine new_clearance_set(k, set)
      integer, intent(in) :: k                                   !! number of the geometry
      class(clearance_set_t), allocatable, intent(out) :: set    !! an empty set

      select case (k)
      case (1); allocate (clearance_revolute_t :: set)
      case (2); allocate (clearance_plane_t :: set)
      case (3); allocate (clearance_translational_t :: set)
      case (4); allocate (clearance_discs_t :: set)
      case (5); allocate (clearance_stop_t :: set)
      case (6); allocate (clearance_spherical_t :: set)
      case (7); allocate (clearance_bushing_t :: set)
      case (8); allocate (clearance_block_t :: set)
      case (9); allocate (clearance_thrust_t :: set)
      case (10); allocate (clearance_ball_t :: set)
      case (11); allocate (clearance_balls_t :: set)
      case (12); allocate (clearance_limits_t :: set)
      case (13); allocate (clearance_cam_t :: set)
      case (14); allocate (clearance_slot_kind_t :: set)
      end select
   end subroutine new_clearance_set

end module clearance_registry
