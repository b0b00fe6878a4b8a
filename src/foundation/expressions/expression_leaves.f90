!> The ends of the grammar of expressions: names, and numbers with their units.
module expression_leaves
   use expression, only: op_number, op_time
   use expression_dimension, only: term_t
   use expression_functions, only: function_names, function_operation
   use expression_reader, only: advance, digits, fail, letters, name_length, peek
   use expression_state, only: emit, find_variable, parser_t, resolve, suggestion
   use expression_symbols, only: symbol_function, symbol_number, symbol_word
   use kinds, only: pi, wp
   use numbers, only: number_length
   use text, only: join, text_t, to_text
   use units, only: exponent_length, largest_quantity, parse_unit, read_quantity, unit_t
   implicit none (type, external)
   private
   public :: parse_name, parse_number

contains

   !> A parameter, a constant or the time.
   subroutine parse_name(parser, name, term)
      class(parser_t), intent(inout) :: parser !! the reader, after the name
      character(*), intent(in) :: name         !! the name
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read

      integer :: last

      last = term%first + len(name) - 1
      if (name == "pi") then
         term%is_soft = .true.
         call emit(parser, op_number, pi)
         return
      else if (find_variable(parser, name) > 0) then
         term%dimension = parser%arguments(find_variable(parser, name))
         term%is_constant = .false.
         if (parser%symbols%find(name) > 0) call fail(parser, term%first, last, "'"//name &
            & //"' is both the variable here and a parameter", "rename the parameter")
         call emit(parser, op_time, real(find_variable(parser, name), wp))
         return
      else if (name == "t") then
         call fail(parser, term%first, last, "the time 't' is not allowed here", "only drivers and loads may depend on time")
         return
      end if
      if (parser%symbols%find(name) > 0) then
         call use_symbol(parser, parser%symbols%find(name), term, last)
      else if (function_operation(name) > 0) then
         call fail(parser, term%first, last, "the function '"//name//"' needs its argument in parentheses")
      else
         call refuse_name(parser, name, term%first, last)
      end if
   end subroutine parse_name

   !> A name that nothing has: the variables of the place, or the nearest parameter.
   subroutine refuse_name(parser, name, first, last)
      class(parser_t), intent(inout) :: parser !! the reader, after the name
      character(*), intent(in) :: name         !! the name
      integer, intent(in) :: first             !! its first character
      integer, intent(in) :: last              !! its last character

      type(text_t), allocatable :: known(:)
      character(:), allocatable :: message, otherwise, variables

      message = "unknown parameter '"//name//"'"
      otherwise = "define the parameter in [parameters], before its use"
      variables = join(parser%variables, ", ")
      if (len(variables) > 0 .and. variables /= "t") then
         message = "unknown variable or parameter '"//name//"'"
         otherwise = "variables here: "//variables//"; or "//otherwise
      end if
      known = parser%symbols%names_of(functions=.false.)
      known = [known, parser%variables]
      call fail(parser, first, last, message, suggestion(name, known, otherwise))
   end subroutine refuse_name

   !> The value of a parameter.
   subroutine use_symbol(parser, i, term, last)
      class(parser_t), intent(inout) :: parser !! the reader
      integer, intent(in) :: i                 !! number of the parameter
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read
      integer, intent(in) :: last              !! last character of its name

      associate (symbol => parser%symbols%list(i))
         select case (symbol%kind)
         case (symbol_number)
            term%dimension = symbol%dimension
            term%is_soft = symbol%is_soft
            call emit(parser, op_number, symbol%number)
            call resolve(parser, i, term%first, last)
         case (symbol_word)
            call fail(parser, term%first, last, "the parameter '"//symbol%name//"' has the value '" &
                    & //symbol%word//"', not a number")
         case (symbol_function)
            call fail(parser, term%first, last, "the function '"//symbol%name &
                    & //"' needs its argument in parentheses", "as "//symbol%name//"(t)")
         case default
            call fail(parser, term%first, last, "")
         end select
      end associate
   end subroutine use_symbol

   !> A number, with its unit if it has one.
   subroutine parse_number(parser, term)
      class(parser_t), intent(inout) :: parser !! the reader, at the number
      type(term_t), intent(inout) :: term      !! what was read

      type(unit_t) :: unit
      real(wp) :: x
      integer :: first, length
      logical :: is_finite

      first = parser%at
      length = number_length(parser%source(first:))
      call advance(parser, length)
      if (scan(peek(parser), letters//"%") == 1) call parse_glued_unit(parser, unit)
      if (allocated(parser%fault)) return
      call read_quantity(parser%source(first:first + length - 1), unit, x, is_finite)
      if (.not. is_finite) call fail(parser, first, first + length - 1, "too large: the limit is "// &
                                    to_text(largest_quantity)//" in SI units")
      term%dimension = unit%dimension
      call emit(parser, op_number, x)
   end subroutine parse_number

   !> The unit after a number.
   subroutine parse_glued_unit(parser, unit)
      class(parser_t), intent(inout) :: parser !! the reader, at the unit
      type(unit_t), intent(out) :: unit        !! the unit

      character(:), allocatable :: message, name
      integer :: first, last, length, start

      start = parser%at
      name = parser%source(start:start + max(1, name_length(parser%source(start:))) - 1)
      length = unit_length(parser, start)
      if (.not. allocated(parser%fault)) then
         call parse_unit(parser%source(start:start + length - 1), unit, message, first, last)
         if (len(message) == 0 .and. name /= "t") then
            call advance(parser, length)
         else if (is_name(parser, name)) then
            call fail(parser, start, start + len(name) - 1, "missing operator before '"//name//"'")
         else
            call fail(parser, start + first - 1, start + last - 1, message)
         end if
      end if
   end subroutine parse_glued_unit

   !> Whether a word is the time, a constant, a function or a parameter.
   pure logical function is_name(parser, word)
      class(parser_t), intent(in) :: parser !! the reader
      character(*), intent(in) :: word      !! any word

      is_name = word == "t" .or. find_variable(parser, word) > 0 .or. word == "pi" .or. function_operation(word) > 0 &
              & .or. parser%symbols%find(word) > 0
   end function is_name

   !> Number of characters of a unit: names joined by dots and slashes, with exponents.
   integer function unit_length(parser, start)
      class(parser_t), intent(inout) :: parser !! the reader
      integer, intent(in) :: start             !! first character of the unit

      character(:), allocatable :: message, word
      type(unit_t) :: unit
      integer :: at, first, last, n

      at = start + word_length(parser%source(start:))
      do
         if (at > len(parser%source)) exit
         if (parser%source(at:at) == "^") then
            n = exponent_length(parser%source(at + 1:))
            if (n == 0) exit
            at = at + 1 + n
         else if (scan(parser%source(at:at), "./") == 1) then
            n = word_length(parser%source(at + 1:))
            if (n == 0) exit
            word = parser%source(at + 1:at + n)
            if (parser%source(at:at) == "/") then
               if (word == "t") exit
               call parse_unit(word, unit, message, first, last)
               if (len(message) > 0) exit
               if (is_name(parser, word)) call fail(parser, at, at + n, "'"//word//"' is both a unit and a parameter", &
                                                  & "put blanks around the slash to use the parameter, or rename it")
            end if
            at = at + 1 + n
         else
            exit
         end if
      end do
      unit_length = at - start
   end function unit_length

   !> Number of characters of a word that may be a unit.
   pure integer function word_length(string)
      character(*), intent(in) :: string  !! any string

      word_length = verify(string, letters//digits//"_%") - 1
      if (word_length < 0) word_length = len(string)
      if (len(string) == 0) return
      if (scan(string(1:1), digits) == 1) word_length = 0
   end function word_length

end module expression_leaves
