!> Akima's curve through samples: cubics whose slopes at a sample follow from the chords next to it, so that one wild sample, or a
!> corner, is felt two intervals away and no farther.
!>
!> With the slopes m_k of the chords from x_k to x_k+1, at x_k
!>
!> $$ t_k = \frac{|m_{k+1} - m_k| m_{k-1} + |m_{k-1} - m_{k-2}| m_k}{|m_{k+1} - m_k| + |m_{k-1} - m_{k-2}|} $$
!>
!> and the mean of m_k-1 and m_k where both differences vanish. Beyond an end two chords are added as those of a parabola through
!> the last three samples, m_0 = 2 m_1 - m_2 and m_-1 = 2 m_0 - m_1, or those of the other end if the curve repeats itself.
!>
!> Source: H. Akima, J. ACM 17 (1970) 589-602. Limits: the second derivative jumps at every sample; exact for parabolas where
!> places are evenly spaced.
module akima
   use curve, only: beyond_periodic, curve_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: new_akima

contains

   !> The curve through samples, with any behaviour beyond them.
   subroutine new_akima(x, y, beyond, curve)
      real(wp), intent(in) :: x(:)         !! (n) places, increasing, at least three [any]
      real(wp), intent(in) :: y(:)         !! (n) values; where it repeats itself, the last is the first [any]
      integer, intent(in) :: beyond        !! what the curve is beyond the samples, as of `curve`
      type(curve_t), intent(out) :: curve  !! the curve

      real(wp) :: after, before, h, m(-1:size(x) + 1), t(size(x))
      integer :: k, n

      n = size(x)
      m(1:n - 1) = (y(2:) - y(:n - 1))/(x(2:) - x(:n - 1))
      if (beyond == beyond_periodic) then
         m(-1:0) = m(n - 2:n - 1)
         m(n:n + 1) = m(1:2)
      else
         m(0) = 2.0_wp*m(1) - m(2)
         m(-1) = 2.0_wp*m(0) - m(1)
         m(n) = 2.0_wp*m(n - 1) - m(n - 2)
         m(n + 1) = 2.0_wp*m(n) - m(n - 1)
      end if
      do k = 1, n
         after = abs(m(k + 1) - m(k))
         before = abs(m(k - 1) - m(k - 2))
         t(k) = 0.5_wp*(m(k - 1) + m(k))
         if (after + before > 0.0_wp) t(k) = (after*m(k - 1) + before*m(k))/(after + before)
      end do
      curve%x = x
      curve%beyond = beyond
      curve%bends = .true.
      allocate (curve%c(0:3, n - 1))
      do k = 1, n - 1
         h = x(k + 1) - x(k)
         curve%c(:, k) = [y(k), t(k), (3.0_wp*m(k) - 2.0_wp*t(k) - t(k + 1))/h, (t(k) + t(k + 1) - 2.0_wp*m(k))/h**2]
      end do
   end subroutine new_akima

end module akima
