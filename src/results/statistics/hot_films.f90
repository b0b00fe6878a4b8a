!> Films of a run whose side flow does not carry their heat away.
!>
!> temperature_rise is a balance of heat at an instant: what the film loses, in the lubricant that leaves then. Beyond 150 K no oil
!> is what the deck says, and the balance does not hold: in the mean because too little flows, or at instants only because hardly
!> any lubricant leaves then.
module hot_films
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use extremes, only: extremes_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: append_text, real_text, text_t
   implicit none (type, external)
   private
   public :: films_too_hot

   real(wp), parameter :: hottest = 150.0_wp   !! rise beyond which a balance does not hold [K]

contains

   !> A line for each such film whose channel is recorded.
   function films_too_hot(extremes, catalogue) result(warnings)
      type(extremes_t), intent(in) :: extremes       !! of the channels
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      type(text_t), allocatable :: warnings(:)       !! (any) the lines

      character(:), allocatable :: words
      real(wp) :: mean
      integer :: k

      allocate (warnings(0))
      do k = 1, size(extremes%channels)
         if (catalogue%groups(extremes%channels(k)%group)%channel%name /= "temperature_rise") cycle
         if (.not. extremes%has_values(k) .or. .not. extremes%of(k)%maximum > hottest) cycle
         words = scalar_name(catalogue, extremes%channels(k))//" reaches "//real_text(extremes%of(k)%maximum, 4)//" K at t = "// &
                 real_text(extremes%of(k)%max_time, 6)//" s (limit "//real_text(hottest, 3)//" K)"
         mean = extremes%mean(k)
         if (.not. ieee_is_finite(mean)) mean = extremes%of(k)%maximum
         if (mean > hottest) then
            words = words//", "//real_text(mean, 4)//" K on average: the side flow is too small to carry off the heat, and the "// &
                    "viscosity is wrong; use a larger clearance, a shorter bearing, a supply or a lubricant of lower viscosity"
         else
            words = words//", "//real_text(mean, 4)//" K on average: the side flow is almost zero at such times, and the "// &
                    "heat balance is not valid there; use the mean of film_power over that of side_flow"
         end if
         call append_text(warnings, words)
      end do
   end function films_too_hot

end module hot_films
