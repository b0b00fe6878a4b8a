!> Factorisation A = L D L^T of a symmetric positive definite matrix stored by its envelope.
!>
!> Row i keeps its entries from column `first(i)` to the diagonal, one after the other; the factor
!> fills exactly that envelope. Pivots are tested against the diagonal they came from: a pivot
!> smaller than `threshold` times that means that the row depends on earlier ones. Such rows end a factorisation, or are
!> set aside: then one over D is zero there, L z = 0 on all others gives the combination of rows that vanishes, and a solution has
!> zeros there.
!> Source: A. Jennings, A compact storage scheme for the solution of symmetric linear simultaneous
!> equations, Comput. J. 9 (1966) 281-285. Limits: no pivoting, so positive (semi-)definite only.
module envelope
   use kinds, only: wp
   use lapack, only: ddot
   implicit none (type, external)
   private
   public :: envelope_t, factorise_and_solve, factorise_semidefinite, new_envelope, solve_factored, vanishing_vector

   !> A symmetric matrix or its factors, in an envelope that is fixed at set-up.
   type :: envelope_t
      integer :: n = 0                        !! order
      integer, allocatable :: first(:)        !! (n) first column of each row
      integer, allocatable :: start(:)        !! (n) place of entry (i, j) is start(i) + j
      real(wp), allocatable :: a(:)           !! (entries) matrix, then L with one over D in the place of its unit diagonal [any]
      real(wp), allocatable :: row(:)         !! (n) scratch [any]
   end type envelope_t

contains

   !> Storage for a matrix with the given envelope.
   subroutine new_envelope(first, matrix)
      integer, intent(in) :: first(:)           !! (n) first column of each row
      type(envelope_t), intent(out) :: matrix   !! the matrix, zero

      integer :: entries, i

      matrix%n = size(first)
      allocate (matrix%first(matrix%n), matrix%start(matrix%n))
      entries = 0
      do i = 1, matrix%n
         matrix%first(i) = first(i)
         matrix%start(i) = entries - first(i) + 1
         entries = entries + i - first(i) + 1
      end do
      allocate (matrix%a(entries), matrix%row(matrix%n), source=0.0_wp)
   end subroutine new_envelope

   !> Factorise some rows in place after those before them; after the last row, solve for one right-hand side. The factors can serve
   !> further ones. The loops are short: they are kept from being vectorised.
   pure subroutine factorise_and_solve(from, to, n, n_entry, first, start, threshold, a, row, x, bad_row)
      integer, intent(in) :: from                 !! the first of the rows
      integer, intent(in) :: to                   !! the last of them
      integer, intent(in) :: n                    !! order
      integer, intent(in) :: n_entry              !! entries of the envelope
      integer, intent(in) :: first(n)             !! (n) first column of each row
      integer, intent(in) :: start(n)             !! (n) place of entry (i, j) is start(i) + j
      real(wp), intent(in) :: threshold           !! minimum pivot, as a part of the diagonal it came from [1]
      real(wp), intent(inout) :: a(n_entry)       !! (entries) matrix, then its factors [any]
      real(wp), intent(inout) :: row(n)           !! (n) scratch [any]
      real(wp), intent(inout) :: x(n)             !! (n) right-hand side, then z of L D z = b, then solution [any]
      integer, intent(out) :: bad_row             !! first row with a small pivot, 0: none

      real(wp) :: factor, pivot, right, sum
      integer :: i, j, k, first_i, start_i, start_j

      bad_row = 0
      do i = from, to
         start_i = start(i)
         first_i = first(i)
         pivot = a(start_i + i)
         right = x(i)
         !GCC$ novector
         do j = first_i, i - 1
            start_j = start(j)
            sum = a(start_i + j)
            !GCC$ novector
            do k = max(first_i, first(j)), j - 1
               sum = sum - row(k - first_i + 1)*a(start_j + k)
            end do
            row(j - first_i + 1) = sum  ! L(i,j) D(j)
            factor = sum*a(start_j + j)
            a(start_i + j) = factor
            pivot = pivot - sum*factor
            right = right - sum*x(j)
         end do
         if (.not. pivot > threshold*a(start_i + i)) then
            bad_row = i
            return
         end if
         a(start_i + i) = 1.0_wp/pivot
         x(i) = right*a(start_i + i)
      end do
      if (to == n) call solve_upper(n, n_entry, first, start, a, x)
   end subroutine factorise_and_solve

   !> Factorise a semi-definite matrix in place; rows that depend on earlier ones are set aside.
   pure subroutine factorise_semidefinite(threshold, matrix, is_dependent)
      real(wp), intent(in) :: threshold          !! minimum pivot, as a part of the diagonal it came from [1]
      type(envelope_t), intent(inout) :: matrix  !! the matrix, then its factors, for `solve_factored`
      logical, intent(out) :: is_dependent(:)    !! (n) rows set aside

      real(wp) :: factor, pivot, sum
      integer :: from, i, j

      associate (a => matrix%a, first => matrix%first, start => matrix%start, row => matrix%row)
         do i = 1, matrix%n
            pivot = a(start(i) + i)
            do j = first(i), i - 1
               from = max(first(i), first(j))
               sum = a(start(i) + j)
               if (from < j) sum = sum - ddot(j - from, row(from:), 1, a(start(j) + from:), 1)
               row(j) = sum  ! L(i,j) D(j)
               factor = sum*a(start(j) + j)
               a(start(i) + j) = factor
               pivot = pivot - sum*factor
            end do
            is_dependent(i) = .not. pivot > threshold*a(start(i) + i)
            a(start(i) + i) = 0.0_wp
            if (.not. is_dependent(i)) a(start(i) + i) = 1.0_wp/pivot
         end do
      end associate
   end subroutine factorise_semidefinite

   !> The combination of rows that vanishes because a row was set aside, A z = 0 with z = 1 there.
   pure subroutine vanishing_vector(matrix, dependent, negligible, z, lowest)
      type(envelope_t), intent(in) :: matrix     !! factors of `factorise_semidefinite`
      integer, intent(in) :: dependent           !! the row that was set aside
      real(wp), intent(in) :: negligible         !! entries of at most this size are taken as zero [1]
      real(wp), intent(inout) :: z(:)            !! (n) zero; then the combination in places `lowest` to `dependent` [1]
      integer, intent(out) :: lowest             !! first place that can be other than zero

      integer :: i, j

      lowest = dependent
      z(dependent) = 1.0_wp
      i = dependent
      do while (i >= lowest)
         if (abs(z(i)) > negligible) then
            do j = matrix%first(i), i - 1
               z(j) = z(j) - matrix%a(matrix%start(i) + j)*z(i)
            end do
            lowest = min(lowest, matrix%first(i))
         else
            z(i) = 0.0_wp
         end if
         i = i - 1
      end do
   end subroutine vanishing_vector

   !> Solve for one more right-hand side with the factors of `factorise_and_solve`.
   pure subroutine solve_factored(n, n_entry, first, start, a, x)
      integer, intent(in) :: n                    !! order
      integer, intent(in) :: n_entry              !! entries of the envelope
      integer, intent(in) :: first(n)             !! (n) first column of each row
      integer, intent(in) :: start(n)             !! (n) place of entry (i, j) is start(i) + j
      real(wp), intent(in) :: a(n_entry)          !! (entries) factors [any]
      real(wp), intent(inout) :: x(n)             !! (n) right-hand side, then solution [any]

      integer :: i, j

      do i = 1, n
         !GCC$ novector
         do j = first(i), i - 1
            x(i) = x(i) - a(start(i) + j)*x(j)
         end do
      end do
      do i = 1, n
         x(i) = x(i)*a(start(i) + i)
      end do
      call solve_upper(n, n_entry, first, start, a, x)
   end subroutine solve_factored

   !> The last part of a solution, L^T x = z.
   pure subroutine solve_upper(n, n_entry, first, start, a, x)
      integer, intent(in) :: n                    !! order
      integer, intent(in) :: n_entry              !! entries of the envelope
      integer, intent(in) :: first(n)             !! (n) first column of each row
      integer, intent(in) :: start(n)             !! (n) place of entry (i, j) is start(i) + j
      real(wp), intent(in) :: a(n_entry)          !! (entries) factors [any]
      real(wp), intent(inout) :: x(n)             !! (n) z, then x [any]

      real(wp) :: value
      integer :: i, j

      do i = n, 1, -1
         value = x(i)
         !GCC$ novector
         do j = first(i), i - 1
            x(j) = x(j) - a(start(i) + j)*value
         end do
      end do
   end subroutine solve_upper

end module envelope
