!> `gudgeon sweep DECK`: every case of [sweep] and every run of [ensemble], each in a process of its own.
!>
!> The deck and every file that it names are read once, so that all runs are of the same model whatever becomes of the files. Runs
!> are numbered case by case and collected by their number. What is done is in the journal as soon as it is (`sweep_journal`): a
!> sweep of the same model into the same directory continues from there. With `--shard I/N` only every N-th run is made, into a
!> directory of its own, and `gudgeon merge` puts the parts together (`verb_merge`).
module verb_sweep
   use errors, only: error_t, exit_usage, set_error
   use file_store, only: keep_files
   use load, only: check_swept_words, load_deck, loaded_t
   use members, only: stamp_of
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_tree, only: remove_run
   use posix, only: own_path, path_exists, remove_within
   use recorder, only: status_complete, status_failed
   use run_place, only: directory_of
   use scene, only: analysis_dynamic
   use sweep_journal, only: origin_of_sweep_t
   use sweep_report, only: make_sweep_figures, report_sweep
   use sweep_runs, only: run_all
   use sweep_start, only: begin_sweep, is_of, tell_changes
   use sweep_work, only: failure_text, origin_of_sweep, runs_folder, sweep_work_t, write_results
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: sweep_deck

contains

   !> Run the sweep.
   subroutine sweep_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! errors, no directory, or part of the runs failed

      type(loaded_t), save :: loaded
      type(origin_of_sweep_t) :: origin
      type(output_directory_t) :: directory
      type(text_t), allocatable :: pictures(:), warnings(:)
      type(sweep_work_t) :: work
      character(:), allocatable :: path, program, stamp

      program = own_path()
      stamp = stamp_of(program)
      call keep_files()
      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_request(options, loaded, error)
      if (.not. allocated(error)) call check_swept_words(options, loaded, error)
      if (allocated(error)) return
      path = directory_of(options, loaded)
      if (options%runs%shard > 0) path = path//".shards/"//to_text(options%runs%shard)//"-of-"//to_text(options%runs%n_shards)
      origin = origin_of_sweep(options, loaded)
      call directory%open(path, error, goes_on=is_of(path, origin))
      if (allocated(error)) return
      warnings = directory%warnings
      call begin_sweep(options, loaded, directory%path, origin, work, error)
      if (.not. allocated(error)) call run_all(options, loaded, directory, work, error)
      if (.not. allocated(error)) then
         call tell_changes(program, stamp, warnings)
         call finish(loaded, work, pictures, warnings, error)
      end if
      if (.not. allocated(error)) call report_sweep(options, loaded, work, pictures, warnings, error)
      call directory%close()
   end subroutine sweep_deck

   !> A sweep needs something to sweep, and its parameters must be free.
   subroutine check_request(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! what is missing, or set twice

      integer :: i, k

      if (.not. loaded%sweep%is_present .and. .not. loaded%scene%settings%ensemble%is_present) then
         call set_error(error, exit_usage, "the deck has neither a section [sweep] nor [ensemble]"//new_line("a")// &
                        "  = see 'gudgeon help sweep'; 'gudgeon run' runs the deck as it is")
      else if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "a sweep needs [analysis.dynamic] as the first analysis section of the deck")
      end if
      if (allocated(error)) return
      do k = 1, size(loaded%sweep%parameters)
         do i = 1, size(options%change%overrides)
            associate (word => options%change%overrides(i)%s)
               if (trim(adjustl(word(1:max(index(word, "=") - 1, 0)))) /= loaded%sweep%parameters(k)%name) cycle
               call set_error(error, exit_usage, "parameter '"//loaded%sweep%parameters(k)%name// &
                              "' is swept by the deck and cannot be set")
               return
            end associate
         end do
      end do
   end subroutine check_request

   !> The last time that the results are written, the figures, and what is no longer needed is removed.
   subroutine finish(loaded, work, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(sweep_work_t), intent(inout) :: work                  !! the sweep
      type(text_t), allocatable, intent(out) :: pictures(:)      !! (n) pictures made, paths within the directory
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (m) what was noticed before, and what was not made
      type(error_t), allocatable, intent(out) :: error           !! a file cannot be written

      type(text_t), allocatable :: directories(:)
      integer :: ignored, k

      allocate (pictures(0), directories(0))
      if (work%shard == 0) then
         if (loaded%sweep%keeps_channels) directories = work%directories
         ! the channels of an earlier sweep are in its file only, where nothing was missing
         if (work%n_made > 0 .or. .not. work%journal%has_ended .or. .not. loaded%sweep%keeps_channels) then
            call write_results(work, trim(merge(status_failed//"  ", status_complete, work%n_failed() > 0)), failure_text(work), &
                               directories, error)
            if (.not. allocated(error)) call work%journal%end(error)
            if (allocated(error)) return
         end if
         do k = 1, size(directories)
            if (work%results%runs(k)%exit_code == 0 .and. path_exists(directories(k)%s)) call remove_run(directories(k)%s, ignored)
         end do
      end if
      if (work%n_failed() == 0 .and. (work%shard == 0 .or. .not. loaded%sweep%keeps_channels)) then
         ignored = remove_within(work%plan%directory, runs_folder(2:)//"/")
         if (path_exists(work%plan%directory//runs_folder)) then
            call append_text(warnings, work%plan%directory//runs_folder//" holds files not made by gudgeon and was not removed")
         end if
      end if
      if (work%shard == 0) call make_sweep_figures(loaded, work, pictures, warnings, error)
   end subroutine finish

end module verb_sweep
