!> Velocities at the start: what the deck gives stays, what it omits follows, what contradicts is reported.
module test_velocities
   use assembly_report, only: assembly_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: pi, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, start_text
   implicit none (type, external)
   private
   public :: run_test_velocities

   !> A given velocity yields to constraints that the others could fulfil by this much of itself.
   real(wp), parameter :: kept = 1.0e-7_wp

contains

   subroutine run_test_velocities(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("pendulum", test_pendulum)
      call suite%test("pendulum_with_one_component", test_one_component)
      call suite%test("double_pendulum", test_double_pendulum)
      call suite%test("double_pendulum_with_one_speed", test_one_speed)
      call suite%test("contradiction", test_contradiction)
      call suite%test("driver_against_given_speed", test_driver)
      call suite%test("loose_body", test_loose_body)
   end subroutine run_test_velocities

   !> One or two rods of 0.8 m hang from the ground at 30 and 70 degrees; a stone flies free, first in the list.
   function rods(n, columns, velocities) result(deck)
      integer, intent(in) :: n                      !! rods
      character(*), intent(in) :: columns           !! heads of the velocities
      character(*), intent(in) :: velocities(n)     !! their cells
      character(:), allocatable :: deck             !! the deck

      integer :: k

      deck = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg] "//columns//nl// &
             "stone 1 1 9 9 0"//repeat(" -", count([(columns(k:k) == "[", k=1, len(columns))]))//nl// &
             "upper 2 0.05 {0.4 m*cos(30 deg)} {0.4 m*sin(30 deg)} 30 "//velocities(1)//nl
      if (n == 2) deck = deck//"lower 3 0.1 {0.8 m*cos(30 deg) + 0.4 m*cos(70 deg)} "// &
                         "{0.8 m*sin(30 deg) + 0.4 m*sin(70 deg)} 70 "//velocities(2)//nl
      deck = deck//"[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye upper -0.4 0"//nl// &
             "end upper 0.4 0"//nl
      if (n == 2) deck = deck//"loop lower -0.4 0"//nl
      deck = deck//"[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl
      if (n == 2) deck = deck//"elbow end loop"//nl
      deck = deck//"[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s"//nl
   end function rods

   !> Velocity of a point at the end of an arm that turns.
   pure function turned(omega, length, degrees) result(v)
      real(wp), intent(in) :: omega     !! angular velocity [rad/s]
      real(wp), intent(in) :: length    !! of the arm [m]
      real(wp), intent(in) :: degrees   !! angle of the arm [deg]
      real(wp) :: v(2)                  !! (2) velocity [m/s]

      v = omega*length*[-sin(degrees*pi/180.0_wp), cos(degrees*pi/180.0_wp)]
   end function turned

   !> Only omega is given: it stays, vx and vy follow, and nothing that was given is changed.
   subroutine test_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(rods(1, "omega[rad/s]", ["5"]), system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(12), 5.0_wp, kept, "omega", relative=.true.)
      call check_close(error, y(10:11), turned(y(12), 0.4_wp, 30.0_wp), 1.0e-14_wp, "velocity of the centre")
      call check_close(error, y(7:9), [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "the stone")
      call check_true(error, report%rate_changed < 5.0_wp*kept, "nothing given is changed")
   end subroutine test_pendulum

   !> Only vy is given: omega follows from it.
   subroutine test_one_component(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(rods(1, "vy[m/s]", ["1.2"]), system, y, error)
      if (allocated(error)) return
      call check_close(error, y(11), 1.2_wp, kept, "vy", relative=.true.)
      call check_close(error, y(12), 3.0_wp/cos(pi/6.0_wp), kept, "omega", relative=.true.)
      call check_close(error, y(10:11), turned(y(12), 0.4_wp, 30.0_wp), 1.0e-14_wp, "velocity of the centre")
   end subroutine test_one_component

   !> Both angular velocities are given.
   subroutine test_double_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(rods(2, "omega[rad/s]", [character(2) :: "2", "-3"]), system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y([15, 18]), [2.0_wp, -3.0_wp], kept, "angular velocities", relative=.true.)
      call check_close(error, y(13:14), turned(y(15), 0.4_wp, 30.0_wp), 1.0e-14_wp, "velocity of the upper rod")
      call check_close(error, y(16:17), turned(y(15), 0.8_wp, 30.0_wp) + turned(y(18), 0.4_wp, 70.0_wp), 1.0e-14_wp, &
                       "velocity of the lower rod")
      call check_true(error, report%rate_changed < 5.0_wp*kept, "nothing given is changed")
   end subroutine test_double_pendulum

   !> One is given, for the other the table has a dash: the given one stays.
   subroutine test_one_speed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(rods(2, "omega[rad/s]", [character(2) :: "-", "-3"]), system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(18), -3.0_wp, kept, "omega of the lower rod", relative=.true.)
      call check_close(error, y(16:17), turned(y(15), 0.8_wp, 30.0_wp) + turned(y(18), 0.4_wp, 70.0_wp), 1.0e-14_wp, &
                       "velocity of the lower rod")
      call check_true(error, report%rate_changed < 5.0_wp*kept, "nothing given is changed")
   end subroutine test_one_speed

   !> A given velocity along the rod cannot be: it is taken away, and the report names the body and the change.
   subroutine test_contradiction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(rods(1, "vx[m/s] vy[m/s]", ["{3 m/s*cos(30 deg)} {3 m/s*sin(30 deg)}"]), system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(10:12), [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-7_wp, "at rest")
      call check_close(error, report%rate_changed, 3.0_wp*cos(pi/6.0_wp), 1.0e-6_wp, "greatest change")
      call check_equal(error, report%changed_body, 2, "body that was changed")
   end subroutine test_contradiction

   !> A driver is stronger than a given angular velocity; the change is reported in m/s, times the size of the bodies.
   subroutine test_driver(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: motor = "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor pin 7"
      type(assembly_t) :: report
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(rods(1, "omega[rad/s]", ["5"])//motor, system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(12), 7.0_wp, 1.0e-14_wp, "omega", relative=.true.)
      call check_close(error, system%linkage%scales%length, 0.4_wp, 0.0_wp, "size of the bodies")
      call check_close(error, report%rate_changed, 2.0_wp*system%linkage%scales%length, 1.0e-6_wp, "change")
      call start_text(rods(1, "", [""])//motor, system, y, error, report)
      if (allocated(error)) return
      call check_close(error, report%rate_changed, 0.0_wp, 0.0_wp, "defaults that change are no change")
      call check_equal(error, report%rank, 3, "rank")
   end subroutine test_driver

   !> `start = ideal` drops the velocity of a body on a loose pin, `start = given` keeps it.
   subroutine test_loose_body(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: deck = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] omega[rad/s]"//nl// &
         "pin 0.3 1e-4 0 0 2 30"//nl// &
         "[points]"//nl//"name body xi[m] eta[m]"//nl//"hole ground 0 0"//nl//"centre pin 0 0"//nl// &
         "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl//"[contact.hertz]"//nl//"name"//nl//"hertz"//nl// &
         "[clearance.revolute]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law"//nl// &
         "ring hole centre 10 0.5 steel hertz"//nl//"[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s"//nl
      type(assembly_t) :: report
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text(deck//"start = ideal", system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(4:6), [0.0_wp, 0.0_wp, 30.0_wp], 1.0e-14_wp, "velocities of start = ideal")
      call check_close(error, report%rate_changed, 2.0_wp, 1.0e-14_wp, "change")
      call check_equal(error, report%changed_body, 1, "body that was changed")
      call start_text(deck//"start = given", system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(4:6), [2.0_wp, 0.0_wp, 30.0_wp], 0.0_wp, "velocities of start = given")
      call check_close(error, report%rate_changed, 0.0_wp, 0.0_wp, "no change")
   end subroutine test_loose_body

end module test_velocities
