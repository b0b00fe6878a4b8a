!> Extremes of numbers between the rows of a motion.
!>
!> If the parabola through the values in three rows has its top between them, and goes beyond the extreme so far by more than
!> round-off, the number is found there, and again as the bracket narrows, until nothing is gained (`peak_bracket`).
!> The state there is interpolated between the two rows around it (`interpolation`), with derivatives at the inner places; the
!> value is that of the equations at this state. It counts if interpolation without these derivatives gives nearly the same
!> value. Rows before and after an event are never put together.
!>
!> The caller adds the rows of a motion (output instants, contacts, ends of steps) and asks for instants (`ask`) until there are
!> none; it answers each with the values (`answer`).
!>
!> A number that is missing in the last written row counts in written rows only: its value next to where it is missing hangs on
!> the steps.
!>
!> Limits: rows must be close enough to show an extreme; contacts, whose forces are faster, have peaks of their own
!> (`contact_peaks`).
module channel_peaks
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_contacts, group_energy
   use channel_noise, only: noise_of_channels
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use interpolation, only: step_t
   use kinds, only: i8, not_a_number, wp
   use peak_bracket, only: bracket_t, find_bends, most_output_times
   use recorder, only: recorder_t
   use archive, only: archive_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: channel_peaks_t, tell_between, tell_sample

   real(wp), parameter :: doubt = 1.0e-2_wp      !! difference of both polynomials, of what rows differ by, that is too much [1]
   real(wp), parameter :: same = 1.0e-7_wp     !! difference of both polynomials, of the number, that is round-off [1]
   real(wp), parameter :: round_off = 1.0e-13_wp !! change between rows that is round-off, of the number [1]

   !> The last rows, and the extremes so far.
   type :: channel_peaks_t
      integer, allocatable :: place(:)                !! (n) of the numbers in the values of the catalogue; unallocated: none
      integer, private :: n_row = 0                   !! rows since the last event, at most 3
      real(wp), private :: from = -huge(1.0_wp)       !! extremes start anew there [s]
      real(wp), private :: t(3) = 0.0_wp              !! (3) times of the last rows, the latest is the last [s]
      integer, private :: column(3) = [1, 2, 3]       !! (3) where these rows are in what follows
      real(wp), allocatable, private :: y(:, :)       !! (m, 3) states, by column [any]
      real(wp), allocatable, private :: ydot(:, :)    !! (m, 3) their derivatives, by column [any]
      real(wp), allocatable, private :: x(:, :)       !! (n, 3) numbers, by column; 0 where missing [any]
      logical, allocatable, private :: is_here(:, :)  !! (n, 3) they are not missing
      logical, allocatable, private :: is_known(:)    !! (n) the number is not missing in the last written row
      integer, allocatable, private :: bends(:)       !! (n) the last rows have a maximum (1) or a minimum (-1) between them; else 0
      type(text_t), allocatable, private :: units(:)  !! (n) SI
      real(wp), allocatable, private :: noise(:)      !! (n) what of them is round-off, by the rows so far [any]
      integer(i8), private :: n_written = 0           !! written rows so far
      real(wp), allocatable, private :: minimum(:)      !! (n) the minimum so far [any]
      real(wp), allocatable, private :: most(:)       !! (n) the maximum so far [any]
      type(bracket_t), private :: search              !! what is searched
      type(step_t) :: pair                            !! the two rows around the instant that is asked for
      integer, private :: first = 0                   !! number of the first of these two; 0: none
   contains
      procedure :: begin => begin_peaks
      procedure :: forget => forget_rows
      procedure :: add_row
      procedure :: ask => ask_instant
      procedure :: asked_for
      procedure :: answer => answer_instant
      procedure :: take_pair
      procedure :: is_first
      procedure :: last_row
      procedure :: save => save_peaks
      procedure :: load => load_peaks
   end type channel_peaks_t

contains

   !> Start with numbers of the catalogue. Forces and penetrations of contacts have rows at their peaks, and the residual of the
   !> ledger is known at the ends of steps only.
   subroutine begin_peaks(self, catalogue, place, from, m)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      type(catalogue_t), intent(in) :: catalogue     !! what is reported
      integer, intent(in) :: place(:)                !! (n) places in its values
      real(wp), intent(in) :: from                   !! extremes start anew there [s]
      integer, intent(in) :: m                       !! numbers of a state; 0: states are found otherwise

      integer :: g, group_of(size(catalogue%values)), k, n
      logical :: is_searched(size(catalogue%values))

      is_searched = .true.
      do g = 1, size(catalogue%groups)
         associate (group => catalogue%groups(g), first => catalogue%groups(g)%before + 1)
            associate (last => group%before + group%channel%components*size(group%has), name => group%channel%name)
               group_of(first:last) = g
               if (group%item_group == group_contacts) is_searched(first:last) = name /= "normal_force" .and. name /= "penetration"
               if (group%item_group == group_energy) is_searched(first:last) = name /= "residual"
            end associate
         end associate
      end do
      self%place = pack(place, is_searched(place))
      self%from = from
      n = size(self%place)
      allocate (self%units(n))
      do k = 1, n
         self%units(k)%s = catalogue%groups(group_of(self%place(k)))%channel%unit
      end do
      allocate (self%y(m, 3), self%ydot(m, 3), self%x(n, 3), self%noise(n), source=0.0_wp)
      allocate (self%pair%y0(m), self%pair%y1(m), self%pair%f0(m), self%pair%f1(m), self%pair%inner(m, 2), source=0.0_wp)
      allocate (self%is_here(n, 3), source=.false.)
      allocate (self%is_known(n), source=.false.)
      allocate (self%bends(n), source=0)
      allocate (self%minimum(n), source=huge(1.0_wp))
      allocate (self%most(n), source=-huge(1.0_wp))
   end subroutine begin_peaks

   !> An event: what comes has nothing to do with the rows before.
   pure subroutine forget_rows(self)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks

      self%n_row = 0
   end subroutine forget_rows

   !> A row of the motion, and its extremes.
   pure subroutine add_row(self, t, values, y, ydot, is_written)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: values(:)              !! (any) of the catalogue [any]
      real(wp), intent(in) :: y(:)                   !! (m) state [any]
      real(wp), intent(in) :: ydot(:)                !! (m) its derivative [any]
      logical, intent(in) :: is_written              !! not the end of a step only

      integer :: k

      if (self%n_row > 0) then
         if (t <= self%t(3)) self%n_row = 0
         if (self%from > self%t(3) .and. self%from <= t) then
            self%n_row = 0
            self%minimum = huge(1.0_wp)
            self%most = -huge(1.0_wp)
         end if
      end if
      self%t = [self%t(2:), t]
      self%column = [self%column(2:), self%column(1)]
      associate (new => self%column(3))
         self%y(:, new) = y
         self%ydot(:, new) = ydot
         do k = 1, size(self%place)
            self%is_here(k, new) = ieee_is_finite(values(self%place(k)))
            self%x(k, new) = merge(values(self%place(k)), 0.0_wp, self%is_here(k, new))
         end do
         if (is_written) then
            self%is_known = self%is_here(:, new)
            call raise_extremes(size(self%place), self%x(:, new), self%is_known, self%minimum, self%most)
            call count_row(self)
         end if
      end associate
      self%n_row = min(self%n_row + 1, 3)
      self%search = bracket_t()
      self%first = 0
      associate (x => self%x, c => self%column)
         if (self%n_row == 3) call find_bends(size(self%place), self%t, x(:, c(1)), x(:, c(2)), x(:, c(3)), self%bends)
      end associate
   end subroutine add_row

   !> The extremes with the numbers of a written row.
   pure subroutine raise_extremes(n, x, is_known, minimum, most)
      integer, intent(in) :: n                 !! numbers
      real(wp), intent(in) :: x(n)             !! (n) the numbers [any]
      logical, intent(in) :: is_known(n)       !! (n) the number is not missing
      real(wp), intent(inout) :: minimum(n)    !! (n) the minimum so far [any]
      real(wp), intent(inout) :: most(n)       !! (n) the maximum so far [any]

      integer :: k

      do k = 1, n
         if (.not. is_known(k)) cycle
         minimum(k) = min(minimum(k), x(k))
         most(k) = max(most(k), x(k))
      end do
   end subroutine raise_extremes

   !> Count a written row. What is round-off is found anew each time that their number has doubled.
   pure subroutine count_row(self)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks

      self%n_written = self%n_written + 1
      if (popcnt(self%n_written) /= 1) return
      self%noise = noise_of_channels(self%units, merge(max(abs(self%minimum), abs(self%most)), 0.0_wp, self%minimum <= self%most), &
                                     max(self%t(3), 0.0_wp))
   end subroutine count_row

   !> The next instant at which a number is requested.
   pure subroutine ask_instant(self, t, is_there)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      real(wp), intent(out) :: t                     !! between the last rows [s]
      logical, intent(out) :: is_there               !! there is one

      integer :: k

      is_there = .false.
      t = 0.0_wp
      if (self%n_row < 3) return
      associate (search => self%search)
         do
            if (search%n > 0 .and. search%n < most_output_times) then
               call search%propose(best_of(self), self%noise(search%of), is_there)
               if (is_there) exit
            end if
            k = search%of + 1
            do while (k <= size(self%place))
               if (self%bends(k) /= 0) then
                  if (self%is_known(k) .and. all(self%is_here(k, :))) exit
               end if
               k = k + 1
            end do
            if (k > size(self%place)) return
            call search%begin(k, self%bends(k), self%t, self%x(k, self%column))
            if (maxval(search%f) - minval(search%f) <= round_off*maxval(abs(search%f))) cycle
            call search%propose(best_of(self), self%noise(k), is_there)
            if (is_there) exit
         end do
         t = search%at
      end associate
   end subroutine ask_instant

   !> The extreme so far of the number that is looked at, times the sign.
   pure real(wp) function best_of(self) result(best)
      class(channel_peaks_t), intent(in) :: self  !! the peaks

      associate (k => self%search%of)
         best = merge(self%most(k), -self%minimum(k), self%search%sign == 1)
      end associate
   end function best_of

   !> Place in the values of the catalogue of the number that was asked for.
   pure integer function asked_for(self) result(place)
      class(channel_peaks_t), intent(in) :: self  !! the peaks

      place = self%place(self%search%of)
   end function asked_for

   !> The numbers at the instant that was asked for.
   pure subroutine answer_instant(self, values, rough, counts)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      real(wp), intent(in) :: values(:)              !! (any) of the catalogue [any]
      real(wp), intent(in) :: rough                  !! the number by the polynomial through two rows [any]
      logical, intent(out) :: counts                 !! the values are those of the motion

      real(wp) :: f
      integer :: k

      k = self%search%of  ! the others are left alone: what is found of a number does not depend on which others there are
      associate (search => self%search, x => self%x(k, :))
         f = values(self%asked_for())
         counts = ieee_is_finite(f) .and. ieee_is_finite(rough)
         if (counts) counts = abs(f - rough) <= max(doubt*(maxval(x) - minval(x)), same*maxval(abs(x)))
         search%n = search%n + 1
         if (.not. counts) then
            search%n = most_output_times
            return
         end if
         f = search%sign*f
         self%minimum(k) = min(self%minimum(k), values(self%place(k)))
         self%most(k) = max(self%most(k), values(self%place(k)))
         call search%narrow(f)
      end associate
   end subroutine answer_instant

   !> The two rows around the instant that was asked for, as a step.
   subroutine take_pair(self, is_new)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks; `pair` is set
      logical, intent(out) :: is_new                 !! derivatives between them are not known yet

      integer :: first

      first = merge(1, 2, self%search%at < self%t(2))
      is_new = first /= self%first
      if (.not. is_new) return
      self%first = first
      associate (pair => self%pair)
         pair%t0 = self%t(first)
         pair%h = self%t(first + 1) - self%t(first)
         pair%has_inner = .false.
         pair%y0 = self%y(:, self%column(first))
         pair%y1 = self%y(:, self%column(first + 1))
         pair%f0 = self%ydot(:, self%column(first))
         pair%f1 = self%ydot(:, self%column(first + 1))
      end associate
   end subroutine take_pair

   !> Time of the last row since an event.
   pure real(wp) function last_row(self)
      class(channel_peaks_t), intent(in) :: self  !! the peaks

      last_row = merge(self%t(3), -huge(1.0_wp), self%n_row > 0)
   end function last_row

   !> Whether the instant that was asked for is the first of its search.
   pure logical function is_first(self)
      class(channel_peaks_t), intent(in) :: self  !! the peaks

      is_first = self%search%n == 0
   end function is_first

   !> Report a recorder of an extreme: no other number of the catalogue is one there.
   subroutine tell_between(t, place, catalogue, recorder)
      real(wp), intent(in) :: t                           !! time [s]
      integer, intent(in) :: place                        !! of the number in the values of the catalogue
      type(catalogue_t), intent(inout) :: catalogue       !! values at t; they come back
      class(recorder_t), intent(inout) :: recorder        !! keeps the results

      real(wp), allocatable :: values(:)

      values = catalogue%values
      catalogue%values = not_a_number()
      catalogue%values(place) = values(place)
      call recorder%between(t, catalogue)
      catalogue%values = values
   end subroutine tell_between

   !> Report a recorder of the end of a step, but for numbers that are not known.
   subroutine tell_sample(t, peaks, catalogue, recorder)
      real(wp), intent(in) :: t                           !! time [s]
      type(channel_peaks_t), intent(inout) :: peaks       !! what is known; its extremes so far are raised
      type(catalogue_t), intent(inout) :: catalogue       !! values at t; they come back
      class(recorder_t), intent(inout) :: recorder        !! keeps the results

      real(wp), allocatable :: values(:)
      integer :: k

      values = catalogue%values
      do k = 1, size(peaks%place)
         associate (x => catalogue%values(peaks%place(k)))
            if (.not. peaks%is_known(k)) x = not_a_number()
            if (.not. ieee_is_finite(x)) cycle
            if (x < peaks%minimum(k)) peaks%minimum(k) = x
            if (x > peaks%most(k)) peaks%most(k) = x
         end associate
      end do
      call recorder%between(t, catalogue)
      catalogue%values = values
   end subroutine tell_sample

   !> Write what is remembered.
   subroutine save_peaks(self, archive)
      class(channel_peaks_t), intent(in) :: self  !! the peaks
      type(archive_t), intent(inout) :: archive         !! receives it

      integer :: k

      if (.not. allocated(self%place)) return
      call archive%put(self%n_row)
      call archive%put(self%n_written)
      call archive%put(self%noise)
      call archive%put([self%t, self%minimum, self%most])
      call archive%put(merge(1, 0, self%is_known))
      do k = 1, 3
         associate (c => self%column(k))
            call archive%put([self%y(:, c), self%ydot(:, c), merge(self%x(:, c), not_a_number(), self%is_here(:, c))])
         end associate
      end do
   end subroutine save_peaks

   !> Take it back.
   subroutine load_peaks(self, archive)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks, started
      type(archive_t), intent(inout) :: archive            !! holds it

      integer :: known(size(self%place)), k

      if (.not. allocated(self%place)) return
      call archive%get(self%n_row)
      call archive%get(self%n_written)
      call archive%get(self%noise)
      call archive%get(self%t)
      call archive%get(self%minimum)
      call archive%get(self%most)
      call archive%get(known)
      self%is_known = known == 1
      do k = 1, 3
         associate (c => self%column(k))
            call archive%get(self%y(:, c))
            call archive%get(self%ydot(:, c))
            call archive%get(self%x(:, c))
            self%is_here(:, c) = ieee_is_finite(self%x(:, c))
            where (.not. self%is_here(:, c)) self%x(:, c) = 0.0_wp
         end associate
      end do
   end subroutine load_peaks

end module channel_peaks
