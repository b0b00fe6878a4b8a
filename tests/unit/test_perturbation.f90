!> Perturbed starts: what rounding does to one.
module test_perturbation
   use bodies, only: bodies_t
   use check, only: check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use perturbation, only: random_shift, shift_t
   use planar_coordinates, only: new_planar_coordinates, planar_coordinates_t
   use spatial_coordinates, only: new_spatial_coordinates, spatial_coordinates_t
   implicit none (type, external)
   private
   public :: run_test_perturbation

   real(wp), parameter :: part = 1.0e-3_wp  !! maximum part of a coordinate by which it is moved [1]

contains

   !> Register the tests.
   subroutine run_test_perturbation(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("round_off_in_the_plane", test_in_the_plane)
      call suite%test("round_off_in_space", test_in_space)
      call suite%test("one_on_the_other", test_one_on_the_other)
   end subroutine run_test_perturbation

   !> Two bodies.
   subroutine new_pair(bodies)
      type(bodies_t), intent(out) :: bodies  !! of 1 kg and 1 kg.m^2 each

      bodies%n = 2
      bodies%mass = [1.0_wp, 1.0_wp]
      bodies%inertia = [1.0_wp, 1.0_wp]
   end subroutine new_pair

   !> Whether numbers are moved, each by no more than its part, and what is zero is not.
   pure logical function are_rounded(x, from)
      real(wp), intent(in) :: x(:)      !! (n) the numbers [any]
      real(wp), intent(in) :: from(:)   !! (n) as they were [any]

      are_rounded = all(abs(x - from) <= part*abs(from)) .and. all(x /= from .or. from == 0.0_wp)
   end function are_rounded

   subroutine test_in_the_plane(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: q_0(6) = [0.3_wp, 0.0_wp, 2.0_wp, -5.0_wp, 1.0e-6_wp, 0.0_wp]
      real(wp), parameter :: v_0(6) = [0.0_wp, 7.0_wp, 0.0_wp, 0.0_wp, -2.0_wp, 100.0_wp]
      type(bodies_t) :: bodies
      type(planar_coordinates_t) :: coordinates
      type(shift_t) :: shift
      real(wp) :: q(6), v(6)

      call new_pair(bodies)
      coordinates = new_planar_coordinates()
      shift = random_shift(bodies, coordinates, 1, 1, 0.0_wp, 0.0_wp)
      call shift%round_off(coordinates, bodies%n, part)
      q = q_0
      v = v_0
      call shift%move(coordinates, bodies%n, q, v)
      call check_true(error, are_rounded(q, q_0), "coordinates move by a part of themselves")
      call check_true(error, are_rounded(v, v_0), "so do rates")
   end subroutine test_in_the_plane

   subroutine test_in_space(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: q_0(14) = [1.0_wp, 2.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                                        0.0_wp, 0.0_wp, 3.0_wp, 0.5_wp, 0.5_wp, -0.5_wp, 0.5_wp]
      real(wp), parameter :: v_0(12) = [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                                        3.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -1.0_wp, 9.0_wp]
      type(bodies_t) :: bodies
      type(spatial_coordinates_t) :: coordinates
      type(shift_t) :: shift
      real(wp) :: q(14), v(12), x(6, 2)

      call new_pair(bodies)
      coordinates = new_spatial_coordinates()
      shift = random_shift(bodies, coordinates, 1, 1, 0.0_wp, 0.0_wp)
      call shift%round_off(coordinates, bodies%n, part)
      q = q_0
      v = v_0
      call shift%move(coordinates, bodies%n, q, v)
      call check_true(error, are_rounded(v, v_0), "rates move by a part of themselves")
      call coordinates%difference(bodies%n, q_0, q, x)
      call check_true(error, all(abs(x(4:, 1)) <= 1.0e-15_wp), "a body along the axes stays so")
      call check_true(error, all(abs(x(4:, 2)) <= 2.0_wp*part) .and. any(abs(x(4:, 2)) > 0.01_wp*part), "another one turns")
   end subroutine test_in_space

   subroutine test_one_on_the_other(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: q_0(6) = [0.3_wp, 0.0_wp, 2.0_wp, -5.0_wp, 1.0_wp, 0.0_wp]
      type(bodies_t) :: bodies
      type(planar_coordinates_t) :: coordinates
      type(shift_t) :: both, one, other
      real(wp) :: q(6, 3), v(6, 3)
      integer :: k

      call new_pair(bodies)
      coordinates = new_planar_coordinates()
      one = random_shift(bodies, coordinates, 1, 2, 0.1_wp, 0.1_wp)
      other = random_shift(bodies, coordinates, 1, 1, 0.0_wp, 0.0_wp)
      call other%round_off(coordinates, bodies%n, part)
      both = one
      call both%round_off(coordinates, bodies%n, part)
      q = spread(q_0, 2, 3)
      v = 0.0_wp
      call one%move(coordinates, bodies%n, q(:, 1), v(:, 1))
      call other%move(coordinates, bodies%n, q(:, 2), v(:, 2))
      call both%move(coordinates, bodies%n, q(:, 3), v(:, 3))
      call check_true(error, all([(abs(q(k, 3) - q(k, 1) - q(k, 2) + q_0(k)) < 1.0e-15_wp*6.0_wp, k=1, 6)]), "positions of both")
      call check_true(error, all(v(:, 3) == v(:, 1)), "rates of both")
   end subroutine test_one_on_the_other

end module test_perturbation
