!> The contract of integrators.
!>
!> `advance` makes one accepted step, never beyond `t_stop` and never across a located event;
!> then `step` holds both ends of it. After a change of the system (an event handled) `restart`
!> must be called before the next step.
module integrator
   use archive, only: archive_t
   use integrator_controls, only: controls_t, norm_absolute, norm_euclidean, norm_mixed, norm_relative, onset_located
   use integration_method, only: method_t
   use interpolation, only: fit_inner, inner_places, interpolate, step_t
   use kinds, only: i8, wp
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: event_values_t, integrator_prepare_output, integrator_reach, integrator_t, integrator_within, &
      kept_places
   public :: advance_event, advance_failed_evaluation, advance_no_memory, advance_step, advance_too_many_evaluations, &
      advance_too_many_steps, advance_too_small

   integer, parameter :: advance_step = 0                   !! a step was made
   integer, parameter :: advance_event = 1                  !! a step was made, to an event
   integer, parameter :: advance_too_small = -1             !! the step would be smaller than allowed
   integer, parameter :: advance_too_many_steps = -2        !! MXSTEP reached
   integer, parameter :: advance_too_many_evaluations = -3  !! MXFCN reached
   integer, parameter :: advance_failed_evaluation = -4     !! the right-hand side cannot be evaluated
   integer, parameter :: advance_no_memory = -5             !! no memory for the method's matrices

   integer, parameter :: base_version = 2     !! of the form of what every integrator saves
   integer, parameter :: kept_places = 5      !! places of a step that a search keeps at once

   !> Event functions along a step.
   type :: event_values_t
      real(wp) :: look = huge(1.0_wp)           !! farthest that places of a step are apart at which events are searched [s]
      real(wp), allocatable :: g0(:), rate0(:)  !! (n_event) event functions and rates at the start of the last step [any]
      real(wp), allocatable :: g1(:), rate1(:)  !! (n_event) at the present state [any]
      real(wp), allocatable :: g(:), rate(:)    !! (n_event) elsewhere [any]
      real(wp), allocatable :: noise(:)         !! (n_event) their round-off in the last step that was searched [any]
      real(wp), allocatable :: threshold(:)     !! (n_event) what they must exceed in that step to be at their event [any]
      real(wp), allocatable :: kept_g(:, :), kept_rate(:, :)  !! (n_event, kept_places) scratch of a search: at several places [any]
      logical, allocatable :: is_hidden(:)      !! (n_event) event functions that are not searched for now
      integer, allocatable :: happened(:)       !! (n_event) event functions that made the last step end
      integer :: n_happened = 0                 !! how many
   end type event_values_t

   !> Contacts that started and ended within a step and were passed over.
   type :: passed_onsets_t
      integer, allocatable :: n(:)              !! (n_event) how many
      real(wp), allocatable :: first(:)         !! (n_event) when the first of them was deepest [s]
      real(wp), allocatable :: deepest(:)       !! (n_event) maximum value that the event function had in one [any]
      real(wp), allocatable :: at(:)            !! (n_event) when it had that [s]
      real(wp), allocatable :: gap(:), rate(:)  !! (n_event) scratch: event functions and rates at a place of a step [any]
      real(wp), allocatable :: rate_before(:)   !! (n_event) scratch: rates at the place before [any]
      real(wp), allocatable :: top(:), top_at(:)  !! (n_event) scratch: maximum value since it is positive, and when [any, s]
   end type passed_onsets_t

   !> Event functions of onsets that are not located.
   type :: onset_values_t
      real(wp), allocatable :: gap(:)           !! (n_event) event functions, none hidden [any]
      real(wp), allocatable :: rate(:)          !! (n_event) their rates [any]
      real(wp), allocatable :: end_gap(:)       !! (n_event) at the end of the step in hand [any]
      real(wp), allocatable :: end_rate(:)      !! (n_event) their rates there [any]
      logical, allocatable :: is_waiting(:)     !! (n_event) started above zero, no event before below
      type(passed_onsets_t) :: passed           !! contacts that were passed over
   end type onset_values_t

   !> What an integration took.
   type :: step_count_t
      integer(i8) :: n_steps = 0                !! accepted steps
      integer(i8) :: n_rejected = 0             !! rejected steps
      integer(i8) :: n_evaluations = 0          !! evaluations of the right-hand side
      integer(i8) :: n_output_evaluations = 0   !! those of them for interpolation only
   end type step_count_t

   !> An integrator with its state.
   type, abstract, extends(method_t) :: integrator_t
      type(controls_t) :: controls              !! what the user set
      type(step_t) :: step                      !! the last step; its end is the present state
      real(wp) :: t = 0.0_wp                    !! present time [s]
      real(wp), allocatable :: trial(:)         !! (n) state at the end of a trial step [any]
      real(wp), allocatable :: scale(:)         !! (n) error scales [any]
      real(wp), allocatable :: scratch(:)       !! (n) storage for one state [any]
      type(event_values_t) :: events            !! event functions
      type(onset_values_t) :: onset             !! those of onsets, if they are not located
      type(step_count_t) :: count               !! steps and evaluations
   contains
      procedure(start_interface), deferred :: start
      procedure(advance_interface), deferred :: advance
      procedure(restart_interface), deferred :: restart
      procedure(refine_interface), deferred :: refine
      procedure :: prepare_output => integrator_prepare_output
      procedure :: within => integrator_within
      procedure, non_overridable :: state_at => integrator_state_at
      procedure :: reach => integrator_reach
      procedure, nopass :: memory_version => integrator_memory_version
      procedure :: save => integrator_save
      procedure :: load => integrator_load
      procedure :: make_storage, begin_step, look_at_events, hide_events, set_scales
      procedure :: save_base, load_base
   end type integrator_t

   abstract interface
      !> Start at a state.
      subroutine start_interface(self, system, t, y, t_end, status)
         import :: integrator_t, ode_system_t, wp
         implicit none (type, external)
         class(integrator_t), intent(inout) :: self    !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: t                     !! time [s]
         real(wp), intent(in) :: y(:)                  !! (n) state [any]
         real(wp), intent(in) :: t_end                 !! where the integration will end, for the first step [s]
         integer, intent(out) :: status                !! advance_step, or a failure
      end subroutine start_interface

      !> One accepted step. The system's caches are those of its end afterwards.
      subroutine advance_interface(self, system, t_stop, status)
         import :: integrator_t, ode_system_t, wp
         implicit none (type, external)
         class(integrator_t), intent(inout) :: self    !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: t_stop                !! not to be passed [s]
         integer, intent(out) :: status                !! advance_step, advance_event or a failure
      end subroutine advance_interface

      !> The system has changed at the present state.
      subroutine restart_interface(self, system, step_hint, status)
         import :: integrator_t, ode_system_t, wp
         implicit none (type, external)
         class(integrator_t), intent(inout) :: self    !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: as before it started [s]
         integer, intent(out) :: status                !! advance_step, or a failure
      end subroutine restart_interface

      !> The state within the last step as exactly as the method gives it (not by interpolation).
      !> Leaves the integrator as it is; the system's caches are those of the state found.
      subroutine refine_interface(self, system, s, y, status)
         import :: integrator_t, ode_system_t, wp
         implicit none (type, external)
         class(integrator_t), intent(inout) :: self    !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: s                     !! place in the step, 0 to 1 [1]
         real(wp), intent(out) :: y(:)                 !! (n) state [any]
         integer, intent(out) :: status                !! advance_step, or a failure
      end subroutine refine_interface
   end interface

   interface
      !> Write what the integrator remembers.
      module subroutine integrator_save(self, archive)
         implicit none (type, external)
         class(integrator_t), intent(in) :: self    !! the integrator
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine integrator_save

      !> Read what the integrator remembers.
      module subroutine integrator_load(self, archive)
         implicit none (type, external)
         class(integrator_t), intent(inout) :: self  !! the integrator
         type(archive_t), intent(inout) :: archive   !! the checkpoint
      end subroutine integrator_load

      !> Write what every integrator keeps, in a segment of its own; what follows belongs to that of the method.
      module subroutine save_base(self, archive)
         implicit none (type, external)
         class(integrator_t), intent(in) :: self    !! the integrator
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine save_base

      !> Read what every integrator keeps. The last step itself is over: its length is set to zero.
      module subroutine load_base(self, archive)
         implicit none (type, external)
         class(integrator_t), intent(inout) :: self  !! the integrator
         type(archive_t), intent(inout) :: archive   !! the checkpoint
      end subroutine load_base
   end interface

contains

   !> Evaluate the right-hand side at the inner places of the last step, so that `state_at` gains two orders: for the whole step
   !> with quadratures, or without: these are not fitted later on, so who needs them asks before who does not.
   subroutine integrator_prepare_output(self, system, status)
      class(integrator_t), intent(inout) :: self    !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! of the evaluations

      integer :: k, n

      status = 0
      n = system%n
      if (.not. system%traits%with_quadratures) n = n - system%n_quadrature
      if (self%step%has_inner .or. self%step%h <= 0.0_wp) return
      do k = 1, size(inner_places)
         call interpolate(self%step, system%n_position, system%traits%n_turning, inner_places(k), n, self%scratch)
         call system%evaluate(self%step%t0 + inner_places(k)*self%step%h, self%scratch, self%step%inner(:, k), status)
         self%count%n_evaluations = self%count%n_evaluations + 1
         self%count%n_output_evaluations = self%count%n_output_evaluations + 1
         if (status /= 0) return
      end do
      call fit_inner(self%step, system%n_position, system%traits%n_turning, n)
   end subroutine integrator_prepare_output

   !> State at a time within the last step, by interpolation.
   subroutine integrator_state_at(self, system, t, y)
      class(integrator_t), intent(in) :: self    !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(inout) :: y(system%n)     !! (n) state [any]

      if (t >= self%t .or. self%step%h <= 0.0_wp) then
         y = self%step%y1
      else
         call self%within(system, (t - self%step%t0)/self%step%h, y)
      end if
   end subroutine integrator_state_at

   !> The same as rows report it: by interpolation too, as good as it gets; what cannot be evaluated between is interpolated without
   !> it. A method whose interpolation is not good enough for stiff forces overrides this.
   subroutine integrator_reach(self, system, t, y)
      class(integrator_t), intent(inout) :: self    !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(inout) :: y(system%n)        !! (n) state [any]

      integer :: status

      if (t < self%t .and. .not. self%step%has_inner) call self%prepare_output(system, status)
      call self%state_at(system, t, y)
   end subroutine integrator_reach

   !> State at a place of the last step, by interpolation; quadratures that nobody needs are left alone.
   subroutine integrator_within(self, system, s, y)
      class(integrator_t), intent(in) :: self    !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
      real(wp), intent(inout) :: y(system%n)     !! (n) state [any]

      integer :: n

      n = system%n
      if (.not. system%traits%with_quadratures) n = n - system%n_quadrature
      call interpolate(self%step, system%n_position, system%traits%n_turning, s, n, y)
   end subroutine integrator_within

   !> Storage for states and event functions, made once.
   subroutine make_storage(self, system)
      class(integrator_t), intent(inout) :: self  !! the integrator
      class(ode_system_t), intent(in) :: system   !! the system

      integer :: m, n

      if (allocated(self%scratch)) return
      n = system%n
      m = system%n_event
      allocate (self%step%y0(n), self%step%y1(n), self%step%f0(n), self%step%f1(n), self%step%inner(n, 2), source=0.0_wp)
      allocate (self%trial(n), self%scale(n), self%scratch(n), source=0.0_wp)
      associate (events => self%events, onset => self%onset)
         allocate (events%g0(m), events%rate0(m), events%g1(m), events%rate1(m), events%g(m), events%rate(m), source=0.0_wp)
         allocate (events%noise(m), events%threshold(m), source=0.0_wp)
         allocate (events%kept_g(m, kept_places), events%kept_rate(m, kept_places), source=0.0_wp)
         allocate (onset%gap(m), onset%rate(m), onset%end_gap(m), onset%end_rate(m), source=0.0_wp)
         allocate (events%is_hidden(m), onset%is_waiting(m), source=.false.)
         allocate (events%happened(m), onset%passed%n(m), source=0)
      end associate
      associate (passed => self%onset%passed)
         allocate (passed%first(m), passed%deepest(m), passed%at(m), source=0.0_wp)
         allocate (passed%gap(m), passed%rate(m), passed%rate_before(m), passed%top(m), passed%top_at(m), source=0.0_wp)
      end associate
   end subroutine make_storage

   !> The present time, and the events there, become the start of the next step; the state is the method's to take over.
   subroutine begin_step(self)
      class(integrator_t), intent(inout) :: self  !! the integrator

      integer :: k

      self%events%n_happened = 0
      self%step%t0 = self%t
      do k = 1, size(self%events%g1)
         self%events%g0(k) = self%events%g1(k)
         self%events%rate0(k) = self%events%rate1(k)
      end do
      self%step%has_inner = .false.
   end subroutine begin_step

   !> Event functions less their thresholds, and their rates, at a state, for a search.
   subroutine look_at_events(self, system, t, y, g, rate)
      class(integrator_t), intent(in) :: self       !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(out), contiguous :: g(:)     !! (n_event) event functions less their thresholds [any]
      real(wp), intent(out), contiguous :: rate(:)  !! (n_event) their rates [any]

      integer :: k

      call system%events(t, y, g, rate)
      if (self%controls%onset /= onset_located) call self%hide_events(g, rate)
      do k = 1, size(g)
         g(k) = g(k) - self%events%threshold(k)
      end do
   end subroutine look_at_events

   !> Functions that are not searched for look as if they were far from their event, and stayed there; where onsets are located
   !> there are none.
   pure subroutine hide_events(self, g, rate)
      class(integrator_t), intent(in) :: self       !! the integrator
      real(wp), intent(inout) :: g(:)               !! (n_event) event functions [any]
      real(wp), intent(inout) :: rate(:)            !! (n_event) their rates [any]

      where (self%events%is_hidden)
         g = -1.0_wp
         rate = 0.0_wp
      end where
   end subroutine hide_events

   !> What the error of each entry is divided by in the norm, into `scale`; quadratures are left alone.
   subroutine set_scales(self, system, y)
      class(integrator_t), intent(inout) :: self  !! the integrator
      class(ode_system_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: y(system%n)         !! (n) state [any]

      integer :: n

      n = system%n - system%n_quadrature
      select case (self%controls%norm)
      case (norm_mixed, norm_euclidean)
         self%scale(1:n) = max(abs(y(1:n)), 1.0_wp)
      case (norm_absolute)
         self%scale(1:n) = 1.0_wp
      case (norm_relative)
         self%scale(1:n) = max(abs(y(1:n)), self%controls%floor)
      case default
         call system%weights(y, self%scale)
      end select
   end subroutine set_scales

   !> Version of the form of what the method adds; one that changes what it saves says so.
   pure integer function integrator_memory_version() result(version)
      version = 1
   end function integrator_memory_version

end module integrator
