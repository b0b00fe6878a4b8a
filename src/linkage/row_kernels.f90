!> Loops over the constraint rows on plain arrays.
module row_kernels
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: right_hand_side, take_known

contains

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

end module row_kernels
