!> What a bore that is not round adds to the gaps of a grid, and to its sources.
!>
!> The gap of a cell has one value at each of its edges: where the bore jumps those of two neighbours differ. There the flow that is
!> dragged and the flow that pressure drives are continuous together, with the pressure P_f at the edge. With the conductances a, b
!> of both half cells, and the parts G_-, G_+ of the gap on both sides,
!>
!> flow = s G_f - a b/(a + b) (P_+ - P_-),   G_f = (b G_- + a G_+)/(a + b),   s = 6 (w_J - w_B)
!>
!> so that a step is exact in one dimension. The pressure on the step counts too: P_f (G_+ - G_-), of which the cells have
!>
!> (a P_- + b P_+)/(a + b),   P_f = (a P_- + b P_+)/(a + b) - s (G_+ - G_-)/(a + b), not below zero where films rupture.
!>
!> Source: own derivation; the conductance in series: Patankar (1980), chapter 4.
module bored_gap
   use bore_profile, only: bore_t
   use kinds, only: two_pi, wp
   use reynolds_mesh, only: supply_t
   implicit none (type, external)
   private
   public :: at_left, at_middle, at_right, bored_gap_t, new_bored_gap, with_edges

   integer, parameter :: at_left = 1, at_middle = 2, at_right = 3  !! places in a column
   real(wp), parameter :: same_angle = 1.0e-9_wp                   !! angles that differ by less are equal [rad]

   !> The bore on a grid of m rows and n columns.
   type :: bored_gap_t
      type(bore_t) :: bore                           !! the bore
      logical :: is_there = .false.                  !! it is not round; otherwise nothing below is there
      real(wp), allocatable, private :: g(:, :)      !! (3, n) G without the dam at left, middle and right of a column [1]
      real(wp), allocatable, private :: dam(:)       !! (n) what the dam adds [1]
      logical, allocatable, private :: in_dam(:)     !! (m) rows that the dam reaches over
      real(wp), allocatable :: rise(:, :)            !! (m, n) G_f at the right of a cell less that at its left [1]
      real(wp), allocatable, private :: step(:, :)   !! (m, n) G_+ - G_- at the right of a cell [1]
      real(wp), allocatable, private :: share(:, :)  !! (m, n) a/(a + b) there; below zero: the pressure there is given [1]
      real(wp), allocatable, private :: edge(:, :)   !! (m, n) 1/(a + b) there; where it is given, the pressure [1 or 1/s]
   contains
      procedure :: place
      procedure :: depth
      procedure :: join
      procedure :: step_push
   end type bored_gap_t

contains

   !> Make the workspace.
   subroutine new_bored_gap(self, bore, m, n)
      type(bored_gap_t), intent(out) :: self  !! the bore on the grid
      type(bore_t), intent(in) :: bore        !! the bore, not round
      integer, intent(in) :: m                !! rows
      integer, intent(in) :: n                !! columns

      self%bore = bore
      self%is_there = .true.
      allocate (self%g(3, n), self%dam(n), source=0.0_wp)
      allocate (self%rise(m, n), self%step(m, n), self%share(m, n), self%edge(m, n), source=0.0_wp)
      allocate (self%in_dam(m), source=.false.)
   end subroutine new_bored_gap

   !> Supplies by angle, and between them the edges of the bore: a supply of no length is an edge of columns only.
   pure function with_edges(bore, supply) result(all)
      type(bore_t), intent(in) :: bore             !! the bore
      type(supply_t), intent(in) :: supply(:)      !! (n) the supplies, fixed, by angle
      type(supply_t), allocatable :: all(:)        !! (n and more) both

      real(wp), allocatable :: angle(:)
      real(wp) :: from
      integer :: k, place

      all = supply
      angle = bore%edges()
      do k = 1, size(angle)
         from = 0.0_wp
         if (size(supply) > 0) from = supply(1)%angle - 0.5_wp*supply(1)%width - same_angle
         angle(k) = from + modulo(angle(k) - from, two_pi)
         if (any(distance(all%angle, angle(k)) <= 0.5_wp*all%width + same_angle)) cycle
         place = count(all%angle < angle(k))
         all = [all(:place), supply_t(angle=angle(k), width=0.0_wp, length=0.0_wp), all(place + 1:)]
      end do
   end function with_edges

   !> How far two angles are from one another.
   elemental real(wp) function distance(a, b)
      real(wp), intent(in) :: a, b  !! the angles [rad]

      distance = abs(modulo(a - b + 0.5_wp*two_pi, two_pi) - 0.5_wp*two_pi)
   end function distance

   !> The bore at the columns and rows of a solution.
   pure subroutine place(self, theta, y, per_clearance)
      class(bored_gap_t), intent(inout) :: self   !! the bore on the grid
      real(wp), intent(in) :: theta(0:)           !! (0:n) edges of the columns [rad]
      real(wp), intent(in) :: y(0:)               !! (0:m) edges of the rows [1]
      real(wp), intent(in) :: per_clearance       !! 1/c [1/m]

      real(wp) :: middle
      integer :: j, k

      do k = 1, size(self%dam)
         middle = 0.5_wp*(theta(k - 1) + theta(k))
         self%g(at_left, k) = self%bore%depth_at(theta(k - 1), middle, per_clearance)
         self%g(at_middle, k) = self%bore%depth_at(middle, middle, per_clearance)
         self%g(at_right, k) = self%bore%depth_at(theta(k), middle, per_clearance)
         self%dam(k) = merge(self%bore%dam_depth*per_clearance, 0.0_wp, self%bore%in_dam(middle))
      end do
      do j = 1, size(self%in_dam)
         self%in_dam(j) = 0.5_wp*abs(y(j - 1) + y(j)) < self%bore%dam_length
      end do
      self%rise = 0.0_wp
   end subroutine place

   !> G of a cell, at one of its places.
   pure real(wp) function depth(self, j, k, at) result(g)
      class(bored_gap_t), intent(in) :: self   !! the bore on the grid
      integer, intent(in) :: j, k              !! row and column of the cell
      integer, intent(in) :: at                !! at_left, at_middle or at_right

      g = self%g(at, k)
      if (self%in_dam(j)) g = g + self%dam(k)
   end function depth

   !> The edge between a column and the next one in a row: G_f there, or, where the pressure at the edge is given, G of each side.
   pure subroutine join(self, j, k, next, a, b, is_given, pressure)
      class(bored_gap_t), intent(inout) :: self  !! the bore on the grid
      integer, intent(in) :: j                   !! the row
      integer, intent(in) :: k, next             !! the columns
      real(wp), intent(in) :: a, b               !! conductances of the half cells of both [1]
      logical, intent(in) :: is_given            !! the pressure at the edge is given
      real(wp), intent(in) :: pressure           !! that pressure [1/s]

      real(wp) :: here, there

      here = self%depth(j, k, at_right)
      there = self%depth(j, next, at_left)
      self%step(j, k) = there - here
      self%share(j, k) = merge(-1.0_wp, a/(a + b), is_given)
      self%edge(j, k) = merge(pressure, 1.0_wp/(a + b), is_given)
      if (.not. is_given) then
         here = (b*here + a*there)/(a + b)
         there = here
      end if
      self%rise(j, k) = self%rise(j, k) + here
      self%rise(j, next) = self%rise(j, next) - there
   end subroutine join

   !> What the pressure on the step between two columns adds to that of both cells on their rises.
   pure real(wp) function step_push(self, j, k, p, speed, is_full) result(push)
      class(bored_gap_t), intent(in) :: self  !! the bore on the grid
      integer, intent(in) :: j, k             !! row and column before the step
      real(wp), intent(in) :: p(2)            !! (2) pressures of both cells [1/s]
      real(wp), intent(in) :: speed           !! s times the width of the row [1/s]
      logical, intent(in) :: is_full          !! pressures may be below zero

      real(wp) :: change

      push = 0.0_wp
      associate (step => self%step(j, k), share => self%share(j, k))
         if (.not. abs(step) > 0.0_wp) return
         change = self%edge(j, k)
         if (share >= 0.0_wp) then
            change = -speed*step*self%edge(j, k)
            if (.not. is_full) change = max(change, -(share*p(1) + (1.0_wp - share)*p(2)))
         end if
         push = change*step
      end associate
   end function step_push

end module bored_gap
