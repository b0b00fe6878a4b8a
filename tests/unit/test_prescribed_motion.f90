!> Prescribed motion and inverse dynamics: rates against differences, loads against closed forms.
module test_prescribed_motion
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use inverse_dynamics, only: find_reactions
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, open_rows, singular, solve_positions, solve_rates, solved
   use scene_fixture, only: nl, system_of_text
   implicit none (type, external)
   private
   public :: run_test_prescribed_motion

   real(wp), parameter :: start(9) = [0.025_wp, 0.0_wp, 0.0_wp, 0.11_wp, 0.0_wp, 0.0_wp, 0.17_wp, 0.0_wp, 0.0_wp]
      !! slider-crank with crank and rod in line [m, m, rad]

   character(*), parameter :: crank = "[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[mm] y[mm]"//nl// &
      "crank 0.30 1e-4 25 0"//nl//"rod 0.21 2.5e-4 110 0"//nl//"slider 0.14 1e-4 170 0"//nl// &
      "[points]"//nl//"name body xi[mm] eta[mm]"//nl//"main ground 0 0"//nl//"heel crank -25 0"//nl//"throw crank 25 0"//nl// &
      "big rod -60 0"//nl//"small rod 60 0"//nl//"pin slider 0 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"main main heel"//nl//"big_end throw big"//nl//"gudgeon small pin"//nl// &
      "[joint.translational]"//nl//"name i j axis"//nl//"guide main pin x"//nl// &
      "[analysis.dynamic]"//nl//"end = 1 s"//nl//"coordinates = full"//nl  !! the book's slider-crank with ideal joints

contains

   subroutine run_test_prescribed_motion(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rates", test_rates)
      call suite%test("out_of_reach", test_out_of_reach)
      call suite%test("without_driver", test_without_driver)
      call suite%test("reactions", test_reactions)
      call suite%test("unbalanced", test_unbalanced)
   end subroutine run_test_prescribed_motion

   !> The slider-crank driven by an expression.
   subroutine driven(angle, system, error)
      character(*), intent(in) :: angle                      !! of the driver, an expression
      type(mechanism_t), intent(out) :: system           !! the system
      type(error_t), allocatable, intent(inout) :: error     !! what failed

      call system_of_text(crank//"[driver.angle]"//nl//"name joint angle"//nl//"motor main {"//angle//"}"//nl, system, error)
   end subroutine driven

   !> Velocities are the differences of positions, accelerations those of velocities.
   subroutine test_rates(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.0e-4_wp  ! of the differences, central [s]
      type(newton_t) :: newton
      type(mechanism_t) :: system
      real(wp) :: a(9, -1:1), q(9, -1:1), t, v(9, -1:1)
      integer :: before, k, n, outcome

      call driven("0.7rad + 3rad*sin(2*pi*1Hz*t)^2 + 2rad*t/1s", system, error)
      if (allocated(error)) return
      do n = 0, 20
         do k = -1, 1
            t = 0.05_wp*n + k*h
            q(:, k) = start
            before = max(k - 1, -1)
            if (n > 0 .or. k > -1) q(:, k) = q(:, before)
            call solve_positions(system%linkage, t, newton, q(:, k), outcome)
            call check_equal(error, outcome, solved, "outcome of positions")
            call solve_rates(system%linkage, t, newton, q(:, k), v(:, k), a(:, k), outcome)
            call check_equal(error, outcome, solved, "outcome of rates")
         end do
         call check_close(error, maxval(abs(system%linkage%rows%phi)), 0.0_wp, 1.0e-15_wp, "violation")
         call check_close(error, maxval(abs(system%linkage%solution%phi_dot)), 0.0_wp, 1.0e-13_wp, "rate of the violation")
         call check_close(error, (q(:, 1) - q(:, -1))/(2.0_wp*h), v(:, 0), 1.0e-3_wp, "velocities by differences")
         call check_close(error, (v(:, 1) - v(:, -1))/(2.0_wp*h), a(:, 0), 2.0e-2_wp, "accelerations by differences")
         q(:, -1) = q(:, 1)
      end do
      call check_true(error, maxval(abs(a(:, 0))) > 10.0_wp, "the motion is no slow one")
   end subroutine test_rates

   !> A rod too short for the crank: rows stay open, and it is said.
   subroutine test_out_of_reach(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(newton_t) :: newton
      type(mechanism_t) :: system
      real(wp) :: q(9)
      integer :: outcome

      call system_of_text(crank//"[driver.angle]"//nl//"name joint angle"//nl//"motor big_end {0rad}"//nl// &
                          "extra main {1rad}"//nl, system, error)
      if (allocated(error)) return
      q = start
      call solve_positions(system%linkage, 0.0_wp, newton, q, outcome)
      call check_equal(error, outcome, open_rows, "outcome")
   end subroutine test_out_of_reach

   !> Without a driver a position is found, but it is not the only one.
   subroutine test_without_driver(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(newton_t) :: newton
      type(mechanism_t) :: system
      real(wp) :: q(9)
      integer :: outcome

      call system_of_text(crank, system, error)
      if (allocated(error)) return
      q = start + 0.001_wp
      call solve_positions(system%linkage, 0.0_wp, newton, q, outcome)
      call check_equal(error, outcome, singular, "outcome")
      call check_close(error, maxval(abs(system%linkage%rows%phi)), 0.0_wp, 1.0e-15_wp, "violation")
   end subroutine test_without_driver

   !> Crank at a right angle and at rest: the motor bears the crank's weight and half of the rod's.
   subroutine test_reactions(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(newton_t) :: newton
      type(mechanism_t) :: system
      real(wp) :: q(9), rest(9), unbalanced
      integer :: outcome

      call driven("0rad", system, error)
      if (allocated(error)) return
      q = start
      rest = 0.0_wp
      call solve_positions(system%linkage, 0.0_wp, newton, q, outcome)
      call system%evaluate_loads(0.0_wp)
      call find_reactions(system%linkage, system%loading%g, rest, unbalanced)
      call check_close(error, unbalanced, 0.0_wp, 1.0e-15_wp, "what the joints do not take")
      ! lever arms of the weights: 25 mm of the crank; of the rod half its weight at the throw, 50 mm
      call check_close(error, motor_moment(system), 9.81_wp*(0.30_wp*0.025_wp + 0.5_wp*0.21_wp*0.050_wp), 1.0e-15_wp, "moment")
   end subroutine test_reactions

   !> Moment of the only driver on the crank.
   real(wp) function motor_moment(system) result(moment)
      type(mechanism_t), intent(in) :: system   !! the system, lambda set

      integer :: k

      moment = 0.0_wp
      do k = 1, size(system%linkage%joints)
         associate (set => system%linkage%joints(k)%set)
            if (set%is_driver) moment = -system%linkage%solution%lambda(set%first_row + 1)
         end associate
      end do
   end function motor_moment

   !> A pendulum held level by nothing: its weight's work on the free motion stays unbalanced.
   subroutine test_unbalanced(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp) :: a(3), unbalanced

      call system_of_text("[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
                          "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"bob 2 0.1 0.4 0"//nl// &
                          "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl//"eye bob -0.4 0"//nl// &
                          "[joint.revolute]"//nl//"name i j"//nl//"pin hook eye"//nl// &
                          "[analysis.dynamic]"//nl//"end = 1 s", system, error)
      if (allocated(error)) return
      a = 0.0_wp
      call set_level(system)
      call find_reactions(system%linkage, system%loading%g, a, unbalanced)
      ! the size of the body is 0.4 m, so the free motion, scaled, is (0, 1, 1)/sqrt(2)
      call check_close(error, unbalanced, 2.0_wp*9.81_wp*0.4_wp/sqrt(2.0_wp), 1.0e-14_wp, "load out of balance")
      ! falling freely: angular acceleration -m g l / (I + m l^2)
      a(3) = -2.0_wp*9.81_wp*0.4_wp/(0.1_wp + 2.0_wp*0.4_wp**2)
      a(2) = 0.4_wp*a(3)
      call find_reactions(system%linkage, system%loading%g, a, unbalanced)
      call check_close(error, unbalanced, 0.0_wp, 1.0e-14_wp, "load out of balance when falling")
   end subroutine test_unbalanced

   !> Rows and loads of the level pendulum.
   subroutine set_level(system)
      type(mechanism_t), intent(inout) :: system   !! rows and loads are set

      type(newton_t) :: newton
      real(wp) :: q(3)
      integer :: outcome

      q = [0.4_wp, 0.0_wp, 0.0_wp]
      call solve_positions(system%linkage, 0.0_wp, newton, q, outcome)
      call system%evaluate_loads(0.0_wp)
   end subroutine set_level

end module test_prescribed_motion
