!> The unknowns of a fit in a row: parameters of the deck, one for all sets of data or one for each, then offsets and delays of
!> sensors. The search knows them as numbers between 0 and 1, at the bounds.
module fit_layout
   use dimension_text, only: unit_text
   use fit_plan, only: fit_plan_t
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: is_delay, is_offset, is_parameter, layout_of, value_of, place_t, width_of

   integer, parameter :: is_parameter = 1   !! a parameter of the deck
   integer, parameter :: is_offset = 2      !! the offset of a sensor
   integer, parameter :: is_delay = 3       !! the delay of a sensor

   real(wp), parameter :: inside = 1.0e-5_wp   !! distance from the bounds, of their distance: derivatives need both sides [1]

   !> An unknown.
   type :: place_t
      character(:), allocatable :: name     !! PARAMETER, PARAMETER.SET, SENSOR.offset or SENSOR.delay
      character(:), allocatable :: unit     !! SI
      integer :: kind = is_parameter        !! one of the above
      integer :: number = 0                 !! of the parameter or sensor
      integer :: set = 0                    !! of data that it belongs to; 0: all
      real(wp) :: lower = 0.0_wp            !! lower bound, SI [any]
      real(wp) :: upper = 0.0_wp            !! upper bound, SI [any]
      real(wp) :: start = 0.0_wp            !! where the search starts [1]
   end type place_t

contains

   !> All unknowns.
   function layout_of(plan, units) result(places)
      type(fit_plan_t), intent(in) :: plan       !! what is asked; its sets are those that are there
      type(text_t), intent(in) :: units(:)       !! (sensors) SI units of the channels
      type(place_t), allocatable :: places(:)    !! (n) the unknowns

      integer :: k, s

      allocate (places(0))
      do k = 1, size(plan%unknowns)
         associate (unknown => plan%unknowns(k))
            do s = 1, merge(size(plan%sets), 1, unknown%is_each)
               call add(unknown%name, unit_text(unknown%dimension), is_parameter, k, unknown%lower, unknown%upper, unknown%start)
               if (.not. unknown%is_each) cycle
               places(size(places))%set = s
               places(size(places))%name = unknown%name//"."//plan%sets(s)%name
            end do
         end associate
      end do
      do k = 1, size(plan%sensors)
         associate (sensor => plan%sensors(k))
            if (sensor%offset > 0.0_wp) then
               call add(sensor%name//".offset", units(k)%s, is_offset, k, -sensor%offset, sensor%offset, 0.0_wp)
            end if
            if (sensor%delay > 0.0_wp) call add(sensor%name//".delay", "s", is_delay, k, -sensor%delay, sensor%delay, 0.0_wp)
         end associate
      end do

   contains

      !> Add one.
      subroutine add(name, unit, kind, number, lower, upper, start)
         character(*), intent(in) :: name       !! its name
         character(*), intent(in) :: unit       !! SI
         integer, intent(in) :: kind            !! what it is
         integer, intent(in) :: number          !! of the parameter or sensor
         real(wp), intent(in) :: lower          !! lower bound, SI [any]
         real(wp), intent(in) :: upper          !! upper bound, SI [any]
         real(wp), intent(in) :: start          !! where the search starts, SI [any]

         type(place_t) :: new

         new%name = name
         new%unit = unit
         new%kind = kind
         new%number = number
         new%lower = lower
         new%upper = upper
         new%start = min(1.0_wp, max(0.0_wp, (start - value_of(new, 0.0_wp))/width_of(new)))
         places = [places, new]
      end subroutine add

   end function layout_of

   !> The value of an unknown.
   pure real(wp) function value_of(place, u) result(x)
      type(place_t), intent(in) :: place    !! the unknown
      real(wp), intent(in) :: u             !! between 0 and 1 [1]

      x = place%lower + (place%upper - place%lower)*(inside + (1.0_wp - 2.0_wp*inside)*u)
   end function value_of

   !> Its derivative by u.
   pure real(wp) function width_of(place) result(width)
      type(place_t), intent(in) :: place    !! the unknown

      width = (place%upper - place%lower)*(1.0_wp - 2.0_wp*inside)
   end function width_of

end module fit_layout
