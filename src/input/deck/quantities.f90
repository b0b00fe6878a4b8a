!> Numbers of a deck: from cells to SI, with every error reported at its place.
!>
!> A number is bare, has its unit glued to it, or has it beside it (settings); or it is an expression in
!> braces, which carries its own dimension.
module quantities
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: dimension_name, unit_text
   use expression, only: expression_t
   use expression_compile, only: compile_expression, dimension_agrees, evaluate_safely, fault_t, name_length, &
                               & symbol_number, symbol_word
   use item, only: location_t
   use kind_info, only: column_t, dim_none, dim_t, same_dimension
   use kinds, only: wp
   use observable_words, only: observable_words_t
   use numbers, only: number_length
   use text, only: lower, segment, to_text
   use tokens, only: token_brace, token_t
   use units, only: largest_quantity, parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: is_not_finite, is_numeric, is_unit_word, quantity_t, read_bare, read_brace, read_unit, report_dimension, &
      report_not_a_number, word_in_brace

   !> A number that has been read.
   type :: quantity_t
      real(wp) :: x = 0.0_wp               !! value, SI [any]
      type(dim_t) :: dimension = dim_none  !! of the value
      logical :: is_soft = .false.         !! its radians may be taken or left
      logical :: has_unit = .false.        !! a unit or a brace gave the dimension
      logical :: is_good = .false.         !! .false.: an error was reported
   end type quantity_t

contains

   !> Whether a word is meant to be a number: it starts like one.
   pure logical function is_numeric(word)
      character(*), intent(in) :: word  !! a cell

      is_numeric = number_length(word) > 0
   end function is_numeric

   !> Whether a word behind numbers is meant to be their unit: it is no number, and not what stands for one that is not finite.
   pure logical function is_unit_word(word)
      character(*), intent(in) :: word  !! a cell

      is_unit_word = .not. (is_numeric(word) .or. is_not_finite(word))
   end function is_unit_word

   !> Whether a word stands for what is no number, or no finite one.
   pure logical function is_not_finite(word)
      character(*), intent(in) :: word  !! a cell

      select case (lower(word(verify(word//"x", "+-"):)))
      case ("nan", "inf", "infinity")
         is_not_finite = .true.
      case default
         is_not_finite = .false.
      end select
   end function is_not_finite

   !> Read a unit; errors are reported.
   subroutine read_unit(string, location, place, unit, is_good, mistakes, wanted)
      character(*), intent(in) :: string              !! the unit
      type(location_t), intent(in) :: location        !! of the unit
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(unit_t), intent(out) :: unit               !! the unit
      logical, intent(out) :: is_good                 !! .false.: an error was reported
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(dim_t), intent(in), optional :: wanted     !! dimension of the place, for what is suggested

      character(:), allocatable :: help, message
      type(location_t) :: at
      integer :: first, k, last

      call parse_unit(string, unit, message, first, last, wanted)
      is_good = len(message) == 0
      if (is_good) return
      help = ""
      k = index(message, ": did you mean")
      if (k > 0) help = message(k + 2:)
      if (k > 0) message = segment(message, 1, k - 1)
      at = location
      at%first = location%first + first - 1
      at%last = location%first + last - 1
      call mistakes%add(at, message//" "//place, "", help)
   end subroutine read_unit

   !> Read a word that starts like a number; `beside` is its unit if that stands beside it.
   subroutine read_bare(word, location, place, quantity, mistakes, beside, wanted)
      character(*), intent(in) :: word                !! number, with or without a glued unit
      type(location_t), intent(in) :: location        !! of the word
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(quantity_t), intent(out) :: quantity       !! what it is
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(unit_t), intent(in), optional :: beside    !! for a number without its own unit
      type(dim_t), intent(in), optional :: wanted     !! dimension of the place, for the unit that is suggested

      type(location_t) :: at
      type(unit_t) :: unit
      integer :: n

      n = number_length(word)
      if (present(beside)) then
         unit = beside
         quantity%has_unit = .true.
      end if
      if (n < len(word)) then
         if (verify(word(n + 1:n + 1), "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ") /= 0) then
            call report_not_a_number(word, location, place, mistakes)
            return
         end if
         at = location
         at%first = location%first + n
         call read_unit(word(n + 1:), at, place, unit, quantity%is_good, mistakes, wanted)
         if (.not. quantity%is_good) return
         quantity%has_unit = .true.
      end if
      call read_quantity(word(1:n), unit, quantity%x, quantity%is_good)
      quantity%dimension = unit%dimension
      if (.not. quantity%is_good) call mistakes%add(location, "'"//word//"' is too large "//place, &
                                                    "the limit is "//to_text(largest_quantity)//" in SI units")
   end subroutine read_bare

   !> Report a word where a number is requested.
   subroutine report_not_a_number(word, location, place, mistakes, deck)
      character(*), intent(in) :: word                !! as written
      type(location_t), intent(in) :: location        !! of the word
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(deck_t), intent(in), optional :: deck      !! for its parameters

      character(:), allocatable :: help
      integer :: i, n

      if (is_not_finite(word)) then
         call mistakes%add(location, "'"//word//"' is not finite "//place, "expected a number")
         return
      end if
      help = ""
      n = number_length(word)
      if (n > 0 .and. n < len(word)) then
         if (word(n + 1:n + 1) == ",") help = "use a decimal point: "//word(1:n)//"."//word(n + 2:)
         if (scan(word(n + 1:n + 1), "*/+-^(") == 1) help = "put an expression in braces: {"//word//"}"
      else if (present(deck)) then
         i = deck%symbols%find(word)
         if (i > 0 .and. i <= deck%symbols%n_parameter) help = "write {"//word//"} for the parameter"
      end if
      if (index(word, "{") == 1 .and. index(word, "}", back=.true.) == len(word)) then
         help = "write an expression without quotes: "//word
      end if
      if (len(help) == 0 .and. scan(word, "*/+^()") > 0) help = "put an expression in braces"
      call mistakes%add(location, "'"//word//"' is not a number "//place, "expected a number", help)
   end subroutine report_not_a_number

   !> Read an expression; without a variable its value is worked out.
   subroutine read_brace(deck, token, place, has_variable, compiled, quantity, mistakes, column)
      type(deck_t), intent(in) :: deck                !! for its parameters
      type(token_t), intent(in) :: token              !! the brace
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      logical, intent(in) :: has_variable             !! it may depend on the time, or on the column's variable
      type(expression_t), intent(out) :: compiled     !! the expression
      type(quantity_t), intent(out) :: quantity       !! its value, that at 0 if it moves
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(column_t), intent(in), optional :: column  !! names the variable

      type(fault_t), allocatable :: fault
      type(location_t) :: at
      real(wp) :: d1, d2

      if (present(column)) then
         if (column%sees_motion) then
            call compile_expression(text_of(deck, token), deck%symbols, has_variable, compiled, fault, column%variable, &
                                  & column%argument, observable_words_t())
         else
            call compile_expression(text_of(deck, token), deck%symbols, has_variable, compiled, fault, column%variable, &
                                  & column%argument)
         end if
      else
         call compile_expression(text_of(deck, token), deck%symbols, has_variable, compiled, fault)
      end if
      if (allocated(fault)) then
         if (len(fault%message) == 0) return
         at = token%location
         at%first = token%location%first + fault%first
         at%last = token%location%first + fault%last
         call mistakes%add(at, "invalid expression "//place, fault%message, fault%help)
         return
      end if
      call evaluate_safely(compiled, 0.0_wp, quantity%x, d1, d2)
      quantity%dimension = compiled%dimension
      quantity%is_soft = compiled%is_soft
      quantity%has_unit = .true.
      quantity%is_good = .true.
      if (compiled%is_constant .and. .not. ieee_is_finite(quantity%x)) then
         quantity%is_good = .false.
         call mistakes%add(token%location, "the expression is not finite "//place, "not a finite number")
      end if
   end subroutine read_brace

   !> The word that a brace stands for; unallocated if it is not a parameter that is a word.
   subroutine word_in_brace(deck, token, word)
      type(deck_t), intent(in) :: deck                      !! for its parameters
      type(token_t), intent(in) :: token                    !! the token
      character(:), allocatable, intent(out) :: word        !! the parameter's word

      character(:), allocatable :: name
      integer :: i

      if (token%kind /= token_brace) return
      name = trim(adjustl(text_of(deck, token)))
      if (name_length(name) /= len(name)) return
      i = deck%symbols%find(name)
      if (i == 0) return
      if (deck%symbols%list(i)%kind == symbol_word) word = deck%symbols%list(i)%word
   end subroutine word_in_brace

   !> Report a number whose dimension is not what is requested; nothing happens if it agrees.
   subroutine report_dimension(quantity, wanted, location, place, mistakes)
      type(quantity_t), intent(inout) :: quantity     !! the number; not good on return if it disagrees
      type(dim_t), intent(in) :: wanted               !! dimension of the column
      type(location_t), intent(in) :: location        !! of the number
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      character(:), allocatable :: help

      if (.not. quantity%is_good) return
      if (dimension_agrees(quantity%dimension, quantity%is_soft, wanted)) return
      quantity%is_good = .false.
      help = ""
      if (.not. quantity%has_unit) then
         call mistakes%add(location, "missing unit "//place, dimension_name(wanted)//" expected", &
                         & "put the unit after the number; its SI unit is "//unit_text(wanted))
      else
         if (same_dimension(wanted, dim_t(rad=1, s=-1)) .and. same_dimension(quantity%dimension, dim_t(s=-1))) then
            help = "use rad/s, rpm or rev/s for an angular speed, not Hz; an expression may use 2*pi*f"
         end if
         call mistakes%add(location, "wrong dimension "//place, "this is "//dimension_name(quantity%dimension)//", " &
                         & //dimension_name(wanted)//" expected", help)
      end if
   end subroutine report_dimension

end module quantities
