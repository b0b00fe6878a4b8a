!> The Fourier transform against the sum that defines it, taken in quadruple precision, and against Parseval's theorem.
module test_fourier
   use, intrinsic :: iso_fortran_env, only: real128
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use fourier, only: fourier_transform
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: run_test_fourier

   real(wp), parameter :: allowed = 1.0e-13_wp  !! error over the root mean square of the lines [1]

contains

   subroutine run_test_fourier(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("agrees_with_its_sum", agrees_with_its_sum)
      call suite%test("keeps_the_energy", keeps_the_energy)
      call suite%test("one_and_two_samples", one_and_two_samples)
   end subroutine run_test_fourier

   !> All lengths to 40, then primes, powers, products of small and of large primes.
   subroutine agrees_with_its_sum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: lengths(*) = [97, 128, 243, 509, 512, 625, 720, 997, 1000, 1006, 1024, 1025]
      type(random_t) :: random
      integer :: k

      do k = 1, 40 + size(lengths)
         call compare(merge(k, lengths(max(k - 40, 1)), k <= 40))
         if (allocated(error)) return
      end do

   contains

      !> One length.
      subroutine compare(n)
         integer, intent(in) :: n  !! samples

         complex(real128), allocatable :: direct(:), roots(:)
         complex(wp), allocatable :: lines(:)
         real(wp), allocatable :: x(:)
         real(real128), parameter :: turn = 2*acos(-1.0_real128)
         character(24) :: what
         integer(i8) :: j, m

         x = random%vector(n, -1.0_wp, 1.0_wp)
         lines = fourier_transform(x)
         roots = [(exp(cmplx(0.0_real128, -turn*j/n, real128)), j=0, n - 1)]
         direct = [(sum(x*roots([(1 + modulo(j*m, int(n, i8)), j=0, n - 1)])), m=0, n - 1)]
         write (what, "(a, i0)") "length ", n
         call check_true(error, size(lines) == n, what)
         call check_close(error, real(maxval(abs(lines - direct)), wp)/norm2(x), 0.0_wp, allowed, what)
      end subroutine compare

   end subroutine agrees_with_its_sum

   !> The squares of the lines are n times those of the samples: a large prime, the power of two above it, an even number.
   subroutine keeps_the_energy(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: lengths(*) = [100003, 131072, 200006]
      type(random_t) :: random
      real(wp), allocatable :: x(:)
      integer :: k

      do k = 1, size(lengths)
         x = random%vector(lengths(k), -1.0_wp, 1.0_wp)
         call check_close(error, norm2(abs(fourier_transform(x)))/sqrt(real(lengths(k), wp))/norm2(x), 1.0_wp, allowed, "energy")
      end do
   end subroutine keeps_the_energy

   !> Lengths that leave nothing to merge, or one pair.
   subroutine one_and_two_samples(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      complex(wp), allocatable :: lines(:)

      lines = fourier_transform([3.0_wp])
      call check_close(error, [real(lines), aimag(lines)], [3.0_wp, 0.0_wp], 0.0_wp, "one sample")
      lines = fourier_transform([3.0_wp, 5.0_wp])
      call check_close(error, [real(lines), aimag(lines)], [8.0_wp, -2.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "two samples")
   end subroutine one_and_two_samples

end module test_fourier
