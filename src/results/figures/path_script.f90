!> The gnuplot script of a path: of a journal within its clearance (orbit), or of a channel over another (portrait).
!>
!> It reads the `.dat` files beside its folder by column number and writes the picture next to itself, so that it can be edited
!> and run again there.
module path_script
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use display_units, only: choose_unit
   use figure_data, only: curve_t
   use figure_words, only: figure_orbit, figure_t
   use groups_of_catalogue, only: group_clearances
   use plot_text, only: quoted
   use kinds, only: wp
   use path_corners, only: chord_words
   use path_data, only: path_t
   use round_values, only: round_value, round_value_t
   use script_parts, only: axes_t, axis_range, colours, edge, edges, hangs_from_zero, ideal_colour, ideal_line, largest, &
      largest_y, line_source, path_source, preamble, stands_on_zero, with_unit
   use text, only: real_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: figure_text, path_of

   integer, parameter :: most_turns = 60        !! beyond them the line of a portrait is thin
   real(wp), parameter :: orbit_margin = 1.15_wp    !! half axis of an orbit over the largest eccentricity [1]
   integer, parameter :: most_of_title = 70     !! characters above a square picture
   real(wp), parameter :: slot_ratio = 3.0_wp   !! an orbit this much longer than the clearance is in a slot [1]
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
      call lines%line("set offsets "//edge(stands_on_zero(x), "0.03")//", "//edge(hangs_from_zero(x), "0.03")//", "// &
                      edges(y, "0.05"))
      call lines%line("set title "//quoted(title)//" font ',17'")
      call chord_lines(lines, thinned)
      width = trim(merge("0.8", "2  ", is_thin))
      own = trim(merge("title 'with clearance'", "notitle               ", size(ideal) > 0))
      if (thinned%is_used) then
         call lines%add("plot "//path_source(curves(1), axes, thinned, own))
      else
         call lines%add("plot "//line_source(curves(1), axes, "", "linewidth "//width, colours(1), own))
      end if
      if (size(ideal) == 0) then
         call lines%line("")
      else
         call lines%line(", \")
         call lines%line("     "//line_source(ideal(1), axes, "", ideal_line, ideal_colour, "title 'ideal joints'"))
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

   end subroutine portrait_lines

   !> Path of a journal within its clearance.
   subroutine orbit_lines(lines, figure, catalogue, title, curves, thinned)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(figure_t), intent(in) :: figure        !! the figure
      type(catalogue_t), intent(in) :: catalogue  !! what was recorded
      character(*), intent(in) :: title           !! of the scene, any text
      type(curve_t), intent(in) :: curves(:)      !! (2 or 3) components of the eccentricity
      type(path_t), intent(in) :: thinned         !! the path, if the run's own table has too many points

      type(axes_t) :: axes
      character(:), allocatable :: extent, joint, width
      real(wp) :: extreme, radius
      integer :: h, v

      call choose_plane(curves, h, v)
      joint = catalogue%item_groups(group_clearances)%names(figure%joint)%s
      radius = catalogue%item_groups(group_clearances)%radius(figure%joint)
      extreme = max(largest_y(curves(h:h)), largest_y(curves(v:v)), radius)
      axes%x = choose_unit("m", extreme)
      axes%y = axes%x
      width = real_text(axes%x%factor*radius, 9)
      call preamble(lines, figure%name, 1000, 1000)
      call lines%line("set title "//quoted(title, most_of_title)//" font ',17'")
      call lines%line("set xlabel "//quoted(axis_of(curves(h))//" ["//axes%x%symbol//"]"))
      call lines%line("set ylabel "//quoted(axis_of(curves(v))//" ["//axes%y%symbol//"]"))
      call chord_lines(lines, thinned)
      if (size(curves) > 2) call plane_lines(lines, curves, h, v, axes)
      if (extreme > slot_ratio*radius .and. radius > 0.0_wp) then
         call lines%line("set offsets graph 0.03, graph 0.03, graph 0.1, graph 0.1")
         call lines%line("plot "//path_source(path_of(curves), axes, thinned, "title "//quoted(joint))//", \")
         call lines%line("     "//width//" with lines linewidth 2 linecolor rgb '#404040' title "// &
                         quoted("clearance "//width//" "//axes%x%symbol)//", \")
         call lines%line("     -"//width//" with lines linewidth 2 linecolor rgb '#404040' notitle")
      else
         extent = "[-"//real_text(orbit_margin*axes%x%factor*max(extreme, tiny(1.0_wp)), 6)//":"// &
                  real_text(orbit_margin*axes%x%factor*max(extreme, tiny(1.0_wp)), 6)//"]"
         call lines%line("set size ratio -1")
         call lines%line("set xrange "//extent)
         call lines%line("set yrange "//extent)
         call lines%line("set parametric")
         call lines%line("set trange [0:2*pi]")
         call lines%line("set samples 721")
         call lines%line("plot "//path_source(path_of(curves), axes, thinned, &
                                              "title "//quoted("centre of the journal of "//joint))//", \")
         call lines%line("     "//width//"*cos(t), "//width//"*sin(t) with lines linewidth 2 linecolor rgb "// &
                         "'#404040' title "//quoted("clearance "//width//" "//axes%x%symbol))
      end if
      call lines%line("unset output")
   end subroutine orbit_lines

   !> Say that a path is of chords.
   subroutine chord_lines(lines, path)
      type(buffer_t), intent(inout) :: lines   !! the script
      type(path_t), intent(in) :: path         !! the path

      if (path%is_of_chords) call lines%line("set label "//quoted(chord_words)//" at graph 0.02, graph 0.965 front font ',13'")
   end subroutine chord_lines

   !> Say in which plane an orbit in space is drawn, and how far it leaves that plane.
   subroutine plane_lines(lines, curves, h, v, axes)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(curve_t), intent(in) :: curves(:)      !! (3) components of the eccentricity
      integer, intent(in) :: h                    !! the one drawn along x
      integer, intent(in) :: v                    !! the one drawn along y
      type(axes_t), intent(in) :: axes            !! scales of the figure

      integer :: other

      other = 6 - h - v
      call lines%line("set label "//quoted("projection on the plane "//letter_of(curves(h))//", "//letter_of(curves(v))// &
                                           " of the world frame; "//letter_of(curves(other))//" from "// &
                                           real_text(axes%x%factor*curves(other)%y_range(1), 3)//" to "// &
                                           real_text(axes%x%factor*curves(other)%y_range(2), 3)//" "//axes%x%symbol)// &
                      " at graph 0.02, graph 0.03 front font ',13'")
   end subroutine plane_lines

   !> The path of an orbit as a curve: file and columns.
   function path_of(curves) result(path)
      type(curve_t), intent(in) :: curves(:)  !! (2 or 3) components of the eccentricity
      type(curve_t) :: path                   !! the one drawn along y over the one along x

      integer :: h, v

      call choose_plane(curves, h, v)
      path = curves(v)
      path%x = curves(h)%y
      path%x_label = curves(h)%y_label
      path%x_range = curves(h)%y_range
   end function path_of

   !> The two components of an orbit that move most, in their order.
   pure subroutine choose_plane(curves, h, v)
      type(curve_t), intent(in) :: curves(:)  !! (2 or 3) components
      integer, intent(out) :: h               !! the one drawn along x
      integer, intent(out) :: v               !! the one drawn along y

      integer :: minimum

      h = 1
      v = 2
      if (size(curves) < 3) return
      minimum = minloc(curves%y_range(2) - curves%y_range(1), dim=1, back=.true.)
      if (minimum == 1) h = 2
      if (minimum < 3) v = 3
   end subroutine choose_plane

   !> Name of an axis of an orbit.
   pure function axis_of(curve) result(label)
      type(curve_t), intent(in) :: curve     !! a component of the eccentricity
      character(:), allocatable :: label     !! as `eccentricity x`

      label = "eccentricity "//letter_of(curve)
   end function axis_of

   !> The axis of a component.
   pure function letter_of(curve) result(letter)
      type(curve_t), intent(in) :: curve     !! a component of the eccentricity
      character :: letter                    !! as `x`

      letter = curve%name(len(curve%name):)
   end function letter_of

end module path_script
