!> A sweep that is under way: its runs, where they are, what came of them, and the files that say so.
module sweep_work
   use build_info, only: compiler, git_sha1
   use deck_texts, only: deck_text, get_includes
   use errors, only: error_t
   use libraries, only: library_versions
   use load, only: loaded_t
   use options, only: options_t
   use output_marker, only: enter_file
   use output_plan, only: output_plan_t
   use posix, only: make_directory, own_path
   use scene_echo, only: echo_scene
   use sweep_file, only: write_sweep
   use sweep_results, only: cases_csv, runs_csv, sweep_results_t
   use text, only: text_t, to_text
   use text_file, only: fail_file, replace_file, write_file
   use version, only: program_version
   implicit none (type, external)
   private
   public :: failure_text, new_sweep_work, runs_folder, sweep_work_t, write_results

   character(*), parameter :: runs_folder = "/runs"  !! where the runs are while they last

   !> A sweep that is under way.
   type :: sweep_work_t
      type(output_plan_t) :: plan                 !! what the files say
      type(sweep_results_t) :: results            !! what came of the runs
      type(text_t), allocatable :: directories(:) !! (runs) of the runs
      integer, allocatable :: processes(:)        !! (runs) numbers of their processes; 0: not running
      integer :: n_failed = 0                     !! runs that failed
      character(:), allocatable :: program        !! this program
   end type sweep_work_t

contains

   !> Everything before the first run.
   subroutine new_sweep_work(options, loaded, path, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      character(*), intent(in) :: path                     !! directory of the sweep
      type(sweep_work_t), intent(out) :: work                    !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! a directory cannot be made

      character(:), allocatable :: digits
      integer :: code, k

      work%plan%directory = path
      work%plan%origin%deck_name = loaded%path
      work%plan%origin%deck_text = deck_text(loaded%deck)
      work%plan%title = loaded%scene%title
      work%plan%origin%program_version = program_version
      work%plan%origin%git_sha1 = git_sha1
      work%plan%origin%compiler = compiler
      work%plan%origin%libraries = library_versions()
      work%plan%origin%command = options%command
      call get_includes(loaded%deck, work%plan%origin%include_names, work%plan%origin%include_texts)
      call work%plan%complete()
      work%results%sweep = loaded%sweep
      work%results%is_ensemble = loaded%scene%settings%ensemble%is_present
      if (loaded%scene%settings%ensemble%is_present) then
         work%results%n_member = nint(loaded%scene%settings%ensemble%number("runs"))
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
   end subroutine new_sweep_work

   !> The name under which this program was started.
   function own_name() result(name)
      character(:), allocatable :: name   !! a path, or a name along PATH

      integer :: length

      call get_command_argument(0, length=length)
      allocate (character(length) :: name)
      call get_command_argument(0, name)
   end function own_name

   !> Write sweep.h5 and the tables.
   subroutine write_results(work, state, message, directories, error)
      type(sweep_work_t), intent(in) :: work                     !! the sweep
      character(*), intent(in) :: state                    !! of the sweep
      character(*), intent(in) :: message                  !! why, if not complete
      type(text_t), intent(in) :: directories(:)           !! (runs) whose channels are copied, or none
      type(error_t), allocatable, intent(out) :: error     !! a file cannot be written

      call write_sweep(work%plan, work%results, state, message, directories, error)
      if (.not. allocated(error)) call replace_file(work%plan%directory//"/sweep.csv", runs_csv(work%results), error)
      if (.not. allocated(error)) call replace_file(work%plan%directory//"/cases.csv", cases_csv(work%results), error)
   end subroutine write_results

   !> How many runs failed; blank if none.
   function failure_text(work) result(message)
      type(sweep_work_t), intent(in) :: work             !! the sweep
      character(:), allocatable :: message         !! one line

      message = ""
      if (work%n_failed > 0) message = to_text(work%n_failed)//" of "//to_text(size(work%results%runs))//" runs failed"
   end function failure_text

end module sweep_work
