!> The summaries of a fit, for people and for scripts, and what a careful reader should know.
module fit_report
   use errors, only: error_t
   use fit_object, only: put_fit
   use fit_results, only: fit_t
   use fit_tables, only: table_of_correlations, table_of_search, table_of_sensors, table_of_unknowns
   use json_table, only: put_tables
   use json_text, only: json_object_t
   use kinds, only: wp
   use least_squares, only: end_converged, end_limit
   use load, only: loaded_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use recorder, only: status_complete
   use study_summary, only: add_output, show_summaries, start_summary
   use table_list, only: list_of
   use text, only: append_text, counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: add_table
   implicit none (type, external)
   private
   public :: note_fit, report_fit

   real(wp), parameter :: at_bound = 2.0e-5_wp      !! distance from a bound, of the distance of both [1]
   real(wp), parameter :: odd = 1.5_wp              !! residuals over given standard deviations that are noted [1]

contains

   !> What a careful reader should know.
   subroutine note_fit(fit, warnings)
      type(fit_t), intent(in) :: fit                            !! the fit
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown

      character(:), allocatable :: words
      integer :: k

      do k = 1, size(fit%places)
         associate (place => fit%places(k))
            words = ""
            if (fit%partner(k) > 0) words = "; it cannot be separated from '"//fit%places(fit%partner(k))%name//"'"
            if (.not. fit%is_seen(k)) then
               call append_text(warnings, "the data do not see '"//place%name//"'"//words)
            else if (words /= "") then
               call append_text(warnings, "correlation of '"//place%name//"'"//words)
            else if (min(fit%value(k) - place%lower, place%upper - fit%value(k)) < at_bound*(place%upper - place%lower)) then
               call append_text(warnings, "'"//place%name//"' is at a bound: the data ask for a value beyond")
            end if
         end associate
      end do
      do k = 1, size(fit%sets)
         if (fit%sets(k)%until < huge(1.0_wp)) then
            call append_text(warnings, "set '"//fit%sets(k)%name//"': data from t = "//real_text(fit%sets(k)%until, 4)// &
                             " s on are not fitted: "//fit%sets(k)%reason)
         end if
      end do
      if (fit%search%end == end_limit) then
         call append_text(warnings, "the search ended after too many iterations: start nearer, or use until in [fit.study]")
      else if (fit%search%end /= end_converged) then
         call append_text(warnings, "the search ended where no step was better, short of its criteria")
      end if
      if (all(fit%sensors%is_given) .and. fit%deviation_of_residuals > odd) then
         call append_text(warnings, "residuals are "//real_text(fit%deviation_of_residuals, 3)//" times the given standard " &
                          //"deviations: the model or these are wrong, and the intervals too narrow")
      end if
   end subroutine note_fit

   !> Write and show the summaries.
   subroutine report_fit(options, loaded, plan, fit, pictures, warnings, error)
      type(options_t), intent(in) :: options                 !! the command line
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(fit_t), intent(in) :: fit                         !! the fit
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(out) :: error       !! a file cannot be written

      call show_summaries(options, plan%directory, text_of(options%write /= "numbers", plan, fit, pictures, warnings), &
                          object_of(loaded, plan, fit, pictures, warnings), error)
   end subroutine report_fit

   !> The summary for people.
   function text_of(has_files, plan, fit, pictures, warnings) result(text)
      logical, intent(in) :: has_files                       !! tables were written
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(fit_t), intent(in) :: fit                         !! the fit
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: text                      !! whole lines

      type(buffer_t) :: lines

      call lines%line(plan%title)
      call lines%line("complete: "//counted(size(fit%places), "unknown", "unknowns")//" from "//to_text(fit%n_data)//" data of "// &
                      counted(size(fit%sensors), "sensor", "sensors")//" in "//counted(size(fit%sets), "set", "sets")//"; "// &
                      counted(fit%search%n_derived, "derivative", "derivatives")//", "// &
                      counted(fit%search%n_motion, "motion", "motions"))
      call add_table(lines, table_of_unknowns(fit))
      if (size(fit%places) > 1) call add_table(lines, table_of_correlations(fit))
      call add_table(lines, table_of_sensors(fit))
      call lines%line("")
      call add_output(lines, plan%directory, trim(merge("fit.h5, fit.csv", "               ", has_files)), pictures, warnings)
      text = lines%get()
   end function text_of

   !> The summary for scripts.
   function object_of(loaded, plan, fit, pictures, warnings) result(object)
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(fit_t), intent(in) :: fit                         !! the fit
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: object                    !! as text

      type(json_object_t) :: json

      call start_summary(json, loaded%path, plan, status_complete, "")
      call put_fit(json, fit)
      call put_tables(json, list_of(table_of_search(fit), table_of_correlations(fit), table_of_sensors(fit)))
      call json%put_list("figures", pictures)
      call json%put_list("warnings", warnings)
      object = json%get()
   end function object_of

end module fit_report
