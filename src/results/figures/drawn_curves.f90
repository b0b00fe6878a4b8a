!> Profiles of cams and slots, and flat faces, as rows of clearance joints have them.
!>
!> A profile is the outline of its cam. A slot is its walls, a line on both sides of the centreline, with half circles about its
!> ends that are round. A flat face is as long as the cam is wide. They are fixed in the bodies of the row, the ground included; a
!> body that rows of [shapes] draw has no profile beside them.
module drawn_curves
   use drawing, only: add_part, add_stroke, drawing_t, in_both, part_t, start_part
   use item, only: find_place, item_t
   use kinds, only: pi, wp
   use profile_columns, only: cam_profile, slot_profile
   use profile_curve, only: profile_t
   use scene, only: scene_t
   use ties, only: tie_of, tie_t
   implicit none (type, external)
   private
   public :: add_curves

   integer, parameter :: stride = 4     !! nodes of a curve for a corner of its picture
   integer, parameter :: n_end = 16     !! corners of a half circle

contains

   !> All curves of a scene.
   subroutine add_curves(scene, has_shape, drawing, has_part)
      type(scene_t), intent(in) :: scene            !! the scene
      logical, intent(in) :: has_shape(0:)          !! (0:bodies) whether rows of [shapes] say how a body looks
      type(drawing_t), intent(inout) :: drawing     !! gets parts
      logical, intent(inout) :: has_part(0:)        !! (0:bodies) whether a body has one

      integer :: i, k
      type(profile_t) :: profile
      type(tie_t) :: tie

      do k = 1, size(scene%clearances)
         do i = 1, size(scene%clearances(k)%items)
            associate (item => scene%clearances(k)%items(i))
               tie = tie_of(scene, scene%clearances(k)%info, item)
               if (find_place(item, "profile") > 0) then
                  call cam_profile(item, profile)
                  if (.not. has_shape(tie%body(1))) then
                     call add_outline(profile%q(::stride, :), .true., tie%body(1), drawing%s(:, tie%point(1)), drawing)
                     if (tie%body(1) > 0) has_part(tie%body(1)) = .true.
                  end if
                  if (item%word("contact") == "flat" .and. .not. has_shape(tie%body(2))) then
                     call add_outline(face_of(item, profile), .false., tie%body(2), drawing%s(:, tie%point(2)), drawing)
                     has_part(tie%body(2)) = .true.
                  end if
               else if (find_place(item, "arc_radius") > 0) then
                  call slot_profile(item, profile)
                  call add_walls(profile, 0.5_wp*item%number("width"), tie%body(1), drawing%s(:, tie%point(1)), drawing)
               end if
            end associate
         end do
      end do
   end subroutine add_curves

   !> A line through corners.
   subroutine add_outline(q, is_closed, body, origin, drawing)
      real(wp), intent(in) :: q(:, :)              !! (n, 2) the corners, from the origin [m]
      logical, intent(in) :: is_closed             !! the last one is joined to the first one
      integer, intent(in) :: body                  !! the body, 0: ground
      real(wp), intent(in) :: origin(3)            !! (3) the point of the row, own frame [m]
      type(drawing_t), intent(inout) :: drawing    !! gets a part

      integer :: k, n
      real(wp) :: s(3, size(q, 1))
      type(part_t) :: part

      n = size(q, 1)
      do k = 1, n
         s(:, k) = origin + [q(k, :), 0.0_wp]
      end do
      call start_part(part, body, s)
      call add_stroke(part, [(k, k=1, n), (1, k=1, merge(1, 0, is_closed))], .false., in_both)
      call add_part(drawing, part)
   end subroutine add_outline

   !> The ends of a flat face.
   pure function face_of(item, profile) result(q)
      type(item_t), intent(in) :: item           !! the row
      type(profile_t), intent(in) :: profile     !! the profile that it is on
      real(wp) :: q(2, 2)                        !! (2, 2) the ends, as rows, from the point of the row [m]

      real(wp) :: angle

      angle = item%number("face_angle")
      if (item%word("face_axis") == "x") angle = angle + 0.5_wp*pi
      q(1, :) = maxval(abs(profile%q))*[cos(angle), sin(angle)]
      q(2, :) = -q(1, :)
   end function face_of

   !> The walls of a slot: of a closed one two lines, else one around it.
   subroutine add_walls(profile, half, body, origin, drawing)
      type(profile_t), intent(in) :: profile       !! the centreline, with nodes
      real(wp), intent(in) :: half                 !! half the width [m]
      integer, intent(in) :: body                  !! the body, 0: ground
      real(wp), intent(in) :: origin(3)            !! (3) the point of the row, own frame [m]
      type(drawing_t), intent(inout) :: drawing    !! gets parts

      real(wp), allocatable :: across(:, :), q(:, :)
      real(wp), dimension(n_end, 2) :: first, last
      integer :: k, n

      q = profile%q(::stride, :)
      n = size(q, 1)
      allocate (across(n, 2))
      do k = 1, n
         associate (before => merge(modulo(k - 2, n) + 1, max(k - 1, 1), profile%is_closed), &
                    next => merge(modulo(k, n) + 1, min(k + 1, n), profile%is_closed))
            across(k, :) = [q(before, 2) - q(next, 2), q(next, 1) - q(before, 1)]
            across(k, :) = half*across(k, :)/norm2(across(k, :))
         end associate
      end do
      if (profile%is_closed) then
         call add_outline(q + across, .true., body, origin, drawing)
         call add_outline(q - across, .true., body, origin, drawing)
         return
      end if
      first = half_circle(q(1, :), across(1, :))
      if (profile%mouth > 0.0_wp) then  ! from corner to corner
         call add_outline(reshape([q(n:1:-1, 1) + across(n:1:-1, 1), first(:, 1), q(:, 1) - across(:, 1), &
                                   q(n:1:-1, 2) + across(n:1:-1, 2), first(:, 2), q(:, 2) - across(:, 2)], &
                                  [2*n + n_end, 2]), .false., body, origin, drawing)
         return
      end if
      last = half_circle(q(n, :), -across(n, :))
      call add_outline(reshape([q(:, 1) - across(:, 1), last(:, 1), q(n:1:-1, 1) + across(n:1:-1, 1), first(:, 1), &
                                q(:, 2) - across(:, 2), last(:, 2), q(n:1:-1, 2) + across(n:1:-1, 2), first(:, 2)], &
                               [2*n + 2*n_end, 2]), .true., body, origin, drawing)
   end subroutine add_walls

   !> Corners of a half circle, counter-clockwise.
   pure function half_circle(centre, start) result(q)
      real(wp), intent(in) :: centre(2)  !! (2) its centre [m]
      real(wp), intent(in) :: start(2)   !! (2) from there to its start [m]
      real(wp) :: q(n_end, 2)            !! (n_end, 2) its corners [m]

      real(wp) :: angle
      integer :: k

      do k = 1, n_end
         angle = pi*real(k, wp)/real(n_end + 1, wp)
         q(k, :) = centre + [cos(angle)*start(1) - sin(angle)*start(2), sin(angle)*start(1) + cos(angle)*start(2)]
      end do
   end function half_circle

end module drawn_curves
