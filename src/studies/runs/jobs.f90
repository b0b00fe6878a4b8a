!> A run of a scene: its system, its start, its integration, limits, recorder. All that runs a mechanism, in time, kinematically or
!> at rest, is a job, and goes through `run_job`; who looks at the start before, or does more with it, calls its two parts
!> `start_job` and `run_started`.
module jobs
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use catalogue, only: catalogue_t
   use coordinates, only: coordinates_t
   use dynamic, only: run_dynamic
   use errors, only: error_t
   use guards, only: new_guards
   use integrator, only: integrator_t
   use kinds, only: i8, not_a_number, wp
   use kinematic, only: run_kinematic
   use kinematic_start, only: find_kinematic_start
   use mechanism, only: mechanism_t
   use memory_purpose, only: memory_is_for
   use mobility, only: mobility_t
   use perturbation, only: new_shift, random_shift, shift_t
   use prescribed_motion, only: newton_t
   use recorder, only: recorder_t, summary_t
   use run_audit, only: limits_t
   use saved_run, only: saved_run_t
   use scene, only: analysis_kinematic, analysis_static, scene_t
   use start_state, only: find_start, ideal_start_t
   use static, only: equilibrium_t, find_equilibrium, record_equilibrium
   use subsystems, only: new_subsystems, subsystem_t
   use text, only: segment, starts_with, to_text
   use time_plan, only: time_plan_t
   implicit none (type, external)
   private
   public :: copy_job, first_line, job_t, outcome_t, run_job, run_started, start_job, started_t

   !> A change of the start.
   type :: perturbed_t
      integer :: start = 0                  !! number of the start in the deck's ensemble, 0: the start as it is
      integer :: member = 0                 !! number of the perturbation put on that, 0: none
      real(wp) :: length = 0.0_wp           !! of a perturbation [m]
      real(wp) :: speed = 0.0_wp            !! of a perturbation [m/s]
      real(wp) :: rounding = 0.0_wp         !! maximum part of each coordinate by which the start is changed, 0: none [1]
   end type perturbed_t

   !> What runs, and up to when.
   type :: job_t
      type(scene_t) :: scene                 !! the scene; its settings of the integration may change from run to run
      integer :: levels = levels_as_written  !! how joints with clearance are taken
      type(time_plan_t) :: plan              !! times of the motion and of its output
      type(limits_t) :: limits               !! what the results must fulfil, and what ends the run; guards follow from the system
      type(perturbed_t) :: perturbed         !! how its start is changed
   end type job_t

   !> The start of a run.
   type :: started_t
      type(assembly_t) :: assembly                     !! how it was found
      real(wp), allocatable :: y(:)                    !! (n) state, or positions of an analysis without velocities [any]
      class(integrator_t), allocatable :: method       !! of a motion: its integrator, not started
      type(subsystem_t), allocatable :: subsystems(:)  !! (groups or 0) of a motion: its groups apart
      type(equilibrium_t) :: equilibrium               !! of an analysis at rest: what was found
   end type started_t

   !> What came of a run.
   type :: outcome_t
      character(:), allocatable :: reason   !! why it failed; blank: it did not
      logical :: is_late = .false.          !! it failed because the time was used up
      real(wp) :: setup = 0.0_wp            !! processor time of making the system and its start [s]
      real(wp) :: wall = 0.0_wp             !! time by the clock on the wall, of all [s]
      type(summary_t) :: summary            !! cost and errors of the solution
   end type outcome_t

contains

   !> Copy a job. Here, since each assignment of a scene is much code.
   subroutine copy_job(from, to)
      type(job_t), intent(in) :: from    !! the job
      type(job_t), intent(inout) :: to   !! becomes a copy

      to = from
   end subroutine copy_job

   !> Run a job from its scene: system and start are made anew, so that no run knows of another.
   subroutine run_job(job, recorder, outcome, ideal)
      type(job_t), intent(in) :: job                         !! the job
      class(recorder_t), intent(inout) :: recorder           !! keeps the run, or nothing
      type(outcome_t), intent(out) :: outcome                !! what came of it
      type(ideal_start_t), intent(inout), optional :: ideal  !! as of `start_job`

      type(error_t), allocatable :: error
      type(mechanism_t) :: system
      type(started_t) :: start
      integer(i8) :: clock_0, clock_1, clock_2, ticks
      real(wp) :: cpu_0, cpu_1

      outcome%reason = ""
      call cpu_time(cpu_0)
      call system_clock(clock_0, ticks)
      call new_system(job%scene, job%levels, system)
      call start_job(job, system, start, error, ideal)
      call cpu_time(cpu_1)
      call system_clock(clock_1)
      outcome%setup = cpu_1 - cpu_0
      if (.not. allocated(error)) call run_started(job, system, start, recorder, outcome%summary, error)
      call system_clock(clock_2)
      outcome%wall = real(clock_2 - clock_0, wp)/real(ticks, wp)
      if (.not. allocated(error)) return
      outcome%reason = first_line(error%message)
      associate (clock => job%limits%clock)
         outcome%is_late = clock > 0.0_wp .and. real(clock_2 - clock_1, wp) >= clock*real(ticks, wp)
      end associate
      if (.not. allocated(outcome%summary%status)) outcome%summary%cpu_seconds = not_a_number()
   end subroutine run_job

   !> Find where a run starts; of an analysis at rest, the equilibrium.
   subroutine start_job(job, system, start, error, ideal)
      type(job_t), intent(in) :: job                         !! the job
      type(mechanism_t), intent(inout) :: system             !! its system, new
      type(started_t), intent(out) :: start                  !! where it starts
      type(error_t), allocatable, intent(out) :: error       !! it cannot be assembled, or there is no equilibrium
      type(ideal_start_t), intent(inout), optional :: ideal  !! start with ideal joints: taken if it is there, kept if it was found

      type(mobility_t) :: mobility
      type(shift_t), allocatable :: shift
      real(wp), allocatable :: v(:)

      select case (job%scene%analysis)
      case (analysis_kinematic)
         call find_kinematic_start(job%scene, system, start%y, start%assembly, mobility, error)
      case (analysis_static)
         call system%linkage%deck_state(start%y, v)
         call find_equilibrium(job%scene, system, start%y, start%assembly, start%equilibrium, error)
      case default
         call find_shift(job, system%linkage%coordinates, shift)
         call find_start(job%scene, job%levels, system, start%y, start%assembly, error, shift, ideal)
         if (allocated(error)) return
         call job%scene%settings%integration%new_method(start%method)
         call memory_is_for("the equations of "//to_text(size(job%scene%bodies%names))//" bodies")
         call new_subsystems(job%scene, job%levels, system, start%method, job%plan%end, start%subsystems)
      end select
   end subroutine start_job

   !> Run from a start.
   subroutine run_started(job, system, start, recorder, summary, error, saved, catalogue)
      type(job_t), intent(in) :: job                                        !! the job
      type(mechanism_t), intent(inout), target :: system                    !! its system
      type(started_t), intent(inout), target :: start                       !! its start, used up
      class(recorder_t), intent(inout) :: recorder                          !! keeps the results
      type(summary_t), intent(out) :: summary                               !! cost and errors
      type(error_t), allocatable, intent(out) :: error                      !! the run failed, or a file could not be written
      type(saved_run_t), allocatable, intent(inout), optional :: saved      !! what it continues from; if any
      type(catalogue_t), allocatable, intent(inout), optional :: catalogue  !! what the system can report, taken over

      type(limits_t) :: limits
      type(newton_t) :: newton

      limits = job%limits
      select case (job%scene%analysis)
      case (analysis_kinematic)
         newton%tolerance = job%scene%settings%kinematic%number("tolerance")
         newton%most = nint(job%scene%settings%kinematic%number("maximum_iterations"))
         call run_kinematic(system, start%y, job%plan, newton, limits%cpu, recorder, summary, error)
      case (analysis_static)
         call record_equilibrium(system, start%equilibrium, recorder, summary, error)
      case default
         call new_guards(job%scene, system, limits%guards)
         call run_dynamic(system, start%method, start%subsystems, start%y, job%plan, limits, recorder, summary, error, saved, &
                          catalogue)
      end select
   end subroutine run_started

   !> The perturbation of a start: that of the deck's ensemble and those of the job, one on the other.
   subroutine find_shift(job, coordinates, shift)
      type(job_t), intent(in) :: job                      !! the job
      class(coordinates_t), intent(in) :: coordinates     !! of the bodies
      type(shift_t), allocatable, intent(out) :: shift    !! not allocated: the start as it is

      type(shift_t) :: other

      associate (how => job%perturbed, bodies => job%scene%bodies)
         if (how%start > 0) shift = new_shift(job%scene, coordinates, how%start)
         if (how%member > 0) then
            other = random_shift(bodies, coordinates, 1, how%member, how%length, how%speed)
            if (.not. allocated(shift)) then
               shift = other
            else
               shift%q = shift%q + other%q
               shift%v = shift%v + other%v
            end if
         end if
         if (how%rounding <= 0.0_wp) return
         if (.not. allocated(shift)) shift = random_shift(bodies, coordinates, 1, 1, 0.0_wp, 0.0_wp)
         call shift%round_off(coordinates, bodies%n, how%rounding)
      end associate
   end subroutine find_shift

   !> The first line of a message, without `error:`.
   pure function first_line(message) result(line)
      character(*), intent(in) :: message   !! of an error
      character(:), allocatable :: line     !! one line

      line = message
      if (starts_with(line, "error: ")) line = segment(line, 8)
      if (index(line, new_line("a")) > 0) line = segment(line, 1, index(line, new_line("a")) - 1)
   end function first_line

end module jobs
