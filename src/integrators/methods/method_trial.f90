!> Some steps of another method from the present state, of which the motion knows nothing: how far they lead, and what they cost.
!>
!> The system gets back what it remembers, and is left at the present state.
module method_trial
   use archive, only: archive_t
   use integrator, only: advance_step
   use integrator_controls, only: controls_t
   use kinds, only: i8, wp
   use ode_system, only: ode_system_t
   use one_step, only: one_step_t
   implicit none (type, external)
   private
   public :: trial_t, run_trial

   integer, parameter :: most_evaluations = 3000   !! after which a trial ends

   !> Outcome of a trial.
   type :: trial_t
      real(wp) :: t_begin = 0.0_wp     !! where it started [s]
      real(wp) :: t_end = 0.0_wp       !! where it ended [s]
      real(wp) :: h = 0.0_wp           !! step that the method would make next [s]
      integer(i8) :: n_evaluation = 0  !! evaluations
   end type trial_t

contains

   !> Up to `n_step` steps, to the first event or a failure.
   subroutine run_trial(other, system, controls, t, y, t_stop, h, n_step, trial)
      class(one_step_t), intent(inout) :: other     !! the other method, not started
      class(ode_system_t), intent(inout) :: system  !! the system
      type(controls_t), intent(in) :: controls      !! settings of the present method
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: y(:)                  !! (n) state [any]
      real(wp), intent(in) :: t_stop                !! not to be passed [s]
      real(wp), intent(in) :: h                     !! first step [s]
      integer, intent(in) :: n_step                 !! steps, at most
      type(trial_t), intent(out) :: trial           !! its outcome

      integer :: k, status
      type(archive_t) :: memory
      real(wp) :: rate(system%n)

      call system%save(memory)
      other%controls = controls
      other%controls%maximum_steps = 0
      other%controls%maximum_evaluations = 0
      other%controls%initial_step = h
      call other%start(system, t, y, t_stop, status)
      do k = 1, n_step
         if (status /= advance_step .or. other%t >= t_stop .or. other%count%n_evaluations > most_evaluations) exit
         call other%advance(system, t_stop, status)
      end do
      trial = trial_t(t, other%t, other%pace%h_next, other%count%n_evaluations + 1)
      call system%load(memory)
      call system%evaluate(t, y, rate, status)
   end subroutine run_trial

end module method_trial
