!> Numbers of a motion after its transient: of channels on the output instants, of contacts from their events, and the
!> channels once per period of the drive. Extremes take the rows at contacts too.
!>
!> Of a channel x at the output instants t_k from the end of the transient on: mean and RMS by the trapezoidal rule,
!> $$ \bar x = \frac{1}{t_n - t_1} \sum_k \tfrac12 (x_k + x_{k+1}) (t_{k+1} - t_k), \quad x_{rms}^2 = \overline{x^2}, $$
!> the minimum and the maximum value, and the peak max |x|. Values that are not numbers are omitted: means are over the time between
!> output instants that both have one. Contact fractions and counts come from the events: the fraction is the share of the time
!> in which at least one contact of the joint is closed; an impact belongs to the window if its onset does.
module statistics
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use channels, only: find_scalars, item_finder_t, selection_t
   use contact_statistics, only: joint_statistics_t, joints_of, statistics_of_joints
   use event_list, only: event_list_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use spectrum, only: amplitude_spectrum
   use archive, only: archive_t
   use text, only: append_text, text_t
   use worn_surface, only: worn_surface_t
   implicit none (type, external)
   private
   public :: names_of_numbers, number_t, statistics_plan_t
   public :: make_storage, make_storage_for_poincare, statistics_t

   integer, parameter :: n_of_channel = 5  !! numbers of a channel
   !> Their names.
   character(*), parameter :: channel_words(n_of_channel) = [character(4) :: "mean", "rms", "peak", "min", "max"]
   integer, parameter :: n_of_joint = 8    !! numbers of a joint with clearance
   !> Their names.
   character(*), parameter :: joint_words(n_of_joint) = [character(18) :: "contact_fraction", "impacts", &
      "impacts_per_second", "impacts_per_period", "impact_speed.mean", "impact_speed.max", "peak_force.mean", "peak_force.max"]
   !> Their units.
   character(*), parameter :: joint_units(n_of_joint) = [character(3) :: "1", "1", "1/s", "1", "m/s", "m/s", "N", "N"]

   integer, parameter :: n_of_wear = 4     !! numbers of a joint that wears
   !> Their names.
   character(*), parameter :: wear_words(n_of_wear) = [character(20) :: "bearing_worn_volume", "bearing_worn_depth", &
      "journal_worn_volume", "journal_worn_depth"]
   !> Their units.
   character(*), parameter :: wear_units(n_of_wear) = [character(3) :: "m^3", "m", "m^3", "m"]

   !> What is asked for. Lists that are not allocated count as empty.
   type :: statistics_plan_t
      logical :: is_wanted = .false.             !! the deck has a section [statistics]
      real(wp) :: after = 0.0_wp                 !! end of the transient [s]
      real(wp) :: end = 0.0_wp                   !! end of the motion [s]
      real(wp) :: period = 0.0_wp                !! of the drive, 0: none [s]
      integer :: bins = 20                       !! of the histograms
      type(text_t), allocatable :: channels(:)   !! (n) words for channels
      type(text_t), allocatable :: spectra(:)    !! (n) words for channels
      logical :: has_finals = .false.            !! the values at the last output time are numbers too
   end type statistics_plan_t

   !> One number of a run.
   type :: number_t
      character(:), allocatable :: name      !! as `motor.moment.rms`
      character(:), allocatable :: unit      !! SI, `1` if none
      real(wp) :: value = 0.0_wp             !! NaN: not known [any]
      real(wp) :: noise = 0.0_wp             !! less is round-off [any]
   end type number_t

   !> What is gathered during a run.
   type :: statistics_t
      type(statistics_plan_t) :: plan                     !! what is asked for
      type(scalar_t), allocatable :: channels(:)          !! (n) channels of the numbers and of the sections
      type(scalar_t), allocatable :: spectra(:)           !! (m) channels of the spectra
      integer :: n_poincare = 0                             !! instants once per period so far
      real(wp), allocatable :: poincare_times(:)            !! (n_strobe or more) these instants [s]
      real(wp), allocatable :: poincare_samples(:, :)              !! (n, n_strobe or more) the channels at them, SI [any]
      integer, private :: n_sample = 0                    !! output instants in the window so far
      real(wp), private :: t_first = 0.0_wp               !! the first of them [s]
      real(wp), private :: t_last = 0.0_wp                !! the last of them [s]
      real(wp), allocatable :: x_last(:)                  !! (n) values at the last instant, SI; NaN: none [any]
      real(wp), allocatable, private :: integral(:)       !! (n) of the values [any]
      real(wp), allocatable, private :: integral_2(:)     !! (n) of their squares [any]
      real(wp), allocatable, private :: gap(:)            !! (n) time without values [s]
      real(wp), allocatable, private :: lowest(:)         !! (n) minimum values [any]
      real(wp), allocatable, private :: highest(:)        !! (n) maximum values [any]
      real(wp), allocatable, private :: series(:, :)      !! (m, n_sample or more) channels of the spectra, SI [any]
   contains
      procedure :: start => start_statistics
      procedure :: places => places_of_channels
      procedure :: sample => sample_statistics
      procedure :: note_extremes
      procedure :: poincare => poincare_statistics
      procedure :: numbers => numbers_of_run
      procedure :: spectrum_of
      procedure :: has_time
      procedure :: has_mean
      procedure, private :: span_of
      procedure :: save => save_statistics
      procedure :: load => load_statistics
   end type statistics_t

   interface

      !> Write what was gathered.
      module subroutine save_statistics(self, archive)
         implicit none (type, external)
         class(statistics_t), intent(in) :: self  !! what was gathered
         type(archive_t), intent(inout) :: archive      !! receives it
      end subroutine save_statistics

      !> Take it back.
      module subroutine load_statistics(self, archive)
         implicit none (type, external)
         class(statistics_t), intent(inout) :: self  !! started
         type(archive_t), intent(inout) :: archive         !! holds it
      end subroutine load_statistics

      !> The numbers that words name, then further ones, each once.
      module subroutine take_words(words, catalogue, more, list)
         implicit none (type, external)
         type(text_t), allocatable, intent(in) :: words(:)        !! (any) words of the deck; unallocated: none
         type(catalogue_t), intent(in) :: catalogue               !! what can be recorded
         type(scalar_t), intent(in) :: more(:)                    !! (any) further numbers
         type(scalar_t), allocatable, intent(out) :: list(:)      !! (n) all
      end subroutine take_words

   end interface

contains

   !> Understand the words and start; words that the catalogue does not know are skipped.
   subroutine start_statistics(self, plan, catalogue, sections, spectra)
      class(statistics_t), intent(inout) :: self        !! what is gathered
      type(statistics_plan_t), intent(in) :: plan       !! what is asked for
      type(catalogue_t), intent(in) :: catalogue        !! what can be recorded
      type(scalar_t), intent(in) :: sections(:)         !! (any) channels that figures need once per period
      type(scalar_t), intent(in) :: spectra(:)          !! (any) channels whose spectra figures need

      integer :: n

      self%plan = plan
      self%n_sample = 0
      self%n_poincare = 0
      if (.not. plan%is_wanted) then
         allocate (self%channels(0), self%spectra(0))
         return
      end if
      call take_words(plan%channels, catalogue, sections, self%channels)
      call take_words(plan%spectra, catalogue, spectra, self%spectra)
      n = size(self%channels)
      allocate (self%x_last(n), self%integral(n), self%integral_2(n), self%gap(n), source=0.0_wp)
      allocate (self%lowest(n), source=huge(1.0_wp))
      allocate (self%highest(n), source=-huge(1.0_wp))
      allocate (self%poincare_times(64), self%poincare_samples(n, 64), self%series(size(self%spectra), 1024))
   end subroutine start_statistics

   !> Where the channels stand in the values of the catalogue.
   pure function places_of_channels(self, catalogue) result(places)
      class(statistics_t), intent(in) :: self      !! what is gathered
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded
      integer, allocatable :: places(:)            !! (n) places

      integer :: k

      places = [(catalogue%place(self%channels(k)%group, self%channels(k)%component, self%channels(k)%item), &
                 k=1, size(self%channels))]
   end function places_of_channels

   !> An output instant.
   subroutine sample_statistics(self, t, catalogue)
      class(statistics_t), intent(inout) :: self  !! what is gathered
      real(wp), intent(in) :: t                   !! time [s]
      type(catalogue_t), intent(in) :: catalogue  !! values at t

      real(wp) :: step, x
      integer :: k

      if (.not. self%plan%is_wanted .or. t < self%plan%after) return
      step = t - self%t_last
      if (self%n_sample == 0) self%t_first = t
      do k = 1, size(self%channels)
         x = value_of(catalogue, self%channels(k))
         if (self%n_sample > 0 .and. .not. (ieee_is_finite(x) .and. ieee_is_finite(self%x_last(k)))) then
            self%gap(k) = self%gap(k) + step
         else if (self%n_sample > 0) then
            self%integral(k) = self%integral(k) + 0.5_wp*step*(x + self%x_last(k))
            self%integral_2(k) = self%integral_2(k) + 0.5_wp*step*(x**2 + self%x_last(k)**2)
         end if
         self%x_last(k) = x
      end do
      call self%note_extremes(t, catalogue)
      self%n_sample = self%n_sample + 1
      self%t_last = t
      if (size(self%spectra) == 0) return
      call make_storage(self%series, self%n_sample)
      do k = 1, size(self%spectra)
         self%series(k, self%n_sample) = value_of(catalogue, self%spectra(k))
      end do
   end subroutine sample_statistics

   !> Minimum and maximum values of an instant, which may be one of a contact.
   subroutine note_extremes(self, t, catalogue)
      class(statistics_t), intent(inout) :: self  !! what is gathered
      real(wp), intent(in) :: t                   !! time [s]
      type(catalogue_t), intent(in) :: catalogue  !! values at t

      real(wp) :: x
      integer :: k

      if (.not. self%plan%is_wanted .or. t < self%plan%after) return
      do k = 1, size(self%channels)
         x = value_of(catalogue, self%channels(k))
         if (.not. ieee_is_finite(x)) cycle
         self%lowest(k) = min(self%lowest(k), x)
         self%highest(k) = max(self%highest(k), x)
      end do
   end subroutine note_extremes

   !> An instant once per period; nothing is kept if no statistics are requested.
   subroutine poincare_statistics(self, t, catalogue)
      class(statistics_t), intent(inout) :: self  !! what is gathered
      real(wp), intent(in) :: t                   !! time [s]
      type(catalogue_t), intent(in) :: catalogue  !! values at t

      integer :: k

      if (.not. self%plan%is_wanted) return
      call make_storage_for_poincare(self)
      self%poincare_times(self%n_poincare) = t
      do k = 1, size(self%channels)
         self%poincare_samples(k, self%n_poincare) = value_of(catalogue, self%channels(k))
      end do
   end subroutine poincare_statistics

   !> One instant once per period more.
   subroutine make_storage_for_poincare(self)
      class(statistics_t), intent(inout) :: self  !! what is gathered

      real(wp), allocatable :: longer(:)

      self%n_poincare = self%n_poincare + 1
      call make_storage(self%poincare_samples, self%n_poincare)
      if (self%n_poincare <= size(self%poincare_times)) return
      allocate (longer(size(self%poincare_samples, 2)), source=0.0_wp)
      longer(1:self%n_poincare - 1) = self%poincare_times
      call move_alloc(longer, self%poincare_times)
   end subroutine make_storage_for_poincare

   !> A value of the catalogue.
   pure real(wp) function value_of(catalogue, scalar)
      type(catalogue_t), intent(in) :: catalogue  !! current values
      type(scalar_t), intent(in) :: scalar        !! which

      value_of = catalogue%values(catalogue%place(scalar%group, scalar%component, scalar%item))
   end function value_of

   !> Make sure that an array has a column of a given number.
   subroutine make_storage(columns, n)
      real(wp), allocatable, intent(inout) :: columns(:, :)  !! (any, at least n on return) [any]
      integer, intent(in) :: n                               !! columns needed

      real(wp), allocatable :: larger(:, :)

      if (n <= size(columns, 2)) return
      allocate (larger(size(columns, 1), max(n, 2*size(columns, 2))))
      larger(:, 1:size(columns, 2)) = columns
      call move_alloc(larger, columns)
   end subroutine make_storage

   !> Amplitude spectrum of channel number k of the spectra.
   subroutine spectrum_of(self, k, frequency, amplitude)
      class(statistics_t), intent(in) :: self                !! what was gathered
      integer, intent(in) :: k                               !! number of the channel
      real(wp), allocatable, intent(out) :: frequency(:)     !! (lines) [Hz]
      real(wp), allocatable, intent(out) :: amplitude(:)     !! (lines) SI [any]

      allocate (frequency(0), amplitude(0))
      if (self%n_sample < 2) return
      call amplitude_spectrum(self%series(k, 1:self%n_sample), &
                              (self%t_last - self%t_first)/real(self%n_sample - 1, wp), frequency, amplitude)
   end subroutine spectrum_of

   !> Whether there are two output instants in the window.
   pure logical function has_time(self)
      class(statistics_t), intent(in) :: self   !! what was gathered

      has_time = self%n_sample > 1 .and. self%t_last > self%t_first
   end function has_time

   !> Whether a channel has a mean.
   pure logical function has_mean(self, k)
      class(statistics_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                  !! number of the channel

      has_mean = self%has_time() .and. self%lowest(k) <= self%highest(k) .and. self%span_of(k) > 0.0_wp
   end function has_mean

   !> Time over which a channel is averaged; 0: none.
   pure real(wp) function span_of(self, k) result(span)
      class(statistics_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                  !! number of the channel

      real(wp), parameter :: round_off = 1.0e-12_wp  ! of the time [1]

      span = self%t_last - self%t_first - self%gap(k)
      if (span <= round_off*(self%t_last - self%t_first)) span = 0.0_wp
   end function span_of

   !> All numbers of the run.
   function numbers_of_run(self, catalogue, events, worn, t_end) result(list)
      class(statistics_t), intent(in) :: self        !! what was gathered
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      type(event_list_t), intent(in) :: events       !! all events
      type(worn_surface_t), allocatable, intent(in) :: worn(:)   !! (any) bearing and journal of each joint that wears
      real(wp), intent(in) :: t_end                  !! last instant reached [s]
      type(number_t), allocatable :: list(:)         !! (any) numbers

      type(joint_statistics_t), allocatable :: contacts(:)
      type(text_t), allocatable :: joints(:), wearing(:)
      real(wp) :: angle, depth, span, values(n_of_joint)
      integer :: k

      allocate (list(0))
      if (.not. self%plan%is_wanted) return
      allocate (wearing(0))
      if (allocated(worn)) then
         do k = 1, size(worn), 2
            call append_text(wearing, worn(k)%joint)
         end do
      end if
      call names_of_numbers(self%channels, catalogue, wearing, list)
      do k = 1, size(self%channels)
         if (self%lowest(k) > self%highest(k)) cycle
         span = self%span_of(k)
         associate (low => self%lowest(k), high => self%highest(k), first => n_of_channel*(k - 1))
            list(first + 3:first + 5)%value = [max(abs(low), abs(high)), low, high]
            if (span <= 0.0_wp) cycle
            list(first + 1:first + 2)%value = [self%integral(k)/span, sqrt(self%integral_2(k)/span)]
         end associate
      end do
      joints = joints_of(catalogue)
      call statistics_of_joints(joints, events, self%plan%after, t_end, contacts)
      span = t_end - self%plan%after
      do k = 1, size(joints)
         associate (joint => contacts(k))
            values = not_a_number()
            if (span > 0.0_wp) values(1:3) = [joint%contact_fraction, real(size(joint%speeds), wp), size(joint%speeds)/span]
            if (span > 0.0_wp .and. self%plan%period > 0.0_wp) values(4) = values(2)*self%plan%period/span
            if (size(joint%speeds) > 0) then
               values(5:6) = [sum(joint%speeds)/real(size(joint%speeds), wp), maxval(joint%speeds)]
               values(7) = sum(joint%forces)/real(size(joint%forces), wp)
            end if
            if (joint%max_force >= 0.0_wp) values(8) = joint%max_force
         end associate
         associate (first => n_of_channel*size(self%channels) + n_of_joint*(k - 1))
            list(first + 1:first + n_of_joint)%value = values
         end associate
      end do
      do k = 1, 2*size(wearing)   ! at the end of the run, with what was worn before
         call worn(k)%max_depth(depth, angle)
         associate (first => size(list) - n_of_wear*size(wearing) + 2*(k - 1))
            list(first + 1:first + 2)%value = [sum(worn(k)%volume), depth]
         end associate
      end do
   end function numbers_of_run

   !> Names and units of all numbers: those of the channels, those of the joints, those of joints that wear; the values are NaN.
   subroutine names_of_numbers(channels, catalogue, wearing, list)
      type(scalar_t), intent(in) :: channels(:)                !! (n) channels
      type(catalogue_t), intent(in) :: catalogue               !! what can be recorded
      type(text_t), intent(in) :: wearing(:)                   !! (any) joints that wear
      type(number_t), allocatable, intent(out) :: list(:)      !! (any) numbers

      type(text_t), allocatable :: joints(:)
      integer :: i, k, n

      joints = joints_of(catalogue)
      allocate (list(n_of_channel*size(channels) + n_of_joint*size(joints) + n_of_wear*size(wearing)))
      n = 0
      do k = 1, size(channels)
         do i = 1, n_of_channel
            n = n + 1
            list(n)%name = scalar_name(catalogue, channels(k))//"."//trim(channel_words(i))
            list(n)%unit = catalogue%groups(channels(k)%group)%channel%unit
            list(n)%value = not_a_number()
         end do
      end do
      do k = 1, size(joints)
         do i = 1, n_of_joint
            n = n + 1
            list(n)%name = joints(k)%s//"."//trim(joint_words(i))
            list(n)%unit = trim(joint_units(i))
            list(n)%value = not_a_number()
         end do
      end do
      do k = 1, size(wearing)
         do i = 1, n_of_wear
            n = n + 1
            list(n)%name = wearing(k)%s//"."//trim(wear_words(i))
            list(n)%unit = trim(wear_units(i))
            list(n)%value = not_a_number()
         end do
      end do
   end subroutine names_of_numbers

end module statistics
