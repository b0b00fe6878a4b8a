!> Pressures that are nowhere below zero: the conditions themselves, another method, and cells that are known.
module test_complementarity
   use check, only: check_close, check_equal, check_true, suite_t
   use complementarity, only: complementarity_t, new_complementarity
   use errors, only: error_t
   use fixed_random, only: random_t
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: run_test_complementarity

contains

   subroutine run_test_complementarity(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("conditions", test_conditions)
      call suite%test("relaxation", test_relaxation)
      call suite%test("full", test_full)
      call suite%test("nothing", test_nothing)
   end subroutine run_test_complementarity

   !> A problem with random conductances and sources, its ends at zero.
   subroutine make_problem(seed, m, n, is_full, problem)
      integer, intent(in) :: seed                    !! of the numbers
      integer, intent(in) :: m, n                    !! rows and columns
      logical, intent(in) :: is_full                 !! pressures may be below zero
      type(complementarity_t), intent(out) :: problem !! the problem

      type(random_t) :: random
      integer :: j, k

      random%state = seed
      call new_complementarity(problem, m, n, is_full)
      do k = 1, n
         do j = 1, m
            problem%around(j, k) = random%between(0.1_wp, 3.0_wp)
            if (j < m) problem%along(j, k) = random%between(0.1_wp, 3.0_wp)
            problem%source(j, k) = random%between(-1.0_wp, 1.0_wp)
         end do
         problem%ground(m, k) = random%between(0.1_wp, 3.0_wp)
      end do
   end subroutine make_problem

   !> What flows into a cell beside its source, and the conductances to all around it.
   pure subroutine neighbours(problem, j, k, inflow, conductance)
      type(complementarity_t), intent(in) :: problem  !! the problem
      integer, intent(in) :: j, k                     !! the cell
      real(wp), intent(out) :: inflow                 !! sum of conductance times pressure [1/s]
      real(wp), intent(out) :: conductance            !! sum of conductances [1]

      integer :: after, before

      before = merge(problem%n, k - 1, k == 1)
      after = merge(1, k + 1, k == problem%n)
      inflow = problem%around(j, k)*problem%p(j, after) + problem%around(j, before)*problem%p(j, before)
      conductance = problem%around(j, k) + problem%around(j, before) + problem%ground(j, k)
      if (j < problem%m) then
         inflow = inflow + problem%along(j, k)*problem%p(j + 1, k)
         conductance = conductance + problem%along(j, k)
      end if
      if (j > 1) then
         inflow = inflow + problem%along(j - 1, k)*problem%p(j - 1, k)
         conductance = conductance + problem%along(j - 1, k)
      end if
   end subroutine neighbours

   !> p >= 0, what is too much flows nowhere, and one of both is zero in every cell; from any set of wet cells the same.
   subroutine test_conditions(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(complementarity_t) :: problem
      real(wp) :: conductance, first(5, 9), inflow, rest
      integer :: j, k, n_dry, seed, status

      n_dry = 0
      do seed = 1, 40
         call make_problem(seed, 5, 9, .false., problem)
         call problem%solve(status)
         call check_equal(error, status, 0, "status")
         n_dry = n_dry + count(.not. problem%is_wet)
         do k = 1, problem%n
            do j = 1, problem%m
               call neighbours(problem, j, k, inflow, conductance)
               rest = conductance*problem%p(j, k) - inflow - problem%source(j, k)
               call check_true(error, problem%p(j, k) >= 0.0_wp, "p >= 0")
               call check_true(error, rest >= -1.0e-11_wp, "A p >= b")
               call check_close(error, rest*problem%p(j, k), 0.0_wp, 1.0e-11_wp, "p (A p - b), problem "//to_text(seed))
            end do
         end do
         first = problem%p
         problem%is_wet = reshape([(modulo(k*k, 7) < 3, k=1, 45)], [5, 9])
         call problem%solve(status)
         call check_close(error, reshape(problem%p, [45]), reshape(first, [45]), 1.0e-12_wp, "from another set")
      end do
      call check_true(error, n_dry > 200 .and. n_dry < 1600, "of 1800 cells many are dry, many wet")
   end subroutine test_conditions

   !> Gauss and Seidel's sweeps, cell by cell cut at zero (Christopherson), go the same way; a known cell keeps its pressure.
   subroutine test_relaxation(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(complementarity_t) :: other, problem
      real(wp) :: conductance, inflow
      integer :: j, k, status, sweep

      call make_problem(77, 4, 6, .false., problem)
      problem%is_known(2:3, 4) = .true.
      problem%p(2:3, 4) = 0.7_wp
      problem%around(2:3, 3:4) = 0.0_wp
      problem%along(1:3, 4) = 0.0_wp
      other = problem
      call problem%solve(status)
      call check_equal(error, status, 0, "status")
      do sweep = 1, 2000
         do k = 1, other%n
            do j = 1, other%m
               if (other%is_known(j, k)) cycle
               call neighbours(other, j, k, inflow, conductance)
               other%p(j, k) = max(0.0_wp, (inflow + other%source(j, k))/conductance)
            end do
         end do
      end do
      call check_close(error, reshape(problem%p, [24]), reshape(other%p, [24]), 1.0e-11_wp, "relaxation")
      call check_close(error, problem%p(2:3, 4), [0.7_wp, 0.7_wp], 0.0_wp, "known cells")
   end subroutine test_relaxation

   !> Pressures of any sign solve the equations; they are odd in the sources.
   subroutine test_full(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(complementarity_t) :: problem
      real(wp) :: conductance, inflow, p(6, 7)
      integer :: j, k, status

      call make_problem(5, 6, 7, .true., problem)
      call problem%solve(status)
      call check_equal(error, status, 0, "status")
      do k = 1, problem%n
         do j = 1, problem%m
            call neighbours(problem, j, k, inflow, conductance)
            call check_close(error, conductance*problem%p(j, k), inflow + problem%source(j, k), 1.0e-12_wp, "A p = b")
         end do
      end do
      p = problem%p
      problem%source = -problem%source
      call problem%solve(status)
      call check_close(error, reshape(problem%p, [42]), -reshape(p, [42]), 1.0e-13_wp, "odd")
   end subroutine test_full

   !> Without sources there is no pressure, and where all flows away none either.
   subroutine test_nothing(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(complementarity_t) :: problem
      integer :: status

      call make_problem(9, 3, 4, .false., problem)
      problem%source = 0.0_wp
      call problem%solve(status)
      call check_equal(error, status, 0, "no sources: status")
      call check_true(error, all(abs(problem%p) <= 0.0_wp), "no sources: no pressure")
      problem%source = -1.0_wp
      call problem%solve(status)
      call check_equal(error, status, 0, "all flows away: status")
      call check_true(error, all(abs(problem%p) <= 0.0_wp), "all flows away: no pressure")
   end subroutine test_nothing

end module test_complementarity
