!> The stabilised form of index 2 by SUNDIALS' IDA: backward differentiation of orders 1 to 5.
!>
!> A constrained system (`dae_system_t`) is solved for its state and both sets of multipliers,
!> u = (y, lambda, mu); any other system as 0 = y' - f(t, y). Newton's iteration with a dense Jacobian
!> from difference quotients; the multipliers enter linearly, so their columns are exact. A large system has
!> a sparse Jacobian (`newton_matrix`), factorised by KLU.
!>
!> Norms: only the state without quadratures counts, in the error test and in Newton's iteration: what
!> an error of the multipliers does to the state over a step is seen there, and multipliers of index 2
!> are the less certain the shorter the step (their error is that of the velocities over the step).
!>
!> Start: positions and velocities are consistent; their derivatives and lambda are those of
!> `evaluate`, mu = 0. No further search for a consistent start is needed.
!>
!> A system that holds its states: IDA has no projection. A constrained system holds by its equations;
!> of any other the right-hand side is taken at a held copy of the state.
!>
!> Source: K. E. Brenan, S. L. Campbell and L. R. Petzold, Numerical solution of initial-value problems
!> in differential-algebraic equations, SIAM (1996); A. C. Hindmarsh et al., SUNDIALS, ACM Trans. Math.
!> Softw. 31 (2005) 363-396.
module ida_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_funloc, c_int, c_loc, c_long, c_null_ptr
   use dae_system, only: dae_system_t
   use fida_mod, only: fidafree, fidagetcurrentstep, fidagetdky, fidagetnumerrtestfails, fidagetnumnonlinsolvconvfails, &
      fidainit, fidareinit, fidasetinitstep, fidasetjacfn, fidasetlinearsolver, fidasetmaxconvfails, &
      fidasetmaxerrtestfails, fidasetmaxstep, fidasetminstep, fidasetnonlinearsolver, fidasetstoptime, &
      fidasetuserdata, fidasolve, fidawftolerances, ida_one_step
   use fsunlinsol_dense_mod, only: fsunlinsol_dense
   use fsunlinsol_klu_mod, only: fsunlinsol_klu
   use fsunnonlinsol_newton_mod, only: fsunnonlinsol_newton
   use fsunmatrix_dense_mod, only: fsundensematrix
   use fsunmatrix_sparse_mod, only: fsunsparsematrix
   use ida_callbacks, only: differentiate, residual, test_convergence
   use kinds, only: wp
   use sundials, only: fn_vdestroy, fn_vgetarraypointer, fsunnonlinsolfree, fsunnonlinsolsetconvtestfn, &
      n_vector, new_ida, sunindextype, sunmatrix, sunnonlinearsolver
   use sundials_library, only: library_t, most_failures, new_vector, note, problem_t, weigh
   implicit none (type, external)
   private
   public :: ida_library_t

   integer(c_int), parameter :: by_columns = 0_c_int  !! SUNDIALS' number of a sparse matrix compressed by columns

   !> IDA with its objects.
   type, extends(library_t) :: ida_library_t
      type(n_vector), pointer :: rate => null()        !! its derivative
      type(sunnonlinearsolver), pointer :: newton => null()  !! Newton's iteration, with a test of its own; of a system with rows
   contains
      procedure :: begin => ida_begin
      procedure :: step => ida_step
      procedure :: look_back => ida_look_back
      procedure :: next_step => ida_next_step
      procedure :: n_rejected => ida_rejected
      final :: ida_free
   end type ida_library_t

contains

   !> Constraint rows of a system.
   integer function rows_of(system) result(m)
      class(*), intent(in) :: system  !! the system

      m = 0
      select type (system)
      class is (dae_system_t)
         m = system%n_row
      end select
   end function rows_of

   !> Start at the integrator's present state, which the system was evaluated at last.
   subroutine ida_begin(self, first_step, is_good)
      class(ida_library_t), intent(inout) :: self   !! the library
      real(wp), intent(in) :: first_step            !! first step to try, 0: IDA chooses [s]
      logical, intent(out) :: is_good               !! whether there was room and every setting was taken

      integer :: status

      status = 0
      self%problem%holds_copies = .true.
      self%problem%reach = 0.0_wp
      if (.not. c_associated(self%memory)) then
         call create(self, status)
      else
         call set_start(self)
         call note(fidareinit(self%memory, self%problem%method%t, self%state, self%rate), status)
      end if
      is_good = status == 0
      if (.not. is_good) return
      associate (controls => self%problem%method%controls)
         call note(fidasetinitstep(self%memory, first_step), status)
         call note(fidasetminstep(self%memory, controls%minimum_step), status)
         call note(fidasetmaxstep(self%memory, controls%maximum_step), status)
         call note(fidasetmaxerrtestfails(self%memory, most_failures), status)
         call note(fidasetmaxconvfails(self%memory, most_failures), status)
      end associate
      is_good = status == 0
   end subroutine ida_begin

   !> State, multipliers and derivatives to start with.
   subroutine set_start(self)
      class(ida_library_t), intent(inout) :: self   !! the library

      real(c_double), pointer :: rate(:), u(:)

      u => fn_vgetarraypointer(self%state)
      rate => fn_vgetarraypointer(self%rate)
      call take_start(self%problem, self%problem%method%step%y1, self%problem%method%step%f1, u, rate)
   end subroutine set_start

   !> A state that the system was evaluated at last, with its multipliers and derivatives.
   subroutine take_start(problem, y, f, u, rate)
      type(problem_t), intent(inout) :: problem         !! the problem
      real(wp), intent(in) :: y(:)                      !! (n) state [any]
      real(wp), intent(in) :: f(:)                      !! (n) its derivative [any]
      real(wp), intent(out) :: u(:)                     !! (N) state and multipliers [any]
      real(wp), intent(out) :: rate(:)                  !! (N) derivative [any]

      integer :: m, n

      n = size(y)
      u = 0.0_wp
      rate = 0.0_wp
      u(:n) = y
      rate(:n) = f
      associate (system => problem%system)
         select type (system)
         class is (dae_system_t)
            m = system%n_row
            call system%begin_form()
            call system%multipliers(u(n + 1:n + m))
         end select
      end associate
   end subroutine take_start

   !> Make IDA's objects.
   subroutine create(self, status)
      class(ida_library_t), intent(inout) :: self   !! the library
      integer, intent(out) :: status                !! 0: done

      integer(sunindextype) :: n

      n = int(self%problem%system%n + 2*rows_of(self%problem%system), sunindextype)
      self%state => new_vector(int(n), self%context)
      self%rate => new_vector(int(n), self%context)
      self%look => new_vector(int(n), self%context)
      self%memory = new_ida(self%context)
      status = merge(0, -1, associated(self%state) .and. associated(self%rate) .and. associated(self%look) &
                     .and. c_associated(self%memory))
      if (status /= 0) return
      call set_start(self)
      call note(fidainit(self%memory, c_funloc(residual), self%problem%method%t, self%state, self%rate), status)
      call note(fidasetuserdata(self%memory, c_loc(self%problem)), status)
      call note(fidawftolerances(self%memory, c_funloc(weigh)), status)
      if (self%problem%is_large()) then
         call self%problem%start_newton()
         self%jacobian => fsunsparsematrix(n, n, int(size(self%problem%newton%row), sunindextype), by_columns, self%context)
         if (associated(self%jacobian)) self%linear => fsunlinsol_klu(self%state, self%jacobian, self%context)
      else
         self%jacobian => fsundensematrix(n, n, self%context)
         if (associated(self%jacobian)) self%linear => fsunlinsol_dense(self%state, self%jacobian, self%context)
      end if
      self%problem%lacks_memory = .not. associated(self%linear)
      status = merge(-1, status, self%problem%lacks_memory)
      if (status /= 0) return
      call note(fidasetlinearsolver(self%memory, self%linear, self%jacobian), status)
      call note(fidasetjacfn(self%memory, c_funloc(differentiate)), status)
      if (status /= 0 .or. rows_of(self%problem%system) == 0) return
      self%newton => fsunnonlinsol_newton(self%state, self%context)
      self%problem%lacks_memory = .not. associated(self%newton)
      if (self%problem%lacks_memory) status = -1
      if (status /= 0) return
      call note(fidasetnonlinearsolver(self%memory, self%newton), status)
      call note(fsunnonlinsolsetconvtestfn(self%newton, c_funloc(test_convergence), c_loc(self%problem)), status)
   end subroutine create

   !> One step, not beyond t_stop.
   subroutine ida_step(self, t_stop, t, y, status)
      class(ida_library_t), intent(inout) :: self   !! the library
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      real(wp), intent(out) :: t                    !! time reached [s]
      real(wp), intent(out) :: y(:)                 !! (n) state there [any]
      integer, intent(out) :: status                !! 0, or a failure as `advance` returns it

      real(c_double) :: reached(1)
      real(c_double), pointer :: u(:)
      integer(c_int) :: outcome

      outcome = fidasetstoptime(self%memory, t_stop)
      if (outcome == 0) outcome = fidasolve(self%memory, t_stop, reached, self%state, self%rate, ida_one_step)
      if (outcome < 0 .and. leaves_out(self%problem%system)) then
         call begin_anew(self, outcome)
         if (outcome == 0) outcome = fidasetstoptime(self%memory, t_stop)
         if (outcome == 0) outcome = fidasolve(self%memory, t_stop, reached, self%state, self%rate, ida_one_step)
      end if
      t = reached(1)
      u => fn_vgetarraypointer(self%state)
      y = u(:size(y))
      status = 0
      if (outcome < 0) status = self%failure()
   end subroutine ida_step

   !> Whether a system omits rows that depend on others.
   logical function leaves_out(system)
      class(*), intent(in) :: system  !! the system

      leaves_out = .false.
      select type (system)
      class is (dae_system_t)
         leaves_out = system%leaves_out()
      end select
   end function leaves_out

   !> A step has failed for the rows that are kept have come to depend on one another: start anew where it started, with other ones.
   subroutine begin_anew(self, outcome)
      class(ida_library_t), intent(inout) :: self   !! the library
      integer(c_int), intent(out) :: outcome        !! 0: done

      real(c_double), pointer :: rate(:), u(:)
      real(wp) :: f(self%problem%system%n)
      integer :: status

      outcome = -1
      associate (method => self%problem%method)
         call self%problem%evaluate(method%t, method%step%y1, f, status)
         if (status /= 0) return
         u => fn_vgetarraypointer(self%state)
         rate => fn_vgetarraypointer(self%rate)
         call take_start(self%problem, method%step%y1, f, u, rate)
         outcome = fidareinit(self%memory, method%t, self%state, self%rate)
      end associate
      if (outcome == 0) outcome = fidasetinitstep(self%memory, 0.0_wp)
   end subroutine begin_anew

   !> State within the last step, by the polynomial of the method.
   subroutine ida_look_back(self, t, y)
      class(ida_library_t), intent(in) :: self   !! the library
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(out) :: y(:)              !! (n) state [any]

      real(c_double), pointer :: u(:)
      integer :: status

      status = fidagetdky(self%memory, t, 0_c_int, self%look)
      u => fn_vgetarraypointer(self%look)
      y = u(:size(y))
   end subroutine ida_look_back

   !> Length of the step that will be tried next.
   real(wp) function ida_next_step(self) result(h)
      class(ida_library_t), intent(in) :: self   !! the library

      real(c_double) :: step(1)
      integer :: status

      status = fidagetcurrentstep(self%memory, step)
      h = step(1)
   end function ida_next_step

   !> Steps given up since the start: failed error tests and failed iterations.
   integer function ida_rejected(self) result(n)
      class(ida_library_t), intent(in) :: self   !! the library

      integer(c_long) :: in_iterations(1), in_tests(1)
      integer :: status

      status = fidagetnumerrtestfails(self%memory, in_tests)
      status = fidagetnumnonlinsolvconvfails(self%memory, in_iterations)
      n = int(in_tests(1) + in_iterations(1))
   end function ida_rejected

   !> Free all.
   subroutine ida_free(self)
      type(ida_library_t), intent(inout) :: self   !! the library

      integer :: status

      if (c_associated(self%memory)) call fidafree(self%memory)
      if (associated(self%newton)) status = fsunnonlinsolfree(self%newton)
      if (associated(self%rate)) call fn_vdestroy(self%rate)
      call self%close()
   end subroutine ida_free

end module ida_library
