!> A run of a job with a setting of its integration, which the next run knows nothing of.
module setting_run
   use diagnostics, only: diagnostics_t
   use errors, only: error_t
   use integration_settings, only: integration_t
   use jobs, only: first_line, job_t, outcome_t, run_job
   use kept_run, only: kept_run_t
   use kinds, only: not_a_number, wp
   use perturbation, only: arm_of
   use precision_info, only: setting_t
   use run_audit, only: limits_t
   use source_text, only: source_t
   use step_check, only: check_steps
   implicit none (type, external)
   private
   public :: run_setting

contains

   !> Run.
   subroutine run_setting(job, setting, asked, keeper, outcome, is_audited)
      type(job_t), intent(inout) :: job               !! the job; left as it is
      type(setting_t), intent(in) :: setting          !! the setting
      real(wp), intent(in) :: asked                   !! tolerance, or length of fixed steps [1 or s]
      class(kept_run_t), intent(inout) :: keeper      !! keeps the run, or nothing
      type(outcome_t), intent(out) :: outcome         !! what came of it
      logical, intent(in), optional :: is_audited     !! the deck's limits of ledger and violation hold; absent: they do not

      type(diagnostics_t) :: mistakes
      type(error_t), allocatable :: error
      type(integration_t) :: settings
      type(limits_t) :: limits
      type(source_t) :: none(0)
      integer :: k
      logical :: has_limits

      keeper%arm = [(arm_of(job%scene%bodies, k), k=1, job%scene%bodies%n)]
      settings = job%scene%settings%integration
      limits = job%limits
      call setting%apply(asked, job%scene%settings%integration)
      has_limits = .false.
      if (present(is_audited)) has_limits = is_audited
      if (.not. has_limits) then
         job%limits%energy = 0.0_wp
         job%limits%violation = 0.0_wp
      end if
      call check_steps(job%scene%settings%integration, mistakes)
      call mistakes%to_error(none, error)
      if (allocated(error)) then
         outcome%reason = first_line(error%message)
         outcome%summary%cpu_seconds = not_a_number()
      else
         call run_job(job, keeper, outcome)
      end if
      job%scene%settings%integration = settings
      job%limits = limits
   end subroutine run_setting

end module setting_run
