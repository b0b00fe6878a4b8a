!> The free interpolant of a step: quintic for positions, its derivative for velocities.
!>
!> From position, velocity and acceleration at both ends of a step of length h there is one quintic;
!> with s = (t - t0)/h its error is s^3 (1-s)^3 h^6 q^(6) / 720 in positions and of order h^5 in
!> velocities. Other states and quadratures follow the cubic of Hermite, order h^4. With the
!> right-hand side known at one inner place too (`has_inner`) every part gains an order: positions
!> the term s^3 (1-s)^3, others the term s^2 (1-s)^2, each fitted to the derivative there. The place
!> is a third of the step, where both terms are well determined (in the middle the second is not).
module interpolation
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: inner_place, interpolate, step_t

   real(wp), parameter :: inner_place = 1.0_wp/3.0_wp  !! of the inner derivative, as a part of the step [1]

   !> One step of an integration, with all that interpolation needs.
   type :: step_t
      real(wp) :: t0 = 0.0_wp                      !! time at its start [s]
      real(wp) :: h = 0.0_wp                       !! its length [s]
      logical :: has_inner = .false.               !! whether `inner` holds the derivative at the inner place
      real(wp), allocatable :: y0(:), y1(:)        !! (n) state at its ends [any]
      real(wp), allocatable :: f0(:), f1(:)        !! (n) derivative at its ends [any]
      real(wp), allocatable :: inner(:)            !! (n) derivative at the inner place [any]
      real(wp), allocatable :: scratch(:)          !! (n) room for one state [any]
   end type step_t

contains

   !> State at t0 + s h.
   pure subroutine interpolate(step, n_position, s, y)
      type(step_t), intent(in) :: step    !! the step
      integer, intent(in) :: n_position   !! leading entries that are positions
      real(wp), intent(in) :: s           !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)       !! (n) state [any]

      real(wp), parameter :: p = inner_place
      real(wp), parameter :: bump_curvature = -4.0_wp/27.0_wp  ! second derivative of s^3 (1-s)^3 at the inner place [1]
      real(wp), parameter :: hump_slope = 4.0_wp/27.0_wp       ! derivative of s^2 (1-s)^2 there [1]
      real(wp) :: bump, bump_rate, c, d, e, h, hump, q1, v1
      integer :: k, n, v

      n = size(y)
      h = step%h
      hump = (s*(1.0_wp - s))**2
      bump = hump*s*(1.0_wp - s)
      bump_rate = 3.0_wp*hump*(1.0_wp - 2.0_wp*s)
      do k = 1, n_position
         v = n_position + k
         ! q(s) = q0 + s (h v0 + s (h^2 a0 / 2 + s (c + s (d + s e))))
         q1 = step%y1(k) - step%y0(k) - h*step%y0(v) - 0.5_wp*h*h*step%f0(v)
         v1 = h*(step%y1(v) - step%y0(v)) - h*h*step%f0(v)
         c = h*h*(step%f1(v) - step%f0(v))
         e = 6.0_wp*q1 - 3.0_wp*v1 + 0.5_wp*c
         d = -15.0_wp*q1 + 7.0_wp*v1 - c
         c = 10.0_wp*q1 - 4.0_wp*v1 + 0.5_wp*c
         y(k) = step%y0(k) + s*(h*step%y0(v) + s*(0.5_wp*h*h*step%f0(v) + s*(c + s*(d + s*e))))
         y(v) = step%y0(v) + s*(h*step%f0(v) + s*(3.0_wp*c + s*(4.0_wp*d + s*5.0_wp*e))/h)
         if (step%has_inner) then
            q1 = (h*h*(step%inner(v) - step%f0(v)) - p*(6.0_wp*c + p*(12.0_wp*d + p*20.0_wp*e)))/bump_curvature
            y(k) = y(k) + q1*bump
            y(v) = y(v) + q1*bump_rate/h
         end if
      end do
      do k = 2*n_position + 1, n
         q1 = step%y1(k) - step%y0(k) - h*step%f0(k)
         c = 3.0_wp*q1 - h*(step%f1(k) - step%f0(k))
         d = -2.0_wp*q1 + h*(step%f1(k) - step%f0(k))
         y(k) = step%y0(k) + s*(h*step%f0(k) + s*(c + s*d))
         if (step%has_inner) then
            y(k) = y(k) + (h*(step%inner(k) - step%f0(k)) - p*(2.0_wp*c + p*3.0_wp*d))/hump_slope*hump
         end if
      end do
   end subroutine interpolate

end module interpolation
