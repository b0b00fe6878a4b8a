!> Verner's method: its order, its error estimate, its norms.
module test_verner
   use check, only: check_close, check_equal, check_true, suite_t
   use convergence, only: check_order, converge
   use errors, only: error_t
   use integrator_controls, only: norm_absolute, norm_euclidean, norm_mixed, norm_relative, norm_scaled
   use kinds, only: eps, wp
   use ode_examples, only: growth_t, kepler_t, new_kepler, new_pendulum, pendulum_t, power_t, run_to
   use ode_system, only: ode_system_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_verner

   integer, parameter :: n_halving = 4  !! step lengths of a convergence test

contains

   subroutine run_test_verner(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_on_an_ellipse", test_order_on_an_ellipse)
      call suite%test("order_on_a_pendulum", test_order_on_a_pendulum)
      call suite%test("polynomials_up_to_degree_6_are_exact", test_polynomials)
      call suite%test("error_estimate_has_order_5", test_error_estimate)
      call suite%test("error_estimate_of_polynomials", test_estimate_of_polynomials)
      call suite%test("quadratures_stay_out_of_the_norm", test_quadratures)
      call suite%test("error_follows_the_tolerance", test_tolerance)
      call suite%test("norms_are_as_defined", test_norms)
      call suite%test("refine_gives_the_methods_own_state", test_refine)
   end subroutine run_test_verner

   subroutine test_order_on_an_ellipse(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      real(wp) :: errors(4, n_halving), y(4)

      call new_kepler(0.2_wp, system, y)
      call converge("verner", system, y, 5.0_wp, system%exact(5.0_wp), 40, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 5.8_wp, 6.4_wp, "position")
      call check_order(error, norm2(errors(3:4, :), dim=1), 5.8_wp, 6.4_wp, "velocity")
      call check_true(error, maxval(errors(:, n_halving)) < 1.0e-9_wp, "small error with 320 steps")
   end subroutine test_order_on_an_ellipse

   subroutine test_order_on_a_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(4, n_halving)

      call new_pendulum(0.9_wp, .true., system, y)
      call converge("verner", system, y, 5.0_wp, system%exact(5.0_wp), 20, errors)
      call check_order(error, errors(1, :), 5.8_wp, 6.5_wp, "position")
      call check_order(error, errors(2, :), 5.8_wp, 6.5_wp, "velocity")
      call check_order(error, errors(3, :), 5.8_wp, 6.5_wp, "first quadrature")
      call check_order(error, errors(4, :), 5.8_wp, 6.5_wp, "second quadrature")
   end subroutine test_order_on_a_pendulum

   !> One step of a length that is no round number.
   subroutine test_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.3_wp
      type(power_t) :: system
      real(wp) :: deviation(3)
      character(8) :: what
      integer :: p

      do p = 1, 8
         call one_power(p, h, deviation)
         write (what, "(a, i0)") "degree ", p
         if (p <= 6) call check_close(error, deviation/h**p, [0.0_wp, 0.0_wp, 0.0_wp], 20.0_wp*eps, what)
         ! the velocity of t^7 is 7 t^6
         if (p == 7) call check_true(error, abs(deviation(3)) > 1.0e-3_wp, "degree 7 is not exact for a quadrature")
         if (p == 8) call check_true(error, all(abs(deviation) > 1.0e-3_wp), "degree 8 is not exact")
      end do

   contains

      !> Deviation of position, velocity and quadrature from t^p after one step.
      subroutine one_power(p, h, deviation)
         integer, intent(in) :: p                  !! the power
         real(wp), intent(in) :: h                 !! length of the step [s]
         real(wp), intent(out) :: deviation(3)     !! (3) deviations [any]

         type(verner_t) :: method
         integer :: status

         system%n = 3
         system%n_position = 1
         system%n_quadrature = 1
         system%p = p
         method%controls%fixed_step = h
         call method%start(system, 0.0_wp, [0.0_wp, merge(1.0_wp, 0.0_wp, p == 1), 0.0_wp], h, status)
         call method%advance(system, h, status)
         deviation = method%step%y1 - [h**p, real(p, wp)*h**(p - 1), h**p]
         deviation(2) = deviation(2)*h/real(p, wp)
      end subroutine one_power

   end subroutine test_polynomials

   !> The error estimate of one step, from the length that the method takes next.
   function estimate_of(system, t, y, h, norm, floor) result(estimate)
      class(ode_system_t), intent(inout) :: system    !! the system
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (n) state [any]
      real(wp), intent(in) :: h                       !! length of the step [s]
      integer, intent(in) :: norm                     !! error norm
      real(wp), intent(in), optional :: floor         !! of the relative norm [any]
      real(wp) :: estimate                            !! in the norm [1]

      type(verner_t), allocatable :: method
      real(wp) :: tolerance
      integer :: status

      ! the step must be accepted and its successor must not be the longest or the shortest allowed
      estimate = 0.0_wp
      tolerance = 1.0e3_wp
      do while (tolerance > 1.0e-16_wp)
         tolerance = 0.1_wp*tolerance
         allocate (method)
         method%controls%tolerance = tolerance
         method%controls%initial_step = h
         method%controls%norm = norm
         if (present(floor)) method%controls%floor = floor
         call method%start(system, t, y, t + 100.0_wp*h, status)
         call method%advance(system, t + 100.0_wp*h, status)
         if (method%count%n_rejected == 0 .and. method%pace%h_next < 3.99_wp*h) then
            estimate = tolerance*(0.93_wp*h/method%pace%h_next)**(6.0_wp/0.8125_wp)
            return
         end if
         deallocate (method)
      end do
   end function estimate_of

   !> The estimate is the local error of a method of order 5: it falls as h^6.
   subroutine test_error_estimate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      real(wp) :: estimates(n_halving), y(4)
      integer :: k

      call new_kepler(0.3_wp, system, y)
      y = system%exact(1.0_wp)
      do k = 1, n_halving
         estimates(k) = estimate_of(system, 1.0_wp, y, 0.2_wp/2.0_wp**k, norm_absolute)
      end do
      call check_order(error, estimates, 5.8_wp, 6.2_wp, "estimate")
   end subroutine test_error_estimate

   !> The estimate is nil for a polynomial of degree 5 and not for one of degree 6 (in velocity).
   subroutine test_estimate_of_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(growth_t) :: constant
      type(power_t) :: system
      real(wp) :: estimate
      integer :: p

      system%n = 3
      system%n_position = 1
      do p = 2, 7
         system%p = p
         estimate = estimate_of(system, 0.0_wp, [0.0_wp, 0.0_wp, 0.0_wp], 1.0_wp, norm_absolute)
         if (p <= 5) call check_close(error, estimate, 0.0_wp, 1.0e-13_wp, "no error estimated up to degree 5")
         if (p >= 6) call check_true(error, estimate > 1.0e-4_wp, "an error estimated from degree 6 on")
      end do
      constant%n = 1
      constant%rate = [0.0_wp]
      constant%scale = [1.0_wp]
      call check_close(error, estimate_of(constant, 0.0_wp, [1.0_wp], 1.0_wp, norm_scaled), 0.0_wp, 0.0_wp, "at rest")
   end subroutine test_estimate_of_polynomials

   !> Every step is the same, bit for bit, with quadratures and without.
   subroutine test_quadratures(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: plain, rich
      type(verner_t), allocatable :: first, second
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
         call first%start(plain, 0.0_wp, y, 30.0_wp, status)
         call second%start(rich, 0.0_wp, z, 30.0_wp, status)
         do k = 1, 100
            call first%advance(plain, 30.0_wp, status)
            call second%advance(rich, 30.0_wp, status)
            call check_close(error, [second%t, second%step%y1(1:2)], [first%t, first%step%y1], 0.0_wp, "a step")
         end do
         call check_true(error, first%count%n_rejected > 0 .and. first%count%n_rejected == second%count%n_rejected, "rejections")
         deallocate (first, second)
      end do
   end subroutine test_quadratures

   !> Ten times the tolerance, about ten times the error, over six decades.
   subroutine test_tolerance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t), allocatable :: method
      real(wp) :: errors(7), y(4)
      integer :: k, status

      call new_kepler(0.5_wp, system, y)
      do k = 1, size(errors)
         allocate (method)
         method%controls%tolerance = 0.1_wp**(k + 4)
         call method%start(system, 0.0_wp, y, 20.0_wp, status)
         call run_to(method, system, 20.0_wp, status)
         errors(k) = norm2(method%step%y1 - system%exact(20.0_wp))
         call check_equal(error, status, 0, "status")
         deallocate (method)
      end do
      call check_true(error, all(errors(1:6)/errors(2:7) > 4.0_wp), "error falls with the tolerance")
      call check_true(error, all(errors(1:6)/errors(2:7) < 25.0_wp), "error falls no faster than the tolerance")
      call check_close(error, log10(errors(1)/errors(7)), 6.0_wp, 0.6_wp, "decades of error over six of tolerance")
   end subroutine test_tolerance

   !> INORM 0 to 3, FLOOR, and the natural scales, from the estimates of single equations.
   subroutine test_norms(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 0.1_wp, tolerance = 1.0e-9_wp  ! of comparisons, relative
      real(wp), parameter :: rate(3) = [1.0_wp, 2.0_wp, -1.5_wp], start(3) = [100.0_wp, 0.5_wp, 3.0_wp]
      type(growth_t) :: all_three, single
      real(wp) :: e(3), size_of(3)
      integer :: k

      single%n = 1
      single%scale = [1.0_wp]
      do k = 1, 3
         single%rate = [rate(k)]
         e(k) = estimate_of(single, 0.0_wp, [start(k)], h, norm_absolute)
      end do
      size_of = start*exp(rate*h)
      all_three%n = 3
      all_three%rate = rate
      all_three%scale = [70.0_wp, 0.2_wp, 5.0_wp]
      call check_close(error, norm_of(norm_absolute), maxval(e), tolerance, "absolute", relative=.true.)
      call check_close(error, norm_of(norm_mixed), maxval(e/max(size_of, 1.0_wp)), tolerance, "mixed", relative=.true.)
      call check_close(error, norm_of(norm_relative, 1.0e-3_wp), maxval(e/size_of), tolerance, "relative", relative=.true.)
      call check_close(error, norm_of(norm_relative, 50.0_wp), maxval(e/max(size_of, 50.0_wp)), tolerance, &
                       "relative above its floor", relative=.true.)
      call check_close(error, norm_of(norm_euclidean), norm2(e/max(size_of, 1.0_wp)), tolerance, "euclidean", relative=.true.)
      call check_close(error, norm_of(norm_scaled), maxval(e/all_three%scale), tolerance, "scaled", relative=.true.)

   contains

      !> Estimate of all three equations in a norm.
      real(wp) function norm_of(norm, floor)
         integer, intent(in) :: norm                !! the norm
         real(wp), intent(in), optional :: floor    !! of the relative norm [any]

         norm_of = estimate_of(all_three, 0.0_wp, start, h, norm, floor)
      end function norm_of

   end subroutine test_norms

   !> A place in the last step, to the accuracy of the method; the integrator is left as it was.
   subroutine test_refine(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      real(wp) :: after(4), before(4), inner(4), t, y(4)
      integer :: status

      call new_kepler(0.3_wp, system, y)
      method%controls%tolerance = 1.0e-12_wp
      call method%start(system, 0.0_wp, y, 2.0_wp, status)
      call method%advance(system, 2.0_wp, status)
      call method%advance(system, 2.0_wp, status)
      before = method%step%y1
      t = method%t
      call method%refine(system, 0.3_wp, inner, status)
      after = method%step%y1
      call check_equal(error, status, 0, "status")
      call check_close(error, inner, system%exact(method%step%t0 + 0.3_wp*method%step%h), 1.0e-12_wp, "state within")
      call check_close(error, [after, method%t], [before, t], 0.0_wp, "the present state")
   end subroutine test_refine

end module test_verner
