!> Driver of a position in space: a point of body j along an axis fixed in body i, as a function of time.
!>
!> Phi = z_i . d - f(t),   d = P_j - P_i                                     (1 row)
!>
!> It drives the slider of joint.translational or joint.cylindrical with the same points and axis, or any point over any other.
!> Signs: the driving force on body j is -lambda along the axis. Source: Nikravesh (1988), section 7.4.3.
!> Limits: f twice differentiable; what a jump of f or f' does is said at driver.angle.
module spatial_driver_position
   use driver_distance, only: add_length_channels
   use expression, only: expression_t
   use item, only: item_t, place_of
   use joint_set, only: joint_set_t
   use kind_info, only: add_direction, add_expression, dim_length, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_joint, only: add_joint_columns
   use spatial_rows, only: dot_with_span, put_row, scalar_t
   implicit none (type, external)
   private
   public :: spatial_driver_position_t

   !> All position drivers of a spatial scene.
   type, extends(joint_set_t) :: spatial_driver_position_t
      real(wp), allocatable :: axis(:, :)      !! (3, n) unit axis, frame of body i [1]
      type(expression_t), allocatable :: f(:)  !! (n) position [m]
   contains
      procedure, nopass :: info => position_info
      procedure :: prepare => position_prepare
      procedure :: set_start => position_set_start
      procedure :: evaluate => position_evaluate
      procedure :: coordinate => position_coordinate
   end type spatial_driver_position_t

contains

   !> Description of the kind.
   function position_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "driver.position"
      info%help = "prescribes the position of a point along an axis as a function of time"
      info%source = "Nikravesh (1988), section 7.4.3"
      info%n_row = 1
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "direction of the motion, in the frame of the body of i", default='"0 0 1"')
      call add_expression(info, "position", dim_length, "position of j relative to i along the axis")
      call add_length_channels(info, "driving force on the body of j along the axis", "position of j relative to i along the axis")
   end function position_info

   !> Axis, as in the deck, and function of each item.
   subroutine position_prepare(self, items, angle)
      class(spatial_driver_position_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)                     !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)                        !! (0:bodies) not used [rad]

      integer :: k

      self%is_driver = .true.
      allocate (self%f(self%n), self%axis(3, self%n))
      do k = 1, self%n
         self%axis(:, k) = items(k)%direction("axis_i")
         self%axis(:, k) = self%axis(:, k)/norm2(self%axis(:, k))
         self%f(k) = items(k)%values(place_of(items(k), "position"))%expression
      end do
   end subroutine position_prepare

   !> Axes in the frames of the bodies.
   subroutine position_set_start(self, motion)
      class(spatial_driver_position_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion                     !! bodies where the deck puts them

      integer :: k

      do k = 1, self%n
         self%axis(:, k) = matmul(self%axis(:, k), motion%spatial%own(:, :, self%body(1, k)))
      end do
   end subroutine position_set_start

   !> Fill the rows of all items.
   subroutine position_evaluate(self, t, motion, rows)
      class(spatial_driver_position_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                             !! time [s]
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      type(rows_t), intent(inout) :: rows                   !! rows, those of the set are filled

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k

      do k = 1, self%n
         call self%f(k)%evaluate(t, f, f_dot, f_dot_dot)
         call put_row(rows, self%first_row + k, motion, self%body(:, k), &
                      dot_with_span(motion, self%body(:, k), self%axis(:, k), self%s_i(:, k), self%s_j(:, k)), f, f_dot, f_dot_dot)
      end do
   end subroutine position_evaluate

   !> Position along the axis, and its rate.
   subroutine position_coordinate(self, k, motion, value, rate)
      class(spatial_driver_position_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                              !! item
      type(motion_t), intent(in) :: motion                  !! positions and velocities
      real(wp), intent(out) :: value                        !! position [m]
      real(wp), intent(out) :: rate                         !! its rate [m/s]

      type(scalar_t) :: x

      x = dot_with_span(motion, self%body(:, k), self%axis(:, k), self%s_i(:, k), self%s_j(:, k))
      value = x%value
      rate = x%rate
   end subroutine position_coordinate

end module spatial_driver_position
