!> The whole of a mechanism, or a group of its bodies that nothing joins to the others, in motion: one step, and what follows it.
!>
!> A step ends at the latest at an instant at which functions of time are not smooth, and at an event. What happens there is
!> handled by `handle_part_events` and `pass_part_instant`, when the other parts have come as far.
module moving_part
   use contact_places, only: touch_function
   use contact_monitor, only: contact_monitor_t, new_contact_monitor
   use errors, only: error_t
   use film_end, only: film_that_ended
   use guards, only: guards_t
   use output_times, only: output_times_t
   use integrator, only: advance_failed_evaluation, integrator_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use mechanism_energy, only: energy_of, energy_t
   use ode_system, only: contact_onset
   use recorder, only: event_t, recorder_t
   use run_failure, only: constraints_lost, describe_failure, events_without_end, film_ended, off_branch
   use run_tally, only: run_tally_t
   use slip_monitor, only: find_change, find_reversal, note_jumps, sliding_way
   use step_follower, only: find_off_branch, follow_motion, has_branches, must_follow
   use velocity_jumps, only: velocity_jumps_t
   implicit none (type, external)
   private
   public :: advance_part, begin_part, handle_part_events, make_step, moving_part_t, new_part, pass_part_instant, see_step

   integer, parameter :: most_idle = 1000          !! events that may follow one another while hardly any time passes
   integer, parameter :: idle_each = 10            !! and so many more for each event function
   real(wp), parameter :: idle = 1.0e-12_wp        !! hardly any time: part of the present time [1]
   real(wp), parameter :: lost_length = 0.1_wp     !! violation beyond all measure: a length, of the size of the bodies [1]
   real(wp), parameter :: lost_angle = 1.0_wp      !! an angle [rad]

   !> Energies of a part.
   type :: part_ledger_t
      real(wp) :: balance_0 = 0.0_wp      !! balance of the ledger at the start [J]
      real(wp) :: potential_0 = 0.0_wp    !! potential energy at the start [J]
      real(wp) :: residual = 0.0_wp       !! of the ledger at the last step [J]
      real(wp) :: level = 0.0_wp          !! kinetic + elastic energy + |change of potential| there [J]
      real(wp) :: magnitude = 0.0_wp      !! of what the ledger adds up there [J]
      real(wp) :: lost = 0.0_wp           !! what its contacts have lost by then [J]
   end type part_ledger_t

   !> The maximum violation of the constraints of a part.
   type :: violation_t
      real(wp) :: worst = 0.0_wp          !! so far, over the size of the bodies or a radian [1]
      integer :: row = 0                  !! the row it belongs to
      logical :: is_lost = .false.        !! whether one is beyond all measure
   end type violation_t

   !> A part in motion.
   type :: moving_part_t
      type(mechanism_t), pointer :: system => null()       !! its equations
      class(integrator_t), pointer :: method => null()     !! its integrator
      type(contact_monitor_t) :: monitor                       !! its contacts
      type(guards_t) :: guards                             !! what no mechanism does
      type(output_times_t) :: output_times                         !! when its functions of time are not smooth
      type(velocity_jumps_t) :: jumps                      !! drivers whose velocity jumps there
      logical :: must_follow = .false.                     !! something continues from step to step, see `step_follower`
      logical :: has_branches = .false.                    !! joints may reach an unintended branch, see there
      integer :: status = 0                                !! how its last step ended; an event, until it is handled
      integer :: n_idle = 0                                !! events since the last time that time passed
      real(wp) :: t_event = 0.0_wp                         !! time of the last event [s]
      type(part_ledger_t) :: ledger                        !! its energies
      type(violation_t) :: violation                       !! of its constraints
      integer(i8) :: n_evaluations = -1                    !! of its system when it was evaluated at the end of its last step
   end type moving_part_t

contains

   !> A part that has not started.
   subroutine new_part(system, method, output_times, guards, part)
      type(mechanism_t), intent(inout), target :: system      !! its equations
      class(integrator_t), intent(inout), target :: method    !! its integrator
      type(output_times_t), intent(in) :: output_times                !! when its functions of time are not smooth
      type(guards_t), intent(in) :: guards                    !! what no mechanism does
      type(moving_part_t), intent(out) :: part                !! the part; points at system and integrator

      part%system => system
      part%method => method
      part%output_times = output_times
      part%guards = guards
      part%must_follow = must_follow(system)
      part%has_branches = has_branches(system)
      call new_contact_monitor(system, part%monitor)
   end subroutine new_part

   !> Start at a state at t = 0.
   subroutine begin_part(part, y, end, tally, recorder, error)
      type(moving_part_t), intent(inout) :: part          !! the part, new
      real(wp), intent(in) :: y(:)                        !! (n) state at t = 0 [any]
      real(wp), intent(in) :: end                         !! end of the motion [s]
      type(run_tally_t), intent(inout) :: tally           !! of the run
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! it cannot start

      type(energy_t) :: energy
      integer :: status

      associate (system => part%system, method => part%method)
         call part%output_times%begin(end, system%linkage%segment)
         call system%begin_pace(0.0_wp, y, end)
         call system%linkage%set_motion(0.0_wp, y)
         call decide_slips(part, 0.0_wp, y, .true., recorder, error)
         if (allocated(error)) return
         call method%start(system, 0.0_wp, y, end, status)
         if (status /= 0) then
            call describe_failure(system, method, status, error)
            return
         end if
         call part%guards%begin(system)
         call system%scale_quadratures(0.0_wp)
         energy = energy_of(system, y)
         part%ledger%balance_0 = energy%balance()
         part%ledger%potential_0 = energy%potential
         call look_at_step(part, tally)
         if (system%ledger%is_kept) call look_at_energy(part, tally)
         if (system%clearance_joints%n > 0) call part%monitor%after_restart(system, method)
      end associate
   end subroutine begin_part

   !> One step, and what is seen at its end.
   subroutine advance_part(part, tally, error, until)
      type(moving_part_t), intent(inout) :: part          !! the part
      type(run_tally_t), intent(inout) :: tally           !! of the run
      type(error_t), allocatable, intent(out) :: error    !! the integration failed
      real(wp), intent(in), optional :: until             !! a time that the step must not pass [s]

      call make_step(part, error, until)
      if (.not. allocated(error)) call see_step(part, tally, error)
   end subroutine advance_part

   !> One step.
   subroutine make_step(part, error, until)
      type(moving_part_t), intent(inout) :: part          !! the part
      type(error_t), allocatable, intent(out) :: error    !! the integration failed
      real(wp), intent(in), optional :: until             !! a time that the step must not pass [s]

      real(wp) :: t_stop

      associate (system => part%system, method => part%method)
         call part%output_times%stop_after(method, t_stop)
         if (present(until)) t_stop = min(t_stop, until)
         call method%advance(system, t_stop, part%status)
         if (part%status < 0) then
            call describe_failure(system, method, part%status, error)
            return
         end if
         if (part%must_follow) then
            call system%linkage%set_motion(method%t, method%step%y1)
            call follow_motion(system)
         end if
      end associate
   end subroutine make_step

   !> What is seen at the end of a step; the system is there.
   subroutine see_step(part, tally, error)
      type(moving_part_t), intent(inout) :: part          !! the part
      type(run_tally_t), intent(inout) :: tally           !! of the run
      type(error_t), allocatable, intent(out) :: error    !! the constraints are lost, or a branch

      character(:), allocatable :: words

      associate (system => part%system, method => part%method)
         part%n_evaluations = system%n_evaluations
         call look_at_step(part, tally)
         if (part%violation%is_lost) then
            call describe_failure(system, method, constraints_lost, error)
            return
         end if
         if (part%has_branches) then
            call find_off_branch(system, words)
            if (allocated(words)) then
               call describe_failure(system, method, off_branch, error, words)
               return
            end if
         end if
         if (system%clearance_joints%n > 0) call part%monitor%after_step(system, method)
         if (system%ledger%is_kept) call look_at_energy(part, tally)
         call part%guards%look(system, method%t)
      end associate
   end subroutine see_step

   !> Handle the events at the end of the last step, and continue from there.
   subroutine handle_part_events(part, tally, recorder, error)
      type(moving_part_t), intent(inout) :: part          !! the part
      type(run_tally_t), intent(inout) :: tally           !! of the run
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to continue

      type(event_t) :: row
      character(:), allocatable :: ended
      real(wp) :: hint, step_hint
      real(wp) :: ways(3, part%method%events%n_happened)  ! of sliding before the events [1]
      integer :: k, status
      logical :: is_over

      associate (system => part%system, method => part%method)
         part%status = 0
         part%n_idle = merge(part%n_idle + 1, 0, method%t - part%t_event <= idle*method%t)
         part%t_event = method%t
         if (part%n_idle > most_idle + idle_each*system%n_event) then
            call describe_failure(system, method, events_without_end, error)
            return
         end if
         if (system%clearance_joints%has_films) then
            ended = film_that_ended(system, method)
            if (ended /= "") then
               call describe_failure(system, method, film_ended, error, ended)
               return
            end if
         end if
         step_hint = 0.0_wp
         system%traits%contact_begins = .false.
         do k = 1, method%events%n_happened
            if (system%contact_change(method%events%happened(k)) == contact_onset) system%traits%contact_begins = .true.
            ways(:, k) = sliding_way(system, method%events%happened(k))
         end do
         do k = 1, method%events%n_happened
            call part%monitor%handle_event(system, method, method%events%happened(k), is_over, row, hint)
            call part%guards%look_at_made(part%monitor%made, tally%energy_max)
            if (hint > 0.0_wp) step_hint = merge(hint, min(hint, step_hint), step_hint <= 0.0_wp)
            tally%events = tally%events + 1
            if (is_over) then
               call tally%aside%leave()
               call recorder%event(row, error)
               if (allocated(error)) return
               call tally%aside%come_back()
            else if (system%clearance_joints%functions%kind_of(method%events%happened(k)) == touch_function) then
               tally%contacts = tally%contacts + 1
            end if
         end do
         call decide_slips(part, method%t, method%step%y1, .false., recorder, error)
         if (.not. allocated(error)) call tell_reversals(part, ways, recorder, error)
         if (allocated(error)) return
         call method%restart(system, step_hint, status)
         if (status /= 0) then
            call describe_failure(system, method, status, error)
            return
         end if
         call part%output_times%note_turning(system)
         call part%monitor%after_restart(system, method)
      end associate
   end subroutine handle_part_events

   !> Pass an instant at which functions of time are not smooth. Events that this brings about wait in `method%events%happened`.
   subroutine pass_part_instant(part, tally, recorder, error)
      type(moving_part_t), intent(inout) :: part          !! the part, at the instant
      type(run_tally_t), intent(inout) :: tally           !! of the run
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or no way to continue

      real(wp), allocatable :: before(:)
      integer :: status

      associate (system => part%system, method => part%method)
         method%events%g = method%events%g1
         before = method%step%f1
         call part%jumps%before_instant(system, method)
         call part%output_times%pass(system%linkage%segment)
         call part%jumps%after_instant(system, method, status)
         if (status /= 0) then
            call describe_failure(system, method, advance_failed_evaluation, error)
            return
         end if
         call system%sample_states(method%t, method%step%y1, error)
         if (allocated(error)) return
         call decide_slips(part, method%t, method%step%y1, .true., recorder, error)
         if (allocated(error)) return
         call method%restart(system, 0.0_wp, status)
         if (status /= 0) then
            call describe_failure(system, method, status, error)
            return
         end if
         call system%follow_pace(method%step%y1, method%step%f1 - before)
         call look_at_step(part, tally)  ! a jump of a driver is seen here, before the stabilisation acts
         if (system%ledger%is_kept) call look_at_energy(part, tally)
         if (part%violation%is_lost) then
            call describe_failure(system, method, constraints_lost, error)
            return
         end if
         part%monitor%shift = 0.0_wp  ! no contact started here
         call part%monitor%after_restart(system, method)
         call note_jumps(system, method)
      end associate
   end subroutine pass_part_instant

   !> Pace, turning and constraint violation at the end of a step.
   subroutine look_at_step(part, tally)
      type(moving_part_t), intent(inout) :: part   !! the part, its system last evaluated at the end of the step
      type(run_tally_t), intent(inout) :: tally    !! maxima are raised

      associate (linkage => part%system%linkage)
         call part%system%follow_pace(part%method%step%y1)
         if (.not. part%system%ledger%is_kept) call part%system%scale_quadratures(0.0_wp)  ! impulses; else with the energy
         call part%output_times%note_turning(part%system)
         if (linkage%rows%n_solve > 0) call look_at_rows(part, tally)
      end associate
   end subroutine look_at_step

   !> Constraint violation at the end of a step.
   subroutine look_at_rows(part, tally)
      type(moving_part_t), intent(inout) :: part   !! the part, its system last evaluated at the end of the step
      type(run_tally_t), intent(inout) :: tally    !! maxima are raised

      real(wp) :: scaled
      integer :: k

      associate (linkage => part%system%linkage)
         do k = 1, linkage%rows%n_solve
            scaled = linkage%solution%row_weight(k)*abs(linkage%rows%phi(k))
            part%violation%is_lost = part%violation%is_lost .or. scaled > merge(lost_angle, lost_length, linkage%rows%is_angle(k))
            if (scaled > part%violation%worst) then
               part%violation%worst = scaled
               part%violation%row = k
            end if
            tally%violation_max = max(tally%violation_max, abs(linkage%rows%phi(k)))
            tally%violation_rate_max = max(tally%violation_rate_max, abs(linkage%solution%phi_dot(k)))
         end do
      end associate
   end subroutine look_at_rows

   !> Energy balance at the end of a step, after `monitor` has looked at it. The ledger is kept.
   subroutine look_at_energy(part, tally)
      type(moving_part_t), intent(inout) :: part   !! the part, its motion that of the end of the step
      type(run_tally_t), intent(inout) :: tally    !! sums follow, maxima are raised

      type(energy_t) :: energy

      energy = energy_of(part%system, part%method%step%y1)
      call follow(energy%balance() - part%ledger%balance_0, part%ledger%residual, tally%residual)
      call follow(energy%dissipated_contact, part%ledger%lost, tally%lost)
      call follow(energy%kinetic + energy%elastic + abs(energy%potential - part%ledger%potential_0), part%ledger%level, tally%level)
      call follow(energy%magnitude(), part%ledger%magnitude, tally%magnitude)
      tally%min_lost = min(tally%min_lost, tally%lost)
      tally%residual_max = max(tally%residual_max, abs(tally%residual))
      tally%energy_max = max(tally%energy_max, tally%level)
      call part%system%scale_quadratures(max(part%ledger%level, energy%largest_work()))
      call part%guards%look_at_energy(tally%residual, tally%energy_max, tally%magnitude)

   contains

      !> A number of the part takes a new value, and the sum over all parts with it.
      pure subroutine follow(new, value, total)
         real(wp), intent(in) :: new         !! the new value [J]
         real(wp), intent(inout) :: value    !! that of the part [J]
         real(wp), intent(inout) :: total    !! the sum [J]

         real(wp) :: others   ! the sum over the other parts [J]

         others = total - value
         if (.not. abs(others) > 0.0_wp) others = 0.0_wp  ! none, or energies without bound
         total = others + new
         value = new
      end subroutine follow

   end subroutine look_at_energy

   !> Decide which contacts slip or stick, and report of those that start to.
   subroutine decide_slips(part, t, y, only_new, recorder, error)
      type(moving_part_t), intent(inout) :: part          !! the part, its motion that of the state
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: y(:)                        !! (n) state [any]
      logical, intent(in) :: only_new                     !! only where a contact has started
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      type(event_t) :: row
      integer :: k, slot
      logical :: has_row

      if (part%system%friction%stick_slips%n_slip == 0) return
      call part%system%decide_slips(t, y, only_new)
      do slot = 1, size(part%system%clearance_joints%sets)
         do k = 1, part%system%clearance_joints%sets(slot)%set%n_contact
            call find_change(part%system, t, slot, k, has_row, row)
            if (has_row) call recorder%event(row, error)
            if (allocated(error)) return
         end do
      end do
   end subroutine decide_slips

   !> Report of contacts that slide the other way behind the events of the last step.
   subroutine tell_reversals(part, ways, recorder, error)
      type(moving_part_t), intent(in) :: part             !! the part, all its contacts decided
      real(wp), intent(in) :: ways(:, :)                  !! (3, events) where they slid to before [1]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      type(event_t) :: row
      integer :: k
      logical :: has_row

      do k = 1, size(ways, 2)
         call find_reversal(part%system, part%method%t, part%method%events%happened(k), ways(:, k), has_row, row)
         if (has_row) call recorder%event(row, error)
         if (allocated(error)) return
      end do
   end subroutine tell_reversals

end module moving_part
