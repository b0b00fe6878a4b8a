!> `gudgeon run DECK`: the analysis, the ideal twin of a motion for the figures, everything written.
module verb_run
   use accurate_run, only: check_accuracy, choose_tolerance, tell_accuracy
   use build_system, only: levels_as_written, levels_ideal, new_system
   use consistent_start, only: assembly_t
   use dynamic, only: run_dynamic
   use errors, only: error_t, exit_usage, set_error
   use exponent, only: horizon_t
   use exponent_runs, only: find_horizon, plan_horizon
   use integrator, only: integrator_t
   use integrator_controls, only: read_controls
   use integrator_registry, only: find_integrator
   use kinds, only: wp
   use kinematic, only: run_kinematic
   use kinematic_start, only: find_kinematic_start
   use load, only: load_deck, loaded_t
   use mechanism, only: mechanism_t
   use member_result, only: member_result_t
   use memory_purpose, only: memory_is_for
   use mobility, only: mobility_t
   use options, only: options_t
   use output_directory, only: output_directory_t
   use output_plan, only: output_plan_t, show_nothing
   use perturbation, only: new_shift
   use prescribed_motion, only: newton_t
   use recorder, only: summary_t
   use run_audit, only: limits_t
   use run_limits, only: limits_of, twin_limits
   use run_plan, only: make_plan
   use run_recorder, only: run_recorder_t
   use scene, only: analysis_dynamic, analysis_kinematic, analysis_names, analysis_static, scene_t
   use scene_echo, only: echo_scene
   use setting_run, only: first_line, job_t
   use start_state, only: find_start, ideal_start_t
   use static, only: equilibrium_t, find_equilibrium, record_equilibrium
   use subsystems, only: new_subsystems, subsystem_t
   use text, only: append_text, starts_with, text_t, to_text
   implicit none (type, external)
   private
   public :: directory_of, new_method, run_deck, run_loaded

contains

   !> Run the analysis of a deck.
   subroutine run_deck(options, error)
      type(options_t), intent(in) :: options               !! the command line
      type(error_t), allocatable, intent(out) :: error     !! whatever went wrong

      type(loaded_t) :: loaded

      call load_deck(options, loaded, error)
      if (.not. allocated(error)) call run_loaded(options, loaded, error)
   end subroutine run_deck

   !> Run the analysis of a deck that is loaded.
   subroutine run_loaded(options, loaded, error, member)
      type(options_t), intent(in) :: options                       !! the command line
      type(loaded_t), intent(inout) :: loaded                      !! the deck
      type(error_t), allocatable, intent(out) :: error             !! whatever went wrong
      type(member_result_t), intent(inout), optional :: member     !! what a sweep wants to know of the run

      call check_accuracy(options, loaded, error)
      if (.not. allocated(error) .and. options%with_horizon .and. loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --horizon is for motions of [analysis.dynamic]; this deck's analysis is "// &
                        trim(analysis_names(loaded%scene%analysis)))
      end if
      if (allocated(error)) return
      select case (loaded%scene%analysis)
      case (analysis_kinematic)
         call run_prescribed(options, loaded, error)
      case (analysis_static)
         call run_equilibrium(options, loaded, error)
      case default
         call run_motion(options, loaded, error, member)
      end select
   end subroutine run_loaded

   !> Motion in time under forces.
   subroutine run_motion(options, loaded, error, member)
      type(options_t), intent(in) :: options                       !! the command line
      type(loaded_t), intent(inout) :: loaded                      !! the deck
      type(error_t), allocatable, intent(out) :: error             !! whatever went wrong
      type(member_result_t), intent(inout), optional :: member     !! what a sweep wants to know of the run

      class(integrator_t), allocatable :: method
      type(assembly_t) :: assembly
      type(error_t), allocatable :: twin_error
      type(ideal_start_t) :: ideal
      type(limits_t) :: limits
      type(output_directory_t) :: directory
      type(output_plan_t) :: plan
      type(run_recorder_t) :: keeper
      type(subsystem_t), allocatable :: subsystems(:)
      type(summary_t) :: summary
      real(wp), allocatable :: y(:)

      call begin_motion(options, loaded, y, assembly, ideal, error)
      if (allocated(error)) return
      call open_place(options, loaded, directory, error)
      if (allocated(error)) return
      call make_plan(options, loaded, directory, assembly, plan)
      if (options%accuracy > 0.0_wp) then
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
      if (size(plan%figures) > 0 .and. options%write == "all" .and. loaded%system%loose%n > 0) then
         call run_twin(loaded, plan, ideal, twin_error)
         if (allocated(twin_error)) call append_text(plan%warnings, "the figures have no ideal joint overlaid: "// &
                                                     first_line(twin_error%message))
      end if
      call limits_of(loaded%scene, loaded%system, loaded%catalogue, limits, plan%warnings)
      if (options%with_horizon) call look_ahead(options, loaded, plan%horizon)
      keeper%plan = plan
      call memory_is_for("the equations of "//to_text(size(loaded%scene%bodies%names))//" bodies")
      call new_subsystems(loaded%scene, levels_as_written, loaded%system, method, loaded%plan%end, subsystems)
      call run_dynamic(loaded%system, method, subsystems, y, loaded%plan, limits, keeper, summary, error)
      call directory%close()
      call tell_accuracy(plan%accuracy, error)
      if (present(member)) call keeper%result(member)
   end subroutine run_motion

   !> The directory of a run, if it writes anything.
   subroutine open_place(options, loaded, directory, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_directory_t), intent(inout) :: directory !! opened
      type(error_t), allocatable, intent(out) :: error     !! it cannot be made, or is not free

      if (options%write /= "nothing") then
         call directory%open(directory_of(options, loaded), error)
         return
      end if
      directory%path = "."
      allocate (directory%warnings(0))
   end subroutine open_place

   !> The start of a motion, perturbed if it is one of an ensemble.
   subroutine begin_motion(options, loaded, y, assembly, ideal, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck
      real(wp), allocatable, intent(out) :: y(:)           !! (n) state at the start [any]
      type(assembly_t), intent(out) :: assembly            !! how it was found
      type(ideal_start_t), intent(out) :: ideal            !! that with ideal joints, if it was needed
      type(error_t), allocatable, intent(out) :: error     !! there is no ensemble, or no start

      if (options%change%member > 0) then
         call check_member(options, loaded, error)
         if (allocated(error)) return
         call find_start(loaded%scene, levels_as_written, loaded%system, y, assembly, error, &
                         new_shift(loaded%scene, loaded%system%linkage%coordinates, options%change%member), ideal=ideal)
      else
         call find_start(loaded%scene, levels_as_written, loaded%system, y, assembly, error, ideal=ideal)
      end if
   end subroutine begin_motion

   !> How fast neighbouring motions part, by the tangent, and how long digits of this run mean anything.
   subroutine look_ahead(options, loaded, horizon)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(horizon_t), intent(out) :: horizon              !! what is found

      type(job_t) :: job

      job%scene = loaded%scene
      job%settings = loaded%scene%settings%dynamic%item_t
      job%start = options%change%member
      job%cpu = job%settings%number("limit_cpu")
      call plan_horizon(loaded%scene%settings%precision%item_t, loaded%plan%end, horizon)
      if (job%settings%number("step") <= 0.0_wp) horizon%asked = job%settings%number("tolerance")
      call find_horizon(job, horizon)
   end subroutine look_ahead

   !> A run of an ensemble needs one.
   subroutine check_member(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! the deck has no ensemble, or not so many runs

      integer :: n

      if (.not. loaded%scene%settings%ensemble%is_present) then
         call set_error(error, exit_usage, "option --member is for a deck with a section [ensemble]")
         return
      end if
      n = nint(loaded%scene%settings%ensemble%number("runs"))
      if (options%change%member > n) then
         call set_error(error, exit_usage, "the ensemble has "//to_text(n)//" runs, not "//to_text(options%change%member))
      end if
   end subroutine check_member

   !> Motion prescribed by drivers.
   subroutine run_prescribed(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck
      type(error_t), allocatable, intent(out) :: error     !! whatever went wrong

      type(assembly_t) :: assembly
      type(mobility_t) :: mobility
      type(newton_t) :: newton
      type(output_directory_t) :: directory
      type(run_recorder_t) :: keeper
      type(summary_t) :: summary
      real(wp), allocatable :: q(:)
      real(wp) :: limit_cpu

      associate (settings => loaded%scene%settings%kinematic)
         newton%tolerance = settings%number("tolerance")
         newton%most = nint(settings%number("maximum_iterations"))
      end associate
      call find_kinematic_start(loaded%scene, loaded%system, q, assembly, mobility, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      call make_plan(options, loaded, directory, assembly, keeper%plan)
      limit_cpu = loaded%scene%settings%kinematic%number("limit_cpu")
      call run_kinematic(loaded%system, q, loaded%plan, newton, limit_cpu, keeper, summary, error)
      call directory%close()
   end subroutine run_prescribed

   !> Equilibrium at rest.
   subroutine run_equilibrium(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck
      type(error_t), allocatable, intent(out) :: error     !! whatever went wrong

      type(assembly_t) :: assembly
      type(equilibrium_t) :: equilibrium
      type(output_directory_t) :: directory
      type(run_recorder_t) :: keeper
      type(summary_t) :: summary
      real(wp), allocatable :: q(:), v(:)

      call loaded%system%linkage%deck_state(q, v)
      call find_equilibrium(loaded%scene, loaded%system, q, assembly, equilibrium, error)
      if (allocated(error)) return
      call directory%open(directory_of(options, loaded), error)
      if (allocated(error)) return
      call make_plan(options, loaded, directory, assembly, keeper%plan)
      call keep_films(keeper%plan)
      call record_equilibrium(loaded%system, equilibrium, keeper, summary, error)
      call directory%close()
   end subroutine run_equilibrium

   !> Of an equilibrium there are figures of films only; a warning for the others.
   subroutine keep_films(plan)
      type(output_plan_t), intent(inout) :: plan  !! plan of the run

      type(text_t), allocatable :: films(:)
      integer :: k

      allocate (films(0))
      do k = 1, size(plan%figures)
         if (starts_with(plan%figures(k)%s, "film(")) call append_text(films, plan%figures(k)%s)
      end do
      if (size(films) < size(plan%figures)) then
         call append_text(plan%warnings, "figures left out: an equilibrium is one instant")
      end if
      plan%with%figures = plan%with%figures .and. size(films) > 0
      call move_alloc(films, plan%figures)
   end subroutine keep_films

   !> The integrator that a scene asks for, with its controls.
   subroutine new_method(scene, method)
      type(scene_t), intent(in) :: scene                                !! the scene
      class(integrator_t), allocatable, intent(out) :: method           !! the integrator, not started

      call find_integrator(scene%settings%dynamic%word("method"), method)
      call read_controls(scene%settings%dynamic%item_t, method%controls)
   end subroutine new_method

   !> The mechanism with ideal joints, text files only, for the figures.
   subroutine run_twin(loaded, plan, ideal, error)
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(output_plan_t), intent(in) :: plan              !! plan of the run proper
      type(ideal_start_t), intent(inout) :: ideal          !! the start with ideal joints, if the run proper has found it
      type(error_t), allocatable, intent(out) :: error     !! there is no twin

      class(integrator_t), allocatable :: method
      type(assembly_t) :: assembly
      type(mechanism_t) :: system
      type(run_recorder_t) :: keeper
      type(subsystem_t), allocatable :: subsystems(:)
      type(summary_t) :: summary
      real(wp), allocatable :: y(:)

      call new_system(loaded%scene, levels_ideal, system)
      if (size(system%linkage%ideal) == 0) return  ! no joint is another without clearance
      call find_start(loaded%scene, levels_ideal, system, y, assembly, error, ideal=ideal)
      if (allocated(error)) return
      call new_method(loaded%scene, method)
      keeper%plan = plan
      keeper%plan%suffix = ".ideal"
      keeper%plan%with%hdf5 = .false.
      keeper%plan%with%summary = .false.
      keeper%plan%with%motion = .false.
      keeper%plan%with%figures = .false.
      keeper%plan%with%progress = .false.
      keeper%plan%show = show_nothing
      call new_subsystems(loaded%scene, levels_ideal, system, method, loaded%plan%end, subsystems)
      call run_dynamic(system, method, subsystems, y, loaded%plan, twin_limits(loaded%scene, system), keeper, summary, &
                       error)
   end subroutine run_twin

   !> Directory of the run: outputs/NAME of inputs/NAME.deck, unless `--out` names another.
   function directory_of(options, loaded) result(directory)
      type(options_t), intent(in) :: options       !! the command line
      type(loaded_t), intent(in) :: loaded         !! the deck
      character(:), allocatable :: directory       !! of the run

      integer :: dot, slash

      associate (path => loaded%path)
         slash = index(path, "/", back=.true.)
         dot = index(path, ".", back=.true.)
         if (dot <= slash + 1) dot = len(path) + 1
         directory = "outputs/"//path(slash + 1:dot - 1)
         if (loaded%is_stream .and. (starts_with(path, "/dev/") .or. starts_with(path, "/proc/"))) directory = "outputs/stdin"
      end associate
      if (allocated(options%directory)) directory = options%directory
   end function directory_of

end module verb_run
