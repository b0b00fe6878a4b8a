!> The summaries of a study of modes, for people and for scripts.
module modes_report
   use errors, only: error_t
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use load, only: loaded_t
   use modes_object, only: put_modes
   use modes_results, only: modes_study_t
   use modes_tables, only: stability_of, table_of_campbell, table_of_modes, table_of_stability
   use options, only: options_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use study_summary, only: add_output, show_summaries, start_summary
   use table_list, only: list_of
   use text, only: counted, join, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   implicit none (type, external)
   private
   public :: report_modes

contains

   !> Write and show the summaries.
   subroutine report_modes(options, loaded, plan, study, pictures, error)
      type(options_t), intent(in) :: options                 !! the command line
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(modes_study_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(error_t), allocatable, intent(out) :: error       !! a file cannot be written

      type(json_object_t) :: json

      call start_summary(json, loaded%path, plan, status_complete, "")
      call put_modes(json, study)
      if (study%plan%parameter /= "") call put_tables(json, list_of(table_of_stability(study), table_of_campbell(study)))
      call json%put_list("warnings", study%warnings)
      call show_summaries(options, plan%directory, text_of(plan, study, pictures), json%get(), error)
   end subroutine report_modes

   !> The summary for people.
   function text_of(plan, study, pictures) result(text)
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(modes_study_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      character(:), allocatable :: text                      !! whole lines

      type(buffer_t) :: lines

      call lines%line(plan%title)
      associate (model => study%model)
         call lines%line("complete: "//counted(size(study%modes), "mode", "modes")//" of "// &
                         counted(model%n_free, "degree of freedom", "degrees of freedom"))
         call lines%line("state      "//study%state)
         call lines%line("           residual "//real_text(model%residual, 2)//" of the loads; axes "//study%plan%axes_name)
         if (size(study%modes) > 0) call lines%line("stability  "//stability_of(study))
         if (model%n_state > 2*model%n_free) call lines%line("           "//to_text(model%n_state - 2*model%n_free) &
                                                            //" other states: "//join(model%others, ", "))
         if (model%n_state == 0) call lines%line("           no modes: joints and drivers prescribe the motion of all bodies")
      end associate
      if (size(study%modes) > 0) call add_table(lines, table_of_modes(study))
      if (study%plan%parameter /= "") then
         call lines%line("")
         call lines%line("Campbell   "//counted(size(study%points), "value", "values")//" of "//study%plan%parameter//", " &
                         //counted(size(study%onsets), "change of stability", "changes of stability"))
         if (size(study%onsets) > 0) call add_table(lines, table_of_stability(study))
      end if
      call lines%line("")
      call add_output(lines, plan%directory, "modes.h5, modes.csv"// &
                      trim(merge(", campbell.csv", "              ", study%plan%parameter /= "")), pictures, study%warnings)
      text = lines%get()
   end function text_of

end module modes_report
