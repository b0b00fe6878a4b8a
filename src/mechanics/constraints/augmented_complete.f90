!> Augmented equations as one full matrix, LU with complete pivoting by LAPACK: the most careful path, and the slowest.
!>
!> Source: Flores et al. (2008), eq. (2.15); LAPACK dgetc2, dgesc2.
module augmented_complete
   use augmented_dense, only: augmented_dense_t, dense_prepare, threshold
   use rows, only: rows_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use lapack, only: dgesc2, dgetc2
   implicit none (type, external)
   private
   public :: augmented_complete_t

   !> Full matrix with complete pivoting.
   type, extends(augmented_dense_t) :: augmented_complete_t
      integer, allocatable :: row_pivots(:)     !! (n) row exchanges
      integer, allocatable :: column_pivots(:)  !! (n) column exchanges
   contains
      procedure, nopass :: info => complete_info
      procedure :: prepare => complete_prepare
      procedure :: decompose => complete_decompose
      procedure :: substitute => complete_substitute
   end type augmented_complete_t

contains

   !> Description of the solver.
   function complete_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "complete"
      info%help = "complete pivoting"
      info%source = "Flores et al. (2008), eq. (2.15); LAPACK dgetc2, dgesc2"
   end function complete_info

   !> Workspace.
   subroutine complete_prepare(self, n_body, rows)
      class(augmented_complete_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                     !! number of bodies
      type(rows_t), intent(in) :: rows                  !! rows

      call dense_prepare(self, n_body, rows)
      allocate (self%row_pivots(size(self%x)), self%column_pivots(size(self%x)), source=0)
   end subroutine complete_prepare

   !> Factorise the matrix in place.
   subroutine complete_decompose(self, bad)
      class(augmented_complete_t), intent(inout) :: self  !! the solver
      integer, intent(out) :: bad                       !! first row with a pivot below the threshold, 0: none

      integer :: info, k, n

      n = size(self%x)
      call dgetc2(n, self%matrix, n, self%row_pivots, self%column_pivots, info)
      do k = 1, n
         ! the column that the pivot came from says which row of the equations it is
         if (.not. abs(self%matrix(k, k)) > threshold) then
            bad = original_column(self, k)
            return
         end if
      end do
      bad = 0
   end subroutine complete_decompose

   !> The column of the matrix that the exchanges have brought to place k.
   pure integer function original_column(self, k) result(column)
      class(augmented_complete_t), intent(in) :: self  !! the solver, decomposed
      integer, intent(in) :: k                         !! place after all exchanges

      integer :: i

      column = k
      do i = min(k, size(self%x)), 1, -1
         if (column == i) then
            column = self%column_pivots(i)
         else if (column == self%column_pivots(i)) then
            column = i
         end if
      end do
   end function original_column

   !> Solve for the right-hand side in x.
   subroutine complete_substitute(self)
      class(augmented_complete_t), intent(inout) :: self  !! the solver, decomposed

      real(wp) :: scale
      integer :: n

      n = size(self%x)
      call dgesc2(n, self%matrix, n, self%x, self%row_pivots, self%column_pivots, scale)
      if (scale < 1.0_wp) self%x = self%x/scale  ! LAPACK scales where the solution might overflow
   end subroutine complete_substitute

end module augmented_complete
