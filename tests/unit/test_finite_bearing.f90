!> The film of a stored potential: against the film on a grid, gradient, convexity, smoothness, power laws.
module test_finite_bearing
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use film_case, only: components, film_case_t, make_film
   use film_grid_case, only: make_grid, result_of
   use film_law, only: film_bearing_t
   use finite_bearing, only: basis, finite_force, finite_weights, max_ratio, min_ratio, n_local, n_ratio
   use fixed_random, only: random_t
   use kinds, only: pi, wp
   use reynolds_grid, only: boundary_reynolds, journal_state_t, reynolds_grid_t
   use reynolds_results, only: film_result_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_finite_bearing

contains

   subroutine run_test_finite_bearing(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("against_the_grid", test_against_the_grid)
      call suite%test("potential", test_potential)
      call suite%test("basis", test_basis)
      call suite%test("smooth", test_smooth)
      call suite%test("middle", test_middle)
      call suite%test("wall", test_wall)
      call suite%test("range", test_range)
   end subroutine run_test_finite_bearing

   !> A random bearing: L/D even in its logarithm, half of the eccentricities close to 1, any direction.
   subroutine draw(random, ratio, e, v)
      type(random_t), intent(inout) :: random  !! the sequence
      real(wp), intent(out) :: ratio           !! L/D [1]
      real(wp), intent(out) :: e(2)            !! (2) eccentricity [1]
      real(wp), intent(out) :: v(2)            !! (2) velocity, of size 1 [1/s]

      real(wp) :: eps

      ratio = exp(random%between(log(min_ratio), log(max_ratio)))
      if (random%between(0.0_wp, 1.0_wp) < 0.5_wp) then
         eps = random%between(0.0_wp, 0.999_wp)
      else
         eps = tanh(random%between(0.0_wp, atanh(0.999_wp)))
      end if
      e = eps*unit(random%between(-pi, pi))
      v = unit(random%between(-pi, pi))
   end subroutine draw

   !> A unit vector.
   pure function unit(angle) result(u)
      real(wp), intent(in) :: angle  !! its angle [rad]
      real(wp) :: u(2)               !! (2) the vector [1]

      u = [cos(angle), sin(angle)]
   end function unit

   !> The force of a state.
   pure function force(ratio, e, v) result(f)
      real(wp), intent(in) :: ratio  !! L/D [1]
      real(wp), intent(in) :: e(2)   !! (2) eccentricity [1]
      real(wp), intent(in) :: v(2)   !! (2) velocity [1/s]
      real(wp) :: f(2)               !! (2) force [1/s]

      call finite_force(ratio, finite_weights(ratio), e, v, f)
   end function force

   !> Within 1 % of the force of the grid at states that no fit has seen.
   subroutine test_against_the_grid(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(reynolds_grid_t) :: grid
      type(film_result_t) :: film
      type(journal_state_t) :: state
      type(random_t) :: random
      real(wp) :: ratio
      integer :: k

      do k = 1, 60
         call draw(random, ratio, state%e, state%v)
         call make_grid(grid, ratio, 160, 20, boundary_reynolds)
         film = result_of(grid, state)
         call check_close(error, force(ratio, state%e, state%v), film%f, 0.01_wp*norm2(film%f), "L/D "//to_text(ratio)//", eps " &
                          //to_text(norm2(state%e)))
      end do
   end subroutine test_against_the_grid

   !> Minus the gradient of -f.v/2, degree 1, f.v < 0, and convex: the derivative of the force over v is negative definite.
   subroutine test_potential(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-5_wp
      type(random_t) :: random
      real(wp) :: change(2, 2), e(2), f(2), high(2), low(2), move(2), ratio, v(2)
      integer :: i, k

      do k = 1, 3000
         call draw(random, ratio, e, v)
         f = force(ratio, e, v)
         call check_true(error, dot_product(f, v) < 0.0_wp, "dissipative")
         do i = 1, 2
            move = 0.0_wp
            move(i) = step
            high = force(ratio, e, v + move)
            low = force(ratio, e, v - move)
            change(:, i) = (high - low)/(2.0_wp*step)
            call check_close(error, f(i), 0.5_wp*(dot_product(high, v + move) - dot_product(low, v - move))/(2.0_wp*step), &
                             1.0e-6_wp*norm2(f), "gradient")
         end do
         call check_close(error, change(1, 2), change(2, 1), 1.0e-5_wp*maxval(abs(change)), "symmetric")
         call check_true(error, change(1, 1) + change(2, 2) < 0.0_wp, "convex: trace, state "//to_text(k))
         call check_true(error, change(1, 1)*change(2, 2) > change(1, 2)*change(2, 1), "convex: determinant, eps " &
                         //to_text(norm2(e))//", L/D "//to_text(ratio)//", cosine "//to_text(dot_product(e, v)/norm2(e)))
         call check_close(error, force(ratio, e, 3.7_wp*v), 3.7_wp*f, 1.0e-12_wp, "degree 1", relative=.true.)
      end do
   end subroutine test_potential

   !> Splines of degree 5 add up to 1, reproduce t and have the derivatives that they say.
   subroutine test_basis(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-6_wp
      real(wp), dimension(n_local) :: high, low, slope, unused, value
      integer :: i, k

      do k = 0, 10
         call basis(0.1_wp*k, value, slope)
         call check_close(error, sum(value), 1.0_wp, 1.0e-14_wp, "sum")
         call check_close(error, sum(value*[(real(i - 3, wp), i=1, n_local)]), 0.1_wp*k, 1.0e-13_wp, "linear")
         call basis(0.1_wp*k + step, high, unused)
         call basis(0.1_wp*k - step, low, unused)
         call check_close(error, slope, (high - low)/(2.0_wp*step), 1.0e-9_wp, "derivative")
      end do
      call basis(1.0_wp, high, unused)
      call basis(0.0_wp, low, unused)
      call check_close(error, high(2:6), low(1:5), 1.0e-15_wp, "the next interval goes on")
   end subroutine test_basis

   !> Second derivatives of the force are continuous: third differences over a path across knots fall with the cube of the step.
   subroutine test_smooth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(random_t) :: random
      real(wp) :: e(2), f(2), jump(2, 2), ratio, v(2), way_e(2), way_v(2), x
      integer :: i, k, m, n

      do k = 1, 20
         call draw(random, ratio, e, v)
         e = 0.9_wp*e
         way_e = 0.3_wp*(0.95_wp - norm2(e))*unit(random%between(-pi, pi))
         way_v = 0.4_wp*unit(random%between(-pi, pi))
         do m = 1, 2
            n = 200*m
            jump(:, m) = 0.0_wp
            do i = 0, n - 3
               x = real(i, wp)/n
               f = force(ratio, e + x*way_e, v + x*way_v)
               x = real(i + 1, wp)/n
               f = f - 3.0_wp*force(ratio, e + x*way_e, v + x*way_v)
               x = real(i + 2, wp)/n
               f = f + 3.0_wp*force(ratio, e + x*way_e, v + x*way_v)
               x = real(i + 3, wp)/n
               f = f - force(ratio, e + x*way_e, v + x*way_v)
               jump(:, m) = max(jump(:, m), abs(f))
            end do
         end do
         call check_true(error, maxval(jump(:, 2)) < 0.2_wp*maxval(jump(:, 1)), "third differences, path "//to_text(k))
      end do
   end subroutine test_smooth

   !> At e = 0 no direction of e is special, first derivatives included, and damping is the same all round; v = 0 has no force.
   subroutine test_middle(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step = 1.0e-4_wp, zero(2) = 0.0_wp
      real(wp) :: f(2), here(2), slope(2, 3)
      integer :: k

      call check_close(error, force(1.0_wp, zero, zero), zero, 0.0_wp, "e = v = 0")
      call check_close(error, force(1.0_wp, [0.6_wp, 0.3_wp], zero), zero, 0.0_wp, "v = 0")
      here = force(1.0_wp, zero, unit(0.0_wp))
      call check_close(error, here(2), 0.0_wp, 1.0e-14_wp, "e = 0: against the motion")
      do k = 1, 12
         f = force(1.0_wp, zero, unit(0.7_wp*k))
         call check_close(error, f, here(1)*unit(0.7_wp*k), 1.0e-12_wp, "e = 0: the same in all directions")
      end do
      do k = 0, 11
         slope(:, 1) = (force(1.0_wp, step*unit(0.5_wp*k), [1.0_wp, 0.0_wp]) - here)/step
         slope(:, 2) = (force(1.0_wp, [step, 0.0_wp], [1.0_wp, 0.0_wp]) - here)/step
         slope(:, 3) = (force(1.0_wp, [0.0_wp, step], [1.0_wp, 0.0_wp]) - here)/step
         call check_close(error, slope(:, 1), cos(0.5_wp*k)*slope(:, 2) + sin(0.5_wp*k)*slope(:, 3), 30.0_wp*step*norm2(here), &
                          "first derivatives are those of a smooth function")
      end do
   end subroutine test_middle

   !> Towards the wall the powers of 1 - eps continue: -3/2 for an approach, -1/2 across, 0 for a journal that parts.
   subroutine test_wall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: gap(2) = [1.0e-6_wp, 1.0e-8_wp], power(3) = [1.5_wp, 0.5_wp, 0.0_wp]
      real(wp) :: f(2, 2), v(2, 3)
      integer :: i, k

      v = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp], [2, 3])
      do k = 1, 3
         do i = 1, 2
            f(:, i) = force(1.0_wp, [1.0_wp - gap(i), 0.0_wp], v(:, k))
         end do
         call check_true(error, all(ieee_is_finite(f)), "finite")
         associate (work => abs(matmul(v(:, k), f)))
            call check_close(error, log(work(2)/work(1))/log(gap(1)/gap(2)), power(k), 0.05_wp, "power of direction "//to_text(k))
         end associate
      end do
   end subroutine test_wall

   !> A bearing that is too short or too long is refused as text; the film of the deck has its scale.
   subroutine test_range(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(film_case_t) :: case
      real(wp) :: f(2)

      call make_film("finite", " ", " ", film_bearing_t(0.01_wp, 1.0e-4_wp, 0.0049_wp, 0.1_wp, 0.999_wp), case)
      call check_equal(error, case%message, "L/D = 0.245 is outside the range of 'finite', 0.25 to 4", "too short")
      call make_film("finite", " ", " ", film_bearing_t(0.01_wp, 1.0e-4_wp, 0.081_wp, 0.1_wp, 0.999_wp), case)
      call check_true(error, index(case%message, "outside the range") > 0, "too long")
      call make_film("finite", " ", " ", film_bearing_t(0.01_wp, 1.0e-4_wp, 0.02_wp, 0.1_wp, 0.999_wp), case)
      call check_equal(error, case%message, "", "fits")
      f = force(1.0_wp, [0.5_wp, 0.0_wp], [0.2_wp, -0.25_wp*3.0_wp])
      call check_close(error, components(case, 0.5_wp, 0.2_wp, 3.0_wp), 0.1_wp*0.02_wp*0.01_wp**3/1.0e-4_wp**2*f, 1.0e-12_wp, &
                       "scale", relative=.true.)
      call check_equal(error, size(finite_weights(1.0_wp)), n_ratio, "polynomials")
   end subroutine test_range

end module test_finite_bearing
