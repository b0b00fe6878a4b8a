!> Revolute joint in space: two points coincide, and an axis of i is parallel to one of j.
!>
!> Phi = [ P_i - P_j,  x_i . z_j,  y_i . z_j ]                               (5 rows)
!>
!> A pin of radius R has friction with the sliding velocity v = R (omega_j - omega_i) . z under the normal force
!>
!> N = |f/2 + m/L| + |f/2 - m/L| + |f_z| R_f/R + preload
!>
!> f the force across z, m z x the moment across z about the points, which the ends of a bearing of length L bear, f_z the force
!> along z on faces of mean radius R_f. Without L the moment is omitted, without R_f the force along z.
!>
!> Signs, frames: `spatial_joint`. Source: Flores et al. (2008), eqs. (6.14), (6.15): of the three rows of its cross product two are
!> independent; these two are taken; friction: `joint_friction`. Limits: none.
module spatial_revolute
   use item, only: item_t
   use joint_friction, only: add_friction_columns
   use kind_info, only: add_number, dim_length, kind_info_t, free_rotation
   use kinds, only: wp
   use motion, only: motion_t
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_spatial_channels, add_turn_channels, at_point, &
      press_ends, spatial_joint_t
   use spatial_rows, only: axis_of, row_of, scalar_t
   implicit none (type, external)
   private
   public :: spatial_revolute_t

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_revolute_t
   contains
      procedure, nopass :: info => revolute_info
      procedure :: prepare => revolute_prepare
      procedure, nopass :: friction_lengths => revolute_friction_lengths
      procedure :: slide => revolute_slide
      procedure :: press => revolute_press
   end type spatial_revolute_t

contains

   !> Description of the kind.
   function revolute_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.revolute"
      info%help = "pin: two points coincide and two axes are parallel"
      info%source = "Flores et al. (2008), eqs. (6.14), (6.15)"
      info%n_row = 5
      info%free = free_rotation
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the pin")
      call add_spatial_channels(info)
      call add_turn_channels(info)
      call add_friction_columns(info, "radius", "radius of the pin, for friction", &
                                "preload: normal force between pin and hole without load, as of a press fit", &
                                "friction_moment", "N.m", "friction moment on the body of j about the axis")
      call add_number(info, "bearing_length", dim_length, "distance between the bearing ends, which carry the transverse moment" &
                      //"; 0: friction without it", default="0 m", lower=0.0_wp)
      call add_number(info, "face_radius", dim_length, "mean radius of the faces that carry the axial force; 0: friction " &
                      //"without it", default="0 m", lower=0.0_wp)
   end function revolute_info

   !> Elements of the joint.
   subroutine revolute_prepare(self, items, angle)
      class(spatial_revolute_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [at_point, across(1, 3), across(2, 3)])
   end subroutine revolute_prepare

   !> Columns of the pin's radius, and of the lengths that bear the moment and the force along the axis.
   function revolute_friction_lengths() result(name)
      character(:), allocatable :: name   !! the columns

      name = "radius bearing_length face_radius"
   end function revolute_friction_lengths

   !> Sliding velocities of the pins with friction.
   subroutine revolute_slide(self, motion)
      class(spatial_revolute_t), intent(inout) :: self  !! the set; `friction` is set
      type(motion_t), intent(in) :: motion              !! positions and velocities

      type(scalar_t) :: turn
      integer :: c, m

      do m = 1, self%friction%n
         associate (k => self%friction%item(m), frame => self%friction%frame(:, :, m), radius => self%friction%length(1, m))
            do c = 1, 3
               frame(:, c) = axis_of(motion, self%body(1, k), self%axes%frame_i(:, c, k))
            end do
            turn%turn_i = -radius*frame(:, 3)
            turn%turn_j = radius*frame(:, 3)
            self%friction%row(:, m) = row_of(motion, self%body(:, k), turn)
            self%friction%v(m) = dot_product(turn%turn_j, motion%omega(:, self%body(2, k)) - motion%omega(:, self%body(1, k)))
         end associate
      end do
   end subroutine revolute_slide

   !> Normal force of a pin that has friction.
   pure subroutine revolute_press(self, m, lambda, normal, slope)
      class(spatial_revolute_t), intent(in) :: self  !! the set
      integer, intent(in) :: m                       !! place among the items with friction
      real(wp), intent(in) :: lambda(:)              !! (5 or more) multipliers [N, N.m]
      real(wp), intent(out) :: normal                !! normal force [N]
      real(wp), intent(out) :: slope(:)              !! (size of lambda) its derivatives [1, 1/m]

      real(wp) :: along, by_force(2), by_moment(2), face

      associate (frame => self%friction%frame(:, :, m), length => self%friction%length(:, m))
         call press_ends(matmul(lambda(:3), frame(:, :2)), lambda(4:5), length(2), normal, by_force, by_moment)
         along = dot_product(lambda(:3), frame(:, 3))
         face = 0.0_wp
         if (length(1) > 0.0_wp) face = length(3)/length(1)
         normal = normal + face*abs(along) + self%friction%preload(m)
         slope = 0.0_wp
         slope(:3) = matmul(frame(:, :2), by_force) + sign(face, along)*frame(:, 3)
         slope(4:5) = by_moment
      end associate
   end subroutine revolute_press

end module spatial_revolute
