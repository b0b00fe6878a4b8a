!> Dormand and Prince's Runge-Kutta method of order 8 with error estimates of orders 5 and 3: DOP853.
!>
!> Twelve stages and the derivative at the end, which is the first stage of the next step. With E_5 and E_3 the norms of the two
!> estimates the error is
!>
!> $$ E = E_5^2 / \sqrt{E_5^2 + E_3^2/100} $$
!>
!> of order 8 in the step. Output between steps has three more stages (`dop853_output`); until it is asked for, and for the search
!> of events, the step is the quintic of `interpolation`. Steps and events: see `one_step`. For tight tolerances: below about 1e-6
!> it takes fewer evaluations than methods of order 6. Where a force of contact starts or ends time may go as a square
!> (`step_course`): derivatives are those by the parameter of the step then.
!>
!> Source: E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), section II.5 and II.6,
!> with the coefficients of their code DOP853. Limits: not for stiff equations.
module dop853
   use dop853_stages, only: dop853_stages_t, dop853_bound
   use interpolation, only: interpolate
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   use one_step, only: one_step_t
   use quadrature_error, only: counts_quadratures
   implicit none (type, external)
   private
   public :: dop853_t

   !> The method with its workspace.
   type, extends(one_step_t) :: dop853_t
      type(dop853_stages_t), private :: stages    !! of the step in hand
   contains
      procedure, nopass :: info => dop853_info
      procedure :: prepare => dop853_prepare
      procedure :: make_stages => dop853_make_stages
      procedure :: error_norm => dop853_error_norm
      procedure :: fastest_rate => dop853_fastest_rate
      procedure :: prepare_output => dop853_prepare_output
      procedure :: within => dop853_within
   end type dop853_t

contains

   !> Description of the method.
   function dop853_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "dop853"
      info%help = "Dormand-Prince 8(5,3), DOP853: explicit, twelve stages, for tight tolerances, events located by re-stepping"
      info%source = "Hairer, Norsett and Wanner (1993)"
   end function dop853_info

   !> Storage for the stages.
   subroutine dop853_prepare(self, n)
      class(dop853_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n                !! entries of the state

      self%order = 8
      self%pace%bends = .true.
      self%stability%bound = dop853_bound
      call self%stages%open(n, self%n_new_stage)
   end subroutine dop853_prepare

   !> Stages of a step of length h from the start of the present step; the end state into `trial`.
   subroutine dop853_make_stages(self, system, h, status)
      class(dop853_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      call self%stages%make(system, self%step, h, self%trial, self%count%n_evaluations, status)
   end subroutine dop853_make_stages

   !> Norm of the error estimate of the trial step, over the tolerance.
   real(wp) function dop853_error_norm(self, system, h) result(norm)
      class(dop853_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      call self%set_scales(system, self%trial)
      norm = self%stages%norm(system%n - system%n_quadrature, self%scale, self%controls%norm)
      norm = h*norm/self%controls%tolerance
      if (counts_quadratures(system, norm)) &
         norm = max(norm, self%stages%quadrature_norm(system, h/self%controls%tolerance))
   end function dop853_error_norm

   !> Rate at which the last two states at the end of the step make a difference of each other decay or swing.
   real(wp) function dop853_fastest_rate(self, n) result(rate)
      class(dop853_t), intent(in) :: self  !! the integrator, after a step
      integer, intent(in) :: n             !! entries without quadratures

      rate = self%stages%fastest_rate(n, self%step, self%scale)
   end function dop853_fastest_rate

   !> The interpolant of order 7 of the last step. Stages of another length, as a search in the step leaves them, are made again.
   subroutine dop853_prepare_output(self, system, status)
      class(dop853_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! of the evaluations

      status = 0
      if (self%step%has_inner .or. self%step%h <= 0.0_wp) return
      associate (count => self%count, stages => self%stages)
         count%n_output_evaluations = count%n_output_evaluations - count%n_evaluations
         if (.not. stages%are_of(self%step)) call self%refine(system, 1.0_wp, self%scratch, status)
         if (status == 0) call stages%fit_output(system, self%step, count%n_evaluations, status)
         count%n_output_evaluations = count%n_output_evaluations + count%n_evaluations
      end associate
      self%step%has_inner = status == 0
   end subroutine dop853_prepare_output

   !> State at a place of the last step, by interpolation: of order 7 once `prepare_output` was called.
   subroutine dop853_within(self, system, s, y)
      class(dop853_t), intent(in) :: self        !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
      real(wp), intent(inout) :: y(system%n)     !! (n) state [any]

      integer :: n

      if (self%step%has_inner) then
         call self%stages%within(system, self%step, s, y)
      else
         n = system%n
         if (.not. system%traits%with_quadratures) n = n - system%n_quadrature
         call interpolate(self%step, system%n_position, system%traits%n_turning, s, n, y)
      end if
   end subroutine dop853_within

end module dop853
