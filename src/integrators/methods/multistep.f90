!> Multistep methods: steps by a library, events and output on the polynomial of the method.
!>
!> Between the ends of a step the state is the polynomial that the method itself works with (its
!> order, its accuracy), plus a linear term that closes the gaps to the states given out at both ends:
!> at the start there is one of the size of the local error, because each step has its own polynomial;
!> at the end there is one if the state was held.
!>
!> Events: a sign change at the ends of a step is not enough (the libraries' own root finders look no
!> further), so the polynomial is searched as for every method, and the bracket halved on it to
!> round-off. So an event function is zero to round-off at its event, and the time of the event is as
!> accurate as the polynomial. The step ends there; the library starts anew with order 1.
!>
!> A step that contradicts itself is not taken: if an event function becomes positive in it while its own rate says that it falls,
!> the error of the step is more than what the event function has to go. So it is after the end of a contact that parts slowly,
!> where the tolerance allows the first steps, of order 1, an error beyond the depth of the next contact. The step is repeated, a
!> tenth as long, until it is too short to report.
!>
!> Checkpoints: the history is not saved. A run that is loaded starts anew at order 1 at the saved
!> state, so it agrees with the uninterrupted one to the tolerance, not to the last bit.
module multistep
   use archive, only: archive_t
   use event_location, only: find_first_event
   use integrator, only: advance_event, advance_failed_evaluation, advance_no_memory, advance_step, advance_too_many_evaluations, &
      advance_too_many_steps, advance_too_small, integrator_t
   use integration_method, only: abilities_t, steps_variable
   use interpolation, only: interpolate
   use kinds, only: eps, wp
   use ode_system, only: ode_system_t
   use sundials_library, only: library_t
   implicit none (type, external)
   private
   public :: multistep_t

   real(wp), parameter :: tiny_step = 200.0_wp    !! of the spacing of time: too short a stretch for a library to start on [1]
   real(wp), parameter :: shorter = 0.1_wp        !! length of a step that is repeated, of the one before [1]

   !> The last step that a library made.
   type :: library_step_t
      logical :: has_polynomial = .false.   !! whether it is the last step of all, so that its polynomial is one of that
      logical :: is_doubtful = .false.      !! an event function becomes positive in it and falls there, by its rate
      real(wp) :: h_whole = 0.0_wp          !! its length, before an event cut it short [s]
      real(wp), allocatable :: gap_0(:)     !! (n) state given out less polynomial, at its start [any]
      real(wp), allocatable :: gap_1(:)     !! (n) the same at its end [any]
   end type library_step_t

   !> A multistep method.
   type, abstract, extends(integrator_t) :: multistep_t
      class(library_t), allocatable :: library   !! makes the steps
      logical :: is_fresh = .true.               !! the library must start anew
      real(wp) :: first_step = 0.0_wp            !! first step to try when it does, 0: it chooses [s]
      integer :: n_rejected_before = 0           !! steps rejected before the library started anew
      logical :: projects = .false.  !! the library cannot start off the constraints: states between steps are corrected
      type(library_step_t) :: last               !! the library's last step
   contains
      procedure(make_library_interface), deferred :: make_library
      procedure, nopass :: abilities => multistep_abilities
      procedure :: start => multistep_start
      procedure :: advance => multistep_advance
      procedure :: restart => multistep_restart
      procedure :: refine => multistep_refine
      procedure :: prepare_output => multistep_prepare_output
      procedure :: within => multistep_within
      procedure :: load => multistep_load
      procedure :: evaluate_end
      procedure :: held_state
   end type multistep_t

   abstract interface
      !> The library that makes the steps, not started.
      subroutine make_library_interface(self)
         import :: multistep_t
         implicit none (type, external)
         class(multistep_t), intent(inout) :: self  !! the integrator
      end subroutine make_library_interface
   end interface

   interface
      !> Shorten the step so that it ends at an event; one that is none after all is dismissed for the first of the others, or makes
      !> the step doubtful.
      module subroutine go_to_event(self, system, low, high, event, status)
         implicit none (type, external)
         class(multistep_t), intent(inout) :: self     !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(inout) :: low                !! place before the event [1]
         real(wp), intent(inout) :: high               !! place after it [1]
         integer, intent(inout) :: event               !! the event function, then the one that was met
         integer, intent(out) :: status                !! advance_event, advance_step if there is none after all, or a failure
      end subroutine go_to_event
   end interface

contains

   !> Variable steps only; the history of past steps is not saved.
   pure type(abilities_t) function multistep_abilities() result(can)
      can = abilities_t(steps=steps_variable, begins_anew=.true.)
   end function multistep_abilities

   !> Start at a state.
   subroutine multistep_start(self, system, t, y, t_end, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(in) :: t_end                 !! end of the integration [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      call self%make_storage(system)
      if (.not. allocated(self%library)) then
         call self%make_library()
         call self%library%open(system%n)
         allocate (self%last%gap_0(system%n), self%last%gap_1(system%n), source=0.0_wp)
      end if
      self%t = t
      self%step%t0 = t
      self%step%h = 0.0_wp
      self%step%y1 = y
      call self%restart(system, 0.0_wp, status)
      self%first_step = min(self%controls%initial_step, t_end - t)
   end subroutine multistep_start

   !> Evaluate anew at the present state; the library starts anew with the next step. The step hint
   !> suits a method of higher order: order 1 starts with the square root of the tolerance times it.
   subroutine multistep_restart(self, system, step_hint, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: not known [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      self%is_fresh = .true.
      self%library%problem%heeds_quadratures = .true.
      self%first_step = step_hint*sqrt(self%controls%tolerance)
      call self%evaluate_end(system, status)
      status = merge(advance_step, advance_failed_evaluation, status == 0)
   end subroutine multistep_restart

   !> Derivative and event functions at the present state.
   subroutine evaluate_end(self, system, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! of the evaluation

      call system%evaluate(self%t, self%step%y1, self%step%f1, status)
      self%count%n_evaluations = self%count%n_evaluations + 1
      if (status == 0 .and. system%n_event > 0) call system%last_events(self%t, self%step%y1, self%events%g1, self%events%rate1)
   end subroutine evaluate_end

   !> One accepted step, to an event if there is one on the way.
   subroutine multistep_advance(self, system, t_stop, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      do
         call try_step(self, system, t_stop, status)
         if (.not. (self%last%is_doubtful .and. status == advance_step)) return
         call repeat_shorter(self, system, status)
         if (status /= advance_step) return
      end do
   end subroutine multistep_advance

   !> A step, to an event if there is one on the way.
   subroutine try_step(self, system, t_stop, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      real(wp) :: t

      call self%begin_step()
      self%step%y0(:) = self%step%y1  ! no shape is looked at
      self%step%f0(:) = self%step%f1
      self%last%is_doubtful = .false.
      status = advance_step
      associate (controls => self%controls)
         if (controls%maximum_steps > 0 .and. self%count%n_steps >= controls%maximum_steps) status = advance_too_many_steps
         if (controls%maximum_evaluations > 0 .and. self%count%n_evaluations + 1 >= controls%maximum_evaluations) then
            status = advance_too_many_evaluations
         end if
      end associate
      if (status /= advance_step) return
      if (self%is_fresh .and. t_stop - self%t <= tiny_step*eps*max(abs(self%t), abs(t_stop))) then
         ! nothing to be gained by a method: the tangent is exact to round-off
         self%last%has_polynomial = .false.
         self%trial = self%step%y0 + (t_stop - self%t)*self%step%f0
         t = t_stop
      else
         call step_by_library(self, system, t_stop, t, status)
         if (status == advance_too_small .and. self%library%problem%heeds_quadratures) then
            ! errors of quadratures that no shorter step lessens are noise
            self%library%problem%heeds_quadratures = .false.
            self%is_fresh = .true.
            self%first_step = self%last%h_whole*sqrt(self%controls%tolerance)
            call step_by_library(self, system, t_stop, t, status)
         end if
         if (status /= advance_step) return
      end if
      if (system%holds) then
         call system%hold(t, self%trial, status)
         if (status /= 0) then
            status = advance_failed_evaluation
            return
         end if
      end if
      call accept(self, system, t, status)
   end subroutine try_step

   !> Give up the last step: the library starts anew where it started, with a shorter one.
   subroutine repeat_shorter(self, system, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! advance_step, or a failure

      self%count%n_steps = self%count%n_steps - 1
      self%count%n_rejected = self%count%n_rejected + 1
      self%t = self%step%t0
      self%step%y1 = self%step%y0
      self%first_step = shorter*self%last%h_whole
      self%is_fresh = .true.
      call self%evaluate_end(system, status)
      status = merge(advance_step, advance_failed_evaluation, status == 0)
   end subroutine repeat_shorter

   !> One step of the library; the system and the integrator are its problem while it lasts.
   subroutine step_by_library(self, system, t_stop, t, status)
      class(multistep_t), intent(inout), target :: self     !! the integrator
      class(ode_system_t), intent(inout), target :: system  !! the system
      real(wp), intent(in) :: t_stop                        !! not to be passed [s]
      real(wp), intent(out) :: t                            !! time reached; the state goes into `trial` [s]
      integer, intent(out) :: status                        !! advance_step, or a failure

      logical :: is_good

      t = self%t
      call self%library%problem%attend(system, self)
      status = advance_step
      if (self%is_fresh) then
         self%n_rejected_before = int(self%count%n_rejected)
         self%library%problem%is_fatal = .false.
         call self%library%begin(min(self%first_step, t_stop - self%t), is_good)
         if (.not. is_good) status = merge(advance_no_memory, advance_too_small, self%library%problem%lacks_memory)
         self%is_fresh = .not. is_good
      end if
      if (status == advance_step) then
         call system%set_step(self%library%next_step())
         call self%library%step(t_stop, t, self%trial, status)
         ! the libraries continue without moving, and may try again what failed for good
         if (status == advance_step .and. (t <= self%t .or. self%library%problem%is_fatal)) status = self%library%failure()
         self%count%n_rejected = self%n_rejected_before + self%library%n_rejected()
      end if
      self%last%has_polynomial = status == advance_step
      call self%library%problem%attend()
   end subroutine step_by_library

   !> Take the trial state: gaps of the polynomial, derivative, events.
   subroutine accept(self, system, t, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time reached [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      real(wp) :: high, low, place
      integer :: event

      self%t = t
      self%step%h = t - self%step%t0
      self%last%h_whole = self%step%h
      self%step%y1 = self%trial
      if (self%last%has_polynomial) then
         call self%library%look_back(self%step%t0, self%last%gap_0)
         call self%library%look_back(t, self%last%gap_1)
         self%last%gap_0 = self%step%y0 - self%last%gap_0
         self%last%gap_1 = self%step%y1 - self%last%gap_1
      end if
      self%count%n_steps = self%count%n_steps + 1
      call self%evaluate_end(system, status)
      if (status /= 0) then
         ! the last good state stands
         self%t = self%step%t0
         self%step%y1 = self%step%y0
         status = advance_failed_evaluation
         return
      end if
      status = advance_step
      if (system%n_event == 0) return
      call find_first_event(system, self, 0.0_wp, event, low, high, place)
      if (event > 0) call go_to_event(self, system, low, high, event, status)
   end subroutine accept

   !> State at a place of the last step, held or corrected.
   subroutine held_state(self, system, s, y, status)
      class(multistep_t), intent(in) :: self        !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: s                     !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)                 !! (n) state [any]
      integer, intent(out) :: status                !! of holding it

      status = 0
      call self%within(system, s, y)
      if (self%projects) then
         call system%project_state(self%step%t0 + s*self%step%h, y, status)
      else if (system%holds) then
         call system%hold(self%step%t0 + s*self%step%h, y, status)
      end if
   end subroutine held_state

   !> State at a place of the last step, by the polynomial of the method.
   subroutine multistep_within(self, system, s, y)
      class(multistep_t), intent(in) :: self     !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
      real(wp), intent(inout) :: y(system%n)     !! (n) state [any]

      real(wp) :: part

      if (.not. self%last%has_polynomial) then
         call interpolate(self%step, system%n_position, system%traits%n_turning, s, system%n, y)
         return
      end if
      part = s*self%step%h/self%last%h_whole
      call self%library%look_back(self%step%t0 + s*self%step%h, y)
      y = y + (1.0_wp - part)*self%last%gap_0 + part*self%last%gap_1
   end subroutine multistep_within

   !> The polynomial of the method needs no further evaluations.
   subroutine multistep_prepare_output(self, system, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! 0

      status = 0
   end subroutine multistep_prepare_output

   !> State within the last step, held. The polynomial is all that the method has to say of it.
   subroutine multistep_refine(self, system, s, y, status)
      class(multistep_t), intent(inout) :: self     !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: s                     !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)                 !! (n) state [any]
      integer, intent(out) :: status                !! advance_step, or a failure

      call self%held_state(system, s, y, status)
      status = merge(advance_step, advance_failed_evaluation, status == 0)
   end subroutine multistep_refine

   !> Read what the integrator remembers: the library starts anew from there.
   subroutine multistep_load(self, archive)
      class(multistep_t), intent(inout) :: self  !! the integrator
      type(archive_t), intent(inout) :: archive  !! the checkpoint

      call self%load_base(archive)
      self%is_fresh = .true.
      self%first_step = 0.0_wp
      self%last%has_polynomial = .false.
      ! a new library: one that was at work keeps matrices and pivots
      deallocate (self%library)
      call self%make_library()
      call self%library%open(size(self%step%y1))
   end subroutine multistep_load

end module multistep
