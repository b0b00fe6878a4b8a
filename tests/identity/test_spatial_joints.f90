!> Identities that every joint and driver of space fulfils, by differences: a kind is tested by being registered.
!>
!> Rows are taken at positions that violate them, at any velocity, of bodies whose principal axes are not their own.
module test_spatial_joints
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_equal, check_true, suite_t
   use differences, only: five_point, places
   use errors, only: error_t
   use fixed_random, only: random_t, seed_of
   use kinds, only: not_a_number, wp
   use motion, only: cross
   use read_channel, only: read_joints
   use rotations, only: euler_parameters_of, product_of
   use spatial_bench, only: apply_rows, before, bench_t, evaluate_after, make_bench, n_body, n_item, now, random_frame, &
      spatial_kinds, times_jacobian
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_spatial_joints

   integer, parameter :: n_seed = 5         !! geometries for each kind
   real(wp), parameter :: step = 1.0e-3_wp  !! of differences [any]

contains

   subroutine run_test_spatial_joints(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("kinds", test_kinds)
      call suite%test("jacobian", test_jacobian)
      call suite%test("rate", test_rate)
      call suite%test("gamma", test_gamma)
      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("turned_scene", test_turned_scene)
      call suite%test("start_is_closed", test_start_is_closed)
      call suite%test("coordinate", test_coordinate)
      call suite%test("own_channels", test_own_channels)
   end subroutine run_test_spatial_joints

   !> There are kinds to be tested.
   subroutine test_kinds(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_true(error, size(spatial_kinds()) >= 15, "kinds of spatial scenes")
   end subroutine test_kinds

   !> Phi_q against differences of Phi, one rate after the other.
   subroutine test_jacobian(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: phi(:, :)
      real(wp) :: direction(6, n_body)
      integer, allocatable :: kinds(:)
      integer :: body, c, k, kind, row, seed

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         do seed = 1, n_seed
            call make_bench(kinds(kind), seed, bench)
            allocate (phi(4, bench%rows%n))
            do body = 1, n_body
               do c = 1, 6
                  direction = 0.0_wp
                  direction(c, body) = 1.0_wp
                  do k = 1, 4
                     call apply_rows(bench, places(k)*step*direction)
                     phi(k, :) = bench%rows%phi
                  end do
                  call apply_rows(bench, 0.0_wp*direction)
                  call check_close(error, times_jacobian(bench%rows, direction), &
                                   [(five_point(phi(:, row), step), row=1, bench%rows%n)], 1.0e-6_wp, &
                                   bench%name//": Jacobian, body "//to_text(body)//", rate "//to_text(c))
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
      integer, allocatable :: kinds(:)
      integer :: k, kind, row, seed

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         do seed = 1, n_seed
            call make_bench(kinds(kind), seed, bench)
            allocate (phi(4, bench%rows%n))
            do k = 1, 4
               call evaluate_after(bench, places(k)*step)
               phi(k, :) = bench%rows%phi
            end do
            call evaluate_after(bench, 0.0_wp)
            call check_close(error, times_jacobian(bench%rows, bench%v) + bench%rows%phi_t, &
                             [(five_point(phi(:, row), step), row=1, bench%rows%n)], 1.0e-6_wp, bench%name//": Phi'")
            deallocate (phi)
         end do
      end do
   end subroutine test_rate

   !> Phi'' = Phi_q a - gamma, for any accelerations, against second differences of Phi in time.
   subroutine test_gamma(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: phi(:, :)
      real(wp), parameter :: weights(5) = [-1.0_wp, 16.0_wp, -30.0_wp, 16.0_wp, -1.0_wp]/12.0_wp, wide = 4.0e-3_wp
      integer, allocatable :: kinds(:)
      integer :: k, kind, row, seed

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         do seed = 1, n_seed
            call make_bench(kinds(kind), seed, bench)
            allocate (phi(5, bench%rows%n))
            do k = 1, 5
               call evaluate_after(bench, (k - 3)*wide)
               phi(k, :) = bench%rows%phi
            end do
            call evaluate_after(bench, 0.0_wp)
            call check_close(error, times_jacobian(bench%rows, bench%a) - bench%rows%gam, &
                             [(dot_product(weights, phi(:, row))/wide**2, row=1, bench%rows%n)], 1.0e-4_wp, bench%name//": Phi''")
            deallocate (phi)
         end do
      end do
   end subroutine test_gamma

   !> Moving everything changes no row; turning everything about the origin changes none but that of points which are apart: forces
   !> and moments about one point add up to zero, but for the couple of a force at each of two points.
   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: couple(3), force(3, 2), gap(3), moment(3, 2)
      integer, allocatable :: kinds(:)
      integer :: body, item, kind, row, seed, side

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         do seed = 1, n_seed
            call make_bench(kinds(kind), seed, bench)
            call apply_rows(bench, spread(spread(0.0_wp, 1, 6), 2, n_body))
            do row = before + 1, bench%rows%n - 1
               item = (row - before - 1)/bench%info%n_row + 1
               do side = 1, 2
                  body = bench%rows%body(side, row)
                  force(:, side) = bench%rows%jac(6*side - 5:6*side - 3, row)
                  moment(:, side) = matmul(bench%motion%rot(:, :, body), bench%rows%jac(6*side - 2:6*side, row)) &
                                    + cross(bench%motion%r(:, body), force(:, side))
               end do
               call check_close(error, force(:, 1), -force(:, 2), 1.0e-14_wp, bench%name//": forces")
               couple = 0.0_wp
               if (is_point_row(bench, row, item)) then
                  gap = bench%rows%phi(before + (item - 1)*bench%info%n_row + 1:before + (item - 1)*bench%info%n_row + 3)
                  couple = cross(gap, force(:, 1))
               end if
               call check_close(error, sum(moment, 2), couple, 1.0e-13_wp, bench%name//": moments")
            end do
         end do
      end do
   end subroutine test_action_and_reaction

   !> Whether a row says that points coincide along an axis of the world.
   logical function is_point_row(bench, row, item)
      type(bench_t), intent(in) :: bench   !! the kind
      integer, intent(in) :: row           !! the row
      integer, intent(in) :: item          !! its item

      integer :: c

      c = row - before - (item - 1)*bench%info%n_row
      is_point_row = .false.
      if (c > 3 .or. bench%info%n_row < 3) return
      is_point_row = abs(bench%rows%jac(c, row) - 1.0_wp) <= 0.0_wp .and. sum(abs(bench%rows%jac(:3, row))) <= 1.0_wp
   end function is_point_row

   !> A scene that is turned as a whole, its ground too, has the same violations but for their directions.
   subroutine test_turned_scene(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(random_t) :: random
      real(wp), allocatable :: phi(:)
      real(wp) :: p(4), turn(3, 3)
      integer, allocatable :: kinds(:)
      integer :: item, k, kind, row

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         call make_bench(kinds(kind), 2, bench)
         random%state = seed_of(bench%name, 3)
         turn = random_frame(random)
         call apply_rows(bench, spread(spread(0.0_wp, 1, 6), 2, n_body))
         phi = bench%rows%phi
         p = euler_parameters_of(turn)
         do k = 1, n_body
            bench%q(:3, k) = matmul(turn, bench%q(:3, k))
            bench%q(4:, k) = product_of(p, bench%q(4:, k))
         end do
         bench%motion%rot(:, :, 0) = turn
         bench%motion%spatial%p(:, 0) = p
         call apply_rows(bench, spread(spread(0.0_wp, 1, 6), 2, n_body))
         do item = 1, n_item
            row = before + (item - 1)*bench%info%n_row
            associate (now_it_is => bench%rows%phi(row + 1:row + bench%info%n_row), was => phi(row + 1:row + bench%info%n_row))
               if (is_point_row(bench, row + 1, item)) was(:3) = matmul(turn, was(:3))
               call check_close(error, now_it_is, was, 1.0e-12_wp, bench%name//": turned")
            end associate
         end do
      end do
   end subroutine test_turned_scene

   !> Where axes are omitted, all rows of axes and angles are closed where the deck puts the bodies.
   subroutine test_start_is_closed(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      integer, allocatable :: kinds(:)
      integer :: kind, row

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         call make_bench(kinds(kind), 1, bench)
         if (bench%set%is_driver .or. bench%info%is_start_only) cycle
         if (bench%info%couples_joints) cycle  ! its start comes with its joints, `take_joint`
         if (bench%info%name == "joint.universal" .or. bench%info%name == "joint.perpendicular") cycle  ! both axes are given
         call bench%set%set_start(bench%motion)
         call bench%set%evaluate(now, bench%motion, bench%rows)
         do row = before + 1, bench%rows%n - 1
            if (bench%rows%is_angle(row)) then
               call check_close(error, bench%rows%phi(row), 0.0_wp, 1.0e-14_wp, bench%name//": closed at the start")
            end if
         end do
      end do
   end subroutine test_start_is_closed

   !> The coordinate of a driver is f(t) + Phi, its rate f' + Phi'.
   subroutine test_coordinate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: rate(:)
      real(wp) :: f(4), speed, value
      integer, allocatable :: kinds(:)
      integer :: i, k, kind, n_driver, seed

      kinds = spatial_kinds()
      n_driver = 0
      do kind = 1, size(kinds)
         do seed = 1, n_seed
            call make_bench(kinds(kind), seed, bench)
            if (.not. bench%set%is_driver) cycle
            n_driver = n_driver + 1
            do k = 1, n_item
               do i = 1, 4
                  call evaluate_after(bench, places(i)*step)
                  call bench%set%coordinate(k, bench%motion, f(i), speed)
               end do
               call evaluate_after(bench, 0.0_wp)
               call bench%set%coordinate(k, bench%motion, value, speed)
               rate = times_jacobian(bench%rows, bench%v)
               call check_close(error, speed, five_point(f, step), 1.0e-6_wp, bench%name//": rate of the coordinate")
               call check_close(error, speed, rate(before + k), 1.0e-12_wp, bench%name//": Phi_q v is that rate")
            end do
         end do
      end do
      call check_true(error, n_driver >= 4*n_seed, "there are drivers")
   end subroutine test_coordinate

   !> Every channel that a kind announces is filled, for all items.
   subroutine test_own_channels(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: lambda(:), values(:, :)
      integer, allocatable :: kinds(:)
      integer :: c, k, kind

      kinds = spatial_kinds()
      do kind = 1, size(kinds)
         call make_bench(kinds(kind), 2, bench)
         if (.not. allocated(bench%info%channels)) cycle
         bench%set%column = [(k, k=1, n_item)]
         call evaluate_after(bench, 0.0_wp)
         lambda = [(0.1_wp*k, k=1, bench%rows%n)]
         do c = 1, size(bench%info%channels)
            associate (channel => bench%info%channels(c))
               allocate (values(merge(3, 1, channel%components == 2), n_item), source=not_a_number())
               call read_joints(bench%set, channel%code, bench%motion, bench%coordinates, bench%rows, lambda, lambda, values)
               call check_true(error, all(ieee_is_finite(values)), bench%name//": channel "//channel%name)
               deallocate (values)
            end associate
         end do
      end do
   end subroutine test_own_channels

end module test_spatial_joints
