!> Whether the method of a scene can make the steps that its deck asks for.
module step_check
   use item, only: place_of
   use diagnostics, only: diagnostics_t
   use integrator, only: integrator_t, steps_fixed, steps_variable
   use integrator_registry, only: find_integrator
   use kinds, only: wp
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: check_steps

contains

   !> A method with fixed steps needs their length, and so does a stabilisation with gains over the step; a method that chooses
   !> its steps must not be given any.
   subroutine check_steps(scene, diagnostics)
      type(scene_t), intent(in) :: scene                  !! the scene
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      class(integrator_t), allocatable :: method

      associate (word => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "method")), &
                 step => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "step")))
         call find_integrator(word%text, method)
         if (method%steps() == steps_fixed .and. step%number <= 0.0_wp) then
            call diagnostics%add(word%location, "method '"//word%text//"' needs a fixed step", &
                                 "fixed steps only", "add 'step' to [analysis.dynamic], as in: step = 10 us")
         else if (method%steps() == steps_variable .and. step%number > 0.0_wp) then
            call diagnostics%add(step%location, "method '"//word%text//"' does not support fixed steps", &
                                 "variable steps only", "omit 'step'; 'maximum_step' limits the steps")
         end if
      end associate
      associate (onset => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "contact_onset")))
         if (onset%text /= "located" .and. method%steps() == steps_variable) then
            call diagnostics%add(onset%location, "'contact_onset = "//onset%text//"' needs a one-step method", &
                                 "steps of '"//scene%settings%dynamic%word("method")// &
                                 "' is a multistep method", "use verner or rk4, or contact_onset = located")
         end if
      end associate
      associate (hold => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "stabilise")), &
                 step => scene%settings%dynamic%values(place_of(scene%settings%dynamic, "step")))
         if (hold%text == "baumgarte_step" .and. step%number <= 0.0_wp) then
            call diagnostics%add(hold%location, "'baumgarte_step' needs a fixed step", &
                                 "its gains would force ever smaller steps", &
                                 "add 'step' to [analysis.dynamic], or use baumgarte, baumgarte_adaptive or projection")
         end if
      end associate
   end subroutine check_steps

end module step_check
