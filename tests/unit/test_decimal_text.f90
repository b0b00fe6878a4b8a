!> Numbers with 17 digits, character by character as the run-time library writes them.
module test_decimal_text
   use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_value
   use, intrinsic :: iso_fortran_env, only: int64
   use check, only: check_equal, suite_t
   use decimal_text, only: decimal_width, put_decimal
   use errors, only: error_t
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: run_test_decimal_text

contains

   !> All tests of this file.
   subroutine run_test_decimal_text(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("particular", test_particular)
      call suite%test("powers", test_powers)
      call suite%test("any_bits", test_any_bits)
   end subroutine run_test_decimal_text

   !> Compare one number.
   subroutine compare(x, error)
      real(wp), intent(in) :: x                                !! any [any]
      type(error_t), allocatable, intent(inout) :: error       !! first failure

      character(decimal_width) :: found, wanted

      call put_decimal(x, found)
      write (wanted, "(es24.16e3, 1x)") x
      if (found /= wanted) call check_equal(error, found, wanted, "17 digits")
   end subroutine compare

   !> Zeros, ends of the range, what is no number, numbers whose 18th digit is a five.
   subroutine test_particular(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      real(wp), parameter :: list(*) = [0.0_wp, -0.0_wp, 1.0_wp, -1.0_wp, 10.0_wp, 0.1_wp, 9.9999999999999999e22_wp, huge(1.0_wp), &
         tiny(1.0_wp), -tiny(1.0_wp)/4.0_wp, 1.0e280_wp, 1.0e-280_wp, 9007199254740993.0_wp, 0.5_wp, &
         1.0_wp + epsilon(1.0_wp), 1.0_wp - epsilon(1.0_wp)/2.0_wp, 72057594037927945.0_wp, 5.0e-324_wp]
      integer :: k

      do k = 1, size(list)
         call compare(list(k), error)
      end do
      call compare(not_a_number(), error)
      call compare(ieee_value(1.0_wp, ieee_negative_inf), error)
      do k = 1, 200  ! halves of units of the 17th digit: even digits win
         call compare(real(2*k + 1, wp)*2.0_wp**(-k/4), error)
         call compare(1.0_wp + real(k, wp)*2.0_wp**(-17), error)
      end do
   end subroutine test_particular

   !> Powers of ten and their neighbours.
   subroutine test_powers(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      real(wp) :: x
      integer :: k

      do k = -307, 307
         x = 10.0_wp**k
         call compare(x, error)
         call compare(nearest(x, 1.0_wp), error)
         call compare(nearest(x, -1.0_wp), error)
      end do
   end subroutine test_powers

   !> A hundred thousand numbers of random bits, and as many of common size.
   subroutine test_any_bits(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      integer(int64), parameter :: mantissa = int(z"000FFFFFFFFFFFFF", int64)
      integer(int64) :: bits
      integer :: k

      bits = 88172645463325252_int64
      do k = 1, 100000  ! xorshift
         bits = ieor(bits, ishft(bits, 13))
         bits = ieor(bits, ishft(bits, -7))
         bits = ieor(bits, ishft(bits, 17))
         if (iand(ishft(bits, -52), 2047_int64) /= 2047_int64) call compare(transfer(bits, 1.0_wp), error)
         call compare(transfer(ior(iand(bits, mantissa), ishft(int(1023 + mod(k, 60) - 30, int64), 52)), 1.0_wp), error)
      end do
   end subroutine test_any_bits

end module test_decimal_text
