!> Dormand and Prince's method: its order, its coefficients, its error estimate, its interpolant.
module test_dop853
   use check, only: check_close, check_equal, check_true, suite_t
   use convergence, only: check_order, converge
   use dop853, only: dop853_t
   use errors, only: error_t
   use integrator_controls, only: norm_euclidean, norm_scaled
   use kinds, only: eps, wp
   use ode_examples, only: kepler_t, new_kepler, new_pendulum, pendulum_t, power_t, root_t, run_to
   use step_course, only: along, course_even, course_from_root, course_to_root, pace_at, parameter_of
   implicit none (type, external)
   private
   public :: run_test_dop853

   integer, parameter :: n_halving = 4  !! step lengths of a convergence test

contains

   subroutine run_test_dop853(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_on_an_ellipse", test_order_on_an_ellipse)
      call suite%test("order_on_a_pendulum", test_order_on_a_pendulum)
      call suite%test("polynomials_up_to_degree_8_are_exact", test_polynomials)
      call suite%test("orders_of_the_interpolant", test_interpolant)
      call suite%test("interpolant_after_a_search_within_the_step", test_after_a_search)
      call suite%test("how_time_goes", test_course)
      call suite%test("order_where_a_force_begins_or_ends", test_roots)
      call suite%test("error_follows_the_tolerance", test_tolerance)
      call suite%test("quadratures_stay_out_of_the_norm", test_quadratures)
   end subroutine run_test_dop853

   subroutine test_order_on_an_ellipse(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      real(wp) :: errors(4, n_halving), y(4)

      call new_kepler(0.1_wp, system, y)
      call converge("dop853", system, y, 5.0_wp, system%exact(5.0_wp), 6, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 7.3_wp, 8.3_wp, "position")
      call check_order(error, norm2(errors(3:4, :), dim=1), 7.3_wp, 8.3_wp, "velocity")
      call check_true(error, maxval(errors(:, n_halving)) < 1.0e-9_wp, "small error with 48 steps")
   end subroutine test_order_on_an_ellipse

   subroutine test_order_on_a_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(4, n_halving)

      call new_pendulum(0.9_wp, .true., system, y)
      call converge("dop853", system, y, 5.0_wp, system%exact(5.0_wp), 8, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 7.2_wp, 8.6_wp, "state")
      call check_order(error, norm2(errors(3:4, :), dim=1), 7.2_wp, 10.0_wp, "quadratures")
   end subroutine test_order_on_a_pendulum

   !> One step of a length that is no round number: weights, and places of the stages.
   subroutine test_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.3_wp
      type(power_t) :: system
      type(dop853_t), allocatable :: method
      real(wp) :: deviation(3), y(3)
      character(16) :: what
      integer :: p, status

      system%n = 3
      system%n_position = 1
      system%n_quadrature = 1
      do p = 1, 10
         allocate (method)
         system%p = p
         method%controls%fixed_step = h
         call method%start(system, 0.0_wp, [0.0_wp, merge(1.0_wp, 0.0_wp, p == 1), 0.0_wp], h, status)
         call method%advance(system, h, status)
         y = [1.0_wp, real(p, wp)/h, 1.0_wp]*h**p
         deviation = (method%step%y1 - y)/[y(1), y(2), y(3)]
         write (what, "(a, i0)") "degree ", p
         if (p <= 8) call check_close(error, deviation, [0.0_wp, 0.0_wp, 0.0_wp], 100.0_wp*eps, what)
         ! the velocity of t^9 is 9 t^8
         if (p == 9) call check_true(error, abs(deviation(3)) > 1.0e-6_wp, "degree 9 is not exact for a quadrature")
         if (p == 10) call check_true(error, all(abs(deviation) > 1.0e-6_wp), "degree 10 is not exact")
         deallocate (method)
      end do
   end subroutine test_polynomials

   !> Maximum errors of the interpolant of one step of an ellipse: of position and velocity.
   function interpolation_error(method, system, t) result(maximum)
      type(dop853_t), intent(in) :: method    !! the integrator, after a step
      type(kepler_t), intent(in) :: system    !! the system
      real(wp), intent(in) :: t               !! time before the start of the integration [s]
      real(wp) :: maximum(2)                  !! (2) the errors [1]

      integer, parameter :: n_place = 20
      real(wp) :: off(4), y(4)
      integer :: k

      maximum = 0.0_wp
      do k = 0, n_place
         call method%state_at(system, method%step%t0 + method%step%h*real(k, wp)/n_place, y)
         off = abs(y - system%exact(t + method%step%t0 + method%step%h*real(k, wp)/n_place))
         maximum = max(maximum, [maxval(off(:2)), maxval(off(3:))])
      end do
   end function interpolation_error

   !> Within one step the error of velocities falls as h^8 and that of positions, by accelerations, at least as h^9; without the
   !> stages of the interpolant as h^6 and h^5.
   subroutine test_interpolant(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(dop853_t), allocatable :: method
      real(wp) :: poor(2, n_halving), rich(2, n_halving), y(4)
      integer :: k, status

      call new_kepler(0.3_wp, system, y)
      do k = 1, n_halving
         allocate (method)
         method%controls%fixed_step = 0.8_wp/2.0_wp**(k - 1)
         call method%start(system, 0.0_wp, y, 10.0_wp, status)
         call method%advance(system, 10.0_wp, status)
         poor(:, k) = interpolation_error(method, system, 0.0_wp)
         call method%prepare_output(system, status)
         call check_equal(error, status, 0, "status")
         rich(:, k) = interpolation_error(method, system, 0.0_wp)
         call check_true(error, method%count%n_output_evaluations == 3, "three evaluations")
         call method%prepare_output(system, status)
         call check_true(error, method%count%n_output_evaluations == 3, "once")
         deallocate (method)
      end do
      call check_order(error, rich(1, :), 8.7_wp, 10.5_wp, "positions with its stages")
      call check_order(error, rich(2, :), 7.5_wp, 8.5_wp, "velocities with its stages")
      call check_order(error, poor(1, :), 5.5_wp, 6.5_wp, "positions without")
      call check_order(error, poor(2, :), 4.5_wp, 5.5_wp, "velocities without")
   end subroutine test_interpolant

   !> Places, paces and parameters of each course belong together; a course starts at 0 and ends at 1.
   subroutine test_course(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: far = 1.0e-5_wp
      real(wp) :: s
      integer :: course, k

      do course = course_even, course_to_root
         call check_close(error, along(course, [0.0_wp, 1.0_wp]), [0.0_wp, 1.0_wp], 0.0_wp, "ends")
         do k = 1, 9
            s = 0.1_wp*k
            call check_close(error, parameter_of(course, along(course, s)), s, 4.0_wp*eps, "parameter")
            call check_close(error, pace_at(course, s), (along(course, s + far) - along(course, s - far))/(2.0_wp*far), &
                             1.0e-9_wp, "pace")
         end do
      end do
      call check_close(error, [pace_at(course_from_root, 0.0_wp), pace_at(course_to_root, 1.0_wp)], [0.0_wp, 0.0_wp], 0.0_wp, &
                       "time stands at the roots")
   end subroutine test_course

   !> Errors of one step and of its interpolant: of the order h^2.5 where time goes evenly, h^5 where it goes as a square: of
   !> y = exp(s^5) the powers to s^8 are met, and s^9 has none.
   subroutine test_roots(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: at_end(n_halving, 2), between(n_halving, 2)
      integer :: k, way

      do way = course_from_root, course_to_root
         do k = 1, n_halving
            call make_step(way, 0.4_wp/2.0_wp**(k - 1), way, at_end(k, 1), between(k, 1))
            call make_step(way, 0.4_wp/2.0_wp**(k - 1), course_even, at_end(k, 2), between(k, 2))
         end do
         call check_order(error, at_end(:, 1), 4.4_wp, 5.6_wp, "as a square")
         call check_order(error, at_end(:, 2), 2.3_wp, 2.7_wp, "evenly")
         call check_order(error, between(:, 1), 3.9_wp, 5.6_wp, "between, as a square")
         call check_order(error, between(:, 2), 2.2_wp, 2.8_wp, "between, evenly")
         call check_true(error, between(n_halving, 1) < 0.02_wp*between(n_halving, 2), "much better")
      end do
   end subroutine test_roots

   !> One step from a root, or to one, and its maximum error there and between.
   subroutine make_step(way, h, course, at_end, between)
      integer, intent(in) :: way        !! course_from_root: the root is at the start; course_to_root: at the end
      real(wp), intent(in) :: h         !! length of the step [s]
      integer, intent(in) :: course     !! how time goes
      real(wp), intent(out) :: at_end   !! error at the end [1]
      real(wp), intent(out) :: between  !! maximum error of the interpolant [1]

      type(root_t) :: system
      type(dop853_t) :: method
      real(wp) :: t, y(1)
      integer :: k, status

      system%n = 1
      if (way == course_to_root) system%root = h
      call method%start(system, 0.0_wp, [system%exact(0.0_wp)], h, status)
      call method%begin_step()
      method%step%y0 = method%step%y1
      method%step%f0 = method%step%f1
      method%step%course = course
      call method%make_stages(system, h, status)
      method%step%h = h
      method%t = h
      method%step%y1 = method%trial
      call system%evaluate(h, method%step%y1, method%step%f1, status)
      at_end = abs(method%step%y1(1) - system%exact(h))
      call method%prepare_output(system, status)
      between = 0.0_wp
      do k = 1, 19
         t = 0.05_wp*k*h
         call method%state_at(system, t, y)
         between = max(between, abs(y(1) - system%exact(t)))
      end do
   end subroutine make_step

   !> `refine` uses the room of the stages: the interpolant afterwards is the same.
   subroutine test_after_a_search(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(dop853_t) :: method, other
      real(wp) :: after(4), before(4), inner(4), t, y(4)
      integer :: status

      call new_kepler(0.3_wp, system, y)
      method%controls%tolerance = 1.0e-12_wp
      call method%start(system, 0.0_wp, y, 2.0_wp, status)
      call method%advance(system, 2.0_wp, status)
      other = method
      call other%refine(system, 0.3_wp, inner, status)
      t = method%step%t0 + 0.3_wp*method%step%h
      call check_close(error, inner, system%exact(t), 1.0e-12_wp, "state within")
      call method%prepare_output(system, status)
      call other%prepare_output(system, status)
      call method%state_at(system, t, before)
      call other%state_at(system, t, after)
      call check_close(error, after, before, 0.0_wp, "interpolated state")
      call check_close(error, other%step%y1, method%step%y1, 0.0_wp, "present state")
   end subroutine test_after_a_search

   !> Ten times the tolerance, about ten times the error, over six decades.
   subroutine test_tolerance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(dop853_t), allocatable :: method
      real(wp) :: errors(7), y(4)
      integer :: k, status

      call new_kepler(0.5_wp, system, y)
      do k = 1, size(errors)
         allocate (method)
         method%controls%tolerance = 0.1_wp**(k + 3)
         call method%start(system, 0.0_wp, y, 20.0_wp, status)
         call run_to(method, system, 20.0_wp, status)
         errors(k) = norm2(method%step%y1 - system%exact(20.0_wp))
         call check_equal(error, status, 0, "status")
         deallocate (method)
      end do
      call check_true(error, all(errors(1:6) > errors(2:7)), "error falls with the tolerance")
      call check_close(error, log10(errors(1)/errors(7)), 6.0_wp, 1.0_wp, "decades of error over six of tolerance")
   end subroutine test_tolerance

   !> Every step is the same, bit for bit, with quadratures and without.
   subroutine test_quadratures(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: plain, rich
      type(dop853_t), allocatable :: first, second
      real(wp), allocatable :: y(:), z(:)
      integer :: k, norm, status

      do norm = norm_scaled, norm_euclidean
         allocate (first, second)
         call new_pendulum(0.9_wp, .false., plain, y)
         call new_pendulum(0.9_wp, .true., rich, z)
         z(3:4) = [1.0e6_wp, -1.0e6_wp]
         first%controls%tolerance = 1.0e-9_wp
         first%controls%norm = norm
         second%controls = first%controls
         call first%start(plain, 0.0_wp, y, 60.0_wp, status)
         call second%start(rich, 0.0_wp, z, 60.0_wp, status)
         do k = 1, 40
            call first%advance(plain, 60.0_wp, status)
            call second%advance(rich, 60.0_wp, status)
            call check_close(error, [second%t, second%step%y1(1:2)], [first%t, first%step%y1], 0.0_wp, "a step")
         end do
         deallocate (first, second)
      end do
   end subroutine test_quadratures

end module test_dop853
