!> All that a motion must remember to continue: of each part the integrator's memory, the system's, what is monitored of the
!> contacts, where ledger and events stand; of the whole what is reported, sums and what guards and drivers' jumps have noted.
!>
!> A part that takes it back is, with a one-step method, equal bit for bit to the one that was not interrupted. What was saved by
!> another method, another mechanism or another form is refused by name, and nothing is changed.
!> Limits: several parts must have come to the same time, since nothing is kept of the way within their last steps.
module run_memory
   use archive, only: archive_t
   use errors, only: error_t, exit_usage, set_error
   use kinds, only: wp
   use moving_part, only: moving_part_t
   use run_failure, only: describe_failure
   use run_tally, only: run_tally_t
   use sampling, only: sampler_t
   use saved_run, only: saved_run_t
   use smooth_segment, only: smooth_segment_t
   use stop_condition, only: stop_t
   use text, only: to_text
   use whole_motion, only: whole_motion_t
   implicit none (type, external)
   private
   public :: load_part_memory, load_run, save_part_memory, save_run

   integer, parameter :: monitor_version = 2   !! of the form of what is kept of contacts from step to step
   integer, parameter :: part_version = 1    !! of the form of where ledger and events stand

contains

   !> Save a run all of whose parts have come to the same time.
   subroutine save_run(whole, sampler, tally, stop, cpu, saved)
      type(whole_motion_t), intent(in) :: whole     !! the motion, between two steps
      type(sampler_t), intent(in) :: sampler        !! what is reported
      type(run_tally_t), intent(in) :: tally        !! sums and maxima
      type(stop_t), intent(in) :: stop              !! conditions that would end the run
      real(wp), intent(in) :: cpu                   !! processor time used so far [s]
      type(saved_run_t), intent(out) :: saved       !! what is remembered

      integer :: p

      associate (n => size(whole%parts), archive => saved%motion)
         saved%t = whole%t
         allocate (saved%parts(merge(n + 1, n, n > 1)))
         do p = 1, n
            call save_part_memory(whole%parts(p), saved%parts(p))
            call whole%parts(p)%guards%save(archive)
            call whole%parts(p)%jumps%save(archive)
         end do
         if (n > 1) call whole%system%save(saved%parts(n + 1))
         call archive%put([whole%t, cpu])
         call sampler%save(archive)
         call tally%save(archive)
         call stop%save(archive)
      end associate
   end subroutine save_run

   !> Take it back into a run of the same deck that has started.
   subroutine load_run(saved, whole, sampler, tally, stop, cpu, error)
      type(saved_run_t), intent(inout) :: saved            !! what was remembered
      type(whole_motion_t), intent(inout) :: whole         !! the motion, started
      type(sampler_t), intent(inout) :: sampler            !! what is reported
      type(run_tally_t), intent(inout) :: tally            !! sums and maxima
      type(stop_t), intent(inout) :: stop                  !! conditions that end the run, looked at at the start
      real(wp), intent(out) :: cpu                         !! processor time used by then [s]
      type(error_t), allocatable, intent(out) :: error     !! it is another run's

      type(archive_t) :: written
      type(smooth_segment_t) :: passed
      integer :: p

      cpu = 0.0_wp
      associate (n => size(whole%parts), archive => saved%motion)
         if (size(saved%parts) /= merge(n + 1, n, n > 1)) then
            call set_error(error, exit_usage, "the checkpoint does not belong to this run: it has "// &
                           to_text(size(saved%parts))//" parts, expected "//to_text(merge(n + 1, n, n > 1))//"")
            return
         end if
         do p = 1, n
            call load_part_memory(saved%parts(p), whole%parts(p), error)
            if (allocated(error)) return
            call whole%parts(p)%guards%load(archive)
            call whole%parts(p)%jumps%load(archive)
         end do
         if (n > 1) then
            call whole%system%save(written)
            call saved%parts(n + 1)%compare(written, error)
            if (allocated(error)) return
            call whole%system%load(saved%parts(n + 1))
            do while (whole%output_times%next%at < whole%system%linkage%segment%end)
               call whole%output_times%pass(passed)
            end do
         end if
         call archive%get(whole%t)
         call archive%get(cpu)
         call sampler%load(archive)
         call tally%load(archive)
         call stop%load(archive)
         if (archive%is_at_end()) return
      end associate
      call set_error(error, exit_usage, "the checkpoint does not belong to this run: its samples and sums have "// &
                     "another length")
   end subroutine load_run

   !> Save it.
   subroutine save_part_memory(part, archive)
      type(moving_part_t), intent(in) :: part      !! the part, between two steps
      type(archive_t), intent(out) :: archive      !! what is remembered

      call part%method%save(archive)
      call part%system%save(archive)
      call archive%begin("the contacts from step to step", monitor_version)
      call part%monitor%save(archive)
      call archive%begin("where ledger and events stand", part_version)
      call archive%put(part%n_idle)
      associate (ledger => part%ledger)
         call archive%put([part%t_event, ledger%balance_0, ledger%potential_0, ledger%residual, ledger%level, ledger%magnitude, &
                           ledger%lost, part%violation%worst])
      end associate
      call archive%put(part%violation%row)
   end subroutine save_part_memory

   !> Take it back into a part of a run of the same deck that has started; the search for instants is brought to where the motion
   !> is.
   subroutine load_part_memory(archive, part, error)
      type(archive_t), intent(inout) :: archive            !! what was remembered
      type(moving_part_t), intent(inout) :: part           !! the part, started
      type(error_t), allocatable, intent(out) :: error     !! it is another run's; nothing is changed

      type(archive_t) :: written
      type(smooth_segment_t) :: segment
      integer :: status

      call save_part_memory(part, written)
      call archive%compare(written, error)
      if (allocated(error)) return
      archive%place = 0
      call part%method%load(archive)
      call part%system%load(archive)
      call part%monitor%load(archive)
      call archive%get(part%n_idle)
      call archive%get(part%t_event)
      associate (ledger => part%ledger)
         call archive%get(ledger%balance_0)
         call archive%get(ledger%potential_0)
         call archive%get(ledger%residual)
         call archive%get(ledger%level)
         call archive%get(ledger%magnitude)
         call archive%get(ledger%lost)
      end associate
      call archive%get(part%violation%worst)
      call archive%get(part%violation%row)
      do while (part%output_times%next%at < part%system%linkage%segment%end)
         call part%output_times%pass(segment)
      end do
      call part%system%linkage%set_motion(part%method%t, part%method%step%y1)
      call part%output_times%note_turning(part%system)
      if (.not. part%method%begins_anew()) return
      call part%method%restart(part%system, 0.0_wp, status)  ! what the last evaluation leaves behind is that of this state
      if (status /= 0) call describe_failure(part%system, part%method, status, error)
   end subroutine load_part_memory

end module run_memory
