!> What of a channel is round-off: less than a part of what its kind is in a run.
!>
!> A sum of numbers is rounded by a part of the maximum of them, so a channel whose maximum magnitude is below that part of the
!> maximum of its kind was computed from nothing. Kinds are units; those of rates, accelerations and powers follow from the
!> lengths, the duration and the forces too, so that a mechanism at rest has noise as one that moves; those of forces from the
!> least mass and the accelerations, so that a mechanism without forces has noise too. Tables, figures and
!> comparisons show such a channel as zero; run.h5 keeps its numbers.
module channel_noise
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: real_text, text_t
   implicit none (type, external)
   private
   public :: known_text, noise_of_channels, noise_words, shown

   real(wp), parameter :: of_length = 1.0e-13_wp  !! what lengths, angles and numbers are rounded by [1]
   real(wp), parameter :: of_rate = 1.0e-13_wp    !! velocities, energies [1]
   real(wp), parameter :: of_load = 1.0e-12_wp    !! forces, accelerations, powers: solutions of equations [1]

contains

   !> The noise of channels by the maximum magnitudes of all.
   pure function noise_of_channels(units, maximum, duration, mass) result(noise)
      type(text_t), intent(in) :: units(:)                 !! (n) SI
      real(wp), intent(in) :: maximum(:)                  !! (n) maximum magnitudes; none is a number: 0 [any]
      real(wp), intent(in) :: duration                     !! of the run [s]
      real(wp), intent(in), optional :: mass               !! of the lightest body, if it is known [kg]
      real(wp) :: noise(size(units))                       !! (n) less is round-off [any]

      real(wp) :: energy, force, length, moment, power, rate, speed, contact_rate, thrust
      integer :: k

      length = max_of("m")
      rate = 0.0_wp
      if (duration > 0.0_wp) rate = 1.0_wp/duration
      speed = max(max_of("m/s"), length*rate)
      if (length > 0.0_wp) rate = max(rate, speed/length)
      rate = max(rate, max_of("rad/s"))
      thrust = max(max_of("m/s^2"), speed*rate)
      contact_rate = max(max_of("rad/s^2"), rate**2)
      moment = max_of("N.m")
      force = max_of("N")
      if (length > 0.0_wp) force = max(force, moment/length)
      if (present(mass)) force = max(force, mass*thrust)
      moment = max(moment, force*length)
      energy = max_of("J")
      power = max(max_of("W"), force*speed)
      do k = 1, size(units)
         select case (units(k)%s)
         case ("m"); noise(k) = of_length*length
         case ("rad", "1"); noise(k) = of_length
         case ("m/s"); noise(k) = of_rate*speed
         case ("rad/s"); noise(k) = of_rate*rate
         case ("m/s^2"); noise(k) = of_load*thrust
         case ("rad/s^2"); noise(k) = of_load*contact_rate
         case ("N"); noise(k) = of_load*force
         case ("N.m"); noise(k) = of_load*moment
         case ("J"); noise(k) = of_rate*energy
         case ("W"); noise(k) = of_load*power
         case default; noise(k) = 0.0_wp
         end select
      end do

   contains

      !> The maximum magnitude of all channels of a unit.
      pure real(wp) function max_of(unit) result(most)
         character(*), intent(in) :: unit   !! the unit

         integer :: i

         most = 0.0_wp
         do i = 1, size(units)
            if (units(i)%s == unit .and. ieee_is_finite(maximum(i))) most = max(most, maximum(i))
         end do
      end function max_of

   end function noise_of_channels

   !> A number for people: zero if it is round-off, not a number if it is not known.
   elemental real(wp) function shown(x, noise)
      real(wp), intent(in) :: x       !! the number [any]
      real(wp), intent(in) :: noise   !! of its channel [any]

      shown = x
      if (.not. ieee_is_finite(x)) return
      if (abs(x) <= noise) shown = 0.0_wp
   end function shown

   !> A number for people: `-` if it is not known.
   pure function known_text(x, digits) result(words)
      real(wp), intent(in) :: x             !! the number [any]
      integer, intent(in) :: digits         !! significant digits
      character(:), allocatable :: words    !! the number

      words = "-"
      if (ieee_is_finite(x)) words = real_text(x, digits)
   end function known_text

   !> What `explain` and the manual say of it.
   pure function noise_words() result(words)
      character(:), allocatable :: words    !! one line

      words = "channels shown as zero: those below "//real_text(of_length, 2)//" of the maximum length, angle (1 rad) or "// &
         "number, "// &
              real_text(of_rate, 2)//" of the maximum speed or energy, "//real_text(of_load, 2)// &
              " of the maximum force, acceleration or power of the run (of a force: at least the mass of the lightest body "// &
              "times the maximum acceleration)"
   end function noise_words

end module channel_noise
