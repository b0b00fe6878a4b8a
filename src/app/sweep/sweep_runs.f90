!> The runs of a sweep, each in a process of its own, as many at once as requested.
!>
!> The process of a run is a copy of this one, which has read the deck and all that it names: it does what `gudgeon run DECK
!> --set ... --member K` does, and gives the very numbers of that command. The first case is loaded here; from it each run goes to
!> its own, which reads again only what the parameters stand in (`load_case`). Where a case has many runs that is done here, once
!> for all of them; with few jobs too, before the copy is made: pages that both processes write cost more. Many jobs would wait for
!> it. What a run found comes back and is written to the journal at once. A run that fails is recorded with its exit code and its
!> message, and the others continue. Messages go to a file that the runs of one job use one after the other; it becomes that of a
!> run that fails.
module sweep_runs
   use errors, only: error_t, exit_file, exit_ok, set_error
   use kinds, only: i8, wp
   use load, only: load_case, load_deck, loaded_t
   use member_result, only: member_result_t
   use members, only: hand_back, next_member, start_member
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_marker, only: enter_file
   use output_tree, only: remove_run
   use packed, only: packer_t, unpacker_t
   use posix, only: n_processors, path_exists, remove_file, rename_path, write_error
   use processes, only: end_process
   use progress, only: progress_t
   use recorder, only: status_running
   use swept, only: sweep_t
   use sweep_journal, only: run_record_t
   use sweep_work, only: runs_folder, sweep_work_t, write_results
   use text, only: append_text, exact_text, replace, text_t, to_text
   use text_file, only: fail_file
   use verb_run, only: run_loaded
   implicit none (type, external)
   private
   public :: run_all

   integer, parameter :: few_jobs = 4               !! so many do not wait for cases that are loaded one after the other [1]
   real(wp), parameter :: write_interval = 10.0_wp  !! minimum time between two times that the results are written [s]
   real(wp), parameter :: write_share = 200.0_wp    !! and this many times as long as writing them took [1]

   !> The case whose runs are being started.
   type :: ready_t
      integer :: number = 0                       !! of the case; 0: none
      integer :: loaded_number = 0                !! of the case that is loaded; 0: none
      type(options_t) :: options                  !! its command line
      type(loaded_t), pointer :: loaded           !! the deck of the case that is loaded
      type(error_t), allocatable :: error         !! the deck of that case has errors
      real(wp) :: cpu = 0.0_wp                    !! processor time of loading it, until a run has been charged with it [s]
   end type ready_t

contains

   !> Make all runs of this part that are not done.
   subroutine run_all(options, loaded, directory, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_directory_t), intent(inout) :: directory !! of the sweep
      type(sweep_work_t), intent(inout) :: work            !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! a process cannot be started, or a file not be written

      type(progress_t) :: display
      type(ready_t) :: ready
      type(loaded_t), save, target :: case
      type(text_t) :: none(0)
      character(:), allocatable :: bytes
      integer, allocatable :: due(:), processes(:), run_of(:)
      integer :: code, ended, job, k, next, process
      integer(i8) :: began, now, rate
      real(wp) :: interval

      due = pack([(k, k=1, size(work%is_done))], work%is_mine([(k, k=1, size(work%is_done))]) .and. .not. work%is_done)
      k = merge(options%runs%jobs, n_processors(), options%runs%jobs > 0)
      allocate (processes(k), run_of(k), source=0)
      call display%start(.not. options%is_quiet)
      call system_clock(began, rate)
      interval = 0.0_wp
      ready%loaded => case
      next = 1
      ended = 0
      do while (ended < size(due))
         do while (next - ended <= size(processes) .and. next <= size(due))
            call make_ready(options, loaded%sweep, due(next), work, ready)
            if (ready%loaded_number == 0 .or. work%results%n_member > 1 .or. size(processes) <= few_jobs) call turn_to_case(ready)
            job = findloc(processes, 0, dim=1)
            run_of(job) = due(next)
            call start_run(ready, run_of(job), log_of_job(work, job), directory, work, processes(job), error)
            if (allocated(error)) return
            next = next + 1
         end do
         call next_member(process, code, bytes)
         job = findloc(processes, process, dim=1)
         if (process == 0 .or. job == 0) exit
         processes(job) = 0
         call end_run(run_of(job), code, bytes, loaded%sweep%keeps_channels, log_of_job(work, job), work, error)
         if (.not. allocated(error) .and. work%results%runs(run_of(job))%exit_code == exit_file) call check_place(work, error)
         if (allocated(error)) return
         ended = ended + 1
         call display%update(real(ended, wp)/real(size(due), wp))
         call system_clock(now)
         if (work%shard > 0 .or. seconds(began, now) < interval) cycle
         call write_results(work, status_running, "", none, error)
         if (allocated(error)) return
         call system_clock(began)
         interval = max(write_interval, write_share*seconds(now, began))
      end do
      call display%finish()
      call remove_logs(work, run_of)

   contains

      !> Time between two readings of the clock.
      pure real(wp) function seconds(from, to)
         integer(i8), intent(in) :: from  !! the earlier
         integer(i8), intent(in) :: to    !! the later

         seconds = real(to - from, wp)/real(rate, wp)  ! [s]
      end function seconds

   end subroutine run_all

   !> Remove the files that the messages of runs went to.
   subroutine remove_logs(work, run_of)
      type(sweep_work_t), intent(in) :: work   !! the sweep
      integer, intent(in) :: run_of(:)         !! (jobs) number of the last run of each; 0: it made none

      integer :: code, job

      do job = 1, size(run_of)
         if (run_of(job) > 0) code = remove_file(log_of_job(work, job))
      end do
   end subroutine remove_logs

   !> After a run that could not write: whether the directory is still there; the journal may go to a file that nobody can find.
   subroutine check_place(work, error)
      type(sweep_work_t), intent(in) :: work               !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! it is not

      associate (place => work%plan%directory//runs_folder)
         if (.not. path_exists(place)) call set_error(error, exit_file, "the directory "//place// &
                                                      " was removed during the sweep; run the sweep again")
      end associate
   end subroutine check_place

   !> Turn to the case of a run, if it is another than that of the last.
   subroutine make_ready(options, sweep, number, work, ready)
      type(options_t), intent(in) :: options               !! the command line
      type(sweep_t), intent(in) :: sweep                   !! the cases
      integer, intent(in) :: number                        !! of the run
      type(sweep_work_t), intent(in) :: work               !! the sweep
      type(ready_t), intent(inout) :: ready                !! its case

      integer :: case_number

      case_number = (number - 1)/work%results%n_member + 1
      if (ready%number /= case_number) then
         ready%number = case_number
         ready%options = case_options(options, sweep, case_number)
      end if
      if (work%results%is_ensemble) ready%options%change%member = mod(number - 1, work%results%n_member) + 1
      ready%options%directory = work%directories(number)%s
   end subroutine make_ready

   !> Load a case, unless that is done: from the one that is loaded, if that has no errors.
   subroutine turn_to_case(ready)
      type(ready_t), intent(inout) :: ready   !! the case

      real(wp) :: after, before

      if (ready%loaded_number == ready%number) return
      call cpu_time(before)
      if (ready%loaded_number > 0 .and. .not. allocated(ready%error)) then
         call load_case(ready%options, ready%loaded, ready%error)
      else
         call load_deck(ready%options, ready%loaded, ready%error)
      end if
      ready%loaded_number = ready%number
      call cpu_time(after)
      ready%cpu = after - before
   end subroutine turn_to_case

   !> File that the runs of a job say to what they have to say.
   function log_of_job(work, job) result(path)
      type(sweep_work_t), intent(in) :: work       !! the sweep
      integer, intent(in) :: job                   !! number of the job
      character(:), allocatable :: path            !! of the file

      path = work%plan%directory//runs_folder//"/job-"//to_text(job)//".log"
   end function log_of_job

   !> Start a run. The copy of this process that makes it ends here.
   subroutine start_run(ready, number, log, directory, work, process, error)
      type(ready_t), intent(inout) :: ready                !! its case
      integer, intent(in) :: number                        !! of the run
      character(*), intent(in) :: log                      !! file for its messages
      type(output_directory_t), intent(inout) :: directory !! of the sweep
      type(sweep_work_t), intent(in) :: work               !! the sweep
      integer, intent(out) :: process                      !! number of the process
      type(error_t), allocatable, intent(out) :: error     !! it cannot be started

      integer :: code

      associate (place => work%directories(number)%s)
         code = enter_file(log)
         if (code == 0 .and. work%results%sweep%keeps_channels) code = enter_file(place//"/")
         if (path_exists(place)) call remove_run(place, code)
         process = -1
         if (code == 0) code = start_member(log, process)
         if (process == 0) then
            call directory%leave()
            if (code /= 0) call end_process(exit_file)
            call make_run(ready)
         end if
         if (code /= 0) call fail_file(error, "cannot start run "//to_text(number)//" of", place, code, "")
      end associate
      ready%cpu = 0.0_wp
   end subroutine start_run

   !> In the copy: make the run, hand back what it gave, and end.
   subroutine make_run(ready)
      type(ready_t), intent(inout) :: ready  !! its case

      type(error_t), allocatable :: error
      type(member_result_t) :: member
      type(packer_t) :: packer
      real(wp) :: now, start
      integer :: code

      start = ready%cpu
      ready%cpu = 0.0_wp
      call turn_to_case(ready)
      member%cpu_start = start + ready%cpu
      call cpu_time(start)
      if (allocated(ready%error)) then
         call move_alloc(ready%error, error)
      else
         call run_loaded(ready%options, ready%loaded, error, member)
      end if
      call member%complete()
      code = exit_ok
      if (allocated(error)) then
         code = error%code
         call write_error("error: "//error%message//new_line("a")//"  = as a single run: "//command_of(ready%options)// &
                          new_line("a"))
      end if
      call cpu_time(now)
      member%cpu_run = now - start
      call member%pack(packer)
      if (hand_back(packer%bytes%get()) /= 0) code = exit_file
      call end_process(code)
   end subroutine make_run

   !> Take what a run left behind.
   subroutine end_run(number, code, bytes, keeps_channels, log, work, error)
      integer, intent(in) :: number                      !! of the run
      integer, intent(in) :: code                        !! its exit code
      character(*), intent(in) :: bytes                  !! what it handed back
      logical, intent(in) :: keeps_channels              !! whether it has a directory
      character(*), intent(in) :: log                    !! file of its messages
      type(sweep_work_t), intent(inout) :: work          !! the sweep
      type(error_t), allocatable, intent(out) :: error   !! the journal cannot be written

      type(run_record_t) :: record
      type(unpacker_t) :: unpacker
      integer :: ignored

      record%number = number
      record%exit_code = code
      record%message = ""
      unpacker%bytes = bytes
      call record%member%unpack(unpacker)
      if (.not. unpacker%is_good) then
         record%member = member_result_t()
         call record%member%complete()
         if (code == exit_ok) record%exit_code = exit_file
      end if
      if (record%exit_code /= exit_ok) then
         record%message = message_of(log, record%exit_code)
         ignored = enter_file(work%directories(number)%s//".log")
         if (ignored == 0) ignored = rename_path(log, work%directories(number)%s//".log")
      end if
      call work%results%take(record)
      work%n_made = work%n_made + 1
      work%cpu_made = work%cpu_made + record%member%cpu_run
      call work%journal%add(record, error)
   end subroutine end_run

   !> Why a run failed: its error message, without the picture of the place.
   function message_of(log, code) result(message)
      character(*), intent(in) :: log            !! file of its messages
      integer, intent(in) :: code                !! its exit code
      character(:), allocatable :: message       !! one line

      character(1024) :: line
      integer :: status, unit

      message = "exit code "//to_text(code)
      if (code > 128) message = "killed by signal "//to_text(code - 128)
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

   !> The command line of a case: that of the sweep and the case's parameters.
   function case_options(options, sweep, case_number) result(case)
      type(options_t), intent(in) :: options         !! the command line
      type(sweep_t), intent(in) :: sweep             !! the cases
      integer, intent(in) :: case_number             !! of the case
      type(options_t) :: case                        !! for one run

      integer :: k

      case = options
      case%verb = "run"
      case%is_quiet = .true.
      case%is_json = .false.
      case%runs%is_member = .true.
      case%runs%has_known_words = .true.  ! numbers alone are swept: what there is to report is what the deck has
      do k = 1, size(sweep%parameters)
         if (sweep%parameters(k)%unit == "") case%runs%has_known_words = .false.
      end do
      case%write = trim(merge("channels", "nothing ", sweep%keeps_channels))
      do k = 1, size(sweep%parameters)
         associate (parameter => sweep%parameters(k))
            call append_text(case%change%overrides, parameter%name//"="//parameter%texts(sweep%value_number(k, case_number))%s)
         end associate
      end do
   end function case_options

   !> The command that makes a run alone.
   function command_of(case) result(command)
      type(options_t), intent(in) :: case            !! the run
      character(:), allocatable :: command           !! for a shell

      integer :: k

      command = "gudgeon run "//quoted(case%operands(1)%s)
      do k = 1, size(case%change%overrides)
         command = command//" --set "//quoted(case%change%overrides(k)%s)
      end do
      if (case%change%is_ideal) command = command//" --ideal"
      if (allocated(case%change%method)) command = command//" --method "//case%change%method
      if (case%change%tolerance > 0.0_wp) command = command//" --tolerance "//exact_text(case%change%tolerance)
      if (case%change%member > 0) command = command//" --member "//to_text(case%change%member)
   end function command_of

   !> A word for a shell, in quotes if it needs them.
   pure function quoted(word) result(s)
      character(*), intent(in) :: word         !! any word
      character(:), allocatable :: s           !! the same for a shell

      s = word
      if (verify(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./=:,^") == 0) return
      s = "'"//replace(word, "'", "'\''")//"'"
   end function quoted

end module sweep_runs
