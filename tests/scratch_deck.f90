!> Decks written in a test, as files of their own.
module scratch_deck
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: remove_scratch, write_scratch

contains

   !> Write the text of a deck to a file that was not there yet.
   subroutine write_scratch(text, path)
      character(*), intent(in) :: text                !! the deck
      character(:), allocatable, intent(out) :: path  !! of the file

      integer :: unit

      call free_path(path)
      open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", action="write")
      write (unit) text
      close (unit)
   end subroutine write_scratch

   !> Remove such a file.
   subroutine remove_scratch(path)
      character(*), intent(in) :: path  !! of the file

      integer :: unit

      open (newunit=unit, file=path, access="stream", form="unformatted", status="old")
      close (unit, status="delete")
   end subroutine remove_scratch

   !> The path of a file that is not there yet.
   subroutine free_path(path)
      character(:), allocatable, intent(out) :: path  !! in the directory for temporary files

      character(500) :: folder
      character(20) :: number
      integer(i8) :: clock
      integer :: length
      logical :: is_there

      call get_environment_variable("TMPDIR", folder, length)
      if (length == 0) folder = "/tmp"
      call system_clock(clock)
      do
         write (number, "(i0)") modulo(clock, 1000000000000_i8)
         path = trim(folder)//"/gudgeon_test_"//trim(number)//".deck"
         inquire (file=path, exist=is_there)
         if (.not. is_there) return
         clock = clock + 1
      end do
   end subroutine free_path

end module scratch_deck
