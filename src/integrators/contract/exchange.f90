!> Arrays that change places without being copied.
module exchange
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: swap

   !> Two arrays change places.
   interface swap
      module procedure swap_reals, swap_columns, swap_integers, swap_logicals
   end interface swap

contains

   pure subroutine swap_reals(a, b)
      real(wp), allocatable, intent(inout) :: a(:)   !! (any) one [any]
      real(wp), allocatable, intent(inout) :: b(:)   !! (any) the other [any]

      real(wp), allocatable :: other(:)

      call move_alloc(a, other)
      call move_alloc(b, a)
      call move_alloc(other, b)
   end subroutine swap_reals

   pure subroutine swap_columns(a, b)
      real(wp), allocatable, intent(inout) :: a(:, :)   !! (any, any) one [any]
      real(wp), allocatable, intent(inout) :: b(:, :)   !! (any, any) the other [any]

      real(wp), allocatable :: other(:, :)

      call move_alloc(a, other)
      call move_alloc(b, a)
      call move_alloc(other, b)
   end subroutine swap_columns

   pure subroutine swap_integers(a, b)
      integer, allocatable, intent(inout) :: a(:)   !! (any) one
      integer, allocatable, intent(inout) :: b(:)   !! (any) the other

      integer, allocatable :: other(:)

      call move_alloc(a, other)
      call move_alloc(b, a)
      call move_alloc(other, b)
   end subroutine swap_integers

   pure subroutine swap_logicals(a, b)
      logical, allocatable, intent(inout) :: a(:)   !! (any) one
      logical, allocatable, intent(inout) :: b(:)   !! (any) the other

      logical, allocatable :: other(:)

      call move_alloc(a, other)
      call move_alloc(b, a)
      call move_alloc(other, b)
   end subroutine swap_logicals

end module exchange
