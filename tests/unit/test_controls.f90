!> The controls of the integrator: fixed, first, minimum and maximum step, limits of the work, names in a deck.
module test_controls
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t, exit_deck
   use integrator, only: advance_failed_evaluation, advance_step, advance_too_many_evaluations, advance_too_many_steps
   use integrator, only: advance_too_small
   use integrator_controls, only: controls_t, norm_mixed, norm_relative, norm_scaled
   use interpolation, only: inner_places
   use kinds, only: i8, two_pi, wp
   use ode_examples, only: growth_t, kepler_t, new_kepler, run_to
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_controls

   character(*), parameter :: nl = new_line("a")
   character(*), parameter :: wheel = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rev]"//nl//"rotor 2 0.1 0 0 TURNS"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"axle ground 0 0"//nl//"hub rotor 0 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"bearing axle hub"//nl// &
      "[force.torque]"//nl//"name body moment"//nl//"motor rotor {1 mN.m*cos(0.1 rad/s*t)}"//nl// &
      "[analysis.dynamic]"//nl//"start = given"//nl//"end = 500 s"//nl
      !! a wheel that turns slowly to and fro; TURNS is to be replaced

contains

   subroutine run_test_controls(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("fixed_step", test_fixed_step)
      call suite%test("initial_step", test_initial_step)
      call suite%test("maximum_step", test_maximum_step)
      call suite%test("minimum_step", test_minimum_step)
      call suite%test("minimum_step_is_tried", test_minimum_step_is_tried)
      call suite%test("maximum_steps", test_maximum_steps)
      call suite%test("maximum_evaluations", test_maximum_evaluations)
      call suite%test("fatal_evaluation", test_fatal_evaluation)
      call suite%test("failing_evaluation_shortens_the_step", test_failing_evaluation)
      call suite%test("nothing_but_the_start_can_be_evaluated", test_failing_start)
      call suite%test("evaluations_are_counted", test_evaluations_are_counted)
      call suite%test("names_in_a_deck", test_names_in_a_deck)
      call suite%test("one_control_by_two_names", test_two_names)
      call suite%test("turns_do_not_loosen_the_norm", test_turns)
   end subroutine run_test_controls

   !> A planet at its pericentre, with an integrator started.
   subroutine new_orbit(controls, t_end, system, method)
      type(controls_t), intent(in) :: controls   !! controls
      real(wp), intent(in) :: t_end              !! end [s]
      type(kepler_t), intent(out) :: system      !! the planet
      type(verner_t), intent(out) :: method      !! its integrator

      real(wp) :: y(4)
      integer :: status

      call new_kepler(0.5_wp, system, y)
      method%controls = controls
      call method%start(system, 0.0_wp, y, t_end, status)
   end subroutine new_orbit

   !> Steps of one length, the last one shorter, none rejected whatever the tolerance.
   subroutine test_fixed_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      integer :: k, status

      call new_orbit(controls_t(fixed_step=0.3_wp, tolerance=1.0e-14_wp), 1.0_wp, system, method)
      do k = 1, 4
         call method%advance(system, 1.0_wp, status)
         call check_equal(error, status, advance_step, "status")
         call check_close(error, method%t, min(0.3_wp*k, 1.0_wp), 1.0e-15_wp, "time")
      end do
      call check_equal(error, int(method%count%n_steps), 4, "steps")
      call check_equal(error, int(method%count%n_rejected), 0, "rejected steps")
   end subroutine test_fixed_step

   subroutine test_initial_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_orbit(controls_t(initial_step=1.234e-3_wp), 1.0_wp, system, method)
      call method%advance(system, 1.0_wp, status)
      call check_close(error, method%t, 1.234e-3_wp, 1.0e-18_wp, "first step")
      call method%advance(system, 1.0_wp, status)
      call check_close(error, method%step%h, 4.0_wp*1.234e-3_wp, 1.0e-17_wp, "second step, four times the first")
   end subroutine test_initial_step

   subroutine test_maximum_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      real(wp) :: longest
      integer :: n, status

      call new_orbit(controls_t(tolerance=1.0e-3_wp, maximum_step=0.05_wp), 3.0_wp, system, method)
      longest = 0.0_wp
      n = 0
      do while (method%t < 3.0_wp)
         call method%advance(system, 3.0_wp, status)
         longest = max(longest, method%step%h)
         n = n + 1
      end do
      call check_close(error, longest, 0.05_wp, 1.0e-11_wp, "longest step")
      call check_true(error, n >= 60 .and. n < 65, "about sixty steps")
   end subroutine test_maximum_step

   !> A tolerance that needs shorter steps at the pericentre: failure there, nothing before it is lost.
   subroutine test_minimum_step(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_orbit(controls_t(tolerance=1.0e-10_wp, minimum_step=0.05_wp), 10.0_wp, system, method)
      call method%start(system, 3.14_wp, system%exact(3.14_wp), 10.0_wp, status)
      call run_to(method, system, 10.0_wp, status)
      call check_equal(error, status, advance_too_small, "status")
      call check_true(error, method%t > 3.3_wp .and. method%t < two_pi, "fails between apocentre and pericentre")
      call check_close(error, method%step%y1, system%exact(method%t), 1.0e-8_wp, "state before the failure")
      call check_true(error, method%step%h >= 0.05_wp, "no shorter step was made")
   end subroutine test_minimum_step

   !> As in DVERK: a first or next step below the minimum is replaced by the minimum, which is tried.
   subroutine test_minimum_step_is_tried(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_orbit(controls_t(initial_step=1.0e-6_wp, minimum_step=1.0e-3_wp), 1.0_wp, system, method)
      call method%advance(system, 1.0_wp, status)
      call check_equal(error, status, advance_step, "status")
      call check_close(error, method%t, 1.0e-3_wp, 1.0e-18_wp, "first step")
      ! what is left to the end may be shorter
      call method%advance(system, 1.0e-3_wp + 1.0e-5_wp, status)
      call check_equal(error, status, advance_step, "status of the rest")
      call check_close(error, method%t, 1.0e-3_wp + 1.0e-5_wp, 0.0_wp, "time after the rest")
   end subroutine test_minimum_step_is_tried

   subroutine test_maximum_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_orbit(controls_t(maximum_steps=7_i8), 10.0_wp, system, method)
      call run_to(method, system, 10.0_wp, status)
      call check_equal(error, status, advance_too_many_steps, "status")
      call check_equal(error, int(method%count%n_steps), 7, "steps")
      call check_close(error, method%step%y1, system%exact(method%t), 1.0e-6_wp, "state before the failure")
   end subroutine test_maximum_steps

   subroutine test_maximum_evaluations(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_orbit(controls_t(maximum_evaluations=100_i8), 10.0_wp, system, method)
      call run_to(method, system, 10.0_wp, status)
      call check_equal(error, status, advance_too_many_evaluations, "status")
      call check_true(error, method%count%n_evaluations <= 100 .and. method%count%n_evaluations > 92, "evaluations")
      call check_close(error, method%step%y1, system%exact(method%t), 1.0e-6_wp, "state before the failure")
   end subroutine test_maximum_evaluations

   !> y' = y, which cannot be evaluated after some time.
   subroutine new_growth(last, failure, controls, system, method)
      real(wp), intent(in) :: last                !! time after which it fails [s]
      integer, intent(in) :: failure              !! status of the failure
      type(controls_t), intent(in) :: controls    !! controls
      type(growth_t), intent(out) :: system       !! the system
      type(verner_t), intent(out) :: method       !! its integrator

      integer :: status

      system%n = 1
      system%rate = [1.0_wp]
      system%scale = [1.0_wp]
      system%last = last
      system%failure = failure
      method%controls = controls
      call method%start(system, 0.0_wp, [1.0_wp], 1.0_wp, status)
   end subroutine new_growth

   !> A negative status ends the integration; the last state stands. So does any status with fixed steps.
   subroutine test_fatal_evaluation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(growth_t) :: system
      type(verner_t) :: method
      integer :: k, status

      do k = 1, 2
         if (k == 1) call new_growth(0.5_wp, -1, controls_t(initial_step=0.04_wp, maximum_step=0.04_wp), system, method)
         if (k == 2) call new_growth(0.5_wp, 1, controls_t(fixed_step=0.04_wp), system, method)
         call run_to(method, system, 1.0_wp, status)
         call check_equal(error, status, advance_failed_evaluation, "status")
         call check_close(error, method%t, 0.48_wp, 1.0e-14_wp, "time")
         call check_close(error, method%step%y1(1), exp(0.48_wp), 1.0e-8_wp, "state")
      end do
      call new_growth(-1.0_wp, -1, controls_t(), system, method)
      call method%start(system, 0.0_wp, [1.0_wp], 1.0_wp, status)
      call check_equal(error, status, advance_failed_evaluation, "status at the start")
   end subroutine test_fatal_evaluation

   !> A positive status is tried again with shorter steps, up to the very place, then the step is too small.
   subroutine test_failing_evaluation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(growth_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_growth(0.5_wp, 1, controls_t(), system, method)
      call run_to(method, system, 1.0_wp, status)
      call check_equal(error, status, advance_too_small, "status")
      call check_close(error, method%t, 0.5_wp, 1.0e-13_wp, "time")
      call check_close(error, method%step%y1(1), exp(0.5_wp), 1.0e-7_wp, "state")
      call check_true(error, method%count%n_rejected > 10, "rejected steps")
   end subroutine test_failing_evaluation

   !> So it is if nothing after the very start can be evaluated.
   subroutine test_failing_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(growth_t) :: system
      type(verner_t) :: method
      integer :: k, status

      call new_growth(0.0_wp, 1, controls_t(), system, method)
      do k = 1, 3
         call method%advance(system, 1.0_wp, status)
      end do
      call check_equal(error, status, advance_too_small, "status")
      call check_close(error, method%t, 0.0_wp, 0.0_wp, "time")
      call check_true(error, method%count%n_steps == 0, "no step was made")
   end subroutine test_failing_start

   !> The integrator's counter is the number of times that it called the system.
   subroutine test_evaluations_are_counted(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(growth_t) :: system
      type(verner_t) :: method
      integer :: status

      call new_growth(2.0_wp, 1, controls_t(tolerance=1.0e-12_wp, initial_step=1.0_wp), system, method)
      call run_to(method, system, 1.0_wp, status)
      call check_true(error, method%count%n_rejected > 0, "a step was rejected")
      call check_equal(error, int(method%count%n_evaluations), system%n_call, "evaluations")
      call check_equal(error, system%n_call, 1 + 8*int(method%count%n_steps) + 7*int(method%count%n_rejected), &
                       "one, then 8 or 7 per step")
      call method%prepare_output(system, status)
      call check_equal(error, int(method%count%n_evaluations), system%n_call, "evaluations with one for output")
      call check_equal(error, int(method%count%n_output_evaluations), size(inner_places), "evaluations for output")
   end subroutine test_evaluations_are_counted

   !> Every control by its plain name and by IMSL's.
   subroutine test_names_in_a_deck(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded
      character(*), parameter :: plain = "tolerance = 1e-5"//nl//"initial_step = 2 us"//nl//"minimum_step = 3 ns"//nl// &
         "maximum_step = 4 ms"//nl//"maximum_steps = 500"//nl//"maximum_evaluations = 6000"//nl//"norm = relative"//nl// &
         "floor = 0.7"//nl//"step = 8 us"//nl
      character(*), parameter :: imsl = "tol = 1e-5"//nl//"hinit = 2 us"//nl//"hmin = 3 ns"//nl//"hmax = 4 ms"//nl// &
         "mxstep = 500"//nl//"mxfcn = 6000"//nl//"inorm = 2"//nl//"floor = 0.7"//nl//"step = 8 us"//nl

      call load_text(with_turns("0")//plain, loaded, error)
      if (.not. allocated(error)) call check_controls(loaded%method%controls)
      if (.not. allocated(error)) call load_text(with_turns("0")//imsl, loaded, error)
      if (.not. allocated(error)) call check_controls(loaded%method%controls)

   contains

      !> All of them.
      subroutine check_controls(controls)
         type(controls_t), intent(in) :: controls  !! as read

         call check_close(error, [controls%tolerance, controls%initial_step, controls%minimum_step, controls%maximum_step, &
                                  controls%floor, controls%fixed_step], &
                          [1.0e-5_wp, 2.0e-6_wp, 3.0e-9_wp, 4.0e-3_wp, 0.7_wp, 8.0e-6_wp], 1.0e-16_wp, "numbers")
         call check_equal(error, int(controls%maximum_steps), 500, "steps")
         call check_equal(error, int(controls%maximum_evaluations), 6000, "evaluations")
         call check_equal(error, controls%norm, norm_relative, "norm")
      end subroutine check_controls

   end subroutine test_names_in_a_deck

   subroutine test_two_names(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(error_t), allocatable :: mistake
      type(loaded_t) :: loaded

      call load_text(with_turns("0")//"tolerance = 1e-5"//nl//"tol = 1e-6"//nl, loaded, mistake)
      call check_true(error, allocated(mistake), "refused")
      if (allocated(error)) return
      call check_equal(error, mistake%code, exit_deck, "exit code")
      call check_true(error, index(mistake%message, "'tolerance'") > 0 .and. index(mistake%message, "'tol'") > 0, "names both")
   end subroutine test_two_names

   !> The deck of the wheel with a first angle.
   pure function with_turns(turns) result(deck)
      character(*), intent(in) :: turns     !! the angle in turns, as in a deck
      character(:), allocatable :: deck     !! the deck

      integer :: place

      place = index(wheel, "TURNS")
      deck = wheel(:place - 1)//turns//wheel(place + 5:)
   end function with_turns

   !> A slow wheel takes the same steps when it starts with a thousand turns done. In the
   !> mixed norm of IMSL it does not: there an angle's error counts relative to the angle.
   subroutine test_turns(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: later(400), now(400)
      integer :: n_later, n_now

      call step_times("0", norm_scaled, now, n_now)
      call step_times("1000", norm_scaled, later, n_later)
      call check_true(error, n_now > 50, "many steps")
      call check_equal(error, n_later, n_now, "steps in the scaled norm")
      if (allocated(error)) return
      call check_close(error, later(:n_now), now(:n_now), 1.0e-4_wp, "times of the steps")
      call step_times("0", norm_mixed, now, n_now)
      call step_times("1000", norm_mixed, later, n_later)
      call check_true(error, n_later < n_now - 5, "fewer steps in the mixed norm")

   contains

      !> The ends of all steps.
      subroutine step_times(turns, norm, times, n)
         character(*), intent(in) :: turns       !! the first angle
         integer, intent(in) :: norm             !! error norm
         real(wp), intent(out) :: times(:)       !! (any) times [s]
         integer, intent(out) :: n               !! steps

         type(error_t), allocatable :: mistake
         type(loaded_t) :: loaded
         integer :: status

         n = 0
         times = 0.0_wp
         call load_text(with_turns(turns), loaded, mistake)
         if (allocated(mistake)) return
         loaded%method%controls%tolerance = 1.0e-9_wp
         loaded%method%controls%norm = norm
         call loaded%method%start(loaded%system, 0.0_wp, loaded%y, loaded%plan%end, status)
         do while (loaded%method%t < loaded%plan%end .and. n < size(times) .and. status >= 0)
            call loaded%method%advance(loaded%system, loaded%plan%end, status)
            n = n + 1
            times(n) = loaded%method%t
         end do
      end subroutine step_times

   end subroutine test_turns

end module test_controls
