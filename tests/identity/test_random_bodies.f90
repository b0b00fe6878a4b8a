!> All solvers on bodies tied by rows drawn at random, with the rates of a body in the plane and with those in space: against a full
!> matrix that LAPACK factorises, and a planar problem against itself in space.
module test_random_bodies
   use augmented, only: augmented_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use lone_bodies, only: find_lone_bodies, lone_t
   use random_bodies, only: all_unknown, new_problem, problem_t, some_known, solve_fully, tree
   use rows, only: n_v_planar, n_v_spatial
   use solution, only: solution_t
   use solver_registry, only: n_solver_kinds, new_solver
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_random_bodies

   integer, parameter :: n_rates(2) = [n_v_planar, n_v_spatial]
   real(wp), parameter :: untouched = 123.0_wp  !! in entries that are not to be set [any]

contains

   subroutine run_test_random_bodies(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("independent_rows", test_independent)
      call suite%test("dependent_rows", test_dependent)
      call suite%test("damped_where_independent", test_damped)
      call suite%test("lone_bodies", test_lone)
      call suite%test("plane_in_space", test_plane_in_space)
   end subroutine run_test_random_bodies

   !> A solver's results against those of the full matrix, and that nothing else was set.
   subroutine compare(problem, a, lambda, is_singular, tolerance, what, error)
      type(problem_t), intent(in) :: problem              !! the equations
      real(wp), intent(in) :: a(:, 0:)                    !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(in) :: lambda(:)                   !! (rows) multipliers [N or N.m]
      logical, intent(in) :: is_singular                  !! whether the rows depend on one another
      real(wp), intent(in) :: tolerance(2)                !! (2) for accelerations and multipliers, of the maximum [1]
      character(*), intent(in) :: what                    !! which solver
      type(error_t), allocatable, intent(inout) :: error  !! first failure

      real(wp), allocatable :: full_a(:, :), full_lambda(:), left(:, :), row_left(:)
      real(wp) :: maximum(2)
      integer :: block, body, row, side

      if (allocated(error)) return
      allocate (full_a(size(a, 1), 0:problem%n_body), source=untouched)
      allocate (left(size(a, 1), 0:problem%n_body), source=0.0_wp)
      full_lambda = spread(untouched, 1, size(lambda))
      call solve_fully(problem, is_singular, full_a, full_lambda, error)
      maximum = [maxval(abs(full_a(:, problem%rows%unknown))), maxval(abs(full_lambda(:problem%rows%n_solve)))]
      call check_close(error, reshape(a, [size(a)]), reshape(full_a, [size(a)]), tolerance(1)*maximum(1), &
                       what//": accelerations")
      associate (rows => problem%rows, n_v => problem%rows%n_v)
         call check_close(error, lambda, full_lambda, tolerance(2)*maximum(2), what//": multipliers")
         ! M a + J^T lambda = g, J a = b, side by side
         left(:, rows%unknown) = a(:, rows%unknown)/problem%inverse_mass(:, rows%unknown) - problem%g(:, rows%unknown)
         row_left = -problem%b
         do block = 1, rows%n_block
            row = rows%owner(block)
            if (row > rows%n_solve) cycle
            do side = 1, 2
               body = rows%body(side, block)
               if (.not. any(rows%unknown == body)) cycle
               associate (jac => rows%jac(n_v*(side - 1) + 1:n_v*side, block))
                  left(:, body) = left(:, body) + jac*lambda(row)
                  row_left(row) = row_left(row) + dot_product(jac, a(:, body))
               end associate
            end do
         end do
         call check_close(error, row_left(:rows%n_solve), spread(0.0_wp, 1, rows%n_solve), tolerance(1)*maximum(1), &
                          what//": rows")
         call check_close(error, reshape(left(:, rows%unknown), [n_v*rows%n_unknown]), spread(0.0_wp, 1, n_v*rows%n_unknown), &
                          tolerance(1)*maxval(maximum), what//": motion")
      end associate
   end subroutine compare

   !> What a solver allows: penalties cost digits.
   function tolerance_of(solver) result(tolerance)
      class(augmented_t), intent(in) :: solver   !! the solver
      real(wp) :: tolerance(2)                   !! (2) for accelerations and multipliers, of the maximum [1]

      tolerance = [1.0e-12_wp, 1.0e-11_wp]
      if (solver%name() == "augmented_lagrangian") tolerance = [1.0e-11_wp, 1.0e-8_wp]
   end function tolerance_of

   !> All solvers where rows are independent, all bodies unknown and some known, and rows that are not solved for.
   subroutine test_independent(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(augmented_t), allocatable :: solver
      type(problem_t) :: problem
      integer :: i, k, seed

      do k = 1, 2
         do seed = 1, 5
            call new_problem(n_rates(k), all_unknown, tree(n_rates(k), all_unknown, seed), 0, 7*seed, problem)
            do i = 1, n_solver_kinds()
               call check_solver("unknown")
            end do
            call new_problem(n_rates(k), some_known, &
                             reshape([tree(n_rates(k), some_known, seed), 0, 2, 2, 5], &
                                     [2, size(tree(n_rates(k), some_known, seed))/2 + 2]), 2, 7*seed, problem)
            do i = 1, n_solver_kinds()
               call check_solver("known")
            end do
            associate (body => tree(n_rates(k), some_known, seed))
               associate (n => size(body, 2))
                  call new_problem(n_rates(k), some_known, body, 0, 7*seed, problem, &
                                   reshape([n, 1, 2, n, 0, 5, n - 1, 6, 4], [3, 3]))
               end associate
            end associate
            do i = 1, n_solver_kinds()
               call check_solver("rows of many bodies")
            end do
         end do
      end do

   contains

      !> One solver.
      subroutine check_solver(what)
         character(*), intent(in) :: what  !! which bodies

         real(wp), allocatable :: a(:, :), lambda(:)
         character(:), allocatable :: name
         integer :: bad_row

         if (allocated(error)) return
         call new_solver(i, solver)
         call solver%prepare(problem%n_body, problem%rows)
         name = what//" bodies, "//to_text(n_rates(k))//" rates, seed "//to_text(seed)//", "//solver%name()
         allocate (a(n_rates(k), 0:problem%n_body), source=untouched)
         lambda = spread(untouched, 1, problem%rows%n)
         call solver%solve(problem%inverse_mass, problem%rows, problem%g, problem%b, a, lambda, bad_row)
         call check_equal(error, bad_row, 0, name//": a row that depends on others")
         call compare(problem, a, lambda, .false., tolerance_of(solver), name, error)
      end subroutine check_solver

   end subroutine test_independent

   !> All solvers where some rows are combinations of others and one ties prescribed bodies: accelerations as they are, multipliers
   !> of least norm, both where that is known before and, to the smaller damping, where it shows.
   subroutine test_dependent(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(problem_t) :: problem
      real(wp), allocatable :: a(:, :)
      type(random_t) :: random
      integer, allocatable :: body(:, :)
      integer :: i, k, n, seed, side

      do k = 1, 2
         do seed = 1, 5
            body = tree(n_rates(k), some_known, seed)
            n = size(body, 2)
            body = reshape([body, body(:, 3), body(:, n), body(:, n), 2, 5], [2, n + 4])
            call new_problem(n_rates(k), some_known, body, 0, 11*seed, problem)
            problem%rows%jac(:, n + 1) = -2.0_wp*problem%rows%jac(:, 3)
            problem%rows%jac(:, n + 2) = problem%rows%jac(:, n)
            problem%rows%jac(:, n + 3) = 0.5_wp*problem%rows%jac(:, n)
            ! rows that agree with one another are those of some accelerations
            random%state = int(seed, i8)
            a = reshape(random%vector(size(problem%g), -1.0_wp, 1.0_wp), shape(problem%g))
            problem%b = 0.0_wp
            do i = 1, n + 3
               do side = 1, 2
                  if (.not. any(problem%rows%unknown == body(side, i))) cycle
                  associate (n_v => n_rates(k))
                     problem%b(i) = problem%b(i) + &
                                    dot_product(problem%rows%jac(n_v*(side - 1) + 1:n_v*side, i), a(:, body(side, i) + 1))
                  end associate
               end do
            end do
            do i = 1, n_solver_kinds()
               call check_solver(.true., [1.0e-10_wp, 1.0e-9_wp])
               call check_solver(.false., [1.0e-8_wp, 1.0e-4_wp])
            end do
         end do
      end do

   contains

      !> One solver.
      subroutine check_solver(is_redundant, tolerance)
         logical, intent(in) :: is_redundant    !! whether that is known before
         real(wp), intent(in) :: tolerance(2)   !! (2) for accelerations and multipliers, of the maximum [1]

         type(solution_t) :: solution
         character(:), allocatable :: name
         integer :: status

         if (allocated(error)) return
         call new_solver(i, solution%solver)
         call solution%solver%prepare(problem%n_body, problem%rows)
         name = to_text(n_rates(k))//" rates, seed "//to_text(seed)//", "//solution%solver%name()//", known before: "// &
                merge("yes", "no ", is_redundant)
         solution%is_redundant = is_redundant
         solution%b = problem%b
         allocate (solution%a(n_rates(k), 0:problem%n_body), source=untouched)
         solution%lambda = spread(0.0_wp, 1, problem%rows%n)
         call solution%find(problem%inverse_mass, problem%rows, problem%g, .true., status)
         call check_equal(error, status, 0, name//": status")
         call check_true(error, solution%n_damped == 1 .or. solution%solver%is_iterative, name//": a damped solution")
         call compare(problem, solution%a, solution%lambda, .true., tolerance, name, error)
      end subroutine check_solver

   end subroutine test_dependent

   !> Damped solutions of independent rows are the plain ones, refined.
   subroutine test_damped(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(augmented_t), allocatable :: solver
      type(problem_t) :: problem
      real(wp), allocatable :: a(:, :), lambda(:)
      character(:), allocatable :: name
      integer :: bad_row, i, k

      do k = 1, 2
         call new_problem(n_rates(k), some_known, tree(n_rates(k), some_known, 6), 0, 77, problem)
         do i = 1, n_solver_kinds()
            call new_solver(i, solver)
            call solver%prepare(problem%n_body, problem%rows)
            name = to_text(n_rates(k))//" rates, "//solver%name()
            if (allocated(a)) deallocate (a)
            allocate (a(n_rates(k), 0:problem%n_body), source=untouched)
            lambda = spread(0.0_wp, 1, problem%rows%n)
            call solver%solve_damped(problem%inverse_mass, problem%rows, problem%g, problem%b, 1.0e-6_wp, 10, a, lambda, bad_row)
            call check_equal(error, bad_row, 0, name//": a row without a solution")
            call compare(problem, a, lambda, .false., [1.0e-11_wp, 1.0e-8_wp], name, error)
            call check_true(error, solver%left_over <= 1.0e-13_wp, name//": what is left over")
         end do
      end do
   end subroutine test_damped

   !> Bodies with one row and with two on known ones: found, solved in closed form, and named where their rows are parallel.
   subroutine test_lone(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: body(2, 9) = reshape([0, 1, 2, 3, 4, 2, 5, 3, 6, 7, 6, 0, 8, 0, 8, 5, 1, 0], [2, 9])
      class(augmented_t), allocatable :: solver
      type(problem_t) :: problem
      type(lone_t) :: lone
      real(wp), allocatable :: a(:, :), lambda(:)
      integer :: bad_row, k

      do k = 1, 2
         call new_problem(n_rates(k), some_known, body, 0, 13, problem)
         call find_lone_bodies(problem%rows, lone)
         call check_equal(error, lone%n(1), 1, "bodies with one row")
         call check_equal(error, lone%n(2), 3, "bodies with two")
         if (allocated(error)) return
         call check_true(error, all(lone%body == [4, 1, 3, 8]), "their numbers")
         call new_solver(1, solver)
         call check_equal(error, solver%name(), "schur", "the solver with closed forms")
         call solver%prepare(problem%n_body, problem%rows)
         if (allocated(a)) deallocate (a)
         allocate (a(n_rates(k), 0:problem%n_body), source=untouched)
         lambda = spread(untouched, 1, problem%rows%n)
         call solver%solve(problem%inverse_mass, problem%rows, problem%g, problem%b, a, lambda, bad_row)
         call check_equal(error, bad_row, 0, "a row that depends on others")
         call compare(problem, a, lambda, .false., tolerance_of(solver), to_text(n_rates(k))//" rates", error)
         associate (n_v => n_rates(k), jac => problem%rows%jac)
            jac(:n_v, 8) = 3.0_wp*jac(:n_v, 7)
         end associate
         call solver%solve(problem%inverse_mass, problem%rows, problem%g, problem%b, a, lambda, bad_row)
         call check_equal(error, bad_row, 8, "the row that is parallel to the one before")
      end do
   end subroutine test_lone

   !> A planar problem in space: the other coordinates of each body held by a row each that takes the load on them. Accelerations
   !> and multipliers stay what they are in the plane.
   subroutine test_plane_in_space(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: planar(3) = [1, 2, 6], other(3) = [3, 4, 5]
      class(augmented_t), allocatable :: solver
      type(problem_t) :: flat, space
      real(wp), allocatable :: a(:, :), flat_a(:, :), flat_lambda(:), lambda(:)
      real(wp) :: tolerance(2)
      integer, allocatable :: body(:, :)
      integer :: bad_row, c, i, k, n

      call new_problem(n_v_planar, some_known, tree(n_v_planar, some_known, 4), 0, 21, flat)
      n = flat%rows%n
      body = reshape([flat%rows%body, ([(flat%rows%unknown(k), 0, c=1, 3)], k=1, flat%rows%n_unknown)], &
                     [2, n + 3*flat%rows%n_unknown])
      call new_problem(n_v_spatial, some_known, body, 0, 22, space)
      space%inverse_mass(planar, :) = flat%inverse_mass
      space%g(planar, :) = flat%g
      space%b = 0.0_wp
      space%b(:n) = flat%b
      space%rows%jac = 0.0_wp
      space%rows%jac(planar, :n) = flat%rows%jac(:3, :)
      space%rows%jac(6 + planar, :n) = flat%rows%jac(4:, :)
      do k = 1, flat%rows%n_unknown
         do c = 1, 3
            space%rows%jac(other(c), n + 3*(k - 1) + c) = 1.0_wp
         end do
      end do
      do i = 1, n_solver_kinds()
         call new_solver(i, solver)
         call solver%prepare(flat%n_body, flat%rows)
         if (allocated(flat_a)) deallocate (flat_a, a)
         allocate (flat_a(n_v_planar, 0:flat%n_body), a(n_v_spatial, 0:flat%n_body), source=untouched)
         flat_lambda = spread(untouched, 1, n)
         call solver%solve(flat%inverse_mass, flat%rows, flat%g, flat%b, flat_a, flat_lambda, bad_row)
         call check_equal(error, bad_row, 0, solver%name()//" in the plane")
         call new_solver(i, solver)
         call solver%prepare(space%n_body, space%rows)
         lambda = spread(untouched, 1, space%rows%n)
         call solver%solve(space%inverse_mass, space%rows, space%g, space%b, a, lambda, bad_row)
         call check_equal(error, bad_row, 0, solver%name()//" in space")
         tolerance = tolerance_of(solver)*[maxval(abs(flat_a(:, flat%rows%unknown))), maxval(abs(flat_lambda))]
         do k = 1, flat%rows%n_unknown
            associate (of_body => a(:, flat%rows%unknown(k)), in_plane => flat_a(:, flat%rows%unknown(k)))
               call check_close(error, of_body(planar), in_plane, tolerance(1), solver%name()//": accelerations")
               call check_close(error, of_body(other), spread(0.0_wp, 1, 3), tolerance(1), &
                                solver%name()//": accelerations out of the plane")
               call check_close(error, lambda(n + 3*k - 2:n + 3*k), space%g(other, flat%rows%unknown(k)), &
                                tolerance(2), solver%name()//": multipliers out of the plane")
            end associate
         end do
         call check_close(error, lambda(:n), flat_lambda, tolerance(2), solver%name()//": multipliers")
      end do
   end subroutine test_plane_in_space

end module test_random_bodies
