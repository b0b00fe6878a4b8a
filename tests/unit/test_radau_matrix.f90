!> Newton's matrix in the directions that move with the system, and what it is made of.
module test_radau_matrix
   use archive, only: archive_t
   use anderson, only: anderson_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use ode_examples, only: plain_t
   use radau_matrix, only: radau_matrix_t
   use radau_products, only: a, filter_product_t, real_eigenvalue
   implicit none (type, external)
   private
   public :: run_test_radau_matrix

   integer, parameter :: n = 5   !! entries of the linear equations: two positions, two rates, one other

   !> y' = J y.
   type, extends(plain_t) :: linear_t
      real(wp) :: j(n, n) = 0.0_wp   !! (n, n) J [any]
   contains
      procedure :: evaluate => linear_evaluate
   end type linear_t

contains

   subroutine run_test_radau_matrix(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("linear_equations_of_the_stages", test_stages)
      call suite%test("filter_of_the_error", test_filter)
      call suite%test("comes_back_from_a_checkpoint", test_memory)
      call suite%test("acceleration_solves_linear_equations", test_acceleration)
   end subroutine run_test_radau_matrix

   subroutine linear_evaluate(self, t, y, ydot, status)
      class(linear_t), intent(inout) :: self     !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(in) :: y(self%n)          !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)      !! (n) its derivative [any]
      integer, intent(out) :: status             !! outcome

      ydot = matmul(self%j, y)
      status = merge(0, 1, t < huge(t))
   end subroutine linear_evaluate

   !> A stiff system, and its matrix for steps of 0.1 s.
   subroutine make_matrix(system, matrix)
      type(linear_t), intent(out), target :: system   !! the system
      type(radau_matrix_t), intent(out) :: matrix     !! its matrix, factorised

      type(filter_product_t) :: difference
      integer :: status

      system%n = n
      system%n_position = 2
      system%j(1, 3) = 1.0_wp
      system%j(2, 4) = 1.0_wp
      system%j(3, :) = [-1.0e4_wp, 3.0e3_wp, -2.0_wp, 0.5_wp, 7.0_wp]
      system%j(4, :) = [2.0e3_wp, -50.0_wp, 0.3_wp, -1.0e3_wp, 1.0_wp]
      system%j(5, :) = [1.0_wp, -2.0_wp, 0.1_wp, 4.0_wp, -30.0_wp]
      call difference%open(n, n)
      difference%scale = 1.0_wp
      difference%y = [0.3_wp, -0.2_wp, 0.1_wp, 0.5_wp, -0.4_wp]
      difference%system => system
      call system%evaluate(0.0_wp, difference%y, difference%f, status)
      call matrix%open(system)
      call matrix%renew(system, difference)
      call matrix%factorise(0.1_wp)
   end subroutine make_matrix

   !> The changes D of the stages fulfil D_i - h sum a_ij J D_j = R_i.
   subroutine test_stages(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: change(n, 3), side(n, 3), y(n, 3)
      type(linear_t) :: system
      type(radau_matrix_t) :: matrix
      integer :: i

      call make_matrix(system, matrix)
      call check_true(error, matrix%is_known, "the matrix is known")
      if (allocated(error)) return
      y = 0.0_wp
      side = reshape([(sin(real(i, wp)), i=1, 3*n)], [n, 3])
      call matrix%solve_stages(system, y, side, change)
      call check_close(error, reshape(change - 0.1_wp*matmul(system%j, matmul(change, transpose(a))), [3*n]), &
                       reshape(side, [3*n]), 1.0e-5_wp, "Newton's equations")
   end subroutine test_stages

   !> (I - h J/u) x = b.
   subroutine test_filter(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: b(n) = [1.0_wp, -2.0_wp, 0.5_wp, 3.0_wp, -1.0_wp]
      real(wp) :: x(n)
      type(linear_t) :: system
      type(radau_matrix_t) :: matrix

      call make_matrix(system, matrix)
      call matrix%solve_filter(system, b, b, x)
      call check_close(error, x - 0.1_wp/real_eigenvalue*matmul(system%j, x), b, 1.0e-5_wp, "filter")
   end subroutine test_filter

   !> What a matrix that was saved and loaded does is the same bit for bit.
   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: b(n) = [1.0_wp, -2.0_wp, 0.5_wp, 3.0_wp, -1.0_wp]
      real(wp) :: x(n, 2)
      type(archive_t) :: archive
      type(linear_t) :: system
      type(radau_matrix_t) :: loaded, matrix

      call make_matrix(system, matrix)
      call matrix%save(archive)
      call loaded%open(system)
      call loaded%load(archive)
      call check_true(error, archive%is_at_end(), "as many numbers loaded as saved")
      call loaded%factorise(0.1_wp)
      call matrix%solve_filter(system, b, b, x(:, 1))
      call loaded%solve_filter(system, b, b, x(:, 2))
      call check_true(error, all(abs(x(:, 1) - x(:, 2)) <= 0.0_wp), "the same numbers")
   end subroutine test_memory

   !> x <- x + b - B x with three unknowns, which does not converge by itself: the fourth step ends at the solution.
   subroutine test_acceleration(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: b(3, 3) = reshape([2.2_wp, 0.1_wp, -0.3_wp, 0.4_wp, 0.5_wp, 0.2_wp, 0.0_wp, -0.6_wp, 3.0_wp], [3, 3])
      real(wp), parameter :: solution(3) = [1.0_wp, -2.0_wp, 0.7_wp]
      real(wp) :: f(3), x(3)
      type(anderson_t) :: secants
      integer :: k

      call secants%open(3)
      call secants%begin()
      x = 0.0_wp
      do k = 1, 4
         f = matmul(b, solution - x)
         call secants%improve([1.0_wp, 2.0_wp, 0.5_wp], f)
         x = x + f
      end do
      call check_close(error, x, solution, 1.0e-11_wp, "solution")
   end subroutine test_acceleration

end module test_radau_matrix
