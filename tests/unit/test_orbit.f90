!> Floquet multipliers and the test functions of bifurcations on matrices with known eigenvalues.
module test_orbit
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use multipliers, only: find_multipliers, solve, test_flip, test_one, test_torus
   implicit none (type, external)
   private
   public :: run_test_orbit

contains

   !> Register the tests.
   subroutine run_test_orbit(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_of_multipliers", test_order)
      call suite%test("test_functions", test_functions)
      call suite%test("linear_equations", test_equations)
   end subroutine run_test_orbit

   !> A block matrix with the eigenvalues radius*exp(+-i angle) and x, turned by a shear.
   pure function matrix_of(radius, angle, x) result(a)
      real(wp), intent(in) :: radius, angle, x   ! [1, rad, 1]
      real(wp) :: a(3, 3)                        ! (3, 3) [1]

      real(wp), parameter :: shear(3, 3) = reshape([1, 0, 0, 2, 1, 0, -1, 3, 1]*1.0_wp, [3, 3])
      real(wp), parameter :: back(3, 3) = reshape([1, 0, 0, -2, 1, 0, 7, -3, 1]*1.0_wp, [3, 3])

      a = 0.0_wp
      a(1, :2) = radius*[cos(angle), -sin(angle)]
      a(2, :2) = radius*[sin(angle), cos(angle)]
      a(3, 3) = x
      a = matmul(shear, matmul(a, back))
   end function matrix_of

   !> Descending moduli; of a pair the positive imaginary part first.
   subroutine test_order(error)
      type(error_t), allocatable, intent(out) :: error  ! what failed

      complex(wp) :: mu(3)

      mu = find_multipliers(matrix_of(0.5_wp, 1.0_wp, -0.9_wp))
      call check_close(error, mu%re, [-0.9_wp, 0.5_wp*cos(1.0_wp), 0.5_wp*cos(1.0_wp)], 1.0e-13_wp, "real parts")
      if (allocated(error)) return
      call check_close(error, mu%im, [0.0_wp, 0.5_wp*sin(1.0_wp), -0.5_wp*sin(1.0_wp)], 1.0e-13_wp, "imaginary parts")
   end subroutine test_order

   !> Each function changes its sign where its multiplier passes, and no other does.
   subroutine test_functions(error)
      type(error_t), allocatable, intent(out) :: error  ! what failed

      complex(wp), dimension(3) :: flip, inside, one, torus

      inside = find_multipliers(matrix_of(0.9_wp, 1.0_wp, 0.2_wp))
      one = find_multipliers(matrix_of(0.9_wp, 1.0_wp, 1.1_wp))
      flip = find_multipliers(matrix_of(0.9_wp, 1.0_wp, -1.1_wp))
      torus = find_multipliers(matrix_of(1.1_wp, 1.0_wp, 0.2_wp))
      call check_true(error, test_one(inside)*test_one(one) < 0.0_wp .and. test_one(inside)*test_one(flip) > 0.0_wp .and. &
                      test_one(inside)*test_one(torus) > 0.0_wp, "a multiplier through 1")
      if (allocated(error)) return
      call check_true(error, test_flip(inside)*test_flip(flip) < 0.0_wp .and. test_flip(inside)*test_flip(one) > 0.0_wp .and. &
                      test_flip(inside)*test_flip(torus) > 0.0_wp, "a multiplier through -1")
      if (allocated(error)) return
      call check_true(error, test_torus(inside)*test_torus(torus) < 0.0_wp .and. test_torus(inside)*test_torus(one) > 0.0_wp .and. &
                      test_torus(inside)*test_torus(flip) > 0.0_wp, "a pair through the unit circle")
   end subroutine test_functions

   !> A system with a known solution, and a singular one.
   subroutine test_equations(error)
      type(error_t), allocatable, intent(out) :: error  ! what failed

      real(wp) :: a(3, 3), x(3)
      integer :: info

      a = matrix_of(0.5_wp, 1.0_wp, -0.9_wp)
      call solve(a, matmul(a, [1.0_wp, -2.0_wp, 3.0_wp]), x, info)
      call check_close(error, x, [1.0_wp, -2.0_wp, 3.0_wp], 1.0e-13_wp, "solution")
      if (allocated(error)) return
      a(:, 2) = 0.0_wp
      call solve(a, [1.0_wp, 1.0_wp, 1.0_wp], x, info)
      call check_true(error, info /= 0, "a singular matrix is told")
   end subroutine test_equations

end module test_orbit
