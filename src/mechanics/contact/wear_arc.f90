!> Where on its circumference a surface loses what a contact wears off: shares of cells.
!>
!> A contact presses on an arc of half angle b about phi, with the weight cos(theta - phi)/(2 sin b), whose integral is one. While
!> phi sweeps from phi_a to phi_b, at equal parts of the work, the arc leaves
!>
!> w(theta) = 1/(phi_b - phi_a) int cos(theta - phi)/(2 sin b) dphi,   |theta - phi| < b
!>
!> The share of a cell is the integral of w over it, in closed form: shares are not negative, and their sum is one for any width of
!> the cells; a narrow arc is in one cell or two, a long sweep leaves no gaps.
!>
!> Arc of a pin of radius r whose centre lies e off that of a hole of radius R, delta = e + r - R deep: half angle a at the
!> centre of the pin, b at that of the hole,  1 - cos a = delta (r + e + R)/(2 r e),  tan b = r sin a/(e + r cos a).
!> Of worn surfaces the arc is given by points (`add_swept_points`).
!> Limits: the surfaces are round where an arc has half angles; angles are in cells of one width; an arc is at most half a turn.
module wear_arc
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: add_swept_arc, add_swept_points, half_angles

contains

   !> Half angles of the arc in which the surfaces overlap: at the centre of the hole, and at that of the pin; zero where
   !> they are apart.
   pure function half_angles(radius_i, radius_j, distance) result(angles)
      real(wp), intent(in) :: radius_i    !! of the hole [m]
      real(wp), intent(in) :: radius_j    !! of the pin [m]
      real(wp), intent(in) :: distance    !! of the centres [m]
      real(wp) :: angles(2)               !! (2) from hole and pin, up to a quarter turn [rad]

      real(wp) :: depth, versine

      angles = 0.0_wp
      depth = distance + radius_j - radius_i
      if (.not. (depth > 0.0_wp .and. distance > 0.0_wp)) return
      versine = depth*(radius_j + distance + radius_i)/(2.0_wp*radius_j*distance)
      angles(2) = 2.0_wp*asin(sqrt(min(0.5_wp*versine, 1.0_wp)))
      angles(1) = atan2(radius_j*sin(angles(2)), distance + radius_j*cos(angles(2)))
      angles = min(angles, 0.5_wp*pi)
   end function half_angles

   !> Add the shares of an amount to the cells of a circumference.
   pure subroutine add_swept_arc(cells, from, to, half_angle, amount)
      real(wp), intent(inout) :: cells(:)      !! (n) added to; cell k lies from 2 pi (k - 1)/n to 2 pi k/n [any]
      real(wp), intent(in) :: from             !! direction of the arc's middle at the start [rad]
      real(wp), intent(in) :: to               !! and at the end, less than a turn away [rad]
      real(wp), intent(in) :: half_angle       !! of the arc, positive, at most a quarter turn [rad]
      real(wp), intent(in) :: amount           !! what is shared out [any]

      real(wp) :: before, behind, first, last, width
      integer :: k

      width = 2.0_wp*pi/size(cells)
      first = min(from, to) - half_angle
      last = max(from, to) + half_angle
      before = 0.0_wp
      do k = floor(first/width), floor(last/width)
         behind = 1.0_wp
         if ((k + 1)*width < last) behind = min(max(part_before((k + 1)*width), before), 1.0_wp)
         associate (cell => cells(modulo(k, size(cells)) + 1))
            cell = cell + amount*(behind - before)
         end associate
         before = behind
      end do

   contains

      !> Part of the amount that is before a direction.
      pure real(wp) function part_before(theta) result(part)
         real(wp), intent(in) :: theta   !! the direction [rad]

         real(wp), parameter :: short = 1.0e-3_wp   ! sweeps of this part of the arc are as good as none: its square is small [1]
         real(wp) :: x

         if (abs(to - from) < short*half_angle) then
            x = min(max(theta - 0.5_wp*(from + to), -half_angle), half_angle)
            part = 0.5_wp + 0.5_wp*sin(x)/sin(half_angle)
         else
            part = (integral(theta - from) - integral(theta - to))/(to - from)
         end if
      end function part_before

      !> Integral of the part of an arc about zero that is before x.
      pure real(wp) function integral(x)
         real(wp), intent(in) :: x   !! direction [rad]

         if (x <= -half_angle) then
            integral = 0.0_wp
         else if (x >= half_angle) then
            integral = x
         else
            integral = 0.5_wp*(x + half_angle) - sin(0.5_wp*(half_angle + x))*sin(0.5_wp*(half_angle - x))/sin(half_angle)
         end if
      end function integral

   end subroutine add_swept_arc

   !> Add the shares of an amount that points of an arc leave while all of them sweep along the surface; each stands for an angle
   !> around it, over which its share is spread, too.
   pure subroutine add_swept_points(cells, angle, span, weight, by, amount)
      real(wp), intent(inout) :: cells(:)   !! (n) added to; cell k lies from 2 pi (k - 1)/n to 2 pi k/n [any]
      real(wp), intent(in) :: angle(:)      !! (points) where they are [rad]
      real(wp), intent(in) :: span(:)       !! (points) angles that they stand for [rad]
      real(wp), intent(in) :: weight(:)     !! (points) their parts, not negative, their sum positive [any]
      real(wp), intent(in) :: by(2)         !! (2) from where to where they sweep, from these angles [rad]
      real(wp), intent(in) :: amount        !! what is shared out [any]

      real(wp) :: before, behind, first, last, share, total, width
      integer :: k, m

      total = sum(weight)
      width = 2.0_wp*pi/size(cells)
      do m = 1, size(angle)
         share = amount*(weight(m)/total)
         first = (angle(m) - 0.5_wp*span(m) + minval(by))/width
         last = (angle(m) + 0.5_wp*span(m) + maxval(by))/width
         before = 0.0_wp
         do k = floor(first), floor(last)
            behind = 1.0_wp
            if (k + 1 < last) behind = min(max((k + 1 - first)/(last - first), before), 1.0_wp)
            associate (cell => cells(modulo(k, size(cells)) + 1))
               cell = cell + share*(behind - before)
            end associate
            before = behind
         end do
      end do
   end subroutine add_swept_points

end module wear_arc
