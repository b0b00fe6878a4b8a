!> A recorder that keeps channels in memory besides what a kept run has, with their extremes so far.
!>
!> Extremes are those of all rows, and those located between rows. Values are kept at the output instants, or at each of a whole
!> number of them. Every channel has a kind, by which its differences are measured (`channel_difference`):
!> what has the same unit in the same group; of requests that are no lengths, rates, forces or energies each is a kind of its own.
!> Where a contact would act is kept while its bodies touch only, else it is no number: a pin in the middle of its bearing, or of
!> its film, would act anywhere.
module kept_channels
   use catalogue, only: catalogue_t
   use catalogue_groups, only: goes_round, group_t
   use groups_of_catalogue, only: group_bodies, group_contacts, group_requests
   use errors, only: error_t
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kept_run, only: kept_run_t, n_sort, sort_of, sort_positions
   use kinds, only: i8, not_a_number, wp
   use recorder, only: summary_t
   use states_of_contacts, only: state_contact, state_mixed
   implicit none (type, external)
   private
   public :: channel_kind_t, class_acceleration, class_energy, class_force, class_length, class_other, class_power, class_rate, &
      kept_channels_t

   integer, parameter :: class_length = 1  !! m, rad
   integer, parameter :: class_rate = 2    !! m/s, rad/s
   integer, parameter :: class_force = 3   !! N, N.m
   integer, parameter :: class_energy = 4  !! J
   integer, parameter :: class_acceleration = 5  !! m/s^2, rad/s^2
   integer, parameter :: class_power = 6   !! W
   integer, parameter :: class_other = 7   !! all else, each unit by itself

   character(*), parameter :: places = " contact_point contact_angle "  !! channels of contacts: where they act, or would

   !> A kind of channels behind the sorts: what is measured by one scale.
   type :: channel_kind_t
      integer :: item_group = 0                         !! of the catalogue
      integer :: class = class_other              !! of its unit
      integer :: group = 0                        !! quantity of a request, which is a kind of its own; else 0
      character(:), allocatable :: unit           !! of a unit by itself
   end type channel_kind_t

   !> Values of the channels, and their extremes.
   type :: series_t
      real(wp), allocatable :: x(:, :)            !! (n, capacity) values at the instants that are kept [any]
      real(wp), allocatable :: low(:, :)          !! (n, capacity) minimum value up to there [any]
      real(wp), allocatable :: high(:, :)         !! (n, capacity) maximum value up to there [any]
      real(wp), allocatable :: minimum(:)           !! (n) minimum value of all rows [any]
      real(wp), allocatable :: most(:)            !! (n) maximum value of all rows [any]
   end type series_t

   !> What is kept. Set `arm`, `asked` and `stride` before it starts.
   !> Components: what every recorder has, and what it kept of a run.
   type, extends(kept_run_t) :: kept_channels_t
      integer, allocatable :: asked(:, :)         !! (3, n) group, component, item of the channels
      integer :: stride = 1                       !! output instants from one that is kept to the next
      integer, allocatable :: kind(:)             !! (n) kind of each channel: a sort, or n_sort and the number of a further one
      type(channel_kind_t), allocatable :: further(:)  !! (any) the further kinds
      logical, allocatable :: goes_round(:)       !! (n) an angle that jumps by a turn
      real(wp), allocatable :: factor_of(:)       !! (n) to the unit of its kind [any]
      real(wp), allocatable :: magnitude(:)       !! (kinds) maximum magnitude, in the unit of the kind [any]
      type(series_t) :: series                    !! values of the channels
      type(summary_t) :: summary                  !! how the run went
      integer(i8), private :: n_sample = 0        !! output instants so far
      integer, allocatable, private :: kind_of(:) !! (groups) kind of all values of a group, 0: they scale nothing
      integer, allocatable :: state_of(:)         !! (n) group of the states of contacts, of a channel of their places; else 0
   contains
      procedure :: start => start_channels
      procedure :: wants => wants_channels
      procedure :: sample => sample_channels
      procedure :: further_row => row_of_channels
      procedure :: between => between_rows_of_channels
      procedure :: finish => finish_channels
   end type kept_channels_t

contains

   !> Find kinds and factors of the channels.
   subroutine start_channels(self, catalogue, error)
      class(kept_channels_t), intent(inout) :: self      !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! what can be recorded
      type(error_t), allocatable, intent(out) :: error   !! never set

      integer :: g, k, n

      call self%kept_run_t%start(catalogue, error)
      n = size(self%asked, 2)
      allocate (self%kind(n), self%state_of(n), source=0)
      allocate (self%factor_of(n), source=1.0_wp)
      allocate (self%further(0))
      allocate (self%series%x(n, size(self%t)), self%series%low(n, size(self%t)), self%series%high(n, size(self%t)), source=0.0_wp)
      allocate (self%series%minimum(n), source=huge(1.0_wp))
      allocate (self%series%most(n), source=-huge(1.0_wp))
      allocate (self%kind_of(size(catalogue%groups)), source=0)
      allocate (self%goes_round(n), source=.false.)
      do g = 1, size(catalogue%groups)
         self%kind_of(g) = sort_of(catalogue%groups(g)%item_group, catalogue%groups(g)%channel%name)
      end do
      do k = 1, n
         g = self%asked(1, k)
         associate (group => catalogue%groups(g))
            if (self%kind_of(g) == 0) self%kind_of(g) = n_sort + number_of_kind(self, group, g)
            self%kind(k) = self%kind_of(g)
            self%factor_of(k) = factor_to(self, group, self%asked(3, k))
            if (group%item_group == group_contacts .and. is_place(catalogue, g)) then
               self%state_of(k) = catalogue%find_group(group_contacts, "state")
            end if
            self%goes_round(k) = goes_round(group)
         end associate
      end do
      allocate (self%magnitude(n_sort + size(self%further)), source=0.0_wp)
      self%located%place = [(catalogue%place(self%asked(1, k), self%asked(2, k), self%asked(3, k)), k=1, n)]
   end subroutine start_channels

   !> Whether a value is read: the channels, what scales them, and what every kept run has.
   pure logical function wants_channels(self, group, item) result(wants)
      class(kept_channels_t), intent(in) :: self   !! the recorder
      integer, intent(in) :: group                 !! its group in the catalogue
      integer, intent(in) :: item                  !! number of the item in the group's group

      wants = self%kind_of(group) > 0 .or. any(self%state_of == group) .or. self%kept_run_t%wants(group, item)
   end function wants_channels

   !> Whether a quantity of contacts says where they act, or how far that is.
   pure logical function is_place(catalogue, g)
      type(catalogue_t), intent(in) :: catalogue   !! what can be recorded
      integer, intent(in) :: g                     !! number of the quantity

      integer :: vector

      vector = merge(catalogue%groups(g)%vector, g, catalogue%groups(g)%vector > 0)
      is_place = index(places, " "//catalogue%groups(vector)%channel%name//" ") > 0
   end function is_place

   !> Number of the further kind of a quantity; a new one is added.
   integer function number_of_kind(self, group, g) result(n)
      class(kept_channels_t), intent(inout) :: self   !! the recorder
      type(group_t), intent(in) :: group              !! the quantity
      integer, intent(in) :: g                        !! its number in the catalogue

      type(channel_kind_t) :: kind

      kind = channel_kind_t(item_group=group%item_group, class=class_of(group%channel%unit), unit="")
      if (kind%class == class_other) then
         kind%unit = group%channel%unit
         if (group%item_group == group_requests) kind%group = g
      end if
      do n = 1, size(self%further)
         associate (other => self%further(n))
            if (other%item_group == kind%item_group .and. other%class == kind%class .and. other%group == kind%group .and. &
                other%unit == kind%unit) return
         end associate
      end do
      self%further = [self%further, kind]
   end function number_of_kind

   !> Class of a unit.
   pure integer function class_of(unit)
      character(*), intent(in) :: unit  !! SI

      select case (unit)
      case ("m", "rad"); class_of = class_length
      case ("m/s", "rad/s"); class_of = class_rate
      case ("N", "N.m"); class_of = class_force
      case ("J"); class_of = class_energy
      case ("m/s^2", "rad/s^2"); class_of = class_acceleration
      case ("W"); class_of = class_power
      case default; class_of = class_other
      end select
   end function class_of

   !> What makes angles ways, and moments forces: the radius of gyration of a body, elsewhere the maximum one. A turn of a
   !> radian changes Euler parameters by a half at most.
   pure real(wp) function factor_to(self, group, item) result(factor)
      class(kept_channels_t), intent(in) :: self     !! the recorder
      type(group_t), intent(in) :: group             !! a quantity
      integer, intent(in) :: item                    !! number of one that has it

      factor = 1.0_wp
      if (group%channel%unit == "N.m") factor = 1.0_wp/maxval(self%arm)
      if (sort_of(group%item_group, group%channel%name) == sort_positions .and. group%channel%unit == "1") then
         factor = 2.0_wp*self%arm(item)
      end if
      if (index(group%channel%unit, "rad") /= 1) return
      factor = maxval(self%arm)
      if (group%item_group == group_bodies) factor = self%arm(item)
   end function factor_to

   !> Keep an output instant.
   subroutine sample_channels(self, t, catalogue, error)
      class(kept_channels_t), intent(inout) :: self      !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! never set

      integer :: k

      call note(self, catalogue, .true.)
      self%n_sample = self%n_sample + 1
      if (modulo(self%n_sample - 1, int(self%stride, i8)) /= 0) return
      call self%kept_run_t%sample(t, catalogue, error)
      if (size(self%t) > size(self%series%x, 2)) then
         call widen(self%series%x, size(self%t))
         call widen(self%series%low, size(self%t))
         call widen(self%series%high, size(self%t))
      end if
      do k = 1, size(self%kind)
         self%series%x(k, self%n) = value_of(self, catalogue, k)
      end do
      self%series%low(:, self%n) = self%series%minimum
      self%series%high(:, self%n) = self%series%most
   end subroutine sample_channels

   !> Note the extremes of a row of a contact, or of a condition that ends the run.
   subroutine row_of_channels(self, t, kind, catalogue, error)
      class(kept_channels_t), intent(inout) :: self      !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      integer, intent(in) :: kind                        !! what it is
      type(catalogue_t), intent(in) :: catalogue         !! values at t
      type(error_t), allocatable, intent(out) :: error   !! never set

      call note(self, catalogue, .false.)
   end subroutine row_of_channels

   !> Note the extremes of an instant between the last rows.
   subroutine between_rows_of_channels(self, t, catalogue)
      class(kept_channels_t), intent(inout) :: self      !! the recorder
      real(wp), intent(in) :: t                          !! time [s]
      type(catalogue_t), intent(in) :: catalogue         !! values at t

      real(wp) :: x
      integer :: i, k

      call note(self, catalogue, .false.)
      do i = self%n, 1, -1   ! instants that were kept before this one was looked at
         if (self%t(i) < t) exit
         do k = 1, size(self%kind)
            x = value_of(self, catalogue, k)
            if (self%goes_round(k) .or. .not. ieee_is_finite(x)) cycle
            self%series%low(k, i) = min(self%series%low(k, i), x)
            self%series%high(k, i) = max(self%series%high(k, i), x)
         end do
      end do
   end subroutine between_rows_of_channels

   !> Extremes and magnitudes. Those of an angle that jumps by a turn are of output instants: what is nearest to the jump is chance.
   subroutine note(self, catalogue, is_output)
      class(kept_channels_t), intent(inout) :: self      !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! values
      logical, intent(in) :: is_output                   !! of an output instant

      real(wp) :: x
      integer :: g, i, j, k

      do k = 1, size(self%kind)
         x = value_of(self, catalogue, k)
         if (.not. ieee_is_finite(x) .or. (self%goes_round(k) .and. .not. is_output)) cycle
         if (x < self%series%minimum(k)) self%series%minimum(k) = x
         if (x > self%series%most(k)) self%series%most(k) = x
      end do
      do g = 1, size(self%kind_of)
         if (self%kind_of(g) == 0) cycle
         associate (magnitude => self%magnitude(self%kind_of(g)), group => catalogue%groups(g))
            do j = 1, size(group%has)
               if (.not. catalogue%item_has(g, j)) cycle
               do i = 1, group%channel%components
                  x = abs(catalogue%values(catalogue%place(g, i, j)))
                  if (.not. ieee_is_finite(x)) cycle
                  if (x*factor_to(self, group, j) > magnitude) magnitude = x*factor_to(self, group, j)
               end do
            end do
         end associate
      end do
   end subroutine note

   !> Value of a channel; of where a contact that does not touch would act not a number.
   pure real(wp) function value_of(self, catalogue, k)
      class(kept_channels_t), intent(in) :: self         !! the recorder
      type(catalogue_t), intent(in) :: catalogue         !! values
      integer, intent(in) :: k                           !! number of the channel

      real(wp) :: state

      value_of = catalogue%values(catalogue%place(self%asked(1, k), self%asked(2, k), self%asked(3, k)))
      if (self%state_of(k) == 0) return
      state = catalogue%values(catalogue%place(self%state_of(k), 1, self%asked(3, k)))
      if (ieee_is_finite(state)) then
         if (nint(state) == state_contact .or. nint(state) == state_mixed) return
      end if
      value_of = not_a_number()
   end function value_of

   !> Make columns for more instants.
   subroutine widen(list, n)
      real(wp), allocatable, intent(inout) :: list(:, :)  !! (any, less than n) grown [any]
      integer, intent(in) :: n                            !! columns

      real(wp), allocatable :: wider(:, :)

      allocate (wider(size(list, 1), n), source=0.0_wp)
      wider(:, :size(list, 2)) = list
      call move_alloc(wider, list)
   end subroutine widen

   !> The run has ended.
   subroutine finish_channels(self, summary, error)
      class(kept_channels_t), intent(inout) :: self      !! the recorder
      type(summary_t), intent(in) :: summary             !! cost and errors of the run
      type(error_t), allocatable, intent(out) :: error   !! never set

      self%summary = summary
      call self%kept_run_t%finish(summary, error)
      self%series%x = self%series%x(:, :self%n)
      self%series%low = self%series%low(:, :self%n)
      self%series%high = self%series%high(:, :self%n)
   end subroutine finish_channels

end module kept_channels
