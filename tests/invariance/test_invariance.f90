!> What must not matter: the order of rows, units, place and direction of the mechanism, the solver.
!>
!> Each variant of the slider-crank with a loose pin has the first five impacts of the deck in inputs/.
module test_invariance
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: dry_deck, keeper_t, load_file, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use kinds, only: wp
   use recorder, only: summary_t
   implicit none (type, external)
   private
   public :: run_test_invariance

   integer, parameter :: n_impact = 5            !! impacts compared
   real(wp), parameter :: t_end = 1.6e-3_wp      !! after the fifth impact [s]
   real(wp), parameter :: part = 1.0e-9_wp       !! difference allowed [1]

   character(*), parameter :: nl = new_line("a")
   character(*), parameter :: bodies = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[mm] y[mm] angle[deg]"//nl// &
      "crank 0.30 1.0e-4 25 0 0"//nl//"rod 0.21 2.5e-4 110 0 0"//nl//"slider 0.14 1.0e-4 170 0 0"//nl
   character(*), parameter :: points = "[points]"//nl//"name body xi[mm] eta[mm]"//nl//"main ground 0 0"//nl// &
      "heel crank -25 0"//nl//"throw crank 25 0"//nl//"big rod -60 0"//nl//"small rod 60 0"//nl//"pin slider 0 0"//nl
   character(*), parameter :: joints = "[joint.revolute]"//nl//"name i j"//nl//"main main heel"//nl//"big_end throw big"//nl
   character(*), parameter :: guide = "[joint.translational]"//nl//"name i j axis axis_angle[deg]"//nl//"guide main pin x 0"//nl
   character(*), parameter :: motor = "[driver.speed]"//nl//"name joint speed"//nl//"motor main 5000rpm"//nl
   character(*), parameter :: gudgeon = "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
      "[clearance.revolute]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law"//nl// &
      "gudgeon pin small 10 0.5 steel ln"//nl//"[contact.lankarani_nikravesh]"//nl//"name restitution"//nl//"ln 0.9"//nl
   character(*), parameter :: analysis = "[analysis.dynamic]"//nl//"end = 24 ms"//nl//"stabilise = baumgarte alpha=5s^-1 "// &
      "beta=5s^-1"//nl

contains

   subroutine run_test_invariance(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("same_deck_in_this_file", test_same_deck)
      call suite%test("order_of_rows", test_order_of_rows)
      call suite%test("units", test_units)
      call suite%test("rotated", test_rotated)
      call suite%test("shifted", test_shifted)
      call suite%test("mirrored", test_mirrored)
      call suite%test("solver", test_solver)
      call suite%test("swapped_bodies_of_joints", test_swapped)
      call suite%test("another_motion_differs", test_another_motion)
   end subroutine run_test_invariance

   !> First impacts of a loaded deck: time, impact speed, peak force, peak penetration, duration,
   !> release speed, energy lost.
   subroutine find_impacts(loaded, impacts, error)
      type(loaded_t), intent(inout) :: loaded              !! the deck
      real(wp), intent(out) :: impacts(7, n_impact)        !! (7, n_impact) what is reported of each [any]
      type(error_t), allocatable, intent(out) :: error     !! it failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      integer :: k

      impacts = 0.0_wp
      loaded%plan%end = t_end
      loaded%plan%every = t_end
      loaded%method%controls%tolerance = 1.0e-12_wp
      call run_to_end(loaded, keeper, summary, error)
      if (allocated(error)) return
      call check_true(error, keeper%n_event >= n_impact, "five impacts")
      if (allocated(error)) return
      do k = 1, n_impact
         associate (event => keeper%events(k))
            impacts(:, k) = [event%time, event%impact_speed, event%peak_force, event%peak_penetration, event%duration, &
                             event%release_speed, event%energy_lost]
         end associate
      end do
   end subroutine find_impacts

   !> A deck has the impacts of the deck in inputs/, each number to a part of its maximum.
   subroutine check_same_impacts(error, text)
      type(error_t), allocatable, intent(out) :: error  !! first failure
      character(*), intent(in) :: text                  !! the deck without its first line

      type(loaded_t) :: loaded

      call load_text("deck = 1"//nl//text, loaded, error)
      if (.not. allocated(error)) call check_impacts_of(error, loaded)
   end subroutine check_same_impacts

   !> The same for a loaded deck.
   subroutine check_impacts_of(error, loaded)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      type(loaded_t), intent(inout) :: loaded             !! the deck

      type(loaded_t) :: original
      real(wp) :: actual(7, n_impact), expected(7, n_impact)
      integer :: k
      character(*), parameter :: what(7) = [character(17) :: "times", "impact speeds", "peak forces", "peak penetrations", &
                                            "durations", "release speeds", "energies lost"]

      call load_file(dry_deck, original, error)
      if (.not. allocated(error)) call find_impacts(original, expected, error)
      if (.not. allocated(error)) call find_impacts(loaded, actual, error)
      if (allocated(error)) return
      do k = 1, 7
         call check_close(error, actual(k, :), expected(k, :), part, trim(what(k)), relative=.true.)
      end do
   end subroutine check_impacts_of

   !> The deck of this file is that of inputs/.
   subroutine test_same_deck(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_same_impacts(error, bodies//points//joints//guide//motor//gudgeon//analysis)
   end subroutine test_same_deck

   !> Bodies, points and joints in other orders, sections too.
   subroutine test_order_of_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: other_bodies = "[bodies]"//nl//"name angle[deg] y[mm] x[mm] inertia[kg.m^2] mass[kg]"//nl// &
         "slider 0 0 170 1.0e-4 0.14"//nl//"crank 0 0 25 1.0e-4 0.30"//nl//"rod 0 0 110 2.5e-4 0.21"//nl
      character(*), parameter :: other_points = "[points]"//nl//"name body eta[mm] xi[mm]"//nl//"small rod 0 60"//nl// &
         "pin slider 0 0"//nl//"throw crank 0 25"//nl//"main ground 0 0"//nl//"big rod 0 -60"//nl//"heel crank 0 -25"//nl
      character(*), parameter :: other_joints = "[joint.revolute]"//nl//"name i j"//nl//"big_end throw big"//nl// &
         "main main heel"//nl

      call check_same_impacts(error, gudgeon//analysis//motor//guide//other_joints//other_points//other_bodies)
   end subroutine test_order_of_rows

   !> Millimetres, grams and milliseconds.
   subroutine test_units(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: small = "[scene]"//nl//"gravity = 0 0 mm/ms^2"//nl// &
         "[bodies]"//nl//"name mass[g] inertia[g.mm^2] x[cm] y[um] angle[rad]"//nl// &
         "crank 300 1e5 2.5 0 0"//nl//"rod 210 2.5e5 11 0 0"//nl//"slider 140 1e5 17 0 0"//nl// &
         "[points]"//nl//"name body xi[um] eta[m]"//nl//"main ground 0 0"//nl// &
         "heel crank -25000 0"//nl//"throw crank 25000 0"//nl//"big rod -6e4 0"//nl//"small rod 6e4 0"//nl//"pin slider 0 0"//nl// &
         joints//guide//"[driver.speed]"//nl//"name joint speed[deg/ms]"//nl//"motor main 30"//nl// &
         "[material]"//nl//"name young[N/mm^2] poisson density[g/cm^3]"//nl//"steel 207000 0.3 7.85"//nl// &
         "[clearance.revolute]"//nl//"name bearing journal bearing_radius[cm] clearance[um] material law friction"//nl// &
         "gudgeon pin small 1 500 steel ln dry"//nl//"[contact.lankarani_nikravesh]"//nl//"name restitution"//nl//"ln 0.9"//nl// &
         "[friction.ambrosio]"//nl//"name coefficient v0[mm/s] v1[um/ms]"//nl//"dry 0 0.1 1"//nl// &
         "[analysis.dynamic]"//nl//"end = 24000 us"//nl//"stabilise = baumgarte alpha=5e-3ms^-1 beta=5Hz"//nl
      type(loaded_t) :: loaded, original

      call load_text("deck = 1"//nl//small, loaded, error)
      if (.not. allocated(error)) call load_file(dry_deck, original, error)
      if (allocated(error)) return
      associate (a => loaded%system, b => original%system)
         call close_to("mass", a%linkage%bodies%mass, b%linkage%bodies%mass)
         call close_to("inertia", a%linkage%bodies%inertia, b%linkage%bodies%inertia)
         call close_to("places", [a%linkage%bodies%r(1, :), a%linkage%bodies%angle], [b%linkage%bodies%r(1, :), &
                       b%linkage%bodies%angle])
         call close_to("points", [loaded%scene%points%s], [original%scene%points%s])
         call close_to("clearance", a%clearance_joints%sets(1)%set%items%pairs%clearance, &
                       b%clearance_joints%sets(1)%set%items%pairs%clearance)
         call close_to("stiffness", a%clearance_joints%sets(1)%set%laws%parameters(1, :), &
                       b%clearance_joints%sets(1)%set%laws%parameters(1, :))
         call close_to("gains", [a%linkage%solution%alpha, a%linkage%solution%beta], [b%linkage%solution%alpha, &
                       b%linkage%solution%beta])
         call close_to("scale", [a%linkage%scales%length], [b%linkage%scales%length])
      end associate
      call close_to("density", loaded%scene%materials%density, original%scene%materials%density)
      call close_to("end", [loaded%plan%end], [original%plan%end])
      call close_to("start", loaded%y, original%y)
      if (.not. allocated(error)) call check_impacts_of(error, loaded)

   contains

      !> Equal but for the rounding of conversions.
      subroutine close_to(what, actual, expected)
         character(*), intent(in) :: what           !! what is compared
         real(wp), intent(in) :: actual(:)          !! (n) read in other units [any]
         real(wp), intent(in) :: expected(:)        !! (n) read in those of the book [any]

         call check_close(error, actual, expected, 1.0e-15_wp, what, relative=.true.)
      end subroutine close_to

   end subroutine test_units

   !> The whole mechanism turned about the main bearing, by a right angle and by 37 degrees.
   subroutine test_rotated(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: upright = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[mm] y[mm] angle[deg]"//nl// &
         "crank 0.30 1.0e-4 0 25 90"//nl//"rod 0.21 2.5e-4 0 110 90"//nl//"slider 0.14 1.0e-4 0 170 90"//nl
      character(*), parameter :: skew = "[parameters]"//nl//"a = 37 deg"//nl// &
         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x y angle"//nl// &
         "crank 0.30 1.0e-4 {25 mm*cos(a)} {25 mm*sin(a)} {a}"//nl// &
         "rod 0.21 2.5e-4 {110 mm*cos(a)} {110 mm*sin(a)} {a}"//nl// &
         "slider 0.14 1.0e-4 {170 mm*cos(a)} {170 mm*sin(a)} {a}"//nl
      character(*), parameter :: up = "[joint.translational]"//nl//"name i j axis"//nl//"guide main pin y"//nl
      character(*), parameter :: along = "[joint.translational]"//nl//"name i j axis axis_angle[deg]"//nl//"guide main pin x 37"//nl

      call check_same_impacts(error, upright//points//joints//up//motor//gudgeon//analysis)
      if (.not. allocated(error)) call check_same_impacts(error, skew//points//joints//along//motor//gudgeon//analysis)
   end subroutine test_rotated

   !> The main bearing elsewhere in the world.
   subroutine test_shifted(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: there = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[mm] y[mm] angle[deg]"//nl// &
         "crank 0.30 1.0e-4 145 -70 0"//nl//"rod 0.21 2.5e-4 230 -70 0"//nl//"slider 0.14 1.0e-4 290 -70 0"//nl
      integer, parameter :: first = index(points, "main ground")

      call check_same_impacts(error, there//points(:first - 1)//"main ground 120 -70"//points(first + 15:)// &
                              joints//guide//motor//gudgeon//analysis)
   end subroutine test_shifted

   !> Turning clockwise.
   subroutine test_mirrored(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded

      call load_file(dry_deck, loaded, error, "speed=-5000rpm")
      if (.not. allocated(error)) call check_impacts_of(error, loaded)
   end subroutine test_mirrored

   !> The full augmented matrix by LAPACK instead of its Schur complement.
   subroutine test_solver(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded

      call load_text("deck = 1"//nl//bodies//points//joints//guide//motor//gudgeon//analysis//"solver = lapack"//nl, &
                     loaded, error)
      if (allocated(error)) return
      call check_equal(error, loaded%system%linkage%solution%solver%name(), "lapack", "solver")
      call check_impacts_of(error, loaded)
      call load_file(dry_deck, loaded, error)
      if (.not. allocated(error)) call check_equal(error, loaded%system%linkage%solution%solver%name(), "schur", &
                                                   "solver of the original")
   end subroutine test_solver

   !> Points i and j of joints exchanged, the driver with them; the journal stays that of the rod.
   subroutine test_swapped(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: back = "[joint.revolute]"//nl//"name i j"//nl//"main heel main"//nl//"big_end big throw"//nl// &
         "[joint.translational]"//nl//"name i j axis"//nl//"guide pin main x"//nl// &
         "[driver.speed]"//nl//"name joint speed"//nl//"motor main -5000rpm"//nl

      call check_same_impacts(error, bodies//points//back//gudgeon//analysis)
   end subroutine test_swapped

   !> The comparison can fail: a part in a million of the speed is seen.
   subroutine test_another_motion(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: difference
      type(loaded_t) :: loaded

      call load_file(dry_deck, loaded, error, "speed=5000.005rpm")
      if (allocated(error)) return
      call check_impacts_of(difference, loaded)
      call check_true(error, allocated(difference), "another speed gives other impacts")
   end subroutine test_another_motion

end module test_invariance
