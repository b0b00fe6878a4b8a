!> What is asked of a study of periodic orbits, and what it finds.
module orbit_results
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: bifurcation_names, bifurcation_t, branch_flip, branch_fold, branch_grazing, branch_pitchfork, branch_t, branch_torus
   public :: n_bifurcation, orbit_plan_t, orbit_study_t, orbit_t

   integer, parameter :: branch_fold = 1        !! saddle-node: a real multiplier 1, where the branch turns
   integer, parameter :: branch_flip = 2        !! period doubling: a real multiplier -1
   integer, parameter :: branch_torus = 3       !! Neimark-Sacker: two complex multipliers of modulus 1
   integer, parameter :: branch_pitchfork = 4   !! a real multiplier 1, where the branch does not turn: symmetry breaks
   integer, parameter :: branch_grazing = 5     !! an onset grazes: the number of onsets changes
   integer, parameter :: n_bifurcation = 5      !! kinds of bifurcations
   character(*), parameter :: bifurcation_names(n_bifurcation) = [character(17) :: "fold", "period_doubling", "neimark_sacker", &
                                                                  "symmetry_breaking", "grazing"]

   !> What is asked for.
   type :: orbit_plan_t
      integer :: n_period = 1                      !! periods of the drivers in one of the orbit
      integer :: n_settle = 0                      !! periods of the drivers before the first guess
      real(wp) :: tolerance = 0.0_wp               !! of the motion [1]
      integer :: first = 0                         !! contacts whose first onset has the phase; 0: none
      integer :: last = 0                          !! the last of them
      real(wp) :: phase = 0.0_wp                   !! of the drivers at the start [rad]
      character(:), allocatable :: joint           !! joint of these contacts; blank: none
      character(:), allocatable :: parameter       !! of the branch; blank: there is none
      character(:), allocatable :: unit            !! of the parameter, SI
      real(wp) :: p = 0.0_wp                       !! its value in the deck [any]
      real(wp) :: from = 0.0_wp                    !! minimum value on the branch [any]
      real(wp) :: to = 0.0_wp                      !! maximum value [any]
      integer :: most = 0                          !! points of a branch, at most, in each direction
      real(wp) :: step = 0.0_wp                    !! longest step, of the range [1]
   end type orbit_plan_t

   !> A periodic orbit.
   type :: orbit_t
      real(wp) :: p = 0.0_wp                       !! value of the parameter [any]
      real(wp), allocatable :: z(:)                !! (m) start, free components over their scales [1]
      real(wp), allocatable :: matrix(:, :)        !! (m, m) derivative of the state after a period by its start [1]
      real(wp), allocatable :: by_p(:)             !! (m) and by the parameter [any]
      complex(wp), allocatable :: multipliers(:)   !! (m) by descending modulus [1]
      real(wp) :: period = 0.0_wp                  !! [s]
      real(wp) :: phase = 0.0_wp                   !! of the drivers at the onset asked for, in (-pi, pi]; NaN: none [rad]
      real(wp), allocatable :: onset(:)            !! (any) onsets, from the start [s]
      real(wp), allocatable :: speed(:)            !! (any) their impact speeds [m/s]
      integer, allocatable :: contact(:)           !! (any) their contacts
      real(wp) :: residual = 0.0_wp                !! maximum difference of the states at start and end, of the scales [1]
      logical :: is_stable = .false.               !! no multiplier is outside the unit circle
   end type orbit_t

   !> A point of a branch at which stability changes or the branch turns.
   type :: bifurcation_t
      integer :: kind = 0                          !! one of the above
      type(orbit_t) :: orbit                       !! there
   end type bifurcation_t

   !> A branch.
   type :: branch_t
      type(orbit_t), allocatable :: orbits(:)              !! (n) along the branch
      type(bifurcation_t), allocatable :: bifurcations(:)  !! (any) in between
      character(:), allocatable :: low, high                !! why it ends at its start and at its end
   end type branch_t

   !> The study.
   type :: orbit_study_t
      type(orbit_plan_t) :: plan                   !! what was asked for
      type(orbit_t) :: orbit                       !! that at the values of the deck
      type(branch_t) :: branch                     !! through it
      integer :: n_free = 0                        !! free components of the state
      real(wp), allocatable :: scale(:)            !! (n_free) their scales [any]
      integer :: n_cyclic = 0                      !! those that nothing depends on, which are omitted
      integer :: n_run = 0                         !! periods that were integrated
   end type orbit_study_t

end module orbit_results
