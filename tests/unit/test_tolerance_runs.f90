!> The dynamic level of tolerances: split of a variance, and studies of functions in place of runs, against closed forms.
module test_tolerance_runs
   use check, only: check_close, check_equal, check_true, suite_t
   use cost_allocation, only: cheapest_widths, sigma_for_yield
   use counter_random, only: uniform_at
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: i8, pi, wp
   use normal_distribution, only: normal_quantile
   use run_design, only: new_design, run_design_t
   use sample_moments, only: capability_of, sample_t
   use simulated_study, only: take_runs
   use tolerance_results, only: tolerance_study_t
   use tolerated, only: new_tolerance, shape_uniform
   use variance_split, only: split_t, split_variance
   implicit none (type, external)
   private
   public :: run_test_tolerance_runs

   integer, parameter :: of_linear = 1, of_ishigami = 2   ! functions
   integer, parameter :: normal = 1, uniform = 2, exponential = 3   ! distributions

contains

   !> Register the tests.
   subroutine run_test_tolerance_runs(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("split", test_split)
      call suite%test("coverage_of_splits", test_coverage)
      call suite%test("linear_runs", test_linear)
      call suite%test("ishigami_runs", test_ishigami)
      call suite%test("ensembles", test_ensembles)
      call suite%test("failed_runs", test_failed)
      call suite%test("capability", test_capability)
      call suite%test("yields_of_normal_numbers", test_sigma)
      call suite%test("cheapest_widths", test_cheapest)
      call suite%test("allocation", test_allocation)
   end subroutine run_test_tolerance_runs

   !> By hand: W = 2, B = 32, between (32 - 2)/2 = 15; no scatter within, none at all, negative difference of mean squares.
   subroutine test_split(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(split_t) :: split

      split = split_variance(reshape([1.0_wp, 3.0_wp, 5.0_wp, 7.0_wp, 9.0_wp, 11.0_wp], [2, 3]))
      call check_close(error, [split%motion, split%parts, split%share(1)], [2.0_wp, 15.0_wp, 2.0_wp/17.0_wp], 1.0e-14_wp, "by hand")
      if (allocated(error)) return
      call check_true(error, split%share(2) < 2.0_wp/17.0_wp .and. split%share(3) > 2.0_wp/17.0_wp, "interval")
      if (allocated(error)) return
      split = split_variance(reshape([1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 4.0_wp, 4.0_wp], [2, 3]))
      call check_close(error, split%share, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, "regular motion")
      if (allocated(error)) return
      split = split_variance(reshape([1.0_wp, 3.0_wp, 3.0_wp, 1.0_wp, 1.5_wp, 2.5_wp], [2, 3]))
      call check_close(error, split%share, [1.0_wp, 0.0_wp, 1.0_wp], 1.0e-15_wp, "equal parts")
      if (allocated(error)) return
      split = split_variance(reshape([2.0_wp, 2.0_wp, 2.0_wp, 2.0_wp, 2.0_wp, 2.0_wp], [2, 3]))
      call check_true(error, all(ieee_is_nan(split%share)), "no scatter")
   end subroutine test_split

   !> The interval of the share within has the known share in 95 +- 2 % of 1000 repeats.
   subroutine test_coverage(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: repeats = 1000, n_part = 40, n_start = 6
      real(wp), parameter :: shares(4) = [0.05_wp, 0.3_wp, 0.5_wp, 0.95_wp]
      integer, parameter :: of_parts(2) = [normal, uniform], of_motions(2) = [normal, exponential]
      type(split_t) :: split
      real(wp) :: held, x(n_start, n_part)
      integer :: i, j, k, r, which

      do which = 1, 2
         do k = 1, size(shares)
            if (which == 2 .and. k == 4) cycle   ! motions alone: the interval of an exponential variance
            held = 0.0_wp
            do r = 1, repeats
               do j = 1, n_part
                  x(:, j) = sqrt(1.0_wp - shares(k))*deviate(of_parts(which), uniform_at(r, 2*which, int(j, i8), k))
                  do i = 1, n_start
                     x(i, j) = x(i, j) + sqrt(shares(k))*deviate(of_motions(which), uniform_at(r, 10*i, int(j, i8), k))
                  end do
               end do
               split = split_variance(x)
               if (split%share(2) <= shares(k) .and. shares(k) <= split%share(3)) held = held + 1.0_wp/repeats
            end do
            call check_close(error, held, 0.95_wp, 0.02_wp, "intervals that hold")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_coverage

   !> A number with mean 0 and variance 1.
   pure real(wp) function deviate(which, u) result(x)
      integer, intent(in) :: which    !! its distribution
      real(wp), intent(in) :: u       !! between 0 and 1

      select case (which)
      case (normal)
         x = normal_quantile(u)
      case (uniform)
         x = sqrt(12.0_wp)*(u - 0.5_wp)
      case default
         x = -log(u) - 1.0_wp
      end select
   end function deviate

   !> A study of three uniform parameters, nominal 0.
   subroutine begin(members, points, n_start, half, study, design)
      integer, intent(in) :: members                    !! members
      integer, intent(in) :: points                     !! points of the indices
      integer, intent(in) :: n_start                    !! runs of a case
      real(wp), intent(in) :: half                      !! half the width of the tolerances
      type(tolerance_study_t), intent(out) :: study     !! made
      type(run_design_t), intent(out) :: design         !! its cases

      integer :: k

      allocate (study%plan%parameters(3), study%plan%batches(0), study%pins(0), study%requests(1), study%contributors(3))
      do k = 1, 3
         study%plan%parameters(k)%name = "abc"(k:k)
         study%contributors(k)%s = "abc"(k:k)
         call new_tolerance(study%plan%parameters(k), shape_uniform, -half, half, 1.0_wp, 0.0_wp)
      end do
      study%requests(1)%name = "f"
      study%requests(1)%unit = "1"
      study%plan%sampling%members = members
      study%plan%sampling%points = points
      study%plan%sampling%resamples = 200
      study%plan%sampling%bins = 10
      study%plan%sampling%seed = 5
      allocate (study%plan%costs(3), source=0.0_wp)
      call new_design(study, n_start, design)
   end subroutine begin

   !> Values of all cases.
   subroutine evaluate(which, design, noise, values, is_failed)
      integer, intent(in) :: which                            !! the function
      type(run_design_t), intent(in) :: design                !! the cases
      real(wp), intent(in) :: noise                           !! standard deviation of the starts
      real(wp), allocatable, intent(out) :: values(:, :, :)   !! (1, starts, cases) values
      logical, allocatable, intent(out) :: is_failed(:, :)    !! (starts, cases) none

      integer :: i, k

      allocate (values(1, design%n_start, size(design%deviations, 2)), source=0.0_wp)
      allocate (is_failed(design%n_start, size(values, 3)), source=.false.)
      do k = 1, size(values, 3)
         do i = 1, design%n_start
            associate (x => design%deviations(:, k))
               values(1, i, k) = 10.0_wp + 3.0_wp*x(1) - 2.0_wp*x(2) + x(3)
               if (which == of_ishigami) values(1, i, k) = sin(x(1)) + 7.0_wp*sin(x(2))**2 + 0.1_wp*x(3)**4*sin(x(1))
            end associate
            if (noise > 0.0_wp) values(1, i, k) = values(1, i, k) + noise*normal_quantile(uniform_at(3, i, int(k, i8), 0))
         end do
      end do
   end subroutine evaluate

   !> A linear function: derivatives, worst case, standard deviation and parts are exact, the yield holds its exact value.
   subroutine test_linear(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(run_design_t) :: design
      type(tolerance_study_t) :: study
      logical, allocatable :: is_failed(:, :)
      real(wp), allocatable :: values(:, :, :)

      call begin(2000, 500, 1, 0.1_wp, study, design)
      study%requests(1)%is_limited = .true.
      study%requests(1)%upper = 10.0_wp
      call evaluate(of_linear, design, 0.0_wp, values, is_failed)
      call check_equal(error, size(values, 3), 1 + 6 + 2000 + 5*500, "cases")
      if (allocated(error)) return
      call take_runs(study, design, 2.0_wp, values, is_failed)
      call check_close(error, study%slopes(:, 1, 1), [3.0_wp, -2.0_wp, 1.0_wp], 1.0e-13_wp, "derivatives")
      if (allocated(error)) return
      call check_close(error, [study%low(1, 1), study%high(1, 1)], [9.4_wp, 10.6_wp], 1.0e-13_wp, "worst case")
      if (allocated(error)) return
      call check_close(error, study%sigma(1, 1), 0.1_wp*sqrt(14.0_wp/3.0_wp), 1.0e-13_wp, "root sum square")
      if (allocated(error)) return
      call check_close(error, study%errors(1), 0.0_wp, 1.0e-13_wp, "error of the expansion")
      if (allocated(error)) return
      call check_true(error, study%members%yields(1)%low < 0.5_wp .and. study%members%yields(1)%high > 0.5_wp, "yield")
      if (allocated(error)) return
      call check_equal(error, int(sum(study%members%counts(:, 1))), 2000, "histogram")
      if (allocated(error)) return
      call check_indices(study, [9.0_wp, 4.0_wp, 1.0_wp]/14.0_wp, [9.0_wp, 4.0_wp, 1.0_wp]/14.0_wp, error)
   end subroutine test_linear

   !> Indices lie within twice their stated error of exact ones.
   subroutine check_indices(study, first, total, error)
      type(tolerance_study_t), intent(in) :: study       !! the study
      real(wp), intent(in) :: first(3)                   !! (3) exact indices
      real(wp), intent(in) :: total(3)                   !! (3) exact total ones
      type(error_t), allocatable, intent(out) :: error   !! what failed

      integer :: k

      do k = 1, 3
         associate (s => study%indices%first(:, k, 1, 1), t => study%indices%total(:, k, 1, 1))
            call check_close(error, s(1), first(k), s(3) - s(2), "index")
            if (allocated(error)) return
            call check_close(error, t(1), total(k), t(3) - t(2), "total index")
            if (allocated(error)) return
            call check_true(error, s(3) - s(2) < 0.5_wp .and. t(3) - t(2) < 0.5_wp, "stated errors")
            if (allocated(error)) return
         end associate
      end do
   end subroutine check_indices

   !> Ishigami's function: exact indices, mean a/2 = 3.5.
   subroutine test_ishigami(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: v1 = 0.5_wp*(1.0_wp + 0.1_wp*pi**4/5.0_wp)**2, v2 = 49.0_wp/8.0_wp
      real(wp), parameter :: v13 = 0.01_wp*pi**8*(1.0_wp/18.0_wp - 1.0_wp/50.0_wp), v = v1 + v2 + v13
      type(run_design_t) :: design
      type(tolerance_study_t) :: study
      logical, allocatable :: is_failed(:, :)
      real(wp), allocatable :: values(:, :, :)

      call begin(2000, 1000, 1, pi, study, design)
      call evaluate(of_ishigami, design, 0.0_wp, values, is_failed)
      call take_runs(study, design, 2.0_wp, values, is_failed)
      call check_indices(study, [v1, v2, 0.0_wp]/v, [v1 + v13, v2, v13]/v, error)
      if (allocated(error)) return
      call check_close(error, study%members%mean(1, 1), 3.5_wp, 2.0_wp*study%members%mean_half(1, 1), "mean")
      if (allocated(error)) return
      call check_close(error, study%members%sigma(1, 1), sqrt(v), 0.2_wp, "standard deviation")
   end subroutine test_ishigami

   !> Noise of the starts: the split has it, and the plane of least squares has the derivatives.
   subroutine test_ensembles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: noise = 0.3_wp, parts = 0.01_wp*14.0_wp/3.0_wp
      type(run_design_t) :: design
      type(tolerance_study_t) :: study
      logical, allocatable :: is_failed(:, :)
      real(wp), allocatable :: values(:, :, :)

      call begin(300, 100, 5, 0.1_wp, study, design)
      call evaluate(of_linear, design, noise, values, is_failed)
      call check_equal(error, size(values, 3), 1 + 300, "cases")
      if (allocated(error)) return
      call take_runs(study, design, 2.0_wp, values, is_failed)
      associate (share => study%splits(1)%share, exact => noise**2/(noise**2 + parts))
         call check_close(error, share(1), exact, share(3) - share(2), "share within")
         if (allocated(error)) return
         call check_true(error, share(3) - share(2) < 0.2_wp, "stated error")
         if (allocated(error)) return
      end associate
      call check_close(error, study%slopes(:, 1, 1), [3.0_wp, -2.0_wp, 1.0_wp], 0.45_wp, "plane")   ! 3 s of noise/sqrt(1500 var x)
      if (allocated(error)) return
      call check_true(error, all(ieee_is_nan(study%indices%first)), "no indices")
   end subroutine test_ensembles

   !> Failed runs count as failed parts, and have no part in moments, derivatives or splits.
   subroutine test_failed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(run_design_t) :: design
      type(tolerance_study_t) :: study
      logical, allocatable :: is_failed(:, :)
      real(wp), allocatable :: values(:, :, :)

      call begin(100, 20, 1, 0.1_wp, study, design)
      study%requests(1)%is_limited = .true.
      study%requests(1)%upper = 1000.0_wp
      call evaluate(of_linear, design, 0.0_wp, values, is_failed)
      is_failed(1, design%member(3)) = .true.
      is_failed(1, design%point(2, 7)) = .true.
      is_failed(1, design%beside(2, 1)) = .true.
      values(:, 1, design%member(3)) = 0.0_wp
      call take_runs(study, design, 2.0_wp, values, is_failed)
      call check_equal(error, int(study%members%open), 1, "failed member")
      if (allocated(error)) return
      call check_equal(error, int(study%members%yield%good), 99, "yield")
      if (allocated(error)) return
      call check_true(error, study%members%lowest(1, 1) > 9.0_wp, "moments")
      if (allocated(error)) return
      call check_equal(error, study%indices%points, 19, "points")
      if (allocated(error)) return
      call check_equal(error, int(study%indices%open), 1, "omitted points")
      if (allocated(error)) return
      call check_close(error, study%slopes(:, 1, 1), [3.0_wp, 0.0_wp, 1.0_wp], 1.0e-12_wp, "derivatives")
      if (allocated(error)) return
      call check_true(error, .not. study%derivatives%has_curvatures, "a warning follows")
   end subroutine test_failed

   !> Cpk by hand, of one limit and of a mean beyond it; its interval holds in 95 +- 2 % of 1000 repeats.
   subroutine test_capability(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: repeats = 1000, n = 200
      real(wp), parameter :: means(2) = [0.0_wp, 0.7_wp], exact(2) = [1.0_wp, 2.3_wp/3.0_wp]
      type(sample_t) :: sample
      real(wp) :: half, held, interval(2), mean, of(3), sigma
      integer :: k, m, r

      of = capability_of(1.0_wp, 0.5_wp, 100_i8, -2.0_wp, 2.5_wp)
      call check_close(error, of(1), 1.0_wp, 1.0e-14_wp, "next to the upper limit")
      if (allocated(error)) return
      of = capability_of(1.0_wp, 0.5_wp, 100_i8, -huge(1.0_wp), 0.25_wp)
      call check_close(error, of(1), -0.5_wp, 1.0e-14_wp, "beyond the only limit")
      if (allocated(error)) return
      of = capability_of(1.0_wp, 0.0_wp, 100_i8, -2.0_wp, 2.5_wp)
      call check_true(error, all(ieee_is_nan(of)), "no scatter")
      if (allocated(error)) return
      do k = 1, size(means)
         held = 0.0_wp
         do r = 1, repeats
            sample = sample_t(reference=0.1_wp)
            call sample%add([(means(k) + normal_quantile(uniform_at(r, 7, int(m, i8), k)), m=1, n)])
            call sample%moments(mean, half, sigma, interval)
            of = capability_of(mean, sigma, int(n, i8), -3.0_wp, 3.0_wp)
            if (of(2) <= exact(k) .and. exact(k) <= of(3)) held = held + 1.0_wp/repeats
         end do
         call check_close(error, held, 0.95_wp, 0.02_wp, "intervals that hold")
         if (allocated(error)) return
      end do
   end subroutine test_capability

   !> Standard deviations of yields: 3 on both sides for 0.9973002039367398, one side, between; a mean beyond a limit.
   subroutine test_sigma(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_close(error, sigma_for_yield(-0.6_wp, 0.6_wp, 0.9973002039367398_wp), 0.2_wp, 1.0e-12_wp, "both sides")
      if (allocated(error)) return
      call check_close(error, sigma_for_yield(-huge(1.0_wp), 0.6_wp, 0.9986501019683699_wp), 0.2_wp, 1.0e-12_wp, "one side")
      if (allocated(error)) return
      call check_close(error, sigma_for_yield(-0.2_wp, 0.6_wp, 0.9986501019683699_wp - 0.15865525393145707_wp), 0.2_wp, &
                       1.0e-12_wp, "mean off the middle")
      if (allocated(error)) return
      call check_close(error, sigma_for_yield(0.1_wp, 0.6_wp, 0.9_wp), 0.0_wp, 1.0e-15_wp, "mean beyond a limit")
   end subroutine test_sigma

   !> The solution of Lagrange by hand; no widths nearby with the same variance are cheaper; widths without a cost stay.
   subroutine test_cheapest(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: costs(3) = [8.0_wp, 1.0_wp, 0.0_wp], parts(3) = [1.0_wp, 1.0_wp, 0.5_wp]
      real(wp) :: angle, cost, f(3), other, r
      integer :: k

      ! w = 2, 1: f = sqrt((5.5 - 0.5)/5) (2, 1)
      call cheapest_widths(costs, parts, 5.5_wp, f, cost)
      call check_close(error, f, [2.0_wp, 1.0_wp, 1.0_wp], 1.0e-14_wp, "factors")
      if (allocated(error)) return
      call check_close(error, cost, 5.0_wp, 1.0e-14_wp, "cost")
      if (allocated(error)) return
      r = sqrt(5.0_wp)
      do k = 1, 99
         angle = 0.5_wp*pi*k/100
         other = costs(1)/(r*cos(angle)) + costs(2)/(r*sin(angle))
         call check_true(error, other >= cost*(1.0_wp - 1.0e-12_wp), "others cost more")
         if (allocated(error)) return
      end do
      call cheapest_widths(costs, parts, 0.4_wp, f, cost)
      call check_true(error, all(ieee_is_nan(f)) .and. ieee_is_nan(cost), "what has no cost scatters too much")
   end subroutine test_cheapest

   !> Of a linear function: with the cheapest widths the root sum square is that of the yield.
   subroutine test_allocation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(run_design_t) :: design
      type(tolerance_study_t) :: study
      logical, allocatable :: is_failed(:, :)
      real(wp), allocatable :: values(:, :, :)

      call begin(20, 10, 1, 0.1_wp, study, design)
      study%requests(1)%is_limited = .true.
      study%requests(1)%lower = 9.7_wp
      study%requests(1)%upper = 10.3_wp
      study%plan%costs = [1.0_wp, 1.0_wp, 1.0_wp]
      study%plan%sampling%target = 0.9973002039367398_wp
      call evaluate(of_linear, design, 0.0_wp, values, is_failed)
      call take_runs(study, design, 2.0_wp, values, is_failed)
      associate (one => study%allocations(1))
         call check_close(error, one%sigma, 0.1_wp, 1.0e-10_wp, "standard deviation")
         if (allocated(error)) return
         call check_close(error, sqrt(sum(study%parts(:, 1, 1)*one%factors**2)), 0.1_wp, 1.0e-10_wp, "root sum square")
         if (allocated(error)) return
         call check_close(error, one%factors(1)/one%factors(3), 9.0_wp**(-1.0_wp/3.0_wp), 1.0e-10_wp, "ratio of widths")
      end associate
   end subroutine test_allocation

end module test_tolerance_runs
