!> The mean of a series that remembers, with its interval of confidence, by batches.
!>
!> The values are averaged over n_b batches of equal length. Where a batch is longer than the memory of the series, batch means
!> m_b are as good as independent, and the mean m lies in
!> $$ m \pm t_{0.975, n_b - 1} \, s_b/\sqrt{n_b}, \quad s_b^2 = \frac{1}{n_b - 1} \sum_b (m_b - m)^2 . $$
!> Batches are doubled in length as long as neighbouring ones go together or against each other (first autocorrelation beyond
!> 2/sqrt(n_b)) and enough of them are left. Of increments of something that also swings, weights 6 s (1 - s) over the place s in a
!> batch leave the swing out: so the mean of a batch is the slope of the line of least squares. The effective number of values is
!> s^2/(s_b^2/n_b), s^2 their own variance: so many independent ones would report as much.
!>
!> Source: A. M. Law, W. D. Kelton, Simulation Modeling and Analysis, 3rd ed. (2000), section 9.5.3; Student's t: M. Abramowitz,
!> I. A. Stegun, Handbook of Mathematical Functions (1964), eq. 26.7.5.
!> Limits: a series that is stationary; one that remembers longer than a batch has too short an interval.
module batch_means
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: estimate_t, fewest_batches, mean_of_batches, mean_of_series, means_of_batches, student

   integer, parameter :: most_batches = 32    !! batches that a series is cut into at first
   integer, parameter :: fewest_batches = 8   !! below which there is no interval

   !> A mean and how well it is known.
   type :: estimate_t
      real(wp) :: value = 0.0_wp        !! the mean; NaN: not known [any]
      real(wp) :: half = 0.0_wp         !! half of its interval of 95 %; NaN: not known [any]
      integer :: n_batch = 0            !! batches
      real(wp) :: n_effective = 0.0_wp  !! effective number of values; NaN: not known [1]
   end type estimate_t

contains

   !> The mean of a series of values, each of the same weight.
   pure function mean_of_series(x, is_increment) result(estimate)
      real(wp), intent(in) :: x(:)                   !! (n) values in their order [any]
      logical, intent(in), optional :: is_increment  !! they are those of something that swings too
      type(estimate_t) :: estimate                   !! their mean

      real(wp), allocatable :: means(:)
      real(wp) :: of_mean, spread
      integer :: n_batch

      n_batch = min(most_batches, size(x))
      do
         means = means_of_batches(x, n_batch, is_increment)
         if (n_batch/2 < fewest_batches) exit
         if (abs(neighbour_correlation(means)) <= 2.0_wp/sqrt(real(n_batch, wp))) exit
         n_batch = n_batch/2
      end do
      estimate = mean_of_batches(means)
      estimate%n_effective = not_a_number()
      if (n_batch < fewest_batches) return
      spread = sum((x - estimate%value)**2)/real(size(x) - 1, wp)
      of_mean = sum((means - estimate%value)**2)/real((n_batch - 1)*n_batch, wp)
      estimate%n_effective = real(size(x), wp)
      if (of_mean > 0.0_wp) estimate%n_effective = spread/of_mean
   end function mean_of_series

   !> The mean of what was found in batches that are as good as independent; fewer than `fewest_batches` have no interval.
   pure function mean_of_batches(means) result(estimate)
      real(wp), intent(in) :: means(:)    !! (n_batch) a value of each [any]
      type(estimate_t) :: estimate        !! their mean

      real(wp) :: n

      n = real(size(means), wp)
      estimate%n_batch = size(means)
      estimate%n_effective = n
      estimate%value = not_a_number()
      estimate%half = not_a_number()
      if (size(means) == 0) return
      estimate%value = sum(means)/n
      if (size(means) < fewest_batches) return
      estimate%half = student(size(means) - 1)*sqrt(sum((means - estimate%value)**2)/((n - 1.0_wp)*n))
   end function mean_of_batches

   !> Means of batches of equal length; what is left over of the series is omitted at its start.
   pure function means_of_batches(x, n_batch, is_increment) result(means)
      real(wp), intent(in) :: x(:)                   !! (n) values in their order [any]
      integer, intent(in) :: n_batch                 !! batches, not more than values
      logical, intent(in), optional :: is_increment  !! values are weighted by their place
      real(wp), allocatable :: means(:)              !! (n_batch) their means [any]

      real(wp), allocatable :: weight(:)
      integer :: each, first, k

      allocate (means(n_batch))
      if (n_batch == 0) return
      each = size(x)/n_batch
      first = size(x) - each*n_batch
      allocate (weight(each), source=1.0_wp)
      if (present(is_increment)) then
         if (is_increment) weight = [(real(k, wp)*real(each + 1 - k, wp), k=1, each)]
      end if
      weight = weight/sum(weight)
      do k = 1, n_batch
         means(k) = dot_product(weight, x(first + each*(k - 1) + 1:first + each*k))
      end do
   end function means_of_batches

   !> First autocorrelation; 0 of a series that does not change.
   pure real(wp) function neighbour_correlation(x) result(r)
      real(wp), intent(in) :: x(:)        !! (n) the series [any]

      real(wp) :: mean, square

      r = 0.0_wp
      if (size(x) < 2) return
      mean = sum(x)/real(size(x), wp)
      square = sum((x - mean)**2)
      if (square > 0.0_wp) r = sum((x(2:) - mean)*(x(:size(x) - 1) - mean))/square
   end function neighbour_correlation

   !> The quantile 0.975 of Student's t, for an interval of 95 % on both sides.
   pure real(wp) function student(freedom) result(t)
      integer, intent(in) :: freedom      !! degrees of freedom, from 1 on

      real(wp), parameter :: normal = 1.959963984540054_wp  ! quantile 0.975 of the normal distribution [1]
      real(wp), parameter :: few(4) = [12.706205_wp, 4.302653_wp, 3.182446_wp, 2.776445_wp]  ! (4) of 1 to 4 degrees [1]
      real(wp) :: n, x2

      if (freedom <= size(few)) then
         t = few(max(1, freedom))
         return
      end if
      n = real(freedom, wp)
      x2 = normal**2
      t = normal*(1.0_wp + (x2 + 1.0_wp)/(4.0_wp*n) + ((5.0_wp*x2 + 16.0_wp)*x2 + 3.0_wp)/(96.0_wp*n**2) + &
                  (((3.0_wp*x2 + 19.0_wp)*x2 + 17.0_wp)*x2 - 15.0_wp)/(384.0_wp*n**3) + &
                  ((((79.0_wp*x2 + 776.0_wp)*x2 + 1482.0_wp)*x2 - 1920.0_wp)*x2 - 945.0_wp)/(92160.0_wp*n**4))
   end function student

end module batch_means
