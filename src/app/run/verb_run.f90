!> `gudgeon run DECK`: which analysis, and the proof that a restart makes no difference.
module verb_run
   use accurate_run, only: check_accuracy
   use deck_run, only: run_analysis
   use errors, only: error_t, exit_stopped, exit_usage, set_error
   use exponent, only: horizon_t
   use kinds, only: wp
   use load, only: find_catalogue, load_deck, loaded_t
   use member_result, only: member_result_t
   use options, only: options_t
   use output_size, only: check_size
   use output_tree, only: remove_run
   use processes, only: asked_by, take_memory
   use restart_run, only: check_restart, compare_restarted
   use run_place, only: directory_of
   use scene, only: analysis_dynamic, analysis_names
   implicit none (type, external)
   private
   public :: run_deck, run_loaded

contains

   !> Run the analysis of a deck.
   subroutine run_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! whatever went wrong

      type(loaded_t), save :: loaded  ! until the program ends: to take it apart before takes time

      call take_memory()
      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call run_loaded(options, loaded, error)
   end subroutine run_deck

   !> Run the analysis of a deck that is loaded.
   subroutine run_loaded(options, loaded, error, member)
      type(options_t), intent(in) :: options                       !! the command line
      type(loaded_t), intent(inout) :: loaded                      !! the deck
      type(error_t), allocatable, intent(out) :: error             !! whatever went wrong
      type(member_result_t), intent(inout), optional :: member     !! what a sweep needs to know of the run

      type(horizon_t) :: horizon

      call find_catalogue(loaded)
      call check_accuracy(options, loaded, error)
      if (.not. allocated(error)) call check_restart(options, loaded, error)
      if (.not. allocated(error) .and. options%write /= "nothing") then
         call check_size(options, loaded, directory_of(options, loaded), error)
      end if
      if (.not. allocated(error) .and. options%digits%with_horizon .and. loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --horizon needs [analysis.dynamic]; the analysis of this deck is "// &
                        trim(analysis_names(loaded%scene%analysis)))
      end if
      if (allocated(error)) return
      call run_analysis(options, loaded, huge(1.0_wp), horizon, error, member)
      if (options%restart%is_verified .and. .not. allocated(error)) call verify_restart(options, loaded%plan%end, horizon, error)
   end subroutine run_loaded

   !> The run once more, stopped and resumed several times: it must be the same. Its horizon is that of the first one, as where the
   !> search ends is a matter of the clock.
   subroutine verify_restart(options, end, horizon, error)
      type(options_t), intent(in) :: options               !! the command line
      real(wp), intent(in) :: end                          !! of the motion [s]
      type(horizon_t), intent(inout) :: horizon            !! of the run
      type(error_t), allocatable, intent(out) :: error     !! it is another one

      integer, parameter :: n_restart = 3
      type(loaded_t), save :: loaded
      type(options_t) :: other
      character(:), allocatable :: directory
      integer :: k, done

      other = options
      other%restart%is_verified = .false.
      other%is_quiet = .true.
      other%is_json = .false.
      done = 0
      do k = 1, n_restart + 1
         call load_deck(other, loaded, error)
         if (allocated(error)) return
         if (k == 1) directory = directory_of(options, loaded)
         other%directory = directory//".restart"
         call run_analysis(other, loaded, merge(end*k/(n_restart + 1), huge(1.0_wp), k <= n_restart), horizon, error)
         if (.not. allocated(error)) exit
         if (error%code /= exit_stopped .or. asked_by() /= 0) return
         deallocate (error)
         done = done + 1
         other%restart%is_resumed = .true.
      end do
      call compare_restarted(directory, other%directory, done, options%is_quiet .or. options%is_json, error)
      if (.not. allocated(error)) call remove_run(other%directory, k)
   end subroutine verify_restart

end module verb_run
