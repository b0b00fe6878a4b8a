!> A planar scene as a system of ordinary differential equations with events.
!>
!> y = ( q, v, z ): coordinates (x, y, angle) of each body whose motion is unknown, their rates, and the
!> quadratures of the energy ledger. Accelerations come from the augmented equations with Baumgarte's stabilisation,
!> b = gamma - 2 alpha Phi' - beta^2 Phi,  Phi' = Phi_q v + Phi_t,  less Phi_q a of the bodies whose motion is known.
!>
!> Ledger: z = ( drive work, load work, stabilisation work, lost in dampers; per contact: lost by damping, lost by
!> friction ), with the powers lambda^T Phi_t, f . v, -lambda^T Phi', c l'^2, (F_N - F_elastic) delta', F_T |v_T|.
!>
!> Events: one function per contact of a loose joint, the penetration while free, its negative while touching.
!>
!> Source: Flores et al. (2008), eqs. (2.15), (2.23), (2.24).
module planar_system
   use augmented, only: augmented_t
   use bodies, only: bodies_t
   use clearance_set, only: clearance_slot_t
   use dae_system, only: dae_system_t
   use force_set, only: force_slot_t
   use hold, only: hold_t
   use joint_set, only: joint_slot_t, rows_t
   use kinds, only: i8, wp
   use known_motion, only: find_multipliers, known_t, move_known, power_of_known
   use motion, only: loads_t, motion_t, set_some_acceleration, set_some_motion
   use planar_kernels, only: planar_loads, right_hand_side, start_loads, state_rates, take_known
   implicit none (type, external)
   private
   public :: planar_system_t
   public :: lost_damper, n_ledger, work_drive, work_load, work_stabilisation

   integer, parameter :: work_drive = 1          !! quadrature: work of the drivers
   integer, parameter :: work_load = 2           !! quadrature: work of applied loads
   integer, parameter :: work_stabilisation = 3  !! quadrature: work of constraint forces on the drift
   integer, parameter :: lost_damper = 4         !! quadrature: lost in dampers
   integer, parameter :: n_ledger = 4            !! quadratures before those of the contacts

   real(wp), parameter :: damping(2) = [1.0e-9_wp, 1.0e-5_wp]  !! (2) of rows nearly, or always, dependent; round-off over it
                                                               !! shows in reactions that are not unique [1]
   integer, parameter :: n_refinement(2) = [3, 30]   !! refinements of these solutions, at most
   real(wp), parameter :: contradiction = 1.0e-2_wp  !! residual of rows always dependent that is an error [1]

   !> A planar scene.
   type, extends(dae_system_t) :: planar_system_t
      integer :: n_body = 0                              !! number of bodies
      type(bodies_t) :: bodies                           !! the bodies
      logical, allocatable :: is_known(:)                !! (bodies) whether the motion of a body is a known function of time
      type(known_t) :: known                             !! those of them whose motion is a known function of time
      real(wp), allocatable :: mass(:, :)                !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), allocatable :: inverse_mass(:, :)        !! (3, 0:bodies) the same inverted, 0 if known [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), allocatable :: weight(:, :)              !! (3, 0:bodies) force of gravity [N]
      real(wp) :: gravity(3) = 0.0_wp                    !! (3) acceleration of free fall [m/s^2]
      real(wp) :: length_scale = 1.0_wp                  !! size of the bodies, for error scales [m]
      real(wp) :: alpha = 0.0_wp                         !! Baumgarte's gain on the rate of violation [1/s]
      real(wp) :: beta = 0.0_wp                          !! Baumgarte's gain on the violation [1/s]
      logical :: with_ledger = .true.                    !! whether the ledger is kept
      logical :: with_energies = .true.                  !! whether energies are reported, with or without a ledger
      type(joint_slot_t), allocatable :: joints(:)       !! ideal joints and drivers, one set per kind
      integer :: n_solved_set = 0                        !! sets of them with rows that are solved for, the first ones
      type(joint_slot_t), allocatable :: ideal(:)        !! joints with clearance taken as ideal, one set per kind
      type(force_slot_t), allocatable :: forces(:)       !! force elements, one set per kind
      type(clearance_slot_t), allocatable :: clearances(:)  !! loose joints, one set per combination of laws
      integer :: n_loose = 0                             !! loose joints in all
      integer :: n_contact = 0                           !! contacts of all loose joints
      class(augmented_t), allocatable :: solver          !! way of solving the augmented equations
      class(hold_t), allocatable :: way                  !! way of holding the constraints
      logical :: is_redundant = .false.                  !! whether rows depend on one another from the start
      integer(i8) :: n_evaluations = 0                   !! evaluations made
      integer(i8) :: n_damped = 0                        !! those of them in which rows were dependent, or nearly so
      ! the last evaluation
      type(motion_t) :: motion                           !! positions and velocities
      type(loads_t) :: loads                             !! applied and contact loads
      type(rows_t) :: rows                               !! constraint rows
      real(wp), allocatable :: phi_dot(:)                !! (rows) rate of the violation [m/s or rad/s]
      real(wp), allocatable :: b(:)                      !! (rows) right-hand side of accelerations [m/s^2 or rad/s^2]
      real(wp), allocatable :: g(:, :)                   !! (3, 0:bodies) loads on the coordinates [N, N, N.m]
      real(wp), allocatable :: a(:, :)                   !! (3, 0:bodies) accelerations [m/s^2, m/s^2, rad/s^2]
      real(wp), allocatable :: held(:)                   !! (2 positions) state corrected for an evaluation [any]
      real(wp), allocatable :: row_weight(:)             !! (rows) one over the size of the bodies, or one for angles [1/m or 1/rad]
      real(wp), allocatable :: rest(:, :)                !! (3, 0:bodies) scratch of `find_reactions` [N, N, N.m]
      real(wp), allocatable :: losses(:, :)              !! (2, contacts) power lost by contact and friction [W]
      real(wp) :: load_power = 0.0_wp                    !! power of applied loads [W]
      integer :: bad_row = 0                             !! row at which the last evaluation was singular, 0: none
   contains
      procedure :: evaluate => planar_evaluate
      procedure :: dae_residual => planar_dae_residual
      procedure, private :: evaluate_terms
      procedure, private :: ledger_rates
      procedure :: weights => planar_weights
      procedure :: events => planar_events
      procedure :: last_events => planar_last_events
      procedure :: set_step => planar_set_step
      procedure :: hold => planar_hold
      procedure :: solve_rows => planar_solve_rows
      procedure :: evaluate_rows => planar_evaluate_rows
      procedure :: set_motion => planar_set_motion
      procedure :: find_reactions => planar_find_reactions
      procedure :: set_acceleration => planar_set_acceleration
      procedure :: set_state => planar_set_state
      procedure :: row_name => planar_row_name
      procedure :: find_contact => planar_find_contact
      procedure :: memory_size => planar_memory_size
      procedure :: save => planar_save
      procedure :: load => planar_load
   end type planar_system_t

   interface
      !> Correct a state at the end of a step; what that does to the energy is work of the stabilisation.
      module subroutine planar_hold(self, t, y, status)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                      !! time [s]
         real(wp), intent(inout) :: y(:)                !! (n) state [any]
         integer, intent(out) :: status                 !! 0: done
      end subroutine planar_hold

      !> Numbers that a checkpoint needs: the memory of all sets and the counters.
      module integer function planar_memory_size(self) result(n)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self     !! the system
      end function planar_memory_size

      !> Write what the system remembers.
      module subroutine planar_save(self, row, place)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self     !! the system
         real(wp), intent(inout) :: row(:)              !! (any) checkpoint [any]
         integer, intent(inout) :: place                !! last place used
      end subroutine planar_save

      !> Read what the system remembers.
      module subroutine planar_load(self, row, place)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: row(:)                 !! (any) checkpoint [any]
         integer, intent(inout) :: place                !! last place used
      end subroutine planar_load

      !> What is left of the equations in the stabilised form of index 2.
      module subroutine planar_dae_residual(self, t, y, ydot, lambda, mu, r_y, r_lambda, r_mu, status)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                      !! time [s]
         real(wp), intent(in), contiguous :: y(:)       !! (n) state [any]
         real(wp), intent(in), contiguous :: ydot(:)    !! (n) its derivative [any]
         real(wp), intent(in) :: lambda(:)              !! (rows) multipliers of the velocities [N or N.m]
         real(wp), intent(in) :: mu(:)                  !! (rows) multipliers of the positions [N.s or N.m.s]
         real(wp), intent(out), contiguous :: r_y(:)    !! (n) of the differential equations [any]
         real(wp), intent(out) :: r_lambda(:)           !! (rows) rates of the violation [m/s or rad/s]
         real(wp), intent(out) :: r_mu(:)               !! (rows) violations [m or rad]
         integer, intent(out) :: status                 !! outcome
      end subroutine planar_dae_residual
   end interface

contains

   !> Right-hand side. Status 1: singular or not a number, try a smaller step.
   subroutine planar_evaluate(self, t, y, ydot, status)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in), contiguous :: y(:)       !! (n) state [any]
      real(wp), intent(out), contiguous :: ydot(:)   !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      self%n_evaluations = self%n_evaluations + 1
      if (self%way%at_stages) then
         call correct_stage(self, t, y, status)
         if (status /= 0) return
         call planar_set_motion(self, t, self%held)
      else
         call planar_set_motion(self, t, y)
      end if
      call evaluate_terms(self, t, status)
      if (status /= 0) return
      call find_accelerations(self, self%g, .true., status)
      if (status /= 0) return
      call state_rates(self%rows%n_unknown, self%rows%unknown, self%n_body, self%motion%v, self%motion%omega, self%a, ydot, status)
      if (.not. self%with_ledger) return
      call self%ledger_rates(ydot(2*self%n_position + 1:))
   end subroutine planar_evaluate

   !> Correct the coordinates and rates that an evaluation begins with, into `held`.
   subroutine correct_stage(self, t, y, status)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in), contiguous :: y(:)       !! (n) state [any]
      integer, intent(out) :: status                 !! outcome

      class(hold_t), allocatable :: way

      self%held = y(:2*self%n_position)
      call move_alloc(self%way, way)  ! the system that it corrects must not hold it too
      call way%correct_stage(self, t, self%held, status)
      call move_alloc(way, self%way)
   end subroutine correct_stage

   !> The length of the step that begins, for gains that follow it.
   subroutine planar_set_step(self, h)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: h                      !! length of the step [s]

      class(hold_t), allocatable :: way

      call move_alloc(self%way, way)
      call way%begin_step(self, h)
      call move_alloc(way, self%way)
   end subroutine planar_set_step

   !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
   subroutine evaluate_terms(self, t, status)
      class(planar_system_t), intent(inout) :: self  !! the system, its motion set
      real(wp), intent(in) :: t                      !! time [s]
      integer, intent(out) :: status                 !! outcome

      integer :: k

      self%bad_row = 0
      status = merge(0, 1, self%known%is_finite)
      if (status /= 0) return
      call start_loads(self%n_body, self%weight, self%loads%force, self%loads%moment)
      self%load_power = 0.0_wp
      do k = 1, size(self%forces)
         call self%forces(k)%set%evaluate(t, self%motion, self%loads, self%load_power)
      end do
      do k = 1, size(self%clearances)
         call self%clearances(k)%set%evaluate(self%motion, self%loads, self%losses)
      end do
      call planar_evaluate_rows(self, t)
      call planar_loads(self%n_body, self%loads%force, self%loads%moment, self%g)
   end subroutine evaluate_terms

   !> Solved rows, rates of their violations and right-hand sides at the present motion.
   subroutine planar_evaluate_rows(self, t)
      class(planar_system_t), intent(inout) :: self  !! the system, its motion set
      real(wp), intent(in) :: t                      !! time [s]

      integer :: k

      do k = 1, self%n_solved_set
         call self%joints(k)%set%evaluate(t, self%motion, self%rows)
      end do
      do k = 1, size(self%ideal)
         call self%ideal(k)%set%evaluate(t, self%motion, self%rows)
      end do
      associate (rows => self%rows, motion => self%motion)
         call right_hand_side(self%n_body, rows%n, rows%n_solve, rows%body, rows%phi, rows%phi_t, rows%jac, rows%gam, motion%v, &
                              motion%omega, self%alpha, self%beta, self%phi_dot, self%b)
         if (rows%n_known > 0) call take_known(self%n_body, rows%n, rows%n_known, rows%known, rows%jac, motion%a, &
                                               motion%alpha, self%b)
      end associate
   end subroutine planar_evaluate_rows

   !> Least change of coordinates or rates in the metric of the masses, into `a`: Phi_q a = b for the b that is set.
   subroutine planar_solve_rows(self, status)
      class(planar_system_t), intent(inout) :: self  !! the system, rows evaluated, b set
      integer, intent(out) :: status                 !! 0: found

      self%rest = 0.0_wp
      call find_accelerations(self, self%rest, .false., status)
   end subroutine planar_solve_rows

   !> Accelerations and multipliers. Where rows depend on one another, or nearly so, the damped solution: it stays finite, and
   !> the control of the step decides what is good enough. Status 1 if rows that always depend on others contradict them.
   subroutine find_accelerations(self, g, must_agree, status)
      class(planar_system_t), intent(inout) :: self  !! the system, rows evaluated
      real(wp), intent(in), contiguous :: g(:, 0:)   !! (3, 0:bodies) loads [N, N, N.m]
      logical, intent(in) :: must_agree              !! whether a contradiction counts: that of a correction is round-off
      integer, intent(out) :: status                 !! 0: found

      integer :: k

      self%bad_row = 1
      status = 0
      if (.not. self%is_redundant) then
         call self%solver%solve(self%inverse_mass, self%rows, g, self%b, self%a, self%lambda, self%bad_row)
      end if
      if (self%bad_row == 0) return
      self%n_damped = self%n_damped + 1
      k = merge(2, 1, self%is_redundant)
      call self%solver%solve_damped(self%inverse_mass, self%rows, g, self%b, damping(k), n_refinement(k), self%a, &
                                    self%lambda, self%bad_row)
      if (self%bad_row == 0 .and. must_agree .and. (self%is_redundant .or. self%solver%is_iterative)) then
         if (.not. self%solver%left_over <= contradiction) then
            self%bad_row = maxloc(abs(self%solver%residual(:self%rows%n_solve)), dim=1)
         end if
      end if
      if (self%bad_row > 0) status = 1
   end subroutine find_accelerations

   !> Multipliers of the rows that fix the known bodies, at the state evaluated last. Reports want them.
   subroutine planar_find_reactions(self, t)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]

      integer :: body, k

      do k = self%n_solved_set + 1, size(self%joints)
         call self%joints(k)%set%evaluate(t, self%motion, self%rows)
      end do
      do k = 1, self%known%n
         body = self%known%body(k)
         self%a(:, body) = [self%motion%a(1, body), self%motion%a(2, body), self%motion%alpha(3, body)]
      end do
      call find_multipliers(self%known, self%rows, self%mass, self%g, self%a, self%rest, self%lambda)
   end subroutine planar_find_reactions

   !> Powers of the ledger.
   pure subroutine ledger_rates(self, power)
      class(planar_system_t), intent(in) :: self  !! the system
      real(wp), intent(out) :: power(:)           !! (quadratures) powers [W]

      integer :: k

      power(work_drive) = 0.0_wp
      power(work_stabilisation) = 0.0_wp
      if (self%known%n > 0) then
         power(work_drive) = power_of_known(self%known%n, self%known%body, self%rows%n_known, self%rows%known, self%n_body, &
                                            self%rows%n, self%mass, self%g, self%rows%jac, self%lambda, self%motion%v, &
                                            self%motion%omega, self%motion%a, self%motion%alpha)
      end if
      do k = 1, self%rows%n_solve
         power(work_drive) = power(work_drive) + self%lambda(k)*self%rows%phi_t(k)
         power(work_stabilisation) = power(work_stabilisation) - self%lambda(k)*self%phi_dot(k)
      end do
      power(work_load) = self%load_power
      power(lost_damper) = 0.0_wp
      do k = 1, size(self%forces)
         power(lost_damper) = power(lost_damper) + self%forces(k)%set%lost_power(self%motion)
      end do
      do k = 1, self%n_contact
         power(n_ledger + 2*k - 1) = self%losses(1, k)
         power(n_ledger + 2*k) = self%losses(2, k)
      end do
   end subroutine ledger_rates

   !> Error scales: lengths over the size of the bodies, angles over one radian, rates over the
   !> greatest present rate of the mechanism, at least one per second. Angles are not scaled by
   !> their value, so that the error does not grow as a crank counts turns.
   subroutine planar_weights(self, y, scale)
      class(planar_system_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: y(:)                !! (n) state [any]
      real(wp), intent(out) :: scale(:)           !! (n) scales [any]

      real(wp) :: rate
      integer :: body, k, nq

      nq = self%n_position
      rate = 1.0_wp
      do k = nq + 1, 2*nq, 3
         rate = max(rate, abs(y(k))/self%length_scale, abs(y(k + 1))/self%length_scale, abs(y(k + 2)))
      end do
      do k = 1, self%known%n
         body = self%known%body(k)
         rate = max(rate, maxval(abs(self%motion%v(1:2, body)))/self%length_scale, abs(self%motion%omega(3, body)))
      end do
      do k = 1, nq, 3
         scale(k) = self%length_scale
         scale(k + 1) = self%length_scale
         scale(k + 2) = 1.0_wp
         scale(nq + k) = self%length_scale*rate
         scale(nq + k + 1) = self%length_scale*rate
         scale(nq + k + 2) = rate
      end do
   end subroutine planar_weights

   !> Event functions: penetrations of free contacts, their negatives of touching ones.
   subroutine planar_events(self, t, y, g, rate)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(:)                   !! (n) state [any]
      real(wp), intent(out) :: g(:)                  !! (n_event) event functions [m]
      real(wp), intent(out) :: rate(:)               !! (n_event) their rates [m/s]

      call self%set_motion(t, y)
      call self%last_events(t, y, g, rate)
   end subroutine planar_events

   !> The same at the present motion.
   subroutine planar_last_events(self, t, y, g, rate)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time of the last evaluation [s]
      real(wp), intent(in) :: y(:)                   !! (n) its state [any]
      real(wp), intent(out) :: g(:)                  !! (n_event) event functions [m]
      real(wp), intent(out) :: rate(:)               !! (n_event) their rates [m/s]

      integer :: first, i, k

      do k = 1, size(self%clearances)
         associate (set => self%clearances(k)%set)
            call set%gaps(self%motion, g, rate)
            if (set%n_touching == 0) cycle
            first = set%first_contact
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               g(first + i) = -g(first + i)
               rate(first + i) = -rate(first + i)
            end do
         end associate
      end do
   end subroutine planar_last_events

   !> Motion of all bodies at a state.
   subroutine planar_set_motion(self, t, y)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in), contiguous :: y(:)       !! (n) state [any]

      if (self%known%n > 0) call move_known(self%known, self%joints, t, self%motion)
      call set_some_motion(self%rows%n_unknown, self%rows%unknown, y, y(self%n_position + 1:2*self%n_position), self%motion)
   end subroutine planar_set_motion

   !> Motion of all bodies, with accelerations, from a state and its derivative.
   subroutine planar_set_state(self, t, y, ydot)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in), contiguous :: y(:)       !! (n) state [any]
      real(wp), intent(in), contiguous :: ydot(:)    !! (n) its derivative [any]

      call self%set_motion(t, y)
      call self%set_acceleration(ydot)
   end subroutine planar_set_state

   !> Accelerations of the unknown bodies from the derivative of a state.
   subroutine planar_set_acceleration(self, ydot)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in), contiguous :: ydot(:)    !! (n) derivative of the state [any]

      call set_some_acceleration(self%rows%n_unknown, self%rows%unknown, ydot(self%n_position + 1:2*self%n_position), self%motion)
   end subroutine planar_set_acceleration

   !> Set of a contact and its place there by its number.
   subroutine planar_find_contact(self, number, slot, contact)
      class(planar_system_t), intent(in) :: self  !! the system
      integer, intent(in) :: number               !! contact, in the order of the sets
      integer, intent(out) :: slot                !! its set
      integer, intent(out) :: contact             !! its number in the set

      do slot = 1, size(self%clearances)
         contact = number - self%clearances(slot)%set%first_contact
         if (contact <= self%clearances(slot)%set%n_contact) return
      end do
   end subroutine planar_find_contact

   !> Name of the joint or driver that a constraint row belongs to.
   function planar_row_name(self, row) result(name)
      class(planar_system_t), intent(in) :: self   !! the system
      integer, intent(in) :: row                   !! number of the row
      character(:), allocatable :: name            !! the joint's name

      integer :: k

      name = "?"
      do k = 1, size(self%joints)
         call look(self%joints(k))
      end do
      do k = 1, size(self%ideal)
         call look(self%ideal(k))
      end do

   contains

      !> Look in one set.
      subroutine look(slot)
         type(joint_slot_t), intent(in) :: slot  !! the set

         integer :: item

         associate (set => slot%set)
            if (row <= set%first_row .or. row > set%first_row + set%n*set%n_row_item) return
            item = (row - set%first_row - 1)/set%n_row_item + 1
            name = set%names(item)%s
         end associate
      end subroutine look

   end function planar_row_name

end module planar_system
