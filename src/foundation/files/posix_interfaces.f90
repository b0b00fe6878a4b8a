!> The functions of posix_calls.c and of the C library as Fortran sees them. Use module posix instead.
module posix_interfaces
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int8_t, c_int64_t
   implicit none (type, external)
   private
   public :: c_close, c_getpid, c_host_name, c_is_alive, c_is_link, c_isatty, c_list, c_lock, c_make_directory, c_own_path
   public :: c_path_kind, c_processors, c_random, c_real_path, c_release, c_remove_file, c_remove_within, c_rename
   public :: c_cut, c_free_space, c_reserve, c_setenv, c_sync, c_utc_time, c_write_at, c_write_open

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
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_real_path

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

      integer(c_int) function c_is_link(path) bind(c, name="gudgeon_is_link")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) what to look at
      end function c_is_link

      integer(c_int) function c_list(directory, names, capacity, n) bind(c, name="gudgeon_list")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: directory(*)  !! (n) the directory
         character(kind=c_char), intent(out) :: names(*)     !! (capacity) names, each with its null character
         integer(c_int64_t), value :: capacity               !! characters there is storage for
         integer(c_int64_t), intent(out) :: n                !! characters of all names
      end function c_list

      integer(c_int) function c_remove_within(directory, path) bind(c, name="gudgeon_remove_within")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: directory(*)  !! (n) a directory
         character(kind=c_char), intent(in) :: path(*)       !! (n) path within it, of a directory with a slash at its end
      end function c_remove_within

      integer(c_int) function c_lock(path, make, file, is_locked) bind(c, name="gudgeon_lock")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)   !! (n) the file
         integer(c_int), value :: make                   !! 1: it is made if there is none
         integer(c_int), intent(out) :: file             !! its descriptor
         integer(c_int), intent(out) :: is_locked        !! 0: the file system knows no locks
      end function c_lock

      subroutine c_close(file) bind(c, name="gudgeon_close")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: file  !! descriptor
      end subroutine c_close

      integer(c_int) function c_is_alive(process) bind(c, name="gudgeon_is_alive")
         import :: c_int, c_int64_t
         implicit none (type, external)
         integer(c_int64_t), value :: process  !! number of a process of this machine
      end function c_is_alive

      integer(c_int) function c_getpid() bind(c, name="getpid")
         import :: c_int
         implicit none (type, external)
      end function c_getpid

      integer(c_int) function c_sync(path) bind(c, name="gudgeon_sync")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) file or directory
      end function c_sync

      subroutine c_random(bytes, n) bind(c, name="gudgeon_random")
         import :: c_int, c_int8_t
         implicit none (type, external)
         integer(c_int8_t), intent(out) :: bytes(*)  !! (n) the bytes
         integer(c_int), value :: n                  !! how many
      end subroutine c_random

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

      integer(c_int) function c_cut(path, length) bind(c, name="gudgeon_cut")
         import :: c_char, c_int, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) file
         integer(c_int64_t), value :: length            !! bytes that stay
      end function c_cut

      integer(c_int64_t) function c_free_space(path) bind(c, name="gudgeon_free_space")
         import :: c_char, c_int64_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) any path on the file system
      end function c_free_space

      subroutine c_release(path) bind(c, name="gudgeon_release")
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)  !! (n) file
      end subroutine c_release

      subroutine c_utc_time(text, capacity) bind(c, name="gudgeon_utc_time")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: text(*)  !! (capacity) the time
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_utc_time

      subroutine c_host_name(name, capacity) bind(c, name="gudgeon_host_name")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: name(*)  !! (capacity) name of this machine
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_host_name

      integer(c_int) function c_processors() bind(c, name="gudgeon_processors")
         import :: c_int
         implicit none (type, external)
      end function c_processors

      subroutine c_own_path(path, capacity) bind(c, name="gudgeon_own_path")
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: path(*)  !! (capacity) the file
         integer(c_int), value :: capacity               !! characters there is storage for
      end subroutine c_own_path

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
