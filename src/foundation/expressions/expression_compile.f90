!> From text to an `expression_t`; grammar in expression_parser, dimensions in expression_dimension.
module expression_compile
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_flag, ieee_set_halting_mode, ieee_set_status, &
                                          & ieee_status_type, ieee_usual
   use expression, only: expression_t, n_variable, op_add, op_atan2, op_number, op_time, stack_size
   use expression_dimension, only: dimension_agrees, term_t
   use expression_functions, only: function_names, function_operation
   use expression_parser, only: parse_whole
   use expression_state, only: channel_finder_t, fail, fault_t, name_length, new_parser, parser_t
   use expression_symbols, only: symbol_broken, symbol_function, symbol_number, symbol_t, symbol_word, symbols_t
   use kind_info, only: dim_t, dim_time
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: channel_finder_t, compile_expression, dimension_agrees, evaluate_safely, fault_t, function_names, is_reserved
   public :: name_length
   public :: symbol_broken, symbol_function, symbol_number, symbol_t, symbol_word, symbols_t

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
      type(parser_t) :: parser
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
