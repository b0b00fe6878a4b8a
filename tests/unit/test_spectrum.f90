!> Amplitude spectra of signals whose lines are known.
module test_spectrum
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use kinds, only: pi, wp
   use spectrum, only: amplitude_spectrum
   implicit none (type, external)
   private
   public :: run_test_spectrum

contains

   subroutine run_test_spectrum(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("lines_have_their_amplitudes", lines_have_their_amplitudes)
      call suite%test("between_two_lines", between_two_lines)
      call suite%test("a_constant_has_no_lines", a_constant_has_no_lines)
      call suite%test("equal_samples_give_equal_spectra", equal_samples_give_equal_spectra)
   end subroutine run_test_spectrum

   !> Sines on lines 3 and 17, a cosine among them, over an odd and an even number of samples.
   subroutine lines_have_their_amplitudes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), allocatable :: a(:), f(:), x(:)
      integer :: k, n, pass

      do pass = 1, 2
         n = 100 + pass
         x = [(2.0_wp*sin(2.0_wp*pi*3*k/n) + 0.5_wp*cos(2.0_wp*pi*17*k/n) - 7.0_wp, k=0, n - 1)]
         call amplitude_spectrum(x, 0.01_wp, f, a)
         call check_true(error, size(a) == n/2 + 1 .and. size(f) == n/2 + 1, "number of lines")
         call check_close(error, f(4), 3.0_wp/(0.01_wp*n), 1.0e-12_wp, "frequency of line 3")
         call check_close(error, a(4), 2.0_wp, 1.0e-13_wp, "amplitude of line 3")
         call check_close(error, a(18), 0.5_wp, 1.0e-13_wp, "amplitude of line 17")
         call check_close(error, maxval(a(21:)), 0.0_wp, 1.0e-13_wp, "amplitude beyond")
         if (allocated(error)) return
      end do
   end subroutine lines_have_their_amplitudes

   !> Half-way between two lines a Hann window reads 8/(3 pi) of the amplitude.
   subroutine between_two_lines(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 4096
      real(wp), allocatable :: a(:), f(:)
      integer :: k

      call amplitude_spectrum([(sin(2.0_wp*pi*200.5_wp*k/n), k=0, n - 1)], 1.0_wp, f, a)
      call check_close(error, a(201), 8.0_wp/(3.0_wp*pi), 1.0e-4_wp, "line below")
      call check_close(error, a(202), 8.0_wp/(3.0_wp*pi), 1.0e-4_wp, "line above")
   end subroutine between_two_lines

   !> The mean is taken out before the window.
   subroutine a_constant_has_no_lines(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), allocatable :: a(:), f(:)
      integer :: k

      call amplitude_spectrum([(5.0_wp, k=1, 64)], 1.0_wp, f, a)
      call check_close(error, maxval(a), 0.0_wp, 1.0e-13_wp, "lines of a constant")
   end subroutine a_constant_has_no_lines

   !> Bit for bit, wherever the samples lie in memory.
   subroutine equal_samples_give_equal_spectra(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), allocatable :: a(:), again(:), elsewhere(:), f(:), x(:)
      integer :: k

      x = [(sin(0.1_wp*k**2), k=1, 997)]
      call amplitude_spectrum(x, 1.0_wp, f, a)
      elsewhere = [0.0_wp, x]
      call amplitude_spectrum(elsewhere(2:), 1.0_wp, f, again)
      call check_true(error, all(abs(a - again) <= 0.0_wp), "the same again")
   end subroutine equal_samples_give_equal_spectra

end module test_spectrum
