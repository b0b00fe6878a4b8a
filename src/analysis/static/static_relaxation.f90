!> Descent to an equilibrium from a poor start.
!>
!> Each step goes along s = sum of modes (f_k / |K_k|), f_k the load out of balance along mode k, K_k its tangent
!> stiffness: Newton's step where the stiffness is positive, downhill where it is negative, so that an unstable
!> equilibrium is left unless the search starts exactly in it. No body turns by more than 0.3 rad in a step, or
!> moves by more than 0.3 of the extent of the mechanism and ten sizes of its bodies; a step is shortened until the
!> loads at its end no longer work against it by more than half of what they do for it at its start. Then
!> the ideal joints are closed again.
!>
!> Source: Nocedal and Wright, Numerical Optimization (2006), sections 3.4 (modified Newton), 6.2 and 15.3 (null
!> space); Dauphin et al. (2014), the absolute value of the curvature. Limits: loads that do work in a closed
!> path may keep it from settling.
module static_relaxation
   use coordinates, only: coordinates_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, not_finite_rows, open_rows, solve_positions
   use static_problem, only: balance_t, evaluate_balance, free_stiffness, is_balanced, is_nearly_balanced, position_scale
   implicit none (type, external)
   private
   public :: relax

   real(wp), parameter :: longest_step = 0.3_wp    !! turn of a body, or motion over the extent [1]
   real(wp), parameter :: sizes = 10.0_wp          !! sizes of the bodies that count as extent at least [1]
   real(wp), parameter :: min_part = 1.0e-13_wp  !! stiffness that counts, of the largest [1]
   integer, parameter :: n_search = 60             !! lengths of a step tried

contains

   !> Go downhill until the unbalanced load is below a part of the loads.
   subroutine relax(system, part, most, q, balance, steps, is_settled, is_rough)
      class(mechanism_t), intent(inout) :: system  !! the system, positions assembled
      real(wp), intent(in) :: part                     !! unbalanced load allowed, of the largest [1]
      integer, intent(in) :: most                      !! steps allowed
      real(wp), intent(inout) :: q(:)                  !! (n_q bodies) positions, moved [any]
      type(balance_t), intent(inout) :: balance        !! at the positions
      integer, intent(inout) :: steps                  !! steps made so far
      logical, intent(out) :: is_settled               !! the load is below
      logical, intent(in), optional :: is_rough        !! near enough for Newton's iteration is enough

      real(wp) :: direction(size(system%linkage%mass))

      call evaluate_balance(system, q, balance)
      do
         call free_stiffness(system, q, balance)
         is_settled = is_balanced(system, balance, part)
         if (present(is_rough)) is_settled = is_nearly_balanced(system, balance, part)
         if (is_settled .or. steps >= most) return
         call downhill(system%linkage%coordinates, balance, extent_of(system), direction)
         call go_along(system, direction, q, balance)
         steps = steps + 1
      end do
   end subroutine relax

   !> Extent of the mechanism in sizes of its bodies.
   pure real(wp) function extent_of(system) result(extent)
      class(mechanism_t), intent(in) :: system  !! the system, its motion set

      associate (r => system%linkage%motion%r(:, 1:))
         extent = sizes + maxval(maxval(r, dim=2) - minval(r, dim=2))/system%linkage%scales%length
      end associate
   end function extent_of

   !> The step, along each mode and in all not longer than allowed.
   pure subroutine downhill(coordinates, balance, extent, direction)
      class(coordinates_t), intent(in) :: coordinates  !! of the bodies
      type(balance_t), intent(in) :: balance      !! load, stiffness and modes
      real(wp), intent(in) :: extent              !! of the mechanism, in sizes of its bodies [1]
      real(wp), intent(out) :: direction(:)       !! (n_v bodies) scaled step [1]

      real(wp) :: floor_stiffness, force, part(size(direction))
      integer :: k

      direction = 0.0_wp
      floor_stiffness = max(min_part*maxval(abs(balance%stiffness)), norm2(balance%load)*min_part, tiny(1.0_wp))
      do k = 1, size(balance%stiffness)
         force = dot_product(balance%modes(:, k), balance%load)
         part = balance%modes(:, k)*(force/max(abs(balance%stiffness(k)), floor_stiffness))
         direction = direction + shortened(coordinates, part, extent)
      end do
      direction = shortened(coordinates, direction, extent)
   end subroutine downhill

   !> A step not longer than allowed.
   pure function shortened(coordinates, step, extent) result(short)
      class(coordinates_t), intent(in) :: coordinates  !! of the bodies
      real(wp), intent(in), contiguous :: step(:)             !! (n_v bodies) scaled step [1]
      real(wp), intent(in) :: extent              !! of the mechanism, in sizes of its bodies [1]
      real(wp) :: short(size(step))               !! (n_v bodies) in the same direction [1]

      real(wp) :: length

      length = coordinates%max_rate(size(step)/coordinates%n_v, step, extent)
      short = step*(longest_step/max(length, longest_step))
   end function shortened

   !> Move along a step, shortened where the loads turn against it.
   subroutine go_along(system, direction, q, balance)
      class(mechanism_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: direction(:)             !! (n_v bodies) scaled step [1]
      real(wp), intent(inout) :: q(:)                  !! (n_q bodies) positions, moved [any]
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
         q_new = q
         call system%linkage%coordinates%add_change(system%linkage%bodies%n, part*direction*position_scale(system), q_new)
         call solve_positions(system%linkage, 0.0_wp, newton, q_new, outcome)
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
