!> Derivatives of the rows and of the coordinate of every ideal joint and driver, by differences: a kind is tested by being
!> registered.
!>
!> Rows are taken at positions that violate them, at any velocity: nothing here needs a solution.
module test_joint_derivatives
   use check, only: check_close, suite_t
   use differences, only: five_point, places, six_places, six_point
   use errors, only: error_t
   use joint_bench, only: before, bench_t, evaluate_after, make_bench, n_body, n_item, n_seed, times_jacobian
   use joint_registry, only: n_joint_kinds
   use kinds, only: wp
   use planar_kinds, only: is_planar_joint
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_joint_derivatives

   real(wp), parameter :: step = 1.0e-3_wp  !! of differences [any]

contains

   subroutine run_test_joint_derivatives(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("jacobian", test_jacobian)
      call suite%test("rate", test_rate)
      call suite%test("gamma", test_gamma)
      call suite%test("coordinate", test_coordinate)
   end subroutine run_test_joint_derivatives

   !> Phi_q against differences of Phi, one coordinate after the other.
   subroutine test_jacobian(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: phi(:, :)
      real(wp) :: direction(3, n_body), q(3, n_body)
      integer :: body, c, k, kind, row, seed

      do kind = 1, n_joint_kinds()
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

      do kind = 1, n_joint_kinds()
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

      do kind = 1, n_joint_kinds()
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

   !> The rate of a set's coordinate is the rate of its value; a driver's is what it drives, Phi = value - f(t).
   subroutine test_coordinate(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(bench_t) :: bench
      real(wp), allocatable :: rates(:)
      real(wp) :: rate, unused, value(6)
      integer :: item, k, kind

      do kind = 1, n_joint_kinds()
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

end module test_joint_derivatives
