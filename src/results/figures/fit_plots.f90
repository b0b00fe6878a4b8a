!> The figures of a fit: data and model, residuals, joint confidence ellipses of pairs of parameters.
!>
!> `fit.dat` has a block for each set and sensor: time, data, model, residual in standard deviations, data that were not fitted.
!> `fit_ellipses.dat` has a block for each pair: the 95 % ellipse
!> $$ (p - \hat p)^T C^{-1} (p - \hat p) = 2 F_{2, f}(0.95), \quad F_{2, f}(0.95) = \frac{f}{2} (0.05^{-2/f} - 1) $$
!> of f degrees of freedom; of given standard deviations f is infinite.
!> Source: G. A. F. Seber, C. J. Wild, Nonlinear Regression (1989), section 5.1.
module fit_plots
   use display_units, only: choose_unit, display_unit_t
   use errors, only: error_t
   use fit_results, only: fit_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use plot_text, only: quoted
   use script_parts, only: colours, preamble
   use text, only: append_text, exact_text, text_t, to_text
   use text_buffer, only: buffer_t
   use text_file, only: write_file
   use text_table, only: number_row
   implicit none (type, external)
   private
   public :: write_fit_plots

   integer, parameter :: most_panels = 6         !! panels of a figure
   integer, parameter :: ellipse_points = 120    !! points of an ellipse
   real(wp), parameter :: pi = acos(-1.0_wp)     !! half a turn [rad]

contains

   !> Write numbers and scripts into the folder of the figures.
   subroutine write_fit_plots(folder, title, heading, fit, names, error)
      character(*), intent(in) :: folder                       !! of the figures
      character(*), intent(in) :: title                        !! of the scene, any text
      character(*), intent(in) :: heading                      !! lines with `#`
      type(fit_t), intent(in) :: fit                           !! the fit
      type(text_t), allocatable, intent(out) :: names(:)       !! (n) figures written
      type(error_t), allocatable, intent(out) :: error         !! a file cannot be written

      allocate (names(0))
      call write_file(folder//"/fit.dat", heading//data_rows(fit), error)
      if (.not. allocated(error)) call add("fit", data_script(fit, title, is_residual=.false.))
      if (.not. allocated(error)) call add("fit_residuals", data_script(fit, title, is_residual=.true.))
      if (size(fit%places) < 2 .or. allocated(error)) return
      call write_file(folder//"/fit_ellipses.dat", heading//ellipse_rows(fit), error)
      if (.not. allocated(error)) call add("fit_ellipses", ellipse_script(fit, title))

   contains

      !> Write the script of a figure.
      subroutine add(name, script)
         character(*), intent(in) :: name     !! of the figure
         character(*), intent(in) :: script   !! its script

         call write_file(folder//"/"//name//".gp", script, error)
         if (.not. allocated(error)) call append_text(names, name)
      end subroutine add

   end subroutine write_fit_plots

   !> Set and sensor of a panel; a set of 0: there is none.
   pure subroutine find_panel(fit, panel, set, sensor)
      type(fit_t), intent(in) :: fit          !! the fit
      integer, intent(in) :: panel            !! number of the panel
      integer, intent(out) :: set             !! number of the set
      integer, intent(out) :: sensor          !! number of the sensor

      set = (panel - 1)/size(fit%sensors) + 1
      sensor = panel - (set - 1)*size(fit%sensors)
      if (set > size(fit%sets) .or. panel > most_panels) set = 0
   end subroutine find_panel

   !> Data and model.
   function data_rows(fit) result(text)
      type(fit_t), intent(in) :: fit          !! the fit
      character(:), allocatable :: text       !! whole lines

      type(buffer_t) :: lines
      real(wp) :: unused
      integer :: i, k, panel, s

      do panel = 1, most_panels
         call find_panel(fit, panel, k, s)
         if (k == 0) exit
         associate (set => fit%sets(k))
            call lines%line("# time, data, model, residual, data not fitted of "//fit%sensors(s)%channel//" in "//set%name)
            do i = 1, size(set%t)
               if (.not. ieee_is_finite(set%x(s, i))) cycle
               unused = not_a_number()
               if (.not. ieee_is_finite(set%model(s, i))) unused = set%x(s, i)
               call lines%line(number_row([set%t(i), set%x(s, i), set%model(s, i), &
                                           (set%x(s, i) - set%model(s, i))/fit%sensors(s)%sigma, unused]))
            end do
         end associate
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()
   end function data_rows

   !> Data and model over time, or residuals.
   function data_script(fit, title, is_residual) result(script)
      type(fit_t), intent(in) :: fit                 !! the fit
      character(*), intent(in) :: title              !! of the scene, any text
      logical, intent(in) :: is_residual             !! residuals
      character(:), allocatable :: script            !! lines for gnuplot

      type(buffer_t) :: lines
      type(display_unit_t) :: unit
      character(:), allocatable :: file
      integer :: k, n, panel, s

      n = min(most_panels, size(fit%sets)*size(fit%sensors))
      call preamble(lines, trim(merge("fit_residuals", "fit          ", is_residual)), 1200, 150 + 450*n)
      call lines%line("set multiplot layout "//to_text(n)//",1 title "//quoted(title)//" font ',17'")
      call lines%line("set datafile missing 'nan'; set xlabel 'time [s]'; set key outside right top vertical Left reverse")
      do panel = 1, n
         call find_panel(fit, panel, k, s)
         file = "'fit.dat' index "//to_text(panel - 1)
         call lines%line("set title "//quoted(fit%sets(k)%name))
         if (is_residual) then
            call lines%line("set ylabel "//quoted(fit%sensors(s)%channel//": residual / sigma"))
            call lines%line("plot 1.96 with lines dashtype 2 linecolor rgb '#4d4d4d' title '95 %', "// &
                            "-1.96 with lines dashtype 2 linecolor rgb '#4d4d4d' notitle, \")
            call lines%line("     "//file//" using 1:4 with points pointtype 7 pointsize 0.6 linecolor rgb '"//colours(1)// &
                            "' title 'residual'")
         else
            unit = choose_unit(fit%sensors(s)%unit, maxval(abs(fit%sets(k)%x(s, :)), mask=ieee_is_finite(fit%sets(k)%x(s, :))))
            call lines%line("f = "//exact_text(unit%factor)//"; set ylabel "// &
                            quoted(fit%sensors(s)%channel//" ["//unit%symbol//"]"))
            call lines%line("plot "//file//" using 1:($2*f) with points pointtype 7 pointsize 0.6 linecolor rgb '"//colours(1)// &
                            "' title 'data', \")
            if (any(ieee_is_finite(fit%sets(k)%x(s, :)) .and. .not. ieee_is_finite(fit%sets(k)%model(s, :)))) then
               call lines%line("     "//file//" using 1:($5*f) with points pointtype 7 pointsize 0.6 linecolor rgb '#b0b0b0' "// &
                               "title 'not fitted', \")
            end if
            call lines%line("     "//file//" using 1:($3*f) with lines linewidth 2 linecolor rgb '"//colours(2)//"' title 'model'")
         end if
      end do
      call lines%line("unset multiplot; unset output")
      script = lines%get()
   end function data_script

   !> Pairs of unknowns that are drawn: those that the data see.
   pure subroutine list_pairs(fit, pairs)
      type(fit_t), intent(in) :: fit                     !! the fit
      integer, allocatable, intent(out) :: pairs(:, :)   !! (2, n) numbers of unknowns

      integer :: i, k, n

      allocate (pairs(2, most_panels))
      n = 0
      do k = 1, size(fit%places)
         do i = k + 1, size(fit%places)
            if (n == most_panels .or. .not. (fit%is_seen(k) .and. fit%is_seen(i))) cycle
            n = n + 1
            pairs(:, n) = [k, i]
         end do
      end do
      pairs = pairs(:, :n)
   end subroutine list_pairs

   !> Points of the ellipses.
   function ellipse_rows(fit) result(text)
      type(fit_t), intent(in) :: fit          !! the fit
      character(:), allocatable :: text       !! whole lines

      type(buffer_t) :: lines
      integer, allocatable :: pairs(:, :)
      real(wp) :: freedom, radius, x(2)
      integer :: i, k

      call list_pairs(fit, pairs)
      freedom = real(fit%n_data - size(fit%places), wp)
      radius = sqrt(freedom*(0.05_wp**(-2.0_wp/freedom) - 1.0_wp))
      if (all(fit%sensors%is_given)) radius = sqrt(-2.0_wp*log(0.05_wp))
      do k = 1, size(pairs, 2)
         associate (a => pairs(1, k), b => pairs(2, k))
            call lines%line("# "//fit%places(a)%name//", "//fit%places(b)%name//", SI")
            do i = 0, ellipse_points
               associate (angle => 2.0_wp*pi*i/ellipse_points, r => fit%correlation(a, b))
                  x = [cos(angle), r*cos(angle) + sqrt(max(0.0_wp, 1.0_wp - r**2))*sin(angle)]
                  call lines%line(number_row(fit%value(pairs(:, k)) + radius*x*fit%deviation(pairs(:, k))))
               end associate
            end do
         end associate
         call lines%line("")
         call lines%line("")
      end do
      text = lines%get()
   end function ellipse_rows

   !> The ellipses, with the intervals of both parameters.
   function ellipse_script(fit, title) result(script)
      type(fit_t), intent(in) :: fit                 !! the fit
      character(*), intent(in) :: title              !! of the scene, any text
      character(:), allocatable :: script            !! lines for gnuplot

      type(buffer_t) :: lines
      integer, allocatable :: pairs(:, :)
      integer :: k, n

      call list_pairs(fit, pairs)
      n = max(1, size(pairs, 2))
      call preamble(lines, "fit_ellipses", 1200, 150 + 500*((n + 1)/2))
      call lines%line("set multiplot layout "//to_text((n + 1)/2)//","//to_text(min(n, 2))//" title "//quoted(title)// &
                      " font ',17'")
      call lines%line("set format '%.5g'; set xtics autofreq rotate by -25; set rmargin 7")
      call lines%line("set offsets graph 0.1, graph 0.1, graph 0.1, graph 0.1")
      do k = 1, size(pairs, 2)
         associate (a => pairs(1, k), b => pairs(2, k))
            call lines%line("set xlabel "//quoted(label_of(a))//"; set ylabel "//quoted(label_of(b)))
            call lines%line("plot 'fit_ellipses.dat' index "//to_text(k - 1)//" using 1:2 with lines linewidth 2 linecolor "// &
                            "rgb '"//colours(1)//"' title '95 % of both', \")
            call lines%line("     '-' using 1:2:($3-$1):($4-$2) with vectors nohead linewidth 2 linecolor rgb '"//colours(2)// &
                            "' title '95 % of each'")
            call lines%line(number_row([fit%low(a), fit%value(b), fit%high(a), fit%value(b)]))
            call lines%line(number_row([fit%value(a), fit%low(b), fit%value(a), fit%high(b)]))
            call lines%line("e")
         end associate
      end do
      if (size(pairs, 2) == 0) call lines%line("set title 'the data see less than two parameters'; plot [0:1] 0 notitle")
      call lines%line("unset multiplot; unset output")
      script = lines%get()

   contains

      !> Name and unit of an unknown.
      function label_of(k) result(label)
         integer, intent(in) :: k                     !! number of the unknown
         character(:), allocatable :: label           !! for an axis

         label = fit%places(k)%name
         if (all(fit%places(k)%unit /= ["1", " "])) label = label//" ["//fit%places(k)%unit//"]"
      end function label_of

   end function ellipse_script

end module fit_plots
