!> Small systems with exact solutions, for the tests of integrators.
module ode_examples
   use integrator, only: advance_event, integrator_t
   use kinds, only: wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: growth_t, kepler_t, new_kepler, new_particles, new_pendulum, particles_t, pendulum_t, plain_t, power_t, root_t
   public :: run_to, slope

   !> A system without events whose error scales are all one.
   type, abstract, extends(ode_system_t) :: plain_t
   contains
      procedure :: weights => plain_weights
      procedure :: events => plain_events
   end type plain_t

   !> Two bodies, x'' = -x/|x|^3, from the pericentre of an ellipse with half axis 1.
   type, extends(plain_t) :: kepler_t
      real(wp) :: eccentricity = 0.0_wp  !! of the ellipse [1]
   contains
      procedure :: evaluate => kepler_evaluate
      procedure :: exact => kepler_exact
   end type kepler_t

   !> Pendulum, theta'' = -sin theta, from its lowest point to the amplitude 2 asin k.
   !> Quadratures, if requested: w cos theta and -w sin theta, so that z = sin theta, cos theta - 1.
   type, extends(plain_t) :: pendulum_t
      real(wp) :: modulus = 0.0_wp  !! k [1]
   contains
      procedure :: evaluate => pendulum_evaluate
      procedure :: exact => pendulum_exact
   end type pendulum_t

   !> A position and a quadrature that both are t^p.
   type, extends(plain_t) :: power_t
      integer :: p = 0  !! the power
   contains
      procedure :: evaluate => power_evaluate
   end type power_t

   !> y' = 2.5 |t - root|^1.5 y: as velocities where a contact starts or ends.
   type, extends(plain_t) :: root_t
      real(wp) :: root = 0.0_wp  !! where it is [s]
   contains
      procedure :: evaluate => root_evaluate
      procedure :: exact => root_exact
   end type root_t

   !> y_k' = rate_k y_k; cannot be evaluated after a time.
   type, extends(plain_t) :: growth_t
      real(wp), allocatable :: rate(:)             !! (n) rates of growth [1/s]
      real(wp), allocatable :: scale(:)            !! (n) error scales [any]
      real(wp) :: last = huge(1.0_wp)              !! time after which it fails [s]
      integer :: failure = 0                       !! status of the failure
      integer :: n_call = 0                        !! evaluations
   contains
      procedure :: evaluate => growth_evaluate
      procedure :: weights => growth_weights
   end type growth_t

   !> Particles on a line, x'' = pull - stiffness x, each event function a wall for one of them.
   type, extends(ode_system_t) :: particles_t
      real(wp), allocatable :: pull(:)        !! (n_position) constant acceleration [m/s^2]
      real(wp), allocatable :: stiffness(:)   !! (n_position) of a spring to the origin, per mass [1/s^2]
      integer, allocatable :: subject(:)      !! (n_event) particle that meets the wall
      real(wp), allocatable :: wall(:)        !! (n_event) place of the wall [m]
      real(wp), allocatable :: side(:)        !! (n_event) 1: event as x rises above the wall, -1: as it falls below [1]
   contains
      procedure :: evaluate => particles_evaluate
      procedure :: weights => particles_weights
      procedure :: events => particles_events
   end type particles_t

contains

   !> Order observed from the errors of two steps, the second half the first.
   pure elemental function slope(coarse, fine)
      real(wp), intent(in) :: coarse  !! error with the greater step [any]
      real(wp), intent(in) :: fine    !! error with half of it [any]
      real(wp) :: slope               !! the order

      slope = log(coarse/fine)/log(2.0_wp)
   end function slope

   !> Advance to a time or to the first failure or event.
   subroutine run_to(method, system, t_end, status)
      class(integrator_t), intent(inout) :: method   !! the integrator, started
      class(ode_system_t), intent(inout) :: system   !! the system
      real(wp), intent(in) :: t_end                  !! time [s]
      integer, intent(out) :: status                 !! of the last step

      status = 0
      do while (method%t < t_end)
         call method%advance(system, t_end, status)
         if (status < 0 .or. status == advance_event) return
      end do
   end subroutine run_to

   subroutine plain_weights(self, y, scale)
      class(plain_t), intent(in) :: self    !! the system
      real(wp), intent(in) :: y(self%n)           !! (n) state [any]
      real(wp), intent(out) :: scale(self%n)      !! (n) scales [any]

      scale = 1.0_wp
   end subroutine plain_weights

   subroutine plain_events(self, t, y, g, rate)
      class(plain_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                !! time [s]
      real(wp), intent(in) :: y(:)             !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)            !! (n_event) none [any]
      real(wp), intent(out), contiguous :: rate(:)         !! (n_event) none [any]

      g = -1.0_wp
      rate = 0.0_wp
   end subroutine plain_events

   !> A planet.
   subroutine new_kepler(eccentricity, system, y)
      real(wp), intent(in) :: eccentricity   !! of the ellipse [1]
      type(kepler_t), intent(out) :: system  !! the system
      real(wp), intent(out) :: y(4)          !! (4) state at t = 0 [any]

      system%n = 4
      system%n_position = 2
      system%eccentricity = eccentricity
      y = system%exact(0.0_wp)
   end subroutine new_kepler

   subroutine kepler_evaluate(self, t, y, ydot, status)
      class(kepler_t), intent(inout) :: self         !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      ydot(1:2) = y(3:4)
      ydot(3:4) = -y(1:2)/norm2(y(1:2))**3
      status = 0
   end subroutine kepler_evaluate

   !> Place and velocity from Kepler's equation E - e sin E = t.
   pure function kepler_exact(self, t) result(y)
      class(kepler_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: t            !! time [s]
      real(wp) :: y(4)                     !! (4) state [any]

      real(wp) :: anomaly, c, e, s
      integer :: k

      e = self%eccentricity
      anomaly = t
      do k = 1, 30
         anomaly = anomaly - (anomaly - e*sin(anomaly) - t)/(1.0_wp - e*cos(anomaly))
      end do
      c = cos(anomaly)
      s = sin(anomaly)
      y(1:2) = [c - e, sqrt(1.0_wp - e*e)*s]
      y(3:4) = [-s, sqrt(1.0_wp - e*e)*c]/(1.0_wp - e*c)
   end function kepler_exact

   !> A pendulum, with or without its two quadratures.
   subroutine new_pendulum(modulus, with_quadratures, system, y)
      real(wp), intent(in) :: modulus                !! sine of half the amplitude [1]
      logical, intent(in) :: with_quadratures        !! whether the state has them
      type(pendulum_t), intent(out) :: system        !! the system
      real(wp), allocatable, intent(out) :: y(:)     !! (n) state at t = 0 [any]

      system%n_position = 1
      system%n_quadrature = merge(2, 0, with_quadratures)
      system%n = 2 + system%n_quadrature
      system%modulus = modulus
      y = system%exact(0.0_wp)
   end subroutine new_pendulum

   subroutine pendulum_evaluate(self, t, y, ydot, status)
      class(pendulum_t), intent(inout) :: self       !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      ydot(1) = y(2)
      ydot(2) = -sin(y(1))
      if (self%n_quadrature == 2) ydot(3:4) = [y(2)*cos(y(1)), -y(2)*sin(y(1))]
      status = 0
   end subroutine pendulum_evaluate

   !> sin(theta/2) = k sn(t, k), theta' = 2 k cn(t, k). Source: Abramowitz & Stegun (1964), 16.4, for sn and cn.
   pure function pendulum_exact(self, t) result(y)
      class(pendulum_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: t              !! time [s]
      real(wp) :: y(self%n)                  !! (n) state [any]

      integer, parameter :: n_mean = 8  ! arithmetic-geometric means; they converge quadratically
      real(wp) :: a(0:n_mean), b(0:n_mean), c(0:n_mean), phi
      integer :: k

      a(0) = 1.0_wp
      b(0) = sqrt(1.0_wp - self%modulus**2)
      c(0) = self%modulus
      do k = 1, n_mean
         a(k) = 0.5_wp*(a(k - 1) + b(k - 1))
         b(k) = sqrt(a(k - 1)*b(k - 1))
         c(k) = 0.5_wp*(a(k - 1) - b(k - 1))
      end do
      phi = 2.0_wp**n_mean*a(n_mean)*t
      do k = n_mean, 1, -1
         phi = 0.5_wp*(phi + asin(c(k)/a(k)*sin(phi)))
      end do
      y(1) = 2.0_wp*asin(self%modulus*sin(phi))
      y(2) = 2.0_wp*self%modulus*cos(phi)
      if (self%n_quadrature == 2) y(3:4) = [sin(y(1)), cos(y(1)) - 1.0_wp]
   end function pendulum_exact

   subroutine power_evaluate(self, t, y, ydot, status)
      class(power_t), intent(inout) :: self          !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      ydot(1) = y(2)
      ydot(2) = 0.0_wp
      if (self%p > 1) ydot(2) = real(self%p*(self%p - 1), wp)*t**(self%p - 2)
      ydot(3) = real(self%p, wp)*t**(self%p - 1)
      status = 0
   end subroutine power_evaluate

   subroutine growth_evaluate(self, t, y, ydot, status)
      class(growth_t), intent(inout) :: self         !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      self%n_call = self%n_call + 1
      ydot = self%rate*y
      status = merge(self%failure, 0, t > self%last)
   end subroutine growth_evaluate

   subroutine growth_weights(self, y, scale)
      class(growth_t), intent(in) :: self    !! the system
      real(wp), intent(in) :: y(self%n)           !! (n) state [any]
      real(wp), intent(out) :: scale(self%n)      !! (n) scales [any]

      scale = self%scale
   end subroutine growth_weights

   !> Particles and their walls.
   subroutine new_particles(pull, stiffness, subject, wall, side, system)
      real(wp), intent(in) :: pull(:)              !! (particles) constant acceleration [m/s^2]
      real(wp), intent(in) :: stiffness(:)         !! (particles) of a spring, per mass [1/s^2]
      integer, intent(in) :: subject(:)            !! (walls) particle that meets the wall
      real(wp), intent(in) :: wall(:)              !! (walls) place [m]
      real(wp), intent(in) :: side(:)              !! (walls) 1: event as x rises above the wall, -1: as it falls below [1]
      type(particles_t), intent(out) :: system     !! the system

      system%n_position = size(pull)
      system%n = 2*size(pull)
      system%n_event = size(wall)
      system%pull = pull
      system%stiffness = stiffness
      system%subject = subject
      system%wall = wall
      system%side = side
   end subroutine new_particles

   subroutine particles_evaluate(self, t, y, ydot, status)
      class(particles_t), intent(inout) :: self      !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      integer :: n

      n = self%n_position
      ydot(1:n) = y(n + 1:2*n)
      ydot(n + 1:2*n) = self%pull - self%stiffness*y(1:n)
      status = 0
   end subroutine particles_evaluate

   subroutine particles_weights(self, y, scale)
      class(particles_t), intent(in) :: self   !! the system
      real(wp), intent(in) :: y(self%n)             !! (n) state [any]
      real(wp), intent(out) :: scale(self%n)        !! (n) scales [any]

      scale = 1.0_wp
   end subroutine particles_weights

   subroutine particles_events(self, t, y, g, rate)
      class(particles_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(in) :: y(:)                !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)               !! (n_event) distance beyond the wall [m]
      real(wp), intent(out), contiguous :: rate(:)            !! (n_event) its rate [m/s]

      g = self%side*(y(self%subject) - self%wall)
      rate = self%side*y(self%n_position + self%subject)
   end subroutine particles_events

   !> y' = 2.5 |t - root|^1.5 y.
   subroutine root_evaluate(self, t, y, ydot, status)
      class(root_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t              !! time [s]
      real(wp), intent(in) :: y(self%n)      !! (1) state [1]
      real(wp), intent(out) :: ydot(self%n)  !! (1) its derivative [1/s]
      integer, intent(out) :: status         !! 0

      ydot = 2.5_wp*abs(t - self%root)**1.5_wp*y
      status = 0
   end subroutine root_evaluate

   !> The solution that is 1 at the root.
   pure real(wp) function root_exact(self, t) result(y)
      class(root_t), intent(in) :: self   !! the system
      real(wp), intent(in) :: t           !! time [s]

      y = exp(sign(abs(t - self%root)**2.5_wp, t - self%root))
   end function root_exact

end module ode_examples
