!> A scene as a system of ordinary differential equations with events.
!>
!> y = ( q, v, z ): coordinates (x, y, angle) of each body whose motion is unknown, then one of each guided body; their rates;
!> and the quadratures of the energy ledger. Accelerations come from the augmented equations with Baumgarte's stabilisation,
!> b = gamma - 2 alpha Phi' - beta^2 Phi,  Phi' = Phi_q v + Phi_t,  less Phi_q a of the bodies whose motion is known.
!>
!> Ledger: z = ( drive work, load work, stabilisation work, lost in dampers; per contact: lost by damping, lost by
!> friction; lost by friction in ideal joints, if any rub; taken by films, if there are any ), with the powers lambda^T Phi_t, f .
!> v, -lambda^T Phi', c l'^2, (F_N - F_elastic) delta', F_T |v_T|, and F_T |v| of joints.
!>
!> Events: one function per contact of a loose joint, the penetration while free, its negative while touching; with friction
!> that sticks, another one per contact (`mechanism_friction`). Contacts with bristles have a state each, after the rates.
!>
!> Source: Flores et al. (2008), eqs. (2.15), (2.23), (2.24).
module mechanism
   use checkpoint, only: piece_t
   use dae_system, only: dae_system_t
   use hold, only: hold_t
   use kinds, only: i8, wp
   use linkage, only: linkage_t
   use loading, only: loading_t
   use mechanism_parts, only: friction_t, ledger_t, loose_t
   use requests, only: requests_t
   implicit none (type, external)
   private
   public :: mechanism_t

   !> A scene.
   !> Components: seven are those of every system of equations.
   type, extends(dae_system_t) :: mechanism_t
      type(linkage_t) :: linkage                  !! bodies, ideal joints and drivers, and the solution of the equations
      type(loading_t) :: loading                  !! gravity and force elements
      type(loose_t) :: loose                      !! loose joints
      type(friction_t) :: friction                !! friction that is solved for
      class(hold_t), allocatable :: way           !! way of holding the constraints
      type(ledger_t) :: ledger                    !! what is told of energies
      type(requests_t) :: requests                !! what is asked of the motion beside channels of its items
      integer(i8) :: n_evaluations = 0            !! evaluations made
      real(wp), allocatable, private :: held(:)   !! (positions + rates) state corrected for an evaluation [any]
   contains
      procedure :: evaluate => mechanism_evaluate, begin_form => mechanism_begin_form, leaves_out => mechanism_leaves_out
      procedure :: dae_residual => mechanism_dae_residual
      procedure :: dae_pattern => mechanism_dae_pattern, dae_spread => mechanism_dae_spread, weights => mechanism_weights
      procedure :: evaluate_loads => mechanism_evaluate_loads, multipliers => mechanism_multipliers
      procedure :: effect_of => mechanism_effect_of
      procedure, private :: evaluate_terms, ledger_rates
      procedure :: begin_pace => mechanism_begin_pace, follow_pace => mechanism_follow_pace, time_of_difference
      procedure :: events => mechanism_events, last_events => mechanism_last_events, settle => mechanism_settle
      procedure :: event_noise => mechanism_event_noise, set_step => mechanism_set_step
      procedure :: hold => mechanism_hold, mend => mechanism_mend, take_way => mechanism_take_way
      procedure :: find_contact => mechanism_find_contact, contact_change => mechanism_contact_change, in_state
      procedure :: take_bristles => mechanism_take_bristles, bristle_rates => mechanism_bristle_rates
      procedure :: bristle_place => mechanism_bristle_place, rubbing_place => mechanism_rubbing_place
      procedure :: stick => mechanism_stick, decide_slip => mechanism_decide_slip, bristle_weights => mechanism_bristle_weights
      procedure :: rub => mechanism_rub, rub_by_multipliers => mechanism_rub_by_multipliers
      procedure :: friction_events => mechanism_friction_events, turns => mechanism_turns
      procedure :: to_local => mechanism_to_local, from_local => mechanism_from_local
      procedure :: free_directions => mechanism_free_directions, evaluate_unheld => mechanism_evaluate_unheld
      procedure :: list_memory => mechanism_list_memory
      procedure :: memory_size => mechanism_memory_size, save => mechanism_save, load => mechanism_load
   end type mechanism_t

   interface
      !> Right-hand side. Status 1: singular or not a number, try a smaller step.
      module subroutine mechanism_evaluate(self, t, y, ydot, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(in) :: y(self%n)          !! (n) state [any]
         real(wp), intent(out) :: ydot(self%n)      !! (n) its derivative [any]
         integer, intent(out) :: status             !! outcome
      end subroutine mechanism_evaluate

      !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
      module subroutine evaluate_terms(self, t, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, its motion set
         real(wp), intent(in) :: t                  !! time, in the smooth stretch [s]
         integer, intent(out) :: status             !! outcome
      end subroutine evaluate_terms

      !> Move the bodies to a state as the way of holding the constraints corrects it.
      module subroutine move_corrected(self, t, y, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(in) :: y(self%n)          !! (n) state [any]
         integer, intent(out) :: status             !! outcome
      end subroutine move_corrected

      !> Loads of gravity, force elements and touching contacts at the present motion.
      module subroutine mechanism_evaluate_loads(self, t)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, its motion set
         real(wp), intent(in) :: t                  !! time [s]
      end subroutine mechanism_evaluate_loads

      !> Correct a state at the end of a step; what that does to the energy is work of the stabilisation.
      module subroutine mechanism_hold(self, t, y, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(inout) :: y(:)            !! (n) state [any]
         integer, intent(out) :: status             !! 0: done
      end subroutine mechanism_hold

      !> Bring a state that was made by interpolation onto the constraints, by projection.
      module subroutine mechanism_mend(self, t, y, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(inout) :: y(:)            !! (n) state [any]
         integer, intent(out) :: status             !! 0: done
      end subroutine mechanism_mend

      !> What event k, as things stand, is to a contact.
      module integer function mechanism_contact_change(self, k) result(change)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the mechanism
         integer, intent(in) :: k                !! number of the event function
      end function mechanism_contact_change

      !> Forces of the contacts that stick, and the accelerations with them.
      module subroutine mechanism_stick(self, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, accelerations without these forces found
         integer, intent(out) :: status             !! 0: found
      end subroutine mechanism_stick

      !> Entries of the state before the deflection of a contact, which has as many as its components.
      pure module integer function mechanism_bristle_place(self, slot, contact) result(place)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         integer, intent(in) :: slot, contact    !! its set, whose law has bristles, and its number there
      end function mechanism_bristle_place

      !> Place of the deflection of a joint that rubs, by bristles, in the state.
      pure module integer function mechanism_rubbing_place(self, joint) result(place)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         integer, intent(in) :: joint            !! its number among those that rub
      end function mechanism_rubbing_place

      !> Friction forces in ideal joints, those of contacts that stick, and the accelerations with them.
      module subroutine mechanism_rub(self, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, accelerations without these forces found
         integer, intent(out) :: status             !! 0: found
      end subroutine mechanism_rub

      !> Friction forces in ideal joints by the multipliers that are set, into the loads.
      module subroutine mechanism_rub_by_multipliers(self, is_steady, is_added, change)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, its motion and multipliers set
         logical, intent(in) :: is_steady           !! forces of steady sliding: no deflections are integrated
         logical, intent(in) :: is_added            !! whether the loads have the last forces in them already
         real(wp), intent(out) :: change            !! greatest change of a force, of the greatest force [1]
      end subroutine mechanism_rub_by_multipliers

      !> Deflections of bristles from a state into contacts and joints.
      module subroutine mechanism_take_bristles(self, y)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(:)               !! (n) state [any]
      end subroutine mechanism_take_bristles

      !> Rates of these deflections, as of the last evaluation.
      module subroutine mechanism_bristle_rates(self, ydot)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(inout) :: ydot(:)      !! (n) derivative of the state [any]
      end subroutine mechanism_bristle_rates

      !> Their scales, for error norms.
      module subroutine mechanism_bristle_weights(self, scale)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(inout) :: scale(:)     !! (n) scales [any]
      end subroutine mechanism_bristle_weights

      !> Event functions of friction: slip that ends, and sticking that gives way. Evaluates the system at the state.
      module subroutine mechanism_friction_events(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         real(wp), intent(inout) :: g(:), rate(:)   !! (n_event) functions and rates, those of friction set [any]
      end subroutine mechanism_friction_events

      !> Rates of all penetrations and their rates, by a difference along the motion. The system is evaluated at the state.
      module subroutine mechanism_turns(self, t, y, rate, acceleration)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self          !! the system
         real(wp), intent(in) :: t, y(:)                    !! time [s] and (n) state [any]
         real(wp), intent(out) :: rate(:), acceleration(:)  !! (n_contact) rates of the penetrations, and theirs [any]
      end subroutine mechanism_turns

      !> Decide whether a contact slips, which way, or sticks, at a state.
      module subroutine mechanism_decide_slip(self, t, y, slot, k)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         integer, intent(in) :: slot, k             !! set of the contact, and its number there
      end subroutine mechanism_decide_slip

      !> The local change that a small change of a state is: along the bodies' axes.
      module subroutine mechanism_to_local(self, y, change, x)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self        !! the system
         real(wp), intent(in) :: y(:), change(:)       !! (n) state, and (n less quadratures) its change [any]
         real(wp), intent(out) :: x(:)                 !! (n less quadratures and turning bodies) local change [any]
      end subroutine mechanism_to_local

      !> The small change of a state that a local change is.
      module subroutine mechanism_from_local(self, y, x, change)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self        !! the system
         real(wp), intent(in) :: y(:), x(:)            !! (n) state, and local change [any]
         real(wp), intent(out) :: change(:)            !! (n less quadratures) change of the state [any]
      end subroutine mechanism_from_local

      !> Directions of local displacements that the rows leave, and how to read them.
      module subroutine mechanism_free_directions(self, t, y, n, direction, reading)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self                     !! the system
         real(wp), intent(in) :: t, y(:)                               !! time [s] and (n) state [any]
         integer, intent(out) :: n                                     !! their number
         real(wp), intent(inout) :: direction(:, :), reading(:, :)     !! (rates, room) a column each [any]
      end subroutine mechanism_free_directions

      !> Accelerations of the bodies without their joints.
      module subroutine mechanism_evaluate_unheld(self, t, y, ydot, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(in) :: y(self%n)          !! (n) state [any]
         real(wp), intent(inout) :: ydot(self%n)    !! (n) derivatives of the rates of unknown bodies [any]
         integer, intent(out) :: status             !! outcome
      end subroutine mechanism_evaluate_unheld

      !> List what the system saves, in the order in which it does.
      module subroutine mechanism_list_memory(self, pieces)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self                  !! the system
         type(piece_t), allocatable, intent(inout) :: pieces(:)  !! (any) the list, grown
      end subroutine mechanism_list_memory

      !> Numbers that a checkpoint needs: those of all its pieces.
      module integer function mechanism_memory_size(self) result(n)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
      end function mechanism_memory_size

      !> Write what the system remembers.
      module subroutine mechanism_save(self, row, place)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(inout) :: row(:)       !! (any) checkpoint [any]
         integer, intent(inout) :: place         !! last place used
      end subroutine mechanism_save

      !> Read what the system remembers.
      module subroutine mechanism_load(self, row, place)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: row(:)             !! (any) checkpoint [any]
         integer, intent(inout) :: place            !! last place used
      end subroutine mechanism_load

      !> Rows that depend on others where the bodies are: those that the form of index 2 leaves out.
      module subroutine mechanism_begin_form(self)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, evaluated
      end subroutine mechanism_begin_form

      !> What is left of the equations in the stabilised form of index 2.
      module subroutine mechanism_dae_residual(self, t, y, ydot, lambda, mu, r_y, r_lambda, r_mu, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self          !! the system
         real(wp), intent(in) :: t                          !! time [s]
         real(wp), intent(in), contiguous :: y(:), ydot(:)  !! (n) state and its derivative [any]
         real(wp), intent(in) :: lambda(:), mu(:)           !! (rows) multipliers of velocities and of positions [any]
         real(wp), intent(out), contiguous :: r_y(:)        !! (n) of the differential equations [any]
         real(wp), intent(out) :: r_lambda(:), r_mu(:)      !! (rows) rates of the violation, and violations [any]
         integer, intent(out) :: status                     !! outcome
      end subroutine mechanism_dae_residual

      !> How fast a change of the multipliers changes the velocities.
      module function mechanism_effect_of(self, change, scale) result(effect)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self        !! the system
         real(wp), intent(in) :: change(:), scale(:)      !! (rows) the change [any]; (n) error scales of the state [any]
         real(wp) :: effect                               !! norm over the scales of the velocities [1/s]
      end function mechanism_effect_of

      !> Which parts of the residual depend on which unknowns.
      module subroutine mechanism_dae_pattern(self, column, row)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self          !! the system
         integer, allocatable, intent(out) :: column(:)  !! (n + 2 rows + 1) place of the first entry of each column, from 0
         integer, allocatable, intent(out) :: row(:)     !! (entries) rows, from 0
      end subroutine mechanism_dae_pattern

      !> Entries of the columns of the multipliers.
      module subroutine mechanism_dae_spread(self, values)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(out) :: values(:)      !! (n_v for each side of an unknown body) in the order of the pattern [any]
      end subroutine mechanism_dae_spread

      !> Powers of the ledger.
      pure module subroutine ledger_rates(self, power)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self         !! the system
         real(wp), intent(out), contiguous :: power(:)  !! (quadratures) powers [W]
      end subroutine ledger_rates

      !> Error scales.
      module subroutine mechanism_weights(self, y, scale)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(self%n)       !! (n) state [any]
         real(wp), intent(out) :: scale(self%n)  !! (n) scales [any]
      end subroutine mechanism_weights

      !> The pace at the start of a run: of the motion there, of what its accelerations make of it, and of the run.
      module subroutine mechanism_begin_pace(self, t, y, end)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:), end       !! time [s], (n) state [any], and end of the run [s]
      end subroutine mechanism_begin_pace

      !> Raise the pace to that of a state, which the motion is of, and to where accelerations lead that have just jumped there.
      pure module subroutine mechanism_follow_pace(self, y, jump)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(self%n)               !! (n) state [any]
         real(wp), intent(in), optional :: jump(self%n)  !! (n) jump of its derivative [any]
      end subroutine mechanism_follow_pace

      !> Distance in time of differences along the motion that give rates.
      pure module real(wp) function time_of_difference(self, t)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: t               !! time [s]
      end function time_of_difference

      !> Event functions: penetrations of free contacts, their negatives of touching ones.
      module subroutine mechanism_events(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         real(wp), intent(out) :: g(:), rate(:)     !! (n_event) event functions and their rates [m, m/s]
      end subroutine mechanism_events

      !> The same at the present motion.
      module subroutine mechanism_last_events(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time of the last evaluation [s] and (n) its state [any]
         real(wp), intent(out) :: g(:), rate(:)     !! (n_event) event functions and their rates [m, m/s]
      end subroutine mechanism_last_events

      !> Leave the system at a state after events were looked for elsewhere.
      module subroutine mechanism_settle(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         real(wp), intent(inout) :: g(:), rate(:)   !! (n_event) scratch [any]
      end subroutine mechanism_settle

      !> Round-off of the event functions of contacts and turns at the present motion.
      module subroutine mechanism_event_noise(self, noise)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         real(wp), intent(out) :: noise(:)       !! (n_event) bounds; zero of friction, which has no positions [m or m/s]
      end subroutine mechanism_event_noise

      !> Set of a contact and its place there by the number of any of its event functions, of which the first are as the contacts.
      module subroutine mechanism_find_contact(self, number, slot, contact)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self  !! the system
         integer, intent(in) :: number           !! event function: a block in the order of the sets for each kind
         integer, intent(out) :: slot, contact   !! its set, and its number there
      end subroutine mechanism_find_contact

   end interface

contains

   !> Take a way of holding the constraints. The coordinates are counted.
   subroutine mechanism_take_way(self, way)
      class(mechanism_t), intent(inout) :: self         !! the system
      class(hold_t), allocatable, intent(inout) :: way  !! the way, configured; gone afterwards

      call move_alloc(way, self%way)
      self%holds = self%way%at_steps
      self%traits%follows_step = self%way%follows_step
      self%traits%has_films = self%loose%has_films
      allocate (self%held(merge(self%linkage%n_position + self%linkage%n_rate, 0, self%way%at_stages)), source=0.0_wp)
   end subroutine mechanism_take_way

   !> The length of the step that begins, for gains that follow it.
   subroutine mechanism_set_step(self, h)
      class(mechanism_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      if (h < huge(1.0_wp)) self%friction%grips%h = h
      call self%way%begin_step(self%linkage, h)
   end subroutine mechanism_set_step

   !> Place in the state of a quadrature of the ledger; of number 0: entries before them.
   pure integer function in_state(self, quadrature) result(place)
      class(mechanism_t), intent(in) :: self  !! the system, with a ledger
      integer, intent(in) :: quadrature       !! number of the quadrature, see `contact_places`

      place = self%n - self%n_quadrature + quadrature
   end function in_state

   !> Whether the form of index 2 leaves out rows.
   pure logical function mechanism_leaves_out(self) result(does)
      class(mechanism_t), intent(in) :: self  !! the system

      does = self%linkage%solution%is_redundant
   end function mechanism_leaves_out

   !> Multipliers of the last evaluation.
   subroutine mechanism_multipliers(self, lambda)
      class(mechanism_t), intent(in) :: self  !! the system
      real(wp), intent(out) :: lambda(:)      !! (m) multipliers [N or N.m]

      lambda = self%linkage%solution%lambda(:size(lambda))
   end subroutine mechanism_multipliers

end module mechanism
