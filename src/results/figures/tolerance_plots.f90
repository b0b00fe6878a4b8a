!> The figures of a study of tolerances: contributors, histograms with limits, bands over the motion; a panel for each channel.
!>
!> `tolerance_contributors.dat` has a block for each channel: name in quotes, part of the variance to first order, Sobol' index,
!> total index. `tolerance_histogram.dat`: lower and upper edge of each bin, members. `tolerance_band.dat`: time, and less the
!> nominal value: ends of the worst case, ends of the nominal 95 % of members (mean and 1.96 standard deviations), the mean.
module tolerance_plots
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use normal_distribution, only: normal_95
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: append_text, exact_text, real_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   use tolerance_results, only: tolerance_study_t
   use variance_plot, only: variance_rows, variance_script
   implicit none (type, external)
   private
   public :: write_tolerance_plots

   integer, parameter :: most_panels = 6       !! channels that are drawn
   integer, parameter :: fewest_times = 3      !! output times of a band over the motion
   integer, parameter :: most_members = 40     !! contributors that are drawn

contains

   !> Write numbers and scripts into the folder of the figures.
   subroutine write_tolerance_plots(folder, title, heading, study, names, error)
      character(*), intent(in) :: folder                       !! of the figures
      character(*), intent(in) :: title                        !! of the scene, any text
      character(*), intent(in) :: heading                      !! lines with `#`
      type(tolerance_study_t), intent(in) :: study             !! the study
      type(text_t), allocatable, intent(out) :: names(:)       !! (n) figures written
      type(error_t), allocatable, intent(out) :: error         !! a file cannot be written

      allocate (names(0))
      if (.not. any(study%sigma > 0.0_wp)) return
      call add("tolerance_contributors", contributor_rows(study), contributor_script(study, title))
      if (.not. allocated(error)) call add("tolerance_histogram", histogram_rows(study), histogram_script(study, title))
      if (allocated(study%splits) .and. .not. allocated(error)) then
         call add("tolerance_variance", variance_rows(study), variance_script(study, title))
      end if
      if (size(study%derivatives%instants) < fewest_times .or. allocated(error)) return
      call add("tolerance_band", band_rows(study), band_script(study, title))

   contains

      !> Write the files of a figure.
      subroutine add(name, rows, script)
         character(*), intent(in) :: name     !! of the figure
         character(*), intent(in) :: rows     !! its numbers
         character(*), intent(in) :: script   !! its script

         call write_file(folder//"/"//name//".dat", heading//rows, error)
         if (.not. allocated(error)) call write_file(folder//"/"//name//".gp", script, error)
         if (.not. allocated(error)) call append_text(names, name)
      end subroutine add

   end subroutine write_tolerance_plots

   !> Number of panels.
   pure integer function n_panel(study)
      type(tolerance_study_t), intent(in) :: study   !! the study

      n_panel = min(most_panels, size(study%requests))
   end function n_panel

   !> Start of a script with a panel for each channel.
   subroutine begin_panels(lines, name, title, study)
      type(buffer_t), intent(inout) :: lines         !! the script
      character(*), intent(in) :: name               !! of the figure
      character(*), intent(in) :: title              !! of the scene, any text
      type(tolerance_study_t), intent(in) :: study   !! the study

      call preamble(lines, name, 1200, 150 + 450*n_panel(study))
      call lines%line("set multiplot layout "//to_text(n_panel(study))//",1 title "//quoted(title)//" font ',17'")
   end subroutine begin_panels

   !> Parts of the variance.
   function contributor_rows(study) result(text)
      type(tolerance_study_t), intent(in) :: study   !! the study
      character(:), allocatable :: text              !! whole lines

      type(buffer_t) :: lines
      integer :: at, k, r

      do r = 1, n_panel(study)
         at = study%members%at(r)
         call lines%line("# contributor, part of first order, Sobol' index, total index of "//study%requests(r)%name)
         do k = 1, min(most_members, size(study%contributors))
            call lines%line(""""//study%contributors(k)%s//""" "//number_row([ &
               study%parts(k, r, at)/max(study%sigma(r, at)**2, tiny(1.0_wp)), known(study%indices%first(1, k, r, at)), &
               known(study%indices%total(1, k, r, at))]))
         end do
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()

   contains

      !> A number; 0 if it is undefined.
      pure real(wp) function known(x)
         real(wp), intent(in) :: x   !! NaN: nothing scatters [1]

         known = 0.0_wp
         if (ieee_is_finite(x)) known = x
      end function known

   end function contributor_rows

   !> Bars of the contributors.
   function contributor_script(study, title) result(script)
      type(tolerance_study_t), intent(in) :: study   !! the study
      character(*), intent(in) :: title              !! of the scene, any text
      character(:), allocatable :: script            !! lines for gnuplot

      type(buffer_t) :: lines
      character(:), allocatable :: file
      integer :: r

      call begin_panels(lines, "tolerance_contributors", title, study)
      call lines%line("set style data histograms; set style histogram clustered gap 1; set style fill solid 0.9 noborder")
      call lines%line("set yrange [0:*]; set key outside right top vertical Left reverse; set ylabel 'part of the variance'")
      do r = 1, n_panel(study)
         file = "'tolerance_contributors.dat' index "//to_text(r - 1)
         call lines%line("set title "//quoted(study%requests(r)%name//" at t = "// &
                                              real_text(study%derivatives%instants(study%members%at(r))%t, 5)//" s"))
         if (study%indices%points == 0) then
            call lines%line("plot "//file//" using 2:xtic(1) linecolor rgb '"//colours(1)//"' title 'first order'")
            cycle
         end if
         call lines%line("plot "//file//" using 2:xtic(1) linecolor rgb '"//colours(1)//"' title 'first order', \")
         call lines%line("     "//file//" using 3 linecolor rgb '"//colours(2)//"' title 'Sobol'' index', \")
         call lines%line("     "//file//" using 4 linecolor rgb '"//colours(3)//"' title 'total index'")
      end do
      call lines%line("unset multiplot; unset output")
      script = lines%get()
   end function contributor_script

   !> Histograms.
   function histogram_rows(study) result(text)
      type(tolerance_study_t), intent(in) :: study   !! the study
      character(:), allocatable :: text              !! whole lines

      type(buffer_t) :: lines
      integer :: bin, r

      do r = 1, n_panel(study)
         call lines%line("# from, to, members of "//study%requests(r)%name)
         do bin = 1, size(study%members%counts, 1)
            call lines%line(number_row([study%members%edges(bin - 1, r), study%members%edges(bin, r), &
                                        real(study%members%counts(bin, r), wp)]))
         end do
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()
   end function histogram_rows

   !> Bars of the histograms, and lines of the limits.
   function histogram_script(study, title) result(script)
      type(tolerance_study_t), intent(in) :: study   !! the study
      character(*), intent(in) :: title              !! of the scene, any text
      character(:), allocatable :: script            !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      integer :: r

      call begin_panels(lines, "tolerance_histogram", title, study)
      call lines%line("set style fill solid 0.8 border; set yrange [0:*]; set ylabel 'members'; unset key")
      do r = 1, n_panel(study)
         unit = choose_unit(study%requests(r)%unit, maxval(abs(study%members%edges(:, r))))
         call lines%line("f = "//real_text(unit%factor, 17)//"; set xlabel "//quoted(study%requests(r)%name//" ["// &
                                                                                    unit%symbol//"]"))
         call lines%line("set title 'at t = "//real_text(study%derivatives%instants(study%members%at(r))%t, 5)//" s'")
         call lines%line("unset arrow")
         if (study%requests(r)%is_limited) then
            call add_limit(study%requests(r)%lower)
            call add_limit(study%requests(r)%upper)
         end if
         call lines%line("plot 'tolerance_histogram.dat' index "//to_text(r - 1)// &
                         " using (0.5*($1+$2)*f):3:(($2-$1)*f) with boxes linecolor rgb '"//colours(1)//"'")
      end do
      call lines%line("unset multiplot; unset output")
      script = lines%get()

   contains

      !> A line at a limit.
      subroutine add_limit(limit)
         real(wp), intent(in) :: limit   !! the limit; huge: none [any]

         if (abs(limit) >= 1.0e300_wp) return
         call lines%line("set arrow from "//exact_text(limit)//"*f, graph 0 to "//exact_text(limit)// &
                         "*f, graph 1 nohead front linewidth 2 linecolor rgb '"//colours(2)//"'")
      end subroutine add_limit

   end function histogram_script

   !> Bands over the motion.
   function band_rows(study) result(text)
      type(tolerance_study_t), intent(in) :: study   !! the study
      character(:), allocatable :: text              !! whole lines

      type(buffer_t) :: lines
      integer :: at, r

      do r = 1, n_panel(study)
         call lines%line("# time, worst case from, to, 95 % from, to, mean, all less the nominal value, of "// &
                         study%requests(r)%name)
         do at = 1, size(study%derivatives%instants)
            associate (mean => study%mean(r, at), half => normal_95*study%sigma(r, at), nominal => study%derivatives%values(r, at))
               call lines%line(number_row([study%derivatives%instants(at)%t, study%low(r, at) - nominal, &
                                           study%high(r, at) - nominal, mean - half - nominal, mean + half - nominal, &
                                           mean - nominal]))
            end associate
         end do
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()
   end function band_rows

   !> Deviations over time.
   function band_script(study, title) result(script)
      type(tolerance_study_t), intent(in) :: study   !! the study
      character(*), intent(in) :: title              !! of the scene, any text
      character(:), allocatable :: script            !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      character(:), allocatable :: file
      integer :: r

      call begin_panels(lines, "tolerance_band", title, study)
      call lines%line("set xlabel 'time [s]'; set style fill noborder; set key outside right top vertical Left reverse")
      do r = 1, n_panel(study)
         unit = choose_unit(study%requests(r)%unit, maxval(study%high(r, :) - study%low(r, :)))
         file = "'tolerance_band.dat' index "//to_text(r - 1)
         call lines%line("f = "//real_text(unit%factor, 9)//"; set ylabel "// &
                         quoted(study%requests(r)%name//" less nominal ["//unit%symbol//"]"))
         call lines%line("plot "//file//" using 1:($2*f):($3*f) with filledcurves fill transparent solid 0.2 linecolor rgb '"// &
                         colours(1)//"' title 'worst case', \")
         call lines%line("     "//file//" using 1:($4*f):($5*f) with filledcurves fill transparent solid 0.5 linecolor rgb '"// &
                         colours(1)//"' title '95 %', \")
         call lines%line("     "//file//" using 1:($6*f) with lines linewidth 2 linecolor rgb '"//colours(2)//"' title 'mean'")
      end do
      call lines%line("unset multiplot; unset output")
      script = lines%get()
   end function band_script

end module tolerance_plots
