!> Numbers with 17 significant digits, correctly rounded, as the edit descriptor es24.16e3 writes them, at a hundredth of its cost.
!>
!> x 10^(16 - k), with k the decimal exponent, is formed in double-double arithmetic (after T. J. Dekker, A floating-point technique
!> for extending the available precision, Numerische Mathematik 18, 1971, 224-242; halves are taken by their bits, which no
!> fused operation changes): its whole part holds the digits, and its fraction, known to about 1e-11, says how to round. Where that
!> is within 1e-6 of a half, and for numbers near the ends of the range, the run-time library writes instead, so that every
!> digit is its own.
module decimal_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_negative
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: decimal_width, put_decimal

   integer, parameter :: decimal_width = 25                       !! characters of a number, with the blank after it
   character(*), parameter :: plain_format = "(es24.16e3, 1x)"    !! the same by the run-time library
   integer, parameter :: digits_after = 16                        !! after the first digit
   integer, parameter :: most = 300                               !! maximum power of ten in the table
   real(wp), parameter :: maximum = 1.0e280_wp, minimum = 1.0e-280_wp  !! beyond them products may leave the range [any]
   integer(i8), parameter :: upper_half = -134217728_i8           !! bits of sign, exponent and the first 26 of the digits
   real(wp), parameter :: doubt = 1.0e-6_wp                       !! fractions so near one half are not decided here
   integer(i8), parameter :: whole = 10_i8**digits_after          !! minimum number of 17 digits

   real(wp) :: high(-most:most), low(-most:most)                  !! 10^k as a sum of two numbers
   logical :: is_made = .false.                                   !! whether they are known

contains

   !> Write a number, right-justified with a blank before it if it is not negative and one after it.
   subroutine put_decimal(x, s)
      real(wp), intent(in) :: x                        !! any number, finite or not [any]
      character(decimal_width), intent(out) :: s       !! sign, digit, point, 16 digits, E, sign, 3 digits, blank

      integer(i8) :: n
      integer :: k
      logical :: is_sure

      n = 0
      k = 0
      is_sure = ieee_is_finite(x)
      if (is_sure) then
         if (abs(x) > minimum .and. abs(x) < maximum) then
            call find_digits(abs(x), n, k, is_sure)
         else
            is_sure = abs(x) <= 0.0_wp
         end if
      end if
      if (is_sure) then
         call put_digits(n, k, s)
         s(1:1) = merge("-", " ", ieee_is_negative(x))
      else
         write (s, plain_format) x
      end if
   end subroutine put_decimal

   !> The digits of a number as a whole number, and its decimal exponent.
   subroutine find_digits(x, n, k, is_sure)
      real(wp), intent(in) :: x        !! the number, positive, away from the ends of the range [any]
      integer(i8), intent(out) :: n    !! 17 digits
      integer, intent(out) :: k        !! exponent: x = n 10^(k - 16), rounded
      logical, intent(out) :: is_sure  !! whether the last digit is decided

      real(wp) :: below, fraction, h, l

      if (.not. is_made) call make_powers()
      k = floor(0.30102999566398120_wp*real(exponent(x) - 1, wp))
      do
         call times_power(x, digits_after - k, h, l)
         if (h < 10.0_wp*real(whole, wp) .or. (h <= 10.0_wp*real(whole, wp) .and. l < 0.0_wp)) exit
         k = k + 1
      end do
      below = aint(l)
      if (l < below) below = below - 1.0_wp
      fraction = l - below
      n = int(h, i8) + int(below, i8) + merge(1_i8, 0_i8, fraction > 0.5_wp)
      is_sure = abs(fraction - 0.5_wp) > doubt .and. n >= whole
      if (n < 10_i8*whole) return
      n = whole
      k = k + 1
   end subroutine find_digits

   !> x 10^p as a sum of two numbers.
   subroutine times_power(x, p, h, l)
      real(wp), intent(in) :: x     !! the number [any]
      integer, intent(in) :: p      !! the power
      real(wp), intent(out) :: h    !! sum, rounded [any]
      real(wp), intent(out) :: l    !! what is left [any]

      real(wp) :: e, q

      call exact_product(x, high(p), q, e)
      e = e + x*low(p)
      h = q + e
      l = e - (h - q)
   end subroutine times_power

   !> a b = q + e without an error.
   subroutine exact_product(a, b, q, e)
      real(wp), intent(in) :: a, b   !! factors [any]
      real(wp), intent(out) :: q     !! product, rounded [any]
      real(wp), intent(out) :: e     !! its error, to 2^-53 of it [any]

      real(wp), volatile :: rounded  ! so that no sum of it is fused with the product, which would be another number
      real(wp) :: a_high, b_high

      rounded = a*b
      q = rounded
      a_high = transfer(iand(transfer(a, upper_half), upper_half), a)
      b_high = transfer(iand(transfer(b, upper_half), upper_half), b)
      e = ((a_high*b_high - q) + a_high*(b - b_high) + (a - a_high)*b_high) + (a - a_high)*(b - b_high)
   end subroutine exact_product

   !> Powers of ten: positive ones by products, negative ones by their reciprocals.
   subroutine make_powers()
      real(wp) :: e, q
      integer :: k

      high(0) = 1.0_wp
      low(0) = 0.0_wp
      do k = 1, most
         call exact_product(high(k - 1), 10.0_wp, q, e)
         e = e + 10.0_wp*low(k - 1)
         high(k) = q + e
         low(k) = e - (high(k) - q)
      end do
      do k = 1, most
         high(-k) = 1.0_wp/high(k)
         call exact_product(high(-k), high(k), q, e)
         low(-k) = (((1.0_wp - q) - e) - high(-k)*low(k))/high(k)
      end do
      is_made = .true.
   end subroutine make_powers

   !> The characters of digits and exponent.
   pure subroutine put_digits(n, k, s)
      integer(i8), intent(in) :: n                 !! 17 digits, or 0
      integer, intent(in) :: k                     !! exponent
      character(decimal_width), intent(out) :: s   !! the number without its sign

      integer, parameter :: zero = iachar("0")
      integer(i8), parameter :: half = 100000000_i8   ! 10^8: numbers of 8 digits fit the short integers
      integer :: i, left, right

      right = int(mod(n, half))
      left = int(mod(n/half, half))
      s(1:1) = " "
      s(2:2) = achar(zero + int(n/(half*half)))
      s(3:3) = "."
      do i = 11, 4, -1
         s(i:i) = achar(zero + mod(left, 10))
         s(i + 8:i + 8) = achar(zero + mod(right, 10))
         left = left/10
         right = right/10
      end do
      i = abs(k)
      s(20:20) = "E"
      s(21:21) = merge("-", "+", k < 0)
      s(22:22) = achar(zero + i/100)
      s(23:23) = achar(zero + mod(i/10, 10))
      s(24:24) = achar(zero + mod(i, 10))
      s(25:25) = " "
   end subroutine put_digits

end module decimal_text
