!> Reads the section [sweep]: parameters and the values that they take.
!>
!> `c = 0.5 0.2 0.1 mm` or `c = 0.5mm 0.2mm`: a list, with one unit at its end or one at each number. `law = hertz goldsmith`:
!> words. `speed = 1000 .. 5000 rpm in 9`: nine values at equal distances, both ends among them; `in 9 geometric`: at equal
!> ratios. The key `combine` says how several parameters go together, `keep` what is kept of each run, `file` where cases stand as
!> rows of a table.
module sweep_values
   use cells, only: blank_value, read_value
   use deck_types, only: deck_t, find_section, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name, unit_text
   use expression_compile, only: dimension_agrees, symbol_broken, symbol_number, symbol_word
   use item, only: item_t, location_t, place_of, value_t
   use kind_info, only: kind_info_t
   use kinds, only: not_a_number, wp
   use name_table, only: name_table_t
   use number_cell, only: read_number
   use numbers, only: number_length
   use quantities, only: is_numeric, quantity_t, read_bare
   use table_header, only: column_index
   use spelling, only: nearest_word
   use sweep_table, only: read_sweep_table
   use swept, only: most_cases, sweep_t, swept_t
   use text, only: exact_text, join, text_t, to_text
   use text_list, only: text_list_t
   use tokens, only: span, token_brace, token_equals, token_quoted, token_t, token_word
   implicit none (type, external)
   private
   public :: read_sweep

   character(*), parameter :: section_name = "sweep"

contains

   !> Read the section.
   subroutine read_sweep(deck, info, sweep, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck, its parameters worked out; takes the file of cases
      type(kind_info_t), intent(in) :: info           !! the section's own keys
      type(sweep_t), intent(out) :: sweep             !! what is swept
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(item_t) :: own
      type(name_table_t) :: table
      type(swept_t), allocatable :: swept(:)
      integer :: k, key, n, previous, section
      logical :: is_good

      allocate (sweep%parameters(0))
      section = find_section(deck, section_name)
      sweep%is_present = section > 0
      if (.not. sweep%is_present) return
      n = 0
      do k = 1, deck%n_line
         if (deck%sections(deck%lines(k)%section)%name == section_name) n = n + 1
      end do
      allocate (swept(n))
      call table%start(n)
      n = 0
      allocate (own%values(size(info%columns)))
      do k = 1, size(info%columns)
         call blank_value(info%columns(k), own%values(k))
         own%values(k)%text = info%columns(k)%default
      end do
      do k = 1, deck%n_line
         if (deck%sections(deck%lines(k)%section)%name /= section_name) cycle
         associate (list => deck%tokens%t(deck%lines(k)%first:deck%lines(k)%last))
            is_good = size(list) >= 3
            if (is_good) is_good = list(1)%kind == token_word .and. list(2)%kind == token_equals
            if (.not. is_good) then
               call mistakes%add(span(list(1), list(size(list))), "invalid line of the sweep", &
                               & "write: parameter = value value unit")
               cycle
            end if
            key = column_index(info, text_of(deck, list(1)))
            if (key > 0) then
               call read_value(deck, info%columns(key), "in key "//info%columns(key)%name//" of "//section_name, list(3:), &
                             & own%values(key), mistakes)
               cycle
            end if
            call read_swept(deck, list, swept(n + 1), is_good, mistakes)
            if (.not. is_good) cycle
            n = n + 1
            call table%enter(swept(n)%name, n, previous)
            if (previous > 0) call mistakes%add(swept(n)%location, "parameter '"//swept(n)%name//"' is swept twice", &
                                              & "already listed")
         end associate
      end do
      sweep%parameters = swept(:n)
      associate (value => own%values(place_of(own, "file")))
         if (value%given .and. mistakes%count() == 0) call add_table(deck, value, sweep, table, mistakes)
      end associate
      sweep%is_paired = own%word("combine") == "paired"
      sweep%keeps_channels = own%word("keep") == "channels"
      call check_whole(deck, section, sweep, mistakes)
   end subroutine read_sweep

   !> Put the parameters of a file before those of the deck.
   subroutine add_table(deck, value, sweep, table, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck; takes the file
      type(value_t), intent(in) :: value              !! the key that names it
      type(sweep_t), intent(inout) :: sweep           !! grown
      type(name_table_t), intent(inout) :: table      !! names so far
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(swept_t), allocatable :: of_file(:)
      integer :: k, previous

      call read_sweep_table(deck, value, of_file, mistakes)
      do k = 1, size(of_file)
         call table%enter(of_file(k)%name, size(sweep%parameters) + k, previous)
         if (previous > 0) call mistakes%add(of_file(k)%location, "parameter '"//of_file(k)%name//"' is swept twice", &
                                           & "the sweep file contains it, too")
      end do
      sweep%n_together = max(1, size(of_file))
      sweep%parameters = [of_file, sweep%parameters]
   end subroutine add_table

   !> A sweep has parameters; paired ones have as many values as one another.
   subroutine check_whole(deck, section, sweep, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      integer, intent(in) :: section                  !! number of the section
      type(sweep_t), intent(in) :: sweep              !! the sweep
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      integer :: k

      if (mistakes%count() > 0) return
      if (size(sweep%parameters) == 0) then
         call mistakes%add(deck%sections(section)%location, "the sweep has no parameters", "nothing to vary", &
                         & "write: parameter = value value unit")
         return
      end if
      if (sweep%n_cases() > most_cases) then
         call mistakes%add(deck%sections(section)%location, "the sweep has more than "//to_text(most_cases)//" cases", &
                         & "too many")
      end if
      if (.not. sweep%is_paired) return
      do k = 2, size(sweep%parameters)
         if (size(sweep%parameters(k)%texts) == size(sweep%parameters(1)%texts)) cycle
         call mistakes%add(sweep%parameters(k)%location, "'"//sweep%parameters(k)%name//"' has " &
                         & //to_text(size(sweep%parameters(k)%texts))//" values, '"//sweep%parameters(1)%name//"' has " &
                         & //to_text(size(sweep%parameters(1)%texts)), "paired parameters need equal numbers of values")
      end do
   end subroutine check_whole

   !> Read one parameter and its values.
   subroutine read_swept(deck, list, swept, is_good, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the line
      type(swept_t), intent(out) :: swept             !! the parameter
      logical, intent(out) :: is_good                 !! whether it could be read
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: help
      type(text_t), allocatable :: names(:)
      integer :: before, k

      swept%name = text_of(deck, list(1))
      swept%location = span(list(1), list(size(list)))
      swept%unit = ""
      allocate (swept%texts(0), swept%numbers(0))
      is_good = .false.
      k = deck%symbols%find(swept%name)
      if (k > deck%symbols%n_parameter) k = 0  ! a function
      if (k == 0) then
         names = deck%symbols%names_of(functions=.false.)
         help = nearest_word(swept%name, names)
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         call mistakes%add(list(1)%location, "'"//swept%name//"' is not a parameter of the deck", "not a parameter", &
                         & help//"parameters: "//join(names, " "))
         return
      end if
      before = mistakes%count()
      if (deck%symbols%list(k)%kind == symbol_word) then
         call read_words_of(deck, list(3:), swept, mistakes)
      else if (deck%symbols%list(k)%kind == symbol_number) then
         call read_numbers_of(deck, list(3:), swept, mistakes)
         if (mistakes%count() == before) call check_dimensions(deck, k, list(3:), swept, mistakes)
      end if
      is_good = mistakes%count() == before .and. deck%symbols%list(k)%kind /= symbol_broken
   end subroutine read_swept

   !> Values that are words.
   subroutine read_words_of(deck, list, swept, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the values
      type(swept_t), intent(inout) :: swept           !! the parameter
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(text_list_t) :: texts
      character(:), allocatable :: word
      integer :: k

      do k = 1, size(list)
         word = text_of(deck, list(k))
         if (list(k)%kind == token_brace .or. list(k)%kind == token_equals .or. is_numeric(word)) then
            call mistakes%add(list(k)%location, "parameter '"//swept%name//"' is a word in the deck", "not a word")
            cycle
         end if
         if (list(k)%kind == token_quoted) word = """"//word//""""
         call texts%add(word)
      end do
      swept%texts = texts%get()
      swept%numbers = [(not_a_number(), k=1, texts%n)]
   end subroutine read_words_of

   !> Values that are numbers: a list or a range.
   subroutine read_numbers_of(deck, list, swept, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the values
      type(swept_t), intent(inout) :: swept           !! the parameter
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(text_list_t) :: texts
      character(:), allocatable :: unit, word
      integer :: k, n

      if (size(list) >= 2) then
         if (text_of(deck, list(2)) == "..") then
            call read_range(deck, list, swept, mistakes)
            return
         end if
      end if
      n = size(list)
      unit = ""
      if (n > 1 .and. list(n)%kind == token_word) then
         word = text_of(deck, list(n))
         if (.not. is_numeric(word)) then
            unit = word
            n = n - 1
         end if
      end if
      do k = 1, n
         word = text_of(deck, list(k))
         if (list(k)%kind == token_brace) then
            word = "{"//word//"}"
         else if (number_length(word) == len(word)) then
            word = word//unit
         end if
         call texts%add(word)
      end do
      swept%texts = texts%get()
   end subroutine read_numbers_of

   !> A range: `A .. B unit in N`, perhaps `geometric`; units beside the ends or glued to one or both of them.
   subroutine read_range(deck, list, swept, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the values
      type(swept_t), intent(inout) :: swept           !! the parameter
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: unit, units(:), words(:)
      integer :: at, k, length, n, n_values, status
      logical :: is_geometric, is_good
      real(wp) :: ends(2)

      n = size(list)
      allocate (character(256) :: words(n), units(2))
      do k = 1, n
         words(k) = text_of(deck, list(k))
      end do
      is_geometric = words(n) == "geometric"
      if (is_geometric) n = n - 1
      is_good = n >= 5
      if (is_good) is_good = words(n - 1) == "in"
      n_values = 0
      if (is_good) then
         read (words(n), *, iostat=status) n_values
         is_good = status == 0 .and. verify(trim(words(n)), "0123456789") == 0 .and. n_values >= 2 .and. n_values <= most_cases
      end if
      is_good = is_good .and. (n == 5 .or. n == 6)
      unit = ""
      if (is_good) then
         if (n == 6) unit = trim(words(4))
         do k = 1, 2
            at = 2*k - 1
            length = number_length(trim(words(at)))
            is_good = is_good .and. length > 0 .and. list(at)%kind == token_word
            if (length == 0) exit
            units(k) = trim(words(at) (length + 1:))
            read (words(at) (1:length), *, iostat=status) ends(k)
            is_good = is_good .and. status == 0
            if (len(unit) == 0) unit = trim(units(k))
         end do
         is_good = is_good .and. all(units == unit .or. units == "")
      end if
      if (.not. is_good) then
         call mistakes%add(span(list(1), list(size(list))), "invalid range of '"//swept%name//"'", &
                         & "write: FROM .. TO UNIT in NUMBER", "as in 1000 .. 5000 rpm in 9, or 0.01 .. 1 mm in 5 geometric")
         return
      end if
      if (is_geometric .and. .not. ends(1)*ends(2) > 0.0_wp) then
         call mistakes%add(span(list(1), list(3)), "a geometric range must not include zero", "use ends of equal sign")
         return
      end if
      call spread_values(ends, n_values, is_geometric, unit, swept)
   end subroutine read_range

   !> The values of a range, as texts: the ends, and between them equal differences or equal ratios.
   subroutine spread_values(ends, n_values, is_geometric, unit, swept)
      real(wp), intent(in) :: ends(2)        !! (2) the first and the last value [unit]
      integer, intent(in) :: n_values        !! how many there are, at least 2
      logical, intent(in) :: is_geometric    !! equal ratios
      character(*), intent(in) :: unit       !! their unit, or none
      type(swept_t), intent(inout) :: swept  !! the parameter

      type(text_list_t) :: texts
      integer :: k
      real(wp) :: x

      do k = 1, n_values
         associate (part => real(k - 1, wp)/real(n_values - 1, wp))
            x = ends(1) + (ends(2) - ends(1))*part
            if (is_geometric) x = ends(1)*(ends(2)/ends(1))**part
         end associate
         if (k == n_values) x = ends(2)
         call texts%add(exact_text(x)//unit)
      end do
      swept%texts = texts%get()
   end subroutine spread_values

   !> The values in SI; their dimension must be that of the parameter in the deck.
   subroutine check_dimensions(deck, parameter_number, list, swept, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      integer, intent(in) :: parameter_number         !! of the parameter
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the values
      type(swept_t), intent(inout) :: swept           !! the parameter, its numbers are set
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(location_t) :: at
      type(quantity_t) :: quantity
      integer :: k

      associate (symbol => deck%symbols%list(parameter_number))
         swept%unit = unit_text(symbol%dimension)
         if (swept%unit == "") swept%unit = "1"
         deallocate (swept%numbers)
         allocate (swept%numbers(size(swept%texts)), source=not_a_number())
         do k = 1, size(swept%texts)
            at = span(list(1), list(size(list)))
            if (k <= size(list) .and. size(swept%texts) <= size(list)) at = list(k)%location
            if (swept%texts(k)%s(1:1) == "{") then
               call read_number(deck, list(k:k), "in the sweep of "//swept%name, quantity, mistakes)
            else
               call read_bare(swept%texts(k)%s, at, "in the sweep of "//swept%name, quantity, mistakes)
            end if
            if (.not. quantity%is_good) return
            if (.not. dimension_agrees(symbol%dimension, symbol%is_soft .or. quantity%is_soft, quantity%dimension)) then
               call mistakes%add(at, "parameter '"//swept%name//"' is "//dimension_name(symbol%dimension)//" in the deck", &
                               & "this is "//dimension_name(quantity%dimension))
               return
            end if
            swept%numbers(k) = quantity%x
         end do
      end associate
   end subroutine check_dimensions

end module sweep_values
