!> The span between two body-fixed points: direction, distance and its rate.
module span
   use kinds, only: wp
   use motion, only: motion_t, point_position, point_velocity
   implicit none (type, external)
   private
   public :: span_of

contains

   !> Direction from a point of body i to a point of body j, their distance and its rate. Points that
   !> coincide have no direction: u and the rate are zero.
   pure subroutine span_of(motion, body, s_i, s_j, u, length, rate)
      type(motion_t), intent(in) :: motion  !! positions and velocities
      integer, intent(in) :: body(2)        !! (2) bodies i and j
      real(wp), intent(in) :: s_i(3)        !! (3) point of body i, its frame [m]
      real(wp), intent(in) :: s_j(3)        !! (3) point of body j, its frame [m]
      real(wp), intent(out) :: u(3)         !! (3) unit vector from i to j, world frame [1]
      real(wp), intent(out) :: length       !! distance [m]
      real(wp), intent(out) :: rate         !! its rate [m/s]

      real(wp) :: p_i(3), p_j(3)

      p_i = point_position(motion, body(1), s_i)
      p_j = point_position(motion, body(2), s_j)
      u = p_j - p_i
      length = norm2(u)
      rate = 0.0_wp
      if (.not. length > 0.0_wp) return
      u = u/length
      rate = dot_product(u, point_velocity(motion, body(2), p_j) - point_velocity(motion, body(1), p_i))
   end subroutine span_of

end module span
