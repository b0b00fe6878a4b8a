!> What a life is asked, and what came of it.
module life_results
   use kinds, only: wp
   use life_state, only: life_state_t
   implicit none (type, external)
   private
   public :: life_ends_t, life_plan_t, life_t, node_t

   !> A condition on the extreme of a channel.
   type :: extreme_t
      character(:), allocatable :: words   !! as in the deck
      integer :: place(3) = 0              !! (3) group, component and item of the channel in the catalogue
      logical :: is_above = .true.         !! met above the limit by its maximum, or below it by its minimum
      real(wp) :: limit = 0.0_wp           !! SI [any]
   end type extreme_t

   !> Where a life ends; huge: no limit.
   type :: life_ends_t
      real(wp) :: cycles = huge(1.0_wp)                     !! number of cycles [1]
      real(wp) :: depth = huge(1.0_wp)                      !! maximum depth of a surface [m]
      real(wp) :: clearance = huge(1.0_wp)                  !! maximum clearance of a joint [m]
      type(extreme_t), allocatable :: extremes(:)           !! (conditions) of channels
   end type life_ends_t

   !> What a life is asked.
   type :: life_plan_t
      type(life_ends_t) :: ends                      !! where it ends
      real(wp), allocatable :: clearances(:)         !! (contacts) of new surfaces [m]
      real(wp), allocatable :: spreads(:)            !! (surfaces) factor of the coefficient, up and down; 1: it is known [1]
      real(wp) :: cycle = 0.0_wp                     !! mean time of a measured cycle [s]
      integer :: measured = 1                        !! cycles of a simulation whose wear counts
      integer :: starts = 1                          !! starts of the ensemble; 1: the start of the deck
      real(wp) :: tolerance = 1.0e-4_wp              !! error of a jump over what it adds to the depth [1]
      real(wp) :: depth_tolerance = 1.0e-9_wp        !! error of a jump that is accepted [m]
      integer :: n_loads = 0                         !! numbers of the loads of a simulation; 0: none are known
      integer :: simulations = 10000                 !! most profiles that are simulated
      real(wp) :: stretch = 1.0_wp                   !! times the cycles at the end up to which the profiles are followed [1]
   end type life_plan_t

   !> Where a jump starts or ends.
   type :: node_t
      real(wp) :: cycles = 0.0_wp                    !! cycles so far [1]
      real(wp), allocatable :: x(:)                  !! (n) volumes and distances [m^3, m]
      real(wp) :: jump = 0.0_wp                      !! cycles up to the next node, 0: there is none [1]
      real(wp), allocatable :: rates(:, :)           !! (n, 2) mean wear per cycle at the start and the end of that jump [m^3, m]
      real(wp), allocatable :: values(:)             !! (conditions) extremes of channels [any]
      real(wp), allocatable :: measures(:, :)        !! (measures, surfaces) [m, m^3, rad]
      real(wp), allocatable :: by_jumps(:, :)        !! (measures, surfaces) their error by jumps [m, m^3, rad]
      real(wp), allocatable :: by_starts(:, :)       !! (measures, surfaces) half of their 95 % interval by starts [m, m^3, rad]
      real(wp), allocatable :: by_settling(:, :)     !! (measures, surfaces) their error by settling [m, m^3, rad]
   contains
      procedure :: half => half_interval
   end type node_t

   !> A life.
   type :: life_t
      type(life_plan_t) :: plan                      !! what it is asked
      type(life_state_t) :: state                    !! its surfaces
      type(node_t), allocatable :: nodes(:)          !! (n or more) starts and ends of jumps
      integer :: n = 0                               !! nodes
      integer :: last = 0                            !! the node at which it ends; those behind it serve the spread of k
      integer :: simulated = 0                       !! profiles that were simulated
      integer :: rejected = 0                        !! jumps that were rejected
      real(wp) :: cycles_half = 0.0_wp               !! half of the 95 % interval of the cycles at the end [1]
      logical :: ends_by_cycles = .true.             !! the number of cycles, or the time, ended it
      character(:), allocatable :: reason            !! what ended it
   end type life_t

contains

   !> Half of the nominal 95 % interval of the measures, without the spread of k.
   pure function half_interval(self) result(half)
      class(node_t), intent(in) :: self          !! the node
      real(wp), allocatable :: half(:, :)        !! (measures, surfaces) [m, m^3, rad]

      half = sqrt(self%by_jumps**2 + self%by_starts**2 + self%by_settling**2)
   end function half_interval

end module life_results
