!> The energy ledger: its powers are those of the equations at any state, its energies those of the bodies.
module test_ledger
   use check, only: check_close, check_equal, check_true, suite_t
   use contact_places, only: work_drive, work_load, work_stabilisation
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: i8, wp
   use mechanism_energy, only: energy_of, energy_t
   use mechanism, only: mechanism_t
   use scene_fixture, only: channel_of, nl, slider_crank, start_text, system_of_text
   implicit none (type, external)
   private
   public :: run_test_ledger

contains

   subroutine run_test_ledger(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("powers_on_the_constraints", test_powers_on_the_constraints)
      call suite%test("powers_off_the_constraints", test_powers_off_the_constraints)
      call suite%test("powers_in_contact", test_powers_in_contact)
      call suite%test("powers_of_loads", test_powers_of_loads)
      call suite%test("energies", test_energies)
      call suite%test("without_ledger", test_without_ledger)
   end subroutine run_test_ledger

   !> Rate of kinetic and potential energy from the accelerations.
   real(wp) function mechanical_rate(system, y, ydot) result(rate)
      type(mechanism_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: y(:)                 !! (n) state [any]
      real(wp), intent(in) :: ydot(:)              !! (n) its derivative [any]

      integer :: k, q, v

      rate = 0.0_wp
      do k = 1, system%linkage%bodies%n
         q = 3*k - 2
         v = 3*system%linkage%bodies%n + q
         rate = rate + system%linkage%bodies%mass(k)*dot_product(y(v:v + 1), ydot(v:v + 1) - system%loading%gravity(1:2)) &
                + system%linkage%bodies%inertia(k)*y(v + 2)*ydot(v + 2)
      end do
   end function mechanical_rate

   !> What comes in by drivers, loads and stabilisation is what the bodies and contacts gain and what is lost.
   subroutine check_powers(error, system, t, y, what)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      type(mechanism_t), intent(inout) :: system       !! the system
      real(wp), intent(in) :: t                            !! time [s]
      real(wp), intent(in) :: y(:)                         !! (n) state [any]
      character(*), intent(in) :: what                     !! for messages

      real(wp) :: change, elastic(1), f(1), gained, scale, unused(1), unused_too(1), ydot(size(y)), z(size(y))
      real(wp) :: balance(4), delta(system%clearance_joints%n_contact), rate(system%clearance_joints%n_contact)
      type(energy_t) :: energy
      integer :: i, k, last, m, n, status

      if (allocated(error)) return
      call system%evaluate(t, y, ydot, status)
      call check_equal(error, status, 0, what//": status")
      n = 6*system%linkage%bodies%n
      last = system%place_of_impulse(0)
      gained = mechanical_rate(system, y, ydot)
      scale = abs(gained)
      if (system%clearance_joints%n > 0) call system%events(t, y, delta, rate)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               ! event functions of touching contacts are the negatives of penetrations
               m = set%before%contacts + i
               call set%laws%normal%force(1, -delta(m:m), -rate(m:m), &
                                  set%contact(i:i)%impact_speed, set%laws%parameters(:, i:i), f, unused, unused_too, elastic)
               gained = gained - elastic(1)*rate(m)
               call check_close(error, ydot(system%place_of_impulse(m)), f(1), 1.0e-12_wp*abs(f(1)), what//": normal force")
               scale = scale + abs(elastic(1)*rate(m))
            end do
         end associate
      end do
      scale = scale + sum(abs(ydot(n + 1:last)))
      call check_close(error, gained + sum(ydot(n + 4:last)), sum(ydot(n + 1:n + 3)), 1.0e-11_wp*scale, what//": powers")
      ! the same of the energies that are reported, along the derivative
      change = 1.0e-7_wp
      do k = 1, 4
         z = y + places(k)*change*ydot
         call system%linkage%set_motion(0.0_wp, z)
         energy = energy_of(system, z)
         balance(k) = energy%balance()
      end do
      call check_close(error, five_point(balance, change), 0.0_wp, 1.0e-8_wp*scale, what//": balance of the energies")
   end subroutine check_powers

   !> The assembled slider-crank: the driver's power is all there is.
   subroutine test_powers_on_the_constraints(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:), ydot(:)
      integer :: status

      call start_text(slider_crank("", "damped", "none", "ideal"), system, y, error)
      if (allocated(error)) return
      call check_powers(error, system, 0.0_wp, y, "assembled")
      ydot = y
      call system%evaluate(0.0_wp, y, ydot, status)
      call check_true(error, abs(ydot(18 + work_drive)) > 100.0_wp, "the driver works")
      call check_close(error, ydot(18 + work_stabilisation), 0.0_wp, 1.0e-10_wp*abs(ydot(18 + work_drive)), &
                       "no work on a drift that is not there")
      call check_close(error, ydot(18 + work_load), 0.0_wp, 0.0_wp, "no loads")
   end subroutine test_powers_on_the_constraints

   !> Random states that violate positions and velocities, with strong stabilisation and with none.
   subroutine test_powers_off_the_constraints(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: gains(2) = ["stabilise = none                              ", &
                                             "stabilise = baumgarte alpha=50s^-1 beta=80s^-1"]
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: start(:), y(:), ydot(:)
      integer :: k, gain, status

      random%state = 21_i8
      do gain = 1, 2
         call start_text(slider_crank(gains(gain), "damped", "none", "ideal"), system, start, error)
         if (allocated(error)) return
         do k = 1, 10
            y = start
            y(1:9) = y(1:9) + random%vector(9, -2.0e-3_wp, 2.0e-3_wp)
            y(10:18) = y(10:18) + random%vector(9, -5.0_wp, 5.0_wp)
            call check_powers(error, system, 1.0e-5_wp, y, "violated")
         end do
         ydot = y
         call system%evaluate(1.0e-5_wp, y, ydot, status)
         call check_true(error, abs(ydot(18 + work_stabilisation)) > 1.0_wp, "there is work on the drift")
      end do
   end subroutine test_powers_off_the_constraints

   !> A touching gudgeon pin, damped and elastic, with and without friction.
   subroutine test_powers_in_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: laws(2) = ["hertz ", "damped"], frictions(2) = ["none   ", "rubbing"]
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: start(:), y(:)
      integer :: friction, k, law

      random%state = 22_i8
      do law = 1, 2
         do friction = 1, 2
            call start_text(slider_crank("", laws(law), frictions(friction), "clearance"), system, start, error)
            if (allocated(error)) return
            call system%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 6.0_wp, 0.0_wp)
            do k = 1, 10
               y = start
               ! the slider is the bearing: moved back along its guide by clearance and penetration
               y(7) = y(7) - 0.5e-3_wp - random%between(5.0e-6_wp, 3.0e-5_wp)
               y(10:18) = y(10:18) + random%vector(9, -1.0_wp, 1.0_wp)
               call check_powers(error, system, 0.0_wp, y, "contact "//laws(law)//" "//frictions(friction))
            end do
            call check_true(error, sum(abs(system%clearance_joints%integrands(1, :))) > 0.0_wp .eqv. law == 2, "damping works")
            call check_true(error, sum(abs(system%clearance_joints%integrands(2, :))) > 0.0_wp .eqv. friction == 2, &
                            "friction works")
         end do
      end do
   end subroutine test_powers_in_contact

   !> Gravity, a point force, a torque and an accelerating driver together.
   subroutine test_powers_of_loads(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: y(:), ydot(:)
      integer :: k, status

      call system_of_text("[scene]"//nl//"gravity = 2 -9.81 m/s^2"//nl// &
                          "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl// &
                          "upper 2 0.05 0.4 0.1"//nl//"lower 1 0.03 0.9 0.1"//nl// &
                          "[points]"//nl//"name body xi[m] eta[m]"//nl//"hook ground 0 0"//nl// &
                          "eye upper -0.4 -0.1"//nl//"elbow upper 0.3 0"//nl//"arm lower -0.2 0.1"//nl// &
                          "hand lower 0.3 0.05"//nl// &
                          "[joint.revolute]"//nl//"name i j"//nl//"shoulder hook eye"//nl//"bend elbow arm"//nl// &
                          "[driver.angle]"//nl//"name joint angle"//nl//"muscle bend {0.3 rad*sin(7 rad/s*t)}"//nl// &
                          "[force.point]"//nl//"name point fx fy"//nl//"push hand {4 N + 2 N/s*t} {-3 N*cos(2 rad/s*t)}"//nl// &
                          "[force.torque]"//nl//"name body moment"//nl//"twist upper {0.6 N.m*sin(3 rad/s*t)}"//nl// &
                          "[analysis.dynamic]"//nl//"coordinates = full"//nl//"end = 1 s", system, error)
      if (allocated(error)) return
      allocate (y(system%n), ydot(system%n), source=0.0_wp)
      random%state = 23_i8
      do k = 1, 20
         y(1:12) = random%vector(12, -1.0_wp, 1.0_wp)
         call check_powers(error, system, 0.1_wp*k, y, "loads")
         call system%evaluate(0.1_wp*k, y, ydot, status)
         call check_true(error, minval(abs(ydot(13:15))) > 1.0e-6_wp, "all of them work")
         call check_close(error, channel_of(system, 0.1_wp*k, y, "push", "power") &
                          + channel_of(system, 0.1_wp*k, y, "twist", "power"), ydot(12 + work_load), 1.0e-13_wp, "power of loads")
         call check_close(error, channel_of(system, 0.1_wp*k, y, "muscle", "power"), ydot(12 + work_drive), &
                          1.0e-13_wp*abs(ydot(12 + work_drive)), "power of the driver")
      end do
   end subroutine test_powers_of_loads

   !> Energies of a body by hand; works and losses are taken from the state.
   subroutine test_energies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      type(energy_t) :: energy
      real(wp), allocatable :: y(:)

      call start_text(slider_crank("", "damped", "none", "clearance"), system, y, error)
      if (allocated(error)) return
      y(1:9) = 0.0_wp
      y(10:18) = 0.0_wp
      y(5) = 2.0_wp
      y(13:15) = [3.0_wp, 4.0_wp, 10.0_wp]
      y(19:24) = [1.0_wp, 20.0_wp, 300.0_wp, 6.0e5_wp, 4000.0_wp, 50000.0_wp]
      call system%linkage%set_motion(0.0_wp, y)
      energy = energy_of(system, y)
      call check_close(error, energy%kinetic, 0.5_wp*(0.21_wp*25.0_wp + 2.5e-4_wp*100.0_wp), 1.0e-14_wp, "kinetic")
      call check_close(error, energy%potential, 0.21_wp*9.81_wp*2.0_wp, 1.0e-14_wp, "potential")
      call check_close(error, energy%elastic, 0.0_wp, 0.0_wp, "elastic")
      call check_close(error, [energy%drive_work, energy%load_work, energy%stabilisation_work, energy%dissipated_damper, &
                               energy%dissipated_contact, energy%dissipated_friction], y(19:24), 0.0_wp, "works and losses")
      call check_close(error, energy%mechanical(), energy%kinetic + energy%potential, 0.0_wp, "mechanical")
      call check_close(error, energy%balance(), energy%mechanical() - 321.0_wp + 654000.0_wp, 1.0e-10_wp, "balance")
   end subroutine test_energies

   !> Without a ledger the motion is the very same, and there are no quadratures.
   subroutine test_without_ledger(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: bare, system
      real(wp), allocatable :: y(:), y_bare(:), ydot(:), ydot_bare(:)
      type(energy_t) :: energy
      integer :: status

      call start_text(slider_crank("", "damped", "none", "clearance"), system, y, error)
      if (allocated(error)) return
      call start_text(slider_crank("ledger = off", "damped", "none", "clearance"), bare, y_bare, error)
      if (allocated(error)) return
      call check_equal(error, bare%n, 18 + 1, "entries of the state: an impulse")
      call check_equal(error, system%n, 18 + 4 + 2 + 1, "entries with a ledger")
      call check_equal(error, system%n_quadrature, 7, "quadratures")
      ydot = y
      ydot_bare = y_bare
      call system%evaluate(0.0_wp, y, ydot, status)
      call bare%evaluate(0.0_wp, y_bare, ydot_bare, status)
      call check_close(error, ydot_bare(1:18), ydot(1:18), 0.0_wp, "derivative")
      energy = energy_of(bare, y_bare)
      call check_close(error, energy%balance(), energy%mechanical(), 0.0_wp, "no works in the balance")
   end subroutine test_without_ledger

end module test_ledger
