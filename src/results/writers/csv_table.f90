!> Writes the columns of a table as comma-separated values, SI. Source: RFC 4180.
!>
!> The first line has the names, `name [unit]`. A missing value is an empty cell, a logical is 0 or 1.
module csv_table
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use result_table, only: in_hdf5, result_column_t, result_table_t
   use text, only: exact_text, replace, split_blank, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: csv_text

contains

   !> A table as text.
   function csv_text(table) result(text)
      type(result_table_t), intent(in) :: table      !! the table
      character(:), allocatable :: text              !! whole lines

      type(buffer_t) :: lines
      character(:), allocatable :: line
      integer :: k, row

      do row = 0, table%n
         line = ""
         do k = 1, size(table%columns)
            if (table%columns(k)%formats == in_hdf5) cycle
            line = line//cells(table%columns(k), row)
         end do
         call lines%line(line(2:))
      end do
      text = lines%get()
   end function csv_text

   !> The cells of a row in a column, which has one for each part of a value; row 0: their names.
   function cells(column, row) result(text)
      type(result_column_t), intent(in) :: column    !! the column
      integer, intent(in) :: row                     !! the row
      character(:), allocatable :: text              !! each with a comma before it

      integer :: k, n

      n = product(column%shape)
      text = ""
      do k = 1, n
         text = text//","
         if (row == 0) then
            text = text//head(column, k)
            cycle
         end if
         if (allocated(column%texts)) text = text//quoted(column%texts(row)%s)
         if (allocated(column%integers)) text = text//to_text(column%integers(row))
         if (allocated(column%logicals)) text = text//merge("1", "0", column%logicals(row))
         if (.not. allocated(column%reals)) cycle
         if (ieee_is_finite(column%reals((row - 1)*n + k))) text = text//exact_text(column%reals((row - 1)*n + k))
      end do
   end function cells

   !> The name of a column, or of a part of its values, with its unit.
   function head(column, part) result(text)
      type(result_column_t), intent(in) :: column    !! the column
      integer, intent(in) :: part                    !! number of the part
      character(:), allocatable :: text              !! as `moment [N.m]`

      character(:), allocatable :: unit
      type(text_t), allocatable :: units(:)

      text = column%name
      unit = column%unit
      if (allocated(column%parts)) then
         text = column%parts(part)%s
         units = split_blank(unit)
         if (size(units) == size(column%parts)) unit = units(part)%s
      end if
      if (unit /= "1" .and. unit /= "list" .and. index(unit, " ") == 0) text = text//" ["//unit//"]"
      text = quoted(text)
   end function head

   !> Text on one line, in quotes if it has a comma or a quote.
   pure function quoted(text) result(s)
      character(*), intent(in) :: text               !! any text
      character(:), allocatable :: s                 !! a cell

      s = replace(text, new_line("a"), " ")
      if (scan(s, ",""") > 0) s = """"//replace(s, """", """""")//""""
   end function quoted

end module csv_table
