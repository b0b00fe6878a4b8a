!> A swept parameter as the axis of a figure: its values, the unit that they have in the deck, a logarithmic scale where they span
!> more than a decade and do not stand at equal distances; words stand at 1, 2, ...
module sweep_axes
   use display_units, only: ask_unit, choose_unit, display_unit_t
   use kinds, only: wp
   use numbers, only: number_length
   use swept, only: swept_t
   use text, only: segment, text_t
   implicit none (type, external)
   private
   public :: axis_of_parameter, sweep_axis_t

   real(wp), parameter :: decade = 10.0_wp  !! span of an axis from which it is logarithmic [1]

   !> An axis.
   type :: sweep_axis_t
      character(:), allocatable :: name            !! of the parameter
      character(:), allocatable :: unit            !! SI unit of its values
      type(display_unit_t) :: shown                !! unit to show; without a symbol: one that reads well
      logical :: is_log = .false.                  !! whether it is logarithmic
      type(text_t), allocatable :: categories(:)   !! (n) its values, if they are words; else none
      real(wp), allocatable :: x(:)                !! (n) where its values stand, SI [any]
   contains
      procedure :: unit_shown
   end type sweep_axis_t

contains

   !> The axis of a parameter.
   function axis_of_parameter(parameter) result(axis)
      type(swept_t), intent(in) :: parameter   !! the parameter
      type(sweep_axis_t) :: axis               !! its axis

      integer :: k

      axis%name = parameter%name
      axis%unit = "1"
      if (parameter%unit == "") then
         axis%categories = parameter%texts
         axis%x = [(real(k, wp), k=1, size(parameter%texts))]
      else
         allocate (axis%categories(0))
         axis%unit = parameter%unit
         axis%shown = unit_of_values(parameter%texts, parameter%unit)
         axis%x = parameter%numbers
         axis%is_log = minval(axis%x) > 0.0_wp .and. maxval(axis%x) > decade*minval(axis%x) .and. .not. is_even(axis%x)
      end if
   end function axis_of_parameter

   !> The unit that the axis shows.
   function unit_shown(self) result(unit)
      class(sweep_axis_t), intent(in) :: self   !! the axis
      type(display_unit_t) :: unit              !! the unit

      unit = self%shown
      if (.not. allocated(unit%symbol)) unit = choose_unit(self%unit, maxval(abs(self%x)))
   end function unit_shown

   !> The unit that all values have in the deck; without a symbol if there is none that is shown.
   function unit_of_values(texts, si) result(unit)
      type(text_t), intent(in) :: texts(:)   !! (n) values as in the deck, `300rpm`
      character(*), intent(in) :: si         !! SI unit of their numbers
      type(display_unit_t) :: unit           !! as rpm

      type(display_unit_t) :: asked
      character(:), allocatable :: message, name
      integer :: k

      do k = 1, size(texts)
         associate (text => texts(k)%s, n => number_length(texts(k)%s))
            if (k == 1) name = segment(text, n + 1)
            if (n == 0 .or. segment(text, n + 1) /= name) return
         end associate
      end do
      if (len(name) == 0) return
      call ask_unit(name, si, asked, message)
      if (len(message) == 0) unit = asked
   end function unit_of_values

   !> Whether values stand at equal distances, as those of a range.
   pure logical function is_even(x)
      real(wp), intent(in) :: x(:)       !! (n) values [any]

      real(wp), parameter :: same = 1.0e-6_wp   ! of the whole way [1]
      integer :: k

      is_even = size(x) > 3
      do k = 2, size(x) - 1
         is_even = is_even .and. abs(x(k) - x(1) - (x(size(x)) - x(1))*real(k - 1, wp)/real(size(x) - 1, wp)) <= &
                   same*abs(x(size(x)) - x(1))
      end do
   end function is_even

end module sweep_axes
