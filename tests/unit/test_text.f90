!> Strings, numbers as text, spelling; reading of numbers.
module test_text
   use, intrinsic :: iso_fortran_env, only: int64
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: not_a_number, pi, wp
   use numbers, only: number_length, read_number
   use spelling, only: nearest_word
   use text, only: append_text, exact_text, join, lower, segment, real_text, replace, split_blank, starts_with, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: run_test_text

contains

   !> All tests of this file.
   subroutine run_test_text(suite)
      type(suite_t), intent(inout) :: suite  !! the suite

      call suite%test("numbers_as_text", test_numbers_as_text)
      call suite%test("whole_numbers", test_whole_numbers)
      call suite%test("figures", test_figures)
      call suite%test("exact_text", test_exact_text)
      call suite%test("lists", test_lists)
      call suite%test("strings", test_strings)
      call suite%test("spelling", test_spelling)
      call suite%test("buffer", test_buffer)
      call suite%test("number_length", test_number_length)
      call suite%test("read_number", test_read_number)
   end subroutine run_test_text

   !> Numbers for people.
   subroutine test_numbers_as_text(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call check_equal(error, to_text(-12), "-12", "integer")
      call check_equal(error, to_text(12345678901_int64), "12345678901", "long integer")
      call check_equal(error, to_text(0.0_wp), "0", "zero")
      call check_equal(error, to_text(0.25_wp), "0.25", "fraction")
      call check_equal(error, to_text(-5000.0_wp), "-5000", "thousands")
      call check_equal(error, to_text(2.07e11_wp), "2.07e11", "large")
      call check_equal(error, to_text(1.0e-4_wp), "0.0001", "least plain")
      call check_equal(error, to_text(1.0e-5_wp), "1e-5", "small")
      call check_equal(error, to_text(123456.7_wp), "123457", "six digits")
      call check_equal(error, to_text(999999.9_wp), "1e6", "rounded up")
      call check_equal(error, real_text(pi, 3), "3.14", "three digits")
      call check_equal(error, to_text(not_a_number()), "NaN", "not a number")
   end subroutine test_numbers_as_text

   !> The digits of whole numbers are those of a formatted write.
   subroutine test_whole_numbers(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      character(24) :: image
      integer :: i
      integer(int64) :: n

      call check_equal(error, to_text(0), "0", "nothing")
      call check_equal(error, to_text(huge(1)), "2147483647", "the greatest")
      call check_equal(error, to_text(-huge(1) - 1), "-2147483648", "the least")
      n = -huge(1_int64) - 1_int64
      do i = 1, 64
         write (image, "(i0)") n
         call check_equal(error, to_text(n), trim(image), "one and its half")
         write (image, "(i0)") - (n + i)
         call check_equal(error, to_text(-(n + i)), trim(image), "of the other sign")
         n = n/2
      end do
   end subroutine test_whole_numbers

   !> The digits of a number are those of a formatted write, all over the range and for each number of them.
   subroutine test_figures(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      character(40) :: form, image
      character(:), allocatable :: s
      real(wp) :: x
      integer :: digits, i, power

      do i = 1, 3000
         x = 10.0_wp**(-307.0_wp + 615.0_wp*i/3000.0_wp)
         if (i == 3000) x = huge(1.0_wp)
         if (modulo(i, 7) == 0) x = anint(x*2.0_wp**min(0, 52 - exponent(x)))/8.0_wp  ! halves of the last digit
         if (.not. x > 0.0_wp) cycle
         digits = 1 + modulo(i, 17)
         write (form, "(a, i0, a)") "(es40.", digits - 1, "e4)"
         write (image, form) x
         image = adjustl(image)
         read (image(index(image, "E") + 1:), *) power
         if (power >= -4 .and. power < max(digits, 6)) cycle  ! written without an exponent
         s = image(1:index(image, "E") - 1)
         if (index(s, ".") > 0) s = segment(s, 1, verify(s, "0", back=.true.))
         if (s(len(s):) == ".") s = segment(s, 1, len(s) - 1)
         call check_equal(error, real_text(x, digits), s//"e"//to_text(power), trim(image))
      end do
   end subroutine test_figures

   !> Text that reads back to the very same number.
   subroutine test_exact_text(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      real(wp) :: back, x
      integer :: digits, i
      character(:), allocatable :: s, shorter

      call check_equal(error, exact_text(0.1_wp), "0.1", "one tenth")
      call check_equal(error, exact_text(-1.0e-8_wp), "-1e-8", "a small number")
      call check_equal(error, exact_text(-40.0_wp), "-40", "a whole number")
      call check_equal(error, exact_text(100000.0_wp), "100000", "a greater one")
      call check_equal(error, exact_text(1.5e22_wp), "1.5e22", "one with an exponent")
      x = 0.7312890625_wp
      do i = 1, 2000
         x = x*1.37_wp
         if (x > 1.0e300_wp) x = x*1.0e-300_wp*1.0e-290_wp
         s = exact_text(x)
         read (s, *) back
         call check_close(error, back, x, 0.0_wp, s)
         do digits = 15, 17  ! the fewest that do, rounded from the number and not from its digits
            shorter = real_text(x, digits)
            read (shorter, *) back
            if (.not. abs(back - x) > 0.0_wp) exit
         end do
         call check_equal(error, s, real_text(x, digits), "the fewest digits")
      end do
      call check_equal(error, exact_text(0.99999999999999989_wp), "0.9999999999999999", "below one")
      call check_equal(error, exact_text(9.9999999999999995e22_wp), "1e23", "a carry")
      s = exact_text(huge(1.0_wp))
      read (s, *) back
      call check_close(error, back, huge(1.0_wp), 0.0_wp, s)
   end subroutine test_exact_text

   !> Lists of strings.
   subroutine test_lists(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(text_t), allocatable :: list(:)

      allocate (list(0))
      list = split_blank("  one two"//achar(9)//"three ")
      call check_equal(error, size(list), 3, "number of words")
      call check_equal(error, join(list, ","), "one,two,three", "words")
      call check_equal(error, size(split_blank("   ")), 0, "no words")
      call append_text(list, "")
      call append_text(list, "five")
      call check_equal(error, join(list, "-"), "one-two-three--five", "appended")
      deallocate (list)
      call append_text(list, "first")
      call check_equal(error, join(list, "-"), "first", "appended to nothing")
      call check_equal(error, join(split_blank(""), "-"), "", "joined nothing")
   end subroutine test_lists

   !> Single strings.
   subroutine test_strings(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call check_equal(error, lower("Gudgeon PIN 7_"), "gudgeon pin 7_", "lower")
      call check_equal(error, replace("a.b.c", ".", "::"), "a::b::c", "replace")
      call check_equal(error, replace("aaa", "aa", "b"), "ba", "replace from the left")
      call check_equal(error, replace("abc", "", "x"), "abc", "replace nothing")
      call check_equal(error, replace("abcabc", "abc", ""), "", "replace by nothing")
      call check_true(error, starts_with("joint.revolute", "joint."), "starts with")
      call check_true(error, .not. starts_with("joint", "joint."), "does not start with")
      call check_true(error, starts_with("x", ""), "starts with nothing")
   end subroutine test_strings

   !> The nearest word.
   subroutine test_spelling(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      character(*), parameter :: known = "name bearing journal bearing_radius clearance level"

      call check_equal(error, nearest_word("clearence", known), "clearance", "a changed letter")
      call check_equal(error, nearest_word("clearnace", known), "clearance", "swapped letters")
      call check_equal(error, nearest_word("Journal", known), "journal", "a capital letter")
      call check_equal(error, nearest_word("lvel", known), "level", "a letter left out")
      call check_equal(error, nearest_word("leevel", known), "level", "a letter too many")
      call check_equal(error, nearest_word("clear", known), "clearance", "a beginning")
      call check_equal(error, nearest_word("temperature", known), "", "nothing near")
      call check_equal(error, nearest_word("x", known), "", "too short")
      call check_equal(error, nearest_word("", known), "", "nothing")
      call check_equal(error, nearest_word("name", ""), "", "no candidates")
      call check_equal(error, nearest_word(repeat("name", 1000), known), "", "absurdly long")
      call check_equal(error, nearest_word("cc", "c speed"), "c", "one of two letters")
   end subroutine test_spelling

   !> A buffer grows without copying itself each time.
   subroutine test_buffer(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      type(buffer_t) :: buffer
      integer :: i

      call check_equal(error, buffer%get(), "", "an empty buffer")
      do i = 1, 1000000
         call buffer%add("0123456789")
      end do
      call check_equal(error, buffer%length(), 10000000, "length")
      call buffer%line("end")
      call check_true(error, index(buffer%get(), "9012345678", back=.true.) == 9999990, "content")
   end subroutine test_buffer

   !> Where numbers end.
   subroutine test_number_length(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call check_equal(error, number_length("12"), 2, "12")
      call check_equal(error, number_length("-1.5e-3mm"), 7, "-1.5e-3mm")
      call check_equal(error, number_length("1d-3"), 4, "1d-3")
      call check_equal(error, number_length(".5"), 2, ".5")
      call check_equal(error, number_length("5."), 2, "5.")
      call check_equal(error, number_length("5.mm"), 2, "5.mm")
      call check_equal(error, number_length("2deg"), 1, "2deg")
      call check_equal(error, number_length("2e"), 1, "2e")
      call check_equal(error, number_length("2e+"), 1, "2e+")
      call check_equal(error, number_length("1,5"), 1, "1,5")
      call check_equal(error, number_length("."), 0, ".")
      call check_equal(error, number_length("-"), 0, "-")
      call check_equal(error, number_length("-e5"), 0, "-e5")
      call check_equal(error, number_length("nan"), 0, "nan")
      call check_equal(error, number_length(""), 0, "nothing")
   end subroutine test_number_length

   !> Values of numbers, and what is too large.
   subroutine test_read_number(error)
      type(error_t), allocatable, intent(out) :: error  !! first failure

      call expect("0.1", -3, 1.0e-4_wp)
      call expect("-25", -3, -0.025_wp)
      call expect("5.", 0, 5.0_wp)
      call expect(".5d1", 0, 5.0_wp)
      call expect("+1E2", 1, 1000.0_wp)
      call expect("0.000", 5, 0.0_wp)
      call expect("0e999999999999", 0, 0.0_wp)
      call expect("1e-999999999999", 0, 0.0_wp)
      call expect("0.0001e311", 0, 1.0e307_wp)
      call expect("12345678901234567890", -19, 1.2345678901234567890_wp)
      call refuse("1e308")
      call refuse("1e999999999999")
      call refuse(repeat("9", 400))

   contains

      !> Read and compare.
      subroutine expect(s, power, expected)
         character(*), intent(in) :: s       !! the number
         integer, intent(in) :: power        !! power of ten
         real(wp), intent(in) :: expected    !! its value [any]

         real(wp) :: x
         logical :: is_finite

         call read_number(s, power, x, is_finite)
         call check_true(error, is_finite, s//" is finite")
         call check_close(error, x, expected, 0.0_wp, s)
      end subroutine expect

      !> Must not be read.
      subroutine refuse(s)
         character(*), intent(in) :: s  !! the number

         real(wp) :: x
         logical :: is_finite

         call read_number(s, 0, x, is_finite)
         call check_true(error, .not. is_finite, s(1:min(len(s), 20))//" is refused")
      end subroutine refuse

   end subroutine test_read_number

end module test_text
