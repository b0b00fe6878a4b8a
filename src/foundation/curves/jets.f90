!> Jets: a function of time with its first and second derivative, `u = [u, u', u'']`.
!>
!> Exact rules of differentiation, no differences. Where a value does not exist, as sqrt(-1) or 1/0,
!> the jet is NaN; where only a derivative is infinite, as of sqrt at 0, only the derivatives are NaN
!> (0 if the argument does not move). What is beyond the largest number is no number either: it may raise `overflow`, which
!> stops no program, and nothing else.
module jets
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: jet_acos, jet_asin, jet_atan, jet_atan2, jet_chain, jet_cosh, jet_exp, jet_integer_power, jet_log
   public :: jet_power, jet_product, jet_quotient, jet_real_power, jet_sinh, jet_sqrt, jet_tan, jet_tanh

   real(wp), parameter :: largest_exponent = 709.0_wp  !! exp of more overflows [1]

contains

   !> A function of a jet, from the function's own derivatives.
   pure function jet_chain(u, f, df, ddf) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument and derivatives [any]
      real(wp), intent(in) :: f     !! f(u) [any]
      real(wp), intent(in) :: df    !! f'(u) [any]
      real(wp), intent(in) :: ddf   !! f''(u) [any]
      real(wp) :: v(3)              !! (3) f(u(t)) and its derivatives [any]

      v(1) = f
      if (.not. (ieee_is_finite(df) .and. ieee_is_finite(ddf))) then
         v(2:) = not_a_number()  ! only here: it saves and restores the state of the processor
         return
      end if
      v(2) = df*u(2)
      v(3) = total(ddf*u(2)*u(2), df*u(3))  ! in this order: the square alone may overflow where ddf is 0
   end function jet_chain

   !> A sum; NaN if one of both is beyond the largest number.
   pure real(wp) function total(a, b) result(c)
      real(wp), intent(in) :: a  !! one part [any]
      real(wp), intent(in) :: b  !! the other [any]

      if (ieee_is_finite(a) .and. ieee_is_finite(b)) then
         c = a + b
      else
         c = not_a_number()
      end if
   end function total

   !> A jet whose derivatives do not exist unless the argument rests.
   pure function jet_singular(u, f) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument and derivatives [any]
      real(wp), intent(in) :: f     !! value, may be NaN [any]
      real(wp) :: v(3)              !! (3) value and derivatives [any]

      v = [f, not_a_number(), not_a_number()]
      if (.not. (ieee_is_finite(u(2)) .and. ieee_is_finite(u(3)))) return
      if (.not. (abs(u(2)) > 0.0_wp .or. abs(u(3)) > 0.0_wp)) v(2:3) = 0.0_wp
   end function jet_singular

   !> A jet that does not exist.
   pure function jet_none() result(v)
      real(wp) :: v(3)  !! (3) NaN [any]

      v = not_a_number()
   end function jet_none

   !> a*b
   pure function jet_product(a, b) result(v)
      real(wp), intent(in) :: a(3)  !! (3) one factor [any]
      real(wp), intent(in) :: b(3)  !! (3) the other [any]
      real(wp) :: v(3)              !! (3) the product [any]

      v(1) = a(1)*b(1)
      v(2) = total(a(2)*b(1), a(1)*b(2))
      v(3) = total(total(a(3)*b(1), 2.0_wp*(a(2)*b(2))), a(1)*b(3))
   end function jet_product

   !> a/b
   pure function jet_quotient(a, b) result(v)
      real(wp), intent(in) :: a(3)  !! (3) numerator [any]
      real(wp), intent(in) :: b(3)  !! (3) denominator [any]
      real(wp) :: v(3)              !! (3) the quotient [any]

      v = jet_none()
      if (.not. abs(b(1)) > 0.0_wp) return
      v(1) = a(1)/b(1)
      if (.not. ieee_is_finite(v(1))) return
      v(2) = total(a(2), -v(1)*b(2))/b(1)
      if (.not. ieee_is_finite(v(2))) return
      v(3) = total(total(a(3), -2.0_wp*(v(2)*b(2))), -v(1)*b(3))/b(1)
   end function jet_quotient

   !> u**n with an integer exponent, any sign of u
   pure function jet_integer_power(u, n) result(v)
      real(wp), intent(in) :: u(3)  !! (3) base [any]
      integer, intent(in) :: n      !! exponent
      real(wp) :: v(3)              !! (3) the power [any]

      select case (n)
      case (0)
         v = [1.0_wp, 0.0_wp, 0.0_wp]
      case (1)
         v = u
      case default
         if (n < 0 .and. .not. abs(u(1)**abs(n - 2)) > 0.0_wp) then  ! what the derivatives are divided by
            v = jet_none()
         else
            v = jet_chain(u, u(1)**n, n*u(1)**(n - 1), real(n, wp)*(n - 1)*u(1)**(n - 2))
         end if
      end select
   end function jet_integer_power

   !> u**p with a constant real exponent, u not negative
   pure function jet_real_power(u, p) result(v)
      real(wp), intent(in) :: u(3)  !! (3) base [any]
      real(wp), intent(in) :: p     !! exponent, not an integer or a large one [1]
      real(wp) :: v(3)              !! (3) the power [any]

      if (u(1) > 0.0_wp) then
         v = jet_chain(u, u(1)**p, p*u(1)**(p - 1.0_wp), p*(p - 1.0_wp)*u(1)**(p - 2.0_wp))
      else if (u(1) < 0.0_wp .or. p < 0.0_wp) then
         v = jet_none()
      else if (p > 2.0_wp) then
         v = 0.0_wp
      else if (p > 1.0_wp) then
         v = jet_singular([u(1), u(2), 0.0_wp], 0.0_wp)
         v(2) = 0.0_wp
      else
         v = jet_singular(u, 0.0_wp)
      end if
   end function jet_real_power

   !> a**b with both moving, a positive
   pure function jet_power(a, b) result(v)
      real(wp), intent(in) :: a(3)  !! (3) base [any]
      real(wp), intent(in) :: b(3)  !! (3) exponent [1]
      real(wp) :: v(3)              !! (3) the power [any]

      if (a(1) > 0.0_wp) then
         v = jet_exp(jet_product(b, jet_log(a)))
      else
         v = jet_none()
      end if
   end function jet_power

   !> exp(u)
   pure function jet_exp(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [1]

      real(wp) :: f

      if (u(1) > largest_exponent) then
         v = jet_none()
      else
         f = exp(u(1))
         v = jet_chain(u, f, f, f)
      end if
   end function jet_exp

   !> log(u), natural
   pure function jet_log(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [1]

      if (u(1)**2 > 0.0_wp .and. u(1) > 0.0_wp) then
         v = jet_chain(u, log(u(1)), 1.0_wp/u(1), -1.0_wp/u(1)**2)
      else if (u(1) > 0.0_wp) then
         v = jet_singular(u, log(u(1)))
      else
         v = jet_none()
      end if
   end function jet_log

   !> sqrt(u)
   pure function jet_sqrt(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [any]
      real(wp) :: v(3)              !! (3) value and derivatives [any]

      real(wp) :: f

      if (u(1) > 0.0_wp) then
         f = sqrt(u(1))
         v = jet_singular(u, f)
         if (f*u(1) > 0.0_wp) v = jet_chain(u, f, 0.5_wp/f, -0.25_wp/(f*u(1)))
      else if (u(1) < 0.0_wp) then
         v = jet_none()
      else
         v = jet_singular(u, 0.0_wp)
      end if
   end function jet_sqrt

   !> tan(u)
   pure function jet_tan(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [rad]
      real(wp) :: v(3)              !! (3) value and derivatives [1]

      real(wp) :: f

      f = tan(u(1))
      v = jet_chain(u, f, 1.0_wp + f**2, 2.0_wp*f*(1.0_wp + f**2))
   end function jet_tan

   !> asin(u)
   pure function jet_asin(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [rad]

      real(wp) :: s

      s = (1.0_wp - u(1))*(1.0_wp + u(1))
      if (s > 0.0_wp) then
         v = jet_chain(u, asin(u(1)), 1.0_wp/sqrt(s), u(1)/(s*sqrt(s)))
      else if (s < 0.0_wp) then
         v = jet_none()
      else
         v = jet_singular(u, asin(u(1)))
      end if
   end function jet_asin

   !> acos(u)
   pure function jet_acos(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [rad]

      v = -jet_asin(u)
      if (abs(u(1)) <= 1.0_wp) v(1) = acos(u(1))
   end function jet_acos

   !> atan(u)
   pure function jet_atan(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [rad]

      real(wp) :: s

      s = 1.0_wp + u(1)**2
      v = jet_chain(u, atan(u(1)), 1.0_wp/s, -2.0_wp*(u(1)/s/s))
   end function jet_atan

   !> The angle of the point (x, y), from -pi to pi
   pure function jet_atan2(y, x) result(v)
      real(wp), intent(in) :: y(3)  !! (3) ordinate [any]
      real(wp), intent(in) :: x(3)  !! (3) abscissa [any]
      real(wp) :: v(3)              !! (3) value and derivatives [rad]

      real(wp) :: square

      square = x(1)**2 + y(1)**2
      v = jet_none()
      if (.not. (square > 0.0_wp .and. ieee_is_finite(square))) return
      v(1) = atan2(y(1), x(1))
      v(2) = total(x(1)*y(2), -y(1)*x(2))/square
      if (.not. ieee_is_finite(v(2))) return
      v(3) = total(total(x(1)*y(3), -y(1)*x(3)), -2.0_wp*(v(2)*total(x(1)*x(2), y(1)*y(2))))/square
   end function jet_atan2

   !> sinh(u)
   pure function jet_sinh(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [1]

      if (abs(u(1)) > largest_exponent) then
         v = jet_none()
      else
         v = jet_chain(u, sinh(u(1)), cosh(u(1)), sinh(u(1)))
      end if
   end function jet_sinh

   !> cosh(u)
   pure function jet_cosh(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [1]

      if (abs(u(1)) > largest_exponent) then
         v = jet_none()
      else
         v = jet_chain(u, cosh(u(1)), sinh(u(1)), cosh(u(1)))
      end if
   end function jet_cosh

   !> tanh(u)
   pure function jet_tanh(u) result(v)
      real(wp), intent(in) :: u(3)  !! (3) argument [1]
      real(wp) :: v(3)              !! (3) value and derivatives [1]

      real(wp) :: f, df

      f = tanh(u(1))
      df = (1.0_wp - f)*(1.0_wp + f)
      v = jet_chain(u, f, df, -2.0_wp*f*df)
   end function jet_tanh

end module jets
