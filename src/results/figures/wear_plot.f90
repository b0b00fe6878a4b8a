!> The figure of the wear of a joint: its table and its script for gnuplot.
!>
!> Left: sections of bearing and journal, one centre, each in the frame of its body; depths are magnified by a round factor for
!> each, which the legend states, radii are to scale; dashed circles are the new surfaces. Right: depth over angle.
!> The table has a block for each surface: angle, depth, and radius of the section as drawn, at both edges of each cell and between.
module wear_plot
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use kinds, only: pi, wp
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: exact_text, real_text, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: round_factor, write_wear_plot

   real(wp), parameter :: degree = pi/180.0_wp       !! [rad]
   real(wp), parameter :: shown_part = 0.3_wp        !! of the radius that the maximum depth has at most, as drawn [1]
   real(wp), parameter :: wall = 1.45_wp             !! radius of the bearing's outside, as drawn, over that of its hole [1]
   integer, parameter :: fewest_points = 360         !! of a circumference
   character(7), parameter :: body_colours(2) = ["#cfdcea", "#eadbc8"]  !! of bearing and journal

contains

   !> Write the table and its script into a folder; nothing if no surface of the joint wears.
   subroutine write_wear_plot(folder, title, heading, name, joint, worn, is_written, error)
      character(*), intent(in) :: folder                 !! of the figures
      character(*), intent(in) :: title                  !! of the scene, any text
      character(*), intent(in) :: heading                !! lines with `#` for the table
      character(*), intent(in) :: name                   !! of the figure
      character(*), intent(in) :: joint                  !! name of the joint
      type(worn_surface_t), intent(in) :: worn(:)        !! (any) surfaces of the run: bearing and journal of each joint
      logical, intent(out) :: is_written                 !! whether there was something to draw
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      real(wp) :: factors(2)
      integer :: k

      is_written = .false.
      k = findloc([(worn(k)%joint == joint .and. worn(k)%is_hole, k=1, size(worn))], .true., dim=1)
      if (k == 0) return
      associate (pair => worn(k:k + 1))
         factors = [(round_factor(shown_part*pair(k)%radius, maxval(pair(k)%depths())), k=1, 2)]
         call write_file(folder//"/"//name//".dat", table_text(heading, pair, factors), error)
         if (.not. allocated(error)) call write_file(folder//"/"//name//".gp", script_of(pair, factors, name, title), error)
      end associate
      is_written = .not. allocated(error)
   end subroutine write_wear_plot

   !> The largest of 1, 2, 5, 10, 20, ... that takes a depth to a length at most; 1 at least.
   pure real(wp) function round_factor(length, depth) result(factor)
      real(wp), intent(in) :: length   !! largest that is shown [m]
      real(wp), intent(in) :: depth    !! to be magnified [m]

      real(wp), parameter :: steps(3) = [1.0_wp, 2.0_wp, 5.0_wp]

      factor = 1.0_wp
      if (.not. depth > 0.0_wp) return
      factor = 10.0_wp**floor(log10(length/depth))
      factor = max(1.0_wp, factor*maxval(steps, mask=steps*factor*depth <= length*(1.0_wp + 1.0e-9_wp)))
   end function round_factor

   !> The table: a block for each surface.
   function table_text(heading, pair, factors) result(text)
      character(*), intent(in) :: heading          !! lines with `#`
      type(worn_surface_t), intent(in) :: pair(2)  !! (2) bearing and journal
      real(wp), intent(in) :: factors(2)           !! (2) of their depths [1]
      character(:), allocatable :: text            !! whole lines

      type(buffer_t) :: lines
      real(wp), allocatable :: depths(:)
      integer :: cell, i, k, n, parts

      call lines%line("# angle[rad] depth[m] radius_drawn[m]")
      call lines%add(heading)
      do k = 1, 2
         call lines%line("# "//pair(k)%side//", depths drawn "//real_text(factors(k), 3)//" times")
         depths = pair(k)%depths()
         n = size(depths)
         parts = max(1, fewest_points/n)
         do i = -n/2, n - n/2 - 1   ! from -180 degrees on
            cell = modulo(i, n) + 1
            call put_cell(2.0_wp*pi*i/n, parts)
         end do
         if (k == 1) call lines%line(new_line("a"))
      end do
      text = lines%get()

   contains

      !> The rows of a cell.
      subroutine put_cell(start, parts)
         real(wp), intent(in) :: start    !! where it starts [rad]
         integer, intent(in) :: parts     !! into which it is cut

         integer :: part

         do part = 0, parts
            call lines%line(number_row([start + 2.0_wp*pi*part/(n*parts), depths(cell), &
                                        pair(k)%radius + merge(factors(k), -factors(k), k == 1)*depths(cell)]))
         end do
      end subroutine put_cell

   end function table_text

   !> The script.
   function script_of(pair, factors, name, title) result(script)
      type(worn_surface_t), intent(in) :: pair(2)  !! (2) bearing and journal
      real(wp), intent(in) :: factors(2)           !! (2) of their depths [1]
      character(*), intent(in) :: name             !! of the figure
      character(*), intent(in) :: title            !! of the scene, any text
      character(:), allocatable :: script          !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: length
      character(:), allocatable :: outer, polygon, words
      integer :: k

      length = choose_unit("m", pair(1)%radius)
      outer = real_text(wall*pair(1)%radius*length%factor, 6)
      polygon = " using ($3*"//real_text(length%factor, 9)//"*cos($1)):($3*"//real_text(length%factor, 9)// &
                "*sin($1)) with filledcurves closed fillcolor rgb "
      call preamble(lines, name, 1400, 760)
      words = "wear of "//pair(1)%joint
      if (len_trim(title) > 0) words = title//": "//words
      call lines%line("set multiplot title "//quoted(words)//" font ',17'")
      call lines%line("set origin 0, 0; set size 0.5, 0.94; set size ratio -1; unset grid")
      call lines%line("set style fill solid 1 noborder; set parametric; set trange [-pi:pi]; set samples 361")
      call lines%line("set xrange [-"//outer//":"//outer//"]; set yrange [-"//outer//":"//outer//"]")
      call lines%line("set xlabel "//quoted("x of each body ["//length%symbol//"]")//"; set ylabel "// &
                      quoted("y ["//length%symbol//"]"))
      call lines%line("set key below center vertical maxrows 4 Left reverse samplen 2.5 spacing 1.2")
      call lines%line("plot "//outer//"*cos(t), "//outer//"*sin(t) with filledcurves closed fillcolor rgb '"// &
                      body_colours(1)//"' notitle, \")
      call lines%line("     '"//name//".dat' index 0"//polygon//"'#ffffff' notitle, \")
      call lines%line("     '' index 1"//polygon//"'"//body_colours(2)//"' notitle, \")
      do k = 1, 2
         call lines%line("     '' index "//to_text(k - 1)//" using ($3*"//real_text(length%factor, 9)//"*cos($1)):($3*"// &
                         real_text(length%factor, 9)//"*sin($1)) with lines linewidth 2 linecolor rgb '"//colours(k)//"' title "// &
                         quoted(pair(k)%side//", depth "//times(factors(k)))//", \")
         call lines%line("     "//circle(pair(k)%radius*length%factor)//" with lines linewidth 1.2 dashtype 2 linecolor "// &
                         "rgb '"//colours(k)//"' title "//quoted(pair(k)%side//", new")//trim(merge(", \", "   ", k == 1)))
      end do
      call lines%line("unset parametric; set grid linetype 1 linewidth 0.7 linecolor rgb '#dcdcdc'; set size noratio; unset key")
      call lines%line("set lmargin at screen 0.58; set rmargin at screen 0.97; set xrange [-180:180]; set xtics 45; "// &
                      "set autoscale y; set style fill solid 0.25 noborder")
      do k = 1, 2
         call depth_panel(lines, pair(k), name, k)
      end do
      call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()
   end function script_of

   !> Depth over angle.
   subroutine depth_panel(lines, surface, name, block)
      type(buffer_t), intent(inout) :: lines       !! the script
      type(worn_surface_t), intent(in) :: surface  !! bearing or journal
      character(*), intent(in) :: name             !! of the figure
      integer, intent(in) :: block                 !! of the table, from 1

      type(display_unit_t) :: shown
      character(:), allocatable :: columns, words
      real(wp) :: angle, depth

      call surface%max_depth(depth, angle)
      shown = choose_unit("m", depth)
      words = surface%side//": not worn"
      if (depth > 0.0_wp) words = surface%side//": "//real_text(depth*shown%factor, 4)//" "//shown%symbol//" at "// &
                                  real_text(angle/degree, 4)//"°, worn over "//real_text(surface%arc()/degree, 4)//"°, "// &
                                  real_text(1.0e9_wp*sum(surface%volume), 4)//" mm³"
      call lines%line("set origin 0.5, "//trim(merge("0.47", "0.00", block == 1))//"; set size 0.5, 0.47")
      call lines%line("set title "//quoted(words)//" font ',13'")
      call lines%line("set xlabel "//quoted("angle in the frame of the "//surface%side//" [°]")//"; set ylabel "// &
                      quoted("depth ["//shown%symbol//"]"))
      call lines%line("set yrange [0:"//trim(merge("1", "*", .not. depth > 0.0_wp))//"]")
      columns = "'"//name//".dat' index "//to_text(block - 1)//" using ($1*"//real_text(1.0_wp/degree, 9)//"):($2*"// &
                real_text(shown%factor, 9)//")"
      call lines%line("plot "//columns//" with filledcurves y1=0 fillcolor rgb '"//colours(block)//"', \")
      call lines%line("     "//columns//" with lines linewidth 1.5 linecolor rgb '"//colours(block)//"'")
   end subroutine depth_panel

   !> A circle about the centre, by the parameter t.
   function circle(radius) result(words)
      real(wp), intent(in) :: radius             !! [the unit shown]
      character(:), allocatable :: words         !! two functions of t

      words = exact_text(radius)//"*cos(t), "//exact_text(radius)//"*sin(t)"
   end function circle

   !> A factor in the legend.
   function times(factor) result(words)
      real(wp), intent(in) :: factor             !! 1, 2, 5, 10, ... [1]
      character(:), allocatable :: words         !! as `× 200`

      words = "to scale"
      if (factor > 1.0_wp) words = "× "//real_text(factor, 3)
   end function times

end module wear_plot
