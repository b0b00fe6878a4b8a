!> The worn surface of a joint, as a run reports it: what each cell of its circumference has lost, and the depths that follow.
!>
!> A cell of the width w that has lost the volume V has the mean area A = V/(L w) of its section per angle, and the depth
!>
!> h = sqrt(R^2 + 2 A) - R of a hole,   h = r - sqrt(r^2 - 2 A) of a pin
!>
!> so that L/2 w ((R + h)^2 - R^2), of a pin L/2 w (r^2 - (r - h)^2), is the volume of the cell to round-off.
!> Depths between cells are those of a smooth curve with these means, so that a maximum is not that of a cell.
!> Signs: h is not negative; angles in the frame of the body that carries the surface, counter-clockwise from its x axis.
!> Limits: a pin that is worn through has the depth of its radius (`is_through`).
module worn_surface
   use kinds, only: pi, wp
   implicit none (type, external)
   private
   public :: worn_surface_t

   !> A worn surface of a joint.
   type :: worn_surface_t
      character(:), allocatable :: joint     !! name of the joint
      character(:), allocatable :: side      !! bearing or journal
      logical :: is_hole = .true.            !! it is a hole, whose radius grows; else a pin
      real(wp) :: radius = 0.0_wp            !! of the new surface [m]
      real(wp) :: length = 0.0_wp            !! along the axis [m]
      real(wp) :: distance = 0.0_wp          !! that the surfaces have slid on each other [m]
      real(wp), allocatable :: volume(:)     !! (cells) what each has lost [m^3]
      real(wp), allocatable :: loads(:, :)   !! (6, nodes) of a bearing, see `wear_loads`; unallocated: unknown [m, rad, 1, m^3]
   contains
      procedure :: angle => angle_of_cell
      procedure :: depths => depths_of_cells
      procedure :: max_depth => surface_max_depth
      procedure :: arc => worn_arc
      procedure :: is_through
   end type worn_surface_t

contains

   !> Direction of the middle of a cell.
   elemental real(wp) function angle_of_cell(self, cell) result(angle)
      class(worn_surface_t), intent(in) :: self   !! the surface
      integer, intent(in) :: cell                 !! number of the cell

      angle = 2.0_wp*pi*(cell - 0.5_wp)/size(self%volume)
   end function angle_of_cell

   !> Depths of the cells.
   pure function depths_of_cells(self) result(depths)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp) :: depths(size(self%volume))       !! (cells) h [m]

      depths = 2.0_wp*areas(self)
      if (self%is_hole) then
         depths = depths/(sqrt(self%radius**2 + depths) + self%radius)
      else
         depths = min(depths/(sqrt(max(self%radius**2 - depths, 0.0_wp)) + self%radius), self%radius)
      end if
   end function depths_of_cells

   !> Maximum depth and where it is: of the parabola whose means over the deepest cell and the two beside it are their depths.
   pure subroutine surface_max_depth(self, depth, angle)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp), intent(out) :: depth              !! h [m]
      real(wp), intent(out) :: angle              !! where, -pi to pi [rad]

      real(wp) :: bend, depths(size(self%volume)), off, slope
      integer :: cell, n

      n = size(self%volume)
      depths = self%depths()
      cell = maxloc(depths, dim=1)
      depth = depths(cell)
      off = 0.0_wp
      if (n > 2) then
         associate (before => depths(modulo(cell - 2, n) + 1), after => depths(modulo(cell, n) + 1))
            slope = 0.5_wp*(after - before)
            bend = before - 2.0_wp*depth + after
            if (bend < -epsilon(1.0_wp)*depth) then
               off = -slope/bend
               depth = depth - bend/24.0_wp + 0.5_wp*slope*off
            end if
         end associate
      end if
      angle = self%angle(cell) + off*2.0_wp*pi/n
      if (angle > pi) angle = angle - 2.0_wp*pi
   end subroutine surface_max_depth

   !> Angle of all that has lost something, full, at the centre of the surface. Each stretch of worn cells ends within the two outer
   !> cells of its sides, where the areas of the next cells come to zero: the outer ones are worn by elastic overlap, too. Where
   !> these do not come to zero there, it ends in the outer cell, which they would give its area.
   pure real(wp) function worn_arc(self) result(arc)
      class(worn_surface_t), intent(in) :: self   !! the surface

      real(wp) :: area(size(self%volume))
      integer :: first, k, last, n, start

      n = size(area)
      area = areas(self)
      arc = 2.0_wp*pi
      start = findloc(area > 0.0_wp, .false., dim=1)
      if (start == 0) return
      area = cshift(area, start)   ! the last cell is new now
      arc = 0.0_wp
      last = 0
      do
         first = last + findloc(area(last + 1:) > 0.0_wp, .true., dim=1)
         if (first == last) return
         last = first
         do k = first + 1, n
            if (.not. area(k) > 0.0_wp) exit
            last = k
         end do
         arc = arc + 2.0_wp*pi/n*width_of(area(first:last))
         last = last + 1
      end do
   end function worn_arc

   !> Width of a stretch of worn cells, in cells.
   pure real(wp) function width_of(area) result(width)
      real(wp), intent(in) :: area(:)   !! (n) areas of its cells, positive [m^2]

      integer :: n

      n = size(area)
      width = n
      if (n > 2) width = n - 2 + part_of_outer(area(1), area(2:n - 1)) + part_of_outer(area(n), area(n - 1:2:-1))
   end function width_of

   !> Part of an outer cell that is worn, of the next one too if negative: to where pairs of the six cells behind these two come to
   !> zero.
   pure real(wp) function part_of_outer(outer, inner) result(part)
      real(wp), intent(in) :: outer      !! area of the outer cell [m^2]
      real(wp), intent(in) :: inner(:)   !! (n) those of the cells beside it, from the outer cell on [m^2]

      if (size(inner) > 8) then
         part = 2.0_wp*end_of(0.5_wp*(inner(2:6:2) + inner(3:7:2)), 1.0_wp, huge(1.0_wp)) - 1.0_wp
         if (part < 1.0_wp) return
      end if
      part = end_of(inner(:min(size(inner), 3)), 1.0_wp, outer)
   end function part_of_outer

   !> Where areas come to zero, or have a given sum: by the polynomial whose means are those of up to three cells.
   pure real(wp) function end_of(inner, farthest, most) result(place)
      real(wp), intent(in) :: inner(:)   !! (1 to 3) areas of the cells, from the outermost of them on [m^2]
      real(wp), intent(in) :: farthest   !! greatest distance from their outer face, in cells [1]
      real(wp), intent(in) :: most       !! the sum, in areas of one cell [m^2]

      integer, parameter :: halvings = 50
      real(wp) :: c(0:2), high, low
      integer :: i

      ! value c0 + c1 u + c2 u^2 at the distance u of cells from their outer face, outward
      c = [inner(1), 0.0_wp, 0.0_wp]
      if (size(inner) == 2) c = [1.5_wp*inner(1) - 0.5_wp*inner(2), inner(1) - inner(2), 0.0_wp]
      if (size(inner) > 2) c = [(11.0_wp*inner(1) - 7.0_wp*inner(2) + 2.0_wp*inner(3))/6.0_wp, &
                                2.0_wp*inner(1) - 3.0_wp*inner(2) + inner(3), 0.5_wp*(inner(1) - 2.0_wp*inner(2) + inner(3))]
      low = 0.0_wp
      high = farthest
      if (c(0) + high*(c(1) + high*c(2)) > 0.0_wp .and. high*(c(0) + high*(0.5_wp*c(1) + high*c(2)/3.0_wp)) < most) low = high
      do i = 1, halvings
         place = 0.5_wp*(low + high)
         if (c(0) + place*(c(1) + place*c(2)) > 0.0_wp .and. place*(c(0) + place*(0.5_wp*c(1) + place*c(2)/3.0_wp)) < most) then
            low = place
         else
            high = place
         end if
      end do
   end function end_of

   !> Whether a pin has lost all there was of it somewhere.
   pure logical function is_through(self)
      class(worn_surface_t), intent(in) :: self   !! the surface

      is_through = .not. self%is_hole .and. any(2.0_wp*areas(self) >= self%radius**2)
   end function is_through

   !> Mean areas A of the cells.
   pure function areas(self)
      class(worn_surface_t), intent(in) :: self   !! the surface
      real(wp) :: areas(size(self%volume))        !! (cells) per angle [m^2]

      areas = self%volume*(size(self%volume)/(2.0_wp*pi*self%length))
   end function areas

end module worn_surface
