!> Method, solver, stabilisation and times, with the reasons of what `auto` has chosen, for `gudgeon explain`.
module explain_method
   use auto, only: auto_t
   use console, only: say
   use integrator, only: integrator_t
   use kinds, only: wp
   use load, only: loaded_t
   use mechanism, only: mechanism_t
   use row_plan, only: contact_rows_text
   use scene, only: analysis_kinematic, analysis_static
   use scene_method, only: new_method
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

      character(:), allocatable :: fixed, hold, solver

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
      associate (settings => loaded%scene%settings%dynamic)
         solver = settings%word("solver")
         if (solver == "auto") then
            solver = loaded%system%linkage%solution%solver%name()//" (auto: "//reason_of_solver(loaded%system)//")"
         end if
         fixed = "variable steps"
         if (settings%number("step") > 0.0_wp) then
            fixed = "fixed steps of "//to_text(settings%number("step"))//" s: the tolerance is not used"
         end if
         call say("integrator "//settings%word("method")//", tolerance "// &
                  to_text(settings%number("tolerance")), 2)
         if (settings%word("method") == "auto") call say(words_of_auto(loaded), 2)
         call say(fixed, 2)
         call say("solver "//solver, 2)
         hold = loaded%system%way%words()
         if (settings%word("stabilise") == "auto") hold = hold//" (auto: "//reason_of_stabilisation(loaded%system)//")"
         call say("stabilisation "//hold, 2)
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

   !> What the method that chooses has to choose from.
   function words_of_auto(loaded) result(words)
      type(loaded_t), intent(in) :: loaded  !! the deck
      character(:), allocatable :: words    !! the parts

      class(integrator_t), allocatable :: method

      call new_method(loaded%scene, method)
      words = ""
      select type (method)
      type is (auto_t)
         words = method%parts_in_words()
      end select
   end function words_of_auto

   !> Why `auto` has chosen the solver.
   function reason_of_solver(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system
      character(:), allocatable :: words            !! the reason

      select case (system%linkage%solution%solver%name())
      case ("schur")
         words = "equal to pivoting within round-off, and the fastest for these equations"
      case ("sparse")
         words = "high joint count per body: the Schur complement would be dense"
      case default
         words = "set by the stabilisation"
      end select
   end function reason_of_solver

   !> Why `auto` has chosen the stabilisation.
   function reason_of_stabilisation(system) result(words)
      type(mechanism_t), intent(in) :: system   !! the system
      character(:), allocatable :: words            !! the reason

      select case (system%way%name())
      case ("none")
         words = "not needed: no constraints, or the integrator enforces them"
      case ("baumgarte")
         words = "a driver jumps, and projection cannot follow a jump"
      case default
         words = "removes all constraint violation without adding gains"
      end select
   end function reason_of_stabilisation

end module explain_method
