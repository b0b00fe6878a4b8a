!> The text of an Adams dataset cut into statements.
!>
!> The first line is the title. `!` begins a comment. A line whose first character is a comma goes on with the statement before it,
!> `;` ends a statement, `END` the dataset. A statement is a name, a slash, a number (most of them), and arguments: words,
!> `NAME = value, value ...`, or `NAME = expression`. A backslash ends an expression that is not the last argument. The comma that
!> begins a line is no comma of an expression where that could not have one. A name that Adams/View writes in a comment before the
!> statement (`adams_view_name='...'`) goes with it.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: no nested datasets, no commands.
module dataset
   use numbers, only: number_length
   use source_text, only: line_of, n_line_of, source_t
   use text, only: append_text, lower, text_t
   implicit none (type, external)
   private
   public :: argument_t, find_argument, has_word, is_expression_name, read_statements, statement_t, upper_case

   character(*), parameter :: expressions = " FUNCTION FX FY FZ TX TY TZ F1 F2 F3 F4 F5 F6 F7 F8 "  !! arguments that are one

   !> An argument: a word, or a name with its values.
   type :: argument_t
      character(:), allocatable :: name        !! in capitals, as written
      type(text_t), allocatable :: values(:)   !! (n) what stands behind the equals sign; none: a word
      integer :: line = 0                      !! where it stands
   end type argument_t

   !> A statement.
   type :: statement_t
      character(:), allocatable :: keyword          !! in capitals, as written
      integer :: id = -1                            !! its number; -1: it has none
      type(argument_t), allocatable :: arguments(:) !! (n) in the order of the text
      character(:), allocatable :: view_name        !! name from the comment before it; blank: none
      integer :: line = 0                           !! where it begins
   end type statement_t

   !> A statement while it is put together from its lines.
   type :: gathered_t
      character(:), allocatable :: text        !! without comments and signs of continuation
      integer, allocatable :: first(:)         !! (lines) where in it a line begins
      integer, allocatable :: line(:)          !! (lines) number of that line
      character(:), allocatable :: view_name   !! of the comment before it
   end type gathered_t

contains

   !> Cut a text into statements.
   subroutine read_statements(source, title, statements)
      type(source_t), intent(in) :: source                            !! the dataset
      character(:), allocatable, intent(out) :: title                 !! its first line
      type(statement_t), allocatable, intent(out) :: statements(:)    !! (n) all others

      type(gathered_t) :: now
      character(:), allocatable :: line, part, view_name
      integer :: at, k
      logical :: is_over

      title = trim(adjustl(line_of(source, 1)))
      allocate (statements(0))
      view_name = ""
      now%text = ""
      is_over = .false.
      do k = merge(1, 2, is_statement(title)), n_line_of(source)
         line = trim(adjustl(replaced_tabs(line_of(source, k))))
         call take_comment(line, view_name)
         if (len(line) == 0) cycle
         if (line(1:1) == "," .and. len(now%text) > 0) then
            call go_on(now, line(2:), k)
            cycle
         end if
         call finish(now, statements, is_over)
         if (is_over) return
         do
            at = index(line, ";")
            part = line
            if (at > 0) part = line(:at - 1)
            call begin(now, part, k, view_name)
            view_name = ""
            if (at == 0 .or. at == len(line)) exit
            call finish(now, statements, is_over)
            if (is_over) return
            part = trim(adjustl(line(at + 1:)))
            call move_alloc(part, line)
            if (len(line) == 0) exit
         end do
      end do
      call finish(now, statements, is_over)
   end subroutine read_statements

   !> Whether the first line is a statement and no title: a capital word, a slash, a number and a comma.
   pure logical function is_statement(line)
      character(*), intent(in) :: line  !! the first line

      integer :: comma, slash

      is_statement = .false.
      slash = index(line, "/")
      comma = index(line, ",")
      if (slash < 2 .or. comma < slash + 2) return
      is_statement = verify(line(:slash - 1), "ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == 0 .and. &
                     verify(trim(adjustl(line(slash + 1:comma - 1))), "0123456789") == 0
   end function is_statement

   !> A line with blanks for tabs.
   pure function replaced_tabs(line) result(plain)
      character(*), intent(in) :: line      !! any line
      character(len(line)) :: plain         !! without tabs

      integer :: i

      plain = line
      do i = 1, len(line)
         if (line(i:i) == achar(9)) plain(i:i) = " "
      end do
   end function replaced_tabs

   !> Take the comment from a line, and the name that it may hold.
   subroutine take_comment(line, view_name)
      character(:), allocatable, intent(inout) :: line        !! without its comment on return
      character(:), allocatable, intent(inout) :: view_name   !! replaced where the comment holds one

      character(*), parameter :: sign = "adams_view_name="
      character(:), allocatable :: comment, rest
      integer :: at, last

      at = index(line, "!")
      if (at == 0) return
      comment = line(at + 1:)
      rest = trim(line(:at - 1))
      call move_alloc(rest, line)
      at = index(lower(comment), sign)
      if (at == 0) return
      comment = trim(adjustl(comment(at + len(sign):)))
      if (len(comment) < 2) return
      last = index(comment(2:), comment(1:1))
      if (scan(comment(1:1), "'""") == 0 .or. last < 2) return
      view_name = comment(2:last)
   end subroutine take_comment

   !> Begin a statement.
   subroutine begin(now, part, line, view_name)
      type(gathered_t), intent(inout) :: now     !! the statement
      character(*), intent(in) :: part           !! its first line
      integer, intent(in) :: line                !! number of that
      character(*), intent(in) :: view_name      !! its name, or blank

      now%text = trim(adjustl(part))
      now%first = [1]
      now%line = [line]
      now%view_name = view_name
   end subroutine begin

   !> Go on with a statement. Where an expression is open, the comma that begins the line may be no comma of it.
   subroutine go_on(now, rest, line)
      type(gathered_t), intent(inout) :: now     !! the statement
      character(*), intent(in) :: rest           !! the line behind its comma
      integer, intent(in) :: line                !! number of the line

      character(:), allocatable :: text
      character :: next
      integer :: at
      logical :: is_open

      text = trim(now%text)
      next = " "
      if (len_trim(rest) > 0) next = trim(adjustl(rest))
      is_open = depth_of(text) > 0
      at = len(text)
      if (text(at:at) == "\") then      ! the end of an expression, or a line that goes on
         text = trim(text(:at - 1))
         at = len(text)
         if (scan(text(at:at), "+-*/(,:=") == 0 .and. .not. is_open) text = text//","
      else if (scan(text(at:at), "+-*/(,:=") > 0 .and. text(at:at) /= "/") then
         continue
      else if (text(at:at) == "/") then
         if (.not. ends_in_expression(text)) text = text//" "
      else if (ends_in_expression(text) .and. (scan(next, "+*/)^") > 0 .or. (next == "-" .and. .not. is_open))) then
         continue
      else
         text = text//","
      end if
      now%first = [now%first, len(text) + 1]
      now%line = [now%line, line]
      now%text = text//trim(adjustl(rest))
   end subroutine go_on

   !> Parentheses that are open at the end of a text.
   pure integer function depth_of(text)
      character(*), intent(in) :: text  !! any text

      integer :: i

      depth_of = 0
      do i = 1, len(text)
         if (text(i:i) == "(") depth_of = depth_of + 1
         if (text(i:i) == ")") depth_of = depth_of - 1
      end do
   end function depth_of

   !> Whether a text ends within an expression: the last argument that has a value is one.
   pure logical function ends_in_expression(text)
      character(*), intent(in) :: text  !! a statement so far

      integer :: at, first

      at = index(text, "=", back=.true.)
      ends_in_expression = .false.
      if (at < 2) return
      first = scan(text(:at - 1), ",\/", back=.true.) + 1
      ends_in_expression = is_expression_name(upper_case(trim(adjustl(text(first:at - 1)))))
   end function ends_in_expression

   !> Whether an argument is an expression; FUNCTION may be abbreviated.
   pure logical function is_expression_name(name)
      character(*), intent(in) :: name  !! in capitals

      is_expression_name = index(expressions, " "//trim(name)//" ") > 0
      if (len_trim(name) >= 3) is_expression_name = is_expression_name .or. index("FUNCTION", trim(name)) == 1
   end function is_expression_name

   !> A word in capitals.
   pure function upper_case(word) result(capital)
      character(*), intent(in) :: word     !! any word
      character(len(word)) :: capital      !! the same

      integer :: i

      capital = word
      do i = 1, len(word)
         if (word(i:i) >= "a" .and. word(i:i) <= "z") capital(i:i) = achar(iachar(word(i:i)) - 32)
      end do
   end function upper_case

   !> End a statement and put it on the list.
   subroutine finish(now, statements, is_over)
      type(gathered_t), intent(inout) :: now                           !! the statement; empty on return
      type(statement_t), allocatable, intent(inout) :: statements(:)   !! (n) so far
      logical, intent(inout) :: is_over                                !! the dataset ends here

      type(statement_t) :: new
      type(statement_t), allocatable :: more(:)
      character(:), allocatable :: head
      integer :: at, slash, stop

      if (len(now%text) == 0) return
      slash = scan(now%text, "/,= ")
      if (slash == 0) slash = len(now%text) + 1
      new%keyword = upper_case(now%text(:slash - 1))
      new%line = now%line(1)
      new%view_name = now%view_name
      allocate (new%arguments(0))
      is_over = new%keyword == "END"
      at = verify(now%text(slash:), " ") + slash - 1
      if (at < slash) at = len(now%text) + 1
      if (at <= len(now%text)) then
         if (now%text(at:at) == "/") at = at + 1
      end if
      stop = at - 1 + scan(now%text(at:)//",", ",")
      head = trim(adjustl(now%text(at:stop - 1)))
      if (len(head) > 0 .and. len(head) < 10 .and. verify(head, "0123456789") == 0) then
         read (head, *) new%id
         at = stop + 1
      end if
      call cut_arguments(now, at, new%arguments)
      now%text = ""
      if (is_over) return
      allocate (more(size(statements) + 1))
      more(:size(statements)) = statements
      more(size(more)) = new
      call move_alloc(more, statements)
   end subroutine finish

   !> Cut the arguments of a statement.
   subroutine cut_arguments(now, begin, arguments)
      type(gathered_t), intent(in) :: now                             !! the statement
      integer, intent(in) :: begin                                    !! where they begin in its text
      type(argument_t), allocatable, intent(inout) :: arguments(:)    !! (n) appended to

      integer :: at, depth, first, n

      first = begin
      depth = 0
      n = len(now%text)
      do at = begin, n + 1
         if (at <= n) then
            if (now%text(at:at) == "(") depth = depth + 1
            if (now%text(at:at) == ")") depth = depth - 1
            if (depth > 0 .or. scan(now%text(at:at), ",\") == 0) cycle
         end if
         call take_piece(trim(adjustl(now%text(first:at - 1))), line_at(now, first + verify(now%text(first:)//"x", " ") - 1), &
                         arguments)
         first = at + 1
      end do
   end subroutine cut_arguments

   !> The line in which a character of a statement stands.
   pure integer function line_at(now, at)
      type(gathered_t), intent(in) :: now   !! the statement
      integer, intent(in) :: at             !! number of the character

      integer :: k

      line_at = now%line(1)
      do k = 1, size(now%first)
         if (at >= now%first(k)) line_at = now%line(k)
      end do
   end function line_at

   !> What stands between two commas: a new argument, or one more value of the last.
   subroutine take_piece(piece, line, arguments)
      character(*), intent(in) :: piece                               !! without blanks around it
      integer, intent(in) :: line                                     !! where it stands
      type(argument_t), allocatable, intent(inout) :: arguments(:)    !! (n) changed or appended to

      type(argument_t) :: new
      integer :: at

      if (len(piece) == 0) return
      at = index(piece, "=")
      if (at > 0) then
         new%name = upper_case(trim(piece(:at - 1)))
         allocate (new%values(0))
         call append_text(new%values, trim(adjustl(piece(at + 1:))))
      else if (size(arguments) > 0 .and. number_length(piece) > 0) then
         if (size(arguments(size(arguments))%values) > 0) then
            call append_text(arguments(size(arguments))%values, piece)
            return
         end if
         new%name = piece
         allocate (new%values(0))
      else
         new%name = upper_case(piece)
         allocate (new%values(0))
      end if
      new%line = line
      arguments = [arguments, new]
   end subroutine take_piece

   !> The argument of some name; names may be abbreviated, down to some number of letters.
   pure integer function find_argument(statement, name, least) result(k)
      type(statement_t), intent(in) :: statement   !! the statement
      character(*), intent(in) :: name             !! in capitals, in full
      integer, intent(in), optional :: least       !! letters that do for it; left out: all

      integer :: i, n

      n = len(name)
      if (present(least)) n = least
      k = 0
      do i = 1, size(statement%arguments)
         associate (word => statement%arguments(i)%name)
            if (len(word) < n .or. len(word) > len(name)) cycle
            if (index(name, word) == 1 .and. k == 0) k = i
         end associate
      end do
   end function find_argument

   !> Whether a statement has a word.
   pure logical function has_word(statement, name, least)
      type(statement_t), intent(in) :: statement   !! the statement
      character(*), intent(in) :: name             !! in capitals, in full
      integer, intent(in), optional :: least       !! letters that do for it; left out: all

      has_word = find_argument(statement, name, least) > 0
   end function has_word

end module dataset
