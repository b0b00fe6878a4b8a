!> Writes a table as a section of a page: the columns that have a heading, below the title. Numbers are in units that read well.
module html_table
   use display_units, only: choose_unit, display_unit_t
   use html_text, only: escaped
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use result_table, only: result_column_t, result_table_t
   use text, only: to_text
   use text_buffer, only: buffer_t
   use text_of_table, only: shown_cell, shown_value
   implicit none (type, external)
   private
   public :: add_section, head

   integer, parameter :: most_rows = 2000  !! of a table

contains

   !> The heading of a section.
   subroutine head(lines, name, words)
      type(buffer_t), intent(inout) :: lines  !! the page
      character(*), intent(in) :: name        !! to be linked to
      character(*), intent(in) :: words       !! what it says

      call lines%line("<h2 id="""//name//""">"//escaped(words, .true.)//"</h2>")
   end subroutine head

   !> Add a table, if it has a title and rows.
   subroutine add_section(lines, table)
      type(buffer_t), intent(inout) :: lines        !! the page
      type(result_table_t), intent(in) :: table     !! the table

      type(display_unit_t) :: units(size(table%columns))
      integer :: k, n, part, row

      if (table%title == "" .or. table%n == 0) return
      call head(lines, table%section(), table%title)
      call lines%add("<div class=""scroll""><table><thead><tr>")
      do k = 1, size(table%columns)
         if (.not. allocated(table%columns(k)%heading)) cycle
         units(k) = unit_of(table%columns(k))
         do part = 1, table%columns(k)%n_part()
            call lines%add("<th>"//escaped(heading_of(table%columns(k), part, units(k)), .true.)//"</th>")
         end do
         if (k == 1 .and. allocated(table%units)) call lines%add("<th>unit</th>")
      end do
      call lines%line("</tr></thead><tbody>")
      n = min(table%n, most_rows)
      do row = 1, n
         call lines%add("<tr>")
         call add_row(lines, table, row, units)
         call lines%line("</tr>")
      end do
      call lines%line("</tbody></table></div>")
      n = table%n - n + table%left_out
      if (n > 0) call lines%line("<p>"//to_text(n)//" more in "//escaped(table%elsewhere, .true.)//"</p>")
      do k = 1, size(table%notes)
         call lines%line("<p>"//escaped(table%notes(k)%s, .true.)//"</p>")
      end do
   end subroutine add_section

   !> Add the cells of a row; values with the unit of the row share one.
   subroutine add_row(lines, table, row, units)
      type(buffer_t), intent(inout) :: lines             !! the page
      type(result_table_t), intent(in) :: table          !! the table
      integer, intent(in) :: row                         !! its row
      type(display_unit_t), intent(in) :: units(:)       !! (columns) how values are shown

      type(display_unit_t) :: of_row
      real(wp) :: extent, factor, x
      integer :: k, part

      if (allocated(table%units)) then
         extent = 0.0_wp
         do k = 1, size(table%columns)
            if (.not. (table%columns(k)%has_unit_of_row() .and. allocated(table%columns(k)%heading))) cycle
            x = shown_value(table, table%columns(k), row, 1)
            if (ieee_is_finite(x)) extent = max(extent, abs(x))
         end do
         of_row = choose_unit(table%units(row)%s, extent)
      end if
      do k = 1, size(table%columns)
         if (.not. allocated(table%columns(k)%heading)) cycle
         factor = units(k)%factor
         if (table%columns(k)%has_unit_of_row()) factor = of_row%factor
         do part = 1, table%columns(k)%n_part()
            call lines%add("<td>"//escaped(shown_cell(table, table%columns(k), row, part, factor), .true.)//"</td>")
         end do
         if (k == 1 .and. allocated(table%units)) call lines%add("<td>"//of_row%symbol//"</td>")
      end do
   end subroutine add_row

   !> The unit that all values of a column are shown in: SI if they have parts.
   function unit_of(column) result(unit)
      type(result_column_t), intent(in) :: column    !! the column
      type(display_unit_t) :: unit                   !! no symbol if rows have units

      unit%symbol = ""
      if (.not. allocated(column%reals) .or. column%has_unit_of_row() .or. allocated(column%parts)) return
      unit = choose_unit(column%unit, maxval([0.0_wp, pack(abs(column%reals), ieee_is_finite(column%reals))]))
   end function unit_of

   !> The heading of a column or of a part of its values, with the unit that is shown.
   function heading_of(column, part, unit) result(text)
      type(result_column_t), intent(in) :: column    !! the column
      integer, intent(in) :: part                    !! number of the part
      type(display_unit_t), intent(in) :: unit       !! how its values are shown
      character(:), allocatable :: text              !! as `at [ms]`

      text = column%heading
      if (unit%symbol /= "") text = text//" ["//unit%symbol//"]"
      if (allocated(column%parts)) text = column%head(text, part)
   end function heading_of

end module html_table
