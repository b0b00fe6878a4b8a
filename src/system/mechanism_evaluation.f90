!> The right-hand side: loads, rows, accelerations, and what is integrated besides.
submodule(mechanism) mechanism_evaluation
   use contact_places, only: impulse_rates
   use loading, only: start_loads
   use mechanism_parts, only: loose_t
   use motion, only: loads_t, motion_t
   implicit none (type, external)

contains

   !> Right-hand side. Status 1: singular or not a number, try a smaller step.
   module procedure mechanism_evaluate
      real(wp) :: inside
      logical :: with_powers

      with_powers = self%ledger%is_kept .and. self%traits%with_quadratures
      ! in the smooth stretch: `smooth_piece`, without its call
      inside = min(max(t, self%linkage%piece%low), self%linkage%piece%high)
      self%n_evaluations = self%n_evaluations + 1
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
               if (with_powers) call guided%set_acceleration(ydot(last + 1:), linkage%motion)
            end associate
         end if
      end associate
      if (self%friction%grips%n_bristle > 0) call self%bristle_rates(ydot)
      if (with_powers) call self%ledger_rates(ydot(self%n - self%n_quadrature + 1:))
      if (self%traits%with_quadratures) then
         call impulse_rates(self%n_impulse, self%loose%integrands, ydot(self%n - self%n_impulse + 1:))
      end if
   end procedure mechanism_evaluate

   !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
   module procedure evaluate_terms
      self%linkage%solution%bad_row = 0
      status = merge(0, 1, self%linkage%reduced%known%is_finite)
      if (status /= 0) return
      call mechanism_evaluate_loads(self, t)
      if (self%linkage%rows%n_solve > 0) call self%linkage%evaluate_rows(t)
   end procedure evaluate_terms

   !> Loads of gravity, force elements, touching contacts and films at the present motion.
   module procedure mechanism_evaluate_loads
      real(wp) :: inside
      integer :: k

      inside = min(max(t, self%linkage%piece%low), self%linkage%piece%high)
      associate (loading => self%loading, motion => self%linkage%motion, n_body => self%linkage%bodies%n)
         if (.not. loading%loads%is_weight) then
            call start_loads(n_body, loading%weight, loading%loads%force, loading%loads%moment)
         end if
         loading%power = 0.0_wp
         do k = 1, size(loading%forces)
            call loading%forces(k)%set%evaluate(inside, motion, loading%loads, loading%power)
         end do
         do k = 1, size(self%loose%sets)
            call self%loose%sets(k)%set%evaluate(motion, loading%loads, self%loose%integrands)
         end do
         if (self%loose%has_films) call evaluate_films(self%loose, motion, loading%loads)
         call self%linkage%coordinates%gather(n_body, self%linkage%mass, motion, loading%loads, loading%g)
      end associate
   end procedure mechanism_evaluate_loads

   !> Loads of lubricant films.
   subroutine evaluate_films(loose, motion, loads)
      type(loose_t), intent(inout) :: loose    !! loose joints, some of them with films
      type(motion_t), intent(in) :: motion     !! positions and velocities
      type(loads_t), intent(inout) :: loads    !! loads on the bodies, added to

      integer :: k

      do k = 1, size(loose%sets)
         associate (set => loose%sets(k)%set)
            if (.not. allocated(set%laws%films)) cycle
            if (set%laws%films%acts) then
               call set%laws%films%bear(set%items%body, set%items%s_i, set%items%s_j, motion, loads)
            end if
         end associate
      end do
   end subroutine evaluate_films

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
