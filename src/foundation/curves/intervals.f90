!> Arithmetic of closed intervals [lower, upper], rounded outwards by a few last digits.
!>
!> Each result holds every value that the operation can have on its operands; where there is no bound, it is the whole
!> line. Infinite bounds are bounds; what would be 0 times infinity is 0.
!>
!> Source: R. E. Moore, Methods and applications of interval analysis, SIAM (1979), chapters 2 and 3.
!> Limits: floating-point exceptions may be raised; a caller sees to it that they do not stop the program.
module intervals
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan, ieee_negative_inf, ieee_positive_inf, ieee_value
   use kinds, only: eps, two_pi, wp
   implicit none (type, external)
   private
   public :: holds_zero, hull, inverse, line, magnitude, product_of, power_of, sine_of, sum_of, times, widened

   real(wp), parameter :: margin = 4.0_wp*eps  !! rounding of an operation, generously [1]

contains

   !> The whole line.
   pure function line() result(x)
      real(wp) :: x(2)  !! (2) minus to plus infinity [any]

      x = [ieee_value(1.0_wp, ieee_negative_inf), ieee_value(1.0_wp, ieee_positive_inf)]
   end function line

   !> An interval rounded outwards; the line if a bound is not a number.
   pure function widened(a) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      real(wp) :: x(2)              !! (2) bounds [any]

      if (ieee_is_nan(a(1)) .or. ieee_is_nan(a(2))) then
         x = line()
      else
         x = a
         if (ieee_is_finite(a(1))) x(1) = a(1) - margin*abs(a(1))
         if (ieee_is_finite(a(2))) x(2) = a(2) + margin*abs(a(2))
      end if
   end function widened

   !> Whether an interval holds zero.
   pure logical function holds_zero(a)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]

      holds_zero = a(1) <= 0.0_wp .and. a(2) >= 0.0_wp
   end function holds_zero

   !> Maximum absolute value.
   pure real(wp) function magnitude(a)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]

      magnitude = max(abs(a(1)), abs(a(2)))
   end function magnitude

   !> The minimum interval that holds two.
   pure function hull(a, b) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      real(wp), intent(in) :: b(2)  !! (2) bounds [any]
      real(wp) :: x(2)              !! (2) bounds [any]

      x = [min(a(1), b(1)), max(a(2), b(2))]
   end function hull

   !> a + b
   pure function sum_of(a, b) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      real(wp), intent(in) :: b(2)  !! (2) bounds [any]
      real(wp) :: x(2)              !! (2) bounds [any]

      x = widened(a + b)
   end function sum_of

   !> A number times an interval.
   pure function times(factor, a) result(x)
      real(wp), intent(in) :: factor  !! the number [any]
      real(wp), intent(in) :: a(2)    !! (2) bounds [any]
      real(wp) :: x(2)                !! (2) bounds [any]

      x = product_of([factor, factor], a)
   end function times

   !> a b
   pure function product_of(a, b) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      real(wp), intent(in) :: b(2)  !! (2) bounds [any]
      real(wp) :: x(2)              !! (2) bounds [any]

      real(wp) :: p(4)
      integer :: i, j

      do i = 1, 2
         do j = 1, 2
            p(2*i + j - 2) = 0.0_wp
            if (abs(a(i)) > 0.0_wp .and. abs(b(j)) > 0.0_wp) p(2*i + j - 2) = a(i)*b(j)
         end do
      end do
      x = widened([minval(p), maxval(p)])
   end function product_of

   !> 1/a
   pure function inverse(a) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      real(wp) :: x(2)              !! (2) bounds [any]

      if (holds_zero(a)) then
         x = line()
      else
         x = widened([1.0_wp/a(2), 1.0_wp/a(1)])
      end if
   end function inverse

   !> a**n
   pure recursive function power_of(a, n) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [any]
      integer, intent(in) :: n      !! exponent, of either sign
      real(wp) :: x(2)              !! (2) bounds [any]

      if (n < 0) then
         x = inverse(power_of(a, -n))
      else if (n == 0) then
         x = 1.0_wp
      else
         x = a**n
         if (mod(n, 2) == 0) then
            x = [minval(x), maxval(x)]
            if (holds_zero(a)) x(1) = 0.0_wp
         end if
         x = widened(x)
      end if
   end function power_of

   !> sin(a)
   pure function sine_of(a) result(x)
      real(wp), intent(in) :: a(2)  !! (2) bounds [rad]
      real(wp) :: x(2)              !! (2) bounds [1]

      real(wp) :: b(2)

      x = [-1.0_wp, 1.0_wp]
      b = widened(a)
      if (.not. b(2) - b(1) < two_pi) return
      x = [sin(b(1)), sin(b(2))]
      x = [minval(x), maxval(x)]
      if (reaches(0.25_wp*two_pi)) x(2) = 1.0_wp
      if (reaches(-0.25_wp*two_pi)) x(1) = -1.0_wp
      x = [max(x(1) - margin, -1.0_wp), min(x(2) + margin, 1.0_wp)]

   contains

      !> Whether the interval holds an angle, or that with some turns.
      pure logical function reaches(angle)
         real(wp), intent(in) :: angle  !! the angle [rad]

         real(wp) :: turns

         turns = aint((b(1) - angle)/two_pi)
         if (angle + two_pi*turns < b(1)) turns = turns + 1.0_wp
         reaches = angle + two_pi*turns <= b(2)
      end function reaches

   end function sine_of

end module intervals
