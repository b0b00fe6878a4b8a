!> Which contact an event function is of, what its event would be to it, and how round-off shows in these functions.
submodule(mechanism_state) mechanism_contacts
   use contact_places, only: touch_function, transition_function, turn_function
   use gap_noise, only: find_gap_noise
   use ode_system, only: contact_end, contact_onset, no_contact_change
   implicit none (type, external)

contains

   !> Set of a contact and its place there by its number.
   module procedure mechanism_find_contact
      do slot = 1, size(self%loose%sets)
         contact = self%loose%functions%contact_of(number) - self%loose%sets(slot)%set%before%contacts
         if (contact <= self%loose%sets(slot)%set%n_contact) return
      end do
   end procedure mechanism_find_contact

   !> What event k, as things stand, is to a contact.
   module procedure mechanism_contact_change
      integer :: item, slot

      change = no_contact_change
      if (self%loose%functions%kind_of(k) /= touch_function) return
      call self%find_contact(k, slot, item)
      change = merge(contact_end, contact_onset, self%loose%sets(slot)%set%contact(item)%is_touching)
   end procedure mechanism_contact_change

   !> Round-off of the event functions at the present motion. Constraints hand the round-off of the angles on.
   module procedure mechanism_event_noise
      real(wp) :: rate_noise(self%loose%n_contact), shared
      integer :: k, turns

      noise = 0.0_wp
      shared = 0.0_wp
      if (self%linkage%rows%n_solve > 0 .or. self%linkage%reduced%guided%n > 0) then
         if (self%linkage%coordinates%turns_in_body) shared = self%linkage%scales%length  ! of Euler parameters
         shared = shared + maxval(abs(self%linkage%motion%r)) + maxval(abs(self%linkage%motion%angle))*self%linkage%scales%length
      end if
      do k = 1, size(self%loose%sets)
         associate (set => self%loose%sets(k)%set)
            associate (first => set%before%contacts + 1, last => set%before%contacts + set%n_contact)
               call find_gap_noise(set, self%linkage%motion, shared, noise(first:last), rate_noise(first:last))
            end associate
         end associate
      end do
      if (self%loose%functions%has_transition) then
         turns = self%loose%functions%place(transition_function, 0)
         noise(turns + 1:turns + self%loose%n_contact) = noise(:self%loose%n_contact)
      end if
      if (self%loose%functions%has_turn) then
         turns = self%loose%functions%place(turn_function, 0)
         noise(turns + 1:turns + self%loose%n_contact) = rate_noise
      end if
   end procedure mechanism_event_noise

end submodule mechanism_contacts
