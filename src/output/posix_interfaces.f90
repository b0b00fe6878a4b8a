!> The functions of posix_calls.c, decimal.c and of the C library as Fortran sees them. Use module posix instead.
module posix_interfaces
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int64_t
   implicit none (type, external)
   private
   public :: c_error_text, c_host_name, c_is_empty, c_isatty
   public :: c_lock, c_make_directory, c_path_kind, c_real_path, c_release, c_remove_file
   public :: c_remove_tree, c_rename, c_reserve, c_setenv, c_start_program, c_unlock, c_utc_time
   public :: c_own_path, c_processors, c_wait_any, c_wait_program, c_write_at, c_write_open

   ! allow(assumed-size, assumed-size-character-intent)
   interface
      integer(c_int) function c_path_kind(path) bind(c, name="gudgeon_path_kind")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) what to look at
      end function c_path_kind

      integer(c_int) function c_make_directory(path) bind(c, name="gudgeon_make_directory")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) directory to be
      end function c_make_directory

      subroutine c_real_path(path, real, capacity) bind(c, name="gudgeon_real_path")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)   !! (n) any path
         character(kind=c_char), intent(out) :: real(*)  !! (capacity) the path behind links
         integer(c_int), value :: capacity               !! characters there is room for
      end subroutine c_real_path

      integer(c_int) function c_is_empty(path) bind(c, name="gudgeon_is_empty_directory")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) directory
      end function c_is_empty

      integer(c_int) function c_remove_tree(path) bind(c, name="gudgeon_remove_tree")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) directory
      end function c_remove_tree

      integer(c_int) function c_remove_file(path) bind(c, name="gudgeon_remove_file")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) file
      end function c_remove_file

      integer(c_int) function c_rename(from, to) bind(c, name="gudgeon_rename")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: from(*)  !! (n) old name
         character(kind=c_char), intent(in) :: to(*)    !! (n) new name
      end function c_rename

      integer(c_int) function c_lock(path, file, holder) bind(c, name="gudgeon_lock")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)   !! (n) lock file
         integer(c_int), intent(out) :: file             !! descriptor of the lock file
         integer(c_int64_t), intent(out) :: holder       !! process that holds the lock, 0 if not known
      end function c_lock

      subroutine c_unlock(path, file) bind(c, name="gudgeon_unlock")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) lock file
         integer(c_int), value :: file                  !! its descriptor
      end subroutine c_unlock

      integer(c_int) function c_write_at(path, bytes, n, offset) bind(c, name="gudgeon_write_at")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)   !! (n) file
         character(kind=c_char), intent(in) :: bytes(*)  !! (n) what to write
         integer(c_int64_t), value :: n                  !! number of bytes
         integer(c_int64_t), value :: offset             !! where to, 0 makes the file anew
      end function c_write_at

      integer(c_int) function c_write_open(file, bytes, n) bind(c, name="gudgeon_write_open")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         integer(c_int), value :: file                   !! descriptor
         character(kind=c_char), intent(in) :: bytes(*)  !! (n) what to write
         integer(c_int64_t), value :: n                  !! number of bytes
      end function c_write_open

      integer(c_int) function c_reserve(path, n) bind(c, name="gudgeon_reserve")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) file
         integer(c_int64_t), value :: n                 !! bytes behind its end
      end function c_reserve

      subroutine c_release(path) bind(c, name="gudgeon_release")
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) file
      end subroutine c_release

      subroutine c_utc_time(text, capacity) bind(c, name="gudgeon_utc_time")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: text(*)  !! (capacity) the time
         integer(c_int), value :: capacity               !! characters there is room for
      end subroutine c_utc_time

      subroutine c_error_text(code, text, capacity) bind(c, name="gudgeon_error_text")
         import :: c_char, c_int
         implicit none (type, external)
         integer(c_int), value :: code                   !! error number
         character(kind=c_char), intent(out) :: text(*)  !! (capacity) what it means
         integer(c_int), value :: capacity               !! characters there is room for
      end subroutine c_error_text

      subroutine c_host_name(name, capacity) bind(c, name="gudgeon_host_name")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: name(*)  !! (capacity) name of this machine
         integer(c_int), value :: capacity               !! characters there is room for
      end subroutine c_host_name

      integer(c_int) function c_start_program(directory, program, arguments, n_arguments, log, process) &
         bind(c, name="gudgeon_start_program")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: directory(*)  !! (n) where it runs
         character(kind=c_char), intent(in) :: program(*)    !! (n) its name, found along PATH
         character(kind=c_char), intent(in) :: arguments(*)  !! (n) arguments, each with its null character
         integer(c_int), value :: n_arguments                !! number of arguments
         character(kind=c_char), intent(in) :: log(*)        !! (n) file for its messages
         integer(c_int), intent(out) :: process              !! its number
      end function c_start_program

      integer(c_int) function c_wait_any(code) bind(c, name="gudgeon_wait_any")
         import :: c_int
         implicit none (type, external)
         integer(c_int), intent(out) :: code  !! exit code
      end function c_wait_any

      integer(c_int) function c_processors() bind(c, name="gudgeon_processors")
         import :: c_int
         implicit none (type, external)
      end function c_processors

      subroutine c_own_path(path, capacity) bind(c, name="gudgeon_own_path")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: path(*)  !! (capacity) the file
         integer(c_int), value :: capacity               !! characters there is room for
      end subroutine c_own_path

      integer(c_int) function c_wait_program(process) bind(c, name="gudgeon_wait_program")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: process  !! number of the process
      end function c_wait_program

      integer(c_int) function c_isatty(file) bind(c, name="isatty")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: file  !! descriptor
      end function c_isatty

      integer(c_int) function c_setenv(name, setting, overwrite) bind(c, name="setenv")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: name(*)     !! (n) environment variable
         character(kind=c_char), intent(in) :: setting(*)  !! (n) its value
         integer(c_int), value :: overwrite                !! 0: not if it is set already
      end function c_setenv
   end interface

end module posix_interfaces
