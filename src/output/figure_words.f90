!> The deck's words for figures, and the channels that each of them needs.
!>
!> `slider.velocity`, `guide.penetration`, `energy.*`: time histories of channels of one unit.
!> `gudgeon.orbit`: path of the journal in its clearance. `portrait(slider.velocity.x,slider.acceleration.x)`:
!> the second over the first.
module figure_words
   use catalogue, only: catalogue_t, room_clearances
   use channel_names, only: item_name, scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use kinds, only: wp
   use text, only: join, nearest_word, starts_with, text_t
   use text_writer, only: extra_table_t
   implicit none (type, external)
   private
   public :: add_figure_channels, check_figures, extra_tables, figure_t, new_figure
   public :: figure_history, figure_orbit, figure_portrait

   integer, parameter :: figure_history = 1   !! channels over time
   integer, parameter :: figure_orbit = 2     !! eccentricity, y over x
   integer, parameter :: figure_portrait = 3  !! one channel over another
   integer, parameter :: most_curves = 12     !! of one figure
   character(*), parameter :: portrait_word = "portrait("  !! how a portrait begins
   character(*), parameter :: orbit_word = ".orbit"        !! how an orbit ends

   !> One figure.
   type :: figure_t
      integer :: kind = figure_history              !! one of the above
      character(:), allocatable :: word             !! as in the deck
      character(:), allocatable :: name             !! of its files: letters, digits, `_`, `-` and dots
      type(scalar_t), allocatable :: scalars(:)     !! (n) curves; of an orbit its coordinates; of a portrait x and y
      integer :: joint = 0                          !! of an orbit: number of the clearance joint
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
      if (starts_with(word, portrait_word)) then
         call new_portrait(word, catalogue, figure, message, hint)
      else if (len(word) > len(orbit_word) .and. index(word, orbit_word, back=.true.) == &
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
         hint = hint//"; figures are a channel, JOINT.orbit and portrait(CHANNEL,CHANNEL)"
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

   !> One channel over another.
   subroutine new_portrait(word, catalogue, figure, message, hint)
      character(*), intent(in) :: word                       !! a word of the deck
      type(catalogue_t), intent(in) :: catalogue             !! what can be recorded
      type(figure_t), intent(inout) :: figure                !! the figure
      character(:), allocatable, intent(inout) :: message    !! what is wrong, blank if nothing
      character(:), allocatable, intent(inout) :: hint       !! what may have been meant, may be blank

      type(selection_t) :: named
      type(scalar_t), allocatable :: scalars(:)
      integer :: comma, first, k, last

      figure%kind = figure_portrait
      allocate (figure%scalars(2))
      comma = index(word, ",")
      if (comma == 0 .or. word(len(word):) /= ")") then
         message = "cannot read '"//word//"'"
         hint = "write portrait(x_channel,y_channel) without blanks"
         return
      end if
      do k = 1, 2
         first = merge(len(portrait_word) + 1, comma + 1, k == 1)
         last = merge(comma - 1, len(word) - 1, k == 1)
         call match_word(word(first:last), catalogue, named, message, hint)
         if (len(message) > 0) return
         scalars = list_scalars(named)
         if (size(scalars) == 1) then
            figure%scalars(k) = scalars(1)
         else
            message = "'"//word(first:last)//"' is not one number"
            hint = "a portrait needs single components, as in "//word(first:last)//".x"
            return
         end if
      end do
   end subroutine new_portrait

   !> Add the channels that figures need to a selection.
   subroutine add_figure_channels(figures, selection)
      type(figure_t), intent(in) :: figures(:)         !! (n) figures
      type(selection_t), intent(inout) :: selection    !! channels that are kept

      integer :: i, k

      do k = 1, size(figures)
         do i = 1, size(figures(k)%scalars)
            associate (this => figures(k)%scalars(i))
               selection%groups(this%group)%mask(this%component, this%item) = .true.
            end associate
         end do
      end do
   end subroutine add_figure_channels

   !> Tables for portraits whose channels are not in the same file.
   function extra_tables(figures, catalogue) result(tables)
      type(figure_t), intent(in) :: figures(:)          !! (n) figures
      type(catalogue_t), intent(in) :: catalogue        !! what can be recorded
      type(extra_table_t), allocatable :: tables(:)     !! (n) tables

      logical :: apart(size(figures))
      integer :: k, n

      apart = .false.
      do k = 1, size(figures)
         if (figures(k)%kind /= figure_portrait) cycle
         apart(k) = file_of(figures(k)%scalars(1), catalogue) /= file_of(figures(k)%scalars(2), catalogue)
      end do
      allocate (tables(count(apart)))
      n = 0
      do k = 1, size(figures)
         if (.not. apart(k)) cycle
         n = n + 1
         tables(n)%name = "figures/"//figures(k)%name
         tables(n)%columns = figures(k)%scalars
      end do
   end function extra_tables

   !> Name of the item in whose file a number is.
   pure function file_of(scalar, catalogue) result(name)
      type(scalar_t), intent(in) :: scalar        !! the number
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      character(:), allocatable :: name           !! of the item

      name = item_name(catalogue, catalogue%groups(scalar%group)%room, scalar%item)
   end function file_of

end module figure_words
