!> What ideal joints and drivers report of themselves, and what they put into checkpoints: a kind is tested by being registered.
module test_joint_channels
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use archive, only: archive_t
   use check, only: check_close, check_equal, check_true, suite_t
   use driver_position, only: driver_position_t
   use errors, only: error_t
   use joint_bench, only: before, bench_t, evaluate_after, make_bench, n_item, times_jacobian
   use joint_registry, only: n_joint_kinds
   use kind_info, only: kind_info_t
   use kinds, only: not_a_number, wp
   use planar_coordinates, only: new_planar_coordinates, planar_coordinates_t
   use planar_kinds, only: is_planar_joint
   use read_channel, only: read_joints
   implicit none (type, external)
   private
   public :: run_test_joint_channels

contains

   subroutine run_test_joint_channels(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("position_along_axis", test_position_along_axis)
      call suite%test("memory", test_memory)
      call suite%test("own_channels", test_own_channels)
   end subroutine run_test_joint_channels

   !> A driven position and the line of a slot with the same axis: two orthogonal components of one vector.
   subroutine test_position_along_axis(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: axis(2), d(2), rate, value
      integer :: k, kind

      do kind = 1, n_joint_kinds()
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

   !> A set takes as many numbers out of a checkpoint as it puts into it.
   subroutine test_memory(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      type(archive_t) :: archive
      integer :: kind

      do kind = 1, n_joint_kinds()
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         archive = archive_t()
         call bench%set%save(archive)
         call bench%set%load(archive)
         call check_true(error, archive%is_at_end(), bench%name//": as many numbers loaded as saved")
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
      do kind = 1, n_joint_kinds()
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

end module test_joint_channels
