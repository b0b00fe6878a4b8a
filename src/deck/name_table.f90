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

   !> Make room for some number of names.
   subroutine start(self, capacity)
      class(name_table_t), intent(inout) :: self  !! the table, emptied
      integer, intent(in) :: capacity             !! most names that will be entered

      integer :: n_slot

      n_slot = 16
      do while (n_slot < 2*capacity)
         n_slot = 2*n_slot
      end do
      if (allocated(self%slot)) deallocate (self%slot, self%names, self%numbers)
      allocate (self%slot(0:n_slot - 1), self%names(capacity), self%numbers(capacity))
      self%slot = 0
      self%n = 0
   end subroutine start

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

      at = slot_of(self, name)
      previous = 0
      if (self%slot(at) > 0) then
         previous = self%numbers(self%slot(at))
         return
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
