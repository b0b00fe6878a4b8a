!> Dimensions of the parts of an expression, and the rule for radians.
!>
!> Dimensions must agree in sums, in `min`, `max`, `atan2`, and with what is requested. Radians are an
!> exponent of their own, so that `50 Hz` in the place of `5000 rpm` is found. But mechanics drops
!> them (speed is radius times angular speed), so some values are soft: their radians may be taken or
!> left when they are compared. Soft are
!> - `pi` (2*pi*50Hz is an angular speed, 2*50Hz is not);
!> - a product or quotient of a value with radians and any other dimensional one (`omega*r`, `omega*t`),
!>   and what is divided by radians (`1/omega`);
!> - a power, other than the first, of a value with radians; any root and fractional power (`sqrt(k/m)`);
!> - the results of atan, atan2, asin, acos (angles, soft);
!> - every product, quotient and power with a soft part; a sum of soft parts only.
!> A sum of radians and of a dimensionless number is in radians. A dimensionless number alone is not an
!> angle: `0.5*sin(w*t)` lacks a unit, `0.5rad*sin(w*t)` is right. Functions of an angle take
!> radians or none.
module expression_dimension
   use dimension_text, only: dimension_name
   use kind_info, only: dim_angle, dim_none, dim_t, same_dimension
   use kinds, only: wp
   use units, only: dimension_power, dimension_product
   implicit none (type, external)
   private
   public :: combine_power, combine_product, combine_sum, dimension_agrees, is_angle_like, term_t

   !> A part of an expression that has been read.
   type :: term_t
      type(dim_t) :: dimension = dim_none  !! of its value
      logical :: is_soft = .false.         !! its radians may be taken or left
      logical :: is_constant = .true.      !! the time does not occur
      integer :: first = 0                 !! first character
      integer :: last = 0                  !! last character
      integer :: start = 0                 !! its first operation in the program
   end type term_t

contains

   !> Whether a value may stand where a dimension is requested.
   pure logical function dimension_agrees(dimension, is_soft, wanted)
      type(dim_t), intent(in) :: dimension  !! of the value
      logical, intent(in) :: is_soft        !! its radians may be taken or left
      type(dim_t), intent(in) :: wanted     !! what is requested

      dimension_agrees = same_dimension(dimension, wanted)
      if (is_soft) dimension_agrees = same_dimension(without_radians(dimension), without_radians(wanted))
   end function dimension_agrees

   !> Whether a function of an angle takes this: radians, none, or what radians were dropped from.
   pure logical function is_angle_like(dimension)
      type(dim_t), intent(in) :: dimension  !! of the argument

      is_angle_like = same_dimension(without_radians(dimension), dim_none)
   end function is_angle_like

   !> The dimension of a sum, or of the smaller or larger of two.
   pure subroutine combine_sum(a, b, message)
      type(term_t), intent(inout) :: a                   !! first part; the sum on return
      type(term_t), intent(in) :: b                      !! second part
      character(:), allocatable, intent(out) :: message  !! empty: they agree

      logical :: is_angle_and_none

      message = ""
      is_angle_and_none = (same_dimension(a%dimension, dim_angle) .and. same_dimension(b%dimension, dim_none)) &
                         & .or. (same_dimension(a%dimension, dim_none) .and. same_dimension(b%dimension, dim_angle))
      if (is_angle_and_none) then
         a%dimension = dim_angle
      else if (dimension_agrees(a%dimension, a%is_soft .or. b%is_soft, b%dimension)) then
         if (a%is_soft) a%dimension = b%dimension
      else
         message = "this is "//dimension_name(b%dimension)//", the preceding part is "//dimension_name(a%dimension)
      end if
      a%is_soft = a%is_soft .and. b%is_soft
      a%is_constant = a%is_constant .and. b%is_constant
   end subroutine combine_sum

   !> The dimension of a product or a quotient.
   pure subroutine combine_product(a, b, exponent)
      type(term_t), intent(inout) :: a  !! first part; the product on return
      type(term_t), intent(in) :: b     !! second part
      integer, intent(in) :: exponent   !! 1: product; -1: quotient

      logical :: has_radians, is_mixed

      has_radians = has_angle(a%dimension) .or. has_angle(b%dimension)
      is_mixed = .not. same_dimension(a%dimension, dim_none) .and. .not. same_dimension(b%dimension, dim_none)
      a%is_soft = a%is_soft .or. b%is_soft .or. (has_radians .and. is_mixed) &
                & .or. (exponent < 0 .and. has_angle(b%dimension))
      a%dimension = dimension_product(a%dimension, b%dimension, real(exponent, wp))
      a%is_constant = a%is_constant .and. b%is_constant
   end subroutine combine_product

   !> The dimension of a power with a constant exponent.
   pure subroutine combine_power(a, exponent)
      type(term_t), intent(inout) :: a  !! base; the power on return
      real(wp), intent(in) :: exponent  !! the exponent [1]

      logical :: is_fraction

      is_fraction = abs(exponent - anint(exponent)) > 1.0e-9_wp
      if (is_fraction .or. (has_angle(a%dimension) .and. abs(exponent - 1.0_wp) > 1.0e-9_wp)) a%is_soft = .true.
      a%dimension = dimension_power(a%dimension, exponent)
   end subroutine combine_power

   !> A dimension with the radians omitted.
   pure type(dim_t) function without_radians(dimension)
      type(dim_t), intent(in) :: dimension  !! any

      without_radians = dimension
      without_radians%rad = 0.0_wp
   end function without_radians

   !> Whether a dimension contains radians.
   pure logical function has_angle(dimension)
      type(dim_t), intent(in) :: dimension  !! any

      has_angle = abs(dimension%rad) > 1.0e-9_wp
   end function has_angle

end module expression_dimension
