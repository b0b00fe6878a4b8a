!> Identities that every ideal joint and driver fulfils, by differences: a kind is tested by being registered.
!>
!> Rows are taken at positions that violate them, at any velocity: nothing here needs a solution.
module test_joint_kinds
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use bodies, only: points_t
   use check, only: check_close, check_equal, check_true, suite_t
   use differences, only: five_point, places, six_places, six_point
   use driver_position, only: driver_position_t
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use generic_item, only: fill_item
   use item, only: item_t
   use joint_bench, only: before, bench_t, evaluate_after, far, make_bench, n_body, n_item, now, span_between, &
      times_jacobian
   use joint_distance, only: joint_distance_t
   use joint_registry, only: n_joint_kinds, new_joint_set
   use joint_set, only: joint_set_t
   use rows, only: new_rows, rows_t
   use kind_info, only: kind_info_t
   use kinds, only: not_a_number, wp
   use lapack, only: dgelsd
   use motion, only: motion_t, new_motion
   use planar_kinds, only: is_planar_joint
   use planar_coordinates, only: new_planar_coordinates, planar_coordinates_t, set_planar_motion
   use read_channel, only: read_joints
   use span, only: span_of
   use text, only: text_t, to_text
   implicit none (type, external)
   private
   public :: run_test_joint_kinds

   integer, parameter :: n_seed = 4       !! geometries for each kind
   real(wp), parameter :: step = 1.0e-3_wp  !! of differences [any]

contains

   subroutine run_test_joint_kinds(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("jacobian", test_jacobian)
      call suite%test("rate", test_rate)
      call suite%test("gamma", test_gamma)
      call suite%test("rows_of_others", test_rows_of_others)
      call suite%test("translation_of_everything", test_translation_of_everything)
      call suite%test("rotation_of_everything", test_rotation_of_everything)
      call suite%test("lengths_and_angles", test_lengths_and_angles)
      call suite%test("coordinate", test_coordinate)
      call suite%test("left_out_at_start", test_left_out_at_start)
      call suite%test("coinciding_points", test_coinciding_points)
      call suite%test("position_along_axis", test_position_along_axis)
      call suite%test("memory", test_memory)
      call suite%test("own_channels", test_own_channels)
   end subroutine run_test_joint_kinds

   !> Phi_q against differences of Phi, one coordinate after the other.
   subroutine test_jacobian(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: phi(:, :)
      real(wp) :: direction(3, n_body), q(3, n_body)
      integer :: body, c, k, kind, row, seed

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            allocate (phi(4, bench%rows%n))
            q = bench%q
            do body = 1, n_body
               do c = 1, 3
                  direction = 0.0_wp
                  direction(c, body) = 1.0_wp
                  do k = 1, 4
                     bench%q = q + places(k)*step*direction
                     call evaluate_after(bench, 0.0_wp)
                     phi(k, :) = bench%rows%phi
                  end do
                  bench%q = q
                  call evaluate_after(bench, 0.0_wp)
                  call check_close(error, times_jacobian(bench%rows, direction), &
                                   [(five_point(phi(:, row), step), row=1, bench%rows%n)], 1.0e-11_wp, &
                                   bench%name//": Jacobian, body "//to_text(body)//", coordinate "//to_text(c))
               end do
            end do
            deallocate (phi)
         end do
      end do
   end subroutine test_jacobian

   !> Phi' = Phi_q v + Phi_t against differences of Phi in time.
   subroutine test_rate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: phi(:, :)
      integer :: k, kind, row, seed

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            allocate (phi(4, bench%rows%n))
            do k = 1, 4
               call evaluate_after(bench, places(k)*step)
               phi(k, :) = bench%rows%phi
            end do
            call evaluate_after(bench, 0.0_wp)
            call check_close(error, times_jacobian(bench%rows, bench%v) + bench%rows%phi_t, &
                             [(five_point(phi(:, row), step), row=1, bench%rows%n)], 1.0e-10_wp, bench%name//": Phi'")
            deallocate (phi)
         end do
      end do
   end subroutine test_rate

   !> Phi'' = Phi_q a - gamma, for any accelerations, against differences of Phi' in time.
   subroutine test_gamma(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: rate(:, :)
      integer :: k, kind, row, seed

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            allocate (rate(4, bench%rows%n))
            do k = 1, 4
               call evaluate_after(bench, places(k)*step)
               rate(k, :) = times_jacobian(bench%rows, bench%v + places(k)*step*bench%a) + bench%rows%phi_t
            end do
            call evaluate_after(bench, 0.0_wp)
            call check_close(error, times_jacobian(bench%rows, bench%a) - bench%rows%gam, &
                             [(five_point(rate(:, row), step), row=1, bench%rows%n)], 1.0e-9_wp, bench%name//": Phi''")
            deallocate (rate)
         end do
      end do
   end subroutine test_gamma

   !> A kind writes its own rows only, all of them, and says whose they are.
   subroutine test_rows_of_others(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), parameter :: mark = 12345.0_wp
      integer :: item, kind, row

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         associate (rows => bench%rows)
            rows%phi = mark
            rows%phi_t = mark
            rows%gam = mark
            rows%jac = mark
            call evaluate_after(bench, 0.0_wp)
            do row = 1, rows%n
               item = 0
               if (row > before .and. row < rows%n) item = (row - before - 1)/bench%set%n_row_item + 1
               if (item == 0) then
                  call check_true(error, all(abs([rows%phi(row), rows%phi_t(row), rows%gam(row), rows%jac(:, row)] &
                                                 - mark) <= 0.0_wp), bench%name//": row of others is left alone")
                  call check_true(error, all(rows%body(:, row) == 0), bench%name//": bodies of others are left alone")
               else
                  call check_true(error, all(abs([rows%phi(row), rows%phi_t(row), rows%gam(row), rows%jac(:, row)] &
                                                 - mark) > 0.0_wp), bench%name//": row is filled")
                  call check_true(error, all(rows%body(:, row) == bench%set%body(:, item)), bench%name//": bodies of the row")
               end if
            end do
         end associate
      end do
   end subroutine test_rows_of_others

   !> Moving everything changes no row: the forces on i and j are opposite, the ground's too.
   subroutine test_translation_of_everything(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      integer :: kind, seed

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            call evaluate_after(bench, 0.0_wp)
            call check_close(error, bench%rows%jac(4, :), -bench%rows%jac(1, :), 1.0e-14_wp, bench%name//": along x")
            call check_close(error, bench%rows%jac(5, :), -bench%rows%jac(2, :), 1.0e-14_wp, bench%name//": along y")
         end do
      end do
   end subroutine test_translation_of_everything

   !> Turning everything about the origin changes no row of a closed joint: the moments add up to zero.
   subroutine test_rotation_of_everything(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: turned
      integer :: first, k, kind, last, row, seed

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            first = before + 1
            last = before + bench%set%n_row_item
            do k = 1, 30
               call evaluate_after(bench, 0.0_wp)
               call close_joint(bench%rows%jac(:, first:last), bench%rows%phi(first:last), bench%q)
            end do
            call evaluate_after(bench, 0.0_wp)
            call check_true(error, maxval(abs(bench%rows%phi(first:last))) < 1.0e-13_wp, bench%name//": the joint is closed")
            do row = first, last
               associate (jac => bench%rows%jac(:, row), q => bench%q)
                  turned = jac(2)*q(1, 1) - jac(1)*q(2, 1) + jac(3) + jac(5)*q(1, 2) - jac(4)*q(2, 2) + jac(6)
               end associate
               call check_close(error, turned, 0.0_wp, 1.0e-12_wp, bench%name//": turned about the origin")
            end do
         end do
      end do
   end subroutine test_rotation_of_everything

   !> One correction of Newton's, of least norm.
   subroutine close_joint(jac, phi, q)
      real(wp), intent(in) :: jac(:, :)           !! (6, rows) Phi_q [1 or m]
      real(wp), intent(in) :: phi(:)              !! (rows) violation [m or rad]
      real(wp), intent(inout) :: q(3, n_body)     !! (3, bodies) coordinates [m, m, rad]

      real(wp) :: b(6, 1), matrix(size(phi), 6), s(6), work(1000)
      integer :: info, iwork(200), rank

      matrix = transpose(jac)
      b = 0.0_wp
      b(1:size(phi), 1) = -phi
      call dgelsd(size(phi), 6, 1, matrix, size(phi), b, 6, s, 1.0e-12_wp, rank, work, size(work), iwork, info)
      q = q + reshape(b(:, 1), [3, n_body])
   end subroutine close_joint

   !> A mechanism twice as large has violations twice as large where they are lengths, the same where they are angles.
   subroutine test_lengths_and_angles(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: large, small
      integer :: kind, seed

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, small)
            call make_bench(kind, seed, large, 2.0_wp)
            call evaluate_after(small, 0.0_wp)
            call evaluate_after(large, 0.0_wp)
            call check_close(error, large%rows%phi, small%rows%phi*merge(1.0_wp, 2.0_wp, small%rows%is_angle), &
                             1.0e-14_wp, small%name//": violation")
            call check_close(error, large%rows%gam, small%rows%gam*merge(1.0_wp, 2.0_wp, small%rows%is_angle), &
                             1.0e-12_wp, small%name//": gamma")
         end do
      end do
   end subroutine test_lengths_and_angles

   !> The rate of a set's coordinate is the rate of its value; a driver's is what it drives, Phi = value - f(t).
   subroutine test_coordinate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: rates(:)
      real(wp) :: rate, unused, value(6)
      integer :: item, k, kind

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         do item = 1, n_item
            do k = 1, size(six_places)
               call evaluate_after(bench, six_places(k)*step)
               call bench%set%coordinate(item, bench%motion, value(k), unused)
            end do
            call evaluate_after(bench, 0.0_wp)
            call bench%set%coordinate(item, bench%motion, unused, rate)
            call check_close(error, rate, six_point(value, step), 1.0e-11_wp, bench%name//": rate of the coordinate")
            if (.not. bench%set%is_driver) cycle
            rates = times_jacobian(bench%rows, bench%v)
            call check_close(error, rates(before + (item - 1)*bench%set%n_row_item + 1), rate, 1.0e-14_wp, &
                             bench%name//": the coordinate is what the driver drives")
         end do
      end do
   end subroutine test_coordinate

   !> A length that a row leaves out is that of the start, whatever stands elsewhere in the row.
   subroutine test_left_out_at_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      integer :: item, kind, n_kind

      n_kind = 0
      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         call evaluate_after(bench, 0.0_wp)
         call bench%set%set_start(bench%motion)
         select type (set => bench%set)
         type is (joint_distance_t)
            n_kind = n_kind + 1
            call check_true(error, all(abs(bench%rows%phi(before + 1:before + n_item)) > 1.0e-3_wp), "given lengths differ")
            set%is_open = [.true., .false., .true.]
            call set%set_start(bench%motion)
            call evaluate_after(bench, 0.0_wp)
            do item = 1, n_item, 2
               call check_close(error, bench%rows%phi(before + item), 0.0_wp, 1.0e-15_wp, "closed at the start")
               call check_close(error, set%length(item), span_between(bench, item), 1.0e-15_wp, "distance at the start")
            end do
            call check_true(error, abs(bench%rows%phi(before + 2)) > 1.0e-3_wp, "a given length stands")
         end select
      end do
      call check_equal(error, n_kind, 1, "kinds with a length that may be left out")
   end subroutine test_left_out_at_start

   !> A length between points that coincide: the row is finite, and its violation is the length itself.
   subroutine test_coinciding_points(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      integer :: kind, row

      row = before + 2
      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         ! item 2: ground and body 1
         bench%q(1:2, 1) = 0.0_wp
         call evaluate_after(bench, 0.0_wp)
         bench%q(1:2, 1) = bench%set%s_i(1:2, 2) - matmul(bench%motion%rot(1:2, 1:2, 1), bench%set%s_j(1:2, 2))
         call evaluate_after(bench, 0.0_wp)
         call check_true(error, all(ieee_is_finite([bench%rows%phi, bench%rows%gam, bench%rows%jac])), bench%name//": finite")
         select type (set => bench%set)
         type is (joint_distance_t)
            call check_close(error, bench%rows%phi(row), -set%length(2), 1.0e-14_wp, "violation is the length")
            call check_close(error, norm2(bench%rows%jac(4:5, row)), 1.0_wp, 1.0e-15_wp, "a direction of its own")
         end select
      end do
   end subroutine test_coinciding_points

   !> A driven position and the line of a slot with the same axis: two orthogonal components of one vector.
   subroutine test_position_along_axis(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: axis(2), d(2), rate, value
      integer :: k, kind

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 2, bench)
         call evaluate_after(bench, 0.0_wp)
         select type (set => bench%set)
         type is (driver_position_t)
            do k = 1, n_item
               associate (i => set%body(1, k), j => set%body(2, k))
                  d = matmul(bench%motion%rot(1:2, 1:2, j), set%s_j(1:2, k)) + bench%motion%r(1:2, j) &
                      - matmul(bench%motion%rot(1:2, 1:2, i), set%s_i(1:2, k)) - bench%motion%r(1:2, i)
                  axis = matmul(bench%motion%rot(1:2, 1:2, i), [-set%guide%axis(2, k), set%guide%axis(1, k)])
               end associate
               call set%coordinate(k, bench%motion, value, rate)
               call check_close(error, value, dot_product(axis, d), 1.0e-14_wp, "position along the axis")
               call check_close(error, norm2(axis), 1.0_wp, 1.0e-15_wp, "unit axis")
            end do
         end select
      end do
   end subroutine test_position_along_axis

   !> A set puts as many numbers into a checkpoint as it says, and takes as many out.
   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: row(100)
      integer :: kind, place

      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         place = 0
         row = 0.0_wp
         call bench%set%save(row, place)
         call check_equal(error, place, bench%set%memory_size(), bench%name//": numbers saved")
         place = 0
         call bench%set%load(row, place)
         call check_equal(error, place, bench%set%memory_size(), bench%name//": numbers loaded")
      end do
   end subroutine test_memory

   !> Every channel that a kind announces is filled for each of its items, and for no item of another kind; the force of
   !> a joint is the load -Phi_q^T lambda on body i.
   subroutine test_own_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(kind_info_t) :: info
      type(planar_coordinates_t) :: coordinates
      real(wp), allocatable :: lambda(:), phi_dot(:), values(:, :)
      integer :: c, k, kind

      coordinates = new_planar_coordinates()
      do kind = 1, n_joint_kinds
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         call evaluate_after(bench, 0.0_wp)
         info = bench%set%info()
         bench%set%column = [(2*k, k=1, n_item)]
         lambda = [(1.5_wp + 0.25_wp*k, k=1, bench%rows%n)]
         phi_dot = times_jacobian(bench%rows, bench%v) + bench%rows%phi_t
         if (.not. allocated(info%channels)) cycle
         do c = 1, size(info%channels)
            values = reshape([(not_a_number(), k=1, info%channels(c)%components*(2*n_item + 1))], &
                             [info%channels(c)%components, 2*n_item + 1])
            if (bench%set%friction%n > 0) bench%set%friction%force = [(0.5_wp*k, k=1, n_item)]
            call read_joints(bench%set, info%channels(c)%code, bench%motion, coordinates, bench%rows, lambda, phi_dot, values)
            call check_true(error, all(ieee_is_finite(values(:, 2::2))), bench%name//": fills "//info%channels(c)%name)
            call check_true(error, .not. any(ieee_is_finite(values(:, 1::2))), bench%name//": leaves others alone")
            if (info%channels(c)%name == "force" .and. .not. bench%set%is_driver) then
               call check_close(error, reshape(values(:, 2::2), [2*n_item]), reshape(load_on_i(bench, lambda), [2*n_item]), &
                                1.0e-14_wp, bench%name//": reaction")
            end if
         end do
      end do
   end subroutine test_own_channels

   !> Force on body i of each item: minus the sum of its rows times their multipliers.
   function load_on_i(bench, lambda) result(force)
      type(bench_t), intent(in) :: bench     !! the kind, evaluated
      real(wp), intent(in) :: lambda(:)      !! (rows) multipliers [N or N.m]
      real(wp) :: force(2, n_item)           !! (2, items) force [N]

      integer :: first, k

      do k = 1, n_item
         first = before + (k - 1)*bench%set%n_row_item
         force(:, k) = -matmul(bench%rows%jac(1:2, first + 1:first + bench%set%n_row_item), &
                               lambda(first + 1:first + bench%set%n_row_item))
      end do
   end function load_on_i

end module test_joint_kinds
