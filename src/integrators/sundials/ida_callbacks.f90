!> What IDA calls: the residual of the stabilised form of index 2, its Jacobian, and the test of Newton's iteration.
!>
!> Source: A. C. Hindmarsh et al., SUNDIALS, ACM Trans. Math. Softw. 31 (2005) 363-396, for the contracts. Limits: `ida_library`.
module ida_callbacks
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_loc, c_ptr
   use dae_system, only: dae_system_t
   use fsunmatrix_sparse_mod, only: fsunsparsematrix_data, fsunsparsematrix_indexpointers, fsunsparsematrix_indexvalues
   use kinds, only: wp
   use sundials, only: fn_vgetarraypointer, fsunnonlinsolgetcuriter, n_vector, sunindextype, sunmatrix, sunnonlinearsolver
   use sundials_library, only: dense_block, increments, problem_t
   implicit none (type, external)
   private
   public :: differentiate, residual, test_convergence

   integer(c_int), parameter :: newton_goes_on = 901_c_int  !! SUNDIALS' number of an iteration that has not converged
   integer(c_int), parameter :: newton_fails = 902_c_int    !! and of one that does not
   real(wp), parameter :: most_left = 20.0_wp               !! after a correction by a new matrix, of the correction [1]

contains

   !> What is left of the equations at u and u'.
   subroutine find_residual(problem, t, u, rate, left, status)
      type(problem_t), intent(inout) :: problem         !! the problem
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in), contiguous :: u(:)          !! (N) state and multipliers [any]
      real(wp), intent(in), contiguous :: rate(:)       !! (N) derivative [any]
      real(wp), intent(out), contiguous :: left(:)      !! (N) residual [any]
      integer, intent(out) :: status                    !! 0 done, > 0 retry with a smaller step, < 0 give up

      integer :: m, n

      n = problem%system%n
      m = (size(u) - n)/2
      associate (system => problem%system)
         select type (system)
         class is (dae_system_t)
            call problem%count_evaluation(status)
            if (status == 0) call system%dae_residual(t, u(:n), rate(:n), u(n + 1:n + m), u(n + m + 1:), left(:n), &
                                                      left(n + 1:n + m), left(n + m + 1:), status)
            problem%is_fatal = problem%is_fatal .or. status < 0
         class default
            call problem%evaluate(t, u, left, status)
            left = rate - left
         end select
      end associate
   end subroutine find_residual

   ! ---- called by IDA ------------------------------------------------------------------------------

   !> Residual.
   integer(c_int) function residual(t, u, rate, left, user_data) bind(c, name="") result(status)
      real(c_double), value :: t              !! time [s]
      type(n_vector), intent(inout) :: u      !! state and multipliers
      type(n_vector), intent(inout) :: rate   !! their derivatives
      type(n_vector), intent(inout) :: left   !! residual
      type(c_ptr), value :: user_data         !! the problem

      type(problem_t), pointer :: problem
      real(c_double), pointer :: numbers(:), rates(:), rest(:)
      integer :: outcome

      call c_f_pointer(user_data, problem)
      numbers => fn_vgetarraypointer(u)
      rates => fn_vgetarraypointer(rate)
      rest => fn_vgetarraypointer(left)
      call find_residual(problem, t, numbers, rates, rest, outcome)
      status = int(outcome, c_int)
   end function residual

   !> Whether Newton's iteration has converged. Multipliers have no weight among the unknowns; they count by what they do to the
   !> velocities in a step, so that the iteration does not end before they are found. What is left after a correction is the
   !> correction times rate/(1 - rate), with the rate of the last iteration that took several. IDA's own test believes a rate of
   !> next to nothing, which the equations, linear in the multipliers, have behind each new matrix; it then takes what a matrix of
   !> many steps ago makes of any prediction. Here the last correction itself must be small: what is left of the iteration is in
   !> the differences by which the method predicts and judges its steps. Where a tenth of the correction counted, films took twice
   !> the steps.
   integer(c_int) function test_convergence(newton, u, correction, tolerance, weight, user_data) bind(c, name="") result(answer)
      type(sunnonlinearsolver), intent(inout) :: newton   !! the iteration
      type(n_vector), intent(inout) :: u                  !! sum of the corrections, not used
      type(n_vector), intent(inout) :: correction         !! the last one
      real(c_double), value :: tolerance                  !! what may be left, over the weights [1]
      type(n_vector), intent(inout) :: weight             !! error weights
      type(c_ptr), value :: user_data                     !! the problem

      real(wp), parameter :: too_slow = 0.9_wp      ! a rate [1]
      real(wp), parameter :: min_left = 1.0_wp    ! of a correction, whatever the rate [1]
      type(problem_t), pointer :: problem
      real(c_double), pointer :: changes(:), weights(:)
      real(wp) :: norm, rate
      integer(c_int) :: m(1)

      call c_f_pointer(user_data, problem)
      changes => fn_vgetarraypointer(correction)
      weights => fn_vgetarraypointer(weight)
      norm = hypot(norm2(changes*weights)/sqrt(real(size(changes), wp)), effect_of_multipliers(problem, changes))
      answer = fsunnonlinsolgetcuriter(newton, m)
      if (answer /= 0) return
      if (m(1) == 0) then
         problem%newton_norm = norm
      else
         rate = (norm/problem%newton_norm)**(1.0_wp/m(1))
         answer = newton_fails
         if (rate > too_slow) return
         problem%newton_rest = max(rate/(1.0_wp - rate), min_left)
      end if
      answer = merge(0_c_int, newton_goes_on, problem%newton_rest*norm <= tolerance)
   end function test_convergence

   !> What corrections of the multipliers do to the velocities in a step, over tolerance and scales.
   real(wp) function effect_of_multipliers(problem, changes) result(effect)
      type(problem_t), intent(inout) :: problem        !! the problem
      real(wp), intent(in) :: changes(:)               !! (N) corrections [any]

      integer :: m, n

      effect = 0.0_wp
      n = problem%system%n
      m = (size(changes) - n)/2
      if (m == 0) return
      associate (system => problem%system, method => problem%method)
         select type (system)
         class is (dae_system_t)
            effect = problem%reach/method%controls%tolerance*system%effect_of(changes(n + 1:n + m), method%scale)
         end select
      end associate
   end function effect_of_multipliers

   !> Jacobian dF/du + c dF/du' by forward differences.
   integer(c_int) function differentiate(t, c, u, rate, left, matrix, user_data, scratch_1, scratch_2, scratch_3) bind(c, name="") &
      result(status)
      real(c_double), value :: t                     !! time [s]
      real(c_double), value :: c                     !! du'/du of the method [1/s]
      type(n_vector), intent(inout) :: u             !! state and multipliers
      type(n_vector), intent(inout) :: rate          !! their derivatives
      type(n_vector), intent(inout) :: left          !! residual there
      type(sunmatrix), intent(inout) :: matrix       !! (N, N) the Jacobian
      type(c_ptr), value :: user_data                !! the problem
      type(n_vector), intent(inout) :: scratch_1     !! workspace
      type(n_vector), intent(inout) :: scratch_2     !! workspace
      type(n_vector), intent(inout) :: scratch_3     !! workspace

      type(problem_t), pointer :: problem
      real(c_double), pointer, contiguous :: block(:, :)
      real(c_double), pointer :: increment(:), moved(:), moved_rate(:), numbers(:), rates(:), rest(:)
      integer :: first, j, n, outcome

      call c_f_pointer(user_data, problem)
      numbers => fn_vgetarraypointer(u)
      rates => fn_vgetarraypointer(rate)
      rest => fn_vgetarraypointer(left)
      increment => fn_vgetarraypointer(scratch_1)
      moved => fn_vgetarraypointer(scratch_2)
      moved_rate => fn_vgetarraypointer(scratch_3)
      n = problem%system%n
      problem%reach = 1.0_wp/c
      problem%newton_rest = most_left
      if (problem%is_large()) then
         call fill_sparse(problem, t, c, numbers, rates, matrix, outcome)
         status = int(outcome, c_int)
         return
      end if
      first = n - problem%system%n_quadrature
      call dense_block(matrix, size(numbers), block)
      call increments(problem%system, numbers(:n), problem%method%scale, increment(:n))
      increment(n + 1:) = max(abs(numbers(n + 1:)), 1.0_wp)
      moved = numbers
      moved_rate = rates
      block = 0.0_wp
      outcome = 0
      do j = 1, size(numbers)
         if (j > first .and. j <= n) then
            block(j, j) = c  ! nothing depends on a quadrature
            cycle
         end if
         moved(j) = numbers(j) + increment(j)
         if (j <= n) moved_rate(j) = rates(j) + c*increment(j)
         call find_residual(problem, t, moved, moved_rate, block(:, j), outcome)
         if (outcome /= 0) exit
         block(:, j) = (block(:, j) - rest)/increment(j)
         moved(j) = numbers(j)
         moved_rate(j) = rates(j)
      end do
      status = int(outcome, c_int)
   end function differentiate

   !> The Jacobian of a large system.
   subroutine fill_sparse(problem, t, c, u, rate, matrix, status)
      type(problem_t), intent(inout) :: problem         !! the problem
      real(wp), intent(in) :: t                         !! time [s]
      real(wp), intent(in) :: c                         !! du'/du of the method [1/s]
      real(wp), intent(in) :: u(:)                      !! (N) state and multipliers [any]
      real(wp), intent(in) :: rate(:)                   !! (N) their derivatives [any]
      type(sunmatrix), intent(inout) :: matrix          !! (N, N) the Jacobian, by columns
      integer, intent(out) :: status                    !! 0 done, > 0 retry with a smaller step, < 0 give up

      real(c_double), pointer :: entries(:)
      integer(sunindextype), pointer :: places(:), rows(:)
      real(c_double), pointer :: first_entry(:)                    ! the library's own pointers have one element
      integer(sunindextype), pointer :: first_place(:), first_row(:)
      integer :: m, n

      n = problem%system%n
      m = (size(u) - n)/2
      call problem%fill_newton(t, c, u(:n), rate(:n), u(n + 1:n + m), u(n + m + 1:), status)
      if (status /= 0) return
      first_place => fsunsparsematrix_indexpointers(matrix)
      first_row => fsunsparsematrix_indexvalues(matrix)
      first_entry => fsunsparsematrix_data(matrix)
      associate (newton => problem%newton)
         call c_f_pointer(c_loc(first_place(1)), places, [size(newton%column)])
         call c_f_pointer(c_loc(first_row(1)), rows, [size(newton%row)])
         call c_f_pointer(c_loc(first_entry(1)), entries, [size(newton%a)])
         places = newton%column
         rows = newton%row
         entries = newton%a
      end associate
   end subroutine fill_sparse

end module ida_callbacks
