!> How far the channels of two runs differ.
!>
!> Differences of channels are measured by the scale of their kind: of positions, velocities and reactions as in `run_difference`
!> (velocities and reactions of all rows), of all else the maximum magnitude of what has the same unit in the same group of the
!> catalogue (what turns counts at the maximum radius of gyration), of energies the ledger's yardstick. Angles that jump by a turn
!> differ by less than half a turn; as long as they go all round they have no extremes.
module channel_difference
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_channels, only: class_acceleration, class_energy, class_force, class_length, class_other, class_power, class_rate, &
      kept_channels_t
   use kept_run, only: n_sort, sort_positions, sort_reactions, sort_velocities
   use kinds, only: wp
   use run_difference, only: scales_of
   implicit none (type, external)
   private
   public :: channel_scales, set_differences

   ! of the scale of positions, velocities and reactions: less is nothing for channels of their units [1]
   real(wp), parameter :: floor_length = 1.0e-6_wp  !! penetrations are small and carry forces
   real(wp), parameter :: floor_rate = 1.0e-3_wp    !! rates of contacts that have settled are what the tolerance leaves of them
   real(wp), parameter :: floor_force = 1.0e-9_wp   !! forces that vanish
   real(wp), parameter :: not_alike = 1.0e100_wp   !! difference of what is a number in one run only [any]
   real(wp), parameter :: turn = 8.0_wp*atan(1.0_wp) !! a whole one [rad]
   real(wp), parameter :: all_round = 0.75_wp*turn  !! range from which an angle goes all round [rad]

contains

   !> Scales of all kinds in a run. What is less than a small part of the scale of positions, velocities or reactions is nothing,
   !> and so is a reaction to what the energies, over the size of the mechanism, make of one.
   function channel_scales(run, size_of_scene, end) result(scale)
      class(kept_channels_t), intent(in) :: run      !! the run
      real(wp), intent(in) :: size_of_scene          !! size of the mechanism [m]
      real(wp), intent(in) :: end                    !! time of the motion [s]
      real(wp), allocatable :: scale(:)              !! (kinds) in their units [any]

      real(wp) :: floors(class_other)
      integer :: k

      scale = run%magnitude
      scale(:n_sort) = scales_of(run, size_of_scene, end)
      scale(sort_velocities) = max(scale(sort_velocities), run%magnitude(sort_velocities))
      if (run%magnitude(sort_reactions) > 0.0_wp) scale(sort_reactions) = run%magnitude(sort_reactions)
      scale(sort_reactions) = max(scale(sort_reactions), floor_force*run%summary%quality%energy_max/size_of_scene)
      floors = 0.0_wp
      floors(class_length) = floor_length*scale(sort_positions)
      floors(class_rate) = floor_rate*scale(sort_velocities)
      floors(class_force) = floor_force*scale(sort_reactions)
      floors(class_acceleration) = floors(class_rate)/end
      floors(class_power) = floors(class_force)*scale(sort_velocities)
      do k = n_sort + 1, size(scale)
         associate (class => run%further(k - n_sort)%class)
            scale(k) = max(scale(k), floors(class))
            if (class == class_energy) scale(k) = run%summary%quality%energy_max
            if (scale(k) <= 0.0_wp) scale(k) = 1.0_wp
         end associate
      end do
   end function channel_scales

   !> Raise the differences of channels by those of two runs, up to each common instant: of values, and of the extremes so far.
   subroutine set_differences(run, other, scale, until, by_instant, by_channel, worst)
      class(kept_channels_t), intent(in) :: run      !! the run
      class(kept_channels_t), intent(in) :: other    !! another one
      real(wp), intent(in) :: scale(:)               !! (kinds) scales [any]
      real(wp), intent(in) :: until                  !! time up to which those of each channel are requested [s]
      real(wp), intent(inout) :: by_instant(:)       !! (instants of the run) maximum of all channels, over the scale [1]
      real(wp), intent(inout) :: by_channel(:)       !! (n) maximum of a channel up to that time [any]
      integer, intent(inout) :: worst(:)             !! (instants of the run) number of the channel that has it

      real(wp) :: d
      integer :: i, k

      do i = 1, min(run%n, other%n)
         do k = 1, size(run%kind)
            d = apart(run%series%x(k, i), other%series%x(k, i))
            if (run%goes_round(k)) d = min(d, abs(turn - d))
            if (run%state_of(k) > 0 .and. d >= not_alike) d = 0.0_wp   ! it touches in one run only: its force reports
            d = max(d, of_extremes(k, [run%series%low(k, i), run%series%high(k, i)], &
                                   [other%series%low(k, i), other%series%high(k, i)]))
            call raise(i, k, d)
         end do
      end do
      ! a condition may end one of them an instant earlier; else they go apart where the first one ends
      if (abs(run%n - other%n) > 1) by_instant(max(1, min(run%n, other%n + 1)):) = not_alike
      if (run%n == 0 .or. run%n /= other%n) return
      do k = 1, size(run%kind)   ! rows behind the last instant
         d = of_extremes(k, [run%series%minimum(k), run%series%most(k)], [other%series%minimum(k), other%series%most(k)])
         call raise(run%n, k, d)
      end do

   contains

      !> Difference of the extremes of a channel. There is none of an angle that has gone all round in one of the runs, or of the
      !> place of a contact that has not touched yet in one.
      real(wp) function of_extremes(k, range, other_range) result(d)
         integer, intent(in) :: k                    !! number of the channel
         real(wp), intent(in) :: range(2)            !! (2) minimum and maximum value; the minimum is greater: there are none [any]
         real(wp), intent(in) :: other_range(2)      !! (2) the same of the other run [any]

         real(wp) :: span
         logical :: has(2)

         d = 0.0_wp
         has = [range(1) <= range(2), other_range(1) <= other_range(2)]
         span = 0.0_wp
         if (has(1)) span = range(2) - range(1)
         if (has(2)) span = max(span, other_range(2) - other_range(1))
         if (run%goes_round(k) .and. span > all_round) return
         if (run%state_of(k) > 0 .and. .not. all(has)) return
         d = max(apart(range(1), other_range(1)), apart(range(2), other_range(2)))
      end function of_extremes

      !> Raise the differences of an instant and of a channel.
      subroutine raise(i, k, d)
         integer, intent(in) :: i   !! number of the instant
         integer, intent(in) :: k   !! number of the channel
         real(wp), intent(in) :: d  !! a difference [any]

         real(wp) :: part

         part = d*run%factor_of(k)/scale(run%kind(k))
         if (part > by_instant(i)) worst(i) = k
         by_instant(i) = max(by_instant(i), part)
         if (run%t(i) <= until) by_channel(k) = max(by_channel(k), d)
      end subroutine raise

   end subroutine set_differences

   !> Distance of two values; nothing if neither is a number.
   pure real(wp) function apart(a, b)
      real(wp), intent(in) :: a  !! a value [any]
      real(wp), intent(in) :: b  !! another one [any]

      if (ieee_is_finite(a) .and. ieee_is_finite(b)) then
         apart = min(abs(a - b), not_alike)
      else
         apart = merge(0.0_wp, not_alike, .not. (ieee_is_finite(a) .or. ieee_is_finite(b)))
      end if
   end function apart

end module channel_difference
