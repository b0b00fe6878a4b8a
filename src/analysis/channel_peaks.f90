!> Extremes of numbers between the rows of a motion.
!>
!> If the parabola through the values in three rows has its top between them, and goes beyond the extreme so far, the number is
!> found there, and again as the bracket narrows, until nothing is gained.
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
   use catalogue_rooms, only: room_contacts
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use interpolation, only: step_t
   use kinds, only: not_a_number, wp
   use recorder, only: recorder_t
   use tape, only: tape_t
   implicit none (type, external)
   private
   public :: channel_peaks_t, tell_between, tell_sample

   real(wp), parameter :: gain = 1.0e-10_wp    !! rise that is worth another instant, of the extreme [1]
   real(wp), parameter :: doubt = 1.0e-2_wp      !! difference of both polynomials, of what rows differ by, that is too much [1]
   real(wp), parameter :: same = 1.0e-7_wp     !! difference of both polynomials, of the number, that is round-off [1]
   real(wp), parameter :: at_row = 1.0e-9_wp   !! least distance from a row, of that between rows [1]
   real(wp), parameter :: round_off = 1.0e-13_wp !! change between rows that is round-off, of the number [1]
   integer, parameter :: most_instants = 6     !! instants looked at for one extreme

   !> The search for one extreme of a number times its sign.
   type :: bracket_t
      integer :: number = 0                   !! 2 k - 1: maximum of number k, 2 k: its minimum
      integer :: n = 0                        !! instants looked at
      real(wp) :: t(3) = 0.0_wp               !! (3) instants [s]
      real(wp) :: f(3) = 0.0_wp               !! (3) values times the sign [any]
      real(wp) :: at = 0.0_wp                 !! instant asked for [s]
   end type bracket_t

   !> The last rows, and the extremes so far.
   type :: channel_peaks_t
      integer, allocatable :: place(:)                !! (n) of the numbers in the values of the catalogue; unallocated: none
      integer, private :: n_row = 0                   !! rows since the last event, at most 3
      real(wp), private :: from = -huge(1.0_wp)       !! extremes begin anew there [s]
      real(wp), private :: t(3) = 0.0_wp              !! (3) times of the last rows, the latest is the last [s]
      real(wp), allocatable, private :: y(:, :)       !! (m, 3) states there [any]
      real(wp), allocatable, private :: ydot(:, :)    !! (m, 3) their derivatives [any]
      real(wp), allocatable, private :: x(:, :)       !! (n, 3) numbers there [any]
      logical, allocatable, private :: is_known(:)    !! (n) the number is not missing in the last written row
      real(wp), allocatable, private :: least(:)      !! (n) the least so far [any]
      real(wp), allocatable, private :: most(:)       !! (n) the greatest so far [any]
      type(bracket_t), private :: search              !! what is looked for
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

   !> Begin with numbers of the catalogue. Forces and penetrations of contacts have rows at their peaks.
   subroutine begin_peaks(self, catalogue, place, from, m)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      type(catalogue_t), intent(in) :: catalogue     !! what is reported
      integer, intent(in) :: place(:)                !! (n) places in its values
      real(wp), intent(in) :: from                   !! extremes begin anew there [s]
      integer, intent(in) :: m                       !! numbers of a state; 0: states are found otherwise

      integer :: g, i
      logical :: has_rows(size(catalogue%values))

      has_rows = .false.
      do g = 1, size(catalogue%groups)
         associate (group => catalogue%groups(g))
            if (group%room /= room_contacts) cycle
            if (group%channel%name /= "normal_force" .and. group%channel%name /= "penetration") cycle
            do i = 1, size(group%has)
               if (catalogue%item_has(g, i)) has_rows(catalogue%place(g, 1, i)) = .true.
            end do
         end associate
      end do
      self%place = pack(place, .not. has_rows(place))
      self%from = from
      allocate (self%y(m, 3), self%ydot(m, 3), self%x(size(self%place), 3), source=0.0_wp)
      allocate (self%pair%y0(m), self%pair%y1(m), self%pair%f0(m), self%pair%f1(m), self%pair%inner(m, 2), source=0.0_wp)
      allocate (self%is_known(size(self%place)), source=.false.)
      allocate (self%least(size(self%place)), source=huge(1.0_wp))
      allocate (self%most(size(self%place)), source=-huge(1.0_wp))
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
            self%least = huge(1.0_wp)
            self%most = -huge(1.0_wp)
         end if
      end if
      do k = 1, 2
         self%t(k) = self%t(k + 1)
         self%y(:, k) = self%y(:, k + 1)
         self%ydot(:, k) = self%ydot(:, k + 1)
         self%x(:, k) = self%x(:, k + 1)
      end do
      self%t(3) = t
      self%y(:, 3) = y
      self%ydot(:, 3) = ydot
      do k = 1, size(self%place)
         associate (x => values(self%place(k)))
            self%x(k, 3) = x
            if (.not. is_written) cycle
            self%is_known(k) = ieee_is_finite(x)
            if (.not. self%is_known(k)) cycle
            if (x < self%least(k)) self%least(k) = x
            if (x > self%most(k)) self%most(k) = x
         end associate
      end do
      self%n_row = min(self%n_row + 1, 3)
      self%search = bracket_t()
      self%first = 0
   end subroutine add_row

   !> The next instant at which a number is wanted.
   pure subroutine ask_instant(self, t, is_there)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      real(wp), intent(out) :: t                     !! between the last rows [s]
      logical, intent(out) :: is_there               !! there is one

      is_there = .false.
      t = 0.0_wp
      if (self%n_row < 3) return
      associate (search => self%search)
         do
            if (search%n > 0 .and. search%n < most_instants) then
               call propose(search, best_of(self), is_there)
               if (is_there) exit
            end if
            search%n = 0
            search%number = search%number + 1
            if (search%number > 2*size(self%place)) return
            if (.not. self%is_known((search%number + 1)/2)) cycle
            if (.not. all(ieee_is_finite(self%x((search%number + 1)/2, :)))) cycle
            search%t = self%t
            search%f = sign_of(search)*self%x((search%number + 1)/2, :)
            if (maxval(search%f) - minval(search%f) <= round_off*maxval(abs(search%f))) cycle
            call propose(search, best_of(self), is_there)
            if (is_there) exit
         end do
         t = search%at
      end associate
   end subroutine ask_instant

   !> Sign of a search.
   pure real(wp) function sign_of(search)
      type(bracket_t), intent(in) :: search  !! the search

      sign_of = merge(1.0_wp, -1.0_wp, modulo(search%number, 2) == 1)
   end function sign_of

   !> The extreme so far of the number that is looked at, times the sign.
   pure real(wp) function best_of(self) result(best)
      class(channel_peaks_t), intent(in) :: self  !! the peaks

      associate (k => (self%search%number + 1)/2)
         best = merge(self%most(k), -self%least(k), modulo(self%search%number, 2) == 1)
      end associate
   end function best_of

   !> The vertex of the parabola through a bracket, if it lies between rows and above the extreme so far.
   pure subroutine propose(search, best, is_there)
      type(bracket_t), intent(inout) :: search   !! the search; the instant is set
      real(wp), intent(in) :: best               !! the extreme so far [any]
      logical, intent(out) :: is_there           !! it is

      real(wp) :: a, b, bend, slope, top, way

      is_there = .false.
      a = search%t(2) - search%t(1)
      b = search%t(3) - search%t(2)
      if (.not. min(a, b) > 0.0_wp) return  ! no closer in the digits of time
      slope = ((search%f(2) - search%f(1))*b/a + (search%f(3) - search%f(2))*a/b)/(a + b)
      bend = 2.0_wp*((search%f(2) - search%f(1))/a - (search%f(3) - search%f(2))/b)/(a + b)
      if (.not. bend > 0.0_wp) return
      way = slope/bend
      top = search%f(2) + 0.5_wp*slope*way
      if (.not. top > best + gain*max(abs(best), abs(top))) return
      if (abs(way) <= at_row*(a + b) .or. way <= -(1.0_wp - at_row)*a .or. way >= (1.0_wp - at_row)*b) return
      search%at = search%t(2) + way
      is_there = .true.
   end subroutine propose

   !> Place in the values of the catalogue of the number that was asked for.
   pure integer function asked_for(self) result(place)
      class(channel_peaks_t), intent(in) :: self  !! the peaks

      place = self%place((self%search%number + 1)/2)
   end function asked_for

   !> The numbers at the instant that was asked for.
   pure subroutine answer_instant(self, values, rough, counts)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks
      real(wp), intent(in) :: values(:)              !! (any) of the catalogue [any]
      real(wp), intent(in) :: rough                  !! the number by the polynomial through two rows [any]
      logical, intent(out) :: counts                 !! the values are those of the motion

      real(wp) :: f
      integer :: k

      associate (search => self%search, x => self%x((self%search%number + 1)/2, :))
         f = values(self%asked_for())
         counts = ieee_is_finite(f) .and. ieee_is_finite(rough)
         if (counts) counts = abs(f - rough) <= max(doubt*(maxval(x) - minval(x)), same*maxval(abs(x)))
         search%n = search%n + 1
         if (.not. counts) then
            search%n = most_instants
            return
         end if
         f = sign_of(search)*f
         k = (search%number + 1)/2  ! the others are left alone: what is found of a number does not depend on which others there are
         self%least(k) = min(self%least(k), values(self%place(k)))
         self%most(k) = max(self%most(k), values(self%place(k)))
         if (search%at < search%t(2) .and. f >= search%f(2)) then
            search%t = [search%t(1), search%at, search%t(2)]
            search%f = [search%f(1), f, search%f(2)]
         else if (search%at < search%t(2)) then
            search%t(1) = search%at
            search%f(1) = f
         else if (f >= search%f(2)) then
            search%t = [search%t(2), search%at, search%t(3)]
            search%f = [search%f(2), f, search%f(3)]
         else
            search%t(3) = search%at
            search%f(3) = f
         end if
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
         pair%y0 = self%y(:, first)
         pair%y1 = self%y(:, first + 1)
         pair%f0 = self%ydot(:, first)
         pair%f1 = self%ydot(:, first + 1)
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

   !> Tell a recorder of an extreme: no other number of the catalogue is one there.
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

   !> Tell a recorder of the end of a step, but for numbers that are not known.
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
            if (x < peaks%least(k)) peaks%least(k) = x
            if (x > peaks%most(k)) peaks%most(k) = x
         end associate
      end do
      call recorder%between(t, catalogue)
      catalogue%values = values
   end subroutine tell_sample

   !> Write what is remembered.
   subroutine save_peaks(self, tape)
      class(channel_peaks_t), intent(in) :: self  !! the peaks
      type(tape_t), intent(inout) :: tape         !! receives it

      integer :: k

      if (.not. allocated(self%place)) return
      call tape%put(self%n_row)
      call tape%put([self%t, self%least, self%most])
      call tape%put(merge(1, 0, self%is_known))
      do k = 1, 3
         call tape%put([self%y(:, k), self%ydot(:, k), self%x(:, k)])
      end do
   end subroutine save_peaks

   !> Take it back.
   subroutine load_peaks(self, tape)
      class(channel_peaks_t), intent(inout) :: self  !! the peaks, begun
      type(tape_t), intent(inout) :: tape            !! holds it

      integer :: known(size(self%place)), k

      if (.not. allocated(self%place)) return
      call tape%get(self%n_row)
      call tape%get(self%t)
      call tape%get(self%least)
      call tape%get(self%most)
      call tape%get(known)
      self%is_known = known == 1
      do k = 1, 3
         call tape%get(self%y(:, k))
         call tape%get(self%ydot(:, k))
         call tape%get(self%x(:, k))
      end do
   end subroutine load_peaks

end module channel_peaks
