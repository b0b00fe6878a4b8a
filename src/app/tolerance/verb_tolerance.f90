!> `gudgeon tolerance DECK`: what tolerances and clearances make of the channels of a kinematic analysis, or of numbers of runs.
module verb_tolerance
   use deck_mechanisms, only: deck_mechanisms_t
   use dynamic_level, only: study_runs
   use errors, only: error_t
   use file_store, only: keep_files
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use nominal_motion, only: find_motion
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use recorder, only: summary_t
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names
   use study_request, only: open_study
   use text, only: text_t
   use tolerance_files, only: write_study
   use tolerance_plan, only: level_dynamic
   use tolerance_report, only: note_members, report_tolerances
   use tolerance_results, only: tolerance_study_t
   use tolerance_setup, only: read_plan, set_up_study
   use tolerance_study, only: run_study
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: study_tolerances

contains

   !> Make the study of a deck, at its level.
   subroutine study_tolerances(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, no directory, or no derivatives

      type(loaded_t), save :: loaded
      type(options_t) :: now
      type(tolerance_study_t) :: study

      call keep_files()
      now = options
      call load_deck(now, loaded, error)
      if (.not. allocated(error)) call read_plan(loaded, study, error)
      if (allocated(error)) return
      now%change%analysis = trim(analysis_names(merge(analysis_dynamic, analysis_kinematic, study%plan%level == level_dynamic)))
      if (loaded%scene%analysis /= merge(analysis_dynamic, analysis_kinematic, study%plan%level == level_dynamic)) then
         call load_deck(now, loaded, error)
         if (allocated(error)) return
      end if
      if (study%plan%level == level_dynamic) then
         call study_runs(now, loaded, study, error)
      else
         call study_positions(now, loaded, study, error)
      end if
   end subroutine study_tolerances

   !> Make the study of the kinematic level.
   subroutine study_positions(options, loaded, study, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck, of its kinematic analysis
      type(tolerance_study_t), intent(inout) :: study      !! its plan is known
      type(error_t), allocatable, intent(out) :: error     !! nothing is asked, no directory, or no derivatives

      type(deck_mechanisms_t), save :: source
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(summary_t) :: summary
      type(text_t), allocatable :: pictures(:), warnings(:)

      allocate (warnings(0))
      call set_up_study(loaded, study, warnings, error)
      if (allocated(error)) return
      call open_study(options, loaded, directory, plan, warnings, error)
      if (allocated(error)) return
      call find_motion(loaded%job_t, loaded%system, study%derivatives%instants, summary, error)
      if (.not. allocated(error)) then
         call source%begin(options, study)
         call source%display%start(.not. options%is_quiet)
         call run_nominal(source, study, error)
         call source%display%finish()
      end if
      if (.not. allocated(error)) then
         call note_members(study, warnings)
         call write_study(loaded, plan, study, pictures, warnings, error)
      end if
      if (.not. allocated(error)) call report_tolerances(options, loaded, plan, study, pictures, warnings, error)
      call directory%close()
   end subroutine study_positions

   !> Build the nominal mechanism, and make the study.
   subroutine run_nominal(source, study, error)
      type(deck_mechanisms_t), intent(inout) :: source      !! the mechanisms of the deck
      type(tolerance_study_t), intent(inout) :: study       !! the study
      type(error_t), allocatable, intent(out) :: error      !! no derivatives

      type(varied_t) :: nominal
      integer :: k

      call source%build([(0.0_wp, k=1, size(study%plan%parameters))], nominal, study%pins%clearance, error)
      if (.not. allocated(error)) call run_study(source, nominal, study, error)
   end subroutine run_nominal

end module verb_tolerance
