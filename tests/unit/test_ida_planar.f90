!> The stabilised form of index 2 of planar scenes: its residual, and what IDA makes of it.
module test_ida_planar
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use integrator, only: integrator_t
   use integrator_registry, only: find_integrator
   use kinds, only: pi, wp
   use ode_examples, only: new_pendulum, pendulum_t
   use mechanism, only: mechanism_t
   use scene_fixture, only: nl, slider_crank, start_text
   implicit none (type, external)
   private
   public :: run_test_ida_planar

   real(wp), parameter :: radius = 0.4_wp, mass = 2.0_wp, inertia = 0.05_wp, gravity = 9.81_wp
      !! of the pendulum: from pivot to centre [m], [kg], about the centre [kg.m^2], [m/s^2]

contains

   subroutine run_test_ida_planar(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("residual_vanishes_with_evaluate", test_residual_vanishes)
      call suite%test("residual_of_multipliers", test_multipliers)
      call suite%test("pendulum", test_pendulum)
      call suite%test("slider_crank", test_slider_crank)
      call suite%test("without_constraints", test_free_fall)
   end subroutine run_test_ida_planar

   !> A slider-crank without stabilisation at its start: derivative and multipliers of `evaluate` leave nothing over.
   subroutine test_residual_vanishes(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: lambda(:), r_lambda(:), r_mu(:), r_y(:), y(:), ydot(:), zero(:)
      integer :: status

      call start_text(slider_crank("stabilise = none", "hertz", "none", "ideal"), system, y, error)
      if (allocated(error)) return
      allocate (ydot(system%n), r_y(system%n), source=0.0_wp)
      allocate (r_lambda(system%n_row), r_mu(system%n_row), zero(system%n_row), source=0.0_wp)
      call system%evaluate(0.0_wp, y, ydot, status)
      lambda = system%linkage%solution%lambda(:system%n_row)
      call system%dae_residual(0.0_wp, y, ydot, lambda, zero, r_y, r_lambda, r_mu, status)
      call check_equal(error, status, 0, "status")
      call check_true(error, maxval(abs(lambda)) > 1.0_wp, "there are constraint forces")
      call check_close(error, r_y, 0.0_wp*r_y, 1.0e-12_wp*maxval(abs(ydot)), "differential equations")
      call check_close(error, r_lambda, zero, 1.0e-11_wp, "rates of the constraints")
      call check_close(error, r_mu, zero, 1.0e-13_wp, "constraints")
   end subroutine test_residual_vanishes

   !> Both sorts of multipliers act through the same forces: the rows of mu on positions are those of lambda on velocities.
   subroutine test_multipliers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: at_rest(:), lambda(:), moved(:), other(:), r_lambda(:), r_mu(:), r_y(:), y(:), ydot(:), zero(:)
      real(wp) :: power
      integer :: k, m, nq, status

      call start_text(slider_crank("stabilise = none", "hertz", "none", "ideal"), system, y, error)
      if (allocated(error)) return
      m = system%n_row
      nq = system%n_position
      allocate (ydot(system%n), r_y(system%n), moved(system%n), other(system%n), source=0.0_wp)
      allocate (lambda(m), r_lambda(m), r_mu(m), zero(m), source=0.0_wp)
      ! rates of the rows if nothing but the prescribed bodies moved
      other(1:nq) = y(1:nq)
      call system%dae_residual(0.0_wp, other, ydot, zero, zero, r_y, r_lambda, r_mu, status)
      at_rest = r_lambda
      call system%dae_residual(0.0_wp, y, ydot, zero, zero, r_y, r_lambda, r_mu, status)
      do k = 1, m
         lambda = 0.0_wp
         lambda(k) = 3.0_wp
         call system%dae_residual(0.0_wp, y, ydot, lambda, zero, moved, r_lambda, r_mu, status)
         call system%dae_residual(0.0_wp, y, ydot, zero, lambda, other, r_lambda, r_mu, status)
         moved = moved - r_y
         other = other - r_y
         call check_close(error, other(1:nq), moved(nq + 1:2*nq), 1.0e-9_wp, "the same directions", relative=.true.)
         call check_close(error, other(nq + 1:2*nq), zero(1)*other(1:nq), 0.0_wp, "mu does not act on velocities")
         ! M^{-1} J^T lambda: its scalar product with M times a motion is lambda times the rate of the row
         power = dot_product(moved(nq + 1:2*nq), [system%linkage%mass(:, system%linkage%rows%unknown)]*y(nq + 1:2*nq))
         call check_close(error, power, 3.0_wp*(r_lambda(k) - at_rest(k)), 1.0e-9_wp, "virtual power")
      end do
   end subroutine test_multipliers

   !> A compound pendulum against the elliptic functions: motion, constraints, reaction.
   subroutine test_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: t_end = 3.0_wp, amplitude = 2.0_wp
      class(integrator_t), allocatable :: method
      type(pendulum_t) :: closed
      type(mechanism_t) :: system
      real(wp), allocatable :: exact(:), y(:)
      real(wp) :: angle, errors(3), frequency, modulus, period, rate, violation(2)
      integer :: k, status

      frequency = sqrt(mass*gravity*radius/(inertia + mass*radius**2))
      modulus = sin(0.5_wp*amplitude)
      call new_pendulum(modulus, .false., closed, y)
      ! released from rest: a quarter of a period after the lowest point
      period = quarter(modulus)
      do k = 1, 3
         call start_text(pendulum_deck(), system, y, error)
         if (allocated(error)) return
         call system%begin_pace(0.0_wp, y, t_end)  ! as a run does: released from rest, it has no rate of its own yet
         call find_integrator("ida", method)
         method%controls%tolerance = 0.01_wp**(k + 2)
         call method%start(system, 0.0_wp, y, t_end, status)
         violation = 0.0_wp
         do while (method%t < t_end .and. status >= 0)
            call method%advance(system, t_end, status)
            violation(1) = max(violation(1), maxval(abs(system%linkage%rows%phi)))
            violation(2) = max(violation(2), maxval(abs(system%linkage%solution%phi_dot)))
         end do
         call check_equal(error, status, 0, "status")
         call check_true(error, violation(1) < method%controls%tolerance, "positions on their constraints")
         call check_true(error, violation(2) < 10.0_wp*method%controls%tolerance, "velocities on theirs")
         exact = closed%exact(frequency*t_end + period)
         angle = method%step%y1(3) + 0.5_wp*pi
         rate = method%step%y1(6)
         errors(k) = max(abs(angle - exact(1)), abs(rate - frequency*exact(2)))
         ! reaction at the pivot: m a - m g, from the closed form
         call check_close(error, norm2(system%linkage%solution%lambda(:system%n_row)), norm2(reaction(exact(1), &
                          frequency*exact(2))), &
                          3.0e3_wp*method%controls%tolerance, "reaction", relative=.true.)
      end do
      call check_true(error, all(errors(2:) < errors(:2)/8.0_wp), "the error follows the tolerance")
      call check_true(error, errors(3) < 1.0e-6_wp, "small error at 1e-10")

   contains

      !> Quarter of a period in units of 1/frequency: K(k), by the arithmetic-geometric mean.
      pure real(wp) function quarter(modulus)
         real(wp), intent(in) :: modulus  !! k [1]

         real(wp) :: a, b, next
         integer :: i

         a = 1.0_wp
         b = sqrt(1.0_wp - modulus**2)
         do i = 1, 8
            next = 0.5_wp*(a + b)
            b = sqrt(a*b)
            a = next
         end do
         quarter = 0.5_wp*pi/a
      end function quarter

      !> Force on the bob at the pivot, along the rod and across.
      pure function reaction(angle, rate) result(force)
         real(wp), intent(in) :: angle   !! from the lowest position [rad]
         real(wp), intent(in) :: rate    !! its rate [rad/s]
         real(wp) :: force(2)            !! (2) towards the pivot, across [N]

         force(1) = mass*(rate**2*radius + gravity*cos(angle))
         force(2) = mass*(-frequency**2*sin(angle)*radius + gravity*sin(angle))
      end function reaction

      !> The pendulum, released from rest.
      function pendulum_deck() result(deck)
         character(:), allocatable :: deck   !! the deck

         character(160) :: place

         write (place, "(a, 2(es24.16, 1x), f22.16)") "bob 2 0.05 ", radius*sin(amplitude), -radius*cos(amplitude), &
            (amplitude - 0.5_wp*pi)*180.0_wp/pi
         deck = "[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl//"[bodies]"//nl// &
                "name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl//trim(place)//nl// &
                "[points]"//nl//"name body xi[m] eta[m]"//nl//"pivot ground 0 0"//nl//"top bob -0.4 0"//nl// &
                "[joint.revolute]"//nl//"name i j"//nl//"hinge pivot top"//nl// &
                "[analysis.dynamic]"//nl//"method = ida"//nl//"start = given"//nl//"end = 3 s"//nl
      end function pendulum_deck

   end subroutine test_pendulum

   !> A driven slider-crank: constraints at round-off and at the tolerance, for five turns.
   subroutine test_slider_crank(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: t_end = 0.06_wp
      class(integrator_t), allocatable :: method
      type(mechanism_t) :: system
      real(wp), allocatable :: change(:), y(:)
      real(wp) :: violation(2)
      integer :: status

      call start_text(slider_crank("stabilise = none", "hertz", "none", "ideal"), system, y, error)
      if (allocated(error)) return
      call find_integrator("ida", method)
      method%controls%tolerance = 1.0e-9_wp
      call method%start(system, 0.0_wp, y, t_end, status)
      violation = 0.0_wp
      do while (method%t < t_end .and. status >= 0)
         call method%advance(system, t_end, status)
         violation(1) = max(violation(1), maxval(abs(system%linkage%rows%phi)))
         violation(2) = max(violation(2), maxval(abs(system%linkage%solution%phi_dot)))
      end do
      call check_equal(error, status, 0, "status")
      call check_true(error, violation(1) < 1.0e-9_wp, "positions on their constraints")
      ! the rates are about 500 rad/s
      call check_true(error, violation(2) < 5.0e-7_wp, "velocities on theirs")
      ! a whole number of turns at 5000 rpm: back where it started
      change = method%step%y1(:system%n_position) - y(:system%n_position)
      change(3::3) = change(3::3) - 2.0_wp*pi*nint(change(3::3)/(2.0_wp*pi))
      call check_close(error, change, 0.0_wp*change, 1.0e-7_wp, "positions after five turns")
   end subroutine test_slider_crank

   !> A body without any joint falls.
   subroutine test_free_fall(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(integrator_t), allocatable :: method
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      integer :: status

      call start_text("[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl//"[bodies]"//nl// &
                      "name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl//"stone 2 0.1 1 3 0"//nl// &
                      "[analysis.dynamic]"//nl//"method = ida"//nl//"start = given"//nl//"end = 1 s"//nl, system, y, error)
      if (allocated(error)) return
      call find_integrator("ida", method)
      method%controls%tolerance = 1.0e-8_wp
      call method%start(system, 0.0_wp, y, 1.0_wp, status)
      do while (method%t < 1.0_wp .and. status >= 0)
         call method%advance(system, 1.0_wp, status)
      end do
      call check_equal(error, status, 0, "status")
      call check_close(error, method%step%y1(1:6), [1.0_wp, 3.0_wp - 0.5_wp*9.81_wp, 0.0_wp, 0.0_wp, -9.81_wp, 0.0_wp], 1.0e-6_wp, &
                       "state")
   end subroutine test_free_fall

end module test_ida_planar
