!> The bracket around one extreme of a number: three instants, the middle one beyond the others or not, and the instant at which the
!> parabola through them has its vertex.
!>
!> Source: successive parabolic interpolation (Brent, Algorithms for Minimization without Derivatives, 1973, ch. 5).
module peak_bracket
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: bracket_t, find_bends

   real(wp), parameter, public :: gain = 1.0e-11_wp  !! rise at which the search ends, over the extreme [1]
   real(wp), parameter :: at_row = 1.0e-9_wp   !! minimum distance from a row, of that between rows [1]
   integer, parameter, public :: most_output_times = 6  !! instants looked at for one extreme

   !> The search for one extreme of a number times its sign.
   type :: bracket_t
      integer :: of = 0                       !! which number is looked at
      integer :: sign = 1                     !! by which its values are multiplied: 1 for a maximum, -1 for a minimum
      integer :: n = 0                        !! instants looked at
      real(wp) :: t(3) = 0.0_wp               !! (3) instants [s]
      real(wp) :: f(3) = 0.0_wp               !! (3) values times the sign [any]
      real(wp) :: at = 0.0_wp                 !! instant asked for [s]
   contains
      procedure :: begin => begin_bracket
      procedure :: propose
      procedure :: narrow
   end type bracket_t

contains

   !> Kind of vertex that the parabola through three rows has between them, see `propose`.
   pure subroutine find_bends(n, t, x1, x2, x3, bends)
      integer, intent(in) :: n                     !! numbers
      real(wp), intent(in) :: t(3)                 !! (3) times of the rows, increasing [s]
      real(wp), intent(in) :: x1(n), x2(n), x3(n)  !! (n) numbers there, all finite [any]
      integer, intent(inout) :: bends(n)           !! (n) 1: maximum, -1: minimum, 0: no vertex between them

      real(wp) :: a, b, bend, slope, towards
      integer :: k

      a = t(2) - t(1)
      b = t(3) - t(2)
      do k = 1, n  ! without branches, so that it is done for several numbers at once
         bend = 2.0_wp*((x2(k) - x1(k))/a - (x3(k) - x2(k))/b)
         towards = sign(1.0_wp, bend)
         slope = towards*((x2(k) - x1(k))*b/a + (x3(k) - x2(k))*a/b)
         towards = merge(towards, 0.0_wp, slope > -a*abs(bend))
         bends(k) = int(merge(towards, 0.0_wp, slope < b*abs(bend)))
      end do
   end subroutine find_bends

   !> Start the search for one extreme.
   pure subroutine begin_bracket(self, of, sign, t, x)
      class(bracket_t), intent(inout) :: self  !! the bracket
      integer, intent(in) :: of                !! which number
      integer, intent(in) :: sign              !! 1: its maximum, -1: its minimum
      real(wp), intent(in) :: t(3)             !! (3) times of three rows, increasing [s]
      real(wp), intent(in) :: x(3)             !! (3) the number there [any]

      self%of = of
      self%sign = sign
      self%n = 0
      self%t = t
      self%f = sign*x
   end subroutine begin_bracket

   !> The vertex of the parabola through a bracket, if it lies between rows and above the extreme so far.
   pure subroutine propose(self, best, noise, is_there)
      class(bracket_t), intent(inout) :: self    !! the bracket; the instant is set
      real(wp), intent(in) :: best               !! the extreme so far, times the sign [any]
      real(wp), intent(in) :: noise              !! a rise that is round-off [any]
      logical, intent(out) :: is_there           !! it is

      real(wp) :: a, b, bend, slope, top, way

      is_there = .false.
      a = self%t(2) - self%t(1)
      b = self%t(3) - self%t(2)
      if (.not. min(a, b) > 0.0_wp) return  ! no closer in the digits of time
      slope = ((self%f(2) - self%f(1))*b/a + (self%f(3) - self%f(2))*a/b)/(a + b)
      bend = 2.0_wp*((self%f(2) - self%f(1))/a - (self%f(3) - self%f(2))/b)/(a + b)
      if (.not. bend > 0.0_wp) return
      way = slope/bend
      top = self%f(2) + 0.5_wp*slope*way
      if (.not. top > best + max(gain*max(abs(best), abs(top)), noise)) return
      if (abs(way) <= at_row*(a + b) .or. way <= -(1.0_wp - at_row)*a .or. way >= (1.0_wp - at_row)*b) return
      self%at = self%t(2) + way
      is_there = .true.
   end subroutine propose

   !> Take the value at the instant that was asked for: the bracket becomes narrower.
   pure subroutine narrow(self, f)
      class(bracket_t), intent(inout) :: self   !! the bracket
      real(wp), intent(in) :: f                 !! the value times the sign [any]

      if (self%at < self%t(2) .and. f >= self%f(2)) then
         self%t = [self%t(1), self%at, self%t(2)]
         self%f = [self%f(1), f, self%f(2)]
      else if (self%at < self%t(2)) then
         self%t(1) = self%at
         self%f(1) = f
      else if (f >= self%f(2)) then
         self%t = [self%t(2), self%at, self%t(3)]
         self%f = [self%f(2), f, self%f(3)]
      else
         self%t(3) = self%at
         self%f(3) = f
      end if
   end subroutine narrow

end module peak_bracket
