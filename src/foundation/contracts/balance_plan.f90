!> What is read of bodies whose reactions follow from their own balance, and in which order these are found: bound once, so that a
!> sample searches nothing.
!>
!> See `balanced_report`. Limits: joints and drivers that hold a body alone.
module balance_plan
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: balance_plan_t, held_reading_t

   !> One quantity of a joint that holds a body, or of the driver of that joint.
   type :: held_reading_t
      integer :: code = 0               !! the quantity, as `balanced_report` numbers it
      integer :: place = 0              !! values of the catalogue before that of the item
      integer :: body = 0               !! the body that is held
      real(wp) :: sense = 0.0_wp        !! 1: what acts on this body is reported, -1: what acts on the other one [1]
      real(wp) :: pin(2) = 0.0_wp       !! (2) of a driver: the pin of its joint, frame of the body [m]
      integer :: slot = 0               !! set of the joint or driver
      integer :: item = 0               !! its item
   end type held_reading_t

   !> All of them, and the bodies whose balance is needed.
   type :: balance_plan_t
      logical :: is_set = .false.                   !! whether reactions are found this way
      integer :: n = 0                              !! number of bodies whose balance is needed
      integer, allocatable :: body(:)               !! (n) these, each before the body that it is held by
      integer, allocatable :: base(:)               !! (n) what they are held by, 0: the ground
      integer :: n_reading = 0                      !! number of quantities that are read
      type(held_reading_t), allocatable :: of(:)    !! (n_reading or more) the quantities
      real(wp), allocatable :: wrench(:, :)         !! (3, 0:bodies) scratch: what holds a body, at its centre of mass [N, N.m]
   end type balance_plan_t

end module balance_plan
