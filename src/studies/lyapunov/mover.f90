!> A mechanism that is moved from instant to instant, for those who look at its state there and may change it.
!>
!> It is one part, whatever groups its bodies are in, and nothing of it is recorded.
module mover
   use build_system, only: new_system
   use cpu_budget, only: cpu_budget_t
   use errors, only: error_t, exit_integration, set_error
   use guards, only: guards_t, new_guards
   use output_times, only: output_times_t, new_output_times
   use integrator, only: advance_event, integrator_t
   use integration_settings, only: integration_t
   use jobs, only: job_t, start_job, started_t
   use kept_run, only: kept_run_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use moving_part, only: advance_part, begin_part, handle_part_events, moving_part_t, new_part, pass_part_instant
   use precision_info, only: setting_t
   use run_tally, only: run_tally_t
   use state_equations, only: refuse_sampled
   use tangent, only: tangent_t
   use text, only: real_text
   use tangent_events, only: cross_events, cross_instant
   implicit none (type, external)
   private
   public :: mover_t

   !> A mechanism in motion. It must be a target: its part points at the rest of it.
   type :: mover_t
      type(mechanism_t) :: system                       !! the equations
      class(integrator_t), allocatable :: method        !! the integrator
      type(moving_part_t) :: part                       !! the motion
      type(run_tally_t) :: tally                        !! what it adds up
      type(kept_run_t) :: nothing                       !! records nothing
      type(cpu_budget_t) :: budget                      !! time left
      logical :: is_late = .false.                      !! that time was up
   contains
      procedure :: start
      procedure :: advance
      procedure :: put
   end type mover_t

contains

   !> Start at the start of a scene.
   subroutine start(self, job, setting, asked, end, error)
      class(mover_t), target, intent(inout) :: self       !! the mechanism, new
      type(job_t), intent(inout) :: job                   !! scene and time; left as it is
      type(setting_t), intent(in) :: setting              !! of the integration
      real(wp), intent(in) :: asked                       !! tolerance, or length of fixed steps [1 or s]
      real(wp), intent(in) :: end                         !! end of the motion [s]
      type(error_t), allocatable, intent(out) :: error    !! it cannot start

      type(guards_t) :: guards
      type(output_times_t) :: output_times
      type(integration_t) :: settings
      type(started_t) :: begin

      call refuse_sampled(job%scene%states, error)
      if (allocated(error)) return
      call self%budget%begin(job%limits%cpu, clock=job%limits%clock)
      settings = job%scene%settings%integration
      call setting%apply(asked, job%scene%settings%integration)
      call new_system(job%scene, job%levels, self%system)
      call start_job(job, self%system, begin, error)
      job%scene%settings%integration = settings
      if (allocated(error)) return
      call move_alloc(begin%method, self%method)
      call new_output_times(job%scene, end, self%system%clearance_joints%n > 0, output_times)
      call new_guards(job%scene, self%system, guards)
      call new_part(self%system, self%method, output_times, guards, self%part)
      self%nothing%is_kept = .false.
      call begin_part(self%part, begin%y, end, self%tally, self%nothing, error)
   end subroutine start

   !> Continue to a time; events and instants up to it, and at it, are behind then. A change of the motion goes along.
   subroutine advance(self, until, error, tangent)
      class(mover_t), intent(inout) :: self                      !! the mechanism
      real(wp), intent(in) :: until                              !! the time [s]
      type(error_t), allocatable, intent(out) :: error           !! the integration failed, or no time is left
      type(tangent_t), intent(inout), optional :: tangent        !! the change

      integer :: status

      do while (self%method%t < until)
         call advance_part(self%part, self%tally, error, until)
         if (allocated(error)) return
         self%is_late = self%budget%is_spent()
         if (self%is_late) then
            call set_error(error, exit_integration, "time budget exhausted at t = "//real_text(self%method%t, 4)// &
                           " s: raise it with --budget")
            return
         end if
         if (present(tangent)) then
            call tangent%follow(self%system, self%method, status)
            if (status /= 0) then
               call set_error(error, exit_integration, "the equations have no solution for the perturbed state")
               return
            end if
         end if
         if (self%part%status == advance_event) then
            if (present(tangent)) then
               call cross_events(tangent, self%part, self%tally, self%nothing, error)
            else
               call handle_part_events(self%part, self%tally, self%nothing, error)
            end if
         end if
         if (allocated(error)) return
         if (.not. self%part%output_times%is_at(self%method%t)) cycle
         if (present(tangent)) then
            call cross_instant(tangent, self%part, self%tally, self%nothing, error)
         else
            call pass_part_instant(self%part, self%tally, self%nothing, error)
            if (.not. allocated(error) .and. self%method%events%n_happened > 0) then
               call handle_part_events(self%part, self%tally, self%nothing, error)
            end if
         end if
         if (allocated(error)) return
      end do
   end subroutine advance

   !> Put the mechanism into another state, in which the same contacts touch; it continues from there.
   subroutine put(self, y, is_good)
      class(mover_t), intent(inout) :: self        !! the mechanism
      real(wp), intent(in) :: y(:)                 !! (n) the state, on the constraints or nearly [any]
      logical, intent(out) :: is_good              !! .false.: no contact is as it was there; the mechanism is as before

      real(wp), allocatable :: before(:)
      integer :: status

      before = self%method%step%y1
      self%method%step%y1 = y
      call self%system%project_state(self%method%t, self%method%step%y1, status)
      is_good = status == 0
      if (is_good) call self%method%restart(self%system, 0.0_wp, status)
      is_good = is_good .and. status == 0
      if (is_good) is_good = .not. any(self%method%events%g1 > 0.0_wp)
      if (.not. is_good) then
         self%method%step%y1 = before
         call self%method%restart(self%system, 0.0_wp, status)
      end if
      if (self%system%clearance_joints%n > 0) call self%part%monitor%after_restart(self%system, self%method)
   end subroutine put

end module mover
