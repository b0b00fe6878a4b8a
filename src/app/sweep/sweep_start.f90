!> How many runs of a deck start: from what an earlier sweep of the same has done, and what is noted of files that change meanwhile.
module sweep_start
   use errors, only: error_t
   use file_store, only: changed_files
   use load, only: loaded_t
   use members, only: stamp_of
   use options, only: options_t
   use sweep_journal, only: differences, journal_t, origin_of_sweep_t
   use sweep_work, only: new_sweep_work, sweep_work_t, take_journal
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: begin_sweep, is_of, tell_changes

contains

   !> Whether a directory holds an earlier sweep of the same.
   logical function is_of(path, origin)
      character(*), intent(in) :: path                     !! the directory
      type(origin_of_sweep_t), intent(in) :: origin        !! what the sweep is of

      type(journal_t) :: journal

      call journal%read(path)
      is_of = journal%is_there
      if (is_of) is_of = differences(journal%origin, origin) == ""
   end function is_of

   !> What an earlier sweep of the same has done, and the journal for what comes.
   subroutine begin_sweep(options, loaded, path, origin, work, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      character(*), intent(in) :: path                     !! directory of the sweep
      type(origin_of_sweep_t), intent(in) :: origin        !! what it is of
      type(sweep_work_t), intent(inout) :: work            !! the sweep
      type(error_t), allocatable, intent(out) :: error     !! a file or directory cannot be made

      call work%journal%read(path)  ! once more: the directory is ours only now
      work%journal%origin = origin
      call new_sweep_work(options, loaded, path, work, error)
      if (allocated(error)) return
      call take_journal(work, work%journal, path)
      call work%journal%begin(path, error)
   end subroutine begin_sweep

   !> Files that are not what they were when the sweep started; its runs are of what was read then.
   subroutine tell_changes(program, stamp, warnings)
      character(*), intent(in) :: program                        !! path of this program
      character(*), intent(in) :: stamp                          !! by which it was known at the start
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) grown

      type(text_t), allocatable :: changed(:)
      integer :: k

      changed = changed_files()
      do k = 1, size(changed)
         call append_text(warnings, changed(k)%s// &
                          " changed during the sweep; all runs use its initial content")
      end do
      if (stamp_of(program) /= stamp) then
         call append_text(warnings, "the program "//program// &
                          " was rebuilt during the sweep; all runs use the initial executable")
      end if
   end subroutine tell_changes

end module sweep_start
