!> A number over two swept parameters: a coloured cell for each case with a dot where the case is, the values of few cases or
!> contour lines among many, cells without a value hatched.
!>
!> The table `NAME.dat` has a row for each case: both parameters, the number (mean over the runs of the case; NaN: no run has it),
!> and the edges of its cell, halfway to the neighbours (on a logarithmic axis the geometric mean); a block for each value of the
!> first parameter, so that gnuplot finds the contour lines. They are straight within a cell of the grid and omitted over words.
module sweep_map
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use plot_text, only: quoted
   use script_parts, only: key_below, preamble, scaled, with_unit
   use sweep_axes, only: axis_of_parameter, sweep_axis_t
   use sweep_results, only: case_numbers, n_spread, sweep_results_t
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: write_sweep_map

   real(wp), parameter :: most_levels = 8.0_wp   !! contour lines, about
   integer, parameter :: most_written = 25       !! cases whose values are written; among more there are contour lines

contains

   !> Write table and script into a folder; nothing if no case has the number.
   subroutine write_sweep_map(folder, title, name, number, results, heading, is_written, error)
      character(*), intent(in) :: folder                 !! of the figures
      character(*), intent(in) :: title                  !! of the scene, any text
      character(*), intent(in) :: name                   !! of the figure
      character(*), intent(in) :: number                 !! name of the number
      type(sweep_results_t), intent(in) :: results       !! what the runs gave; two parameters make a grid
      character(*), intent(in) :: heading                !! lines with `#`
      logical, intent(out) :: is_written                 !! whether there was something to draw
      type(error_t), allocatable, intent(out) :: error   !! a file cannot be written

      type(sweep_axis_t) :: axes(2)
      real(wp), allocatable :: values(:, :)
      integer :: at, k

      is_written = .false.
      do at = 1, size(results%names)
         if (results%names(at)%s == number) exit
      end do
      if (at > size(results%names)) return
      do k = 1, 2
         axes(k) = axis_of_parameter(results%sweep%parameters(k))
      end do
      values = values_of(results, at, size(axes(1)%x), size(axes(2)%x))
      if (.not. any(ieee_is_finite(values))) return
      call write_file(folder//"/"//name//".dat", table_text(axes, number//"["//results%units(at)%s//"]", values, heading), error)
      if (.not. allocated(error)) then
         call write_file(folder//"/"//name//".gp", script_of(axes, name, title, number, results%units(at)%s, values), error)
      end if
      is_written = .not. allocated(error)
   end subroutine write_sweep_map

   !> The number of all cases: its mean over the runs.
   function values_of(results, number, n_x, n_y) result(values)
      type(sweep_results_t), intent(in) :: results   !! what the runs gave
      integer, intent(in) :: number                  !! which number
      integer, intent(in) :: n_x                     !! values of the first parameter
      integer, intent(in) :: n_y                     !! values of the second
      real(wp) :: values(n_y, n_x)                   !! (n_y, n_x) the number; NaN: no run has it [any]

      real(wp) :: spread(n_spread)
      integer :: i, j, n

      do j = 1, n_x
         do i = 1, n_y
            call case_numbers(results, (j - 1)*n_y + i, number, n, spread)
            values(i, j) = merge(spread(1), not_a_number(), n > 0)
         end do
      end do
   end function values_of

   !> The table, cases in the order of increasing parameters.
   function table_text(axes, label, values, heading) result(text)
      type(sweep_axis_t), intent(in) :: axes(2)   !! (2) the parameters
      character(*), intent(in) :: label           !! of the number, with its unit
      real(wp), intent(in) :: values(:, :)        !! (n_y, n_x) the number [any]
      character(*), intent(in) :: heading         !! lines with `#`
      character(:), allocatable :: text           !! whole lines

      type(buffer_t) :: lines
      integer :: i, j, x(size(axes(1)%x)), y(size(axes(2)%x))

      x = ascending(axes(1)%x)
      y = ascending(axes(2)%x)
      call lines%add("#")
      do i = 1, 2
         call lines%add(" "//axes(i)%name//"["//axes(i)%unit//"]")
      end do
      call lines%add(" "//label)
      do i = 1, 2
         call lines%add(" "//axes(i)%name//".low["//axes(i)%unit//"] "//axes(i)%name//".high["//axes(i)%unit//"]")
      end do
      call lines%line("")
      call lines%add(heading)
      do j = 1, size(x)
         if (j > 1) call lines%line("")
         do i = 1, size(y)
            call lines%line(number_row([axes(1)%x(x(j)), axes(2)%x(y(i)), values(y(i), x(j)), edges_at(axes(1), x, j), &
                                        edges_at(axes(2), y, i)]))
         end do
      end do
      text = lines%get()
   end function table_text

   !> Order of values, ascending.
   pure function ascending(x) result(order)
      real(wp), intent(in) :: x(:)   !! (n) values [any]
      integer :: order(size(x))      !! (n) their numbers

      integer :: k
      logical :: left(size(x))

      left = .true.
      do k = 1, size(x)
         order(k) = minloc(x, dim=1, mask=left)
         left(order(k)) = .false.
      end do
   end function ascending

   !> Edges of a cell: halfway to its neighbours, as far on the other side where there is none.
   pure function edges_at(axis, order, k) result(edges)
      type(sweep_axis_t), intent(in) :: axis   !! the parameter
      integer, intent(in) :: order(:)          !! (n) its values in their order
      integer, intent(in) :: k                 !! place of the cell in it
      real(wp) :: edges(2)                     !! (2) below, above, SI [any]

      real(wp) :: x(size(order))

      x = axis%x(order)
      if (axis%is_log) x = log(x)
      if (size(x) == 1) then
         edges = x(1) + 0.5_wp*[-1.0_wp, 1.0_wp]*merge(abs(x(1)), 1.0_wp, abs(x(1)) > 0.0_wp)
      else if (k == 1) then
         edges = x(1) + 0.5_wp*[-1.0_wp, 1.0_wp]*(x(2) - x(1))
      else if (k == size(x)) then
         edges = x(k) + 0.5_wp*[-1.0_wp, 1.0_wp]*(x(k) - x(k - 1))
      else
         edges = 0.5_wp*[x(k - 1) + x(k), x(k) + x(k + 1)]
      end if
      if (axis%is_log) edges = exp(edges)
   end function edges_at

   !> Values of contour lines within a range: whole multiples of 1, 2 or 5 times a power of ten.
   pure function levels_in(range) result(levels)
      real(wp), intent(in) :: range(2)        !! (2) minimum and maximum value [the unit shown]
      real(wp), allocatable :: levels(:)      !! (any) increasing [the unit shown]

      real(wp) :: step
      integer :: k

      levels = [real(wp) ::]
      if (.not. range(2) - range(1) > 1.0e-9_wp*maxval(abs(range))) return
      step = 10.0_wp**floor(log10((range(2) - range(1))/most_levels))
      if (most_levels*step < range(2) - range(1)) step = 2.0_wp*step
      if (most_levels*step < range(2) - range(1)) step = 2.5_wp*step
      if (most_levels*step < range(2) - range(1)) step = 2.0_wp*step
      levels = [(step*k, k=floor(range(1)/step) + 1, ceiling(range(2)/step) - 1)]
   end function levels_in

   !> The script.
   function script_of(axes, name, title, number, si, values) result(script)
      type(sweep_axis_t), intent(in) :: axes(2)   !! (2) the parameters
      character(*), intent(in) :: name            !! of the figure
      character(*), intent(in) :: title           !! of the scene, any text
      character(*), intent(in) :: number          !! name of the number
      character(*), intent(in) :: si              !! its SI unit
      real(wp), intent(in) :: values(:, :)        !! (n_y, n_x) the number; NaN: missing [any]
      character(:), allocatable :: script         !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      character(:), allocatable :: cell, cell_place, grid
      real(wp), allocatable :: levels(:)
      real(wp) :: range(2)
      logical :: has_values

      has_values = size(values) <= most_written
      range = [minval(values, mask=ieee_is_finite(values)), maxval(values, mask=ieee_is_finite(values))]
      unit = choose_unit(si, maxval(abs(range)))
      range = unit%factor*range
      levels = levels_in(range)
      if (size(axes(1)%categories) + size(axes(2)%categories) > 0 .or. any(shape(values) < 2) .or. has_values) then
         levels = [real(wp) ::]
      end if
      cell = column_of(1, 1)//":"//column_of(2, 2)
      cell_place = cell
      grid = cell//":"//scaled(3, unit%factor)
      cell = cell//":"//column_of(4, 1)//":"//column_of(5, 1)//":"//column_of(6, 2)//":"//column_of(7, 2)
      call preamble(lines, name, 1200, 900)
      call lines%line("unset key; unset grid; set tics out")
      call lines%line("set title "//quoted(title)//" font ',17'")
      if (size(levels) > 0) call contour_lines()
      call axis_lines("x", 1)
      call axis_lines("y", 2)
      call lines%line("set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')")
      call lines%line("set cblabel "//quoted(with_unit(number, unit))//"; set style textbox opaque margins 0.3,0.2 noborder")
      call lines%line("set cbrange ["//real_text(range(1), 9)//":"// &
                      real_text(merge(range(2), range(1) + max(abs(range(1)), 1.0_wp), range(2) > range(1)), 9)//"]")
      if (any(.not. ieee_is_finite(values))) call lines%line(key_below)
      call lines%add("plot '"//name//".dat' using "//cell//":"//scaled(3, unit%factor)//" with boxxyerror fillcolor palette "// &
                     "fillstyle solid noborder notitle")
      call add_cases()
      call lines%line("")
      call lines%line("unset output")
      script = lines%get()

   contains

      !> What is drawn over the cells.
      subroutine add_cases()
         integer :: k

         if (any(.not. ieee_is_finite(values))) then
            call lines%line(", \")
            call lines%add("     '' using (strcol(3) eq 'NaN' ? "//column_of(1, 1)//" : NaN):"// &
                           cell(len(column_of(1, 1)) + 2:)//" with boxxyerror fillstyle pattern 4 border linecolor rgb "// &
                           "'#808080' title 'no value'")
         end if
         do k = 1, 2  ! black dots within white ones
            call lines%line(", \")
            call lines%add("     '' using (strcol(3) eq 'NaN' ? NaN : "//column_of(1, 1)//"):"//column_of(2, 2)// &
                           " with points pointtype 7 pointsize "//trim(merge("1.1 linecolor rgb '#ffffff'", &
                                                                             "0.7 linecolor rgb '#000000'", k == 1))//" notitle")
         end do
         if (has_values) then
            call lines%line(", \")
            call lines%add("     '' using "//cell_place//":(strcol(3) eq 'NaN' ? '' : sprintf('%.4g', $3*"// &
                           real_text(unit%factor, 9)//")) with labels boxed offset 0,0.9 font ',13' notitle")
         end if
         if (size(levels) > 0) then
            call lines%line(", \")
            call lines%line("     $contours using 1:2 with lines linewidth 1.5 linecolor rgb '#101010' notitle, \")
            call lines%add("     $contours using 1:2:(sprintf('%g', $3)) every ::1::1 with labels boxed font ',12' notitle")
         end if
      end subroutine add_cases

      !> Find the contour lines.
      subroutine contour_lines()
         integer :: i

         call lines%line("set contour base; unset surface")
         call lines%add("set cntrparam levels discrete ")
         do i = 1, size(levels)
            call lines%add(trim(merge(", ", "  ", i > 1))//real_text(levels(i), 9))
         end do
         call lines%line("")
         call lines%line("set table $contours; splot '"//name//".dat' using "//grid//" with lines; unset table")
         call lines%line("unset contour; set surface")
      end subroutine contour_lines

      !> A column in the unit of an axis.
      function column_of(column, axis) result(words)
         integer, intent(in) :: column            !! of the table
         integer, intent(in) :: axis              !! 1 or 2
         character(:), allocatable :: words       !! for `using`

         type(display_unit_t) :: shown

         shown = axes(axis)%unit_shown()
         words = "($"//to_text(column)//"*"//real_text(shown%factor, 9)//")"
      end function column_of

      !> Name, ends and ticks of an axis.
      subroutine axis_lines(letter, axis)
         character, intent(in) :: letter          !! x or y
         integer, intent(in) :: axis              !! 1 or 2

         type(display_unit_t) :: shown
         real(wp) :: ends(2, 2)
         integer :: i, order(size(axes(axis)%x))

         shown = axes(axis)%unit_shown()
         order = ascending(axes(axis)%x)
         ends(:, 1) = shown%factor*edges_at(axes(axis), order, 1)
         ends(:, 2) = shown%factor*edges_at(axes(axis), order, size(order))
         call lines%line("set "//letter//"label "//quoted(with_unit(axes(axis)%name, shown)))
         call lines%line("set "//letter//"range ["//real_text(ends(1, 1), 9)//":"//real_text(ends(2, 2), 9)//"]")
         if (axes(axis)%is_log) call lines%line("set logscale "//letter//"; set format "//letter//" '%g'")
         if (size(axes(axis)%categories) == 0) return
         call lines%add("set "//letter//"tics (")
         do i = 1, size(axes(axis)%categories)
            call lines%add(trim(merge(", ", "  ", i > 1))//quoted(axes(axis)%categories(i)%s)//" "//to_text(i))
         end do
         call lines%line(") noenhanced")
      end subroutine axis_lines

   end function script_of

end module sweep_map
