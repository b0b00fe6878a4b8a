!> What is written beside drawn mechanisms: times, and what the scales of symbols mean.
module scene_legends
   use display_units, only: choose_unit, display_unit_t
   use kinds, only: wp
   use scene_canvas, only: symbols_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: long_legend, short_legend, time_text

contains

   !> What the scales of a picture mean.
   function short_legend(symbols) result(words)
      type(symbols_t), intent(in) :: symbols   !! scales
      character(:), allocatable :: words       !! one line, perhaps blank

      words = ""
      if (symbols%magnified > 0.0_wp) words = "clearance × "//real_text(symbols%magnified, 2)
      if (.not. symbols%force > 0.0_wp) return
      if (len(words) > 0) words = words//",  "
      words = words//"longest arrow "//quantity_text("N", symbols%force, 3)
   end function short_legend

   !> The same in a sentence.
   function long_legend(symbols) result(words)
      type(symbols_t), intent(in) :: symbols   !! scales
      character(:), allocatable :: words       !! a line

      words = "bodies to scale"
      if (symbols%magnified > 0.0_wp) words = words//"; clearance of joints magnified "//real_text(symbols%magnified, 2)// &
                                              " times"
      if (symbols%force > 0.0_wp) words = words//"; arrows: loads and forces on journals, longest "// &
                                          quantity_text("N", symbols%force, 3)//" at the positions shown"
   end function long_legend

   !> A time that reads well.
   function time_text(t) result(words)
      real(wp), intent(in) :: t                !! the time [s]
      character(:), allocatable :: words       !! with its unit

      words = quantity_text("s", t, 4)
   end function time_text

   !> A quantity with a prefix that makes it short.
   function quantity_text(unit, value, digits) result(words)
      character(*), intent(in) :: unit         !! its SI unit
      real(wp), intent(in) :: value            !! the quantity [unit]
      integer, intent(in) :: digits            !! that are shown
      character(:), allocatable :: words       !! with its unit

      type(display_unit_t) :: shown

      shown = choose_unit(unit, abs(value))
      words = real_text(shown%factor*value, digits)//" "//shown%symbol
   end function quantity_text

end module scene_legends
