!> The penetration of a round pin in a round hole whose overlap has a given second moment.
!>
!> e = c + delta,  d(theta) = delta - 2 e sin^2(theta/2) - e^2 sin^2(theta)/(r + S),  S = sqrt(r^2 - e^2 sin^2(theta))
!> M(delta) = 2 int_0^b d^2 dtheta,  b the half angle of the arc at the hole's centre (`wear_arc`)
!> M' = 2 int 2 d d_e,  M'' = 2 int 2 (d_e^2 + d d_ee),  d_e = cos - e sin^2/S,  d_ee = -r^2 sin^2/S^3
!>
!> by Gauss's rule of eight points, right to round-off; solved by Newton's method for M^(2/5), which is all but linear in delta: of
!> a small overlap M = (16/15) delta^2 sqrt(2 delta/k), k = e (1 + e/r).
!> Source: this program. Limits: e up to nine tenths of r; beyond, M^(2/5) is extrapolated by a straight line.
module round_moment
   use kinds, only: wp
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: penetration_of_moment

   integer, parameter :: n_half = 4   !! half of Gauss's points
   real(wp), parameter :: places(n_half) = [0.18343464249564980494_wp, 0.52553240991632898582_wp, 0.79666647741362673959_wp, &
                                            0.96028985649753623168_wp]   !! of the points in (-1, 1) [1]
   real(wp), parameter :: weights(n_half) = [0.36268378337836198297_wp, 0.31370664587788728734_wp, 0.22238103445337447054_wp, &
                                             0.10122853629037625915_wp]  !! their weights [1]
   integer, parameter :: most_iterations = 20
   real(wp), parameter :: power = 0.4_wp          !! of M [1]
   real(wp), parameter :: farthest = 0.9_wp       !! part of r up to which e goes [1]

contains

   !> Penetration from a moment.
   pure subroutine penetration_of_moment(pair, moment, delta, slope, bend)
      type(surfaces_t), intent(in) :: pair   !! radii and clearance of the new surfaces
      real(wp), intent(in) :: moment         !! M, positive [m^2.rad]
      real(wp), intent(out) :: delta         !! penetration [m]
      real(wp), intent(out) :: slope         !! M'(delta) [m.rad]
      real(wp), intent(out) :: bend          !! M''(delta) [rad]

      real(wp), parameter :: enough = 1.0e-9_wp   ! part of delta: what is left falls by its square
      real(wp) :: e, here, ratio, step
      integer :: k

      e = pair%clearance
      do k = 1, 2
         delta = (0.9375_wp*moment*sqrt(0.5_wp*e*(1.0_wp + e/pair%radius_j)))**power
         e = pair%clearance + delta
      end do
      associate (most => farthest*pair%radius_j - pair%clearance)
         do k = 1, most_iterations
            delta = min(delta, most)
            call moment_of(pair, delta, here, slope, bend)
            if (.not. here > 0.0_wp) then  ! below the smallest number: M goes as the power 1/0.4 of delta
               slope = moment/(power*delta)
               bend = (1.0_wp/power - 1.0_wp)*slope/delta
               return
            end if
            ratio = (moment/here)**power
            step = (ratio - 1.0_wp)*here/(power*slope)
            if (delta + step > most .and. delta >= most) exit
            delta = delta + step
            if (abs(step) <= enough*delta) then
               slope = slope + bend*step
               return
            end if
         end do
         delta = delta + step  ! along the straight line
         slope = slope*(moment/here)**(1.0_wp - power)
         bend = (1.0_wp - power)*slope**2/moment
      end associate
   end subroutine penetration_of_moment

   !> M and its derivatives.
   pure subroutine moment_of(pair, delta, moment, slope, bend)
      type(surfaces_t), intent(in) :: pair   !! radii and clearance
      real(wp), intent(in) :: delta          !! penetration [m]
      real(wp), intent(out) :: moment        !! M [m^2.rad]
      real(wp), intent(out) :: slope         !! M' [m.rad]
      real(wp), intent(out) :: bend          !! M'' [rad]

      real(wp) :: arc, d, d_e, e, half, root, sine, square
      integer :: k, side

      e = pair%clearance + delta
      associate (r => pair%radius_j)
         arc = 2.0_wp*asin(sqrt(0.25_wp*delta*(r + e + pair%radius_i)/(r*e)))  ! at the pin's centre, see `wear_arc`
         arc = atan2(r*sin(arc), e + r*cos(arc))
      end associate
      moment = 0.0_wp
      slope = 0.0_wp
      bend = 0.0_wp
      do k = 1, n_half
         do side = -1, 1, 2
            half = 0.25_wp*arc*(1.0_wp + side*places(k))
            sine = 2.0_wp*sin(half)*cos(half)
            square = sine**2
            root = sqrt(pair%radius_j**2 - e**2*square)
            d = delta - 2.0_wp*e*sin(half)**2 - e**2*square/(pair%radius_j + root)
            d_e = 1.0_wp - 2.0_wp*sin(half)**2 - e*square/root
            moment = moment + weights(k)*d**2
            slope = slope + weights(k)*2.0_wp*d*d_e
            bend = bend + weights(k)*2.0_wp*(d_e**2 - d*pair%radius_j**2*square/root**3)
         end do
      end do
      moment = arc*moment
      slope = arc*slope
      bend = arc*bend
   end subroutine moment_of

end module round_moment
