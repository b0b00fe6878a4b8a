!> Whether the steps of a method have a map that derivatives can follow.
module one_step_check
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
   public :: check_one_step

contains

   !> A one-step method with variable steps that locates onsets.
   subroutine check_one_step(settings, who, error)
      type(integration_t), intent(in) :: settings          !! of the deck
      character(*), intent(in) :: who                      !! needs it, with the verb
      type(error_t), allocatable, intent(out) :: error     !! it is not

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
            call set_error(error, exit_usage, who//" variable steps"//new_line("a")// &
                           "  = omit step, and give method = auto, verner, dop853 or radau")
         else if (settings%controls%onset /= onset_located) then
            call set_error(error, exit_usage, who//" contact_onset = located")
         end if
      class default
         call set_error(error, exit_usage, "method "//method%name()//" is not a one-step method: its steps depend on earlier " &
                        //"ones"//new_line("a")//"  = give method = auto, verner, dop853 or radau, or --method")
      end select
   end subroutine check_one_step

end module one_step_check
