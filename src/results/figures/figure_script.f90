!> The gnuplot script of an orbit or a portrait. It reads the `.dat` files beside its folder by column number and
!> writes the picture next to itself, so that it can be edited and run again there.
module figure_script
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use display_units, only: choose_unit
   use figure_data, only: curve_t
   use figure_words, only: figure_orbit, figure_t
   use orbit_script, only: orbit_lines
   use plot_text, only: quoted
   use kinds, only: wp
   use path_data, only: path_t
   use round_values, only: round_value, round_value_t
   use script_parts, only: axes_t, axis_range, colours, hangs_from_zero, ideal_style, largest, path_source, preamble, source, &
      stands_on_zero, with_unit
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: figure_text

   integer, parameter :: most_turns = 60        !! beyond them the line of a portrait is thin
   real(wp), parameter :: one_unit = 30.0_wp    !! axes of one quantity whose extents differ by less have one unit [1]

contains

   !> The whole script of a figure, blank if there is nothing to draw.
   function figure_text(figure, catalogue, title, curves, ideal, n_turn, thinned) result(script)
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      character(*), intent(in) :: title           !! of the scene, any text
      type(curve_t), intent(in) :: curves(:)      !! (n) curves of the run
      type(curve_t), intent(in) :: ideal(:)       !! (m) curves of the reference run with ideal joints, perhaps none
      integer, intent(in) :: n_turn               !! turns of the first curve, small wiggles apart
      type(path_t), intent(in) :: thinned         !! the path, if the run's own table has too many points
      character(:), allocatable :: script         !! lines for gnuplot

      type(buffer_t) :: lines

      script = ""
      if (size(curves) == 0) return
      select case (figure%kind)
      case (figure_orbit)
         if (size(curves) < 2) return
         call orbit_lines(lines, figure, catalogue, title, curves, thinned)
      case default
         call portrait_lines(lines, figure, catalogue, title, curves, ideal, n_turn > most_turns, thinned)
      end select
      script = lines%get()
   end function figure_text

   !> One channel over another.
   subroutine portrait_lines(lines, figure, catalogue, title, curves, ideal, is_thin, thinned)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      character(*), intent(in) :: title           !! of the scene, any text
      type(curve_t), intent(in) :: curves(:)      !! (1) curve of the run
      type(curve_t), intent(in) :: ideal(:)       !! (0 or 1) curve of the reference run
      logical, intent(in) :: is_thin              !! many turns lie one over the other
      type(path_t), intent(in) :: thinned         !! the path, if the run's own table has too many points

      type(axes_t) :: axes
      character(:), allocatable :: own, width
      real(wp) :: x(2), y(2)

      x = [min(curves(1)%x_range(1), minval(ideal%x_range(1))), max(curves(1)%x_range(2), maxval(ideal%x_range(2)))]
      y = [min(curves(1)%y_range(1), minval(ideal%y_range(1))), max(curves(1)%y_range(2), maxval(ideal%y_range(2)))]
      call preamble(lines, figure%name, 1200, 800)
      call choose_axes()
      call lines%line("set xrange "//axis_range(axes%x%factor*x))
      call lines%line("set yrange "//axis_range(axes%y%factor*y))
      call lines%line("set offsets "//room(stands_on_zero(x), "0.03")//", "//room(hangs_from_zero(x), "0.03")//", "// &
                      room(hangs_from_zero(y), "0.05")//", "//room(stands_on_zero(y), "0.05"))
      call lines%line("set title "//quoted(title)//" font ',17'")
      width = trim(merge("0.8", "2  ", is_thin))
      own = trim(merge("title 'with clearance'", "notitle               ", size(ideal) > 0))
      if (thinned%is_used) then
         call lines%add("plot "//path_source(curves(1), axes, thinned, own))
      else
         call lines%add("plot "//source(curves(1), axes)//" with lines linewidth "//width// &
                        " linecolor rgb '"//colours(1)//"' "//own)
      end if
      if (size(ideal) == 0) then
         call lines%line("")
      else
         call lines%line(", \")
         call lines%line("     "//source(ideal(1), axes)//ideal_style//"title 'ideal joints'")
      end if
      call lines%line("unset output")

   contains

      !> Units and names of the axes; of what differs little, what it is beyond a round value.
      subroutine choose_axes()
         type(round_value_t) :: less_x, less_y
         real(wp) :: extent(2)

         associate (x_unit => catalogue%groups(figure%scalars(1)%group)%channel%unit, &
                    y_unit => catalogue%groups(figure%scalars(2)%group)%channel%unit)
            less_x = round_value(x, choose_unit(x_unit, largest(x)))
            less_y = round_value(y, choose_unit(y_unit, largest(y)))
            x = x - less_x%value
            y = y - less_y%value
            extent = [largest(x), largest(y)]
            if (x_unit == y_unit .and. maxval(extent) < one_unit*minval(extent)) extent = maxval(extent)
            axes = axes_t(choose_unit(x_unit, extent(1)), choose_unit(y_unit, extent(2)), less_x%value, less_y%value)
         end associate
         call lines%line("set xlabel "//quoted(with_unit(scalar_name(catalogue, figure%scalars(1))//less_x%words, axes%x)))
         call lines%line("set ylabel "//quoted(with_unit(scalar_name(catalogue, figure%scalars(2))//less_y%words, axes%y)))
      end subroutine choose_axes

      !> Room between the curve and an end of its axis.
      pure function room(is_zero, part) result(words)
         logical, intent(in) :: is_zero           !! the axis ends at zero there
         character(*), intent(in) :: part         !! of the axis, else
         character(:), allocatable :: words       !! for `set offsets`

         words = trim(merge("0    ", "graph", is_zero))
         if (.not. is_zero) words = words//" "//part
      end function room

   end subroutine portrait_lines

end module figure_script
