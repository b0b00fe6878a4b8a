!> A motion does not depend on where the mechanism stands: error scales, steps and the ledger's yardstick.
module test_places
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: keeper_t, load_text, loaded_t, run_to_end
   use errors, only: error_t
   use kinds, only: wp
   use recorder, only: summary_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: run_test_places

   character(*), parameter :: nl = new_line("a")
   real(wp), parameter :: joule_at_1000_m = 0.3_wp*9.81_wp*1000.0_wp  !! energy of the pin there, which must not count [J]

contains

   subroutine run_test_places(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("shifted_aside", test_shifted_aside)
      call suite%test("shifted_upwards", test_shifted_upwards)
   end subroutine run_test_places

   !> A pin thrown in a hole bounces to and fro; a pendulum swings beside it.
   function bouncing(x, y) result(deck)
      real(wp), intent(in) :: x                 !! where the hole is [m]
      real(wp), intent(in) :: y                 !! where the hole is [m]
      character(:), allocatable :: deck         !! the deck

      character(:), allocatable :: place, right

      place = real_text(x, 9)//" "//real_text(y, 9)
      right = real_text(x + 0.5_wp, 9)//" "//real_text(y, 9)
      deck = "deck = 1"//nl//"[scene]"//nl//"gravity = 0 -9.81 m/s^2"//nl// &
             "[bodies]"//nl//"name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] vy[m/s]"//nl// &
             "pin 0.3 1e-4 "//place//" 2 0.3"//nl//"bob 0.2 1e-3 "//right//" - -"//nl// &
             "[points]"//nl//"name body xi[m] eta[m]"//nl// &
             "hole ground "//place//nl//"centre pin 0 0"//nl//"eye bob -0.5 0"//nl// &
             "[joint.revolute]"//nl//"name i j"//nl//"hook hole eye"//nl// &
             "[material]"//nl//"name young[GPa] poisson"//nl//"steel 207 0.3"//nl// &
             "[clearance.revolute]"//nl//"name bearing journal bearing_radius[mm] clearance[mm] material law"//nl// &
             "ring hole centre 10 0.5 steel hertz"//nl//"[contact.hertz]"//nl//"name"//nl//"hertz"//nl// &
             "[analysis.dynamic]"//nl//"start = given"//nl//"tolerance = 1e-8"//nl//"end = 2 ms"//nl
   end function bouncing

   !> Run at the origin and elsewhere. Four contacts: after more of them the round-off at 1000 m can be seen.
   subroutine compare(error, x, y)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      real(wp), intent(in) :: x                           !! the other place [m]
      real(wp), intent(in) :: y                           !! the other place [m]

      type(keeper_t) :: keeper_here, keeper_there
      type(loaded_t) :: here, there
      type(summary_t) :: summary_here, summary_there

      call load_text(bouncing(0.0_wp, 0.0_wp), here, error)
      if (.not. allocated(error)) call load_text(bouncing(x, y), there, error)
      if (allocated(error)) return
      call check_close(error, there%system%linkage%scales%length, here%system%linkage%scales%length, 0.0_wp, "size of the bodies")
      if (.not. allocated(error)) call run_to_end(here, keeper_here, summary_here, error)
      if (.not. allocated(error)) call run_to_end(there, keeper_there, summary_there, error)
      if (allocated(error)) return
      call check_true(error, summary_here%count%contacts >= 4, "it bounces")
      call check_equal(error, int(summary_there%count%contacts), int(summary_here%count%contacts), "contacts")
      call check_close(error, real(summary_there%count%steps, wp), real(summary_here%count%steps, wp), 0.02_wp, "steps", &
                       relative=.true.)
      ! places at 1000 m have a round-off of 1e-13 m, against a penetration of 2e-5 m
      call check_close(error, summary_there%quality%energy_max, summary_here%quality%energy_max, 1.0e-7_wp, "greatest energy", &
                       relative=.true.)
      call check_true(error, summary_there%quality%energy_max < 1.0e-3_wp*joule_at_1000_m, "greatest energy is that of the motion")
      call check_close(error, keeper_there%events(1)%time, keeper_here%events(1)%time, 1.0e-12_wp, "first impact")
   end subroutine compare

   subroutine test_shifted_aside(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare(error, 10.0_wp, 0.0_wp)
   end subroutine test_shifted_aside

   !> The potential energy of the pin there is 5000 times the energy of the motion.
   subroutine test_shifted_upwards(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare(error, 0.0_wp, 1000.0_wp)
   end subroutine test_shifted_upwards

end module test_places
