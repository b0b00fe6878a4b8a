!> Augmented equations as one sparse matrix, by KLU: for large scenes with bodies that carry many joints.
!>
!> Scaled as the full matrix of `augmented_dense`. The structure is analysed once; each evaluation refactorises with the
!> pivots of before, and chooses new ones where these have become bad. A checkpoint holds the matrix that they were chosen for: a
!> run that continues chooses the same ones.
!> Source: Flores et al. (2008), eq. (2.15). Cost: in proportion to the bodies and rows, unless loops fill the factors.
module augmented_sparse
   use augmented, only: direct_t
   use rows, only: body_of_side, coordinate_place, list_sides_of_rows, n_v_planar, rows_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use klu, only: sparse_lu_t
   use archive, only: archive_t
   use matrix_kernels_planar, only: planar_lower => lower_sides, planar_scaled => scaled_loads, planar_unscaled => unscaled, &
                                    planar_upper => upper_sides
   use matrix_kernels_spatial, only: spatial_lower => lower_sides, spatial_scaled => scaled_loads, spatial_unscaled => unscaled, &
                                     spatial_upper => upper_sides
   implicit none (type, external)
   private
   public :: augmented_sparse_t

   !> Sparse matrix with its structure.
   type, extends(direct_t) :: augmented_sparse_t
      integer :: n_coordinate = 0               !! coordinates of unknown bodies, the first rows of the matrix
      type(sparse_lu_t) :: matrix               !! scaled augmented matrix and its factors
      integer, allocatable :: upper(:)          !! (sides) place of a side's first entry in the rows' columns; the others follow
      integer, allocatable :: lower(:, :)       !! (n_v, sides) places of its entries in the coordinates' columns
      integer, allocatable :: diagonal(:)       !! (solved rows) places of the diagonal entries of the rows
      real(wp), allocatable :: x(:)             !! (n) right-hand side and solution [any]
      real(wp), allocatable :: row_scale(:)     !! (solved rows) scales of the rows [any]
      real(wp), allocatable :: root(:, :)       !! (n_v, 0:bodies) roots of the inverse masses [1/kg^0.5 or 1/(kg^0.5.m)]
   contains
      procedure, nopass :: info => sparse_info
      procedure :: prepare => sparse_prepare
      procedure :: solve => sparse_solve
      procedure :: factorise => sparse_factorise
      procedure :: back_solve => sparse_back_solve
      procedure :: save => sparse_save
      procedure :: load => sparse_load
   end type augmented_sparse_t

contains

   !> Description of the solver.
   function sparse_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "sparse"
      info%help = "KLU"
      info%source = "Flores et al. (2008), eq. (2.15); KLU"
   end function sparse_info

   !> Structure of the matrix: unit diagonal, the Jacobian's transpose above, the Jacobian below, the diagonal of the rows.
   subroutine sparse_prepare(self, n_body, rows)
      class(augmented_sparse_t), intent(inout) :: self  !! the solver
      integer, intent(in) :: n_body                     !! number of bodies
      type(rows_t), intent(in) :: rows                  !! rows, of which the bodies are read

      integer :: body, c, column, coordinate(0:n_body), i, k, n, n_v, nq, place
      integer, allocatable :: last(:), sides(:)

      n_v = rows%n_v
      nq = n_v*rows%n_unknown
      n = nq + rows%n_solve
      self%n_coordinate = nq
      coordinate = 0
      coordinate(rows%unknown) = coordinate_place(n_v, [(k, k=1, rows%n_unknown)])
      self%matrix%n = n
      allocate (self%matrix%column(n + 1), self%matrix%row(nq + 2*n_v*rows%n_side + rows%n_solve))
      allocate (self%upper(rows%n_side), self%lower(n_v, rows%n_side), self%diagonal(rows%n_solve))
      place = 0
      do i = 1, rows%n_unknown
         body = rows%unknown(i)
         do c = 1, n_v
            column = coordinate(body) + c
            self%matrix%column(column) = place
            place = place + 1
            self%matrix%row(place) = column - 1
            do k = rows%last_side(body - 1) + 1, rows%last_side(body)
               place = place + 1
               self%matrix%row(place) = nq + rows%side_row(k) - 1
               self%lower(c, k) = place
            end do
         end do
      end do
      call list_sides_of_rows(rows, last, sides)
      do i = 1, rows%n_solve
         self%matrix%column(nq + i) = place
         do k = last(i - 1) + 1, last(i)
            self%upper(sides(k)) = place + 1
            do c = 1, n_v
               place = place + 1
               self%matrix%row(place) = coordinate(body_of_side(rows, rows%side(sides(k)))) + c - 1
            end do
         end do
         place = place + 1
         self%matrix%row(place) = nq + i - 1
         self%diagonal(i) = place
      end do
      self%matrix%column(n + 1) = place
      allocate (self%matrix%a(place), source=0.0_wp)
      self%matrix%a(self%matrix%column(:nq) + 1) = 1.0_wp
      call self%matrix%analyse()
      allocate (self%x(n), self%row_scale(rows%n_solve), self%residual(rows%n_solve), self%root(n_v, 0:n_body), source=0.0_wp)
   end subroutine sparse_prepare

   !> Accelerations and multipliers.
   subroutine sparse_solve(self, inverse_mass, rows, g, b, a, lambda, bad_row)
      class(augmented_sparse_t), intent(inout) :: self         !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in), contiguous :: g(:, 0:)             !! (n_v, 0:bodies) applied loads [N or N.m]
      real(wp), intent(in), contiguous :: b(:)                 !! (rows) right-hand side [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: a(:, 0:)          !! (n_v, 0:bodies) accelerations [m/s^2 or rad/s^2]
      real(wp), intent(inout), contiguous :: lambda(:)         !! (rows) multipliers [N or N.m]
      integer, intent(out) :: bad_row                          !! row that depends on others, 0: none

      integer :: k

      call sparse_factorise(self, inverse_mass, rows, 0.0_wp, bad_row)
      if (bad_row > 0) return
      if (rows%n_v == n_v_planar) then
         call planar_scaled(size(g, 2) - 1, rows%n_unknown, rows%unknown, self%root, g, self%x)
      else
         call spatial_scaled(size(g, 2) - 1, rows%n_unknown, rows%unknown, self%root, g, self%x)
      end if
      do k = 1, rows%n_solve
         self%x(self%n_coordinate + k) = b(k)*self%row_scale(k)
      end do
      call self%matrix%solve(self%x)
      if (rows%n_v == n_v_planar) then
         call planar_unscaled(size(g, 2) - 1, rows%n_unknown, rows%unknown, self%root, self%x, a)
      else
         call spatial_unscaled(size(g, 2) - 1, rows%n_unknown, rows%unknown, self%root, self%x, a)
      end if
      do k = 1, rows%n_solve
         lambda(k) = self%x(self%n_coordinate + k)*self%row_scale(k)
      end do
   end subroutine sparse_solve

   !> Factors of the damped matrix.
   subroutine sparse_factorise(self, inverse_mass, rows, damping, bad_row)
      class(augmented_sparse_t), intent(inout) :: self         !! the solver
      real(wp), intent(in), contiguous :: inverse_mass(:, 0:)  !! (n_v, 0:bodies) inverse masses [1/kg or 1/(kg.m^2)]
      type(rows_t), intent(in) :: rows                         !! rows
      real(wp), intent(in) :: damping                          !! on the diagonal of the rows [1]
      integer, intent(out) :: bad_row                          !! row at which there are no factors, 0: none

      integer :: bad, n_body, n_entry, row

      self%root = sqrt(inverse_mass)
      n_body = ubound(inverse_mass, 2)
      n_entry = size(self%matrix%a)
      if (rows%n_v == n_v_planar) then
         call planar_upper(n_body, rows%n_block, rows%n_solve, rows%n_side, rows%side, rows%side_row, rows%body, self%upper, &
                           n_entry, rows%jac, self%root, self%matrix%a, self%row_scale)
      else
         call spatial_upper(n_body, rows%n_block, rows%n_solve, rows%n_side, rows%side, rows%side_row, rows%body, self%upper, &
                            n_entry, rows%jac, self%root, self%matrix%a, self%row_scale)
      end if
      do row = 1, rows%n_solve
         self%matrix%a(self%diagonal(row)) = -damping
         if (.not. self%row_scale(row) > 0.0_wp) then
            self%row_scale(row) = 1.0_wp  ! a row between prescribed bodies
            self%matrix%a(self%diagonal(row)) = -1.0_wp
         end if
         self%row_scale(row) = 1.0_wp/sqrt(self%row_scale(row))
      end do
      if (rows%n_v == n_v_planar) then
         call planar_lower(rows%n_solve, rows%n_side, rows%side_row, self%upper, self%lower, self%row_scale, n_entry, &
                            self%matrix%a)
      else
         call spatial_lower(rows%n_solve, rows%n_side, rows%side_row, self%upper, self%lower, self%row_scale, n_entry, &
                            self%matrix%a)
      end if
      call self%matrix%factorise(bad)
      self%n_factorisations = self%n_factorisations + 1
      bad_row = 0
      if (bad > 0) bad_row = max(1, bad - self%n_coordinate)
   end subroutine sparse_factorise

   !> Solution of (S + damping D) x = r.
   subroutine sparse_back_solve(self, x)
      class(augmented_sparse_t), intent(inout) :: self  !! the solver, factorised
      real(wp), intent(inout), contiguous :: x(:)       !! (solved rows) r, then x [any]

      integer :: k

      self%x(:self%n_coordinate) = 0.0_wp
      do k = 1, size(self%row_scale)
         self%x(self%n_coordinate + k) = -x(k)*self%row_scale(k)
      end do
      call self%matrix%solve(self%x)
      do k = 1, size(self%row_scale)
         x(k) = self%x(self%n_coordinate + k)*self%row_scale(k)
      end do
   end subroutine sparse_back_solve

   !> Write what the solver remembers.
   subroutine sparse_save(self, archive)
      class(augmented_sparse_t), intent(in) :: self  !! the solver
      type(archive_t), intent(inout) :: archive      !! the checkpoint

      call archive%put(self%matrix%has_factors())
      call archive%put(self%matrix%chosen_for)
      call archive%put(self%matrix%a)
   end subroutine sparse_save

   !> Read what the solver remembers: the same pivots, the same factors.
   subroutine sparse_load(self, archive)
      class(augmented_sparse_t), intent(inout) :: self  !! the solver
      type(archive_t), intent(inout) :: archive         !! the checkpoint

      real(wp) :: last(size(self%matrix%a))
      integer :: bad
      logical :: has_factors

      call archive%get(has_factors)
      call archive%get(self%matrix%a)
      call archive%get(last)
      call self%matrix%forget()
      if (.not. has_factors) return
      call self%matrix%factorise(bad)
      if (all(self%matrix%a == last)) return
      self%matrix%a = last
      call self%matrix%factorise(bad)
   end subroutine sparse_load

end module augmented_sparse
