!> Cases of a sweep from a file: a column for each parameter, a row for each case.
!>
!> The first line names the parameters, with the unit of bare numbers in brackets: `c[mm], speed[rpm], law`. Commas, semicolons or
!> tabs stand between the cells, whichever the line has first of these; else blanks. A cell in double quotes is taken as it is, `#`
!> starts a comment.
module sweep_table
   use deck_types, only: add_source, deck_t
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name, unit_text
   use expression_compile, only: dimension_agrees, symbol_number, symbol_t, symbol_word
   use file_path, only: beside, plain_path
   use item, only: location_t, value_t
   use kinds, only: not_a_number, wp
   use numbers, only: number_length
   use quantities, only: is_numeric, quantity_t, read_bare, read_unit
   use source_text, only: line_of, n_line_of, read_source, source_t
   use spelling, only: nearest_word
   use swept, only: most_cases, swept_t
   use text, only: join, text_t, segment, to_text
   use text_list, only: text_list_t
   use units, only: unit_t
   implicit none (type, external)
   private
   public :: read_sweep_table

   character(*), parameter :: blanks = " "//achar(9)       !! between cells
   character(*), parameter :: tab = achar(9)

   !> A cell of a line.
   type :: cell_t
      character(:), allocatable :: text       !! without blanks around it, and without quotes
      logical :: is_quoted = .false.          !! it stood in quotes
      type(location_t) :: location            !! where it stands
   end type cell_t

   !> A column.
   type :: column_t
      type(symbol_t) :: symbol                !! the parameter
      type(unit_t) :: unit                    !! of bare numbers
      character(:), allocatable :: unit_name  !! as written; blank: none
      type(text_list_t) :: texts              !! its values as a deck has them
      real(wp), allocatable :: numbers(:)     !! (rows or more) the same in SI, NaN of words [any]
   end type column_t

contains

   !> Read the file that a key of the sweep names.
   subroutine read_sweep_table(deck, value, parameters, mistakes)
      type(deck_t), intent(inout) :: deck                          !! the deck; the file is added to its sources
      type(value_t), intent(in) :: value                           !! the key with the path
      type(swept_t), allocatable, intent(out) :: parameters(:)     !! (columns) what is swept; none after an error
      type(diagnostics_t), intent(inout) :: mistakes               !! collects what is wrong

      type(cell_t), allocatable :: cells(:)
      type(column_t), allocatable :: columns(:)
      character(:), allocatable :: message, path
      type(source_t) :: source
      integer :: before, k, line, n, number

      allocate (parameters(0))
      path = plain_path(beside(deck%sources(value%location%file)%place, value%text))
      call read_source(path, source, message, may_be_stream=.false.)
      if (len(message) > 0) then
         call mistakes%add(value%location, "cannot read the file '"//path//"' of the sweep", message)
         return
      end if
      call add_source(deck, source, number)
      before = mistakes%count()
      n = 0
      do line = 1, n_line_of(deck%sources(number))
         call cut_line(deck, number, line, cells, mistakes)
         if (size(cells) == 0) cycle
         if (allocated(columns)) then
            n = n + 1
            call read_row(cells, n, columns, mistakes)
         else
            call read_heads(deck, cells, n_line_of(deck%sources(number)), columns, mistakes)
         end if
         if (mistakes%count() > before) return
      end do
      if (n == 0 .or. n > most_cases) then
         call mistakes%add(value%location, "the file '"//path//"' of the sweep has "//to_text(n)//" rows", &
                         & "expected 1 to "//to_text(most_cases)//" cases below the line of names")
         return
      end if
      deallocate (parameters)
      allocate (parameters(size(columns)))
      do k = 1, size(columns)
         parameters(k)%name = columns(k)%symbol%name
         parameters(k)%location = value%location
         parameters(k)%unit = ""
         if (columns(k)%symbol%kind == symbol_number) parameters(k)%unit = unit_text(columns(k)%symbol%dimension)
         if (columns(k)%symbol%kind == symbol_number .and. parameters(k)%unit == "") parameters(k)%unit = "1"
         parameters(k)%texts = columns(k)%texts%get()
         parameters(k)%numbers = columns(k)%numbers(:n)
      end do
   end subroutine read_sweep_table

   !> The cells of a line; none if there is nothing but blanks and a comment.
   subroutine cut_line(deck, file, line, cells, mistakes)
      type(deck_t), intent(in) :: deck                        !! the deck
      integer, intent(in) :: file                             !! number of the source
      integer, intent(in) :: line                             !! number of the line
      type(cell_t), allocatable, intent(out) :: cells(:)      !! (n) its cells
      type(diagnostics_t), intent(inout) :: mistakes          !! collects what is wrong

      type(cell_t), allocatable :: more(:)
      type(cell_t) :: cell
      character(:), allocatable :: s
      character :: separator
      integer :: at, n

      allocate (cells(8))
      n = 0
      s = without_comment(line_of(deck%sources(file), line))
      separator = " "
      at = scan(outside_quotes(s), ",;"//tab)
      if (at > 0) separator = s(at:at)
      at = 1
      do while (len_trim(s) > 0)
         call cut_cell(s, separator, file, line, at, cell, mistakes)
         if (n == size(cells)) then
            allocate (more(2*n))
            more(:n) = cells
            call move_alloc(more, cells)
         end if
         n = n + 1
         cells(n) = cell
         if (at > len(s) + 1) exit
      end do
      cells = cells(:n)
   end subroutine cut_line

   !> The next cell of a line.
   subroutine cut_cell(s, separator, file, line, at, cell, mistakes)
      character(*), intent(in) :: s                   !! the line, without blanks at its end
      character, intent(in) :: separator              !! between cells; a blank: any number of blanks
      integer, intent(in) :: file                     !! number of the source
      integer, intent(in) :: line                     !! number of the line
      integer, intent(inout) :: at                    !! where the cell starts; behind its separator on return
      type(cell_t), intent(out) :: cell               !! the cell
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(len(blanks)) :: around
      integer :: first, last, next

      around = blanks
      if (separator == tab) around = " "
      first = verify(s(at:), around) + at - 1
      if (first < at) first = at
      next = index(outside_quotes(s(first:)), separator)
      if (next == 0) next = len(s) - first + 2
      last = first + next - 2
      at = last + 2
      cell%location = location_t(file, line, first, max(first, last))
      cell%text = trim(adjustl(s(first:last)))
      cell%is_quoted = index(cell%text, """") == 1
      if (cell%is_quoted) then
         cell%is_quoted = len(cell%text) > 1 .and. index(cell%text(2:), """") == len(cell%text) - 1
         if (cell%is_quoted) cell%text = segment(cell%text, 2, len(cell%text) - 1)
         if (.not. cell%is_quoted) call mistakes%add(cell%location, "invalid text in quotes", "write: ""text""")
      else if (len(cell%text) == 0) then
         call mistakes%add(cell%location, "empty cell in the sweep file", "expected a value")
      end if
      if (separator == " " .and. at <= len(s)) then
         next = verify(s(at:), blanks)
         if (next > 0) at = at + next - 1
      end if
   end subroutine cut_cell

   !> A line up to its comment, without blanks at its end.
   pure function without_comment(line) result(s)
      character(*), intent(in) :: line      !! the line
      character(:), allocatable :: s        !! what counts of it

      integer :: at

      at = index(outside_quotes(line), "#")
      if (at == 0) at = len(line) + 1
      s = trim(line(:at - 1))
   end function without_comment

   !> A line with everything in quotes made harmless.
   pure function outside_quotes(line) result(s)
      character(*), intent(in) :: line      !! the line
      character(len(line)) :: s             !! the same, what is in quotes replaced

      integer :: k
      logical :: is_inside

      is_inside = .false.
      s = line
      do k = 1, len(line)
         if (line(k:k) == """") is_inside = .not. is_inside
         if (is_inside) s(k:k) = "x"
      end do
   end function outside_quotes

   !> The names of the parameters.
   subroutine read_heads(deck, cells, n_row, columns, mistakes)
      type(deck_t), intent(in) :: deck                           !! the deck
      type(cell_t), intent(in) :: cells(:)                       !! (n) cells of the line
      integer, intent(in) :: n_row                               !! rows there may be
      type(column_t), allocatable, intent(out) :: columns(:)     !! (n) columns
      type(diagnostics_t), intent(inout) :: mistakes             !! collects what is wrong

      type(location_t) :: at
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: help, name
      integer :: i, k, open
      logical :: is_good

      allocate (columns(size(cells)))
      do k = 1, size(cells)
         associate (head => cells(k)%text, column => columns(k))
            open = index(head, "[")
            if (open == 0) open = len(head) + 1
            name = trim(head(:open - 1))
            i = deck%symbols%find(name)
            if (i > deck%symbols%n_parameter) i = 0
            if (i == 0) then
               names = deck%symbols%names_of(functions=.false.)
               help = nearest_word(name, names)
               if (len(help) > 0) help = "did you mean '"//help//"'? "
               call mistakes%add(cells(k)%location, "'"//name//"' is not a parameter of the deck", "not a parameter", &
                               & help//"parameters: "//join(names, " "))
               cycle
            end if
            column%symbol = deck%symbols%list(i)
            column%unit_name = ""
            allocate (column%numbers(n_row), source=not_a_number())
            if (open > len(head)) cycle
            at = cells(k)%location
            at%first = at%first + open
            if (index(head, "]") /= len(head) .or. column%symbol%kind == symbol_word) then
               call mistakes%add(cells(k)%location, "the unit of '"//name//"' is invalid", "write: name[unit]; omit the "// &
                  "unit of a word")
               cycle
            end if
            column%unit_name = head(open + 1:len(head) - 1)
            at%last = max(at%first, at%first + len(column%unit_name) - 1)
            call read_unit(column%unit_name, at, "in the sweep of "//name, column%unit, is_good, mistakes, &
                           column%symbol%dimension)
            if (.not. is_good) cycle
            if (.not. dimension_agrees(column%symbol%dimension, column%symbol%is_soft, column%unit%dimension)) then
               call mistakes%add(at, "parameter '"//name//"' is "//dimension_name(column%symbol%dimension)//" in the deck", &
                               & "this is "//dimension_name(column%unit%dimension))
            end if
         end associate
      end do
   end subroutine read_heads

   !> A case.
   subroutine read_row(cells, row, columns, mistakes)
      type(cell_t), intent(in) :: cells(:)               !! (n) cells of the line
      integer, intent(in) :: row                         !! number of the case
      type(column_t), intent(inout) :: columns(:)        !! (n) columns, grown
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      integer :: k

      if (size(cells) /= size(columns)) then
         call mistakes%add(location_t(cells(1)%location%file, cells(1)%location%line, cells(1)%location%first, &
                                      cells(size(cells))%location%last), "a row of the sweep file has "// &
                         & to_text(size(cells))//" cells", "the first line names "//to_text(size(columns)))
         return
      end if
      do k = 1, size(cells)
         if (columns(k)%symbol%kind == symbol_word) then
            call read_word(cells(k), columns(k), mistakes)
         else
            call read_number(cells(k), columns(k), columns(k)%numbers(row), mistakes)
         end if
      end do
   end subroutine read_row

   !> A word.
   subroutine read_word(cell, column, mistakes)
      type(cell_t), intent(in) :: cell                   !! where it stands
      type(column_t), intent(inout) :: column            !! its column, grown
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      if (cell%is_quoted) then
         call column%texts%add(""""//cell%text//"""")
      else if (is_numeric(cell%text) .or. scan(cell%text, "{}= ") > 0) then
         call mistakes%add(cell%location, "parameter '"//column%symbol%name//"' is a word in the deck", "not a word")
      else
         call column%texts%add(cell%text)
      end if
   end subroutine read_word

   !> A number, with its own unit or that of its column.
   subroutine read_number(cell, column, x, mistakes)
      type(cell_t), intent(in) :: cell                   !! where it stands
      type(column_t), intent(inout) :: column            !! its column, grown
      real(wp), intent(out) :: x                         !! the number, SI [any]
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      type(quantity_t) :: quantity
      character(:), allocatable :: word

      x = not_a_number()
      word = cell%text
      if (.not. is_numeric(word)) then
         call mistakes%add(cell%location, "'"//word//"' is not a number in the sweep of "//column%symbol%name, &
                         & "expected a number")
         return
      end if
      if (number_length(word) == len(word)) word = word//column%unit_name
      call read_bare(word, cell%location, "in the sweep of "//column%symbol%name, quantity, mistakes)
      if (.not. quantity%is_good) return
      if (.not. dimension_agrees(column%symbol%dimension, column%symbol%is_soft .or. quantity%is_soft, quantity%dimension)) then
         call mistakes%add(cell%location, "parameter '"//column%symbol%name//"' is "//dimension_name(column%symbol%dimension)// &
                         & " in the deck", "this is "//dimension_name(quantity%dimension))
         return
      end if
      x = quantity%x
      call column%texts%add(word)
   end subroutine read_number

end module sweep_table
