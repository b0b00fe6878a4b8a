!> Derivatives by differences.
module differences
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: five_point, places, six_places, six_point

   real(wp), parameter :: places(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]  !! where values are requested, in steps [1]
   real(wp), parameter :: six_places(6) = [-2.0_wp, -1.0_wp, -0.5_wp, 0.5_wp, 1.0_wp, 2.0_wp]  !! the same for `six_point` [1]

contains

   !> Derivative in the middle, from the values at the four `places`; its error is h^4 f'''''/30.
   pure real(wp) function five_point(f, h)
      real(wp), intent(in) :: f(4)  !! (4) values [any]
      real(wp), intent(in) :: h     !! step [any]

      five_point = (f(1) - f(4) + 8.0_wp*(f(3) - f(2)))/(12.0_wp*h)
   end function five_point

   !> Derivative in the middle, from the values at the `six_places`: that of half the step, with the leading term of its error
   !> taken from that of the whole step; what is left is of order h^6.
   pure real(wp) function six_point(f, h)
      real(wp), intent(in) :: f(6)  !! (6) values [any]
      real(wp), intent(in) :: h     !! step [any]

      six_point = (16.0_wp*five_point(f(2:5), 0.5_wp*h) - five_point(f([1, 2, 5, 6]), h))/15.0_wp
   end function six_point

end module differences
