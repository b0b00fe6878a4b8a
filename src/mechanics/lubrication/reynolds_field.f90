!> Pressure and gap of a film on a grid at places of one's own: the unwrapped film, for files and pictures.
!>
!> p = (mu R^2/c^2) P, h = c (1 + G - (e + y g).u); P between the middles of cells by bilinear interpolation, zero at the ends of
!> the bearing, mirrored where the grid has half the length. So it is second order as the grid is, and what the cells have they
!> keep.
module reynolds_field
   use kinds, only: two_pi, wp
   use reynolds_grid, only: reynolds_grid_t
   implicit none (type, external)
   private
   public :: film_field

contains

   !> Pressures and gaps of the solution that the grid holds.
   pure subroutine film_field(grid, theta, y, p, h)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      real(wp), intent(in) :: theta(:)           !! (n) angles, bearing's frame [rad]
      real(wp), intent(in) :: y(:)               !! (m) places along it, from -1 at one end to 1 at the other [1]
      real(wp), intent(out) :: p(:, :)           !! (m, n) P [1/s]
      real(wp), intent(out) :: h(:, :)           !! (m, n) gap over c [1]

      real(wp) :: along, around, left(2), right(2)
      integer :: j, k, next, row, column

      do k = 1, size(theta)
         call column_at(grid, theta(k), column, around)
         next = modulo(column, grid%film%n) + 1
         do j = 1, size(y)
            row = row_at(grid, y(j))
            left = pressure_pair(grid, row, column)
            right = pressure_pair(grid, row, next)
            along = (folded(grid, y(j)) - middle_of(grid, row))/(middle_of(grid, row + 1) - middle_of(grid, row))
            p(j, k) = (1.0_wp - around)*((1.0_wp - along)*left(1) + along*left(2)) &
                      + around*((1.0_wp - along)*right(1) + along*right(2))
            h(j, k) = 1.0_wp - dot_product(grid%state%e + y(j)*grid%state%g, [cos(theta(k)), sin(theta(k))])
            if (grid%bored%is_there) h(j, k) = h(j, k) + bore_depth(grid, theta(k), y(j))
         end do
      end do
   end subroutine film_field

   !> What the bore adds to the gap at a place; where it jumps, what it has behind it.
   pure real(wp) function bore_depth(grid, theta, y) result(depth)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      real(wp), intent(in) :: theta              !! the angle [rad]
      real(wp), intent(in) :: y                  !! the place along it [1]

      associate (bore => grid%bored%bore, part => grid%state%per_clearance)
         depth = bore%depth_at(theta, theta, part)
         if (bore%in_dam(theta) .and. abs(y) <= bore%dam_length) depth = depth + part*bore%dam_depth
      end associate
   end function bore_depth

   !> The column whose middle is the last before an angle, and how far the angle is on the way to the next.
   pure subroutine column_at(grid, theta, column, share)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      real(wp), intent(in) :: theta              !! the angle [rad]
      integer, intent(out) :: column             !! the column
      real(wp), intent(out) :: share             !! part of the way [1]

      real(wp) :: first, turned, width
      integer :: n

      n = grid%film%n
      first = 0.5_wp*(grid%theta(0) + grid%theta(1))
      turned = first + modulo(theta - first, two_pi)
      column = n
      do while (column > 1)
         if (0.5_wp*(grid%theta(column - 1) + grid%theta(column)) <= turned) exit
         column = column - 1
      end do
      associate (own => 0.5_wp*(grid%theta(column - 1) + grid%theta(column)))
         if (column == n) then
            width = first + two_pi - own
         else
            width = 0.5_wp*(grid%theta(column + 1) - grid%theta(column - 1))
         end if
         share = (turned - own)/width
      end associate
   end subroutine column_at

   !> A place along the bearing where the grid has rows.
   pure real(wp) function folded(grid, y)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      real(wp), intent(in) :: y                  !! the place, -1 to 1 [1]

      folded = merge(y, abs(y), grid%is_whole)
   end function folded

   !> The row whose middle is the last before a place; 0: none.
   pure integer function row_at(grid, y) result(row)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      real(wp), intent(in) :: y                  !! the place, -1 to 1 [1]

      row = grid%film%m
      do while (row > 0)
         if (middle_of(grid, row) <= folded(grid, y)) exit
         row = row - 1
      end do
   end function row_at

   !> Middle of a row; of row 0 and of the one behind the last: the ends, or the mirror of the first.
   pure real(wp) function middle_of(grid, row) result(y)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      integer, intent(in) :: row                 !! the row, 0 to m + 1

      if (row > grid%film%m) then
         y = 1.0_wp
      else if (row > 0) then
         y = 0.5_wp*(grid%y(row - 1) + grid%y(row))
      else if (grid%is_whole) then
         y = -1.0_wp
      else
         y = -0.5_wp*(grid%y(0) + grid%y(1))
      end if
   end function middle_of

   !> Pressures of a row and of the next.
   pure function pressure_pair(grid, row, column) result(p)
      type(reynolds_grid_t), intent(in) :: grid  !! the grid
      integer, intent(in) :: row                 !! the row, 0 to m
      integer, intent(in) :: column              !! the column
      real(wp) :: p(2)                           !! (2) pressures [1/s]

      p = 0.0_wp
      if (row > 0) p(1) = grid%film%p(row, column)
      if (row == 0 .and. .not. grid%is_whole) p(1) = grid%film%p(1, column)
      if (row < grid%film%m) p(2) = grid%film%p(row + 1, column)
   end function pressure_pair

end module reynolds_field
