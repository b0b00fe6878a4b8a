!> What a scene looks like, from its tables.
!>
!> A body has the rows of [shapes] that name it. One without is drawn by the points that it carries (`body_outline`). Columns
!> `radius`, `radius_i` and `radius_j` of a row that ties two points are circles about them, of discs and gears, in space across
!> their axes; of loose joints in space they are balls.
!>
!> A joint is a mark at its two points: what it leaves of the freedom says which; a row whose points are apart at the start is a
!> link, of a force a spring, or a damper where nothing is elastic in it. A force at one point is a mark there. Rows that name
!> joints (drivers) are not drawn.
module scene_drawing
   use drawing, only: add_mark, add_part, add_stroke, drawing_t, in_files, mark_bearing, mark_damper, mark_guide, mark_link, &
      mark_load, mark_pin, mark_plane, mark_slide, mark_spring, mark_t, part_t, round_part, start_part
   use body_outline, only: distinct_points, outline, same_place
   use item, only: find_place, item_t, place_of
   use kind_info, only: kind_info_t, leaves_angles, leaves_more, leaves_turn, leaves_way
   use kinds, only: wp
   use rotations, only: axes_across, rotation_about, rotation_of_parameters
   use scene, only: scene_t, table_shapes, table_t
   use scene_size, only: extent_of_scene, size_of_bodies, start_position
   use shapes, only: part_of_shape, sphere_part
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: drawing_of_scene, own_point

contains

   !> Outlines of all bodies, marks of all joints, and the points.
   subroutine drawing_of_scene(scene, drawing)
      type(scene_t), intent(in) :: scene         !! the scene
      type(drawing_t), intent(out) :: drawing    !! what it looks like

      logical :: has_part(0:scene%bodies%n)
      integer :: k

      drawing%is_spatial = scene%settings%is_spatial
      drawing%size = extent_of_scene(scene)
      if (.not. drawing%size > 0.0_wp) drawing%size = max(size_of_bodies(scene), tiny(1.0_wp))
      drawing%points = scene%points%names
      drawing%body = scene%points%body
      allocate (drawing%s(3, scene%points%n))
      do k = 1, scene%points%n
         drawing%s(:, k) = own_point(scene, k)
      end do
      has_part = .false.
      call add_shapes(scene, drawing, has_part)
      call add_rounds(scene, scene%joints, .false., drawing, has_part)
      call add_rounds(scene, scene%clearances, drawing%is_spatial, drawing, has_part)
      call add_outlines(scene, drawing, has_part)
      call add_marks(scene, scene%joints, .false., drawing)
      call add_marks(scene, scene%clearances, .false., drawing)
      call add_marks(scene, scene%forces, .true., drawing)
   end subroutine drawing_of_scene

   !> A point of the deck in its body's own frame.
   pure function own_point(scene, point) result(own)
      type(scene_t), intent(in) :: scene  !! the scene
      integer, intent(in) :: point        !! the point
      real(wp) :: own(3)                  !! (3) where it is [m]

      own = scene%points%s(:, point)
      if (scene%settings%is_spatial) own = matmul(scene%bodies%spatial%own(:, :, scene%points%body(point)), own)
   end function own_point

   !> The rows of [shapes].
   subroutine add_shapes(scene, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(inout) :: has_part(0:)        !! (0:bodies) whether a body has one

      type(part_t) :: part
      integer :: k

      associate (items => scene%tables%base(table_shapes)%items)
         do k = 1, size(items)
            call part_of_shape(items(k), scene%settings%is_spatial, part)
            call add_part(drawing, part)
            has_part(part%body) = .true.
         end do
      end associate
   end subroutine add_shapes

   !> Circles of discs and gears, and balls, of bodies without shapes.
   subroutine add_rounds(scene, tables, are_balls, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      type(table_t), intent(in) :: tables(:)        !! (kinds) joints, or joints with clearance
      logical, intent(in) :: are_balls              !! they are round all over
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(inout) :: has_part(0:)        !! (0:bodies) whether a body has one

      character(*), parameter :: columns(3) = [character(8) :: "radius_i", "radius_j", "radius"]
      integer, parameter :: ends(3) = [1, 2, 2]
      logical :: had_part(0:scene%bodies%n)
      type(part_t) :: part
      real(wp) :: axes(3, 3)
      type(tie_t) :: tie
      integer :: c, i, k, place

      had_part = has_part
      do k = 1, size(tables)
         do i = 1, size(tables(k)%items)
            tie = tie_of(scene, tables(k)%info, tables(k)%items(i))
            do c = 1, size(columns)
               place = find_place(tables(k)%items(i), trim(columns(c)))
               if (place == 0 .or. tie%n < 2 .or. tie%by_joint .or. tables(k)%info%leaves /= leaves_more) cycle
               associate (body => tie%body(ends(c)), point => tie%point(ends(c)), &
                          radius => abs(tables(k)%items(i)%values(place)%number))
                  if (point == 0 .or. body == 0 .or. had_part(body)) cycle
                  if (are_balls) then
                     call sphere_part(radius, drawing%s(:, point), scene%settings%is_spatial, body, part)
                  else
                     axes = axes_across(turning_axis(scene, tables(k)%items(i), tie, ends(c)))
                     call round_part(part, body, drawing%s(:, point), axes(:, :2), radius)
                  end if
                  call add_part(drawing, part)
                  if (norm2(drawing%s(:, point)) < same_place*drawing%size) has_part(body) = .true.
               end associate
            end do
         end do
      end do
   end subroutine add_rounds

   !> The axis that a disc or gear of a row turns about, own frame of its body: z of the plane; in space the axis of its end, which,
   !> left out, is parallel to that of i where the deck puts the bodies.
   pure function turning_axis(scene, item, tie, end) result(axis)
      type(scene_t), intent(in) :: scene  !! the scene
      type(item_t), intent(in) :: item    !! the row
      type(tie_t), intent(in) :: tie      !! what it ties
      integer, intent(in) :: end          !! which end, 1 or 2
      real(wp) :: axis(3)                 !! (3) direction [1]

      axis = [0.0_wp, 0.0_wp, 1.0_wp]
      if (.not. scene%settings%is_spatial .or. find_place(item, "axis_j") == 0) return
      if (end == 2) axis = item%direction("axis_j")
      if (end == 2 .and. norm2(axis) > 0.0_wp) return
      axis = item%direction("axis_i")
      if (end == 2) axis = matmul(matmul(start_frame(scene, tie%body(1)), axis), start_frame(scene, tie%body(2)))
   end function turning_axis

   !> Outlines of bodies that have no part, by their points.
   subroutine add_outlines(scene, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(in) :: has_part(0:)           !! (0:bodies) whether a body has one

      type(part_t) :: part
      real(wp) :: frames(3, 3, scene%bodies%n), half(3, scene%bodies%n)
      integer, allocatable :: first(:), next(:)
      integer :: body, k

      call find_ways(scene, frames, half)
      allocate (first(0:scene%bodies%n), next(scene%points%n), source=0)
      do k = scene%points%n, 1, -1  ! lists of the points of each body, in the order of the deck
         next(k) = first(scene%points%body(k))
         first(scene%points%body(k)) = k
      end do
      do body = 1, scene%bodies%n
         if (has_part(body)) cycle
         call outline(drawing, body, distinct_points(drawing, first(body), next), frames(:, :, body), half(:, body), part)
         call add_part(drawing, part)
      end do
   end subroutine add_outlines

   !> Axes of bodies that slide, in their own frames, the first in which they do, and half the sides of loose ones along them; zero
   !> of those that do not.
   subroutine find_ways(scene, frames, half)
      type(scene_t), intent(in) :: scene         !! the scene
      real(wp), intent(out) :: frames(:, :, :)   !! (3, 3, bodies) axes [1]
      real(wp), intent(out) :: half(:, :)        !! (3, bodies) half the sides, as loose guides have them [m]

      frames = 0.0_wp
      half = 0.0_wp
      call look(scene%joints)
      call look(scene%clearances)

   contains

      !> Directions that the rows of some kinds give.
      subroutine look(tables)
         type(table_t), intent(in) :: tables(:)   !! kinds

         type(tie_t) :: tie
         real(wp) :: axis(3)
         integer :: i, k

         do k = 1, size(tables)
            do i = 1, size(tables(k)%items)
               axis = axis_of(tables(k)%items(i))
               tie = tie_of(scene, tables(k)%info, tables(k)%items(i))
               if (.not. norm2(axis) > 0.0_wp .or. tie%n < 2 .or. tie%by_joint .or. tie%body(2) == 0) cycle
               if (tables(k)%info%leaves /= leaves_way .and. find_place(tables(k)%items(i), "slider") == 0) cycle
               associate (item => tables(k)%items(i), frame => frames(:, :, tie%body(2)), sides => half(:, tie%body(2)))
                  call find_frame(scene, item, tie, axis, frame)
                  if (find_place(item, "slider") == 0) cycle
                  sides = 0.5_wp*[item%number("length"), item%number("height"), 0.0_wp]
                  if (find_place(item, "width_axis") > 0) sides(2:3) = 0.5_wp*[item%number("width"), item%number("height")]
               end associate
            end do
         end do
      end subroutine look

   end subroutine find_ways

   !> The axes of what slides in body j, own frame: along the guide, across it in the direction of the width of a block, and across
   !> both. In space they are those of the guide where the deck puts the bodies, but for an axis of its own.
   subroutine find_frame(scene, item, tie, axis, frame)
      type(scene_t), intent(in) :: scene      !! the scene
      type(item_t), intent(in) :: item        !! the row
      type(tie_t), intent(in) :: tie          !! what it ties
      real(wp), intent(in) :: axis(3)         !! (3) of the guide, own frame of body i [1]
      real(wp), intent(out) :: frame(3, 3)    !! (3, 3) axes as columns [1]

      real(wp) :: to_j(3, 3), x(3), z(3)

      to_j = matmul(transpose(start_frame(scene, tie%body(2))), start_frame(scene, tie%body(1)))
      z = matmul(to_j, axis)
      if (find_place(item, "slider_axis") > 0) z = direction_in_plane(item%word("slider_axis"), item%number("slider_angle"))
      if (.not. scene%settings%is_spatial) then
         frame = reshape([z, -z(2), z(1), 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
         return
      end if
      frame = axes_across(axis)
      x = frame(:, 1)
      if (find_place(item, "width_axis") > 0) then
         if (norm2(item%direction("axis_j")) > 0.0_wp) z = item%direction("axis_j")/norm2(item%direction("axis_j"))
         if (norm2(item%direction("width_axis")) > 0.0_wp) x = item%direction("width_axis")
      end if
      x = matmul(to_j, x)
      x = x - dot_product(x, z)*z
      if (.not. norm2(x) > same_place) x = matmul(to_j, frame(:, 2)) - dot_product(matmul(to_j, frame(:, 2)), z)*z
      x = x/norm2(x)
      frame = reshape([z, x, z(2)*x(3) - z(3)*x(2), z(3)*x(1) - z(1)*x(3), z(1)*x(2) - z(2)*x(1)], [3, 3])
   end subroutine find_frame

   !> The direction that a row names in the own frame of body i: its columns `axis_i`, or `axis` and `axis_angle`; else zero.
   pure function axis_of(item) result(axis)
      type(item_t), intent(in) :: item  !! the row
      real(wp) :: axis(3)               !! (3) direction [1]

      axis = 0.0_wp
      if (find_place(item, "axis_i") > 0) then
         axis = item%direction("axis_i")
      else if (find_place(item, "axis") > 0 .and. find_place(item, "axis_angle") > 0) then
         axis = direction_in_plane(item%word("axis"), item%number("axis_angle"))
      end if
      if (norm2(axis) > 0.0_wp) axis = axis/norm2(axis)
   end function axis_of

   !> An axis of a body of the plane, turned.
   pure function direction_in_plane(name, angle) result(axis)
      character(*), intent(in) :: name   !! x or y
      real(wp), intent(in) :: angle      !! by which it is turned, counter-clockwise [rad]
      real(wp) :: axis(3)                !! (3) direction [1]

      axis = [cos(angle), sin(angle), 0.0_wp]
      if (name == "y") axis = [-sin(angle), cos(angle), 0.0_wp]
   end function direction_in_plane

   !> Orientation of a body's own frame where the deck puts it.
   pure function start_frame(scene, body) result(a)
      type(scene_t), intent(in) :: scene  !! the scene
      integer, intent(in) :: body         !! the body, 0: ground
      real(wp) :: a(3, 3)                 !! (3, 3) own frame to the world's [1]

      a = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      if (body == 0) return
      if (scene%settings%is_spatial) then
         a = matmul(rotation_of_parameters(scene%bodies%spatial%p(:, body)), transpose(scene%bodies%spatial%own(:, :, body)))
      else
         a = rotation_about([0.0_wp, 0.0_wp, 1.0_wp], scene%bodies%angle(body))
      end if
   end function start_frame

   !> Marks of the rows of some kinds.
   subroutine add_marks(scene, tables, are_forces, drawing)
      type(scene_t), intent(in) :: scene           !! the scene
      type(table_t), intent(in) :: tables(:)       !! (kinds) joints, joints with clearance or forces
      logical, intent(in) :: are_forces            !! they are forces
      type(drawing_t), intent(inout) :: drawing    !! gets marks

      type(mark_t) :: mark
      type(tie_t) :: tie
      integer :: end, i, k

      do k = 1, size(tables)
         do i = 1, size(tables(k)%items)
            associate (item => tables(k)%items(i), info => tables(k)%info)
               tie = tie_of(scene, info, item)
               if (are_forces .and. tie%n == 1) call add_load(item, tie, drawing)
               if (tie%n < 2 .or. tie%by_joint .or. all(tie%point == 0) .or. info%is_start_only) cycle
               mark = mark_t()
               mark%name = item%name
               mark%body = tie%body
               do end = 1, 2
                  if (tie%point(end) > 0) mark%s(:, end) = drawing%s(:, tie%point(end))
               end do
               mark%axis = axis_of(item)
               mark%kind = kind_of_mark(scene, info, item, tie, are_forces, same_place*drawing%size)
               if (mark%kind == mark_bearing) then
                  mark%radius = item%number("bearing_radius")
                  mark%clearance = item%number("clearance")
                  call add_bearing(mark, drawing)
               else if (mark%kind == mark_slide) then
                  call measure_slide(scene, item, tie, mark)
               end if
               if (mark%kind > 0) call add_mark(drawing, mark)
            end associate
         end do
      end do
   end subroutine add_marks

   !> A force at a point.
   subroutine add_load(item, tie, drawing)
      type(item_t), intent(in) :: item             !! the row
      type(tie_t), intent(in) :: tie               !! what it ties
      type(drawing_t), intent(inout) :: drawing    !! gets a mark, if the row names a point

      type(mark_t) :: mark

      if (tie%point(1) == 0) return
      mark%kind = mark_load
      mark%name = item%name
      mark%body = tie%body(1)
      mark%s = spread(drawing%s(:, tie%point(1)), 2, 2)
      call add_mark(drawing, mark)
   end subroutine add_load

   !> Gaps, length and direction of what slides in a loose guide; nothing of one that is not loose.
   subroutine measure_slide(scene, item, tie, mark)
      type(scene_t), intent(in) :: scene         !! the scene
      type(item_t), intent(in) :: item           !! the row
      type(tie_t), intent(in) :: tie             !! what it ties
      type(mark_t), intent(inout) :: mark        !! the joint, with its axis

      if (find_place(item, "gap") == 0 .or. find_place(item, "length") == 0) return
      if (item%word("level") == "ideal") return
      mark%half_length = 0.5_wp*item%number("length")
      mark%gaps = item%number("gap")
      if (find_place(item, "slider_axis") > 0) then
         if (item%number("gap_upper") > 0.0_wp) mark%gaps(1) = item%number("gap_upper")
         if (item%number("gap_lower") > 0.0_wp) mark%gaps(2) = item%number("gap_lower")
         mark%axis_j = direction_in_plane(item%word("slider_axis"), item%number("slider_angle"))
      else
         mark%axis_j = item%direction("axis_j")
         if (norm2(mark%axis_j) > 0.0_wp) return
         mark%axis_j = matmul(matmul(start_frame(scene, tie%body(1)), mark%axis), start_frame(scene, tie%body(2)))
      end if
   end subroutine measure_slide

   !> Hole and journal of a loose joint, in their size: circles across its axis, for files.
   subroutine add_bearing(mark, drawing)
      type(mark_t), intent(in) :: mark             !! the joint; axes of journal and hole are drawn along one direction
      type(drawing_t), intent(inout) :: drawing    !! gets two parts

      type(part_t) :: part, round
      real(wp) :: axes(3, 3)
      integer :: k

      axes = axes_across([0.0_wp, 0.0_wp, 1.0_wp])
      if (norm2(mark%axis) > 0.0_wp) axes = axes_across(mark%axis)
      do k = 1, 2
         call round_part(round, mark%body(k), mark%s(:, k), axes(:, :2), mark%radius - merge(0.0_wp, mark%clearance, k == 1))
         call start_part(part, mark%body(k), round%s)
         call add_stroke(part, [round%strokes(1)%vertices, 1], .false., in_files)
         call add_part(drawing, part)
      end do
   end subroutine add_bearing

   !> How a row that ties two points is drawn, 0: not at all.
   integer function kind_of_mark(scene, info, item, tie, is_force, near) result(kind)
      type(scene_t), intent(in) :: scene      !! the scene
      type(kind_info_t), intent(in) :: info   !! kind of the row
      type(item_t), intent(in) :: item        !! the row
      type(tie_t), intent(in) :: tie          !! what it ties
      logical, intent(in) :: is_force         !! it is a force
      real(wp), intent(in) :: near            !! distance of points that are one [m]

      logical :: are_apart, is_ideal, is_round

      is_ideal = .true.
      if (find_place(item, "level") > 0) is_ideal = item%word("level") == "ideal"
      is_round = info%leaves == leaves_more .and. (find_place(item, "radius") > 0 .or. find_place(item, "radius_i") > 0)
      are_apart = .false.
      if (all(tie%point > 0) .and. .not. any(info%leaves == [leaves_angles, leaves_turn])) then
         are_apart = norm2(start_position(scene, tie%point(1)) - start_position(scene, tie%point(2))) > near
      end if
      if (is_force) then
         kind = merge(mark_spring, mark_damper, is_elastic(item))
      else if (find_place(item, "bearing_radius") > 0) then
         kind = merge(mark_pin, mark_bearing, is_ideal)
      else if (find_place(item, "slider") > 0) then
         kind = mark_slide
      else if (find_place(item, "plane") > 0) then
         kind = mark_plane
      else if (find_place(item, "law") > 0) then
         kind = mark_guide
      else if (is_round) then
         kind = 0
      else if (info%leaves == leaves_way .or. (are_apart .and. norm2(axis_of(item)) > 0.0_wp)) then
         kind = mark_slide
      else
         kind = merge(mark_link, mark_pin, are_apart)
      end if
   end function kind_of_mark

   !> Whether a row of a force between two points has a stiffness or a law of its stretch.
   pure logical function is_elastic(item)
      type(item_t), intent(in) :: item  !! the row

      is_elastic = .true.
      if (find_place(item, "stiffness") == 0 .or. find_place(item, "law") == 0) return
      is_elastic = item%number("stiffness") > 0.0_wp .or. abs(item%number("law")) > 0.0_wp .or. &
                   .not. item%values(place_of(item, "law"))%expression%is_constant
   end function is_elastic

end module scene_drawing
