!> Loops of the planar equations on plain arrays.
module planar_kernels
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: planar_loads, start_loads, state_rates

contains

   !> Loads of gravity.
   pure subroutine start_loads(n, weight, force, moment)
      integer, intent(in) :: n                      !! number of bodies
      real(wp), intent(in) :: weight(3, 0:n)        !! (3, 0:n) force of gravity [N]
      real(wp), intent(out) :: force(3, 0:n)        !! (3, 0:n) forces [N]
      real(wp), intent(out) :: moment(3, 0:n)       !! (3, 0:n) moments about the centres of mass [N.m]

      integer :: k

      do k = 0, n
         force(:, k) = weight(:, k)
         moment(:, k) = 0.0_wp
      end do
   end subroutine start_loads

   !> Loads on the planar coordinates.
   pure subroutine planar_loads(n, force, moment, g)
      integer, intent(in) :: n                      !! number of bodies
      real(wp), intent(in) :: force(3, 0:n)         !! (3, 0:n) forces [N]
      real(wp), intent(in) :: moment(3, 0:n)        !! (3, 0:n) moments about the centres of mass [N.m]
      real(wp), intent(out) :: g(3, 0:n)            !! (3, 0:n) loads on x, y, angle [N, N, N.m]

      integer :: k

      do k = 0, n
         g(1, k) = force(1, k)
         g(2, k) = force(2, k)
         g(3, k) = moment(3, k)
      end do
   end subroutine planar_loads

   !> Derivative of coordinates and rates. Status 1 if an acceleration is not a finite number.
   pure subroutine state_rates(n, unknown, n_body, v, omega, a, rates, accelerations, status)
      integer, intent(in) :: n                      !! number of unknown bodies
      integer, intent(in) :: unknown(n)             !! (n) their numbers
      integer, intent(in) :: n_body                 !! number of bodies
      real(wp), intent(in) :: v(3, 0:n_body)        !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)    !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: a(3, 0:n_body)        !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: rates(3, n)        !! (3, n) derivatives of the coordinates [m/s, m/s, rad/s]
      real(wp), intent(inout) :: accelerations(3, n)   !! (3, n) derivatives of the rates [m/s^2, m/s^2, rad/s^2]
      integer, intent(out) :: status                !! 0: all finite

      real(wp) :: sum
      integer :: body, k

      sum = 0.0_wp
      do k = 1, n
         body = unknown(k)
         rates(1, k) = v(1, body)
         rates(2, k) = v(2, body)
         rates(3, k) = omega(3, body)
         accelerations(1, k) = a(1, body)
         accelerations(2, k) = a(2, body)
         accelerations(3, k) = a(3, body)
         sum = sum + abs(a(1, body)) + abs(a(2, body)) + abs(a(3, body))
      end do
      status = merge(0, 1, ieee_is_finite(sum))
   end subroutine state_rates

end module planar_kernels
