!> The multistep methods: how the error answers to the tolerance, norms, stiffness, states between steps, start anew.
module test_multistep
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use integrator, only: integrator_t
   use integrator_controls, only: controls_t, norm_absolute, norm_euclidean, norm_scaled
   use integrator_registry, only: find_integrator
   use kinds, only: wp
   use ode_examples, only: growth_t, kepler_t, new_kepler, new_pendulum, pendulum_t, run_to
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: run_test_multistep

   character(6), parameter :: methods(3) = [character(6) :: "adams", "bdf", "ida"]  !! the methods

contains

   subroutine run_test_multistep(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("error_follows_the_tolerance", test_tolerance)
      call suite%test("quadratures_follow_the_tolerance", test_quadrature_errors)
      call suite%test("quadratures_stay_out_of_the_norm", test_quadratures)
      call suite%test("scales_and_tolerance_act_together", test_scales)
      call suite%test("copies_of_a_system_do_not_loosen_the_norm", test_copies)
      call suite%test("stiff_decay", test_stiff_decay)
      call suite%test("states_between_steps", test_between_steps)
      call suite%test("several_stops", test_stops)
      call suite%test("evaluations_are_counted", test_evaluations)
      call suite%test("starting_again_is_bitwise_equal", test_start_again)
   end subroutine run_test_multistep

   !> Start and run a method to a time.
   subroutine solve(name, system, y, t_end, controls, method, status)
      character(*), intent(in) :: name                             !! the method
      class(ode_system_t), intent(inout) :: system                 !! the system
      real(wp), intent(in) :: y(:)                                 !! (n) state at t = 0 [any]
      real(wp), intent(in) :: t_end                                !! end [s]
      type(controls_t), intent(in) :: controls                     !! controls
      class(integrator_t), allocatable, intent(out) :: method      !! the integrator, at the end
      integer, intent(out) :: status                               !! of the last step

      call find_integrator(trim(name), method)
      method%controls = controls
      call method%start(system, 0.0_wp, y, t_end, status)
      if (status == 0) call run_to(method, system, t_end, status)
   end subroutine solve

   !> An ellipse, three turns: a hundredth of the tolerance, about a hundredth of the error, over six decades.
   subroutine test_tolerance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(kepler_t) :: system
      real(wp) :: errors(4), y(4)
      integer :: i, k, status

      call new_kepler(0.5_wp, system, y)
      do i = 1, size(methods)
         do k = 1, size(errors)
            call solve(methods(i), system, y, 20.0_wp, controls_t(tolerance=0.01_wp**(k + 1)), method, status)
            call check_equal(error, status, 0, methods(i))
            errors(k) = norm2(method%step%y1 - system%exact(20.0_wp))
         end do
         call check_true(error, all(errors(2:) < errors(:3)/8.0_wp), methods(i)//": the error falls with the tolerance")
         call check_close(error, log10(errors(1)/errors(4)), 5.0_wp, 1.6_wp, methods(i)//": decades of error over six of tolerance")
         call check_true(error, errors(4) < 1.0e-6_wp, methods(i)//": small error at 1e-10")
      end do
   end subroutine test_tolerance

   !> What is integrated beside the motion is as accurate as the motion, though it has no part in the error test.
   subroutine test_quadrature_errors(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(4)
      integer :: i, k, status

      call new_pendulum(0.9_wp, .true., system, y)
      do i = 1, size(methods)
         do k = 6, 10, 2
            call solve(methods(i), system, y, 10.0_wp, controls_t(tolerance=0.1_wp**k), method, status)
            errors = abs(method%step%y1 - system%exact(10.0_wp))
            call check_true(error, maxval(errors) < 2.0e3_wp*0.1_wp**k, methods(i)//": error of motion and quadratures")
         end do
      end do
   end subroutine test_quadrature_errors

   !> The steps are the same with quadratures and without, whatever the size of these.
   subroutine test_quadratures(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: first, second
      type(pendulum_t) :: plain, rich
      real(wp), allocatable :: y(:), z(:)
      integer :: i, status

      call new_pendulum(0.9_wp, .false., plain, y)
      call new_pendulum(0.9_wp, .true., rich, z)
      z(3:4) = [1.0e6_wp, -1.0e6_wp]
      do i = 1, size(methods)
         call solve(methods(i), plain, y, 30.0_wp, controls_t(tolerance=1.0e-8_wp), first, status)
         call solve(methods(i), rich, z, 30.0_wp, controls_t(tolerance=1.0e-8_wp), second, status)
         call check_true(error, abs(second%count%n_steps - first%count%n_steps) <= first%count%n_steps/50, &
                         methods(i)//": as many steps")
         call check_close(error, second%step%y1(1:2), first%step%y1, 1.0e-6_wp, methods(i)//": the same motion")
      end do
   end subroutine test_quadratures

   !> Scales a thousand times as large with a tolerance a thousandth as large are the same thing, step for step.
   subroutine test_scales(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: first, second
      type(growth_t) :: one, other
      integer :: i, status

      one%n = 2
      one%rate = [-1.0_wp, -3.0_wp]
      one%scale = [1.0_wp, 2.0_wp]
      other = one
      other%scale = 1024.0_wp*one%scale
      do i = 1, size(methods)
         call solve(methods(i), one, [1.0_wp, 2.0_wp], 3.0_wp, controls_t(tolerance=2.0_wp**(-20)), first, status)
         call solve(methods(i), other, [1.0_wp, 2.0_wp], 3.0_wp, controls_t(tolerance=2.0_wp**(-30)), second, status)
         call check_equal(error, int(second%count%n_steps), int(first%count%n_steps), methods(i)//": steps")
         call check_close(error, second%step%y1, first%step%y1, 1.0e-11_wp, methods(i)//": state")
      end do
   end subroutine test_scales

   !> Nine copies of an equation in the Euclidean norm need the steps of one at a third of the tolerance: the norm is not divided
   !> by their number, and the other norms are bounded by it.
   subroutine test_copies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: norms(3) = [norm_euclidean, norm_absolute, norm_scaled]
      class(integrator_t), allocatable :: first, second
      type(growth_t) :: many, one
      integer :: i, k, status

      one%n = 1
      one%rate = [-1.0_wp]
      one%scale = [1.0_wp]
      many%n = 9
      many%rate = [(-1.0_wp, k=1, 9)]
      many%scale = [(1.0_wp, k=1, 9)]
      do i = 1, size(methods)
         do k = 1, size(norms)
            call solve(methods(i), one, [0.5_wp], 5.0_wp, controls_t(tolerance=1.0e-7_wp/3.0_wp, norm=norms(k)), first, status)
            call solve(methods(i), many, spread(0.5_wp, 1, 9), 5.0_wp, controls_t(tolerance=1.0e-7_wp, norm=norms(k)), second, &
                       status)
            call check_close(error, real(second%count%n_steps, wp), real(first%count%n_steps, wp), 0.06_wp, methods(i)//": steps", &
                             relative=.true.)
            call check_true(error, first%count%n_steps > 20, methods(i)//": steps enough to compare")
         end do
      end do
   end subroutine test_copies

   !> A fast decay beside a slow one: once the fast one is over, backward differentiation strides on, explicit steps stay short.
   subroutine test_stiff_decay(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: t_end = 2.0_wp
      class(integrator_t), allocatable :: method
      type(growth_t) :: system
      integer :: i, n_verner, status

      system%n = 2
      system%rate = [-1.0e4_wp, -1.0_wp]
      system%scale = [1.0_wp, 1.0_wp]
      call solve("verner", system, [1.0_wp, 1.0_wp], t_end, controls_t(tolerance=1.0e-6_wp), method, status)
      n_verner = int(method%count%n_steps)
      call check_true(error, n_verner > 2000, "explicit steps are bound by stability")
      do i = 2, 3
         call solve(methods(i), system, [1.0_wp, 1.0_wp], t_end, controls_t(tolerance=1.0e-6_wp), method, status)
         call check_true(error, 10*method%count%n_steps < n_verner, methods(i)//": a tenth of the steps at most")
         call check_close(error, method%step%y1, [0.0_wp, exp(-t_end)], 2.0e-5_wp, methods(i)//": state")
      end do
   end subroutine test_stiff_decay

   !> Between its ends a step is as accurate as at them, and it meets them.
   subroutine test_between_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: t_end = 6.0_wp
      class(integrator_t), allocatable :: method
      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: at_ends, between, inner(4), refined(4)
      integer :: i, j, status

      call new_pendulum(0.9_wp, .true., system, y)
      do i = 1, size(methods)
         call find_integrator(trim(methods(i)), method)
         method%controls%tolerance = 1.0e-8_wp
         call method%start(system, 0.0_wp, y, t_end, status)
         at_ends = 0.0_wp
         between = 0.0_wp
         do while (method%t < t_end)
            call method%advance(system, t_end, status)
            call method%prepare_output(system, status)
            at_ends = max(at_ends, maxval(abs(method%step%y1 - system%exact(method%t))))
            call method%within(system, 0.0_wp, inner)
            call check_close(error, inner, method%step%y0, 1.0e-14_wp, methods(i)//": start of a step")
            call method%within(system, 1.0_wp, inner)
            call check_close(error, inner, method%step%y1, 1.0e-14_wp, methods(i)//": end of a step")
            do j = 1, 4
               associate (s => 0.2_wp*j)
                  call method%state_at(system, method%step%t0 + s*method%step%h, inner)
                  between = max(between, maxval(abs(inner - system%exact(method%step%t0 + s*method%step%h))))
                  call method%refine(system, s, refined, status)
                  call check_close(error, refined, inner, 1.0e-13_wp, methods(i)//": refined")
               end associate
            end do
         end do
         call check_true(error, between < 2.0_wp*at_ends + 1.0e-8_wp, methods(i)//": error between steps")
      end do
   end subroutine test_between_steps

   !> Stops are met exactly, near ones and far ones, and cost no accuracy.
   subroutine test_stops(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: stops(6) = [1.0e-15_wp, 0.5_wp, 0.5_wp + 1.0e-12_wp, 1.7_wp, 1.7_wp + 2.0e-15_wp, 4.0_wp]
      class(integrator_t), allocatable :: method
      type(kepler_t) :: system
      real(wp) :: y(4)
      integer :: i, k, status

      call new_kepler(0.3_wp, system, y)
      do i = 1, size(methods)
         call find_integrator(trim(methods(i)), method)
         method%controls%tolerance = 1.0e-10_wp
         call method%start(system, 0.0_wp, y, 4.0_wp, status)
         do k = 1, size(stops)
            call run_to(method, system, stops(k), status)
            call check_equal(error, status, 0, methods(i)//": status")
            call check_close(error, method%t, stops(k), 0.0_wp, methods(i)//": the stop is met")
            call check_close(error, method%step%y1, system%exact(stops(k)), 1.0e-6_wp, methods(i)//": state at a stop")
         end do
      end do
   end subroutine test_stops

   !> Every call is counted, those for Jacobians too; so are rejected steps.
   subroutine test_evaluations(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(growth_t) :: system
      integer :: i, status

      system%n = 2
      system%rate = [-50.0_wp, -1.0_wp]
      system%scale = [1.0_wp, 1.0_wp]
      do i = 1, size(methods)
         system%n_call = 0
         call solve(methods(i), system, [1.0_wp, 1.0_wp], 2.0_wp, controls_t(tolerance=1.0e-9_wp, initial_step=0.1_wp), method, &
                    status)
         call check_equal(error, int(method%count%n_evaluations), system%n_call, methods(i)//": evaluations")
         call check_true(error, method%count%n_rejected > 0, methods(i)//": the first step is too long")
         call check_true(error, method%count%n_evaluations > 2*method%count%n_steps, &
                         methods(i)//": at least one beside that of the end")
      end do
   end subroutine test_evaluations

   !> The same integrator, started again, and another one: nothing is left of the first run.
   subroutine test_start_again(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method, other
      type(kepler_t) :: system
      real(wp) :: first(4), y(4)
      integer :: i, status

      call new_kepler(0.5_wp, system, y)
      do i = 1, size(methods)
         call solve(methods(i), system, y, 5.0_wp, controls_t(tolerance=1.0e-7_wp), method, status)
         first = method%step%y1
         call method%start(system, 0.0_wp, y, 5.0_wp, status)
         call run_to(method, system, 5.0_wp, status)
         call check_close(error, method%step%y1, first, 0.0_wp, methods(i)//": the same one again")
         call solve(methods(i), system, y, 5.0_wp, controls_t(tolerance=1.0e-7_wp), other, status)
         call check_close(error, other%step%y1, first, 0.0_wp, methods(i)//": another one")
      end do
   end subroutine test_start_again

end module test_multistep
