!> Units for the axes of figures: from SI to what reads well, or to the one that is asked for.
module display_units
   use kind_info, only: same_dimension
   use kinds, only: pi, wp
   use units, only: exponent_length, parse_unit, unit_factor, unit_t
   implicit none (type, external)
   private
   public :: ask_unit, choose_unit, display_unit_t, fitted_unit

   !> How numbers are shown.
   type :: display_unit_t
      real(wp) :: factor = 1.0_wp          !! SI values times this [any]
      character(:), allocatable :: symbol  !! of the unit shown, UTF-8; blank: none
   end type display_unit_t

   !> From what extent on a prefix is taken, by its power of ten.
   type :: prefix_t
      integer :: power = 0           !! of ten
      character(2) :: sign = ""      !! UTF-8
      real(wp) :: from = 0.0_wp      !! minimum extent that it reads well for [the SI unit]
   end type prefix_t

   !> Of forces, moments, energies, powers: up to 10000 of a unit.
   type(prefix_t), parameter :: of_force(*) = [prefix_t(9, "G", 1.0e9_wp), prefix_t(6, "M", 1.0e6_wp), &
      prefix_t(3, "k", 1.0e4_wp), prefix_t(0, "", 1.0e-2_wp), prefix_t(-3, "m", 1.0e-4_wp), prefix_t(-6, "µ", 1.0e-7_wp), &
      prefix_t(-9, "n", 1.0e-10_wp), prefix_t(-12, "p", 1.0e-13_wp), prefix_t(-15, "f", 0.0_wp)]
   !> Of lengths.
   type(prefix_t), parameter :: of_length(*) = [prefix_t(3, "k", 1.0e4_wp), prefix_t(0, "", 1.0_wp), prefix_t(-3, "m", 1.0e-4_wp), &
      prefix_t(-6, "µ", 1.0e-6_wp), prefix_t(-9, "n", 1.0e-9_wp), prefix_t(-12, "p", 1.0e-12_wp), prefix_t(-15, "f", 0.0_wp)]
   !> Of times.
   type(prefix_t), parameter :: of_time(*) = [prefix_t(0, "", 1.0_wp), prefix_t(-3, "m", 1.0e-3_wp), &
      prefix_t(-6, "µ", 1.0e-6_wp), prefix_t(-9, "n", 0.0_wp)]
   !> Of velocities, and small accelerations.
   type(prefix_t), parameter :: of_rate(*) = [prefix_t(0, "", 1.0e-2_wp), prefix_t(-3, "m", 1.0e-4_wp), &
      prefix_t(-6, "µ", 1.0e-6_wp), prefix_t(-9, "n", 1.0e-9_wp), prefix_t(-12, "p", 1.0e-12_wp), prefix_t(-15, "f", 0.0_wp)]
   !> Of pressures.
   type(prefix_t), parameter :: of_pressure(*) = [prefix_t(9, "G", 1.0e10_wp), prefix_t(6, "M", 1.0e4_wp), prefix_t(0, "", 0.0_wp)]
   real(wp), parameter :: small_angle = 1.0e-2_wp  !! angles below it are shown in mrad, others in degrees [rad]
   integer, parameter :: readable(2) = [-2, 4]     !! powers of ten that need no further one in units without prefixes

contains

   !> The unit to show a quantity in.
   pure function choose_unit(si, extent) result(shown)
      character(*), intent(in) :: si     !! SI unit, as in files
      real(wp), intent(in) :: extent     !! maximum magnitude that is shown, SI [any]
      type(display_unit_t) :: shown      !! what to show

      shown%symbol = pretty(si)
      if (si == "1") shown%symbol = ""
      if (si == "rad" .and. extent <= 0.0_wp) call scale_angle()
      if (extent <= 0.0_wp) return
      select case (si)
      case ("s"); call scale_by(of_time)
      case ("m"); call scale_by(of_length)
      case ("N", "N.m", "J", "W", "N.s"); call scale_by(of_force)
      case ("Pa"); call scale_by(of_pressure)
      case ("m/s", "rad/s"); call scale_by(of_rate)
      case ("m/s^2", "rad/s^2")
         if (extent >= 1.0e4_wp) then
            shown%factor = 1.0e-3_wp
            shown%symbol = "10³ "//pretty(si)
         else
            call scale_by(of_rate)
         end if
      case ("rad")
         if (extent < small_angle) then
            call scale_by(of_rate)
         else
            call scale_angle()
         end if
      case ("m^3/s")
         shown%factor = merge(1.0e6_wp, 1.0e9_wp, extent >= 1.0e-7_wp)
         shown%symbol = merge("cm³/s", "mm³/s", extent >= 1.0e-7_wp)
      case default
         shown = fitted_unit(shown, extent)
      end select

   contains

      !> The first prefix that the extent is enough for.
      pure subroutine scale_by(list)
         type(prefix_t), intent(in) :: list(:)  !! (n) prefixes, maximum first

         integer :: k

         do k = 1, size(list) - 1
            if (extent >= list(k)%from) exit
         end do
         shown%factor = 10.0_wp**(-list(k)%power)
         shown%symbol = trim(list(k)%sign)//pretty(si)
      end subroutine scale_by

      !> Degrees.
      pure subroutine scale_angle()
         shown%factor = 180.0_wp/pi
         shown%symbol = "deg"
      end subroutine scale_angle

   end function choose_unit

   !> A unit with a power of ten before it if its numbers would be long: one that takes no prefix, or that was asked for.
   pure function fitted_unit(unit, extent) result(shown)
      type(display_unit_t), intent(in) :: unit  !! as it is
      real(wp), intent(in) :: extent            !! maximum magnitude that is shown, SI [any]
      type(display_unit_t) :: shown             !! what to show

      integer :: power

      shown = unit
      if (.not. unit%factor*extent > 0.0_wp) return
      power = floor(log10(unit%factor*extent))
      if (power >= readable(1) .and. power <= readable(2)) return
      power = 3*floor(power/3.0_wp)
      shown%factor = unit%factor*10.0_wp**(-power)
      shown%symbol = trim("10"//raised(power)//" "//unit%symbol)
   end function fitted_unit

   !> The unit that was asked for, if a quantity can be shown in it.
   subroutine ask_unit(name, si, shown, message)
      character(*), intent(in) :: name                    !! as written
      character(*), intent(in) :: si                      !! SI unit of the quantity, as in files
      type(display_unit_t), intent(out) :: shown          !! what to show
      character(:), allocatable, intent(out) :: message   !! what is wrong, blank if nothing

      type(unit_t) :: own, unit
      integer :: first, last

      call parse_unit(name, unit, message, first, last)
      if (len(message) > 0) return
      call parse_unit(si, own, message, first, last)
      if (len(message) > 0) return
      if (.not. same_dimension(unit%dimension, own%dimension)) then
         message = "unit '"//name//"' does not match the dimension of "//si
      else if (abs(unit%offset) > 0.0_wp) then
         message = "an axis cannot use the offset of '"//name//"'; use K"
      end if
      if (len(message) > 0) return
      shown%factor = unit_factor(own)/unit_factor(unit)
      shown%symbol = pretty(name)
      if (name == "1") shown%symbol = ""
   end subroutine ask_unit

   !> An integer as a raised exponent.
   pure function raised(power) result(s)
      integer, intent(in) :: power           !! the integer
      character(:), allocatable :: s         !! UTF-8

      character(3), parameter :: digits(0:9) = [character(3) :: "⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"]
      integer :: rest

      s = ""
      rest = abs(power)
      do
         s = trim(digits(modulo(rest, 10)))//s
         rest = rest/10
         if (rest == 0) exit
      end do
      if (power < 0) s = "⁻"//s
   end function raised

   !> A unit as printed: dots between factors and raised exponents; a decimal exponent stays on the line, as `N/m^1.5`.
   pure function pretty(si) result(symbol)
      character(*), intent(in) :: si         !! as in files, `kg.m^2`
      character(:), allocatable :: symbol    !! UTF-8

      integer :: i, length, power, status

      symbol = ""
      i = 1
      do while (i <= len(si))
         select case (si(i:i))
         case (".")
            symbol = symbol//"·"
         case ("^")
            length = exponent_length(si(i + 1:))
            status = 1
            if (length > 0 .and. index(si(i + 1:i + length), ".") == 0) read (si(i + 1:i + length), *, iostat=status) power
            if (status == 0) then
               symbol = symbol//raised(power)
            else
               symbol = symbol//si(i:i + length)
            end if
            i = i + length
         case ("u")
            if (i == 1 .and. len(si) > 1) then
               symbol = symbol//"µ"
            else
               symbol = symbol//si(i:i)
            end if
         case default
            symbol = symbol//si(i:i)
         end select
         i = i + 1
      end do
   end function pretty

end module display_units
