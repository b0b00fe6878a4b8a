!> Gauss's rules of three and four points: int_0^1 f dx = sum_k w_k f(x_k), exact for polynomials of degree 5 and 7.
!>
!> Source: M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions (1964), table 25.4.
module gauss_points
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: gauss_places, gauss_weights, n_gauss, n_three, three_places, three_weights

   integer, parameter :: n_gauss = 4   !! points of the longer rule
   real(wp), parameter :: root = sqrt(1.2_wp)
   real(wp), parameter :: inner = sqrt((3.0_wp - 2.0_wp*root)/7.0_wp), outer = sqrt((3.0_wp + 2.0_wp*root)/7.0_wp)
   real(wp), parameter :: of_inner = (18.0_wp + sqrt(30.0_wp))/72.0_wp, of_outer = (18.0_wp - sqrt(30.0_wp))/72.0_wp
   real(wp), parameter :: gauss_places(n_gauss) = 0.5_wp*(1.0_wp + [-outer, -inner, inner, outer])   !! x_k, 0 to 1 [1]
   real(wp), parameter :: gauss_weights(n_gauss) = [of_outer, of_inner, of_inner, of_outer]          !! w_k, their sum is 1 [1]

   integer, parameter :: n_three = 3   !! points of the shorter rule
   real(wp), parameter :: three_places(n_three) = 0.5_wp*(1.0_wp + sqrt(0.6_wp)*[-1.0_wp, 0.0_wp, 1.0_wp])   !! x_k, 0 to 1 [1]
   real(wp), parameter :: three_weights(n_three) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp                          !! w_k [1]

end module gauss_points
