!> Positions, velocities and accelerations of all bodies at one instant, and the loads on them.
!>
!> One column per body, column 0 the ground. A planar body is a special case of a spatial one
!> (z = 0, rotation about z), so that forces and contacts are written once, in 3-vectors.
module motion
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: cross, loads_t, motion_t, new_loads, new_motion, point_position, point_velocity
   public :: apply_force

   !> What only the bodies of a spatial scene have. Their frames are those of their principal axes.
   type :: spatial_motion_t
      real(wp), allocatable :: p(:, :)        !! (4, 0:n) Euler parameters, of any length [1]
      real(wp), allocatable :: spin(:, :)     !! (3, 0:n) angular velocity, body frame [rad/s]
      real(wp), allocatable :: rise(:, :)     !! (3, 0:n) angular acceleration, body frame, if set [rad/s^2]
      real(wp), allocatable :: own(:, :, :)   !! (3, 3, 0:n) body frame to the frame that the deck gives the body [1]
   end type spatial_motion_t

   !> Kinematic state of all bodies.
   type :: motion_t
      real(wp) :: t = 0.0_wp                  !! time [s]
      integer(i8) :: number = 0               !! another one after each change of positions or velocities; 0: nobody counts
      real(wp), allocatable :: r(:, :)        !! (3, 0:n) centre of mass, world frame [m]
      real(wp), allocatable :: rot(:, :, :)   !! (3, 3, 0:n) body frame to world frame [1]
      real(wp), allocatable :: v(:, :)        !! (3, 0:n) velocity of the centre of mass, world frame [m/s]
      real(wp), allocatable :: omega(:, :)    !! (3, 0:n) angular velocity, world frame [rad/s]
      real(wp), allocatable :: angle(:)       !! (0:n) planar angle about z, turns counted [rad]
      real(wp), allocatable :: a(:, :)        !! (3, 0:n) acceleration of the centre of mass, if set [m/s^2]
      real(wp), allocatable :: alpha(:, :)    !! (3, 0:n) angular acceleration, world frame, if set [rad/s^2]
      type(spatial_motion_t) :: spatial       !! of a spatial scene, else empty
      real(wp), allocatable :: states(:)      !! (rows) values of the deck's state equations; none: unallocated [any]
   end type motion_t

   !> Applied loads on all bodies.
   type :: loads_t
      real(wp), allocatable :: force(:, :)    !! (3, 0:n) force, world frame [N]
      real(wp), allocatable :: moment(:, :)   !! (3, 0:n) moment about the centre of mass, world frame [N.m]
      logical :: is_weight = .false.          !! the forces are those of gravity alone, and there are no moments
   end type loads_t

   !> Vector product, for all that need not have it inlined.
   interface cross
      module procedure across
   end interface cross

contains

   !> Storage for n bodies, all at rest in the origin.
   subroutine new_motion(n, motion, own)
      integer, intent(in) :: n                         !! number of bodies
      type(motion_t), intent(out) :: motion            !! their motion
      real(wp), intent(in), optional :: own(:, :, 0:)  !! (3, 3, 0:n) of a spatial scene: body frames to those of the deck [1]

      integer :: k

      allocate (motion%r(3, 0:n), motion%v(3, 0:n), motion%omega(3, 0:n), motion%a(3, 0:n), motion%alpha(3, 0:n), source=0.0_wp)
      allocate (motion%rot(3, 3, 0:n), source=0.0_wp)
      allocate (motion%angle(0:n), source=0.0_wp)
      do k = 1, 3
         motion%rot(k, k, :) = 1.0_wp
      end do
      if (.not. present(own)) return
      associate (spatial => motion%spatial)
         allocate (spatial%p(4, 0:n), spatial%spin(3, 0:n), spatial%rise(3, 0:n), source=0.0_wp)
         allocate (spatial%own(3, 3, 0:n), source=own)
         spatial%p(1, :) = 1.0_wp
      end associate
   end subroutine new_motion

   !> Storage for the loads on n bodies.
   subroutine new_loads(n, loads)
      integer, intent(in) :: n             !! number of bodies
      type(loads_t), intent(out) :: loads  !! their loads, zero

      allocate (loads%force(3, 0:n), loads%moment(3, 0:n), source=0.0_wp)
   end subroutine new_loads

   include "../../foundation/numerics/across.inc"

   !> Position of a body-fixed point, r + A s'. Flores et al. (2008), eq. (2.1).
   pure function point_position(motion, body, s) result(r)
      type(motion_t), intent(in) :: motion  !! the motion
      integer, intent(in) :: body           !! the body
      real(wp), intent(in) :: s(3)          !! (3) point in the body's frame [m]
      real(wp) :: r(3)                      !! (3) its position, world frame [m]

      r = motion%r(:, body) + motion%rot(:, 1, body)*s(1) + motion%rot(:, 2, body)*s(2) + motion%rot(:, 3, body)*s(3)
   end function point_position

   !> Velocity of the material point of a body that is at a world position now.
   pure function point_velocity(motion, body, p) result(v)
      type(motion_t), intent(in) :: motion  !! the motion
      integer, intent(in) :: body           !! the body
      real(wp), intent(in) :: p(3)          !! (3) the position, world frame [m]
      real(wp) :: v(3)                      !! (3) velocity, world frame [m/s]

      v = motion%v(:, body) + cross(motion%omega(:, body), p - motion%r(:, body))
   end function point_velocity

   !> Add a force that acts on a body at a world position.
   pure subroutine apply_force(loads, motion, body, p, f)
      type(loads_t), intent(inout) :: loads  !! the loads
      type(motion_t), intent(in) :: motion   !! the motion
      integer, intent(in) :: body            !! the body
      real(wp), intent(in) :: p(3)           !! (3) where the force acts, world frame [m]
      real(wp), intent(in) :: f(3)           !! (3) the force, world frame [N]

      loads%force(:, body) = loads%force(:, body) + f
      loads%moment(:, body) = loads%moment(:, body) + cross(p - motion%r(:, body), f)
   end subroutine apply_force

end module motion
