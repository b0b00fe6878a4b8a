!> Coordinates of bodies in the plane: x, y of the centre of mass and the angle about z, their derivatives as rates.
!>
!> r = (x, y, 0),   A = [ cos -sin; sin cos ],   v = (x', y', 0),   omega = (0, 0, angle').
!> The mass matrix is diag(m, m, I), and no load comes from the motion itself. Angles count turns.
!> Source: Flores et al. (2008), section 2.3.
module planar_coordinates
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: bodies_info, bodies_t, of_acceleration, of_angle, of_angular_acceleration, of_angular_velocity, &
      of_position, of_velocity
   use coordinates, only: coordinates_t, most_rates
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use readings, only: reading_t, readings_t
   implicit none (type, external)
   private
   public :: new_planar_coordinates, planar_coordinates_t, set_planar_motion

   integer, parameter :: n = 3   !! coordinates of a body, and rates

   !> x, y and the angle.
   type, extends(coordinates_t) :: planar_coordinates_t
   contains
      procedure :: read_start => planar_read_start
      procedure :: find_masses => planar_find_masses
      procedure :: move => planar_move
      procedure :: read_motion => planar_read_motion
      procedure :: accelerate => planar_accelerate
      procedure :: rates => planar_rates
      procedure :: add_rates => planar_add_rates
      procedure :: gather => planar_gather
      procedure :: add_change => planar_add_change
      procedure :: difference => planar_difference
      procedure :: weigh_positions => planar_weigh_positions
      procedure :: to_local => planar_to_local
      procedure :: from_local => planar_from_local
      procedure :: find_acceleration => planar_find_acceleration
      procedure, nopass :: kinetic_energy => planar_kinetic_energy
      procedure, nopass :: split_load => planar_split_load
      procedure, nopass :: report => planar_report
      procedure, nopass :: along => planar_along
      procedure, nopass :: bodies_info
   end type planar_coordinates_t

   interface
      !> Along the bodies' axes; turns are the same.
      pure module subroutine planar_to_local(self, n, q, q_change, v_change, x, w)
         implicit none (type, external)
         class(planar_coordinates_t), intent(in) :: self   !! the coordinates
         integer, intent(in) :: n                          !! how many bodies
         real(wp), intent(in) :: q(self%n_q, n)            !! (3, n) x, y, angle [m, m, rad]
         real(wp), intent(in) :: q_change(self%n_q, n)     !! (3, n) their changes [m, m, rad]
         real(wp), intent(in) :: v_change(self%n_v, n)     !! (3, n) changes of the rates [m/s, m/s, rad/s]
         real(wp), intent(out) :: x(self%n_v, n)           !! (3, n) displacements and turns, body frames [m, m, rad]
         real(wp), intent(out) :: w(self%n_v, n)           !! (3, n) changes of velocities, body frames [m/s, m/s, rad/s]
      end subroutine planar_to_local

      !> Along the world's axes.
      pure module subroutine planar_from_local(self, n, q, x, w, q_change, v_change)
         implicit none (type, external)
         class(planar_coordinates_t), intent(in) :: self   !! the coordinates
         integer, intent(in) :: n                          !! how many bodies
         real(wp), intent(in) :: q(self%n_q, n)            !! (3, n) x, y, angle [m, m, rad]
         real(wp), intent(in) :: x(self%n_v, n)            !! (3, n) displacements and turns, body frames [m, m, rad]
         real(wp), intent(in) :: w(self%n_v, n)            !! (3, n) changes of velocities, body frames [m/s, m/s, rad/s]
         real(wp), intent(out) :: q_change(self%n_q, n)    !! (3, n) changes of the coordinates [m, m, rad]
         real(wp), intent(out) :: v_change(self%n_v, n)    !! (3, n) changes of the rates [m/s, m/s, rad/s]
      end subroutine planar_from_local

      !> Values that are read, body by body.
      pure module subroutine planar_report(readings, motion, values)
         implicit none (type, external)
         type(readings_t), intent(in) :: readings   !! channels that are read
         type(motion_t), intent(in) :: motion       !! the motion, accelerations too
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine planar_report
   end interface

contains

   include "../../foundation/numerics/sine_cosine.inc"

   !> The coordinates of the plane.
   pure function new_planar_coordinates() result(coordinates)
      type(planar_coordinates_t) :: coordinates  !! x, y, angle

      coordinates%n_q = n
      coordinates%n_v = n
      coordinates%n_axis = 2
      coordinates%is_turn = [.false., .false., .true.]
   end function new_planar_coordinates

   !> Positions and velocities as the deck gives them.
   pure subroutine planar_read_start(self, bodies, q, v)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      type(bodies_t), intent(in) :: bodies              !! bodies of the deck
      real(wp), intent(out) :: q(:)                     !! (3 bodies) x, y, angle [m, m, rad]
      real(wp), intent(out) :: v(:)                     !! (3 bodies) their rates [m/s, m/s, rad/s]

      integer :: k

      do k = 1, bodies%n
         q(n*k - 2:n*k) = [bodies%r(1:2, k), bodies%angle(k)]
         v(n*k - 2:n*k) = [bodies%v(1:2, k), bodies%omega(k)]
      end do
   end subroutine planar_read_start

   !> Mass, mass, moment of inertia.
   pure subroutine planar_find_masses(self, bodies, mass)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      type(bodies_t), intent(in) :: bodies              !! bodies of the deck
      real(wp), intent(out) :: mass(:, :)               !! (3, bodies) masses [kg, kg, kg.m^2]

      integer :: k

      do k = 1, bodies%n
         mass(:, k) = [bodies%mass(k), bodies%mass(k), bodies%inertia(k)]
      end do
   end subroutine planar_find_masses

   !> Positions, rotations and velocities of some bodies.
   pure subroutine planar_move(self, n, body, q, v, motion)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                          !! how many bodies
      integer, intent(in) :: body(n)                    !! (n) which
      real(wp), intent(in) :: q(self%n_q, n)            !! (3, n) x, y, angle [m, m, rad]
      real(wp), intent(in) :: v(self%n_v, n)            !! (3, n) their rates [m/s, m/s, rad/s]
      type(motion_t), intent(inout) :: motion           !! the motion

      call fill_planar(n, body, ubound(motion%angle, 1), q, v, motion%r, motion%rot, motion%v, motion%omega, motion%angle)
   end subroutine planar_move

   !> Coordinates and rates of a body from its motion.
   pure subroutine planar_read_motion(self, motion, body, q, v)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      type(motion_t), intent(in) :: motion              !! the motion
      integer, intent(in) :: body                       !! the body
      real(wp), intent(out) :: q(self%n_q)              !! (3) x, y, angle [m, m, rad]
      real(wp), intent(out) :: v(self%n_v)              !! (3) their rates [m/s, m/s, rad/s]

      q = [motion%r(1:2, body), motion%angle(body)]
      v = [motion%v(1:2, body), motion%omega(3, body)]
   end subroutine planar_read_motion

   !> The same for all bodies, without an object.
   pure subroutine set_planar_motion(n, q, v, motion)
      integer, intent(in) :: n                  !! number of bodies
      real(wp), intent(in) :: q(3, n)           !! (3, n) x, y, angle of each body [m, m, rad]
      real(wp), intent(in) :: v(3, n)           !! (3, n) their rates [m/s, m/s, rad/s]
      type(motion_t), intent(inout) :: motion   !! the motion

      integer :: k

      call fill_planar(n, [(k, k=1, n)], n, q, v, motion%r, motion%rot, motion%v, motion%omega, motion%angle)
   end subroutine set_planar_motion

   !> Positions, rotations and velocities on plain arrays.
   pure subroutine fill_planar(n, body, n_body, q, v, r, rot, velocity, omega, angle)
      integer, intent(in) :: n                          !! how many bodies
      integer, intent(in) :: body(n)                    !! (n) which bodies
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: q(3, n)                   !! (3, n) x, y, angle of each of them [m, m, rad]
      real(wp), intent(in) :: v(3, n)                   !! (3, n) their rates [m/s, m/s, rad/s]
      real(wp), intent(inout) :: r(3, 0:n_body)         !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)    !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: velocity(3, 0:n_body)  !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)     !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(inout) :: angle(0:n_body)        !! (0:bodies) angles [rad]

      real(wp) :: c, s
      integer :: b, k

      do k = 1, n
         b = body(k)
         call sine_cosine(q(3, k), s, c)
         r(1, b) = q(1, k)
         r(2, b) = q(2, k)
         rot(1, 1, b) = c
         rot(2, 1, b) = s
         rot(1, 2, b) = -s
         rot(2, 2, b) = c
         velocity(1, b) = v(1, k)
         velocity(2, b) = v(2, k)
         omega(3, b) = v(3, k)
         angle(b) = q(3, k)
      end do
   end subroutine fill_planar

   !> Accelerations of some bodies.
   pure subroutine planar_accelerate(self, n, body, a, motion)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                          !! how many bodies
      integer, intent(in) :: body(n)                    !! (n) which
      real(wp), intent(in) :: a(self%n_v, n)            !! (3, n) second derivatives of x, y, angle [m/s^2, m/s^2, rad/s^2]
      type(motion_t), intent(inout) :: motion           !! the motion

      motion%a(1:2, body) = a(1:2, :)
      motion%alpha(3, body) = a(3, :)
   end subroutine planar_accelerate

   !> Derivatives of coordinates and rates. Status 1 if an acceleration is not a finite number.
   pure subroutine planar_rates(self, n, body, motion, a, q_dot, v_dot, status)
      class(planar_coordinates_t), intent(in) :: self    !! the coordinates
      integer, intent(in) :: n                           !! how many bodies
      integer, intent(in) :: body(n)                     !! (n) which
      type(motion_t), intent(in) :: motion               !! the motion
      real(wp), intent(in), contiguous :: a(:, 0:)       !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: q_dot(self%n_q, n)      !! (3, n) derivatives of the coordinates [m/s, m/s, rad/s]
      real(wp), intent(inout) :: v_dot(self%n_v, n)      !! (3, n) derivatives of the rates [m/s^2, m/s^2, rad/s^2]
      integer, intent(out) :: status                     !! 0: all finite

      call state_rates(n, body, ubound(motion%angle, 1), motion%v, motion%omega, a, q_dot, v_dot, status)
   end subroutine planar_rates

   !> The same on plain arrays.
   pure subroutine state_rates(n, unknown, n_body, v, omega, a, rates, accelerations, status)
      integer, intent(in) :: n                      !! number of unknown bodies
      integer, intent(in) :: unknown(n)             !! (n) their numbers
      integer, intent(in) :: n_body                 !! number of bodies
      real(wp), intent(in) :: v(3, 0:n_body)        !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: omega(3, 0:n_body)    !! (3, 0:bodies) angular velocities [rad/s]
      real(wp), intent(in) :: a(3, 0:n_body)        !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout) :: rates(3, n)        !! (3, n) derivatives of the coordinates [m/s, m/s, rad/s]
      real(wp), intent(inout) :: accelerations(3, n)   !! (3, n) derivatives of the rates [m/s^2, m/s^2, rad/s^2]
      integer, intent(out) :: status                !! 0: all finite

      real(wp) :: sum
      integer :: body, k

      sum = 0.0_wp
      do k = 1, n
         body = unknown(k)
         rates(1, k) = v(1, body)
         rates(2, k) = v(2, body)
         rates(3, k) = omega(3, body)
         accelerations(1, k) = a(1, body)
         accelerations(2, k) = a(2, body)
         accelerations(3, k) = a(3, body)
         sum = sum + (abs(a(1, body)) + abs(a(2, body)) + abs(a(3, body)))
      end do
      status = merge(0, 1, ieee_is_finite(sum))
   end subroutine state_rates

   !> Rates are the derivatives of the coordinates.
   pure subroutine planar_add_rates(self, n, body, motion, z, q_dot)
      class(planar_coordinates_t), intent(in) :: self    !! the coordinates
      integer, intent(in) :: n                           !! how many bodies
      integer, intent(in) :: body(n)                     !! (n) which
      type(motion_t), intent(in) :: motion               !! positions
      real(wp), intent(in), contiguous :: z(:, 0:)       !! (3, 0:bodies) rates [m/s, m/s, rad/s]
      real(wp), intent(inout) :: q_dot(self%n_q, n)      !! (3, n) derivatives of the coordinates, added to [m/s, m/s, rad/s]

      q_dot = q_dot + z(:, body)
   end subroutine planar_add_rates

   !> Forces in the plane and moments about z.
   pure subroutine planar_gather(self, n_body, mass, motion, loads, g)
      class(planar_coordinates_t), intent(in) :: self    !! the coordinates
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in), contiguous :: mass(:, :)     !! (3, bodies) mass, mass, moment of inertia [kg, kg, kg.m^2]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      type(loads_t), intent(in) :: loads                 !! forces and moments
      real(wp), intent(out), contiguous :: g(:, 0:)      !! (3, 0:bodies) loads on x, y, angle [N, N, N.m]

      call planar_loads(n_body, loads%force, loads%moment, g)
   end subroutine planar_gather

   !> The same on plain arrays.
   pure subroutine planar_loads(n, force, moment, g)
      integer, intent(in) :: n                      !! number of bodies
      real(wp), intent(in) :: force(3, 0:n)         !! (3, 0:n) forces [N]
      real(wp), intent(in) :: moment(3, 0:n)        !! (3, 0:n) moments about the centres of mass [N.m]
      real(wp), intent(out) :: g(3, 0:n)            !! (3, 0:n) loads on x, y, angle [N, N, N.m]

      integer :: k

      !GCC$ novector
      do k = 0, n
         g(1, k) = force(1, k)
         g(2, k) = force(2, k)
         g(3, k) = moment(3, k)
      end do
   end subroutine planar_loads

   !> Changes are those of the coordinates.
   pure subroutine planar_add_change(self, n, x, q)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                          !! how many bodies
      real(wp), intent(in) :: x(self%n_v, n)            !! (3, n) changes [m, m, rad]
      real(wp), intent(inout) :: q(self%n_q, n)         !! (3, n) coordinates [m, m, rad]

      q = q + x
   end subroutine planar_add_change

   !> Differences are those of the coordinates.
   pure subroutine planar_difference(self, n, from, to, x)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                          !! how many bodies
      real(wp), intent(in) :: from(self%n_q, n)         !! (3, n) coordinates [m, m, rad]
      real(wp), intent(in) :: to(self%n_q, n)           !! (3, n) coordinates [m, m, rad]
      real(wp), intent(out) :: x(self%n_v, n)           !! (3, n) changes [m, m, rad]

      x = to - from
   end subroutine planar_difference

   !> Scales of the coordinates: two lengths and an angle.
   pure subroutine planar_weigh_positions(self, length, n, scale)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      real(wp), intent(in) :: length                    !! that lengths are measured by [m]
      integer, intent(in) :: n                          !! how many bodies
      real(wp), intent(out) :: scale(self%n_q*n)        !! (3 n) scales [m, m, 1]

      scale(1::3) = length
      scale(2::3) = length
      scale(3::3) = 1.0_wp
   end subroutine planar_weigh_positions

   !> Derivatives of the rates of a body.
   pure subroutine planar_find_acceleration(self, motion, body, a)
      class(planar_coordinates_t), intent(in) :: self   !! the coordinates
      type(motion_t), intent(in) :: motion              !! the motion
      integer, intent(in) :: body                       !! the body
      real(wp), intent(out) :: a(self%n_v)              !! (3) derivatives of the rates [m/s^2, m/s^2, rad/s^2]

      a(1) = motion%a(1, body)
      a(2) = motion%a(2, body)
      a(3) = motion%alpha(3, body)
   end subroutine planar_find_acceleration

   !> Sum of (m v^2 + I omega^2)/2, body by body.
   pure function planar_kinetic_energy(n, mass, motion) result(energy)
      integer, intent(in) :: n                !! number of bodies
      real(wp), intent(in) :: mass(:, :)      !! (3, n) mass, mass, moment of inertia [kg, kg, kg.m^2]
      type(motion_t), intent(in) :: motion    !! the motion
      real(wp) :: energy                      !! kinetic energy [J]

      integer :: k

      energy = 0.0_wp
      do k = 1, n
         energy = energy + 0.5_wp*(mass(1, k)*(motion%v(1, k)**2 + motion%v(2, k)**2) + mass(3, k)*motion%omega(3, k)**2)
      end do
   end function planar_kinetic_energy

   !> Two forces and a moment.
   pure subroutine planar_split_load(load, motion, body, force, moment)
      real(wp), intent(in) :: load(most_rates)  !! (3) first: load on x, y, angle [N, N, N.m]
      type(motion_t), intent(in) :: motion   !! the motion
      integer, intent(in) :: body            !! the body
      real(wp), intent(out) :: force(3)      !! (3) force, world frame [N]
      real(wp), intent(out) :: moment(3)     !! (3) moment about the centre of mass [N.m]

      force = [load(1), load(2), 0.0_wp]
      moment = [0.0_wp, 0.0_wp, load(3)]
   end subroutine planar_split_load

   !> The direction, and its moment.
   pure subroutine planar_along(direction, arm, motion, body, row)
      real(wp), intent(in) :: direction(3)   !! (3) the direction, in the plane [1]
      real(wp), intent(in) :: arm(3)         !! (3) from the centre of mass to the point [m]
      type(motion_t), intent(in) :: motion   !! the motion
      integer, intent(in) :: body            !! the body
      real(wp), intent(out) :: row(:)        !! (3) the row [1, 1, m]

      row(1:2) = direction(1:2)
      row(3) = arm(1)*direction(2) - arm(2)*direction(1)
   end subroutine planar_along

end module planar_coordinates
