!> Scenes of a deck with other values of its parameters, as `--set` gives them.
module deck_parameters
   use changed_deck, only: change_parameter, changed_deck_t
   use errors, only: error_t
   use jobs, only: copy_job, first_line, job_t
   use kinds, only: wp
   use options, only: options_t
   use parameter_source, only: parameter_source_t
   use sensitivity_results, only: sensitivity_plan_t
   use text, only: exact_text
   implicit none (type, external)
   private
   public :: deck_parameters_t

   !> A deck. Its options and the plan are set before the first scene is asked for.
   type, extends(parameter_source_t) :: deck_parameters_t
      type(changed_deck_t) :: deck           !! the deck with the last values
      type(sensitivity_plan_t) :: plan       !! for names and units of the parameters
   contains
      procedure :: make => make_scene
   end type deck_parameters_t

contains

   !> The scene with one parameter changed.
   subroutine make_scene(self, parameter, value, job, reason)
      class(deck_parameters_t), intent(inout) :: self     !! the deck
      integer, intent(in) :: parameter                    !! number of the parameter
      real(wp), intent(in) :: value                       !! its value, SI [any]
      type(job_t), intent(inout) :: job                   !! the scene with it
      character(:), allocatable, intent(out) :: reason    !! what the deck says of the value; blank: it takes it

      type(error_t), allocatable :: error
      type(options_t) :: options

      options = self%deck%options
      call change_parameter(options, self%plan%parameters(parameter)%s, value, self%plan%units(parameter)%s)
      call self%deck%load(options, error)
      reason = ""
      if (allocated(error)) then
         reason = "the deck does not take "//exact_text(value)//" "//self%plan%units(parameter)%s//": "//first_line(error%message)
      else
         call copy_job(self%deck%loaded%job_t, job)
      end if
   end subroutine make_scene

end module deck_parameters
