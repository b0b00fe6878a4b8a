!> Least squares with bounds against closed forms, and intervals against their frequency in repeats.
module test_fit
   use check, only: check_close, check_equal, check_true, suite_t
   use counter_random, only: uniform_at
   use errors, only: error_t
   use fit_intervals, only: find_intervals, intervals_t
   use kinds, only: i8, wp
   use least_squares, only: end_converged, end_failed, minimise, minimum_t, residuals_t
   use normal_distribution, only: normal_quantile
   implicit none (type, external)
   private
   public :: run_test_fit

   integer, parameter :: n_data = 40          ! of the decay
   real(wp), parameter :: sigma = 0.02_wp     ! noise of the decay [1]

   !> Rosenbrock's function over a square: r = (10 (y - x^2), 1 - x), x and y from -2 to `most`.
   type, extends(residuals_t) :: valley_t
      real(wp) :: most = 2.0_wp               !! upper bound of both [1]
      logical :: fails = .false.              !! there are no residuals
   contains
      procedure :: evaluate => valley_evaluate
      procedure :: derive => valley_derive
   end type valley_t

   !> A decay a exp(-b t) with noise; the third unknown does nothing, or acts as the first one.
   type, extends(residuals_t) :: decay_t
      real(wp) :: y(n_data) = 0.0_wp          !! (n_data) data [1]
      logical :: is_double = .false.          !! the third unknown acts as the first one
   contains
      procedure :: evaluate => decay_evaluate
      procedure :: derive => decay_derive
   end type decay_t

contains

   !> Register the tests.
   subroutine run_test_fit(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("valley", test_valley)
      call suite%test("bound", test_bound)
      call suite%test("failure", test_failure)
      call suite%test("coverage", test_coverage)
      call suite%test("not_seen", test_not_seen)
   end subroutine run_test_fit

   !> Residuals of Rosenbrock's function.
   subroutine valley_evaluate(self, u, r, is_good)
      class(valley_t), intent(inout) :: self       !! the model
      real(wp), intent(in) :: u(:)                 !! (2) unknowns [1]
      real(wp), allocatable, intent(out) :: r(:)   !! (2) residuals [1]
      logical, intent(out) :: is_good              !! there are some

      real(wp) :: x(2)

      x = -2.0_wp + (self%most + 2.0_wp)*u
      r = [10.0_wp*(x(2) - x(1)**2), 1.0_wp - x(1)]
      is_good = .not. self%fails
   end subroutine valley_evaluate

   !> Residuals and derivatives of Rosenbrock's function.
   subroutine valley_derive(self, u, r, jac, is_good)
      class(valley_t), intent(inout) :: self             !! the model
      real(wp), intent(in) :: u(:)                       !! (2) unknowns [1]
      real(wp), allocatable, intent(out) :: r(:)         !! (2) residuals [1]
      real(wp), allocatable, intent(out) :: jac(:, :)    !! (2, 2) derivatives [1]
      logical, intent(out) :: is_good                    !! there are some

      call self%evaluate(u, r, is_good)
      jac = (self%most + 2.0_wp)*reshape([-20.0_wp*(-2.0_wp + (self%most + 2.0_wp)*u(1)), -1.0_wp, 10.0_wp, 0.0_wp], [2, 2])
   end subroutine valley_derive

   !> Residuals of the decay.
   subroutine decay_evaluate(self, u, r, is_good)
      class(decay_t), intent(inout) :: self        !! the model
      real(wp), intent(in) :: u(:)                 !! (3) unknowns [1]
      real(wp), allocatable, intent(out) :: r(:)   !! (n_data) residuals [1]
      logical, intent(out) :: is_good              !! there are some

      real(wp), allocatable :: jac(:, :)

      call self%derive(u, r, jac, is_good)
   end subroutine decay_evaluate

   !> Residuals and derivatives of the decay: a = 2 u(1), b = 3 u(2).
   subroutine decay_derive(self, u, r, jac, is_good)
      class(decay_t), intent(inout) :: self              !! the model
      real(wp), intent(in) :: u(:)                       !! (3) unknowns [1]
      real(wp), allocatable, intent(out) :: r(:)         !! (n_data) residuals [1]
      real(wp), allocatable, intent(out) :: jac(:, :)    !! (n_data, 3) derivatives [1]
      logical, intent(out) :: is_good                    !! there are some

      real(wp) :: a, e, t
      integer :: i

      allocate (r(n_data), jac(n_data, size(u)))
      a = 2.0_wp*u(1)
      if (self%is_double) a = a + 2.0_wp*u(3)
      do i = 1, n_data
         t = time(i)
         e = exp(-3.0_wp*u(2)*t)
         r(i) = a*e - self%y(i)
         jac(i, :2) = [2.0_wp*e, -3.0_wp*t*a*e]
         if (size(u) > 2) jac(i, 3) = merge(2.0_wp*e, 0.0_wp, self%is_double)
      end do
      is_good = .true.
   end subroutine decay_derive

   !> Times of the decay.
   pure real(wp) function time(i)
      integer, intent(in) :: i    !! number

      time = 0.05_wp*(i - 1)
   end function time

   !> A decay with a = 1, b = 1.2 and noise that depends on the number of the repeat alone.
   function new_decay(repeat) result(model)
      integer, intent(in) :: repeat     !! number of the repeat
      type(decay_t) :: model            !! data

      integer :: i

      do i = 1, n_data
         model%y(i) = exp(-1.2_wp*time(i)) + sigma*normal_quantile(uniform_at(7, 1, int(repeat, i8), i))
      end do
   end function new_decay

   !> The minimum of the curved valley.
   subroutine test_valley(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(minimum_t) :: found
      type(valley_t) :: model

      call minimise(model, [0.2_wp, 0.75_wp], 200, found)
      call check_equal(error, found%end, end_converged, "end")
      call check_close(error, found%u, [0.75_wp, 0.75_wp], 1.0e-9_wp, "x = y = 1")
   end subroutine test_valley

   !> With bounds at 1/2 the minimum is at x = 1/2, y = 1/4.
   subroutine test_bound(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(minimum_t) :: found
      type(valley_t) :: model

      model%most = 0.5_wp
      call minimise(model, [0.1_wp, 0.9_wp], 200, found)
      call check_equal(error, found%end, end_converged, "end")
      call check_close(error, found%u, [1.0_wp, 0.9_wp], 1.0e-7_wp, "x = 1/2, y = 1/4")
   end subroutine test_bound

   !> No residuals at the start.
   subroutine test_failure(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(minimum_t) :: found
      type(valley_t) :: model

      model%fails = .true.
      call minimise(model, [0.1_wp, 0.9_wp], 200, found)
      call check_equal(error, found%end, end_failed, "end")
   end subroutine test_failure

   !> Of 1000 repeats 95 % have the true values in their intervals, with the noise of the residuals and with a given one.
   subroutine test_coverage(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 1000
      type(decay_t) :: model
      type(intervals_t) :: known
      type(minimum_t) :: found
      integer :: hits(2, 2), k, p

      hits = 0
      do k = 1, n
         model = new_decay(k)
         call minimise(model, [0.9_wp, 0.9_wp], 100, found)
         do p = 1, 2
            if (p == 1) call find_intervals(found%u, found%r, found%jac, .false., known)
            if (p == 2) call find_intervals(found%u, found%r/sigma, found%jac/sigma, .true., known)
            where (known%low <= [0.5_wp, 0.4_wp] .and. [0.5_wp, 0.4_wp] <= known%high) hits(:, p) = hits(:, p) + 1
         end do
      end do
      call check_true(error, all(abs(hits - 950) <= 25), "95 % of 1000 repeats, standard deviation 7")
   end subroutine test_coverage

   !> An unknown without influence has its bounds as interval; two that act alike are named together, and the others keep theirs.
   subroutine test_not_seen(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(decay_t) :: model
      type(intervals_t) :: known, plain
      type(minimum_t) :: found

      model = new_decay(1)
      call minimise(model, [0.9_wp, 0.9_wp], 100, found)
      call find_intervals(found%u, found%r, found%jac, .false., plain)
      call minimise(model, [0.9_wp, 0.9_wp, 0.3_wp], 100, found)
      call find_intervals(found%u, found%r, found%jac, .false., known)
      call check_true(error, all(known%is_seen .eqv. [.true., .true., .false.]), "the third is not seen")
      call check_close(error, [known%low(3), known%high(3)], [0.0_wp, 1.0_wp], 0.0_wp, "bounds")
      call check_close(error, known%correlation(1, 2), plain%correlation(1, 2), 1.0e-8_wp, "the others")
      if (allocated(error)) return
      model%is_double = .true.
      call minimise(model, [0.4_wp, 0.9_wp, 0.3_wp], 100, found)
      call find_intervals(found%u, found%r, found%jac, .false., known)
      call check_true(error, known%partner(1) == 3 .and. known%partner(3) == 1, "named together")
      call check_true(error, known%is_seen(2) .and. .not. known%is_seen(1), "the rate is seen")
      call check_close(error, known%covariance(2, 2), plain%covariance(2, 2)*(n_data - 2)/real(n_data - 3, wp), 1.0e-8_wp, &
                       "interval of the rate")
   end subroutine test_not_seen

end module test_fit
