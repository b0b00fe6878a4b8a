!> Rack and pinion in space: a gear of body j rolls on a line of body i.
!>
!> With the unit axis s of the rack's pitch line through the point of i, the pinion's axis u in j, d = r_j^P - r_i^P to the centre
!> of the pinion, and theta the angle of j against i about u, from where the deck puts the bodies:
!>
!> Phi = s . d + R theta - (the same where the deck puts the bodies)                                (1 row)
!>
!> R is positive if the pinion lies to the left of the line, along s and observed from the tip of u: at n = u x s. Phi' = 0 says
!> that line and pitch circle have the same velocity where they touch. Angles are taken next to those at the end of the last step.
!>
!> Signs: the force on the body of i, at P_j - R n where they touch, is s lambda. Source: P. E. Nikravesh, Computer-Aided Analysis
!> of Mechanical Systems (1988), section 4.2.4, in space. Limits: other joints hold the pinion at its distance |R| from the line,
!> and its axis as the deck puts it: theta has no value where it is turned by a right angle, which ends a run; less than half a
!> turn in a step; the force is along the line: no pressure angle, no play.
module spatial_rack
   use counted_joint, only: counted_joint_t, most_angles
   use item, only: item_t
   use kind_info, only: add_direction, add_number, dim_length, kind_info_t
   use kinds, only: wp
   use mesh, only: line_misfit
   use motion, only: cross, motion_t, point_position
   use rows, only: rows_t
   use spatial_joint, only: add_joint_columns, add_reaction_channels, degrees_between, element_t
   use text, only: real_text
   use spatial_rows, only: angle_between, axis_of, dot_with_span, put_row, scalar_t, wrapped
   use rotations, only: axes_across
   implicit none (type, external)
   private
   public :: rack_is_lost, spatial_rack_t, words_of_lost_rack

   real(wp), parameter :: square = 1.0e-6_wp  !! cosine of an angle that is a right one [1]

   !> All racks with their pinions of a spatial scene.
   type, extends(counted_joint_t) :: spatial_rack_t
      real(wp), allocatable, private :: radius(:)    !! (n) radius of the pitch circle, negative to the right of the line [m]
      real(wp), allocatable, private :: line(:, :)   !! (3, n) s, frame of body i [1]
      real(wp), allocatable, private :: start(:)     !! (n) s . d where the deck puts the bodies [m]
   contains
      procedure, nopass :: info => rack_info
      procedure :: prepare => rack_prepare
      procedure :: set_start => rack_set_start
      procedure :: find_angles => rack_find_angles
      procedure :: evaluate => rack_evaluate
      procedure :: reaction_point => rack_reaction_point
      procedure :: closing_fault => rack_closing_fault
      procedure :: closing_doubt => rack_closing_doubt
   end type spatial_rack_t

contains

   !> Description of the kind.
   function rack_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.rack"
      info%help = "rack and pinion: a gear rolls on a line of a body; other joints guide it"
      info%source = "Nikravesh (1988), section 4.2.4"
      info%n_row = 1
      info%counts_turns = .true.
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "direction of the pitch line, in the frame of the body of i", default='"1 0 0"')
      call add_direction(info, "axis_j", "axis of the pinion, in the frame of the body of j", default='"0 0 1"')
      call add_number(info, "radius", dim_length, "pitch radius of the pinion; negative: the pinion is on the right of the " &
                      //"line, viewed against its axis", not_zero=.true.)
      call add_reaction_channels(info)
   end function rack_info

   !> Radii and axes.
   subroutine rack_prepare(self, items, angle)
      class(spatial_rack_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      integer :: k

      call self%take_axes(items, [element_t ::])
      self%radius = [(items(k)%number("radius"), k=1, self%n)]
      allocate (self%angle(1, self%n), self%line(3, self%n), self%start(self%n), source=0.0_wp)
   end subroutine rack_prepare

   !> The pinion meshes as the deck puts it: x of both frames is along the line there, z along the pinion's axis.
   subroutine rack_set_start(self, motion)
      class(spatial_rack_t), intent(inout) :: self  !! the set
      type(motion_t), intent(in) :: motion          !! bodies where the deck puts them

      type(scalar_t) :: x
      real(wp) :: along(3), s(3), u(3), world(3, 3)
      integer :: k

      do k = 1, self%n
         associate (axes => self%axes, own => motion%spatial%own, i => self%body(1, k), j => self%body(2, k))
            self%line(:, k) = matmul(axes%axis_i(:, k)/norm2(axes%axis_i(:, k)), own(:, :, i))
            s = axis_of(motion, i, self%line(:, k))
            u = axis_of(motion, j, matmul(axes%axis_j(:, k)/norm2(axes%axis_j(:, k)), own(:, :, j)))
            world = axes_across(u)
            along = s - dot_product(s, u)*u
            if (norm2(along) > square) then
               world(:, 1) = along/norm2(along)
               world(:, 2) = cross(u, world(:, 1))
            end if
            axes%frame_i(:, :, k) = matmul(transpose(motion%rot(:, :, i)), world)
            axes%frame_j(:, :, k) = matmul(transpose(motion%rot(:, :, j)), world)
         end associate
         x = dot_with_span(motion, self%body(:, k), self%line(:, k), self%s_i(:, k), self%s_j(:, k))
         self%start(k) = x%value
         self%angle(1, k) = 0.0_wp
      end do
   end subroutine rack_set_start

   !> Angle of the pinion against the rack, next to that at the end of the last step.
   pure subroutine rack_find_angles(self, k, motion, phi)
      class(spatial_rack_t), intent(in) :: self         !! the set
      integer, intent(in) :: k                          !! item
      type(motion_t), intent(in) :: motion              !! positions and velocities
      type(scalar_t), intent(inout) :: phi(most_angles) !! (most_angles) the first is set [rad]

      phi(1) = angle_between(motion, self%body(:, k), self%axes%frame_i(:, :, k), self%axes%frame_j(:, :, k))
      phi(1)%value = self%angle(1, k) + wrapped(phi(1)%value - self%angle(1, k))
   end subroutine rack_find_angles

   !> Fill the rows of all items.
   subroutine rack_evaluate(self, t, motion, rows)
      class(spatial_rack_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(rows_t), intent(inout) :: rows        !! rows, those of the set are filled

      type(scalar_t) :: phi(most_angles), x
      integer :: k

      do k = 1, self%n
         call self%find_angles(k, motion, phi)
         x = dot_with_span(motion, self%body(:, k), self%line(:, k), self%s_i(:, k), self%s_j(:, k))
         associate (r => self%radius(k))
            x%value = x%value + r*phi(1)%value
            x%rate = x%rate + r*phi(1)%rate
            x%bend = x%bend + r*phi(1)%bend
            x%turn_i = x%turn_i + r*phi(1)%turn_i
            x%turn_j = x%turn_j + r*phi(1)%turn_j
         end associate
         call put_row(rows, self%first_row + k, motion, self%body(:, k), x, self%start(k), 0.0_wp, 0.0_wp)
      end do
   end subroutine rack_evaluate

   !> Where the pitch circle touches the line.
   function rack_reaction_point(self, k, motion) result(p)
      class(spatial_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      real(wp) :: p(3)                           !! (3) the point, world frame [m]

      p = point_position(motion, self%body(2, k), self%s_j(:, k)) &
          - self%radius(k)*cross(axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k)), &
                                 axis_of(motion, self%body(1, k), self%line(:, k)))
   end function rack_reaction_point

   !> The pinion's axis is at right angles to the line.
   function rack_closing_fault(self, k, motion) result(fault)
      class(spatial_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: fault         !! what is wrong; blank: nothing

      fault = ""
      if (abs(dot_product(axis_of(motion, self%body(1, k), self%line(:, k)), &
                          axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k)))) < square) return
      fault = "rolls on a line that is not perpendicular to the axis of the pinion"//new_line("a")// &
              "  = rotate axis_i, axis_j or one of its bodies in the deck"
   end function rack_closing_fault

   !> The pinion is beside the line by its radius.
   function rack_closing_doubt(self, k, motion) result(doubt)
      class(spatial_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: doubt         !! what does not match; blank: nothing

      real(wp) :: d(3), n(3)

      n = cross(axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k)), &
                axis_of(motion, self%body(1, k), self%line(:, k)))
      d = point_position(motion, self%body(2, k), self%s_j(:, k)) - point_position(motion, self%body(1, k), self%s_i(:, k))
      doubt = line_misfit(self%radius(k), dot_product(n, d))
   end function rack_closing_doubt

   !> Whether the pinion's axis is a right angle or more from where the deck puts it against the rack.
   pure logical function rack_is_lost(self, k, motion) result(is_off)
      class(spatial_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions

      is_off = dot_product(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                           axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))) <= 0.0_wp
   end function rack_is_lost

   !> How far it is turned then.
   function words_of_lost_rack(self, k, motion) result(words)
      class(spatial_rack_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions
      character(:), allocatable :: words         !! what is wrong

      words = "has lost its mesh: the pinion axis is "// &
              real_text(degrees_between(axis_of(motion, self%body(1, k), self%axes%frame_i(:, 3, k)), &
                                        axis_of(motion, self%body(2, k), self%axes%frame_j(:, 3, k))), 4)// &
              " deg from its initial direction (limit 90 deg): add joints that guide the pinion"
   end function words_of_lost_rack

end module spatial_rack
