!> What the program needs memory for at the moment: said when there is no more of it, since most allocations do not look
!> themselves (process_calls.c ends the program with code 9 and these words). Set between the parts of a run, not within them.
module memory_purpose
   use, intrinsic :: iso_c_binding, only: c_char, c_null_char
   implicit none (type, external)
   private
   public :: memory_is_for

   integer, parameter :: longest = 127  !! characters of the words

   !> (longest + 1) the words, ended by a null character; blank: nothing in particular
   character(kind=c_char), bind(c, name="gudgeon_memory_purpose") :: purpose(longest + 1) = c_null_char

contains

   !> Say what memory is needed for from now on.
   subroutine memory_is_for(words)
      character(*), intent(in) :: words  !! as `the deck and its tables`

      integer :: k

      do k = 1, min(len(words), longest)
         purpose(k) = words(k:k)
      end do
      purpose(min(len(words), longest) + 1) = c_null_char
   end subroutine memory_is_for

end module memory_purpose
