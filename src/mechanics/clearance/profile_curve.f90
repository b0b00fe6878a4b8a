!> A curve in the plane: the profile of a cam, or the centreline of a slot.
!>
!> q(u) with its derivatives by u, in the frame of the body from the point of the item:
!> line     q = u a, a unit axis
!> arc      q = r (cos u, sin u)
!> polar    q = r(u) (cos u, sin u), r an expression of the angle u
!> points   q = (x(u), y(u)), cubic splines through points over the length of the polygon, periodic where the curve is closed
!>
!> Curvature kappa = (q' x q'')/|q'|^3, positive where the curve turns to the left: where a closed one, which runs
!> counter-clockwise, is convex. A closed curve has its outside on the right.
!>
!> A slot about an open curve may end in a mouth of half width h: corners q_e +- h f, q_e the last end, f normal to the curve there.
!> A p beyond that end, or farther than h from the curve, has the nearer corner as its place. |p - q| of the wall, h less the
!> distance from the curve, goes over into that of the corner with its slope.
!>
!> The nearest place to p has (p - q) . q' = 0 (`find_nearest`), the one that is farthest against n has n . q' = 0
!> (`find_support`). Both are found without memory: nodes first, then Newton's iteration within a bracket, in each interval that
!> can hold the best place.
!>
!> Source: do Carmo, Differential geometry of curves and surfaces (1976), sections 1.3 to 1.5. Limits: a feature of the curve
!> smaller than the distance of two nodes, 1/512 of the curve, may be missed.
module profile_curve
   use curve, only: curve_t, curve_values
   use expression, only: expression_t
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: at_corner, curvature_at, find_nearest, find_support, foot_t, place_nodes, place_on, profile_arc, profile_line
   public :: profile_points, profile_polar, profile_t

   integer, parameter :: profile_line = 1     !! forms of a curve
   integer, parameter :: profile_arc = 2      !! the same
   integer, parameter :: profile_polar = 3    !! the same
   integer, parameter :: profile_points = 4   !! the same
   integer, parameter :: at_corner = 2        !! `end` of a place that is a corner of the mouth
   integer, parameter :: n_interval = 512    !! intervals between nodes
   integer, parameter :: most_steps = 80      !! of an iteration
   real(wp), parameter :: done = 2.0_wp*epsilon(1.0_wp)  !! step that ends it, of the range of u [1]

   !> A curve.
   type :: profile_t
      integer :: form = profile_arc              !! one of the above
      logical :: is_closed = .true.              !! it ends where it starts
      real(wp) :: range(2) = [0.0_wp, 2.0_wp*pi] !! (2) u at its start and end [any]
      real(wp) :: radius = 0.0_wp                !! r of an arc [m]
      real(wp) :: axis(2) = [1.0_wp, 0.0_wp]     !! (2) a of a line [1]
      real(wp) :: mouth = 0.0_wp                 !! h where its last end is open; 0: it is not [m]
      type(expression_t) :: polar                !! r(u) of a polar curve [m]
      type(curve_t) :: x                         !! x(u) through points [m]
      type(curve_t) :: y                         !! y(u) [m]
      real(wp), allocatable :: u(:)              !! (nodes) u of the nodes of a curve that is searched [any]
      real(wp), allocatable :: q(:, :)           !! (nodes, 2) where they are [m]
      real(wp), allocatable :: reach(:)          !! (nodes) how much nearer the curve may come beside a node [m]
   end type profile_t

   !> A place of a curve.
   type :: foot_t
      real(wp) :: u = 0.0_wp                     !! where on the curve [any]
      real(wp) :: q(2) = 0.0_wp                  !! (2) the place [m]
      real(wp) :: tangent(2) = [1.0_wp, 0.0_wp]  !! (2) unit tangent, towards greater u [1]
      real(wp) :: curvature = 0.0_wp             !! kappa [1/m]
      real(wp) :: pace = 1.0_wp                  !! |q'| [m/any]
      integer :: end = 0                         !! -1: the start of an open curve, 1: its end, p beyond; `at_corner`; else 0
   end type foot_t

contains

   !> A place and its derivatives.
   pure subroutine place_on(profile, u, q, d1, d2)
      type(profile_t), intent(in) :: profile  !! the curve
      real(wp), intent(in) :: u               !! where [any]
      real(wp), intent(out) :: q(2)           !! (2) q [m]
      real(wp), intent(out) :: d1(2)          !! (2) q' [m/any]
      real(wp), intent(out) :: d2(2)          !! (2) q'' [m/any^2]

      real(wp) :: across(2), along(2), f(3), r(3)

      select case (profile%form)
      case (profile_line)
         q = u*profile%axis
         d1 = profile%axis
         d2 = 0.0_wp
      case (profile_points)
         call curve_values(profile%x, u, f)
         q(1) = f(1)
         d1(1) = f(2)
         d2(1) = f(3)
         call curve_values(profile%y, u, f)
         q(2) = f(1)
         d1(2) = f(2)
         d2(2) = f(3)
      case default
         r = [profile%radius, 0.0_wp, 0.0_wp]
         if (profile%form == profile_polar) call profile%polar%evaluate(u, r(1), r(2), r(3))
         along = [cos(u), sin(u)]
         across = [-along(2), along(1)]
         q = r(1)*along
         d1 = r(2)*along + r(1)*across
         d2 = (r(3) - r(1))*along + 2.0_wp*r(2)*across
      end select
   end subroutine place_on

   !> Nodes of a curve that is searched: polar, or through points.
   pure subroutine place_nodes(profile)
      type(profile_t), intent(inout) :: profile  !! the curve; nodes are set

      real(wp) :: d1(2), d2(2), q(2)
      integer :: before, k, n, next

      n = n_interval + merge(0, 1, profile%is_closed)
      allocate (profile%u(n), profile%q(n, 2), profile%reach(n))
      do k = 1, n
         profile%u(k) = profile%range(1) + (profile%range(2) - profile%range(1))*real(k - 1, wp)/real(n_interval, wp)
         call place_on(profile, profile%u(k), q, d1, d2)
         profile%q(k, :) = q
      end do
      do k = 1, n
         call neighbours(profile, k, before, next)
         profile%reach(k) = max(norm2(profile%q(k, :) - profile%q(before, :)), norm2(profile%q(next, :) - profile%q(k, :)))
      end do
   end subroutine place_nodes

   !> Nodes beside a node; of the ends of an open curve, these themselves.
   pure subroutine neighbours(profile, k, before, next)
      type(profile_t), intent(in) :: profile  !! the curve
      integer, intent(in) :: k                !! the node
      integer, intent(out) :: before          !! that before it
      integer, intent(out) :: next            !! that after it

      associate (n => size(profile%u))
         before = k - 1
         next = k + 1
         if (before == 0) before = merge(n, 1, profile%is_closed)
         if (next > n) next = merge(1, n, profile%is_closed)
      end associate
   end subroutine neighbours

   !> The place of a curve that is nearest to a point.
   pure subroutine find_nearest(profile, p, foot)
      type(profile_t), intent(in) :: profile  !! the curve
      real(wp), intent(in) :: p(2)            !! (2) the point, in the frame of the curve [m]
      type(foot_t), intent(out) :: foot       !! the place

      real(wp) :: u

      select case (profile%form)
      case (profile_line)
         u = dot_product(profile%axis, p)
         call take_foot(profile, min(max(u, profile%range(1)), profile%range(2)), foot)
         if (u < profile%range(1)) foot%end = -1
         if (u > profile%range(2)) foot%end = 1
      case (profile_arc)
         u = profile%range(1) + modulo(atan2(p(2), p(1)) - profile%range(1), 2.0_wp*pi)
         if (profile%is_closed .or. u <= profile%range(2)) then
            call take_foot(profile, u, foot)
         else  ! beyond the end that is less far, around the circle
            foot%end = merge(1, -1, u - profile%range(2) < profile%range(1) + 2.0_wp*pi - u)
            call take_foot(profile, merge(profile%range(2), profile%range(1), foot%end == 1), foot)
         end if
      case default
         call search(profile, .false., p, foot)
      end select
      if (.not. profile%mouth > 0.0_wp) return
      if (foot%end == 1 .or. norm2(p - foot%q) > profile%mouth) call take_corner(profile, p, foot)
   end subroutine find_nearest

   !> The nearer corner of the mouth; tangent and curvature are those of the last end.
   pure subroutine take_corner(profile, p, foot)
      type(profile_t), intent(in) :: profile  !! the curve
      real(wp), intent(in) :: p(2)            !! (2) the point, in the frame of the curve [m]
      type(foot_t), intent(inout) :: foot     !! the place

      real(wp) :: across(2)

      call take_foot(profile, profile%range(2), foot)
      across = [-foot%tangent(2), foot%tangent(1)]
      foot%q = foot%q + sign(profile%mouth, dot_product(across, p - foot%q))*across
      foot%end = at_corner
   end subroutine take_corner

   !> The place of a closed curve that is farthest against a direction.
   pure subroutine find_support(profile, n, foot)
      type(profile_t), intent(in) :: profile  !! the curve
      real(wp), intent(in) :: n(2)            !! (2) the direction, in the frame of the curve [1]
      type(foot_t), intent(out) :: foot       !! the place

      if (profile%form == profile_arc) then
         call take_foot(profile, atan2(-n(2), -n(1)), foot)
      else
         call search(profile, .true., n, foot)
      end if
   end subroutine find_support

   !> Search all intervals whose nodes say that they may hold the best place. With v = p the distance to it is minimised, with v = n
   !> the height along it.
   pure subroutine search(profile, is_support, v, foot)
      type(profile_t), intent(in) :: profile  !! the curve, with nodes
      logical, intent(in) :: is_support       !! heights, not distances
      real(wp), intent(in) :: v(2)            !! (2) p or n, in the frame of the curve [m or 1]
      type(foot_t), intent(out) :: foot       !! the place

      real(wp) :: best, height(size(profile%u)), least, u, value
      integer :: before, k, next
      type(foot_t) :: found

      if (is_support) then
         height = v(1)*profile%q(:, 1) + v(2)*profile%q(:, 2)
      else
         height = sqrt((profile%q(:, 1) - v(1))**2 + (profile%q(:, 2) - v(2))**2)
      end if
      least = minval(height)
      best = huge(1.0_wp)
      do k = 1, size(profile%u)
         if (height(k) - profile%reach(k) > least) cycle
         call neighbours(profile, k, before, next)
         if (height(k) > height(before) .or. height(k) > height(next)) cycle
         found%end = 0
         call refine(profile, is_support, v, k, u, found%end)
         call take_foot(profile, u, found)
         if (is_support) then
            value = dot_product(v, found%q)
         else
            value = norm2(v - found%q)
         end if
         if (.not. value < best) cycle
         best = value
         foot = found
      end do
   end subroutine search

   !> Newton's iteration within the intervals beside a node, bisection where it would leave them.
   pure subroutine refine(profile, is_support, v, k, u, end)
      type(profile_t), intent(in) :: profile  !! the curve
      logical, intent(in) :: is_support       !! heights, not distances
      real(wp), intent(in) :: v(2)            !! (2) p or n [m or 1]
      integer, intent(in) :: k                !! the node
      real(wp), intent(out) :: u              !! the place [any]
      integer, intent(inout) :: end           !! set where the best place is an end of an open curve

      real(wp) :: d1(2), d2(2), high, low, q(2), range, slope, step, bend
      integer :: attempt

      range = profile%range(2) - profile%range(1)
      u = profile%u(k)
      low = u - range/real(n_interval, wp)
      high = u + range/real(n_interval, wp)
      do attempt = 1, most_steps
         call place_on(profile, u, q, d1, d2)
         if (is_support) then
            slope = dot_product(v, d1)
            bend = dot_product(v, d2)
         else
            slope = -dot_product(v - q, d1)
            bend = dot_product(d1, d1) - dot_product(v - q, d2)
         end if
         if (attempt == 1 .and. .not. profile%is_closed) then
            if (k == 1 .and. slope >= 0.0_wp) end = -1
            if (k == size(profile%u) .and. slope <= 0.0_wp) end = 1
            if (end /= 0) return
         end if
         if (slope > 0.0_wp) high = u
         if (slope < 0.0_wp) low = u
         if (.not. abs(slope) > 0.0_wp) return
         step = 0.5_wp*(low + high) - u
         if (bend > 0.0_wp) then
            if (u - slope/bend >= low .and. u - slope/bend <= high) step = -slope/bend
         end if
         u = u + step
         if (abs(step) <= done*range) return
      end do
   end subroutine refine

   !> Place, tangent and curvature where u is; `end` is left alone.
   pure subroutine take_foot(profile, u, foot)
      type(profile_t), intent(in) :: profile  !! the curve
      real(wp), intent(in) :: u               !! where [any]
      type(foot_t), intent(inout) :: foot     !! the place

      real(wp) :: d1(2), d2(2)

      call place_on(profile, u, foot%q, d1, d2)
      foot%u = u
      foot%pace = norm2(d1)
      foot%tangent = d1/foot%pace
      foot%curvature = (d1(1)*d2(2) - d1(2)*d2(1))/foot%pace**3
      if (profile%form == profile_arc) foot%curvature = 1.0_wp/profile%radius
   end subroutine take_foot

   !> Curvature at a place.
   pure real(wp) function curvature_at(profile, u) result(curvature)
      type(profile_t), intent(in) :: profile  !! the curve
      real(wp), intent(in) :: u               !! where [any]

      type(foot_t) :: foot

      call take_foot(profile, u, foot)
      curvature = foot%curvature
   end function curvature_at

end module profile_curve
