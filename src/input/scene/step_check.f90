!> Whether the method of a scene can make the steps that its deck asks for.
module step_check
   use diagnostics, only: diagnostics_t
   use integration_method, only: abilities_t, steps_fixed, steps_variable
   use integration_settings, only: integration_t
   use integrator_controls, only: onset_located, onset_words
   use kinds, only: wp
   use stabilisation, only: stabilisation_t
   use stabilisation_registry, only: find_stabilisation
   implicit none (type, external)
   private
   public :: check_steps

contains

   !> A method with fixed steps needs their length, and so does a stabilisation with gains over the step; a method that chooses
   !> its steps must not be given any.
   subroutine check_steps(settings, diagnostics)
      type(integration_t), intent(in) :: settings         !! of the integration
      type(diagnostics_t), intent(inout) :: diagnostics   !! errors found

      class(stabilisation_t), allocatable :: hold
      type(abilities_t) :: can
      character(:), allocatable :: onset

      can = settings%can()
      associate (method => settings%method, stabiliser => settings%stabilisation%name, step => settings%controls%fixed_step, &
                 places => settings%places)
         if (can%steps == steps_fixed .and. step <= 0.0_wp) then
            call diagnostics%add(places%method, "method '"//method//"' needs a fixed step", &
                                 "fixed steps only", "add 'step' to [analysis.dynamic], as in: step = 10 us")
         else if (can%steps == steps_variable .and. step > 0.0_wp) then
            call diagnostics%add(places%step, "method '"//method//"' does not support fixed steps", &
                                 "variable steps only", "omit 'step'; 'maximum_step' limits the steps")
         end if
         if (settings%controls%onset /= onset_located .and. can%steps == steps_variable) then
            onset = trim(onset_words(settings%controls%onset))
            call diagnostics%add(places%onset, "'contact_onset = "//onset//"' needs a one-step method", &
                                 "steps of '"//method//"' is a multistep method", "use verner or rk4, or contact_onset = located")
         end if
         if (step > 0.0_wp .or. stabiliser == "") return
         call find_stabilisation(stabiliser, hold)
         if (.not. hold%needs_fixed_step()) return
         call diagnostics%add(places%stabilisation, "'"//stabiliser//"' needs a fixed step", &
                              "its gains would force ever smaller steps", &
                              "add 'step' to [analysis.dynamic], or use baumgarte, baumgarte_adaptive or projection")
      end associate
   end subroutine check_steps

end module step_check
