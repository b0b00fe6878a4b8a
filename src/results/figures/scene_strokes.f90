!> A mechanism as strokes in a picture: bodies, joints by their symbols, clearance joints magnified, forces as arrows.
!>
!> Each style has lines `x y colour` for gnuplot, polylines apart by a blank line. A round joint with clearance is a bearing with a
!> journal in it, in its size where that is larger than the symbol; the eccentricity is magnified by one factor for all. In the
!> plane a journal in its size has a diameter that shows its turn.
!> The ground is hatched where joints stand on it.
module scene_strokes
   use drawing, only: drawing_t, in_files, mark_bearing, mark_damper, mark_link, mark_pin, mark_plane, mark_slide, &
      mark_slot, mark_spring, mark_t
   use frames, only: frame_t
   use kinds, only: wp
   use rotations, only: axes_across
   use scene_canvas, only: add_disc, add_line, add_ring, bearing_size, canvas_t, pin_size, style_arrow, style_body, style_ground, &
      style_hole, style_journal, style_line, style_pin, style_symbol, symbols_t
   use scene_colours, only: body_colour, dark, red
   use scene_views, only: projected, view_t
   implicit none (type, external)
   private
   public :: arrow_at, draw_scene

   real(wp), parameter :: seen_aside = 0.1_wp      !! of a plane's normal in the view, below which it is observed from above [1]
   real(wp), parameter :: arm_size = 0.035_wp      !! half length of the arm of a cross, of the size of the scene [1]
   real(wp), parameter :: arrow_size = 0.25_wp     !! of the maximum force, of that size [1]

contains

   !> Draw a frame in a view.
   subroutine draw_scene(drawing, frame, view, symbols, paleness, with_marks, canvas)
      type(drawing_t), intent(in) :: drawing       !! the scene
      type(frame_t), intent(in) :: frame           !! where it is
      type(view_t), intent(in) :: view             !! from where it is seen
      type(symbols_t), intent(in) :: symbols       !! scales
      real(wp), intent(in) :: paleness             !! of bodies: 0: as they are, 1: white [1]
      logical, intent(in) :: with_marks            !! joints and forces too
      type(canvas_t), intent(inout) :: canvas      !! gets lines

      integer :: k

      do k = 1, drawing%n_part
         call draw_part(k)
      end do
      if (.not. with_marks) return
      do k = 1, drawing%n_mark
         call draw_mark(drawing%marks(k), k, frame, view, symbols, canvas)
      end do

   contains

      !> An outline.
      subroutine draw_part(number)
         integer, intent(in) :: number  !! of the part

         real(wp), allocatable :: p(:, :)
         integer :: colour, i, j

         associate (part => drawing%parts(number))
            colour = body_colour(part%body, paleness)
            do j = 1, size(part%strokes)
               if (part%strokes(j)%use == in_files) cycle
               associate (vertices => part%strokes(j)%vertices)
                  allocate (p(2, size(vertices)))
                  do i = 1, size(vertices)
                     p(:, i) = projected(view, frame%r(:, part%body) + matmul(frame%a(:, :, part%body), part%s(:, vertices(i))))
                  end do
               end associate
               if (part%strokes(j)%is_face) then
                  if (paleness <= 0.0_wp) call add_line(canvas, style_body, symbols, p, colour)
                  call add_line(canvas, style_line, symbols, reshape([p, p(:, 1)], [2, size(p, 2) + 1]), colour)
               else
                  call add_line(canvas, style_line, symbols, p, colour)
               end if
               deallocate (p)
            end do
         end associate
      end subroutine draw_part

   end subroutine draw_scene

   !> A joint or element.
   subroutine draw_mark(mark, number, frame, view, symbols, canvas)
      type(mark_t), intent(in) :: mark             !! the joint
      integer, intent(in) :: number                !! its number
      type(frame_t), intent(in) :: frame           !! where it is
      type(view_t), intent(in) :: view             !! from where it is seen
      type(symbols_t), intent(in) :: symbols       !! scales
      type(canvas_t), intent(inout) :: canvas      !! gets lines

      real(wp) :: axis(2), e(2), p(2, 2), radius, way(2), x(3, 2)
      integer :: k, clearance_joints

      clearance_joints = symbols%clearance_joints(number)
      way = symbols%ways(:, number)
      do k = 1, 2
         x(:, k) = frame%r(:, mark%body(k)) + matmul(frame%a(:, :, mark%body(k)), mark%s(:, k))
         p(:, k) = projected(view, x(:, k))
      end do
      radius = pin_size*symbols%size
      select case (mark%kind)
      case (mark_pin)
         if (any(mark%body == 0)) call draw_support(canvas, symbols, p(:, merge(1, 2, mark%body(1) == 0)))
         call add_disc(canvas, style_pin, symbols, p(:, 2), radius)
         if (norm2(mark%axis_j) > 0.0_wp) then  ! arms of a cross
            call draw_arm(canvas, symbols, view, x(:, 2), matmul(frame%a(:, :, mark%body(1)), mark%axis))
            call draw_arm(canvas, symbols, view, x(:, 2), matmul(frame%a(:, :, mark%body(2)), mark%axis_j))
         end if
      case (mark_link)
         if (any(mark%body == 0)) call draw_support(canvas, symbols, p(:, merge(1, 2, mark%body(1) == 0)))
         call add_line(canvas, style_symbol, symbols, p, dark)
         call add_disc(canvas, style_pin, symbols, p(:, 1), radius)
         call add_disc(canvas, style_pin, symbols, p(:, 2), radius)
      case (mark_spring, mark_damper)
         do k = 1, 2
            if (mark%body(k) == 0) call draw_wall(canvas, symbols, p(:, k), p(:, 3 - k), 2.0_wp*symbols%coils(number))
         end do
         if (mark%kind == mark_spring) call draw_spring(canvas, symbols, p, symbols%coils(number), symbols%bends(number))
         if (mark%kind == mark_damper) call draw_damper(canvas, symbols, p, symbols%coils(number))
      case (mark_plane)
         x(:, 2) = matmul(frame%a(:, :, mark%body(1)), mark%axis)
         axis = projected(view, x(:, 1) + x(:, 2)) - p(:, 1)
         if (.not. norm2(axis) > seen_aside) return  ! observed from above, or nearly
         axis = [axis(2), -axis(1)]/norm2(axis)
         call draw_hatch(canvas, symbols, p(:, 1) + (way(1) - 0.2_wp*symbols%size)*axis, &
                         p(:, 1) + (way(2) + 0.2_wp*symbols%size)*axis)
      case (mark_slide)
         x(:, 2) = matmul(frame%a(:, :, mark%body(1)), mark%axis)
         axis = projected(view, x(:, 1) + x(:, 2)) - p(:, 1)
         if (norm2(axis) > 0.1_wp) call draw_guide(canvas, symbols, p(:, 1), axis, way, symbols%walls(:, number), &
                                                mark%body(1) == 0)
      case (mark_slot)
         axis = projected(view, x(:, 1) + matmul(frame%a(:, :, mark%body(1)), mark%axis)) - p(:, 1)
         call draw_slot(canvas, symbols, p, axis, way, symbols%walls(1, number), mark%body(2) == 0)
      case (mark_bearing)
         if (any(mark%body == 0)) call draw_support(canvas, symbols, p(:, merge(1, 2, mark%body(1) == 0)))
         e = 0.0_wp
         if (clearance_joints > 0) e = projected(view, frame%e(:, clearance_joints)) - view%shift
         call draw_bearing(canvas, symbols, mark, frame, view, symbols%bearings(:, number), p(:, 1), symbols%magnified*e)
      end select
      call draw_arrow(canvas, symbols, p(:, 2), projected(view, arrow_at(symbols, frame, number)) - view%shift)
   end subroutine draw_mark

   !> A bearing and its journal. In space, in their size, across their axis, else facing the eye.
   subroutine draw_bearing(canvas, symbols, mark, frame, view, radii, p, e)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      type(mark_t), intent(in) :: mark         !! the joint
      type(frame_t), intent(in) :: frame       !! where it is
      type(view_t), intent(in) :: view         !! from where it is seen
      real(wp), intent(in) :: radii(2)         !! (2) of hole and journal, as drawn [m]
      real(wp), intent(in) :: p(2)             !! (2) centre of the hole [m]
      real(wp), intent(in) :: e(2)             !! (2) from there to that of the journal [m]

      real(wp) :: across(3, 3), half(2, 2)
      integer :: k
      logical :: has_size

      half = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
      has_size = mark%radius > bearing_size*symbols%size
      if (has_size .and. norm2(mark%axis) > 0.0_wp) then
         across = matmul(frame%a(:, :, mark%body(1)), axes_across(mark%axis))
         do k = 1, 2
            half(:, k) = projected(view, across(:, k)) - view%shift
         end do
      end if
      call add_ring(canvas, style_hole, symbols, p, radii(1)*half)
      call add_ring(canvas, style_journal, symbols, p + e, radii(2)*half)
      if (.not. (has_size .and. symbols%is_planar)) return
      half(:, 1) = radii(2)*frame%a(:2, 1, mark%body(2))
      call add_line(canvas, style_journal, symbols, reshape([p + e - half(:, 1), p + e + half(:, 1)], [2, 2]), dark)
   end subroutine draw_bearing

   !> An arm of a cross.
   subroutine draw_arm(canvas, symbols, view, x, way)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      type(view_t), intent(in) :: view         !! from where it is seen
      real(wp), intent(in) :: x(3)             !! (3) the middle of the cross, world frame [m]
      real(wp), intent(in) :: way(3)           !! (3) direction of the arm, world frame [1]

      real(wp) :: half(3)

      half = arm_size*symbols%size*way/norm2(way)
      call add_line(canvas, style_symbol, symbols, reshape([projected(view, x - half), projected(view, x + half)], [2, 2]), dark)
   end subroutine draw_arm

   !> The arrow of the force at a mark, from the second point of the mark; zero if none is drawn.
   pure function arrow_at(symbols, frame, number) result(way)
      type(symbols_t), intent(in) :: symbols   !! which joint or load a mark is
      type(frame_t), intent(in) :: frame       !! forces
      integer, intent(in) :: number            !! the mark
      real(wp) :: way(3)                       !! (3) world frame [m]

      way = 0.0_wp
      if (.not. symbols%force > 0.0_wp) return
      if (symbols%clearance_joints(number) > 0) then
         way = frame%f(:, symbols%clearance_joints(number))
      else if (symbols%load(number) > 0) then
         way = frame%load(:, symbols%load(number))
      end if
      way = way*arrow_size*symbols%size/symbols%force
   end function arrow_at

   !> Hatching where a joint stands on the ground.
   subroutine draw_support(canvas, symbols, p)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2)             !! (2) the joint [m]

      real(wp) :: base(2), h

      h = 0.035_wp*symbols%size
      base = p - [0.0_wp, 1.5_wp*h]
      call add_line(canvas, style_ground, symbols, reshape([base - [h, 0.0_wp], p, base + [h, 0.0_wp]], [2, 3]), dark)
      call draw_hatch(canvas, symbols, base - [1.5_wp*h, 0.0_wp], base + [1.5_wp*h, 0.0_wp])
   end subroutine draw_support

   !> A line with hatching to its right, observed from its first end.
   subroutine draw_hatch(canvas, symbols, from, to)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: from(2)          !! (2) first end [m]
      real(wp), intent(in) :: to(2)            !! (2) second end [m]

      real(wp) :: along(2), at(2), back(2), step
      integer :: k, n

      call add_line(canvas, style_ground, symbols, reshape([from, to], [2, 2]), dark)
      step = min(0.018_wp*symbols%size, 0.25_wp*norm2(to - from))
      n = max(1, nint(norm2(to - from)/step))
      if (.not. norm2(to - from) > 0.0_wp) return
      along = (to - from)/norm2(to - from)
      back = step*[along(2), -along(1)] - step*along
      do k = 1, n
         at = from + (to - from)*real(k, wp)/real(n, wp)
         call add_line(canvas, style_ground, symbols, reshape([at, at + back], [2, 2]), dark)
      end do
   end subroutine draw_hatch

   !> Both sides of a guide, hatched if it is the ground's.
   subroutine draw_guide(canvas, symbols, p, axis, way, walls, is_ground)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2)             !! (2) point of the guide [m]
      real(wp), intent(in) :: axis(2)          !! (2) its axis in the view, at most of length 1 [1]
      real(wp), intent(in) :: way(2)           !! (2) places of the slider along the axis [m]
      real(wp), intent(in) :: walls(2)         !! (2) from its line to its walls: on the side of R90 axis, and on the other [m]
      logical, intent(in) :: is_ground         !! it is fixed

      real(wp) :: across(2), ends(2, 2), reach
      integer :: side

      reach = 0.09_wp*symbols%size
      ends(:, 1) = p + (way(1) - reach)*axis
      ends(:, 2) = p + (way(2) + reach)*axis
      do side = -1, 1, 2
         across = real(side, wp)*walls(merge(1, 2, side > 0))*[-axis(2), axis(1)]/norm2(axis)
         if (.not. is_ground) then
            call add_line(canvas, style_symbol, symbols, reshape([ends(:, 1) + across, ends(:, 2) + across], [2, 2]), dark)
         else if (side < 0) then
            call draw_hatch(canvas, symbols, ends(:, 1) + across, ends(:, 2) + across)
         else
            call draw_hatch(canvas, symbols, ends(:, 2) + across, ends(:, 1) + across)
         end if
      end do
   end subroutine draw_guide

   !> A pin in a slot: the outline of the slot over the way of the pin.
   subroutine draw_slot(canvas, symbols, p, axis, way, half, is_fixed)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2, 2)          !! (2, 2) point of its line, and the pin [m]
      real(wp), intent(in) :: axis(2)          !! (2) direction of the slot [1]
      real(wp), intent(in) :: way(2)           !! (2) minimum and maximum place of the pin along it [m]
      real(wp), intent(in) :: half             !! half its width [m]
      logical, intent(in) :: is_fixed          !! the pin stands on the ground

      real(wp) :: across(2), ends(2, 2)

      if (is_fixed) call draw_support(canvas, symbols, p(:, 2))
      across = half*[-axis(2), axis(1)]
      ends(:, 1) = p(:, 1) + (way(1) - 2.0_wp*half)*axis
      ends(:, 2) = p(:, 1) + (way(2) + 2.0_wp*half)*axis
      call add_line(canvas, style_symbol, symbols, reshape([ends(:, 1) + across, ends(:, 2) + across, ends(:, 2) - across, &
                                                       ends(:, 1) - across, ends(:, 1) + across], [2, 5]), dark)
      call add_disc(canvas, style_pin, symbols, p(:, 2), pin_size*symbols%size)
   end subroutine draw_slot

   !> A spring between two points.
   subroutine draw_spring(canvas, symbols, p, coil, n)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2, 2)          !! (2, 2) its ends [m]
      real(wp), intent(in) :: coil             !! half its width [m]
      integer, intent(in) :: n                 !! corners of its zigzag

      real(wp) :: across(2), q(2, 0:n + 1)
      integer :: k

      across = p(:, 2) - p(:, 1)
      if (.not. norm2(across) > 0.0_wp) return
      across = coil*[-across(2), across(1)]/norm2(across)
      q(:, 0) = p(:, 1)
      q(:, n + 1) = p(:, 2)
      do k = 1, n
         q(:, k) = p(:, 1) + (p(:, 2) - p(:, 1))*(0.15_wp + 0.7_wp*real(k - 1, wp)/real(n - 1, wp))
         if (k > 1 .and. k < n) q(:, k) = q(:, k) + real(2*mod(k, 2) - 1, wp)*across
      end do
      call add_line(canvas, style_symbol, symbols, q, dark)
   end subroutine draw_spring

   !> A damper or actuator between two points: a piston in a cylinder.
   subroutine draw_damper(canvas, symbols, p, half)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2, 2)          !! (2, 2) its ends [m]
      real(wp), intent(in) :: half             !! half its width [m]

      real(wp), parameter :: bottom = 0.25_wp, head = 0.55_wp, mouth = 0.75_wp  ! places along it [1]
      real(wp) :: across(2), along(2), ends(2, 2)

      along = p(:, 2) - p(:, 1)
      if (.not. norm2(along) > 0.0_wp) return
      across = half*[-along(2), along(1)]/norm2(along)
      call add_line(canvas, style_symbol, symbols, reshape([p(:, 1), p(:, 1) + bottom*along], [2, 2]), dark)
      ends = reshape([p(:, 1) + bottom*along, p(:, 1) + mouth*along], [2, 2])
      call add_line(canvas, style_symbol, symbols, reshape([ends(:, 2) + across, ends(:, 1) + across, ends(:, 1) - across, &
                                                       ends(:, 2) - across], [2, 4]), dark)
      across = 0.8_wp*across
      ends = reshape([p(:, 1) + head*along + across, p(:, 1) + head*along - across], [2, 2])
      call add_line(canvas, style_symbol, symbols, ends, dark)
      call add_line(canvas, style_symbol, symbols, reshape([p(:, 1) + head*along, p(:, 2)], [2, 2]), dark)
   end subroutine draw_damper

   !> A wall across the line from a point that is fixed to another, hatched behind.
   subroutine draw_wall(canvas, symbols, p, other, half)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: p(2)             !! (2) the fixed point [m]
      real(wp), intent(in) :: other(2)         !! (2) the other one [m]
      real(wp), intent(in) :: half             !! half its width [m]

      real(wp) :: across(2)

      if (.not. norm2(other - p) > 0.0_wp) return
      across = other - p
      across = half*[across(2), -across(1)]/norm2(across)
      call draw_hatch(canvas, symbols, p - across, p + across)
   end subroutine draw_wall

   !> A force.
   subroutine draw_arrow(canvas, symbols, from, way)
      type(canvas_t), intent(inout) :: canvas  !! gets lines
      type(symbols_t), intent(in) :: symbols   !! scales
      real(wp), intent(in) :: from(2)          !! (2) where it acts [m]
      real(wp), intent(in) :: way(2)           !! (2) from there to its tip [m]

      real(wp) :: back(2), head, side(2), tip(2)

      if (norm2(way) < 1.0e-3_wp*symbols%size) return
      tip = from + way
      head = min(0.03_wp*symbols%size, 0.5_wp*norm2(way))
      back = -head*way/norm2(way)
      side = 0.4_wp*[-back(2), back(1)]
      call add_line(canvas, style_arrow, symbols, reshape([from, tip, tip + back + side, tip, tip + back - side], [2, 5]), red)
   end subroutine draw_arrow

end module scene_strokes
