!> Loops over the constraint rows, for the plane or for space by the number of rates of a body.
!>
!> Their text is `row_kernels.inc`.
module row_kernels
   use kinds, only: wp
   use row_kernels_planar, only: planar_side => right_hand_side, take_prescribed_planar => take_prescribed
   use row_kernels_spatial, only: spatial_side => right_hand_side, take_prescribed_spatial => take_prescribed
   use rows, only: n_v_planar, rows_t
   implicit none (type, external)
   private
   public :: right_hand_side, take_prescribed

contains

   !> Rate of the violation and stabilised right-hand side of some solved rows. The ground has no velocity.
   pure subroutine right_hand_side(from, to, rows, n_body, v, omega, alpha, beta, phi_dot, b)
      integer, intent(in) :: from                   !! the first of the rows
      integer, intent(in) :: to                     !! the last of them
      type(rows_t), intent(in) :: rows              !! rows, evaluated
      integer, intent(in) :: n_body                 !! number of bodies
      real(wp), intent(in) :: v(3, 0:n_body)        !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)    !! (3, 0:bodies) angular velocities, in the axes of the rows' columns [rad/s]
      real(wp), intent(in) :: alpha                 !! gain on the rate [1/s]
      real(wp), intent(in) :: beta                  !! gain on the violation [1/s]
      real(wp), intent(inout) :: phi_dot(rows%n)    !! (rows) rate of the violation, set of these rows [m/s or rad/s]
      real(wp), intent(inout) :: b(rows%n)          !! (rows) right-hand side, set of these rows [m/s^2 or rad/s^2]

      if (rows%n_v == n_v_planar) then
         call planar_side(from, to, rows, n_body, v, omega, alpha, beta, phi_dot, b)
      else
         call spatial_side(from, to, rows, n_body, v, omega, alpha, beta, phi_dot, b)
      end if
   end subroutine right_hand_side

   !> Take what the accelerations of prescribed bodies do to the rows off the right-hand side.
   pure subroutine take_prescribed(rows, n_body, a, angular, b)
      type(rows_t), intent(in) :: rows              !! rows, evaluated
      integer, intent(in) :: n_body                 !! number of bodies
      real(wp), intent(in) :: a(3, 0:n_body)        !! (3, 0:bodies) accelerations, of prescribed bodies [m/s^2]
      real(wp), intent(in) :: angular(3, 0:n_body)  !! (3, 0:bodies) angular accelerations, in the same axes [rad/s^2]
      real(wp), intent(inout) :: b(rows%n)          !! (rows) right-hand side [m/s^2 or rad/s^2]

      if (rows%n_v == n_v_planar) then
         call take_prescribed_planar(rows, n_body, a, angular, b)
      else
         call take_prescribed_spatial(rows, n_body, a, angular, b)
      end if
   end subroutine take_prescribed

end module row_kernels
