!> What a fit knows of its unknowns: covariance, correlations, 95 % intervals, and unknowns that the data do not see.
!>
!> With J = U S V^T at the minimum and the standard deviation s of a residual,
!>
!> $$ C = s^2 (J^T J)^{-1} = s^2 \sum_k \frac{v_k v_k^T}{\sigma_k^2} , $$
!>
!> over singular values that are not negligible. An interval is u +- q sqrt(C_uu), cut at the bounds; q is the quantile 0.975 of
!> Student's t with m - n degrees of freedom if s is that of the residuals, of the normal distribution if it is given.
!> The data do not see an unknown if it takes part in a direction of negligible singular value, or if its interval without bounds is
!> as wide as they are. Source: G. A. F. Seber, C. J. Wild, Nonlinear Regression (1989), section 2.1.2; for directions: G. H. Golub,
!> C. F. Van Loan, Matrix Computations (2013), section 5.5. Limits: r is linear over the intervals.
module fit_intervals
   use batch_means, only: student
   use kinds, only: wp
   use lapack, only: dgesvd
   use normal_distribution, only: normal_95
   implicit none (type, external)
   private
   public :: find_intervals, intervals_t

   real(wp), parameter :: negligible = 1.0e-7_wp    !! singular value, of the greatest one [1]
   real(wp), parameter :: takes_part = 0.01_wp      !! squared component of an unknown in a direction [1]
   real(wp), parameter :: alike = 0.99_wp           !! correlation of unknowns that are known together only [1]

   !> What is known of the unknowns.
   type :: intervals_t
      real(wp) :: deviation = 0.0_wp                 !! s: of the residuals, or 1 [1]
      real(wp) :: quantile = 0.0_wp                  !! q [1]
      real(wp), allocatable :: covariance(:, :)      !! (n, n) C [1]
      real(wp), allocatable :: correlation(:, :)     !! (n, n) of C; 0 where there is none [1]
      real(wp), allocatable :: low(:), high(:)       !! (n) ends of the intervals [1]
      logical, allocatable :: is_seen(:)             !! (n) whether the data see it
      integer, allocatable :: partner(:)             !! (n) unknown that it cannot be separated from; 0: none
      real(wp), allocatable :: singular(:)           !! (n) singular values, descending [1]
   end type intervals_t

contains

   !> Find them.
   subroutine find_intervals(u, r, jac, is_given, found)
      real(wp), intent(in) :: u(:)             !! (n) unknowns, between 0 and 1 [1]
      real(wp), intent(in) :: r(:)             !! (m) residuals, m > n [1]
      real(wp), intent(in) :: jac(:, :)        !! (m, n) their derivatives [1]
      logical, intent(in) :: is_given          !! residuals are in known standard deviations
      type(intervals_t), intent(out) :: found  !! what is found

      real(wp) :: hidden(size(u), size(u)), s(size(u)), vt(size(u), size(u)), width(size(u))
      integer :: i, k, m, n

      m = size(r)
      n = size(u)
      call find_directions(jac, s, vt)
      found%singular = s
      found%deviation = 1.0_wp
      found%quantile = normal_95
      if (.not. is_given) then
         found%deviation = sqrt(sum(r**2)/(m - n))
         found%quantile = student(m - n)
      end if
      allocate (found%covariance(n, n), found%correlation(n, n), source=0.0_wp)
      hidden = 0.0_wp
      do k = 1, n
         associate (v => vt(k, :))
            if (s(k) > negligible*s(1)) then
               found%covariance = found%covariance + (found%deviation/s(k))**2*spread(v, 2, n)*spread(v, 1, n)
            else
               hidden = hidden + spread(v, 2, n)*spread(v, 1, n)
            end if
         end associate
      end do
      width = found%quantile*[(sqrt(found%covariance(k, k)), k=1, n)]
      found%is_seen = [(hidden(k, k) <= takes_part .and. width(k) < 0.5_wp, k=1, n)]
      found%low = merge(max(0.0_wp, u - width), 0.0_wp, found%is_seen)
      found%high = merge(min(1.0_wp, u + width), 1.0_wp, found%is_seen)
      allocate (found%partner(n), source=0)
      do k = 1, n
         do i = 1, n
            if (width(i) > 0.0_wp .and. width(k) > 0.0_wp) then
               found%correlation(i, k) = found%covariance(i, k)/sqrt(found%covariance(i, i)*found%covariance(k, k))
            end if
            if (i == k) cycle
            if (abs(hidden(i, k)) > takes_part .or. abs(found%correlation(i, k)) > alike) found%partner(k) = i
         end do
         found%correlation(k, k) = 1.0_wp
      end do
   end subroutine find_intervals

   !> Singular values and right vectors, as rows.
   subroutine find_directions(jac, s, vt)
      real(wp), intent(in) :: jac(:, :)        !! (m, n) derivatives, m >= n [1]
      real(wp), intent(out) :: s(:)            !! (n) singular values, descending [1]
      real(wp), intent(out) :: vt(:, :)        !! (n, n) vectors [1]

      real(wp), allocatable :: a(:, :), work(:)
      real(wp) :: none(1, 1)
      integer :: info, n

      n = size(jac, 2)
      a = jac
      allocate (work(5*size(jac, 1) + 64*n), source=0.0_wp)
      call dgesvd("N", "A", size(jac, 1), n, a, size(jac, 1), s, none, 1, vt, n, work, size(work), info)
   end subroutine find_directions

end module fit_intervals
