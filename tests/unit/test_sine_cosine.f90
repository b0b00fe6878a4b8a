!> Tests of sine and cosine found together.
module test_sine_cosine
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use kinds, only: eps, wp
   implicit none (type, external)
   private
   public :: run_test_sine_cosine

contains

   include "../../src/foundation/numerics/sine_cosine.inc"

   !> Register the tests.
   subroutine run_test_sine_cosine(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("published", test_published)
      call suite%test("library", test_library)
      call suite%test("zeros", test_zeros)
      call suite%test("beyond", test_beyond)
   end subroutine run_test_sine_cosine

   !> Numbers of tables, one of each quadrant and both signs. Abramowitz and Stegun (1964), table 4.6.
   subroutine test_published(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: angle(6) = [0.5_wp, 1.0_wp, 2.0_wp, 4.0_wp, 5.0_wp, -1.0_wp]
      real(wp), parameter :: sine(6) = [0.479425538604203000273_wp, 0.841470984807896506653_wp, 0.909297426825681695396_wp, &
         -0.756802495307928251373_wp, -0.958924274663138468893_wp, -0.841470984807896506653_wp]
      real(wp), parameter :: cosine(6) = [0.877582561890372716116_wp, 0.540302305868139717401_wp, -0.416146836547142386998_wp, &
         -0.653643620863611914639_wp, 0.283662185463226264467_wp, 0.540302305868139717401_wp]
      real(wp) :: c(6), s(6)

      call sine_cosine(angle, s, c)
      call check_close(error, s, sine, 0.5_wp*eps, "sines")
      if (allocated(error)) return
      call check_close(error, c, cosine, 0.5_wp*eps, "cosines")
   end subroutine test_published

   !> Against the run-time library over many turns: each is off by less than a unit in the last place of one at most.
   subroutine test_library(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 20000
      real(wp), parameter :: step(4) = [1.0e-4_wp, 7.0e-3_wp, 1.0_wp, 77.7_wp]  ! up to two radians, to a million and a half [rad]
      real(wp) :: c, s, x
      integer :: i, k

      do k = 1, size(step)
         do i = -n, n
            x = i*step(k)
            call sine_cosine(x, s, c)
            call check_true(error, abs(s - sin(x)) <= spacing(sin(x)) + 1.0e-20_wp, "sine beside that of the library")
            if (allocated(error)) return
            call check_true(error, abs(c - cos(x)) <= spacing(cos(x)) + 1.0e-20_wp, "cosine beside that of the library")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_library

   !> At the numbers nearest to multiples of pi/2 what is left is what pi/2 lacks.
   subroutine test_zeros(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: quarter = 1.57079632679489661923_wp, lacking = 6.12323399573676588613e-17_wp  ! pi/2, less that [rad]
      real(wp) :: c(-4:4), s(-4:4)
      integer :: k

      call sine_cosine([(k*quarter, k=-4, 4)], s, c)
      call check_close(error, s, [4*lacking, 1.0_wp, -2*lacking, -1.0_wp, 0.0_wp, 1.0_wp, 2*lacking, -1.0_wp, -4*lacking], &
                       2.0e-26_wp, "sines")
      if (allocated(error)) return
      call check_close(error, c(-3::2), [-3*lacking, lacking, lacking, -3*lacking], 2.0e-26_wp, "cosines that are nearly zero")
      if (allocated(error)) return
      call check_close(error, c(-4::2), [1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp], 0.0_wp, "cosines that are one")
   end subroutine test_zeros

   !> Angles of so many turns that the multiple of pi/2 is not known well enough are the library's.
   subroutine test_beyond(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: angle(3) = [1.0e8_wp, -3.0e15_wp, 1.0e22_wp]
      real(wp) :: c(3), s(3)

      call sine_cosine(angle, s, c)
      call check_close(error, s, sin(angle), 0.0_wp, "sines")
      if (allocated(error)) return
      call check_close(error, c, cos(angle), 0.0_wp, "cosines")
   end subroutine test_beyond

end module test_sine_cosine
