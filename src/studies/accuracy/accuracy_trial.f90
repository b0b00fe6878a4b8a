!> The runs of a search for a tolerance: one, those that have been found, and how far two agree.
module accuracy_trial
   use channel_difference, only: set_differences
   use kept_channels, only: kept_channels_t
   use kinds, only: min_tolerance, wp
   use precision_info, only: setting_t
   use precision_reference, only: last_within, reference_t
   use run_difference, only: ends_elsewhere
   use jobs, only: job_t, outcome_t
   use setting_run, only: run_setting
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: agreement, copy_trial, ends_falsely, is_better, make_trial, no_time, same, search_t, trial_t

   real(wp), parameter :: same = 3.0_wp  !! ratio below which the difference of two tolerances carries no information [1]
   character(*), parameter :: no_time = "time budget exhausted"  !! why no more was reached

   !> A run of the search.
   type :: trial_t
      logical :: is_there = .false.            !! it came to its end
      logical :: is_late = .false.             !! its time was up
      type(reference_t) :: what                !! its setting, tolerance and time; not its motion
      type(kept_channels_t) :: run             !! its channels and motion
   end type trial_t

   !> The search.
   type :: search_t
      type(trial_t) :: taken                   !! the run that is taken
      type(trial_t) :: coarser                 !! the one before it
      type(trial_t) :: other                   !! what confirms it
      integer, allocatable :: asked(:, :)      !! (3, n) group, component, item of the channels
      integer :: stride = 1                    !! output instants from one that is compared to the next
      real(wp), allocatable :: scale(:)        !! (kinds) scales of the channels [any]
      real(wp) :: limit = 0.0_wp               !! maximum difference allowed [1]
      logical :: is_false_end = .false.  !! another integrator goes the way of the run that is taken, and ends elsewhere
      integer :: runs = 0                      !! runs made
      character(:), allocatable :: reason      !! why no more was reached; blank: it was
   end type search_t

contains

   !> Copy a run. Here, since each assignment of one is much code.
   subroutine copy_trial(from, to)
      type(trial_t), intent(in) :: from    !! the run
      type(trial_t), intent(inout) :: to   !! becomes a copy

      to = from
   end subroutine copy_trial

   !> Make a run. One that is late ends the search.
   subroutine make_trial(job, budget, until, setting, tolerance, search, trial)
      type(job_t), intent(inout) :: job               !! what runs share
      type(time_budget_t), intent(in) :: budget       !! the time
      real(wp), intent(in) :: until                   !! part of the budget at which its time is up [1]
      type(setting_t), intent(in) :: setting          !! its integrator
      real(wp), intent(in) :: tolerance               !! its tolerance [1]
      type(search_t), intent(inout) :: search         !! counts runs
      type(trial_t), intent(out) :: trial             !! the run

      type(outcome_t) :: outcome

      trial%what%setting = setting
      trial%what%asked = tolerance
      trial%run%asked = search%asked
      trial%run%stride = search%stride
      trial%run%wants_contact_rows = .true.  ! extremes are those of all rows
      job%limits%clock = budget%clock_left(until)
      call run_setting(job, setting, tolerance, trial%run, outcome)
      trial%what%wall = outcome%wall
      trial%is_there = outcome%reason == ""
      trial%is_late = outcome%is_late
      search%runs = search%runs + 1
      if (outcome%is_late) search%reason = no_time
      if (.not. (trial%is_there .or. outcome%is_late .or. search%taken%is_there) .and. tolerance <= same*min_tolerance) then
         search%reason = outcome%reason
      end if
   end subroutine make_trial

   !> Up to when two runs agree, and their maximum difference.
   function agreement(run, other, search) result(time_and_difference)
      type(kept_channels_t), intent(in) :: run     !! a run
      type(kept_channels_t), intent(in) :: other   !! another one
      type(search_t), intent(in) :: search         !! scales and limit
      real(wp) :: time_and_difference(2)           !! (2) last instant, negative: none; difference up to the end [s, 1]

      real(wp) :: by_channel(size(run%kind)), by_instant(run%n)
      integer :: worst(run%n)

      by_instant = 0.0_wp
      by_channel = 0.0_wp
      call set_differences(run, other, search%scale, 0.0_wp, by_instant, by_channel, worst)
      time_and_difference = [last_within(by_instant, run%t, search%limit), maxval(by_instant)]
   end function agreement

   !> Whether a condition ends a run where it does not end another one, though both go the same way up to there: an error meets
   !> it, or misses it, not the motion.
   logical function ends_falsely(run, other, search)
      type(kept_channels_t), intent(in) :: run     !! a run
      type(kept_channels_t), intent(in) :: other   !! another one
      type(search_t), intent(in) :: search         !! scales and limit

      real(wp) :: pair(2)
      integer :: n

      n = min(run%n, other%n)
      ends_falsely = ends_elsewhere(run, other, huge(1.0_wp)) .and. n > 1
      if (.not. ends_falsely) return
      pair = agreement(run, other, search)
      ends_falsely = pair(1) >= run%t(n - 1)
   end function ends_falsely

   !> Whether two runs agree longer than two others, or as long and better.
   pure logical function is_better(now, best)
      real(wp), intent(in) :: now(2)    !! (2) time and maximum difference [s, 1]
      real(wp), intent(in) :: best(2)   !! (2) those of the others [s, 1]

      is_better = now(1) > best(1) .or. (now(1) >= best(1) .and. now(2) < best(2))
   end function is_better

end module accuracy_trial
