!> Motion in time: drives the parts of a mechanism from event to event and hands everything to a recorder.
!>
!> A run is saved where its recorder asks for it, after any step. A method with a history that it does not save, and several parts
!> with steps of their own, can be saved only at instants of the plan: all steps end there, and the saved state is loaded at once.
module dynamic
   use catalogue, only: catalogue_t
   use contact_monitor, only: close_open
   use cpu_budget, only: cpu_budget_t
   use errors, only: error_t, exit_integration, exit_stopped, set_error
   use integrator, only: advance_event, advance_failed_evaluation, advance_step, integrator_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use moving_part, only: begin_part, handle_part_events, make_step, pass_part_instant, see_step
   use recorder, only: event_t, recorder_t, status_stopped, summary_t
   use run_audit, only: limits_t
   use run_failure, only: describe_failure, guard_reached, stopped_words, time_used_up
   use run_summary, only: sum_up
   use run_tally, only: run_tally_t
   use sampling, only: new_sampler, sampler_t
   use saved_run, only: saved_run_t, action_none, action_stop
   use stop_condition, only: cut_step, stop_t
   use subsystems, only: subsystem_t
   use time_plan, only: time_plan_t
   use whole_motion, only: new_whole_motion, whole_motion_t
   implicit none (type, external)
   private
   public :: run_dynamic

   integer, parameter :: progress_every = 256      !! steps between two reports of progress

   !> The state of a run.
   type :: run_t
      type(whole_motion_t) :: whole              !! the mechanism in motion, and its parts
      type(sampler_t) :: sampler                 !! what is reported, and when
      type(cpu_budget_t) :: budget               !! processor time left
      type(run_tally_t) :: tally                 !! sums and maxima so far
      type(stop_t) :: stop                       !! conditions that end it by intent
      integer, allocatable :: waiting(:)         !! (parts) scratch: parts at the front for which something waits
      logical :: is_scheduled = .false.          !! it can be saved at the instants of the plan only
      integer :: n_checkpoint = 0                !! instants of the plan passed
      real(wp) :: next_checkpoint = huge(1.0_wp) !! the next of them [s]
      logical :: is_stopped = .false.            !! it was ended from outside
      real(wp) :: saved_at = -1.0_wp             !! time of the motion at which it was saved last; negative: it was not [s]
      real(wp) :: cpu_before = 0.0_wp            !! processor time used before it was resumed [s]
      real(wp) :: cpu_begin = 0.0_wp             !! processor time of the program at its start [s]
   end type run_t

   interface
      !> Continue from what was saved, instead of from the start.
      module subroutine go_on(run, saved, recorder, error)
         implicit none (type, external)
         type(run_t), intent(inout) :: run                   !! state of the run, started
         type(saved_run_t), intent(inout) :: saved           !! what was remembered
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! it is another run's
      end subroutine go_on

      !> The instant of the plan that comes next.
      module subroutine next_checkpoint(run, plan)
         implicit none (type, external)
         type(run_t), intent(inout) :: run                   !! state of the run
         type(time_plan_t), intent(in) :: plan               !! times
      end subroutine next_checkpoint

      !> Save the run.
      module subroutine save_now(run, plan, recorder, error)
         implicit none (type, external)
         type(run_t), intent(inout) :: run                   !! state of the run, between two steps
         type(time_plan_t), intent(in) :: plan               !! times
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      end subroutine save_now
   end interface

contains

   !> Run from a state at t = 0 to the end.
   subroutine run_dynamic(system, method, subsystems, y, plan, limits, recorder, summary, error, saved, catalogue)
      type(mechanism_t), intent(inout), target :: system          !! the system
      class(integrator_t), intent(inout), target :: method        !! the integrator, with its controls
      type(subsystem_t), intent(inout), target :: subsystems(:)   !! (parts) groups of bodies to be integrated apart; none: as one
      real(wp), intent(in) :: y(:)                                !! (n) state at t = 0 [any]
      type(time_plan_t), intent(in) :: plan                       !! times
      type(limits_t), intent(in) :: limits                        !! what the results must fulfil
      class(recorder_t), intent(inout) :: recorder                !! keeps the results
      type(summary_t), intent(out) :: summary                     !! cost and errors
      type(error_t), allocatable, intent(out) :: error            !! the integration failed, or a file could not be written
      type(saved_run_t), allocatable, intent(inout), optional :: saved  !! what it continues from; absent, unallocated: it starts
      type(catalogue_t), allocatable, intent(inout), optional :: catalogue  !! what the system can report, taken over

      type(error_t), allocatable :: late_error
      type(run_t) :: run
      real(wp) :: aside, cpu_0, cpu_1
      integer(i8) :: clock_0, clock_1, ticks

      call system_clock(clock_0, ticks)
      run%stop = limits%stop
      call new_whole_motion(system, method, subsystems, limits, plan%output_times, run%whole)
      allocate (run%waiting(size(run%whole%parts)))
      call new_sampler(system, plan, run%sampler, catalogue)
      call recorder%start(run%sampler%catalogue, error)
      if (.not. allocated(error)) call run%sampler%ask(run%whole, recorder, run%stop)
      call run%tally%aside%begin(0.0_wp)
      call cpu_time(cpu_0)
      run%cpu_begin = cpu_0
      run%is_scheduled = size(run%whole%parts) > 1 .or. method%begins_anew()
      if (.not. allocated(error)) call integrate(run, y, plan, limits, recorder, saved, error)
      call cpu_time(cpu_1)
      aside = run%tally%aside%seconds() + run%sampler%aside%seconds()
      call run%sampler%finish(run%whole, plan, run%tally%residual, recorder, late_error)
      if (allocated(error) .and. allocated(late_error)) deallocate (late_error)  ! reported already
      if (.not. allocated(late_error)) call close_contacts(run, recorder, late_error)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
      call system_clock(clock_1)
      call sum_up(run%whole, run%sampler, run%tally, run%stop, method, limits, summary, error)
      if (run%is_stopped .and. .not. allocated(error)) then
         summary%status = status_stopped
         summary%message = stopped_words(run%whole%t, recorder%stopped_by, run%saved_at, size(run%whole%parts))
      end if
      summary%cpu_seconds = run%cpu_before + cpu_1 - cpu_0 - aside
      summary%wall_seconds = real(clock_1 - clock_0, wp)/real(ticks, wp)
      call recorder%finish(summary, late_error)
      if (allocated(late_error) .and. .not. allocated(error)) call move_alloc(late_error, error)
      if (.not. run%is_stopped .or. allocated(error)) return
      call set_error(error, merge(exit_stopped, exit_integration, run%saved_at >= 0.0_wp), summary%message)
   end subroutine run_dynamic

   !> From step to step.
   subroutine integrate(run, y, plan, limits, recorder, saved, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      real(wp), intent(in) :: y(:)                        !! (n) state at t = 0 [any]
      type(time_plan_t), intent(in) :: plan               !! times
      type(limits_t), intent(in) :: limits                !! the time that it may take
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(saved_run_t), allocatable, intent(inout), optional :: saved  !! what the run continues from; none: it starts
      type(error_t), allocatable, intent(out) :: error    !! the integration failed, or a file could not be written

      integer :: n_since_progress
      logical :: is_over

      call begin(run, y, plan, recorder, error)
      if (allocated(error)) return
      if (run%sampler%films%has_min) call look_at_films(run)
      call look_for_stop(run, plan, error)
      if (allocated(error)) return
      if (present(saved)) then
         if (allocated(saved)) call go_on(run, saved, recorder, error)
      end if
      call run%budget%begin(limits%cpu, run%cpu_before, limits%clock)
      call next_checkpoint(run, plan)
      if (.not. allocated(error)) call run%sampler%take(run%whole, plan, run%tally%residual, recorder, error)
      n_since_progress = 0
      is_over = run%whole%t >= plan%end .or. run%stop%met > 0 .or. allocated(error)
      do while (.not. is_over)
         call step(run, plan, error)
         if (allocated(error)) return
         if (run%whole%t >= run%sampler%due .or. run%whole%n_peak > 0) then
            call run%sampler%take(run%whole, plan, run%tally%residual, recorder, error)
         end if
         if (run%sampler%follows_steps .and. .not. allocated(error)) then
            call run%sampler%follow_step(run%whole, .false., plan, run%tally%residual, recorder)
         end if
         if (.not. run%whole%is_smooth) then
            if (.not. allocated(error)) call look_at_guards(run, error)
            if (run%stop%met == 0 .and. .not. allocated(error)) call handle_events(run, plan, recorder, error)
            if (run%stop%met == 0 .and. .not. allocated(error)) call pass_output_times(run, plan, recorder, error)
            if (run%sampler%follows_steps .and. run%stop%met == 0 .and. .not. allocated(error)) then
               call run%sampler%follow_step(run%whole, .true., plan, run%tally%residual, recorder)
            end if
         end if
         n_since_progress = n_since_progress + 1
         if (n_since_progress == progress_every) then
            n_since_progress = 0
            call recorder%progress(run%whole%t/plan%end)
         end if
         is_over = run%whole%t >= plan%end .or. run%stop%met > 0 .or. allocated(error)
         if (.not. is_over) then
            call heed(run, plan, recorder, error)
            is_over = run%is_stopped .or. allocated(error)
         end if
      end do
      if (run%stop%met > 0 .and. .not. allocated(error)) then
         call run%sampler%take_stop(run%whole, plan, run%tally%residual, recorder, error)
      end if
   end subroutine integrate

   !> Save the run if it is time for it or wished for, and end it if that is.
   subroutine heed(run, plan, recorder, error)
      type(run_t), intent(inout) :: run                   !! state of the run, between two steps
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      integer :: requested_action
      logical :: can_save, is_due

      is_due = run%whole%t >= run%next_checkpoint .and. run%whole%is_together()
      can_save = is_due .or. .not. run%is_scheduled
      requested_action = recorder%requested_action(can_save)
      if (requested_action == action_stop .and. run%is_scheduled .and. run%next_checkpoint < plan%end .and. .not. can_save) &
         requested_action = action_none
      run%is_stopped = requested_action == action_stop
      if (is_due .or. (requested_action /= action_none .and. can_save)) call save_now(run, plan, recorder, error)
   end subroutine heed

   !> All parts start.
   subroutine begin(run, y, plan, recorder, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      real(wp), intent(in) :: y(:)                        !! (n) state at t = 0 [any]
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! it cannot start

      real(wp), allocatable :: own(:)
      integer :: p

      associate (whole => run%whole)
         if (size(whole%parts) > 1) call whole%output_times%begin(plan%end, whole%system%linkage%segment)
         do p = 1, size(whole%parts)
            call whole%scatter(p, y, own)
            call begin_part(whole%parts(p), own, plan%end, run%tally, recorder, error)
            if (allocated(error)) return
         end do
      end associate
   end subroutine begin

   !> Films of all parts as they start.
   subroutine look_at_films(run)
      type(run_t), intent(inout) :: run  !! state of the run

      integer :: k

      do k = 1, size(run%whole%parts)
         call run%sampler%films%look(run%whole%parts(k)%system, run%whole%t)
      end do
   end subroutine look_at_films

   !> A step of each part that is behind.
   subroutine step(run, plan, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      type(time_plan_t), intent(in) :: plan               !! times
      type(error_t), allocatable, intent(out) :: error    !! the integration failed

      integer :: k

      associate (whole => run%whole)
         do k = 1, whole%n_front
            associate (part => whole%parts(whole%front(k)))
               part%method%events%look = merge(plan%every, huge(1.0_wp), part%method%t >= plan%first_output)
               call make_step(part, error, merge(run%next_checkpoint, huge(1.0_wp), run%is_scheduled))
               if (.not. allocated(error)) call look_for_stop(run, plan, error)
               if (.not. allocated(error)) call see_step(part, run%tally, error)
               if (allocated(error)) return
               if (run%budget%is_limited) then
                  if (run%budget%is_spent()) call describe_failure(part%system, part%method, time_used_up, error)
                  if (allocated(error)) return
               end if
               if (run%sampler%films%has_min) call run%sampler%films%look(part%system, part%method%t)
            end associate
         end do
         call whole%move_front()
      end associate
   end subroutine step

   !> Whether a guard of a part at the front ends the run.
   subroutine look_at_guards(run, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      type(error_t), allocatable, intent(out) :: error    !! it does

      integer :: k

      do k = 1, run%whole%n_front
         associate (part => run%whole%parts(run%whole%front(k)))
            if (.not. allocated(part%guards%reason)) cycle
            call describe_failure(part%system, part%method, guard_reached, error, part%guards%reason)
            return
         end associate
      end do
   end subroutine look_at_guards

   !> Whether a condition ends the run within the last step, which then ends there. The mechanism is one part then.
   subroutine look_for_stop(run, plan, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      type(time_plan_t), intent(in) :: plan               !! times
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      integer :: status

      if (run%stop%n == 0) return
      call run%tally%aside%leave()
      associate (part => run%whole%parts(1))
         call run%stop%look(part%system, part%method, run%tally%residual, run%sampler%catalogue, [plan%first_output, plan%every], &
                            status)
         if (run%stop%met > 0) then
            run%sampler%until = run%stop%t
            part%status = advance_step
            if (status == 0 .and. run%stop%t < part%method%t) call cut_step(part%system, part%method, run%stop%t, status)
         end if
         if (status /= 0) call describe_failure(part%system, part%method, advance_failed_evaluation, error)
      end associate
      call run%tally%aside%come_back()
   end subroutine look_for_stop

   !> Handle the events at the ends of the last steps of the parts at the front, and continue from there.
   subroutine handle_events(run, plan, recorder, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to continue

      integer :: k, n

      n = 0
      do k = 1, run%whole%n_front
         if (run%whole%parts(run%whole%front(k))%status /= advance_event) cycle
         n = n + 1
         run%waiting(n) = run%whole%front(k)
      end do
      if (n > 0) call handle_events_of(run, run%waiting(:n), plan, recorder, error)
   end subroutine handle_events

   !> Handle the events of some parts.
   subroutine handle_events_of(run, parts, plan, recorder, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      integer, intent(in) :: parts(:)                     !! (any) parts at the front that have events
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to continue

      integer :: k

      call run%sampler%before_events(run%whole, parts, plan, run%tally%residual, recorder, error)
      do k = 1, size(parts)
         if (allocated(error)) return
         call handle_part_events(run%whole%parts(parts(k)), run%tally, recorder, error)
      end do
      if (allocated(error)) return
      call run%sampler%after_events(run%whole, parts, plan, run%tally%residual, recorder, error)
   end subroutine handle_events_of

   !> Pass the instants at which functions of time are not smooth, of parts at the front that have come to one.
   subroutine pass_output_times(run, plan, recorder, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      type(time_plan_t), intent(in) :: plan               !! times
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to continue

      integer :: k, n

      associate (whole => run%whole)
         n = 0
         do k = 1, whole%n_front
            associate (part => whole%parts(whole%front(k)))
               if (.not. part%output_times%is_at(part%method%t)) cycle
            end associate
            n = n + 1
            run%waiting(n) = whole%front(k)
         end do
         if (n == 0) return
         call run%sampler%before_instant(whole, plan, run%tally%residual, recorder, error)
         do k = 1, n
            if (allocated(error)) return
            call pass_part_instant(whole%parts(run%waiting(k)), run%tally, recorder, error)
         end do
         if (allocated(error)) return
         if (size(whole%parts) > 1) then
            do while (whole%output_times%is_at(whole%t))
               call whole%output_times%pass(whole%system%linkage%segment)
            end do
         end if
         do k = 1, n
            if (whole%parts(run%waiting(k))%method%events%n_happened == 0) cycle
            call handle_events_of(run, run%waiting(k:k), plan, recorder, error)
            if (allocated(error)) return
         end do
         call run%sampler%take(whole, plan, run%tally%residual, recorder, error)
      end associate
   end subroutine pass_output_times

   !> The run ends within contacts: a row for each.
   subroutine close_contacts(run, recorder, error)
      type(run_t), intent(inout) :: run                   !! state of the run
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! there is no memory for it

      type(event_t) :: row
      integer :: p
      logical :: is_open

      do p = 1, size(run%whole%parts)
         do
            call close_open(run%whole%parts(p)%system, run%whole%parts(p)%method, is_open, row)
            if (.not. is_open) exit
            call recorder%event(row, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine close_contacts

end module dynamic
