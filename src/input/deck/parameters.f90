!> Parameters of a deck: numbers with units, words, expressions over earlier ones, and overrides.
module parameters
   use number_cell, only: read_number
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name
   use expression_compile, only: dimension_agrees, is_reserved, name_length, symbol_broken, symbol_number, symbol_t, &
                               & symbol_word
   use item, only: location_t
   use name_table, only: name_table_t
   use quantities, only: is_not_finite, is_numeric, quantity_t, word_in_brace
   use source_text, only: line_of
   use spelling, only: nearest_word
   use text, only: join, segment, text_t
   use tokens, only: lex_line, span, token_brace, token_equals, token_t, token_word
   implicit none (type, external)
   private
   public :: read_parameters, section_name

   character(*), parameter :: section_name = "parameters"  !! where they stand

   !> An override of the command line.
   type :: override_t
      integer :: first = 1                      !! its first token
      integer :: last = 0                       !! its last token
      character(:), allocatable :: name         !! of the parameter
      logical :: is_used = .false.              !! there is such a parameter
   end type override_t

contains

   !> Work out all parameters in the order of the deck.
   subroutine read_parameters(deck, mistakes)
      type(deck_t), intent(inout) :: deck             !! the deck
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(name_table_t) :: table
      type(override_t), allocatable :: overrides(:)
      integer :: i, k, n

      call read_overrides(deck, overrides, table, mistakes)
      n = 0
      do k = 1, deck%n_line
         if (deck%sections(deck%lines(k)%section)%name == section_name) n = n + 1
      end do
      if (allocated(deck%parameter_text)) deallocate (deck%parameter_text)
      if (allocated(deck%parameter_change)) deallocate (deck%parameter_change)
      allocate (deck%parameter_text(n), deck%parameter_change(n))
      call deck%symbols%start(n)
      i = 0
      do k = 1, deck%n_line
         if (deck%sections(deck%lines(k)%section)%name /= section_name) cycle
         i = i + 1
         call read_one(deck, i, deck%tokens%t(deck%lines(k)%first:deck%lines(k)%last), overrides, table, mistakes)
      end do
      call report_unused(deck, overrides, mistakes)
   end subroutine read_parameters

   !> Cut the overrides into tokens.
   subroutine read_overrides(deck, overrides, table, mistakes)
      type(deck_t), intent(inout) :: deck                           !! the deck
      type(override_t), allocatable, intent(out) :: overrides(:)    !! (n) those that are well formed
      type(name_table_t), intent(inout) :: table                    !! the first of each name
      type(diagnostics_t), intent(inout) :: mistakes                !! collects what is wrong

      integer :: k, n, previous
      logical :: is_good

      allocate (overrides(deck%n_override))
      call table%start(deck%n_override)
      do k = 1, deck%n_override
         overrides(k)%name = ""
         overrides(k)%is_used = .true.
         overrides(k)%first = deck%tokens%n + 1
         call lex_line(deck%sources(k + 1), k + 1, 1, deck%tokens, mistakes, is_good)
         overrides(k)%last = deck%tokens%n
         if (.not. is_good) cycle
         n = overrides(k)%last - overrides(k)%first + 1
         if (n >= 3) is_good = deck%tokens%t(overrides(k)%first)%kind == token_word .and. &
                             & deck%tokens%t(overrides(k)%first + 1)%kind == token_equals
         if (n < 3 .or. .not. is_good) then
            call mistakes%add(location_t(k + 1, 1, 1, len(deck%sources(k + 1)%text)), "invalid override", &
                            & "write --set NAME=VALUE", "as in --set c=0.1mm")
            cycle
         end if
         overrides(k)%name = text_of(deck, deck%tokens%t(overrides(k)%first))
         overrides(k)%is_used = .false.
         call table%enter(overrides(k)%name, k, previous)
         if (previous > 0) then
            overrides(k)%is_used = .true.
            call mistakes%add(deck%tokens%t(overrides(k)%first)%location, "parameter '"//overrides(k)%name &
                            & //"' is set twice on the command line")
         end if
      end do
   end subroutine read_overrides

   !> One line of the section, and what the command line says of it.
   subroutine read_one(deck, i, list, overrides, table, mistakes)
      type(deck_t), intent(inout) :: deck                !! the deck
      integer, intent(in) :: i                           !! number of the parameter
      type(token_t), intent(in) :: list(:)               !! (n) tokens of the line
      type(override_t), intent(inout) :: overrides(:)    !! (n) of the command line
      type(name_table_t), intent(in) :: table            !! finds one of them
      type(diagnostics_t), intent(inout) :: mistakes     !! collects what is wrong

      type(symbol_t) :: changed, symbol
      integer :: j, k
      logical :: is_good

      deck%symbols%n_parameter = i
      deck%parameter_text(i)%s = ""
      is_good = size(list) >= 3
      if (is_good) is_good = list(1)%kind == token_word .and. list(2)%kind == token_equals
      if (.not. is_good) then
         call mistakes%add(span(list(1), list(size(list))), "invalid parameter", "write: name = value unit")
         symbol%name = ""
         symbol%kind = symbol_broken
         call deck%symbols%add(symbol)
         return
      end if
      symbol%name = text_of(deck, list(1))
      call check_name(deck, symbol%name, list(1)%location, mistakes)
      call read_symbol(deck, list(3:), symbol, mistakes)
      deck%parameter_text(i)%s = as_written(deck, list(3:))
      j = table%find(symbol%name)
      if (j > 0) then
         overrides(j)%is_used = .true.
         k = overrides(j)%first
         changed%name = symbol%name
         call read_symbol(deck, deck%tokens%t(k + 2:overrides(j)%last), changed, mistakes)
         call compare(symbol, changed, span(deck%tokens%t(k + 2), deck%tokens%t(overrides(j)%last)), mistakes)
         deck%parameter_text(i)%s = as_written(deck, deck%tokens%t(k + 2:overrides(j)%last))
         deck%parameter_change(i) = span(list(3), list(size(list)))
         symbol = changed
      end if
      call deck%symbols%add(symbol)
   end subroutine read_one

   !> Check the name of a parameter.
   subroutine check_name(deck, name, location, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, with the earlier parameters
      character(*), intent(in) :: name                !! as written
      type(location_t), intent(in) :: location        !! of the name
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      if (is_reserved(name)) then
         call mistakes%add(location, "'"//name//"' is not allowed as a parameter name", "reserved in expressions")
      else if (name_length(name) /= len(name)) then
         call mistakes%add(location, "'"//name//"' is not allowed as a parameter name", &
                         & "use a letter, then letters, digits and _")
      end if
      if (deck%symbols%find(name) > 0) then
         call mistakes%add(location, "parameter '"//name//"' is defined twice", "already defined")
      end if
   end subroutine check_name

   !> The value of a parameter: a word, or a number with or without a unit.
   subroutine read_symbol(deck, list, symbol, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck, with the earlier parameters
      type(token_t), intent(in) :: list(:)            !! (n) tokens of the value
      type(symbol_t), intent(inout) :: symbol         !! receives the value
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: place, word
      type(quantity_t) :: quantity
      logical :: is_number

      place = "in parameter "//symbol%name
      symbol%kind = symbol_broken
      is_number = .true.
      call word_in_brace(deck, list(1), word)
      if (.not. allocated(word) .and. list(1)%kind /= token_brace) then
         word = text_of(deck, list(1))
         is_number = list(1)%kind == token_word .and. (is_numeric(word) .or. is_not_finite(word))
      else if (allocated(word)) then
         is_number = .false.
      end if
      if (list(1)%kind == token_equals) then
         call mistakes%add(list(1)%location, "misplaced equals sign "//place)
      else if (is_number) then
         call read_number(deck, list, place, quantity, mistakes)
         if (.not. quantity%is_good) return
         symbol%kind = symbol_number
         symbol%number = quantity%x
         symbol%dimension = quantity%dimension
         symbol%is_soft = quantity%is_soft
      else if (size(list) > 1) then
         call mistakes%add(span(list(2), list(size(list))), "too many values "//place, "a parameter is one word or one number")
      else
         symbol%kind = symbol_word
         symbol%word = word
      end if
   end subroutine read_symbol

   !> Check that an override is of the same sort as the value in the deck.
   subroutine compare(symbol, changed, location, mistakes)
      type(symbol_t), intent(in) :: symbol            !! in the deck
      type(symbol_t), intent(inout) :: changed        !! of the command line; broken on return if it differs
      type(location_t), intent(in) :: location        !! of the new value
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: new, old

      if (symbol%kind == symbol_broken .or. changed%kind == symbol_broken) return
      old = "a word"
      if (symbol%kind == symbol_number) old = dimension_name(symbol%dimension)
      new = "a word"
      if (changed%kind == symbol_number) new = dimension_name(changed%dimension)
      if (symbol%kind == changed%kind) then
         if (symbol%kind == symbol_word) return
         if (dimension_agrees(symbol%dimension, symbol%is_soft .or. changed%is_soft, changed%dimension)) return
      end if
      call mistakes%add(location, "parameter '"//symbol%name//"' is "//old//" in the deck", "this is "//new)
      changed%kind = symbol_broken
   end subroutine compare

   !> The text of a value as it stands in the deck.
   function as_written(deck, list) result(s)
      type(deck_t), intent(in) :: deck      !! the deck
      type(token_t), intent(in) :: list(:)  !! (n) tokens of the value
      character(:), allocatable :: s        !! from the first to the last

      type(location_t) :: at

      at = span(list(1), list(size(list)))
      s = line_of(deck%sources(at%file), at%line)
      s = segment(s, at%first, at%last)
   end function as_written

   !> Report overrides of parameters that the deck does not have.
   subroutine report_unused(deck, overrides, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(override_t), intent(in) :: overrides(:)    !! (n) of the command line
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(text_t), allocatable :: names(:)
      character(:), allocatable :: help
      integer :: k

      do k = 1, size(overrides)
         if (overrides(k)%is_used) cycle
         names = deck%symbols%names_of(functions=.false.)
         help = nearest_word(overrides(k)%name, names)
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         if (size(names) == 0) then
            help = "the deck has no parameters"
         else
            help = help//"parameters: "//join(names, " ")
         end if
         call mistakes%add(deck%tokens%t(overrides(k)%first)%location, "unknown parameter '"//overrides(k)%name//"'", &
                         & "not a parameter of the deck", help)
      end do
   end subroutine report_unused

end module parameters
