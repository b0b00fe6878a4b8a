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
   public :: fit_inner, inner_places, interpolate, step_t

   real(wp), parameter :: inner_places(2) = [1.0_wp, 2.0_wp]/3.0_wp  !! (2) of the inner derivatives, as parts of the step [1]

   ! with u = s (1-s): second derivatives of u^3 and u^3 (s - 1/2), first ones of u^2 and u^2 (s - 1/2), at s = 1/3;
   ! at s = 2/3 they are the same, and of opposite sign where the function is odd about the middle (or its derivative is)
   real(wp), parameter :: even_2 = -4.0_wp/27.0_wp, odd_2 = 10.0_wp/81.0_wp, even_1 = 4.0_wp/27.0_wp, odd_1 = 2.0_wp/81.0_wp

   !> One step of an integration, with all that interpolation needs.
   type :: step_t
      real(wp) :: t0 = 0.0_wp                      !! time at its start [s]
      real(wp) :: h = 0.0_wp                       !! its length [s]
      integer :: course = course_even              !! how time goes along it, see `step_course`
      logical :: has_inner = .false.               !! whether there are terms of higher order; `inner` holds their factors
      real(wp), allocatable :: y0(:), y1(:)        !! (n) state at its ends [any]
      real(wp), allocatable :: f0(:), f1(:)        !! (n) derivative at its ends [any]
      real(wp), allocatable :: inner(:, :)         !! (n, 2) derivatives at the inner places, then see `fit_inner` [any]
   end type step_t

contains

   !> State at t0 + s h.
   pure subroutine interpolate(step, n_position, n_turning, s, n, y)
      type(step_t), intent(in) :: step    !! the step
      integer, intent(in) :: n_position   !! leading entries that are positions
      integer, intent(in) :: n_turning    !! bodies that turn in space, the first ones
      real(wp), intent(in) :: s           !! place in the step, 0 to 1 [1]
      integer, intent(in) :: n            !! entries that are requested, positions and rates among them
      real(wp), intent(inout) :: y(n)     !! (n) state, set [any]

      integer :: body

      do body = 1, n_turning
         call follow(step, 7*body - 6, n_position + 6*body - 5, 3, s, n, y)
         call follow_turn(step, 7*body - 3, n_position + 6*body - 2, s, n, y)
      end do
      call follow(step, 7*n_turning + 1, n_position + 6*n_turning + 1, n_position - 7*n_turning, s, n, y)
      if (2*n_position - n_turning < n) call follow_others(step, 2*n_position - n_turning + 1, s, n, y)
   end subroutine interpolate

   !> Positions whose derivatives are rates, from a place on.
   pure subroutine follow(step, k, v, n_pair, s, n, y)
      type(step_t), intent(in) :: step  !! the step
      integer, intent(in) :: k          !! place of the first position
      integer, intent(in) :: v          !! place of its rate
      integer, intent(in) :: n_pair     !! how many
      real(wp), intent(in) :: s         !! place in the step, 0 to 1 [1]
      integer, intent(in) :: n          !! entries of the state
      real(wp), intent(inout) :: y(n)   !! (n) state, these are set [any]

      if (n_pair == 0) return
      call follow_pairs(n_pair, step%h, s, step%has_inner, step%y0(k), step%y1(k), step%y0(v), step%y1(v), step%f0(v), &
                        step%f1(v), step%inner(k, 1), step%inner(k, 2), y(k), y(v))
   end subroutine follow

   !> The same on plain arrays.
   pure subroutine follow_pairs(n, h, s, has_inner, q0, q1, v0, v1, a0, a1, even, odd, q, v)
      integer, intent(in) :: n              !! how many
      real(wp), intent(in) :: h             !! length of the step [s]
      real(wp), intent(in) :: s             !! place in the step, 0 to 1 [1]
      logical, intent(in) :: has_inner      !! there are terms of higher order
      real(wp), intent(in) :: q0(n), q1(n)  !! (n) positions at the ends of the step [any]
      real(wp), intent(in) :: v0(n), v1(n)  !! (n) rates [any]
      real(wp), intent(in) :: a0(n), a1(n)  !! (n) their derivatives [any]
      real(wp), intent(in) :: even(n)       !! (n) factors of s^3 (1-s)^3 [any]
      real(wp), intent(in) :: odd(n)        !! (n) factors of s^3 (1-s)^3 (s - 1/2) [any]
      real(wp), intent(inout) :: q(n)       !! (n) positions, set [any]
      real(wp), intent(inout) :: v(n)       !! (n) rates, set [any]

      real(wp) :: a_h2, c, cube, cube_rate, d, e, middle, u
      integer :: k

      u = s*(1.0_wp - s)
      middle = s - 0.5_wp
      cube = u*u*u
      cube_rate = -6.0_wp*u*u*middle
      do k = 1, n
         call find_pair(h, q0(k), q1(k), v0(k), v1(k), a0(k), a1(k), a_h2, c, d, e)
         q(k) = q0(k) + s*(h*v0(k) + s*(0.5_wp*a_h2 + s*(c + s*(d + s*e))))
         v(k) = v0(k) + s*(h*a0(k) + s*(3.0_wp*c + s*(4.0_wp*d + s*5.0_wp*e))/h)
         if (has_inner) then
            q(k) = q(k) + cube*(even(k) + odd(k)*middle)
            v(k) = v(k) + (cube_rate*(even(k) + odd(k)*middle) + cube*odd(k))/h
         end if
      end do
   end subroutine follow_pairs

   !> The quintic of a position: q(s) = q0 + s (h v0 + s (h^2 a0 / 2 + s (c + s (d + s e)))).
   elemental subroutine find_pair(h, q0, q1, v0, v1, a0, a1, a_h2, c, d, e)
      real(wp), intent(in) :: h         !! length of the step [s]
      real(wp), intent(in) :: q0, q1    !! position at its ends [any]
      real(wp), intent(in) :: v0, v1    !! its rate [any]
      real(wp), intent(in) :: a0, a1    !! its second derivative [any]
      real(wp), intent(out) :: a_h2     !! h^2 a0 [any]
      real(wp), intent(out) :: c, d, e  !! factors of the powers 3, 4 and 5 [any]

      a_h2 = h*h*a0
      call find_quintic(q1 - q0 - h*v0 - 0.5_wp*a_h2, h*(v1 - v0) - a_h2, h*h*a1 - a_h2, c, d, e)
   end subroutine find_pair

   !> Factors of a quintic, from what a parabola through the start of the step misses at its end.
   elemental subroutine find_quintic(rest, rate_rest, bend_rest, c, d, e)
      real(wp), intent(in) :: rest          !! of the position [any]
      real(wp), intent(in) :: rate_rest     !! of its rate, times h [any]
      real(wp), intent(in) :: bend_rest     !! of its second derivative, times h^2 [any]
      real(wp), intent(out) :: c, d, e      !! factors of the powers 3, 4 and 5 [any]

      c = 10.0_wp*rest - 4.0_wp*rate_rest + 0.5_wp*bend_rest
      d = -15.0_wp*rest + 7.0_wp*rate_rest - bend_rest
      e = 6.0_wp*rest - 3.0_wp*rate_rest + 0.5_wp*bend_rest
   end subroutine find_quintic

   !> What the second derivative of a quintic misses at an inner place, times h^2.
   elemental real(wp) function missing(bend, a_h2, c, d, e, z)
      real(wp), intent(in) :: bend          !! second derivative there, times h^2 [any]
      real(wp), intent(in) :: a_h2          !! that at the start of the step, times h^2 [any]
      real(wp), intent(in) :: c, d, e       !! factors of the quintic [any]
      real(wp), intent(in) :: z             !! the place [1]

      missing = bend - a_h2 - z*(6.0_wp*c + z*(12.0_wp*d + z*20.0_wp*e))
   end function missing

   !> Fit the terms of higher order to the derivatives at the inner places: their factors take the place of these, of positions in
   !> the entries of the positions.
   pure subroutine fit_inner(step, n_position, n_turning, n)
      type(step_t), intent(inout) :: step   !! the step, `inner` the derivatives; then `has_inner`
      integer, intent(in) :: n_position     !! leading entries that are positions
      integer, intent(in) :: n_turning      !! bodies that turn in space, the first ones
      integer, intent(in) :: n              !! entries that are fitted

      integer :: body

      do body = 1, n_turning
         call fit_pairs(step, 7*body - 6, n_position + 6*body - 5, 3)
         call fit_turn(step, 7*body - 3, n_position + 6*body - 2)
      end do
      call fit_pairs(step, 7*n_turning + 1, n_position + 6*n_turning + 1, n_position - 7*n_turning)
      call fit_others(step, 2*n_position - n_turning + 1, n)
      step%has_inner = .true.
   end subroutine fit_inner

   !> Positions whose derivatives are rates.
   pure subroutine fit_pairs(step, first, first_rate, n)
      type(step_t), intent(inout) :: step   !! the step
      integer, intent(in) :: first          !! place of the first position
      integer, intent(in) :: first_rate     !! place of its rate
      integer, intent(in) :: n              !! how many

      real(wp) :: a_h2, c, d, e, r(2)
      integer :: k, v

      do k = first, first + n - 1
         v = first_rate + k - first
         call find_pair(step%h, step%y0(k), step%y1(k), step%y0(v), step%y1(v), step%f0(v), step%f1(v), a_h2, c, d, e)
         r = missing(step%h*step%h*step%inner(v, :), a_h2, c, d, e, inner_places)
         step%inner(k, :) = 0.5_wp*[r(1) + r(2), r(1) - r(2)]/[even_2, odd_2]
      end do
   end subroutine fit_pairs

   !> Euler parameters and the angular velocity of a body.
   pure subroutine fit_turn(step, first, first_rate)
      type(step_t), intent(inout) :: step   !! the step
      integer, intent(in) :: first          !! place of the first Euler parameter
      integer, intent(in) :: first_rate     !! place of the first angular velocity

      real(wp) :: a0(4), at(4), at_rate(4), c(4), d(4), e(4), r(4, 2), v0(4)
      integer :: k

      call find_turn(step, first, first_rate, v0, a0, c, d, e)
      do k = 1, size(inner_places)
         associate (z => inner_places(k), p0 => step%y0(first:first + 3))
            at = p0 + z*(v0 + z*(0.5_wp*a0 + z*(c + z*(d + z*e))))
            at_rate = (v0 + z*(a0 + z*(3.0_wp*c + z*(4.0_wp*d + z*5.0_wp*e))))/step%h
            r(:, k) = missing(step%h*step%h*second_rate_of_parameters(at, spin_of(at, at_rate), &
                                                                      step%inner(first_rate:first_rate + 2, k)), a0, c, d, e, z)
         end associate
      end do
      step%inner(first:first + 3, 1) = 0.5_wp*(r(:, 1) + r(:, 2))/even_2
      step%inner(first:first + 3, 2) = 0.5_wp*(r(:, 1) - r(:, 2))/odd_2
   end subroutine fit_turn

   !> The quintics of a body's Euler parameters.
   pure subroutine find_turn(step, first, first_rate, v0, a0, c, d, e)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: first          !! place of the first Euler parameter
      integer, intent(in) :: first_rate     !! place of the first angular velocity
      real(wp), intent(out) :: v0(4)        !! (4) rates at the start, times h [1]
      real(wp), intent(out) :: a0(4)        !! (4) second derivatives there, times h^2 [1]
      real(wp), dimension(4), intent(out) :: c, d, e  !! (4) factors of the powers 3, 4 and 5 [1]

      real(wp) :: a1(4), h, v1(4)

      h = step%h
      associate (p0 => step%y0(first:first + 3), p1 => step%y1(first:first + 3), &
                 w0 => step%y0(first_rate:first_rate + 2), w1 => step%y1(first_rate:first_rate + 2))
         v0 = h*rate_of_parameters(p0, w0)
         v1 = h*rate_of_parameters(p1, w1)
         a0 = h*h*second_rate_of_parameters(p0, w0, step%f0(first_rate:first_rate + 2))
         a1 = h*h*second_rate_of_parameters(p1, w1, step%f1(first_rate:first_rate + 2))
         call find_quintic(p1 - p0 - v0 - 0.5_wp*a0, v1 - v0 - a0, a1 - a0, c, d, e)
      end associate
   end subroutine find_turn

   !> Euler parameters and the angular velocity of a body.
   pure subroutine follow_turn(step, first, first_rate, s, n, y)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: first          !! place of the first Euler parameter
      integer, intent(in) :: first_rate     !! place of the first angular velocity
      real(wp), intent(in) :: s             !! place in the step, 0 to 1 [1]
      integer, intent(in) :: n              !! entries of the state
      real(wp), intent(inout) :: y(n)       !! (n) state, these are set [any]

      real(wp), dimension(4) :: a0, c, d, e, value, rate, v0
      real(wp) :: cube, middle, u

      call find_turn(step, first, first_rate, v0, a0, c, d, e)
      value = step%y0(first:first + 3) + s*(v0 + s*(0.5_wp*a0 + s*(c + s*(d + s*e))))
      rate = v0 + s*(a0 + s*(3.0_wp*c + s*(4.0_wp*d + s*5.0_wp*e)))
      if (step%has_inner) then
         u = s*(1.0_wp - s)
         middle = s - 0.5_wp
         cube = u*u*u
         associate (even => step%inner(first:first + 3, 1), odd => step%inner(first:first + 3, 2))
            value = value + cube*(even + odd*middle)
            rate = rate - 6.0_wp*u*u*middle*(even + odd*middle) + cube*odd
         end associate
      end if
      y(first:first + 3) = value
      y(first_rate:first_rate + 2) = spin_of(value, rate/step%h)
   end subroutine follow_turn

   !> States and quadratures.
   pure subroutine follow_others(step, first, s, n, y)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: first          !! place of the first
      real(wp), intent(in) :: s             !! place in the step, 0 to 1 [1]
      integer, intent(in) :: n              !! entries of the state, the last
      real(wp), intent(inout) :: y(n)       !! (n) state, they are set [any]

      real(wp) :: c, d, middle, square
      integer :: k

      square = (s*(1.0_wp - s))**2
      middle = s - 0.5_wp
      do k = first, n
         call find_cubic(step, k, c, d)
         y(k) = step%y0(k) + s*(step%h*step%f0(k) + s*(c + s*d))
         if (step%has_inner) y(k) = y(k) + square*(step%inner(k, 1) + step%inner(k, 2)*middle)
      end do
   end subroutine follow_others

   !> The same: terms of higher order.
   pure subroutine fit_others(step, first, last)
      type(step_t), intent(inout) :: step   !! the step
      integer, intent(in) :: first          !! place of the first
      integer, intent(in) :: last           !! place of the last

      real(wp) :: c, d, r(2)
      integer :: k

      do k = first, last
         call find_cubic(step, k, c, d)
         r = step%h*(step%inner(k, :) - step%f0(k)) - inner_places*(2.0_wp*c + inner_places*3.0_wp*d)
         step%inner(k, :) = 0.5_wp*[r(1) - r(2), r(1) + r(2)]/[even_1, odd_1]
      end do
   end subroutine fit_others

   !> The cubic of a state: y(s) = y0 + s (h f0 + s (c + s d)).
   pure subroutine find_cubic(step, k, c, d)
      type(step_t), intent(in) :: step      !! the step
      integer, intent(in) :: k              !! place of the state
      real(wp), intent(out) :: c, d         !! factors of the powers 2 and 3 [any]

      real(wp) :: q1

      q1 = step%y1(k) - step%y0(k) - step%h*step%f0(k)
      c = 3.0_wp*q1 - step%h*(step%f1(k) - step%f0(k))
      d = -2.0_wp*q1 + step%h*(step%f1(k) - step%f0(k))
   end subroutine find_cubic

end module interpolation
