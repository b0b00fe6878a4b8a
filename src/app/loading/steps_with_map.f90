!> Methods whose steps have a map that can be derived: one-step methods with variable steps.
module steps_with_map
   use errors, only: error_t, exit_usage, set_error
   use integration_method, only: abilities_t, steps_fixed
   use integration_settings, only: integration_t
   use integrator, only: integrator_t
   use integrator_controls, only: onset_located
   use kinds, only: wp
   use one_step, only: one_step_t
   use rock4, only: rock4_t
   implicit none (type, external)
   private
   public :: check_method

contains

   !> Refuse another method.
   subroutine check_method(settings, study, error)
      type(integration_t), intent(in) :: settings          !! of the deck
      character(*), intent(in) :: study                    !! what needs the map: sensitivities, orbits
      type(error_t), allocatable, intent(out) :: error     !! what is wrong with it

      class(integrator_t), allocatable :: method
      type(abilities_t) :: can

      call settings%new_method(method)
      can = method%abilities()
      select type (method)
      class is (rock4_t)
         call set_error(error, exit_usage, "method "//method%name()//" chooses its stages by the steps before: they have no " &
                        //"derivative"//new_line("a")//"  = give method = auto, verner, dop853 or radau, or --method")
      class is (one_step_t)
         if (can%steps == steps_fixed .or. settings%controls%fixed_step > 0.0_wp) then
            call set_error(error, exit_usage, study//" need variable steps"//new_line("a")// &
                           "  = omit step, and give method = auto, verner, dop853 or radau")
         else if (settings%controls%onset /= onset_located) then
            call set_error(error, exit_usage, study//" need contact_onset = located")
         end if
      class default
         call set_error(error, exit_usage, "method "//method%name()//" is not a one-step method: its steps depend on earlier " &
                        //"ones"//new_line("a")//"  = give method = auto, verner, dop853 or radau, or --method")
      end select
   end subroutine check_method

end module steps_with_map
