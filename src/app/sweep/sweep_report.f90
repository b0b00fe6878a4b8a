!> The figures of a sweep, and its summaries for people and for scripts.
module sweep_report
   use catalogue, only: catalogue_t
   use console, only: say
   use errors, only: error_t, exit_sweep, set_error
   use figure_binding, only: bind_figure
   use figure_phrase, only: mistake_t
   use figure_words, only: figure_contour, figure_statistics, figure_t, is_of_run
   use gnuplot_runs, only: draw_figures, make_folder
   use json_text, only: json_object_t
   use kept_histories, only: kept_histories_t, no_histories, read_kept
   use kinds, only: i8, wp
   use load, only: loaded_t
   use mechanism_catalogue, only: build_catalogue
   use members, only: cpu_of_all
   use options, only: options_t
   use plot_table, only: plot_table_t, tell_empty, write_plot
   use recorder, only: status_complete, status_failed, status_stopped
   use report_page, only: report_name
   use result_table, only: result_table_t
   use sweep_map, only: write_sweep_map
   use sweep_plots, only: sweep_table
   use sweep_tables, only: shown_cases
   use sweep_work, only: failure_text, sweep_work_t
   use study_page, only: study_page_text
   use study_summary, only: add_output
   use text, only: append_text, counted, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: replace_file
   use text_of_table, only: add_table
   use text_table, only: file_heading
   use version, only: program_version
   implicit none (type, external)
   private
   public :: make_sweep_figures, report_sweep

contains

   !> The figures of the sweep.
   subroutine make_sweep_figures(loaded, work, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(sweep_work_t), intent(in) :: work                           !! the sweep
      type(text_t), allocatable, intent(inout) :: pictures(:)    !! (n) grown
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(catalogue_t) :: catalogue
      type(figure_t) :: figure
      type(plot_table_t) :: table
      type(text_t), allocatable :: empty(:), names(:)
      type(mistake_t), allocatable :: mistake
      character(:), allocatable :: folder
      integer :: k
      logical :: is_written

      call build_catalogue(loaded%system, catalogue)
      folder = work%plan%directory//"/figures"
      allocate (names(0))
      do k = 1, size(loaded%figures)
         figure = loaded%figures(k)
         call bind_figure(figure, catalogue, mistake)
         if (allocated(mistake) .or. is_of_run(figure)) cycle
         call make_folder(folder, error)
         if (allocated(error)) return
         if (figure%kind == figure_contour) then
            call write_sweep_map(folder, loaded%scene%title, figure%name, figure%arguments(1)%s, work%results, &
                                 file_heading(work%plan), is_written, error)
         else
            call sweep_table(figure, work%results, catalogue, file_heading(work%plan), table)
            call write_plot(folder, loaded%scene%title, table, is_written, error, empty)
            if (.not. allocated(error)) call tell_empty(figure%word, empty, warnings)
         end if
         if (allocated(error)) return
         if (is_written) then
            call append_text(names, figure%name)
         else
            call append_text(warnings, "figure "//figure%word//": no data to draw")
         end if
      end do
      call draw_figures(folder, names, pictures, warnings)
   end subroutine make_sweep_figures

   !> Numbers that figures of the sweep draw over its cases, each between commas: of `statistics(NUMBER,...)` and `contour(NUMBER)`.
   function drawn_numbers(loaded) result(list)
      type(loaded_t), intent(in) :: loaded     !! the deck
      character(:), allocatable :: list        !! as `,motor.moment.peak,motor.moment.rms,`

      integer :: i, k

      list = ","
      do k = 1, size(loaded%figures)
         if (all(loaded%figures(k)%kind /= [figure_statistics, figure_contour])) cycle
         do i = 1, size(loaded%figures(k)%arguments)
            list = list//loaded%figures(k)%arguments(i)%s//","
         end do
      end do
   end function drawn_numbers

   !> The summaries, and the error if part of the runs failed.
   !>
   !> Length: a line of the summary after the other.
   subroutine report_sweep(options, loaded, work, pictures, warnings, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(sweep_work_t), intent(in) :: work                     !! the sweep
      type(text_t), intent(in) :: pictures(:)              !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)              !! (m) what was not made
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written, or part of the runs failed

      character(*), parameter :: files = "sweep.h5, sweep.csv (runs), cases.csv (means and standard deviations)"
      type(buffer_t) :: lines
      type(json_object_t) :: json
      character(:), allocatable :: state
      integer :: k, shown

      state = status_complete
      if (work%n_failed() > 0) state = status_failed
      if (work%n_missing() > 0) state = status_stopped
      call lines%line(loaded%scene%title)
      call lines%line(headline())
      if (work%shard > 0) call lines%line("part "//to_text(work%shard)//" of "//to_text(work%n_shards)//": "// &
                                          counted(work%n_mine(), "run", "runs"))
      if (work%n_made > 0) then
         call lines%line(counted(work%n_made, "run", "runs")//" made now; CPU time "//real_text(cpu_of_all(), 4)//" s, of that "// &
                         real_text(work%cpu_made, 4)//" s in integration and output")
      else if (work%n_missing() == 0) then
         call lines%line("all runs were complete already")
      end if
      shown = 0
      do k = 1, size(work%results%runs)
         if (work%results%runs(k)%exit_code <= 0 .or. shown == 10) cycle
         shown = shown + 1
         call lines%line("  run "//to_text(k)//": exit code "//to_text(work%results%runs(k)%exit_code)//", "// &
                         work%results%runs(k)%message)
      end do
      if (work%shard == 0 .and. loaded%sweep%n_cases() > 1) call add_table(lines, shown_cases(work%results, drawn_numbers(loaded)))
      call add_output(lines, work%plan%directory, files(:merge(len(files), 0, work%shard == 0))//page_name(), pictures, warnings)
      call fill_json()
      call write_summaries(lines%get(), json%get()//new_line("a"))
      if (.not. allocated(error) .and. len(page_name()) > 0) call write_page(loaded, work, state, headline(), warnings, error)
      if (state == status_complete .or. allocated(error)) return
      call set_error(error, exit_sweep, failure_text(work)//where_text())

   contains

      !> The same for scripts.
      subroutine fill_json()
         call json%start(0)
         call json%put_text("program", "gudgeon "//program_version)
         call json%put_text("deck", loaded%path)
         call json%put_text("title", loaded%scene%title)
         call json%put_text("directory", work%plan%directory)
         call json%put_text("status", state)
         call json%put_text("message", failure_text(work))
         call json%put_integer("cases", int(loaded%sweep%n_cases(), i8))
         call json%put_integer("runs", int(work%n_mine(), i8))
         call json%put_integer("made", int(work%n_made, i8))
         call json%put_integer("failed", int(work%n_failed(), i8))
         call json%put_integer("missing", int(work%n_missing(), i8))
         call json%put_real("cpu_runs", work%cpu_made)
         call json%put_real("cpu_all", cpu_of_all())
         call json%put_list("figures", pictures)
         call json%put_list("warnings", warnings)
      end subroutine fill_json

      !> How many cases and runs.
      function headline() result(words)
         character(:), allocatable :: words     !! one line

         words = counted(loaded%sweep%n_cases(), "case", "cases")//" of "//counted(work%results%n_member, "run", "runs")//": "// &
                 to_text(count(work%results%runs%exit_code == 0))//" done, "//to_text(work%n_failed())//" failed"//missing_text()
      end function headline

      !> The page of the sweep, if it is requested.
      function page_name() result(words)
         character(:), allocatable :: words     !! with a comma before it

         words = ""
         if (work%shard == 0 .and. loaded%scene%settings%output%flag("report")) words = ", "//report_name
      end function page_name

      !> How many runs are missing, if any.
      function missing_text() result(words)
         character(:), allocatable :: words     !! with a comma before it

         words = ""
         if (work%n_missing() > 0) words = ", "//to_text(work%n_missing())//" missing"
      end function missing_text

      !> Where more is said about runs that failed.
      function where_text() result(words)
         character(:), allocatable :: words     !! behind the number of them

         words = ""
         do k = 1, size(work%results%runs)
            if (work%results%runs(k)%exit_code <= 0) cycle
            words = "; messages in "//work%directories(k)%s(:index(work%directories(k)%s, "/", back=.true.))//"*.log"
            return
         end do
      end function where_text

      !> Write and show them.
      subroutine write_summaries(text, object)
         character(*), intent(in) :: text       !! for people
         character(*), intent(in) :: object     !! for scripts

         call replace_file(work%plan%directory//"/summary.txt", text, error)
         if (.not. allocated(error)) call replace_file(work%plan%directory//"/summary.json", object, error)
         if (options%is_json) then
            call say(object(1:len(object) - 1))
         else if (.not. options%is_quiet) then
            call say(text(1:len(text) - 1))
         end if
      end subroutine write_summaries

   end subroutine report_sweep

   !> The page.
   subroutine write_page(loaded, work, state, headline, warnings, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(sweep_work_t), intent(in) :: work               !! the sweep
      character(*), intent(in) :: state                    !! of the sweep
      character(*), intent(in) :: headline                 !! how many cases and runs
      type(text_t), intent(in) :: warnings(:)              !! (m) what was noticed
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be read or written

      type(kept_histories_t) :: histories
      type(result_table_t) :: no_tables(0)
      type(text_t) :: no_pictures(0)

      call no_histories(histories)
      if (loaded%sweep%keeps_channels) then
         call read_kept(work%plan%directory//"/sweep.h5", size(work%results%runs), histories, error)
         if (allocated(error)) return
      end if
      call replace_file(work%plan%directory//"/"//report_name, &
                        study_page_text(work%plan, state, headline, warnings, no_tables, no_pictures, work%results, &
                                        drawn_numbers(loaded), histories), error)
   end subroutine write_page

end module sweep_report
