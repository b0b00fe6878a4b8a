!> The statistics of a run as tables: numbers, Poincare sections, spectra and histograms.
module statistics_tables
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use contact_statistics, only: histogram, joint_statistics_t, joints_of, statistics_of_joints
   use event_list, only: event_list_t
   use kinds, only: wp
   use result_table, only: as_members, in_hdf5, result_table_t
   use statistics, only: number_t, statistics_t
   use table_list, only: append_tables, list_of
   use text, only: join, real_text, text_t
   implicit none (type, external)
   private
   public :: tables_of_statistics

contains

   !> All tables, if there are statistics.
   function tables_of_statistics(statistics, numbers, catalogue, events, t_end) result(tables)
      type(statistics_t), intent(in) :: statistics       !! what was gathered
      type(number_t), intent(in) :: numbers(:)           !! (m) the numbers of the run
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(event_list_t), intent(in) :: events           !! all events
      real(wp), intent(in) :: t_end                      !! last instant reached [s]
      type(result_table_t), allocatable :: tables(:)     !! (any) they

      type(text_t), allocatable :: joints(:)

      allocate (tables(0))
      if (.not. statistics%plan%is_wanted) return
      tables = list_of(table_of_numbers(statistics%plan%after, numbers))
      if (statistics%n_poincare > 0) call append_tables(tables, list_of( &
         table_of_names("strobe_names", "channels sampled once per period", names_of(statistics%channels, catalogue)), &
         table_of_sections(statistics, catalogue)))
      if (size(statistics%spectra) > 0) call append_tables(tables, list_of( &
         table_of_names("spectrum_names", "channels of the spectra", names_of(statistics%spectra, catalogue)), &
         table_of_spectra(statistics, catalogue)))
      joints = joints_of(catalogue)
      if (size(joints) > 0) then
         call append_tables(tables, list_of(table_of_histograms(statistics, catalogue, events, t_end)))
      end if
   end function tables_of_statistics

   !> The numbers.
   function table_of_numbers(after, numbers) result(table)
      real(wp), intent(in) :: after                      !! end of the transient [s]
      type(number_t), intent(in) :: numbers(:)           !! (m) the numbers
      type(result_table_t) :: table                      !! a row for each

      type(text_t), allocatable :: names(:)
      integer :: k

      allocate (names(size(numbers)), table%units(size(numbers)))
      call table%start("statistics", "statistics", size(numbers), "statistics", "statistics from "//real_text(after, 9)//" s on", &
                       "run.h5, /statistics")
      table%most = size(numbers)
      table%noise = numbers%noise
      do k = 1, size(numbers)
         names(k)%s = numbers(k)%name
         table%units(k)%s = numbers(k)%unit
      end do
      call table%put("names", "1", "names of the statistics", texts=names, formats=in_hdf5, heading="statistic")
      call table%put("units", "1", "their units", texts=table%units, formats=in_hdf5)
      call table%put("values", "rows", "statistics after the transient", numbers%value, &
                     formats=in_hdf5 + as_members, heading="value", digits=9)
   end function table_of_numbers

   !> Names of what the values of another table belong to.
   function table_of_names(name, help, names) result(table)
      character(*), intent(in) :: name                   !! of the column
      character(*), intent(in) :: help                   !! what it is
      type(text_t), intent(in) :: names(:)               !! (n) the names
      type(result_table_t) :: table                      !! a row for each

      call table%start(name, "statistics", size(names), "statistics")
      call table%put(name, "1", help, texts=names, formats=in_hdf5)
   end function table_of_names

   !> The channels once per period.
   function table_of_sections(statistics, catalogue) result(table)
      type(statistics_t), intent(in) :: statistics       !! what was gathered
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(result_table_t) :: table                      !! a row for each period

      associate (n => statistics%n_poincare, n_channel => size(statistics%channels))
         call table%start("strobe", "statistics", n, "statistics")
         call table%put("strobe_time", "s", "multiples of the drive period", statistics%poincare_times(1:n), formats=in_hdf5)
         call table%put("strobe", units_of(statistics%channels, catalogue), "channel values at these times", &
                        [statistics%poincare_samples(:, 1:n)], formats=in_hdf5, shape=[n_channel])
      end associate
   end function table_of_sections

   !> The spectra.
   function table_of_spectra(statistics, catalogue) result(table)
      type(statistics_t), intent(in) :: statistics       !! what was gathered
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(result_table_t) :: table                      !! a row for each frequency

      real(wp), allocatable :: amplitude(:), frequency(:), lines(:, :)
      integer :: k

      do k = 1, size(statistics%spectra)
         call statistics%spectrum_of(k, frequency, amplitude)
         if (k == 1) allocate (lines(size(statistics%spectra), size(frequency)))
         lines(k, :) = amplitude
      end do
      call table%start("spectrum", "statistics", size(frequency), "statistics")
      call table%put("frequency", "Hz", "frequencies of the spectral lines", frequency, formats=in_hdf5)
      call table%put("spectrum", units_of(statistics%spectra, catalogue), "amplitude spectrum, Hann window", [lines], &
                     formats=in_hdf5, shape=[size(lines, 1)])
   end function table_of_spectra

   !> Histograms of impact speed and peak force of every joint with contacts.
   function table_of_histograms(statistics, catalogue, events, t_end) result(table)
      type(statistics_t), intent(in) :: statistics       !! the window and the bins
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(event_list_t), intent(in) :: events           !! all events
      real(wp), intent(in) :: t_end                      !! last instant reached [s]
      type(result_table_t) :: table                      !! two rows for each joint

      type(joint_statistics_t), allocatable :: found(:)
      type(text_t), allocatable :: joints(:), names(:)
      integer, allocatable :: counts(:, :)
      real(wp), allocatable :: edges(:, :)
      character(:), allocatable :: units
      integer :: k

      joints = joints_of(catalogue)
      associate (bins => statistics%plan%bins, n => 2*size(joints))
         allocate (counts(bins, n), edges(bins + 1, n), names(n))
         units = repeat(" m/s N", size(joints))
         call statistics_of_joints(joints, events, statistics%plan%after, t_end, found)
         do k = 1, size(joints)
            call histogram(found(k)%speeds, edges(:, 2*k - 1), counts(:, 2*k - 1))
            call histogram(found(k)%forces, edges(:, 2*k), counts(:, 2*k))
            names(2*k - 1)%s = joints(k)%s//".impact_speed"
            names(2*k)%s = joints(k)%s//".peak_force"
         end do
         call table%start("histograms", "statistics", n, "statistics")
         call table%put("histogram_names", "1", "histogrammed quantity", texts=names, formats=in_hdf5)
         call table%put("histogram_edges", units(2:), "edges of the bins", [edges], formats=in_hdf5, shape=[bins + 1])
         call table%put("histogram_counts", "1", "number of impacts in the bins", integers=[counts], formats=in_hdf5, shape=[bins])
      end associate
   end function table_of_histograms

   !> Names of channels.
   function names_of(scalars, catalogue) result(names)
      type(scalar_t), intent(in) :: scalars(:)           !! (n) channels
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(text_t) :: names(size(scalars))               !! (n) their names

      integer :: k

      do k = 1, size(scalars)
         names(k)%s = scalar_name(catalogue, scalars(k))
      end do
   end function names_of

   !> Units of channels with blanks between them.
   function units_of(scalars, catalogue) result(units)
      type(scalar_t), intent(in) :: scalars(:)           !! (n) channels
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      character(:), allocatable :: units                 !! one for each

      type(text_t) :: list(size(scalars))
      integer :: k

      do k = 1, size(scalars)
         list(k)%s = catalogue%groups(scalars(k)%group)%channel%unit
      end do
      units = join(list, " ")
   end function units_of

end module statistics_tables
