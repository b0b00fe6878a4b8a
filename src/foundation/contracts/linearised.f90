!> What a static analysis says of small motions about a steady state: coefficients of the films, and how the whole mechanism moves.
!>
!> Found by analysis/static (`steady_stability`, `whirl_onset`), written by results/writers and results/summaries.
module linearised
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: film_coefficients_t, linearised_t

   !> A film at the steady state.
   type :: film_coefficients_t
      character(:), allocatable :: joint            !! name of the joint
      real(wp) :: clearance = 0.0_wp                !! of the joint [m]
      real(wp) :: eccentricity_ratio = 0.0_wp       !! eccentricity over clearance [1]
      real(wp) :: attitude = 0.0_wp                 !! from the load to the journal's centre, the way the film is entrained [rad]
      real(wp) :: journal_speed = 0.0_wp            !! w_J, inertial [rad/s]
      real(wp) :: load = 0.0_wp                     !! size of the film's force [N]
      real(wp) :: stiffness(2, 2) = 0.0_wp          !! (2, 2) Kij = -dFi/dej, world frame [N/m]
      real(wp) :: damping(2, 2) = 0.0_wp            !! (2, 2) Bij = -dFi/de'j, world frame [N.s/m]
      real(wp) :: error = 0.0_wp                    !! of the maximum entry of each, as a part of it [1]
      real(wp) :: equivalent_stiffness = 0.0_wp     !! of a rigid rotor that starts to whirl (`journal_whirl`) [N/m]
      real(wp) :: whirl_frequency = 0.0_wp          !! of that rotor; NaN: none whirls [rad/s]
      logical :: is_heated = .false.                !! its temperature came from a balance of heat
      real(wp) :: temperature = 0.0_wp              !! of the film; of a lubricant without a grade of no meaning [K]
      real(wp) :: viscosity = 0.0_wp                !! that it has [Pa.s]
      real(wp) :: critical_mass = 0.0_wp            !! of that rotor, which whirls above it; NaN: none whirls [kg]
   end type film_coefficients_t

   !> Small motions about a steady state.
   type :: linearised_t
      logical :: is_judged = .false.                       !! stability was judged by the eigenvalues
      type(film_coefficients_t), allocatable :: films(:)   !! (any) films that act
      real(wp), allocatable :: eigenvalues(:, :)           !! (2, 2 freedoms) real and imaginary parts, maximum growth first [1/s]
      logical :: is_searched = .false.                     !! the speed at which whirl sets in was searched
      real(wp) :: onset = 0.0_wp                           !! that speed over the speed of the drivers; NaN: none was found [1]
      real(wp) :: onset_frequency = 0.0_wp                 !! of the whirl there; NaN: none was found [rad/s]
      real(wp) :: searched_to = 1.0_wp                     !! the end of the search, over the speed of the drivers [1]
      character(:), allocatable :: onset_words             !! what was found, as text
   end type linearised_t

end module linearised
