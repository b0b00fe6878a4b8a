!> Which bodies a row of a joint table ties: by points, by the joint that it drives, or by the bodies themselves.
module test_joint_bodies
   use build_system, only: levels_ideal
   use check, only: check_equal, check_true, suite_t
   use diagnostics, only: diagnostics_t
   use deck_scene, only: load_text, loaded_t
   use errors, only: error_t
   use find_one_dof, only: find_one_dof_bodies, guide_t
   use find_prescribed, only: find_prescribed_bodies, joint_bodies, link_t
   use item, only: item_t
   use joint_rigid, only: joint_rigid_t
   use kind_info, only: add_reference, kind_info_t
   use kinds, only: wp
   use references, only: directory_t, resolve
   use text, only: split_blank
   use ties, only: kind_number, tie_of, tie_set, tie_t
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
      call suite%test("by_joints", test_by_joints)
      call suite%test("names_of_joints", test_names_of_joints)
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

   !> A kind whose rows name bodies, not points.
   subroutine name_bodies(info, of_bodies)
      type(kind_info_t), intent(in) :: info         !! the kind
      type(kind_info_t), intent(out) :: of_bodies   !! the same, but for its first two columns

      of_bodies = info
      of_bodies%columns(1)%refers_to = "bodies"
      of_bodies%columns(2)%refers_to = "bodies"
   end subroutine name_bodies

   !> A kind whose rows name bodies ties these, and not the bodies of the points of the same numbers: the rod stays unguided,
   !> for the weld holds it too, and the crank is known as before.
   subroutine test_by_bodies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(guide_t), allocatable :: guides(:)
      type(kind_info_t), target :: of_bodies
      type(link_t), allocatable :: links(:)
      type(loaded_t) :: loaded
      integer :: weld

      call load_text(deck, loaded, error)
      if (allocated(error)) return
      weld = kind_number(loaded%scene, "joint.rigid")
      associate (table => loaded%scene%joints(weld))
         call name_bodies(table%info, of_bodies)
         table%info => of_bodies
         table%items(1)%values(1)%index = 2
         table%items(1)%values(2)%index = 3
      end associate
      call check_true(error, all(joint_bodies(loaded%scene, weld, 1) == [2, 3]), "weld of bodies")
      call find_prescribed_bodies(loaded%scene, links)
      call check_equal(error, size(links), 1, "known bodies")
      call check_equal(error, links(1)%body, 1, "the crank")
      call find_one_dof_bodies(loaded%scene, [.true., .true., .false., .false.], levels_ideal, guides)
      call check_equal(error, size(guides), 0, "guided bodies")
   end subroutine test_by_bodies

   !> The set of such a kind has the centres of mass as its points.
   subroutine test_set_of_bodies(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(joint_rigid_t) :: set
      type(kind_info_t), target :: of_bodies
      type(loaded_t) :: loaded
      integer :: weld

      call load_text(deck, loaded, error)
      if (allocated(error)) return
      weld = kind_number(loaded%scene, "joint.rigid")
      associate (table => loaded%scene%joints(weld))
         call name_bodies(table%info, of_bodies)
         table%info => of_bodies
         table%items(1)%values(1)%index = 2
         table%items(1)%values(2)%index = 0
         call tie_set(loaded%scene, table%info, table%items, set)
      end associate
      call check_true(error, all(set%body(:, 1) == [2, 0]), "bodies")
      call check_true(error, all(abs([set%s_i, set%s_j]) <= 0.0_wp), "points are the centres of mass")
      call check_equal(error, set%n, 1, "items")
   end subroutine test_set_of_bodies

   !> A row that names two joints ties the bodies that these do not share, where the joints hold them; one that names a joint ties
   !> what this one does. Which kinds of joints a column may name is for the kind to say.
   subroutine test_by_joints(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(item_t) :: item
      type(kind_info_t) :: info
      type(loaded_t) :: loaded
      type(tie_t) :: tie
      integer :: k, weld

      call load_text(deck, loaded, error)
      if (allocated(error)) return
      associate (scene => loaded%scene)
         weld = kind_number(scene, "joint.rigid")
         call add_reference(info, "joint_i", "joint.revolute joint.rigid", "a joint")
         allocate (item%values(2))
         item%values(1)%index = 2
         tie = tie_of(scene, info, item)
         call check_true(error, tie%by_joint .and. tie%n == 1, "one joint")
         call check_true(error, all(tie%body == [1, 2]), "crank and rod")
         call check_equal(error, scene%points%names(tie%point(2))%s, "big", "on the rod")
         call add_reference(info, "joint_j", "joint.", "any joint")
         item%values(2)%index = 1 + sum([(size(scene%joints(k)%items), k=1, weld - 1)])
         tie = tie_of(scene, info, item)
         call check_true(error, tie%n == 2, "two joints")
         call check_true(error, all(tie%body == [1, 3]), "crank and lid, not the rod")
         call check_equal(error, scene%points%names(tie%point(1))%s, "throw", "on the crank")
         call check_equal(error, scene%points%names(tie%point(2))%s, "edge", "on the lid")
      end associate
   end subroutine test_by_joints

   !> References to joints are resolved among the kinds that the column takes, and the others are unknown; the words say which.
   subroutine test_names_of_joints(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(diagnostics_t) :: mistakes
      type(directory_t) :: directory
      type(item_t) :: items(1)
      type(kind_info_t) :: info

      directory%joints = split_blank("main motor guide")
      directory%kinds = split_blank("joint.revolute driver.speed joint.translational")
      info%name = "joint.pair"
      call add_reference(info, "any", "joint.", "any joint")
      call add_reference(info, "two", "joint.revolute joint.translational", "one of two kinds")
      call add_reference(info, "one", "joint.revolute", "a pin")
      allocate (items(1)%values(3))
      items(1)%values(1)%text = "guide"
      items(1)%values(2)%text = "guide"
      items(1)%values(3)%text = "main"
      call resolve(directory, info, items, mistakes)
      call check_equal(error, mistakes%count(), 0, "all known")
      call check_true(error, all(items(1)%values%index == [3, 3, 1]), "numbers among all joints")
      items(1)%values(2)%text = "motor"
      call resolve(directory, info, items, mistakes)
      call check_equal(error, mistakes%count(), 1, "a driver is no joint")
      items(1)%values(2)%text = "main"
      items(1)%values(3)%text = "guide"
      call resolve(directory, info, items, mistakes)
      call check_equal(error, mistakes%count(), 2, "a guide is no pin")
   end subroutine test_names_of_joints

end module test_joint_bodies
