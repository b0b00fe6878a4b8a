!> `gudgeon sweep DECK`: every case of [sweep] and every run of [ensemble], each in a process of its own.
!>
!> A run is `gudgeon run DECK --set ... --member K`, so that it gives the very numbers of that command, however many run side
!> by side. Runs are numbered case by case and collected by their number. A run that fails is recorded with its exit code and
!> its message, its directory is kept, and the others go on. What is done is in sweep.h5 and sweep.csv, which are written
!> anew now and then; directories of runs that are not in there yet are left where the sweep is killed.
module verb_sweep
   use item, only: place_of
   use build_info, only: compiler, git_sha1
   use catalogue, only: catalogue_t
   use console, only: say
   use deck_reader, only: deck_text, get_includes, sweep_t
   use errors, only: error_t, exit_sweep, exit_usage, set_error
   use figure_words, only: figure_t, is_of_run, new_figure
   use figures, only: draw_figures
   use json_text, only: json_object_t
   use kinds, only: i8, wp
   use libraries, only: library_versions
   use load, only: check_swept_words, load_deck, loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_marker, only: enter_file
   use output_plan, only: output_plan_t
   use output_tree, only: remove_run
   use mechanism_report, only: build_catalogue
   use plot_table, only: plot_table_t, write_plot
   use posix, only: make_directory, n_processors, own_path, path_exists, remove_file, remove_within
   use processes, only: start_program, wait_any
   use progress, only: progress_t
   use recorder, only: status_complete, status_failed, status_running
   use scene, only: analysis_dynamic
   use scene_echo, only: echo_scene
   use sweep_file, only: write_sweep
   use sweep_plots, only: sweep_table
   use sweep_results, only: cases_csv, runs_csv, sweep_results_t
   use text, only: append_text, buffer_t, text_t, to_text
   use text_file, only: fail_file, replace_file, write_file
   use text_table, only: file_heading
   use verb_run, only: directory_of
   use version, only: program_version
   implicit none (type, external)
   private
   public :: case_options, sweep_deck

   real(wp), parameter :: write_interval = 10.0_wp  !! between two times that the results are written [s]
   character(*), parameter :: runs_folder = "/runs"  !! where the runs are while they last

   !> A sweep that is under way.
   type :: work_t
      type(output_plan_t) :: plan                 !! what the files say
      type(sweep_results_t) :: results            !! what came of the runs
      type(text_t), allocatable :: directories(:) !! (runs) of the runs
      integer, allocatable :: processes(:)        !! (runs) numbers of their processes; 0: not running
      integer :: n_failed = 0                     !! runs that failed
      character(:), allocatable :: program        !! this program
   end type work_t

contains

   !> Run the sweep.
   subroutine sweep_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! mistakes, no directory, or part of the runs failed

      type(loaded_t) :: loaded
      type(output_directory_t) :: directory
      type(text_t), allocatable :: pictures(:), warnings(:)
      type(work_t) :: work

      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_request(options, loaded, error)
      if (.not. allocated(error)) call check_swept_words(options, loaded, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      warnings = directory%warnings
      call new_work(options, loaded, directory%path, work, error)
      if (.not. allocated(error)) call run_all(options, loaded, work, error)
      if (.not. allocated(error)) call finish(options, loaded, work, pictures, warnings, error)
      if (.not. allocated(error)) call report(options, loaded, work, pictures, warnings, error)
      call directory%close()
   end subroutine sweep_deck

   !> A sweep needs something to sweep, and its parameters must be free.
   subroutine check_request(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! what is missing, or set twice

      integer :: i, k

      if (.not. loaded%sweep%is_present .and. .not. loaded%scene%has_ensemble) then
         call set_error(error, exit_usage, "the deck has neither a section [sweep] nor [ensemble]"//new_line("a")// &
                        "  = 'gudgeon help sweep' tells how to write one; 'gudgeon run' runs the deck as it is")
      else if (loaded%is_stream) then
         call set_error(error, exit_usage, "a sweep reads its deck once for every run, so it cannot come through a pipe; "// &
                        "save it to a file")
      else if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "a sweep runs the section [analysis.dynamic], which the deck does not begin with")
      end if
      if (allocated(error)) return
      do k = 1, size(loaded%sweep%parameters)
         do i = 1, size(options%overrides)
            associate (word => options%overrides(i)%s)
               if (trim(adjustl(word(1:max(index(word, "=") - 1, 0)))) /= loaded%sweep%parameters(k)%name) cycle
               call set_error(error, exit_usage, "parameter '"//loaded%sweep%parameters(k)%name// &
                              "' is swept by the deck, so it cannot be set")
               return
            end associate
         end do
      end do
   end subroutine check_request

   !> The options with which a case runs: those of the command line and the case's parameters.
   function case_options(options, sweep, case_number) result(case)
      type(options_t), intent(in) :: options         !! the command line
      type(sweep_t), intent(in) :: sweep             !! the cases
      integer, intent(in) :: case_number             !! of the case
      type(options_t) :: case                        !! for one run

      integer :: k

      case = options
      do k = 1, size(sweep%parameters)
         associate (parameter => sweep%parameters(k))
            call append_text(case%overrides, parameter%name//"="//parameter%texts(sweep%value_number(k, case_number))%s)
         end associate
      end do
   end function case_options

   !> Everything before the first run.
   subroutine new_work(options, loaded, path, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      character(*), intent(in) :: path                     !! directory of the sweep
      type(work_t), intent(out) :: work                    !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! a directory cannot be made

      character(:), allocatable :: digits
      integer :: code, k

      work%plan%directory = path
      work%plan%deck_name = loaded%path
      work%plan%deck_text = deck_text(loaded%deck)
      work%plan%title = loaded%scene%title
      work%plan%program_version = program_version
      work%plan%git_sha1 = git_sha1
      work%plan%compiler = compiler
      work%plan%libraries = library_versions()
      work%plan%command = options%command
      call get_includes(loaded%deck, work%plan%include_names, work%plan%include_texts)
      call work%plan%complete()
      work%results%sweep = loaded%sweep
      work%results%is_ensemble = loaded%scene%has_ensemble
      if (loaded%scene%has_ensemble) then
         work%results%n_member = nint(loaded%scene%ensemble%number("runs"))
      end if
      call work%results%start()
      work%program = own_path()
      if (len(work%program) == 0) work%program = own_name()
      associate (n => size(work%results%runs))
         allocate (work%directories(n), work%processes(n))
         work%processes = 0
         do k = 1, n
            digits = to_text(k)
            work%directories(k)%s = path//runs_folder//"/"//repeat("0", max(0, len(to_text(n)) - len(digits)))//digits
         end do
      end associate
      call write_file(path//"/deck.echo", echo_scene(loaded%deck, loaded%scene), error)
      if (allocated(error)) return
      code = enter_file(path//runs_folder//"/")
      if (code == 0) code = make_directory(path//runs_folder)
      if (code /= 0) call fail_file(error, "cannot make the directory", path//runs_folder, code, "")
   end subroutine new_work

   !> The name under which this program was started.
   function own_name() result(name)
      character(:), allocatable :: name   !! a path, or a name along PATH

      integer :: length

      call get_command_argument(0, length=length)
      allocate (character(length) :: name)
      call get_command_argument(0, name)
   end function own_name

   !> Run everything, as many at once as wanted.
   subroutine run_all(options, loaded, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(work_t), intent(inout) :: work                  !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! a process cannot be started, or a file not be written

      type(progress_t) :: display
      type(text_t) :: none(0)
      integer :: code, ended, jobs, next, process, running
      integer(i8) :: now, rate, written_at

      jobs = options%jobs
      if (jobs == 0) jobs = n_processors()
      call display%start(.not. options%is_quiet)
      call system_clock(written_at, rate)
      next = 1
      running = 0
      ended = 0
      do while (ended < size(work%processes))
         do while (running < jobs .and. next <= size(work%processes))
            call start_run(options, loaded%sweep, next, work, error)
            if (allocated(error)) return
            next = next + 1
            running = running + 1
         end do
         process = wait_any(code)
         if (process == 0) exit
         if (all(work%processes /= process)) cycle
         call end_run(findloc(work%processes, process, dim=1), code, loaded%sweep%keeps_channels, work)
         running = running - 1
         ended = ended + 1
         call display%update(real(ended, wp)/real(size(work%processes), wp))
         call system_clock(now)
         if (ended > 1 .and. real(now - written_at, wp) < write_interval*real(rate, wp)) cycle
         call write_results(work, status_running, "", none, error)
         if (allocated(error)) return
         call system_clock(written_at)
      end do
      call display%finish()
   end subroutine run_all

   !> Start a run.
   subroutine start_run(options, sweep, number, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(sweep_t), intent(in) :: sweep                   !! the cases
      integer, intent(in) :: number                        !! of the run
      type(work_t), intent(inout) :: work                  !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! it cannot be started

      type(options_t) :: case
      type(text_t), allocatable :: arguments(:)
      integer :: code, k

      case = case_options(options, sweep, (number - 1)/work%results%n_member + 1)
      allocate (arguments(0))
      call add("run", case%operands(1)%s)
      call add("--out", work%directories(number)%s)
      call add("--write", trim(merge("channels", "numbers ", sweep%keeps_channels)))
      call append_text(arguments, "--quiet")
      do k = 1, size(case%overrides)
         call add("--set", case%overrides(k)%s)
      end do
      if (case%is_ideal) call append_text(arguments, "--ideal")
      if (allocated(case%method)) call add("--method", case%method)
      if (case%tolerance > 0.0_wp) call add("--tolerance", to_exact(case%tolerance))
      if (work%results%is_ensemble) call add("--member", to_text(mod(number - 1, work%results%n_member) + 1))
      associate (directory => work%directories(number)%s)
         code = enter_file(directory//".log")
         if (code == 0) code = enter_file(directory//"/")
         if (code == 0) code = start_program(".", work%program, arguments, directory//".log", .false., work%processes(number))
      end associate
      if (code /= 0) call fail_file(error, "cannot start", work%program, code, "")

   contains

      !> Add an option and its value.
      subroutine add(option, value)
         character(*), intent(in) :: option  !! the option
         character(*), intent(in) :: value   !! its value

         call append_text(arguments, option)
         call append_text(arguments, value)
      end subroutine add

   end subroutine start_run

   !> A number with all its digits.
   function to_exact(x) result(digits)
      real(wp), intent(in) :: x               !! the number [any]
      character(:), allocatable :: digits     !! as an option has it

      character(32) :: buffer

      write (buffer, "(es24.16e3)") x
      digits = trim(adjustl(buffer))
   end function to_exact

   !> Take what a run left behind.
   subroutine end_run(number, code, keeps_channels, work)
      integer, intent(in) :: number             !! of the run
      integer, intent(in) :: code               !! its exit code
      logical, intent(in) :: keeps_channels     !! whether its directory is needed at the end
      type(work_t), intent(inout) :: work       !! the sweep

      character(:), allocatable :: log, message
      integer :: ignored

      log = work%directories(number)%s//".log"
      message = ""
      if (code /= 0) message = message_of(log, code)
      call work%results%take(number, code, message, work%directories(number)%s//"/run.h5")
      work%processes(number) = 0
      if (code /= 0) then
         work%n_failed = work%n_failed + 1
         return
      end if
      ignored = remove_file(log)
      if (.not. keeps_channels) call remove_run(work%directories(number)%s, ignored)
   end subroutine end_run

   !> Why a run failed: its error message, without the picture of the place.
   function message_of(log, code) result(message)
      character(*), intent(in) :: log            !! file of its messages
      integer, intent(in) :: code                !! its exit code
      character(:), allocatable :: message       !! one line

      character(1024) :: line
      integer :: status, unit

      message = "ended with code "//to_text(code)
      if (code > 128) message = "ended by signal "//to_text(code - 128)
      open (newunit=unit, file=log, status="old", action="read", iostat=status)
      if (status /= 0) return
      do
         read (unit, "(a)", iostat=status) line
         if (status /= 0) exit
         if (index(line, "error: ") /= 1) cycle
         message = trim(line(len("error: ") + 1:))
         exit
      end do
      close (unit)
   end function message_of

   !> Write sweep.h5 and the tables.
   subroutine write_results(work, state, message, directories, error)
      type(work_t), intent(in) :: work                     !! the sweep
      character(*), intent(in) :: state                    !! of the sweep
      character(*), intent(in) :: message                  !! why, if not complete
      type(text_t), intent(in) :: directories(:)           !! (runs) whose channels are copied, or none
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      call write_sweep(work%plan, work%results, state, message, directories, error)
      if (.not. allocated(error)) call replace_file(work%plan%directory//"/sweep.csv", runs_csv(work%results), error)
      if (.not. allocated(error)) call replace_file(work%plan%directory//"/cases.csv", cases_csv(work%results), error)
   end subroutine write_results

   !> The last time that the results are written, the figures, and what is no longer needed is removed.
   subroutine finish(options, loaded, work, pictures, warnings, error)
      type(options_t), intent(in) :: options                     !! the command line
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(work_t), intent(in) :: work                           !! the sweep
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made, paths within the directory
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) what was noticed before, and what was not made
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: directories(:)
      integer :: ignored, k

      allocate (pictures(0), directories(0))
      if (loaded%sweep%keeps_channels) directories = work%directories
      call write_results(work, trim(merge(status_failed//"  ", status_complete, work%n_failed > 0)), failure_text(work), &
                         directories, error)
      if (allocated(error)) return
      do k = 1, size(directories)
         if (work%results%runs(k)%exit_code == 0) call remove_run(directories(k)%s, ignored)
      end do
      if (work%n_failed == 0) then
         ignored = remove_within(work%plan%directory, runs_folder(2:)//"/")
         if (path_exists(work%plan%directory//runs_folder)) then
            call append_text(warnings, work%plan%directory//runs_folder//" holds files that gudgeon did not make, so it stays")
         end if
      end if
      call make_sweep_figures(loaded, work, pictures, warnings, error)
   end subroutine finish

   !> The figures of the sweep.
   subroutine make_sweep_figures(loaded, work, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(work_t), intent(in) :: work                           !! the sweep
      type(text_t), allocatable, intent(inout) :: pictures(:)    !! (n) grown
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(catalogue_t) :: catalogue
      type(figure_t) :: figure
      type(plot_table_t) :: table
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: folder, hint, message
      integer :: code, k
      logical :: is_written

      call build_catalogue(loaded%system, catalogue)
      folder = work%plan%directory//"/figures"
      allocate (names(0))
      associate (words => loaded%scene%output%values(place_of(loaded%scene%output, "figures"))%words)
         do k = 1, size(words)
            call new_figure(words(k)%s, catalogue, figure, message, hint)
            if (len(message) > 0) cycle
            if (is_of_run(figure)) cycle
            code = enter_file(folder//"/")
            if (code == 0) code = make_directory(folder)
            if (code /= 0) then
               call fail_file(error, "cannot make the directory", folder, code, "")
               return
            end if
            call sweep_table(figure, work%results, catalogue, file_heading(work%plan), table)
            call write_plot(folder, loaded%scene%title, table, is_written, error)
            if (allocated(error)) return
            if (is_written) then
               call append_text(names, figure%name)
            else
               call append_text(warnings, "figure "//words(k)%s//": no numbers to draw")
            end if
         end do
      end associate
      call draw_figures(folder, names, pictures, warnings)
   end subroutine make_sweep_figures

   !> How many runs failed; blank if none.
   function failure_text(work) result(message)
      type(work_t), intent(in) :: work             !! the sweep
      character(:), allocatable :: message         !! one line

      message = ""
      if (work%n_failed > 0) message = to_text(work%n_failed)//" of "//to_text(size(work%results%runs))//" runs failed"
   end function failure_text

   !> The summaries, and the error if part of the runs failed.
   subroutine report(options, loaded, work, pictures, warnings, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(work_t), intent(in) :: work                     !! the sweep
      type(text_t), intent(in) :: pictures(:)              !! (n) pictures made
      type(text_t), intent(in) :: warnings(:)              !! (m) what was not made
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written, or part of the runs failed

      type(buffer_t) :: lines
      type(json_object_t) :: json
      integer :: k, shown

      call lines%line(loaded%scene%title)
      call lines%line(to_text(loaded%sweep%n_cases())//" cases of "//to_text(work%results%n_member)// &
                      trim(merge(" run: ", " runs:", work%results%n_member == 1))//" "// &
                      to_text(count(work%results%runs%exit_code == 0))//" done, "//to_text(work%n_failed)//" failed")
      shown = 0
      do k = 1, size(work%results%runs)
         if (work%results%runs(k)%exit_code == 0 .or. shown == 10) cycle
         shown = shown + 1
         call lines%line("  run "//to_text(k)//": exit code "//to_text(work%results%runs(k)%exit_code)//", "// &
                         work%results%runs(k)%message)
      end do
      call lines%line("output     "//work%plan%directory//"/")
      call lines%line("           sweep.h5, sweep.csv (runs), cases.csv (means and spreads)")
      do k = 1, size(pictures)
         call lines%line("           "//pictures(k)%s)
      end do
      do k = 1, size(warnings)
         call lines%line("warning: "//warnings(k)%s)
      end do
      call json%start(0)
      call json%put_text("program", "gudgeon "//program_version)
      call json%put_text("deck", loaded%path)
      call json%put_text("title", loaded%scene%title)
      call json%put_text("directory", work%plan%directory)
      call json%put_text("status", trim(merge(status_failed//"  ", status_complete, work%n_failed > 0)))
      call json%put_text("message", failure_text(work))
      call json%put_integer("cases", int(loaded%sweep%n_cases(), i8))
      call json%put_integer("runs", int(size(work%results%runs), i8))
      call json%put_integer("failed", int(work%n_failed, i8))
      call json%put_list("figures", pictures)
      call json%put_list("warnings", warnings)
      call write_summaries(lines%get(), json%get()//new_line("a"))
      if (work%n_failed > 0 .and. .not. allocated(error)) then
         call set_error(error, exit_sweep, failure_text(work)//"; they are in "//work%plan%directory//runs_folder// &
                        ", what they said in the .log files beside them")
      end if

   contains

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

   end subroutine report

end module verb_sweep
