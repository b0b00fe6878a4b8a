!> Gauss's rule of four points: int_0^1 f dx = sum_k w_k f(x_k), exact for polynomials of degree 7.
!>
!> Source: M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions (1964), table 25.4.
module gauss_points
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: gauss_places, gauss_weights, n_gauss

   integer, parameter :: n_gauss = 4   !! points
   real(wp), parameter :: root = sqrt(1.2_wp)
   real(wp), parameter :: inner = sqrt((3.0_wp - 2.0_wp*root)/7.0_wp), outer = sqrt((3.0_wp + 2.0_wp*root)/7.0_wp)
   real(wp), parameter :: of_inner = (18.0_wp + sqrt(30.0_wp))/72.0_wp, of_outer = (18.0_wp - sqrt(30.0_wp))/72.0_wp
   real(wp), parameter :: gauss_places(n_gauss) = 0.5_wp*(1.0_wp + [-outer, -inner, inner, outer])   !! x_k, 0 to 1 [1]
   real(wp), parameter :: gauss_weights(n_gauss) = [of_outer, of_inner, of_inner, of_outer]          !! w_k, their sum is 1 [1]

end module gauss_points
