!> The deck's words for figures.
!>
!> `slider.velocity`, `guide.penetration`, `energy.*`: time histories of channels; with `+`, `against`, units, ends of axes, and in
!> `panels(...)`: `curve_words`.
!> `gudgeon.orbit`: path of the journal in its clearance. `portrait(slider.velocity.x,slider.acceleration.x)`:
!> the second over the first. With a section [statistics]: `section(X,Y)`, the same two once per period; `spectrum(X)`;
!> `histogram(JOINT.impact_speed)` or of `peak_force`. Of a sweep: `bifurcation(X)`, the channel once per period over the
!> first parameter; `statistics(NUMBER,...)`, up to four numbers with their spread over it. `film(JOINT)`: the unwrapped film at the
!> end of the run; `film(JOINT,minimum)` where it is thinnest, `film(JOINT,0.3s)` at a time. The mechanism: `motion_words`.
module figure_words
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances
   use channel_names, only: scalar_t
   use curve_words, only: bind_curves, curves_t
   use figure_phrase, only: phrase_hint, phrase_t, read_phrase
   use film_fields, only: field_request_t
   use kinds, only: i8, wp
   use motion_words, only: motion_request_t
   use spelling, only: nearest_word
   use text, only: join, segment, starts_with, text_t, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: append_figure, check_figures, figure_t, new_figure
   public :: figure_bifurcation, figure_histogram, figure_history, figure_orbit, figure_portrait, figure_section
   public :: draws_mechanism, figure_animation, figure_coupler, figure_mechanism, figure_strip
   public :: figure_film, figure_spectrum, figure_statistics, is_of_run

   integer, parameter :: figure_history = 1   !! channels over time
   integer, parameter :: figure_orbit = 2     !! eccentricity, y over x
   integer, parameter :: figure_portrait = 3  !! one channel over another
   integer, parameter :: figure_section = 4      !! one channel over another, once per period
   integer, parameter :: figure_spectrum = 5     !! amplitude over frequency
   integer, parameter :: figure_histogram = 6    !! number of impacts over speed or force
   integer, parameter :: figure_bifurcation = 7  !! of a sweep: a channel once per period over the parameter
   integer, parameter :: figure_statistics = 8   !! of a sweep: numbers with their spread over the parameter
   integer, parameter :: figure_film = 9         !! pressure of a film around a bearing, unwrapped
   integer, parameter :: figure_mechanism = 10   !! the mechanism at some instants
   integer, parameter :: figure_strip = 11       !! the mechanism at several positions over a turn, one over the other
   integer, parameter :: figure_coupler = 12     !! the path of a point
   integer, parameter :: figure_animation = 13   !! the moving mechanism
   integer, parameter :: most_panels = 4         !! of a figure of statistics
   integer, parameter :: longest_name = 100   !! characters of the name of a file without its ending
   !> How the figures with arguments start, by their kind.
   character(*), parameter :: call_words(figure_portrait:figure_animation) = [character(12) :: "portrait(", "section(", &
      "spectrum(", "histogram(", "bifurcation(", "statistics(", "film(", "mechanism(", "strip(", "coupler(", "animation("]
   character(*), parameter :: histogram_words = "impact_speed peak_force"  !! what there are histograms of
   character(*), parameter :: orbit_word = ".orbit"        !! how an orbit ends

   character(*), parameter :: unknown_channel = "unknown channel"  !! how the message about one starts

   !> One figure.
   type :: figure_t
      integer :: kind = figure_history              !! one of the above
      character(:), allocatable :: word             !! as in the deck
      character(:), allocatable :: name             !! of its files: letters, digits, `_`, `-` and dots
      type(scalar_t), allocatable :: scalars(:)     !! (n) curves, then their abscissa; of an orbit coordinates; of a portrait x, y
      type(curves_t) :: curves                      !! of curves: panels and axes
      integer :: joint = 0                          !! of an orbit: number of the clearance joint
      type(field_request_t) :: film                 !! of a film: which, and when
      type(motion_request_t) :: motion              !! of what draws the mechanism: when, and which point
      type(text_t), allocatable :: numbers(:)       !! (n) of statistics: their names; of a histogram: joint, quantity
   end type figure_t

   interface

      !> A figure with arguments.
      module subroutine new_call(word, catalogue, figure, message, hint, bad)
         implicit none (type, external)
         character(*), intent(in) :: word                       !! a word of the deck
         type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
         type(figure_t), intent(inout) :: figure                !! the figure, its kind is known
         character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
         character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank
         character(:), allocatable, intent(out) :: bad          !! the wrong argument, blank: all of it
      end subroutine new_call

   end interface

contains

   !> Look for errors in a list of figures.
   subroutine check_figures(words, catalogue, bad_word, bad_message, hint, bad_part, figures)
      type(text_t), intent(in) :: words(:)                    !! (n) words of the deck
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      integer, intent(out) :: bad_word                        !! number of the first wrong word, 0: none
      character(:), allocatable, intent(out) :: bad_message   !! what is wrong with it
      character(:), allocatable, intent(out) :: hint          !! what may have been meant, may be blank
      character(:), allocatable, intent(out) :: bad_part      !! the part of it that is wrong; blank: all of it
      type(figure_t), allocatable, intent(out) :: figures(:)  !! (n) the figures, if none is wrong

      integer :: k

      allocate (figures(size(words)))
      bad_word = 0
      bad_message = ""
      hint = ""
      bad_part = ""
      do k = 1, size(words)
         call new_figure(words(k)%s, catalogue, figures(k), bad_message, hint, bad_part)
         if (len(bad_message) == 0) cycle
         bad_word = k
         return
      end do
   end subroutine check_figures

   !> Understand one word.
   recursive subroutine new_figure(word, catalogue, figure, message, hint, bad_part)
      character(*), intent(in) :: word                     !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue           !! what can be recorded
      type(figure_t), intent(out) :: figure                !! the figure
      character(:), allocatable, intent(out) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(out) :: hint       !! what may have been meant, may be blank
      character(:), allocatable, intent(out), optional :: bad_part  !! the part that is wrong; blank: all of it

      character(:), allocatable :: bad
      integer :: blank

      message = ""
      hint = ""
      if (present(bad_part)) bad_part = ""
      figure%word = word
      figure%name = file_name(word)
      blank = index(word, " ")
      if (blank > 0) then
         if (kind_of_call(called(word(:blank - 1))) > 0 .or. ends_with(word(:blank - 1), orbit_word)) then
            message = "'"//first_word(word(blank + 1:))//"' is valid for figures of curves, not for '"//word(:blank - 1)//"'"
            hint = phrase_hint
            if (present(bad_part)) bad_part = first_word(word(blank + 1:))
            return
         end if
      end if
      figure%kind = kind_of_call(called(word))
      if (figure%kind > 0) then
         call new_call(called(word), catalogue, figure, message, hint, bad)
         if (present(bad_part)) bad_part = bad
         return
      end if
      figure%kind = figure_history
      if (blank == 0 .and. ends_with(word, orbit_word)) then
         call new_orbit(word(1:len(word) - len(orbit_word)), catalogue, figure, message, hint)
      else
         call new_history(word, catalogue, figure, message, hint, bad)
         if (present(bad_part)) bad_part = bad
      end if
   end subroutine new_figure

   !> Whether a word ends with another.
   pure logical function ends_with(word, ending)
      character(*), intent(in) :: word     !! the word
      character(*), intent(in) :: ending   !! its supposed end, shorter than it

      ends_with = .false.
      if (len(word) > len(ending)) ends_with = word(len(word) - len(ending) + 1:) == ending
   end function ends_with

   !> What stands before the first blank.
   pure function first_word(text) result(word)
      character(*), intent(in) :: text     !! words
      character(:), allocatable :: word    !! the first of them

      word = text
      if (index(text, " ") > 0) word = text(:index(text, " ") - 1)
   end function first_word

   !> A name for the files of a figure: letters, digits, `_`, `-` and dots alone; the end of a long one is a number made of it. What
   !> one panel of several draws is joined by `and`: other panels of the same channels have another name.
   pure function file_name(word) result(name)
      character(*), intent(in) :: word     !! a word of the deck
      character(:), allocatable :: name    !! the name

      character(*), parameter :: letters = &
         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"
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

   !> Channels over time, or over another channel.
   recursive subroutine new_history(word, catalogue, figure, message, hint, bad)
      character(*), intent(in) :: word                       !! a figure of the deck
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank
      character(:), allocatable, intent(out) :: bad          !! the wrong part, blank: all of it

      type(phrase_t) :: phrase

      call read_phrase(word, phrase, message, bad)
      if (len(message) > 0) then
         hint = phrase_hint
         allocate (figure%scalars(0))
         return
      end if
      call bind_curves(phrase, catalogue, figure%scalars, figure%curves, message, hint, bad)
      if (starts_with(message, unknown_channel) .and. bad == word) then
         message = "unknown figure"//segment(message, len(unknown_channel) + 1)
         call take_nearest_call(word, catalogue, hint)
         hint = hint//"; figures are a channel, JOINT.orbit, portrait(X,Y), section(X,Y), spectrum(X), "// &
                "histogram(JOINT.impact_speed), bifurcation(X), statistics(NUMBER), film(JOINT), mechanism, strip(n=8), "// &
                "coupler(POINT) and animation(last=...); "//phrase_hint
      end if
   end subroutine new_history

   !> Start a hint with the figure of another kind that was probably meant, if that would be understood.
   recursive subroutine take_nearest_call(word, catalogue, hint)
      character(*), intent(in) :: word                       !! a figure of the deck that is none
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant

      character(*), parameter :: question = "did you mean '"
      character(:), allocatable :: ignored, message, meant, nearest
      type(figure_t) :: figure
      type(text_t) :: calls(figure_portrait:figure_animation)
      integer :: k

      if (starts_with(hint, question)) return
      meant = ""
      k = index(word, ".", back=.true.)
      if (k > 1 .and. nearest_word(word(k + 1:), [text_t(orbit_word(2:))]) == orbit_word(2:)) then
         meant = word(:k - 1)//orbit_word
      else
         do k = figure_portrait, figure_animation
            calls(k)%s = segment(call_words(k), 1, index(call_words(k), "(") - 1)
         end do
         nearest = nearest_word(word(:index(word//"(", "(") - 1), calls)
         if (len(nearest) > 0) meant = nearest//word(index(word//"(", "("):)
      end if
      if (len(meant) == 0 .or. meant == word) return
      call new_figure(meant, catalogue, figure, message, ignored)
      if (len(message) == 0) hint = question//meant//"'? "//hint
   end subroutine take_nearest_call

   !> Path of a journal.
   recursive subroutine new_orbit(joint, catalogue, figure, message, hint)
      character(*), intent(in) :: joint                      !! name of the joint
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      character(:), allocatable :: ignored, nearest, refused
      type(figure_t) :: meant
      integer :: group, k
      logical :: is_round

      figure%kind = figure_orbit
      allocate (figure%scalars(0))
      group = catalogue%find_group(group_clearances, "eccentricity")
      associate (names => catalogue%rooms(group_clearances)%names)
         do k = 1, size(names)
            if (names(k)%s == joint) figure%joint = k
         end do
         if (figure%joint > 0) then
            associate (clearance => catalogue%rooms(group_clearances)%radius(figure%joint))
               is_round = ieee_is_finite(clearance)
               if (is_round) is_round = clearance > 0.0_wp
            end associate
            if (.not. is_round) then
               message = "no orbit of '"//joint//"': the joint is ideal, or its clearance is not round"
               hint = "an orbit needs a journal in a bearing with level = clearance"
               return
            end if
         end if
         if (figure%joint > 0 .and. group > 0) then
            if (catalogue%item_has(group, figure%joint)) then
               figure%scalars = [(scalar_t(group, k, figure%joint), k=1, catalogue%groups(group)%channel%components)]
               return
            end if
         end if
         message = "no orbit of '"//joint//"': it is not a joint with clearance"
         nearest = nearest_word(joint, names)
         hint = "joints with clearance: "//join(names, " ")
         if (size(names) == 0) hint = "this deck has no joints with clearance"
         if (len(nearest) == 0 .or. nearest == joint) return
         call new_figure(nearest//orbit_word, catalogue, meant, refused, ignored)
         if (len(refused) == 0) hint = "did you mean '"//nearest//orbit_word//"'? "//hint
      end associate
   end subroutine new_orbit

   !> The kind of a figure with arguments, 0 if it has none.
   pure integer function kind_of_call(word) result(kind)
      character(*), intent(in) :: word  !! a word of the deck

      do kind = figure_portrait, figure_animation
         if (starts_with(word, trim(call_words(kind)))) return
      end do
      kind = 0
   end function kind_of_call

   !> A word that needs no arguments, with parentheses; any other as it is.
   pure function called(word) result(call)
      character(*), intent(in) :: word        !! a word of the deck
      character(:), allocatable :: call       !! as `mechanism()`

      integer :: kind

      call = word
      do kind = figure_mechanism, figure_animation
         if (word//"(" == trim(call_words(kind)) .and. kind /= figure_coupler) call = word//"()"
      end do
   end function called

   !> Whether a figure is one of a single run, not of a sweep.
   pure logical function is_of_run(figure)
      type(figure_t), intent(in) :: figure  !! the figure

      is_of_run = figure%kind /= figure_bifurcation .and. figure%kind /= figure_statistics
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
