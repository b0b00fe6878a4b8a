!> Storage for the friction of ideal joints of a mechanism: which joints rub, and the small system that their forces solve.
module rubbing
   use stick_slip_forces, only: unit_load_t
   use joint_friction, only: most_rows
   use joint_set, only: joint_slot_t
   use friction_law, only: memory_bristle
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: new_rubbing, rubbing_t

   !> Joints with friction.
   type :: rubbing_t
      integer :: n = 0                                !! joints with friction
      integer :: n_bristle = 0                        !! those of them that have bristles
      integer :: first_bristle = 0                    !! deflections of contacts before theirs in the state
      integer, allocatable :: slot(:)                 !! (n) set of each
      integer, allocatable :: place(:)                !! (n) place among the items of the set with friction
      integer, allocatable :: bristle(:)              !! (n) number of its deflection, 0: none
      real(wp), allocatable :: lambda(:, :)           !! (most_rows, n) multipliers [N or N.m]
      real(wp), allocatable :: response(:, :, :)      !! (most_rows, n, n) what a unit force of each does to those of each [any]
      real(wp), allocatable :: change(:)              !! (n) forces less those of the last accelerations [N]
      real(wp), allocatable :: left(:)                !! (n) what is left of the equations of the forces [N]
      real(wp), allocatable :: matrix(:, :)           !! (n, n) their derivatives [1]
      integer, allocatable :: pivot(:)                !! (n) scratch of the factorisation
      type(unit_load_t) :: load                       !! of a unit force
      integer :: wedged = 0                           !! joint for which the last evaluation found no friction force, 0: none
      real(wp) :: power = 0.0_wp                      !! power that friction in joints takes [W]
   end type rubbing_t

contains

   !> Storage for the joints of solved sets with friction.
   subroutine new_rubbing(joints, n_solved_set, a, n_row, rubbing)
      type(joint_slot_t), intent(in) :: joints(:)   !! sets of joints
      integer, intent(in) :: n_solved_set           !! those whose rows are solved for, the first ones
      real(wp), intent(in) :: a(:, 0:)              !! (n_v, 0:bodies) accelerations, for the shape of loads [any]
      integer, intent(in) :: n_row                  !! rows
      type(rubbing_t), intent(out) :: rubbing       !! workspace

      integer :: k, m, n

      n = sum([(joints(k)%set%friction%n, k=1, n_solved_set)])
      rubbing%n = n
      if (n == 0) return
      allocate (rubbing%slot(n), rubbing%place(n), rubbing%bristle(n), rubbing%pivot(n), source=0)
      allocate (rubbing%lambda(most_rows, n), rubbing%response(most_rows, n, n), rubbing%change(n), rubbing%left(n), &
                rubbing%matrix(n, n), rubbing%load%unit(size(a, 1), 0:ubound(a, 2)), rubbing%load%b(n_row), source=0.0_wp)
      n = 0
      do k = 1, n_solved_set
         associate (friction => joints(k)%set%friction)
            do m = 1, friction%n
               n = n + 1
               rubbing%slot(n) = k
               rubbing%place(n) = m
               if (friction%law(m)%law%memory /= memory_bristle) cycle
               rubbing%n_bristle = rubbing%n_bristle + 1
               rubbing%bristle(n) = rubbing%n_bristle
            end do
         end associate
      end do
   end subroutine new_rubbing

end module rubbing
