!> The deck's words for figures.
!>
!> `slider.velocity`, `guide.penetration`, `energy.*`: time histories of channels of one unit.
!> `gudgeon.orbit`: path of the journal in its clearance. `portrait(slider.velocity.x,slider.acceleration.x)`:
!> the second over the first. With a section [statistics]: `section(X,Y)`, the same two once per period; `spectrum(X)`;
!> `histogram(JOINT.impact_speed)` or of `peak_force`. Of a sweep: `bifurcation(X)`, the channel once per period over the
!> first parameter; `statistics(NUMBER,...)`, up to four numbers with their spread over it. `film(JOINT)`: the unwrapped film at the
!> end of the run; `film(JOINT,least)` where it is thinnest, `film(JOINT,0.3s)` at a time. The mechanism: `motion_words`.
module figure_words
   use catalogue, only: catalogue_t, room_clearances, room_contacts
   use channel_names, only: scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use film_fields, only: field_request_t
   use film_words, only: film_hint, take_film
   use kinds, only: wp
   use motion_words, only: motion_hint, motion_request_t, take_motion
   use spelling, only: nearest_word
   use text, only: append_text, join, starts_with, text_t
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
   integer, parameter :: most_curves = 12     !! of one figure
   !> How the figures with arguments begin, by their kind.
   character(*), parameter :: call_words(figure_portrait:figure_animation) = [character(12) :: "portrait(", "section(", &
      "spectrum(", "histogram(", "bifurcation(", "statistics(", "film(", "mechanism(", "strip(", "coupler(", "animation("]
   character(*), parameter :: histogram_words = "impact_speed peak_force"  !! what there are histograms of
   character(*), parameter :: orbit_word = ".orbit"        !! how an orbit ends

   !> One figure.
   type :: figure_t
      integer :: kind = figure_history              !! one of the above
      character(:), allocatable :: word             !! as in the deck
      character(:), allocatable :: name             !! of its files: letters, digits, `_`, `-` and dots
      type(scalar_t), allocatable :: scalars(:)     !! (n) curves; of an orbit its coordinates; of a portrait x and y
      integer :: joint = 0                          !! of an orbit: number of the clearance joint
      type(field_request_t) :: film                 !! of a film: which, and when
      type(motion_request_t) :: motion              !! of what draws the mechanism: when, and which point
      type(text_t), allocatable :: numbers(:)       !! (n) of statistics: their names; of a histogram: joint, quantity
   end type figure_t

contains

   !> Look for mistakes in a list of figures.
   subroutine check_figures(words, catalogue, bad_word, bad_message, hint)
      type(text_t), intent(in) :: words(:)                    !! (n) words of the deck
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      integer, intent(out) :: bad_word                        !! number of the first wrong word, 0: none
      character(:), allocatable, intent(out) :: bad_message   !! what is wrong with it
      character(:), allocatable, intent(out) :: hint          !! what may have been meant, may be blank

      type(figure_t) :: figure
      integer :: k

      bad_word = 0
      bad_message = ""
      hint = ""
      do k = 1, size(words)
         call new_figure(words(k)%s, catalogue, figure, bad_message, hint)
         if (len(bad_message) == 0) cycle
         bad_word = k
         return
      end do
   end subroutine check_figures

   !> Understand one word.
   subroutine new_figure(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                     !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue           !! what can be recorded
      type(figure_t), intent(out) :: figure                !! the figure
      character(:), allocatable, intent(out) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(out) :: hint       !! what may have been meant, may be blank

      message = ""
      hint = ""
      figure%word = word
      figure%name = file_name(word)
      figure%kind = kind_of_call(called(word))
      if (figure%kind > 0) then
         call new_call(called(word), catalogue, figure, message, hint)
         return
      end if
      figure%kind = figure_history
      if (len(word) > len(orbit_word) .and. index(word, orbit_word, back=.true.) == &
               len(word) - len(orbit_word) + 1) then
         call new_orbit(word(1:len(word) - len(orbit_word)), catalogue, figure, message, hint)
      else
         call new_history(word, catalogue, figure, message, hint)
      end if
   end subroutine new_figure

   !> A name for the files of a figure: nothing but letters, digits, `_`, `-` and dots.
   pure function file_name(word) result(name)
      character(*), intent(in) :: word     !! a word of the deck
      character(:), allocatable :: name    !! the name

      character(*), parameter :: letters = &
         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"
      integer :: i

      name = ""
      do i = 1, len(word)
         if (index(letters, word(i:i)) > 0) then
            name = name//word(i:i)
         else if (word(i:i) == "*") then
            name = name//"all"
         else if (word(i:i) /= ")" .and. len(name) > 0) then
            name = name//"."
         end if
      end do
   end function file_name

   !> Channels over time.
   subroutine new_history(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      type(selection_t) :: named
      integer :: k

      call match_word(word, catalogue, named, message, hint)
      figure%scalars = list_scalars(named)
      if (len(message) > 0) then
         message = "unknown figure"//message(len("unknown channel") + 1:)
         hint = hint//"; figures are a channel, JOINT.orbit, portrait(X,Y), section(X,Y), spectrum(X), "// &
                "histogram(JOINT.impact_speed), bifurcation(X), statistics(NUMBER), film(JOINT), mechanism, strip(n=8), "// &
                "coupler(POINT) and animation(last=...)"
         return
      end if
      if (size(figure%scalars) == 0 .or. size(figure%scalars) > most_curves) then
         message = "'"//word//"' names too many channels for one figure"
         hint = "name an item and a channel, as in slider.velocity"
         return
      end if
      do k = 2, size(figure%scalars)
         if (unit_of(catalogue, figure%scalars(k)) == unit_of(catalogue, figure%scalars(1))) cycle
         message = "'"//word//"' names channels of different units"
         hint = "one figure draws channels of one unit"
         return
      end do
   end subroutine new_history

   !> The unit of a number.
   pure function unit_of(catalogue, scalar) result(unit)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(scalar_t), intent(in) :: scalar        !! the number
      character(:), allocatable :: unit           !! as in files

      unit = catalogue%groups(scalar%group)%channel%unit
   end function unit_of

   !> Path of a journal.
   subroutine new_orbit(joint, catalogue, figure, message, hint)
      character(*), intent(in) :: joint                      !! name of the joint
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      character(:), allocatable :: nearest
      integer :: group, k

      figure%kind = figure_orbit
      allocate (figure%scalars(0))
      group = catalogue%find_group(room_clearances, "eccentricity")
      associate (names => catalogue%rooms(room_clearances)%names)
         do k = 1, size(names)
            if (names(k)%s == joint) figure%joint = k
         end do
         if (figure%joint > 0) then
            if (.not. catalogue%rooms(room_clearances)%radius(figure%joint) > 0.0_wp) then
               message = "no orbit of '"//joint//"': the joint is ideal, or has no round clearance"
               hint = "with level = clearance a journal in a bearing has an orbit"
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
         if (len(nearest) > 0) hint = "did you mean '"//nearest//orbit_word//"'? "//hint
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

   !> A figure with arguments.
   subroutine new_call(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure, its kind is known
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      type(text_t), allocatable :: arguments(:)
      integer :: k, least, most

      allocate (figure%scalars(0), figure%numbers(0))
      least = merge(2, 1, figure%kind == figure_portrait .or. figure%kind == figure_section)
      most = merge(most_panels, least, figure%kind == figure_statistics)
      if (figure%kind == figure_film) most = 2
      arguments = arguments_of(word(len_trim(call_words(figure%kind)) + 1:))
      if (draws_mechanism(figure) .and. word(len(word):) == ")" .and. &
          (figure%kind /= figure_coupler .or. size(arguments) > 0)) then
         call take_motion(arguments, figure%kind == figure_coupler, figure%motion, message)
         if (len(message) > 0) hint = motion_hint
         return
      end if
      if (size(arguments) < least .or. size(arguments) > most .or. word(len(word):) /= ")") then
         message = "cannot read '"//word//"'"
         hint = "write "//trim(call_words(figure%kind))//trim(merge("x_channel,y_channel", "channel            ", least == 2))// &
                ") without blanks"
         if (figure%kind == figure_statistics) hint = "write statistics(NUMBER,NUMBER) with one to four numbers, without blanks"
         if (figure%kind == figure_film) hint = film_hint
         if (draws_mechanism(figure)) hint = motion_hint
         return
      end if
      select case (figure%kind)
      case (figure_histogram)
         call take_histogram(arguments(1)%s, catalogue, figure, message, hint)
      case (figure_statistics)
         figure%numbers = arguments
      case (figure_film)
         figure%film%name = figure%name
         call take_film(arguments, catalogue, figure%film, message, hint)
      case default
         do k = 1, size(arguments)
            call take_scalar(arguments(k)%s, catalogue, figure, message, hint)
            if (len(message) > 0) return
         end do
      end select
   end subroutine new_call

   !> What stands between commas before a closing parenthesis.
   pure function arguments_of(text) result(list)
      character(*), intent(in) :: text           !! as `a,b)`
      type(text_t), allocatable :: list(:)       !! (n) arguments

      integer :: first, length

      allocate (list(0))
      first = 1
      do while (first <= len(text))
         length = scan(text(first:), ",)") - 1
         if (length < 1) exit
         call append_text(list, text(first:first + length - 1))
         first = first + length + 1
      end do
   end function arguments_of

   !> Add a channel that is one number to a figure.
   subroutine take_scalar(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! name of the channel
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      type(selection_t) :: named
      type(scalar_t), allocatable :: scalars(:)

      call match_word(word, catalogue, named, message, hint)
      if (len(message) > 0) return
      scalars = list_scalars(named)
      if (size(scalars) == 1) then
         figure%scalars = [figure%scalars, scalars]
      else
         message = "'"//word//"' is not one number"
         hint = "this figure needs single components, as in "//word//".x"
      end if
   end subroutine take_scalar

   !> A histogram of what the contacts of a joint do.
   subroutine take_histogram(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! as `gudgeon.impact_speed`
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      integer :: dot, k

      dot = index(word, ".")
      do k = 1, size(catalogue%rooms(room_contacts)%names)
         if (dot == 0) exit
         if (catalogue%rooms(room_contacts)%names(k)%s /= word(1:dot - 1)) cycle
         if (index(" "//histogram_words//" ", " "//word(dot + 1:)//" ") == 0) cycle
         call append_text(figure%numbers, word(1:dot - 1))
         call append_text(figure%numbers, word(dot + 1:))
         return
      end do
      message = "no histogram of '"//word//"'"
      hint = "write histogram(JOINT.impact_speed) or histogram(JOINT.peak_force) for a joint with clearance"
   end subroutine take_histogram

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
