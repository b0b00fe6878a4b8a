!> A radius that changes during a run: once laws and films are fitted again, forces and gaps are those of a joint built with it.
module test_changed_surfaces
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use deck_scene, only: load_file, loaded_t
   use errors, only: error_t
   use kinds, only: wp
   use surfaces, only: put_inside
   implicit none (type, external)
   private
   public :: run_test_changed_surfaces

contains

   subroutine run_test_changed_surfaces(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("pin", test_pin)
      call suite%test("socket", test_socket)
      call suite%test("bushing", test_bushing)
      call suite%test("film", test_film)
      call suite%test("film_of_a_bushing", test_film_of_bushing)
   end subroutine run_test_changed_surfaces

   subroutine test_pin(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call change("inputs/slider_crank_dry.deck", .true., error)
   end subroutine test_pin

   subroutine test_socket(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call change("inputs/slider_crank_6_6_ball.deck", .true., error)
   end subroutine test_socket

   subroutine test_bushing(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call change("inputs/slider_crank_6_6_bushing.deck", .true., error)
   end subroutine test_bushing

   subroutine test_film(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call change("inputs/slider_crank_lubricated.deck", .false., error)
   end subroutine test_film

   subroutine test_film_of_bushing(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call change("inputs/slider_crank_6_6_lubricated.deck", .false., error)
   end subroutine test_film_of_bushing

   !> Step until the contact touches, make the pin thinner, and compare with a joint of that clearance at the same state.
   subroutine change(deck, is_dry, error)
      character(*), intent(in) :: deck                      !! its path; parameter c: the clearance
      logical, intent(in) :: is_dry                         !! a contact touches; otherwise a film acts
      type(error_t), allocatable, intent(inout) :: error    !! what failed

      type(archive_t) :: archive
      type(loaded_t), target :: built, run
      real(wp) :: part
      real(wp), allocatable :: gap(:, :), rate(:), y(:), ydot(:, :)
      integer :: k, status

      call load_file(deck, run, error)
      if (.not. allocated(error)) call load_file(deck, built, error, "c=0.52mm")
      if (allocated(error)) return
      call run%method%start(run%system, 0.0_wp, run%y, run%plan%end, status)
      call built%method%start(built%system, 0.0_wp, built%y, run%plan%end, status)
      associate (set => run%system%clearance_joints%sets(1)%set, other => built%system%clearance_joints%sets(1)%set)
         do k = 1, 2000
            if (status < 0 .or. set%n_touching > 0 .or. (k > 5 .and. .not. is_dry)) exit
            call run%method%advance(run%system, run%plan%end, status)
            if (is_dry .and. status > 0) call set%begin_contact(1, run%method%t, 0.1_wp, 0.0_wp)
         end do
         call check_true(error, (set%n_touching > 0 .eqv. is_dry) .and. status >= 0, "it touches, or the film acts")
         if (allocated(error)) return
         call run%system%save(archive)
         call built%system%load(archive)
         y = run%method%step%y1
         allocate (ydot(size(y), 3), gap(set%n_contact, 3), rate(set%n_contact), source=0.0_wp)
         call run%system%evaluate(run%method%t, y, ydot(:, 1), status)
         call set%gaps(run%system%linkage%motion, gap(:, 1), rate)
         part = 1.0_wp
         if (allocated(set%laws%films)) then
            if (set%laws%films%is_alone) part = set%laws%films%eps_max(1)
         end if
         call put_inside(set%items%pairs(1), other%items%pairs(1)%radius_i, other%items%pairs(1)%clearance, part)
         call set%fit(1)
         call run%system%evaluate(run%method%t, y, ydot(:, 2), status)
         call set%gaps(run%system%linkage%motion, gap(:, 2), rate)
         call check_equal(error, status, 0, "evaluated")
         call built%system%evaluate(run%method%t, y, ydot(:, 3), status)
         call other%gaps(built%system%linkage%motion, gap(:, 3), rate)
         call check_true(error, all(abs(gap(:, 2) - gap(:, 1)) > 0.0_wp), "another gap")
         call check_true(error, any(abs(ydot(:, 2) - ydot(:, 1)) > 0.0_wp), "another force")
         call check_close(error, gap(:, 2), gap(:, 3), 0.0_wp, "gap of a joint built so")
         call check_close(error, ydot(:, 2), ydot(:, 3), 0.0_wp, "force of a joint built so")
      end associate
   end subroutine change

end module test_changed_surfaces
