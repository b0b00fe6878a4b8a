!> The integral of an expression over its variable, to nearly round-off, with kinks and jumps found by halving.
!>
!> Lobatto's formula with 7 points, the ends among them, over an interval and over its halves; where they differ the
!> halves are halved. So a law that starts just before x, as that of a stop, is seen. Source: Davis and Rabinowitz,
!> Methods of numerical integration (1984), sections 2.7 and 6.2.
!> Limits: a bump between the points of the first interval and zero at all of them is overlooked.
module quadrature
   use expression, only: expression_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: integral_of

   integer, parameter :: n_pair = 3          !! pairs of points beside the middle
   integer, parameter :: deepest = 60        !! halvings of the interval
   real(wp), parameter :: tolerance = 1.0e-13_wp  !! difference that is accepted, of the integral of |f| [1]
   real(wp), parameter :: place(n_pair) = [0.46884879347071421380_wp, 0.83022389627856692987_wp, 1.0_wp]
      !! (3) points in [-1, 1], with either sign [1]
   real(wp), parameter :: weight(0:n_pair) = [256.0_wp/525.0_wp, 0.43174538120986262342_wp, 0.27682604736156594801_wp, &
                                              1.0_wp/21.0_wp]
      !! (0:3) weights of the middle and of the pairs [1]

contains

   !> Integral from 0 to x.
   pure real(wp) function integral_of(f, x) result(integral)
      type(expression_t), intent(in) :: f  !! the integrand [any]
      real(wp), intent(in) :: x            !! upper end, of either sign [any]

      real(wp) :: accepted, ends(deepest), first, left, right, size_of_all, whole(deepest)
      integer :: depth

      integral = 0.0_wp
      if (.not. abs(x) > 0.0_wp) return
      depth = 1
      first = 0.0_wp
      ends(1) = x
      whole(1) = lobatto(f, 0.0_wp, x)
      size_of_all = abs(whole(1))
      do while (depth > 0)
         associate (last => ends(depth), middle => 0.5_wp*(first + ends(depth)))
            left = lobatto(f, first, middle)
            right = lobatto(f, middle, last)
            size_of_all = max(size_of_all, abs(integral) + abs(left) + abs(right))
            accepted = tolerance*size_of_all
            if (.not. abs(left + right - whole(depth)) > accepted .or. depth == deepest) then
               integral = integral + left + right
               first = last
               depth = depth - 1
            else
               whole(depth) = right
               whole(depth + 1) = left
               ends(depth + 1) = middle
               depth = depth + 1
            end if
         end associate
      end do
   end function integral_of

   !> The formula over one interval.
   pure real(wp) function lobatto(f, a, b) result(integral)
      type(expression_t), intent(in) :: f  !! the integrand [any]
      real(wp), intent(in) :: a            !! lower end [any]
      real(wp), intent(in) :: b            !! upper end [any]

      real(wp) :: d1, d2, half, high, low, middle
      integer :: k

      half = 0.5_wp*(b - a)
      middle = 0.5_wp*(a + b)
      call f%evaluate(middle, low, d1, d2)
      integral = weight(0)*half*low
      do k = 1, n_pair
         call f%evaluate(middle - half*place(k), low, d1, d2)
         call f%evaluate(middle + half*place(k), high, d1, d2)
         integral = integral + weight(k)*half*(low + high)
      end do
   end function lobatto

end module quadrature
