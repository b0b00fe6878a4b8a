!> Descent to an equilibrium from a poor start.
!>
!> Each step goes along s = sum of modes (f_k / |K_k|), f_k the load out of balance along mode k, K_k its tangent
!> stiffness: Newton's step where the stiffness is positive, downhill where it is negative, so that an unstable
!> equilibrium is left unless the search begins exactly in it. No body moves by more than 0.3 of the size
!> of the bodies, or a radian, in a step; a step is shortened until the loads at its end no longer work against
!> it by more than half of what they do for it at its begin. Then the ideal joints are closed again.
!>
!> Source: Nocedal and Wright, Numerical Optimization (2006), sections 3.4 (modified Newton), 6.2 and 15.3 (null
!> space); Dauphin et al. (2014), the absolute value of the curvature. Limits: loads that do work in a closed
!> path may keep it from settling.
module static_relaxation
   use kinds, only: eps, wp
   use planar_system, only: planar_system_t
   use prescribed_motion, only: newton_t, not_finite_rows, open_rows, solve_positions
   use static_problem, only: balance_t, evaluate_balance, free_stiffness, load_scale, position_scale
   implicit none (type, external)
   private
   public :: least_unbalance, relax

   real(wp), parameter :: longest_step = 0.3_wp    !! of a coordinate, in sizes or radians [1]
   real(wp), parameter :: least_part = 1.0e-13_wp  !! stiffness that counts, of the largest [1]
   integer, parameter :: n_search = 60             !! lengths of a step tried

contains

   !> Go downhill until the unbalanced load is below a part of the loads.
   subroutine relax(system, part, most, q, balance, steps, is_settled)
      class(planar_system_t), intent(inout) :: system  !! the system, positions assembled
      real(wp), intent(in) :: part                     !! unbalanced load allowed, of the largest [1]
      integer, intent(in) :: most                      !! steps allowed
      real(wp), intent(inout) :: q(:)                  !! (3 bodies) positions, moved [m, m, rad]
      type(balance_t), intent(inout) :: balance        !! at the positions
      integer, intent(inout) :: steps                  !! steps made so far
      logical, intent(out) :: is_settled               !! the load is below

      real(wp) :: direction(size(q))

      call evaluate_balance(system, q, balance)
      do
         call free_stiffness(system, q, balance)
         is_settled = norm2(balance%load) <= part*load_scale(system) + least_unbalance(balance)
         if (is_settled .or. steps >= most) return
         call downhill(balance, direction)
         call go_along(system, direction, q, balance)
         steps = steps + 1
      end do
   end subroutine relax

   !> Load that the round-off of the positions puts out of balance.
   pure real(wp) function least_unbalance(balance) result(load)
      type(balance_t), intent(in) :: balance  !! with its stiffness

      load = 0.0_wp
      if (size(balance%stiffness) > 0) load = 8.0_wp*eps*maxval(abs(balance%stiffness))
   end function least_unbalance

   !> The step: no coordinate by more than the longest.
   pure subroutine downhill(balance, direction)
      type(balance_t), intent(in) :: balance      !! load, stiffness and modes
      real(wp), intent(out) :: direction(:)       !! (3 bodies) scaled step [1]

      real(wp) :: floor_stiffness, force
      integer :: k

      direction = 0.0_wp
      floor_stiffness = max(least_part*maxval(abs(balance%stiffness)), norm2(balance%load)*least_part, tiny(1.0_wp))
      do k = 1, size(balance%stiffness)
         force = dot_product(balance%modes(:, k), balance%load)
         direction = direction + balance%modes(:, k)*limited(force/max(abs(balance%stiffness(k)), floor_stiffness))
      end do
      direction = direction*min(1.0_wp, longest_step/max(maxval(abs(direction)), longest_step))
   end subroutine downhill

   !> A part of a step, so short that the parts can be added.
   pure real(wp) function limited(x)
      real(wp), intent(in) :: x   !! along one mode [1]

      limited = sign(min(abs(x), longest_step), x)
   end function limited

   !> Move along a step, shortened where the loads turn against it.
   subroutine go_along(system, direction, q, balance)
      class(planar_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: direction(:)             !! (3 bodies) scaled step [1]
      real(wp), intent(inout) :: q(:)                  !! (3 bodies) positions, moved [m, m, rad]
      type(balance_t), intent(inout) :: balance        !! at the positions

      type(newton_t) :: newton
      real(wp) :: high, low, part, push, push_0, push_high, push_low, q_new(size(q))
      integer :: k, outcome

      push_0 = dot_product(direction, balance%load)
      low = 0.0_wp
      push_low = push_0
      high = 0.0_wp
      push_high = 0.0_wp
      part = 1.0_wp
      do k = 1, n_search
         q_new = q + part*direction*position_scale(system)
         call solve_positions(system, 0.0_wp, newton, q_new, outcome)
         if (outcome == open_rows .or. outcome == not_finite_rows) then
            high = part
            push_high = -push_0
         else
            call evaluate_balance(system, q_new, balance)
            push = dot_product(direction, balance%load)
            if (push >= -0.5_wp*push_0 .and. (push <= 0.5_wp*push_0 .or. high <= 0.0_wp)) exit
            if (push > 0.0_wp) then
               low = part
               push_low = push
            else
               high = part
               push_high = push
            end if
         end if
         part = low + (high - low)*max(0.1_wp, min(0.5_wp, push_low/(push_low - push_high)))
      end do
      if (k > n_search) call evaluate_balance(system, q_new, balance)
      q = q_new
   end subroutine go_along

end module static_relaxation
