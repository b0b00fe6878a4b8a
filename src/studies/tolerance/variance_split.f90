!> How much of a variance is between parts, and how much within the motion of each: one-way random effects of a balanced design.
!>
!> With n_p parts, each in n_m motions from perturbed starts, and the mean squares between and within
!> $$ B = \frac{n_m}{n_p - 1}\sum_i (\bar x_i - \bar x)^2, \quad W = \frac{1}{n_p (n_m - 1)}\sum_{ij} (x_{ij} - \bar x_i)^2, $$
!> the variance within is W, that between parts (B - W)/n_m, or 0 where this is negative, and the share within is
!> $$ s = \frac{n_m}{B/W + n_m - 1} . $$
!> The interval is that of log(B/W) by the jackknife over parts: it needs no normal distribution of parts or motions.
!> Sources: H. Scheffe, The Analysis of Variance (1959), section 7.2; J. N. Arvesen, Ann. Math. Statist. 40 (1969) 2076-2100.
!> Limits: at least three parts and two motions each; parts with a long tail have a narrower interval than stated.
module variance_split
   use batch_means, only: student
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: split_t, split_variance

   integer, parameter :: fewest_parts = 3   !! of a jackknife

   !> A variance in two parts.
   type :: split_t
      real(wp) :: parts = 0.0_wp      !! variance between parts [any]
      real(wp) :: motion = 0.0_wp     !! variance within the motion [any]
      real(wp) :: share(3) = 0.0_wp   !! (3) share within, ends of its interval of 95 %; NaN: not known [1]
      integer :: n_parts = 0          !! parts
   end type split_t

contains

   !> Split a variance.
   pure type(split_t) function split_variance(x) result(split)
      real(wp), intent(in) :: x(:, :)   !! (motions, parts) values [any]

      real(wp), allocatable :: means(:), pseudo(:), within(:)
      real(wp) :: between, error, inside, middle, ratio
      integer :: k, m, n

      m = size(x, 1)
      n = size(x, 2)
      split%n_parts = n
      split%parts = not_a_number()
      split%motion = not_a_number()
      split%share = not_a_number()
      if (n < fewest_parts .or. m < 2) return
      middle = sum(x)/size(x)
      allocate (means(n), within(n), pseudo(n))
      do k = 1, n
         means(k) = sum(x(:, k) - middle)/m
         within(k) = sum((x(:, k) - middle - means(k))**2)
      end do
      call mean_squares(means, within, between, inside)
      split%motion = inside
      split%parts = max((between - inside)/m, 0.0_wp)
      if (.not. between + inside > (64.0_wp*epsilon(1.0_wp)*middle)**2) return
      split%share = 0.0_wp
      if (.not. inside > 0.0_wp) return
      split%share = split%motion/(split%motion + split%parts)
      split%share(2:3) = [0.0_wp, 1.0_wp]
      if (.not. between > 0.0_wp) return
      ratio = log(between/inside)
      do k = 1, n
         call mean_squares([means(:k - 1), means(k + 1:)], [within(:k - 1), within(k + 1:)], between, inside)
         if (.not. (between > 0.0_wp .and. inside > 0.0_wp)) return
         pseudo(k) = n*ratio - (n - 1)*log(between/inside)
      end do
      middle = sum(pseudo)/n
      error = student(n - 1)*sqrt(sum((pseudo - middle)**2)/(n - 1)/n)
      split%share(2:3) = share_of(middle + [error, -error])

   contains

      !> Mean squares between and within.
      pure subroutine mean_squares(averages, squares, b, w)
         real(wp), intent(in) :: averages(:)   !! (parts) means [any]
         real(wp), intent(in) :: squares(:)    !! (parts) sums of squares within [any]
         real(wp), intent(out) :: b            !! between [any]
         real(wp), intent(out) :: w            !! within [any]

         associate (p => size(averages))
            b = m*sum((averages - sum(averages)/p)**2)/(p - 1)
            w = sum(squares)/(p*(m - 1))
         end associate
      end subroutine mean_squares

      !> Share within, of the logarithm of the ratio of both.
      elemental real(wp) function share_of(log_ratio)
         real(wp), intent(in) :: log_ratio   !! log(B/W) [1]

         share_of = 1.0_wp/(1.0_wp + max((exp(min(log_ratio, 300.0_wp)) - 1.0_wp)/m, 0.0_wp))
      end function share_of

   end function split_variance

end module variance_split
