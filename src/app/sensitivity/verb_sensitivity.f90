!> `gudgeon sensitivity DECK`: derivatives of results by parameters of the deck, through impacts.
module verb_sensitivity
   use csv_table, only: csv_text
   use deck_parameters, only: deck_parameters_t
   use echo, only: echo_settings
   use errors, only: error_t, exit_usage, set_error
   use file_store, only: keep_files
   use find_sensitivity, only: find_sensitivities
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use one_step_check, only: check_one_step
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use result_table, only: result_table_t
   use run_limits, only: limits_of
   use run_place, only: directory_of
   use run_plan, only: tell_origin
   use scene, only: analysis_dynamic
   use scene_echo, only: echo_scene
   use sensitivity_info, only: sensitivity_section
   use sensitivity_report, only: report_sensitivity
   use sensitivity_results, only: sensitivity_t
   use sensitivity_tables, only: table_of_derivatives, table_of_parameters, table_of_results
   use table_file, only: write_table_file
   use text, only: text_t
   use text_file, only: replace_file
   implicit none (type, external)
   private
   public :: derive_deck

contains

   !> Find the derivatives that the deck asks for.
   subroutine derive_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors of the deck, no directory, or the motion failed

      type(deck_parameters_t), target :: source
      type(loaded_t) :: loaded
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(sensitivity_t) :: study
      type(text_t), allocatable :: warnings(:)

      call keep_files()
      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_request(loaded, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      warnings = directory%warnings
      call limits_of(loaded%scene, loaded%catalogue, loaded%limits, warnings)
      plan%directory = directory%path
      plan%title = loaded%scene%title
      call tell_origin(options, loaded, plan)
      call plan%complete()
      source%options = options
      source%plan = loaded%sensitivity%plan
      if (options%change%tolerance > 0.0_wp) loaded%sensitivity%plan%tolerance = options%change%tolerance
      call find_sensitivities(loaded%job_t, source, loaded%sensitivity%plan, study, error)
      if (.not. allocated(error)) call write_results(loaded, plan, study, error)
      if (.not. allocated(error)) call report_sensitivity(options, loaded, plan, study, warnings, error)
      call directory%close()
   end subroutine derive_deck

   !> Derivatives need their section, a motion, and a method whose steps have a map.
   subroutine check_request(loaded, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! what is missing

      if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "sensitivities need [analysis.dynamic] as the first analysis section of the deck")
      else if (.not. loaded%sensitivity%is_present) then
         call set_error(error, exit_usage, "the deck has no section [sensitivity]"//new_line("a")// &
                        "  = see 'gudgeon help sensitivity'")
      else
         call check_one_step(loaded%scene%settings%integration, "sensitivities need", error)
      end if
   end subroutine check_request

   !> The files.
   subroutine write_results(loaded, plan, study, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_plan_t), intent(in) :: plan              !! what files say
      type(sensitivity_t), intent(in) :: study             !! the study
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      type(result_table_t) :: table

      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene)// &
                        echo_settings(sensitivity_section(), loaded%sensitivity%keys), error)
      if (.not. allocated(error)) then
         call write_table_file("sensitivity.h5", "gudgeon sensitivity", plan, status_complete, &
                               [table_of_derivatives(study), table_of_results(study), table_of_parameters(study)], error)
      end if
      table = table_of_derivatives(study)
      if (.not. allocated(error)) call replace_file(plan%directory//"/sensitivity.csv", csv_text(table), error)
   end subroutine write_results

end module verb_sensitivity
