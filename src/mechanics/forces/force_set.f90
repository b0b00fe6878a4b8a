!> The contract of force elements: all the items of one kind, evaluated by one call.
!>
!> Signs: a load is what acts on the body named in the row, world frame. The power that all its loads give to the
!> bodies is `power` of `evaluate`, less `lost_power`, less the rate of `elastic_energy`.
module force_set
   use archive, only: archive_t
   use bodies, only: points_t
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use text, only: text_t
   implicit none (type, external)
   private
   public :: force_set_t, force_slot_t

   !> All items of one kind of force element.
   type, abstract :: force_set_t
      integer :: n = 0                         !! number of items
      type(text_t), allocatable :: names(:)    !! (n) names
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure, nopass :: mistake => force_mistake
      procedure(prepare_interface), deferred :: prepare
      procedure(evaluate_interface), deferred :: evaluate
      procedure(report_interface), deferred :: report
      procedure(bodies_interface), deferred :: bodies_of
      procedure :: set_start => force_set_start
      procedure :: follow => force_follow
      procedure :: doubt => force_doubt
      procedure :: elastic_energy => force_elastic_energy
      procedure :: lost_power => force_lost_power
      procedure :: load_on => force_load_on
      procedure, nopass :: memory_version => force_memory_version
      procedure :: save => force_save
      procedure :: load => force_load
   end type force_set_t

   !> A place for a set of any kind.
   type :: force_slot_t
      class(force_set_t), allocatable :: set  !! the set
   end type force_slot_t

   abstract interface
      !> Description of the kind.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name, columns and channels
      end function info_interface

      !> Make the set from the rows of its table, whose references have been resolved.
      subroutine prepare_interface(self, items, points)
         import :: force_set_t, item_t, points_t
         implicit none (type, external)
         class(force_set_t), intent(inout) :: self  !! the set
         type(item_t), intent(in) :: items(:)       !! (n) rows of the table
         type(points_t), intent(in) :: points       !! all points
      end subroutine prepare_interface

      !> Add the loads of all items, and the power of those that neither store nor lose it. No allocation.
      subroutine evaluate_interface(self, t, motion, loads, power)
         import :: force_set_t, loads_t, motion_t, wp
         implicit none (type, external)
         class(force_set_t), intent(in) :: self  !! the set
         real(wp), intent(in) :: t               !! time [s]
         type(motion_t), intent(in) :: motion    !! positions and velocities
         type(loads_t), intent(inout) :: loads   !! loads on the bodies, added to
         real(wp), intent(inout) :: power        !! power given to the mechanism, added to [W]
      end subroutine evaluate_interface

      !> Values of a channel for all items.
      subroutine report_interface(self, code, t, motion, values)
         import :: force_set_t, motion_t, wp
         implicit none (type, external)
         class(force_set_t), intent(in) :: self     !! the set
         integer, intent(in) :: code                !! the channel, as `info` numbers it
         real(wp), intent(in) :: t                  !! time [s]
         type(motion_t), intent(in) :: motion       !! positions and velocities
         real(wp), intent(inout) :: values(:, :)    !! (components, n) values; left alone if not of this kind [any]
      end subroutine report_interface

      !> The bodies that an item acts on; its loads depend on the motion of no others.
      pure function bodies_interface(self, i) result(bodies)
         import :: force_set_t
         implicit none (type, external)
         class(force_set_t), intent(in) :: self  !! the set
         integer, intent(in) :: i                !! number of the item
         integer :: bodies(2)                    !! both, 0: ground, or none
      end function bodies_interface
   end interface

contains

   !> What is wrong with a row as a whole: nothing, unless the kind says otherwise.
   subroutine force_mistake(item, column, message, help)
      type(item_t), intent(in) :: item                       !! the row
      integer, intent(out) :: column                         !! column at fault, 0: all is well
      character(:), allocatable, intent(out) :: message      !! what is wrong
      character(:), allocatable, intent(out) :: help         !! what would be right

      column = 0
      message = repeat("", len(item%name))
      help = ""
   end subroutine force_mistake

   !> Take what the deck omits from where it puts the bodies at the start: nothing, unless the kind says otherwise.
   subroutine force_set_start(self, motion)
      class(force_set_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion       !! bodies where the deck puts them
   end subroutine force_set_start

   !> A step has ended: what counts turns continues from here.
   subroutine force_follow(self, motion)
      class(force_set_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion       !! positions
   end subroutine force_follow

   !> What of an item did not fit the motion so far: what follows its name in a warning. In none, unless the kind says otherwise.
   function force_doubt(self, k) result(doubt)
      class(force_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      character(:), allocatable :: doubt      !! what does not match; blank: nothing

      doubt = repeat("", self%n + k)
   end function force_doubt

   !> Energy that the elements store: none, unless the kind says otherwise. No allocation.
   pure real(wp) function force_elastic_energy(self, motion) result(energy)
      class(force_set_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion    !! positions

      energy = 0.0_wp*size(motion%angle)*self%n
   end function force_elastic_energy

   !> Power that the elements turn into heat, none, unless the kind says otherwise. No allocation.
   pure real(wp) function force_lost_power(self, motion) result(power)
      class(force_set_t), intent(in) :: self  !! the set
      type(motion_t), intent(in) :: motion    !! positions and velocities

      power = 0.0_wp*size(motion%angle)*self%n
   end function force_lost_power

   !> Load of an item on one of its two bodies, as `bodies_of` orders them: none, unless the kind says otherwise. Statics measures
   !> residuals by it. No allocation.
   subroutine force_load_on(self, k, side, t, motion, force, moment, place)
      class(force_set_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                !! item
      integer, intent(in) :: side             !! 1: on the body of i, 2: on that of j
      real(wp), intent(in) :: t               !! time [s]
      type(motion_t), intent(in) :: motion    !! positions and velocities
      real(wp), intent(out) :: force(3)       !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)      !! (3) about the place, world frame [N.m]
      real(wp), intent(out) :: place(3)       !! (3) where it is reported, world frame [m]

      force = 0.0_wp
      moment = 0.0_wp
      place = motion%r(:, 0)
   end subroutine force_load_on

   !> Version of the form of what the set saves; a kind that changes it says so.
   pure integer function force_memory_version() result(version)
      version = 1
   end function force_memory_version

   !> Write what the set remembers.
   subroutine force_save(self, archive)
      class(force_set_t), intent(in) :: self     !! the set
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine force_save

   !> Read what the set remembers.
   subroutine force_load(self, archive)
      class(force_set_t), intent(inout) :: self  !! the set
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine force_load

end module force_set
