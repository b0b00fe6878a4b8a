!> Rooms of the catalogue: the items of each sort (bodies, joints, ...), their names and where they stand in the output file.
module groups_of_catalogue
   use kinds, only: wp
   use text, only: text_t
   implicit none (type, external)
   private
   public :: add_to_group, has_channel, resize_storage, group_paths, item_group_t
   public :: n_groups, group_bodies, group_clearances, group_contacts, group_drivers, group_energy, group_forces, group_joints
   public :: group_motions, group_points, group_reactions, group_requests, group_states

   integer, parameter :: group_bodies = 1      !! bodies, in deck order, without the ground
   integer, parameter :: group_joints = 2      !! ideal joints
   integer, parameter :: group_drivers = 3     !! drivers
   integer, parameter :: group_clearances = 4  !! joints with clearance
   integer, parameter :: group_contacts = 5    !! possible contacts of the joints with clearance
   integer, parameter :: group_forces = 6      !! force elements
   integer, parameter :: group_energy = 7      !! the energy ledger: one item without a name
   integer, parameter :: group_points = 8      !! points of the deck
   integer, parameter :: group_motions = 9     !! points as observed from elsewhere
   integer, parameter :: group_reactions = 10  !! reactions at points
   integer, parameter :: group_requests = 11   !! expressions over channels: one item, a group of its own for each
   integer, parameter :: group_states = 12     !! state equations: one item, a group of its own for each row
   integer, parameter :: n_groups = 12         !! number of groups

   !> (n_item_groups) groups of the output file, in the order of the groups
   character(*), parameter :: group_paths(n_groups) = [character(19) :: "bodies", "joints", "drivers", "clearances", &
                                                     "clearances/contacts", "forces", "energy", "points", "motions", &
                                                     "reactions", "requests", "states"]

   !> The items of one sort.
   type :: item_group_t
      integer :: n = 0                         !! number of items
      character(:), allocatable :: name        !! path in the output file: bodies, joints, clearances/contacts ...
      type(text_t), allocatable :: names(:)    !! (items) name of each item; of a contact: its joint's
      type(text_t), allocatable :: labels(:)   !! (items) of contacts: label within the joint; else blank
      real(wp), allocatable :: radius(:)       !! (items) of clearances: radial clearance; else 0 [m]
      type(text_t), allocatable :: channels(:) !! (items) " name name " of the channels it has; empty: all of the group's
   end type item_group_t

contains

   !> Add an item to a group.
   subroutine add_to_group(item_group, name, label, radius, channels)
      type(item_group_t), intent(inout) :: item_group              !! the group
      character(*), intent(in) :: name                 !! its name
      character(*), intent(in), optional :: label      !! of a contact: label within the joint
      real(wp), intent(in), optional :: radius         !! of a clearance joint: radial clearance [m]
      character(*), intent(in), optional :: channels   !! present: it has only these, see `names_of_channels`

      if (.not. allocated(item_group%names)) call resize_storage(item_group, 8)
      if (item_group%n == size(item_group%names)) call resize_storage(item_group, 2*item_group%n)
      item_group%n = item_group%n + 1
      item_group%names(item_group%n)%s = name
      item_group%labels(item_group%n)%s = ""
      if (present(label)) item_group%labels(item_group%n)%s = label
      item_group%radius(item_group%n) = 0.0_wp
      if (present(radius)) item_group%radius(item_group%n) = radius
      item_group%channels(item_group%n)%s = ""
      if (present(channels)) item_group%channels(item_group%n)%s = channels
   end subroutine add_to_group

   !> Give a group another number of places, and keep its items.
   subroutine resize_storage(item_group, places)
      type(item_group_t), intent(inout) :: item_group  !! the group
      integer, intent(in) :: places        !! as many as it has items, or more

      type(text_t), allocatable :: channels(:), names(:), labels(:)
      real(wp), allocatable :: radius(:)
      integer :: k

      allocate (names(places), labels(places), channels(places))
      allocate (radius(places), source=0.0_wp)
      do k = 1, item_group%n
         call move_alloc(item_group%names(k)%s, names(k)%s)
         call move_alloc(item_group%labels(k)%s, labels(k)%s)
         call move_alloc(item_group%channels(k)%s, channels(k)%s)
         radius(k) = item_group%radius(k)
      end do
      call move_alloc(names, item_group%names)
      call move_alloc(labels, item_group%labels)
      call move_alloc(channels, item_group%channels)
      call move_alloc(radius, item_group%radius)
   end subroutine resize_storage

   !> Whether an item of a group has a channel: it names its own, or has all of the group's.
   pure logical function has_channel(item_group, channel, item) result(has)
      type(item_group_t), intent(in) :: item_group        !! the group
      character(*), intent(in) :: channel     !! name of the channel between blanks
      integer, intent(in) :: item             !! number of the item

      has = len(item_group%channels(item)%s) == 0
      if (.not. has) has = index(item_group%channels(item)%s, channel) > 0
   end function has_channel

end module groups_of_catalogue
