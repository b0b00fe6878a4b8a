!> What the writers need of the operating system, from posix_calls.c and decimal.c.
!>
!> Functions return 0 or the system's error number, which `system_message` puts into words.
!> Paths go out with a null character at their end. No function starts a shell.
module posix
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   use, intrinsic :: iso_fortran_env, only: output_unit
   use kinds, only: i8, wp
   use posix_interfaces, only: c_error_text, c_host_name
   use posix_interfaces, only: c_is_empty, c_isatty, c_lock, c_make_directory, c_path_kind
   use posix_interfaces, only: c_real_path, c_release, c_remove_file, c_remove_tree, c_rename
   use posix_interfaces, only: c_reserve, c_setenv, c_start_program, c_unlock, c_utc_time
   use posix_interfaces, only: c_own_path, c_processors, c_wait_any, c_wait_program, c_write_at, c_write_open
   use text, only: buffer_t, text_t
   implicit none (type, external)
   private
   public :: n_processors, own_path, wait_any
   public :: host_name, is_busy, is_directory, is_empty_directory, is_missing
   public :: is_terminal, lock_file, make_directory, path_exists, real_path, remove_file, remove_tree
   public :: release_space, rename_path, reserve_space, set_default_variable, start_program, system_message
   public :: unlock_file, utc_time, wait_program, write_at, write_output

   integer, parameter :: longest_text = 4096     !! longest path that comes back
   integer(c_int), parameter :: no_entry = 2     !! ENOENT, the same on every Unix
   integer(c_int), parameter :: would_block = 11 !! EWOULDBLOCK of Linux
   integer(c_int), parameter :: bsd_would_block = 35  !! EWOULDBLOCK of the BSD family

contains

   !> Whether something of this name exists.
   logical function path_exists(path)
      character(*), intent(in) :: path  !! what to look for

      path_exists = c_path_kind(path//c_null_char) > 0
   end function path_exists

   !> Whether a path names a directory.
   logical function is_directory(path)
      character(*), intent(in) :: path  !! what to look at

      is_directory = c_path_kind(path//c_null_char) == 1
   end function is_directory

   !> Whether a directory holds nothing.
   logical function is_empty_directory(path)
      character(*), intent(in) :: path  !! the directory

      is_empty_directory = c_is_empty(path//c_null_char) == 1
   end function is_empty_directory

   !> Make a directory and those above it.
   integer function make_directory(path) result(code)
      character(*), intent(in) :: path  !! the directory

      code = c_make_directory(path//c_null_char)
   end function make_directory

   !> The path behind links; the path itself if it does not exist.
   function real_path(path) result(real)
      character(*), intent(in) :: path    !! any path
      character(:), allocatable :: real   !! absolute if it exists

      character(kind=c_char) :: text(longest_text)

      call c_real_path(path//c_null_char, text, longest_text)
      real = from_c(text)
   end function real_path

   !> Remove a directory with all it holds.
   integer function remove_tree(path) result(code)
      character(*), intent(in) :: path  !! the directory

      code = c_remove_tree(path//c_null_char)
   end function remove_tree

   !> Remove a file.
   integer function remove_file(path) result(code)
      character(*), intent(in) :: path  !! the file

      code = c_remove_file(path//c_null_char)
   end function remove_file

   !> Give a file or directory another name, replacing a file of that name.
   integer function rename_path(from, to) result(code)
      character(*), intent(in) :: from  !! old name
      character(*), intent(in) :: to    !! new name

      code = c_rename(from//c_null_char, to//c_null_char)
   end function rename_path

   !> Take a lock that ends with this process.
   integer function lock_file(path, file, holder) result(code)
      character(*), intent(in) :: path     !! lock file
      integer, intent(out) :: file         !! its descriptor, for `unlock_file`
      integer(i8), intent(out) :: holder   !! process that has the lock, 0 if not known

      code = c_lock(path//c_null_char, file, holder)
   end function lock_file

   !> Give a lock back and remove its file.
   subroutine unlock_file(path, file)
      character(*), intent(in) :: path  !! lock file
      integer, intent(in) :: file       !! its descriptor

      call c_unlock(path//c_null_char, file)
   end subroutine unlock_file

   !> Write text at an offset of a file; if that fails the file ends at the offset.
   integer function write_at(path, text, offset) result(code)
      character(*), intent(in) :: path     !! the file
      character(*), intent(in) :: text     !! what to write
      integer(i8), intent(in) :: offset    !! bytes that stay in front of it, 0: a new file

      code = c_write_at(path//c_null_char, text, len(text, i8), offset)
   end function write_at

   !> Write text to the standard output, unlike Fortran's with an error if that is full.
   integer function write_output(text) result(code)
      character(*), intent(in) :: text  !! what to write

      integer(c_int), parameter :: standard_output = 1

      flush (output_unit)
      code = c_write_open(standard_output, text, len(text, i8))
   end function write_output

   !> Reserve space behind the end of a file.
   integer function reserve_space(path, n) result(code)
      character(*), intent(in) :: path  !! the file
      integer(i8), intent(in) :: n      !! bytes

      code = c_reserve(path//c_null_char, n)
   end function reserve_space

   !> Give back space that was reserved and not used.
   subroutine release_space(path)
      character(*), intent(in) :: path  !! the file

      call c_release(path//c_null_char)
   end subroutine release_space

   !> Date and time of the world, ISO 8601.
   function utc_time() result(now)
      character(:), allocatable :: now  !! as `2026-01-31T23:59:59Z`

      character(kind=c_char) :: text(64)

      call c_utc_time(text, 64)
      now = from_c(text)
   end function utc_time

   !> An error number in words.
   function system_message(code) result(message)
      integer, intent(in) :: code            !! error number
      character(:), allocatable :: message   !! what it means

      character(kind=c_char) :: text(256)

      call c_error_text(code, text, 256)
      message = from_c(text)
   end function system_message

   !> Whether an error number says that another process holds a lock.
   pure logical function is_busy(code)
      integer, intent(in) :: code  !! error number

      is_busy = code == would_block .or. code == bsd_would_block
   end function is_busy

   !> Whether an error number says that there is no such file or program.
   pure logical function is_missing(code)
      integer, intent(in) :: code  !! error number

      is_missing = code == no_entry
   end function is_missing

   !> Name of this machine.
   function host_name() result(name)
      character(:), allocatable :: name  !! as the system knows it

      character(kind=c_char) :: text(256)

      call c_host_name(text, 256)
      name = from_c(text)
   end function host_name

   !> Start a program without a shell.
   integer function start_program(directory, program, arguments, log, process) result(code)
      character(*), intent(in) :: directory  !! where it runs
      character(*), intent(in) :: program    !! its name, found along PATH
      type(text_t), intent(in) :: arguments(:) !! (n) its arguments
      character(*), intent(in) :: log        !! file for its messages, in the directory
      integer, intent(out) :: process        !! its number, for `wait_program`

      type(buffer_t) :: list
      integer :: k

      process = 0
      do k = 1, size(arguments)
         call list%add(arguments(k)%s//c_null_char)
      end do
      code = c_start_program(directory//c_null_char, program//c_null_char, list%get()//c_null_char, size(arguments), &
                             log//c_null_char, process)
   end function start_program

   !> Wait for whichever program ends next; its number, 0 if none is running.
   integer function wait_any(code) result(process)
      integer, intent(out) :: code  !! its exit code, 128 + signal if one ended it

      code = 0
      process = c_wait_any(code)
   end function wait_any

   !> Processors that this process may use.
   integer function n_processors()
      n_processors = c_processors()
   end function n_processors

   !> The file that this process runs, blank if the system does not tell.
   function own_path() result(path)
      character(:), allocatable :: path   !! absolute

      character(kind=c_char) :: text(longest_text)

      call c_own_path(text, longest_text)
      path = from_c(text)
   end function own_path

   !> Wait for a program that was started; its exit code.
   integer function wait_program(process) result(code)
      integer, intent(in) :: process  !! its number

      code = c_wait_program(process)
   end function wait_program

   !> Whether a descriptor (1: output, 2: errors) is a terminal.
   logical function is_terminal(file)
      integer, intent(in) :: file  !! descriptor

      is_terminal = c_isatty(file) == 1
   end function is_terminal

   !> Set an environment variable of this process, unless it is set.
   subroutine set_default_variable(name, setting)
      character(*), intent(in) :: name     !! the variable
      character(*), intent(in) :: setting  !! its value

      integer :: code

      code = c_setenv(name//c_null_char, setting//c_null_char, 0)
   end subroutine set_default_variable

   !> The characters before the null character.
   pure function from_c(text) result(s)
      character(kind=c_char), intent(in) :: text(:)  !! (n) text of C
      character(:), allocatable :: s                 !! the same as one string

      integer :: i, n

      n = findloc(text, c_null_char, dim=1) - 1
      if (n < 0) n = size(text)
      allocate (character(n) :: s)
      do i = 1, n
         s(i:i) = text(i)
      end do
   end function from_c

end module posix
