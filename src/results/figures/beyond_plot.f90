!> The figure of statistics beyond the time that is compared: of runs that go their own way, over the tolerance, with intervals,
!> beside the reference's.
module beyond_plot
   use display_units, only: choose_unit, display_unit_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use plot_text, only: quoted
   use precision_results, only: n_statistic, precision_t, statistic_rate, statistic_units, statistic_words
   use precision_rows, only: number
   use script_parts, only: colours, preamble
   use text, only: real_text, to_text
   use text_buffer, only: buffer_t
   implicit none (type, external)
   private
   public :: beyond_rows, beyond_script, has_beyond

   character(*), parameter :: data_name = "precision_statistics.dat"   !! file of the numbers

contains

   !> Whether there is anything to draw.
   pure logical function has_beyond(study)
      type(precision_t), intent(in) :: study   !! results

      integer :: k

      has_beyond = study%reference%statistics%is_there
      if (has_beyond) has_beyond = any(ieee_is_finite(study%reference%statistics%list%half))
      if (has_beyond) has_beyond = any([(any(study%tol_sweeps(k)%tol_runs%statistics%is_own), k=1, size(study%tol_sweeps))])
   end function has_beyond

   !> The numbers: a block for each setting, two blank lines between them.
   function beyond_rows(study) result(text)
      type(precision_t), intent(in) :: study   !! results
      character(:), allocatable :: text        !! whole lines

      type(buffer_t) :: lines
      integer :: i, k, s

      call lines%line("# tolerance or step [1 or s], 1: diverged from the reference, then value and half-width of each: "// &
         "contacts per time,")
      call lines%line("# impact speed, peak force, velocities, reactions; SI")
      do k = 1, size(study%tol_sweeps)
         call lines%line("# "//study%tol_sweeps(k)%name)
         do i = 1, size(study%tol_sweeps(k)%tol_runs)
            associate (tol_run => study%tol_sweeps(k)%tol_runs(i))
               call lines%add(number(tol_run%asked)//" "//to_text(merge(1, 0, tol_run%statistics%is_own)))
               do s = 1, n_statistic
                  call lines%add(" "//number(tol_run%statistics%list(s)%value)//" "//number(tol_run%statistics%list(s)%half))
               end do
               call lines%line("")
            end associate
         end do
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()
   end function beyond_rows

   !> A panel for each statistic whose interval is known.
   function beyond_script(study, title) result(script)
      type(precision_t), intent(in) :: study   !! results
      character(*), intent(in) :: title        !! of the scene, any text
      character(:), allocatable :: script      !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: time
      real(wp) :: minimum, most
      integer :: k, rows, s

      rows = (count(ieee_is_finite(study%reference%statistics%list%half)) + 2)/2
      minimum = huge(1.0_wp)
      most = 0.0_wp
      do k = 1, size(study%tol_sweeps)
         associate (tol_runs => study%tol_sweeps(k)%tol_runs)
            minimum = min(minimum, minval(tol_runs%asked, mask=tol_runs%statistics%is_own))
            most = max(most, maxval(tol_runs%asked, mask=tol_runs%statistics%is_own))
         end associate
      end do
      time = choose_unit("s", study%end)
      call preamble(lines, "precision_statistics", 1300, 60 + 360*rows)
      call lines%line("set multiplot layout "//to_text(rows)//",2 title "//quoted(title//", beyond the comparison window: "// &
                      real_text(study%reference%statistics%from*time%factor, 4)//" to "// &
                      real_text(study%end*time%factor, 4)//" "//time%symbol)//" font ',17'")
      call lines%line("set logscale x; set format x '%.0e'; set xtics 100; set datafile missing 'NaN'")
      call lines%line("set xrange ["//number(0.5_wp*minimum)//":"//number(2.0_wp*most)//"]")
      call lines%line("set xlabel 'tolerance [1], or step [s]'")
      call lines%line("set key noautotitle; unset key")
      do s = 1, n_statistic
         if (.not. ieee_is_finite(study%reference%statistics%list(s)%half)) cycle
         call add_panel(lines, study, s)
      end do
      call add_legend(lines, study)
      call lines%line("unset multiplot")
      call lines%line("unset output")
      script = lines%get()
   end function beyond_script

   !> One statistic of all runs, with the reference and its interval behind them.
   subroutine add_panel(lines, study, s)
      type(buffer_t), intent(inout) :: lines   !! the script
      type(precision_t), intent(in) :: study   !! results
      integer, intent(in) :: s                 !! the statistic

      type(display_unit_t) :: unit
      integer :: k

      associate (of_reference => study%reference%statistics%list(s))
         unit = choose_unit(trim(statistic_units(s)), of_reference%value)
         call lines%line("set title "//quoted(trim(statistic_words(s)))//" font ',14'")
         call lines%line("set ylabel "//quoted("["//unit%symbol//"]"))
         call lines%line("f = "//real_text(unit%factor, 9))
         call lines%line("set object 1 rectangle from graph 0, first "// &
                         number((of_reference%value - of_reference%half)*unit%factor)//" to graph 1, first "// &
                         number((of_reference%value + of_reference%half)*unit%factor)// &
                         " behind fillcolor rgb '#e8e8e8' fillstyle solid noborder")
         call lines%line(trim(merge("set yrange [0:*]  ", "set yrange [0<*:*]", s == statistic_rate)))
         call lines%line("plot "//number(of_reference%value*unit%factor)//" with lines linewidth 1.5 linecolor rgb '#606060', \")
      end associate
      do k = 1, size(study%tol_sweeps)
         call lines%line("     '"//data_name//"' index "//to_text(k - 1)//" using ($1*"//beside(k)//"):($2 == 1 ? $"// &
                         to_text(2*s + 1)//"*f : NaN):($"//to_text(2*s + 2)//"*f) "//drawn(k)// &
                         trim(merge(", \", "   ", k < size(study%tol_sweeps))))
      end do
      call lines%line("set yrange [*:*]")

   contains

      !> Factor of the tolerance by which runs of a setting stand beside those of others.
      function beside(k) result(factor)
         integer, intent(in) :: k                 !! number of the setting, from 1
         character(:), allocatable :: factor      !! as text

         real(wp), parameter :: room = 0.2_wp     ! for all of them, of a decade; tolerances are a quarter apart

         factor = real_text(10.0_wp**(room*((real(k, wp) - 0.5_wp)/real(size(study%tol_sweeps), wp) - 0.5_wp)), 6)
      end function beside

   end subroutine add_panel

   !> A panel with the legend alone.
   subroutine add_legend(lines, study)
      type(buffer_t), intent(inout) :: lines   !! the script
      type(precision_t), intent(in) :: study   !! results

      integer :: k

      call lines%line("unset border; unset tics; unset xlabel; unset ylabel; unset title; unset object; unset grid")
      call lines%line("set key inside center center vertical Left reverse samplen 2 spacing 1.3")
      call lines%line("unset logscale; set xrange [0:1]; set yrange [0:1]")
      call lines%line("plot NaN with lines linewidth 1.5 linecolor rgb '#606060' title 'reference, 95 % interval grey', \")
      do k = 1, size(study%tol_sweeps)
         call lines%line("     '+' using (0.5):(-1):(0.1) "//drawn(k)//" title "// &
                         quoted(study%tol_sweeps(k)%name//trim(merge(" (steps)", "        ", study%tol_sweeps(k)%is_fixed)))// &
                         trim(merge(", \", "   ", k < size(study%tol_sweeps))))
      end do
   end subroutine add_legend

   !> How the runs of a setting are drawn.
   function drawn(k) result(words)
      integer, intent(in) :: k                 !! number of the setting, from 1
      character(:), allocatable :: words       !! for a curve

      words = "with yerrorbars pointtype 7 pointsize 0.8 linewidth 1 linecolor rgb '"//colours(mod(k - 1, size(colours)) + 1)//"'"
   end function drawn

end module beyond_plot
