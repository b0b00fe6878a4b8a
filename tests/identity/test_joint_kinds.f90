!> Identities that the rows of every ideal joint and driver fulfil, whose they are, and lengths that are omitted or zero: a kind is
!> tested by being registered.
!>
!> Rows are taken at positions that violate them, at any velocity: nothing here needs a solution.
module test_joint_kinds
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use joint_bench, only: before, bench_t, evaluate_after, make_bench, n_body, n_item, n_seed, span_between
   use joint_distance, only: joint_distance_t
   use joint_registry, only: n_joint_kinds
   use kinds, only: wp
   use lapack, only: dgelsd
   use planar_kinds, only: is_planar_joint
   implicit none (type, external)
   private
   public :: run_test_joint_kinds

contains

   subroutine run_test_joint_kinds(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("rows_of_others", test_rows_of_others)
      call suite%test("translation_of_everything", test_translation_of_everything)
      call suite%test("rotation_of_everything", test_rotation_of_everything)
      call suite%test("lengths_and_angles", test_lengths_and_angles)
      call suite%test("left_out_at_start", test_left_out_at_start)
      call suite%test("coinciding_points", test_coinciding_points)
   end subroutine run_test_joint_kinds

   !> A kind writes its own rows only, all of them, and says whose they are.
   subroutine test_rows_of_others(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), parameter :: mark = 12345.0_wp
      integer :: item, kind, row

      do kind = 1, n_joint_kinds()
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

      do kind = 1, n_joint_kinds()
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

      do kind = 1, n_joint_kinds()
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

      do kind = 1, n_joint_kinds()
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

   !> A length that a row omits is that of the start, whatever stands elsewhere in the row.
   subroutine test_left_out_at_start(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      integer :: item, kind, n_kind

      n_kind = 0
      do kind = 1, n_joint_kinds()
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
      do kind = 1, n_joint_kinds()
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

end module test_joint_kinds
