!> reference runs of a run, from starts that are a small perturbation apart: how fast they part.
!>
!> A condition ends reference runs at other times: where one of them lacks more than the last instant, there is none.
module precision_twins
   use growth, only: find_growth
   use kept_run, only: kept_run_t, sort_velocities
   use kinds, only: not_a_number, wp
   use precision_tol_sweeps, only: not_ready
   use precision_reference, only: kept_tol_sweep_t, motion_of, reference_t, size_of
   use precision_results, only: precision_t, tol_run_done, tol_run_unrun
   use text, only: real_text, to_text
   use jobs, only: job_t, outcome_t
   use setting_run, only: run_setting
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: run_twins

   integer, parameter :: wanted = 3      !! reference runs
   real(wp), parameter :: tight = 0.1_wp !! maximum tolerance of reference runs, of the perturbation [1]
   integer, parameter :: attempts = 6    !! perturbed starts that are tried
   real(wp), parameter :: left = 1.0e-5_wp !! minimum part of the perturbation that constraints leave where something is free [1]

   character(*), parameter :: no_time = "time budget exhausted"  !! why there are no reference runs
   character(*), parameter :: nothing_is_free = &
      "no perturbed initial state gives another motion: no coordinate is free, or [initial.speed] fixes it"  !! the same

contains

   !> Run reference runs of the reference, or of a run of its integrator for which the time is enough, and find their growth.
   subroutine run_twins(job, budget, until, perturbation, kept, reference, study)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      real(wp), intent(in) :: until                      !! part of the budget that may be spent [1]
      real(wp), intent(in) :: perturbation               !! of the size of the mechanism, 0: no reference runs [1]
      type(kept_tol_sweep_t), intent(in) :: kept(:)         !! (tolerance sweeps) the runs
      type(reference_t), intent(in) :: reference         !! the reference
      type(precision_t), intent(inout) :: study          !! growth is set

      type(outcome_t) :: outcome
      type(reference_t) :: base
      type(kept_run_t) :: fresh, twin
      real(wp), allocatable :: distance(:), ratio(:, :)
      real(wp) :: maximum
      integer :: common, k, n

      study%growth%horizon = not_a_number()
      allocate (study%growth%t(0), study%growth%ratio(0, 0))
      study%growth%reason = ""
      if (perturbation <= 0.0_wp) study%growth%reason = "no neighbouring trajectories requested"
      if (.not. reference%is_there) study%growth%reason = "no reference solution"
      if (study%growth%reason /= "") return
      call choose_base(budget%left(until)/real(wanted + 1, wp), tight*perturbation, study, kept, reference, base, &
                       study%growth%reason)
      if (.not. base%is_there) return
      job%perturbed%length = perturbation*size_of(job)
      job%perturbed%speed = perturbation*base%scale(sort_velocities)
      allocate (ratio(base%run%n, wanted), source=0.0_wp)
      maximum = 0.0_wp
      n = 0
      common = base%run%n
      study%growth%reason = no_time
      do k = 1, attempts
         if (budget%left(until) <= base%wall .or. n == wanted) exit
         job%perturbed%member = k
         job%limits%clock = budget%clock_left(until)
         twin = fresh
         call run_setting(job, base%setting, base%asked, twin, outcome)
         study%growth%reason = "perturbed initial states failed: "//outcome%reason
         if (outcome%is_late) study%growth%reason = no_time
         if (outcome%reason /= "") cycle
         study%growth%reason = "a stop condition ends perturbed motions at other times"
         if (abs(twin%n - base%run%n) > 1) cycle
         distance = motion_of(twin, base)
         study%growth%reason = nothing_is_free
         if (distance(1) <= left*perturbation) cycle
         n = n + 1
         common = min(common, size(distance))
         ratio(:size(distance), n) = distance/distance(1)
         maximum = max(maximum, distance(1))
      end do
      job%perturbed%member = 0
      study%growth%n_twin = n
      if (n == 0) return
      study%growth%reason = ""
      study%growth%t = base%run%t(:common)
      study%growth%ratio = ratio(:common, :n)
      call find_growth(study%growth, maximum)
   end subroutine run_twins

   !> The reference, or the tightest run of its integrator that does not take longer than there is time for. Its tolerance must be
   !> well below the perturbation: else steps that are accepted here and rejected there make a distance of their own.
   subroutine choose_base(time, loosest, study, kept, reference, base, reason)
      real(wp), intent(in) :: time                              !! for one run [s]
      real(wp), intent(in) :: loosest                           !! maximum tolerance [1]
      type(precision_t), intent(in) :: study                    !! with its tolerance sweeps
      type(kept_tol_sweep_t), intent(in) :: kept(:)                !! (tolerance sweeps) the runs
      type(reference_t), intent(in) :: reference                !! the reference
      type(reference_t), intent(out) :: base                    !! the run, if there is one
      character(:), allocatable, intent(inout) :: reason        !! why there is none

      real(wp) :: shortest
      integer :: i, k

      shortest = huge(1.0_wp)
      base = reference
      base%is_there = .false.
      if (reference%setting%has_fixed_steps() .or. reference%asked <= loosest) call consider(reference%wall)
      if (base%is_there) return
      do k = 1, size(kept)
         if (study%tol_sweeps(k)%setting%method /= reference%setting%method) cycle
         do i = size(kept(k)%runs), 1, -1
            associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
               if (tol_run%state /= tol_run_done) cycle
               if (.not. study%tol_sweeps(k)%is_fixed .and. tol_run%asked > loosest) cycle
               call consider(tol_run%wall)
               if (.not. base%is_there) cycle
               base%setting = study%tol_sweeps(k)%setting
               base%asked = tol_run%asked
               base%wall = tol_run%wall
               base%run = kept(k)%runs(i)
               return
            end associate
         end do
      end do
      reason = "a neighbouring trajectory takes "//real_text(shortest, 2)//" s; "//no_time//" for "//to_text(wanted)//" of them"
      if (shortest >= huge(1.0_wp)) reason = why_not_tight(study, reference, loosest)

   contains

      !> Whether a run that is tight enough is short enough too.
      subroutine consider(wall)
         real(wp), intent(in) :: wall  !! time that it took [s]

         shortest = min(shortest, wall)
         base%is_there = wall <= time
      end subroutine consider

   end subroutine choose_base

   !> Why no run of the reference's integrator is as tight as reference runs must be.
   function why_not_tight(study, reference, loosest) result(reason)
      type(precision_t), intent(in) :: study             !! with its tolerance sweeps
      type(reference_t), intent(in) :: reference         !! the reference
      real(wp), intent(in) :: loosest                    !! maximum tolerance [1]
      character(:), allocatable :: reason                !! as text

      logical :: is_asked, is_late
      integer :: i, k

      is_asked = .false.
      is_late = .false.
      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            if (tol_sweep%is_fixed) cycle
            is_asked = is_asked .or. any(tol_sweep%tol_runs%asked <= loosest)
            if (tol_sweep%setting%method /= reference%setting%method) cycle
            do i = 1, size(tol_sweep%tol_runs)
               if (tol_sweep%tol_runs(i)%asked > loosest) cycle
               is_late = is_late .or. tol_sweep%tol_runs(i)%state == tol_run_unrun .or. tol_sweep%tol_runs(i)%reason == not_ready
            end do
         end associate
      end do
      reason = "run of "//reference%setting%method//" at the tolerance of neighbouring trajectories, "//real_text(loosest, 2)// &
         " or less"
      if (is_late) then
         reason = no_time//" for a "//reason
      else if (is_asked) then
         reason = "no "//reason//" kept the contact sequence of the reference"
      else
         reason = "no "//reason//" was requested ('finest' of [precision])"
      end if
   end function why_not_tight

end module precision_twins
