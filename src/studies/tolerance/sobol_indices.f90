!> Sobol' indices with bootstrap intervals.
!>
!> Of two independent plans A and B, and A with the columns of contributor i from B:
!> $$ S_i = 1 - \frac{1}{2NV}\sum_{m=1}^N \left(f(B)_m - f(A_B^i)_m\right)^2, \quad
!>    S_{Ti} = \frac{1}{2NV}\sum_{m=1}^N \left(f(A)_m - f(A_B^i)_m\right)^2, $$
!> V the variance of f over both plans. Intervals of 95 % are those of normal deviates with the standard deviation of the
!> indices over resamples of the points.
!> Sources: M. J. W. Jansen, Comput. Phys. Commun. 117 (1999) 35-43; A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259-270,
!> table 2; G. E. B. Archer, A. Saltelli, I. M. Sobol', J. Stat. Comput. Simul. 58 (1997) 99-120 (bootstrap).
module sobol_indices
   use counter_random, only: uniform_at
   use kinds, only: i8, not_a_number, wp
   use normal_distribution, only: normal_95
   implicit none (type, external)
   private
   public :: find_indices, resample_weights

contains

   !> How often each point is in each resample.
   subroutine resample_weights(seed, stream, weights)
      integer, intent(in) :: seed               !! of the random numbers
      integer, intent(in) :: stream             !! what they are for
      real(wp), intent(out) :: weights(:, :)    !! (points, resamples) counts [1]

      integer :: at, m, r

      weights = 0.0_wp
      do r = 1, size(weights, 2)
         do m = 1, size(weights, 1)
            at = 1 + int(uniform_at(seed, stream, int(m, i8), r)*size(weights, 1))
            weights(at, r) = weights(at, r) + 1.0_wp
         end do
      end do
   end subroutine resample_weights

   !> Indices of all contributors.
   subroutine find_indices(a, b, ab, weights, first, total)
      real(wp), intent(in) :: a(:)               !! (points) values of plan A [any]
      real(wp), intent(in) :: b(:)               !! (points) values of plan B [any]
      real(wp), intent(in) :: ab(:, :)           !! (points, contributors) values of the mixed plans [any]
      real(wp), intent(in) :: weights(:, :)      !! (points, resamples) counts [1]
      real(wp), intent(out) :: first(:, :)       !! (3, contributors) value, ends of the interval; NaN: nothing scatters [1]
      real(wp), intent(out) :: total(:, :)       !! (3, contributors) the same of total indices [1]

      real(wp), allocatable :: all(:), by_a(:, :), by_b(:, :), sums(:, :), terms(:, :), variances(:)
      real(wp) :: middle, variance
      integer :: i, k, n

      n = size(a)
      k = size(ab, 2)
      middle = 0.5_wp*(sum(a) + sum(b))/n
      allocate (terms(n, 2 + 2*k))
      terms(:, 1) = 0.5_wp*(a + b) - middle
      terms(:, 2) = 0.5_wp*((a - middle)**2 + (b - middle)**2)
      do i = 1, k
         terms(:, 2 + i) = 0.5_wp*(b - ab(:, i))**2
         terms(:, 2 + k + i) = 0.5_wp*(a - ab(:, i))**2
      end do
      allocate (all(2 + 2*k), source=sum(terms, dim=1)/n)
      variance = all(2) - all(1)**2
      first = not_a_number()
      total = not_a_number()
      if (.not. variance > (64.0_wp*epsilon(1.0_wp)*middle)**2) return
      allocate (sums(2 + 2*k, size(weights, 2)), source=matmul(transpose(terms), weights)/n)
      variances = max(sums(2, :) - sums(1, :)**2, tiny(1.0_wp))
      by_b = 1.0_wp - sums(3:2 + k, :)/spread(variances, 1, k)
      by_a = sums(3 + k:, :)/spread(variances, 1, k)
      do i = 1, k
         call set_interval(1.0_wp - all(2 + i)/variance, by_b(i, :), first(:, i))
         call set_interval(all(2 + k + i)/variance, by_a(i, :), total(:, i))
      end do
   end subroutine find_indices

   !> A value with its interval by the scatter of resamples.
   pure subroutine set_interval(value, resampled, interval)
      real(wp), intent(in) :: value           !! the value [1]
      real(wp), intent(in) :: resampled(:)    !! (resamples) that of each resample [1]
      real(wp), intent(out) :: interval(3)    !! (3) value, ends of its interval of 95 % [1]

      real(wp) :: half

      associate (n => size(resampled))
         half = normal_95*sqrt(sum((resampled - sum(resampled)/n)**2)/(n - 1))
      end associate
      interval = [value, value - half, value + half]
   end subroutine set_interval

end module sobol_indices
