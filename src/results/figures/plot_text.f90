!> Text that gnuplot draws as it is, whatever it holds: nothing of it is ever a command.
!>
!> gnuplot runs what stands between backticks in double quotes, a line that starts with `!`, and
!> files named `|command` or `<command`. Single-quoted strings know no escapes, so a string without
!> apostrophes and control characters stays a string. A character that the font lacks makes gnuplot
!> fill the picture with a black box, so a small white square stands for it.
module plot_text
   implicit none (type, external)
   private
   public :: quoted, valid_utf8

   integer, parameter :: longest = 90                    !! characters drawn, the rest is cut
   character(*), parameter :: apostrophe = "’"           !! drawn for `'`
   character(*), parameter :: ellipsis = "…"             !! drawn where text was cut
   character(*), parameter :: unknown = "□"              !! drawn for a character that the font lacks

   !> First and last code of characters that DejaVu Sans is sure to have: Latin, Greek, Cyrillic, Hebrew,
   !> Arabic, punctuation, arrows, mathematics, boxes and signs.
   integer, parameter :: drawable(*) = [ &
      32, 126, 160, 745, 768, 847, 900, 906, 908, 908, 910, 929, 931, 1317, 1488, 1514, &
      1569, 1594, 1600, 1621, 7680, 7931, 8208, 8231, 8240, 8287, 8304, 8305, 8308, 8334, 8336, 8348, &
      8352, 8373, 8448, 8457, 8459, 8521, 8528, 8581, 8592, 8977, 9472, 9884, 9985, 9988, &
      10025, 10059, 10224, 10239] !! (2 n)

contains

   !> A single-quoted string for gnuplot.
   pure function quoted(text, most) result(s)
      character(*), intent(in) :: text         !! any bytes
      integer, intent(in), optional :: most    !! characters that there is storage for
      character(:), allocatable :: s           !! with its quotes

      character(:), allocatable :: clean
      integer :: code, i, length, limit, n

      limit = longest
      if (present(most)) limit = min(longest, most)
      clean = valid_utf8(text)
      s = ""
      n = 0
      i = 1
      do while (i <= len(clean))
         n = n + 1
         if (n > limit) then
            s = s//ellipsis
            exit
         end if
         call next_character(clean(i:), length, code)
         if (clean(i:i) == "'") then
            s = s//apostrophe
         else if (code < 32 .or. code == 127) then
            s = s//" "
         else if (any(code >= drawable(1::2) .and. code <= drawable(2::2))) then
            s = s//clean(i:i + length - 1)
         else
            s = s//unknown
         end if
         i = i + length
      end do
      s = "'"//s//"'"
   end function quoted

   !> Whether a byte starts a character of UTF-8.
   pure logical function starts_character(byte)
      character(1), intent(in) :: byte  !! any byte

      starts_character = iand(ichar(byte), 192) /= 128
   end function starts_character

   !> Bytes as UTF-8: what is not a character of it becomes a question mark.
   pure function valid_utf8(bytes) result(s)
      character(*), intent(in) :: bytes   !! any bytes
      character(:), allocatable :: s      !! valid UTF-8

      integer :: code, i, n

      s = bytes
      i = 1
      do while (i <= len(bytes))
         call next_character(bytes(i:), n, code)
         if (n == 0) s(i:i) = "?"
         i = i + max(n, 1)
      end do
   end function valid_utf8

   !> The character that a string starts with.
   pure subroutine next_character(bytes, n, code)
      character(*), intent(in) :: bytes  !! at least one byte
      integer, intent(out) :: n          !! its length in bytes, 0 if it is none
      integer, intent(out) :: code       !! its number

      integer :: i, minimum

      code = ichar(bytes(1:1))
      n = 1
      minimum = 0
      if (code < 128) return
      n = 0
      if (code >= 194 .and. code < 224) then
         n = 2
         minimum = 128
         code = code - 192
      else if (code >= 224 .and. code < 240) then
         n = 3
         minimum = 2048
         code = code - 224
      else if (code >= 240 .and. code < 245) then
         n = 4
         minimum = 65536
         code = code - 240
      end if
      if (n > len(bytes)) n = 0
      do i = 2, n
         if (starts_character(bytes(i:i))) then
            n = 0
            return
         end if
         code = 64*code + iand(ichar(bytes(i:i)), 63)
      end do
      if (code < minimum .or. code > 1114111 .or. (code >= 55296 .and. code < 57344)) n = 0
   end subroutine next_character

end module plot_text
