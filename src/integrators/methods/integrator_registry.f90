!> The integrators: two lines each (`use`, `case`).
module integrator_registry
   use adams, only: adams_t
   use auto, only: auto_t
   use bdf, only: bdf_t
   use dop853, only: dop853_t
   use ida, only: ida_t
   use integrator, only: integrator_t
   use kind_info, only: kind_info_t
   use radau, only: radau_t
   use rk4, only: rk4_t
   use rock4, only: rock4_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: find_integrator, n_integrator_kinds, new_integrator

   integer, parameter :: n_integrator_kinds = 9  !! number of methods

contains

   !> Integrator of kind number k, 1 to `n_integrator_kinds`.
   subroutine new_integrator(k, method)
      integer, intent(in) :: k                                  !! number of the kind
      class(integrator_t), allocatable, intent(out) :: method   !! the integrator, not started

      select case (k)
      case (1); allocate (auto_t :: method)
      case (2); allocate (verner_t :: method)
      case (3); allocate (dop853_t :: method)
      case (4); allocate (rk4_t :: method)
      case (5); allocate (adams_t :: method)
      case (6); allocate (bdf_t :: method)
      case (7); allocate (ida_t :: method)
      case (8); allocate (rock4_t :: method)
      case (9); allocate (radau_t :: method)
      end select
   end subroutine new_integrator

   !> Integrator by its name in a deck, which must be one of them.
   subroutine find_integrator(name, method)
      character(*), intent(in) :: name                          !! the method's name
      class(integrator_t), allocatable, intent(out) :: method   !! the integrator, not started

      type(kind_info_t) :: info
      integer :: k

      do k = 1, n_integrator_kinds
         call new_integrator(k, method)
         info = method%info()
         if (info%name == name) exit
      end do
   end subroutine find_integrator

end module integrator_registry
