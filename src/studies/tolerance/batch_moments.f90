!> What parameters of one batch have in common: means and covariances.
!>
!> With z the standard normal number of a batch, and the mean of a deviation where it is known, m_i(z) = E(delta_i | z),
!> $$ C_{ij} = E\left((m_i - \mu_i)(m_j - \mu_j)\right), \quad i \ne j , $$
!> and the variance s_i^2 of a parameter has a part E((m_i - mu_i)^2) that comes from the batch. Expectations are sums over equal
!> steps of normal numbers; where values are few, m_i follows from the probability of each.
!> Source: R. B. Nelsen, An Introduction to Copulas (2006), section 2.3.
!> Limits: of parameters of few values with r = 1 covariances are known to 1e-3 of the variance.
module batch_moments
   use kinds, only: wp
   use normal_distribution, only: normal_density, normal_probability, normal_quantile
   use tolerated, only: joint_number, shape_measured, shape_two_point, tolerated_t
   implicit none (type, external)
   private
   public :: batch_moments_t

   real(wp), parameter :: far = 8.25_wp    !! largest normal number of the sums [1]
   integer, parameter :: n_common = 825    !! steps to that, of the number of a batch
   integer, parameter :: n_own = 100       !! the same, of the number of a parameter

   !> Means and covariances.
   type :: batch_moments_t
      integer, allocatable :: batch(:)       !! (parameters) number of its batch; 0: it deviates alone
      real(wp), allocatable :: means(:, :)   !! (numbers, parameters) m - mu at each number of the batch [any]
      real(wp), allocatable :: alone(:)      !! (parameters) variance that does not come from a batch [any]
   contains
      procedure :: variance => moments_variance
      procedure :: find => moments_find
      procedure :: covariance => moments_covariance
      procedure :: from_batch => moments_from_batch
   end type batch_moments_t

contains

   !> Find the means of all parameters.
   subroutine moments_find(self, parameters)
      class(batch_moments_t), intent(out) :: self       !! the moments
      type(tolerated_t), intent(in) :: parameters(:)    !! (parameters) with their batches

      integer :: k

      self%batch = parameters%batch
      self%alone = parameters%sigma**2
      allocate (self%means(-n_common:n_common, size(parameters)), source=0.0_wp)
      do k = 1, size(parameters)
         if (self%batch(k) == 0) cycle
         self%means(:, k) = means_of(parameters(k))
         self%means(:, k) = self%means(:, k) - sum(weights(n_common)*self%means(:, k))
         self%alone(k) = max(self%alone(k) - sum(weights(n_common)*self%means(:, k)**2), 0.0_wp)
      end do
   end subroutine moments_find

   !> Variance of a channel to first order.
   pure real(wp) function moments_variance(self, slopes) result(variance)
      class(batch_moments_t), intent(in) :: self   !! the moments
      real(wp), intent(in) :: slopes(:)            !! (parameters) derivatives of the channel [any]

      integer :: k

      variance = sum(slopes**2*self%alone)
      do k = 1, maxval([0, self%batch])
         variance = variance + self%from_batch(k, slopes)
      end do
   end function moments_variance

   !> Covariance of two parameters.
   pure real(wp) function moments_covariance(self, i, j) result(c)
      class(batch_moments_t), intent(in) :: self   !! the moments
      integer, intent(in) :: i                     !! number of a parameter
      integer, intent(in) :: j                     !! number of another

      c = 0.0_wp
      if (self%batch(i) == 0 .or. self%batch(i) /= self%batch(j)) return
      c = sum(weights(n_common)*self%means(:, i)*self%means(:, j))
   end function moments_covariance

   !> What a batch adds to the variance of a channel to first order.
   pure real(wp) function moments_from_batch(self, number, slopes) result(variance)
      class(batch_moments_t), intent(in) :: self   !! the moments
      integer, intent(in) :: number                !! of the batch
      real(wp), intent(in) :: slopes(:)            !! (parameters) derivatives of the channel [any]

      variance = sum(weights(n_common)*matmul(self%means, merge(slopes, 0.0_wp, self%batch == number))**2)
   end function moments_from_batch

   !> Means of a deviation at each number of its batch.
   pure function means_of(parameter) result(means)
      type(tolerated_t), intent(in) :: parameter     !! the parameter
      real(wp) :: means(-n_common:n_common)          !! m [any]

      real(wp) :: at(1), own(-n_own:n_own), share(-n_own:n_own), z(-n_common:n_common)
      integer :: i, k

      share = weights(n_own)
      own = numbers(n_own)
      z = numbers(n_common)
      means = 0.0_wp
      associate (r => parameter%in_batch)
         do k = -n_common, n_common
            select case (parameter%shape)
            case (shape_two_point)
               means(k) = mean_of_few(z(k), r, [parameter%lower, parameter%upper], [0.5_wp, 1.0_wp])
            case (shape_measured)
               means(k) = mean_of_few(z(k), r, parameter%values, parameter%upto)
            case default
               do i = -n_own, n_own
                  at = joint_number(own(i), z(k), r)
                  means(k) = means(k) + share(i)*parameter%deviation(at)
               end do
            end select
         end do
      end associate
   end function means_of

   !> Mean of few values where the number of the batch is known.
   pure real(wp) function mean_of_few(z, r, values, upto) result(mean)
      real(wp), intent(in) :: z           !! number of the batch [1]
      real(wp), intent(in) :: r           !! part of the variance that the batch has [1]
      real(wp), intent(in) :: values(:)   !! (values) rising [any]
      real(wp), intent(in) :: upto(:)     !! (values) probability of a value up to each [1]

      real(wp) :: above
      integer :: k

      mean = values(1)
      do k = 1, size(values) - 1
         above = sqrt(r)*z - normal_quantile(upto(k))
         if (r < 1.0_wp) above = normal_probability(above/sqrt(1.0_wp - r))
         if (.not. r < 1.0_wp) above = merge(1.0_wp, 0.0_wp, above > 0.0_wp)
         mean = mean + above*(values(k + 1) - values(k))
      end do
   end function mean_of_few

   !> Standard normal numbers in equal steps.
   pure function numbers(n)
      integer, intent(in) :: n             !! steps to the largest
      real(wp) :: numbers(-n:n)            !! the numbers [1]

      integer :: k

      numbers = [(far*k/n, k=-n, n)]
   end function numbers

   !> Weights of such numbers in an expectation.
   pure function weights(n)
      integer, intent(in) :: n             !! steps to the largest
      real(wp) :: weights(-n:n)            !! the weights [1]

      integer :: k

      weights = [(normal_density(far*k/n), k=-n, n)]
      weights = weights/sum(weights)
   end function weights

end module batch_moments
