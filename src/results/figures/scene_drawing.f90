!> What a scene looks like, from its tables.
!>
!> A body has the rows of [shapes] that name it. One without is drawn by the points that it carries (`body_outline`). Columns
!> `radius`, `radius_i` and `radius_j` of a row that ties two points are circles about them, of discs and gears, in space across
!> their axes (`drawn_axes`); of clearance joints in space they are balls. What slides in a guide with clearance is the block of its
!> row; its points are drawn only where they lie beyond the block. Profiles of cams and slots: `drawn_curves`. Joints and forces
!> are marks (`drawn_marks`).
module scene_drawing
   use body_outline, only: distinct_points, outline, same_place
   use drawing, only: add_part, add_teeth, drawing_t, part_t, round_part
   use drawn_curves, only: add_curves
   use drawn_axes, only: axis_of, find_frame, find_shafts, find_ways, turning_axis
   use drawn_marks, only: add_marks
   use item, only: find_place
   use kind_info, only: free_other
   use kinds, only: wp
   use rotations, only: axes_across
   use scene, only: scene_t, table_shapes, table_t
   use scene_size, only: extent_of_scene, size_of_bodies
   use shapes, only: box_part, part_of_shape, sphere_part
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: drawing_of_scene, own_point

contains

   !> Outlines of all bodies, marks of all joints, and the points.
   subroutine drawing_of_scene(scene, drawing)
      type(scene_t), intent(in) :: scene         !! the scene
      type(drawing_t), intent(out) :: drawing    !! what it looks like

      logical :: has_part(0:scene%bodies%n), has_shape(0:scene%bodies%n)
      integer :: k

      drawing%is_spatial = scene%settings%is_spatial
      drawing%size = extent_of_scene(scene)
      if (.not. drawing%size > 0.0_wp) drawing%size = max(size_of_bodies(scene), tiny(1.0_wp))
      drawing%size = max(drawing%size, largest_bore(scene))
      drawing%points = scene%points%names
      drawing%body = scene%points%body
      allocate (drawing%s(3, scene%points%n))
      do k = 1, scene%points%n
         drawing%s(:, k) = own_point(scene, k)
      end do
      has_part = .false.
      call add_shapes(scene, drawing, has_part)
      has_shape = has_part
      call add_rounds(scene, scene%joints, .false., .true., drawing, has_part)
      call add_rounds(scene, scene%clearances, drawing%is_spatial, .false., drawing, has_part)
      call add_blocks(scene, has_shape, drawing, has_part)
      call add_curves(scene, has_shape, drawing, has_part)
      call add_outlines(scene, drawing, has_part)
      call add_marks(scene, scene%joints, .false., has_shape, drawing)
      call add_marks(scene, scene%clearances, .false., has_shape, drawing)
      call add_marks(scene, scene%forces, .true., has_shape, drawing)
   end subroutine drawing_of_scene

   !> Diameter of the largest bearing; 0: no bearing.
   pure real(wp) function largest_bore(scene) result(bore)
      type(scene_t), intent(in) :: scene   !! the scene

      integer :: i, k

      bore = 0.0_wp
      do k = 1, size(scene%clearances)
         do i = 1, size(scene%clearances(k)%items)
            if (find_place(scene%clearances(k)%items(i), "bearing_radius") == 0) cycle
            bore = max(bore, 2.0_wp*scene%clearances(k)%items(i)%number("bearing_radius"))
         end do
      end do
   end function largest_bore

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
   subroutine add_rounds(scene, tables, are_balls, are_gears, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      type(table_t), intent(in) :: tables(:)        !! (kinds) joints, or joints with clearance
      logical, intent(in) :: are_balls              !! they are round all over
      logical, intent(in) :: are_gears              !! they have teeth
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(inout) :: has_part(0:)        !! (0:bodies) whether a body has one

      character(*), parameter :: columns(3) = [character(8) :: "radius_i", "radius_j", "radius"]
      integer, parameter :: ends(3) = [1, 2, 2]
      real(wp), parameter :: pitch = 0.03_wp   ! of teeth, of the size of the scene [1]
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
               if (place == 0 .or. tie%n < 2 .or. tie%by_joint .or. tables(k)%info%free /= free_other) cycle
               if (.not. abs(tables(k)%items(i)%values(place)%number) > 0.0_wp) cycle  ! a follower that is a point
               associate (body => tie%body(ends(c)), point => tie%point(ends(c)), &
                          radius => abs(tables(k)%items(i)%values(place)%number))
                  if (point == 0 .or. body == 0 .or. had_part(body)) cycle
                  if (are_balls) then
                     call sphere_part(radius, drawing%s(:, point), scene%settings%is_spatial, body, part)
                  else
                     axes = axes_across(turning_axis(scene, tables(k)%items(i), tie, ends(c)))
                     call round_part(part, body, drawing%s(:, point), axes(:, :2), radius)
                     if (are_gears) call add_teeth(part, drawing%s(:, point), axes(:, :2), radius, pitch*drawing%size)
                  end if
                  call add_part(drawing, part)
                  if (norm2(drawing%s(:, point)) < same_place*drawing%size) has_part(body) = .true.
               end associate
            end do
         end do
      end do
   end subroutine add_rounds

   !> Blocks in guides with clearance, as their rows have them; a body whose points all are in one block needs no other outline.
   subroutine add_blocks(scene, has_shape, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      logical, intent(in) :: has_shape(0:)          !! (0:bodies) whether rows of [shapes] say how a body looks
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(inout) :: has_part(0:)        !! (0:bodies) whether a body has one

      type(part_t) :: part
      real(wp) :: frame(3, 3), half(3)
      type(tie_t) :: tie
      integer :: i, k

      do k = 1, size(scene%clearances)
         do i = 1, size(scene%clearances(k)%items)
            associate (item => scene%clearances(k)%items(i))
               if (find_place(item, "slider") == 0) cycle
               tie = tie_of(scene, scene%clearances(k)%info, item)
               if (has_shape(tie%body(2))) cycle
               call find_frame(scene, item, tie, axis_of(item), frame)
               half = 0.5_wp*[item%number("length"), item%number("height"), 0.0_wp]
               if (find_place(item, "width_axis") > 0) half(2:3) = 0.5_wp*[item%number("width"), item%number("height")]
            end associate
            associate (body => tie%body(2), centre => drawing%s(:, tie%point(2)))
               call box_part(half, centre, frame, body, part)
               call add_part(drawing, part)
               if (has_all_points(drawing, body, centre, frame, half)) has_part(body) = .true.
            end associate
         end do
      end do
   end subroutine add_blocks

   !> Whether a block has all points of its body in it.
   pure logical function has_all_points(drawing, body, centre, frame, half)
      type(drawing_t), intent(in) :: drawing  !! where points are
      integer, intent(in) :: body             !! the body
      real(wp), intent(in) :: centre(3)       !! (3) centre of the block, own frame of the body [m]
      real(wp), intent(in) :: frame(3, 3)     !! (3, 3) its axes as columns, own frame of the body [1]
      real(wp), intent(in) :: half(3)         !! (3) half its sides along them [m]

      integer :: k

      has_all_points = .false.
      do k = 1, size(drawing%body)
         if (drawing%body(k) /= body) cycle
         if (any(abs(matmul(drawing%s(:, k) - centre, frame)) > half + same_place*drawing%size)) return
      end do
      has_all_points = .true.
   end function has_all_points

   !> Outlines of bodies that have no part, by their points.
   subroutine add_outlines(scene, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(in) :: has_part(0:)           !! (0:bodies) whether a body has one

      type(part_t) :: part
      real(wp) :: frames(3, 3, scene%bodies%n), shafts(3, scene%bodies%n)
      integer, allocatable :: first(:), next(:)
      integer :: body, k

      call find_ways(scene, frames)
      call find_shafts(scene, shafts)
      allocate (first(0:scene%bodies%n), next(scene%points%n), source=0)
      do k = scene%points%n, 1, -1  ! lists of the points of each body, in the order of the deck
         next(k) = first(scene%points%body(k))
         first(scene%points%body(k)) = k
      end do
      do body = 1, scene%bodies%n
         if (has_part(body)) cycle
         call outline(drawing, body, distinct_points(drawing, first(body), next), frames(:, :, body), shafts(:, body), &
                      part)
         call add_part(drawing, part)
      end do
   end subroutine add_outlines

end module scene_drawing
