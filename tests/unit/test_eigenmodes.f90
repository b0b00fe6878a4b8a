!> Branches of eigenvalues, frequencies and damping ratios.
module test_eigenmodes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use check, only: check_close, check_equal, check_true, suite_t
   use eigenmodes, only: follow_branches, growth_of
   use errors, only: error_t
   use kinds, only: two_pi, wp
   use modes_results, only: frequency_of, ratio_of
   implicit none (type, external)
   private
   public :: run_test_eigenmodes

contains

   !> Register the tests.
   subroutine run_test_eigenmodes(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("branches_cross", test_branches_cross)
      call suite%test("branches_start_and_end", test_branches_start_and_end)
      call suite%test("numbers_of_an_eigenvalue", test_numbers_of_an_eigenvalue)
   end subroutine run_test_eigenmodes

   !> The nearest ones are one branch, whatever their order.
   subroutine test_branches_cross(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: branch(3), n_branch

      n_branch = 3
      call follow_branches([(0.0_wp, 1.0_wp), (0.0_wp, 2.0_wp), (-1.0_wp, 0.0_wp)], [2, 1, 3], &
                           [(-1.1_wp, 0.0_wp), (0.0_wp, 1.9_wp), (0.0_wp, 1.2_wp)], branch, n_branch)
      call check_true(error, all(branch == [3, 1, 2]), "branches of the nearest")
      call check_equal(error, n_branch, 3, "no new branch")
   end subroutine test_branches_cross

   !> An eigenvalue without a partner starts a branch; a partner without one ends.
   subroutine test_branches_start_and_end(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: branch(2), n_branch, none(0), one(1)

      n_branch = 5
      call follow_branches([(0.0_wp, 4.0_wp)], [5], [(0.0_wp, 1.0_wp), (0.0_wp, 4.1_wp)], branch, n_branch)
      call check_true(error, all(branch == [6, 5]), "a new branch")
      call follow_branches([(0.0_wp, 1.0_wp), (0.0_wp, 4.1_wp)], branch, [(0.0_wp, 1.1_wp)], one, n_branch)
      call check_true(error, all(one == [6]), "a branch that ends")
      call follow_branches([complex(wp) ::], none, [(0.0_wp, 1.1_wp)], one, n_branch)
      call check_true(error, all(one == [7]) .and. n_branch == 7, "branches of the first value")
   end subroutine test_branches_start_and_end

   !> Frequency, damping ratio, and the maximum real part.
   subroutine test_numbers_of_an_eigenvalue(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: growth
      integer :: which

      call check_close(error, frequency_of((-3.0_wp, 4.0_wp)), 5.0_wp/two_pi, 1.0e-15_wp, "natural frequency")
      call check_close(error, ratio_of((-3.0_wp, 4.0_wp)), 0.6_wp, 1.0e-15_wp, "damping ratio")
      call check_close(error, frequency_of((2.0_wp, 0.0_wp)), 0.0_wp, 0.0_wp, "frequency of a real eigenvalue")
      call check_close(error, ratio_of((2.0_wp, 0.0_wp)), -1.0_wp, 0.0_wp, "damping ratio of one that grows")
      call check_true(error, ieee_is_nan(ratio_of((0.0_wp, 0.0_wp))), "no damping ratio of zero")
      call growth_of([(-1.0_wp, 2.0_wp), (-0.5_wp, 0.0_wp), (-2.0_wp, 0.0_wp)], growth, which)
      call check_close(error, growth, -0.5_wp, 0.0_wp, "maximum real part")
      call check_equal(error, which, 2, "its place")
   end subroutine test_numbers_of_an_eigenvalue

end module test_eigenmodes
