!> The points of a curve as they stand in a file of the run, row by row.
!>
!> Files of the run hold numbers in columns of equal width, with 17 digits, which read back to the same numbers (`text_table`).
module row_reader
   use decimal_text, only: decimal_width
   use errors, only: error_t, exit_file, set_error
   use figure_data, only: curve_t
   use kinds, only: wp
   use text, only: to_text
   use text_file, only: fail_file
   implicit none (type, external)
   private
   public :: row_reader_t

   !> The open file.
   type :: row_reader_t
      private
      character(:), allocatable :: path   !! where it is
      character(:), allocatable :: form   !! of a row: both numbers at their places
      integer :: unit = 0                 !! its unit
   contains
      procedure :: open => open_file
      procedure :: next
      procedure :: close => close_file
   end type row_reader_t

contains

   !> Open the file of a curve, before its first row.
   subroutine open_file(self, folder, curve, error)
      class(row_reader_t), intent(inout) :: self         !! the file
      character(*), intent(in) :: folder                 !! of the figures
      type(curve_t), intent(in) :: curve                 !! the curve
      type(error_t), allocatable, intent(out) :: error   !! it cannot be read

      character :: first
      integer :: status

      self%path = folder//"/"//curve%path
      self%form = "(t"//to_text(1 + decimal_width*(curve%x - 1))//", es24.16, t"// &
                  to_text(1 + decimal_width*(curve%y - 1))//", es24.16)"
      open (newunit=self%unit, file=self%path, status="old", action="read", iostat=status)
      if (status /= 0) then
         call fail_file(error, "cannot read", self%path, status, "")
         return
      end if
      do
         read (self%unit, "(a)", iostat=status) first
         if (status /= 0) exit
         if (first /= "#") exit
      end do
      if (status == 0) backspace (self%unit, iostat=status)
      if (status == 0) return
      call fail(self, error)
   end subroutine open_file

   !> The next row.
   subroutine next(self, point, error)
      class(row_reader_t), intent(inout) :: self         !! the file
      real(wp), intent(out) :: point(2)                  !! (2) abscissa, ordinate, SI [any]
      type(error_t), allocatable, intent(out) :: error   !! there is none

      integer :: status

      read (self%unit, self%form, iostat=status) point
      if (status /= 0) call fail(self, error)
   end subroutine next

   !> The file is not as the run wrote it.
   subroutine fail(self, error)
      class(row_reader_t), intent(inout) :: self         !! the file, closed
      type(error_t), allocatable, intent(out) :: error   !! says so

      call self%close()
      call set_error(error, exit_file, "cannot draw "//self%path//": it has fewer rows than the run wrote")
   end subroutine fail

   !> Close the file.
   subroutine close_file(self)
      class(row_reader_t), intent(inout) :: self         !! the file

      close (self%unit)
   end subroutine close_file

end module row_reader
