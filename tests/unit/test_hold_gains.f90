!> Gains of the stabilisation methods: what they are when a step starts, what they leave of a violation, which ways are
!> the same by them, and how they adapt.
module test_hold_gains
   use augmented_lagrangian, only: augmented_lagrangian_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t
   use free_four_bar, only: four_bar, run_four_bar
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use recorder, only: summary_t
   use scene_fixture, only: nl, start_text
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_hold_gains

   !> A rotor on its centre of mass: two rows, Phi = -r, linear in the coordinates.
   character(*), parameter :: rotor = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"rotor 2 0.05 0 0"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"seat ground 0 0"//nl//"hub rotor 0 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"axle seat hub"//nl//"[analysis.dynamic]"//nl//"coordinates = full"//nl// &
      "end = 1 s"//nl

contains

   subroutine run_test_hold_gains(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("gains", test_gains)
      call suite%test("what_a_step_leaves", test_what_a_step_leaves)
      call suite%test("lagrangian_is_baumgarte", test_lagrangian_is_baumgarte)
      call suite%test("adaptive_gain", test_adaptive_gain)
   end subroutine run_test_hold_gains

   !> Gains when a step of 1/64 s starts.
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
      real(wp) :: maximum, worst
      integer :: status

      call load_text(four_bar//"end = 3 s"//nl//"tolerance = 1e-6"//nl//"stabilise = baumgarte_adaptive target=1e-7"//nl, loaded, &
                     error)
      if (allocated(error)) return
      associate (system => loaded%system, method => loaded%method)
         ! out of place by 1e-4 m at first
         loaded%y(4) = loaded%y(4) + 1.0e-4_wp
         call system%begin_pace(0.0_wp, loaded%y, 3.0_wp)
         call method%start(system, 0.0_wp, loaded%y, 3.0_wp, status)
         maximum = 0.0_wp
         worst = 0.0_wp
         do while (method%t < 3.0_wp .and. .not. allocated(error))
            call method%advance(system, 3.0_wp, status)
            call check_true(error, status >= 0, "a step is made")
            maximum = max(maximum, system%linkage%solution%alpha*method%step%h)
            call check_close(error, system%linkage%solution%beta, system%linkage%solution%alpha, 0.0_wp, "critical damping")
            call check_true(error, system%linkage%solution%alpha >= 0.1_wp*kick, &
                            "the gain is at least a tenth of the crank's rate at first")
            if (method%t > 1.0_wp) worst = max(worst, maxval(system%linkage%solution%row_weight*abs(system%linkage%rows%phi)))
         end do
         call check_true(error, maximum <= 0.3_wp*(1.0_wp + 1.0e-12_wp), "gain times step "//to_text(maximum))
         call check_true(error, maximum > 0.25_wp, "the bound is reached")
         call check_true(error, worst < 3.0e-5_wp, "violation "//to_text(worst)//" after a second")
      end associate
   end subroutine test_adaptive_gain

end module test_hold_gains
