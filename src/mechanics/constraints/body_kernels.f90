!> Loops over bodies and rows that more than one solver has, for the plane or for space by the number of rates of a body.
!>
!> Their text is `body_kernels.inc`.
module body_kernels
   use body_kernels_planar, only: planar_accelerations => body_accelerations, planar_residuals => row_residuals
   use body_kernels_spatial, only: spatial_accelerations => body_accelerations, spatial_residuals => row_residuals
   use kinds, only: wp
   use rows, only: n_v_planar, rows_t
   implicit none (type, external)
   private
   public :: body_accelerations, row_residuals

contains

   !> a = M^-1 (g - Phi_q^T lambda) of the unknown bodies.
   pure subroutine body_accelerations(rows, n_unknown, unknown, n_body, inverse_mass, jac, g, lambda, a)
      type(rows_t), intent(in) :: rows                     !! rows, of which the sides are read
      integer, intent(in) :: n_unknown                     !! bodies whose accelerations are requested
      integer, intent(in) :: unknown(n_unknown)            !! (these bodies) their numbers
      integer, intent(in) :: n_body                        !! number of bodies
      real(wp), intent(in) :: inverse_mass(rows%n_v, 0:n_body)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      real(wp), intent(in) :: jac(2*rows%n_v*rows%n_block)      !! (2 n_v blocks) Phi_q, block by block [1 or m]
      real(wp), intent(in) :: g(rows%n_v, 0:n_body)             !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in) :: lambda(rows%n)               !! (rows) multipliers [N or N.m]
      real(wp), intent(inout) :: a(rows%n_v, 0:n_body)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]

      if (rows%n_v == n_v_planar) then
         call planar_accelerations(rows, n_unknown, unknown, n_body, inverse_mass, jac, g, lambda, a)
      else
         call spatial_accelerations(rows, n_unknown, unknown, n_body, inverse_mass, jac, g, lambda, a)
      end if
   end subroutine body_accelerations

   !> r = Phi_q a - b of the solved rows.
   pure subroutine row_residuals(rows, n_solve, n_body, jac, a, b, r)
      type(rows_t), intent(in) :: rows                     !! rows, of which the sides are read
      integer, intent(in) :: n_solve                       !! rows that are solved for
      integer, intent(in) :: n_body                        !! number of bodies
      real(wp), intent(in) :: jac(2*rows%n_v*rows%n_block)      !! (2 n_v blocks) Phi_q, block by block [1 or m]
      real(wp), intent(in) :: a(rows%n_v, 0:n_body)             !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(in) :: b(n_solve)                   !! (solved rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(out) :: r(n_solve)                  !! (solved rows) residuals [m/s^2 or rad/s^2]

      if (rows%n_v == n_v_planar) then
         call planar_residuals(rows, n_solve, n_body, jac, a, b, r)
      else
         call spatial_residuals(rows, n_solve, n_body, jac, a, b, r)
      end if
   end subroutine row_residuals

end module body_kernels
