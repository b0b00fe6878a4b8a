!> The figures of a comparison of settings: cost over error, its second views, the distance of twins over time.
!>
!> The numbers stand in `precision.dat`, a block for each setting, then the front and the choice; scripts draw from them. What
!> is within the error of the reference is grey; a run with other contacts or another end is an open diamond; failures stand as
!> crosses at the right edge, at the time after which they failed, their reasons in the legend.
module precision_plots
   use beyond_plot, only: beyond_rows, beyond_script, has_beyond
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use exponent_plot, only: exponent_rows, exponent_script, has_exponent
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use plot_text, only: quoted
   use horizon_plot, only: horizon_rows, horizon_script
   use precision_rows, only: drawn_error, front_of, least_error, number, numbers_of
   use precision_results, only: error_ledger, error_names, precision_t, rung_done, rung_failed, rung_other, rung_t, &
      rung_unrun
   use script_parts, only: colours, preamble
   use text, only: append_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   implicit none (type, external)
   private
   public :: write_precision_plots

   character(*), parameter :: data_name = "precision.dat"        !! file of the numbers
   real(wp), parameter :: decade = 0.2_wp   !! room beside an error, of it, for which the axis has another decade [1]

   ! columns of the numbers
   character(*), parameter :: at_error = "2"      !! error wanted
   character(*), parameter :: at_cpu = "3"        !! median of the processor time
   character(*), parameter :: at_least = "4"      !! least of it
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

      type(rung_t), allocatable :: front(:)

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
      integer :: n

      n = size(study%ladders)
      cpu = choose_unit("s", largest_cpu(study))
      call preamble(lines, "precision", 1300, 950)
      call begin_axes(lines, study)
      call lines%line("set title "//quoted(title)//" font ',17'")
      call lines%line("set xlabel "//quoted(error_label(study)))
      call lines%line("set ylabel "//quoted("CPU time ["//cpu%symbol//"], median; bar to the least"))
      call add_limits(lines, study)
      call lines%line("f = "//real_text(cpu%factor, 9))
      call add_curves(lines, study, at_error, "($"//at_cpu//"*f)", "($"//at_least//"*f)", .true.)
      call add_failures(lines, study)
      if (any_state(study, rung_other)) call lines%line("     NaN with points pointtype 12 pointsize 1.2 linewidth 1.5 "// &
         "linecolor rgb '#404040' title 'other contacts, or another end', \")
      call lines%line("     '"//data_name//"' index "//to_text(n)//" using "//at_error//":($"//at_cpu// &
                      "*f) with lines linecolor rgb '#000000' linewidth 1 dashtype 3 title 'front of best settings', \")
      call lines%line("     '"//data_name//"' index "//to_text(n + 1)//" using "//at_error//":($"//at_cpu// &
                      "*f) with points pointtype 6 pointsize 3 linewidth 2.5 linecolor rgb '#000000' title "// &
                      quoted(choice_title(study)))
      call lines%line("unset output")
      script = lines%get()
   end function cost_script

   !> Scales of both axes.
   subroutine begin_axes(lines, study)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results

      call lines%line("set key noautotitle below center horizontal Left reverse samplen 2 spacing 1.15 maxcols 3")
      call lines%line("set logscale xy; set format x '%.0e'; set format y '%g'")
      call lines%line("set mxtics 10; set mytics 10; set datafile missing 'NaN'")
   end subroutine begin_axes

   !> What stands below the axis of the error.
   function error_label(study) result(label)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: label          !! one line

      label = "greatest error of "//trim(error_names(study%wanted))//" [1], of the range of motion or the greatest value"
      if (study%reference%is_cut .and. .not. study%reference%is_unsure) then
         label = label//", up to "//real_text(study%reference%window, 3)//" s"
      end if
   end function error_label

   !> The error of the reference, and the error wanted; the axis reaches to both, in whole decades.
   subroutine add_limits(lines, study)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results

      character(:), allocatable :: bar
      real(wp) :: ends(2), x
      integer :: i, k

      ends = study%accuracy
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            x = drawn_error(study, study%ladders(k)%rungs(i))
            if (ieee_is_finite(x)) ends = [min(ends(1), x), max(ends(2), x)]
         end do
      end do
      if (ieee_is_finite(study%reference%bar(study%wanted))) then
         ends(1) = min(ends(1), max(study%reference%bar(study%wanted), least_error))
         ends(2) = max(ends(2), study%reference%bar(study%wanted))
         bar = number(max(study%reference%bar(study%wanted), least_error))
         call lines%line("set object 1 rectangle from graph 0, graph 0 to first "//bar//", graph 1 behind "// &
                         "fillcolor rgb '#f0f0f0' fillstyle solid noborder")
         call lines%line("set arrow 1 from first "//bar//", graph 0 to first "//bar//", graph 1 nohead linewidth 1.5 "// &
                         "linecolor rgb '#909090'")
         call lines%line("set label 1 "//quoted("error of the reference")//" at first "//bar// &
                         ", graph 0.02 left rotate by 90 offset -0.8,0 font ',12' textcolor rgb '#606060'")
      end if
      call lines%line("set arrow 2 from first "//number(study%accuracy)//", graph 0 to first "//number(study%accuracy)// &
                      ", graph 1 nohead linewidth 1.5 dashtype 2 linecolor rgb '#404040'")
      call lines%line("set label 2 "//quoted("error wanted")//" at first "//number(study%accuracy)// &
                      ", graph 0.02 left rotate by 90 offset -0.8,0 font ',12' textcolor rgb '#404040'")
      call lines%line("set xrange [1e"//to_text(floor(log10(ends(1)*(1.0_wp - decade))))//":1e"// &
                      to_text(ceiling(log10(ends(2)*(1.0_wp + decade))))//"]")
   end subroutine add_limits

   !> Curves of all settings; the plot command stays open.
   subroutine add_curves(lines, study, x, y, low, with_titles)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results
      character(*), intent(in) :: x             !! column of the abscissa
      character(*), intent(in) :: y             !! ordinate, a column or a term
      character(*), intent(in) :: low           !! lower end of a bar, blank: there is none
      logical, intent(in) :: with_titles        !! curves stand in the legend

      character(:), allocatable :: colour
      integer :: k

      do k = 1, size(study%ladders)
         colour = "linecolor rgb '"//colours(mod(k - 1, size(colours)) + 1)//"'"
         call lines%line(merge("plot ", "     ", k == 1)//block(k)//picked(x, "$"//at_state//"==1", y)// &
                         " with lines linewidth 1 "//colour//" notitle, \")
         call lines%line("     "//block(k)//picked(x, "$"//at_state//"==1 && $"//at_below//"==1", y)// &
                         " with points pointtype 7 pointsize 0.9 linecolor rgb '#b0b0b0' notitle, \")
         call lines%line("     "//block(k)//picked(x, "$"//at_state//"==3", y)//" with points pointtype 12 pointsize 1.2 "// &
                         "linewidth 1.5 "//colour//" notitle, \")
         if (low /= "") then
            call lines%line("     "//block(k)//picked(x, "$"//at_state//"==1 && $"//at_below//"==0", y)//":"//low//":"//y// &
                            " with yerrorbars pointtype 0 linewidth 1 "//colour//" notitle, \")
         end if
         call lines%line("     "//block(k)//picked(x, "$"//at_state//"==1 && $"//at_below//"==0", y)// &
                         " with points pointtype 7 pointsize 0.9 "//colour//" notitle, \")
         associate (ladder => study%ladders(k))
            if (.not. with_titles .or. all(ladder%rungs%state /= rung_done .and. ladder%rungs%state /= rung_other)) cycle
            ! an entry of its own: curves all of whose points are grey have one too
            call lines%line("     keyentry with points pointtype 7 pointsize 0.9 "//colour//" title "// &
                            quoted(ladder%name//trim(merge(" (steps)", "        ", ladder%is_fixed)))//", \")
         end associate
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

   !> Failures at the right edge, each reason of a setting once in the legend, and the settings no run of which was made.
   subroutine add_failures(lines, study)
      type(buffer_t), intent(inout) :: lines    !! the script
      type(precision_t), intent(in) :: study    !! results

      character(:), allocatable :: colour, edge, told
      integer :: i, k, n

      edge = number(10.0_wp*largest_error(study))
      do k = 1, size(study%ladders)
         told = ""
         colour = "linecolor rgb '"//colours(mod(k - 1, size(colours)) + 1)//"'"
         associate (rungs => study%ladders(k)%rungs)
            if (all(rungs%state == rung_unrun)) then
               call lines%line("     keyentry with points pointtype 1 pointsize 1 "//colour//" title "// &
                               quoted(study%ladders(k)%name//" not run: "//rungs(1)%reason)//", \")
            end if
            n = count(rungs%state == rung_failed)
            if (n == 0) cycle
            do i = 1, size(rungs)
               if (rungs(i)%state /= rung_failed) cycle
               if (told == "") told = study%ladders(k)%name//" failed: "//rungs(i)%reason
            end do
            if (n > 1) told = told//" ("//to_text(n)//" runs)"
            call lines%line("     "//block(k)//"(($"//at_state//"==2) ? "//edge//" : NaN):(($"//at_cpu//">0) ? $"//at_cpu// &
                            "*f : "//number(smallest_cpu(study))//"*f) with points pointtype 2 pointsize 1.3 linewidth 2 "// &
                            colour//" title "//quoted(told)//", \")
         end associate
      end do
   end subroutine add_failures

   !> The choice in words.
   function choice_title(study) result(words)
      type(precision_t), intent(in) :: study      !! results
      character(:), allocatable :: words          !! one line

      words = "no setting reaches the error wanted"
      if (study%choice%ladder == 0) return
      associate (ladder => study%ladders(study%choice%ladder))
         words = "choice: "//ladder%name//" "//real_text(ladder%rungs(study%choice%rung)%asked, 3)
         if (ladder%is_fixed) words = words//" s"
      end associate
   end function choice_title

   !> Right-hand sides over error, processor time over the ledger's residual, error over what was asked, error over steps.
   function views_script(study, title) result(script)
      type(precision_t), intent(in) :: study   !! results
      character(*), intent(in) :: title        !! of the scene, any text
      character(:), allocatable :: script      !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: cpu
      character(:), allocatable :: label

      cpu = choose_unit("s", largest_cpu(study))
      label = "error of "//trim(error_names(study%wanted))//" [1]"
      call preamble(lines, "precision_views", 1600, 1250)
      call begin_axes(lines, study)
      call lines%line("unset key; f = "//real_text(cpu%factor, 9))
      call lines%line("set multiplot layout 2,2 title "//quoted(title)//" font ',17'")
      call add_limits(lines, study)
      call panel(label, "right-hand sides", "$"//at_rhs, at_error)
      call lines%line("unset arrow; unset label; unset object; set xrange [*:*]")
      if (any_ledger(study)) call panel("residual of the energy ledger [1], of the largest energy", &
                                        "CPU time of the solution ["//cpu%symbol//"]", "$"//at_cpu//"*f", at_ledger)
      call lines%line("set key inside bottom right vertical Left reverse samplen 1.5 spacing 1.1 font ',12' opaque")
      call panel("tolerance asked [1], or step [s]", label, "$"//at_error, at_asked, "x with lines linewidth 1 dashtype 2 "// &
                 "linecolor rgb '#404040' title 'error = tolerance', ")
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

   !> Whether any run is in some state.
   pure logical function any_state(study, state)
      type(precision_t), intent(in) :: study  !! results
      integer, intent(in) :: state            !! of a run

      integer :: k

      any_state = .false.
      do k = 1, size(study%ladders)
         any_state = any_state .or. any(study%ladders(k)%rungs%state == state)
      end do
   end function any_state

   !> Whether any run kept its ledger.
   pure logical function any_ledger(study)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      any_ledger = .false.
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (ieee_is_finite(study%ladders(k)%rungs(i)%error(error_ledger))) any_ledger = .true.
         end do
      end do
   end function any_ledger

   !> Greatest error that is drawn.
   pure real(wp) function largest_error(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      x = study%accuracy
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            associate (rung => study%ladders(k)%rungs(i))
               if (rung%state /= rung_done .and. rung%state /= rung_other) cycle
               if (ieee_is_finite(rung%error(study%wanted))) x = max(x, rung%error(study%wanted))
            end associate
         end do
      end do
   end function largest_error

   !> Greatest processor time.
   pure real(wp) function largest_cpu(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      x = 0.0_wp
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (ieee_is_finite(study%ladders(k)%rungs(i)%cpu)) x = max(x, study%ladders(k)%rungs(i)%cpu)
         end do
      end do
   end function largest_cpu

   !> Least processor time of a run that ended.
   pure real(wp) function smallest_cpu(study) result(x)
      type(precision_t), intent(in) :: study  !! results

      integer :: i, k

      x = largest_cpu(study)
      do k = 1, size(study%ladders)
         do i = 1, size(study%ladders(k)%rungs)
            if (study%ladders(k)%rungs(i)%state == rung_done) x = min(x, study%ladders(k)%rungs(i)%cpu)
         end do
      end do
   end function smallest_cpu

end module precision_plots
