!> Signs of a line that look like those of a deck but are others, and comments as other programs have them.
!>
!> What word processors and web pages make of minus signs, quotes, blanks and exponents is a character beyond ASCII; it is named
!> with its number, and the sign to type. Text in quotes and comments may hold anything.
module foreign_signs
   use text, only: starts_with
   implicit none (type, external)
   private
   public :: find_foreign_comment, find_foreign_sign

contains

   !> First character of a line, outside quotes and comments, that looks like a sign of a deck.
   pure subroutine find_foreign_sign(line, first, last, message, note)
      character(*), intent(in) :: line                   !! one line, UTF-8
      integer, intent(out) :: first                      !! its first byte, 0: there is none
      integer, intent(out) :: last                       !! its last byte
      character(:), allocatable, intent(out) :: message  !! what it is
      character(:), allocatable, intent(out) :: note     !! what to type

      character(:), allocatable :: plain
      integer :: code
      logical :: is_quoted

      first = 0
      last = 0
      message = ""
      note = ""
      if (is_ascii(line)) return
      is_quoted = .false.
      do while (last < len(line))
         first = last + 1
         call decode(line, first, last, code)
         if (is_quoted .and. line(first:first) == "\") then
            last = last + 1
         else if (line(first:first) == """") then
            is_quoted = .not. is_quoted
         else if (.not. is_quoted .and. line(first:first) == "#") then
            exit
         else if (.not. is_quoted .and. code >= 128) then
            plain = plain_sign(code)
            if (plain == "") cycle
            message = "'"//line(first:last)//"' (U+"//hexadecimal(code)//") is not allowed in a deck"
            note = "type '"//plain//"'"
            if (plain == "blank") note = "type a blank"
            if (plain == "nothing") note = "an invisible character; delete it"
            return
         end if
      end do
      first = 0
   end subroutine find_foreign_sign

   !> What to type for a character that looks like it; blank if it looks like none.
   pure function plain_sign(code) result(plain)
      integer, intent(in) :: code          !! number in Unicode
      character(:), allocatable :: plain   !! the sign, or the words `blank` and `nothing`

      select case (code)
      case (160, 8194, 8195, 8199, 8201, 8202, 8239, 12288); plain = "blank"
      case (173, 8203:8205, 8288, 65279); plain = "nothing"
      case (8208:8212, 8722, 65123, 65293); plain = "-"
      case (8216, 8217); plain = "'"
      case (171, 187, 8220:8222); plain = """"
      case (183, 8226, 8901, 65292, 65294); plain = "."
      case (215, 8727); plain = "*"
      case (247, 8260, 8725); plain = "/"
      case (178); plain = "^2"
      case (179); plain = "^3"
      case (185); plain = "^1"
      case (8315); plain = "^-"
      case (960); plain = "pi"
      case (65309); plain = "="
      case default; plain = ""
      end select
   end function plain_sign

   !> Whether a word starts a comment of another program.
   pure logical function find_foreign_comment(rest) result(is_comment)
      character(*), intent(in) :: rest  !! a line from the start of a word on

      is_comment = scan(rest(1:1), "!%;") == 1 .or. starts_with(rest, "//") .or. starts_with(rest, "/*")
   end function find_foreign_comment

   !> Whether all characters are those of ASCII.
   pure logical function is_ascii(line)
      character(*), intent(in) :: line  !! the text

      integer :: k, most

      most = 0
      do k = 1, len(line)
         most = ior(most, iachar(line(k:k)))
      end do
      is_ascii = most < 128
   end function is_ascii

   !> A character of UTF-8; bytes that are none count as one character each.
   pure subroutine decode(line, first, last, code)
      character(*), intent(in) :: line  !! the text
      integer, intent(in) :: first      !! first byte of the character
      integer, intent(out) :: last      !! its last byte
      integer, intent(out) :: code      !! its number in Unicode, or the byte

      integer :: k, n

      last = first
      code = iachar(line(first:first))
      n = 0
      if (code >= 192) n = 1
      if (code >= 224) n = 2
      if (code >= 240) n = 3
      if (n == 0 .or. first + n > len(line)) return
      code = iand(code, 2**(6 - n) - 1)
      do k = first + 1, first + n
         if (iand(iachar(line(k:k)), 192) /= 128) then
            code = iachar(line(first:first))
            return
         end if
         code = 64*code + iand(iachar(line(k:k)), 63)
      end do
      last = first + n
   end subroutine decode

   !> A number in hexadecimal digits, at least four.
   pure function hexadecimal(code) result(s)
      integer, intent(in) :: code     !! from 0 on
      character(:), allocatable :: s  !! its digits

      character(8) :: digits

      write (digits, "(z8.4)") code
      s = trim(adjustl(digits))
   end function hexadecimal

end module foreign_signs
