!> The words of a figure of curves, taken apart.
!>
!> `A + B in UNIT from X to Y against C in UNIT from X to Y`, or `panels(A + B in UNIT, C) against D`: channels in one picture or in
!> panels one above the other, units and ends of the axes, and a channel instead of the time on the abscissa. Whether these channels
!> exist and the units fit is for `curve_words`.
module figure_phrase
   use figure_list, only: panels_word
   use kinds, only: wp
   use numbers, only: number_length, read_number
   use text, only: append_text, segment, starts_with, text_t
   use text_list, only: text_list_t
   use units, only: parse_unit, unit_t
   implicit none (type, external)
   private
   public :: clause_t, limits_words_t, phrase_hint, phrase_t, read_phrase

   integer, parameter :: most_panels = 6    !! of one figure
   character(*), parameter :: phrase_hint = "figures of curves: A + B in UNIT from X to Y against C, or panels(A, B) against C"
   character(*), parameter :: separators = "+,"  !! cells of their own wherever they stand

   !> Ends of an axis, as written.
   type :: limits_words_t
      real(wp) :: low = 0.0_wp               !! in its unit [any]
      real(wp) :: high = 0.0_wp              !! in its unit [any]
      character(:), allocatable :: low_unit  !! blank: none
      character(:), allocatable :: high_unit !! blank: none
   end type limits_words_t

   !> Channels with units and ends of axes.
   type :: clause_t
      type(text_t), allocatable :: words(:)            !! (n) channels
      type(text_t), allocatable :: units(:)            !! (any) units that are asked for
      type(limits_words_t), allocatable :: limits(:)   !! (any) ends that are asked for
   end type clause_t

   !> A figure of curves.
   type :: phrase_t
      type(clause_t), allocatable :: panels(:)  !! (n) from above to below
      type(clause_t) :: against                 !! abscissa; no words: time, as usual
   end type phrase_t

contains

   !> Take a figure apart.
   subroutine read_phrase(text, phrase, message, bad)
      character(*), intent(in) :: text                    !! as `figure_list` joins it
      type(phrase_t), intent(out) :: phrase               !! its parts
      character(:), allocatable, intent(out) :: message   !! what is wrong, blank if nothing
      character(:), allocatable, intent(out) :: bad       !! the wrong part of the text, blank: all of it

      type(text_t), allocatable :: cells(:)
      type(clause_t) :: clause
      integer :: at
      logical :: has_panels

      message = ""
      bad = ""
      allocate (phrase%panels(0))
      call empty(phrase%against)
      has_panels = starts_with(text, panels_word)
      cells = cells_of(merge_panels(text))
      at = 1
      do
         call read_clause(cells, at, clause, message, bad)
         if (len(message) > 0) return
         phrase%panels = [phrase%panels, clause]
         if (.not. has_panels .or. at > size(cells)) exit
         if (cells(at)%s /= ",") exit
         at = at + 1
      end do
      if (size(phrase%panels) > most_panels) then
         message = "more panels than the limit of six"
      else if (has_panels) then
         if (.not. is(cells, at, ")")) then
            message = "missing end of panels(...)"
         else
            at = at + 1
         end if
      end if
      if (len(message) > 0) return
      if (is(cells, at, "against")) then
         at = at + 1
         call read_clause(cells, at, phrase%against, message, bad)
         if (len(message) > 0) return
         if (size(phrase%against%words) > 1) then
            message = "a figure has one abscissa, not "//phrase%against%words(1)%s//" and "//phrase%against%words(2)%s
            bad = phrase%against%words(2)%s
            return
         end if
      end if
      if (at > size(cells)) return
      message = "'"//cells(at)%s//"' is not allowed here in a figure"
      bad = cells(at)%s
   end subroutine read_phrase

   !> A clause without words.
   subroutine empty(clause)
      type(clause_t), intent(out) :: clause  !! the clause

      allocate (clause%words(0), clause%units(0), clause%limits(0))
   end subroutine empty

   !> The text with the word for panels omitted and their last parenthesis a cell of its own.
   function merge_panels(text) result(s)
      character(*), intent(in) :: text         !! the figure
      character(:), allocatable :: s           !! the rest

      integer :: depth, i

      s = text
      if (.not. starts_with(text, panels_word)) return
      depth = 1
      do i = len(panels_word) + 1, len(text)
         if (text(i:i) == "(") depth = depth + 1
         if (text(i:i) == ")") depth = depth - 1
         if (depth > 0) cycle
         s = text(len(panels_word) + 1:i - 1)//" ) "//text(i + 1:)
         return
      end do
      s = text(len(panels_word) + 1:)
   end function merge_panels

   !> The cells of a figure: what stands between blanks, and separators, but for those in parentheses and in numbers.
   function cells_of(text) result(cells)
      character(*), intent(in) :: text         !! the figure
      type(text_t), allocatable :: cells(:)    !! (n) cells

      type(text_list_t) :: list
      integer :: depth, first, i

      first = 1
      depth = 0
      do i = 1, len(text)
         if (depth == 0 .and. (text(i:i) == " " .or. separates(i))) then
            if (i > first) call list%add(text(first:i - 1))
            first = i + 1
            if (text(i:i) /= " ") call list%add(text(i:i))
            cycle
         end if
         if (text(i:i) == "(") depth = depth + 1
         if (text(i:i) == ")" .and. i > first) depth = max(0, depth - 1)
      end do
      if (first <= len(text)) call list%add(text(first:))
      cells = list%get()

   contains

      !> Whether a character is a separator; the plus of a number is none.
      pure logical function separates(place)
         integer, intent(in) :: place  !! of the character

         separates = index(separators, text(place:place)) > 0
         if (.not. separates .or. text(place:place) /= "+") return
         if (place == first) then
            if (place < len(text)) separates = index("0123456789.", text(place + 1:place + 1)) == 0
         else
            separates = scan(text(place - 1:place - 1), "eEdD") == 0
            if (.not. separates) separates = number_length(text(first:place - 1)//"0") <= place - first
         end if
      end function separates

   end function cells_of

   !> Whether a cell is there and is a given word.
   pure logical function is(cells, at, word)
      type(text_t), intent(in) :: cells(:)  !! (n) cells
      integer, intent(in) :: at             !! which of them
      character(*), intent(in) :: word      !! the word

      is = .false.
      if (at <= size(cells)) is = cells(at)%s == word
   end function is

   !> Channels joined by plus, each with units and ends behind it, if any.
   subroutine read_clause(cells, at, clause, message, bad)
      type(text_t), intent(in) :: cells(:)                   !! (n) cells
      integer, intent(inout) :: at                           !! next of them
      type(clause_t), intent(out) :: clause                  !! what they say
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: bad        !! the wrong cell

      type(text_list_t) :: words

      call empty(clause)
      do
         if (at > size(cells)) then
            message = "missing channel at the end of the figure"
            return
         end if
         if (index(" + , ) in from to against ", " "//cells(at)%s//" ") > 0) then
            message = "missing channel before '"//cells(at)%s//"' in a figure"
            bad = cells(at)%s
            return
         end if
         call words%add(cells(at)%s)
         at = at + 1
         call read_axes(cells, at, clause, message, bad)
         if (len(message) > 0 .or. .not. is(cells, at, "+")) exit
         at = at + 1
      end do
      clause%words = words%get()
   end subroutine read_clause

   !> Units and ends of axes.
   subroutine read_axes(cells, at, clause, message, bad)
      type(text_t), intent(in) :: cells(:)                   !! (n) cells
      integer, intent(inout) :: at                           !! next of them
      type(clause_t), intent(inout) :: clause                !! grown
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: bad        !! the wrong cell

      type(limits_words_t) :: limits

      do
         if (is(cells, at, "in")) then
            at = at + 1
            if (at > size(cells)) message = "missing unit at the end of the figure"
            if (len(message) > 0) return
            call append_text(clause%units, cells(at)%s)
            at = at + 1
         else if (is(cells, at, "from")) then
            at = at + 1
            call read_end(cells, at, limits%low, limits%low_unit, message, bad)
            if (len(message) > 0) return
            if (.not. is(cells, at, "to")) then
               message = "missing 'to' after 'from' in a figure"
               return
            end if
            at = at + 1
            call read_end(cells, at, limits%high, limits%high_unit, message, bad)
            if (len(message) > 0) return
            clause%limits = [clause%limits, limits]
         else
            return
         end if
      end do
   end subroutine read_axes

   !> One end of an axis: a number and its unit, with or without a blank between.
   subroutine read_end(cells, at, x, unit, message, bad)
      type(text_t), intent(in) :: cells(:)                   !! (n) cells
      integer, intent(inout) :: at                           !! next of them
      real(wp), intent(out) :: x                             !! the number [any]
      character(:), allocatable, intent(out) :: unit         !! its unit, blank if there is none
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: bad        !! the wrong cell

      character(:), allocatable :: trouble
      type(unit_t) :: parsed
      integer :: first, last, n
      logical :: is_finite

      x = 0.0_wp
      unit = ""
      n = 0
      if (at <= size(cells)) n = number_length(cells(at)%s)
      if (n > 0) call read_number(cells(at)%s(:n), 0, x, is_finite)
      if (n > 0 .and. .not. is_finite) n = 0
      if (n == 0) then
         message = "missing number for an axis limit"
         if (at <= size(cells)) bad = cells(at)%s
         return
      end if
      if (n < len(cells(at)%s)) unit = segment(cells(at)%s, n + 1)
      at = at + 1
      if (len(unit) > 0 .or. at > size(cells)) return
      if (is(cells, at, "in") .or. is(cells, at, "to")) return
      call parse_unit(cells(at)%s, parsed, trouble, first, last)
      if (len(trouble) > 0) return
      unit = cells(at)%s
      at = at + 1
   end subroutine read_end

end module figure_phrase
