!> What a set of clearance joints consists of: what its geometry is like, its items, and the laws of their contacts.
module clearance_parts
   use bearing_films, only: bearing_films_t
   use friction_law, only: friction_law_t
   use kinds, only: wp
   use normal_law, only: normal_law_t
   use surfaces, only: surfaces_t
   use wear_law, only: wear_law_t
   implicit none (type, external)
   private
   public :: clearance_items_t, clearance_laws_t, clearance_traits_t

   !> What a geometry is like.
   type :: clearance_traits_t
      logical :: is_round = .false.       !! the clearance is a radial one
      logical :: is_gap = .false.         !! the clearance is the gap between flat surfaces
      logical :: has_faces = .false.      !! contacts of an item share a face, and what it stores
      logical :: is_worn = .false.        !! surfaces of some items have profiles
      logical :: energy_jumps = .false.   !! stored energy and forces may jump where a contact starts or ends
   end type clearance_traits_t

   !> Items of a geometry: where they are, and their surfaces.
   type :: clearance_items_t
      integer, allocatable :: body(:, :)          !! (2, n) bodies of bearing and journal, 0: ground
      real(wp), allocatable :: s_i(:, :)          !! (3, n) centre of the bearing, frame of its body [m]
      real(wp), allocatable :: s_j(:, :)          !! (3, n) centre of the journal, frame of its body [m]
      integer, allocatable :: free(:)             !! (n) of items tied by a joint: what that leaves, see `kind_info`
      real(wp), allocatable :: slide_axis(:, :)   !! (2, n) and the axis of one that slides, frame of i [1]
      type(surfaces_t), allocatable :: pairs(:)   !! (n) the surfaces
   end type clearance_items_t

   !> Laws of all items of a set.
   type :: clearance_laws_t
      real(wp), allocatable :: parameters(:, :)        !! (n_law_parameter, n_contact) of the normal law, fitted to them [any]
      class(normal_law_t), allocatable :: normal       !! normal law of all items
      class(normal_law_t), allocatable :: face         !! normal law of faces, where the geometry has some; unallocated: none
      class(friction_law_t), allocatable :: friction   !! friction law of all items; unallocated: none
      class(wear_law_t), allocatable :: wear           !! wear law of all items; unallocated: surfaces stay as they are
      class(bearing_films_t), allocatable :: films     !! lubricant films of the items; unallocated: none
   end type clearance_laws_t

end module clearance_parts
