!> Rules of expressions: dimensions, radians, errors and where they are, how long and deep one may be.
module test_expression_rules
   use check, only: check_equal, check_true, suite_t
   use errors, only: error_t
   use expression, only: expression_t
   use expression_compile, only: compile_expression, dimension_agrees, fault_t, is_reserved, symbols_t
   use expression_fixture, only: compile, make_symbols
   use kind_info, only: dim_angle, dim_angular_speed, dim_force, dim_frequency, dim_length, dim_none, dim_speed, dim_t, &
                      & dim_time, same_dimension
   implicit none (type, external)
   private
   public :: run_test_expression_rules

contains

   !> All tests of this file.
   subroutine run_test_expression_rules(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("dimensions", test_dimensions)
      call suite%test("radians", test_radians)
      call suite%test("mistakes", test_mistakes)
      call suite%test("limits", test_limits)
   end subroutine run_test_expression_rules

   !> Dimensions of results.
   subroutine test_dimensions(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call expect("10 mm^2", dim_t(m=2), .false.)
      call expect("3kg.m/s^2", dim_force, .false.)
      call expect("2 N/m^1.5*(1 mm)^1.5", dim_force, .true.)
      call expect("sqrt(4 m^2/s^2)", dim_speed, .true.)
      call expect("10 mm/t", dim_speed, .false.)
      call expect("10 m /2s", dim_t(m=1, s=-1), .false.)
      call expect("max(1 mm, 2 um)", dim_length, .false.)
      call expect("20degC + 5K", dim_t(k=1), .false.)
      call expect("step(t - 1 ms)", dim_none, .false.)
      call expect("abs(-1 N)", dim_force, .false.)

   contains

      !> Compile and compare.
      subroutine expect(source, dimension, is_soft)
         character(*), intent(in) :: source    !! the text
         type(dim_t), intent(in) :: dimension  !! of its value
         logical, intent(in) :: is_soft        !! its radians may be taken or left

         type(expression_t) :: compiled

         call compile(error, source, compiled)
         call check_true(error, same_dimension(compiled%dimension, dimension), source//": dimension")
         call check_true(error, compiled%is_soft .eqv. is_soft, source//": softness")
      end subroutine expect

   end subroutine test_dimensions

   !> The rule for radians.
   subroutine test_radians(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call expect("2*pi*50Hz*t", dim_angle, .true.)
      call expect("50Hz*t", dim_angle, .false.)
      call expect("5rad/s*t", dim_angle, .true.)
      call expect("5rad/s*t", dim_none, .true.)
      call expect("50Hz", dim_angular_speed, .false.)
      call expect("2*50Hz", dim_angular_speed, .false.)
      call expect("2*pi*50Hz", dim_angular_speed, .true.)
      call expect("w0", dim_frequency, .false.)
      call expect("w0*r0", dim_speed, .true.)
      call expect("w0*r0 + 1m/s", dim_speed, .true.)
      call expect("w0^2*r0", dim_t(m=1, s=-2), .true.)
      call expect("1/w0", dim_time, .true.)
      call expect("1 + 30deg", dim_angle, .true.)
      call expect("1 + 30deg", dim_none, .false.)
      call expect("0.5*sin(w0*t)", dim_angle, .false.)
      call expect("0.5rad*sin(w0*t)", dim_angle, .true.)
      call expect("atan2(r0, 1m)", dim_angle, .true.)
      call expect("atan(2)", dim_none, .true.)
      call expect("sqrt(4N/m/(1kg))", dim_angular_speed, .true.)
      call expect("soft", dim_angular_speed, .true.)
      call expect("2*pi", dim_angle, .true.)
      call expect("2*pi*1m", dim_angle, .false.)

   contains

      !> Compile and compare with what is requested.
      subroutine expect(source, wanted, agrees)
         character(*), intent(in) :: source  !! the text
         type(dim_t), intent(in) :: wanted   !! dimension of the place
         logical, intent(in) :: agrees       !! whether it may stand there

         type(expression_t) :: compiled

         call compile(error, source, compiled)
         call check_true(error, dimension_agrees(compiled%dimension, compiled%is_soft, wanted) .eqv. agrees, source)
      end subroutine expect

   end subroutine test_radians

   !> Errors are found where they are.
   subroutine test_mistakes(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call expect("", 1, "the expression is empty")
      call expect("  ", 1, "the expression is empty")
      call expect("1 +", 3, "the expression is incomplete")
      call expect("(1 + 2", 1, "missing closing parenthesis")
      call expect("1 + 2)", 6, "no matching opening parenthesis")
      call expect("1 2", 3, "missing operator")
      call expect("2**3", 2, "write a power with ^")
      call expect("2*/3", 3, "expected a number, a name or a parenthesis")
      call expect("2 + sine(3)", 5, "unknown function 'sine'")
      call expect("sin", 1, "the function 'sin' needs its argument in parentheses")
      call expect("sin()", 5, "expected a number, a name or a parenthesis")
      call expect("sin(1, 2)", 6, "too many arguments for 'sin'")
      call expect("atan2(1)", 1, "'atan2' takes two arguments, separated by a comma")
      call expect("2*w1", 3, "unknown parameter 'w1'")
      call expect("2*law", 3, "the parameter 'law' has the value 'hertz', not a number")
      call expect("5 w0", 3, "missing operator before 'w0'")
      call expect("5 t", 3, "missing operator before 't'")
      call expect("5 radd", 3, "unknown unit 'radd': did you mean 'rad'?")
      call expect("5 m/s2", 5, "unknown parameter 's2'")
      call expect("1e999", 1, "too large: the limit is 1e290 in SI units")
      call expect("t > 1 s", 3, "expressions have no comparisons")
      call expect("r0 + t", 6, "this is a time [s], the preceding part is a length [m]")
      call expect("r0 + 1", 6, "this is a dimensionless number, the preceding part is a length [m]")
      call expect("min(r0, 2 s)", 9, "this is a time [s], the preceding part is a length [m]")
      call expect("exp(r0)", 5, "exp takes a dimensionless number or an angle, got a length [m]")
      call expect("2^t", 3, "an exponent must be dimensionless, got a time [s]")
      call expect("r0^(t/1s)", 1, "a variable exponent needs a dimensionless base")
      call expect("2^(1/0)", 3, "this exponent must be a number up to 1000")
      call check_true(error, is_reserved("t") .and. is_reserved("pi") .and. is_reserved("sin"), "reserved names")
      call check_true(error, .not. is_reserved("w0"), "other names")

   contains

      !> Compile and compare the error.
      subroutine expect(source, first, message)
         character(*), intent(in) :: source   !! the text
         integer, intent(in) :: first         !! first character that is wrong
         character(*), intent(in) :: message  !! what is wrong

         type(expression_t) :: compiled
         type(fault_t), allocatable :: fault
         type(symbols_t) :: symbols

         call make_symbols(symbols)
         call compile_expression(source, symbols, .true., compiled, fault)
         call check_true(error, allocated(fault), source//": refused")
         if (.not. allocated(fault)) return
         call check_equal(error, fault%message, message, source)
         call check_equal(error, fault%first, first, source//": place")
      end subroutine expect

   end subroutine test_mistakes

   !> Very long and very deep expressions are refused, not survived by luck.
   subroutine test_limits(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(expression_t) :: compiled
      type(fault_t), allocatable :: fault
      type(symbols_t) :: symbols

      call compile_expression(repeat("(", 100000)//"1", symbols, .true., compiled, fault)
      call check_true(error, allocated(fault), "many parentheses")
      call compile_expression(repeat("-", 100000)//"1", symbols, .true., compiled, fault)
      call check_true(error, allocated(fault), "many signs")
      call compile_expression(repeat("2^", 100000)//"1", symbols, .true., compiled, fault)
      call check_true(error, allocated(fault), "many powers")
      call compile_expression(repeat("1+", 100000)//"1", symbols, .true., compiled, fault)
      call check_true(error, allocated(fault), "many terms")
      call compile_expression(repeat("sin(", 100000)//"1", symbols, .true., compiled, fault)
      call check_true(error, allocated(fault), "many functions")
      call compile_expression(repeat("(1+", 45)//"1"//repeat(")", 45), symbols, .true., compiled, fault)
      call check_true(error, allocated(fault), "more than the stack holds")
      call compile_expression(repeat("(1+", 30)//"1"//repeat(")", 30), symbols, .true., compiled, fault)
      call check_true(error, .not. allocated(fault), "as much as the stack holds")
   end subroutine test_limits

end module test_expression_rules
