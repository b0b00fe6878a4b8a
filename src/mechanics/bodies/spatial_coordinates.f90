!> Coordinates of bodies in space: the centre of mass and Euler parameters p of the principal axes; rates are the velocity of the
!> centre of mass, world frame, and the angular velocity w' along the principal axes.
!>
!> r' = v,   p' = L(p)^T w'/2   (`rotations`),   v' = f/m,   w'' = J^{-1} (A^T n - w' x J w')
!>
!> The mass matrix is diag(m, m, m, J1, J2, J3), and the gyroscopic moment -w' x J w' is a load that the motion itself gives.
!> Nothing depends on the length of p: what errors of integration make of it is no error of the motion, no normalisation disturbs
!> the order of a method, and the state is smooth from step to step. What is added by corrections leaves p at length one.
!> Source: Flores et al. (2008), section 6.2; the gyroscopic moment of (6.9) belongs to g.
module spatial_coordinates
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: bodies_t, of_acceleration, of_angular_acceleration, of_angular_velocity, of_position, of_velocity
   use coordinates, only: coordinates_t, most_rates
   use kinds, only: wp
   use motion, only: cross, loads_t, motion_t
   use readings, only: readings_t
   use spatial_load_kernels, only: spatial_loads, spatial_weights
   use rotations, only: euler_parameters_of, product_of, rate_of_parameters, rotation_of_parameters, rotation_vector_of, spin_of, &
      turned_by
   use spatial_bodies, only: of_orientation, of_spin, spatial_bodies_info
   implicit none (type, external)
   private
   public :: new_spatial_coordinates, spatial_coordinates_t

   integer, parameter :: n_q = 7   !! coordinates of a body
   integer, parameter :: n_v = 6   !! rates of a body

   !> Position, Euler parameters; velocity, angular velocity.
   type, extends(coordinates_t) :: spatial_coordinates_t
   contains
      procedure :: read_start => spatial_read_start
      procedure :: find_masses => spatial_find_masses
      procedure :: move => spatial_move
      procedure :: read_motion => spatial_read_motion
      procedure :: accelerate => spatial_accelerate
      procedure :: rates => spatial_rates
      procedure :: add_rates => spatial_add_rates
      procedure :: gather => spatial_gather
      procedure :: add_change => spatial_add_change
      procedure :: difference => spatial_difference
      procedure :: weigh_positions => spatial_weigh_positions
      procedure :: to_local => spatial_to_local
      procedure :: from_local => spatial_from_local
      procedure :: find_acceleration => spatial_find_acceleration
      procedure, nopass :: kinetic_energy => spatial_kinetic_energy
      procedure, nopass :: split_load => spatial_split_load
      procedure, nopass :: report => spatial_report
      procedure, nopass :: along => spatial_along
      procedure, nopass :: bodies_info => spatial_bodies_info
   end type spatial_coordinates_t

   interface
      !> Along the bodies' axes, where turns and angular velocities are already.
      pure module subroutine spatial_to_local(self, n, q, q_change, v_change, x, w)
         implicit none (type, external)
         class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
         integer, intent(in) :: n                          !! how many bodies
         real(wp), intent(in) :: q(self%n_q, n)            !! (7, n) positions and Euler parameters [m and 1]
         real(wp), intent(in) :: q_change(self%n_q, n)     !! (7, n) their changes [m and 1]
         real(wp), intent(in) :: v_change(self%n_v, n)     !! (6, n) changes of the rates [m/s and rad/s]
         real(wp), intent(out) :: x(self%n_v, n)           !! (6, n) displacements and turns, body frames [m and rad]
         real(wp), intent(out) :: w(self%n_v, n)           !! (6, n) changes of velocities, body frames [m/s and rad/s]
      end subroutine spatial_to_local

      !> Along the world's axes, and the change of Euler parameters that a turn makes.
      pure module subroutine spatial_from_local(self, n, q, x, w, q_change, v_change)
         implicit none (type, external)
         class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
         integer, intent(in) :: n                          !! how many bodies
         real(wp), intent(in) :: q(self%n_q, n)            !! (7, n) positions and Euler parameters [m and 1]
         real(wp), intent(in) :: x(self%n_v, n)            !! (6, n) displacements and turns, body frames [m and rad]
         real(wp), intent(in) :: w(self%n_v, n)            !! (6, n) changes of velocities, body frames [m/s and rad/s]
         real(wp), intent(out) :: q_change(self%n_q, n)    !! (7, n) changes of the coordinates [m and 1]
         real(wp), intent(out) :: v_change(self%n_v, n)    !! (6, n) changes of the rates [m/s and rad/s]
      end subroutine spatial_from_local

      !> Values that are read, body by body. What is along a body's axes is along those of the deck.
      pure module subroutine spatial_report(readings, motion, values)
         implicit none (type, external)
         type(readings_t), intent(in) :: readings   !! channels that are read
         type(motion_t), intent(in) :: motion       !! the motion, accelerations too
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine spatial_report

      !> Displacements, and turns about axes of the body; Euler parameters come out at length one.
      pure module subroutine spatial_add_change(self, n, x, q)
         implicit none (type, external)
         class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
         integer, intent(in) :: n                          !! how many bodies
         real(wp), intent(in) :: x(self%n_v, n)            !! (6, n) changes [m and rad]
         real(wp), intent(inout) :: q(self%n_q, n)         !! (7, n) coordinates [m and 1]
      end subroutine spatial_add_change

      !> Displacements and turns from one position to another.
      pure module subroutine spatial_difference(self, n, from, to, x)
         implicit none (type, external)
         class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
         integer, intent(in) :: n                          !! how many bodies
         real(wp), intent(in) :: from(self%n_q, n)         !! (7, n) coordinates [m and 1]
         real(wp), intent(in) :: to(self%n_q, n)           !! (7, n) coordinates [m and 1]
         real(wp), intent(out) :: x(self%n_v, n)           !! (6, n) changes [m and rad]
      end subroutine spatial_difference
   end interface

contains

   !> The coordinates of space.
   pure function new_spatial_coordinates() result(coordinates)
      type(spatial_coordinates_t) :: coordinates  !! position and Euler parameters

      coordinates%n_q = n_q
      coordinates%n_v = n_v
      coordinates%n_axis = 3
      coordinates%turns_in_body = .true.
      coordinates%is_turn = [.false., .false., .false., .true., .true., .true.]
   end function new_spatial_coordinates

   !> Positions and velocities as the deck gives them.
   pure subroutine spatial_read_start(self, bodies, q, v)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      type(bodies_t), intent(in) :: bodies              !! bodies of the deck
      real(wp), intent(out) :: q(:)                     !! (7 bodies) position and Euler parameters [m and 1]
      real(wp), intent(out) :: v(:)                     !! (6 bodies) velocity, and angular velocity in the body [m/s and rad/s]

      integer :: k

      do k = 1, bodies%n
         q(n_q*k - 6:n_q*k) = [bodies%r(:, k), bodies%spatial%p(:, k)]
         v(n_v*k - 5:n_v*k - 3) = bodies%v(:, k)
         v(n_v*k - 2:n_v*k) = matmul(bodies%spatial%w(:, k), rotation_of_parameters(bodies%spatial%p(:, k)))
      end do
   end subroutine spatial_read_start

   !> Mass three times, principal moments of inertia.
   pure subroutine spatial_find_masses(self, bodies, mass)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      type(bodies_t), intent(in) :: bodies              !! bodies of the deck
      real(wp), intent(out) :: mass(:, :)               !! (6, bodies) masses [kg and kg.m^2]

      integer :: k

      do k = 1, bodies%n
         mass(:3, k) = bodies%mass(k)
         mass(4:, k) = bodies%spatial%moments(:, k)
      end do
   end subroutine spatial_find_masses

   !> Positions, rotations and velocities of some bodies.
   pure subroutine spatial_move(self, n, body, q, v, motion)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      integer, intent(in) :: n                          !! how many bodies
      integer, intent(in) :: body(n)                    !! (n) which
      real(wp), intent(in) :: q(self%n_q, n)            !! (7, n) positions and Euler parameters [m and 1]
      real(wp), intent(in) :: v(self%n_v, n)            !! (6, n) their rates [m/s and rad/s]
      type(motion_t), intent(inout) :: motion           !! the motion

      call fill_spatial(n, body, ubound(motion%angle, 1), q, v, motion%r, motion%rot, motion%v, motion%omega, motion%spatial%p, &
                        motion%spatial%spin)
   end subroutine spatial_move

   !> The same on plain arrays.
   pure subroutine fill_spatial(n, body, n_body, q, v, r, rot, velocity, omega, p, spin)
      integer, intent(in) :: n                          !! how many bodies
      integer, intent(in) :: body(n)                    !! (n) which bodies
      integer, intent(in) :: n_body                     !! number of bodies
      real(wp), intent(in) :: q(n_q, n)                 !! (7, n) positions and Euler parameters [m and 1]
      real(wp), intent(in) :: v(n_v, n)                 !! (6, n) their rates [m/s and rad/s]
      real(wp), intent(inout) :: r(3, 0:n_body)         !! (3, 0:bodies) centres of mass [m]
      real(wp), intent(inout) :: rot(3, 3, 0:n_body)    !! (3, 3, 0:bodies) body frames to world frame [1]
      real(wp), intent(inout) :: velocity(3, 0:n_body)  !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(inout) :: omega(3, 0:n_body)     !! (3, 0:bodies) angular velocities, world frame [rad/s]
      real(wp), intent(inout) :: p(4, 0:n_body)         !! (4, 0:bodies) Euler parameters [1]
      real(wp), intent(inout) :: spin(3, 0:n_body)      !! (3, 0:bodies) angular velocities, body frames [rad/s]

      integer :: b, k

      do k = 1, n
         b = body(k)
         r(:, b) = q(1:3, k)
         p(:, b) = q(4:7, k)
         velocity(:, b) = v(1:3, k)
         spin(:, b) = v(4:6, k)
         rot(:, :, b) = rotation_of_parameters(q(4:7, k))
         omega(:, b) = rot(:, 1, b)*v(4, k) + rot(:, 2, b)*v(5, k) + rot(:, 3, b)*v(6, k)
      end do
   end subroutine fill_spatial

   !> Coordinates and rates of a body from its motion.
   pure subroutine spatial_read_motion(self, motion, body, q, v)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      type(motion_t), intent(in) :: motion              !! the motion
      integer, intent(in) :: body                       !! the body
      real(wp), intent(out) :: q(self%n_q)              !! (7) position and Euler parameters [m and 1]
      real(wp), intent(out) :: v(self%n_v)              !! (6) their rates [m/s and rad/s]

      q = [motion%r(:, body), motion%spatial%p(:, body)]
      v = [motion%v(:, body), motion%spatial%spin(:, body)]
   end subroutine spatial_read_motion

   !> Accelerations of some bodies. Along the body's axes and the world's the angular acceleration is the same vector.
   pure subroutine spatial_accelerate(self, n, body, a, motion)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      integer, intent(in) :: n                          !! how many bodies
      integer, intent(in) :: body(n)                    !! (n) which
      real(wp), intent(in) :: a(self%n_v, n)            !! (6, n) derivatives of the rates [m/s^2 and rad/s^2]
      type(motion_t), intent(inout) :: motion           !! the motion

      integer :: k

      do k = 1, n
         associate (b => body(k))
            motion%a(:, b) = a(1:3, k)
            motion%spatial%rise(:, b) = a(4:6, k)
            motion%alpha(:, b) = matmul(motion%rot(:, :, b), a(4:6, k))
         end associate
      end do
   end subroutine spatial_accelerate

   !> Derivatives of coordinates and rates. Status 1 if an acceleration is not a finite number.
   pure subroutine spatial_rates(self, n, body, motion, a, q_dot, v_dot, status)
      class(spatial_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                           !! how many bodies
      integer, intent(in) :: body(n)                     !! (n) which
      type(motion_t), intent(in) :: motion               !! the motion
      real(wp), intent(in), contiguous :: a(:, 0:)       !! (6, 0:bodies) accelerations [m/s^2 and rad/s^2]
      real(wp), intent(inout) :: q_dot(self%n_q, n)      !! (7, n) derivatives of the coordinates [m/s and 1/s]
      real(wp), intent(inout) :: v_dot(self%n_v, n)      !! (6, n) derivatives of the rates [m/s^2 and rad/s^2]
      integer, intent(out) :: status                     !! 0: all finite

      call state_rates(n, body, ubound(motion%angle, 1), motion%v, motion%spatial%p, motion%spatial%spin, a, q_dot, v_dot, status)
   end subroutine spatial_rates

   !> The same on plain arrays.
   pure subroutine state_rates(n, unknown, n_body, v, p, spin, a, q_dot, v_dot, status)
      integer, intent(in) :: n                      !! number of unknown bodies
      integer, intent(in) :: unknown(n)             !! (n) their numbers
      integer, intent(in) :: n_body                 !! number of bodies
      real(wp), intent(in) :: v(3, 0:n_body)        !! (3, 0:bodies) velocities [m/s]
      real(wp), intent(in) :: p(4, 0:n_body)        !! (4, 0:bodies) Euler parameters [1]
      real(wp), intent(in) :: spin(3, 0:n_body)     !! (3, 0:bodies) angular velocities, body frames [rad/s]
      real(wp), intent(in) :: a(n_v, 0:n_body)      !! (6, 0:bodies) accelerations [m/s^2 and rad/s^2]
      real(wp), intent(inout) :: q_dot(n_q, n)      !! (7, n) derivatives of the coordinates [m/s and 1/s]
      real(wp), intent(inout) :: v_dot(n_v, n)      !! (6, n) derivatives of the rates [m/s^2 and rad/s^2]
      integer, intent(out) :: status                !! 0: all finite

      real(wp) :: sum
      integer :: body, c, k

      sum = 0.0_wp
      do k = 1, n
         body = unknown(k)
         q_dot(1:3, k) = v(:, body)
         q_dot(4:7, k) = rate_of_parameters(p(:, body), spin(:, body))
         do c = 1, n_v
            v_dot(c, k) = a(c, body)
         end do
         sum = sum + ((abs(a(1, body)) + abs(a(2, body)) + abs(a(3, body))) + (abs(a(4, body)) + abs(a(5, body)) + abs(a(6, body))))
      end do
      status = merge(0, 1, ieee_is_finite(sum))
   end subroutine state_rates

   !> Velocities, and what angular velocities do to Euler parameters.
   pure subroutine spatial_add_rates(self, n, body, motion, z, q_dot)
      class(spatial_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                           !! how many bodies
      integer, intent(in) :: body(n)                     !! (n) which
      type(motion_t), intent(in) :: motion               !! positions
      real(wp), intent(in), contiguous :: z(:, 0:)       !! (6, 0:bodies) rates [m/s and rad/s]
      real(wp), intent(inout) :: q_dot(self%n_q, n)      !! (7, n) derivatives of the coordinates, added to [m/s and 1/s]

      integer :: k

      do k = 1, n
         q_dot(1:3, k) = q_dot(1:3, k) + z(1:3, body(k))
         q_dot(4:7, k) = q_dot(4:7, k) + rate_of_parameters(motion%spatial%p(:, body(k)), z(4:6, body(k)))
      end do
   end subroutine spatial_add_rates

   !> Forces, and moments along the body's axes less the gyroscopic ones.
   pure subroutine spatial_gather(self, n_body, mass, motion, loads, g)
      class(spatial_coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n_body                      !! number of bodies
      real(wp), intent(in), contiguous :: mass(:, :)     !! (6, bodies) masses [kg and kg.m^2]
      type(motion_t), intent(in) :: motion               !! positions and velocities
      type(loads_t), intent(in) :: loads                 !! forces and moments
      real(wp), intent(out), contiguous :: g(:, 0:)      !! (6, 0:bodies) loads on the rates [N and N.m]

      if (loads%is_weight) then
         call spatial_weights(n_body, mass, motion%spatial%spin, loads%force, g)
      else
         call spatial_loads(n_body, mass, motion%rot, motion%spatial%spin, loads%force, loads%moment, g)
      end if
   end subroutine spatial_gather

   !> Scales of the coordinates: lengths, and Euler parameters, which a turn of a radian changes by a half.
   pure subroutine spatial_weigh_positions(self, length, n, scale)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      real(wp), intent(in) :: length                    !! that lengths are measured by [m]
      integer, intent(in) :: n                          !! how many bodies
      real(wp), intent(out) :: scale(self%n_q*n)        !! (7 n) scales [m and 1]

      integer :: k

      do k = 1, n
         scale(n_q*k - 6:n_q*k - 4) = length
         scale(n_q*k - 3:n_q*k) = 0.5_wp
      end do
   end subroutine spatial_weigh_positions

   !> Derivatives of the rates of a body.
   pure subroutine spatial_find_acceleration(self, motion, body, a)
      class(spatial_coordinates_t), intent(in) :: self  !! the coordinates
      type(motion_t), intent(in) :: motion              !! the motion
      integer, intent(in) :: body                       !! the body
      real(wp), intent(out) :: a(self%n_v)              !! (6) derivatives of the rates [m/s^2 and rad/s^2]

      a(1:3) = motion%a(:, body)
      a(4:6) = matmul(motion%alpha(:, body), motion%rot(:, :, body))
   end subroutine spatial_find_acceleration

   !> Sum of (m v^2 + w' . J w')/2, body by body.
   pure function spatial_kinetic_energy(n, mass, motion) result(energy)
      integer, intent(in) :: n                !! number of bodies
      real(wp), intent(in) :: mass(:, :)      !! (6, n) masses [kg and kg.m^2]
      type(motion_t), intent(in) :: motion    !! the motion
      real(wp) :: energy                      !! kinetic energy [J]

      integer :: k

      energy = 0.0_wp
      do k = 1, n
         energy = energy + 0.5_wp*(sum(mass(1:3, k)*motion%v(:, k)**2) + sum(mass(4:6, k)*motion%spatial%spin(:, k)**2))
      end do
   end function spatial_kinetic_energy

   !> The force, and the moment turned to the world's axes.
   pure subroutine spatial_split_load(load, motion, body, force, moment)
      real(wp), intent(in) :: load(most_rates)  !! (6) load on the rates [N and N.m]
      type(motion_t), intent(in) :: motion   !! the motion
      integer, intent(in) :: body            !! the body
      real(wp), intent(out) :: force(3)      !! (3) force, world frame [N]
      real(wp), intent(out) :: moment(3)     !! (3) moment about the centre of mass, world frame [N.m]

      force = load(1:3)
      moment = matmul(motion%rot(:, :, body), load(4:6))
   end subroutine spatial_split_load

   !> The direction, and its moment along the body's axes.
   pure subroutine spatial_along(direction, arm, motion, body, row)
      real(wp), intent(in) :: direction(3)   !! (3) the direction, world frame [1]
      real(wp), intent(in) :: arm(3)         !! (3) from the centre of mass to the point, world frame [m]
      type(motion_t), intent(in) :: motion   !! the motion
      integer, intent(in) :: body            !! the body
      real(wp), intent(out) :: row(:)        !! (6) the row [1 and m]

      row(1:3) = direction
      row(4:6) = matmul(cross(arm, direction), motion%rot(:, :, body))
   end subroutine spatial_along

end module spatial_coordinates
