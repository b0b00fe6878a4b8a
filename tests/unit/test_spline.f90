!> Curves and splines: exact where they must be, smooth at the samples, of the order that theory gives.
module test_spline
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use akima, only: new_akima
   use check, only: check_close, check_true, suite_t
   use curve, only: beyond_error, beyond_stabilisation, beyond_linear, beyond_periodic, beyond_same, curve_t, curve_values, &
        jet_of_curve
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, pi, wp
   use spline, only: ends_clamped, ends_fmm, ends_natural, ends_not_a_knot, ends_periodic, new_spline
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_spline

   integer, parameter :: all_ends(5) = [ends_not_a_knot, ends_natural, ends_clamped, ends_periodic, ends_fmm]
   character(*), parameter :: names(5) = [character(10) :: "not_a_knot", "natural", "clamped", "periodic", "fmm"]

contains

   subroutine run_test_spline(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("samples", test_samples)
      call suite%test("cubic", test_cubic)
      call suite%test("smooth", test_smooth)
      call suite%test("ends", test_ends)
      call suite%test("order", test_order)
      call suite%test("akima", test_akima)
      call suite%test("beyond", test_beyond)
      call suite%test("round_off", test_round_off)
      call suite%test("sine_and_polynomial", test_sine_and_polynomial)
      call suite%test("chain", test_chain)
   end subroutine run_test_spline

   !> A spline through random samples, unevenly spaced; closed if it must be.
   subroutine random_spline(ends, n, x, y, curve)
      integer, intent(in) :: ends                  !! how it is closed
      integer, intent(in) :: n                     !! number of samples
      real(wp), intent(out) :: x(n)                !! (n) places [1]
      real(wp), intent(out) :: y(n)                !! (n) values [1]
      type(curve_t), intent(out) :: curve          !! the spline

      type(random_t) :: random
      integer :: k

      random%state = int(77 + n, i8)
      x(1) = -1.3_wp
      do k = 2, n
         x(k) = x(k - 1) + random%between(0.2_wp, 1.5_wp)
      end do
      y = random%vector(n, -2.0_wp, 2.0_wp)
      if (ends == ends_periodic) y(n) = y(1)
      call new_spline(x, y, ends, beyond_same, curve)
   end subroutine random_spline

   !> It goes through its samples, few or many.
   subroutine test_samples(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp) :: f(3), x(25), y(25)
      integer :: e, k, n

      do e = 1, size(all_ends)
         do n = 4, 25, 7
            call random_spline(all_ends(e), n, x(:n), y(:n), curve)
            do k = 1, n
               call curve_values(curve, x(k), f)
               call check_close(error, f(1), y(k), 1.0e-13_wp, trim(names(e))//", "//to_text(n)//" samples")
            end do
         end do
      end do
   end subroutine test_samples

   !> Not-a-knot and fmm give back a cubic with its derivatives, from four samples on.
   subroutine test_cubic(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: ends(2) = [ends_not_a_knot, ends_fmm]
      type(curve_t) :: curve
      real(wp) :: f(3), t, x(9), y(9)
      integer :: case, k, n

      x = [-2.0_wp, -1.5_wp, 0.1_wp, 0.2_wp, 1.0_wp, 3.0_wp, 3.5_wp, 5.0_wp, 5.1_wp]
      y = 2.0_wp - x + 0.5_wp*x**2 - 0.25_wp*x**3
      do case = 0, 11
         n = 4 + case/2
         call new_spline(x(:n), y(:n), ends(1 + modulo(case, 2)), beyond_same, curve)
         do k = 0, 20
            t = x(1) - 0.3_wp + (x(n) - x(1) + 0.6_wp)*k/20
            call curve_values(curve, t, f)
            call check_close(error, f, [2.0_wp - t + 0.5_wp*t**2 - 0.25_wp*t**3, -1.0_wp + t - 0.75_wp*t**2, &
                                        1.0_wp - 1.5_wp*t], 1.0e-11_wp, "cubic of "//to_text(n)//" samples")
         end do
      end do
   end subroutine test_cubic

   !> Value, slope and curvature have no jump at any sample; derivatives are those of the value.
   subroutine test_smooth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: near = 1.0e-9_wp, step = 1.0e-5_wp
      type(curve_t) :: curve
      real(wp) :: after(3), before(3), f(3), x(12), y(12)
      integer :: e, k

      do e = 1, size(all_ends)
         call random_spline(all_ends(e), 12, x, y, curve)
         do k = 2, 11
            call curve_values(curve, x(k) - near, before)
            call curve_values(curve, x(k) + near, after)
            call check_close(error, after, before, 1.0e-6_wp, trim(names(e))//": no jump at a sample")
            f = 0.0_wp
            call curve_values(curve, x(k) + 0.1_wp, f)
            call curve_values(curve, x(k) + 0.1_wp - step, before)
            call curve_values(curve, x(k) + 0.1_wp + step, after)
            call check_close(error, (after(1:2) - before(1:2))/(2.0_wp*step), f(2:3), 1.0e-7_wp, trim(names(e))//": derivatives")
         end do
      end do
   end subroutine test_smooth

   !> What closes each spline holds at its ends.
   subroutine test_ends(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp) :: first(3), last(3), x(10), y(10)
      integer :: e

      do e = 1, size(all_ends)
         call random_spline(all_ends(e), 10, x, y, curve)
         call curve_values(curve, x(1), first)
         call curve_values(curve, x(10), last)
         select case (all_ends(e))
         case (ends_natural)
            call check_close(error, [first(3), last(3)], [0.0_wp, 0.0_wp], 1.0e-12_wp, "natural: no curvature")
         case (ends_clamped)
            call check_close(error, [first(2), last(2)], [0.0_wp, 0.0_wp], 1.0e-12_wp, "clamped: no slope")
         case (ends_periodic)
            call check_close(error, last, first, 1.0e-12_wp, "periodic: the end is the start")
         case (ends_fmm)
            call check_close(error, 6.0_wp*curve%c(3, [1, 9]), [third_of(x(:4), y(:4)), third_of(x(7:), y(7:))], 1.0e-12_wp, &
                             "fmm: third derivatives")
         case default
            call check_close(error, curve%c(3, [1, 9]), curve%c(3, [2, 8]), 1.0e-12_wp, "not a knot: one cubic")
         end select
      end do
   end subroutine test_ends

   !> Akima's curve: against scipy 1.10's (`Akima1DInterpolator`), straight where its chords are, with a period.
   subroutine test_akima(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: x(7) = [-1.0_wp, -0.2_wp, 0.3_wp, 1.0_wp, 1.4_wp, 2.6_wp, 3.0_wp]
      real(wp), parameter :: y(7) = [0.5_wp, 1.2_wp, -0.7_wp, -0.7_wp, 2.0_wp, 2.1_wp, -1.0_wp]
      real(wp), parameter :: t(6) = [-0.6_wp, 0.0_wp, 0.8_wp, 1.2_wp, 2.0_wp, 2.9_wp]
      real(wp), parameter :: want(3, 6) = reshape([ &
         1.341633480825959_wp, 0.9353337020648969_wp, -6.145418510324482_wp, &
         0.5162875699541063_wp, -4.549115315350205_wp, -5.463789882715929_wp, &
         -1.041700773188619_wp, 0.9831512264552646_wp, 7.085722022435925_wp, &
         0.5893175614194723_wp, 8.596269335759786_wp, 3.034121929026398_wp, &
         3.127372742200329_wp, 0.08847837985769015_wp, -5.985404123335159_wp, &
         0.07465876436781745_wp, -9.806812739463602_wp, -19.18941570881228_wp], [3, 6])
      type(curve_t) :: curve
      real(wp) :: f(3), first(3), last(3)
      integer :: k

      call new_akima(x, y, beyond_error, curve)
      do k = 1, size(t)
         call curve_values(curve, t(k), f)
         call check_close(error, f, want(:, k), 1.0e-12_wp, "as scipy has it")
      end do
      call check_true(error, curve%bends, "its second derivative jumps")
      call new_akima([0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, 7.0_wp], &
                     [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 9.0_wp], beyond_same, curve)
      call curve_values(curve, 1.5_wp, f)
      call check_close(error, f, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, "a corner is not felt where chords are level")
      call curve_values(curve, 4.5_wp, f)
      call check_close(error, f, [1.5_wp, 1.0_wp, 0.0_wp], 1.0e-15_wp, "nor where they rise")
      call new_akima([0.0_wp, 1.0_wp, 2.5_wp, 3.0_wp, 4.0_wp], [1.0_wp, 3.0_wp, -1.0_wp, 0.0_wp, 1.0_wp], beyond_periodic, curve)
      call curve_values(curve, 0.0_wp, first)
      call curve_values(curve, 4.0_wp - 1.0e-12_wp, last)
      call check_close(error, last(1:2), first(1:2), 1.0e-10_wp, "the end of a period is its start")
   end subroutine test_akima

   !> Third derivative of the cubic through four samples, by Lagrange's formula.
   pure real(wp) function third_of(x, y) result(d)
      real(wp), intent(in) :: x(4)  !! (4) places [1]
      real(wp), intent(in) :: y(4)  !! (4) values [1]

      integer :: i, j

      d = 0.0_wp
      do i = 1, 4
         d = d + 6.0_wp*y(i)/product([(merge(1.0_wp, x(i) - x(j), i == j), j=1, 4)])
      end do
   end function third_of

   !> Against functions that fulfil the ends: errors of order 4, 3 and 2 in value and derivatives.
   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp), allocatable :: x(:), y(:)
      real(wp) :: exact(3), f(3), phase, t, worst(3, 2)
      integer :: e, k, n, refined

      do e = 1, size(all_ends)
         ! sin has no curvature at 0 and 2 pi, cos no slope; the others take any
         phase = 0.6_wp
         if (all_ends(e) == ends_natural) phase = 0.0_wp
         if (all_ends(e) == ends_clamped) phase = 0.5_wp*pi
         worst = 0.0_wp
         do refined = 1, 2
            n = 60*refined
            x = [(2.0_wp*pi*k/n, k=0, n)]
            y = sin(x + phase)
            call new_spline(x, y, all_ends(e), beyond_same, curve)
            do k = 0, 5000
               t = 2.0_wp*pi*k/5000
               exact = [sin(t + phase), cos(t + phase), -sin(t + phase)]
               call curve_values(curve, t, f)
               worst(:, refined) = max(worst(:, refined), abs(f - exact))
            end do
         end do
         call check_true(error, worst(1, 2) < 3.0e-7_wp, trim(names(e))//": small error")
         do k = 1, 3
            call check_close(error, log(worst(k, 1)/worst(k, 2))/log(2.0_wp), real(5 - k, wp), 0.25_wp, &
                             trim(names(e))//": order of derivative "//to_text(k - 1))
         end do
      end do
   end subroutine test_order

   !> Outside the samples.
   subroutine test_beyond(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp) :: f(3), first(3), inside(3), last(3), x(8), y(8)
      integer :: k

      call random_spline(ends_not_a_knot, 8, x, y, curve)
      call curve_values(curve, x(1), first)
      call curve_values(curve, x(8), last)
      curve%beyond = beyond_error
      call curve_values(curve, x(8) + 0.1_wp, f)
      call check_true(error, all(ieee_is_nan(f)), "nothing after the end")
      call curve_values(curve, x(1) - 0.1_wp, f)
      call check_true(error, all(ieee_is_nan(f)), "nothing before the start")
      curve%beyond = beyond_stabilisation
      call curve_values(curve, x(8) + 2.0_wp, f)
      call check_close(error, f, [y(8), 0.0_wp, 0.0_wp], 1.0e-13_wp, "held after the end")
      call curve_values(curve, x(1) - 2.0_wp, f)
      call check_close(error, f, [y(1), 0.0_wp, 0.0_wp], 1.0e-13_wp, "held before the start")
      curve%beyond = beyond_linear
      call curve_values(curve, x(8) + 2.0_wp, f)
      call check_close(error, f, [y(8) + 2.0_wp*last(2), last(2), 0.0_wp], 1.0e-12_wp, "tangent of the end")
      call curve_values(curve, x(1) - 2.0_wp, f)
      call check_close(error, f, [y(1) - 2.0_wp*first(2), first(2), 0.0_wp], 1.0e-12_wp, "tangent of the start")
      call random_spline(ends_periodic, 8, x, y, curve)
      curve%beyond = beyond_periodic
      do k = -3, 3
         call curve_values(curve, 0.7_wp*x(3) + 0.3_wp*x(4), inside)
         call curve_values(curve, 0.7_wp*x(3) + 0.3_wp*x(4) + k*(x(8) - x(1)), f)
         call check_close(error, f, inside, 1.0e-12_wp, "period "//to_text(k))
      end do
   end subroutine test_beyond

   !> An end that is missed by round-off only is still inside.
   subroutine test_round_off(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp) :: f(3), x(6), y(6)

      call random_spline(ends_natural, 6, x, y, curve)
      curve%beyond = beyond_error
      call curve_values(curve, x(6)*(1.0_wp + 4.0_wp*epsilon(1.0_wp)), f)
      call check_close(error, f(1), y(6), 1.0e-12_wp, "the last place and a little more")
      call curve_values(curve, x(1)*(1.0_wp + 4.0_wp*epsilon(1.0_wp)), f)
      call check_close(error, f(1), y(1), 1.0e-12_wp, "the first place and a little less")
   end subroutine test_round_off

   !> A polynomial about an origin plus a sine.
   subroutine test_sine_and_polynomial(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp) :: f(3), s, x
      integer :: k

      allocate (curve%x(1), source=0.5_wp)
      allocate (curve%c(0:3, 1))
      curve%c(:, 1) = [1.0_wp, -2.0_wp, 3.0_wp, 0.5_wp]
      curve%amplitude = 0.7_wp
      curve%angular_frequency = 3.0_wp
      curve%phase = 0.4_wp
      do k = -5, 5
         x = 0.37_wp*k
         s = x - 0.5_wp
         call curve_values(curve, x, f)
         call check_close(error, f, [1.0_wp - 2.0_wp*s + 3.0_wp*s**2 + 0.5_wp*s**3 + 0.7_wp*sin(3.0_wp*x + 0.4_wp), &
                                     -2.0_wp + 6.0_wp*s + 1.5_wp*s**2 + 2.1_wp*cos(3.0_wp*x + 0.4_wp), &
                                     6.0_wp + 3.0_wp*s - 6.3_wp*sin(3.0_wp*x + 0.4_wp)], 1.0e-13_wp, "value and derivatives")
      end do
   end subroutine test_sine_and_polynomial

   !> A curve of a moving argument, sin(t^2): derivatives by the chain rule.
   subroutine test_chain(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(curve_t) :: curve
      real(wp) :: t

      allocate (curve%x(1), source=0.0_wp)
      allocate (curve%c(0:0, 1), source=0.0_wp)
      curve%amplitude = 1.0_wp
      curve%angular_frequency = 1.0_wp
      t = 0.8_wp
      call check_close(error, jet_of_curve(curve, [t**2, 2.0_wp*t, 2.0_wp]), &
                       [sin(t**2), 2.0_wp*t*cos(t**2), 2.0_wp*cos(t**2) - 4.0_wp*t**2*sin(t**2)], 1.0e-14_wp, "chain rule")
   end subroutine test_chain

end module test_spline
