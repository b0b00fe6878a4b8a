!> Contacts whose normal law has a force between surfaces that do not touch, as a film has: a cushion F = K (delta + h), delta > -h.
module test_acting_apart
   use check, only: check_close, check_equal, check_true, suite_t
   use clearance_bench, only: bench_t, evaluate_loads, get_gaps, make_bench, move_to, n_all, n_body
   use clearance_registry, only: n_clearance_kinds
   use clearance_set, only: loss_contact, loss_friction, n_integrand
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use differences, only: five_point, places
   use errors, only: error_t
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use motion, only: loads_t
   use normal_law, only: n_law_parameter, normal_law_t
   use planar_kinds, only: is_planar_clearance
   use read_channel, only: read_loose
   use recorder, only: event_t, summary_t
   use surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: run_test_acting_apart

   character(*), parameter :: nl = new_line("a")
   real(wp), parameter :: stiffness = 1.0e7_wp   !! K of the cushion [N/m]

   !> A cushion between surfaces.
   type, extends(normal_law_t) :: cushion_t
      real(wp) :: reach = 0.0_wp   !! h: how far apart surfaces start to feel it [m]
   contains
      procedure, nopass :: info => cushion_info
      procedure :: prepare => cushion_prepare
      procedure :: fit => cushion_fit
      procedure :: force => cushion_force
      procedure :: potential => cushion_potential
      procedure :: description => cushion_description
   end type cushion_t

contains

   subroutine run_test_acting_apart(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("free_contacts_act", test_free_contacts_act)
      call suite%test("ball_that_never_touches", test_ball_that_never_touches)
   end subroutine run_test_acting_apart

   !> Every geometry, all contacts free, with a cushion twice as thick as the maximum distance: force of each, action and reaction,
   !> power of the loads against the rate of the energy stored.
   subroutine test_free_contacts_act(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(event_t) :: event
      type(loads_t) :: loads
      real(wp) :: delta(n_all), energy(4), given, integrands(n_integrand, n_all), normal(1, n_all), rate(n_all), reach
      real(wp) :: scale
      integer :: body, k, kind

      do kind = 1, n_clearance_kinds()
         if (.not. is_planar_clearance(kind)) cycle
         call make_bench(kind, 1, 0, 1, bench)
         associate (set => bench%set)
            do k = 1, size(bench%touching)
               call set%end_contact(bench%touching(k), 0.1_wp, 0.0_wp, 0.0_wp, .true., event)
            end do
            call get_gaps(bench, 0.0_wp, delta, rate)
            reach = 2.0_wp*maxval(abs(delta(bench%first:bench%last)))
            deallocate (set%laws%normal)
            allocate (set%laws%normal, source=cushion(reach))
            call evaluate_loads(bench, loads, integrands)
            normal = 0.0_wp
            call read_loose(set, "normal_force", bench%motion, normal)
            call check_close(error, normal(1, bench%first:bench%last), stiffness*(delta(bench%first:bench%last) + reach), &
                             1.0e-12_wp*stiffness*reach, bench%name//": normal forces")
            scale = sum(abs(loads%force))
            call check_true(error, scale > 1000.0_wp, bench%name//": there are forces")
            call check_close(error, sum(loads%force, dim=2), [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp*scale, bench%name//": forces")
            do k = 1, 4
               call move_to(bench, places(k)*1.0e-7_wp)
               energy(k) = set%elastic_energy(bench%motion)
            end do
            call move_to(bench, 0.0_wp)
            given = 0.0_wp
            do body = 1, n_body
               given = given + dot_product(loads%force(:, body), bench%motion%v(:, body)) &
                       + dot_product(loads%moment(:, body), bench%motion%omega(:, body))
            end do
            scale = stiffness*reach*sum(abs(rate(bench%first:bench%last)))
            call check_true(error, abs(given) > 1.0e-3_wp*scale, bench%name//": they have a power")
            call check_close(error, given, -five_point(energy, 1.0e-7_wp), 1.0e-6_wp*scale, bench%name//": power")
            call check_close(error, maxval(abs(integrands([loss_contact, loss_friction], bench%first:bench%last))), 0.0_wp, &
                             1.0e-12_wp*scale, bench%name//": nothing is lost")
            if (allocated(error)) return
         end associate
      end do
   end subroutine test_free_contacts_act

   !> A ball that a cushion turns back before the wall: half an oscillation of m and K, no contact, no energy lost.
   subroutine test_ball_that_never_touches(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: ball = "deck = 1"//nl// &
         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]"//nl//"ball 0.5 1e-4 0 0 2"//nl// &
         "[points]"//nl//"name body xi[m] eta[m]"//nl//"wall ground 0.011 0"//nl//"centre ball 0 0"//nl// &
         "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
         "[clearance.plane]"//nl//"name plane ball axis axis_angle[deg] radius[mm] material law"//nl// &
         "stop wall centre x 180 10 steel law"//nl// &
         "[contact.kelvin_voigt]"//nl//"name stiffness[N/m] restitution form"//nl//"law 2e6 0.2 dashpot"//nl// &
         "[analysis.dynamic]"//nl//"start = given"//nl//"tolerance = 1e-10"//nl//"end = 2 ms"//nl
      real(wp), parameter :: mass = 0.5_wp, speed = 2.0_wp, gap = 1.0e-3_wp, reach = 0.9e-3_wp, end = 2.0e-3_wp
      real(wp), parameter :: inside = pi*sqrt(mass/stiffness), before = (gap - reach)/speed  !! times [s]
      type(keeper_t) :: keeper
      type(loaded_t) :: loaded
      type(summary_t) :: summary

      call load_text(ball, loaded, error)
      if (allocated(error)) return
      deallocate (loaded%system%clearance_joints%sets(1)%set%laws%normal)
      allocate (loaded%system%clearance_joints%sets(1)%set%laws%normal, source=cushion(reach))
      call run_to_end(loaded, keeper, summary, error)
      if (allocated(error)) return
      call check_equal(error, keeper%n_event, 0, "contacts")
      associate (motion => loaded%system%linkage%motion)
         call loaded%system%linkage%set_motion(end, loaded%method%step%y1)
         call check_close(error, motion%v(1, 1), -speed, 1.0e-6_wp*speed, "speed after")
         call check_close(error, motion%r(1, 1), (gap - reach) - speed*(end - before - inside), 1.0e-6_wp*gap, "where it is")
      end associate
      call check_true(error, summary%quality%energy_residual_max < 1.0e-6_wp*0.5_wp*mass*speed**2, "the ledger is closed")
   end subroutine test_ball_that_never_touches

   !> A cushion.
   function cushion(reach) result(law)
      real(wp), intent(in) :: reach   !! how far apart surfaces start to feel it [m]
      type(cushion_t) :: law          !! the law

      law%name = "cushion"
      law%acts_apart = .true.
      law%reach = reach
   end function cushion

   function cushion_info() result(info)
      type(kind_info_t) :: info  !! a name

      info%name = "contact.cushion"
   end function cushion_info

   subroutine cushion_prepare(self, item)
      class(cushion_t), intent(inout) :: self  !! the law
      type(item_t), intent(in) :: item         !! the row

      self%name = item%name
   end subroutine cushion_prepare

   subroutine cushion_fit(self, pair, parameters, message, help)
      class(cushion_t), intent(in) :: self                   !! the law
      type(surfaces_t), intent(in) :: pair                   !! the surfaces
      real(wp), intent(out) :: parameters(n_law_parameter)   !! (n_law_parameter) none [any]
      character(:), allocatable, intent(out) :: message      !! empty
      character(:), allocatable, intent(out) :: help         !! empty

      parameters = 0.0_wp
      message = ""
      help = ""
   end subroutine cushion_fit

   pure subroutine cushion_force(self, n, delta, rate, impact_speed, parameters, f, df_ddelta, df_drate, f_elastic)
      class(cushion_t), intent(in) :: self                   !! the law
      integer, intent(in) :: n                               !! number of contacts
      real(wp), intent(in) :: delta(n)                       !! (n) penetration [m]
      real(wp), intent(in) :: rate(n)                        !! (n) its rate [m/s]
      real(wp), intent(in) :: impact_speed(n)                !! (n) not used [m/s]
      real(wp), intent(in) :: parameters(n_law_parameter, n) !! (n_law_parameter, n) none [any]
      real(wp), intent(out) :: f(n)                          !! (n) force [N]
      real(wp), intent(out) :: df_ddelta(n)                  !! (n) its derivative by penetration [N/m]
      real(wp), intent(out) :: df_drate(n)                   !! (n) zero [N.s/m]
      real(wp), intent(out) :: f_elastic(n)                  !! (n) the force [N]

      f = stiffness*max(delta + self%reach, 0.0_wp)
      f_elastic = f
      df_ddelta = merge(stiffness, 0.0_wp, delta + self%reach > 0.0_wp)
      df_drate = 0.0_wp
   end subroutine cushion_force

   pure function cushion_potential(self, delta, parameters) result(energy)
      class(cushion_t), intent(in) :: self                 !! the law
      real(wp), intent(in) :: delta                        !! penetration [m]
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) none [any]
      real(wp) :: energy                                   !! energy stored [J]

      energy = 0.5_wp*stiffness*max(delta + self%reach, 0.0_wp)**2
   end function cushion_potential

   function cushion_description(self, parameters) result(words)
      class(cushion_t), intent(in) :: self                 !! the law
      real(wp), intent(in) :: parameters(n_law_parameter)  !! (n_law_parameter) none [any]
      character(:), allocatable :: words                   !! its name

      words = self%name
   end function cushion_description

end module test_acting_apart
