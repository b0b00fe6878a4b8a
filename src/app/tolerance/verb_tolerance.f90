!> `gudgeon tolerance DECK`: what tolerances and clearances make of the channels of a kinematic analysis.
module verb_tolerance
   use csv_table, only: csv_text
   use deck_mechanisms, only: deck_mechanisms_t
   use errors, only: error_t
   use file_store, only: keep_files
   use gnuplot_runs, only: draw_figures, make_folder
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use nominal_motion, only: find_motion
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete, summary_t
   use scene, only: analysis_kinematic, analysis_names
   use scene_echo, only: echo_scene
   use study_request, only: echo_of_rows, echo_of_section, open_study
   use table_file, only: write_table_file
   use text, only: text_t
   use text_file, only: replace_file
   use text_table, only: file_heading
   use tolerance_info, only: tolerance_joint_info, tolerance_limit_info, tolerance_study_info, tolerance_table_info
   use tolerance_plots, only: write_tolerance_plots
   use tolerance_report, only: note_members, report_tolerances
   use tolerance_results, only: tolerance_study_t
   use tolerance_setup, only: set_up_study
   use tolerance_study, only: run_study
   use tolerance_tables, only: table_of_contributors, table_of_derivatives, table_of_histograms, table_of_requests, table_of_times
   use varied_mechanism, only: varied_t
   implicit none (type, external)
   private
   public :: study_tolerances

contains

   !> Make the study of a deck.
   subroutine study_tolerances(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, no directory, or no derivatives

      type(deck_mechanisms_t) :: source
      type(loaded_t) :: loaded
      type(options_t) :: kinematic
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(summary_t) :: summary
      type(text_t), allocatable :: pictures(:), warnings(:)
      type(tolerance_study_t) :: study

      call keep_files()
      kinematic = options
      kinematic%change%analysis = trim(analysis_names(analysis_kinematic))
      call load_deck(kinematic, loaded, error)
      if (allocated(error)) return
      allocate (warnings(0))
      call set_up_study(loaded, study, warnings, error)
      if (allocated(error)) return
      call open_study(options, loaded, directory, plan, warnings, error)
      if (allocated(error)) return
      call find_motion(loaded%job_t, loaded%system, study%derivatives%instants, summary, error)
      if (.not. allocated(error)) then
         call source%begin(kinematic, study)
         call source%display%start(.not. options%is_quiet)
         call run_nominal(source, study, error)
         call source%display%finish()
      end if
      if (.not. allocated(error)) then
         call note_members(study, warnings)
         call write_results(loaded, plan, study, pictures, warnings, error)
      end if
      if (.not. allocated(error)) call report_tolerances(options, loaded, plan, study, pictures, warnings, error)
      call directory%close()
   end subroutine study_tolerances

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

   !> The files and figures.
   subroutine write_results(loaded, plan, study, pictures, warnings, error)
      type(loaded_t), intent(inout) :: loaded                    !! the deck; defaults are noted
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(tolerance_study_t), intent(in) :: study               !! the study
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene)//echo_of_tables(loaded), error)
      if (.not. allocated(error)) then
         call write_table_file("tolerance.h5", "gudgeon tolerance", plan, status_complete, &
                               [table_of_requests(study), table_of_contributors(study), table_of_times(study), &
                                table_of_derivatives(study), table_of_histograms(study)], error)
      end if
      if (.not. allocated(error)) then
         call replace_file(plan%directory//"/tolerance.csv", csv_text(table_of_times(study)), error)
      end if
      if (.not. allocated(error)) then
         call replace_file(plan%directory//"/tolerance_derivatives.csv", csv_text(table_of_derivatives(study)), error)
      end if
      if (allocated(error)) return
      folder = plan%directory//"/figures"
      call make_folder(folder, error)
      if (.not. allocated(error)) call write_tolerance_plots(folder, plan%title, file_heading(plan), study, names, error)
      if (.not. allocated(error)) call draw_figures(folder, names, pictures, warnings)
   end subroutine write_results

   !> The tables of tolerances for the echo.
   function echo_of_tables(loaded) result(text)
      type(loaded_t), intent(inout) :: loaded      !! the deck; defaults are noted
      character(:), allocatable :: text            !! tables of a deck

      text = echo_of_rows(loaded, tolerance_table_info())
      text = text//echo_of_rows(loaded, tolerance_joint_info())
      text = text//echo_of_rows(loaded, tolerance_limit_info())
      text = text//echo_of_section(loaded, tolerance_study_info())
   end function echo_of_tables

end module verb_tolerance
