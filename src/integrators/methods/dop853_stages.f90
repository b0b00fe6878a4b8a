!> Stages of Dormand and Prince's Runge-Kutta method of order 8: the coefficients, and what follows from the stages of a step.
!>
!> Source and limits: see `dop853`.
module dop853_stages
   use integrator_controls, only: norm_euclidean
   use interpolation, only: step_t
   use kinds, only: i8, wp
   use ode_system, only: ode_system_t
   use quadrature_error, only: by_one_step, max_error
   use stability_limit, only: rate_between
   use step_course, only: course_even, pace_at
   use diverged_stages, only: evaluate_aside, judge_stage
   implicit none (type, external)
   private
   public :: dop853_stages_t, dop853_bound

   real(wp), parameter :: c(2:12) = [0.05260015195876773_wp, 0.0789002279381516_wp, 0.1183503419072274_wp, &
      0.2816496580927726_wp, 1.0_wp/3.0_wp, 1.0_wp/4.0_wp, 4.0_wp/13.0_wp, 127.0_wp/195.0_wp, 3.0_wp/5.0_wp, 6.0_wp/7.0_wp, &
      1.0_wp]  !! places of the stages [1]
   real(wp), parameter :: a2(1) = [0.05260015195876773_wp]  !! stage 2 [1]
   real(wp), parameter :: a3(2) = [0.0197250569845379_wp, 0.0591751709536137_wp]  !! stage 3 [1]
   real(wp), parameter :: a4(3) = [0.02958758547680685_wp, 0.0_wp, 0.08876275643042054_wp]  !! stage 4 [1]
   real(wp), parameter :: a5(4) = [0.2413651341592667_wp, 0.0_wp, -0.8845494793282861_wp, &
      0.924834003261792_wp]  !! stage 5 [1]
   real(wp), parameter :: a6(5) = [1.0_wp/27.0_wp, 0.0_wp, 0.0_wp, 0.17082860872947386_wp, &
      0.12546768756682242_wp]  !! stage 6 [1]
   real(wp), parameter :: a7(6) = [19.0_wp/512.0_wp, 0.0_wp, 0.0_wp, 0.17025221101954405_wp, 0.06021653898045596_wp, &
      -9.0_wp/512.0_wp]  !! stage 7 [1]
   real(wp), parameter :: a8(7) = [0.03709200011850479_wp, 0.0_wp, 0.0_wp, 0.17038392571223998_wp, 0.10726203044637328_wp, &
      -0.015319437748624402_wp, 0.008273789163814023_wp]  !! stage 8 [1]
   real(wp), parameter :: a9(8) = [0.6241109587160757_wp, 0.0_wp, 0.0_wp, -3.3608926294469414_wp, -0.868219346841726_wp, &
      27.59209969944671_wp, 20.154067550477894_wp, -43.48988418106996_wp]  !! stage 9 [1]
   real(wp), parameter :: a10(9) = [0.47766253643826434_wp, 0.0_wp, 0.0_wp, -2.4881146199716677_wp, -0.590290826836843_wp, &
      21.230051448181193_wp, 15.279233632882423_wp, -33.28821096898486_wp, -0.020331201708508627_wp]  !! stage 10 [1]
   real(wp), parameter :: a11(10) = [-0.9371424300859873_wp, 0.0_wp, 0.0_wp, 5.186372428844064_wp, 1.0914373489967295_wp, &
      -8.149787010746927_wp, -18.52006565999696_wp, 22.739487099350505_wp, 2.4936055526796523_wp, &
      -3.0467644718982196_wp]  !! stage 11 [1]
   real(wp), parameter :: a12(11) = [2.273310147516538_wp, 0.0_wp, 0.0_wp, -10.53449546673725_wp, -2.0008720582248625_wp, &
      -17.9589318631188_wp, 27.94888452941996_wp, -2.8589982771350235_wp, -8.87285693353063_wp, 12.360567175794303_wp, &
      0.6433927460157636_wp]  !! stage 12 [1]
   real(wp), parameter :: b(12) = [0.054293734116568765_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 4.450312892752409_wp, &
      1.8915178993145003_wp, -5.801203960010585_wp, 0.3111643669578199_wp, -0.1521609496625161_wp, 0.20136540080403034_wp, &
      0.04471061572777259_wp]  !! weights of order 8 [1]
   real(wp), parameter :: e5(12) = [0.01312004499419488_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -1.2251564463762044_wp, &
      -0.4957589496572502_wp, 1.6643771824549864_wp, -0.35032884874997366_wp, 0.3341791187130175_wp, 0.08192320648511571_wp, &
      -0.022355307863886294_wp]  !! less those of order 5 [1]
   real(wp), parameter :: e3(12) = [-0.18980075407240762_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 4.450312892752409_wp, &
      1.8915178993145003_wp, -5.801203960010585_wp, -0.4226823213237919_wp, -0.1521609496625161_wp, 0.20136540080403034_wp, &
      0.02265179219836082_wp]  !! less those of order 3 [1]
   real(wp), parameter :: places(2:12, 0:2) = reshape([c, c*c, c*(2.0_wp - c)], [11, 3])  !! of the stages, by the course [1]
   real(wp), parameter :: paces(2:12, 0:2) = reshape([spread(1.0_wp, 1, 11), 2.0_wp*c, 2.0_wp*(1.0_wp - c)], &
                                                     [11, 3])  !! of time there [1]

   integer, parameter :: n_new_stage = 11  !! evaluations of a trial step; the first stage is known
   integer, parameter :: n_early = 5       !! stages after the first up to this one are of use to later stages only
   integer, parameter :: n_term = 8        !! terms of the interpolant
   real(wp), parameter :: dop853_bound = 6.1_wp  !! stable up to -6.1 along the negative real axis [1]

   !> Stages of a step.
   type :: dop853_stages_t
      real(wp), allocatable, private :: k(:, :)    !! (n, 16) derivatives of the stages; the last four are for interpolation [any]
      real(wp), allocatable, private :: y(:)       !! (n) state of a stage [any]
      real(wp), allocatable, private :: term(:, :) !! (n, 8) terms of the interpolant of the last step [any]
      real(wp), private :: h = 0.0_wp              !! length of the step whose stages `k` holds [s]
   contains
      procedure :: open => stages_open
      procedure :: make => stages_make
      procedure :: norm => stages_norm
      procedure :: quadrature_norm => stages_quadrature_norm
      procedure :: fastest_rate => stages_fastest_rate
      procedure :: are_of => stages_are_of
      procedure :: fit_output => stages_fit_output
      procedure :: within => stages_within
   end type dop853_stages_t

   interface
      !> The interpolant of a step that these stages made: three more stages.
      module subroutine stages_fit_output(self, system, step, n_evaluation, status)
         implicit none (type, external)
         class(dop853_stages_t), intent(inout) :: self !! the stages
         class(ode_system_t), intent(inout) :: system  !! the system
         type(step_t), intent(in) :: step              !! the step
         integer(i8), intent(inout) :: n_evaluation    !! evaluations so far
         integer, intent(out) :: status                !! of the evaluations
      end subroutine stages_fit_output

      !> State at a place of the step that the interpolant was fitted to.
      pure module subroutine stages_within(self, system, step, s, y)
         implicit none (type, external)
         class(dop853_stages_t), intent(in) :: self !! the stages
         class(ode_system_t), intent(in) :: system  !! the system
         type(step_t), intent(in) :: step           !! the step
         real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
         real(wp), intent(inout) :: y(system%n)     !! (n) state [any]
      end subroutine stages_within
   end interface

contains

   !> Room.
   subroutine stages_open(self, n, n_stage)
      class(dop853_stages_t), intent(inout) :: self  !! the stages
      integer, intent(in) :: n                       !! entries of the state
      integer, intent(out) :: n_stage                !! evaluations of a trial step

      n_stage = n_new_stage
      if (.not. allocated(self%k)) allocate (self%k(n, 16), self%y(n), self%term(n, n_term), source=0.0_wp)
   end subroutine stages_open

   !> Stages of a step of length h from the start of another; the end state into `y_end`. Nothing depends on quadratures:
   !> states of stages are without them, and so are derivatives of stages that the end state has no part of.
   subroutine stages_make(self, system, step, h, y_end, n_evaluation, status)
      class(dop853_stages_t), intent(inout) :: self !! the stages
      class(ode_system_t), intent(inout) :: system  !! the system
      type(step_t), intent(in) :: step              !! its start
      real(wp), intent(in) :: h                     !! length of the step [s]
      real(wp), intent(inout) :: y_end(:)           !! (n) state at the end of the step, set [any]
      integer(i8), intent(inout) :: n_evaluation    !! evaluations so far
      integer, intent(out) :: status                !! of the evaluations

      integer :: course, i, n

      n = system%n - system%n_quadrature
      n_evaluation = n_evaluation + n_new_stage
      self%h = h
      self%k(:, 1) = step%f0
      course = step%course
      if (course /= course_even) self%k(:, 1) = pace_at(course, 0.0_wp)*self%k(:, 1)
      do i = 2, 12
         call add_stages(i, n, system%n, step%y0, h, self%k, self%y)
         if (i > n_early) then
            call system%evaluate(step%t0 + places(i, course)*h, self%y, self%k(:, i), status)
         else
            call evaluate_aside(system, step%t0 + places(i, course)*h, self%y, self%k(:, i), status)
         end if
         if (.not. system%traits%sees_diverged) call judge_stage(n - system%n_position, self%k(system%n_position + 1:n, i), status)
         if (status /= 0) return
         if (course /= course_even) self%k(:, i) = paces(i, course)*self%k(:, i)
      end do
      call add_stages(13, system%n, system%n, step%y0, h, self%k, y_end)
   end subroutine stages_make

   !> State of a stage, y = y0 + h sum a_j k_j; of 13: that at the end of the step. Entry by entry, no sum is kept in memory.
   !> Length: a formula for each stage.
   pure subroutine add_stages(stage, n, n_all, y0, h, k, y)
      integer, intent(in) :: stage       !! the stage, 2 to 13
      integer, intent(in) :: n           !! entries that are requested
      integer, intent(in) :: n_all       !! entries of the state
      real(wp), intent(in) :: y0(n_all)  !! (n_all) state at the start [any]
      real(wp), intent(in) :: h          !! length of the step [s]
      real(wp), intent(in) :: k(n_all, 16)   !! (n_all, 16) derivatives [any]
      real(wp), intent(inout) :: y(n_all)    !! (n_all) state of the stage, n entries are set [any]

      integer :: e

      select case (stage)
      case (2)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a2(1)*k(e, 1))
         end do
      case (3)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a3(1)*k(e, 1) + a3(2)*k(e, 2))
         end do
      case (4)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a4(1)*k(e, 1) + a4(3)*k(e, 3))
         end do
      case (5)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a5(1)*k(e, 1) + a5(3)*k(e, 3) + a5(4)*k(e, 4))
         end do
      case (6)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a6(1)*k(e, 1) + a6(4)*k(e, 4) + a6(5)*k(e, 5))
         end do
      case (7)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a7(1)*k(e, 1) + a7(4)*k(e, 4) + a7(5)*k(e, 5) + a7(6)*k(e, 6))
         end do
      case (8)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a8(1)*k(e, 1) + a8(4)*k(e, 4) + a8(5)*k(e, 5) + a8(6)*k(e, 6) + a8(7)*k(e, 7))
         end do
      case (9)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a9(1)*k(e, 1) + a9(4)*k(e, 4) + a9(5)*k(e, 5) + a9(6)*k(e, 6) + a9(7)*k(e, 7) + a9(8)*k(e, 8))
         end do
      case (10)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a10(1)*k(e, 1) + a10(4)*k(e, 4) + a10(5)*k(e, 5) + a10(6)*k(e, 6) + a10(7)*k(e, 7) &
                             + a10(8)*k(e, 8) + a10(9)*k(e, 9))
         end do
      case (11)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a11(1)*k(e, 1) + a11(4)*k(e, 4) + a11(5)*k(e, 5) + a11(6)*k(e, 6) + a11(7)*k(e, 7) &
                             + a11(8)*k(e, 8) + a11(9)*k(e, 9) + a11(10)*k(e, 10))
         end do
      case (12)
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(a12(1)*k(e, 1) + a12(4)*k(e, 4) + a12(5)*k(e, 5) + a12(6)*k(e, 6) + a12(7)*k(e, 7) &
                             + a12(8)*k(e, 8) + a12(9)*k(e, 9) + a12(10)*k(e, 10) + a12(11)*k(e, 11))
         end do
      case default
         do concurrent(e=1:n)
            y(e) = y0(e) + h*(b(1)*k(e, 1) + b(6)*k(e, 6) + b(7)*k(e, 7) + b(8)*k(e, 8) + b(9)*k(e, 9) + b(10)*k(e, 10) &
                             + b(11)*k(e, 11) + b(12)*k(e, 12))
         end do
      end select
   end subroutine add_stages

   !> Rate at which the last two states at the end of the step make a difference of each other decay or swing; zero where time did
   !> not go evenly.
   pure real(wp) function stages_fastest_rate(self, n, step, scale) result(rate)
      class(dop853_stages_t), intent(in) :: self  !! the stages
      integer, intent(in) :: n                    !! entries without quadratures
      type(step_t), intent(in) :: step            !! the step that they made
      real(wp), intent(in) :: scale(:)            !! (n or more) what the entries are measured by [any]

      rate = 0.0_wp
      if (step%course == course_even) rate = rate_between(n, self%y, self%k(:, 12), step%y1, step%f1, scale)
   end function stages_fastest_rate

   !> Norm of the error estimate by length of the step, over the scales.
   pure real(wp) function stages_norm(self, n, scale, norm_kind) result(norm)
      class(dop853_stages_t), intent(in) :: self   !! the stages
      integer, intent(in) :: n                     !! entries without quadratures
      real(wp), intent(in) :: scale(:)             !! (n or more) what the entries are measured by [any]
      integer, intent(in) :: norm_kind             !! which norm, see `integrator_controls`

      real(wp) :: estimate_3, estimate_5, norm_3
      integer :: i, j

      norm = 0.0_wp
      norm_3 = 0.0_wp
      do i = 1, n
         estimate_5 = e5(1)*self%k(i, 1)
         estimate_3 = e3(1)*self%k(i, 1)
         do j = 6, 12
            estimate_5 = estimate_5 + e5(j)*self%k(i, j)
            estimate_3 = estimate_3 + e3(j)*self%k(i, j)
         end do
         estimate_5 = abs(estimate_5)/scale(i)
         estimate_3 = abs(estimate_3)/scale(i)
         if (norm_kind == norm_euclidean) then
            norm = norm + estimate_5**2
            norm_3 = norm_3 + estimate_3**2
         else
            if (.not. estimate_5 <= norm) norm = estimate_5  ! a NaN comes through
            norm_3 = max(norm_3, estimate_3)
         end if
      end do
      if (norm_kind == norm_euclidean) then
         norm = sqrt(norm)
         norm_3 = sqrt(norm_3)
      end if
      if (norm > 0.0_wp) norm = norm*(norm/hypot(norm, 0.1_wp*norm_3))
   end function stages_norm

   !> Norm of the error estimates of the quadratures, of each by itself.
   real(wp) function stages_quadrature_norm(self, system, part) result(norm)
      class(dop853_stages_t), intent(in) :: self   !! the stages
      class(ode_system_t), intent(in) :: system    !! the system
      real(wp), intent(in) :: part                 !! length of the step over the tolerance [s]

      real(wp) :: estimate(system%n_quadrature), estimate_3, estimate_5
      integer :: i, j, n

      n = system%n - system%n_quadrature
      do i = 1, system%n_quadrature
         estimate_5 = e5(1)*self%k(n + i, 1)
         estimate_3 = e3(1)*self%k(n + i, 1)
         do j = 6, 12
            estimate_5 = estimate_5 + e5(j)*self%k(n + i, j)
            estimate_3 = estimate_3 + e3(j)*self%k(n + i, j)
         end do
         estimate_5 = abs(estimate_5)
         if (estimate_5 > 0.0_wp) estimate_5 = estimate_5*(estimate_5/hypot(estimate_5, 0.1_wp*estimate_3))
         estimate(i) = part*estimate_5
      end do
      norm = max_error(system%n_quadrature, estimate, system%traits%quadrature_scale, by_one_step)
   end function stages_quadrature_norm

   !> Whether these are the stages of a step, and not of a part of it.
   pure logical function stages_are_of(self, step)
      class(dop853_stages_t), intent(in) :: self  !! the stages
      type(step_t), intent(in) :: step            !! the step

      stages_are_of = .not. (self%h < step%h .or. self%h > step%h)
   end function stages_are_of

end module dop853_stages
