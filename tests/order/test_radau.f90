!> Radau IIA: its order, what is stiff, its error estimate, what it knows between the ends of a step.
module test_radau
   use check, only: check_close, check_equal, check_true, suite_t
   use convergence, only: check_order, check_quadratures, check_tolerances, converge
   use errors, only: error_t
   use kinds, only: wp
   use ode_examples, only: growth_t, kepler_t, new_kepler, new_particles, new_pendulum, particles_t, pendulum_t, power_t, run_to
   use radau, only: radau_t
   implicit none (type, external)
   private
   public :: run_test_radau

   integer, parameter :: n_halving = 4  !! step lengths of a convergence test

   !> y' = -decay (y - sin t) + cos t, which follows the sine.
   type, extends(growth_t) :: sine_t
      real(wp) :: decay = 0.0_wp  !! of the difference [1/s]
   contains
      procedure :: evaluate => sine_evaluate
   end type sine_t

contains

   subroutine run_test_radau(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_on_an_ellipse", test_order_on_an_ellipse)
      call suite%test("order_on_a_pendulum", test_order_on_a_pendulum)
      call suite%test("polynomials_up_to_degree_5_are_exact", test_polynomials)
      call suite%test("quadratures_between_the_ends_have_order_4", test_between)
      call suite%test("follows_a_sine_however_stiff", test_sine)
      call suite%test("damps_a_stiff_spring", test_spring)
      call suite%test("error_follows_the_tolerance", test_tolerance)
      call suite%test("parts_of_a_step_are_smooth", test_parts)
      call suite%test("quadratures_stay_out_of_the_norm", test_quadratures)
   end subroutine run_test_radau

   subroutine sine_evaluate(self, t, y, ydot, status)
      class(sine_t), intent(inout) :: self       !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(in) :: y(self%n)          !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)      !! (n) its derivative [any]
      integer, intent(out) :: status             !! outcome

      ydot = -self%decay*(y - sin(t)) + cos(t)
      status = 0
   end subroutine sine_evaluate

   subroutine test_order_on_an_ellipse(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      real(wp) :: errors(4, n_halving), y(4)

      call new_kepler(0.1_wp, system, y)
      call converge("radau", system, y, 5.0_wp, system%exact(5.0_wp), 10, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 4.6_wp, 5.4_wp, "position")
      call check_order(error, norm2(errors(3:4, :), dim=1), 4.6_wp, 5.4_wp, "velocity")
   end subroutine test_order_on_an_ellipse

   subroutine test_order_on_a_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(4, n_halving)

      call new_pendulum(0.9_wp, .true., system, y)
      call converge("radau", system, y, 5.0_wp, system%exact(5.0_wp), 16, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 4.6_wp, 5.6_wp, "state")
      call check_order(error, norm2(errors(3:4, :), dim=1), 4.6_wp, 5.6_wp, "quadratures")
   end subroutine test_order_on_a_pendulum

   !> One step of a length that is no round number: the matrix of the method, and places of the stages.
   subroutine test_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.3_wp
      type(power_t) :: system
      type(radau_t), allocatable :: method
      real(wp) :: deviation, y(3)
      character(16) :: what
      integer :: p, status

      system%n = 3
      system%n_position = 1
      system%n_quadrature = 1
      do p = 1, 6
         allocate (method)
         system%p = p
         method%controls%fixed_step = h
         call method%start(system, 0.0_wp, [0.0_wp, merge(1.0_wp, 0.0_wp, p == 1), 0.0_wp], h, status)
         call method%advance(system, h, status)
         call check_equal(error, status, 0, "status")
         y = [1.0_wp, real(p, wp)/h, 1.0_wp]*h**p
         deviation = maxval(abs((method%step%y1 - y)/y))
         write (what, "(a, i0)") "degree ", p
         if (p <= 5) call check_close(error, deviation, 0.0_wp, 1.0e-7_wp, what)
         ! what Newton's iteration leaves is in the first two; the quadrature is exact
         if (p <= 5) call check_close(error, method%step%y1(3), y(3), 1.0e-14_wp*y(3), what)
         if (p == 6) call check_true(error, abs(method%step%y1(3) - y(3)) > 1.0e-4_wp*y(3), "degree 6 is not exact")
         deallocate (method)
      end do
   end subroutine test_polynomials

   !> The quadratures of a pendulum within a step: the integral of a cubic.
   subroutine test_between(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      type(radau_t), allocatable :: method
      real(wp), allocatable :: y(:)
      real(wp) :: at(4), errors(n_halving), exact(4)
      integer :: i, k, status

      call new_pendulum(0.7_wp, .true., system, y)
      do k = 1, n_halving
         allocate (method)
         method%controls%fixed_step = 0.8_wp/2.0_wp**(k - 1)
         method%controls%tolerance = 1.0e-12_wp
         call method%start(system, 0.0_wp, y, 10.0_wp, status)
         call method%advance(system, 10.0_wp, status)
         call method%prepare_output(system, status)
         call check_equal(error, int(method%count%n_output_evaluations), 0, "no evaluations for output")
         errors(k) = 0.0_wp
         do i = 1, 9
            call method%state_at(system, 0.1_wp*real(i, wp)*method%step%h, at)
            exact = system%exact(0.1_wp*real(i, wp)*method%step%h)
            errors(k) = max(errors(k), maxval(abs(at(3:4) - exact(3:4))))
         end do
         deallocate (method)
      end do
      call check_order(error, errors, 4.5_wp, 5.6_wp, "quadratures within a step")
   end subroutine test_between

   !> The same steps, and the same small error, for decays of 1 to 10^9 per second.
   subroutine test_sine(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(sine_t) :: system
      type(radau_t), allocatable :: method
      integer :: k, status

      system%n = 1
      system%n_position = 0
      system%scale = [1.0_wp]
      do k = 0, 9, 3
         system%decay = 10.0_wp**k
         allocate (method)
         method%controls%tolerance = 1.0e-6_wp
         call method%start(system, 0.0_wp, [0.0_wp], 20.0_wp, status)
         call run_to(method, system, 20.0_wp, status)
         call check_equal(error, status, 0, "status")
         ! what the embedded formula may have, TOL^(2/3)/10
         call check_close(error, method%step%y1(1), sin(20.0_wp), 1.0e-5_wp, "sine")
         call check_true(error, method%count%n_steps < 150, "few steps")
         call check_true(error, method%count%n_evaluations < 4000, "few evaluations")
         deallocate (method)
      end do
   end subroutine test_sine

   !> An oscillation far too fast for the step is gone after some steps, one that the step resolves is not.
   subroutine test_spring(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(radau_t) :: method
      integer :: status

      call new_particles([0.0_wp, 0.0_wp], [1.0e6_wp, 1.0_wp], [integer ::], [real(wp) ::], [real(wp) ::], system)
      method%controls%fixed_step = 0.1_wp
      method%controls%tolerance = 1.0e-9_wp
      call method%start(system, 0.0_wp, [1.0e-3_wp, 1.0_wp, 0.0_wp, 0.0_wp], 10.0_wp, status)
      call run_to(method, system, 10.0_wp, status)
      call check_equal(error, status, 0, "status")
      call check_close(error, method%step%y1([1, 3]), [0.0_wp, 0.0_wp], 1.0e-9_wp, "stiff spring")
      call check_close(error, method%step%y1([2, 4]), [cos(10.0_wp), -sin(10.0_wp)], 1.0e-7_wp, "soft spring")
   end subroutine test_spring

   subroutine test_tolerance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_tolerances("radau", 6, 1.3_wp, error)
   end subroutine test_tolerance

   !> States within a step by the method itself are of its order and smooth in the length: differences of neighbours are small.
   subroutine test_parts(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: small = 1.0e-9_wp
      type(kepler_t) :: system
      type(radau_t) :: method
      real(wp) :: left(4), right(4), s, y(4)
      integer :: k, status

      call new_kepler(0.3_wp, system, y)
      method%controls%tolerance = 1.0e-6_wp
      call method%start(system, 0.0_wp, y, 2.0_wp, status)
      call method%advance(system, 2.0_wp, status)
      do k = 1, 9
         s = 0.1_wp*real(k, wp)
         call method%refine(system, s, left, status)
         call check_close(error, left, system%exact(s*method%step%h), 1.0e-6_wp, "state within")
         call method%refine(system, s + small, right, status)
         call check_close(error, (right(1:2) - left(1:2))/(small*method%step%h), left(3:4), 2.0e-5_wp, "its rate")
      end do
   end subroutine test_parts

   subroutine test_quadratures(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_quadratures("radau", error)
   end subroutine test_quadratures

end module test_radau
