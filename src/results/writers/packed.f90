!> Numbers and texts put one behind the other as bytes, and taken out again in the same order, to the last bit.
!>
!> The bytes are those of the machine. A text, and a list, has its length before it. What is taken from bytes that were cut off is
!> empty, and `is_good` is false from then on.
module packed
   use kinds, only: i8, wp
   use text, only: text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: packer_t, unpacker_t

   integer, parameter :: word = 8  !! bytes of a number

   !> Puts things together.
   type :: packer_t
      type(buffer_t) :: bytes  !! so far
   contains
      procedure :: integer => pack_integer
      procedure :: text => pack_text
      procedure :: reals => pack_reals
      procedure :: texts => pack_texts
   end type packer_t

   !> Takes them apart.
   type :: unpacker_t
      character(:), allocatable :: bytes  !! all
      integer :: at = 0                   !! bytes that were taken
      logical :: is_good = .true.         !! whether all was there
   contains
      procedure :: integer => unpack_integer
      procedure :: text => unpack_text
      procedure :: reals => unpack_reals
      procedure :: texts => unpack_texts
   end type unpacker_t

contains

   !> Put an integer.
   pure subroutine pack_integer(self, i)
      class(packer_t), intent(inout) :: self  !! so far
      integer, intent(in) :: i                !! the number

      call self%bytes%add(transfer(int(i, i8), repeat(" ", word)))
   end subroutine pack_integer

   !> Put a text.
   pure subroutine pack_text(self, s)
      class(packer_t), intent(inout) :: self  !! so far
      character(*), intent(in) :: s           !! the text

      call pack_integer(self, len(s))
      call self%bytes%add(s)
   end subroutine pack_text

   !> Put a list of numbers.
   pure subroutine pack_reals(self, x)
      class(packer_t), intent(inout) :: self  !! so far
      real(wp), intent(in) :: x(:)            !! (n) the numbers [any]

      integer :: k

      call pack_integer(self, size(x))
      do k = 1, size(x)
         call self%bytes%add(transfer(x(k), repeat(" ", word)))
      end do
   end subroutine pack_reals

   !> Put a list of texts.
   pure subroutine pack_texts(self, list)
      class(packer_t), intent(inout) :: self  !! so far
      type(text_t), intent(in) :: list(:)     !! (n) the texts

      integer :: k

      call pack_integer(self, size(list))
      do k = 1, size(list)
         call pack_text(self, list(k)%s)
      end do
   end subroutine pack_texts

   !> Take an integer, not less than zero and not more than `most`.
   pure subroutine unpack_integer(self, i, most)
      class(unpacker_t), intent(inout) :: self  !! the bytes
      integer, intent(out) :: i                 !! the number
      integer, intent(in) :: most               !! the largest that makes sense

      integer(i8) :: long

      i = 0
      self%is_good = self%is_good .and. self%at + word <= len(self%bytes)
      if (.not. self%is_good) return
      long = transfer(self%bytes(self%at + 1:self%at + word), long)
      self%at = self%at + word
      self%is_good = long >= 0 .and. long <= most
      if (self%is_good) i = int(long)
   end subroutine unpack_integer

   !> Take a text.
   pure subroutine unpack_text(self, s)
      class(unpacker_t), intent(inout) :: self          !! the bytes
      character(:), allocatable, intent(out) :: s       !! the text

      integer :: n

      call unpack_integer(self, n, len(self%bytes) - self%at)
      self%is_good = self%is_good .and. self%at + n <= len(self%bytes)
      if (.not. self%is_good) n = 0
      s = self%bytes(self%at + 1:self%at + n)
      self%at = self%at + n
   end subroutine unpack_text

   !> Take a list of numbers.
   pure subroutine unpack_reals(self, x)
      class(unpacker_t), intent(inout) :: self             !! the bytes
      real(wp), allocatable, intent(out) :: x(:)           !! (n) the numbers [any]

      integer :: k, n

      call unpack_integer(self, n, len(self%bytes)/word)
      self%is_good = self%is_good .and. self%at + n*word <= len(self%bytes)
      if (.not. self%is_good) n = 0
      allocate (x(n))
      do k = 1, n
         x(k) = transfer(self%bytes(self%at + 1:self%at + word), x(k))
         self%at = self%at + word
      end do
   end subroutine unpack_reals

   !> Take a list of texts.
   pure subroutine unpack_texts(self, list)
      class(unpacker_t), intent(inout) :: self             !! the bytes
      type(text_t), allocatable, intent(out) :: list(:)    !! (n) the texts

      integer :: k, n

      call unpack_integer(self, n, len(self%bytes)/word)
      allocate (list(n))
      do k = 1, n
         call unpack_text(self, list(k)%s)
      end do
   end subroutine unpack_texts

end module packed
