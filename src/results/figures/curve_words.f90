!> Figures of curves: what their words name among the channels of a run.
!>
!> Every panel has an ordinate for one unit on the left and, if its channels have two, one on the right. Units and ends of axes
!> that are asked for go to the axis that they fit.
module curve_words
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use channels, only: list_scalars, match_word, selection_t
   use display_units, only: ask_unit, display_unit_t
   use figure_phrase, only: clause_t, mistake_t, phrase_t, set_mistake
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: axis_t, bind_curves, curves_t, find_scalar, panel_words_t, unit_of

   integer, parameter :: most_curves = 12                 !! of one panel
   character(*), parameter :: time_word = "time"          !! the usual abscissa

   !> An axis.
   type :: axis_t
      character(:), allocatable :: si       !! SI unit of what it shows; unallocated: there is no such axis
      type(display_unit_t) :: unit          !! unit asked for; without symbol: none
      logical :: has_range = .false.        !! whether its ends are asked for
      real(wp) :: range(2) = 0.0_wp         !! (2) its ends, SI [any]
   end type axis_t

   !> One panel.
   type :: panel_words_t
      integer :: first = 1                  !! first of its numbers among those of the figure
      integer :: last = 0                   !! last of them
      type(axis_t) :: y(2)                  !! (2) ordinates on the left and, if it has a unit, on the right
   end type panel_words_t

   !> Curves in panels.
   type :: curves_t
      type(panel_words_t), allocatable :: panels(:)  !! (n) from above to below
      logical, allocatable :: is_exact(:)            !! (numbers) named one by one: drawn however small it is
      integer :: abscissa = 0                        !! place of the abscissa among the numbers of the figure; 0: time
      type(axis_t) :: x                              !! the abscissa
   end type curves_t

contains

   !> Look up what the parts of a figure name.
   subroutine bind_curves(phrase, catalogue, scalars, curves, mistake)
      type(phrase_t), intent(in) :: phrase                    !! parts of the figure
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      type(scalar_t), allocatable, intent(out) :: scalars(:)  !! (n) curves by panel, then the abscissa if it is a channel
      type(curves_t), intent(out) :: curves                   !! panels and axes
      type(mistake_t), allocatable, intent(out) :: mistake    !! what is wrong

      type(axis_t) :: x(1)
      integer :: k

      allocate (scalars(0), curves%is_exact(0), curves%panels(size(phrase%panels)))
      do k = 1, size(phrase%panels)
         curves%panels(k)%first = size(scalars) + 1
         call take_words(phrase%panels(k), catalogue, scalars, curves%is_exact, mistake)
         if (allocated(mistake)) return
         curves%panels(k)%last = size(scalars)
         call find_axes(catalogue, scalars, phrase%panels(k)%words, curves%panels(k), mistake)
         if (allocated(mistake)) return
         call ask_axes(phrase%panels(k), curves%panels(k)%y, mistake)
         if (allocated(mistake)) return
      end do
      x(1)%si = "s"
      curves%x = x(1)
      if (size(phrase%against%words) == 0) return
      associate (word => phrase%against%words(1)%s)
         if (word /= time_word) then
            call find_scalar(word, catalogue, "an abscissa must be a single component, as in "//word//".x, or time", scalars, &
                             mistake)
            if (allocated(mistake)) return
            curves%abscissa = size(scalars)
            x(1)%si = unit_of(catalogue, scalars(curves%abscissa))
         end if
      end associate
      call ask_axes(phrase%against, x, mistake)
      curves%x = x(1)
   end subroutine bind_curves

   !> The numbers that one word names.
   subroutine find_numbers(word, catalogue, named, mistake)
      character(*), intent(in) :: word                        !! a word of the figure
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      type(scalar_t), allocatable, intent(out) :: named(:)    !! (any) what it names
      type(mistake_t), allocatable, intent(inout) :: mistake  !! what is wrong

      type(selection_t) :: selection
      character(:), allocatable :: hint, message

      call match_word(word, catalogue, selection, message, hint)
      named = list_scalars(selection)
      if (len(message) > 0) call set_mistake(mistake, message, hint, word)
   end subroutine find_numbers

   !> Append the one number that a word must name to a list.
   subroutine find_scalar(word, catalogue, hint, scalars, mistake)
      character(*), intent(in) :: word                           !! a word of the figure
      type(catalogue_t), intent(in) :: catalogue                 !! what can be recorded
      character(*), intent(in) :: hint                           !! what to write if it names several
      type(scalar_t), allocatable, intent(inout) :: scalars(:)   !! (n) grown
      type(mistake_t), allocatable, intent(inout) :: mistake     !! what is wrong

      type(scalar_t), allocatable :: named(:)

      call find_numbers(word, catalogue, named, mistake)
      if (allocated(mistake)) return
      if (size(named) /= 1) call set_mistake(mistake, "'"//word//"' is not a single number", hint, word)
      if (size(named) == 1) scalars = [scalars, named]
   end subroutine find_scalar

   !> The channels of a panel.
   subroutine take_words(clause, catalogue, scalars, is_exact, mistake)
      type(clause_t), intent(in) :: clause                       !! what the panel says
      type(catalogue_t), intent(in) :: catalogue                 !! what can be recorded
      type(scalar_t), allocatable, intent(inout) :: scalars(:)   !! (n) grown
      logical, allocatable, intent(inout) :: is_exact(:)         !! (n) grown
      type(mistake_t), allocatable, intent(inout) :: mistake  !! what is wrong

      type(scalar_t), allocatable :: named(:)
      integer :: before, k

      before = size(scalars)
      do k = 1, size(clause%words)
         call find_numbers(clause%words(k)%s, catalogue, named, mistake)
         if (allocated(mistake)) return
         if (size(named) == 0 .or. size(scalars) - before + size(named) > most_curves) then
            call set_mistake(mistake, "'"//clause%words(k)%s//"' names too many channels for one figure", &
                             "name an item and a channel, as in slider.velocity", clause%words(k)%s)
            return
         end if
         is_exact = [is_exact, spread(size(named) == 1, 1, size(named))]
         scalars = [scalars, named]
      end do
   end subroutine take_words

   !> The ordinates of a panel: one for each of at most two units.
   subroutine find_axes(catalogue, scalars, words, panel, mistake)
      type(catalogue_t), intent(in) :: catalogue              !! what can be recorded
      type(scalar_t), intent(in) :: scalars(:)                !! (n) numbers of the figure
      type(text_t), intent(in) :: words(:)                    !! (any) words that name those of the panel
      type(panel_words_t), intent(inout) :: panel             !! its axes are set
      type(mistake_t), allocatable, intent(inout) :: mistake  !! what is wrong

      character(:), allocatable :: si
      integer :: k

      panel%y(1)%si = unit_of(catalogue, scalars(panel%first))
      do k = panel%first + 1, panel%last
         si = unit_of(catalogue, scalars(k))
         if (si == panel%y(1)%si) cycle
         if (size(words) == 1) then
            call set_mistake(mistake, "'"//words(1)%s//"' names channels of different units", &
                             "one figure word names channels of one unit; A + B draws two units, panels(A, B, C) more", words(1)%s)
            return
         end if
         if (.not. allocated(panel%y(2)%si)) panel%y(2)%si = si
         if (si == panel%y(2)%si) cycle
         call set_mistake(mistake, "'"//scalar_name(catalogue, scalars(k))//"' has another unit ("//si// &
                          ") than the channels before it ("//panel%y(1)%si//", "//panel%y(2)%si//")", &
                          "one plot has axes for two units; panels(A, B, C) draws more, stacked", &
                          scalar_name(catalogue, scalars(k)))
         return
      end do
   end subroutine find_axes

   !> Units and ends that are asked for, each for the axis that it fits.
   subroutine ask_axes(clause, axes, mistake)
      type(clause_t), intent(in) :: clause                    !! what is asked for
      type(axis_t), intent(inout) :: axes(:)                  !! (1 or 2) the axes; one without a unit is not there
      type(mistake_t), allocatable, intent(inout) :: mistake  !! what is wrong

      type(display_unit_t) :: shown
      real(wp) :: low, high
      character(:), allocatable :: usual
      integer :: at, i, k

      usual = ""
      do k = 1, size(clause%units)
         call fit(clause%units(k)%s, at, shown)
         if (allocated(mistake)) return
         axes(at)%unit = shown
         usual = clause%units(k)%s
      end do
      do i = 1, size(clause%limits)
         associate (limits => clause%limits(i))
            if (len(limits%low_unit//limits%high_unit) == 0 .and. len(usual) == 0 .and. axes(1)%si /= "1") then
               call set_mistake(mistake, "missing unit of the axis limits", &
                                "write them with a unit for "//axes(1)%si//", or write in UNIT before them", "from")
               return
            end if
            if (len(limits%low_unit//limits%high_unit) == 0 .and. len(usual) == 0) usual = "1"
            call fit(first_of(limits%low_unit, limits%high_unit, usual), at, shown)
            if (allocated(mistake)) return
            low = limits%low/shown%factor
            call fit(first_of(limits%high_unit, limits%low_unit, usual), k, shown)
            if (allocated(mistake)) return
            high = limits%high/shown%factor
            if (k /= at .or. .not. high > low) then
               call set_mistake(mistake, "the axis limits "//trim(merge("have different dimensions", "do not increase          ", &
                                k /= at)), "write the lower limit first, as in from 0 mm to 20 mm", "from")
               return
            end if
            axes(at)%range = [low, high]
            axes(at)%has_range = .true.
         end associate
      end do

   contains

      !> The axis that a unit fits.
      subroutine fit(name, at, shown)
         character(*), intent(in) :: name                 !! the unit, as written
         integer, intent(out) :: at                       !! number of the axis
         type(display_unit_t), intent(out) :: shown       !! the unit

         character(:), allocatable :: first, trouble

         first = ""
         do at = 1, size(axes)
            if (.not. allocated(axes(at)%si)) cycle
            call ask_unit(name, axes(at)%si, shown, trouble)
            if (len(trouble) == 0) return
            if (at == 1) first = trouble
         end do
         call set_mistake(mistake, first, "the quantity of this axis has the unit "//axes(1)%si, name)
         at = 1
      end subroutine fit

   end subroutine ask_axes

   !> The first of three words that is not blank.
   pure function first_of(a, b, c) result(word)
      character(*), intent(in) :: a          !! a word
      character(*), intent(in) :: b          !! another
      character(*), intent(in) :: c          !! a third
      character(:), allocatable :: word      !! one of them

      word = c
      if (len(b) > 0) word = b
      if (len(a) > 0) word = a
   end function first_of

   !> The unit of a number.
   pure function unit_of(catalogue, scalar) result(unit)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded
      type(scalar_t), intent(in) :: scalar        !! the number
      character(:), allocatable :: unit           !! as in files

      unit = catalogue%groups(scalar%group)%channel%unit
   end function unit_of

end module curve_words
