!> The integrator of a scene.
module scene_method
   use integrator, only: integrator_t
   use integrator_controls, only: read_controls
   use integrator_registry, only: find_integrator
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: new_method

contains

   !> The integrator that a scene asks for, with its controls.
   subroutine new_method(scene, method)
      type(scene_t), intent(in) :: scene                                !! the scene
      class(integrator_t), allocatable, intent(out) :: method           !! the integrator, not started

      call find_integrator(scene%settings%dynamic%word("method"), method)
      call read_controls(scene%settings%dynamic%item_t, method%controls)
   end subroutine new_method

end module scene_method
