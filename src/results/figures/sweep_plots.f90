!> The figures of a sweep over its first parameter: stroboscopic samples (bifurcation), numbers with their spread.
!>
!> Further parameters of a grid give curves of their own. Words stand at equal distances; a parameter that spans more
!> than a decade has a logarithmic axis.
module sweep_plots
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name
   use figure_words, only: figure_bifurcation, figure_t
   use kinds, only: not_a_number, wp
   use numbers, only: number_length
   use plot_table, only: draw_bars, draw_marks, draw_points, panel_t, plot_curve_t, plot_table_t
   use sweep_results, only: case_numbers, n_spread, spread_names, sweep_results_t
   use sweep_axes, only: axis_of_parameter, sweep_axis_t
   use swept, only: sweep_t
   use text, only: append_text, text_t, to_text
   implicit none (type, external)
   private
   public :: sweep_table

contains

   !> The table of a figure; without rows if there is nothing to draw.
   subroutine sweep_table(figure, results, catalogue, heading, table)
      type(figure_t), intent(in) :: figure              !! the figure
      type(sweep_results_t), intent(in) :: results      !! what the runs gave
      type(catalogue_t), intent(in) :: catalogue        !! what a run can report
      character(*), intent(in) :: heading               !! lines with `#`
      type(plot_table_t), intent(out) :: table          !! the table

      table%name = figure%name
      table%heading = heading
      allocate (table%labels(0), table%categories(0))
      call set_abscissa(results%sweep, table)
      if (figure%kind == figure_bifurcation) then
         call bifurcation_table(scalar_name(catalogue, figure%scalars(1)), &
                                catalogue%groups(figure%scalars(1)%group)%channel%unit, results, table)
      else
         call statistics_table(figure%arguments, results, table)
      end if
   end subroutine sweep_table

   !> The first parameter as abscissa.
   subroutine set_abscissa(sweep, table)
      type(sweep_t), intent(in) :: sweep                !! the cases
      type(plot_table_t), intent(inout) :: table        !! the table

      type(sweep_axis_t) :: first

      table%x_name = "case"
      table%x_unit = "1"
      if (size(sweep%parameters) > 0) then
         first = axis_of_parameter(sweep%parameters(1))
         table%x_name = first%name
         table%x_unit = first%unit
         table%x_shown = first%shown
         table%is_log_x = first%is_log
         if (allocated(first%categories)) table%categories = first%categories
      end if
      call append_text(table%labels, table%x_name//"["//table%x_unit//"]")
   end subroutine set_abscissa

   !> The abscissa of a case.
   pure real(wp) function abscissa(sweep, case_number) result(x)
      type(sweep_t), intent(in) :: sweep        !! the cases
      integer, intent(in) :: case_number        !! of the case

      x = real(case_number, wp)
      if (size(sweep%parameters) == 0) return
      x = real(sweep%value_number(1, case_number), wp)
      if (sweep%parameters(1)%unit /= "") x = sweep%parameters(1)%numbers(sweep%value_number(1, case_number))
   end function abscissa

   !> The other parameters of a curve.
   function curve_title(sweep, curve) result(title)
      type(sweep_t), intent(in) :: sweep         !! the cases
      integer, intent(in) :: curve               !! number of the curve
      character(:), allocatable :: title         !! as `law = hertz`; blank if there is one curve

      integer :: k

      title = ""
      if (sweep%n_curves() == 1) return
      do k = sweep%n_together + 1, size(sweep%parameters)
         if (k > sweep%n_together + 1) title = title//", "
         title = title//sweep%parameters(k)%name//" = "//spaced(sweep%parameters(k)%texts(sweep%value_number(k, curve))%s)
      end do
   end function curve_title

   !> A value of a deck with a blank before its unit, `150rpm` as `150 rpm`; words as they are.
   pure function spaced(text) result(s)
      character(*), intent(in) :: text           !! the value
      character(:), allocatable :: s             !! as it is shown

      integer :: n

      s = text
      n = number_length(text)
      if (n > 0 .and. n < len(text)) s = text(:n)//" "//adjustl(text(n + 1:))
   end function spaced

   !> A channel once per period over the parameter: every sample of every run. Where no run of a curve is there it is omitted.
   subroutine bifurcation_table(name, unit, results, table)
      character(*), intent(in) :: name                  !! of the channel
      character(*), intent(in) :: unit                  !! its unit
      type(sweep_results_t), intent(in) :: results      !! what the runs gave
      type(plot_table_t), intent(inout) :: table        !! the table

      real(wp), allocatable :: poincare_samples(:, :)
      integer :: channel, curve, k, m, n, run

      do channel = 1, size(results%poincare_names)
         if (results%poincare_names(channel)%s == name) exit
      end do
      if (channel > size(results%poincare_names)) return
      call append_text(table%labels, name//"["//unit//"]")
      allocate (table%panels(1))
      allocate (table%panels(1)%curves(results%sweep%n_curves()))
      table%panels(1)%y_name = name//", Poincare samples"
      table%panels(1)%y_unit = unit
      n = 0
      do run = 1, size(results%runs)
         n = n + size(results%runs(run)%poincare_times)
      end do
      allocate (table%values(2, n), source=0.0_wp)
      n = 0
      do curve = 1, results%sweep%n_curves()
         associate (this => table%panels(1)%curves(curve))
            this%style = draw_points
            this%colour = curve
            this%title = curve_title(results%sweep, curve)
            this%first = n + 1
            do run = 1, size(results%runs)
               m = (run - 1)/results%n_member + 1
               if (mod(m - 1, results%sweep%n_curves()) + 1 /= curve) cycle
               poincare_samples = results%poincare_of(run)
               do k = 1, size(poincare_samples, 2)
                  n = n + 1
                  table%values(:, n) = [abscissa(results%sweep, m), poincare_samples(channel, k)]
               end do
            end do
            this%last = n
         end associate
      end do
      table%panels(1)%curves = pack(table%panels(1)%curves, table%panels(1)%curves%last >= table%panels(1)%curves%first)
   end subroutine bifurcation_table

   !> Numbers over the parameter: mean and standard deviation over the runs, minimum and maximum value as small marks.
   subroutine statistics_table(names, results, table)
      type(text_t), intent(in) :: names(:)              !! (n) numbers
      type(sweep_results_t), intent(in) :: results      !! what the runs gave
      type(plot_table_t), intent(inout) :: table        !! the table

      real(wp) :: spread(n_spread)
      integer :: at, curve, i, k, m, n, n_value, row
      integer :: numbers(size(names))

      do i = 1, size(names)
         do at = 1, size(results%names)
            if (results%names(at)%s == names(i)%s) exit
         end do
         if (at > size(results%names)) return
         numbers(i) = at
         do k = 1, n_spread
            call append_text(table%labels, names(i)%s//"."//trim(spread_names(k))//"["//results%units(at)%s//"]")
         end do
      end do
      n = results%sweep%n_curves()
      n_value = results%sweep%n_cases()/n
      allocate (table%values(1 + n_spread*size(names), n*n_value), source=not_a_number())
      do curve = 1, n
         do k = 1, n_value
            row = (curve - 1)*n_value + k
            m = (k - 1)*n + curve
            table%values(1, row) = abscissa(results%sweep, m)
            do i = 1, size(names)
               call case_numbers(results, m, numbers(i), at, spread)
               if (at == 1) spread(2) = 0.0_wp  ! one run is drawn without a bar
               table%values(2 + n_spread*(i - 1):1 + n_spread*i, row) = spread
            end do
         end do
      end do
      if (all(ieee_is_nan(table%values(2:, :)))) deallocate (table%values)
      allocate (table%panels(size(names)))
      do i = 1, size(names)
         table%panels(i)%y_name = names(i)%s
         table%panels(i)%y_unit = results%units(numbers(i))%s
         call add_curves(table%panels(i), 1 + n_spread*(i - 1), n, n_value, results)
      end do
   end subroutine statistics_table

   !> The curves of a panel.
   subroutine add_curves(panel, before, n, n_value, results)
      type(panel_t), intent(inout) :: panel             !! the panel
      integer, intent(in) :: before                     !! columns before those of the number
      integer, intent(in) :: n                          !! curves
      integer, intent(in) :: n_value                    !! values of the parameter
      type(sweep_results_t), intent(in) :: results      !! what the runs gave

      type(plot_curve_t) :: curve
      integer :: k

      allocate (panel%curves(0))
      do k = 1, n
         curve%style = draw_bars
         curve%y = before + 1
         curve%low = before + 2
         curve%colour = k
         curve%title = curve_title(results%sweep, k)
         if (len(curve%title) == 0 .and. results%is_ensemble) then
            curve%title = "mean ± standard deviation of "//to_text(results%n_member)//" runs"
         end if
         curve%first = (k - 1)*n_value + 1
         curve%last = k*n_value
         panel%curves = [panel%curves, curve]
         if (.not. results%is_ensemble) cycle
         curve%style = draw_marks
         curve%title = ""
         if (k == n) curve%title = "minimum, maximum"
         curve%y = before + 3
         panel%curves = [panel%curves, curve]
         curve%title = ""
         curve%y = before + 4
         panel%curves = [panel%curves, curve]
      end do
   end subroutine add_curves

end module sweep_plots
