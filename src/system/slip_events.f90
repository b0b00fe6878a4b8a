!> When contacts begin to slip and to stick, and which way they go.
!>
!> Events: slip s = +-1 ends where s v_T falls to zero (to round-off, so that it also ends where drivers bring it to rest);
!> sticking ends where |x| = c_s F_N, its rate by a difference along the motion, or where the contact moves all the same. A slip
!> that ends at once again and again ends at a small speed the wrong way, which doubles each time up to a limit: so a contact that
!> can neither slip nor stick costs a bounded number of steps. Of what it can hold it is asked for less by as many parts, so that
!> contacts that share a load do not give way one after the other, each to be held by the others again. In space speeds and forces
!> are those of both tangents; a slip that has turned by a right angle within a step ends too, and goes on along its new way.
!>
!> Speeds that are small are parts of the mechanism's own, its pace times its size (`mechanism_scales`); times, of the
!> contact's own.
!>
!> Source: see `mechanism_friction`. Limits: contacts change one after another, each for the others as they are.
submodule(mechanism:mechanism_friction) slip_events
   use contact_grip, only: is_undecided, tangent_t
   use contact_places, only: slip_function
   use floors, only: at_rest, chatter_time, least_band, look_ahead, standstill, torn, widest_band
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
                     g(number) = standstill*own_speed(self) - slip*tangent%v(1) - set%grip%band(k)
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

   !> Speed of the mechanism, which says what sliding is slow.
   pure real(wp) function own_speed(self) result(speed)
      class(mechanism_t), intent(in) :: self   !! the system

      speed = self%linkage%scales%pace*self%linkage%scales%length
   end function own_speed

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

   !> Decide whether a contact slips, which way, or sticks. One whose slip ended, or that begins without sliding, is tried as
   !> sticking; if that takes more than it can hold, it slips the way that the force would have kept it from, and so does one
   !> that sticks until now; but the way it moves if that is against the other by more than is borne. One that drivers move goes
   !> with them.
   module procedure mechanism_decide_slip
      real(wp) :: band, delta(self%loose%n_contact), limit, rate(self%loose%n_contact), speed
      integer :: before, status

      speed = own_speed(self)
      associate (set => self%loose%sets(slot)%set)
         before = set%grip%slip(k)
         call set%gaps(self%linkage%motion, delta, rate)
         band = 0.0_wp
         if (t - set%grip%since(k) < chatter_time*own_time(self, slot, k, delta(set%before%contacts + k))) then
            band = speed*min(max(2.0_wp*set%grip%band(k)/speed, least_band), widest_band)
         end if
         call set%note_decision(k, t, band, at_rest*speed)
         if (before == is_undecided) then
            call set%lay(k, self%linkage%motion)
            if (size_of(set%grip%tangent(k)%v) > at_rest*speed) then
               call set%slip_toward(k, set%grip%tangent(k)%v)
               return
            end if
         end if
         call set%slip_as(k, sticks)
         call self%evaluate(t, y, self%friction%grips%trial%ydot, status)
         associate (tangent => set%grip%tangent(k))
            if (tangent%is_driven) then
               call set%note_decision(k, t, 0.0_wp, at_rest*speed)
               call go_with_drivers(self, t, y, slot, k, at_rest*speed)
               if (before == sticks .and. set%grip%slip(k) == sticks .and. &
                   size_of(tangent%f_t) > set%laws%friction%stick_limit(tangent%f_n)) call set%slip_toward(k, -tangent%f_t)
               return
            end if
            if (size_of(tangent%v) > 0.5_wp*torn*speed) then
               call set%slip_toward(k, tangent%v)
               return
            end if
            limit = (1.0_wp - band/max(speed, tiny(1.0_wp)))*set%laws%friction%stick_limit(tangent%f_n)
            if (before /= sticks .and. size_of(tangent%f_t) <= limit) return
            if (dot_product(tangent%v, tangent%f_t) > widest_band*speed*size_of(tangent%f_t)) then
               call set%slip_toward(k, tangent%v)
            else
               call set%slip_toward(k, -tangent%f_t)
            end if
         end associate
      end associate
   end procedure mechanism_decide_slip

   !> Let a contact that drivers move go their way, by its speed now and a little later; it sticks if it does not move then either.
   subroutine go_with_drivers(self, t, y, slot, k, still)
      class(mechanism_t), intent(inout) :: self  !! the system, evaluated at the state with the contact sticking
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state [any]
      integer, intent(in) :: slot                    !! set of the contact
      integer, intent(in) :: k                       !! contact of the set
      real(wp), intent(in) :: still                  !! speed that is none [m/s]

      real(wp) :: later, now(2), v(2)
      integer :: status

      later = max(look_ahead*self%friction%grips%h, self%time_of_difference(t))
      associate (set => self%loose%sets(slot)%set)
         now = set%grip%tangent(k)%v
         v = now
         if (size_of(now) < 0.5_wp*still) then
            self%friction%grips%trial%y = y + later*self%friction%grips%trial%ydot
            call self%linkage%set_motion(t + later, self%friction%grips%trial%y)
            call set%lay(k, self%linkage%motion)
            v = set%grip%tangent(k)%v
            call self%evaluate(t, y, self%friction%grips%trial%ydot, status)
         end if
         if (size_of(v) >= 0.5_wp*still) call set%slip_toward(k, v)
      end associate
   end subroutine go_with_drivers

   !> Length of a vector of the tangents.
   pure real(wp) function size_of(x)
      real(wp), intent(in) :: x(2)   !! (2) the vector [any]

      size_of = hypot(x(1), x(2))
   end function size_of

   !> Time in which a contact swings against its bodies, without the numbers of a whole swing; 0 where that is not known.
   pure real(wp) function own_time(self, slot, k, delta) result(time)
      class(mechanism_t), intent(in) :: self   !! the system
      integer, intent(in) :: slot                  !! set of the contact
      integer, intent(in) :: k                     !! contact of the set
      real(wp), intent(in) :: delta                !! its penetration [m]

      real(wp) :: compliance
      integer :: item

      associate (set => self%loose%sets(slot)%set)
         item = set%item_of(k)
         compliance = sum(self%linkage%inverse_mass(1, set%items%body(:, item)))*set%grip%tangent(k)%f_n
      end associate
      time = 0.0_wp
      if (compliance > 0.0_wp .and. delta > 0.0_wp) time = sqrt(delta/compliance)
   end function own_time

end submodule slip_events
