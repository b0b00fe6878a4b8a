!> The first line of a table: which column of the kind each cell belongs to, and its unit.
module table_header
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use item, only: location_t
   use kind_info, only: cell_expression, cell_list, cell_number, column_t, kind_info_t, same_dimension
   use quantities, only: read_unit
   use spelling, only: nearest_word
   use text, only: append_text, join, text_t
   use tokens, only: span, token_equals, token_t, token_word
   use units, only: unit_t
   implicit none (type, external)
   private
   public :: column_index, column_list, header_t, is_broken, is_name_column, read_table_header

   integer, parameter :: is_name_column = 0  !! the column holds the name
   integer, parameter :: is_broken = -1      !! an error was reported, cells are skipped

   !> A column as it stands in the deck.
   type :: header_t
      integer :: column = is_broken  !! column of the kind, or one of the above
      logical :: has_unit = .false.  !! whether it has a unit
      type(unit_t) :: unit           !! of bare numbers
   end type header_t

contains

   !> Read the header of a table.
   subroutine read_table_header(deck, info, list, headers, mistakes)
      type(deck_t), intent(in) :: deck                           !! the deck
      type(kind_info_t), intent(in) :: info                      !! the kind
      type(token_t), intent(in) :: list(:)                       !! (n) tokens of the line
      type(header_t), allocatable, intent(out) :: headers(:)     !! (n) columns; none: do not read the rows
      type(diagnostics_t), intent(inout) :: mistakes             !! collects what is wrong

      type(location_t) :: at
      integer :: i, k, n_broken
      logical, allocatable :: is_taken(:)
      logical :: is_there

      do k = 1, size(list)
         if (list(k)%kind /= token_equals) cycle
         allocate (headers(0))
         call mistakes%add(list(k)%location, "table "//info%name//" starts with a setting", &
                         & "expected a line of column names", column_list(info))
         return
      end do
      allocate (headers(size(list)))
      n_broken = 0
      i = 0
      if (allocated(info%columns)) i = size(info%columns)
      allocate (is_taken(min(is_broken, is_name_column):i), source=.false.)
      do k = 1, size(list)
         call read_column(deck, info, list(k), headers(k), mistakes)
         if (headers(k)%column == is_broken) n_broken = n_broken + 1
         if (headers(k)%column == is_broken) cycle
         if (is_taken(headers(k)%column)) then
            call mistakes%add(list(k)%location, "column '"//plain_name(text_of(deck, list(k)))//"' is given twice in table " &
                            & //info%name)
            headers(k)%column = is_broken
            cycle
         end if
         is_taken(headers(k)%column) = .true.
      end do
      if (n_broken == size(list)) then
         deallocate (headers)
         allocate (headers(0))
         return
      end if
      at = span(list(1), list(size(list)))
      is_there = any(headers%column == is_name_column)
      if (.not. is_there .and. n_broken == 0) then
         call mistakes%add(at, "missing column 'name' in table "//info%name, "each row needs a name")
      end if
      if (.not. allocated(info%columns)) return
      do i = 1, size(info%columns)
         if (allocated(info%columns(i)%default) .or. any(headers%column == i)) cycle
         if (n_broken > 0) cycle
         call mistakes%add(at, "missing column '"//info%columns(i)%name//"' in table "//info%name, "this column has no "// &
            "default", &
                         & info%columns(i)%name//": "//info%columns(i)%help)
      end do
   end subroutine read_table_header

   !> Read one column head, `name` or `name[unit]`.
   subroutine read_column(deck, info, token, header, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      type(token_t), intent(in) :: token              !! the cell
      type(header_t), intent(out) :: header           !! the column
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: help, name, word
      type(location_t) :: at
      integer :: k

      word = text_of(deck, token)
      at = token%location
      name = plain_name(word)
      if (token%kind /= token_word .or. len(name) == 0) then
         help = ""
         if (len(name) == 0) help = "put the unit directly after its column: mass[kg]"
         call mistakes%add(at, "'"//word//"' is not a column name in table "//info%name, "expected a name", help)
         return
      end if
      k = column_index(info, name)
      if (k == is_broken) then
         at%last = at%first + len(name) - 1
         help = nearest_word(name, names_of(info))
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         call mistakes%add(at, "unknown column '"//name//"' in table "//info%name, "not a column of this table", &
                         & help//column_list(info))
         return
      end if
      header%column = k
      if (len(name) == len(word)) return
      at%first = at%first + len(name)
      if (word(len(word):) /= "]") then
         call mistakes%add(at, "missing end of the unit of column '"//name//"' is not closed", "']' is missing")
         header%column = is_broken
      else if (k == is_name_column) then
         call mistakes%add(at, "column 'name' of table "//info%name//" has a unit", "it contains words")
      else
         call read_header_unit(info, info%columns(k), word(len(name) + 2:len(word) - 1), at, header, mistakes)
      end if
   end subroutine read_column

   !> Read the unit of a column.
   subroutine read_header_unit(info, column, string, location, header, mistakes)
      type(kind_info_t), intent(in) :: info           !! the kind
      type(column_t), intent(in) :: column            !! the column
      character(*), intent(in) :: string              !! between the brackets
      type(location_t), intent(in) :: location        !! with the brackets
      type(header_t), intent(inout) :: header         !! receives the unit
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: place
      type(location_t) :: inside
      logical :: is_good

      place = "in column "//column%name//" of "//info%name
      if (column%cell /= cell_number .and. column%cell /= cell_expression .and. column%cell /= cell_list) then
         call mistakes%add(location, "column '"//column%name//"' of table "//info%name//" has a unit", "it holds words")
         return
      end if
      inside = location
      inside%first = location%first + 1
      inside%last = max(inside%first, location%last - 1)
      call read_unit(string, inside, place, header%unit, is_good, mistakes, column%dimension)
      header%has_unit = is_good
      if (is_good .and. .not. column%is_any .and. .not. same_dimension(header%unit%dimension, column%dimension)) then
         call mistakes%add(inside, "wrong dimension "//place, "this is "//dimension_name(header%unit%dimension)//", " &
                         & //dimension_name(column%dimension)//" expected")
         is_good = .false.
      end if
      if (.not. is_good) header%column = is_broken
   end subroutine read_header_unit

   !> The name of a column head without its unit.
   pure function plain_name(word) result(name)
      character(*), intent(in) :: word   !! `name` or `name[unit]`
      character(:), allocatable :: name  !! the name

      integer :: k

      k = index(word, "[")
      if (k == 0) k = len(word) + 1
      name = word(1:k - 1)
   end function plain_name

   !> Number of a column of a kind; 0 for `name`; -1 if there is none.
   pure integer function column_index(info, name)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(*), intent(in) :: name       !! of the column

      integer :: k

      column_index = is_broken
      if (info%is_table .and. name == "name") column_index = is_name_column
      if (.not. allocated(info%columns)) return
      do k = 1, size(info%columns)
         if (info%columns(k)%name == name) column_index = k
      end do
   end function column_index

   !> The names of all columns or keys of a kind.
   function names_of(info) result(names)
      type(kind_info_t), intent(in) :: info   !! the kind
      type(text_t), allocatable :: names(:)   !! (n) names

      integer :: k

      allocate (names(0))
      if (info%is_table) call append_text(names, "name")
      if (.not. allocated(info%columns)) return
      do k = 1, size(info%columns)
         call append_text(names, info%columns(k)%name)
      end do
   end function names_of

   !> The names of all columns or keys of a kind in one line, for help.
   function column_list(info) result(line)
      type(kind_info_t), intent(in) :: info  !! the kind
      character(:), allocatable :: line      !! `columns: name mass ...`

      if (info%is_table) then
         line = "columns: "//join(names_of(info), " ")
      else
         line = "keys: "//join(names_of(info), " ")
      end if
   end function column_list

end module table_header
