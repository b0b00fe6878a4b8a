!> Factorisation within an envelope against LAPACK on full matrices.
module test_envelope
   use check, only: check_close, check_equal, check_true, suite_t
   use envelope, only: envelope_t, factorise_and_solve, new_envelope, solve_factored
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use lapack, only: dgetrf, dgetrs
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_envelope

   real(wp), parameter :: threshold = 1.0e-13_wp  !! minimum pivot, as a part of its diagonal [1]

contains

   subroutine run_test_envelope(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("places", test_places)
      call suite%test("against_lapack", test_against_lapack)
      call suite%test("further_right_hand_sides", test_further)
      call suite%test("product_of_factors", test_product_of_factors)
      call suite%test("dependent_row", test_dependent_row)
      call suite%test("threshold", test_threshold)
      call suite%test("small_sizes", test_small_sizes)
   end subroutine run_test_envelope

   !> Entry (i, j) is at start(i) + j; the entries follow each other without gaps.
   subroutine test_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(envelope_t) :: matrix
      integer :: i, j, k

      call new_envelope([1, 2, 1, 3], matrix)
      call check_equal(error, size(matrix%a), 1 + 1 + 3 + 2, "entries")
      k = 0
      do i = 1, 4
         do j = matrix%first(i), i
            k = k + 1
            call check_equal(error, matrix%start(i) + j, k, "place of "//to_text(i)//", "//to_text(j))
         end do
      end do
      call check_true(error, maxval(abs(matrix%a)) <= 0.0_wp, "all zero")
   end subroutine test_places

   !> A symmetric positive definite matrix with random envelope and entries, full and by its envelope.
   subroutine make_matrix(random, n, matrix, full)
      type(random_t), intent(inout) :: random              !! where numbers come from
      integer, intent(in) :: n                             !! order
      type(envelope_t), intent(out) :: matrix              !! by its envelope
      real(wp), allocatable, intent(out) :: full(:, :)     !! (n, n) the same [1]

      integer :: first(n), i, j

      do i = 1, n
         first(i) = min(i, 1 + int(random%between(0.0_wp, real(i, wp))))
      end do
      call new_envelope(first, matrix)
      allocate (full(n, n), source=0.0_wp)
      do i = 1, n
         do j = first(i), i - 1
            full(i, j) = random%between(-1.0_wp, 1.0_wp)
            full(j, i) = full(i, j)
         end do
      end do
      ! dominated by its diagonal
      do i = 1, n
         full(i, i) = sum(abs(full(i, :))) + random%between(0.01_wp, 1.0_wp)
      end do
      do i = 1, n
         do j = first(i), i
            matrix%a(matrix%start(i) + j) = full(i, j)
         end do
      end do
   end subroutine make_matrix

   !> Factorise in two parts and solve.
   subroutine solve(matrix, x, bad_row)
      type(envelope_t), intent(inout) :: matrix  !! matrix, then its factors
      real(wp), intent(inout) :: x(:)            !! (n) right-hand side, then solution [1]
      integer, intent(out) :: bad_row            !! row with a small pivot

      integer :: half, n

      n = matrix%n
      half = n/2
      call factorise_and_solve(1, half, n, size(matrix%a), matrix%first, matrix%start, threshold, matrix%a, matrix%row, x, &
                               bad_row)
      if (bad_row > 0) return
      call factorise_and_solve(half + 1, n, n, size(matrix%a), matrix%first, matrix%start, threshold, matrix%a, matrix%row, x, &
                               bad_row)
   end subroutine solve

   !> The same solution as the full matrix.
   subroutine test_against_lapack(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(envelope_t) :: matrix
      type(random_t) :: random
      real(wp), allocatable :: b(:, :), full(:, :), x(:)
      integer, allocatable :: pivots(:)
      integer :: attempt, bad_row, info, n

      random%state = 41_i8
      do attempt = 1, 100
         n = 1 + modulo(attempt, 30)
         call make_matrix(random, n, matrix, full)
         x = random%vector(n, -1.0_wp, 1.0_wp)
         b = reshape(x, [n, 1])
         if (allocated(pivots)) deallocate (pivots)
         allocate (pivots(n))
         call solve(matrix, x, bad_row)
         call check_equal(error, bad_row, 0, "bad row")
         call dgetrf(n, n, full, n, pivots, info)
         call dgetrs("N", n, 1, full, n, pivots, b, n, info)
         call check_close(error, x, b(:, 1), 1.0e-12_wp, "solution of order "//to_text(n), relative=.true.)
      end do
   end subroutine test_against_lapack

   !> The factors serve further right-hand sides: A x is what was asked for.
   subroutine test_further(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(envelope_t) :: matrix
      type(random_t) :: random
      real(wp), allocatable :: b(:), full(:, :), x(:)
      integer :: attempt, bad_row, k, n

      random%state = 44_i8
      do attempt = 1, 30
         n = attempt
         call make_matrix(random, n, matrix, full)
         x = random%vector(n, -1.0_wp, 1.0_wp)
         call solve(matrix, x, bad_row)
         do k = 1, 3
            b = random%vector(n, -1.0_wp, 1.0_wp)
            x = b
            call solve_factored(n, size(matrix%a), matrix%first, matrix%start, matrix%a, x)
            call check_close(error, matmul(full, x), b, 1.0e-13_wp, "right-hand side of order "//to_text(n), relative=.true.)
         end do
      end do
   end subroutine test_further

   !> L D L^T is the matrix.
   subroutine test_product_of_factors(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 12
      type(envelope_t) :: matrix
      type(random_t) :: random
      real(wp), allocatable :: full(:, :), x(:)
      real(wp) :: d(n, n), l(n, n)
      integer :: bad_row, i, j

      random%state = 42_i8
      call make_matrix(random, n, matrix, full)
      x = random%vector(n, -1.0_wp, 1.0_wp)
      call solve(matrix, x, bad_row)
      d = 0.0_wp
      l = 0.0_wp
      do i = 1, n
         do j = matrix%first(i), i - 1
            l(i, j) = matrix%a(matrix%start(i) + j)
         end do
         l(i, i) = 1.0_wp
         d(i, i) = 1.0_wp/matrix%a(matrix%start(i) + i)
      end do
      call check_close(error, reshape(matmul(l, matmul(d, transpose(l))), [n*n]), reshape(full, [n*n]), 1.0e-13_wp, "L D L^T")
   end subroutine test_product_of_factors

   !> A row that is a combination of earlier ones is found, wherever it stands; scaling does not hide it.
   subroutine test_dependent_row(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 8, m = 20
      type(envelope_t) :: matrix
      type(random_t) :: random
      real(wp) :: jac(n, m), s(n, n), x(n)
      integer :: bad, bad_row, i, j

      random%state = 43_i8
      do bad = 2, n
         do i = 1, n
            jac(i, :) = random%vector(m, -1.0_wp, 1.0_wp)*10.0_wp**(3 - i)
         end do
         jac(bad, :) = 0.7_wp*jac(1, :) - 5.0_wp*jac(bad - 1, :)
         s = matmul(jac, transpose(jac))
         call new_envelope(spread(1, 1, n), matrix)
         do i = 1, n
            do j = 1, i
               matrix%a(matrix%start(i) + j) = s(i, j)
            end do
         end do
         x = 1.0_wp
         call solve(matrix, x, bad_row)
         call check_equal(error, bad_row, bad, "dependent row")
      end do
   end subroutine test_dependent_row

   !> The pivot is measured against the diagonal it came from: just above the threshold is accepted, just below is not.
   subroutine test_threshold(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: part(4) = [1.0e-3_wp, 1.1e-6_wp, 0.9e-6_wp, -1.0e-3_wp]
      integer, parameter :: expected(4) = [0, 0, 2, 2]
      type(envelope_t) :: matrix
      real(wp) :: x(2)
      integer :: bad_row, k

      do k = 1, 4
         call new_envelope([1, 1], matrix)
         ! pivot of the second row: part times its diagonal of 1000
         matrix%a = [4.0_wp, sqrt(4.0_wp*1000.0_wp*(1.0_wp - part(k))), 1000.0_wp]
         x = 1.0_wp
         call factorise_and_solve(1, 2, 2, 3, matrix%first, matrix%start, 1.0e-6_wp, matrix%a, matrix%row, x, bad_row)
         call check_equal(error, bad_row, expected(k), "bad row, pivot number "//to_text(k))
      end do
   end subroutine test_threshold

   !> Nothing, one row, and one row that is zero.
   subroutine test_small_sizes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(envelope_t) :: matrix
      real(wp) :: none(0), x(1)
      integer :: bad_row
      integer, allocatable :: first(:)

      allocate (first(0))
      call new_envelope(first, matrix)
      call solve(matrix, none, bad_row)
      call check_equal(error, bad_row, 0, "no rows")
      call new_envelope([1], matrix)
      matrix%a = 4.0_wp
      x = 2.0_wp
      call solve(matrix, x, bad_row)
      call check_equal(error, bad_row, 0, "one row")
      call check_close(error, x(1), 0.5_wp, 0.0_wp, "one row")
      matrix%a = 0.0_wp
      call solve(matrix, x, bad_row)
      call check_equal(error, bad_row, 1, "a zero")
   end subroutine test_small_sizes

end module test_envelope
