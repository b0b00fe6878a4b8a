!> Factorisation A = L D L^T of a symmetric positive definite matrix stored by its envelope.
!>
!> Row i keeps its entries from column `first(i)` to the diagonal, one after the other; the factor
!> fills exactly that envelope. Pivots are tested against the diagonal they came from: a pivot
!> smaller than `threshold` times that means that the row depends on earlier ones.
!> Source: A. Jennings, A compact storage scheme for the solution of symmetric linear simultaneous
!> equations, Comput. J. 9 (1966) 281-285. Limits: no pivoting, so positive definite only.
module envelope
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: envelope_t, factorise, new_envelope, solve

   !> A symmetric matrix or its factors, in an envelope that is fixed at set-up.
   type :: envelope_t
      integer :: n = 0                        !! order
      integer, allocatable :: first(:)        !! (n) first column of each row
      integer, allocatable :: start(:)        !! (n) place of entry (i, j) is start(i) + j
      real(wp), allocatable :: a(:)           !! (entries) matrix, then L without its unit diagonal, D on the diagonal [any]
      real(wp), allocatable :: inverse(:)     !! (n) one over D [any]
      real(wp), allocatable :: row(:)         !! (n) scratch [any]
   end type envelope_t

contains

   !> Room for a matrix with the given envelope.
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
      allocate (matrix%a(entries), matrix%inverse(matrix%n), matrix%row(matrix%n), source=0.0_wp)
   end subroutine new_envelope

   !> Factorise in place.
   pure subroutine factorise(matrix, threshold, bad_row)
      type(envelope_t), intent(inout) :: matrix  !! matrix, then its factors
      real(wp), intent(in) :: threshold          !! least pivot, as a part of the diagonal it came from [1]
      integer, intent(out) :: bad_row            !! first row with a small pivot, 0: none

      real(wp) :: diagonal, pivot, sum
      integer :: i, j, k, start_i, start_j

      bad_row = 0
      do i = 1, matrix%n
         start_i = matrix%start(i)
         diagonal = matrix%a(start_i + i)
         pivot = diagonal
         do j = matrix%first(i), i - 1
            start_j = matrix%start(j)
            sum = matrix%a(start_i + j)
            do k = max(matrix%first(i), matrix%first(j)), j - 1
               sum = sum - matrix%row(k)*matrix%a(start_j + k)
            end do
            matrix%row(j) = sum
         end do
         ! row(j) is L(i,j) D(j) now
         do j = matrix%first(i), i - 1
            matrix%a(start_i + j) = matrix%row(j)*matrix%inverse(j)
            pivot = pivot - matrix%row(j)*matrix%a(start_i + j)
         end do
         if (.not. pivot > threshold*diagonal) then
            bad_row = i
            return
         end if
         matrix%a(start_i + i) = pivot
         matrix%inverse(i) = 1.0_wp/pivot
      end do
   end subroutine factorise

   !> Solve with the factors.
   pure subroutine solve(matrix, x)
      type(envelope_t), intent(in) :: matrix  !! factors
      real(wp), intent(inout) :: x(:)         !! (n) right-hand side, then solution [any]

      real(wp) :: sum
      integer :: i, k, start

      do i = 1, matrix%n
         start = matrix%start(i)
         sum = x(i)
         do k = matrix%first(i), i - 1
            sum = sum - matrix%a(start + k)*x(k)
         end do
         x(i) = sum
      end do
      do i = 1, matrix%n
         x(i) = x(i)*matrix%inverse(i)
      end do
      do i = matrix%n, 1, -1
         start = matrix%start(i)
         sum = x(i)
         do k = matrix%first(i), i - 1
            x(k) = x(k) - matrix%a(start + k)*sum
         end do
      end do
   end subroutine solve

end module envelope
