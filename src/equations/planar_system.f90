!> A planar scene as a system of ordinary differential equations with events.
!>
!> y = ( q, v, z ): coordinates (x, y, angle) of each body whose motion is unknown, then one of each guided body; their rates;
!> and the quadratures of the energy ledger. Accelerations come from the augmented equations with Baumgarte's stabilisation,
!> b = gamma - 2 alpha Phi' - beta^2 Phi,  Phi' = Phi_q v + Phi_t,  less Phi_q a of the bodies whose motion is known.
!>
!> Ledger: z = ( drive work, load work, stabilisation work, lost in dampers; per contact: lost by damping, lost by
!> friction ), with the powers lambda^T Phi_t, f . v, -lambda^T Phi', c l'^2, (F_N - F_elastic) delta', F_T |v_T|.
!>
!> Events: one function per contact of a loose joint, the penetration while free, its negative while touching; with friction
!> that sticks, another one per contact (`planar_friction`). Contacts with bristles have a state each, after the rates.
!>
!> Source: Flores et al. (2008), eqs. (2.15), (2.23), (2.24).
module planar_system
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use augmented, only: augmented_t
   use bodies, only: bodies_t
   use clearance_set, only: clearance_slot_t
   use dae_system, only: dae_system_t
   use force_set, only: force_slot_t
   use guided_motion, only: guided_rates, guided_t, move_guided, set_guided_acceleration
   use hold, only: hold_t
   use joint_set, only: joint_slot_t, rows_t
   use kinds, only: i8, wp
   use known_motion, only: known_t, move_known
   use motion, only: loads_t, motion_t, set_some_acceleration, set_some_motion
   use grip_forces, only: grip_forces_t
   use planar_kernels, only: planar_loads, right_hand_side, start_loads, state_rates, take_known
   use smooth_piece, only: smooth_piece_t
   implicit none (type, external)
   private
   public :: planar_system_t
   public :: lost_damper, n_ledger, work_drive, work_load, work_stabilisation

   integer, parameter :: work_drive = 1          !! quadrature: work of the drivers
   integer, parameter :: work_load = 2           !! quadrature: work of applied loads
   integer, parameter :: work_stabilisation = 3  !! quadrature: work of constraint forces on the drift
   integer, parameter :: lost_damper = 4         !! quadrature: lost in dampers
   integer, parameter :: n_ledger = 4            !! quadratures before those of the contacts

   !> A planar scene.
   type, extends(dae_system_t) :: planar_system_t
      integer :: n_body = 0                              !! number of bodies
      type(bodies_t) :: bodies                           !! the bodies
      logical, allocatable :: is_known(:)                !! (bodies) whether the motion of a body is a known function of time
      type(known_t) :: known                             !! those of them whose motion is a known function of time
      type(guided_t) :: guided                           !! bodies with one coordinate only
      integer, allocatable :: carried(:, :)              !! (3, sides) sides that are known bodies, of rows whose multipliers
                                                         !! are found without them: row, place in the Jacobian, body
      integer, allocatable :: driven(:)                  !! (bodies) known bodies, and those guided by them
      real(wp), allocatable :: mass(:, :)                !! (3, bodies) masses [kg, kg, kg.m^2]
      real(wp), allocatable :: inverse_mass(:, :)        !! (3, 0:bodies) the same inverted, 0 if known [1/kg, 1/kg, 1/(kg.m^2)]
      real(wp), allocatable :: weight(:, :)              !! (3, 0:bodies) force of gravity [N]
      real(wp) :: gravity(3) = 0.0_wp                    !! (3) acceleration of free fall [m/s^2]
      real(wp) :: length_scale = 1.0_wp                  !! size of the bodies, for error scales [m]
      real(wp) :: tolerance = 1.0e-8_wp                  !! of the integrator, for what round-off allows [1]
      real(wp) :: pace = 1.0_wp                          !! greatest rate of the mechanism so far, see `planar_scales` [1/s]
      real(wp) :: late_rate = 0.01_wp                    !! rate that errors are measured by at least [1/s]
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
      type(smooth_piece_t) :: piece                      !! where functions of time are evaluated
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
      integer :: first_turn = 0                          !! event functions before those of turns; 0: no law jumps at a turn
      type(grip_forces_t) :: grips                       !! contacts whose friction remembers
      integer :: bad_row = 0                             !! row at which the last evaluation was singular, 0: none
   contains
      procedure :: evaluate => planar_evaluate, dae_residual => planar_dae_residual
      procedure :: dae_pattern => planar_dae_pattern, dae_spread => planar_dae_spread, weights => planar_weights
      procedure, private :: evaluate_terms, find_accelerations, ledger_rates
      procedure :: begin_pace => planar_begin_pace, follow_pace => planar_follow_pace, time_of_difference
      procedure :: events => planar_events, last_events => planar_last_events
      procedure :: event_noise => planar_event_noise, set_step => planar_set_step
      procedure :: hold => planar_hold, mend => planar_mend
      procedure :: solve_rows => planar_solve_rows, evaluate_rows => planar_evaluate_rows
      procedure :: set_motion => planar_set_motion, find_reactions => planar_find_reactions
      procedure :: set_acceleration => planar_set_acceleration, set_state => planar_set_state
      procedure :: row_name => planar_row_name, find_contact => planar_find_contact, is_onset => planar_is_onset
      procedure :: take_bristles => planar_take_bristles, bristle_rates => planar_bristle_rates
      procedure :: stick => planar_stick, decide_slip => planar_decide_slip, bristle_weights => planar_bristle_weights
      procedure :: friction_events => planar_friction_events, turns => planar_turns
      procedure :: memory_size => planar_memory_size, save => planar_save, load => planar_load
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

      !> Bring a state that was made by interpolation onto the constraints, by projection.
      module subroutine planar_mend(self, t, y, status)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                      !! time [s]
         real(wp), intent(inout) :: y(:)                !! (n) state [any]
         integer, intent(out) :: status                 !! 0: done
      end subroutine planar_mend

      !> Whether event k, as things stand, is the onset of a contact.
      module logical function planar_is_onset(self, k) result(is_onset)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self     !! the system
         integer, intent(in) :: k                       !! number of the event function
      end function planar_is_onset

      !> Forces of the contacts that stick, and the accelerations with them.
      module subroutine planar_stick(self, status)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system, accelerations without these forces found
         integer, intent(out) :: status                 !! 0: found
      end subroutine planar_stick

      !> Deflections of bristles from a state into the contacts.
      module subroutine planar_take_bristles(self, y)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(:)                   !! (n) state [any]
      end subroutine planar_take_bristles

      !> Rates of these deflections, as of the last evaluation.
      module subroutine planar_bristle_rates(self, ydot)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self     !! the system
         real(wp), intent(inout) :: ydot(:)             !! (n) derivative of the state [any]
      end subroutine planar_bristle_rates

      !> Their scales, for error norms.
      module subroutine planar_bristle_weights(self, scale)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self     !! the system
         real(wp), intent(inout) :: scale(:)            !! (n) scales [any]
      end subroutine planar_bristle_weights

      !> Event functions of friction: slip that ends, and sticking that gives way. Evaluates the system at the state.
      module subroutine planar_friction_events(self, t, y, g, rate)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)                !! time [s] and (n) state [any]
         real(wp), intent(inout) :: g(:), rate(:)       !! (n_event) functions and rates, those of friction set [any]
      end subroutine planar_friction_events

      !> Rates of all penetrations and their rates, by a difference along the motion. The system is evaluated at the state.
      module subroutine planar_turns(self, t, y, rate, acceleration)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)                !! time [s] and (n) state [any]
         real(wp), intent(out) :: rate(:), acceleration(:)  !! (n_contact) rates of the penetrations, and theirs [any]
      end subroutine planar_turns

      !> Decide whether a contact slips, which way, or sticks, at a state.
      module subroutine planar_decide_slip(self, t, y, slot, k)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)                !! time [s] and (n) state [any]
         integer, intent(in) :: slot, k                 !! set of the contact, and its number there
      end subroutine planar_decide_slip

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
         real(wp), intent(in), contiguous :: y(:), ydot(:)  !! (n) state and its derivative [any]
         real(wp), intent(in) :: lambda(:), mu(:)       !! (rows) multipliers of velocities and of positions [any]
         real(wp), intent(out), contiguous :: r_y(:)    !! (n) of the differential equations [any]
         real(wp), intent(out) :: r_lambda(:), r_mu(:)  !! (rows) rates of the violation, and violations [any]
         integer, intent(out) :: status                 !! outcome
      end subroutine planar_dae_residual

      !> Which parts of the residual depend on which unknowns.
      module subroutine planar_dae_pattern(self, column, row)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self        !! the system
         integer, allocatable, intent(out) :: column(:)    !! (n + 2 rows + 1) place of the first entry of each column, from 0
         integer, allocatable, intent(out) :: row(:)       !! (entries) rows, from 0
      end subroutine planar_dae_pattern

      !> Entries of the columns of the multipliers.
      module subroutine planar_dae_spread(self, values)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self   !! the system
         real(wp), intent(out) :: values(:)           !! (3 for each side of an unknown body) in the order of the pattern [any]
      end subroutine planar_dae_spread

      !> Accelerations and multipliers of the rows, as they were evaluated.
      module subroutine find_accelerations(self, g, must_agree, status)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system, rows evaluated
         real(wp), intent(in), contiguous :: g(:, 0:)   !! (3, 0:bodies) loads [N, N, N.m]
         logical, intent(in) :: must_agree              !! whether a contradiction counts: that of a correction is round-off
         integer, intent(out) :: status                 !! 0: found
      end subroutine find_accelerations

      !> Multipliers of the rows that are not solved for, at the state evaluated last. Reports want them.
      module subroutine planar_find_reactions(self, t)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                      !! time [s]
      end subroutine planar_find_reactions

      !> Powers of the ledger.
      pure module subroutine ledger_rates(self, power)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self  !! the system
         real(wp), intent(out) :: power(:)           !! (quadratures) powers [W]
      end subroutine ledger_rates

      !> Error scales.
      module subroutine planar_weights(self, y, scale)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(:)                !! (n) state [any]
         real(wp), intent(out) :: scale(:)           !! (n) scales [any]
      end subroutine planar_weights

      !> The pace at the start of a run: of the motion there, of what its accelerations make of it, and of the run.
      module subroutine planar_begin_pace(self, t, y, end)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:), end           !! time [s], (n) state [any], and end of the run [s]
      end subroutine planar_begin_pace

      !> Raise the pace to that of a state, which the motion is of, and to where accelerations lead that have just jumped there.
      pure module subroutine planar_follow_pace(self, y, jump)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(:)                   !! (n) state [any]
         real(wp), intent(in), optional :: jump(:)      !! (n) jump of its derivative [any]
      end subroutine planar_follow_pace

      !> Distance in time of differences along the motion that give rates.
      pure module real(wp) function time_of_difference(self, t)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self     !! the system
         real(wp), intent(in) :: t                      !! time [s]
      end function time_of_difference

      !> Event functions: penetrations of free contacts, their negatives of touching ones.
      module subroutine planar_events(self, t, y, g, rate)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)                !! time [s] and (n) state [any]
         real(wp), intent(out) :: g(:), rate(:)         !! (n_event) event functions and their rates [m, m/s]
      end subroutine planar_events

      !> The same at the present motion.
      module subroutine planar_last_events(self, t, y, g, rate)
         implicit none (type, external)
         class(planar_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)                !! time of the last evaluation [s] and (n) its state [any]
         real(wp), intent(out) :: g(:), rate(:)         !! (n_event) event functions and their rates [m, m/s]
      end subroutine planar_last_events

      !> Round-off of the event functions of contacts and turns at the present motion.
      module subroutine planar_event_noise(self, noise)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self  !! the system
         real(wp), intent(out) :: noise(:)           !! (n_event) bounds; zero of friction, which has no positions [m or m/s]
      end subroutine planar_event_noise

      !> Set of a contact and its place there by the number of any of its event functions, of which the first are as the contacts.
      module subroutine planar_find_contact(self, number, slot, contact)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self  !! the system
         integer, intent(in) :: number               !! event function: a block in the order of the sets for each kind
         integer, intent(out) :: slot, contact       !! its set, and its number there
      end subroutine planar_find_contact

      !> Name of the joint or driver that a constraint row belongs to.
      module function planar_row_name(self, row) result(name)
         implicit none (type, external)
         class(planar_system_t), intent(in) :: self   !! the system
         integer, intent(in) :: row                   !! number of the row
         character(:), allocatable :: name            !! the joint's name
      end function planar_row_name
   end interface

contains

   !> Right-hand side. Status 1: singular or not a number, try a smaller step.
   subroutine planar_evaluate(self, t, y, ydot, status)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(self%n)              !! (n) state [any]
      real(wp), intent(out) :: ydot(self%n)          !! (n) its derivative [any]
      integer, intent(out) :: status                 !! outcome

      real(wp) :: inside

      inside = min(max(t, self%piece%low), self%piece%high)  ! in the smooth stretch: `smooth_piece`, without its call
      self%n_evaluations = self%n_evaluations + 1
      if (self%grips%n_bristle > 0) call self%take_bristles(y)
      if (self%way%at_stages) then
         call correct_stage(self, t, y, status)
         if (status /= 0) return
         call move_bodies(self, inside, self%held)
      else
         call move_bodies(self, inside, y)
      end if
      call evaluate_terms(self, inside, status)
      if (status /= 0) return
      if (self%rows%n_unknown > 0 .or. self%grips%n_slip > 0) then
         call self%find_accelerations(self%g, .true., status)
         if (status == 0 .and. self%grips%n_slip > 0) call self%stick(status)
         if (status /= 0) return
      end if
      associate (n => 3*self%rows%n_unknown, nq => self%n_position, guided => self%guided)
         if (n > 0) then
            call state_rates(self%rows%n_unknown, self%rows%unknown, self%n_body, self%motion%v, self%motion%omega, self%a, &
                             ydot, ydot(nq + 1:), status)
            if (status /= 0) return
         end if
         if (guided%n > 0) then
            call guided_rates(guided%n, guided%n_turning, guided%item, self%n_body, self%g, y(nq + n + 1:), ydot(n + 1:), &
                              ydot(nq + n + 1:), status)
            if (self%with_ledger) call set_guided_acceleration(guided, ydot(nq + n + 1:), self%motion)
         end if
      end associate
      if (self%grips%n_bristle > 0) call self%bristle_rates(ydot)
      if (self%with_ledger) call self%ledger_rates(ydot(self%n - self%n_quadrature + 1:))
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

      if (h < huge(1.0_wp)) self%grips%h = h
      call move_alloc(self%way, way)
      call way%begin_step(self, h)
      call move_alloc(way, self%way)
   end subroutine planar_set_step

   !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
   subroutine evaluate_terms(self, t, status)
      class(planar_system_t), intent(inout) :: self  !! the system, its motion set
      real(wp), intent(in) :: t                      !! time, in the smooth stretch [s]
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
      if (self%rows%n_solve > 0) call planar_evaluate_rows(self, t)
      call planar_loads(self%n_body, self%loads%force, self%loads%moment, self%g)
   end subroutine evaluate_terms

   !> Solved rows, rates of their violations and right-hand sides at the present motion.
   subroutine planar_evaluate_rows(self, t)
      class(planar_system_t), intent(inout) :: self  !! the system, its motion set
      real(wp), intent(in) :: t                      !! time, in the smooth stretch [s]

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
      call self%find_accelerations(self%rest, .false., status)
   end subroutine planar_solve_rows

   !> Motion of all bodies at a state.
   subroutine planar_set_motion(self, t, y)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time [s]
      real(wp), intent(in) :: y(2*self%n_position)   !! (2 positions) coordinates and rates, the first of a state [any]

      call move_bodies(self, self%piece%inside(t), y)
   end subroutine planar_set_motion

   !> Motion of all bodies at a state and a time in the smooth stretch.
   subroutine move_bodies(self, t, y)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                      !! time, in the smooth stretch [s]
      real(wp), intent(in) :: y(2*self%n_position)   !! (2 positions) coordinates and rates, the first of a state [any]

      if (self%known%n > 0) call move_known(self%known, self%joints, t, self%motion)
      associate (n => 3*self%rows%n_unknown, nq => self%n_position)
         if (n > 0) call set_some_motion(self%rows%n_unknown, self%rows%unknown, y, y(nq + 1:nq + n), self%motion)
         if (self%guided%n > 0) call move_guided(self%guided, y(n + 1:nq), y(nq + n + 1:2*nq), self%motion)
      end associate
   end subroutine move_bodies

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

      associate (n => 3*self%rows%n_unknown, nq => self%n_position)
         call set_some_acceleration(self%rows%n_unknown, self%rows%unknown, ydot(nq + 1:nq + n), self%motion)
         if (self%guided%n > 0) call set_guided_acceleration(self%guided, ydot(nq + n + 1:2*nq), self%motion)
      end associate
   end subroutine planar_set_acceleration

end module planar_system
