!> The right-hand side of any scene: loads, rows, accelerations.
submodule(mechanism) mechanism_evaluation
   use clearance_set, only: clearance_slot_t, n_integrand
   use loading, only: loading_t, start_loads
   use mechanism_parts, only: clearance_joints_t
   use motion, only: loads_t, motion_t
   implicit none (type, external)

contains

   !> Rates of the coordinates and their derivatives, and those of bristles, in any scene.
   module procedure evaluate_any
      if (self%friction%stick_slips%n_bristle > 0) call self%take_bristles(y)
      if (self%stabiliser%at_stages) then
         call move_corrected(self, t, y, status)
         if (status /= 0) return
      else
         call self%linkage%move(inside, y)
      end if
      if (self%loading%states%n > 0) call self%take_states(y)
      call evaluate_terms(self, inside, status)
      if (status /= 0) return
      if (self%linkage%rows%n_unknown > 0 .or. self%friction%stick_slips%n_slip > 0) then
         call self%linkage%find_accelerations(self%loading%g, .true., self%friction%stick_slips%n_slip > 0, status)
         if (status == 0 .and. self%friction%rubbing%n > 0) then
            call self%rub(status)  ! and what sticks
         else if (status == 0 .and. self%friction%stick_slips%n_slip > 0) then
            call self%stick(status)
         end if
         if (status /= 0) return
      end if
      associate (linkage => self%linkage, n => self%linkage%rows%n_unknown, one_dof => self%linkage%reduced%one_dof, &
                 nq => self%linkage%n_position)
         if (n > 0) then
            call linkage%coordinates%rates(n, linkage%rows%unknown, linkage%motion, linkage%solution%a, ydot, ydot(nq + 1:), status)
            if (status /= 0) return
         end if
         if (one_dof%n > 0) then
            associate (last => nq + linkage%n_rate - one_dof%n)
               call one_dof%rates(linkage%coordinates%n_v, linkage%bodies%n, self%loading%g, y(last + 1:), &
                                 ydot(nq - one_dof%n + 1:), ydot(last + 1:), status)
            end associate
         end if
      end associate
      if (self%friction%stick_slips%n_bristle > 0) call self%bristle_rates(ydot)
      if (status == 0 .and. self%loading%states%n > 0) call self%state_rates(t, ydot, status)
   end procedure evaluate_any

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
         if (loading%states%n > 0) call loading%states%work_out(linkage%segment%inside(t), linkage%motion)
         call sum_loads(min(max(t, linkage%segment%low), linkage%segment%high), linkage%motion, linkage%bodies%n, loading, &
                        self%clearance_joints)
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
      if (self%loading%states%n > 0) call self%take_states(y)
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
