!> Augmented equations by the Schur complement of the mass matrix, as in the analytic inverse of the book.
!>
!> S = Phi_q M^-1 Phi_q^T,   S lambda = Phi_q M^-1 g - b,   a = M^-1 (g - Phi_q^T lambda)
!>
!> S is assembled from a list of pairs of rows that share an unknown body, made once, and factorised as L D L^T in its
!> envelope; the order of the rows is the given one or that of reverse Cuthill-McKee, whichever costs less. A chain of
!> bodies costs in proportion to its length.
!> Source: Flores et al. (2008), eqs. (2.16)-(2.18). Limits: independent rows; a pivot below `min_pivot` of its diagonal
!> is left to `solve_damped`.
module augmented_schur
   use augmented, only: direct_t, min_pivots
   use body_kernels, only: body_accelerations
   use body_kernels_planar, only: solve_planar => solve_lone_bodies
   use body_kernels_spatial, only: solve_spatial => solve_lone_bodies
   use envelope, only: factorise_and_solve, solve_factored
   use rows, only: n_v_planar, rows_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use lone_bodies, only: find_lone_bodies, lone_t
   use matrix_kernels_planar, only: assemble_planar => assemble_schur
   use matrix_kernels_spatial, only: assemble_spatial => assemble_schur
   use schur_part, only: choose_order, part_t, prepare_part
   implicit none (type, external)
   private
   public :: assemble, augmented_schur_t, schur_is_cheap

   real, parameter :: sparse_cost = 120.0        !! operations that the sparse solver costs for a row or coordinate, measured
   real, parameter :: few = 10.0                 !! how many times that the pairs of a row may cost

   !> All solved rows for damped solutions; for others those of bodies that are not lone.
   type, extends(direct_t) :: augmented_schur_t
      type(lone_t) :: lone                        !! bodies solved in closed form
      type(part_t) :: rest                        !! the other rows
      type(part_t) :: all                         !! all rows
      integer, allocatable :: unknown(:)          !! (bodies) unknown bodies that are not lone
      real(wp), allocatable :: x(:)               !! (rows) values in the order of an envelope [any]
      real(wp) :: min_pivot = min_pivots(1)   !! of its diagonal: below, rows are nearly dependent [1]
   contains
      procedure, nopass :: info => schur_info
      procedure :: prepare => schur_prepare
      procedure :: solve => schur_solve
      procedure :: factorise => schur_factorise
      procedure :: back_solve => schur_back_solve
      procedure :: set_min_pivot => schur_set_min_pivot
   end type augmented_schur_t

contains

   !> Description of the solver.
   function schur_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "schur"
      info%help = "complement, in its envelope"
      info%source = "Flores et al. (2008), eqs. (2.16)-(2.18)"
   end function schur_info

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
      is_cheap = cost + real(rows%n_v)*pairs <= sparse_cost*real(rows%n_solve + rows%n_v*rows%n_unknown)
   end function schur_is_cheap

   !> Lone bodies, and the structure of the rest and of all.
   subroutine schur_prepare(self, n_body, rows)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                    !! number of bodies
      type(rows_t), intent(in) :: rows                 !! rows, of which the bodies are read

      logical :: is_lone(n_body), is_taken(rows%n_solve)
      integer :: k, n

      self%tests_pivots = .true.
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
      allocate (self%residual(rows%n_solve), self%x(rows%n), source=0.0_wp)
   end subroutine schur_prepare

   !> Take the minimum pivot of independent rows.
   subroutine schur_set_min_pivot(self, minimum)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      real(wp), intent(in) :: minimum                    !! of the diagonal it came from [1]

      self%min_pivot = minimum
   end subroutine schur_set_min_pivot

   !> Accelerations and multipliers.
   subroutine schur_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_schur_t), intent(inout) :: self              !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)      !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                             !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)                 !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: a(:, 0:)              !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)             !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                              !! row that depends on others, or nearly so, 0: none

      integer :: n_body

      n_body = size(g, 2) - 1
      if (rows%n_solve > 0) self%n_factorisations = self%n_factorisations + 1
      if (rows%n_v == n_v_planar) then
         call solve_planar(self%lone%n, self%lone%body, self%lone%row, self%lone%place, n_body, rows%n, rows%n_block, &
                           inverse_mass, rows%jac, g, b, self%min_pivot, a, lambda, bad_row)
      else
         call solve_spatial(self%lone%n, self%lone%body, self%lone%row, self%lone%place, n_body, rows%n, rows%n_block, &
                            inverse_mass, rows%jac, g, b, self%min_pivot, a, lambda, bad_row)
      end if
      if (bad_row > 0 .or. size(self%unknown) == 0) return
      if (self%rest%is_in_order) then
         call take_blocks(self%rest, n_body, rows%n, rows%n_block, inverse_mass, rows%jac, g, b, self%min_pivot, lambda, bad_row)
      else
         call take_blocks(self%rest, n_body, rows%n, rows%n_block, inverse_mass, rows%jac, g, b, self%min_pivot, self%x, bad_row)
         if (bad_row == 0) call in_given_order(size(self%rest%order), self%rest%order, rows%n, self%x, lambda)
      end if
      if (bad_row > 0) return
      call body_accelerations(rows, size(self%unknown), self%unknown, n_body, inverse_mass, rows%jac, g, lambda, a)
   end subroutine schur_solve

   !> Assemble and factorise a part block by block, and solve.
   pure subroutine take_blocks(part, n_body, n_row, n_block, inverse_mass, jac, g, b, min_pivot, x, bad_row)
      type(part_t), intent(inout) :: part                       !! the part; S is set
      integer, intent(in) :: n_body                             !! number of bodies
      integer, intent(in) :: n_row                              !! number of rows
      integer, intent(in) :: n_block                            !! number of blocks of Phi_q
      real(wp), intent(in) :: inverse_mass(part%n_v, 0:n_body)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      real(wp), intent(in) :: jac(2*part%n_v*n_block)           !! (2 n_v blocks) Phi_q, block by block [1 or m]
      real(wp), intent(in) :: g(part%n_v, 0:n_body)             !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in) :: b(n_row)                          !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(in) :: min_pivot                       !! of its diagonal: below, rows are nearly dependent [1]
      real(wp), intent(inout) :: x(n_row)                       !! (rows) multipliers, set in the order of the envelope [N or N.m]
      integer, intent(out) :: bad_row                           !! row that depends on others, or nearly so, 0: none

      integer :: k

      do k = 1, part%n_block
         call assemble(k, part, n_body, n_row, n_block, inverse_mass, jac, g, b, x)
         call factorise_and_solve(part%block(3, k - 1) + 1, part%block(3, k), size(part%order), size(part%s%a), part%s%first, &
                                  part%s%start, min_pivot, part%s%a, part%s%row, x, bad_row)
         if (bad_row > 0) then
            bad_row = part%order(bad_row)
            return
         end if
      end do
   end subroutine take_blocks

   !> Factors of S with its diagonal raised.
   subroutine schur_factorise(self, inverse_mass, rows, damping, bad_row)
      class(augmented_schur_t), intent(inout) :: self  !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)      !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                 !! rows
      real(wp), intent(in) :: damping                  !! added to the diagonal, of its entries [1]
      integer, intent(out) :: bad_row                  !! row at which there are no factors all the same, 0: none

      integer :: k

      associate (part => self%all)
         self%residual = 0.0_wp
         do k = 1, part%n_block
            call assemble(k, part, ubound(inverse_mass, 2), rows%n, rows%n_block, inverse_mass, rows%jac, 0.0_wp*inverse_mass, &
                          self%residual, self%x)
         end do
         do k = 1, size(part%order)
            associate (diagonal => part%s%a(part%s%start(k) + k))
               diagonal = diagonal*(1.0_wp + damping)
               if (.not. diagonal > 0.0_wp) diagonal = 1.0_wp  ! a row between prescribed bodies
            end associate
         end do
         call factorise_and_solve(1, size(part%order), size(part%order), size(part%s%a), part%s%first, part%s%start, 0.0_wp, &
                                  part%s%a, part%s%row, self%x, bad_row)
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
            self%x(k) = x(part%order(k))
         end do
         call solve_factored(size(part%order), size(part%s%a), part%s%first, part%s%start, part%s%a, self%x)
         call in_given_order(size(part%order), part%order, size(x), self%x, x)
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

   !> What a block of bodies gives to the Schur complement of a part, and to the right-hand side of its multipliers.
   pure subroutine assemble(block, part, n_body, n_row, n_block, inverse_mass, jac, g, b, x)
      integer, intent(in) :: block                         !! which of the blocks; they are taken in their order
      type(part_t), intent(inout) :: part                  !! the part; S is set
      integer, intent(in) :: n_body                        !! number of bodies
      integer, intent(in) :: n_row                         !! number of rows
      integer, intent(in) :: n_block                       !! number of blocks of Phi_q
      real(wp), intent(in) :: inverse_mass(part%n_v, 0:n_body)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      real(wp), intent(in) :: jac(2*part%n_v*n_block)  !! (2 n_v blocks) Phi_q, block by block [1 or m]
      real(wp), intent(in) :: g(part%n_v, 0:n_body)    !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in) :: b(n_row)                     !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout) :: x(size(part%order))       !! (its rows) right-hand side, envelope's order [m/s^2 or rad/s^2]

      if (part%n_v == n_v_planar) then
         call assemble_planar(block, part, n_body, n_row, n_block, inverse_mass, jac, g, b, x)
      else
         call assemble_spatial(block, part, n_body, n_row, n_block, inverse_mass, jac, g, b, x)
      end if
   end subroutine assemble

end module augmented_schur
