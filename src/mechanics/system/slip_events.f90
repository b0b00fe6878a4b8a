!> When contacts begin to slip and to stick, and which way they go.
!>
!> Events: slip s = +-1 ends where s v_T falls to zero (to round-off, so that it also ends where drivers bring it to rest; in space
!> where it falls below what the tolerance leaves of a speed); sticking ends where |x| = c_s F_N, its rate by a difference along the
!> motion, or where the contact moves all the same. In space a slip that has turned by a right angle within a step ends too, and
!> goes on along its new way. What comes of an event: `slip_decision`.
!>
!> Speeds that are small are parts of the mechanism's own, its pace times its size (`mechanism_scales`); times, of the
!> contact's own.
!>
!> Source: see `mechanism_friction`. Limits: none.
submodule(mechanism:mechanism_friction) slip_events
   use contact_grip, only: is_undecided, tangent_t
   use contact_places, only: slip_function
   use floors, only: at_rest, torn
   implicit none (type, external)

contains

   !> Event functions of friction.
   module procedure mechanism_friction_events
      real(wp) :: moment
      integer :: k, number, slot, status

      number = self%loose%functions%place(slip_function, 0)
      g(number + 1:number + self%loose%n_contact) = -1.0_wp
      rate(number + 1:number + self%loose%n_contact) = 0.0_wp
      moment = self%time_of_difference(t)
      if (any_sticks(self)) then
         call self%evaluate(t, y, self%friction%grips%trial%ydot, status)
         self%friction%grips%trial%y = y + moment*self%friction%grips%trial%ydot
         call self%evaluate(t + moment, self%friction%grips%trial%y, self%friction%grips%trial%ydot, status)
         call note_holds(self, rate)
      end if
      call self%evaluate(t, y, self%friction%grips%trial%ydot, status)
      do slot = 1, size(self%loose%sets)
         associate (set => self%loose%sets(slot)%set)
            if (set%grip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               number = self%loose%functions%place(slip_function, set%before%contacts + k)
               if (.not. set%contact(k)%is_touching .or. set%grip%slip(k) == is_undecided) cycle
               associate (tangent => set%grip%tangent(k), slip => set%grip%slip(k))
                  if (slip == sticks) then
                     g(number) = short_of(self, tangent, set%laws%friction%stick_limit(tangent%f_n))
                     rate(number) = (rate(number) - g(number))/moment
                  else
                     g(number) = end_speed(self, slot, k) - slip*tangent%v(1) - set%grip%band(k)
                     rate(number) = -slip*(tangential(self, slot, k, 1, .true.) + tangent%drift(1))
                  end if
               end associate
            end do
         end associate
      end do
   end procedure mechanism_friction_events

   !> What the contacts that stick are short of giving way, as of the last evaluation.
   subroutine note_holds(self, g)
      class(mechanism_t), intent(in) :: self   !! the system
      real(wp), intent(inout) :: g(:)              !! (n_event) event functions [N]

      integer :: k, slot

      do slot = 1, size(self%loose%sets)
         associate (set => self%loose%sets(slot)%set)
            if (set%grip%memory /= memory_slip .or. set%n_touching == 0) cycle
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching .or. set%grip%slip(k) /= sticks) cycle
               g(self%loose%functions%place(slip_function, set%before%contacts + k)) = &
                  short_of(self, set%grip%tangent(k), set%laws%friction%stick_limit(set%grip%tangent(k)%f_n))
            end do
         end associate
      end do
   end subroutine note_holds

   !> What a contact that sticks is beyond giving way: by its force, or by a speed that drivers have given it.
   pure real(wp) function short_of(self, tangent, limit) result(g)
      class(mechanism_t), intent(in) :: self   !! the system
      type(tangent_t), intent(in) :: tangent       !! how the contact lies
      real(wp), intent(in) :: limit                !! greatest force that it holds [N]

      real(wp) :: speed

      speed = own_speed(self)*merge(at_rest, torn, tangent%is_driven)
      g = max(size_of(tangent%f_t) - limit, limit*(size_of(tangent%v)/speed - 1.0_wp))
   end function short_of

   !> Whether any contact sticks.
   pure logical function any_sticks(self)
      class(mechanism_t), intent(in) :: self   !! the system

      integer :: k

      any_sticks = .false.
      do k = 1, size(self%loose%sets)
         associate (set => self%loose%sets(k)%set)
            if (set%grip%memory /= memory_slip .or. set%n_touching == 0) cycle
            any_sticks = any_sticks .or. any(set%contact%is_touching .and. set%grip%slip == sticks)
         end associate
      end do
   end function any_sticks

end submodule slip_events
