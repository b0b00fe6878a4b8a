!> The reference of a comparison, what confirms it, and the errors of runs against it.
!>
!> The reference is the tightest run of all: one of `verner` at a tenth of the finest tolerance of the ladders, or, where that
!> fails or takes too long, the tightest one of a ladder. What confirms it is a run of another integrator: of the tightest ones of
!> all others that which goes the same way for the longest time. Their difference is the error of the reference: nothing
!> below it can be told. Runs are compared up to the last instant at which it is below a tenth of the error wanted.
module precision_reference
   use growth, only: n_digit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: kept_run_t, n_sort, sort_positions, sort_reactions, sort_velocities
   use kinds, only: least_tolerance, not_a_number, wp
   use perturbation, only: arm_of
   use precision_info, only: setting_t
   use precision_results, only: error_motion, error_onsets, error_peaks, error_positions, error_reactions, error_restitution, &
      error_velocities, ladder_t, precision_t, rung_done, rung_other, rung_t
   use run_difference, only: compare_contacts, compare_sorts, distances, ends_elsewhere, scales_of
   use scene_size, only: extent_of_scene, size_of_bodies
   use setting_run, only: job_t, outcome_t, run_setting
   use text, only: real_text
   use time_budget, only: time_budget_t
   implicit none (type, external)
   private
   public :: arms_of, described, find_reference, last_within, kept_ladder_t, measure_all, measure_rung, motion_of, reference_t, &
      size_of

   real(wp), parameter :: part_wanted = 0.1_wp  !! of the error wanted that the reference may have [1]
   real(wp), parameter :: tighter = 0.1_wp      !! tolerance of the reference, of the finest one of the ladders [1]
   real(wp), parameter :: for_other = 0.1_wp    !! part of the budget kept back for what confirms it [1]
   integer, parameter :: attempts = 4           !! tolerances that are tried, each ten times the one before

   !> The runs of a ladder.
   type :: kept_ladder_t
      type(kept_run_t), allocatable :: runs(:)   !! (rungs) their motions
   end type kept_ladder_t

   !> The reference.
   type :: reference_t
      logical :: is_there = .false.         !! whether there is one
      type(setting_t) :: setting            !! its setting
      real(wp) :: asked = 0.0_wp            !! its tolerance or step [1 or s]
      real(wp) :: wall = 0.0_wp             !! time that it took [s]
      type(kept_run_t) :: run               !! its motion
      real(wp) :: scale(n_sort) = 1.0_wp    !! (n_sort) what differences are divided by [any]
   end type reference_t

contains

   !> Find the reference, what confirms it, and up to when it is known well enough. Where a condition ends it, all motion ends at
   !> its last instant.
   subroutine find_reference(job, budget, until, finest, study, kept, reference)
      type(job_t), intent(inout) :: job                  !! what runs share
      type(time_budget_t), intent(in) :: budget          !! the time
      real(wp), intent(in) :: until                      !! part of the budget that may be spent [1]
      real(wp), intent(in) :: finest                     !! tolerance of the ladders [1]
      type(precision_t), intent(inout) :: study          !! with its ladders; the reference's errors are set
      type(kept_ladder_t), intent(in) :: kept(:)         !! (ladders) their runs
      type(reference_t), intent(out) :: reference        !! the reference

      type(reference_t) :: other, second

      study%reference%what = ""
      study%reference%confirmation = ""
      study%reference%bar = not_a_number()
      study%reference%window = study%end
      study%reference%is_unsure = .true.
      call run_tight("verner", until - for_other)
      reference = second
      if (.not. reference%is_there) call tightest_of(study, kept, "", reference)
      if (.not. reference%is_there) return
      study%reference%what = described(reference)
      associate (last => reference%run%t(reference%run%n))
         study%is_stopped = last < study%end*(1.0_wp - 1.0e-9_wp)
         if (study%is_stopped) study%end = last
         if (study%is_stopped) study%instants = reference%run%n
         study%reference%window = study%end
      end associate
      study%reference%is_poor = reference%setting%method /= "verner" .or. &
                                reference%asked > 1.01_wp*max(least_tolerance, tighter*finest)
      reference%scale = scales_of(reference%run, size_of(job), study%end)
      call find_other(other)
      if (.not. other%is_there) return
      study%reference%confirmation = described(other)
      call set_bar(other%run, reference, study)

   contains

      !> A run at a tenth of the finest tolerance, or as near to it as the method comes, and as the runs of its ladder let hope.
      subroutine run_tight(name, part)
         character(*), intent(in) :: name  !! of the integrator
         real(wp), intent(in) :: part      !! of the budget that may be spent [1]

         type(outcome_t) :: outcome
         type(reference_t) :: fresh
         real(wp) :: begun
         integer :: k

         second = fresh
         second%setting = setting_t(name, "", "")
         second%asked = least_in_time(study, name, max(least_tolerance, tighter*finest), budget%left(part))
         do k = 1, attempts
            if (budget%left(part) <= 0.0_wp) return
            second%run = fresh%run
            second%run%arm = arms_of(job)
            begun = budget%elapsed()
            job%clock = budget%clock_left(part)
            call run_setting(job, second%setting, second%asked, second%run, outcome)
            second%wall = budget%elapsed() - begun
            second%is_there = outcome%reason == ""
            if (second%is_there .or. outcome%is_late) return
            second%asked = 10.0_wp*second%asked
         end do
      end subroutine run_tight

      !> Of the tightest runs of other integrators the one that goes the way of the reference for the longest time.
      subroutine find_other(best)
         type(reference_t), intent(out) :: best  !! it

         integer :: k

         call run_tight(trim(merge("adams ", "verner", reference%setting%method == "verner")), until)
         if (second%is_there) best = second
         do k = 1, size(study%ladders)
            if (study%ladders(k)%setting%method == reference%setting%method) cycle
            call tightest_of(study, kept, study%ladders(k)%name, second)
            if (.not. second%is_there) cycle
            if (.not. best%is_there) then
               best = second
            else if (is_nearer(second%run, best%run)) then
               best = second
            end if
         end do
      end subroutine find_other

      !> Whether one run goes the way of the reference longer than another, or as long and nearer to it.
      logical function is_nearer(one, another)
         type(kept_run_t), intent(in) :: one      !! a run
         type(kept_run_t), intent(in) :: another  !! another one

         real(wp) :: far(2), last(2)

         call agreement(one, reference, study, last(1), far(1))
         call agreement(another, reference, study, last(2), far(2))
         is_nearer = last(1) > last(2) .or. (last(1) >= last(2) .and. far(1) < far(2))
      end function is_nearer

   end subroutine find_reference

   !> The least tolerance, decades above the one wanted, for which there is time, from what the tightest run of the integrator took
   !> and the one a decade before it; the one wanted where there is no such run, or no tolerance below it for which there is time.
   pure real(wp) function least_in_time(study, name, wanted, time) result(tolerance)
      type(precision_t), intent(in) :: study    !! with its ladders
      character(*), intent(in) :: name          !! of the integrator
      real(wp), intent(in) :: wanted            !! tolerance [1]
      real(wp), intent(in) :: time              !! that is left [s]

      real(wp), parameter :: usual = 1.3_wp     ! time of a run over that of one with ten times the tolerance [1]
      real(wp), parameter :: least = 1.2_wp     ! the same, at least [1]
      real(wp) :: rise
      integer :: before, i, k

      tolerance = wanted
      do k = 1, size(study%ladders)
         associate (rungs => study%ladders(k)%rungs)
            if (study%ladders(k)%setting%method /= name .or. study%ladders(k)%is_fixed) cycle
            i = findloc(rungs%state == rung_done .or. rungs%state == rung_other, .true., dim=1, back=.true.)
            if (i == 0) cycle
            before = findloc((rungs%state == rung_done .or. rungs%state == rung_other) .and. &
                             rungs%asked > 9.0_wp*rungs(i)%asked, .true., dim=1, back=.true.)
            rise = usual
            if (before > 0) then
               rise = max(least, (rungs(i)%wall/rungs(before)%wall)**(1.0_wp/log10(rungs(before)%asked/rungs(i)%asked)))
            end if
            do while (rungs(i)%wall*rise**log10(rungs(i)%asked/tolerance) > time .and. tolerance < rungs(i)%asked)
               tolerance = 10.0_wp*tolerance
            end do
            if (tolerance >= rungs(i)%asked) tolerance = wanted
            return
         end associate
      end do
   end function least_in_time

   !> Radii of gyration of the bodies of a scene.
   function arms_of(job) result(arm)
      type(job_t), intent(in) :: job       !! what runs share
      real(wp), allocatable :: arm(:)      !! (bodies) radii [m]

      integer :: k

      associate (bodies => job%scene%bodies)
         arm = [(arm_of(bodies, k), k=1, bodies%n)]
      end associate
   end function arms_of

   !> Size of the mechanism of a scene; 1 m if all of it is one place.
   real(wp) function size_of(job) result(length)
      type(job_t), intent(in) :: job       !! what runs share

      length = max(extent_of_scene(job%scene), size_of_bodies(job%scene))
      if (length <= 0.0_wp) length = 1.0_wp
   end function size_of

   !> A reference in words.
   function described(reference) result(words)
      type(reference_t), intent(in) :: reference   !! the reference
      character(:), allocatable :: words           !! as `verner 1e-13`

      words = reference%setting%word()//" "//real_text(reference%asked, 3)
   end function described

   !> The tightest run that ended, of a ladder or of all; of all, that of the smallest tolerance.
   subroutine tightest_of(study, kept, name, found)
      type(precision_t), intent(in) :: study         !! with its ladders
      type(kept_ladder_t), intent(in) :: kept(:)     !! (ladders) their runs
      character(*), intent(in) :: name               !! of the ladder; blank: any, those of tolerances first
      type(reference_t), intent(out) :: found        !! the run, if there is one

      real(wp) :: least
      integer :: best, i, k, ladder

      least = huge(1.0_wp)
      best = 0
      ladder = 0
      do k = 1, size(kept)
         if (name /= "" .and. study%ladders(k)%name /= name) cycle
         do i = size(kept(k)%runs), 1, -1
            if (study%ladders(k)%rungs(i)%state == rung_done) exit
         end do
         if (i == 0) cycle
         associate (asked => study%ladders(k)%rungs(i)%asked)
            if (asked >= least .or. (study%ladders(k)%is_fixed .and. ladder > 0)) cycle
            least = asked
            if (study%ladders(k)%is_fixed) least = huge(1.0_wp)
            best = i
            ladder = k
         end associate
      end do
      if (ladder == 0) return
      found%is_there = .true.
      found%setting = study%ladders(ladder)%setting
      found%asked = study%ladders(ladder)%rungs(best)%asked
      found%wall = study%ladders(ladder)%rungs(best)%wall
      found%run = kept(ladder)%runs(best)
   end subroutine tightest_of

   !> Differences of the kind that is wanted.
   pure function wanted_of(d, wanted) result(x)
      real(wp), intent(in) :: d(:, :)       !! (n_sort, instants) differences [1]
      integer, intent(in) :: wanted         !! kind of error
      real(wp) :: x(size(d, 2))             !! (instants) its differences [1]

      select case (wanted)
      case (error_positions); x = d(sort_positions, :)
      case (error_velocities); x = d(sort_velocities, :)
      case (error_reactions); x = d(sort_reactions, :)
      case default; x = max(d(sort_positions, :), d(sort_velocities, :))
      end select
   end function wanted_of

   !> Distance of two motions at each common instant.
   function motion_of(run, reference) result(x)
      type(kept_run_t), intent(in) :: run            !! a run
      type(reference_t), intent(in) :: reference     !! another one, with scales
      real(wp), allocatable :: x(:)                  !! (instants) the greater one of positions and velocities [1]

      real(wp), allocatable :: d(:, :)

      call distances(run, reference%run, reference%scale, d)
      x = wanted_of(d, error_motion)
   end function motion_of

   !> Up to when a run is within the part of the error wanted, and its greatest difference in all.
   subroutine agreement(run, reference, study, last, far)
      type(kept_run_t), intent(in) :: run            !! the run
      type(reference_t), intent(in) :: reference     !! what it is compared with
      type(precision_t), intent(in) :: study         !! error wanted
      real(wp), intent(out) :: last                  !! last instant [s]
      real(wp), intent(out) :: far                   !! greatest difference up to the end [1]

      real(wp), allocatable :: d(:, :), x(:)

      call distances(run, reference%run, reference%scale, d)
      x = wanted_of(d, study%wanted)
      far = maxval(x)
      last = last_within(x, reference%run%t, part_wanted*study%accuracy)
   end subroutine agreement

   !> The last instant up to which differences are not above a limit; negative: there is none.
   pure real(wp) function last_within(x, t, limit) result(last)
      real(wp), intent(in) :: x(:)     !! (n) differences [1]
      real(wp), intent(in) :: t(:)     !! (n or more) their times [s]
      real(wp), intent(in) :: limit    !! the limit [1]

      integer :: i

      last = -1.0_wp
      do i = 1, size(x)
         if (.not. x(i) <= limit) exit
         last = t(i)
      end do
   end function last_within

   !> The reference's own errors, and up to when it is known well enough.
   subroutine set_bar(other, reference, study)
      type(kept_run_t), intent(in) :: other          !! what confirms the reference
      type(reference_t), intent(in) :: reference     !! the reference
      type(precision_t), intent(inout) :: study      !! window and bar are set

      type(rung_t) :: own
      real(wp), allocatable :: x(:)
      real(wp) :: far, last
      integer :: k

      x = motion_of(other, reference)
      study%reference%agreed = [(max(0.0_wp, last_within(x, reference%run%t, 10.0_wp**(-k))), k=1, n_digit)]
      call agreement(other, reference, study, last, far)
      study%reference%is_unsure = last <= 0.0_wp
      if (.not. study%reference%is_unsure) study%reference%window = last
      study%reference%is_cut = study%reference%window < study%end*(1.0_wp - 1.0e-9_wp)
      own%error = not_a_number()
      call measure_rung(other, reference, study, own)
      study%reference%bar = own%error(:size(study%reference%bar))
   end subroutine set_bar

   !> Errors of all runs against the reference.
   subroutine measure_all(study, kept, reference)
      type(precision_t), intent(inout) :: study           !! errors of its rungs are set
      type(kept_ladder_t), intent(in) :: kept(:)          !! (ladders) the runs
      type(reference_t), intent(in) :: reference          !! what they are compared with

      integer :: i, k

      do k = 1, size(kept)
         do i = 1, size(kept(k)%runs)
            if (study%ladders(k)%rungs(i)%state == rung_done) then
               call measure_rung(kept(k)%runs(i), reference, study, study%ladders(k)%rungs(i))
            end if
         end do
      end do
   end subroutine measure_all

   !> Errors of a run.
   subroutine measure_rung(run, reference, study, rung)
      type(kept_run_t), intent(in) :: run            !! the run
      type(reference_t), intent(in) :: reference     !! what it is compared with
      type(precision_t), intent(in) :: study         !! window and error wanted
      type(rung_t), intent(inout) :: rung            !! errors are set

      real(wp), allocatable :: d(:, :)
      real(wp) :: error(n_sort)
      logical :: is_other

      call distances(run, reference%run, reference%scale, d)
      call compare_sorts(d, reference%run%t, study%reference%window, error, rung%error(error_motion))
      rung%error(error_positions) = error(sort_positions)
      rung%error(error_velocities) = error(sort_velocities)
      rung%error(error_reactions) = error(sort_reactions)
      if (all(reference%run%sort /= sort_reactions)) rung%error(error_reactions) = not_a_number()
      call compare_contacts(run, reference%run, study%reference%window, rung%error(error_onsets), rung%error(error_peaks), &
                            rung%error(error_restitution), is_other)
      if (ends_elsewhere(run, reference%run, study%reference%window)) then
         is_other = .true.
         rung%reason = "it ends at another time than the reference"
      end if
      if (is_other) rung%state = rung_other
      rung%is_below = .false.
      if (ieee_is_finite(rung%error(study%wanted)) .and. ieee_is_finite(study%reference%bar(study%wanted))) then
         rung%is_below = rung%error(study%wanted) <= study%reference%bar(study%wanted)
      end if
      rung%holds_until = last_within(wanted_of(d, study%wanted), reference%run%t, study%accuracy)
   end subroutine measure_rung

end module precision_reference
