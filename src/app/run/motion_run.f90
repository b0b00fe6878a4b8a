!> A motion in time under forces: started or continued with, integrated, concluded with that of its reference run with ideal joints
!> for the figures.
module motion_run
   use accurate_run, only: budget_of, choose_tolerance, tell_accuracy
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use checkpoint_file, only: read_checkpoint
   use dynamic, only: run_dynamic
   use errors, only: error_t, exit_file, exit_stopped, exit_usage, set_error
   use exponent, only: horizon_t
   use exponent_runs, only: find_horizon, plan_horizon
   use horizon_memory, only: load_horizon
   use integrator, only: integrator_t
   use kinds, only: wp
   use load, only: loaded_t
   use member_result, only: member_result_t
   use memory_purpose, only: memory_is_for
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: lifetime_t, output_plan_t
   use perturbation, only: new_shift
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
   use scene, only: analysis_dynamic, analysis_names
   use scene_echo, only: echo_scene
   use scene_method, only: new_method
   use setting_run, only: first_line, job_t
   use start_state, only: find_start, ideal_start_t
   use subsystems, only: new_subsystems, subsystem_t
   use archive, only: archive_t
   use text, only: to_text
   use twin_run, only: run_twin
   implicit none (type, external)
   private
   public :: check_member, end_as_asked, run_motion

contains

   !> Motion in time under forces.
   subroutine run_motion(options, loaded, stop_at, horizon, error, member)
      type(options_t), intent(in) :: options                       !! the command line
      type(loaded_t), intent(inout) :: loaded                      !! the deck
      real(wp), intent(in) :: stop_at                              !! time of the motion after which it is saved and ends [s]
      type(horizon_t), intent(inout) :: horizon                    !! what is known of it; what is asked for and not known is found
      type(error_t), allocatable, intent(out) :: error             !! whatever went wrong
      type(member_result_t), intent(inout), optional :: member     !! what a sweep needs to know of the run

      class(integrator_t), allocatable :: method
      type(assembly_t) :: assembly
      type(ideal_start_t) :: ideal
      type(limits_t) :: limits
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(run_recorder_t) :: keeper
      type(saved_run_t), allocatable :: saved
      type(subsystem_t), allocatable :: subsystems(:)
      type(summary_t) :: summary
      logical :: goes_on, is_complete
      real(wp), allocatable :: y(:)

      call begin_motion(options, loaded, y, assembly, ideal, error)
      if (allocated(error)) return
      call open_place(options, loaded, directory, goes_on, is_complete, error)
      if (allocated(error) .or. is_complete) return
      call make_plan(options, loaded, directory, assembly, plan, keeper%figures)
      call set_life(options, goes_on, stop_at, plan%life)
      if (options%digits%accuracy > 0.0_wp) then
         call choose_tolerance(options, loaded, plan, error)
         if (.not. allocated(error)) then
            plan%origin%deck_echo = echo_scene(loaded%deck, loaded%scene)
            call new_system(loaded%scene, levels_as_written, loaded%system)
            call begin_motion(options, loaded, y, assembly, ideal, error)
         end if
         if (allocated(error)) call directory%close()
         if (allocated(error)) return
      end if
      call new_method(loaded%scene, method)
      call limits_of(loaded%scene, loaded%system, loaded%catalogue, limits, plan%warnings)
      call memory_is_for("the equations of "//to_text(size(loaded%scene%bodies%names))//" bodies")
      call new_subsystems(loaded%scene, levels_as_written, loaded%system, method, loaded%plan%end, subsystems)
      call check_schedule(options, loaded, method, size(subsystems), error)
      if (goes_on .and. .not. allocated(error)) call take_up(plan, saved, horizon, error)
      if (allocated(error)) then
         call directory%close()
         return
      end if
      if (options%digits%with_horizon .and. .not. allocated(horizon%t)) call look_ahead(options, loaded, horizon)
      plan%horizon = horizon
      keeper%plan = plan
      call listen(.true.)
      call run_dynamic(loaded%system, method, subsystems, y, loaded%plan, limits, keeper, summary, error, saved, &
                       loaded%catalogue)
      call listen(.false.)
      call conclude(loaded, ideal, keeper, summary, error)
      call directory%close()
      call tell_accuracy(plan%accuracy, error)
      if (present(member)) call keeper%result(member)
      call end_as_asked(summary, error)
   end subroutine run_motion

   !> When a run starts and ends, and that it is saved.
   subroutine set_life(options, goes_on, stop_at, life)
      type(options_t), intent(in) :: options        !! the command line
      logical, intent(in) :: goes_on                !! an earlier run is continued with
      real(wp), intent(in) :: stop_at               !! time of the motion after which it is saved and ends [s]
      type(lifetime_t), intent(inout) :: life       !! these are set

      life%is_saved = options%write /= "nothing"
      life%is_concluded_later = .true.
      life%goes_on = goes_on
      life%stop_at = stop_at
   end subroutine set_life

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

   !> The start of a motion, perturbed if it is one of an ensemble.
   subroutine begin_motion(options, loaded, y, assembly, ideal, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck
      real(wp), allocatable, intent(out) :: y(:)           !! (n) state at the start [any]
      type(assembly_t), intent(out) :: assembly            !! how it was found
      type(ideal_start_t), intent(out) :: ideal            !! that with ideal joints, if it was needed
      type(error_t), allocatable, intent(out) :: error     !! there is no ensemble, or no start

      call check_member(options, loaded, error)
      if (allocated(error)) return
      if (options%change%member > 0) then
         call find_start(loaded%scene, levels_as_written, loaded%system, y, assembly, error, &
                         new_shift(loaded%scene, loaded%system%linkage%coordinates, options%change%member), ideal=ideal)
      else
         call find_start(loaded%scene, levels_as_written, loaded%system, y, assembly, error, ideal=ideal)
      end if
   end subroutine begin_motion

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

      job%scene = loaded%scene
      job%settings = loaded%scene%settings%dynamic%item_t
      job%start = options%change%member
      job%cpu = job%settings%number("limit_cpu")
      job%clock = budget_of(options, loaded)
      call plan_horizon(loaded%scene%settings%precision%item_t, loaded%plan%end, horizon)
      if (job%settings%number("step") <= 0.0_wp) horizon%asked = job%settings%number("tolerance")
      call find_horizon(job, horizon)
   end subroutine look_ahead

   !> After the motion: that of the reference run with ideal joints for the figures, the figures, the summary.
   subroutine conclude(loaded, ideal, keeper, summary, error)
      type(loaded_t), intent(in) :: loaded                      !! the deck
      type(ideal_start_t), intent(inout) :: ideal               !! the start with ideal joints, if it was needed
      type(run_recorder_t), intent(inout) :: keeper             !! kept the motion
      type(summary_t), intent(in) :: summary                    !! its cost and errors
      type(error_t), allocatable, intent(inout) :: error        !! why it ended early; or a file could not be written

      type(error_t), allocatable :: late_error, twin_error
      character(:), allocatable :: warning
      logical :: has_twin

      warning = ""
      has_twin = size(keeper%figures) > 0 .and. keeper%plan%with%figures .and. loaded%system%clearance_joints%n > 0 .and. &
                 summary%status /= status_stopped
      if (has_twin .and. allocated(error)) has_twin = error%code /= exit_file
      if (has_twin) then
         call run_twin(loaded, keeper, ideal, twin_error)
         if (allocated(twin_error)) warning = "figures have no overlay of ideal joints: "//first_line(twin_error%message)
      end if
      call keeper%conclude(late_error, warning)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
   end subroutine conclude

   !> A run that a signal has ended without being saved: whoever waits for it learns which.
   subroutine end_as_asked(summary, error)
      type(summary_t), intent(in) :: summary                    !! how the run ended
      type(error_t), allocatable, intent(in) :: error           !! why

      if (.not. allocated(error) .or. asked_by() == 0) return
      if (summary%status /= status_stopped .or. error%code == exit_stopped) return
      call write_error(error%message//new_line("a"))
      call end_by(asked_by())
   end subroutine end_as_asked

end module motion_run
