!> The kinds of force elements: two lines each (`use`, `case`), and their number.
module force_registry
   use force_beam, only: force_beam_t
   use force_bushing, only: force_bushing_t
   use force_point, only: force_point_t
   use force_set, only: force_set_t
   use force_spring, only: force_spring_t
   use force_torque, only: force_torque_t
   use force_torsion_spring, only: force_torsion_spring_t
   use spatial_beam, only: spatial_beam_t
   use spatial_bushing, only: spatial_bushing_t
   use spatial_force, only: spatial_force_t
   use spatial_torque, only: spatial_torque_t
   use spatial_torsion_spring, only: spatial_torsion_spring_t
   implicit none (type, external)
   private
   public :: n_force_kinds, new_force_set

contains

   !> Number of kinds.
   pure integer function n_force_kinds()
      n_force_kinds = 11
   end function n_force_kinds

   !> An empty set of kind number k, 1 to `n_force_kinds`.
   subroutine new_force_set(k, set)
      integer, intent(in) :: k                               !! number of the kind
      class(force_set_t), allocatable, intent(out) :: set    !! an empty set

      select case (k)
      case (1); allocate (force_point_t :: set)
      case (2); allocate (force_torque_t :: set)
      case (3); allocate (force_spring_t :: set)
      case (4); allocate (force_torsion_spring_t :: set)
      case (5); allocate (spatial_force_t :: set)
      case (6); allocate (spatial_torque_t :: set)
      case (7); allocate (spatial_torsion_spring_t :: set)
      case (8); allocate (force_bushing_t :: set)
      case (9); allocate (spatial_bushing_t :: set)
      case (10); allocate (force_beam_t :: set)
      case (11); allocate (spatial_beam_t :: set)
      end select
   end subroutine new_force_set

end module force_registry
