!> Many numbers at once: lists in quotes, and text files of two columns.
!>
!>     "0 10 20 30 ms"        numbers and one unit; a number may have its own, glued to it
!>
!>     t[ms]   lift[mm]       the first line of a file with content: two names with their units
!>     0       0              then two numbers a line, with blanks or a comma between; # starts a comment
module number_lists
   use deck_types, only: add_source, deck_t, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use file_path, only: beside, plain_path
   use item, only: item_t, location_t, place_of, value_t
   use kind_info, only: dim_t, same_dimension
   use kinds, only: wp
   use quantities, only: is_numeric, is_unit_word, quantity_t, read_bare, read_unit, report_not_a_number
   use source_text, only: n_line_of, read_source, source_t
   use text, only: replace, to_text
   use tokens, only: lex_line, span, token_quoted, token_t, token_word
   use units, only: unit_t
   implicit none (type, external)
   private
   public :: file_to_lists, read_list, read_samples

   character(*), parameter :: blanks = " "//achar(9)

contains

   !> The columns of a row's file become its lists, so that its echo holds them.
   subroutine file_to_lists(item, lists, twice)
      type(item_t), intent(inout) :: item     !! the row, which may have a file in column `file`
      character(*), intent(in) :: lists(:)    !! names of the lists, in the order of the file's columns
      integer, intent(out) :: twice           !! column of a list that is given beside the file, 0: all is well

      integer :: k

      twice = 0
      associate (file => item%values(place_of(item, "file")))
         if (.not. file%given) return
         do k = 1, size(lists)
            associate (list => item%values(place_of(item, trim(lists(k)))))
               if (list%given) then
                  twice = place_of(item, trim(lists(k)))
                  return
               end if
               list%given = .true.
               list%location = file%location
               list%table = file%table(:, k:k)
               list%places = file%places
               list%dimensions(1) = file%dimensions(k)
            end associate
         end do
         file%given = .false.
      end associate
   end subroutine file_to_lists

   !> A list of numbers with one unit.
   subroutine read_list(deck, place, token, value, mistakes, header)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: place               !! as `in column at of function.samples`
      type(token_t), intent(in) :: token              !! the cell
      type(value_t), intent(inout) :: value           !! receives numbers and dimension
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(unit_t), intent(in), optional :: header    !! unit in the header of the table

      type(location_t), allocatable :: places(:)
      type(quantity_t) :: quantity
      type(unit_t) :: unit
      integer :: k, n
      logical :: has_unit, is_good

      allocate (value%table(0, 1))
      if (token%kind /= token_quoted .and. token%kind /= token_word) then
         call mistakes%add(token%location, "expected a list of numbers "//place, "not a list", "as ""0 10 20 30 ms""")
         return
      end if
      call find_words(value%text, token, places)
      n = size(places)
      has_unit = present(header)
      if (present(header)) unit = header
      if (n > 0) then
         if (is_unit_word(word(n))) then
            call read_unit(word(n), places(n), place, unit, is_good, mistakes)
            if (.not. is_good) return
            has_unit = .true.
            n = n - 1
         end if
      end if
      deallocate (value%table)
      allocate (value%table(n, 1), source=0.0_wp)
      do k = 1, n
         if (.not. is_numeric(word(k))) then
            call report_not_a_number(word(k), places(k), place, mistakes)
            return
         else if (has_unit) then
            call read_bare(word(k), places(k), place, quantity, mistakes, unit)
         else
            call read_bare(word(k), places(k), place, quantity, mistakes)
         end if
         if (.not. quantity%is_good) return
         value%table(k, 1) = quantity%x
         if (k == 1) value%dimensions(1) = quantity%dimension
         call check_same(quantity%dimension, value%dimensions(1), places(k), place, mistakes)
      end do
      value%places = places(1:n)

   contains

      !> One word of the list.
      function word(k)
         integer, intent(in) :: k             !! its number
         character(:), allocatable :: word    !! its text

         integer :: before

         before = token%location%first - merge(0, 1, token%kind == token_quoted)
         word = value%text(places(k)%first - before:places(k)%last - before)
      end function word

   end subroutine read_list

   !> Where the words of a list stand.
   subroutine find_words(text, token, places)
      character(*), intent(in) :: text                        !! the list, without quotes
      type(token_t), intent(in) :: token                      !! its cell
      type(location_t), allocatable, intent(out) :: places(:) !! (words) in the deck

      integer :: at, before, last, n, pass

      before = token%location%first - merge(0, 1, token%kind == token_quoted)
      do pass = 1, 2
         n = 0
         last = 0
         do
            at = verify(text(last + 1:), blanks)
            if (at == 0) exit
            at = last + at
            last = scan(text(at:), blanks) + at - 2
            if (last < at) last = len(text)
            n = n + 1
            if (pass == 2) places(n) = location_t(token%location%file, token%location%line, before + at, before + last)
         end do
         if (pass == 1) allocate (places(n))
      end do
   end subroutine find_words

   !> Report a number whose dimension is not that of the first one.
   subroutine check_same(dimension, first, location, place, mistakes)
      type(dim_t), intent(in) :: dimension            !! of the number
      type(dim_t), intent(in) :: first                !! of the first one
      type(location_t), intent(in) :: location        !! of the number
      character(*), intent(in) :: place               !! as `in column at of function.samples`
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      if (same_dimension(dimension, first)) return
      call mistakes%add(location, "wrong dimension "//place, "this is "//dimension_name(dimension)//", the first one is " &
                        //dimension_name(first))
   end subroutine check_same

   !> A file of two columns.
   subroutine read_samples(deck, place, value, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck; the file is added to its sources
      character(*), intent(in) :: place               !! as `in column file of function.samples`
      type(value_t), intent(inout) :: value           !! the cell with its path; receives numbers and dimensions
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(location_t), allocatable :: places(:)
      character(:), allocatable :: message, path
      type(source_t) :: source
      type(token_t) :: pair(2)
      type(unit_t) :: units(2)
      real(wp), allocatable :: table(:, :)
      integer :: line, n, number
      logical :: is_good, is_there, is_headed

      allocate (value%table(0, 2))
      if (len(value%text) == 0) then
         call mistakes%add(value%location, "missing file name "//place, "expected a path")
         return
      end if
      path = plain_path(beside(deck%sources(value%location%file)%place, value%text))
      do number = deck%n_source, 1, -1  ! a table that is read again has its files already
         if (deck%sources(number)%name == path) exit
      end do
      if (number == 0) then
         call read_source(path, source, message, may_be_stream=.false.)
         if (len(message) > 0) then
            call mistakes%add(value%location, "cannot read the file '"//path//"' "//place, message)
            return
         end if
         source%text = replace(source%text, ",", " ")
         call add_source(deck, source, number)
      end if
      allocate (table(n_line_of(deck%sources(number)), 2), source=0.0_wp)
      allocate (places(size(table, 1)))
      n = 0
      is_headed = .false.
      do line = 1, size(table, 1)
         call read_pair(deck, number, line, pair, is_there, is_good, mistakes)
         if (.not. is_good) return
         if (.not. is_there) cycle
         if (is_headed) then
            n = n + 1
            call read_row(deck, pair, units, place, table(n, :), is_good, mistakes)
            places(n) = span(pair(1), pair(2))
         else
            call read_heads(deck, pair, units, place, is_good, mistakes)
            is_headed = .true.
         end if
         if (.not. is_good) return
      end do
      value%table = table(1:n, :)
      value%places = places(1:n)
      value%dimensions = units%dimension
   end subroutine read_samples

   !> The two cells of a line.
   subroutine read_pair(deck, file, line, pair, is_there, is_good, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck; the cells are added to its tokens
      integer, intent(in) :: file                     !! number of the source
      integer, intent(in) :: line                     !! number of the line
      type(token_t), intent(out) :: pair(2)           !! (2) its cells
      logical, intent(out) :: is_there                !! .false.: nothing but blanks and a comment
      logical, intent(out) :: is_good                 !! .false.: an error was reported
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      integer :: first, n

      first = deck%tokens%n + 1
      call lex_line(deck%sources(file), file, line, deck%tokens, mistakes, is_good)
      n = deck%tokens%n - first + 1
      is_there = n > 0
      if (.not. is_good .or. .not. is_there) return
      is_good = n == 2
      if (is_good) is_good = all(deck%tokens%t(first:first + 1)%kind == token_word)
      if (is_good) then
         pair = deck%tokens%t(first:first + 1)
      else
         call mistakes%add(span(deck%tokens%t(first), deck%tokens%t(deck%tokens%n)), &
                           "a line of samples needs two numbers", to_text(n)//" cells, or invalid numbers", &
                           "use two numbers separated by blanks or a comma; # starts a comment")
      end if
   end subroutine read_pair

   !> The heads of the two columns.
   subroutine read_heads(deck, pair, units, place, is_good, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: pair(2)            !! (2) the cells
      type(unit_t), intent(out) :: units(2)           !! (2) their units
      character(*), intent(in) :: place               !! as `in column file of function.samples`
      logical, intent(out) :: is_good                 !! .false.: an error was reported
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: head
      type(location_t) :: at
      integer :: k, open

      do k = 1, 2
         head = text_of(deck, pair(k))
         open = index(head, "[")
         is_good = .not. is_numeric(head) .and. open /= 1 .and. (open == 0 .or. head(len(head):) == "]")
         if (.not. is_good) then
            call mistakes%add(pair(k)%location, "missing names and units of the samples "//place, "expected a name with a unit", &
                              "the first line must name the columns, as t[ms] lift[mm]")
            return
         end if
         if (open == 0) cycle
         at = pair(k)%location
         at%first = at%first + open
         at%last = at%last - 1
         call read_unit(head(open + 1:len(head) - 1), at, place, units(k), is_good, mistakes)
         if (.not. is_good) return
      end do
   end subroutine read_heads

   !> The numbers of a line.
   subroutine read_row(deck, pair, units, place, row, is_good, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: pair(2)            !! (2) the cells
      type(unit_t), intent(in) :: units(2)            !! (2) units of the columns
      character(*), intent(in) :: place               !! as `in column file of function.samples`
      real(wp), intent(out) :: row(2)                 !! (2) the numbers, SI [any]
      logical, intent(out) :: is_good                 !! .false.: an error was reported
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: word
      type(quantity_t) :: quantity
      integer :: k

      row = 0.0_wp
      do k = 1, 2
         word = text_of(deck, pair(k))
         is_good = is_numeric(word)
         if (is_good) then
            call read_bare(word, pair(k)%location, place, quantity, mistakes, units(k))
            is_good = quantity%is_good
            if (is_good) call check_same(quantity%dimension, units(k)%dimension, pair(k)%location, place, mistakes)
         else
            call report_not_a_number(word, pair(k)%location, place, mistakes)
         end if
         if (.not. is_good) return
         row(k) = quantity%x
      end do
   end subroutine read_row

end module number_lists
