!> The files and figures of a study of tolerances, of all levels.
module tolerance_files
   use csv_table, only: csv_text
   use errors, only: error_t
   use gnuplot_runs, only: draw_figures, make_folder
   use load, only: loaded_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use result_table, only: result_table_t
   use scene_echo, only: echo_scene
   use study_request, only: echo_of_rows, echo_of_section
   use table_file, only: write_table_file
   use table_list, only: append_tables, list_of
   use text, only: text_t
   use text_file, only: replace_file
   use text_table, only: file_heading
   use tolerance_info, only: tolerance_joint_info, tolerance_limit_info, tolerance_study_info, tolerance_table_info
   use tolerance_plots, only: write_tolerance_plots
   use tolerance_results, only: tolerance_study_t
   use tolerance_rows, only: measured_lists
   use tolerance_tables, only: table_of_contributors, table_of_derivatives, table_of_histograms, table_of_requests, &
      table_of_splits, table_of_times, table_of_widths
   use worst_members_table, only: table_of_worst
   implicit none (type, external)
   private
   public :: write_study

contains

   !> The files and figures.
   subroutine write_study(loaded, plan, study, pictures, warnings, error)
      type(loaded_t), intent(inout) :: loaded                    !! the deck; defaults are noted
      type(output_plan_t), intent(in) :: plan                    !! what files say
      type(tolerance_study_t), intent(in) :: study               !! the study
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(result_table_t), allocatable :: tables(:)
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: folder

      allocate (pictures(0))
      call replace_file(plan%directory//"/deck.echo", echo_scene(loaded%deck, loaded%scene)//echo_of_tables(loaded), error)
      if (.not. allocated(error)) then
         tables = list_of(table_of_requests(study), table_of_contributors(study), table_of_times(study), &
                          table_of_derivatives(study), table_of_histograms(study))
         call append_tables(tables, list_of(table_of_worst(study)))
         if (allocated(study%allocations)) call append_tables(tables, list_of(table_of_widths(study)))
         if (allocated(study%splits)) call append_tables(tables, list_of(table_of_splits(study)))
         call write_table_file("tolerance.h5", "gudgeon tolerance", plan, status_complete, tables, error)
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
   end subroutine write_study

   !> The tables of tolerances for the echo.
   function echo_of_tables(loaded) result(text)
      type(loaded_t), intent(inout) :: loaded      !! the deck; defaults are noted
      character(:), allocatable :: text            !! tables of a deck

      text = echo_of_rows(loaded, tolerance_table_info(), measured_lists)
      text = text//echo_of_rows(loaded, tolerance_joint_info())
      text = text//echo_of_rows(loaded, tolerance_limit_info())
      text = text//echo_of_section(loaded, tolerance_study_info())
   end function echo_of_tables

end module tolerance_files
