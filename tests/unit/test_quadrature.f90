!> Integrals of expressions: closed forms, with kinks, jumps and ends of either sign.
module test_quadrature
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use expression, only: expression_t
   use expression_compile, only: compile_expression, fault_t, symbols_t
   use kind_info, only: dim_none
   use kinds, only: pi, wp
   use quadrature, only: integral_of
   implicit none (type, external)
   private
   public :: run_test_quadrature

contains

   subroutine run_test_quadrature(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("smooth", test_smooth)
      call suite%test("kinks_and_jumps", test_kinks_and_jumps)
   end subroutine run_test_quadrature

   !> Compare an integral from 0 to x with its value.
   subroutine check_integral(error, source, x, expected)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: source                  !! integrand over x
      real(wp), intent(in) :: x                           !! upper end [1]
      real(wp), intent(in) :: expected                    !! the integral [1]

      type(expression_t) :: compiled
      type(fault_t), allocatable :: fault
      type(symbols_t) :: none

      call compile_expression(source, none, .true., compiled, fault, variable="x", argument=[dim_none])
      call check_true(error, .not. allocated(fault), source//" is right")
      if (allocated(error)) return
      call check_close(error, integral_of(compiled, x), expected, 1.0e-12_wp*max(1.0_wp, abs(expected)), source)
   end subroutine check_integral

   !> Smooth ones.
   subroutine test_smooth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_integral(error, "3", 2.0_wp, 6.0_wp)
      call check_integral(error, "3", 0.0_wp, 0.0_wp)
      call check_integral(error, "x^3 - 2*x", -1.5_wp, 1.5_wp**4/4.0_wp - 1.5_wp**2)
      call check_integral(error, "exp(x)", 3.0_wp, exp(3.0_wp) - 1.0_wp)
      call check_integral(error, "sin(20*x)", 2.0_wp*pi + 0.3_wp, (1.0_wp - cos(6.0_wp))/20.0_wp)
      call check_integral(error, "1/(1 + 100*x^2)", -5.0_wp, -atan(50.0_wp)/10.0_wp)
   end subroutine test_smooth

   !> Stops and steps.
   subroutine test_kinks_and_jumps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_integral(error, "max(x - 0.3, 0)", 1.1_wp, 0.32_wp)
      call check_integral(error, "1e6*max(x - 0.7, 0)^1.5 + x", 0.71_wp, 1.0e6_wp*0.4_wp*0.01_wp**2.5_wp + 0.5_wp*0.71_wp**2)
      call check_integral(error, "5000*max(x - 0.1, 0)", 0.1001_wp, 2500.0_wp*1.0e-8_wp)
      call check_integral(error, "abs(x + 0.2)", -1.0_wp, -0.02_wp - 0.32_wp)
      call check_integral(error, "7*step(x - 1/3)", 1.0_wp, 14.0_wp/3.0_wp)
   end subroutine test_kinks_and_jumps

end module test_quadrature
