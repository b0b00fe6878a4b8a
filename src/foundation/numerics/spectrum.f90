!> Amplitude spectrum of samples at equal intervals, under a Hann window, by FFTW.
!>
!> $$ A_m = \frac{2}{\sum_k w_k} \Big| \sum_{k=0}^{n-1} w_k (x_k - \bar x) e^{-2 \pi i m k/n} \Big|, \quad
!>    w_k = \tfrac12 (1 - \cos(2 \pi k/n)), \quad f_m = \frac{m}{n h} $$
!>
!> The mean, itself taken under the window, is subtracted, so that it does not leak into the lowest lines. A harmonic whose
!> frequency is one of the f_m has its own amplitude there; between two lines it reads up to 15 % low.
!> Source: F. J. Harris, On the use of windows for harmonic analysis with the discrete Fourier transform, Proc. IEEE 66
!> (1978) 51-83; M. Frigo, S. G. Johnson, The design and implementation of FFTW3, Proc. IEEE 93 (2005) 216-231.
!> Limits: at least two samples; where one is no number, or infinite, no amplitude is known, and all are NaN. FFTW plans by rule,
!> not by timing, so that equal samples give equal spectra.
module spectrum
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_int, c_ptr
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: amplitude_spectrum

   real(wp), parameter :: pi = acos(-1.0_wp)      !! half the circumference of the unit circle [1]
   integer(c_int), parameter :: fftw_estimate = 64  !! FFTW: plan without measuring

   ! allow(assumed-size)
   interface
      !> Plan a transform of n real samples.
      function fftw_plan_dft_r2c_1d(n, samples, lines, flags) bind(c, name="fftw_plan_dft_r2c_1d") result(plan)
         import :: c_double, c_double_complex, c_int, c_ptr
         implicit none (type, external)
         integer(c_int), value :: n                                    !! samples
         real(c_double), intent(inout) :: samples(*)                   !! (n) samples [any]
         complex(c_double_complex), intent(inout) :: lines(*)          !! (n/2 + 1) their transform [any]
         integer(c_int), value :: flags                                !! how to plan
         type(c_ptr) :: plan                                           !! the plan
      end function fftw_plan_dft_r2c_1d

      !> Transform.
      subroutine fftw_execute_dft_r2c(plan, samples, lines) bind(c, name="fftw_execute_dft_r2c")
         import :: c_double, c_double_complex, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: plan                                    !! the plan
         real(c_double), intent(inout) :: samples(*)                   !! (n) samples [any]
         complex(c_double_complex), intent(inout) :: lines(*)          !! (n/2 + 1) their transform [any]
      end subroutine fftw_execute_dft_r2c

      !> Forget a plan.
      subroutine fftw_destroy_plan(plan) bind(c, name="fftw_destroy_plan")
         import :: c_ptr
         implicit none (type, external)
         type(c_ptr), value :: plan                                    !! the plan
      end subroutine fftw_destroy_plan
   end interface

contains

   !> Frequencies and amplitudes.
   subroutine amplitude_spectrum(x, interval, frequency, amplitude)
      real(wp), intent(in) :: x(:)                          !! (n) samples [any]
      real(wp), intent(in) :: interval                      !! between two samples [s]
      real(wp), allocatable, intent(out) :: frequency(:)    !! (n/2 + 1) from 0 to half the sampling rate [Hz]
      real(wp), allocatable, intent(out) :: amplitude(:)    !! (n/2 + 1) as x [any]

      complex(c_double_complex), allocatable :: lines(:)
      real(c_double), allocatable :: windowed(:)
      real(wp), allocatable :: window(:)
      type(c_ptr) :: plan
      integer :: k, n

      n = size(x)
      frequency = [(real(k, wp)/(real(n, wp)*interval), k=0, n/2)]
      if (.not. all(ieee_is_finite(x))) then
         allocate (amplitude(n/2 + 1), source=not_a_number())
         return
      end if
      allocate (lines(n/2 + 1), windowed(n), window(n))
      window = [(0.5_wp*(1.0_wp - cos(2.0_wp*pi*real(k, wp)/real(n, wp))), k=0, n - 1)]
      plan = fftw_plan_dft_r2c_1d(int(n, c_int), windowed, lines, fftw_estimate)
      windowed = window*(x - sum(window*x)/sum(window))
      call fftw_execute_dft_r2c(plan, windowed, lines)
      call fftw_destroy_plan(plan)
      amplitude = 2.0_wp*abs(lines)/sum(window)
   end subroutine amplitude_spectrum

end module spectrum
