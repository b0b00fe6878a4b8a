!> Integrals over the overlap of worn surfaces: of one ray with its weight, and of many.
!>
!> M = int d^2 dtheta and its derivatives, see `surface_overlap`; rays are those of `overlap_rays`.
module overlap_sums
   use kinds, only: wp
   use overlap_rays, only: ray_t, rays_t
   implicit none (type, external)
   private
   public :: add_point, add_rays, append, arc_t, sums_t, to_gradient, to_rates, to_second

   integer, parameter :: to_gradient = 0   !! penetration and its gradient
   integer, parameter :: to_rates = 1      !! and how both change with time
   integer, parameter :: to_second = 2     !! and the second derivative of the penetration by time

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

   !> Add rays through places of the hole to the integrals.
   pure subroutine add_rays(rays, weights, u_x, u_y, level, sums)
      type(rays_t), intent(in) :: rays                   !! the rays
      real(wp), intent(in) :: weights(rays%n)            !! (n) their weights [rad]
      real(wp), intent(in) :: u_x(rays%n)                !! (n) cosines of their directions [1]
      real(wp), intent(in) :: u_y(rays%n)                !! (n) sines [1]
      integer, intent(in) :: level                       !! what is found
      type(sums_t), intent(inout) :: sums                !! added to

      real(wp) :: two_d, two_rate
      integer :: k

      do k = 1, rays%n
         two_d = 2.0_wp*weights(k)*rays%d(k)
         sums%m = sums%m + 0.5_wp*two_d*rays%d(k)
         sums%e(1) = sums%e(1) + two_d*(u_x(k) - rays%w(k)*u_y(k))
         sums%e(2) = sums%e(2) + two_d*(u_y(k) + rays%w(k)*u_x(k))
         sums%d = sums%d + two_d
         sums%j = sums%j + two_d*rays%by_j(k)
         sums%h = sums%h + two_d*rays%h_j(k)
      end do
      if (level < to_rates) return
      do k = 1, rays%n
         two_d = 2.0_wp*weights(k)*rays%d(k)
         two_rate = 2.0_wp*weights(k)*rays%d_dot(k)
         sums%m_dot = sums%m_dot + two_d*rays%d_dot(k)
         sums%e_dot(1) = sums%e_dot(1) + two_rate*(u_x(k) - rays%w(k)*u_y(k)) - two_d*rays%w_dot(k)*u_y(k)
         sums%e_dot(2) = sums%e_dot(2) + two_rate*(u_y(k) + rays%w(k)*u_x(k)) + two_d*rays%w_dot(k)*u_x(k)
         sums%d_dot = sums%d_dot + two_rate
         sums%h_dot = sums%h_dot + two_rate*rays%h_j(k) + two_d*rays%h_j_dot(k)
         sums%m_ddot = sums%m_ddot + two_rate*rays%d_dot(k) + two_d*rays%d_ddot(k)
      end do
   end subroutine add_rays

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

end module overlap_sums
