!> Kinematic analysis at one instant: positions, velocities and accelerations that the rows determine.
!>
!> Positions by Newton's iteration, Phi_q dq = -Phi(q, t), until Phi is at round-off; velocities
!> Phi_q v = -Phi_t and accelerations Phi_q a = gamma in one step each, with one refinement.
!> Redundant rows do no harm as long as they agree (least squares by singular values). Where branches of the
!> motion meet the rows are closed to second order by any position nearby, so that positions are known only to the
!> square root of round-off, and rates not at all: such an instant is called singular.
!>
!> Source: Flores et al. (2008), section 2.4, eqs. (2.9)-(2.11), figure 2.5. Limits: as many independent rows as
!> coordinates; a position near the one given.
module prescribed_motion
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: i8, wp
   use linkage, only: linkage_t
   use row_corrections, only: evaluate_rows, min_correction, limit_step, rates, worst_violation
   implicit none (type, external)
   private
   public :: newton_t, solve_positions, solve_rates
   public :: solved, open_rows, singular, contradictory, not_finite_rows

   integer, parameter :: solved = 0            !! outcome: done
   integer, parameter :: open_rows = 1         !! outcome: Newton's iteration did not close the rows
   integer, parameter :: singular = 2          !! outcome: fewer independent rows than coordinates
   integer, parameter :: contradictory = 3     !! outcome: no rates fulfil all rows
   integer, parameter :: not_finite_rows = 4   !! outcome: a row is not a finite number

   real(wp), parameter :: round_off = 1.0e-15_wp     !! scaled violation at which Newton stops early [1]
   real(wp), parameter :: near_singular = 1.0e-6_wp  !! ratio of singular values below which positions, known to round-off, do
                                                     !! not report rates any more, because they sit where the ratio is zero [1]
   real(wp), parameter :: contradiction = 1.0e-8_wp  !! scaled rate left, of the largest, that cannot be round-off [1]

   !> Controls and cost of Newton's iteration.
   type :: newton_t
      real(wp) :: tolerance = 1.0e-10_wp       !! maximum scaled violation that counts as closed [1]
      integer :: most = 25                     !! corrections allowed
      integer(i8) :: n_solved = 0              !! linear equations solved so far
   end type newton_t

contains

   !> Positions at a time, from a guess.
   subroutine solve_positions(linkage, t, newton, q, outcome)
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows, all joints ideal; rows are evaluated
      real(wp), intent(in) :: t                        !! time [s]
      type(newton_t), intent(inout) :: newton          !! controls and cost
      real(wp), intent(inout) :: q(:)                  !! (n_q bodies) guess, then positions [any]
      integer, intent(out) :: outcome                  !! one of the above

      real(wp), dimension(linkage%coordinates%n_v*linkage%bodies%n) :: correction, ease, rest
      real(wp) :: before, now
      integer :: k, rank

      ease = 1.0_wp
      rest = 0.0_wp
      before = huge(1.0_wp)
      rank = size(rest)
      outcome = solved
      do k = 0, newton%most
         call evaluate_rows(linkage, t, q, rest)
         if (.not. (all(ieee_is_finite(linkage%rows%phi)) .and. all(ieee_is_finite(linkage%rows%jac)))) then
            outcome = not_finite_rows
            return
         end if
         now = worst_violation(linkage)
         if (now <= round_off .or. (now <= newton%tolerance .and. now >= 0.5_wp*before)) exit
         if (k == newton%most) exit
         before = now
         call min_correction(linkage, -linkage%rows%phi, ease, correction, rank)
         newton%n_solved = newton%n_solved + 1_i8
         call linkage%coordinates%add_change(linkage%bodies%n, limit_step(linkage, correction), q)
      end do
      if (rank < size(rest)) outcome = singular
      if (now > newton%tolerance) outcome = open_rows
   end subroutine solve_positions

   !> Velocities and accelerations at solved positions.
   subroutine solve_rates(linkage, t, newton, q, v, a, outcome)
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows; rows, phi_dot and motion are set
      real(wp), intent(in) :: t                        !! time [s]
      type(newton_t), intent(inout) :: newton          !! cost
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) positions [any]
      real(wp), intent(out) :: v(:)                    !! (n_v bodies) velocities [m/s or rad/s]
      real(wp), intent(out) :: a(:)                    !! (n_v bodies) accelerations [m/s^2 or rad/s^2]
      integer, intent(out) :: outcome                  !! one of the above

      real(wp) :: left(linkage%rows%n)

      v = 0.0_wp
      call evaluate_rows(linkage, t, q, v)
      call refine(linkage, newton, -linkage%rows%phi_t, v, left, outcome)
      call evaluate_rows(linkage, t, q, v)
      call rates(linkage, v, linkage%solution%phi_dot)
      a = 0.0_wp
      if (outcome /= solved) return
      if (.not. all(ieee_is_finite(linkage%rows%gam))) then
         outcome = not_finite_rows
         return
      end if
      call refine(linkage, newton, linkage%rows%gam, a, left, outcome)
   end subroutine solve_rates

   !> Solve Phi_q x = right, with one refinement.
   subroutine refine(linkage, newton, right, x, left, outcome)
      type(linkage_t), intent(in) :: linkage           !! the bodies and their rows, rows evaluated
      type(newton_t), intent(inout) :: newton          !! cost
      real(wp), intent(in) :: right(:)                 !! (rows) right-hand side [rates of the rows]
      real(wp), intent(inout) :: x(:)                  !! (n_v bodies) zero, then the solution [rates of the coordinates]
      real(wp), intent(out) :: left(:)                 !! (rows) what is left of the right-hand side [rates of the rows]
      integer, intent(out) :: outcome                  !! one of the above

      real(wp) :: correction(size(x)), ease(size(x)), none(size(right))
      integer :: k, rank

      ease = 1.0_wp
      none = linkage%rows%phi_t
      do k = 1, 2
         call rates(linkage, x, left)
         call min_correction(linkage, right - (left - none), ease, correction, rank, near_singular)
         newton%n_solved = newton%n_solved + 1_i8
         x = x + correction
      end do
      call rates(linkage, x, left)
      left = right - (left - none)
      outcome = solved
      if (maxval(abs(left)*linkage%solution%row_weight) > contradiction*(1.0_wp &
          + maxval(abs(right)*linkage%solution%row_weight))) then
         outcome = contradictory
      end if
      if (rank < size(x)) outcome = singular
   end subroutine refine

end module prescribed_motion
