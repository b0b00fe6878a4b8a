!> Checksums of rows and of files (checksum_calls.c), and attempts in a copy of this process at what may end it.
!>
!> A file that is whole carries the sum of its bytes in its last line. A library that reads it finds that line behind its data and
!> ignores it.
module checksum
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int64_t, c_int8_t, c_null_char
   use kinds, only: i8
   use processes, only: end_process
   implicit none (type, external)
   private
   public :: add_rows, identity_of, seal_file, seal_none, seal_right, seal_state, seal_unread, seal_wrong, survives

   integer, parameter :: seal_none = 0     !! the file has no checksum
   integer, parameter :: seal_right = 1    !! it has the right one
   integer, parameter :: seal_wrong = 2    !! it was changed after it was written
   integer, parameter :: seal_unread = 3   !! it cannot be read

   integer(c_int), parameter :: min_seconds = 20_c_int           !! of processor time for an attempt
   integer(i8), parameter :: bytes_per_second = 10000000_i8        !! of the file, for longer ones
   integer(i8), parameter :: min_bytes = 1000000000_i8           !! of memory for an attempt
   integer(i8), parameter :: bytes_per_byte = 16_i8                !! of the file, for larger ones

   abstract interface
      !> Whether something can be done with a file.
      logical function attempt_t(path)
         implicit none (type, external)
         character(*), intent(in) :: path   !! the file
      end function attempt_t
   end interface

   ! allow(assumed-size, assumed-size-character-intent)
   interface
      subroutine c_add_rows(sum, bytes, n_rows, width) bind(c, name="gudgeon_add_rows")
         import :: c_int64_t, c_int8_t
         implicit none (type, external)
         integer(c_int64_t), intent(inout) :: sum      !! so far
         integer(c_int8_t), intent(in) :: bytes(*)     !! (n_rows width) the rows
         integer(c_int64_t), value :: n_rows           !! how many
         integer(c_int64_t), value :: width            !! bytes of a row
      end subroutine c_add_rows

      integer(c_int) function c_seal(path) bind(c, name="gudgeon_seal")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) the file
      end function c_seal

      integer(c_int) function c_seal_state(path) bind(c, name="gudgeon_seal_state")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) the file
      end function c_seal_state

      integer(c_int) function c_begin_attempt(seconds, bytes) bind(c, name="gudgeon_begin_attempt")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int), value :: seconds      !! of processor time
         integer(c_int64_t), value :: bytes    !! of memory
      end function c_begin_attempt

      integer(c_int) function c_end_attempt(process) bind(c, name="gudgeon_end_attempt")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: process      !! number of the copy
      end function c_end_attempt

      integer(c_int64_t) function c_size_of(path) bind(c, name="gudgeon_size_of")
         import :: c_char, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) the file
      end function c_size_of

      integer(c_int) function c_identity(path, identity) bind(c, name="gudgeon_identity")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)      !! (n) the file
         integer(c_int64_t), intent(inout) :: identity(*)   !! (2) its number and its bytes
      end function c_identity
   end interface

contains

   !> Continue with a sum by rows; it does not depend on how rows come together.
   subroutine add_rows(sum, bytes, width)
      integer(i8), intent(inout) :: sum             !! so far
      integer(c_int8_t), intent(in) :: bytes(:)     !! (n width) the rows
      integer, intent(in) :: width                  !! bytes of a row

      if (width > 0) call c_add_rows(sum, bytes, int(size(bytes)/width, c_int64_t), int(width, c_int64_t))
   end subroutine add_rows

   !> Give a file that is whole its checksum: 0, or the system's error number.
   integer function seal_file(path) result(code)
      character(*), intent(in) :: path   !! the file

      code = c_seal(path//c_null_char)
   end function seal_file

   !> Whether a file carries its checksum, and the right one: one of `seal_...`.
   integer function seal_state(path) result(state)
      character(*), intent(in) :: path   !! the file

      state = c_seal_state(path//c_null_char)
   end function seal_state

   !> Which file a path names: its number in the file system, and its bytes; 0 if there is none.
   function identity_of(path) result(identity)
      character(*), intent(in) :: path   !! the file
      integer(i8) :: identity(2)         !! number and bytes

      identity = 0
      if (c_identity(path//c_null_char, identity) /= 0) identity = 0
   end function identity_of

   !> Whether something can be done with a file, by doing it in a copy of this process: a library that a damaged file makes crash,
   !> or keeps busy for ever, ends that only.
   logical function survives(attempt, path)
      procedure(attempt_t) :: attempt      !! what is done
      character(*), intent(in) :: path     !! the file

      integer(i8) :: bytes
      integer(c_int) :: process

      bytes = max(0_i8, c_size_of(path//c_null_char))
      process = c_begin_attempt(max(min_seconds, int(min(100000_i8, bytes/bytes_per_second), c_int)), &
                                max(min_bytes, bytes_per_byte*bytes))
      if (process == 0) call end_process(merge(0, 1, attempt(path)))
      survives = .true.  ! no copy can be made: it is done here
      if (process > 0) survives = c_end_attempt(process) == 0
   end function survives

end module checksum
