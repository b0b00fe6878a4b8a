!> Groups of the catalogue: one quantity of all the items of a group, and a list of them that grows.
module catalogue_groups
   use groups_of_catalogue, only: group_contacts, group_joints, group_requests
   use kind_info, only: channel_t
   implicit none (type, external)
   private
   public :: goes_round, group_t, resize_groups

   !> One quantity of all the items of a group.
   type :: group_t
      integer :: item_group = 0                     !! group of items, one of the above
      type(channel_t) :: channel              !! name, SI unit, frame, components and long name
      logical, allocatable :: has(:)          !! (items) which of them have the channel
      logical, allocatable :: is_wanted(:)    !! (items) whose value someone reads; others may not be found
      integer :: vector = 0                   !! of a magnitude: group of its vector; 0: it is none
      integer :: before = 0                   !! numbers before its own in `values`: all components of its first item, of its second
   end type group_t

contains

   !> Whether a quantity is an angle that jumps from pi to -pi, or may: that of a request.
   pure logical function goes_round(group)
      type(group_t), intent(in) :: group   !! the quantity

      character(*), parameter :: of_joints = " angle angle_i angle_j "   ! other angles are accumulated over revolutions

      goes_round = group%channel%unit == "rad"
      if (.not. goes_round) return
      select case (group%item_group)
      case (group_contacts); goes_round = group%channel%name == "contact_angle"
      case (group_joints); goes_round = index(of_joints, " "//group%channel%name//" ") > 0
      case default; goes_round = group%item_group == group_requests
      end select
   end function goes_round

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
      to%vector = from%vector
      to%before = from%before
   end subroutine take_over

end module catalogue_groups
