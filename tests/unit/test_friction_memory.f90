!> Friction that remembers, against what can be written down: blocks and discs on planes.
module test_friction_memory
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use kinds, only: pi, wp
   use recorder, only: summary_t
   use scene_fixture, only: nl
   use text, only: real_text
   implicit none (type, external)
   private
   public :: run_test_friction_memory

   real(wp), parameter :: g = 9.81_wp          !! free fall [m/s^2]
   real(wp), parameter :: stiffness = 1.0e9_wp !! of the contacts [N/m^1.5]
   real(wp), parameter :: radius = 0.1_wp      !! of the bodies [m]

contains

   subroutine run_test_friction_memory(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("coulomb_stops_a_block", test_stopping)
      call suite%test("coulomb_stops_a_block_by_every_method", test_methods)
      call suite%test("rest_on_an_incline", test_incline)
      call suite%test("load_that_grows", test_growing_load)
      call suite%test("spinning_disc_begins_to_roll", test_spinning_disc)
      call suite%test("two_corners_share_a_load", test_two_corners)
      call suite%test("stick_slip_oscillator", test_stick_slip)
      call suite%test("lugre_slides_steadily", test_steady)
      call suite%test("lugre_gives_by_its_bristles", test_bristles)
      call suite%test("dahl_slows_a_block", test_dahl)
   end subroutine run_test_friction_memory

   !> A body of 1 kg on a plane, pressed in as far as its weight presses. Gravity is turned by the slope. A block has two feet,
   !> whose lowest points are at the height of its centre of mass, so that it does not tip; a disc has the moment of inertia
   !> of one.
   function on_plane(slope, is_block, motion, friction, settings) result(deck)
      real(wp), intent(in) :: slope           !! of the plane [rad]
      logical, intent(in) :: is_block         !! a block, not a disc
      character(*), intent(in) :: motion      !! vx[m/s] and omega[rad/s]
      character(*), intent(in) :: friction    !! coulomb, constant, lugre, dahl or ambrosio
      character(*), intent(in) :: settings    !! lines of [analysis.dynamic] and tables
      character(:), allocatable :: deck       !! the deck

      character(:), allocatable :: feet
      real(wp) :: depth

      depth = (merge(0.5_wp, 1.0_wp, is_block)*g*cos(slope)/stiffness)**(2.0_wp/3.0_wp)
      feet = "right floor right y 0.1 steel normal "//friction//nl
      if (is_block) feet = "left floor left y 0.1 steel normal "//friction//nl//feet
      deck = "deck = 1"//nl//"[scene]"//nl// &
             "gravity = "//real_text(g*sin(slope), 17)//" "//real_text(-g*cos(slope), 17)//" m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] omega[rad/s]"//nl// &
             "body 1 0.005 0 "//real_text(merge(0.0_wp, radius, is_block) - depth, 17)//" "//motion//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"floor ground 0 0"//nl//"centre body 0 0"//nl// &
             "left body -0.1 0.1"//nl//trim(merge("right body 0.1 0.1", "right body 0 0    ", is_block))//nl// &
             "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[clearance.plane]"//nl//"name plane ball axis radius[m] material law friction"//nl//feet// &
             "[contact.lankarani_nikravesh]"//nl//"name restitution stiffness[N/m^1.5]"//nl//"normal 0.5 1e9"//nl// &
             "[friction.coulomb]"//nl//"name coefficient static_coefficient"//nl//"coulomb 0.3 0.4"//nl// &
             "[friction.constant]"//nl//"name force[N] v1[m/s]"//nl//"constant "//real_text(0.15_wp*g, 17)//" 0"//nl// &
             "[friction.lugre]"//nl//"name coefficient static_coefficient viscosity[s/m]"//nl//"lugre 0.3 0.4 0.01"//nl// &
             "[friction.dahl]"//nl//"name coefficient stiffness[m^-1]"//nl//"dahl 0.3 1e4"//nl// &
             "[friction.ambrosio]"//nl//"name coefficient v0[m/s] v1[m/s]"//nl//"ambrosio 0.3 1e-4 1e-3"//nl// &
             "[analysis.dynamic]"//nl//"start = given"//nl//"overlap = preload"//nl//settings//nl
   end function on_plane

   !> Run a deck, from its start to its end.
   subroutine run_deck(deck, loaded, keeper, summary, error)
      character(*), intent(in) :: deck                     !! its text
      type(loaded_t), intent(out) :: loaded                !! the deck, run
      type(keeper_t), intent(out) :: keeper                !! its events
      type(summary_t), intent(out) :: summary              !! how it went
      type(error_t), allocatable, intent(inout) :: error   !! first failure

      if (allocated(error)) return
      call load_text(deck, loaded, error)
      if (.not. allocated(error)) call run_to_end(loaded, keeper, summary, error)
   end subroutine run_deck

   !> Time and place of the n-th row of a kind, 0 if there is none.
   pure integer function place_of(keeper, kind, n) result(place)
      type(keeper_t), intent(in) :: keeper   !! events
      character(*), intent(in) :: kind       !! kind of event
      integer, intent(in) :: n               !! which of them

      integer :: found

      found = 0
      do place = 1, keeper%n_event
         if (keeper%events(place)%kind == kind) found = found + 1
         if (found == n) return
      end do
      place = 0
   end function place_of

   !> A block that slides at 1 m/s stops after v/(mu g) and v^2/(2 mu g), and sticks; so it does by a constant force of that size.
   subroutine test_stopping(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call stop_block("coulomb", error)
      if (.not. allocated(error)) call stop_block("constant", error)
   end subroutine test_stopping

   !> The same by one law.
   subroutine stop_block(friction, error)
      character(*), intent(in) :: friction                 !! coulomb or constant
      type(error_t), allocatable, intent(inout) :: error   !! what failed

      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary

      call run_deck(on_plane(0.0_wp, .true., "1 0", friction, "end = 0.5 s"//nl//"tolerance = 1e-10"), loaded, keeper, &
                    summary, error)
      if (allocated(error)) return
      call check_true(error, place_of(keeper, "stick", 2) > 0 .and. place_of(keeper, "stick", 3) == 0, "both feet stick once")
      if (allocated(error)) return
      call check_close(error, keeper%events(place_of(keeper, "stick", 1))%time, 1.0_wp/(0.3_wp*g), 1.0e-8_wp, "time")
      associate (y => loaded%method%step%y1)
         call check_close(error, y(1), 1.0_wp/(0.6_wp*g), 1.0e-8_wp, "distance")
         call check_close(error, y(4), 0.0_wp, 1.0e-12_wp, "at rest")
      end associate
      call check_true(error, summary%quality%energy_residual_max < 1.0e-8_wp, "the ledger closes")
   end subroutine stop_block

   !> The same by the other methods that solve for accelerations.
   subroutine test_methods(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: methods(3) = [character(26) :: "rk4"//nl//"step = 20 us", "adams"//nl//"tolerance = 1e-11", &
                                               "bdf"//nl//"tolerance = 1e-11"]
      type(keeper_t) :: keeper
      type(loaded_t), allocatable :: loaded
      type(summary_t) :: summary
      integer :: k

      do k = 1, size(methods)
         allocate (loaded)
         call run_deck(on_plane(0.0_wp, .true., "1 0", "coulomb", "end = 0.5 s"//nl//"method = "//trim(methods(k))), loaded, &
                       keeper, summary, error)
         call check_true(error, place_of(keeper, "stick", 1) > 0, "sticks by "//methods(k))
         if (allocated(error)) return
         call check_close(error, keeper%events(place_of(keeper, "stick", 1))%time, 1.0_wp/(0.3_wp*g), 1.0e-5_wp, &
                          "time by "//methods(k))
         call check_close(error, loaded%method%step%y1(1), 1.0_wp/(0.6_wp*g), 1.0e-5_wp, "distance by "//methods(k))
         deallocate (loaded)
      end do
   end subroutine test_methods

   !> At rest on a slope that the friction can hold: Coulomb holds it, bristles give a little, Ambrosio's law lets it creep.
   subroutine test_incline(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: laws(3) = [character(8) :: "coulomb", "lugre", "ambrosio"]
      type(keeper_t) :: keeper
      type(loaded_t), allocatable :: loaded
      type(summary_t) :: summary
      real(wp) :: moved(3)
      integer :: k

      do k = 1, 3
         allocate (loaded)
         call run_deck(on_plane(0.2_wp, .true., "0 0", trim(laws(k)), "end = 10 s"//nl//"tolerance = 1e-9"), loaded, &
                       keeper, summary, error)
         if (allocated(error)) return
         moved(k) = loaded%method%step%y1(1)
         call check_true(error, summary%count%steps < 100000, "few steps with "//laws(k))
         deallocate (loaded)
      end do
      call check_true(error, abs(moved(1)) < 1.0e-9_wp, "coulomb holds")
      call check_true(error, moved(2) > 0.0_wp .and. moved(2) < 2.0_wp*tan(0.2_wp)/1.0e5_wp, "lugre gives and holds")
      call check_true(error, moved(3) > 10.0_wp*1.0e-4_wp, "ambrosio creeps")
   end subroutine test_incline

   !> A force F = t N along the plane: it holds to F = mu_s m g, then the block slides with m a = F - mu m g.
   subroutine test_growing_load(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary
      real(wp) :: later, start

      call run_deck(on_plane(0.0_wp, .true., "0 0", "coulomb", "end = 5 s"//nl//"tolerance = 1e-10"//nl// &
                             "[force.point]"//nl//"name point fx fy"//nl//"push centre {t*1N/1s} 0N"), loaded, keeper, summary, &
                    error)
      if (allocated(error)) return
      call check_true(error, place_of(keeper, "slip", 2) > 0 .and. place_of(keeper, "slip", 3) == 0, "both feet slip once")
      if (allocated(error)) return
      start = 0.4_wp*g
      later = 5.0_wp - start
      call check_close(error, keeper%events(place_of(keeper, "slip", 1))%time, start, 1.0e-8_wp, "time")
      associate (y => loaded%method%step%y1)
         call check_close(error, y(4), 0.1_wp*g*later + 0.5_wp*later**2, 1.0e-7_wp, "speed")
         call check_close(error, y(1), 0.05_wp*g*later**2 + later**3/6.0_wp, 1.0e-7_wp, "way")
      end associate
   end subroutine test_growing_load

   !> A disc set down spinning: mu g t in speed, mu g t m R / J out of its spin, rolling from when v = w R. Then it rolls on.
   subroutine test_spinning_disc(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: spin = -50.0_wp, moment = 0.5_wp*radius**2
      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary
      real(wp) :: arm, speed, time

      call run_deck(on_plane(0.0_wp, .false., "0 -50", "coulomb", "end = 1 s"//nl//"tolerance = 1e-10"), loaded, keeper, summary, &
                    error)
      if (allocated(error)) return
      arm = radius - 0.5_wp*(g/stiffness)**(2.0_wp/3.0_wp)  ! the forces act in the middle between the surfaces
      time = -spin*arm/(0.3_wp*g*(1.0_wp + arm**2/moment))
      speed = 0.3_wp*g*time
      call check_true(error, place_of(keeper, "stick", 1) > 0 .and. place_of(keeper, "slip", 1) == 0, "begins to roll, for good")
      if (allocated(error)) return
      call check_close(error, keeper%events(place_of(keeper, "stick", 1))%time, time, 1.0e-8_wp, "time")
      associate (y => loaded%method%step%y1)
         call check_close(error, y(4), speed, 1.0e-8_wp, "speed")
         call check_close(error, y(6)*arm, -speed, 1.0e-8_wp, "spin")
         call check_close(error, y(1), 0.5_wp*speed*time + speed*(1.0_wp - time), 1.0e-7_wp, "way")
      end associate
      call check_close(error, speed, -spin*radius/3.0_wp, 1.0e-4_wp*speed, "a third of the speed of the rim")
   end subroutine test_spinning_disc

   !> A block on two feet under a growing load: neither can be reported apart, each takes its part, both let go at one instant.
   subroutine test_two_corners(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary
      real(wp) :: left, pressed, start
      character(:), allocatable :: deck

      pressed = (0.5_wp*g/stiffness)**(2.0_wp/3.0_wp)
      deck = "deck = 1"//nl//"[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"block 1 0.1 0 "// &
             real_text(0.1_wp - pressed, 17)//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"floor ground 0 0"//nl//"left block -0.5 -0.05"//nl// &
             "right block 0.5 -0.05"//nl//"grip block 0 -0.05"//nl// &
             "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[clearance.plane]"//nl//"name plane ball axis radius[m] material law friction"//nl// &
             "one floor left y 0.05 steel normal rough"//nl//"two floor right y 0.05 steel normal rough"//nl// &
             "[contact.lankarani_nikravesh]"//nl//"name restitution stiffness[N/m^1.5]"//nl//"normal 0.5 1e9"//nl// &
             "[friction.coulomb]"//nl//"name coefficient static_coefficient"//nl//"rough 0.3 0.4"//nl// &
             "[force.point]"//nl//"name point fx fy"//nl//"push grip {t*1N/1s} 0N"//nl// &
             "[analysis.dynamic]"//nl//"start = given"//nl//"overlap = preload"//nl//"end = 4.5 s"//nl//"tolerance = 1e-10"//nl
      call run_deck(deck, loaded, keeper, summary, error)
      if (allocated(error)) return
      call check_true(error, place_of(keeper, "slip", 2) > 0, "both slip")
      if (allocated(error)) return
      start = 0.4_wp*g
      call check_close(error, keeper%events(place_of(keeper, "slip", 1))%time, start, 1.0e-6_wp, "the first")
      call check_close(error, keeper%events(place_of(keeper, "slip", 2))%time, start, 1.0e-6_wp, "the second")
      left = 4.5_wp - start
      call check_close(error, loaded%method%step%y1(4), 0.1_wp*g*left + 0.5_wp*left**2, 1.0e-5_wp, "speed")
      call check_true(error, summary%count%steps < 100000, "few steps")
   end subroutine test_two_corners

   !> A block on a belt that runs at V, held by a spring: it sticks until the spring has k x = mu_s m g, slips by an arc of a
   !> circle around mu m g / k until its speed is V again, and so on. Both parts of the cycle in closed form.
   subroutine test_stick_slip(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: rate = 20.0_wp, belt = 0.1_wp  ! frequency of the spring [1/s], speed of the belt [m/s]
      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary
      real(wp) :: arc, excess, first, slipping, sticking
      integer :: k

      call run_deck(on_plane_moving(belt, rate), loaded, keeper, summary, error)
      if (allocated(error)) return
      ! about the place where the spring balances sliding friction: starts at (excess, V), ends at (-excess, V)
      excess = 0.1_wp*g/rate**2
      arc = pi + 2.0_wp*atan2(belt, excess*rate)
      slipping = arc/rate
      sticking = 2.0_wp*excess/belt
      call check_true(error, place_of(keeper, "slip", 8) > 0 .and. place_of(keeper, "stick", 10) > 0, "four cycles")
      if (allocated(error)) return
      first = 0.4_wp*g/rate**2/belt
      call check_close(error, keeper%events(place_of(keeper, "slip", 1))%time, first, 1.0e-6_wp, "first slip")
      do k = 1, 3  ! two rows each, one for each foot; the first pair of sticking is that of the start
         associate (slip => keeper%events(place_of(keeper, "slip", 2*k))%time, &
                    next => keeper%events(place_of(keeper, "slip", 2*k + 2))%time, &
                    stick => keeper%events(place_of(keeper, "stick", 2*k + 2))%time)
            call check_close(error, stick - slip, slipping, 1.0e-6_wp, "time of slip")
            call check_close(error, next - stick, sticking, 1.0e-6_wp, "time of sticking")
         end associate
      end do
      call check_true(error, summary%quality%energy_residual_max < 1.0e-6_wp*summary%quality%energy_max, "the ledger closes")
   end subroutine test_stick_slip

   !> The belt of the oscillator: a body driven along x, its surface the plane; the block is tied to the ground by a spring.
   function on_plane_moving(belt, rate) result(deck)
      real(wp), intent(in) :: belt         !! its speed [m/s]
      real(wp), intent(in) :: rate         !! frequency of the block on its spring [1/s]
      character(:), allocatable :: deck    !! the deck

      real(wp) :: depth

      depth = (0.5_wp*g/stiffness)**(2.0_wp/3.0_wp)
      deck = "deck = 1"//nl//"[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]"//nl// &
             "belt 1 1 0 0 "//real_text(belt, 17)//nl//"block 1 0.005 0 "// &
             real_text(-depth, 17)//" "//real_text(belt, 17)//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"rail ground 0 0"//nl//"surface belt 0 0"//nl//"centre block 0 0"//nl// &
             "left block -0.1 0.1"//nl//"right block 0.1 0.1"//nl//"hook ground -1 "//real_text(-depth, 17)//nl// &
             "[joint.translational]"//nl//"name i j axis"//nl//"way rail surface x"//nl// &
             "[driver.position]"//nl//"name i j axis position"//nl//"motor rail surface x {"//real_text(belt, 17)//"m/s*t}"//nl// &
             "[force.spring]"//nl//"name i j stiffness[N/m] free_length[m]"//nl//"tie hook centre "// &
             real_text(rate**2, 17)//" 1"//nl// &
             "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[clearance.plane]"//nl//"name plane ball axis radius[m] material law friction"//nl// &
             "left surface left y 0.1 steel normal rough"//nl//"right surface right y 0.1 steel normal rough"//nl// &
             "[contact.lankarani_nikravesh]"//nl//"name restitution stiffness[N/m^1.5]"//nl//"normal 0.5 1e9"//nl// &
             "[friction.coulomb]"//nl//"name coefficient static_coefficient"//nl//"rough 0.3 0.4"//nl// &
             "[analysis.dynamic]"//nl//"start = given"//nl//"overlap = preload"//nl//"end = 2 s"//nl//"tolerance = 1e-10"//nl
   end function on_plane_moving

   !> A body pushed by its weight down a slope that LuGre friction cannot hold ends up with g sin = g cos (mu + sigma_2 v).
   subroutine test_steady(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: slope = 0.32_wp
      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary
      real(wp) :: steady

      steady = (tan(slope) - 0.3_wp)/0.01_wp
      call run_deck(on_plane(slope, .true., real_text(steady, 17)//" 0", "lugre", "end = 0.05 s"//nl//"tolerance = 1e-9"), &
                    loaded, keeper, summary, error)
      if (allocated(error)) return
      associate (y => loaded%method%step%y1)
         ! while they bend, the bristles' damping takes sigma_1 z in speed
         call check_close(error, y(4), steady - 100.0_wp*0.3e-5_wp*g*cos(slope), 1.0e-4_wp*steady, "speed")
         call check_close(error, y(7), 0.3_wp/1.0e5_wp, 1.0e-9_wp, "deflection")
      end associate
      call check_true(error, summary%quality%energy_residual_max < 1.0e-7_wp*summary%quality%energy_max, "the ledger closes")
   end subroutine test_steady

   !> On a slope that they can hold, bristles give until sigma_0 z = tan(slope): that is how far the body comes.
   subroutine test_bristles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary

      call run_deck(on_plane(0.1_wp, .true., "0 0", "lugre", "end = 1 s"//nl//"tolerance = 1e-11"), loaded, keeper, summary, &
                    error)
      if (allocated(error)) return
      associate (y => loaded%method%step%y1)
         call check_close(error, y(7), tan(0.1_wp)/1.0e5_wp, 1.0e-9_wp, "deflection")
         call check_true(error, y(1) >= y(7) .and. y(1) < 2.0_wp*y(7), "the body came about as far")
         call check_close(error, y(4), 0.0_wp, 1.0e-9_wp, "at rest")
      end associate
   end subroutine test_bristles

   !> A block slides a way s on Dahl's friction from z = 0: v^2 = v_0^2 - 2 mu g [ s - mu/sigma (1 - exp(-sigma s/mu)) ].
   subroutine test_dahl(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: along = 0.3_wp/1.0e4_wp  ! mu/sigma [m]
      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary
      real(wp) :: s
      integer :: k

      do k = 1, 4
         call run_deck(on_plane(0.0_wp, .true., "0.05 0", "dahl", "end = "//real_text(0.4e-3_wp*k, 5)//" s"//nl// &
                                "tolerance = 1e-11"), loaded, keeper, summary, error)
         if (allocated(error)) return
         associate (y => loaded%method%step%y1)
            s = y(1)
            call check_close(error, y(4)**2, 0.05_wp**2 - 0.6_wp*g*(s - along*(1.0_wp - exp(-s/along))), 1.0e-10_wp, "its speed")
            call check_close(error, y(7), along*(1.0_wp - exp(-s/along)), 1.0e-9_wp*along, "deflection")
         end associate
      end do
      call check_true(error, summary%quality%energy_residual_max < 1.0e-7_wp*summary%quality%energy_max, "the ledger closes")
   end subroutine test_dahl

end module test_friction_memory
