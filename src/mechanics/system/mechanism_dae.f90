!> A planar scene in the stabilised form of index 2, see `dae_system`.
!>
!> Masses are divided out: the residual of the velocities is v' - M^{-1} (g - Phi_q^T lambda). Rows stay in metres and radians.
!> For q' = N v the first equation is q' = N (v - M^{-1} Phi_q^T mu).
submodule(mechanism) mechanism_dae
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use assembly_report, only: assembly_t
   use contact_places, only: impulse_rates
   use dependent_rows, only: choose_dependent
   use rows, only: before_side, block_of_side, body_of_side, rows_t
   implicit none (type, external)

contains

   !> Rows that are omitted: none, unless some depend on others from the start.
   module procedure mechanism_begin_form
      type(assembly_t) :: report

      associate (solution => self%linkage%solution)
         solution%left_out = [integer ::]
         if (.not. solution%is_redundant) return
         call choose_dependent(self%linkage, report)
         solution%left_out = pack(report%dependent, report%dependent <= self%n_row)
      end associate
   end procedure mechanism_begin_form

   !> What is left of the equations.
   module procedure mechanism_dae_residual
      real(wp) :: change
      integer :: k, m, n, n_state

      n = self%linkage%n_position
      n_state = self%n - self%n_quadrature
      m = self%n_row
      self%n_evaluations = self%n_evaluations + 1
      if (self%friction%stick_slips%n_bristle > 0) call self%take_bristles(y)
      call self%linkage%set_motion(t, y)
      if (self%loading%states%n > 0) call self%take_states(y)
      call self%evaluate_terms(t, status)
      if (status /= 0) return
      if (self%friction%rubbing%n > 0) then  ! friction in joints, into g
         self%linkage%solution%lambda(:m) = lambda
         call self%friction_by_multipliers(.false., .false., change)
      end if
      if (self%friction%stick_slips%n_slip > 0) then  ! forces of contacts that stick, into g
         call self%linkage%find_accelerations(self%loading%g, .true., .true., status)
         if (status == 0) call self%stick(status)
         if (status /= 0) return
      end if
      associate (linkage => self%linkage, rows => self%linkage%rows, a => self%linkage%solution%a)
         ! derivatives first, which the residual is ydot less of
         call spread_rows(rows, m, linkage%inverse_mass, lambda, a)
         a = linkage%inverse_mass*self%loading%g - a
         call linkage%coordinates%rates(rows%n_unknown, rows%unknown, linkage%motion, a, r_y, r_y(n + 1:), status)
         if (status /= 0) return
         call spread_rows(rows, m, linkage%inverse_mass, mu, a)
         a = -a
         call linkage%coordinates%add_rates(rows%n_unknown, rows%unknown, linkage%motion, a, r_y)
         if (self%friction%stick_slips%n_bristle > 0) call self%bristle_rates(r_y)
         if (self%loading%states%n > 0) call self%state_rates(t, r_y, status)
         if (self%ledger%is_kept) then
            linkage%solution%lambda(:m) = lambda
            call self%ledger_rates(r_y(n_state + 1:))
         end if
         call impulse_rates(self%n_impulse, self%clearance_joints%integrands, r_y(self%n - self%n_impulse + 1:))
         if (self%n_wear > 0) call self%wear_rates(r_y(self%place_of_wear(1):self%place_of_wear(self%n_wear)))
         r_y = ydot - r_y
         r_lambda = linkage%solution%phi_dot(:m)
         r_mu = rows%phi(:m)
         do k = 1, size(linkage%solution%left_out)
            r_lambda(linkage%solution%left_out(k)) = lambda(linkage%solution%left_out(k))
            r_mu(linkage%solution%left_out(k)) = mu(linkage%solution%left_out(k))
         end do
      end associate
      if (.not. all(ieee_is_finite(r_y(:n_state)))) status = 1
   end procedure mechanism_dae_residual

   !> How fast a change of the multipliers changes the velocities. Of a long chain it is the whole that counts: what one multiplier
   !> does its neighbours take back.
   module procedure mechanism_effect_of
      integer :: body, i, k, turn

      associate (linkage => self%linkage, rows => self%linkage%rows, a => self%linkage%solution%a, &
                 is_turn => self%linkage%coordinates%is_turn)
         call spread_rows(rows, self%n_row, linkage%inverse_mass, change, a)
         effect = 0.0_wp
         do k = 1, rows%n_unknown
            body = rows%unknown(k)
            do i = 1, size(a, 1)
               if (is_turn(i)) then
                  effect = effect + a(i, body)**2
               else
                  effect = effect + (a(i, body)/linkage%scales%length)**2
               end if
            end do
         end do
         turn = findloc(is_turn, .true., dim=1)  ! all rates are measured by one
         effect = sqrt(effect)/scale(linkage%n_position + turn)
      end associate
   end procedure mechanism_effect_of

   !> M^{-1} Phi_q^T x.
   pure subroutine spread_rows(rows, m, inverse_mass, x, z)
      type(rows_t), intent(in) :: rows                   !! rows, evaluated
      integer, intent(in) :: m                           !! those that count, the first ones
      real(wp), intent(in) :: inverse_mass(:, 0:)        !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      real(wp), intent(in) :: x(m)                       !! (rows) multipliers [any]
      real(wp), intent(out) :: z(:, 0:)                  !! (n_v, 0:bodies) what they do to the rates [any]

      integer :: body, k, place, row

      z = 0.0_wp
      do k = 1, rows%n_side
         row = rows%side_row(k)
         place = before_side(rows%n_v, rows%side(k))
         body = body_of_side(rows, rows%side(k))
         z(:, body) = z(:, body) + rows%jac(place + 1:place + size(z, 1), block_of_side(rows%side(k)))*x(row)
      end do
      z = z*inverse_mass
   end subroutine spread_rows

end submodule mechanism_dae
