!> A periodic curve through cell means: once continuously differentiable, positive where the means are, with the area of each cell.
!>
!> n cells of one width, x in cells from 0 to n. In a cell the curve is a polynomial of degree 4 in Bernstein's form,
!>
!> h(u) = sum_k c_k B_k(u),  u from 0 to 1;   mean = (c_0 + c_1 + c_2 + c_3 + c_4)/5
!> c_0 = h_l, c_1 = h_l + s_l/4, c_3 = h_r - s_r/4, c_4 = h_r, c_2 from the mean
!>
!> with value h and slope s at the edges by the cubic through the four nearest cells,
!>
!> h = (7 (m_1 + m_-1) - m_2 - m_-2)/12,   s = (15 (m_1 - m_-1) - m_2 + m_-2)/12
!>
!> limited so that c_0, c_1, c_3, c_4 lie between 0 and 5/4 of the mean of their cell: no c_k is negative then, nor is the curve.
!> Errors are of order 4 in the width where nothing is limited. Nothing oscillates: the curve stays within the c_k.
!> Source: the Bernstein form as in G. Farin, Curves and Surfaces for CAGD (2002), section 5.1; the limits are its convex hull.
!> Limits: cells of one width, at least 4.
module histospline
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: degree, fit_histospline, value_of_histospline, values_of_histospline

   integer, parameter :: degree = 4   !! of the polynomials

contains

   !> Coefficients of the curve.
   pure subroutine fit_histospline(mean, c)
      real(wp), intent(in) :: mean(:)          !! (n) means of the cells, not negative [any]
      real(wp), intent(out) :: c(0:, :)        !! (0:4, n) coefficients [any]

      real(wp), parameter :: part = 1.25_wp   ! of the mean: four coefficients of 5/4 leave none for the fifth [1]
      real(wp) :: left, right, slope, value
      integer :: k, n

      n = size(mean)
      do k = 1, n  ! the edge between the cells k and k + 1
         left = mean(k)
         right = mean(next(k))
         value = (7.0_wp*(left + right) - mean(next(next(k))) - mean(modulo(k - 2, n) + 1))/12.0_wp
         slope = (15.0_wp*(right - left) - mean(next(next(k))) + mean(modulo(k - 2, n) + 1))/12.0_wp
         value = min(max(value, 0.0_wp), part*min(left, right))
         slope = min(max(slope, -4.0_wp*min(value, part*left - value)), 4.0_wp*min(value, part*right - value))
         c(3, k) = value - 0.25_wp*slope
         c(4, k) = value
         c(0, next(k)) = value
         c(1, next(k)) = value + 0.25_wp*slope
      end do
      do k = 1, n
         c(2, k) = max(5.0_wp*mean(k) - (c(0, k) + c(1, k) + c(3, k) + c(4, k)), 0.0_wp)  ! round-off below zero
      end do

   contains

      !> The cell behind one.
      pure integer function next(cell)
         integer, intent(in) :: cell   !! number of a cell

         next = modulo(cell, n) + 1
      end function next

   end subroutine fit_histospline

   !> Value of the curve in a cell and its first two derivatives by u, by de Casteljau's scheme.
   pure subroutine value_of_histospline(c, u, value, slope, bend)
      real(wp), intent(in) :: c(0:degree)   !! (0:4) coefficients of the cell [any]
      real(wp), intent(in) :: u             !! place in the cell, 0 to 1 [1]
      real(wp), intent(out) :: value        !! h [any]
      real(wp), intent(out) :: slope        !! dh/du [any]
      real(wp), intent(out) :: bend         !! d2h/du2; it jumps from cell to cell [any]

      real(wp) :: b0, b1, b2, b3

      associate (v => 1.0_wp - u)
         b0 = v*c(0) + u*c(1)
         b1 = v*c(1) + u*c(2)
         b2 = v*c(2) + u*c(3)
         b3 = v*c(3) + u*c(4)
         b0 = v*b0 + u*b1
         b1 = v*b1 + u*b2
         b2 = v*b2 + u*b3
         bend = 12.0_wp*(b2 - 2.0_wp*b1 + b0)
         b0 = v*b0 + u*b1
         b1 = v*b1 + u*b2
         slope = 4.0_wp*(b1 - b0)
         value = v*b0 + u*b1
      end associate
   end subroutine value_of_histospline

   !> The same of many places.
   pure subroutine values_of_histospline(c, n, cell, u, value, slope, bend)
      real(wp), intent(in) :: c(0:, :)      !! (0:4, cells) coefficients of all cells [any]
      integer, intent(in) :: n              !! how many
      integer, intent(in) :: cell(n)        !! (n) cells they are in, from 1
      real(wp), intent(in) :: u(n)          !! (n) places in them, 0 to 1 [1]
      real(wp), intent(out) :: value(n)     !! (n) h [any]
      real(wp), intent(out) :: slope(n)     !! (n) dh/du [any]
      real(wp), intent(out) :: bend(n)      !! (n) d2h/du2 [any]

      integer :: k

      do k = 1, n
         call value_of_histospline(c(:, cell(k)), u(k), value(k), slope(k), bend(k))
      end do
   end subroutine values_of_histospline

end module histospline
