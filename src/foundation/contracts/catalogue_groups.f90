!> Groups of the catalogue: one quantity of all the items of a group, and a list of them that grows.
module catalogue_groups
   use kind_info, only: channel_t
   implicit none (type, external)
   private
   public :: group_t, resize_groups

   !> One quantity of all the items of a group.
   type :: group_t
      integer :: item_group = 0                     !! group of items, one of the above
      type(channel_t) :: channel              !! name, SI unit, frame, components and long name
      logical, allocatable :: has(:)          !! (items) which of them have the channel
      logical, allocatable :: is_wanted(:)    !! (items) whose value someone reads; others may not be found
      integer :: before = 0                   !! numbers before its own in `values`: all components of its first item, of its second
   end type group_t

contains

   !> Give the quantities another number of places, and keep them.
   subroutine resize_groups(groups, n, places)
      type(group_t), allocatable, intent(inout) :: groups(:)  !! (any) the quantities
      integer, intent(in) :: n                                !! number of quantities
      integer, intent(in) :: places                           !! as many as there are quantities, or more

      type(group_t), allocatable :: moved(:)
      integer :: k

      allocate (moved(places))
      do k = 1, n
         call take_over(groups(k), moved(k))
      end do
      call move_alloc(moved, groups)
   end subroutine resize_groups

   !> A quantity to another place.
   subroutine take_over(from, to)
      type(group_t), intent(inout) :: from  !! the quantity; afterwards without texts and values
      type(group_t), intent(inout) :: to    !! the same

      to%item_group = from%item_group
      to%channel%components = from%channel%components
      to%channel%code = from%channel%code
      call move_alloc(from%channel%name, to%channel%name)
      call move_alloc(from%channel%unit, to%channel%unit)
      call move_alloc(from%channel%frame, to%channel%frame)
      call move_alloc(from%channel%help, to%channel%help)
      call move_alloc(from%has, to%has)
      call move_alloc(from%is_wanted, to%is_wanted)
      to%before = from%before
   end subroutine take_over

end module catalogue_groups
