!> The words of the key `figures`, joined to one text for each figure.
!>
!> A figure of curves may be several words: `a + b in mm/s from 0 to 2 against motor.coordinate in deg`. The words `+`, `against`,
!> `in`, `from`, `to` and `as` belong to the figure before them, as does what they ask for: a channel, a unit, a number with its
!> unit, a name.
module figure_list
   use diagnostics, only: diagnostics_t
   use item, only: location_t, value_t
   use numbers, only: number_length
   use spelling, only: nearest_word
   use text, only: segment, starts_with, text_t
   use text_buffer, only: buffer_t
   use text_list, only: text_list_t
   use units, only: parse_unit, unit_t
   implicit none (type, external)
   private
   public :: figure_joiners, join_figures, panels_word

   character(*), parameter :: figure_joiners = "+ against in from to as"  !! words that belong to the figure before them
   character(*), parameter :: lone_words = "mechanism strip animation"  !! figures of one word without a channel
   character(*), parameter :: panels_word = "panels("                  !! how a figure of several panels starts

contains

   !> Join the words of every figure.
   subroutine join_figures(value, mistakes)
      type(value_t), intent(inout) :: value           !! the list; its words become figures
      type(diagnostics_t), intent(inout) :: mistakes  !! collects what is wrong

      type(location_t) :: places(size(value%words))
      type(text_list_t) :: figures
      type(buffer_t) :: whole
      integer :: first, i, k, last

      k = 1
      do while (k <= size(value%words))
         first = k
         if (is_joiner(value%words(k)%s)) then
            call mistakes%add(place(k), "missing figure before '"//value%words(k)%s//"'", "no figure before this", &
                              "write a channel first, as in slider.velocity.x against motor.coordinate")
            return
         end if
         whole = buffer_t()
         call whole%add(without_blanks(value%words(k)%s))
         do
            k = k + 1
            if (k > size(value%words)) exit
            if (.not. is_joiner(value%words(k)%s)) then
               call check_misspelt(k)
               exit
            end if
            last = k + n_asked(value%words(k:))
            if (last == k) then
               call mistakes%add(place(k), "missing argument after '"//value%words(k)%s//"' in a figure", &
                                 "end of the list of figures", asked_for(value%words(k)%s))
               return
            end if
            do i = k, last
               call whole%add(" "//value%words(i)%s)
            end do
            k = last
         end do
         call figures%add(whole%get())
         places(figures%n) = place(first)
         if (k - 1 > first) places(figures%n)%last = max(places(figures%n)%last, last_column(first, k - 1))
      end do
      value%words = figures%get()
      value%places = places(:figures%n)

   contains

      !> Where a word stands.
      pure type(location_t) function place(number)
         integer, intent(in) :: number  !! of the word

         place = value%location
         if (number <= size(value%places)) place = value%places(number)
      end function place

      !> Last column of a stretch of words on one line.
      pure integer function last_column(from, to) result(column)
         integer, intent(in) :: from  !! its first word
         integer, intent(in) :: to    !! its last word

         type(location_t) :: a, b

         a = place(from)
         b = place(to)
         column = a%last
         if (a%file == b%file .and. a%line == b%line) column = b%last
      end function last_column

      !> A word that is no figure may be a misspelt word between figures.
      subroutine check_misspelt(number)
         integer, intent(in) :: number  !! of the word

         character(:), allocatable :: meant

         if (scan(value%words(number)%s, ".*(") > 0 .or. len(value%words(number)%s) < 2) return
         meant = nearest_word(value%words(number)%s, figure_joiners)
         if (len(meant) < 2 .or. index(" "//lone_words//" ", " "//value%words(number)%s//" ") > 0) return
         call mistakes%add(place(number), "unknown figure '"//value%words(number)%s//"'", "not a figure of this deck", &
                           "did you mean '"//meant//"'? It would belong to the preceding figure")
      end subroutine check_misspelt

   end subroutine join_figures

   !> Whether a word belongs to the figure before it.
   pure logical function is_joiner(word)
      character(*), intent(in) :: word  !! of the list

      is_joiner = len(word) > 0 .and. index(" "//figure_joiners//" ", " "//word//" ") > 0 .and. scan(word, " ") == 0
   end function is_joiner

   !> How many words those that follow a joining word are: one, or a number and its unit.
   integer function n_asked(words) result(n)
      type(text_t), intent(in) :: words(:)  !! (any) the joining word and what follows

      character(:), allocatable :: message
      type(unit_t) :: unit
      integer :: first, last

      n = min(1, size(words) - 1)
      if (size(words) < 3) return
      if (words(1)%s /= "from" .and. words(1)%s /= "to") return
      if (number_length(words(2)%s) == 0 .or. number_length(words(2)%s) < len(words(2)%s)) return
      call parse_unit(words(3)%s, unit, message, first, last)
      if (len(message) == 0) n = 2
   end function n_asked

   !> What a joining word asks for.
   pure function asked_for(word) result(help)
      character(*), intent(in) :: word          !! the word
      character(:), allocatable :: help         !! what would be right

      select case (word)
      case ("in")
         help = "write a unit, as in slider.velocity.x in mm/s"
      case ("as")
         help = "write the name of its files, as in slider.velocity.x as speed"
      case ("from", "to")
         help = "write the limits of the axis, as in from 0 mm to 20 mm"
      case default
         help = "write a channel, as in slider.velocity.x "//word//" motor.coordinate"
      end select
   end function asked_for

   !> A word without the blanks between its parentheses, but those of panels, which hold figures.
   pure function without_blanks(word) result(s)
      character(*), intent(in) :: word        !! as read
      character(:), allocatable :: s          !! as figures are called

      integer :: depth, i, n

      s = word
      if (starts_with(word, panels_word) .or. index(word, "(") == 0) return
      n = 0
      depth = 0
      do i = 1, len(word)
         if (word(i:i) == "(") depth = depth + 1
         if (word(i:i) == ")") depth = depth - 1
         if (word(i:i) == " " .and. depth > 0) cycle
         n = n + 1
         s(n:n) = word(i:i)
      end do
      s = segment(s, 1, n)
   end function without_blanks

end module figure_list
