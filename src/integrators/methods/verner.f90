!> Runge-Kutta-Verner, order 6 with an error estimate of order 5, in the manner of DVERK and IVPRK.
!>
!> Eight stages; the weights of order 6 carry the solution, their difference to weights of order 5
!> over the first six stages estimates the local error. Steps and events: see `one_step`.
!>
!> Source: J. H. Verner, Explicit Runge-Kutta methods with estimates of the local truncation error,
!> SIAM J. Numer. Anal. 15 (1978) 772-790; Hull, Enright and Jackson, DVERK (1976), whose
!> coefficients these are. Limits: not for stiff equations.
module verner
   use integrator_controls, only: norm_euclidean
   use interpolation, only: step_t
   use integration_method, only: abilities_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   use ode_system, only: ode_system_t
   use one_step, only: one_step_t
   use quadrature_error, only: by_one_step, counts_quadratures, max_error
   use stability_limit, only: rate_between
   use diverged_stages, only: evaluate_aside, judge_stage
   implicit none (type, external)
   private
   public :: verner_stages_t, verner_bound, verner_t

   real(wp), parameter :: c2 = 1.0_wp/6.0_wp, c3 = 4.0_wp/15.0_wp, c4 = 2.0_wp/3.0_wp, c5 = 5.0_wp/6.0_wp, &
      c7 = 1.0_wp/15.0_wp  !! places of the stages; c6 = c8 = 1 [1]
   real(wp), parameter :: a21 = 1.0_wp/6.0_wp, &
      a31 = 4.0_wp/75.0_wp, a32 = 16.0_wp/75.0_wp, &
      a41 = 5.0_wp/6.0_wp, a42 = -8.0_wp/3.0_wp, a43 = 5.0_wp/2.0_wp, &
      a51 = -165.0_wp/64.0_wp, a52 = 55.0_wp/6.0_wp, a53 = -425.0_wp/64.0_wp, a54 = 85.0_wp/96.0_wp, &
      a61 = 12.0_wp/5.0_wp, a62 = -8.0_wp, a63 = 4015.0_wp/612.0_wp, a64 = -11.0_wp/36.0_wp, a65 = 88.0_wp/255.0_wp, &
      a71 = -8263.0_wp/15000.0_wp, a72 = 124.0_wp/75.0_wp, a73 = -643.0_wp/680.0_wp, a74 = -81.0_wp/250.0_wp, &
      a75 = 2484.0_wp/10625.0_wp, &
      a81 = 3501.0_wp/1720.0_wp, a82 = -300.0_wp/43.0_wp, a83 = 297275.0_wp/52632.0_wp, a84 = -319.0_wp/2322.0_wp, &
      a85 = 24068.0_wp/84065.0_wp, a87 = 3850.0_wp/26703.0_wp  !! the method [1]
   real(wp), parameter :: b1 = 3.0_wp/40.0_wp, b3 = 875.0_wp/2244.0_wp, b4 = 23.0_wp/72.0_wp, b5 = 264.0_wp/1955.0_wp, &
      b7 = 125.0_wp/11592.0_wp, b8 = 43.0_wp/616.0_wp  !! weights of order 6 [1]
   real(wp), parameter :: e1 = b1 - 13.0_wp/160.0_wp, e3 = b3 - 2375.0_wp/5984.0_wp, e4 = b4 - 5.0_wp/16.0_wp, &
      e5 = b5 - 12.0_wp/85.0_wp, e6 = -3.0_wp/44.0_wp, e7 = b7, e8 = b8  !! less those of order 5 [1]

   integer, parameter :: n_new_stage = 7  !! evaluations of a trial step; the first stage is known
   real(wp), parameter :: verner_bound = 4.07_wp  !! stable up to -4.07 along the negative real axis [1]

   !> Stages of a step.
   type :: verner_stages_t
      real(wp), allocatable :: k(:, :)              !! (n, 2:8) derivatives of the stages; the first is step%f0 [any]
      real(wp), allocatable :: y(:)                 !! (n) state of a stage, the last one at its end [any]
   contains
      procedure :: open => stages_open
      procedure :: make => stages_make
      procedure :: norm => stages_norm
      procedure :: quadrature_norm => stages_quadrature_norm
      procedure :: fastest_rate => stages_fastest_rate
   end type verner_stages_t

   !> Verner's method with its workspace.
   type, extends(one_step_t) :: verner_t
      type(verner_stages_t) :: stages               !! of the step in hand
   contains
      procedure, nopass :: info => verner_info
      procedure, nopass :: abilities => verner_abilities
      procedure :: prepare => verner_prepare
      procedure :: make_stages => verner_make_stages
      procedure :: error_norm => verner_error_norm
      procedure :: fastest_rate => verner_fastest_rate
   end type verner_t

contains

   !> Description of the method.
   function verner_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "verner"
      info%help = "Runge-Kutta-Verner 5(6) as in IMSL's IVPRK: explicit, eight stages, events located by re-stepping"
      info%source = "Verner (1978); Hull, Enright and Jackson (1976)"
   end function verner_info

   !> The first method that confirms others.
   pure type(abilities_t) function verner_abilities() result(can)
      can = abilities_t(reference_place=1)
   end function verner_abilities

   !> Storage for the stages.
   subroutine verner_prepare(self, n)
      class(verner_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n                !! entries of the state

      self%order = 6
      self%stability%bound = verner_bound
      call self%stages%open(n, self%n_new_stage)
   end subroutine verner_prepare

   !> Stages of a step of length h from the start of the present step; the end state into `trial`.
   subroutine verner_make_stages(self, system, h, status)
      class(verner_t), intent(inout) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      call self%stages%make(system, self%step, h, self%trial, self%count%n_evaluations, status)
   end subroutine verner_make_stages

   !> Room.
   subroutine stages_open(self, n, n_stage)
      class(verner_stages_t), intent(inout) :: self  !! the stages
      integer, intent(in) :: n                       !! entries of the state
      integer, intent(out) :: n_stage                !! evaluations of a trial step

      n_stage = n_new_stage
      if (.not. allocated(self%k)) allocate (self%k(n, 2:8), self%y(n), source=0.0_wp)
   end subroutine stages_open

   !> Stages of a step of length h from the start of another.
   subroutine stages_make(self, system, step, h, y_end, n_evaluation, status)
      class(verner_stages_t), intent(inout) :: self !! the stages
      class(ode_system_t), intent(inout) :: system  !! the system
      type(step_t), intent(in) :: step              !! its start
      real(wp), intent(in) :: h                     !! length [s]
      real(wp), intent(inout) :: y_end(:)           !! (n) state at the end of the step, set [any]
      integer(i8), intent(inout) :: n_evaluation    !! evaluations so far
      integer, intent(out) :: status                !! of the evaluations

      n_evaluation = n_evaluation + n_new_stage
      call pass_stages(system, system%n, step%t0, h, step%y0, step%f0, self%k(:, 2), self%k(:, 3), self%k(:, 4), self%k(:, 5), &
                       self%k(:, 6), self%k(:, 7), self%k(:, 8), self%y, y_end, status)
   end subroutine stages_make

   !> The same on plain arrays. Nothing depends on quadratures: states of stages are without them, and so are derivatives of stages
   !> that the end state has no part of.
   !> Length: a formula for each stage.
   subroutine pass_stages(system, n_all, t, h, y0, k1, k2, k3, k4, k5, k6, k7, k8, y, y_end, status)
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(in) :: n_all                  !! entries of the state
      real(wp), intent(in) :: t                     !! time at the start of the step [s]
      real(wp), intent(in) :: h                     !! its length [s]
      real(wp), intent(in) :: y0(n_all)             !! (n_all) state at its start [any]
      real(wp), intent(in) :: k1(n_all)             !! (n_all) derivative there, the first stage [any]
      real(wp), intent(inout), dimension(n_all) :: k2, k3, k4, k5, k6, k7, k8  !! (n_all) derivatives of the other stages [any]
      real(wp), intent(inout) :: y(n_all)           !! (n_all) scratch: state of a stage [any]
      real(wp), intent(inout) :: y_end(n_all)       !! (n_all) state at the end of the step, set [any]
      integer, intent(out) :: status                !! of the evaluations

      integer :: i, m, n
      logical :: is_blind

      is_blind = .not. system%traits%sees_diverged
      m = system%n_position
      n = system%n - system%n_quadrature
      do concurrent(i=1:n)
         y(i) = y0(i) + h*a21*k1(i)
      end do
      call evaluate_aside(system, t + c2*h, y, k2, status)
      if (is_blind) call judge_stage(n - m, k2(m + 1), status)
      if (status /= 0) return
      do concurrent(i=1:n)
         y(i) = y0(i) + h*(a31*k1(i) + a32*k2(i))
      end do
      call system%evaluate(t + c3*h, y, k3, status)
      if (is_blind) call judge_stage(n - m, k3(m + 1), status)
      if (status /= 0) return
      do concurrent(i=1:n)
         y(i) = y0(i) + h*(a41*k1(i) + a42*k2(i) + a43*k3(i))
      end do
      call system%evaluate(t + c4*h, y, k4, status)
      if (is_blind) call judge_stage(n - m, k4(m + 1), status)
      if (status /= 0) return
      do concurrent(i=1:n)
         y(i) = y0(i) + h*(a51*k1(i) + a52*k2(i) + a53*k3(i) + a54*k4(i))
      end do
      call system%evaluate(t + c5*h, y, k5, status)
      if (is_blind) call judge_stage(n - m, k5(m + 1), status)
      if (status /= 0) return
      ! stage 7 does not need stage 6; evaluated before it, all stages at the end of the step follow one another, and what
      ! is a function of time alone is found once
      do concurrent(i=1:n)
         y(i) = y0(i) + h*(a71*k1(i) + a72*k2(i) + a73*k3(i) + a74*k4(i) + a75*k5(i))
      end do
      call system%evaluate(t + c7*h, y, k7, status)
      if (is_blind) call judge_stage(n - m, k7(m + 1), status)
      if (status /= 0) return
      do concurrent(i=1:n)
         y(i) = y0(i) + h*(a61*k1(i) + a62*k2(i) + a63*k3(i) + a64*k4(i) + a65*k5(i))
      end do
      call evaluate_aside(system, t + h, y, k6, status)
      if (is_blind) call judge_stage(n - m, k6(m + 1), status)
      if (status /= 0) return
      do concurrent(i=1:n)
         y(i) = y0(i) + h*(a81*k1(i) + a82*k2(i) + a83*k3(i) + a84*k4(i) + a85*k5(i) + a87*k7(i))
      end do
      call system%evaluate(t + h, y, k8, status)
      if (is_blind) call judge_stage(n - m, k8(m + 1), status)
      if (status /= 0) return
      do concurrent(i=1:n_all)
         y_end(i) = y0(i) + h*(b1*k1(i) + b3*k3(i) + b4*k4(i) + b5*k5(i) + b7*k7(i) + b8*k8(i))
      end do
   end subroutine pass_stages

   !> Norm of the error estimate of the trial step, over the tolerance.
   real(wp) function verner_error_norm(self, system, h) result(norm)
      class(verner_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      call self%set_scales(system, self%trial)
      norm = self%stages%norm(system, self%step%f0, self%scale, self%controls%norm == norm_euclidean)
      norm = h*norm/self%controls%tolerance
      if (counts_quadratures(system, norm)) &
         norm = max(norm, self%stages%quadrature_norm(system, self%step%f0, h/self%controls%tolerance))
   end function verner_error_norm

   !> Rate at which the last two states at the end of the step make a difference of each other decay or swing.
   real(wp) function verner_fastest_rate(self, n) result(rate)
      class(verner_t), intent(in) :: self  !! the integrator, after a step
      integer, intent(in) :: n             !! entries without quadratures

      rate = self%stages%fastest_rate(n, self%step, self%scale)
   end function verner_fastest_rate

   !> The same of stages.
   pure real(wp) function stages_fastest_rate(self, n, step, scale) result(rate)
      class(verner_stages_t), intent(in) :: self  !! the stages
      integer, intent(in) :: n                    !! entries without quadratures
      type(step_t), intent(in) :: step            !! the step that they made
      real(wp), intent(in) :: scale(:)            !! (n or more) what the entries are measured by [any]

      rate = rate_between(n, self%y, self%k(:, 8), step%y1, step%f1, scale)
   end function stages_fastest_rate

   !> Norm of the error estimate by length of the step, over the scales.
   real(wp) function stages_norm(self, system, f0, scale, is_euclidean) result(norm)
      class(verner_stages_t), intent(in) :: self !! the stages
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: f0(:)              !! (n) derivative at the start of the step [any]
      real(wp), intent(in) :: scale(:)           !! (n) what the entries are measured by [any]
      logical, intent(in) :: is_euclidean        !! the root of the sum of squares; else the maximum entry

      norm = estimate_norm(system%n - system%n_quadrature, system%n, is_euclidean, f0, self%k, scale)
   end function stages_norm

   !> Norm of the error estimates of the quadratures. Stages 6 and 8 are both at the end of the step, where a power is the same to
   !> the order of the estimate, and the first of them is evaluated without quadratures: the second stands for both.
   real(wp) function stages_quadrature_norm(self, system, f0, part) result(norm)
      class(verner_stages_t), intent(in) :: self !! the stages
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: f0(:)              !! (n) derivative at the start of the step [any]
      real(wp), intent(in) :: part               !! length of the step over the tolerance [s]

      real(wp) :: estimate(system%n_quadrature)
      integer :: i, n

      n = system%n - system%n_quadrature
      associate (k => self%k)
         do i = 1, system%n_quadrature
            estimate(i) = part*(e1*f0(n + i) + e3*k(n + i, 3) + e4*k(n + i, 4) + e5*k(n + i, 5) + e7*k(n + i, 7) &
                                + (e6 + e8)*k(n + i, 8))
         end do
      end associate
      norm = max_error(system%n_quadrature, estimate, system%traits%quadrature_scale, by_one_step)
   end function stages_quadrature_norm

   !> The norm of the motion on plain arrays.
   pure real(wp) function estimate_norm(n, n_all, is_euclidean, k1, k, scale) result(norm)
      integer, intent(in) :: n                !! entries that count
      integer, intent(in) :: n_all            !! entries of the state
      logical, intent(in) :: is_euclidean     !! the root of the sum of squares; else the maximum entry
      real(wp), intent(in) :: k1(n_all)       !! (n_all) derivative of the first stage [any]
      real(wp), intent(in) :: k(n_all, 2:8)   !! (n_all, 2:8) derivatives of the other stages [any]
      real(wp), intent(in) :: scale(n_all)    !! (n_all) what the entries are measured by [any]

      real(wp) :: estimate
      integer :: i

      norm = 0.0_wp
      do i = 1, n
         estimate = abs(e1*k1(i) + e3*k(i, 3) + e4*k(i, 4) + e5*k(i, 5) + e6*k(i, 6) + e7*k(i, 7) + e8*k(i, 8))/scale(i)
         if (is_euclidean) then
            norm = norm + estimate**2
         else if (.not. estimate <= norm) then
            norm = estimate  ! a NaN comes through
         end if
      end do
      if (is_euclidean) norm = sqrt(norm)
   end function estimate_norm

end module verner
