!> The stabilisation methods: two lines each (`use`, `case`).
module stabilisation_registry
   use stabilisation, only: stabilisation_t
   use stabilisation_augmented_lagrangian, only: stabilisation_augmented_lagrangian_t
   use stabilisation_baumgarte, only: stabilisation_baumgarte_t
   use stabilisation_baumgarte_adaptive, only: stabilisation_baumgarte_adaptive_t
   use stabilisation_baumgarte_step, only: stabilisation_baumgarte_step_t
   use stabilisation_none, only: stabilisation_none_t
   use stabilisation_partitioning, only: stabilisation_partitioning_t
   use stabilisation_projection, only: stabilisation_projection_t
   implicit none (type, external)
   private
   public :: n_stabilisation_kinds, new_stabilisation

   integer, parameter :: n_stabilisation_kinds = 7  !! number of ways

contains

   !> Way number k, 1 to `n_stabilisation_kinds`, not configured.
   subroutine new_stabilisation(k, way)
      integer, intent(in) :: k                             !! number of the way
      class(stabilisation_t), allocatable, intent(out) :: way       !! the way

      select case (k)
      case (1); allocate (stabilisation_none_t :: way)
      case (2); allocate (stabilisation_baumgarte_t :: way)
      case (3); allocate (stabilisation_baumgarte_step_t :: way)
      case (4); allocate (stabilisation_baumgarte_adaptive_t :: way)
      case (5); allocate (stabilisation_partitioning_t :: way)
      case (6); allocate (stabilisation_augmented_lagrangian_t :: way)
      case (7); allocate (stabilisation_projection_t :: way)
      end select
   end subroutine new_stabilisation

end module stabilisation_registry
