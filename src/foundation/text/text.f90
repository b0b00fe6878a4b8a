!> Text: strings of any length, numbers as text, blanks.
!>
!> Nothing here is used inside an evaluation.
module text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_null_char, c_null_ptr, c_ptr
   use, intrinsic :: iso_fortran_env, only: int64
   use kinds, only: wp
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
  public :: append_text, counted, exact_text, join, lower, segment, printable, real_text, replace, split_blank, starts_with, &
       text_t, &
      to_text

   !> A string of any length, so that lists of strings may be ragged.
   type :: text_t
      character(:), allocatable :: s  !! the string
   end type text_t

   !> A number as text.
   interface to_text
      module procedure :: integer_text
      module procedure :: long_text
      module procedure :: short_real_text
   end interface to_text

   ! allow(assumed-size)
   interface
      pure real(c_double) function c_strtod(digits, rest) bind(c, name="strtod")
         import :: c_char, c_double, c_ptr
         implicit none (type, external)
         character(kind=c_char), intent(in) :: digits(*)  !! (n) a number, ended by a null
         type(c_ptr), value :: rest                       !! null: where it ends is not asked
      end function c_strtod
   end interface

contains

   !> An integer as text.
   pure function integer_text(i) result(s)
      integer, intent(in) :: i        !! the number
      character(:), allocatable :: s  !! its digits

      s = long_text(int(i, int64))
   end function integer_text

   !> A long integer as text.
   pure function long_text(i) result(s)
      integer(int64), intent(in) :: i  !! the number
      character(:), allocatable :: s   !! its digits

      character(20) :: digits
      integer :: first
      integer(int64) :: rest

      first = len(digits) + 1
      rest = i
      do
         first = first - 1
         digits(first:first) = achar(iachar("0") + abs(int(mod(rest, 10_int64))))
         rest = rest/10
         if (rest == 0) exit
      end do
      if (i < 0) then
         first = first - 1
         digits(first:first) = "-"
      end if
      s = digits(first:)
   end function long_text

   !> A real as text for people, with up to six significant digits.
   pure function short_real_text(x) result(s)
      real(wp), intent(in) :: x       !! the number [any]
      character(:), allocatable :: s  !! as `0.25`, `5000` or `1e-07`

      s = real_text(x, 6)
   end function short_real_text

   !> A real as text with up to `digits` significant digits and no trailing zeros.
   pure function real_text(x, digits) result(s)
      real(wp), intent(in) :: x       !! the number [any]
      integer, intent(in) :: digits   !! significant digits, 1 to 17
      character(:), allocatable :: s  !! plain from 1e-4 up to 1e6, or as far as its digits go

      character(:), allocatable :: figures
      integer :: power

      if (ieee_is_nan(x)) then
         s = "NaN"
         return
      end if
      s = ""
      if (x < 0.0_wp) s = "-"
      if (.not. ieee_is_finite(x)) then
         s = s//"Inf"
         return
      end if
      call find_figures(abs(x), max(digits, 1), figures, power)
      s = s//placed(figures(:max(verify(figures, "0", back=.true.), 1)), power)
   end function real_text

   !> The first significant digits of a number, rounded, and the power of ten of the first of them.
   pure subroutine find_figures(x, digits, figures, power)
      real(wp), intent(in) :: x                                !! the number, finite, not negative [any]
      integer, intent(in) :: digits                            !! how many
      character(:), allocatable, intent(out) :: figures        !! the digits
      integer, intent(out) :: power                            !! of the first one

      ! allow(assumed-size, assumed-size-character-intent)
      interface
         pure subroutine c_figures(x, digits, image, room) bind(c, name="gudgeon_figures")
            import :: c_char, c_double, c_int
            implicit none (type, external)
            real(c_double), value :: x                              !! the number [any]
            integer(c_int), value :: digits                         !! how many, at least 1
            character(kind=c_char), intent(inout) :: image(*)       !! (room) as `d.ddde-07`, ended by a null
            integer(c_int), value :: room                           !! characters
         end subroutine c_figures
      end interface

      character(kind=c_char, len=40) :: image
      integer :: at, k

      image = ""
      call c_figures(real(x, c_double), int(digits, c_int), image, len(image, c_int))
      at = index(image, "e")
      power = 0  ! e, sign, two or three digits
      do k = at + 2, index(image, c_null_char) - 1
         power = 10*power + iachar(image(k:k)) - iachar("0")
      end do
      if (image(at + 1:at + 1) == "-") power = -power
      figures = image(1:1)//image(3:at - 1)
   end subroutine find_figures

   !> Fewer digits, rounded; none if those that go do not say which way.
   pure subroutine round_figures(digits, figures, power)
      integer, intent(in) :: digits                             !! how many are left
      character(:), allocatable, intent(inout) :: figures       !! the digits; empty: they do not say
      integer, intent(inout) :: power                           !! of the first one

      character(:), allocatable :: tail
      integer :: k

      tail = figures(digits + 1:)
      figures = segment(figures, 1, digits)
      if (tail == "5"//repeat("0", len(tail) - 1)) then
         figures = ""
         return
      end if
      if (tail < "5") return
      do k = digits, 1, -1
         if (figures(k:k) /= "9") then
            figures(k:k) = achar(iachar(figures(k:k)) + 1)
            return
         end if
         figures(k:k) = "0"
      end do
      figures = "1"//segment(figures, 1, digits - 1)
      power = power + 1
   end subroutine round_figures

   !> Significant digits with the decimal point or the exponent put in.
   pure function placed(figures, power) result(s)
      character(*), intent(in) :: figures  !! digits without trailing zeros
      integer, intent(in) :: power         !! power of ten of the first of them
      character(:), allocatable :: s       !! the number

      integer :: n

      n = len(figures)
      if (power < -4 .or. power >= max(n, 6)) then
         s = figures(1:1)
         if (n > 1) s = s//"."//figures(2:)
         s = s//"e"//integer_text(power)
      else if (power < 0) then
         s = "0."//repeat("0", -power - 1)//figures
      else if (power >= n - 1) then
         s = figures//repeat("0", power - n + 1)
      else
         s = figures(1:power + 1)//"."//figures(power + 2:)
      end if
   end function placed

   !> A real as the shortest text that reads back to the very same number.
   pure function exact_text(x) result(s)
      real(wp), intent(in) :: x       !! the number [any]
      character(:), allocatable :: s  !! 15 to 17 significant digits at most

      real(wp), parameter :: whole = 1.0e5_wp  ! whole numbers below it are written as such [any]
      character(:), allocatable :: all, figures
      real(wp) :: back
      integer :: digits, most, power
      logical :: is_usual

      is_usual = ieee_is_finite(x)
      if (is_usual) is_usual = abs(x) <= 1.0e308_wp  ! fewer digits of a greater one may be infinite
      if (.not. is_usual) then
         s = real_text(x, 17)
         return
      end if
      if (abs(x) < whole) then
         if (.not. abs(x - aint(x)) > 0.0_wp) then
            s = integer_text(nint(x))
            return
         end if
      end if
      call find_figures(abs(x), 17, all, most)
      do digits = 15, 17
         figures = all
         power = most
         if (digits < 17) call round_figures(digits, figures, power)
         if (len(figures) == 0) call find_figures(abs(x), digits, figures, power)
         s = placed(figures(:max(verify(figures, "0", back=.true.), 1)), power)
         if (x < 0.0_wp) s = "-"//s
         back = real(c_strtod(s//c_null_char, c_null_ptr), wp)
         if (.not. (back < x .or. back > x)) return
      end do
   end function exact_text

   !> A number with the word for it.
   pure function counted(n, one, many) result(words)
      integer, intent(in) :: n               !! the number
      character(*), intent(in) :: one        !! word for one
      character(*), intent(in) :: many       !! word for several
      character(:), allocatable :: words     !! as `3 bodies`

      words = integer_text(n)//" "//many
      if (n == 1) words = integer_text(n)//" "//one
   end function counted

   !> Lower case (ASCII letters only).
   pure function lower(s) result(small)
      character(*), intent(in) :: s   !! any string
      character(len(s)) :: small      !! the same with small letters

      integer :: code, i

      do i = 1, len(s)
         code = iachar(s(i:i))
         if (code >= iachar("A") .and. code <= iachar("Z")) code = code + 32
         small(i:i) = achar(code)
      end do
   end function lower

   !> A piece of a string, for the string itself to become it: `s = s(2:)` as it stands makes the room of `s` smaller before it is
   !> read (gfortran), and where the room moves reads what is no longer there.
   pure function segment(string, first, last) result(s)
      character(*), intent(in) :: string       !! the string
      integer, intent(in) :: first             !! first character of the piece
      integer, intent(in), optional :: last    !! last one; absent: that of the string
      character(:), allocatable :: s           !! the piece

      if (present(last)) then
         s = string(first:last)
      else
         s = string(first:)
      end if
   end function segment

   !> All strings of a list in one, with a separator between them.
   pure function join(list, separator) result(s)
      type(text_t), intent(in) :: list(:)    !! (n) strings
      character(*), intent(in) :: separator  !! between two of them
      character(:), allocatable :: s         !! the whole

      type(buffer_t) :: buffer
      integer :: i

      do i = 1, size(list)
         if (i > 1) call buffer%add(separator)
         if (allocated(list(i)%s)) call buffer%add(list(i)%s)
      end do
      s = buffer%get()
   end function join

   !> The words of a string; blanks and tabs separate.
   pure function split_blank(string) result(words)
      character(*), intent(in) :: string       !! any string
      type(text_t), allocatable :: words(:)    !! (n) its words, n may be 0

      character(*), parameter :: blank = " "//achar(9)
      integer :: first, i, last, n, pass

      do pass = 1, 2
         n = 0
         last = 0
         do
            if (last >= len(string)) exit
            i = verify(string(last + 1:), blank)
            if (i == 0) exit
            first = last + i
            i = scan(string(first:), blank)
            last = len(string)
            if (i > 0) last = first + i - 2
            n = n + 1
            if (pass == 2) words(n)%s = string(first:last)
         end do
         if (pass == 1) allocate (words(n))
      end do
   end function split_blank

   !> Append a string to a short list: all others are moved.
   pure subroutine append_text(list, s)
      type(text_t), allocatable, intent(inout) :: list(:)  !! (n) strings, may be unallocated
      character(*), intent(in) :: s                        !! the new one

      type(text_t), allocatable :: grown(:)
      integer :: i, n

      n = 0
      if (allocated(list)) n = size(list)
      allocate (grown(n + 1))
      do i = 1, n
         call move_alloc(list(i)%s, grown(i)%s)
      end do
      grown(n + 1)%s = s
      call move_alloc(grown, list)
   end subroutine append_text

   !> A text with control characters, but tabs and ends of lines, made harmless for a terminal.
   pure function printable(string) result(harmless)
      character(*), intent(in) :: string      !! any text
      character(len(string)) :: harmless      !! the same, with question marks

      integer :: code, i

      harmless = string
      do i = 1, len(string)
         code = iachar(string(i:i))
         if ((code < 32 .and. code /= 9 .and. code /= 10) .or. code == 127) harmless(i:i) = "?"
         if (i == 1 .or. code < 128 .or. code >= 160) cycle
         if (iachar(string(i - 1:i - 1)) == 194) harmless(i - 1:i) = "??"  ! U+0080 to U+009F, in UTF-8
      end do
   end function printable

   !> Whether a string starts with another.
   pure logical function starts_with(string, start)
      character(*), intent(in) :: string  !! any string
      character(*), intent(in) :: start   !! its supposed start

      starts_with = .false.
      if (len(start) <= len(string)) starts_with = string(1:len(start)) == start
   end function starts_with

   !> Replace every occurrence of one string by another.
   pure function replace(string, old, new) result(s)
      character(*), intent(in) :: string  !! any string
      character(*), intent(in) :: old     !! to look for
      character(*), intent(in) :: new     !! to put there
      character(:), allocatable :: s      !! the new string

      type(buffer_t) :: buffer
      integer :: at, next

      if (len(old) == 0) then
         s = string
         return
      end if
      next = 1
      do
         at = 0
         if (next <= len(string)) at = index(string(next:), old)
         if (at == 0) exit
         call buffer%add(string(next:next + at - 2))
         call buffer%add(new)
         next = next + at - 1 + len(old)
      end do
      call buffer%add(string(next:))
      s = buffer%get()
   end function replace

end module text
