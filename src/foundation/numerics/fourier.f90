!> Discrete Fourier transform of any number of samples.
!>
!> $$ X_m = \sum_{k=0}^{n-1} x_k e^{-2 \pi i m k/n}, \quad m = 0, \ldots, n - 1 $$
!>
!> Powers of two: Stockham's form of the method of Cooley and Tukey, halves merged by
!> $$ X_m = E_m + e^{-2 \pi i m/n} O_m, \quad X_{m + n/2} = E_m - e^{-2 \pi i m/n} O_m . $$
!> Other lengths: Bluestein's convolution with a chirp, by transforms of a power of two N >= 2 n - 1,
!> $$ X_m = \bar c_m \sum_k (x_k \bar c_k) \, c_{m - k}, \quad c_k = e^{i \pi k^2/n} . $$
!> The phase of the chirp is reduced as an integer, k^2 modulo 2 n, so that it is exact for any length.
!> Error: about epsilon log2(N) of the root mean square of the X_m, whatever the length. Work: n log n.
!>
!> Source: J. W. Cooley, J. W. Tukey, An algorithm for the machine calculation of complex Fourier series, Math. Comp. 19 (1965)
!> 297-301; L. I. Bluestein, A linear filtering approach to the computation of discrete Fourier transform, IEEE Trans. Audio
!> Electroacoust. 18 (1970) 451-455; C. Van Loan, Computational Frameworks for the Fast Fourier Transform, SIAM (1992), 1.7.
!> Limits: at least one sample; all finite.
module fourier
   use kinds, only: i8, pi, wp
   implicit none (type, external)
   private
   public :: fourier_transform

contains

   !> The transform.
   pure function fourier_transform(x) result(lines)
      real(wp), intent(in) :: x(0:)        !! (n) samples [any]
      complex(wp) :: lines(0:size(x) - 1)  !! (n) their transform [any]

      complex(wp), allocatable :: chirp(:), kernel(:), padded(:)
      integer :: n, n_padded
      integer(i8) :: k

      n = size(x)
      n_padded = 1
      if (iand(n, n - 1) == 0) then
         lines = cmplx(x, kind=wp)
         call transform_power_of_two(lines)
         return
      end if
      do while (n_padded < 2*n - 1)
         n_padded = 2*n_padded
      end do
      chirp = [(unit_root(modulo(k*k, 2_i8*n), 2_i8*n), k=0, n - 1)]
      allocate (padded(0:n_padded - 1), kernel(0:n_padded - 1), source=(0.0_wp, 0.0_wp))
      padded(:n - 1) = x*conjg(chirp)
      kernel(:n - 1) = chirp
      kernel(n_padded - n + 1:) = chirp(n:2:-1)
      call transform_power_of_two(padded)
      call transform_power_of_two(kernel)
      padded = conjg(padded*kernel)         ! inverse: the conjugate of the transform of the conjugate, over N
      call transform_power_of_two(padded)
      lines = conjg(chirp*padded(:n - 1))/n_padded
   end function fourier_transform

   !> Replace a power of two of numbers by their transform.
   pure subroutine transform_power_of_two(x)
      complex(wp), intent(inout) :: x(0:)  !! (n) numbers, then their transform [any]

      complex(wp), allocatable :: other(:), turns(:)
      integer :: half, j, n_done, k, p
      integer(i8) :: m

      half = size(x)/2
      turns = [(conjg(unit_root(m, int(size(x), i8))), m=0, half - 1)]
      allocate (other(0:size(x) - 1))
      n_done = 1                            ! samples of each of the transforms that are ready, interleaved
      do while (n_done < size(x))
         p = half/n_done                    ! pairs of transforms to merge
         do j = 0, n_done - 1
            do k = 0, p - 1
               associate (even => x(2*j*p + k), odd => turns(j*p + 1)*x((2*j + 1)*p + k))
                  other(j*p + k) = even + odd
                  other(half + j*p + k) = even - odd
               end associate
            end do
         end do
         x = other
         n_done = 2*n_done
      end do
   end subroutine transform_power_of_two

   !> A root of one, exp(2 pi i k/n).
   elemental complex(wp) function unit_root(k, n)
      integer(i8), intent(in) :: k  !! which, from 0 to n - 1
      integer(i8), intent(in) :: n  !! how many there are

      real(wp) :: angle

      angle = 2.0_wp*pi*real(k, wp)/real(n, wp)
      unit_root = cmplx(cos(angle), sin(angle), wp)
   end function unit_root

end module fourier
