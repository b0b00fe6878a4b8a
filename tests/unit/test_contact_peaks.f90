!> Which maxima of a force are worth a search.
module test_contact_peaks
   use check, only: check_true, suite_t
   use contact_peaks, only: may_exceed, trend_t
   use errors, only: error_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_contact_peaks

contains

   subroutine run_test_contact_peaks(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("a_parabola_may_exceed_what_it_does", test_parabola)
      call suite%test("half_sines_are_never_missed", test_sines)
   end subroutine run_test_contact_peaks

   !> 0.9 at the ends, rates of 0.2 and -0.2 1/s over 2 s: 1 in the middle.
   subroutine test_parabola(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(trend_t) :: left, right

      left = trend_t(0.9_wp, 0.2_wp)
      right = trend_t(0.9_wp, -0.2_wp)
      call check_true(error, may_exceed(left, right, 2.0_wp, 0.95_wp), "less than its maximum")
      call check_true(error, may_exceed(left, right, 2.0_wp, 1.05_wp), "not far above it")
      call check_true(error, .not. may_exceed(left, right, 2.0_wp, 1.2_wp), "far above it")
      call check_true(error, may_exceed(left, right, 20.0_wp, 1.2_wp), "in a longer step it is higher")
      call check_true(error, may_exceed(left, right, 20.0_wp, 9.0_wp), "and what is far below it tells little")
   end subroutine test_parabola

   !> Powers of a half sine as forces of contact are, over steps of up to four fifths of an impact.
   subroutine test_sines(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: a, b, power
      integer :: i, k, m

      do m = 0, 2
         power = 1.0_wp + 0.5_wp*m
         do i = 0, 15
            a = 0.1_wp*i
            do k = 0, 15
               b = acos(-1.0_wp) - 0.1_wp*k
               call check_true(error, may_exceed(at(a), at(b), b - a, 0.999_wp), "the maximum is 1")
            end do
         end do
      end do

   contains

      !> The force and its rate.
      pure type(trend_t) function at(t)
         real(wp), intent(in) :: t  !! time [s]

         at = trend_t(sin(t)**power, power*sin(t)**(power - 1.0_wp)*cos(t))
      end function at

   end subroutine test_sines

end module test_contact_peaks
