!> Members: copies of this process that work on a task of their own and hand back what they found, from member_calls.c.
!>
!> A copy starts with all that was read and built before. What it does to its memory, and how it ends, do not touch this
!> process; it ends with it. No file of HDF5 may be open when one is made.
module members
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int, c_int64_t, c_null_char, c_ptr
   use kinds, only: wp
   use posix, only: from_c, own_path
   implicit none (type, external)
   private
   public :: cpu_of_all, hand_back, next_member, program_identity, stamp_of, start_member

   integer, parameter :: capacity = 256  !! of short texts

   ! allow(assumed-size, assumed-size-character-intent)
   interface
      integer(c_int) function c_start_member(log, process) bind(c, name="gudgeon_start_member")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: log(*)  !! (n) file for its messages
         integer(c_int), intent(inout) :: process      !! its number; 0 in the copy
      end function c_start_member

      integer(c_int) function c_hand_back(bytes, n) bind(c, name="gudgeon_hand_back")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: bytes(*)  !! (n) what is handed back
         integer(c_int64_t), value :: n                  !! number of bytes
      end function c_hand_back

      integer(c_int) function c_next_member(code, bytes, n) bind(c, name="gudgeon_next_member")
         import :: c_int, c_int64_t, c_ptr
         implicit none (type, external)
         integer(c_int), intent(out) :: code      !! exit code
         type(c_ptr), intent(out) :: bytes        !! what was handed back, to be freed
         integer(c_int64_t), intent(out) :: n     !! number of bytes
      end function c_next_member

      real(c_double) function c_cpu_of_all() bind(c, name="gudgeon_cpu_of_all")
         import :: c_double
         implicit none (type, external)
      end function c_cpu_of_all

      subroutine c_stamp(path, text, capacity) bind(c, name="gudgeon_stamp")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)   !! (n) the file
         character(kind=c_char), intent(out) :: text(*)  !! (capacity) by what it is known
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_stamp

      subroutine c_build_id(text, capacity) bind(c, name="gudgeon_build_id")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: text(*)  !! (capacity) hexadecimal digits
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_build_id

      subroutine c_free(bytes) bind(c, name="free")
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: bytes  !! memory of C
      end subroutine c_free
   end interface

contains

   !> Start a member. Both processes return from here.
   integer function start_member(log, process) result(code)
      character(*), intent(in) :: log    !! file for its messages
      integer, intent(out) :: process    !! its number; 0: this is the copy

      integer(c_int) :: number

      number = -1
      code = c_start_member(log//c_null_char, number)
      process = number
   end function start_member

   !> In a member: hand bytes back.
   integer function hand_back(bytes) result(code)
      character(*), intent(in) :: bytes  !! what it found

      code = c_hand_back(bytes, len(bytes, c_int64_t))
   end function hand_back

   !> Wait for whichever member ends next.
   subroutine next_member(process, code, bytes)
      integer, intent(out) :: process                    !! its number; 0: none runs
      integer, intent(out) :: code                       !! its exit code, 128 + signal if one ended it
      character(:), allocatable, intent(out) :: bytes    !! what it handed back

      character(kind=c_char), pointer :: store(:)
      type(c_ptr) :: address
      integer(c_int64_t) :: i, n

      code = 0
      process = c_next_member(code, address, n)
      if (process == 0) n = 0
      allocate (character(n) :: bytes)
      if (process == 0) return
      if (.not. c_associated(address)) return
      call c_f_pointer(address, store, [n])
      do i = 1, n
         bytes(i:i) = store(i)
      end do
      call c_free(address)
   end subroutine next_member

   !> Processor time of this process and of all that it waited for.
   real(wp) function cpu_of_all() result(t)
      t = real(c_cpu_of_all(), wp)  ! [s]
   end function cpu_of_all

   !> By what a file is known not to have been changed: size and time of writing; blank: there is none.
   function stamp_of(path) result(stamp)
      character(*), intent(in) :: path         !! of the file
      character(:), allocatable :: stamp       !! its stamp

      character(kind=c_char) :: text(capacity)

      call c_stamp(path//c_null_char, text, size(text, kind=c_int))
      stamp = from_c(text)
   end function stamp_of

   !> By what this program is known: its content where the linker reports of it, else the file that it is.
   function program_identity() result(identity)
      character(:), allocatable :: identity    !! one line

      character(kind=c_char) :: text(capacity)

      call c_build_id(text, size(text, kind=c_int))
      identity = from_c(text)
      if (len(identity) == 0) identity = stamp_of(own_path())
   end function program_identity

end module members
