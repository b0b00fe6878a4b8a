!> Evaluation of the stages of a step. A derivative may be that of a step far too long for a stiff force: such a step is given up
!> before its numbers overflow. A system may see that itself, while it has them in hand (`sees_diverged`).
module diverged_stages
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: evaluate_aside, is_diverged, judge_stage, overflow_limit

   real(wp), parameter :: overflow_limit = 1.0e60_wp        !! derivative of a trial step far too long for a stiff force [any]

contains

   !> Derivative at a stage that the end of the step has no part of, without quadratures, on which nothing depends.
   subroutine evaluate_aside(system, t, y, f, status)
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time of the stage [s]
      real(wp), intent(in) :: y(system%n)           !! (n) its state, whose quadratures are not read [any]
      real(wp), intent(inout) :: f(system%n)        !! (n) its derivative [any]
      integer, intent(out) :: status                !! that of the system

      logical :: are_wanted

      are_wanted = system%traits%with_quadratures
      system%traits%with_quadratures = .false.
      call system%evaluate(t, y, f, status)
      system%traits%with_quadratures = are_wanted
   end subroutine evaluate_aside

   !> Whether a derivative is that of a step far too long, or no number: nothing can be evaluated from there on.
   pure logical function is_diverged(n, f)
      integer, intent(in) :: n       !! entries
      real(wp), intent(in) :: f(n)   !! (n) derivative [any]

      integer :: i

      is_diverged = .false.
      do i = 1, n
         is_diverged = .not. abs(f(i)) <= overflow_limit  ! what is not finite too
         if (is_diverged) return
      end do
   end function is_diverged

   !> Give up a step at a stage whose derivative is wild: the states of the next ones would be, and squares of their speeds
   !> overflow.
   pure subroutine judge_stage(n, f, status)
      integer, intent(in) :: n            !! entries that count: the derivatives that forces make
      real(wp), intent(in) :: f(n)        !! (n) derivative, if there is one [any]
      integer, intent(inout) :: status    !! of the evaluation; 1: wild

      if (status /= 0) return
      if (is_diverged(n, f)) status = 1
   end subroutine judge_stage

end module diverged_stages
