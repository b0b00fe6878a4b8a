!> The free interpolant of a step: quintic for positions, its derivative for velocities.
!>
!> From position, velocity and acceleration at both ends of a step of length h there is one quintic;
!> with s = (t - t0)/h its error is s^3 (1-s)^3 h^6 q^(6) / 720 in positions and of order h^5 in
!> velocities, nil to that order in the middle. Other states and quadratures follow the cubic of
!> Hermite. With the right-hand side known in the middle too (`has_middle`) positions gain the term
!> s^3 (1-s)^3 that fits the middle acceleration, and one order; the others the term
!> s^2 (1-s)^2 (1-2s) that fits the middle derivative.
module interpolation
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: interpolate, step_t

   !> One step of an integration, with all that interpolation needs.
   type :: step_t
      real(wp) :: t0 = 0.0_wp                      !! time at its start [s]
      real(wp) :: h = 0.0_wp                       !! its length [s]
      logical :: has_middle = .false.              !! whether `middle` holds the derivative at t0 + h/2
      real(wp), allocatable :: y0(:), y1(:)        !! (n) state at its ends [any]
      real(wp), allocatable :: f0(:), f1(:)        !! (n) derivative at its ends [any]
      real(wp), allocatable :: middle(:)           !! (n) derivative in the middle [any]
      real(wp), allocatable :: scratch(:)          !! (n) room for one state [any]
   end type step_t

contains

   !> State at t0 + s h.
   pure subroutine interpolate(step, n_position, s, y)
      type(step_t), intent(in) :: step    !! the step
      integer, intent(in) :: n_position   !! leading entries that are positions
      real(wp), intent(in) :: s           !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)       !! (n) state [any]

      real(wp) :: bump, bump_rate, c, d, e, h, q1, v1
      integer :: k, n, v

      n = size(y)
      h = step%h
      ! the term of the middle acceleration: b(s) = s^3 (1-s)^3, b''(1/2) = -3/8
      bump = (s*(1.0_wp - s))**3
      bump_rate = 3.0_wp*(s*(1.0_wp - s))**2*(1.0_wp - 2.0_wp*s)
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
         if (step%has_middle) then
            ! middle acceleration less that of the quintic, times h^2 / b''
            q1 = (h*h*(step%middle(v) - step%f0(v)) - (3.0_wp*c + 3.0_wp*d + 2.5_wp*e))*(-8.0_wp/3.0_wp)
            y(k) = y(k) + q1*bump
            y(v) = y(v) + q1*bump_rate/h
         end if
      end do
      do k = 2*n_position + 1, n
         q1 = step%y1(k) - step%y0(k) - h*step%f0(k)
         c = 3.0_wp*q1 - h*(step%f1(k) - step%f0(k))
         d = -2.0_wp*q1 + h*(step%f1(k) - step%f0(k))
         y(k) = step%y0(k) + s*(h*step%f0(k) + s*(c + s*d))
         if (step%has_middle) then
            ! the term s^2 (1-s)^2 (1-2s) keeps both ends and fits the middle derivative, -1/8 per unit
            q1 = (h*(step%middle(k) - step%f0(k)) - (c + 0.75_wp*d))*(-8.0_wp)
            y(k) = y(k) + q1*(s*(1.0_wp - s))**2*(1.0_wp - 2.0_wp*s)
         end if
      end do
   end subroutine interpolate

end module interpolation
