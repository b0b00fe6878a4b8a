!> Rows drawn at random, with the rates of a body in the plane and with those in space: places in the Jacobian, right-hand sides,
!> and the sparse start against full matrices that LAPACK factorises.
module test_random_rows
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use random_bodies, only: all_unknown, min_solution, new_problem, problem_t, some_known, tree
   use row_kernels, only: right_hand_side, take_prescribed
   use rows, only: n_v_planar, n_v_spatial, side_place
   use sparse_start, only: new_sparse_start, sparse_start_t
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_random_rows

   integer, parameter :: n_rates(2) = [n_v_planar, n_v_spatial]
   real(wp), parameter :: untouched = 123.0_wp  !! in entries that are not to be set [any]

contains

   subroutine run_test_random_rows(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("places", test_places)
      call suite%test("right_hand_side", test_right_hand_side)
      call suite%test("known_accelerations", test_known)
      call suite%test("least_change", test_min_change)
      call suite%test("dependent_rows_of_a_start", test_start_dependent)
   end subroutine run_test_random_rows

   !> Where the entries of a side are, among all and in its row.
   subroutine test_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(problem_t) :: problem
      real(wp), allocatable :: all(:)
      integer :: k, place

      do k = 1, 2
         call new_problem(n_rates(k), some_known, reshape([4, 0, 2, 4, 3, 5, 7, 3], [2, 4]), 1, 3, problem)
         associate (rows => problem%rows, n_v => n_rates(k))
            call check_equal(error, size(rows%jac, 1), 2*n_v, "columns of a row")
            call check_equal(error, rows%n_side, 3, "sides of unknown bodies")
            call check_equal(error, size(rows%known, 2), 2, "sides of known bodies")
            all = reshape(rows%jac, [size(rows%jac)])
            place = side_place(n_v, 3, 2)
            call check_close(error, all(place + 1:place + n_v), rows%jac(n_v + 1:, 3), 0.0_wp, "second side of row 3")
            place = side_place(n_v, 4, 1)
            call check_close(error, all(place + 1:place + n_v), rows%jac(:n_v, 4), 0.0_wp, "first side of row 4")
         end associate
      end do
   end subroutine test_places

   !> Rates of a body, of velocities and angular velocities in three axes.
   pure function rates_of(n_v, v, omega) result(rates)
      integer, intent(in) :: n_v         !! rates of a body
      real(wp), intent(in) :: v(3)       !! (3) velocity, or acceleration [m/s or m/s^2]
      real(wp), intent(in) :: omega(3)   !! (3) angular velocity, or acceleration [rad/s or rad/s^2]
      real(wp) :: rates(n_v)             !! (n_v) what the columns of a row belong to [any]

      if (n_v == n_v_planar) then
         rates = [v(:2), omega(3)]
      else
         rates = [v, omega]
      end if
   end function rates_of

   !> Phi' = Phi_q v + Phi_t and b = gamma - 2 alpha Phi' - beta^2 Phi of the solved rows, in the plane and in space.
   subroutine test_right_hand_side(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: alpha = 3.0_wp, beta = 4.0_wp
      type(problem_t) :: problem
      type(random_t) :: random
      real(wp), dimension(3, 0:size(some_known)) :: omega, v
      real(wp), allocatable :: b(:), phi_dot(:)
      real(wp) :: rate
      integer :: block, k, row

      do k = 1, 2
         call new_problem(n_rates(k), some_known, &
                          reshape([0, 1, 3, 0, 4, 3, 2, 6, 7, 9, 2, 5, 0, 9], [2, 7]), 2, 31, problem, &
                          reshape([2, 5, 8, 5, 1, 0, 2, 4, 0], [3, 3]))
         random%state = 8_i8
         v = reshape(random%vector(size(v), -3.0_wp, 3.0_wp), shape(v))
         omega = reshape(random%vector(size(v), -3.0_wp, 3.0_wp), shape(v))
         v(:, 0) = 0.0_wp
         omega(:, 0) = 0.0_wp
         associate (rows => problem%rows, n_v => n_rates(k))
            rows%phi = random%vector(rows%n, -1.0_wp, 1.0_wp)
            rows%phi_t = random%vector(rows%n, -1.0_wp, 1.0_wp)
            rows%gam = random%vector(rows%n, -1.0_wp, 1.0_wp)
            b = spread(untouched, 1, rows%n)
            phi_dot = b
            call right_hand_side(1, 2, rows, problem%n_body, v, omega, alpha, beta, phi_dot, b)
            call right_hand_side(3, rows%n_solve, rows, problem%n_body, v, omega, alpha, beta, phi_dot, b)
            do row = 1, rows%n_solve
               rate = rows%phi_t(row)
               associate (i => rows%body(1, row), j => rows%body(2, row))
                  rate = rate + sum(rows%jac(:, row)*[rates_of(n_v, v(:, i), omega(:, i)), rates_of(n_v, v(:, j), omega(:, j))])
               end associate
               do block = rows%n + 1, rows%n_block
                  if (rows%owner(block) /= row) cycle
                  associate (i => rows%body(1, block), j => rows%body(2, block))
                     rate = rate + sum(rows%jac(:, block)*[rates_of(n_v, v(:, i), omega(:, i)), &
                                                           rates_of(n_v, v(:, j), omega(:, j))])
                  end associate
               end do
               call check_close(error, phi_dot(row), rate, 1.0e-13_wp, to_text(n_v)//" rates: rate of row "//to_text(row))
               call check_close(error, b(row), rows%gam(row) - 2.0_wp*alpha*rate - beta**2*rows%phi(row), 1.0e-12_wp, &
                                to_text(n_v)//" rates: right-hand side of row "//to_text(row))
            end do
            call check_close(error, [b(rows%n_solve + 1:), phi_dot(rows%n_solve + 1:)], spread(untouched, 1, 4), 0.0_wp, &
                             "rows that are not solved for")
         end associate
      end do
   end subroutine test_right_hand_side

   !> What accelerations of prescribed bodies take off the right-hand side.
   subroutine test_known(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(problem_t) :: problem
      type(random_t) :: random
      real(wp), dimension(3, 0:size(some_known)) :: a, angular
      real(wp), allocatable :: b(:), right(:)
      integer :: block, body, k, row, side

      do k = 1, 2
         call new_problem(n_rates(k), some_known, reshape([0, 1, 2, 4, 4, 5, 9, 5, 3, 4, 2, 6], [2, 6]), 1, 41, problem, &
                          reshape([1, 3, 4, 5, 2, 7, 1, 5, 6], [3, 3]))
         random%state = 9_i8
         a = reshape(random%vector(size(a), -3.0_wp, 3.0_wp), shape(a))
         angular = reshape(random%vector(size(a), -3.0_wp, 3.0_wp), shape(a))
         associate (rows => problem%rows, n_v => n_rates(k))
            right = problem%b
            do block = 1, rows%n_block
               row = rows%owner(block)
               if (row > rows%n_solve) cycle
               do side = 1, 2
                  body = rows%body(side, block)
                  if (body == 0 .or. any(rows%unknown == body)) cycle
                  right(row) = right(row) - sum(rows%jac(n_v*(side - 1) + 1:n_v*side, block)* &
                                                rates_of(n_v, a(:, body), angular(:, body)))
               end do
            end do
            b = problem%b
            call take_prescribed(rows, problem%n_body, a, angular, b)
            call check_close(error, b, right, 1.0e-13_wp, to_text(n_v)//" rates")
         end associate
      end do
   end subroutine test_known

   !> A Jacobian of all bodies, dependent rows among its own: rows, a Jacobian without the ground's columns, weights.
   subroutine new_start(n_v, seed, problem, jac, weight)
      integer, intent(in) :: n_v                        !! rates of a body
      integer, intent(in) :: seed                       !! of the numbers
      type(problem_t), intent(out) :: problem           !! rows
      real(wp), allocatable, intent(out) :: jac(:, :)   !! (rows, n_v bodies) the same Jacobian in full [1 or m]
      real(wp), allocatable, intent(out) :: weight(:)   !! (n_v bodies) weights [any]

      integer, allocatable :: body(:, :)
      integer :: n, row, side

      body = tree(n_v, all_unknown, seed)
      n = size(body, 2)
      call new_problem(n_v, all_unknown, reshape([body, body(:, 4), body(:, n)], [2, n + 2]), 0, 5*seed, problem)
      problem%rows%jac(:, n + 1) = problem%rows%jac(:, 4)
      problem%rows%jac(:, n + 2) = problem%rows%jac(:, n)
      allocate (jac(n + 2, n_v*problem%n_body), source=0.0_wp)
      do row = 1, n + 2
         do side = 1, 2
            associate (k => problem%rows%body(side, row))
               if (k > 0) jac(row, n_v*(k - 1) + 1:n_v*k) = problem%rows%jac(n_v*(side - 1) + 1:n_v*side, row)
            end associate
         end do
      end do
      weight = reshape(problem%inverse_mass(:, 1:), [n_v*problem%n_body])
   end subroutine new_start

   !> The minimum change of coordinates with given changes of rows, in a metric of weights.
   subroutine test_min_change(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(problem_t) :: problem
      type(sparse_start_t) :: start
      type(random_t) :: random
      real(wp), allocatable :: jac(:, :), minimum(:), right(:), weight(:), x(:)
      integer :: k, min_rank, rank, seed

      do k = 1, 2
         do seed = 1, 4
            call new_start(n_rates(k), seed, problem, jac, weight)
            random%state = int(seed, i8)
            right = matmul(jac, random%vector(size(jac, 2), -1.0_wp, 1.0_wp))
            minimum = right
            call min_solution(jac*spread(sqrt(weight), 1, size(jac, 1)), minimum, min_rank)
            minimum = minimum*sqrt(weight)
            call new_sparse_start(problem%n_body, problem%rows, start)
            x = weight
            call start%correct(problem%rows%jac, problem%inverse_mass, right, x, rank)
            associate (what => to_text(n_rates(k))//" rates, seed "//to_text(seed)//": ")
               call check_equal(error, rank, min_rank, what//"rank")
               call check_equal(error, rank, size(right) - 2, what//"independent rows")
               call check_close(error, matmul(jac, x), right, 1.0e-13_wp*maxval(abs(right)), what//"rows")
               call check_close(error, x, minimum, 1.0e-11_wp, what//"the change", relative=.true.)
            end associate
         end do
      end do
   end subroutine test_min_change

   !> Rows that are there twice are found, with their reference runs.
   subroutine test_start_dependent(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(problem_t) :: problem
      type(sparse_start_t) :: start
      real(wp), allocatable :: jac(:, :), weight(:)
      integer, allocatable :: dependent(:), shared(:)
      integer :: k, n, seed

      do k = 1, 2
         do seed = 1, 4
            call new_start(n_rates(k), seed, problem, jac, weight)
            n = size(jac, 1)
            call new_sparse_start(problem%n_body, problem%rows, start)
            call start%find_dependent(problem%rows%jac, problem%inverse_mass, spread(1.0_wp, 1, n), 1.0e-6_wp, dependent, shared)
            call check_equal(error, size(dependent), 2, "dependent rows")
            call check_equal(error, size(shared), 4, "rows in combinations")
            if (allocated(error)) return
            call check_true(error, all(shared == [4, n - 2, n - 1, n]), "the rows and their twins")
            call check_true(error, any(dependent(1) == shared) .and. any(dependent(2) == shared), "the dependent ones among them")
         end do
      end do
   end subroutine test_start_dependent

end module test_random_rows
