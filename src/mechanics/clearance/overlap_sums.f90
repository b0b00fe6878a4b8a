!> Integrals over the overlap of worn surfaces: of one ray with its weight, and of many cells at once where the pin is round.
!>
!> M = int d^2 dtheta and its derivatives, see `surface_overlap`; rays are those of `overlap_rays`.
module overlap_sums
   use gauss_points, only: five_weights, n_five
   use kinds, only: wp
   use overlap_rays, only: pin_t, quick_rays, ray_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: add_cells, add_point, edges_t, sums_t, take_edge, to_gradient, to_rates, to_second

   integer, parameter :: to_gradient = 0   !! penetration and its gradient
   integer, parameter :: to_rates = 1      !! and how both change with time
   integer, parameter :: to_second = 2     !! and the second derivative of the penetration by time

   integer, parameter :: most_at_once = 32        !! cells

   !> Rays at the starts of some cells.
   type :: edges_t
      integer :: first = 0                              !! the first cell
      integer :: next = -huge(1)                        !! the cell behind the last one
      real(wp) :: d(most_at_once) = 0.0_wp              !! (32) overlap [m]
      real(wp) :: slope(most_at_once) = 0.0_wp          !! (32) its derivative by theta [m/rad]
      real(wp) :: w(most_at_once) = 0.0_wp              !! (32) see `overlap_rays` [1]
   end type edges_t

   !> Integrals over the overlap.
   type :: sums_t
      real(wp) :: m = 0.0_wp             !! of d^2 [m^2.rad]
      real(wp) :: e(2) = 0.0_wp          !! (2) its derivative by e [m.rad]
      real(wp) :: j = 0.0_wp             !! by the angle of the pin's body [m^2]
      real(wp) :: d = 0.0_wp             !! of 2 d [m.rad]
      real(wp) :: h = 0.0_wp             !! of 2 d h_j [m^2.rad]
      real(wp) :: m_dot = 0.0_wp         !! rate of m [m^2.rad/s]
      real(wp) :: m_ddot = 0.0_wp        !! second derivative of m by time [m^2.rad/s^2]
      real(wp) :: e_dot(2) = 0.0_wp      !! (2) rate of e [m.rad/s]
      real(wp) :: d_dot = 0.0_wp         !! rate of d [m.rad/s]
      real(wp) :: h_dot = 0.0_wp         !! rate of h [m^2.rad/s]
   end type sums_t

contains

   !> The ray at the start of a cell, with a round pin: found with those of the next cells at once.
   pure subroutine take_edge(pair, pin, cell, last, edges, ray)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      type(pin_t), intent(in) :: pin           !! where the pin is
      integer, intent(in) :: cell              !! the cell, from 0, any turn
      integer, intent(in) :: last              !! cell up to which they are asked for
      type(edges_t), intent(inout) :: edges    !! those that were found
      type(ray_t), intent(inout) :: ray        !! theta, d and slope are set

      integer :: first, n

      associate (hole => pair%worn%hole)
         if (cell >= edges%next) then
            first = modulo(cell, size(hole%volume)) + 1
            n = min(most_at_once, last - cell + 1, size(hole%volume) - first + 1)
            edges%first = cell
            edges%next = cell + n
            call quick_rays(n, pair%radius_j, pin%e, pair%clearance, hole%starts%u(first:, 1), hole%starts%u(first:, 2), &
                            hole%starts%h(first:), hole%starts%slope(first:), edges%d, edges%slope, edges%w)
         end if
         ray%theta = cell*hole%width
      end associate
      ray%d = edges%d(cell - edges%first + 1)
      ray%slope = edges%slope(cell - edges%first + 1)
   end subroutine take_edge

   !> Add cells of the hole that overlap a round pin all along, by Gauss's five points of each: d is of degree 4 there, or nearly.
   pure subroutine add_cells(pair, pin, first, n, sums)
      type(surfaces_t), intent(in) :: pair     !! the surfaces
      type(pin_t), intent(in) :: pin           !! where the pin is
      integer, intent(in) :: first             !! the first cell, from 0, any turn
      integer, intent(in) :: n                 !! how many
      type(sums_t), intent(inout) :: sums      !! added to

      real(wp), dimension(n_five*most_at_once) :: d, slope, w
      real(wp) :: two_d
      integer :: at, cell, g, k, m

      cell = first
      associate (hole => pair%worn%hole, points => pair%worn%hole%points)
         do while (cell < first + n)
            at = n_five*modulo(cell, size(hole%volume))
            m = n_five*min(most_at_once, first + n - cell, size(hole%volume) - modulo(cell, size(hole%volume)))
            call quick_rays(m, pair%radius_j, pin%e, pair%clearance, points%u(at + 1:, 1), points%u(at + 1:, 2), &
                            points%h(at + 1:), points%slope(at + 1:), d, slope, w)
            do k = 1, m, n_five
               do g = 0, n_five - 1
                  two_d = 2.0_wp*hole%width*five_weights(g + 1)*max(d(k + g), 0.0_wp)
                  sums%m = sums%m + 0.5_wp*two_d*d(k + g)
                  sums%e(1) = sums%e(1) + two_d*(points%u(at + k + g, 1) - w(k + g)*points%u(at + k + g, 2))
                  sums%e(2) = sums%e(2) + two_d*(points%u(at + k + g, 2) + w(k + g)*points%u(at + k + g, 1))
                  sums%d = sums%d + two_d
               end do
            end do
            cell = cell + m/n_five
         end do
      end associate
   end subroutine add_cells

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
      sums%j = sums%j + two_d*ray%by_j
      sums%d = sums%d + two_d
      sums%h = sums%h + two_d*ray%h_j
      if (level < to_rates) return
      associate (two_rate => 2.0_wp*width*ray%d_dot)
         sums%m_dot = sums%m_dot + two_d*ray%d_dot
         sums%e_dot = sums%e_dot + two_rate*d_e + two_d*ray%w_dot*[-ray%u(2), ray%u(1)]
         sums%d_dot = sums%d_dot + two_rate
         sums%h_dot = sums%h_dot + two_rate*ray%h_j + two_d*ray%h_j_by(2)
         sums%m_ddot = sums%m_ddot + two_rate*ray%d_dot + two_d*ray%d_ddot
      end associate
   end subroutine add_point

end module overlap_sums
