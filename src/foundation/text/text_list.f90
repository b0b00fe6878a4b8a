!> Lists of strings whose length a user drives: appending takes time in proportion to what is appended.
module text_list
   use text, only: text_t
   implicit none (type, external)
   private
   public :: text_list_t

   !> A list of strings that grows at its end without moving all of them each time.
   type :: text_list_t
      private
      type(text_t), allocatable :: store(:)  !! strings, more than are used
      integer, public :: n = 0               !! strings in use
   contains
      procedure :: add => add_to_list
      procedure :: at => string_of_list
      procedure :: get => get_list
   end type text_list_t

contains

   !> Append a string to a list that grows by doubling.
   pure subroutine add_to_list(self, s)
      class(text_list_t), intent(inout) :: self  !! the list
      character(*), intent(in) :: s              !! the new one

      type(text_t), allocatable :: larger(:)
      integer :: i

      if (.not. allocated(self%store)) allocate (self%store(16))
      if (self%n == size(self%store)) then
         allocate (larger(2*self%n))
         do i = 1, self%n
            call move_alloc(self%store(i)%s, larger(i)%s)
         end do
         call move_alloc(larger, self%store)
      end if
      self%n = self%n + 1
      self%store(self%n)%s = s
   end subroutine add_to_list

   !> The strings of a list.
   pure function get_list(self) result(list)
      class(text_list_t), intent(in) :: self  !! the list
      type(text_t), allocatable :: list(:)    !! (n) all that was appended

      if (allocated(self%store)) then
         list = self%store(:self%n)
      else
         allocate (list(0))
      end if
   end function get_list

   !> A string of a list.
   pure function string_of_list(self, k) result(s)
      class(text_list_t), intent(in) :: self  !! the list
      integer, intent(in) :: k                !! its number
      character(:), allocatable :: s          !! the string

      s = self%store(k)%s
   end function string_of_list

end module text_list
