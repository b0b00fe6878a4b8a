!> Figures that are not histories: a table of numbers beside its script, drawn in one or several panels.
!>
!> The table is `NAME.dat` in the folder of the figures, the script `NAME.gp`; both are text that a user can edit.
module plot_table
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use plot_text, only: quoted
   use script_parts, only: colours, edges, key_below, label_words, long_tics, open_range, preamble, with_unit
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: draw_bars, draw_boxes, draw_dotted_lines, draw_lines, draw_marks, draw_points
   public :: panel_t, plot_curve_t, plot_table_t, tell_empty, write_plot

   integer, parameter :: draw_points = 1   !! dots
   integer, parameter :: draw_lines = 2    !! a line
   integer, parameter :: draw_boxes = 3    !! boxes from `low` to `high` on the abscissa
   integer, parameter :: draw_bars = 4     !! dots with bars of half length `low`, joined by a line unless at words
   integer, parameter :: draw_marks = 5    !! small dashes, without a title
   integer, parameter :: draw_dotted_lines = 6  !! a line with dots on it
   real(wp), parameter :: flat = 1.0e-6_wp      !! span of lines below which they are drawn as constant, of their magnitude [1]
   real(wp), parameter :: few_counts = 10.0_wp  !! counts up to which each has its tic on the axis [1]

   !> One curve: columns of the table.
   type :: plot_curve_t
      integer :: style = draw_points          !! one of the above
      integer :: x = 1                        !! column of the abscissa
      integer :: y = 2                        !! column of the ordinate
      integer :: low = 0                      !! column of the bar's half length, or of a box's start
      integer :: high = 0                     !! column of a box's end
      integer :: colour = 1                   !! number of the colour
      integer :: first = 1                    !! its first row
      integer :: last = huge(1)               !! its last row
      character(:), allocatable :: title      !! in the legend; blank: none
   end type plot_curve_t

   !> Curves over one another.
   type :: panel_t
      character(:), allocatable :: y_name              !! what stands beside the ordinate
      character(:), allocatable :: y_unit              !! SI unit
      logical :: is_log_y = .false.                    !! whether the ordinate is logarithmic
      type(plot_curve_t), allocatable :: curves(:)     !! (n) curves
   end type panel_t

   !> A table and how it is drawn.
   type :: plot_table_t
      character(:), allocatable :: name                !! of the files, without suffix
      character(:), allocatable :: heading             !! lines with `#` before the columns
      type(text_t), allocatable :: labels(:)           !! (columns) names with units, as `a[m]`, without blanks
      real(wp), allocatable :: values(:, :)            !! (columns, rows) SI [any]
      character(:), allocatable :: x_name              !! what stands below the abscissa
      character(:), allocatable :: x_unit              !! SI unit
      type(display_unit_t) :: x_shown                  !! unit to show; without a symbol: one that reads well
      logical :: is_log_x = .false.                    !! whether the abscissa is logarithmic
      type(text_t), allocatable :: categories(:)       !! (n) words at 1, 2, ... of the abscissa; none: numbers
      type(panel_t), allocatable :: panels(:)          !! (n) what is drawn
   end type plot_table_t

contains

   !> Write the table and its script into a folder; nothing if it has no numbers. Panels without numbers are omitted.
   subroutine write_plot(folder, title, table, is_written, error, empty)
      character(*), intent(in) :: folder                 !! of the figures
      character(*), intent(in) :: title                  !! of the scene, any text
      type(plot_table_t), intent(in) :: table            !! the table
      logical, intent(out) :: is_written                 !! whether there was something to draw
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written
      type(text_t), allocatable, intent(out), optional :: empty(:)  !! (any) ordinates of panels without numbers, beside others

      type(plot_table_t) :: drawn
      integer, allocatable :: list(:)
      integer :: k

      is_written = .false.
      if (present(empty)) allocate (empty(0))
      if (.not. allocated(table%values)) return
      list = pack([(k, k=1, size(table%panels))], [(has_numbers(table, table%panels(k)), k=1, size(table%panels))])
      if (size(list) == 0) return
      drawn = table
      deallocate (drawn%panels)
      allocate (drawn%panels(size(list)))
      do k = 1, size(list)
         drawn%panels(k) = table%panels(list(k))
      end do
      if (present(empty)) then
         do k = 1, size(table%panels)
            if (.not. any(list == k)) call append_text(empty, table%panels(k)%y_name)
         end do
      end if
      call write_file(folder//"/"//table%name//".dat", table_text(table), error)
      if (.not. allocated(error)) call write_file(folder//"/"//table%name//".gp", script_of(drawn, title), error)
      is_written = .not. allocated(error)
   end subroutine write_plot

   !> Warn of panels without numbers.
   subroutine tell_empty(word, empty, warnings)
      character(*), intent(in) :: word                         !! the figure as the deck has it
      type(text_t), intent(in) :: empty(:)                     !! (any) ordinates of such panels
      type(text_t), allocatable, intent(inout) :: warnings(:)  !! (any) grown

      integer :: k

      do k = 1, size(empty)
         call append_text(warnings, "figure "//word//": no values of "//empty(k)%s)
      end do
   end subroutine tell_empty

   !> Whether a panel has a point.
   pure logical function has_numbers(table, panel)
      type(plot_table_t), intent(in) :: table   !! the table
      type(panel_t), intent(in) :: panel        !! one of its panels

      integer :: i, k

      has_numbers = .true.
      do k = 1, size(panel%curves)
         associate (curve => panel%curves(k))
            do i = curve%first, min(curve%last, size(table%values, 2))
               if (ieee_is_finite(table%values(curve%x, i)) .and. ieee_is_finite(table%values(curve%y, i))) return
            end do
         end associate
      end do
      has_numbers = .false.
   end function has_numbers

   !> The table as text.
   function table_text(table) result(text)
      type(plot_table_t), intent(in) :: table   !! the table
      character(:), allocatable :: text         !! whole lines

      type(buffer_t) :: lines
      integer :: i, k

      call lines%add("#")
      do i = 1, size(table%labels)
         call lines%add(" "//table%labels(i)%s)
      end do
      call lines%line("")
      call lines%add(table%heading)
      do k = 1, size(table%values, 2)
         call lines%line(number_row(table%values(:, k)))
      end do
      text = lines%get()
   end function table_text

   !> The script.
   function script_of(table, title) result(script)
      type(plot_table_t), intent(in) :: table     !! the table
      character(*), intent(in) :: title           !! of the scene, any text
      character(:), allocatable :: script         !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: x
      character(:), allocatable :: tics
      integer :: k, n

      n = size(table%panels)
      call preamble(lines, table%name, merge(1200, 1500, n < 3), merge(800, 1100, n < 2))
      call lines%line("unset key")
      x = table%x_shown
      if (.not. allocated(x%symbol)) then
         x = choose_unit(table%x_unit, largest(table, [(table%panels(1)%curves(k)%x, k=1, size(table%panels(1)%curves))]))
      end if
      call lines%line("set xlabel "//quoted(with_unit(table%x_name, x)))
      call lines%line("set offsets "//aside(table)//", graph 0.06, graph 0.06")
      if (table%is_log_x) call lines%line("set logscale x; set format x '%g'")
      if (size(table%categories) > 0) then
         tics = ""
         do k = 1, size(table%categories)
            if (k > 1) tics = tics//", "
            tics = tics//quoted(table%categories(k)%s)//" "//to_text(k)
         end do
         call lines%line("set xtics ("//tics//") noenhanced rotate by -20")
      end if
      if (any_points(table%panels(1)) .and. size(table%categories) == 0 .and. .not. table%is_log_x) then
         call add_line(lines, long_tics("x", x%factor*range_of(table, table%panels(1)%curves%x)))
      end if
      if (n == 1) then
         call lines%line("set title "//quoted(title)//" font ',17'")
      else
         if (n == 2) call lines%line("set lmargin at screen 0.14; set rmargin at screen 0.95")  ! one above the other
         call lines%line("set multiplot layout "//trim(merge("2,1", "2,2", n < 3))//" title "//quoted(title)//" font ',17'")
      end if
      do k = 1, n
         if (has_titles(table%panels(k))) call lines%line(key_below)
         call panel_lines(lines, table, table%panels(k), x)
      end do
      if (n > 1) call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()
   end function script_of

   !> Whether a panel has points, whose axes scale themselves.
   pure logical function any_points(panel)
      type(panel_t), intent(in) :: panel  !! the panel

      any_points = any(panel%curves%style == draw_points)
   end function any_points

   !> Whether a curve of some style is a line.
   elemental logical function is_line(style)
      integer, intent(in) :: style  !! how it is drawn

      is_line = style == draw_lines .or. style == draw_dotted_lines
   end function is_line

   !> A line, unless it is blank.
   subroutine add_line(lines, words)
      type(buffer_t), intent(inout) :: lines      !! the script
      character(*), intent(in) :: words           !! the line

      if (len(words) > 0) call lines%line(words)
   end subroutine add_line

   !> Whether a panel has a legend.
   pure logical function has_titles(panel)
      type(panel_t), intent(in) :: panel  !! the panel

      integer :: k

      has_titles = .false.
      do k = 1, size(panel%curves)
         has_titles = has_titles .or. len(panel%curves(k)%title) > 0
      end do
   end function has_titles

   !> One panel.
   subroutine panel_lines(lines, table, panel, x)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(plot_table_t), intent(in) :: table     !! the table
      type(panel_t), intent(in) :: panel          !! the panel
      type(display_unit_t), intent(in) :: x       !! scale of the abscissa

      type(display_unit_t) :: y
      integer :: k

      y = choose_unit(panel%y_unit, largest(table, panel%curves%y))
      call lines%line("set ylabel "//label_words(with_unit(panel%y_name, y), merge(600, 360, size(table%panels) < 2)))
      call lines%line(merge("set logscale y; set format y '%g'  ", "unset logscale y; set format y '%h'", panel%is_log_y)// &
                      "; set ytics autofreq; set yrange [*:*]")
      if (all(.not. is_line(panel%curves%style) .and. panel%curves%style /= draw_boxes) .and. .not. panel%is_log_y) then
         call ordinate_lines(lines, table, panel, y)
      end if
      if (any_points(panel) .and. .not. panel%is_log_y) then
         call add_line(lines, long_tics("y", y%factor*range_of(table, panel%curves%y)))
      end if
      if (any(is_line(panel%curves%style))) then
         call lines%line("set autoscale xfix; unset offsets")
         if (.not. panel%is_log_y) call line_lines(lines, y%factor*range_of(table, panel%curves%y))
      end if
      if (any(panel%curves%style == draw_boxes)) then
         call lines%line("set style fill solid 0.5; set offsets 0, 0, graph 0.06, 0; set xrange [0:*]; set yrange [0:*]")
         if (largest(table, panel%curves%y) <= few_counts) call lines%line("set ytics 1")  ! there are no halves of an impact
      end if
      do k = 1, size(panel%curves)
         call lines%line(merge("plot ", "     ", k == 1)//curve_text(table, panel%curves(k), x, y)// &
                         merge(", \", "   ", k < size(panel%curves)))
      end do
   end subroutine panel_lines

   !> The ordinate of lines: round-off of what is constant does not fill its height, no line lies on the frame, and ticks that
   !> differ late have their digits.
   subroutine line_lines(lines, range)
      type(buffer_t), intent(inout) :: lines      !! the script
      real(wp), intent(in) :: range(2)            !! (2) minimum and maximum ordinate [the unit shown]

      real(wp) :: ends(2)

      if (maxval(abs(range)) > 0.0_wp .and. range(2) - range(1) <= flat*maxval(abs(range))) then
         ends = range + [-0.1_wp, 0.1_wp]*maxval(abs(range))
         call lines%line("set yrange ["//real_text(ends(1), 6)//":"//real_text(ends(2), 6)//"]")
      else
         call lines%line("set offsets 0, 0, "//edges(range, "0.05")//"; set yrange "//open_range(range))
         call add_line(lines, long_tics("y", range))
      end if
   end subroutine line_lines

   !> Ends of an ordinate that scales itself: of what is not negative it starts at zero, if that is near.
   subroutine ordinate_lines(lines, table, panel, y)
      type(buffer_t), intent(inout) :: lines      !! the script
      type(plot_table_t), intent(in) :: table     !! the table
      type(panel_t), intent(in) :: panel          !! the panel
      type(display_unit_t), intent(in) :: y       !! scale of the ordinate

      real(wp) :: range(2)

      range = y%factor*range_of(table, panel%curves%y)
      call lines%line("set offsets "//aside(table)//", "//edges(range, "0.06")//"; set yrange "//open_range(range))
   end subroutine ordinate_lines

   !> Room beside the points: half of what is between two words, or a part of the picture.
   pure function aside(table) result(words)
      type(plot_table_t), intent(in) :: table     !! the table
      character(:), allocatable :: words          !! for `set offsets`

      words = "graph 0.05, graph 0.05"
      if (size(table%categories) > 0) words = "0.5, 0.5"
   end function aside

   !> One curve of a plot command.
   function curve_text(table, curve, x, y) result(s)
      type(plot_table_t), intent(in) :: table     !! the table
      type(plot_curve_t), intent(in) :: curve     !! the curve
      type(display_unit_t), intent(in) :: x       !! scale of the abscissa
      type(display_unit_t), intent(in) :: y       !! scale of the ordinate
      character(:), allocatable :: s              !! as `'name.dat' using ($1*1000):2 with lines`

      character(:), allocatable :: colour

      colour = " linecolor rgb '"//colours(mod(curve%colour - 1, size(colours)) + 1)//"'"
      s = "'"//table%name//".dat'"
      if (curve%last < huge(1)) s = s//" every ::"//to_text(curve%first - 1)//"::"//to_text(curve%last - 1)
      s = s//" using "
      select case (curve%style)
      case (draw_boxes)
         s = s//"(($"//to_text(curve%low)//"+$"//to_text(curve%high)//")*"//real_text(0.5_wp*x%factor, 9)//"):"// &
             scaled(curve%y, y)//":(($"//to_text(curve%high)//"-$"//to_text(curve%low)//")*"//real_text(x%factor, 9)// &
             ") with boxes linewidth 1"//colour
      case (draw_bars)
         s = s//scaled(curve%x, x)//":"//scaled(curve%y, y)//":"//scaled(curve%low, y)// &
             " with "//trim(merge("yerrorbars ", "yerrorlines", size(table%categories) > 0))// &
             " linewidth 2 pointtype 7 pointsize 1.2"//colour
      case (draw_lines)
         s = s//scaled(curve%x, x)//":"//scaled(curve%y, y)//" with lines linewidth 1.5"//colour
      case (draw_dotted_lines)
         s = s//scaled(curve%x, x)//":"//scaled(curve%y, y)//" with linespoints linewidth 1.5 pointtype 7 pointsize 0.5"//colour
      case (draw_marks)
         s = s//scaled(curve%x, x)//":"//scaled(curve%y, y)//" with points pointtype 1 pointsize 0.9 linewidth 1"//colour
      case default
         s = s//scaled(curve%x, x)//":"//scaled(curve%y, y)//" with points pointtype 7 pointsize 0.7"//colour
      end select
      if (len(curve%title) > 0) then
         s = s//" title "//quoted(curve%title)
      else
         s = s//" notitle"
      end if
   end function curve_text

   !> A column, scaled.
   function scaled(column, unit) result(s)
      integer, intent(in) :: column               !! its number
      type(display_unit_t), intent(in) :: unit    !! its scale
      character(:), allocatable :: s              !! for `using`

      s = "($"//to_text(column)//"*"//real_text(unit%factor, 9)//")"
   end function scaled

   !> Minimum and maximum value in some columns.
   pure function range_of(table, columns) result(range)
      type(plot_table_t), intent(in) :: table  !! the table
      integer, intent(in) :: columns(:)        !! (any) columns
      real(wp) :: range(2)                     !! (2) they; zeros: there is none [any]

      integer :: i, k

      range = [huge(1.0_wp), -huge(1.0_wp)]
      do k = 1, size(table%values, 2)
         do i = 1, size(columns)
            if (.not. ieee_is_finite(table%values(columns(i), k))) cycle
            range = [min(range(1), table%values(columns(i), k)), max(range(2), table%values(columns(i), k))]
         end do
      end do
      if (range(1) > range(2)) range = 0.0_wp
   end function range_of

   !> Maximum magnitude in some columns.
   pure real(wp) function largest(table, columns)
      type(plot_table_t), intent(in) :: table  !! the table
      integer, intent(in) :: columns(:)        !! (any) columns

      integer :: i, k

      largest = 0.0_wp
      do k = 1, size(table%values, 2)
         do i = 1, size(columns)
            if (ieee_is_finite(table%values(columns(i), k))) largest = max(largest, abs(table%values(columns(i), k)))
         end do
      end do
   end function largest

end module plot_table
