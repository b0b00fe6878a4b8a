!> How far two time histories of the same number differ.
!>
!> Both are at the same instants (`series_at_output_times`). Compared are those at which both have a number; at how many only one of
!> them has one is reported. With d = b - a:
!>
!>     rms        sqrt(mean d^2)                     maximum   max |d|, and when
!>     peaks      max |a|, max |b|, located          lag        shift tau of b(t) = a(t - tau) with the minimum mean square
!>     magnitude  sqrt(sum b^2/sum a^2) - 1          phase      acos(sum a b/sqrt(sum a^2 sum b^2))/pi
!>
!> The last two are measures of Sprague and Geers: the error of the size alone and that of the phase alone.
!> Means and RMS of chaotic motions are compared by their intervals of confidence, each from batches (`batch_means`): the ratio
!> of the
!> difference to the root of the sum of squares of both halves is 1 at a significance of 5 %.
!>
!> Source: M. A. Sprague, T. L. Geers, Int. J. Numer. Meth. Eng. 60 (2004) 2467-2499. Limits: the lag is searched up to a tenth
!> of
!> the time that both have in common.
module differences_of_series
   use batch_means, only: estimate_t, mean_of_series
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, pi, wp
   implicit none (type, external)
   private
   public :: compare_values, difference_t, find_peak, moments_t

   integer, parameter :: n_grid = 1001    !! instants of the search for the lag
   integer, parameter :: most_lag = 100   !! of these instants, to either side

   !> A mean of both, and how sure its difference is.
   type :: moments_t
      type(estimate_t) :: a                       !! of the first [any]
      type(estimate_t) :: b                       !! of the second [any]
      real(wp) :: significance = 1.0_wp           !! probability of such a difference by chance; NaN: not known [1]
   end type moments_t

   !> Differences of one number.
   !> Components: all that is reported of a channel.
   type :: difference_t
      character(:), allocatable :: name           !! of the number
      character(:), allocatable :: unit           !! SI
      integer :: n = 0                            !! instants compared: both have a number
      integer :: only(2) = 0                      !! (2) instants at which only A, or only B, has a number
      integer :: neither = 0                      !! instants at which none of them has one
      integer :: unsettled = 0                    !! instants between two rows of A of which one has no number, or another state
      real(wp) :: rms = 0.0_wp                    !! [any]
      real(wp) :: maximum = 0.0_wp               !! [any]
      real(wp) :: at = 0.0_wp                     !! when [s]
      real(wp) :: interpolation = 0.0_wp          !! what the interpolation may have added at most [any]
      real(wp) :: peak(2) = 0.0_wp                !! (2) maximum magnitude in the rows of each; NaN: no number [any]
      real(wp) :: peak_at(2) = 0.0_wp             !! (2) when [s]
      real(wp) :: lag = 0.0_wp                    !! of b behind a; NaN: not known [s]
      real(wp) :: magnitude = 0.0_wp              !! [1]
      real(wp) :: phase = 0.0_wp                  !! [1]
      type(moments_t) :: mean                     !! of the values [any]
      type(moments_t) :: square                   !! of their squares [any]
      real(wp) :: noise = 0.0_wp                  !! less is round-off [any]
      real(wp) :: allowed = 0.0_wp                !! difference that is allowed [any]
      logical :: is_different = .false.           !! the verdict
   end type difference_t

contains

   !> Compare values at the same instants.
   subroutine compare_values(t, a, b, is_settled, modulo, d, difference)
      real(wp), intent(in) :: t(:)                       !! (n) instants [s]
      real(wp), intent(in) :: a(:)                       !! (n) the first [any]
      real(wp), intent(inout) :: b(:)                    !! (n) the second; brought next to the first where it counts turns [any]
      logical, intent(in) :: is_settled(:)               !! (n) where it is known what the first is
      real(wp), intent(in) :: modulo                     !! differences are up to multiples of it; 0: not [any]
      real(wp), intent(out) :: d(:)                      !! (n) the second less the first; NaN where they are not compared [any]
      type(difference_t), intent(inout) :: difference    !! set, but for the peaks and the verdict

      real(wp), allocatable :: x(:), y(:)
      logical :: has_a(size(a)), has_b(size(a)), is_known(size(a))

      has_a = ieee_is_finite(a)
      has_b = ieee_is_finite(b)
      is_known = has_a .and. has_b .and. is_settled
      if (modulo > 0.0_wp) then
         where (has_a .and. has_b) b = b - modulo*anint((b - a)/modulo)
      end if
      d = not_a_number()
      where (is_known) d = b - a
      difference%n = count(is_known)
      difference%only = [count(is_settled .and. has_a .and. .not. has_b), count(is_settled .and. has_b .and. .not. has_a)]
      difference%neither = count(is_settled .and. .not. (has_a .or. has_b))
      difference%unsettled = count(.not. is_settled)
      difference%mean = moments_of(pack(a, has_a), pack(b, has_b))
      difference%square = moments_of(pack(a, has_a)**2, pack(b, has_b)**2)
      difference%lag = not_a_number()
      if (difference%n == 0) then
         difference%rms = not_a_number()
         difference%maximum = not_a_number()
         difference%at = not_a_number()
         difference%magnitude = not_a_number()
         difference%phase = not_a_number()
         return
      end if
      x = pack(a, is_known)
      y = pack(b, is_known)
      difference%rms = sqrt(sum((y - x)**2)/real(difference%n, wp))
      call find_peak(t, d, difference%maximum, difference%at)
      if (sum(x**2) > 0.0_wp .and. sum(y**2) > 0.0_wp) then
         difference%magnitude = sqrt(sum(y**2)/sum(x**2)) - 1.0_wp
         difference%phase = acos(max(-1.0_wp, min(1.0_wp, sum(x*y)/(sqrt(sum(x**2))*sqrt(sum(y**2))))))/pi
      end if
      if (all(is_known)) difference%lag = lag_of(t, a, b)
   end subroutine compare_values

   !> The maximum magnitude of numbers, and when.
   pure subroutine find_peak(t, x, peak, at)
      real(wp), intent(in) :: t(:)      !! (n) instants [s]
      real(wp), intent(in) :: x(:)      !! (n) numbers, some of them perhaps none [any]
      real(wp), intent(out) :: peak     !! the maximum magnitude; NaN: there is no number [any]
      real(wp), intent(out) :: at       !! its first instant; NaN: there is none [s]

      integer :: k

      peak = not_a_number()
      at = not_a_number()
      k = maxloc(abs(x), dim=1, mask=ieee_is_finite(x))
      if (k == 0) return
      peak = abs(x(k))
      at = t(k)
   end subroutine find_peak

   !> Means of both and the significance of their difference.
   function moments_of(x, y) result(moments)
      real(wp), intent(in) :: x(:)    !! (n) the first [any]
      real(wp), intent(in) :: y(:)    !! (m) the second [any]
      type(moments_t) :: moments      !! of both; NaN of one without numbers

      real(wp), parameter :: normal = 1.959963984540054_wp  ! quantile 0.975 of the normal distribution [1]
      real(wp) :: apart, half

      moments%a%value = not_a_number()
      moments%a%half = not_a_number()
      moments%b = moments%a
      if (size(x) > 0) moments%a = mean_of_series(x)
      if (size(y) > 0) moments%b = mean_of_series(y)
      moments%significance = not_a_number()
      if (.not. (ieee_is_finite(moments%a%half) .and. ieee_is_finite(moments%b%half))) return
      half = hypot(moments%a%half, moments%b%half)
      apart = abs(moments%a%value - moments%b%value)
      moments%significance = 1.0_wp
      if (half > 0.0_wp) then
         moments%significance = erfc(normal*min(apart/half, 1.0e3_wp)/sqrt(2.0_wp))
      else if (apart > 0.0_wp) then
         moments%significance = 0.0_wp
      end if
   end function moments_of

   !> The shift of b behind a with the minimum mean square of what is left: whole steps of a grid, then a step of Gauss and Newton.
   function lag_of(t, a, b) result(lag)
      real(wp), intent(in) :: t(:)    !! (n) instants [s]
      real(wp), intent(in) :: a(:)    !! (n) the first [any]
      real(wp), intent(in) :: b(:)    !! (n) the second [any]
      real(wp) :: lag                 !! NaN: a does not change, or the best shift is the maximum one [s]

      real(wp) :: grid(n_grid), minimum, slope(n_grid), square, step, x(n_grid), y(n_grid)
      integer :: best, first, k, last

      lag = not_a_number()
      if (size(t) < 8) return
      step = (t(size(t)) - t(1))/real(n_grid - 1, wp)
      if (.not. step > 0.0_wp) return
      grid = [(t(1) + step*real(k, wp), k=0, n_grid - 1)]
      x = on_grid(t, a, grid)
      y = on_grid(t, b, grid)
      if (maxval(x) - minval(x) <= 1.0e-12_wp*maxval(abs(x)) .or. maxval(y) - minval(y) <= 1.0e-12_wp*maxval(abs(y))) return
      minimum = huge(minimum)
      best = 0
      do k = -most_lag, most_lag
         square = sum((y(1 + most_lag:n_grid - most_lag) - x(1 + most_lag - k:n_grid - most_lag - k))**2)
         if (square < minimum .or. (.not. square > minimum .and. abs(k) < abs(best))) then
            minimum = square
            best = k
         end if
      end do
      if (abs(best) == most_lag) return
      slope = 0.0_wp
      slope(2:n_grid - 1) = (x(3:) - x(:n_grid - 2))/(2.0_wp*step)
      first = 2 + most_lag
      last = n_grid - most_lag - 1
      square = sum(slope(first - best:last - best)**2)
      lag = step*real(best, wp)
      if (square > 0.0_wp) lag = lag - sum((y(first:last) - x(first - best:last - best))*slope(first - best:last - best))/square
   end function lag_of

   !> Values on a grid, by lines.
   pure function on_grid(t, x, grid) result(values)
      real(wp), intent(in) :: t(:)        !! (n) instants, not falling [s]
      real(wp), intent(in) :: x(:)        !! (n) values [any]
      real(wp), intent(in) :: grid(:)     !! (m) rising [s]
      real(wp) :: values(size(grid))      !! (m) the values [any]

      integer :: i, k

      k = 1
      do i = 1, size(grid)
         do while (k < size(t) - 1)
            if (grid(i) <= t(k + 1)) exit
            k = k + 1
         end do
         values(i) = x(k)
         if (t(k + 1) > t(k)) values(i) = x(k) + (x(k + 1) - x(k))*(grid(i) - t(k))/(t(k + 1) - t(k))
      end do
   end function on_grid

end module differences_of_series
