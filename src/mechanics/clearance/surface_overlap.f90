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
!> The integrals are by Gauss's rule between the ends of the overlap and the edges of cells, so that nothing happens where
!> an arc passes one; by the angle of the hole's body delta has the derivative that makes a common rotation change nothing.
!> Signs: delta > 0 in contact. Source: this program. Limits: those of `overlap_rays`; between two edges an overlap begins at most
!> once and ends at most once, and d has at most one maximum or minimum.
module surface_overlap
   use gauss_points, only: five_places, five_weights, n_five
   use kinds, only: pi, wp
   use overlap_ends, only: end_of, find_turn
   use overlap_rays, only: find_ray, pin_t, ray_t
   use overlap_sums, only: add_cells, add_point, edges_t, sums_t, take_edge, to_gradient, to_rates, to_second
   use round_moment, only: penetration_of_moment
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: arc_t, find_overlap, overlap_t, to_second, to_gradient, to_rates

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

   !> Where surfaces overlap: points with their part of the overlap.
   type :: arc_t
      integer :: n = 0                          !! points
      real(wp), allocatable :: hole(:)          !! (n or more) their angles, frame of the hole's body [rad]
      real(wp), allocatable :: pin(:)           !! (n or more) the same of the pin's body [rad]
      real(wp), allocatable :: d(:)             !! (n or more) overlap there [m]
      real(wp), allocatable :: width(:)         !! (n or more) angle that each stands for [rad]
   end type arc_t

   real(wp), parameter :: longest = 0.05_wp       !! part of an arc that Gauss's five points are right for [rad]
   real(wp), parameter :: farthest = 0.9_wp       !! part of the pin's radius up to which the centres are apart [1]
   integer, parameter :: n_part = 4               !! parts of what lies between two edges, where it is looked at closely

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
         call scan(pair, pin, pin%phi - part, pin%phi + part, level, sums, deepest, arc)
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
         call find_ray(pair, pin, pin%phi, cells_at(pair, pin, pin%phi), .false., .false., ray)
         part = pi
         if (ray%d + pair%clearance > -pin%distance) part = acos(min((ray%d + pair%clearance)/pin%distance, 1.0_wp))
         deepest = ray
         call scan(pair, pin, pin%phi - part, pin%phi + part, level, sums, deepest)
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

      call find_ray(pair, pin, theta, cells_at(pair, pin, theta), level >= to_rates, level >= to_rates, ray)
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

   !> Cells of hole and pin in a direction.
   pure function cells_at(pair, pin, theta) result(cell)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: theta          !! the direction [rad]
      integer :: cell(2)                     !! (2) their numbers, from 0, any turn

      cell = 0
      cell(1) = floor(theta/pair%worn%hole%width)
      if (.not. pair%worn%pin%is_round()) cell(2) = floor(angle_on_pin(pair, pin, theta)/pair%worn%pin%width)
   end function cells_at

   !> Go through the rays from one direction to another, edge by edge: add what overlaps, and keep the ray that is deepest.
   pure subroutine scan(pair, pin, from, to, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      real(wp), intent(in) :: from                   !! first direction [rad]
      real(wp), intent(in) :: to                     !! last direction [rad]
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(ray_t), intent(inout) :: deepest          !! of the rays at edges, and where d has a maximum between them
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(edges_t) :: edges
      type(ray_t) :: left, right
      real(wp) :: at_most, edge
      integer :: cell(2), last, passed, whole
      logical :: is_quick

      is_quick = pair%worn%pin%is_round() .and. level == to_gradient .and. .not. present(arc)
      cell = cells_at(pair, pin, from)
      last = floor(to/pair%worn%hole%width)
      whole = 0  ! cells before this one that overlap all along, not added yet
      call find_ray(pair, pin, from, cell, .false., .false., left)
      do while (left%theta < to)
         call next_edge(pair, pin, left%theta, cell, edge, passed)
         edge = min(edge, to)
         if (is_quick .and. cell(1) < last) then
            call take_edge(pair, pin, cell(1) + 1, last, edges, right)
         else
            call find_ray(pair, pin, edge, cell, .false., .false., right)
         end if
         at_most = max(left%d, right%d) + 0.5_wp*(edge - left%theta)*max(abs(left%slope), abs(right%slope))
         if (is_quick .and. min(left%d, right%d) > 0.0_wp .and. (left%slope >= 0.0_wp .or. right%slope <= 0.0_wp) .and. &
             left%theta >= cell(1)*pair%worn%hole%width .and. cell(1) < last) then
            whole = whole + 1
         else
            call add_cells(pair, pin, cell(1) - whole, whole, sums)
            whole = 0
            call look_at(pair, pin, cell, left, right, at_most, level, sums, deepest, arc)
         end if
         left = right
         cell(passed) = cell(passed) + 1
      end do
      call add_cells(pair, pin, cell(1) - whole, whole, sums)
   end subroutine scan

   !> The next edge of a cell in the order of directions.
   pure subroutine next_edge(pair, pin, theta, cell, edge, passed)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: theta          !! where it is looked for from [rad]
      integer, intent(in) :: cell(2)         !! (2) cells there
      real(wp), intent(out) :: edge          !! its direction [rad]
      integer, intent(out) :: passed         !! which surface has it: 1 hole, 2 pin

      real(wp) :: other, psi

      passed = 1
      edge = (cell(1) + 1)*pair%worn%hole%width
      if (.not. pair%worn%pin%is_round()) then
         psi = pin%angle(2) + (cell(2) + 1)*pair%worn%pin%width
         other = psi - atan2(pin%distance*sin(psi - pin%phi), pair%radius_j + pin%distance*cos(psi - pin%phi))
         if (other < edge) then
            edge = other
            passed = 2
         end if
      end if
      edge = max(edge, theta)  ! round-off
   end subroutine next_edge

   !> Add what overlaps in a cell: in parts, where the overlap starts or ends in it, for there may be more than one.
   pure subroutine look_at(pair, pin, cell, left, right, at_most, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell(2)                 !! (2) cells of hole and pin
      type(ray_t), intent(in) :: left                !! its first ray
      type(ray_t), intent(in) :: right               !! its last ray
      real(wp), intent(in) :: at_most                !! overlap that it does not exceed [m]
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(ray_t), intent(inout) :: deepest          !! the deepest so far
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(ray_t) :: end, start
      real(wp) :: middle
      integer :: k

      if (min(left%d, right%d) > 0.0_wp .or. at_most <= min(deepest%d, 0.0_wp)) then
         call look_between(pair, pin, cell, left, right, level, sums, deepest, arc)
         return
      end if
      start = left
      do k = 1, n_part
         end = right
         middle = start%theta + (right%theta - start%theta)/(n_part + 1 - k)
         if (k < n_part) call find_ray(pair, pin, middle, cell, .false., .false., end)
         call look_between(pair, pin, cell, start, end, level, sums, deepest, arc)
         start = end
      end do
   end subroutine look_at

   !> Add what overlaps between two rays in one cell, and keep the deepest ray.
   pure subroutine look_between(pair, pin, cell, left, right, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell(2)                 !! (2) cells of hole and pin
      type(ray_t), intent(in) :: left                !! the first ray
      type(ray_t), intent(in) :: right               !! the last ray
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(ray_t), intent(inout) :: deepest          !! the deepest so far
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(ray_t) :: turning

      if (left%d > 0.0_wp .and. right%d > 0.0_wp) then
         if (left%slope < 0.0_wp .and. right%slope > 0.0_wp) then
            call find_turn(pair, pin, cell, left, right, turning)
            if (turning%d < 0.0_wp) then
               call add_part(pair, pin, cell, left%theta, end_of(pair, pin, cell, left, turning), level, sums, arc)
               call add_part(pair, pin, cell, end_of(pair, pin, cell, right, turning), right%theta, level, sums, arc)
            else
               call add_part(pair, pin, cell, left%theta, right%theta, level, sums, arc)
            end if
         else
            call add_part(pair, pin, cell, left%theta, right%theta, level, sums, arc)
         end if
      else if (left%d > 0.0_wp) then
         call add_part(pair, pin, cell, left%theta, end_of(pair, pin, cell, left, right), level, sums, arc)
      else if (right%d > 0.0_wp) then
         call add_part(pair, pin, cell, end_of(pair, pin, cell, right, left), right%theta, level, sums, arc)
      else if (left%slope > 0.0_wp .and. right%slope < 0.0_wp) then
         call find_turn(pair, pin, cell, left, right, turning)
         if (turning%d > deepest%d) deepest = turning
         if (turning%d > 0.0_wp) then
            call add_part(pair, pin, cell, end_of(pair, pin, cell, turning, left), &
                          end_of(pair, pin, cell, turning, right), level, sums, arc)
         end if
      end if
      if (right%d > deepest%d) deepest = right
   end subroutine look_between

   !> Where a ray leaves the pin, frame of the pin's body.
   pure real(wp) function angle_on_pin(pair, pin, theta) result(angle)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: theta          !! direction of the ray [rad]

      real(wp) :: x

      x = (pin%e(2)*cos(theta) - pin%e(1)*sin(theta))/pair%radius_j
      angle = theta - x - x**3/6.0_wp - pin%angle(2)
   end function angle_on_pin

   !> Add a part of the overlap that lies in one cell.
   pure subroutine add_part(pair, pin, cell, start, end, level, sums, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell(2)                 !! (2) cells of hole and pin
      real(wp), intent(in) :: start, end             !! where it starts and ends [rad]
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(ray_t) :: ray
      real(wp) :: part, width
      integer :: g, k, n

      n = max(ceiling((end - start)/longest), 1)
      part = (end - start)/n
      do k = 0, n - 1
         do g = 1, n_five
            call find_ray(pair, pin, start + part*(k + five_places(g)), cell, level >= to_rates, .false., ray)
            if (.not. ray%d > 0.0_wp) cycle  ! round-off at an end
            width = part*five_weights(g)
            call add_point(ray, width, level, sums)
            if (present(arc)) call append(arc, ray%theta, angle_on_pin(pair, pin, ray%theta), ray%d, width)
         end do
      end do
   end subroutine add_part

   !> Append a point to an arc.
   pure subroutine append(arc, hole, pin, d, width)
      type(arc_t), intent(inout) :: arc   !! grown
      real(wp), intent(in) :: hole        !! angle on the hole [rad]
      real(wp), intent(in) :: pin         !! angle on the pin [rad]
      real(wp), intent(in) :: d           !! overlap [m]
      real(wp), intent(in) :: width       !! angle it stands for [rad]

      integer, parameter :: first = 64

      if (.not. allocated(arc%d)) allocate (arc%hole(first), arc%pin(first), arc%d(first), arc%width(first))
      if (arc%n == size(arc%d)) then
         arc%hole = [arc%hole, arc%hole]
         arc%pin = [arc%pin, arc%pin]
         arc%d = [arc%d, arc%d]
         arc%width = [arc%width, arc%width]
      end if
      arc%n = arc%n + 1
      arc%hole(arc%n) = hole
      arc%pin(arc%n) = pin
      arc%d(arc%n) = d
      arc%width(arc%n) = width
   end subroutine append

end module surface_overlap
