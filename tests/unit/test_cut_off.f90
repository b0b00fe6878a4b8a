!> The ledger of contacts whose force is cut off while the surfaces still overlap.
module test_cut_off
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use kinds, only: wp
   use recorder, only: summary_t
   implicit none (type, external)
   private
   public :: run_test_cut_off

   character(*), parameter :: nl = new_line("a")

   !> A ball of 0.5 kg before a wall, at 2 m/s; a spring and a dashpot that would give 0.2 if it pulled.
   character(*), parameter :: ball = "deck = 1"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]"//nl//"ball 0.5 1e-4 0 0 2"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"wall ground 0.011 0"//nl//"centre ball 0 0"//nl// &
      "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
      "[clearance.plane]"//nl//"name plane ball axis axis_angle[deg] radius[mm] material law"//nl// &
      "stop wall centre x 180 10 steel law"//nl// &
      "[contact.kelvin_voigt]"//nl//"name stiffness[N/m] restitution form"//nl//"law 2e6 0.2 dashpot"//nl
   character(*), parameter :: methods(5) = [character(6) :: "verner", "dop853", "adams", "bdf", "ida"]
   real(wp), parameter :: mass = 0.5_wp, speed = 2.0_wp, gap = 1.0e-3_wp, stiffness = 2.0e6_wp  !! [kg, m/s, m, N/m]

contains

   subroutine run_test_cut_off(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("dashpot_that_does_not_pull", test_dashpot)
      call suite%test("force_that_comes_back", test_comes_back)
      call suite%test("end_without_a_force", test_end)
   end subroutine run_test_cut_off

   !> Run the ball by a method.
   subroutine run_ball(method, more, end, keeper, summary, error)
      character(*), intent(in) :: method                   !! word of the deck
      character(*), intent(in) :: more                     !! tables beside those of the ball
      character(*), intent(in) :: end                      !! of the run, with unit
      type(keeper_t), intent(out) :: keeper                !! what was kept
      type(summary_t), intent(out) :: summary              !! cost and errors
      type(error_t), allocatable, intent(out) :: error     !! the run failed

      type(loaded_t) :: loaded

      call load_text(ball//more//"[analysis.dynamic]"//nl//"start = given"//nl//"tolerance = 1e-10"//nl//"method = "//method//nl// &
                     "end = "//end//nl, loaded, error)
      if (.not. allocated(error)) call run_to_end(loaded, keeper, summary, error)
   end subroutine run_ball

   !> zeta of the dashpot and e = exp(-2 psi cot psi), cos psi = zeta: the force is zero at the time 2 psi/omega_d.
   !> Source: Schwager and Poeschel, Granular Matter 9 (2007) 465.
   pure subroutine find_restitution(zeta, e)
      real(wp), intent(out) :: zeta  !! damping ratio [1]
      real(wp), intent(out) :: e     !! speed after over speed before [1]

      zeta = -log(0.2_wp)/sqrt(acos(-1.0_wp)**2 + log(0.2_wp)**2)
      e = exp(-2.0_wp*acos(zeta)*zeta/sqrt(1.0_wp - zeta**2))
   end subroutine find_restitution

   !> What an impact takes, and the books at every step of it.
   subroutine test_dashpot(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: e, energy, zeta
      integer :: k

      call find_restitution(zeta, e)
      energy = 0.5_wp*mass*speed**2
      do k = 1, size(methods)
         call run_ball(trim(methods(k)), "", "5 ms", keeper, summary, error)
         call check_equal(error, keeper%n_event, 1, trim(methods(k))//": impacts")
         if (allocated(error)) return
         call check_close(error, keeper%events(1)%release_speed, e*speed, 1.0e-7_wp*speed, trim(methods(k))//": speed after")
         call check_close(error, keeper%events(1)%energy_lost, (1.0_wp - e**2)*energy, 1.0e-7_wp*energy, trim(methods(k))//": lost")
         call check_true(error, summary%quality%energy_residual_max < 1.0e-7_wp*energy, trim(methods(k))//": the ledger is closed")
      end do
   end subroutine test_dashpot

   !> A load that presses the ball on again, while it parts without a force: it comes back, and is cut off once more.
   subroutine test_comes_back(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: e, energy, zeta
      character(24) :: words
      integer :: k

      call find_restitution(zeta, e)
      energy = 0.5_wp*mass*speed**2
      write (words, "(es23.16)") gap/speed + 2.2_wp*acos(zeta)/sqrt((1.0_wp - zeta**2)*stiffness/mass)
      do k = 1, size(methods)
         call run_ball(trim(methods(k)), "[force.point]"//nl//"name point fx"//nl// &
                       "push centre {4000 N*step(t - "//trim(adjustl(words))//" s)}"//nl, "30 ms", keeper, summary, error)
         call check_equal(error, keeper%n_event, 1, trim(methods(k))//": impacts")
         if (allocated(error)) return
         call check_true(error, summary%quality%energy_residual_max < 1.0e-7_wp*energy, trim(methods(k))//": the ledger is closed")
      end do
   end subroutine test_comes_back

   !> The run ends while there is no force: what is stored then is not lost yet.
   subroutine test_end(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: delta, e, energy, t_cut, zeta
      character(24) :: words
      integer :: k

      call find_restitution(zeta, e)
      energy = 0.5_wp*mass*speed**2
      t_cut = 2.0_wp*acos(zeta)/sqrt((1.0_wp - zeta**2)*stiffness/mass)
      delta = 2.0_wp*zeta*sqrt(mass/stiffness)*e*speed  ! where K delta = C e v
      write (words, "(es23.16)") gap/speed + t_cut + 0.25_wp*delta/(e*speed)
      do k = 1, size(methods)
         call run_ball(trim(methods(k)), "", words//" s", keeper, summary, error)
         call check_equal(error, keeper%n_event, 1, trim(methods(k))//": impacts")
         if (allocated(error)) return
         call check_close(error, keeper%events(1)%energy_lost, &
                          (1.0_wp - e**2)*energy - 0.5_wp*stiffness*(0.75_wp*delta)**2, 1.0e-7_wp*energy, &
                          trim(methods(k))//": lost")
         call check_true(error, summary%quality%energy_residual_max < 1.0e-7_wp*energy, trim(methods(k))//": the ledger is closed")
      end do
   end subroutine test_end

end module test_cut_off
