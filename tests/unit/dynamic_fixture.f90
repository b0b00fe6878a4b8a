!> Decks of a wheel that is turned to and fro and of a pin in a ring, and running a deck to its end.
module dynamic_fixture
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use kinds, only: wp
   use recorder, only: summary_t
   use run_audit, only: limits_t
   use scene_fixture, only: nl
   implicit none (type, external)
   private
   public :: clearance, mass, pin, run_text, settings, speed, wheel

   !> A wheel turned to and fro: angle = 0.5 rad (1 - cos(2 t)).
   character(*), parameter :: wheel = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rotor 2 0.1 0 0"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"axle ground 0 0"//nl//"hub rotor 0 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"bearing axle hub"//nl// &
      "[force.torque]"//nl//"name body moment"//nl//"motor rotor {0.2 N.m*cos(2 rad/s*t)}"//nl
   character(*), parameter :: settings = "[analysis.dynamic]"//nl//"coordinates = full"//nl// &
      "start = given"//nl//"tolerance = 1e-10"//nl//"stabilise = baumgarte"//nl

   !> A pin of 0.3 kg, free in a ring of the ground, thrown along x at 2 m/s from the middle. Elastic.
   character(*), parameter :: pin = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]"//nl//"pin 0.3 1e-4 0 0 2"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hole ground 0 0"//nl//"centre pin 0 0"//nl// &
      "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
      "[clearance.revolute]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law"//nl// &
      "ring hole centre 10 0.5 steel hertz"//nl//"[contact.hertz]"//nl//"name"//nl//"hertz"//nl
   real(wp), parameter :: mass = 0.3_wp, speed = 2.0_wp, clearance = 0.5e-3_wp  !! of the pin [kg, m/s, m]

contains

   !> Run a deck to its end.
   subroutine run_text(text, keeper, summary, error, limits)
      character(*), intent(in) :: text                    !! the deck
      type(keeper_t), intent(inout) :: keeper             !! keeps the results
      type(summary_t), intent(out) :: summary             !! cost and errors
      type(error_t), allocatable, intent(out) :: error    !! the run failed
      type(limits_t), intent(in), optional :: limits      !! what the results must fulfil

      type(loaded_t) :: loaded

      call load_text(text, loaded, error)
      if (allocated(error)) error%code = -error%code  ! an error of the test
      if (.not. allocated(error)) call run_to_end(loaded, keeper, summary, error, limits)
   end subroutine run_text

end module dynamic_fixture
