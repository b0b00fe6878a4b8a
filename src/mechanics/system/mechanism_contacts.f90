!> Which contact an event function is of, what its event would be to it, and how round-off shows in these functions.
submodule(mechanism_state) mechanism_contacts
   use contact_stick_slip, only: sticks
   use contact_places, only: slip_function, touch_function, transition_function, turn_function
   use friction_law, only: memory_slip
   use gap_noise, only: find_gap_noise
   use ode_system, only: contact_end, contact_onset, no_contact_change
   implicit none (type, external)

   real(wp), parameter :: of_forces = 100.0_wp   !! round-offs of a friction force that keeps a contact from sliding [1]

contains

   !> Set of a contact and its place there by its number.
   module procedure mechanism_find_contact
      do slot = 1, size(self%clearance_joints%sets)
         contact = self%clearance_joints%functions%contact_of(number) - self%clearance_joints%sets(slot)%set%before%contacts
         if (contact <= self%clearance_joints%sets(slot)%set%n_contact) return
      end do
   end procedure mechanism_find_contact

   !> What event k, as things stand, is to a contact.
   module procedure mechanism_contact_change
      integer :: item, slot

      change = no_contact_change
      if (self%clearance_joints%functions%kind_of(k) /= touch_function) return
      call self%find_contact(k, slot, item)
      change = merge(contact_end, contact_onset, self%clearance_joints%sets(slot)%set%contact(item)%is_touching)
   end procedure mechanism_contact_change

   !> Round-off of the event functions at the present motion. Constraints hand the round-off of the angles on.
   module procedure mechanism_event_noise
      real(wp) :: rate_noise(self%clearance_joints%n_contact), shared
      integer :: k, turns

      noise = 0.0_wp
      shared = 0.0_wp
      if (self%linkage%rows%n_solve > 0 .or. self%linkage%reduced%one_dof%n > 0) then
         if (self%linkage%coordinates%turns_in_body) shared = self%linkage%scales%length  ! of Euler parameters
         shared = shared + maxval(abs(self%linkage%motion%r)) + maxval(abs(self%linkage%motion%angle))*self%linkage%scales%length
      end if
      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            associate (first => set%before%contacts + 1, last => set%before%contacts + set%n_contact)
               call find_gap_noise(set, self%linkage%motion, shared, noise(first:last), rate_noise(first:last))
            end associate
         end associate
      end do
      if (self%clearance_joints%functions%has_slip) call find_slip_noise(self, noise, rate_noise)
      if (self%clearance_joints%functions%has_transition) then
         turns = self%clearance_joints%functions%place(transition_function, 0)
         noise(turns + 1:turns + self%clearance_joints%n_contact) = noise(:self%clearance_joints%n_contact)
      end if
      if (self%clearance_joints%functions%has_turn) then
         turns = self%clearance_joints%functions%place(turn_function, 0)
         noise(turns + 1:turns + self%clearance_joints%n_contact) = rate_noise
      end if
   end procedure mechanism_event_noise

   !> Round-off of the event functions of friction: of the sliding velocity where a contact slips, of what it is short of giving way
   !> where it sticks. A force is known as well as the penetration that makes it.
   subroutine find_slip_noise(self, noise, rate_noise)
      class(mechanism_state_t), intent(in) :: self   !! the system
      real(wp), intent(inout) :: noise(:)            !! (n_event) bounds, those of friction are set [any]
      real(wp), intent(in) :: rate_noise(:)          !! (contacts) bounds of rates of penetrations [m/s]

      real(wp) :: delta(self%clearance_joints%n_contact), rate(self%clearance_joints%n_contact)
      integer :: k, number, slot

      do slot = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(slot)%set)
            if (set%stick_slip%memory /= memory_slip .or. set%n_touching == 0) cycle
            call set%gaps(self%linkage%motion, delta, rate)
            do k = 1, set%n_contact
               if (.not. set%contact(k)%is_touching) cycle
               number = set%before%contacts + k
               associate (tangent => set%stick_slip%tangent(k), &
                          bound => noise(self%clearance_joints%functions%place(slip_function, number)))
                  if (set%stick_slip%slip(k) == sticks) then
                     bound = (set%laws%friction%stick_limit(tangent%f_n) + hypot(tangent%f_t(1), tangent%f_t(2))) &
                             *min(max(of_forces*epsilon(1.0_wp), 2.0_wp*noise(number)/max(delta(number), noise(number))), 1.0_wp)
                  else
                     bound = rate_noise(number)
                  end if
               end associate
            end do
         end associate
      end do
   end subroutine find_slip_noise

end submodule mechanism_contacts
