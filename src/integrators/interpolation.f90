!> The free interpolant of a step: quintic for positions, its derivative for velocities.
!>
!> From position, velocity and acceleration at both ends of a step of length h there is one quintic;
!> with s = (t - t0)/h its error is s^3 (1-s)^3 h^6 q^(6) / 720 in positions and of order h^5 in
!> velocities. Other states and quadratures follow the cubic of Hermite, order h^4. With the
!> right-hand side known at a third and at two thirds of the step too (`has_inner`) every part gains
!> two orders: positions the terms s^3 (1-s)^3 and s^3 (1-s)^3 (s - 1/2), others s^2 (1-s)^2 and
!> s^2 (1-s)^2 (s - 1/2), fitted to the derivatives there. After a step of order 6, whose inner states
!> come from the interpolant itself, that is 7 in positions, 6 in velocities and quadratures.
module interpolation
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: inner_places, interpolate, step_t

   real(wp), parameter :: inner_places(2) = [1.0_wp, 2.0_wp]/3.0_wp  !! (2) of the inner derivatives, as parts of the step [1]

   !> One step of an integration, with all that interpolation needs.
   type :: step_t
      real(wp) :: t0 = 0.0_wp                      !! time at its start [s]
      real(wp) :: h = 0.0_wp                       !! its length [s]
      logical :: has_inner = .false.               !! whether `inner` holds the derivatives at the inner places
      real(wp), allocatable :: y0(:), y1(:)        !! (n) state at its ends [any]
      real(wp), allocatable :: f0(:), f1(:)        !! (n) derivative at its ends [any]
      real(wp), allocatable :: inner(:, :)         !! (n, 2) derivatives at the inner places [any]
   end type step_t

contains

   !> State at t0 + s h.
   pure subroutine interpolate(step, n_position, s, y)
      type(step_t), intent(in) :: step    !! the step
      integer, intent(in) :: n_position   !! leading entries that are positions
      real(wp), intent(in) :: s           !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)       !! (n) state [any]

      ! with u = s (1-s): second derivatives of u^3 and u^3 (s - 1/2), first ones of u^2 and u^2 (s - 1/2), at s = 1/3;
      ! at s = 2/3 they are the same, and of opposite sign where the function is odd about the middle (or its derivative is)
      real(wp), parameter :: even_2 = -4.0_wp/27.0_wp, odd_2 = 10.0_wp/81.0_wp, even_1 = 4.0_wp/27.0_wp, odd_1 = 2.0_wp/81.0_wp
      real(wp), parameter :: p = inner_places(1), q = inner_places(2)
      real(wp) :: a_h2, c, cube, cube_rate, d, e, even, h, middle, odd, q1, r1, r2, square, u, v1
      integer :: k, n, v

      n = size(y)
      h = step%h
      u = s*(1.0_wp - s)
      middle = s - 0.5_wp
      square = u*u
      cube = square*u
      cube_rate = -6.0_wp*square*middle
      do k = 1, n_position
         v = n_position + k
         ! q(s) = q0 + s (h v0 + s (h^2 a0 / 2 + s (c + s (d + s e))))
         a_h2 = h*h*step%f0(v)
         q1 = step%y1(k) - step%y0(k) - h*step%y0(v) - 0.5_wp*a_h2
         v1 = h*(step%y1(v) - step%y0(v)) - a_h2
         c = h*h*step%f1(v) - a_h2
         e = 6.0_wp*q1 - 3.0_wp*v1 + 0.5_wp*c
         d = -15.0_wp*q1 + 7.0_wp*v1 - c
         c = 10.0_wp*q1 - 4.0_wp*v1 + 0.5_wp*c
         y(k) = step%y0(k) + s*(h*step%y0(v) + s*(0.5_wp*a_h2 + s*(c + s*(d + s*e))))
         y(v) = step%y0(v) + s*(h*step%f0(v) + s*(3.0_wp*c + s*(4.0_wp*d + s*5.0_wp*e))/h)
         if (step%has_inner) then
            r1 = h*h*step%inner(v, 1) - a_h2 - p*(6.0_wp*c + p*(12.0_wp*d + p*20.0_wp*e))
            r2 = h*h*step%inner(v, 2) - a_h2 - q*(6.0_wp*c + q*(12.0_wp*d + q*20.0_wp*e))
            even = 0.5_wp*(r1 + r2)/even_2
            odd = 0.5_wp*(r1 - r2)/odd_2
            y(k) = y(k) + cube*(even + odd*middle)
            y(v) = y(v) + (cube_rate*(even + odd*middle) + cube*odd)/h
         end if
      end do
      do k = 2*n_position + 1, n
         q1 = step%y1(k) - step%y0(k) - h*step%f0(k)
         c = 3.0_wp*q1 - h*(step%f1(k) - step%f0(k))
         d = -2.0_wp*q1 + h*(step%f1(k) - step%f0(k))
         y(k) = step%y0(k) + s*(h*step%f0(k) + s*(c + s*d))
         if (step%has_inner) then
            r1 = h*(step%inner(k, 1) - step%f0(k)) - p*(2.0_wp*c + p*3.0_wp*d)
            r2 = h*(step%inner(k, 2) - step%f0(k)) - q*(2.0_wp*c + q*3.0_wp*d)
            even = 0.5_wp*(r1 - r2)/even_1
            odd = 0.5_wp*(r1 + r2)/odd_1
            y(k) = y(k) + square*(even + odd*middle)
         end if
      end do
   end subroutine interpolate

end module interpolation
