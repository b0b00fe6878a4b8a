!> From text of a deck to an `expression_t`: the grammar of expression_parser, dimensions of expression_dimension.
!>
!> A unit follows its number with or without a blank; inside, it has none: `5 rad/s * t`, `3kg.m^2`. `10 mm^2` is ten square
!> millimetres. After a number a slash belongs to the unit if a known unit follows at once. `t` is always the time.
module expression_compile
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_flag, ieee_set_halting_mode, ieee_set_status, &
                                          & ieee_status_type, ieee_usual
   use dimension_text, only: dimension_name
   use expression, only: evaluate_code, expression_t, n_variable, op_add, op_atan2, op_divide, op_integer_power, op_multiply, &
      op_negate, op_number, op_power, op_real_power, op_subtract, op_time, stack_size
   use expression_dimension, only: combine_power, combine_product, combine_sum, dimension_agrees, term_t
   use expression_functions, only: function_names, function_operation
   use expression_leaves, only: parse_number
   use expression_parser, only: parse_whole
   use expression_reader, only: fail, fault_t, name_length
   use expression_state, only: channel_finder_t, emit, new_parser, parser_t
   use expression_symbols, only: symbol_broken, symbol_function, symbol_number, symbol_state, symbol_t, symbol_word, symbols_t
   use expression_words, only: parse_word
   use kind_info, only: dim_none, dim_t, dim_time, same_dimension
   use kinds, only: wp
   use numbers, only: number_length
   implicit none (type, external)
   private
   public :: channel_finder_t, compile_expression, dimension_agrees, evaluate_safely, fault_t, function_names, is_reserved
   public :: name_length
   public :: symbol_broken, symbol_function, symbol_number, symbol_state, symbol_t, symbol_word, symbols_t

   !> The dialect of decks: a postfix program.
   type, extends(parser_t) :: compiler_t
   contains
      procedure :: combine
      procedure :: read_number
      procedure :: read_word
   end type compiler_t

contains

   !> Compile an expression.
   subroutine compile_expression(source, symbols, has_variable, compiled, fault, variable, argument, finder)
      character(*), intent(in) :: source                !! text, without braces
      type(symbols_t), intent(in) :: symbols            !! parameters and functions that it may use
      logical, intent(in) :: has_variable               !! whether it may depend on a variable
      type(expression_t), intent(out) :: compiled       !! the expression
      type(fault_t), allocatable, intent(out) :: fault  !! unallocated: success
      character(*), intent(in), optional :: variable    !! names of the variables, blank-separated; absent: `t`
      type(dim_t), intent(in), optional :: argument(:)  !! (any) dimensions of the variables; absent: a time
      class(channel_finder_t), intent(in), optional, target :: finder  !! knows the channels that it may use; absent: none

      character(:), allocatable :: names
      type(ieee_status_type) :: status
      type(compiler_t) :: parser
      type(term_t) :: whole
      type(dim_t) :: dimensions(n_variable)
      integer :: k

      names = "t"
      if (present(variable)) names = trim(variable)
      if (.not. has_variable) names = ""
      dimensions = dim_time
      if (present(argument)) dimensions(1:size(argument)) = argument
      call new_parser(parser, source, symbols, names, dimensions)
      if (present(finder)) parser%finder => finder
      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      call parse_whole(parser, whole)
      call ieee_set_status(status)
      if (needed_stack(parser%n_code, parser%code) > stack_size) then
         call fail(parser, 1, len(source), "the expression is nested too deeply")
      end if
      if (allocated(parser%fault)) then
         call move_alloc(parser%fault, fault)
         return
      end if
      compiled%source = parser%resolved//source(parser%n_resolved + 1:)
      compiled%dimension = whole%dimension
      compiled%is_soft = whole%is_soft
      compiled%is_constant = whole%is_constant
      allocate (compiled%code(parser%n_code), compiled%operand(parser%n_code))
      compiled%code(:) = parser%code(1:parser%n_code)
      compiled%operand(:) = parser%operand(1:parser%n_code)
      if (allocated(parser%curves)) call move_alloc(parser%curves, compiled%curves)
      if (parser%n_seen == 0) return
      allocate (compiled%observables(parser%n_seen))
      do k = 1, parser%n_seen
         compiled%observables(k) = parser%observables(k)
      end do
   end subroutine compile_expression

   !> A number, with its unit if it has one.
   recursive subroutine read_number(self, term)
      class(compiler_t), intent(inout) :: self !! the reader, at the number
      type(term_t), intent(inout) :: term      !! what was read

      term%start = self%n_code + 1
      call parse_number(self, term)
   end subroutine read_number

   !> A name, or a function with its arguments.
   recursive subroutine read_word(self, term)
      class(compiler_t), intent(inout) :: self !! the reader, at the name
      type(term_t), intent(inout) :: term      !! in: where it starts; out: what was read

      term%start = self%n_code + 1
      call parse_word(self, term)
   end subroutine read_word

   !> The operation of a sign, with the dimension of its value.
   subroutine combine(self, sign, left, right)
      class(compiler_t), intent(inout) :: self !! the reader
      character, intent(in) :: sign            !! one of `+ - * / ^ ~`
      type(term_t), intent(inout) :: left      !! first operand; the result on return
      type(term_t), intent(in) :: right        !! second operand

      character(:), allocatable :: message

      select case (sign)
      case ("+", "-")
         call combine_sum(left, right, message)
         if (len(message) > 0) call fail(self, right%first, right%last, message)
         call emit(self, merge(op_add, op_subtract, sign == "+"))
      case ("*", "/")
         call combine_product(left, right, merge(1, -1, sign == "*"))
         call emit(self, merge(op_multiply, op_divide, sign == "*"))
      case ("^")
         call raise(self, left, right)
      case default
         call emit(self, op_negate)
      end select
   end subroutine combine

   !> A power.
   subroutine raise(parser, base, exponent)
      type(compiler_t), intent(inout) :: parser !! the reader
      type(term_t), intent(inout) :: base       !! the base; the power on return
      type(term_t), intent(in) :: exponent      !! the exponent

      if (.not. same_dimension(exponent%dimension, dim_none)) then
         call fail(parser, exponent%first, exponent%last, "an exponent must be dimensionless, got " &
                 & //dimension_name(exponent%dimension), power_with_unit(parser%source, base, exponent))
      else if (exponent%is_constant) then
         call raise_to_constant(parser, base, exponent)
      else if (same_dimension(base%dimension, dim_none)) then
         base%is_constant = .false.
         call emit(parser, op_power)
      else
         call fail(parser, base%first, base%last, "a variable exponent needs a dimensionless base")
      end if
   end subroutine raise

   !> How to give a power of a number a unit; blank if it is not what the deck tried.
   pure function power_with_unit(source, base, exponent) result(help)
      character(*), intent(in) :: source      !! the expression
      type(term_t), intent(in) :: base        !! the base
      type(term_t), intent(in) :: exponent    !! the exponent, which has a dimension
      character(:), allocatable :: help       !! as `write 10^4.5 * 1 N/m^1.5`

      integer :: at, n

      help = ""
      at = scan(source(:exponent%first), "^", back=.true.)
      n = number_length(source(exponent%first:exponent%last))
      if (n == 0 .or. .not. same_dimension(base%dimension, dim_none)) return
      help = "a unit after an exponent belongs to the exponent; write "//source(base%first:at)// &
             source(exponent%first:exponent%first + n - 1)//" * 1 "//trim(adjustl(source(exponent%first + n:exponent%last)))
   end function power_with_unit

   !> A power with a constant exponent, which is evaluated and taken from the program.
   subroutine raise_to_constant(parser, base, exponent)
      type(compiler_t), intent(inout) :: parser !! the reader
      type(term_t), intent(inout) :: base       !! the base; the power on return
      type(term_t), intent(in) :: exponent      !! the exponent

      real(wp), parameter :: largest = 1000.0_wp  !! larger exponents are refused [1]
      real(wp) :: jet(3)
      integer :: n

      n = parser%n_code - exponent%start + 1
      call evaluate_code(n, parser%code(exponent%start:parser%n_code), parser%operand(exponent%start:parser%n_code), &
                       & parser%curves, spread(0.0_wp, 1, n_variable), 1, jet)
      parser%n_code = exponent%start - 1
      if (.not. abs(jet(1)) <= largest) then
         call fail(parser, exponent%first, exponent%last, "this exponent must be a number up to 1000")
         return
      end if
      call combine_power(base, jet(1))
      call emit(parser, merge(op_real_power, op_integer_power, abs(jet(1) - anint(jet(1))) > 0.0_wp), jet(1))
   end subroutine raise_to_constant

   !> Evaluate where an overflow must not stop the program: the result is then not finite.
   subroutine evaluate_safely(compiled, t, value, d1, d2)
      type(expression_t), intent(in) :: compiled  !! the expression
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(out) :: value              !! its value [any]
      real(wp), intent(out) :: d1                 !! first derivative [any/s]
      real(wp), intent(out) :: d2                 !! second derivative [any/s^2]

      type(ieee_status_type) :: status

      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      call compiled%evaluate(t, value, d1, d2)
      call ieee_set_status(status)
   end subroutine evaluate_safely

   !> Whether a name means something in every expression, so that no parameter may have it.
   pure logical function is_reserved(name)
      character(*), intent(in) :: name  !! any name

      is_reserved = name == "t" .or. name == "pi" .or. function_operation(name) > 0
   end function is_reserved

   !> Deepest stack that a program needs.
   pure integer function needed_stack(n, code)
      integer, intent(in) :: n        !! number of operations
      integer, intent(in) :: code(:)  !! (>= n) operations

      integer :: depth, k

      depth = 0
      needed_stack = 0
      do k = 1, n
         if (code(k) == op_number .or. code(k) == op_time) depth = depth + 1
         if (code(k) >= op_add .and. code(k) <= op_atan2) depth = depth - 1
         needed_stack = max(needed_stack, depth)
      end do
   end function needed_stack

end module expression_compile
