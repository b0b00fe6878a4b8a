!> Where the cells of a lubricant film lie: columns around the bearing, rows along it.
!>
!> Columns are graded towards the minimum film, at the angle gamma of the eccentricity: at phi = theta - gamma in [-pi, pi] they are
!> as wide as sqrt(phi^2 + d^2) says, from the wide gap down to the length d of the minimum film,
!>
!> s(phi) = asinh(k phi/pi)/asinh(k),   k = 3 eps/sqrt(1 - eps^2),   equal steps of s,
!>
!> and rows towards the ends, over the shorter of the bearing's length and that of the film, s(1 - y) with k = 0.2 (L/D)/sqrt(1 -
!> eps^2). Both change smoothly with the eccentricity. Supplies cut ring and length into sections whose number of cells is fixed
!> at set-up: so edges of supplies are edges of cells wherever the minimum film is. Limits: supplies lie in the middle of the
!> length.
module reynolds_mesh
   use kinds, only: pi, two_pi, wp
   implicit none (type, external)
   private
   public :: divide_length, divide_ring, new_length, new_ring, section_list_t, supply_t

   real(wp), parameter :: ring_grading = 3.0_wp    !! k of the columns over eps/sqrt(1 - eps^2) [1]
   real(wp), parameter :: length_grading = 0.2_wp  !! k of the rows over (L/D)/sqrt(1 - eps^2) [1]
   real(wp), parameter :: min_grading = 1.0e-6_wp  !! below it cells are as good as equal [1]

   !> Where lubricant comes in: a groove along the bearing, or a hole (as wide as long), in the middle of the length.
   type :: supply_t
      real(wp) :: angle = 0.0_wp            !! of its middle, in the bearing's frame [rad]
      real(wp) :: width = 0.0_wp            !! around the bearing; 0: a line [rad]
      real(wp) :: length = 1.0_wp           !! part of the bearing's length that it takes; 1: all of it; 0: an edge only [1]
      real(wp) :: pressure = 0.0_wp         !! p c^2/(mu R^2), not below zero [1/s]
      logical :: is_at_widest_gap = .false. !! the line lies where the gap is widest, whatever the angle says
   end type supply_t

   !> Sections of a ring or of a length, each with a number of cells.
   type :: section_list_t
      logical :: is_turning = .false.      !! the ring starts at the widest gap, wherever that is
      integer :: line = 0                  !! supply along the widest gap beside others that are fixed, 0: none
      real(wp), allocatable :: start(:)    !! (n + 1) ends of the sections, an angle or a part of the half length [rad or 1]
      integer, allocatable :: n_cell(:)    !! (n) cells of each, may be none
      integer, allocatable :: supply(:)    !! (n) supply that the section is part of, 0: none
   end type section_list_t

contains

   !> Sections of the ring; the fixed supplies are in the order of their angles and do not overlap.
   pure subroutine new_ring(self, n_cell, supply)
      type(section_list_t), intent(out) :: self  !! the sections
      integer, intent(in) :: n_cell              !! cells all round, about
      type(supply_t), intent(in) :: supply(:)    !! the supplies

      integer, allocatable :: number(:)
      real(wp) :: free, next
      integer :: k, line, n

      number = pack([(k, k=1, size(supply))], .not. supply%is_at_widest_gap)
      n = size(number)
      line = findloc(supply%is_at_widest_gap, .true., dim=1)
      self%is_turning = n == 0
      if (self%is_turning) then
         self%start = [-pi, -pi, pi]
         self%n_cell = [0, n_cell]
         self%supply = [line, 0]
         return
      end if
      self%line = line
      allocate (self%start(2*n + 1), self%n_cell(2*n), self%supply(2*n))
      do k = 1, n
         associate (own => supply(number(k)), other => supply(number(modulo(k, n) + 1)))
            next = other%angle - 0.5_wp*other%width
            if (k == n) next = next + two_pi
            self%start(2*k - 1) = own%angle - 0.5_wp*own%width
            self%start(2*k) = own%angle + 0.5_wp*own%width
            self%start(2*k + 1) = next
            self%supply(2*k - 1:2*k) = [number(k), 0]
            self%n_cell(2*k - 1) = 0
            if (own%width > 0.0_wp) self%n_cell(2*k - 1) = max(2, nint(n_cell*own%width/two_pi))
            free = next - self%start(2*k)
            self%n_cell(2*k) = max(4, nint(n_cell*free/two_pi))
         end associate
      end do
   end subroutine new_ring

   !> Sections of the half length, from the middle on.
   pure subroutine new_length(self, n_cell, length)
      type(section_list_t), intent(out) :: self  !! the sections
      integer, intent(in) :: n_cell              !! cells of the half length, about
      real(wp), intent(in) :: length(:)          !! (n) parts of the length that supplies and a dam take [1]

      real(wp) :: from, next
      integer :: k

      self%start = [0.0_wp]
      allocate (self%n_cell(0), self%supply(0))
      from = 0.0_wp
      do while (from < 1.0_wp)
         next = 1.0_wp
         do k = 1, size(length)
            if (length(k) > from) next = min(next, length(k))
         end do
         self%start = [self%start, next]
         self%n_cell = [self%n_cell, max(2, nint(n_cell*(next - from)))]
         self%supply = [self%supply, 0]
         from = next
      end do
   end subroutine new_length

   !> Edges of the columns. A line along the widest gap beside fixed supplies has half of the cells of its section on each side, so
   !> that the grid changes smoothly where the line moves; within a supply there is none.
   pure subroutine divide_ring(ring, eps, gamma, edge, line)
      type(section_list_t), intent(in) :: ring   !! sections of the ring
      real(wp), intent(in) :: eps                !! eccentricity ratio, below 1 [1]
      real(wp), intent(in) :: gamma              !! its direction, bearing's frame [rad]
      real(wp), contiguous, intent(out) :: edge(0:) !! (0:n) edges, ascending, the last a turn after the first [rad]
      integer, intent(out) :: line               !! column behind such a line, 0: none

      real(wp) :: first, k, last, middle, turn
      integer :: i, done, half, j

      k = ring_grading*eps/sqrt((1.0_wp - eps)*(1.0_wp + eps))
      done = 0
      line = 0
      turn = merge(0.0_wp, gamma, ring%is_turning)
      do i = 1, size(ring%n_cell)
         if (ring%n_cell(i) == 0) cycle
         first = graded_turn(ring%start(i) - turn, k)
         last = graded_turn(ring%start(i + 1) - turn, k)
         half = ring%n_cell(i)/2
         if (ring%line > 0 .and. ring%supply(i) == 0 .and. next_widest(first) < last) then
            middle = next_widest(first)
            line = done + half + 1
         else
            middle = first + (last - first)*real(half, wp)/real(ring%n_cell(i), wp)
         end if
         do j = 0, half - 1
            edge(done + j) = gamma + angle_of_turn(first + (middle - first)*real(j, wp)/real(half, wp), k)
         end do
         do j = half, ring%n_cell(i) - 1
            edge(done + j) = gamma + angle_of_turn(middle + (last - middle)*real(j - half, wp)/real(ring%n_cell(i) - half, wp), k)
         end do
         done = done + ring%n_cell(i)
      end do
      edge(done) = edge(0) + two_pi
   end subroutine divide_ring

   !> The first widest gap behind a graded coordinate: an odd number.
   elemental real(wp) function next_widest(s)
      real(wp), intent(in) :: s  !! graded coordinate [1]

      next_widest = real(2*floor(0.5_wp*(s + 1.0_wp)) + 1, wp)
   end function next_widest

   !> Edges of the rows of the half length.
   pure subroutine divide_length(length, ratio, eps, edge)
      type(section_list_t), intent(in) :: length    !! sections of the half length
      real(wp), intent(in) :: ratio                 !! L/D [1]
      real(wp), intent(in) :: eps                   !! eccentricity ratio, below 1 [1]
      real(wp), contiguous, intent(out) :: edge(0:) !! (0:n) edges, from 0 in the middle to 1 at the end [1]

      real(wp) :: first, k, last
      integer :: i, done, j

      k = length_grading*ratio/sqrt((1.0_wp - eps)*(1.0_wp + eps))
      done = 0
      do i = 1, size(length%n_cell)
         first = graded(1.0_wp - length%start(i), k)
         last = graded(1.0_wp - length%start(i + 1), k)
         do j = 0, length%n_cell(i) - 1
            edge(done + j) = 1.0_wp - ungraded(first + (last - first)*real(j, wp)/real(length%n_cell(i), wp), k)
         end do
         done = done + length%n_cell(i)
      end do
      edge(done) = 1.0_wp
   end subroutine divide_length

   !> The odd function that takes [-1, 1] to itself and is steep at zero.
   elemental real(wp) function graded(x, k)
      real(wp), intent(in) :: x  !! from -1 to 1 [1]
      real(wp), intent(in) :: k  !! how steep, not below 0 [1]

      graded = x
      if (k > min_grading) graded = asinh(k*x)/asinh(k)
   end function graded

   !> Its inverse.
   elemental real(wp) function ungraded(s, k)
      real(wp), intent(in) :: s  !! from -1 to 1 [1]
      real(wp), intent(in) :: k  !! how steep, not below 0 [1]

      ungraded = s
      if (k > min_grading) ungraded = sinh(asinh(k)*s)/k
   end function ungraded

   !> Graded coordinate of an angle; it grows by 2 in a turn.
   elemental real(wp) function graded_turn(phi, k)
      real(wp), intent(in) :: phi  !! angle from the minimum film [rad]
      real(wp), intent(in) :: k    !! how steep [1]

      real(wp) :: turns

      turns = real(nint(phi/two_pi), wp)
      graded_turn = 2.0_wp*turns + graded(phi/pi - 2.0_wp*turns, k)
   end function graded_turn

   !> Angle of a graded coordinate.
   elemental real(wp) function angle_of_turn(s, k)
      real(wp), intent(in) :: s  !! graded coordinate [1]
      real(wp), intent(in) :: k  !! how steep [1]

      real(wp) :: turns

      turns = real(nint(0.5_wp*s), wp)
      angle_of_turn = two_pi*turns + pi*ungraded(s - 2.0_wp*turns, k)
   end function angle_of_turn

end module reynolds_mesh
