!> Tolerances: random numbers, distributions, fits, Sobol' indices, intervals, against published values and closed forms.
module test_tolerance
   use check, only: check_close, check_equal, check_true, suite_t
   use counter_random, only: random_order, threefry, uniform_at
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use extrapolation, only: extrapolated, n_step, step_of
   use iso_fits, only: class_limits, read_fit
   use kinds, only: i8, pi, wp
   use normal_distribution, only: normal_density, normal_probability, normal_quantile, wilson_interval
   use sample_moments, only: sample_t
   use sobol_indices, only: find_indices, resample_weights
   use tolerated, only: new_fit, new_tolerance, shape_lognormal, shape_normal, shape_triangular, shape_truncated, &
      shape_two_point, shape_uniform, tolerated_t
   implicit none (type, external)
   private
   public :: run_test_tolerance

   integer, parameter :: of_linear = 1, of_ishigami = 2, of_g = 3   ! functions

contains

   !> Register the tests.
   subroutine run_test_tolerance(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("counter_random", test_random)
      call suite%test("normal_quantiles", test_quantiles)
      call suite%test("wilson", test_wilson)
      call suite%test("distributions", test_distributions)
      call suite%test("fits", test_fits)
      call suite%test("extrapolation", test_extrapolation)
      call suite%test("indices_linear", test_linear)
      call suite%test("indices_ishigami", test_ishigami)
      call suite%test("indices_g_function", test_g_function)
      call suite%test("indices_of_a_constant", test_constant)
      call suite%test("coverage_of_moments", test_moments)
      call suite%test("coverage_of_yields", test_yields)
      call suite%test("coverage_of_indices", test_indices)
   end subroutine run_test_tolerance

   !> Known answers of Random123; uniform moments; an order is one, and depends on its index.
   subroutine test_random(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer(i8), parameter :: all_ones = 4294967295_i8
      integer, parameter :: n = 20000
      real(wp), allocatable :: u(:)
      integer :: k, order(100), other(100)

      call check_true(error, all(threefry([0_i8, 0_i8], [0_i8, 0_i8]) == [int(z'6b200159', i8), int(z'99ba4efe', i8)]), "zeros")
      if (allocated(error)) return
      call check_true(error, all(threefry([all_ones, all_ones], [all_ones, all_ones]) == &
                                 [int(z'1cb996fc', i8), int(z'bb002be7', i8)]), "ones")
      if (allocated(error)) return
      call check_true(error, all(threefry([int(z'13198a2e', i8), int(z'03707344', i8)], &
                                          [int(z'243f6a88', i8), int(z'85a308d3', i8)]) == &
                                 [int(z'c4923a9c', i8), int(z'483df7a0', i8)]), "digits of pi")
      if (allocated(error)) return
      u = [(uniform_at(7, 1, int(k, i8), 0), k=1, n)]
      call check_true(error, all(u > 0.0_wp) .and. all(u < 1.0_wp), "between 0 and 1")
      if (allocated(error)) return
      call check_close(error, sum(u)/n, 0.5_wp, 4.0_wp/sqrt(12.0_wp*n), "mean")
      if (allocated(error)) return
      call check_close(error, sum((u - 0.5_wp)**2)/n, 1.0_wp/12.0_wp, 4.0_wp*sqrt(1.0_wp/180.0_wp/n), "variance")
      if (allocated(error)) return
      call random_order(7, 2, 0, order)
      call random_order(7, 2, 1, other)
      call check_true(error, all([(count(order == k) == 1, k=1, 100)]) .and. any(order /= other), "order")
   end subroutine test_random

   !> Quantiles invert the distribution function into the tails.
   subroutine test_quantiles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: p
      integer :: k

      call check_close(error, normal_quantile(0.975_wp), 1.959963984540054_wp, 1.0e-14_wp, "0.975")
      if (allocated(error)) return
      call check_close(error, normal_quantile(0.5_wp), 0.0_wp, 1.0e-16_wp, "median")
      if (allocated(error)) return
      do k = 1, 300, 7
         p = 10.0_wp**(-k)
         call check_close(error, normal_probability(normal_quantile(p)), p, 1.0e-12_wp*max(k, 10)/10.0_wp, "inverse", .true.)
         if (allocated(error)) return
      end do
      call check_close(error, normal_density(1.0_wp), 0.24197072451914337_wp, 1.0e-15_wp, "density")
   end subroutine test_quantiles

   !> Wilson's interval: published example (10 of 20: 0.299 to 0.701), and its ends.
   subroutine test_wilson(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: interval(2)

      interval = wilson_interval(10_i8, 20_i8)
      call check_close(error, interval, [0.29929_wp, 0.70071_wp], 1.0e-5_wp, "10 of 20")
      if (allocated(error)) return
      interval = wilson_interval(20_i8, 20_i8)
      call check_close(error, interval, [0.83887_wp, 1.0_wp], 1.0e-5_wp, "20 of 20")
   end subroutine test_wilson

   !> Mean and standard deviation of each distribution are those of its quantiles, and its values are within its limits.
   subroutine test_distributions(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 200000
      integer, parameter :: shapes(7) = [shape_normal, shape_truncated, shape_uniform, shape_triangular, shape_lognormal, &
                                         shape_two_point, shape_truncated]
      real(wp), parameter :: cp(7) = [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 0.4_wp, 1.0_wp, 0.5_wp]
      real(wp), parameter :: shift(7) = [0.3_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.2_wp, 0.0_wp, 0.7_wp]
      type(tolerated_t) :: parameter
      real(wp), allocatable :: x(:)
      integer :: k, m

      parameter%name = "p"
      parameter%nominal = 4.0_wp
      do k = 1, size(shapes)
         call new_tolerance(parameter, shapes(k), -1.5_wp, 1.5_wp, cp(k), shift(k))
         x = [(parameter%deviation([(m - 0.5_wp)/n, 0.5_wp]), m=1, n)]
         call check_close(error, sum(x)/n, parameter%mean, 1.0e-5_wp, "mean")
         if (allocated(error)) return
         call check_close(error, sqrt(sum((x - parameter%mean)**2)/n), parameter%sigma, 3.0e-4_wp, "standard deviation")
         if (allocated(error)) return
         if (any(shapes(k) == [shape_normal, shape_lognormal])) cycle
         call check_true(error, all(abs(x) <= 1.5_wp), "within the limits")
         if (allocated(error)) return
      end do
      call check_close(error, parameter%mean, 0.3716566167612084_wp, 1.0e-12_wp, "shifted process: scipy.stats.truncnorm")
   end subroutine test_distributions

   !> Classes and fits of the standard; clearances of a fit.
   subroutine test_fits(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 400
      character(5), parameter :: bad(6) = [character(5) :: "H7/k6", "f7/H7", "H4", "K7", "H7/f", "7"]
      character(:), allocatable :: message
      type(tolerated_t) :: parameter
      real(wp) :: limits(2), both(2, 2), x
      integer :: classes, k, m
      real(wp) :: square, total

      call class_limits("H7", 20.0e-3_wp, limits, message)
      call check_close(error, limits*1.0e6_wp, [0.0_wp, 21.0_wp], 1.0e-9_wp, "20 H7")
      if (allocated(error)) return
      call class_limits("f7", 30.0e-3_wp, limits, message)
      call check_close(error, limits*1.0e6_wp, [-41.0_wp, -20.0_wp], 1.0e-9_wp, "30 f7: up to and with 30 mm")
      if (allocated(error)) return
      call class_limits("js6", 100.0e-3_wp, limits, message)
      call check_close(error, limits*1.0e6_wp, [-11.0_wp, 11.0_wp], 1.0e-9_wp, "100 js6")
      if (allocated(error)) return
      call class_limits("E11", 450.0e-3_wp, limits, message)
      call check_close(error, limits*1.0e6_wp, [135.0_wp, 535.0_wp], 1.0e-9_wp, "450 E11")
      if (allocated(error)) return
      call read_fit("H7/f7", 20.0e-3_wp, classes, both, message)
      call check_equal(error, message, "", "H7/f7")
      if (allocated(error)) return
      parameter%nominal = 20.0e-6_wp
      call new_fit(parameter, both(:, 1), both(:, 2), 1.0_wp)
      call check_close(error, [parameter%lower, parameter%upper]*1.0e6_wp, [-10.0_wp, 11.0_wp], 1.0e-9_wp, "10 to 31 um")
      if (allocated(error)) return
      total = 0.0_wp
      square = 0.0_wp
      do k = 1, n
         do m = 1, n
            x = parameter%deviation([(k - 0.5_wp)/n, (m - 0.5_wp)/n])
            total = total + x/n**2
            square = square + x**2/n**2
         end do
      end do
      call check_close(error, total, parameter%mean, 1.0e-4_wp*parameter%sigma, "mean clearance")
      if (allocated(error)) return
      call check_close(error, sqrt(square - total**2), parameter%sigma, 1.0e-3_wp, "its standard deviation", .true.)
      if (allocated(error)) return
      do k = 1, 6
         call read_fit(trim(bad(k)), 20.0e-3_wp, classes, both, message)
         call check_true(error, message /= "", "refused")
         if (allocated(error)) return
      end do
      call read_fit("H7/f7", 600.0e-3_wp, classes, both, message)
      call check_true(error, index(message, "500 mm") > 0, "too large")
   end subroutine test_fits

   !> Derivatives of functions that are not polynomials.
   subroutine test_extrapolation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: x = 0.7_wp, h = 0.04_wp
      real(wp) :: ahead(3, n_step), behind(3, n_step), s
      integer :: l, side

      do l = 1, n_step
         do side = 1, 2
            s = x + merge(1.0_wp, -1.0_wp, side == 1)*step_of(h, l)
            if (side == 1) ahead(:, l) = [sin(s), exp(s), 1.0_wp/s]
            if (side == 2) behind(:, l) = [sin(s), exp(s), 1.0_wp/s]
         end do
      end do
      call check_close(error, extrapolated(ahead, behind, h), [cos(x), exp(x), -1.0_wp/x**2], 1.0e-12_wp, "derivatives")
   end subroutine test_extrapolation

   !> A function of uniform numbers.
   pure real(wp) function value_of(which, u) result(f)
      integer, intent(in) :: which      !! one of the above
      real(wp), intent(in) :: u(:)      !! (3) between 0 and 1

      real(wp), parameter :: g(3) = [0.0_wp, 1.0_wp, 4.5_wp]
      real(wp) :: x(3)

      select case (which)
      case (of_linear)
         f = 10.0_wp + 3.0_wp*u(1) - 2.0_wp*u(2) + u(3)
      case (of_ishigami)
         x = pi*(2.0_wp*u(1:3) - 1.0_wp)
         f = sin(x(1)) + 7.0_wp*sin(x(2))**2 + 0.1_wp*x(3)**4*sin(x(1))
      case default
         f = product((abs(4.0_wp*u(1:3) - 2.0_wp) + g)/(1.0_wp + g))
      end select
   end function value_of

   !> Indices of a function.
   subroutine indices_of(which, n, resamples, seed, first, total)
      integer, intent(in) :: which            !! the function
      integer, intent(in) :: n                !! points
      integer, intent(in) :: resamples        !! for the intervals
      integer, intent(in) :: seed             !! of the random numbers
      real(wp), intent(out) :: first(3, 3)    !! (3, 3) value, interval
      real(wp), intent(out) :: total(3, 3)    !! (3, 3) the same of total indices

      real(wp), allocatable :: a(:), ab(:, :), b(:), weights(:, :)
      real(wp) :: u(3), v(3), w(3)
      integer :: k, m

      allocate (a(n), ab(n, 3), b(n))
      do m = 1, n
         u = [(uniform_at(seed, 3, int(m, i8), k), k=1, 3)]
         v = [(uniform_at(seed, 4, int(m, i8), k), k=1, 3)]
         a(m) = value_of(which, u)
         b(m) = value_of(which, v)
         do k = 1, 3
            w = u
            w(k) = v(k)
            ab(m, k) = value_of(which, w)
         end do
      end do
      allocate (weights(n, resamples))
      call resample_weights(seed, 5, weights)
      call find_indices(a, b, ab, weights, first, total)
   end subroutine indices_of

   !> Indices must lie within twice their stated error (half the interval of 95 %) of the exact ones, and that must be small.
   subroutine check_indices(which, n, exact_first, exact_total, limit, error)
      integer, intent(in) :: which                        !! the function
      integer, intent(in) :: n                            !! points
      real(wp), intent(in) :: exact_first(3)              !! (3) exact indices
      real(wp), intent(in) :: exact_total(3)              !! (3) exact total indices
      real(wp), intent(in) :: limit                       !! largest error that is stated
      type(error_t), allocatable, intent(out) :: error    !! what failed

      real(wp) :: first(3, 3), total(3, 3)
      integer :: k

      call indices_of(which, n, 200, 11, first, total)
      do k = 1, 3
         call check_close(error, first(1, k), exact_first(k), first(3, k) - first(2, k), "index")
         if (allocated(error)) return
         call check_close(error, total(1, k), exact_total(k), total(3, k) - total(2, k), "total index")
         if (allocated(error)) return
      end do
      call check_true(error, all(first(3, :) - first(2, :) < limit) .and. all(total(3, :) - total(2, :) < limit), "stated errors")
   end subroutine check_indices

   !> A linear model: parts of the variance; total indices are the same.
   subroutine test_linear(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: exact(3) = [9.0_wp, 4.0_wp, 1.0_wp]/14.0_wp

      call check_indices(of_linear, 4000, exact, exact, 0.12_wp, error)
   end subroutine test_linear

   !> Ishigami's function with a = 7, b = 0.1: V = a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2.
   subroutine test_ishigami(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: a = 7.0_wp, b = 0.1_wp
      real(wp), parameter :: v = a**2/8.0_wp + b*pi**4/5.0_wp + b**2*pi**8/18.0_wp + 0.5_wp
      real(wp), parameter :: v1 = 0.5_wp*(1.0_wp + b*pi**4/5.0_wp)**2, v2 = a**2/8.0_wp
      real(wp), parameter :: v13 = b**2*pi**8*(1.0_wp/18.0_wp - 1.0_wp/50.0_wp)

      call check_close(error, [v1, v2]/v, [0.3139_wp, 0.4424_wp], 5.0e-5_wp, "published indices")
      if (allocated(error)) return
      call check_indices(of_ishigami, 4000, [v1, v2, 0.0_wp]/v, [v1 + v13, v2, v13]/v, 0.15_wp, error)
   end subroutine test_ishigami

   !> The G-function with a = 0, 1, 4.5: V_i = 1/(3 (1 + a_i)^2), V = product(1 + V_i) - 1.
   subroutine test_g_function(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: parts(3) = 1.0_wp/(3.0_wp*(1.0_wp + [0.0_wp, 1.0_wp, 4.5_wp])**2)
      real(wp) :: v

      v = product(1.0_wp + parts) - 1.0_wp
      call check_indices(of_g, 4000, parts/v, parts*product(1.0_wp + parts)/(1.0_wp + parts)/v, 0.15_wp, error)
   end subroutine test_g_function

   !> Where nothing scatters there are no indices.
   subroutine test_constant(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: a(50), ab(50, 2), first(3, 2), total(3, 2), weights(50, 20)

      a = 1.0_wp/3.0_wp
      ab = 1.0_wp/3.0_wp
      call resample_weights(1, 5, weights)
      call check_true(error, all(nint(sum(weights, dim=1)) == 50), "resamples have as many points")
      if (allocated(error)) return
      call find_indices(a, a, ab, weights, first, total)
      call check_true(error, all(ieee_is_nan(first)) .and. all(ieee_is_nan(total)), "no indices")
   end subroutine test_constant

   !> Intervals of mean and standard deviation hold in 95 +- 2 % of 1000 repeats, of normal, uniform and triangular parameters.
   subroutine test_moments(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: repeats = 1000, n = 400
      integer, parameter :: shapes(3) = [shape_normal, shape_uniform, shape_triangular]
      type(sample_t) :: sample
      type(tolerated_t) :: parameter
      real(wp) :: half, interval(2), mean, sigma, x(n)
      integer :: held(2), k, m, r

      parameter%nominal = 5.0_wp
      do k = 1, size(shapes)
         call new_tolerance(parameter, shapes(k), -1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp)
         held = 0
         do r = 1, repeats
            x = [(parameter%deviation([uniform_at(100 + r, 1, int(m, i8), k), 0.5_wp]), m=1, n)]
            sample = sample_t(reference=0.1_wp)
            call sample%add(x(:100))
            call sample%add(x(101:))
            call sample%moments(mean, half, sigma, interval)
            if (abs(mean - parameter%mean) <= half) held(1) = held(1) + 1
            if (parameter%sigma >= interval(1) .and. parameter%sigma <= interval(2)) held(2) = held(2) + 1
         end do
         call check_close(error, real(held, wp)/repeats, [0.95_wp, 0.95_wp], 0.02_wp, "intervals that hold")
         if (allocated(error)) return
      end do
   end subroutine test_moments

   !> Intervals of the yield hold in 95 +- 2 % of 1000 repeats.
   subroutine test_yields(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: repeats = 1000, n = 500
      real(wp), parameter :: yields(3) = [0.5_wp, 0.9_wp, 0.97_wp]
      real(wp) :: interval(2)
      integer :: held, k, m, r

      do k = 1, size(yields)
         held = 0
         do r = 1, repeats
            interval = wilson_interval(int(count([(uniform_at(200 + r, 1, int(m, i8), k) < yields(k), m=1, n)]), i8), int(n, i8))
            if (yields(k) >= interval(1) .and. yields(k) <= interval(2)) held = held + 1
         end do
         call check_close(error, real(held, wp)/repeats, 0.95_wp, 0.02_wp, "intervals that hold")
         if (allocated(error)) return
      end do
   end subroutine test_yields

   !> Intervals of both indices hold in 95 +- 2 % of 1000 repeats, of a linear model.
   subroutine test_indices(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: repeats = 1000
      real(wp), parameter :: exact(3) = [9.0_wp, 4.0_wp, 1.0_wp]/14.0_wp
      real(wp) :: first(3, 3), total(3, 3)
      integer :: held(3, 2), r

      held = 0
      do r = 1, repeats
         call indices_of(of_linear, 300, 150, 300 + r, first, total)
         where (exact >= first(2, :) .and. exact <= first(3, :)) held(:, 1) = held(:, 1) + 1
         where (exact >= total(2, :) .and. exact <= total(3, :)) held(:, 2) = held(:, 2) + 1
      end do
      call check_close(error, reshape(real(held, wp)/repeats, [6]), [0.95_wp, 0.95_wp, 0.95_wp, 0.95_wp, 0.95_wp, 0.95_wp], &
                       0.02_wp, "intervals that hold")
   end subroutine test_indices

end module test_tolerance
