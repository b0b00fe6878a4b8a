!> Sparse LU against LAPACK on full matrices: fresh values in an old structure, pivots that become bad, singular matrices.
module test_klu
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use klu, only: sparse_lu_t
   use lapack, only: dgetrf, dgetrs
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_klu

contains

   subroutine run_test_klu(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("against_lapack", test_against_lapack)
      call suite%test("fresh_values", test_fresh_values)
      call suite%test("pivots_are_renewed", test_pivots_are_renewed)
      call suite%test("singular", test_singular)
      call suite%test("after_a_singular_matrix", test_after_a_singular_matrix)
      call suite%test("many_matrices", test_many_matrices)
   end subroutine run_test_klu

   !> The structure of a full matrix: its entries that are not zero.
   subroutine take_structure(full, matrix)
      real(wp), intent(in) :: full(:, :)          !! (n, n) the matrix [1]
      type(sparse_lu_t), intent(inout) :: matrix  !! fresh; structure and values are set, and analysed

      integer :: i, j, n, place

      n = size(full, 1)
      matrix%n = n
      allocate (matrix%column(n + 1), matrix%row(count(abs(full) > 0.0_wp)))
      allocate (matrix%a(size(matrix%row)), source=0.0_wp)
      place = 0
      do j = 1, n
         matrix%column(j) = place
         do i = 1, n
            if (.not. abs(full(i, j)) > 0.0_wp) cycle
            place = place + 1
            matrix%row(place) = i - 1
            matrix%a(place) = full(i, j)
         end do
      end do
      matrix%column(n + 1) = place
      call matrix%analyse()
   end subroutine take_structure

   !> Other values in the same structure.
   subroutine take_values(full, matrix)
      real(wp), intent(in) :: full(:, :)          !! (n, n) the matrix; zero outside the structure [1]
      type(sparse_lu_t), intent(inout) :: matrix  !! values are set

      integer :: j, k

      do j = 1, matrix%n
         do k = matrix%column(j) + 1, matrix%column(j + 1)
            matrix%a(k) = full(matrix%row(k) + 1, j)
         end do
      end do
   end subroutine take_values

   !> Factorise, and compare a solution with LAPACK's.
   subroutine check_solution(error, full, matrix, x, tolerance, what)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      real(wp), intent(in) :: full(:, :)                  !! (n, n) the matrix [1]
      type(sparse_lu_t), intent(inout) :: matrix          !! the same, not factorised
      real(wp), intent(in) :: x(:)                        !! (n) right-hand side [1]
      real(wp), intent(in) :: tolerance                   !! relative [1]
      character(*), intent(in) :: what                    !! what it is

      real(wp) :: a(size(x), size(x)), b(size(x), 1), y(size(x))
      integer :: bad, info, n, pivots(size(x))

      if (allocated(error)) return
      n = size(x)
      call matrix%factorise(bad)
      call check_equal(error, bad, 0, what//": singular column")
      if (allocated(error)) return
      y = x
      call matrix%solve(y)
      a = full
      b(:, 1) = x
      call dgetrf(n, n, a, n, pivots, info)
      call dgetrs("N", n, 1, a, n, pivots, b, n, info)
      call check_close(error, y, b(:, 1), tolerance, what, relative=.true.)
   end subroutine check_solution

   !> A random matrix with about three entries a column beside its diagonal, which is large.
   function sparse_matrix(random, n) result(full)
      type(random_t), intent(inout) :: random  !! where numbers come from
      integer, intent(in) :: n                 !! order
      real(wp) :: full(n, n)                   !! (n, n) the matrix [1]

      integer :: i, j, k

      full = 0.0_wp
      do j = 1, n
         do k = 1, 3
            i = min(n, 1 + int(random%between(0.0_wp, real(n, wp))))
            full(i, j) = random%between(-1.0_wp, 1.0_wp)
         end do
         full(j, j) = random%between(3.0_wp, 5.0_wp)
      end do
   end function sparse_matrix

   !> Random sparse matrices of all sizes.
   subroutine test_against_lapack(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(random_t) :: random
      integer :: n

      random%state = 71_i8
      do n = 1, 60
         call one_size()
      end do

   contains

      !> One matrix.
      subroutine one_size()
         type(sparse_lu_t) :: matrix
         real(wp) :: full(n, n)

         full = sparse_matrix(random, n)
         call take_structure(full, matrix)
         call check_solution(error, full, matrix, random%vector(n, -1.0_wp, 1.0_wp), 1.0e-13_wp, "order "//to_text(n))
      end subroutine one_size

   end subroutine test_against_lapack

   !> The structure is analysed once; values change again and again, also in sign and by orders of magnitude.
   subroutine test_fresh_values(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 30
      type(random_t) :: random
      type(sparse_lu_t) :: matrix
      real(wp) :: full(n, n), structure(n, n)
      integer :: attempt, j

      random%state = 72_i8
      structure = sparse_matrix(random, n)
      call take_structure(structure, matrix)
      do attempt = 1, 50
         do j = 1, n
            full(:, j) = structure(:, j)*random%vector(n, -1.0_wp, 1.0_wp)*10.0_wp**random%vector(n, -1.0_wp, 1.0_wp)
         end do
         call take_values(full, matrix)
         call check_solution(error, full, matrix, random%vector(n, -1.0_wp, 1.0_wp), 1.0e-8_wp, "values "//to_text(attempt))
      end do
   end subroutine test_fresh_values

   !> The pivots chosen first become small by any power of ten, or zero, while the matrix stays well-conditioned:
   !> [ p 1 0; 1 0 1; 0 1 q ] with p = q = 1 at first.
   subroutine test_pivots_are_renewed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: power

      do power = 1, 20
         call one_pivot(10.0_wp**(-power))
      end do
      call one_pivot(0.0_wp)

   contains

      !> Fresh factors, then small pivots, then the first values again.
      subroutine one_pivot(p)
         real(wp), intent(in) :: p  !! what the pivot becomes [1]

         type(sparse_lu_t) :: matrix
         real(wp) :: first(3, 3), full(3, 3)

         first = reshape([1.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, 0.5_wp, 1.0_wp, 0.0_wp, 1.0_wp, 1.0_wp], [3, 3])
         full = first
         full(1, 1) = p
         call take_structure(first, matrix)
         call check_solution(error, first, matrix, [1.0_wp, -2.0_wp, 0.7_wp], 1.0e-14_wp, "at first")
         call take_values(full, matrix)
         call check_solution(error, full, matrix, [1.0_wp, -2.0_wp, 0.7_wp], 1.0e-8_wp, "pivot of "//to_text(p))
         call take_values(first, matrix)
         call check_solution(error, first, matrix, [1.0_wp, -2.0_wp, 0.7_wp], 1.0e-8_wp, "the first values again")
      end subroutine one_pivot

   end subroutine test_pivots_are_renewed

   !> A column of zeros, and columns that depend on one another, are found; factors made before do not hide them.
   subroutine test_singular(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 12
      type(random_t) :: random
      real(wp) :: full(n, n), good(n, n)
      integer :: column

      random%state = 73_i8
      good = sparse_matrix(random, n)
      do column = 1, n
         full = good
         full(:, column) = 0.0_wp
         call check_singular("zero column "//to_text(column))
         ! both columns have the structure of both
         full = good
         associate (other => modulo(column, n) + 1)
            good(:, column) = good(:, column) + 1.0e-3_wp*merge(1.0_wp, 0.0_wp, abs(good(:, other)) > 0.0_wp)
            full(:, column) = 2.0_wp*good(:, other)
         end associate
         call check_singular("double column "//to_text(column))
         good = sparse_matrix(random, n)
      end do

   contains

      !> By itself, and after good values.
      subroutine check_singular(what)
         character(*), intent(in) :: what  !! what it is

         type(sparse_lu_t) :: after, alone
         integer :: bad

         if (allocated(error)) return
         call take_structure(good, alone)
         call take_values(full, alone)
         call alone%factorise(bad)
         call check_true(error, bad > 0 .and. bad <= n, what//" is singular")
         call take_structure(good, after)
         call after%factorise(bad)
         call check_equal(error, bad, 0, "the matrix before "//what)
         call take_values(full, after)
         call after%factorise(bad)
         call check_true(error, bad > 0 .and. bad <= n, what//" is singular after a regular one")
      end subroutine check_singular

   end subroutine test_singular

   !> After a singular matrix a regular one is solved as if nothing had been.
   subroutine test_after_a_singular_matrix(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 9
      type(random_t) :: random
      type(sparse_lu_t) :: matrix
      real(wp) :: full(n, n)
      integer :: bad, k

      random%state = 74_i8
      full = sparse_matrix(random, n)
      call take_structure(full, matrix)
      do k = 1, 4
         call take_values(0.0_wp*full, matrix)
         call matrix%factorise(bad)
         call check_true(error, bad > 0, "zero is singular")
         call take_values(full, matrix)
         call check_solution(error, full, matrix, random%vector(n, -1.0_wp, 1.0_wp), 1.0e-13_wp, "after that")
      end do
   end subroutine test_after_a_singular_matrix

   !> Matrices come and go; what is left of them does not grow (the checks of addresses would report a freed one used again).
   subroutine test_many_matrices(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 40
      type(random_t) :: random
      real(wp) :: full(n, n)
      integer :: before, k

      random%state = 75_i8
      full = sparse_matrix(random, n)
      do k = 1, 200
         call come_and_go()
      end do
      before = resident_pages()
      do k = 1, 2000
         call come_and_go()
      end do
      call check_true(error, resident_pages() - before < 200, "2000 matrices of 40 rows leave less than 200 pages behind")

   contains

      !> One matrix, analysed, factorised twice and left.
      subroutine come_and_go()
         type(sparse_lu_t) :: matrix
         integer :: bad

         call take_structure(full, matrix)
         call matrix%factorise(bad)
         call check_equal(error, bad, 0, "regular")
         call matrix%factorise(bad)
         call check_equal(error, bad, 0, "regular again")
      end subroutine come_and_go

      !> Pages of this process in memory.
      integer function resident_pages() result(n_page)
         integer(i8) :: n_all   ! with a sanitizer more than an integer has
         integer :: unit

         open (newunit=unit, file="/proc/self/statm", action="read", status="old")
         read (unit, *) n_all, n_page
         close (unit)
      end function resident_pages

   end subroutine test_many_matrices

end module test_klu
