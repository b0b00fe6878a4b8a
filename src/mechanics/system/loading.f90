!> Loads on the bodies: gravity, force elements, the state equations that drive them, and what contacts add, gathered on the
!> coordinates.
module loading
   use force_set, only: force_slot_t
   use kinds, only: wp
   use motion, only: loads_t
   use state_equations, only: state_equations_t
   implicit none (type, external)
   private
   public :: loading_t, start_loads

   !> Applied loads.
   type :: loading_t
      real(wp) :: gravity(3) = 0.0_wp                !! (3) acceleration of free fall [m/s^2]
      real(wp), allocatable :: weight(:, :)          !! (3, 0:bodies) force of gravity [N]
      type(force_slot_t), allocatable :: forces(:)   !! force elements, one set per kind
      integer :: n_set = 0                           !! how many sets
      logical :: counts_turns = .false.              !! whether some of them count turns, see `step_follower`
      type(state_equations_t) :: states              !! state equations of the deck, which drive them
      ! of the last evaluation
      type(loads_t) :: loads                         !! applied and contact loads
      real(wp), allocatable :: g(:, :)               !! (n_v, 0:bodies) loads on the rates [N or N.m]
      real(wp) :: power = 0.0_wp                     !! power of applied loads [W]
   end type loading_t

contains

   !> Loads of gravity.
   pure subroutine start_loads(n, weight, force, moment)
      integer, intent(in) :: n                      !! number of bodies
      real(wp), intent(in) :: weight(3, 0:n)        !! (3, 0:n) force of gravity [N]
      real(wp), intent(out) :: force(3, 0:n)        !! (3, 0:n) forces [N]
      real(wp), intent(out) :: moment(3, 0:n)       !! (3, 0:n) moments about the centres of mass [N.m]

      integer :: k

      do k = 0, n
         force(:, k) = weight(:, k)
         moment(:, k) = 0.0_wp
      end do
   end subroutine start_loads

end module loading
