!> The SI unit of a dimension as text, for messages, echoes and file headers.
module dimension_text
   use kind_info, only: dim_t, same_dimension
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: base_text, dimension_name, unit_text

   !> A unit and the quantity that it usually measures.
   type :: prescribed_t
      type(dim_t) :: dimension     !! exponents
      character(14) :: unit = ""   !! SI, of factor 1
      character(24) :: name = ""   !! the quantity
   end type prescribed_t

   integer, parameter :: n_known = 38
   type(prescribed_t), parameter :: known(n_known) = [ &
      & prescribed_t(dim_t(), "1", "a dimensionless number"), &
      & prescribed_t(dim_t(kg=1), "kg", "a mass"), &
      & prescribed_t(dim_t(m=1), "m", "a length"), &
      & prescribed_t(dim_t(m=2), "m^2", "an area"), &
      & prescribed_t(dim_t(m=3), "m^3", "a volume"), &
      & prescribed_t(dim_t(s=1), "s", "a time"), &
      & prescribed_t(dim_t(s=-1), "s^-1", "a frequency"), &
      & prescribed_t(dim_t(rad=1), "rad", "an angle"), &
      & prescribed_t(dim_t(rad=1, s=-1), "rad/s", "an angular speed"), &
      & prescribed_t(dim_t(rad=1, s=-2), "rad/s^2", "an angular acceleration"), &
      & prescribed_t(dim_t(k=1), "K", "a temperature"), &
      & prescribed_t(dim_t(m=1, s=-1), "m/s", "a speed"), &
      & prescribed_t(dim_t(m=1, s=-2), "m/s^2", "an acceleration"), &
      & prescribed_t(dim_t(kg=1, m=1, s=-2), "N", "a force"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-2), "N.m", "a moment"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-3), "W", "a power"), &
      & prescribed_t(dim_t(kg=1, m=-1, s=-2), "Pa", "a pressure"), &
      & prescribed_t(dim_t(kg=1, m=-1, s=-1), "Pa.s", "a viscosity"), &
      & prescribed_t(dim_t(kg=1, m=2), "kg.m^2", "a moment of inertia"), &
      & prescribed_t(dim_t(kg=1, m=-3), "kg/m^3", "a density"), &
      & prescribed_t(dim_t(kg=1, s=-2), "N/m", "a stiffness"), &
      & prescribed_t(dim_t(kg=1, s=-1), "N.s/m", "a damping"), &
      & prescribed_t(dim_t(kg=1, m=-0.5_wp, s=-2), "N/m^1.5", "a contact stiffness"), &
      & prescribed_t(dim_t(kg=1, m=-0.5_wp, s=-1), "N.s/m^1.5", "a contact damping"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-2, rad=-1), "N.m/rad", "an angular stiffness"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-1, rad=-1), "N.m.s/rad", "an angular damping"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-1), "N.m.s", "an angular momentum"), &
      & prescribed_t(dim_t(kg=1, m=1, s=-1), "N.s", "a momentum"), &
      & prescribed_t(dim_t(kg=1, m=1, s=-3, k=-1), "W/(m.K)", "a conductivity"), &
      & prescribed_t(dim_t(m=2, s=-2, k=-1), "J/(kg.K)", "a specific heat"), &
      & prescribed_t(dim_t(k=-1), "K^-1", "an inverse temperature"), &
      & prescribed_t(dim_t(m=-1, s=1), "s/m", "an inverse speed"), &
      & prescribed_t(dim_t(kg=-1, m=1, s=2), "Pa^-1", "an inverse pressure"), &
      & prescribed_t(dim_t(a=1), "A", "an electric current"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-3, a=-1), "V", "a voltage"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-3, a=-2), "Ohm", "an electric resistance"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-2, a=-2), "H", "an inductance"), &
      & prescribed_t(dim_t(kg=1, m=2, s=-2, a=-1), "N.m/A", "a torque constant")]

contains

   !> The SI unit of a dimension: `N`, `rad/s`, `kg.m^-0.5.s^-2`, or `1` for none.
   pure function unit_text(dimension) result(s)
      type(dim_t), intent(in) :: dimension  !! exponents
      character(:), allocatable :: s        !! a unit as the deck reads it, of factor 1

      integer :: i

      do i = 1, n_known
         if (same_dimension(dimension, known(i)%dimension)) then
            s = trim(known(i)%unit)
            return
         end if
      end do
      s = base_text(dimension)
   end function unit_text

   !> The SI unit of a dimension as a product of base units, empty for none.
   pure function base_text(dimension) result(s)
      type(dim_t), intent(in) :: dimension  !! exponents
      character(:), allocatable :: s        !! as `kg.m^2.s^-2`

      s = ""
      call multiply(s, "kg", dimension%kg)
      call multiply(s, "m", dimension%m)
      call multiply(s, "s", dimension%s)
      call multiply(s, "rad", dimension%rad)
      call multiply(s, "K", dimension%k)
      call multiply(s, "A", dimension%a)
   end function base_text

   !> The quantity that a dimension usually belongs to, with its unit: `a length [m]`.
   pure function dimension_name(dimension) result(s)
      type(dim_t), intent(in) :: dimension  !! exponents
      character(:), allocatable :: s        !! for messages

      integer :: i

      s = "a quantity"
      do i = 1, n_known
         if (same_dimension(dimension, known(i)%dimension)) s = trim(known(i)%name)
      end do
      if (.not. same_dimension(dimension, dim_t())) s = s//" ["//unit_text(dimension)//"]"
   end function dimension_name

   !> Append one base unit to a product.
   pure subroutine multiply(s, name, exponent)
      character(:), allocatable, intent(inout) :: s  !! the product so far
      character(*), intent(in) :: name               !! the base unit
      real(wp), intent(in) :: exponent               !! its exponent [1]

      if (abs(exponent) < 1.0e-9_wp) return
      if (len(s) > 0) s = s//"."
      s = s//name
      if (abs(exponent - 1.0_wp) > 1.0e-9_wp) s = s//"^"//real_text(exponent, 6)
   end subroutine multiply

end module dimension_text
