!> Equilibrium at rest: what is out of balance at a position, and how it changes with the position.
!>
!> $$ r = g(q) - \Phi_q^T \lambda = 0, \quad \Phi(q, 0) = 0 $$
!>
!> with velocities and accelerations zero and forces at t = 0. Clearance joints act by the elastic force of their
!> penetration. Where joints have lubricant films, which carry nothing without a speed, velocities are the minimum that the drivers
!> ask for. Positions are scaled, lengths by the size of the bodies, angles by a radian, so that
!> every entry of r and of the tangent stiffness K = -dr/dq (lambda held) is a moment.
!>
!> The equilibrium is stable if the symmetric part of N^T K N is positive definite, N the motions that the
!> rows leave free. Source: Flores et al. (2008), eq. (2.14) with v = a = 0; Nocedal and Wright, Numerical
!> Optimization (2006), section 12.5 (second-order conditions). Limits: dense; friction and damping give no
!> force at rest.
module static_problem
   use acting_forces, only: max_acting
   use inverse_dynamics, only: find_reactions
   use kinds, only: eps, i8, wp
   use lapack, only: dsyev, dsygv
   use mobility, only: split_space
   use mechanism, only: mechanism_t
   use prescribed_motion, only: newton_t, solve_rates
   use row_corrections, only: evaluate_rows, scaled_jacobian
   implicit none (type, external)
   private
   public :: balance_t, evaluate_balance, free_stiffness, is_balanced, is_nearly_balanced, load_scale, look_at, net_load
   public :: position_scale, square_frequencies, unbalanced_load

   real(wp), parameter :: difference = 1.0e-7_wp  !! step of the central differences, of the size or a radian [1]
   real(wp), parameter :: roundings = 10.0_wp     !! of the positions, that a residual is allowed [1]

   !> The balance at a position.
   type :: balance_t
      real(wp), allocatable :: load(:)        !! (n_v bodies) what is out of balance, r [N.m]
      real(wp), allocatable :: free(:, :)     !! (n_v bodies, freedoms) motions that the rows leave free, N [1]
      real(wp), allocatable :: stiffness(:)   !! (freedoms) eigenvalues of the free tangent stiffness, ascending [N.m]
      real(wp), allocatable :: tangent(:, :)  !! (freedoms, freedoms) free tangent stiffness, of films not symmetric, N^T K N [N.m]
      real(wp), allocatable :: modes(:, :)    !! (n_v bodies, freedoms) the motions that belong to them [1]
      real(wp) :: rounding = 0.0_wp           !! load that the rounding of the positions puts out of balance [N.m]
      real(wp) :: speed = 1.0_wp              !! of the drivers where there are films, over that of the deck [1]
      integer(i8) :: n_evaluations = 0_i8     !! evaluations of the loads so far
   end type balance_t

contains

   !> Scales of the coordinates: the size of the bodies for lengths, one for angles.
   pure function position_scale(system) result(scale)
      class(mechanism_t), intent(in) :: system   !! the system
      real(wp) :: scale(size(system%linkage%mass))   !! (n_v bodies) scales [m or rad]

      scale = system%linkage%coordinates%scales(system%linkage%scales%length, system%linkage%bodies%n)
   end function position_scale

   !> Rows and loads at rest at a position, contacts touching where they penetrate.
   subroutine look_at(system, q, speed, push)
      class(mechanism_t), intent(inout) :: system       !! the system; rows, loads, contacts are set
      real(wp), intent(in) :: q(:)                      !! (n_q bodies) positions [any]
      real(wp), intent(in), optional :: speed           !! of the drivers where there are films, over that of the deck [1]
      real(wp), intent(in), optional :: push(:)         !! (n_v bodies) velocities that come to those of the drivers [m/s or rad/s]

      type(newton_t) :: newton
      real(wp), dimension(size(system%linkage%mass)) :: rates, accelerations
      real(wp), dimension(system%clearance_joints%n_contact) :: delta, rate
      integer :: k, outcome

      rates = 0.0_wp
      if (system%clearance_joints%has_films) call solve_rates(system%linkage, 0.0_wp, newton, q, rates, accelerations, outcome)
      if (present(speed)) rates = speed*rates
      if (present(push)) rates = rates + push
      call evaluate_rows(system%linkage, 0.0_wp, q, rates)
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            call set%gaps(system%linkage%motion, delta, rate)
            call set%touch_where(delta)
         end associate
      end do
      call system%evaluate_loads(0.0_wp)
   end subroutine look_at

   !> Loads less reactions for given multipliers, after `look_at`.
   function unbalanced_load(system) result(load)
      class(mechanism_t), intent(in) :: system   !! the system, rows and loads evaluated, lambda set
      real(wp) :: load(size(system%linkage%mass))              !! (n_v bodies) what is out of balance, scaled [N.m]

      integer :: block, body, side

      load = reshape(system%loading%g(:, 1:), [size(load)])
      associate (rows => system%linkage%rows, n_v => system%linkage%coordinates%n_v)
         do block = 1, rows%n_block
            do side = 1, 2
               body = rows%body(side, block)
               if (body == 0) cycle
               associate (part => load(n_v*(body - 1) + 1:n_v*body))
                  part = part - rows%jac(n_v*(side - 1) + 1:n_v*side, block)*system%linkage%solution%lambda(rows%owner(block))
               end associate
            end do
         end do
      end associate
      load = load*position_scale(system)
   end function unbalanced_load

   !> Scale of a residual: the greater of the sum of the magnitudes of the forces that act on a body and the largest net load.
   real(wp) function load_scale(system)
      class(mechanism_t), intent(in) :: system   !! the system, rows and loads evaluated, lambda set

      load_scale = max(net_load(system), max_acting(system))
   end function load_scale

   !> What the rounding of the positions puts out of balance [N.m]: some roundings of the change of the load along each mode, times
   !> the greater of the size of the bodies and the distance from the origin of those that move in it. A body that nothing holds and
   !> that goes far away adds nothing.
   pure real(wp) function rounding_load(system, slope, modes)
      class(mechanism_t), intent(in) :: system   !! the system at a position
      real(wp), intent(in) :: slope(:, :)        !! (n_v bodies, freedoms) change of the load along each mode [N.m]
      real(wp), intent(in) :: modes(:, :)        !! (n_v bodies, freedoms) unit motions [1]

      real(wp) :: reach
      integer :: b, k

      rounding_load = 0.0_wp
      associate (n_v => system%linkage%coordinates%n_v, r => system%linkage%motion%r)
         do k = 1, size(modes, 2)
            reach = 1.0_wp
            do b = 1, system%linkage%bodies%n
               reach = max(reach, norm2(modes(n_v*(b - 1) + 1:n_v*b, k))*norm2(r(:, b))/system%linkage%scales%length)
            end do
            rounding_load = max(rounding_load, roundings*eps*norm2(slope(:, k))*reach)
         end do
      end associate
   end function rounding_load

   !> The largest of weights, present net loads and present net reactions.
   real(wp) function net_load(system)
      class(mechanism_t), intent(in) :: system   !! the system, rows and loads evaluated, lambda set

      real(wp) :: rest(size(system%linkage%mass)), loads(size(system%linkage%mass))

      rest = unbalanced_load(system)
      loads = reshape(system%loading%g(:, 1:), [size(loads)])*position_scale(system)
      net_load = max(norm2(system%loading%weight(:, 1:))*system%linkage%scales%length, norm2(loads), norm2(loads - rest))
   end function net_load

   !> The balance at a position, with the multipliers that fit it best. No stiffness yet.
   subroutine evaluate_balance(system, q, balance)
      class(mechanism_t), intent(inout) :: system  !! the system; all is set, lambda too
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) positions [any]
      type(balance_t), intent(inout) :: balance        !! the load out of balance is set

      real(wp) :: rest(size(system%linkage%mass)), unbalanced

      rest = 0.0_wp
      call look_at(system, q, balance%speed)
      balance%n_evaluations = balance%n_evaluations + 1_i8
      call find_reactions(system%linkage, system%loading%g, rest, unbalanced)
      balance%load = unbalanced_load(system)
   end subroutine evaluate_balance

   !> Free motions and the tangent stiffness against them, by central differences of r with lambda held.
   subroutine free_stiffness(system, q, balance)
      class(mechanism_t), intent(inout) :: system  !! the system, balance evaluated at the positions
      real(wp), intent(in) :: q(:)                     !! (n_q bodies) positions [any]
      type(balance_t), intent(inout) :: balance        !! free motions, stiffness and modes are set

      real(wp), allocatable :: jac(:, :), k_free(:, :), left(:, :), slope(:, :), work(:)
      real(wp), dimension(size(system%linkage%mass)) :: above, scale
      real(wp) :: q_near(size(q))
      integer :: info, k, n, rank

      call scaled_jacobian(system%linkage, jac)
      call split_space(jac, rank, left, balance%free)
      n = size(balance%free, 2)
      scale = position_scale(system)
      allocate (slope(size(scale), n), work(max(1, 64*n)), source=0.0_wp)
      associate (coordinates => system%linkage%coordinates, n_body => system%linkage%bodies%n)
      do k = 1, n
         q_near = q
         call coordinates%add_change(n_body, difference*scale*balance%free(:, k), q_near)
         call look_at(system, q_near, balance%speed)
         above = unbalanced_load(system)
         q_near = q
         call coordinates%add_change(n_body, -difference*scale*balance%free(:, k), q_near)
         call look_at(system, q_near, balance%speed)
         slope(:, k) = (unbalanced_load(system) - above)/(2.0_wp*difference)
      end do
      end associate
      call look_at(system, q, balance%speed)
      balance%n_evaluations = balance%n_evaluations + int(2*n + 1, i8)
      k_free = matmul(transpose(balance%free), slope)
      balance%tangent = k_free
      k_free = 0.5_wp*(k_free + transpose(k_free))
      if (allocated(balance%stiffness)) deallocate (balance%stiffness)
      allocate (balance%stiffness(n), source=0.0_wp)
      if (n > 0) call dsyev("V", "U", n, k_free, n, balance%stiffness, work, size(work), info)
      balance%modes = matmul(balance%free, k_free)
      balance%rounding = rounding_load(system, matmul(slope, k_free), balance%modes)
   end subroutine free_stiffness

   !> Whether the residual is within a part of the forces that act, and what the rounding of the positions puts out of balance.
   logical function is_balanced(system, balance, part)
      class(mechanism_t), intent(in) :: system   !! the system, balance evaluated
      type(balance_t), intent(in) :: balance     !! with its stiffness
      real(wp), intent(in) :: part               !! residual allowed, of the forces that act [1]

      is_balanced = norm2(balance%load) <= part*load_scale(system) + balance%rounding
   end function is_balanced

   !> Whether an equilibrium is near enough for Newton's iteration. By the net loads, where they do not vanish with the residual:
   !> beside an unstable equilibrium the forces that act are too lax a measure.
   logical function is_nearly_balanced(system, balance, part)
      class(mechanism_t), intent(in) :: system   !! the system, balance evaluated
      type(balance_t), intent(in) :: balance     !! with its stiffness
      real(wp), intent(in) :: part               !! residual allowed, of the net loads; its square of the forces that act [1]

      is_nearly_balanced = norm2(balance%load) <= part*net_load(system) .or. is_balanced(system, balance, part**2)
   end function is_nearly_balanced

   !> Squares of the natural frequencies without damping, ascending; negative where a push grows.
   !>
   !> K w = omega^2 N^T M N w, K diagonal in the modes.
   function square_frequencies(system, balance) result(square)
      class(mechanism_t), intent(in) :: system      !! the system, for the masses
      type(balance_t), intent(in) :: balance            !! with stiffness and modes
      real(wp) :: square(size(balance%stiffness))       !! (freedoms) squares [1/s^2]

      real(wp), allocatable :: k_free(:, :), m_free(:, :), mass(:), work(:)
      integer :: info, k, n

      n = size(square)
      square = 0.0_wp
      if (n == 0) return
      mass = position_scale(system)**2*reshape(system%linkage%mass, [size(system%linkage%mass)])
      allocate (k_free(n, n), work(64*n), source=0.0_wp)
      do k = 1, n
         k_free(k, k) = balance%stiffness(k)
      end do
      m_free = matmul(transpose(balance%modes), spread(mass, 2, n)*balance%modes)
      call dsygv(1, "N", "U", n, k_free, n, m_free, n, square, work, size(work), info)
   end function square_frequencies

end module static_problem
