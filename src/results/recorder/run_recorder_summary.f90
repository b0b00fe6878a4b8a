!> The summaries of a run, and what is shown of them.
submodule(run_recorder) run_recorder_summary
   use figure_words, only: is_of_run
   use figures, only: make_figures
   use output_plan, only: show_json, show_nothing, show_summary
   use plot_table, only: plot_table_t
   use posix, only: write_error
   use recorder, only: status_failed
   use report_page, only: report_name, report_text
   use standard_output, only: print_text
   use statistics_plots, only: statistics_table
   use summary_writer, only: summary_json, summary_lines
   use text_file, only: replace_file
   use text_table, only: file_heading
   use worn_surface, only: worn_surface_t
   implicit none (type, external)

contains

   !> Write the summaries and show what is requested of them.
   module procedure write_summary
      type(error_t), allocatable :: second
      character(:), allocatable :: json, lines
      integer :: k

      associate (summary => self%summary, outcome => self%outcome)
         if (.not. self%plan%with%summary .and. self%plan%show == show_nothing) return
         lines = summary_lines(self%plan, summary, outcome)
         json = summary_json(self%plan, self%summary, outcome)
         if (self%plan%with%report) then
            call replace_file(self%plan%directory//"/"//report_name, &
                              report_text(self%plan, summary, outcome, self%figures, lines), error)
         end if
         call replace_summaries(self, lines, json, second)
         call join_errors(error, second)
         if (self%plan%show == show_summary .and. summary%status /= status_failed) call print_text(lines, second)
         if (self%plan%show == show_json) call print_text(json, second)
         call join_errors(error, second)
         if (self%plan%show == show_summary .and. summary%status /= status_failed) return
         if (.not. (self%plan%with%summary .and. self%plan%with%warnings)) return
         do k = 1, size(outcome%warnings)
            call write_error("warning: "//outcome%warnings(k)%s//new_line("a"))
         end do
      end associate
   end procedure write_summary

   !> The summaries of a run that ends while its figures are made: they are replaced when those are there.
   module procedure write_without_figures
      type(outcome_t) :: outcome
      integer :: k

      if (self%is_broken .or. self%summary%status == status_stopped .or. .not. self%plan%with%figures) return
      if (.not. any([(is_of_run(self%figures(k)), k=1, size(self%figures))])) return
      outcome = self%outcome
      call append_text(outcome%warnings, "the run ended before its figures were drawn")
      call replace_summaries(self, summary_lines(self%plan, self%summary, outcome), &
                             summary_json(self%plan, self%summary, outcome), error)
   end procedure write_without_figures

   !> Write both summaries, whole.
   subroutine replace_summaries(self, lines, json, error)
      class(run_recorder_t), intent(in) :: self          !! the recorder
      character(*), intent(in) :: lines                  !! summary.txt
      character(*), intent(in) :: json                   !! summary.json
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      if (.not. self%plan%with%summary) return
      call replace_file(self%plan%directory//"/summary.txt", lines, error)
      if (.not. allocated(error)) call replace_file(self%plan%directory//"/summary.json", json, error)
   end subroutine replace_summaries

   !> Make the figures.
   module procedure draw_figures
      type(plot_table_t), allocatable :: tables(:)
      type(text_t), allocatable :: missing(:)
      type(worn_surface_t), allocatable :: worn(:)
      integer :: k

      call memory_is_for("the figures")
      allocate (tables(size(self%figures)))
      do k = 1, size(tables)
         call statistics_table(self%figures(k), self%statistics, self%items, self%events, self%summary%time_end, &
                               file_heading(self%plan), tables(k))
      end do
      allocate (worn(0))
      if (allocated(self%summary%worn)) worn = self%summary%worn
      call make_figures(self%plan%directory, self%plan%title, self%figures, self%items, self%extremes, self%rows, &
                        self%ideal_rows, tables, self%fields, worn, self%plan%looks%drawing, self%keeper, self%outcome%pictures, &
                        missing, error)
      call append_all(self%outcome%warnings, missing)
   end procedure draw_figures

end submodule run_recorder_summary
