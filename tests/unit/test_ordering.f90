!> Reverse Cuthill-McKee on graphs whose narrowest envelopes are known.
module test_ordering
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use ordering, only: envelope_of, reverse_cuthill_mckee
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_ordering

contains

   subroutine run_test_ordering(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("chain", test_chain)
      call suite%test("ring", test_ring)
      call suite%test("grid", test_grid)
      call suite%test("star", test_star)
      call suite%test("pieces", test_pieces)
      call suite%test("small_sizes", test_small_sizes)
      call suite%test("envelope", test_envelope_of_rows)
   end subroutine run_test_ordering

   !> The lists of neighbours of a graph that is given by its edges.
   subroutine list_edges(n, edge, start, neighbour)
      integer, intent(in) :: n                            !! rows
      integer, intent(in) :: edge(:, :)                   !! (2, edges) rows that are neighbours
      integer, allocatable, intent(out) :: start(:)       !! (n + 1) place of the first neighbour of each row
      integer, allocatable, intent(out) :: neighbour(:)   !! (2 edges) neighbours

      integer :: k, row

      allocate (start(n + 1), source=1)
      allocate (neighbour(0))
      do row = 1, n
         start(row) = size(neighbour) + 1
         do k = 1, size(edge, 2)
            if (edge(1, k) == row) neighbour = [neighbour, edge(2, k)]
            if (edge(2, k) == row) neighbour = [neighbour, edge(1, k)]
         end do
      end do
      start(n + 1) = size(neighbour) + 1
   end subroutine list_edges

   !> The numbers 1 to n, shuffled.
   subroutine shuffle(random, n, order)
      type(random_t), intent(inout) :: random         !! where numbers come from
      integer, intent(in) :: n                        !! how many
      integer, allocatable, intent(out) :: order(:)   !! (n) the numbers

      integer :: k, other

      order = [(k, k=1, n)]
      do k = n, 2, -1
         other = min(k, 1 + int(random%between(0.0_wp, real(k, wp))))
         order([k, other]) = order([other, k])
      end do
   end subroutine shuffle

   !> The order of a graph, checked to hold each row once and to be the same every time.
   subroutine find_order(error, n, edge, order)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      integer, intent(in) :: n                            !! rows
      integer, intent(in) :: edge(:, :)                   !! (2, edges) rows that are neighbours
      integer, allocatable, intent(out) :: order(:)       !! (n) the order

      integer, allocatable :: again(:), neighbour(:), start(:)
      integer :: k
      logical :: is_there(n)

      call list_edges(n, edge, start, neighbour)
      call reverse_cuthill_mckee(start, neighbour, order)
      call check_equal(error, size(order), n, "rows placed")
      if (allocated(error)) return
      is_there = .false.
      do k = 1, n
         call check_true(error, order(k) >= 1 .and. order(k) <= n, "a row's number")
         if (.not. allocated(error)) is_there(order(k)) = .true.
      end do
      call check_true(error, all(is_there), "each row is placed once")
      call reverse_cuthill_mckee(start, neighbour, again)
      call check_true(error, all(again == order), "the same order again")
   end subroutine find_order

   !> Maximum distance of neighbours in an order, and the sum over all rows of the distance to the first neighbour.
   subroutine measure(edge, order, bandwidth, profile)
      integer, intent(in) :: edge(:, :)     !! (2, edges) rows that are neighbours
      integer, intent(in) :: order(:)       !! (n) rows in their order
      integer, intent(out) :: bandwidth     !! maximum distance
      integer, intent(out) :: profile       !! entries of the envelope left of the diagonal

      integer :: first(size(order)), k, place(size(order))

      place(order) = [(k, k=1, size(order))]
      first = [(k, k=1, size(order))]
      bandwidth = 0
      do k = 1, size(edge, 2)
         associate (a => minval(place(edge(:, k))), b => maxval(place(edge(:, k))))
            bandwidth = max(bandwidth, b - a)
            first(b) = min(first(b), a)
         end associate
      end do
      profile = sum([(k - first(k), k=1, size(order))])
   end subroutine measure

   !> A chain in any order of its rows is laid out from end to end.
   subroutine test_chain(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(random_t) :: random
      integer, allocatable :: edge(:, :), name(:), order(:)
      integer :: attempt, bandwidth, k, n, profile

      random%state = 61_i8
      do attempt = 1, 40
         n = attempt + 1
         call shuffle(random, n, name)
         edge = reshape([(name(k:k + 1), k=1, n - 1)], [2, n - 1])
         call find_order(error, n, edge, order)
         if (allocated(error)) return
         call measure(edge, order, bandwidth, profile)
         call check_equal(error, bandwidth, 1, "bandwidth of a chain of "//to_text(n))
      end do
   end subroutine test_chain

   !> A ring cannot be narrower than two.
   subroutine test_ring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(random_t) :: random
      integer, allocatable :: edge(:, :), name(:), order(:)
      integer :: attempt, bandwidth, k, n, profile

      random%state = 62_i8
      do attempt = 1, 20
         n = attempt + 3
         call shuffle(random, n, name)
         edge = reshape([(name(k), name(modulo(k, n) + 1), k=1, n)], [2, n])
         call find_order(error, n, edge, order)
         if (allocated(error)) return
         call measure(edge, order, bandwidth, profile)
         call check_equal(error, bandwidth, 2, "bandwidth of a ring of "//to_text(n))
      end do
   end subroutine test_ring

   !> A shuffled grid of m by n: its natural order, along the short side, has an envelope of m entries a row.
   subroutine test_grid(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: m = 6, n = 20
      type(random_t) :: random
      integer, allocatable :: edge(:, :), name(:), order(:)
      integer :: attempt, bandwidth, i, j, k, natural, profile

      random%state = 63_i8
      do attempt = 1, 10
         call shuffle(random, m*n, name)
         allocate (edge(2, m*(n - 1) + n*(m - 1)), source=0)
         k = 0
         do j = 0, n - 1
            do i = 1, m
               if (i < m) then
                  k = k + 1
                  edge(:, k) = name(m*j + [i, i + 1])
               end if
               if (j < n - 1) then
                  k = k + 1
                  edge(:, k) = name(m*j + [i, i + m])
               end if
            end do
         end do
         call check_equal(error, k, size(edge, 2), "edges")
         call find_order(error, m*n, edge, order)
         if (allocated(error)) return
         call measure(edge, name, bandwidth, natural)
         call check_equal(error, bandwidth, m, "bandwidth of the natural order")
         call measure(edge, order, bandwidth, profile)
         call check_true(error, bandwidth <= m + 1, "bandwidth of the grid is that of a diagonal")
         call check_true(error, real(profile) <= 1.1*real(natural), "envelope of the grid is near that of the natural order")
         deallocate (edge)
      end do
   end subroutine test_grid

   !> The middle of a star comes after all leaves but one at most: the envelope has one entry for each edge, no more.
   subroutine test_star(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(random_t) :: random
      integer, allocatable :: edge(:, :), name(:), order(:)
      integer :: bandwidth, k, n, profile

      random%state = 64_i8
      do n = 3, 30
         call shuffle(random, n, name)
         edge = reshape([(name(1), name(k), k=2, n)], [2, n - 1])
         call find_order(error, n, edge, order)
         if (allocated(error)) return
         call measure(edge, order, bandwidth, profile)
         call check_equal(error, profile, n - 1, "envelope of a star of "//to_text(n))
      end do
   end subroutine test_star

   !> What is not connected stays together and does not widen the rest: two chains, a lone row, a ring, all mixed up.
   subroutine test_pieces(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 26
      type(random_t) :: random
      integer, allocatable :: edge(:, :), name(:), order(:)
      integer :: attempt, bandwidth, k, place(n), profile

      random%state = 65_i8
      do attempt = 1, 20
         call shuffle(random, n, name)
         ! rows 1 to 8 and 9 to 16 are chains, 17 is alone, 18 to 26 are a ring
         edge = reshape([(name([k, k + 1]), k=1, 7), (name([k, k + 1]), k=9, 15), (name([k, k + 1]), k=18, 25), &
                         name([26, 18])], [2, 23])
         call find_order(error, n, edge, order)
         if (allocated(error)) return
         call measure(edge, order, bandwidth, profile)
         call check_equal(error, bandwidth, 2, "bandwidth, that of the ring")
         call check_equal(error, profile, 7 + 7 + 1 + 2*7, "envelope, the sum of those of the pieces")
         place(order) = [(k, k=1, n)]
         call check_equal(error, maxval(place(name(1:8))) - minval(place(name(1:8))), 7, "a chain stays together")
      end do
   end subroutine test_pieces

   !> No rows, and rows without neighbours, which stay in a fixed order.
   subroutine test_small_sizes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, allocatable :: order(:)
      integer :: edge(2, 0)

      call find_order(error, 0, edge, order)
      call find_order(error, 1, edge, order)
      call find_order(error, 5, edge, order)
   end subroutine test_small_sizes

   !> First columns and cost of an order, by hand: edges 1-3, 3-4, 2-5 in the order 2, 5, 4, 1, 3.
   subroutine test_envelope_of_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, allocatable :: neighbour(:), start(:)
      integer, parameter :: expected(5) = [1, 1, 3, 4, 3]
      integer :: first(5), k
      real :: cost

      call list_edges(5, reshape([1, 3, 3, 4, 2, 5], [2, 3]), start, neighbour)
      call envelope_of(start, neighbour, [2, 5, 4, 1, 3], first, cost)
      do k = 1, 5
         call check_equal(error, first(k), expected(k), "first column of place "//to_text(k))
      end do
      call check_close(error, real(cost, wp), 1.0_wp + 4.0_wp + 1.0_wp + 1.0_wp + 9.0_wp, 0.0_wp, "squares of the widths")
   end subroutine test_envelope_of_rows

end module test_ordering
