!> Statistics of runs beyond the time up to which they are compared with the reference, where a trajectory has no digits.
!>
!> From that time to the end of the motion: contacts that start per time, means of their impact speeds and peak forces, and root
!> mean squares of velocities and reactions, each with its interval of 95 % by batches (`batch_means`). Contacts per time are
!> counted in equal bins. Of a root r of a mean m the half interval is that of m over 2 r.
!> Runs of a setting that part from the reference go their own ways, each another, and so are replications: their mean has an
!> interval of its own, from how they scatter. One is apart from the reference where its value differs by more than
!> sqrt(h^2 + h_reference^2), h the half intervals; of equal statistics one run in twenty is, by chance. Runs that still follow the
!> reference are its copies and do not count.
!>
!> Limits: as those of `batch_means`; bodies' velocities have one scale (`kept_run`).
module precision_statistics
   use batch_means, only: estimate_t, mean_of_batches, mean_of_series
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: contact_t, kept_run_t, sort_reactions, sort_velocities
   use kinds, only: not_a_number, wp
   use precision_reference, only: kept_tol_sweep_t, motion_of, reference_t
   use precision_results, only: tol_sweep_t, n_statistic, precision_t, tol_run_done, tol_run_other, statistic_peaks, &
        statistic_rate, &
      statistic_reactions, statistic_speeds, statistic_velocities, statistics_t
   use run_difference, only: by_onset
   implicit none (type, external)
   private
   public :: statistics_of_run, take_statistics

   integer, parameter :: n_bin = 256               !! equal parts of the time in which contacts are counted
   real(wp), parameter :: own_way = 1.0e-2_wp      !! distance of motions that go their own ways [1]

contains

   !> Statistics of all runs that ended, and of the reference, if there is a time that is not compared.
   subroutine take_statistics(kept, reference, study)
      type(kept_tol_sweep_t), intent(in) :: kept(:)        !! (tolerance sweeps) the runs
      type(reference_t), intent(in) :: reference        !! what they are compared with
      type(precision_t), intent(inout) :: study         !! statistics are set

      integer :: i, k

      associate (of_reference => study%reference%statistics)
         of_reference%is_there = reference%is_there .and. (study%reference%is_cut .or. study%reference%is_unsure)
         if (.not. of_reference%is_there) return
         if (.not. study%reference%is_unsure) of_reference%from = study%reference%window
         call statistics_of_run(reference%run, of_reference%from, study%end, of_reference%list)
         do k = 1, size(kept)
            study%tol_sweeps(k)%statistics%from = of_reference%from
            do i = 1, size(kept(k)%runs)
               associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
                  tol_run%statistics%from = of_reference%from
                  tol_run%statistics%list%value = not_a_number()
                  tol_run%statistics%list%half = not_a_number()
                  if (tol_run%state /= tol_run_done .and. tol_run%state /= tol_run_other) cycle
                  tol_run%statistics%is_own = maxval(motion_of(kept(k)%runs(i), reference)) > own_way
                  call statistics_of_run(kept(k)%runs(i), of_reference%from, study%end, tol_run%statistics%list)
               end associate
            end do
            call gather_runs(of_reference, study%tol_sweeps(k))
         end do
      end associate
   end subroutine take_statistics

   !> Statistics of a run from a time to its end.
   pure subroutine statistics_of_run(run, from, until, list)
      class(kept_run_t), intent(in) :: run        !! the run
      real(wp), intent(in) :: from                !! after this time [s]
      real(wp), intent(in) :: until               !! up to the end of the motion [s]
      type(estimate_t), intent(out) :: list(:)    !! (n_statistic) its statistics; NaN: not known [any]

      type(contact_t), allocatable :: contacts(:)
      integer :: k

      list%value = not_a_number()
      list%half = not_a_number()
      contacts = by_onset(run%contacts)
      contacts = pack(contacts, contacts%onset > from)
      if (size(run%contacts) > 0) list(statistic_rate) = mean_of_series(counts_in_bins(contacts%onset, from, until))
      list(statistic_speeds) = mean_of_some(contacts%impact_speed)
      list(statistic_peaks) = mean_of_some(pack(contacts%peak_force, ieee_is_finite(contacts%release_speed)))
      k = 1
      do while (k < run%n .and. run%t(min(k, run%n)) <= from)
         k = k + 1
      end do
      list(statistic_velocities) = root_mean_square(run, k, sort_velocities)
      list(statistic_reactions) = root_mean_square(run, k, sort_reactions)
   end subroutine statistics_of_run

   !> Contacts per time in each bin.
   pure function counts_in_bins(onsets, from, until) result(rate)
      real(wp), intent(in) :: onsets(:)     !! (n) times after `from` [s]
      real(wp), intent(in) :: from          !! start of the first bin [s]
      real(wp), intent(in) :: until         !! end of the last one [s]
      real(wp) :: rate(n_bin)               !! (n_bin) contacts per time [1/s]

      integer :: bin, k

      rate = 0.0_wp
      do k = 1, size(onsets)
         bin = min(n_bin, 1 + int(n_bin*(onsets(k) - from)/(until - from)))
         rate(bin) = rate(bin) + n_bin/(until - from)
      end do
   end function counts_in_bins

   !> The mean of a series, not known of nothing.
   pure type(estimate_t) function mean_of_some(x) result(estimate)
      real(wp), intent(in) :: x(:)      !! (n) values in their order [any]

      estimate%value = not_a_number()
      estimate%half = not_a_number()
      if (size(x) > 0) estimate = mean_of_series(x)
   end function mean_of_some

   !> Root mean square of all values of a sort.
   pure type(estimate_t) function root_mean_square(run, first, sort) result(estimate)
      class(kept_run_t), intent(in) :: run    !! the run
      integer, intent(in) :: first            !! instant that counts
      integer, intent(in) :: sort             !! the sort

      real(wp), allocatable :: square(:)
      integer :: i

      estimate%value = not_a_number()
      estimate%half = not_a_number()
      if (first > run%n .or. all(run%sort /= sort)) return
      allocate (square(first:run%n))
      do i = first, run%n
         square(i) = sum(run%values(:, i)**2, mask=run%sort == sort)/real(count(run%sort == sort), wp)
      end do
      estimate = mean_of_series(square)
      estimate%value = sqrt(estimate%value)
      if (ieee_is_finite(estimate%half) .and. estimate%value > 0.0_wp) estimate%half = 0.5_wp*estimate%half/estimate%value
   end function root_mean_square

   !> What the runs of a tolerance sweep report together, and how many of them are apart from the reference.
   pure subroutine gather_runs(reference, tol_sweep)
      type(statistics_t), intent(in) :: reference   !! statistics of the reference
      type(tol_sweep_t), intent(inout) :: tol_sweep       !! its statistics are set

      real(wp), allocatable :: values(:)
      logical, allocatable :: is_counted(:)
      integer :: k, s

      allocate (is_counted(size(tol_sweep%tol_runs)))
      do s = 1, n_statistic
         do k = 1, size(tol_sweep%tol_runs)
            is_counted(k) = tol_sweep%tol_runs(k)%statistics%is_own &
                 .and. ieee_is_finite(tol_sweep%tol_runs(k)%statistics%list(s)%value)
         end do
         values = pack([(tol_sweep%tol_runs(k)%statistics%list(s)%value, k=1, size(tol_sweep%tol_runs))], is_counted)
         tol_sweep%statistics%list(s) = mean_of_batches(values)
         tol_sweep%statistics%n_run(s) = size(values)
         tol_sweep%statistics%n_apart(s) = 0
         do k = 1, size(tol_sweep%tol_runs)
            if (.not. is_counted(k)) cycle
            if (is_apart(tol_sweep%tol_runs(k)%statistics%list(s), reference%list(s))) then
               tol_sweep%statistics%n_apart(s) = tol_sweep%statistics%n_apart(s) + 1
            end if
         end do
      end do
   end subroutine gather_runs

   !> Whether two estimates differ by more than their intervals allow.
   pure logical function is_apart(one, other)
      type(estimate_t), intent(in) :: one      !! an estimate
      type(estimate_t), intent(in) :: other    !! another one

      is_apart = .false.
      if (.not. (ieee_is_finite(one%half) .and. ieee_is_finite(other%half))) return
      is_apart = abs(one%value - other%value) > sqrt(one%half**2 + other%half**2)
   end function is_apart

end module precision_statistics
