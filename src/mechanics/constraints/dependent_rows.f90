!> Rows that depend on others, and those whose multipliers are therefore not unique.
!>
!> From a column-pivoted QR factorisation of Phi_q^T (LAPACK dgeqp3), scaled; of many rows from `sparse_start`.
!> Source: Golub and Van Loan, Matrix Computations, section 5.4 (rank). Limits: at one position.
module dependent_rows
   use assembly_report, only: assembly_t
   use kinds, only: wp
   use lapack, only: dgeqp3, dtrtrs
   use linkage, only: linkage_t
   use row_corrections, only: change_weights, evaluate_rows, rank_tolerance, scaled_jacobian, wants_sparse
   use sparse_start, only: new_sparse_start, sparse_start_t
   implicit none (type, external)
   private
   public :: choose_dependent, find_dependent

   real(wp), parameter :: weak = 1.0e-6_wp   !! pivot of a row that nearly depends on others, of the maximum [1]
   real(wp), parameter :: share = 1.0e-6_wp  !! minimum part of a scaled row in a combination that vanishes [1]

contains

   !> Rows that depend on others at an assembled position: `choose_dependent` there.
   subroutine find_dependent(linkage, q, v, report)
      type(linkage_t), intent(inout) :: linkage        !! the bodies and their rows
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) coordinates [any]
      real(wp), intent(in) :: v(:)                     !! (n_v bodies) their rates [m/s or rad/s]
      type(assembly_t), intent(inout) :: report        !! rank and dependent rows are set

      if (linkage%rows%n > 0) call evaluate_rows(linkage, 0.0_wp, q, v)
      call choose_dependent(linkage, report)
   end subroutine find_dependent

   !> Rows, as evaluated, that depend on others, and all rows whose multipliers are therefore not unique: those that
   !> occur in a combination of rows that vanishes, Phi_q^T x = 0. From the factors R = [ R_1, R_2; 0, 0 ] of the rows in the
   !> order of their pivots, x = ( -R_1^-1 R_2, 1 ).
   subroutine choose_dependent(linkage, report, is_sparse, combination)
      type(linkage_t), intent(in) :: linkage           !! the bodies and their rows
      type(assembly_t), intent(inout) :: report        !! rank and dependent rows are set
      logical, intent(in), optional :: is_sparse       !! whether matrices are sparse; absent: where there are many rows
      real(wp), allocatable, intent(out), optional :: combination(:, :)  !! (rows, dependent) x, if dense and any [1]

      type(sparse_start_t) :: sparse
      real(wp), allocatable :: ease(:), jac(:, :), tau(:), transposed(:, :), work(:)
      integer, allocatable :: order(:)
      logical, allocatable :: is_shared(:)
      integer :: info, k, m, n

      report%n_weak = 0
      report%dependent = [integer ::]
      report%shared = [integer ::]
      if (linkage%rows%n == 0) return
      if (wants_sparse(linkage, is_sparse)) then
         call new_sparse_start(linkage%bodies%n, linkage%rows, sparse)
         allocate (ease(linkage%coordinates%n_v*linkage%bodies%n), source=1.0_wp)
         call sparse%find_dependent(linkage%rows%jac, change_weights(linkage, ease), linkage%solution%row_weight, share, &
                                    report%dependent, report%shared)
         report%rank = linkage%rows%n - size(report%dependent)
         return
      end if
      call scaled_jacobian(linkage, jac)
      transposed = transpose(jac)
      n = size(transposed, 1)
      m = size(transposed, 2)
      allocate (order(m), source=0)
      allocate (tau(min(m, n)), work(max(1, 64*(m + 1))), source=0.0_wp)
      call dgeqp3(n, m, transposed, n, order, tau, work, size(work), info)
      report%rank = 0
      do k = 1, min(m, n)
         if (abs(transposed(k, k)) > rank_tolerance*abs(transposed(1, 1))) report%rank = k
      end do
      report%n_weak = m - count([(abs(transposed(k, k)) > weak*abs(transposed(1, 1)), k=1, min(m, n))])
      report%dependent = order(report%rank + 1:m)
      if (report%rank == m) return
      call dtrtrs("U", "N", "N", report%rank, m - report%rank, transposed, n, transposed(:, report%rank + 1:), n, info)
      allocate (is_shared(m), source=.true.)
      is_shared(order(:report%rank)) = any(abs(transposed(:report%rank, report%rank + 1:)) > share, dim=2)
      report%shared = pack([(k, k=1, m)], is_shared)
      if (.not. present(combination)) return
      allocate (combination(m, m - report%rank), source=0.0_wp)
      combination(order(:report%rank), :) = -transposed(:report%rank, report%rank + 1:)
      do k = 1, m - report%rank
         combination(report%dependent(k), k) = 1.0_wp
      end do
   end subroutine choose_dependent

end module dependent_rows
