!> Identities of friction in ideal joints, for every kind that has it.
module test_joint_friction
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use joint_bench, only: bench_t, evaluate_after, make_bench, n_item, n_seed
   use joint_friction, only: most_rows
   use joint_registry, only: n_joint_kinds
   use planar_kinds, only: is_planar_joint
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: run_test_joint_friction

   integer, parameter :: n_rubbing = 2    !! kinds with friction
   real(wp), parameter :: step = 1.0e-6_wp  !! of differences [N or N.m]

contains

   subroutine run_test_joint_friction(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("sliding_velocity", test_sliding_velocity)
      call suite%test("normal_force", test_normal_force)
   end subroutine run_test_joint_friction

   !> The two friction forces of a joint add up to no force and no moment.
   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: turned
      integer :: i, j, k, kind, n_kind, seed

      n_kind = 0
      do kind = 1, n_joint_kinds()
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            if (bench%set%friction%n == 0) cycle
            if (seed == 1) n_kind = n_kind + 1
            call evaluate_after(bench, 0.0_wp)
            call bench%set%slide(bench%motion)
            do k = 1, n_item
               i = bench%set%body(1, k)
               j = bench%set%body(2, k)
               associate (row => bench%set%friction%row(:, k), r => bench%motion%r)
                  call check_close(error, row(1:2) + row(4:5), [0.0_wp, 0.0_wp], 1.0e-15_wp, bench%name//": forces")
                  turned = r(1, i)*row(2) - r(2, i)*row(1) + row(3) + r(1, j)*row(5) - r(2, j)*row(4) + row(6)
                  call check_close(error, turned, 0.0_wp, 1.0e-14_wp, bench%name//": moments")
               end associate
            end do
         end do
      end do
      call check_equal(error, n_kind, n_rubbing, "kinds that rub")
   end subroutine test_action_and_reaction

   !> What the rates of the bodies add to the sliding velocity is the row that the force acts along: power in and out agree.
   subroutine test_sliding_velocity(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp) :: v
      integer :: k, kind, seed, side

      do kind = 1, n_joint_kinds()
         if (.not. is_planar_joint(kind)) cycle
         do seed = 1, n_seed
            call make_bench(kind, seed, bench)
            if (bench%set%friction%n == 0) cycle
            call evaluate_after(bench, 0.0_wp)
            call bench%set%slide(bench%motion)
            do k = 1, n_item
               v = 0.0_wp
               do side = 1, 2
                  if (bench%set%body(side, k) == 0) cycle
                  v = v + dot_product(bench%set%friction%row(3*side - 2:3*side, k), bench%v(:, bench%set%body(side, k)))
               end do
               call check_true(error, abs(v) > 1.0e-3_wp, bench%name//": slides")
               call check_close(error, bench%set%friction%v(k), v, 1.0e-14_wp, bench%name//": sliding velocity")
            end do
         end do
      end do
   end subroutine test_sliding_velocity

   !> The normal force is its preload without a reaction, the same for opposite ones, and its slope is that of differences.
   subroutine test_normal_force(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: reactions(most_rows, 3) = reshape([3.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -0.7_wp, 2.0_wp, 0.0_wp, &
                                                                0.0_wp, 0.0_wp, 5.0_wp, -0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
                                                               [most_rows, 3])
      type(bench_t) :: bench
      real(wp) :: above, below, lambda(most_rows), normal, slope(most_rows), unused(most_rows)
      integer :: c, k, kind, row

      do kind = 1, n_joint_kinds()
         if (.not. is_planar_joint(kind)) cycle
         call make_bench(kind, 1, bench)
         if (bench%set%friction%n == 0) cycle
         do k = 1, n_item
            call bench%set%press(k, 0.0_wp*reactions(:, 1), normal, unused)
            call check_close(error, normal, bench%set%friction%preload(k), 0.0_wp, bench%name//": preload")
            do c = 1, size(reactions, 2)
               call bench%set%press(k, -reactions(:, c), above, unused)
               call bench%set%press(k, reactions(:, c), normal, slope)
               call check_close(error, above, normal, 0.0_wp, bench%name//": opposite reactions")
               call check_true(error, normal >= bench%set%friction%preload(k) + abs(reactions(1, c)), &
                               bench%name//": at least the force")
               do row = 1, bench%set%n_row_item
                  lambda = reactions(:, c)
                  lambda(row) = lambda(row) + step
                  call bench%set%press(k, lambda, above, unused)
                  lambda(row) = lambda(row) - 2.0_wp*step
                  call bench%set%press(k, lambda, below, unused)
                  call check_close(error, slope(row), (above - below)/(2.0_wp*step), 1.0e-8_wp, bench%name//": slope")
               end do
            end do
         end do
      end do
   end subroutine test_normal_force

end module test_joint_friction
