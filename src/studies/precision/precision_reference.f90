!> The reference of a comparison, its own errors, and the errors of runs against it.
!>
!> The difference of the reference and what confirms it is its error: nothing below it can be reported. Runs are compared up to the
!> last instant at which it is below a tenth of the error requested.
module precision_reference
   use growth, only: n_digit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: kept_run_t, n_sort, sort_positions, sort_reactions, sort_velocities
   use kinds, only: not_a_number, wp
   use precision_info, only: setting_t
   use precision_results, only: error_motion, error_onsets, error_peaks, error_positions, error_reactions, error_restitution, &
      error_velocities, precision_t, tol_run_done, tol_run_other, tol_run_t
   use run_difference, only: compare_contacts, compare_sorts, distances, ends_elsewhere
   use scene_size, only: extent_of_scene, size_of_bodies
   use jobs, only: job_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: agreement, described, last_within, kept_tol_sweep_t, measure_all, measure_tol_run, motion_of, reference_t, &
      set_bar, size_of

   real(wp), parameter :: part_wanted = 0.1_wp  !! of the error requested that the reference may have [1]

   !> The runs of a tolerance sweep.
   type :: kept_tol_sweep_t
      type(kept_run_t), allocatable :: runs(:)   !! (runs) their motions
   end type kept_tol_sweep_t

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

   !> Size of the mechanism of a scene; 1 m if all of it is one place.
   real(wp) function size_of(job) result(length)
      type(job_t), intent(in) :: job       !! what runs share

      length = max(extent_of_scene(job%scene), size_of_bodies(job%scene))
      if (length <= 0.0_wp) length = 1.0_wp
   end function size_of

   !> A reference as text.
   function described(reference) result(words)
      type(reference_t), intent(in) :: reference   !! the reference
      character(:), allocatable :: words           !! as `verner 1e-13`

      words = reference%setting%word()//" "//real_text(reference%asked, 3)
   end function described

   !> Differences of the kind that is requested.
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

   !> Up to when a run is within the part of the error requested, and its maximum difference in all.
   subroutine agreement(run, reference, study, last, far)
      type(kept_run_t), intent(in) :: run            !! the run
      type(reference_t), intent(in) :: reference     !! what it is compared with
      type(precision_t), intent(in) :: study         !! error requested
      real(wp), intent(out) :: last                  !! last instant [s]
      real(wp), intent(out) :: far                   !! maximum difference up to the end [1]

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

      type(tol_run_t) :: own
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
      call measure_tol_run(other, reference, study, own)
      study%reference%bar = own%error(:size(study%reference%bar))
   end subroutine set_bar

   !> Errors of all runs against the reference.
   subroutine measure_all(study, kept, reference)
      type(precision_t), intent(inout) :: study           !! errors of its runs are set
      type(kept_tol_sweep_t), intent(in) :: kept(:)          !! (tolerance sweeps) the runs
      type(reference_t), intent(in) :: reference          !! what they are compared with

      integer :: i, k

      do k = 1, size(kept)
         do i = 1, size(kept(k)%runs)
            if (study%tol_sweeps(k)%tol_runs(i)%state == tol_run_done) then
               call measure_tol_run(kept(k)%runs(i), reference, study, study%tol_sweeps(k)%tol_runs(i))
            end if
         end do
      end do
   end subroutine measure_all

   !> Errors of a run; the time of an end by a condition is among its onsets, if the motion is compared up to there.
   subroutine measure_tol_run(run, reference, study, tol_run)
      type(kept_run_t), intent(in) :: run            !! the run
      type(reference_t), intent(in) :: reference     !! what it is compared with
      type(precision_t), intent(in) :: study         !! window and error requested
      type(tol_run_t), intent(inout) :: tol_run            !! errors are set

      real(wp), allocatable :: d(:, :)
      real(wp) :: error(n_sort)
      logical :: is_other

      call distances(run, reference%run, reference%scale, d)
      call compare_sorts(d, reference%run%t, study%reference%window, error, tol_run%error(error_motion))
      tol_run%error(error_positions) = error(sort_positions)
      tol_run%error(error_velocities) = error(sort_velocities)
      tol_run%error(error_reactions) = error(sort_reactions)
      if (all(reference%run%sort /= sort_reactions)) tol_run%error(error_reactions) = not_a_number()
      call compare_contacts(run, reference%run, study%reference%window, tol_run%error(error_onsets), tol_run%error(error_peaks), &
                            tol_run%error(error_restitution), is_other)
      if (ends_elsewhere(run, reference%run, study%reference%window)) then
         is_other = .true.
         tol_run%reason = "its end time differs from that of the reference"
      end if
      if (is_other) tol_run%state = tol_run_other
      if (study%is_stopped .and. .not. (study%reference%is_cut .or. is_other)) then
         associate (onsets => tol_run%error(error_onsets))
            if (.not. ieee_is_finite(onsets)) onsets = 0.0_wp
            onsets = max(onsets, abs(run%end - reference%run%end))
         end associate
      end if
      tol_run%is_below = .false.
      if (ieee_is_finite(tol_run%error(study%wanted)) .and. ieee_is_finite(study%reference%bar(study%wanted))) then
         tol_run%is_below = tol_run%error(study%wanted) <= study%reference%bar(study%wanted)
      end if
      tol_run%holds_until = last_within(wanted_of(d, study%wanted), reference%run%t, study%accuracy)
   end subroutine measure_tol_run

end module precision_reference
