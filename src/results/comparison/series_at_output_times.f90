!> A time history at other instants than those of its own rows, as its numbers allow.
!>
!> What continues smoothly is brought there by the polynomial through six rows, which are all on the same side of a row without a
!> number; how far that is from the one through five reports what it may add. An angle that jumps by a turn is unwound before. A
!> state keeps the value of the row before.
!>
!> Limits: between a row with a number and one without, and between two rows with different states, it is not known when the change
!> took place: such an instant is not settled.
module series_at_output_times
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: not_a_number, wp
   implicit none (type, external)
   private
   public :: smooth_at, state_at, unwind

   real(wp), parameter :: same = 1.0e-9_wp   !! of the distance of two rows: it is the row itself [1]

contains

   !> Values of a smooth history at other instants, and what the polynomial may add.
   pure subroutine smooth_at(t, x, times, values, is_settled, worst)
      real(wp), intent(in) :: t(:)                !! (n) instants of the rows, rising, at least two [s]
      real(wp), intent(in) :: x(:)                !! (n) values [any]
      real(wp), intent(in) :: times(:)            !! (m) instants requested, within the others [s]
      real(wp), intent(out) :: values(:)          !! (m) the values; NaN: there is none [any]
      logical, intent(out) :: is_settled(:)       !! (m) whether it is known that there is one, or none
      real(wp), intent(out) :: worst              !! maximum difference to the polynomial through five [any]

      real(wp) :: fewer
      integer :: begins(size(t)), ends(size(t)), first, i, k, n, near

      call find_stretches(x, begins, ends)
      worst = 0.0_wp
      k = 1
      do i = 1, size(times)
         k = row_before(t, times(i), k)
         near = 0
         if (abs(times(i) - t(k + 1)) <= same*(t(k + 1) - t(k))) near = k + 1
         if (abs(times(i) - t(k)) <= same*(t(k + 1) - t(k))) near = k
         values(i) = not_a_number()
         if (near > 0) then
            is_settled(i) = .true.
            if (.not. ieee_is_finite(x(near))) cycle
         else
            is_settled(i) = ieee_is_finite(x(k)) .eqv. ieee_is_finite(x(k + 1))
            if (.not. (ieee_is_finite(x(k)) .and. ieee_is_finite(x(k + 1)))) cycle
            near = k
         end if
         n = min(6, ends(near) - begins(near) + 1)
         first = max(begins(near), min(k - 2, ends(near) - n + 1))
         values(i) = lagrange(t(first:first + n - 1), x(first:first + n - 1), times(i))
         if (n < 3) cycle
         if (minval(abs(t(first:first + n - 1) - times(i))) <= same*(t(first + n - 1) - t(first))) cycle
         fewer = lagrange(t(first:first + n - 2), x(first:first + n - 2), times(i))
         if (ieee_is_finite(fewer) .and. ieee_is_finite(values(i))) worst = max(worst, abs(values(i) - fewer))
      end do
   end subroutine smooth_at

   !> Values of a state at other instants: those of the row before.
   pure subroutine state_at(t, x, times, values, is_settled)
      real(wp), intent(in) :: t(:)                !! (n) instants of the rows, not falling, at least two [s]
      real(wp), intent(in) :: x(:)                !! (n) states [any]
      real(wp), intent(in) :: times(:)            !! (m) instants requested, within the others [s]
      real(wp), intent(out) :: values(:)          !! (m) the states [any]
      logical, intent(out) :: is_settled(:)       !! (m) whether the rows on both sides agree, or those at the instant itself

      real(wp) :: near
      integer :: first, i, k, last

      near = same*(t(size(t)) - t(1))/real(size(t) - 1, wp)
      k = 1
      do i = 1, size(times)
         k = row_before(t, times(i), k)
         first = k
         last = k + 1
         if (times(i) - t(k) <= near) then          ! at a row, or at several
            last = k
         else if (t(k + 1) - times(i) <= near) then
            first = k + 1
         end if
         do while (last < size(t))
            if (t(last + 1) > times(i) + near) exit
            last = last + 1
         end do
         do while (first > 1)
            if (t(first - 1) < times(i) - near) exit
            first = first - 1
         end do
         values(i) = x(first)
         if (all(ieee_is_finite(x(first:last)))) then
            is_settled(i) = maxval(x(first:last)) <= minval(x(first:last))
         else
            is_settled(i) = .not. any(ieee_is_finite(x(first:last)))
         end if
      end do
   end subroutine state_at

   !> Take the jumps by a turn out of a history, if it stays within one: each value is brought next to the last one before it.
   pure subroutine unwind(x, turn)
      real(wp), intent(inout) :: x(:)   !! (n) values, some of them perhaps no numbers [any]
      real(wp), intent(in) :: turn      !! what it jumps by [any]

      real(wp), parameter :: slack = 1.0e-9_wp   ! of a turn: round-off at both ends [1]
      real(wp) :: before, turns
      integer :: k

      if (.not. any(ieee_is_finite(x))) return
      if (maxval(x, mask=ieee_is_finite(x)) - minval(x, mask=ieee_is_finite(x)) > (1.0_wp + slack)*turn) return
      before = not_a_number()
      do k = 1, size(x)
         if (.not. ieee_is_finite(x(k))) cycle
         turns = 0.0_wp
         if (ieee_is_finite(before)) turns = anint((before - x(k))/turn)
         x(k) = x(k) + turn*turns
         before = x(k)
      end do
   end subroutine unwind

   !> The last row that is not after an instant; of all rows the last but one at most.
   pure integer function row_before(t, time, guess) result(k)
      real(wp), intent(in) :: t(:)     !! (n) instants of the rows [s]
      real(wp), intent(in) :: time     !! the instant [s]
      integer, intent(in) :: guess     !! where to start

      k = guess
      if (k > 1) then
         if (time < t(k)) k = 1
      end if
      do while (k < size(t) - 1)
         if (time < t(k + 1)) exit
         k = k + 1
      end do
   end function row_before

   !> First and last row of the stretch of numbers in which each row lies; a row without a number is in none.
   pure subroutine find_stretches(x, begins, ends)
      real(wp), intent(in) :: x(:)         !! (n) values [any]
      integer, intent(out) :: begins(:)    !! (n) the first rows
      integer, intent(out) :: ends(:)      !! (n) the last rows

      integer :: k

      begins = [(k, k=1, size(x))]
      ends = begins
      do k = 2, size(x)
         if (ieee_is_finite(x(k - 1))) begins(k) = begins(k - 1)
      end do
      do k = size(x) - 1, 1, -1
         if (ieee_is_finite(x(k + 1))) ends(k) = ends(k + 1)
      end do
   end subroutine find_stretches

   !> The polynomial through some points.
   pure real(wp) function lagrange(t, x, at) result(value)
      real(wp), intent(in) :: t(:)    !! (n) abscissas [s]
      real(wp), intent(in) :: x(:)    !! (n) values [any]
      real(wp), intent(in) :: at      !! where it is requested [s]

      real(wp) :: weight
      integer :: i, k

      do k = 1, size(t)
         if (abs(at - t(k)) <= 0.0_wp) then
            value = x(k)
            return
         end if
      end do
      value = 0.0_wp
      do k = 1, size(t)
         weight = 1.0_wp
         do i = 1, size(t)
            if (i /= k) weight = weight*(at - t(i))/(t(k) - t(i))
         end do
         value = value + weight*x(k)
      end do
   end function lagrange

end module series_at_output_times
