!> How deep a worn pin is in a worn hole: a penetration by the energy of a foundation, and its derivatives.
!>
!> A worn arc has no deepest point. The second moment of the overlap d(theta) of `overlap_rays` is, but for a factor, the energy of a
!> foundation of springs along the surface; the penetration is that of round surfaces with the same moment:
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
!> The integrals are by Gauss's rule between the ends of the overlap and the edges of cells, so that nothing happens where an arc
!> passes one. Signs: delta > 0 in contact. Source: this program. Limits: those of `overlap_rays`; between two edges an
!> overlap begins at most once and ends at most once, and d has at most one maximum or minimum.
module surface_overlap
   use gauss_points, only: gauss_places, gauss_weights, n_gauss
   use kinds, only: pi, wp
   use overlap_rays, only: find_ray, pin_t, quick_ray, ray_t
   use round_moment, only: penetration_of_moment
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: arc_t, find_overlap, overlap_t, to_second, to_gradient, to_rates

   integer, parameter :: to_gradient = 0   !! penetration and its gradient
   integer, parameter :: to_rates = 1      !! and how both change with time
   integer, parameter :: to_second = 2     !! and the second derivative of the penetration by time

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

   !> Integrals over the overlap.
   type :: sums_t
      real(wp) :: m = 0.0_wp             !! of d^2
      real(wp) :: e(2) = 0.0_wp          !! (2) its derivative by e
      real(wp) :: i = 0.0_wp             !! by the angle of the hole's body
      real(wp) :: j = 0.0_wp             !! by that of the pin's
      real(wp) :: d = 0.0_wp             !! of 2 d
      real(wp) :: h = 0.0_wp             !! of 2 d h_j
      real(wp) :: m_dot = 0.0_wp         !! rate of m
      real(wp) :: m_ddot = 0.0_wp        !! second derivative of m by time
      real(wp) :: e_dot(2) = 0.0_wp      !! (2) rate of e
      real(wp) :: d_dot = 0.0_wp         !! rate of d
      real(wp) :: h_dot = 0.0_wp         !! rate of h
   end type sums_t

   real(wp), parameter :: longest = 0.05_wp       !! part of an arc that these points are right for [rad]
   integer, parameter :: n_part = 4               !! parts of what lies between two edges, where it is looked at closely
   integer, parameter :: most_iterations = 60     !! of a search between two edges, halvings among them

contains

   !> Penetration and what follows of it: found in the axes of the hole's body, where its cells stand still.
   pure subroutine find_overlap(pair, pin, level, overlap, arc)
      type(surfaces_t), intent(in) :: pair            !! the surfaces, with profiles
      type(pin_t), intent(in) :: pin                  !! where the pin is, world frame
      integer, intent(in) :: level                    !! one of the above
      type(overlap_t), intent(out) :: overlap         !! set
      type(arc_t), intent(inout), optional :: arc     !! points of the arc

      type(pin_t) :: here
      real(wp) :: turn(2, 2)

      turn = reshape([cos(pin%angle(1)), -sin(pin%angle(1)), sin(pin%angle(1)), cos(pin%angle(1))], [2, 2])
      here = pin
      here%e = matmul(turn, pin%e)
      here%e_dot = matmul(turn, pin%e_dot)
      here%e_ddot = matmul(turn, pin%e_ddot)
      here%angle = pin%angle - pin%angle(1)
      here%phi = pin%phi - pin%angle(1)
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

      if (present(arc)) arc%n = 0
      if (pin%distance > pair%clearance) then  ! else there is none: no surface has grown
         part = acos(pair%clearance/pin%distance)
         call scan(pair, pin, pin%phi - part, pin%phi + part, level, sums, deepest, arc)
      end if
      if (sums%m > 0.0_wp) then
         call penetration_of_moment(pair, sums%m, overlap%delta, kappa, kappa_slope)
         overlap%gradient = sums%e/kappa
         overlap%by_i = sums%i/kappa
         overlap%by_j = sums%j/kappa
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
         overlap%by_i = ray%by_i
         overlap%by_j = ray%by_j
         overlap%depth = ray%h_j
         if (level < to_rates) return
         turn = 0.0_wp  ! rate of theta
         if (ray%bend < -epsilon(1.0_wp)*pair%radius_i) turn = -ray%slope_dot/ray%bend
         overlap%rate = ray%d_dot
         overlap%second = ray%d_ddot + ray%slope_dot*turn
         overlap%gradient_rate = ray%w_dot*across + turn*((1.0_wp + ray%w_slope)*across - ray%w*ray%u)
         overlap%depth_rate = ray%h_j_dot + ray%h_j_slope*turn
      end associate
   end subroutine take_ray

   !> Cells of hole and pin in a direction.
   pure function cells_at(pair, pin, theta) result(cell)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: theta          !! the direction [rad]
      integer :: cell(2)                     !! (2) their numbers, from 0, any turn

      real(wp) :: q

      cell = 0
      if (.not. pair%worn%hole%is_round()) cell(1) = floor((theta - pin%angle(1))/pair%worn%hole%width)
      if (pair%worn%pin%is_round()) return
      q = pin%e(2)*cos(theta) - pin%e(1)*sin(theta)
      cell(2) = floor((theta - asin(q/pair%radius_j) - pin%angle(2))/pair%worn%pin%width)
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

      type(ray_t) :: end, left, right, start
      real(wp) :: at_most, edge, middle
      integer :: cell(2), k, passed
      logical :: is_quick, is_start, is_whole

      is_quick = pair%worn%pin%is_round() .and. level == to_gradient .and. .not. present(arc)
      is_start = .false.  ! of a cell
      cell = cells_at(pair, pin, from)
      call find_ray(pair, pin, from, cell, .false., .false., left)
      do while (left%theta < to)
         call next_edge(pair, pin, left%theta, cell, edge, passed)
         if (edge > to) then
            edge = to
            passed = 0
         end if
         is_whole = passed == 1 .and. is_start .and. is_quick
         is_start = passed == 1
         if (is_quick .and. passed == 1) then
            call quick_ray(pair, pin, pair%worn%hole%starts(modulo(cell(1) + 1, size(pair%worn%hole%starts)) + 1), right)
            right%theta = edge
         else
            call find_ray(pair, pin, edge, cell, .false., .false., right)
         end if
         at_most = max(left%d, right%d) + 0.5_wp*(edge - left%theta)*max(abs(left%slope), abs(right%slope))
         if (max(left%d, right%d) <= 0.0_wp .and. at_most > min(deepest%d, 0.0_wp)) then
            start = left
            do k = 1, n_part  ! a cell may have more than one maximum
               end = right
               middle = start%theta + (edge - start%theta)/(n_part + 1 - k)
               if (k < n_part) call find_ray(pair, pin, middle, cell, .false., .false., end)
               call look_between(pair, pin, cell, start, end, level, sums, deepest, arc)
               start = end
            end do
         else if (is_whole .and. min(left%d, right%d) > 0.0_wp .and. (left%slope >= 0.0_wp .or. right%slope <= 0.0_wp)) then
            call add_cell(pair, pin, modulo(cell(1), size(pair%worn%hole%starts)) + 1, sums)
         else
            call look_between(pair, pin, cell, left, right, level, sums, deepest, arc)
         end if
         left = right
         if (passed > 0) cell(passed) = cell(passed) + 1
      end do
   end subroutine scan

   !> Add what overlaps between two rays in one cell of each surface, and keep the deepest ray.
   pure subroutine look_between(pair, pin, cell, left, right, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell(2)                 !! cells of hole and pin
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

   !> The next edge of a cell in the order of directions.
   pure subroutine next_edge(pair, pin, theta, cell, edge, passed)
      type(surfaces_t), intent(in) :: pair   !! the surfaces
      type(pin_t), intent(in) :: pin         !! where the pin is
      real(wp), intent(in) :: theta          !! where it is looked for from [rad]
      integer, intent(in) :: cell(2)         !! cells there
      real(wp), intent(out) :: edge          !! its direction [rad]
      integer, intent(out) :: passed         !! which surface has it: 1 hole, 2 pin, 0: none

      real(wp) :: other, psi

      edge = huge(1.0_wp)
      passed = 0
      if (.not. pair%worn%hole%is_round()) then
         edge = pin%angle(1) + (cell(1) + 1)*pair%worn%hole%width
         passed = 1
      end if
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

   !> Where d is zero between a ray that overlaps and one that does not, by Newton's method, halving where that leaves the bracket.
   pure real(wp) function end_of(pair, pin, cell, inside, outside) result(theta)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      type(pin_t), intent(in) :: pin           !! where the pin is
      integer, intent(in) :: cell(2)           !! cells they are in
      type(ray_t), intent(in) :: inside        !! the ray with d > 0
      type(ray_t), intent(in) :: outside       !! the other

      real(wp), parameter :: close = 1.0e-13_wp   ! of the bracket [1]
      type(ray_t) :: ray
      real(wp) :: bad, good, step
      integer :: k

      good = inside%theta
      bad = outside%theta
      theta = good + (bad - good)*(inside%d/(inside%d - outside%d))
      do k = 1, most_iterations
         call find_ray(pair, pin, theta, cell, .false., .false., ray)
         if (ray%d > 0.0_wp) then
            good = theta
         else
            bad = theta
         end if
         step = 0.0_wp
         if (abs(ray%slope) > 0.0_wp) step = -ray%d/ray%slope
         if (abs(step) <= close*abs(bad - inside%theta)) exit
         theta = theta + step
         if ((theta - good)*(theta - bad) >= 0.0_wp) theta = 0.5_wp*(good + bad)
         if (abs(bad - good) <= close*abs(bad - inside%theta)) exit
      end do
   end function end_of

   !> Where d has a maximum or minimum between two rays, by Newton's method, halving where that leaves the bracket.
   pure subroutine find_turn(pair, pin, cell, left, right, ray)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      type(pin_t), intent(in) :: pin           !! where the pin is
      integer, intent(in) :: cell(2)           !! cells they are in
      type(ray_t), intent(in) :: left          !! slopes of both have different signs
      type(ray_t), intent(in) :: right         !! see left
      type(ray_t), intent(out) :: ray          !! the turn

      real(wp), parameter :: close = 1.0e-14_wp   ! [rad]
      real(wp) :: ends(2), step, theta
      integer :: k

      ends = [left%theta, right%theta]
      theta = ends(1) + (ends(2) - ends(1))*(left%slope/(left%slope - right%slope))
      do k = 1, most_iterations
         call find_ray(pair, pin, theta, cell, .false., .true., ray)
         if ((ray%slope > 0.0_wp) .eqv. (left%slope > 0.0_wp)) then
            ends(1) = theta
         else
            ends(2) = theta
         end if
         step = 0.0_wp
         if (abs(ray%bend) > 0.0_wp) step = -ray%slope/ray%bend
         if (abs(step) <= close .or. ends(2) - ends(1) <= close) exit
         theta = theta + step
         if (theta <= ends(1) .or. theta >= ends(2)) theta = 0.5_wp*(ends(1) + ends(2))
      end do
   end subroutine find_turn

   !> Add a part of the overlap that lies in one cell of each surface.
   pure subroutine add_part(pair, pin, cell, start, end, level, sums, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell(2)                 !! cells of hole and pin
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
         do g = 1, n_gauss
            call find_ray(pair, pin, start + part*(k + gauss_places(g)), cell, level >= to_rates, .false., ray)
            if (.not. ray%d > 0.0_wp) cycle  ! round-off at an end
            width = part*gauss_weights(g)
            call add_point(ray, width, level, sums)
            if (present(arc)) call append(arc, ray%theta - pin%angle(1), pin_angle(ray), ray%d, width)
         end do
      end do

   contains

      !> Angle on the pin, which a ray knows where the pin is worn.
      pure real(wp) function pin_angle(ray) result(angle)
         type(ray_t), intent(in) :: ray   !! the ray

         angle = ray%theta - asin((pin%e(2)*ray%u(1) - pin%e(1)*ray%u(2))/pair%radius_j) - pin%angle(2)
      end function pin_angle

   end subroutine add_part

   !> Add a cell of the hole that overlaps a round pin all along.
   pure subroutine add_cell(pair, pin, cell, sums)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      type(pin_t), intent(in) :: pin           !! where the pin is, frame of the hole
      integer, intent(in) :: cell              !! number of the cell, from 1
      type(sums_t), intent(inout) :: sums      !! added to

      type(ray_t) :: ray
      real(wp) :: two_d
      integer :: g

      do g = 1, n_gauss
         call quick_ray(pair, pin, pair%worn%hole%points(g, cell), ray)
         two_d = 2.0_wp*pair%worn%hole%width*gauss_weights(g)*ray%d
         sums%m = sums%m + 0.5_wp*two_d*ray%d
         sums%e(1) = sums%e(1) + two_d*(ray%u(1) - ray%w*ray%u(2))
         sums%e(2) = sums%e(2) + two_d*(ray%u(2) + ray%w*ray%u(1))
         sums%i = sums%i + two_d*ray%by_i
         sums%d = sums%d + two_d
      end do
   end subroutine add_cell

   !> Add a point to the integrals.
   pure subroutine add_point(ray, width, level, sums)
      type(ray_t), intent(in) :: ray         !! the ray
      real(wp), intent(in) :: width          !! its weight [rad]
      integer, intent(in) :: level           !! what is found
      type(sums_t), intent(inout) :: sums    !! added to

      real(wp) :: d_e(2), two_d

      two_d = 2.0_wp*width*ray%d
      d_e(1) = ray%u(1) - ray%w*ray%u(2)
      d_e(2) = ray%u(2) + ray%w*ray%u(1)
      sums%m = sums%m + width*ray%d**2
      sums%e = sums%e + two_d*d_e
      sums%i = sums%i + two_d*ray%by_i
      sums%j = sums%j + two_d*ray%by_j
      sums%d = sums%d + two_d
      sums%h = sums%h + two_d*ray%h_j
      if (level < to_rates) return
      associate (two_rate => 2.0_wp*width*ray%d_dot)
         sums%m_dot = sums%m_dot + two_d*ray%d_dot
         sums%e_dot = sums%e_dot + two_rate*d_e + two_d*ray%w_dot*[-ray%u(2), ray%u(1)]
         sums%d_dot = sums%d_dot + two_rate
         sums%h_dot = sums%h_dot + two_rate*ray%h_j + two_d*ray%h_j_dot
         sums%m_ddot = sums%m_ddot + two_rate*ray%d_dot + two_d*ray%d_ddot
      end associate
   end subroutine add_point

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
