!> Frames of the joints whose turn drivers prescribe, in space.
!>
!> Phi = theta - f(t), with theta the angle of x_j against x_i about z_i (`spatial_rows`), taken next to f: so turns are counted by
!> the driver's own function.                                               (1 row)
!>
!> Signs: the moment on body j about the axis is -lambda. Source: Nikravesh (1988), section 7.4.3, with the angle itself for its
!> sine, so that the multiplier is the moment. Limits: within half a turn of f, assembled or not.
module turn_frames
   use joint_set, only: joint_set_t
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_joint, only: spatial_joint_t
   use spatial_rows, only: angle_between, put_row, scalar_t, wrapped
   implicit none (type, external)
   private
   public :: turn_frames_t

   !> Joint frames of the items of a set.
   type :: turn_frames_t
      real(wp), allocatable :: of_i(:, :, :)   !! (3, 3, n) axes x, y, z as columns, frame of body i [1]
      real(wp), allocatable :: of_j(:, :, :)   !! (3, 3, n) axes x, y, z as columns, frame of body j [1]
   contains
      procedure :: take => frames_take
      procedure :: angle => frames_angle
      procedure :: write_row => frames_write_row
   end type turn_frames_t

contains

   !> Take the frames of an item from its joint.
   subroutine frames_take(self, n, k, joint)
      class(turn_frames_t), intent(inout) :: self   !! the frames
      integer, intent(in) :: n                      !! items of the set
      integer, intent(in) :: k                      !! this one
      class(joint_set_t), intent(in) :: joint       !! a set of one item, the joint, with its start

      if (.not. allocated(self%of_i)) allocate (self%of_i(3, 3, n), self%of_j(3, 3, n), source=0.0_wp)
      select type (joint)
      class is (spatial_joint_t)
         self%of_i(:, :, k) = joint%axes%frame_i(:, :, 1)
         self%of_j(:, :, k) = joint%axes%frame_j(:, :, 1)
      end select
   end subroutine frames_take

   !> Angle of an item next to a value.
   pure function frames_angle(self, k, motion, body, near) result(x)
      class(turn_frames_t), intent(in) :: self   !! the frames
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions and velocities
      integer, intent(in) :: body(2)             !! (2) bodies i and j
      real(wp), intent(in) :: near               !! an angle not half a turn from it [rad]
      type(scalar_t) :: x                        !! the angle [rad]

      x = angle_between(motion, body, self%of_i(:, :, k), self%of_j(:, :, k))
      x%value = near + wrapped(x%value - near)
   end function frames_angle

   !> Write the row of a prescribed angle.
   pure subroutine frames_write_row(self, k, row, motion, body, f, f_dot, f_dot_dot, rows)
      class(turn_frames_t), intent(in) :: self   !! the frames
      integer, intent(in) :: k                   !! item
      integer, intent(in) :: row                 !! number of the row
      type(motion_t), intent(in) :: motion       !! positions and velocities
      integer, intent(in) :: body(2)             !! (2) bodies i and j
      real(wp), intent(in) :: f                  !! prescribed angle [rad]
      real(wp), intent(in) :: f_dot              !! its first time derivative [rad/s]
      real(wp), intent(in) :: f_dot_dot          !! its second time derivative [rad/s^2]
      type(rows_t), intent(inout) :: rows        !! rows

      call put_row(rows, row, motion, body, self%angle(k, motion, body, f), f, f_dot, f_dot_dot)
   end subroutine frames_write_row

end module turn_frames
