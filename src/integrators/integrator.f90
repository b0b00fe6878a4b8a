!> The contract of integrators, and their controls.
!>
!> `advance` makes one accepted step, never beyond `t_stop` and never across a located event;
!> then `step` holds both ends of it. After a change of the system (an event handled) `restart`
!> must be called before the next step.
!>
!> The controls carry the names of IMSL's IVPRK (Hull, Enright and Jackson's DVERK) beside plain
!> ones: TOL tolerance, HINIT initial_step, HMIN minimum_step, HMAX maximum_step, MXSTEP
!> maximum_steps, MXFCN maximum_evaluations, INORM norm, FLOOR floor.
module integrator
   use interpolation, only: inner_places, interpolate, step_t
   use item, only: item_t, place_of
   use kind_info, only: add_number, add_word, dim_none, dim_time, kind_info_t
   use kinds, only: i8, least_tolerance, wp
   use memory, only: get, put
   use ode_system, only: ode_system_t
   implicit none (type, external)
   private
   public :: add_control_columns, controls_t, integrator_t, read_controls
   public :: advance_event, advance_failed_evaluation, advance_no_memory, advance_step, advance_too_many_evaluations
   public :: advance_too_many_steps, advance_too_small
   public :: onset_interpolate, onset_located, onset_reject, onset_uncontrolled
   public :: norm_absolute, norm_euclidean, norm_mixed, norm_relative, norm_scaled
   public :: steps_any, steps_fixed, steps_variable

   integer, parameter :: advance_step = 0                   !! a step was made
   integer, parameter :: advance_event = 1                  !! a step was made, to an event
   integer, parameter :: advance_too_small = -1             !! the step would be smaller than allowed
   integer, parameter :: advance_too_many_steps = -2        !! MXSTEP reached
   integer, parameter :: advance_too_many_evaluations = -3  !! MXFCN reached
   integer, parameter :: advance_failed_evaluation = -4     !! the right-hand side cannot be evaluated
   integer, parameter :: advance_no_memory = -5             !! no memory for the method's matrices

   integer, parameter :: norm_mixed = 0       !! IMSL INORM = 0: |e| / max(|y|, 1), greatest entry
   integer, parameter :: norm_absolute = 1    !! IMSL INORM = 1: |e|, greatest entry
   integer, parameter :: norm_relative = 2    !! IMSL INORM = 2: |e| / max(|y|, FLOOR), greatest entry
   integer, parameter :: norm_euclidean = 3   !! IMSL INORM = 3: root of the sum of squares of |e| / max(|y|, 1)
   integer, parameter :: norm_scaled = -1     !! |e| over the natural scale of the entry, greatest entry

   integer, parameter :: steps_any = 0        !! fixed steps, or variable ones
   integer, parameter :: steps_fixed = 1      !! fixed steps only
   integer, parameter :: steps_variable = 2   !! variable steps only

   integer, parameter :: onset_located = 0       !! onsets of contacts are located, as all events
   integer, parameter :: onset_interpolate = 1   !! linear interpolation back to the onset
   integer, parameter :: onset_reject = 2        !! steps that penetrate more than a limit are halved
   integer, parameter :: onset_uncontrolled = 3  !! a contact begins where the step ends that finds it

   real(wp), parameter :: default_limit = 1.0e-7_wp  !! penetration at an onset found by rejection [m]

   !> What a user may set.
   type :: controls_t
      real(wp) :: tolerance = 1.0e-8_wp        !! TOL: local error allowed in the norm [1]
      real(wp) :: fixed_step = 0.0_wp          !! length of fixed steps, 0: variable steps [s]
      real(wp) :: initial_step = 0.0_wp        !! HINIT: first step tried, 0: chosen [s]
      real(wp) :: minimum_step = 0.0_wp        !! HMIN: least step, 0: what arithmetic allows [s]
      real(wp) :: maximum_step = 0.0_wp        !! HMAX: greatest step, 0: no limit [s]
      integer(i8) :: maximum_steps = 0         !! MXSTEP: accepted steps allowed, 0: no limit
      integer(i8) :: maximum_evaluations = 0   !! MXFCN: evaluations allowed, 0: no limit
      integer :: norm = norm_scaled            !! INORM: error norm, one of the above
      real(wp) :: floor = 1.0_wp               !! FLOOR: of the relative norm [any]
      integer :: onset = onset_located         !! how onsets of contacts are met, one of the above
      real(wp) :: onset_limit = default_limit  !! greatest penetration at an onset with `onset_reject` [m]
   end type controls_t

   real(wp), parameter :: most_counted = 9.0e18_wp  !! steps or evaluations that can be counted [1]

   !> An integrator with its state.
   type, abstract :: integrator_t
      type(controls_t) :: controls              !! what the user set
      type(step_t) :: step                      !! the last step; its end is the present state
      real(wp) :: t = 0.0_wp                    !! present time [s]
      real(wp) :: look = huge(1.0_wp)           !! farthest that places of a step are apart at which events are looked for [s]
      real(wp), allocatable :: trial(:)         !! (n) state at the end of a trial step [any]
      real(wp), allocatable :: scale(:)         !! (n) error scales [any]
      real(wp), allocatable :: scratch(:)       !! (n) room for one state [any]
      real(wp), allocatable :: g0(:), rate0(:)  !! (n_event) event functions and rates at the start of the last step [any]
      real(wp), allocatable :: g1(:), rate1(:)  !! (n_event) at the present state [any]
      real(wp), allocatable :: g(:), rate(:)    !! (n_event) elsewhere [any]
      real(wp), allocatable :: noise(:)         !! (n_event) their round-off in the last step that was searched [any]
      real(wp), allocatable :: threshold(:)     !! (n_event) what they must exceed in that step to be at their event [any]
      logical, allocatable :: is_hidden(:)      !! (n_event) event functions that are not searched for now
      real(wp), allocatable :: gap(:)           !! (n_event) with onsets not located: event functions, none hidden [any]
      real(wp), allocatable :: end_gap(:)       !! (n_event) with onsets not located: at the end of the step in hand [any]
      real(wp), allocatable :: end_rate(:)      !! (n_event) with onsets not located: their rates there [any]
      logical, allocatable :: is_waiting(:)     !! (n_event) with onsets not located: began above zero, no event before below
      integer, allocatable :: happened(:)       !! (n_event) event functions that made the last step end
      integer :: n_happened = 0                 !! how many
      integer(i8) :: n_steps = 0                !! accepted steps
      integer(i8) :: n_rejected = 0             !! rejected steps
      integer(i8) :: n_evaluations = 0          !! evaluations of the right-hand side
      integer(i8) :: n_output_evaluations = 0   !! those of them for interpolation only
   contains
      procedure(info_interface), nopass, deferred :: info
      procedure(start_interface), deferred :: start
      procedure(advance_interface), deferred :: advance
      procedure(restart_interface), deferred :: restart
      procedure(refine_interface), deferred :: refine
      procedure, nopass :: steps => integrator_steps
      procedure :: prepare_output => integrator_prepare_output
      procedure :: within => integrator_within
      procedure :: state_at => integrator_state_at
      procedure :: memory_size => integrator_memory_size
      procedure :: save => integrator_save
      procedure :: load => integrator_load
      procedure :: make_room
      procedure :: begin_step
      procedure :: look_at_events
      procedure :: hide_events
      procedure :: set_scales
      procedure :: base_memory_size
      procedure :: save_base
      procedure :: load_base
   end type integrator_t

   abstract interface
      !> What the method says of itself.
      function info_interface() result(info)
         import :: kind_info_t
         implicit none (type, external)
         type(kind_info_t) :: info  !! name and help
      end function info_interface

      !> Begin at a state.
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
         real(wp), intent(in) :: step_hint             !! step that suits what begins now; 0: as before it began [s]
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

contains

   !> Evaluate the right-hand side at the inner places of the last step, so that `state_at` gains two orders.
   subroutine integrator_prepare_output(self, system, status)
      class(integrator_t), intent(inout) :: self    !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! of the evaluations

      integer :: k

      status = 0
      if (self%step%has_inner .or. self%step%h <= 0.0_wp) return
      do k = 1, size(inner_places)
         call interpolate(self%step, system%n_position, inner_places(k), self%scratch)
         call system%evaluate(self%step%t0 + inner_places(k)*self%step%h, self%scratch, self%step%inner(:, k), status)
         self%n_evaluations = self%n_evaluations + 1
         self%n_output_evaluations = self%n_output_evaluations + 1
         if (status /= 0) return
      end do
      self%step%has_inner = .true.
   end subroutine integrator_prepare_output

   !> State at a time within the last step, by interpolation.
   subroutine integrator_state_at(self, system, t, y)
      class(integrator_t), intent(in) :: self    !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: t                  !! time [s]
      real(wp), intent(out) :: y(:)              !! (n) state [any]

      if (t >= self%t .or. self%step%h <= 0.0_wp) then
         y = self%step%y1
      else
         call self%within(system, (t - self%step%t0)/self%step%h, y)
      end if
   end subroutine integrator_state_at

   !> State at a place of the last step, by interpolation.
   subroutine integrator_within(self, system, s, y)
      class(integrator_t), intent(in) :: self    !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)              !! (n) state [any]

      call interpolate(self%step, system%n_position, s, y)
   end subroutine integrator_within

   !> Which steps a method makes.
   pure integer function integrator_steps() result(steps)
      steps = steps_any
   end function integrator_steps

   !> Room for states and event functions, made once.
   subroutine make_room(self, system)
      class(integrator_t), intent(inout) :: self  !! the integrator
      class(ode_system_t), intent(in) :: system   !! the system

      integer :: m, n

      if (allocated(self%scratch)) return
      n = system%n
      m = system%n_event
      allocate (self%step%y0(n), self%step%y1(n), self%step%f0(n), self%step%f1(n), self%step%inner(n, 2), source=0.0_wp)
      allocate (self%trial(n), self%scale(n), self%scratch(n), source=0.0_wp)
      allocate (self%g0(m), self%rate0(m), self%g1(m), self%rate1(m), self%g(m), self%rate(m), source=0.0_wp)
      allocate (self%noise(m), self%threshold(m), self%gap(m), self%end_gap(m), self%end_rate(m), source=0.0_wp)
      allocate (self%is_hidden(m), self%is_waiting(m), source=.false.)
      allocate (self%happened(m), source=0)
   end subroutine make_room

   !> The present state becomes the start of the next step.
   subroutine begin_step(self)
      class(integrator_t), intent(inout) :: self  !! the integrator

      self%n_happened = 0
      self%step%t0 = self%t
      self%step%y0 = self%step%y1
      self%step%f0 = self%step%f1
      self%g0 = self%g1
      self%rate0 = self%rate1
      self%step%has_inner = .false.
   end subroutine begin_step

   !> Event functions less their thresholds, and their rates, at a state, for a search.
   subroutine look_at_events(self, system, t, y, g, rate)
      class(integrator_t), intent(in) :: self       !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(out) :: g(:)                 !! (n_event) event functions less their thresholds [any]
      real(wp), intent(out) :: rate(:)              !! (n_event) their rates [any]

      call system%events(t, y, g, rate)
      call self%hide_events(g, rate)
      g = g - self%threshold
   end subroutine look_at_events

   !> Functions that are not searched for look as if they were far from their event, and stayed there.
   pure subroutine hide_events(self, g, rate)
      class(integrator_t), intent(in) :: self       !! the integrator
      real(wp), intent(inout) :: g(:)               !! (n_event) event functions [any]
      real(wp), intent(inout) :: rate(:)            !! (n_event) their rates [any]

      if (self%controls%onset == onset_located) return
      where (self%is_hidden)
         g = -1.0_wp
         rate = 0.0_wp
      end where
   end subroutine hide_events

   !> What the error of each entry is divided by in the norm, into `scale`; quadratures are left alone.
   subroutine set_scales(self, system, y)
      class(integrator_t), intent(inout) :: self  !! the integrator
      class(ode_system_t), intent(in) :: system   !! the system
      real(wp), intent(in) :: y(:)                !! (n) state [any]

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

   !> Numbers that a checkpoint needs; a method that remembers more adds to it.
   integer function integrator_memory_size(self) result(n)
      class(integrator_t), intent(in) :: self  !! the integrator

      n = self%base_memory_size()
   end function integrator_memory_size

   !> Write what the integrator remembers.
   subroutine integrator_save(self, row, place)
      class(integrator_t), intent(in) :: self  !! the integrator
      real(wp), intent(inout) :: row(:)        !! (any) checkpoint [any]
      integer, intent(inout) :: place          !! last place used

      call self%save_base(row, place)
   end subroutine integrator_save

   !> Read what the integrator remembers.
   subroutine integrator_load(self, row, place)
      class(integrator_t), intent(inout) :: self  !! the integrator
      real(wp), intent(in) :: row(:)              !! (any) checkpoint [any]
      integer, intent(inout) :: place             !! last place used

      call self%load_base(row, place)
   end subroutine integrator_load

   !> Numbers that every integrator keeps: time, state, derivative, event functions and counters.
   integer function base_memory_size(self) result(n)
      class(integrator_t), intent(in) :: self  !! the integrator

      n = 5 + 2*size(self%step%y1) + 5*size(self%g1)
   end function base_memory_size

   !> Write what every integrator keeps.
   subroutine save_base(self, row, place)
      class(integrator_t), intent(in) :: self  !! the integrator
      real(wp), intent(inout) :: row(:)        !! (any) checkpoint [any]
      integer, intent(inout) :: place          !! last place used

      integer :: k

      call put(row, place, self%t)
      call put(row, place, self%n_steps)
      call put(row, place, self%n_rejected)
      call put(row, place, self%n_evaluations)
      call put(row, place, self%n_output_evaluations)
      call put(row, place, self%step%y1)
      call put(row, place, self%step%f1)
      call put(row, place, self%g1)
      call put(row, place, self%rate1)
      call put(row, place, self%gap)
      do k = 1, size(self%g1)
         call put(row, place, self%is_hidden(k))
         call put(row, place, self%is_waiting(k))
      end do
   end subroutine save_base

   !> Read what every integrator keeps. The last step itself is over: its length is set to zero.
   subroutine load_base(self, row, place)
      class(integrator_t), intent(inout) :: self  !! the integrator
      real(wp), intent(in) :: row(:)              !! (any) checkpoint [any]
      integer, intent(inout) :: place             !! last place used

      integer :: k

      call get(row, place, self%t)
      call get(row, place, self%n_steps)
      call get(row, place, self%n_rejected)
      call get(row, place, self%n_evaluations)
      call get(row, place, self%n_output_evaluations)
      call get(row, place, self%step%y1)
      call get(row, place, self%step%f1)
      call get(row, place, self%g1)
      call get(row, place, self%rate1)
      call get(row, place, self%gap)
      do k = 1, size(self%g1)
         call get(row, place, self%is_hidden(k))
         call get(row, place, self%is_waiting(k))
      end do
      self%step%t0 = self%t
      self%step%h = 0.0_wp
      self%step%has_inner = .false.
      self%n_happened = 0
   end subroutine load_base

   !> The deck columns of the controls.
   subroutine add_control_columns(info)
      type(kind_info_t), intent(inout) :: info  !! settings of an analysis

      call add_number(info, "tolerance", dim_none, "local error allowed (TOL), relative to the mechanism's size and speed", &
                      default="1e-8", lower=least_tolerance, upper=0.01_wp)
      call add_number(info, "step", dim_time, "length of fixed steps; 0: variable steps", default="0 s", lower=0.0_wp)
      call add_number(info, "initial_step", dim_time, "first step tried; 0: chosen", default="0 s", lower=0.0_wp)
      call add_number(info, "minimum_step", dim_time, "least step; 0: what arithmetic allows", default="0 s", lower=0.0_wp)
      call add_number(info, "maximum_step", dim_time, "greatest step; 0: no limit", default="0 s", lower=0.0_wp)
      call add_number(info, "maximum_steps", dim_none, "accepted steps allowed; 0: no limit", default="0", lower=0.0_wp, &
                      upper=most_counted)
      call add_number(info, "maximum_evaluations", dim_none, "evaluations of the right-hand side allowed; 0: no limit", &
                      default="0", lower=0.0_wp, upper=most_counted)
      call add_word(info, "norm", "error norm: over natural scales (scaled), or as INORM: mixed 0, absolute 1, relative 2, " &
                    //"euclidean 3", default="scaled", choices="scaled mixed absolute relative euclidean")
      call add_number(info, "floor", dim_none, "least |y| in the relative norm (FLOOR)", default="1", lower=0.0_wp, &
                      open_lower=.true.)
      call add_word(info, "contact_onset", "how the onset of a contact is met: located (on the onset, to round-off); interpolate " &
                    //"(linearly back to it after a step that penetrates); reject (steps that penetrate more than limit are " &
                    //"halved, default limit=0.1um); uncontrolled (at the end of the step that finds it)", default="located", &
                    choices="located interpolate reject uncontrolled", options="limit")
      call add_number(info, "tol", dim_none, "IMSL name of tolerance; 0: not given", default="0", lower=0.0_wp, &
                      upper=0.01_wp)
      call add_number(info, "hinit", dim_time, "IMSL name of initial_step", default="0 s", lower=0.0_wp)
      call add_number(info, "hmin", dim_time, "IMSL name of minimum_step", default="0 s", lower=0.0_wp)
      call add_number(info, "hmax", dim_time, "IMSL name of maximum_step", default="0 s", lower=0.0_wp)
      call add_number(info, "mxstep", dim_none, "IMSL name of maximum_steps", default="0", lower=0.0_wp, &
                      upper=most_counted)
      call add_number(info, "mxfcn", dim_none, "IMSL name of maximum_evaluations", default="0", lower=0.0_wp, &
                      upper=most_counted)
      call add_number(info, "inorm", dim_none, "IMSL number of the norm, 0 to 3; -1: the word of norm", default="-1", &
                      lower=-1.0_wp, upper=3.0_wp)
   end subroutine add_control_columns

   !> The controls from a section of settings that has the columns of `add_control_columns`; the scene
   !> has folded IMSL's names into the plain ones.
   subroutine read_controls(item, controls)
      type(item_t), intent(in) :: item           !! the section
      type(controls_t), intent(out) :: controls  !! the controls

      integer :: k

      controls%tolerance = item%number("tolerance")
      controls%fixed_step = item%number("step")
      controls%initial_step = item%number("initial_step")
      controls%minimum_step = item%number("minimum_step")
      controls%maximum_step = item%number("maximum_step")
      controls%maximum_steps = int(item%number("maximum_steps"), i8)
      controls%maximum_evaluations = int(item%number("maximum_evaluations"), i8)
      controls%floor = item%number("floor")
      select case (item%word("norm"))
      case ("mixed"); controls%norm = norm_mixed
      case ("absolute"); controls%norm = norm_absolute
      case ("relative"); controls%norm = norm_relative
      case ("euclidean"); controls%norm = norm_euclidean
      case default; controls%norm = norm_scaled
      end select
      associate (value => item%values(place_of(item, "contact_onset")))
         select case (value%text)
         case ("interpolate"); controls%onset = onset_interpolate
         case ("reject"); controls%onset = onset_reject
         case ("uncontrolled"); controls%onset = onset_uncontrolled
         case default; controls%onset = onset_located
         end select
         if (allocated(value%options)) then
            do k = 1, size(value%options)
               controls%onset_limit = value%options(k)%number
            end do
         end if
      end associate

   end subroutine read_controls

end module integrator
