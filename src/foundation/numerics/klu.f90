!> Sparse LU factorisation by KLU of SuiteSparse: analysed once, refactorised with the same pivots as long as they are good.
!>
!> Matrices are compressed by columns, indices from zero, as KLU takes them.
!> Source: T. A. Davis, E. Palamadai Natarajan, Algorithm 907: KLU, ACM Trans. Math. Softw. 37 (2010) 36.
module klu
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int, c_null_ptr, c_ptr, c_size_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: sparse_lu_t

   real(wp), parameter :: min_rcond = 1.0e-13_wp  !! ratio of pivots that is too small: new pivots, or singular [1]
   integer(c_int), parameter :: amd = 0_c_int       !! KLU's number of the minimum degree ordering
   integer(c_int), parameter :: colamd = 1_c_int    !! and of that for matrices whose pivots are not on the diagonal
   integer(c_int), parameter :: no_scaling = -1_c_int  !! KLU's number for none: the caller scales

   !> KLU's `klu_common`, version 1 of SuiteSparse 4 to 7.
   !> Components: the library's.
   type, bind(C) :: klu_common_t
      real(c_double) :: tol = 0.0_c_double          !! pivot tolerance [1]
      real(c_double) :: memgrow = 0.0_c_double      !! growth of memory [1]
      real(c_double) :: initmem_amd = 0.0_c_double  !! initial memory [1]
      real(c_double) :: initmem = 0.0_c_double      !! initial memory [1]
      real(c_double) :: maxwork = 0.0_c_double      !! limit of work [1]
      integer(c_int) :: btf = 0                     !! block triangular form
      integer(c_int) :: ordering = 0                !! ordering
      integer(c_int) :: scale = 0                   !! scaling
      type(c_ptr) :: user_order = c_null_ptr        !! not used
      type(c_ptr) :: user_data = c_null_ptr         !! not used
      integer(c_int) :: halt_if_singular = 0        !! what to do at a zero pivot
      integer(c_int) :: status = 0                  !! outcome
      integer(c_int) :: nrealloc = 0                !! statistics
      integer(c_int) :: structural_rank = 0         !! statistics
      integer(c_int) :: numerical_rank = 0          !! statistics
      integer(c_int) :: singular_col = 0            !! column with a zero pivot, from 0
      integer(c_int) :: noffdiag = 0                !! statistics
      real(c_double) :: flops = 0.0_c_double        !! statistics [1]
      real(c_double) :: rcond = 0.0_c_double        !! minimum over maximum pivot [1]
      real(c_double) :: condest = 0.0_c_double      !! statistics [1]
      real(c_double) :: rgrowth = 0.0_c_double      !! statistics [1]
      real(c_double) :: work = 0.0_c_double         !! statistics [1]
      integer(c_size_t) :: memusage = 0             !! statistics
      integer(c_size_t) :: mempeak = 0              !! statistics
   end type klu_common_t

   interface
      !> Default parameters.
      integer(c_int) function klu_defaults(common) bind(C)
         import :: c_int, klu_common_t
         implicit none (type, external)
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_defaults

      !> Order a matrix.
      type(c_ptr) function klu_analyze(n, ap, ai, common) bind(C)
         import :: c_int, c_ptr, klu_common_t
         implicit none (type, external)
         integer(c_int), value :: n                   !! order of the matrix
         integer(c_int), intent(in) :: ap(*)          !! (n + 1) places of the columns
         integer(c_int), intent(in) :: ai(*)          !! (entries) rows
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_analyze

      !> Factorise with pivoting.
      type(c_ptr) function klu_factor(ap, ai, ax, symbolic, common) bind(C)
         import :: c_double, c_int, c_ptr, klu_common_t
         implicit none (type, external)
         integer(c_int), intent(in) :: ap(*)          !! (n + 1) places of the columns
         integer(c_int), intent(in) :: ai(*)          !! (entries) rows
         real(c_double), intent(in) :: ax(*)          !! (entries) values [any]
         type(c_ptr), value :: symbolic               !! of the analysis
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_factor

      !> Factorise with the pivots of before. 0: failed.
      integer(c_int) function klu_refactor(ap, ai, ax, symbolic, numeric, common) bind(C)
         import :: c_double, c_int, c_ptr, klu_common_t
         implicit none (type, external)
         integer(c_int), intent(in) :: ap(*)          !! (n + 1) places of the columns
         integer(c_int), intent(in) :: ai(*)          !! (entries) rows
         real(c_double), intent(in) :: ax(*)          !! (entries) values [any]
         type(c_ptr), value :: symbolic               !! of the analysis
         type(c_ptr), value :: numeric                !! factors
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_refactor

      !> Solve.
      integer(c_int) function klu_solve(symbolic, numeric, ldim, nrhs, b, common) bind(C)
         import :: c_double, c_int, c_ptr, klu_common_t
         implicit none (type, external)
         type(c_ptr), value :: symbolic               !! of the analysis
         type(c_ptr), value :: numeric                !! factors
         integer(c_int), value :: ldim, nrhs          !! size of the right-hand side
         real(c_double), intent(inout) :: b(*)        !! (n) right-hand side, then solution [any]
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_solve

      !> Ratio of the minimum to the maximum pivot, into common%rcond.
      integer(c_int) function klu_rcond(symbolic, numeric, common) bind(C)
         import :: c_int, c_ptr, klu_common_t
         implicit none (type, external)
         type(c_ptr), value :: symbolic               !! of the analysis
         type(c_ptr), value :: numeric                !! factors
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_rcond

      !> Free an analysis.
      integer(c_int) function klu_free_symbolic(symbolic, common) bind(C)
         import :: c_int, c_ptr, klu_common_t
         implicit none (type, external)
         type(c_ptr), intent(inout) :: symbolic       !! of the analysis
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_free_symbolic

      !> Free factors.
      integer(c_int) function klu_free_numeric(numeric, common) bind(C)
         import :: c_int, c_ptr, klu_common_t
         implicit none (type, external)
         type(c_ptr), intent(inout) :: numeric        !! factors
         type(klu_common_t), intent(inout) :: common  !! parameters
      end function klu_free_numeric
   end interface

   !> A sparse matrix and its factors. It frees them itself; it must not be copied once analysed.
   type :: sparse_lu_t
      integer :: n = 0                                 !! order
      logical :: pivots_anywhere = .false.             !! its pivots are not on the diagonal: ordered for any choice of them
      integer(c_int), allocatable :: column(:)         !! (n + 1) place of the first entry of each column, from 0
      integer(c_int), allocatable :: row(:)            !! (entries) rows, from 0
      real(wp), allocatable :: a(:)                    !! (entries) values [any]
      real(wp), allocatable :: chosen_for(:)           !! (entries) values that the pivots in use were chosen for [any]
      type(klu_common_t), private :: common            !! KLU's parameters
      type(c_ptr), private :: symbolic = c_null_ptr    !! KLU's analysis
      type(c_ptr), private :: numeric = c_null_ptr     !! KLU's factors
   contains
      procedure :: analyse => lu_analyse
      procedure :: is_analysed => lu_is_analysed
      procedure :: has_factors => lu_has_factors
      procedure :: factorise => lu_factorise
      procedure :: forget => lu_forget
      procedure :: solve => lu_solve
      final :: lu_free
   end type sparse_lu_t

contains

   !> Order the matrix, whose structure and values are there.
   subroutine lu_analyse(self)
      class(sparse_lu_t), intent(inout) :: self  !! the matrix

      integer(c_int) :: unused

      unused = klu_defaults(self%common)
      self%common%ordering = merge(colamd, amd, self%pivots_anywhere)
      self%common%scale = no_scaling
      self%common%btf = 0_c_int
      self%symbolic = klu_analyze(int(self%n, c_int), self%column, self%row, self%common)
      allocate (self%chosen_for(size(self%a)), source=0.0_wp)
   end subroutine lu_analyse

   !> Whether the matrix has been ordered.
   pure logical function lu_is_analysed(self) result(is_analysed)
      class(sparse_lu_t), intent(in) :: self  !! the matrix

      is_analysed = c_associated(self%symbolic)
   end function lu_is_analysed

   !> Whether there are factors, and with them pivots.
   pure logical function lu_has_factors(self) result(has_factors)
      class(sparse_lu_t), intent(in) :: self  !! the matrix

      has_factors = c_associated(self%numeric)
   end function lu_has_factors

   !> Forget factors and pivots: the next factorisation chooses new ones.
   subroutine lu_forget(self)
      class(sparse_lu_t), intent(inout) :: self  !! the matrix

      integer(c_int) :: unused

      if (c_associated(self%numeric)) unused = klu_free_numeric(self%numeric, self%common)
   end subroutine lu_forget

   !> Factorise the present values: with the pivots of before, or with new ones where these have become bad.
   subroutine lu_factorise(self, bad)
      class(sparse_lu_t), intent(inout) :: self  !! the matrix
      integer, intent(out) :: bad                !! column in which it is singular, 0: none

      integer(c_int) :: done

      bad = 0
      if (c_associated(self%numeric)) then
         done = klu_refactor(self%column, self%row, self%a, self%symbolic, self%numeric, self%common)
         if (done /= 0_c_int) done = klu_rcond(self%symbolic, self%numeric, self%common)
         if (done /= 0_c_int .and. self%common%rcond > min_rcond) return
         call self%forget()
      end if
      self%chosen_for(:) = self%a
      self%numeric = klu_factor(self%column, self%row, self%a, self%symbolic, self%common)
      if (c_associated(self%numeric)) then
         done = klu_rcond(self%symbolic, self%numeric, self%common)
         if (self%common%rcond > min_rcond) return
         call self%forget()
      end if
      bad = modulo(int(self%common%singular_col), self%n) + 1
   end subroutine lu_factorise

   !> Solve with these factors.
   subroutine lu_solve(self, x)
      class(sparse_lu_t), intent(inout) :: self     !! the matrix, factorised
      real(wp), intent(inout), contiguous :: x(:)   !! (n) right-hand side, then solution [any]

      integer(c_int) :: unused

      unused = klu_solve(self%symbolic, self%numeric, int(self%n, c_int), 1_c_int, x, self%common)
   end subroutine lu_solve

   !> Give KLU's memory back.
   impure elemental subroutine lu_free(self)
      type(sparse_lu_t), intent(inout) :: self  !! the matrix

      integer(c_int) :: unused

      call self%forget()
      if (c_associated(self%symbolic)) unused = klu_free_symbolic(self%symbolic, self%common)
   end subroutine lu_free

end module klu
