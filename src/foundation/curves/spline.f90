!> Cubic splines: the smoothest curve through samples, with continuous first and second derivatives.
!>
!> With h_k = x_k+1 - x_k and the second derivatives m_k at the samples, between x_k and x_k+1
!> p = y_k + b_k s + m_k s^2/2 + (m_k+1 - m_k) s^3/(6 h_k),   s = x - x_k,
!> b_k = (y_k+1 - y_k)/h_k - h_k (2 m_k + m_k+1)/6,
!> h_k-1 m_k-1 + 2 (h_k-1 + h_k) m_k + h_k m_k+1 = 6 ((y_k+1 - y_k)/h_k - (y_k - y_k-1)/h_k-1),
!> closed at the ends by m = 0 (natural), p' = 0 (clamped), one cubic over the two first and the two last
!> intervals (not-a-knot: exact for cubics), p''' of the first and the last interval as that of the cubic through the four samples
!> there (fmm: exact for cubics too), or m, p' the same at both ends (periodic).
!>
!> Source: de Boor, A practical guide to splines (1978), chapter IV; fmm: Forsythe, Malcolm and Moler, Computer methods for
!> mathematical computations (1977), chapter 4. Limits: error of order h^4, h^3, h^2 in
!> value and derivatives; of natural and clamped ones only if the ends are so indeed.
module spline
   use curve, only: curve_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: ends_clamped, ends_fmm, ends_natural, ends_not_a_knot, ends_periodic, min_samples, new_spline

   integer, parameter :: ends_not_a_knot = 1  !! one cubic over the two first and the two last intervals
   integer, parameter :: ends_natural = 2     !! no curvature at the ends
   integer, parameter :: ends_clamped = 3     !! no slope at the ends
   integer, parameter :: ends_periodic = 4    !! the last sample is the first one again
   integer, parameter :: ends_fmm = 5         !! third derivatives of cubics through four samples
   integer, parameter :: min_samples = 4    !! samples that a spline needs

contains

   !> The spline through samples, with any behaviour beyond them.
   pure subroutine new_spline(x, y, ends, beyond, curve)
      real(wp), intent(in) :: x(:)         !! (n) places, increasing, at least `min_samples` [any]
      real(wp), intent(in) :: y(:)         !! (n) values [any]
      integer, intent(in) :: ends          !! how it is closed, one of the above
      integer, intent(in) :: beyond        !! what the curve is beyond the samples, as of `curve`
      type(curve_t), intent(out) :: curve  !! the spline

      real(wp) :: h(size(x) - 1), m(size(x)), slope(size(x) - 1)
      integer :: k, n

      n = size(x)
      h = x(2:) - x(:n - 1)
      slope = (y(2:) - y(:n - 1))/h
      if (ends == ends_periodic) then
         call periodic_curvatures(n - 1, h, slope, m(:n - 1))
         m(n) = m(1)
      else
         call curvatures(n, h, slope, ends, m)
      end if
      curve%x = x
      curve%beyond = beyond
      allocate (curve%c(0:3, n - 1))
      do k = 1, n - 1
         curve%c(:, k) = [y(k), slope(k) - h(k)*(2.0_wp*m(k) + m(k + 1))/6.0_wp, 0.5_wp*m(k), &
                          (m(k + 1) - m(k))/(6.0_wp*h(k))]
      end do
   end subroutine new_spline

   !> Second derivatives at the samples of a spline with two ends.
   pure subroutine curvatures(n, h, slope, ends, m)
      integer, intent(in) :: n               !! number of samples
      real(wp), intent(in) :: h(n - 1)       !! (n - 1) lengths of the intervals [any]
      real(wp), intent(in) :: slope(n - 1)   !! (n - 1) slopes of the chords [any]
      integer, intent(in) :: ends            !! how it is closed
      real(wp), intent(out) :: m(n)          !! (n) second derivatives [any]

      real(wp) :: diagonal(n), lower(n), r, right(n), upper(n)
      integer :: k

      do k = 2, n - 1
         lower(k) = h(k - 1)
         diagonal(k) = 2.0_wp*(h(k - 1) + h(k))
         upper(k) = h(k)
         right(k) = 6.0_wp*(slope(k) - slope(k - 1))
      end do
      lower(1) = 0.0_wp
      upper(n) = 0.0_wp
      diagonal([1, n]) = 1.0_wp
      upper(1) = 0.0_wp
      lower(n) = 0.0_wp
      right([1, n]) = 0.0_wp
      select case (ends)
      case (ends_clamped)
         diagonal(1) = 2.0_wp*h(1)
         upper(1) = h(1)
         right(1) = 6.0_wp*slope(1)
         diagonal(n) = 2.0_wp*h(n - 1)
         lower(n) = h(n - 1)
         right(n) = -6.0_wp*slope(n - 1)
      case (ends_fmm)
         upper(1) = -1.0_wp
         right(1) = -6.0_wp*h(1)*third_difference(h(1:3), slope(1:3))
         lower(n) = -1.0_wp
         right(n) = 6.0_wp*h(n - 1)*third_difference(h(n - 3:n - 1), slope(n - 3:n - 1))
      case (ends_not_a_knot)
         ! m_1 = (1 + r) m_2 - r m_3 put into the second equation, and so at the other end
         r = h(1)/h(2)
         diagonal(2) = diagonal(2) + lower(2)*(1.0_wp + r)
         upper(2) = upper(2) - lower(2)*r
         lower(2) = 0.0_wp
         r = h(n - 1)/h(n - 2)
         diagonal(n - 1) = diagonal(n - 1) + upper(n - 1)*(1.0_wp + r)
         lower(n - 1) = lower(n - 1) - upper(n - 1)*r
         upper(n - 1) = 0.0_wp
      end select
      call solve_tridiagonal(n, lower, diagonal, upper, right, m)
      if (ends /= ends_not_a_knot) return
      m(1) = m(2) + (m(2) - m(3))*h(1)/h(2)
      m(n) = m(n - 1) + (m(n - 1) - m(n - 2))*h(n - 1)/h(n - 2)
   end subroutine curvatures

   !> The third divided difference of four samples.
   pure real(wp) function third_difference(h, slope) result(d)
      real(wp), intent(in) :: h(3)       !! (3) lengths of the intervals [any]
      real(wp), intent(in) :: slope(3)   !! (3) slopes of the chords [any]

      d = ((slope(3) - slope(2))/(h(2) + h(3)) - (slope(2) - slope(1))/(h(1) + h(2)))/sum(h)
   end function third_difference

   !> Second derivatives of a periodic spline: the cyclic system by the formula of Sherman and Morrison.
   pure subroutine periodic_curvatures(n, h, slope, m)
      integer, intent(in) :: n           !! number of intervals
      real(wp), intent(in) :: h(n)       !! (n) lengths of the intervals [any]
      real(wp), intent(in) :: slope(n)   !! (n) slopes of the chords [any]
      real(wp), intent(out) :: m(n)      !! (n) second derivatives at the first samples of the intervals [any]

      real(wp) :: corner, diagonal(n), lower(n), right(n), shift, unit(n), upper(n), z(n)
      integer :: k, previous

      do k = 1, n
         previous = modulo(k - 2, n) + 1
         lower(k) = h(previous)
         diagonal(k) = 2.0_wp*(h(previous) + h(k))
         upper(k) = h(k)
         right(k) = 6.0_wp*(slope(k) - slope(previous))
      end do
      corner = h(n)
      shift = -diagonal(1)
      diagonal(1) = diagonal(1) - shift
      diagonal(n) = diagonal(n) - corner*corner/shift
      unit = 0.0_wp
      unit(1) = shift
      unit(n) = corner
      call solve_tridiagonal(n, lower, diagonal, upper, right, m)
      call solve_tridiagonal(n, lower, diagonal, upper, unit, z)
      m = m - z*(m(1) + corner*m(n)/shift)/(1.0_wp + z(1) + corner*z(n)/shift)
   end subroutine periodic_curvatures

   !> A tridiagonal system by elimination without exchanges: these are dominated by their diagonals.
   pure subroutine solve_tridiagonal(n, lower, diagonal, upper, right, x)
      integer, intent(in) :: n               !! number of equations
      real(wp), intent(in) :: lower(n)       !! (n) below the diagonal, the first is not used [any]
      real(wp), intent(in) :: diagonal(n)    !! (n) the diagonal [any]
      real(wp), intent(in) :: upper(n)       !! (n) above the diagonal, the last is not used [any]
      real(wp), intent(in) :: right(n)       !! (n) right-hand side [any]
      real(wp), intent(out) :: x(n)          !! (n) solution [any]

      real(wp) :: factor, pivot(n)
      integer :: k

      pivot = diagonal
      x = right
      do k = 2, n
         factor = lower(k)/pivot(k - 1)
         pivot(k) = pivot(k) - factor*upper(k - 1)
         x(k) = x(k) - factor*x(k - 1)
      end do
      x(n) = x(n)/pivot(n)
      do k = n - 1, 1, -1
         x(k) = (x(k) - upper(k)*x(k + 1))/pivot(k)
      end do
   end subroutine solve_tridiagonal

end module spline
