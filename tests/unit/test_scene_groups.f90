!> Groups of bodies that nothing joins: which they are, and that the scene of a group means what it meant in the whole.
module test_scene_groups
   use build_system, only: levels_as_written, new_system
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use scene_fixture, only: nl, read_scene_text
   use scene_groups, only: begin_group_scene, find_groups, groups_t, set_group_scene
   implicit none (type, external)
   private
   public :: run_test_scene_groups

   !> Bodies a and d by a joint, b and e by a spring, c and f by a clearance joint; g is free, h is driven.
   character(*), parameter :: deck = &
      "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"a 1 1 0 0"//nl//"b 2 1 1 0"//nl//"c 3 1 2 0" &
      //nl//"d 4 1 0 0"//nl//"e 5 1 1 1"//nl//"f 6 1 2 0"//nl//"g 7 1 3 0"//nl//"h 8 1 4 0"//nl//"[points]" &
      //nl//"name body xi[m] eta[m]"//nl//"gh ground 4 0"//nl//"pa a 0 0"//nl//"pb b 0 0"//nl//"pc c 0 0" &
      //nl//"pd d 0 0"//nl//"pe e 0 0"//nl//"pf f 0 0"//nl//"pg g 0.5 0"//nl//"ph h 0 0"//nl//"gg ground 3 0" &
      //nl//"[joint.revolute]"//nl//"name i j"//nl//"hd pd pa"//nl//"hh gh ph"//nl//"[driver.speed]" &
      //nl//"name joint speed"//nl//"m hh 1rad/s"//nl//"[force.spring]"//nl//"name i j stiffness[N/m]" &
      //nl//"s pb pe 10"//nl//"t gg pg 20"//nl//"[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3" &
      //nl//"[contact.hertz]"//nl//"name"//nl//"hz"//nl//"[clearance.revolute]" &
      //nl//"name bearing journal bearing_radius[mm] clearance[mm] length[mm] material law" &
      //nl//"l pc pf 10 0.1 15 steel hz"//nl//"[analysis.dynamic]"//nl//"end = 1 s"

contains

   subroutine run_test_scene_groups(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("which", test_which)
      call suite%test("as_in_the_whole", test_as_in_the_whole)
   end subroutine run_test_scene_groups

   !> The driven body has no unknowns and goes with the first group.
   subroutine test_which(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(scene_t) :: scene
      type(groups_t) :: groups

      call read_scene_text(deck, scene, error)
      if (allocated(error)) return
      call find_groups(scene, groups)
      call check_equal(error, groups%n, 4, "groups")
      if (allocated(error)) return
      call check_bodies(1, [1, 4, 8])
      call check_bodies(2, [2, 5])
      call check_bodies(3, [3, 6])
      call check_bodies(4, [7])

   contains

      !> Bodies of a group.
      subroutine check_bodies(group, bodies)
         integer, intent(in) :: group        !! number of the group
         integer, intent(in) :: bodies(:)    !! (any) what it should have

         call check_close(error, real(groups%bodies_of(group), wp), real(bodies, wp), 0.0_wp, "bodies of a group")
      end subroutine check_bodies

   end subroutine test_which

   !> Accelerations of a group alone are those in the whole.
   subroutine test_as_in_the_whole(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(scene_t) :: one, scene
      type(groups_t) :: groups
      type(mechanism_t) :: part, whole
      real(wp), allocatable :: a(:, :)
      integer :: g, k

      call read_scene_text("[scene]"//nl//"gravity = 1 -9.81 m/s^2"//nl//deck, scene, error)
      if (allocated(error)) return
      call find_groups(scene, groups)
      call new_system(scene, levels_as_written, whole)
      call accelerations(whole, a)
      call begin_group_scene(scene, one)
      do g = groups%n, 1, -1
         call set_group_scene(scene, groups, g, one)
         call new_system(one, levels_as_written, part)
         call check_close(error, part%linkage%scales%length, whole%linkage%scales%length, 0.0_wp, "size")
         associate (bodies => groups%bodies_of(g))
            do k = 1, size(bodies)
               call check_true(error, part%linkage%bodies%names(k)%s == whole%linkage%bodies%names(bodies(k))%s, "names")
            end do
            call compare(a(:, bodies))
         end associate
         if (allocated(error)) return
      end do

   contains

      !> Accelerations of the part, at the start.
      subroutine compare(expected)
         real(wp), intent(in) :: expected(:, :)   !! (6, bodies) [m/s^2, rad/s^2]

         real(wp), allocatable :: own(:, :)

         call accelerations(part, own)
         call check_close(error, reshape(own, [size(own)]), reshape(expected, [size(expected)]), 1.0e-13_wp, "accelerations")
      end subroutine compare

   end subroutine test_as_in_the_whole

   !> Accelerations of all bodies where the deck puts them, moving a little.
   subroutine accelerations(system, a)
      type(mechanism_t), intent(inout) :: system       !! the system
      real(wp), allocatable, intent(out) :: a(:, :)    !! (6, bodies) [m/s^2, rad/s^2]

      real(wp), allocatable :: q(:), v(:), y(:), ydot(:)
      integer :: status

      call system%linkage%deck_state(q, v)
      allocate (y(system%n), ydot(system%n), source=0.0_wp)
      call system%linkage%take_state(q, v, y)
      call system%evaluate(0.5_wp, y, ydot, status)
      call system%linkage%set_state(0.5_wp, y, ydot)
      associate (motion => system%linkage%motion, n => system%linkage%bodies%n)
         allocate (a(6, n))
         a(:3, :) = motion%a(:, 1:n)
         a(4:, :) = motion%alpha(:, 1:n)
      end associate
   end subroutine accelerations

end module test_scene_groups
