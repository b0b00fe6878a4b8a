!> The kinds of ideal joints and drivers: two lines each (`use`, `case`), and their number.
module joint_registry
   use driver_angle, only: driver_angle_t
   use driver_distance, only: driver_distance_t
   use driver_position, only: driver_position_t
   use driver_speed, only: driver_speed_t
   use initial_speed, only: initial_speed_t
   use joint_belt, only: joint_belt_t
   use joint_coupler, only: joint_coupler_t
   use joint_distance, only: joint_distance_t
   use joint_gear, only: joint_gear_t
   use joint_parallel, only: joint_parallel_t
   use joint_pin_in_slot, only: joint_pin_in_slot_t
   use joint_rack, only: joint_rack_t
   use joint_revolute, only: joint_revolute_t
   use joint_rigid, only: joint_rigid_t
   use joint_set, only: joint_set_t
   use joint_translational, only: joint_translational_t
   use spatial_belt, only: spatial_belt_t
   use spatial_constant_velocity, only: spatial_constant_velocity_t
   use spatial_coupler, only: spatial_coupler_t
   use spatial_cylindrical, only: spatial_cylindrical_t
   use spatial_distance, only: spatial_distance_t
   use spatial_driver_angle, only: spatial_driver_angle_t
   use spatial_driver_position, only: spatial_driver_position_t
   use spatial_driver_speed, only: spatial_driver_speed_t
   use spatial_gear, only: spatial_gear_t
   use spatial_initial_speed, only: spatial_initial_speed_t
   use spatial_inline, only: spatial_inline_t
   use spatial_inplane, only: spatial_inplane_t
   use spatial_orientation, only: spatial_orientation_t
   use spatial_parallel_axes, only: spatial_parallel_axes_t
   use spatial_perpendicular, only: spatial_perpendicular_t
   use spatial_planar, only: spatial_planar_t
   use spatial_rack, only: spatial_rack_t
   use spatial_revolute, only: spatial_revolute_t
   use spatial_revolute_spherical, only: spatial_revolute_spherical_t
   use spatial_rigid, only: spatial_rigid_t
   use spatial_screw, only: spatial_screw_t
   use spatial_spherical, only: spatial_spherical_t
   use spatial_translational, only: spatial_translational_t
   use spatial_universal, only: spatial_universal_t
   implicit none (type, external)
   private
   public :: new_joint_set, n_joint_kinds

contains

   !> Number of kinds.
   pure integer function n_joint_kinds()
      n_joint_kinds = 39
   end function n_joint_kinds

   !> An empty set of kind number k, 1 to `n_joint_kinds`. Drivers follow the joints they drive: rows
   !> that share a body stand close together, and the Schur complement's envelope stays narrow.
   subroutine new_joint_set(k, set)
      integer, intent(in) :: k                                 !! number of the kind
      class(joint_set_t), allocatable, intent(out) :: set      !! an empty set

      select case (k)
      case (1); allocate (joint_revolute_t :: set)
      case (2); allocate (driver_speed_t :: set)
      case (3); allocate (driver_angle_t :: set)
      case (4); allocate (joint_translational_t :: set)
      case (5); allocate (joint_pin_in_slot_t :: set)
      case (6); allocate (joint_distance_t :: set)
      case (7); allocate (joint_rigid_t :: set)
      case (8); allocate (driver_distance_t :: set)
      case (9); allocate (driver_position_t :: set)
      case (10); allocate (initial_speed_t :: set)
      case (11); allocate (joint_parallel_t :: set)
      case (12); allocate (joint_gear_t :: set)
      case (13); allocate (joint_rack_t :: set)
      case (14); allocate (spatial_spherical_t :: set)
      case (15); allocate (spatial_revolute_t :: set)
      case (16); allocate (spatial_driver_speed_t :: set)
      case (17); allocate (spatial_driver_angle_t :: set)
      case (18); allocate (spatial_universal_t :: set)
      case (19); allocate (spatial_cylindrical_t :: set)
      case (20); allocate (spatial_translational_t :: set)
      case (21); allocate (spatial_screw_t :: set)
      case (22); allocate (spatial_planar_t :: set)
      case (23); allocate (spatial_distance_t :: set)
      case (24); allocate (spatial_revolute_spherical_t :: set)
      case (25); allocate (spatial_rigid_t :: set)
      case (26); allocate (spatial_driver_position_t :: set)
      case (27); allocate (spatial_initial_speed_t :: set)
      case (28); allocate (spatial_gear_t :: set)
      case (29); allocate (spatial_inline_t :: set)
      case (30); allocate (spatial_inplane_t :: set)
      case (31); allocate (spatial_orientation_t :: set)
      case (32); allocate (spatial_parallel_axes_t :: set)
      case (33); allocate (spatial_perpendicular_t :: set)
      case (34); allocate (spatial_rack_t :: set)
      case (35); allocate (spatial_constant_velocity_t :: set)
      case (36); allocate (joint_belt_t :: set)
      case (37); allocate (spatial_belt_t :: set)
      case (38); allocate (joint_coupler_t :: set)
      case (39); allocate (spatial_coupler_t :: set)
      end select
   end subroutine new_joint_set

end module joint_registry
