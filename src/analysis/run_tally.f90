!> What a run adds up and holds the greatest of, over all parts of the mechanism.
module run_tally
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_tally_t

   !> Sums and maxima.
   type :: run_tally_t
      integer :: events = 0                       !! located events
      integer :: contacts = 0                     !! contacts that began
      real(wp) :: aside = 0.0_wp                  !! CPU time spent on writing events [s]
      real(wp) :: residual = 0.0_wp               !! of the ledger at the last steps [J]
      real(wp) :: level = 0.0_wp                  !! kinetic + elastic energy + |change of potential| there [J]
      real(wp) :: magnitude = 0.0_wp              !! of what the ledger adds up there [J]
      real(wp) :: lost = 0.0_wp                   !! what contacts have lost by then [J]
      real(wp) :: least_lost = 0.0_wp             !! least of it so far: negative, they made energy [J]
      real(wp) :: residual_max = 0.0_wp           !! greatest |residual| [J]
      real(wp) :: energy_max = 0.0_wp             !! greatest level [J]
      real(wp) :: violation_max = 0.0_wp          !! greatest |Phi|; rotations times 1 m [m]
      real(wp) :: violation_rate_max = 0.0_wp     !! greatest |dPhi/dt| [m/s]
   end type run_tally_t

end module run_tally
