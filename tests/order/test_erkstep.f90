!> Verner's method against ERKStep of SUNDIALS, on a pendulum and on the slider-crank with a loose pin.
module test_erkstep
   use check, only: check_close, check_equal, check_true, suite_t
   use contact_monitor, only: contact_monitor_t, new_contact_monitor
   use deck_scene, only: dry_deck, load_file, loaded_t
   use erkstep_solver, only: solve_by_erkstep
   use errors, only: error_t
   use integrator, only: advance_event
   use kinds, only: wp
   use ode_examples, only: new_pendulum, pendulum_t, run_to, slope
   use mechanism, only: mechanism_t
   use recorder, only: event_t
   use verner, only: verner_t
   implicit none (type, external)
   private
   public :: run_test_erkstep

   real(wp), parameter :: t_end = 5.0_wp  !! of the pendulum [s]

contains

   subroutine run_test_erkstep(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_of_erkstep", test_order_of_erkstep)
      call suite%test("same_steps_same_pendulum", test_same_steps)
      call suite%test("same_tolerance_same_pendulum", test_same_tolerance)
      call suite%test("slider_crank", test_slider_crank)
   end subroutine run_test_erkstep

   !> Verner's pendulum with a number of steps of one length, or by a tolerance.
   subroutine solve_by_verner(y, n_step, tolerance)
      real(wp), intent(out) :: y(4)                      !! (4) state at t_end [any]
      integer, intent(in), optional :: n_step            !! number of steps of one length
      real(wp), intent(in), optional :: tolerance        !! local error allowed [1]

      type(pendulum_t) :: system
      type(verner_t) :: method
      real(wp), allocatable :: start(:)
      integer :: status

      call new_pendulum(0.9_wp, .true., system, start)
      if (present(n_step)) method%controls%fixed_step = t_end/real(n_step, wp)
      if (present(tolerance)) method%controls%tolerance = tolerance
      call method%start(system, 0.0_wp, start, t_end, status)
      call run_to(method, system, t_end, status)
      y = method%step%y1
   end subroutine solve_by_verner

   !> The judge is what it should be: with the corrected table ERKStep has order 6.
   subroutine test_order_of_erkstep(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(3)
      integer :: k, status

      do k = 1, 3
         call new_pendulum(0.9_wp, .true., system, y)
         call solve_by_erkstep(system, 0.0_wp, t_end, y, status, n_step=20*2**k)
         call check_equal(error, status, 0, "status")
         errors(k) = norm2(y - system%exact(t_end))
      end do
      call check_close(error, slope(errors(1:2), errors(2:3)), [6.15_wp, 6.15_wp], 0.35_wp, "order")
   end subroutine test_order_of_erkstep

   !> Steps of one length: equal to round-off, position, velocity and both quadratures.
   subroutine test_same_steps(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: ours(4)
      integer :: k, status

      do k = 1, 4
         call new_pendulum(0.9_wp, .true., system, y)
         call solve_by_erkstep(system, 0.0_wp, t_end, y, status, n_step=5*2**k)
         call solve_by_verner(ours, n_step=5*2**k)
         call check_equal(error, status, 0, "status")
         call check_close(error, ours, y, 1.0e-14_wp, "state with steps of one length")
      end do
      call check_true(error, norm2(ours - system%exact(t_end)) > 1.0e-11_wp, "the method's error is well above round-off")
   end subroutine test_same_steps

   !> Steps of their own choice: both converge to the exact solution as the tolerance falls.
   subroutine test_same_tolerance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: exact(:), y(:)
      real(wp) :: ours(4), tolerance
      integer :: k, status

      do k = 4, 12, 2
         tolerance = 0.1_wp**k
         call new_pendulum(0.9_wp, .true., system, y)
         exact = system%exact(t_end)
         call solve_by_erkstep(system, 0.0_wp, t_end, y, status, tolerance=tolerance)
         call solve_by_verner(ours, tolerance=tolerance)
         call check_equal(error, status, 0, "status")
         call check_close(error, y, exact, 50.0_wp*tolerance, "ERKStep")
         call check_close(error, ours, exact, 50.0_wp*tolerance, "verner")
      end do
   end subroutine test_same_tolerance

   !> Verner with events at tolerance 1e-12; ERKStep with short steps to the instants that verner finds.
   subroutine test_slider_crank(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: onset = 0.00022728603203978336_wp    ! independent minimal-coordinate solution [s]
      real(wp), parameter :: speed = 4.385783145280216_wp         ! its impact speed [m/s]
      real(wp), parameter :: half = 2.5e-5_wp                     ! about half of the contact [s]
      type(loaded_t), target :: judge, ours
      real(wp) :: delta(1), rate(1)
      integer :: status

      call load_file(dry_deck, judge, error)
      if (.not. allocated(error)) call load_file(dry_deck, ours, error)
      if (allocated(error)) return
      ours%method%controls%tolerance = 1.0e-12_wp
      call ours%method%start(ours%system, 0.0_wp, ours%y, 1.0e-3_wp, status)
      call run_to(ours%method, ours%system, 1.0e-3_wp, status)
      call check_equal(error, status, advance_event, "verner ends at an event")
      call check_close(error, ours%method%t, onset, 1.0e-14_wp, "onset")

      call solve_by_erkstep(judge%system, 0.0_wp, ours%method%t, judge%y, status, n_step=300)
      call check_equal(error, status, 0, "status of ERKStep up to the onset")
      call compare(error, judge%system, ours%method%step%y1, judge%y, 3.0e-13_wp, "at the onset")
      call judge%system%events(ours%method%t, judge%y, delta, rate)
      call check_close(error, delta(1)/rate(1), 0.0_wp, 1.0e-15_wp, "ERKStep's onset")
      call check_close(error, rate(1), speed, 1.0e-10_wp, "impact speed")
      if (allocated(error)) return

      call judge%system%clearance_joints%sets(1)%set%begin_contact(1, ours%method%t, rate(1), 0.0_wp)
      call begin(ours)
      call solve_by_erkstep(judge%system, ours%method%t, ours%method%t + half, judge%y, status, n_step=300)
      call check_equal(error, status, 0, "status of ERKStep within the contact")
      call run_to(ours%method, ours%system, ours%method%t + half, status)
      call check_equal(error, status, 0, "status of verner within the contact")
      call compare(error, judge%system, ours%method%step%y1, judge%y, 1.0e-11_wp, "within the contact")

   contains

      !> Verner's side of the onset, as an analysis does it.
      subroutine begin(loaded)
         type(loaded_t), intent(inout) :: loaded  !! the deck, at the event

         type(contact_monitor_t) :: monitor
         type(event_t) :: row
         real(wp) :: step_hint
         integer :: outcome
         logical :: is_over

         call new_contact_monitor(loaded%system, monitor)
         call monitor%handle_event(loaded%system, loaded%method, loaded%method%events%happened(1), is_over, row, step_hint)
         call check_true(error, .not. is_over, "a contact begins")
         call loaded%method%restart(loaded%system, step_hint, outcome)
      end subroutine begin

   end subroutine test_slider_crank

   !> Two states agree, each kind of quantity to a part of its maximum.
   subroutine compare(error, system, actual, expected, part, what)
      type(error_t), allocatable, intent(inout) :: error   !! first failure
      type(mechanism_t), intent(in) :: system          !! the system
      real(wp), intent(in) :: actual(:)                    !! (n) state [any]
      real(wp), intent(in) :: expected(:)                  !! (n) the judge's [any]
      real(wp), intent(in) :: part                         !! difference allowed, of the maximum of its kind [1]
      character(*), intent(in) :: what                     !! when

      integer :: nq

      nq = system%n_position
      call check_close(error, actual(1:nq), expected(1:nq), part, "coordinates "//what)
      call check_close(error, actual(nq + 1:2*nq), expected(nq + 1:2*nq), part, "rates "//what, relative=.true.)
      ! quadratures stay out of the error norm
      call check_close(error, actual(2*nq + 1:), expected(2*nq + 1:), 100.0_wp*part, "quadratures "//what, relative=.true.)
   end subroutine compare

end module test_erkstep
