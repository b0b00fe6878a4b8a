!> The functions that expressions know, and what they take and give.
module expression_functions
   use dimension_text, only: dimension_name
   use expression, only: op_abs, op_acos, op_asin, op_atan, op_atan2, op_cos, op_cosh, op_exp, op_log, op_log10, &
                       & op_max, op_min, op_sin, op_sinh, op_sqrt, op_step, op_tan, op_tanh
   use expression_dimension, only: combine_power, combine_sum, is_angle_like, term_t
   use kind_info, only: dim_angle, dim_none
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: apply_function, function_names, function_operation, n_argument

   integer, parameter :: n_function = 18
   character(5), parameter :: names(n_function) = [character(5) :: "sin", "cos", "tan", "asin", "acos", "atan", "atan2", &
      & "sinh", "cosh", "tanh", "exp", "log", "log10", "sqrt", "abs", "min", "max", "step"]
   integer, parameter :: operations(n_function) = [op_sin, op_cos, op_tan, op_asin, op_acos, op_atan, op_atan2, &
      & op_sinh, op_cosh, op_tanh, op_exp, op_log, op_log10, op_sqrt, op_abs, op_min, op_max, op_step]
   character(*), parameter :: function_names = &
      & "sin cos tan asin acos atan atan2 sinh cosh tanh exp log log10 sqrt abs min max step"

contains

   !> The operation of a function, 0 if there is no such function.
   pure integer function function_operation(name)
      character(*), intent(in) :: name  !! as written

      integer :: i

      function_operation = 0
      do i = 1, n_function
         if (names(i) == name) function_operation = operations(i)
      end do
   end function function_operation

   !> Number of arguments of a function.
   pure integer function n_argument(operation)
      integer, intent(in) :: operation  !! of the function

      n_argument = merge(2, 1, operation == op_atan2 .or. operation == op_min .or. operation == op_max)
   end function n_argument

   !> The dimension of a function's value; its arguments are checked.
   subroutine apply_function(name, operation, arguments, term, message, wrong)
      character(*), intent(in) :: name                   !! of the function
      integer, intent(in) :: operation                   !! of the function
      type(term_t), intent(in) :: arguments(2)           !! (2) the second one is not always used
      type(term_t), intent(inout) :: term                !! in: where it begins; out: the value
      character(:), allocatable, intent(out) :: message  !! empty: all is well
      integer, intent(out) :: wrong                      !! number of the wrong argument

      type(term_t) :: value

      message = ""
      wrong = 1
      value = arguments(1)
      select case (operation)
      case (op_min, op_max, op_atan2)
         call combine_sum(value, arguments(2), message)
         wrong = 2
         if (operation == op_atan2) call set_dimension(value, is_angle=.true.)
      case (op_sqrt)
         call combine_power(value, 0.5_wp)
      case (op_abs)
         continue
      case (op_step)
         call set_dimension(value, is_angle=.false.)
      case default
         if (.not. is_angle_like(value%dimension)) then
            message = name//" takes a dimensionless number or an angle, not "//dimension_name(value%dimension)
         end if
         call set_dimension(value, operation == op_asin .or. operation == op_acos .or. operation == op_atan)
      end select
      term%dimension = value%dimension
      term%is_soft = value%is_soft
      term%is_constant = value%is_constant
   end subroutine apply_function

   !> Make a value an angle whose radians may be dropped, or a plain number.
   pure subroutine set_dimension(value, is_angle)
      type(term_t), intent(inout) :: value  !! the value
      logical, intent(in) :: is_angle       !! an angle, or else a number

      value%dimension = dim_none
      if (is_angle) value%dimension = dim_angle
      value%is_soft = is_angle
   end subroutine set_dimension

end module expression_functions
