!> Columns of a sparse matrix that may be found by one difference: no two of a colour have an entry in the same row.
!>
!> Source: A. R. Curtis, M. J. D. Powell and J. K. Reid, On the estimation of sparse Jacobian matrices, J. Inst. Maths Applics 13
!> (1974) 117-119; columns are taken in their order. Limits: at least as many colours as the fullest row has entries.
module colouring
   implicit none (type, external)
   private
   public :: colour_columns

contains

   !> Give each of the first columns a colour.
   subroutine colour_columns(n, n_row, column, row, first, order)
      integer, intent(in) :: n                          !! columns to colour
      integer, intent(in) :: n_row                      !! rows of the matrix
      integer, intent(in) :: column(:)                  !! (>= n + 1) place of the first entry of each column, from 0
      integer, intent(in) :: row(:)                     !! (entries) rows, from 0
      integer, allocatable, intent(out) :: first(:)     !! (colours + 1) place in `order` of the first column of each colour
      integer, allocatable, intent(out) :: order(:)     !! (n) columns, colour by colour

      integer, allocatable :: colour(:), entry(:), last(:), seen(:)
      integer :: i, j, k, n_colour, other

      ! the matrix by rows: columns of row i stand in entry(last(i - 1) + 1:last(i))
      allocate (last(0:n_row), entry(column(n + 1)), source=0)
      do k = 1, column(n + 1)
         last(row(k) + 1) = last(row(k) + 1) + 1
      end do
      do i = 1, n_row
         last(i) = last(i - 1) + last(i)
      end do
      do j = n, 1, -1
         do k = column(j) + 1, column(j + 1)
            entry(last(row(k) + 1)) = j
            last(row(k) + 1) = last(row(k) + 1) - 1
         end do
      end do
      do i = 0, n_row - 1  ! the loop above has moved each entry to the end of the row before
         last(i) = last(i + 1)
      end do
      last(n_row) = column(n + 1)
      allocate (colour(n), seen(n), source=0)
      n_colour = 0
      do j = 1, n
         do k = column(j) + 1, column(j + 1)
            do i = last(row(k)) + 1, last(row(k) + 1)
               other = colour(entry(i))
               if (other > 0) seen(other) = j
            end do
         end do
         do other = 1, n_colour
            if (seen(other) /= j) exit
         end do
         colour(j) = other
         n_colour = max(n_colour, other)
      end do
      allocate (first(n_colour + 1), order(n), source=0)
      do j = 1, n
         first(colour(j)) = first(colour(j)) + 1
      end do
      do k = 2, n_colour + 1
         first(k) = first(k) + first(k - 1)
      end do
      do j = n, 1, -1
         order(first(colour(j))) = j
         first(colour(j)) = first(colour(j)) - 1
      end do
      first = first + 1
   end subroutine colour_columns

end module colouring
