!> A table of names that finds a name again in constant time.
module name_table
   use text, only: text_t
   implicit none (type, external)
   private
   public :: name_table_t

   !> Names and the numbers that they were entered with.
   type :: name_table_t
      private
      integer, allocatable :: slot(:)           !! (power of two) entry in each slot, 0: free
      type(text_t), allocatable :: names(:)     !! (capacity) entered names
      integer, allocatable :: numbers(:)        !! (capacity) their numbers
      integer :: n = 0                          !! names entered
   contains
      procedure :: enter
      procedure :: find
      procedure :: list
      procedure :: start
   end type name_table_t

contains

   !> Empty the table and make storage for some number of names; it grows by doubling if more come.
   subroutine start(self, capacity)
      class(name_table_t), intent(inout) :: self  !! the table, emptied
      integer, intent(in) :: capacity             !! names that will be entered

      if (allocated(self%names)) deallocate (self%names, self%numbers)
      allocate (self%names(capacity), self%numbers(capacity))
      self%n = 0
      call make_slots(self)
   end subroutine start

   !> Make slots for as many names as there is storage for, and put those that are there into them.
   subroutine make_slots(table)
      class(name_table_t), intent(inout) :: table  !! the table

      integer :: k, n_slot

      n_slot = 16
      do while (n_slot < 2*size(table%names))
         n_slot = 2*n_slot
      end do
      if (allocated(table%slot)) deallocate (table%slot)
      allocate (table%slot(0:n_slot - 1), source=0)
      do k = 1, table%n
         table%slot(slot_of(table, table%names(k)%s)) = k
      end do
   end subroutine make_slots

   !> Twice the room.
   subroutine grow(table)
      class(name_table_t), intent(inout) :: table  !! the table

      type(text_t), allocatable :: names(:)
      integer, allocatable :: numbers(:)
      integer :: k

      associate (capacity => max(8, 2*table%n))
         allocate (names(capacity), numbers(capacity))
      end associate
      do k = 1, table%n
         call move_alloc(table%names(k)%s, names(k)%s)
         numbers(k) = table%numbers(k)
      end do
      call move_alloc(names, table%names)
      call move_alloc(numbers, table%numbers)
      call make_slots(table)
   end subroutine grow

   !> Enter a whole list, each name with its place in it; of equal names the first counts.
   subroutine list(self, names)
      class(name_table_t), intent(inout) :: self  !! the table, emptied
      type(text_t), intent(in) :: names(:)        !! (n) the names

      integer :: k, previous

      call self%start(size(names))
      do k = 1, size(names)
         call self%enter(names(k)%s, k, previous)
      end do
   end subroutine list

   !> Enter a name, unless it is there: then return the number it was entered with.
   subroutine enter(self, name, number, previous)
      class(name_table_t), intent(inout) :: self  !! the table
      character(*), intent(in) :: name            !! the name
      integer, intent(in) :: number               !! to be returned when it comes again
      integer, intent(out) :: previous            !! number of the same name, 0 if it is new

      integer :: at

      if (.not. allocated(self%slot)) call self%start(0)
      at = slot_of(self, name)
      previous = 0
      if (self%slot(at) > 0) then
         previous = self%numbers(self%slot(at))
         return
      end if
      if (self%n == size(self%names)) then
         call grow(self)
         at = slot_of(self, name)
      end if
      self%n = self%n + 1
      self%slot(at) = self%n
      self%names(self%n)%s = name
      self%numbers(self%n) = number
   end subroutine enter

   !> The number that a name was entered with, 0 if it is not there.
   pure integer function find(self, name) result(number)
      class(name_table_t), intent(in) :: self  !! the table
      character(*), intent(in) :: name         !! the name

      integer :: k

      number = 0
      if (self%n == 0) return
      k = self%slot(slot_of(self, name))
      if (k > 0) number = self%numbers(k)
   end function find

   !> The slot of a name: where it is, or where it would be entered.
   pure integer function slot_of(table, name) result(at)
      class(name_table_t), intent(in) :: table  !! the table
      character(*), intent(in) :: name          !! the name

      integer :: hash, i

      hash = 5381
      do i = 1, len(name)
         hash = ieor(iand(hash, 16777215)*33, iachar(name(i:i)))
      end do
      at = iand(hash, size(table%slot) - 1)
      do while (table%slot(at) > 0)
         if (table%names(table%slot(at))%s == name) return
         at = iand(at + 1, size(table%slot) - 1)
      end do
   end function slot_of

end module name_table
