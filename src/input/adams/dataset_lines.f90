!> The lines of an Adams dataset put together to statements.
!>
!> `!` starts a comment. A line whose first character is a comma continues with the statement before it, and so does the line behind
!> one that ends in `&`. `;` ends a statement. The comma that starts a line is no comma of an expression where that could not have
!> one. A name that Adams/View writes in a comment before the statement (`adams_view_name='...'`) goes with it.
!>
!> Source: the public descriptions of the statements of Adams/Solver.
module dataset_lines
   use item, only: location_t
   use source_text, only: line_of, n_line_of, source_t
   use text, only: lower, segment
   implicit none (type, external)
   private
   public :: gathered_t, next_statement, reader_t, start_reader, upper_case

   character(*), parameter :: expressions = " FUNCTION FX FY FZ TX TY TZ F1 F2 F3 F4 F5 F6 F7 F8 "  !! arguments that are one

   !> A statement put together from its lines.
   type :: gathered_t
      character(:), allocatable :: text        !! (at least n) without comments and signs of continuation
      integer :: n = 0                         !! characters
      integer, allocatable :: first(:)         !! (at least n_line) where in it a line starts
      integer, allocatable :: line(:)          !! (at least n_line) number of that line
      integer, allocatable :: column(:)        !! (at least n_line) column there of what starts in the text
      integer :: n_line = 0                    !! lines
      character(:), allocatable :: view_name   !! of the comment before it
      integer, private :: depth = 0            !! parentheses that are open at its end
      logical, private :: in_expression = .false.   !! the last argument that has a value is an expression
   contains
      procedure :: place_of
   end type gathered_t

   !> Where reading is.
   type :: reader_t
      integer, private :: line = 0                          !! last line that was taken
      integer, private :: column = 1                        !! where the rest of it starts
      character(:), allocatable, private :: rest            !! of that line, behind a `;`
      character(:), allocatable, private :: view_name       !! name that the next statement has
   end type reader_t

contains

   !> Start to read; the title is the first line, unless that is a statement.
   subroutine start_reader(source, reader, title)
      type(source_t), intent(in) :: source                    !! the dataset
      type(reader_t), intent(out) :: reader                   !! before the first statement
      character(:), allocatable, intent(out) :: title         !! without signs of a comment

      integer :: at

      title = trim(adjustl(line_of(source, 1)))
      reader%line = merge(0, 1, is_statement(title))
      reader%rest = ""
      reader%view_name = ""
      at = verify(title, "! ")
      title = segment(title, merge(at, len(title) + 1, at > 0))
   end subroutine start_reader

   !> The next statement; one without text: there is none.
   subroutine next_statement(source, reader, now)
      type(source_t), intent(in) :: source                    !! the dataset
      type(reader_t), intent(inout) :: reader                 !! moved behind the statement
      type(gathered_t), intent(out) :: now                    !! the statement

      character(:), allocatable :: line
      logical :: is_open, was_open
      integer :: behind

      now%text = repeat(" ", 256)
      now%view_name = ""
      is_open = .false.
      do while (len(reader%rest) > 0 .or. reader%line < n_line_of(source))
         if (len(reader%rest) > 0) then
            call move_alloc(reader%rest, line)
         else
            reader%line = reader%line + 1
            line = replaced_tabs(line_of(source, reader%line))
            reader%column = verify(line//"x", " ")
            line = trim(adjustl(line))
            call take_comment(line, reader%view_name)
         end if
         reader%rest = ""
         if (len(line) == 0) cycle
         was_open = is_open
         is_open = line(len(line):) == "&"
         if (is_open) line = trim(line(:len(line) - 1))
         if (len(line) == 0) cycle
         if (now%n == 0) then
            now%view_name = reader%view_name
            reader%view_name = ""
         else if (line(1:1) /= "," .and. .not. was_open) then
            reader%rest = line              ! of the next statement
            if (is_open) reader%rest = line//" &"
            return
         end if
         call split_at_end(line, reader%rest, behind)
         call add_line(now, line, reader%line, reader%column)
         reader%column = reader%column + behind
         if (len(reader%rest) == 0) cycle
         if (is_open) reader%rest = reader%rest//" &"
         return
      end do
   end subroutine next_statement

   !> Cut a line at the first `;` that a statement, or nothing, stands behind.
   subroutine split_at_end(line, rest, behind)
      character(:), allocatable, intent(inout) :: line        !! cut
      character(:), allocatable, intent(out) :: rest          !! what stands behind
      integer, intent(out) :: behind                          !! characters of the line before that

      character(:), allocatable :: first
      integer :: at, from

      rest = ""
      behind = 0
      at = 0
      do
         from = at + 1
         at = index(line(from:), ";") + from - 1
         if (at < from) return
         if (begins_statement(line(at + 1:))) exit
      end do
      rest = trim(adjustl(line(at + 1:)))
      behind = at + verify(line(at + 1:)//"x", " ") - 1
      first = trim(line(:at - 1))
      call move_alloc(first, line)
   end subroutine split_at_end

   !> Whether a text starts with a word and a slash, is `END`, or blank.
   pure logical function begins_statement(text)
      character(*), intent(in) :: text  !! any text

      integer :: behind, first

      first = verify(text, " ")
      begins_statement = first == 0
      if (begins_statement) return
      behind = first - 1 + verify(text(first:)//";", "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_")
      if (behind == first) return
      begins_statement = upper_case(text(first:behind - 1)) == "END"
      if (behind > len(text)) return
      begins_statement = begins_statement .or. text(behind:behind) == "/"
   end function begins_statement

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

   !> Add a line to a statement.
   subroutine add_line(now, line, number, column)
      type(gathered_t), intent(inout) :: now     !! the statement
      character(*), intent(in) :: line           !! without comment, and blanks around it
      integer, intent(in) :: number              !! of the line
      integer, intent(in) :: column              !! where it starts there

      character(:), allocatable :: part
      integer, allocatable :: more(:)
      integer :: from

      if (.not. allocated(now%first)) allocate (now%first(4), now%line(4), now%column(4))
      if (now%n_line == size(now%first)) then
         allocate (more(2*now%n_line))
         more(:now%n_line) = now%first
         call move_alloc(more, now%first)
         allocate (more(2*now%n_line))
         more(:now%n_line) = now%line
         call move_alloc(more, now%line)
         allocate (more(2*now%n_line))
         more(:now%n_line) = now%column
         call move_alloc(more, now%column)
      end if
      part = line
      from = column
      if (now%n_line > 0) then
         if (line(1:1) == ",") then
            part = trim(adjustl(line(2:)))
            from = column + verify(line(2:)//"x", " ")
            call join(now, part)
         else
            call append(now, " ")
         end if
      end if
      now%n_line = now%n_line + 1
      now%first(now%n_line) = now%n + 1
      now%line(now%n_line) = number
      now%column(now%n_line) = from
      call append(now, part)
      now%depth = now%depth + depth_of(part)
      if (index(part, "=") > 0) now%in_expression = ends_in_expression(now%text(:now%n))
   end subroutine add_line

   !> Put characters at the end of a statement, whose room grows by doubling.
   subroutine append(now, part)
      type(gathered_t), intent(inout) :: now     !! the statement
      character(*), intent(in) :: part           !! what comes next

      character(:), allocatable :: more

      if (now%n + len(part) > len(now%text)) then
         more = now%text(:now%n)//repeat(" ", now%n + 2*len(part))
         call move_alloc(more, now%text)
      end if
      now%text(now%n + 1:now%n + len(part)) = part
      now%n = now%n + len(part)
   end subroutine append

   !> What stands between two lines: a comma, unless the first ends in a sign, or in an expression that continues with one.
   subroutine join(now, next)
      type(gathered_t), intent(inout) :: now     !! the statement
      character(*), intent(in) :: next           !! the line behind its comma

      character(*), parameter :: signs = "+-*/(,:="
      character :: first, last

      first = " "
      if (len(next) > 0) first = next
      last = now%text(now%n:now%n)
      if (last == "\") then      ! the end of an expression, or a line that continues
         now%n = len_trim(now%text(:now%n - 1))
         if (now%n == 0 .or. now%depth > 0) return
         if (scan(now%text(now%n:now%n), signs) == 0) call append(now, ",")
      else if (last == "/") then
         if (.not. now%in_expression) call append(now, " ")
      else if (scan(last, signs) > 0) then
         continue
      else if (now%in_expression .and. (scan(first, "+*/)^") > 0 .or. (first == "-" .and. now%depth <= 0))) then
         continue
      else
         call append(now, ",")
      end if
   end subroutine join

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

   !> Where a word of a statement stands in the dataset.
   pure type(location_t) function place_of(self, at, length) result(place)
      class(gathered_t), intent(in) :: self   !! the statement
      integer, intent(in) :: at               !! number of its first character
      integer, intent(in) :: length           !! characters

      integer :: column, high, low, middle

      low = 1
      high = self%n_line + 1
      do while (high - low > 1)
         middle = (low + high)/2
         if (self%first(middle) <= at) then
            low = middle
         else
            high = middle
         end if
      end do
      column = self%column(low) + at - self%first(low)
      place = location_t(1, self%line(low), column, column + max(length, 1) - 1)
   end function place_of

end module dataset_lines
