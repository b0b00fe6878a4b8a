!> Bounds of an expression and its derivatives over an interval of its first variable.
!>
!> The program of the expression is run on jets of intervals (value, first and second derivative). Each operation gives an
!> enclosure, so that what is said to be excluded is excluded; the bounds close in on the values as the interval gets
!> shorter. Where a function does not exist on part of an interval, its bounds are those of the rest, or none.
!> Of an expression that steps or folds the derivatives hold on either side of that place, not across it.
!>
!> Source: R. E. Moore, Methods and applications of interval analysis, SIAM (1979), chapters 3 and 4.
!> Limits: floating-point exceptions may be raised, as in `intervals`.
module expression_bounds
   use curve_bounds, only: bound_curve
   use expression, only: expression_t, op_abs, op_acos, op_add, op_asin, op_atan, op_atan2, op_cos, op_cosh, op_curve, op_divide, &
      op_exp, op_integer_power, op_log, op_log10, op_max, op_min, op_multiply, op_negate, op_number, op_power, op_real_power, &
      op_rise, op_sin, op_sinh, op_sqrt, op_step, op_subtract, op_tan, op_tanh, op_time, stack_size
   use intervals, only: holds_zero, hull, inverse, line, magnitude, power_of, product_of, sine_of, sum_of, times, widened
   use kinds, only: two_pi, wp
   use rise_laws, only: bound_rise
   implicit none (type, external)
   private
   public :: bound_expression

   real(wp), parameter :: one(2) = 1.0_wp   !! an interval [1]

contains

   !> Bounds of the expression, and of what each of its operations bends.
   subroutine bound_expression(expression, t, jet, range, bend)
      type(expression_t), intent(in) :: expression   !! the expression
      real(wp), intent(in) :: t(2)                   !! (2) interval of the first variable [s or any]
      real(wp), intent(out) :: jet(2, 3)             !! (2, 3) bounds of value, first and second derivative [any]
      real(wp), intent(out) :: range(2, size(expression%code))  !! (2, n) bounds of the result of each operation [any]
      real(wp), intent(out) :: bend(size(expression%code))      !! (n) its maximum second derivative, 0: no scale of its own [any]

      real(wp) :: stack(2, 3, stack_size)
      integer :: k, top

      top = 0
      bend = 0.0_wp
      do k = 1, size(expression%code)
         select case (expression%code(k))
         case (op_number)
            top = top + 1
            stack(:, :, top) = 0.0_wp
            stack(:, 1, top) = expression%operand(k)
         case (op_time)
            top = top + 1
            stack(:, :, top) = 0.0_wp
            if (nint(expression%operand(k)) == 1) then
               stack(:, 1, top) = t
               stack(:, 2, top) = 1.0_wp
            else
               stack(:, 1, top) = expression%others(nint(expression%operand(k)))
            end if
         case (op_add:op_atan2)
            top = top - 1
            stack(:, :, top) = of_two(expression%code(k), stack(:, :, top), stack(:, :, top + 1))
         case (op_rise)
            stack(:, :, top) = of_rise(nint(expression%operand(k)), stack(:, :, top))
         case (op_curve)
            stack(:, :, top) = of_curve(expression, k, stack(:, :, top))
         case default
            stack(:, :, top) = of_one(expression%code(k), expression%operand(k), stack(:, :, top))
         end select
         range(:, k) = stack(:, 1, top)
         select case (expression%code(k))
         case (op_number, op_time, op_add, op_subtract, op_multiply, op_negate, op_step)
            continue
         case default
            bend(k) = magnitude(stack(:, 3, top))
         end select
      end do
      jet = stack(:, :, 1)
   end subroutine bound_expression

   !> A jet that nothing is known of.
   pure function unbounded() result(v)
      real(wp) :: v(2, 3)  !! (2, 3) lines [any]

      v = spread(line(), 2, 3)
   end function unbounded

   !> A function of a jet from bounds of the function's own derivatives.
   pure function chain(u, f, df, ddf) result(v)
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [any]
      real(wp), intent(in) :: f(2)     !! (2) f [any]
      real(wp), intent(in) :: df(2)    !! (2) f' [any]
      real(wp), intent(in) :: ddf(2)   !! (2) f'' [any]
      real(wp) :: v(2, 3)              !! (2, 3) f(u(t)) [any]

      v(:, 1) = widened(f)
      v(:, 2) = product_of(df, u(:, 2))
      v(:, 3) = sum_of(product_of(ddf, power_of(u(:, 2), 2)), product_of(df, u(:, 3)))
   end function chain

   !> a b
   pure function product_jet(a, b) result(v)
      real(wp), intent(in) :: a(2, 3)  !! (2, 3) one factor [any]
      real(wp), intent(in) :: b(2, 3)  !! (2, 3) the other [any]
      real(wp) :: v(2, 3)              !! (2, 3) the product [any]

      v(:, 1) = product_of(a(:, 1), b(:, 1))
      v(:, 2) = sum_of(product_of(a(:, 2), b(:, 1)), product_of(a(:, 1), b(:, 2)))
      v(:, 3) = sum_of(sum_of(product_of(a(:, 3), b(:, 1)), times(2.0_wp, product_of(a(:, 2), b(:, 2)))), &
                       product_of(a(:, 1), b(:, 3)))
   end function product_jet

   !> An operation on two jets.
   pure recursive function of_two(op, a, b) result(v)
      integer, intent(in) :: op        !! the operation
      real(wp), intent(in) :: a(2, 3)  !! (2, 3) first operand [any]
      real(wp), intent(in) :: b(2, 3)  !! (2, 3) second operand [any]
      real(wp) :: v(2, 3)              !! (2, 3) result [any]

      real(wp) :: d(2)
      integer :: i

      select case (op)
      case (op_add, op_subtract)
         do i = 1, 3
            d = b(:, i)
            if (op == op_subtract) d = [-b(2, i), -b(1, i)]
            v(:, i) = sum_of(a(:, i), d)
         end do
      case (op_multiply)
         v = product_jet(a, b)
      case (op_divide)
         d = inverse(b(:, 1))
         v = product_jet(a, chain(b, d, times(-1.0_wp, power_of(d, 2)), times(2.0_wp, power_of(d, 3))))
      case (op_power)
         v = of_one(op_exp, 0.0_wp, product_jet(b, of_one(op_log, 0.0_wp, a)))
      case (op_min, op_max)
         do i = 1, 3
            v(:, i) = hull(a(:, i), b(:, i))
         end do
         if (op == op_min) v(:, 1) = [min(a(1, 1), b(1, 1)), min(a(2, 1), b(2, 1))]
         if (op == op_max) v(:, 1) = [max(a(1, 1), b(1, 1)), max(a(2, 1), b(2, 1))]
      case default
         v = angle_of(a, b)
      end select
   end function of_two

   !> The angle of the point (x, y).
   pure function angle_of(y, x) result(v)
      real(wp), intent(in) :: y(2, 3)  !! (2, 3) ordinate [any]
      real(wp), intent(in) :: x(2, 3)  !! (2, 3) abscissa [any]
      real(wp) :: v(2, 3)              !! (2, 3) the angle [rad]

      real(wp) :: cross(2), inverse_square(2), radial(2)
      integer :: i, j

      v = unbounded()
      v(:, 1) = [-0.5_wp, 0.5_wp]*two_pi
      inverse_square = inverse(sum_of(power_of(x(:, 1), 2), power_of(y(:, 1), 2)))
      if (.not. magnitude(inverse_square) < huge(1.0_wp)) return
      if (x(1, 1) > 0.0_wp .or. y(1, 1) > 0.0_wp .or. y(2, 1) < 0.0_wp) then
         v(:, 1) = atan2(y(1, 1), x(1, 1))
         do i = 1, 2
            do j = 1, 2
               v(:, 1) = hull(v(:, 1), [atan2(y(i, 1), x(j, 1)), atan2(y(i, 1), x(j, 1))])
            end do
         end do
         v(:, 1) = widened(v(:, 1))
      end if
      cross = difference(product_of(x(:, 1), y(:, 2)), product_of(y(:, 1), x(:, 2)))
      v(:, 2) = product_of(cross, inverse_square)
      cross = difference(product_of(x(:, 1), y(:, 3)), product_of(y(:, 1), x(:, 3)))
      radial = times(2.0_wp, sum_of(product_of(x(:, 1), x(:, 2)), product_of(y(:, 1), y(:, 2))))
      v(:, 3) = product_of(difference(cross, product_of(v(:, 2), radial)), inverse_square)
   end function angle_of

   !> a - b
   pure function difference(a, b) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      real(wp), intent(in) :: b(2)  !! (2) bounds [any]
      real(wp) :: x(2)              !! (2) bounds [any]

      x = sum_of(a, [-b(2), -b(1)])
   end function difference

   !> A law that rises, of a jet.
   pure function of_rise(law, u) result(v)
      integer, intent(in) :: law       !! number of the law
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [1]
      real(wp) :: v(2, 3)              !! (2, 3) s(u(t)) [1]

      real(wp) :: f(2, 3)

      f = bound_rise(law, u(:, 1))
      v = chain(u, f(:, 1), f(:, 2), f(:, 3))
   end function of_rise

   !> A named function of a jet.
   function of_curve(expression, k, u) result(v)
      type(expression_t), intent(in) :: expression  !! the expression
      integer, intent(in) :: k                      !! number of the operation
      real(wp), intent(in) :: u(2, 3)               !! (2, 3) argument [any]
      real(wp) :: v(2, 3)                           !! (2, 3) result [any]

      real(wp) :: f(2, 3)

      call bound_curve(expression%curves(nint(expression%operand(k))), u(:, 1), f)
      v = chain(u, f(:, 1), f(:, 2), f(:, 3))
   end function of_curve

   !> A function of one jet. A domain is cut off where it ends.
   pure recursive function of_one(op, operand, u) result(v)
      integer, intent(in) :: op        !! the operation
      real(wp), intent(in) :: operand  !! its number [any]
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [any]
      real(wp) :: v(2, 3)              !! (2, 3) result [any]

      real(wp), parameter :: log_of_ten = log(10.0_wp)  ! turns natural into decimal logarithms [1]
      real(wp) :: a(2), d(2), f(2)
      integer :: n

      a = u(:, 1)
      select case (op)
      case (op_negate)
         v = negative(u)
      case (op_sin)
         f = sine_of(a)
         v = chain(u, f, sine_of(a + 0.25_wp*two_pi), [-f(2), -f(1)])
      case (op_cos)
         f = sine_of(a + 0.25_wp*two_pi)
         d = sine_of(a)
         v = chain(u, f, [-d(2), -d(1)], [-f(2), -f(1)])
      case (op_tan)
         v = of_two(op_divide, of_one(op_sin, 0.0_wp, u), of_one(op_cos, 0.0_wp, u))
      case (op_asin, op_acos)
         v = arc_sine(u)
         if (op == op_acos) v = of_two(op_subtract, constant(0.25_wp*two_pi), v)
      case (op_atan)
         d = inverse(sum_of(one, power_of(a, 2)))
         v = chain(u, atan(a), d, times(-2.0_wp, product_of(a, power_of(d, 2))))
      case (op_sinh, op_cosh, op_tanh)
         v = hyperbolic(op, u)
      case (op_exp)
         f = exp(a)
         v = chain(u, f, f, f)
      case (op_log)
         v = logarithm(u)
      case (op_log10)
         v = product_jet(logarithm(u), constant(1.0_wp/log_of_ten))
      case (op_sqrt)
         v = real_power(u, 0.5_wp)
      case (op_real_power)
         v = real_power(u, operand)
      case (op_integer_power)
         n = nint(operand)
         v = chain(u, power_of(a, n), times(real(n, wp), power_of(a, n - 1)), times(real(n, wp)*(n - 1), power_of(a, n - 2)))
         if (n == 1) v = u
      case (op_abs)
         v = absolute(u)
      case default
         v = 0.0_wp
         if (a(2) >= 0.0_wp) v(2, 1) = 1.0_wp
         if (a(1) >= 0.0_wp) v(1, 1) = 1.0_wp
      end select
   end function of_one

   !> The absolute value of one jet.
   pure function absolute(u) result(v)
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [any]
      real(wp) :: v(2, 3)              !! (2, 3) result [any]

      integer :: i

      v = u
      if (u(2, 1) < 0.0_wp) v = negative(u)
      if (.not. holds_zero(u(:, 1))) return
      v(:, 1) = [0.0_wp, magnitude(u(:, 1))]
      do i = 2, 3
         v(:, i) = magnitude(u(:, i))*[-1.0_wp, 1.0_wp]
      end do
   end function absolute

   !> A jet with its sign turned.
   pure function negative(u) result(v)
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [any]
      real(wp) :: v(2, 3)              !! (2, 3) result [any]

      integer :: i

      do i = 1, 3
         v(:, i) = [-u(2, i), -u(1, i)]
      end do
   end function negative

   !> A hyperbolic function of one jet.
   pure function hyperbolic(op, u) result(v)
      integer, intent(in) :: op        !! the operation
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [1]
      real(wp) :: v(2, 3)              !! (2, 3) result [1]

      real(wp) :: a(2), d(2), f(2)

      a = u(:, 1)
      if (op == op_tanh) then
         f = tanh(a)
         ! 1 - tanh^2 falls from 1 on both sides of zero
         d = [1.0_wp/cosh(min(magnitude(a), 300.0_wp))**2, 1.0_wp]
         if (.not. holds_zero(a)) d(2) = 1.0_wp/cosh(min(abs(a(1)), abs(a(2)), 300.0_wp))**2
         v = chain(u, f, d, times(-2.0_wp, product_of(f, d)))
         return
      end if
      f = sinh(a)
      d = [1.0_wp, max(cosh(a(1)), cosh(a(2)))]
      if (.not. holds_zero(a)) d(1) = min(cosh(a(1)), cosh(a(2)))
      v = chain(u, f, d, f)
      if (op == op_cosh) v = chain(u, d, f, d)
   end function hyperbolic

   !> The natural logarithm of one jet; its domain is cut off at zero.
   pure function logarithm(u) result(v)
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [1]
      real(wp) :: v(2, 3)              !! (2, 3) result [1]

      real(wp) :: d(2)

      v = unbounded()
      if (.not. u(2, 1) > 0.0_wp) return
      d = inverse([max(u(1, 1), 0.0_wp), u(2, 1)])
      v = chain(u, log(max(u(:, 1), 0.0_wp)), d, times(-1.0_wp, power_of(d, 2)))
   end function logarithm

   !> A jet that does not move.
   pure function constant(x) result(v)
      real(wp), intent(in) :: x  !! its value [any]
      real(wp) :: v(2, 3)        !! (2, 3) the jet [any]

      v = 0.0_wp
      v(:, 1) = x
   end function constant

   !> The arc sine: f' = 1/sqrt(1 - u^2), f'' = u f'^3.
   pure function arc_sine(u) result(v)
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) argument [any]
      real(wp) :: v(2, 3)              !! (2, 3) result [rad]

      real(wp) :: a(2), d(2), s(2)

      v = unbounded()
      if (u(1, 1) > 1.0_wp .or. u(2, 1) < -1.0_wp) return
      a = min(max(u(:, 1), -1.0_wp), 1.0_wp)
      s = difference(one, power_of(a, 2))
      d = inverse(sqrt(max(s, 0.0_wp)))
      v = chain(u, asin(a), d, product_of(a, power_of(d, 3)))
   end function arc_sine

   !> u**p of u that is not negative, p no integer.
   pure function real_power(u, p) result(v)
      real(wp), intent(in) :: u(2, 3)  !! (2, 3) base [any]
      real(wp), intent(in) :: p        !! exponent [1]
      real(wp) :: v(2, 3)              !! (2, 3) result [any]

      v = unbounded()
      if (u(2, 1) < 0.0_wp) return
      v = chain(u, power(p), times(p, power(p - 1.0_wp)), times(p*(p - 1.0_wp), power(p - 2.0_wp)))

   contains

      !> Bounds of the base to a power.
      pure function power(q) result(x)
         real(wp), intent(in) :: q  !! the exponent [1]
         real(wp) :: x(2)           !! (2) bounds [any]

         real(wp) :: a(2)

         a = max(u(:, 1), 0.0_wp)
         if (q < 0.0_wp .and. .not. a(1) > 0.0_wp) then
            x = line()
            if (a(2) > 0.0_wp) x(1) = a(2)**q
         else
            x = a**q
            x = widened([minval(x), maxval(x)])
         end if
      end function power

   end function real_power

end module expression_bounds
