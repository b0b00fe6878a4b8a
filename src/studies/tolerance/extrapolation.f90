!> First derivatives from central differences with steps h, h/2, h/4 ..., extrapolated to step zero.
!>
!> $$ T_{l,0} = \frac{f(h_l) - f(-h_l)}{2 h_l}, \quad T_{l,m} = T_{l,m-1} + \frac{T_{l,m-1} - T_{l-1,m-1}}{4^m - 1}, \quad
!>    h_l = h/2^{l-1} . $$
!> Of all entries that one is taken which differs from its two neighbours by the smallest amount: round-off grows as
!> truncation falls.
!> Source: C. J. F. Ridders, Adv. Eng. Softw. 4 (1982) 75-76.
module extrapolation
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: extrapolated, n_step, step_of

   integer, parameter :: n_step = 5   !! steps

contains

   !> Length of a step.
   pure real(wp) function step_of(h, l)
      real(wp), intent(in) :: h   !! the longest step [any]
      integer, intent(in) :: l    !! number of the step

      step_of = h/2.0_wp**(l - 1)
   end function step_of

   !> Derivatives of several functions.
   pure function extrapolated(ahead, behind, h) result(slopes)
      real(wp), intent(in) :: ahead(:, :)     !! (n, steps) values one step ahead [any]
      real(wp), intent(in) :: behind(:, :)    !! (n, steps) values one step behind [any]
      real(wp), intent(in) :: h               !! the longest step [any]
      real(wp) :: slopes(size(ahead, 1))      !! (n) derivatives [any]

      real(wp) :: table(size(ahead, 2), 0:size(ahead, 2) - 1), difference, smallest
      integer :: k, l, m

      do k = 1, size(ahead, 1)
         smallest = huge(1.0_wp)
         do l = 1, size(ahead, 2)
            table(l, 0) = (ahead(k, l) - behind(k, l))/(2.0_wp*step_of(h, l))
         end do
         slopes(k) = table(1, 0)
         do l = 2, size(ahead, 2)
            do m = 1, l - 1
               table(l, m) = table(l, m - 1) + (table(l, m - 1) - table(l - 1, m - 1))/(4.0_wp**m - 1.0_wp)
               difference = max(abs(table(l, m) - table(l, m - 1)), abs(table(l, m) - table(l - 1, m - 1)))
               if (difference >= smallest) cycle
               smallest = difference
               slopes(k) = table(l, m)
            end do
         end do
      end do
   end function extrapolated

end module extrapolation
