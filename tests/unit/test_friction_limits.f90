!> Friction forces within their limits: the conditions of the complementarity problem.
module test_friction_limits
   use, intrinsic :: ieee_arithmetic, only: ieee_set_underflow_mode, ieee_support_underflow_control
   use check, only: check_close, check_true, suite_t
   use errors, only: error_t
   use friction_limits, only: limit_forces
   use kinds, only: wp
   use stick_slip_forces, only: solve_stick_slips
   implicit none (type, external)
   private
   public :: run_test_friction_limits

contains

   subroutine run_test_friction_limits(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("one_contact_in_the_plane", test_one)
      call suite%test("against_the_slip_of_uneven_mobility", test_uneven)
      call suite%test("conditions_of_many_contacts", test_many)
      call suite%test("a_shared_load_stays_shared", test_shared)
      call suite%test("contacts_that_begin_can_be_held", test_beginning)
   end subroutine run_test_friction_limits

   !> What is asked for within the limit, and the limit beyond.
   subroutine test_one(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: against(1), x(1)

      x = 0.0_wp
      call limit_forces(1, 1, 1, reshape([2.0_wp], [1, 1]), [6.0_wp], [4.0_wp], x, against)
      call check_close(error, x(1), 3.0_wp, 1.0e-15_wp, "within")
      if (allocated(error)) return
      call limit_forces(1, 1, 1, reshape([2.0_wp], [1, 1]), [-6.0_wp], [1.0_wp], x, against)
      call check_close(error, x(1), -1.0_wp, 1.0e-15_wp, "beyond")
      if (allocated(error)) return
      call check_close(error, against(1), -4.0_wp, 1.0e-15_wp, "what is left")
   end subroutine test_one

   !> Of a contact in space: at its limit, and against its sliding acceleration, which is not along what it is asked for.
   subroutine test_uneven(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: a(2, 2), against(2), x(2)

      a = reshape([5.0_wp, 1.0_wp, 1.0_wp, 0.5_wp], [2, 2])
      x = 0.0_wp
      call limit_forces(1, 2, 2, a, [4.0_wp, -3.0_wp], [1.5_wp], x, against)
      call check_close(error, norm2(x), 1.5_wp, 1.0e-14_wp, "its size")
      if (allocated(error)) return
      call check_close(error, x(1)*against(2) - x(2)*against(1), 0.0_wp, 1.0e-12_wp, "parallel")
      if (allocated(error)) return
      call check_true(error, dot_product(x, against) > 0.0_wp, "against the slip")
   end subroutine test_uneven

   !> Of random contacts in space with many bodies in common: those within their limits do not slip, those at them slip against
   !> their forces.
   subroutine test_many(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 5, m = 2*n, n_trial = 200
      real(wp) :: a(m, m), against(m), g(m, 40), limit(n), r(m), scale, x(m)
      integer :: c, i, n_at_limit, trial
      integer, allocatable :: seed(:)

      call random_seed(size=i)
      seed = [(7919*c, c=1, i)]
      call random_seed(put=seed)
      n_at_limit = 0
      do trial = 1, n_trial
         call random_number(g)
         call random_number(r)
         call random_number(limit)
         g = g - 0.5_wp
         r = 10.0_wp*(r - 0.5_wp)
         limit = 3.0_wp*limit
         a = matmul(g, transpose(g))
         x = 0.0_wp
         call limit_forces(n, 2, m, a, r, limit, x, against)
         scale = maxval(abs(r))
         do c = 1, n
            associate (f => x(2*c - 1:2*c), left => against(2*c - 1:2*c))
               call check_true(error, norm2(f) <= limit(c)*(1.0_wp + 1.0e-12_wp), "within its limit")
               if (allocated(error)) return
               if (norm2(f) < (1.0_wp - 1.0e-6_wp)*limit(c)) then
                  call check_close(error, norm2(left), 0.0_wp, 1.0e-7_wp*scale, "no slip within the limit")
               else
                  n_at_limit = n_at_limit + 1
                  call check_close(error, dot_product(f, left), norm2(f)*norm2(left), 1.0e-7_wp*scale*limit(c), "against the slip")
               end if
               if (allocated(error)) return
            end associate
         end do
      end do
      call check_true(error, n_at_limit > n_trial .and. n_at_limit < (n - 1)*n_trial, "both kinds are there")
   end subroutine test_many

   !> Two contacts of one body that slide together: what is within the limits is left as it was shared, what is beyond is
   !> the limits.
   subroutine test_shared(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: a(2, 2) = 0.5_wp
      real(wp) :: against(2), x(2)

      x = [3.0_wp, 1.0_wp]
      call limit_forces(2, 1, 2, a, [2.0_wp, 2.0_wp], [3.3_wp, 1.1_wp], x, against)
      call check_close(error, x, [3.0_wp, 1.0_wp], 1.0e-14_wp, "as it was shared")
      if (allocated(error)) return
      call limit_forces(2, 1, 2, a, [2.0_wp, 2.0_wp], [2.7_wp, 0.9_wp], x, against)
      call check_close(error, x, [2.7_wp, 0.9_wp], 1.0e-14_wp, "at both limits")
      if (allocated(error)) return
      call check_close(error, against, [0.2_wp, 0.2_wp], 1.0e-14_wp, "slip of both")
   end subroutine test_shared

   !> Contacts of which both, one or none begin, without a normal force: the forces that hold them are unique whatever these are.
   subroutine test_beginning(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp) :: a(2, 2), eigenvalue(2), left(2), root(2), work(68), x(2)
      logical :: can_set
      integer :: i

      can_set = ieee_support_underflow_control(1.0_wp)
      if (can_set) call ieee_set_underflow_mode(gradual=.false.)  ! as in the program
      do i = 1, 3
         a = reshape([0.5_wp, 0.1_wp, 0.1_wp, 0.25_wp], [2, 2])
         x = matmul(a, [3.0_wp, -2.0_wp])
         root = merge(sqrt(tiny(1.0_wp)), 7.0_wp, [i < 2, i < 3])
         call solve_stick_slips(2, 2, a, [0.5_wp, 0.25_wp], 1.0e-11_wp, root, x, left, eigenvalue, work)
         call check_close(error, x, [3.0_wp, -2.0_wp], 1.0e-12_wp, "forces")
         if (.not. allocated(error)) call check_close(error, left, [0.0_wp, 0.0_wp], 1.0e-12_wp, "what no force changes")
         if (allocated(error)) exit
      end do
      if (can_set) call ieee_set_underflow_mode(gradual=.true.)
   end subroutine test_beginning

end module test_friction_limits
