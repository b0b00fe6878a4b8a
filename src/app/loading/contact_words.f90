!> Contacts that a word names.
module contact_words
   use mechanism, only: mechanism_t
   implicit none (type, external)
   private
   public :: find_contacts

contains

   !> Contacts of a joint with clearance: numbers of the first and the last one in the mechanism.
   subroutine find_contacts(system, joint, first, last, message, help)
      type(mechanism_t), intent(in) :: system                  !! the mechanism
      character(*), intent(in) :: joint                        !! name of the joint, or JOINT.CONTACT
      integer, intent(out) :: first                            !! number of the first contact, 0: none
      integer, intent(out) :: last                             !! number of the last one
      character(:), allocatable, intent(out) :: message        !! what is wrong; blank: nothing
      character(:), allocatable, intent(out) :: help           !! the joints that there are

      character(:), allocatable :: names
      integer :: i, k, of_item

      names = ""
      message = ""
      first = 0
      last = 0
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               of_item = set%item_of(i)
               associate (item => set%names(of_item)%s, number => set%before%contacts + i)
                  if (index(names//" ", " "//item//" ") == 0) names = names//" "//item
                  if (joint /= item .and. joint /= item//"."//set%label_of(i)) cycle
                  if (first == 0) first = number
                  last = number
               end associate
            end do
         end associate
      end do
      help = "joints with clearance:"//names
      if (first == 0) message = "'"//joint//"' is not a joint with clearance"
   end subroutine find_contacts

end module contact_words
