!> Pressures that are nowhere below zero, on a grid of m rows and n columns that close to a ring.
!>
!> Find p >= 0 with A p - b >= 0 and p (A p - b) = 0, cell by cell, where A is the five-point matrix of conductances, so symmetric
!> and of positive type: A p = sum over the neighbours of conductance times difference, and conductance to ground times p. There
!> is one solution; it makes p.A p/2 - b.p minimum among all p >= 0. Active sets (Hintermueller, Ito, Kunisch 2002; for such
!> matrices the same as policy iteration) come to it in a finite number of steps from any set, because p does not fall from the
!> second step on: solve A p = b for the cells that are wet, the others dry at zero; a wet cell below zero becomes dry, a dry one
!> to which more flows than away becomes wet. The set of the solution before is where the next starts.
!>
!> The wet cells are numbered column by column and their equations solved by Cholesky's banded factorisation. Where a column has
!> no wet cell the ring is cut there, and the band has m diagonals; otherwise the ring is folded, first and last column by turns,
!> and it has 2 m. Limits: m n below a million; round-off of p of 1e-12 of the maximum counts as zero.
module complementarity
   use kinds, only: wp
   use lapack, only: dpbtrf, dpbtrs
   implicit none (type, external)
   private
   public :: complementarity_t, new_complementarity

   integer, parameter :: most_steps = 200                 !! of the active set; ten are many
   real(wp), parameter :: round_off = 1.0e-12_wp          !! part of the maximum pressure or flow that counts as zero [1]

   !> The problem, its workspace and its solution.
   type :: complementarity_t
      integer :: m = 0                          !! rows
      integer :: n = 0                          !! columns
      logical :: is_full = .false.              !! pressures may be below zero: all cells are wet
      real(wp), allocatable :: around(:, :)     !! (m, n) conductances from column k to the next, from the last to the first [1]
      real(wp), allocatable :: along(:, :)      !! (m, n) from row j to the next; of the last row unused [1]
      real(wp), allocatable :: ground(:, :)     !! (m, n) to zero [1]
      real(wp), allocatable :: source(:, :)     !! (m, n) b [1/s]
      logical, allocatable :: is_known(:, :)    !! (m, n) cells that are omitted: `p` is given, nothing is conducted to them
      real(wp), allocatable :: p(:, :)          !! (m, n) the solution [1/s]
      logical, allocatable :: is_wet(:, :)      !! (m, n) cells where p was solved for
      integer :: n_steps = 0                    !! steps that the last solution took
      integer, allocatable, private :: place(:, :)    !! (m, n) number of a wet cell
      real(wp), allocatable, private :: band(:)       !! ((2m + 1) m n) matrix, lower band [1]
      real(wp), allocatable, private :: right(:)      !! (m n) right-hand side, then the solution [1/s]
   contains
      procedure :: solve
   end type complementarity_t

contains

   !> Make the workspace; all that is not known starts wet.
   subroutine new_complementarity(self, m, n, is_full)
      type(complementarity_t), intent(out) :: self  !! the problem
      integer, intent(in) :: m                      !! rows
      integer, intent(in) :: n                      !! columns, at least 3
      logical, intent(in) :: is_full                !! pressures may be below zero

      self%m = m
      self%n = n
      self%is_full = is_full
      allocate (self%around(m, n), self%along(m, n), self%ground(m, n), self%source(m, n), self%p(m, n), source=0.0_wp)
      allocate (self%is_known(m, n), source=.false.)
      allocate (self%is_wet(m, n), source=.true.)
      allocate (self%place(m, n), source=0)
      allocate (self%band((2*m + 1)*m*n), self%right(m*n), source=0.0_wp)
   end subroutine new_complementarity

   !> The pressures.
   subroutine solve(self, status)
      class(complementarity_t), intent(inout) :: self  !! the problem
      integer, intent(out) :: status                   !! 0: done; 1: the matrix is not one of positive type; 2: too many steps

      integer :: k, n_band, n_wet, step
      logical :: is_done

      do k = 1, self%n
         self%is_wet(:, k) = .not. self%is_known(:, k) .and. (self%is_wet(:, k) .or. self%is_full)
      end do
      status = 2
      do step = 1, most_steps
         self%n_steps = step
         call number_cells(self%m, self%n, self%is_wet, self%place, n_wet, n_band)
         if (n_wet > 0) then
            call assemble(self, n_band, n_wet, self%band)
            call dpbtrf("L", n_wet, n_band, self%band, n_band + 1, status)
            if (status == 0) call dpbtrs("L", n_wet, n_band, 1, self%band, n_band + 1, self%right, n_wet, status)
            if (status /= 0) then
               status = 1
               return
            end if
         end if
         call take_pressures(self)
         status = 0
         if (self%is_full) return
         call choose_wet(self, is_done)
         if (is_done) return
         status = 2
      end do
   end subroutine solve

   !> Numbers of the wet cells, in the order of minimum band.
   pure subroutine number_cells(m, n, is_wet, place, n_wet, n_band)
      integer, intent(in) :: m              !! rows
      integer, intent(in) :: n              !! columns
      logical, intent(in) :: is_wet(m, n)   !! (m, n) cells that are solved for
      integer, intent(out) :: place(m, n)   !! (m, n) their numbers, 0: none
      integer, intent(out) :: n_wet         !! how many
      integer, intent(out) :: n_band        !! diagonals below the main one

      integer :: cut, j, k, next, step

      cut = 0
      do k = 1, n
         if (.not. any(is_wet(:, k))) cut = k
      end do
      n_wet = 0
      do step = 1, n
         if (cut > 0) then
            k = modulo(cut + step - 1, n) + 1
         else
            k = merge((step + 1)/2, n + 1 - step/2, modulo(step, 2) == 1)
         end if
         do j = 1, m
            place(j, k) = 0
            if (.not. is_wet(j, k)) cycle
            n_wet = n_wet + 1
            place(j, k) = n_wet
         end do
      end do
      n_band = min(1, max(n_wet - 1, 0))
      do k = 1, n
         next = modulo(k, n) + 1
         do j = 1, m
            if (place(j, k) > 0 .and. place(j, next) > 0) n_band = max(n_band, abs(place(j, k) - place(j, next)))
         end do
      end do
   end subroutine number_cells

   !> Matrix and right-hand side of the wet cells.
   pure subroutine assemble(self, n_band, n_wet, band)
      class(complementarity_t), intent(inout) :: self        !! the problem
      integer, intent(in) :: n_band                          !! diagonals below the main one
      integer, intent(in) :: n_wet                           !! wet cells
      real(wp), intent(inout) :: band(0:n_band, n_wet)       !! (0:n_band, n_wet) the matrix, lower band [1]

      integer :: j, k, own

      band = 0.0_wp
      do k = 1, self%n
         associate (place => self%place(:, k), next => self%place(:, modulo(k, self%n) + 1))
            do j = 1, self%m
               own = place(j)
               if (own > 0) then
                  self%right(own) = self%source(j, k)
                  band(0, own) = band(0, own) + self%ground(j, k)
               end if
               call couple(n_band, n_wet, own, next(j), self%around(j, k), band)
               if (j < self%m) call couple(n_band, n_wet, own, place(j + 1), self%along(j, k), band)
            end do
         end associate
      end do
   end subroutine assemble

   !> Add a conductance between two cells.
   pure subroutine couple(n_band, n_wet, one, other, conductance, band)
      integer, intent(in) :: n_band                     !! diagonals below the main one
      integer, intent(in) :: n_wet                      !! wet cells
      integer, intent(in) :: one, other                 !! numbers of the cells, 0: dry
      real(wp), intent(in) :: conductance               !! the conductance [1]
      real(wp), intent(inout) :: band(0:n_band, n_wet)  !! (0:n_band, n_wet) the matrix, lower band [1]

      if (one > 0) band(0, one) = band(0, one) + conductance
      if (other > 0) band(0, other) = band(0, other) + conductance
      if (one > 0 .and. other > 0) then
         associate (first => min(one, other))
            band(abs(one - other), first) = band(abs(one - other), first) - conductance
         end associate
      end if
   end subroutine couple

   !> Pressures of all cells that are not known.
   pure subroutine take_pressures(self)
      class(complementarity_t), intent(inout) :: self  !! the problem

      integer :: j, k

      do k = 1, self%n
         do j = 1, self%m
            if (self%is_known(j, k)) cycle
            self%p(j, k) = 0.0_wp
            if (self%place(j, k) > 0) self%p(j, k) = self%right(self%place(j, k))
         end do
      end do
   end subroutine take_pressures

   !> Cells that are wet in the next step; none changes: the solution is found, and what is below zero by round-off is zero.
   pure subroutine choose_wet(self, is_done)
      class(complementarity_t), intent(inout) :: self  !! the problem
      logical, intent(out) :: is_done                  !! all conditions hold

      real(wp) :: inflow, min_flow, min_pressure
      integer :: before, j, k, next

      is_done = .true.
      min_pressure = -round_off*maxval(self%p)
      min_flow = round_off*maxval(abs(self%source))
      do k = 1, self%n
         next = modulo(k, self%n) + 1
         before = modulo(k - 2, self%n) + 1
         do j = 1, self%m
            if (self%is_known(j, k)) cycle
            if (self%place(j, k) > 0) then
               self%is_wet(j, k) = self%p(j, k) >= min_pressure
               if (.not. self%is_wet(j, k)) is_done = .false.
            else
               inflow = self%source(j, k) + self%around(j, k)*self%p(j, next) + self%around(j, before)*self%p(j, before)
               if (j < self%m) inflow = inflow + self%along(j, k)*self%p(j + 1, k)
               if (j > 1) inflow = inflow + self%along(j - 1, k)*self%p(j - 1, k)
               self%is_wet(j, k) = inflow > min_flow
               if (self%is_wet(j, k)) is_done = .false.
            end if
         end do
      end do
      if (is_done) self%p = max(self%p, 0.0_wp)
   end subroutine choose_wet

end module complementarity
