!> The runs of a sweep, each in a process of its own, as many at once as wanted.
!>
!> A run is `gudgeon run DECK --set ... --member K`, so that it gives the very numbers of that command. One that fails is
!> recorded with its exit code and its message, its directory is kept, and the others go on.
module sweep_runs
   use errors, only: error_t
   use kinds, only: i8, wp
   use load, only: loaded_t
   use options, only: options_t
   use output_marker, only: enter_file
   use output_tree, only: remove_run
   use posix, only: n_processors, remove_file
   use processes, only: start_program, wait_any
   use progress, only: progress_t
   use recorder, only: status_running
   use sweep_values, only: sweep_t
   use sweep_work, only: sweep_work_t, write_results
   use text, only: append_text, text_t, to_text
   use text_file, only: fail_file
   implicit none (type, external)
   private
   public :: run_all

   real(wp), parameter :: write_interval = 10.0_wp  !! between two times that the results are written [s]

contains

   !> Run everything, as many at once as wanted.
   subroutine run_all(options, loaded, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(sweep_work_t), intent(inout) :: work                  !! the sweep
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
      type(sweep_work_t), intent(inout) :: work                  !! the sweep
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
      do k = 1, size(case%change%overrides)
         call add("--set", case%change%overrides(k)%s)
      end do
      if (case%change%is_ideal) call append_text(arguments, "--ideal")
      if (allocated(case%change%method)) call add("--method", case%change%method)
      if (case%change%tolerance > 0.0_wp) call add("--tolerance", to_exact(case%change%tolerance))
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
      type(sweep_work_t), intent(inout) :: work       !! the sweep

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
            call append_text(case%change%overrides, parameter%name//"="//parameter%texts(sweep%value_number(k, case_number))%s)
         end associate
      end do
   end function case_options

end module sweep_runs
