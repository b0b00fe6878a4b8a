!> Blocks of a journal: four characters, the number of bytes, their checksum, the bytes, the four characters again.
!>
!> A block that was cut off or damaged is not read, and neither is what comes after it.
module journal_blocks
   use checksum, only: add_rows
   use, intrinsic :: iso_fortran_env, only: int8
   use kinds, only: i8
   use packed, only: unpacker_t
   implicit none (type, external)
   private
   public :: block_of, next_block, tag_length

   integer, parameter :: tag_length = 4   !! characters of the tag of a block

contains

   !> The next block; .false.: there is none, or it was cut off.
   logical function next_block(bytes, at, tag, block) result(is_there)
      character(*), intent(in) :: bytes                   !! of the journal
      integer, intent(inout) :: at                        !! bytes before the block; after it on return
      character(:), allocatable, intent(out) :: tag       !! what it is
      type(unpacker_t), intent(out) :: block              !! what it holds

      integer(i8) :: length, sum
      integer :: first

      is_there = .false.
      first = at + tag_length + 16
      if (first > len(bytes)) return
      tag = bytes(at + 1:at + tag_length)
      length = transfer(bytes(at + tag_length + 1:first - 8), length)
      sum = transfer(bytes(first - 7:first), sum)
      if (length < 0 .or. first + length + tag_length > len(bytes)) return
      if (sum_of(tag, bytes(first + 1:first + int(length))) /= sum) return
      at = first + int(length)
      if (bytes(at + 1:at + tag_length) /= tag) return
      block%bytes = bytes(first + 1:at)
      at = at + tag_length
      is_there = .true.
   end function next_block

   !> A block.
   function block_of(tag, bytes) result(block)
      character(*), intent(in) :: tag         !! what it is
      character(*), intent(in) :: bytes       !! what it holds
      character(:), allocatable :: block      !! all of it

      block = tag//transfer(len(bytes, i8), "12345678")//transfer(sum_of(tag, bytes), "12345678")//bytes//tag
   end function block_of

   !> The checksum of a block.
   integer(i8) function sum_of(tag, bytes) result(sum)
      character(*), intent(in) :: tag         !! what it is
      character(*), intent(in) :: bytes       !! what it holds

      sum = len(bytes, i8)
      call add_rows(sum, transfer(tag//bytes, [0_int8]), len(tag) + len(bytes))
   end function sum_of

end module journal_blocks
