!> Which bodies a row of a joint table ties: by points, by the joint that it drives, or by the bodies themselves.
module test_joint_bodies
   use build_system, only: levels_ideal
   use check, only: check_equal, check_true, suite_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t
   use find_guided, only: find_guided_bodies, guide_t
   use find_known, only: find_known_bodies, joint_bodies, kind_number, link_t
   use joint_rigid, only: joint_rigid_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_joint_bodies

   character(*), parameter :: nl = new_line("a")

   !> Three bodies: a crank that is driven, a rod on it, a lid welded to the rod; points in another order than bodies.
   character(*), parameter :: deck = &
      "deck = 1"//nl//"[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl// &
      "crank 1 1 0.5 0"//nl//"rod 1 1 1.5 0"//nl//"lid 1 1 2 0"//nl// &
      "[points]"//nl//"name body xi[m] eta[m]"//nl//"tip rod 0.5 0"//nl//"edge lid 0 0"//nl//"base ground 0 0"//nl// &
      "heel crank -0.5 0"//nl//"throw crank 0.5 0"//nl//"big rod -0.5 0"//nl// &
      "[joint.revolute]"//nl//"name i j"//nl//"main base heel"//nl//"pin throw big"//nl// &
      "[joint.rigid]"//nl//"name i j"//nl//"weld tip edge"//nl// &
      "[driver.speed]"//nl//"name joint speed"//nl//"motor main 1rad/s"//nl// &
      "[analysis.dynamic]"//nl//"end = 1 s"//nl

contains

   subroutine run_test_joint_bodies(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("by_points_and_drivers", test_by_points_and_drivers)
      call suite%test("by_bodies", test_by_bodies)
      call suite%test("set_of_bodies", test_set_of_bodies)
   end subroutine run_test_joint_bodies

   !> Points lead to their bodies, a driver to those of its joint.
   subroutine test_by_points_and_drivers(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(loaded_t) :: loaded

      call load_text(deck, loaded, error)
      if (allocated(error)) return
      associate (scene => loaded%scene)
         call check_true(error, all(joint_bodies(scene, kind_number(scene, "joint.revolute"), 2) == [1, 2]), "pin")
         call check_true(error, all(joint_bodies(scene, kind_number(scene, "joint.rigid"), 1) == [2, 3]), "weld")
         call check_true(error, all(joint_bodies(scene, kind_number(scene, "driver.speed"), 1) == [0, 1]), "motor")
      end associate
   end subroutine test_by_points_and_drivers

   !> A kind whose rows name bodies ties these, and not the bodies of the points of the same numbers: the rod stays unguided,
   !> for the weld holds it too, and the crank is known as before.
   subroutine test_by_bodies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(guide_t), allocatable :: guides(:)
      type(link_t), allocatable :: links(:)
      type(loaded_t) :: loaded
      integer :: weld

      call load_text(deck, loaded, error)
      if (allocated(error)) return
      weld = kind_number(loaded%scene, "joint.rigid")
      associate (table => loaded%scene%joints(weld))
         table%info%columns(1)%refers_to = "bodies"
         table%info%columns(2)%refers_to = "bodies"
         table%items(1)%values(1)%index = 2
         table%items(1)%values(2)%index = 3
      end associate
      call check_true(error, all(joint_bodies(loaded%scene, weld, 1) == [2, 3]), "weld of bodies")
      call find_known_bodies(loaded%scene, links)
      call check_equal(error, size(links), 1, "known bodies")
      call check_equal(error, links(1)%body, 1, "the crank")
      call find_guided_bodies(loaded%scene, [.true., .true., .false., .false.], levels_ideal, guides)
      call check_equal(error, size(guides), 0, "guided bodies")
   end subroutine test_by_bodies

   !> The set of such a kind has the centres of mass as its points.
   subroutine test_set_of_bodies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(joint_rigid_t) :: set
      type(loaded_t) :: loaded

      call load_text(deck, loaded, error)
      if (allocated(error)) return
      call set%new_of_bodies(loaded%scene%joints(kind_number(loaded%scene, "joint.rigid"))%items, [2], [0])
      call check_true(error, all(set%body(:, 1) == [2, 0]), "bodies")
      call check_true(error, all(abs([set%s_i, set%s_j]) <= 0.0_wp), "points are the centres of mass")
      call check_equal(error, set%n, 1, "items")
   end subroutine test_set_of_bodies

end module test_joint_bodies
