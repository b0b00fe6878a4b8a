!> Rows of numbers in a text file, one line after the other: a Fortran unit takes ten times as long to read them.
!>
!> Lines that are blank or start with `#` are passed over.
module number_rows
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_int, c_null_char, c_null_ptr, c_ptr
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: number_rows_t

   !> A file that is being read.
   type :: number_rows_t
      type(c_ptr), private :: handle = c_null_ptr   !! of the open file
   contains
      procedure :: open => open_rows
      procedure :: next => next_row
      procedure :: close => close_rows
   end type number_rows_t

   ! allow(assumed-size)
   interface
      type(c_ptr) function c_open_rows(path) bind(c, name="gudgeon_open_rows")
         import :: c_char, c_ptr
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)   !! (n) the file
      end function c_open_rows

      integer(c_int) function c_next_row(handle, n, row) bind(c, name="gudgeon_next_row")
         import :: c_double, c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: handle                    !! of the open file
         integer(c_int), value :: n                      !! numbers that are requested
         real(c_double), intent(inout) :: row(*)         !! (n) the numbers [any]
      end function c_next_row

      subroutine c_close_rows(handle) bind(c, name="gudgeon_close_rows")
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: handle                    !! of the open file
      end subroutine c_close_rows
   end interface

contains

   !> Open a file; .false.: it cannot be read.
   logical function open_rows(self, path) result(is_open)
      class(number_rows_t), intent(inout) :: self  !! the file, not open
      character(*), intent(in) :: path             !! where it is

      self%handle = c_open_rows(path//c_null_char)
      is_open = c_associated(self%handle)
   end function open_rows

   !> The next row; .false.: there is none that has as many numbers.
   logical function next_row(self, row) result(is_there)
      class(number_rows_t), intent(inout) :: self        !! the open file
      real(wp), intent(inout), contiguous :: row(:)      !! (n) the first numbers of the line [any]

      is_there = c_next_row(self%handle, size(row, kind=c_int), row) == size(row)
   end function next_row

   !> Close the file.
   subroutine close_rows(self)
      class(number_rows_t), intent(inout) :: self  !! the open file

      if (c_associated(self%handle)) call c_close_rows(self%handle)
      self%handle = c_null_ptr
   end subroutine close_rows

end module number_rows
