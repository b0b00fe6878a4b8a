!> Values of expressions: against sympy and against differences, where they do not exist, and of the text that is written back.
module test_expression
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use, intrinsic :: ieee_exceptions, only: ieee_divide_by_zero, ieee_get_flag, ieee_invalid, ieee_set_flag
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use expression, only: constant_expression, evaluate, expression_t
   use expression_compile, only: compile_expression, evaluate_safely, fault_t, symbols_t
   use expression_fixture, only: compile
   use expression_reference, only: expression_source, n_reference, reference_values
   use kind_info, only: dim_force, same_dimension
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_expression

contains

   !> All tests of this file.
   subroutine run_test_expression(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("sympy", test_sympy)
      call suite%test("differences", test_differences)
      call suite%test("constants", test_constants)
      call suite%test("singular_points", test_singular_points)
      call suite%test("huge_and_tiny", test_huge)
      call suite%test("resolved_source", test_resolved_source)
   end subroutine run_test_expression

   !> Value and both derivatives are those of sympy.
   subroutine test_sympy(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      real(wp), parameter :: tolerance = 2.0e-15_wp  !! of the largest term involved [1]
      type(expression_t) :: compiled
      real(wp) :: actual(3), row(4), size_of_terms
      integer :: i, k

      do i = 1, n_reference
         call compile(error, expression_source(i), compiled)
         do k = 1, 2
            row = reference_values(i, k)
            call compiled%evaluate(row(1), actual(1), actual(2), actual(3))
            size_of_terms = max(1.0_wp, maxval(abs(row(2:4))))*10.0_wp
            call check_close(error, actual, row(2:4), tolerance*size_of_terms, expression_source(i))
         end do
      end do
   end subroutine test_sympy

   !> Derivatives agree with differences of the value and of the first derivative.
   subroutine test_differences(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      real(wp), parameter :: h = 1.0e-6_wp  !! step of the differences [s]
      type(expression_t) :: compiled
      real(wp) :: after(3), before(3), now(3), scale, t
      integer :: i

      t = 0.8125_wp
      do i = 1, n_reference
         call compile(error, expression_source(i), compiled)
         call compiled%evaluate(t, now(1), now(2), now(3))
         call compiled%evaluate(t - h, before(1), before(2), before(3))
         call compiled%evaluate(t + h, after(1), after(2), after(3))
         scale = max(1.0_wp, maxval(abs(now)))*100.0_wp
         call check_close(error, (after(1:2) - before(1:2))/(2.0_wp*h), now(2:3), 1.0e-8_wp*scale, expression_source(i))
      end do
   end subroutine test_differences

   !> Constant expressions, compiled or made from a number.
   subroutine test_constants(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(expression_t) :: compiled, nothing
      real(wp) :: d1, d2, x

      call compile(error, "2*3 + 10 mm/(1 mm)", compiled)
      call evaluate(compiled, 5.0_wp, x, d1, d2)
      call check_close(error, [x, d1, d2], [16.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, "2*3 + 10")
      call check_true(error, compiled%is_constant, "an expression without t is constant")
      call compile(error, "0*t", compiled)
      call check_true(error, .not. compiled%is_constant, "an expression with t is not constant")
      compiled = constant_expression(7.5_wp, dim_force)
      call compiled%evaluate(1.0_wp, x, d1, d2)
      call check_close(error, [x, d1, d2], [7.5_wp, 0.0_wp, 0.0_wp], 0.0_wp, "constant_expression")
      call check_true(error, same_dimension(compiled%dimension, dim_force), "its dimension")
      call nothing%evaluate(1.0_wp, x, d1, d2)
      call check_close(error, [x, d1, d2], [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "an expression before it is compiled")
   end subroutine test_constants

   !> Where nothing exists the value is NaN, and no exception stops the program.
   subroutine test_singular_points(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      character(24), parameter :: nowhere(12) = [character(24) :: "1/(t - 1s)", "sqrt(0.5 - t/1s)", "log(1 - t/1s)", &
         & "asin(2*t/1s)", "acos(-2*t/1s)", "(1 - t/1s)^-2", "(0.5 - t/1s)^1.5", "(-t/1s)^(t/1s)", "exp(1000*t/1s)", &
         & "atan2(t - t, 1s - t)", "cosh(800*t/1s)", "sqrt(sqrt(-t/1s))"]
      type(expression_t) :: compiled
      real(wp) :: d1, d2, x
      integer :: i

      do i = 1, size(nowhere)
         call compile(error, trim(nowhere(i)), compiled)
         call compiled%evaluate(1.0_wp, x, d1, d2)
         call check_true(error, ieee_is_nan(x) .and. ieee_is_nan(d1) .and. ieee_is_nan(d2), trim(nowhere(i))//" is NaN")
      end do
      call compile(error, "sqrt(1 - t/1s)", compiled)
      call compiled%evaluate(1.0_wp, x, d1, d2)
      call check_close(error, x, 0.0_wp, 0.0_wp, "a root of zero")
      call check_true(error, ieee_is_nan(d1) .and. ieee_is_nan(d2), "its derivatives are infinite")
      call compile(error, "(1 - t/1s)^1.5 + (1 - t/1s)^2.5 + asin(1) + 0^0.5", compiled)
      call compiled%evaluate(1.0_wp, x, d1, d2)
      call check_close(error, [x, d1], [2.0_wp*atan(1.0_wp), 0.0_wp], 1.0e-15_wp, "powers of zero")
      call compile(error, "step(t - 1s)", compiled)
      call compiled%evaluate(1.0_wp, x, d1, d2)
      call check_close(error, [x, d1, d2], [1.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "step at its place")
      call compile(error, "1e200*1e200", compiled)
      call evaluate_safely(compiled, 0.0_wp, x, d1, d2)
      call check_true(error, .not. ieee_is_finite(x), "an overflow is not finite")
   end subroutine test_singular_points

   !> Functions of sums, products, quotients and powers of numbers that overflow or underflow: NaN or a number with whose square
   !> something can be computed, and no exception that would stop the debug build.
   subroutine test_huge(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      character(16), parameter :: atoms(7) = [character(16) :: "1e99*t/1s", "1e-99*t/1s", "exp(600*t/1s)", "1e90*(t/1s)^3", &
         & "-1e160*t/1s", "0*t/1s", "(t/1s - 0.7)"]
      character(16), parameter :: functions(11) = [character(16) :: "sin(@)", "tan(@)", "sqrt(@)", "log(@)", "exp(@)", &
         & "atan(@)/1rad", "(@)^2", "(@)^-3", "(@)^1.5", "1/(@)", "atan2(@,1)/1rad"]
      character(8), parameter :: operations(5) = [character(8) :: "+", "-", "*", "/", "^"]
      real(wp), parameter :: times(3) = [0.7_wp, 1.0_wp, 1.3_wp]
      type(expression_t) :: compiled
      character(:), allocatable :: inner, whole
      real(wp) :: jet(3)
      integer :: a, b, f, g, i, k, n_finite, n_nan, o
      logical :: has_invalid, has_zero

      n_finite = 0
      n_nan = 0
      do a = 1, size(atoms)
         do f = 1, size(functions)
            inner = applied(functions(f), trim(atoms(a)))
            do o = 1, size(operations)
               do b = 1, size(atoms)
                  do g = 1, size(functions)
                     whole = applied(functions(g), "("//inner//")"//trim(operations(o))//"("//trim(atoms(b))//")")
                     call compile(error, whole, compiled)
                     if (allocated(error)) return
                     do i = 1, size(times)
                        call ieee_set_flag([ieee_invalid, ieee_divide_by_zero], .false.)
                        call compiled%evaluate(times(i), jet(1), jet(2), jet(3))
                        call ieee_get_flag(ieee_invalid, has_invalid)
                        call ieee_get_flag(ieee_divide_by_zero, has_zero)
                        if (has_invalid .or. has_zero) call check_true(error, .false., whole//": an exception")
                        do k = 1, 3
                           n_nan = n_nan + merge(1, 0, ieee_is_nan(jet(k)))
                           n_finite = n_finite + merge(1, 0, ieee_is_finite(jet(k)))
                           if (.not. ieee_is_finite(jet(k))) cycle
                           if (abs(jet(k)) > 1.0e100_wp) call check_true(error, .false., whole//": too large")
                        end do
                     end do
                  end do
               end do
            end do
         end do
      end do
      call check_true(error, n_nan > 10000 .and. n_finite > 10000, "some are numbers, some are not")
      call check_equal(error, n_nan + n_finite, 9*size(atoms)**2*size(functions)**2*size(operations), "nothing is infinite")

   contains

      !> A function of an argument.
      function applied(word, argument) result(text)
         character(*), intent(in) :: word       !! with @ where the argument goes
         character(*), intent(in) :: argument   !! the argument
         character(:), allocatable :: text      !! the function of it

         integer :: place

         place = index(word, "@")
         text = word(:place - 1)//argument//trim(word(place + 1:))
      end function applied

   end subroutine test_huge

   !> The text that is written back holds the values of parameters and compiles to exactly the same values.
   subroutine test_resolved_source(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(expression_t) :: again, compiled
      type(fault_t), allocatable :: fault
      type(symbols_t) :: symbols
      real(wp) :: x(3), y(3)

      call compile(error, "amplitude*sin(w0*t + 1)*r0 + soft*r0*t*3 + r0*0", compiled)
      call compile_expression(compiled%source, symbols, .true., again, fault)
      call check_true(error, .not. allocated(fault), "it compiles: "//compiled%source)
      if (allocated(error)) return
      call compiled%evaluate(0.7_wp, x(1), x(2), x(3))
      call again%evaluate(0.7_wp, y(1), y(2), y(3))
      call check_close(error, y, x, 0.0_wp, "values of "//compiled%source)
      call check_true(error, same_dimension(compiled%dimension, again%dimension), "dimension")
      call check_true(error, compiled%is_soft .eqv. again%is_soft, "softness")
   end subroutine test_resolved_source

end module test_expression
