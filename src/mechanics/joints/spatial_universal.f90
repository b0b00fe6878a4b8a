!> Universal (Hooke) joint: two points coincide, and the arm of the cross in i is at right angles to that in j.
!>
!> Phi = [ P_i - P_j,  z_i . z_j ]                                          (4 rows)
!>
!> Its two angles are those of the cross, whose arms are z_i and z_j: of the cross against i about z_i, of j against the cross about
!> z_j, both zero where the deck puts the bodies.
!>
!> Signs, frames: `spatial_joint`. Source: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), section 7.2.3.
!> Limits: the axis of j must be given, since that of i is not it.
module spatial_universal
   use coordinates, only: coordinates_t
   use item, only: item_t
   use joint_set, only: of_own
   use kind_info, only: add_channel, add_direction, kind_info_t, free_spherical
   use kinds, only: wp
   use motion, only: motion_t
   use rows, only: rows_t
   use spatial_joint, only: across, add_joint_columns, add_spatial_channels, at_point, set_joint_frames, spatial_joint_t, &
      spatial_report_own
   use spatial_rows, only: angle_of, dot_of_axes, scalar_t, wrapped
   implicit none (type, external)
   private
   public :: spatial_universal_t

   ! channels, behind those of joints with axes
   integer, parameter :: of_angle = of_own + 6          !! of the cross against i, and of j against the cross
   integer, parameter :: of_angular_rate = of_own + 8   !! their rates

   !> All joints of the kind.
   type, extends(spatial_joint_t) :: spatial_universal_t
      real(wp), allocatable, private :: zero(:, :)   !! (2, n) both angles where the deck puts the bodies, from x of the joint [rad]
   contains
      procedure, nopass :: info => universal_info
      procedure :: prepare => universal_prepare
      procedure :: set_start => universal_set_start
      procedure :: report_own => universal_report_own
   end type spatial_universal_t

contains

   !> Description of the kind.
   function universal_info() result(info)
      type(kind_info_t) :: info  !! name, columns, rows and channels

      info%name = "joint.universal"
      info%help = "universal joint: two points coincide and two axes stay perpendicular"
      info%source = "Nikravesh (1988), section 7.2.3"
      info%n_row = 4
      info%free = free_spherical
      call add_joint_columns(info)
      call add_direction(info, "axis_i", "arm of the cross, in the frame of the body of i")
      call add_direction(info, "axis_j", "arm of the cross, in the frame of the body of j")
      call add_spatial_channels(info)
      call add_channel(info, "angle_i", "rad", "joint", 1, "angle of the cross relative to i about its arm in i, zero at the given &
                       &positions, between -pi and pi", of_angle)
      call add_channel(info, "angle_j", "rad", "joint", 1, "angle of j relative to the cross about its arm in j, zero at the given &
                       &positions, between -pi and pi", of_angle + 1)
      call add_channel(info, "angular_rate_i", "rad/s", "joint", 1, "rate of angle_i", of_angular_rate)
      call add_channel(info, "angular_rate_j", "rad/s", "joint", 1, "rate of angle_j", of_angular_rate + 1)
   end function universal_info

   !> Elements of the joint.
   subroutine universal_prepare(self, items, angle)
      class(spatial_universal_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)   !! (n) rows of the table
      real(wp), intent(in) :: angle(0:)      !! (0:bodies) not used [rad]

      call self%take_axes(items, [at_point, across(3, 3)])
      allocate (self%zero(2, self%n), source=0.0_wp)
   end subroutine universal_prepare

   !> Frames, and the angles where the deck puts the bodies.
   subroutine universal_set_start(self, motion)
      class(spatial_universal_t), intent(inout) :: self  !! the set, prepared
      type(motion_t), intent(in) :: motion               !! bodies where the deck puts them

      type(scalar_t) :: angle
      integer :: k, side

      call set_joint_frames(self, motion)
      self%zero = 0.0_wp
      do k = 1, self%n
         do side = 1, 2
            angle = angle_of_cross(self, k, side, motion)
            self%zero(side, k) = angle%value
         end do
      end do
   end subroutine universal_set_start

   !> Angle of the cross against i about z_i: that of z_j in the plane x_i, y_i. Of j against the cross about z_j: less that of z_i
   !> in the plane x_j, y_j.
   pure function angle_of_cross(self, k, side, motion) result(angle)
      class(spatial_universal_t), intent(in) :: self   !! the set
      integer, intent(in) :: k                         !! item
      integer, intent(in) :: side                      !! 1: about the arm in i, 2: about that in j
      type(motion_t), intent(in) :: motion             !! positions and velocities
      type(scalar_t) :: angle                          !! from where it was at the start [rad]

      associate (body => self%body(:, k), frame_i => self%axes%frame_i(:, :, k), frame_j => self%axes%frame_j(:, :, k))
         if (side == 1) then
            angle = angle_of(dot_of_axes(motion, body, frame_i(:, 1), frame_j(:, 3)), &
                             dot_of_axes(motion, body, frame_i(:, 2), frame_j(:, 3)))
         else
            angle = angle_of(dot_of_axes(motion, body, frame_i(:, 3), frame_j(:, 1)), &
                             dot_of_axes(motion, body, frame_i(:, 3), frame_j(:, 2)))
            angle%value = -angle%value
            angle%rate = -angle%rate
         end if
      end associate
      angle%value = wrapped(angle%value - self%zero(side, k))
   end function angle_of_cross

   !> A channel of its own: the angles here, the others as of any joint with axes.
   subroutine universal_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      class(spatial_universal_t), intent(in) :: self   !! the set
      integer, intent(in) :: code                      !! the channel
      integer, intent(in) :: k                         !! item of the set
      type(motion_t), intent(in) :: motion             !! positions and velocities
      class(coordinates_t), intent(in) :: coordinates  !! what loads on the rates are
      type(rows_t), intent(in) :: rows                 !! rows at the motion
      real(wp), intent(in), contiguous :: lambda(:)    !! (rows) multipliers [N or N.m]
      real(wp), intent(inout), contiguous :: value(:)  !! (components) the value [any]

      type(scalar_t) :: angle

      select case (code)
      case (of_angle, of_angle + 1)
         angle = angle_of_cross(self, k, code - of_angle + 1, motion)
         value = angle%value
      case (of_angular_rate, of_angular_rate + 1)
         angle = angle_of_cross(self, k, code - of_angular_rate + 1, motion)
         value = angle%rate
      case default
         call spatial_report_own(self, code, k, motion, coordinates, rows, lambda, value)
      end select
   end subroutine universal_report_own

end module spatial_universal
