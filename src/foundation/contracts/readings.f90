!> Which values of a system's sets are read, and where they go: found once, so that a sample compares no names.
!>
!> A kind numbers its channels in `info()`. What is read of a set is a list of these numbers, each with the place of its values
!> among all values of the catalogue; of joints item by item.
module readings
   use balance_plan, only: balance_plan_t
   implicit none (type, external)
   private
   public :: reading_offer_t, reading_plan_t, reading_t, readings_t, wanted_rows_t

   !> One channel that is read.
   type :: reading_t
      integer :: code = 0    !! the channel, as `info()` of the set numbers it
      integer :: group = 0   !! group of the catalogue that its values go to
      integer :: item = 0    !! the item of the set, 0: all
      integer :: place = 0   !! values before that of the item, or of the room's first
      integer :: width = 0   !! numbers that a value has
   end type reading_t

   !> Channels that are read of one set.
   type :: readings_t
      integer :: n = 0                    !! number of channels
      integer :: most = 0                 !! maximum number of a channel
      type(reading_t), allocatable :: of(:)  !! (n or more) the channels
   contains
      procedure :: start => readings_start
      procedure :: add => readings_add
   end type readings_t

   !> Of the rows that are not solved for: those that reports need, and what these hang on.
   type :: wanted_rows_t
      integer, allocatable :: sets(:)      !! (any) sets of joints and drivers whose rows are evaluated
      integer, allocatable :: one_dof(:)    !! (any) bodies with one degree of freedom whose multipliers are found
      logical :: has_prescribed = .false.       !! whether those of the prescribed bodies are
   end type wanted_rows_t

   !> Channels of all sets of a system: those that these report, each for all items.
   type :: reading_offer_t
      type(readings_t) :: bodies                   !! of the bodies
      type(readings_t) :: energy                   !! of the ledger
      type(readings_t), allocatable :: joints(:)   !! (sets) of joints and drivers
      type(readings_t), allocatable :: ideal(:)    !! (sets) of joints with clearance taken as ideal
      type(readings_t), allocatable :: clearance_joints(:)    !! (sets) of joints with clearance
      type(readings_t), allocatable :: forces(:)   !! (sets) of force elements
      type(readings_t) :: points                   !! of points, point by point
      type(readings_t) :: motions                  !! of points as observed from elsewhere, one by one
      type(readings_t) :: reactions                !! of reactions at points, one by one
      type(readings_t) :: states                   !! of the state equations, one by one
   end type reading_offer_t

   !> Those that are read.
   !> Components: a list for each sort of item.
   type, extends(reading_offer_t) :: reading_plan_t
      type(wanted_rows_t) :: rows                  !! what they need of rows that are not solved for
      type(balance_plan_t) :: balance              !! what follows from the balance of bodies, where it does
      type(readings_t), allocatable :: others(:)   !! (sets) of joints and drivers: what does not follow from it
      integer, allocatable :: of_others(:)         !! (any) sets of them of which something is read that does not
      integer, allocatable :: of_joints(:)         !! (any) sets of joints and drivers of which something is read
      integer, allocatable :: of_clearance_joints(:)          !! (any) sets of joints with clearance of which something is read
   end type reading_plan_t

contains

   !> Storage for some channels, none yet.
   pure subroutine readings_start(self, most)
      class(readings_t), intent(inout) :: self   !! the list
      integer, intent(in) :: most                !! channels at most

      self%n = 0
      self%most = 0
      if (allocated(self%of)) deallocate (self%of)
      allocate (self%of(most))
   end subroutine readings_start

   !> Add a channel; there is storage for it.
   pure subroutine readings_add(self, code, group, item, place, width)
      class(readings_t), intent(inout) :: self   !! the list
      integer, intent(in) :: code                !! the channel
      integer, intent(in) :: group               !! its group
      integer, intent(in) :: item                !! item of the set, 0: all
      integer, intent(in) :: place               !! values before that of the item, or of the room's first
      integer, intent(in) :: width               !! numbers that a value has

      self%n = self%n + 1
      self%most = max(self%most, code)
      self%of(self%n) = reading_t(code, group, item, place, width)
   end subroutine readings_add

end module readings
