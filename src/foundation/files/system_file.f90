!> Whole files and streams as bytes, and the system's error numbers as text.
!>
!> Fortran cannot say what kind of file a path names before it opens it, and opening a pipe that nobody writes to waits for
!> ever; nor does it report how many bytes the last part of a stream has.
module system_file
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_int64_t, c_null_char, c_ptr
   use kinds, only: i8
   use text, only: to_text
   implicit none (type, external)
   private
   public :: read_file, system_message

   integer(c_int), parameter :: is_directory = -1   !! a directory
   integer(c_int), parameter :: is_no_file = -2     !! a device, or a pipe where a file is requested
   integer(c_int), parameter :: is_too_large = -3   !! more bytes than requested
   integer(c_int), parameter :: no_entry = 2        !! ENOENT, the same on every Unix

   ! allow(assumed-size, assumed-size-character-intent)
   interface
      integer(c_int) function c_read_file(path, only_regular, most, bytes, n, is_stream) bind(c, name="gudgeon_read_file")
         import :: c_char, c_int, c_int64_t, c_ptr
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) the file
         integer(c_int), value :: only_regular          !! 1: no pipes, no devices
         integer(c_int64_t), value :: most              !! bytes that are read at most
         type(c_ptr), intent(out) :: bytes              !! what was read, to be freed
         integer(c_int64_t), intent(out) :: n           !! number of bytes; of a file too large, its size if known
         integer(c_int), intent(out) :: is_stream       !! 1: not a regular file
      end function c_read_file

      subroutine c_error_text(code, text, capacity) bind(c, name="gudgeon_error_text")
         import :: c_char, c_int
         implicit none (type, external)
         integer(c_int), value :: code                   !! error number
         character(kind=c_char), intent(out) :: text(*)  !! (capacity) what it means
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_error_text

      subroutine c_free(bytes) bind(c, name="free")
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: bytes  !! memory of C
      end subroutine c_free
   end interface

contains

   !> Read everything that a file or stream holds.
   subroutine read_file(path, only_regular, most, bytes, message, is_stream)
      character(*), intent(in) :: path                     !! of the file
      logical, intent(in) :: only_regular                  !! whether pipes and devices are refused
      integer(i8), intent(in) :: most                      !! bytes that are read at most
      character(:), allocatable, intent(out) :: bytes      !! what it holds; empty if it cannot be read
      character(:), allocatable, intent(out) :: message    !! empty: success; else why not
      logical, intent(out), optional :: is_stream          !! whether it can be read but once

      character(kind=c_char), pointer :: store(:)
      type(c_ptr) :: address
      integer(c_int64_t) :: i, n
      integer(c_int) :: code, stream
      integer :: status

      message = ""
      code = no_entry
      stream = 0
      if (len_trim(path) > 0) code = c_read_file(path//c_null_char, merge(1_c_int, 0_c_int, only_regular), most, address, n, stream)
      if (present(is_stream)) is_stream = stream /= 0
      if (code == 0) then
         allocate (character(n) :: bytes, stat=status)
         if (status == 0) then
            call c_f_pointer(address, store, [n])
            do i = 1, n
               bytes(i:i) = store(i)
            end do
         else
            message = "not enough memory for its "//to_text(n)//" bytes"
         end if
         call c_free(address)
      else
         select case (code)
         case (is_directory); message = "it is a directory"
         case (is_no_file); message = "it is a pipe or a device, not a file"
         case (is_too_large)
            message = "it is too large: more than "//to_text(most)//" bytes"
            if (n > most .and. stream == 0) message = "it is too large: "//to_text(n)//" bytes, the limit is "//to_text(most)
         case (no_entry); message = "no such file"
         case default; message = system_message(int(code))
         end select
      end if
      if (.not. allocated(bytes)) bytes = ""
   end subroutine read_file

   !> An error number as text.
   function system_message(code) result(message)
      integer, intent(in) :: code            !! error number
      character(:), allocatable :: message   !! what it means

      character(kind=c_char) :: text(256)
      integer :: i

      call c_error_text(int(code, c_int), text, size(text, kind=c_int))
      message = ""
      do i = 1, size(text)
         if (text(i) == c_null_char) exit
         message = message//text(i)
      end do
   end function system_message

end module system_file
