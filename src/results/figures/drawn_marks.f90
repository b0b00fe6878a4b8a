!> Marks of joints, clearance joints and forces, from the tables of a scene.
!>
!> A joint is a mark at its two points: what it leaves of the freedom says which; a row whose points are apart at the start is a
!> link, of a force a spring, or a damper where nothing is elastic in it. A force at one point is a mark there. Rows that name
!> joints (drivers) are not drawn.
module drawn_marks
   use body_outline, only: same_place
   use drawing, only: add_mark, add_part, add_stroke, drawing_t, in_files, mark_bearing, mark_damper, mark_guide, mark_link, &
      mark_load, mark_pin, mark_plane, mark_slide, mark_slot, mark_spring, mark_t, part_t, round_part, start_part
   use drawn_axes, only: axis_of, direction_in_plane, start_frame
   use item, only: find_place, item_t, place_of
   use joint_level, only: level_ideal, level_of
   use kind_info, only: kind_info_t, free_spherical, free_other, free_rotation, free_translation
   use kinds, only: wp
   use rotations, only: axes_across
   use scene, only: scene_t, table_t
   use scene_size, only: start_position
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: add_marks

contains

   !> Marks of the rows of some kinds.
   subroutine add_marks(scene, tables, are_forces, has_shape, drawing)
      type(scene_t), intent(in) :: scene           !! the scene
      type(table_t), intent(in) :: tables(:)       !! (kinds) joints, joints with clearance or forces
      logical, intent(in) :: are_forces            !! they are forces
      logical, intent(in) :: has_shape(0:)         !! (0:bodies) whether rows of [shapes] say how a body looks
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
               if (mark%kind == mark_pin .and. info%free == free_spherical .and. find_place(item, "axis_j") > 0) then
                  mark%axis_j = second_arm(scene, item, tie, mark%axis)
               end if
               if (mark%kind == mark_bearing) then
                  mark%radius = item%number("bearing_radius")
                  mark%clearance = item%number("clearance")
                  call add_bearing(mark, drawing)
               else if (mark%kind == mark_slide) then
                  call measure_slide(scene, item, tie, mark)
                  if (has_shape(mark%body(2))) mark%sides = 0.0_wp
               end if
               if (mark%kind > 0) call add_mark(drawing, mark)
            end associate
         end do
      end do
   end subroutine add_marks

   !> The arm of a cross in body j, whose arm in body i is the axis; zero if they are not perpendicular and make no cross.
   pure function second_arm(scene, item, tie, axis) result(arm)
      type(scene_t), intent(in) :: scene   !! the scene
      type(item_t), intent(in) :: item     !! the row
      type(tie_t), intent(in) :: tie       !! what it ties
      real(wp), intent(in) :: axis(3)      !! (3) own frame of i [1]
      real(wp) :: arm(3)                   !! (3) own frame of j [1]

      real(wp), parameter :: skew = 0.1_wp   ! cosine of an angle that is not right [1]

      arm = item%direction("axis_j")
      if (abs(dot_product(matmul(start_frame(scene, tie%body(1)), axis), matmul(start_frame(scene, tie%body(2)), arm))) > &
          skew*norm2(arm)) arm = 0.0_wp
   end function second_arm

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

   !> Sides of what slides in a guide, gaps and direction of one with clearance.
   subroutine measure_slide(scene, item, tie, mark)
      type(scene_t), intent(in) :: scene         !! the scene
      type(item_t), intent(in) :: item           !! the row
      type(tie_t), intent(in) :: tie             !! what it ties
      type(mark_t), intent(inout) :: mark        !! the joint, with its axis

      if (any([find_place(item, "gap"), find_place(item, "length"), find_place(item, "height")] == 0)) return
      mark%sides = 0.5_wp*[item%number("length"), item%number("height")]
      if (level_of(item) == level_ideal) return
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

   !> Hole and journal of a clearance joint, in their size: circles across its axis, for files.
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

      is_ideal = any(level_of(item) == [0, level_ideal])
      is_round = info%free == free_other .and. (find_place(item, "radius") > 0 .or. find_place(item, "radius_i") > 0)
      are_apart = .false.
      if (all(tie%point > 0) .and. .not. any(info%free == [free_spherical, free_rotation])) then
         are_apart = norm2(start_position(scene, tie%point(1)) - start_position(scene, tie%point(2))) > near
      end if
      if (is_force .and. find_place(item, "modulus") > 0) then
         kind = mark_link
      else if (is_force .and. .not. are_apart .and. find_place(item, "stiffness_x") > 0) then
         kind = mark_pin
      else if (is_force) then
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
      else if (info%free == free_other .and. find_place(item, "axis") > 0 .and. find_place(item, "axis_angle") > 0) then
         kind = mark_slot
      else if (info%free == free_translation .or. (are_apart .and. norm2(axis_of(item)) > 0.0_wp)) then
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

end module drawn_marks
