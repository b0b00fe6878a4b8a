!> Bodies tied by rows drawn at random, and the solution of their equations by one full matrix that LAPACK factorises.
!>
!> With unknown bodies only, coordinates scaled by the root of the mass and rows by that of the diagonal D of J M^-1 J^T:
!>
!> [ I  A^T ] [ M^(1/2) a      ]   [ M^(-1/2) g ]
!> [ A   0  ] [ D^(1/2) lambda ] = [ D^(-1/2) b ],   A = D^(-1/2) J M^(-1/2).
module random_bodies
   use errors, only: error_t
   use check, only: check_equal
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use lapack, only: dgelsd, dgetrf, dgetrs
   use rows, only: list_sides, new_rows, rows_t
   implicit none (type, external)
   private
   public :: all_unknown, min_solution, new_problem, problem_t, solve_fully, some_known, tree

   logical, parameter :: all_unknown(8) = .false.  !! (bodies) whether the motion of a body is known: of none
   logical, parameter :: some_known(9) = [.false., .true., .false., .false., .true., .false., .false., .false., .true.]  !! of three

   !> Rows, masses, loads and right-hand sides.
   type :: problem_t
      type(rows_t) :: rows                          !! the rows
      integer :: n_body = 0                         !! number of bodies
      real(wp), allocatable :: inverse_mass(:, :)   !! (n_v, 0:bodies) inverse masses, 0 if known [1/kg or 1/(kg.m^2)]
      real(wp), allocatable :: g(:, :)              !! (n_v, 0:bodies) loads [N or N.m]
      real(wp), allocatable :: b(:)                 !! (rows) right-hand side [m/s^2 or rad/s^2]
   end type problem_t

contains

   !> Bodies and rows with numbers from the seed. All rows are solved for but the last n_left.
   subroutine new_problem(n_v, is_known, body, n_left, seed, problem, more)
      integer, intent(in) :: n_v               !! rates of a body
      logical, intent(in) :: is_known(:)       !! (bodies) whether the motion of a body is known
      integer, intent(in) :: body(:, :)        !! (2, rows) bodies of the rows, 0: ground
      integer, intent(in) :: n_left            !! rows that are not solved for
      integer, intent(in) :: seed              !! of the numbers
      type(problem_t), intent(out) :: problem  !! the equations
      integer, intent(in), optional :: more(:, :)  !! (3, blocks) row and two bodies of each further block; absent: none

      type(random_t) :: random
      integer :: k, n_more

      n_more = 0
      if (present(more)) n_more = size(more, 2)
      random%state = int(seed, i8)
      associate (rows => problem%rows, n => size(is_known))
         problem%n_body = n
         call new_rows(size(body, 2), rows, n_v, n_more)
         rows%body(:, :rows%n) = body
         if (present(more)) then
            rows%owner(rows%n + 1:) = more(1, :)
            rows%body(:, rows%n + 1:) = more(2:, :)
         end if
         rows%n_solve = rows%n - n_left
         call list_sides(is_known, rows)
         do k = 1, rows%n_block
            rows%jac(:, k) = random%vector(2*n_v, -1.0_wp, 1.0_wp)
         end do
         allocate (problem%inverse_mass(n_v, 0:n), problem%g(n_v, 0:n), source=0.0_wp)
         do k = 1, n
            problem%g(:, k) = random%vector(n_v, -5.0_wp, 5.0_wp)
            problem%inverse_mass(:, k) = random%vector(n_v, 0.2_wp, 3.0_wp)
            if (is_known(k)) problem%inverse_mass(:, k) = 0.0_wp
         end do
         problem%b = random%vector(rows%n, -2.0_wp, 2.0_wp)
      end associate
   end subroutine new_problem

   !> A tree of the unknown bodies on the ground, on known ones and on one another, each by fewer rows than it has rates, with two
   !> rows more that close loops: independent. Sides change about.
   function tree(n_v, is_known, seed) result(body)
      integer, intent(in) :: n_v             !! rates of a body
      logical, intent(in) :: is_known(:)     !! (bodies) whether the motion of a body is known
      integer, intent(in) :: seed            !! of the numbers
      integer, allocatable :: body(:, :)     !! (2, rows) bodies of the rows

      type(random_t) :: random
      integer, allocatable :: list(:)
      integer :: k, m, other

      random%state = int(seed, i8)
      list = [integer ::]
      do k = 1, size(is_known)
         other = int(random%between(0.0_wp, real(k, wp)))
         if (is_known(k)) cycle
         do m = 1, 1 + int(random%between(0.0_wp, real(n_v - 1, wp)))
            list = [list, merge([other, k], [k, other], modulo(m + k, 2) == 0)]
         end do
      end do
      body = reshape([list, 3, 7, 8, 4], [2, size(list)/2 + 2])
   end function tree

   !> Jacobian of the solved rows as a full matrix of the unknown bodies' coordinates.
   function full_jacobian(problem) result(jac)
      type(problem_t), intent(in) :: problem   !! the equations
      real(wp), allocatable :: jac(:, :)       !! (solved rows, coordinates) J [1 or m]

      integer :: block, k, number(0:problem%n_body), row, side

      associate (rows => problem%rows, n_v => problem%rows%n_v)
         number = 0
         number(rows%unknown) = [(k, k=1, rows%n_unknown)]
         allocate (jac(rows%n_solve, n_v*rows%n_unknown), source=0.0_wp)
         do block = 1, rows%n_block
            row = rows%owner(block)
            if (row > rows%n_solve) cycle
            do side = 1, 2
               k = number(rows%body(side, block))
               if (k > 0) jac(row, n_v*(k - 1) + 1:n_v*k) = rows%jac(n_v*(side - 1) + 1:n_v*side, block)
            end do
         end do
      end associate
   end function full_jacobian

   !> Accelerations and multipliers from the full matrix; where it is singular the solution with the minimum multipliers, measured
   !> by the roots of D. Unset entries stay as they are.
   subroutine solve_fully(problem, is_singular, a, lambda, error)
      type(problem_t), intent(in) :: problem              !! the equations
      logical, intent(in) :: is_singular                  !! whether the rows depend on one another
      real(wp), intent(inout) :: a(:, 0:)                 !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout) :: lambda(:)                !! (rows) multipliers [N or N.m]
      type(error_t), allocatable, intent(inout) :: error  !! what failed

      real(wp), allocatable :: jac(:, :), matrix(:, :), root(:), scale(:), x(:)
      integer, allocatable :: pivots(:)
      integer :: info, k, m, n, rank

      if (allocated(error)) return
      associate (rows => problem%rows, n_v => problem%rows%n_v)
         m = rows%n_solve
         n = n_v*rows%n_unknown
         root = sqrt(reshape(problem%inverse_mass(:, rows%unknown), [n]))
         jac = full_jacobian(problem)*spread(root, 1, m)
         scale = sqrt(sum(jac**2, dim=2))
         where (.not. scale > 0.0_wp) scale = 1.0_wp
         allocate (matrix(n + m, n + m), source=0.0_wp)
         do k = 1, n
            matrix(k, k) = 1.0_wp
         end do
         matrix(n + 1:, :n) = jac/spread(scale, 2, n)
         matrix(:n, n + 1:) = transpose(matrix(n + 1:, :n))
         x = [reshape(problem%g(:, rows%unknown), [n])*root, problem%b(:m)/scale]
         if (is_singular) then
            call min_solution(matrix, x, rank)
         else
            allocate (pivots(n + m), source=0)
            call dgetrf(n + m, n + m, matrix, n + m, pivots, info)
            call check_equal(error, info, 0, "the full matrix is regular")
            call dgetrs("N", n + m, 1, matrix, n + m, pivots, x, n + m, info)
         end if
         a(:, rows%unknown) = reshape(x(:n)*root, [n_v, rows%n_unknown])
         lambda(:m) = x(n + 1:)/scale
      end associate
   end subroutine solve_fully

   !> The minimum x, by singular values, that fulfils as much of A x = b as there can be.
   subroutine min_solution(matrix, x, rank)
      real(wp), intent(in) :: matrix(:, :)             !! (m, n) A [any]
      real(wp), allocatable, intent(inout) :: x(:)     !! (m) b, then (n) the solution [any]
      integer, intent(out) :: rank                     !! rank of A

      real(wp), allocatable :: a(:, :), b(:, :), s(:), work(:)
      integer, allocatable :: iwork(:)
      integer :: info, m, n

      m = size(matrix, 1)
      n = size(matrix, 2)
      a = matrix
      allocate (b(max(m, n), 1), s(min(m, n)), work(1), source=0.0_wp)
      allocate (iwork(40*min(m, n)), source=0)
      b(:m, 1) = x
      call dgelsd(m, n, 1, a, m, b, max(m, n), s, 1.0e-11_wp, rank, work, -1, iwork, info)
      work = spread(0.0_wp, 1, int(work(1)))
      call dgelsd(m, n, 1, a, m, b, max(m, n), s, 1.0e-11_wp, rank, work, size(work), iwork, info)
      x = b(:n, 1)
   end subroutine min_solution

end module random_bodies
