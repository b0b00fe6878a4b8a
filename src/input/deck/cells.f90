!> Values of a deck: from the tokens of a cell or of the right-hand side of a setting to a `value_t`.
!>
!> Tables hand over one token and perhaps the unit of the header; settings and defaults hand over all.
module cells
   use cell_checks, only: check_choice, check_count, check_range
   use cell_lists, only: read_options, read_word, read_words
   use conditions, only: read_conditions
   use deck_types, only: deck_t, text_of
   use diagnostics, only: diagnostics_t
   use dimension_text, only: unit_text
   use expression, only: constant_expression, expression_t
   use item, only: value_t
   use kind_info, only: cell_condition, cell_duration, cell_expression, cell_file, cell_flag, cell_formula, cell_list, &
                      & cell_number, cell_reference, cell_vector, cell_word, cell_words, column_t, dim_none, same_dimension
   use kinds, only: wp
   use number_cell, only: read_number
   use number_lists, only: read_list
   use quantities, only: is_unit_word, quantity_t, read_brace, read_unit, report_dimension
   use text, only: to_text
   use tokens, only: span, token_brace, token_t, token_word
   use units, only: unit_t
   implicit none (type, external)
   private
   public :: blank_value, read_value

contains

   !> Make a value that was not given and holds nothing, with all its strings and lists allocated.
   subroutine blank_value(column, value)
      type(column_t), intent(in) :: column  !! what the value belongs to
      type(value_t), intent(out) :: value   !! the empty value

      value%column = column%name
      value%text = ""
      allocate (value%words(0), value%places(0), value%options(0), value%conditions(0))
      if (column%cell == cell_expression) value%expression = constant_expression(0.0_wp, column%dimension)
   end subroutine blank_value

   !> Read one value.
   subroutine read_value(deck, column, place, list, value, mistakes, header)
      type(deck_t), intent(in) :: deck                !! the deck
      type(column_t), intent(in) :: column            !! what the value must be
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(token_t), intent(in) :: list(:)            !! (n) its tokens, at least one
      type(value_t), intent(inout) :: value           !! the value, blank before
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(unit_t), intent(in), optional :: header    !! unit in the header of the table

      character(:), allocatable :: choices
      logical :: has_choices

      value%given = .true.
      value%location = span(list(1), list(size(list)))
      value%text = text_of(deck, list(1))
      if (list(1)%kind == token_brace) value%text = "{"//value%text//"}"
      select case (column%cell)
      case (cell_number)
         call read_number_cell(deck, column, place, list, value, mistakes, header)
      case (cell_expression)
         call read_expression_cell(deck, column, place, list, value, mistakes, header)
      case (cell_vector)
         call read_vector(deck, column, place, list, value, mistakes)
      case (cell_duration)
         call read_duration(deck, column, place, list, value, mistakes)
      case (cell_list)
         call read_list(deck, place, list(1), value, mistakes, header)
         call check_list(column, place, value, mistakes)
      case (cell_formula)
         value%text = text_of(deck, list(1))
         call check_count(list, 1, place, mistakes)
      case (cell_file)
         ! the table reads the file when all its rows are known
         call read_word(deck, place, list(1), value%text, mistakes)
      case (cell_condition)
         call read_conditions(deck, place, list, value, mistakes)
      case (cell_words)
         call read_words(deck, place, list, value, mistakes)
      case (cell_word)
         has_choices = .false.
         if (allocated(column%choices)) has_choices = len_trim(column%choices) > 0
         call read_word(deck, place, list(1), value%text, mistakes, not_empty=has_choices)
         call check_choice(column%choices, place, value%text, list(1)%location, mistakes)
         if (allocated(column%options)) then
            call read_options(deck, column%options, place, list(2:), value, mistakes)
         else
            call check_count(list, 1, place, mistakes)
         end if
      case (cell_reference)
         call read_word(deck, place, list(1), value%text, mistakes, not_empty=.true.)
         call check_count(list, 1, place, mistakes)
      case default
         call read_word(deck, place, list(1), value%text, mistakes, not_empty=.true.)
         choices = "on off"
         call check_choice(choices, place, value%text, list(1)%location, mistakes)
         call check_count(list, 1, place, mistakes)
         value%flag = value%text == "on"
      end select
   end subroutine read_value

   !> A list whose length or dimension its column fixes: of a direction, three numbers, not all of them zero.
   subroutine check_list(column, place, value, mistakes)
      type(column_t), intent(in) :: column            !! what the value must be
      character(*), intent(in) :: place               !! as `in column axis of joint.revolute`
      type(value_t), intent(in) :: value              !! the value
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      if (column%size == 1 .or. .not. allocated(value%places)) return
      if (size(value%table) /= column%size) then
         call mistakes%add(value%location, "wrong number of values "//place, to_text(column%size)//" numbers in quotes "// &
                           "are expected", "as ""0 0 1""")
      else if (.not. same_dimension(value%dimensions(1), column%dimension)) then
         call mistakes%add(value%location, "wrong dimension "//place, "numbers without a unit are expected")
      else if (.not. any(abs(value%table) > 0.0_wp)) then
         call mistakes%add(value%location, "zero vector as a direction "//place, "all numbers are zero")
      end if
   end subroutine check_list

   !> A cell that holds one number.
   subroutine read_number_cell(deck, column, place, list, value, mistakes, header)
      type(deck_t), intent(in) :: deck                !! the deck
      type(column_t), intent(in) :: column            !! what the value must be
      character(*), intent(in) :: place               !! as `in column mass of bodies`
      type(token_t), intent(in) :: list(:)            !! (n) its tokens
      type(value_t), intent(inout) :: value           !! the value
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(unit_t), intent(in), optional :: header    !! unit in the header of the table

      type(quantity_t) :: quantity

      call read_number(deck, list, place, quantity, mistakes, header, column%dimension)
      if (.not. column%is_any) call report_dimension(quantity, column%dimension, value%location, place, mistakes)
      if (.not. quantity%is_good) return
      value%number = quantity%x
      value%dimensions(1) = quantity%dimension
      call check_range(column, quantity%x, unit_text(column%dimension), value%location, place, mistakes)
   end subroutine read_number_cell

   !> A cell that holds a number or an expression in the time.
   subroutine read_expression_cell(deck, column, place, list, value, mistakes, header)
      type(deck_t), intent(in) :: deck                !! the deck
      type(column_t), intent(in) :: column            !! what the value must be
      character(*), intent(in) :: place               !! as `in column angle of driver.angle`
      type(token_t), intent(in) :: list(:)            !! (n) its tokens
      type(value_t), intent(inout) :: value           !! the value
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong
      type(unit_t), intent(in), optional :: header    !! unit in the header of the table

      type(expression_t) :: compiled
      type(quantity_t) :: quantity

      if (list(1)%kind /= token_brace) then
         call read_number_cell(deck, column, place, list, value, mistakes, header)
         value%expression = constant_expression(value%number, column%dimension)
         return
      end if
      call check_count(list, 1, place, mistakes, "the result of an expression in braces has its own unit")
      call read_brace(deck, list(1), place, .true., compiled, quantity, mistakes, column)
      call report_dimension(quantity, column%dimension, value%location, place, mistakes)
      if (.not. quantity%is_good) return
      value%number = quantity%x
      value%expression = compiled
      if (compiled%is_constant) then
         call check_range(column, quantity%x, unit_text(column%dimension), value%location, place, mistakes)
      end if
   end subroutine read_expression_cell

   !> Several numbers with one unit at the end, or each with its own.
   subroutine read_vector(deck, column, place, list, value, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(column_t), intent(in) :: column            !! what the value must be
      character(*), intent(in) :: place               !! as `in key gravity of scene`
      type(token_t), intent(in) :: list(:)            !! (n) its tokens
      type(value_t), intent(inout) :: value           !! the value
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(quantity_t) :: quantity
      type(unit_t) :: unit
      integer :: k, n
      logical :: has_unit, is_good

      n = size(list)
      has_unit = .false.
      if (n > 1 .and. list(n)%kind == token_word) has_unit = is_unit_word(text_of(deck, list(n)))
      if (has_unit) then
         call read_unit(text_of(deck, list(n)), list(n)%location, place, unit, is_good, mistakes, &
                        column%dimension)
         if (.not. is_good) return
         n = n - 1
      end if
      if (n /= column%size .and. .not. (column%size == 3 .and. n == 2)) then
         if (column%size == 3) then
            call mistakes%add(value%location, "wrong number of values "//place, "2 or 3 numbers and one unit are expected")
         else
            call mistakes%add(value%location, "wrong number of values "//place, "2 numbers and one unit are expected")
         end if
         return
      end if
      do k = 1, n
         if (has_unit) then
            call read_number(deck, list(k:k), place, quantity, mistakes, unit)
         else
            call read_number(deck, list(k:k), place, quantity, mistakes, wanted=column%dimension)
         end if
         call report_dimension(quantity, column%dimension, list(k)%location, place, mistakes)
         if (.not. quantity%is_good) cycle
         value%vector%x(k) = quantity%x
         call check_range(column, quantity%x, unit_text(column%dimension), list(k)%location, place, mistakes)
      end do
      value%vector%n = n
   end subroutine read_vector

   !> A time, or a number of turns of a driver.
   subroutine read_duration(deck, column, place, list, value, mistakes)
      type(deck_t), intent(in) :: deck                !! the deck
      type(column_t), intent(in) :: column            !! what the value must be
      character(*), intent(in) :: place               !! as `in key end of analysis.dynamic`
      type(token_t), intent(in) :: list(:)            !! (n) its tokens
      type(value_t), intent(inout) :: value           !! the value; its text is the driver or empty
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(quantity_t) :: quantity
      character(:), allocatable :: second
      logical :: is_turns

      value%text = ""
      second = ""
      if (size(list) > 1) second = text_of(deck, list(2))
      is_turns = second == "turns" .or. second == "turn"
      if (.not. is_turns) then
         call read_number_cell(deck, column, place, list, value, mistakes)
         return
      end if
      second = ""
      if (size(list) == 4) second = text_of(deck, list(3))
      if (second /= "of") then
         call mistakes%add(value%location, "unclear reference of turns "//place, &
                         & "write a time, as 24 ms, or as 2 turns of motor")
         return
      end if
      call read_word(deck, place, list(4), value%text, mistakes)
      call read_number(deck, list(1:1), place, quantity, mistakes)
      call report_dimension(quantity, dim_none, list(1)%location, place, mistakes)
      if (.not. quantity%is_good) return
      value%number = quantity%x
      call check_range(column, quantity%x, "turns", list(1)%location, place, mistakes)
   end subroutine read_duration

end module cells
