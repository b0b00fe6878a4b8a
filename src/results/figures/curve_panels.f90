!> What the panels of a figure of curves draw: which curves on which ordinate, in which units, with which labels.
module curve_panels
   use catalogue, only: catalogue_t
   use curve_words, only: axis_t, panel_words_t
   use display_units, only: choose_unit, display_unit_t, fitted_unit
   use figure_data, only: curve_t, is_visible
   use figure_words, only: figure_t
   use kinds, only: wp
   use round_values, only: round_value, round_value_t
   use script_parts, only: axes_t, largest, with_unit
   use text, only: replace, text_t
   implicit none (type, external)
   private
   public :: drawn_panels, fit_abscissa, fit_side, make_panel, panel_t, range_of, shows_nothing

   real(wp), parameter :: late = 1.0e-3_wp          !! minimum extent of a time axis, of the times [1]
   integer, parameter :: most_overlaid = 3          !! more curves are drawn without those of the reference run with ideal joints

   !> A panel as it is drawn.
   type :: panel_t
      type(curve_t), allocatable :: curves(:)   !! (n) of the run
      integer, allocatable :: side(:)           !! (n) 1: their ordinate is on the left, 2: on the right
      type(curve_t), allocatable :: ideal(:)    !! (m) of the reference run
      integer, allocatable :: ideal_side(:)     !! (m) where their ordinate is
      type(display_unit_t) :: unit(2)           !! (2) of the ordinates
      real(wp) :: less(2) = 0.0_wp              !! (2) what is taken from them, SI [any]
      type(text_t) :: quantity(2)               !! (2) what the ordinates show
      type(text_t) :: beyond(2)                 !! (2) what is taken from them, in words; blank: nothing
      character(:), allocatable :: label        !! of the ordinate on the left
      character(:), allocatable :: right_label  !! of that on the right; blank: there is none
   end type panel_t

contains

   !> What a panel draws.
   subroutine make_panel(figure, catalogue, words, curves, ideal, panel)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      type(panel_words_t), intent(in) :: words    !! what the panel is to show
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)       !! (m) curves of the reference run
      type(panel_t), intent(out) :: panel         !! the panel

      logical :: own(size(curves))
      integer :: k, side

      panel%right_label = ""
      allocate (panel%side(0), panel%curves(0), panel%ideal(0), panel%ideal_side(0))
      do side = 1, 2
         own = is_member(figure, catalogue, words, side, curves%number)
         if (.not. any(own)) cycle
         call take_side(pack([(k, k=1, size(curves))], own))
      end do
      if (size(panel%curves) <= most_overlaid) then
         do k = 1, size(ideal)
            do side = 1, size(panel%curves)
               if (panel%curves(side)%number /= ideal(k)%number) cycle
               panel%ideal = [panel%ideal, ideal(k)]
               panel%ideal_side = [panel%ideal_side, panel%side(side)]
            end do
         end do
      end if
      if (.not. allocated(panel%label)) panel%label = ""
      do side = 1, 2
         if (any(panel%side == side)) call fit_side(panel, words%y(side), side, range_of(panel, side))
      end do

   contains

      !> The curves of one ordinate; components too small to be seen are omitted, unless they were named one by one.
      subroutine take_side(list)
         integer, intent(in) :: list(:)  !! (any) numbers of curves

         type(curve_t) :: mine(size(list))
         logical, allocatable :: visible(:)
         integer :: i

         do i = 1, size(list)
            mine(i) = curves(list(i))
         end do
         visible = is_visible(mine)
         do i = 1, size(list)
            if (.not. (visible(i) .or. figure%curves%is_exact(mine(i)%number))) cycle
            panel%curves = [panel%curves, mine(i)]
            panel%side = [panel%side, side]
         end do
         panel%quantity(side)%s = name_of(list)
      end subroutine take_side

      !> The quantities of some curves, if they are few.
      function name_of(list) result(name)
         integer, intent(in) :: list(:)          !! (any) numbers of curves
         character(:), allocatable :: name       !! as `velocity`

         character(:), allocatable :: one
         integer :: i

         name = ""
         do i = 1, size(list)
            one = replace(catalogue%groups(figure%scalars(curves(list(i))%number)%group)%channel%name, "_", " ")
            one = replace(one, ".", " ")
            if (i == 1) name = one
            if (index(", "//name//",", ", "//one//",") > 0) cycle
            name = name//", "//one
         end do
         if (len(name) <= 40) return
         name = ""
         if (words%y(side)%si == "J") name = "energy"
      end function name_of

   end subroutine make_panel

   !> Unit and name of an ordinate, by the maximum of what it shows. Of a narrow one what differs from a round value is drawn, in
   !> the unit that is asked for or in one that fits it.
   subroutine fit_side(panel, axis, side, range)
      type(panel_t), intent(inout) :: panel        !! the panel
      type(axis_t), intent(in) :: axis             !! what is asked of the ordinate
      integer, intent(in) :: side                  !! 1 left, 2 right
      real(wp), intent(in) :: range(2)             !! (2) minimum and maximum value shown, if no ends are asked for, SI [any]

      type(display_unit_t) :: unit
      type(round_value_t) :: less
      character(:), allocatable :: label
      real(wp) :: ends(2)

      ends = range
      if (axis%has_range) ends = [minval(axis%range), maxval(axis%range)]
      unit = axis%unit
      if (.not. allocated(unit%symbol)) unit = choose_unit(axis%si, largest(ends))
      call take_round_value(axis, ends, unit, less)
      panel%unit(side) = unit
      panel%less(side) = less%value
      panel%beyond(side)%s = less%words
      label = with_unit(adjustl(panel%quantity(side)%s//less%words), unit)
      if (side == 1) then
         panel%label = label
      else
         panel%right_label = label
      end if
   end subroutine fit_side

   !> What a narrow axis takes from its numbers, and the unit of what is left: the one that is asked for, or one that fits.
   subroutine take_round_value(axis, ends, unit, less)
      type(axis_t), intent(in) :: axis             !! what is asked of it
      real(wp), intent(in) :: ends(2)              !! (2) of what it shows, SI [any]
      type(display_unit_t), intent(inout) :: unit  !! of its numbers, then of what is left of them
      type(round_value_t), intent(out) :: less     !! what is taken

      less = round_value(ends, unit)
      if (len(less%words) == 0) return
      if (allocated(axis%unit%symbol)) then
         unit = fitted_unit(unit, largest(ends - less%value))
      else
         unit = choose_unit(axis%si, largest(ends - less%value))
      end if
   end subroutine take_round_value

   !> Unit and name of the abscissa. A narrow one of a channel shows what differs from a round value, as ordinates do; a late time
   !> has ticks with all their digits.
   subroutine fit_abscissa(axis, name, curves, window, axes, label)
      type(axis_t), intent(in) :: axis               !! what is asked of it
      character(*), intent(in) :: name               !! of the channel; blank: it is the time
      type(curve_t), intent(in) :: curves(:)         !! (n) what it shows
      real(wp), intent(in) :: window(2)              !! (2) its ends, SI [any]
      type(axes_t), intent(out) :: axes              !! scales of a figure: the abscissa is set
      character(:), allocatable, intent(out) :: label  !! what stands below it

      type(round_value_t) :: less

      axes%x = shown(axis, curves)
      label = "time"
      if (name /= "") then
         call take_round_value(axis, [minval(window), maxval(window)], axes%x, less)
         axes%less_x = less%value
         label = name//less%words
      end if
      label = with_unit(label, axes%x)
   end subroutine fit_abscissa

   !> Whether all curves of an axis lie beyond the ends that are asked for.
   pure logical function shows_nothing(figure, catalogue, curves)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run

      logical :: own(size(curves))
      integer :: k, side

      shows_nothing = .false.
      if (size(curves) == 0) return
      associate (asked => figure%curves)
         if (asked%x%has_range) then
            shows_nothing = all(is_apart(curves%x_range(1), curves%x_range(2), asked%x%range))
         end if
         do k = 1, size(asked%panels)
            do side = 1, 2
               if (.not. asked%panels(k)%y(side)%has_range) cycle
               own = is_member(figure, catalogue, asked%panels(k), side, curves%number)
               if (.not. any(own)) cycle
               shows_nothing = shows_nothing .or. all(is_apart(pack(curves%y_range(1), own), pack(curves%y_range(2), own), &
                                                               asked%panels(k)%y(side)%range))
            end do
         end do
      end associate
   end function shows_nothing

   !> The panels of a figure that have a curve.
   function drawn_panels(figure, catalogue, curves) result(list)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run
      integer, allocatable :: list(:)             !! (any) their numbers

      integer :: k

      allocate (list(0))
      do k = 1, size(figure%curves%panels)
         associate (words => figure%curves%panels(k))
            if (any(is_member(figure, catalogue, words, 1, curves%number)) .or. &
                any(is_member(figure, catalogue, words, 2, curves%number))) list = [list, k]
         end associate
      end do
   end function drawn_panels

   !> Whether what a curve reaches and what an axis shows have nothing in common.
   pure function is_apart(low, high, range)
      real(wp), intent(in) :: low(:)        !! (n) minimum values [any]
      real(wp), intent(in) :: high(:)       !! (n) maximum values [any]
      real(wp), intent(in) :: range(2)      !! (2) ends of the axis [any]
      logical :: is_apart(size(low))        !! (n) whether it is so

      is_apart = high < minval(range) .or. low > maxval(range)
   end function is_apart

   !> Whether a number of a figure belongs to an ordinate of a panel.
   elemental logical function is_member(figure, catalogue, words, side, number)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      type(panel_words_t), intent(in) :: words    !! what the panel is to show
      integer, intent(in) :: side                 !! 1 left, 2 right
      integer, intent(in) :: number               !! of the curve in the figure

      is_member = .false.
      if (.not. allocated(words%y(side)%si)) return
      if (number < words%first .or. number > words%last) return
      is_member = catalogue%groups(figure%scalars(number)%group)%channel%unit == words%y(side)%si
   end function is_member

   !> The unit of the abscissa.
   function shown(axis, curves) result(unit)
      type(axis_t), intent(in) :: axis               !! what is asked of it
      type(curve_t), intent(in) :: curves(:)         !! (n) what it shows
      type(display_unit_t) :: unit                   !! its unit

      real(wp) :: extent

      unit = axis%unit
      if (allocated(unit%symbol)) return
      if (axis%has_range) then
         extent = largest(axis%range)
      else
         extent = max(largest(curves(1)%x_range), 0.0_wp)
         if (axis%si == "s") extent = max(curves(1)%x_range(2) - curves(1)%x_range(1), late*extent)
      end if
      unit = choose_unit(axis%si, extent)
   end function shown

   !> Minimum and maximum value of an ordinate, curves of the reference run among them.
   pure function range_of(panel, side) result(range)
      type(panel_t), intent(in) :: panel  !! the panel
      integer, intent(in) :: side         !! 1 left, 2 right
      real(wp) :: range(2)                !! (2) SI [any]

      range(1) = min(minval(pack(panel%curves%y_range(1), panel%side == side)), &
                     minval(pack(panel%ideal%y_range(1), panel%ideal_side == side)))
      range(2) = max(maxval(pack(panel%curves%y_range(2), panel%side == side)), &
                     maxval(pack(panel%ideal%y_range(2), panel%ideal_side == side)))
   end function range_of

end module curve_panels
