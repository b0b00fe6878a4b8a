!> What a mechanism consists of, and what stands where in its state: that of `mechanism`, which evaluates it.
!>
!> y = ( q, v, z ): coordinates (x, y, angle) of each body whose motion is unknown, then one of each body with one degree of
!> freedom; their rates; and the quadratures: those of the energy ledger, then, if surfaces wear, the driving work of each contact's
!> wear, then the impulse of each contact's normal force. Contacts with bristles have a state each, after the rates;
!> the deck's state equations follow.
!>
!> Here are the places in it, what is small beside it (error scales, the characteristic rate, round-off of event functions), small
!> changes of it, where its residual has entries, and what of it a checkpoint keeps.
module mechanism_state
   use archive, only: archive_t
   use dae_system, only: dae_system_t
   use errors, only: error_t
   use stabilisation, only: stabilisation_t
   use kinds, only: i8, wp
   use linkage, only: linkage_t
   use loading, only: loading_t
   use mechanism_parts, only: friction_t, ledger_t, clearance_joints_t
   use requests, only: requests_t
   implicit none (type, external)
   private
   public :: mechanism_state_t

   !> The parts of a scene, and its state.
   !> Components: seven are those of every system of equations.
   type, abstract, extends(dae_system_t) :: mechanism_state_t
      type(linkage_t) :: linkage                  !! bodies, ideal joints and drivers, and the solution of the equations
      type(loading_t) :: loading                  !! gravity and force elements
      type(clearance_joints_t) :: clearance_joints                      !! clearance joints
      type(friction_t) :: friction                !! friction that is solved for
      class(stabilisation_t), allocatable :: stabiliser    !! stabilisation method
      type(ledger_t) :: ledger                    !! what is reported of energies
      type(requests_t) :: requests                !! what is asked of the motion beside channels of its items
      integer :: n_impulse = 0                    !! contacts whose impulses are integrated: all, or none
      integer :: n_wear = 0                       !! contacts whose driving work of wear is integrated: all, or none
      integer(i8) :: n_evaluations = 0            !! evaluations made
   contains
      procedure :: begin_pace => mechanism_begin_pace, follow_pace => mechanism_follow_pace, time_of_difference
      procedure :: scale_quadratures => mechanism_scale_quadratures
      procedure :: weights => mechanism_weights, event_noise => mechanism_event_noise
      procedure :: to_local => mechanism_to_local, from_local => mechanism_from_local
      procedure :: free_directions => mechanism_free_directions
      procedure :: find_contact => mechanism_find_contact, contact_change => mechanism_contact_change, in_state
      procedure :: place_of_impulse, place_of_wear
      procedure :: take_bristles => mechanism_take_bristles, bristle_rates => mechanism_bristle_rates
      procedure :: bristle_place => mechanism_bristle_place, rubbing_place => mechanism_rubbing_place
      procedure :: bristle_weights => mechanism_bristle_weights
      procedure :: before_states => mechanism_before_states, begin_states => mechanism_begin_states
      procedure :: take_states => mechanism_take_states, state_rates => mechanism_state_rates
      procedure :: state_weights => mechanism_state_weights, sample_states => mechanism_sample_states
      procedure :: dae_pattern => mechanism_dae_pattern, dae_spread => mechanism_dae_spread
      procedure :: save => mechanism_save, load => mechanism_load
   end type mechanism_state_t

   interface
      !> The characteristic rate at the start of a run: of the motion there, of what its accelerations make of it, and of the run.
      module subroutine mechanism_begin_pace(self, t, y, end)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t, y(:), end             !! time [s], (n) state [any], and end of the run [s]
      end subroutine mechanism_begin_pace

      !> Raise the characteristic rate to that of a state, which the motion is of, and to where accelerations lead that have just
      !> jumped there.
      pure module subroutine mechanism_follow_pace(self, y, jump)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(self%n)                !! (n) state [any]
         real(wp), intent(in), optional :: jump(self%n)   !! (n) jump of its derivative [any]
      end subroutine mechanism_follow_pace

      !> Scales of the quadratures of a scene with drivers: of works and losses the largest energy or work so far; of
      !> impulses the momentum of all bodies at the characteristic rate. What starts from rest is measured by the energy that the
      !> error scales of rates allow for.
      module subroutine mechanism_scale_quadratures(self, energy)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self  !! the system, its characteristic rate started
         real(wp), intent(in) :: energy                   !! largest energy or work so far; raises that of before [J]
      end subroutine mechanism_scale_quadratures

      !> Distance in time of differences along the motion that give rates.
      pure module real(wp) function time_of_difference(self, t)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: t                     !! time [s]
      end function time_of_difference

      !> Error scales.
      module subroutine mechanism_weights(self, y, scale)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(self%n)             !! (n) state [any]
         real(wp), intent(out) :: scale(self%n)        !! (n) scales [any]
      end subroutine mechanism_weights

      !> The local change that a small change of a state is: along the bodies' axes.
      module subroutine mechanism_to_local(self, y, change, x)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(:), change(:)       !! (n) state, and (n less quadratures) its change [any]
         real(wp), intent(out) :: x(:)                 !! (n less quadratures and turning bodies) local change [any]
      end subroutine mechanism_to_local

      !> The small change of a state that a local change is.
      module subroutine mechanism_from_local(self, y, x, change)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(:), x(:)            !! (n) state, and local change [any]
         real(wp), intent(out) :: change(:)            !! (n less quadratures) change of the state [any]
      end subroutine mechanism_from_local

      !> Directions of local displacements that the rows leave, and how to read them.
      module subroutine mechanism_free_directions(self, t, y, n, direction, reading)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self            !! the system
         real(wp), intent(in) :: t, y(:)                            !! time [s] and (n) state [any]
         integer, intent(out) :: n                                  !! their number
         real(wp), intent(inout) :: direction(:, :), reading(:, :)  !! (rates, room) a column each [any]
      end subroutine mechanism_free_directions

      !> Entries of the state before the deflection of a contact, which has as many as its components.
      pure module integer function mechanism_bristle_place(self, slot, contact) result(place)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         integer, intent(in) :: slot, contact          !! its set, whose law has bristles, and its number there
      end function mechanism_bristle_place

      !> Place of the deflection of a joint that has friction, by bristles, in the state.
      pure module integer function mechanism_rubbing_place(self, joint) result(place)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         integer, intent(in) :: joint                  !! its number among those with friction
      end function mechanism_rubbing_place

      !> Deflections of bristles from a state into contacts and joints.
      module subroutine mechanism_take_bristles(self, y)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(:)                     !! (n) state [any]
      end subroutine mechanism_take_bristles

      !> Rates of these deflections, as of the last evaluation.
      module subroutine mechanism_bristle_rates(self, ydot)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(inout) :: ydot(:)            !! (n) derivative of the state [any]
      end subroutine mechanism_bristle_rates

      !> Their scales, for error norms.
      module subroutine mechanism_bristle_weights(self, scale)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(inout) :: scale(:)           !! (n) scales [any]
      end subroutine mechanism_bristle_weights

      !> Entries of the state before those of the state equations.
      pure module integer function mechanism_before_states(self) result(place)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
      end function mechanism_before_states

      !> Values of the state equations at t = 0 into a state whose bodies are there, the first samples taken.
      module subroutine mechanism_begin_states(self, y, error)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self   !! the system
         real(wp), intent(inout) :: y(:)                   !! (n) state [any]
         type(error_t), allocatable, intent(out) :: error  !! a sample is not finite
      end subroutine mechanism_begin_states

      !> Values of the states of state equations, for the loads.
      module subroutine mechanism_take_states(self, y)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: y(:)                     !! (n) state [any]
      end subroutine mechanism_take_states

      !> Rates of the state equations, as of the last evaluation.
      module subroutine mechanism_state_rates(self, t, ydot, status)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: t                     !! time [s]
         real(wp), intent(inout) :: ydot(:)            !! (n) derivative of the state [any]
         integer, intent(out) :: status                !! 0: all are finite
      end subroutine mechanism_state_rates

      !> Error scales of the state equations.
      module subroutine mechanism_state_weights(self, y, scale)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(:)                  !! (n) state [any]
         real(wp), intent(inout) :: scale(:)           !! (n) scales [any]
      end subroutine mechanism_state_weights

      !> Take the samples of state equations that are due.
      module subroutine mechanism_sample_states(self, t, y, error)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self   !! the system
         real(wp), intent(in) :: t                         !! time of the instant [s]
         real(wp), intent(inout) :: y(:)                   !! (n) state [any]
         type(error_t), allocatable, intent(out) :: error  !! a sample is not finite
      end subroutine mechanism_sample_states

      !> Set of a contact and its place there by the number of any of its event functions, of which the first are as the contacts.
      module subroutine mechanism_find_contact(self, number, slot, contact)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         integer, intent(in) :: number                 !! event function: a block in the order of the sets for each kind
         integer, intent(out) :: slot, contact         !! its set, and its number there
      end subroutine mechanism_find_contact

      !> What event k, as things stand, is to a contact.
      module integer function mechanism_contact_change(self, k) result(change)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the mechanism
         integer, intent(in) :: k                      !! number of the event function
      end function mechanism_contact_change

      !> Round-off of the event functions of contacts and turns at the present motion.
      module subroutine mechanism_event_noise(self, noise)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(out) :: noise(:)             !! (n_event) bounds; zero of friction, which has no positions [m or m/s]
      end subroutine mechanism_event_noise

      !> Which parts of the residual depend on which unknowns.
      module subroutine mechanism_dae_pattern(self, column, row)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self    !! the system
         integer, allocatable, intent(out) :: column(:)  !! (n + 2 rows + 1) place of the first entry of each column, from 0
         integer, allocatable, intent(out) :: row(:)     !! (entries) rows, from 0
      end subroutine mechanism_dae_pattern

      !> Entries of the columns of the multipliers.
      module subroutine mechanism_dae_spread(self, values)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         real(wp), intent(out) :: values(:)            !! (n_v for each side of an unknown body) in the order of the pattern [any]
      end subroutine mechanism_dae_spread

      !> Write what the system remembers.
      module subroutine mechanism_save(self, archive)
         implicit none (type, external)
         class(mechanism_state_t), intent(in) :: self  !! the system
         type(archive_t), intent(inout) :: archive     !! the checkpoint
      end subroutine mechanism_save

      !> Read what the system remembers.
      module subroutine mechanism_load(self, archive)
         implicit none (type, external)
         class(mechanism_state_t), intent(inout) :: self  !! the system
         type(archive_t), intent(inout) :: archive        !! the checkpoint
      end subroutine mechanism_load

   end interface

contains

   !> Place in the state of a quadrature of the ledger; of number 0: entries before them.
   pure integer function in_state(self, quadrature) result(place)
      class(mechanism_state_t), intent(in) :: self  !! the system, with a ledger
      integer, intent(in) :: quadrature             !! number of the quadrature, see `contact_places`

      place = self%n - self%n_quadrature + quadrature
   end function in_state

   !> Place in the state of the impulse of a contact.
   pure integer function place_of_impulse(self, contact) result(place)
      class(mechanism_state_t), intent(in) :: self  !! the system of a dynamic analysis
      integer, intent(in) :: contact                !! number of the contact among all

      place = self%n - self%n_impulse + contact
   end function place_of_impulse

   !> Place in the state of the driving work of wear of a contact.
   pure integer function place_of_wear(self, contact) result(place)
      class(mechanism_state_t), intent(in) :: self  !! the system of a dynamic analysis, in which surfaces wear
      integer, intent(in) :: contact                !! number of the contact among all

      place = self%n - self%n_impulse - self%n_wear + contact
   end function place_of_wear

end module mechanism_state
