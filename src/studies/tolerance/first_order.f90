!> Worst case, root sum square and mean to second order, from derivatives.
!>
!> With T_i half the width of a tolerance, mu_i and s_i mean and standard deviation of the deviation, and the clearance c_k of pins:
!> $$ B = \sum_i |S_i| T_i + \sum_k c_k |G_k|, \quad
!>    s^2 = \sum_i S_i^2 s_i^2 + \sum_k w_k E(c_k^2) |G_k|^2, \quad
!>    E(R) = R_0 + \sum_i S_i\mu_i + \tfrac12\sum_i H_{ii} (s_i^2 + \mu_i^2) + \sum_{j<i} H_{ij}\mu_i\mu_j . $$
!> w is 1/4 of a pin uniform in its circle and 1/2 of one on it; the mean has w c^2 tr(K)/2 besides. A pin that a force presses
!> in the direction u shifts the channel by c G u, the mean also by c^2 u K u/2, and its clearance has the derivative G u.
!> The worst case takes each clearance at its upper limit. Parameters of one batch have covariances (`batch_moments`): what comes
!> from the batch is a part of its own in s^2, and E(R) has H_ij C_ij besides, for each pair.
!> Source: D. H. Evans, J. Qual. Technol. 7 (1975) 1-12. Limits: batches are independent; the mean to second order.
module first_order
   use batch_moments, only: batch_moments_t
   use kinds, only: wp
   use tolerance_plan, only: pin_circle, pin_disc, pin_force
   use tolerance_results, only: tolerance_study_t
   implicit none (type, external)
   private
   public :: combine_derivatives

contains

   !> Combine the derivatives of a study.
   subroutine combine_derivatives(study)
      type(tolerance_study_t), intent(inout) :: study   !! slopes, parts, widths, low, high, sigma and mean are set

      type(batch_moments_t) :: common
      integer :: at, n_all, r

      call common%find(study%plan%parameters)
      n_all = size(study%plan%parameters) + size(study%pins) + size(study%plan%batches)
      associate (n_request => size(study%requests), n_time => size(study%derivatives%instants))
         allocate (study%parts(n_all, n_request, n_time), study%widths(n_all, n_request, n_time), source=0.0_wp)
         allocate (study%low(n_request, n_time), study%high(n_request, n_time), study%sigma(n_request, n_time), &
                   study%mean(n_request, n_time), source=0.0_wp)
         study%slopes = study%derivatives%slopes
         do at = 1, n_time
            do r = 1, n_request
               call combine_one(study, common, r, at)
               call add_batches(study, common, r, at)
            end do
         end do
      end associate
   end subroutine combine_derivatives

   !> The same of one channel at one time, as if no batch had more than one parameter.
   subroutine combine_one(study, common, r, at)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(batch_moments_t), intent(in) :: common       !! of the parameters
      integer, intent(in) :: r                          !! number of the channel
      integer, intent(in) :: at                         !! number of the time

      real(wp) :: bend, centre, gain, largest, mean_clearance, square
      integer :: i, k, n

      n = size(study%plan%parameters)
      associate (found => study%derivatives, parameters => study%plan%parameters, slopes => study%slopes(:, r, at), &
                 parts => study%parts(:, r, at), widths => study%widths(:, r, at))
         do k = 1, size(study%pins)
            if (study%pins(k)%position /= pin_force) cycle
            slopes = slopes + dot_product(found%pins(:, k, r, at), found%directions(:, k, at))*found%clearance_slopes(:, k)
         end do
         parts(:n) = slopes**2*common%alone
         widths(:n) = abs(slopes)*0.5_wp*(parameters%upper - parameters%lower)
         centre = found%values(r, at) + dot_product(slopes, 0.5_wp*(parameters%upper + parameters%lower))
         study%mean(r, at) = found%values(r, at) + dot_product(slopes, parameters%mean)
         do i = 1, n
            study%mean(r, at) = study%mean(r, at) + 0.5_wp*found%curvatures(i, i, r, at)*parameters(i)%sigma**2 + &
                                0.5_wp*parameters(i)%mean*dot_product(found%curvatures(:, i, r, at), parameters%mean)
         end do
         do k = 1, size(study%pins)
            associate (c => study%pins(k)%clearance, by => found%clearance_slopes(:, k))
               gain = norm2(found%pins(:, k, r, at))
               mean_clearance = c + dot_product(by, parameters%mean)
               square = mean_clearance**2 + common%variance(by)
               bend = sum(found%pin_curvatures(1:2, k, r, at))
               largest = c + dot_product(by, 0.5_wp*(parameters%upper + parameters%lower)) + &
                         dot_product(abs(by), 0.5_wp*(parameters%upper - parameters%lower))
               select case (study%pins(k)%position)
               case (pin_force)
                  gain = dot_product(found%pins(:, k, r, at), found%directions(:, k, at))
                  centre = centre + gain*c
                  study%mean(r, at) = study%mean(r, at) + gain*c + 0.5_wp*square*( &
                                      dot_product(found%pin_curvatures(1:2, k, r, at), found%directions(:, k, at)**2) + &
                                      2.0_wp*found%pin_curvatures(3, k, r, at)*product(found%directions(:, k, at)))
               case (pin_disc)
                  study%mean(r, at) = study%mean(r, at) + 0.125_wp*square*bend
                  parts(n + k) = 0.25_wp*square*gain**2
                  widths(n + k) = largest*gain
               case (pin_circle)
                  study%mean(r, at) = study%mean(r, at) + 0.25_wp*square*bend
                  parts(n + k) = 0.5_wp*square*gain**2
                  widths(n + k) = largest*gain
               case default
                  widths(n + k) = largest*gain
               end select
            end associate
         end do
         study%low(r, at) = centre - sum(widths)
         study%high(r, at) = centre + sum(widths)
      end associate
   end subroutine combine_one

   !> What batches add, and the standard deviation.
   subroutine add_batches(study, common, r, at)
      type(tolerance_study_t), intent(inout) :: study   !! the study
      type(batch_moments_t), intent(in) :: common       !! of the parameters
      integer, intent(in) :: r                          !! number of the channel
      integer, intent(in) :: at                         !! number of the time

      integer :: i, j, k

      associate (parts => study%parts(:, r, at), curvatures => study%derivatives%curvatures(:, :, r, at))
         do k = 1, size(study%plan%batches)
            parts(size(parts) - size(study%plan%batches) + k) = common%from_batch(k, study%slopes(:, r, at))
         end do
         do j = 1, size(curvatures, 2)
            do i = 1, j - 1
               study%mean(r, at) = study%mean(r, at) + curvatures(i, j)*common%covariance(i, j)
            end do
         end do
         study%sigma(r, at) = sqrt(sum(parts))
      end associate
   end subroutine add_batches

end module first_order
