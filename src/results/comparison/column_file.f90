!> Columns of numbers that another program wrote.
!>
!> Numbers stand apart by commas, semicolons, tabs or blanks; `#`, `!` and `%` start a comment, in which names may stand; those of
!> the first line, as in the program's own files, count before others. A row is a line of at least two numbers and nothing else.
!> What stands before the first row with as many words as there are columns names them; a name may end with its unit in brackets
!> or parentheses: `x [mm]`, `"TIME (sec)"`. Other lines are titles. A title between rows, or a time that steps back, starts
!> another table, as in the request tables of Adams; a page that repeats its titles and continues in time does not. `D` in a number
!> is `E`. Where semicolons or tabs part the numbers of a line, a comma is a decimal point. What is not there between two such signs
!> is NaN.
!>
!> Limits: one file of at most 64 MB.
module column_file
   use kinds, only: not_a_number, wp
   use name_table, only: name_table_t
   use numbers, only: number_length, read_number
   use source_text, only: line_of, n_line_of, source_t
   use text, only: lower, replace, text_t, to_text
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: column_table_t, find_column_of, read_columns, unit_in_name

   !> A table of a file.
   type :: column_table_t
      type(text_t), allocatable :: names(:)     !! (columns) as written; none: the file does not name them
      real(wp), allocatable :: x(:, :)          !! (columns, rows) the numbers [any]
      integer :: line = 0                       !! where its first row stands
      type(name_table_t) :: by_name             !! number of the first column of a name
      type(name_table_t) :: by_bare_name        !! the same, without its unit and in small letters
   end type column_table_t

contains

   !> Read all tables of a file.
   subroutine read_columns(source, tables)
      type(source_t), intent(in) :: source                             !! the file
      type(column_table_t), allocatable, intent(out) :: tables(:)      !! (n) its tables

      type(text_t), allocatable :: heading(:), names(:), pending(:), words(:)
      real(wp), allocatable :: row(:), rows(:, :), larger(:, :)
      logical :: has_title, is_row
      integer :: first_line, k, n, n_column, n_left_out

      allocate (heading(0), tables(0), pending(0))
      n = 0
      n_column = 0
      has_title = .false.
      do k = 1, n_line_of(source)
         call split_line(line_of(source, k), words, n_left_out)
         if (size(words) == 0) cycle
         call numbers_of(words, row, is_row)
         if (.not. is_row) then
            has_title = n > 0
            if (k == 1) heading = words
            pending = words
            cycle
         end if
         if (n > 0 .and. size(row) < n_column .and. size(row) + n_left_out >= n_column) then
            row = [row, spread(not_a_number(), 1, n_column - size(row))]
         end if
         if (n > 0) then
            if (size(row) /= n_column .or. (row(1) < rows(1, n) .and. n_column > 0) .or. (has_title .and. row(1) <= rows(1, &
                  n))) then
               call close_table()
            end if
         end if
         if (n == 0) then
            n_column = size(row)
            first_line = k
            if (allocated(names)) deallocate (names)
            if (allocated(rows)) deallocate (rows)
            allocate (names(0))
            if (size(pending) == n_column) names = pending
            if (size(heading) == n_column) names = heading
            allocate (rows(n_column, 256))
         end if
         if (n == size(rows, 2)) then
            allocate (larger(n_column, 2*n))
            larger(:, :n) = rows
            call move_alloc(larger, rows)
         end if
         n = n + 1
         rows(:, n) = row
         has_title = .false.
      end do
      if (n > 0) call close_table()

   contains

      !> Put the rows so far on the list.
      subroutine close_table()
         type(column_table_t) :: new
         integer :: c, previous

         new%names = names
         call new%by_name%start(size(names))
         call new%by_bare_name%start(size(names))
         do c = 1, size(names)
            call new%by_name%enter(names(c)%s, c, previous)
            call new%by_bare_name%enter(lower(bare_name(names(c)%s)), c, previous)
         end do
         new%x = rows(:, :n)
         new%line = first_line
         tables = [tables, new]
         n = 0
      end subroutine close_table

   end subroutine read_columns

   !> The words of a line, without its comment; words in quotes are one.
   subroutine split_line(line, words, n_left_out)
      character(*), intent(in) :: line                         !! any line
      type(text_t), allocatable, intent(out) :: words(:)       !! (n) its words
      integer, intent(out) :: n_left_out                       !! words that are missing at its end

      type(text_list_t) :: found
      character(:), allocatable :: signs, word
      character :: quote
      integer :: first, i, n
      logical :: by_comma

      n_left_out = 0
      signs = ",;"//achar(9)
      if (scan(line, ";"//achar(9)) > 0) signs = ";"//achar(9)   ! a comma is a decimal point
      by_comma = scan(line, signs) > 0
      first = verify(line, " "//achar(9))
      words = found%get()
      if (first == 0) return
      if (scan(line(first:first), "#!%") > 0) then      ! names may stand in a comment
         first = first + 1
         by_comma = scan(line(first:), signs) > 0
      end if
      allocate (character(len(line)) :: word)
      n = 0
      quote = " "
      do i = first, len(line) + 1
         if (i <= len(line)) then
            if (quote /= " ") then
               if (line(i:i) == quote) then
                  quote = " "
               else
                  call add(line(i:i))
               end if
               cycle
            else if (scan(line(i:i), """'") > 0) then
               quote = line(i:i)
               cycle
            else if (scan(line(i:i), "#!") > 0) then
               exit
            else if (scan(line(i:i), signs) == 0 .and. (by_comma .or. line(i:i) /= " ")) then
               if (line(i:i) /= achar(13)) call add(line(i:i))
               cycle
            end if
         end if
         if (by_comma .or. len_trim(word(:n)) > 0) call found%add(trim(adjustl(word(:n))))
         n = 0
      end do
      if (len_trim(word(:n)) > 0) call found%add(trim(adjustl(word(:n))))
      words = found%get()
      call leave_out_blank()
      if (.not. by_comma) call join_units(words)

   contains

      !> Omit words that are blank at the end, as behind a comma there.
      subroutine leave_out_blank()
         do i = size(words), 1, -1
            if (words(i)%s /= "") exit
            n_left_out = n_left_out + 1
         end do
         if (n_left_out > 0) words = words(:size(words) - n_left_out)
      end subroutine leave_out_blank

      !> Add a character to the word.
      subroutine add(c)
         character, intent(in) :: c   !! the character

         n = n + 1
         word(n:n) = c
      end subroutine add

   end subroutine split_line

   !> Units that stand apart from their names by a blank go with them: `time (s)`.
   subroutine join_units(words)
      type(text_t), allocatable, intent(inout) :: words(:)     !! (n) words of a line

      type(text_t), allocatable :: joined(:)
      integer :: k, n

      n = 0
      allocate (joined(size(words)))
      do k = 1, size(words)
         if (n > 0 .and. scan(words(k)%s(1:1), "[(") > 0 .and. number_length(words(k)%s) == 0) then
            joined(n)%s = joined(n)%s//" "//words(k)%s
         else
            n = n + 1
            call move_alloc(words(k)%s, joined(n)%s)
         end if
      end do
      words = joined(:n)
   end subroutine join_units

   !> The numbers of a line, if it has nothing but at least two of them.
   subroutine numbers_of(words, row, is_row)
      type(text_t), intent(in) :: words(:)                !! (n) its words
      real(wp), allocatable, intent(out) :: row(:)        !! (n) the numbers; NaN where the file says so [any]
      logical, intent(out) :: is_row                      !! whether they are

      character(:), allocatable :: word
      integer :: k

      is_row = size(words) >= 2
      allocate (row(size(words)), source=0.0_wp)
      do k = 1, size(words)
         if (.not. is_row) return
         word = replace(words(k)%s, ",", ".")
         is_row = number_length(word) == len(word) .and. len(word) > 0
         if (is_row) call read_number(word, 0, row(k), is_row)
         if (.not. is_row .and. (index(" nan -nan ", " "//lower(word)//" ") > 0 .or. len(word) == 0)) then
            is_row = k > 1
            row(k) = not_a_number()
         end if
      end do
   end subroutine numbers_of

   !> The number of a column by its name or number; 0: there is none. A name may omit its unit.
   pure integer function find_column_of(table, word) result(k)
      type(column_table_t), intent(in) :: table   !! the table
      character(*), intent(in) :: word            !! as the user writes it

      integer :: status

      k = table%by_name%find(word)
      if (k == 0) k = table%by_bare_name%find(lower(word))
      if (k > 0) return
      if (len(word) == 0 .or. len(word) > 6 .or. verify(word, "0123456789") > 0) return
      read (word, *, iostat=status) k
      if (status /= 0 .or. k > size(table%x, 1)) k = 0
   end function find_column_of

   !> A name without its unit.
   pure function bare_name(name) result(bare)
      character(*), intent(in) :: name        !! as written
      character(:), allocatable :: bare       !! before the bracket

      integer :: at

      at = scan(name, "[(")
      bare = name
      if (at > 1) bare = trim(name(:at - 1))
   end function bare_name

   !> The unit that stands in a name; blank: none.
   pure function unit_in_name(name) result(unit)
      character(*), intent(in) :: name        !! as written
      character(:), allocatable :: unit       !! between brackets or parentheses

      integer :: first, last

      unit = ""
      first = scan(name, "[(", back=.true.)
      last = len_trim(name)
      if (first == 0 .or. last < first + 2) return
      if (scan(name(last:last), "])") == 0) return
      unit = trim(adjustl(name(first + 1:last - 1)))
      select case (lower(unit))     ! as other programs write them
      case ("sec", "second", "seconds"); unit = "s"
      case ("newton", "newtons"); unit = "N"
      case ("meter", "meters", "metre"); unit = "m"
      case ("millimeter", "millimeters"); unit = "mm"
      case ("degrees", "degree"); unit = "deg"
      case ("radians", "radian"); unit = "rad"
      case ("no_units", "-"); unit = "1"
      end select
   end function unit_in_name

end module column_file
