!> The run of a deck: started or continued with, integrated or solved, concluded, where figures want it with its reference run with
!> ideal joints.
module deck_run
   use accurate_run, only: budget_of, choose_tolerance, tell_accuracy
   use archive, only: archive_t
   use build_clearances, only: has_ideal
   use build_system, only: levels_ideal, new_system
   use checkpoint_file, only: read_checkpoint
   use errors, only: error_t, exit_file, exit_stopped, exit_usage, set_error
   use exponent, only: horizon_t
   use exponent_runs, only: find_horizon, plan_horizon
   use figure_words, only: append_figure, figure_film, figure_t
   use horizon_memory, only: load_horizon
   use jobs, only: copy_job, job_t, outcome_t, run_job, run_started, start_job, started_t
   use kinds, only: wp
   use load, only: loaded_t
   use member_result, only: member_result_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: lifetime_t, output_plan_t, show_nothing
   use posix, only: write_error
   use processes, only: asked_by, end_by, listen
   use recorder, only: status_stopped, summary_t
   use restart_run, only: check_schedule
   use run_audit, only: limits_t
   use run_limits, only: limits_of
   use run_place, only: open_place
   use run_plan, only: make_plan
   use run_recorder, only: run_recorder_t
   use saved_run, only: saved_run_t
   use scene, only: analysis_dynamic, analysis_names, analysis_static
   use scene_echo, only: echo_scene
   use start_state, only: ideal_start_t
   use text, only: append_text, to_text
   implicit none (type, external)
   private
   public :: run_analysis

contains

   !> Run the analysis of a deck.
   subroutine run_analysis(options, loaded, stop_at, horizon, error, member)
      type(options_t), intent(in) :: options                       !! the command line
      type(loaded_t), intent(inout) :: loaded                      !! the deck
      real(wp), intent(in) :: stop_at                              !! time of the motion after which it is saved and ends [s]
      type(horizon_t), intent(inout) :: horizon                    !! what is known of it; what is asked for and not known is found
      type(error_t), allocatable, intent(out) :: error             !! whatever went wrong
      type(member_result_t), intent(inout), optional :: member     !! what a sweep needs to know of the run

      type(ideal_start_t) :: ideal
      type(output_directory_t) :: directory
      type(run_recorder_t) :: keeper
      type(saved_run_t), allocatable :: saved
      type(started_t) :: start
      type(summary_t) :: summary
      logical :: goes_on, is_complete, is_motion

      is_motion = loaded%scene%analysis == analysis_dynamic
      call check_member(options, loaded, error)
      loaded%perturbed%start = options%change%member
      if (.not. allocated(error)) call start_job(loaded%job_t, loaded%system, start, error, ideal)
      if (allocated(error)) return
      call open_place(options, loaded, directory, goes_on, is_complete, error)
      if (allocated(error) .or. is_complete) return
      associate (plan => keeper%plan)
         call make_plan(options, loaded, directory, start%assembly, plan, keeper%figures)
         call limits_of(loaded%scene, loaded%catalogue, loaded%limits, plan%warnings)
         plan%life%is_saved = loaded%scene%analysis /= analysis_static .and. options%write /= "nothing"
         plan%life%is_concluded_later = is_motion
         plan%life%goes_on = goes_on
         plan%life%stop_at = stop_at
         if (options%digits%accuracy > 0.0_wp) call take_accuracy(options, loaded, plan, start, ideal, error)
         if (is_motion .and. .not. allocated(error)) then
            call check_schedule(options, loaded, start%method, size(start%subsystems), error)
         end if
         if (goes_on .and. .not. allocated(error)) call take_up(plan, saved, horizon, error)
         if (allocated(error)) then
            call directory%close()
            return
         end if
         if (options%digits%with_horizon .and. .not. allocated(horizon%t)) call look_ahead(options, loaded, horizon)
         plan%horizon = horizon
         if (loaded%scene%analysis == analysis_static) call keep_films(plan, keeper%figures)
      end associate
      call listen(loaded%scene%analysis /= analysis_static)
      call run_started(loaded%job_t, loaded%system, start, keeper, summary, error, saved, loaded%catalogue)
      call listen(.false.)
      if (is_motion) call conclude(loaded, ideal, keeper, summary, error)
      call directory%close()
      call tell_accuracy(keeper%plan%accuracy, error)
      if (present(member) .and. is_motion) call keeper%result(member)
      call end_as_asked(summary, error)
   end subroutine run_analysis

   !> Choose the tolerance for the accuracy asked for, and start anew with it.
   subroutine take_accuracy(options, loaded, plan, start, ideal, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck; its tolerance is set, its system made anew
      type(output_plan_t), intent(inout) :: plan           !! of the output; accuracy and echo are set
      type(started_t), intent(out) :: start                !! the start
      type(ideal_start_t), intent(out) :: ideal            !! that with ideal joints, if it was needed
      type(error_t), allocatable, intent(out) :: error     !! no run came to its end

      call choose_tolerance(options, loaded, plan, error)
      if (allocated(error)) return
      plan%origin%deck_echo = echo_scene(loaded%deck, loaded%scene)
      call new_system(loaded%scene, loaded%levels, loaded%system)
      call start_job(loaded%job_t, loaded%system, start, error, ideal)
   end subroutine take_accuracy

   !> What an earlier run has saved, and what it knew of its horizon.
   subroutine take_up(plan, saved, horizon, error)
      type(output_plan_t), intent(inout) :: plan                   !! of the run; learns where it continues
      type(saved_run_t), allocatable, intent(out) :: saved         !! what was saved
      type(horizon_t), intent(out) :: horizon                      !! what was known of it; no instants: nothing
      type(error_t), allocatable, intent(out) :: error             !! it cannot be read, or is of another run

      type(archive_t) :: archive

      allocate (saved)
      call read_checkpoint(plan, saved, error)
      if (allocated(error)) return
      plan%life%resumed_from = saved%t
      archive = saved%output  ! which the recorder reads from its start
      call load_horizon(archive, horizon)
   end subroutine take_up

   !> A run of an ensemble needs one, and a motion whose start can be perturbed.
   subroutine check_member(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! the deck has no ensemble, or not so many runs

      integer :: n

      if (options%change%member == 0) return
      if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --member needs a dynamic analysis, not a "// &
                        trim(analysis_names(loaded%scene%analysis))//" analysis")
         return
      end if
      if (.not. loaded%scene%settings%ensemble%is_present) then
         call set_error(error, exit_usage, "option --member needs a deck with a section [ensemble]")
         return
      end if
      n = nint(loaded%scene%settings%ensemble%number("runs"))
      if (options%change%member > n) then
         call set_error(error, exit_usage, "the ensemble has "//to_text(n)//" runs, but not run "// &
            to_text(options%change%member))
      end if
   end subroutine check_member

   !> How fast neighbouring motions part, by the tangent, and how long digits of this run mean anything. It may take the budget
   !> of [precision], or that of the command line, and no more than the deck allows any motion.
   subroutine look_ahead(options, loaded, horizon)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(horizon_t), intent(out) :: horizon              !! what is found

      type(job_t) :: job

      call copy_job(loaded%job_t, job)
      job%limits%clock = budget_of(options, loaded)
      call plan_horizon(loaded%scene%settings%precision%item_t, loaded%plan%end, horizon)
      associate (controls => loaded%scene%settings%integration%controls)
         if (controls%fixed_step <= 0.0_wp) horizon%asked = controls%tolerance
      end associate
      call find_horizon(job, horizon)
   end subroutine look_ahead

   !> After the motion: that of the reference run with ideal joints for the figures, the figures, the summary.
   subroutine conclude(loaded, ideal, keeper, summary, error)
      type(loaded_t), intent(inout) :: loaded                   !! the deck; its job becomes that of the reference run
      type(ideal_start_t), intent(inout) :: ideal               !! the start with ideal joints, if it was needed
      type(run_recorder_t), intent(inout) :: keeper             !! kept the motion
      type(summary_t), intent(in) :: summary                    !! its cost and errors
      type(error_t), allocatable, intent(inout) :: error        !! why it ended early; or a file could not be written

      type(error_t), allocatable :: late_error
      character(:), allocatable :: warning
      logical :: has_reference

      warning = ""
      has_reference = size(keeper%figures) > 0 .and. keeper%plan%with%figures .and. summary%status /= status_stopped .and. &
                      loaded%system%clearance_joints%n > 0 .and. has_ideal(loaded%scene, levels_ideal)
      if (has_reference .and. allocated(error)) has_reference = error%code /= exit_file
      if (has_reference) then
         call run_reference(loaded%job_t, keeper, ideal, warning)
         if (warning /= "") warning = "figures have no overlay of ideal joints: "//warning
      end if
      call keeper%conclude(late_error, warning)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
   end subroutine conclude

   !> The reference run: all joints ideal, text files only, for the figures.
   subroutine run_reference(job, proper, ideal, reason)
      type(job_t), intent(inout) :: job                          !! the run proper; becomes the reference run
      type(run_recorder_t), intent(inout) :: proper              !! recorder of the run proper; gets the curves of this one
      type(ideal_start_t), intent(inout) :: ideal                !! the start with ideal joints, if the run proper has found it
      character(:), allocatable, intent(out) :: reason           !! why there is no reference run; blank: there is

      type(limits_t) :: none
      type(outcome_t) :: outcome
      type(run_recorder_t) :: keeper

      keeper%plan = proper%plan
      keeper%figures = proper%figures
      keeper%rows%labels = proper%rows%labels
      keeper%plan%suffix = ".ideal"
      keeper%plan%life = lifetime_t()
      keeper%plan%with%hdf5 = .false.
      keeper%plan%with%summary = .false.
      keeper%plan%with%motion = .false.
      keeper%plan%with%figures = .false.
      keeper%plan%with%report = .false.
      keeper%plan%with%progress = .false.
      keeper%plan%show = show_nothing
      job%levels = levels_ideal
      none%cpu = job%limits%cpu
      job%limits = none
      job%perturbed%start = 0
      call run_job(job, keeper, outcome, ideal)
      reason = outcome%reason
      if (reason == "") proper%ideal_rows = keeper%rows
   end subroutine run_reference

   !> Of an equilibrium there are figures of films only; a warning for the others.
   subroutine keep_films(plan, figures)
      type(output_plan_t), intent(inout) :: plan                 !! plan of the run
      type(figure_t), allocatable, intent(inout) :: figures(:)   !! (n) its figures

      type(figure_t), allocatable :: films(:)
      integer :: k

      allocate (films(0))
      do k = 1, size(figures)
         if (figures(k)%kind == figure_film) call append_figure(films, figures(k))
      end do
      if (size(films) < size(figures)) then
         call append_text(plan%warnings, "figures omitted: an equilibrium has no time history")
      end if
      plan%with%figures = plan%with%figures .and. size(films) > 0
      call move_alloc(films, figures)
   end subroutine keep_films

   !> A run that a signal has ended without being saved: whoever waits for it learns which.
   subroutine end_as_asked(summary, error)
      type(summary_t), intent(in) :: summary                    !! how the run ended
      type(error_t), allocatable, intent(in) :: error           !! why

      if (.not. allocated(error) .or. asked_by() == 0) return
      if (summary%status /= status_stopped .or. error%code == exit_stopped) return
      call write_error(error%message//new_line("a"))
      call end_by(asked_by())
   end subroutine end_as_asked

end module deck_run
