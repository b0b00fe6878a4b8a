!> The powers of the ledger and of wear, as of the last evaluation.
submodule(mechanism) mechanism_powers
   use clearance_set, only: loss_contact, loss_friction
   use contact_places, only: lost_damper, n_loss, place_of_film_loss, place_of_joint_loss, place_of_loss, work_drive, work_load, &
      work_stabilisation
   implicit none (type, external)

contains

   !> Powers of the ledger.
   module procedure ledger_rates
      integer :: k, place

      power(work_drive) = 0.0_wp
      power(work_stabilisation) = 0.0_wp
      associate (linkage => self%linkage, rows => self%linkage%rows, motion => self%linkage%motion, &
                 driven => self%linkage%reduced%driven)
         if (linkage%reduced%known%n > 0) then
            power(work_drive) = linkage%reduced%known%power(driven, rows, linkage%mass, self%loading%g, &
                                                             linkage%solution%lambda, motion)
         end if
         do k = 1, rows%n_solve
            power(work_drive) = power(work_drive) + linkage%solution%lambda(k)*rows%phi_t(k)
            power(work_stabilisation) = power(work_stabilisation) - linkage%solution%lambda(k)*linkage%solution%phi_dot(k)
         end do
      end associate
      power(work_load) = self%loading%power
      power(lost_damper) = 0.0_wp
      do k = 1, size(self%loading%forces)
         power(lost_damper) = power(lost_damper) + self%loading%forces(k)%set%lost_power(self%linkage%motion)
      end do
      place = place_of_loss(1, 0)
      do k = 1, self%clearance_joints%n_contact
         power(place + loss_contact) = self%clearance_joints%integrands(loss_contact, k)
         power(place + loss_friction) = self%clearance_joints%integrands(loss_friction, k)
         place = place + n_loss
      end do
      if (self%friction%rubbing%n > 0) power(place_of_joint_loss(self%clearance_joints%n_contact)) = self%friction%rubbing%power
      if (.not. self%clearance_joints%has_films) return
      place = place_of_film_loss(self%clearance_joints%n_contact, self%friction%rubbing%n > 0)
      power(place) = 0.0_wp
      do k = 1, size(self%clearance_joints%sets)
         associate (set => self%clearance_joints%sets(k)%set)
            if (allocated(set%laws%films)) power(place) = power(place) + set%laws%films%power
         end associate
      end do
   end procedure ledger_rates

   !> Rates of the driving work of wear: none of contacts whose surfaces do not wear.
   module procedure wear_rates
      integer :: k

      do k = 1, self%clearance_joints%n_set
         associate (set => self%clearance_joints%sets(k)%set)
            associate (first => set%before%contacts + 1, last => set%before%contacts + set%n_contact)
               if (allocated(set%laws%wear)) then
                  call set%wear_rates(self%linkage%motion, self%clearance_joints%integrands(:, first:last), rate(first:last))
               else
                  rate(first:last) = 0.0_wp
               end if
            end associate
         end associate
      end do
   end procedure wear_rates

end submodule mechanism_powers
