!> The outline of a body that has no shapes, by the points that it carries.
!>
!> A line between two points, a polygon through three or more (in the plane their convex hull, in space lines to its centre of mass
!> if they are more than three), the line from its centre of mass to a single point, a block in proportion to the scene where that
!> is the centre of mass.
module body_outline
   use drawing, only: add_stroke, drawing_t, in_both, in_pictures, part_t, round_part, start_part
   use kinds, only: wp
   use rotations, only: axes_across
   use shapes, only: box_part
   implicit none (type, external)
   private
   public :: distinct_points, outline, same_place

   real(wp), parameter :: block_length = 0.13_wp   !! of a body that is one point, of the size of the scene [1]
   real(wp), parameter :: block_height = 0.075_wp  !! the same, across [1]
   real(wp), parameter :: bar = 0.06_wp            !! across a shaft, of the size of the scene [1]
   real(wp), parameter :: parallel = 0.999_wp      !! cosine of an angle of lines that are parallel [1]
   real(wp), parameter :: same_place = 1.0e-6_wp   !! distance of two points that are drawn as one, of the size of the scene [1]

contains

   !> The places of a list of points, each once.
   pure function distinct_points(drawing, first, next) result(s)
      type(drawing_t), intent(in) :: drawing   !! where points are
      integer, intent(in) :: first             !! the first of the list, 0: none
      integer, intent(in) :: next(:)           !! (points) the one after each, 0: none
      real(wp), allocatable :: s(:, :)         !! (3, any) places [m]

      real(wp), allocatable :: all(:, :)
      integer :: j, k, n, pass

      do pass = 1, 2
         n = 0
         k = first
         do while (k > 0)
            if (pass == 1) then
               n = n + 1
            else if (.not. any([(norm2(drawing%s(:, k) - all(:, j)) < same_place*drawing%size, j=1, n)])) then
               n = n + 1
               all(:, n) = drawing%s(:, k)
            end if
            k = next(k)
         end do
         if (pass == 1) allocate (all(3, n))
      end do
      s = all(:, :n)
   end function distinct_points

   !> Outline of a body by its points.
   subroutine outline(drawing, body, s, frame, shaft, part)
      type(drawing_t), intent(in) :: drawing  !! for the size of the scene
      integer, intent(in) :: body             !! the body
      real(wp), intent(in) :: s(:, :)         !! (3, n) places of its points [m]
      real(wp), intent(in) :: frame(3, 3)     !! (3, 3) axes of a block: in which it slides, or zero, and those across [1]
      real(wp), intent(in) :: shaft(3)        !! (3) an axis that it turns about, or zero [1]
      type(part_t), intent(out) :: part       !! the outline

      real(wp), parameter :: centre(3, 1) = 0.0_wp
      real(wp) :: axes(3, 3), half(3)
      integer, allocatable :: hull(:)
      integer :: k, n

      n = size(s, 2)
      if (n == 0) then
         call round_part(part, body, centre(:, 1), reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], [3, 2]), &
                         0.5_wp*block_height*drawing%size)
      else if (n == 1 .and. norm2(s(:, 1)) > same_place*drawing%size) then
         call draw_line(reshape([centre, s], [3, 2]))
      else if (n == 1) then
         axes = axes_across([0.0_wp, 0.0_wp, 1.0_wp])
         if (norm2(frame(:, 1)) > 0.0_wp) axes = frame
         half = 0.5_wp*drawing%size*[block_length, block_height, merge(block_height, 0.0_wp, drawing%is_spatial)]
         call box_part(half, centre(:, 1), axes, body, part)
      else if (n == 2) then
         call draw_line(s)
      else if (n == 3 .or. .not. drawing%is_spatial) then
         call start_part(part, body, s)
         call find_hull(s, drawing%is_spatial, hull)
         if (size(hull) == 2) then
            call add_stroke(part, hull, .false., in_both)
         else
            call add_stroke(part, hull, .true., in_both)
         end if
      else
         call start_part(part, body, reshape([s, centre], [3, n + 1]))
         do k = 1, n
            call add_stroke(part, [k, n + 1], .false., in_both)
         end do
      end if

   contains

      !> A line; of a shaft, which turns about it, pictures show a bar across it, whose turn is seen.
      subroutine draw_line(ends)
         real(wp), intent(in) :: ends(3, 2)   !! (3, 2) its ends [m]

         real(wp) :: across(3, 3), middle(3), way(3)

         way = ends(:, 2) - ends(:, 1)
         if (norm2(shaft) > 0.0_wp .and. abs(dot_product(way, shaft)) > parallel*norm2(way)*norm2(shaft)) then
            across = axes_across(shaft)
            middle = 0.5_wp*(ends(:, 1) + ends(:, 2))
            call start_part(part, body, reshape([ends, middle, middle + bar*drawing%size*across(:, 1)], [3, 4]))
            call add_stroke(part, [3, 4], .false., in_pictures)
         else
            call start_part(part, body, ends)
         end if
         call add_stroke(part, [1, 2], .false., in_both)
      end subroutine draw_line

   end subroutine outline

   !> The convex hull of points in the plane, or three points of space; two points if all lie on a line.
   subroutine find_hull(s, is_spatial, hull)
      real(wp), intent(in) :: s(:, :)                !! (3, n) the points, n at least 3 [m]
      logical, intent(in) :: is_spatial              !! in space
      integer, allocatable, intent(out) :: hull(:)   !! (2 or more) numbers of its corners, counter-clockwise

      real(wp), parameter :: flat = 1.0e-9_wp  ! area of a corner, of the square of the size, that is none [1]
      real(wp) :: area, extent
      integer :: best, k, last

      extent = maxval(maxval(s, dim=2) - minval(s, dim=2))
      if (is_spatial) then
         hull = [1, 2, 3]
         return
      end if
      last = minloc(s(1, :), dim=1)
      allocate (hull(0))
      do while (size(hull) <= size(s, 2))
         hull = [hull, last]
         best = merge(2, 1, last == 1)
         do k = 1, size(s, 2)
            if (k == last .or. k == best) cycle
            area = (s(1, best) - s(1, last))*(s(2, k) - s(2, last)) - (s(2, best) - s(2, last))*(s(1, k) - s(1, last))
            if (area < -flat*extent**2) then
               best = k
            else if (area <= flat*extent**2 .and. norm2(s(:, k) - s(:, last)) > norm2(s(:, best) - s(:, last))) then
               best = k  ! on a line: the farther one
            end if
         end do
         if (best == hull(1)) exit
         last = best
      end do
   end subroutine find_hull

end module body_outline
