!> Films in joints: action and reaction, power against the ledger, entraining speed, the transition to dry contact.
module test_bearing_films
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_true, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use film_law, only: film_law_t, film_motion_t, film_slopes_t
   use film_registry, only: n_journal_film_kinds, new_film_law
   use fixed_random, only: random_t
   use kind_info, only: kind_info_t
   use kinds, only: pi, wp
   use law_case, only: case_t, make_case
   use law_faded, only: law_faded_t, new_law_faded
   use law_fixture, only: steel_pair
   use mechanism, only: mechanism_t
   use normal_law, only: parameter_deepest
   use scene_fixture, only: channel_pair, nl, system_of_text
   use surfaces, only: shape_internal
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_bearing_films

   real(wp), parameter :: mass(2) = [0.7_wp, 0.3_wp]          !! of the bodies of bearing and journal [kg]
   real(wp), parameter :: inertia(2) = [2.0e-3_wp, 5.0e-4_wp] !! of them [kg.m^2]
   real(wp), parameter :: gap = 0.5e-3_wp                     !! clearance [m]
   real(wp), parameter :: depth = 5.0e-6_wp                   !! e_t0 [m]

contains

   subroutine run_test_bearing_films(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("balances", test_balances)
      call suite%test("rigid_rotation", test_rigid_rotation)
      call suite%test("entraining_speed", test_entraining_speed)
      call suite%test("transition", test_transition)
      call suite%test("coefficients_in_the_transition", test_coefficients_in_the_transition)
      call suite%test("film_beyond_its_end", test_film_beyond_its_end)
      call suite%test("faded_law", test_faded_law)
   end subroutine run_test_bearing_films

   !> Two free bodies with a film between them; what stands in the row of the joint beside its points, radii and lubricant.
   function deck_of(kind, columns, values) result(text)
      character(*), intent(in) :: kind       !! of the film, without `film.`
      character(*), intent(in) :: columns    !! heads of further columns
      character(*), intent(in) :: values     !! what stands in them
      character(:), allocatable :: text      !! a deck

      text = "[scene]"//nl//"gravity = 0 0 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"housing 0.7 2e-3 0 0"//nl//"shaft 0.3 5e-4 0 0"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl//"hole housing 0.03 -0.02"//nl//"pin shaft -0.01 0.015"//nl// &
             "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[lubricant]"//nl//"name viscosity"//nl//"oil 0.4Pa.s"//nl// &
             "[contact.hertz]"//nl//"name"//nl//"dry"//nl//"[film."//kind//"]"//nl//"name"//nl//"wet"//nl// &
             "[clearance.revolute]"//nl// &
             "name bearing journal bearing_radius[mm] clearance[mm] length[mm] material law film lubricant "//columns//nl// &
             "joint hole pin 10 0.5 20 steel dry wet oil "//values//nl// &
             "[analysis.dynamic]"//nl//"start = given"//nl//"end = 1 s"
   end function deck_of

   !> A state with an eccentricity and its rate: the housing anywhere, the shaft where the pin is to be.
   function state_of(system, e, e_dot, angle, omega) result(y)
      type(mechanism_t), intent(in) :: system      !! the system
      real(wp), intent(in) :: e(2), e_dot(2)       !! (2) eccentricity, world frame, and its rate [m or m/s]
      real(wp), intent(in) :: angle(2), omega(2)   !! (2) angles and speeds of both bodies [rad or rad/s]
      real(wp), allocatable :: y(:)                !! (n) state [any]

      real(wp), parameter :: r(2) = [0.2_wp, -0.1_wp], v(2) = [0.7_wp, 0.4_wp]
      real(wp) :: hole(2), pin(2)

      allocate (y(system%n), source=0.0_wp)
      hole = turned([0.03_wp, -0.02_wp], angle(1))
      pin = turned([-0.01_wp, 0.015_wp], angle(2))
      y(1:6) = [r, angle(1), r + hole + e - pin, angle(2)]
      y(7:12) = [v, omega(1), v + omega(1)*[-hole(2), hole(1)] + e_dot - omega(2)*[-pin(2), pin(1)], omega(2)]
   end function state_of

   !> A vector turned by an angle.
   pure function turned(x, angle) result(z)
      real(wp), intent(in) :: x(2)    !! (2) the vector [any]
      real(wp), intent(in) :: angle   !! counter-clockwise [rad]
      real(wp) :: z(2)                !! (2) turned [any]

      z = [cos(angle)*x(1) - sin(angle)*x(2), sin(angle)*x(1) + cos(angle)*x(2)]
   end function turned

   !> Every film, with moments of shear and without: no momentum is made, and the power that the bodies lose is that of the ledger.
   subroutine test_balances(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(film_law_t), allocatable :: law
      type(kind_info_t) :: info
      type(mechanism_t) :: system
      type(random_t) :: random
      real(wp), allocatable :: y(:), ydot(:)
      real(wp) :: scale
      integer :: kind, option, sample, status
      character(*), parameter :: values(4) = [character(31) :: "lubricated off inertial 0mm 0mm", &
                                              "lubricated on inertial 0mm 0mm", &
                                              "lubricated on book 0mm 0mm", "hybrid on inertial 5um 10um"]

      do kind = 1, n_journal_film_kinds()
         call new_film_law(kind, law)
         info = law%info()
         do option = 1, size(values)
            call system_of_text(deck_of(info%name(len("film.") + 1:), "level film_torque entrain e_t0 e_t1", &
                                        trim(values(option))), system, error)
            if (allocated(error)) return
            allocate (ydot(system%n))
            do sample = 1, 5
               y = state_of(system, 0.6_wp*gap*random%vector(2, -1.0_wp, 1.0_wp), random%vector(2, -0.1_wp, 0.1_wp), &
                            random%vector(2, -pi, pi), random%vector(2, -50.0_wp, 50.0_wp))
               call system%evaluate(0.0_wp, y, ydot, status)
               associate (a => ydot(7:12), v => y(7:12), q => y(1:6))
                  scale = mass(2)*norm2(a(4:5))
                  call check_close(error, mass(1)*a(1:2) + mass(2)*a(4:5), [0.0_wp, 0.0_wp], 1.0e-11_wp*scale, &
                                   info%name//": forces")
                  call check_close(error, mass(1)*(q(1)*a(2) - q(2)*a(1)) + mass(2)*(q(4)*a(5) - q(5)*a(4)) + inertia(1)*a(3) &
                                   + inertia(2)*a(6), 0.0_wp, 1.0e-11_wp*scale, info%name//": moments")
                  call check_close(error, -(mass(1)*dot_product(a(1:2), v(1:2)) + mass(2)*dot_product(a(4:5), v(4:5)) &
                                            + inertia(1)*a(3)*v(3) + inertia(2)*a(6)*v(6)), ydot(system%place_of_impulse(0)), &
                                   1.0e-11_wp*scale, info%name//": power")
               end associate
               call check_true(error, scale > 0.0_wp, info%name//" acts")
            end do
            deallocate (ydot)
         end do
      end do
   end subroutine test_balances

   !> A joint that turns as a rigid body has no film force; by the relative speed of the book it has one.
   subroutine test_rigid_rotation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: e(2) = gap*[0.3_wp, 0.4_wp], spin = 30.0_wp
      type(mechanism_t) :: system
      real(wp) :: f(2)
      integer :: k

      do k = 1, 2
         call system_of_text(deck_of("pinkus_sternlicht", "level entrain", &
                                     merge("lubricated inertial", "lubricated book    ", k == 1)), system, error)
         if (allocated(error)) return
         f = channel_pair(system, 0.0_wp, state_of(system, e, spin*[-e(2), e(1)], [0.3_wp, 0.8_wp], [spin, spin]), "joint", &
                          "film_force")
         if (k == 1) call check_close(error, f, [0.0_wp, 0.0_wp], 1.0e-10_wp, "rigid rotation")
         if (k == 2) call check_true(error, norm2(f) > 1.0_wp, "rigid rotation by the book")
      end do
   end subroutine test_rigid_rotation

   !> A steady eccentricity in the world: both speeds count alike, with their signs, wherever they are.
   subroutine test_entraining_speed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: e(2) = gap*[0.3_wp, -0.4_wp], still(2) = [0.0_wp, 0.0_wp]
      type(mechanism_t) :: system
      real(wp) :: f(2, 4)

      call system_of_text(deck_of("short_exact", "level", "lubricated"), system, error)
      if (allocated(error)) return
      f(:, 1) = force_at([40.0_wp, 0.0_wp])
      f(:, 2) = force_at([0.0_wp, 40.0_wp])
      f(:, 3) = force_at([15.0_wp, 25.0_wp])
      f(:, 4) = force_at([30.0_wp, -30.0_wp])
      call check_close(error, f(:, 2), f(:, 1), 1.0e-9_wp*norm2(f(:, 1)), "bearing or journal")
      call check_close(error, f(:, 3), f(:, 1), 1.0e-9_wp*norm2(f(:, 1)), "their sum")
      call check_close(error, f(:, 4), still, 1.0e-9_wp*norm2(f(:, 1)), "against each other")

   contains

      !> Film force with speeds of both bodies.
      function force_at(omega) result(force)
         real(wp), intent(in) :: omega(2)  !! (2) of bearing and journal [rad/s]
         real(wp) :: force(2)              !! (2) on the journal [N]

         force = channel_pair(system, 0.0_wp, state_of(system, e, still, [0.2_wp, -0.5_wp], omega), "joint", "film_force")
      end function force_at

   end subroutine test_entraining_speed

   !> The transition (5.23) against its formula: film with the clearance c + e_t1, dry contact, parts between c and c + e_t0.
   subroutine test_transition(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: direction(2) = [0.6_wp, 0.8_wp], speed = 0.1_wp, viscosity = 0.4_wp, length = 20.0e-3_wp
      real(wp), parameter :: radius = 9.5e-3_wp, wide = gap + 10.0e-6_wp
      real(wp), parameter :: beyond(7) = [-20.0e-6_wp, -1.0e-12_wp, 1.0e-12_wp, 0.3_wp*depth, 0.8_wp*depth, &
                                          depth - 1.0e-12_wp, depth + 1.0e-12_wp]
      type(mechanism_t) :: system
      real(wp) :: dry, eps, expected, f(2), film, part
      integer :: k

      call system_of_text(deck_of("squeeze", "level e_t0 e_t1", "hybrid 5um 10um"), system, error)
      if (allocated(error)) return
      do k = 1, size(beyond)
         if (k == 3) call system%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, speed, 0.0_wp)
         f = channel_pair(system, 0.0_wp, state_of(system, (gap + beyond(k))*direction, speed*direction, [0.2_wp, 1.1_wp], &
                                                   [0.0_wp, 0.0_wp]), "joint", "force")
         eps = (gap + beyond(k))/wide
         film = 12.0_wp*pi*viscosity*length*radius**3/wide**3*speed/(1.0_wp - eps*eps)**1.5_wp
         associate (stiffness => system%clearance_joints%sets(1)%set%laws%parameters(1, 1))
            dry = stiffness*max(beyond(k), 0.0_wp)**1.5_wp
         end associate
         part = min(max(beyond(k)/depth, 0.0_wp), 1.0_wp)
         expected = (1.0_wp - part)*film + part*dry
         call check_close(error, f, -expected*direction, 1.0e-7_wp*expected, "transition")
      end do
   end subroutine test_transition

   !> Stiffness and damping of a film that goes out by degrees: differences of the force that it has in the joint, the body of the
   !> bearing turned.
   subroutine test_coefficients_in_the_transition(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: step(2) = [1.0e-8_wp, 1.0e-4_wp]  ! of eccentricity [m] and rate [m/s]
      type(film_motion_t) :: motion
      type(film_slopes_t) :: slopes
      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: computed(2), e(2), e_dot(2), f(2, 4)
      integer :: c, k, m

      call system_of_text(deck_of("short_exact", "level e_t0 e_t1", "hybrid 5um 10um"), system, error)
      if (allocated(error)) return
      do m = 1, 2
         do c = 1, 2
            do k = 1, 4
               e = (gap + 0.4_wp*depth)*[0.6_wp, 0.8_wp]
               e_dot = [0.02_wp, -0.03_wp]
               if (m == 1) e(c) = e(c) + places(k)*step(1)
               if (m == 2) e_dot(c) = e_dot(c) + places(k)*step(2)
               f(:, k) = channel_pair(system, 0.0_wp, state_of(system, e, e_dot, [0.2_wp, 1.1_wp], [3.0_wp, 40.0_wp]), &
                                      "joint", "film_force")
            end do
            y = state_of(system, (gap + 0.4_wp*depth)*[0.6_wp, 0.8_wp], [0.02_wp, -0.03_wp], [0.2_wp, 1.1_wp], [3.0_wp, 40.0_wp])
            computed = channel_pair(system, 0.0_wp, y, "joint", "film_force")
            associate (set => system%clearance_joints%sets(1)%set)
               call set%laws%films%slopes_of(1, set%items%body(:, 1), set%items%s_i(:, 1), set%items%s_j(:, 1), &
                                             system%linkage%motion, motion, slopes)
            end associate
            computed = slopes%stiffness(:, c)
            if (m == 2) computed = slopes%damping(:, c)
            call check_close(error, computed, -[five_point(f(1, :), step(m)), five_point(f(2, :), step(m))], &
                             1.0e-5_wp*norm2(computed), "slope "//to_text(m)//to_text(c))
         end do
      end do
   end subroutine test_coefficients_in_the_transition

   !> A film with contact behind it beyond eps_max: finite, against the approach, and none of suction where it carries no tension.
   subroutine test_film_beyond_its_end(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp) :: f(2), last
      integer :: k

      call system_of_text(deck_of("long_exact", "level eps_max", "hybrid 0.95"), system, error)
      if (allocated(error)) return
      last = 0.0_wp
      do k = 1, 40
         f = channel_pair(system, 0.0_wp, state_of(system, [0.05_wp*real(k, wp)*gap, 0.0_wp], [0.01_wp, 0.0_wp], &
                                                   [0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp]), "joint", "film_force")
         call check_true(error, all(ieee_is_finite(f)) .and. f(1) < 0.0_wp, "against the approach")
         if (k > 19) call check_close(error, f(1), last, 1.0e-9_wp, "the shape stays", relative=.true.)
         last = f(1)
      end do
   end subroutine test_film_beyond_its_end

   !> A law that comes in by degrees: its energy is the potential of its elastic force, of a power and of another law.
   subroutine test_faded_law(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(2) = [character(5) :: "hertz", "esdu"]
      real(wp), parameter :: accuracy(2) = [1.0e-9_wp, 1.0e-6_wp]
      type(case_t) :: case
      type(law_faded_t) :: faded
      real(wp) :: by_delta(1), by_rate(1), delta, elastic(1), energy(4), f(1), near(1), slope(1)
      integer :: k, law, m

      do law = 1, size(names)
         call make_case(trim(names(law)), [" "], [0.0_wp], " ", " ", steel_pair(shape_internal), case)
         call new_law_faded(case%law, depth, faded)
         do k = 1, 12
            delta = 0.15_wp*real(k, wp)*depth
            do m = 1, 4
               energy(m) = faded%potential(delta*(1.0_wp + 1.0e-3_wp*places(m)), case%parameters)
            end do
            call faded%force(1, [delta], [0.0_wp], [1.0_wp], case%parameters, f, slope, by_rate, elastic)
            call check_close(error, five_point(energy, 1.0e-3_wp*delta), elastic(1), accuracy(law), &
                             trim(names(law))//": potential", relative=.true.)
            do m = 1, 4
               call faded%force(1, [delta*(1.0_wp + 1.0e-3_wp*places(m))], [0.0_wp], [1.0_wp], case%parameters, near, &
                                by_delta, by_rate, elastic)
               energy(m) = near(1)
            end do
            call check_close(error, slope(1), five_point(energy, 1.0e-3_wp*delta), 1.0e-8_wp, trim(names(law))//": stiffness", &
                             relative=.true.)
         end do
         call check_true(error, case%parameters(parameter_deepest) > depth, "within the range of the law")
      end do
   end subroutine test_faded_law

end module test_bearing_films
