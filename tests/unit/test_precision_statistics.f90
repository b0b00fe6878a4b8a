!> Statistics of runs beyond the time that is compared, against known means.
module test_precision_statistics
   use batch_means, only: estimate_t
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: contact_t, kept_run_t, sort_positions, sort_reactions, sort_velocities
   use kinds, only: not_a_number, wp
   use precision_results, only: n_statistic, precision_t, tol_run_done, tol_run_failed, statistic_peaks, statistic_rate, &
      statistic_reactions, statistic_speeds, statistic_velocities
   use precision_reference, only: kept_tol_sweep_t, reference_t
   use precision_statistics, only: statistics_of_run, take_statistics
   implicit none (type, external)
   private
   public :: run_test_precision_statistics

   integer, parameter :: n = 4001               !! instants
   real(wp), parameter :: finish = 100.0_wp     !! end of the motion [s]

contains

   !> Register the tests.
   subroutine run_test_precision_statistics(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("means", test_means)
      call suite%test("coverage", test_coverage)
      call suite%test("replications", test_replications)
   end subroutine run_test_precision_statistics

   !> A run of two bodies that swing, with a contact every `apart` seconds whose numbers are given by their time.
   subroutine make_run(amplitude, apart, run)
      real(wp), intent(in) :: amplitude      !! of a velocity [m/s]
      real(wp), intent(in) :: apart          !! time between contacts [s]
      type(kept_run_t), intent(out) :: run   !! the run

      integer :: k

      run%n = n
      run%sort = [sort_positions, sort_velocities, sort_velocities, sort_reactions]
      run%t = [(finish*(k - 1)/(n - 1), k=1, n)]
      allocate (run%values(4, n), source=0.0_wp)
      run%values(1, :) = 3.0_wp
      run%values(2, :) = amplitude*sin(7.0_wp*run%t)
      run%values(4, :) = -25.0_wp
      run%contacts = [(contact_t(1, (k - 0.5_wp)*apart, merge(1.0_wp, 3.0_wp, mod(k, 2) == 0), 10.0_wp, 0.5_wp), &
                       k=1, nint(finish/apart))]
   end subroutine make_run

   !> What does not scatter: means are known, and only what is behind the time counts.
   subroutine test_means(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(estimate_t) :: list(n_statistic)
      type(kept_run_t) :: run

      call make_run(8.0_wp, 0.5_wp, run)
      run%contacts(1)%peak_force = 1.0e9_wp
      run%contacts(200)%peak_force = 1.0e9_wp
      run%contacts(200)%release_speed = not_a_number()
      run%values(4, :100) = 1.0e9_wp
      call statistics_of_run(run, 20.0_wp, finish, list)
      call check_close(error, list(statistic_rate)%value, 2.0_wp, 1.0e-12_wp, "contacts per time")
      call check_close(error, list(statistic_speeds)%value, 2.0_wp, 1.0e-12_wp, "impact speed")
      call check_close(error, list(statistic_peaks)%value, 10.0_wp, 1.0e-12_wp, "peaks, without one that has not ended")
      call check_close(error, list(statistic_velocities)%value, 4.0_wp, 1.0e-2_wp, "8 sin of one of two: root of 64/2/2")
      call check_close(error, list(statistic_reactions)%value, 25.0_wp, 1.0e-12_wp, "reactions")
      call check_true(error, all(list%half < 0.1_wp*list%value), "what repeats itself scatters little")
      deallocate (run%contacts)
      allocate (run%contacts(0))
      run%sort = [sort_positions, sort_velocities, sort_velocities, sort_positions]
      call statistics_of_run(run, 20.0_wp, finish, list)
      call check_true(error, .not. any(ieee_is_finite(list([statistic_rate, statistic_speeds, statistic_reactions])%value)), &
                      "nothing is known of no contacts and no reactions")
   end subroutine test_means

   !> Contacts at random times with random speeds (Poisson, exponential): 95 % of the intervals hold rate and mean.
   subroutine test_coverage(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: samples = 400
      real(wp), parameter :: rate = 5.0_wp, mean = 0.7_wp
      type(estimate_t) :: list(n_statistic)
      type(kept_run_t) :: run
      real(wp) :: t, u(2)
      integer :: held(2), k, seed_size

      call random_seed(size=seed_size)
      call random_seed(put=[(12345 + k, k=1, seed_size)])
      call make_run(1.0_wp, 1.0_wp, run)
      held = 0
      do k = 1, samples
         run%contacts = [contact_t ::]
         t = 0.0_wp
         do
            call random_number(u)
            t = t - log(1.0_wp - u(1))/rate
            if (t > finish) exit
            run%contacts = [contact_t(1, t, -mean*log(1.0_wp - u(2)), 1.0_wp, 0.5_wp), run%contacts]
         end do
         call statistics_of_run(run, 0.3_wp*finish, finish, list)
         if (abs(list(statistic_rate)%value - rate) <= list(statistic_rate)%half) held(1) = held(1) + 1
         if (abs(list(statistic_speeds)%value - mean) <= list(statistic_speeds)%half) held(2) = held(2) + 1
      end do
      call check_true(error, all(held >= 0.92_wp*samples .and. held <= 0.98_wp*samples), "intervals of 95 % hold the truth")
   end subroutine test_coverage

   !> Runs that follow the reference do not count, runs that failed neither; one with another rate of contacts is apart.
   subroutine test_replications(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: apart(5) = [0.5_wp, 0.5_wp, 0.5_wp, 0.4_wp, 0.5_wp]
      real(wp), parameter :: amplitude(5) = [8.0_wp, 9.0_wp, 8.001_wp, 9.0_wp, 9.0_wp]
      type(kept_tol_sweep_t) :: kept(1)
      type(precision_t) :: study
      type(reference_t) :: reference
      integer :: k

      call make_run(8.0_wp, 0.5_wp, reference%run)
      reference%is_there = .true.
      reference%scale = [1.0_wp, 8.0_wp, 25.0_wp]
      study%end = finish
      study%reference%is_cut = .true.
      study%reference%window = 30.0_wp
      allocate (kept(1)%runs(5), study%tol_sweeps(1))
      allocate (study%tol_sweeps(1)%tol_runs(5))
      do k = 1, 5
         call make_run(amplitude(k), apart(k), kept(1)%runs(k))
      end do
      study%tol_sweeps(1)%tol_runs%state = [tol_run_done, tol_run_done, tol_run_done, tol_run_done, tol_run_failed]
      call take_statistics(kept, reference, study)
      call check_true(error, study%reference%statistics%is_there, "there is such a time")
      call check_close(error, study%reference%statistics%from, 30.0_wp, 0.0_wp, "it begins where runs are not compared")
      associate (tol_sweep => study%tol_sweeps(1))
         call check_true(error, all(tol_sweep%tol_runs%statistics%is_own .eqv. [.false., .true., .false., .true., .false.]), &
                         "own ways")
         call check_true(error, tol_sweep%statistics%n_run(statistic_rate) == 2, "two runs count")
         call check_true(error, tol_sweep%statistics%n_apart(statistic_rate) == 1, "one is apart")
         call check_close(error, tol_sweep%statistics%list(statistic_rate)%value, 2.25_wp, 1.0e-2_wp, "their mean")
      end associate
      study%reference%statistics%is_there = .false.
      study%reference%is_cut = .false.
      study%reference%is_unsure = .false.
      call take_statistics(kept, reference, study)
      call check_true(error, .not. study%reference%statistics%is_there, "none where all of the motion is compared")
   end subroutine test_replications

end module test_precision_statistics
