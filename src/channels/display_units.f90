!> Units for the axes of figures: from SI to what reads well.
module display_units
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: choose_unit, display_unit_t

   !> How numbers are shown.
   type :: display_unit_t
      real(wp) :: factor = 1.0_wp          !! SI values times this [any]
      character(:), allocatable :: symbol  !! of the unit shown, UTF-8; blank: none
   end type display_unit_t

contains

   !> The unit to show a quantity in.
   pure function choose_unit(si, extent) result(shown)
      character(*), intent(in) :: si     !! SI unit, as in files
      real(wp), intent(in) :: extent     !! greatest magnitude that is shown, SI [any]
      type(display_unit_t) :: shown      !! what to show

      shown%symbol = pretty(si)
      if (si == "1") shown%symbol = ""
      if (extent <= 0.0_wp) return
      select case (si)
      case ("s")
         if (extent < 1.0e-3_wp) then
            call scale(1.0e6_wp, "µs")
         else if (extent < 1.0_wp) then
            call scale(1.0e3_wp, "ms")
         end if
      case ("m")
         if (extent < 1.0e-6_wp) then
            call scale(1.0e9_wp, "nm")
         else if (extent < 1.0e-4_wp) then
            call scale(1.0e6_wp, "µm")
         else if (extent < 1.0_wp) then
            call scale(1.0e3_wp, "mm")
         end if
      case ("m/s")
         if (extent < 1.0e-6_wp) then
            call scale(1.0e9_wp, "nm/s")
         else if (extent < 1.0e-4_wp) then
            call scale(1.0e6_wp, "µm/s")
         else if (extent < 1.0e-2_wp) then
            call scale(1.0e3_wp, "mm/s")
         end if
      case ("m/s^2", "rad/s^2")
         if (extent >= 1.0e4_wp) call scale(1.0e-3_wp, "10³ "//pretty(si))
      case ("N", "N.m", "J", "W")
         if (extent >= 1.0e6_wp) then
            call scale(1.0e-6_wp, "M"//pretty(si))
         else if (extent >= 1.0e4_wp) then
            call scale(1.0e-3_wp, "k"//pretty(si))
         else if (extent < 1.0e-8_wp) then
            call scale(1.0e9_wp, "n"//pretty(si))
         else if (extent < 1.0e-5_wp) then
            call scale(1.0e6_wp, "µ"//pretty(si))
         else if (extent < 1.0e-2_wp) then
            call scale(1.0e3_wp, "m"//pretty(si))
         end if
      case ("Pa")
         if (extent >= 1.0e4_wp) call scale(1.0e-6_wp, "MPa")
      case default
         continue
      end select

   contains

      !> Take another unit.
      pure subroutine scale(factor, symbol)
         real(wp), intent(in) :: factor      !! SI values times this [any]
         character(*), intent(in) :: symbol  !! of the unit

         shown%factor = factor
         shown%symbol = symbol
      end subroutine scale
   end function choose_unit

   !> A unit as printed: dots between factors and raised exponents.
   pure function pretty(si) result(symbol)
      character(*), intent(in) :: si         !! as in files, `kg.m^2`
      character(:), allocatable :: symbol    !! UTF-8

      integer :: i

      symbol = ""
      i = 1
      do while (i <= len(si))
         select case (si(i:i))
         case (".")
            symbol = symbol//"·"
         case ("^")
            i = i + 1
            if (i > len(si)) exit
            if (si(i:i) == "2") then
               symbol = symbol//"²"
            else if (si(i:i) == "3") then
               symbol = symbol//"³"
            else
               symbol = symbol//"^"//si(i:i)
            end if
         case default
            symbol = symbol//si(i:i)
         end select
         i = i + 1
      end do
   end function pretty

end module display_units
