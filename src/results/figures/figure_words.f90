!> The record of a figure: what its words in a deck ask for, read once, and what they name in a catalogue (`figure_binding`).
!>
!> `slider.velocity`, `guide.penetration`, `energy.*`: time histories of channels; with `+`, `against`, units, ends of axes, and in
!> `panels(...)`: `figure_phrase`.
!> Any figure may end with `as NAME`, the name of its files.
!> `gudgeon.orbit`: path of the journal in its clearance. `portrait(slider.velocity.x,slider.acceleration.x)`:
!> the second over the first. With a section [statistics]: `section(X,Y)`, the same two once per period; `spectrum(X)`;
!> `histogram(JOINT.impact_speed)` or of `peak_force`. Of a sweep: `bifurcation(X)`, the channel once per period over the
!> first parameter; `statistics(NUMBER,...)`, up to four numbers with their spread over it. `film(JOINT)`: the unwrapped film at the
!> end of the run; `film(JOINT,least)` where it is thinnest, `film(JOINT,0.3s)` at a time. `wear(JOINT)`: worn bearing and journal
!> at the end. The mechanism: `motion_words`.
module figure_words
   use channel_names, only: scalar_t
   use curve_words, only: curves_t
   use figure_phrase, only: mistake_t, phrase_hint, phrase_t, read_phrase, set_mistake
   use film_fields, only: field_request_t
   use kinds, only: i8
   use motion_words, only: film_hint, motion_hint, motion_request_t, read_moment, read_motion
   use text, only: append_text, segment, starts_with, text_t, to_text
   use text_buffer, only: buffer_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: append_figure, call_words, figure_t, orbit_ending, read_figure
   public :: figure_bifurcation, figure_histogram, figure_history, figure_orbit, figure_portrait, figure_section
   public :: draws_mechanism, figure_animation, figure_coupler, figure_mechanism, figure_strip
   public :: figure_contour, figure_film, figure_spectrum, figure_statistics, figure_wear, is_of_run

   integer, parameter :: figure_history = 1   !! channels over time
   integer, parameter :: figure_orbit = 2     !! eccentricity, y over x
   integer, parameter :: figure_portrait = 3  !! one channel over another
   integer, parameter :: figure_section = 4      !! one channel over another, once per period
   integer, parameter :: figure_spectrum = 5     !! amplitude over frequency
   integer, parameter :: figure_histogram = 6    !! number of impacts over speed or force
   integer, parameter :: figure_bifurcation = 7  !! of a sweep: a channel once per period over the parameter
   integer, parameter :: figure_statistics = 8   !! of a sweep: numbers with their spread over the parameter
   integer, parameter :: figure_contour = 9      !! of a sweep: a number over two parameters
   integer, parameter :: figure_film = 10        !! pressure of a film around a bearing, unwrapped
   integer, parameter :: figure_wear = 11        !! sections of worn bearing and journal, and their depths
   integer, parameter :: figure_mechanism = 12   !! the mechanism at some output times
   integer, parameter :: figure_strip = 13       !! the mechanism at several positions over a turn, one over the other
   integer, parameter :: figure_coupler = 14     !! the path of a point
   integer, parameter :: figure_animation = 15   !! the moving mechanism
   integer, parameter :: longest_name = 100   !! characters of the name of a file without its ending
   character(*), parameter :: as_word = " as "  !! before the name of its files
   character(*), parameter :: letters = &
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"  !! of names of files
   !> How the figures with arguments start, by their kind.
   character(*), parameter :: call_words(figure_portrait:figure_animation) = [character(12) :: "portrait(", "section(", &
      "spectrum(", "histogram(", "bifurcation(", "statistics(", "contour(", "film(", "wear(", "mechanism(", "strip(", "coupler(", &
      "animation("]
   integer, parameter :: fewest(figure_portrait:figure_animation) = [2, 2, 1, 1, 1, 1, 1, 1, 1, 0, 0, 1, 0]  !! arguments of each
   integer, parameter :: most(figure_portrait:figure_animation) = [2, 2, 1, 1, 1, 4, 1, 2, 1, spread(huge(1), 1, 4)]  !! the same
   character(*), parameter :: orbit_ending = ".orbit"      !! how an orbit ends

   !> One figure.
   type :: figure_t
      integer :: kind = figure_history              !! one of the above
      character(:), allocatable :: word             !! as in the deck
      character(:), allocatable :: name             !! of its files: letters, digits, `_`, `-` and dots
      type(phrase_t) :: phrase                      !! of curves: channels, units and ends of axes by name
      type(text_t), allocatable :: arguments(:)     !! (n) of others: channels, joint, or numbers, by name
      type(field_request_t) :: film                 !! of a film: which, and when
      type(motion_request_t) :: motion              !! of what draws the mechanism: when, and which point
      type(scalar_t), allocatable :: scalars(:)     !! (n) curves, then their abscissa; of an orbit coordinates; of a portrait x, y
      type(curves_t) :: curves                      !! of curves: panels and axes
      integer :: joint = 0                          !! of an orbit: number of the clearance joint
   end type figure_t

contains

   !> Read the words of a figure.
   subroutine read_figure(word, figure, mistake)
      character(*), intent(in) :: word                       !! a figure of the deck
      type(figure_t), intent(out) :: figure                  !! what it asks for
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      integer :: n

      figure%word = word
      allocate (figure%arguments(0), figure%scalars(0))
      n = index(word, as_word, back=.true.)
      if (n == 0) then
         figure%name = file_name(word)
         call read_plain(word, figure, mistake)
      else
         figure%name = segment(word, n + len(as_word))
         if (verify(figure%name, letters//".") > 0 .or. scan(figure%name(1:1), "-.") > 0 .or. len(figure%name) > longest_name) then
            call set_mistake(mistake, "'"//figure%name//"' is not a name of files", "a name has up to 100 letters, digits, "// &
                             "'_', '-' and dots, and starts with a letter or digit", figure%name)
         else
            call read_plain(word(:n - 1), figure, mistake)
         end if
      end if
   end subroutine read_figure

   !> Read the words of a figure without the name of its files.
   subroutine read_plain(word, figure, mistake)
      character(*), intent(in) :: word                       !! a figure
      type(figure_t), intent(inout) :: figure                !! what it asks for
      type(mistake_t), allocatable, intent(out) :: mistake   !! what is wrong

      integer :: n

      n = index(word//" ", " ") - 1
      figure%kind = kind_of(word(:n))
      if (n < len(word) .and. figure%kind /= figure_history) then
         associate (next => word(n + 2:n + index(word(n + 2:)//" ", " ")))
            call set_mistake(mistake, "'"//next//"' is valid for figures of curves, not for '"//word(:n)//"'", phrase_hint, next)
         end associate
      else if (figure%kind == figure_history) then
         call read_phrase(word, figure%phrase, mistake)
      else if (figure%kind == figure_orbit) then
         call append_text(figure%arguments, word(:len(word) - len(orbit_ending)))
      else
         call read_call(called(word), figure, mistake)
      end if
   end subroutine read_plain

   !> The kind of a figure by its first word.
   pure integer function kind_of(word) result(kind)
      character(*), intent(in) :: word  !! without blanks outside of parentheses

      do kind = figure_portrait, figure_animation
         if (starts_with(called(word), trim(call_words(kind)))) return
      end do
      kind = figure_history
      if (len(word) <= len(orbit_ending)) return
      if (word(len(word) - len(orbit_ending) + 1:) == orbit_ending) kind = figure_orbit
   end function kind_of

   !> A word that needs no arguments, with parentheses; any other as it is.
   pure function called(word) result(call)
      character(*), intent(in) :: word        !! a word of the deck
      character(:), allocatable :: call       !! as `mechanism()`

      integer :: kind

      call = word
      do kind = figure_mechanism, figure_animation
         if (word//"(" == trim(call_words(kind)) .and. fewest(kind) == 0) call = word//"()"
      end do
   end function called

   !> Read the arguments of a figure.
   subroutine read_call(word, figure, mistake)
      character(*), intent(in) :: word                          !! as `spectrum(motor.moment)`
      type(figure_t), intent(inout) :: figure                   !! the figure, its kind is known
      type(mistake_t), allocatable, intent(inout) :: mistake    !! what is wrong

      character(:), allocatable :: hint
      integer :: dot, n

      figure%arguments = arguments_of(word(len_trim(call_words(figure%kind)) + 1:))
      n = size(figure%arguments)
      if (n < fewest(figure%kind) .or. n > most(figure%kind) .or. word(len(word):) /= ")") then
         hint = "write "//trim(call_words(figure%kind))//trim(merge("x_channel,y_channel", "channel            ", &
                                                                    fewest(figure%kind) == 2))//")"
         if (figure%kind == figure_statistics) hint = "write statistics(NUMBER,NUMBER) with one to four numbers"
         if (figure%kind == figure_contour) hint = "write contour(NUMBER) with one number"
         if (figure%kind == figure_film) hint = film_hint
         if (figure%kind == figure_wear) hint = "write wear(JOINT)"
         if (draws_mechanism(figure)) hint = motion_hint
         call set_mistake(mistake, "cannot read '"//word//"'", hint, "")
      else if (draws_mechanism(figure)) then
         call read_motion(figure%arguments, figure%kind == figure_coupler, figure%motion, mistake)
      else if (figure%kind == figure_film) then
         figure%film%name = figure%name
         figure%film%joint = figure%arguments(1)%s
         if (n == 2) call read_moment(figure%arguments(2)%s, figure%film, mistake)
      else if (figure%kind == figure_histogram) then
         hint = figure%arguments(1)%s
         dot = index(hint, ".")
         figure%arguments(1)%s = hint(:dot - 1)
         call append_text(figure%arguments, segment(hint, dot + 1))
      end if
   end subroutine read_call

   !> What stands between commas before a closing parenthesis.
   pure function arguments_of(text) result(list)
      character(*), intent(in) :: text           !! as `a,b)`
      type(text_t), allocatable :: list(:)       !! (n) arguments

      type(text_list_t) :: found
      integer :: first, length

      first = 1
      do while (first <= len(text))
         length = scan(text(first:), ",)") - 1
         if (length < 1) exit
         call found%add(text(first:first + length - 1))
         first = first + length + 1
      end do
      list = found%get()
   end function arguments_of

   !> A name for the files of a figure: letters, digits, `_`, `-` and dots alone; the end of a long one is a number made of it. What
   !> one panel of several draws is joined by `and`: other panels of the same channels have another name.
   pure function file_name(word) result(name)
      character(*), intent(in) :: word     !! a word of the deck
      character(:), allocatable :: name    !! the name

      integer(i8), parameter :: factor = 31_i8, modulus = 99999989_i8
      type(buffer_t) :: buffer
      integer :: depth, i
      integer(i8) :: mark
      logical :: is_new

      is_new = .false.
      depth = 0
      do i = 1, len(word)
         if (index(letters, word(i:i)) > 0 .or. word(i:i) == "*") then
            if (is_new .and. buffer%length() > 0) call buffer%add(".")
            is_new = .false.
            if (word(i:i) == "*") then
               call buffer%add("all")
            else
               call buffer%add(word(i:i))
            end if
         else
            is_new = is_new .or. word(i:i) /= ")"
            if (word(i:i) == "(") depth = depth + 1
            if (word(i:i) == ")") depth = depth - 1
            if (word(i:i) == "+" .and. depth > 0) call buffer%add(".and")
         end if
      end do
      name = buffer%get()
      if (len(name) <= longest_name) return
      mark = 0
      do i = 1, len(word)
         mark = modulo(factor*mark + iachar(word(i:i)), modulus)
      end do
      name = segment(name, 1, longest_name - 9)//"."//to_text(mark)
   end function file_name

   !> Whether a figure is one of a single run, not of a sweep.
   pure logical function is_of_run(figure)
      type(figure_t), intent(in) :: figure  !! the figure

      is_of_run = all(figure%kind /= [figure_bifurcation, figure_statistics, figure_contour])
   end function is_of_run

   !> Whether a figure draws the mechanism.
   pure logical function draws_mechanism(figure)
      type(figure_t), intent(in) :: figure  !! the figure

      draws_mechanism = figure%kind >= figure_mechanism
   end function draws_mechanism

   !> Append a figure to a list.
   subroutine append_figure(figures, figure)
      type(figure_t), allocatable, intent(inout) :: figures(:)  !! (n) figures
      type(figure_t), intent(in) :: figure                      !! the new one

      type(figure_t), allocatable :: grown(:)
      integer :: k

      allocate (grown(size(figures) + 1))
      do k = 1, size(figures)
         grown(k) = figures(k)
      end do
      grown(size(grown)) = figure
      call move_alloc(grown, figures)
   end subroutine append_figure

end module figure_words
