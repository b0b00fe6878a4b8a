!> A four-bar without loads, turned at the start: its motion is known from its energy.
module free_four_bar
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use kinds, only: two_pi, wp
   use recorder, only: summary_t
   use scene_fixture, only: nl
   implicit none (type, external)
   private
   public :: four_bar, n_turn, run_four_bar

   real(wp), parameter :: crank = 0.2_wp, coupler = 0.4_wp, rocker = 0.4_wp, base = 0.25_wp  !! lengths of the four-bar [m]
   real(wp), parameter :: mass(3) = [1.0_wp, 2.25_wp, 2.0_wp]        !! (3) masses of crank, coupler, rocker [kg]
   real(wp), parameter :: inertia(3) = [0.30_wp, 2.00_wp, 1.35_wp]   !! (3) about their centres of mass [kg.m^2]
   real(wp), parameter :: speed = 10.0_wp                            !! of the crank at the start [rad/s]
   integer, parameter :: n_turn = 3                                  !! turns of the crank in a run

   !> A four-bar without loads; the settings follow.
   character(*), parameter :: four_bar = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl// &
      "crank 1 0.3 0.1 0 0"//nl// &
      "coupler 2.25 2 0.2125 {0.5m*sqrt(0.4^2 - 0.025^2)} {atan2(sqrt(0.4^2 - 0.025^2), 0.025)}"//nl// &
      "rocker 2 1.35 0.2375 {0.5m*sqrt(0.4^2 - 0.025^2)} {atan2(sqrt(0.4^2 - 0.025^2), -0.025)}"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"far ground 0.25 0"//nl// &
      "heel crank -0.1 0"//nl//"throw crank 0.1 0"//nl//"near_end coupler -0.2 0"//nl//"far_end coupler 0.2 0"//nl// &
      "foot rocker -0.2 0"//nl//"head rocker 0.2 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"main base heel"//nl//"pin throw near_end"//nl//"top far_end head"//nl// &
      "pivot far foot"//nl//"[initial.speed]"//nl//"name joint speed[rad/s]"//nl//"kick main 10"//nl//"[analysis.dynamic]"//nl

contains

   !> Inertia of the four-bar on its crank, I = 2 T/omega^2, at an angle of the crank.
   pure real(wp) function inertia_at(angle) result(reduced)
      real(wp), intent(in) :: angle  !! of the crank [rad]

      real(wp) :: a(2), along(2), d, f(2), h, turn_2, turn_3, v(2)

      a = crank*[cos(angle), sin(angle)]
      ! the end of coupler and rocker is one of two intersections of circles, the one that the deck assembles
      f = [base, 0.0_wp] - a
      d = norm2(f)
      along = f/d
      h = sqrt(coupler**2 - 0.25_wp*d**2)
      f = a + 0.5_wp*d*along + h*[-along(2), along(1)]
      ! v_a + turn_2 x (f - a) = turn_3 x (f - far end), per unit of the crank's rate
      v = [-a(2), a(1)]
      associate (p => f - a, q => f - [base, 0.0_wp])
         turn_2 = -(v(1)*q(1) + v(2)*q(2))/(p(1)*q(2) - p(2)*q(1))
         turn_3 = -(v(1)*p(1) + v(2)*p(2))/(p(1)*q(2) - p(2)*q(1))
         v = v + 0.5_wp*turn_2*[-p(2), p(1)]
      end associate
      reduced = inertia(1) + mass(1)*(0.5_wp*crank)**2 + mass(2)*dot_product(v, v) + inertia(2)*turn_2**2 &
                + (inertia(3) + mass(3)*(0.5_wp*rocker)**2)*turn_3**2
   end function inertia_at

   !> Time of a turn of the crank: the integral of the angle over the speed that the energy gives; the trapezoidal rule on a
   !> periodic function.
   real(wp) function time_of_turn() result(time)
      integer, parameter :: n = 2000
      integer :: k

      time = 0.0_wp
      do k = 0, n - 1
         time = time + sqrt(inertia_at(two_pi*k/n)/inertia_at(0.0_wp))/speed*(two_pi/n)
      end do
   end function time_of_turn

   !> Run the four-bar for whole turns.
   subroutine run_four_bar(settings, loaded, summary, error)
      character(*), intent(in) :: settings                  !! lines of [analysis.dynamic]
      type(loaded_t), intent(out) :: loaded                 !! deck, system and integrator at the end
      type(summary_t), intent(out) :: summary               !! cost and errors
      type(error_t), allocatable, intent(inout) :: error    !! first failure

      type(keeper_t) :: keeper

      if (allocated(error)) return
      call load_text(four_bar//"end = 10 s"//nl//settings//nl, loaded, error)
      if (allocated(error)) return
      loaded%plan%end = n_turn*time_of_turn()
      call run_to_end(loaded, keeper, summary, error)
   end subroutine run_four_bar

end module free_four_bar
