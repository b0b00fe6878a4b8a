!> What is negligible, and what stands in where a law or a scale would be divided by it.
!>
!> Every such number is a part of something that the scene itself has: of the mechanism's own speed (its characteristic rate times
!> its size, see `mechanism_scales`), of a step, of the time or the depth of a contact. None is a speed, a length, a time or a force
!> of its own, so
!> that small and slow mechanisms are computed as large and fast ones are. `gudgeon explain` and the manual print this list.
module floors
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: all_floors, floor_t
   public :: for_adaptive, for_all, for_contacts, for_sticking
   public :: of_acceleration, of_contact, of_mobility, of_pace, of_run, of_speed, of_step, of_time, of_tolerance
   public :: at_rest, captured, chatter_time, contact_lever, gentle, idle_part, late, min_band, min_stabilisation, min_mobility, &
      look_ahead, no_acceleration, remembered, settling, shortest_difference, standstill, torn, widest_band

   integer, parameter :: of_speed = 1         !! of the mechanism's own speed, characteristic rate times size
   integer, parameter :: of_pace = 2          !! of its characteristic rate
   integer, parameter :: of_step = 3          !! of the step in hand
   integer, parameter :: of_contact = 4       !! of what a contact has itself
   integer, parameter :: of_acceleration = 5  !! of the acceleration that the normal force would give
   integer, parameter :: of_mobility = 6      !! of what the bodies would yield if they were free
   integer, parameter :: of_run = 7           !! of size and duration of the run
   integer, parameter :: of_time = 8          !! of the spacing of numbers at the present time
   integer, parameter :: of_tolerance = 9     !! of the tolerance times the mechanism's own speed

   integer, parameter :: for_all = 0          !! any model needs it
   integer, parameter :: for_contacts = 1     !! joints with clearance
   integer, parameter :: for_sticking = 2     !! contacts whose friction law sticks
   integer, parameter :: for_adaptive = 3     !! stabilise = baumgarte_adaptive

   ! contacts
   real(wp), parameter :: gentle = 0.1_wp                 !! impact speed in damping terms at least, of the speed of the depth [1]
   ! error scales
   real(wp), parameter :: remembered = 0.01_wp  !! rate that errors are measured by at least, of the characteristic rate [1]
   real(wp), parameter :: late = 1.0e-2_wp                !! rate that errors are measured by at least, of 1/duration of the run [1]
   real(wp), parameter :: idle_part = 1.0e-6_wp           !! way in a run at least, for the characteristic rate, of the size [1]
   real(wp), parameter :: shortest_difference = 1.0e4_wp  !! time of a difference at least, of the spacing of time [1]
   ! holding the constraints
   real(wp), parameter :: min_stabilisation = 0.1_wp  !! gain that follows the violation at least, of the characteristic rate [1]
   ! friction that sticks
   real(wp), parameter :: at_rest = 1.0e-9_wp             !! sliding velocity that is none, of the speed [1]
   real(wp), parameter :: standstill = 1.0e-15_wp         !! sliding velocity at which slip ends, of the speed [1]
   real(wp), parameter :: captured = 2.0_wp               !! in space: the same, of the tolerance times the speed [1]
   real(wp), parameter :: contact_lever = 2.0_wp          !! lever within a contact, of its penetration [1]
   real(wp), parameter :: torn = 1.0e-4_wp                !! sliding velocity that ends sticking, of the speed [1]
   real(wp), parameter :: min_band = 1.0e-12_wp         !! first velocity the wrong way after a chatter, of the speed [1]
   real(wp), parameter :: widest_band = 1.0e-5_wp         !! last one; in space also slip that is slow, of the speed [1]
   real(wp), parameter :: settling = 10.0_wp              !! decay of a sliding velocity left over, of the characteristic rate [1]
   real(wp), parameter :: chatter_time = 1.0e-2_wp        !! time between decisions that is chatter, of the contact's own [1]
   real(wp), parameter :: look_ahead = 1.0e-2_wp          !! how far ahead a driven contact at rest is looked at, of the step [1]
   real(wp), parameter :: no_acceleration = 1.0e-12_wp    !! sliding acceleration that is none, of what F_N would give [1]
   real(wp), parameter :: min_mobility = 1.0e-11_wp     !! mobility that is none: of that of free bodies [1]

   !> One of them.
   type :: floor_t
      real(wp) :: part = 0.0_wp             !! the number [1]
      integer :: of = 0                     !! of what, one of the above
      integer :: needed = for_all           !! by what, one of the above
      character(96) :: meaning = ""         !! what it is for
   end type floor_t

contains

   !> The list.
   pure function all_floors() result(list)
      type(floor_t), allocatable :: list(:)  !! (floors) in the order of the groups

      list = [floor_t(gentle, of_contact, for_contacts, "minimum impact speed in damping terms, over sqrt(F_N penetration/m)"), &
              floor_t(remembered, of_speed, for_all, "minimum speed that velocity errors are relative to, in slow motion"), &
              floor_t(late, of_run, for_all, "minimum speed that velocity errors are relative to, from rest"), &
              floor_t(idle_part, of_run, for_all, "characteristic speed of a mechanism that never moves"), &
              floor_t(min_stabilisation, of_pace, for_adaptive, "minimum gain of stabilise = baumgarte_adaptive"), &
              floor_t(at_rest, of_speed, for_sticking, "negligible sliding speed, at onset and where drivers prescribe it"), &
              floor_t(standstill, of_speed, for_sticking, "sliding speed at the slip-to-stick transition"), &
              floor_t(captured, of_tolerance, for_sticking, "sliding speed at the slip-to-stick transition, in space"), &
              floor_t(contact_lever, of_contact, for_contacts, &
                      "lever arm of a turn that friction does not hold, over the penetration"), &
              floor_t(torn, of_speed, for_sticking, "drift speed of a sticking contact at which sticking ends"), &
              floor_t(min_band, of_speed, for_sticking, &
                      "tolerated speed of slip against its direction, after stick-slip chatter, initial"), &
              floor_t(widest_band, of_speed, for_sticking, &
                      "tolerated speed of slip against its direction, final; in space also speed of slow slip"), &
              floor_t(settling, of_pace, for_sticking, &
                      "decay rate of residual sliding while sticking, or sqrt(F_N/(penetration m)) if that is greater"), &
              floor_t(chatter_time, of_contact, for_sticking, &
                      "stick-slip interval that counts as chatter, over sqrt(penetration m/F_N)"), &
              floor_t(look_ahead, of_step, for_sticking, "look-ahead time for the motion that drivers give a contact at rest"), &
              floor_t(no_acceleration, of_acceleration, for_sticking, "negligible sliding acceleration"), &
              floor_t(min_mobility, of_mobility, for_sticking, "mobility of a contact that counts as immovable"), &
              floor_t(shortest_difference, of_time, for_contacts, "time difference for the rates of event functions")]
   end function all_floors

end module floors
