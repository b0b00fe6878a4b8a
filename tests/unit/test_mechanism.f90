!> Properties of the equations as a system of differential equations: stabilisation, turns, error scales.
module test_mechanism
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use floors, only: idle_part
   use kinds, only: two_pi, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, slider_crank, start_text, system_of_text
   use text, only: replace
   implicit none (type, external)
   private
   public :: run_test_mechanism

contains

   subroutine run_test_mechanism(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("stabilised_right_side", test_stabilised_right_side)
      call suite%test("whole_turns", test_whole_turns)
      call suite%test("error_scales", test_error_scales)
   end subroutine run_test_mechanism

   !> Baumgarte: Phi'' = -2 alpha Phi' - beta^2 Phi at a state that violates the constraints; none: Phi'' = 0.
   subroutine test_stabilised_right_side(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_gains("stabilise = none", 0.0_wp, 0.0_wp)
      call check_gains("stabilise = baumgarte", 5.0_wp, 5.0_wp)
      call check_gains("stabilise = baumgarte alpha=7s^-1", 7.0_wp, 5.0_wp)
      call check_gains("stabilise = baumgarte beta=11s^-1 alpha=7s^-1", 7.0_wp, 11.0_wp)

   contains

      !> A rotor held at its centre of mass: Phi = -r.
      subroutine check_gains(setting, alpha, beta)
         character(*), intent(in) :: setting  !! line of the deck
         real(wp), intent(in) :: alpha        !! gain on the rate [1/s]
         real(wp), intent(in) :: beta         !! gain on the violation [1/s]

         type(mechanism_t) :: system
         real(wp), allocatable :: y(:), ydot(:)
         integer :: status

         if (allocated(error)) return
         call system_of_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rotor 2 0.05 0 0"//nl// &
                             "[points]"//nl//"name body xi[m] eta[m]"//nl//"seat ground 0 0"//nl//"hub rotor 0 0"//nl// &
                             "[joint.revolute]"//nl//"name i j"//nl//"axle seat hub"//nl// &
                             "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s"//nl//setting, system, error)
         if (allocated(error)) return
         allocate (y(system%n), ydot(system%n), source=0.0_wp)
         y(1:2) = [0.01_wp, -0.02_wp]
         y(4:5) = [0.3_wp, 0.5_wp]
         call system%evaluate(0.0_wp, y, ydot, status)
         call check_equal(error, status, 0, "status")
         call check_close(error, ydot(4:5), -2.0_wp*alpha*y(4:5) - beta**2*y(1:2), 1.0e-13_wp, "acceleration with '"//setting//"'")
      end subroutine check_gains

   end subroutine test_stabilised_right_side

   !> A body that has made whole turns moves as before.
   subroutine test_whole_turns(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: turned(:), y(:), ydot(:), ydot_turned(:)
      integer :: status

      call start_text("[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
                      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]"//nl// &
                      "bob 2 0.05 0.4 0.3 0.6 3"//nl// &
                      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0.1 0.2"//nl//"eye bob -0.4 0"//nl// &
                      "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                      "[analysis.dynamic]"//nl//"end = 1 s", system, y, error)
      if (allocated(error)) return
      turned = y
      turned(3) = turned(3) + 5.0_wp*two_pi
      ydot = y
      ydot_turned = y
      call system%evaluate(0.0_wp, y, ydot, status)
      call system%evaluate(0.0_wp, turned, ydot_turned, status)
      call check_close(error, ydot_turned(1:6), ydot(1:6), 1.0e-13_wp, "derivative after five turns", relative=.true.)
   end subroutine test_whole_turns

   !> Error scales: the size of the bodies, one radian, these times the maximum rate; turns do not count.
   subroutine test_error_scales(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: scale(:), scale_turned(:), y(:)
      integer :: k

      ! the longest distance of a point of a body from its centre of mass; points of the ground do not count
      call start_text(replace(slider_crank("", "damped", "none", "clearance"), "[joint.revolute]", &
                              "wall ground 900 700"//nl//"[joint.revolute]"), system, y, error)
      if (allocated(error)) return
      call check_close(error, system%linkage%scales%length, 0.06_wp, 1.0e-15_wp, "size of the bodies")
      allocate (scale(system%n), scale_turned(system%n), source=0.0_wp)
      call system%weights(y, scale)
      do k = 1, 3
         call check_close(error, scale(3*k - 2:3*k), [0.06_wp, 0.06_wp, 1.0_wp], 1.0e-15_wp, "scales of coordinates")
         call check_close(error, scale(3*k + 7:3*k + 9), 5000.0_wp/60.0_wp*two_pi*[0.06_wp, 0.06_wp, 1.0_wp], 1.0e-9_wp, &
                          "scales of rates")
      end do
      y([3, 6, 9]) = y([3, 6, 9]) + 1.0e4_wp*two_pi
      call system%weights(y, scale_turned)
      call check_close(error, scale_turned(1:18), scale(1:18), 0.0_wp, "after many turns")
      ! at rest: a hundredth of the maximum rate so far, which the crank had
      system%linkage%scales%pace = 0.0_wp
      call system%follow_pace(y)
      call check_close(error, system%linkage%scales%pace, 5000.0_wp/60.0_wp*two_pi, 1.0e-9_wp, "pace of the crank")
      y(10:18) = 0.0_wp
      call system%follow_pace(y)
      call system%weights(y, scale)
      call check_close(error, scale(10:12), 0.01_wp*5000.0_wp/60.0_wp*two_pi*[0.06_wp, 0.06_wp, 1.0_wp], 1.0e-11_wp, "at rest")
      call check_true(error, minval(scale(1:18)) > 0.0_wp, "no scale is zero")
      ! a body without points: its radius of gyration, wherever it stands
      call check_size("3 -4", sqrt(0.05_wp/2.0_wp), .true.)
      call check_size("0 0", sqrt(0.05_wp/2.0_wp), .false.)

   contains

      !> Without points: size, and the characteristic rate of a stone at rest.
      subroutine check_size(place, expected, falls)
         character(*), intent(in) :: place    !! of the body
         real(wp), intent(in) :: expected     !! size of the bodies [m]
         logical, intent(in) :: falls         !! whether it has a weight

         type(mechanism_t) :: stone

         if (allocated(error)) return
         call system_of_text("[scene]"//nl//"gravity = 0 "//trim(merge("-9.81", "0    ", falls))//" m/s^2"//nl// &
                             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"stone 2 0.05 "//place//nl// &
                             "[analysis.dynamic]"//nl//"end = 1 s", stone, error)
         if (allocated(error)) return
         call check_close(error, stone%linkage%scales%length, expected, 0.0_wp, "size at "//place)
         ! from rest it moves its size in sqrt(size/g), a stone without weight never does
         call stone%begin_pace(0.0_wp, [(0.0_wp, k=1, stone%n)], 1.0_wp)
         call check_close(error, stone%linkage%scales%pace, merge(sqrt(9.81_wp/expected), idle_part, falls), 1.0e-14_wp, &
                          "pace at "//place, &
                          relative=.true.)
      end subroutine check_size

   end subroutine test_error_scales

end module test_mechanism
