!> All events of a run, compactly: ten numbers and the number of its words, 84 bytes, in blocks that are never moved.
!>
!> Contacts are reported when they end; `order_by_onset` gives the order in time. Equal times keep the
!> order in which they were reported.
module event_list
   use kinds, only: wp
   use recorder, only: event_t
   use name_table, only: name_table_t
   use archive, only: archive_t
   use text, only: join, text_t
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

   integer, parameter :: events_of_block = 1024  !! events that get their storage at once

   !> Some of the events.
   type :: event_block_t
      real(wp), allocatable :: numbers(:, :)      !! (10, events_of_block) as named above, SI [any]
      integer, allocatable :: wording(:)          !! (events_of_block) numbers of their words
   end type event_block_t

   !> The events reported so far.
   type :: event_list_t
      integer :: n = 0                                       !! number of events
      type(event_block_t), allocatable, private :: blocks(:) !! (any) all but the last of them in use are full
      type(text_list_t), private :: words                    !! five of each wording
      type(name_table_t), private :: wordings                !! number of each, by its words
   contains
      procedure :: add => add_event
      procedure :: numbers => numbers_of_event
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

      type(text_t) :: words(n_event_words)

      words(1)%s = known(event%kind)
      words(2)%s = known(event%item)
      words(3)%s = known(event%contact)
      words(4)%s = known(event%state_before)
      words(5)%s = known(event%state_after)
      call append(self, [event%time, event%impact_speed, event%peak_force, event%peak_penetration, event%duration, &
                         event%release_speed, event%energy_lost, event%impulse, event%peak_force_time, &
                         event%peak_penetration_time], wording_of(self, words), is_added)
   end subroutine add_event

   !> A word; blank if it is not allocated.
   pure function known(word)
      character(:), allocatable, intent(in) :: word  !! the word
      character(:), allocatable :: known             !! the same

      known = ""
      if (allocated(word)) known = word
   end function known

   !> Append an event.
   subroutine append(self, numbers, wording, is_added)
      class(event_list_t), intent(inout) :: self      !! the list
      real(wp), intent(in) :: numbers(:)              !! (10) as named above, SI [any]
      integer, intent(in) :: wording                  !! number of its words
      logical, intent(out) :: is_added                !! false: there is no memory for it

      integer :: at, block

      block = self%n/events_of_block + 1
      at = mod(self%n, events_of_block) + 1
      call make_storage(self, block, is_added)
      if (.not. is_added) return
      self%blocks(block)%numbers(:, at) = numbers
      self%blocks(block)%wording(at) = wording
      self%n = self%n + 1
   end subroutine append

   !> Make storage for a block of events.
   subroutine make_storage(self, block, has_capacity)
      class(event_list_t), intent(inout) :: self  !! the list
      integer, intent(in) :: block                !! number of the block
      logical, intent(out) :: has_capacity        !! false: there is no memory

      type(event_block_t), allocatable :: blocks(:)
      integer :: k, status

      if (.not. allocated(self%blocks)) allocate (self%blocks(16))
      status = 0
      if (block > size(self%blocks)) then
         allocate (blocks(2*size(self%blocks)), stat=status)
         if (status == 0) then
            do k = 1, size(self%blocks)
               call move_alloc(self%blocks(k)%numbers, blocks(k)%numbers)
               call move_alloc(self%blocks(k)%wording, blocks(k)%wording)
            end do
            call move_alloc(blocks, self%blocks)
         end if
      end if
      has_capacity = status == 0
      if (.not. has_capacity) return
      associate (this => self%blocks(block))
         if (.not. allocated(this%numbers)) allocate (this%numbers(n_event_numbers, events_of_block), stat=status)
         if (status == 0 .and. .not. allocated(this%wording)) allocate (this%wording(events_of_block), stat=status)
      end associate
      has_capacity = status == 0
   end subroutine make_storage

   !> The number of the words of an event, which are appended to the list of words if they are new.
   integer function wording_of(self, words) result(wording)
      class(event_list_t), intent(inout) :: self            !! the list
      type(text_t), intent(in) :: words(:)                  !! (5) the words

      integer :: k

      associate (next => self%words%n/n_event_words + 1)
         call self%wordings%enter(join(words, achar(0)), next, wording)
         if (wording > 0) return
         wording = next
      end associate
      do k = 1, n_event_words
         call self%words%add(words(k)%s)
      end do
   end function wording_of

   !> The numbers of an event.
   pure function numbers_of_event(self, event) result(numbers)
      class(event_list_t), intent(in) :: self  !! the list
      integer, intent(in) :: event             !! number of the event
      real(wp) :: numbers(n_event_numbers)     !! (10) as named above, SI [any]

      numbers = self%blocks((event - 1)/events_of_block + 1)%numbers(:, mod(event - 1, events_of_block) + 1)
   end function numbers_of_event

   !> A word of an event.
   pure function word_of_event(self, event, k) result(word)
      class(event_list_t), intent(in) :: self  !! the list
      integer, intent(in) :: event             !! number of the event
      integer, intent(in) :: k                 !! which word, as named above
      character(:), allocatable :: word        !! the word

      associate (wording => self%blocks((event - 1)/events_of_block + 1)%wording(mod(event - 1, events_of_block) + 1))
         word = self%words%at(n_event_words*(wording - 1) + k)
      end associate
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
         takes_left = onset(order(left)) <= onset(order(right))
      end function takes_left

      !> The time of an event.
      pure real(wp) function onset(event)
         integer, intent(in) :: event   !! its number

         onset = self%blocks((event - 1)/events_of_block + 1)%numbers(1, mod(event - 1, events_of_block) + 1)
      end function onset
   end function order_by_onset

   !> Write all events.
   subroutine save_events(self, archive)
      class(event_list_t), intent(in) :: self  !! the list
      type(archive_t), intent(inout) :: archive      !! receives it

      integer :: at, block, k

      call archive%put([self%words%n, self%n])
      do k = 1, self%words%n
         call archive%put(self%words%at(k))
      end do
      call archive%reserve((n_event_numbers + 1)*self%n)
      do k = 1, self%n
         block = (k - 1)/events_of_block + 1
         at = mod(k - 1, events_of_block) + 1
         call archive%put(self%blocks(block)%numbers(:, at))
         call archive%put(self%blocks(block)%wording(at))
      end do
   end subroutine save_events

   !> Take them back, instead of those reported so far.
   subroutine load_events(self, archive)
      class(event_list_t), intent(inout) :: self  !! the list
      type(archive_t), intent(inout) :: archive         !! holds them

      type(event_list_t) :: fresh
      type(text_t) :: words(n_event_words)
      real(wp) :: numbers(n_event_numbers)
      integer :: i, k, n, n_word, wording
      logical :: is_added

      call archive%get(n_word)
      call archive%get(n)
      do k = 1, n_word/n_event_words
         do i = 1, n_event_words
            call archive%get_text(words(i)%s)
         end do
         wording = wording_of(fresh, words)
      end do
      do k = 1, n
         call archive%get(numbers)
         call archive%get(wording)
         call append(fresh, numbers, wording, is_added)
         if (.not. (is_added .and. archive%is_good)) return
      end do
      self%n = fresh%n
      self%words = fresh%words
      self%wordings = fresh%wordings
      if (allocated(fresh%blocks)) call move_alloc(fresh%blocks, self%blocks)
   end subroutine load_events

end module event_list
