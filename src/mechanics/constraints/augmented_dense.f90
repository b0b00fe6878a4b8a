!> What the solvers that factorise the augmented equations as one full matrix share.
!>
!> Coordinates are scaled with the root of the mass, rows with the root of the diagonal of Phi_q M^-1 Phi_q^T, so that all
!> entries are of order one and a pivot below `threshold` shows a singular matrix:
!>
!> [ I   J^T ] [ M^(1/2) a     ]   [ M^(-1/2) g ]
!> [ J   -d  ] [ D^(1/2) lambda ] = [ D^(-1/2) b ],   J = D^(-1/2) Phi_q M^(-1/2),   d the damping, zero in `solve`.
!>
!> Source: Flores et al. (2008), eq. (2.15). Cost: of order (n_v unknown bodies + rows)^3, n_v rates a body.
module augmented_dense
   use augmented, only: direct_t
   use rows, only: before_side, block_of_side, body_of_side, coordinate_place, rows_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: augmented_dense_t, dense_prepare, threshold

   real(wp), parameter :: threshold = 1.0e-13_wp  !! minimum pivot of the scaled matrix [1]

   !> One full matrix.
   type, abstract, extends(direct_t) :: augmented_dense_t
      integer :: n_coordinate = 0                 !! coordinates of unknown bodies, the first rows of the matrix
      integer, allocatable :: place(:)            !! (0:bodies) place before the coordinates of an unknown body
      real(wp), allocatable :: matrix(:, :)       !! (n, n) scaled augmented matrix, then its factors [1]
      real(wp), allocatable :: x(:)               !! (n) right-hand side and solution [any]
      real(wp), allocatable :: row_scale(:)       !! (solved rows) scales of the rows [any]
   contains
      procedure :: prepare => dense_prepare
      procedure :: solve => dense_solve
      procedure :: factorise => dense_factorise
      procedure :: back_solve => dense_back_solve
      procedure(decompose_interface), deferred :: decompose
      procedure(substitute_interface), deferred :: substitute
   end type augmented_dense_t

   abstract interface
      !> Factorise the matrix in place.
      subroutine decompose_interface(self, bad)
         import :: augmented_dense_t
         implicit none (type, external)
         class(augmented_dense_t), intent(inout) :: self  !! the solver
         integer, intent(out) :: bad                      !! first row with a pivot below the threshold, 0: none
      end subroutine decompose_interface

      !> Solve for the right-hand side in x.
      subroutine substitute_interface(self)
         import :: augmented_dense_t
         implicit none (type, external)
         class(augmented_dense_t), intent(inout) :: self  !! the solver, decomposed
      end subroutine substitute_interface
   end interface

contains

   !> Workspace.
   subroutine dense_prepare(self, n_body, rows)
      class(augmented_dense_t), intent(inout) :: self   !! the solver
      integer, intent(in) :: n_body                     !! number of bodies
      type(rows_t), intent(in) :: rows                  !! rows

      integer :: k, n

      self%n_coordinate = rows%n_v*rows%n_unknown
      n = self%n_coordinate + rows%n_solve
      allocate (self%place(0:n_body), source=0)
      self%place(rows%unknown) = coordinate_place(rows%n_v, [(k, k=1, rows%n_unknown)])
      allocate (self%matrix(n, n), self%x(n), self%row_scale(rows%n_solve), self%residual(rows%n_solve), source=0.0_wp)
   end subroutine dense_prepare

   !> The scaled matrix.
   subroutine assemble(self, inverse_mass, rows, damping)
      class(augmented_dense_t), intent(inout) :: self                !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)        !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                               !! rows
      real(wp), intent(in) :: damping                                !! on the diagonal of the rows [1]

      real(wp) :: diagonal
      integer :: body, i, k, n_v, nq, row, side

      n_v = rows%n_v
      nq = self%n_coordinate
      self%matrix = 0.0_wp
      do i = 1, nq
         self%matrix(i, i) = 1.0_wp
      end do
      do k = 1, rows%n_side
         row = rows%side_row(k)
         side = before_side(n_v, rows%side(k))
         body = body_of_side(rows, rows%side(k))
         i = self%place(body)
         self%matrix(i + 1:i + n_v, nq + row) = rows%jac(side + 1:side + n_v, block_of_side(rows%side(k))) &
                                                *sqrt(inverse_mass(:, body))
      end do
      do row = 1, rows%n_solve
         diagonal = sum(self%matrix(1:nq, nq + row)**2)
         self%row_scale(row) = 1.0_wp
         if (diagonal > 0.0_wp) self%row_scale(row) = 1.0_wp/sqrt(diagonal)
         self%matrix(1:nq, nq + row) = self%matrix(1:nq, nq + row)*self%row_scale(row)
         self%matrix(nq + row, 1:nq) = self%matrix(1:nq, nq + row)
         self%matrix(nq + row, nq + row) = -merge(damping, 1.0_wp, diagonal > 0.0_wp)  ! 1: a row that moves nothing
      end do
   end subroutine assemble

   !> Accelerations and multipliers.
   subroutine dense_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_dense_t), intent(inout) :: self                !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)        !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                               !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)                   !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                       !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: a(:, 0:)                !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)               !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                                !! row that depends on others, 0: none

      integer :: body, i, k, n_v, nq

      n_v = rows%n_v
      nq = self%n_coordinate
      call self%factorise(inverse_mass, rows, 0.0_wp, bad_row)
      if (bad_row > 0) return
      do k = 1, rows%n_unknown
         body = rows%unknown(k)
         i = self%place(body)
         self%x(i + 1:i + n_v) = g(:, body)*sqrt(inverse_mass(:, body))
      end do
      self%x(nq + 1:) = b(:rows%n_solve)*self%row_scale
      call self%substitute()
      do k = 1, rows%n_unknown
         body = rows%unknown(k)
         i = self%place(body)
         a(:, body) = self%x(i + 1:i + n_v)*sqrt(inverse_mass(:, body))
      end do
      lambda(:rows%n_solve) = self%x(nq + 1:)*self%row_scale
   end subroutine dense_solve

   !> Factors of the damped matrix.
   subroutine dense_factorise(self, inverse_mass, rows, damping, bad_row)
      class(augmented_dense_t), intent(inout) :: self                !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)        !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                               !! rows
      real(wp), intent(in) :: damping                                !! on the diagonal of the rows [1]
      integer, intent(out) :: bad_row                                !! row at which there are no factors, 0: none

      integer :: bad

      call assemble(self, inverse_mass, rows, damping)
      call self%decompose(bad)
      self%n_factorisations = self%n_factorisations + 1
      bad_row = 0
      if (bad > 0) bad_row = max(1, bad - self%n_coordinate)
   end subroutine dense_factorise

   !> Solution of (S + damping D) x = r.
   subroutine dense_back_solve(self, x)
      class(augmented_dense_t), intent(inout) :: self   !! the solver, factorised
      real(wp), intent(inout), contiguous :: x(:)       !! (solved rows) r, then x [any]

      integer :: nq

      nq = self%n_coordinate
      self%x(:nq) = 0.0_wp
      self%x(nq + 1:) = -x*self%row_scale
      call self%substitute()
      x = self%x(nq + 1:)*self%row_scale
   end subroutine dense_back_solve

end module augmented_dense
