!> The right-hand side: loads, rows, accelerations, and what is integrated besides.
submodule(mechanism) mechanism_evaluation
   use contact_places, only: impulse_rates
   use loading, only: loading_t, start_loads
   use mechanism_parts, only: loose_t
   use motion, only: loads_t, motion_t
   implicit none (type, external)

contains

   !> Right-hand side. Status 1: singular or not a number, try a smaller step.
   module procedure mechanism_evaluate
      real(wp) :: inside

      ! in the smooth stretch: `smooth_piece`, without its call
      inside = min(max(t, self%linkage%piece%low), self%linkage%piece%high)
      self%n_evaluations = self%n_evaluations + 1
      if (self%is_direct) then
         call evaluate_directly(self, inside, y, ydot, status)
      else
         call evaluate_any(self, t, inside, y, ydot, status)
      end if
      if (status /= 0 .or. .not. self%traits%with_quadratures) return
      if (self%ledger%is_kept) then
         associate (guided => self%linkage%reduced%guided, last => self%linkage%n_position + self%linkage%n_rate)
            if (guided%n > 0) call guided%set_acceleration(ydot(last - guided%n + 1:), self%linkage%motion)
         end associate
         if (self%is_direct) call self%gather_loads()
         call self%ledger_rates(ydot(self%n - self%n_quadrature + 1:))
      end if
      call impulse_rates(self%n_impulse, self%loose%integrands, ydot(self%n - self%n_impulse + 1:))
   end procedure mechanism_evaluate

   !> Rates of the coordinates and their derivatives, and those of bristles, in any scene. Status 1: singular or not a number.
   subroutine evaluate_any(self, t, inside, y, ydot, status)
      class(mechanism_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(in) :: inside             !! the same in the smooth stretch [s]
      real(wp), intent(in) :: y(self%n)          !! (n) state [any]
      real(wp), intent(inout) :: ydot(self%n)    !! (n) its derivative, but for quadratures [any]
      integer, intent(out) :: status             !! outcome

      if (self%friction%grips%n_bristle > 0) call self%take_bristles(y)
      if (self%way%at_stages) then
         call move_corrected(self, t, y, status)
         if (status /= 0) return
      else
         call self%linkage%move(inside, y)
      end if
      call evaluate_terms(self, inside, status)
      if (status /= 0) return
      if (self%linkage%rows%n_unknown > 0 .or. self%friction%grips%n_slip > 0) then
         call self%linkage%find_accelerations(self%loading%g, .true., self%friction%grips%n_slip > 0, status)
         if (status == 0 .and. self%friction%rubbing%n > 0) then
            call self%rub(status)  ! and what sticks
         else if (status == 0 .and. self%friction%grips%n_slip > 0) then
            call self%stick(status)
         end if
         if (status /= 0) return
      end if
      associate (linkage => self%linkage, n => self%linkage%rows%n_unknown, guided => self%linkage%reduced%guided, &
                 nq => self%linkage%n_position)
         if (n > 0) then
            call linkage%coordinates%rates(n, linkage%rows%unknown, linkage%motion, linkage%solution%a, ydot, ydot(nq + 1:), status)
            if (status /= 0) return
         end if
         if (guided%n > 0) then
            associate (last => nq + linkage%n_rate - guided%n)
               call guided%rates(linkage%coordinates%n_v, linkage%bodies%n, self%loading%g, y(last + 1:), &
                                 ydot(nq - guided%n + 1:), ydot(last + 1:), status)
            end associate
         end if
      end associate
      if (self%friction%grips%n_bristle > 0) call self%bristle_rates(ydot)
   end subroutine evaluate_any

   !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
   module procedure evaluate_terms
      self%linkage%solution%bad_row = 0
      status = merge(0, 1, self%linkage%reduced%known%is_finite)
      if (status /= 0) return
      call mechanism_evaluate_loads(self, t)
      if (self%linkage%rows%n_solve > 0) call self%linkage%evaluate_rows(t)
   end procedure evaluate_terms

   !> Loads of gravity, force elements, touching contacts and films at the present motion, on the rates.
   module procedure mechanism_evaluate_loads
      associate (linkage => self%linkage, loading => self%loading)
         call sum_loads(min(max(t, linkage%piece%low), linkage%piece%high), linkage%motion, linkage%bodies%n, loading, self%loose)
      end associate
      call self%gather_loads()
   end procedure mechanism_evaluate_loads

   !> The loads that were summed, on the rates.
   module procedure mechanism_gather_loads
      associate (linkage => self%linkage)
         call linkage%coordinates%gather(linkage%bodies%n, linkage%mass, linkage%motion, self%loading%loads, self%loading%g)
      end associate
   end procedure mechanism_gather_loads

   include "sum_loads.inc"

   !> Accelerations of the bodies without their joints: loads over masses.
   module procedure mechanism_evaluate_unheld
      integer :: k

      status = 0
      call self%linkage%set_motion(t, y)
      call self%evaluate_loads(t)
      associate (linkage => self%linkage, n_v => self%linkage%coordinates%n_v)
         do k = 1, linkage%rows%n_unknown
            associate (body => linkage%rows%unknown(k), before => linkage%n_position + n_v*(k - 1))
               ydot(before + 1:before + n_v) = self%loading%g(:, body)*linkage%inverse_mass(:, body)
            end associate
         end do
      end associate
   end procedure mechanism_evaluate_unheld

end submodule mechanism_evaluation
