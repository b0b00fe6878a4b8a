!> Compares settings of an integration by error and cost: ladders of tolerances or steps, a confirmed reference, times.
!>
!> Every run is made anew from the scene, its positions, velocities, reactions and contacts kept in memory; then all
!> are timed in rounds, one after the other, with nothing kept, so that what changes on the machine meets all of them. The
!> processor time is that of the solution: making the system and the output are not in it.
module precision_study
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use exponent_runs, only: find_horizon, horizon_with_twin, plan_horizon
   use kept_run, only: kept_run_t
   use kinds, only: not_a_number, wp
   use precision_bends, only: find_bends
   use precision_choice, only: choose_best, find_orders
   use precision_info, only: setting_t, settings_of
   use precision_reference, only: arms_of, find_reference, kept_ladder_t, measure_all, measure_rung, reference_t
   use precision_results, only: error_ledger, error_violation, ladder_t, median, precision_t, rung_done, rung_failed, &
      rung_other, rung_t, rung_unrun
   use precision_statistics, only: take_statistics
   use precision_twins, only: run_twins
   use progress, only: progress_t
   use scene, only: scene_t
   use setting_run, only: has_fixed_steps, job_t, outcome_t, run_setting, shorter
   use stop_condition, only: stop_t
   use text, only: text_t
   use time_budget, only: time_budget_t
   use time_plan, only: time_plan_t
   implicit none (type, external)
   private
   public :: study_precision

   ! parts of the budget at whose end the phases end [1]
   real(wp), parameter :: until_ladders = 0.45_wp      !! runs that are compared
   real(wp), parameter :: until_reference = 0.65_wp    !! the reference and what confirms it
   real(wp), parameter :: until_twins = 0.75_wp        !! twins
   real(wp), parameter :: until_tangent = 0.80_wp      !! the exponent by the tangent
   real(wp), parameter :: until_exponent = 0.85_wp     !! the exponent by a twin
   real(wp), parameter :: until_times = 0.95_wp        !! rounds of timing
   real(wp), parameter :: until_choice = 1.0_wp        !! the choice, run once more
   real(wp), parameter :: least_rise = 1.1_wp          !! of the time of a run over that of the rung before, for a forecast [1]
   real(wp), parameter :: most_rise = 3.0_wp           !! the same [1]

   character(*), parameter :: no_time = "no time was left in the budget"  !! why a run was not made

contains

   !> Compare the settings that a scene's section [precision], or a list of words, names.
   subroutine study_precision(scene, plan, stop, words, display, study)
      type(scene_t), intent(in) :: scene                 !! the scene, with a section [precision] or its defaults
      type(time_plan_t), intent(in) :: plan              !! times of the motion
      type(stop_t), intent(in) :: stop                   !! conditions that end it
      type(text_t), intent(in) :: words(:)               !! (n) settings, checked
      type(progress_t), intent(inout) :: display         !! shows how far it is
      type(precision_t), intent(inout) :: study          !! budget and accuracy are set, the rest follows

      type(job_t) :: job
      type(kept_ladder_t), allocatable :: kept(:)
      type(reference_t) :: reference
      type(setting_t), allocatable :: settings(:)
      type(time_budget_t) :: budget

      call budget%begin(study%budget)
      call new_job(scene, plan, stop, job)
      study%end = plan%end
      study%instants = nint(scene%settings%precision%number("instants")) + 1
      study%longest_step = scene%settings%dynamic%number("maximum_step")
      call settings_of(words, settings)
      call new_ladders(scene, settings, study)
      call run_ladders(job, budget, display, study, kept)
      call find_reference(job, budget, until_reference, scene%settings%precision%number("finest"), study, kept, reference)
      call display%update(0.4_wp)
      if (reference%is_there) call measure_all(study, kept, reference)
      call take_statistics(kept, reference, study)
      call run_twins(job, budget, until_twins, scene%settings%precision%number("perturbation"), kept, reference, study)
      call raise_horizons(study)
      call find_exponents(job, budget, study)
      call display%update(0.5_wp)
      call time_rounds(job, budget, nint(scene%settings%precision%number("rounds")), display, study)
      call find_orders(study)
      call find_bends(study)
      call choose_best(study)
      call confirm_choice(job, budget, reference, study)
      study%spent = budget%elapsed()
   end subroutine study_precision

   !> Digits that the reference and its confirmation have in common a trajectory can have, whatever the law of growth says of
   !> times at which the twins are no longer near each other.
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

      call plan_horizon(job%scene%settings%precision%item_t, study%end, study%horizon)
      if (job%scene%settings%precision%number("perturbation") <= 0.0_wp) return
      job%cpu = budget%cpu_left(until_tangent)
      call find_horizon(job, study%horizon)
      job%cpu = budget%cpu_left(until_exponent)
      call horizon_with_twin(job, study%horizon)
   end subroutine find_exponents

   !> What all runs share: the instants compared are equal parts of the motion, whatever the deck's output is.
   subroutine new_job(scene, plan, stop, job)
      type(scene_t), intent(in) :: scene       !! the scene
      type(time_plan_t), intent(in) :: plan    !! times of the motion
      type(stop_t), intent(in) :: stop         !! conditions that end it
      type(job_t), intent(out) :: job          !! what runs share

      job%scene = scene
      job%settings = scene%settings%dynamic%item_t
      job%plan = plan
      job%plan%first_output = 0.0_wp
      job%plan%every = plan%end/scene%settings%precision%number("instants")
      job%plan%strobes = [real(wp) ::]
      job%stop = stop
   end subroutine new_job

   !> Ladders of tolerances; those of steps wait for what the others tell.
   subroutine new_ladders(scene, settings, study)
      type(scene_t), intent(in) :: scene               !! the scene
      type(setting_t), intent(in) :: settings(:)       !! (n) settings
      type(precision_t), intent(inout) :: study        !! ladders are made

      real(wp) :: coarsest, finest
      integer :: i, k, n, per_decade

      associate (asked => scene%settings%precision)
         per_decade = nint(asked%number("per_decade"))
         coarsest = asked%number("coarsest")
         allocate (study%ladders(size(settings)))
         do k = 1, size(settings)
            associate (ladder => study%ladders(k))
               ladder%setting = settings(k)
               ladder%name = settings(k)%word()
               ladder%is_fixed = has_fixed_steps(settings(k))
               finest = coarsest*10.0_wp**(-asked%number("step_decades"))
               if (.not. ladder%is_fixed) finest = min(coarsest, asked%number("finest"))
               n = 1 + floor(per_decade*log10(coarsest/finest) + 1.0e-6_wp)
               allocate (ladder%rungs(n))
               do i = 1, n
                  ladder%rungs(i)%asked = coarsest*10.0_wp**(-real(i - 1, wp)/per_decade)
                  if (ladder%is_fixed) ladder%rungs(i)%asked = 10.0_wp**(-real(i - 1, wp)/per_decade)
                  ladder%rungs(i)%reason = no_time
                  ladder%rungs(i)%error = not_a_number()
                  ladder%rungs(i)%cpu = not_a_number()
                  allocate (ladder%rungs(i)%rounds(0))
               end do
            end associate
         end do
      end associate
   end subroutine new_ladders

   !> All runs that are compared, rung by rung, the coarse ones of all ladders first. Each ladder has an equal share of the time;
   !> what some leave over goes to the others then.
   subroutine run_ladders(job, budget, display, study, kept)
      type(job_t), intent(inout) :: job                             !! what runs share
      type(time_budget_t), intent(in) :: budget                     !! the time
      type(progress_t), intent(inout) :: display                    !! shows how far it is
      type(precision_t), intent(inout) :: study                     !! rungs are filled, but for their errors
      type(kept_ladder_t), allocatable, intent(out) :: kept(:)      !! (ladders) the runs

      logical :: is_over(size(study%ladders))
      integer :: i, k, most, pass
      real(wp) :: spent(size(study%ladders)), share

      allocate (kept(size(study%ladders)))
      most = 0
      do k = 1, size(kept)
         allocate (kept(k)%runs(size(study%ladders(k)%rungs)))
         most = max(most, size(kept(k)%runs))
      end do
      is_over = .false.
      spent = 0.0_wp
      share = budget%left(until_ladders)/real(max(1, size(kept)), wp)
      do k = 1, size(kept)
         if (.not. study%ladders(k)%is_fixed) call climb(1, k)
      end do
      call set_steps(job, budget, study)
      do pass = 1, 2
         do i = 1, most
            do k = 1, size(kept)
               call climb(i, k)
            end do
            if (pass == 1) call display%update(0.35_wp*real(i, wp)/real(most, wp))
         end do
         is_over = .false.
         share = huge(1.0_wp)
      end do

   contains

      !> One rung of a ladder, if there is one and time for it.
      subroutine climb(i, k)
         integer, intent(in) :: i  !! the rung
         integer, intent(in) :: k  !! the ladder

         real(wp) :: time

         if (i > size(kept(k)%runs) .or. is_over(k)) return
         if (study%ladders(k)%rungs(i)%state /= rung_unrun) return
         time = forecast(study%ladders(k), i)
         is_over(k) = time > budget%left(until_ladders) .or. spent(k) + time > share
         if (is_over(k)) return
         job%cpu = shorter(budget%cpu_left(until_ladders), job)
         call run_rung(job, budget, study%ladders(k)%setting, study%ladders(k)%rungs(i), kept(k)%runs(i), is_over(k))
         spent(k) = spent(k) + study%ladders(k)%rungs(i)%wall
      end subroutine climb

   end subroutine run_ladders

   !> How long a rung may take, from the rungs before it.
   pure real(wp) function forecast(ladder, i) result(time)
      type(ladder_t), intent(in) :: ladder  !! the ladder
      integer, intent(in) :: i              !! the rung

      time = 0.0_wp
      if (i < 2) return
      time = ladder%rungs(i - 1)%wall*least_rise
      if (i < 3) return
      if (ladder%rungs(i - 2)%wall <= 0.0_wp) return
      time = ladder%rungs(i - 1)%wall*max(least_rise, min(most_rise, ladder%rungs(i - 1)%wall/ladder%rungs(i - 2)%wall))
   end function forecast

   !> Run a rung and keep its motion.
   subroutine run_rung(job, budget, setting, rung, run, is_late)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time
      type(setting_t), intent(in) :: setting          !! the ladder's
      type(rung_t), intent(inout) :: rung             !! costs are set
      type(kept_run_t), intent(inout) :: run          !! the motion
      logical, intent(out) :: is_late                 !! it failed because its time was up

      type(outcome_t) :: outcome
      real(wp) :: begun

      begun = budget%elapsed()
      run%arm = arms_of(job)
      call run_setting(job, setting, rung%asked, run, outcome)
      rung%wall = budget%elapsed() - begun
      is_late = outcome%is_late
      rung%reason = outcome%reason
      if (is_late) rung%reason = "not ready when its time in the budget was up"
      rung%state = merge(rung_done, rung_failed, rung%reason == "")
      rung%setup = outcome%setup
      associate (summary => outcome%summary)
         rung%cpu = summary%cpu_seconds
         rung%cpu_least = summary%cpu_seconds
         rung%count%steps = summary%count%steps
         rung%count%rejected = summary%count%rejected_steps
         rung%count%evaluations = summary%count%rhs_evaluations - summary%count%output_evaluations
         if (rung%state /= rung_done) return
         rung%error(error_violation) = summary%quality%violation_max
         if (summary%quality%has_ledger .and. summary%quality%energy_max > 0.0_wp) then
            rung%error(error_ledger) = summary%quality%energy_residual_max/summary%quality%energy_max
         end if
      end associate
   end subroutine run_rung

   !> Steps of the ladders with fixed ones: from the deck's, or from the mean step of the first variable ladder's first run, brought
   !> to a whole number of quarter decades; without such a run from that of `verner`.
   subroutine set_steps(job, budget, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      type(precision_t), intent(inout) :: study          !! steps are set

      type(kept_run_t) :: nothing
      type(outcome_t) :: outcome
      real(wp) :: longest
      integer :: k

      if (.not. any(study%ladders%is_fixed)) return
      longest = job%scene%settings%precision%number("longest_step")
      if (longest <= 0.0_wp) then
         longest = study%end/100.0_wp
         do k = size(study%ladders), 1, -1
            if (.not. study%ladders(k)%is_fixed .and. study%ladders(k)%rungs(1)%count%steps > 0) then
               longest = study%end/real(study%ladders(k)%rungs(1)%count%steps, wp)
            end if
         end do
         if (all(study%ladders%is_fixed)) then
            nothing%is_kept = .false.
            job%cpu = shorter(budget%cpu_left(until_ladders), job)
            call run_setting(job, setting_t("verner", "", ""), job%scene%settings%precision%number("coarsest"), nothing, outcome)
            if (outcome%summary%count%steps > 0) longest = study%end/real(outcome%summary%count%steps, wp)
         end if
         longest = 10.0_wp**(real(nint(4.0_wp*log10(longest)), wp)/4.0_wp)
      end if
      do k = 1, size(study%ladders)
         if (study%ladders(k)%is_fixed) study%ladders(k)%rungs%asked = longest*study%ladders(k)%rungs%asked
      end do
   end subroutine set_steps

   !> Time all runs that ended, round by round.
   subroutine time_rounds(job, budget, rounds, display, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      integer, intent(in) :: rounds                      !! wanted
      type(progress_t), intent(inout) :: display         !! shows how far it is
      type(precision_t), intent(inout) :: study          !! times are set

      type(kept_run_t) :: nothing
      type(outcome_t) :: outcome
      real(wp) :: all_walls, timed
      integer :: i, k, round

      all_walls = 0.0_wp
      do k = 1, size(study%ladders)
         all_walls = all_walls + sum(study%ladders(k)%rungs%wall, mask=is_timed(study%ladders(k)%rungs%state))
      end do
      timed = 0.0_wp
      job%cpu = 0.0_wp
      nothing%is_kept = .false.
      do round = 1, rounds
         do k = 1, size(study%ladders)
            do i = 1, size(study%ladders(k)%rungs)
               associate (ladder => study%ladders(k), rung => study%ladders(k)%rungs(i))
                  if (.not. is_timed(rung%state) .or. rung%wall*least_rise > budget%left(until_times)) cycle
                  if (allocated(nothing%contacts)) deallocate (nothing%contacts)
                  call run_setting(job, ladder%setting, rung%asked, nothing, outcome)
                  rung%rounds = [rung%rounds, outcome%summary%cpu_seconds]
                  rung%n_round = round
                  rung%cpu = median(rung%rounds)
                  rung%cpu_least = minval(rung%rounds)
                  timed = timed + rung%wall
               end associate
            end do
            call display%update(0.5_wp + 0.5_wp*min(1.0_wp, timed/(rounds*max(all_walls, tiny(1.0_wp)))))
         end do
      end do
      study%rounds = rounds
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (is_timed(study%ladders(k)%rungs(i)%state)) study%rounds = min(study%rounds, study%ladders(k)%rungs(i)%n_round)
         end do
      end do
   end subroutine time_rounds

   !> Whether a run in some state ended and is timed.
   elemental logical function is_timed(state)
      integer, intent(in) :: state  !! of a rung

      is_timed = state == rung_done .or. state == rung_other
   end function is_timed

   !> Run the choice once more: it must give the same again.
   subroutine confirm_choice(job, budget, reference, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      type(reference_t), intent(in) :: reference         !! what it is compared with
      type(precision_t), intent(inout) :: study          !! with its choice

      type(kept_run_t) :: run
      type(rung_t) :: again
      logical :: is_late

      study%choice%error = not_a_number()
      study%choice%cpu = not_a_number()
      if (study%choice%ladder == 0) return
      associate (ladder => study%ladders(study%choice%ladder))
         again%asked = ladder%rungs(study%choice%rung)%asked
         again%error = not_a_number()
         if (ladder%rungs(study%choice%rung)%wall*least_rise > budget%left(until_choice)) return
         job%cpu = 0.0_wp
         call run_rung(job, budget, ladder%setting, again, run, is_late)
         if (again%state /= rung_done) return
         call measure_rung(run, reference, study, again)
         if (again%state == rung_done) study%choice%error = again%error(study%wanted)
         study%choice%cpu = again%cpu
      end associate
   end subroutine confirm_choice

end module precision_study
