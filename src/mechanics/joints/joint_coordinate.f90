!> Coordinate of a joint, with its rate and what moves it: the angle about its axis, or the displacement along it.
!>
!> In space the angle is that of x_j against x_i about z_i, and the displacement z_i . d with d = P_j - P_i (`spatial_rows`). In the
!> plane the angle is that of j less that of i, and the displacement s . d along the guide of `joint_translational`: the same with
!> z along s.
!>
!> Signs: counter-clockwise of j relative to i; positive along the axis. Source: Nikravesh (1988), section 7.2.4; Flores et al.
!> (2008), eq. (2.8). Limits: in space an angle is known to whole turns; the caller counts them.
module joint_coordinate
   use joint_set, only: joint_set_t
   use joint_translational, only: joint_translational_t
   use kinds, only: wp
   use motion, only: motion_t
   use spatial_joint, only: spatial_joint_t
   use spatial_rows, only: angle_between, axis_of, dot_with_span, scalar_t
   implicit none (type, external)
   private
   public :: joint_coordinate_t, new_coordinate

   !> A coordinate of a joint.
   type :: joint_coordinate_t
      logical :: is_angle = .true.              !! the angle; else the displacement
      integer :: body(2) = 0                    !! (2) bodies i and j, 0: ground
      real(wp), private :: s_i(3) = 0.0_wp      !! (3) point of i, its frame [m]
      real(wp), private :: s_j(3) = 0.0_wp      !! (3) point of j, its frame [m]
      real(wp), private :: of_i(3, 3) = 0.0_wp  !! (3, 3) axes x, y, z of the joint as columns, frame of body i [1]
      real(wp), private :: of_j(3, 3) = 0.0_wp  !! (3, 3) those in j [1]
   contains
      procedure :: find => coordinate_find
      procedure :: place => coordinate_place
   end type joint_coordinate_t

contains

   !> The coordinate of a joint: the angle, or the displacement.
   function new_coordinate(joint, is_angle) result(coordinate)
      class(joint_set_t), intent(in) :: joint   !! a set of one item, the joint, with its start
      logical, intent(in) :: is_angle           !! whether it is the angle
      type(joint_coordinate_t) :: coordinate    !! the coordinate

      coordinate%is_angle = is_angle
      coordinate%body = joint%body(:, 1)
      coordinate%s_i = joint%s_i(:, 1)
      coordinate%s_j = joint%s_j(:, 1)
      select type (joint)
      class is (spatial_joint_t)
         coordinate%of_i = joint%axes%frame_i(:, :, 1)
         coordinate%of_j = joint%axes%frame_j(:, :, 1)
      class is (joint_translational_t)
         coordinate%of_i(:2, 3) = joint%slide_axis_of(1)
      end select
   end function new_coordinate

   !> Its value, rate, and what moves it.
   pure function coordinate_find(self, motion) result(x)
      class(joint_coordinate_t), intent(in) :: self   !! the coordinate
      type(motion_t), intent(in) :: motion            !! positions and velocities
      type(scalar_t) :: x                             !! the coordinate [rad or m]

      if (.not. self%is_angle) then
         x = dot_with_span(motion, self%body, self%of_i(:, 3), self%s_i, self%s_j)
      else if (allocated(motion%spatial%own)) then
         x = angle_between(motion, self%body, self%of_i, self%of_j)
      else
         x%value = motion%angle(self%body(2)) - motion%angle(self%body(1))
         x%rate = motion%omega(3, self%body(2)) - motion%omega(3, self%body(1))
         x%turn_i(3) = -1.0_wp
         x%turn_j(3) = 1.0_wp
      end if
   end function coordinate_find

   !> Where a force along the displacement acts on both bodies: the point of j.
   pure function coordinate_place(self, motion) result(p)
      class(joint_coordinate_t), intent(in) :: self   !! the coordinate
      type(motion_t), intent(in) :: motion            !! positions
      real(wp) :: p(3)                                !! (3) the point, world frame [m]

      p = motion%r(:, self%body(2)) + axis_of(motion, self%body(2), self%s_j)
   end function coordinate_place

end module joint_coordinate
