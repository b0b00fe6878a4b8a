!> The registered ways of holding the constraints: their gains, what they leave of a violation, and a free four-bar whose motion
!> is known from its energy.
module test_hold_kinds
   use augmented_lagrangian, only: augmented_lagrangian_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use hold_partitioning, only: hold_partitioning_t
   use hold_registry, only: n_hold_kinds
   use kinds, only: two_pi, wp
   use mechanism_energy, only: energy_of, energy_t
   use mechanism, only: mechanism_t
   use recorder, only: summary_t
   use scene_fixture, only: nl, start_text
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_hold_kinds

   real(wp), parameter :: crank = 0.2_wp, coupler = 0.4_wp, rocker = 0.4_wp, base = 0.25_wp  !! lengths of the four-bar [m]
   real(wp), parameter :: mass(3) = [1.0_wp, 2.25_wp, 2.0_wp]        !! (3) masses of crank, coupler, rocker [kg]
   real(wp), parameter :: inertia(3) = [0.30_wp, 2.00_wp, 1.35_wp]   !! (3) about their centres of mass [kg.m^2]
   real(wp), parameter :: speed = 10.0_wp                            !! of the crank at the start [rad/s]
   integer, parameter :: n_turn = 3                                  !! turns of the crank in a run

   !> A rotor on its centre of mass: two rows, Phi = -r, linear in the coordinates.
   character(*), parameter :: rotor = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rotor 2 0.05 0 0"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"seat ground 0 0"//nl//"hub rotor 0 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"axle seat hub"//nl//"[analysis.dynamic]"//nl//"coordinates = full"//nl// &
      "end = 1 s"//nl

   !> A four-bar without loads; the settings follow.
   character(*), parameter :: four_bar = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl// &
      "crank 1 0.3 0.1 0 0"//nl// &
      "coupler 2.25 2 0.2125 {0.5m*sqrt(0.4^2 - 0.025^2)} {atan2(sqrt(0.4^2 - 0.025^2), 0.025)}"//nl// &
      "rocker 2 1.35 0.2375 {0.5m*sqrt(0.4^2 - 0.025^2)} {atan2(sqrt(0.4^2 - 0.025^2), -0.025)}"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"far ground 0.25 0"//nl// &
      "heel crank -0.1 0"//nl//"throw crank 0.1 0"//nl//"near_end coupler -0.2 0"//nl//"far_end coupler 0.2 0"//nl// &
      "foot rocker -0.2 0"//nl//"head rocker 0.2 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"main base heel"//nl//"pin throw near_end"//nl//"top far_end head"//nl// &
      "pivot far foot"//nl//"[initial.speed]"//nl//"name joint speed[rad/s]"//nl//"kick main 10"//nl//"[analysis.dynamic]"//nl

contains

   subroutine run_test_hold_kinds(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("gains", test_gains)
      call suite%test("what_a_step_leaves", test_what_a_step_leaves)
      call suite%test("four_bar", test_four_bar)
      call suite%test("nothing_held", test_nothing_held)
      call suite%test("lagrangian_is_baumgarte", test_lagrangian_is_baumgarte)
      call suite%test("adaptive_gain", test_adaptive_gain)
      call suite%test("partition_follows", test_partition_follows)
      call suite%test("goes_on_bitwise", test_goes_on)
   end subroutine run_test_hold_kinds

   !> Gains when a step of 1/64 s begins.
   subroutine test_gains(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)

      call check_gains("none", 0.0_wp, 0.0_wp)
      call check_gains("projection", 0.0_wp, 0.0_wp)
      call check_gains("partitioning", 0.0_wp, 0.0_wp)
      call check_gains("baumgarte", 5.0_wp, 5.0_wp)
      call check_gains("baumgarte alpha=7s^-1 beta=0.5Hz", 7.0_wp, 0.5_wp)
      call check_gains("baumgarte_step", 64.0_wp, 64.0_wp*sqrt(2.0_wp))
      call check_gains("baumgarte_step alpha=0.25 beta=0.5", 16.0_wp, 32.0_wp)
      call check_gains("augmented_lagrangian", 10.0_wp, 10.0_wp)
      call check_gains("augmented_lagrangian omega=30s^-1 mu=0.5 penalty=1e7", 15.0_wp, 30.0_wp)
      if (allocated(error)) return
      call start_text(rotor//"stabilise = augmented_lagrangian penalty=1e7", system, y, error)
      if (allocated(error)) return
      call system%set_step(1.0_wp)
      select type (solver => system%linkage%solution%solver)
      type is (augmented_lagrangian_t)
         call check_close(error, solver%penalty, 1.0e7_wp, 0.0_wp, "penalty of the solver")
      class default
         call check_equal(error, solver%name(), "augmented_lagrangian", "solver of this way")
      end select

   contains

      !> Gains of one setting.
      subroutine check_gains(setting, alpha, beta)
         character(*), intent(in) :: setting  !! after `stabilise =`
         real(wp), intent(in) :: alpha        !! gain on the rate [1/s]
         real(wp), intent(in) :: beta         !! gain on the violation [1/s]

         type(mechanism_t) :: held
         real(wp), allocatable :: start(:)

         if (allocated(error)) return
         call start_text(rotor//"stabilise = "//setting, held, start, error)
         if (allocated(error)) return
         call held%set_step(0.015625_wp)
         call check_close(error, [held%linkage%solution%alpha, held%linkage%solution%beta], [alpha, beta], 1.0e-13_wp, &
                          "gains of "//setting, relative=.true.)
      end subroutine check_gains

   end subroutine test_gains

   !> A violation x and its rate v under Baumgarte's gains: one step of the classical Runge-Kutta method is multiplication of
   !> (x, h v) by R = 1 + Z + Z^2/2 + Z^3/6 + Z^4/24, Z = [ 0, 1; -(beta h)^2, -2 alpha h ]. The determinant of R is the product
   !> of its eigenvalues: 0.373^2 = 5/36 for gains 1/h and sqrt(2)/h, 0.375^2 = 9/64 for 1/h and 1/h.
   subroutine test_what_a_step_leaves(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_step("baumgarte_step", 1.0_wp, sqrt(2.0_wp), 5.0_wp/36.0_wp)
      call check_step("baumgarte_step alpha=1 beta=1", 1.0_wp, 1.0_wp, 9.0_wp/64.0_wp)
      call check_step("baumgarte alpha=100s^-1 beta=100s^-1", 1.0_wp, 1.0_wp, 9.0_wp/64.0_wp)
      call check_step("baumgarte alpha=5s^-1 beta=5s^-1", 0.05_wp, 0.05_wp, exp(-0.1_wp))

   contains

      !> Measure R from two violations and compare with the formula.
      subroutine check_step(setting, alpha, beta, determinant)
         character(*), intent(in) :: setting      !! after `stabilise =`
         real(wp), intent(in) :: alpha            !! gain on the rate, times the step [1]
         real(wp), intent(in) :: beta             !! gain on the violation, times the step [1]
         real(wp), intent(in) :: determinant      !! of R, to 1e-8 [1]

         real(wp), parameter :: h = 0.01_wp
         type(loaded_t) :: loaded
         real(wp) :: after(2, 2), before(2, 2), expected(2, 2), power(2, 2), r(2, 2), z(2, 2)
         integer :: k, status

         if (allocated(error)) return
         do k = 1, 2
            call load_text("deck = 1"//nl//rotor//"method = rk4"//nl//"step = 10 ms"//nl//"stabilise = "//setting//nl, loaded, &
                           error)
            if (allocated(error)) return
            loaded%y(merge(1, 4, k == 1)) = merge(1.0e-3_wp, 1.0e-3_wp/h, k == 1)
            call loaded%method%start(loaded%system, 0.0_wp, loaded%y, 1.0_wp, status)
            call check_equal(error, status, 0, "start")
            call loaded%method%advance(loaded%system, 1.0_wp, status)
            call check_true(error, status >= 0, "the first step")
            before(:, k) = loaded%method%step%y1([1, 4])*[1.0e3_wp, 1.0e3_wp*h]
            call loaded%method%advance(loaded%system, 1.0_wp, status)
            call check_true(error, status >= 0, "the second step")
            call check_close(error, loaded%method%t, 2.0_wp*h, 1.0e-15_wp, "length of the steps")
            after(:, k) = loaded%method%step%y1([1, 4])*[1.0e3_wp, 1.0e3_wp*h]
         end do
         ! R before = after
         r = matmul(after, reshape([before(2, 2), -before(2, 1), -before(1, 2), before(1, 1)], [2, 2])) &
             /(before(1, 1)*before(2, 2) - before(1, 2)*before(2, 1))
         z = reshape([0.0_wp, -beta**2, 1.0_wp, -2.0_wp*alpha], [2, 2])
         expected = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])
         power = expected
         do k = 1, 4
            power = matmul(power, z)/k
            expected = expected + power
         end do
         call check_close(error, [r], [expected], 1.0e-12_wp, "what a step leaves with "//setting)
         call check_close(error, r(1, 1)*r(2, 2) - r(1, 2)*r(2, 1), determinant, 1.0e-7_wp, "its determinant with "//setting)
      end subroutine check_step

   end subroutine test_what_a_step_leaves

   !> Inertia of the four-bar on its crank, I = 2 T/omega^2, at an angle of the crank.
   pure real(wp) function inertia_at(angle) result(reduced)
      real(wp), intent(in) :: angle  !! of the crank [rad]

      real(wp) :: a(2), along(2), d, f(2), h, turn_2, turn_3, v(2)

      a = crank*[cos(angle), sin(angle)]
      ! the end of coupler and rocker is one of two intersections of circles, the one that the deck assembles
      f = [base, 0.0_wp] - a
      d = norm2(f)
      along = f/d
      h = sqrt(coupler**2 - 0.25_wp*d**2)
      f = a + 0.5_wp*d*along + h*[-along(2), along(1)]
      ! v_a + turn_2 x (f - a) = turn_3 x (f - far end), per unit of the crank's rate
      v = [-a(2), a(1)]
      associate (p => f - a, q => f - [base, 0.0_wp])
         turn_2 = -(v(1)*q(1) + v(2)*q(2))/(p(1)*q(2) - p(2)*q(1))
         turn_3 = -(v(1)*p(1) + v(2)*p(2))/(p(1)*q(2) - p(2)*q(1))
         v = v + 0.5_wp*turn_2*[-p(2), p(1)]
      end associate
      reduced = inertia(1) + mass(1)*(0.5_wp*crank)**2 + mass(2)*dot_product(v, v) + inertia(2)*turn_2**2 &
                + (inertia(3) + mass(3)*(0.5_wp*rocker)**2)*turn_3**2
   end function inertia_at

   !> Time of a turn of the crank: the integral of the angle over the speed that the energy gives; the trapezoidal rule on a
   !> periodic function.
   real(wp) function time_of_turn() result(time)
      integer, parameter :: n = 2000
      integer :: k

      time = 0.0_wp
      do k = 0, n - 1
         time = time + sqrt(inertia_at(two_pi*k/n)/inertia_at(0.0_wp))/speed*(two_pi/n)
      end do
   end function time_of_turn

   !> Run the four-bar for whole turns.
   subroutine run_four_bar(settings, loaded, summary, error)
      character(*), intent(in) :: settings                  !! lines of [analysis.dynamic]
      type(loaded_t), intent(out) :: loaded                 !! deck, system and integrator at the end
      type(summary_t), intent(out) :: summary               !! cost and errors
      type(error_t), allocatable, intent(inout) :: error    !! first failure

      type(keeper_t) :: keeper

      if (allocated(error)) return
      call load_text(four_bar//"end = 10 s"//nl//settings//nl, loaded, error)
      if (allocated(error)) return
      loaded%plan%end = n_turn*time_of_turn()
      call run_to_end(loaded, keeper, summary, error)
   end subroutine run_four_bar

   !> Every way: the crank has made whole turns when the energy says so, the violation and the ledger keep their limits.
   subroutine test_four_bar(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: by_verner = nl//"tolerance = 1e-11", by_steps = nl//"method = rk4"//nl//"step = 0.1 ms"
      integer :: n_way

      n_way = 0
      ! limits: angle [rad], violation [m], work of the stabilisation as a part of the energy [1]
      call check_way("none"//by_verner, 1.0e-7_wp, 1.0e-7_wp, 1.0e-6_wp)
      call check_way("baumgarte alpha=20s^-1 beta=20s^-1"//by_verner, 1.0e-7_wp, 1.0e-9_wp, 1.0e-7_wp)
      call check_way("baumgarte_step alpha=0.1 beta=0.1"//by_steps, 1.0e-6_wp, 1.0e-8_wp, 1.0e-5_wp)
      call check_way("baumgarte_adaptive target=1e-9"//by_verner, 1.0e-7_wp, 1.0e-9_wp, 1.0e-7_wp)
      call check_way("augmented_lagrangian omega=20s^-1"//by_verner, 1.0e-7_wp, 1.0e-9_wp, 1.0e-7_wp)
      call check_way("partitioning"//by_verner, 1.0e-7_wp, 1.0e-12_wp, 1.0e-7_wp)
      call check_way("projection"//by_verner, 1.0e-7_wp, 1.0e-12_wp, 1.0e-7_wp)
      call check_way("projection"//by_steps, 1.0e-6_wp, 1.0e-12_wp, 1.0e-5_wp)
      call check_equal(error, n_way, n_hold_kinds + 1, "ways that were looked at, one of them twice")

   contains

      !> One way.
      subroutine check_way(setting, angle_limit, violation_limit, work_limit)
         character(*), intent(in) :: setting           !! after `stabilise =`
         real(wp), intent(in) :: angle_limit           !! of the crank's angle at the end [rad]
         real(wp), intent(in) :: violation_limit       !! at all samples [m]
         real(wp), intent(in) :: work_limit            !! of the stabilisation, of the energy [1]

         type(energy_t) :: energy
         type(loaded_t) :: loaded
         type(summary_t) :: summary

         call run_four_bar("stabilise = "//setting, loaded, summary, error)
         if (allocated(error)) return
         n_way = n_way + 1
         energy = energy_of(loaded%system, loaded%method%step%y1)
         call check_close(error, loaded%method%step%y1(3), n_turn*two_pi, angle_limit, "angle of the crank with "//setting)
         call check_true(error, summary%quality%violation_max <= violation_limit, "violation "// &
                         to_text(summary%quality%violation_max)//" with "//setting//" keeps its limit")
         call check_true(error, abs(energy%stabilisation_work) <= work_limit*energy%kinetic, "work "// &
                         to_text(energy%stabilisation_work)//" of the stabilisation with "//setting//" keeps its limit")
         call check_true(error, summary%quality%energy_residual_max <= 10.0_wp*work_limit*energy%kinetic, &
                         "the ledger closes with "//setting)
      end subroutine check_way

   end subroutine test_four_bar

   !> Without anything the violation grows with time: after four times the time it is more than four times as large.
   subroutine test_nothing_held(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper(2)
      type(loaded_t), allocatable :: loaded(:)
      type(summary_t) :: summary(2)
      integer :: k

      allocate (loaded(2))
      do k = 1, 2
         call load_text(four_bar//"end = 2 s"//nl//"stabilise = none"//nl//"method = rk4"//nl//"step = 1 ms"//nl, loaded(k), error)
         if (allocated(error)) return
         if (k == 1) loaded(k)%plan%end = 0.5_wp
         call run_to_end(loaded(k), keeper(k), summary(k), error)
         if (allocated(error)) return
      end do
      call check_true(error, summary(1)%quality%violation_max > 1.0e-12_wp, "there is a violation")
      call check_true(error, summary(2)%quality%violation_max > 4.0_wp*summary(1)%quality%violation_max, &
                      "it grows faster than time")
   end subroutine test_nothing_held

   !> The converged iteration with penalties is Baumgarte's stabilisation with alpha = omega mu, beta = omega.
   subroutine test_lagrangian_is_baumgarte(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: ways(2) = [character(50) :: "augmented_lagrangian omega=25s^-1 mu=0.8", &
                                            "baumgarte alpha=20s^-1 beta=25s^-1"]
      type(loaded_t), allocatable :: loaded(:)
      type(summary_t) :: summary(2)
      integer :: k

      allocate (loaded(2))
      do k = 1, 2
         call run_four_bar("method = rk4"//nl//"step = 1 ms"//nl//"stabilise = "//trim(ways(k)), loaded(k), summary(k), error)
         if (allocated(error)) return
      end do
      call check_close(error, loaded(1)%method%step%y1(:18), loaded(2)%method%step%y1(:18), 1.0e-8_wp, "state at the end", &
                       relative=.true.)
      call check_close(error, summary(1)%quality%violation_max, summary(2)%quality%violation_max, 1.0e-10_wp, "greatest violation")
   end subroutine test_lagrangian_is_baumgarte

   !> Gain times step never exceeds 0.3, also where the violation asks for more; the violation goes down from 5e-4 of the size.
   subroutine test_adaptive_gain(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: kick = 10.0_wp  ! rate of the crank at the start [rad/s]
      type(loaded_t) :: loaded
      real(wp) :: greatest, worst
      integer :: status

      call load_text(four_bar//"end = 3 s"//nl//"tolerance = 1e-6"//nl//"stabilise = baumgarte_adaptive target=1e-7"//nl, loaded, &
                     error)
      if (allocated(error)) return
      associate (system => loaded%system, method => loaded%method)
         ! out of place by 1e-4 m at first
         loaded%y(4) = loaded%y(4) + 1.0e-4_wp
         call system%begin_pace(0.0_wp, loaded%y, 3.0_wp)
         call method%start(system, 0.0_wp, loaded%y, 3.0_wp, status)
         greatest = 0.0_wp
         worst = 0.0_wp
         do while (method%t < 3.0_wp .and. .not. allocated(error))
            call method%advance(system, 3.0_wp, status)
            call check_true(error, status >= 0, "a step is made")
            greatest = max(greatest, system%linkage%solution%alpha*method%step%h)
            call check_close(error, system%linkage%solution%beta, system%linkage%solution%alpha, 0.0_wp, "critical damping")
            call check_true(error, system%linkage%solution%alpha >= 0.1_wp*kick, &
                            "the gain is at least a tenth of the crank's rate at first")
            if (method%t > 1.0_wp) worst = max(worst, maxval(system%linkage%solution%row_weight*abs(system%linkage%rows%phi)))
         end do
         call check_true(error, greatest <= 0.3_wp*(1.0_wp + 1.0e-12_wp), "gain times step "//to_text(greatest))
         call check_true(error, greatest > 0.25_wp, "the bound is reached")
         call check_true(error, worst < 3.0e-5_wp, "violation "//to_text(worst)//" after a second")
      end associate
   end subroutine test_adaptive_gain

   !> A free slider-crank through both dead centres: where the slider stands still it cannot stand for the crank. The dependent
   !> coordinates are chosen anew, and nothing is seen of that in energy or violation.
   subroutine test_partition_follows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded
      type(energy_t) :: energy
      integer, allocatable :: before(:)
      real(wp) :: kinetic, worst
      integer :: n_change, status

      call load_text("deck = 1"//nl//"[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad]"//nl// &
                     "crank 0.3 1e-4 0 0.025 {90 deg}"//nl// &
                     "rod 0.2 2e-4 {0.5m*sqrt(0.12^2 - 0.05^2)} 0.025 {-asin(0.05/0.12)}"//nl// &
                     "slider 0.2 1e-4 {1m*sqrt(0.12^2 - 0.05^2)} 0 0"//nl// &
                     "[points]"//nl//"name body xi[mm] eta[mm]"//nl//"main ground 0 0"//nl//"heel crank -25 0"//nl// &
                     "throw crank 25 0"//nl//"big rod -60 0"//nl//"small rod 60 0"//nl//"pin slider 0 0"//nl// &
                     "[joint.revolute]"//nl//"name i j"//nl//"bearing main heel"//nl//"big_end throw big"//nl// &
                     "gudgeon small pin"//nl// &
                     "[joint.translational]"//nl//"name i j axis"//nl//"guide main pin x"//nl// &
                     "[initial.speed]"//nl//"name joint speed[rad/s]"//nl//"kick bearing 60"//nl// &
                     "[analysis.dynamic]"//nl//"end = 0.5 s"//nl//"tolerance = 1e-10"//nl// &
                     "stabilise = partitioning"//nl, loaded, error)
      if (allocated(error)) return
      associate (system => loaded%system, method => loaded%method)
         call method%start(system, 0.0_wp, loaded%y, 0.5_wp, status)
         energy = energy_of(system, loaded%y)
         kinetic = energy%kinetic
         n_change = 0
         worst = 0.0_wp
         ! as if the place of the slider had been chosen to stand for all
         select type (way => system%way)
         type is (hold_partitioning_t)
            way%order = [1, 2, 3, 4, 5, 6, 8, 9, 7]
            before = way%order
            way%rank = 8
            way%quality = 0.1_wp
         end select
         do while (method%t < 0.5_wp .and. .not. allocated(error))
            call method%advance(system, 0.5_wp, status)
            call check_true(error, status >= 0, "a step is made")
            select type (way => system%way)
            type is (hold_partitioning_t)
               call check_equal(error, way%rank, 8, "dependent coordinates")
               if (any(before /= way%order)) n_change = n_change + 1
               before = way%order
            end select
            worst = max(worst, maxval(system%linkage%solution%row_weight*abs(system%linkage%rows%phi)))
         end do
         call check_true(error, n_change >= 1, "coordinates are sorted anew, "//to_text(n_change)//" times")
         call check_true(error, worst < 1.0e-12_wp, "violation "//to_text(worst))
         energy = energy_of(system, method%step%y1)
         call check_close(error, energy%kinetic, kinetic, 1.0e-6_wp*kinetic, "energy at the end")
         call check_true(error, method%step%y1(3) > 2.0_wp*two_pi, "several turns")
      end associate
   end subroutine test_partition_follows

   !> Saved in the middle, loaded into fresh objects and gone on with, a run is equal bit for bit.
   subroutine test_goes_on(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_restart("baumgarte_adaptive")
      call check_restart("partitioning")
      call check_restart("baumgarte_step alpha=0.1 beta=0.1"//nl//"method = rk4"//nl//"step = 1 ms")

   contains

      !> One way.
      subroutine check_restart(setting)
         character(*), intent(in) :: setting  !! after `stabilise =`

         type(loaded_t), allocatable :: runs(:)
         real(wp), allocatable :: row(:)
         integer :: k, place, status

         allocate (runs(2))
         if (allocated(error)) return
         do k = 1, 2
            call load_text(four_bar//"end = 1 s"//nl//"stabilise = "//setting//nl, runs(k), error)
            if (allocated(error)) return
            call runs(k)%method%start(runs(k)%system, 0.0_wp, runs(k)%y, 1.0_wp, status)
         end do
         call go_to(runs(1), 0.4_wp)
         if (allocated(error)) return
         associate (first => runs(1), second => runs(2))
            allocate (row(first%method%memory_size() + first%system%memory_size()), source=0.0_wp)
            place = 0
            call first%method%save(row, place)
            call first%system%save(row, place)
            call check_equal(error, place, size(row), "numbers saved with "//setting)
            place = 0
            call second%method%load(row, place)
            call second%system%load(row, place)
            call check_equal(error, place, size(row), "numbers loaded with "//setting)
            call go_to(first, 1.0_wp)
            call go_to(second, 1.0_wp)
            if (allocated(error)) return
            call check_close(error, second%method%step%y1, first%method%step%y1, 0.0_wp, "state at the end with "//setting)
            call check_equal(error, int(second%method%count%n_steps), int(first%method%count%n_steps), "steps with "//setting)
         end associate
      end subroutine check_restart

      !> Steps until a time is passed.
      subroutine go_to(run, t)
         type(loaded_t), intent(inout) :: run  !! the run
         real(wp), intent(in) :: t             !! the time [s]

         integer :: status

         do while (run%method%t < t .and. .not. allocated(error))
            call run%method%advance(run%system, 1.0_wp, status)
            call check_true(error, status >= 0, "a step is made with "//run%system%way%words())
         end do
      end subroutine go_to

   end subroutine test_goes_on

end module test_hold_kinds
