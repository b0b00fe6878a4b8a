!> The rate of a rotation vector psi (axis times angle) and the angular velocity w of the frame that it turns, along the axes of the
!> frame that it turns from:
!>
!> w = J(psi) psi',   J(psi) v = v + (1 - cos a)/a^2 psi x v + (a - sin a)/a^3 psi x (psi x v),   a = |psi|
!> psi' = J(psi)^-1 w,   J(psi)^-1 v = v - psi x v/2 + (1 - (a/2) cot(a/2))/a^2 psi x (psi x v)
!>
!> The transposes have the other sign of the first product. Source: J. C. Simo, L. Vu-Quoc, A three-dimensional finite-strain rod
!> model. Part II, Computer Methods in Applied Mechanics and Engineering 58 (1986), 79-116. Limits: a whole turn has no inverse.
module rotation_maps
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: inverse_map_of, map_of

contains

   include "across.inc"

   !> Add what turns with psi: v + first psi x v + second psi x (psi x v).
   pure function with_turns(v, psi, first, second) result(w)
      real(wp), intent(in) :: v(3)       !! (3) a vector [any]
      real(wp), intent(in) :: psi(3)     !! (3) rotation vector [rad]
      real(wp), intent(in) :: first      !! factor of the first product [1/rad]
      real(wp), intent(in) :: second     !! factor of the second [1/rad^2]
      real(wp) :: w(3)                   !! (3) the sum [any]

      real(wp) :: once(3)

      once = across(psi, v)
      w = v + first*once + second*across(psi, once)
   end function with_turns

   !> J(psi) v, or its transpose times v.
   pure function map_of(v, psi, is_transposed) result(w)
      real(wp), intent(in) :: v(3)               !! (3) a vector [any]
      real(wp), intent(in) :: psi(3)             !! (3) rotation vector [rad]
      logical, intent(in) :: is_transposed       !! J^T
      real(wp) :: w(3)                           !! (3) the product [any]

      real(wp), parameter :: small = 0.1_wp   ! below, series: their next terms are less than 1e-16 [rad]
      real(wp) :: first, second, square

      square = dot_product(psi, psi)
      if (square < small**2) then
         first = 0.5_wp - square/24.0_wp*(1.0_wp - square/30.0_wp*(1.0_wp - square/56.0_wp*(1.0_wp - square/90.0_wp)))
         second = (1.0_wp - square/20.0_wp*(1.0_wp - square/42.0_wp*(1.0_wp - square/72.0_wp*(1.0_wp - square/110.0_wp))))/6.0_wp
      else
         first = (1.0_wp - cos(sqrt(square)))/square
         second = (sqrt(square) - sin(sqrt(square)))/(square*sqrt(square))
      end if
      w = with_turns(v, psi, merge(-first, first, is_transposed), second)
   end function map_of

   !> J(psi)^-1 v, or its transpose times v: v -+ psi x v/2 + (1 - (a/2) cot(a/2))/a^2 psi x (psi x v), a = |psi|.
   pure function inverse_map_of(v, psi, is_transposed) result(w)
      real(wp), intent(in) :: v(3)               !! (3) a vector [any]
      real(wp), intent(in) :: psi(3)             !! (3) rotation vector, less than a turn [rad]
      logical, intent(in) :: is_transposed       !! J^-T
      real(wp) :: w(3)                           !! (3) the product [any]

      real(wp), parameter :: small = 0.1_wp   ! below, a series: its next term is less than 1e-16 [rad]
      real(wp) :: half, second, square

      square = dot_product(psi, psi)
      if (square < small**2) then
         second = (1.0_wp + square/60.0_wp*(1.0_wp + square/42.0_wp*(1.0_wp + square/40.0_wp* &
                   (1.0_wp + square*5.0_wp/198.0_wp))))/12.0_wp
      else
         half = 0.5_wp*sqrt(square)
         second = (1.0_wp - half*cos(half)/sin(half))/square
      end if
      w = with_turns(v, psi, merge(0.5_wp, -0.5_wp, is_transposed), second)
   end function inverse_map_of

end module rotation_maps
