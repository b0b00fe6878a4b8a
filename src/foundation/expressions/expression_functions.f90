!> The functions that expressions know, and what they take and give.
module expression_functions
   use dimension_text, only: dimension_name
   use expression, only: op_abs, op_acos, op_asin, op_atan, op_atan2, op_cos, op_cosh, op_exp, op_log, op_log10, &
                       & op_max, op_min, op_rise, op_sin, op_sinh, op_sqrt, op_step, op_tan, op_tanh
   use expression_dimension, only: combine_power, combine_sum, is_angle_like, term_t
   use kind_info, only: dim_angle, dim_none
   use kinds, only: wp
   use rise_laws, only: number_of_rise
   implicit none (type, external)
   private
   public :: apply_function, function_names, function_operation, most_arguments, n_argument, n_signature, signature_help, signatures

   integer, parameter :: n_function = 18
   integer, parameter :: most_arguments = 5   !! of a function
   character(5), parameter :: names(n_function) = [character(5) :: "sin", "cos", "tan", "asin", "acos", "atan", "atan2", &
      & "sinh", "cosh", "tanh", "exp", "log", "log10", "sqrt", "abs", "min", "max", "step"]
   integer, parameter :: operations(n_function) = [op_sin, op_cos, op_tan, op_asin, op_acos, op_atan, op_atan2, &
      & op_sinh, op_cosh, op_tanh, op_exp, op_log, op_log10, op_sqrt, op_abs, op_min, op_max, op_step]
   character(*), parameter :: function_names = &
      & "sin cos tan asin acos atan atan2 sinh cosh tanh exp log log10 sqrt abs min max step step3 step5 haversine cycloidal " &
      //"poly345 poly4567 modified_sine"

   integer, parameter :: n_signature = 15
   character(34), parameter :: signatures(n_signature) = [character(34) :: "sin(x), cos(x), tan(x)", "asin(x), acos(x), atan(x)", &
      & "atan2(y, x)", "sinh(x), cosh(x), tanh(x)", "exp(x), log(x), log10(x)", "sqrt(x), abs(x)", "min(a, b), max(a, b)", &
      & "step(x)", "step3(x, x0, h0, x1, h1)", "step5(x, x0, h0, x1, h1)", "haversine(x, x0, h0, x1, h1)", &
      & "cycloidal(x, x0, h0, x1, h1)", "poly345(x, x0, h0, x1, h1)", "poly4567(x, x0, h0, x1, h1)", &
      & "modified_sine(x, x0, h0, x1, h1)"]
   character(76), parameter :: signature_help(n_signature) = [character(76) :: "of an angle or a number", "an angle", &
      & "the angle of the point (x, y), from -pi to pi", "hyperbolic functions", "exponential, natural and decimal logarithm", &
      & "square root, magnitude", "the smaller, the larger", "0 for negative x, else 1", &
      & "h0 up to x0, h1 from x1 on, cubic transition: continuous velocity", &
      & "the same, quintic: continuous acceleration", "the same, half a cosine wave: continuous velocity", &
      & "cycloidal cam rise from h0 to h1: continuous acceleration", &
      & "cam rise, 3-4-5 polynomial: continuous acceleration", &
      & "cam rise, 4-5-6-7 polynomial: continuous jerk", &
      & "cam rise, modified sine: continuous acceleration"]

contains

   !> The operation of a function, 0 if there is no such function.
   pure integer function function_operation(name)
      character(*), intent(in) :: name  !! as written

      integer :: i

      function_operation = 0
      do i = 1, n_function
         if (names(i) == name) function_operation = operations(i)
      end do
      if (number_of_rise(name) > 0) function_operation = op_rise
   end function function_operation

   !> Number of arguments of a function.
   pure integer function n_argument(operation)
      integer, intent(in) :: operation  !! of the function

      n_argument = merge(2, 1, operation == op_atan2 .or. operation == op_min .or. operation == op_max)
      if (operation == op_rise) n_argument = most_arguments
   end function n_argument

   !> The dimension of a function's value; its arguments are checked.
   subroutine apply_function(name, operation, arguments, term, message, wrong)
      character(*), intent(in) :: name                   !! of the function
      integer, intent(in) :: operation                   !! of the function
      type(term_t), intent(in) :: arguments(:)           !! (most_arguments) those after the first are not always used
      type(term_t), intent(inout) :: term                !! in: where it starts; out: the value
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
      case (op_rise)
         call apply_rise(arguments, value, message, wrong)
      case (op_sqrt)
         call combine_power(value, 0.5_wp)
      case (op_abs)
         continue
      case (op_step)
         call set_dimension(value, is_angle=.false.)
      case default
         if (.not. is_angle_like(value%dimension)) then
            message = name//" takes a dimensionless number or an angle, got "//dimension_name(value%dimension)
         end if
         call set_dimension(value, operation == op_asin .or. operation == op_acos .or. operation == op_atan)
      end select
      term%dimension = value%dimension
      term%is_soft = value%is_soft
      term%is_constant = value%is_constant
   end subroutine apply_function

   !> Places x, x0, x1 have one dimension, heights h0, h1 that of the value.
   subroutine apply_rise(arguments, value, message, wrong)
      type(term_t), intent(in) :: arguments(:)              !! (5) x, x0, h0, x1, h1
      type(term_t), intent(inout) :: value                  !! the value
      character(:), allocatable, intent(inout) :: message   !! empty: all is well
      integer, intent(out) :: wrong                         !! number of the wrong argument

      integer, parameter :: like(5) = [1, 1, 3, 1, 3]  ! the argument whose dimension each must have
      type(term_t) :: other
      integer :: k

      do k = 2, 5
         wrong = k
         other = arguments(like(k))
         call combine_sum(other, arguments(k), message)
         if (len(message) > 0) return
      end do
      value%dimension = arguments(3)%dimension
      value%is_soft = arguments(3)%is_soft .and. arguments(5)%is_soft
      value%is_constant = all(arguments(:5)%is_constant)
   end subroutine apply_rise

   !> Make a value an angle whose radians may be dropped, or a plain number.
   pure subroutine set_dimension(value, is_angle)
      type(term_t), intent(inout) :: value  !! the value
      logical, intent(in) :: is_angle       !! an angle, or else a number

      value%dimension = dim_none
      if (is_angle) value%dimension = dim_angle
      value%is_soft = is_angle
   end subroutine set_dimension

end module expression_functions
