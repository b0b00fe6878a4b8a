!> Perturbed starts of an ensemble.
!>
!> Every coordinate of every body is moved, and its velocity changed, by a random number, equally likely between minus and
!> plus the amplitude of [ensemble]; the angle by that over the radius of gyration, so that all coordinates move alike.
!> `find_start` then assembles the mechanism anew, its loose joints loose: what drivers and joints hold goes back, what is
!> free stays moved. The numbers follow from the seed and the number of the run alone: a run is the same whatever runs
!> beside it and whatever parameters are swept.
module perturbation
   use coordinates, only: coordinates_t
   use kinds, only: wp
   use scene, only: scene_t
   implicit none (type, external)
   private
   public :: new_shift, shift_t

   integer, parameter :: discarded = 64  !! numbers after which generators with neighbouring seeds have parted

   !> A perturbation of the start.
   type :: shift_t
      real(wp), allocatable :: q(:)  !! (n_v bodies) of positions [m or rad]
      real(wp), allocatable :: v(:)  !! (n_v bodies) of velocities [m/s or rad/s]
   end type shift_t

contains

   !> The perturbation of a run.
   function new_shift(scene, coordinates, member) result(shift)
      type(scene_t), intent(in) :: scene    !! the scene, with an ensemble
      class(coordinates_t), intent(in) :: coordinates  !! of its bodies
      integer, intent(in) :: member         !! number of the run, from 1
      type(shift_t) :: shift                !! its perturbation

      integer, allocatable :: state(:)
      integer :: first, k, last, n
      real(wp) :: arm, unused(discarded), x(coordinates%n_v, 2)

      call random_seed(size=n)
      allocate (state(n))
      associate (settings => scene%ensemble)
         state = [(ieor(nint(settings%number("seed")), 40503*k), k=1, n)]
         state(1) = ieor(state(1), member)
         call random_seed(put=state)
         call random_number(unused)
         allocate (shift%q(coordinates%n_v*scene%bodies%n), shift%v(coordinates%n_v*scene%bodies%n))
         do k = 1, scene%bodies%n
            arm = 1.0_wp
            if (scene%bodies%inertia(k) > 0.0_wp) arm = sqrt(scene%bodies%inertia(k)/scene%bodies%mass(k))
            call random_number(x)
            x = 2.0_wp*x - 1.0_wp
            where (spread(coordinates%is_turn, 2, 2)) x = x/arm
            first = coordinates%n_v*(k - 1) + 1
            last = coordinates%n_v*k
            shift%q(first:last) = settings%number("position")*x(:, 1)
            shift%v(first:last) = settings%number("velocity")*x(:, 2)
         end do
      end associate
   end function new_shift

end module perturbation
