!> The libraries that the program runs on, with their versions.
module libraries
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   use hdf5, only: h5get_libversion_f
   use hdf5_calls, only: open_library
   use text, only: to_text
   implicit none (type, external)
   private
   public :: library_versions

   interface
      !> Version of LAPACK.
      subroutine ilaver(major, minor, patch)
         implicit none (type, external)
         integer, intent(out) :: major  !! major version
         integer, intent(out) :: minor  !! minor version
         integer, intent(out) :: patch  !! patch
      end subroutine ilaver

      !> Version of SUNDIALS.
      function sundials_get_version(version, length) bind(c, name="SUNDIALSGetVersion") result(status)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(out) :: version(*)  !! text, ended by NUL
         integer(c_int), value :: length                    !! workspace in it
         integer(c_int) :: status                           !! 0: done
      end function sundials_get_version
   end interface

contains

   !> Names and versions on one line.
   function library_versions() result(line)
      character(:), allocatable :: line  !! as `LAPACK 3.11.0, SUNDIALS 6.4.1, HDF5 1.10.8`

      character(kind=c_char) :: version(32)
      integer :: k, major, minor, patch, status

      call ilaver(major, minor, patch)
      line = "LAPACK "//to_text(major)//"."//to_text(minor)//"."//to_text(patch)//", SUNDIALS "
      version = c_null_char
      if (sundials_get_version(version, int(size(version), c_int)) == 0) then
         do k = 1, size(version)
            if (version(k) == c_null_char) exit
            line = line//version(k)
         end do
      end if
      status = 0
      call open_library(status)
      call h5get_libversion_f(major, minor, patch, status)
      line = line//", HDF5 "//to_text(major)//"."//to_text(minor)//"."//to_text(patch)
   end function library_versions

end module libraries
