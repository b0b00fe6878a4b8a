!> `gudgeon sensitivity DECK`: derivatives of results by parameters of the deck, through impacts.
module verb_sensitivity
   use csv_table, only: csv_text
   use deck_parameters, only: deck_parameters_t
   use echo, only: echo_settings
   use errors, only: error_t
   use file_store, only: keep_files
   use find_sensitivity, only: find_sensitivities
   use kinds, only: wp
   use load, only: load_deck, loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use result_table, only: result_table_t
   use run_limits, only: limits_of
   use scene_echo, only: echo_scene
   use sensitivity_info, only: sensitivity_section
   use sensitivity_report, only: report_sensitivity
   use sensitivity_results, only: sensitivity_t
   use sensitivity_tables, only: table_of_derivatives, table_of_parameters, table_of_results
   use study_request, only: check_derivable, open_study
   use table_file, only: write_table_file
   use table_list, only: list_of
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

      type(deck_parameters_t), save, target :: source
      type(loaded_t), save :: loaded
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(sensitivity_t) :: study
      type(text_t), allocatable :: warnings(:)

      call keep_files()
      call load_deck(options, loaded, error)
      if (.not. allocated(error)) then
         call check_derivable(loaded, loaded%sensitivity%is_present, "section [sensitivity]", "sensitivities need", error)
      end if
      if (allocated(error)) return
      allocate (warnings(0))
      call limits_of(loaded%scene, loaded%catalogue, loaded%limits, warnings)
      call open_study(options, loaded, directory, plan, warnings, error)
      if (allocated(error)) return
      source%deck%options = options
      source%plan = loaded%sensitivity%plan
      if (options%change%tolerance > 0.0_wp) loaded%sensitivity%plan%tolerance = options%change%tolerance
      call find_sensitivities(loaded%job_t, source, loaded%sensitivity%plan, study, error)
      if (.not. allocated(error)) call write_results(loaded, plan, study, error)
      if (.not. allocated(error)) call report_sensitivity(options, loaded, plan, study, warnings, error)
      call directory%close()
   end subroutine derive_deck

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
                               list_of(table_of_derivatives(study), table_of_results(study), table_of_parameters(study)), error)
      end if
      table = table_of_derivatives(study)
      if (.not. allocated(error)) call replace_file(plan%directory//"/sensitivity.csv", csv_text(table), error)
   end subroutine write_results

end module verb_sensitivity
