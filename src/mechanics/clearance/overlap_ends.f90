!> Where an overlap of worn surfaces ends between two rays in one cell, and where it is largest or least.
!>
!> Roots of d and of its derivative by theta (`overlap_rays`), by Newton's method, halving the bracket where that leaves it.
!> Limits: between the rays there is one root.
module overlap_ends
   use kinds, only: wp
   use overlap_rays, only: find_ray, pin_t, ray_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: end_of, find_turn

   integer, parameter :: most_iterations = 60     !! of a search between two edges, halvings among them

contains

   !> Where d is zero between a ray that overlaps and one that does not, by Newton's method, halving where that leaves the bracket.
   pure real(wp) function end_of(pair, pin, cell, inside, outside) result(theta)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      type(pin_t), intent(in) :: pin           !! where the pin is
      integer, intent(in) :: cell              !! cell of the hole they are in
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
      integer, intent(in) :: cell              !! cell of the hole they are in
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

end module overlap_ends
