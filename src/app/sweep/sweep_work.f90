!> A sweep that is under way: its runs, where they are, what came of them, and the files that say so.
module sweep_work
   use csv_table, only: csv_text
   use errors, only: error_t, exit_assembly, exit_audit, exit_deck, exit_integration, exit_ok, exit_usage
   use file_store, only: kept_files
   use kinds, only: wp
   use load, only: loaded_t
   use members, only: program_identity
   use numbers, only: read_number
   use options, only: options_t
   use output_marker, only: enter_file
   use output_plan, only: output_plan_t
   use posix, only: make_directory, path_exists
   use run_plan, only: tell_origin
   use scene_echo, only: echo_scene
   use sweep_file, only: write_sweep
   use sweep_journal, only: journal_t, origin_of_sweep_t
   use sweep_results, only: sweep_results_t
   use sweep_tables, only: table_of_cases, table_of_runs
   use text, only: append_text, exact_text, starts_with, text_t, to_text
   use text_file, only: fail_file, replace_file
   implicit none (type, external)
   private
   public :: apply_settings, failure_text, new_sweep_work, origin_of_sweep, runs_folder, sweep_work_t, take_journal, write_results

   character(*), parameter :: runs_folder = "/runs"  !! where the runs are while they last
   integer, parameter :: lasting_codes(*) = [exit_ok, exit_usage, exit_deck, exit_assembly, exit_integration, exit_audit]
      !! exit codes that a run would end with again

   !> A sweep that is under way.
   type :: sweep_work_t
      type(output_plan_t) :: plan                 !! what the files say
      type(sweep_results_t) :: results            !! what came of the runs
      type(journal_t) :: journal                  !! the same, as it is kept for later
      type(text_t), allocatable :: directories(:) !! (runs) of the runs
      logical, allocatable :: is_done(:)          !! (runs) whether a run need not be made any more
      integer :: shard = 0                        !! part that is made here; 0: all
      integer :: n_shards = 1                     !! parts
      integer :: n_made = 0                       !! runs made here and now
      real(wp) :: cpu_made = 0.0_wp               !! processor time of their motions and output [s]
   contains
      procedure :: is_mine
      procedure :: n_mine
      procedure :: n_missing
      procedure :: n_failed
   end type sweep_work_t

contains

   !> Everything before the first run.
   subroutine new_sweep_work(options, loaded, path, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      character(*), intent(in) :: path                     !! directory of the sweep
      type(sweep_work_t), intent(inout) :: work            !! the sweep; its journal is known
      type(error_t), allocatable, intent(out) :: error     !! a directory cannot be made

      character(:), allocatable :: digits
      integer :: code, k

      work%plan%directory = path
      call tell_origin(options, loaded, work%plan)
      work%plan%title = loaded%scene%title
      call work%plan%complete()
      work%shard = options%runs%shard
      work%n_shards = options%runs%n_shards
      work%results%sweep = loaded%sweep
      work%results%is_ensemble = loaded%scene%settings%ensemble%is_present
      if (loaded%scene%settings%ensemble%is_present) then
         work%results%n_member = nint(loaded%scene%settings%ensemble%number("runs"))
      end if
      call work%results%start()
      associate (n => size(work%results%runs))
         allocate (work%directories(n), work%is_done(n))
         work%is_done = .false.
         do k = 1, n
            digits = to_text(k)
            work%directories(k)%s = path//runs_folder//"/"//repeat("0", max(0, len(to_text(n)) - len(digits)))//digits
         end do
      end associate
      call replace_file(path//"/deck.echo", echo_scene(loaded%deck, loaded%scene), error)
      if (allocated(error)) return
      code = enter_file(path//runs_folder//"/")
      if (code == 0) code = make_directory(path//runs_folder)
      if (code /= 0) call fail_file(error, "cannot make the directory", path//runs_folder, code, "")
   end subroutine new_sweep_work

   !> Whether a run belongs to the part that is made here.
   elemental logical function is_mine(self, number)
      class(sweep_work_t), intent(in) :: self  !! the sweep
      integer, intent(in) :: number            !! of the run

      is_mine = self%shard == 0
      if (self%shard > 0) is_mine = mod(number - 1, self%n_shards) == self%shard - 1
   end function is_mine

   !> Runs of the part that is made here.
   integer function n_mine(self)
      class(sweep_work_t), intent(in) :: self  !! the sweep

      integer :: k

      n_mine = count([(self%is_mine(k), k=1, size(self%is_done))])
   end function n_mine

   !> Those that have not been made.
   integer function n_missing(self)
      class(sweep_work_t), intent(in) :: self  !! the sweep

      integer :: k

      n_missing = count([(self%is_mine(k) .and. self%results%runs(k)%exit_code < 0, k=1, size(self%is_done))])
   end function n_missing

   !> Those that failed.
   pure integer function n_failed(self)
      class(sweep_work_t), intent(in) :: self  !! the sweep

      n_failed = count(self%results%runs%exit_code > 0)
   end function n_failed

   !> Take runs that a journal has. One that ended by a signal, or for need of memory or room on a disk, is made again.
   subroutine take_journal(work, journal, folder)
      type(sweep_work_t), intent(inout) :: work       !! the sweep
      type(journal_t), intent(in) :: journal          !! the runs
      character(*), intent(in) :: folder              !! the directory that it was in

      character(:), allocatable :: place
      integer :: k, n, slash

      do k = 1, size(journal%runs)
         associate (run => journal%runs(k))
            n = run%number
            if (n < 1 .or. n > size(work%is_done)) cycle
            if (work%is_done(n)) cycle  ! of another part, which has it too
            call work%results%take(run)
            slash = index(work%directories(n)%s, "/", back=.true.)
            place = folder//runs_folder//work%directories(n)%s(slash:)
            work%directories(n)%s = place
            work%is_done(n) = any(run%exit_code == lasting_codes)
            if (work%results%sweep%keeps_channels .and. run%exit_code == exit_ok .and. .not. journal%has_ended) then
               work%is_done(n) = path_exists(place//"/run.h5")
            end if
         end associate
      end do
   end subroutine take_journal

   !> What a sweep is of.
   function origin_of_sweep(options, loaded) result(origin)
      type(options_t), intent(in) :: options       !! the command line
      type(loaded_t), intent(in) :: loaded         !! the deck
      type(origin_of_sweep_t) :: origin            !! what its runs have in common

      type(output_plan_t) :: plan
      character(*), parameter :: nl = new_line("a")
      integer :: k

      call tell_origin(options, loaded, plan)
      associate (from => plan%origin)
         origin%program = from%program_version//nl//from%git_sha1//nl//from%compiler//nl//from%libraries//nl// &
                          program_identity()//nl
      end associate
      origin%settings = ""
      do k = 1, size(options%change%overrides)
         origin%settings = origin%settings//"set "//options%change%overrides(k)%s//nl
      end do
      if (options%change%is_ideal) origin%settings = origin%settings//"ideal"//nl
      if (options%change%tolerance > 0.0_wp) origin%settings = origin%settings//"tolerance "// &
                                                          exact_text(options%change%tolerance)//nl
      if (allocated(options%change%method)) origin%settings = origin%settings//"method "//options%change%method//nl
      origin%deck = loaded%path
      origin%files = kept_files()
   end function origin_of_sweep

   !> Set beside the deck what was set when the runs were made.
   subroutine apply_settings(settings, options)
      character(*), intent(in) :: settings         !! a line for each
      type(options_t), intent(inout) :: options    !! changed

      integer :: first, last
      logical :: is_good

      first = 1
      do while (first <= len(settings))
         last = index(settings(first:), new_line("a")) + first - 2
         associate (line => settings(first:last))
            if (starts_with(line, "set ")) then
               call append_text(options%change%overrides, line(5:))
            else if (starts_with(line, "tolerance ")) then
               call read_number(line(11:), 0, options%change%tolerance, is_good)
            else if (starts_with(line, "method ")) then
               options%change%method = line(8:)
            else
               options%change%is_ideal = .true.
            end if
         end associate
         first = last + 2
      end do
   end subroutine apply_settings

   !> Write sweep.h5 and the tables.
   subroutine write_results(work, state, message, directories, error)
      type(sweep_work_t), intent(inout) :: work            !! the sweep; the order of its names is settled
      character(*), intent(in) :: state                    !! of the sweep
      character(*), intent(in) :: message                  !! why, if not complete
      type(text_t), intent(in) :: directories(:)           !! (runs) whose channels are copied, or none
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      call work%results%settle()
      call write_sweep(work%plan, work%results, state, message, directories, error)
      if (.not. allocated(error)) call replace_file(work%plan%directory//"/sweep.csv", csv_text(table_of_runs(work%results)), error)
      if (allocated(error)) return
      call replace_file(work%plan%directory//"/cases.csv", csv_text(table_of_cases(work%results)), error)
   end subroutine write_results

   !> How many runs failed, or are missing; blank if none.
   function failure_text(work) result(message)
      type(sweep_work_t), intent(in) :: work       !! the sweep
      character(:), allocatable :: message         !! one line

      message = ""
      if (work%n_failed() > 0) message = to_text(work%n_failed())//" of "//to_text(work%n_mine())//" runs failed"
      if (work%n_missing() == 0) return
      if (len(message) > 0) message = message//", "
      message = message//to_text(work%n_missing())//" of "//to_text(work%n_mine())//" runs are missing"
   end function failure_text

end module sweep_work
