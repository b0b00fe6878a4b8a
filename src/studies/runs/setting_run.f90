!> One run of a scene with a setting: its system and start made anew, so that no run knows of another.
module setting_run
   use assembly_report, only: assembly_t
   use build_system, only: levels_as_written, new_system
   use coordinates, only: coordinates_t
   use diagnostics, only: diagnostics_t
   use dynamic, only: run_dynamic
   use errors, only: error_t
   use guards, only: new_guards
   use integrator, only: integrator_t, steps_any, steps_fixed
   use integrator_controls, only: read_controls
   use integrator_registry, only: find_integrator
   use item, only: item_t, location_t, option_t, place_of
   use kept_run, only: kept_run_t
   use kinds, only: i8, not_a_number, wp
   use mechanism, only: mechanism_t
   use perturbation, only: new_shift, random_shift, shift_t
   use precision_info, only: setting_t
   use recorder, only: summary_t
   use run_audit, only: limits_t
   use scene, only: scene_t
   use source_text, only: source_t
   use start_state, only: find_start
   use step_check, only: check_steps
   use stop_condition, only: stop_t
   use subsystems, only: new_subsystems, subsystem_t
   use text, only: segment, starts_with
   use time_plan, only: time_plan_t
   implicit none (type, external)
   private
   public :: first_line, has_fixed_steps, job_t, outcome_t, prepare_run, run_setting

   !> What all runs of a scene share.
   type :: job_t
      type(scene_t) :: scene                !! the scene; its settings of the integration change from run to run
      type(item_t) :: settings              !! those of the deck
      type(time_plan_t) :: plan             !! times of the motion and of the instants compared
      type(stop_t) :: stop                  !! conditions of the deck that end the motion
      real(wp) :: cpu = 0.0_wp              !! processor time that a run may take, 0: no limit [s]
      real(wp) :: clock = 0.0_wp            !! time that it may take by the clock on the wall, 0: no limit [s]
      integer :: start = 0                  !! number of the start in the deck's ensemble, 0: the start as it is
      integer :: member = 0                 !! number of the perturbation put on that, 0: none
      real(wp) :: length = 0.0_wp           !! of a perturbation [m]
      real(wp) :: speed = 0.0_wp            !! of a perturbation [m/s]
      real(wp) :: rounding = 0.0_wp         !! maximum part of each coordinate by which the start is changed, 0: none [1]
   end type job_t

   !> What came of a run.
   type :: outcome_t
      character(:), allocatable :: reason   !! why it failed; blank: it did not
      logical :: is_late = .false.          !! it failed because the time was used up
      real(wp) :: setup = 0.0_wp            !! processor time of making the system and its start [s]
      type(summary_t) :: summary            !! cost and errors of the solution
   end type outcome_t

contains

   !> Whether the tolerance sweep of a setting is one of steps.
   logical function has_fixed_steps(setting)
      type(setting_t), intent(in) :: setting  !! the setting

      class(integrator_t), allocatable :: method

      call find_integrator(setting%method, method)
      has_fixed_steps = method%steps() == steps_fixed .or. (method%steps() == steps_any .and. setting%way == "baumgarte_step")
   end function has_fixed_steps

   !> Run.
   subroutine run_setting(job, setting, asked, keeper, outcome, is_audited)
      type(job_t), intent(inout) :: job               !! what all runs share
      type(setting_t), intent(in) :: setting          !! the setting
      real(wp), intent(in) :: asked                   !! tolerance, or length of fixed steps [1 or s]
      class(kept_run_t), intent(inout) :: keeper      !! keeps the run, or nothing
      type(outcome_t), intent(out) :: outcome         !! what came of it
      logical, intent(in), optional :: is_audited     !! the deck's limits of ledger and violation hold; absent: they do not

      class(integrator_t), allocatable :: method
      type(error_t), allocatable :: error
      type(limits_t) :: limits
      type(mechanism_t) :: system
      type(subsystem_t), allocatable :: subsystems(:)
      real(wp), allocatable :: y(:)
      integer(i8) :: clock_0, clock_1, ticks
      real(wp) :: cpu_0, cpu_1

      outcome%reason = ""
      call cpu_time(cpu_0)
      call prepare_run(job, setting, asked, system, method, y, error)
      if (.not. allocated(error)) then
         call new_subsystems(job%scene, levels_as_written, system, method, job%plan%end, subsystems)
      end if
      call cpu_time(cpu_1)
      call system_clock(clock_0, ticks)
      outcome%setup = cpu_1 - cpu_0
      if (.not. allocated(error)) then
         limits%cpu = job%cpu
         limits%clock = job%clock
         if (present(is_audited)) then
            if (is_audited) limits%energy = job%settings%number("energy_limit")
            if (is_audited) limits%violation = job%settings%number("violation_limit")
         end if
         call new_guards(job%scene, system, limits%guards)
         limits%stop = job%stop
         call run_dynamic(system, method, subsystems, y, job%plan, limits, keeper, outcome%summary, error)
      end if
      if (.not. allocated(error)) return
      outcome%reason = first_line(error%message)
      call system_clock(clock_1)
      outcome%is_late = job%clock > 0.0_wp .and. real(clock_1 - clock_0, wp) >= job%clock*real(ticks, wp)
      if (.not. allocated(outcome%summary%status)) outcome%summary%cpu_seconds = not_a_number()
   end subroutine run_setting

   !> The system and its integrator, made anew, with the start.
   subroutine prepare_run(job, setting, asked, system, method, y, error)
      type(job_t), intent(inout) :: job                               !! what all runs share
      type(setting_t), intent(in) :: setting                          !! the setting
      real(wp), intent(in) :: asked                                   !! tolerance, or length of fixed steps [1 or s]
      type(mechanism_t), intent(inout) :: system                      !! the system, new
      class(integrator_t), allocatable, intent(out) :: method         !! the integrator, not started
      real(wp), allocatable, intent(out) :: y(:)                      !! (n) state at t = 0 [any]
      type(error_t), allocatable, intent(out) :: error                !! parts of the setting do not agree, or there is no start

      type(assembly_t) :: assembly
      type(shift_t), allocatable :: shift

      call take_setting(job, setting, asked, error)
      if (allocated(error)) return
      call new_system(job%scene, levels_as_written, system)
      call find_integrator(setting%method, method)
      call read_controls(job%scene%settings%dynamic%item_t, method%controls)
      call find_shift(job, system%linkage%coordinates, shift)
      call find_start(job%scene, levels_as_written, system, y, assembly, error, shift)
   end subroutine prepare_run

   !> The perturbation of the start: that of the deck's ensemble and those of the job, one on the other.
   subroutine find_shift(job, coordinates, shift)
      type(job_t), intent(in) :: job                      !! what all runs share
      class(coordinates_t), intent(in) :: coordinates     !! of the bodies
      type(shift_t), allocatable, intent(out) :: shift    !! not allocated: the start as it is

      type(shift_t) :: other

      if (job%start > 0) shift = new_shift(job%scene, coordinates, job%start)
      if (job%member > 0) then
         other = random_shift(job%scene%bodies, coordinates, 1, job%member, job%length, job%speed)
         if (.not. allocated(shift)) then
            shift = other
         else
            shift%q = shift%q + other%q
            shift%v = shift%v + other%v
         end if
      end if
      if (job%rounding <= 0.0_wp) return
      if (.not. allocated(shift)) shift = random_shift(job%scene%bodies, coordinates, 1, 1, 0.0_wp, 0.0_wp)
      call shift%round_off(coordinates, job%scene%bodies%n, job%rounding)
   end subroutine find_shift

   !> Give the scene a setting.
   subroutine take_setting(job, setting, asked, error)
      type(job_t), intent(inout) :: job                   !! its scene is changed
      type(setting_t), intent(in) :: setting              !! the setting
      real(wp), intent(in) :: asked                       !! tolerance, or length of fixed steps [1 or s]
      type(error_t), allocatable, intent(out) :: error    !! its parts do not go together

      type(diagnostics_t) :: mistakes
      type(source_t) :: none(0)

      job%scene%settings%dynamic%item_t = job%settings
      call put_word("method", setting%method)
      if (setting%way /= "") call put_word("stabilise", setting%way)
      if (setting%solver /= "") call put_word("solver", setting%solver)
      if (has_fixed_steps(setting)) then
         call put_number("step", asked)
      else
         call put_number("step", 0.0_wp)
         call put_number("tolerance", asked)
      end if
      job%scene%settings%dynamic%values(:)%location = location_t()
      call check_steps(job%scene, mistakes)
      call mistakes%to_error(none, error)

   contains

      !> Give a key another word, without the options of the one before.
      subroutine put_word(key, word)
         character(*), intent(in) :: key   !! the key
         character(*), intent(in) :: word  !! its word

         associate (value => job%scene%settings%dynamic%values(place_of(job%scene%settings%dynamic, key)))
            if (value%text == word) return
            value%text = word
            value%options = [option_t ::]
         end associate
      end subroutine put_word

      !> Give a key another number.
      subroutine put_number(key, number)
         character(*), intent(in) :: key   !! the key
         real(wp), intent(in) :: number    !! its number [any]

         job%scene%settings%dynamic%values(place_of(job%scene%settings%dynamic, key))%number = number
      end subroutine put_number

   end subroutine take_setting

   !> The first line of a message, without `error:`.
   pure function first_line(message) result(line)
      character(*), intent(in) :: message   !! of an error
      character(:), allocatable :: line     !! one line

      line = message
      if (starts_with(line, "error: ")) line = segment(line, 8)
      if (index(line, new_line("a")) > 0) line = segment(line, 1, index(line, new_line("a")) - 1)
   end function first_line

end module setting_run
