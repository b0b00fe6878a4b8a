!> Identities of every force element, by being registered; loads and work of the kinds written out by hand.
module test_forces
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: points_t
   use check, only: check_close, check_equal, check_true, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use expression, only: constant_expression
   use fixed_random, only: random_t, seed_of
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use generic_item, only: column_number, fill_item, make_expression
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: i8, pi, wp
   use motion, only: loads_t, motion_t, new_loads, new_motion, point_position
   use planar_kinds, only: is_planar_force
   use planar_coordinates, only: set_planar_motion
   use read_channel, only: channel_code
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_forces

   integer, parameter :: n_item = 3        !! items of each kind
   integer, parameter :: n_body = 3        !! moving bodies
   real(wp), parameter :: now = 0.37_wp    !! time [s]

   !> A kind with generic items and motion.
   type :: bench_t
      class(force_set_t), allocatable :: set     !! its items
      type(points_t) :: points                   !! points of the bodies, number k of body k
      type(motion_t) :: motion                   !! of the bodies
      type(loads_t) :: loads                     !! on the bodies
      real(wp) :: power = 0.0_wp                 !! power reported [W]
      character(:), allocatable :: name          !! for messages
   end type bench_t

contains

   subroutine run_test_forces(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("power", test_power)
      call suite%test("added_to_loads", test_added_to_loads)
      call suite%test("memory", test_memory)
      call suite%test("point_force", test_point_force)
      call suite%test("torque", test_torque)
      call suite%test("force_on_ground", test_force_on_ground)
      call suite%test("work", test_work)
      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("spring_by_hand", test_spring_by_hand)
      call suite%test("torsion_spring_by_hand", test_torsion_spring_by_hand)
      call suite%test("preload_alone", test_preload_alone)
   end subroutine run_test_forces

   !> Items of a kind on three bodies that move anyhow.
   subroutine make_bench(kind, bench, x, y)
      integer, intent(in) :: kind                  !! number of the kind
      type(bench_t), intent(out) :: bench          !! the kind, not evaluated
      character(*), intent(in), optional :: x      !! expression of the first expression column of all items
      character(*), intent(in), optional :: y      !! of the second

      type(item_t) :: items(n_item)
      type(kind_info_t) :: info
      type(random_t) :: random
      real(wp) :: q(3, n_body), v(3, n_body)
      integer :: c, k

      call new_force_set(kind, bench%set)
      info = bench%set%info()
      random%state = seed_of(info%name, 0)
      bench%name = info%name
      bench%points%n = n_body
      allocate (bench%points%body(n_body), bench%points%s(3, n_body))
      bench%points%s = 0.0_wp
      do k = 1, n_body
         bench%points%body(k) = k
         bench%points%s(1:2, k) = random%vector(2, -1.0_wp, 1.0_wp)
         q(:, k) = random%vector(3, -2.0_wp, 2.0_wp)
         v(:, k) = random%vector(3, -2.0_wp, 2.0_wp)
      end do
      do k = 1, n_item
         call fill_item(info, k, random, items(k))
         c = column_number(info, "j")
         if (c > 0) items(k)%values(c)%index = modulo(k, n_item) + 1
         if (present(x)) items(k)%values(2)%expression = make_expression(x, info%columns(2))
         if (present(y)) items(k)%values(3)%expression = make_expression(y, info%columns(3))
      end do
      call bench%set%prepare(items, bench%points)
      call new_motion(n_body, bench%motion)
      call set_planar_motion(n_body, q, v, bench%motion)
      call new_loads(n_body, bench%loads)
   end subroutine make_bench

   !> Number of a kind by its name.
   integer function kind_number(name) result(kind)
      character(*), intent(in) :: name  !! as in a deck

      class(force_set_t), allocatable :: set
      type(kind_info_t) :: info

      do kind = 1, n_force_kinds
         call new_force_set(kind, set)
         info = set%info()
         if (info%name == name .and. is_planar_force(kind)) return
      end do
      error stop "test_forces: no such kind"
   end function kind_number

   !> What a kind tells the ledger, and the power of its channel, are the power of its loads: power of the loads
   !> is that told, less that lost, less the rate of the stored energy, by differences along the velocities.
   subroutine test_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), parameter :: step = 3.0e-4_wp  ! of the differences [s]
      real(wp) :: given, lost, power(1, n_item), stored(4)
      type(motion_t) :: present_motion
      integer :: body, k, kind

      do kind = 1, n_force_kinds
         if (.not. is_planar_force(kind)) cycle
         call make_bench(kind, bench)
         call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
         given = 0.0_wp
         do body = 1, n_body
            given = given + dot_product(bench%loads%force(:, body), bench%motion%v(:, body)) &
                    + dot_product(bench%loads%moment(:, body), bench%motion%omega(:, body))
         end do
         call check_true(error, abs(given) > 0.01_wp, bench%name//": there is a power")
         lost = bench%set%lost_power(bench%motion)
         call check_true(error, lost >= 0.0_wp, bench%name//": nothing is won in dampers")
         present_motion = bench%motion
         do k = 1, 4
            call move_on(present_motion, places(k)*step, bench%motion)
            stored(k) = bench%set%elastic_energy(bench%motion)
         end do
         bench%motion = present_motion
         call check_close(error, bench%power - lost - five_point(stored, step), given, &
                          merge(1.0e-10_wp, 1.0e-13_wp, any(abs(stored) > 0.0_wp)), bench%name//": power of the loads")
         power = 0.0_wp
         call bench%set%report(channel_code(bench%set%info(), "power"), now, bench%motion, power)
         call check_close(error, sum(power), given, 1.0e-13_wp, bench%name//": power reported")
      end do
   end subroutine test_power

   !> Bodies after a time at their present velocities.
   subroutine move_on(motion, dt, moved)
      type(motion_t), intent(in) :: motion     !! positions and velocities
      real(wp), intent(in) :: dt               !! the time [s]
      type(motion_t), intent(inout) :: moved   !! positions after it

      real(wp) :: q(3, n_body), v(3, n_body)

      v(1:2, :) = motion%v(1:2, 1:)
      v(3, :) = motion%omega(3, 1:)
      q(1:2, :) = motion%r(1:2, 1:)
      q(3, :) = motion%angle(1:)
      call set_planar_motion(n_body, q + dt*v, v, moved)
   end subroutine move_on

   !> What acts between bodies adds up to nothing: forces, and moments about one point. It does not see where
   !> the whole scene is and how it is turned.
   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(kind_info_t) :: info
      type(loads_t) :: before
      real(wp), parameter :: turn = 0.7_wp, shift(2) = [3.0_wp, -5.0_wp]
      real(wp) :: f(3), m, q(3, n_body), rot(2, 2), v(3, n_body)
      integer :: body, kind, n_kind

      rot = reshape([cos(turn), sin(turn), -sin(turn), cos(turn)], [2, 2])
      n_kind = 0
      do kind = 1, n_force_kinds
         if (.not. is_planar_force(kind)) cycle
         call make_bench(kind, bench)
         info = bench%set%info()
         if (column_number(info, "j") == 0) cycle
         n_kind = n_kind + 1
         call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
         f = 0.0_wp
         m = 0.0_wp
         do body = 1, n_body
            f = f + bench%loads%force(:, body)
            m = m + bench%loads%moment(3, body) + bench%motion%r(1, body)*bench%loads%force(2, body) &
                - bench%motion%r(2, body)*bench%loads%force(1, body)
            v(1:2, body) = matmul(rot, bench%motion%v(1:2, body))
            v(3, body) = bench%motion%omega(3, body)
            q(1:2, body) = matmul(rot, bench%motion%r(1:2, body)) + shift
            q(3, body) = bench%motion%angle(body) + turn
         end do
         call check_close(error, f, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-13_wp, bench%name//": forces add up to nothing")
         call check_close(error, m, 0.0_wp, 1.0e-13_wp, bench%name//": moments add up to nothing")
         call check_true(error, sum(abs(bench%loads%moment)) > 0.1_wp, bench%name//": there are loads")
         before = bench%loads
         call new_loads(n_body, bench%loads)
         call set_planar_motion(n_body, q, v, bench%motion)
         call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
         do body = 1, n_body
            call check_close(error, bench%loads%force(1:2, body), matmul(rot, before%force(1:2, body)), 1.0e-13_wp, &
                             bench%name//": forces turn with the scene")
            call check_close(error, bench%loads%moment(3, body), before%moment(3, body), 1.0e-13_wp, &
                             bench%name//": moments stay")
         end do
      end do
      call check_true(error, n_kind >= 2, "springs were tried")
   end subroutine test_action_and_reaction

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

   !> Loads and power are added to what is there; a second evaluation adds the same again.
   subroutine test_added_to_loads(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(loads_t) :: once
      real(wp) :: power
      integer :: body, kind

      do kind = 1, n_force_kinds
         if (.not. is_planar_force(kind)) cycle
         call make_bench(kind, bench)
         call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
         once = bench%loads
         power = bench%power
         call bench%set%evaluate(now, bench%motion, bench%loads, bench%power)
         do body = 1, n_body
            call check_close(error, bench%loads%force(:, body), 2.0_wp*once%force(:, body), 1.0e-14_wp, &
                             bench%name//": forces")
            call check_close(error, bench%loads%moment(:, body), 2.0_wp*once%moment(:, body), 1.0e-14_wp, &
                             bench%name//": moments")
         end do
         call check_close(error, bench%power, 2.0_wp*power, 1.0e-14_wp, bench%name//": power")
      end do
   end subroutine test_added_to_loads

   !> A set puts as many numbers into a checkpoint as it says, and takes as many out.
   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: row(100)
      integer :: kind, place

      do kind = 1, n_force_kinds
         if (.not. is_planar_force(kind)) cycle
         call make_bench(kind, bench)
         place = 0
         row = 0.0_wp
         call bench%set%save(row, place)
         call check_equal(error, place, bench%set%memory_size(), bench%name//": numbers saved")
         place = 0
         call bench%set%load(row, place)
         call check_equal(error, place, bench%set%memory_size(), bench%name//": numbers loaded")
      end do
   end subroutine test_memory

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

   !> A force on the ground does no work.
   subroutine test_force_on_ground(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(force_set_t), allocatable :: set
      type(bench_t) :: bench
      type(item_t) :: items(1)
      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: c, kind

      do kind = 1, n_force_kinds
         if (.not. is_planar_force(kind)) cycle
         call make_bench(kind, bench)
         info = bench%set%info()
         call fill_item(info, 1, random, items(1))
         bench%points%body(1) = 0
         c = column_number(info, "body")
         if (c > 0) items(1)%values(c)%index = 0
         c = column_number(info, "j")
         if (c > 0) then
            ! both ends on the ground
            bench%points%body = 0
            items(1)%values(1)%index = merge(1, 0, info%columns(1)%refers_to == "points")
            items(1)%values(c)%index = merge(2, 0, info%columns(c)%refers_to == "points")
         end if
         call new_force_set(kind, set)
         call set%prepare(items, bench%points)
         call set%evaluate(now, bench%motion, bench%loads, bench%power)
         call check_close(error, bench%power, 0.0_wp, 0.0_wp, bench%name//": power on the ground")
         call check_close(error, sum(abs(bench%loads%force(:, 1:))) + sum(abs(bench%loads%moment(:, 1:))), 0.0_wp, 0.0_wp, &
                          bench%name//": loads on bodies")
      end do
   end subroutine test_force_on_ground

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

end module test_forces
