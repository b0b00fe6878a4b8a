!> The free interpolant of a step: quintic for positions, its derivative for velocities.
!>
!> From position, velocity and acceleration at both ends of a step of length h there is one quintic;
!> with s = (t - t0)/h its error is s^3 (1-s)^3 h^6 q^(6) / 720 in positions and of order h^5 in
!> velocities. Other states and quadratures follow the cubic of Hermite, order h^4. With the
!> right-hand side known at a third and at two thirds of the step too (`has_inner`) every part gains
!> two orders: positions the terms s^3 (1-s)^3 and s^3 (1-s)^3 (s - 1/2), others s^2 (1-s)^2 and
!> s^2 (1-s)^2 (s - 1/2), fitted to the derivatives there. After a step of order 6, whose inner states
!> come from the interpolant itself, that is 7 in positions, 6 in velocities and quadratures.
!> Euler parameters are positions too: their second derivative follows from the angular acceleration, and the angular velocity
!> from the derivative of their quintic (`rotations`).
module interpolation
   use kinds, only: wp
   use rotations, only: rate_of_parameters, second_rate_of_parameters, spin_of
   use step_course, only: course_even
   implicit none (type, external)
   private
   public :: inner_places, interpolate, step_t

   real(wp), parameter :: inner_places(2) = [1.0_wp, 2.0_wp]/3.0_wp  !! (2) of the inner derivatives, as parts of the step [1]

   ! with u = s (1-s): second derivatives of u^3 and u^3 (s - 1/2), first ones of u^2 and u^2 (s - 1/2), at s = 1/3;
   ! at s = 2/3 they are the same, and of opposite sign where the function is odd about the middle (or its derivative is)
   real(wp), parameter :: even_2 = -4.0_wp/27.0_wp, odd_2 = 10.0_wp/81.0_wp, even_1 = 4.0_wp/27.0_wp, odd_1 = 2.0_wp/81.0_wp

   !> One step of an integration, with all that interpolation needs.
   type :: step_t
      real(wp) :: t0 = 0.0_wp                      !! time at its start [s]
      real(wp) :: h = 0.0_wp                       !! its length [s]
      integer :: course = course_even              !! how time goes along it, see `step_course`
      logical :: has_inner = .false.               !! whether `inner` holds the derivatives at the inner places
      real(wp), allocatable :: y0(:), y1(:)        !! (n) state at its ends [any]
      real(wp), allocatable :: f0(:), f1(:)        !! (n) derivative at its ends [any]
      real(wp), allocatable :: inner(:, :)         !! (n, 2) derivatives at the inner places [any]
   end type step_t

contains

   !> State at t0 + s h.
   pure subroutine interpolate(step, n_position, n_turning, s, y)
      type(step_t), intent(in) :: step    !! the step
      integer, intent(in) :: n_position   !! leading entries that are positions
      integer, intent(in) :: n_turning    !! bodies that turn in space, the first ones
      real(wp), intent(in) :: s           !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)       !! (n) state [any]

      integer :: body

      do body = 1, n_turning
         call follow_pairs(step, 7*body - 6, n_position + 6*body - 5, 3, s, y)
         call follow_turn(step, 7*body - 3, n_position + 6*body - 2, s, y)
      end do
      call follow_pairs(step, 7*n_turning + 1, n_position + 6*n_turning + 1, n_position - 7*n_turning, s, y)
      call follow_others(step, 2*n_position - n_turning + 1, s, y)
   end subroutine interpolate

   !> Positions whose derivatives are rates.
   pure subroutine follow_pairs(step, first, first_rate, n, s, y)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: first          !! place of the first position
      integer, intent(in) :: first_rate     !! place of its rate
      integer, intent(in) :: n              !! how many
      real(wp), intent(in) :: s             !! place in the step, 0 to 1 [1]
      real(wp), intent(inout) :: y(:)       !! (n) state, positions and rates are set [any]

      real(wp), parameter :: p = inner_places(1), q = inner_places(2)
      real(wp) :: a_h2, c, cube, cube_rate, d, e, even, h, middle, odd, q1, r1, r2, u, v1
      integer :: k, v

      h = step%h
      u = s*(1.0_wp - s)
      middle = s - 0.5_wp
      cube = u*u*u
      cube_rate = -6.0_wp*u*u*middle
      do k = first, first + n - 1
         v = first_rate + k - first
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
   end subroutine follow_pairs

   !> Euler parameters and the angular velocity of a body.
   pure subroutine follow_turn(step, first, first_rate, s, y)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: first          !! place of the first Euler parameter
      integer, intent(in) :: first_rate     !! place of the first angular velocity
      real(wp), intent(in) :: s             !! place in the step, 0 to 1 [1]
      real(wp), intent(inout) :: y(:)       !! (n) state, these are set [any]

      real(wp), dimension(4) :: a0, a1, c, d, e, even, odd, p0, p1, q1, r1, r2, v0, v1, value, rate
      real(wp) :: cube, h, middle, u

      h = step%h
      associate (w0 => step%y0(first_rate:first_rate + 2), w1 => step%y1(first_rate:first_rate + 2))
         p0 = step%y0(first:first + 3)
         p1 = step%y1(first:first + 3)
         v0 = h*rate_of_parameters(p0, w0)
         v1 = h*rate_of_parameters(p1, w1)
         a0 = h*h*second_rate_of_parameters(p0, w0, step%f0(first_rate:first_rate + 2))
         a1 = h*h*second_rate_of_parameters(p1, w1, step%f1(first_rate:first_rate + 2))
      end associate
      q1 = p1 - p0 - v0 - 0.5_wp*a0
      v1 = v1 - v0 - a0
      a1 = a1 - a0
      c = 10.0_wp*q1 - 4.0_wp*v1 + 0.5_wp*a1
      d = -15.0_wp*q1 + 7.0_wp*v1 - a1
      e = 6.0_wp*q1 - 3.0_wp*v1 + 0.5_wp*a1
      value = p0 + s*(v0 + s*(0.5_wp*a0 + s*(c + s*(d + s*e))))
      rate = v0 + s*(a0 + s*(3.0_wp*c + s*(4.0_wp*d + s*5.0_wp*e)))
      if (step%has_inner) then
         r1 = missing(1)
         r2 = missing(2)
         even = 0.5_wp*(r1 + r2)/even_2
         odd = 0.5_wp*(r1 - r2)/odd_2
         u = s*(1.0_wp - s)
         middle = s - 0.5_wp
         cube = u*u*u
         value = value + cube*(even + odd*middle)
         rate = rate - 6.0_wp*u*u*middle*(even + odd*middle) + cube*odd
      end if
      y(first:first + 3) = value
      y(first_rate:first_rate + 2) = spin_of(value, rate/h)

   contains

      !> What the second derivative of the quintic misses at an inner place, whose state came from the quintic.
      pure function missing(k) result(r)
         integer, intent(in) :: k   !! number of the place
         real(wp) :: r(4)           !! (4) missing, times h^2 [1]

         real(wp) :: at(4), at_rate(4)

         associate (z => inner_places(k))
            at = p0 + z*(v0 + z*(0.5_wp*a0 + z*(c + z*(d + z*e))))
            at_rate = (v0 + z*(a0 + z*(3.0_wp*c + z*(4.0_wp*d + z*5.0_wp*e))))/h
            r = h*h*second_rate_of_parameters(at, spin_of(at, at_rate), step%inner(first_rate:first_rate + 2, k)) &
                - a0 - z*(6.0_wp*c + z*(12.0_wp*d + z*20.0_wp*e))
         end associate
      end function missing

   end subroutine follow_turn

   !> States and quadratures.
   pure subroutine follow_others(step, first, s, y)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: first          !! place of the first
      real(wp), intent(in) :: s             !! place in the step, 0 to 1 [1]
      real(wp), intent(inout) :: y(:)       !! (n) state, they are set [any]

      real(wp), parameter :: p = inner_places(1), q = inner_places(2)
      real(wp) :: c, d, even, h, middle, odd, q1, r1, r2, square
      integer :: k

      h = step%h
      square = (s*(1.0_wp - s))**2
      middle = s - 0.5_wp
      do k = first, size(y)
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
   end subroutine follow_others

end module interpolation
