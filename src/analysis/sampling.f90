!> When a motion is reported: output instants, instants once per period of the drive, those of contacts, and that at which a
!> condition ends the run.
!>
!> Of a contact: its onset, the moment after it began; its peaks, the greatest normal force so far; its end, the moment before it
!> ended. Where a normal force jumps there are two rows of the same time, the limits from before and from after.
module sampling
   use catalogue, only: catalogue_t
   use contact_watch, only: contact_watch_t
   use errors, only: error_t
   use integrator, only: advance_failed_evaluation, integrator_t
   use kinds, only: i8, wp
   use mechanism_report, only: build_catalogue, report_state
   use mechanism, only: mechanism_t
   use recorder, only: n_row_kind, recorder_t, row_end, row_jump, row_onset, row_peak, row_stop
   use run_failure, only: describe_failure
   use time_plan, only: instant, last_instant, time_plan_t
   implicit none (type, external)
   private
   public :: new_sampler, sampler_t

   !> What is reported of a motion, and how far it is.
   type :: sampler_t
      type(catalogue_t) :: catalogue             !! what is reported
      integer(i8) :: n_sample = 0                !! output instants done
      integer :: n_strobe = 0                    !! stroboscopic instants done
      integer :: n_row(n_row_kind) = 0           !! rows beside those of output instants, by kind
      integer(i8) :: n_reports = 0               !! evaluations made for all these
      real(wp) :: aside = 0.0_wp                 !! CPU time spent [s]
      real(wp) :: until = huge(1.0_wp)           !! no later instant is reported [s]
      integer(i8), private :: n_last_sample = 0  !! number of the last output instant, from 0
      real(wp), private :: t_row = -1.0_wp       !! time of the last row [s]
      logical, private :: has_onset = .false.    !! of the events in hand: a contact begins
      logical, private :: has_jump = .false.     !! of the events in hand: a normal force may jump
      real(wp), allocatable, private :: y(:)     !! (n) state that is reported [any]
      real(wp), allocatable, private :: ydot(:)  !! (n) its derivative [any]
   contains
      procedure :: take => take_samples
      procedure :: take_stop
      procedure :: before_events
      procedure :: after_events
      procedure :: before_instant
      procedure :: finish => finish_samples
   end type sampler_t

contains

   !> Room for the reports of a system.
   subroutine new_sampler(system, plan, sampler)
      type(mechanism_t), intent(in) :: system   !! the system
      type(time_plan_t), intent(in) :: plan         !! times
      type(sampler_t), intent(out) :: sampler       !! nothing reported yet

      call build_catalogue(system, sampler%catalogue)
      allocate (sampler%y(system%n), sampler%ydot(system%n), source=0.0_wp)
      sampler%n_last_sample = last_instant(plan)
   end subroutine new_sampler

   !> All output instants and peaks of contacts up to the end of the last step; an output instant at which functions of time are
   !> not smooth only when the motion has passed it, with the values behind it.
   subroutine take_samples(self, system, method, plan, watch, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      type(contact_watch_t), intent(inout) :: watch       !! contacts, after the step
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or the equations not be solved

      real(wp) :: cpu_0, cpu_1, reached, t, t_peak
      integer :: k, status

      reached = min(method%t, self%until)
      if (self%n_strobe < size(plan%strobes)) then
         if (plan%strobes(self%n_strobe + 1) <= reached) call take_strobes(self, system, method, plan, residual, recorder, error)
         if (allocated(error)) return
      end if
      t = next_instant(self, system, plan)
      if (t > reached .and. watch%n_peak == 0) return
      call cpu_time(cpu_0)
      if (t < method%t) call method%prepare_output(system, status)
      k = 1
      do
         t_peak = huge(1.0_wp)
         if (k <= watch%n_peak) t_peak = watch%peaks(k)%t
         if (min(t, t_peak) > reached) exit
         if (t_peak < t) then
            call put_row(self, system, method, plan, t_peak, watch%peaks(k)%y, row_peak, residual, recorder, error)
            k = k + 1
         else
            call method%state_at(system, t, self%y)
            call report(self, system, method, t, self%y, residual, error)
            if (.not. allocated(error)) call recorder%sample(t, self%catalogue, error)
            if (allocated(error)) return
            self%t_row = t
            self%n_sample = self%n_sample + 1
            t = next_instant(self, system, plan)
         end if
         if (allocated(error)) return
      end do
      watch%n_peak = 0
      if (self%t_row >= method%t) call watch%note_row()
      call cpu_time(cpu_1)
      self%aside = self%aside + (cpu_1 - cpu_0)
   end subroutine take_samples

   !> The row at which a condition ends the run, unless there is a row at that instant.
   subroutine take_stop(self, system, method, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator, after the step in which the run ends
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or the equations not be solved

      integer :: status

      if (self%t_row >= self%until) return
      if (self%until < method%t) call method%prepare_output(system, status)
      call method%state_at(system, self%until, self%y)
      call put_row(self, system, method, plan, self%until, self%y, row_stop, residual, recorder, error)
   end subroutine take_stop

   !> The output instant that comes next; after the last one, and until functions of time take the values behind it, one that is
   !> never reached.
   pure real(wp) function next_instant(self, system, plan) result(t)
      class(sampler_t), intent(in) :: self         !! what is reported
      type(mechanism_t), intent(in) :: system  !! the system
      type(time_plan_t), intent(in) :: plan        !! times

      t = huge(1.0_wp)
      if (self%n_sample <= self%n_last_sample) t = instant(plan, self%n_sample)
      if (t >= system%linkage%piece%end) t = huge(1.0_wp)
   end function next_instant

   !> The row before the events at the end of the last step, where a contact ends or a force may jump.
   subroutine before_events(self, system, method, plan, watch, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(in) :: method           !! the integrator, at the events
      type(time_plan_t), intent(in) :: plan               !! times
      type(contact_watch_t), intent(inout) :: watch       !! contacts
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      integer :: kind
      logical :: has_end

      call watch%foresee(system, method, has_end, self%has_onset, self%has_jump)
      if (.not. (has_end .or. self%has_jump)) return
      kind = merge(row_peak, row_jump, any(watch%owes_row))
      if (has_end) kind = row_end
      if (self%t_row < method%t) call put_row_here(self, system, method, plan, kind, residual, recorder, error)
      call watch%note_row()
   end subroutine before_events

   !> The row before an instant at which functions of time are not smooth, if one is owed: the force may jump there.
   subroutine before_instant(self, system, method, plan, watch, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system, its functions of time those before the instant
      class(integrator_t), intent(in) :: method           !! the integrator, at the instant
      type(time_plan_t), intent(in) :: plan               !! times
      type(contact_watch_t), intent(inout) :: watch       !! contacts
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      if (.not. any(watch%owes_row) .or. self%t_row >= method%t) return
      call put_row_here(self, system, method, plan, row_peak, residual, recorder, error)
      call watch%note_row()
   end subroutine before_instant

   !> The row after the events, where a contact began or a force may have jumped.
   subroutine after_events(self, system, method, plan, watch, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(in) :: method           !! the integrator, begun again
      type(time_plan_t), intent(in) :: plan               !! times
      type(contact_watch_t), intent(inout) :: watch       !! contacts
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      if (.not. (self%has_onset .or. self%has_jump)) return
      call put_row_here(self, system, method, plan, merge(row_onset, row_jump, self%has_onset), residual, recorder, error, &
                        shift=watch%shift)
      call watch%note_row()
   end subroutine after_events

   !> The end of the run: the row of a contact whose greatest force is that of the last instant.
   subroutine finish_samples(self, system, method, plan, watch, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(in) :: method           !! the integrator, at the end
      type(time_plan_t), intent(in) :: plan               !! times
      type(contact_watch_t), intent(inout) :: watch       !! contacts
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      if (any(watch%owes_row) .and. self%t_row < method%t .and. method%t <= self%until) then
         call put_row(self, system, method, plan, method%t, method%step%y1, row_peak, residual, recorder, error)
      end if
      call watch%note_row()
   end subroutine finish_samples

   !> A row at the end of the last step, if it is wanted; what it costs is set aside.
   subroutine put_row_here(self, system, method, plan, kind, residual, recorder, error, shift)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(in) :: method           !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      integer, intent(in) :: kind                         !! of the row
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      real(wp), intent(in), optional :: shift             !! with the values so much later on [s]

      real(wp) :: cpu_0, cpu_1

      call cpu_time(cpu_0)
      if (present(shift)) then
         call put_row(self, system, method, plan, method%t, method%step%y1 + shift*method%step%f1, kind, residual, recorder, &
                      error, shift)
      else
         call put_row(self, system, method, plan, method%t, method%step%y1, kind, residual, recorder, error)
      end if
      call cpu_time(cpu_1)
      self%aside = self%aside + (cpu_1 - cpu_0)
   end subroutine put_row_here

   !> A row beside those of output instants, if it is wanted and within what is written.
   subroutine put_row(self, system, method, plan, t, y, kind, residual, recorder, error, shift)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(in) :: method           !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: t                           !! time of the row [s]
      real(wp), intent(in) :: y(:)                        !! (n) state there [any]
      integer, intent(in) :: kind                         !! of the row
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      real(wp), intent(in), optional :: shift             !! the state is that of so much later [s]

      real(wp) :: later

      if (t < plan%first_output .or. .not. (recorder%wants_contact_rows .or. kind == row_stop)) return
      later = 0.0_wp
      if (present(shift)) later = shift
      call report(self, system, method, t + later, y, residual, error)
      if (allocated(error)) return
      call recorder%further_row(t, kind, self%catalogue, error)
      if (allocated(error)) return
      self%t_row = t
      self%n_row(kind) = self%n_row(kind) + 1
   end subroutine put_row

   !> All stroboscopic instants up to the end of the last step.
   subroutine take_strobes(self, system, method, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      real(wp) :: cpu_0, cpu_1, reached, t
      integer :: status

      reached = min(method%t, self%until)
      call cpu_time(cpu_0)
      if (plan%strobes(self%n_strobe + 1) < method%t) call method%prepare_output(system, status)
      do while (self%n_strobe < size(plan%strobes))
         t = plan%strobes(self%n_strobe + 1)
         if (t > reached .or. t >= system%linkage%piece%end) exit
         call method%state_at(system, t, self%y)
         call report(self, system, method, t, self%y, residual, error)
         if (allocated(error)) return
         call recorder%strobe(t, self%catalogue)
         self%n_strobe = self%n_strobe + 1
      end do
      call cpu_time(cpu_1)
      self%aside = self%aside + (cpu_1 - cpu_0)
   end subroutine take_strobes

   !> Fill the catalogue with the values at a state.
   subroutine report(self, system, method, t, y, residual, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(mechanism_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(in) :: method           !! the integrator
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in), contiguous :: y(:)            !! (n) state [any]
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      integer :: status

      self%n_reports = self%n_reports + 1
      call report_state(system, t, y, self%ydot, residual, self%catalogue, status)
      if (status /= 0) call describe_failure(system, method, advance_failed_evaluation, error)
   end subroutine report

end module sampling
