!> Orders of the rows of a sparse symmetric matrix that keep its envelope narrow.
!>
!> Reverse Cuthill-McKee: from a row far from all others, neighbours first, those with few neighbours before those with
!> many, and the whole order reversed. Source: A. George, J. W.-H. Liu, Computer Solution of Large Sparse Positive Definite
!> Systems (1981), chapter 4. Limits: ties are decided by the given order, so that the result is always the same.
module ordering
   implicit none (type, external)
   private
   public :: envelope_of, reverse_cuthill_mckee

contains

   !> Order of the rows; the graph is given by the neighbours of each row.
   subroutine reverse_cuthill_mckee(start, neighbour, order)
      integer, intent(in) :: start(:)                !! (n + 1) place of the first neighbour of each row, then one after the last
      integer, intent(in) :: neighbour(:)            !! (any) neighbours of all rows, itself omitted
      integer, allocatable, intent(out) :: order(:)  !! (n) rows in their new order

      logical, allocatable :: is_placed(:)
      integer :: n, n_placed, row

      n = size(start) - 1
      allocate (order(n), source=0)
      allocate (is_placed(n), source=.false.)
      n_placed = 0
      do row = 1, n
         if (is_placed(row)) cycle
         call place_from(far_row(row))
      end do
      order = order(n:1:-1)

   contains

      !> A row at the far end of what is connected with the given one.
      integer function far_row(seed) result(far)
         integer, intent(in) :: seed  !! where to look from

         integer :: deeper, depth, k, kept

         far = seed
         depth = -1
         do k = 1, 10  ! a few sweeps find an end
            kept = n_placed
            call walk(far, deeper)
            is_placed(order(kept + 1:n_placed)) = .false.
            if (deeper <= depth) exit
            depth = deeper
            far = order(n_placed)
            n_placed = kept
         end do
         n_placed = kept
      end function far_row

      !> Place all rows connected with a row.
      subroutine place_from(seed)
         integer, intent(in) :: seed  !! the first

         integer :: depth

         call walk(seed, depth)
      end subroutine place_from

      !> Breadth first from a row; the rows are placed, and stay marked.
      subroutine walk(seed, depth)
         integer, intent(in) :: seed     !! the first
         integer, intent(out) :: depth   !! levels beyond it

         integer :: first, k, last, level_end

         depth = 0
         n_placed = n_placed + 1
         order(n_placed) = seed
         is_placed(seed) = .true.
         k = n_placed
         level_end = k
         do while (k <= n_placed)
            first = n_placed + 1
            call append_neighbours(order(k))
            last = n_placed
            call sort_by_degree(first, last)
            if (k == level_end .and. n_placed > k) then
               depth = depth + 1
               level_end = n_placed
            end if
            k = k + 1
         end do
      end subroutine walk

      !> Neighbours of a row that are not placed yet.
      subroutine append_neighbours(row)
         integer, intent(in) :: row  !! the row

         integer :: k

         do k = start(row), start(row + 1) - 1
            if (is_placed(neighbour(k))) cycle
            n_placed = n_placed + 1
            order(n_placed) = neighbour(k)
            is_placed(neighbour(k)) = .true.
         end do
      end subroutine append_neighbours

      !> Sort placed rows by how many neighbours they have (insertion: they are few).
      subroutine sort_by_degree(first, last)
         integer, intent(in) :: first  !! first place
         integer, intent(in) :: last   !! last place

         integer :: j, k, moved

         do k = first + 1, last
            moved = order(k)
            j = k - 1
            do while (j >= first)
               if (degree(order(j)) <= degree(moved)) exit
               order(j + 1) = order(j)
               j = j - 1
            end do
            order(j + 1) = moved
         end do
      end subroutine sort_by_degree

      !> How many neighbours a row has.
      integer function degree(row)
         integer, intent(in) :: row  !! the row

         degree = start(row + 1) - start(row)
      end function degree

   end subroutine reverse_cuthill_mckee

   !> First column of each row in an order, and what a factorisation costs: the sum of squares of the widths.
   pure subroutine envelope_of(start, neighbour, order, first, cost)
      integer, intent(in) :: start(:)       !! (n + 1) place of the first neighbour of each row, then one after the last
      integer, intent(in) :: neighbour(:)   !! (any) neighbours of all rows
      integer, intent(in) :: order(:)       !! (n) rows in their order
      integer, intent(out) :: first(:)      !! (n) first column of each place
      real, intent(out) :: cost             !! operations, about [1]

      integer :: k, place(size(order)), row

      place(order) = [(k, k=1, size(order))]
      cost = 0.0
      do k = 1, size(order)
         row = order(k)
         first(k) = min(k, minval(place(neighbour(start(row):start(row + 1) - 1))))
         cost = cost + real(k - first(k) + 1)**2
      end do
   end subroutine envelope_of

end module ordering
