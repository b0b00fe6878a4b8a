!> Derivatives by differences.
module differences
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: five_point, places

   real(wp), parameter :: places(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]  !! where values are wanted, in steps [1]

contains

   !> Derivative in the middle, from the values at the four `places`; its error is h^4 f'''''/30.
   pure real(wp) function five_point(f, h)
      real(wp), intent(in) :: f(4)  !! (4) values [any]
      real(wp), intent(in) :: h     !! step [any]

      five_point = (f(1) - f(4) + 8.0_wp*(f(3) - f(2)))/(12.0_wp*h)
   end function five_point

end module differences
