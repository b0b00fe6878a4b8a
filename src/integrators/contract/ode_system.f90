!> The contract of a system of ordinary differential equations y' = f(t, y) with events.
!>
!> The first `n_position` entries of y are positions, then come their rates. Of `traits%n_turning` bodies that turn in space the
!> positions are three coordinates and four Euler parameters each, the rates three velocities and the angular velocity in the
!> body's frame; what follows them, in the plane all, are positions whose derivatives are the rates. The last `n_quadrature` entries
!> are quadratures, which no derivative depends on. Their errors are measured by a scale of their own (`quadrature_scale`) and count
!> only where they exceed those of the motion. Between, there may be other states.
!> An event function is negative before its event and becomes positive at it. Its last digits are noise: `event_noise` says up to
!> where, for systems whose event functions are small differences of large numbers.
!>
!> Two hooks do nothing unless a system overrides them. `set_step` reports the step about to be made
!> (the gains of some stabilisations follow it). A system that sets `holds` has its `hold` called on
!> every state that an integrator gives out: the end of an accepted step before its derivative is
!> taken, the states tried in search of an event, the states of `refine`. `project_state` is called on a state
!> that did not come from the equations at all, and `contact_change` says which events are onsets and ends of
!> contacts, for integrators that meet onsets in another way (`onset_control`) or suit their steps to both (`step_control`).
!>
!> Local changes: small changes of a state resolved along axes that move with it, so that they stay nearly the same as the motion
!> continues: one displacement or turn for each rate, then the rates, then the other states; quadratures have none. `to_local` and
!> `from_local` lead there and back, and `free_directions` says which of them invariants leave.
module ode_system
   use archive, only: archive_t
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: contact_end, contact_onset, no_contact_change, ode_system_t

   ! what an event is to a contact
   integer, parameter :: no_contact_change = 0   !! nothing
   integer, parameter :: contact_onset = 1       !! its onset
   integer, parameter :: contact_end = 2         !! its end

   !> What a system is like, and what is asked of it.
   type :: ode_traits_t
      integer :: n_turning = 0              !! bodies that turn in space, the first ones
      logical :: follows_step = .false.     !! whether `set_step` changes the derivative
      logical :: has_films = .false.        !! whether films act, whose forces multiply what is wrong of a state
      logical :: sees_diverged = .false.  !! whether `evaluate` itself gives up derivatives that are wild, see `diverged_stages`
      logical :: contact_begins = .false.   !! whether the last event was the onset of a contact
      logical :: with_quadratures = .true.  !! whether quadratures are requested now: else they, or their rates, may be left
      real(wp), allocatable :: quadrature_scale(:)  !! (n_quadrature) scales of their errors; without, no error control [any]
   end type ode_traits_t

   !> A system of ordinary differential equations.
   type, abstract :: ode_system_t
      integer :: n = 0              !! number of entries of y
      integer :: n_position = 0     !! leading entries that are positions
      integer :: n_quadrature = 0   !! trailing entries that are quadratures
      integer :: n_event = 0        !! event functions
      logical :: holds = .false.    !! whether `hold` must be called on the states given out
      type(ode_traits_t) :: traits       !! what the system is like, and asked for
   contains
      procedure(evaluate_interface), deferred :: evaluate
      procedure(weights_interface), deferred :: weights
      procedure(events_interface), deferred :: events
      procedure :: last_events => ode_last_events
      procedure :: settle => ode_settle
      procedure :: event_noise => ode_event_noise
      procedure :: set_step => ode_set_step
      procedure :: hold => ode_stabilise
      procedure :: project_state => ode_project
      procedure :: contact_change => ode_contact_change
      procedure :: to_local => ode_to_local
      procedure :: from_local => ode_from_local
      procedure :: free_directions => ode_free_directions
      procedure :: evaluate_unheld => ode_evaluate_unheld
      procedure :: save => ode_save
      procedure :: load => ode_load
   end type ode_system_t

   abstract interface
      !> Right-hand side. Status: 0 done, > 0 retry with a smaller step, < 0 give up.
      subroutine evaluate_interface(self, t, y, ydot, status)
         import :: ode_system_t, wp
         implicit none (type, external)
         class(ode_system_t), intent(inout) :: self   !! the system
         real(wp), intent(in) :: t                    !! time [s]
         real(wp), intent(in) :: y(self%n)            !! (n) state [any]
         real(wp), intent(out) :: ydot(self%n)        !! (n) its derivative [any]
         integer, intent(out) :: status               !! outcome
      end subroutine evaluate_interface

      !> Natural scale of every entry, for error norms: an error of `tolerance` times this is acceptable.
      subroutine weights_interface(self, y, scale)
         import :: ode_system_t, wp
         implicit none (type, external)
         class(ode_system_t), intent(in) :: self  !! the system
         real(wp), intent(in) :: y(self%n)        !! (n) state [any]
         real(wp), intent(out) :: scale(self%n)   !! (n) positive scales; those of quadratures are not set [any]
      end subroutine weights_interface

      !> Event functions and their rates at a state.
      subroutine events_interface(self, t, y, g, rate)
         import :: ode_system_t, wp
         implicit none (type, external)
         class(ode_system_t), intent(inout) :: self  !! the system
         real(wp), intent(in) :: t                   !! time [s]
         real(wp), intent(in) :: y(:)                !! (n) state [any]
         real(wp), intent(out), contiguous :: g(:)     !! (n_event) event functions [any]
         real(wp), intent(out), contiguous :: rate(:)  !! (n_event) their rates [any]
      end subroutine events_interface
   end interface

contains

   !> Event functions and their rates at the state that was evaluated last; a system that keeps what
   !> it needs for them overrides this.
   subroutine ode_last_events(self, t, y, g, rate)
      class(ode_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                   !! time of the last evaluation [s]
      real(wp), intent(in) :: y(:)                !! (n) its state [any]
      real(wp), intent(out), contiguous :: g(:)     !! (n_event) event functions [any]
      real(wp), intent(out), contiguous :: rate(:)  !! (n_event) their rates [any]

      call self%events(t, y, g, rate)
   end subroutine ode_last_events

   !> Leave the system at a state after events were searched elsewhere; a system that can do that without its event functions
   !> overrides this.
   subroutine ode_settle(self, t, y, g, rate)
      class(ode_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(in) :: y(:)                !! (n) state [any]
      real(wp), intent(inout), contiguous :: g(:)     !! (n_event) scratch [any]
      real(wp), intent(inout), contiguous :: rate(:)  !! (n_event) scratch [any]

      call self%events(t, y, g, rate)
   end subroutine ode_settle

   !> Bounds of the round-off of the event functions near the state that was evaluated last. Zero: it is not known, and less
   !> than matters.
   subroutine ode_event_noise(self, noise)
      class(ode_system_t), intent(in) :: self  !! the system
      real(wp), intent(out) :: noise(:)        !! (n_event) bounds, in the units of the functions [any]

      noise = 0.0_wp
   end subroutine ode_event_noise

   !> A step of length h is about to be made.
   subroutine ode_set_step(self, h)
      class(ode_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: h                   !! length of the step [s]
   end subroutine ode_set_step

   !> Correct a state in place, for instance onto an invariant. Status: 0 done, > 0 retry with a
   !> smaller step, < 0 give up.
   subroutine ode_stabilise(self, t, y, status)
      class(ode_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(inout) :: y(:)             !! (n) state [any]
      integer, intent(out) :: status              !! outcome

      status = 0
   end subroutine ode_stabilise

   !> Bring a state that was made by interpolation onto the invariants, in place. Status as of `hold`, which this is
   !> unless a system holds its states in a weaker way.
   subroutine ode_project(self, t, y, status)
      class(ode_system_t), intent(inout) :: self  !! the system
      real(wp), intent(in) :: t                   !! time [s]
      real(wp), intent(inout) :: y(:)             !! (n) state [any]
      integer, intent(out) :: status              !! outcome

      call self%hold(t, y, status)
   end subroutine ode_project

   !> Write them.
   subroutine ode_save(self, archive)
      class(ode_system_t), intent(in) :: self    !! the system
      type(archive_t), intent(inout) :: archive  !! the checkpoint
   end subroutine ode_save

   !> Read them.
   subroutine ode_load(self, archive)
      class(ode_system_t), intent(inout) :: self  !! the system
      type(archive_t), intent(inout) :: archive   !! the checkpoint
   end subroutine ode_load

   !> What event k, as things stand, is to a contact: its onset, its end, or nothing.
   integer function ode_contact_change(self, k) result(change)
      class(ode_system_t), intent(in) :: self  !! the system
      integer, intent(in) :: k                 !! number of the event function

      change = no_contact_change
   end function ode_contact_change

   !> The local change that a small change of a state is. Without bodies that turn there is no difference.
   subroutine ode_to_local(self, y, change, x)
      class(ode_system_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: y(:)             !! (n) state, quadratures are not read [any]
      real(wp), intent(in) :: change(:)        !! (n less quadratures) its change [any]
      real(wp), intent(out) :: x(:)            !! (n less quadratures and turning bodies) local change [any]

      x = change
   end subroutine ode_to_local

   !> The small change of a state that a local change is: the inverse of `to_local`.
   subroutine ode_from_local(self, y, x, change)
      class(ode_system_t), intent(in) :: self  !! the system
      real(wp), intent(in) :: y(:)             !! (n) state, quadratures are not read [any]
      real(wp), intent(in) :: x(:)             !! (n less quadratures and turning bodies) local change [any]
      real(wp), intent(out) :: change(:)       !! (n less quadratures) change of the state [any]

      change = x
   end subroutine ode_from_local

   !> Directions D of local displacements, and of local rates, that nothing hinders at a state, and how much R^T x of each a
   !> change x has, R^T D = I. A system without invariants has all. Where there are more than storage for them, only their number is
   !> found.
   subroutine ode_free_directions(self, t, y, n, direction, reading)
      class(ode_system_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                    !! time [s]
      real(wp), intent(in) :: y(:)                 !! (n) state [any]
      integer, intent(out) :: n                    !! their number
      real(wp), intent(inout) :: direction(:, :)   !! (rates, room) D, a column each [any]
      real(wp), intent(inout) :: reading(:, :)     !! (rates, room) R, a column each [any]

      integer :: k

      n = size(direction, 1)
      if (n > size(direction, 2)) return
      direction = 0.0_wp
      do k = 1, n
         direction(k, k) = 1.0_wp
      end do
      reading = direction
   end subroutine ode_free_directions

   !> Derivatives of the rates without what holds the invariants; other entries are not set. Where there are none: the derivative.
   subroutine ode_evaluate_unheld(self, t, y, ydot, status)
      class(ode_system_t), intent(inout) :: self   !! the system
      real(wp), intent(in) :: t                    !! time [s]
      real(wp), intent(in) :: y(self%n)            !! (n) state [any]
      real(wp), intent(inout) :: ydot(self%n)      !! (n) derivatives of the rates [any]
      integer, intent(out) :: status               !! outcome

      call self%evaluate(t, y, ydot, status)
   end subroutine ode_evaluate_unheld

end module ode_system
