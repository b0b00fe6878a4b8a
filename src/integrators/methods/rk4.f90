!> The classical Runge-Kutta method of order 4 with fixed steps, as programs of old use it.
!>
!> $$ y_1 = y_0 + h (k_1 + 2 k_2 + 2 k_3 + k_4)/6 $$
!> $$ k_1 = f(t, y_0), k_2 = f(t + h/2, y_0 + h k_1/2), k_3 = f(t + h/2, y_0 + h k_2/2), k_4 = f(t + h, y_0 + h k_3) $$
!>
!> It has no error estimate: the deck must give `step`. Events and stops are met by a shorter step
!> of the same method, so that they are of order 4 too; the grid continues from there.
!>
!> Source: W. Kutta, Beitrag zur naeherungsweisen Integration totaler Differentialgleichungen,
!> Z. Math. Phys. 46 (1901) 435-453. Limits: not for stiff equations; no control of the error.
module rk4
   use integration_method, only: abilities_t, steps_fixed
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   use one_step, only: one_step_t
   use diverged_stages, only: overflow_limit
   implicit none (type, external)
   private
   public :: rk4_t

   !> The method with its workspace.
   type, extends(one_step_t) :: rk4_t
      real(wp), allocatable :: k(:, :)   !! (n, 2:4) derivatives of the stages; the first is step%f0 [any]
      real(wp), allocatable :: y(:)      !! (n) state of a stage [any]
   contains
      procedure, nopass :: info => rk4_info
      procedure, nopass :: abilities => rk4_abilities
      procedure :: prepare => rk4_prepare
      procedure :: make_stages => rk4_make_stages
      procedure :: error_norm => rk4_error_norm
   end type rk4_t

contains

   !> Description of the method.
   function rk4_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "rk4"
      info%help = "classical Runge-Kutta of order 4 with the fixed step `step`, as in legacy programs: no error control, " &
                  //"events located by re-stepping"
      info%source = "Kutta (1901)"
   end function rk4_info

   !> Fixed steps only.
   pure type(abilities_t) function rk4_abilities() result(can)
      can = abilities_t(steps=steps_fixed)
   end function rk4_abilities

   !> Storage for the stages.
   subroutine rk4_prepare(self, n)
      class(rk4_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n             !! entries of the state

      self%order = 4
      self%n_new_stage = 3
      if (.not. allocated(self%k)) allocate (self%k(n, 2:4), self%y(n), source=0.0_wp)
   end subroutine rk4_prepare

   !> Stages of a step of length h from the start of the present step; the end state into `trial`.
   subroutine rk4_make_stages(self, system, h, status)
      class(rk4_t), intent(inout) :: self           !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      real(wp) :: t
      integer :: i, n, tame

      n = size(self%y)
      t = self%step%t0
      associate (y0 => self%step%y0, k1 => self%step%f0, k => self%k, y => self%y)
         self%count%n_evaluations = self%count%n_evaluations + 3
         call next_state(n, y0, 0.5_wp*h, k1, y, status)
         if (status == 0) call system%evaluate(t + 0.5_wp*h, y, k(:, 2), status)
         if (status == 0) call next_state(n, y0, 0.5_wp*h, k(:, 2), y, status)
         if (status == 0) call system%evaluate(t + 0.5_wp*h, y, k(:, 3), status)
         if (status == 0) call next_state(n, y0, h, k(:, 3), y, status)
         if (status == 0) call system%evaluate(t + h, y, k(:, 4), status)
         if (status /= 0) return
         tame = 0
         do i = 1, n
            self%trial(i) = y0(i) + h/6.0_wp*(k1(i) + 2.0_wp*(k(i, 2) + k(i, 3)) + k(i, 4))
            tame = tame + merge(1, 0, abs(k(i, 4)) <= overflow_limit)
         end do
         if (tame < n) status = 1
      end associate
   end subroutine rk4_make_stages

   !> State of the next evaluation. Whether the derivative is wild, as `is_diverged` has it, is seen in the same loop: of a large
   !> system every other one waits for memory.
   pure subroutine next_state(n, y0, h, f, y, status)
      integer, intent(in) :: n          !! entries of the state
      real(wp), intent(in) :: y0(n)     !! (n) state at the start of the step [any]
      real(wp), intent(in) :: h         !! time from there [s]
      real(wp), intent(in) :: f(n)      !! (n) derivative [any]
      real(wp), intent(inout) :: y(n)   !! (n) state [any]
      integer, intent(out) :: status    !! 1: wild

      integer :: i, tame

      tame = 0
      do i = 1, n
         y(i) = y0(i) + h*f(i)
         tame = tame + merge(1, 0, abs(f(i)) <= overflow_limit)
      end do
      status = merge(1, 0, tame < n)
   end subroutine next_state

   !> There is no estimate: a step that is not fixed is refused.
   real(wp) function rk4_error_norm(self, system, h) result(norm)
      class(rk4_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      norm = huge(1.0_wp)
   end function rk4_error_norm

end module rk4
