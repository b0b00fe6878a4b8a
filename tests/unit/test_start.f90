!> The start of a motion: assembly, minimum corrections, and what cannot be assembled.
module test_start
   use assembly_report, only: assembly_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t, exit_assembly, exit_internal, set_error
   use fixed_random, only: random_t
   use kinds, only: i8, pi, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: channel_of, nl, slider_crank, start_text
   use start_state, only: redundancy_text
   use text, only: real_text, replace
   implicit none (type, external)
   private
   public :: run_test_start

   real(wp), parameter :: speed = 5000.0_wp*2.0_wp*pi/60.0_wp  !! of the slider-crank's motor [rad/s]

   character(*), parameter :: rod_place = "98.09475019311126", rod_angle = "-14.477512185929924", &
      slider_place = "156.18950038622252"  !! cells of its deck [mm, deg, mm]

contains

   subroutine run_test_start(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("perturbed_slider_crank", test_perturbed_slider_crank)
      call suite%test("far_away", test_far_away)
      call suite%test("least_velocities", test_min_velocities)
      call suite%test("least_positions", test_min_positions)
      call suite%test("free_body", test_free_body)
      call suite%test("given_start", test_given_start)
      call suite%test("rigid_joint", test_rigid_joint)
      call suite%test("angle_driver", test_angle_driver)
      call suite%test("loop_that_cannot_close", test_loop_that_cannot_close)
      call suite%test("almost_closed", test_almost_closed)
      call suite%test("contradictory_drivers", test_contradictory_drivers)
      call suite%test("contradictory_angles", test_contradictory_angles)
      call suite%test("redundant_rows", test_redundant_rows)
      call suite%test("overlap", test_overlap)
   end subroutine run_test_start

   !> The slider-crank with its start positions off by a few millimetres and degrees.
   function perturbed(random, settings, level) result(deck)
      type(random_t), intent(inout) :: random    !! where numbers come from
      character(*), intent(in) :: settings       !! lines of [analysis.dynamic]
      character(*), intent(in) :: level          !! of the gudgeon
      character(:), allocatable :: deck          !! the deck

      deck = slider_crank(settings, "damped", "none", level)
      deck = replace(deck, rod_place, real_text(98.0_wp + random%between(-5.0_wp, 5.0_wp), 8))
      deck = replace(deck, slider_place, real_text(156.0_wp + random%between(-5.0_wp, 5.0_wp), 8))
      deck = replace(deck, rod_angle, real_text(-14.5_wp + random%between(-5.0_wp, 5.0_wp), 8))
   end function perturbed

   !> From positions nearby: violations at round-off, the crank where the deck has it, rates of the driver.
   subroutine test_perturbed_slider_crank(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      type(random_t) :: random
      character(*), parameter :: levels(2) = ["ideal    ", "clearance"]
      real(wp) :: delta(1), rate(1)
      real(wp), allocatable :: y(:), ydot(:)
      integer :: k, level, status

      random%state = 31_i8
      do k = 1, 10
         do level = 1, 2
            call start_text(perturbed(random, "", levels(level)), system, y, error, report)
            if (allocated(error)) return
            ydot = y
            call system%evaluate(0.0_wp, y, ydot, status)
            call check_close(error, maxval(abs(system%linkage%rows%phi)), 0.0_wp, 1.0e-14_wp, "violation")
            call check_close(error, maxval(abs(system%linkage%solution%phi_dot)), 0.0_wp, 1.0e-12_wp, "rate of the violation")
            call check_equal(error, report%rank, system%linkage%rows%n, "rank of the system that runs")
            call check_true(error, report%residual <= 1.0e-14_wp, "residual reported")
            call check_true(error, report%corrections > 0 .and. report%corrections < 10, "few corrections")
            call check_close(error, y(12), speed, 1.0e-9_wp, "speed of the crank")
            ! sides 25 - 120 mm, angles 36.87 and -14.48 degrees: the slider in closed form
            call check_close(error, y(7), 0.05_wp*0.8_wp + sqrt(0.12_wp**2 - 0.03_wp**2), 1.0e-14_wp, "place of the slider")
            call check_close(error, y(16), -speed*0.03_wp*(1.0_wp + 0.04_wp/sqrt(0.12_wp**2 - 0.03_wp**2)), 1.0e-11_wp, &
                             "speed of the slider")
         end do
         if (k > 1) cycle
         ! the loose pin starts in the middle
         call system%events(0.0_wp, y, delta, rate)
         call check_close(error, delta(1), -0.5e-3_wp, 1.0e-14_wp, "the pin is centred")
      end do
   end subroutine test_perturbed_slider_crank

   !> From far away it closes too.
   subroutine test_far_away(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      character(:), allocatable :: deck
      real(wp), allocatable :: y(:), ydot(:)
      integer :: status

      deck = replace(slider_crank("", "damped", "none", "ideal"), rod_place, "10")
      deck = replace(replace(deck, rod_angle, "25"), slider_place, "30")
      call start_text(deck, system, y, error)
      if (allocated(error)) return
      ydot = y
      call system%evaluate(0.0_wp, y, ydot, status)
      call check_close(error, maxval(abs(system%linkage%rows%phi)), 0.0_wp, 1.0e-14_wp, "violation")
      call check_close(error, maxval(abs(system%linkage%solution%phi_dot)), 0.0_wp, 1.0e-11_wp, "rate of the violation")
   end subroutine test_far_away

   !> A pendulum with velocities that do not fit: the change is smallest in m/s over the body's size and rad/s.
   subroutine test_min_velocities(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] vy[m/s] omega[rad/s]"//nl// &
                      "bob 2 0.05 0.4 0 3 1.2 7"//nl// &
                      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye bob -0.4 0"//nl// &
                      "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                      "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s", system, y, error)
      if (allocated(error)) return
      ! vx = 0; vy = 0.4 omega with (vy - 1.2)/0.4 + omega - 7 = 0
      call check_close(error, y(4:6), [0.0_wp, 2.0_wp, 5.0_wp], 1.0e-14_wp, "velocities", relative=.true.)
      call check_close(error, y(1:3), [0.4_wp, 0.0_wp, 0.0_wp], 1.0e-16_wp, "positions that fitted")
   end subroutine test_min_velocities

   !> Two bodies that should share their centres and are apart: each moves half the way, nothing turns.
   subroutine test_min_positions(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      type(assembly_t) :: report
      real(wp), allocatable :: y(:)

      call start_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl// &
                      "left 2 0.05 3 0 0"//nl//"right 5 0.05 4 0 0.5"//nl// &
                      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hub left 0 0"//nl//"nave right 0 0"//nl// &
                      "end left 0.5 0"//nl// &
                      "[joint.revolute]"//nl//"name i j"//nl//"axle hub nave"//nl// &
                      "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s", system, y, error, report)
      if (allocated(error)) return
      call check_close(error, y(1:6), [3.5_wp, 0.0_wp, 0.0_wp, 3.5_wp, 0.0_wp, 0.5_wp], 1.0e-14_wp, "positions")
      call check_close(error, report%moved, 0.5_wp, 1.0e-14_wp, "greatest move")
   end subroutine test_min_positions

   !> A body without joints stays where it is, to the last digit, while others are assembled.
   subroutine test_free_body(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      character(:), allocatable :: deck
      type(random_t) :: random
      real(wp), allocatable :: y(:)

      random%state = 32_i8
      deck = replace(perturbed(random, "", "ideal"), "[points]", "stone 1 1 333.3 -77.7 12.5"//nl//"[points]")
      call start_text(deck, system, y, error)
      if (allocated(error)) return
      call check_close(error, y(10:12), [0.3333_wp, -0.0777_wp, 12.5_wp*pi/180.0_wp], 1.0e-17_wp, "place")
      call check_close(error, y(22:24), [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "at rest")
   end subroutine test_free_body

   !> `start = given`: only ideal joints are closed, the loose pin stays off the middle.
   subroutine test_given_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      type(assembly_t) :: report
      real(wp) :: delta(1), rate(1)
      real(wp), allocatable :: y(:)
      character(:), allocatable :: deck

      deck = replace(slider_crank("start = given", "damped", "none", "clearance"), slider_place, "155.9")
      call start_text(deck, system, y, error, report)
      if (allocated(error)) return
      call check_equal(error, report%rank, 7, "rank without the loose pin")
      call check_close(error, y(7), 0.1559_wp, 1.0e-15_wp, "place of the slider")
      call system%events(0.0_wp, y, delta, rate)
      ! 40 + sqrt(120^2 - 30^2) mm less 155.9 mm, less the clearance
      call check_close(error, delta(1), sqrt(0.0135_wp) - 0.1159_wp - 0.5e-3_wp, 1.0e-14_wp, "eccentricity")
   end subroutine test_given_start

   !> A weld keeps the angle that the deck gives the bodies, and carries the velocities of the driver over.
   subroutine test_rigid_joint(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:), ydot(:)
      integer :: status

      call start_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl// &
                      "arm 2 0.05 0.41 0.02 3"//nl//"hand 1 0.01 0.75 0.31 63"//nl// &
                      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye arm -0.4 0"//nl// &
                      "wrist arm 0.3 0"//nl//"palm hand -0.2 -0.1"//nl// &
                      "[joint.revolute]"//nl//"name i j"//nl//"shoulder hook eye"//nl// &
                      "[joint.rigid]"//nl//"name i j"//nl//"weld wrist palm"//nl// &
                      "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor shoulder 8"//nl// &
                      "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s", system, y, error)
      if (allocated(error)) return
      ydot = y
      call system%evaluate(0.0_wp, y, ydot, status)
      call check_close(error, maxval(abs(system%linkage%rows%phi)), 0.0_wp, 1.0e-15_wp, "violation")
      call check_close(error, y(6) - y(3), pi/3.0_wp, 1.0e-15_wp, "angle between the bodies")
      call check_close(error, y(3), pi/60.0_wp, 1.0e-15_wp, "angle of the driven body")
      call check_close(error, y([9, 12]), [8.0_wp, 8.0_wp], 1.0e-13_wp, "both turn with the driver")
      call check_close(error, y(10:11), 8.0_wp*[-y(5), y(4)], 1.0e-13_wp, "velocity of the hand")
   end subroutine test_rigid_joint

   !> A driver's function gives the angle and, by its derivative at t = 0, the speed.
   subroutine test_angle_driver(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call start_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]"//nl// &
                      "bob 2 0.05 0.4 0 0 -50"//nl// &
                      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye bob -0.4 0"//nl// &
                      "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                      "[driver.angle]"//nl//"name joint angle"//nl//"motor pin {0.3 rad + 0.5 rad*sin(6 rad/s*t)}"//nl// &
                      "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s", system, y, error)
      if (allocated(error)) return
      call check_close(error, y(1:3), [0.4_wp*cos(0.3_wp), 0.4_wp*sin(0.3_wp), 0.3_wp], 1.0e-15_wp, "position")
      call check_close(error, y(4:6), 3.0_wp*[-0.4_wp*sin(0.3_wp), 0.4_wp*cos(0.3_wp), 1.0_wp], 1.0e-13_wp, "velocity")
      call check_close(error, channel_of(system, 0.0_wp, y, "motor", "coordinate"), 0.3_wp, 1.0e-15_wp, "coordinate")
   end subroutine test_angle_driver

   !> Fail unless a deck has no start, for the reason given.
   subroutine check_no_start(error, deck, words)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: deck                  !! the deck
      character(*), intent(in) :: words                 !! what the message must say, each part before a `|`

      type(error_t), allocatable :: reason
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      if (allocated(error)) return
      call start_text(deck, system, y, reason)
      if (.not. allocated(reason)) then
         call set_error(error, exit_internal, "there is a start")
         return
      end if
      call check_equal(error, reason%code, exit_assembly, "exit code of '"//reason%message//"'")
      call check_parts(error, reason%message, words)
   end subroutine check_no_start

   !> A text says what it must.
   subroutine check_parts(error, text, words)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: text                    !! the text
      character(*), intent(in) :: words                   !! what it must say, each part before a `|`

      integer :: first, last

      first = 1
      do while (first <= len(words))
         last = first + index(words(first:), "|") - 2
         call check_true(error, index(text, words(first:last)) > 0, "'"//text//"' says '"//words(first:last)//"'")
         first = last + 2
      end do
   end subroutine check_parts

   !> A four-bar whose ground is longer than its links together.
   subroutine test_loop_that_cannot_close(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_no_start(error, "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl// &
                          "crank 1 0.1 0.1 0"//nl//"rod 1 0.1 0.4 0.1"//nl// &
                          "[points]"//nl//"name body xi[m] eta[m]"//nl//"left ground 0 0"//nl//"right ground 1 0"//nl// &
                          "heel crank -0.1 0"//nl//"throw crank 0.1 0"//nl//"big rod -0.2 0"//nl//"small rod 0.2 0"//nl// &
                          "[joint.revolute]"//nl//"name i j"//nl//"main left heel"//nl//"elbow throw big"//nl// &
                          "far small right"//nl// &
                          "[analysis.dynamic]"//nl//"end = 1 s", "cannot be assembled: joint '|' has a residual of 0.| m|")
   end subroutine test_loop_that_cannot_close

   !> A body on two pins that are too far apart by a part of 10^-7 of its size, large or tiny: fitted in least squares, each pin off
   !> by half of it, and refused where no misfit is allowed.
   subroutine test_almost_closed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(assembly_t) :: report
      type(mechanism_t) :: system
      character(:), allocatable :: deck
      real(wp), allocatable :: y(:)
      integer :: k

      deck = replace(pendulum("[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl//"tack nail toe"), "nail ground 0.8", &
                     "nail ground 0.80000008")
      do k = 1, 2
         call start_text(deck, system, y, error, report)
         if (allocated(error)) return
         call check_equal(error, size(report%set_aside), 1, "one row is not needed")
         call check_parts(error, report%misfit, "least-squares fit|'pin' is off by 4e-"//merge("5", "8", k == 1)// &
                          " mm|'tack' is off by 4e-"//merge("5", "8", k == 1)//" mm|")
         call check_no_start(error, "[scene]"//nl//"closing_tolerance = 1e-8"//nl//deck, "cannot be assembled|")
         deck = replace(deck, "[m]", "[mm]")
      end do
   end subroutine test_almost_closed

   !> A pendulum with more tables.
   function pendulum(tables) result(deck)
      character(*), intent(in) :: tables   !! joints and drivers
      character(:), allocatable :: deck    !! the deck

      deck = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"bob 2 0.05 0.4 0"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye bob -0.4 0"//nl// &
             "nail ground 0.8 0"//nl//"toe bob 0.4 0"//nl// &
             tables//nl//"[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s"
   end function pendulum

   !> Two speeds for one joint: in the middle each is off by half.
   subroutine test_contradictory_drivers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_no_start(error, pendulum("[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                                          "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"slow pin 3"//nl//"fast pin 4"), &
                          "no velocities satisfy the constraints|driver '|has a residual of 0.5 rad/s|")
   end subroutine test_contradictory_drivers

   !> Two angles for one joint: the positions cannot be assembled, in the middle each is off by half.
   subroutine test_contradictory_angles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_no_start(error, pendulum("[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                                          "[driver.angle]"//nl//"name joint angle[rad]"//nl//"one pin 0.1"//nl//"other pin 0.2"), &
                          "cannot be assembled|' has a residual of 0.05 rad|")
   end subroutine test_contradictory_angles

   !> Two equal drivers; a body held by two pins: rows depend on others, and the joints that share the load are named.
   subroutine test_redundant_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_redundancy(error, "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                            "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"one pin 3"//nl//"two pin 3", &
                            "1 of 4 rows are linearly dependent|reactions of 'one' 'two' are|")
      call check_redundancy(error, "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl//"tack nail toe", &
                            "1 of 4 rows are linearly dependent|reactions of 'pin' 'tack' are|")
      call check_redundancy(error, "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye", "")

   contains

      !> What is said of a pendulum with these joints.
      subroutine check_redundancy(error, tables, expected)
         type(error_t), allocatable, intent(inout) :: error   !! first failure
         character(*), intent(in) :: tables                   !! joints and drivers
         character(*), intent(in) :: expected                 !! parts of the text, each ended by a bar; blank: nothing is said

         type(assembly_t) :: report
         type(mechanism_t) :: system
         real(wp), allocatable :: y(:)

         call start_text(pendulum(tables), system, y, error, report)
         if (allocated(error)) return
         call check_true(error, system%linkage%solution%is_redundant .eqv. len(expected) > 0, "known to be redundant")
         if (len(expected) == 0) then
            call check_equal(error, redundancy_text(system, report), "", "nothing to say")
         else
            call check_parts(error, redundancy_text(system, report), expected)
         end if
      end subroutine check_redundancy

   end subroutine test_redundant_rows

   !> The surfaces of a clearance joint overlap at a given start: the joint and the depth.
   subroutine test_overlap(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      character(:), allocatable :: deck

      deck = slider_crank("start = given", "damped", "none", "clearance")
      ! the slider belongs at 156.1895 mm: 0.6895 mm off is 0.1895 mm into the bearing
      call check_no_start(error, replace(deck, slider_place, "155.5"), "initial overlap|'gudgeon'|0.0001895 m|")
      if (allocated(error)) return
      call start_text(replace(deck, slider_place, "155.7"), system, y, error)
   end subroutine test_overlap

end module test_start
