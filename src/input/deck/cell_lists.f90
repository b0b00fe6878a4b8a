!> Words of a deck: single ones, lists of them, and options `name=value`.
module cell_lists
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use expression, only: expression_t
   use item, only: location_t, option_t, value_t
   use kind_info, only: dim_none, same_dimension
   use quantities, only: is_numeric, quantity_t, read_bare, read_brace, word_in_brace
   use spelling, only: nearest_word
   use text, only: exact_text, join, split_blank, text_t
   use text_list, only: text_list_t
   use tokens, only: span, token_brace, token_equals, token_t, token_word
   implicit none (type, external)
   private
   public :: read_options, read_word, read_words

contains

   !> One word: bare, in quotes, or a parameter in braces.
   subroutine read_word(deck, place, token, word, mistakes, not_empty)
      type(deck_t), intent(in) :: deck                      !! the deck
      character(*), intent(in) :: place                     !! as `in column i of joint.revolute`
      type(token_t), intent(in) :: token                    !! the cell
      character(:), allocatable, intent(out) :: word        !! the word; empty if an error was reported
      type(diagnostics_t), intent(inout) :: mistakes        !! collects what is wrong
      logical, intent(in), optional :: not_empty            !! whether nothing in quotes is an error

      type(expression_t) :: compiled
      type(quantity_t) :: quantity

      if (token%kind == token_equals) then
         word = ""
         call mistakes%add(token%location, "misplaced equals sign "//place, "expected a word")
         return
      else if (token%kind /= token_brace) then
         word = text_of(deck, token)
      else
         call word_in_brace(deck, token, word)
      end if
      if (allocated(word)) then
         if (len_trim(word) > 0 .or. .not. present(not_empty)) return
         if (not_empty) call mistakes%add(token%location, "empty quotes "//place, "expected a word")
         return
      end if
      word = ""
      call read_brace(deck, token, place, .false., compiled, quantity, mistakes)
      if (quantity%is_good) call mistakes%add(token%location, "expected a word, got a number "//place, &
                                            & "a number")
   end subroutine read_word

   !> A list of words; what stands in parentheses is one word, with one blank between two cells that no sign parts.
   subroutine read_words(deck, place, list, value, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: place               !! as `in key channels of output`
      type(token_t), intent(in) :: list(:)            !! (n) cells
      type(value_t), intent(inout) :: value           !! receives the words
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(location_t) :: places(size(list))
      type(text_list_t) :: words
      character(:), allocatable :: whole, word
      integer :: depth, first, k

      whole = ""
      depth = 0
      first = 1
      do k = 1, size(list)
         if (depth == 0) first = k
         if (list(k)%kind == token_brace) then
            call resolve_brace(deck, place, list(k), word, mistakes)
         else if (list(k)%kind == token_equals .and. depth > 0) then
            word = "="
         else
            call read_word(deck, place, list(k), word, mistakes)
         end if
         if (k > first .and. len(whole) > 0 .and. len(word) > 0) then
            if (scan(whole(len(whole):), "(,=") == 0 .and. scan(word(1:1), "),=") == 0) whole = whole//" "
         end if
         whole = whole//word
         if (list(k)%kind == token_word) depth = depth + n_of(word, "(") - n_of(word, ")")
         if (depth > 0) cycle
         if (depth < 0) call mistakes%add(list(k)%location, "missing opening parenthesis "//place)
         depth = 0
         call words%add(whole)
         places(words%n) = span(list(first), list(k))
         whole = ""
      end do
      value%words = words%get()
      value%places = places(1:words%n)
      if (depth > 0) call mistakes%add(span(list(first), list(size(list))), "missing closing parenthesis "//place)
   end subroutine read_words

   !> The word of a brace, or its number as text with an SI unit.
   subroutine resolve_brace(deck, place, token, word, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: place               !! as `in key channels of output`
      type(token_t), intent(in) :: token              !! the brace
      character(:), allocatable, intent(out) :: word  !! what it stands for
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(expression_t) :: compiled
      type(quantity_t) :: quantity

      call word_in_brace(deck, token, word)
      if (allocated(word)) return
      word = ""
      call read_brace(deck, token, place, .false., compiled, quantity, mistakes)
      if (.not. quantity%is_good) return
      word = exact_text(quantity%x)
      if (.not. same_dimension(quantity%dimension, dim_none)) word = word//unit_text(quantity%dimension)
   end subroutine resolve_brace

   !> Options `name=value` after a word.
   subroutine read_options(deck, known, place, list, value, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: known               !! blank-separated names of options
      character(*), intent(in) :: place               !! as `in key stabilise of analysis.dynamic`
      type(token_t), intent(in) :: list(:)            !! (n) cells after the word
      type(value_t), intent(inout) :: value           !! receives the options
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(option_t), allocatable :: found(:)
      integer :: k, n

      n = 0
      allocate (found(size(list)/3))
      k = 1
      do while (k <= size(list))
         if (.not. is_option(list, k)) then
            call mistakes%add(list(k)%location, "expected an option "//place, "not of the form name=value", &
                            & "options: "//known)
            exit
         end if
         n = n + 1
         call read_option(deck, known, place, list(k:k + 2), found(n), mistakes)
         call check_double(found(1:n), place, mistakes)
         k = k + 3
      end do
      deallocate (value%options)
      allocate (value%options(n))
      do k = 1, n
         value%options(k) = found(k)
      end do
   end subroutine read_options

   !> Whether three tokens are `name=value`.
   pure logical function is_option(list, k)
      type(token_t), intent(in) :: list(:)  !! cells
      integer, intent(in) :: k              !! the first of the three

      is_option = .false.
      if (k + 2 > size(list)) return
      is_option = list(k)%kind == token_word .and. list(k + 1)%kind == token_equals .and. list(k + 2)%kind /= token_equals
   end function is_option

   !> One option.
   subroutine read_option(deck, known, place, list, option, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      character(*), intent(in) :: known               !! blank-separated names of options
      character(*), intent(in) :: place               !! as `in key stabilise of analysis.dynamic`
      type(token_t), intent(in) :: list(:)            !! (3) name, equals sign, value
      type(option_t), intent(out) :: option           !! the option
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(expression_t) :: compiled
      type(quantity_t) :: quantity
      type(text_t), allocatable :: names(:)
      character(:), allocatable :: help
      integer :: i

      option%name = text_of(deck, list(1))
      option%location = span(list(1), list(3))
      option%text = text_of(deck, list(3))
      names = split_blank(known)
      do i = 1, size(names)
         if (names(i)%s == option%name) exit
      end do
      if (i > size(names)) then
         help = nearest_word(option%name, names)
         if (len(help) > 0) help = "did you mean '"//help//"'? "
         call mistakes%add(list(1)%location, "unknown option '"//option%name//"' "//place, "not an option of this key", &
                         & help//"options: "//join(names, " "))
      end if
      if (list(3)%kind == token_word .and. is_numeric(option%text)) then
         call read_bare(option%text, list(3)%location, place, quantity, mistakes)
      else if (list(3)%kind == token_brace) then
         call resolve_brace(deck, place, list(3), option%text, mistakes)
         if (is_numeric(option%text)) call read_brace(deck, list(3), place, .false., compiled, quantity, mistakes)
      end if
      option%is_number = quantity%is_good
      option%number = quantity%x
      option%dimension = quantity%dimension
   end subroutine read_option

   !> Report an option that stands twice.
   subroutine check_double(options, place, mistakes)
      type(option_t), intent(in) :: options(:)        !! (n) the last one is new
      character(*), intent(in) :: place               !! as `in key stabilise of analysis.dynamic`
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      integer :: i, n

      n = size(options)
      do i = 1, n - 1
         if (options(i)%name == options(n)%name) then
            call mistakes%add(options(n)%location, "option '"//options(n)%name//"' is given twice "//place)
         end if
      end do
   end subroutine check_double

   !> How often a character occurs.
   pure integer function n_of(string, c)
      character(*), intent(in) :: string  !! any string
      character, intent(in) :: c          !! what to count

      integer :: i

      n_of = 0
      do i = 1, len(string)
         if (string(i:i) == c) n_of = n_of + 1
      end do
   end function n_of

end module cell_lists
