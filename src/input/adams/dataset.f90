!> The text of an Adams dataset cut into statements.
!>
!> The first line is the title, `END` the end. A statement is a name, a slash, a number (most of them), and arguments: words,
!> `NAME = value, value ...`, or `NAME = expression`. A backslash ends an expression that is not the last argument. How lines
!> continue is for `dataset_lines` to say.
!>
!> Source: the public descriptions of the statements of Adams/Solver. Limits: no nested datasets, no commands.
module dataset
   use dataset_lines, only: gathered_t, next_statement, reader_t, start_reader, upper_case
   use item, only: location_t
   use numbers, only: number_length
   use source_text, only: source_t
   use text, only: text_t, to_text
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: argument_t, expression_of, find_argument, has_word, line_words, read_statements, statement_t, upper_case

   !> An argument: a word, or a name with its values.
   type :: argument_t
      character(:), allocatable :: name        !! in capitals, as written
      type(text_t), allocatable :: values(:)   !! (n) what stands behind the equals sign; none: a word
      type(location_t) :: at                   !! where its name stands
   end type argument_t

   !> A statement.
   type :: statement_t
      character(:), allocatable :: keyword          !! in capitals, as written
      integer :: id = -1                            !! its number; -1: it has none
      logical :: has_slash = .false.                !! a slash is behind its name, as statements have it
      type(argument_t), allocatable :: arguments(:) !! (n) in the order of the text
      character(:), allocatable :: view_name        !! name from the comment before it; blank: none
      logical :: is_used = .false.                  !! another statement takes it into the deck
      type(location_t) :: at                        !! where its name stands
   end type statement_t

   !> Arguments while they are cut.
   type :: cutting_t
      type(argument_t), allocatable :: arguments(:) !! (at least n)
      integer :: n = 0                              !! arguments
      type(text_list_t) :: values                   !! of the last one
   end type cutting_t

contains

   !> Cut a text into statements.
   subroutine read_statements(source, title, statements)
      type(source_t), intent(in) :: source                            !! the dataset
      character(:), allocatable, intent(out) :: title                 !! its first line
      type(statement_t), allocatable, intent(out) :: statements(:)    !! (n) all others, up to END

      type(gathered_t) :: now
      type(reader_t) :: reader
      type(statement_t), allocatable :: more(:)
      integer :: n

      call start_reader(source, reader, title)
      allocate (statements(64))
      n = 0
      do
         call next_statement(source, reader, now)
         if (now%n == 0) exit
         if (n == size(statements)) then
            allocate (more(2*n))
            more(:n) = statements
            call move_alloc(more, statements)
         end if
         call cut_statement(now, statements(n + 1))
         if (statements(n + 1)%keyword == "END") exit
         n = n + 1
      end do
      statements = statements(:n)
   end subroutine read_statements

   !> Cut a statement.
   subroutine cut_statement(now, statement)
      type(gathered_t), intent(in) :: now              !! its text
      type(statement_t), intent(out) :: statement      !! its name, number and arguments

      character(:), allocatable :: head
      integer :: at, slash, stop

      slash = scan(now%text(:now%n), "/,= ")
      if (slash == 0) slash = now%n + 1
      statement%keyword = upper_case(now%text(:slash - 1))
      statement%at = now%place_of(1, len(statement%keyword))
      statement%view_name = now%view_name
      at = verify(now%text(slash:now%n), " ") + slash - 1
      if (at < slash) at = now%n + 1
      if (at <= now%n) then
         statement%has_slash = now%text(at:at) == "/"
         if (statement%has_slash) at = at + 1
      end if
      stop = at - 1 + scan(now%text(at:now%n)//",", ",")
      head = trim(adjustl(now%text(at:stop - 1)))
      if (len(head) > 0 .and. len(head) < 10 .and. verify(head, "0123456789") == 0) then
         read (head, *) statement%id
         at = stop + 1
      end if
      call cut_arguments(now, at, statement%arguments)
   end subroutine cut_statement

   !> Cut the arguments of a statement.
   subroutine cut_arguments(now, begin, arguments)
      type(gathered_t), intent(in) :: now                             !! the statement
      integer, intent(in) :: begin                                    !! where they start in its text
      type(argument_t), allocatable, intent(out) :: arguments(:)      !! (n) the arguments

      type(cutting_t) :: cutting
      integer :: at, depth, first, head, n

      allocate (cutting%arguments(8))
      first = begin
      depth = 0
      n = now%n
      do at = begin, n + 1
         if (at <= n) then
            if (now%text(at:at) == "(") depth = depth + 1
            if (now%text(at:at) == ")") depth = depth - 1
            if (depth > 0 .or. scan(now%text(at:at), ",\") == 0) cycle
         end if
         head = min(first + verify(now%text(first:at - 1)//"x", " ") - 1, n)
         call take_segment(trim(adjustl(now%text(first:at - 1))), now, head, cutting)
         first = at + 1
      end do
      call end_argument(cutting)
      arguments = cutting%arguments(:cutting%n)
   end subroutine cut_arguments

   !> What stands between two commas: a new argument, or one more value of the last.
   subroutine take_segment(segment, now, place, cutting)
      character(*), intent(in) :: segment              !! without blanks around it
      type(gathered_t), intent(in) :: now            !! the statement
      integer, intent(in) :: place                   !! where it starts in its text
      type(cutting_t), intent(inout) :: cutting      !! changed or appended to

      integer :: at

      if (len(segment) == 0) return
      at = index(segment, "=")
      if (at > 0) then
         call begin_argument(cutting, upper_case(trim(segment(:at - 1))), now, place)
         call cutting%values%add(trim(adjustl(segment(at + 1:))))
      else if (number_length(segment) == 0) then
         call begin_argument(cutting, upper_case(segment), now, place)
      else if (cutting%values%n > 0) then
         call cutting%values%add(segment)
      else
         call begin_argument(cutting, segment, now, place)
      end if
   end subroutine take_segment

   !> Start an argument.
   subroutine begin_argument(cutting, name, now, place)
      type(cutting_t), intent(inout) :: cutting      !! one more
      character(*), intent(in) :: name               !! of the argument
      type(gathered_t), intent(in) :: now            !! the statement
      integer, intent(in) :: place                   !! where the name starts in its text

      type(argument_t), allocatable :: more(:)

      call end_argument(cutting)
      if (cutting%n == size(cutting%arguments)) then
         allocate (more(2*cutting%n))
         more(:cutting%n) = cutting%arguments
         call move_alloc(more, cutting%arguments)
      end if
      cutting%n = cutting%n + 1
      cutting%arguments(cutting%n)%name = name
      cutting%arguments(cutting%n)%at = now%place_of(place, len(name))
   end subroutine begin_argument

   !> Give the last argument its values.
   subroutine end_argument(cutting)
      type(cutting_t), intent(inout) :: cutting      !! the last one is complete on return

      if (cutting%n > 0) cutting%arguments(cutting%n)%values = cutting%values%get()
      cutting%values = text_list_t()
   end subroutine end_argument

   !> The argument of some name; names may be abbreviated, down to some number of letters.
   pure integer function find_argument(statement, name, minimum) result(k)
      type(statement_t), intent(in) :: statement   !! the statement
      character(*), intent(in) :: name             !! in capitals, in full
      integer, intent(in), optional :: minimum       !! letters that do for it; omitted: all

      integer :: i, n

      n = len(name)
      if (present(minimum)) n = minimum
      k = 0
      do i = 1, size(statement%arguments)
         associate (word => statement%arguments(i)%name)
            if (len(word) < n .or. len(word) > len(name)) cycle
            if (index(name, word) == 1 .and. k == 0) k = i
         end associate
      end do
   end function find_argument

   !> The expression of an argument; blank: there is no such argument, or nothing behind it.
   pure function expression_of(statement, name, minimum) result(text)
      type(statement_t), intent(in) :: statement   !! the statement
      character(*), intent(in) :: name             !! in capitals, in full
      integer, intent(in), optional :: minimum       !! letters that do for it; omitted: all
      character(:), allocatable :: text            !! as written

      integer :: k

      text = ""
      k = find_argument(statement, name, minimum)
      if (k == 0) return
      if (size(statement%arguments(k)%values) > 0) text = statement%arguments(k)%values(1)%s
   end function expression_of

   !> Whether a statement has a word.
   pure logical function has_word(statement, name, minimum)
      type(statement_t), intent(in) :: statement   !! the statement
      character(*), intent(in) :: name             !! in capitals, in full
      integer, intent(in), optional :: minimum       !! letters that do for it; omitted: all

      has_word = find_argument(statement, name, minimum) > 0
   end function has_word

   !> The start of what is said of a place.
   pure function line_words(at) result(words)
      type(location_t), intent(in) :: at        !! the place
      character(:), allocatable :: words        !! line and column, and a colon

      words = "line "//to_text(at%line)//", column "//to_text(at%first)//": "
   end function line_words

end module dataset
