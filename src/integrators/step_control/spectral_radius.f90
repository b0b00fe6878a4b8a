!> The spectral radius of the Jacobian of a right-hand side, by the power method on differences.
!>
!> The change of the derivative by a small change of the state along it is the direction of the next one; the root of the product
!> of two successive ratios tends to the radius, for pairs of imaginary eigenvalues, which a spring without a damper has, as
!> well. All are measured over the error scales. Source: B. P. Sommeijer, L. F. Shampine and J. G. Verwer, RKC: an explicit
!> solver for parabolic PDEs, J. Comput. Appl. Math. 88 (1998) 315-326. Limits: it comes from below; what is returned is larger
!> by a fifth.
module spectral_radius
   use kinds, only: eps, wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: find_radius, most_iterations, reserve

   integer, parameter :: most_iterations = 50        !! evaluations
   integer, parameter :: fewest_iterations = 4       !! before it may end
   real(wp), parameter :: close_enough = 0.02_wp     !! change of the radius from one iteration to the next [1]
   real(wp), parameter :: reserve = 1.2_wp           !! by which it is taken larger [1]

contains

   !> Find the radius at a state.
   subroutine find_radius(system, t, y, f, scale, direction, moved, rate, radius, n_evaluation, status)
      class(ode_system_t), intent(inout) :: system     !! the system
      real(wp), intent(in) :: t                        !! time [s]
      real(wp), intent(in) :: y(system%n)              !! (n) state [any]
      real(wp), intent(in) :: f(system%n)              !! (n) its derivative [any]
      real(wp), intent(in) :: scale(system%n)          !! (n) error scales [any]
      real(wp), intent(inout) :: direction(system%n)   !! (n) where to start, zero: along f; then the last one [any]
      real(wp), intent(inout) :: moved(system%n)       !! (n) workspace [any]
      real(wp), intent(inout) :: rate(system%n)        !! (n) workspace [any]
      real(wp), intent(out) :: radius                  !! the radius, with its reserve [1/s]
      integer, intent(out) :: n_evaluation             !! evaluations
      integer, intent(out) :: status                   !! of the evaluations

      real(wp) :: before, length, now, ratio, ratio_before, step
      integer :: k, n

      n = system%n - system%n_quadrature
      status = 0
      radius = 0.0_wp
      before = 0.0_wp
      ratio_before = 0.0_wp
      n_evaluation = 0
      if (length_of(n, direction, scale) <= 0.0_wp) direction = f
      length = length_of(n, direction, scale)
      if (length <= 0.0_wp) then
         direction(:n) = scale(:n)
         length = length_of(n, direction, scale)
      end if
      step = sqrt(eps)*max(1.0_wp, length_of(n, y, scale))
      do k = 1, most_iterations
         moved = y
         moved(:n) = y(:n) + step/length*direction(:n)
         call system%evaluate(t, moved, rate, status)
         n_evaluation = k
         if (status /= 0) return
         direction(:n) = rate(:n) - f(:n)
         length = length_of(n, direction, scale)
         ratio = length/step
         if (.not. ratio > 0.0_wp) exit
         now = sqrt(ratio*ratio_before)
         radius = max(now, merge(ratio, 0.0_wp, k == 1))
         if (k >= fewest_iterations .and. abs(now - before) <= close_enough*now) exit
         before = now
         ratio_before = ratio
      end do
      radius = reserve*radius
      if (.not. radius < huge(1.0_wp)) status = 1
   end subroutine find_radius

   !> Length of a vector over the scales.
   pure real(wp) function length_of(n, x, scale) result(length)
      integer, intent(in) :: n          !! entries
      real(wp), intent(in) :: x(:)      !! (n or more) the vector [any]
      real(wp), intent(in) :: scale(:)  !! (n or more) the scales [any]

      integer :: i

      length = 0.0_wp
      do i = 1, n
         length = length + (x(i)/scale(i))**2
      end do
      length = sqrt(length)
   end function length_of

end module spectral_radius
