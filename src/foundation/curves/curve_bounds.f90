!> Bounds of a curve and its derivatives over an interval of its argument.
module curve_bounds
   use curve, only: beyond_error, beyond_stabilisation, beyond_periodic, beyond_same, curve_t, curve_values
   use intervals, only: hull, line, product_of, sine_of, sum_of, times
   use kinds, only: two_pi, wp
   use rise_laws, only: bound_rise
   implicit none (type, external)
   private
   public :: bound_curve

contains

   !> Bounds of f, f' and f'' over an interval; where the curve does not exist, nothing is bounded.
   subroutine bound_curve(curve, x, f)
      type(curve_t), intent(in) :: curve     !! the curve
      real(wp), intent(in) :: x(2)           !! (2) the interval [any]
      real(wp), intent(out) :: f(2, 3)       !! (2, 3) bounds of f, f', f'' [any]

      real(wp) :: angle(2), first, last, start, wave(2)
      integer :: n
      logical :: is_empty

      n = size(curve%x)
      first = curve%x(1)
      last = curve%x(n)
      f = 0.0_wp
      is_empty = .true.
      if (.not. x(2) - x(1) < huge(1.0_wp)) then
         f = spread(line(), 2, 3)
         return
      end if
      if (curve%beyond == beyond_same) then
         call take_segments(x)
      else if (curve%beyond == beyond_periodic) then
         if (x(2) - x(1) >= last - first) then
            call take_segments([first, last])
         else
            start = first + modulo(x(1) - first, last - first)
            call take_segments([start, min(start + (x(2) - x(1)), last)])
            if (start + (x(2) - x(1)) > last) call take_segments([first, start + (x(2) - x(1)) - (last - first)])
         end if
      else
         if (x(1) <= last .and. x(2) >= first) call take_segments([max(x(1), first), min(x(2), last)])
         if (x(1) < first) call take_outside(x(1), min(x(2), first))
         if (x(2) > last) call take_outside(max(x(1), last), x(2))
      end if
      if (.not. abs(curve%amplitude) > 0.0_wp) return
      angle = sum_of(times(curve%angular_frequency, x), [curve%phase, curve%phase])
      wave = times(curve%amplitude, sine_of(angle))
      f(:, 1) = sum_of(f(:, 1), wave)
      f(:, 2) = sum_of(f(:, 2), times(curve%amplitude*curve%angular_frequency, sine_of(angle + 0.25_wp*two_pi)))
      f(:, 3) = sum_of(f(:, 3), times(-curve%angular_frequency**2, wave))

   contains

      !> The bounds hold another part of the curve.
      subroutine take(part)
         real(wp), intent(in) :: part(2, 3)  !! (2, 3) its bounds [any]

         integer :: i

         if (is_empty) then
            f = part
         else
            do i = 1, 3
               f(:, i) = hull(f(:, i), part(:, i))
            end do
         end if
         is_empty = .false.
      end subroutine take

      !> The pieces over an interval; the first and the last continue beyond their ends.
      subroutine take_segments(range)
         real(wp), intent(in) :: range(2)  !! (2) the interval [any]

         real(wp) :: part(2)
         integer :: high, k, low

         low = segment_of(curve, range(1))
         high = segment_of(curve, range(2))
         do k = low, high
            part = range
            if (k > low) part(1) = curve%x(k)
            if (k < high) part(2) = curve%x(k + 1)
            call take(bounds_of_segment(curve, k, part))
         end do
      end subroutine take_segments

      !> A part on one side of the places: constant, or straight.
      subroutine take_outside(a, b)
         real(wp), intent(in) :: a  !! its start [any]
         real(wp), intent(in) :: b  !! its end [any]

         real(wp) :: at_a(3), at_b(3)
         real(wp) :: part(2, 3)

         if (curve%beyond == beyond_error) return
         call polynomial_values(a, at_a)
         call polynomial_values(b, at_b)
         part(:, 1) = [min(at_a(1), at_b(1)), max(at_a(1), at_b(1))]
         part(:, 2) = merge(0.0_wp, at_a(2), curve%beyond == beyond_stabilisation)
         part(:, 3) = 0.0_wp
         call take(part)
      end subroutine take_outside

      !> Values of the curve without its wave.
      subroutine polynomial_values(place, values)
         real(wp), intent(in) :: place      !! where [any]
         real(wp), intent(out) :: values(3) !! (3) p, p', p'' [any]

         real(wp) :: turn

         call curve_values(curve, place, values)
         if (.not. abs(curve%amplitude) > 0.0_wp) return
         turn = curve%angular_frequency*place + curve%phase
         values(1) = values(1) - curve%amplitude*sin(turn)
         values(2) = values(2) - curve%amplitude*curve%angular_frequency*cos(turn)
      end subroutine polynomial_values

   end subroutine bound_curve

   !> The piece that holds a place: the last one that starts before it, or the first.
   pure integer function segment_of(curve, x) result(low)
      type(curve_t), intent(in) :: curve  !! the curve
      real(wp), intent(in) :: x           !! the place [any]

      integer :: high, middle

      low = 1
      high = size(curve%c, 2) + 1
      do while (high - low > 1)
         middle = (low + high)/2
         if (x >= curve%x(middle)) then
            low = middle
         else
            high = middle
         end if
      end do
   end function segment_of

   !> Bounds of one polynomial over an interval, by Horner's rule.
   pure function bounds_of_segment(curve, segment, x) result(f)
      type(curve_t), intent(in) :: curve  !! the curve
      integer, intent(in) :: segment        !! number of the piece
      real(wp), intent(in) :: x(2)        !! (2) the interval [any]
      real(wp) :: f(2, 3)                 !! (2, 3) bounds of p, p', p'' [any]

      real(wp) :: h(2), s(2, 3)
      integer :: i, m

      h = x - curve%x(segment)
      f = 0.0_wp
      do i = ubound(curve%c, 1), 0, -1
         f(:, 1) = sum_of(product_of(f(:, 1), h), [curve%c(i, segment), curve%c(i, segment)])
         if (i > 0) f(:, 2) = sum_of(product_of(f(:, 2), h), i*[curve%c(i, segment), curve%c(i, segment)])
         if (i > 1) f(:, 3) = sum_of(product_of(f(:, 3), h), i*(i - 1)*[curve%c(i, segment), curve%c(i, segment)])
      end do
      if (.not. allocated(curve%rises)) return
      do m = 1, size(curve%rises)
         associate (rise => curve%rises(m))
            s = bound_rise(rise%law, (x - rise%begin)/rise%length)
            do i = 1, 3
               f(:, i) = sum_of(f(:, i), times(rise%height/rise%length**(i - 1), s(:, i)))
            end do
         end associate
      end do
   end function bounds_of_segment

end module curve_bounds
