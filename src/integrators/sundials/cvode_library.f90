!> Adams and BDF by SUNDIALS' CVODE.
!>
!> Adams: orders 1 to 12, the implicit equations by fixed-point iteration. BDF: orders 1 to 5, by
!> Newton's iteration with a dense Jacobian from difference quotients of the entries that are no
!> quadratures (nothing depends on those). A large system has no Jacobian: GMRES solves Newton's equations
!> by differences along its directions, of which a sparse factorisation (`newton_matrix`) leaves one or two.
!>
!> A system that holds its states: BDF projects within the step (CVODE's CVodeSetProjFn: the change of
!> `hold` goes into the history, after the error test). CVODE has no projection for Adams: there the
!> right-hand side is taken at a held copy of the state.
!>
!> Source: A. C. Hindmarsh et al., SUNDIALS: suite of nonlinear and differential/algebraic equation
!> solvers, ACM Trans. Math. Softw. 31 (2005) 363-396.
module cvode_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_funloc, c_int, c_loc, c_long, c_null_ptr, c_ptr
   use fcvode_mod, only: cv_adams, cv_bdf, cv_one_step, fcvode, fcvodefree, fcvodegetcurrentstep, fcvodegetdky, &
      fcvodegetnumerrtestfails, fcvodegetnumnonlinsolvconvfails, fcvodeinit, fcvodereinit, fcvodesetinitstep, &
      fcvodesetjacfn, fcvodesetlinearsolver, fcvodesetmaxconvfails, fcvodesetmaxerrtestfails, fcvodesetmaxstep, &
      fcvodesetminstep, fcvodesetnonlinconvcoef, fcvodesetnonlinearsolver, fcvodesetpreconditioner, fcvodesetprojerrest, &
      fcvodesetprojfn, fcvodesetstoptime, fcvodesetuserdata, fcvodewftolerances
   use dae_system, only: dae_system_t
   use fsunlinsol_dense_mod, only: fsunlinsol_dense
   use fsunlinsol_spgmr_mod, only: fsunlinsol_spgmr
   use fsunmatrix_dense_mod, only: fsundensematrix
   use fsunnonlinsol_fixedpoint_mod, only: fsunnonlinsol_fixedpoint
   use kinds, only: wp
   use sundials, only: fn_vgetarraypointer, fsunnonlinsolfree, n_vector, new_cvode, sunindextype, sunmatrix, sunnonlinearsolver
   use sundials_library, only: dense_block, increments, library_t, most_failures, new_vector, note, problem_t, weigh
   implicit none (type, external)
   private
   public :: cvode_library_t

   integer(c_int), parameter :: on_the_left = 1_c_int       !! SUNDIALS' number of a preconditioner on the left
   integer(c_int), parameter :: most_directions = 30_c_int  !! of GMRES before it gives up
   real(wp), parameter :: newton_rest = 0.01_wp             !! what Newton's iteration may leave, of the tolerance [1]

   !> CVODE with its objects.
   type, extends(library_t) :: cvode_library_t
      logical :: is_stiff = .false.                             !! BDF, else Adams
      type(sunnonlinearsolver), pointer :: fixed_point => null()  !! Adams: solves the implicit equations
   contains
      procedure :: begin => cvode_begin
      procedure :: step => cvode_step
      procedure :: look_back => cvode_look_back
      procedure :: next_step => cvode_next_step
      procedure :: n_rejected => cvode_rejected
      final :: cvode_free
   end type cvode_library_t

   interface
      !> Attach a linear solver; the library's own module has no way to say that it has no matrix.
      integer(c_int) function cvodesetlinearsolver(memory, linear, matrix) bind(c, name="CVodeSetLinearSolver")
         import :: c_int, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: memory   !! CVODE's memory
         type(c_ptr), value :: linear   !! the solver
         type(c_ptr), value :: matrix   !! its matrix, or none
      end function cvodesetlinearsolver
   end interface

contains

   !> Start at the integrator's present state.
   subroutine cvode_begin(self, first_step, is_good)
      class(cvode_library_t), intent(inout) :: self   !! the library
      real(wp), intent(in) :: first_step              !! first step to try, 0: CVODE chooses [s]
      logical, intent(out) :: is_good                 !! whether there was room and every setting was taken

      real(wp), pointer :: y(:)
      integer :: status

      status = 0
      if (.not. c_associated(self%memory)) call create(self, status)
      is_good = status == 0
      if (.not. is_good) return
      associate (method => self%problem%method)
         y => fn_vgetarraypointer(self%state)
         y(:) = method%step%y1
         call note(fcvodereinit(self%memory, method%t, self%state), status)
         call note(fcvodesetinitstep(self%memory, first_step), status)
         call note(fcvodesetminstep(self%memory, method%controls%minimum_step), status)
         call note(fcvodesetmaxstep(self%memory, method%controls%maximum_step), status)
         call note(fcvodesetmaxerrtestfails(self%memory, most_failures), status)
         call note(fcvodesetmaxconvfails(self%memory, most_failures), status)
      end associate
      self%problem%holds_copies = .not. self%is_stiff
      if (self%problem%system%holds .and. self%is_stiff) then
         call note(fcvodesetprojfn(self%memory, c_funloc(project)), status)
         call note(fcvodesetprojerrest(self%memory, 0_c_int), status)
      end if
      is_good = status == 0
   end subroutine cvode_begin

   !> Make CVODE's objects.
   subroutine create(self, status)
      class(cvode_library_t), intent(inout) :: self   !! the library
      integer, intent(out) :: status                  !! 0: done

      integer(sunindextype) :: n

      n = int(self%problem%system%n, sunindextype)
      self%state => new_vector(self%problem%system%n, self%context)
      self%look => new_vector(self%problem%system%n, self%context)
      self%memory = new_cvode(merge(cv_bdf, cv_adams, self%is_stiff), self%context)
      status = merge(0, -1, associated(self%state) .and. associated(self%look) .and. c_associated(self%memory))
      if (status /= 0) return
      call note(fcvodeinit(self%memory, c_funloc(right_hand_side), self%problem%method%t, self%state), status)
      call note(fcvodesetuserdata(self%memory, c_loc(self%problem)), status)
      call note(fcvodewftolerances(self%memory, c_funloc(weigh)), status)
      if (self%is_stiff .and. self%problem%is_large()) then
         call self%problem%start_newton()
         self%linear => fsunlinsol_spgmr(self%state, on_the_left, most_directions, self%context)
         self%problem%lacks_memory = .not. associated(self%linear)
         if (associated(self%linear)) then
            call note(cvodesetlinearsolver(self%memory, c_loc(self%linear), c_null_ptr), status)
            call note(fcvodesetpreconditioner(self%memory, c_funloc(prepare), c_funloc(precondition)), status)
         end if
      else if (self%is_stiff) then
         self%jacobian => fsundensematrix(n, n, self%context)
         self%problem%lacks_memory = .not. associated(self%jacobian)
         if (associated(self%jacobian)) then
            self%linear => fsunlinsol_dense(self%state, self%jacobian, self%context)
            call note(fcvodesetlinearsolver(self%memory, self%linear, self%jacobian), status)
            call note(fcvodesetjacfn(self%memory, c_funloc(differentiate)), status)
         end if
      else
         self%fixed_point => fsunnonlinsol_fixedpoint(self%state, 0_c_int, self%context)
         call note(fcvodesetnonlinearsolver(self%memory, self%fixed_point), status)
      end if
      ! what is left is in the differences by which BDF judges its steps: with CVODE's own tenth films took twice as many and more
      if (self%is_stiff) call note(fcvodesetnonlinconvcoef(self%memory, newton_rest), status)
      if (self%problem%lacks_memory) status = -1
   end subroutine create

   !> One step, not beyond t_stop.
   subroutine cvode_step(self, t_stop, t, y, status)
      class(cvode_library_t), intent(inout) :: self   !! the library
      real(wp), intent(in) :: t_stop                  !! not to be passed [s]
      real(wp), intent(out) :: t                      !! time reached [s]
      real(wp), intent(out) :: y(:)                   !! (n) state there [any]
      integer, intent(out) :: status                  !! 0, or a failure as `advance` returns it

      real(c_double) :: reached(1)
      real(c_double), pointer :: state(:)
      integer(c_int) :: outcome

      outcome = fcvodesetstoptime(self%memory, t_stop)
      if (outcome == 0) outcome = fcvode(self%memory, t_stop, self%state, reached, cv_one_step)
      t = reached(1)
      state => fn_vgetarraypointer(self%state)
      y = state
      status = 0
      if (outcome < 0) status = self%failure()
   end subroutine cvode_step

   !> State within the last step, by the polynomial of the method.
   subroutine cvode_look_back(self, t, y)
      class(cvode_library_t), intent(in) :: self   !! the library
      real(wp), intent(in) :: t                    !! time [s]
      real(wp), intent(out) :: y(:)                !! (n) state [any]

      real(c_double), pointer :: state(:)
      integer :: status

      status = fcvodegetdky(self%memory, t, 0_c_int, self%look)
      state => fn_vgetarraypointer(self%look)
      y = state
   end subroutine cvode_look_back

   !> Length of the step that will be tried next.
   real(wp) function cvode_next_step(self) result(h)
      class(cvode_library_t), intent(in) :: self   !! the library

      real(c_double) :: step(1)
      integer :: status

      status = fcvodegetcurrentstep(self%memory, step)
      h = step(1)
   end function cvode_next_step

   !> Steps given up since the start: failed error tests and failed iterations.
   integer function cvode_rejected(self) result(n)
      class(cvode_library_t), intent(in) :: self   !! the library

      integer(c_long) :: in_iterations(1), in_tests(1)
      integer :: status

      status = fcvodegetnumerrtestfails(self%memory, in_tests)
      status = fcvodegetnumnonlinsolvconvfails(self%memory, in_iterations)
      n = int(in_tests(1) + in_iterations(1))
   end function cvode_rejected

   !> Free all.
   subroutine cvode_free(self)
      type(cvode_library_t), intent(inout) :: self   !! the library

      integer :: status

      if (c_associated(self%memory)) call fcvodefree(self%memory)
      if (associated(self%fixed_point)) status = fsunnonlinsolfree(self%fixed_point)
      call self%close()
   end subroutine cvode_free

   ! ---- called by CVODE ----------------------------------------------------------------------------

   !> Right-hand side.
   integer(c_int) function right_hand_side(t, y, ydot, user_data) bind(c, name="") result(status)
      real(c_double), value :: t              !! time [s]
      type(n_vector), intent(inout) :: y      !! state
      type(n_vector), intent(inout) :: ydot   !! its derivative
      type(c_ptr), value :: user_data         !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: rate(:), state(:)
      integer :: outcome

      call c_f_pointer(user_data, problem)
      state => fn_vgetarraypointer(y)
      rate => fn_vgetarraypointer(ydot)
      call problem%evaluate(t, state, rate, outcome)
      status = int(outcome, c_int)
   end function right_hand_side

   !> Jacobian of the right-hand side by forward differences.
   integer(c_int) function differentiate(t, y, ydot, matrix, user_data, scratch_1, scratch_2, scratch_3) bind(c, name="") &
      result(status)
      real(c_double), value :: t                     !! time [s]
      type(n_vector), intent(inout) :: y             !! state
      type(n_vector), intent(inout) :: ydot          !! its derivative
      type(sunmatrix), intent(inout) :: matrix       !! (n, n) the Jacobian
      type(c_ptr), value :: user_data                !! the problem
      type(n_vector), intent(inout) :: scratch_1     !! workspace
      type(n_vector), intent(inout) :: scratch_2     !! workspace
      type(n_vector), intent(inout) :: scratch_3     !! workspace

      type(problem_t), pointer :: problem
      real(c_double), pointer, contiguous :: block(:, :)
      real(c_double), pointer :: increment(:), moved(:), rate(:), state(:)
      integer :: j, n, outcome

      call c_f_pointer(user_data, problem)
      n = problem%system%n
      state => fn_vgetarraypointer(y)
      rate => fn_vgetarraypointer(ydot)
      increment => fn_vgetarraypointer(scratch_1)
      moved => fn_vgetarraypointer(scratch_2)
      call dense_block(matrix, n, block)
      call increments(problem%system, state, problem%method%scale, increment)
      moved = state
      block = 0.0_wp
      outcome = 0
      do j = 1, n - problem%system%n_quadrature
         moved(j) = state(j) + increment(j)
         call problem%evaluate(t, moved, block(:, j), outcome)
         if (outcome /= 0) exit
         block(:, j) = (block(:, j) - rate)/increment(j)
         moved(j) = state(j)
      end do
      status = int(outcome, c_int)
   end function differentiate

   !> Preconditioner of a large system at a state.
   integer(c_int) function prepare(t, y, ydot, may_keep, is_new, gamma, user_data) bind(c, name="") result(status)
      real(c_double), value :: t                  !! time [s]
      type(n_vector), intent(inout) :: y          !! state
      type(n_vector), intent(inout) :: ydot       !! its derivative
      integer(c_int), value :: may_keep           !! whether what was found before may be used again; it is not
      integer(c_int), intent(out) :: is_new       !! whether it was found anew
      real(c_double), value :: gamma              !! coefficient of the Jacobian in I - gamma J [s]
      type(c_ptr), value :: user_data             !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: rate(:), state(:)
      real(wp), allocatable :: lambda(:)
      integer :: m, outcome

      call c_f_pointer(user_data, problem)
      state => fn_vgetarraypointer(y)
      rate => fn_vgetarraypointer(ydot)
      is_new = 1_c_int
      m = problem%newton%m
      allocate (lambda(m), source=0.0_wp)
      associate (system => problem%system)
         select type (system)
         class is (dae_system_t)
            call system%multipliers(lambda)
         end select
      end associate
      call problem%fill_newton(t, 1.0_wp/gamma, state, rate, lambda, 0.0_wp*lambda, outcome)
      if (outcome == 0) call problem%newton%factorise(gamma)
      status = int(outcome, c_int)
   end function prepare

   !> Solve nearly (I - gamma J) z = r.
   integer(c_int) function precondition(t, y, ydot, r, z, gamma, delta, side, user_data) bind(c, name="") result(status)
      real(c_double), value :: t                  !! time [s]
      type(n_vector), intent(inout) :: y          !! state
      type(n_vector), intent(inout) :: ydot       !! its derivative
      type(n_vector), intent(inout) :: r          !! right-hand side
      type(n_vector), intent(inout) :: z          !! solution
      real(c_double), value :: gamma              !! coefficient of the Jacobian [s]
      real(c_double), value :: delta              !! error allowed an iterative solution [1]
      integer(c_int), value :: side               !! the left one
      type(c_ptr), value :: user_data             !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: right(:), solution(:)

      call c_f_pointer(user_data, problem)
      right => fn_vgetarraypointer(r)
      solution => fn_vgetarraypointer(z)
      call problem%newton%precondition(gamma, right, solution)
      status = 0_c_int
   end function precondition

   !> The change of a state that holding it makes.
   integer(c_int) function project(t, y, change, allowed, estimate, user_data) bind(c, name="") result(status)
      real(c_double), value :: t                  !! time [s]
      type(n_vector), intent(inout) :: y          !! state
      type(n_vector), intent(inout) :: change     !! what holding adds to it
      real(c_double), value :: allowed            !! error of an iterative projection [1]
      type(c_ptr), value :: estimate              !! error estimate to be projected; none here
      type(c_ptr), value :: user_data             !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: added(:), state(:)
      integer :: outcome

      call c_f_pointer(user_data, problem)
      state => fn_vgetarraypointer(y)
      added => fn_vgetarraypointer(change)
      problem%held(:) = state
      call problem%system%hold(t, problem%held, outcome)
      problem%is_fatal = problem%is_fatal .or. outcome < 0
      added(:) = problem%held - state
      status = int(outcome, c_int)
   end function project

end module cvode_library
