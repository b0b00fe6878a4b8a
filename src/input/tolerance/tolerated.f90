!> A parameter with its tolerance: limits, distribution, moments, and samples from uniform random numbers.
!>
!> Deviations are those from the nominal value. The process has the mean m and the standard deviation sigma = T/(3 Cp), T half the
!> distance of the limits. Truncated at the limits, with z = (x - m)/sigma and a, b those of the limits, it has
!> $$ \mu = m + \sigma\frac{\varphi(a) - \varphi(b)}{\Phi(b) - \Phi(a)}, \quad
!>    s^2 = \sigma^2\left(1 + \frac{a\varphi(a) - b\varphi(b)}{\Phi(b) - \Phi(a)}\right) - (\mu - m)^2 . $$
!> The radial clearance of a fit is c = (D - d)/2 of two such diameters. Measured values x_k with the counts w_k have
!> $$ \mu = \frac{\sum_k w_k x_k}{\sum_k w_k}, \quad s^2 = \frac{\sum_k w_k (x_k - \mu)^2}{\sum_k w_k} . $$
!> Parameters of one batch deviate together: with standard normal numbers z of the batch and z_i of the parameter, its random number
!> has the normal number (a Gaussian copula)
!> $$ \sqrt{r_i} z + \sqrt{1 - r_i} z_i . $$
!> Sources: N. L. Johnson, S. Kotz, N. Balakrishnan, Continuous Univariate Distributions, vol. 1 (1994), section 13.10.1;
!> R. B. Nelsen, An Introduction to Copulas (2006), section 2.3.
module tolerated
   use kind_info, only: dim_none, dim_t
   use kinds, only: wp
   use normal_distribution, only: normal_density, normal_probability, normal_quantile
   implicit none (type, external)
   private
   public :: joint_number, most_random, new_fit, new_measured, new_tolerance, shape_lognormal, shape_measured, shape_normal, &
      shape_triangular, shape_truncated, shape_two_point, shape_uniform, tolerated_t

   integer, parameter :: shape_normal = 1      !! normal, without limits
   integer, parameter :: shape_truncated = 2   !! normal, truncated at the limits
   integer, parameter :: shape_uniform = 3     !! uniform between the limits
   integer, parameter :: shape_triangular = 4  !! triangular between the limits
   integer, parameter :: shape_lognormal = 5   !! lognormal, of a positive value
   integer, parameter :: shape_two_point = 6   !! one of the limits
   integer, parameter :: shape_measured = 7    !! values as they were measured
   integer, parameter :: shape_clearance = 8   !! half the difference of two truncated normal diameters
   integer, parameter :: most_random = 2       !! random numbers of a deviation, at most

   !> A normal distribution between limits.
   type :: part_t
      real(wp) :: lower = 0.0_wp   !! lower limit [any]
      real(wp) :: upper = 0.0_wp   !! upper limit [any]
      real(wp) :: mean = 0.0_wp    !! mean of the process [any]
      real(wp) :: sigma = 0.0_wp   !! standard deviation of the process; 0: there is no scatter [any]
      real(wp) :: below = 0.0_wp   !! probability of less than the lower limit in the process [1]
      real(wp) :: inside = 1.0_wp  !! probability of values between the limits in the process [1]
   end type part_t

   !> A parameter with its tolerance.
   type :: tolerated_t
      character(:), allocatable :: name       !! of the parameter
      type(dim_t) :: dimension = dim_none     !! of its value
      real(wp) :: nominal = 0.0_wp            !! its value in the deck, SI [any]
      real(wp) :: lower = 0.0_wp              !! lower limit less the nominal value [any]
      real(wp) :: upper = 0.0_wp              !! upper limit less the nominal value [any]
      real(wp) :: mean = 0.0_wp               !! mean less the nominal value [any]
      real(wp) :: sigma = 0.0_wp              !! standard deviation [any]
      integer :: shape = shape_truncated      !! its distribution, one of the above
      real(wp), allocatable :: values(:)      !! (values) measured deviations, rising; unallocated: none were measured [any]
      real(wp), allocatable :: upto(:)        !! (values) part of the measured ones up to each [1]
      integer :: batch = 0                    !! number of its batch; 0: it deviates alone
      real(wp) :: in_batch = 0.0_wp           !! r: part of the variance of normal deviations that its batch has [1]
      type(part_t) :: parts(2)                !! (2) of normal shapes: the process; of a fit: hole and shaft, diameters
   contains
      procedure :: n_random
      procedure :: deviation
   end type tolerated_t

contains

   !> A parameter between limits.
   pure subroutine new_tolerance(self, shape, lower, upper, cp, shift)
      type(tolerated_t), intent(inout) :: self   !! name and nominal value are set; the rest is
      integer, intent(in) :: shape               !! distribution
      real(wp), intent(in) :: lower              !! lower limit less the nominal value [any]
      real(wp), intent(in) :: upper              !! upper limit less the nominal value [any]
      real(wp), intent(in) :: cp                 !! process capability [1]
      real(wp), intent(in) :: shift              !! mean of the process less the middle of the limits [any]

      self%shape = shape
      self%lower = lower
      self%upper = upper
      self%mean = 0.5_wp*(lower + upper)
      select case (shape)
      case (shape_normal, shape_lognormal)
         self%mean = self%mean + shift
         self%sigma = 0.5_wp*(upper - lower)/(3.0_wp*cp)
      case (shape_uniform)
         self%sigma = 0.5_wp*(upper - lower)/sqrt(3.0_wp)
      case (shape_triangular)
         self%sigma = 0.5_wp*(upper - lower)/sqrt(6.0_wp)
      case (shape_two_point)
         self%sigma = 0.5_wp*(upper - lower)
      case default
         self%parts(1) = new_part([lower, upper], cp, shift)
         call find_moments(self%parts(1), self%mean, self%sigma)
      end select
   end subroutine new_tolerance

   !> A parameter as it was measured.
   pure subroutine new_measured(self, values, counts)
      type(tolerated_t), intent(inout) :: self   !! name and nominal value are set; the rest is
      real(wp), intent(in) :: values(:)          !! (values) of the parameter [any]
      real(wp), intent(in) :: counts(:)          !! (values) parts that have each, positive [1]

      logical :: is_left(size(values))
      real(wp) :: part(size(values))
      integer :: at, k

      self%shape = shape_measured
      allocate (self%values(size(values)), self%upto(size(values)))
      is_left = .true.
      do k = 1, size(values)
         at = minloc(values, dim=1, mask=is_left)
         is_left(at) = .false.
         self%values(k) = values(at) - self%nominal
         part(k) = counts(at)/sum(counts)
         self%upto(k) = sum(part(:k))
      end do
      self%upto(size(values)) = 1.0_wp
      self%lower = self%values(1)
      self%upper = self%values(size(values))
      self%mean = sum(part*self%values)
      self%sigma = sqrt(sum(part*(self%values - self%mean)**2))
   end subroutine new_measured

   !> The radial clearance of a hole and a shaft.
   pure subroutine new_fit(self, hole, shaft, cp)
      type(tolerated_t), intent(inout) :: self   !! name and nominal clearance are set; the rest is
      real(wp), intent(in) :: hole(2)            !! (2) lower and upper deviation of the hole's diameter [m]
      real(wp), intent(in) :: shaft(2)           !! (2) lower and upper deviation of the shaft's diameter [m]
      real(wp), intent(in) :: cp                 !! process capability of both [1]

      real(wp) :: mean(2), sigma(2)
      integer :: k

      self%shape = shape_clearance
      self%parts = [new_part(hole, cp, 0.0_wp), new_part(shaft, cp, 0.0_wp)]
      do k = 1, 2
         call find_moments(self%parts(k), mean(k), sigma(k))
      end do
      self%lower = 0.5_wp*(hole(1) - shaft(2)) - self%nominal
      self%upper = 0.5_wp*(hole(2) - shaft(1)) - self%nominal
      self%mean = 0.5_wp*(mean(1) - mean(2)) - self%nominal
      self%sigma = 0.5_wp*norm2(sigma)
   end subroutine new_fit

   !> A process between limits.
   pure type(part_t) function new_part(limits, cp, shift) result(part)
      real(wp), intent(in) :: limits(2)   !! (2) lower and upper limit [any]
      real(wp), intent(in) :: cp          !! process capability [1]
      real(wp), intent(in) :: shift       !! mean of the process less the middle of the limits [any]

      part%lower = limits(1)
      part%upper = limits(2)
      part%mean = 0.5_wp*(limits(1) + limits(2)) + shift
      part%sigma = 0.5_wp*(limits(2) - limits(1))/(3.0_wp*cp)
      if (.not. part%sigma > 0.0_wp) return
      part%below = normal_probability((part%lower - part%mean)/part%sigma)
      part%inside = normal_probability((part%upper - part%mean)/part%sigma) - part%below
   end function new_part

   !> Mean and standard deviation of a process truncated at its limits.
   pure subroutine find_moments(part, mean, sigma)
      type(part_t), intent(in) :: part   !! the process
      real(wp), intent(out) :: mean      !! mean [any]
      real(wp), intent(out) :: sigma     !! standard deviation [any]

      real(wp) :: a, b, change

      mean = part%mean
      sigma = 0.0_wp
      if (.not. part%sigma > 0.0_wp) return
      a = (part%lower - part%mean)/part%sigma
      b = (part%upper - part%mean)/part%sigma
      change = (normal_density(a) - normal_density(b))/part%inside
      mean = part%mean + part%sigma*change
      sigma = part%sigma*sqrt(1.0_wp + (a*normal_density(a) - b*normal_density(b))/part%inside - change**2)
   end subroutine find_moments

   !> Random numbers that a deviation takes.
   pure integer function n_random(self)
      class(tolerated_t), intent(in) :: self   !! the parameter

      n_random = merge(2, 1, self%shape == shape_clearance)
   end function n_random

   !> Deviation from the nominal value.
   pure real(wp) function deviation(self, u) result(x)
      class(tolerated_t), intent(in) :: self   !! the parameter
      real(wp), intent(in) :: u(:)             !! (n_random or more) random numbers, uniform between 0 and 1, both excluded [1]

      real(wp) :: spread

      select case (self%shape)
      case (shape_normal)
         x = self%mean + self%sigma*normal_quantile(u(1))
      case (shape_truncated)
         x = truncated(self%parts(1), u(1))
      case (shape_uniform)
         x = self%lower + u(1)*(self%upper - self%lower)
      case (shape_triangular)
         spread = 1.0_wp - sqrt(2.0_wp*min(u(1), 1.0_wp - u(1)))
         x = 0.5_wp*(self%lower + self%upper + sign(spread, u(1) - 0.5_wp)*(self%upper - self%lower))
      case (shape_lognormal)
         spread = sqrt(log(1.0_wp + (self%sigma/(self%nominal + self%mean))**2))
         x = (self%nominal + self%mean)*exp(spread*normal_quantile(u(1)) - 0.5_wp*spread**2) - self%nominal
      case (shape_two_point)
         x = merge(self%lower, self%upper, u(1) < 0.5_wp)
      case (shape_measured)
         x = self%values(findloc(u(1) <= self%upto, .true., dim=1))
      case default
         x = 0.5_wp*(truncated(self%parts(1), u(1)) - truncated(self%parts(2), u(2))) - self%nominal
      end select
   end function deviation

   !> Random number of a parameter of a batch.
   elemental real(wp) function joint_number(own, common, in_batch) result(u)
      real(wp), intent(in) :: own        !! its own standard normal number [1]
      real(wp), intent(in) :: common     !! that of the batch [1]
      real(wp), intent(in) :: in_batch   !! r [1]

      u = normal_probability(sqrt(in_batch)*common + sqrt(1.0_wp - in_batch)*own)
      u = min(max(u, tiny(u)), 1.0_wp - 0.5_wp*epsilon(u))  ! both ends are excluded
   end function joint_number

   !> A value of a process truncated at its limits.
   pure real(wp) function truncated(part, u) result(x)
      type(part_t), intent(in) :: part   !! the process
      real(wp), intent(in) :: u          !! random number [1]

      x = part%mean
      if (.not. part%sigma > 0.0_wp) return
      x = part%mean + part%sigma*normal_quantile(part%below + u*part%inside)
      x = min(max(x, part%lower), part%upper)
   end function truncated

end module tolerated
