!> Axes whose numbers differ little beside their size: they show what the numbers are beyond a round value, as ticks of the numbers
!> themselves would all read the same.
module round_values
   use display_units, only: display_unit_t
   use kinds, only: wp
   use text, only: real_text
   implicit none (type, external)
   private
   public :: constant, round_value, round_value_t

   real(wp), parameter :: narrow = 1.0e-4_wp        !! span of an axis beside its values: below it less a round value [1]
   real(wp), parameter :: constant = 1.0e-12_wp     !! the same: less is round-off [1]

   real(wp), parameter :: wide = 0.1_wp             !! span of what is left over, beside its values [1]

   !> What an axis takes from its numbers.
   type :: round_value_t
      real(wp) :: value = 0.0_wp           !! it, SI; 0: nothing is taken [any]
      character(:), allocatable :: words   !! as ` less 1000 m`, to stand behind the name of the axis; blank: nothing is taken
   end type round_value_t

contains

   !> The round value of an axis: no more digits than what is left over needs.
   pure function round_value(range, unit) result(less)
      real(wp), intent(in) :: range(2)           !! (2) minimum and maximum value, SI [any]
      type(display_unit_t), intent(in) :: unit   !! the unit that the value is round in
      type(round_value_t) :: less                !! what there is to take

      character(:), allocatable :: round
      real(wp) :: span, value
      integer :: digits, status

      less%words = ""
      span = range(2) - range(1)
      if (.not. (span <= narrow*maxval(abs(range)) .and. span > constant*maxval(abs(range)))) return
      do digits = 4, 15
         round = real_text(unit%factor*0.5_wp*sum(range), digits)
         read (round, *, iostat=status) value
         if (status /= 0) return
         less%value = value/unit%factor
         if (span > wide*maxval(abs(range - less%value))) exit
      end do
      less%words = " less "//trim(round//" "//unit%symbol)
   end function round_value

end module round_values
