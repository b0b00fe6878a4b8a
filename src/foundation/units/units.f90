!> Units: from text to a factor and a dimension, and back to SI text.
!>
!> A unit is a product of names with exponents: `kg.m^2`, `N.s/m`, `m/s^2`, `N/m^1.5`, `1/s`, `s^-1`,
!> `W/(m.K)`, `1` for none. SI names take the usual prefixes. The factor is kept as a fraction times a
!> power of ten, so that `0.1 mm` is read as exactly the number 1e-4.
module units
   use kind_info, only: dim_t, same_dimension
   use kinds, only: wp
   use named_units, only: n_named, named, spelt_out, unit_t
   use numbers, only: number_length, read_number
   use spelling, only: nearest_word
   use text, only: append_text, lower, starts_with, text_t, to_text
   implicit none (type, external)
   private
   public :: dimension_power, dimension_product, exponent_length, largest_quantity, parse_unit, read_quantity, to_si, &
      unit_factor, unit_t

   real(wp), parameter :: largest_quantity = 1.0e290_wp  !! numbers below keep products in range [any]
   character(*), parameter :: prefix_letters = "GMkdcmunp"
   integer, parameter :: prefix_power(9) = [9, 6, 3, -1, -2, -3, -6, -9, -12]

contains

   !> Read a unit.
   recursive subroutine parse_unit(string, unit, message, first, last, wanted)
      character(*), intent(in) :: string                 !! the unit, without brackets
      type(unit_t), intent(out) :: unit                  !! its factor and dimension
      character(:), allocatable, intent(out) :: message  !! empty: success; else what is wrong
      integer, intent(out) :: first                      !! where in the string it is wrong
      integer, intent(out) :: last                       !! where that ends
      type(dim_t), intent(in), optional :: wanted        !! dimension of the place, for what is suggested

      integer :: at

      message = ""
      first = 1
      last = len(string)
      if (len_trim(string) == 0) then
         message = "the unit is missing"
         return
      end if
      at = 1
      call parse_product(string, at, 0, unit, message, first, last)
      if (present(wanted) .and. index(message, "unknown unit") == 1) then
         message = unknown_unit(string(first:last), string(:first - 1), string(last + 1:), wanted)
      end if
      if (len(message) > 0) return
      if (at <= len(string)) then
         message = "'"//string(at:at)//"' is not allowed in a unit"
         first = at
         last = at
      else if (abs(unit%offset) > 0.0_wp .and. string /= "degC") then
         message = "degC must stand alone; use K in a compound unit"
         first = 1
         last = len(string)
      end if
   end subroutine parse_unit

   !> A product of units, up to a closing parenthesis or the end.
   recursive subroutine parse_product(string, at, depth, unit, message, first, last)
      character(*), intent(in) :: string                   !! the whole
      integer, intent(inout) :: at                         !! next character
      integer, intent(in) :: depth                         !! open parentheses
      type(unit_t), intent(out) :: unit                    !! the product
      character(:), allocatable, intent(inout) :: message  !! empty: success
      integer, intent(inout) :: first                      !! where it is wrong
      integer, intent(inout) :: last                       !! where that ends

      type(unit_t) :: factor
      character :: sign
      logical :: has_divided

      sign = "."
      has_divided = .false.
      do
         call parse_factor(string, at, depth, factor, message, first, last)
         if (len(message) > 0) return
         unit = unit_product(unit, factor, merge(-1, 1, sign == "/"))
         if (at > len(string)) return
         sign = string(at:at)
         if (scan(sign, "./*") == 0) return
         if (has_divided .and. sign /= "/") then
            message = "a product after a division is ambiguous; use parentheses"
            first = at
            last = len(string)
            return
         end if
         has_divided = has_divided .or. sign == "/"
         at = at + 1
      end do
   end subroutine parse_product

   !> One unit with its exponent, or a product in parentheses.
   recursive subroutine parse_factor(string, at, depth, unit, message, first, last)
      character(*), intent(in) :: string                   !! the whole
      integer, intent(inout) :: at                         !! next character
      integer, intent(in) :: depth                         !! open parentheses
      type(unit_t), intent(out) :: unit                    !! the factor
      character(:), allocatable, intent(inout) :: message  !! empty: success
      integer, intent(inout) :: first                      !! where it is wrong
      integer, intent(inout) :: last                       !! where that ends

      integer, parameter :: deepest = 4
      integer :: length
      logical :: is_known

      first = at
      last = max(at, len(string))
      if (at > len(string)) then
         message = "the unit is incomplete"
         return
      end if
      if (string(at:at) == "(" .and. depth < deepest) then
         at = at + 1
         call parse_product(string, at, depth + 1, unit, message, first, last)
         if (len(message) > 0) return
         if (at > len(string)) message = "missing closing parenthesis"
         if (len(message) > 0) return
         if (string(at:at) /= ")") message = "missing closing parenthesis"
         if (len(message) > 0) return
         at = at + 1
      else if (string(at:at) == "1") then
         at = at + 1
         return
      else
         length = scan(string(at:), "./*^()") - 1
         if (length < 0) length = len(string) - at + 1
         last = at + max(length, 1) - 1
         if (length == 0) message = "'"//string(at:at)//"' is not allowed here in a unit"
         if (length == 0) return
         call find_unit(string(at:at + length - 1), unit, is_known)
         if (.not. is_known) then
            message = unknown_unit(string(at:last))
            return
         end if
         at = at + length
      end if
      call parse_exponent(string, at, unit, message, first, last)
   end subroutine parse_factor

   !> The exponent after a unit, if there is one.
   subroutine parse_exponent(string, at, unit, message, first, last)
      character(*), intent(in) :: string                   !! the whole
      integer, intent(inout) :: at                         !! next character
      type(unit_t), intent(inout) :: unit                  !! the unit, raised on return
      character(:), allocatable, intent(inout) :: message  !! empty: success
      integer, intent(inout) :: first                      !! where it is wrong
      integer, intent(inout) :: last                       !! where that ends

      real(wp) :: exponent, power
      integer :: length
      logical :: is_fine

      if (at > len(string)) return
      if (string(at:at) /= "^") return
      length = exponent_length(string(at + 1:))
      exponent = 0.0_wp
      is_fine = length > 0
      if (is_fine) call read_number(string(at + 1:at + length), 0, exponent, is_fine)
      if (.not. is_fine .or. abs(exponent) > 9.0_wp) then
         message = "the exponent of a unit must be a number up to 9, as in s^-1 or m^1.5"
         first = at
         last = at + max(length, 1)
         return
      end if
      at = at + 1 + length
      power = unit%power*exponent
      unit%power = floor(power)
      unit%numerator = unit%numerator**exponent*10.0_wp**(power - unit%power)
      unit%denominator = unit%denominator**exponent
      unit%dimension = dimension_power(unit%dimension, exponent)
   end subroutine parse_exponent

   !> Number of characters of a sign and a number without exponent: `-1`, `1.5`.
   pure integer function exponent_length(string)
      character(*), intent(in) :: string  !! what follows the caret

      exponent_length = number_length(string)
      if (exponent_length == 0) return
      if (scan(string(1:exponent_length), "eEdD") > 0) exponent_length = scan(string(1:exponent_length), "eEdD") - 1
      if (string(exponent_length:exponent_length) == ".") exponent_length = exponent_length - 1
   end function exponent_length

   !> Find a unit name, with or without a prefix.
   pure subroutine find_unit(name, unit, is_known)
      character(*), intent(in) :: name    !! without exponent
      type(unit_t), intent(out) :: unit   !! its factor and dimension
      logical, intent(out) :: is_known    !! whether there is such a unit

      integer :: i, k

      is_known = .true.
      do i = 1, n_named
         if (named(i)%name /= name) cycle
         unit = named(i)%unit
         return
      end do
      do i = 1, n_named
         if (len(name) < 2) exit
         if (named(i)%name /= name(2:) .or. scan(trim(named(i)%prefixes), name(1:1)) == 0) cycle
         k = scan(prefix_letters, name(1:1))
         unit = named(i)%unit
         unit%power = unit%power + prefix_power(k)
         return
      end do
      is_known = .false.
   end subroutine find_unit

   !> The message about an unknown unit, with the nearest one that is known; of units equally near, one that fits its place.
   !> Length: one rule after the other, each of which can be the answer.
   recursive function unknown_unit(name, before, behind, wanted) result(message)
      character(*), intent(in) :: name                 !! as written
      character(*), intent(in), optional :: before     !! what stands before it
      character(*), intent(in), optional :: behind     !! what stands behind it
      type(dim_t), intent(in), optional :: wanted      !! dimension of the whole
      character(:), allocatable :: message             !! what and which instead

      type(text_t), allocatable :: known(:)
      type(unit_t) :: unit, left, right
      character(:), allocatable :: near
      logical :: has_first, has_second
      integer :: i, k, pass

      message = "unknown unit '"//name//"'"
      i = scan(name, "0123456789")
      if (i > 1) then
         call find_unit(name(1:i - 1), unit, has_first)
         if (has_first) then
            message = message//": did you mean '"//name(1:i - 1)//"^"//name(i:)//"'?"
            return
         end if
      end if
      i = index(" "//spelt_out, " "//lower(name)//":")
      if (i == 0) i = index(" "//spelt_out, " "//name//":")
      if (i > 0) then
         k = i + len(name) + 1
         message = message//": did you mean '"//spelt_out(k:k + scan(spelt_out(k:)//" ", " ") - 2)//"'?"
         return
      end if
      do i = 2, len(name)  ! a letter typed twice, as in rpmm
         if (name(i:i) /= name(i - 1:i - 1)) cycle
         call find_unit(name(1:i - 1)//name(i + 1:), unit, has_first)
         if (.not. has_first) cycle
         message = message//": did you mean '"//name(1:i - 1)//name(i + 1:)//"'?"
         return
      end do
      do i = 1, len(name) - 1
         call find_unit(name(1:i), left, has_first)
         call find_unit(name(i + 1:), right, has_second)
         if (.not. (has_first .and. has_second)) cycle
         if (.not. same_dimension(left%dimension, right%dimension) .and. name(1:i) /= "K") then
            message = message//": did you mean '"//name(1:i)//"."//name(i + 1:)//"'?"
            return
         end if
      end do
      allocate (known(0))
      do pass = 1, 2  ! those that fit first
         do i = 1, n_named
            do k = 0, len_trim(named(i)%prefixes)
               near = trim(named(i)%prefixes(max(k, 1):k)//named(i)%name)
               if (fits(near) .eqv. pass == 1) call append_text(known, near)
            end do
         end do
      end do
      near = nearest_word(name, known)
      if (len(near) > 0) message = message//": did you mean '"//near//"'?"

   contains

      !> Whether a unit in the place of the name gives the dimension that is requested.
      recursive logical function fits(candidate)
         character(*), intent(in) :: candidate  !! known

         type(unit_t) :: whole
         character(:), allocatable :: wrong
         integer :: first, last

         fits = .true.
         if (.not. present(wanted)) return
         call parse_unit(before//candidate//behind, whole, wrong, first, last)
         fits = len(wrong) == 0
         if (fits) fits = same_dimension(whole%dimension, wanted)
      end function fits

   end function unknown_unit

   !> Read a number with a unit, without or with blanks between.
   subroutine read_quantity(string, unit, x, is_finite)
      character(*), intent(in) :: string  !! the number alone
      type(unit_t), intent(in) :: unit    !! its unit
      real(wp), intent(out) :: x          !! its value in SI [any]
      logical, intent(out) :: is_finite   !! .false.: too large

      if (abs(unit%offset) > 0.0_wp) then
         call read_number(string, 0, x, is_finite)
         x = to_si(x, unit)
      else
         call read_number(string, unit%power, x, is_finite)
         is_finite = is_finite .and. abs(x) < largest_quantity
         if (is_finite) x = x*unit%numerator/unit%denominator
      end if
   end subroutine read_quantity

   !> A value in SI.
   pure real(wp) function to_si(x, unit)
      real(wp), intent(in) :: x         !! number of units [any]
      type(unit_t), intent(in) :: unit  !! the unit

      to_si = (x + unit%offset)*unit_factor(unit)
   end function to_si

   !> The factor of a unit to SI.
   pure real(wp) function unit_factor(unit)
      type(unit_t), intent(in) :: unit  !! the unit

      unit_factor = unit%numerator/unit%denominator*10.0_wp**unit%power
   end function unit_factor

   !> The product of a unit and another one raised to 1 or -1.
   pure type(unit_t) function unit_product(a, b, exponent)
      type(unit_t), intent(in) :: a    !! one unit
      type(unit_t), intent(in) :: b    !! the other
      integer, intent(in) :: exponent  !! 1: product; -1: quotient

      unit_product = a
      if (exponent > 0) then
         unit_product%numerator = a%numerator*b%numerator
         unit_product%denominator = a%denominator*b%denominator
      else
         unit_product%numerator = a%numerator*b%denominator
         unit_product%denominator = a%denominator*b%numerator
      end if
      unit_product%power = a%power + exponent*b%power
      unit_product%offset = a%offset + b%offset
      unit_product%dimension = dimension_product(a%dimension, b%dimension, real(exponent, wp))
   end function unit_product

   !> The dimension of a times b to some power.
   pure type(dim_t) function dimension_product(a, b, exponent)
      type(dim_t), intent(in) :: a      !! one dimension
      type(dim_t), intent(in) :: b      !! the other
      real(wp), intent(in) :: exponent  !! 1: product; -1: quotient [1]

      dimension_product = dim_t(kg=a%kg + exponent*b%kg, m=a%m + exponent*b%m, s=a%s + exponent*b%s, &
                                & rad=a%rad + exponent*b%rad, k=a%k + exponent*b%k, a=a%a + exponent*b%a)
   end function dimension_product

   !> The dimension of a power.
   pure type(dim_t) function dimension_power(a, exponent)
      type(dim_t), intent(in) :: a      !! dimension of the base
      real(wp), intent(in) :: exponent  !! the exponent [1]

      dimension_power = dimension_product(dim_t(), a, exponent)
   end function dimension_power

end module units
