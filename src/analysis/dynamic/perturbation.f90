!> Perturbed starts of an ensemble.
!>
!> Every coordinate of every body is moved, and its velocity changed, by a random number, equally likely between minus and
!> plus the amplitude of [ensemble]; the angle by that over the radius of gyration, so that all coordinates move alike.
!> `find_start` then assembles the mechanism anew, its clearance joints loose: what drivers and joints hold goes back, what is
!> free stays moved. The numbers follow from the seed and the number of the run alone: a run is the same whatever runs
!> beside it and whatever parameters are swept.
!>
!> `round_off` changes every coordinate and every rate by a random part of itself, as rounding does: what is zero stays zero.
module perturbation
   use bodies, only: bodies_t
   use coordinates, only: coordinates_t
   use kinds, only: wp
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: arm_of, new_shift, random_shift, shift_t

   integer, parameter :: discarded = 64  !! numbers after which generators with neighbouring seeds have parted

   !> A perturbation of the start.
   type :: shift_t
      real(wp), allocatable :: q(:)  !! (n_v bodies) of positions [m or rad]
      real(wp), allocatable :: v(:)  !! (n_v bodies) of velocities [m/s or rad/s]
      real(wp), allocatable, private :: part_of_q(:)  !! (n_q bodies) of coordinates, as a part of each; unallocated: none [1]
      real(wp), allocatable, private :: part_of_v(:)  !! (n_v bodies) the same of velocities [1]
   contains
      procedure :: round_off => shift_round_off
      procedure :: move => shift_move
   end type shift_t

contains

   !> The perturbation of a run.
   function new_shift(scene, coordinates, member) result(shift)
      type(scene_t), intent(in) :: scene    !! the scene, with an ensemble
      class(coordinates_t), intent(in) :: coordinates  !! of its bodies
      integer, intent(in) :: member         !! number of the run, from 1
      type(shift_t) :: shift                !! its perturbation

      associate (settings => scene%settings%ensemble)
         shift = random_shift(scene%bodies, coordinates, nint(settings%number("seed")), member, settings%number("position"), &
                              settings%number("velocity"))
      end associate
   end function new_shift

   !> A perturbation of random numbers.
   function random_shift(bodies, coordinates, seed, member, length, speed) result(shift)
      type(bodies_t), intent(in) :: bodies  !! the bodies
      class(coordinates_t), intent(in) :: coordinates  !! of these
      integer, intent(in) :: seed           !! of the random numbers
      integer, intent(in) :: member         !! number of the run, from 1
      real(wp), intent(in) :: length        !! maximum displacement [m]
      real(wp), intent(in) :: speed         !! maximum change of a velocity [m/s]
      type(shift_t) :: shift                !! the perturbation

      integer :: first, k, last
      real(wp) :: x(coordinates%n_v, 2)

      call begin_numbers(seed, member)
      allocate (shift%q(coordinates%n_v*bodies%n), shift%v(coordinates%n_v*bodies%n))
      do k = 1, bodies%n
         call random_number(x)
         x = 2.0_wp*x - 1.0_wp
         where (spread(coordinates%is_turn, 2, 2)) x = x/arm_of(bodies, k)
         first = coordinates%n_v*(k - 1) + 1
         last = coordinates%n_v*k
         shift%q(first:last) = length*x(:, 1)
         shift%v(first:last) = speed*x(:, 2)
      end do
   end function random_shift

   !> Start the random numbers of a run.
   subroutine begin_numbers(seed, member)
      integer, intent(in) :: seed     !! of all runs
      integer, intent(in) :: member   !! number of the run

      integer, allocatable :: state(:)
      integer :: k, n
      real(wp) :: unused(discarded)

      call random_seed(size=n)
      state = [(ieor(seed, 40503*k), k=1, n)]
      state(1) = ieor(state(1), member)
      call random_seed(put=state)
      call random_number(unused)
   end subroutine begin_numbers

   !> Change every coordinate and rate by a part of itself besides, by random numbers that are always the same.
   subroutine shift_round_off(self, coordinates, n, part)
      class(shift_t), intent(inout) :: self              !! the perturbation
      class(coordinates_t), intent(in) :: coordinates    !! of the bodies
      integer, intent(in) :: n                           !! how many bodies
      real(wp), intent(in) :: part                       !! maximum part [1]

      call begin_numbers(1, 1)
      allocate (self%part_of_q(coordinates%n_q*n), self%part_of_v(coordinates%n_v*n))
      call random_number(self%part_of_q)
      call random_number(self%part_of_v)
      self%part_of_q = part*(2.0_wp*self%part_of_q - 1.0_wp)
      self%part_of_v = part*(2.0_wp*self%part_of_v - 1.0_wp)
   end subroutine shift_round_off

   !> Move a start. Nothing depends on the length of Euler parameters.
   pure subroutine shift_move(self, coordinates, n, q, v)
      class(shift_t), intent(in) :: self                 !! the perturbation
      class(coordinates_t), intent(in) :: coordinates    !! of the bodies
      integer, intent(in) :: n                           !! how many bodies
      real(wp), intent(inout) :: q(:)                    !! (n_q bodies) coordinates [any]
      real(wp), intent(inout) :: v(:)                    !! (n_v bodies) rates [m/s or rad/s]

      if (allocated(self%part_of_q)) then
         q = q + self%part_of_q*q
         v = v + self%part_of_v*v
      end if
      call coordinates%add_change(n, self%q, q)
      v = v + self%v
   end subroutine shift_move

   !> The radius of gyration of a body, 1 m if it has none: the way of a point there is that of the body's angle.
   pure real(wp) function arm_of(bodies, k) result(arm)
      type(bodies_t), intent(in) :: bodies  !! the bodies
      integer, intent(in) :: k              !! number of the body

      arm = 1.0_wp
      if (bodies%inertia(k) > 0.0_wp) arm = sqrt(bodies%inertia(k)/bodies%mass(k))
   end function arm_of

end module perturbation
