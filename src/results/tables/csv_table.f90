!> Writes the columns of a table as comma-separated values, SI. Source: RFC 4180.
!>
!> The first line has the names, `name [unit]`. A missing value is an empty cell, a logical is 0 or 1.
module csv_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use result_table, only: in_csv, result_column_t, result_table_t
   use text, only: exact_text, replace, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: csv_text

contains

   !> A table as text.
   function csv_text(table, with_units) result(text)
      type(result_table_t), intent(in) :: table      !! the table
      logical, intent(in), optional :: with_units    !! in the first line; absent: yes
      character(:), allocatable :: text              !! whole lines

      type(buffer_t) :: lines
      character(:), allocatable :: line
      logical :: has_units
      integer :: k, row

      has_units = .true.
      if (present(with_units)) has_units = with_units
      do row = 0, table%n
         line = ""
         do k = 1, size(table%columns)
            if (iand(table%columns(k)%formats, in_csv) == 0) cycle
            line = line//cells(table%columns(k), row, has_units)
         end do
         call lines%line(line(2:))
      end do
      text = lines%get()
   end function csv_text

   !> The cells of a row in a column, which has one for each part of a value; row 0: their names.
   function cells(column, row, has_units) result(text)
      type(result_column_t), intent(in) :: column    !! the column
      integer, intent(in) :: row                     !! the row
      logical, intent(in) :: has_units               !! names have units
      character(:), allocatable :: text              !! each with a comma before it

      integer :: k, n

      n = column%n_part()
      text = ""
      do k = 1, n
         text = text//","
         if (row == 0) then
            if (has_units) text = text//quoted(column%head(column%name, k))
            if (.not. has_units) text = text//quoted(column%name)
            cycle
         end if
         if (allocated(column%texts)) text = text//quoted(column%texts(row)%s)
         if (allocated(column%integers)) text = text//to_text(column%integers(row))
         if (allocated(column%logicals)) text = text//merge("1", "0", column%logicals(row))
         if (.not. allocated(column%reals)) cycle
         if (ieee_is_finite(column%reals((row - 1)*n + k))) text = text//exact_text(column%reals((row - 1)*n + k))
      end do
   end function cells

   !> Text on one line, in quotes if it has a comma or a quote.
   pure function quoted(text) result(s)
      character(*), intent(in) :: text               !! any text
      character(:), allocatable :: s                 !! a cell

      s = replace(text, new_line("a"), " ")
      if (scan(s, ",""") > 0) s = """"//replace(s, """", """""")//""""
   end function quoted

end module csv_table
