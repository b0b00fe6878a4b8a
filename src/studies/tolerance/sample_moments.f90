!> Mean and standard deviation of a sample, with intervals, from sums that grow member by member.
!>
!> Sums are those of x - r about a reference r next to the mean. The mean has Student's interval; the logarithm of the standard
!> deviation has the standard error sqrt((kappa - 1)/n)/2, kappa the fourth moment over the square of the second.
!> Source: M. G. Kendall, A. Stuart, The Advanced Theory of Statistics, vol. 1 (1977), section 10.5. Limits: independent members.
module sample_moments
   use batch_means, only: student
   use kinds, only: i8, not_a_number, wp
   use normal_distribution, only: normal_95
   implicit none (type, external)
   private
   public :: capability_of, sample_t

   !> A sample.
   type :: sample_t
      real(wp) :: reference = 0.0_wp       !! r [any]
      integer(i8) :: n = 0                 !! members
      real(wp) :: sums(4) = 0.0_wp         !! (4) of powers of x - r [any]
      real(wp) :: lowest = huge(1.0_wp)    !! lowest value [any]
      real(wp) :: highest = -huge(1.0_wp)  !! highest value [any]
   contains
      procedure :: add => sample_add
      procedure :: moments => sample_moments_of
   end type sample_t

contains

   !> Add members.
   pure subroutine sample_add(self, x)
      class(sample_t), intent(inout) :: self   !! the sample
      real(wp), intent(in) :: x(:)             !! (n) values [any]

      real(wp) :: z(size(x))

      z = x - self%reference
      self%n = self%n + size(x)
      self%sums = self%sums + [sum(z), sum(z**2), sum(z**3), sum(z**4)]
      self%lowest = min(self%lowest, minval(x))
      self%highest = max(self%highest, maxval(x))
   end subroutine sample_add

   !> Mean, half of its interval, standard deviation, ends of its interval; NaN of fewer than two members.
   pure subroutine sample_moments_of(self, mean, half, sigma, interval)
      class(sample_t), intent(in) :: self      !! the sample
      real(wp), intent(out) :: mean            !! mean [any]
      real(wp), intent(out) :: half            !! half of its interval of 95 % [any]
      real(wp), intent(out) :: sigma           !! standard deviation [any]
      real(wp), intent(out) :: interval(2)     !! (2) its interval of 95 % [any]

      real(wp) :: error, fourth, m(4), second

      mean = not_a_number()
      half = mean
      sigma = mean
      interval = mean
      if (self%n < 2) return
      m = self%sums/real(self%n, wp)
      mean = self%reference + m(1)
      second = max(m(2) - m(1)**2, 0.0_wp)
      fourth = m(4) - 4.0_wp*m(1)*m(3) + 6.0_wp*m(1)**2*m(2) - 3.0_wp*m(1)**4
      sigma = sqrt(second*self%n/real(self%n - 1_i8, wp))
      half = student(int(min(self%n - 1_i8, 1000000_i8)))*sigma/sqrt(real(self%n, wp))
      interval = sigma
      if (.not. second > 0.0_wp) return
      error = 0.5_wp*sqrt(max(fourth/second**2 - 1.0_wp, 0.0_wp)/real(self%n, wp))
      interval = sigma*exp([-normal_95, normal_95]*error)
   end subroutine sample_moments_of

   !> Process capability of a sample between limits, and its interval:
   !> $$ C_{pk} = \frac{\min(u - m, m - l)}{3 s}, \quad
   !>    \Delta = 1.96\sqrt{\frac{1}{9 n} + \frac{C_{pk}^2}{2(n - 1)}} . $$
   !> Negative where the mean m is beyond a limit. Source: A. F. Bissell, Appl. Statist. 39 (1990) 331-340. Limits: a normal sample.
   pure function capability_of(mean, sigma, n, lower, upper) result(capability)
      real(wp), intent(in) :: mean        !! m [any]
      real(wp), intent(in) :: sigma       !! s [any]
      integer(i8), intent(in) :: n        !! members, at least 2
      real(wp), intent(in) :: lower       !! l, -huge: none [any]
      real(wp), intent(in) :: upper       !! u, huge: none [any]
      real(wp) :: capability(3)           !! (3) value, ends of its interval of 95 %; NaN: no scatter [1]

      real(wp) :: half

      capability = not_a_number()
      if (.not. sigma > 0.0_wp) return
      capability = min(0.5_wp*upper - 0.5_wp*mean, 0.5_wp*mean - 0.5_wp*lower)/(1.5_wp*sigma)
      half = normal_95*sqrt(1.0_wp/(9.0_wp*real(n, wp)) + capability(1)**2/(2.0_wp*real(n - 1_i8, wp)))
      capability(2:3) = capability(1) + [-half, half]
   end function capability_of

end module sample_moments
