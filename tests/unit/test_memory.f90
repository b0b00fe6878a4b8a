!> Checkpoint rows: what is put in comes out, in order and exactly; and those of a whole system.
module test_memory
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: i8, wp
   use memory, only: get, put
   use mechanism, only: mechanism_t
   use scene_fixture, only: slider_crank, start_text
   implicit none (type, external)
   private
   public :: run_test_memory

contains

   subroutine run_test_memory(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("round_trip", test_round_trip)
      call suite%test("places", test_places)
      call suite%test("system", test_system)
   end subroutine run_test_memory

   !> All types, with their extreme values.
   subroutine test_round_trip(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer(i8), parameter :: long = 9007199254740992_i8  ! 2^53: the maximum that is exact
      real(wp) :: row(100), x, list(3)
      integer :: i, place
      integer(i8) :: k
      logical :: flag

      row = -77.0_wp
      place = 0
      call put(row, place, 0.1_wp)
      call put(row, place, [tiny(1.0_wp), -huge(1.0_wp), 1.0_wp/3.0_wp])
      call put(row, place, -huge(1))
      call put(row, place, long)
      call put(row, place, .true.)
      call put(row, place, .false.)
      call put(row, place, -long)
      call check_equal(error, place, 9, "places used")
      place = 0
      call get(row, place, x)
      call check_close(error, x, 0.1_wp, 0.0_wp, "a real")
      call get(row, place, list)
      call check_close(error, list, [tiny(1.0_wp), -huge(1.0_wp), 1.0_wp/3.0_wp], 0.0_wp, "three reals")
      call get(row, place, i)
      call check_equal(error, i, -huge(1), "an integer")
      call get(row, place, k)
      call check_true(error, k == long, "a long integer")
      call get(row, place, flag)
      call check_true(error, flag, "true")
      call get(row, place, flag)
      call check_true(error, .not. flag, "false")
      call get(row, place, k)
      call check_true(error, k == -long, "a negative long integer")
      call check_equal(error, place, 9, "places read")
   end subroutine test_round_trip

   !> Writing starts after the last place used and touches nothing else.
   subroutine test_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: list(0), row(6)
      integer :: place

      row = -77.0_wp
      place = 2
      call put(row, place, 5.0_wp)
      call put(row, place, list)
      call put(row, place, [6.0_wp, 7.0_wp])
      call check_close(error, row, [-77.0_wp, -77.0_wp, 5.0_wp, 6.0_wp, 7.0_wp, -77.0_wp], 0.0_wp, "row")
      call check_equal(error, place, 5, "last place")
   end subroutine test_places

   !> A system with a contact: a fresh one that loads the row gives the very same derivative.
   subroutine test_system(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: fresh, system
      real(wp), allocatable :: row(:), y(:), ydot(:), ydot_fresh(:)
      integer :: place, status

      call start_text(slider_crank("", "damped", "rubbing", "clearance"), system, y, error)
      if (allocated(error)) return
      call start_text(slider_crank("", "damped", "rubbing", "clearance"), fresh, y, error)
      if (allocated(error)) return
      call system%clearance_joints%sets(1)%set%begin_contact(1, 0.25_wp, 3.5_wp, 0.125_wp)
      y(7) = y(7) - 0.52e-3_wp
      ydot = y
      ydot_fresh = y
      call system%evaluate(0.0_wp, y, ydot, status)
      allocate (row(system%memory_size()))
      place = 0
      call system%save(row, place)
      call check_equal(error, place, system%memory_size(), "numbers saved")
      place = 0
      call fresh%load(row, place)
      call check_equal(error, place, fresh%memory_size(), "numbers loaded")
      call check_true(error, fresh%n_evaluations == 1_i8, "evaluations")
      call check_equal(error, fresh%clearance_joints%sets(1)%set%n_touching, 1, "the contact touches")
      call fresh%evaluate(0.0_wp, y, ydot_fresh, status)
      call check_close(error, ydot_fresh, ydot, 0.0_wp, "derivative")
      call check_true(error, maxval(abs(ydot(16:17))) > 1000.0_wp, "there is a contact force")
   end subroutine test_system

end module test_memory
