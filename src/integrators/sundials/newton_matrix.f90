!> The matrix of Newton's equations of a large constrained system, kept sparse: dF/du + c dF/du' of the stabilised form of
!> index 2 (`dae_system`), u = (y, lambda, mu), by differences of as many columns at once as have no row in common
!> (`colouring`). The columns of the multipliers are exact. Nothing depends on a quadrature; what a quadrature depends on is
!> omitted, so that its row is c alone: it follows the state one correction later.
!>
!> The same matrix solves Newton's equations of the ordinary form nearly, y' = f(t, y) with I - gamma df/dy: with c = 1/gamma
!> and right-hand sides that leave the invariants of f (violations and their rates) as f leaves them. That is a
!> preconditioner: iterations find what is missing, terms of second order in the violation.
!>
!> Memory and time in proportion to the number of couplings; one residual for each colour.
module newton_matrix
   use dae_system, only: dae_system_t
   use kinds, only: wp
   use klu, only: sparse_lu_t
   use colouring, only: colour_columns
   implicit none (type, external)
   private
   public :: newton_matrix_t

   !> The matrix.
   type :: newton_matrix_t
      integer :: n = 0                           !! entries of the state
      integer :: m = 0                           !! constraint rows
      integer :: n_colour = 0                    !! differences that it takes
      integer, allocatable :: column(:)          !! (n + 2 m + 1) place of the first entry of each column, from 0
      integer, allocatable :: row(:)             !! (entries) rows, from 0
      real(wp), allocatable :: a(:)              !! (entries) values [any]
      logical :: has_factors = .false.           !! whether the preconditioner can be used
      integer, allocatable, private :: first(:)  !! (colours + 1) first column of each colour
      integer, allocatable, private :: order(:)  !! (n - quadratures) columns, colour by colour
      real(wp), allocatable, private :: y(:)     !! (n) state moved [any]
      real(wp), allocatable, private :: ydot(:)  !! (n) its derivative moved [any]
      real(wp), allocatable, private :: r(:, :)  !! (n + 2 m, 2) residuals, here and moved [any]
      type(sparse_lu_t), private :: lu           !! factors of the preconditioner
   contains
      procedure :: start
      procedure :: fill
      procedure :: factorise
      procedure :: precondition
   end type newton_matrix_t

contains

   !> Structure and colours.
   subroutine start(self, system)
      class(newton_matrix_t), intent(inout) :: self  !! the matrix
      class(dae_system_t), intent(in) :: system      !! the system

      integer :: n_whole

      self%n = system%n
      self%m = system%n_row
      n_whole = self%n + 2*self%m
      call system%dae_pattern(self%column, self%row)
      call colour_columns(self%n - system%n_quadrature, n_whole, self%column, self%row, self%first, self%order)
      self%n_colour = size(self%first) - 1
      allocate (self%a(size(self%row)), self%y(self%n), self%ydot(self%n), self%r(n_whole, 2), source=0.0_wp)
   end subroutine start

   !> The values at a state. Status as of an evaluation.
   subroutine fill(self, system, t, c, y, ydot, lambda, mu, increment, status)
      class(newton_matrix_t), intent(inout) :: self  !! the matrix
      class(dae_system_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: c                      !! du'/du of the method [1/s]
      real(wp), intent(in) :: y(:)                   !! (n) state [any]
      real(wp), intent(in) :: ydot(:)                !! (n) its derivative [any]
      real(wp), intent(in) :: lambda(:)              !! (m) multipliers of the velocities [N or N.m]
      real(wp), intent(in) :: mu(:)                  !! (m) multipliers of the positions [N.s or N.m.s]
      real(wp), intent(in) :: increment(:)           !! (n) by which each entry is moved; of quadratures not used [any]
      integer, intent(out) :: status                 !! 0 done, > 0 retry with a smaller step, < 0 give up

      integer :: colour, i, j, k

      self%y = y
      self%ydot = ydot
      call residual(self, system, t, lambda, mu, 1, status)
      if (status /= 0) return
      self%a = 0.0_wp
      associate (first => self%column(self%n + 1), spread => self%column(self%n + self%m + 1) - self%column(self%n + 1))
         call system%dae_spread(self%a(first + 1:first + spread))
         self%a(first + spread + 1:first + 2*spread) = self%a(first + 1:first + spread)
      end associate
      do colour = 1, self%n_colour
         do i = self%first(colour), self%first(colour + 1) - 1
            j = self%order(i)
            self%y(j) = y(j) + increment(j)
            self%ydot(j) = ydot(j) + c*increment(j)
         end do
         call residual(self, system, t, lambda, mu, 2, status)
         if (status /= 0) return
         do i = self%first(colour), self%first(colour + 1) - 1
            j = self%order(i)
            do k = self%column(j) + 1, self%column(j + 1)
               self%a(k) = (self%r(self%row(k) + 1, 2) - self%r(self%row(k) + 1, 1))/increment(j)
            end do
            self%y(j) = y(j)
            self%ydot(j) = ydot(j)
         end do
      end do
      do j = self%n - system%n_quadrature + 1, self%n
         self%a(self%column(j) + 1) = c
      end do
   end subroutine fill

   !> Residual at the moved state.
   subroutine residual(self, system, t, lambda, mu, which, status)
      class(newton_matrix_t), intent(inout) :: self  !! the matrix
      class(dae_system_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: lambda(:)              !! (m) multipliers of the velocities [N or N.m]
      real(wp), intent(in) :: mu(:)                  !! (m) multipliers of the positions [N.s or N.m.s]
      integer, intent(in) :: which                   !! column of residuals that it goes to
      integer, intent(out) :: status                 !! of the evaluation

      associate (n => self%n, m => self%m)
         call system%dae_residual(t, self%y, self%ydot, lambda, mu, self%r(:n, which), self%r(n + 1:n + m, which), &
                                  self%r(n + m + 1:, which), status)
      end associate
   end subroutine residual

   !> Factorise for the ordinary form: rows of the state times gamma, multipliers measured in units of 1/gamma, so that the
   !> matrix stays as good as it is for any step.
   subroutine factorise(self, gamma)
      class(newton_matrix_t), intent(inout) :: self  !! the matrix, filled with c = 1/gamma
      real(wp), intent(in) :: gamma                  !! step times the coefficient of the method [s]

      integer :: bad, j, k

      if (.not. allocated(self%lu%a)) then
         self%lu%n = self%n + 2*self%m
         self%lu%pivots_anywhere = .true.
         self%lu%column = self%column
         self%lu%row = self%row
         self%lu%a = self%a
      end if
      do j = 1, self%n
         do k = self%column(j) + 1, self%column(j + 1)
            self%lu%a(k) = self%a(k)
            if (self%row(k) < self%n) self%lu%a(k) = gamma*self%a(k)
         end do
      end do
      k = self%column(self%n + 1)
      self%lu%a(k + 1:) = self%a(k + 1:)
      if (.not. self%lu%is_analysed()) call self%lu%analyse()
      call self%lu%factorise(bad)
      self%has_factors = bad == 0
   end subroutine factorise

   !> Solve (I - gamma df/dy) z = r nearly. Where the matrix is singular, as with redundant rows, z is r.
   subroutine precondition(self, gamma, r, z)
      class(newton_matrix_t), intent(inout) :: self   !! the matrix, factorised
      real(wp), intent(in) :: gamma                   !! as of the factors, or nearly [s]
      real(wp), intent(in) :: r(:)                    !! (n) right-hand side [any]
      real(wp), intent(out) :: z(:)                   !! (n) solution [any]

      integer :: i, j, k

      z = r
      if (.not. self%has_factors) return
      associate (n => self%n, m => self%m, x => self%r(:, 1))
         x(:n) = r
         x(n + 1:) = 0.0_wp
         do j = 1, n
            do k = self%column(j) + 1, self%column(j + 1)
               i = self%row(k) + 1
               if (i > n) x(i) = x(i) + self%a(k)*r(j)
            end do
         end do
         x(n + m + 1:) = x(n + m + 1:) + gamma*x(n + 1:n + m)
         call self%lu%solve(x)
         z = x(:n)
      end associate
   end subroutine precondition

end module newton_matrix
