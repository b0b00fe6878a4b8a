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
   public :: clause_t, mistake_t, phrase_hint, phrase_t, read_phrase, set_mistake

   integer, parameter :: most_panels = 6    !! of one figure
   character(*), parameter :: phrase_hint = "figures of curves: A + B in UNIT from X to Y against C, or panels(A, B) against C"
   character(*), parameter :: separators = "+,"  !! cells of their own wherever they stand

   !> What is wrong with the words of a figure; unallocated: nothing.
   type :: mistake_t
      character(:), allocatable :: message   !! what is wrong
      character(:), allocatable :: hint      !! what may have been meant, may be blank
      character(:), allocatable :: part      !! the wrong part of the words; blank: all of them
   end type mistake_t

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

   !> Make a mistake.
   pure subroutine set_mistake(mistake, message, hint, part)
      type(mistake_t), allocatable, intent(out) :: mistake  !! the new mistake
      character(*), intent(in) :: message                   !! what is wrong
      character(*), intent(in) :: hint                      !! what may have been meant, may be blank
      character(*), intent(in) :: part                      !! the wrong part of the words; blank: all of them

      mistake = mistake_t(message, hint, part)
   end subroutine set_mistake

   !> Take a figure apart.
   subroutine read_phrase(text, phrase, mistake)
      character(*), intent(in) :: text                       !! as `figure_list` joins it
      type(phrase_t), intent(out) :: phrase                  !! its parts
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      type(text_t), allocatable :: cells(:)
      type(clause_t) :: clause
      integer :: at
      logical :: has_panels

      allocate (phrase%panels(0))
      call empty(phrase%against)
      has_panels = starts_with(text, panels_word)
      cells = cells_of(merge_panels(text))
      at = 1
      do
         call read_clause(cells, at, clause, mistake)
         if (allocated(mistake)) return
         phrase%panels = [phrase%panels, clause]
         if (.not. has_panels .or. at > size(cells)) exit
         if (cells(at)%s /= ",") exit
         at = at + 1
      end do
      if (size(phrase%panels) > most_panels) then
         call set_mistake(mistake, "more panels than the limit of six", phrase_hint, "")
      else if (has_panels) then
         if (.not. is(cells, at, ")")) call set_mistake(mistake, "missing end of panels(...)", phrase_hint, "")
         at = at + 1
      end if
      if (allocated(mistake)) return
      if (is(cells, at, "against")) then
         at = at + 1
         call read_clause(cells, at, phrase%against, mistake)
         if (allocated(mistake)) return
         associate (words => phrase%against%words)
            if (size(words) > 1) call set_mistake(mistake, "a figure has one abscissa, not "//words(1)%s//" and "//words(2)%s, &
                                                  phrase_hint, words(2)%s)
            if (size(words) > 1) return
         end associate
      end if
      if (at <= size(cells)) call set_mistake(mistake, "'"//cells(at)%s//"' is not allowed here in a figure", phrase_hint, &
                                              cells(at)%s)
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
   subroutine read_clause(cells, at, clause, mistake)
      type(text_t), intent(in) :: cells(:)                   !! (n) cells
      integer, intent(inout) :: at                           !! next of them
      type(clause_t), intent(out) :: clause                  !! what they say
      type(mistake_t), allocatable, intent(inout) :: mistake !! what is wrong

      type(text_list_t) :: words

      call empty(clause)
      do
         if (at > size(cells)) then
            call set_mistake(mistake, "missing channel at the end of the figure", phrase_hint, "")
         else if (index(" + , ) in from to against ", " "//cells(at)%s//" ") > 0) then
            call set_mistake(mistake, "missing channel before '"//cells(at)%s//"' in a figure", phrase_hint, cells(at)%s)
         end if
         if (allocated(mistake)) return
         call words%add(cells(at)%s)
         at = at + 1
         call read_axes(cells, at, clause, mistake)
         if (allocated(mistake) .or. .not. is(cells, at, "+")) exit
         at = at + 1
      end do
      clause%words = words%get()
   end subroutine read_clause

   !> Units and ends of axes.
   subroutine read_axes(cells, at, clause, mistake)
      type(text_t), intent(in) :: cells(:)                   !! (n) cells
      integer, intent(inout) :: at                           !! next of them
      type(clause_t), intent(inout) :: clause                !! grown
      type(mistake_t), allocatable, intent(inout) :: mistake !! what is wrong

      type(limits_words_t) :: limits

      do
         if (is(cells, at, "in")) then
            at = at + 1
            if (at > size(cells)) call set_mistake(mistake, "missing unit at the end of the figure", phrase_hint, "")
            if (allocated(mistake)) return
            call append_text(clause%units, cells(at)%s)
            at = at + 1
         else if (is(cells, at, "from")) then
            at = at + 1
            call read_end(cells, at, limits%low, limits%low_unit, mistake)
            if (allocated(mistake)) return
            if (.not. is(cells, at, "to")) call set_mistake(mistake, "missing 'to' after 'from' in a figure", phrase_hint, "")
            if (allocated(mistake)) return
            at = at + 1
            call read_end(cells, at, limits%high, limits%high_unit, mistake)
            if (allocated(mistake)) return
            clause%limits = [clause%limits, limits]
         else
            return
         end if
      end do
   end subroutine read_axes

   !> One end of an axis: a number and its unit, with or without a blank between.
   subroutine read_end(cells, at, x, unit, mistake)
      type(text_t), intent(in) :: cells(:)                   !! (n) cells
      integer, intent(inout) :: at                           !! next of them
      real(wp), intent(out) :: x                             !! the number [any]
      character(:), allocatable, intent(out) :: unit         !! its unit, blank if there is none
      type(mistake_t), allocatable, intent(inout) :: mistake !! what is wrong

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
         trouble = ""
         if (at <= size(cells)) trouble = cells(at)%s
         call set_mistake(mistake, "missing number for an axis limit", phrase_hint, trouble)
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
