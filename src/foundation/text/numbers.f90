!> Numbers in text: where they end, and their value.
!>
!> A number is `[+-]digits[.digits][e[+-]digits]`, with `d` for `e` allowed and digits on at least one
!> side of the point. The power of ten of a unit is added to the exponent before the conversion to
!> binary, so that `0.1 mm` and `1e-4 m` are the very same number.
module numbers
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: number_length, read_number

   character(*), parameter :: digits = "0123456789"
   integer, parameter :: largest_power = 307   !! largest power of ten that is read
   integer, parameter :: longest_exponent = 9  !! more digits than these are cut, the number is out of range anyway

contains

   !> Number of characters of the number with which a string starts; 0 if there is none.
   pure integer function number_length(string)
      character(*), intent(in) :: string  !! any string

      integer :: at, n, n_digit

      number_length = 0
      at = 0
      if (len(string) > 0) then
         if (scan(string(1:1), "+-") == 1) at = 1
      end if
      n_digit = count_digits(string(at + 1:))
      at = at + n_digit
      if (at < len(string)) then
         if (string(at + 1:at + 1) == ".") then
            n = count_digits(string(at + 2:))
            if (n_digit + n > 0) at = at + 1 + n
            n_digit = n_digit + n
         end if
      end if
      if (n_digit == 0) return
      number_length = at
      if (at + 2 > len(string)) return
      if (scan(string(at + 1:at + 1), "eEdD") == 0) return
      at = at + 1
      if (scan(string(at + 1:at + 1), "+-") == 1) at = at + 1
      n = count_digits(string(at + 1:))
      if (n > 0) number_length = at + n
   end function number_length

   !> Number of digits with which a string starts.
   pure integer function count_digits(string)
      character(*), intent(in) :: string  !! any string

      count_digits = verify(string, digits) - 1
      if (count_digits < 0) count_digits = len(string)
   end function count_digits

   !> The value of a number times a power of ten.
   pure subroutine read_number(string, power, x, is_finite)
      character(*), intent(in) :: string   !! a number as `number_length` measures it
      integer, intent(in) :: power         !! power of ten to be multiplied in
      real(wp), intent(out) :: x           !! the value [any]
      logical, intent(out) :: is_finite    !! .false.: too large, or not a number

      character(:), allocatable :: mantissa
      integer :: at, exponent, first, point, status

      x = 0.0_wp
      is_finite = .false.
      at = scan(string, "eEdD")
      exponent = power
      if (at == 0) then
         mantissa = string
      else
         mantissa = string(1:at - 1)
         exponent = exponent + exponent_of(string(at + 1:))
      end if
      first = scan(mantissa, "123456789")
      if (first == 0) then
         is_finite = scan(mantissa, "0") > 0
         return
      end if
      point = scan(mantissa, ".")
      if (point == 0) point = len(mantissa) + 1
      at = point - first - 1
      if (point < first) at = point - first
      if (at + exponent > largest_power) return
      is_finite = .true.
      if (at + exponent < -largest_power) return
      mantissa = mantissa//"e"//to_text(exponent)
      read (mantissa, *, iostat=status) x
      is_finite = status == 0
   end subroutine read_number

   !> The exponent of a number, cut where it is absurd.
   pure integer function exponent_of(string)
      character(*), intent(in) :: string  !! sign and digits

      integer :: first, status

      first = verify(string, "+-0")
      exponent_of = 0
      if (first == 0) return
      read (string(first:min(len(string), first + longest_exponent - 1)), *, iostat=status) exponent_of
      if (status /= 0) exponent_of = 0
      if (string(1:1) == "-") exponent_of = -exponent_of
   end function exponent_of

end module numbers
