!> Twins of a run, from starts that are a small perturbation apart: how fast they part.
module precision_twins
   use growth, only: find_growth
   use kept_run, only: kept_run_t, sort_velocities
   use kinds, only: not_a_number, wp
   use precision_reference, only: kept_ladder_t, motion_of, reference_t, size_of
   use precision_results, only: precision_t, rung_done
   use setting_run, only: has_fixed_steps, job_t, outcome_t, run_setting
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: run_twins

   integer, parameter :: wanted = 3      !! twins
   real(wp), parameter :: tight = 0.1_wp !! greatest tolerance of twins, of the perturbation [1]
   integer, parameter :: attempts = 6    !! perturbed starts that are tried
   real(wp), parameter :: left = 1.0e-5_wp !! least part of the perturbation that constraints leave where something is free [1]

contains

   !> Run the twins of the reference, or of a run of its integrator for which the time is enough, and find their growth.
   subroutine run_twins(job, budget, until, perturbation, kept, reference, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      real(wp), intent(in) :: until                      !! part of the budget that may be spent [1]
      real(wp), intent(in) :: perturbation               !! of the size of the mechanism, 0: no twins [1]
      type(kept_ladder_t), intent(in) :: kept(:)         !! (ladders) the runs
      type(reference_t), intent(in) :: reference         !! the reference
      type(precision_t), intent(inout) :: study          !! growth is set

      type(outcome_t) :: outcome
      type(reference_t) :: base
      type(kept_run_t) :: fresh, twin
      real(wp), allocatable :: distance(:), ratio(:, :)
      real(wp) :: greatest
      integer :: k, n

      study%growth%horizon = not_a_number()
      allocate (study%growth%t(0), study%growth%ratio(0, 0))
      study%growth%reason = ""
      if (perturbation <= 0.0_wp) study%growth%reason = "no twins were asked for"
      if (.not. reference%is_there) study%growth%reason = "there is no reference"
      if (study%growth%reason /= "") return
      call choose_base(budget%left(until)/real(wanted + 1, wp), tight*perturbation, study, kept, reference, base)
      if (.not. base%is_there) then
         study%growth%reason = "no time was left in the budget for twins that are tight enough"
         return
      end if
      job%length = perturbation*size_of(job)
      job%speed = perturbation*base%scale(sort_velocities)
      allocate (ratio(base%run%n, wanted), source=0.0_wp)
      greatest = 0.0_wp
      n = 0
      do k = 1, attempts
         if (budget%left(until) <= base%wall .or. n == wanted) exit
         job%member = k
         job%clock = budget%clock_left(until)
         twin = fresh
         twin%arm = base%run%arm
         call run_setting(job, base%setting, base%asked, twin, outcome)
         if (outcome%reason /= "" .or. twin%n /= base%run%n) cycle
         distance = motion_of(twin, base)
         if (distance(1) <= left*perturbation) cycle
         n = n + 1
         ratio(:, n) = distance/distance(1)
         greatest = max(greatest, distance(1))
      end do
      job%member = 0
      study%growth%n_twin = n
      if (n == 0) then
         study%growth%reason = reason_without_twins(outcome)
         return
      end if
      study%growth%t = base%run%t
      study%growth%ratio = ratio(:, :n)
      call find_growth(study%growth, greatest)
   end subroutine run_twins

   !> Why there are no twins.
   function reason_without_twins(outcome) result(reason)
      type(outcome_t), intent(in) :: outcome     !! of the last perturbed start
      character(:), allocatable :: reason        !! in words

      reason = "no perturbed start gave another motion: nothing is free to be moved, or [initial.speed] holds it"
      if (.not. allocated(outcome%reason)) return
      if (outcome%reason /= "") reason = "perturbed starts failed: "//outcome%reason
   end function reason_without_twins

   !> The reference, or the tightest run of its integrator that does not take longer than there is time for. Its tolerance must be
   !> well below the perturbation: else steps that are accepted here and rejected there make a distance of their own.
   subroutine choose_base(time, loosest, study, kept, reference, base)
      real(wp), intent(in) :: time                       !! for one run [s]
      real(wp), intent(in) :: loosest                    !! greatest tolerance [1]
      type(precision_t), intent(in) :: study             !! with its ladders
      type(kept_ladder_t), intent(in) :: kept(:)         !! (ladders) the runs
      type(reference_t), intent(in) :: reference         !! the reference
      type(reference_t), intent(out) :: base             !! the run, if there is one

      integer :: i, k

      base = reference
      base%is_there = reference%wall <= time .and. (has_fixed_steps(reference%setting) .or. reference%asked <= loosest)
      if (base%is_there) return
      do k = 1, size(kept)
         if (study%ladders(k)%setting%method /= reference%setting%method) cycle
         do i = size(kept(k)%runs), 1, -1
            associate (rung => study%ladders(k)%rungs(i))
               if (rung%state /= rung_done .or. rung%wall > time) cycle
               if (.not. study%ladders(k)%is_fixed .and. rung%asked > loosest) cycle
               base%is_there = .true.
               base%setting = study%ladders(k)%setting
               base%asked = rung%asked
               base%wall = rung%wall
               base%run = kept(k)%runs(i)
               return
            end associate
         end do
      end do
   end subroutine choose_base

end module precision_twins
