!> `gudgeon sweep DECK`: every case of [sweep] and every run of [ensemble], each in a process of its own.
!>
!> A run is `gudgeon run DECK --set ... --member K`, so that it gives the very numbers of that command, however many run side
!> by side. Runs are numbered case by case and collected by their number. A run that fails is recorded with its exit code and
!> its message, its directory is kept, and the others go on. What is done is in sweep.h5 and sweep.csv, which are written
!> anew now and then; directories of runs that are not in there yet are left where the sweep is killed.
module verb_sweep
   use errors, only: error_t, exit_usage, set_error
   use load, only: check_swept_words, load_deck, loaded_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_tree, only: remove_run
   use posix, only: path_exists, remove_within
   use recorder, only: status_complete, status_failed
   use scene, only: analysis_dynamic
   use sweep_report, only: make_sweep_figures, report_sweep
   use sweep_runs, only: run_all
   use sweep_work, only: failure_text, new_sweep_work, runs_folder, sweep_work_t, write_results
   use text, only: append_text, text_t
   use verb_run, only: directory_of
   implicit none (type, external)
   private
   public :: sweep_deck

contains

   !> Run the sweep.
   subroutine sweep_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! mistakes, no directory, or part of the runs failed

      type(loaded_t) :: loaded
      type(output_directory_t) :: directory
      type(text_t), allocatable :: pictures(:), warnings(:)
      type(sweep_work_t) :: work

      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call check_request(options, loaded, error)
      if (.not. allocated(error)) call check_swept_words(options, loaded, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      warnings = directory%warnings
      call new_sweep_work(options, loaded, directory%path, work, error)
      if (.not. allocated(error)) call run_all(options, loaded, work, error)
      if (.not. allocated(error)) call finish(loaded, work, pictures, warnings, error)
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
                        "  = 'gudgeon help sweep' tells how to write one; 'gudgeon run' runs the deck as it is")
      else if (loaded%is_stream) then
         call set_error(error, exit_usage, "a sweep reads its deck once for every run, so it cannot come through a pipe; "// &
                        "save it to a file")
      else if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "a sweep runs the section [analysis.dynamic], which the deck does not begin with")
      end if
      if (allocated(error)) return
      do k = 1, size(loaded%sweep%parameters)
         do i = 1, size(options%change%overrides)
            associate (word => options%change%overrides(i)%s)
               if (trim(adjustl(word(1:max(index(word, "=") - 1, 0)))) /= loaded%sweep%parameters(k)%name) cycle
               call set_error(error, exit_usage, "parameter '"//loaded%sweep%parameters(k)%name// &
                              "' is swept by the deck, so it cannot be set")
               return
            end associate
         end do
      end do
   end subroutine check_request

   !> The last time that the results are written, the figures, and what is no longer needed is removed.
   subroutine finish(loaded, work, pictures, warnings, error)
      type(loaded_t), intent(in) :: loaded                       !! the deck
      type(sweep_work_t), intent(in) :: work                           !! the sweep
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

end module verb_sweep
