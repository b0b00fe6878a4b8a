!> Freedoms and drivers in excess of small mechanisms, counted by hand.
module test_mobility
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use mobility, only: find_mobility, joint_names, mobility_t, moving_bodies
   use mechanism, only: mechanism_t
   use row_corrections, only: evaluate_rows
   use scene_fixture, only: nl, system_of_text
   implicit none (type, external)
   private
   public :: run_test_mobility

   !> A bar on the x axis with three points on the ground below, and a puck.
   character(*), parameter :: bar = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"bar 1 0.1 0 0"//nl// &
      "puck 1 0.1 3 0"//nl//"[points]"//nl//"name body xi[m] eta[m]"//nl// &
      "g1 ground -0.4 0"//nl//"g2 ground 0.1 0"//nl//"g3 ground 0.5 0"//nl//"g4 ground 3 0"//nl// &
      "b1 bar -0.4 0"//nl//"b2 bar 0.1 0"//nl//"b3 bar 0.5 0"//nl//"p bar 0 0"//nl//"mid puck 0 0"//nl// &
      "[analysis.dynamic]"//nl//"end = 1 s"//nl//"coordinates = full"//nl

contains

   subroutine run_test_mobility(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("nothing_held", test_nothing_held)
      call suite%test("three_pins_on_a_line", test_three_pins_on_a_line)
      call suite%test("twice_the_same_pin", test_twice_the_same_pin)
      call suite%test("parallel_guides", test_parallel_guides)
      call suite%test("drivers", test_drivers)
   end subroutine run_test_mobility

   !> Mobility of the bar with joints.
   subroutine look(joints, system, mobility, error)
      character(*), intent(in) :: joints                     !! tables of joints and drivers
      type(mechanism_t), intent(out) :: system           !! the system, rows evaluated
      type(mobility_t), intent(out) :: mobility              !! what was found
      type(error_t), allocatable, intent(inout) :: error     !! what failed

      call system_of_text(bar//joints, system, error)
      if (allocated(error)) return
      call evaluate_rows(system%linkage, 0.0_wp, [0.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 0.0_wp], [real(wp) :: 0, 0, 0, 0, 0, 0])
      call find_mobility(system%linkage, mobility)
   end subroutine look

   !> Two bodies without joints have six freedoms.
   subroutine test_nothing_held(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mobility_t) :: mobility
      type(mechanism_t) :: system

      call look("", system, mobility, error)
      if (allocated(error)) return
      call check_equal(error, mobility%n_left, 6, "freedoms left")
      call check_equal(error, mobility%n_freedom, 6, "freedoms")
      call check_close(error, mobility%freedom, [1.0_wp, 1.0_wp], 1.0e-14_wp, "how much the bodies can move")
   end subroutine test_nothing_held

   !> A bar pinned three times along one line: six rows of rank three.
   subroutine test_three_pins_on_a_line(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mobility_t) :: mobility
      type(mechanism_t) :: system

      call look("[joint.revolute]"//nl//"name i j"//nl//"a g1 b1"//nl//"b g2 b2"//nl//"c g3 b3"//nl//"d g4 mid"//nl, &
                system, mobility, error)
      if (allocated(error)) return
      call check_equal(error, mobility%rank, 5, "rank")
      call check_equal(error, mobility%n_left, 1, "freedoms left")
      call check_true(error, moving_bodies(system%linkage, mobility%freedom) == "'puck'", "the puck can turn, the bar cannot")
   end subroutine test_three_pins_on_a_line

   !> The same pin twice.
   subroutine test_twice_the_same_pin(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mobility_t) :: mobility
      type(mechanism_t) :: system

      call look("[joint.revolute]"//nl//"name i j"//nl//"once g1 b1"//nl//"again g1 b1"//nl//"d g4 mid"//nl, &
                system, mobility, error)
      if (allocated(error)) return
      call check_equal(error, mobility%rank, 4, "rank")
   end subroutine test_twice_the_same_pin

   !> Two parallel guides: one row each holds the bar down; both hold its angle.
   subroutine test_parallel_guides(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mobility_t) :: mobility
      type(mechanism_t) :: system

      call look("[joint.translational]"//nl//"name i j axis"//nl//"left g1 b1 x"//nl//"right g3 b3 x"//nl// &
                "[joint.rigid]"//nl//"name i j"//nl//"weld g4 mid"//nl, system, mobility, error)
      if (allocated(error)) return
      call check_equal(error, mobility%rank, 5, "rank")
      call check_equal(error, mobility%n_left, 1, "freedoms left")
      call check_true(error, moving_bodies(system%linkage, mobility%freedom) == "'bar'", "the bar can slide")
   end subroutine test_parallel_guides

   !> Drivers against freedoms: the second on one joint is in excess, and the puck's freedom is left.
   subroutine test_drivers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mobility_t) :: mobility
      type(mechanism_t) :: system
      character(*), parameter :: pins = "[joint.revolute]"//nl//"name i j"//nl//"a g1 b1"//nl//"d g4 mid"//nl// &
         "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"one a 1"//nl

      call look(pins//"two a 1"//nl, system, mobility, error)
      if (allocated(error)) return
      call check_equal(error, mobility%n_freedom, 2, "freedoms")
      call check_equal(error, mobility%n_driver, 2, "drivers")
      call check_equal(error, mobility%n_left, 1, "freedoms left")
      call check_true(error, joint_names(system%linkage, mobility%is_excess) == "'two'", "the driver in excess")
      call check_true(error, moving_bodies(system%linkage, mobility%freedom) == "'puck'", "the puck can turn")
      call look(pins//"two d 1"//nl, system, mobility, error)
      if (allocated(error)) return
      call check_equal(error, mobility%n_left, 0, "freedoms left with a driver for each")
      call check_equal(error, count(mobility%is_excess), 0, "drivers in excess with one for each")
   end subroutine test_drivers

end module test_mobility
