!> Loads on the bodies: gravity, force elements and what contacts add, gathered on the coordinates.
module loading
   use force_set, only: force_slot_t
   use kinds, only: wp
   use motion, only: loads_t
   implicit none (type, external)
   private
   public :: loading_t

   !> Applied loads.
   type :: loading_t
      real(wp) :: gravity(3) = 0.0_wp                !! (3) acceleration of free fall [m/s^2]
      real(wp), allocatable :: weight(:, :)          !! (3, 0:bodies) force of gravity [N]
      type(force_slot_t), allocatable :: forces(:)   !! force elements, one set per kind
      ! of the last evaluation
      type(loads_t) :: loads                         !! applied and contact loads
      real(wp), allocatable :: g(:, :)               !! (3, 0:bodies) loads on the coordinates [N, N, N.m]
      real(wp) :: power = 0.0_wp                     !! power of applied loads [W]
   end type loading_t

end module loading
