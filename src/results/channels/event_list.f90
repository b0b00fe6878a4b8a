!> All events of a run, compactly: numbers in one array, words by their number in a list.
!>
!> Contacts are reported when they end; `order_by_onset` gives the order in time. Equal times keep the
!> order in which they were reported.
module event_list
   use kinds, only: wp
   use recorder, only: event_t
   use name_table, only: name_table_t
   use archive, only: archive_t
   use text_list, only: text_list_t
   implicit none (type, external)
   private
   public :: event_list_t
   public :: n_event_numbers, n_event_words, number_long_names, number_names, number_units, word_long_names, word_names

   integer, parameter :: n_event_numbers = 10 !! numbers of an event
   integer, parameter :: n_event_words = 5    !! words of an event

   !> Names of the numbers of an event, in files.
   character(*), parameter :: number_names(n_event_numbers) = [character(21) :: "time", "impact_speed", &
      "peak_force", "peak_penetration", "duration", "release_speed", "energy_lost", &
      "impulse", "peak_force_time", "peak_penetration_time"]
   !> Their units.
   character(*), parameter :: number_units(n_event_numbers) = [character(3) :: "s", "m/s", "N", "m", "s", "m/s", "J", &
      "N.s", "s", "s"]
   !> What they are.
   character(*), parameter :: number_long_names(n_event_numbers) = [character(64) :: &
      "time of the event; for a contact: of its onset", &
      "normal approach speed at onset", &
      "maximum normal force, located", &
      "maximum penetration, located", &
      "from onset to separation; NaN: in contact at the end of the run", &
      "normal speed at separation", &
      "energy lost in the contact; NaN if the energy balance is off", &
      "impulse of the normal force over the contact", &
      "time of the maximum normal force", &
      "time of the maximum penetration"]
   !> Names of the words of an event, in files.
   character(*), parameter :: word_names(n_event_words) = [character(21) :: "kind", "item", "contact", &
      "state_before", "state_after"]
   !> What they are.
   character(*), parameter :: word_long_names(n_event_words) = [character(64) :: &
      "contact, stick, slip, face, film, driver", &
      "joint or driver", &
      "label of the contact within the joint", &
      "contact state before", &
      "contact state after"]

   !> The events reported so far.
   type :: event_list_t
      integer :: n = 0                            !! number of events
      real(wp), allocatable :: numbers(:, :)      !! (10, capacity) as named above, SI [any]
      integer, allocatable :: codes(:, :)         !! (5, capacity) numbers of their words in `words`
      type(text_list_t) :: words                  !! different words
      type(name_table_t) :: numbers_of_words      !! where each stands
   contains
      procedure :: add => add_event
      procedure :: word => word_of_event
      procedure :: order_by_onset
      procedure :: save => save_events
      procedure :: load => load_events
   end type event_list_t

contains

   !> Append an event.
   subroutine add_event(self, event, is_added)
      class(event_list_t), intent(inout) :: self  !! the list
      type(event_t), intent(in) :: event          !! the event
      logical, intent(out) :: is_added            !! false: there is no memory for it

      call make_storage(self, is_added)
      if (.not. is_added) return
      self%n = self%n + 1
      self%numbers(:, self%n) = [event%time, event%impact_speed, event%peak_force, event%peak_penetration, &
                                 event%duration, event%release_speed, event%energy_lost, event%impulse, &
                                 event%peak_force_time, event%peak_penetration_time]
      call encode(self, event%kind, self%codes(1, self%n))
      call encode(self, event%item, self%codes(2, self%n))
      call encode(self, event%contact, self%codes(3, self%n))
      call encode(self, event%state_before, self%codes(4, self%n))
      call encode(self, event%state_after, self%codes(5, self%n))
   end subroutine add_event

   !> Make storage for one more event.
   subroutine make_storage(self, has_capacity)
      class(event_list_t), intent(inout) :: self  !! the list
      logical, intent(out) :: has_capacity            !! false: there is no memory

      real(wp), allocatable :: numbers(:, :)
      integer, allocatable :: codes(:, :)
      integer :: capacity, status

      if (.not. allocated(self%numbers)) then
         allocate (self%numbers(n_event_numbers, 64), self%codes(n_event_words, 64))
      end if
      has_capacity = .true.
      capacity = size(self%numbers, 2)
      if (self%n < capacity) return
      allocate (numbers(n_event_numbers, 2*capacity), stat=status)
      if (status == 0) allocate (codes(n_event_words, 2*capacity), stat=status)
      has_capacity = status == 0
      if (.not. has_capacity) return
      numbers(:, 1:self%n) = self%numbers(:, 1:self%n)
      codes(:, 1:self%n) = self%codes(:, 1:self%n)
      call move_alloc(numbers, self%numbers)
      call move_alloc(codes, self%codes)
   end subroutine make_storage

   !> The number of a word, which is appended to the list of words if it is new.
   subroutine encode(self, word, code)
      class(event_list_t), intent(inout) :: self            !! the list
      character(:), allocatable, intent(in) :: word         !! a word; unallocated: blank
      integer, intent(out) :: code                          !! its number

      character(:), allocatable :: known
      integer :: previous

      known = ""
      if (allocated(word)) known = word
      call self%numbers_of_words%enter(known, self%words%n + 1, previous)
      code = previous
      if (previous > 0) return
      call self%words%add(known)
      code = self%words%n
   end subroutine encode

   !> A word of an event.
   pure function word_of_event(self, event, k) result(word)
      class(event_list_t), intent(in) :: self  !! the list
      integer, intent(in) :: event             !! number of the event
      integer, intent(in) :: k                 !! which word, as named above
      character(:), allocatable :: word        !! the word

      word = self%words%at(self%codes(k, event))
   end function word_of_event

   !> Numbers of the events in the order of their times (merge sort, stable).
   pure function order_by_onset(self) result(order)
      class(event_list_t), intent(in) :: self  !! the list
      integer, allocatable :: order(:)         !! (n) numbers of events

      integer, allocatable :: merged(:)
      integer :: at, first, left, middle, right, beyond, width

      order = [(at, at=1, self%n)]
      allocate (merged(self%n))
      width = 1
      do while (width < self%n)
         do first = 1, self%n, 2*width
            middle = min(first + width, self%n + 1)
            beyond = min(first + 2*width, self%n + 1)
            left = first
            right = middle
            do at = first, beyond - 1
               if (takes_left(left, middle, right, beyond)) then
                  merged(at) = order(left)
                  left = left + 1
               else
                  merged(at) = order(right)
                  right = right + 1
               end if
            end do
         end do
         order = merged
         width = 2*width
      end do

   contains

      !> Whether the next event comes from the left run.
      pure logical function takes_left(left, middle, right, beyond)
         integer, intent(in) :: left    !! next of the left run
         integer, intent(in) :: middle  !! end of the left run
         integer, intent(in) :: right   !! next of the right run
         integer, intent(in) :: beyond  !! end of the right run

         takes_left = right >= beyond
         if (takes_left .or. left >= middle) return
         takes_left = self%numbers(1, order(left)) <= self%numbers(1, order(right))
      end function takes_left
   end function order_by_onset

   !> Write all events.
   subroutine save_events(self, archive)
      class(event_list_t), intent(in) :: self  !! the list
      type(archive_t), intent(inout) :: archive      !! receives it

      integer :: k

      call archive%put([self%words%n, self%n])
      do k = 1, self%words%n
         call archive%put(self%words%at(k))
      end do
      do k = 1, self%n
         call archive%put(self%numbers(:, k))
         call archive%put(self%codes(:, k))
      end do
   end subroutine save_events

   !> Take them back, instead of those reported so far.
   subroutine load_events(self, archive)
      class(event_list_t), intent(inout) :: self  !! the list
      type(archive_t), intent(inout) :: archive         !! holds them

      type(event_list_t) :: fresh
      character(:), allocatable :: word
      integer :: code, k, n, n_word
      logical :: has_capacity

      call archive%get(n_word)
      call archive%get(n)
      do k = 1, n_word
         call archive%get_text(word)
         call encode(fresh, word, code)
      end do
      do k = 1, n
         call make_storage(fresh, has_capacity)
         if (.not. (has_capacity .and. archive%is_good)) return
         fresh%n = k
         call archive%get(fresh%numbers(:, k))
         call archive%get(fresh%codes(:, k))
      end do
      self%n = fresh%n
      self%words = fresh%words
      self%numbers_of_words = fresh%numbers_of_words
      if (.not. allocated(fresh%numbers)) return
      call move_alloc(fresh%numbers, self%numbers)
      call move_alloc(fresh%codes, self%codes)
   end subroutine load_events

end module event_list
