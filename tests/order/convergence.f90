!> Errors against the number of steps, and the order that they show.
module convergence
   use check, only: check_close
   use errors, only: error_t
   use integrator, only: integrator_t
   use integrator_registry, only: find_integrator
   use kinds, only: wp
   use ode_examples, only: run_to, slope
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: check_order, converge

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
   subroutine check_order(error, errors, least, most, what)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      real(wp), intent(in) :: errors(:)                    !! (levels) errors, the step halved each time [any]
      real(wp), intent(in) :: least, most                  !! bounds of the order [1]
      character(*), intent(in) :: what                     !! what converges

      integer :: n

      n = size(errors)
      associate (order => slope(errors(n - 2:n - 1), errors(n - 1:n)))
         call check_close(error, order, [0.5_wp, 0.5_wp]*(least + most), 0.5_wp*(most - least), what)
      end associate
   end subroutine check_order

end module convergence
