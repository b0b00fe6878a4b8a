!> Augmented equations as one full matrix, LU with partial pivoting by LAPACK: the reference path.
!>
!> Coordinates are scaled with the root of the mass, rows with the root of J M^-1 J^T, so that all
!> entries are of order one and a pivot below `threshold` shows a singular matrix.
!> Source: Flores et al. (2008), eq. (2.15). Cost: of order (3 bodies + rows)^3.
module augmented_lapack
   use augmented, only: augmented_t
   use joint_set, only: rows_t
   use kinds, only: wp
   use lapack, only: dgetrf, dgetrs
   implicit none (type, external)
   private
   public :: augmented_lapack_t

   real(wp), parameter :: threshold = 1.0e-13_wp  !! least pivot of the scaled matrix [1]

   !> Full matrix with partial pivoting.
   type, extends(augmented_t) :: augmented_lapack_t
      integer :: n_body = 0                       !! number of bodies
      real(wp), allocatable :: matrix(:, :)       !! (n, n) scaled augmented matrix [1]
      real(wp), allocatable :: x(:, :)            !! (n, 1) right-hand side and solution [any]
      real(wp), allocatable :: row_scale(:)       !! (rows) scales of the rows [any]
      integer, allocatable :: pivots(:)           !! (n) row exchanges
   contains
      procedure, nopass :: name => lapack_name
      procedure :: prepare => lapack_prepare
      procedure :: solve => lapack_solve
   end type augmented_lapack_t

contains

   !> The word for it in a deck.
   function lapack_name() result(name)
      character(:), allocatable :: name  !! as in `solver = name`

      name = "lapack"
   end function lapack_name

   !> Workspace.
   subroutine lapack_prepare(self, n_body, rows)
      class(augmented_lapack_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                     !! number of bodies
      type(rows_t), intent(in) :: rows                  !! rows

      integer :: n

      n = 3*n_body + rows%n
      self%n_body = n_body
      allocate (self%matrix(n, n), self%x(n, 1), self%row_scale(rows%n), source=0.0_wp)
      allocate (self%pivots(n), source=0)
   end subroutine lapack_prepare

   !> Accelerations and multipliers.
   subroutine lapack_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_lapack_t), intent(inout) :: self  !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)        !! (3, 0:bodies) inverse masses [1/kg, 1/kg, 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                  !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)                   !! (3, 0:bodies) applied loads [N, N, N.m]
      real(wp), intent(in), contiguous :: b(:)                      !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(out), contiguous :: a(:, 0:)                  !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), intent(out), contiguous :: lambda(:)                !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                   !! row at which the system is singular, 0: none

      real(wp) :: entry, scale
      integer :: body, i, info, k, n, nq, row, side

      nq = 3*self%n_body
      n = nq + rows%n
      self%matrix = 0.0_wp
      do body = 1, self%n_body
         do k = 1, 3
            i = 3*(body - 1) + k
            self%matrix(i, i) = 1.0_wp
            self%x(i, 1) = g(k, body)*sqrt(inverse_mass(k, body))
         end do
      end do
      do row = 1, rows%n
         scale = 0.0_wp
         do side = 1, 2
            body = rows%body(side, row)
            if (body == 0) cycle
            do k = 1, 3
               entry = rows%jac(3*(side - 1) + k, row)*sqrt(inverse_mass(k, body))
               i = 3*(body - 1) + k
               self%matrix(i, nq + row) = self%matrix(i, nq + row) + entry
            end do
         end do
         do i = 1, nq
            scale = scale + self%matrix(i, nq + row)**2
         end do
         scale = 1.0_wp/sqrt(max(scale, tiny(1.0_wp)))
         self%row_scale(row) = scale
         self%matrix(1:nq, nq + row) = self%matrix(1:nq, nq + row)*scale
         do i = 1, nq
            self%matrix(nq + row, i) = self%matrix(i, nq + row)
         end do
         self%x(nq + row, 1) = b(row)*scale
      end do
      call dgetrf(n, n, self%matrix, n, self%pivots, info)
      self%n_factorisations = self%n_factorisations + 1
      bad_row = 0
      do i = n, 1, -1
         if (.not. abs(self%matrix(i, i)) > threshold) bad_row = max(1, i - nq)
      end do
      if (bad_row > 0) return
      call dgetrs("N", n, 1, self%matrix, n, self%pivots, self%x, n, info)
      a(:, 0) = 0.0_wp
      do body = 1, self%n_body
         do k = 1, 3
            a(k, body) = self%x(3*(body - 1) + k, 1)*sqrt(inverse_mass(k, body))
         end do
      end do
      lambda = self%x(nq + 1:n, 1)*self%row_scale
   end subroutine lapack_solve

end module augmented_lapack
