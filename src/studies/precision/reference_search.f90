!> The search for the reference of a comparison: the tightest run there is, confirmed by another integrator.
!>
!> Runs are made at a tenth of the finest tolerance of the tolerance sweeps, by `verner` first and then by another integrator; by
!> those that by what the runs of their tolerance sweeps took come to the minimum tolerance in the time, if these two do not come to
!> it. Where there is no time for that tolerance there is one decades above it, and a tighter one after it as long as there is time.
!> Of these runs and the tightest ones of the tolerance sweeps those within a decade of the minimum tolerance can be the reference,
!> one of each integrator: that which goes the same way as the tightest run of a setting of another integrator for the longest time,
!> and of the two the tighter one if both can be.
module reference_search
   use kinds, only: min_tolerance, not_a_number, wp
   use precision_info, only: setting_t
   use precision_tol_sweeps, only: not_ready
   use precision_reference, only: agreement, described, kept_tol_sweep_t, reference_t, set_bar, size_of
   use precision_results, only: precision_t, tol_run_done, tol_run_t, tol_run_unrun
   use run_difference, only: scales_of
   use integration_method, only: abilities_t
   use integrator_registry, only: abilities_of, reference_methods
   use jobs, only: job_t, outcome_t
   use setting_run, only: run_setting
   use text, only: append_text, text_t
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: choose_pair, find_reference

   real(wp), parameter :: tighter = 0.1_wp      !! tolerance of the reference, of the finest one of the tolerance sweeps [1]
   real(wp), parameter :: for_other = 0.1_wp    !! part of the budget kept back for what confirms it [1]
   real(wp), parameter :: for_one = 0.5_wp      !! of the time left, that a run may take by its forecast [1]
   real(wp), parameter :: near = 10.1_wp        !! tolerances that are as tight as the minimum one, of it [1]
   real(wp), parameter :: rounding = 1.01_wp    !! ratio of tolerances that are the same [1]
   integer, parameter :: attempts = 4           !! runs of an integrator
   integer, parameter :: enough = 2             !! tight runs, by as many integrators

contains

   !> Find the reference, what confirms it, and up to when it is known well enough. Where a condition ends it, all motion ends at
   !> its last instant.
   subroutine find_reference(job, budget, until, finest, study, kept, reference)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      real(wp), intent(in) :: until                      !! part of the budget that may be spent [1]
      real(wp), intent(in) :: finest                     !! tolerance of the tolerance sweeps [1]
      type(precision_t), intent(inout) :: study          !! with its tolerance sweeps; the reference's errors are set
      type(kept_tol_sweep_t), intent(in) :: kept(:)         !! (tolerance sweeps) their runs
      type(reference_t), intent(out) :: reference        !! the reference

      type(reference_t), allocatable :: runs(:)
      real(wp) :: wanted
      integer :: k, other, own

      study%reference%what = ""
      study%reference%confirmation = ""
      study%reference%bar = not_a_number()
      study%reference%window = study%end
      study%reference%is_unsure = .true.
      wanted = max(min_tolerance, tighter*finest)
      call run_tight(job, budget, until, wanted, study, runs)
      do k = 1, size(kept)
         call append_tightest(study, kept, k, runs)
      end do
      if (size(runs) == 0) return
      do k = 1, size(runs)
         runs(k)%scale = scales_of(runs(k)%run, size_of(job), runs(k)%run%t(runs(k)%run%n))
      end do
      call choose_pair(study, runs, own, other)
      reference = runs(own)
      study%reference%what = described(reference)
      associate (last => reference%run%t(reference%run%n))
         study%is_stopped = last < study%end*(1.0_wp - 1.0e-9_wp)
         if (study%is_stopped) study%end = last
         if (study%is_stopped) study%output_times = reference%run%n
         study%reference%window = study%end
      end associate
      study%reference%is_poor = is_fixed(study, reference) .or. reference%asked > rounding*wanted
      if (other == 0) return
      study%reference%confirmation = described(runs(other))
      call set_bar(runs(other)%run, reference, study)
   end subroutine find_reference

   !> Runs as tight as there is time for, by integrators in the order of what they come to; where not one run of any tolerance sweep
   !> came to its end, by the first integrator only.
   subroutine run_tight(job, budget, until, wanted, study, runs)
      type(job_t), intent(inout) :: job                          !! what runs share
      type(time_budget_t), intent(in) :: budget                  !! the time
      real(wp), intent(in) :: until                              !! part of the budget that may be spent [1]
      real(wp), intent(in) :: wanted                             !! tolerance [1]
      type(precision_t), intent(in) :: study                     !! with its tolerance sweeps
      type(reference_t), allocatable, intent(out) :: runs(:)     !! (n) the tightest run of each that came to its end

      type(abilities_t) :: can
      type(text_t), allocatable :: untried(:)
      logical :: has_ended
      real(wp) :: part
      integer :: i, k

      allocate (runs(0))
      has_ended = any([(any(study%tol_sweeps(k)%tol_runs%state == tol_run_done), k=1, size(study%tol_sweeps))])
      untried = reference_methods(with_stiff=.false.)
      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            can = abilities_of(tol_sweep%setting%method)
            if (tol_sweep%is_fixed .or. can%parts /= "") cycle
            if (any([(untried(i)%s == tol_sweep%setting%method, i=1, size(untried))])) cycle
            call append_text(untried, tol_sweep%setting%method)
         end associate
      end do
      part = until - for_other
      do while (count(runs%asked <= near*wanted) < enough)
         k = next_of(untried, study, wanted, for_one*budget%left(part))
         if (k == 0 .and. part >= until) exit
         if (k > 0) then
            call run_one(job, budget, part, wanted, untried(k)%s, study, runs)
            untried(k)%s = ""
            if (size(runs) == 0 .and. .not. has_ended) exit
         end if
         part = until
      end do
   end subroutine run_tight

   !> The integrator that comes to the minimum tolerance in some time, the first one of several; 0: none.
   integer function next_of(names, study, wanted, time) result(next)
      type(text_t), intent(in) :: names(:)         !! (n) integrators, blank: not this one
      type(precision_t), intent(in) :: study       !! with its tolerance sweeps
      real(wp), intent(in) :: wanted               !! tolerance [1]
      real(wp), intent(in) :: time                 !! that is left [s]

      type(reference_t) :: none(0)
      real(wp) :: minimum, tolerance
      integer :: k

      next = 0
      minimum = huge(1.0_wp)
      do k = 1, size(names)
         if (names(k)%s == "") cycle
         tolerance = min_in_time(study, none, names(k)%s, wanted, time)
         if (tolerance <= 0.0_wp .or. tolerance*rounding >= minimum) cycle
         minimum = tolerance
         next = k
      end do
   end function next_of

   !> Runs of one integrator, each tighter than the one before; looser where one fails.
   subroutine run_one(job, budget, part, wanted, name, study, runs)
      type(job_t), intent(inout) :: job                          !! what runs share
      type(time_budget_t), intent(in) :: budget                  !! the time
      real(wp), intent(in) :: part                               !! of the budget that may be spent [1]
      real(wp), intent(in) :: wanted                             !! tolerance [1]
      character(*), intent(in) :: name                           !! of the integrator
      type(precision_t), intent(in) :: study                     !! with its tolerance sweeps
      type(reference_t), allocatable, intent(inout) :: runs(:)   !! (n) the tightest run is appended, if one came to its end

      type(outcome_t) :: outcome
      type(reference_t) :: best(0:1), fresh, next
      real(wp) :: minimum
      integer :: k, n

      n = 0
      minimum = wanted
      do k = 1, attempts
         next = fresh
         next%setting = setting_t(name, "", "")
         next%asked = min_in_time(study, best(1:n), name, minimum, for_one*budget%left(part))
         if (next%asked <= 0.0_wp) exit
         job%limits%clock = budget%clock_left(part)
         call run_setting(job, next%setting, next%asked, next%run, outcome)
         next%wall = outcome%wall
         next%is_there = outcome%reason == ""
         if (outcome%is_late) exit
         if (next%is_there) then
            n = 1
            best(n) = next
            if (next%asked <= rounding*minimum) exit
         else
            minimum = 10.0_wp*next%asked
         end if
      end do
      if (n == 1) call append(runs, best(n))
   end subroutine run_one

   !> Append a run.
   subroutine append(runs, run)
      type(reference_t), allocatable, intent(inout) :: runs(:)   !! (n) grown
      type(reference_t), intent(in) :: run                       !! the run

      type(reference_t), allocatable :: more(:)

      allocate (more(size(runs) + 1))
      more(:size(runs)) = runs
      more(size(more)) = run
      call move_alloc(more, runs)
   end subroutine append

   !> The minimum tolerance, decades above the one requested, for which there is time, from what the tightest run of the integrator
   !> took and one a decade or more before it; the one requested where no run of it was tried, 0 where there is no time for a
   !> tighter one.
   pure real(wp) function min_in_time(study, runs, name, wanted, time) result(tolerance)
      type(precision_t), intent(in) :: study    !! with its tolerance sweeps
      type(reference_t), intent(in) :: runs(:)  !! (n) further runs of the integrator
      character(*), intent(in) :: name          !! of the integrator
      real(wp), intent(in) :: wanted            !! tolerance [1]
      real(wp), intent(in) :: time              !! that is left [s]

      real(wp), parameter :: usual = 1.6_wp     ! time of a run over that of one with ten times the tolerance [1]
      real(wp), parameter :: minimum = 1.4_wp     ! the same, at least [1]
      real(wp), allocatable :: asked(:), wall(:)
      logical, allocatable :: is_known(:)
      logical :: is_tried
      real(wp) :: rise
      integer :: before, i, k

      tolerance = 0.0_wp
      if (time <= 0.0_wp) return
      asked = runs%asked
      wall = runs%wall
      is_tried = size(asked) > 0
      do i = 1, size(study%tol_sweeps)
         if (study%tol_sweeps(i)%setting%method /= name .or. study%tol_sweeps(i)%is_fixed) cycle
         associate (tol_runs => study%tol_sweeps(i)%tol_runs)
            is_known = [(tells_time(tol_runs(k)), k=1, size(tol_runs))]
            is_tried = .true.
            if (.not. any(is_known)) cycle
            asked = [pack(tol_runs%asked, is_known), asked]
            wall = [pack(tol_runs%wall, is_known), wall]
            exit
         end associate
      end do
      if (.not. is_tried) tolerance = wanted
      if (size(asked) == 0) return
      i = minloc(asked, dim=1)
      before = findloc(asked > 9.0_wp*asked(i), .true., dim=1, back=.true.)
      rise = usual
      if (before > 0) rise = max(minimum, (wall(i)/wall(before))**(1.0_wp/log10(asked(before)/asked(i))))
      tolerance = wanted
      do while (wall(i)*rise**log10(asked(i)/tolerance) > time .and. tolerance < asked(i))
         tolerance = 10.0_wp*tolerance
      end do
      if (rounding*tolerance >= asked(i)) tolerance = 0.0_wp
   end function min_in_time

   !> Whether a run reports how long its integrator takes: it was not ended by the clock.
   pure logical function tells_time(tol_run)
      type(tol_run_t), intent(in) :: tol_run   !! the run

      tells_time = tol_run%state /= tol_run_unrun .and. tol_run%reason /= not_ready .and. tol_run%wall > 0.0_wp
   end function tells_time

   !> Append the tightest run of a tolerance sweep that came to its end. A method that makes the steps of others confirms none of
   !> them.
   subroutine append_tightest(study, kept, k, runs)
      type(precision_t), intent(in) :: study                     !! with its tolerance sweeps
      type(kept_tol_sweep_t), intent(in) :: kept(:)                 !! (tolerance sweeps) their runs
      integer, intent(in) :: k                                   !! the tolerance sweep
      type(reference_t), allocatable, intent(inout) :: runs(:)   !! (n) grown, if there is such a run

      type(abilities_t) :: can
      type(reference_t) :: found
      integer :: i

      associate (tol_sweep => study%tol_sweeps(k))
         i = findloc(tol_sweep%tol_runs%state == tol_run_done, .true., dim=1, back=.true.)
         can = abilities_of(tol_sweep%setting%method)
         if (i == 0 .or. can%parts /= "") return
         found%is_there = .true.
         found%setting = tol_sweep%setting
         found%asked = tol_sweep%tol_runs(i)%asked
         found%wall = tol_sweep%tol_runs(i)%wall
         found%run = kept(k)%runs(i)
         call append(runs, found)
      end associate
   end subroutine append_tightest

   !> Of the runs that can be the reference that which agrees best with one of another integrator.
   subroutine choose_pair(study, runs, own, other)
      type(precision_t), intent(in) :: study       !! with its tolerance sweeps, and the error requested
      type(reference_t), intent(in) :: runs(:)     !! (n) runs with their scales, at least one
      integer, intent(out) :: own                  !! number of the reference
      integer, intent(out) :: other                !! number of what confirms it, 0: nothing does

      logical :: can_be(size(runs)), is_last(size(runs)), is_stepwise(size(runs))
      real(wp) :: best(2), far, last
      integer :: i, k

      is_stepwise = [(is_fixed(study, runs(k)), k=1, size(runs))]
      if (all(is_stepwise)) then
         can_be = .true.
      else
         can_be = .not. is_stepwise .and. runs%asked <= near*minval(runs%asked, mask=.not. is_stepwise)
      end if
      is_last = .true.
      do k = 1, size(runs)
         do i = 1, size(runs)
            if (runs(i)%setting%method /= runs(k)%setting%method) cycle
            if (runs(i)%setting%word() == runs(k)%setting%word() .and. runs(i)%asked < runs(k)%asked) is_last(k) = .false.
            if (.not. can_be(i)) cycle
            if (runs(i)%asked*merge(1.0_wp/rounding, rounding, i < k) < runs(k)%asked) can_be(k) = .false.
         end do
      end do
      own = findloc(can_be, .true., dim=1)
      other = 0
      best = [-2.0_wp, huge(1.0_wp)]
      do k = 1, size(runs)
         if (.not. can_be(k)) cycle
         do i = 1, size(runs)
            if (runs(i)%setting%method == runs(k)%setting%method .or. .not. is_last(i)) cycle
            call agreement(runs(i)%run, runs(k), study, last, far)
            if (last < best(1) .or. (last <= best(1) .and. far >= best(2))) cycle
            best = [last, far]
            own = k
            other = i
         end do
      end do
      if (other == 0) return
      if (can_be(other) .and. runs(other)%asked*merge(1.0_wp/rounding, rounding, other < own) < runs(own)%asked) then
         i = own
         own = other
         other = i
      end if
   end subroutine choose_pair

   !> Whether a run makes steps of a length that was asked for.
   pure logical function is_fixed(study, run)
      type(precision_t), intent(in) :: study       !! with its tolerance sweeps
      type(reference_t), intent(in) :: run         !! the run

      integer :: k

      is_fixed = .false.
      do k = 1, size(study%tol_sweeps)
         associate (tol_sweep => study%tol_sweeps(k))
            if (tol_sweep%setting%word() == run%setting%word()) is_fixed = is_fixed .or. tol_sweep%is_fixed
         end associate
      end do
   end function is_fixed

end module reference_search
