!> Polynomial of the time.
!>
!> f(t) = sum_k c_k (t - origin)^k,   k = 0 to 7
!>
!> With an `end` it reaches from the origin to there; `beyond` says what is before and after: hold (the value of the end),
!> linear (the tangent of the end) or error (nothing). Without one it continues for ever.
!>
!> Each coefficient has the dimension of the function over a time to its power. Source: Flores et al. (2008),
!> section 2.2 (driver functions). Limits: degree 7.
module function_polynomial
   use curve, only: beyond_error, beyond_stabilisation, beyond_linear, beyond_same
   use dimension_text, only: dimension_name, unit_text
   use function_kind, only: function_kind_t, made_t
   use item, only: item_t, place_of
   use kind_info, only: add_any_number, add_number, add_word, dim_time, dim_t, kind_info_t, same_dimension
   use kinds, only: wp
   use text, only: to_text
   use units, only: dimension_power, dimension_product
   implicit none (type, external)
   private
   public :: function_polynomial_t

   integer, parameter :: degree = 7            !! maximum power

   !> The kind.
   type, extends(function_kind_t) :: function_polynomial_t
   contains
      procedure, nopass :: info => polynomial_info
      procedure, nopass :: make => polynomial_make
   end type function_polynomial_t

contains

   !> Description of the kind.
   function polynomial_info() result(info)
      type(kind_info_t) :: info  !! name and columns

      integer :: k

      info%name = "function.polynomial"
      info%help = "polynomial of the time; expressions call it by its name: {lift(t)}"
      info%source = "Flores et al. (2008), section 2.2"
      do k = 0, degree
         call add_any_number(info, "c"//to_text(k), "coefficient of (t - origin)^"//to_text(k), default="0")
      end do
      call add_number(info, "origin", dim_time, "origin of the time for the powers", default="0 s")
      call add_number(info, "end", dim_time, "end of the domain, from the origin; default: unlimited " &
                      //"on both sides", default="")
      call add_word(info, "beyond", "continuation before the origin and after the end, if there is one", default="hold", &
                    choices="hold linear error")
   end function polynomial_info

   !> The curve of a row.
   subroutine polynomial_make(item, made)
      type(item_t), intent(inout) :: item  !! the row
      type(made_t), intent(out) :: made    !! the curve, or the first error

      type(dim_t) :: dimension
      integer :: column, first, k

      made%argument = dim_time
      allocate (made%curve%x(1), source=item%number("origin"))
      allocate (made%curve%c(0:degree, 1), source=0.0_wp)
      made%curve%beyond = beyond_same
      if (item%is_given("end")) call take_end(item, made)
      if (made%column > 0) return
      first = 0
      do k = 0, degree
         column = place_of(item, "c"//to_text(k))
         associate (value => item%values(column))
            if (.not. value%given) cycle
            made%curve%c(k, 1) = value%number
            dimension = dimension_product(value%dimensions(1), dimension_power(dim_time, real(k, wp)), 1.0_wp)
            if (first == 0) then
               first = k + 1
               made%dimension = dimension
            else if (.not. same_dimension(dimension, made%dimension)) then
               made%column = column
               made%message = "column c"//to_text(first - 1)//" gives the function "//dimension_name(made%dimension)
               made%help = "so the unit of c"//to_text(k)//" is "//unit_over_time(made%dimension, k)
               return
            end if
         end associate
      end do
   end subroutine polynomial_make

   !> A polynomial that reaches from its origin to an end.
   subroutine take_end(item, made)
      type(item_t), intent(in) :: item     !! the row
      type(made_t), intent(inout) :: made  !! the curve, or an error

      associate (origin => item%number("origin"), end => item%number("end"))
         if (end <= origin) then
            made%column = place_of(item, "end")
            made%message = "the end must be after the origin"
            made%help = "the domain of the polynomial starts at "//to_text(origin)//" s to its end"
            return
         end if
         made%curve%x = [origin, end]
      end associate
      select case (item%word("beyond"))
      case ("linear"); made%curve%beyond = beyond_linear
      case ("error"); made%curve%beyond = beyond_error
      case default; made%curve%beyond = beyond_stabilisation
      end select
   end subroutine take_end

   !> The SI unit of a quantity over a time to some power.
   function unit_over_time(dimension, power) result(unit)
      type(dim_t), intent(in) :: dimension  !! of the quantity
      integer, intent(in) :: power          !! of the time
      character(:), allocatable :: unit     !! as N/s^2

      unit = unit_text(dimension)
      if (power > 0) unit = unit//"/s"
      if (power > 1) unit = unit//"^"//to_text(power)
   end function unit_over_time

end module function_polynomial
