!> One-step methods: step control, events by re-stepping, checkpoints. A method adds its stages.
!>
!> A step is accepted if the norm of the error estimate (of the quadratures where it is greater, see `quadrature_error`) is at most
!> TOL; its length is that of `step_control`. Fixed steps have no estimate; only the last one before a stop or an event is shorter.
!>
!> Events: the bracket from the interpolant is closed in on by Newton's iteration on the length of
!> the step, each time by the method itself or, for what little is left, by few stages, so that the event function is zero to
!> round-off and the time of the event is as accurate as the step. Onsets of contacts may be met in other ways: `onset_control`.
module one_step
   use archive, only: archive_t
   use event_location, only: find_first_event
   use event_prediction, only: predict_event
   use exchange, only: swap
   use integrator, only: advance_event, advance_failed_evaluation, advance_step, advance_too_many_evaluations, &
      advance_too_many_steps, advance_too_small, integrator_t
   use integrator_controls, only: onset_located, onset_reject
   use interpolation, only: step_t
   use kinds, only: eps, wp
   use ode_system, only: contact_end, ode_system_t
   use onset_control, only: begin_control, end_controlled_step, is_too_deep, meet_onsets
   use step_control, only: step_control_t
   use stability_limit, only: stability_limit_t
   use diverged_stages, only: is_diverged
   implicit none (type, external)
   private
   public :: one_step_advance, one_step_load, one_step_refine, one_step_restart, one_step_save, one_step_t

   integer, parameter :: too_deep = 2             !! of a trial step: a contact that starts is beyond the limit
   real(wp), parameter :: near_event = 2.0_wp**(-10)  !! what is left of Newton's way to an event on the interpolant: beyond, its
                                                      !! square is what is missing [1]

   !> A one-step method.
   type, abstract, extends(integrator_t) :: one_step_t
      type(step_control_t) :: pace     !! length of the steps
      integer :: order = 1             !! order of the method; the estimate falls as the step to this power
      integer :: n_new_stage = 0       !! evaluations of `make_stages`
      type(stability_limit_t) :: stability   !! whether stability keeps its steps short
   contains
      procedure(prepare_interface), deferred :: prepare
      procedure(stages_interface), deferred :: make_stages
      procedure(norm_interface), deferred :: error_norm
      procedure :: start => one_step_start
      procedure :: advance => one_step_advance
      procedure :: restart => one_step_restart
      procedure :: refine => one_step_refine
      procedure :: fastest_rate => one_step_fastest_rate
      procedure, nopass :: memory_version => one_step_memory_version
      procedure :: save => one_step_save
      procedure :: load => one_step_load
      procedure, private :: make_part
   end type one_step_t

   abstract interface
      !> Storage for the stages; sets `order`, `n_new_stage`, `pace%bends` if time may go as a square (`step_course`), and
      !> `stability%bound` of an explicit method.
      subroutine prepare_interface(self, n)
         import :: one_step_t
         implicit none (type, external)
         class(one_step_t), intent(inout) :: self  !! the integrator
         integer, intent(in) :: n                  !! entries of the state
      end subroutine prepare_interface

      !> Stages of a step of length h from step%t0, step%y0, step%f0; the end state into `trial`.
      subroutine stages_interface(self, system, h, status)
         import :: one_step_t, ode_system_t, wp
         implicit none (type, external)
         class(one_step_t), intent(inout) :: self      !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: h                     !! length of the step [s]
         integer, intent(out) :: status                !! of the evaluations
      end subroutine stages_interface

      !> Norm of the error estimate of the trial step, over the tolerance. Not called for fixed steps.
      function norm_interface(self, system, h) result(norm)
         import :: one_step_t, ode_system_t, wp
         implicit none (type, external)
         class(one_step_t), intent(inout) :: self   !! the integrator
         class(ode_system_t), intent(in) :: system  !! the system
         real(wp), intent(in) :: h                  !! length of the step [s]
         real(wp) :: norm                           !! at most 1: accept [1]
      end function norm_interface
   end interface

   interface
      !> Shorten the step so that it ends at an event; one that is none after all is dismissed for the first of the others.
      module subroutine go_to_event(self, system, high, place, event, status)
         implicit none (type, external)
         class(one_step_t), intent(inout) :: self      !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(inout) :: high               !! place after the event, by the interpolant [1]
         real(wp), intent(inout) :: place              !! where it is, by the interpolant [1]
         integer, intent(inout) :: event               !! the event function, by the interpolant; then the one that was met
         integer, intent(out) :: status                !! advance_event, advance_step if there is none after all, or a failure
      end subroutine go_to_event
   end interface

contains

   !> Start at a state: workspace, first derivative, first step.
   subroutine one_step_start(self, system, t, y, t_end, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(in) :: t_end                 !! end of the integration [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      call self%make_storage(system)
      call self%prepare(system%n)
      self%t = t
      self%step%t0 = t
      self%step%h = 0.0_wp
      self%step%y1 = y
      self%stability = stability_limit_t(bound=self%stability%bound, &
                                         is_watched=self%stability%bound > 0.0_wp .and. self%controls%fixed_step <= 0.0_wp)
      self%pace = step_control_t(order=real(self%order, wp), bends=self%pace%bends .and. self%controls%onset == onset_located)
      call self%restart(system, 0.0_wp, status)
      if (status /= advance_step) return
      self%pace%h_next = self%controls%initial_step
      if (self%controls%fixed_step > 0.0_wp) self%pace%h_next = self%controls%fixed_step
      if (self%pace%h_next <= 0.0_wp) call choose_first_step(self, system, t_end)
   end subroutine one_step_start

   !> First step: where a first-order change would reach a hundredth of the scales, reduced for the tolerance.
   subroutine choose_first_step(self, system, t_end)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_end                 !! end of the integration [s]

      real(wp) :: rate
      integer :: n

      n = system%n - system%n_quadrature
      call system%weights(self%step%y1, self%scale)
      rate = maxval(abs(self%step%f1(1:n))/self%scale(1:n))
      self%pace%h_next = 0.1_wp*(t_end - self%t)
      if (rate <= 0.0_wp) return
      self%pace%h_next = min(self%pace%h_next, self%controls%tolerance**(1.0_wp/real(self%order, wp))/rate)
   end subroutine choose_first_step

   !> Evaluate anew at the present state.
   subroutine one_step_restart(self, system, step_hint, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: as before [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      call system%evaluate(self%t, self%step%y1, self%step%f1, status)
      self%count%n_evaluations = self%count%n_evaluations + 1
      if (status /= 0) then
         status = advance_failed_evaluation
         return
      end if
      status = advance_step
      if (system%n_event > 0) call system%last_events(self%t, self%step%y1, self%events%g1, self%events%rate1)
      if (self%controls%onset /= onset_located) call begin_control(system, self)
      call self%pace%disturb(step_hint, system%traits%contact_begins)
   end subroutine one_step_restart

   !> One accepted step, to an event if there is one on the way.
   subroutine one_step_advance(self, system, t_stop, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      call self%begin_step()
      call exchange_ends(self%step)
      call take_step(self, system, t_stop, status)
      if (status == advance_step) then
         ! before events are searched for, which takes the stages away
         if (self%stability%is_watched) then
            if (self%stability%is_due()) &
               call self%stability%note(self%step%h, self%fastest_rate(system%n - system%n_quadrature), self%t)
         end if
         call finish_step(self, system, status)
      else
         ! the state is where it was
         call exchange_ends(self%step)
         self%step%y0(:) = self%step%y1
         self%step%f0(:) = self%step%f1
      end if
   end subroutine one_step_advance

   !> Rate at which a difference of two states at the end of the step decays or swings; a method that has two overrides this.
   real(wp) function one_step_fastest_rate(self, n) result(rate)
      class(one_step_t), intent(in) :: self  !! the integrator, after a step
      integer, intent(in) :: n               !! entries without quadratures

      rate = 0.0_wp
   end function one_step_fastest_rate

   !> The end of the last step becomes the start of this one; what stands at its end is of no use until the step is accepted.
   pure subroutine exchange_ends(step)
      type(step_t), intent(inout) :: step   !! the step

      call swap(step%y0, step%y1)
      call swap(step%f0, step%f1)
   end subroutine exchange_ends

   !> Try steps until one is accepted.
   subroutine take_step(self, system, t_stop, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      real(wp) :: maximum, h, minimum, norm
      logical :: is_fixed, is_last

      call self%pace%begin()
      is_fixed = self%controls%fixed_step > 0.0_wp
      maximum = huge(1.0_wp)
      minimum = max(self%controls%minimum_step, 4.0_wp*eps*abs(self%step%t0), eps*eps*abs(t_stop))
      do
         call check_limits(self, status)
         if (status /= advance_step) return
         h = self%controls%fixed_step
         if (.not. is_fixed) h = max(self%pace%length(), minimum)
         self%step%course = self%pace%course
         h = min(h, maximum)
         if (self%controls%maximum_step > 0.0_wp) h = min(h, self%controls%maximum_step)
         is_last = self%step%t0 + h*(1.0_wp + 1.0e-10_wp) >= t_stop
         if (is_last) h = t_stop - self%step%t0
         if (.not. is_last .and. merge(t_stop, self%step%t0, is_fixed) + h <= merge(t_stop, self%step%t0, is_fixed)) then
            status = advance_too_small
            return
         end if
         call try_step(self, system, h, merge(t_stop, self%step%t0 + h, is_last), norm, status)
         if (status == 0) exit
         if (status == too_deep) maximum = 0.5_wp*h
         if (status < 0 .or. (is_fixed .and. status /= too_deep)) then
            status = advance_failed_evaluation
            return
         end if
         self%count%n_rejected = self%count%n_rejected + 1
         if (h <= minimum) then
            status = advance_too_small
            return
         end if
         if (status /= too_deep) call self%pace%reject(h, norm)
      end do
      if (.not. is_fixed) call self%pace%accept(h, norm, is_last)
      self%step%h = h
      self%t = merge(t_stop, self%step%t0 + h, is_last)
      call swap(self%step%y1, self%trial)
      status = advance_step
   end subroutine take_step

   !> Whether another step is allowed.
   pure subroutine check_limits(self, status)
      class(one_step_t), intent(in) :: self   !! the integrator
      integer, intent(out) :: status          !! advance_step, or what is used up

      status = advance_step
      associate (controls => self%controls)
         if (controls%maximum_steps > 0 .and. self%count%n_steps >= controls%maximum_steps) then
            status = advance_too_many_steps
         else if (controls%maximum_evaluations > 0 &
                  .and. self%count%n_evaluations + self%n_new_stage + 1 > controls%maximum_evaluations) then
            status = advance_too_many_evaluations
         end if
      end associate
   end subroutine check_limits

   !> A trial step: stages, error test, the state held, its derivative. What fails after the test
   !> belongs to the step too: it is tried again, smaller.
   subroutine try_step(self, system, h, t_new, norm, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      real(wp), intent(in) :: t_new                 !! time at its end [s]
      real(wp), intent(out) :: norm                 !! of the error over the tolerance; huge: not known [1]
      integer, intent(out) :: status                !! 0: accepted; > 0: smaller; < 0: give up

      call tell_step(self, system, h, status)
      if (status == 0) call self%make_stages(system, h, status)
      norm = 0.0_wp
      if (status == 0 .and. self%controls%fixed_step <= 0.0_wp) norm = self%error_norm(system, h)
      if (status == 0 .and. .not. norm <= 1.0_wp) then
         status = 1
         if (.not. norm < huge(1.0_wp)) norm = huge(1.0_wp)  ! a NaN
         return
      end if
      if (status == 0 .and. system%holds) call system%hold(t_new, self%trial, status)
      if (status == 0) then
         call system%evaluate(t_new, self%trial, self%step%f1, status)
         self%count%n_evaluations = self%count%n_evaluations + 1
         if (status == 0 .and. self%controls%fixed_step > 0.0_wp) then
            if (is_diverged(size(self%step%f1), self%step%f1)) status = 1
         end if
      end if
      if (status /= 0) norm = huge(1.0_wp)
      if (status == 0 .and. self%controls%onset == onset_reject) then
         if (is_too_deep(system, self, t_new, self%trial)) status = too_deep
      end if
   end subroutine try_step

   !> Report the system the step. A system that follows it was evaluated at the start just before, also after a step that was
   !> rejected, and its derivative there is the one that belongs to the step.
   subroutine tell_step(self, system, h, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      status = 0
      if (system%traits%follows_step) call system%evaluate(self%step%t0, self%step%y0, self%step%f0, status)
      call system%set_step(h)
      if (status /= 0 .or. .not. system%traits%follows_step) return
      call system%evaluate(self%step%t0, self%step%y0, self%step%f0, status)
      self%count%n_evaluations = self%count%n_evaluations + 2
   end subroutine tell_step

   !> Events within the step.
   subroutine finish_step(self, system, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      real(wp) :: high, low, place
      integer :: event

      self%count%n_steps = self%count%n_steps + 1
      status = advance_step
      if (system%n_event == 0) return
      call system%last_events(self%t, self%step%y1, self%events%g1, self%events%rate1)
      if (self%controls%onset /= onset_located) call end_controlled_step(self)
      call predict_event(self%events, self%step%h, self%pace%h_event, event)
      self%pace%is_parting = .false.
      if (event > 0) self%pace%is_parting = system%contact_change(event) == contact_end
      call find_first_event(system, self, near_event, event, low, high, place)
      if (event > 0) call go_to_event(self, system, high, place, event, status)
      if (self%controls%onset /= onset_located .and. status >= 0) call meet_onsets(system, self, status)
   end subroutine finish_step

   !> The state after a part of the step, held, by the method itself.
   subroutine make_part(self, system, h, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the part [s]
      integer, intent(out) :: status                !! of the evaluations

      call tell_step(self, system, h, status)
      if (status == 0) call self%make_stages(system, h, status)
      if (status == 0 .and. system%holds) call system%hold(self%step%t0 + h, self%trial, status)
   end subroutine make_part

   !> State within the last step by a shorter step of the method.
   subroutine one_step_refine(self, system, s, y, status)
      class(one_step_t), intent(inout) :: self      !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: s                     !! place in the step, 0 to 1 [1]
      real(wp), intent(out) :: y(:)                 !! (n) state [any]
      integer, intent(out) :: status                !! advance_step, or a failure

      call self%make_part(system, s*self%step%h, status)
      if (status /= 0) then
         status = advance_failed_evaluation
         return
      end if
      status = advance_step
      y = self%trial
   end subroutine one_step_refine

   !> Version of the form of what is saved.
   pure integer function one_step_memory_version() result(version)
      version = 3
   end function one_step_memory_version

   !> Write what the integrator remembers.
   subroutine one_step_save(self, archive)
      class(one_step_t), intent(in) :: self      !! the integrator
      type(archive_t), intent(inout) :: archive  !! the checkpoint

      call self%save_base(archive)
      call self%pace%save(archive)
      call self%stability%save(archive)
   end subroutine one_step_save

   !> Read what the integrator remembers.
   subroutine one_step_load(self, archive)
      class(one_step_t), intent(inout) :: self  !! the integrator
      type(archive_t), intent(inout) :: archive !! the checkpoint

      call self%load_base(archive)
      call self%pace%load(archive)
      call self%stability%load(archive)
   end subroutine one_step_load

end module one_step
