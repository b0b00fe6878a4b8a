!> The integrators: two lines each (`use`, `case`).
module integrator_registry
   use integrator, only: integrator_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: n_integrator_kinds, new_integrator

   integer, parameter :: n_integrator_kinds = 1  !! number of methods

contains

   !> Integrator of kind number k, 1 to `n_integrator_kinds`.
   subroutine new_integrator(k, method)
      integer, intent(in) :: k                                  !! number of the kind
      class(integrator_t), allocatable, intent(out) :: method   !! the integrator, not started

      select case (k)
      case (1); allocate (verner_t :: method)
      end select
   end subroutine new_integrator

end module integrator_registry
