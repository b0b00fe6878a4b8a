!> Motion in time: drives an integrator from event to event and hands everything to a recorder.
module dynamic
   use contact_places, only: touch_function
   use contact_watch, only: close_open, contact_watch_t, new_contact_watch
   use cpu_budget, only: cpu_budget_t
   use errors, only: error_t
   use guards, only: guards_t
   use instants, only: instants_t
   use integrator, only: advance_event, advance_failed_evaluation, integrator_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, not_a_number, wp
   use mechanism_energy, only: energy_of, energy_t
   use mechanism, only: mechanism_t
   use recorder, only: event_t, recorder_t, status_complete, status_failed, summary_t
   use run_audit, only: audit, limits_t, warn_of_errors
   use run_failure, only: constraints_lost, describe_failure, events_without_end, guard_reached, time_used_up
   use sampling, only: new_sampler, sampler_t
   use slip_watch, only: decide_next, note_jumps
   use stop_condition, only: stop_t
   use time_plan, only: time_plan_t
   use velocity_jumps, only: velocity_jumps_t
   implicit none (type, external)
   private
   public :: run_dynamic

   integer, parameter :: progress_every = 256      !! steps between two reports of progress
   integer, parameter :: most_idle = 1000          !! events that may follow one another while hardly any time passes
   integer, parameter :: idle_each = 10            !! and so many more for each event function
   real(wp), parameter :: idle = 1.0e-12_wp        !! hardly any time: part of the present time [1]
   real(wp), parameter :: lost_length = 0.1_wp     !! violation beyond all measure: a length, of the size of the bodies [1]
   real(wp), parameter :: lost_angle = 1.0_wp      !! an angle [rad]

   !> The state of a run.
   type :: run_t
      type(sampler_t) :: sampler                 !! what is reported, and when
      type(cpu_budget_t) :: budget               !! processor time left
      type(contact_watch_t) :: watch             !! contacts
      type(summary_t) :: summary                 !! cost and errors so far
      type(guards_t) :: guards                   !! what ends it early or is told of it
      type(stop_t) :: stop                       !! conditions that end it by intent
      real(wp) :: balance_0 = 0.0_wp             !! balance of the ledger at the start [J]
      real(wp) :: potential_0 = 0.0_wp           !! potential energy at the start [J]
      real(wp) :: residual = 0.0_wp              !! of the ledger at the last step [J]
      real(wp) :: aside = 0.0_wp                 !! CPU time spent on writing events [s]
      real(wp) :: lost = 0.0_wp                  !! least that contacts had lost so far: negative, they made energy [J]
      real(wp) :: worst = 0.0_wp                 !! greatest violation so far, over the size of the bodies or one radian [1]
      integer :: worst_row = 0                   !! the row it belongs to
      logical :: is_lost = .false.               !! whether a violation is beyond all measure
      real(wp) :: t_event = 0.0_wp               !! time of the last event [s]
      integer :: n_idle = 0                      !! events since the last time that time passed
      type(instants_t) :: instants               !! when functions of time are not smooth
      type(velocity_jumps_t) :: jumps            !! drivers whose velocity jumps there
   end type run_t

contains

   !> Run from a state at t = 0 to the end.
   subroutine run_dynamic(system, method, y, plan, limits, recorder, summary, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator, with its controls
      real(wp), intent(in) :: y(:)                        !! (n) state at t = 0 [any]
      type(time_plan_t), intent(in) :: plan               !! times
      type(limits_t), intent(in) :: limits                !! what the results must fulfil
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(summary_t), intent(out) :: summary             !! cost and errors
      type(error_t), allocatable, intent(out) :: error    !! the integration failed, or a file could not be written

      type(error_t), allocatable :: late_error
      type(event_t) :: row
      type(run_t) :: run
      real(wp) :: cpu_0, cpu_1
      integer(i8) :: clock_0, clock_1, ticks
      logical :: is_open

      call system_clock(clock_0, ticks)
      run%guards = limits%guards
      run%stop = limits%stop
      call new_sampler(system, plan, run%sampler)
      call new_contact_watch(system, run%watch)
      run%summary%method = method_name(method)
      run%summary%solver = system%linkage%solution%solver%name()
      run%summary%stabilisation = system%way%words()
      run%summary%tolerance = merge(0.0_wp, method%controls%tolerance, method%controls%fixed_step > 0.0_wp)
      run%summary%ledger = system%with_ledger
      allocate (run%summary%warnings(0))
      call recorder%start(run%sampler%catalogue, error)
      call cpu_time(cpu_0)
      call run%budget%begin(limits%cpu)
      if (.not. allocated(error)) call integrate(system, method, y, plan, recorder, run, error)
      call cpu_time(cpu_1)
      call run%sampler%finish(system, method, plan, run%watch, run%residual, recorder, late_error)
      if (allocated(error) .and. allocated(late_error)) deallocate (late_error)  ! told already
      do
         call close_open(system, method, is_open, row)
         if (.not. is_open .or. allocated(late_error)) exit
         call recorder%event(row, late_error)
      end do
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
      call system_clock(clock_1)
      run%summary%cpu_seconds = cpu_1 - cpu_0 - run%aside - run%sampler%aside
      run%summary%wall_seconds = real(clock_1 - clock_0, wp)/real(ticks, wp)
      run%summary%time_end = merge(run%stop%t, method%t, run%stop%met > 0)
      run%summary%steps = method%n_steps
      run%summary%rejected_steps = method%n_rejected
      run%summary%rhs_evaluations = system%n_evaluations
      run%summary%output_evaluations = method%n_output_evaluations + run%sampler%n_reports
      run%summary%factorisations = system%linkage%solution%solver%n_factorisations
      run%summary%samples = int(run%sampler%n_sample)
      run%summary%rows = run%sampler%n_row
      if (.not. system%with_ledger) run%summary%energy_residual_max = not_a_number()
      if (.not. allocated(error)) call audit(run%summary, limits, error)
      call warn_of_errors(system, run%worst, run%worst_row, run%lost, run%summary)
      call run%jumps%warn(system, run%summary%warnings)
      call run%guards%warn(system, run%summary%warnings)
      run%summary%status = status_complete
      run%summary%message = ""
      if (run%stop%met > 0) run%summary%message = run%stop%message()
      if (allocated(error)) then
         run%summary%status = status_failed
         run%summary%message = error%message
      end if
      call recorder%finish(run%summary, late_error)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
      summary = run%summary
   end subroutine run_dynamic

   !> From step to step.
   subroutine integrate(system, method, y, plan, recorder, run, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      real(wp), intent(in) :: y(:)                        !! (n) state at t = 0 [any]
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(run_t), intent(inout) :: run                   !! state of the run
      type(error_t), allocatable, intent(out) :: error    !! the integration failed, or a file could not be written

      type(energy_t) :: energy
      real(wp) :: t_stop
      integer :: n_since_progress, status

      run%instants = plan%instants
      call run%instants%begin(plan%end, system%linkage%piece)
      call system%begin_pace(0.0_wp, y, plan%end)
      call system%linkage%set_motion(0.0_wp, y)
      call decide_slips(system, 0.0_wp, y, recorder, run, error)
      if (allocated(error)) return
      call method%start(system, 0.0_wp, y, plan%end, status)
      if (status /= 0) then
         call describe_failure(system, method, status, error)
         return
      end if
      call run%guards%begin(system)
      energy = energy_of(system, y)
      run%balance_0 = energy%balance()
      run%potential_0 = energy%potential
      call look_at_step(system, method, run)
      call look_at_energy(system, method, run)
      if (system%n_loose > 0) call run%watch%after_restart(system, method)
      call look_for_stop(system, method, run, error)
      if (allocated(error)) return
      call run%sampler%take(system, method, plan, run%watch, run%residual, recorder, error)
      n_since_progress = 0
      do while (method%t < plan%end .and. run%stop%met == 0 .and. .not. allocated(error))
         method%look = merge(plan%every, huge(1.0_wp), method%t >= plan%first_output)
         call run%instants%stop_after(system, method, t_stop)
         call method%advance(system, t_stop, status)
         if (status < 0) then
            call describe_failure(system, method, status, error)
            return
         end if
         call look_at_step(system, method, run)
         if (run%is_lost .or. run%budget%is_spent()) then
            call describe_failure(system, method, merge(constraints_lost, time_used_up, run%is_lost), error)
            return
         end if
         if (system%n_loose > 0) call run%watch%after_step(system, method)
         call look_at_energy(system, method, run)
         call run%guards%look(system, method%t)
         call look_for_stop(system, method, run, error)
         if (.not. allocated(error)) call run%sampler%take(system, method, plan, run%watch, run%residual, recorder, error)
         if (allocated(run%guards%reason) .and. .not. allocated(error)) then
            call describe_failure(system, method, guard_reached, error, run%guards%reason)
         end if
         if (status == advance_event .and. run%stop%met == 0 .and. .not. allocated(error)) then
            call handle_events(system, method, plan, recorder, run, error)
         end if
         if (run%instants%is_at(method%t) .and. run%stop%met == 0 .and. .not. allocated(error)) then
            call pass_instant(system, method, plan, recorder, run, error)
         end if
         n_since_progress = n_since_progress + 1
         if (n_since_progress == progress_every) then
            n_since_progress = 0
            call recorder%progress(method%t/plan%end)
         end if
      end do
      if (run%stop%met > 0 .and. .not. allocated(error)) then
         call run%sampler%take_stop(system, method, plan, run%residual, recorder, error)
      end if
   end subroutine integrate

   !> Pace and constraint violation at the end of a step.
   subroutine look_at_step(system, method, run)
      type(mechanism_t), intent(inout) :: system  !! the system, last evaluated at the end of the step
      class(integrator_t), intent(in) :: method       !! the integrator
      type(run_t), intent(inout) :: run               !! maxima are raised

      real(wp) :: scaled
      integer :: k

      call system%follow_pace(method%step%y1)
      do k = 1, system%linkage%rows%n_solve
         scaled = system%linkage%solution%row_weight(k)*abs(system%linkage%rows%phi(k))
         run%is_lost = run%is_lost .or. scaled > merge(lost_angle, lost_length, system%linkage%rows%is_angle(k))
         if (scaled > run%worst) then
            run%worst = scaled
            run%worst_row = k
         end if
         run%summary%violation_max = max(run%summary%violation_max, abs(system%linkage%rows%phi(k)))
         run%summary%violation_rate_max = max(run%summary%violation_rate_max, abs(system%linkage%solution%phi_dot(k)))
      end do
   end subroutine look_at_step

   !> Energy balance at the end of a step, after `watch` has looked at it.
   subroutine look_at_energy(system, method, run)
      type(mechanism_t), intent(in) :: system     !! the system, its motion that of the end of the step
      class(integrator_t), intent(in) :: method       !! the integrator
      type(run_t), intent(inout) :: run               !! maxima are raised

      type(energy_t) :: energy

      if (.not. system%with_ledger) return
      energy = energy_of(system, method%step%y1)
      run%residual = energy%balance() - run%balance_0
      run%lost = min(run%lost, energy%dissipated_contact)
      run%summary%energy_residual_max = max(run%summary%energy_residual_max, abs(run%residual))
      run%summary%energy_max = max(run%summary%energy_max, energy%kinetic + energy%elastic &
                                   + abs(energy%potential - run%potential_0))
      call run%guards%look_at_energy(run%residual, run%summary%energy_max, energy%magnitude())
   end subroutine look_at_energy

   !> Whether a condition ends the run within the last step.
   subroutine look_for_stop(system, method, run, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      type(run_t), intent(inout) :: run                   !! state of the run
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      real(wp) :: cpu_0, cpu_1
      integer :: status

      if (run%stop%n == 0) return
      call cpu_time(cpu_0)
      call run%stop%look(system, method, run%residual, run%sampler%catalogue, status)
      if (run%stop%met > 0) run%sampler%until = run%stop%t
      if (status /= 0) call describe_failure(system, method, advance_failed_evaluation, error)
      call cpu_time(cpu_1)
      run%aside = run%aside + (cpu_1 - cpu_0)
   end subroutine look_for_stop

   !> Handle the events at the end of the last step, and go on from there.
   subroutine handle_events(system, method, plan, recorder, run, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(run_t), intent(inout) :: run                   !! state of the run
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to go on

      type(event_t) :: row
      real(wp) :: cpu_0, cpu_1, hint, step_hint
      integer :: k, status
      logical :: is_over

      run%n_idle = merge(run%n_idle + 1, 0, method%t - run%t_event <= idle*method%t)
      run%t_event = method%t
      if (run%n_idle > most_idle + idle_each*system%n_event) then
         call describe_failure(system, method, events_without_end, error)
         return
      end if
      call run%sampler%before_events(system, method, plan, run%watch, run%residual, recorder, error)
      if (allocated(error)) return
      step_hint = 0.0_wp
      do k = 1, method%n_happened
         call run%watch%handle_event(system, method, method%happened(k), is_over, row, hint)
         if (hint > 0.0_wp) step_hint = merge(hint, min(hint, step_hint), step_hint <= 0.0_wp)
         run%summary%events = run%summary%events + 1
         if (is_over) then
            call cpu_time(cpu_0)
            call recorder%event(row, error)
            if (allocated(error)) return
            call cpu_time(cpu_1)
            run%aside = run%aside + (cpu_1 - cpu_0)
         else if (system%functions%kind_of(method%happened(k)) == touch_function) then
            run%summary%contacts = run%summary%contacts + 1
         end if
      end do
      call decide_slips(system, method%t, method%step%y1, recorder, run, error)
      if (allocated(error)) return
      call method%restart(system, step_hint, status)
      if (status /= 0) then
         call describe_failure(system, method, status, error)
         return
      end if
      call run%watch%after_restart(system, method)
      call run%sampler%after_events(system, method, plan, run%watch, run%residual, recorder, error)
   end subroutine handle_events

   !> Pass an instant at which functions of time are not smooth.
   subroutine pass_instant(system, method, plan, recorder, run, error)
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator, at the instant
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(run_t), intent(inout) :: run                   !! state of the run
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to go on

      real(wp), allocatable :: before(:)
      integer :: status

      call run%sampler%before_instant(system, method, plan, run%watch, run%residual, recorder, error)
      if (allocated(error)) return
      method%g = method%g1
      before = method%step%f1
      call run%jumps%before_instant(system, method)
      call run%instants%pass(system%linkage%piece)
      call run%jumps%after_instant(system, method, status)
      if (status /= 0) then
         call describe_failure(system, method, advance_failed_evaluation, error)
         return
      end if
      call decide_slips(system, method%t, method%step%y1, recorder, run, error)
      if (allocated(error)) return
      call method%restart(system, 0.0_wp, status)
      if (status /= 0) then
         call describe_failure(system, method, status, error)
         return
      end if
      call system%follow_pace(method%step%y1, method%step%f1 - before)
      call look_at_step(system, method, run)  ! a jump of a driver is seen here, before the stabilisation acts
      call look_at_energy(system, method, run)
      if (run%is_lost) then
         call describe_failure(system, method, constraints_lost, error)
         return
      end if
      call run%watch%after_restart(system, method)
      call note_jumps(system, method)
      if (method%n_happened > 0) call handle_events(system, method, plan, recorder, run, error)
      if (.not. allocated(error)) call run%sampler%take(system, method, plan, run%watch, run%residual, recorder, error)
   end subroutine pass_instant

   !> Decide whether contacts that have just begun slip or stick.
   subroutine decide_slips(system, t, y, recorder, run, error)
      type(mechanism_t), intent(inout) :: system      !! the system, its motion that of the state
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: y(:)                        !! (n) state [any]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(run_t), intent(inout) :: run                   !! state of the run
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      type(event_t) :: row
      logical :: has_row, is_found

      if (system%grips%n_slip == 0) return
      do
         call decide_next(system, t, y, is_found, has_row, row)
         if (.not. is_found) exit
         if (.not. has_row) cycle
         call recorder%event(row, error)
         if (allocated(error)) return
      end do
   end subroutine decide_slips

   !> Name of an integrator.
   function method_name(method) result(name)
      class(integrator_t), intent(in) :: method  !! the integrator
      character(:), allocatable :: name          !! its name

      type(kind_info_t) :: info

      info = method%info()
      name = info%name
   end function method_name

end module dynamic
