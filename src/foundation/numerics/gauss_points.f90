!> Gauss's rules of four and five points, and Lobatto's of six, which has both ends: int_0^1 f dx = sum_k w_k f(x_k), exact for
!> polynomials of degree 7, 9 and 9.
!>
!> Source: M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions (1964), tables 25.4 and 25.6.
module gauss_points
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: five_places, five_weights, gauss_places, gauss_weights, n_five, n_gauss, n_six, six_places, six_weights

   integer, parameter :: n_gauss = 4   !! points of the shorter rule
   real(wp), parameter :: root = sqrt(1.2_wp)
   real(wp), parameter :: inner = sqrt((3.0_wp - 2.0_wp*root)/7.0_wp), outer = sqrt((3.0_wp + 2.0_wp*root)/7.0_wp)
   real(wp), parameter :: of_inner = (18.0_wp + sqrt(30.0_wp))/72.0_wp, of_outer = (18.0_wp - sqrt(30.0_wp))/72.0_wp
   real(wp), parameter :: gauss_places(n_gauss) = 0.5_wp*(1.0_wp + [-outer, -inner, inner, outer])   !! x_k, 0 to 1 [1]
   real(wp), parameter :: gauss_weights(n_gauss) = [of_outer, of_inner, of_inner, of_outer]          !! w_k, their sum is 1 [1]

   integer, parameter :: n_five = 5   !! points of the longer rule
   real(wp), parameter :: near = sqrt(5.0_wp - 2.0_wp*sqrt(10.0_wp/7.0_wp))/3.0_wp
   real(wp), parameter :: far = sqrt(5.0_wp + 2.0_wp*sqrt(10.0_wp/7.0_wp))/3.0_wp
   real(wp), parameter :: of_near = (322.0_wp + 13.0_wp*sqrt(70.0_wp))/1800.0_wp
   real(wp), parameter :: of_far = (322.0_wp - 13.0_wp*sqrt(70.0_wp))/1800.0_wp
   real(wp), parameter :: five_places(n_five) = 0.5_wp*(1.0_wp + [-far, -near, 0.0_wp, near, far])                !! x_k, 0 to 1 [1]
   real(wp), parameter :: five_weights(n_five) = [of_far, of_near, 64.0_wp/225.0_wp, of_near, of_far]             !! w_k [1]

   integer, parameter :: n_six = 6   !! points of Lobatto's rule
   real(wp), parameter :: close = sqrt((1.0_wp - 2.0_wp/sqrt(7.0_wp))/3.0_wp), wide = sqrt((1.0_wp + 2.0_wp/sqrt(7.0_wp))/3.0_wp)
   real(wp), parameter :: of_close = (14.0_wp + sqrt(7.0_wp))/60.0_wp, of_wide = (14.0_wp - sqrt(7.0_wp))/60.0_wp
   real(wp), parameter :: six_places(n_six) = 0.5_wp*(1.0_wp + [-1.0_wp, -wide, -close, close, wide, 1.0_wp])   !! x_k, 0 to 1 [1]
   real(wp), parameter :: six_weights(n_six) = [1.0_wp/30.0_wp, of_wide, of_close, of_close, of_wide, 1.0_wp/30.0_wp]   !! w_k [1]

end module gauss_points
