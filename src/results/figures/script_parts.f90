!> Parts that the gnuplot scripts of all figures share.
module script_parts
   use display_units, only: display_unit_t
   use figure_data, only: curve_t
   use kinds, only: wp
   use path_data, only: path_t
   use plot_text, only: quoted
   use round_values, only: constant
   use text, only: exact_text, segment, real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: angle_tics, axes_t, axis_range, edge, edges, find_long_tics, hangs_from_zero, largest, largest_y, long_tics, open_range
   public :: scaled, source, stands_on_zero
   public :: label_words, line_source, path_source, preamble, with_unit
   public :: colours, ideal_colour, ideal_line, key_below

   character(*), parameter :: colours(12) = &
      [character(7) :: "#1f6fb4", "#d1495b", "#2e8b57", "#c98a00", "#7b4fa3", "#4d4d4d", &
       "#17a2b8", "#e377c2", "#9acd32", "#8c564b", "#ff7f50", "#a0a0a0"]  !! of curves
   character(*), parameter :: ideal_line = "linewidth 1.2 dashtype (12,8)"  !! of the reference run
   character(*), parameter :: ideal_colour = "#101010"                       !! the same
   character(*), parameter :: twin_colour = "1f6fb5"  !! the first of them as good as
   integer, parameter :: segment_points = 100           !! of a transparent line that are drawn at once

   !> Pixels per unit of length in which pictures are laid out: to make a PNG file takes as long as it has pixels.
   real(wp), parameter :: pixels = 5.0_wp/6.0_wp

   !> Where the legend stands.
   character(*), parameter :: key_below = &
      "set key below center horizontal Left reverse samplen 2.5 spacing 1.2 height 0.6"

   !> The scales of a figure.
   type :: axes_t
      type(display_unit_t) :: x          !! abscissa
      type(display_unit_t) :: y          !! ordinate
      real(wp) :: less_x = 0.0_wp        !! what is taken from every abscissa, SI [any]
      real(wp) :: less = 0.0_wp          !! what is taken from every ordinate, SI [any]
   end type axes_t

contains

   !> What every script starts with.
   subroutine preamble(lines, name, width, height)
      type(buffer_t), intent(inout) :: lines   !! the script
      character(*), intent(in) :: name         !! of the figure's files
      integer, intent(in) :: width             !! of the picture, in units of layout
      integer, intent(in) :: height            !! of the picture, in units of layout

      character(:), allocatable :: scale

      scale = real_text(pixels, 4)
      call lines%line("# Edit this script and run it here again:  gnuplot "//name//".gp")
      call lines%line("reset")
      call lines%line("set encoding utf8")
      call lines%line("set terminal pngcairo noenhanced size "//to_text(nint(pixels*width))//","//to_text(nint(pixels*height))// &
                      " font ""DejaVu Sans,15"" fontscale "//scale//" linewidth "//scale//" pointscale "//scale)
      call lines%line("set output '"//name//".png'")
      call lines%line("set key noautotitle")
      call lines%line(key_below)
      call lines%line("set grid linetype 1 linewidth 0.7 linecolor rgb '#dcdcdc'")
      call lines%line("set border linewidth 1.2 linecolor rgb '#404040'")
      call lines%line("set tics nomirror textcolor rgb '#000000'")
      call lines%line("")
   end subroutine preamble

   !> Maximum magnitude of the ordinates.
   pure real(wp) function largest_y(curves)
      type(curve_t), intent(in) :: curves(:)  !! (n) curves

      largest_y = max(abs(minval(curves%y_range(1))), abs(maxval(curves%y_range(2))))
   end function largest_y

   !> Maximum magnitude of a range.
   pure real(wp) function largest(range)
      real(wp), intent(in) :: range(2)  !! (2) minimum and maximum value [any]

      largest = maxval(abs(range))
   end function largest

   !> Whether nothing of a range is negative and something is as good as zero: then zero is the lower edge of its axis.
   pure logical function stands_on_zero(range)
      real(wp), intent(in) :: range(2)  !! (2) minimum and maximum value [any]

      real(wp), parameter :: near = 0.05_wp      ! of the maximum value [1]
      real(wp), parameter :: unseen = 1.0e-3_wp  ! of the maximum value: less than a pixel [1]

      stands_on_zero = range(1) >= -unseen*range(2) .and. range(1) < near*range(2)
   end function stands_on_zero

   !> Whether nothing is positive and something is as good as zero: then zero is the upper edge.
   pure logical function hangs_from_zero(range)
      real(wp), intent(in) :: range(2)  !! (2) minimum and maximum value [any]

      hangs_from_zero = stands_on_zero([-range(2), -range(1)])
   end function hangs_from_zero

   !> Storage between a curve and an end of its axis.
   pure function edge(is_zero, part) result(words)
      logical, intent(in) :: is_zero           !! the axis ends at zero there
      character(*), intent(in) :: part         !! of the axis, else
      character(:), allocatable :: words       !! for `set offsets`

      words = "graph "//part
      if (is_zero) words = "0"
   end function edge

   !> Storage below and above curves.
   pure function edges(range, part) result(words)
      real(wp), intent(in) :: range(2)         !! (2) minimum and maximum value [any]
      character(*), intent(in) :: part         !! of the axis, where it does not end at zero
      character(:), allocatable :: words       !! for `set offsets`

      words = edge(hangs_from_zero(range), part)//", "//edge(stands_on_zero(range), part)
   end function edges

   !> Ends of an axis that scales itself but where it ends at zero; values beyond zero that nobody sees have room all the same.
   function open_range(range) result(words)
      real(wp), intent(in) :: range(2)         !! (2) minimum and maximum value [the unit shown]
      character(:), allocatable :: words       !! as `[0:*]`

      words = "*:*"
      if (stands_on_zero(range)) words = real_text(min(0.0_wp, range(1)), 6)//":*"
      if (hangs_from_zero(range)) words = "*:"//real_text(max(0.0_wp, range(2)), 6)
      words = "["//words//"]"
   end function open_range

   !> Ends of an axis that scales itself, or of one whose numbers do not change: a tenth of them to either side.
   function axis_range(range) result(words)
      real(wp), intent(in) :: range(2)         !! (2) minimum and maximum value [the unit shown]
      character(:), allocatable :: words       !! as `[0:*]`

      if (.not. largest(range) > 0.0_wp) then
         words = "[-1:1]"   ! what is zero, or round-off, does not fill its panel
      else if (range(2) - range(1) <= constant*largest(range)) then
         words = "["//real_text(range(1) - 0.1_wp*abs(range(1)), 6)//":"//real_text(range(2) + 0.1_wp*abs(range(2)), 6)//"]"
      else
         words = open_range(range)
      end if
   end function axis_range

   !> A name with the unit shown.
   pure function with_unit(name, unit) result(label)
      character(*), intent(in) :: name            !! what it is, may be blank
      type(display_unit_t), intent(in) :: unit    !! its unit
      character(:), allocatable :: label          !! as `velocity [m/s]`

      label = name
      if (len(unit%symbol) > 0) label = trim(label//" ["//unit%symbol//"]")
      label = adjustl(label)
   end function with_unit

   !> The name of an ordinate for gnuplot, smaller if it is longer than its axis.
   function label_words(label, height) result(words)
      character(*), intent(in) :: label        !! as `position less 1000 m [mm]`
      integer, intent(in) :: height            !! storage for it, in units of layout
      character(:), allocatable :: words       !! in quotes, with its font

      integer, parameter :: usual = 15, minimum = 8  ! size of letters
      integer, parameter :: width = 12             ! of a letter of usual size, in units of layout
      integer :: i, n

      n = count([(iand(ichar(label(i:i)), 192) /= 128, i=1, len(label))])  ! bytes that start a character of UTF-8
      words = quoted(label)//" font ',"//to_text(max(minimum, min(usual, usual*height/(width*max(n, 1)))))//"'"
   end function label_words

   !> Distance of the ticks of an axis in degrees: a part of a turn, or whole turns. 0: gnuplot's own are as good.
   pure integer function angle_tics(span, n) result(step)
      real(wp), intent(in) :: span  !! what the axis shows [deg]
      integer, intent(in) :: n      !! axes that share the picture's height

      integer, parameter :: steps(*) = [15, 30, 45, 90, 180, 360, 720, 1800, 3600, 7200, 18000, 36000]
      integer, parameter :: most = 9  ! ticks of an axis
      integer :: k

      step = 0
      if (span < 80.0_wp) return
      do k = 1, size(steps)
         step = steps(k)
         if (span <= real(most*step, wp)/real(min(n, 3), wp)) return
      end do
      step = 0
   end function angle_tics

   !> Few ticks, with all their digits, for an axis whose numbers differ late: gnuplot's own have six digits, so that they touch, or
   !> read the same. Blank: gnuplot's own are as good.
   function long_tics(axis, range) result(words)
      character(1), intent(in) :: axis            !! x or y
      real(wp), intent(in) :: range(2)            !! (2) minimum and maximum value [the unit shown]
      character(:), allocatable :: words          !! commands

      character(:), allocatable :: distance, format

      words = ""
      call find_long_tics(range, distance, format)
      if (len(distance) > 0) words = "set "//axis//"tics "//distance//"; set format "//axis//" '"//format//"'"
   end function long_tics

   !> The same: their distance and the format of their numbers, blank if gnuplot's own are as good.
   subroutine find_long_tics(range, distance, format)
      real(wp), intent(in) :: range(2)                        !! (2) minimum and maximum value [the unit shown]
      character(:), allocatable, intent(out) :: distance      !! of two ticks
      character(:), allocatable, intent(out) :: format        !! of their numbers

      integer, parameter :: short = 6             ! characters of numbers that are short
      real(wp), parameter :: most = 4.0_wp        ! ticks apart, over the range
      real(wp), parameter :: constant = 1.0e-13_wp  ! span of what does not change, of its magnitude [1]
      real(wp) :: step
      integer :: before, behind, power

      distance = ""
      format = ""
      if (.not. range(2) - range(1) > constant*largest(range)) return
      power = floor(log10((range(2) - range(1))/most))
      step = 10.0_wp**power
      if (most*step < range(2) - range(1)) step = 2.0_wp*step
      if (most*step < range(2) - range(1)) step = 2.5_wp*step
      if (most*step < range(2) - range(1)) step = 2.0_wp*step
      behind = max(0, -floor(log10(1.001_wp*step)))
      before = max(1, floor(log10(largest(range))) + 1)
      if (before + behind < short .or. before > 2*short) return
      distance = real_text(step, 3)
      format = "%."//to_text(behind)//"f"
   end subroutine find_long_tics

   !> File and columns of a curve, with the numbers scaled.
   function source(curve, axes) result(s)
      type(curve_t), intent(in) :: curve   !! the curve
      type(axes_t), intent(in) :: axes     !! scales of the figure
      character(:), allocatable :: s       !! as `'../slider.dat' using ($1*1000):2`

      s = "'"//curve%path//"' using "//scaled(curve%x, axes%x%factor, axes%less_x)//":"//scaled(curve%y, axes%y%factor, axes%less)
   end function source

   !> A curve as a line, with its title. What joins the sides of a jump of an angle from pi to -pi is transparent, so that the line
   !> has a gap there; its legend stands for itself, since that of a line of several colours is black.
   function line_source(curve, axes, on, width, colour, title) result(s)
      type(curve_t), intent(in) :: curve     !! the curve
      type(axes_t), intent(in) :: axes       !! scales of the figure
      character(*), intent(in) :: on         !! axes of gnuplot, or blank
      character(*), intent(in) :: width      !! width and dashes of the line
      character(*), intent(in) :: colour     !! its colour, as `#1f6fb4`
      character(*), intent(in) :: title      !! as `title 'angle'`, or `notitle`
      character(:), allocatable :: s         !! as `'../slider.dat' using 1:2 with lines linewidth 2 linecolor ...`

      character(:), allocatable :: style

      style = " with lines "//width//" linecolor rgb "
      s = source(curve, axes)
      if (.not. any(curve%wraps)) then
         s = s//on//style//"'"//colour//"' "//title
      else
         s = s//":("//jump(1, curve%x)//jump(2, curve%y)//"0x00"//segment(colour, 2)//")"//on//style//"variable notitle, "// &
             "NaN"//on//style//"'"//colour//"' "//title
      end if

   contains

      !> Where a column jumps, the colour of what leads there.
      function jump(axis, column) result(words)
         integer, intent(in) :: axis               !! 1: abscissa, 2: ordinate
         integer, intent(in) :: column             !! its number
         character(:), allocatable :: words        !! part of an expression

         words = ""
         if (.not. curve%wraps(axis)) return
         associate (before => "before_"//to_text(axis), gap => "gap_"//to_text(axis), value => "$"//to_text(column))
            words = gap//" = $0 > 0 && abs("//value//" - "//before//") > pi, "//before//" = "//value//", "//gap//" ? 0xff000000 : "
         end associate
      end function jump

   end function line_source

   !> File, columns and line of a path, those of the run or what a picture can show of it.
   function path_source(curve, axes, thinned, title) result(s)
      type(curve_t), intent(in) :: curve     !! the path
      type(axes_t), intent(in) :: axes       !! scales of the figure
      type(path_t), intent(in) :: thinned    !! what a picture can show of it
      character(*), intent(in) :: title      !! as `title 'orbit'`, or `notitle`
      character(:), allocatable :: s         !! as `'../gudgeon.dat' using 2:3 with lines ...`

      character(:), allocatable :: colour, columns

      if (.not. thinned%is_used) then
         s = line_source(curve, axes, "", "linewidth 1", colours(1), title)
         return
      end if
      columns = " using "//scaled(1, axes%x%factor, axes%less_x)//":"//scaled(2, axes%y%factor, axes%less)
      colour = thinned%alpha//segment(colours(1), 2)
      s = "'"//thinned%file//"'"//columns
      if (thinned%style == "dots") then  ! a dot cannot be seen in a legend: the first point stands there
         s = s//" with dots linecolor rgb '#"//colour//"' notitle, '"//thinned%file//"' every ::0::0:0"//columns// &
             " with points pointtype 7 pointsize 0.5"
      else  ! what is drawn at once covers itself only once, and a change of colour starts anew: colours with no visible difference
         s = s//":(int($0/"//to_text(segment_points)//")%2 ? 0x"//colour//" : 0x"//thinned%alpha//twin_colour// &
             ") with "//thinned%style//" linecolor rgb variable notitle, '"//thinned%file//"' every ::0::0:0"//columns// &
             " with "//thinned%style
      end if
      s = s//" linecolor rgb '"//colours(1)//"' "//title
   end function path_source

   !> A column, scaled.
   function scaled(column, factor, less) result(s)
      integer, intent(in) :: column            !! its number
      real(wp), intent(in) :: factor           !! of the display unit [any]
      real(wp), intent(in), optional :: less   !! what is taken from its numbers, SI [any]
      character(:), allocatable :: s           !! for `using`

      s = to_text(column)
      if (present(less)) then
         if (abs(less) > 0.0_wp) then
            s = "(($"//s//"-("//exact_text(less)//"))*"//real_text(factor, 6)//")"
            return
         end if
      end if
      if (abs(factor - 1.0_wp) > 0.0_wp) s = "($"//s//"*"//real_text(factor, 6)//")"
   end function scaled

end module script_parts
