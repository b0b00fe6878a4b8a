!> What overlaps between two rays where that is not known to be all: in parts, in each of which an overlap begins at most once and
!> ends at most once, and d has at most one maximum or minimum.
!>
!> Integrals by Gauss's five points between the ends, found by `overlap_ends`.
module overlap_parts
   use gauss_points, only: five_places, five_weights, n_five
   use kinds, only: wp
   use overlap_ends, only: end_of, find_turn
   use overlap_rays, only: find_ray, pin_t, ray_t
   use overlap_sums, only: add_point, append, arc_t, sums_t, to_rates
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: at_most, look_at

   integer, parameter :: n_part = 4   !! parts of what lies between two edges

contains

   !> Overlap that is not exceeded between two rays.
   pure real(wp) function at_most(left, right) result(d)
      type(ray_t), intent(in) :: left    !! the first one
      type(ray_t), intent(in) :: right   !! the other

      d = max(left%d, right%d) + 0.5_wp*(right%theta - left%theta)*max(abs(left%slope), abs(right%slope))
   end function at_most

   !> Add what overlaps between two edges, part by part: an overlap may start and end there more than once.
   pure subroutine look_at(pair, pin, cell, left, right, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell                    !! cell of the hole
      type(ray_t), intent(in) :: left                !! the first ray
      type(ray_t), intent(in) :: right               !! the last ray
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(ray_t), intent(inout) :: deepest          !! the deepest so far
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(ray_t) :: end, start
      integer :: k

      start = left
      do k = 1, n_part
         end = right
         if (k < n_part) then
            call find_ray(pair, pin, start%theta + (right%theta - start%theta)/(n_part + 1 - k), cell, .false., .false., end)
         end if
         call look_between(pair, pin, cell, start, end, level, sums, deepest, arc)
         start = end
      end do
   end subroutine look_at

   !> Add what overlaps between two rays that no edge separates, and keep the deepest ray.
   pure subroutine look_between(pair, pin, cell, left, right, level, sums, deepest, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell                    !! cell of the hole
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

   !> Add a part of the overlap that no edge divides, by Gauss's five points.
   pure subroutine add_part(pair, pin, cell, start, end, level, sums, arc)
      type(surfaces_t), intent(in) :: pair           !! the surfaces
      type(pin_t), intent(in) :: pin                 !! where the pin is
      integer, intent(in) :: cell                    !! cell of the hole
      real(wp), intent(in) :: start, end             !! where it starts and ends [rad]
      integer, intent(in) :: level                   !! what is found
      type(sums_t), intent(inout) :: sums            !! added to
      type(arc_t), intent(inout), optional :: arc    !! appended to

      type(ray_t) :: ray
      real(wp) :: width
      integer :: g

      do g = 1, n_five
         call find_ray(pair, pin, start + (end - start)*five_places(g), cell, level >= to_rates, .false., ray)
         if (.not. ray%d > 0.0_wp) cycle  ! round-off at an end
         width = (end - start)*five_weights(g)
         call add_point(ray, width, level, sums)
         if (present(arc)) call append(arc, ray%theta, angle_on_pin(pair, pin, ray%theta), ray%d, width)
      end do
   end subroutine add_part

end module overlap_parts
