!> Verbs that make many runs of one deck, and what each of them calls.
module study_verbs
   use errors, only: error_t
   use options, only: options_t
   use verb_fit, only: fit_deck_to_data
   use verb_life, only: live_deck
   use verb_modes, only: find_deck_modes
   use verb_orbit, only: orbit_deck
   use verb_precision, only: compare_precision
   use verb_sensitivity, only: derive_deck
   use verb_tolerance, only: study_tolerances
   implicit none (type, external)
   private
   public :: make_study

contains

   !> Make the study that the verb names.
   subroutine make_study(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! as of the study

      select case (options%verb)
      case ("life")
         call live_deck(options, error)
      case ("sensitivity")
         call derive_deck(options, error)
      case ("orbit")
         call orbit_deck(options, error)
      case ("modes")
         call find_deck_modes(options, error)
      case ("fit")
         call fit_deck_to_data(options, error)
      case ("tolerance")
         call study_tolerances(options, error)
      case default
         call compare_precision(options, error)
      end select
   end subroutine make_study

end module study_verbs
