!> Tables of a deck: from rows of cells to items of a kind.
module tables
   use cell_checks, only: is_name
   use cell_lists, only: read_word
   use cells, only: blank_value, read_value
   use deck_types, only: add_source, deck_t, text_of
   use defaults, only: read_default, remember_default
   use diagnostics, only: diagnostics_t
   use file_path, only: beside, plain_path
   use item, only: item_t, location_t, value_t
   use kind_info, only: cell_file, kind_info_t
   use mesh_file, only: read_mesh
   use name_table, only: name_table_t
   use number_lists, only: file_to_lists, read_samples
   use quantities, only: is_numeric
   use run_profiles, only: columns_of_profiles, read_profiles
   use table_header, only: header_t, is_broken, is_name_column, read_table_header
   use source_text, only: new_source, source_t
   use text, only: to_text
   use tokens, only: span, token_equals, token_quoted, token_t, token_word
   use units, only: parse_unit, unit_t
   implicit none (type, external)
   private
   public :: read_items

   integer, parameter :: longest_name = 60  !! characters of a name

   !> What is needed for all rows of a kind.
   type :: table_t
      type(value_t), allocatable :: default(:)  !! (columns) defaults that were read
      logical, allocatable :: is_read(:)        !! (columns) whether they were
      type(name_table_t) :: names               !! names so far
   end type table_t

   integer, parameter :: numbers_of_triangle = 9  !! size of a column that names a file of triangles
   character(*), parameter :: default_mark = "-"  !! a cell that takes the default

contains

   !> Read all rows of a kind, from all tables of its name.
   subroutine read_items(deck, info, items, mistakes)
      type(deck_t), intent(inout) :: deck                    !! the deck
      type(kind_info_t), intent(in) :: info                  !! the kind
      type(item_t), allocatable, intent(out) :: items(:)     !! (n) rows; some values are empty after errors
      type(diagnostics_t), intent(inout) :: mistakes         !! collects what is wrong

      type(header_t), allocatable :: headers(:)
      type(table_t) :: table
      integer, allocatable :: line(:), section(:)
      integer :: k, n, n_column

      call find_lines(deck, info%name, line, section)
      n_column = 0
      if (allocated(info%columns)) n_column = size(info%columns)
      allocate (table%default(n_column), table%is_read(n_column))
      table%is_read = .false.
      call table%names%start(size(line))
      n = 0
      do k = 1, size(line)
         if (is_first(section, k)) cycle
         n = n + 1
      end do
      allocate (items(n))
      n = 0
      do k = 1, size(line)
         if (is_first(section, k)) then
            call read_table_header(deck, info, tokens_of(deck, line(k)), headers, mistakes)
         else
            n = n + 1
            call read_row(deck, info, headers, tokens_of(deck, line(k)), table, n, items, mistakes)
         end if
      end do
      do k = 1, n_column
         if (info%columns(k)%cell /= cell_file) cycle
         do n = 1, size(items)
            if (.not. items(n)%values(k)%given) cycle
            associate (place => "in column "//info%columns(k)%name//" of "//info%name, value => items(n)%values(k))
               if (info%columns(k)%size == numbers_of_triangle) then
                  call read_triangles(deck, place, value, mistakes)
               else if (info%columns(k)%size == columns_of_profiles) then
                  call read_worn_surfaces(deck, place, value, mistakes)
               else
                  call read_samples(deck, place, value, mistakes)
               end if
            end associate
            if (index(info%name, "clearance.") == 1) call take_points(items(n), mistakes)
         end do
      end do
   end subroutine read_items

   !> The points of a file become the lists of their row.
   subroutine take_points(item, mistakes)
      type(item_t), intent(inout) :: item             !! the row
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      integer :: twice

      call file_to_lists(item, ["x", "y"], twice)
      if (twice > 0) call mistakes%add(item%values(twice)%location, "the points are already given by a file", "given twice", &
                                       "give columns x and y, or column file")
   end subroutine take_points

   !> A file of triangles.
   subroutine read_triangles(deck, place, value, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: place               !! as `in column file of shapes`
      type(value_t), intent(inout) :: value           !! the cell with its path; receives a row for each triangle
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: message

      call read_mesh(plain_path(beside(deck%sources(value%location%file)%place, value%text)), value%table, message)
      if (len(message) > 0) call mistakes%add(value%location, "cannot read the mesh '"//value%text//"' "//place, message)
   end subroutine read_triangles

   !> The file of an earlier run: what is taken from it becomes a text of the deck.
   subroutine read_worn_surfaces(deck, place, value, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck; its sources grow
      character(*), intent(in) :: place               !! as `in column run of worn.run`
      type(value_t), intent(inout) :: value           !! the cell with its path; receives names and volumes of the surfaces
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: lines, message, path
      type(source_t) :: source
      integer :: number

      path = plain_path(beside(deck%sources(value%location%file)%place, value%text))
      call read_profiles(path, lines, value%words, value%table, message)
      if (len(message) > 0) then
         call mistakes%add(value%location, "cannot read the run '"//value%text//"' "//place, message)
         return
      end if
      call new_source(source, path, lines)
      source%is_file = .true.
      call add_source(deck, source, number)
   end subroutine read_worn_surfaces

   !> All lines of all sections of some name.
   subroutine find_lines(deck, name, line, section)
      type(deck_t), intent(in) :: deck                  !! the deck
      character(*), intent(in) :: name                  !! of the sections
      integer, allocatable, intent(out) :: line(:)      !! (n) numbers of the lines
      integer, allocatable, intent(out) :: section(:)   !! (n) numbers of their sections

      logical :: is_named(deck%n_section)
      integer :: k, n, pass

      do k = 1, deck%n_section
         is_named(k) = deck%sections(k)%name == name
      end do
      do pass = 1, 2
         n = 0
         do k = 1, deck%n_line
            if (.not. is_named(deck%lines(k)%section)) cycle
            n = n + 1
            if (pass == 1) cycle
            line(n) = k
            section(n) = deck%lines(k)%section
         end do
         if (pass == 1) allocate (line(n), section(n))
      end do
   end subroutine find_lines

   !> Whether a line is the first one of its section.
   pure logical function is_first(section, k)
      integer, intent(in) :: section(:)  !! (n) sections of the lines
      integer, intent(in) :: k           !! number of the line

      is_first = k == 1
      if (k > 1) is_first = section(k) /= section(k - 1)
   end function is_first

   !> The tokens of a line.
   pure function tokens_of(deck, k) result(list)
      type(deck_t), intent(in) :: deck          !! the deck
      integer, intent(in) :: k                  !! number of the line
      type(token_t), allocatable :: list(:)     !! (n) its tokens

      list = deck%tokens%t(deck%lines(k)%first:deck%lines(k)%last)
   end function tokens_of

   !> Read one row.
   subroutine read_row(deck, info, headers, list, table, n, items, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      type(header_t), intent(in) :: headers(:)        !! (columns of the table) its header
      type(token_t), intent(in) :: list(:)            !! (cells) the row
      type(table_t), intent(inout) :: table           !! what is needed for all rows
      integer, intent(in) :: n                        !! number of the item
      type(item_t), intent(inout) :: items(:)         !! (all) items, the n-th is set
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      logical :: is_set(size(table%default))
      integer :: k

      items(n)%kind = info%name
      items(n)%name = ""
      items(n)%location = list(1)%location
      allocate (items(n)%values(size(table%default)))
      do k = 1, size(table%default)
         call blank_value(info%columns(k), items(n)%values(k))
         items(n)%values(k)%location = list(1)%location
      end do
      do k = 1, min(size(headers), size(list))
         if (headers(k)%column == is_name_column) call read_name(deck, info, list(k), table, n, items, mistakes)
      end do
      if (size(headers) == 0) return
      if (size(list) /= size(headers)) then
         call report_count(deck, info, size(headers), list, items(n)%name, mistakes)
         return
      end if
      is_set = .false.
      do k = 1, size(list)
         if (headers(k)%column < 1) cycle
         call read_cell(deck, info, headers(k), list(k), items(n)%values(headers(k)%column), &
                      & is_set(headers(k)%column), mistakes)
      end do
      if (any(headers%column == is_broken)) return
      do k = 1, size(is_set)
         if (.not. is_set(k)) call take_default(deck, info, k, table, items(n), mistakes)
      end do
   end subroutine read_row

   !> Read the name of a row.
   subroutine read_name(deck, info, token, table, n, items, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      type(token_t), intent(in) :: token              !! the cell
      type(table_t), intent(inout) :: table           !! knows the names so far
      integer, intent(in) :: n                        !! number of the item
      type(item_t), intent(inout) :: items(:)         !! (all) items, the n-th is named
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: note, word
      type(location_t) :: at
      integer :: bad, count_before, previous

      count_before = mistakes%count()
      call read_word(deck, "in column name of "//info%name, token, word, mistakes)
      items(n)%location = token%location
      if (mistakes%count() > count_before) return
      if (len(word) > longest_name) then
         call mistakes%add(token%location, "a name in "//info%name//" is too long", "at most "//to_text(longest_name)// &
                           & " characters", "names are used as file names")
         return
      end if
      if (.not. is_name(word)) then
         bad = verify(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-")
         if (len(word) == 0) then
            call mistakes%add(token%location, "empty name in "//info%name, "expected a name")
         else if (bad > 0) then
            at = token%location
            at%first = at%first + bad - 1
            at%last = at%first
            if (token%kind == token_quoted) at = token%location
            note = "invalid character"
            if (iachar(word(bad:bad)) < 128) note = "'"//word(bad:bad)//"' is not allowed"
            call mistakes%add(at, "'"//word//"' is not a name in "//info%name, note//" in a name", &
                            & "names consist of the letters a to z and A to Z, digits, _ and -")
         else
            call mistakes%add(token%location, "'"//word//"' is not a name in "//info%name, "expected a letter or digit")
         end if
         return
      end if
      items(n)%name = word
      call table%names%enter(word, n, previous)
      if (previous > 0) then
         call mistakes%add(token%location, "'"//word//"' is given twice in "//info%name, "name already used", &
                         & "first in line "//to_text(items(previous)%location%line))
      end if
   end subroutine read_name

   !> Read one cell.
   subroutine read_cell(deck, info, header, token, value, is_set, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      type(header_t), intent(in) :: header            !! its column
      type(token_t), intent(in) :: token              !! the cell
      type(value_t), intent(inout) :: value           !! receives the value
      logical, intent(out) :: is_set                  !! .false.: the default is to be taken
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: place
      type(token_t) :: list(1)

      list(1) = token
      place = "in column "//info%columns(header%column)%name//" of "//info%name
      is_set = .true.
      if (token%kind == token_word) is_set = text_of(deck, token) /= default_mark
      if (.not. is_set) then
         if (allocated(info%columns(header%column)%default)) return
         is_set = .true.
         call mistakes%add(token%location, "missing value "//place, "this column has no default")
      else if (header%has_unit) then
         call read_value(deck, info%columns(header%column), place, list, value, mistakes, header%unit)
      else
         call read_value(deck, info%columns(header%column), place, list, value, mistakes)
      end if
   end subroutine read_cell

   !> Give an item the default of a column.
   subroutine take_default(deck, info, k, table, item, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      integer, intent(in) :: k                        !! number of the column
      type(table_t), intent(inout) :: table           !! knows the defaults that were read
      type(item_t), intent(inout) :: item             !! receives it
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      if (.not. allocated(info%columns(k)%default)) return
      if (.not. table%is_read(k)) then
         call read_default(deck, info%name, info%columns(k), "in column "//info%columns(k)%name//" of "//info%name, &
                         & table%default(k), mistakes)
         table%is_read(k) = .true.
      end if
      item%values(k) = table%default(k)
      item%values(k)%location = item%location
      call remember_default(deck, info%name, item%name, info%columns(k))
   end subroutine take_default

   !> Report a row with too few or too many cells.
   subroutine report_count(deck, info, n_wanted, list, name, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(kind_info_t), intent(in) :: info           !! the kind
      integer, intent(in) :: n_wanted                 !! columns of the header
      type(token_t), intent(in) :: list(:)            !! (cells) the row
      character(*), intent(in) :: name                !! of the row, may be empty
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: help, message, note, word
      type(location_t) :: at
      type(unit_t) :: unit
      integer :: first, k, last

      help = ""
      do k = 1, size(list) - 1
         if (size(list) <= n_wanted .or. list(k)%kind /= token_word .or. list(k + 1)%kind /= token_word) cycle
         if (.not. is_numeric(text_of(deck, list(k))) .or. is_numeric(text_of(deck, list(k + 1)))) cycle
         word = text_of(deck, list(k + 1))
         call parse_unit(word, unit, message, first, last)
         if (len(message) == 0) help = "in tables, put the unit directly after its number: "//text_of(deck, list(k))//word
      end do
      if (any(list%kind == token_equals)) help = "a row has only cells; put settings in a separate section"
      if (size(list) > n_wanted) then
         at = span(list(n_wanted + 1), list(size(list)))
         note = "unexpected extra cell"
      else
         at = list(size(list))%location
         at%first = at%last + 1
         at%last = at%first
         note = "cells missing"
      end if
      if (len(help) == 0) help = "one cell without blanks for each column; use - for the default"
      call mistakes%add(at, "row '"//name//"' of "//info%name//" has "//to_text(size(list))//" cells, the header has " &
                      & //to_text(n_wanted), note, help)
   end subroutine report_count

end module tables
