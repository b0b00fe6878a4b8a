!> When a motion is reported: output instants, instants once per period of the drive, those of contacts, and that at which a
!> condition ends the run.
!>
!> Of a contact: its onset, the moment after it started; its peaks, the maximum normal force so far; its end, the moment before it
!> ended. Where a normal force jumps there are two rows of the same time, the limits from before and from after.
module sampling
   use catalogue, only: catalogue_t
   use channel_peaks, only: channel_peaks_t, tell_between, tell_sample
   use errors, only: error_t
   use film_moments, only: film_moments_t
   use integrator, only: advance_failed_evaluation
   use kinds, only: i8, wp
   use mechanism_catalogue, only: bind_channels, build_catalogue
   use mechanism_report, only: report_evaluated, report_state
   use mechanism, only: mechanism_t
   use recorder, only: n_row_kind, recorder_t, row_end, row_jump, row_onset, row_peak, row_stop
   use run_failure, only: describe_failure
   use sample_stride, only: sample_stride_t
   use stop_condition, only: stop_t
   use archive, only: archive_t
   use time_in_output, only: output_time_t
   use time_plan, only: instant, last_instant, time_plan_t
   use whole_motion, only: whole_motion_t
   implicit none (type, external)
   private
   public :: forget, new_sampler, put_row_here, report, sampler_t

   !> What is reported of a motion, and how far it is.
   type :: sampler_t
      type(catalogue_t), allocatable :: catalogue  !! what is reported
      integer(i8) :: n_sample = 0                !! output instants done
      integer :: n_poincare = 0                    !! stroboscopic instants done
      integer :: n_row(n_row_kind) = 0           !! rows beside those of output instants, by kind
      integer(i8) :: n_reports = 0               !! evaluations made for all these
      type(output_time_t) :: aside                !! CPU time spent
      real(wp) :: until = huge(1.0_wp)           !! no later instant is reported [s]
      type(film_moments_t) :: films              !! films that are asked for
      logical :: follows_steps = .false.         !! ends of steps are looked at for extremes
      type(channel_peaks_t), private :: peaks    !! extremes between rows
      type(sample_stride_t), private :: stride   !! which steps are looked at
      integer(i8), private :: n_last_sample = 0  !! number of the last output instant, from 0
      real(wp) :: due = -huge(1.0_wp)            !! only peaks are to be taken before that; early if it is not known [s]
      real(wp), private :: t_row = -1.0_wp       !! time of the last row [s]
      logical, private :: has_onset = .false.    !! of the events in hand: a contact starts
      logical, private :: has_jump = .false.     !! of the events in hand: a normal force may jump
      real(wp), allocatable, private :: y(:)     !! (n) state that is reported [any]
      real(wp), allocatable, private :: ydot(:)  !! (n) its derivative [any]
   contains
      procedure :: ask => ask_readers
      procedure :: take => take_samples
      procedure :: take_stop
      procedure :: follow_step
      procedure :: before_events
      procedure :: after_events
      procedure :: before_instant
      procedure :: finish => finish_samples
      procedure :: save => save_samples
      procedure :: load => load_samples
   end type sampler_t

   interface
      !> The row that was just reported, and extremes between it and the rows before.
      module subroutine find_extremes(self, whole, t, is_written, residual, recorder)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion, its state that of the row
         real(wp), intent(in) :: t                           !! time of the row [s]
         logical, intent(in) :: is_written                   !! not the end of a step only
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
      end subroutine find_extremes

      !> The end of a step as a row that is not written, and extremes near it. Whether a step is looked at does not depend on rows.
      module subroutine follow_step(self, whole, begins, plan, residual, recorder)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion, after a step and what is due of it
         logical, intent(in) :: begins                       !! after events there: what comes does not continue what was before
         type(time_plan_t), intent(in) :: plan               !! times
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
      end subroutine follow_step

      !> All stroboscopic instants up to the time that all have reached.
      module subroutine take_poincare(self, whole, plan, residual, recorder, error)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion
         type(time_plan_t), intent(in) :: plan               !! times
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there
      end subroutine take_poincare

      !> Films of an instant that all have reached.
      module subroutine take_field(self, whole, t, residual, recorder, error)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion
         real(wp), intent(in) :: t                           !! the instant [s]
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there
      end subroutine take_field
   end interface

   interface
      !> The row before the events at the end of the last steps, where a contact ends or a force may jump.
      module subroutine before_events(self, whole, parts, plan, residual, recorder, error)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion, at the events
         integer, intent(in) :: parts(:)                     !! (any) parts that have some
         type(time_plan_t), intent(in) :: plan               !! times
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      end subroutine before_events

      !> The row before an instant at which functions of time are not smooth, if one is owed. What is due behind it is found anew.
      module subroutine before_instant(self, whole, plan, residual, recorder, error)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion at the instant, functions of time those before it
         type(time_plan_t), intent(in) :: plan               !! times
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      end subroutine before_instant

      !> The row after the events, where a contact started or a force may have jumped.
      module subroutine after_events(self, whole, parts, plan, residual, recorder, error)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self             !! what is reported
         type(whole_motion_t), intent(inout) :: whole        !! the motion, its parts started again
         integer, intent(in) :: parts(:)                     !! (any) parts that had events
         type(time_plan_t), intent(in) :: plan               !! times
         real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
         class(recorder_t), intent(inout) :: recorder        !! keeps the results
         type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      end subroutine after_events
   end interface

   interface
      !> Write how far the reports are.
      module subroutine save_samples(self, archive)
         implicit none (type, external)
         class(sampler_t), intent(in) :: self  !! what is reported
         type(archive_t), intent(inout) :: archive   !! what is remembered
      end subroutine save_samples

      !> Take it back.
      module subroutine load_samples(self, archive)
         implicit none (type, external)
         class(sampler_t), intent(inout) :: self  !! what is reported, at the start
         type(archive_t), intent(inout) :: archive      !! what was remembered
      end subroutine load_samples
   end interface

contains

   !> Storage for the reports of a system.
   subroutine new_sampler(system, plan, sampler, catalogue)
      type(mechanism_t), intent(in) :: system       !! the system
      type(time_plan_t), intent(in) :: plan         !! times
      type(sampler_t), intent(out) :: sampler       !! nothing reported yet
      type(catalogue_t), allocatable, intent(inout), optional :: catalogue  !! what it can report, taken over; none: it is found

      if (present(catalogue)) call move_alloc(catalogue, sampler%catalogue)
      if (.not. allocated(sampler%catalogue)) then
         allocate (sampler%catalogue)
         call build_catalogue(system, sampler%catalogue)
      end if
      allocate (sampler%y(system%n), sampler%ydot(system%n), source=0.0_wp)
      sampler%n_last_sample = last_instant(plan)
      call sampler%aside%begin(0.0_wp)
   end subroutine new_sampler

   !> Learn what is read of a report: nothing else is found.
   subroutine ask_readers(self, whole, recorder, stop)
      class(sampler_t), intent(inout) :: self         !! what is reported
      type(whole_motion_t), intent(inout) :: whole    !! the motion
      class(recorder_t), intent(in) :: recorder       !! keeps the results, started
      type(stop_t), intent(in) :: stop                !! conditions that end the run

      integer :: i, k

      do k = 1, size(self%catalogue%groups)
         self%catalogue%groups(k)%is_wanted = [(recorder%wants(k, i) .or. stop%wants(k, i), &
                                                i=1, size(self%catalogue%groups(k)%is_wanted))]
      end do
      call bind_channels(whole%system, self%catalogue)
      call self%films%begin(whole%system, recorder)
      whole%parts(:)%monitor%tells_all = recorder%wants_contact_rows
      if (.not. allocated(recorder%located%place)) return
      call self%peaks%begin(self%catalogue, recorder%located%place, recorder%located%from, size(self%y))
      call self%stride%begin(whole%system%linkage%n_rate)
      self%follows_steps = size(whole%parts) == 1
   end subroutine ask_readers

   !> All output instants and peaks of contacts up to the time that all parts have reached; an output instant at which functions of
   !> time are not smooth only when the motion has passed it, with the values behind it.
   subroutine take_samples(self, whole, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion, after steps
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or the equations not be solved

      call take_all(self, whole, plan, residual, recorder, error)
      self%due = min(next_instant(self, whole%system, plan), self%films%next())
      if (self%n_poincare < size(plan%poincare_samples)) self%due = min(self%due, plan%poincare_samples(self%n_poincare + 1))
   end subroutine take_samples

   !> What of these is due, if anything is.
   subroutine take_all(self, whole, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion, after steps
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or the equations not be solved

      real(wp) :: reached, t, t_field, t_peak

      reached = min(whole%t, self%until)
      if (self%n_poincare < size(plan%poincare_samples)) then
         if (plan%poincare_samples(self%n_poincare + 1) <= reached) call take_poincare(self, whole, plan, residual, recorder, error)
         if (allocated(error)) return
      end if
      t = next_instant(self, whole%system, plan)
      if (min(t, whole%next_peak(), self%films%next()) > reached) return
      if (t > reached .and. .not. wants_row(recorder, plan, row_peak, reached)) call whole%drop_peaks(reached)  ! without a reader
      call self%aside%leave()
      do
         t_peak = whole%next_peak()
         t_field = self%films%next()
         if (min(t, t_peak, t_field) > reached) exit
         if (t_field <= min(t, t_peak)) then
            call take_field(self, whole, t_field, residual, recorder, error)
         else if (t_peak < t) then
            call put_row(self, whole, plan, t_peak, row_peak, residual, recorder, error, at_peak=.true.)
            call whole%drop_peaks(t_peak)
         else
            call report(self, whole, t, .false., 0.0_wp, residual, error)
            if (.not. allocated(error)) call recorder%sample(t, self%catalogue, error)
            if (allocated(error)) return
            if (allocated(self%peaks%place)) call find_extremes(self, whole, t, .true., residual, recorder)
            self%t_row = t
            self%n_sample = self%n_sample + 1
            t = next_instant(self, whole%system, plan)
         end if
         if (allocated(error)) return
      end do
      if (self%t_row >= whole%t) call whole%note_row()
      call self%aside%come_back()
   end subroutine take_all

   !> The row at which a condition ends the run, unless there is a row at that instant.
   subroutine take_stop(self, whole, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion, after the step in which the run ends
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or the equations not be solved

      if (self%t_row < self%until) call put_row(self, whole, plan, self%until, row_stop, residual, recorder, error)
   end subroutine take_stop

   !> The output instant that comes next; after the last one, and until functions of time take the values behind it, one that is
   !> never reached.
   pure real(wp) function next_instant(self, system, plan) result(t)
      class(sampler_t), intent(in) :: self         !! what is reported
      type(mechanism_t), intent(in) :: system      !! the system
      type(time_plan_t), intent(in) :: plan        !! times

      t = huge(1.0_wp)
      if (self%n_sample <= self%n_last_sample) t = instant(plan, self%n_sample)
      if (t >= system%linkage%segment%end) t = huge(1.0_wp)
   end function next_instant

   !> What comes does not continue what was before.
   pure subroutine forget(self)
      type(sampler_t), intent(inout) :: self   !! what is reported

      call self%peaks%forget()
      call self%stride%forget()
   end subroutine forget

   !> The end of the run: the row of a contact whose maximum force is that of the last instant, and films.
   subroutine finish_samples(self, whole, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion, at the end
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      if (whole%owes_row() .and. self%t_row < whole%t .and. whole%t <= self%until) then
         call put_row(self, whole, plan, whole%t, row_peak, residual, recorder, error)
      end if
      call whole%note_row()
      if (allocated(error) .or. .not. allocated(recorder%wants_fields)) return
      do while (self%films%next() <= min(whole%t, self%until))
         call take_field(self, whole, self%films%next(), residual, recorder, error)
         if (allocated(error)) return
      end do
      call report(self, whole, min(whole%t, self%until), .false., 0.0_wp, residual, error)
      if (.not. allocated(error)) call self%films%tell_rest(whole%system, min(whole%t, self%until), recorder)
   end subroutine finish_samples

   !> A row at the time that all have reached, if it is requested; what it costs is set aside.
   subroutine put_row_here(self, whole, plan, kind, shift, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion
      type(time_plan_t), intent(in) :: plan               !! times
      integer, intent(in) :: kind                         !! of the row
      real(wp), intent(in) :: shift                       !! with the values so much later on [s]
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written

      if (.not. wants_row(recorder, plan, kind, whole%t)) return
      call self%aside%leave()
      call put_row(self, whole, plan, whole%t, kind, residual, recorder, error, shift=shift)
      call self%aside%come_back()
   end subroutine put_row_here

   !> A row beside those of output instants, if it is requested and within what is written.
   subroutine put_row(self, whole, plan, t, kind, residual, recorder, error, at_peak, shift)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: t                           !! time of the row [s]
      integer, intent(in) :: kind                         !! of the row
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written
      logical, intent(in), optional :: at_peak            !! the row is that of peaks
      real(wp), intent(in), optional :: shift             !! with the values so much later on [s]

      logical :: is_peak
      real(wp) :: later

      if (.not. wants_row(recorder, plan, kind, t)) return
      is_peak = .false.
      if (present(at_peak)) is_peak = at_peak
      later = 0.0_wp
      if (present(shift)) later = shift
      call report(self, whole, t, is_peak, later, residual, error)
      if (allocated(error)) return
      call recorder%further_row(t, kind, self%catalogue, error)
      if (allocated(error)) return
      if (allocated(self%peaks%place) .and. later <= 0.0_wp) call find_extremes(self, whole, t, .true., residual, recorder)
      self%t_row = t
      self%n_row(kind) = self%n_row(kind) + 1
   end subroutine put_row

   !> Whether a row beside those of output instants is requested.
   pure logical function wants_row(recorder, plan, kind, t)
      class(recorder_t), intent(in) :: recorder   !! keeps the results
      type(time_plan_t), intent(in) :: plan       !! times
      integer, intent(in) :: kind                 !! of the row
      real(wp), intent(in) :: t                   !! its time [s]

      wants_row = t >= plan%first_output .and. (recorder%wants_contact_rows .or. kind == row_stop)
   end function wants_row

   !> Fill the catalogue with the values at a time that the last steps hold.
   subroutine report(self, whole, t, at_peak, shift, residual, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(whole_motion_t), intent(inout) :: whole        !! the motion
      real(wp), intent(in) :: t                           !! the time [s]
      logical, intent(in) :: at_peak                      !! it is that of peaks
      real(wp), intent(in) :: shift                       !! with the values so much later on [s]
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      integer :: status

      whole%system%traits%with_quadratures = self%catalogue%readings%energy%n > 0
      if (.not. at_peak .and. .not. shift > 0.0_wp .and. whole%is_evaluated(t)) then
         self%y = whole%parts(1)%method%step%y1
         self%ydot = whole%parts(1)%method%step%f1
         call report_evaluated(whole%system, t, self%y, self%ydot, residual, self%catalogue)
         status = 0
      else
         call whole%state_at(t, at_peak, shift, self%y)
         self%n_reports = self%n_reports + 1
         call report_state(whole%system, t + shift, self%y, self%ydot, residual, self%catalogue, status)
      end if
      whole%system%traits%with_quadratures = .true.
      if (status == 0 .and. self%films%has_min) call self%films%look(whole%system, t + shift)
      if (status /= 0) call describe_failure(whole%parts(whole%front(1))%system, whole%parts(whole%front(1))%method, &
                                             advance_failed_evaluation, error)
   end subroutine report

end module sampling
