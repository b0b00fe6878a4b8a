!> The kinds of ideal joints and drivers: two lines each (`use`, `case`).
module joint_registry
   use driver_angle, only: driver_angle_t
   use driver_distance, only: driver_distance_t
   use driver_position, only: driver_position_t
   use driver_speed, only: driver_speed_t
   use initial_speed, only: initial_speed_t
   use joint_distance, only: joint_distance_t
   use joint_gear, only: joint_gear_t
   use joint_parallel, only: joint_parallel_t
   use joint_pin_in_slot, only: joint_pin_in_slot_t
   use joint_rack, only: joint_rack_t
   use joint_revolute, only: joint_revolute_t
   use joint_rigid, only: joint_rigid_t
   use joint_set, only: joint_set_t
   use joint_translational, only: joint_translational_t
   implicit none (type, external)
   private
   public :: new_joint_set, n_joint_kinds

   integer, parameter :: n_joint_kinds = 13  !! number of kinds

contains

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
      end select
   end subroutine new_joint_set

end module joint_registry
