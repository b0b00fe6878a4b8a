!> The standard normal distribution: density, distribution function and quantiles; Wilson's interval of a probability.
!>
!> Sources: M. J. Wichura, Algorithm AS 241, Appl. Statist. 37 (1988) 477-484 (PPND16, relative error 1e-16);
!> E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209-212.
module normal_distribution
   use kinds, only: i8, pi, wp
   implicit none (type, external)
   private
   public :: normal_95, normal_density, normal_probability, normal_quantile, wilson_interval

   real(wp), parameter :: normal_95 = 1.959963984540054_wp   !! quantile of 0.975: half of the interval of 95 % [1]

   ! coefficients of AS 241: numerators and denominators next to the median, in the middle and in the tails
   real(wp), parameter :: a(8) = [3.3871328727963666080e0_wp, 1.3314166789178437745e2_wp, 1.9715909503065514427e3_wp, &
      1.3731693765509461125e4_wp, 4.5921953931549871457e4_wp, 6.7265770927008700853e4_wp, 3.3430575583588128105e4_wp, &
      2.5090809287301226727e3_wp]
   real(wp), parameter :: b(8) = [1.0_wp, 4.2313330701600911252e1_wp, 6.8718700749205790830e2_wp, 5.3941960214247511077e3_wp, &
      2.1213794301586595867e4_wp, 3.9307895800092710610e4_wp, 2.8729085735721942674e4_wp, 5.2264952788528545610e3_wp]
   real(wp), parameter :: c(8) = [1.42343711074968357734e0_wp, 4.63033784615654529590e0_wp, 5.76949722146069140550e0_wp, &
      3.64784832476320460504e0_wp, 1.27045825245236838258e0_wp, 2.41780725177450611770e-1_wp, 2.27238449892691845833e-2_wp, &
      7.74545014278341407640e-4_wp]
   real(wp), parameter :: d(8) = [1.0_wp, 2.05319162663775882187e0_wp, 1.67638483018380384940e0_wp, 6.89767334985100004550e-1_wp, &
      1.48103976427480074590e-1_wp, 1.51986665636164571966e-2_wp, 5.47593808499534494600e-4_wp, 1.05075007164441684324e-9_wp]
   real(wp), parameter :: e(8) = [6.65790464350110377720e0_wp, 5.46378491116411436990e0_wp, 1.78482653991729133580e0_wp, &
      2.96560571828504891230e-1_wp, 2.65321895265761230930e-2_wp, 1.24266094738807843860e-3_wp, 2.71155556874348757815e-5_wp, &
      2.01033439929228813265e-7_wp]
   real(wp), parameter :: f(8) = [1.0_wp, 5.99832206555887937690e-1_wp, 1.36929880922735805310e-1_wp, &
      1.48753612908506148525e-2_wp, &
      7.86869131145613259100e-4_wp, 1.84631831751005468180e-5_wp, 1.42151175831644588870e-7_wp, 2.04426310338993978564e-15_wp]

contains

   !> Density.
   elemental real(wp) function normal_density(x)
      real(wp), intent(in) :: x   !! standard deviations from the mean [1]

      normal_density = exp(-0.5_wp*x*x)/sqrt(2.0_wp*pi)
   end function normal_density

   !> Probability of less than x.
   elemental real(wp) function normal_probability(x)
      real(wp), intent(in) :: x   !! standard deviations from the mean [1]

      normal_probability = 0.5_wp*erfc(-x/sqrt(2.0_wp))
   end function normal_probability

   !> Quantile of a probability.
   elemental real(wp) function normal_quantile(p) result(x)
      real(wp), intent(in) :: p   !! probability of less, between 0 and 1, both excluded [1]

      real(wp) :: q, r

      q = p - 0.5_wp
      if (abs(q) <= 0.425_wp) then
         r = 0.180625_wp - q*q
         x = q*ratio(a, b, r)
      else
         r = sqrt(-log(min(p, 1.0_wp - p)))
         if (r <= 5.0_wp) then
            x = ratio(c, d, r - 1.6_wp)
         else
            x = ratio(e, f, r - 5.0_wp)
         end if
         x = sign(x, q)
      end if
   end function normal_quantile

   !> Ratio of two polynomials of degree 7.
   pure real(wp) function ratio(top, bottom, r)
      real(wp), intent(in) :: top(8)      !! (8) coefficients of the numerator [1]
      real(wp), intent(in) :: bottom(8)   !! (8) coefficients of the denominator [1]
      real(wp), intent(in) :: r           !! argument [1]

      ratio = (((((((top(8)*r + top(7))*r + top(6))*r + top(5))*r + top(4))*r + top(3))*r + top(2))*r + top(1))/ &
              (((((((bottom(8)*r + bottom(7))*r + bottom(6))*r + bottom(5))*r + bottom(4))*r + bottom(3))*r + bottom(2))*r + &
               bottom(1))
   end function ratio

   !> Wilson's interval of 95 % of a probability, from a count.
   pure function wilson_interval(hits, n) result(interval)
      integer(i8), intent(in) :: hits   !! how often
      integer(i8), intent(in) :: n      !! of how many, positive
      real(wp) :: interval(2)           !! (2) its ends [1]

      real(wp) :: half, middle, p, z2

      z2 = normal_95**2
      p = real(hits, wp)/real(n, wp)
      middle = (p + 0.5_wp*z2/n)/(1.0_wp + z2/n)
      half = normal_95*sqrt(p*(1.0_wp - p)/n + 0.25_wp*z2/real(n, wp)**2)/(1.0_wp + z2/n)
      interval = [max(middle - half, 0.0_wp), min(middle + half, 1.0_wp)]
      if (hits == 0) interval(1) = 0.0_wp
      if (hits == n) interval(2) = 1.0_wp
   end function wilson_interval

end module normal_distribution
