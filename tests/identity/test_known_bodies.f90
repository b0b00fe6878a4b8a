!> Bodies whose motion is a known function of time, against the same deck with all bodies among the unknowns.
!> See `reduction_comparison`.
module test_known_bodies
   use augmented, only: augmented_t
   use check, only: check_close, check_equal, check_true, suite_t
   use clearance_set, only: loss_contact, loss_friction
   use errors, only: error_t
   use kinds, only: two_pi, wp
   use mechanism, only: mechanism_t
   use readings, only: wanted_rows_t
   use reduction_comparison, only: both_systems, compare_at, compare_often, compare_works, complete_state, with_word
   use scene_fixture, only: nl, slider_crank, start_text, system_of_text
   use solver_registry, only: n_solver_kinds, new_solver
   use text, only: replace
   implicit none (type, external)
   private
   public :: run_test_known_bodies

   !> Two driven links in series, the second joint with its body i as the moving one; a plate welded to the second link,
   !> a free hand on the plate, a spring, gravity.
   character(*), parameter :: arm = "[scene]"//nl//"gravity = 1 -9.81 m/s^2"//nl// &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]"//nl// &
      "upper 2.0 0.05 0.2 0 0 0"//nl//"lower 1.2 0.03 0.4 0.2 {90 deg} 0"//nl// &
      "plate 0.5 0.004 0.4 0.45 0.3 0"//nl//"hand 0.4 0.002 0.5 0.5 0.2 1"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"far ground 1 1"//nl// &
      "upper_0 upper -0.2 0"//nl//"upper_1 upper 0.2 0"//nl//"lower_0 lower -0.2 0"//nl//"lower_1 lower 0.2 0"//nl// &
      "plate_0 plate -0.05 0.01"//nl//"plate_1 plate 0.06 0.02"//nl//"hand_0 hand -0.04 0"//nl//"hand_1 hand 0.1 0.02"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"wrist plate_1 hand_0"//nl//"shoulder base upper_0"//nl// &
      "elbow lower_0 upper_1"//nl// &
      "[joint.rigid]"//nl//"name i j"//nl//"weld plate_0 lower_1"//nl// &
      "[driver.angle]"//nl//"name joint angle"//nl//"lift shoulder {0.4 rad*sin(3 rad/s*t)}"//nl// &
      "bend elbow {-90 deg + 0.7 rad*(t/1s)^2}"//nl// &
      "[force.spring]"//nl//"name i j stiffness[N/m] damping[N.s/m] free_length[m]"//nl//"band far hand_1 90 3 0.2"//nl// &
      "rope far lower_1 40 1 0.3"//nl

contains

   subroutine run_test_known_bodies(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("slider_crank", test_slider_crank)
      call suite%test("contact_on_a_known_body", test_contact_on_a_known_body)
      call suite%test("contact_of_guided_bodies", test_contact_of_one_dof_bodies)
      call suite%test("direct_where_nothing_is_solved", test_direct)
      call suite%test("robot_arm", test_robot_arm)
      call suite%test("guided_bodies", test_one_dof)
      call suite%test("loop_between_known_bodies", test_loop)
      call suite%test("two_drivers_on_one_joint", test_two_drivers)
      call suite%test("known_is_what_is_smooth", test_smooth)
      call suite%test("all_driven", test_all_driven)
      call suite%test("error_scales", test_error_scales)
      call suite%test("works", test_works)
   end subroutine run_test_known_bodies

   !> A crank at constant speed.
   subroutine test_slider_crank(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_often(slider_crank(nl//"stabilise = baumgarte alpha=20s^-1", "damped", "none", "ideal"), 1, 24.0e-3_wp, error)
      call compare_often(slider_crank(nl//"stabilise = none", "damped", "none", "clearance"), 1, 24.0e-3_wp, error)
      call compare_often(slider_crank(nl//"ledger = off", "damped", "none", "ideal"), 1, 24.0e-3_wp, error)
   end subroutine test_slider_crank

   !> The loose pin between a driven crank and the rod, touching: its force is carried by the driver.
   subroutine test_contact_on_a_known_body(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: full, small
      real(wp), allocatable :: start(:), y(:)
      character(:), allocatable :: deck
      integer :: k

      deck = replace(slider_crank("", "damped", "rubbing", "clearance"), "big_end throw big"//nl, "tail small pin"//nl)
      deck = replace(deck, "gudgeon pin small", "gudgeon throw big")
      call both_systems(deck, 1, full, small, start, error)
      if (allocated(error)) return
      call full%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
      call small%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
      do k = 1, 8
         y = start
         ! the rod aside by more than the clearance
         y(1:2) = y(1:2) + 0.51e-3_wp*[cos(0.9_wp*k), sin(0.9_wp*k)]
         y(7:8) = y(7:8) + [0.3_wp, -0.2_wp]*k
         call compare_at(full, small, 0.0_wp, y, error)
         if (allocated(error)) return
         call check_true(error, maxval(abs(small%clearance_joints%integrands(loss_contact, :))) > 0.0_wp, &
                         "the contact loses energy")
         call check_true(error, abs(small%linkage%solution%lambda(small%linkage%reduced%known%held(1)%row(3))) > 0.1_wp, &
                         "the driver carries it")
      end do
   end subroutine test_contact_on_a_known_body

   !> The loose pin between a rod guided by the crank and a slider guided by the ground, touching, with friction.
   subroutine test_contact_of_one_dof_bodies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: full, small
      real(wp), allocatable :: start(:), y(:)
      integer :: k

      call both_systems(slider_crank("", "damped", "rubbing", "clearance"), 1, full, small, start, error)
      if (allocated(error)) return
      call check_true(error, small%is_direct .and. .not. full%is_direct, "nothing is solved with the fewest coordinates")
      call full%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
      call small%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
      do k = 1, 8
         y = start
         ! the slider aside by more than the clearance, the rod turned somewhat
         y(1:2) = y(1:2) + [1.0e-4_wp*k, 0.51e-3_wp*(-1)**k]
         y(3:4) = y(3:4) + [20.0_wp, -0.3_wp]*k
         call compare_at(full, small, 1.0e-4_wp*k, y, error)
         if (allocated(error)) return
         call check_true(error, abs(small%clearance_joints%integrands(loss_friction, 1)) > 0.0_wp, "the contact rubs")
      end do
   end subroutine test_contact_of_one_dof_bodies

   !> Which scenes are evaluated the direct way, and that a driver that says no number fails there as elsewhere.
   subroutine test_direct(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: pendulum = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"plate 3 0.2 0.1 0"// &
         nl//"bob 0.5 0.004 0.4 0"//nl//"[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl// &
         "hub plate -0.1 0"//nl//"edge plate 0.1 0"//nl//"top bob -0.2 0"//nl//"[joint.revolute]"//nl//"name i j"//nl// &
         "axle base hub"//nl//"hinge edge top"//nl
      character(*), parameter :: driven = "[driver.angle]"//nl//"name joint angle"//nl, last = "[analysis.dynamic]"//nl//"end = 1 s"
      type(mechanism_t) :: system
      real(wp), allocatable :: start(:), ydot(:)
      integer :: status

      call start_text(pendulum//last, system, start, error)
      if (allocated(error)) return
      call check_true(error, .not. system%is_direct, "a pendulum on another has unknown bodies")
      call start_text(pendulum//driven//"motor axle {1 rad*sqrt(1 - t/1s)}"//nl//last, system, start, error)
      if (allocated(error)) return
      call check_true(error, system%is_direct, "one on a driven plate has none")
      ydot = start
      call system%evaluate(0.5_wp, start, ydot, status)
      call check_equal(error, status, 0, "where the driver has an angle")
      call system%evaluate(1.5_wp, start, ydot, status)
      call check_equal(error, status, 1, "where it has none")
   end subroutine test_direct

   !> Drivers in series and of either sense, a weld, loads on prescribed bodies.
   subroutine test_robot_arm(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_often(arm//"[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte", 3, 1.5_wp, error)
   end subroutine test_robot_arm

   !> A driven plate that carries two pendulums and two sliders, each with its joint the one way round and the other, and as many
   !> on the ground: one coordinate each, and all that is reported as with three.
   subroutine test_one_dof(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: deck = "[scene]"//nl//"gravity = 0.5 -9.81 m/s^2"//nl// &
         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] omega[rad/s]"//nl//"plate 3 0.2 0.1 0 0.2 0"//nl// &
         "bob_1 0.5 0.004 0.3 -0.2 0.4 2"//nl//"bob_2 0.6 0.005 -0.2 0.3 -0.7 1"//nl//"cart_1 0.8 0.01 0.4 0.1 0.9 0"//nl// &
         "cart_2 0.7 0.02 -0.3 0.1 -0.3 0"//nl//"bob_3 0.4 0.003 1.3 0 0.1 3"//nl//"cart_3 0.9 0.01 0 -1 0.6 0"//nl// &
         "cart_4 0.3 0.02 0 1 -0.4 0"//nl// &
         "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"far ground 1 0.1"//nl//"low ground 0.1 -1"//nl// &
         "high ground 0.1 1"//nl//"hub plate -0.1 0.01"//nl//"p_1 plate 0.2 0"//nl//"p_2 plate -0.2 0.1"//nl// &
         "p_3 plate 0.1 0.1"//nl//"p_4 plate -0.1 -0.1"//nl//"b_1 bob_1 -0.1 0.02"//nl//"b_2 bob_2 0.1 0.03"//nl// &
         "c_1 cart_1 0.03 0.02"//nl//"c_2 cart_2 -0.02 0.05"//nl//"b_3 bob_3 -0.2 0"//nl//"c_3 cart_3 0.01 0.02"//nl// &
         "c_4 cart_4 -0.02 0.03"//nl// &
         "[joint.revolute]"//nl//"name i j"//nl//"axle base hub"//nl//"hinge_1 p_1 b_1"//nl//"hinge_2 b_2 p_2"//nl// &
         "hinge_3 far b_3"//nl// &
         "[joint.translational]"//nl//"name i j axis axis_angle"//nl//"guide_1 p_3 c_1 x 0.3rad"//nl// &
         "guide_2 c_2 p_4 y -0.2rad"//nl//"guide_3 low c_3 x 0.1rad"//nl//"guide_4 c_4 high y 0.2rad"//nl// &
         "[driver.angle]"//nl//"name joint angle"//nl//"motor axle {0.4 rad*sin(3 rad/s*t)}"//nl// &
         "[force.spring]"//nl//"name i j stiffness[N/m] damping[N.s/m] free_length[m]"//nl//"s_1 b_1 c_1 90 3 0.2"//nl// &
         "s_2 c_2 far 40 1 0.3"//nl//"s_3 b_3 c_3 50 2 0.3"//nl//"s_4 b_2 c_4 60 1 0.2"//nl// &
         "[force.torque]"//nl//"name body moment"//nl//"twist bob_1 0.3N.m"//nl//"push cart_1 0.2N.m"//nl// &
         "[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte"
      type(mechanism_t) :: full, small
      real(wp), allocatable :: start(:)

      call both_systems(deck, 1, full, small, start, error)
      if (allocated(error)) return
      call check_equal(error, small%linkage%reduced%one_dof%n, 7, "guided bodies")
      call check_equal(error, small%linkage%reduced%one_dof%n_turning, 3, "those that turn")
      call check_equal(error, small%n_position, 7, "coordinates")
      call check_equal(error, small%linkage%rows%n_solve, 0, "rows that are solved")
      call check_true(error, small%is_direct, "its evaluation is direct")
      call compare_often(deck, 1, 1.0_wp, error)
   end subroutine test_one_dof

   !> Two bars between two driven cranks: prescribed bodies at both ends of a loop, which a distance closes.
   subroutine test_loop(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_often("[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
                         "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl// &
                         "left 1 0.01 0.1 0"//nl//"right 1.5 0.01 1.1 0"//nl//"bar 2 0.1 0.7 0"//nl// &
                         "[points]"//nl//"name body xi[m] eta[m]"//nl//"base_1 ground 0 0"//nl//"base_2 ground 1 0"//nl// &
                         "left_0 left -0.1 0"//nl//"left_1 left 0.1 0"//nl//"right_0 right -0.1 0"//nl// &
                         "right_1 right 0.1 0"//nl//"bar_0 bar -0.5 0"//nl//"bar_1 bar 0.5 0.2"//nl// &
                         "[joint.revolute]"//nl//"name i j"//nl//"one base_1 left_0"//nl//"two right_0 base_2"//nl// &
                         "low left_1 bar_0"//nl// &
                         "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"first one 7"//nl//"second two -7"//nl// &
                         "[joint.distance]"//nl//"name i j length[m]"//nl//"link bar_1 right_1 0.2"//nl// &
                         "[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte", 2, 1.0_wp, error)
   end subroutine test_loop

   !> A driven crank and a body that is free, or hangs on the crank. What ties the crank to the ground a second time, here a
   !> second driver, leaves all bodies unknown: the drivers share the moment, and the accelerations are those with one driver.
   subroutine test_two_drivers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer :: k

      do k = 1, n_solver_kinds()
         call check_twins(k, "[force.spring]"//nl//"name i j stiffness[N/m]"//nl//"coil arm_0 hand_0 5"//nl)
         call check_twins(k, "elbow arm_1 hand_0"//nl)
      end do

   contains

      !> One driver, and two that need the same by different formulas.
      subroutine check_twins(number, joint)
         integer, intent(in) :: number         !! of the solver
         character(*), intent(in) :: joint     !! row of the joint between both bodies, or a table of what joins them else

         class(augmented_t), allocatable :: solver
         type(mechanism_t) :: one, two
         type(wanted_rows_t) :: wanted
         real(wp), allocatable :: a(:), start(:), y(:), ydot_one(:), ydot_two(:)
         character(:), allocatable :: deck
         integer :: status

         if (allocated(error)) return
         call new_solver(number, solver)
         deck = "[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
                "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"arm 1 0.1 0.5 0"//nl//"hand 2 0.2 1.5 0"//nl// &
                "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"arm_0 arm -0.5 0"//nl// &
                "arm_1 arm 0.5 0"//nl//"hand_0 hand -0.5 0"//nl// &
                "[joint.revolute]"//nl//"name i j"//nl//"shoulder base arm_0"//nl//joint// &
                "[driver.angle]"//nl//"name joint angle"//nl//"motor shoulder {1 rad*sin(20 rad/s*t)}"//nl// &
                "spare shoulder {2 rad*sin(10 rad/s*t)*cos(10 rad/s*t)}"//nl// &
                "[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte"//nl//"solver = "//solver%name()
         call start_text(deck, two, y, error)
         if (.not. allocated(error)) call start_text(with_word(without(deck, "spare"), "fewest"), one, start, error)
         if (allocated(error)) return
         call check_equal(error, two%linkage%reduced%known%n, 0, "known bodies with two drivers")
         call check_equal(error, one%linkage%reduced%known%n, 1, "known bodies with one driver")
         if (allocated(error)) return
         allocate (ydot_one(one%n), ydot_two(two%n), a(6), source=0.0_wp)
         call one%evaluate(0.3_wp, start, ydot_one, status)
         call check_equal(error, status, 0, "status with one driver, "//solver%name())
         call complete_state(one, 0.3_wp, start, y)
         call two%evaluate(0.3_wp, y, ydot_two, status)
         call check_equal(error, status, 0, "status with two drivers, "//solver%name())
         call one%linkage%set_state(0.3_wp, start, ydot_one)
         a = [one%linkage%motion%a(1:2, 1), one%linkage%motion%alpha(3, 1), one%linkage%motion%a(1:2, 2), &
             one%linkage%motion%alpha(3, 2)]
         call check_close(error, ydot_two(7:12), a, 1.0e-9_wp, "accelerations with two drivers, "//solver%name(), relative=.true.)
         call one%linkage%list_wanted(spread(.true., 1, one%linkage%rows%n), wanted)
         call one%linkage%find_reactions(0.3_wp, one%loading%g, wanted)
         associate (moment => one%linkage%solution%lambda(one%linkage%reduced%known%held(1)%row(3)), &
                    shares => two%linkage%solution%lambda(size(two%linkage%solution%lambda) - 1:))
            call check_close(error, shares, 0.5_wp*[moment, moment], 1.0e-6_wp, "halves of the moment, "//solver%name(), &
                             relative=.true.)
            call check_true(error, abs(moment) > 1.0_wp, "there is a moment")
         end associate
      end subroutine check_twins

   end subroutine test_two_drivers

   !> A deck without the line that starts with a word.
   function without(deck, word) result(text)
      character(*), intent(in) :: deck     !! the deck
      character(*), intent(in) :: word     !! first of the line
      character(:), allocatable :: text    !! the rest

      integer :: first

      first = index(deck, nl//word//" ")
      text = deck(:first - 1)//deck(first + index(deck(first + 1:), nl):)
   end function without

   !> A body whose driver jumps, in its value or a derivative, stays unknown; so do those that hang on it.
   subroutine test_smooth(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_known("{0.1 rad*sin(2 rad/s*t)}", 2)
      call check_known("{0.1 rad*exp(-t/1s)*cos(1 rad/s*t)^2}", 2)
      call check_known("{0.1 rad*abs(t/1s - 0.2)}", 0)
      call check_known("{0.1 rad*max(0, t/1s - 0.2)}", 0)
      call check_known("{0.1 rad*min(0.3, t/1s)}", 0)
      call check_known("{0.1 rad*step(t/1s - 0.3)}", 0)

   contains

      !> Two driven links in series, the first by the given function.
      subroutine check_known(angle, expected)
         character(*), intent(in) :: angle    !! of the first
         integer, intent(in) :: expected      !! prescribed bodies

         type(mechanism_t) :: system

         if (allocated(error)) return
         call system_of_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl// &
                             "first 1 0.1 0.5 0"//nl//"second 1 0.1 1.5 0"//nl//"third 1 0.1 2.5 0"//nl// &
                             "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"a first -0.5 0"//nl// &
                             "b first 0.5 0"//nl//"c second -0.5 0"//nl//"d second 0.5 0"//nl//"e third -0.5 0"//nl// &
                             "[joint.revolute]"//nl//"name i j"//nl//"one base a"//nl//"two b c"//nl//"three d e"//nl// &
                             "[driver.angle]"//nl//"name joint angle"//nl//"lift one "//angle//nl//"bend two {0.2 rad*t/1s}"//nl// &
                             "[analysis.dynamic]"//nl//"end = 1 s", system, error)
         if (.not. allocated(error)) call check_equal(error, system%linkage%reduced%known%n, expected, "known bodies with "//angle)
      end subroutine check_known

   end subroutine test_smooth

   !> Without any unknown body nothing would control the step: all stay unknown, also beside a body that they have nothing to do
   !> with. A wheel that a motor turns evenly about its centre of mass asks for no step.
   subroutine test_all_driven(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_driven("-0.5", "", 0, 1)
      call check_driven("-0.5", "stone 1 0.1 9 9"//nl, 0, 2)
      call check_driven("0", "stone 1 0.1 9 9"//nl, 1, 1)

   contains

      !> A driven crank, alone or with another body.
      subroutine check_driven(xi, other, n_known, n_unknown)
         character(*), intent(in) :: xi       !! where the crank is held, in m along its axis
         character(*), intent(in) :: other    !! row of another body, or nothing
         integer, intent(in) :: n_known       !! prescribed bodies that are expected
         integer, intent(in) :: n_unknown     !! unknown ones

         type(mechanism_t) :: system

         if (allocated(error)) return
         call system_of_text("[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"crank 1 0.1 0.5 0"//nl//other// &
                             "[points]"//nl//"name body xi[m] eta[m]"//nl//"base ground 0 0"//nl//"heel crank "//xi//" 0"//nl// &
                             "[joint.revolute]"//nl//"name i j"//nl//"main base heel"//nl// &
                             "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor main 5"//nl// &
                             "[analysis.dynamic]"//nl//"end = 1 s", system, error)
         if (allocated(error)) return
         call check_equal(error, system%linkage%reduced%known%n, n_known, "known bodies")
         call check_equal(error, system%linkage%rows%n_unknown, n_unknown, "unknown bodies")
         call check_equal(error, system%linkage%rows%n_solve, merge(0, 3, n_known > 0), "rows that are solved")
      end subroutine check_driven

   end subroutine test_all_driven

   !> The scale of the rates counts the prescribed bodies: 5000 rpm of the crank, at whatever rest of the others.
   subroutine test_error_scales(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: scale(:), y(:), ydot(:)
      integer :: status

      call start_text(with_word(slider_crank("", "damped", "none", "clearance"), "fewest"), system, y, error)
      if (allocated(error)) return
      y(3:4) = 0.0_wp
      ydot = y
      scale = y
      call system%evaluate(0.0_wp, y, ydot, status)
      call system%weights(y, scale)
      call check_close(error, scale(3:4), 5000.0_wp/60.0_wp*two_pi*[1.0_wp, 0.06_wp], 1.0e-9_wp, &
                       "scales of the rates of rod and slider")
      call check_close(error, scale(1:2), [1.0_wp, 0.06_wp], 1.0e-15_wp, "scales of the rod's angle and the slider's way")
   end subroutine test_error_scales

   !> Works and energies after a run agree, and the ledger closes in both.
   subroutine test_works(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_works(arm, 1.0_wp, 1.0_wp, error)
   end subroutine test_works

end module test_known_bodies
