!> Finds the tolerance at which a motion has the accuracy asked for, from runs at successive tolerances.
!>
!> Each run is ten times as tight as the one before. Channels x of runs a and b, with the scales s of their kinds, differ by
!> $$ d(t) = \max_{t_i \le t} \max_k |x_k^a(t_i) - x_k^b(t_i)|/s_k, $$
!> extremes up to t_i counted as values. The tighter one of two that differ by less than the accuracy over the safety factor is
!> taken and confirmed by another integrator, which is made tighter until it differs by no more; where that is not to be had, by a
!> run of the same one at a hundredth of the tolerance. The error claimed is the greater difference times a safety factor, a
!> greater one where round-off makes the differences: they are chance there. What confirms starts beside it by as much as numbers
!> are rounded by, each coordinate and rate by a part of itself (what is zero stays so: a symmetric start is one): what a motion
!> makes of that, as of a spin that is none until contacts start together, is in the difference, while the errors of the runs
!> would else be alike in it. Where no tolerance keeps it to the end it is claimed
!> up to the last instant to which it is kept. Where a condition ends the run, but not another integrator's that goes the same
!> way, an error meets it and not the motion: the search continues with tighter tolerances.
!>
!> Limits: an error that all of these runs share, as of a start or of a law, is none here.
module accuracy_search
   use accuracy_claim, only: safety, set_claim
   use accuracy_results, only: accuracy_t, claim_reached, claim_window
   use accuracy_trial, only: agreement, copy_trial, ends_falsely, is_better, make_trial, no_time, same, search_t, trial_t
   use channel_difference, only: channel_scales
   use kept_run, only: n_sort
   use kinds, only: eps, min_tolerance, wp
   use precision_info, only: setting_t
   use precision_reference, only: kept_tol_sweep_t, reference_t, size_of
   use precision_results, only: precision_t
   use precision_twins, only: run_twins
   use progress, only: progress_t
   use integration_method, only: abilities_t
   use integrator_registry, only: abilities_of, reference_methods
   use jobs, only: job_t
   use text, only: text_t
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: find_accuracy

   real(wp), parameter :: step = 0.1_wp              !! from a tolerance to the next [1]
   real(wp), parameter :: coarsest = 1.0e-4_wp       !! maximum tolerance of a first run [1]
   real(wp), parameter :: finest = 1.0e-11_wp        !! minimum tolerance of a first run: below, others must be to be had [1]
   real(wp), parameter :: first_part = 3.0_wp        !! of the maximum difference allowed: for the first one [1]
   real(wp), parameter :: tightest_part = 1.0e-2_wp  !! of the tolerance, of a run of the same integrator that confirms [1]
   integer, parameter :: attempts = 4                !! tolerances of the other integrator
   real(wp), parameter :: until_taken = 0.5_wp       !! part of the budget at whose end no third or further run is started [1]
   real(wp), parameter :: dear = 4.0_wp              !! time of another integrator over that of the run's own, for a forecast [1]
   real(wp), parameter :: for_one = 0.6_wp           !! of the time left, that the first run of another integrator may take [1]
   real(wp), parameter :: much_looser = 1.0e2_wp     !! tolerance after one that was late, over its own [1]
   real(wp), parameter :: rise = 1.6_wp              !! of the time of a run over that of the one before, for a forecast [1]
   real(wp), parameter :: idle = 0.5_wp              !! of the difference before: it no longer falls [1]
   integer, parameter :: patience = 2                !! pairs of runs in which nothing is gained before the search ends
   real(wp), parameter :: rounding = 4.0_wp*eps     !! of the start of what confirms, as a part of each coordinate [1]
   real(wp), parameter :: beside = 1.0e-9_wp         !! perturbation of reference runs that report why digits end [1]

   character(*), parameter :: no_gain = "tighter tolerances do not reduce the error: round-off"      !! the same
   character(*), parameter :: no_tighter = "the minimum tolerance is reached"               !! the same
   character(*), parameter :: ends_apart = &
      "this run and that of another integrator meet the stop condition at different times, at every tolerance"  !! the same

contains

   !> Find the tolerance. Without any run that came to its end no tolerance is found, and the reason is that of the last.
   subroutine find_accuracy(job, budget, method, asked, stride, display, found)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time, started
      character(*), intent(in) :: method              !! the integrator
      integer, intent(in) :: asked(:, :)              !! (3, n) group, component, item of the channels
      integer, intent(in) :: stride                   !! output instants from one that is compared to the next
      type(progress_t), intent(inout) :: display      !! shows how far it is
      type(accuracy_t), intent(inout) :: found        !! `asked` is set, the rest follows

      type(search_t) :: search
      type(trial_t) :: before, fresh
      real(wp) :: first

      found%evidence%coarser = ""
      found%evidence%confirmation = ""
      found%growth%reason = "not determined"
      search%limit = found%asked/safety
      search%asked = asked
      search%stride = stride
      search%reason = ""
      first = max(finest, min(coarsest, 10.0_wp**floor(log10(first_part*search%limit))))
      do
         call descend(job, budget, method, first, display, search)
         if (.not. search%coarser%is_there .or. (search%is_false_end .and. search%taken%what%asked > first)) exit
         call copy_trial(search%other, before)
         call copy_trial(fresh, search%other)
         search%is_false_end = .false.
         call confirm(job, budget, search)
         if (.not. search%other%is_there) call copy_trial(before, search%other)
         if (.not. search%is_false_end .or. search%reason == no_time) exit
         if (search%taken%what%asked <= same*min_tolerance) exit
         first = max(min_tolerance, step*search%taken%what%asked)
         search%reason = ""
      end do
      if (search%is_false_end .and. search%reason /= no_time) search%reason = ends_apart
      call display%update(0.9_wp)
      call set_claim(search, found)
      if (found%claim == claim_window .or. found%claim == claim_reached) call explain(job, budget, search, found)
      found%evidence%runs = search%runs
      found%evidence%spent = budget%elapsed()
   end subroutine find_accuracy

   !> From tolerance to tolerance, until two runs agree, nothing is gained, or the time is used up.
   subroutine descend(job, budget, method, first, display, search)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time
      character(*), intent(in) :: method              !! the integrator
      real(wp), intent(in) :: first                   !! maximum tolerance [1]
      type(progress_t), intent(inout) :: display      !! shows how far it is
      type(search_t), intent(inout) :: search         !! two runs are found, or one, or none

      type(trial_t) :: last, next
      real(wp) :: best(2), now(2), tolerance, until
      integer :: futile, k

      tolerance = first
      best = [-1.0_wp, huge(1.0_wp)]
      futile = 0
      do k = 1, nint(-log10(min_tolerance)) + 1
         until = merge(until_taken, 1.0_wp, search%coarser%is_there)
         if (last%is_there .and. rise*last%what%wall > budget%left(until) - last%what%wall) search%reason = no_time
         if (search%reason /= "") return
         call make_trial(job, budget, until, setting_t(method, "", ""), tolerance, search, next)
         if (next%is_there) then
            if (.not. search%taken%is_there) call copy_trial(next, search%taken)
            if (last%is_there) then
               search%scale = channel_scales(next%run, size_of(job), job%plan%end)
               now = agreement(next%run, last%run, search)
               if (is_better(now, best)) then
                  futile = merge(0, futile + 1, now(1) > best(1) .or. now(2) < idle*best(2))
                  best = now
                  call copy_trial(next, search%taken)
                  call copy_trial(last, search%coarser)
               else
                  futile = futile + 1
               end if
               if (now(2) <= search%limit) return
            end if
            call copy_trial(next, last)
         end if
         call display%update(0.08_wp*k)
         if (tolerance <= same*min_tolerance .and. search%reason == "") search%reason = no_tighter
         if (futile == patience) search%reason = no_gain
         tolerance = max(min_tolerance, step*tolerance)
      end do
   end subroutine descend

   !> Time that is left, less what the run that will be written takes.
   real(wp) function time_left(budget, trial)
      type(time_budget_t), intent(in) :: budget   !! the time
      type(trial_t), intent(in) :: trial          !! the run

      time_left = budget%left(1.0_wp) - trial%what%wall
   end function time_left

   !> Confirm the run by another integrator, or by the same one, much tighter, if that agrees longer.
   subroutine confirm(job, budget, search)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time
      type(search_t), intent(inout) :: search         !! what confirms it is set

      type(abilities_t) :: can
      type(text_t), allocatable :: others(:)
      type(trial_t) :: next
      real(wp) :: best(2), pair(2)
      integer :: k

      pair = agreement(search%taken%run, search%coarser%run, search)
      best = [-2.0_wp, huge(1.0_wp)]
      job%perturbed%rounding = rounding
      associate (own => search%taken%what)
         can = abilities_of(own%setting%method)
         others = reference_methods(with_stiff=.true.)
         do k = 1, size(others)
            if (others(k)%s == own%setting%method .or. search%other%is_there) cycle
            if (index(" "//can%parts//" ", " "//others(k)%s//" ") > 0) cycle  ! whose steps these may be
            call confirm_by(others(k)%s, own%asked)
         end do
         if (best(1) < pair(1) .and. own%asked > same*min_tolerance .and. .not. search%is_false_end) then
            call take(own%setting%method, max(min_tolerance, tightest_part*own%asked), 1.0_wp)
         end if
      end associate
      job%perturbed%rounding = 0.0_wp
      if (best(1) >= pair(1) .and. pair(2) <= search%limit) search%reason = ""
      if (best(1) < pair(1) .and. search%reason == "") search%reason = no_tighter

   contains

      !> Runs of an integrator, tighter from one to the next; looser where it fails, or where there is no time for more.
      subroutine confirm_by(name, first)
         character(*), intent(in) :: name   !! the integrator
         real(wp), intent(in) :: first      !! its first tolerance [1]

         real(wp) :: forecast, tolerance
         integer :: i, looser
         logical :: has_ended, was_late

         tolerance = first
         forecast = dear*search%taken%what%wall
         looser = 0
         do while (forecast > time_left(budget, search%taken) .and. tolerance < coarsest)
            tolerance = tolerance/step
            forecast = forecast/rise
            looser = looser + 1
         end do
         has_ended = .false.
         was_late = .false.
         do i = 1, attempts + looser
            call take(name, tolerance, merge(1.0_wp, for_one, has_ended .or. was_late))
            if (best(1) >= pair(1)) return
            if (next%is_there) then
               has_ended = .true.
               if (tolerance <= same*min_tolerance) return
               tolerance = max(min_tolerance, step*tolerance)
            else
               if (has_ended .or. (next%is_late .and. was_late)) return
               was_late = was_late .or. next%is_late
               tolerance = tolerance*merge(much_looser, 1.0_wp/step, next%is_late)
            end if
         end do
      end subroutine confirm_by

      !> A run, if there is time for it.
      subroutine take(name, tolerance, part)
         character(*), intent(in) :: name       !! the integrator
         real(wp), intent(in) :: tolerance      !! its tolerance [1]
         real(wp), intent(in) :: part           !! of the time left, that it may take [1]

         type(trial_t) :: fresh
         real(wp) :: left, now(2)

         left = time_left(budget, search%taken)
         if (left <= 0.0_wp .or. (next%is_there .and. rise*next%what%wall > left)) then
            search%reason = no_time
            call copy_trial(fresh, next)
            next%is_late = .true.
            return
         end if
         call make_trial(job, budget, budget%part_after(part*left), setting_t(name, "", ""), tolerance, search, next)
         if (.not. next%is_there) return
         if (name /= search%taken%what%setting%method) then
            search%is_false_end = ends_falsely(search%taken%run, next%run, search)
         end if
         now = agreement(search%taken%run, next%run, search)
         if (.not. is_better(now, best)) return
         best = now
         call copy_trial(next, search%other)
      end subroutine take

   end subroutine confirm

   !> Why digits end before the motion does: how fast neighbouring motions part.
   subroutine explain(job, budget, search, found)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time
      type(search_t), intent(in) :: search            !! the runs
      type(accuracy_t), intent(inout) :: found        !! growth is set

      type(kept_tol_sweep_t) :: none(0)
      type(precision_t) :: study
      type(reference_t) :: base

      if (search%stride /= 1 .or. job%plan%first_output > 0.0_wp) return
      allocate (study%tol_sweeps(0))
      base = search%taken%what
      base%is_there = .true.
      base%run = search%taken%run%kept_run_t
      base%scale = search%scale(:n_sort)
      call run_twins(job, budget, 1.0_wp, beside, none, base, study)
      found%growth = study%growth
   end subroutine explain

end module accuracy_search
