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
   use clearance_set, only: clearance_slot_t
   use dae_system, only: dae_system_t
   use grip_forces, only: grip_forces_t
   use guided_motion, only: guided_rates, set_guided_acceleration
   use hold, only: hold_t
   use kinds, only: i8, wp
   use linkage, only: linkage_t
   use loading, only: loading_t, start_loads
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
      type(linkage_t) :: linkage                            !! bodies, ideal joints and drivers, and the solution of the equations
      type(loading_t) :: loading                            !! gravity and force elements
      type(clearance_slot_t), allocatable :: clearances(:)  !! loose joints, one set per combination of laws
      integer :: n_loose = 0                                !! loose joints in all
      integer :: n_contact = 0                              !! contacts of all loose joints
      real(wp), allocatable :: losses(:, :)                 !! (2, contacts) power lost by contact and friction [W]
      integer :: first_turn = 0                             !! event functions before those of turns; 0: no law jumps at a turn
      type(grip_forces_t) :: grips                          !! contacts whose friction remembers
      class(hold_t), allocatable :: way                     !! way of holding the constraints
      logical :: with_ledger = .true.                       !! whether the ledger is kept
      logical :: with_energies = .true.                     !! whether energies are reported, with or without a ledger
      integer(i8) :: n_evaluations = 0                      !! evaluations made
      real(wp), allocatable, private :: held(:)             !! (positions + rates) state corrected for an evaluation [any]
   contains
      procedure :: evaluate => planar_evaluate, dae_residual => planar_dae_residual
      procedure :: dae_pattern => planar_dae_pattern, dae_spread => planar_dae_spread, weights => planar_weights
      procedure :: evaluate_loads => planar_evaluate_loads, multipliers => planar_multipliers
      procedure, private :: evaluate_terms, ledger_rates
      procedure :: begin_pace => planar_begin_pace, follow_pace => planar_follow_pace, time_of_difference
      procedure :: events => planar_events, last_events => planar_last_events
      procedure :: event_noise => planar_event_noise, set_step => planar_set_step
      procedure :: hold => planar_hold, mend => planar_mend, take_way => planar_take_way
      procedure :: find_contact => planar_find_contact, is_onset => planar_is_onset
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
         real(wp), intent(out) :: values(:)           !! (n_v for each side of an unknown body) in the order of the pattern [any]
      end subroutine planar_dae_spread

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

      ! in the smooth stretch: `smooth_piece`, without its call
      inside = min(max(t, self%linkage%piece%low), self%linkage%piece%high)
      self%n_evaluations = self%n_evaluations + 1
      if (self%grips%n_bristle > 0) call self%take_bristles(y)
      if (self%way%at_stages) then
         self%held = y(:size(self%held))
         call self%way%correct_stage(self%linkage, t, self%held, status)
         if (status /= 0) return
         call self%linkage%move(inside, self%held)
      else
         call self%linkage%move(inside, y)
      end if
      call evaluate_terms(self, inside, status)
      if (status /= 0) return
      if (self%linkage%rows%n_unknown > 0 .or. self%grips%n_slip > 0) then
         call self%linkage%find_accelerations(self%loading%g, .true., self%grips%n_slip > 0, status)
         if (status == 0 .and. self%grips%n_slip > 0) call self%stick(status)
         if (status /= 0) return
      end if
      associate (linkage => self%linkage, n => self%linkage%rows%n_unknown, guided => self%linkage%reduced%guided, &
                 nq => self%linkage%n_position)
         if (n > 0) then
            call linkage%coordinates%rates(n, linkage%rows%unknown, linkage%motion, linkage%solution%a, ydot, ydot(nq + 1:), status)
            if (status /= 0) return
         end if
         if (guided%n > 0) then
            associate (last => nq + linkage%n_rate - guided%n)
               call guided_rates(guided%n, guided%n_turning, guided%item, linkage%bodies%n, self%loading%g, y(last + 1:), &
                                 ydot(nq - guided%n + 1:), ydot(last + 1:), status)
               if (self%with_ledger) call set_guided_acceleration(guided, ydot(last + 1:), linkage%motion)
            end associate
         end if
      end associate
      if (self%grips%n_bristle > 0) call self%bristle_rates(ydot)
      if (self%with_ledger) call self%ledger_rates(ydot(self%n - self%n_quadrature + 1:))
   end subroutine planar_evaluate

   !> Take a way of holding the constraints. The coordinates are counted.
   subroutine planar_take_way(self, way)
      class(planar_system_t), intent(inout) :: self            !! the system
      class(hold_t), allocatable, intent(inout) :: way         !! the way, configured; gone afterwards

      call move_alloc(way, self%way)
      self%holds = self%way%at_steps
      self%follows_step = self%way%follows_step
      allocate (self%held(merge(self%linkage%n_position + self%linkage%n_rate, 0, self%way%at_stages)), source=0.0_wp)
   end subroutine planar_take_way

   !> The length of the step that begins, for gains that follow it.
   subroutine planar_set_step(self, h)
      class(planar_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: h                      !! length of the step [s]

      if (h < huge(1.0_wp)) self%grips%h = h
      call self%way%begin_step(self%linkage, h)
   end subroutine planar_set_step

   !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
   subroutine evaluate_terms(self, t, status)
      class(planar_system_t), intent(inout) :: self  !! the system, its motion set
      real(wp), intent(in) :: t                      !! time, in the smooth stretch [s]
      integer, intent(out) :: status                 !! outcome

      self%linkage%solution%bad_row = 0
      status = merge(0, 1, self%linkage%reduced%known%is_finite)
      if (status /= 0) return
      call planar_evaluate_loads(self, t)
      if (self%linkage%rows%n_solve > 0) call self%linkage%evaluate_rows(t)
   end subroutine evaluate_terms

   !> Loads of gravity, force elements and touching contacts at the present motion.
   subroutine planar_evaluate_loads(self, t)
      class(planar_system_t), intent(inout) :: self  !! the system, its motion set
      real(wp), intent(in) :: t                      !! time [s]

      real(wp) :: inside
      integer :: k

      inside = min(max(t, self%linkage%piece%low), self%linkage%piece%high)
      associate (loading => self%loading, motion => self%linkage%motion, n_body => self%linkage%bodies%n)
         call start_loads(n_body, loading%weight, loading%loads%force, loading%loads%moment)
         loading%power = 0.0_wp
         do k = 1, size(loading%forces)
            call loading%forces(k)%set%evaluate(inside, motion, loading%loads, loading%power)
         end do
         do k = 1, size(self%clearances)
            call self%clearances(k)%set%evaluate(motion, loading%loads, self%losses)
         end do
         call self%linkage%coordinates%gather(n_body, loading%loads, loading%g)
      end associate
   end subroutine planar_evaluate_loads

   !> Multipliers of the last evaluation.
   subroutine planar_multipliers(self, lambda)
      class(planar_system_t), intent(in) :: self     !! the system
      real(wp), intent(out) :: lambda(:)             !! (m) multipliers [N or N.m]

      lambda = self%linkage%solution%lambda(:size(lambda))
   end subroutine planar_multipliers

end module planar_system
