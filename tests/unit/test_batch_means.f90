!> Means of series that remember, with intervals by batches.
module test_batch_means
   use batch_means, only: estimate_t, fewest_batches, mean_of_series, means_of_batches, student
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_batch_means

contains

   !> Register the tests.
   subroutine run_test_batch_means(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("student", test_student)
      call suite%test("slope", test_slope)
      call suite%test("coverage", test_coverage)
      call suite%test("few", test_few)
   end subroutine run_test_batch_means

   !> Quantiles as in tables (Abramowitz and Stegun, table 26.10).
   subroutine test_student(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: freedom(7) = [1, 4, 5, 7, 10, 30, 120]
      real(wp), parameter :: t(7) = [12.706_wp, 2.776_wp, 2.571_wp, 2.365_wp, 2.228_wp, 2.042_wp, 1.980_wp]
      integer :: k

      do k = 1, size(t)
         call check_close(error, student(freedom(k)), t(k), 1.0e-3_wp, "t 0.975")
         if (allocated(error)) return
      end do
   end subroutine test_student

   !> Increments of a straight line that also swings: the mean of a batch is the slope, the swing is omitted; without weights it
   !> is not.
   subroutine test_slope(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 40000
      real(wp), parameter :: slope = -0.25_wp, h = 0.01_wp
      real(wp), allocatable :: y(:)
      type(estimate_t) :: plain, smooth
      integer :: k

      allocate (y(0:n))
      y = [(slope*k*h + cos(7.3_wp*k*h), k=0, n)]
      smooth = mean_of_series((y(1:) - y(:n - 1))/h, is_increment=.true.)
      plain = mean_of_series((y(1:) - y(:n - 1))/h)
      call check_close(error, smooth%value, slope, smooth%half, "slope")
      if (allocated(error)) return
      call check_true(error, smooth%half < 0.2_wp*plain%half .and. smooth%half < 0.02_wp, "weights leave the swing out")
   end subroutine test_slope

   !> An autoregressive series x' = a x + noise: of many intervals of its mean about 95 % hold 0, and the effective number of
   !> values is n (1 - a)/(1 + a).
   subroutine test_coverage(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 8192, runs = 400
      real(wp), parameter :: a = 0.8_wp
      real(wp) :: effective, noise(n), x(n)
      type(estimate_t) :: estimate
      integer :: i, k, n_seed, within

      call random_seed(size=n_seed)
      call random_seed(put=[(17*i + 3, i=1, n_seed)])
      within = 0
      effective = 0.0_wp
      do k = 1, runs
         call random_number(noise)
         noise = noise - 0.5_wp
         x(1) = 0.0_wp
         do i = 2, n
            x(i) = a*x(i - 1) + noise(i)
         end do
         estimate = mean_of_series(x)
         if (abs(estimate%value) <= estimate%half) within = within + 1
         effective = effective + estimate%n_effective/runs
      end do
      call check_close(error, real(within, wp)/runs, 0.95_wp, 0.035_wp, "coverage")
      if (allocated(error)) return
      call check_close(error, effective, n*(1.0_wp - a)/(1.0_wp + a), 0.25_wp*n*(1.0_wp - a)/(1.0_wp + a), "effective number")
   end subroutine test_coverage

   !> Batches are the last values in their order; too few of them have no interval.
   subroutine test_few(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(estimate_t) :: estimate
      integer :: k

      call check_true(error, all(abs(means_of_batches([9.0_wp, 1.0_wp, 3.0_wp, 5.0_wp, 7.0_wp], 2) - [2.0_wp, 6.0_wp]) < &
                                 1.0e-15_wp), "batches")
      if (allocated(error)) return
      estimate = mean_of_series([(real(k, wp), k=1, fewest_batches - 1)])
      call check_true(error, ieee_is_nan(estimate%half), "no interval")
   end subroutine test_few

end module test_batch_means
