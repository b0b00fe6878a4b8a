!> The largest Lyapunov exponent of a motion, and up to what time its digits mean anything.
!>
!> The exponent is the mean rate at which ln of a small change grows,
!> $$ \lambda = \frac{1}{T} \ln \frac{|w(t_0 + T)|}{|w(t_0)|}, $$
!> behind a transient, with an interval of 95 % from the slopes over batches of equal length. Where swings of |w| keep step with
!> the batches, all of these slopes are wrong alike: then the slope of the whole stretch is not within the interval, and it is
!> taken, with what both differ by as half of its interval. Where |w| changes by no more than t^2 would over the stretch, the
!> exponent is not reported from zero: regular motions grow like a power of time. An error e made at any time has grown to e R(t) at
!> most, R the maximum ratio of |w(t)| to |w(s)| of any s before: up to e R(t) = 10^-k there can be k digits.
!>
!> Source: G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9-30; batches: see `batch_means`.
!> Limits: the interval knows of what varies within the stretch; it is that of an attractor if the stretch has gone all over it.
module exponent
   use batch_means, only: estimate_t, mean_of_series, means_of_batches
   use growth, only: n_digit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: eps, not_a_number, wp
   implicit none (type, external)
   private
   public :: digits_of, exponent_t, find_exponent, horizon_t, verdict
   public :: verdict_apart, verdict_differ, verdict_even, verdict_together, verdict_unclear, verdict_unknown

   integer, parameter :: verdict_unknown = 0    !! the exponent is not known
   integer, parameter :: verdict_apart = 1      !! neighbouring motions part exponentially
   integer, parameter :: verdict_even = 2       !! neighbouring motions part no faster than a power of time
   integer, parameter :: verdict_together = 3   !! neighbouring motions come together
   integer, parameter :: verdict_unclear = 4    !! the interval has both signs
   integer, parameter :: verdict_differ = 5     !! both methods are known, and differ by more than their intervals

   !> What a method says of it.
   type :: exponent_t
      character(:), allocatable :: reason           !! why it is not known; blank: it is
      type(estimate_t) :: rate                      !! the exponent [s^-1]
      real(wp), allocatable :: growth(:)            !! (instants) ln of the change over that of the start; NaN: not known [1]
   end type exponent_t

   !> What is known of the horizon.
   type :: horizon_t
      real(wp), allocatable :: t(:)                 !! (instants) equal parts of the stretch, with the start [s]
      real(wp) :: after = 0.0_wp                    !! end of the transient [s]
      real(wp) :: tolerance = 0.0_wp                !! of the motions [1]
      real(wp) :: asked = 0.0_wp                    !! tolerance of the run that it is for; 0: none [1]
      type(exponent_t) :: tangent                   !! by the tangent, with the jumps at events
      type(exponent_t) :: twin                      !! by a neighbouring trajectory that is brought near again and again
      integer :: n_crossed = 0                      !! events with a jump of the tangent
      integer :: n_grazed = 0                       !! events whose jump is not known: they graze
      integer :: n_together = 0                     !! instants of several events
      integer :: n_renewed = 0                      !! times that the neighbouring trajectory was brought near again
      real(wp) :: digits(n_digit) = 0.0_wp          !! (k) time up to which doubles can have k digits; NaN: beyond [s]
      real(wp) :: run_digits(n_digit) = 0.0_wp      !! (k) the same of a run of tolerance `asked` [s]
      logical :: is_cut = .false.                   !! the instants end where the time was up
      logical :: with_twin = .false.                !! the neighbouring trajectory was asked for
      logical :: is_agreed = .false.                !! both methods are known, and agree within their intervals
   end type horizon_t

contains

   !> The exponent behind a transient, from the growth at equally spaced instants.
   subroutine find_exponent(t, after, exponent)
      real(wp), intent(in) :: t(:)                      !! (instants) their times [s]
      real(wp), intent(in) :: after                     !! end of the transient [s]
      type(exponent_t), intent(inout) :: exponent       !! growth is set; the rate follows

      real(wp), allocatable :: slopes(:)
      integer :: first, n

      n = size(t)
      first = min(n, 1 + count(t(2:) <= after*(1.0_wp + 1.0e-9_wp)))
      exponent%rate = mean_of_series([real(wp) ::])
      if (exponent%reason /= "") return
      if (.not. all(ieee_is_finite(exponent%growth(first:)))) then
         exponent%reason = "the growth is unknown at some times"
         return
      end if
      associate (g => exponent%growth(first:), at => t(first:))
         n = size(g)
         slopes = (g(2:) - g(:n - 1))/(at(2:) - at(:n - 1))
      end associate
      exponent%rate = mean_of_series(slopes, is_increment=.true.)
      associate (rate => exponent%rate, whole => means_of_batches(slopes, 1, is_increment=.true.))
         if (abs(rate%value - whole(1)) > rate%half) then
            rate%half = abs(rate%value - whole(1))
            rate%value = whole(1)
         end if
      end associate
      if (ieee_is_finite(exponent%rate%half)) return
      exponent%reason = "too few times after the transient"
   end subroutine find_exponent

   !> What the exponent means; of the tangent if it is known, else of the neighbouring trajectory, and nothing where they differ.
   pure integer function verdict(horizon)
      type(horizon_t), intent(in) :: horizon   !! what is known

      real(wp), parameter :: max_power = 2.0_wp   ! of time, that is not called exponential [1]
      real(wp), parameter :: earliest = 0.1_wp         ! part of the end from which powers of time are looked at [1]
      type(estimate_t) :: rate
      real(wp) :: end, from

      verdict = verdict_differ
      if (horizon%tangent%reason == "" .and. horizon%twin%reason == "" .and. .not. horizon%is_agreed) return
      verdict = verdict_unknown
      if (horizon%tangent%reason == "") then
         rate = horizon%tangent%rate
      else if (horizon%twin%reason == "") then
         rate = horizon%twin%rate
      else
         return
      end if
      verdict = verdict_even
      end = horizon%t(size(horizon%t))
      from = max(horizon%after, earliest*end)
      if (abs(rate%value)*(end - from) <= max_power*log(end/from)) return
      verdict = verdict_unclear
      if (rate%value - rate%half > 0.0_wp) verdict = verdict_apart
      if (rate%value + rate%half < 0.0_wp) verdict = verdict_together
   end function verdict

   !> Times up to which there can be so many digits, if errors of some size are made all the time.
   pure function digits_of(t, growth, error) result(until)
      real(wp), intent(in) :: t(:)             !! (instants) their times [s]
      real(wp), intent(in) :: growth(:)        !! (instants) ln of the change [1]
      real(wp), intent(in) :: error            !! the errors, of the scale of the motion [1]
      real(wp) :: until(n_digit)               !! (k) times of k digits; NaN: beyond the last instant [s]

      real(wp) :: maximum, minimum
      integer :: i, k

      until = not_a_number()
      minimum = growth(1)
      maximum = 0.0_wp
      do i = 1, size(t)
         minimum = min(minimum, growth(i))
         maximum = max(maximum, growth(i) - minimum)
         do k = 1, n_digit
            if (ieee_is_finite(until(k))) cycle
            if (log(max(error, eps)) + maximum > -real(k, wp)*log(10.0_wp)) until(k) = t(max(1, i - 1))
         end do
      end do
   end function digits_of

end module exponent
