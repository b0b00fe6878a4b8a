!> Scenes of a deck with other values of its parameters, as `--set` gives them.
module deck_parameters
   use changed_parameter, only: change_parameter
   use errors, only: error_t
   use jobs, only: first_line, job_t
   use kinds, only: wp
   use load, only: load_case, load_deck, loaded_t
   use options, only: options_t
   use parameter_source, only: parameter_source_t
   use sensitivity_results, only: sensitivity_plan_t
   use text, only: exact_text
   implicit none (type, external)
   private
   public :: deck_parameters_t

   !> A deck. Options and plan are set before the first scene is asked for.
   type, extends(parameter_source_t) :: deck_parameters_t
      type(options_t) :: options             !! the command line
      type(sensitivity_plan_t) :: plan       !! for names and units of the parameters
      type(loaded_t) :: loaded               !! the deck with the last values
      logical :: is_loaded = .false.         !! it was loaded without errors
   contains
      procedure :: make => make_scene
   end type deck_parameters_t

contains

   !> The scene with one parameter changed.
   subroutine make_scene(self, parameter, value, job, reason)
      class(deck_parameters_t), intent(inout) :: self     !! the deck
      integer, intent(in) :: parameter                    !! number of the parameter
      real(wp), intent(in) :: value                       !! its value, SI [any]
      type(job_t), intent(out) :: job                     !! the scene with it
      character(:), allocatable, intent(out) :: reason    !! what the deck says of the value; blank: it takes it

      type(error_t), allocatable :: error
      type(options_t) :: options

      options = self%options
      options%runs%is_member = .true.
      options%runs%has_known_words = .true.
      call change_parameter(options, self%plan%parameters(parameter)%s, value, self%plan%units(parameter)%s)
      if (self%is_loaded) then
         call load_case(options, self%loaded, error)
      else
         call load_deck(options, self%loaded, error)
      end if
      self%is_loaded = .not. allocated(error)
      reason = ""
      if (allocated(error)) then
         reason = "the deck does not take "//exact_text(value)//" "//self%plan%units(parameter)%s//": "//first_line(error%message)
      else
         job = self%loaded%job_t
      end if
   end subroutine make_scene

end module deck_parameters
