!> Cells of a line: words, `{expressions}`, `"quoted text"` and equals signs, each with its place.
!>
!> Blanks and tabs separate; `#` starts a comment outside quotes. In quotes `\"`, `\\` and `\n` are
!> known. A token holds no text, only where it stands: `token_text` fetches it.
module tokens
   use diagnostics, only: diagnostics_t
   use foreign_signs, only: find_foreign_comment, find_foreign_sign
   use item, only: location_t
   use source_text, only: line_of, source_t
   use text_buffer, only: buffer_t
   use text, only: segment
   implicit none (type, external)
   private
   public :: has_content, lex_line, span, token_brace, token_equals, token_list_t, token_quoted, token_t, token_text, token_word

   integer, parameter :: token_word = 1    !! a bare word
   integer, parameter :: token_brace = 2   !! an expression in braces
   integer, parameter :: token_quoted = 3  !! text in quotes
   integer, parameter :: token_equals = 4  !! an equals sign

   character(*), parameter :: blanks = " "//achar(9)//achar(11)//achar(12)//achar(13)

   !> One cell or sign.
   type :: token_t
      integer :: kind = token_word  !! one of the above
      type(location_t) :: location  !! where it stands, with braces or quotes
   end type token_t

   !> A list that grows.
   type :: token_list_t
      type(token_t), allocatable :: t(:)  !! (capacity) the tokens
      integer :: n = 0                    !! tokens in use
   end type token_list_t

contains

   !> Whether a line has anything but blanks and a comment; `first` is where that starts.
   pure subroutine has_content(line, first)
      character(*), intent(in) :: line  !! one line
      integer, intent(out) :: first     !! first character, 0 if there is none

      first = verify(line, blanks)
      if (first == 0) return
      if (line(first:first) == "#") first = 0
   end subroutine has_content

   !> Cut a line into tokens and append them to a list.
   subroutine lex_line(source, file, number, list, mistakes, is_good)
      type(source_t), intent(in) :: source            !! the text
      integer, intent(in) :: file                     !! number of the source
      integer, intent(in) :: number                   !! of the line
      type(token_list_t), intent(inout) :: list       !! tokens, appended to
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      logical, intent(out) :: is_good                 !! whether the line could be cut

      character(:), allocatable :: line, message, note
      integer :: at, kind, last, n, previous, skip

      line = line_of(source, number)
      call find_foreign_sign(line, at, last, message, note)
      is_good = at == 0
      if (.not. is_good) then
         call mistakes%add(location_t(file, number, at, last), message, note)
         return
      end if
      n = list%n
      at = 1
      previous = token_equals
      do
         if (at > len(line)) return
         skip = verify(line(at:), blanks) - 1
         if (skip < 0) return
         at = at + skip
         if (skip > 0) previous = token_equals
         if (line(at:at) == "#") return
         if (find_foreign_comment(line(at:))) then
            call mistakes%add(location_t(file, number, at, len_trim(line)), "a comment starts with '#'", "invalid comment "// &
               "character")
            is_good = list%n > n
            return
         end if
         call measure(line, at, kind, last)
         if (kind == 0) then
            call complain(line(at:at), location_t(file, number, at, last), mistakes)
            is_good = .false.
            return
         end if
         if (previous /= token_equals .and. kind /= token_equals) then
            call mistakes%add(location_t(file, number, at, last), "missing blank between two cells", &
                            & "insert a blank before this", glued_help(previous))
            is_good = .false.
            return
         end if
         call append(list, token_t(kind, location_t(file, number, at, last)))
         previous = kind
         at = last + 1
      end do
   end subroutine lex_line

   !> Kind and end of the token that starts at a character.
   pure subroutine measure(line, at, kind, last)
      character(*), intent(in) :: line  !! one line
      integer, intent(in) :: at         !! first character
      integer, intent(out) :: kind      !! of the token; 0: it does not end, or it is a stray brace
      integer, intent(out) :: last      !! its last character, the end of the line if it does not end

      integer :: length

      last = at
      select case (line(at:at))
      case ("=")
         kind = token_equals
      case ("{")
         kind = token_brace
         length = scan(line(at + 1:), "}{#")
         last = at + length
         if (length > 0) then
            if (line(last:last) == "}") return
         end if
         kind = 0
         last = len_trim(line)
      case ("}")
         kind = 0
      case ("""")
         kind = token_quoted
         do
            last = last + 1
            if (last > len(line)) exit
            if (line(last:last) == "\") then
               last = last + 1
            else if (line(last:last) == """") then
               return
            end if
         end do
         kind = 0
         last = len_trim(line)
      case default
         kind = token_word
         length = scan(line(at:), blanks//"={}""#") - 1
         if (length < 0) length = len(line) - at + 1
         last = at + length - 1
      end select
   end subroutine measure

   !> Report a quote or brace that does not end.
   subroutine complain(sign, location, mistakes)
      character, intent(in) :: sign                   !! with which it starts
      type(location_t), intent(in) :: location        !! where
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      select case (sign)
      case ("{")
         call mistakes%add(location, "missing closing brace", "'}' is missing", "close an expression on the same line")
      case ("}")
         call mistakes%add(location, "missing opening brace", "'{' is missing before this")
      case default
         call mistakes%add(location, "missing closing quote", "'""' is missing", &
                         & "close quoted text on the same line; \"" is a quote and \n a new line")
      end select
   end subroutine complain

   !> What to do about two cells without a blank between them.
   pure function glued_help(previous) result(help)
      integer, intent(in) :: previous    !! kind of the token before
      character(:), allocatable :: help  !! the line

      help = ""
      if (previous == token_brace) help = "the result of an expression in braces has its own unit"
   end function glued_help

   !> The text of a token: a word, an expression without braces, or text without quotes and escapes.
   function token_text(sources, token) result(s)
      type(source_t), intent(in) :: sources(:)  !! (n) all texts
      type(token_t), intent(in) :: token        !! the token
      character(:), allocatable :: s            !! its text

      associate (at => token%location)
         associate (source => sources(at%file))
            s = source%text(source%first(at%line) + at%first - 1:source%first(at%line) + at%last - 1)
         end associate
      end associate
      if (token%kind == token_brace) then
         s = segment(s, 2, len(s) - 1)
      else if (token%kind == token_quoted) then
         s = unescaped(s(2:len(s) - 1))
      end if
   end function token_text

   !> Quoted text with its escapes resolved.
   pure function unescaped(raw) result(s)
      character(*), intent(in) :: raw  !! between the quotes
      character(:), allocatable :: s   !! what it stands for

      type(buffer_t) :: buffer
      integer :: i

      i = 1
      do while (i <= len(raw))
         if (raw(i:i) == "\" .and. i < len(raw)) then
            i = i + 1
            if (raw(i:i) == "n") then
               call buffer%add(new_line("a"))
            else if (raw(i:i) == """" .or. raw(i:i) == "\") then
               call buffer%add(raw(i:i))
            else
               call buffer%add("\"//raw(i:i))
            end if
         else
            call buffer%add(raw(i:i))
         end if
         i = i + 1
      end do
      s = buffer%get()
   end function unescaped

   !> The place from one token to another of the same line.
   pure type(location_t) function span(a, b)
      type(token_t), intent(in) :: a  !! first token
      type(token_t), intent(in) :: b  !! last token

      span = a%location
      span%last = b%location%last
   end function span

   !> Append a token.
   subroutine append(list, token)
      type(token_list_t), intent(inout) :: list  !! the list
      type(token_t), intent(in) :: token         !! the new one

      type(token_t), allocatable :: larger(:)

      if (.not. allocated(list%t)) allocate (list%t(64))
      if (list%n == size(list%t)) then
         allocate (larger(2*list%n))
         larger(1:list%n) = list%t
         call move_alloc(larger, list%t)
      end if
      list%n = list%n + 1
      list%t(list%n) = token
   end subroutine append

end module tokens
