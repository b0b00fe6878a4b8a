!> The figures of a comparison of settings: cost over error, its second views, the distance of reference runs over time.
!>
!> The numbers stand in `precision.dat`, a block for each setting, then the front and the choice; scripts draw from them. What
!> is within the error of the reference is grey; a run with other contacts or another end is an open diamond; failures stand as
!> crosses at the right edge, at the time after which they failed, their reasons below the panel. What is exactly 0 stands on a mark
!> of its own, below all other numbers.
module precision_plots
   use beyond_plot, only: beyond_rows, beyond_script, has_beyond
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use exponent_plot, only: exponent_rows, exponent_script, has_exponent
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use plot_text, only: quoted
   use horizon_plot, only: horizon_rows, horizon_script
   use precision_legend, only: colour_of, legend_t, sign_of
   use precision_rows, only: any_ledger, any_state, error_axis, front_of, is_above_zero, largest_cpu, number, numbers_of, &
      smallest_cpu, zero_of_errors, zero_of_ledgers
   use precision_results, only: error_names, tol_sweep_t, precision_t, tol_run_done, tol_run_failed, tol_run_other, tol_run_t
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   implicit none (type, external)
   private
   public :: write_precision_plots

   character(*), parameter :: data_name = "precision.dat"        !! file of the numbers

   ! entries of the legend
   character(*), parameter :: other_title = "different contact sequence or end time"
   character(*), parameter :: front_title = "Pareto front"
   character(*), parameter :: tolerance_title = "error = tolerance"

   ! columns of the numbers
   character(*), parameter :: at_error = "2"      !! error requested
   character(*), parameter :: at_cpu = "3"        !! median of the processor time
   character(*), parameter :: at_least = "4"      !! minimum of it
   character(*), parameter :: at_rhs = "5"        !! right-hand sides
   character(*), parameter :: at_steps = "6"      !! steps
   character(*), parameter :: at_ledger = "7"     !! residual of the ledger
   character(*), parameter :: at_asked = "1"      !! tolerance or step
   character(*), parameter :: at_state = "8"      !! state of the run
   character(*), parameter :: at_below = "9"      !! whether the error is within the reference's

contains

   !> Write the numbers and the scripts into the folder of the figures.
   subroutine write_precision_plots(folder, title, heading, study, names, error)
      character(*), intent(in) :: folder                       !! of the figures
      character(*), intent(in) :: title                        !! of the scene, any text
      character(*), intent(in) :: heading                      !! lines with `#`
      type(precision_t), intent(in) :: study                   !! results
      type(text_t), allocatable, intent(out) :: names(:)       !! (n) figures written
      type(error_t), allocatable, intent(out) :: error         !! a file cannot be written

      type(tol_run_t), allocatable :: front(:)

      allocate (names(0))
      call write_file(folder//"/"//data_name, heading//numbers_of(study), error)
      if (allocated(error)) return
      front = front_of(study)
      if (size(front) > 0) then
         call write_file(folder//"/precision.gp", cost_script(study, title), error)
         if (.not. allocated(error)) call write_file(folder//"/precision_views.gp", views_script(study, title), error)
         if (allocated(error)) return
         call append_text(names, "precision")
         call append_text(names, "precision_views")
      end if
      if (study%growth%reason == "") then
         call write_file(folder//"/horizon.dat", heading//horizon_rows(study), error)
         if (.not. allocated(error)) call write_file(folder//"/horizon.gp", horizon_script(study, title), error)
         if (allocated(error)) return
         call append_text(names, "horizon")
      end if
      if (has_beyond(study)) then
         call write_file(folder//"/precision_statistics.dat", heading//beyond_rows(study), error)
         if (.not. allocated(error)) call write_file(folder//"/precision_statistics.gp", beyond_script(study, title), error)
         if (allocated(error)) return
         call append_text(names, "precision_statistics")
      end if
      if (.not. has_exponent(study%horizon)) return
      call write_file(folder//"/exponent.dat", heading//exponent_rows(study%horizon), error)
      if (.not. allocated(error)) call write_file(folder//"/exponent.gp", exponent_script(study%horizon, title), error)
      if (.not. allocated(error)) call append_text(names, "exponent")
   end subroutine write_precision_plots

   !> Processor time over error.
   function cost_script(study, title) result(script)
      type(precision_t), intent(in) :: study   !! results
      character(*), intent(in) :: title        !! of the scene, any text
      character(:), allocatable :: script      !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: cpu
      type(legend_t) :: legend
      integer :: n

      n = size(study%tol_sweeps)
      cpu = choose_unit("s", largest_cpu(study))
      call legend%begin(lines, study, "precision", [1150, 850], titles_of(study), .true.)
      call legend%place(lines)
      call begin_axes(lines)
      call lines%line("set title "//quoted(title)//" font ',17'")
      call lines%line("set xlabel "//quoted(error_label(study)))
      call lines%line("set ylabel "//quoted("CPU time ["//cpu%symbol//"], median; bar to the minimum"))
      call add_limits(lines, study)
      call lines%line("f = "//real_text(cpu%factor, 9))
      call add_curves(lines, study, at_error, "($"//at_cpu//"*f)", "($"//at_least//"*f)", .true.)
      call add_failures(lines, study)
      if (any_state(study, tol_run_other)) call lines%line("     NaN with points pointtype 12 pointsize 1.2 linewidth 1.5 "// &
         "linecolor rgb '#404040' title "//quoted(other_title)//", \")
      call lines%line("     '"//data_name//"' index "//to_text(n)//" using "//at_error//":($"//at_cpu// &
                      "*f) with lines linecolor rgb '#000000' linewidth 1 dashtype 3 title "//quoted(front_title)//", \")
      call lines%line("     '"//data_name//"' index "//to_text(n + 1)//" using "//at_error//":($"//at_cpu// &
                      "*f) with points pointtype 6 pointsize 3 linewidth 2.5 linecolor rgb '#000000' title "// &
                      quoted(choice_title(study)))
      call lines%line("unset output")
      script = lines%get()
   end function cost_script

   !> Scales of both axes.
   subroutine begin_axes(lines)
      type(buffer_t), intent(inout) :: lines    !! the script

      call lines%line("set logscale xy; set format x '%.0e'; set format y '%g'")
      call lines%line("set mxtics 10; set mytics 10; set datafile missing 'NaN'")
   end subroutine begin_axes

   !> What stands below the axis of the error.
   function error_label(study) result(label)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: label          !! one line

      label = "maximum error of "//trim(error_names(study%wanted))//" [1], relative to the range of motion or the maximum value"
      if (study%reference%is_cut .and. .not. study%reference%is_unsure) then
         label = label//", up to "//real_text(study%reference%window, 3)//" s"
      end if
   end function error_label

   !> The error of the reference, and the error requested; the axis reaches to both, in whole decades.
   subroutine add_limits(lines, study)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results

      character(:), allocatable :: bar
      integer :: ends(2)

      ends = error_axis(study)
      if (is_above_zero(study%reference%bar(study%wanted))) then
         bar = number(study%reference%bar(study%wanted))
         call lines%line("set object 1 rectangle from graph 0, graph 0 to first "//bar//", graph 1 behind "// &
                         "fillcolor rgb '#f0f0f0' fillstyle solid noborder")
         call lines%line("set arrow 1 from first "//bar//", graph 0 to first "//bar//", graph 1 nohead linewidth 1.5 "// &
                         "linecolor rgb '#909090'")
         call lines%line("set label 1 "//quoted("error of the reference")//" at first "//bar// &
                         ", graph 0.02 left rotate by 90 offset -0.8,0 font ',12' textcolor rgb '#606060'")
      end if
      call lines%line("set arrow 2 from first "//number(study%accuracy)//", graph 0 to first "//number(study%accuracy)// &
                      ", graph 1 nohead linewidth 1.5 dashtype 2 linecolor rgb '#404040'")
      call lines%line("set label 2 "//quoted("target error")//" at first "//number(study%accuracy)// &
                      ", graph 0.02 left rotate by 90 offset -0.8,0 font ',12' textcolor rgb '#404040'")
      call lines%line("set xrange [1e"//to_text(ends(1))//":1e"//to_text(ends(2))//"]")
      call mark_zero(lines, "x", zero_of_errors(study))
      if (ieee_is_finite(zero_of_errors(study))) call lines%line("set label 3 'zero error' at first "// &
         number(zero_of_errors(study))//", graph 0.02 left rotate by 90 offset 0.8,0 font ',12' textcolor rgb '#606060'")
   end subroutine add_limits

   !> Mark the place at which numbers of exactly 0 are drawn, if there are any.
   subroutine mark_zero(lines, axis, place)
      type(buffer_t), intent(inout) :: lines    !! the script
      character(*), intent(in) :: axis          !! x or y
      real(wp), intent(in) :: place             !! not a number: there are none [any]

      call lines%line("unset "//axis//"tics; set "//axis//"tics")
      if (ieee_is_finite(place)) call lines%line("set "//axis//"tics add ('0' "//number(place)//")")
   end subroutine mark_zero

   !> Curves of all settings; the plot command stays open.
   subroutine add_curves(lines, study, x, y, low, with_titles)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results
      character(*), intent(in) :: x             !! column of the abscissa
      character(*), intent(in) :: y             !! ordinate, a column or a term
      character(*), intent(in) :: low           !! lower end of a bar, blank: there is none
      logical, intent(in) :: with_titles        !! curves stand in the legend

      character(:), allocatable :: colour, sign
      integer :: k

      do k = 1, size(study%tol_sweeps)
         colour = "linecolor rgb '"//colour_of(k)//"'"
         sign = " with points pointtype "//sign_of(k)//" pointsize 0.9 "
         call lines%line(merge("plot ", "     ", k == 1)//block(k)//picked(x, "$"//at_state//"==1", y)// &
                         " with lines linewidth 1 "//colour//" notitle, \")
         call lines%line("     "//block(k)//picked(x, "$"//at_state//"==1 && $"//at_below//"==1", y)// &
                         sign//"linecolor rgb '#b0b0b0' notitle, \")
         call lines%line("     "//block(k)//picked(x, "$"//at_state//"==3", y)//" with points pointtype 12 pointsize 1.2 "// &
                         "linewidth 1.5 "//colour//" notitle, \")
         if (low /= "") then
            call lines%line("     "//block(k)//picked(x, "$"//at_state//"==1 && $"//at_below//"==0", y)//":"//low//":"//y// &
                            " with yerrorbars pointtype 0 linewidth 1 "//colour//" notitle, \")
         end if
         call lines%line("     "//block(k)//picked(x, "$"//at_state//"==1 && $"//at_below//"==0", y)// &
                         sign//colour//" notitle, \")
         if (.not. (with_titles .and. has_curve(study%tol_sweeps(k)))) cycle
         ! an entry of its own: curves all of whose points are grey have one too
         call lines%line("     keyentry"//sign//colour//" title "//quoted(title_of(study%tol_sweeps(k)))//", \")
      end do
   end subroutine add_curves

   !> A block of the numbers.
   function block(k) result(words)
      integer, intent(in) :: k                 !! number of the setting, from 1
      character(:), allocatable :: words       !! as `'precision.dat' index 0 using `

      words = "'"//data_name//"' index "//to_text(k - 1)//" using "
   end function block

   !> Abscissa and ordinate where a condition holds.
   function picked(x, condition, y) result(words)
      character(*), intent(in) :: x            !! column of the abscissa
      character(*), intent(in) :: condition    !! for a row
      character(*), intent(in) :: y            !! ordinate
      character(:), allocatable :: words       !! for `using`

      words = "(("//condition//") ? $"//x//" : NaN):"//y
   end function picked

   !> Failures at the right edge.
   subroutine add_failures(lines, study)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results

      integer :: ends(2), k

      ends = error_axis(study)
      do k = 1, size(study%tol_sweeps)
         if (all(study%tol_sweeps(k)%tol_runs%state /= tol_run_failed)) cycle
         call lines%line("     "//block(k)//"(($"//at_state//"==2) ? 1e"//to_text(ends(2))//" : NaN):(($"// &
                         at_cpu//">0) ? $"//at_cpu//"*f : "//number(smallest_cpu(study))// &
                         "*f) with points pointtype 2 pointsize 1.3 linewidth 2 linecolor rgb '"//colour_of(k)//"' notitle, \")
      end do
   end subroutine add_failures

   !> What stands in the legend: settings, runs that are another motion, the front and the choice.
   function titles_of(study) result(titles)
      type(precision_t), intent(in) :: study          !! results
      type(text_t), allocatable :: titles(:)          !! (n) its entries

      integer :: k

      allocate (titles(0))
      do k = 1, size(study%tol_sweeps)
         if (has_curve(study%tol_sweeps(k))) call append_text(titles, title_of(study%tol_sweeps(k)))
      end do
      if (any_state(study, tol_run_other)) call append_text(titles, other_title)
      call append_text(titles, front_title)
      call append_text(titles, choice_title(study))
   end function titles_of

   !> What stands in the legend of the views: error equal to tolerance, and the settings.
   function view_titles(study) result(titles)
      type(precision_t), intent(in) :: study          !! results
      type(text_t), allocatable :: titles(:)          !! (n) its entries

      integer :: k

      allocate (titles(0))
      call append_text(titles, tolerance_title)
      do k = 1, size(study%tol_sweeps)
         if (has_curve(study%tol_sweeps(k))) call append_text(titles, title_of(study%tol_sweeps(k)))
      end do
   end function view_titles

   !> Whether a setting has runs that came to their end.
   pure logical function has_curve(tol_sweep)
      type(tol_sweep_t), intent(in) :: tol_sweep        !! the setting

      has_curve = any(tol_sweep%tol_runs%state == tol_run_done .or. tol_sweep%tol_runs%state == tol_run_other)
   end function has_curve

   !> A setting in the legend.
   function title_of(tol_sweep) result(title)
      type(tol_sweep_t), intent(in) :: tol_sweep        !! the setting
      character(:), allocatable :: title          !! as `rk4 (steps)`

      title = tol_sweep%name//trim(merge(" (steps)", "        ", tol_sweep%is_fixed))
   end function title_of

   !> The choice as text.
   function choice_title(study) result(words)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: words          !! one line

      words = "no setting reaches the target error"
      if (study%choice%tol_sweep == 0) return
      associate (tol_sweep => study%tol_sweeps(study%choice%tol_sweep))
         words = "choice: "//tol_sweep%name//" "//real_text(tol_sweep%tol_runs(study%choice%tol_run)%asked, 3)
         if (tol_sweep%is_fixed) words = words//" s"
      end associate
   end function choice_title

   !> Right-hand sides over error, processor time over the ledger's residual, error over what was asked, error over steps.
   function views_script(study, title) result(script)
      type(precision_t), intent(in) :: study   !! results
      character(*), intent(in) :: title        !! of the scene, any text
      character(:), allocatable :: script      !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: cpu
      type(legend_t) :: legend
      character(:), allocatable :: label

      cpu = choose_unit("s", largest_cpu(study))
      label = "error of "//trim(error_names(study%wanted))//" [1]"
      call legend%begin(lines, study, "precision_views", [1600, 1250], view_titles(study), .false.)
      call begin_axes(lines)
      call lines%line("unset key; f = "//real_text(cpu%factor, 9))
      call lines%line("set multiplot layout 2,2 title "//quoted(title)//" font ',17' "//legend%margins())
      call add_limits(lines, study)
      call panel(label, "right-hand sides", "$"//at_rhs, at_error)
      call mark_zero(lines, "x", zero_of_ledgers(study))
      call lines%line("unset arrow; unset label; unset object; set xrange [*:*]")
      if (any_ledger(study)) call panel("energy error [1], relative to the maximum energy", &
                                        "CPU time of the integration ["//cpu%symbol//"]", "$"//at_cpu//"*f", at_ledger)
      call legend%place(lines)
      call mark_zero(lines, "x", not_a_number())
      call mark_zero(lines, "y", zero_of_errors(study))
      call panel("tolerance [1], or step [s]", label, "$"//at_error, at_asked, "x with lines linewidth 1 dashtype 2 "// &
                 "linecolor rgb '#404040' title "//quoted(tolerance_title)//", ")
      call lines%line("unset key")
      call panel("accepted steps", label, "$"//at_error, at_steps)
      call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()

   contains

      !> A panel.
      subroutine panel(x_label, y_label, y, x, first)
         character(*), intent(in) :: x_label          !! below the abscissa
         character(*), intent(in) :: y_label          !! beside the ordinate
         character(*), intent(in) :: y                !! ordinate, a term
         character(*), intent(in) :: x                !! column of the abscissa
         character(*), intent(in), optional :: first  !! a curve before the others

         type(buffer_t) :: curves
         character(:), allocatable :: command

         call lines%line("set xlabel "//quoted(x_label))
         call lines%line("set ylabel "//quoted(y_label))
         call lines%line("set format xy '%.0e'")
         call add_curves(curves, study, x, "("//y//")", "", .true.)
         command = curves%get()
         command = command(:len(command) - 4)//new_line("a")  ! without the sign that more follows
         if (present(first)) command = "plot "//first//command(6:)
         call lines%add(command)
      end subroutine panel

   end function views_script

end module precision_plots
