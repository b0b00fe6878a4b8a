!> Compares settings of an integration by error and cost: tolerance sweeps of tolerances or steps, a confirmed reference, times.
!>
!> Every run is made anew from the scene, its positions, velocities, reactions and contacts kept in memory; then all
!> are timed in rounds, one after the other, with nothing kept, so that what changes on the machine meets all of them. The
!> processor time is that of the solution: making the system and the output are not in it.
module precision_study
   use errors, only: error_t, exit_integration, set_error
   use exponent_runs, only: find_horizon, horizon_with_twin, plan_horizon
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: kept_run_t
   use kinds, only: not_a_number, wp
   use precision_bends, only: find_bends
   use precision_choice, only: choose_best, find_orders
   use precision_info, only: reference_setting, setting_t, settings_of
   use precision_tol_sweeps, only: min_rise, new_tol_sweeps, run_tol_sweeps, run_tol_run
   use precision_reference, only: kept_tol_sweep_t, measure_all, measure_tol_run, reference_t
   use precision_results, only: median, precision_t, tol_run_done, tol_run_other, tol_run_t
   use precision_statistics, only: take_statistics
   use precision_twins, only: run_twins
   use progress, only: progress_t
   use reference_search, only: find_reference
   use jobs, only: job_t, outcome_t
   use setting_run, only: run_setting
   use text, only: text_t
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: study_precision

   ! parts of the budget at whose end the phases end [1]
   real(wp), parameter :: until_stop = 0.10_wp         !! the run that reports when a condition ends the motion
   real(wp), parameter :: until_reference = 0.65_wp    !! the reference and what confirms it
   real(wp), parameter :: until_twins = 0.75_wp        !! reference runs
   real(wp), parameter :: until_tangent = 0.80_wp      !! the exponent by the tangent
   real(wp), parameter :: until_exponent = 0.85_wp     !! the exponent by a reference run
   real(wp), parameter :: until_times = 0.95_wp        !! rounds of timing
   real(wp), parameter :: until_choice = 1.0_wp        !! the choice, run once more

contains

   !> Compare the settings that a scene's section [precision], or a list of words, names.
   !> The instants compared are equal parts of the motion, whatever the deck's output is.
   subroutine study_precision(job, words, display, study, error)
      type(job_t), intent(inout) :: job                  !! the run, with a section [precision] or its defaults
      type(text_t), intent(in) :: words(:)               !! (n) settings, checked
      type(progress_t), intent(inout) :: display         !! shows how far it is
      type(precision_t), intent(inout) :: study          !! budget and accuracy are set, the rest follows
      type(error_t), allocatable, intent(out) :: error   !! a condition ends the motion as it starts

      type(kept_tol_sweep_t), allocatable :: kept(:)
      type(reference_t) :: reference
      type(setting_t), allocatable :: settings(:)
      type(time_budget_t) :: budget
      real(wp) :: finest, perturbation
      integer :: rounds

      call budget%begin(study%budget)
      associate (asked => job%scene%settings%precision)
         finest = asked%number("finest")
         rounds = nint(asked%number("rounds"))
         perturbation = asked%number("perturbation")
         study%output_times = nint(asked%number("instants")) + 1
         job%plan%every = job%plan%end/asked%number("instants")
      end associate
      job%plan%first_output = 0.0_wp
      job%plan%poincare_samples = [real(wp) ::]
      study%end = job%plan%end
      study%longest_step = job%scene%settings%integration%controls%maximum_step
      call space_output_times(finest, budget, job, error)
      if (allocated(error)) return
      call settings_of(words, settings)
      call new_tol_sweeps(job%scene, settings, study)
      call run_tol_sweeps(job, budget, display, study, kept)
      call find_reference(job, budget, until_reference, finest, study, kept, reference)
      call display%update(0.4_wp)
      if (reference%is_there) call measure_all(study, kept, reference)
      call take_statistics(kept, reference, study)
      call run_twins(job, budget, until_twins, perturbation, kept, reference, study)
      call raise_horizons(study)
      call find_exponents(job, budget, study)
      call display%update(0.5_wp)
      call time_rounds(job, budget, rounds, display, study)
      call find_orders(study)
      call find_bends(study)
      call choose_best(study)
      call confirm_choice(job, budget, reference, study)
      study%spent = budget%elapsed()
   end subroutine study_precision

   !> Digits that the reference and its confirmation have in common a trajectory can have, whatever the law of growth says of
   !> times at which reference runs are no longer near each other.
   pure subroutine raise_horizons(study)
      type(precision_t), intent(inout) :: study  !! horizons are raised

      integer :: k

      do k = 1, size(study%reference%agreed)
         associate (horizon => study%growth%horizon(k), agreed => study%reference%agreed(k))
            if (agreed >= study%end*(1.0_wp - 1.0e-9_wp)) horizon = not_a_number()
            if (ieee_is_finite(horizon)) horizon = max(horizon, agreed)
         end associate
      end do
   end subroutine raise_horizons

   !> The largest Lyapunov exponent by both methods.
   subroutine find_exponents(job, budget, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      type(precision_t), intent(inout) :: study          !! its horizon is set

      call plan_horizon(job%scene%settings%precision%item_t, job%plan%end, study%horizon)
      if (job%scene%settings%precision%number("perturbation") <= 0.0_wp) return
      job%limits%clock = budget%clock_left(until_tangent)
      call find_horizon(job, study%horizon)
      job%limits%clock = budget%clock_left(until_exponent)
      call horizon_with_twin(job, study%horizon)
   end subroutine find_exponents

   !> Where a condition ends the motion, the instants compared are equal parts of what there is of it; the last one comes before the
   !> end, which is another by a little in every run.
   subroutine space_output_times(finest, budget, job, error)
      real(wp), intent(in) :: finest                !! tolerance of the run that reports [1]
      type(time_budget_t), intent(in) :: budget     !! the time
      type(job_t), intent(inout) :: job             !! its plan may change
      type(error_t), allocatable, intent(out) :: error  !! there is nothing of the motion

      real(wp), parameter :: before = 1.0e-6_wp   ! the end, of the motion [1]
      type(kept_run_t) :: nothing
      type(outcome_t) :: outcome

      if (job%limits%stop%n == 0) return
      nothing%is_kept = .false.
      job%limits%clock = budget%clock_left(until_stop)
      call run_setting(job, reference_setting(""), finest, nothing, outcome)
      if (outcome%reason /= "" .or. .not. outcome%summary%time_end < job%plan%end) return
      if (outcome%summary%time_end <= 0.0_wp) then
         call set_error(error, exit_integration, "nothing to compare: the motion is "//outcome%summary%message// &
                        new_line("a")//"  = the initial state already meets this condition of 'stop' in [guards]")
         return
      end if
      job%plan%every = job%plan%every*(1.0_wp - before)*outcome%summary%time_end/job%plan%end
   end subroutine space_output_times

   !> Time all runs that ended, round by round.
   subroutine time_rounds(job, budget, rounds, display, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      integer, intent(in) :: rounds                      !! requested
      type(progress_t), intent(inout) :: display         !! shows how far it is
      type(precision_t), intent(inout) :: study          !! times are set

      type(kept_run_t) :: nothing
      type(outcome_t) :: outcome
      real(wp) :: all_walls, timed
      integer :: i, k, round

      all_walls = 0.0_wp
      do k = 1, size(study%tol_sweeps)
         all_walls = all_walls + sum(study%tol_sweeps(k)%tol_runs%wall, mask=is_timed(study%tol_sweeps(k)%tol_runs%state))
      end do
      timed = 0.0_wp
      job%limits%clock = 0.0_wp
      nothing%is_kept = .false.
      do round = 1, rounds
         do k = 1, size(study%tol_sweeps)
            do i = 1, size(study%tol_sweeps(k)%tol_runs)
               associate (tol_sweep => study%tol_sweeps(k), tol_run => study%tol_sweeps(k)%tol_runs(i))
                  if (.not. is_timed(tol_run%state) .or. tol_run%wall*min_rise > budget%left(until_times)) cycle
                  if (allocated(nothing%contacts)) deallocate (nothing%contacts)
                  call run_setting(job, tol_sweep%setting, tol_run%asked, nothing, outcome)
                  tol_run%rounds = [tol_run%rounds, outcome%summary%cpu_seconds]
                  tol_run%n_round = round
                  tol_run%cpu = median(tol_run%rounds)
                  tol_run%cpu_min = minval(tol_run%rounds)
                  timed = timed + tol_run%wall
               end associate
            end do
            call display%update(0.5_wp + 0.5_wp*min(1.0_wp, timed/(rounds*max(all_walls, tiny(1.0_wp)))))
         end do
      end do
      study%rounds = rounds
      do k = 1, size(study%tol_sweeps)
         do i = 1, size(study%tol_sweeps(k)%tol_runs)
            if (is_timed(study%tol_sweeps(k)%tol_runs(i)%state)) study%rounds = min(study%rounds, &
                                                                                    study%tol_sweeps(k)%tol_runs(i)%n_round)
         end do
      end do
   end subroutine time_rounds

   !> Whether a run in some state ended and is timed.
   elemental logical function is_timed(state)
      integer, intent(in) :: state  !! of a run

      is_timed = state == tol_run_done .or. state == tol_run_other
   end function is_timed

   !> Run the choice once more: it must give the same again.
   subroutine confirm_choice(job, budget, reference, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      type(reference_t), intent(in) :: reference         !! what it is compared with
      type(precision_t), intent(inout) :: study          !! with its choice

      type(kept_run_t) :: run
      type(tol_run_t) :: again
      logical :: is_late

      study%choice%error = not_a_number()
      study%choice%cpu = not_a_number()
      if (study%choice%tol_sweep == 0) return
      associate (tol_sweep => study%tol_sweeps(study%choice%tol_sweep))
         again%asked = tol_sweep%tol_runs(study%choice%tol_run)%asked
         again%error = not_a_number()
         if (tol_sweep%tol_runs(study%choice%tol_run)%wall*min_rise > budget%left(until_choice)) return
         job%limits%clock = 0.0_wp
         call run_tol_run(job, budget, tol_sweep%setting, again, run, is_late)
         if (again%state /= tol_run_done) return
         call measure_tol_run(run, reference, study, again)
         if (again%state == tol_run_done) study%choice%error = again%error(study%wanted)
         study%choice%cpu = again%cpu
      end associate
   end subroutine confirm_choice

end module precision_study
