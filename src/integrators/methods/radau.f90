!> Radau IIA of order 5: an implicit one-step method for stiff equations, with events by re-stepping.
!>
!> The state at the end of a step is the last of three stages, the polynomial of degree 3 through the start and the stages
!> satisfies the equations at each of them:
!>
!> $$ Y_i = y_0 + h \sum_j a_{ij} f(t_0 + c_j h, Y_j), c = ((4 - \sqrt 6)/10, (4 + \sqrt 6)/10, 1) $$
!>
!> What decays fast is damped away (L-stable), stiff springs without a damper too, and unlike `bdf` nothing is forgotten at an
!> event: the next step is of order 5 as well. Quadratures follow from the stages.
!>
!> The stages are found by Newton's iteration. Where there are few freedoms, its matrix is that in their directions, which follow
!> the bodies, made when the iteration becomes slow (`radau_matrix`), and the iteration is accelerated by what its steps teach
!> (`anderson`). Else, where steps may be much longer than this iteration can make them, as with films, and where it fails again
!> though the step was halved for it, its linear equations are solved by GMRES with differences of the right-hand side along its
!> directions (`radau_products`): the work grows with the number of stiff springs, dampers and films, not with that of
!> coordinates.
!>
!> Error: an embedded formula of order 3, filtered by (I - h J/u)^-1, so that stiff components do not spoil it. Since the method
!> has two orders more, its estimate may be TOL' = TOL^(2/3)/10, which makes the error nearly proportional to TOL; Newton's
!> iteration ends a good deal below.
!>
!> Between the ends of a step: positions and rates by the quintic of `interpolation`, without evaluations within the step, which
!> stiff forces would make worse, and in a step with a force so stiff that accelerations carry no information (`is_stiff`), by the
!> stages alone; other states and quadratures by the integral of the cubic through the derivatives at the start and at the stages,
!> of order 5. A row within such a step, or where films act, is the end of a shorter step from the same start. States computed so
!> are nodes of a polynomial, which gives the other rows of the step where its residual is small (`radau_reach`).
!>
!> Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.8. Limits: where there
!> are more freedoms than `radau_matrix` takes, and more than some ten forces are stiff, each in its own way, GMRES needs as many
!> directions, and `bdf` is cheaper.
module radau
   use archive, only: archive_t
   use anderson, only: anderson_t
   use integrator, only: advance_failed_evaluation, advance_no_memory, advance_step
   use interpolation, only: step_t
   use integration_method, only: abilities_t
   use kind_info, only: kind_info_t
   use kinds, only: eps, wp
   use krylov_solver, only: krylov_solver_t
   use ode_system, only: ode_system_t
   use one_step, only: one_step_advance, one_step_load, one_step_restart, one_step_save, one_step_t
   use radau_matrix, only: radau_matrix_t
   use radau_products, only: a, c, filter_product_t, stage_product_t
   use radau_stages, only: extrapolate, stages_t
   use step_nodes, only: step_nodes_t
   implicit none (type, external)
   private
   public :: radau_t

   integer, parameter :: most_evaluations = 2400        !! of a step: sixteen iterations with forty directions each
   real(wp), parameter :: wide = 2.0_wp                 !! times longer than with the matrix a step must be, to be worth GMRES [1]
   real(wp), parameter :: forgets = 1.1_wp              !! growth of what the matrix is thought to do, in a step by GMRES [1]
   real(wp), parameter :: diverged = (0.9_wp/0.5_wp)**4 !! norm of a step without stages, which halves it [1]

   !> The method.
   type, extends(one_step_t) :: radau_t
      private
      integer :: n = 0                          !! entries of the state without quadratures
      type(stage_product_t) :: stage            !! the stages in hand
      type(filter_product_t) :: filter          !! of the error
      type(radau_matrix_t) :: matrix            !! Newton's matrix, where there are few freedoms
      logical :: is_stale = .true.              !! whether it is to be made anew before the next step
      logical :: has_failed = .false.           !! whether the iteration with a new one has in the step in hand
      logical :: is_wide = .false.              !! whether the step in hand is longer than it can do
      logical :: is_row = .false.               !! whether a part of a step gives a row; else it locates an event
      real(wp) :: h_matrix = huge(1.0_wp)       !! longest step with it [s]
      real(wp) :: h_gmres = huge(1.0_wp)        !! longest step by GMRES [s]
      type(anderson_t) :: secants               !! acceleration of the iteration with it
      type(krylov_solver_t) :: stage_solver     !! GMRES for Newton's equations
      type(krylov_solver_t) :: filter_solver    !! GMRES for the filter
      type(stages_t) :: before                  !! stages of the step before the one in hand
      type(stages_t) :: now                     !! of the step in hand, as a whole
      type(step_nodes_t) :: nodes               !! states computed within the last step
      real(wp), allocatable :: z(:, :)          !! (n, 3) changes at the stages in hand [any]
      real(wp), allocatable :: first_z(:, :)    !! (n, 3) where an iteration starts [any]
      real(wp), allocatable :: side(:)          !! (3 n) right side of Newton's equations [any]
      real(wp), allocatable :: change(:)        !! (3 n) their solution [any]
      real(wp), allocatable :: weight(:)        !! (3 n) error scales [any]
      real(wp), allocatable :: y(:)             !! (all) workspace [any]
      real(wp) :: norm = 0.0_wp                 !! of the estimate over TOL' [1]
      logical :: is_stiff = .false.             !! whether accelerations carry no information in the step in hand
      real(wp) :: contraction = 1.0_wp          !! theta/(1 - theta) of the last iteration [1]
   contains
      procedure, nopass :: info => radau_info
      procedure, nopass :: abilities => radau_abilities
      procedure :: prepare => radau_prepare
      procedure :: restart => radau_restart
      procedure :: advance => radau_advance
      procedure :: make_stages => radau_make_stages
      procedure :: error_norm => radau_error_norm
      procedure :: prepare_output => radau_prepare_output
      procedure :: within => radau_within
      procedure :: reach => radau_reach
      procedure, nopass :: memory_version => radau_memory_version
      procedure :: save => radau_save
      procedure :: load => radau_load
      ! for a method that has this one as a part, and the step in hand itself
      procedure :: open => radau_open
      procedure :: within_step => radau_within_step
      procedure :: save_own => radau_save_own
      procedure :: load_own => radau_load_own
   end type radau_t

   interface
      !> Newton's iteration for the stages. It ends where the error that is left, by its contraction, is below its part of TOL',
      !> in a part of a step at round-off; where it gets no better it has converged if it is at a hundredth of TOL'.
      module subroutine find_stages(self, system, h, is_part, is_found, status)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self                 !! the integrator; `z` is where it starts, then what it finds
         class(ode_system_t), intent(inout), target :: system  !! the system
         real(wp), intent(in) :: h                             !! length of the step [s]
         logical, intent(in) :: is_part                        !! of an accepted step
         logical, intent(out) :: is_found                      !! whether the iteration has converged
         integer, intent(out) :: status                        !! of the evaluations
      end subroutine find_stages

      !> Norm of the estimate (I - h J/u)^-1 h/u (f_0 + sum e_i Z_i/h), into `norm`. A stiff component that the start of all, or
      !> the state after an event, may have makes it too great; then the derivative is taken at the start corrected by it.
      module subroutine estimate_error(self, system, h, status)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self                 !! the integrator, stages found
         class(ode_system_t), intent(inout), target :: system  !! the system
         real(wp), intent(in) :: h                             !! length of the step [s]
         integer, intent(out) :: status                        !! of the evaluations
      end subroutine estimate_error

      !> Norm of the error estimate of the trial step, over TOL', or that of the quadratures where it is greater: by the embedded
      !> formula, which as sums of derivatives need no filter.
      real(wp) module function radau_error_norm(self, system, h) result(norm)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self      !! the integrator, stages found
         class(ode_system_t), intent(in) :: system  !! the system
         real(wp), intent(in) :: h                  !! length of the step [s]
      end function radau_error_norm

      !> Error of a state within the last step by the residual r = f - y' there: norm of (I - h J/u)^-1 h/u r, over the error that
      !> a row may have.
      module subroutine filter_residual(self, system, error, status)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self                 !! the integrator; `side` is r
         class(ode_system_t), intent(inout), target :: system  !! the system
         real(wp), intent(out) :: error                        !! the norm [1]
         integer, intent(out) :: status                        !! of the evaluations
      end subroutine filter_residual

      !> The right-hand side at the stages.
      module subroutine evaluate_stages(self, system, h, status)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self         !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: h                     !! length of the step [s]
         integer, intent(out) :: status                !! of the evaluations
      end subroutine evaluate_stages
   end interface

   interface
      !> No evaluations: the derivatives at the stages are known. Those of another length, as a search in the step leaves them, are
      !> made again.
      module subroutine radau_prepare_output(self, system, status)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self         !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         integer, intent(out) :: status                !! of the evaluations
      end subroutine radau_prepare_output

      !> State at a time within the last step as rows report it: where forces are stiff by a step of that length.
      module subroutine radau_reach(self, system, t, y)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self         !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: t                     !! time [s]
         real(wp), intent(inout) :: y(system%n)        !! (n) state [any]
      end subroutine radau_reach

      !> State at a place of the last step, by interpolation.
      module subroutine radau_within(self, system, s, y)
         implicit none (type, external)
         class(radau_t), intent(in) :: self         !! the integrator
         class(ode_system_t), intent(in) :: system  !! the system
         real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
         real(wp), intent(inout) :: y(system%n)     !! (n) state [any]
      end subroutine radau_within

      !> The same of a step that this method has made and another keeps.
      module subroutine radau_within_step(self, step, system, s, y)
         implicit none (type, external)
         class(radau_t), intent(in) :: self         !! the integrator
         type(step_t), intent(in) :: step           !! the step
         class(ode_system_t), intent(in) :: system  !! the system
         real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
         real(wp), intent(inout) :: y(system%n)     !! (n) state [any]
      end subroutine radau_within_step
   end interface

   interface
      !> Version of the form of what is saved.
      pure integer module function radau_memory_version() result(version)
         implicit none (type, external)
      end function radau_memory_version

      !> Write what the integrator remembers.
      module subroutine radau_save(self, archive)
         implicit none (type, external)
         class(radau_t), intent(in) :: self         !! the integrator
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine radau_save

      !> Read what the integrator remembers.
      module subroutine radau_load(self, archive)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self      !! the integrator
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine radau_load

      !> Write the stages, the matrix and their lengths of steps.
      module subroutine radau_save_own(self, archive)
         implicit none (type, external)
         class(radau_t), intent(in) :: self         !! the integrator, opened
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine radau_save_own

      !> Read them.
      module subroutine radau_load_own(self, archive)
         implicit none (type, external)
         class(radau_t), intent(inout) :: self      !! the integrator, opened
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine radau_load_own
   end interface

contains

   !> Description of the method.
   function radau_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "radau"
      info%help = "Radau IIA of order 5, implicit: for stiff springs, dampers and films, also with frequent events"
      info%source = "Hairer and Wanner (1996)"
   end function radau_info

   !> A method for stiff equations.
   pure type(abilities_t) function radau_abilities() result(can)
      can = abilities_t(is_explicit=.false., is_stiff=.true.)
   end function radau_abilities

   !> Storage for the stages.
   subroutine radau_prepare(self, n)
      class(radau_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n               !! entries of the state

      self%order = 4
      self%n_new_stage = most_evaluations
      if (.not. allocated(self%y)) allocate (self%y(n), source=0.0_wp)
   end subroutine radau_prepare

   !> Evaluate anew at the present state: stages of before no longer predict those ahead.
   subroutine radau_restart(self, system, step_hint, status)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: as before [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      self%now%h = 0.0_wp
      self%contraction = 1.0_wp
      self%is_stale = .true.
      call one_step_restart(self, system, step_hint, status)
      if (status == advance_step) call self%open(system, status)
   end subroutine radau_restart

   !> Storage for the stages, the matrix and what solves without one, made once.
   subroutine radau_open(self, system, status)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(in) :: system     !! the system
      integer, intent(out) :: status                !! advance_step, or a failure

      status = advance_step
      if (self%n > 0) return
      self%n = system%n - system%n_quadrature
      associate (n => self%n)
         allocate (self%z(n, 3), self%first_z(n, 3), self%side(3*n), self%change(3*n), self%weight(3*n), &
                   self%before%z(n, 3), self%now%z(n, 3), source=0.0_wp)
         call self%matrix%open(system)
         call self%secants%open(3*n)
         call self%nodes%open(system%n)
         call self%stage%open(n, system%n)
         call self%filter%open(n, system%n)
         call self%stage_solver%open(3*n, status)
         if (status == 0) call self%filter_solver%open(n, status)
      end associate
      status = merge(advance_step, advance_no_memory, status == 0)
   end subroutine radau_open

   !> One step, by GMRES where it may be much longer than with the matrix. After a restart it starts with the derivative at the
   !> state itself, not that behind a force that jumps there: the matrix is made of differences from it, and the estimate must see
   !> the jump, for a matrix of differences across one lets Newton's iteration seem to converge.
   subroutine radau_advance(self, system, t_stop, status)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      if (self%now%h <= 0.0_wp) then
         call system%evaluate(self%t, self%step%y1, self%step%f1, status)
         self%count%n_evaluations = self%count%n_evaluations + 1
         if (status /= 0) then
            status = advance_failed_evaluation
            return
         end if
      end if
      self%is_wide = self%pace%h_next/wide > self%h_matrix
      if (self%is_wide) self%h_matrix = forgets*self%h_matrix
      self%pace%h_most = merge(self%h_gmres, self%h_matrix, self%is_wide .or. .not. self%matrix%is_known)
      call one_step_advance(self, system, t_stop, status)
   end subroutine radau_advance

   !> Stages of a step of length h from the start of the present step; the end state into `trial`. Parts of an accepted step are
   !> asked for in search of an event: there the iteration continues to round-off, so that the state is a smooth function of the
   !> length; and for rows, where it need not. Where it does not converge, as beside a force that jumps, the polynomial of the
   !> whole step stands in, which is of order 3.
   subroutine radau_make_stages(self, system, h, status)
      class(radau_t), intent(inout) :: self         !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      logical :: is_found, is_part

      is_part = self%t > self%step%t0
      if (.not. is_part .and. self%now%t < self%step%t0) call go_on(self)
      if (is_part) then
         call extrapolate(self%now, self%step%t0, h, self%step%f0, self%z)
      else
         call extrapolate(self%before, self%step%t0, h, self%step%f0, self%z)
      end if
      call find_stages(self, system, h, is_part, is_found, status)
      if (status /= 0) return
      if (.not. is_found .and. is_part .and. self%now%h > 0.0_wp) then
         ! the polynomial of the whole step knows the state, if not to its order
         call extrapolate(self%now, self%step%t0, h, self%step%f0, self%z)
         call evaluate_stages(self, system, h, status)
         if (status /= 0) return
      else if (.not. is_found) then
         ! half the step, where steps may be shortened
         if (is_part .or. self%controls%fixed_step > 0.0_wp) status = 1
         self%norm = diverged
         return
      end if
      call take_end(self%n, size(self%y), self%step%y0, h, self%z, self%stage%f, self%trial)
      if (is_part) return
      self%now%h = h
      self%now%z(:, :) = self%z
      call estimate_error(self, system, h, status)
   end subroutine radau_make_stages

   !> State at the end: the last stage, and the quadratures.
   pure subroutine take_end(n, n_all, y0, h, z, f, y)
      integer, intent(in) :: n           !! entries without quadratures
      integer, intent(in) :: n_all       !! entries
      real(wp), intent(in) :: y0(n_all)  !! (all) state at the start [any]
      real(wp), intent(in) :: h          !! length of the step [s]
      real(wp), intent(in) :: z(n, 3)    !! (n, 3) changes at the stages [any]
      real(wp), intent(in) :: f(n_all, 3)  !! (all, 3) derivatives there [any]
      real(wp), intent(out) :: y(n_all)  !! (all) state at the end [any]

      integer :: i

      do i = 1, n
         y(i) = y0(i) + z(i, 3)
      end do
      do i = n + 1, n_all
         y(i) = y0(i) + h*(a(3, 1)*f(i, 1) + a(3, 2)*f(i, 2) + a(3, 3)*f(i, 3))
      end do
   end subroutine take_end

   !> A new step starts: the stages in hand become those before it.
   subroutine go_on(self)
      class(radau_t), intent(inout) :: self  !! the integrator

      self%before%t = self%now%t
      self%before%h = self%now%h
      self%before%z(:, :) = self%now%z
      self%now%t = self%step%t0
      self%now%h = 0.0_wp
      self%has_failed = .false.
   end subroutine go_on

end module radau
