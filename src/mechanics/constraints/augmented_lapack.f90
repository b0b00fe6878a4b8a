!> Augmented equations as one full matrix, LU with partial pivoting by LAPACK: the reference path.
!>
!> Source: Flores et al. (2008), eq. (2.15); LAPACK dgetrf, dgetrs.
module augmented_lapack
   use augmented_dense, only: augmented_dense_t, dense_prepare, threshold
   use rows, only: rows_t
   use lapack, only: dgetrf, dgetrs
   use kind_info, only: kind_info_t
   implicit none (type, external)
   private
   public :: augmented_lapack_t

   !> Full matrix with partial pivoting.
   type, extends(augmented_dense_t) :: augmented_lapack_t
      integer, allocatable :: pivots(:)  !! (n) row exchanges
   contains
      procedure, nopass :: info => lapack_info
      procedure :: prepare => lapack_prepare
      procedure :: decompose => lapack_decompose
      procedure :: substitute => lapack_substitute
   end type augmented_lapack_t

contains

   !> Description of the solver.
   function lapack_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "lapack"
      info%help = "full matrix, partial pivoting"
      info%source = "Flores et al. (2008), eq. (2.15); LAPACK dgetrf, dgetrs"
   end function lapack_info

   !> Workspace.
   subroutine lapack_prepare(self, n_body, rows)
      class(augmented_lapack_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                     !! number of bodies
      type(rows_t), intent(in) :: rows                  !! rows

      call dense_prepare(self, n_body, rows)
      allocate (self%pivots(size(self%x)), source=0)
   end subroutine lapack_prepare

   !> Factorise the matrix in place.
   subroutine lapack_decompose(self, bad)
      class(augmented_lapack_t), intent(inout) :: self  !! the solver
      integer, intent(out) :: bad                       !! first row with a pivot below the threshold, 0: none

      integer :: info, n

      n = size(self%x)
      call dgetrf(n, n, self%matrix, n, self%pivots, info)
      do bad = 1, n
         if (.not. abs(self%matrix(bad, bad)) > threshold) return
      end do
      bad = 0
   end subroutine lapack_decompose

   !> Solve for the right-hand side in x.
   subroutine lapack_substitute(self)
      class(augmented_lapack_t), intent(inout) :: self  !! the solver, decomposed

      integer :: info, n

      n = size(self%x)
      call dgetrs("N", n, 1, self%matrix, n, self%pivots, self%x, n, info)
   end subroutine lapack_substitute

end module augmented_lapack
