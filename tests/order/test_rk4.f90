!> The classical Runge-Kutta method: its order by halving steps, what it integrates exactly, its events.
module test_rk4
   use check, only: check_close, check_equal, check_true, suite_t
   use convergence, only: check_order, converge
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t, exit_deck
   use event_description, only: check_description, run_through, description_t
   use integrator, only: advance_too_small
   use kinds, only: eps, pi, wp
   use ode_examples, only: kepler_t, new_kepler, new_particles, new_pendulum, particles_t, pendulum_t, power_t, run_to
   use rk4, only: rk4_t
   implicit none (type, external)
   private
   public :: run_test_rk4

   integer, parameter :: n_halving = 4  !! step lengths of a convergence test

contains

   subroutine run_test_rk4(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_on_an_ellipse", test_order_on_an_ellipse)
      call suite%test("order_on_a_pendulum", test_order_on_a_pendulum)
      call suite%test("polynomials_up_to_degree_4_are_exact", test_polynomials)
      call suite%test("order_of_an_event", test_order_of_an_event)
      call suite%test("order_of_refine", test_refine)
      call suite%test("four_evaluations_a_step", test_evaluations)
      call suite%test("variable_steps_are_refused", test_variable_steps)
   end subroutine run_test_rk4

   subroutine test_order_on_an_ellipse(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      real(wp) :: errors(4, n_halving), y(4)

      call new_kepler(0.2_wp, system, y)
      call converge("rk4", system, y, 5.0_wp, system%exact(5.0_wp), 100, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 3.8_wp, 4.3_wp, "position")
      call check_order(error, norm2(errors(3:4, :), dim=1), 3.8_wp, 4.3_wp, "velocity")
      call check_true(error, maxval(errors(:, n_halving)) < 1.0e-7_wp, "small error with 800 steps")
   end subroutine test_order_on_an_ellipse

   subroutine test_order_on_a_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(4, n_halving)

      call new_pendulum(0.9_wp, .true., system, y)
      call converge("rk4", system, y, 5.0_wp, system%exact(5.0_wp), 160, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 3.8_wp, 4.4_wp, "motion")
      call check_order(error, norm2(errors(3:4, :), dim=1), 3.8_wp, 4.4_wp, "quadratures")
   end subroutine test_order_on_a_pendulum

   !> One step: position, velocity and quadrature of t^p are exact as long as the quadrature of p t^(p-1) by Simpson's rule is.
   subroutine test_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.3_wp
      type(power_t) :: system
      type(rk4_t), allocatable :: method
      real(wp) :: deviation
      integer :: p, status

      system%n = 3
      system%n_position = 1
      system%n_quadrature = 1
      do p = 1, 5
         allocate (method)
         system%p = p
         method%controls%fixed_step = h
         call method%start(system, 0.0_wp, [0.0_wp, merge(1.0_wp, 0.0_wp, p == 1), 0.0_wp], h, status)
         call method%advance(system, h, status)
         deviation = method%step%y1(3)/h**p - 1.0_wp
         if (p <= 4) call check_close(error, deviation, 0.0_wp, 20.0_wp*eps, "quadrature")
         ! Simpson's rule on 5 t^4: (4 (5/16) + 5)/6 = 25/24
         if (p == 5) call check_close(error, deviation, 1.0_wp/24.0_wp, 20.0_wp*eps, "Simpson's error at degree 5")
         if (p <= 4) call check_close(error, method%step%y1(2)*h/(real(p, wp)*h**p), 1.0_wp, 20.0_wp*eps, "velocity")
         if (p <= 4) call check_close(error, method%step%y1(1)/h**p, 1.0_wp, 20.0_wp*eps, "position")
         deallocate (method)
      end do
   end subroutine test_polynomials

   !> x = sin t through walls: on the wall to round-off, the times of order 4.
   subroutine test_order_of_an_event(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(particles_t) :: system
      type(rk4_t), allocatable :: method
      type(description_t) :: description
      real(wp) :: errors(4, n_halving)
      integer :: k

      do k = 1, n_halving
         allocate (method)
         method%controls%fixed_step = 0.2_wp/2**(k - 1)
         call new_particles([0.0_wp], [1.0_wp], [1], [0.5_wp], [1.0_wp], system)
         call run_through(system, [0.0_wp, 1.0_wp], 10.0_wp, method, description)
         call check_description(error, description, 4, 1.0e-15_wp, "spring")
         errors(:, k) = abs(description%time(1:4) - [1.0_wp, 5.0_wp, 13.0_wp, 17.0_wp]*pi/6.0_wp)
         deallocate (method)
      end do
      call check_order(error, errors(3, :), 3.8_wp, 4.3_wp, "time of the third event")
      call check_order(error, errors(4, :), 3.8_wp, 4.3_wp, "time of the fourth event")
   end subroutine test_order_of_an_event

   !> Within a step the local error is of order 5.
   subroutine test_refine(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(rk4_t), allocatable :: method
      real(wp) :: errors(n_halving), inner(4), y(4)
      integer :: k, status

      call new_kepler(0.3_wp, system, y)
      do k = 1, n_halving
         allocate (method)
         method%controls%fixed_step = 0.1_wp/2**(k - 1)
         call method%start(system, 0.0_wp, y, 1.0_wp, status)
         call method%advance(system, 1.0_wp, status)
         call method%refine(system, 0.6_wp, inner, status)
         errors(k) = norm2(inner - system%exact(0.6_wp*method%step%h))
         deallocate (method)
      end do
      call check_order(error, errors, 4.8_wp, 5.2_wp, "state within a step")
   end subroutine test_refine

   !> Three new stages and the derivative at the end, which is the first stage of the next step.
   subroutine test_evaluations(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(rk4_t) :: method
      real(wp) :: y(4)
      integer :: status

      call new_kepler(0.3_wp, system, y)
      method%controls%fixed_step = 0.125_wp
      call method%start(system, 0.0_wp, y, 1.0_wp, status)
      call run_to(method, system, 1.0_wp, status)
      call check_equal(error, int(method%count%n_steps), 8, "steps")
      call check_equal(error, int(method%count%n_rejected), 0, "rejected steps")
      call check_equal(error, int(method%count%n_evaluations), 1 + 8*4, "evaluations")
   end subroutine test_evaluations

   !> The deck must give the step; without one the method itself does not continue.
   subroutine test_variable_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: refusal
      type(kepler_t) :: system
      type(loaded_t) :: loaded
      type(rk4_t) :: method
      real(wp) :: y(4)
      integer :: status

      call new_kepler(0.3_wp, system, y)
      call method%start(system, 0.0_wp, y, 1.0_wp, status)
      call method%advance(system, 1.0_wp, status)
      call check_equal(error, status, advance_too_small, "status without a step")
      call load_text(wheel("method = rk4"), loaded, refusal)
      call check_true(error, allocated(refusal), "a deck without step is refused")
      if (allocated(error)) return
      call check_equal(error, refusal%code, exit_deck, "exit code")
      call check_true(error, index(refusal%message, "needs the length of its steps") > 0, refusal%message)
      call load_text(wheel("method = rk4"//new_line("a")//"step = 1 ms"), loaded, error)
      call check_close(error, loaded%method%controls%fixed_step, 1.0e-3_wp, 0.0_wp, "step of the deck")
      call load_text(wheel("method = bdf"//new_line("a")//"step = 1 ms"), loaded, refusal)
      call check_true(error, allocated(refusal), "a step for a method that chooses its own is refused")

   contains

      !> A deck of one wheel.
      function wheel(settings) result(deck)
         character(*), intent(in) :: settings   !! of the analysis
         character(:), allocatable :: deck      !! the deck

         character(*), parameter :: nl = new_line("a")

         deck = "deck = 1"//nl//"[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl// &
                "rotor 2 0.1 0 0 0"//nl//"[analysis.dynamic]"//nl//"start = given"//nl//"end = 1 s"//nl//settings//nl
      end function wheel

   end subroutine test_variable_steps

end module test_rk4
