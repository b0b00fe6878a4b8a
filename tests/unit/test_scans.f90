!> Bounds of expressions, the places where they are not smooth, and the characteristic rate of steps over them.
module test_scans
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use expression, only: expression_t
   use expression_bounds, only: bound_expression
   use expression_compile, only: compile_expression, evaluate_safely, fault_t, symbols_t
   use expression_switches, only: find_switches, switch_t
   use, intrinsic :: ieee_exceptions, only: ieee_get_status, ieee_set_halting_mode, ieee_set_status, ieee_status_type, ieee_usual
   use kinds, only: eps, pi, wp
   use rate_scan, only: new_rate_scan, rate_scan_t
   use root_scan, only: new_root_scan, place_t, root_scan_t
   implicit none (type, external)
   private
   public :: run_test_scans

contains

   subroutine run_test_scans(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("bounds_hold_all_values", test_bounds)
      call suite%test("places", test_places)
      call suite%test("no_places", test_no_places)
      call suite%test("many_places", test_many_places)
      call suite%test("pace", test_pace)
   end subroutine run_test_scans

   !> An expression in the time.
   function compiled(source) result(expression)
      character(*), intent(in) :: source   !! its text
      type(expression_t) :: expression     !! the program

      type(fault_t), allocatable :: fault
      type(symbols_t) :: none

      call compile_expression(source, none, .true., expression, fault)
      if (allocated(fault)) error stop "a test has a wrong expression"
   end function compiled

   !> Values and derivatives at places of an interval lie within the bounds, of every function there is.
   subroutine test_bounds(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: sources(22) = [character(40) :: "t/1s", "sin(7*t/1s)", "cos(3*t/1s)", "tan(t/1s/2)", &
         "asin(t/1s/4)", "acos(t/1s/4)", "atan(5*t/1s-3)", "sinh(t/1s)", "cosh(t/1s-1)", "tanh(4*t/1s-2)", "exp(-(t/1s-1)^2)", &
         "log(1+t/1s)", "log10(0.1+t/1s)", "sqrt(t/1s+0.01)", "abs(t/1s-0.7)", "min(t/1s,1-t/1s)", "max(sin(t/1s),0.5)", &
         "atan2(t/1s-1,1+t/1s)", "1/(1+t/1s)^3", "(t/1s-1)^3", "(t/1s+0.1)^1.7", "(1+t/1s)^(t/1s)"]
      type(expression_t) :: f
      real(wp), allocatable :: bend(:), range(:, :)
      real(wp) :: a, b, d(3), jet(2, 3), slack, t
      integer :: i, j, k, s
      type(ieee_status_type) :: status

      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      do s = 1, size(sources)
         f = compiled(trim(sources(s)))
         allocate (bend(size(f%code)), range(2, size(f%code)))
         do i = 0, 19
            a = 0.1_wp*i
            b = a + 2.0_wp**(-mod(i, 7))
            call bound_expression(f, [a, b], jet, range, bend)
            do j = 0, 16
               t = a + (b - a)*j/16.0_wp
               call evaluate_safely(f, t, d(1), d(2), d(3))
               do k = 1, 3
                  slack = 1.0e-12_wp*(1.0_wp + abs(d(k)))
                  call check_true(error, jet(1, k) <= d(k) + slack .and. jet(2, k) >= d(k) - slack, &
                                  trim(sources(s))//" is within its bounds")
               end do
            end do
         end do
         deallocate (bend, range)
      end do
      call ieee_set_status(status)
   end subroutine test_bounds

   !> All places of an expression from 0 to an end, one switch after the other.
   subroutine find_places(source, end, places)
      character(*), intent(in) :: source                       !! the expression
      real(wp), intent(in) :: end                              !! end of the range [s]
      type(place_t), allocatable, intent(out) :: places(:)     !! (n) what was found

      type(root_scan_t) :: scan
      type(switch_t), allocatable :: switches(:)
      type(place_t) :: place
      integer :: k
      type(ieee_status_type) :: status

      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      allocate (places(0))
      call find_switches(compiled(source), switches)
      do k = 1, size(switches)
         call new_root_scan(switches(k), 0.0_wp, end, scan)
         do
            call scan%next(place)
            if (place%at >= huge(end)) exit
            places = [places, place]
         end do
      end do
      call ieee_set_status(status)
   end subroutine find_places

   !> Places are those of closed forms, between neighbouring numbers.
   subroutine check_places(error, source, end, expected)
      type(error_t), allocatable, intent(inout) :: error  !! first failure
      character(*), intent(in) :: source                  !! the expression
      real(wp), intent(in) :: end                         !! end of the range [s]
      real(wp), intent(in) :: expected(:)                 !! (n) the places [s]

      type(place_t), allocatable :: places(:)
      integer :: k

      call find_places(source, end, places)
      call check_true(error, size(places) == size(expected), source//": as many places as there are")
      if (allocated(error)) return
      do k = 1, size(expected)
         call check_close(error, places(k)%at, expected(k), 8.0_wp*eps*max(1.0_wp, expected(k)), source)
         associate (low => places(k)%low, high => places(k)%high)
            call check_true(error, high > low .and. high - low <= 2.0_wp*spacing(high) + tiny(1.0_wp), source//": neighbours")
         end associate
      end do
   end subroutine check_places

   !> Jumps and kinks of every kind.
   subroutine test_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_places(error, "step(t-1s)-step(t-1.1s)", 3.0_wp, [1.0_wp, 1.1_wp])
      call check_places(error, "step(1s-t)", 3.0_wp, [1.0_wp])
      call check_places(error, "abs(t^3/1s^3-2)", 3.0_wp, [2.0_wp**(1.0_wp/3.0_wp)])
      call check_places(error, "max(0,sin(2*pi*1Hz*t)-0.5)", 1.0_wp, [1.0_wp/12.0_wp, 5.0_wp/12.0_wp])
      call check_places(error, "min(t,1s-t)", 3.0_wp, [0.5_wp])
      call check_places(error, "step(exp(-((t-1s)/1e-6s)^2)-0.5)", 3.0_wp, 1.0_wp + 1.0e-6_wp*sqrt(log(2.0_wp))*[-1.0_wp, 1.0_wp])
      call check_places(error, "atan2(sin(2*pi*1Hz*t),cos(2*pi*1Hz*t))", 3.2_wp, [0.5_wp, 1.5_wp, 2.5_wp])
      call check_places(error, "max(0s,t)", 3.0_wp, [0.0_wp])
      call check_places(error, "step(t-3s)", 3.0_wp, [3.0_wp])
   end subroutine test_places

   !> What touches, is constant, or lies outside has no place; what is not smooth by its touching has one.
   subroutine test_no_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(place_t), allocatable :: places(:)

      call check_places(error, "abs((t-1s)^2)", 3.0_wp, [real(wp) ::])
      call check_places(error, "step(2+sin(7*t/1s))", 100.0_wp, [real(wp) ::])
      call check_places(error, "step(t-4s)", 3.0_wp, [real(wp) ::])
      call check_places(error, "abs(max(0s,t-1s))", 3.0_wp, [1.0_wp])
      call find_places("sqrt((t-1.3s)^2)", 3.0_wp, places)
      call check_true(error, size(places) == 1, "sqrt of a square has one")
      if (.not. allocated(error)) call check_close(error, places(1)%at, 1.3_wp, 1.0e-12_wp, "where it touches zero")
      call find_places("abs(t^3/1s^3-3*t^2/1s^2+3*t/1s-1)", 3.0_wp, places)
      call check_true(error, size(places) >= 1 .and. size(places) < 100, "round-off around a triple zero is left in the end")
   end subroutine test_no_places

   !> Hundred thousand places, one after the other.
   subroutine test_many_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(place_t), allocatable :: places(:)

      call find_places("abs(sin(2*pi*5kHz*t))", 1.00005_wp, places)
      call check_true(error, size(places) == 10000, "ten thousand half waves")
      if (allocated(error)) return
      call check_close(error, places(7777)%at, 0.7777_wp, 1.0e-14_wp, "one of them")
   end subroutine test_many_places

   !> Steps over a sine have 4 rad; those to a bell end before it and are short on it.
   subroutine test_pace(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(rate_scan_t) :: scan
      real(wp) :: stop, t
      integer :: n
      logical :: was_seen
      type(ieee_status_type) :: status

      call ieee_get_status(status)
      call ieee_set_halting_mode(ieee_usual, .false.)
      call new_rate_scan(compiled("sin(2*pi*100Hz*t)"), 0.0_wp, 10.0_wp, 0.0_wp, scan)
      call scan%stop_after(1.0_wp, stop)
      call check_close(error, stop - 1.0_wp, 4.0_wp/(200.0_wp*pi), 1.0e-6_wp, "4 rad")
      call new_rate_scan(compiled("exp(-((t-1.2345s)/1e-5s)^2)"), 0.0_wp, 10.0_wp, 0.0_wp, scan)
      t = 0.0_wp
      n = 0
      was_seen = .false.
      do while (t < 10.0_wp .and. n < 1000)
         call scan%stop_after(t, stop)
         call check_true(error, stop > t, "steps go on")
         if (t < 1.2345_wp .and. stop > 1.2345_wp) was_seen = stop - t < 2.0e-5_wp
         if (abs(t - 1.2345_wp) < 1.0e-12_wp) was_seen = .true.
         t = min(stop, 10.0_wp)
         n = n + 1
      end do
      call check_true(error, was_seen, "no step is longer than the bell where it stands")
      call check_true(error, n < 100, "and there are few of them")
      call new_rate_scan(compiled("3*t/1s+step(t-1s)"), 0.0_wp, 10.0_wp, 0.0_wp, scan)
      call check_true(error, scan%is_calm, "a straight line asks for nothing")
      call ieee_set_status(status)
   end subroutine test_pace

end module test_scans
