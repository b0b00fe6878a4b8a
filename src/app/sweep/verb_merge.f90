!> `gudgeon merge DIR`: the parts of a sweep, `DIR.shards/I-of-N`, put together in DIR as if one sweep had made all runs.
!>
!> What is needed is in the journals of the parts, also the deck and every file that it names, as they were when the parts started.
!> Parts of different models, options or programs are refused. It may be called while parts are being made; what is not there yet
!> is missing.
module verb_merge
   use errors, only: error_t, exit_file, exit_usage, set_error
   use file_store, only: put_files
   use load, only: load_deck, loaded_t
   use members, only: program_identity
   use options, only: options_t
   use output_directory, only: output_directory_t
   use posix, only: list_directory, remove_within
   use recorder, only: status_complete, status_failed, status_stopped
   use sweep_journal, only: differences, journal_t
   use sweep_report, only: make_sweep_figures, report_sweep
   use sweep_work, only: apply_settings, failure_text, new_sweep_work, runs_folder, sweep_work_t, take_journal, write_results
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: merge_sweep

   !> A part that was found.
   type :: part_t
      character(:), allocatable :: folder   !! its directory
      type(journal_t) :: journal            !! what it has
   end type part_t

contains

   !> Put the parts of a sweep together.
   subroutine merge_sweep(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! no parts, or of different models; no directory; failed or missing runs

      type(loaded_t), save :: loaded
      type(options_t) :: then
      type(output_directory_t) :: directory
      type(part_t), allocatable :: parts(:)
      type(sweep_work_t) :: work
      type(text_t), allocatable :: pictures(:), warnings(:)

      call find_parts(options, parts, error)
      if (allocated(error)) return
      then = options
      then%operands(1)%s = parts(1)%journal%origin%deck
      call apply_settings(parts(1)%journal%origin%settings, then)
      call put_files(parts(1)%journal%origin%files)
      call load_deck(then, loaded, error)
      if (allocated(error)) return
      if (allocated(options%directory)) then
         call directory%open(options%directory, error)
      else
         call directory%open(stem_of(options%operands(1)%s), error)
      end if
      if (allocated(error)) return
      warnings = directory%warnings
      if (index(parts(1)%journal%origin%program, new_line("a")//program_identity()//new_line("a")) == 0) then
         call append_text(warnings, "these runs were made by another build of gudgeon than this one")
      end if
      call new_sweep_work(then, loaded, directory%path, work, error)
      if (.not. allocated(error)) call put_together(loaded, parts, work, pictures, warnings, error)
      if (.not. allocated(error)) call report_sweep(options, loaded, work, pictures, warnings, error)
      call directory%close()
   end subroutine merge_sweep

   !> The path without slashes at its end.
   pure function stem_of(path) result(stem)
      character(*), intent(in) :: path         !! as on the command line
      character(:), allocatable :: stem        !! the directory's name

      stem = path(:max(1, verify(path, "/", back=.true.)))
   end function stem_of

   !> The parts, which must be of the same.
   subroutine find_parts(options, parts, error)
      type(options_t), intent(in) :: options                     !! the command line
      type(part_t), allocatable, intent(out) :: parts(:)         !! (n) the parts
      type(error_t), allocatable, intent(out) :: error           !! there are none, or they differ

      type(part_t) :: part
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: folder, words
      integer :: code, k

      allocate (parts(0))
      if (size(options%operands) /= 1) then
         call set_error(error, exit_usage, "'gudgeon merge' needs the directory of one sweep: gudgeon merge DIR, for the "// &
                        "shards in DIR.shards")
         return
      end if
      folder = stem_of(options%operands(1)%s)//".shards"
      call list_directory(folder, names, code)
      do k = 1, merge(size(names), 0, code == 0)
         if (index(names(k)%s, "/") /= len(names(k)%s)) cycle
         part%folder = folder//"/"//names(k)%s(:len(names(k)%s) - 1)
         if (scan(part%folder(index(part%folder, "/", back=.true.):), ".") > 0) cycle  ! an older one that was kept
         call part%journal%read(part%folder)
         if (part%journal%is_there) parts = [parts, part]
      end do
      if (size(parts) == 0) then
         call set_error(error, exit_file, "there are no shards of a sweep in "//folder// &
                        "; 'gudgeon sweep DECK --shard I/N' makes them")
         return
      end if
      do k = 2, size(parts)
         words = differences(parts(1)%journal%origin, parts(k)%journal%origin)
         if (len(words) == 0) cycle
         call set_error(error, exit_usage, parts(1)%folder//" and "//parts(k)%folder// &
                        " are not shards of one sweep; they differ in: "//words//new_line("a")// &
                        "  = repeat the older shard, or remove it")
         return
      end do
   end subroutine find_parts

   !> All files of the whole.
   subroutine put_together(loaded, parts, work, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(part_t), intent(in) :: parts(:)                       !! (n) the parts
      type(sweep_work_t), intent(inout) :: work                  !! the whole
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made, paths within the directory
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: directories(:)
      character(:), allocatable :: state
      integer :: ignored, k, n

      allocate (pictures(0), directories(0))
      work%journal%origin = parts(1)%journal%origin
      call tell_program(work%journal%origin%program, work)
      allocate (work%journal%runs(sum([(size(parts(k)%journal%runs), k=1, size(parts))])))
      n = 0
      do k = 1, size(parts)
         call take_journal(work, parts(k)%journal, parts(k)%folder)
         work%journal%runs(n + 1:n + size(parts(k)%journal%runs)) = parts(k)%journal%runs
         n = n + size(parts(k)%journal%runs)
      end do
      if (loaded%sweep%keeps_channels) directories = work%directories
      state = status_complete
      if (work%n_failed() > 0) state = status_failed
      if (work%n_missing() > 0) state = status_stopped
      call work%journal%begin(work%plan%directory, error)
      if (.not. allocated(error)) call write_results(work, state, failure_text(work), directories, error)
      if (.not. allocated(error)) call work%journal%end(error)
      if (allocated(error)) return
      ignored = remove_within(work%plan%directory, runs_folder(2:)//"/")
      call make_sweep_figures(loaded, work, pictures, warnings, error)
   end subroutine put_together

   !> The results are of the program that made the runs.
   subroutine tell_program(program, work)
      character(*), intent(in) :: program           !! a line for each thing that it said of itself
      type(sweep_work_t), intent(inout) :: work     !! the whole

      integer :: at

      at = 1
      work%plan%origin%program_version = next_line()
      work%plan%origin%git_sha1 = next_line()
      work%plan%origin%compiler = next_line()
      work%plan%origin%libraries = next_line()

   contains

      !> The next line.
      function next_line() result(line)
         character(:), allocatable :: line   !! without its end

         integer :: length

         length = index(program(at:), new_line("a")) - 1
         line = program(at:at + length - 1)
         at = at + length + 1
      end function next_line

   end subroutine tell_program

end module verb_merge
