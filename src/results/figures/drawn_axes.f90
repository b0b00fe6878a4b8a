!> Directions that the rows of a scene name, in the own frames of their bodies, for what is drawn.
!>
!> A row of the plane has `axis`, x or y, turned by `axis_angle`; one of space has `axis_i` and `axis_j`, of which the second, left
!> out, is parallel to the first where the deck puts the bodies.
module drawn_axes
   use body_outline, only: same_place
   use item, only: find_place, item_t
   use kind_info, only: free_other, free_rotation, free_spherical, free_translation
   use kinds, only: wp
   use rotations, only: axes_across, rotation_about, rotation_of_parameters
   use scene, only: scene_t, table_t
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: axis_of, direction_in_plane, find_frame, find_shafts, find_ways, start_frame, turning_axis

contains

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

   !> The axis that a disc or gear of a row turns about, own frame of its body: z of the plane; in space the axis of its end, which,
   !> omitted, is parallel to that of i where the deck puts the bodies.
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

   !> Axes of bodies that slide, in their own frames, the first in which they do; zero of those that do not.
   subroutine find_ways(scene, frames)
      type(scene_t), intent(in) :: scene         !! the scene
      real(wp), intent(out) :: frames(:, :, :)   !! (3, 3, bodies) axes [1]

      frames = 0.0_wp
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
               if (tables(k)%info%free /= free_translation .and. find_place(tables(k)%items(i), "slider") == 0) cycle
               call find_frame(scene, tables(k)%items(i), tie, axis, frames(:, :, tie%body(2)))
            end do
         end do
      end subroutine look

   end subroutine find_ways

   !> Axes that bodies of space turn about against others, in their own frames: of revolute joints, then of others (cylindrical,
   !> screw), then of crosses; else zero.
   subroutine find_shafts(scene, axes)
      type(scene_t), intent(in) :: scene      !! the scene
      real(wp), intent(out) :: axes(:, :)     !! (3, bodies) axes [1]

      type(tie_t) :: tie
      integer, parameter :: passes(3) = [free_rotation, free_other, free_spherical]
      integer :: end, i, k, pass

      axes = 0.0_wp
      if (.not. scene%settings%is_spatial) return
      do pass = 1, size(passes)
         do k = 1, size(scene%joints)
            if (scene%joints(k)%info%free /= passes(pass)) cycle
            do i = 1, size(scene%joints(k)%items)
               if (find_place(scene%joints(k)%items(i), "axis_i") == 0) cycle
               tie = tie_of(scene, scene%joints(k)%info, scene%joints(k)%items(i))
               if (tie%n < 2 .or. tie%by_joint) cycle
               do end = 1, 2
                  if (tie%body(end) == 0) cycle
                  if (norm2(axes(:, tie%body(end))) > 0.0_wp) cycle
                  axes(:, tie%body(end)) = turning_axis(scene, scene%joints(k)%items(i), tie, end)
               end do
            end do
         end do
      end do
   end subroutine find_shafts

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

end module drawn_axes
