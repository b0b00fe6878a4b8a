!> The cheapest tolerances that reach a yield.
!>
!> A part costs a + C T_0/T, C at the width T_0 of the deck. To first order, with f_k = T_k/T_{0k} and v_k what parameter k adds to
!> the variance of a request now, the least cost for a variance v is that of Lagrange's condition:
!> $$ \min \sum_k \frac{C_k}{f_k}, \quad \sum_k v_k f_k^2 = v \quad\Rightarrow\quad
!>    f_k = \sqrt{\frac{v}{\sum_i v_i w_i^2}}\, w_k, \quad w_k = \left(\frac{C_k}{v_k}\right)^{1/3} . $$
!> v is the variance with which a normal request at its mean is within its limits with the yield that is asked for, less what
!> contributors without a cost add. Source: M. F. Spotts, J. Eng. Ind. 95 (1973) 762-764. Limits: one request at a time, linear,
!> normal; the mean stays where it is.
module cost_allocation
   use kinds, only: not_a_number, wp
   use normal_distribution, only: normal_probability
   use tolerance_results, only: allocation_t, tolerance_study_t
   implicit none (type, external)
   private
   public :: allocate_tolerances, cheapest_widths, sigma_for_yield

   integer, parameter :: halvings = 200   !! of the interval of a standard deviation

contains

   !> Allocate the tolerances of each request with limits. Its time is that which is shown of it.
   subroutine allocate_tolerances(study)
      type(tolerance_study_t), intent(inout) :: study   !! derivatives and members are known; allocations are set

      integer :: n, r

      n = size(study%plan%parameters)
      if (.not. any(study%plan%costs > 0.0_wp)) return
      allocate (study%allocations(size(study%requests)))
      do r = 1, size(study%requests)
         associate (one => study%allocations(r), at => study%members%at(r), asked => study%requests(r))
            allocate (one%factors(n), source=not_a_number())
            one%cost = not_a_number()
            one%sigma = not_a_number()
            if (.not. asked%is_limited) cycle
            one%sigma = sigma_for_yield(asked%lower - study%mean(r, at), asked%upper - study%mean(r, at), &
                                        study%plan%sampling%target)
            call cheapest_widths(study%plan%costs, study%parts(:n, r, at), one%sigma**2 - sum(study%parts(n + 1:, r, at)), &
                                 one%factors, one%cost)
         end associate
      end do
   end subroutine allocate_tolerances

   !> Standard deviation of a normal number around 0 that lies between limits with some probability.
   pure real(wp) function sigma_for_yield(lower, upper, yield) result(sigma)
      real(wp), intent(in) :: lower   !! lower limit [any]
      real(wp), intent(in) :: upper   !! upper limit [any]
      real(wp), intent(in) :: yield   !! between 0 and 1, both excluded [1]

      real(wp) :: ends(2), far, high, low
      integer :: k

      sigma = 0.0_wp
      if (.not. (lower < 0.0_wp .and. upper > 0.0_wp)) return
      ends = [0.0_wp, 1.0e3_wp*min(-lower, upper)/min(yield, 1.0_wp - yield)]   ! a wider one has too little within
      far = 1.0e3_wp*ends(2)                                                    ! a limit beyond is none
      low = max(lower, -far)
      high = min(upper, far)
      do k = 1, halvings
         sigma = 0.5_wp*sum(ends)
         if (normal_probability(high/sigma) - normal_probability(low/sigma) >= yield) then
            ends(1) = sigma
         else
            ends(2) = sigma
         end if
      end do
   end function sigma_for_yield

   !> The cheapest widths for a variance.
   pure subroutine cheapest_widths(costs, parts, variance, factors, cost)
      real(wp), intent(in) :: costs(:)       !! (parameters) C, 0: the width is not changed [1]
      real(wp), intent(in) :: parts(:)       !! (parameters) of the variance now [any]
      real(wp), intent(in) :: variance       !! for all of them [any]
      real(wp), intent(out) :: factors(:)    !! (parameters) f; 1: not changed; NaN: no such widths [1]
      real(wp), intent(out) :: cost          !! sum of C/f; NaN: no such widths [1]

      logical :: is_free(size(costs))
      real(wp) :: left, w(size(costs))

      is_free = costs > 0.0_wp .and. parts > 0.0_wp
      left = variance - sum(parts, mask=.not. is_free)
      factors = not_a_number()
      cost = not_a_number()
      if (.not. (left > 0.0_wp .and. any(is_free))) return
      w = 0.0_wp
      where (is_free) w = (costs/max(parts, tiny(1.0_wp)))**(1.0_wp/3.0_wp)
      factors = 1.0_wp
      where (is_free) factors = w*sqrt(left/sum(parts*w**2))
      cost = sum(costs/factors)
   end subroutine cheapest_widths

end module cost_allocation
