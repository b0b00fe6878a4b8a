!> What the multistep methods need of a library that makes their steps: start, step, look back.
!>
!> The library calls back with an address only: that of a `problem_t`, which points to the system and
!> to the integrator for as long as the step lasts.
!>
!> Norm: the libraries take the root of the mean square of error times weight over all entries. With
!> the weights sqrt(n) / (TOL scale) that is the Euclidean norm of error over scale, which bounds the
!> maximum entry: an accepted step satisfies every norm of the controls. Quadratures, and the
!> multipliers of a constrained system, weigh next to nothing there; the vectors have a norm of their own, which is that of the
!> maximum quadrature where that is more (`quadrature_error`).
module sundials_library
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_int, c_loc, c_null_ptr, c_ptr
   use fnvector_serial_mod, only: fn_vnew_serial, fn_vwrmsnorm_serial
   use fsunmatrix_dense_mod, only: fsundensematrix_data
   use dae_system, only: dae_system_t
   use integrator, only: advance_failed_evaluation, advance_too_many_evaluations, advance_too_small, integrator_t
   use kinds, only: eps, wp
   use newton_matrix, only: newton_matrix_t
   use ode_system, only: ode_system_t
   use quadrature_error, only: allowed_by_multistep, counts_quadratures, max_error
   use sundials, only: fn_vdestroy, fn_vgetarraypointer, fsuncontext_free, fsunlinsolfree, fsunmatdestroy, n_vector, n_vector_ops, &
      new_context, sunindextype, sunlinearsolver, sunmatrix
   implicit none (type, external)
   private
   public :: dense_block, increments, library_t, most_failures, new_vector, note, problem_t, weigh

   integer(c_int), parameter :: most_failures = 30  !! of a step: from a long one to those of a film that lets go, 7 are too few
   real(wp), parameter :: no_weight = 1.0e-30_wp  !! weight of what stays out of the norm; nought would be divided by [any]

   !> What the library hands back.
   type :: problem_t
      class(ode_system_t), pointer :: system => null()   !! the system, during a step
      class(integrator_t), pointer :: method => null()   !! the integrator, during a step
      logical :: holds_copies = .false.                  !! evaluate at a held copy of the state
      logical :: is_used_up = .false.                    !! no evaluation is left
      logical :: is_fatal = .false.                      !! an evaluation failed for good
      logical :: heeds_quadratures = .true.              !! whether errors of quadratures limit steps
      logical :: lacks_memory = .false.                  !! there was no memory for the matrices
      real(wp) :: newton_norm = 0.0_wp                   !! of the first correction of Newton's iteration, over the weights [1]
      real(wp) :: newton_rest = 0.0_wp                   !! what is left after a correction, of that correction [1]
      real(wp) :: reach = 0.0_wp                         !! one over du'/du of the method, as of the last matrix; 0: none yet [s]
      type(newton_matrix_t) :: newton                    !! of a large system: the matrix of Newton's equations
      real(wp), allocatable :: held(:)                   !! (n) the copy [any]
   contains
      procedure :: evaluate => problem_evaluate
      procedure :: attend => problem_attend
      procedure :: count_evaluation
      procedure :: set_weights
      procedure :: is_large => problem_is_large
      procedure :: start_newton
      procedure :: fill_newton
   end type problem_t

   !> A library at work.
   type, abstract :: library_t
      type(problem_t), pointer :: problem => null()   !! what it hands back
      type(c_ptr) :: context = c_null_ptr             !! of all its objects
      type(c_ptr) :: memory = c_null_ptr              !! the library's own
      type(n_vector), pointer :: state => null()      !! numbers of the last step
      type(n_vector), pointer :: look => null()       !! numbers looked back at
      type(sunmatrix), pointer :: jacobian => null()  !! of what Newton's iteration solves, if there is a matrix
      type(sunlinearsolver), pointer :: linear => null()  !! solves Newton's equations
   contains
      procedure(begin_interface), deferred :: begin
      procedure(step_interface), deferred :: step
      procedure(look_back_interface), deferred :: look_back
      procedure(next_step_interface), deferred :: next_step
      procedure(rejected_interface), deferred :: n_rejected
      procedure :: open => library_open
      procedure :: close => library_close
      procedure :: failure => library_failure
   end type library_t

   abstract interface
      !> Start at the integrator's present state, with order 1. The problem points to system and integrator.
      subroutine begin_interface(self, first_step, is_good)
         import :: library_t, wp
         implicit none (type, external)
         class(library_t), intent(inout) :: self   !! the library
         real(wp), intent(in) :: first_step        !! first step to try, 0: the library chooses [s]
         logical, intent(out) :: is_good           !! whether there was room and every setting was taken
      end subroutine begin_interface

      !> One step, not beyond t_stop.
      subroutine step_interface(self, t_stop, t, y, status)
         import :: library_t, wp
         implicit none (type, external)
         class(library_t), intent(inout) :: self   !! the library
         real(wp), intent(in) :: t_stop            !! not to be passed [s]
         real(wp), intent(out) :: t                !! time reached [s]
         real(wp), intent(out) :: y(:)             !! (n) state there [any]
         integer, intent(out) :: status            !! 0, or a failure as `advance` returns it
      end subroutine step_interface

      !> State within the last step, by the polynomial of the method.
      subroutine look_back_interface(self, t, y)
         import :: library_t, wp
         implicit none (type, external)
         class(library_t), intent(in) :: self      !! the library
         real(wp), intent(in) :: t                 !! time [s]
         real(wp), intent(out) :: y(:)             !! (n) state [any]
      end subroutine look_back_interface

      !> Length of the step that will be tried next.
      function next_step_interface(self) result(h)
         import :: library_t, wp
         implicit none (type, external)
         class(library_t), intent(in) :: self      !! the library
         real(wp) :: h                             !! 0: not known yet [s]
      end function next_step_interface

      !> Steps given up since the start: failed error tests and failed iterations.
      function rejected_interface(self) result(n)
         import :: library_t
         implicit none (type, external)
         class(library_t), intent(in) :: self      !! the library
         integer :: n                              !! how many
      end function rejected_interface
   end interface

   type(problem_t), pointer :: at_work => null()   !! the problem of the step in hand: a norm is handed vectors only

contains

   !> A vector with the norm of motion and quadratures, which those that a library makes like it have too.
   function new_vector(n, context) result(vector)
      integer, intent(in) :: n              !! entries
      type(c_ptr), intent(in) :: context    !! of the library's objects
      type(n_vector), pointer :: vector     !! the vector; null if there is no memory

      type(n_vector_ops), pointer :: operations

      vector => fn_vnew_serial(int(n, sunindextype), context)
      if (.not. associated(vector)) return
      call c_f_pointer(vector%ops, operations)
      operations%nvwrmsnorm = c_funloc(max_norm)
   end function new_vector

   !> The library's norm of errors times weights, or that of the quadratures if it is greater.
   real(c_double) function max_norm(error, weight) bind(c, name="") result(norm)
      type(n_vector), intent(inout) :: error    !! errors
      type(n_vector), intent(inout) :: weight   !! their weights, next to nothing of quadratures

      real(c_double), pointer :: errors(:)

      norm = fn_vwrmsnorm_serial(error, weight)
      if (.not. associated(at_work)) return
      if (.not. at_work%heeds_quadratures) return
      associate (system => at_work%system)
         if (.not. counts_quadratures(system, merge(norm, 0.0_wp, system%n_event > 0))) return
         errors => fn_vgetarraypointer(error)
         norm = max(norm, max_error(system%n_quadrature, errors(system%n - system%n_quadrature + 1:system%n), &
                                         system%traits%quadrature_scale, &
                                         allowed_by_multistep(norm)*at_work%method%controls%tolerance))
      end associate
   end function max_norm

   !> The right-hand side, at a held copy of the state if that is asked for.
   subroutine problem_evaluate(self, t, y, ydot, status)
      class(problem_t), intent(inout) :: self        !! the problem
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in), contiguous :: y(:)       !! (n) state [any]
      real(wp), intent(out), contiguous :: ydot(:)   !! (n) its derivative [any]
      integer, intent(out) :: status                 !! 0 done, > 0 retry with a smaller step, < 0 give up

      call self%count_evaluation(status)
      if (status /= 0) return
      if (self%system%holds .and. self%holds_copies) then
         self%held(:) = y
         call self%system%hold(t, self%held, status)
         if (status == 0) call self%system%evaluate(t, self%held, ydot, status)
      else
         call self%system%evaluate(t, y, ydot, status)
      end if
      self%is_fatal = self%is_fatal .or. status < 0
   end subroutine problem_evaluate

   !> A step starts, or ends: the system and the integrator are the problem while it lasts.
   subroutine problem_attend(self, system, method)
      class(problem_t), intent(inout), target :: self            !! the problem
      class(ode_system_t), intent(in), target, optional :: system   !! the system; omitted: it ends
      class(integrator_t), intent(in), target, optional :: method   !! the integrator

      nullify (self%system, self%method, at_work)
      if (.not. present(system) .or. .not. present(method)) return
      self%system => system
      self%method => method
      at_work => self
   end subroutine problem_attend

   !> One more evaluation, if one is left beside that of the end of the step.
   subroutine count_evaluation(self, status)
      class(problem_t), intent(inout) :: self  !! the problem
      integer, intent(out) :: status           !! 0, or -1 if none is left

      associate (most => self%method%controls%maximum_evaluations)
         self%is_used_up = most > 0 .and. self%method%count%n_evaluations + 1 >= most
      end associate
      status = merge(-1, 0, self%is_used_up)
      if (status == 0) self%method%count%n_evaluations = self%method%count%n_evaluations + 1
   end subroutine count_evaluation

   !> Whether the matrix of Newton's equations is kept sparse.
   logical function problem_is_large(self) result(is_large)
      class(problem_t), intent(in) :: self  !! the problem

      is_large = .false.
      associate (system => self%system)
         select type (system)
         class is (dae_system_t)
            is_large = system%is_large
         end select
      end associate
   end function problem_is_large

   !> The structure of the matrix of Newton's equations of a large system.
   subroutine start_newton(self)
      class(problem_t), intent(inout) :: self  !! the problem

      associate (system => self%system)
         select type (system)
         class is (dae_system_t)
            call self%newton%start(system)
         end select
      end associate
   end subroutine start_newton

   !> The matrix of Newton's equations of a large system, dF/du + c dF/du' at u = (y, lambda, mu); its structure is there.
   subroutine fill_newton(self, t, c, y, ydot, lambda, mu, status)
      class(problem_t), intent(inout) :: self        !! the problem
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: c                      !! du'/du of the method [1/s]
      real(wp), intent(in) :: y(:)                   !! (n) state [any]
      real(wp), intent(in) :: ydot(:)                !! (n) its derivative [any]
      real(wp), intent(in) :: lambda(:)              !! (m) multipliers of the velocities [N or N.m]
      real(wp), intent(in) :: mu(:)                  !! (m) multipliers of the positions [N.s or N.m.s]
      integer, intent(out) :: status                 !! 0 done, > 0 retry with a smaller step, < 0 give up

      real(wp) :: increment(size(y))
      integer :: k

      associate (system => self%system)
         select type (system)
         class is (dae_system_t)
            status = 0
            do k = 0, self%newton%n_colour
               if (status == 0) call self%count_evaluation(status)
            end do
            call increments(system, y, self%method%scale, increment)
            if (status == 0) call self%newton%fill(system, t, c, y, ydot, lambda, mu, increment, status)
            self%is_fatal = self%is_fatal .or. status < 0
         class default
            status = -1
         end select
      end associate
   end subroutine fill_newton

   !> Error weights: sqrt(N) over tolerance and scale for N entries in all, next to nothing for
   !> quadratures and for what follows the state.
   subroutine set_weights(self, y, weight)
      class(problem_t), intent(inout) :: self  !! the problem
      real(wp), intent(in) :: y(:)             !! (n) state [any]
      real(wp), intent(out) :: weight(:)       !! (N) weights, N at least n [any]

      integer :: n

      n = self%system%n - self%system%n_quadrature
      call self%method%set_scales(self%system, y)
      weight(1:n) = sqrt(real(size(weight), wp))/(self%method%controls%tolerance*self%method%scale(1:n))
      weight(n + 1:) = no_weight
   end subroutine set_weights

   !> Increments of the state for difference quotients.
   subroutine increments(system, y, scale, increment)
      class(ode_system_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: y(system%n)         !! (n) state [any]
      real(wp), intent(inout) :: scale(system%n)  !! (n) scratch [any]
      real(wp), intent(out) :: increment(:)       !! (n) positive; of quadratures not used [any]

      integer :: n

      n = system%n - system%n_quadrature
      call system%weights(y, scale)
      increment(1:n) = sqrt(eps)*max(abs(y(1:n)), scale(1:n))
      ! what is added must be a number that the state can take up exactly
      increment(1:n) = (y(1:n) + increment(1:n)) - y(1:n)
   end subroutine increments

   !> Keep the first failure.
   pure subroutine note(outcome, status)
      integer(c_int), intent(in) :: outcome   !! what a routine of the library returned
      integer, intent(inout) :: status        !! 0: none so far

      if (status == 0) status = int(outcome)
   end subroutine note

   !> The entries of a dense matrix.
   subroutine dense_block(matrix, n, block)
      type(sunmatrix), intent(inout) :: matrix                      !! (n, n) matrix
      integer, intent(in) :: n                                      !! rows and columns
      real(c_double), pointer, contiguous, intent(out) :: block(:, :)  !! (n, n) its entries [any]

      real(c_double), pointer :: entries(:)

      entries => fsundensematrix_data(matrix)
      call c_f_pointer(c_loc(entries(1)), block, [n, n])
   end subroutine dense_block

   !> Storage for the problem, and the context.
   subroutine library_open(self, n)
      class(library_t), intent(inout) :: self  !! the library
      integer, intent(in) :: n                 !! entries of the state

      integer :: status

      allocate (self%problem)
      allocate (self%problem%held(n), source=0.0_wp)
      status = new_context(self%context)
   end subroutine library_open

   !> Free all that every library has; its own memory and objects must be gone.
   subroutine library_close(self)
      class(library_t), intent(inout) :: self  !! the library

      integer :: status

      if (associated(self%linear)) status = fsunlinsolfree(self%linear)
      if (associated(self%jacobian)) call fsunmatdestroy(self%jacobian)
      if (associated(self%look)) call fn_vdestroy(self%look)
      if (associated(self%state)) call fn_vdestroy(self%state)
      if (.not. associated(self%problem)) return
      deallocate (self%problem)
      status = fsuncontext_free(self%context)
   end subroutine library_close

   !> What a failed step is called.
   integer function library_failure(self) result(status)
      class(library_t), intent(in) :: self   !! the library

      status = merge(advance_failed_evaluation, advance_too_small, self%problem%is_fatal)
      if (self%problem%is_used_up) status = advance_too_many_evaluations
   end function library_failure

   !> Error weights, as the libraries ask for them.
   integer(c_int) function weigh(u, weight, user_data) bind(c, name="") result(status)
      type(n_vector), intent(inout) :: u        !! state, and what follows it
      type(n_vector), intent(inout) :: weight   !! their weights
      type(c_ptr), value :: user_data           !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: numbers(:), weights(:)

      call c_f_pointer(user_data, problem)
      numbers => fn_vgetarraypointer(u)
      weights => fn_vgetarraypointer(weight)
      call problem%set_weights(numbers(:problem%system%n), weights)
      status = 0
   end function weigh

end module sundials_library
