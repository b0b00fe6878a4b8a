!> Ways of meeting an onset: a ball that falls 0.9 m onto its bearing, against what parabolas say.
module test_contact_onset
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use integrator, only: advance_event
   use kinds, only: wp
   use recorder, only: summary_t
   use scene_fixture, only: nl, slider_crank
   implicit none (type, external)
   private
   public :: run_test_contact_onset

   real(wp), parameter :: g = 9.81_wp                         !! free fall [m/s^2]
   real(wp), parameter :: fall = 0.9_wp                       !! of the ball [m]
   real(wp), parameter :: stiffness = 47955419461.894104_wp   !! of a steel ball of 0.1 m on a steel plane [N/m^1.5]

contains

   subroutine run_test_contact_onset(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("located", test_located)
      call suite%test("interpolated", test_interpolated)
      call suite%test("interpolated_onto_the_constraints", test_mended)
      call suite%test("rejected", test_rejected)
      call suite%test("uncontrolled", test_uncontrolled)
      call suite%test("energy_of_the_first_penetration", test_energy)
      call suite%test("slider_crank_in_every_way", test_slider_crank)
      call suite%test("goes_on_from_a_checkpoint", test_checkpoint)
   end subroutine run_test_contact_onset

   !> A ball of 1 kg, loose in a hole by the height that it falls. The first contact is over at the end.
   subroutine drop(settings, law, keeper, summary, error)
      character(*), intent(in) :: settings                  !! lines of [analysis.dynamic]
      character(*), intent(in) :: law                       !! damped or elastic
      type(keeper_t), intent(out) :: keeper                 !! its contacts
      type(summary_t), intent(out) :: summary               !! how it went
      type(error_t), allocatable, intent(inout) :: error    !! first failure

      type(loaded_t) :: loaded

      if (allocated(error)) return
      call load_text("deck = 1"//nl//"[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
                     "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]"//nl//"ball 1 0.1 0 0 0"//nl// &
                     "[points]"//nl//"name body xi[m] eta[m]"//nl//"hole ground 0 0"//nl//"pin ball 0 0"//nl// &
                     "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
                     "[clearance.revolute]"//nl//"name bearing journal bearing_radius[m] clearance[m] material law"//nl// &
                     "bounce hole pin 1.0 0.9 steel "//law//nl// &
                     "[contact.lankarani_nikravesh]"//nl//"name restitution stiffness[N/m^1.5]"//nl// &
                     "damped 0.9 47955419461.894104"//nl// &
                     "[contact.hertz]"//nl//"name stiffness[N/m^1.5]"//nl//"elastic 47955419461.894104"//nl// &
                     "[analysis.dynamic]"//nl//"end = 0.44 s"//nl//settings//nl, loaded, error)
      if (.not. allocated(error)) call run_to_end(loaded, keeper, summary, error)
      call check_equal(error, keeper%n_event, 1, "one contact in "//settings)
   end subroutine drop

   !> Against the independent solution: onset, speed, peak force, depth, duration, rebound, loss.
   subroutine test_located(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary

      call drop("tolerance = 1e-12", "damped", keeper, summary, error)
      if (allocated(error)) return
      associate (row => keeper%events(1))
         call check_close(error, [row%time, row%impact_speed, row%peak_force, row%peak_penetration, row%duration, &
                                  row%release_speed, row%energy_lost], &
                          [0.4283529368781193_wp, 4.2021423107743505_wp, 114450.88137760991_wp, 0.0001776806435798626_wp, &
                           0.00013027385067422998_wp, 3.837209858023114_wp, 1.466910252745116_wp], 1.0e-9_wp, "first contact", &
                          relative=.true.)
      end associate
   end subroutine test_located

   !> Linear interpolation between the ends of the step: time and speed as parabolas have them, an error of second order.
   subroutine test_interpolated(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: steps(3) = [character(5) :: "20 us", "10 us", "5 us"]
      real(wp), parameter :: length(3) = [20.0e-6_wp, 10.0e-6_wp, 5.0e-6_wp]
      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: deep, place, start, t_exact
      integer :: k

      t_exact = sqrt(2.0_wp*fall/g)
      do k = 1, size(steps)
         call drop("method = rk4"//nl//"contact_onset = interpolate"//nl//"step = "//steps(k), "damped", keeper, summary, error)
         if (allocated(error)) return
         start = floor(t_exact/length(k))*length(k)
         deep = 0.5_wp*g*start**2 - fall
         place = deep/(deep - (0.5_wp*g*(start + length(k))**2 - fall))
         call check_close(error, keeper%events(1)%time, start + place*length(k), 2.0e-12_wp, "time, interpolated")
         call check_close(error, keeper%events(1)%impact_speed, g*(start + place*length(k)), 2.0e-11_wp, "speed, interpolated")
         call check_true(error, abs(keeper%events(1)%time - t_exact) <= g*length(k)**2/(8.0_wp*g*t_exact) + 2.0e-12_wp, &
                         "time of second order")
      end do
   end subroutine test_interpolated

   !> The state between two states on the constraints is not on them: it is projected, though the deck holds them by gains.
   subroutine test_mended(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded
      integer :: status

      call load_text("deck = 1"//nl//slider_crank("method = rk4"//nl//"step = 20 us"//nl//"contact_onset = interpolate"//nl// &
                                                  "stabilise = baumgarte alpha=5s^-1 beta=5s^-1", "damped", "rubbing", &
                                                  "clearance"), loaded, error)
      if (allocated(error)) return
      associate (method => loaded%method, system => loaded%system)
         call method%start(system, 0.0_wp, loaded%y, loaded%plan%end, status)
         call check_equal(error, status, 0, "start")
         do while (status == 0)
            call method%advance(system, loaded%plan%end, status)
         end do
         call check_equal(error, status, advance_event, "an onset")
         associate (n => system%linkage%rows%n_solve)
            call check_close(error, system%linkage%rows%phi(:n), spread(0.0_wp, 1, n), 1.0e-15_wp, "on the constraints")
            call check_close(error, system%linkage%solution%phi_dot(:n), spread(0.0_wp, 1, n), 1.0e-13_wp, "and moving along them")
         end associate
      end associate
   end subroutine test_mended

   !> A contact starts with less than the limit, with fixed and with variable steps, at no more cost than the halvings.
   subroutine test_rejected(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: limits(3) = [character(5) :: "1um", "10nm", "0.1um"]
      real(wp), parameter :: limit(3) = [1.0e-6_wp, 1.0e-8_wp, 1.0e-7_wp]
      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: deep
      integer :: i, k

      do i = 1, 2
         do k = 1, 3
            call drop("contact_onset = reject limit="//trim(limits(k))//nl//trim(merge("step = 10 us     ", "tolerance = 1e-10", &
                                                                                       i == 1)), "damped", keeper, summary, error)
            if (allocated(error)) return
            deep = 0.5_wp*g*keeper%events(1)%time**2 - fall
            call check_true(error, deep > 0.0_wp .and. deep <= limit(k), "within the limit")
            call check_close(error, keeper%events(1)%impact_speed, g*keeper%events(1)%time, 1.0e-10_wp, "speed there")
            call check_true(error, summary%count%rejected_steps < 60, "a few halvings")
         end do
      end do
      call drop("contact_onset = reject"//nl//"step = 10 us", "damped", keeper, summary, error)
      if (allocated(error)) return
      call check_true(error, 0.5_wp*g*keeper%events(1)%time**2 - fall <= 1.0e-7_wp, "limit by default")
   end subroutine test_rejected

   !> The contact starts at the end of the step that finds it.
   subroutine test_uncontrolled(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: t

      call drop("method = rk4"//nl//"contact_onset = uncontrolled"//nl//"step = 10 us", "damped", keeper, summary, error)
      if (allocated(error)) return
      t = ceiling(sqrt(2.0_wp*fall/g)*1.0e5_wp)*1.0e-5_wp
      call check_close(error, keeper%events(1)%time, t, 1.0e-11_wp, "time")
      call check_close(error, keeper%events(1)%impact_speed, g*t, 1.0e-10_wp, "speed")
   end subroutine test_uncontrolled

   !> The spring is given the energy 2/5 K delta^(5/2) of the first penetration: the ball leaves with it, the ledger misses it.
   subroutine test_energy(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(summary_t) :: summary
      real(wp) :: before, gift
      integer :: k

      do k = 1, 3
         call drop("contact_onset = uncontrolled"//nl//"tolerance = 1e-12"//nl//"maximum_step = "// &
                   trim(merge(merge("20 us", "10 us", k == 1), "1 us ", k < 3)), "elastic", keeper, summary, error)
         if (allocated(error)) return
         associate (row => keeper%events(1))
            gift = 0.4_wp*stiffness*(0.5_wp*g*row%time**2 - fall)**2.5_wp
            before = 0.5_wp*row%impact_speed**2 - g*(0.5_wp*g*row%time**2 - fall)
            call check_close(error, 0.5_wp*row%release_speed**2, before + gift, 1.0e-9_wp*before, "energy after the bounce")
            call check_close(error, summary%quality%energy_residual_max, gift, 1.0e-6_wp*gift + 1.0e-9_wp, "residual of the ledger")
         end associate
      end do
   end subroutine test_energy

   !> A mechanism: the first onset is the located one, as closely as each way promises.
   subroutine test_slider_crank(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: words(4) = [character(17) :: "located", "interpolate", "reject limit=10nm", "uncontrolled"]
      real(wp), parameter :: late(4) = [1.0e-12_wp, 1.0e-8_wp, 2.0e-8_wp, 2.0e-6_wp]
      type(keeper_t) :: keeper
      type(loaded_t), allocatable :: loaded
      type(summary_t) :: summary
      real(wp) :: speed, time
      integer :: k

      time = 0.0_wp
      speed = 0.0_wp
      do k = 1, size(words)
         allocate (loaded)
         call load_text("deck = 1"//nl//slider_crank("step = 2 us"//nl//"contact_onset = "//words(k), "damped", "rubbing", &
                                                     "clearance"), loaded, error)
         if (allocated(error)) return
         loaded%plan%end = 1.5e-3_wp
         keeper = keeper_t()
         call run_to_end(loaded, keeper, summary, error)
         if (allocated(error)) return
         if (k == 1) then
            time = keeper%events(1)%time
            speed = keeper%events(1)%impact_speed
         end if
         call check_close(error, keeper%events(1)%time, time, late(k), "first onset, "//words(k))
         call check_close(error, keeper%events(1)%impact_speed, speed, 1.0e4_wp*late(k), "its speed, "//words(k))
         deallocate (loaded)
      end do
   end subroutine test_slider_crank

   !> Saved between two events and loaded into fresh objects, a run continues to the last bit.
   subroutine test_checkpoint(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: fresh, run
      type(archive_t) :: archive
      integer :: i, status

      call begin(run)
      if (allocated(error)) return
      do i = 1, 60
         call run%method%advance(run%system, run%plan%end, status)
      end do
      call check_equal(error, status, 0, "still free")
      call run%method%save(archive)
      call begin(fresh)
      if (allocated(error)) return
      call fresh%method%load(archive)
      call check_true(error, archive%is_at_end(), "as many numbers loaded as saved")
      do while (status == 0)
         call run%method%advance(run%system, run%plan%end, status)
         call fresh%method%advance(fresh%system, fresh%plan%end, status)
         call check_true(error, all(run%method%step%y1 == fresh%method%step%y1), "equal bit for bit")
      end do
      call check_equal(error, status, advance_event, "to the onset")
      call check_true(error, run%method%t == fresh%method%t, "at the same time")

   contains

      !> A slider-crank at its start.
      subroutine begin(it)
         type(loaded_t), intent(out) :: it  !! the run

         call load_text("deck = 1"//nl//slider_crank("step = 10 us"//nl//"contact_onset = interpolate", "damped", "rubbing", &
                                                     "clearance"), it, error)
         if (allocated(error)) return
         call it%method%start(it%system, 0.0_wp, it%y, it%plan%end, status)
      end subroutine begin

   end subroutine test_checkpoint

end module test_contact_onset
