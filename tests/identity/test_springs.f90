!> Springs and torsional springs of planar scenes: loads, stored energy and channels written out by hand.
module test_springs
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use expression, only: constant_expression
   use fixed_random, only: random_t
   use force_bench, only: bench_t, kind_number, make_bench, n_body
   use force_registry, only: new_force_set
   use force_set, only: force_set_t
   use generic_item, only: column_number, fill_item, make_expression
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, pi, wp
   use motion, only: new_loads
   use planar_coordinates, only: set_planar_motion
   use read_channel, only: channel_code
   implicit none (type, external)
   private
   public :: run_test_springs

contains

   subroutine run_test_springs(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("spring_by_hand", test_spring_by_hand)
      call suite%test("torsion_spring_by_hand", test_torsion_spring_by_hand)
      call suite%test("preload_alone", test_preload_alone)
   end subroutine run_test_springs

   !> A spring between the ground and a body by hand: stretched, pulled by its actuator, then with points that coincide.
   subroutine test_spring_by_hand(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(item_t) :: items(1)
      real(wp) :: values(1, 1), vector(2, 1)
      integer :: k

      call make_spring(bench, "force.spring", items)
      ! from (1, 2) of the ground to (0.3, 0) of body 1 at (4, 5.7) turned by 90 degrees: (3, 4), length 5
      call set_planar_motion(n_body, reshape([4.0_wp, 5.7_wp, 0.5_wp*pi, (0.0_wp, k=1, 6)], [3, 3]), &
                             reshape([0.6_wp, 0.8_wp, 0.0_wp, (0.0_wp, k=1, 6)], [3, 3]), bench%motion)
      call bench%set%evaluate(0.5_wp, bench%motion, bench%loads, bench%power)
      ! 10 (5 - 3) + 2*1 + 7 + 6*0.5 = 32
      call check_close(error, bench%loads%force(1:2, 1), -32.0_wp*[0.6_wp, 0.8_wp], 1.0e-14_wp, "pull on the body")
      call check_close(error, bench%loads%force(1:2, 0), 32.0_wp*[0.6_wp, 0.8_wp], 1.0e-14_wp, "pull on the ground")
      call check_close(error, bench%loads%moment(3, 1), 0.3_wp*32.0_wp*0.6_wp, 1.0e-14_wp, "moment on the body")
      call check_close(error, bench%power, -3.0_wp, 1.0e-14_wp, "power of the actuator")
      call check_close(error, bench%set%elastic_energy(bench%motion), 5.0_wp*2.7_wp**2, 1.0e-13_wp, "stored energy")
      call check_close(error, bench%set%lost_power(bench%motion), 2.0_wp, 1.0e-14_wp, "power lost")
      call bench%set%report(channel_code(bench%set%info(), "tension"), 0.5_wp, bench%motion, values)
      call check_close(error, values(1, 1), 32.0_wp, 1.0e-14_wp, "tension")
      call bench%set%report(channel_code(bench%set%info(), "length"), 0.5_wp, bench%motion, values)
      call check_close(error, values(1, 1), 5.0_wp, 1.0e-14_wp, "length")
      call bench%set%report(channel_code(bench%set%info(), "rate"), 0.5_wp, bench%motion, values)
      call check_close(error, values(1, 1), 1.0_wp, 1.0e-14_wp, "rate")
      call bench%set%report(channel_code(bench%set%info(), "force"), 0.5_wp, bench%motion, vector)
      call check_close(error, vector(:, 1), [19.2_wp, 25.6_wp], 1.0e-14_wp, "force on the body of i")
      ! points that coincide: no direction, no force, no power; the stored energy is that of the length zero
      call set_planar_motion(n_body, reshape([1.0_wp, 1.7_wp, 0.5_wp*pi, (0.0_wp, k=1, 6)], [3, 3]), &
                             reshape([0.6_wp, 0.8_wp, 0.0_wp, (0.0_wp, k=1, 6)], [3, 3]), bench%motion)
      call new_loads(n_body, bench%loads)
      bench%power = 0.0_wp
      call bench%set%evaluate(0.5_wp, bench%motion, bench%loads, bench%power)
      call check_close(error, sum(abs(bench%loads%force)) + sum(abs(bench%loads%moment)), 0.0_wp, 1.0e-12_wp, "no force")
      call check_true(error, ieee_is_finite(bench%power), "finite power")
   end subroutine test_spring_by_hand

   !> A torsional spring between the ground and a body by hand.
   subroutine test_torsion_spring_by_hand(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(item_t) :: items(1)
      real(wp) :: values(1, 1)
      integer :: k

      call make_spring(bench, "force.torsion_spring", items)
      call set_planar_motion(n_body, reshape([4.0_wp, 5.7_wp, 5.0_wp, (0.0_wp, k=1, 6)], [3, 3]), &
                             reshape([0.6_wp, 0.8_wp, 1.0_wp, (0.0_wp, k=1, 6)], [3, 3]), bench%motion)
      call bench%set%evaluate(0.5_wp, bench%motion, bench%loads, bench%power)
      call check_close(error, bench%loads%moment(3, 0:1), [32.0_wp, -32.0_wp], 1.0e-14_wp, "moments")
      call check_close(error, sum(abs(bench%loads%force)), 0.0_wp, 0.0_wp, "no forces")
      call check_close(error, bench%power, -3.0_wp, 1.0e-14_wp, "power of the actuator")
      call check_close(error, bench%set%elastic_energy(bench%motion), 5.0_wp*2.7_wp**2, 1.0e-13_wp, "stored energy")
      call check_close(error, bench%set%lost_power(bench%motion), 2.0_wp, 1.0e-14_wp, "power lost")
      call bench%set%report(channel_code(bench%set%info(), "moment"), 0.5_wp, bench%motion, values)
      call check_close(error, values(1, 1), 32.0_wp, 1.0e-14_wp, "moment")
      call bench%set%report(channel_code(bench%set%info(), "angle"), 0.5_wp, bench%motion, values)
      call check_close(error, values(1, 1), 5.0_wp, 1.0e-14_wp, "angle")
      call bench%set%report(channel_code(bench%set%info(), "angular_rate"), 0.5_wp, bench%motion, values)
      call check_close(error, values(1, 1), 1.0_wp, 1.0e-14_wp, "rate")
   end subroutine test_torsion_spring_by_hand

   !> A preload without stiffness is a constant actuator: it works, and stores nothing.
   subroutine test_preload_alone(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      character(*), parameter :: kinds(2) = [character(20) :: "force.spring", "force.torsion_spring"]
      class(force_set_t), allocatable :: set
      type(bench_t) :: bench
      type(item_t) :: items(1)
      integer :: k, n

      do n = 1, 2
         call make_spring(bench, trim(kinds(n)), items)
         items(1)%values(3)%number = 0.0_wp
         call new_force_set(kind_number(trim(kinds(n))), set)
         call set%prepare(items, bench%points)
         call set_planar_motion(n_body, reshape([4.0_wp, 5.7_wp, 0.5_wp*pi, (0.0_wp, k=1, 6)], [3, 3]), &
                                reshape([0.6_wp, 0.8_wp, 1.0_wp, (0.0_wp, k=1, 6)], [3, 3]), bench%motion)
         call set%evaluate(0.0_wp, bench%motion, bench%loads, bench%power)
         call check_close(error, set%elastic_energy(bench%motion), 0.0_wp, 0.0_wp, trim(kinds(n))//": nothing stored")
         call check_true(error, bench%power < -1.0_wp, trim(kinds(n))//": the preload works")
      end do
   end subroutine test_preload_alone

   !> One spring of stiffness 10, damping 2, free length 3, preload 7, actuator 6 t between ground and body 1, SI.
   subroutine make_spring(bench, name, items)
      type(bench_t), intent(out) :: bench     !! the spring
      character(*), intent(in) :: name        !! of the kind
      type(item_t), intent(out) :: items(1)   !! its row

      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: c

      call make_bench(kind_number(name), bench)
      info = bench%set%info()
      random%state = 5_i8
      call fill_item(info, 1, random, items(1))
      bench%points%body = [0, 1, 1]
      bench%points%s(1:2, 1) = [1.0_wp, 2.0_wp]
      bench%points%s(1:2, 2) = [0.3_wp, 0.0_wp]
      items(1)%values(1)%index = merge(1, 0, info%columns(1)%refers_to == "points")
      items(1)%values(2)%index = merge(2, 1, info%columns(1)%refers_to == "points")
      items(1)%values(3:8)%number = [10.0_wp, 2.0_wp, 3.0_wp, 7.0_wp, 0.0_wp, 0.0_wp]
      c = column_number(info, "actuator")
      items(1)%values(c)%expression = make_expression("6*t/(1 s)", info%columns(c))
      items(1)%values(column_number(info, "law"))%expression = constant_expression(0.0_wp, info%columns(c)%dimension)
      items(1)%values(column_number(info, "damper"))%expression = constant_expression(0.0_wp, info%columns(c)%dimension)
      call new_force_set(kind_number(name), bench%set)
      call bench%set%prepare(items, bench%points)
   end subroutine make_spring

end module test_springs
