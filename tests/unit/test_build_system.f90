!> From a scene to its system: which joints are ideal, which loose ones share a set, laws and stiffnesses.
module test_build_system
   use build_system, only: levels_as_written, levels_ideal, new_system
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use scene, only: scene_t
   use scene_fixture, only: channel_of, nl, read_scene_text, slider_crank, system_of_text
   use text, only: replace, to_text
   implicit none (type, external)
   private
   public :: run_test_build_system

   real(wp), parameter :: steel_pin = 6.61019840e10_wp  !! 9.5 mm pin in a 10 mm hole, steel [N/m^1.5]

contains

   subroutine run_test_build_system(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("sets_share_laws", test_sets_share_laws)
      call suite%test("ideal_twin", test_ideal_twin)
      call suite%test("stiffness", test_stiffness)
      call suite%test("law_without_effect", test_law_without_effect)
      call suite%test("names_of_rows", test_names_of_rows)
      call suite%test("energy_of_several_contacts", test_energy_of_several_contacts)
   end subroutine run_test_build_system

   !> One body in six bearings of all sorts.
   function six_bearings() result(deck)
      character(:), allocatable :: deck     !! the deck

      character(*), parameter :: tail(6) = ["steel none   clearance hertz  none   ", "steel bronze clearance damped rubbing", &
                                            "steel none   clearance hertz  none   ", "steel none   ideal     hertz  none   ", &
                                            "steel none   clearance hertz  rubbing", "steel none   clearance fixed  none   "]
      integer :: k

      deck = "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m]"//nl//"shaft 2 0.05 0 0"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl
      do k = 1, 6
         deck = deck//"hole_"//to_text(k)//" ground 0."//to_text(k)//" 0"//nl//"pin_"//to_text(k)//" shaft 0."//to_text(k)//" 0"//nl
      end do
      deck = deck//"[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl//"bronze 103.5 0.3"//nl// &
             "[contact.hertz]"//nl//"name stiffness[N/m^1.5]"//nl//"hertz 0"//nl//"fixed 3e9"//nl// &
             "[contact.lankarani_nikravesh]"//nl//"name restitution"//nl//"damped 0.9"//nl// &
             "[friction.ambrosio]"//nl//"name coefficient v0[m/s] v1[m/s]"//nl//"rubbing 0.1 1e-4 1e-3"//nl// &
             "[clearance.revolute]"//nl// &
             "name bearing journal bearing_radius[mm] clearance[mm] material journal_material level law friction"//nl
      do k = 1, 6
         deck = deck//"loose_"//to_text(k)//" hole_"//to_text(k)//" pin_"//to_text(k)//" 10 0.5 "//tail(k)//nl
      end do
      deck = deck//"[analysis.dynamic]"//nl//"end = 1 s"
   end function six_bearings

   !> Sets in the order of their first items; items that share both laws are together; numbers go through all sets.
   subroutine test_sets_share_laws(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      character(*), parameter :: expected(5) = ["loose_1", "loose_3", "loose_2", "loose_5", "loose_6"]
      integer :: item, k, slot

      call system_of_text(six_bearings(), system, error)
      if (allocated(error)) return
      call check_equal(error, size(system%clearance_joints%sets), 4, "sets")
      call check_equal(error, system%clearance_joints%n, 5, "loose joints")
      call check_equal(error, system%n_event, 5, "event functions")
      if (allocated(error)) return
      do k = 1, 5
         call system%find_contact(k, slot, item)
         call check_equal(error, system%clearance_joints%sets(slot)%set%names(item)%s, expected(k), "loose joint "//to_text(k))
         call check_equal(error, system%clearance_joints%sets(slot)%set%before%contacts + item, k, "its number")
      end do
      call check_equal(error, system%clearance_joints%sets(1)%set%n, 2, "items that share laws")
      call check_true(error, .not. allocated(system%clearance_joints%sets(1)%set%laws%friction), "no friction in the first set")
      call check_true(error, allocated(system%clearance_joints%sets(3)%set%laws%friction), "friction in the third")
      call check_equal(error, system%clearance_joints%sets(2)%set%laws%normal%name, "damped", "law of the second")
      call check_equal(error, system%linkage%rows%n, 2, "rows of the ideal one")
      call check_equal(error, system%linkage%row_name(2), "loose_4", "name of its rows")
   end subroutine test_sets_share_laws

   !> The reference run without clearance has a revolute joint for each, and no events.
   subroutine test_ideal_twin(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: twin
      type(scene_t) :: scene

      call read_scene_text(slider_crank("", "damped", "none", "clearance"), scene, error)
      if (allocated(error)) return
      call new_system(scene, levels_ideal, twin)
      call check_equal(error, twin%clearance_joints%n, 0, "loose joints")
      call check_equal(error, twin%n_event, 0, "event functions")
      call check_equal(error, twin%linkage%rows%n, 9, "rows")
      call check_equal(error, twin%linkage%row_name(9), "gudgeon", "name of the last row")
      call new_system(scene, levels_as_written, twin)
      call check_equal(error, twin%clearance_joints%n, 1, "loose joints as the deck has them")
      call check_equal(error, twin%linkage%rows%n, 7, "rows as the deck has them")
   end subroutine test_ideal_twin

   !> From the materials of hole and pin, or as the law gives it.
   subroutine test_stiffness(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system

      call system_of_text(six_bearings(), system, error)
      if (allocated(error)) return
      call check_close(error, system%clearance_joints%sets(1)%set%laws%parameters(1, :), [steel_pin, steel_pin], 1.0e-8_wp, &
                       "steel", relative=.true.)
      ! bronze here is half as stiff as steel: compliances 1 + 2 instead of 1 + 1
      call check_close(error, system%clearance_joints%sets(2)%set%laws%parameters(1, :), [2.0_wp*steel_pin/3.0_wp], 1.0e-8_wp, &
                       "bronze pin", &
                       relative=.true.)
      call check_close(error, system%clearance_joints%sets(4)%set%laws%parameters(1, :), [3.0e9_wp], 0.0_wp, "given")
      call check_close(error, system%clearance_joints%sets(1)%set%items%pairs%clearance, [0.5e-3_wp, 0.5e-3_wp], 0.0_wp, &
                       "clearance")
   end subroutine test_stiffness

   !> Friction with coefficient zero is dropped.
   subroutine test_law_without_effect(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system

      call system_of_text(slider_crank("", "damped", "rubbing", "clearance"), system, error)
      if (allocated(error)) return
      call check_true(error, allocated(system%clearance_joints%sets(1)%set%laws%friction), "a law with effect")
      call system_of_text(replace(slider_crank("", "damped", "rubbing", "clearance"), "rubbing 0.1", "rubbing 0"), system, error)
      if (allocated(error)) return
      call check_true(error, .not. allocated(system%clearance_joints%sets(1)%set%laws%friction), "a law without")
   end subroutine test_law_without_effect

   !> Every joint has its rows; those of joints with clearance that are ideal come last.
   subroutine test_names_of_rows(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: names(5) = ["main   ", "big_end", "guide  ", "motor  ", "gudgeon"]
      integer, parameter :: n_row(5) = [2, 2, 2, 1, 2]
      type(mechanism_t) :: system
      integer :: k, n, row

      call system_of_text(slider_crank("", "damped", "none", "ideal"), system, error)
      if (allocated(error)) return
      do k = 1, 5
         n = 0
         do row = 1, system%linkage%rows%n
            if (system%linkage%row_name(row) == names(k)) n = n + 1
         end do
         call check_equal(error, n, n_row(k), "rows of "//names(k))
      end do
      call check_equal(error, system%linkage%row_name(8), "gudgeon", "last row but one")
      call check_equal(error, system%linkage%row_name(9), "gudgeon", "last row")
      call check_equal(error, system%linkage%row_name(10), "?", "no row")
   end subroutine test_names_of_rows

   !> Channels of each contact are its own, whatever set it is in; elastic energies add up.
   subroutine test_energy_of_several_contacts(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: delta, energy
      integer :: k

      call system_of_text(six_bearings(), system, error)
      if (allocated(error)) return
      allocate (y(system%n), source=0.0_wp)
      ! turned by a small angle: pin k is off by about 0.1 k times it; 4, 5 and 6 penetrate, 4 is ideal
      y(3) = 1.5e-3_wp
      call system%clearance_joints%sets(3)%set%begin_contact(1, 0.0_wp, 1.0_wp, 0.0_wp)
      call system%clearance_joints%sets(4)%set%begin_contact(1, 0.0_wp, 1.0_wp, 0.0_wp)
      energy = 0.0_wp
      do k = 5, 6
         delta = 0.2_wp*k*sin(0.5_wp*y(3)) - 0.5e-3_wp
         call check_close(error, channel_of(system, 0.0_wp, y, "loose_"//to_text(k), "penetration"), delta, 1.0e-16_wp, &
                          "penetration of "//to_text(k))
         call check_close(error, channel_of(system, 0.0_wp, y, "loose_"//to_text(k), "normal_force"), &
                          merge(steel_pin, 3.0e9_wp, k == 5)*delta**1.5_wp, 1.0e-7_wp, "force of "//to_text(k), relative=.true.)
         energy = energy + 0.4_wp*merge(steel_pin, 3.0e9_wp, k == 5)*delta**2.5_wp
      end do
      call check_close(error, channel_of(system, 0.0_wp, y, "energy", "elastic"), energy, 1.0e-7_wp, "elastic energy", &
                       relative=.true.)
      call check_close(error, channel_of(system, 0.0_wp, y, "loose_3", "normal_force"), 0.0_wp, 0.0_wp, "one that is free")
      call check_close(error, channel_of(system, 0.0_wp, y, "loose_3", "state"), 0.0_wp, 0.0_wp, "its state")
      call check_close(error, channel_of(system, 0.0_wp, y, "loose_6", "state"), 1.0_wp, 0.0_wp, "one that touches")
   end subroutine test_energy_of_several_contacts

end module test_build_system
