!> Errors against the number of steps, and the order that they show.
module convergence
   use check, only: check_close, check_equal, check_true
   use errors, only: error_t
   use integrator, only: integrator_t
   use integrator_registry, only: find_integrator
   use kinds, only: wp
   use ode_examples, only: kepler_t, new_kepler, new_pendulum, pendulum_t, run_to, slope
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: check_order, check_quadratures, check_tolerances, converge

contains

   !> Errors at the end of fixed-step integrations with 1, 2, 4 ... times `n_step` steps.
   subroutine converge(name, system, y, t_end, exact, n_step, errors)
      character(*), intent(in) :: name                    !! the method
      class(ode_system_t), intent(inout) :: system        !! the system
      real(wp), intent(in) :: y(:)                        !! (n) state at t = 0 [any]
      real(wp), intent(in) :: t_end                       !! end [s]
      real(wp), intent(in) :: exact(:)                    !! (n) exact state there [any]
      integer, intent(in) :: n_step                       !! steps of the coarsest
      real(wp), intent(out) :: errors(:, :)               !! (n, levels) absolute errors [any]

      class(integrator_t), allocatable :: method
      integer :: k, status

      do k = 1, size(errors, 2)
         call find_integrator(name, method)
         method%controls%fixed_step = t_end/real(n_step*2**(k - 1), wp)
         call method%start(system, 0.0_wp, y, t_end, status)
         call run_to(method, system, t_end, status)
         errors(:, k) = abs(method%step%y1 - exact)
      end do
   end subroutine converge

   !> The last two observed orders must lie between two bounds.
   subroutine check_order(error, errors, minimum, most, what)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      real(wp), intent(in) :: errors(:)                    !! (levels) errors, the step halved each time [any]
      real(wp), intent(in) :: minimum, most                  !! bounds of the order [1]
      character(*), intent(in) :: what                     !! what converges

      integer :: n

      n = size(errors)
      associate (order => slope(errors(n - 2:n - 1), errors(n - 1:n)))
         call check_close(error, order, [0.5_wp, 0.5_wp]*(minimum + most), 0.5_wp*(most - minimum), what)
      end associate
   end subroutine check_order

   !> Ten times the tolerance, about ten times the error, on an ellipse, from a tolerance of 1e-3 on.
   subroutine check_tolerances(name, n_decade, allowed, error)
      character(*), intent(in) :: name                     !! the method
      integer, intent(in) :: n_decade                      !! decades of tolerance
      real(wp), intent(in) :: allowed                      !! difference of the decades of error to these [1]
      type(error_t), allocatable, intent(inout) :: error   !! first failure

      type(kepler_t) :: system
      class(integrator_t), allocatable :: method
      real(wp) :: errors(0:n_decade), y(4)
      integer :: k, status

      call new_kepler(0.5_wp, system, y)
      do k = 0, n_decade
         call find_integrator(name, method)
         method%controls%tolerance = 0.1_wp**(k + 3)
         call method%start(system, 0.0_wp, y, 20.0_wp, status)
         call run_to(method, system, 20.0_wp, status)
         errors(k) = norm2(method%step%y1 - system%exact(20.0_wp))
         call check_equal(error, status, 0, "status")
      end do
      call check_true(error, all(errors(:n_decade - 1) > errors(1:)), "error falls with the tolerance")
      call check_close(error, log10(errors(0)/errors(n_decade)), real(n_decade, wp), allowed, "decades of error")
   end subroutine check_tolerances

   !> Every step of a pendulum is the same, bit for bit, with quadratures and without.
   subroutine check_quadratures(name, error)
      character(*), intent(in) :: name                     !! the method
      type(error_t), allocatable, intent(inout) :: error   !! first failure

      type(pendulum_t) :: plain, rich
      class(integrator_t), allocatable :: first, second
      real(wp), allocatable :: y(:), z(:)
      integer :: k, status

      call new_pendulum(0.9_wp, .false., plain, y)
      call new_pendulum(0.9_wp, .true., rich, z)
      z(3:4) = [1.0e6_wp, -1.0e6_wp]
      call find_integrator(name, first)
      call find_integrator(name, second)
      first%controls%tolerance = 1.0e-7_wp
      second%controls = first%controls
      call first%start(plain, 0.0_wp, y, 60.0_wp, status)
      call second%start(rich, 0.0_wp, z, 60.0_wp, status)
      do k = 1, 60
         call first%advance(plain, 60.0_wp, status)
         call second%advance(rich, 60.0_wp, status)
         call check_close(error, [second%t, second%step%y1(1:2)], [first%t, first%step%y1], 0.0_wp, "a step")
      end do
   end subroutine check_quadratures

end module convergence
