!> The interpolant of a step: orders, exactness on polynomials, agreement with the ends.
module test_interpolation
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use interpolation, only: fit_inner, inner_places, interpolate, step_t
   use kinds, only: eps, wp
   use ode_examples, only: new_pendulum, pendulum_t, run_to, slope
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_interpolation

   integer, parameter :: n_place = 40  !! places within a step that are looked at

contains

   subroutine run_test_interpolation(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("ends", test_ends)
      call suite%test("polynomials", test_polynomials)
      call suite%test("order", test_order)
      call suite%test("order_with_inner_derivative", test_order_with_inner_derivative)
      call suite%test("order_after_a_step_of_the_method", test_order_after_a_step)
      call suite%test("state_at_along_a_run", test_along_a_run)
      call suite%test("inner_derivative_is_evaluated_once", test_inner_once)
   end subroutine run_test_interpolation

   !> Storage for a step of one position and one quadrature.
   subroutine new_step(t0, h, step)
      real(wp), intent(in) :: t0          !! its start [s]
      real(wp), intent(in) :: h           !! its length [s]
      type(step_t), intent(out) :: step   !! the step, ends not set

      step%t0 = t0
      step%h = h
      allocate (step%y0(3), step%y1(3), step%f0(3), step%f1(3), step%inner(3, 2), source=0.0_wp)
   end subroutine new_step

   !> State (q, v, z) of q = z = t^p, and its derivative.
   pure function power_of(p, t) result(state)
      integer, intent(in) :: p     !! the power
      real(wp), intent(in) :: t    !! time [s]
      real(wp) :: state(3, 2)      !! (3, 2) state and derivative [any]

      state(:, 1) = [t**p, real(p, wp)*t**max(p - 1, 0), t**p]
      state(:, 2) = [state(2, 1), real(p*(p - 1), wp)*t**max(p - 2, 0), state(2, 1)]
   end function power_of

   !> State of q = sin(2 t + 0.3), z = q, and its derivative.
   pure function wave_of(t) result(state)
      real(wp), intent(in) :: t    !! time [s]
      real(wp) :: state(3, 2)      !! (3, 2) state and derivative [any]

      real(wp) :: c, s

      s = sin(2.0_wp*t + 0.3_wp)
      c = 2.0_wp*cos(2.0_wp*t + 0.3_wp)
      state(:, 1) = [s, c, s]
      state(:, 2) = [c, -4.0_wp*s, c]
   end function wave_of

   !> Put exact states at the ends of a step.
   subroutine fill_step(start, inner, inner_2, end, step)
      real(wp), intent(in) :: start(3, 2)    !! (3, 2) state and derivative at its start [any]
      real(wp), intent(in) :: inner(3, 2)    !! (3, 2) at its first inner place [any]
      real(wp), intent(in) :: inner_2(3, 2)  !! (3, 2) at its second [any]
      real(wp), intent(in) :: end(3, 2)      !! (3, 2) at its end [any]
      type(step_t), intent(inout) :: step    !! the step

      step%y0 = start(:, 1)
      step%f0 = start(:, 2)
      step%inner(:, 1) = inner(:, 2)
      step%inner(:, 2) = inner_2(:, 2)
      step%y1 = end(:, 1)
      step%f1 = end(:, 2)
   end subroutine fill_step

   !> The interpolant meets states and derivatives at the ends, and the inner derivative if it is known.
   subroutine test_ends(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 0.9_wp, ds = 1.0e-5_wp
      type(step_t) :: step
      real(wp) :: after(3), before(3), inner(3, 2), y(3)
      integer :: k

      call new_step(0.2_wp, h, step)
      call fill_step(wave_of(0.2_wp), wave_of(0.2_wp + inner_places(1)*h), wave_of(0.2_wp + inner_places(2)*h), &
                     wave_of(0.2_wp + h), step)
      inner = step%inner
      do k = 0, 1
         if (k == 1) call fit_inner(step, 1, 0, 3)
         call interpolate(step, 1, 0, 0.0_wp, size(y), y)
         call check_close(error, y, step%y0, 0.0_wp, "state at the start")
         call interpolate(step, 1, 0, 1.0_wp, size(y), y)
         call check_close(error, y, step%y1, 4.0_wp*eps, "state at the end")
         call interpolate(step, 1, 0, -ds, size(before), before)
         call interpolate(step, 1, 0, ds, size(after), after)
         call check_close(error, (after - before)/(2.0_wp*ds*h), step%f0, 1.0e-8_wp, "derivative at the start")
         call interpolate(step, 1, 0, 1.0_wp - ds, size(before), before)
         call interpolate(step, 1, 0, 1.0_wp + ds, size(after), after)
         call check_close(error, (after - before)/(2.0_wp*ds*h), step%f1, 1.0e-8_wp, "derivative at the end")
      end do
      do k = 1, 2
         call interpolate(step, 1, 0, inner_places(k) - ds, size(before), before)
         call interpolate(step, 1, 0, inner_places(k) + ds, size(after), after)
         call check_close(error, (after(2:3) - before(2:3))/(2.0_wp*ds*h), inner(2:3, k), 1.0e-8_wp, "inner derivative")
      end do
   end subroutine test_ends

   !> Positions are exact up to t^5, quadratures up to t^3; with the inner derivatives t^7 and t^5; no further.
   subroutine test_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: deviation(3)
      integer :: p

      do p = 0, 8
         call deviate(.false.)
         call check_true(error, (deviation(1) < 1.0e-13_wp) .eqv. (p <= 5), "position")
         call check_true(error, (deviation(2) < 1.0e-13_wp) .eqv. (p <= 5), "velocity")
         call check_true(error, (deviation(3) < 1.0e-13_wp) .eqv. (p <= 3), "quadrature")
         call deviate(.true.)
         call check_true(error, (deviation(1) < 1.0e-13_wp) .eqv. (p <= 7), "position with inner derivative")
         call check_true(error, (deviation(2) < 1.0e-13_wp) .eqv. (p <= 7), "velocity with inner derivative")
         call check_true(error, (deviation(3) < 1.0e-13_wp) .eqv. (p <= 5), "quadrature with inner derivative")
      end do

   contains

      !> Maximum deviation within a step from 0.4 to 1.3.
      subroutine deviate(has_inner)
         logical, intent(in) :: has_inner  !! whether the inner derivative is used

         type(step_t) :: step
         real(wp) :: exact(3, 2), y(3)
         integer :: k

         call new_step(0.4_wp, 0.9_wp, step)
         call fill_step(power_of(p, 0.4_wp), power_of(p, 0.4_wp + inner_places(1)*0.9_wp), &
                        power_of(p, 0.4_wp + inner_places(2)*0.9_wp), power_of(p, 1.3_wp), step)
         if (has_inner) call fit_inner(step, 1, 0, 3)
         deviation = 0.0_wp
         do k = 0, n_place
            exact = power_of(p, 0.4_wp + 0.9_wp*k/n_place)
            call interpolate(step, 1, 0, real(k, wp)/n_place, size(y), y)
            deviation = max(deviation, abs(y - exact(:, 1))/1.3_wp**p)
         end do
      end subroutine deviate

   end subroutine test_polynomials

   !> Maximum errors within a step of halved lengths, from exact ends.
   subroutine errors_within(has_inner, errors)
      logical, intent(in) :: has_inner         !! whether the inner derivative is used
      real(wp), intent(out) :: errors(:, :)     !! (3, levels) of position, velocity, quadrature [any]

      type(step_t) :: step
      real(wp) :: exact(3, 2), h, y(3)
      integer :: k, level

      do level = 1, size(errors, 2)
         h = 0.8_wp*0.5_wp**level
         call new_step(0.1_wp, h, step)
         call fill_step(wave_of(0.1_wp), wave_of(0.1_wp + inner_places(1)*h), wave_of(0.1_wp + inner_places(2)*h), &
                        wave_of(0.1_wp + h), step)
         if (has_inner) call fit_inner(step, 1, 0, 3)
         errors(:, level) = 0.0_wp
         do k = 0, n_place
            exact = wave_of(0.1_wp + h*k/n_place)
            call interpolate(step, 1, 0, real(k, wp)/n_place, size(y), y)
            errors(:, level) = max(errors(:, level), abs(y - exact(:, 1)))
         end do
      end do
   end subroutine errors_within

   !> Observed orders of position, velocity and quadrature.
   subroutine check_orders(error, errors, expected)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      real(wp), intent(in) :: errors(:, :)                 !! (3, levels) errors [any]
      real(wp), intent(in) :: expected(3)                  !! (3) orders [1]

      integer :: n

      n = size(errors, 2)
      call check_close(error, slope(errors(1, n - 1), errors(1, n)), expected(1), 0.2_wp, "order of positions")
      call check_close(error, slope(errors(2, n - 1), errors(2, n)), expected(2), 0.2_wp, "order of velocities")
      call check_close(error, slope(errors(3, n - 1), errors(3, n)), expected(3), 0.2_wp, "order of quadratures")
   end subroutine check_orders

   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: errors(3, 3)

      call errors_within(.false., errors)
      call check_orders(error, errors, [6.0_wp, 5.0_wp, 4.0_wp])
   end subroutine test_order

   subroutine test_order_with_inner_derivative(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: errors(3, 3)

      call errors_within(.true., errors)
      call check_orders(error, errors, [8.0_wp, 7.0_wp, 6.0_wp])
   end subroutine test_order_with_inner_derivative

   !> One step of Verner's method from an exact state: without inner derivatives the orders are those of
   !> exact ends; with them those that the end of the step (7) and the inner states (velocities 5) allow.
   subroutine test_order_after_a_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      type(verner_t), allocatable :: method
      real(wp), allocatable :: exact(:), y(:)
      real(wp) :: errors(3, 4, 2), h, t
      integer :: k, level, pass, status

      errors = 0.0_wp
      call new_pendulum(0.9_wp, .true., system, y)
      do pass = 1, 2
         do level = 1, size(errors, 2)
            h = 0.5_wp**level
            allocate (method)
            method%controls%fixed_step = h
            call method%start(system, 0.4_wp, system%exact(0.4_wp), 0.4_wp + h, status)
            call method%advance(system, 0.4_wp + h, status)
            if (pass == 2) call method%prepare_output(system, status)
            do k = 1, n_place
               t = 0.4_wp + h*k/n_place
               exact = system%exact(t)
               call method%state_at(system, t, y)
               errors(1:2, level, pass) = max(errors(1:2, level, pass), abs(y(1:2) - exact(1:2)))
               errors(3, level, pass) = max(errors(3, level, pass), maxval(abs(y(3:4) - exact(3:4))))
            end do
            deallocate (method)
         end do
      end do
      call check_orders(error, errors(:, :, 1), [6.0_wp, 5.0_wp, 4.0_wp])
      call check_orders(error, errors(:, :, 2), [7.0_wp, 6.0_wp, 6.0_wp])
   end subroutine test_order_after_a_step

   !> All of a run: interpolated states are about as exact as the ends of the steps.
   subroutine test_along_a_run(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      type(verner_t) :: method
      real(wp), allocatable :: y(:)
      real(wp) :: at_ends, t, within
      integer :: status

      call new_pendulum(0.9_wp, .true., system, y)
      method%controls%tolerance = 1.0e-9_wp
      call method%start(system, 0.0_wp, y, 20.0_wp, status)
      at_ends = 0.0_wp
      within = 0.0_wp
      t = 0.0_wp
      do while (method%t < 20.0_wp)
         call method%advance(system, 20.0_wp, status)
         at_ends = max(at_ends, maxval(abs(method%step%y1(1:2) - first_two(method%t))))
         call method%prepare_output(system, status)
         do while (t < method%t)
            call method%state_at(system, t, y)
            within = max(within, maxval(abs(y(1:2) - first_two(t))))
            t = t + 0.0123_wp
         end do
      end do
      call check_true(error, at_ends > 0.0_wp .and. at_ends < 1.0e-6_wp, "ends of steps are right")
      call check_true(error, within < 2.0_wp*at_ends, "between them it is not worse than twice that")

   contains

      !> Exact angle and angular velocity.
      function first_two(time) result(z)
         real(wp), intent(in) :: time   !! time [s]
         real(wp) :: z(2)               !! (2) angle and its rate [rad, rad/s]

         real(wp) :: all_four(4)

         all_four = system%exact(time)
         z = all_four(1:2)
      end function first_two

   end subroutine test_along_a_run

   !> A second call of `prepare_output` costs nothing, and the next step forgets it.
   subroutine test_inner_once(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      type(verner_t) :: method
      real(wp), allocatable :: y(:)
      integer :: k, status

      call new_pendulum(0.9_wp, .false., system, y)
      call method%start(system, 0.0_wp, y, 20.0_wp, status)
      call method%prepare_output(system, status)
      call check_equal(error, int(method%count%n_output_evaluations), 0, "nothing to prepare before the first step")
      do k = 1, 3
         call method%advance(system, 20.0_wp, status)
         call check_true(error, .not. method%step%has_inner, "none yet")
         call method%prepare_output(system, status)
         call method%prepare_output(system, status)
         call check_true(error, method%step%has_inner, "there it is")
         call check_equal(error, int(method%count%n_output_evaluations), 2*k, "evaluations for output")
      end do
      call run_to(method, system, 20.0_wp, status)
      call method%state_at(system, 20.0_wp, y)
      call check_close(error, y, method%step%y1, 0.0_wp, "the end of the step is its state")
   end subroutine test_inner_once

end module test_interpolation
