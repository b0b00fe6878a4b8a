!> The polynomial of Hermite through states within a step: what it must give exactly, and what is kept of it.
module test_step_nodes
   use check, only: check_close, check_equal, check_true, suite_t
   use errors, only: error_t
   use interpolation, only: step_t
   use kinds, only: wp
   use step_nodes, only: step_nodes_t
   implicit none (type, external)
   private
   public :: run_test_step_nodes

   real(wp), parameter :: places(3) = [0.2_wp, 0.85_wp, 0.5_wp]  !! of the states [1]

contains

   subroutine run_test_step_nodes(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("step_nodes_exact", test_exact)
      call suite%test("step_nodes_lagrange", test_lagrange)
      call suite%test("step_nodes_places", test_places)
      call suite%test("step_nodes_kept", test_kept)
      call suite%test("step_nodes_row", test_row)
   end subroutine run_test_step_nodes

   !> A power of time, and its derivative: t^k and k t^(k-1).
   pure subroutine power(k, t, y, f)
      integer, intent(in) :: k             !! the power
      real(wp), intent(in) :: t            !! time [s]
      real(wp), intent(out) :: y(1), f(1)  !! (1) state and derivative [s^k, s^(k-1)]

      y = t**k
      f = k*t**(k - 1)
   end subroutine power

   !> The step from 1.5 to 1.75 of a power of time.
   subroutine make_step(k, step)
      integer, intent(in) :: k            !! the power
      type(step_t), intent(out) :: step   !! the step

      allocate (step%y0(1), step%y1(1), step%f0(1), step%f1(1))
      step%t0 = 1.5_wp
      step%h = 0.25_wp
      call power(k, step%t0, step%y0, step%f0)
      call power(k, step%t0 + step%h, step%y1, step%f1)
   end subroutine make_step

   !> Add a state of that step.
   subroutine add(nodes, step, k, s)
      type(step_nodes_t), intent(inout) :: nodes  !! the states
      type(step_t), intent(in) :: step            !! the step
      integer, intent(in) :: k                    !! the power
      real(wp), intent(in) :: s                   !! its place [1]

      real(wp) :: y(1), f(1)

      call power(k, step%t0 + s*step%h, y, f)
      call nodes%add(s, y, f)
   end subroutine add

   !> With n states within the step powers up to 2 n + 3 are exact, and the next one is wrong by h^(2 n + 4) times the product of
   !> (s - s_k)^2.
   subroutine test_exact(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: f(1), f_true(1), missing, s, y(1), y_true(1)
      type(step_nodes_t) :: nodes
      type(step_t) :: step
      integer :: i, k, n

      call nodes%open(1)
      do n = 0, 3
         do k = 1, 2*n + 4
            call make_step(k, step)
            step%h = step%h*(1.0_wp + 1.0e-15_wp*k)   ! another step: states of the last one are forgotten
            call nodes%begin(step, with_rates=.true.)
            do i = 1, n
               call add(nodes, step, k, places(i))
            end do
            call power(k, step%t0 + step%h, step%y1, step%f1)
            s = 0.7_wp
            call nodes%interpolate(step, s, y, f)
            call power(k, step%t0 + s*step%h, y_true, f_true)
            missing = 0.0_wp
            if (k == 2*n + 4) missing = step%h**k*(s*(s - 1.0_wp)*product(s - places(:n)))**2
            call check_close(error, y_true(1) - y(1), missing, 1.0e-12_wp*y_true(1), "state")
            if (k < 2*n + 4) call check_close(error, f(1), f_true(1), 1.0e-10_wp*f_true(1), "derivative")
            if (allocated(error)) return
         end do
      end do
   end subroutine test_exact

   !> Without derivatives powers up to n + 1 are exact, and the next one is wrong by h^(n + 2) times the product of (s - s_k).
   subroutine test_lagrange(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: f(1), f_true(1), missing, s, y(1), y_true(1)
      type(step_nodes_t) :: nodes
      type(step_t) :: step
      integer :: i, k

      call nodes%open(1)
      do k = 1, 5
         call make_step(k, step)
         step%f0 = huge(1.0_wp)   ! derivatives are not used
         step%h = step%h*(1.0_wp + 1.0e-15_wp*k)
         call nodes%begin(step, with_rates=.false.)
         do i = 1, 3
            call add(nodes, step, k, places(i))
         end do
         call power(k, step%t0 + step%h, step%y1, step%f1)
         s = 0.7_wp
         call nodes%interpolate(step, s, y, f)
         call power(k, step%t0 + s*step%h, y_true, f_true)
         missing = merge(step%h**k*s*(s - 1.0_wp)*product(s - places), 0.0_wp, k == 5)
         call check_close(error, y_true(1) - y(1), missing, 1.0e-12_wp*y_true(1), "state")
         if (k < 5) call check_close(error, f(1), f_true(1), 1.0e-10_wp*f_true(1), "derivative")
         if (allocated(error)) return
      end do
   end subroutine test_lagrange

   !> A node goes to the middle of a gap that is wide against the distance of rows, else to the row, and to the row when the storage
   !> is full.
   subroutine test_places(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(step_nodes_t) :: nodes
      type(step_t) :: step
      integer :: i

      call nodes%open(1)
      call make_step(2, step)
      call nodes%begin(step, with_rates=.true.)
      call check_close(error, nodes%place_for(0.1_wp), 0.5_wp, 1.0e-15_wp, "middle of the step")
      if (.not. allocated(error)) call check_close(error, nodes%place_for(0.3_wp), 0.3_wp, 0.0_wp, "few rows")
      call add(nodes, step, 2, 0.5_wp)
      call nodes%keep_row(0.6_wp, [0.0_wp])
      if (.not. allocated(error)) call check_close(error, nodes%place_for(0.7_wp), 0.75_wp, 1.0e-15_wp, "middle of a gap")
      if (.not. allocated(error)) call check_close(error, nodes%place_for(0.8_wp), 0.8_wp, 0.0_wp, "few rows in the gap")
      do i = 1, 4
         call add(nodes, step, 2, 0.5_wp + 0.1_wp*i)
      end do
      call nodes%keep_row(0.0_wp, [0.0_wp])
      if (.not. allocated(error)) call check_close(error, nodes%place_for(0.01_wp), 0.01_wp, 0.0_wp, "no storage left")
   end subroutine test_places

   !> A state near another one is not kept; of a step that is still the last one none is forgotten.
   subroutine test_kept(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: f(1), y(1), y_before(1)
      type(step_nodes_t) :: nodes
      type(step_t) :: step

      call nodes%open(1)
      call make_step(9, step)
      call nodes%begin(step, with_rates=.true.)
      call add(nodes, step, 9, 0.4_wp)
      call nodes%interpolate(step, 0.6_wp, y_before, f)
      call add(nodes, step, 9, 0.405_wp)
      call add(nodes, step, 9, 0.999_wp)
      nodes%are_of_use = .false.
      call nodes%begin(step, with_rates=.true.)
      call nodes%interpolate(step, 0.6_wp, y, f)
      call check_close(error, y(1), y_before(1), 0.0_wp, "the same states")
      step%t0 = 1.75_wp
      call nodes%begin(step, with_rates=.true.)
      call check_equal(error, merge(1, 0, nodes%are_of_use), 1, "of use in another step")
   end subroutine test_kept

   !> The state of the last row is given again to whoever asks for it, in the same step and at the same place only.
   subroutine test_row(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: y(1)
      type(step_nodes_t) :: nodes
      type(step_t) :: step
      logical :: has_row

      call nodes%open(1)
      call make_step(9, step)
      call nodes%begin(step, with_rates=.true.)
      call nodes%keep_row(0.3_wp, [7.0_wp])
      y = 1.0_wp
      call nodes%has_row(nearest(0.3_wp, 1.0_wp), y, has_row)
      call check_true(error, .not. has_row .and. abs(y(1) - 1.0_wp) <= 0.0_wp, "another place")
      call nodes%has_row(0.3_wp, y, has_row)
      if (.not. allocated(error)) call check_true(error, has_row .and. abs(y(1) - 7.0_wp) <= 0.0_wp, "the row")
      step%t0 = 1.75_wp
      call nodes%begin(step, with_rates=.true.)
      call nodes%has_row(0.3_wp, y, has_row)
      if (.not. allocated(error)) call check_true(error, .not. has_row, "another step")
   end subroutine test_row

end module test_step_nodes
