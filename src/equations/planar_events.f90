!> What the events of a planar scene are.
submodule(planar_system) planar_events
   implicit none (type, external)

contains

   !> Whether event k, as things stand, is the onset of a contact.
   module procedure planar_is_onset
      integer :: item, slot

      is_onset = .false.
      if (k > self%n_contact) return
      call self%find_contact(k, slot, item)
      is_onset = .not. self%clearances(slot)%set%contact(item)%is_touching
   end procedure planar_is_onset

end submodule planar_events
