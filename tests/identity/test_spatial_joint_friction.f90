!> Identities of friction in ideal joints of space, for every kind that has it.
module test_spatial_joint_friction
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use fixed_random, only: random_t
   use joint_friction, only: most_rows
   use kinds, only: wp
   use motion, only: cross
   use spatial_bench, only: bench_t, evaluate_after, make_bench, n_item, spatial_kinds
   implicit none (type, external)
   private
   public :: run_test_spatial_joint_friction

   integer, parameter :: n_seed = 4         !! geometries for each kind
   integer, parameter :: n_rubbing = 2      !! kinds with friction
   real(wp), parameter :: step = 1.0e-6_wp  !! of differences [N or N.m]

   abstract interface
      !> What is claimed of one item that has friction.
      subroutine claim_of_item(error, bench, k)
         import :: bench_t, error_t
         implicit none (type, external)
         type(error_t), allocatable, intent(inout) :: error  !! what failed
         type(bench_t), intent(inout) :: bench               !! the kind, its items slide
         integer, intent(in) :: k                            !! the item
      end subroutine claim_of_item
   end interface

contains

   subroutine run_test_spatial_joint_friction(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("action_and_reaction", test_action_and_reaction)
      call suite%test("sliding_velocity", test_sliding_velocity)
      call suite%test("normal_force", test_normal_force)
   end subroutine run_test_spatial_joint_friction

   !> The two friction forces of a joint add up to no force and no moment.
   subroutine test_action_and_reaction(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, balances)
   end subroutine test_action_and_reaction

   !> The sliding velocity is what the rates give with the row, whose loads its power comes from.
   subroutine test_sliding_velocity(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, slides)
   end subroutine test_sliding_velocity

   !> The normal force is its preload without a reaction, the same for opposite ones, and its slope is that of differences.
   subroutine test_normal_force(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call claim_all(error, presses)
   end subroutine test_normal_force

   !> Claim something of every item of all kinds with friction.
   subroutine claim_all(error, what)
      type(error_t), allocatable, intent(out) :: error  !! what failed
      procedure(claim_of_item) :: what                  !! the claim

      type(bench_t) :: bench
      integer, allocatable :: kinds(:)
      integer :: k, kind, n_kind, seed

      kinds = spatial_kinds()
      n_kind = 0
      do kind = 1, size(kinds)
         do seed = 1, n_seed
            call make_bench(kinds(kind), seed, bench)
            if (bench%set%friction%n == 0) cycle
            if (seed == 1) n_kind = n_kind + 1
            call evaluate_after(bench, 0.0_wp)
            call bench%set%slide(bench%motion)
            do k = 1, n_item
               call what(error, bench, k)
               if (allocated(error)) return
            end do
         end do
      end do
      call check_equal(error, n_kind, n_rubbing, "kinds that rub")
   end subroutine claim_all

   !> Forces and moments about the origin.
   subroutine balances(error, bench, k)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the kind, its items slide
      integer, intent(in) :: k                            !! the item

      real(wp) :: force(3, 2), moment(3)
      integer :: side

      moment = 0.0_wp
      do side = 1, 2
         associate (row => bench%set%friction%row(6*side - 5:6*side, k), body => bench%set%body(side, k))
            force(:, side) = row(:3)
            moment = moment + matmul(bench%motion%rot(:, :, body), row(4:)) + cross(bench%motion%r(:, body), row(:3))
         end associate
      end do
      call check_close(error, force(:, 1), -force(:, 2), 1.0e-15_wp, bench%name//": forces")
      call check_close(error, moment, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, bench%name//": moments")
   end subroutine balances

   !> The velocity against that of the rates.
   subroutine slides(error, bench, k)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the kind, its items slide
      integer, intent(in) :: k                            !! the item

      real(wp) :: v
      integer :: side

      v = 0.0_wp
      do side = 1, 2
         if (bench%set%body(side, k) == 0) cycle
         v = v + dot_product(bench%set%friction%row(6*side - 5:6*side, k), bench%v(:, bench%set%body(side, k)))
      end do
      call check_true(error, abs(v) > 1.0e-3_wp, bench%name//": slides")
      call check_close(error, bench%set%friction%v(k), v, 1.0e-14_wp, bench%name//": sliding velocity")
   end subroutine slides

   !> The normal force of random reactions.
   subroutine presses(error, bench, k)
      type(error_t), allocatable, intent(inout) :: error  !! what failed
      type(bench_t), intent(inout) :: bench               !! the kind, its items slide
      integer, intent(in) :: k                            !! the item

      type(random_t) :: random
      real(wp) :: above, below, lambda(most_rows), normal, reaction(most_rows), slope(most_rows), unused(most_rows)
      integer :: c, row

      random%state = k
      associate (set => bench%set)
         lambda = 0.0_wp
         call set%press(k, lambda, normal, unused)
         call check_close(error, normal, set%friction%preload(k), 0.0_wp, bench%name//": preload")
         do c = 1, 3
            reaction = random%vector(most_rows, -3.0_wp, 3.0_wp)
            call set%press(k, -reaction, above, unused)
            call set%press(k, reaction, normal, slope)
            call check_close(error, above, normal, 1.0e-15_wp, bench%name//": opposite reactions")
            do row = 1, set%n_row_item
               lambda = reaction
               lambda(row) = lambda(row) + step
               call set%press(k, lambda, above, unused)
               lambda(row) = lambda(row) - 2.0_wp*step
               call set%press(k, lambda, below, unused)
               call check_close(error, slope(row), (above - below)/(2.0_wp*step), 1.0e-7_wp, bench%name//": slope")
            end do
         end do
      end associate
   end subroutine presses

end module test_spatial_joint_friction
