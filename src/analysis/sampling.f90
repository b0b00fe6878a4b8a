!> When a motion is reported: output instants, and instants once per period of the drive.
module sampling
   use catalogue, only: catalogue_t
   use errors, only: error_t
   use integrator, only: advance_failed_evaluation, integrator_t
   use kinds, only: i8, wp
   use planar_report, only: build_catalogue, report_state
   use planar_system, only: planar_system_t
   use recorder, only: recorder_t
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
      real(wp) :: aside = 0.0_wp                 !! CPU time spent [s]
      integer(i8), private :: n_last_sample = 0  !! number of the last output instant, from 0
      real(wp), allocatable, private :: y(:)     !! (n) state that is reported [any]
      real(wp), allocatable, private :: ydot(:)  !! (n) its derivative [any]
   contains
      procedure :: take => take_samples
      procedure, private :: report
   end type sampler_t

contains

   !> Room for the reports of a system.
   subroutine new_sampler(system, plan, sampler)
      type(planar_system_t), intent(in) :: system   !! the system
      type(time_plan_t), intent(in) :: plan         !! times
      type(sampler_t), intent(out) :: sampler       !! nothing reported yet

      call build_catalogue(system, sampler%catalogue)
      allocate (sampler%y(system%n), sampler%ydot(system%n), source=0.0_wp)
      sampler%n_last_sample = last_instant(plan)
   end subroutine new_sampler

   !> All output instants up to the end of the last step.
   subroutine take_samples(self, system, method, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(planar_system_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! a file could not be written, or the equations not be solved

      real(wp) :: cpu_0, cpu_1, t
      integer :: status

      if (self%n_strobe < size(plan%strobes)) then
         if (plan%strobes(self%n_strobe + 1) <= method%t) call take_strobes(self, system, method, plan, residual, recorder, error)
         if (allocated(error)) return
      end if
      t = instant(plan, self%n_sample)
      if (self%n_sample > self%n_last_sample .or. t > method%t) return
      call cpu_time(cpu_0)
      if (t < method%t) call method%prepare_output(system, status)
      do while (self%n_sample <= self%n_last_sample .and. t <= method%t)
         call self%report(system, method, t, residual, error)
         if (allocated(error)) return
         call recorder%sample(t, self%catalogue, error)
         if (allocated(error)) return
         self%n_sample = self%n_sample + 1
         t = instant(plan, self%n_sample)
      end do
      call cpu_time(cpu_1)
      self%aside = self%aside + (cpu_1 - cpu_0)
   end subroutine take_samples

   !> All stroboscopic instants up to the end of the last step.
   subroutine take_strobes(self, system, method, plan, residual, recorder, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(planar_system_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      type(time_plan_t), intent(in) :: plan               !! times
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      class(recorder_t), intent(inout) :: recorder        !! keeps the results
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      real(wp) :: cpu_0, cpu_1, t
      integer :: status

      call cpu_time(cpu_0)
      if (plan%strobes(self%n_strobe + 1) < method%t) call method%prepare_output(system, status)
      do while (self%n_strobe < size(plan%strobes))
         t = plan%strobes(self%n_strobe + 1)
         if (t > method%t) exit
         call self%report(system, method, t, residual, error)
         if (allocated(error)) return
         call recorder%strobe(t, self%catalogue)
         self%n_strobe = self%n_strobe + 1
      end do
      call cpu_time(cpu_1)
      self%aside = self%aside + (cpu_1 - cpu_0)
   end subroutine take_strobes

   !> Fill the catalogue with the values at a time within the last step, by interpolation.
   subroutine report(self, system, method, t, residual, error)
      class(sampler_t), intent(inout) :: self             !! what is reported
      type(planar_system_t), intent(inout) :: system      !! the system
      class(integrator_t), intent(inout) :: method        !! the integrator
      real(wp), intent(in) :: t                           !! time [s]
      real(wp), intent(in) :: residual                    !! of the ledger at the last step [J]
      type(error_t), allocatable, intent(out) :: error    !! the equations cannot be solved there

      integer :: status

      call method%state_at(system, t, self%y)
      call report_state(system, t, self%y, self%ydot, residual, self%catalogue, status)
      if (status /= 0) call describe_failure(system, method, advance_failed_evaluation, error)
   end subroutine report

end module sampling
