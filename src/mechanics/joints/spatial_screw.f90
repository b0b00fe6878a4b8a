!> Screw joint: a cylindrical joint whose displacement goes with its turn.
!>
!> Phi = [ x_i . z_j,  y_i . z_j,  x_i . d,  y_i . d,  z_i . d - p (theta - theta_0)/(2 pi) - h ]       (5 rows)
!>
!> with the pitch p, the angle theta of j against i about z_i, and h the displacement where the deck puts the bodies, at theta_0.
!> Which turn the nut is in, its displacement says: the last row is taken next to zero, in whole pitches.
!>
!> Signs: p > 0 is a right-handed thread. Frames: `spatial_joint`. Source: Nikravesh (1988), section 7.2.4.
!> Limits: no self-locking, as there is no friction.
module spatial_screw
   use item, only: item_t
   use kind_info, only: add_number, dim_length, kind_info_t
   use kinds, only: pi, wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_joint, only: across, add_axis_columns, add_joint_columns, add_slide_channels, add_spatial_channels, &
      add_turn_channels, beside, set_joint_frames, spatial_joint_t
   use spatial_rows, only: angle_between, dot_with_span, put_row, scalar_t
   implicit none (type, external)
   private
   public :: spatial_screw_t

   !> All screw joints.
   type, extends(spatial_joint_t) :: spatial_screw_t
      real(wp), allocatable, private :: pitch(:)   !! (n) displacement in one turn [m]
      real(wp), allocatable, private :: start(:)   !! (n) z_i . d - p theta/(2 pi) at the start of the deck [m]
   contains
      procedure, nopass :: info => screw_info
      procedure :: prepare => screw_prepare
      procedure :: set_start => screw_set_start
      procedure :: evaluate => screw_evaluate
   end type spatial_screw_t

contains

   !> Description of the kind.
   function screw_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.screw"
      info%help = "a nut on a screw: displacement along the axis is proportional to the angle about it"
      info%source = "Nikravesh (1988), section 7.2.4"
      info%n_row = 5
      call add_joint_columns(info)
      call add_axis_columns(info, "axis of the screw")
      call add_number(info, "pitch", dim_length, "displacement of j along the axis per revolution; positive: right-handed")
      call add_spatial_channels(info)
      call add_turn_channels(info)
      call add_slide_channels(info)
   end function screw_info

   !> Pitches.
   subroutine screw_prepare(self, items, angle)
      class(spatial_screw_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)           !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)              !! (0:bodies) not used [rad]

      integer :: k

      call self%take_axes(items, [across(1, 3), across(2, 3), beside(1), beside(2)])
      self%pitch = [(items(k)%number("pitch"), k=1, self%n)]
      allocate (self%start(self%n), source=0.0_wp)
   end subroutine screw_prepare

   !> Where the threads start.
   subroutine screw_set_start(self, motion)
      class(spatial_screw_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion           !! bodies where the deck puts them

      type(scalar_t) :: x
      integer :: k

      call set_joint_frames(self, motion)
      do k = 1, self%n
         x = advance(self, k, motion)
         self%start(k) = x%value
      end do
   end subroutine screw_set_start

   !> Displacement less that of the turn.
   pure function advance(self, k, motion) result(x)
      class(spatial_screw_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                     !! item
      type(motion_t), intent(in) :: motion         !! positions and velocities
      type(scalar_t) :: x                          !! the difference [m]

      type(scalar_t) :: angle
      real(wp) :: part

      x = dot_with_span(motion, self%body(:, k), self%axes%frame_i(:, 3, k), self%s_i(:, k), self%s_j(:, k))
      angle = angle_between(motion, self%body(:, k), self%axes%frame_i(:, :, k), self%axes%frame_j(:, :, k))
      part = self%pitch(k)/(2.0_wp*pi)
      x%value = x%value - part*angle%value
      x%rate = x%rate - part*angle%rate
      x%bend = x%bend - part*angle%bend
      x%turn_i = x%turn_i - part*angle%turn_i
      x%turn_j = x%turn_j - part*angle%turn_j
   end function advance

   !> Fill the rows of all items.
   subroutine screw_evaluate(self, t, motion, rows)
      class(spatial_screw_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                   !! time [s]
      type(motion_t), intent(in) :: motion        !! positions and velocities
      type(rows_t), intent(inout) :: rows         !! rows, those of the set are filled

      type(scalar_t) :: x
      integer :: k

      call self%fill_rows(motion, rows)
      do k = 1, self%n
         x = advance(self, k, motion)
         x%value = x%value - self%start(k)
         if (abs(self%pitch(k)) > 0.0_wp) x%value = x%value - self%pitch(k)*anint(x%value/self%pitch(k))
         call put_row(rows, self%first_row + self%n_row_item*k, motion, self%body(:, k), x, 0.0_wp, 0.0_wp, 0.0_wp)
      end do
   end subroutine screw_evaluate

end module spatial_screw
