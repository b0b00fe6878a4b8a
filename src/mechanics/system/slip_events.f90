!> When contacts start to slip and to stick, and which way they go.
!>
!> Events: slip s = +-1 ends where s v_T falls to zero (to round-off, so that it also ends where drivers bring it to rest; in space
!> where it falls below what the tolerance leaves of a speed); sticking ends where |x| = c_s F_N, its rate by a difference along the
!> motion, or where the contact moves all the same. In space a slip that has turned by a right angle within a step ends too, and
!> continues along its new way. What comes of an event: `slip_decision`.
!>
!> Speeds that are small are parts of the mechanism's own, its characteristic rate times its size (`mechanism_scales`); times, of
!> the contact's own.
!>
!> Source: see `mechanism_friction`. Limits: none.
submodule(mechanism:mechanism_friction) slip_events
   use contact_stick_slip, only: is_undecided, tangent_t
   use contact_places, only: slip_function
   use floors, only: at_rest, torn
   implicit none (type, external)

contains

   !> Event functions of friction.
   module procedure mechanism_friction_events
      real(wp) :: moment
      integer :: k, number, slot, status

      number = self%clearance_joints%functions%place(slip_function, 0)
      g(number + 1:number + self%clearance_joints%n_contact) = -1.0_wp
      rate(number + 1:number + self%clearance_joints%n_contact) = 0.0_wp
      moment = self%time_of_difference(t)
      if (any_sticks(self)) then
         call self%evaluate(t, y, self%friction%stick_slips%trial%ydot, status)
         self%friction%stick_slips%trial%y = y + moment*self%friction%stick_slips%trial%ydot
         call self%evaluate(t + moment, self%friction%stick_slips%trial%y, self%friction%stick_slips%trial%ydot, status)
         call note_holds(self, rate)
      end if
      call self%evaluate(t, y, self%friction%stick_slips%trial%ydot, status)
      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               number = self%clearance_joints%functions%place(slip_function, set%before%contacts + k)
               if (.not. set%contact(k)%is_touching .or. set%stick_slip%slip(k) == is_undecided) cycle
               associate (tangent => set%stick_slip%tangent(k), slip => set%stick_slip%slip(k))
                  if (slip == sticks) then
                     g(number) = short_of(self, tangent, set%laws%friction%stick_limit(tangent%f_n))
                     rate(number) = (rate(number) - g(number))/moment
                  else
                     g(number) = end_speed(self, slot, k) - slip*tangent%v(1) - set%stick_slip%band(k)
                     rate(number) = end_speed_rate(self, slot, k) - slip*(tangential(self, slot, k, 1, .true.) + tangent%drift(1))
                  end if
               end associate
            end do
         end associate
      end do
   end procedure mechanism_friction_events

   !> Rate of the sliding velocity at which slip ends: in space it follows the turning of the bodies within the penetration.
   real(wp) function end_speed_rate(self, slot, k) result(speed_rate)
      class(mechanism_t), intent(in) :: self   !! the system, evaluated
      integer, intent(in) :: slot              !! set of the contact
      integer, intent(in) :: k                 !! contact of the set

      real(wp) :: delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact)
      real(wp) :: acceleration(most_rates), rise(3), speed, turning(3)
      integer :: body, side

      speed_rate = 0.0_wp
      associate (set => self%clearance_joints%sets(slot)%set, linkage => self%linkage)
         if (set%stick_slip%n_tangent == 1) return
         call set%gaps(linkage%motion, delta, rate)
         turning = 0.0_wp
         rise = 0.0_wp
         do side = 1, 2
            body = set%items%body(side, set%item_of(k))
            if (body == 0) cycle
            call linkage%coordinates%find_acceleration(linkage%motion, body, acceleration)
            if (.not. linkage%reduced%is_known(body)) acceleration(4:6) = linkage%solution%a(4:6, body)
            rise = rise + real(2*side - 3, wp)*matmul(linkage%motion%rot(:, :, body), acceleration(4:6))
            turning = turning + real(2*side - 3, wp)*linkage%motion%omega(:, body)
         end do
         associate (depth => delta(set%before%contacts + k), depth_rate => rate(set%before%contacts + k))
            speed = 0.5_wp*contact_lever*depth*norm2(turning)
            if (speed <= resolved_speed(self) .or. speed >= widest_band*own_speed(self)) return
            speed_rate = 0.5_wp*contact_lever*(depth_rate*norm2(turning) + depth*dot_product(turning, rise)/norm2(turning))
         end associate
      end associate
   end function end_speed_rate

   !> What the contacts that stick are short of giving way, as of the last evaluation.
   subroutine note_holds(self, g)
      class(mechanism_t), intent(in) :: self   !! the system
      real(wp), intent(inout) :: g(:)              !! (n_event) event functions [N]

      integer :: k, slot

      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching .or. set%stick_slip%slip(k) /= sticks) cycle
               g(self%clearance_joints%functions%place(slip_function, set%before%contacts + k)) = &
                  short_of(self, set%stick_slip%tangent(k), set%laws%friction%stick_limit(set%stick_slip%tangent(k)%f_n))
            end do
         end associate
      end do
   end subroutine note_holds

   !> What a contact that sticks is beyond giving way: by its force, or by a speed that drivers have given it.
   pure real(wp) function short_of(self, tangent, limit) result(g)
      class(mechanism_t), intent(in) :: self   !! the system
      type(tangent_t), intent(in) :: tangent       !! how the contact lies
      real(wp), intent(in) :: limit                !! maximum force that it holds [N]

      real(wp) :: speed

      speed = own_speed(self)*merge(at_rest, torn, tangent%is_driven)
      g = max(size_of(tangent%f_t) - limit, limit*(size_of(tangent%v)/speed - 1.0_wp))
   end function short_of

   !> Whether any contact sticks.
   pure logical function any_sticks(self)
      class(mechanism_t), intent(in) :: self   !! the system

      integer :: k

      any_sticks = .false.
      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            any_sticks = any_sticks .or. any(set%contact%is_touching .and. set%stick_slip%slip == sticks)
         end associate
      end do
   end function any_sticks

end submodule slip_events
