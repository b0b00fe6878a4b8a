!> The contract of coordinates: what the positions and rates of bodies are, and how they become motion and loads.
!>
!> A body has n_q coordinates and n_v rates; rows of the constraints, masses and loads go with the rates. The mass matrix is
!> diagonal. Everything between the joints and the analysis works with this contract and knows neither number.
module coordinates
   use bodies, only: bodies_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t
   use readings, only: readings_t
   implicit none (type, external)
   private
   public :: coordinates_t, most_rates

   integer, parameter :: most_rates = 6   !! rates of a body in any space: storage for a row without allocation

   !> Coordinates of a kind of space.
   type, abstract :: coordinates_t
      integer :: n_q = 0                     !! coordinates of a body
      integer :: n_v = 0                     !! rates of a body
      integer :: n_axis = 0                  !! components of a vector in reports
      logical :: turns_in_body = .false.     !! whether angular rates are along the body's axes, not the world's
      logical, allocatable :: is_turn(:)     !! (n_v) whether a rate is angular
   contains
      procedure(read_start_interface), deferred :: read_start
      procedure(find_masses_interface), deferred :: find_masses
      procedure(move_interface), deferred :: move
      procedure(read_motion_interface), deferred :: read_motion
      procedure(accelerate_interface), deferred :: accelerate
      procedure(rates_interface), deferred :: rates
      procedure(add_rates_interface), deferred :: add_rates
      procedure(gather_interface), deferred :: gather
      procedure(add_change_interface), deferred :: add_change
      procedure(difference_interface), deferred :: difference
      procedure(acceleration_interface), deferred :: find_acceleration
      procedure(energy_interface), deferred, nopass :: kinetic_energy
      procedure(split_interface), deferred, nopass :: split_load
      procedure(report_interface), deferred, nopass :: report
      procedure(along_interface), deferred, nopass :: along
      procedure(info_interface), deferred, nopass :: bodies_info
      procedure(weigh_interface), deferred :: weigh_positions
      procedure(to_local_interface), deferred :: to_local
      procedure(from_local_interface), deferred :: from_local
      procedure :: scales => coordinates_scales
      procedure :: change_scales => coordinates_change_scales
      procedure :: max_rate => coordinates_max_rate
      procedure :: max_turn => coordinates_max_turn
   end type coordinates_t

   abstract interface
      !> Coordinates and rates of all bodies as a deck gives them.
      pure subroutine read_start_interface(self, bodies, q, v)
         import :: bodies_t, coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         type(bodies_t), intent(in) :: bodies       !! bodies of the deck
         real(wp), intent(out) :: q(:)              !! (n_q bodies) coordinates [any]
         real(wp), intent(out) :: v(:)              !! (n_v bodies) rates [any]
      end subroutine read_start_interface

      !> The diagonal mass matrix.
      pure subroutine find_masses_interface(self, bodies, mass)
         import :: bodies_t, coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         type(bodies_t), intent(in) :: bodies       !! bodies of the deck
         real(wp), intent(out) :: mass(:, :)        !! (n_v, bodies) masses [kg or kg.m^2]
      end subroutine find_masses_interface

      !> Positions, rotations and velocities of some bodies. No allocation.
      pure subroutine move_interface(self, n, body, q, v, motion)
         import :: coordinates_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         integer, intent(in) :: n                   !! how many bodies
         integer, intent(in) :: body(n)             !! (n) which
         real(wp), intent(in) :: q(self%n_q, n)     !! (n_q, n) their coordinates [any]
         real(wp), intent(in) :: v(self%n_v, n)     !! (n_v, n) their rates [any]
         type(motion_t), intent(inout) :: motion    !! the motion
      end subroutine move_interface

      !> Coordinates and rates of a body from its motion, the inverse of `move`.
      pure subroutine read_motion_interface(self, motion, body, q, v)
         import :: coordinates_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         type(motion_t), intent(in) :: motion       !! the motion
         integer, intent(in) :: body                !! the body
         real(wp), intent(out) :: q(self%n_q)       !! (n_q) its coordinates [any]
         real(wp), intent(out) :: v(self%n_v)       !! (n_v) its rates [any]
      end subroutine read_motion_interface

      !> Accelerations of some bodies from the derivatives of their rates.
      pure subroutine accelerate_interface(self, n, body, a, motion)
         import :: coordinates_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         integer, intent(in) :: n                   !! how many bodies
         integer, intent(in) :: body(n)             !! (n) which
         real(wp), intent(in) :: a(self%n_v, n)     !! (n_v, n) derivatives of their rates [any]
         type(motion_t), intent(inout) :: motion    !! the motion
      end subroutine accelerate_interface

      !> Derivatives of the coordinates and rates of some bodies. Status 1 if one is not a finite number. No allocation.
      pure subroutine rates_interface(self, n, body, motion, a, q_dot, v_dot, status)
         import :: coordinates_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self            !! the coordinates
         integer, intent(in) :: n                            !! how many bodies
         integer, intent(in) :: body(n)                      !! (n) which
         type(motion_t), intent(in) :: motion                !! the motion
         real(wp), intent(in), contiguous :: a(:, 0:)        !! (n_v, 0:bodies) accelerations [any]
         real(wp), intent(inout) :: q_dot(self%n_q, n)       !! (n_q, n) derivatives of the coordinates [any]
         real(wp), intent(inout) :: v_dot(self%n_v, n)       !! (n_v, n) derivatives of the rates [any]
         integer, intent(out) :: status                      !! 0: all finite
      end subroutine rates_interface

      !> Add the derivatives of coordinates that some rates would make.
      pure subroutine add_rates_interface(self, n, body, motion, z, q_dot)
         import :: coordinates_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self            !! the coordinates
         integer, intent(in) :: n                            !! how many bodies
         integer, intent(in) :: body(n)                      !! (n) which
         type(motion_t), intent(in) :: motion                !! positions
         real(wp), intent(in), contiguous :: z(:, 0:)        !! (n_v, 0:bodies) rates [any]
         real(wp), intent(inout) :: q_dot(self%n_q, n)       !! (n_q, n) derivatives of the coordinates, added to [any]
      end subroutine add_rates_interface

      !> Loads on the rates of all bodies, what the motion itself gives included. No allocation.
      pure subroutine gather_interface(self, n_body, mass, motion, loads, g)
         import :: coordinates_t, loads_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self            !! the coordinates
         integer, intent(in) :: n_body                       !! number of bodies
         real(wp), intent(in), contiguous :: mass(:, :)      !! (n_v, bodies) their masses [kg or kg.m^2]
         type(motion_t), intent(in) :: motion                !! positions and velocities
         type(loads_t), intent(in) :: loads                  !! forces and moments
         real(wp), intent(out), contiguous :: g(:, 0:)       !! (n_v, 0:bodies) loads [N or N.m]
      end subroutine gather_interface

      !> Change coordinates of bodies by small displacements, or turns about axes.
      pure subroutine add_change_interface(self, n, x, q)
         import :: coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self     !! the coordinates
         integer, intent(in) :: n                     !! how many bodies
         real(wp), intent(in) :: x(self%n_v, n)       !! (n_v, n) changes [m or rad]
         real(wp), intent(inout) :: q(self%n_q, n)    !! (n_q, n) coordinates [any]
      end subroutine add_change_interface

      !> The change that leads from one position of bodies to another.
      pure subroutine difference_interface(self, n, from, to, x)
         import :: coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self     !! the coordinates
         integer, intent(in) :: n                     !! how many bodies
         real(wp), intent(in) :: from(self%n_q, n)    !! (n_q, n) coordinates [any]
         real(wp), intent(in) :: to(self%n_q, n)      !! (n_q, n) coordinates [any]
         real(wp), intent(out) :: x(self%n_v, n)      !! (n_v, n) changes [m or rad]
      end subroutine difference_interface

      !> Error scales of the coordinates of n bodies: `length` of lengths, one radian of angles, one of other numbers.
      pure subroutine weigh_interface(self, length, n, scale)
         import :: coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         real(wp), intent(in) :: length             !! that lengths are measured by [m]
         integer, intent(in) :: n                   !! how many bodies
         real(wp), intent(out) :: scale(self%n_q*n) !! (n_q n) scales [m or 1]
      end subroutine weigh_interface

      !> Small changes of coordinates and rates of bodies, along the bodies' own axes.
      pure subroutine to_local_interface(self, n, q, q_change, v_change, x, w)
         import :: coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self         !! the coordinates
         integer, intent(in) :: n                         !! how many bodies
         real(wp), intent(in) :: q(self%n_q, n)           !! (n_q, n) their coordinates [any]
         real(wp), intent(in) :: q_change(self%n_q, n)    !! (n_q, n) changes of these [any]
         real(wp), intent(in) :: v_change(self%n_v, n)    !! (n_v, n) changes of the rates [any]
         real(wp), intent(out) :: x(self%n_v, n)          !! (n_v, n) displacements and turns, along axes of the bodies [m or rad]
         real(wp), intent(out) :: w(self%n_v, n)          !! (n_v, n) changes of velocities, the same way [m/s or rad/s]
      end subroutine to_local_interface

      !> The inverse of `to_local`.
      pure subroutine from_local_interface(self, n, q, x, w, q_change, v_change)
         import :: coordinates_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self         !! the coordinates
         integer, intent(in) :: n                         !! how many bodies
         real(wp), intent(in) :: q(self%n_q, n)           !! (n_q, n) their coordinates [any]
         real(wp), intent(in) :: x(self%n_v, n)           !! (n_v, n) displacements and turns, along axes of the bodies [m or rad]
         real(wp), intent(in) :: w(self%n_v, n)           !! (n_v, n) changes of velocities, the same way [m/s or rad/s]
         real(wp), intent(out) :: q_change(self%n_q, n)   !! (n_q, n) changes of the coordinates [any]
         real(wp), intent(out) :: v_change(self%n_v, n)   !! (n_v, n) changes of the rates [any]
      end subroutine from_local_interface

      !> Derivatives of the rates of a body from a motion.
      pure subroutine acceleration_interface(self, motion, body, a)
         import :: coordinates_t, motion_t, wp
         implicit none (type, external)
         class(coordinates_t), intent(in) :: self   !! the coordinates
         type(motion_t), intent(in) :: motion       !! the motion
         integer, intent(in) :: body                !! the body
         real(wp), intent(out) :: a(self%n_v)       !! (n_v) derivatives of its rates [any]
      end subroutine acceleration_interface

      !> Kinetic energy of all bodies.
      pure function energy_interface(n, mass, motion) result(energy)
         import :: motion_t, wp
         implicit none (type, external)
         integer, intent(in) :: n               !! number of bodies
         real(wp), intent(in) :: mass(:, :)     !! (n_v, n) their masses [kg or kg.m^2]
         type(motion_t), intent(in) :: motion   !! the motion
         real(wp) :: energy                     !! kinetic energy [J]
      end function energy_interface

      !> Force and moment about the centre of mass that a load on the rates of a body is.
      pure subroutine split_interface(load, motion, body, force, moment)
         import :: most_rates, motion_t, wp
         implicit none (type, external)
         real(wp), intent(in) :: load(most_rates)   !! (n_v) first: load on the rates [N or N.m]
         type(motion_t), intent(in) :: motion       !! the motion
         integer, intent(in) :: body                !! the body
         real(wp), intent(out) :: force(3)          !! (3) force, world frame [N]
         real(wp), intent(out) :: moment(3)         !! (3) moment about the centre of mass, world frame [N.m]
      end subroutine split_interface

      !> Values that are read, body by body. No allocation.
      pure subroutine report_interface(readings, motion, values)
         import :: motion_t, readings_t, wp
         implicit none (type, external)
         type(readings_t), intent(in) :: readings   !! channels that are read, of `bodies`
         type(motion_t), intent(in) :: motion       !! the motion, accelerations too
         real(wp), intent(inout), contiguous :: values(:)  !! (any) of the catalogue, those that are read are set [any]
      end subroutine report_interface

      !> The row of a direction at a point of a body: its product with the rates is the velocity of the point that way.
      pure subroutine along_interface(direction, arm, motion, body, row)
         import :: motion_t, wp
         implicit none (type, external)
         real(wp), intent(in) :: direction(3)       !! (3) the direction, world frame [1]
         real(wp), intent(in) :: arm(3)             !! (3) from the centre of mass to the point, world frame [m]
         type(motion_t), intent(in) :: motion       !! the motion
         integer, intent(in) :: body                !! the body
         real(wp), intent(out) :: row(:)            !! (n_v) the row [1 or m]
      end subroutine along_interface

      !> The deck table of bodies, and their channels.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info   !! columns and channels
      end function info_interface
   end interface

contains

   !> Scales of the rates of n bodies: one radian of angles, `length` of lengths.
   pure function coordinates_scales(self, length, n) result(scale)
      class(coordinates_t), intent(in) :: self   !! the coordinates
      real(wp), intent(in) :: length             !! that lengths are measured by [m]
      integer, intent(in) :: n                   !! how many bodies
      real(wp) :: scale(self%n_v*n)              !! (n_v n) scales [m or 1]

      integer :: i, k

      do k = 1, n
         do i = 1, self%n_v
            scale(self%n_v*(k - 1) + i) = merge(1.0_wp, length, self%is_turn(i))
         end do
      end do
   end function coordinates_scales

   !> What makes changes of n bodies lengths: one for lengths, `length` for angles.
   pure function coordinates_change_scales(self, length, n) result(scale)
      class(coordinates_t), intent(in) :: self   !! the coordinates
      real(wp), intent(in) :: length             !! size of the bodies [m]
      integer, intent(in) :: n                   !! how many bodies
      real(wp) :: scale(self%n_v*n)              !! (n_v n) scales [1 or m]

      integer :: i, k

      do k = 1, n
         do i = 1, self%n_v
            scale(self%n_v*(k - 1) + i) = merge(length, 1.0_wp, self%is_turn(i))
         end do
      end do
   end function coordinates_change_scales

   !> Maximum of the rates of n bodies, velocities over a length.
   pure real(wp) function coordinates_max_rate(self, n, v, length) result(rate)
      class(coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                   !! how many bodies
      real(wp), intent(in) :: v(self%n_v, n)     !! (n_v, n) rates [any]
      real(wp), intent(in) :: length             !! the length [m]

      integer :: i, k

      rate = 0.0_wp
      do k = 1, n
         do i = 1, self%n_v
            if (self%is_turn(i)) then
               rate = max(rate, abs(v(i, k)))
            else
               rate = max(rate, abs(v(i, k))/length)
            end if
         end do
      end do
   end function coordinates_max_rate

   !> Maximum turn in changes of n bodies.
   pure real(wp) function coordinates_max_turn(self, n, x) result(turn)
      class(coordinates_t), intent(in) :: self   !! the coordinates
      integer, intent(in) :: n                   !! how many bodies
      real(wp), intent(in) :: x(self%n_v, n)     !! (n_v, n) changes [any]

      integer :: i

      turn = 0.0_wp
      do i = 1, self%n_v
         if (self%is_turn(i)) turn = max(turn, maxval(abs(x(i, :))))
      end do
   end function coordinates_max_turn

end module coordinates
