!> Writes a table as lines of text, SI: the columns that have a heading, below the title.
!>
!> Names stand at the left, with the unit of their row; numbers at the right of columns as wide as their longest cell.
module text_of_table
   use channel_noise, only: shown
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use result_table, only: name_with_unit, result_column_t, result_table_t
   use text, only: real_text, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: add_table, shown_cell, shown_value

   integer, parameter :: indent = 11         !! blanks before a row
   integer, parameter :: widest_name = 60    !! characters of a name that others are lined up with
   integer, parameter :: gap = 2             !! blanks before a column

contains

   !> Add a table, if it has a title and rows.
   subroutine add_table(lines, table)
      type(buffer_t), intent(inout) :: lines        !! grown
      type(result_table_t), intent(in) :: table     !! the table

      type(buffer_t) :: rows(0:table%most)
      integer, allocatable :: list(:)
      integer :: k, n, part, row
      logical :: is_first

      if (table%title == "" .or. table%n == 0) return
      list = [(row, row=1, table%n)]
      if (allocated(table%is_minor)) list = pack(list, .not. table%is_minor)
      n = size(list)
      list = list(:min(n, table%most))
      is_first = .true.
      do k = 1, size(table%columns)
         if (.not. allocated(table%columns(k)%heading)) cycle
         do part = 1, table%columns(k)%n_part()
            call add_column(rows(:size(list)), table, table%columns(k), part, list, is_first)
            is_first = .false.
         end do
      end do
      call lines%line("")
      if (size(list) == 0) call lines%line(table%title)
      do k = 0, merge(size(list), -1, size(list) > 0)
         call lines%line(trim(rows(k)%get()))
      end do
      n = n - size(list) + table%left_out
      if (n > 0) call lines%line(repeat(" ", indent)//to_text(n)//" more in "//table%elsewhere)
      do k = 1, size(table%notes)
         call lines%line(repeat(" ", indent)//table%notes(k)%s)
      end do
   end subroutine add_table

   !> Add a column to the lines of a table.
   subroutine add_column(rows, table, column, part, list, is_first)
      type(buffer_t), intent(inout) :: rows(0:)        !! (rows) heading and rows
      type(result_table_t), intent(in) :: table        !! the table
      type(result_column_t), intent(in) :: column      !! its column
      integer, intent(in) :: part                      !! part of its values
      integer, intent(in) :: list(:)                   !! (n) its rows
      logical, intent(in) :: is_first                  !! names, below the title

      type(text_t) :: cells(0:size(list))
      integer :: k, width

      cells(0)%s = column%head(column%heading, part)
      if (is_first) cells(0)%s = table%title
      do k = 1, size(list)
         cells(k)%s = shown_cell(table, column, list(k), part, 1.0_wp)
         if (is_first .and. allocated(table%units)) cells(k)%s = name_with_unit(cells(k)%s, table%units(list(k))%s)
      end do
      width = maxval([(len(cells(k)%s), k=0, size(list))])
      if (is_first) width = min(max(width, len(table%title)), widest_name)
      do k = 0, size(list)
         if (is_first) then
            call rows(k)%add(repeat(" ", merge(0, indent, k == 0))//cells(k)%s// &
                             repeat(" ", max(0, width + merge(indent, 0, k == 0) - len(cells(k)%s))))
         else if (allocated(column%texts)) then
            call rows(k)%add(repeat(" ", gap)//cells(k)%s//repeat(" ", width - len(cells(k)%s)))
         else
            call rows(k)%add(repeat(" ", gap + width - len(cells(k)%s))//cells(k)%s)
         end if
      end do
   end subroutine add_column

   !> A value for people, in the unit that has a factor.
   function shown_cell(table, column, row, part, factor) result(cell)
      type(result_table_t), intent(in) :: table        !! the table
      type(result_column_t), intent(in) :: column      !! its column
      integer, intent(in) :: row                       !! row of the value
      integer, intent(in) :: part                      !! part of the value
      real(wp), intent(in) :: factor                   !! SI values times this are shown [any]
      character(:), allocatable :: cell                !! digits or words

      real(wp) :: x

      cell = ""
      if (allocated(column%texts)) cell = column%texts(row)%s
      if (allocated(column%integers)) cell = to_text(column%integers(row))
      if (allocated(column%logicals)) cell = trim(merge("yes", "no ", column%logicals(row)))
      if (.not. allocated(column%reals)) return
      x = shown_value(table, column, row, part)
      cell = column%missing
      if (ieee_is_finite(x)) cell = real_text(factor*x, column%digits)
   end function shown_cell

   !> A real number for people: round-off is zero.
   pure real(wp) function shown_value(table, column, row, part) result(x)
      type(result_table_t), intent(in) :: table        !! the table
      type(result_column_t), intent(in) :: column      !! its column
      integer, intent(in) :: row                       !! row of the value
      integer, intent(in) :: part                      !! part of the value

      x = column%reals((row - 1)*column%n_part() + part)
      if (column%has_unit_of_row() .and. allocated(table%noise)) x = shown(x, table%noise(row))
   end function shown_value

end module text_of_table
