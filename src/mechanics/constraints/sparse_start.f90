!> Minimum corrections and dependent rows of large scenes, in proportion to their size.
!>
!> The minimum x, measured by x^T W^-1 x with W a diagonal of weights, that changes the rows by r:
!>
!> S lambda = r,   S = Phi_q W Phi_q^T,   x = W Phi_q^T lambda,   Phi_q x = r.
!>
!> S is factorised as L D L^T in its envelope. A row with a pivot that is nothing beside its diagonal depends on those
!> before it in the envelope's order and is set aside: D is zero there, and the combination L^T z = e of rows vanishes,
!> Phi_q^T z = 0. Iterative refinement takes away the round-off that S, which squares the condition of Phi_q, brings in.
!>
!> Source: G. H. Golub, C. F. Van Loan, Matrix Computations, sections 4.2 (semi-definite factors) and 5.6 (minimum
!> norm). Limits: rows that contradict one another are fulfilled as far as they are not set aside, not in least squares; a row
!> is dependent below a pivot of `threshold`, a ratio of lengths of its square root.
module sparse_start
   use augmented_schur, only: assemble
   use body_kernels, only: body_accelerations, row_residuals
   use envelope, only: factorise_semidefinite, solve_factored, vanishing_vector
   use rows, only: list_sides, new_rows, rows_t
   use kinds, only: wp
   use schur_part, only: part_t, prepare_part
   implicit none (type, external)
   private
   public :: new_sparse_start, sparse_start_t

   real(wp), parameter :: threshold = 1.0e-11_wp   !! minimum pivot, as a part of its diagonal [1]
   real(wp), parameter :: negligible = 1.0e-9_wp   !! part of a row in a combination that is round-off [1]
   real(wp), parameter :: stagnant = 0.5_wp        !! ratio of successive residuals that is no progress [1]
   real(wp), parameter :: round_off = 1.0e-16_wp   !! residual that ends refinement, of the maximum right-hand side [1]
   integer, parameter :: n_refinement = 8          !! refinements allowed

   !> Structure of all rows between all bodies, known or not, and the factors of S.
   type :: sparse_start_t
      private
      integer :: n_body = 0                        !! number of bodies
      type(rows_t) :: rows                         !! sides of all rows; their values are elsewhere
      type(part_t) :: part                         !! S, its order and its pairs
      logical, allocatable :: is_dependent(:)      !! (rows) rows set aside, in the order of the envelope
   contains
      procedure, private :: factorise => start_factorise
      procedure :: correct => start_correct
      procedure :: find_dependent => start_find_dependent
   end type sparse_start_t

contains

   !> Structure for all rows of a scene.
   subroutine new_sparse_start(n_body, rows, start)
      integer, intent(in) :: n_body               !! number of bodies
      type(rows_t), intent(in) :: rows            !! rows, of which the bodies are read
      type(sparse_start_t), intent(out) :: start  !! the structure

      start%n_body = n_body
      call new_rows(rows%n, start%rows, rows%n_v, rows%n_block - rows%n)
      start%rows%body = rows%body
      start%rows%owner = rows%owner
      call list_sides(spread(.false., 1, n_body), start%rows)
      call prepare_part(start%rows, spread(.true., 1, rows%n), start%part)
      allocate (start%is_dependent(rows%n), source=.false.)
   end subroutine new_sparse_start

   !> Factors of S at the present Jacobian.
   subroutine start_factorise(self, jac, weight)
      class(sparse_start_t), intent(inout) :: self       !! the structure; its factors are set
      real(wp), intent(in), contiguous :: jac(:, :)      !! (2 n_v, blocks) Phi_q [1 or m]
      real(wp), intent(in), contiguous :: weight(:, 0:)  !! (n_v, 0:bodies) W [any]

      real(wp) :: none(self%rows%n_v, 0:self%n_body), unused(size(self%part%order)), zero(self%rows%n)
      integer :: k

      none = 0.0_wp
      zero = 0.0_wp
      associate (part => self%part)
         do k = 1, part%n_block
            call assemble(k, part, self%n_body, self%rows%n, self%rows%n_block, weight, jac, none, zero, unused)
         end do
         call factorise_semidefinite(threshold, part%s, self%is_dependent)
      end associate
   end subroutine start_factorise

   !> Minimum change x of the coordinates (or rates) with Phi_q x = right.
   subroutine start_correct(self, jac, weight, right, x, rank)
      class(sparse_start_t), intent(inout) :: self       !! the structure
      real(wp), intent(in), contiguous :: jac(:, :)      !! (2 n_v, blocks) Phi_q [1 or m]
      real(wp), intent(in), contiguous :: weight(:, 0:)  !! (n_v, 0:bodies) W, zero for the ground [any]
      real(wp), intent(in), contiguous :: right(:)       !! (rows) what the rows should change by [m or rad, or rates]
      real(wp), intent(out), contiguous :: x(:)          !! (n_v bodies) change [m or rad, or rates]
      integer, intent(out) :: rank                       !! independent rows

      real(wp), dimension(self%rows%n_v, 0:self%n_body) :: change, none, total
      real(wp) :: lambda(self%rows%n), residual(self%rows%n), z(size(self%part%order))
      real(wp) :: before, now
      integer :: k

      call self%factorise(jac, weight)
      rank = count(.not. self%is_dependent)
      none = 0.0_wp
      change = 0.0_wp
      total = 0.0_wp
      residual = -right
      before = huge(1.0_wp)
      associate (part => self%part, rows => self%rows)
         do k = 0, n_refinement
            z = residual(part%order)
            call solve_factored(size(z), size(part%s%a), part%s%first, part%s%start, part%s%a, z)
            lambda(part%order) = z
            call body_accelerations(rows, rows%n_unknown, rows%unknown, self%n_body, weight, jac, none, lambda, change)
            ! the sum of changes is kept, not that of multipliers: large weights would make the round-off of these visible
            change = total + change
            call row_residuals(rows, rows%n, self%n_body, jac, change, right, residual)
            now = maxval(abs(residual))
            if (.not. now < before) exit
            total = change
            if (now <= round_off*maxval(abs(right)) .or. now > stagnant*before) exit
            before = now
         end do
      end associate
      x = reshape(total(:, 1:), [size(x)])
   end subroutine start_correct

   !> Rows that depend on others, and all rows that occur in a combination that vanishes.
   subroutine start_find_dependent(self, jac, weight, scale, share, dependent, shared)
      class(sparse_start_t), intent(inout) :: self       !! the structure
      real(wp), intent(in), contiguous :: jac(:, :)      !! (2 n_v, blocks) Phi_q [1 or m]
      real(wp), intent(in), contiguous :: weight(:, 0:)  !! (n_v, 0:bodies) W, zero for the ground [any]
      real(wp), intent(in) :: scale(:)                   !! (rows) scales that make rows comparable [any]
      real(wp), intent(in) :: share                      !! minimum part of a scaled row in a combination that counts [1]
      integer, allocatable, intent(out) :: dependent(:)  !! (dependent rows) those set aside
      integer, allocatable, intent(out) :: shared(:)     !! (shared rows) those in combinations, rising

      real(wp) :: z(self%rows%n)
      logical :: is_shared(self%rows%n)
      integer :: i, k, lowest

      call self%factorise(jac, weight)
      is_shared = .false.
      z = 0.0_wp
      associate (order => self%part%order)
         dependent = pack(order, self%is_dependent)
         do k = 1, self%rows%n
            if (.not. self%is_dependent(k)) cycle
            call vanishing_vector(self%part%s, k, negligible, z, lowest)
            do i = lowest, k
               if (abs(z(i))*scale(order(k)) > share*scale(order(i))) is_shared(order(i)) = .true.
            end do
            z(lowest:k) = 0.0_wp
         end do
      end associate
      shared = pack([(k, k=1, self%rows%n)], is_shared)
   end subroutine start_find_dependent

end module sparse_start
