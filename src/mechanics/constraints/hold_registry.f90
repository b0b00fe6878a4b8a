!> The ways of holding the constraints: two lines each (`use`, `case`).
module hold_registry
   use hold, only: hold_t
   use hold_augmented_lagrangian, only: hold_augmented_lagrangian_t
   use hold_baumgarte, only: hold_baumgarte_t
   use hold_baumgarte_adaptive, only: hold_baumgarte_adaptive_t
   use hold_baumgarte_step, only: hold_baumgarte_step_t
   use hold_none, only: hold_none_t
   use hold_partitioning, only: hold_partitioning_t
   use hold_projection, only: hold_projection_t
   implicit none (type, external)
   private
   public :: n_hold_kinds, new_hold

   integer, parameter :: n_hold_kinds = 7  !! number of ways

contains

   !> Way number k, 1 to `n_hold_kinds`, not configured.
   subroutine new_hold(k, way)
      integer, intent(in) :: k                             !! number of the way
      class(hold_t), allocatable, intent(out) :: way       !! the way

      select case (k)
      case (1); allocate (hold_none_t :: way)
      case (2); allocate (hold_baumgarte_t :: way)
      case (3); allocate (hold_baumgarte_step_t :: way)
      case (4); allocate (hold_baumgarte_adaptive_t :: way)
      case (5); allocate (hold_partitioning_t :: way)
      case (6); allocate (hold_augmented_lagrangian_t :: way)
      case (7); allocate (hold_projection_t :: way)
      end select
   end subroutine new_hold

end module hold_registry
