!> Loops of the planar equations on plain arrays.
module planar_kernels
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: planar_loads, right_hand_side, start_loads, state_rates, take_known

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

   !> Rate of the violation and stabilised right-hand side of the solved rows. The ground has no velocity.
   pure subroutine right_hand_side(n_body, n_row, n_solve, body, phi, phi_t, jac, gam, v, omega, alpha, beta, phi_dot, b)
      integer, intent(in) :: n_body                 !! number of bodies
      integer, intent(in) :: n_row                  !! number of rows
      integer, intent(in) :: n_solve                !! rows that are solved for
      integer, intent(in) :: body(2, n_row)         !! (2, rows) bodies i and j, 0: ground
      real(wp), intent(in) :: phi(n_row)            !! (rows) violation [m or rad]
      real(wp), intent(in) :: phi_t(n_row)          !! (rows) its partial time derivative [m/s or rad/s]
      real(wp), intent(in) :: jac(6, n_row)         !! (6, rows) Phi_q [1 or m]
      real(wp), intent(in) :: gam(n_row)            !! (rows) gamma [m/s^2 or rad/s^2]
      real(wp), intent(in) :: v(3, 0:n_body)        !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)    !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: alpha                 !! gain on the rate [1/s]
      real(wp), intent(in) :: beta                  !! gain on the violation [1/s]
      real(wp), intent(inout) :: phi_dot(n_row)     !! (rows) rate of the violation [m/s or rad/s]
      real(wp), intent(inout) :: b(n_row)           !! (rows) right-hand side [m/s^2 or rad/s^2]

      real(wp) :: rate
      integer :: i, j, row

      !GCC$ novector
      do row = 1, n_solve
         i = body(1, row)
         j = body(2, row)
         rate = phi_t(row) + (jac(1, row)*v(1, i) + jac(2, row)*v(2, i) + jac(3, row)*omega(3, i)) &
                + (jac(4, row)*v(1, j) + jac(5, row)*v(2, j) + jac(6, row)*omega(3, j))
         phi_dot(row) = rate
         b(row) = gam(row) - 2.0_wp*alpha*rate - beta*beta*phi(row)
      end do
   end subroutine right_hand_side

   !> Take what the accelerations of known bodies do to the rows off the right-hand side.
   pure subroutine take_known(n_body, n_row, n_known, known, jac, a, angular, b)
      integer, intent(in) :: n_body                 !! number of bodies
      integer, intent(in) :: n_row                  !! number of rows
      integer, intent(in) :: n_known                !! sides of solved rows that are known bodies
      integer, intent(in) :: known(3, n_known)      !! (3, known sides) row, place in the Jacobian, body
      real(wp), intent(in) :: jac(6*n_row)          !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: a(3, 0:n_body)        !! (3, 0:bodies) accelerations, of known bodies [m/s^2]
      real(wp), intent(in) :: angular(3, 0:n_body)  !! (3, 0:bodies) angular accelerations, of known bodies [rad/s^2]
      real(wp), intent(inout) :: b(n_row)           !! (rows) right-hand side [m/s^2 or rad/s^2]

      integer :: body, k, place

      !GCC$ novector
      do k = 1, n_known
         place = known(2, k)
         body = known(3, k)
         b(known(1, k)) = b(known(1, k)) - (jac(place + 1)*a(1, body) + jac(place + 2)*a(2, body) + jac(place + 3)*angular(3, body))
      end do
   end subroutine take_known

end module planar_kernels
