!> An expression in the time, and in what it sees of a motion: compiled once, evaluated without allocation.
!>
!> The program is in postfix order and works on a stack of jets (value, first and second derivative), so
!> the derivatives are exact. `compile_expression` of `expression_compile` makes expressions from text.
!> What does not exist (sqrt(-1), 1/0, exp(1000)) evaluates to NaN, and so does a value or a derivative beyond 1e100, with the
!> squares of which nothing can be computed; no exception but `overflow` is raised for it.
module expression
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use curve, only: beyond_stabilisation, beyond_linear, curve_t, jet_of_curve
   use jets, only: jet_acos, jet_asin, jet_atan, jet_atan2, jet_chain, jet_cosh, jet_exp, jet_integer_power, jet_log, &
                 & jet_power, jet_product, jet_quotient, jet_real_power, jet_sinh, jet_sqrt, jet_tan, jet_tanh
   use kind_info, only: dim_none, dim_t
   use kinds, only: not_a_number, wp
   use rise_laws, only: is_smooth_rise, jet_of_rise
   use observable, only: observable_t
   implicit none (type, external)
   private
   public :: constant_expression, evaluate, evaluate_code, expression_t
   public :: op_abs, op_acos, op_add, op_asin, op_atan, op_atan2, op_cos, op_cosh, op_curve, op_divide, op_exp
   public :: op_integer_power
   public :: op_log, op_log10, op_max, op_min, op_multiply, op_negate, op_number, op_power, op_real_power, op_rise, op_sin
   public :: op_sinh, op_sqrt, op_step, op_subtract, op_tan, op_tanh, op_time
   public :: most_seen, n_variable, stack_size

   integer, parameter :: n_variable = 3   !! variables of an expression at most

   integer, parameter :: most_seen = 12   !! channels that an expression uses, at most: variables behind its first one

   integer, parameter :: stack_size = 40  !! deepest stack of an expression

   real(wp), parameter :: largest = 1.0e100_wp  !! of the value of an expression, and of its derivatives [any]

   integer, parameter :: op_number = 1         !! push the operand
   integer, parameter :: op_time = 2           !! push the variable whose number is the operand, the first of which is often t
   integer, parameter :: op_add = 3            !! these take two from the stack
   integer, parameter :: op_subtract = 4       !! a - b
   integer, parameter :: op_multiply = 5       !! a*b
   integer, parameter :: op_divide = 6         !! a/b
   integer, parameter :: op_power = 7          !! a**b, both moving
   integer, parameter :: op_min = 8            !! the smaller
   integer, parameter :: op_max = 9            !! the larger
   integer, parameter :: op_atan2 = 10         !! angle of (b, a)
   integer, parameter :: op_integer_power = 11 !! these take one; power to the operand
   integer, parameter :: op_real_power = 12    !! power to the operand
   integer, parameter :: op_negate = 13        !! -a
   integer, parameter :: op_sin = 14           !! sine
   integer, parameter :: op_cos = 15           !! cosine
   integer, parameter :: op_tan = 16           !! tangent
   integer, parameter :: op_asin = 17          !! arc sine
   integer, parameter :: op_acos = 18          !! arc cosine
   integer, parameter :: op_atan = 19          !! arc tangent
   integer, parameter :: op_sinh = 20          !! hyperbolic sine
   integer, parameter :: op_cosh = 21          !! hyperbolic cosine
   integer, parameter :: op_tanh = 22          !! hyperbolic tangent
   integer, parameter :: op_exp = 23           !! exponential
   integer, parameter :: op_log = 24           !! natural logarithm
   integer, parameter :: op_log10 = 25         !! decimal logarithm
   integer, parameter :: op_sqrt = 26          !! square root
   integer, parameter :: op_abs = 27           !! absolute value
   integer, parameter :: op_step = 28          !! 0 below zero, 1 from zero on; derivatives 0
   integer, parameter :: op_curve = 29         !! the curve whose number is the operand
   integer, parameter :: op_rise = 30          !! the law of `rise_laws` whose number is the operand

   !> A compiled expression; before it is compiled it is the constant 0.
   type :: expression_t
      integer, allocatable :: code(:)        !! (n) operations
      real(wp), allocatable :: operand(:)    !! (n) numbers that belong to them [any]
      type(curve_t), allocatable :: curves(:) !! (any) named functions that it calls; unallocated if it cannot
      type(dim_t) :: dimension = dim_none    !! of the value
      logical :: is_soft = .false.           !! its radians may be taken or left, see expression_compile
      logical :: is_constant = .true.        !! no variable occurs
      real(wp) :: others(2:n_variable) = 0.0_wp  !! (2:3) values of the variables but the first in `evaluate` [any]
      type(observable_t), allocatable :: observables(:)  !! (any) channels that it uses, its variables behind the first;
                                                         !! unallocated: none
      character(:), allocatable :: source    !! text it was compiled from, with the values of parameters put in
   contains
      procedure :: evaluate
      procedure :: evaluate_at
      procedure :: evaluate_seeing
      procedure :: is_smooth
   end type expression_t

contains

   !> Whether the value and its derivatives have no jumps where they exist: nothing in it steps, folds, or wraps
   !> around, and no curve bends at its end.
   pure logical function is_smooth(self)
      class(expression_t), intent(in) :: self  !! the expression

      integer, parameter :: rough(5) = [op_abs, op_atan2, op_max, op_min, op_step]
      integer :: k

      is_smooth = .true.
      if (.not. allocated(self%code)) return
      do k = 1, size(rough)
         is_smooth = is_smooth .and. all(self%code /= rough(k))
      end do
      do k = 1, size(self%code)
         if (self%code(k) == op_rise) is_smooth = is_smooth .and. is_smooth_rise(nint(self%operand(k)))
      end do
      if (.not. allocated(self%curves)) return
      do k = 1, size(self%curves)
         if (allocated(self%curves(k)%rises)) cycle  ! these are smooth wherever they end
         is_smooth = is_smooth .and. self%curves(k)%beyond /= beyond_stabilisation .and. self%curves(k)%beyond /= beyond_linear
      end do
   end function is_smooth

   !> An expression that is one number.
   pure function constant_expression(x, dimension) result(constant)
      real(wp), intent(in) :: x             !! its value, SI [any]
      type(dim_t), intent(in) :: dimension  !! of the value
      type(expression_t) :: constant        !! the expression

      allocate (constant%code(1), source=op_number)
      allocate (constant%operand(1), source=x)
      constant%dimension = dimension
      constant%source = ""
   end function constant_expression

   !> Value and derivatives at a time, or at another first variable, the others as set.
   pure subroutine evaluate(self, t, value, d1, d2)
      class(expression_t), intent(in) :: self  !! the expression
      real(wp), intent(in) :: t                !! time [s]
      real(wp), intent(out) :: value           !! its value [any]
      real(wp), intent(out) :: d1              !! first derivative [any/s]
      real(wp), intent(out) :: d2              !! second derivative [any/s^2]

      real(wp) :: jet(3)

      if (allocated(self%observables)) then
         call self%evaluate_seeing([t, spread(0.0_wp, 1, size(self%observables))], 1, value, d1)
         d2 = 0.0_wp
         return
      end if
      jet = 0.0_wp
      if (allocated(self%code)) call evaluate_code(size(self%code), self%code, self%operand, self%curves, [t, self%others], 1, jet)
      value = jet(1)
      d1 = jet(2)
      d2 = jet(3)
   end subroutine evaluate

   !> Value, and its derivative by one of the variables.
   pure subroutine evaluate_at(self, x, along, value, slope)
      class(expression_t), intent(in) :: self   !! the expression
      real(wp), intent(in) :: x(n_variable)     !! (n_variable) the variables [any]
      integer, intent(in) :: along              !! number of the variable of the derivative
      real(wp), intent(out) :: value            !! its value [any]
      real(wp), intent(out) :: slope            !! derivative [any]

      real(wp) :: jet(3)

      jet = 0.0_wp
      if (allocated(self%code)) call evaluate_code(size(self%code), self%code, self%operand, self%curves, x, along, jet)
      value = jet(1)
      slope = jet(2)
   end subroutine evaluate_at

   !> The same of an expression that uses channels.
   pure subroutine evaluate_seeing(self, x, along, value, slope)
      class(expression_t), intent(in) :: self   !! the expression
      real(wp), intent(in) :: x(:)              !! (1 + observables) the time and the channels [any]
      integer, intent(in) :: along              !! number of the variable of the derivative
      real(wp), intent(out) :: value            !! its value [any]
      real(wp), intent(out) :: slope            !! derivative [any]

      real(wp) :: jet(3)

      jet = 0.0_wp
      if (allocated(self%code)) call evaluate_code(size(self%code), self%code, self%operand, self%curves, x, along, jet)
      value = jet(1)
      slope = jet(2)
   end subroutine evaluate_seeing

   !> Run a program.
   pure subroutine evaluate_code(n, code, operand, curves, x, along, jet)
      integer, intent(in) :: n                             !! number of operations
      integer, intent(in) :: code(n)                       !! (n) operations
      real(wp), intent(in) :: operand(n)                   !! (n) their numbers [any]
      type(curve_t), allocatable, intent(in) :: curves(:)  !! (any) named functions
      real(wp), intent(in) :: x(:)                         !! (variables or more) the variables [any]
      integer, intent(in) :: along                         !! number of the variable of the derivatives
      real(wp), intent(out) :: jet(3)                      !! (3) value and derivatives [any]

      real(wp) :: stack(3, stack_size)
      integer :: k, top

      top = 0
      do k = 1, n
         select case (code(k))
         case (op_number)
            top = top + 1
            stack(:, top) = [operand(k), 0.0_wp, 0.0_wp]
         case (op_time)
            top = top + 1
            stack(:, top) = [x(nint(operand(k))), merge(1.0_wp, 0.0_wp, nint(operand(k)) == along), 0.0_wp]
         case (op_add:op_atan2)
            top = top - 1
            stack(:, top) = of_two(code(k), stack(:, top), stack(:, top + 1))
         case (op_integer_power)
            stack(:, top) = jet_integer_power(stack(:, top), nint(operand(k)))
         case (op_real_power)
            stack(:, top) = jet_real_power(stack(:, top), operand(k))
         case (op_rise)
            stack(:, top) = jet_of_rise(nint(operand(k)), stack(:, top))
         case (op_curve)
            stack(:, top) = jet_of_curve(curves(nint(operand(k))), stack(:, top))
         case default
            stack(:, top) = of_one(code(k), stack(:, top))
         end select
         if (.not. ieee_is_finite(stack(1, top))) then
            jet = not_a_number()
            return
         end if
         if (.not. ieee_is_finite(stack(2, top))) stack(2, top) = not_a_number()
         if (.not. ieee_is_finite(stack(3, top))) stack(3, top) = not_a_number()
      end do
      do k = 1, 3
         jet(k) = stack(k, 1)
         if (.not. ieee_is_finite(jet(k))) cycle
         if (abs(jet(k)) > largest) jet(k) = not_a_number()
      end do
   end subroutine evaluate_code

   !> An operation on two jets.
   pure function of_two(op, a, b) result(v)
      integer, intent(in) :: op     !! the operation
      real(wp), intent(in) :: a(3)  !! (3) first operand [any]
      real(wp), intent(in) :: b(3)  !! (3) second operand [any]
      real(wp) :: v(3)              !! (3) result [any]

      select case (op)
      case (op_add)
         v = a + b
      case (op_subtract)
         v = a - b
      case (op_multiply)
         v = jet_product(a, b)
      case (op_divide)
         v = jet_quotient(a, b)
      case (op_power)
         v = jet_power(a, b)
      case (op_min)
         v = merge(b, a, b(1) < a(1))
      case (op_max)
         v = merge(b, a, b(1) > a(1))
      case default
         v = jet_atan2(a, b)
      end select
   end function of_two

   !> A function of one jet.
   pure function of_one(op, u) result(v)
      integer, intent(in) :: op     !! the operation
      real(wp), intent(in) :: u(3)  !! (3) argument [any]
      real(wp) :: v(3)              !! (3) result [any]

      real(wp), parameter :: log_of_ten = log(10.0_wp)  !! turns natural into decimal logarithms [1]

      select case (op)
      case (op_negate)
         v = -u
      case (op_sin)
         v = jet_chain(u, sin(u(1)), cos(u(1)), -sin(u(1)))
      case (op_cos)
         v = jet_chain(u, cos(u(1)), -sin(u(1)), -cos(u(1)))
      case (op_tan)
         v = jet_tan(u)
      case (op_asin)
         v = jet_asin(u)
      case (op_acos)
         v = jet_acos(u)
      case (op_atan)
         v = jet_atan(u)
      case (op_sinh)
         v = jet_sinh(u)
      case (op_cosh)
         v = jet_cosh(u)
      case (op_tanh)
         v = jet_tanh(u)
      case (op_exp)
         v = jet_exp(u)
      case (op_log)
         v = jet_log(u)
      case (op_log10)
         v = jet_log(u)/log_of_ten
      case (op_sqrt)
         v = jet_sqrt(u)
      case (op_abs)
         v = u
         if (u(1) < 0.0_wp) v = -u
      case default
         v = [merge(0.0_wp, 1.0_wp, u(1) < 0.0_wp), 0.0_wp, 0.0_wp]
      end select
   end function of_one

end module expression
