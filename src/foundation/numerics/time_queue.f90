!> A queue of numbered things by time: the earliest comes first, those of the same time together, by number.
module time_queue
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: time_queue_t

   !> A binary heap: no entry is earlier than that at half its place.
   type :: time_queue_t
      private
      integer :: n = 0                       !! entries
      real(wp), allocatable :: time(:)       !! (capacity) time of each [s]
      integer, allocatable :: number(:)      !! (capacity) its number
   contains
      procedure :: start => queue_start
      procedure :: add => queue_add
      procedure :: take_first => queue_take_first
   end type time_queue_t

contains

   !> Empty the queue, and make storage.
   subroutine queue_start(self, capacity)
      class(time_queue_t), intent(inout) :: self   !! the queue, emptied
      integer, intent(in) :: capacity              !! most entries at a time

      self%n = 0
      if (allocated(self%time)) deallocate (self%time, self%number)
      allocate (self%time(capacity), source=0.0_wp)
      allocate (self%number(capacity), source=0)
   end subroutine queue_start

   !> Add a thing. There must be room.
   pure subroutine queue_add(self, time, number)
      class(time_queue_t), intent(inout) :: self   !! the queue
      real(wp), intent(in) :: time                 !! its time [s]
      integer, intent(in) :: number                !! its number

      integer :: place

      self%n = self%n + 1
      place = self%n
      do while (place > 1)
         if (.not. is_before(time, number, self%time(place/2), self%number(place/2))) exit
         self%time(place) = self%time(place/2)
         self%number(place) = self%number(place/2)
         place = place/2
      end do
      self%time(place) = time
      self%number(place) = number
   end subroutine queue_add

   !> Take the earliest things out: all of the same time. The queue must not be empty.
   pure subroutine queue_take_first(self, time, numbers, n)
      class(time_queue_t), intent(inout) :: self   !! the queue
      real(wp), intent(out) :: time                !! their time [s]
      integer, intent(inout) :: numbers(:)         !! (capacity) their numbers, increasing
      integer, intent(out) :: n                    !! how many

      time = self%time(1)
      n = 0
      do while (self%n > 0)
         if (self%time(1) > time) exit
         n = n + 1
         numbers(n) = self%number(1)
         call drop_first(self)
      end do
   end subroutine queue_take_first

   !> Drop the first entry.
   pure subroutine drop_first(self)
      type(time_queue_t), intent(inout) :: self   !! the queue

      integer :: next, place

      associate (time => self%time(self%n), number => self%number(self%n))
         self%n = self%n - 1
         place = 1
         do
            next = 2*place
            if (next > self%n) exit
            if (next < self%n) then
               if (is_before(self%time(next + 1), self%number(next + 1), self%time(next), self%number(next))) next = next + 1
            end if
            if (.not. is_before(self%time(next), self%number(next), time, number)) exit
            self%time(place) = self%time(next)
            self%number(place) = self%number(next)
            place = next
         end do
         self%time(place) = time
         self%number(place) = number
      end associate
   end subroutine drop_first

   !> Whether one entry comes before another.
   pure logical function is_before(time_a, number_a, time_b, number_b)
      real(wp), intent(in) :: time_a, time_b      !! their times [s]
      integer, intent(in) :: number_a, number_b   !! their numbers

      is_before = time_a < time_b .or. (time_a <= time_b .and. number_a < number_b)
   end function is_before

end module time_queue
