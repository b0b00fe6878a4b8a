!> Heun's method of order 2 with fixed steps.
!>
!> $$ y_1 = y_0 + h (k_1 + k_2)/2, k_1 = f(t, y_0), k_2 = f(t + h, y_0 + h k_1) $$
!>
!> Source: K. Heun, Neue Methoden zur approximativen Integration der Differentialgleichungen einer unabhaengigen Veraenderlichen,
!> Z. Math. Phys. 45 (1900) 23-38. Limits: not for stiff equations; no control of the error.
module heun
   use integration_method, only: abilities_t, steps_fixed
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   use one_step, only: one_step_t
   implicit none (type, external)
   private
   public :: heun_t

   !> The method with its workspace.
   type, extends(one_step_t) :: heun_t
      real(wp), allocatable :: k2(:)   !! (n) derivative at the end of Euler's step [any]
      real(wp), allocatable :: y(:)    !! (n) state there [any]
   contains
      procedure, nopass :: info => heun_info
      procedure, nopass :: abilities => heun_abilities
      procedure :: prepare => heun_prepare
      procedure :: make_stages => heun_make_stages
      procedure :: error_norm => heun_error_norm
   end type heun_t

contains

   !> Description of the method.
   function heun_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "heun"
      info%help = "Heun's method of order 2 with the fixed step `step`"
      info%source = "Heun (1900)"
   end function heun_info

   !> What it can do: fixed steps.
   pure type(abilities_t) function heun_abilities() result(can)
      can = abilities_t(steps=steps_fixed)
   end function heun_abilities

   !> Storage for the stage.
   subroutine heun_prepare(self, n)
      class(heun_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n              !! entries of the state

      self%order = 2
      self%n_new_stage = 1
      if (.not. allocated(self%y)) allocate (self%k2(n), self%y(n), source=0.0_wp)
   end subroutine heun_prepare

   !> Stage of a step of length h from the start of the present step; the end state into `trial`.
   subroutine heun_make_stages(self, system, h, status)
      class(heun_t), intent(inout) :: self          !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluation

      self%count%n_evaluations = self%count%n_evaluations + 1
      self%y = self%step%y0 + h*self%step%f0
      call system%evaluate(self%step%t0 + h, self%y, self%k2, status)
      self%trial = self%step%y0 + 0.5_wp*h*(self%step%f0 + self%k2)
   end subroutine heun_make_stages

   !> There is no estimate: a step that is not fixed is refused.
   real(wp) function heun_error_norm(self, system, h) result(norm)
      class(heun_t), intent(inout) :: self       !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      norm = huge(1.0_wp)
   end function heun_error_norm

end module heun
