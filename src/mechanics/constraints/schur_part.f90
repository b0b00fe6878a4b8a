!> Structure of the Schur complement of some of the rows: their order, the envelope, and the rows that share a body.
!>
!> S = Phi_q M^-1 Phi_q^T. The order is the given one or that of reverse Cuthill-McKee, whichever costs less.
!>
!> Bodies are taken in blocks. After each the first rows of S are complete and can be factorised while they are in the processor's
!> cache: of a long chain, S does not match in it.
module schur_part
   use envelope, only: envelope_t, new_envelope
   use kinds, only: wp
   use ordering, only: envelope_of, reverse_cuthill_mckee
   use rows, only: place_of_side, rows_t
   implicit none (type, external)
   private
   public :: choose_order, part_t, prepare_part

   !> The Schur complement of some of the solved rows, with its structure.
   type :: part_t
      integer :: n_v = 0                          !! rates of a body
      type(envelope_t) :: s                       !! Schur complement, then its factors
      integer, allocatable :: order(:)            !! (its rows) rows in the order of the envelope
      logical :: is_in_order = .false.            !! which is their own
      integer :: n_side = 0                       !! their sides that are unknown bodies
      integer, allocatable :: side(:, :)          !! (2, sides) place in the envelope's order, place in the Jacobian; body by body,
                                                  !! of each in the order of the envelope
      integer :: n_body = 0                       !! bodies with sides
      integer, allocatable :: body(:, :)          !! (2, these bodies) body, its last side
      integer :: n_block = 0                      !! blocks of these bodies
      integer, allocatable :: block(:, :)         !! (3, 0:blocks) last of these bodies, last row that has a side in this block or
                                                  !! one before, last row that is complete after it; of block 0: 0
   end type part_t

   integer, parameter :: block_rows = 96   !! rows that a block completes, at least: some 20 kB of a chain of bodies in space

contains

   !> The order of some of the rows with the narrower envelope.
   subroutine choose_order(rows, is_taken, order, first, cost)
      type(rows_t), intent(in) :: rows                  !! rows, declared
      logical, intent(in) :: is_taken(:)                !! (solved rows) which of them
      integer, allocatable, intent(out) :: order(:)     !! (rows taken) rows in their order
      integer, allocatable, intent(out) :: first(:)     !! (rows taken) first column of each place
      real, intent(out) :: cost                         !! operations of one factorisation, about [1]

      integer, allocatable :: neighbour(:), number(:), other(:), other_first(:), start(:)
      real :: other_cost
      integer :: k

      number = pack([(k, k=1, rows%n_solve)], is_taken)
      call list_neighbours(rows, is_taken, start, neighbour)
      order = [(k, k=1, size(number))]
      first = order
      other_first = order
      call envelope_of(start, neighbour, order, first, cost)
      call reverse_cuthill_mckee(start, neighbour, other)
      call envelope_of(start, neighbour, other, other_first, other_cost)
      if (other_cost < cost) then
         cost = other_cost
         order = other
         first = other_first
      end if
      order = number(order)
   end subroutine choose_order

   !> For each row taken, those that share an unknown body with it, numbered among the rows taken.
   subroutine list_neighbours(rows, is_taken, start, neighbour)
      type(rows_t), intent(in) :: rows                    !! rows, declared
      logical, intent(in) :: is_taken(:)                  !! (solved rows) which of them
      integer, allocatable, intent(out) :: start(:)       !! (rows taken + 1) place of the first neighbour of each row
      integer, allocatable, intent(out) :: neighbour(:)   !! (any) neighbours

      integer :: body, i, j, n, number(rows%n_solve), pass, row

      n = 0
      do row = 1, rows%n_solve
         if (is_taken(row)) n = n + 1
         number(row) = n
      end do
      allocate (start(n + 1), source=0)
      do pass = 1, 2
         do body = 1, ubound(rows%last_side, 1)
            do i = rows%last_side(body - 1) + 1, rows%last_side(body)
               if (.not. is_taken(rows%side_row(i))) cycle
               row = number(rows%side_row(i))
               do j = rows%last_side(body - 1) + 1, rows%last_side(body)
                  if (i == j .or. .not. is_taken(rows%side_row(j))) cycle
                  if (pass == 2) neighbour(start(row)) = number(rows%side_row(j))
                  start(row) = start(row) + 1
               end do
            end do
         end do
         if (pass == 1) then
            ! counts become places
            i = 1
            do row = 1, n + 1
               j = start(row)
               start(row) = i
               i = i + j
            end do
            allocate (neighbour(i - 1), source=0)
         end if
      end do
      ! the second pass has moved each place to that of the next row
      start(2:) = start(:n)
      start(1) = 1
   end subroutine list_neighbours

   !> Order, envelope and sides of some of the rows.
   subroutine prepare_part(rows, is_taken, part)
      type(rows_t), intent(in) :: rows       !! rows, of which the bodies are read
      logical, intent(in) :: is_taken(:)     !! (solved rows) which of them
      type(part_t), intent(inout) :: part    !! their structure

      integer, allocatable :: first(:), place(:)
      real :: cost
      integer :: body, first_side, i, k, line, n_side

      part%n_v = rows%n_v
      call choose_order(rows, is_taken, part%order, first, cost)
      part%is_in_order = all(part%order == [(k, k=1, size(part%order))])
      allocate (place(rows%n_solve), source=0)
      place(part%order) = [(k, k=1, size(part%order))]
      call new_envelope(first, part%s)
      n_side = count([(place(rows%side_row(i)) > 0, i=1, size(rows%side))])
      allocate (part%side(2, n_side), part%body(2, ubound(rows%last_side, 1)), source=0)
      n_side = 0
      do body = 1, ubound(rows%last_side, 1)
         first_side = n_side
         do i = rows%last_side(body - 1) + 1, rows%last_side(body)
            line = place(rows%side_row(i))
            if (line == 0) cycle
            n_side = n_side + 1
            k = n_side
            do while (k > first_side + 1)
               if (part%side(1, k - 1) < line) exit
               part%side(:, k) = part%side(:, k - 1)
               k = k - 1
            end do
            part%side(:, k) = [line, place_of_side(rows%n_v, rows%side(i))]
         end do
         if (n_side == first_side) cycle
         part%n_body = part%n_body + 1
         part%body(:, part%n_body) = [body, n_side]
      end do
      part%n_side = n_side
      part%body = part%body(:, :part%n_body)
      call cut_blocks(part)
   end subroutine prepare_part

   !> Cut the bodies into blocks.
   subroutine cut_blocks(part)
      type(part_t), intent(inout) :: part    !! the structure; its blocks are set

      integer :: block(3, 0:part%n_body + 1), complete, k, last(0:size(part%order)), n, reached, side

      ! the last of the bodies that a row or one before it is tied to
      last = 0
      side = 0
      do k = 1, part%n_body
         do while (side < part%body(2, k))
            side = side + 1
            last(part%side(1, side)) = k
         end do
      end do
      do k = 1, size(part%order)
         last(k) = max(last(k), last(k - 1))
      end do
      n = 0
      block(:, 0) = 0
      complete = 0
      reached = 0
      do k = 1, part%n_body
         reached = max(reached, part%side(1, part%body(2, k)))
         do while (complete < reached)
            if (last(complete + 1) > k) exit
            complete = complete + 1
         end do
         if (complete - block(3, n) < block_rows) cycle
         n = n + 1
         block(:, n) = [k, reached, complete]
      end do
      if (block(3, n) < size(part%order)) then
         n = n + 1
         block(:, n) = [part%n_body, size(part%order), size(part%order)]
      end if
      part%n_block = n
      allocate (part%block(3, 0:n), source=block(:, :n))
   end subroutine cut_blocks

end module schur_part
