!> A scene as a system of ordinary differential equations with events.
!>
!> y = ( q, v, z ), see `mechanism_state`: coordinates, rates, quadratures of the energy ledger and of impulses. Accelerations come
!> from the augmented equations with Baumgarte's stabilisation, b = gamma - 2 alpha Phi' - beta^2 Phi,  Phi' = Phi_q v + Phi_t,
!> less Phi_q a of the bodies whose motion is known.
!>
!> Ledger: z = ( drive work, load work, stabilisation work, lost in dampers; per contact: lost by damping, lost by
!> friction; lost by friction in ideal joints, if any rub; taken by films, if there are any ), with the powers lambda^T Phi_t, f .
!> v, -lambda^T Phi', c l'^2, (F_N - F_elastic) delta', F_T |v_T|, and F_T |v| of joints.
!>
!> Events: one function per contact of a clearance joint, the penetration while free, its negative while touching; with friction
!> that sticks, another one per contact (`mechanism_friction`).
!>
!> Source: Flores et al. (2008), eqs. (2.15), (2.23), (2.24).
module mechanism
   use stabilisation, only: stabilisation_t
   use kinds, only: wp
   use mechanism_state, only: mechanism_state_t
   implicit none (type, external)
   private
   public :: mechanism_t

   !> A scene.
   !> Components: those of its state.
   type, extends(mechanism_state_t) :: mechanism_t
      real(wp), allocatable, private :: held(:)   !! (positions + rates) state corrected for an evaluation [any]
      logical :: is_direct = .false.              !! accelerations follow from the loads at once: see `mechanism_direct`
   contains
      procedure :: evaluate => mechanism_evaluate, begin_form => mechanism_begin_form, leaves_out => mechanism_leaves_out
      procedure :: dae_residual => mechanism_dae_residual
      procedure :: evaluate_loads => mechanism_evaluate_loads, gather_loads => mechanism_gather_loads
      procedure :: multipliers => mechanism_multipliers
      procedure :: effect_of => mechanism_effect_of
      procedure :: choose_form => mechanism_choose_form
      procedure, private :: evaluate_terms, evaluate_any, ledger_rates, wear_rates
      procedure :: events => mechanism_events, last_events => mechanism_last_events, settle => mechanism_settle
      procedure :: set_step => mechanism_set_step
      procedure :: hold => mechanism_stabilise, project_state => mechanism_project, take_stabiliser => mechanism_take_stabiliser
      procedure :: stick => mechanism_stick, decide_slips => mechanism_decide_slips
      procedure :: rub => mechanism_add_friction, friction_by_multipliers => mechanism_friction_by_multipliers
      procedure :: friction_events => mechanism_friction_events, turns => mechanism_turns
      procedure :: evaluate_unheld => mechanism_evaluate_unheld
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

      !> Look whether accelerations follow from the loads at once. The system is built.
      module subroutine mechanism_choose_form(self)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
      end subroutine mechanism_choose_form

      !> Rates of the coordinates and their derivatives, and those of bristles, in any scene. Status 1: singular or not a number.
      module subroutine evaluate_any(self, t, inside, y, ydot, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(in) :: inside             !! the same in the smooth stretch [s]
         real(wp), intent(in) :: y(self%n)          !! (n) state [any]
         real(wp), intent(inout) :: ydot(self%n)    !! (n) its derivative, but for quadratures [any]
         integer, intent(out) :: status             !! outcome
      end subroutine evaluate_any

      !> Loads and solved rows at the present motion. Status 1 if a known motion is not finite.
      module subroutine evaluate_terms(self, t, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, its motion set
         real(wp), intent(in) :: t                  !! time, in the smooth stretch [s]
         integer, intent(out) :: status             !! outcome
      end subroutine evaluate_terms

      !> Move the bodies to a state as the stabilisation method corrects it.
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

      !> The loads of the last evaluation on the rates, which one that goes the direct way leaves to those who read them.
      module subroutine mechanism_gather_loads(self)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, evaluated
      end subroutine mechanism_gather_loads

      !> Correct a state at the end of a step; what that does to the energy is work of the stabilisation.
      module subroutine mechanism_stabilise(self, t, y, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(inout) :: y(:)            !! (n) state [any]
         integer, intent(out) :: status             !! 0: done
      end subroutine mechanism_stabilise

      !> Bring a state that was made by interpolation onto the constraints, by projection.
      module subroutine mechanism_project(self, t, y, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(inout) :: y(:)            !! (n) state [any]
         integer, intent(out) :: status             !! 0: done
      end subroutine mechanism_project

      !> Forces of the contacts that stick, and the accelerations with them.
      module subroutine mechanism_stick(self, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, accelerations without these forces found
         integer, intent(out) :: status             !! 0: found
      end subroutine mechanism_stick

      !> Friction forces in ideal joints, those of contacts that stick, and the accelerations with them.
      module subroutine mechanism_add_friction(self, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, accelerations without these forces found
         integer, intent(out) :: status             !! 0: found
      end subroutine mechanism_add_friction

      !> Friction forces in ideal joints by the multipliers that are set, into the loads.
      module subroutine mechanism_friction_by_multipliers(self, is_steady, is_added, change)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system, its motion and multipliers set
         logical, intent(in) :: is_steady           !! forces of steady sliding: no deflections are integrated
         logical, intent(in) :: is_added            !! whether the loads have the last forces in them already
         real(wp), intent(out) :: change            !! maximum change of a force, of the maximum force [1]
      end subroutine mechanism_friction_by_multipliers

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

      !> Decide which contacts slip, which way, and which stick, at a state. The motion of the system is that of the state.
      module subroutine mechanism_decide_slips(self, t, y, only_new)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         logical, intent(in) :: only_new            !! only where a contact is not decided
      end subroutine mechanism_decide_slips

      !> Accelerations of the bodies without their joints.
      module subroutine mechanism_evaluate_unheld(self, t, y, ydot, status)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                  !! time [s]
         real(wp), intent(in) :: y(self%n)          !! (n) state [any]
         real(wp), intent(inout) :: ydot(self%n)    !! (n) derivatives of the rates of unknown bodies [any]
         integer, intent(out) :: status             !! outcome
      end subroutine mechanism_evaluate_unheld

      !> Rows that depend on others where the bodies are: those that the form of index 2 omits.
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

      !> Powers of the ledger.
      pure module subroutine ledger_rates(self, power)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self         !! the system
         real(wp), intent(out), contiguous :: power(:)  !! (quadratures) powers, those of the ledger are set [W]
      end subroutine ledger_rates

      !> Rates of the driving work of wear.
      pure module subroutine wear_rates(self, rate)
         implicit none (type, external)
         class(mechanism_t), intent(in) :: self   !! the system, evaluated
         real(wp), intent(out) :: rate(:)         !! (contacts) rates [W]
      end subroutine wear_rates

      !> Event functions: penetrations of free contacts, their negatives of touching ones.
      module subroutine mechanism_events(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         real(wp), intent(out), contiguous :: g(:), rate(:)     !! (n_event) event functions and their rates [m, m/s]
      end subroutine mechanism_events

      !> The same at the present motion.
      module subroutine mechanism_last_events(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time of the last evaluation [s] and (n) its state [any]
         real(wp), intent(out), contiguous :: g(:), rate(:)     !! (n_event) event functions and their rates [m, m/s]
      end subroutine mechanism_last_events

      !> Leave the system at a state after events were searched elsewhere.
      module subroutine mechanism_settle(self, t, y, g, rate)
         implicit none (type, external)
         class(mechanism_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:)            !! time [s] and (n) state [any]
         real(wp), intent(inout), contiguous :: g(:), rate(:)   !! (n_event) scratch [any]
      end subroutine mechanism_settle

   end interface

contains

   !> Take a stabilisation method. The coordinates are counted.
   subroutine mechanism_take_stabiliser(self, stabiliser)
      class(mechanism_t), intent(inout) :: self         !! the system
      class(stabilisation_t), allocatable, intent(inout) :: stabiliser  !! the stabilisation method, configured; gone afterwards

      call move_alloc(stabiliser, self%stabiliser)
      self%holds = self%stabiliser%at_steps
      self%traits%follows_step = self%stabiliser%follows_step
      self%traits%has_films = self%clearance_joints%has_films
      allocate (self%held(merge(self%linkage%n_position + self%linkage%n_rate, 0, self%stabiliser%at_stages)), source=0.0_wp)
   end subroutine mechanism_take_stabiliser

   !> The length of the step that starts, for gains that follow it.
   subroutine mechanism_set_step(self, h)
      class(mechanism_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      if (h < huge(1.0_wp)) self%friction%stick_slips%h = h
      call self%stabiliser%begin_step(self%linkage, h)
   end subroutine mechanism_set_step

   !> Whether the form of index 2 omits rows.
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
