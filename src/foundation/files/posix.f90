!> What the writers need of the operating system, from posix_calls.c.
!>
!> Functions return 0 or the system's error number, which `system_message` puts into words.
!> Paths go out with a null character at their end.
module posix
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int8_t, c_null_char
   use kinds, only: i8
   use posix_interfaces, only: c_close, c_getpid, c_host_name, c_is_alive, c_is_link, c_isatty, c_list, c_lock
   use posix_interfaces, only: c_make_directory, c_own_path, c_path_kind, c_processors, c_random, c_real_path, c_release
   use posix_interfaces, only: c_cut, c_free_space, c_remove_file, c_remove_within, c_rename
   use posix_interfaces, only: c_reserve, c_setenv, c_sync, c_utc_time
   use posix_interfaces, only: c_write_at, c_write_open
   use system_file, only: system_message
   use text, only: printable, text_t
   implicit none (type, external)
   private
   public :: close_file, from_c, host_name, is_alive, is_busy, is_directory, is_link, is_missing, is_pipe_gone
   public :: is_terminal, list_directory, lock_file, make_directory, n_processors, own_path, path_exists, process_number
   public :: cut_file, draw_error, free_space
   public :: random_name, real_path, release_space, remove_file, remove_within, rename_path, reserve_space, set_default_variable
   public :: sync_path, system_message, utc_time, write_at, write_error, write_output

   integer, parameter :: longest_text = 4096     !! longest path that comes back
   integer(c_int), parameter :: no_entry = 2     !! ENOENT, the same on every Unix
   integer(c_int), parameter :: broken_pipe = 32 !! EPIPE, the same on every Unix
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

   !> Whether a path names a symbolic link, which may lead nowhere.
   logical function is_link(path)
      character(*), intent(in) :: path  !! what to look at

      is_link = c_is_link(path//c_null_char) == 1
   end function is_link

   !> What a directory holds; names of directories end with a slash, links are not followed.
   subroutine list_directory(path, names, code)
      character(*), intent(in) :: path                      !! the directory
      type(text_t), allocatable, intent(out) :: names(:)    !! (n) names, in no order
      integer, intent(out) :: code                          !! 0, or the system's error number

      character(:), allocatable :: list
      integer(i8) :: n, room
      integer :: first, k, last

      room = 4096
      do
         if (allocated(list)) deallocate (list)
         allocate (character(room) :: list)
         code = c_list(path//c_null_char, list, room, n)
         if (code /= 0 .or. n < room - 1) exit
         room = 2*n
      end do
      if (code /= 0) n = 0
      last = 0
      do k = 1, int(n)
         if (list(k:k) == c_null_char) last = last + 1
      end do
      allocate (names(last))
      first = 1
      do k = 1, size(names)
         last = first + index(list(first:n), c_null_char) - 2
         names(k)%s = list(first:last)
         first = last + 2
      end do
   end subroutine list_directory

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

   !> Remove what a path within a directory names, an empty directory if it ends with a slash; no link on the way is followed.
   integer function remove_within(directory, path) result(code)
      character(*), intent(in) :: directory  !! the directory
      character(*), intent(in) :: path       !! path within it

      code = c_remove_within(directory//c_null_char, path//c_null_char)
   end function remove_within

   !> Open a file and take its lock, which ends with this process at the latest; nothing in it is changed, no link is followed.
   integer function lock_file(path, make, file, is_locked) result(code)
      character(*), intent(in) :: path     !! the file
      logical, intent(in) :: make          !! whether it is made if there is none
      integer, intent(out) :: file         !! its descriptor, for `close_file`
      logical, intent(out) :: is_locked    !! .false.: the file system knows no locks

      integer(c_int) :: locked

      file = -1
      locked = 0
      code = c_lock(path//c_null_char, merge(1_c_int, 0_c_int, make), file, locked)
      is_locked = locked /= 0
   end function lock_file

   !> Close a file, which gives its lock back.
   subroutine close_file(file)
      integer, intent(in) :: file  !! descriptor

      call c_close(int(file, c_int))
   end subroutine close_file

   !> Whether a process of this machine lives.
   logical function is_alive(process)
      integer(i8), intent(in) :: process  !! its number

      is_alive = c_is_alive(process) == 1
   end function is_alive

   !> Number of this process.
   integer(i8) function process_number()
      process_number = int(c_getpid(), i8)
   end function process_number

   !> Hand a file's content, or a directory's names, to the disk.
   integer function sync_path(path) result(code)
      character(*), intent(in) :: path  !! file or directory

      code = c_sync(path//c_null_char)
   end function sync_path

   !> A name that nobody else has: 32 hexadecimal digits.
   function random_name() result(name)
      character(32) :: name  !! the digits

      integer(c_int8_t) :: bytes(16)

      call c_random(bytes, size(bytes, kind=c_int))
      write (name, "(16z2.2)") bytes
   end function random_name

   !> Write text at an offset of a file; if that fails the file ends at the offset.
   integer function write_at(path, text, offset) result(code)
      character(*), intent(in) :: path     !! the file
      character(*), intent(in) :: text     !! what to write
      integer(i8), intent(in) :: offset    !! bytes that stay in front of it, 0: a new file

      code = c_write_at(path//c_null_char, text, len(text, i8), offset)
   end function write_at

   !> Write text to the standard output, unlike Fortran's with an error if that is full. Control characters, as those of a title in
   !> a deck, are made visible: all that a terminal is given goes through here or `write_error`.
   integer function write_output(text) result(code)
      character(*), intent(in) :: text  !! what to write

      integer(c_int), parameter :: standard_output = 1

      code = c_write_open(standard_output, printable(text), len(text, i8))
   end function write_output

   !> Write text to the standard error, control characters made visible; if nobody reads it or it is full, there is nobody to
   !> report.
   subroutine write_error(text)
      character(*), intent(in) :: text  !! what to write

      call draw_error(printable(text))
   end subroutine write_error

   !> Write what the program itself draws on the standard error, as it is: a bar that goes back to the start of its line.
   subroutine draw_error(text)
      character(*), intent(in) :: text  !! what to write, nothing of a deck or a file in it

      integer(c_int), parameter :: standard_error = 2
      integer(c_int) :: ignored

      ignored = c_write_open(standard_error, text, len(text, i8))
   end subroutine draw_error

   !> Reserve space behind the end of a file.
   integer function reserve_space(path, n) result(code)
      character(*), intent(in) :: path  !! the file
      integer(i8), intent(in) :: n      !! bytes

      code = c_reserve(path//c_null_char, n)
   end function reserve_space

   !> Cut a file off at a length that it must have.
   integer function cut_file(path, length) result(code)
      character(*), intent(in) :: path      !! the file
      integer(i8), intent(in) :: length     !! bytes that stay

      code = c_cut(path//c_null_char, length)
   end function cut_file

   !> Bytes that are free where a path is; negative: not known.
   integer(i8) function free_space(path) result(n)
      character(*), intent(in) :: path      !! any path there

      n = c_free_space(path//c_null_char)
   end function free_space

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

   !> Whether an error number says that nobody reads what is written any more.
   pure logical function is_pipe_gone(code)
      integer, intent(in) :: code  !! error number

      is_pipe_gone = code == broken_pipe
   end function is_pipe_gone

   !> Name of this machine.
   function host_name() result(name)
      character(:), allocatable :: name  !! as the system knows it

      character(kind=c_char) :: text(256)

      call c_host_name(text, 256)
      name = from_c(text)
   end function host_name

   !> Processors that this process may use.
   integer function n_processors()
      n_processors = c_processors()
   end function n_processors

   !> The file that this process runs, blank if the system does not report.
   function own_path() result(path)
      character(:), allocatable :: path   !! absolute

      character(kind=c_char) :: text(longest_text)

      call c_own_path(text, longest_text)
      path = from_c(text)
   end function own_path

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
