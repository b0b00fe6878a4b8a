!> Parts of a mechanism beside its linkage: clearance joints, friction that is solved for, what is reported of energies.
module mechanism_parts
   use clearance_set, only: clearance_slot_t
   use contact_places, only: event_functions_t
   use stick_slip_forces, only: stick_slip_forces_t
   use kinds, only: wp
   use rubbing, only: rubbing_t
   implicit none (type, external)
   private
   public :: friction_t, ledger_t, clearance_joints_t

   !> Clearance joints.
   type :: clearance_joints_t
      type(clearance_slot_t), allocatable :: sets(:)   !! clearance joints, one set per combination of laws
      integer :: n_set = 0                             !! how many: bounds of arrays are looked up longer
      integer :: n = 0                                 !! clearance joints in all
      integer :: n_contact = 0                         !! contacts of all of them
      logical :: has_films = .false.                   !! lubricant films act in some
      real(wp) :: film_clearance = huge(1.0_wp)        !! minimum clearance with a film [m]
      real(wp), allocatable :: integrands(:, :)        !! (3, contacts) power lost by contact and friction [W], normal force [N]
      type(event_functions_t) :: functions             !! which event functions their contacts have
   end type clearance_joints_t

   !> Friction that is solved for.
   type :: friction_t
      type(stick_slip_forces_t) :: stick_slips    !! contacts whose friction remembers
      type(rubbing_t) :: rubbing      !! ideal joints with friction
   end type friction_t

   !> What is reported of energies.
   type :: ledger_t
      logical :: is_kept = .true.         !! whether the ledger is kept
      logical :: has_energies = .true.    !! whether energies are reported, with or without a ledger
      real(wp) :: largest = 0.0_wp        !! largest energy or work so far, which errors of the ledger are measured by [J]
   end type ledger_t

end module mechanism_parts
