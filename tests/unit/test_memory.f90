!> What a whole system remembers.
module test_memory
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: i8, wp
   use mechanism, only: mechanism_t
   use scene_fixture, only: slider_crank, start_text
   implicit none (type, external)
   private
   public :: run_test_memory

contains

   subroutine run_test_memory(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("system", test_system)
   end subroutine run_test_memory

   !> A system with a contact: a fresh one that loads the row gives the very same derivative.
   subroutine test_system(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(mechanism_t) :: fresh, system
      type(archive_t) :: archive
      real(wp), allocatable :: y(:), ydot(:), ydot_fresh(:)
      integer :: status

      call start_text(slider_crank("", "damped", "rubbing", "clearance"), system, y, error)
      if (allocated(error)) return
      call start_text(slider_crank("", "damped", "rubbing", "clearance"), fresh, y, error)
      if (allocated(error)) return
      call system%clearance_joints%sets(1)%set%begin_contact(1, 0.25_wp, 3.5_wp, 0.125_wp)
      y(7) = y(7) - 0.52e-3_wp
      ydot = y
      ydot_fresh = y
      call system%evaluate(0.0_wp, y, ydot, status)
      call system%save(archive)
      call fresh%load(archive)
      call check_true(error, archive%is_at_end(), "as many numbers loaded as saved")
      call check_true(error, fresh%n_evaluations == 1_i8, "evaluations")
      call check_equal(error, fresh%clearance_joints%sets(1)%set%n_touching, 1, "the contact touches")
      call fresh%evaluate(0.0_wp, y, ydot_fresh, status)
      call check_close(error, ydot_fresh, ydot, 0.0_wp, "derivative")
      call check_true(error, maxval(abs(ydot(16:17))) > 1000.0_wp, "there is a contact force")
   end subroutine test_system

end module test_memory
