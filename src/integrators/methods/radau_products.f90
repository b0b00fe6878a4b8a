!> Products of the matrices of Radau IIA with vectors, by differences of the right-hand side along them.
!>
!> With Y_i the states of the three stages, J_i the Jacobians there and A the matrix of the method
!>
!> $$ (P v)_i = v_i - h \sum_j a_{ij} J_j v_j, J_j v_j = (f(t_j, Y_j + \sigma v_j) - f(t_j, Y_j))/\sigma $$
!>
!> is the matrix of Newton's equations, and p v = v - (h/u) J_0 v, with the real eigenvalue u of A^{-1}, the filter of the error.
!> Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.8.
module radau_products
   use kinds, only: eps, wp
   use krylov_solver, only: product_t
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: a, c, filter_product_t, real_eigenvalue, stage_product_t

   real(wp), parameter :: root = sqrt(6.0_wp)
   real(wp), parameter :: c(3) = [(4.0_wp - root)/10.0_wp, (4.0_wp + root)/10.0_wp, 1.0_wp]  !! places of the stages [1]
   real(wp), parameter :: a(3, 3) = reshape([ &
      (88.0_wp - 7.0_wp*root)/360.0_wp, (296.0_wp + 169.0_wp*root)/1800.0_wp, (16.0_wp - root)/36.0_wp, &
      (296.0_wp - 169.0_wp*root)/1800.0_wp, (88.0_wp + 7.0_wp*root)/360.0_wp, (16.0_wp + root)/36.0_wp, &
      (-2.0_wp + 3.0_wp*root)/225.0_wp, (-2.0_wp - 3.0_wp*root)/225.0_wp, 1.0_wp/9.0_wp], [3, 3])  !! (stage, stage) A [1]
   real(wp), parameter :: real_eigenvalue = 3.0_wp - 3.0_wp**(1.0_wp/3.0_wp) + 3.0_wp**(2.0_wp/3.0_wp)  !! u, of A^-1 [1]

   !> What both need: where the right-hand side is known, and room.
   type, abstract, extends(product_t) :: difference_t
      class(ode_system_t), pointer :: system => null()  !! the system, during a step
      integer :: n = 0                                  !! entries of the state without quadratures
      integer :: n_evaluation = 0                       !! evaluations made
      real(wp) :: t = 0.0_wp                            !! start of the step [s]
      real(wp) :: h = 0.0_wp                            !! its length [s]
      real(wp), allocatable :: scale(:)                 !! (n) error scales [any]
      real(wp), allocatable :: moved(:)                 !! (all) workspace [any]
      real(wp), allocatable :: rate(:)                  !! (all) workspace [any]
   contains
      procedure :: derivative
      procedure :: distance
   end type difference_t

   !> Of Newton's equations, for (v_1, v_2, v_3) in one row.
   type, extends(difference_t) :: stage_product_t
      real(wp), allocatable :: y(:, :)    !! (all, 3) states at the stages [any]
      real(wp), allocatable :: f(:, :)    !! (all, 3) their derivatives [any]
      real(wp), allocatable :: jv(:, :)   !! (n, 3) J v [any]
   contains
      procedure :: open => stage_open
      procedure :: apply => stage_apply
   end type stage_product_t

   !> Of the filter of the error.
   type, extends(difference_t) :: filter_product_t
      real(wp), allocatable :: y(:)   !! (all) state at the start [any]
      real(wp), allocatable :: f(:)   !! (all) its derivative [any]
   contains
      procedure :: open => filter_open
      procedure :: apply => filter_apply
   end type filter_product_t

contains

   !> Room.
   subroutine stage_open(self, n, n_all)
      class(stage_product_t), intent(inout) :: self  !! the product
      integer, intent(in) :: n                       !! entries of the state without quadratures
      integer, intent(in) :: n_all                   !! entries of the state

      self%n = n
      allocate (self%scale(n), self%moved(n_all), self%rate(n_all), self%y(n_all, 3), self%f(n_all, 3), self%jv(n, 3), &
                source=0.0_wp)
   end subroutine stage_open

   !> Room.
   subroutine filter_open(self, n, n_all)
      class(filter_product_t), intent(inout) :: self  !! the product
      integer, intent(in) :: n                        !! entries of the state without quadratures
      integer, intent(in) :: n_all                    !! entries of the state

      self%n = n
      allocate (self%scale(n), self%moved(n_all), self%rate(n_all), self%y(n_all), self%f(n_all), source=0.0_wp)
   end subroutine filter_open

   !> J v at a state, by a difference.
   subroutine derivative(self, t, y, f, v, jv)
      class(difference_t), intent(inout) :: self      !! the product; `status` is set
      real(wp), intent(in) :: t                       !! time [s]
      real(wp), intent(in) :: y(:)                    !! (all) state [any]
      real(wp), intent(in) :: f(:)                    !! (all) its derivative [any]
      real(wp), intent(in) :: v(:)                    !! (n) direction [any]
      real(wp), intent(out) :: jv(:)                  !! (n) J v [any]

      real(wp) :: step
      integer :: i, n

      n = self%n
      jv = 0.0_wp
      if (self%status /= 0) return
      step = self%distance(y, v)
      if (step <= 0.0_wp) return
      self%moved(:) = y
      do i = 1, n
         self%moved(i) = y(i) + step*v(i)
      end do
      self%n_evaluation = self%n_evaluation + 1
      call self%system%evaluate(t, self%moved, self%rate, self%status)
      do i = 1, n
         jv(i) = (self%rate(i) - f(i))/step
      end do
   end subroutine derivative

   !> Factor of a direction for a difference: sqrt(epsilon) s over its norm in the scales, with s the maximum of the entries over
   !> their scales, at least one. Where films act, entries that the difference does not move do not count: the velocity that
   !> squeezes a film may be the small difference of large ones, and the angle of a shaft that turns on and on must not make
   !> differences longer than it. Elsewhere they count: a long difference is a secant across the onset of a contact.
   pure real(wp) function distance(self, y, v) result(step)
      class(difference_t), intent(in) :: self         !! the product
      real(wp), intent(in) :: y(:)                    !! (all) state [any]
      real(wp), intent(in) :: v(:)                    !! (n) direction [any]

      real(wp) :: size, unit
      integer :: i

      step = 0.0_wp
      do i = 1, self%n
         step = step + (v(i)/self%scale(i))**2
      end do
      if (step <= 0.0_wp) return
      unit = sqrt(eps/step)
      size = 1.0_wp
      do i = 1, self%n
         if (self%system%traits%has_films .and. .not. unit*abs(v(i)) > eps*abs(y(i))) cycle
         size = max(size, abs(y(i))/self%scale(i))
      end do
      step = unit*size
   end function distance

   !> P v.
   subroutine stage_apply(self, v, z)
      class(stage_product_t), intent(inout) :: self  !! the product; `status` is set
      real(wp), intent(in) :: v(:)       !! (3 n) vector [any]
      real(wp), intent(out) :: z(:)      !! (3 n) product [any]

      integer :: i, j, n

      n = self%n
      do j = 1, 3
         call self%derivative(self%t + c(j)*self%h, self%y(:, j), self%f(:, j), v((j - 1)*n + 1:j*n), self%jv(:, j))
      end do
      do j = 1, 3
         do i = 1, n
            z((j - 1)*n + i) = v((j - 1)*n + i) - self%h*(a(j, 1)*self%jv(i, 1) + a(j, 2)*self%jv(i, 2) + a(j, 3)*self%jv(i, 3))
         end do
      end do
   end subroutine stage_apply

   !> p v.
   subroutine filter_apply(self, v, z)
      class(filter_product_t), intent(inout) :: self  !! the product; `status` is set
      real(wp), intent(in) :: v(:)        !! (n) vector [any]
      real(wp), intent(out) :: z(:)       !! (n) product [any]

      call self%derivative(self%t, self%y, self%f, v, z)
      z = v - self%h/real_eigenvalue*z
   end subroutine filter_apply

end module radau_products
