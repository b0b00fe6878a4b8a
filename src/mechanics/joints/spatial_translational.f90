!> Translational (prismatic) joint in space: a cylindrical joint that does not turn.
!>
!> Phi = [ x_i . z_j,  y_i . z_j,  x_i . y_j,  x_i . d,  y_i . d ]          (5 rows)
!>
!> The third row is of perpendicular axes: with parallel ones it would lose its rank. The frame of j is that of i where the deck
!> puts the bodies, unless the deck gives the axis of j.
!> A slider has friction with the velocity of its point along z under the normal force
!>
!> N = |f/2 + m/L| + |f/2 - m/L| + 2 |m_z|/w + preload
!>
!> f the force across z at the point of j, m z x the moment across z about it, which the ends of a slider of length L bear, m_z that
!> about z, tolerated at w from side to side. Without L and w the moments are omitted.
!>
!> Signs, frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2.4; friction: `joint_friction`. Limits: none.
module spatial_translational
   use item, only: item_t
   use joint_friction, only: add_friction_columns
   use kind_info, only: add_number, dim_length, kind_info_t, free_translation
   use kinds, only: wp
   use motion, only: motion_t
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_slide_channels, add_spatial_channels, beside, &
      press_ends, spatial_joint_t
   use spatial_rows, only: dot_with_span, row_of, scalar_t
   implicit none (type, external)
   private
   public :: spatial_translational_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_translational_t
   contains
      procedure, nopass :: info => translational_info
      procedure :: prepare => translational_prepare
      procedure, nopass :: friction_lengths => translational_friction_lengths
      procedure :: slide => translational_slide
      procedure :: press => translational_press
   end type spatial_translational_t

contains

   !> Description of the kind.
   function translational_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.translational"
      info%help = "a slider in a guide: slides along an axis without rotation"
      info%source = "Nikravesh (1988), section 7.2.4"
      info%n_row = 5
      info%free = free_translation
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the guide")
      call add_spatial_channels(info)
      call add_slide_channels(info)
      call add_friction_columns(info, "slider_length", "distance between the slider ends, which carry the transverse moment; 0: " &
                                //"friction without it", "preload: normal force of the slider without load, as of a clamped "// &
                                   "guide", &
                                "friction_force", "N", "friction force on the body of j along the axis, for a joint with friction")
      call add_number(info, "slider_width", dim_length, "distance between the sides that carry the moment about the axis; 0: "// &
         "friction " &
                      //"without it", default="0 m", lower=0.0_wp)
   end function translational_info

   !> Elements of the joint.
   subroutine translational_prepare(self, items, angle)
      class(spatial_translational_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      self%axes%holds_turn = .true.
      call self%take_axes(items, [across(1, 3), across(2, 3), across(1, 2), beside(1), beside(2)])
   end subroutine translational_prepare

   !> Columns of the lengths that bear moments.
   function translational_friction_lengths() result(name)
      character(:), allocatable :: name   !! the columns

      name = "slider_length slider_width"
   end function translational_friction_lengths

   !> Sliding velocities of the sliders with friction.
   subroutine translational_slide(self, motion)
      class(spatial_translational_t), intent(inout) :: self  !! the set; `friction` is set
      type(motion_t), intent(in) :: motion                   !! positions and velocities

      type(scalar_t) :: way
      integer :: m

      do m = 1, self%friction%n
         associate (k => self%friction%item(m))
            way = dot_with_span(motion, self%body(:, k), self%axes%frame_i(:, 3, k), self%s_i(:, k), self%s_j(:, k))
            self%friction%row(:, m) = row_of(motion, self%body(:, k), way)
            self%friction%v(m) = way%rate
         end associate
      end do
   end subroutine translational_slide

   !> Normal force of a slider that has friction.
   pure subroutine translational_press(self, m, lambda, normal, slope)
      class(spatial_translational_t), intent(in) :: self  !! the set
      integer, intent(in) :: m                            !! place among the items with friction
      real(wp), intent(in) :: lambda(:)                   !! (5 or more) multipliers [N.m, N]
      real(wp), intent(out) :: normal                     !! normal force [N]
      real(wp), intent(out) :: slope(:)                   !! (size of lambda) its derivatives [1/m, 1]

      real(wp) :: turn

      turn = 0.0_wp
      associate (length => self%friction%length(:, m))
         if (length(2) > 0.0_wp) turn = 2.0_wp/length(2)
         slope = 0.0_wp
         call press_ends(lambda(4:5), lambda(1:2), length(1), normal, slope(4:5), slope(1:2))
      end associate
      normal = normal + turn*abs(lambda(3)) + self%friction%preload(m)
      slope(3) = sign(turn, lambda(3))
   end subroutine translational_press

end module spatial_translational
