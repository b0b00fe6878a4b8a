!> The method of integration chosen as the motion continues: explicit, or implicit where the equations are stiff.
!>
!> Explicit steps are those of `dop853`, of order 8, at tolerances up to `order_8_up_to`, and of `verner`, of order 6, at looser
!> ones: to the bit those of that method, as long as no others are made. Where stability, not accuracy, keeps them short
!> (`stability_limit`), and now and then in any case, Radau IIA (`radau`) is tried; it makes the next steps where it needs fewer
!> evaluations for the same stretch of time (`method_choice`, `method_trial`). The explicit method comes back in the same way.
!> Counts of evaluations decide, never the clock.
!>
!> The parts share one state: while the implicit part makes a step, or is asked about its last one, it is lent what every
!> integrator keeps.
!>
!> Source: L. Petzold, Automatic selection of methods for solving stiff and nonstiff systems of ordinary differential
!> equations, SIAM J. Sci. Stat. Comput. 4 (1983) 136-148; E. Hairer and G. Wanner, Solving Ordinary Differential Equations II,
!> 2nd ed. (1996), section IV.2. Limits: fixed steps, and onsets of contacts that are not located, are those of `verner`.
module auto
   use archive, only: archive_t
   use dop853, only: dop853_t
   use dop853_stages, only: dop853_bound, dop853_stages_t
   use integrator, only: advance_failed_evaluation, advance_no_memory, advance_step, advance_too_small
   use integration_method, only: abilities_t
   use integrator_controls, only: controls_t, norm_euclidean, onset_located
   use kind_info, only: kind_info_t
   use kinds, only: i8, wp
   use method_choice, only: method_choice_t
   use method_trial, only: run_trial, trial_t
   use ode_system, only: ode_system_t
   use one_step, only: one_step_advance, one_step_restart, one_step_t
   use quadrature_error, only: counts_quadratures
   use radau, only: radau_t
   use step_control, only: step_control_t
   use verner, only: verner_bound, verner_stages_t, verner_t
   implicit none (type, external)
   private
   public :: auto_t, order_8_up_to

   real(wp), parameter :: order_8_up_to = 1.0e-8_wp  !! tolerance at and below which explicit steps are of order 8 [1]
   integer, parameter :: n_trial_step(2) = [16, 10]  !! (implicit, explicit) steps of a trial

   !> The method, with its parts.
   type, extends(one_step_t) :: auto_t
      private
      logical :: is_eighth = .false.              !! whether explicit steps are of order 8
      logical :: can_change = .false.             !! whether the implicit method may be chosen
      logical :: is_implicit = .false.            !! whether the last step was one of the implicit method
      type(method_choice_t), public :: choice     !! what the next one is
      type(verner_stages_t) :: six                !! explicit stages of order 6
      type(dop853_stages_t) :: eight              !! explicit stages of order 8
      type(radau_t), allocatable :: stiff         !! the implicit method, once it was chosen
      real(wp), allocatable :: saved(:)           !! (any) what a checkpoint holds of it, until it is there [any]
   contains
      procedure, nopass :: info => auto_info
      procedure :: is_explicit => auto_is_explicit
      procedure :: prepare => auto_prepare
      procedure :: make_stages => auto_make_stages
      procedure :: error_norm => auto_error_norm
      procedure :: fastest_rate => auto_fastest_rate
      procedure :: advance => auto_advance
      procedure :: restart => auto_restart
      procedure :: refine => auto_refine
      procedure :: prepare_output => auto_prepare_output
      procedure :: within => auto_within
      procedure :: reach => auto_reach
      procedure, nopass :: memory_version => auto_memory_version
      procedure :: save => auto_save
      procedure :: load => auto_load
      procedure, nopass :: abilities => auto_abilities
      procedure :: words => auto_says
      procedure :: trial_evaluations => auto_trial_evaluations
   end type auto_t

   interface
      !> State within the last step by a shorter step of the method that made it.
      module subroutine auto_refine(self, system, s, y, status)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self          !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: s                     !! place in the step, 0 to 1 [1]
         real(wp), intent(out) :: y(:)                 !! (n) state [any]
         integer, intent(out) :: status                !! advance_step, or a failure
      end subroutine auto_refine

      !> What interpolation in the last step needs.
      module subroutine auto_prepare_output(self, system, status)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self          !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         integer, intent(out) :: status                !! of the evaluations
      end subroutine auto_prepare_output

      !> State at a place of the last step, by interpolation.
      module subroutine auto_within(self, system, s, y)
         implicit none (type, external)
         class(auto_t), intent(in) :: self          !! the integrator
         class(ode_system_t), intent(in) :: system  !! the system
         real(wp), intent(in) :: s                  !! place in the step, 0 to 1 [1]
         real(wp), intent(inout) :: y(system%n)     !! (n) state [any]
      end subroutine auto_within

      !> State at a time within the last step as rows report it.
      module subroutine auto_reach(self, system, t, y)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self          !! the integrator
         class(ode_system_t), intent(inout) :: system  !! the system
         real(wp), intent(in) :: t                     !! time [s]
         real(wp), intent(inout) :: y(system%n)        !! (n) state [any]
      end subroutine auto_reach

      !> Evaluations of trials of the implicit method.
      pure integer(i8) module function auto_trial_evaluations(self) result(n)
         implicit none (type, external)
         class(auto_t), intent(in) :: self      !! the integrator, after a run
      end function auto_trial_evaluations

      !> What it can do.
      pure module function auto_abilities() result(can)
         implicit none (type, external)
         type(abilities_t) :: can               !! it makes steps of others
      end function auto_abilities

      !> What there is to choose from, by the controls; or what was chosen, when and why.
      module function auto_says(self, has_run) result(words)
         implicit none (type, external)
         class(auto_t), intent(in) :: self      !! the integrator, with its controls
         logical, intent(in) :: has_run         !! after a run
         character(:), allocatable :: words     !! part of a line
      end function auto_says

      !> The implicit part gets what every integrator keeps; it is made when it is requested first.
      module subroutine lend_state(self, system, status)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self       !! the integrator
         class(ode_system_t), intent(in) :: system  !! the system
         integer, intent(out) :: status             !! advance_step, or a failure
      end subroutine lend_state

      !> The controls of the implicit method.
      pure module function implicit_controls(self, system) result(controls)
         implicit none (type, external)
         class(auto_t), intent(in) :: self          !! the integrator
         class(ode_system_t), intent(in) :: system  !! the system
         type(controls_t) :: controls               !! those of its steps
      end function implicit_controls

      !> It gives it back.
      module subroutine take_state(self)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self       !! the integrator
      end subroutine take_state

      !> Version of the form of what is saved.
      pure integer module function auto_memory_version() result(version)
         implicit none (type, external)
      end function auto_memory_version

      !> Write what the integrator remembers.
      module subroutine auto_save(self, archive)
         implicit none (type, external)
         class(auto_t), intent(in) :: self          !! the integrator
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine auto_save

      !> Read what the integrator remembers. The implicit part takes its own back when it is there.
      module subroutine auto_load(self, archive)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self       !! the integrator
         type(archive_t), intent(inout) :: archive  !! the checkpoint
      end subroutine auto_load

      !> The implicit part takes back what a checkpoint holds of it.
      module subroutine take_saved(self, system, status)
         implicit none (type, external)
         class(auto_t), intent(inout) :: self       !! the integrator
         class(ode_system_t), intent(in) :: system  !! the system
         integer, intent(out) :: status             !! advance_step, or a failure
      end subroutine take_saved
   end interface

contains

   !> Description of the method.
   function auto_info() result(info)
      type(kind_info_t) :: info  !! name and help

      info%name = "auto"
      info%help = "automatic choice during the run: explicit of order 8 (dop853), or 6 (verner) at tolerances above 1e-8; radau " &
                  //"while the equations are stiff"
      info%source = "Petzold (1983); Hairer and Wanner (1996)"
   end function auto_info

   !> Whether what decays fast kept the last step short.
   pure logical function auto_is_explicit(self)
      class(auto_t), intent(in) :: self  !! the integrator

      auto_is_explicit = .not. self%is_implicit
   end function auto_is_explicit

   !> Whether the implicit method may be chosen, and order 8.
   pure logical function may_change(self)
      class(auto_t), intent(in) :: self  !! the integrator, with its controls

      may_change = self%controls%fixed_step <= 0.0_wp .and. self%controls%onset == onset_located
   end function may_change

   !> Storage for the stages of the explicit method that the tolerance asks for.
   subroutine auto_prepare(self, n)
      class(auto_t), intent(inout) :: self  !! the integrator
      integer, intent(in) :: n              !! entries of the state

      self%can_change = may_change(self)
      self%is_eighth = self%can_change .and. self%controls%tolerance <= order_8_up_to
      self%is_implicit = .false.
      if (allocated(self%stiff)) deallocate (self%stiff)
      if (allocated(self%saved)) deallocate (self%saved)
      self%choice = method_choice_t()
      self%order = merge(8, 6, self%is_eighth)
      self%pace%bends = self%is_eighth
      self%stability%bound = merge(dop853_bound, verner_bound, self%is_eighth)
      if (self%is_eighth) then
         call self%eight%open(n, self%n_new_stage)
      else
         call self%six%open(n, self%n_new_stage)
      end if
   end subroutine auto_prepare

   !> Stages of an explicit step of length h from the start of the present step; the end state into `trial`.
   subroutine auto_make_stages(self, system, h, status)
      class(auto_t), intent(inout) :: self          !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: h                     !! length of the step [s]
      integer, intent(out) :: status                !! of the evaluations

      if (self%is_eighth) then
         call self%eight%make(system, self%step, h, self%trial, self%count%n_evaluations, status)
      else
         call self%six%make(system, self%step, h, self%trial, self%count%n_evaluations, status)
      end if
   end subroutine auto_make_stages

   !> Norm of the error estimate of the explicit trial step, over the tolerance.
   real(wp) function auto_error_norm(self, system, h) result(norm)
      class(auto_t), intent(inout) :: self       !! the integrator
      class(ode_system_t), intent(in) :: system  !! the system
      real(wp), intent(in) :: h                  !! length of the step [s]

      call self%set_scales(system, self%trial)
      associate (tolerance => self%controls%tolerance)
         if (self%is_eighth) then
            norm = h*self%eight%norm(system%n - system%n_quadrature, self%scale, self%controls%norm)/tolerance
            if (counts_quadratures(system, norm)) norm = max(norm, self%eight%quadrature_norm(system, h/tolerance))
         else
            norm = h*self%six%norm(system, self%step%f0, self%scale, self%controls%norm == norm_euclidean)/tolerance
            if (counts_quadratures(system, norm)) norm = max(norm, self%six%quadrature_norm(system, self%step%f0, h/tolerance))
         end if
      end associate
   end function auto_error_norm

   !> Rate at which the last two states at the end of an explicit step make a difference of each other decay or swing.
   real(wp) function auto_fastest_rate(self, n) result(rate)
      class(auto_t), intent(in) :: self  !! the integrator, after a step
      integer, intent(in) :: n           !! entries without quadratures

      if (self%is_eighth) then
         rate = self%eight%fastest_rate(n, self%step, self%scale)
      else
         rate = self%six%fastest_rate(n, self%step, self%scale)
      end if
   end function auto_fastest_rate

   !> One accepted step, of the method that was chosen after the last one. Where the implicit one fails, the explicit one continues.
   subroutine auto_advance(self, system, t_stop, status)
      class(auto_t), intent(inout) :: self          !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      if (self%can_change) then
         if (self%choice%wants_trial(motion_evaluations(self), self%stability%is_stiff)) call try_other(self, system, t_stop)
      end if
      if (self%choice%is_implicit) then
         call advance_implicit(self, system, t_stop, status)
         if (.not. any(status == [advance_failed_evaluation, advance_no_memory, advance_too_small])) then
            if (status >= 0) call self%choice%compare(self%t, motion_evaluations(self))
            return
         end if
         call self%choice%give_up(self%t, motion_evaluations(self))
      end if
      if (self%is_implicit) then
         call leave_implicit(self, system, status)
         if (status /= advance_step) return
      end if
      call one_step_advance(self, system, t_stop, status)
      if (status >= 0) call self%choice%compare(self%t, motion_evaluations(self))
   end subroutine auto_advance

   !> Evaluations so far, without those for output.
   pure integer(i8) function motion_evaluations(self) result(n)
      class(auto_t), intent(in) :: self  !! the integrator

      n = self%count%n_evaluations - self%count%n_output_evaluations
   end function motion_evaluations

   !> Some steps of the other method, of which the motion knows nothing.
   subroutine try_other(self, system, t_stop)
      class(auto_t), intent(inout) :: self          !! the integrator, before a step
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]

      class(one_step_t), allocatable :: other
      type(trial_t) :: trial
      real(wp) :: h

      h = self%pace%h_next
      if (.not. self%choice%is_implicit) then
         allocate (radau_t :: other)
      else
         h = self%choice%trial%h
         if (self%is_eighth) then
            allocate (dop853_t :: other)
         else
            allocate (verner_t :: other)
         end if
      end if
      if (self%choice%is_implicit) then
         call run_trial(other, system, self%controls, self%t, self%step%y1, t_stop, h, n_trial_step(2), trial)
      else
         call run_trial(other, system, implicit_controls(self, system), self%t, self%step%y1, t_stop, h, n_trial_step(1), trial)
      end if
      self%count%n_evaluations = self%count%n_evaluations + trial%n_evaluation
      call self%choice%note_trial(trial, motion_evaluations(self), merge(self%stability%product, 0.0_wp, self%stability%is_stiff))
      call self%stability%forget()
   end subroutine try_other

   !> One step of the implicit method.
   subroutine advance_implicit(self, system, t_stop, status)
      class(auto_t), intent(inout) :: self          !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      integer, intent(out) :: status                !! advance_step, advance_event or a failure

      call lend_state(self, system, status)
      if (status == advance_step .and. .not. self%is_implicit) then
         self%is_implicit = .true.
         self%stiff%pace = step_control_t(order=real(self%stiff%order, wp), h_next=self%choice%trial%h)
         call self%stiff%restart(system, 0.0_wp, status)
      end if
      if (status == advance_step) call self%stiff%advance(system, t_stop, status)
      call take_state(self)
      if (status < 0) return
      call self%choice%note_step(self%step%h)
   end subroutine advance_implicit

   !> The explicit method continues from the present state.
   subroutine leave_implicit(self, system, status)
      class(auto_t), intent(inout) :: self          !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      integer, intent(out) :: status                !! advance_step, or a failure

      self%is_implicit = .false.
      if (allocated(self%stiff)) deallocate (self%stiff)
      if (allocated(self%saved)) deallocate (self%saved)
      self%pace = step_control_t(order=real(self%order, wp), bends=self%pace%bends, h_next=self%choice%trial%h)
      call one_step_restart(self, system, 0.0_wp, status)
      call self%stability%forget()
   end subroutine leave_implicit

   !> The system has changed at the present state.
   subroutine auto_restart(self, system, step_hint, status)
      class(auto_t), intent(inout) :: self          !! the integrator
      class(ode_system_t), intent(inout) :: system  !! the system
      real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: as before [s]
      integer, intent(out) :: status                !! advance_step, or a failure

      if (.not. self%is_implicit) then
         call one_step_restart(self, system, step_hint, status)
         return
      end if
      self%choice%is_at_event = .true.
      call lend_state(self, system, status)
      if (status == advance_step) call self%stiff%restart(system, step_hint, status)
      call take_state(self)
   end subroutine auto_restart

end module auto
