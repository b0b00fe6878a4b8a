!> How the program starts and ends, and the programs that it starts, from process_calls.c.
!>
!> Functions return 0 or the system's error number. No function starts a shell.
module processes
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int64_t, c_null_char
   use kinds, only: i8
   use text, only: text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: asked_by, begin_process, clock_ms, end_by, end_process, listen, start_program, take_memory, wait_group

   ! allow(assumed-size)
   interface
      !> Open descriptors, and failed writes instead of signals; before anything else.
      subroutine begin_process() bind(c, name="gudgeon_begin")
         implicit none (type, external)
      end subroutine begin_process

      !> Have at once the memory that the smallest run fills.
      subroutine take_memory() bind(c, name="gudgeon_take_memory")
         implicit none (type, external)
      end subroutine take_memory

      subroutine c_end(code) bind(c, name="gudgeon_end")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: code  !! exit code
      end subroutine c_end

      subroutine c_listen(is_on) bind(c, name="gudgeon_listen")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: is_on  !! 1: from here on, 0: no longer
      end subroutine c_listen

      integer(c_int) function c_asked_by() bind(c, name="gudgeon_asked_by")
         import :: c_int
         implicit none (type, external)
      end function c_asked_by

      subroutine c_end_by(number) bind(c, name="gudgeon_end_by")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: number  !! of the signal
      end subroutine c_end_by

      integer(c_int) function c_start_program(directory, program, arguments, n_arguments, log, is_group, process) &
         bind(c, name="gudgeon_start_program")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: directory(*)  !! (n) where it runs
         character(kind=c_char), intent(in) :: program(*)    !! (n) its name, found along PATH
         character(kind=c_char), intent(in) :: arguments(*)  !! (n) arguments, each with its null character
         integer(c_int), value :: n_arguments                !! number of arguments
         character(kind=c_char), intent(in) :: log(*)        !! (n) file for its messages
         integer(c_int), value :: is_group                   !! 1: a group of its own, which ends with this process
         integer(c_int), intent(out) :: process              !! its number
      end function c_start_program

      integer(c_int) function c_wait_group(process, until, is_late) bind(c, name="gudgeon_wait_group")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int), value :: process         !! number of the process
         integer(c_int64_t), value :: until       !! instant on the clock of `c_clock_ms` [ms]
         integer(c_int), intent(out) :: is_late   !! 1: it was ended
      end function c_wait_group

      integer(c_int64_t) function c_clock_ms() bind(c, name="gudgeon_clock_ms")
         import :: c_int64_t
         implicit none (type, external)
      end function c_clock_ms
   end interface

contains

   !> End the program.
   subroutine end_process(code)
      integer, intent(in) :: code  !! exit code

      call c_end(int(code, c_int))
   end subroutine end_process

   !> Let signals that would end the program (TERM, INT, HUP, USR1) ask for it instead, once; or no longer.
   subroutine listen(is_on)
      logical, intent(in) :: is_on  !! from here on, or no longer

      call c_listen(merge(1_c_int, 0_c_int, is_on))
   end subroutine listen

   !> The signal that asked the program to end, 0: none did.
   integer function asked_by()
      asked_by = c_asked_by()
   end function asked_by

   !> End by a signal that asked: whoever waits for the program learns what ended it.
   subroutine end_by(number)
      integer, intent(in) :: number  !! of the signal

      call c_end_by(int(number, c_int))
   end subroutine end_by

   !> A clock that only goes forward.
   integer(i8) function clock_ms()
      clock_ms = c_clock_ms()
   end function clock_ms

   !> Start a program without a shell.
   integer function start_program(directory, program, arguments, log, is_group, process) result(code)
      character(*), intent(in) :: directory    !! where it runs
      character(*), intent(in) :: program      !! its name, found along PATH
      type(text_t), intent(in) :: arguments(:) !! (n) its arguments
      character(*), intent(in) :: log          !! file for its messages, in the directory
      logical, intent(in) :: is_group          !! whether it is for `wait_group`, with all that it may start
      integer, intent(out) :: process          !! its number

      type(buffer_t) :: list
      integer :: k

      process = 0
      do k = 1, size(arguments)
         call list%add(arguments(k)%s//c_null_char)
      end do
      code = c_start_program(directory//c_null_char, program//c_null_char, list%get()//c_null_char, size(arguments), &
                             log//c_null_char, merge(1_c_int, 0_c_int, is_group), process)
   end function start_program

   !> Wait for a program up to an instant, then end it with all that it started; its exit code.
   integer function wait_group(process, until, is_late) result(code)
      integer, intent(in) :: process     !! its number
      integer(i8), intent(in) :: until   !! instant on the clock of `clock_ms` [ms]
      logical, intent(out) :: is_late    !! whether it had to be ended

      integer(c_int) :: late

      code = c_wait_group(process, until, late)
      is_late = late /= 0
   end function wait_group

end module processes
