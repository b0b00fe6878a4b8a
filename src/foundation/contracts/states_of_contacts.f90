!> What a contact is at: apart, in dry contact, carried by a film, or both; its number in files and its word.
module states_of_contacts
   implicit none (type, external)
   private
   public :: state_contact, state_film, state_free, state_mixed
   public :: state_name

   integer, parameter :: state_free = 0     !! contact state: bodies apart
   integer, parameter :: state_contact = 1  !! contact state: dry contact
   integer, parameter :: state_film = 2     !! contact state: carried by a film
   integer, parameter :: state_mixed = 3    !! contact state: film and contact

contains

   !> The word for a contact state.
   pure function state_name(state) result(word)
      integer, intent(in) :: state         !! contact state, one of the above
      character(:), allocatable :: word    !! as written in files

      select case (state)
      case (state_free)
         word = "free"
      case (state_contact)
         word = "contact"
      case (state_film)
         word = "film"
      case (state_mixed)
         word = "mixed"
      case default
         word = "unknown"
      end select
   end function state_name

end module states_of_contacts
