!> Driver of a speed in space: body j turns against body i of a revolute or cylindrical joint, about its axis.
!>
!> Phi = theta - theta_0 - W t, theta_0 where the deck puts the bodies: see `turn_frames`.    (1 row)
!>
!> Signs: W > 0 is counter-clockwise of j, observed from the tip of the axis. Source: as driver.speed of the plane.
!> Limits: as `turn_frames`.
module spatial_driver_speed
   use driver_speed, only: driver_speed_t
   use driver_speed, only: add_driver_channels
   use joint_set, only: joint_set_t
   use kind_info, only: add_number, add_reference, dim_angular_speed, in_space, kind_info_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use turn_frames, only: turn_frames_t
   use spatial_rows, only: scalar_t
   implicit none (type, external)
   private
   public :: spatial_driver_speed_t

   !> All of them.
   type, extends(driver_speed_t) :: spatial_driver_speed_t
      type(turn_frames_t), private :: frames   !! of the joints that are driven
   contains
      procedure, nopass :: info => spatial_info
      procedure :: take_joint => spatial_take_joint
      procedure :: evaluate => spatial_evaluate
      procedure :: coordinate => spatial_coordinate
   end type spatial_driver_speed_t

contains

   !> Description of the kind.
   function spatial_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "driver.speed"
      info%space = in_space
      info%help = "prescribes a constant speed of a joint about its axis"
      info%source = "Nikravesh (1988), section 7.4.3"
      info%n_row = 1
      info%drives_turn = .true.
      call add_reference(info, "joint", "joint.revolute joint.cylindrical", "the joint that is driven")
      call add_number(info, "speed", dim_angular_speed, "speed of j relative to i, counter-clockwise about the axis")
      call add_driver_channels(info)
   end function spatial_info

   !> Frames of the joint that an item drives, and the angle that it starts with.
   subroutine spatial_take_joint(self, k, joint, motion)
      class(spatial_driver_speed_t), intent(inout) :: self  !! the set, prepared
      integer, intent(in) :: k                   !! item
      class(joint_set_t), intent(in) :: joint    !! a set of one item, the joint, prepared and with its start
      type(motion_t), intent(in) :: motion       !! bodies where the deck puts them

      type(scalar_t) :: angle

      call self%frames%take(self%n, k, joint)
      angle = self%frames%angle(k, motion, self%body(:, k), 0.0_wp)
      self%start(k) = angle%value
   end subroutine spatial_take_joint

   !> Fill the rows of all items.
   subroutine spatial_evaluate(self, t, motion, rows)
      class(spatial_driver_speed_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(rows_t), intent(inout) :: rows        !! rows, those of the set are filled

      real(wp) :: f, f_dot, f_dot_dot
      integer :: k

      do k = 1, self%n
         call self%prescription(k, t, f, f_dot, f_dot_dot)
         call self%frames%write_row(k, self%first_row + k, motion, self%body(:, k), f, f_dot, f_dot_dot, rows)
      end do
   end subroutine spatial_evaluate

   !> Angle of an item and its rate; turns are those of the function.
   subroutine spatial_coordinate(self, k, motion, value, rate)
      class(spatial_driver_speed_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: value             !! angle [rad]
      real(wp), intent(out) :: rate              !! its rate [rad/s]

      type(scalar_t) :: angle
      real(wp) :: f, f_dot, f_dot_dot

      call self%prescription(k, motion%t, f, f_dot, f_dot_dot)
      angle = self%frames%angle(k, motion, self%body(:, k), f)
      value = angle%value
      rate = angle%rate
   end subroutine spatial_coordinate

end module spatial_driver_speed
