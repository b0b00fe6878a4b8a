!> Method, solver, stabilisation and times, with the reasons of what `auto` has chosen, for `gudgeon explain`.
module explain_method
   use console, only: say
   use integrator, only: integrator_t
   use kinds, only: wp
   use load, only: loaded_t
   use row_plan, only: contact_rows_text
   use scene, only: analysis_kinematic, analysis_static
   use solver_registry, only: reason_of_solver
   use stabilisation_registry, only: reason_of_stabilisation
   use subsystems, only: grouping_words
   use text, only: counted, to_text
   use time_plan, only: last_instant
   implicit none (type, external)
   private
   public :: explain_method_and_times

contains

   !> Method, solver, stabilisation and times.
   subroutine explain_method_and_times(loaded)
      type(loaded_t), intent(in) :: loaded  !! the deck

      class(integrator_t), allocatable :: method
      character(:), allocatable :: words

      call say("")
      call say("method")
      select case (loaded%scene%analysis)
      case (analysis_kinematic)
         call say("positions by Newton iteration, forces by inverse dynamics, at every output time", 2)
         call explain_times(loaded)
         return
      case (analysis_static)
         call say("minimisation, then KINSOL, to a residual of "//to_text(loaded%scene%settings%static%number("tolerance"))// &
                  " of the maximum load", 2)
         return
      end select
      associate (settings => loaded%scene%settings%integration, solver => loaded%system%linkage%solution%solver)
         call settings%new_method(method)
         call say("integrator "//method%name()//", tolerance "//to_text(settings%controls%tolerance), 2)
         words = method%words(has_run=.false.)
         if (words /= "") call say(words, 2)
         words = "variable steps"
         if (settings%controls%fixed_step > 0.0_wp) then
            words = "fixed steps of "//to_text(settings%controls%fixed_step)//" s: the tolerance is not used"
         end if
         call say(words, 2)
         words = solver%name()
         if (settings%solver%name == "") words = words//" (auto: "//reason_of_solver(solver)//")"
         call say("solver "//words, 2)
         words = loaded%system%stabiliser%words()
         if (settings%stabilisation%name == "") words = words//" (auto: "//reason_of_stabilisation(loaded%system%stabiliser)//")"
         call say("stabilisation "//words, 2)
      end associate
      call explain_times(loaded)
   end subroutine explain_method_and_times

   !> Times of the motion and of its output.
   subroutine explain_times(loaded)
      type(loaded_t), intent(in) :: loaded  !! the deck

      character(:), allocatable :: words

      call say("from 0 to "//to_text(loaded%plan%end)//" s; output from "//to_text(loaded%plan%first_output)// &
               " s every "//to_text(loaded%plan%every)//" s, "// &
               counted(1 + int(last_instant(loaded%plan)), "output time", "output times"), 2)
      words = contact_rows_text(loaded%scene, loaded%system)
      if (len(words) > 0) call say(words, 2)
      words = grouping_words(loaded%scene)
      if (len(words) > 0) call say(words, 2)
   end subroutine explain_times

end module explain_method
