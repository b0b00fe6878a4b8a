!> How fast runs from neighbouring starts part, and up to what time a trajectory has how many digits.
!>
!> The distance of neighbouring trajectory runs is d(t), that of their starts d(0). Where it grows exponentially,
!> $$ \ln d(t) = a + \lambda t, $$
!> lambda is found by least squares over the stretch after the first decays and before the distance is so large that it
!> no longer grows; of a motion on an attractor it tends to the largest Lyapunov exponent. Regular motion has
!> $$ \ln d(t) = a + p \ln t. $$
!> The better of the two is taken; growth is exponential only if each half of the stretch grows, and if it would take more than a
!> small power of time it is that. An error of one unit in the last place at the start has grown to A(t) eps, A the maximum
!> d/d(0) so far; up to A(t) eps = 10^-k any trajectory computed in this arithmetic can have k digits at best.
!>
!> Source: G. Benettin, L. Galgani, J.-M. Strelcyn (1976), Phys. Rev. A 14, 2338-2345 (neighbouring trajectories).
!> Limits: a stretch of time, not an average over an attractor; neighbouring trajectories are not brought near again.
module growth
   use kinds, only: eps, not_a_number, wp
   implicit none (type, external)
   private
   public :: find_growth, growth_t, n_digit

   integer, parameter :: n_digit = 12                 !! most digits whose horizon is reported
   real(wp), parameter :: saturated = 0.02_wp         !! distance from which it is no longer small [1]
   real(wp), parameter :: first_part = 0.25_wp        !! of the stretch, which the fit leaves to decaying parts [1]
   real(wp), parameter :: min_growth = 2.0_wp       !! of ln d over the fit, below which nothing is exponential [1]
   real(wp), parameter :: min_part = 0.25_wp        !! of lambda that each half of the stretch must show by itself [1]
   real(wp), parameter :: max_power = 4.0_wp     !! of time that regular motion has [1]
   real(wp), parameter :: two_sided = 2.0_wp          !! standard errors on each side of an interval of about 95 % [1]
   integer, parameter :: fewest = 8                   !! instants of a fit

   !> What neighbouring trajectories report.
   type :: growth_t
      integer :: n_twin = 0                           !! neighbouring trajectories that ran to the end
      character(:), allocatable :: reason             !! why nothing is known; blank: it is
      logical :: is_exponential = .false.             !! growth is exponential, not a power of time
      logical :: is_regular = .false.                 !! growth is a small power of time
      real(wp) :: rate = 0.0_wp                       !! lambda [s^-1]
      real(wp) :: rate_interval = 0.0_wp              !! half of its interval of about 95 % [s^-1]
      real(wp) :: power = 0.0_wp                      !! p of regular motion [1]
      real(wp) :: power_interval = 0.0_wp             !! half of its interval of about 95 % [1]
      real(wp) :: fit_begin = 0.0_wp                  !! first time of the fit [s]
      real(wp) :: fit_end = 0.0_wp                    !! last time of the fit [s]
      real(wp) :: offset = 0.0_wp                     !! a of the law that was taken [1]
      real(wp) :: horizon(n_digit) = 0.0_wp           !! (k) time up to which there can be k digits; NaN: beyond the run [s]
      real(wp), allocatable :: t(:)                   !! (n) instants [s]
      real(wp), allocatable :: ratio(:, :)            !! (n, neighbouring trajectories) d(t)/d(0) [1]
   end type growth_t

contains

   !> Find the law of growth and the horizons. neighbouring trajectories' distances are in the growth already.
   subroutine find_growth(growth, start_distance)
      type(growth_t), intent(inout) :: growth        !! instants and ratios are set, the rest follows
      real(wp), intent(in) :: start_distance         !! maximum d(0) of neighbouring trajectories [1]

      real(wp), allocatable :: level(:)
      real(wp) :: errors(2), halves(2, 2), law(2, 2), own(2), spread(2), sums(2)
      integer :: first, k, last, middle, n

      n = size(growth%t)
      level = [(sum(log(max(growth%ratio(k, :), tiny(1.0_wp))))/real(growth%n_twin, wp), k=1, n)]
      do last = 2, n
         if (maxval(growth%ratio(last, :))*start_distance > saturated) exit
      end do
      last = last - 1
      first = max(2, count(growth%t <= growth%t(1) + first_part*(growth%t(last) - growth%t(1))))
      if (last - first + 1 < fewest) then
         growth%reason = "the neighbouring trajectories separate within a few time points; use more time points"
         growth%horizon = not_a_number()
         return
      end if
      associate (t => growth%t(first:last), y => level(first:last))
         call fit(t, y, law(:, 1), errors(1), sums(1))
         call fit(log(t), y, law(:, 2), errors(2), sums(2))
         spread = 0.0_wp
         do k = 1, growth%n_twin
            associate (one => log(max(growth%ratio(first:last, k), tiny(1.0_wp))))
               call fit(t, one, own)
               spread(1) = spread(1) + (own(2) - law(2, 1))**2
               call fit(log(t), one, own)
               spread(2) = spread(2) + (own(2) - law(2, 2))**2
            end associate
         end do
         spread = sqrt(spread/real(max(1, growth%n_twin*(growth%n_twin - 1)), wp))
         middle = size(t)/2
         call fit(t(:middle), y(:middle), halves(:, 1))
         call fit(t(middle:), y(middle:), halves(:, 2))
         growth%is_exponential = all(halves(2, :) > min_part*law(2, 1)) .and. &
                                 law(2, 1)*(t(size(t)) - t(1)) > min_growth .and. &
                                 (sums(1) < sums(2) .or. law(2, 2) > max_power)
         growth%fit_begin = t(1)
         growth%fit_end = t(size(t))
      end associate
      growth%rate = law(2, 1)
      growth%rate_interval = max(two_sided*max(errors(1), spread(1)), 0.5_wp*abs(halves(2, 2) - halves(2, 1)))
      growth%power = law(2, 2)
      growth%power_interval = two_sided*max(errors(2), spread(2))
      growth%is_regular = .not. growth%is_exponential .and. growth%power <= max_power
      growth%offset = merge(law(1, 1), law(1, 2), growth%is_exponential)
      call find_horizons(growth, last)
   end subroutine find_growth

   !> A straight line by least squares.
   pure subroutine fit(x, y, law, error, left)
      real(wp), intent(in) :: x(:)                !! (n) abscissae, n > 2 [any]
      real(wp), intent(in) :: y(:)                !! (n) ordinates [any]
      real(wp), intent(out) :: law(2)             !! (2) value at 0, slope [any]
      real(wp), intent(out), optional :: error    !! standard error of the slope [any]
      real(wp), intent(out), optional :: left     !! sum of squares that is left [any]

      real(wp) :: middle(2), rest, square
      integer :: n

      n = size(x)
      middle = [sum(x), sum(y)]/real(n, wp)
      square = sum((x - middle(1))**2)
      law(2) = sum((x - middle(1))*(y - middle(2)))/square
      law(1) = middle(2) - law(2)*middle(1)
      rest = sum((y - law(1) - law(2)*x)**2)
      if (present(error)) error = sqrt(rest/real(n - 2, wp)/square)
      if (present(left)) left = rest
   end subroutine fit

   !> The times up to which there can be k digits: from the distances as long as they are small, then from their law.
   pure subroutine find_horizons(growth, last)
      type(growth_t), intent(inout) :: growth   !! horizons are set
      integer, intent(in) :: last               !! number of the last instant at which distances are small

      real(wp) :: maximum, grown
      integer :: i, k

      growth%horizon = not_a_number()
      do k = 1, n_digit
         maximum = 0.0_wp
         do i = 1, size(growth%t)
            if (i <= last) then
               maximum = max(maximum, maxval(growth%ratio(i, :)))
               grown = maximum
            else if (growth%is_exponential) then
               grown = maximum*exp(min(600.0_wp, growth%rate*(growth%t(i) - growth%t(last))))
            else
               grown = maximum*(growth%t(i)/growth%t(last))**max(0.0_wp, growth%power)
            end if
            if (grown*eps <= 10.0_wp**(-k)) cycle
            growth%horizon(k) = growth%t(max(1, i - 1))
            exit
         end do
      end do
   end subroutine find_horizons

end module growth
