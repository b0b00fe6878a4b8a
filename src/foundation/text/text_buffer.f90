!> Long texts put together piece by piece: appending takes time in proportion to what is appended.
module text_buffer
   implicit none (type, external)
   private
   public :: buffer_t

   !> A string that grows at its end without copying itself each time.
   type :: buffer_t
      private
      character(:), allocatable :: store  !! characters, more than are used
      integer :: used = 0                 !! characters in use
   contains
      procedure :: add => add_to_buffer
      procedure :: get => get_buffer
      procedure :: length => length_of_buffer
      procedure :: line => add_line
   end type buffer_t

contains

   !> Append a string to a buffer.
   pure subroutine add_to_buffer(self, s)
      class(buffer_t), intent(inout) :: self  !! the buffer
      character(*), intent(in) :: s           !! what to append

      character(:), allocatable :: larger

      if (.not. allocated(self%store)) allocate (character(256) :: self%store)
      if (self%used + len(s) > len(self%store)) then
         allocate (character(2*(self%used + len(s))) :: larger)
         larger(1:self%used) = self%store(1:self%used)
         call move_alloc(larger, self%store)
      end if
      self%store(self%used + 1:self%used + len(s)) = s
      self%used = self%used + len(s)
   end subroutine add_to_buffer

   !> Append a string and the end of a line.
   pure subroutine add_line(self, s)
      class(buffer_t), intent(inout) :: self  !! the buffer
      character(*), intent(in) :: s           !! the line

      call add_to_buffer(self, s)
      call add_to_buffer(self, new_line("a"))
   end subroutine add_line

   !> What a buffer holds.
   pure function get_buffer(self) result(s)
      class(buffer_t), intent(in) :: self  !! the buffer
      character(:), allocatable :: s       !! all that was appended

      s = ""
      if (self%used > 0) s = self%store(1:self%used)
   end function get_buffer

   !> Number of characters in a buffer.
   pure integer function length_of_buffer(self)
      class(buffer_t), intent(in) :: self  !! the buffer

      length_of_buffer = self%used
   end function length_of_buffer

end module text_buffer
