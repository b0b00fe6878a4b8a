!> The Runge-Kutta-Chebyshev method: order and stability of every degree, the spectral radius, the work that stiffness costs.
module test_rock4
   use check, only: check_close, check_equal, check_true, suite_t
   use convergence, only: check_order, check_quadratures, check_tolerances, converge
   use errors, only: error_t
   use kinds, only: wp
   use ode_examples, only: growth_t, kepler_t, new_kepler, new_particles, new_pendulum, particles_t, pendulum_t, power_t, &
      run_to, slope
   use rock4, only: rock4_t
   use rock4_stages, only: min_degree, longest_stretch, n_recurrence
   use spectral_radius, only: find_radius
   implicit none (type, external)
   private
   public :: run_test_rock4

   integer, parameter :: n_halving = 4  !! step lengths of a convergence test

   !> A planet, and a state that follows its place with a fast decay: z' = -decay (z - x).
   type, extends(kepler_t) :: follower_t
      real(wp) :: decay = 0.0_wp  !! of the difference [1/s]
   contains
      procedure :: evaluate => follower_evaluate
   end type follower_t

contains

   subroutine run_test_rock4(suite)
      type(suite_t), intent(inout) :: suite  !! where tests are registered

      call suite%test("order_on_an_ellipse", test_order_on_an_ellipse)
      call suite%test("order_on_a_pendulum", test_order_on_a_pendulum)
      call suite%test("every_degree_is_of_order_4", test_every_degree)
      call suite%test("polynomials_up_to_degree_4_are_exact", test_polynomials)
      call suite%test("every_degree_is_stable_and_damps", test_stability)
      call suite%test("spectral_radius_of_decays_and_springs", test_radius)
      call suite%test("work_grows_with_the_root_of_the_stiffness", test_work)
      call suite%test("error_follows_the_tolerance", test_tolerance)
      call suite%test("quadratures_stay_out_of_the_norm", test_quadratures)
   end subroutine run_test_rock4

   subroutine follower_evaluate(self, t, y, ydot, status)
      class(follower_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(in) :: y(self%n)          !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)      !! (n) its derivative [any]
      integer, intent(out) :: status             !! outcome

      ydot(1:2) = y(3:4)
      ydot(3:4) = -y(1:2)/norm2(y(1:2))**3
      ydot(5) = -self%decay*(y(5) - y(1))
      status = 0
   end subroutine follower_evaluate

   !> The planet at its pericentre, its follower with it.
   subroutine new_follower(eccentricity, decay, system, y)
      real(wp), intent(in) :: eccentricity     !! of the ellipse [1]
      real(wp), intent(in) :: decay            !! of the difference [1/s]
      type(follower_t), intent(out) :: system  !! the system
      real(wp), intent(out) :: y(5)            !! (5) state at t = 0 [any]

      system%n = 5
      system%n_position = 2
      system%eccentricity = eccentricity
      system%decay = decay
      y(1:4) = system%exact(0.0_wp)
      y(5) = y(1)
   end subroutine new_follower

   subroutine test_order_on_an_ellipse(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(kepler_t) :: system
      real(wp) :: errors(4, n_halving), y(4)

      call new_kepler(0.1_wp, system, y)
      call converge("rock4", system, y, 5.0_wp, system%exact(5.0_wp), 20, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 3.7_wp, 4.4_wp, "position")
      call check_order(error, norm2(errors(3:4, :), dim=1), 3.7_wp, 4.4_wp, "velocity")
   end subroutine test_order_on_an_ellipse

   subroutine test_order_on_a_pendulum(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(pendulum_t) :: system
      real(wp), allocatable :: y(:)
      real(wp) :: errors(4, n_halving)

      call new_pendulum(0.9_wp, .true., system, y)
      call converge("rock4", system, y, 5.0_wp, system%exact(5.0_wp), 30, errors)
      call check_order(error, norm2(errors(1:2, :), dim=1), 3.6_wp, 4.6_wp, "state")
      call check_order(error, norm2(errors(3:4, :), dim=1), 3.6_wp, 4.6_wp, "quadratures")
   end subroutine test_order_on_a_pendulum

   !> One step of each degree, and one of half its length with twice the decay: the error of the planet falls as h^5.
   subroutine test_every_degree(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 0.1_wp
      type(follower_t) :: system
      type(rock4_t), allocatable :: method
      real(wp) :: errors(2), step, y(5)
      integer :: degree, half, status
      character(24) :: what

      do degree = 1, min_degree(longest_stretch())
         do half = 1, 2
            step = h/real(half, wp)
            call new_follower(0.3_wp, 0.99_wp*stretch_of(degree)/(1.2_wp*step), system, y)
            allocate (method)
            method%controls%fixed_step = step
            call method%start(system, 0.0_wp, y, step, status)
            call method%advance(system, step, status)
            call check_equal(error, status, 0, "status")
            errors(half) = maxval(abs(method%step%y1(1:4) - system%exact(step)))
            deallocate (method)
         end do
         write (what, "(a, i0, a)") "with ", n_recurrence(degree) + 4, " stages"
         call check_close(error, slope(errors(1), errors(2)), 5.0_wp, 0.35_wp, trim(what))
      end do
   end subroutine test_every_degree

   !> Maximum step times spectral radius that a degree is taken for.
   real(wp) function stretch_of(degree) result(z)
      integer, intent(in) :: degree  !! number of the degree

      real(wp) :: high, low
      integer :: k

      low = 0.0_wp
      high = longest_stretch()
      do k = 1, 60
         z = 0.5_wp*(low + high)
         if (min_degree(z) <= degree .and. min_degree(z) > 0) then
            low = z
         else
            high = z
         end if
      end do
      z = low
   end function stretch_of

   !> One step of a length that is no round number: weights, and places of the stages.
   subroutine test_polynomials(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: h = 1.3_wp
      type(power_t) :: system
      type(rock4_t), allocatable :: method
      real(wp) :: deviation, y(3)
      character(16) :: what
      integer :: p, status

      system%n = 3
      system%n_position = 1
      system%n_quadrature = 1
      do p = 1, 5
         allocate (method)
         system%p = p
         method%controls%fixed_step = h
         call method%start(system, 0.0_wp, [0.0_wp, merge(1.0_wp, 0.0_wp, p == 1), 0.0_wp], h, status)
         call method%advance(system, h, status)
         y = [1.0_wp, real(p, wp)/h, 1.0_wp]*h**p
         deviation = maxval(abs((method%step%y1 - y)/y))
         write (what, "(a, i0)") "degree ", p
         if (p <= 4) call check_close(error, deviation, 0.0_wp, 1.0e-14_wp, what)
         if (p == 5) call check_true(error, deviation > 1.0e-6_wp, "degree 5 is not exact")
         deallocate (method)
      end do
   end subroutine test_polynomials

   !> Decays up to the fastest that a degree is taken for: none grows, none below a quarter of it is left with more than 0.91.
   subroutine test_stability(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      integer, parameter :: n = 400
      type(growth_t) :: system
      type(rock4_t), allocatable :: method
      integer :: degree, i, status
      real(wp) :: z(n)

      system%n = n
      system%n_position = 0
      system%scale = [(1.0_wp, i=1, n)]
      do degree = 1, min_degree(longest_stretch())
         ! no reserve: the radius is known to be a fifth too large, and the first guess is along the fastest decay
         z = [(-0.999_wp*stretch_of(degree)/1.2_wp*real(i, wp)/real(n, wp), i=1, n)]
         system%rate = z
         allocate (method)
         method%controls%fixed_step = 1.0_wp
         call method%start(system, 0.0_wp, [(1.0_wp, i=1, n)], 1.0_wp, status)
         call method%advance(system, 1.0_wp, status)
         call check_equal(error, status, 0, "status")
         call check_true(error, maxval(abs(method%step%y1)) < 1.0_wp, "no decay grows")
         call check_true(error, maxval(abs(method%step%y1(n/4:))) < 0.91_wp, "fast ones are damped")
         call check_true(error, all(abs(method%step%y1 - exp(z)) < 0.01_wp*abs(z)**5 .or. z < -2.0_wp), "slow ones are followed")
         deallocate (method)
      end do
   end subroutine test_stability

   subroutine test_radius(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      type(growth_t) :: decays
      type(particles_t) :: springs
      real(wp) :: direction(4), f(4), moved(4), radius, rate(4), y(4)
      integer :: n, status

      decays%n = 4
      decays%scale = [1.0_wp, 1.0e-3_wp, 1.0_wp, 10.0_wp]
      decays%rate = [-1.0_wp, -200.0_wp, -5.0e4_wp, -300.0_wp]
      direction = 0.0_wp
      y = [1.0_wp, 1.0_wp, 1.0e-6_wp, 1.0_wp]
      call decays%evaluate(0.0_wp, y, f, status)
      call find_radius(decays, 0.0_wp, y, f, decays%scale, direction, moved, rate, radius, n, status)
      call check_equal(error, status, 0, "status")
      call check_close(error, radius, 1.2_wp*5.0e4_wp, 0.1_wp*5.0e4_wp, "fastest decay")
      call check_true(error, n < 12, "few evaluations")
      call new_particles([0.0_wp, 0.0_wp], [4.0e6_wp, 1.0_wp], [integer ::], [real(wp) ::], [real(wp) ::], springs)
      direction = 0.0_wp
      y = [1.0_wp, 1.0_wp, 0.0_wp, 1.0_wp]
      call springs%evaluate(0.0_wp, y, f, status)
      call find_radius(springs, 0.0_wp, y, f, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], direction, moved, rate, radius, n, status)
      call check_close(error, radius, 1.2_wp*2.0e3_wp, 0.1_wp*2.0e3_wp, "angular frequency of a spring without a damper")
   end subroutine test_radius

   !> A follower a hundred times as fast costs ten times as much, and the planet is as right.
   subroutine test_work(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      real(wp), parameter :: decay(2) = [1.0e2_wp, 1.0e4_wp]
      type(follower_t) :: system
      type(rock4_t), allocatable :: method
      real(wp) :: errors(2), evaluations(2), y(5)
      integer :: k, status

      do k = 1, 2
         call new_follower(0.5_wp, decay(k), system, y)
         allocate (method)
         method%controls%tolerance = 1.0e-6_wp
         call method%start(system, 0.0_wp, y, 20.0_wp, status)
         call run_to(method, system, 20.0_wp, status)
         call check_equal(error, status, 0, "status")
         errors(k) = maxval(abs(method%step%y1(1:4) - system%exact(20.0_wp)))
         evaluations(k) = real(method%count%n_evaluations, wp)
         ! the follower lags by the velocity over the decay
         call check_close(error, method%step%y1(5), method%step%y1(1) - method%step%y1(3)/decay(k), &
                          4.0_wp/decay(k)**2 + 1.0e-5_wp, "lag")
         deallocate (method)
      end do
      call check_true(error, all(errors < 1.0e-4_wp), "small errors")
      call check_close(error, log10(evaluations(2)/evaluations(1)), 1.0_wp, 0.15_wp, "decades of work over two of stiffness")
      ! a step of Verner's is at most some 4/decay long and takes eight: 400,000 evaluations
      call check_true(error, evaluations(2) < 40000.0_wp, "a tenth of what such a decay costs Verner's method")
   end subroutine test_work

   subroutine test_tolerance(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_tolerances("rock4", 5, 1.0_wp, error)
   end subroutine test_tolerance

   subroutine test_quadratures(error)
      type(error_t), allocatable, intent(out) :: error  !! what failed

      call check_quadratures("rock4", error)
   end subroutine test_quadratures

end module test_rock4
