!> Elastic waves of an impact: what of its energy they take, which a quasi-static law of contact knows nothing of.
!>
!> lambda = 1.04 (v/c)^(3/5),   c = sqrt(E/rho)
!>
!> of a ball that hits a large body of the same material. At 1e-5 c it is 0.1 %; at 0.02 c, 104 m/s for steel, 10 %: as much as a
!> restitution of 0.95 loses.
!>
!> Source: S. C. Hunter, Energy absorbed by elastic waves during impact, J. Mech. Phys. Solids 5 (1957); K. L. Johnson, Contact
!> Mechanics (1985), section 11.4. Limits: balls; long thin bodies, as rods struck at an end, lose more.
module elastic_waves
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: bar_speed, most_share, share_of_waves, speed_of_share

   real(wp), parameter :: most_share = 0.1_wp   !! share of the energy up to which a law is taken as quasi-static [1]
   real(wp), parameter :: factor = 1.04_wp       !! share at the speed of waves [1]
   real(wp), parameter :: power = 0.6_wp         !! of the speed [1]

contains

   !> Share of an impact's energy that goes into waves, at most 1.
   elemental real(wp) function share_of_waves(speed, c) result(share)
      real(wp), intent(in) :: speed   !! impact speed [m/s]
      real(wp), intent(in) :: c       !! speed of waves in a bar [m/s]

      share = min(factor*(abs(speed)/c)**power, 1.0_wp)
   end function share_of_waves

   !> Impact speed at which the share is the maximum one allowed.
   elemental real(wp) function speed_of_share(c) result(speed)
      real(wp), intent(in) :: c   !! speed of waves in a bar [m/s]

      speed = c*(most_share/factor)**(1.0_wp/power)
   end function speed_of_share

   !> Speed of waves in a bar, from the impact speed at which the share is the maximum one allowed.
   elemental real(wp) function bar_speed(speed) result(c)
      real(wp), intent(in) :: speed   !! the impact speed [m/s]

      c = speed*(factor/most_share)**(1.0_wp/power)
   end function bar_speed

end module elastic_waves
