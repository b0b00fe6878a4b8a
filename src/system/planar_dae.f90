!> A planar scene in the stabilised form of index 2, see `dae_system`.
!>
!> Masses are divided out: the residual of the velocities is v' - M^{-1} (g - Phi_q^T lambda). Rows stay in metres and radians.
submodule(planar_system) planar_dae
   implicit none (type, external)

contains

   !> What is left of the equations.
   module procedure planar_dae_residual
      integer :: m, n, n_state

      n = self%linkage%rows%n_unknown
      n_state = self%n - self%n_quadrature
      m = self%n_row
      self%n_evaluations = self%n_evaluations + 1
      if (self%grips%n_bristle > 0) call self%take_bristles(y)
      call self%linkage%set_motion(t, y)
      call self%evaluate_terms(t, status)
      if (status /= 0) return
      if (self%grips%n_slip > 0) then  ! forces of contacts that stick, into g
         call self%linkage%find_accelerations(self%loading%g, .true., .true., status)
         if (status == 0) call self%stick(status)
         if (status /= 0) return
      end if
      call spread_rows(self%linkage%bodies%n, m, self%linkage%rows%n_side, self%linkage%rows%side, self%linkage%rows%jac(:, &
                       :m), self%linkage%inverse_mass, lambda, self%linkage%solution%a)
      call remains(n, self%linkage%rows%unknown, self%linkage%bodies%n, y, ydot, self%linkage%inverse_mass, self%loading%g, &
                   self%linkage%solution%a, r_y)
      call spread_rows(self%linkage%bodies%n, m, self%linkage%rows%n_side, self%linkage%rows%side, self%linkage%rows%jac(:, &
                       :m), self%linkage%inverse_mass, mu, self%linkage%solution%a)
      call add_positions(n, self%linkage%rows%unknown, self%linkage%bodies%n, self%linkage%solution%a, r_y)
      if (self%grips%n_bristle > 0) call self%bristle_rates(r_y)
      if (self%with_ledger) then
         self%linkage%solution%lambda(:m) = lambda
         call self%ledger_rates(r_y(n_state + 1:))
      end if
      r_y(6*n + 1:) = ydot(6*n + 1:) - r_y(6*n + 1:)
      r_lambda = self%linkage%solution%phi_dot(:m)
      r_mu = self%linkage%rows%phi(:m)
      if (.not. all(ieee_is_finite(r_y(:n_state)))) status = 1
   end procedure planar_dae_residual

   !> M^{-1} Phi_q^T x.
   pure subroutine spread_rows(n_body, n_row, n_side, side, jac, inverse_mass, x, z)
      integer, intent(in) :: n_body                    !! number of bodies
      integer, intent(in) :: n_row                     !! number of rows
      integer, intent(in) :: n_side                    !! their sides that are unknown bodies
      integer, intent(in) :: side(3, n_side)           !! (3, sides) row, place in the Jacobian, body
      real(wp), intent(in) :: jac(6*n_row)             !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)  !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: x(n_row)                 !! (rows) multipliers [any]
      real(wp), intent(out) :: z(3, 0:n_body)          !! (3, 0:bodies) what they do to the rates [any]

      integer :: body, k, place

      z = 0.0_wp
      do k = 1, n_side
         place = side(2, k)
         body = side(3, k)
         z(:, body) = z(:, body) + jac(place + 1:place + 3)*x(side(1, k))
      end do
      z = z*inverse_mass
   end subroutine spread_rows

   !> Residual of coordinates and rates without mu: q' - v, v' - M^{-1} g + M^{-1} Phi_q^T lambda.
   pure subroutine remains(n, unknown, n_body, y, ydot, inverse_mass, g, z, r)
      integer, intent(in) :: n                         !! number of unknown bodies
      integer, intent(in) :: unknown(n)                !! (n) their numbers
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: y(3, 2*n)                !! (3, 2 n) coordinates, then rates [any]
      real(wp), intent(in) :: ydot(3, 2*n)             !! (3, 2 n) derivatives [any]
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)  !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: g(3, 0:n_body)           !! (3, 0:bodies) loads on the coordinates [N, N, N.m]
      real(wp), intent(in) :: z(3, 0:n_body)           !! (3, 0:bodies) M^{-1} Phi_q^T lambda [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: r(3, 2*n)             !! (3, 2 n) residual [any]

      integer :: body, k

      do k = 1, n
         body = unknown(k)
         r(:, k) = ydot(:, k) - y(:, n + k)
         r(:, n + k) = ydot(:, n + k) - inverse_mass(:, body)*g(:, body) + z(:, body)
      end do
   end subroutine remains

   !> Add M^{-1} Phi_q^T mu to the residual of the coordinates.
   pure subroutine add_positions(n, unknown, n_body, z, r)
      integer, intent(in) :: n                         !! number of unknown bodies
      integer, intent(in) :: unknown(n)                !! (n) their numbers
      integer, intent(in) :: n_body                    !! number of bodies
      real(wp), intent(in) :: z(3, 0:n_body)           !! (3, 0:bodies) M^{-1} Phi_q^T mu [m/s, m/s, rad/s]
      real(wp), intent(inout) :: r(3, n)               !! (3, n) residual of the coordinates [m/s, m/s, rad/s]

      integer :: k

      do k = 1, n
         r(:, k) = r(:, k) + z(:, unknown(k))
      end do
   end subroutine add_positions

end submodule planar_dae
