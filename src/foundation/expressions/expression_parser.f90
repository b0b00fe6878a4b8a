!> The reader of expressions: text to a postfix program, with dimensions.
!>
!>     sum     = term { ("+" | "-") term }
!>     term    = signed { ("*" | "/") signed }
!>     signed  = { "+" | "-" } power                       so that -2^2 is -4
!>     power   = primary [ "^" signed ]                    right-associative: 2^3^2 is 2^9
!>     primary = number [unit] | name | name "(" sum {"," sum} ")" | channel | "(" sum ")"
!>     channel = name "." name {"." name}
!>
!> Functions are those of expression_functions, and the deck's own by their names.
!> Names are parameters, `pi`, and the time `t` where it is allowed. A unit follows its number with or
!> without a blank; inside, it has none: `5 rad/s * t`, `3kg.m^2`. `10 mm^2` is ten square millimetres.
!> After a number a slash belongs to the unit if a known unit follows at once. `t` is always the time.
module expression_parser
   use dimension_text, only: dimension_name
   use expression, only: evaluate_code, n_variable, op_add, op_divide, op_integer_power, op_multiply, op_negate, op_power, &
      op_real_power, op_rise, op_subtract, op_time
   use expression_dimension, only: combine_power, combine_product, combine_sum, term_t
   use expression_leaves, only: parse_number
   use expression_state, only: advance, descend, emit, fail, letters, name_length, parser_t, peek, suggestion
   use kind_info, only: dim_none, same_dimension
   use kinds, only: wp
   use numbers, only: number_length
   implicit none (type, external)
   private
   public :: close_parenthesis, parse_sum, parse_whole

   interface

      !> A name, or a function with its arguments.
      module recursive subroutine parse_word(parser, term)
         implicit none (type, external)
         type(parser_t), intent(inout) :: parser  !! the reader, at the name
         type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read
      end subroutine parse_word

   end interface

contains

   !> Read the whole text.
   subroutine parse_whole(parser, whole)
      type(parser_t), intent(inout) :: parser  !! the reader, new
      type(term_t), intent(out) :: whole       !! the expression

      if (peek(parser) == "") then
         call fail(parser, 1, len(parser%source), "the expression is empty")
         return
      end if
      call parse_sum(parser, whole)
      if (allocated(parser%fault)) return
      select case (peek(parser))
      case ("")
         return
      case (")")
         call fail(parser, parser%at, parser%at, "no matching opening parenthesis")
      case ("<", ">", "=")
         call fail(parser, parser%at, parser%at, "expressions have no comparisons", &
                 & "use step(x): 0 for negative x, else 1")
      case default
         call fail(parser, parser%at, parser%at, "missing operator")
      end select
   end subroutine parse_whole

   !> Sums and differences.
   recursive subroutine parse_sum(parser, term)
      type(parser_t), intent(inout) :: parser  !! the reader
      type(term_t), intent(out) :: term        !! what was read

      type(term_t) :: right
      character(:), allocatable :: message
      character :: sign

      call parse_term(parser, term)
      do while (.not. allocated(parser%fault))
         sign = peek(parser)
         if (sign /= "+" .and. sign /= "-") return
         call advance(parser, 1)
         call parse_term(parser, right)
         if (allocated(parser%fault)) return
         call combine_sum(term, right, message)
         term%last = right%last
         if (len(message) > 0) call fail(parser, right%first, right%last, message)
         call emit(parser, merge(op_add, op_subtract, sign == "+"))
      end do
   end subroutine parse_sum

   !> Products and quotients.
   recursive subroutine parse_term(parser, term)
      type(parser_t), intent(inout) :: parser  !! the reader
      type(term_t), intent(out) :: term        !! what was read

      type(term_t) :: right
      character :: sign

      call parse_signed(parser, term)
      do while (.not. allocated(parser%fault))
         sign = peek(parser)
         if (sign /= "*" .and. sign /= "/") return
         call advance(parser, 1)
         if (sign == "*" .and. peek(parser) == "*") then
            call fail(parser, parser%at - 1, parser%at, "write a power with ^")
            return
         end if
         call parse_signed(parser, right)
         if (allocated(parser%fault)) return
         call combine_product(term, right, merge(1, -1, sign == "*"))
         term%last = right%last
         call emit(parser, merge(op_multiply, op_divide, sign == "*"))
      end do
   end subroutine parse_term

   !> Signs, which bind less than a power.
   recursive subroutine parse_signed(parser, term)
      type(parser_t), intent(inout) :: parser  !! the reader
      type(term_t), intent(out) :: term        !! what was read

      character :: sign
      integer :: first

      sign = peek(parser)
      if (sign /= "+" .and. sign /= "-") then
         call parse_power(parser, term)
         return
      end if
      first = parser%at
      call advance(parser, 1)
      call descend(parser)
      if (allocated(parser%fault)) return
      call parse_signed(parser, term)
      parser%depth = parser%depth - 1
      term%first = first
      if (sign == "-") call emit(parser, op_negate)
   end subroutine parse_signed

   !> Powers.
   recursive subroutine parse_power(parser, term)
      type(parser_t), intent(inout) :: parser  !! the reader
      type(term_t), intent(out) :: term        !! what was read

      type(term_t) :: right

      call parse_primary(parser, term)
      if (allocated(parser%fault) .or. peek(parser) /= "^") return
      call advance(parser, 1)
      call descend(parser)
      if (allocated(parser%fault)) return
      call parse_signed(parser, right)
      parser%depth = parser%depth - 1
      if (allocated(parser%fault)) return
      term%last = right%last
      if (.not. same_dimension(right%dimension, dim_none)) then
         call fail(parser, right%first, right%last, "an exponent must be dimensionless, got " &
                 & //dimension_name(right%dimension))
      else if (right%is_constant) then
         call raise_to_constant(parser, term, right)
      else if (same_dimension(term%dimension, dim_none)) then
         term%is_constant = .false.
         call emit(parser, op_power)
      else
         call fail(parser, term%first, term%last, "a variable exponent needs a dimensionless base")
      end if
   end subroutine parse_power

   !> A power with a constant exponent, which is worked out and taken from the program.
   subroutine raise_to_constant(parser, term, right)
      type(parser_t), intent(inout) :: parser  !! the reader
      type(term_t), intent(inout) :: term      !! the base; the power on return
      type(term_t), intent(in) :: right        !! the exponent

      real(wp), parameter :: largest = 1000.0_wp  !! larger exponents are refused [1]
      real(wp) :: jet(3)
      integer :: n

      n = parser%n_code - right%start + 1
      call evaluate_code(n, parser%code(right%start:parser%n_code), parser%operand(right%start:parser%n_code), &
                       & parser%curves, spread(0.0_wp, 1, n_variable), 1, jet)
      parser%n_code = right%start - 1
      if (.not. abs(jet(1)) <= largest) then
         call fail(parser, right%first, right%last, "this exponent must be a number up to 1000")
         return
      end if
      call combine_power(term, jet(1))
      if (abs(jet(1) - anint(jet(1))) > 0.0_wp) then
         call emit(parser, op_real_power, jet(1))
      else
         call emit(parser, op_integer_power, jet(1))
      end if
   end subroutine raise_to_constant

   !> Numbers, names, functions and parentheses.
   recursive subroutine parse_primary(parser, term)
      type(parser_t), intent(inout) :: parser  !! the reader
      type(term_t), intent(out) :: term        !! what was read

      integer :: first, start

      first = parser%at
      start = parser%n_code + 1
      term%first = first
      if (peek(parser) == "") then
         call fail(parser, len(parser%source), len(parser%source), "the expression is incomplete")
      else if (peek(parser) == "(") then
         call advance(parser, 1)
         call descend(parser)
         if (allocated(parser%fault)) return
         call parse_sum(parser, term)
         call close_parenthesis(parser, first)
      else if (scan(peek(parser), letters) == 1) then
         call parse_word(parser, term)
      else if (number_length(parser%source(parser%at:)) > 0) then
         call parse_number(parser, term)
      else
         call fail(parser, parser%at, parser%at, "expected a number, a name or a parenthesis")
      end if
      term%first = first
      term%last = parser%last
      term%start = start
   end subroutine parse_primary

   !> The end of a parenthesis.
   subroutine close_parenthesis(parser, first)
      type(parser_t), intent(inout) :: parser  !! the reader
      integer, intent(in) :: first             !! where it was opened

      if (allocated(parser%fault)) return
      parser%depth = parser%depth - 1
      if (peek(parser) == ")") then
         call advance(parser, 1)
      else if (peek(parser) == "") then
         call fail(parser, first, parser%last, "missing closing parenthesis")
      else
         call fail(parser, parser%at, parser%at, "expected an operator or a closing parenthesis")
      end if
   end subroutine close_parenthesis

end module expression_parser
