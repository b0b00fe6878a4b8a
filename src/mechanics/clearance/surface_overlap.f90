!> How deep a worn pin is in a worn hole: a penetration by the energy of a foundation, and its derivatives.
!>
!> A worn arc has no deepest point. The second moment of the overlap d(theta) of `overlap_rays` is, but for a factor, the energy of
!> a foundation of springs along the surface; the penetration is that of round surfaces with the same moment:
!>
!> M = int_{d > 0} d^2 dtheta,   M_round(delta) = M,   grad delta = grad M / M_round'(delta)
!>
!> so that of round surfaces delta = |e| - c, whatever the normal law F(delta). By virtual work the contact then has, with
!> lambda = |d delta/de|, n = (d delta/de)/lambda, the force lambda F along n, at a point C that is common to both bodies:
!>
!> C = P_j + rho n + s t,  t = R90 n,  s = -(d delta/d alpha_j)/lambda,   n . (v_j - v_i) at C = delta'/lambda
!>
!> rho lies half a penetration below the pin's surface, whose mean depth there is h = int d h_j/int d. As delta does not change when
!> everything turns together, momentum and angular momentum are kept.
!> Where the surfaces are apart delta is the maximum of d, and grad delta that of its ray.
!>
!> The integrals are by Lobatto's rule in the intervals of the hole, whose places are tabulated, and by Gauss's to the ends of the
!> overlap; both are exact for d of degree 4. So nothing happens where an arc passes the edge of a cell of the hole. Edges of the
!> pin's cells are passed at fixed places of the hole: M is as smooth as its profile. By the angle of the hole's body delta
!> has the derivative that makes a common rotation change nothing.
!> Signs: delta > 0 in contact. Source: this program. Limits: those of `overlap_rays` and `overlap_parts`.
module surface_overlap
   use gauss_points, only: n_six, six_places, six_weights
   use kinds, only: pi, wp
   use overlap_parts, only: at_most, look_at
   use overlap_rays, only: find_ray, find_rays, pin_t, ray_t, rays_t
   use overlap_sums, only: add_rays, append, arc_t, sums_t, to_gradient, to_rates
   use round_moment, only: penetration_of_moment
   use surface_profile, only: most_places
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: find_overlap, overlap_t

   !> What is known of an overlap.
   type :: overlap_t
      real(wp) :: delta = 0.0_wp                !! penetration, negative: apart [m]
      real(wp) :: gradient(2) = 0.0_wp          !! (2) its derivative by e, world frame [1]
      real(wp) :: by_i = 0.0_wp                 !! by the angle of the hole's body [m/rad]
      real(wp) :: by_j = 0.0_wp                 !! and by that of the pin's body [m/rad]
      real(wp) :: depth = 0.0_wp                !! mean depth of the pin there [m]
      real(wp) :: rate = 0.0_wp                 !! of the penetration [m/s]
      real(wp) :: second = 0.0_wp               !! its second derivative by time [m/s^2]
      real(wp) :: gradient_rate(2) = 0.0_wp     !! (2) rate of the gradient [1/s]
      real(wp) :: depth_rate = 0.0_wp           !! rate of the depth of the pin [m/s]
   end type overlap_t

   real(wp), parameter :: farthest = 0.9_wp       !! part of the pin's radius up to which the centres are apart [1]
   integer, parameter :: n_step = n_six - 1       !! places of an interval before those of the next one

contains

   !> Penetration and what follows of it: found in the axes of the hole's body, where its cells stand still. A pin that is nowhere
   !> near its hole, as in a step that is not accepted, is taken as round.
   pure subroutine find_overlap(pair, pin, level, overlap, arc)
      type(surfaces_t), intent(in) :: pair            !! the surfaces, with profiles
      type(pin_t), intent(in) :: pin                  !! where the pin is, world frame
      integer, intent(in) :: level                    !! one of the above
      type(overlap_t), intent(out) :: overlap         !! set
      type(arc_t), intent(inout), optional :: arc     !! points of the arc

      type(pin_t) :: here
      real(wp) :: turn(2, 2)

      if (present(arc)) arc%n = 0
      if (.not. (pin%distance < farthest*pair%radius_j .and. maxval(abs(pin%angle)) < huge(1.0_wp))) then
         overlap%delta = pin%distance - pair%clearance + 0.0_wp*sum(pin%angle)
         overlap%gradient = pin%e/pin%distance
         return
      end if
      turn = reshape([cos(pin%angle(1)), -sin(pin%angle(1)), sin(pin%angle(1)), cos(pin%angle(1))], [2, 2])
      here = pin
      here%e = matmul(turn, pin%e)
      here%e_dot = matmul(turn, pin%e_dot)
      here%e_ddot = matmul(turn, pin%e_ddot)
      here%angle = modulo(pin%angle - pin%angle(1), 2.0_wp*pi)
      here%phi = modulo(pin%phi - pin%angle(1), 2.0_wp*pi)
      call find_in_hole(pair, here, level, overlap, arc)
      overlap%gradient = matmul(overlap%gradient, turn)
      if (level >= to_rates) overlap%gradient_rate = matmul(overlap%gradient_rate, turn)
   end subroutine find_overlap

   !> The same in axes of the hole's body.
   pure subroutine find_in_hole(pair, pin, level, overlap, arc)
      type(surfaces_t), intent(in) :: pair            !! the surfaces, with profiles
      type(pin_t), intent(in) :: pin                  !! where the pin is
      integer, intent(in) :: level                    !! one of the above
      type(overlap_t), intent(inout) :: overlap       !! set, new
      type(arc_t), intent(inout), optional :: arc     !! points of the arc

      type(ray_t) :: deepest, ray
      type(sums_t) :: sums
      real(wp) :: kappa, kappa_slope, part

      if (pin%distance > pair%clearance) then  ! else the surfaces are apart: wear only widens the gap
         part = acos(pair%clearance/pin%distance)
         call scan_overlap(pair, pin, pin%phi - part, pin%phi + part, level, sums, deepest, arc)
      end if
      if (sums%m > 0.0_wp) then
         call penetration_of_moment(pair, sums%m, overlap%delta, kappa, kappa_slope)
         overlap%gradient = sums%e/kappa
         overlap%by_j = sums%j/kappa
         overlap%by_i = pin%e(2)*overlap%gradient(1) - pin%e(1)*overlap%gradient(2) - overlap%by_j
         overlap%depth = sums%h/sums%d
         if (level < to_rates) return
         overlap%rate = sums%m_dot/kappa
         overlap%gradient_rate = (sums%e_dot - overlap%gradient*(kappa_slope*overlap%rate))/kappa
         overlap%depth_rate = (sums%h_dot - overlap%depth*sums%d_dot)/sums%d
         overlap%second = (sums%m_ddot - kappa_slope*overlap%rate**2)/kappa
      else
         call find_ray(pair, pin, pin%phi, cell_at(pair, pin%phi), .false., .false., ray)
         part = pi
         if (ray%d + pair%clearance > -pin%distance) part = acos(min((ray%d + pair%clearance)/pin%distance, 1.0_wp))
         deepest = ray
         call scan_gap(pair, pin, pin%phi - part, pin%phi + part, deepest)
         call take_ray(pair, pin, deepest%theta, level, overlap)
      end if
   end subroutine find_in_hole

   !> The overlap of surfaces that are apart, from the direction of the least gap.
   pure subroutine take_ray(pair, pin, theta, level, overlap)
      type(surfaces_t), intent(in) :: pair       !! the surfaces
      type(pin_t), intent(in) :: pin             !! where the pin is
      real(wp), intent(in) :: theta              !! direction of the least gap [rad]
      integer, intent(in) :: level               !! what is found
      type(overlap_t), intent(inout) :: overlap  !! set

      type(ray_t) :: ray
      real(wp) :: turn

      call find_ray(pair, pin, theta, cell_at(pair, theta), level >= to_rates, level >= to_rates, ray)
      associate (across => [-ray%u(2), ray%u(1)])
         overlap%delta = ray%d
         overlap%gradient = ray%u + ray%w*across
         overlap%by_j = ray%by_j
         overlap%by_i = ray%by_i
         overlap%depth = ray%h_j
         if (level < to_rates) return
         turn = 0.0_wp  ! rate of theta
         if (ray%bend < -epsilon(1.0_wp)*pair%radius_i) turn = -ray%slope_dot/ray%bend
         overlap%rate = ray%d_dot
         overlap%second = ray%d_ddot + ray%slope_dot*turn
         overlap%gradient_rate = ray%w_dot*across + turn*((1.0_wp + ray%w_slope)*across - ray%w*ray%u)
         overlap%depth_rate = ray%h_j_by(2) + ray%h_j_by(1)*turn
      end associate
   end subroutine take_ray

   !> Cell of the hole in a direction.
   pure integer function cell_at(pair, theta) result(cell)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      real(wp), intent(in) :: theta          !! the direction [rad]

      cell = floor(theta/pair%worn%hole%width)
   end function cell_at

   !> Add what overlaps in the intervals of the hole from one direction to another: by Lobatto's six points where all of these
   !> overlap, looking closely where only some do.
   pure subroutine scan_overlap(pair, pin, from, to, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      real(wp), intent(in) :: from                   !! first direction [rad]
      real(wp), intent(in) :: to                     !! last direction, within a turn of the first [rad]
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(ray_t), intent(inout) :: deepest          !! the deepest ray where the surfaces were looked at closely
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(ray_t) :: left, right
      type(rays_t) :: rays
      real(wp) :: weights(most_places), width
      integer :: before, count, i, interval, k, last, n

      associate (hole => pair%worn%hole, points => pair%worn%hole%points)
         width = hole%width/hole%parts
         n = (size(points%h) - 1)/n_step
         interval = floor(from/width)
         last = min(ceiling(to/width), interval + n) - 1
         do while (interval <= last)
            before = modulo(interval, n)
            count = min((most_places - 1)/n_step, last + 1 - interval, n - before)
            associate (i => n_step*before + 1, j => n_step*(before + count) + 1)
               call find_rays(pair, pin, n_step*count + 1, points%theta(i:j), points%u(i:j, 1), points%u(i:j, 2), points%h(i:j), &
                              points%slope(i:j), points%bend(i:j), level >= to_rates, rays)
               weights(:rays%n) = 0.0_wp
               do k = 0, count - 1
                  associate (d => rays%d(n_step*k + 1:n_step*(k + 1) + 1), &
                             weight => weights(n_step*k + 1:n_step*(k + 1) + 1))
                     if (minval(d) > 0.0_wp) then
                        weight = weight + width*six_weights
                        if (present(arc)) call append_interval(rays, n_step*k, (interval + k)*width, width, arc)
                        cycle
                     end if
                  end associate
                  call take_edge(rays, n_step*k + 1, (interval + k)*width, left)
                  call take_edge(rays, n_step*(k + 1) + 1, (interval + k + 1)*width, right)
                  if (at_most(left, right) > 0.0_wp .or. maxval(rays%d(n_step*k + 1:n_step*(k + 1))) > 0.0_wp) then
                     call look_at(pair, pin, cell_of(interval + k, hole%parts), left, right, level, sums, deepest, arc)
                  end if
               end do
               call add_rays(rays, weights, points%u(i:j, 1), points%u(i:j, 2), level, sums)
            end associate
            interval = interval + count
         end do
      end associate
   end subroutine scan_overlap

   !> Find the deepest ray from one direction to another where the surfaces are apart.
   pure subroutine scan_gap(pair, pin, from, to, deepest)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      real(wp), intent(in) :: from                   !! first direction [rad]
      real(wp), intent(in) :: to                     !! last direction, within a turn of the first [rad]
      type(ray_t), intent(inout) :: deepest          !! the deepest so far

      type(ray_t) :: left, right
      type(rays_t) :: rays
      type(sums_t) :: none
      real(wp) :: width
      integer :: before, count, interval, k, last, n

      associate (hole => pair%worn%hole, points => pair%worn%hole%points)
         width = hole%width/hole%parts
         n = (size(points%h) - 1)/n_step
         interval = floor(from/width)
         last = min(ceiling(to/width), interval + n) - 1
         do while (interval <= last)
            before = modulo(interval, n)
            count = min(most_places - 1, last + 1 - interval, n - before)
            associate (i => n_step*before + 1, j => n_step*(before + count) + 1)
               call find_rays(pair, pin, count + 1, points%theta(i:j:n_step), points%u(i:j:n_step, 1), points%u(i:j:n_step, 2), &
                              points%h(i:j:n_step), points%slope(i:j:n_step), points%bend(i:j:n_step), .false., rays)
            end associate
            do k = 1, count
               call take_edge(rays, k, (interval + k - 1)*width, left)
               call take_edge(rays, k + 1, (interval + k)*width, right)
               if (at_most(left, right) <= deepest%d) cycle
               call look_at(pair, pin, cell_of(interval + k - 1, hole%parts), left, right, to_gradient, none, deepest)
            end do
            interval = interval + count
         end do
      end associate
   end subroutine scan_gap

   !> Append the points of an interval to an arc.
   pure subroutine append_interval(rays, before, start, width, arc)
      type(rays_t), intent(in) :: rays     !! the rays of some intervals
      integer, intent(in) :: before        !! those before the first one
      real(wp), intent(in) :: start        !! where the interval starts [rad]
      real(wp), intent(in) :: width        !! its width [rad]
      type(arc_t), intent(inout) :: arc    !! grown

      integer :: k

      do k = 1, n_six
         call append(arc, start + six_places(k)*width, rays%chi(before + k), rays%d(before + k), six_weights(k)*width)
      end do
   end subroutine append_interval

   !> Cell that has an interval.
   pure integer function cell_of(interval, parts) result(cell)
      integer, intent(in) :: interval   !! the interval, from 0, any turn
      integer, intent(in) :: parts      !! intervals of a cell

      cell = (interval - modulo(interval, parts))/parts
   end function cell_of

   !> The ray at the edge of an interval.
   pure subroutine take_edge(rays, k, theta, ray)
      type(rays_t), intent(in) :: rays     !! the rays of some intervals
      integer, intent(in) :: k             !! number of the ray
      real(wp), intent(in) :: theta        !! its direction [rad]
      type(ray_t), intent(inout) :: ray    !! theta, d and slope are set

      ray%theta = theta
      ray%d = rays%d(k)
      ray%slope = rays%slope(k)
   end subroutine take_edge

end module surface_overlap
