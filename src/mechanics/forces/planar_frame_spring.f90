!> Elastic elements between a frame of body i and a frame of body j in the plane: what bushings and beams have in common.
!>
!> With the angles theta_i and theta_j of the frames and d from the point of i to that of j:
!>
!> psi = theta_j - theta_i,   u = R^T d - u_0,   R: rotation by theta_i + s psi,   s = 0: axes of i, s = 1/2: halfway to j
!>
!> With x = (u, psi), stiffness K and damping C (both symmetric) and preload p:
!>
!> Q = K x + C x' + p,   stored energy = x^T K x/2 + p . x,   lost power = x'^T C x'
!>
!> The loads are those of the virtual work -Q . dx: with f = R Q_u and m = d x f
!>
!> force f on i at its point and -f on j at its,   couples m - h on i and h on j,   h = s m - Q_psi
!>
!> so that forces and moments are in balance, and the power is that of energy and loss, at any rotation; turns are counted.
!> Signs: x is that of j relative to i; f pulls the points together where u and K are positive. Source: from the definition.
!> Limits: none.
module planar_frame_spring
   use bodies, only: points_t
   use force_set, only: force_set_t
   use item, only: item_t
   use kind_info, only: add_channel, kind_info_t
   use kinds, only: wp
   use motion, only: apply_force, loads_t, motion_t, point_position, point_velocity
   implicit none (type, external)
   private
   public :: add_frame_spring_channels, frame_spring_t

   ! channels
   integer, parameter :: of_force = 1         !! force
   integer, parameter :: of_moment = 2        !! moment
   integer, parameter :: of_deflection = 3    !! u
   integer, parameter :: of_rotation = 4      !! psi
   integer, parameter :: of_inner_force = 5   !! Q_u
   integer, parameter :: of_inner_moment = 6  !! Q_psi
   integer, parameter :: of_power = 7         !! power given to the mechanism

   !> Elastic elements of a kind; the kind sets all components.
   type, abstract, extends(force_set_t) :: frame_spring_t
      integer, allocatable :: body(:, :)            !! (2, n) bodies i and j, 0: ground
      real(wp), allocatable :: s(:, :, :)           !! (3, 2, n) points of i and of j, frames of the bodies [m]
      real(wp), allocatable :: offset(:, :)         !! (2, n) angles of the frames of i and j in their bodies [rad]
      real(wp) :: share = 0.0_wp                    !! s: part of the rotation that the axes make, 0 or 1/2 [1]
      real(wp), allocatable :: free(:, :)           !! (2, n) u_0 [m]
      real(wp), allocatable :: stiffness(:, :, :)   !! (3, 3, n) K [N/m, N/rad or N.m/rad]
      real(wp), allocatable :: damping(:, :, :)     !! (3, 3, n) C [N.s/m, N.s/rad or N.m.s/rad]
      real(wp), allocatable :: preload(:, :)        !! (3, n) p [N or N.m]
   contains
      procedure :: make_storage
      procedure :: evaluate => frame_spring_evaluate
      procedure :: elastic_energy => frame_spring_elastic_energy
      procedure :: lost_power => frame_spring_lost_power
      procedure :: load_on => frame_spring_load_on
      procedure :: report => frame_spring_report
      procedure :: bodies_of => frame_spring_bodies
   end type frame_spring_t

   !> Deflection of an item, and its loads.
   type :: deflection_t
      real(wp) :: x(3) = 0.0_wp        !! (3) u and psi [m and rad]
      real(wp) :: rate(3) = 0.0_wp     !! (3) their rates [m/s and rad/s]
      real(wp) :: q(3) = 0.0_wp        !! (3) Q [N and N.m]
      real(wp) :: p(3, 2) = 0.0_wp     !! (3, 2) points of i and j, world frame [m]
      real(wp) :: force(3) = 0.0_wp    !! (3) on the body of i at its point, world frame [N]
      real(wp) :: couple(2) = 0.0_wp   !! (2) on the bodies of i and j [N.m]
   end type deflection_t

contains

   include "frame_spring.inc"

   !> Channels of every element.
   subroutine add_frame_spring_channels(info, place)
      type(kind_info_t), intent(inout) :: info   !! the kind, channels are added
      character(*), intent(in) :: place          !! where along the element its inner forces are, for the help

      call add_channel(info, "force", "N", "world", 2, "force on the body of i at its point", of_force)
      call add_channel(info, "moment", "N.m", "world", 1, "moment on the body of i about its point", of_moment)
      call add_channel(info, "deflection", "m", "joint", 2, "displacement of j relative to i, along the axes of the element", &
                       of_deflection)
      call add_channel(info, "rotation", "rad", "none", 1, "angle of j relative to i", of_rotation)
      call add_channel(info, "inner_force", "N", "joint", 2, "force along the axes of the element"//place// &
                       ", positive where it opposes a positive displacement", of_inner_force)
      call add_channel(info, "inner_moment", "N.m", "none", 1, "moment"//place// &
                       ", positive where it opposes a positive rotation", of_inner_moment)
      call add_channel(info, "power", "W", "none", 1, "total power of stiffness and damping on the bodies", of_power)
   end subroutine add_frame_spring_channels

   !> Storage for the rows of a table, without stiffness; names, bodies and points are set.
   subroutine make_storage(self, items, points)
      class(frame_spring_t), intent(inout) :: self  !! the set
      type(item_t), intent(in) :: items(:)          !! (n) rows of the table
      type(points_t), intent(in) :: points          !! all points

      integer :: n

      n = size(items)
      self%n = n
      allocate (self%names(n))
      allocate (self%body(2, n), source=0)
      allocate (self%s(3, 2, n), self%offset(2, n), self%free(2, n), self%stiffness(3, 3, n), self%damping(3, 3, n), &
                self%preload(3, n), source=0.0_wp)
      call take_rows(self, items, points)
   end subroutine make_storage

   !> Deflection and loads of an item.
   pure subroutine find_deflection(self, k, motion, it)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(deflection_t), intent(out) :: it      !! the deflection

      real(wp) :: angle, along(3), d(3), m, v(3), w

      associate (i => self%body(1, k), j => self%body(2, k))
         it%p(:, 1) = point_position(motion, i, self%s(:, 1, k))
         it%p(:, 2) = point_position(motion, j, self%s(:, 2, k))
         d = it%p(:, 2) - it%p(:, 1)
         it%x(3) = motion%angle(j) + self%offset(2, k) - motion%angle(i) - self%offset(1, k)
         it%rate(3) = motion%omega(3, j) - motion%omega(3, i)
         angle = motion%angle(i) + self%offset(1, k) + self%share*it%x(3)
         along = [cos(angle), sin(angle), 0.0_wp]
         w = motion%omega(3, i) + self%share*it%rate(3)
         v = point_velocity(motion, j, it%p(:, 2)) - point_velocity(motion, i, it%p(:, 1)) - w*[-d(2), d(1), 0.0_wp]
         it%x(1:2) = [along(1)*d(1) + along(2)*d(2), along(1)*d(2) - along(2)*d(1)] - self%free(:, k)
         it%rate(1:2) = [along(1)*v(1) + along(2)*v(2), along(1)*v(2) - along(2)*v(1)]
         it%q = matmul(self%stiffness(:, :, k), it%x) + matmul(self%damping(:, :, k), it%rate) + self%preload(:, k)
         it%force = it%q(1)*along + it%q(2)*[-along(2), along(1), 0.0_wp]
         m = d(1)*it%force(2) - d(2)*it%force(1)
         it%couple(2) = self%share*m - it%q(3)
         it%couple(1) = m - it%couple(2)
      end associate
   end subroutine find_deflection

   !> Add the loads of all items; none of their power is but stored or lost.
   subroutine frame_spring_evaluate(self, t, motion, loads, power)
      class(frame_spring_t), intent(in) :: self  !! the set
      real(wp), intent(in) :: t                  !! time, not used [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      type(loads_t), intent(inout) :: loads      !! loads on the bodies
      real(wp), intent(inout) :: power           !! left as it is [W]

      type(deflection_t) :: it
      integer :: k

      do k = 1, self%n
         call find_deflection(self, k, motion, it)
         associate (i => self%body(1, k), j => self%body(2, k))
            call apply_force(loads, motion, i, it%p(:, 1), it%force)
            call apply_force(loads, motion, j, it%p(:, 2), -it%force)
            loads%moment(3, i) = loads%moment(3, i) + it%couple(1)
            loads%moment(3, j) = loads%moment(3, j) + it%couple(2)
         end associate
      end do
   end subroutine frame_spring_evaluate

   !> Load of an item on the body of i or j, about its point.
   subroutine frame_spring_load_on(self, k, side, t, motion, force, moment, place)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: k                   !! item
      integer, intent(in) :: side                !! 1: on the body of i, 2: on that of j
      real(wp), intent(in) :: t                  !! time, not used [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(out) :: force(3)          !! (3) world frame [N]
      real(wp), intent(out) :: moment(3)         !! (3) about the point, world frame [N.m]
      real(wp), intent(out) :: place(3)          !! (3) the point, world frame [m]

      type(deflection_t) :: it

      call find_deflection(self, k, motion, it)
      force = it%force
      if (side == 2) force = -force
      moment = [0.0_wp, 0.0_wp, it%couple(side)]
      place = it%p(:, side)
   end subroutine frame_spring_load_on

   !> Values of a channel for all items.
   subroutine frame_spring_report(self, code, t, motion, values)
      class(frame_spring_t), intent(in) :: self  !! the set
      integer, intent(in) :: code                !! the channel
      real(wp), intent(in) :: t                  !! time, not used [s]
      type(motion_t), intent(in) :: motion       !! positions and velocities
      real(wp), intent(inout) :: values(:, :)    !! (components, n) values [N, N.m, m, rad or W]

      type(deflection_t) :: it
      integer :: k

      do k = 1, self%n
         call find_deflection(self, k, motion, it)
         select case (code)
         case (of_force); values(:, k) = it%force(1:2)
         case (of_moment); values(1, k) = it%couple(1)
         case (of_deflection); values(:, k) = it%x(1:2)
         case (of_rotation); values(1, k) = it%x(3)
         case (of_inner_force); values(:, k) = it%q(1:2)
         case (of_inner_moment); values(1, k) = it%q(3)
         case (of_power); values(1, k) = -dot_product(it%q, it%rate)
         end select
      end do
   end subroutine frame_spring_report

end module planar_frame_spring
