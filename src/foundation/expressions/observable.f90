!> What expressions see of a motion: a word of the deck, and where its value is found. Plain data; `observed_motion` finds the
!> value.
!>
!> A place is a point of a body, observed from an origin, along the axes of a body. Quantities of a place: its position, velocity
!> and acceleration, its distance from the origin and the rate of that. Quantities of a body: its angle and angular velocity.
!> A state is the value of a row of the deck's state equations (`state_equations`).
module observable
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: place_t, sees_acceleration, sees_angle, sees_angular_velocity, sees_distance, sees_distance_rate, sees_position, &
      sees_state, sees_velocity, observable_t

   integer, parameter :: sees_position = 1          !! of a place
   integer, parameter :: sees_velocity = 2          !! of a place
   integer, parameter :: sees_acceleration = 3      !! of a place; not for loads, which make it
   integer, parameter :: sees_distance = 4          !! of a place from its origin
   integer, parameter :: sees_distance_rate = 5     !! its rate
   integer, parameter :: sees_angle = 6             !! of a planar body
   integer, parameter :: sees_angular_velocity = 7  !! of a body
   integer, parameter :: sees_state = 8             !! value of a row of the state equations, whose number is the component

   !> A point of a body, observed from an origin. Bodies: 0 is the ground.
   type :: place_t
      integer :: body = 0                   !! body of the point
      real(wp) :: s(3) = 0.0_wp             !! (3) the point, frame of its body [m]
      integer :: origin_body = 0            !! body of the origin
      real(wp) :: origin_s(3) = 0.0_wp      !! (3) the origin, frame of its body [m]
      integer :: frame = 0                  !! body along whose axes components are
      logical :: turns_with = .false.       !! rates are those that an observer in that body sees, not those of the world
   end type place_t

   !> A number that an expression sees.
   type :: observable_t
      character(:), allocatable :: word     !! as in the deck, `ram.velocity.y`
      integer :: first = 1                  !! its first character in the expression
      integer :: quantity = 0               !! one of the above
      integer :: component = 1              !! x, y, z: 1, 2, 3; of a state its row
      type(place_t) :: place                !! of which place; of a body: its centre of mass
   end type observable_t

end module observable
