!> Laws that rise: derivatives against differences, symmetry, and bounds that hold all that is between.
module test_rise_laws
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: wp
   use rise_laws, only: bound_rise, breaks_of, is_smooth_rise, number_of_rise, rise_names, rise_values
   implicit none (type, external)
   private
   public :: run_test_rise_laws

contains

   !> Register the tests.
   subroutine run_test_rise_laws(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("derivatives_and_symmetry", test_derivatives)
      call suite%test("breaks", test_breaks)
      call suite%test("bounds", test_bounds)
   end subroutine run_test_rise_laws

   !> Slopes are those of differences beside the breaks; s(1 - u) = 1 - s(u).
   subroutine test_derivatives(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.0e-5_wp
      type(random_t) :: random
      real(wp) :: above(3), below(3), s(3), u
      integer :: k, law

      do law = 1, size(rise_names)
         call check_true(error, number_of_rise(trim(rise_names(law))) == law, trim(rise_names(law)))
         if (allocated(error)) return
         do k = 1, 200
            u = random%between(0.01_wp, 0.99_wp)
            if (minval(abs(u - breaks_of(law))) < 2.0_wp*h) cycle
            s = rise_values(law, u)
            above = rise_values(law, u + h)
            below = rise_values(law, u - h)
            call check_close(error, s(2:3), (above(1:2) - below(1:2))/(2.0_wp*h), 1.0e-7_wp, trim(rise_names(law))//" slopes")
            if (allocated(error)) return
            below = rise_values(law, 1.0_wp - u)
            call check_close(error, [below(1), below(2), below(3)], [1.0_wp - s(1), s(2), -s(3)], 1.0e-12_wp, &
                             trim(rise_names(law))//" symmetry")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_derivatives

   !> At breaks value and slope have no jump; nor has the second derivative of a smooth law, and at the ends it is then zero.
   subroutine test_breaks(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.0e-9_wp
      real(wp), allocatable :: breaks(:)
      integer :: k, law, n

      do law = 1, size(rise_names)
         breaks = breaks_of(law)
         n = merge(3, 2, is_smooth_rise(law))
         do k = 1, size(breaks)
            associate (above => rise_values(law, breaks(k) + h), below => rise_values(law, breaks(k) - h))
               call check_close(error, above(:n), below(:n), 1.0e-6_wp, trim(rise_names(law)))
            end associate
            if (allocated(error)) return
         end do
         call check_close(error, rise_values(law, -1.0_wp), [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, trim(rise_names(law)))
         if (.not. allocated(error)) call check_close(error, rise_values(law, 1.0_wp), [1.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, &
                                                      trim(rise_names(law)))
         if (allocated(error)) return
      end do
   end subroutine test_breaks

   !> What is between the ends of an interval is within its bounds, and these are no wider than what is there.
   subroutine test_bounds(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n_look = 400
      type(random_t) :: random
      real(wp) :: f(2, 3), maximum(3), minimum(3), s(3), u(2)
      integer :: i, k, law

      do law = 1, size(rise_names)
         do k = 1, 100
            u = random%vector(2, -0.3_wp, 1.3_wp)
            u = [minval(u), maxval(u)]
            f = bound_rise(law, u)
            minimum = huge(1.0_wp)
            maximum = -huge(1.0_wp)
            do i = 0, n_look
               s = rise_values(law, u(1) + (u(2) - u(1))*real(i, wp)/real(n_look, wp))
               minimum = min(minimum, s)
               maximum = max(maximum, s)
            end do
            call check_true(error, all(f(1, :) <= minimum) .and. all(f(2, :) >= maximum), trim(rise_names(law))//" within")
            if (allocated(error)) return
            call check_close(error, [f(1, :2), f(2, :2)], [minimum(:2), maximum(:2)], 0.01_wp, trim(rise_names(law))//" tight")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_bounds

end module test_rise_laws
