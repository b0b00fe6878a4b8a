!> Point forces and torques of planar scenes: loads, channels and work written out by hand.
module test_point_loads
   use check, only: check_close, suite_t
   use errors, only: error_t
   use force_bench, only: bench_t, kind_number, make_bench, n_body, n_item, now
   use kinds, only: pi, wp
   use motion, only: point_position
   use planar_coordinates, only: set_planar_motion
   use read_channel, only: channel_code
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_point_loads

contains

   subroutine run_test_point_loads(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("point_force", test_point_force)
      call suite%test("torque", test_torque)
      call suite%test("work", test_work)
   end subroutine run_test_point_loads

   !> A point force: its components, its moment about the centre of mass, its channel.
   subroutine test_point_force(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: arm(3), f(2), force(2, n_item)
      integer :: k

      call make_bench(kind_number("force.point"), bench, "3*sin(2 rad/s*t)", "5 - 4*t/(1 s)")
      call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
      f = [3.0_wp*sin(2.0_wp*now), 5.0_wp - 4.0_wp*now]
      force = 0.0_wp
      call bench%set%report(channel_code(bench%set%info(), "force"), now, bench%motion, force)
      do k = 1, n_body
         arm = point_position(bench%motion, k, bench%points%s(:, k)) - bench%motion%r(:, k)
         call check_close(error, bench%loads%force(:, k), [f, 0.0_wp], 1.0e-14_wp, "force on body "//to_text(k))
         call check_close(error, bench%loads%moment(:, k), [0.0_wp, 0.0_wp, arm(1)*f(2) - arm(2)*f(1)], 1.0e-14_wp, &
                          "moment on body "//to_text(k))
         call check_close(error, force(:, k), f, 1.0e-14_wp, "channel of item "//to_text(k))
      end do
   end subroutine test_point_force

   !> A torque: its value on its body only, no force, its channel.
   subroutine test_torque(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: moment(1, n_item)
      integer :: k

      call make_bench(kind_number("force.torque"), bench, "7*cos(3 rad/s*t)")
      call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
      moment = 0.0_wp
      call bench%set%report(channel_code(bench%set%info(), "moment"), now, bench%motion, moment)
      call check_close(error, maxval(abs(bench%loads%force)), 0.0_wp, 0.0_wp, "no force")
      do k = 1, n_body
         call check_close(error, bench%loads%moment(:, k), [0.0_wp, 0.0_wp, 7.0_wp*cos(3.0_wp*now)], 1.0e-14_wp, &
                          "moment on body "//to_text(k))
         call check_close(error, moment(1, k), 7.0_wp*cos(3.0_wp*now), 1.0e-14_wp, "channel of item "//to_text(k))
      end do
   end subroutine test_torque

   !> Work along a motion against integrals by hand: A sin(w t) on a point that moves evenly, and a torque on
   !> a body that turns evenly. Simpson's rule.
   subroutine test_work(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      integer, parameter :: n = 2000
      real(wp), parameter :: end = 0.8_wp, w = 3.0_wp*pi
      real(wp) :: expected, weight, work(2)
      integer :: k, kind

      do kind = 1, 2
         if (kind == 1) call make_bench(kind_number("force.point"), bench, "6*sin(3*pi*t/(1 s))", "2")
         if (kind == 2) call make_bench(kind_number("force.torque"), bench, "6*sin(3*pi*t/(1 s))")
         work(kind) = 0.0_wp
         do k = 0, n
            weight = merge(1.0_wp, merge(4.0_wp, 2.0_wp, modulo(k, 2) == 1), k == 0 .or. k == n)
            bench%power = 0.0_wp
            call move(bench, end*k/n)
            call bench%set%evaluate(end*k/n, bench%motion, bench%loads, bench%power)
            work(kind) = work(kind) + weight*bench%power*end/(3.0_wp*n)
         end do
      end do
      expected = 6.0_wp*(1.0_wp - cos(w*end))/w
      call check_close(error, work(1), 0.7_wp*expected - 0.4_wp*2.0_wp*end, 1.0e-10_wp, "work of a point force")
      call check_close(error, work(2), -1.3_wp*expected, 1.0e-10_wp, "work of a torque")

   contains

      !> The point of body 1 moves at (0.7, -0.4) m/s, the body turns at -1.3 rad/s; bodies 2 and 3 are at rest.
      subroutine move(bench, t)
         type(bench_t), intent(inout) :: bench  !! the kind
         real(wp), intent(in) :: t              !! time [s]

         real(wp) :: q(3, n_body), v(3, n_body)

         q = 0.0_wp
         v = 0.0_wp
         v(:, 1) = [0.7_wp, -0.4_wp, -1.3_wp]
         associate (s => bench%points%s(1:2, 1), turn => v(3, 1)*t)
            q(:, 1) = [0.7_wp*t - cos(turn)*s(1) + sin(turn)*s(2), -0.4_wp*t - sin(turn)*s(1) - cos(turn)*s(2), turn]
            v(1:2, 1) = v(1:2, 1) + v(3, 1)*[sin(turn)*s(1) + cos(turn)*s(2), -cos(turn)*s(1) + sin(turn)*s(2)]
         end associate
         call set_planar_motion(n_body, q, v, bench%motion)
      end subroutine move

   end subroutine test_work

end module test_point_loads
