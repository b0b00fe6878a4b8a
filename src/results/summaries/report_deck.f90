!> The deck as understood in report.html: a table for every table, keys and values for every section.
module report_deck
   use html_text, only: escaped
   use text, only: append_text, text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: deck_tables

   character(*), parameter :: letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"  !! of keys

contains

   !> The echo of a deck as tables.
   subroutine deck_tables(lines, echo)
      type(buffer_t), intent(inout) :: lines   !! the page
      character(*), intent(in) :: echo         !! text of deck.echo

      character(:), allocatable :: line
      type(text_t), allocatable :: cells(:)
      integer :: first, length
      logical :: is_first, is_open

      is_first = .false.
      is_open = .false.
      first = 1
      do while (first <= len(echo))
         length = index(echo(first:), new_line("a")) - 1
         if (length < 0) length = len(echo) - first + 1
         line = echo(first:first + length - 1)
         first = first + length + 1
         if (len_trim(line) == 0) cycle
         if (line(1:1) == "#") cycle
         if (line(1:1) == "[") then
            if (is_open) call lines%line("</tbody></table></div>")
            call lines%line("<h3>"//escaped(line, .true.)//"</h3><div class=""scroll""><table><tbody>")
            is_open = .true.
            is_first = .true.
            cycle
         end if
         if (.not. is_open) cycle
         cells = cells_of(line)
         if (size(cells) == 0) cycle
         call add_cells()
      end do
      if (is_open) call lines%line("</tbody></table></div>")

   contains

      !> A row of the table.
      subroutine add_cells()
         character(:), allocatable :: kind
         integer :: k

         kind = "td"
         if (is_first .and. index(line, " = ") == 0) kind = "th"
         is_first = .false.
         call lines%add("<tr>")
         do k = 1, size(cells)
            call lines%add("<"//kind//">"//escaped(cells(k)%s, .true.)//"</"//kind//">")
         end do
         call lines%line("</tr>")
      end subroutine add_cells

   end subroutine deck_tables

   !> The cells of a line: a key and its whole value, or what stands between blanks outside quotes and braces.
   function cells_of(line) result(cells)
      character(*), intent(in) :: line         !! of the echo
      type(text_t), allocatable :: cells(:)    !! (n) cells

      character(:), allocatable :: cell
      integer :: at, depth, i
      logical :: is_quoted

      allocate (cells(0))
      at = index(line, " = ")
      if (at > 1) then
         if (verify(trim(line(:at - 1)), letters) == 0) then
            call append_text(cells, trim(line(:at - 1)))
            call append_text(cells, trim(line(at + 3:)))
            return
         end if
      end if
      cell = ""
      depth = 0
      is_quoted = .false.
      do i = 1, len(line)
         if (line(i:i) == """") is_quoted = .not. is_quoted
         if (.not. is_quoted .and. line(i:i) == "{") depth = depth + 1
         if (.not. is_quoted .and. line(i:i) == "}") depth = depth - 1
         if (line(i:i) == " " .and. .not. is_quoted .and. depth == 0) then
            if (len(cell) > 0) call append_text(cells, cell)
            cell = ""
         else
            cell = cell//line(i:i)
         end if
      end do
      if (len(cell) > 0) call append_text(cells, cell)
   end function cells_of

end module report_deck
