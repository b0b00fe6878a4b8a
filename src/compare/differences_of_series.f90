!> How far two time histories of the same number differ.
!>
!> The first one, A, is brought to the instants of the second, B, by the polynomial through six of its output instants; how far that
!> is from the one through five tells what the interpolation may add. With d = b - a:
!>
!>     rms        sqrt(mean d^2)                     greatest   max |d|, and when
!>     peak error (max |b| - max |a|)/max |a|        lag        shift tau of b(t) = a(t - tau) with the least mean square
!>     magnitude  sqrt(sum b^2/sum a^2) - 1          phase      acos(sum a b/sqrt(sum a^2 sum b^2))/pi
!>
!> The last two are measures of Sprague and Geers: the error of the size alone and that of the phase alone.
!> Means and RMS of chaotic motions are compared by their intervals of confidence, each from batches (`batch_means`): the ratio
!> of the
!> difference to the root of the sum of squares of both halves is 1 at a significance of 5 %.
!>
!> Source: M. A. Sprague, T. L. Geers, Int. J. Numer. Meth. Eng. 60 (2004) 2467-2499. Limits: the lag is looked for up to a tenth
!> of
!> the time that both have in common.
module differences_of_series
   use batch_means, only: estimate_t, mean_of_series
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, pi, wp
   implicit none (type, external)
   private
   public :: at_instants, compare_values, difference_t, moments_t

   integer, parameter :: n_grid = 1001    !! instants of the search for the lag
   integer, parameter :: most_lag = 100   !! of these instants, to either side

   !> A mean of both, and how sure its difference is.
   type :: moments_t
      type(estimate_t) :: a                       !! of the first [any]
      type(estimate_t) :: b                       !! of the second [any]
      real(wp) :: significance = 1.0_wp           !! probability of such a difference by chance; NaN: not known [1]
   end type moments_t

   !> Differences of one number.
   !> Components: all that is told of a channel.
   type :: difference_t
      character(:), allocatable :: name           !! of the number
      character(:), allocatable :: unit           !! SI
      integer :: n = 0                            !! instants compared
      real(wp) :: rms = 0.0_wp                    !! [any]
      real(wp) :: greatest = 0.0_wp               !! [any]
      real(wp) :: at = 0.0_wp                     !! when [s]
      real(wp) :: interpolation = 0.0_wp          !! what the interpolation may have added at most [any]
      real(wp) :: peak(2) = 0.0_wp                !! (2) greatest magnitude of both [any]
      real(wp) :: peak_at(2) = 0.0_wp             !! (2) when [s]
      real(wp) :: lag = 0.0_wp                    !! of b behind a; NaN: not known [s]
      real(wp) :: magnitude = 0.0_wp              !! [1]
      real(wp) :: phase = 0.0_wp                  !! [1]
      type(moments_t) :: mean                     !! of the values [any]
      type(moments_t) :: square                   !! of their squares [any]
      real(wp) :: allowed = 0.0_wp                !! difference that is allowed [any]
      logical :: is_different = .false.           !! the verdict
   end type difference_t

contains

   !> Compare values at the same instants.
   subroutine compare_values(t, a, b, modulo, difference)
      real(wp), intent(in) :: t(:)                       !! (n) instants [s]
      real(wp), intent(in) :: a(:)                       !! (n) the first [any]
      real(wp), intent(inout) :: b(:)                    !! (n) the second; brought next to the first where it counts turns [any]
      real(wp), intent(in) :: modulo                     !! differences are up to multiples of it; 0: not [any]
      type(difference_t), intent(inout) :: difference    !! set, but for the verdict

      real(wp), allocatable :: d(:), x(:), y(:)
      logical, allocatable :: is_known(:)
      integer :: k

      if (modulo > 0.0_wp) b = b - modulo*anint((b - a)/modulo)
      is_known = ieee_is_finite(a) .and. ieee_is_finite(b)
      x = pack(a, is_known)
      y = pack(b, is_known)
      d = y - x
      difference%n = size(d)
      difference%lag = not_a_number()
      if (size(d) == 0) then
         difference%rms = not_a_number()
         difference%greatest = not_a_number()
         return
      end if
      difference%rms = sqrt(sum(d**2)/real(size(d), wp))
      k = maxloc(abs(d), dim=1)
      difference%greatest = abs(d(k))
      associate (times => pack(t, is_known))
         difference%at = times(k)
         difference%peak = [maxval(abs(x)), maxval(abs(y))]
         difference%peak_at = [times(maxloc(abs(x), dim=1)), times(maxloc(abs(y), dim=1))]
      end associate
      if (sum(x**2) > 0.0_wp .and. sum(y**2) > 0.0_wp) then
         difference%magnitude = sqrt(sum(y**2)/sum(x**2)) - 1.0_wp
         difference%phase = acos(max(-1.0_wp, min(1.0_wp, sum(x*y)/(sqrt(sum(x**2))*sqrt(sum(y**2))))))/pi
      end if
      difference%mean = moments_of(x, y)
      difference%square = moments_of(x**2, y**2)
      if (all(is_known)) difference%lag = lag_of(t, a, b)
   end subroutine compare_values

   !> Means of both and the significance of their difference.
   function moments_of(x, y) result(moments)
      real(wp), intent(in) :: x(:)    !! (n) the first [any]
      real(wp), intent(in) :: y(:)    !! (n) the second [any]
      type(moments_t) :: moments      !! of both

      real(wp), parameter :: normal = 1.959963984540054_wp  ! quantile 0.975 of the normal distribution [1]
      real(wp) :: apart, half

      moments%a = mean_of_series(x)
      moments%b = mean_of_series(y)
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

   !> Values at other instants, by the polynomial through six neighbours, and what that may add.
   pure subroutine at_instants(t, x, times, values, worst)
      real(wp), intent(in) :: t(:)           !! (n) instants, rising [s]
      real(wp), intent(in) :: x(:)           !! (n) values [any]
      real(wp), intent(in) :: times(:)       !! (m) instants wanted, within the others [s]
      real(wp), intent(out) :: values(:)     !! (m) the values [any]
      real(wp), intent(out) :: worst         !! greatest difference to the one through five [any]

      real(wp), parameter :: same = 1.0e-9_wp   ! of an interval: it is the instant itself [1]
      real(wp) :: fewer
      integer :: i, k, n

      worst = 0.0_wp
      n = min(6, size(t))
      k = 1
      do i = 1, size(times)
         if (k > 1) then
            if (times(i) < t(k)) k = 1
         end if
         do while (k < size(t) - 1)
            if (times(i) < t(k + 1)) exit
            k = k + 1
         end do
         associate (first => max(1, min(k - 2, size(t) - n + 1)))
            values(i) = lagrange(t(first:first + n - 1), x(first:first + n - 1), times(i))
            if (n < 3) cycle
            if (minval(abs(t(first:first + n - 1) - times(i))) <= same*(t(first + n - 1) - t(first))) cycle
            fewer = lagrange(t(first:first + n - 2), x(first:first + n - 2), times(i))
            if (ieee_is_finite(fewer) .and. ieee_is_finite(values(i))) worst = max(worst, abs(values(i) - fewer))
         end associate
      end do
   end subroutine at_instants

   !> The polynomial through some points.
   pure real(wp) function lagrange(t, x, at) result(value)
      real(wp), intent(in) :: t(:)    !! (n) abscissas [s]
      real(wp), intent(in) :: x(:)    !! (n) values [any]
      real(wp), intent(in) :: at      !! where it is wanted [s]

      real(wp) :: weight
      integer :: i, k

      do k = 1, size(t)
         if (abs(at - t(k)) <= 0.0_wp) then
            value = x(k)
            return
         end if
      end do
      value = 0.0_wp
      do k = 1, size(t)
         weight = 1.0_wp
         do i = 1, size(t)
            if (i /= k) weight = weight*(at - t(i))/(t(k) - t(i))
         end do
         value = value + weight*x(k)
      end do
   end function lagrange

   !> The shift of b behind a with the least mean square of what is left: whole steps of a grid, then a step of Gauss and Newton.
   function lag_of(t, a, b) result(lag)
      real(wp), intent(in) :: t(:)    !! (n) instants [s]
      real(wp), intent(in) :: a(:)    !! (n) the first [any]
      real(wp), intent(in) :: b(:)    !! (n) the second [any]
      real(wp) :: lag                 !! NaN: a does not change, or the best shift is the greatest one [s]

      real(wp) :: grid(n_grid), least, slope(n_grid), square, step, x(n_grid), y(n_grid)
      integer :: best, first, k, last

      lag = not_a_number()
      if (size(t) < 8) return
      step = (t(size(t)) - t(1))/real(n_grid - 1, wp)
      if (.not. step > 0.0_wp) return
      grid = [(t(1) + step*real(k, wp), k=0, n_grid - 1)]
      x = on_grid(t, a, grid)
      y = on_grid(t, b, grid)
      if (maxval(x) - minval(x) <= 1.0e-12_wp*maxval(abs(x)) .or. maxval(y) - minval(y) <= 1.0e-12_wp*maxval(abs(y))) return
      least = huge(least)
      best = 0
      do k = -most_lag, most_lag
         square = sum((y(1 + most_lag:n_grid - most_lag) - x(1 + most_lag - k:n_grid - most_lag - k))**2)
         if (square < least .or. (.not. square > least .and. abs(k) < abs(best))) then
            least = square
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
