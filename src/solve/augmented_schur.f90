!> Augmented equations by the Schur complement of the mass matrix, as in the analytic inverse of the book.
!>
!> S = Phi_q M^-1 Phi_q^T,   S lambda = Phi_q M^-1 g - b,   a = M^-1 (g - Phi_q^T lambda)
!>
!> S is assembled from a list of pairs of rows that share an unknown body, made once, and factorised as L D L^T in its
!> envelope; the order of the rows is the given one or that of reverse Cuthill-McKee, whichever costs less. A chain of
!> bodies costs in proportion to its length.
!> Source: Flores et al. (2008), eqs. (2.16)-(2.18). Limits: independent rows; a pivot below `threshold` of its diagonal
!> is left to `solve_damped`.
module augmented_schur
   use augmented, only: body_accelerations, direct_t
   use envelope, only: envelope_t, factorise_and_solve, new_envelope, solve_factored
   use rows, only: rows_t
   use kinds, only: wp
   use lone_bodies, only: find_lone_bodies, lone_t, solve_lone_bodies
   use ordering, only: envelope_of, reverse_cuthill_mckee
   implicit none (type, external)
   private
   public :: augmented_schur_t, schur_is_cheap
   public :: assemble, part_t, prepare_part

   real(wp), parameter :: threshold = 1.0e-5_wp  !! least pivot, as a part of its diagonal: below, rows are nearly dependent [1]

   real, parameter :: sparse_cost = 120.0        !! operations that the sparse solver costs for a row or coordinate, measured
   real, parameter :: few = 10.0                 !! how many times that the pairs of a row may cost

   !> The Schur complement of some of the solved rows, with its structure.
   type :: part_t
      type(envelope_t) :: s                       !! Schur complement, then its factors
      integer, allocatable :: order(:)            !! (its rows) rows in the order of the envelope
      integer :: n_side = 0                       !! their sides that are unknown bodies
      integer, allocatable :: side(:, :)          !! (2, sides) place in the envelope's order, place in the Jacobian; body by body
      integer :: n_pair = 0                       !! pairs of sides that share a body
      integer, allocatable :: pair(:, :)          !! (3, pairs) entry of Phi_q M^-1 of the body, entry of Phi_q, place in S
      integer :: n_body = 0                       !! bodies with sides
      integer, allocatable :: body(:, :)          !! (3, these bodies) body, its last side, its last pair
      real(wp), allocatable :: jac_m(:)           !! (3 most sides of a body) Phi_q M^-1 of one body [any]
      real(wp), allocatable :: x(:)               !! (its rows) right-hand side and solution, in the order of the envelope [any]
   end type part_t

   !> All solved rows for damped solutions; for others those of bodies that are not lone.
   type, extends(direct_t) :: augmented_schur_t
      type(lone_t) :: lone                        !! bodies solved in closed form
      type(part_t) :: rest                        !! the other rows
      type(part_t) :: all                         !! all rows
      integer, allocatable :: unknown(:)          !! (bodies) unknown bodies that are not lone
   contains
      procedure, nopass :: name => schur_name
      procedure :: prepare => schur_prepare
      procedure :: solve => schur_solve
      procedure :: factorise => schur_factorise
      procedure :: back_solve => schur_back_solve
   end type augmented_schur_t

contains

   !> The word for it in a deck.
   function schur_name() result(name)
      character(:), allocatable :: name  !! as in `solver = name`

      name = "schur"
   end function schur_name

   !> Whether the Schur complement costs less than a sparse factorisation of the whole matrix would.
   logical function schur_is_cheap(rows) result(is_cheap)
      type(rows_t), intent(in) :: rows  !! rows, declared

      integer, allocatable :: first(:), order(:)
      real :: cost, pairs
      integer :: body

      pairs = 0.0
      do body = 1, ubound(rows%last_side, 1)
         pairs = pairs + 0.5*real(rows%last_side(body) - rows%last_side(body - 1))**2
      end do
      is_cheap = pairs < few*sparse_cost*real(rows%n_solve + 1)  ! else the pairs alone are too many to list
      if (.not. is_cheap) return
      call choose_order(rows, spread(.true., 1, rows%n_solve), order, first, cost)
      is_cheap = cost + 3.0*pairs <= sparse_cost*real(rows%n_solve + 3*rows%n_unknown)
   end function schur_is_cheap

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
               if (.not. is_taken(rows%side(1, i))) cycle
               row = number(rows%side(1, i))
               do j = rows%last_side(body - 1) + 1, rows%last_side(body)
                  if (i == j .or. .not. is_taken(rows%side(1, j))) cycle
                  if (pass == 2) neighbour(start(row)) = number(rows%side(1, j))
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

   !> Lone bodies, and the structure of the rest and of all.
   subroutine schur_prepare(self, n_body, rows)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                    !! number of bodies
      type(rows_t), intent(in) :: rows                 !! rows, of which the bodies are read

      logical :: is_lone(n_body), is_taken(rows%n_solve)
      integer :: k, n

      call find_lone_bodies(rows, self%lone)
      n = sum(self%lone%n)
      is_lone = .false.
      is_lone(self%lone%body) = .true.
      is_taken = .true.
      do k = 1, n
         is_taken(pack(self%lone%row(:, k), self%lone%row(:, k) > 0)) = .false.
      end do
      self%unknown = pack(rows%unknown, .not. is_lone(rows%unknown))
      call prepare_part(rows, is_taken, self%rest)
      is_taken = .true.
      call prepare_part(rows, is_taken, self%all)
      allocate (self%residual(rows%n_solve), source=0.0_wp)
   end subroutine schur_prepare

   !> Order, envelope, sides and pairs of some of the rows.
   subroutine prepare_part(rows, is_taken, part)
      type(rows_t), intent(in) :: rows       !! rows, of which the bodies are read
      logical, intent(in) :: is_taken(:)     !! (solved rows) which of them
      type(part_t), intent(inout) :: part    !! their structure

      integer, allocatable :: first(:), place(:)
      real :: cost
      integer :: body, column, first_side, i, j, k, line, most, pass

      call choose_order(rows, is_taken, part%order, first, cost)
      allocate (place(rows%n_solve), source=0)
      place(part%order) = [(k, k=1, size(part%order))]
      call new_envelope(first, part%s)
      do pass = 1, 2
         part%n_side = 0
         part%n_pair = 0
         part%n_body = 0
         most = 0
         do body = 1, ubound(rows%last_side, 1)
            first_side = part%n_side
            do i = rows%last_side(body - 1) + 1, rows%last_side(body)
               line = place(rows%side(1, i))
               if (line == 0) cycle
               part%n_side = part%n_side + 1
               if (pass == 2) part%side(:, part%n_side) = [line, rows%side(2, i)]
               do j = rows%last_side(body - 1) + 1, rows%last_side(body)
                  column = place(rows%side(1, j))
                  if (column > line .or. column == 0) cycle
                  part%n_pair = part%n_pair + 1
                  if (pass == 2) part%pair(:, part%n_pair) = [3*(part%n_side - first_side) - 2, rows%side(2, j) + 1, &
                                                              part%s%start(line) + column]
               end do
            end do
            if (part%n_side == first_side) cycle
            most = max(most, part%n_side - first_side)
            part%n_body = part%n_body + 1
            if (pass == 2) part%body(:, part%n_body) = [body, part%n_side, part%n_pair]
         end do
         if (pass == 1) allocate (part%side(2, part%n_side), part%pair(3, part%n_pair), part%body(3, part%n_body), source=0)
      end do
      allocate (part%jac_m(3*most), source=0.0_wp)
      allocate (part%x(size(part%order)), source=0.0_wp)
   end subroutine prepare_part

   !> Accelerations and multipliers.
   subroutine schur_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_schur_t), intent(inout) :: self              !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)      !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                             !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)                 !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in), contiguous :: b(:)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: a(:, 0:)              !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)             !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                              !! row that depends on others, or nearly so, 0: none

      integer :: n_body

      n_body = size(g, 2) - 1
      if (rows%n_solve > 0) self%n_factorisations = self%n_factorisations + 1
      call solve_lone_bodies(self%lone%n, self%lone%body, self%lone%row, self%lone%place, n_body, rows%n, inverse_mass, &
                             rows%jac, g, b, threshold, a, lambda, bad_row)
      if (bad_row > 0 .or. size(self%unknown) == 0) return
      associate (part => self%rest)
         if (size(part%order) > 0) then
            call assemble(part, n_body, rows%n, inverse_mass, rows%jac, g, b)
            call factorise_and_solve(size(part%order), size(part%s%a), part%s%first, part%s%start, threshold, part%s%a, &
                                     part%s%inverse, part%s%row, part%x, bad_row)
            if (bad_row > 0) then
               bad_row = part%order(bad_row)
               return
            end if
            call in_given_order(size(part%order), part%order, rows%n, part%x, lambda)
         end if
      end associate
      call body_accelerations(n_body, rows%n, size(self%unknown), self%unknown, rows%n_side, rows%side, rows%last_side, &
                              inverse_mass, rows%jac, g, lambda, a)
   end subroutine schur_solve

   !> Factors of S with its diagonal raised.
   subroutine schur_factorise(self, inverse_mass, rows, damping, bad_row)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)      !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                 !! rows
      real(wp), intent(in) :: damping                  !! added to the diagonal, of its entries [1]
      integer, intent(out) :: bad_row                  !! row at which there are no factors all the same, 0: none

      integer :: k

      associate (part => self%all)
         self%residual = 0.0_wp
         call assemble(part, ubound(inverse_mass, 2), rows%n, inverse_mass, rows%jac, 0.0_wp*inverse_mass, self%residual)
         do k = 1, size(part%order)
            associate (diagonal => part%s%a(part%s%start(k) + k))
               diagonal = diagonal*(1.0_wp + damping)
               if (.not. diagonal > 0.0_wp) diagonal = 1.0_wp  ! a row between known bodies
            end associate
         end do
         call factorise_and_solve(size(part%order), size(part%s%a), part%s%first, part%s%start, 0.0_wp, part%s%a, &
                                  part%s%inverse, part%s%row, part%x, bad_row)
         if (bad_row > 0) bad_row = part%order(bad_row)
      end associate
      self%n_factorisations = self%n_factorisations + 1
   end subroutine schur_factorise

   !> Solution with these factors.
   subroutine schur_back_solve(self, x)
      class(augmented_schur_t), intent(inout) :: self  !! the solver, factorised
      real(wp), intent(inout), contiguous :: x(:)      !! (solved rows) right-hand side, then solution [any]

      integer :: k

      associate (part => self%all)
         do k = 1, size(part%order)
            part%x(k) = x(part%order(k))
         end do
         call solve_factored(size(part%x), size(part%s%a), part%s%first, part%s%start, part%s%a, part%s%inverse, part%x)
         call in_given_order(size(part%x), part%order, size(x), part%x, x)
      end associate
   end subroutine schur_back_solve

   !> Values of the envelope's order in the rows' own.
   pure subroutine in_given_order(n, order, n_row, x, lambda)
      integer, intent(in) :: n                 !! rows of the envelope
      integer, intent(in) :: order(n)          !! (n) rows in its order
      integer, intent(in) :: n_row             !! number of rows
      real(wp), intent(in) :: x(n)             !! (n) values in that order [any]
      real(wp), intent(inout) :: lambda(n_row) !! (rows) the same by row [any]

      integer :: k

      !GCC$ novector
      do k = 1, n
         lambda(order(k)) = x(k)
      end do
   end subroutine in_given_order

   !> The Schur complement of a part, and the right-hand side of its multipliers.
   pure subroutine assemble(part, n_body, n_row, inverse_mass, jac, g, b)
      type(part_t), intent(inout) :: part                  !! the part; S and x are set
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)    !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: jac(6*n_row)                 !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: g(3, 0:n_body)               !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: b(n_row)                     !! (rows) right-hand side [m/s^2 or rad/s^2]

      call multiply_sides(n_body, n_row, size(part%order), part%order, part%n_body, part%body, part%n_side, part%side, &
                          part%n_pair, part%pair, size(part%s%a), inverse_mass, jac, g, b, size(part%jac_m), part%jac_m, &
                          part%s%a, part%x)
   end subroutine assemble

   !> The same on plain arrays, body by body: its sides in Phi_q M^-1, then their pairs from the list.
   pure subroutine multiply_sides(n_body, n_row, n, order, n_own, own, n_side, side, n_pair, pair, n_entry, inverse_mass, jac, &
                                  g, b, n_scratch, jac_m, s, x)
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      integer, intent(in) :: n                             !! rows of the envelope
      integer, intent(in) :: order(n)                      !! (n) rows in its order
      integer, intent(in) :: n_own                         !! bodies with sides
      integer, intent(in) :: own(3, n_own)                 !! (3, these bodies) body, its last side, its last pair
      integer, intent(in) :: n_side                        !! sides of these rows that are unknown bodies
      integer, intent(in) :: side(2, n_side)               !! (2, sides) place in the envelope's order, place in the Jacobian
      integer, intent(in) :: n_pair                        !! pairs of row sides that share a body
      integer, intent(in) :: pair(3, n_pair)               !! (3, pairs) entry of Phi_q M^-1, entry of Phi_q, place in S
      integer, intent(in) :: n_entry                       !! entries of the envelope
      real(wp), intent(in) :: inverse_mass(3, 0:n_body)    !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), intent(in) :: jac(6*n_row)                 !! (6 rows) Phi_q, row by row [1 or m]
      real(wp), intent(in) :: g(3, 0:n_body)               !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in) :: b(n_row)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      integer, intent(in) :: n_scratch                     !! entries of the next
      real(wp), intent(inout) :: jac_m(n_scratch)          !! (3 most sides of a body) scratch: Phi_q M^-1 of one body [any]
      real(wp), intent(out) :: s(n_entry)                  !! (entries) Schur complement [any]
      real(wp), intent(out) :: x(n)                        !! (n) right-hand side, envelope's order [m/s^2 or rad/s^2]

      real(wp) :: g_1, g_2, g_3, m_1, m_2, m_3
      integer :: body, c, d, from, i, k, place, row

      !GCC$ novector
      do k = 1, n
         x(k) = -b(order(k))
      end do
      !GCC$ novector
      do k = 1, n_entry
         s(k) = 0.0_wp
      end do
      i = 0
      k = 0
      do from = 1, n_own
         body = own(1, from)
         m_1 = inverse_mass(1, body)
         m_2 = inverse_mass(2, body)
         m_3 = inverse_mass(3, body)
         g_1 = g(1, body)
         g_2 = g(2, body)
         g_3 = g(3, body)
         c = 1
         do while (i < own(2, from))
            i = i + 1
            row = side(1, i)
            place = side(2, i)
            jac_m(c) = jac(place + 1)*m_1
            jac_m(c + 1) = jac(place + 2)*m_2
            jac_m(c + 2) = jac(place + 3)*m_3
            x(row) = x(row) + (jac_m(c)*g_1 + jac_m(c + 1)*g_2 + jac_m(c + 2)*g_3)
            c = c + 3
         end do
         do while (k < own(3, from))
            k = k + 1
            c = pair(1, k)
            d = pair(2, k)
            place = pair(3, k)
            s(place) = s(place) + (jac_m(c)*jac(d) + jac_m(c + 1)*jac(d + 1) + jac_m(c + 2)*jac(d + 2))
         end do
      end do
   end subroutine multiply_sides

end module augmented_schur
