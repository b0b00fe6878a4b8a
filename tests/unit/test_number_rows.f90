!> Tests of rows of numbers read from text.
module test_number_rows
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp
   use number_rows, only: number_rows_t
   use posix, only: remove_file
   implicit none (type, external)
   private
   public :: run_test_number_rows

   character(*), parameter :: path = "test_number_forms.dat"

contains

   !> Register the tests.
   subroutine run_test_number_rows(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("digits", test_digits)
      call suite%test("other_forms", test_other_forms)
   end subroutine run_test_number_rows

   !> Numbers of all sizes and as many digits as there may be, beside what the run-time library reads.
   subroutine test_digits(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 4000
      character(12), parameter :: form(4) = [character(12) :: "(es24.16e3)", "(es12.3e2)", "(f30.12)", "(g0.5)"]
      character(40), allocatable :: words(:)
      real(wp) :: found(1), x
      type(number_rows_t) :: rows
      type(random_t) :: random
      integer :: i, n_other, unit

      allocate (words(n))
      open (newunit=unit, file=path, status="replace", action="write")
      do i = 1, n
         x = random%between(-1.0_wp, 1.0_wp)*10.0_wp**random%between(-40.0_wp, 40.0_wp)
         if (mod(i, 4) == 3) x = random%between(-1.0e9_wp, 1.0e9_wp)
         write (words(i), form(1 + mod(i - 1, 4))) x
         write (unit, "(a)") words(i)
      end do
      close (unit)
      call check_true(error, rows%open(path), "the file is open")
      if (allocated(error)) return
      n_other = 0
      do i = 1, n
         call check_true(error, rows%next(found), "a row is there")
         if (allocated(error)) return
         read (words(i), *) x
         call check_true(error, abs(found(1) - x) <= spacing(x), "number "//trim(words(i)))
         if (allocated(error)) return
         if (abs(found(1) - x) > 0.0_wp) n_other = n_other + 1
      end do
      call check_true(error, .not. rows%next(found), "no further row")
      call rows%close()
      call check_true(error, n_other <= n/200, "nearly all are the nearest number")
      i = remove_file(path)
   end subroutine test_digits

   !> What is not mere digits: no numbers, no digits before or behind the point, more digits and powers than there is storage for.
   subroutine test_other_forms(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: found(10)
      type(number_rows_t) :: rows
      integer :: unit

      open (newunit=unit, file=path, status="replace", action="write")
      write (unit, "(a)") "NaN -inf .5 5. 123456789012345678901234567890 1e300 -2.5E-310 +7e+2 0x10 -0.0"
      write (unit, "(a)") "1.5 2.5e 3"
      close (unit)
      call check_true(error, rows%open(path), "the file is open")
      if (allocated(error)) return
      call check_true(error, rows%next(found), "ten numbers are there")
      if (allocated(error)) return
      call check_true(error, ieee_is_nan(found(1)) .and. found(2) < -huge(1.0_wp), "not a number, infinity")
      if (allocated(error)) return
      call check_close(error, found(3:9), [0.5_wp, 5.0_wp, 1.2345678901234568e29_wp, 1.0e300_wp, -2.5e-310_wp, 700.0_wp, &
                                           16.0_wp], 0.0_wp, "other forms")
      if (allocated(error)) return
      call check_true(error, sign(1.0_wp, found(10)) < 0.0_wp, "minus zero")
      if (allocated(error)) return
      call check_true(error, .not. rows%next(found(1:3)), "a word that is no number ends a row")
      call rows%close()
      unit = remove_file(path)
   end subroutine test_other_forms

end module test_number_rows
