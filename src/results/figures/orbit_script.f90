!> The gnuplot script of the path of a journal within its clearance.
module orbit_script
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances
   use display_units, only: choose_unit
   use figure_data, only: curve_t
   use figure_words, only: figure_t
   use kinds, only: wp
   use plot_text, only: quoted
   use path_data, only: path_t
   use script_parts, only: axes_t, largest_y, path_source, preamble
   use text, only: real_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: orbit_lines, path_of

   real(wp), parameter :: orbit_margin = 1.15_wp    !! half axis of an orbit over the largest eccentricity [1]
   integer, parameter :: most_of_title = 70         !! characters above a square picture
   real(wp), parameter :: slot_ratio = 3.0_wp       !! an orbit this much longer than the clearance is in a slot [1]

contains

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
      real(wp) :: largest, radius
      integer :: h, v

      call choose_plane(curves, h, v)
      joint = catalogue%rooms(group_clearances)%names(figure%joint)%s
      radius = catalogue%rooms(group_clearances)%radius(figure%joint)
      largest = max(largest_y(curves(h:h)), largest_y(curves(v:v)), radius)
      axes%x = choose_unit("m", largest)
      axes%y = axes%x
      width = real_text(axes%x%factor*radius, 9)
      call preamble(lines, figure%name, 1000, 1000)
      call lines%line("set title "//quoted(title, most_of_title)//" font ',17'")
      call lines%line("set xlabel "//quoted(axis_of(curves(h))//" ["//axes%x%symbol//"]"))
      call lines%line("set ylabel "//quoted(axis_of(curves(v))//" ["//axes%y%symbol//"]"))
      if (largest > slot_ratio*radius .and. radius > 0.0_wp) then
         call lines%line("set offsets graph 0.03, graph 0.03, graph 0.1, graph 0.1")
         call lines%line("plot "//path_source(path_of(curves), axes, thinned, "title "//quoted(joint))//", \")
         call lines%line("     "//width//" with lines linewidth 2 linecolor rgb '#404040' title "// &
                         quoted("clearance "//width//" "//axes%x%symbol)//", \")
         call lines%line("     -"//width//" with lines linewidth 2 linecolor rgb '#404040' notitle")
      else
         extent = "[-"//real_text(orbit_margin*axes%x%factor*max(largest, tiny(1.0_wp)), 6)//":"// &
                  real_text(orbit_margin*axes%x%factor*max(largest, tiny(1.0_wp)), 6)//"]"
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

   !> The path of an orbit as a curve: file and columns.
   function path_of(curves) result(path)
      type(curve_t), intent(in) :: curves(:)  !! (2 or 3) components of the eccentricity
      type(curve_t) :: path                   !! the one drawn along y over the one along x

      integer :: h, v

      call choose_plane(curves, h, v)
      path = curves(v)
      path%x = curves(h)%y
      path%x_label = curves(h)%y_label
      path%series(1) = curves(h)%series(2)
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

      label = "eccentricity "//curve%name(len(curve%name):)
   end function axis_of

end module orbit_script
