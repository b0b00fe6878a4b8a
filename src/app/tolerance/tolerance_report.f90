!> The summaries of a study of tolerances, for people and for scripts.
module tolerance_report
   use errors, only: error_t
   use json_text, only: json_object_t
   use kept_histories, only: kept_histories_t, no_histories
   use kinds, only: wp
   use load, only: loaded_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use polynomial_study, only: most_missed
   use recorder, only: status_complete
   use report_page, only: report_name
   use result_table, only: result_table_t
   use study_page, only: study_page_text
   use study_summary, only: add_output, show_summaries, start_summary
   use sweep_results, only: sweep_results_t
   use table_list, only: append_tables, list_of
   use text, only: append_text, counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: replace_file
   use text_of_table, only: add_table
   use tolerance_object, only: put_tolerances
   use tolerance_plan, only: level_dynamic
   use tolerance_results, only: tolerance_study_t
   use tolerance_study, only: is_accurate
   use tolerance_tables, only: table_of_contributors, table_of_requests, table_of_splits, table_of_widths
   use worst_members_table, only: table_of_worst
   implicit none (type, external)
   private
   public :: note_members, note_runs, report_tolerances

contains

   !> What a careful reader should know of the members.
   subroutine note_members(study, warnings)
      type(tolerance_study_t), intent(in) :: study              !! the study
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown

      if (.not. study%derivatives%has_curvatures) then
         call append_text(warnings, "a mechanism next to the nominal one cannot be assembled: means to second order lack parts")
      end if
      if (study%n_open > 0 .and. .not. study%members%is_exact) then
         call append_text(warnings, to_text(study%n_open)//" of "//to_text(study%n_checked)//" checked members cannot be "// &
                          "assembled: the yield by the expansion does not count such; use method = exact")
      end if
      if (study%indices%open > 0) then
         call append_text(warnings, to_text(study%indices%open)//" of "//to_text(study%plan%sampling%points)//" points of the "// &
                          "indices have members that cannot be assembled: the indices are those of the others")
      end if
      if (study%members%is_exact .or. study%n_open > 0) return
      if (.not. is_accurate(study)) then
         call append_text(warnings, "the error of the expansion exceeds accuracy = "// &
                          real_text(study%plan%sampling%accuracy, 3)//" of a standard deviation; use "// &
                          "method = exact, or a larger budget")
      end if
   end subroutine note_members

   !> What a careful reader should know of members that were run.
   subroutine note_runs(study, warnings)
      type(tolerance_study_t), intent(in) :: study              !! the study
      type(text_t), allocatable, intent(inout) :: warnings(:)   !! (any) grown

      integer :: k

      if (.not. study%derivatives%has_curvatures) then
         call append_text(warnings, "too few members or too many failed runs for some derivatives: they are stated as zero")
      end if
      if (study%members%open > 0) then
         call append_text(warnings, to_text(study%members%open)//" of "//to_text(study%members%n)//" members failed: see "// &
                          "sweep.csv; the yield counts them as failed parts")
      end if
      if (allocated(study%indices%missed)) then
         do k = 1, size(study%requests)
            if (study%indices%missed(k) > most_missed) call append_text(warnings, "a polynomial misses "// &
               real_text(min(100.0_wp*study%indices%missed(k), 100.0_wp), 2)//" % of the variance of "//study%requests(k)%name// &
               ": it has no indices; give more members, or use indices = plan")
         end do
      else if (study%indices%open > 0) then
         call append_text(warnings, to_text(study%indices%open)//" of "//to_text(study%plan%sampling%points)//" points of the "// &
                          "indices have members that failed: the indices are those of the others")
      end if
   end subroutine note_runs

   !> Write and show the summaries, and write the page if the deck asks for it.
   subroutine report_tolerances(options, loaded, plan, study, pictures, warnings, error, results)
      type(options_t), intent(in) :: options                 !! the command line
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(tolerance_study_t), intent(in) :: study           !! the study
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      type(error_t), allocatable, intent(out) :: error       !! a file cannot be written
      type(sweep_results_t), intent(in), optional :: results !! of the runs, where there are some

      character(:), allocatable :: files, first, object, page, text
      type(kept_histories_t) :: histories

      files = "tolerance.h5, tolerance.csv, tolerance_derivatives.csv"
      if (study%plan%level == level_dynamic) files = files//", sweep.csv (runs)"
      if (loaded%scene%settings%output%flag("report")) then
         files = files//", "//report_name
         first = headline(study)//"; members: "//words_of_members(study)
         if (any(study%requests%is_limited)) first = first//"; yield: "//words_of_yield(study)
         if (present(results)) then
            call no_histories(histories)
            page = study_page_text(plan, status_complete, first, warnings, tables_of(study), pictures, results, &
                                   requested(study), histories)
         else
            page = study_page_text(plan, status_complete, first, warnings, tables_of(study), pictures)
         end if
         call replace_file(plan%directory//"/"//report_name, page, error)
         if (allocated(error)) return
      end if
      text = text_of(plan, study, files, pictures, warnings)
      object = object_of(loaded, plan, study, pictures, warnings)
      call show_summaries(options, plan%directory, text, object, error)
   end subroutine report_tolerances

   !> Numbers that are studied, each between commas.
   function requested(study) result(list)
      type(tolerance_study_t), intent(in) :: study           !! the study
      character(:), allocatable :: list                      !! as `,motor.moment.rms,`

      integer :: k

      list = ","
      do k = 1, size(study%requests)
         list = list//study%requests(k)%name//","
      end do
   end function requested

   !> The tables for people.
   function tables_of(study) result(tables)
      type(tolerance_study_t), intent(in) :: study           !! the study
      type(result_table_t), allocatable :: tables(:)         !! (2 or more) in their order

      tables = list_of(table_of_requests(study))
      if (allocated(study%splits)) call append_tables(tables, list_of(table_of_splits(study)))
      call append_tables(tables, list_of(table_of_contributors(study), table_of_worst(study)))
      if (allocated(study%allocations)) call append_tables(tables, list_of(table_of_widths(study)))
   end function tables_of

   !> What was studied.
   function headline(study) result(words)
      type(tolerance_study_t), intent(in) :: study           !! the study
      character(:), allocatable :: words                     !! one line

      words = "complete: "//counted(size(study%plan%parameters), "toleranced parameter", "toleranced parameters")
      if (study%plan%level == level_dynamic) then
         words = words//", simulated"
      else
         words = words//", "//counted(size(study%pins), "joint with clearance", "joints with clearance")//", "// &
                 counted(size(study%derivatives%instants), "output time", "output times")
      end if
   end function headline

   !> How many members there are, and how they were made.
   function words_of_members(study) result(words)
      type(tolerance_study_t), intent(in) :: study           !! the study
      character(:), allocatable :: words                     !! one line

      associate (members => study%members)
         if (study%plan%level == level_dynamic) then
            words = to_text(members%n)//" run, "//to_text(members%open)//" failed"
         else
            words = to_text(members%n)//trim(merge(" assembled       ", " by the expansion", members%is_exact))//", "// &
                    to_text(members%open)//" cannot be assembled; "//to_text(study%n_checked)//" checked"
         end if
      end associate
   end function words_of_members

   !> The yield within all limits, with its interval.
   function words_of_yield(study) result(words)
      type(tolerance_study_t), intent(in) :: study           !! the study, with limits
      character(:), allocatable :: words                     !! one line

      associate (yield => study%members%yield)
         words = real_text(real(yield%good, wp)/real(yield%n, wp), 6)//", 95 %: "//real_text(yield%low, 6)//" to "// &
                 real_text(yield%high, 6)//" within all limits"
      end associate
   end function words_of_yield

   !> The summary for people.
   function text_of(plan, study, files, pictures, warnings) result(text)
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(tolerance_study_t), intent(in) :: study           !! the study
      character(*), intent(in) :: files                      !! written beside the summaries
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: text                      !! whole lines

      type(buffer_t) :: lines
      type(result_table_t), allocatable :: tables(:)
      integer :: k

      call lines%line(plan%title)
      call lines%line(headline(study))
      call lines%line("members    "//words_of_members(study))
      if (any(study%requests%is_limited)) call lines%line("yield      "//words_of_yield(study))
      tables = tables_of(study)
      do k = 1, size(tables)
         call add_table(lines, tables(k))
      end do
      call lines%line("")
      call add_output(lines, plan%directory, files, pictures, warnings)
      text = lines%get()
   end function text_of

   !> The summary for scripts.
   function object_of(loaded, plan, study, pictures, warnings) result(object)
      type(loaded_t), intent(in) :: loaded                   !! the deck
      type(output_plan_t), intent(in) :: plan                !! what files say
      type(tolerance_study_t), intent(in) :: study           !! the study
      type(text_t), intent(in) :: pictures(:)                !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)                !! (m) what was noticed
      character(:), allocatable :: object                    !! as text

      type(json_object_t) :: json

      call start_summary(json, loaded%path, plan, status_complete, "")
      call put_tolerances(json, study)
      call json%put_list("figures", pictures)
      call json%put_list("warnings", warnings)
      object = json%get()
   end function object_of

end module tolerance_report
