!> The figures that a single run draws from its statistics: stroboscopic sections, spectra, histograms.
module statistics_plots
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use curve_words, only: unit_of
   use event_list, only: event_list_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use figure_words, only: figure_histogram, figure_section, figure_spectrum, figure_t
   use kinds, only: wp
   use plot_table, only: draw_boxes, draw_lines, draw_points, plot_table_t
   use contact_statistics, only: histogram, joint_statistics, joint_statistics_t
   use statistics, only: statistics_t
   use text, only: append_text, text_t
   implicit none (type, external)
   private
   public :: statistics_table

contains

   !> The table of a figure; without rows if there is nothing to draw, or if the figure is of another sort.
   subroutine statistics_table(figure, statistics, catalogue, events, t_end, heading, table)
      type(figure_t), intent(in) :: figure             !! the figure
      type(statistics_t), intent(in) :: statistics     !! what was gathered
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      type(event_list_t), intent(in) :: events         !! all events
      real(wp), intent(in) :: t_end                    !! last instant reached [s]
      character(*), intent(in) :: heading              !! lines with `#`
      type(plot_table_t), intent(out) :: table         !! the table

      table%name = figure%name
      table%heading = heading
      allocate (table%labels(0), table%categories(0), table%panels(1))
      allocate (table%panels(1)%curves(1))
      table%panels(1)%curves(1)%title = ""
      select case (figure%kind)
      case (figure_section)
         call section_table(figure%scalars, statistics, catalogue, table)
      case (figure_spectrum)
         call spectrum_table(figure%scalars(1), statistics, catalogue, table)
      case (figure_histogram)
         call histogram_table(figure, statistics, events, t_end, table)
      end select
   end subroutine statistics_table

   !> A channel over another, once per period.
   subroutine section_table(scalars, statistics, catalogue, table)
      type(scalar_t), intent(in) :: scalars(2)         !! (2) abscissa, ordinate
      type(statistics_t), intent(in) :: statistics     !! what was gathered
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      type(plot_table_t), intent(inout) :: table       !! the table

      integer :: i, k

      call append_text(table%labels, "time[s]")
      allocate (table%values(3, statistics%n_poincare), source=0.0_wp)
      table%values(1, :) = statistics%poincare_times(1:statistics%n_poincare)
      do k = 1, 2
         call append_text(table%labels, scalar_name(catalogue, scalars(k))//"["//unit_of(catalogue, scalars(k))//"]")
         do i = 1, size(statistics%channels)
            if (.not. same(statistics%channels(i), scalars(k))) cycle
            table%values(k + 1, :) = statistics%poincare_samples(i, 1:statistics%n_poincare)
         end do
      end do
      table%x_name = scalar_name(catalogue, scalars(1))//", Poincare samples"
      table%x_unit = unit_of(catalogue, scalars(1))
      table%panels(1)%y_name = scalar_name(catalogue, scalars(2))
      table%panels(1)%y_unit = unit_of(catalogue, scalars(2))
      table%panels(1)%curves(1)%style = draw_points
      table%panels(1)%curves(1)%x = 2
      table%panels(1)%curves(1)%y = 3
   end subroutine section_table

   !> Amplitude over frequency, without the line at zero.
   subroutine spectrum_table(scalar, statistics, catalogue, table)
      type(scalar_t), intent(in) :: scalar             !! the channel
      type(statistics_t), intent(in) :: statistics     !! what was gathered
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      type(plot_table_t), intent(inout) :: table       !! the table

      real(wp), allocatable :: amplitude(:), frequency(:)
      integer :: i

      table%x_name = "frequency"
      table%x_unit = "Hz"
      table%is_log_x = .true.
      table%panels(1)%y_name = "amplitude of "//scalar_name(catalogue, scalar)
      table%panels(1)%y_unit = unit_of(catalogue, scalar)
      table%panels(1)%curves(1)%style = draw_lines
      call append_text(table%labels, "frequency[Hz]")
      call append_text(table%labels, scalar_name(catalogue, scalar)//"["//table%panels(1)%y_unit//"]")
      do i = 1, size(statistics%spectra)
         if (.not. same(statistics%spectra(i), scalar)) cycle
         call statistics%spectrum_of(i, frequency, amplitude)
         if (size(frequency) < 2 .or. .not. all(ieee_is_finite(amplitude))) return
         allocate (table%values(2, size(frequency) - 1))
         table%values(1, :) = frequency(2:)
         table%values(2, :) = amplitude(2:)
         table%panels(1)%is_log_y = any(amplitude(2:) > 0.0_wp)  ! a channel at rest has nothing that a logarithm could show
         return
      end do
   end subroutine spectrum_table

   !> Number of impacts over their speed or their peak force.
   subroutine histogram_table(figure, statistics, events, t_end, table)
      type(figure_t), intent(in) :: figure             !! the figure: joint and quantity
      type(statistics_t), intent(in) :: statistics     !! the window and the bins
      type(event_list_t), intent(in) :: events         !! all events
      real(wp), intent(in) :: t_end                    !! last instant reached [s]
      type(plot_table_t), intent(inout) :: table       !! the table

      type(joint_statistics_t) :: joint
      integer :: counts(statistics%plan%bins), k
      real(wp) :: edges(statistics%plan%bins + 1)

      call joint_statistics(figure%arguments(1)%s, events, statistics%plan%after, t_end, joint)
      if (figure%arguments(2)%s == "impact_speed") then
         call histogram(joint%speeds, edges, counts)
         table%x_unit = "m/s"
         table%x_name = "impact speed of "//figure%arguments(1)%s
      else
         call histogram(joint%forces, edges, counts)
         table%x_unit = "N"
         table%x_name = "peak force of "//figure%arguments(1)%s
      end if
      call append_text(table%labels, "from["//table%x_unit//"]")
      call append_text(table%labels, "to["//table%x_unit//"]")
      call append_text(table%labels, "impacts[1]")
      table%panels(1)%y_name = "impacts"
      table%panels(1)%y_unit = "1"
      associate (curve => table%panels(1)%curves(1))
         curve%style = draw_boxes
         curve%x = 2
         curve%y = 3
         curve%low = 1
         curve%high = 2
      end associate
      if (size(joint%speeds) == 0) return
      allocate (table%values(3, size(counts)))
      do k = 1, size(counts)
         table%values(:, k) = [edges(k), edges(k + 1), real(counts(k), wp)]
      end do
   end subroutine histogram_table

   !> Whether two numbers of the catalogue are the same.
   pure logical function same(a, b)
      type(scalar_t), intent(in) :: a  !! one
      type(scalar_t), intent(in) :: b  !! the other

      same = a%group == b%group .and. a%component == b%component .and. a%item == b%item
   end function same

end module statistics_plots
