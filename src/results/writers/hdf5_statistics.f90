!> The statistics of a run in run.h5: the group /statistics (docs/output.md).
module hdf5_statistics
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use event_list, only: event_list_t
   use hdf5, only: hid_t
   use hdf5_datasets, only: integer_dataset, real_dataset, text_dataset
   use kinds, only: wp
   use contact_statistics, only: histogram, joint_statistics_t, joints_of, statistics_of_joints
   use statistics, only: number_t, statistics_t
   use text, only: join, text_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: write_statistics

contains

   !> Write the group.
   subroutine write_statistics(file, statistics, catalogue, events, t_end, numbers, status)
      integer(hid_t), intent(in) :: file               !! the file
      type(statistics_t), intent(in) :: statistics     !! what was gathered
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      type(event_list_t), intent(in) :: events         !! all events
      real(wp), intent(in) :: t_end                    !! last instant reached [s]
      type(number_t), intent(in) :: numbers(:)         !! (m) the numbers of the run
      integer, intent(inout) :: status                 !! negative: failed

      type(text_t), allocatable :: names(:), units(:)
      character(:), allocatable :: all_units
      integer :: k

      allocate (names(size(numbers)), units(size(numbers)))
      all_units = ""
      do k = 1, size(numbers)
         names(k)%s = numbers(k)%name
         units(k)%s = numbers(k)%unit
         all_units = trim(all_units//" "//numbers(k)%unit)
      end do
      call text_dataset(file, "statistics/names", names, .false., "names of the statistics", status)
      call text_dataset(file, "statistics/units", units, .false., "their units", status)
      call real_dataset(file, "statistics/values", [size(numbers)], [(numbers(k)%value, k=1, size(numbers))], &
                        trim(adjustl(all_units)), "statistics after the transient", status)
      if (statistics%n_poincare > 0) call write_poincare(file, statistics, catalogue, status)
      if (size(statistics%spectra) > 0) call write_spectra(file, statistics, catalogue, status)
      call write_histograms(file, statistics, catalogue, events, t_end, status)
   end subroutine write_statistics

   !> The channels once per period.
   subroutine write_poincare(file, statistics, catalogue, status)
      integer(hid_t), intent(in) :: file               !! the file
      type(statistics_t), intent(in) :: statistics     !! what was gathered
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      integer, intent(inout) :: status                 !! negative: failed

      integer :: n

      n = statistics%n_poincare
      call text_dataset(file, "statistics/strobe_names", names_of(statistics%channels, catalogue), .false., &
                        "channels sampled once per period", status)
      call real_dataset(file, "statistics/strobe_time", [n], statistics%poincare_times(1:n), "s", &
                        "multiples of the drive period", status)
      call real_dataset(file, "statistics/strobe", [size(statistics%channels), n], &
                        reshape(statistics%poincare_samples(:, 1:n), [n*size(statistics%channels)]), &
                        units_of(statistics%channels, catalogue), "channel values at these times", status)
   end subroutine write_poincare

   !> The spectra.
   subroutine write_spectra(file, statistics, catalogue, status)
      integer(hid_t), intent(in) :: file               !! the file
      type(statistics_t), intent(in) :: statistics     !! what was gathered
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      integer, intent(inout) :: status                 !! negative: failed

      real(wp), allocatable :: amplitude(:), frequency(:), lines(:, :)
      integer :: k

      do k = 1, size(statistics%spectra)
         call statistics%spectrum_of(k, frequency, amplitude)
         if (k == 1) allocate (lines(size(statistics%spectra), size(frequency)))
         lines(k, :) = amplitude
      end do
      call text_dataset(file, "statistics/spectrum_names", names_of(statistics%spectra, catalogue), .false., &
                        "channels of the spectra", status)
      call real_dataset(file, "statistics/frequency", [size(frequency)], frequency, "Hz", "frequencies of the spectral lines", &
         status)
      call real_dataset(file, "statistics/spectrum", [size(lines, 1), size(lines, 2)], reshape(lines, [size(lines)]), &
                        units_of(statistics%spectra, catalogue), "amplitude spectrum, Hann window", status)
   end subroutine write_spectra

   !> Histograms of impact speed and peak force of every joint with contacts.
   subroutine write_histograms(file, statistics, catalogue, events, t_end, status)
      integer(hid_t), intent(in) :: file               !! the file
      type(statistics_t), intent(in) :: statistics     !! the window and the bins
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      type(event_list_t), intent(in) :: events         !! all events
      real(wp), intent(in) :: t_end                    !! last instant reached [s]
      integer, intent(inout) :: status                 !! negative: failed

      type(joint_statistics_t), allocatable :: found(:)
      type(text_t), allocatable :: joints(:), names(:)
      integer, allocatable :: counts(:, :)
      real(wp), allocatable :: edges(:, :)
      character(:), allocatable :: units
      integer :: bins, k

      joints = joints_of(catalogue)
      if (size(joints) == 0) return
      bins = statistics%plan%bins
      allocate (counts(bins, 2*size(joints)), edges(bins + 1, 2*size(joints)), names(2*size(joints)))
      units = repeat(" m/s N", size(joints))
      call statistics_of_joints(joints, events, statistics%plan%after, t_end, found)
      do k = 1, size(joints)
         call histogram(found(k)%speeds, edges(:, 2*k - 1), counts(:, 2*k - 1))
         call histogram(found(k)%forces, edges(:, 2*k), counts(:, 2*k))
         names(2*k - 1)%s = joints(k)%s//".impact_speed"
         names(2*k)%s = joints(k)%s//".peak_force"
      end do
      call text_dataset(file, "statistics/histogram_names", names, .false., "histogrammed quantity", status)
      call real_dataset(file, "statistics/histogram_edges", [bins + 1, size(names)], reshape(edges, [size(edges)]), &
                        units(2:), "edges of the bins", status)
      call integer_dataset(file, "statistics/histogram_counts", [bins, size(names)], reshape(counts, [size(counts)]), &
                           "number of impacts in the bins", status)
   end subroutine write_histograms

   !> Names of channels.
   function names_of(scalars, catalogue) result(names)
      type(scalar_t), intent(in) :: scalars(:)         !! (n) channels
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      type(text_t) :: names(size(scalars))             !! (n) their names

      integer :: k

      do k = 1, size(scalars)
         names(k)%s = scalar_name(catalogue, scalars(k))
      end do
   end function names_of

   !> Units of channels with blanks between them.
   function units_of(scalars, catalogue) result(units)
      type(scalar_t), intent(in) :: scalars(:)         !! (n) channels
      type(catalogue_t), intent(in) :: catalogue       !! what can be recorded
      character(:), allocatable :: units               !! one for each

      type(text_list_t) :: list
      integer :: k

      do k = 1, size(scalars)
         call list%add(catalogue%groups(scalars(k)%group)%channel%unit)
      end do
      units = join(list%get(), " ")
   end function units_of

end module hdf5_statistics
