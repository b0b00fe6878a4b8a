!> The method that chooses: explicit to the bit where nothing is stiff, implicit where stability keeps explicit steps short, and
!> back again.
module test_auto
   use auto, only: auto_t, order_8_up_to
   use check, only: check_close, check_equal, check_true, suite_t
   use dop853, only: dop853_t
   use errors, only: error_t
   use integrator, only: advance_event
   use kinds, only: wp
   use ode_examples, only: kepler_t, new_kepler, particles_t
   use radau, only: radau_t
   use stiff_examples, only: follower_t, n_most, new_follower, robertson_t, run_from, van_der_pol_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_auto

contains

   subroutine run_test_auto(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("to_the_bit_the_explicit_method", test_bits)
      call suite%test("follows_a_sine_however_stiff", test_sine)
      call suite%test("goes_over_and_back", test_back)
      call suite%test("leaps_of_van_der_pol", test_van_der_pol)
      call suite%test("reaction_of_robertson", test_robertson)
      call suite%test("springs_that_swing_stay_explicit", test_spring)
      call suite%test("fixed_steps_are_explicit", test_fixed)
   end subroutine run_test_auto

   !> An ellipse of Kepler, at tolerances on both sides of that where the order changes.
   subroutine test_bits(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(auto_t) :: clearance_joints, tight
      type(dop853_t) :: eighth
      type(verner_t) :: sixth
      real(wp) :: y(4)

      call new_kepler(0.5_wp, system, y)
      clearance_joints%controls%tolerance = 1.01_wp*order_8_up_to
      sixth%controls%tolerance = clearance_joints%controls%tolerance
      tight%controls%tolerance = order_8_up_to
      eighth%controls%tolerance = tight%controls%tolerance
      call run_from(clearance_joints, system, y, 20.0_wp, error)
      call run_from(sixth, system, y, 20.0_wp, error)
      call run_from(tight, system, y, 20.0_wp, error)
      call run_from(eighth, system, y, 20.0_wp, error)
      call check_true(error, all(abs(clearance_joints%step%y1 - sixth%step%y1) <= 0.0_wp), "order 6")
      call check_true(error, all(abs(tight%step%y1 - eighth%step%y1) <= 0.0_wp), "order 8")
      call check_true(error, clearance_joints%count%n_evaluations == sixth%count%n_evaluations, "evaluations of order 6")
      call check_true(error, tight%count%n_evaluations == eighth%count%n_evaluations, "evaluations of order 8")
      call check_true(error, clearance_joints%is_explicit() .and. clearance_joints%choice%n_change == 0, "no change")
   end subroutine test_bits

   !> However fast the decay, evaluations stay bounded and the error within the tolerance's reach.
   subroutine test_sine(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(follower_t) :: system
      type(auto_t), allocatable :: method
      integer :: k

      do k = 3, 9, 2
         allocate (method)
         call new_follower(10.0_wp**k, -1.0_wp, huge(1.0_wp), system)
         method%controls%tolerance = 1.0e-7_wp
         call run_from(method, system, [0.0_wp, 0.0_wp, 1.0_wp], 10.0_wp, error)
         call check_close(error, method%step%y1(1), sin(10.0_wp), 1.0e-6_wp, "the sine")
         call check_true(error, method%count%n_evaluations < 12000, "evaluations")
         call check_true(error, .not. method%is_explicit(), "implicit")
         deallocate (method)
      end do
   end subroutine test_sine

   !> Stiff from 2 s to 4 s only: explicit, implicit, explicit.
   subroutine test_back(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(follower_t) :: system
      type(auto_t) :: method

      call new_follower(1.0e5_wp, 2.0_wp, 4.0_wp, system)
      method%controls%tolerance = 1.0e-9_wp
      call run_from(method, system, [0.0_wp, 0.0_wp, 1.0_wp], 40.0_wp, error)
      call check_close(error, method%step%y1(1), sin(40.0_wp), 1.0e-6_wp, "the sine")
      call check_true(error, method%is_explicit(), "explicit at the end")
      associate (choice => method%choice)
         call check_true(error, choice%n_change >= 2 .and. choice%n_change <= 4, "over and back")
         call check_close(error, choice%t_change(1), 2.0_wp, 0.1_wp, "when it becomes stiff")
         call check_true(error, choice%t_change(1) > 2.0_wp, "not before it is stiff")
         call check_true(error, choice%t_change(2) > 4.0_wp, "not while it is stiff")
         call check_true(error, choice%t_change(2) < 20.0_wp, "when it no longer is")
         call check_true(error, choice%product(1) > 2.0_wp .and. choice%product(1) < 7.0_wp, "h lambda")
      end associate
   end subroutine test_back

   !> Two swings with mu = 1000: explicit steps alone would be a hundred times as many. The reference is Radau at a tight tolerance.
   subroutine test_van_der_pol(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(van_der_pol_t) :: system
      type(auto_t) :: method
      type(radau_t) :: reference

      system%n = 2
      system%n_position = 0
      system%mu = 1000.0_wp
      method%controls%tolerance = 1.0e-7_wp
      reference%controls%tolerance = 1.0e-11_wp
      call run_from(method, system, [2.0_wp, 0.0_wp], 2000.0_wp, error)
      call run_from(reference, system, [2.0_wp, 0.0_wp], 2000.0_wp, error)
      call check_close(error, method%step%y1(1), reference%step%y1(1), 1.0e-4_wp, "place")
      call check_true(error, method%choice%n_step > 100, "implicit steps")
      call check_true(error, method%count%n_evaluations < 60000, "evaluations")
   end subroutine test_van_der_pol

   !> y at t = 40 of Hairer and Wanner, table of section IV.10: 0.7158270688, 0.9185534765e-5, 0.2841637457.
   subroutine test_robertson(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(robertson_t) :: system
      type(auto_t) :: method

      system%n = 3
      system%n_position = 0
      method%controls%tolerance = 1.0e-10_wp
      call run_from(method, system, [1.0_wp, 0.0_wp, 0.0_wp], 40.0_wp, error)
      call check_close(error, method%step%y1(1), 0.7158270688_wp, 1.0e-7_wp, "first")
      call check_close(error, method%step%y1(2), 0.9185534765e-5_wp, 1.0e-11_wp, "second")
      call check_close(error, sum(method%step%y1), 1.0_wp, 1.0e-10_wp, "sum")
      call check_true(error, .not. method%is_explicit(), "implicit")
      call check_true(error, method%count%n_evaluations < 40000, "evaluations")
   end subroutine test_robertson

   !> A spring that swings: its steps are as long as the accuracy allows, however stiff it is.
   subroutine test_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(auto_t) :: method
      integer :: k, status

      call new_particle(1.0e8_wp, system)
      method%controls%tolerance = 1.0e-8_wp
      call method%start(system, 0.0_wp, [0.5_wp, 0.0_wp], 0.01_wp, status)
      do k = 1, n_most
         if (status < 0 .or. method%t >= 0.01_wp) exit
         if (status == advance_event) call method%restart(system, 0.0_wp, status)
         call method%advance(system, 0.01_wp, status)
      end do
      call check_close(error, method%step%y1(1), 0.5_wp*cos(100.0_wp), 1.0e-5_wp, "place")
      call check_true(error, method%choice%n_change == 0, "no change")
   end subroutine test_spring

   !> A particle on a spring, with a wall at 0.9.
   subroutine new_particle(stiffness, system)
      real(wp), intent(in) :: stiffness           !! per mass [1/s^2]
      type(particles_t), intent(out) :: system    !! the system

      system%n = 2
      system%n_position = 1
      system%n_event = 1
      system%pull = [0.0_wp]
      system%stiffness = [stiffness]
      system%subject = [1]
      system%wall = [0.9_wp]
      system%side = [1.0_wp]
   end subroutine new_particle

   !> Fixed steps are those of order 6, however stiff it is.
   subroutine test_fixed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(follower_t) :: system
      type(auto_t) :: method
      type(verner_t) :: sixth

      call new_follower(100.0_wp, -1.0_wp, huge(1.0_wp), system)
      method%controls%fixed_step = 0.03_wp
      sixth%controls%fixed_step = 0.03_wp
      call run_from(method, system, [0.0_wp, 0.0_wp, 1.0_wp], 6.0_wp, error)
      call run_from(sixth, system, [0.0_wp, 0.0_wp, 1.0_wp], 6.0_wp, error)
      call check_true(error, abs(method%step%y1(1) - sixth%step%y1(1)) <= 0.0_wp, "the same")
      call check_true(error, method%is_explicit(), "explicit")
   end subroutine test_fixed

end module test_auto
