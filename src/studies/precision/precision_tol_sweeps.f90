!> Tolerance sweeps of tolerances or steps: their runs, kept for the comparison, within their part of a budget.
module precision_tol_sweeps
   use kept_run, only: kept_run_t
   use kinds, only: not_a_number, wp
   use precision_info, only: reference_setting, setting_t
   use precision_reference, only: kept_tol_sweep_t
   use precision_results, only: error_ledger, error_violation, tol_sweep_t, precision_t, tol_run_done, tol_run_failed, &
        tol_run_t, tol_run_unrun
   use progress, only: progress_t
   use scene, only: scene_t
   use jobs, only: job_t, outcome_t
   use setting_run, only: run_setting
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: min_rise, new_tol_sweeps, not_ready, run_tol_sweeps, run_tol_run

   real(wp), parameter :: until_tol_sweeps = 0.45_wp      !! runs that are compared
   real(wp), parameter :: for_first = 1.0_wp/3.0_wp    !! of the time left, that the first run of a tolerance sweep may take [1]
   real(wp), parameter :: min_rise = 1.1_wp          !! of the time of a run over that of the run before, for a forecast [1]
   real(wp), parameter :: most_rise = 3.0_wp           !! the same [1]

   character(*), parameter :: no_time = "time budget exhausted"  !! why a run was not made
   character(*), parameter :: not_ready = "stopped: time budget exhausted"  !! why a run failed that was ended

contains

   !> Tolerance sweeps of tolerances; those of steps wait for what the others report.
   subroutine new_tol_sweeps(scene, settings, study)
      type(scene_t), intent(in) :: scene               !! the scene
      type(setting_t), intent(in) :: settings(:)       !! (n) settings
      type(precision_t), intent(inout) :: study        !! tolerance sweeps are made

      real(wp) :: coarsest, finest
      integer :: i, k, n, per_decade

      associate (asked => scene%settings%precision)
         per_decade = nint(asked%number("per_decade"))
         coarsest = asked%number("coarsest")
         allocate (study%tol_sweeps(size(settings)))
         do k = 1, size(settings)
            associate (tol_sweep => study%tol_sweeps(k))
               tol_sweep%setting = settings(k)
               tol_sweep%name = settings(k)%word()
               tol_sweep%is_fixed = settings(k)%has_fixed_steps()
               finest = coarsest*10.0_wp**(-asked%number("step_decades"))
               if (.not. tol_sweep%is_fixed) finest = min(coarsest, asked%number("finest"))
               n = 1 + floor(per_decade*log10(coarsest/finest) + 1.0e-6_wp)
               allocate (tol_sweep%tol_runs(n))
               do i = 1, n
                  tol_sweep%tol_runs(i)%asked = coarsest*10.0_wp**(-real(i - 1, wp)/per_decade)
                  if (tol_sweep%is_fixed) tol_sweep%tol_runs(i)%asked = 10.0_wp**(-real(i - 1, wp)/per_decade)
                  tol_sweep%tol_runs(i)%reason = no_time
                  tol_sweep%tol_runs(i)%error = not_a_number()
                  tol_sweep%tol_runs(i)%cpu = not_a_number()
                  allocate (tol_sweep%tol_runs(i)%rounds(0))
               end do
            end associate
         end do
      end associate
   end subroutine new_tol_sweeps

   !> All runs that are compared, run by run, the coarse ones of all tolerance sweeps first. Each tolerance sweep has an equal share
   !> of the time, its first run a third of what is left if that is more; what some leave over goes to the others then, and at last
   !> to those that have a run which took longer.
   subroutine run_tol_sweeps(job, budget, display, study, kept)
      type(job_t), intent(inout) :: job                             !! what runs share
      type(time_budget_t), intent(in) :: budget                     !! the time
      type(progress_t), intent(inout) :: display                    !! shows how far it is
      type(precision_t), intent(inout) :: study                     !! runs are filled, but for their errors
      type(kept_tol_sweep_t), allocatable, intent(out) :: kept(:)      !! (tolerance sweeps) the runs

      integer, parameter :: in_shares = 1, for_others = 2, for_all = 3  ! passes
      logical :: is_over(size(study%tol_sweeps)), is_slow(size(study%tol_sweeps))
      integer :: i, k, most, pass
      real(wp) :: spent(size(study%tol_sweeps)), share

      allocate (kept(size(study%tol_sweeps)))
      most = 0
      do k = 1, size(kept)
         allocate (kept(k)%runs(size(study%tol_sweeps(k)%tol_runs)))
         most = max(most, size(kept(k)%runs))
      end do
      is_over = .false.
      is_slow = .false.
      spent = 0.0_wp
      share = budget%left(until_tol_sweeps)/real(max(1, size(kept)), wp)
      pass = in_shares
      do k = 1, size(kept)
         if (.not. study%tol_sweeps(k)%is_fixed) call climb(1, k)
      end do
      call set_steps(job, budget, study)
      do pass = in_shares, for_all
         if (pass == for_others) is_over = is_slow
         if (pass == for_all) is_over = .false.
         do i = 1, most
            do k = 1, size(kept)
               call climb(i, k)
            end do
            if (pass == in_shares) call display%update(0.35_wp*real(i, wp)/real(most, wp))
         end do
      end do

   contains

      !> One run of a tolerance sweep, if there is one and time for it.
      subroutine climb(i, k)
         integer, intent(in) :: i  !! the run
         integer, intent(in) :: k  !! the tolerance sweep

         type(kept_run_t) :: fresh
         real(wp) :: time, until

         if (i > size(kept(k)%runs) .or. is_over(k)) return
         associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
            if (tol_run%state /= tol_run_unrun) return
            time = max(forecast(study%tol_sweeps(k), i), tol_run%wall*min_rise)
            is_over(k) = time > budget%left(until_tol_sweeps) .or. (pass == in_shares .and. spent(k) + time > share)
            if (is_over(k)) return
            until = until_tol_sweeps
            if (pass == in_shares) then
               time = share - spent(k)
               if (i == 1) time = max(time, for_first*budget%left(until_tol_sweeps))
               until = min(until, budget%part_after(time))
            end if
            job%limits%clock = budget%clock_left(until)
            call run_tol_run(job, budget, study%tol_sweeps(k)%setting, tol_run, kept(k)%runs(i), is_over(k))
            spent(k) = spent(k) + tol_run%wall
            if (.not. (is_over(k) .and. pass == in_shares)) return
            is_slow(k) = .true.
            kept(k)%runs(i) = fresh
            tol_run%state = tol_run_unrun
            tol_run%reason = no_time
         end associate
      end subroutine climb

   end subroutine run_tol_sweeps

   !> How long a run may take, from the runs before it.
   pure real(wp) function forecast(tol_sweep, i) result(time)
      type(tol_sweep_t), intent(in) :: tol_sweep  !! the tolerance sweep
      integer, intent(in) :: i              !! the run

      time = 0.0_wp
      if (i < 2) return
      time = tol_sweep%tol_runs(i - 1)%wall*min_rise
      if (i < 3) return
      if (tol_sweep%tol_runs(i - 2)%wall <= 0.0_wp) return
      time = tol_sweep%tol_runs(i - 1)%wall*max(min_rise, min(most_rise, &
                                                              tol_sweep%tol_runs(i - 1)%wall/tol_sweep%tol_runs(i - 2)%wall))
   end function forecast

   !> Run a run and keep its motion. One that exceeds a limit of the deck has failed.
   subroutine run_tol_run(job, budget, setting, tol_run, run, is_late)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time
      type(setting_t), intent(in) :: setting          !! the tolerance sweep's
      type(tol_run_t), intent(inout) :: tol_run             !! costs are set
      type(kept_run_t), intent(inout) :: run          !! the motion
      logical, intent(out) :: is_late                 !! it failed because its time was up

      type(outcome_t) :: outcome

      call run_setting(job, setting, tol_run%asked, run, outcome, is_audited=.true.)
      tol_run%wall = outcome%wall
      is_late = outcome%is_late
      tol_run%reason = outcome%reason
      if (is_late) tol_run%reason = not_ready
      tol_run%state = merge(tol_run_done, tol_run_failed, tol_run%reason == "")
      tol_run%setup = outcome%setup
      associate (summary => outcome%summary)
         tol_run%cpu = summary%cpu_seconds
         tol_run%cpu_min = summary%cpu_seconds
         tol_run%count%steps = summary%count%steps
         tol_run%count%rejected = summary%count%rejected_steps
         tol_run%count%evaluations = summary%count%rhs_evaluations - summary%count%output_evaluations
         if (tol_run%state /= tol_run_done) return
         tol_run%error(error_violation) = summary%quality%violation_max
         if (summary%quality%has_ledger .and. summary%quality%energy_max > 0.0_wp) then
            tol_run%error(error_ledger) = summary%quality%energy_residual_max/summary%quality%energy_max
         end if
      end associate
   end subroutine run_tol_run

   !> Steps of the tolerance sweeps with fixed ones: from the deck's, or from the mean step of the first variable tolerance sweep's
   !> first run, brought to a whole number of quarter decades; without such a run from that of the first reference method.
   subroutine set_steps(job, budget, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      type(precision_t), intent(inout) :: study          !! steps are set

      type(kept_run_t) :: nothing
      type(outcome_t) :: outcome
      real(wp) :: longest
      integer :: k

      if (.not. any(study%tol_sweeps%is_fixed)) return
      longest = job%scene%settings%precision%number("longest_step")
      if (longest <= 0.0_wp) then
         longest = study%end/100.0_wp
         do k = size(study%tol_sweeps), 1, -1
            if (.not. study%tol_sweeps(k)%is_fixed .and. study%tol_sweeps(k)%tol_runs(1)%count%steps > 0) then
               longest = study%end/real(study%tol_sweeps(k)%tol_runs(1)%count%steps, wp)
            end if
         end do
         if (all(study%tol_sweeps%is_fixed)) then
            nothing%is_kept = .false.
            job%limits%clock = budget%clock_left(until_tol_sweeps)
            call run_setting(job, reference_setting(""), job%scene%settings%precision%number("coarsest"), nothing, outcome)
            if (outcome%summary%count%steps > 0) longest = study%end/real(outcome%summary%count%steps, wp)
         end if
         longest = 10.0_wp**(real(nint(4.0_wp*log10(longest)), wp)/4.0_wp)
      end if
      do k = 1, size(study%tol_sweeps)
         if (study%tol_sweeps(k)%is_fixed) study%tol_sweeps(k)%tol_runs%asked = longest*study%tol_sweeps(k)%tol_runs%asked
      end do
   end subroutine set_steps

end module precision_tol_sweeps
