!> Minimum and maximum values of the channels of a run with their times, their means, and what clearance joints went through.
!>
!> Minimum and maximum are those of all rows, output instants and instants of contacts, and of the extremes located between them;
!> mean and root mean square are integrals over the time by the trapezoidal rule on the output instants. NaN is skipped: means are
!> over the time between output instants that both have a number, and a channel that never has one has no extremes. Impacts are
!> read from the list of events.
module extremes
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use channel_noise, only: noise_of_channels
   use contact_statistics, only: joint_statistics_t, joints_of, statistics_of_joints
   use event_list, only: event_list_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use name_table, only: name_table_t
   use archive, only: archive_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: extreme_t, extremes_t, joint_extremes_t, joints_at_extremes

   real(wp), parameter :: max_square = 1.0e150_wp  !! numbers beyond it have no square [any]

   !> What one number went through.
   type :: extreme_t
      real(wp) :: minimum = huge(1.0_wp)        !! minimum value, SI [any]
      real(wp) :: min_time = 0.0_wp         !! when it was first there [s]
      real(wp) :: maximum = -huge(1.0_wp)    !! maximum value, SI [any]
      real(wp) :: max_time = 0.0_wp      !! when it was first there [s]
      real(wp) :: last = 0.0_wp               !! value at the last output instant, SI; NaN: none [any]
      real(wp) :: integral = 0.0_wp           !! of the value over the time [any]
      real(wp) :: integral_2 = 0.0_wp         !! of its square [any]
      real(wp) :: gap = 0.0_wp                !! time without values [s]
   end type extreme_t

   !> What the channels of a run went through.
   type :: extremes_t
      type(scalar_t), allocatable :: channels(:)       !! (n) the numbers, first those that are recorded
      integer :: n_recorded = 0                        !! how many are; of the others there is no list
      type(extreme_t), allocatable :: of(:)            !! (n) what they went through
      real(wp), allocatable :: noise(:)                !! (n) less is round-off, found by `find_noise` [any]
      type(text_t), allocatable, private :: units(:)   !! (m) units that the numbers have, each once
      integer, allocatable, private :: with_unit(:)    !! (m) the first number with each
      integer, allocatable, private :: place(:)        !! (n) where they stand in the values of the catalogue
      integer, private :: n_sample = 0                 !! output instants so far
      real(wp), private :: t_first = 0.0_wp            !! the first of them [s]
      real(wp), private :: t_last = 0.0_wp             !! the last of them [s]
      real(wp), private :: first_row = huge(1.0_wp)    !! time of the first row of all [s]
      real(wp), private :: last_row = -huge(1.0_wp)    !! of the last [s]
   contains
      procedure :: start => start_extremes
      procedure :: places
      procedure :: sample => sample_extremes
      procedure :: note => note_extremes
      procedure :: has_time
      procedure :: has_course
      procedure :: has_rows
      procedure :: mean => mean_of
      procedure :: shown_mean
      procedure :: told
      procedure :: find_noise
      procedure :: noise_in
      procedure :: has_values
      procedure :: size_of
      procedure :: is_nothing
      procedure :: rms => rms_of
      procedure :: save => save_extremes
      procedure :: load => load_extremes
   end type extremes_t

   !> What the contacts of a joint went through.
   type :: joint_extremes_t
      character(:), allocatable :: name                !! of the joint
      integer :: impacts = 0                           !! contacts that started
      real(wp) :: contact_fraction = 0.0_wp            !! part of the time in contact [1]
      real(wp) :: speed = 0.0_wp                       !! maximum impact speed [m/s]
      real(wp) :: speed_onset = 0.0_wp                 !! onset of that contact [s]
      real(wp) :: force = 0.0_wp                       !! maximum normal force [N]
      real(wp) :: force_onset = 0.0_wp                 !! onset of the contact that had it [s]
      real(wp) :: force_time = 0.0_wp                  !! when it was there [s]
      real(wp) :: penetration = 0.0_wp                 !! maximum penetration [m]
      real(wp) :: penetration_onset = 0.0_wp           !! onset of the contact that had it [s]
      real(wp) :: penetration_time = 0.0_wp            !! when it was there [s]
      real(wp) :: impulse = 0.0_wp                     !! of the normal forces of all contacts [N.s]
      real(wp) :: energy_lost = 0.0_wp                 !! in all contacts; NaN without ledger [J]
   end type joint_extremes_t

   interface

      !> Write what was gathered.
      module subroutine save_extremes(self, archive)
         implicit none (type, external)
         class(extremes_t), intent(in) :: self  !! what was gathered
         type(archive_t), intent(inout) :: archive    !! receives it
      end subroutine save_extremes

      !> Take it back.
      module subroutine load_extremes(self, archive)
         implicit none (type, external)
         class(extremes_t), intent(inout) :: self  !! started
         type(archive_t), intent(inout) :: archive       !! holds it
      end subroutine load_extremes

      !> What the contacts of all clearance joints went through between two instants.
      module subroutine joints_at_extremes(catalogue, events, from, until, joints)
         implicit none (type, external)
         type(catalogue_t), intent(in) :: catalogue                      !! what can be recorded
         type(event_list_t), intent(in) :: events                        !! all events
         real(wp), intent(in) :: from                                    !! start of the run [s]
         real(wp), intent(in) :: until                                   !! its end [s]
         type(joint_extremes_t), allocatable, intent(out) :: joints(:)   !! (n) the joints with contacts
      end subroutine joints_at_extremes

   end interface

contains

   !> Start with some numbers.
   subroutine start_extremes(self, catalogue, recorded, further)
      class(extremes_t), intent(inout) :: self       !! what is gathered
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      type(scalar_t), intent(in) :: recorded(:)      !! (any) numbers that are recorded
      type(scalar_t), intent(in) :: further(:)       !! (any) others

      integer :: k

      self%channels = [recorded, further]
      self%n_recorded = size(recorded)
      associate (channels => self%channels)
         self%place = [(catalogue%place(channels(k)%group, channels(k)%component, channels(k)%item), k=1, size(channels))]
         if (allocated(self%of)) deallocate (self%of)
         allocate (self%of(size(channels)))
      end associate
      self%n_sample = 0
      self%first_row = huge(1.0_wp)
      self%last_row = -huge(1.0_wp)
   end subroutine start_extremes

   !> Where the numbers stand in the values of the catalogue.
   pure function places(self)
      class(extremes_t), intent(in) :: self   !! what is gathered
      integer, allocatable :: places(:)       !! (n) places

      places = self%place
   end function places

   !> An output instant.
   subroutine sample_extremes(self, t, catalogue)
      class(extremes_t), intent(inout) :: self     !! what is gathered
      real(wp), intent(in) :: t                    !! time [s]
      type(catalogue_t), intent(in) :: catalogue   !! values at t

      real(wp) :: half
      integer :: k

      half = 0.0_wp
      if (self%n_sample > 0) half = 0.5_wp*(t - self%t_last)
      do k = 1, size(self%channels)
         associate (one => self%of(k), x => catalogue%values(self%place(k)))
            if (ieee_is_finite(x) .and. ieee_is_finite(one%last)) then
               one%integral = one%integral + half*(bounded(x) + one%last)
               one%integral_2 = one%integral_2 + half*(bounded(x)**2 + one%last**2)
            else
               one%gap = one%gap + 2.0_wp*half
            end if
            if (ieee_is_finite(x)) then
               call note_one(bounded(x), t, one)
               one%last = bounded(x)
            else
               one%last = not_a_number()
            end if
         end associate
      end do
      if (self%n_sample == 0) self%t_first = t
      self%n_sample = self%n_sample + 1
      self%t_last = t
      self%first_row = min(self%first_row, t)
      self%last_row = max(self%last_row, t)
   end subroutine sample_extremes

   !> Minimum and maximum values of a row.
   subroutine note_extremes(self, t, catalogue)
      class(extremes_t), intent(inout) :: self     !! what is gathered
      real(wp), intent(in) :: t                    !! time [s]
      type(catalogue_t), intent(in) :: catalogue   !! values at t

      integer :: k

      self%first_row = min(self%first_row, t)
      self%last_row = max(self%last_row, t)
      do k = 1, size(self%channels)
         associate (x => catalogue%values(self%place(k)))
            if (ieee_is_finite(x)) call note_one(bounded(x), t, self%of(k))
         end associate
      end do
   end subroutine note_extremes

   !> Minimum and maximum values of a number.
   pure subroutine note_one(x, t, one)
      real(wp), intent(in) :: x               !! the value [any]
      real(wp), intent(in) :: t               !! time [s]
      type(extreme_t), intent(inout) :: one   !! what it went through

      if (x < one%minimum) then
         one%minimum = x
         one%min_time = t
      end if
      if (x > one%maximum) then
         one%maximum = x
         one%max_time = t
      end if
   end subroutine note_one

   !> A number, bounded where it has no square.
   pure real(wp) function bounded(x)
      real(wp), intent(in) :: x   !! the number [any]

      bounded = min(max(x, -max_square), max_square)
   end function bounded

   !> What a number went through; extremes and their times are NaN if it never was one.
   pure type(extreme_t) function told(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      told = self%of(k)
      if (self%has_values(k)) return
      told%minimum = not_a_number()
      told%min_time = not_a_number()
      told%maximum = not_a_number()
      told%max_time = not_a_number()
   end function told

   !> What is round-off in the channels, once the run has ended.
   pure subroutine find_noise(self, catalogue, mass)
      class(extremes_t), intent(inout) :: self      !! what was gathered
      type(catalogue_t), intent(in) :: catalogue    !! what can be recorded
      real(wp), intent(in) :: mass                  !! of the lightest body [kg]

      type(text_t), allocatable :: units(:)
      integer :: i, k, n

      n = size(self%channels)
      allocate (units(n))
      self%with_unit = [integer ::]
      do k = 1, n
         units(k)%s = catalogue%groups(self%channels(k)%group)%channel%unit
         if (any([(units(self%with_unit(i))%s == units(k)%s, i=1, size(self%with_unit))])) cycle
         self%with_unit = [self%with_unit, k]
      end do
      self%units = units(self%with_unit)
      self%noise = noise_of_channels(units, [(self%size_of(k), k=1, n)], max(self%last_row - self%first_row, 0.0_wp), &
                                     mass)
   end subroutine find_noise

   !> What is round-off in numbers of a unit; 0 if none is recorded.
   pure real(wp) function noise_in(self, unit) result(noise)
      class(extremes_t), intent(in) :: self   !! what was gathered, its noise found
      character(*), intent(in) :: unit        !! SI

      integer :: i

      noise = 0.0_wp
      if (.not. allocated(self%units)) return
      do i = 1, size(self%units)
         if (self%units(i)%s == unit) noise = self%noise(self%with_unit(i))
      end do
   end function noise_in

   !> Whether a channel ever had a number.
   pure logical function has_values(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      has_values = self%of(k)%minimum <= self%of(k)%maximum
   end function has_values

   !> Whether there are rows at all.
   pure logical function has_rows(self)
      class(extremes_t), intent(in) :: self   !! what was gathered

      has_rows = self%last_row >= self%first_row
   end function has_rows

   !> Whether there are rows of more than one instant: an equilibrium is one.
   pure logical function has_course(self)
      class(extremes_t), intent(in) :: self   !! what was gathered

      has_course = self%last_row > self%first_row
   end function has_course

   !> Whether there are two output instants, so that there are means.
   pure logical function has_time(self)
      class(extremes_t), intent(in) :: self   !! what was gathered

      has_time = self%n_sample > 1 .and. self%t_last > self%t_first
   end function has_time

   !> Maximum absolute value of a number, 0 if it never was one.
   pure real(wp) function size_of(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      size_of = 0.0_wp
      if (self%has_values(k)) size_of = max(abs(self%of(k)%minimum), abs(self%of(k)%maximum))
   end function size_of

   !> Time over which a number can be averaged.
   pure real(wp) function span_of(self, k) result(span)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      real(wp), parameter :: round_off = 1.0e-12_wp  ! of the time [1]

      span = 0.0_wp
      if (.not. self%has_time()) return
      span = self%t_last - self%t_first - self%of(k)%gap
      if (span <= round_off*(self%t_last - self%t_first)) span = 0.0_wp
   end function span_of

   !> Mean of a number over the time; NaN: there is no time, or no number.
   pure real(wp) function mean_of(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      real(wp) :: span

      mean_of = not_a_number()
      span = span_of(self, k)
      if (span > 0.0_wp) mean_of = self%of(k)%integral/span
   end function mean_of

   !> The same for people: what is round-off beside the root mean square is zero.
   pure real(wp) function shown_mean(self, k) result(mean)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      real(wp), parameter :: round_off = 1.0e-12_wp  ! of the root mean square [1]

      mean = self%mean(k)
      if (.not. span_of(self, k) > 0.0_wp) return
      if (abs(mean) < round_off*self%rms(k)) mean = 0.0_wp
   end function shown_mean

   !> Whether a number was zero, or round-off, all the time.
   pure logical function is_nothing(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      is_nothing = self%has_values(k) .and. self%size_of(k) <= self%noise(k)
   end function is_nothing

   !> Root mean square of a number over the time; NaN: there is no time, or no number.
   pure real(wp) function rms_of(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      real(wp) :: span

      rms_of = not_a_number()
      span = span_of(self, k)
      if (span > 0.0_wp) rms_of = sqrt(self%of(k)%integral_2/span)
   end function rms_of

end module extremes
