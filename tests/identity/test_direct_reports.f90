!> What a scene that is evaluated the direct way reports of one channel, asked alone, against what it reports when all are asked:
!> the quantities of joints from the balance of fewer bodies, those of contacts by another way.
module test_direct_reports
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use catalogue, only: catalogue_t
   use groups_of_catalogue, only: group_clearances, group_contacts, group_drivers
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use mechanism_catalogue, only: bind_channels, build_catalogue
   use mechanism_report, only: report_state
   use reduction_comparison, only: with_word
   use scene_fixture, only: slider_crank, start_text
   implicit none (type, external)
   private
   public :: run_test_direct_reports

contains

   subroutine run_test_direct_reports(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("free", test_free)
      call suite%test("touching", test_touching)
      call suite%test("only_what_is_needed", test_needed)
   end subroutine run_test_direct_reports

   !> The contact is free, once within its clearance and once beyond it, as just before it starts.
   subroutine test_free(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_alone("none", .false., 0.3e-3_wp, error)
      call compare_alone("none", .false., 0.51e-3_wp, error)
      call compare_alone("rubbing", .false., 0.51e-3_wp, error)
   end subroutine test_free

   !> It touches, with friction and without; once it is deeper than its impact speed could take it.
   subroutine test_touching(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call compare_alone("none", .true., 0.51e-3_wp, error)
      call compare_alone("rubbing", .true., 0.51e-3_wp, error)
      call compare_alone("none", .true., 0.51e-3_wp, error, speed=1.0e-3_wp)
   end subroutine test_touching

   !> Every channel of every item alone.
   subroutine compare_alone(friction, touches, aside, error, speed)
      character(*), intent(in) :: friction                 !! law of friction
      logical, intent(in) :: touches                       !! whether the contact has started
      real(wp), intent(in) :: aside                        !! displacement of the slider [m]
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      real(wp), intent(in), optional :: speed              !! impact speed of a contact that has started, instead of 2 m/s [m/s]

      type(catalogue_t) :: all_of, one_of
      type(mechanism_t) :: system
      real(wp), allocatable :: start(:), ydot(:)
      real(wp) :: allowed
      integer :: item, k, status

      if (allocated(error)) return
      call start_text(with_word(slider_crank("", "damped", friction, "clearance"), "fewest"), system, start, error)
      if (allocated(error)) return
      call check_true(error, system%is_direct, "nothing is solved")
      if (touches) call system%clearance_joints%sets(1)%set%begin_contact(1, 0.0_wp, 2.0_wp, 0.0_wp)
      if (present(speed)) system%clearance_joints%sets(1)%set%contact(1)%impact_speed = speed
      start(1:2) = start(1:2) + [0.0_wp, aside]
      start(3:4) = start(3:4) + [20.0_wp, 0.4_wp]
      ydot = start
      call build_catalogue(system, all_of)
      call report_state(system, 1.0e-3_wp, start, ydot, 0.0_wp, all_of, status)
      call check_equal(error, status, 0, "status")
      call build_catalogue(system, one_of)
      do k = 1, size(all_of%groups)
         associate (group => all_of%groups(k))
            allowed = 0.0_wp
            if (group%item_group == group_clearances .or. group%item_group == group_contacts) allowed = 4.0e-15_wp
            do item = 1, size(group%has)
               if (.not. group%has(item)) cycle
               call ask_alone(system, k, item, one_of)
               call report_state(system, 1.0e-3_wp, start, ydot, 0.0_wp, one_of, status)
               associate (alone => one_of%value(k, item), among_all => all_of%value(k, item))
                  call check_true(error, all(ieee_is_nan(alone) .eqv. ieee_is_nan(among_all)), "the same is a number")
                  if (any(ieee_is_nan(among_all))) cycle
                  call check_close(error, alone, among_all, allowed*max(1.0e-3_wp, maxval(abs(among_all))), &
                                   group%channel%name//" alone")
               end associate
            end do
         end associate
      end do
   end subroutine compare_alone

   !> One channel of one item is requested and no other; what was reported before is forgotten.
   subroutine ask_alone(system, group, item, catalogue)
      type(mechanism_t), intent(in) :: system           !! the system
      integer, intent(in) :: group                      !! the channel
      integer, intent(in) :: item                       !! the item
      type(catalogue_t), intent(inout) :: catalogue     !! what it can report

      integer :: k

      do k = 1, size(catalogue%groups)
         catalogue%groups(k)%is_wanted = .false.
      end do
      catalogue%groups(group)%is_wanted(item) = .true.
      catalogue%values = huge(1.0_wp)
      call bind_channels(system, catalogue)
   end subroutine ask_alone

   !> The balance is found of the bodies that are read, and of those that they hold, from the tips on; rows only where something of
   !> theirs is read.
   subroutine test_needed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(catalogue_t) :: catalogue
      type(mechanism_t) :: system
      real(wp), allocatable :: start(:)

      call start_text(with_word(slider_crank("", "damped", "none", "clearance"), "fewest"), system, start, error)
      if (allocated(error)) return
      call build_catalogue(system, catalogue)
      call check_true(error, size(catalogue%readings%rows%sets) > 0, "violations are read of rows")
      call ask_alone(system, catalogue%find_group(group_drivers, "moment"), 1, catalogue)
      associate (plan => catalogue%readings)
         call check_equal(error, size(plan%rows%sets), 0, "rows for a driving moment")
         call check_equal(error, plan%balance%n_reading, 1, "what follows from a balance")
         call check_equal(error, plan%balance%n, 2, "bodies: crank and rod")
         call check_true(error, plan%balance%base(1) == plan%balance%body(2) .and. plan%balance%base(2) == 0, "the rod first")
      end associate
      call ask_alone(system, catalogue%find_group(group_drivers, "coordinate"), 1, catalogue)
      call check_equal(error, catalogue%readings%balance%n, 0, "bodies for a coordinate")
   end subroutine test_needed

end module test_direct_reports
