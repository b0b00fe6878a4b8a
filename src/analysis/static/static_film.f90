!> Where journals come to rest in their films while the drivers turn them: a steady state, by Newton's iteration.
!>
!> $$ N^T K N\, x = N^T r, \quad K = -dr/dq $$
!>
!> with N the motions that the rows leave free. The tangent stiffness of a film is far from symmetric, a load moves the journal
!> across its own direction, so that there is no way downhill; a step is halved until less is out of balance at its end.
!>
!> Source: Nocedal and Wright, Numerical Optimization (2006), section 11.2. Limits: starts where the deck puts the bodies, with the
!> joints assembled; velocities are the minimum that the drivers ask for, so that mechanisms which go round have no steady state.
module static_film
   use kinds, only: wp
   use lapack, only: dgetrf, dgetrs
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, not_finite_rows, open_rows, solve_positions
   use static_problem, only: balance_t, evaluate_balance, free_stiffness, load_scale, position_scale
   implicit none (type, external)
   private
   public :: settle_in_films

   integer, parameter :: n_halving = 40            !! lengths of a step tried
   real(wp), parameter :: enough = 1.0e-4_wp       !! minimum part of a step's length by which the load has to fall [1]

contains

   !> Newton's iteration until the unbalanced load is below a part of the loads.
   subroutine settle_in_films(system, part, most, q, balance, steps, is_settled)
      class(mechanism_t), intent(inout) :: system      !! the system, positions assembled
      real(wp), intent(in) :: part                     !! unbalanced load allowed, of the largest [1]
      integer, intent(in) :: most                      !! steps allowed
      real(wp), intent(inout) :: q(:)                  !! (n_q bodies) positions, moved [any]
      type(balance_t), intent(inout) :: balance        !! at the positions
      integer, intent(inout) :: steps                  !! steps made so far
      logical, intent(out) :: is_settled               !! the load is below

      real(wp), allocatable :: x(:, :)
      integer, allocatable :: pivots(:)
      integer :: info, n
      logical :: is_better

      call evaluate_balance(system, q, balance)
      do
         call free_stiffness(system, q, balance)
         is_settled = norm2(balance%load) <= part*load_scale(system)
         n = size(balance%free, 2)
         if (is_settled .or. steps >= most .or. n == 0) return
         x = reshape(matmul(balance%load, balance%free), [n, 1])
         allocate (pivots(n))
         call dgetrf(n, n, balance%tangent, n, pivots, info)
         if (info /= 0) return
         call dgetrs("N", n, 1, balance%tangent, n, pivots, x, n, info)
         deallocate (pivots)
         call go_along(system, matmul(balance%free, x(:, 1)), q, balance, is_better)
         if (.not. is_better) return
         steps = steps + 1
      end do
   end subroutine settle_in_films

   !> Move along a step, halved until less is out of balance.
   subroutine go_along(system, direction, q, balance, is_better)
      class(mechanism_t), intent(inout) :: system      !! the system
      real(wp), intent(in) :: direction(:)             !! (n_v bodies) scaled step [1]
      real(wp), intent(inout) :: q(:)                  !! (n_q bodies) positions, moved if that is better [any]
      type(balance_t), intent(inout) :: balance        !! at the positions
      logical, intent(out) :: is_better                !! whether it is

      type(newton_t) :: newton
      real(wp) :: before, part, q_new(size(q))
      integer :: k, outcome

      before = norm2(balance%load)
      part = 1.0_wp
      do k = 1, n_halving
         q_new = q
         call system%linkage%coordinates%add_change(system%linkage%bodies%n, part*direction*position_scale(system), q_new)
         call solve_positions(system%linkage, 0.0_wp, newton, q_new, outcome)
         is_better = outcome /= open_rows .and. outcome /= not_finite_rows
         if (is_better) then
            call evaluate_balance(system, q_new, balance)
            is_better = norm2(balance%load) < (1.0_wp - enough*part)*before
         end if
         if (is_better) exit
         part = 0.5_wp*part
      end do
      if (is_better) then
         q = q_new
      else
         call evaluate_balance(system, q, balance)
      end if
   end subroutine go_along

end module static_film
