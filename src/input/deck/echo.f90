!> A deck written back: in SI, with every default, so that it reads to exactly the same values.
!>
!> Numbers are written with as many digits as needed. Expressions in the time keep their braces, with the
!> values of parameters put in; so the parameters themselves may be omitted, or written for the record.
module echo
   use deck_file, only: deck_version
   use deck_types, only: deck_t
   use dimension_text, only: unit_text
   use item, only: item_t, value_t
   use kind_info, only: cell_condition, cell_duration, cell_expression, cell_flag, cell_formula, cell_list, cell_number, &
                      & cell_vector, cell_words, column_t, dim_none, dim_t, kind_info_t, same_dimension
   use text, only: exact_text, replace, text_t
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: all_defaults, echo_items, echo_settings, echo_start, get_parameters, item_words

contains

   !> The first lines of an echo: version and parameters.
   function echo_start(deck) result(s)
      type(deck_t), intent(in) :: deck  !! the deck
      character(:), allocatable :: s    !! lines with their ends

      type(buffer_t) :: buffer
      integer :: k

      call buffer%line("deck = "//deck_version)
      if (deck%symbols%n_parameter > 0) then
         call buffer%line("")
         call buffer%line("[parameters]")
         do k = 1, deck%symbols%n_parameter
            call buffer%line(deck%symbols%list(k)%name//" = "//deck%parameter_text(k)%s)
         end do
      end if
      s = buffer%get()
   end function echo_start

   !> A table as a section of a deck.
   function echo_items(info, items) result(s)
      type(kind_info_t), intent(in) :: info  !! the kind
      type(item_t), intent(in) :: items(:)   !! (n) its items
      character(:), allocatable :: s         !! lines with their ends

      type(buffer_t) :: buffer
      type(text_t), allocatable :: cells(:, :)
      integer, allocatable :: width(:)
      integer :: i, k, n_column
      logical, allocatable :: is_shown(:)

      n_column = 0
      if (allocated(info%columns)) n_column = size(info%columns)
      allocate (cells(0:size(items), 0:n_column), width(0:n_column), is_shown(0:n_column))
      is_shown = .true.
      do k = 0, n_column
         call fill_column(info, items, k, cells(:, k), is_shown(k))
         width(k) = 0
         do i = 0, size(items)
            width(k) = max(width(k), len(cells(i, k)%s))
         end do
      end do
      call buffer%line("["//info%name//"]")
      do i = 0, size(items)
         do k = 0, n_column
            if (.not. is_shown(k)) cycle
            if (k > 0) call buffer%add("  ")
            call buffer%add(cells(i, k)%s)
            if (any(is_shown(k + 1:))) call buffer%add(repeat(" ", width(k) - len(cells(i, k)%s)))
         end do
         call buffer%line("")
      end do
      s = buffer%get()
   end function echo_items

   !> The cells of one column, its head first.
   subroutine fill_column(info, items, k, cells, is_shown)
      type(kind_info_t), intent(in) :: info     !! the kind
      type(item_t), intent(in) :: items(:)      !! (n) its items
      integer, intent(in) :: k                  !! number of the column, 0: the name
      type(text_t), intent(inout) :: cells(0:)  !! (0:n) the cells
      logical, intent(out) :: is_shown          !! .false.: no item has a value

      integer :: i

      is_shown = .true.
      if (k == 0) then
         cells(0)%s = "name"
         do i = 1, size(items)
            cells(i)%s = items(i)%name
         end do
         return
      end if
      cells(0)%s = info%columns(k)%name
      if (has_unit(info%columns(k))) cells(0)%s = cells(0)%s//"["//unit_text(info%columns(k)%dimension)//"]"
      is_shown = size(items) == 0
      do i = 1, size(items)
         cells(i)%s = "-"
         if (is_empty(info%columns(k), items(i)%values(k))) cycle
         cells(i)%s = value_text(info%columns(k), items(i)%values(k))
         is_shown = .true.
      end do
   end subroutine fill_column

   !> A section of settings.
   function echo_settings(info, item) result(s)
      type(kind_info_t), intent(in) :: info  !! the kind
      type(item_t), intent(in) :: item       !! its values
      character(:), allocatable :: s         !! lines with their ends

      type(buffer_t) :: buffer
      integer :: k, width

      call buffer%line("["//info%name//"]")
      width = 0
      do k = 1, size(item%values)
         width = max(width, len(info%columns(k)%name))
      end do
      do k = 1, size(item%values)
         if (is_empty(info%columns(k), item%values(k))) cycle
         call buffer%add(info%columns(k)%name//repeat(" ", width - len(info%columns(k)%name))//" = ")
         call buffer%add(value_text(info%columns(k), item%values(k)))
         if (has_unit(info%columns(k)) .and. .not. has_own_unit(info%columns(k), item%values(k))) then
            call buffer%add(" "//unit_text(info%columns(k)%dimension))
         end if
         call buffer%line("")
      end do
      s = buffer%get()
   end function echo_settings

   !> The values of a row as text, as `coefficient 0.1, speed 0.01 m/s`.
   function item_words(info, item) result(words)
      type(kind_info_t), intent(in) :: info   !! the kind
      type(item_t), intent(in) :: item        !! its row
      character(:), allocatable :: words      !! columns, values and units; what is left open is not reported

      integer :: k

      words = ""
      do k = 1, size(item%values)
         associate (column => info%columns(k), value => item%values(k))
            if (is_empty(column, value)) cycle
            if (len(words) > 0) words = words//", "
            words = words//column%name//" "//value_text(column, value)
            if (has_unit(column) .and. .not. has_own_unit(column, value)) words = words//" "//unit_text(column%dimension)
         end associate
      end do
   end function item_words

   !> Whether a column has a unit.
   pure logical function has_unit(column)
      type(column_t), intent(in) :: column  !! the column

      select case (column%cell)
      case (cell_number, cell_expression, cell_vector, cell_duration)
         has_unit = .not. column%is_any .and. .not. same_dimension(column%dimension, dim_none)
      case default
         has_unit = .false.
      end select
   end function has_unit

   !> Whether the text of a value says its dimension: an expression in the time, or turns.
   pure logical function has_own_unit(column, value)
      type(column_t), intent(in) :: column  !! the column
      type(value_t), intent(in) :: value    !! its value

      has_own_unit = .false.
      if (column%cell == cell_expression) has_own_unit = .not. value%expression%is_constant
      if (column%cell == cell_duration) has_own_unit = len(value%text) > 0
   end function has_own_unit

   !> Whether there is nothing to write: no value, and a default that is blank, that only the reader knows the unit of, or that
   !> means something else where it is given.
   pure logical function is_empty(column, value)
      type(column_t), intent(in) :: column  !! the column
      type(value_t), intent(in) :: value    !! its value

      is_empty = .false.
      if (value%given .or. .not. allocated(column%default)) return
      is_empty = len_trim(column%default) == 0 .or. column%is_free .or. column%is_any
   end function is_empty

   !> A value as text, without the unit of bare numbers.
   function value_text(column, value) result(s)
      type(column_t), intent(in) :: column  !! the column
      type(value_t), intent(in) :: value    !! its value
      character(:), allocatable :: s        !! as the deck reads it

      type(buffer_t) :: many
      integer :: i

      select case (column%cell)
      case (cell_number)
         s = exact_text(value%number)
         if (column%is_any) s = s//glued_unit(value%dimensions(1))
      case (cell_list)
         do i = 1, size(value%table, 1)
            call many%add(exact_text(value%table(i, 1))//" ")
         end do
         call many%add(glued_unit(value%dimensions(1)))
         s = quoted(trim(many%get()))
      case (cell_expression)
         s = exact_text(value%number)
         if (.not. value%expression%is_constant) s = "{"//value%expression%source//"}"
      case (cell_formula)
         s = "{"//value%text//"}"
      case (cell_vector)
         s = exact_text(value%vector%x(1))
         do i = 2, value%vector%n
            s = s//" "//exact_text(value%vector%x(i))
         end do
      case (cell_duration)
         s = exact_text(value%number)
         if (len(value%text) > 0) s = s//" turns of "//value%text
      case (cell_flag)
         s = "off"
         if (value%flag) s = "on"
      case (cell_condition)
         do i = 1, size(value%conditions)
            associate (condition => value%conditions(i))
               if (i > 1) call many%add(" or ")
               call many%add(quoted(condition%channel)//merge(" > ", " < ", condition%is_above)//exact_text(condition%limit)// &
                             glued_unit(condition%dimension))
            end associate
         end do
         s = many%get()
      case (cell_words)
         do i = 1, size(value%words)
            if (i > 1) call many%add(" ")
            call many%add(quoted(value%words(i)%s))
         end do
         s = many%get()
      case default
         call many%add(quoted(value%text))
         do i = 1, size(value%options)
            call many%add(" "//value%options(i)%name//"="//quoted(value%options(i)%text))
         end do
         s = many%get()
      end select
   end function value_text

   !> The SI unit of a dimension, empty for none.
   pure function glued_unit(dimension) result(s)
      type(dim_t), intent(in) :: dimension  !! exponents
      character(:), allocatable :: s        !! the unit

      s = ""
      if (.not. same_dimension(dimension, dim_none)) s = unit_text(dimension)
   end function glued_unit

   !> A word as the deck reads it, in quotes if it needs them.
   pure function quoted(word) result(s)
      character(*), intent(in) :: word  !! any text
      character(:), allocatable :: s    !! the word, or quoted text

      if (len(word) > 0 .and. scan(word, " #{}=[]""\"//achar(9)//achar(10)) == 0 .and. word /= "-") then
         s = word
         return
      end if
      s = replace(word, "\", "\\")
      s = replace(s, """", "\""")
      s = """"//replace(s, new_line("a"), "\n")//""""
   end function quoted

   !> All defaults that were taken, as lines `kind item key = default`.
   function all_defaults(deck) result(lines)
      type(deck_t), intent(in) :: deck       !! the deck, after items and settings were read
      type(text_t), allocatable :: lines(:)  !! (n) in the order of reading

      lines = deck%defaults%get()
   end function all_defaults

   !> The parameters as they were used.
   subroutine get_parameters(deck, names, values)
      type(deck_t), intent(in) :: deck                      !! the deck
      type(text_t), allocatable, intent(out) :: names(:)    !! (n) names
      type(text_t), allocatable, intent(out) :: values(:)   !! (n) values as in the deck or on the command line

      integer :: k

      allocate (names(deck%symbols%n_parameter), values(deck%symbols%n_parameter))
      do k = 1, size(names)
         names(k)%s = deck%symbols%list(k)%name
         values(k)%s = deck%parameter_text(k)%s
      end do
   end subroutine get_parameters

end module echo
