!> Known and bodies with one degree of freedom of space against the same deck with all bodies among the unknowns: see
!> `reduction_comparison`.
module test_reduced_in_space
   use check, only: check_equal, check_true, suite_t
   use clearance_set, only: loss_contact
   use errors, only: error_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use reduction_comparison, only: both_systems, compare_at, compare_often, compare_works
   use scene_fixture, only: nl
   implicit none (type, external)
   private
   public :: run_test_reduced_in_space

   character(*), parameter :: scene = "[scene]"//nl//"space = spatial"//nl//"gravity = 0.5 -9.81 1 m/s^2"//nl
   character(*), parameter :: body_columns = "[bodies]"//nl// &
      "name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] ixy[kg.m^2] x[m] y[m] z[m] axis angle[deg]"//nl
   character(*), parameter :: points = "[points]"//nl//"name body xi[m] eta[m] zeta[m]"//nl

   !> Two driven links in series about skew axes, the second joint with its body i as the moving one; a plate welded to the second
   !> link, a hand hung on the plate by a ball, springs, gravity.
   character(*), parameter :: arm = scene//body_columns// &
      'upper 2.0 0.05 0.06 0.03 0.01 0.2 0 0 "1 1 0" 20'//nl//'lower 1.2 0.03 0.02 0.04 0 0.4 0.2 0.1 "0 1 3" 50'//nl// &
      'plate 0.5 0.004 0.005 0.006 0.001 0.4 0.45 0.1 "1 0 2" -30'//nl// &
      'hand 0.4 0.002 0.003 0.002 0 0.5 0.5 0.2 "1 2 2" 70'//nl// &
      points//"base ground 0 0 0"//nl//"far ground 1 1 0.5"//nl// &
      "upper_0 upper -0.2 0 0.01"//nl//"upper_1 upper 0.2 0 0"//nl//"lower_0 lower -0.2 0 0.02"//nl//"lower_1 lower 0.2 0 0"//nl// &
      "plate_0 plate -0.05 0.01 0"//nl//"plate_1 plate 0.06 0.02 0.03"//nl//"hand_0 hand -0.04 0 0.01"//nl// &
      "hand_1 hand 0.1 0.02 0"//nl// &
      "[joint.spherical]"//nl//"name i j"//nl//"wrist plate_1 hand_0"//nl// &
      "[joint.revolute]"//nl//"name i j axis_i axis_j"//nl//'shoulder base upper_0 "1 2 3" "0.3 2 1"'//nl// &
      'elbow lower_0 upper_1 "0 1 1" "1 1 -0.2"'//nl// &
      "[joint.rigid]"//nl//"name i j"//nl//"weld plate_0 lower_1"//nl// &
      "[driver.angle]"//nl//"name joint angle"//nl//"lift shoulder {0.4 rad*sin(3 rad/s*t)}"//nl// &
      "bend elbow {-90 deg + 2 rad*(t/1s)^2}"//nl// &
      "[force.spring]"//nl//"name i j stiffness[N/m] damping[N.s/m] free_length[m]"//nl//"band far hand_1 90 3 0.2"//nl// &
      "rope far lower_1 40 1 0.3"//nl

   !> A driven plate that carries two pendulums and two sliders, each with its joint the one way round and the other, and as many on
   !> the ground, about skew axes.
   character(*), parameter :: carousel = scene//body_columns// &
      'plate 3 0.2 0.3 0.25 0.02 0.1 0 0 "0 0 1" 10'//nl//'bob_1 0.5 0.004 0.005 0.003 0.001 0.3 -0.2 0.1 "1 0 1" 25'//nl// &
      'bob_2 0.6 0.005 0.006 0.004 0 -0.2 0.3 0 "1 1 0" -40'//nl//'cart_1 0.8 0.01 0.012 0.014 0.002 0.4 0.1 0 "0 1 1" 50'//nl// &
      'cart_2 0.7 0.02 0.02 0.03 0 -0.3 0.1 0.1 "1 2 0" -20'//nl//'bob_3 0.4 0.003 0.004 0.003 0 1.3 0 0 "2 0 1" 5'//nl// &
      'bob_4 0.5 0.004 0.004 0.005 0.001 -1.3 0 0.2 "2 1 1" 15'//nl// &
      'cart_3 0.9 0.01 0.01 0.012 0 0 -1 0 "0 2 1" 35'//nl//'cart_4 0.3 0.02 0.02 0.03 0.003 0 1 0.1 "1 1 1" -25'//nl// &
      points//"base ground 0 0 0"//nl//"far ground 1 0.1 0"//nl//"aft ground -1 0.1 0.1"//nl//"low ground 0.1 -1 0"//nl// &
      "high ground 0.1 1 0"//nl// &
      "hub plate -0.1 0.01 0.02"//nl//"p_1 plate 0.2 0 0.05"//nl//"p_2 plate -0.2 0.1 0"//nl//"p_3 plate 0.1 0.1 0"//nl// &
      "p_4 plate -0.1 -0.1 0.1"//nl//"b_1 bob_1 -0.1 0.02 0.03"//nl//"b_2 bob_2 0.1 0.03 0"//nl//"c_1 cart_1 0.03 0.02 0.01"//nl// &
      "c_2 cart_2 -0.02 0.05 0"//nl//"b_3 bob_3 -0.2 0 0.1"//nl//"b_4 bob_4 0.2 0.1 0"//nl//"c_3 cart_3 0.01 0.02 0.02"//nl// &
      "c_4 cart_4 -0.02 0.03 0"//nl// &
      "[joint.revolute]"//nl//"name i j axis_i axis_j"//nl//'axle base hub "1 0 3" "0 1 4"'//nl// &
      'hinge_1 p_1 b_1 "1 1 0" "0 1 2"'//nl//'hinge_2 b_2 p_2 "1 0 0" "0 1 1"'//nl//'hinge_3 far b_3 "0 1 0" "1 1 1"'//nl// &
      'hinge_4 b_4 aft "0 1 3" "1 1 0"'//nl// &
      "[joint.translational]"//nl//"name i j axis_i"//nl//'guide_1 p_3 c_1 "1 0 2"'//nl//'guide_2 c_2 p_4 "0 1 1"'//nl// &
      'guide_3 low c_3 "1 0.2 0"'//nl//'guide_4 c_4 high "0 1 0.5"'//nl// &
      "[driver.angle]"//nl//"name joint angle"//nl//"motor axle {0.4 rad*sin(3 rad/s*t) + 9 rad/s*t}"//nl// &
      "[force.spring]"//nl//"name i j stiffness[N/m] damping[N.s/m] free_length[m]"//nl//"s_1 b_1 c_1 90 3 0.2"//nl// &
      "s_2 c_2 far 40 1 0.3"//nl//"s_3 b_3 c_3 50 2 0.3"//nl//"s_4 b_2 c_4 60 1 0.2"//nl// &
      "s_6 b_3 p_1 20 1 0.5"//nl//"s_5 b_4 c_4 30 1 0.2"//nl// &
      "[force.torque]"//nl//"name body mx my mz"//nl//"twist bob_1 0.3N.m 0.1N.m 0.2N.m"//nl//"push cart_1 0.2N.m 0N.m 0N.m"//nl

contains

   subroutine run_test_reduced_in_space(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("robot_arm", test_robot_arm)
      call suite%test("guided_bodies", test_one_dof)
      call suite%test("contact", test_contact)
      call suite%test("works", test_works)
   end subroutine run_test_reduced_in_space

   !> Drivers in series and of either sense about skew axes, a weld, loads on prescribed bodies.
   subroutine test_robot_arm(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_often(arm//"[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte", 3, 1.5_wp, error)
   end subroutine test_robot_arm

   !> One coordinate each, and all that is reported as with six.
   subroutine test_one_dof(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: deck = carousel//"[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte"
      type(mechanism_t) :: full, small
      real(wp), allocatable :: start(:)

      call both_systems(deck, 1, full, small, start, error)
      if (allocated(error)) return
      call check_equal(error, small%linkage%reduced%one_dof%n, 8, "guided bodies")
      call check_equal(error, small%linkage%reduced%one_dof%n_turning, 4, "those that turn")
      call check_equal(error, small%linkage%n_position, 8, "coordinates")
      call check_equal(error, small%linkage%rows%n_solve, 0, "rows that are solved")
      call compare_often(deck, 1, 1.0_wp, error)
   end subroutine test_one_dof

   !> A pin on a driven crank in a bushing of a rod that slides and tilts: the forces at both bases are carried by the driver.
   subroutine test_contact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: deck = scene//body_columns//'crank 0.3 1e-3 2e-3 1e-3 0 0.025 0 0 "0 1 0" 0'//nl// &
         'rod 0.2 2e-4 3e-4 4e-4 0 0.11 0.0005 0 "1 0 0" 0'//nl// &
         points//"main ground 0 0 0"//nl//"heel crank -0.025 0 0"//nl//"throw crank 0.025 0 0"//nl//"big rod -0.06 0 0"//nl// &
         "[joint.revolute]"//nl//"name i j axis_i"//nl//'main main heel "0 1 0"'//nl// &
         "[driver.speed]"//nl//"name joint speed[rad/s]"//nl//"motor main 50"//nl// &
         "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
         "[contact.lankarani_nikravesh]"//nl//"name restitution"//nl//"hard 0.8"//nl// &
         "[friction.ambrosio]"//nl//"name coefficient v0[m/s] v1[m/s]"//nl//"rubbing 0.1 1e-4 1e-3"//nl// &
         "[clearance.revolute]"//nl// &
         "name bearing journal axis_i bearing_radius[mm] clearance[mm] length[mm] material law friction"//nl// &
         'pin throw big "0 1 0" 10 0.5 15 steel hard rubbing'//nl// &
         "[analysis.dynamic]"//nl//"end = 1 s"//nl//"stabilise = baumgarte"
      type(mechanism_t) :: full, small
      real(wp), allocatable :: start(:), y(:)
      integer :: k

      call both_systems(deck, 1, full, small, start, error)
      if (allocated(error)) return
      do k = 1, 2
         call full%clearance_joints%sets(1)%set%begin_contact(k, 0.0_wp, 2.0_wp, 0.0_wp)
         call small%clearance_joints%sets(1)%set%begin_contact(k, 0.0_wp, 2.0_wp, 0.0_wp)
      end do
      do k = 1, 8
         y = start
         ! the rod aside by more than the clearance, tilted
         y(1:3) = y(1:3) + 0.51e-3_wp*[cos(0.9_wp*k), 0.3_wp, sin(0.9_wp*k)]
         y(5) = y(5) + 1.0e-3_wp*sin(0.4_wp*k)
         y(8:10) = y(8:10) + [0.3_wp, -0.2_wp, 0.1_wp]*k
         call compare_at(full, small, 0.0_wp, y, error)
         if (allocated(error)) return
         call check_true(error, maxval(abs(small%clearance_joints%integrands(loss_contact, :))) > 0.0_wp, &
                         "the contact loses energy")
         call check_true(error, abs(small%linkage%solution%lambda(small%linkage%reduced%known%held(1)%row(6))) > 0.01_wp, &
                         "the driver carries it")
      end do
   end subroutine test_contact

   !> Works and energies after a run agree, and the ledger closes in both: with prescribed bodies, and with guided ones.
   subroutine test_works(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_works(arm, 0.5_wp, 0.1_wp, error)
      if (.not. allocated(error)) call compare_works(carousel, 0.5_wp, 0.1_wp, error)
   end subroutine test_works

end module test_reduced_in_space
