!> The method that chooses: events while it is implicit, and what it remembers.
module test_auto_memory
   use archive, only: archive_t
   use auto, only: auto_t
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use integrator, only: advance_event
   use kinds, only: wp
   use stiff_examples, only: crossing_t, n_most, new_crossing
   implicit none (type, external)
   private
   public :: run_test_auto_memory

contains

   subroutine run_test_auto_memory(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("events_while_implicit", test_events)
      call suite%test("goes_on_to_the_bit_from_any_step", test_memory)
   end subroutine run_test_auto_memory

   !> A stiff follower of the sine passes a half at pi/6 and 5 pi/6 of every turn: the times of the events are those of the sine.
   subroutine test_events(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(crossing_t) :: system
      type(auto_t) :: method
      integer :: k, n, status

      call new_crossing(system)
      method%controls%tolerance = 1.0e-7_wp
      call method%start(system, 0.0_wp, [0.0_wp, 0.0_wp, 1.0_wp], 40.0_wp, status)
      n = 0
      do k = 1, n_most
         if (status < 0 .or. method%t >= 40.0_wp) exit
         if (status == advance_event) then
            call check_close(error, method%t, acos(-1.0_wp)*(n + system%side/6.0_wp), 1.0e-6_wp, "time of the event")
            n = n + 1
            system%side = -system%side
            call method%restart(system, 0.0_wp, status)
         end if
         call method%advance(system, 40.0_wp, status)
      end do
      call check_equal(error, n, 13, "events")
      call check_true(error, .not. method%is_explicit() .and. method%choice%n_change == 1, "implicit throughout")
   end subroutine test_events

   !> Taken back from any step, explicit or implicit, before and after a change, the motion is the same to the bit.
   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(crossing_t) :: other_system, system
      type(auto_t), allocatable :: method, other
      type(archive_t) :: again, archive
      real(wp), parameter :: t_end = 40.0_wp
      integer :: i, k, n, status

      n = 0
      do i = 0, 40
         if (allocated(other)) deallocate (other)
         allocate (other)
         call new_crossing(system)
         system%to = 5.0_wp
         call begin(other, system)
         if (i == 0) then
            ! the run that nobody disturbs
            allocate (method)
            call begin(method, system)
            do while (method%t < t_end)
               call one_more(method, system)
               n = n + 1
            end do
            cycle
         end if
         if (17*i > n) exit
         do k = 1, 17*i
            call one_more(other, system)
         end do
         archive = archive_t()
         call other%save(archive)
         deallocate (other)
         allocate (other)
         call new_crossing(other_system)
         other_system%to = 5.0_wp
         call begin(other, other_system)
         other_system%side = system%side
         call other%load(archive)
         call check_true(error, archive%is_at_end(), "as many numbers loaded as saved")
         again = archive_t()
         call other%save(again)
         call check_equal(error, again%n, archive%n, "size kept")
         call other%load(again)
         do while (other%t < t_end)
            call one_more(other, other_system)
         end do
         call check_true(error, abs(other%step%y1(1) - method%step%y1(1)) <= 0.0_wp, "state")
         call check_true(error, other%count%n_evaluations == method%count%n_evaluations, "evaluations")
         call check_true(error, other%choice%n_change == method%choice%n_change, "changes")
         if (allocated(error)) return
      end do
      call check_true(error, method%choice%n_change >= 2 .and. i > 10, "it goes over and back")

   contains

      !> A run starts.
      subroutine begin(one, of)
         type(auto_t), intent(inout) :: one       !! the integrator
         type(crossing_t), intent(inout) :: of    !! the system

         one%controls%tolerance = 1.0e-6_wp
         call one%start(of, 0.0_wp, [0.0_wp, 0.0_wp, 1.0_wp], t_end, status)
      end subroutine begin

      !> A step, and the event at its end.
      subroutine one_more(one, of)
         type(auto_t), intent(inout) :: one       !! the integrator
         type(crossing_t), intent(inout) :: of    !! the system

         call one%advance(of, t_end, status)
         if (status < 0) one%t = t_end
         if (status /= advance_event) return
         of%side = -of%side
         call one%restart(of, 0.0_wp, status)
      end subroutine one_more

   end subroutine test_memory

end module test_auto_memory
