!> The summaries of a study of sensitivities, for people and for scripts.
module sensitivity_report
   use errors, only: error_t
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: wp
   use load, only: loaded_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use result_table, only: result_table_t
   use sensitivity_object, only: put_sensitivity
   use sensitivity_results, only: sensitivity_t
   use sensitivity_tables, only: table_of_derivatives, table_of_motion, table_of_parameters, table_of_results
   use study_summary, only: add_output, show_summaries, start_summary
   use table_list, only: list_of
   use text, only: counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   implicit none (type, external)
   private
   public :: report_sensitivity

contains

   !> Write and show the summaries.
   subroutine report_sensitivity(options, loaded, plan, study, warnings, error)
      type(options_t), intent(in) :: options                 !! the command line
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(sensitivity_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(out) :: error       !! a file cannot be written

      character(:), allocatable :: object, text

      text = text_of(plan, study, warnings)
      object = object_of(loaded, plan, study, warnings)
      call show_summaries(options, plan%directory, text, object, error)
   end subroutine report_sensitivity

   !> The summary for people.
   function text_of(plan, study, warnings) result(text)
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(sensitivity_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: text                      !! whole lines

      type(buffer_t) :: lines
      type(result_table_t) :: table

      call lines%line(plan%title)
      call lines%line("complete: "//counted(size(study%plan%results), "result", "results")//" by "// &
                      counted(size(study%plan%parameters), "parameter", "parameters")//", "//to_text(study%n_step)//" steps, "// &
                      counted(study%n_event, "event", "events")//", tolerance "//real_text(study%plan%tolerance, 2))
      if (study%horizon < huge(1.0_wp)) then
         call lines%line("horizon    the contact sequence is not known from t = "//real_text(study%horizon, 6)//" s on")
      end if
      table = table_of_parameters(study)
      call add_table(lines, table)
      table = table_of_results(study)
      call add_table(lines, table)
      table = table_of_derivatives(study)
      call add_table(lines, table)
      call add_refusals(lines, study)
      call add_output(lines, plan%directory, "sensitivity.h5, sensitivity.csv", [text_t ::], warnings)
      text = lines%get()
   end function text_of

   !> Lines on what is refused.
   subroutine add_refusals(lines, study)
      type(buffer_t), intent(inout) :: lines      !! grown
      type(sensitivity_t), intent(in) :: study    !! the study

      integer :: k, p

      call lines%line("")
      do k = 1, size(study%reason, 2)
         do p = 1, size(study%reason, 1)
            if (study%reason(p, k)%s == "") cycle
            call lines%line("refused    "//study%plan%results(k)%word//" by "//study%plan%parameters(p)%s//": "// &
                            study%reason(p, k)%s)
         end do
      end do
   end subroutine add_refusals

   !> The summary for scripts.
   function object_of(loaded, plan, study, warnings) result(object)
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(sensitivity_t), intent(in) :: study               !! the study
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: object                    !! as text

      type(json_object_t) :: json

      call start_summary(json, loaded%path, plan, status_complete, "")
      call put_sensitivity(json, study)
      call put_tables(json, list_of(table_of_motion(study), table_of_parameters(study), table_of_results(study)))
      call json%put_list("warnings", warnings)
      object = json%get()
   end function object_of

end module sensitivity_report
