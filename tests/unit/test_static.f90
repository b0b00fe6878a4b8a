!> Tangent stiffness and natural frequencies against closed forms; the descent from many starts.
module test_static
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, pi, wp
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, solve_positions
   use scene_fixture, only: nl, system_of_text
   use static_problem, only: balance_t, evaluate_balance, free_stiffness, square_frequencies
   use static_relaxation, only: relax
   implicit none (type, external)
   private
   public :: run_test_static

   real(wp), parameter :: g = 9.81_wp  !! acceleration of free fall [m/s^2]

   character(*), parameter :: rods = "[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl// &
      "upper 1 {1 kg*(1 m)^2/12} 0 -0.5 -90"//nl//"lower 1 {1 kg*(1 m)^2/12} 0 -1.5 -90"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"u_a upper -0.5 0"//nl//"u_b upper 0.5 0"//nl// &
      "l_a lower -0.5 0"//nl//"[joint.revolute]"//nl//"name i j"//nl//"top hook u_a"//nl//"knee u_b l_a"//nl// &
      "[analysis.dynamic]"//nl//"end = 1 s"  !! two uniform rods of 1 m and 1 kg

contains

   subroutine run_test_static(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("double_pendulum_frequencies", test_double_pendulum_frequencies)
      call suite%test("tilted_stiffness", test_tilted_stiffness)
      call suite%test("descent_from_anywhere", test_descent_from_anywhere)
   end subroutine run_test_static

   !> Two uniform rods of length l: omega^2 = (3 -+ 6/sqrt(7)) g/l hanging, minus that upright.
   subroutine test_double_pendulum_frequencies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(balance_t) :: balance
      type(mechanism_t) :: system
      real(wp) :: exact(2), q(6)

      call system_of_text(rods, system, error)
      if (allocated(error)) return
      exact = (3.0_wp + 6.0_wp/sqrt(7.0_wp)*[-1.0_wp, 1.0_wp])*g
      q = [0.0_wp, -0.5_wp, -0.5_wp*pi, 0.0_wp, -1.5_wp, -0.5_wp*pi]
      call evaluate_balance(system, q, balance)
      call check_close(error, norm2(balance%load), 0.0_wp, 1.0e-14_wp, "balance, hanging")
      call free_stiffness(system, q, balance)
      call check_close(error, square_frequencies(system, balance), exact, 1.0e-6_wp*g, "hanging")
      q = -q
      call evaluate_balance(system, q, balance)
      call free_stiffness(system, q, balance)
      call check_close(error, square_frequencies(system, balance), -exact([2, 1]), 1.0e-6_wp*g, "upright")
   end subroutine test_double_pendulum_frequencies

   !> One rod away from its equilibrium: load out of balance and stiffness along the free motion.
   subroutine test_tilted_stiffness(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(balance_t) :: balance
      type(mechanism_t) :: system
      real(wp) :: angle, q(3)
      integer :: k

      call system_of_text("[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
                          "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rod 1 {1 kg*(1 m)^2/12} 0.5 0"//nl// &
                          "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye rod -0.5 0"//nl// &
                          "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                          "[analysis.dynamic]"//nl//"end = 1 s", system, error)
      if (allocated(error)) return
      do k = -3, 3
         angle = 0.4_wp*k
         q = [0.5_wp*cos(angle), 0.5_wp*sin(angle), angle]
         call evaluate_balance(system, q, balance)
         call check_close(error, norm2(balance%load), g*0.5_wp*cos(angle)/sqrt(2.0_wp), 1.0e-13_wp, "load out of balance")
         call free_stiffness(system, q, balance)
         call check_equal(error, size(balance%stiffness), 1, "freedoms")
         ! the pin pulls g sin(angle) along the rod at an arm of 0.5 m; the free motion is (-sin, cos, 1)/sqrt(2)
         call check_close(error, balance%stiffness(1), -0.25_wp*g*sin(angle), 1.0e-7_wp*g, "stiffness")
      end do
   end subroutine test_tilted_stiffness

   !> Two rods from any position end hanging.
   subroutine test_descent_from_anywhere(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(balance_t) :: balance
      type(newton_t) :: newton
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp) :: lower, q(6), upper
      integer :: k, outcome, steps
      logical :: is_settled

      call system_of_text(rods, system, error)
      if (allocated(error)) return
      random%state = 5_i8
      do k = 1, 40
         upper = random%between(-pi, pi)
         lower = random%between(-pi, pi)
         q(1:3) = [0.5_wp*cos(upper), 0.5_wp*sin(upper), upper]
         q(4:6) = [cos(upper) + 0.5_wp*cos(lower), sin(upper) + 0.5_wp*sin(lower), lower]
         call solve_positions(system%linkage, 0.0_wp, newton, q, outcome)
         steps = 0
         call relax(system, 1.0e-12_wp, 100, q, balance, steps, is_settled)
         call check_true(error, is_settled, "it settles")
         call check_close(error, q([1, 2, 4, 5]), [0.0_wp, -0.5_wp, 0.0_wp, -1.5_wp], 1.0e-11_wp, "where it hangs")
         call check_true(error, steps < 40, "few steps")
      end do
   end subroutine test_descent_from_anywhere

end module test_static
