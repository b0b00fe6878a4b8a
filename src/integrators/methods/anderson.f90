!> Acceleration of an iteration x <- x + f(x) by what its last steps have taught.
!>
!> With the last changes of x and of f in the columns of X and F, the next step is
!>
!> $$ d = f - (X + F) g, \quad g = \arg\min || (f - F g)/s || $$
!>
!> with the scales s of the unknowns: the secant that the last steps give in their directions, the iteration as it is across them.
!> Where F is nearly dependent, so that g is great, the step is f.
!> Source: D. G. Anderson, J. ACM 12 (1965) 547-560; H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715-1735, eqs.
!> (2.1)-(2.3). Limits: the last `depth` steps.
module anderson
   use kinds, only: wp
   use lapack, only: dgels
   implicit none (type, external)
   private
   public :: anderson_t

   integer, parameter :: depth = 5              !! steps that are remembered
   integer, parameter :: block = 32             !! columns that LAPACK takes together
   real(wp), parameter :: maximum = 10.0_wp    !! entry of g that is believed [1]

   !> The last steps.
   type :: anderson_t
      private
      integer :: n_step = 0                       !! steps since the iteration started
      real(wp), allocatable :: f(:)               !! (n) f of the last step [any]
      real(wp), allocatable :: d(:)               !! (n) the last step [any]
      real(wp), allocatable :: x_change(:, :)     !! (n, depth) X [any]
      real(wp), allocatable :: f_change(:, :)     !! (n, depth) F [any]
      real(wp), allocatable :: scaled(:, :)       !! (n, depth) F over the scales [any]
      real(wp), allocatable :: g(:)               !! (n) right side and solution [any]
      real(wp) :: work(depth*(block + 1)) = 0.0_wp  !! (any) workspace [any]
   contains
      procedure :: open => anderson_open
      procedure :: begin
      procedure :: improve
   end type anderson_t

contains

   !> Storage for n unknowns.
   subroutine anderson_open(self, n)
      class(anderson_t), intent(inout) :: self  !! the acceleration
      integer, intent(in) :: n                  !! number of unknowns

      allocate (self%f(n), self%d(n), self%x_change(n, depth), self%f_change(n, depth), self%scaled(n, depth), self%g(n), &
                source=0.0_wp)
   end subroutine anderson_open

   !> An iteration starts.
   pure subroutine begin(self)
      class(anderson_t), intent(inout) :: self  !! the acceleration

      self%n_step = 0
   end subroutine begin

   !> The step that is taken instead of f.
   subroutine improve(self, scale, f)
      class(anderson_t), intent(inout) :: self  !! the acceleration
      real(wp), intent(in) :: scale(:)          !! (n) scales of the unknowns [any]
      real(wp), intent(inout) :: f(:)           !! (n) f, then d [any]

      integer :: i, info, m, n

      n = size(f)
      if (self%n_step > 0) then
         i = 1 + modulo(self%n_step - 1, depth)
         self%x_change(:, i) = self%d
         self%f_change(:, i) = f - self%f
      end if
      m = min(self%n_step, depth)
      self%n_step = self%n_step + 1
      self%f(:) = f
      if (m > 0) then
         self%g(:) = f/scale
         do i = 1, m
            self%scaled(:, i) = self%f_change(:, i)/scale
         end do
         call dgels("N", n, m, 1, self%scaled, n, self%g, n, self%work, size(self%work), info)
         if (info == 0 .and. all(abs(self%g(:m)) <= maximum)) then
            do i = 1, m
               f(:) = f - self%g(i)*(self%x_change(:, i) + self%f_change(:, i))
            end do
         end if
      end if
      self%d(:) = f
   end subroutine improve

end module anderson
