!> Identities of every force element of planar scenes, by being registered.
module test_forces
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t
   use force_bench, only: bench_t, make_bench, n_body, n_item, now
   use force_registry, only: n_force_kinds, new_force_set
   use force_set, only: force_set_t
   use generic_item, only: column_number, fill_item
   use item, only: item_t
   use kind_info, only: kind_info_t
   use kinds, only: wp
   use motion, only: loads_t, motion_t, new_loads
   use planar_kinds, only: is_planar_force
   use planar_coordinates, only: set_planar_motion
   use read_channel, only: channel_code
   implicit none (type, external)
   private
   public :: run_test_forces

contains

   subroutine run_test_forces(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("power", test_power)
      call suite%test("added_to_loads", test_added_to_loads)
      call suite%test("memory", test_memory)
      call suite%test("force_on_ground", test_force_on_ground)
      call suite%test("action_and_reaction", test_action_and_reaction)
   end subroutine run_test_forces

   !> What a kind reports the ledger, and the power of its channel, are the power of its loads: power of the loads
   !> is that reported, less that lost, less the rate of the stored energy, by differences along the velocities.
   subroutine test_power(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), parameter :: step = 3.0e-4_wp  ! of the differences [s]
      real(wp) :: given, lost, power(1, n_item), stored(4)
      type(motion_t) :: present_motion
      integer :: body, k, kind

      do kind = 1, n_force_kinds()
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
      do kind = 1, n_force_kinds()
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

   !> Loads and power are added to what is there; a second evaluation adds the same again.
   subroutine test_added_to_loads(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(loads_t) :: once
      real(wp) :: power
      integer :: body, kind

      do kind = 1, n_force_kinds()
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

   !> A set takes as many numbers out of a checkpoint as it puts into it.
   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(archive_t) :: archive
      integer :: kind

      do kind = 1, n_force_kinds()
         if (.not. is_planar_force(kind)) cycle
         call make_bench(kind, bench)
         archive = archive_t()
         call bench%set%save(archive)
         call bench%set%load(archive)
         call check_true(error, archive%is_at_end(), bench%name//": as many numbers loaded as saved")
      end do
   end subroutine test_memory

   !> A force on the ground does no work.
   subroutine test_force_on_ground(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      class(force_set_t), allocatable :: set
      type(bench_t) :: bench
      type(item_t) :: items(1)
      type(kind_info_t) :: info
      type(random_t) :: random
      integer :: c, kind

      do kind = 1, n_force_kinds()
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

end module test_forces
