!> The test harness: suites of named tests, and checks that fail with what was expected.
!>
!> A test is a procedure that hands back an error or nothing. Checks do nothing once an error is
!> there, so that the first failure is the one reported.
module check
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use errors, only: error_t, exit_internal, set_error
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: check_close, check_equal, check_true, suite_t

   !> Runs or lists tests as the command line says: `--list`, and names `module[.name]`.
   type :: suite_t
      character(:), allocatable :: module         !! module whose tests are being registered
      integer :: n_passed = 0                     !! tests that passed
      integer :: n_failed = 0                     !! tests that failed
      logical :: is_list = .false.                !! only print names
      character(:), allocatable :: selection      !! " name name " of the tests to run; empty: all
   contains
      procedure :: start
      procedure :: test
      procedure :: finish
   end type suite_t

   abstract interface
      !> A test: leaves `error` unallocated if all is well.
      subroutine test_procedure(error)
         import :: error_t
         implicit none (type, external)
         type(error_t), allocatable, intent(out) :: error  !! what failed
      end subroutine test_procedure
   end interface

   interface
      !> The C library's exit: unlike `error stop` it prints no backtrace.
      subroutine c_exit(code) bind(c, name="exit")
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: code  !! exit code
      end subroutine c_exit
   end interface

   !> Compares reals; a NaN or an infinity always fails unless both are the same infinity.
   !> `relative`: the tolerance is a fraction of |expected| (of its largest component for an array).
   interface check_close
      module procedure check_close_scalar, check_close_vector
   end interface check_close

   !> Compares integers or strings (trailing blanks count).
   interface check_equal
      module procedure check_equal_integer, check_equal_text
   end interface check_equal

contains

   !> Read the command line.
   subroutine start(self)
      class(suite_t), intent(inout) :: self  !! this suite
      character(200) :: word
      integer :: i

      self%selection = ""
      do i = 1, command_argument_count()
         call get_command_argument(i, word)
         if (word == "--list") then
            self%is_list = .true.
         else
            self%selection = self%selection//" "//trim(word)//" "
         end if
      end do
   end subroutine start

   !> Run one test (or print its name).
   subroutine test(self, name, proc)
      class(suite_t), intent(inout) :: self     !! this suite
      character(*), intent(in) :: name          !! name of the test within its module
      procedure(test_procedure) :: proc         !! the test
      type(error_t), allocatable :: error
      character(:), allocatable :: full

      full = self%module//"."//name
      if (self%selection /= "") then
         if (index(self%selection, " "//full//" ") == 0 .and. &
             index(self%selection, " "//self%module//" ") == 0) return
      end if
      if (self%is_list) then
         write (output_unit, "(a)") full
         return
      end if
      call proc(error)
      if (allocated(error)) then
         self%n_failed = self%n_failed + 1
         write (output_unit, "(a)") "FAIL "//full//": "//error%message
      else
         self%n_passed = self%n_passed + 1
         write (output_unit, "(a)") "PASS "//full
      end if
      flush (output_unit)
   end subroutine test

   !> Say how it went and end the program: exit code 1 if a test failed or none was run.
   subroutine finish(self)
      class(suite_t), intent(in) :: self  !! this suite

      if (self%is_list) return
      write (error_unit, "(i0, a, i0, a)") self%n_passed, " passed, ", self%n_failed, " failed"
      if (self%n_failed > 0 .or. self%n_passed == 0) call c_exit(1_c_int)
   end subroutine finish

   !> Fail unless `condition`.
   subroutine check_true(error, condition, what)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      logical, intent(in) :: condition                    !! must hold
      character(*), intent(in) :: what                    !! what is claimed

      if (allocated(error)) return
      if (.not. condition) call set_error(error, exit_internal, what//": is false")
   end subroutine check_true

   subroutine check_close_scalar(error, actual, expected, tolerance, what, relative)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      real(wp), intent(in) :: actual                      !! computed [any]
      real(wp), intent(in) :: expected                    !! right [any]
      real(wp), intent(in) :: tolerance                   !! largest difference [any]
      character(*), intent(in) :: what                    !! what is compared
      logical, intent(in), optional :: relative           !! tolerance is a fraction

      call check_close_vector(error, [actual], [expected], tolerance, what, relative)
   end subroutine check_close_scalar

   subroutine check_close_vector(error, actual, expected, tolerance, what, relative)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      real(wp), intent(in) :: actual(:)                   !! (n) computed [any]
      real(wp), intent(in) :: expected(:)                 !! (n) right [any]
      real(wp), intent(in) :: tolerance                   !! largest difference of a component [any]
      character(*), intent(in) :: what                    !! what is compared
      logical, intent(in), optional :: relative           !! tolerance is a fraction
      real(wp) :: limit
      integer :: i
      character(160) :: line

      call check_equal_integer(error, size(actual), size(expected), what//": number of components")
      if (allocated(error)) return
      limit = tolerance
      if (present(relative)) then
         if (relative .and. size(expected) > 0) limit = tolerance*maxval(abs(expected))
      end if
      do i = 1, size(actual)
         if (is_close(actual(i), expected(i), limit)) cycle
         write (line, "(a, i0, 3(a, es24.16))") " (component ", i, "): got ", actual(i), &
            ", expected ", expected(i), ", difference allowed ", limit
         call set_error(error, exit_internal, what//trim(line))
         return
      end do
   end subroutine check_close_vector

   !> Within the limit, without an invalid operation if one of them is a NaN or an infinity.
   pure function is_close(actual, expected, limit)
      real(wp), intent(in) :: actual    !! computed [any]
      real(wp), intent(in) :: expected  !! right [any]
      real(wp), intent(in) :: limit     !! largest difference [any]
      logical :: is_close

      is_close = .false.
      if (ieee_is_nan(actual) .or. ieee_is_nan(expected) .or. ieee_is_nan(limit)) return
      if (ieee_is_finite(actual) .and. ieee_is_finite(expected)) then
         is_close = abs(actual - expected) <= limit
      else
         is_close = actual == expected
      end if
   end function is_close

   subroutine check_equal_integer(error, actual, expected, what)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      integer, intent(in) :: actual                       !! computed
      integer, intent(in) :: expected                     !! right
      character(*), intent(in) :: what                    !! what is compared
      character(80) :: line

      if (allocated(error) .or. actual == expected) return
      write (line, "(2(a, i0))") ": got ", actual, ", expected ", expected
      call set_error(error, exit_internal, what//trim(line))
   end subroutine check_equal_integer

   subroutine check_equal_text(error, actual, expected, what)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: actual                  !! computed
      character(*), intent(in) :: expected                !! right
      character(*), intent(in) :: what                    !! what is compared

      if (allocated(error)) return
      if (actual == expected .and. len(actual) == len(expected)) return
      call set_error(error, exit_internal, what//": got '"//actual//"', expected '"//expected//"'")
   end subroutine check_equal_text

end module check
