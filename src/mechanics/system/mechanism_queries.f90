!> What is asked of a planar scene beside its evaluation: event functions.
submodule(mechanism) mechanism_queries
   use contact_memory, only: rests
   use contact_places, only: transition_function, turn_function
   implicit none (type, external)

contains

   !> Event functions: penetrations of free contacts, their negatives of touching ones.
   module procedure mechanism_events
      if (self%friction%stick_slips%n_slip > 0 .and. size(g) > self%clearance_joints%n_contact) then
         call self%friction_events(t, y, g, rate)
      else
         call self%linkage%set_motion(t, y)
      end if
      if (self%clearance_joints%functions%has_turn .and. size(g) > self%clearance_joints%n_contact) call turn_events(self, t, &
                                                                                                                     y, g, rate)
      call contact_events(self, g, rate)
      if (self%clearance_joints%functions%has_transition &
          .and. size(g) > self%clearance_joints%n_contact) call transition_events(self, g, rate)
   end procedure mechanism_events

   !> The same at the present motion.
   module procedure mechanism_last_events
      if (self%friction%stick_slips%n_slip > 0 .and. size(g) > self%clearance_joints%n_contact) call self%friction_events(t, y, &
                                                                                                                          g, rate)
      if (self%clearance_joints%functions%has_turn .and. size(g) > self%clearance_joints%n_contact) call turn_events(self, t, &
                                                                                                                     y, g, rate)
      call contact_events(self, g, rate)
      if (self%clearance_joints%functions%has_transition &
          .and. size(g) > self%clearance_joints%n_contact) call transition_events(self, g, rate)
   end procedure mechanism_last_events

   !> Leave the system at a state: its motion is enough, but for friction and turns, whose event functions evaluate.
   module procedure mechanism_settle
      if (self%friction%stick_slips%n_slip > 0 .or. self%clearance_joints%functions%has_turn) then
         call self%events(t, y, g, rate)
      else
         call self%linkage%set_motion(t, y)
      end if
   end procedure mechanism_settle

   !> Event functions of contacts whose law jumps where the penetration turns: the rate of the penetration falls to zero while they
   !> approach, rises to zero while they part, and leaves its range where they rest.
   subroutine turn_events(self, t, y, g, rate)
      class(mechanism_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state [any]
      real(wp), intent(inout) :: g(:)                !! (n_event) event functions, those of turns are set [m/s]
      real(wp), intent(inout) :: rate(:)             !! (n_event) their rates [m/s^2]

      real(wp) :: acceleration(self%clearance_joints%n_contact), speed(self%clearance_joints%n_contact)
      integer :: i, k, number, place

      place = self%clearance_joints%functions%place(turn_function, 0)
      g(place + 1:place + self%clearance_joints%n_contact) = -1.0_wp
      rate(place + 1:place + self%clearance_joints%n_contact) = 0.0_wp
      if (.not. any([(self%clearance_joints%sets(k)%set%laws%normal%jumps_at_turn &
                      .and. self%clearance_joints%sets(k)%set%n_touching > 0, &
                      k=1, size(self%clearance_joints%sets))])) return
      call self%turns(t, y, speed, acceleration)
      do k = 1, self%clearance_joints%n_set
         associate (set => self%clearance_joints%sets(k)%set)
            if (.not. set%laws%normal%jumps_at_turn .or. set%n_touching == 0) cycle
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               number = set%before%contacts + i
               place = self%clearance_joints%functions%place(turn_function, number)
               if (set%contact(i)%course == rests) then
                  g(place) = abs(speed(number)) - set%contact(i)%rest_speed
                  rate(place) = sign(1.0_wp, speed(number))*acceleration(number)
               else
                  g(place) = -set%contact(i)%course*speed(number)
                  rate(place) = -set%contact(i)%course*acceleration(number)
               end if
            end do
         end associate
      end do
   end subroutine turn_events

   !> Rates of all penetrations and their rates.
   module procedure mechanism_turns
      real(wp) :: delta(self%clearance_joints%n_contact), moment, ydot(size(y))
      integer :: k, status

      moment = self%time_of_difference(t)
      call self%evaluate(t, y, ydot, status)
      call self%linkage%set_motion(t + moment, y + moment*ydot)
      do k = 1, self%clearance_joints%n_set
         call self%clearance_joints%sets(k)%set%gaps(self%linkage%motion, delta, acceleration)
      end do
      call self%evaluate(t, y, ydot, status)
      do k = 1, self%clearance_joints%n_set
         call self%clearance_joints%sets(k)%set%gaps(self%linkage%motion, delta, rate)
      end do
      acceleration = (acceleration - rate)/moment
   end procedure mechanism_turns

   !> Event functions of the contacts at the present motion.
   subroutine contact_events(self, g, rate)
      class(mechanism_t), intent(in) :: self     !! the system
      real(wp), intent(inout), contiguous :: g(:)    !! (n_event) event functions [m]
      real(wp), intent(inout), contiguous :: rate(:) !! (n_event) their rates [m/s]

      integer :: first, i, k

      do k = 1, self%clearance_joints%n_set
         associate (set => self%clearance_joints%sets(k)%set)
            call set%gaps(self%linkage%motion, g, rate)
            if (set%n_touching == 0) cycle
            first = set%before%contacts
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               g(first + i) = -g(first + i)
               rate(first + i) = -rate(first + i)
            end do
         end associate
      end do
   end subroutine contact_events

   !> Event functions of transitions from films: the penetration less the depth of the transition, its negative beyond it.
   subroutine transition_events(self, g, rate)
      class(mechanism_t), intent(in) :: self     !! the system
      real(wp), intent(inout) :: g(:)            !! (n_event) event functions, those of contacts set, of transitions set here [m]
      real(wp), intent(inout) :: rate(:)         !! (n_event) their rates [m/s]

      real(wp) :: side
      integer :: i, k, number, place

      do k = 1, self%clearance_joints%n_set
         associate (set => self%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               number = set%before%contacts + i
               place = self%clearance_joints%functions%place(transition_function, number)
               g(place) = -1.0_wp
               rate(place) = 0.0_wp
               if (.not. allocated(set%laws%films)) cycle
               if (.not. set%laws%films%fades()) cycle
               side = merge(-1.0_wp, 1.0_wp, set%contact(i)%is_touching)
               g(place) = side*g(number) - set%laws%films%place(set%item_of(i))%depth
               rate(place) = side*rate(number)
               if (.not. set%contact(i)%is_dry) cycle
               g(place) = -g(place)
               rate(place) = -rate(place)
            end do
         end associate
      end do
   end subroutine transition_events

end submodule mechanism_queries
