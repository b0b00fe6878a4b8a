!> A table of a deck that is being written: rows of cells, columns aligned.
module deck_table
   use kinds, only: wp
   use text, only: real_text, text_t
   use text_buffer, only: buffer_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: deck_table_t, direction_cell, number_cell

   !> A table.
   type :: deck_table_t
      character(:), allocatable :: name         !! of the kind
      integer :: n_column = 0                   !! columns
      integer :: n_row = 0                      !! rows, with the header
      type(text_list_t) :: cells                !! (n_column n_row) row after row
   contains
      procedure :: start => start_table
      procedure :: add => add_row
      procedure :: write => write_table
   end type deck_table_t

contains

   !> Start a table.
   subroutine start_table(self, name, header)
      class(deck_table_t), intent(out) :: self   !! the table
      character(*), intent(in) :: name           !! of the kind
      type(text_t), intent(in) :: header(:)      !! (n_column) names of the columns

      integer :: c

      self%name = name
      self%n_column = size(header)
      self%n_row = 1
      do c = 1, size(header)
         call self%cells%add(header(c)%s)
      end do
   end subroutine start_table

   !> Add a row.
   subroutine add_row(self, cells)
      class(deck_table_t), intent(inout) :: self   !! the table
      character(*), intent(in) :: cells            !! its cells, a tab between two; blank: the default

      integer :: c, first, last

      first = 1
      do c = 1, self%n_column
         last = first - 2 + scan(cells(first:)//achar(9), achar(9))
         if (last >= first) then
            call self%cells%add(cells(first:last))
         else
            call self%cells%add("-")
         end if
         first = last + 2
      end do
      self%n_row = self%n_row + 1
   end subroutine add_row

   !> Write a table that has rows; columns that have none but defaults are omitted.
   subroutine write_table(self, buffer)
      class(deck_table_t), intent(in) :: self     !! the table
      type(buffer_t), intent(inout) :: buffer     !! the deck

      character(:), allocatable :: cell
      integer :: c, last, r
      integer :: width(self%n_column)

      if (self%n_row < 2) return
      width = 0
      last = 1
      do c = 1, self%n_column
         do r = 2, self%n_row
            if (self%cells%at((r - 1)*self%n_column + c) /= "-") width(c) = 1
         end do
         if (width(c) == 0) cycle
         last = c
         do r = 1, self%n_row
            width(c) = max(width(c), len(self%cells%at((r - 1)*self%n_column + c)))
         end do
      end do
      call buffer%line("")
      call buffer%line("["//self%name//"]")
      do r = 1, self%n_row
         do c = 1, last
            if (width(c) == 0) cycle
            cell = self%cells%at((r - 1)*self%n_column + c)
            call buffer%add(cell)
            if (c < last) call buffer%add(repeat(" ", width(c) - len(cell) + 3))
         end do
         call buffer%line("")
      end do
   end subroutine write_table

   !> A number as a cell; zero is the default.
   pure function number_cell(x, scale) result(cell)
      real(wp), intent(in) :: x                !! the number, SI [any]
      real(wp), intent(in) :: scale            !! what is omitted as round-off, times 1e-13; 0: nothing [any]
      character(:), allocatable :: cell        !! its digits; blank: zero

      cell = ""
      if (abs(x) > 1.0e-13_wp*scale) cell = real_text(x, 15)
   end function number_cell

   !> A direction as a cell.
   pure function direction_cell(x) result(cell)
      real(wp), intent(in) :: x(3)             !! (3) the direction [1]
      character(:), allocatable :: cell        !! three numbers in quotes

      integer :: k

      cell = ""
      do k = 1, 3
         if (k > 1) cell = cell//" "
         if (abs(x(k)) > 1.0e-15_wp) then
            cell = cell//real_text(x(k), 17)
         else
            cell = cell//"0"
         end if
      end do
      cell = """"//cell//""""
   end function direction_cell

end module deck_table
