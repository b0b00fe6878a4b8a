!> The gnuplot script of curves over the time or over another channel, in one panel or several.
!>
!> A curve that turns more often than the picture has columns is drawn as the range that it fills and its mean (`envelope_data`).
!> Curves of the reference run with ideal joints are thin and dashed; where they are flat beside the run's, a second panel shows
!> their scale.
module curve_script
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use curve_panels, only: drawn_panels, fit_abscissa, fit_side, make_panel, panel_t, range_of
   use curve_words, only: axis_t, panel_words_t
   use display_units, only: display_unit_t, fitted_unit
   use envelope_data, only: envelope_t
   use figure_data, only: curve_t
   use figure_words, only: figure_t
   use kinds, only: wp
   use panel_cells, only: cell_heights, cell_words, picture_height
   use plot_text, only: quoted
   use script_parts, only: angle_tics, axes_t, axis_range, colours, edges, find_long_tics, hangs_from_zero, ideal_colour, &
      label_words, largest, largest_y, line_source, preamble, stands_on_zero
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: curve_text

   real(wp), parameter :: peak_ratio = 20.0_wp      !! beyond this the ideal curve gets a panel of its own [1]
   real(wp), parameter :: flat_ratio = 1.0e-9_wp    !! an ideal curve this flat needs none [1]
   real(wp), parameter :: zoom_margin = 0.6_wp      !! beyond the ideal curve in that panel, of its span [1]
   integer, parameter :: heights(6) = [800, 1000, 1200, 1400, 1600, 1800]  !! of pictures with so many panels, in units of layout

   character(*), parameter :: ideal_dashes(3) = [character(20) :: "dashtype (12,8)", "dashtype (3,5)", "dashtype (12,5,2,5)"]
      !! of curves of the reference run
   character(*), parameter :: range_style = " with filledcurves fillstyle transparent solid 0.35 noborder"  !! of an envelope

contains

   !> The whole script, blank if there is nothing to draw.
   function curve_text(figure, catalogue, title, curves, ideal, window, envelope) result(script)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      character(*), intent(in) :: title           !! of the scene, any text
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)       !! (m) curves of the reference run with ideal joints, perhaps none
      real(wp), intent(in) :: window(2)           !! (2) ends of the abscissa, SI [any]
      type(envelope_t), intent(in) :: envelope    !! ranges of curves that turn too often
      character(:), allocatable :: script         !! lines for gnuplot

      type(panel_t), allocatable :: panels(:)
      type(axes_t) :: axes
      type(buffer_t) :: lines
      character(:), allocatable :: format, label, name
      integer, allocatable :: cells(:), place(:)
      integer :: k, n
      logical :: with_zoom

      script = ""
      if (size(curves) == 0) return
      place = drawn_panels(figure, catalogue, curves)
      n = size(place)
      allocate (panels(n))
      do k = 1, n
         call make_panel(figure, catalogue, figure%curves%panels(place(k)), curves, ideal, panels(k))
      end do
      with_zoom = n == 1
      if (with_zoom) with_zoom = .not. any(figure%curves%panels(place(1))%y%has_range)
      if (with_zoom) with_zoom = needs_zoom(panels(1))
      cells = [heights(merge(2, 1, with_zoom))]
      if (n > 1) cells = cell_heights(panels, envelope, heights(n))
      call preamble(lines, figure%name, 1200, merge(picture_height(cells), cells(1), n > 1))
      name = ""
      if (figure%curves%abscissa > 0) name = scalar_name(catalogue, figure%scalars(figure%curves%abscissa))
      call fit_abscissa(figure%curves%x, name, curves, window, axes, label)
      if (n > 1 .or. with_zoom) then
         call lines%line("set lmargin at screen 0.12; set rmargin at screen "// &
                         trim(merge("0.89 ", "0.95 ", any([(len(panels(k)%right_label) > 0, k=1, n)]))))
         call lines%line("set multiplot "//trim(merge("layout 2,1 title", "title           ", with_zoom))//" "//quoted(title)// &
                         " font ',17'")
      else
         call lines%line("set title "//quoted(title)//" font ',17'")
      end if
      call abscissa_lines(lines, axes, window, format)
      if (n > 1) call lines%line("unset xlabel; set format x ''")
      do k = 1, n
         if (n > 1) call lines%line(cell_words(cells, k))
         if (k == n) call lines%line("set xlabel "//quoted(label)//"; set format x '"//format//"'")
         call panel_lines(lines, figure%curves%panels(place(k)), panels(k), axes, envelope, n)
      end do
      if (with_zoom) call zoom_lines(lines, figure%curves%panels(place(1)), panels(1), axes, envelope)
      if (n > 1 .or. with_zoom) call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()
   end function curve_text

   !> The abscissa, which all panels have in common; it ends where the run does, also where its reference run continues.
   subroutine abscissa_lines(lines, axes, window, format)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(axes_t), intent(in) :: axes            !! its unit, and what is taken from it
      real(wp), intent(in) :: window(2)           !! (2) its ends, SI [any]
      character(:), allocatable, intent(out) :: format !! of the numbers of its ticks

      character(:), allocatable :: distance
      real(wp) :: range(2)

      range = axes%x%factor*(window - axes%less_x)
      if (abs(range(2) - range(1)) > 0.0_wp) then
         call lines%line("set xrange ["//real_text(range(1), 9)//":"//real_text(range(2), 9)//"]")
      else
         call lines%line("set autoscale xfix")
      end if
      call angle_lines(lines, "x", axes%x, range(2) - range(1), 1)
      call find_long_tics(range, distance, format)
      if (len(distance) == 0 .or. axes%x%symbol == "deg") then
         format = "%h"
      else
         call lines%line("set xtics "//distance)
      end if
   end subroutine abscissa_lines

   !> Ticks of an axis in degrees.
   subroutine angle_lines(lines, axis, unit, span, n)
      type(buffer_t), intent(inout) :: lines      !! the script
      character(*), intent(in) :: axis            !! x, y or y2
      type(display_unit_t), intent(in) :: unit    !! its unit
      real(wp), intent(in) :: span                !! what it shows [the unit]
      integer, intent(in) :: n                    !! panels that share its length

      if (unit%symbol /= "deg") return
      if (angle_tics(span, n) > 0) call lines%line("set "//axis//"tics "//to_text(angle_tics(span, n)))
   end subroutine angle_lines

   !> One panel.
   subroutine panel_lines(lines, words, panel, scales, envelope, n)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(panel_words_t), intent(in) :: words    !! what it is to show
      type(panel_t), intent(in) :: panel          !! what it draws
      type(axes_t), intent(in) :: scales          !! with the abscissa
      type(envelope_t), intent(in) :: envelope    !! ranges of curves that turn too often
      integer, intent(in) :: n                    !! panels of the figure

      call lines%line("set ylabel "//label_words(panel%label, heights(n)/n))
      call lines%line("set offsets 0, 0, "//edges(range_of(panel, 1), "0.05"))
      call ordinate_lines("y", 1)
      if (len(panel%right_label) > 0) then
         call lines%line("set y2label "//label_words(panel%right_label, heights(n)/n))
         call lines%line("set y2tics nomirror textcolor rgb '#000000'")
         call ordinate_lines("y2", 2)
      else
         call lines%line("unset y2label; unset y2tics")
      end if
      call plot_lines(lines, panel, scales, envelope)

   contains

      !> Ends and ticks of an ordinate.
      subroutine ordinate_lines(axis, side)
         character(*), intent(in) :: axis  !! y or y2
         integer, intent(in) :: side       !! 1 left, 2 right

         real(wp) :: ends(2)

         associate (asked => words%y(side), unit => panel%unit(side))
            if (.not. any(panel%side == side)) return
            if (asked%has_range) then
               ends = unit%factor*(asked%range - panel%less(side))
               call lines%line("set "//axis//"range ["//real_text(ends(1), 9)//":"//real_text(ends(2), 9)//"]")
            else
               ends = unit%factor*(range_of(panel, side) - panel%less(side))
               call lines%line("set "//axis//"range "//axis_range(ends))
            end if
            call lines%line("set "//axis//"tics autofreq")
            call angle_lines(lines, axis, unit, ends(2) - ends(1), n)
            if (asked%si == "1" .and. panel%label == "state") call lines%line("set "//axis//"tics 1")
         end associate
      end subroutine ordinate_lines

   end subroutine panel_lines

   !> The same on the scale of the ideal joints.
   subroutine zoom_lines(lines, words, panel, scales, envelope)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(panel_words_t), intent(in) :: words    !! what the panel above is to show
      type(panel_t), intent(in) :: panel          !! what the panel above draws
      type(axes_t), intent(in) :: scales          !! with the abscissa
      type(envelope_t), intent(in) :: envelope    !! ranges of curves that turn too often

      type(axis_t) :: axis
      type(panel_t) :: zoom
      real(wp) :: all(2), ends(2), ideal(2), span

      ideal = [minval(panel%ideal%y_range(1)), maxval(panel%ideal%y_range(2))]
      span = ideal(2) - ideal(1)
      ends = ideal + [-zoom_margin*span, zoom_margin*span]
      all = range_of(panel, 1)
      if (stands_on_zero(all) .and. ideal(1) >= 0.0_wp) ends(1) = max(0.0_wp, ends(1))  ! beside high peaks what is below is nothing
      if (hangs_from_zero(all) .and. ideal(2) <= 0.0_wp) ends(2) = min(0.0_wp, ends(2))
      call lines%line("set title 'zoom on the ideal curves' font ',14'")
      zoom = panel
      axis = words%y(1)
      if (allocated(axis%unit%symbol)) axis%unit = fitted_unit(axis%unit, largest(ends))
      call fit_side(zoom, axis, 1, ends)
      call lines%line("set ylabel "//label_words(zoom%label, heights(2)/2))
      ends = zoom%unit(1)%factor*(ends - zoom%less(1))
      call lines%line("set yrange ["//real_text(ends(1), 9)//":"//real_text(ends(2), 9)//"]")
      call lines%line("set ytics autofreq")
      call angle_lines(lines, "y", zoom%unit(1), ends(2) - ends(1), 2)
      call plot_lines(lines, zoom, scales, envelope)
   end subroutine zoom_lines

   !> Whether the ideal curve would be a flat line beside the peaks of the run.
   pure logical function needs_zoom(panel)
      type(panel_t), intent(in) :: panel  !! what is drawn

      real(wp) :: span

      needs_zoom = .false.
      if (size(panel%ideal) == 0 .or. any(panel%side == 2)) return
      span = maxval(panel%ideal%y_range(2)) - minval(panel%ideal%y_range(1))
      needs_zoom = largest_y(panel%curves) > peak_ratio*largest_y(panel%ideal) .and. span > flat_ratio*largest_y(panel%curves)
   end function needs_zoom

   !> The plot command: the run's curves, then those of the reference run over them.
   subroutine plot_lines(lines, panel, scales, envelope)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(panel_t), intent(in) :: panel          !! what is drawn
      type(axes_t), intent(in) :: scales          !! with the abscissa
      type(envelope_t), intent(in) :: envelope    !! ranges of curves that turn too often

      type(axes_t) :: axes
      character(:), allocatable :: colour, name, on
      integer :: k, n, place

      axes = scales
      n = size(panel%curves) + size(panel%ideal)
      do k = 1, size(panel%curves)
         axes%y = panel%unit(panel%side(k))
         axes%less = panel%less(panel%side(k))
         colour = colours(mod(k - 1, size(colours)) + 1)
         name = panel%curves(k)%name
         on = ""
         if (len(panel%right_label) > 0) then
            on = trim(merge(" axes x1y2", "          ", panel%side(k) == 2))
            name = name//trim(merge(" (right)", "        ", panel%side(k) == 2))
         end if
         place = envelope%place(panel%curves(k)%number)
         call lines%add(merge("plot ", "     ", k == 1))
         if (place == 0) then
            call lines%add(line_source(panel%curves(k), axes, on, "linewidth 2", colour, "title "//quoted(name)))
         else
            colour = " linecolor rgb '"//colour//"'"
            call lines%line(envelope%range_source(place, axes)//on//range_style//colour//" title "// &
                            quoted(name//", range")//", \")
            call lines%add("     "//envelope%mean_source(place, axes)//on//" with lines linewidth 2"//colour//" title 'mean'")
         end if
         call lines%line(trim(merge(", \", "   ", k < n)))
      end do
      do k = 1, size(panel%ideal)
         axes%y = panel%unit(panel%ideal_side(k))
         axes%less = panel%less(panel%ideal_side(k))
         on = trim(merge(" axes x1y2", "          ", panel%ideal_side(k) == 2))
         name = "ideal joints"
         if (size(panel%ideal) > 1) name = panel%ideal(k)%name//", ideal joints"
         call lines%line("     "//line_source(panel%ideal(k), axes, on, "linewidth 1.2 "//trim(ideal_dashes(modulo(k - 1, &
                         size(ideal_dashes)) + 1)), ideal_colour, "title "//quoted(name))// &
                         trim(merge(", \", "   ", size(panel%curves) + k < n)))
      end do
   end subroutine plot_lines

end module curve_script
