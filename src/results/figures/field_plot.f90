!> The figure of an unwrapped film: its table and its script for gnuplot.
!>
!> Above: pressure over angle and place along the axis, colours and contours; the angles of the maximum pressure and of the minimum
!> film. Below: pressure in the middle of the bearing, and the gap.
module field_plot
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use film_fields, only: film_field_t
   use kinds, only: pi, wp
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: write_field_plot

   integer, parameter :: row_step = 2                 !! of the places along the axis every second is drawn
   integer, parameter :: contours = 8                 !! lines between no pressure and the maximum
   real(wp), parameter :: degree = pi/180.0_wp        !! [rad]
   real(wp), parameter :: nothing = 1.0e-9_wp         !! pressures below this part of the maximum are none [1]

contains

   !> Write the table and its script into a folder; nothing if the film was not found.
   subroutine write_field_plot(folder, title, heading, name, fields, is_written, error)
      character(*), intent(in) :: folder                 !! of the figures
      character(*), intent(in) :: title                  !! of the scene, any text
      character(*), intent(in) :: heading                !! lines with `#` for the table
      character(*), intent(in) :: name                   !! of the figure
      type(film_field_t), intent(in) :: fields(:)        !! (any) films of the run
      logical, intent(out) :: is_written                 !! whether there was something to draw
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      type(film_field_t) :: drawn
      integer :: k

      is_written = .false.
      do k = 1, size(fields)
         if (fields(k)%request%name /= name) cycle
         drawn = turned(fields(k))
         call write_file(folder//"/"//name//".dat", table_text(heading, drawn), error)
         if (.not. allocated(error)) call write_file(folder//"/"//name//".gp", script_of(drawn, name, title), error)
         is_written = .not. allocated(error)
         return
      end do
   end subroutine write_field_plot

   !> The film as it is drawn: from 0 to 360 degrees, unless there is pressure at 0 degrees; then from the middle of the widest part
   !> without pressure, or from where it is least, so that the film is in one part. Angles are from -180 to 540 degrees.
   function turned(field) result(drawn)
      type(film_field_t), intent(in) :: field  !! the film, at angles from 0 to 360 degrees
      type(film_field_t) :: drawn              !! the same

      integer, allocatable :: order(:)
      real(wp) :: p(size(field%theta) - 1)
      integer :: k, length, n, start, widest

      drawn = field
      n = size(p)
      p = maxval(abs(field%pressure(:, :n)), dim=1)
      if (.not. p(1) > nothing*maxval(p)) return
      start = minloc(p, dim=1)
      widest = 0
      length = 0
      do k = 1, n
         length = merge(0, length + 1, p(k) > nothing*maxval(p))
         if (length <= widest) cycle
         widest = length
         start = k - (length - 1)/2
      end do
      order = [(modulo(start + k - 2, n) + 1, k=1, n + 1)]
      drawn%theta = field%theta(order) + [(merge(2.0_wp*pi, 0.0_wp, start + k - 1 > n), k=1, n + 1)]
      if (field%theta(start) > pi) drawn%theta = drawn%theta - 2.0_wp*pi
      drawn%pressure = field%pressure(:, order)
      drawn%gap = field%gap(:, order)
   end function turned

   !> The table: a block for each angle, a row for each place; after two empty lines a row for each angle, at mid-length.
   function table_text(heading, field) result(text)
      character(*), intent(in) :: heading      !! lines with `#`
      type(film_field_t), intent(in) :: field  !! the film
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      integer :: j, k

      call lines%line("# angle[rad] axial_position[m] pressure[Pa] thickness[m]")
      call lines%add(heading)
      do k = 1, size(field%theta)
         if (k > 1) call lines%line("")
         do j = 1, size(field%y), row_step
            call put(j, k)
         end do
      end do
      call lines%line(new_line("a"))
      do k = 1, size(field%theta)
         call put((size(field%y) + 1)/2, k)
      end do
      text = lines%get()

   contains

      !> A row.
      subroutine put(j, k)
         integer, intent(in) :: j, k  !! numbers of place and angle

         call lines%line(number_row([field%theta(k), field%y(j), field%pressure(j, k), field%gap(j, k)]))
      end subroutine put

   end function table_text

   !> The script.
   function script_of(field, name, title) result(script)
      type(film_field_t), intent(in) :: field   !! the film
      character(*), intent(in) :: name          !! of the figure
      character(*), intent(in) :: title         !! of the scene, any text
      character(:), allocatable :: script       !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: degrees, h, p, y
      real(wp) :: maximum, minimum, size_of_p
      integer :: peak(2), thin(2)

      peak = maxloc(field%pressure)
      thin = minloc(field%gap)
      maximum = maxval(field%pressure)
      minimum = minval(field%pressure)
      size_of_p = max(maximum, -minimum, tiny(1.0_wp))
      p = choose_unit("Pa", size_of_p)
      y = choose_unit("m", field%y(size(field%y)))
      h = choose_unit("m", maxval(field%gap))
      degrees%factor = 1.0_wp/degree
      call preamble(lines, name, 1200, 900)
      call lines%line("unset key")
      call lines%line("set multiplot layout 2,1 title "//quoted(title)//" font ',17'")
      call lines%line("set xrange ["//real_text(field%theta(1)/degree, 6)//":"// &
                      real_text(field%theta(size(field%theta))/degree, 6)//"]; set xtics "//angle_tics(field%theta/degree))
      call lines%line("set lmargin at screen 0.1; set rmargin at screen 0.84")
      call label(lines, field%request%joint//", film "//field%film//", t = "//real_text(field%t, 6)//" s")
      call map_lines(lines, name, field, p, y)
      call label(lines, "maximum pressure "//shown(field%pressure(peak(1), peak(2)), p)//" at "// &
                 real_text(modulo(field%theta(peak(2)), 2.0_wp*pi)/degree, 4)//"°, minimum film thickness "// &
                 shown(field%gap(thin(1), thin(2)), choose_unit("m", field%gap(thin(1), thin(2))))//" at "// &
                 real_text(modulo(field%theta(thin(2)), 2.0_wp*pi)/degree, 4)//"°")
      call lines%line("set yrange [*:*]; set y2range [0:*]; set ytics auto nomirror; set y2tics; unset view")
      call lines%line("set xlabel 'angle in the frame of the bearing [°]'")
      call lines%line("set ylabel "//quoted("pressure at mid-length ["//p%symbol//"]")//" textcolor rgb '"//colours(1)//"'")
      call lines%line("set y2label "//quoted("film thickness ["//h%symbol//"]")//" textcolor rgb '"//colours(2)//"'")
      call mark(lines, field%theta(peak(2)), colours(1))
      call mark(lines, field%theta(thin(2)), colours(2))
      call lines%line("plot '"//name//".dat' index 1 using "//column(1, degrees)//":"//column(3, p)// &
                      " with lines linewidth 2 linecolor rgb '"//colours(1)//"', \")
      call lines%line("     '' index 1 using "//column(1, degrees)//":"//column(4, h)// &
                      " axes x1y2 with lines linewidth 2 dashtype 2 linecolor rgb '"//colours(2)//"'")
      call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()
   end function script_of

   !> Ticks every 45 degrees, from 0 to 360; further turns have the same numbers.
   function angle_tics(theta) result(words)
      real(wp), intent(in) :: theta(:)        !! (n) angles of the picture, a turn of them [deg]
      character(:), allocatable :: words      !! for `set xtics`

      integer :: angle

      words = "45"
      if (theta(1) >= 0.0_wp .and. theta(1) <= 0.0_wp) return
      words = ""
      do angle = 45*ceiling(theta(1)/45.0_wp), floor(theta(size(theta))), 45
         words = words//", '"//to_text(modulo(angle, 360))//"' "//to_text(angle)
      end do
      words = "("//words(3:)//")"
   end function angle_tics

   !> The map of the pressure.
   subroutine map_lines(lines, name, field, p, y)
      type(buffer_t), intent(inout) :: lines    !! the script
      character(*), intent(in) :: name          !! of the figure
      type(film_field_t), intent(in) :: field   !! the film
      type(display_unit_t), intent(in) :: p, y  !! scales

      character(:), allocatable :: columns, high, high_y, low, low_y
      real(wp) :: maximum, minimum
      integer :: k

      maximum = max(maxval(field%pressure), 0.0_wp)*p%factor
      minimum = min(minval(field%pressure), 0.0_wp)*p%factor
      if (maximum < -nothing*minimum) maximum = 0.0_wp
      if (-minimum < nothing*maximum) minimum = 0.0_wp
      high = real_text(maximum, 6)
      low = real_text(minimum, 6)
      columns = column(1, display_unit_t(factor=1.0_wp/degree))//":"//column(2, y)//":"//column(3, p)
      call lines%line("set view map; set pm3d corners2color mean interpolate 2,2")
      if (minimum < 0.0_wp .and. maximum > 0.0_wp) then
         call lines%line("set palette defined ("//low//" '#b2182b', 0 '#ffffff', "//high//" '#08306b')")
      else if (minimum < 0.0_wp) then
         call lines%line("set palette defined (0 '#b2182b', 1 '#ffffff')")
      else
         call lines%line("set palette defined (0 '#ffffff', 0.01 '#dbe9f6', 0.4 '#6aaed6', 1 '#08306b')")
      end if
      if (maximum > minimum) then
         call lines%line("set cbrange ["//low//":"//high//"]")
         call lines%line("set contour base")
         call lines%add("set cntrparam levels discrete ")
         do k = 1, contours
            call lines%add(real_text(minimum + (maximum - minimum)*k/(contours + 1), 6))
            if (k < contours) call lines%add(", ")
         end do
         call lines%line("")
      else
         call lines%line("set cbrange [0:1]")
      end if
      call lines%line("set for [i=1:20] linetype i linecolor rgb '#303030'")
      call lines%line("set cblabel "//quoted("pressure ["//p%symbol//"]"))
      low_y = real_text(field%y(1)*y%factor, 6)
      high_y = real_text(field%y(size(field%y))*y%factor, 6)
      call lines%line("set yrange ["//low_y//":"//high_y//"]")
      call lines%line("set ytics 0.25*("//high_y//"-("//low_y//"))")
      call lines%line("set ylabel "//quoted("axial position ["//y%symbol//"]"))
      call lines%add("splot '"//name//".dat' index 0 using "//columns//" with pm3d")
      if (maximum > minimum) call lines%add(", '' index 0 using "//columns//" with lines linewidth 0.8 nosurface")
      call lines%line("")
      call lines%line("unset contour")
   end subroutine map_lines

   !> A line of text above a panel.
   subroutine label(lines, text)
      type(buffer_t), intent(inout) :: lines  !! the script
      character(*), intent(in) :: text        !! any text

      call lines%line("set label 1 "//quoted(text)//" at graph 0, 1.07 left")
   end subroutine label

   !> A column of the table, scaled.
   function column(number, unit) result(s)
      integer, intent(in) :: number             !! of the column
      type(display_unit_t), intent(in) :: unit  !! its scale
      character(:), allocatable :: s            !! for `using`

      s = "($"//to_text(number)//"*"//real_text(unit%factor, 12)//")"
   end function column

   !> A line across a panel at an angle.
   subroutine mark(lines, theta, colour)
      type(buffer_t), intent(inout) :: lines  !! the script
      real(wp), intent(in) :: theta           !! the angle [rad]
      character(*), intent(in) :: colour      !! of the line

      call lines%line("set arrow from first "//real_text(theta/degree, 8)//", graph 0 to first "//real_text(theta/degree, 8)// &
                      ", graph 1 nohead dashtype 3 linecolor rgb '"//colour//"'")
   end subroutine mark

   !> A number with its unit.
   function shown(x, unit) result(words)
      real(wp), intent(in) :: x                 !! the number, SI [any]
      type(display_unit_t), intent(in) :: unit  !! how it is shown
      character(:), allocatable :: words        !! as `1.23 MPa`

      words = real_text(x*unit%factor, 3)//" "//unit%symbol
   end function shown

end module field_plot
