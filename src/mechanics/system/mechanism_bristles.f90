!> Deflections of bristles in the state: where they stand, what becomes of them, and what they are measured by.
submodule(mechanism_state) mechanism_bristles
   use friction_law, only: memory_bristle
   implicit none (type, external)

contains

   !> Entries of the state before the deflection of a contact.
   module procedure mechanism_bristle_place
      associate (stick_slip => self%clearance_joints%sets(slot)%set%stick_slip)
         place = self%linkage%n_position + self%linkage%n_rate + stick_slip%first_bristle + stick_slip%n_component*(contact - 1)
      end associate
   end procedure mechanism_bristle_place

   !> Place of the deflection of a joint that has friction in the state.
   module procedure mechanism_rubbing_place
      associate (rubbing => self%friction%rubbing)
         place = self%linkage%n_position + self%linkage%n_rate + rubbing%first_bristle + rubbing%bristle(joint)
      end associate
   end procedure mechanism_rubbing_place

   !> Deflections of bristles from a state into contacts and joints.
   module procedure mechanism_take_bristles
      integer :: k, place

      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            if (set%stick_slip%memory /= memory_bristle) cycle
            place = self%bristle_place(k, 1)
            call set%bend_bristles(y(place + 1:place + size(set%stick_slip%z)))
         end associate
      end do
      do k = 1, self%friction%rubbing%n
         if (self%friction%rubbing%bristle(k) == 0) cycle
         associate (friction => self%linkage%joints(self%friction%rubbing%slot(k))%set%friction)
            friction%z(self%friction%rubbing%place(k)) = y(self%rubbing_place(k))
         end associate
      end do
   end procedure mechanism_take_bristles

   !> Rates of these deflections; a contact that is free keeps its deflection.
   module procedure mechanism_bristle_rates
      integer :: contact, k, place

      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            if (set%stick_slip%memory /= memory_bristle) cycle
            do contact = 1, set%n_contact
               place = self%bristle_place(k, contact)
               ydot(place + 1:place + set%stick_slip%n_component) = 0.0_wp
               if (set%contact(contact)%is_touching) ydot(place + 1:place &
                                                          + set%stick_slip%n_component) = set%stick_slip%z_rate(:, contact)
            end do
         end associate
      end do
      do k = 1, self%friction%rubbing%n
         if (self%friction%rubbing%bristle(k) == 0) cycle
         associate (friction => self%linkage%joints(self%friction%rubbing%slot(k))%set%friction)
            ydot(self%rubbing_place(k)) = friction%z_rate(self%friction%rubbing%place(k))
         end associate
      end do
   end procedure mechanism_bristle_rates

   !> Their scales: the maximum deflections that last.
   module procedure mechanism_bristle_weights
      integer :: k, place

      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            if (set%stick_slip%memory /= memory_bristle) cycle
            place = self%bristle_place(k, 1)
            scale(place + 1:place + size(set%stick_slip%z)) = set%laws%friction%bristle_scale()
         end associate
      end do
      do k = 1, self%friction%rubbing%n
         if (self%friction%rubbing%bristle(k) == 0) cycle
         associate (friction => self%linkage%joints(self%friction%rubbing%slot(k))%set%friction)
            scale(self%rubbing_place(k)) = friction%law(self%friction%rubbing%place(k))%law%bristle_scale()
         end associate
      end do
   end procedure mechanism_bristle_weights

end submodule mechanism_bristles
