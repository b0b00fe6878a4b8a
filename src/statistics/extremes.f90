!> Least and greatest values of the channels of a run with their times, their means, and what loose joints went through.
!>
!> Least and greatest are those of all rows, output instants and instants of contacts; mean and root mean square are integrals over
!> the time by the trapezoidal rule on the output instants. Impacts are read from the list of events.
module extremes
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_t
   use contact_statistics, only: joint_statistics_t, joints_of, statistics_of_joints
   use event_list, only: event_list_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   use name_table, only: name_table_t
   use tape, only: tape_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: extreme_t, extremes_t, joint_extremes_t, joints_at_extremes

   real(wp), parameter :: greatest_square = 1.0e150_wp  !! numbers beyond it have no square [any]

   !> What one number went through.
   type :: extreme_t
      real(wp) :: least = huge(1.0_wp)        !! least value, SI [any]
      real(wp) :: least_time = 0.0_wp         !! when it was first there [s]
      real(wp) :: greatest = -huge(1.0_wp)    !! greatest value, SI [any]
      real(wp) :: greatest_time = 0.0_wp      !! when it was first there [s]
      real(wp) :: last = 0.0_wp               !! value at the last output instant, SI [any]
      real(wp) :: integral = 0.0_wp           !! of the value over the time [any]
      real(wp) :: integral_2 = 0.0_wp         !! of its square [any]
   end type extreme_t

   !> What the channels of a run went through.
   type :: extremes_t
      type(scalar_t), allocatable :: channels(:)       !! (n) the numbers
      type(extreme_t), allocatable :: of(:)            !! (n) what they went through
      integer, allocatable, private :: place(:)        !! (n) where they stand in the values of the catalogue
      integer, private :: n_sample = 0                 !! output instants so far
      real(wp), private :: t_first = 0.0_wp            !! the first of them [s]
      real(wp), private :: t_last = 0.0_wp             !! the last of them [s]
   contains
      procedure :: start => start_extremes
      procedure :: sample => sample_extremes
      procedure :: note => note_extremes
      procedure :: has_time
      procedure :: mean => mean_of
      procedure :: shown_mean
      procedure :: is_nothing
      procedure :: rms => rms_of
      procedure :: save => save_extremes
      procedure :: load => load_extremes
   end type extremes_t

   !> What the contacts of a joint went through.
   type :: joint_extremes_t
      character(:), allocatable :: name                !! of the joint
      integer :: impacts = 0                           !! contacts that began
      real(wp) :: contact_fraction = 0.0_wp            !! part of the time in contact [1]
      real(wp) :: speed = 0.0_wp                       !! greatest impact speed [m/s]
      real(wp) :: speed_onset = 0.0_wp                 !! onset of that contact [s]
      real(wp) :: force = 0.0_wp                       !! greatest normal force [N]
      real(wp) :: force_onset = 0.0_wp                 !! onset of the contact that had it [s]
      real(wp) :: force_time = 0.0_wp                  !! when it was there [s]
      real(wp) :: penetration = 0.0_wp                 !! greatest penetration [m]
      real(wp) :: penetration_onset = 0.0_wp           !! onset of the contact that had it [s]
      real(wp) :: penetration_time = 0.0_wp            !! when it was there [s]
      real(wp) :: impulse = 0.0_wp                     !! of the normal forces of all contacts [N.s]
      real(wp) :: energy_lost = 0.0_wp                 !! in all contacts; NaN without ledger [J]
   end type joint_extremes_t

contains

   !> Begin with some numbers.
   subroutine start_extremes(self, catalogue, channels)
      class(extremes_t), intent(inout) :: self       !! what is gathered
      type(catalogue_t), intent(in) :: catalogue     !! what can be recorded
      type(scalar_t), intent(in) :: channels(:)      !! (n) the numbers

      integer :: k

      self%channels = channels
      self%place = [(catalogue%place(channels(k)%group, channels(k)%component, channels(k)%item), k=1, size(channels))]
      if (allocated(self%of)) deallocate (self%of)
      allocate (self%of(size(channels)))
      self%n_sample = 0
   end subroutine start_extremes

   !> An output instant.
   subroutine sample_extremes(self, t, catalogue)
      class(extremes_t), intent(inout) :: self     !! what is gathered
      real(wp), intent(in) :: t                    !! time [s]
      type(catalogue_t), intent(in) :: catalogue   !! values at t

      real(wp) :: half, x
      integer :: k

      half = 0.0_wp
      if (self%n_sample > 0) half = 0.5_wp*(t - self%t_last)
      do k = 1, size(self%channels)
         x = counted(catalogue%values(self%place(k)))
         associate (one => self%of(k))
            call note_one(x, t, one)
            one%integral = one%integral + half*(x + one%last)
            one%integral_2 = one%integral_2 + half*(x**2 + one%last**2)
            one%last = x
         end associate
      end do
      if (self%n_sample == 0) self%t_first = t
      self%n_sample = self%n_sample + 1
      self%t_last = t
   end subroutine sample_extremes

   !> Least and greatest values of a row.
   subroutine note_extremes(self, t, catalogue)
      class(extremes_t), intent(inout) :: self     !! what is gathered
      real(wp), intent(in) :: t                    !! time [s]
      type(catalogue_t), intent(in) :: catalogue   !! values at t

      real(wp) :: x
      integer :: k

      do k = 1, size(self%channels)
         x = counted(catalogue%values(self%place(k)))
         call note_one(x, t, self%of(k))
      end do
   end subroutine note_extremes

   !> Least and greatest values of a number.
   pure subroutine note_one(x, t, one)
      real(wp), intent(in) :: x               !! the value [any]
      real(wp), intent(in) :: t               !! time [s]
      type(extreme_t), intent(inout) :: one   !! what it went through

      if (x < one%least) then
         one%least = x
         one%least_time = t
      end if
      if (x > one%greatest) then
         one%greatest = x
         one%greatest_time = t
      end if
   end subroutine note_one

   !> A value that counts; of one that is no number, or has no square, nothing.
   pure real(wp) function counted(value) result(x)
      real(wp), intent(in) :: value   !! the value [any]

      x = 0.0_wp
      if (ieee_is_finite(value)) x = min(max(value, -greatest_square), greatest_square)
   end function counted

   !> Whether there are two instants, so that something can pass: an equilibrium is one.
   pure logical function has_time(self)
      class(extremes_t), intent(in) :: self   !! what was gathered

      has_time = self%n_sample > 1 .and. self%t_last > self%t_first
   end function has_time

   !> Mean of a number over the time; NaN: there is no time.
   pure real(wp) function mean_of(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      mean_of = not_a_number()
      if (self%has_time()) mean_of = self%of(k)%integral/(self%t_last - self%t_first)
   end function mean_of

   !> The same for people: what is round-off beside the root mean square is zero.
   pure real(wp) function shown_mean(self, k) result(mean)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      real(wp), parameter :: round_off = 1.0e-12_wp  ! of the root mean square [1]

      mean = self%mean(k)
      if (.not. self%has_time()) return
      if (abs(mean) < round_off*self%rms(k)) mean = 0.0_wp
   end function shown_mean

   !> Whether a number was zero all the time.
   pure logical function is_nothing(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      is_nothing = max(abs(self%of(k)%least), abs(self%of(k)%greatest)) <= 0.0_wp
   end function is_nothing

   !> Root mean square of a number over the time; NaN: there is no time.
   pure real(wp) function rms_of(self, k)
      class(extremes_t), intent(in) :: self   !! what was gathered
      integer, intent(in) :: k                !! which number

      rms_of = not_a_number()
      if (self%has_time()) rms_of = sqrt(self%of(k)%integral_2/(self%t_last - self%t_first))
   end function rms_of

   !> What the contacts of all loose joints went through between two instants.
   subroutine joints_at_extremes(catalogue, events, from, until, joints)
      type(catalogue_t), intent(in) :: catalogue                      !! what can be recorded
      type(event_list_t), intent(in) :: events                        !! all events
      real(wp), intent(in) :: from                                    !! begin of the run [s]
      real(wp), intent(in) :: until                                   !! its end [s]
      type(joint_extremes_t), allocatable, intent(out) :: joints(:)   !! (n) the joints with contacts

      type(joint_statistics_t), allocatable :: found(:)
      type(name_table_t) :: table
      type(text_t), allocatable :: names(:)
      integer :: j, k

      names = joints_of(catalogue)
      call statistics_of_joints(names, events, from, until, found)
      call table%list(names)
      allocate (joints(size(names)))
      do j = 1, size(joints)
         joints(j)%name = names(j)%s
         joints(j)%contact_fraction = found(j)%contact_fraction
      end do
      do k = 1, events%n
         if (events%word(k, 1) /= "contact") cycle
         j = table%find(events%word(k, 2))
         if (j > 0) call add_contact(events%numbers(:, k), joints(j))
      end do
   end subroutine joints_at_extremes

   !> Add a contact to what a joint went through.
   pure subroutine add_contact(numbers, joint)
      real(wp), intent(in) :: numbers(:)              !! (10) of the event, see `event_list` [any]
      type(joint_extremes_t), intent(inout) :: joint  !! the joint

      real(wp) :: at

      at = 0.0_wp
      joint%impacts = joint%impacts + 1
      call raise(numbers(2), numbers(1), joint%speed, joint%speed_onset, at)
      call raise(numbers(3), numbers(9), joint%force, joint%force_onset, joint%force_time)
      call raise(numbers(4), numbers(10), joint%penetration, joint%penetration_onset, joint%penetration_time)
      joint%impulse = joint%impulse + numbers(8)
      if (.not. ieee_is_finite(joint%energy_lost)) return
      if (ieee_is_finite(numbers(7))) then
         joint%energy_lost = joint%energy_lost + numbers(7)
      else
         joint%energy_lost = not_a_number()
      end if

   contains

      !> Take a value that is greater than those before.
      pure subroutine raise(x, t, greatest, onset, when)
         real(wp), intent(in) :: x            !! the value [any]
         real(wp), intent(in) :: t            !! when it was there [s]
         real(wp), intent(inout) :: greatest  !! the greatest so far [any]
         real(wp), intent(inout) :: onset     !! of its contact [s]
         real(wp), intent(inout) :: when      !! when it was there [s]

         if (.not. ieee_is_finite(x)) return
         if (joint%impacts > 1 .and. x <= greatest) return
         greatest = x
         onset = numbers(1)
         when = t
      end subroutine raise

   end subroutine add_contact

   !> Write what was gathered.
   subroutine save_extremes(self, tape)
      class(extremes_t), intent(in) :: self  !! what was gathered
      type(tape_t), intent(inout) :: tape    !! receives it

      integer :: k

      call tape%put(self%n_sample)
      call tape%put([self%t_first, self%t_last])
      do k = 1, size(self%of)
         call tape%put(transfer(self%of(k), [0.0_wp]))
      end do
   end subroutine save_extremes

   !> Take it back.
   subroutine load_extremes(self, tape)
      class(extremes_t), intent(inout) :: self  !! started
      type(tape_t), intent(inout) :: tape       !! holds it

      real(wp) :: numbers(size(transfer(extreme_t(), [0.0_wp])))
      integer :: k

      call tape%get(self%n_sample)
      call tape%get(self%t_first)
      call tape%get(self%t_last)
      do k = 1, size(self%of)
         call tape%get(numbers)
         self%of(k) = transfer(numbers, self%of(k))
      end do
   end subroutine load_extremes

end module extremes
