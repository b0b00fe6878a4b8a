!> `gudgeon modes DECK`: eigenvalues, modes and matrices of the linearised mechanism, and its Campbell diagram.
module verb_modes
   use csv_table, only: csv_text
   use deck_parameters, only: deck_parameters_t
   use diagnostics, only: diagnostics_t
   use errors, only: error_t
   use file_store, only: keep_files
   use gnuplot_runs, only: draw_figures, make_folder
   use load, only: find_catalogue, load_deck, loaded_t
   use modes_info, only: modes_section
   use modes_plots, only: write_modes_plots
   use modes_results, only: modes_study_t
   use modes_study, only: study_modes
   use modes_tables, only: table_of_campbell, table_of_modes, table_of_stability, tables_of_matrices
   use modes_report, only: report_modes
   use modes_words, only: plan_modes
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use result_table, only: result_table_t
   use scene_echo, only: echo_scene
   use study_request, only: echo_of_section, open_study
   use table_file, only: write_table_file
   use table_list, only: append_tables, list_of
   use text, only: text_t
   use text_file, only: replace_file
   use text_table, only: file_heading
   implicit none (type, external)
   private
   public :: find_deck_modes

contains

   !> Find the modes that the deck asks for.
   subroutine find_deck_modes(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, no directory, or no such state

      type(deck_parameters_t), save, target :: source
      type(diagnostics_t) :: mistakes
      type(loaded_t), save :: loaded
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(modes_study_t) :: study
      type(text_t), allocatable :: pictures(:), warnings(:)

      call keep_files()
      call load_deck(options, loaded, error)
      if (allocated(error)) return
      call find_catalogue(loaded)
      call plan_modes(loaded%deck, loaded%scene, loaded%system, loaded%catalogue, study%plan, mistakes)
      call mistakes%to_error(loaded%deck%sources, error)
      if (allocated(error)) return
      allocate (warnings(0))
      call open_study(options, loaded, directory, plan, warnings, error)
      if (allocated(error)) return
      source%deck%options = options
      allocate (source%plan%parameters(1), source%plan%units(1))
      source%plan%parameters(1)%s = study%plan%parameter
      source%plan%units(1)%s = study%plan%unit
      call study_modes(loaded%job_t, source, study, error)
      if (.not. allocated(error)) then
         study%warnings = [warnings, study%warnings]
         call write_results(loaded, plan, study, pictures, error)
      end if
      if (.not. allocated(error)) call report_modes(options, loaded, plan, study, pictures, error)
      call directory%close()
   end subroutine find_deck_modes

   !> The files and the figure.
   subroutine write_results(loaded, plan, study, pictures, error)
      type(loaded_t), intent(inout) :: loaded                    !! the deck; defaults are noted
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(modes_study_t), intent(inout) :: study                !! the study; warnings may be added
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(result_table_t), allocatable :: tables(:)
      type(text_t), allocatable :: figures(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene)// &
                        echo_of_section(loaded, modes_section()), error)
      tables = list_of(table_of_modes(study))
      call append_tables(tables, tables_of_matrices(study))
      if (study%plan%parameter /= "") call append_tables(tables, list_of(table_of_campbell(study), table_of_stability(study)))
      if (.not. allocated(error)) call write_table_file("modes.h5", "gudgeon modes", plan, status_complete, tables, error)
      if (.not. allocated(error)) call replace_file(plan%directory//"/modes.csv", csv_text(table_of_modes(study)), error)
      if (allocated(error) .or. study%plan%parameter == "") return
      call replace_file(plan%directory//"/campbell.csv", csv_text(table_of_campbell(study)), error)
      if (allocated(error)) return
      folder = plan%directory//"/figures"
      call make_folder(folder, error)
      if (.not. allocated(error)) call write_modes_plots(folder, plan%title, file_heading(plan), study, figures, error)
      if (.not. allocated(error)) call draw_figures(folder, figures, pictures, study%warnings)
   end subroutine write_results

end module verb_modes
