!> Sobol' points and polynomials through members, against their definitions and closed forms.
module test_sparse_polynomial
   use check, only: check_close, check_equal, check_true, suite_t
   use counter_random, only: uniform_at
   use errors, only: error_t
   use gauss_points, only: five_places, five_weights, n_five
   use kinds, only: i8, pi, wp
   use normal_distribution, only: normal_quantile
   use orthogonal_polynomials, only: family_t, max_degree, new_family
   use sobol_points, only: most_dimensions, sobol_t
   use sparse_polynomial, only: fit_polynomial, polynomial_t
   implicit none (type, external)
   private
   public :: run_test_sparse_polynomial

contains

   !> Register the tests.
   subroutine run_test_sparse_polynomial(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("sobol_points_fill_each_interval", test_intervals)
      call suite%test("sobol_points_fill_each_rectangle", test_rectangles)
      call suite%test("sobol_points_integrate", test_integral)
      call suite%test("orthonormal_polynomials", test_families)
      call suite%test("polynomial_is_found", test_exact)
      call suite%test("indices_of_ishigami_by_polynomial", test_ishigami)
      call suite%test("noise_is_missed", test_noise)
   end subroutine run_test_sparse_polynomial

   !> Of the first 2^k points each interval of that width has one, in all dimensions, and other seeds give others.
   subroutine test_intervals(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 1024
      integer, allocatable :: counts(:, :)
      integer :: d, k
      real(wp) :: first(most_dimensions), u(most_dimensions)
      type(sobol_t) :: other, points

      call points%begin(most_dimensions, 5, 2)
      allocate (counts(n, most_dimensions), source=0)
      do k = 0, n - 1
         call points%point(int(k, i8), u)
         if (k == 0) first = u
         do d = 1, most_dimensions
            counts(1 + int(n*u(d)), d) = counts(1 + int(n*u(d)), d) + 1
         end do
      end do
      call check_true(error, all(counts == 1), "one in each")
      if (allocated(error)) return
      call other%begin(most_dimensions, 6, 2)
      call other%point(0_i8, u)
      call check_true(error, all(abs(u - first) > 1.0e-9_wp), "another seed")
      if (allocated(error)) return
      call other%begin(3, 5, 2)
      call other%point(0_i8, u(:3))
      call check_true(error, all(abs(u(:3) - first(:3)) <= 0.0_wp), "the same bits, whatever the number of dimensions")
   end subroutine test_intervals

   !> The first two dimensions are a net of quality 0: each of the rectangles of area 2^-k has one of 2^k points.
   subroutine test_rectangles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: bits = 8
      integer :: counts(0:2**bits - 1), j, k
      real(wp) :: u(2)
      type(sobol_t) :: points

      call points%begin(2, 1, 2)
      do j = 0, bits
         counts = 0
         do k = 0, 2**bits - 1
            call points%point(int(k, i8), u)
            associate (at => int(2**j*u(1)) + 2**j*int(2**(bits - j)*u(2)))
               counts(at) = counts(at) + 1
            end associate
         end do
         call check_true(error, all(counts == 1), "one in each rectangle")
         if (allocated(error)) return
      end do
   end subroutine test_rectangles

   !> The mean of a smooth function of six numbers: over 50 seeds without bias, with an error that falls faster than 1/n.
   subroutine test_integral(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n_seed = 50
      integer :: k, seed, size_of
      real(wp) :: mean(n_seed), rms(2), u(6)
      type(sobol_t) :: points

      do size_of = 1, 2
         do seed = 1, n_seed
            call points%begin(6, seed, 2)
            mean(seed) = 0.0_wp
            do k = 0, 2**(2 + 4*size_of) - 1
               call points%point(int(k, i8), u)
               mean(seed) = mean(seed) + product(1.0_wp + 0.5_wp*(exp(u) - exp(1.0_wp) + 1.0_wp))
            end do
            mean(seed) = mean(seed)/2**(2 + 4*size_of) - 1.0_wp
         end do
         rms(size_of) = sqrt(sum(mean**2)/n_seed)
         call check_close(error, sum(mean)/n_seed, 0.0_wp, 3.0_wp*rms(size_of)/sqrt(real(n_seed, wp)), "bias")
         if (allocated(error)) return
      end do
      call check_true(error, rms(2) < rms(1)/16.0_wp, "16 times the points")
   end subroutine test_integral

   !> Legendre's polynomials of a uniform number, Hermite's of a normal one; of three values there are three.
   subroutine test_families(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 400
      integer :: k
      real(wp) :: p(0:max_degree), u(n*n_five), w(n*n_five), x
      type(family_t) :: family

      do k = 1, n
         u((k - 1)*n_five + 1:k*n_five) = (k - 1 + five_places)/n
         w((k - 1)*n_five + 1:k*n_five) = five_weights/n
      end do
      family = new_family(4.0_wp + 2.0_wp*u, w)
      p = family%values(4.6_wp)
      x = -0.4_wp
      call check_equal(error, family%degree, max_degree, "degree")
      if (allocated(error)) return
      call check_close(error, p(2), sqrt(5.0_wp)*(3.0_wp*x**2 - 1.0_wp)/2.0_wp, 1.0e-12_wp, "Legendre")
      if (allocated(error)) return
      call check_close(error, p(4), 3.0_wp*(35.0_wp*x**4 - 30.0_wp*x**2 + 3.0_wp)/8.0_wp, 1.0e-12_wp, "Legendre, degree 4")
      if (allocated(error)) return
      do k = 1, n/2   ! panels that are halved towards both ends
         associate (low => u((k - 1)*n_five + 1:k*n_five), high => u((n/2 + k - 1)*n_five + 1:(n/2 + k)*n_five))
            low = 0.5_wp**(1 + 0.2_wp*k)*(1.0_wp + (2.0_wp**0.2_wp - 1.0_wp)*five_places)
            high = 1.0_wp - low
         end associate
         w((k - 1)*n_five + 1:k*n_five) = 0.5_wp**(1 + 0.2_wp*k)*(2.0_wp**0.2_wp - 1.0_wp)*five_weights
         w((n/2 + k - 1)*n_five + 1:(n/2 + k)*n_five) = w((k - 1)*n_five + 1:k*n_five)
      end do
      family = new_family(1.0_wp + 3.0_wp*normal_quantile(u), w)
      p = family%values(1.0_wp + 3.0_wp*0.7_wp)
      call check_close(error, p(3), (0.7_wp**3 - 3.0_wp*0.7_wp)/sqrt(6.0_wp), 1.0e-6_wp, "Hermite")
      if (allocated(error)) return
      family = new_family([1.0_wp, 2.0_wp, 5.0_wp], [0.25_wp, 0.5_wp, 0.25_wp])
      call check_equal(error, family%degree, 2, "three values")
      if (allocated(error)) return
      family = new_family([2.0_wp, 2.0_wp], [0.5_wp, 0.5_wp])
      call check_equal(error, family%degree, 0, "one value")
   end subroutine test_families

   !> Polynomials of three uniform numbers at m random members, and values of a function there.
   subroutine draw(m, seed, p, y, which)
      integer, intent(in) :: m                     !! members
      integer, intent(in) :: seed                  !! of the random numbers
      real(wp), intent(out) :: p(0:, :, :)         !! (0:max_degree, 3, m) polynomials [1]
      real(wp), intent(out) :: y(:)                !! (m) values [1]
      integer, intent(in) :: which                 !! 1: a polynomial, 2: Ishigami's function, 3: noise beside the first number

      integer :: i, j
      real(wp) :: nodes(100*n_five), u(4), w(100*n_five)
      type(family_t) :: family

      do i = 1, 100
         nodes((i - 1)*n_five + 1:i*n_five) = (i - 1 + five_places)/100.0_wp
         w((i - 1)*n_five + 1:i*n_five) = five_weights/100.0_wp
      end do
      family = new_family(nodes, w)
      do i = 1, m
         u = [(uniform_at(seed, 1, int(i, i8), j), j=1, 4)]
         do j = 1, 3
            p(:, j, i) = family%values(u(j))
         end do
         select case (which)
         case (1)
            y(i) = 3.0_wp + p(1, 1, i) + 2.0_wp*p(2, 1, i)*p(1, 3, i) - 0.5_wp*p(3, 2, i)
         case (2)
            u = pi*(2.0_wp*u - 1.0_wp)
            y(i) = sin(u(1)) + 7.0_wp*sin(u(2))**2 + 0.1_wp*u(3)**4*sin(u(1))
         case default
            y(i) = p(1, 1, i) + normal_quantile(u(4))
         end select
      end do
   end subroutine draw

   !> A polynomial is found as it is, with its indices and nothing missed.
   subroutine test_exact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: m = 60
      real(wp) :: first(3, 3), p(0:max_degree, 3, m), total(3, 3), y(m)
      type(polynomial_t) :: found

      call draw(m, 3, p, y, 1)
      call fit_polynomial(p, [max_degree, max_degree, max_degree], y, found)
      call found%indices([1, 2, 3], first, total)
      call check_equal(error, size(found%c), 4, "terms")
      if (allocated(error)) return
      call check_close(error, found%missed, 0.0_wp, 1.0e-14_wp, "missed")
      if (allocated(error)) return
      call check_close(error, maxval(abs(first(1, :) - [1.0_wp, 0.25_wp, 0.0_wp]/5.25_wp)), 0.0_wp, 1.0e-12_wp, "first")
      if (allocated(error)) return
      call check_close(error, maxval(abs(total(1, :) - [5.0_wp, 0.25_wp, 4.0_wp]/5.25_wp)), 0.0_wp, 1.0e-12_wp, "total")
   end subroutine test_exact

   !> Ishigami's function with a = 7, b = 0.1 by 150 members: the intervals of its indices hold in 9 of 10 of 50 repeats.
   subroutine test_ishigami(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: m = 150, n_repeat = 50
      integer :: hits(6), k
      real(wp), allocatable :: p(:, :, :)
      real(wp) :: exact(6), first(3, 3), missed, total(3, 3), v1, v13, v2, y(m)
      type(polynomial_t) :: found

      v1 = 0.5_wp*(1.0_wp + 0.1_wp*pi**4/5.0_wp)**2
      v2 = 49.0_wp/8.0_wp
      v13 = 0.01_wp*pi**8*8.0_wp/225.0_wp
      exact = [v1, v2, 0.0_wp, v1 + v13, v2, v13]/(v1 + v2 + v13)
      allocate (p(0:max_degree, 3, m))
      hits = 0
      missed = 0.0_wp
      do k = 1, n_repeat
         call draw(m, k, p, y, 2)
         call fit_polynomial(p, [max_degree, max_degree, max_degree], y, found)
         call found%indices([1, 2, 3], first, total)
         where ([first(2, :), total(2, :)] <= exact .and. exact <= [first(3, :), total(3, :)]) hits = hits + 1
         missed = missed + found%missed/n_repeat
      end do
      call check_true(error, all(hits >= 45), "intervals")
      if (allocated(error)) return
      call check_true(error, missed < 0.02_wp, "missed")
   end subroutine test_ishigami

   !> Half of the variance is noise: cross-validation says so, and the terms do not follow it.
   subroutine test_noise(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: m = 400
      real(wp), allocatable :: p(:, :, :)
      real(wp) :: y(m)
      type(polynomial_t) :: found

      allocate (p(0:max_degree, 3, m))

      call draw(m, 4, p, y, 3)
      call fit_polynomial(p, [max_degree, max_degree, max_degree], y, found)
      call check_close(error, found%missed, 0.5_wp, 0.1_wp, "missed")
      if (allocated(error)) return
      call check_true(error, size(found%c) <= 6, "terms")
   end subroutine test_noise

end module test_sparse_polynomial
