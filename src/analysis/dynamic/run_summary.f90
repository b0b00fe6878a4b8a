!> What a run cost, how right it is and whether it kept its limits, when it is over.
module run_summary
   use errors, only: error_t
   use guards, only: guards_t
   use integration_method, only: abilities_t
   use integrator, only: integrator_t
   use kinds, only: not_a_number, wp
   use mechanism, only: mechanism_t
   use passed_contacts, only: warn_of_passed
   use recorder, only: status_complete, status_failed, summary_t
   use run_audit, only: audit, limits_t, warn_of_errors
   use run_tally, only: run_tally_t
   use sampling, only: sampler_t
   use shared_sticking, only: warn_of_shared_sticking
   use stiff_run, only: stiffness_warning
   use stop_condition, only: stop_t
   use text, only: append_text, text_t
   use whole_motion, only: whole_motion_t
   implicit none (type, external)
   private
   public :: sum_up

   integer, parameter :: many_steps = 100000       !! from which on a run is reported what makes its steps short

contains

   !> Cost and errors of a run, and whether it kept its limits.
   subroutine sum_up(whole, sampler, tally, stop, method, limits, summary, error)
      type(whole_motion_t), intent(inout) :: whole           !! the motion; its systems are left elsewhere
      type(sampler_t), intent(in) :: sampler                 !! what was reported
      type(run_tally_t), intent(in) :: tally                 !! sums and maxima
      type(stop_t), intent(in) :: stop                       !! conditions that end it by intent
      class(integrator_t), intent(in) :: method              !! the integrator, for its name and controls
      type(limits_t), intent(in) :: limits                   !! what the results must fulfil
      type(summary_t), intent(out) :: summary                !! cost and errors
      type(error_t), allocatable, intent(inout) :: error     !! why it ended early; or a limit was not kept

      type(guards_t) :: guards
      integer :: p, worst

      allocate (summary%warnings(0))
      summary%method%integrator = whole%parts(busiest(whole))%method%words(has_run=.true.)
      summary%method%solver = whole%system%linkage%solution%solver%name()
      summary%method%stabilisation = whole%system%stabiliser%words()
      summary%method%tolerance = merge(0.0_wp, method%controls%tolerance, method%controls%fixed_step > 0.0_wp)
      summary%quality%has_ledger = whole%system%ledger%is_kept
      summary%time_end = stop%t
      if (stop%met == 0) summary%time_end = minval([(whole%parts(p)%method%t, p=1, size(whole%parts))])
      do p = 1, size(whole%parts)
         associate (part => whole%parts(p))
            summary%count%steps = summary%count%steps + part%method%count%n_steps
            summary%count%rejected_steps = summary%count%rejected_steps + part%method%count%n_rejected
            summary%count%rhs_evaluations = summary%count%rhs_evaluations + part%system%n_evaluations &
                                            + part%method%trial_evaluations()
            summary%count%output_evaluations = summary%count%output_evaluations + part%method%count%n_output_evaluations
            summary%count%factorisations = summary%count%factorisations + part%system%linkage%solution%solver%n_factorisations
         end associate
      end do
      summary%groups = size(whole%parts)
      if (summary%groups > 1) summary%count%rhs_evaluations = summary%count%rhs_evaluations + whole%system%n_evaluations
      summary%count%output_evaluations = summary%count%output_evaluations + sampler%n_reports
      summary%count%events = tally%events
      summary%count%contacts = tally%contacts
      summary%count%samples = int(sampler%n_sample)
      summary%count%rows = sampler%n_row
      summary%quality%energy_max = tally%energy_max
      summary%quality%energy_residual_max = tally%residual_max
      if (.not. summary%quality%has_ledger) summary%quality%energy_residual_max = not_a_number()
      summary%quality%violation_max = tally%violation_max
      summary%quality%violation_rate_max = tally%violation_rate_max
      if (.not. allocated(error)) call audit(summary, tally%magnitude, limits, error)
      worst = maxloc(whole%parts%violation%worst, dim=1)
      call warn_of_errors(whole%parts(worst)%system, whole%parts(worst)%violation%worst, whole%parts(worst)%violation%row, &
                          tally%min_lost, tally%magnitude, summary)
      call warn_by_parts(whole, summary)
      call gather_wear(whole, summary)
      guards = limits%guards
      call whole%seen(guards)
      call warn_of_stiffness(whole, guards, method, allocated(error), summary)
      summary%status = status_complete
      summary%message = ""
      if (stop%met > 0) summary%message = stop%message()
      if (allocated(error)) then
         summary%status = status_failed
         summary%message = error%message
      end if
   end subroutine sum_up

   !> What the surfaces of all parts have lost.
   subroutine gather_wear(whole, summary)
      type(whole_motion_t), intent(in) :: whole      !! the motion
      type(summary_t), intent(inout) :: summary      !! worn surfaces are set

      integer :: k, p

      allocate (summary%worn(0))
      do p = 1, size(whole%parts)
         call whole%parts(p)%monitor%wear%add_surfaces(whole%parts(p)%system, summary%worn)
      end do
      do k = 1, size(summary%worn)
         if (.not. summary%worn(k)%is_through()) cycle
         call append_text(summary%warnings, "the "//summary%worn(k)%side//" of joint '"//summary%worn(k)%joint//"' is worn "// &
                          "through: its depth is cut at its radius")
      end do
   end subroutine gather_wear

   !> What the parts of the motion have noted.
   subroutine warn_by_parts(whole, summary)
      type(whole_motion_t), intent(in) :: whole      !! the motion
      type(summary_t), intent(inout) :: summary      !! its warnings grow

      integer :: p

      do p = 1, size(whole%parts)
         call whole%parts(p)%jumps%warn(whole%parts(p)%system, summary%warnings)
         call warn_of_passed(whole%parts(p)%system, whole%parts(p)%method, summary%warnings)
         call warn_of_shared_sticking(whole%parts(p)%system, summary%warnings)
         call warn_by_forces(whole%parts(p)%system, summary%warnings)
      end do
   end subroutine warn_by_parts

   !> What force elements of a part have noted.
   subroutine warn_by_forces(system, warnings)
      type(mechanism_t), intent(in) :: system                    !! its system
      type(text_t), allocatable, intent(inout) :: warnings(:)    !! (any) appended to

      character(:), allocatable :: doubt
      integer :: i, k

      do k = 1, size(system%loading%forces)
         associate (set => system%loading%forces(k)%set)
            do i = 1, set%n
               doubt = set%doubt(i)
               if (doubt /= "") call append_text(warnings, "force element '"//set%names(i)%s//"' "//doubt)
            end do
         end associate
      end do
   end subroutine warn_by_forces

   !> What the guards have seen, and that the method is explicit where the equations are stiff: said once.
   subroutine warn_of_stiffness(whole, guards, method, has_failed, summary)
      type(whole_motion_t), intent(inout) :: whole   !! the motion; its systems are left elsewhere
      type(guards_t), intent(in) :: guards           !! the guards
      class(integrator_t), intent(in) :: method      !! the integrator
      logical, intent(in) :: has_failed              !! the run ended early
      type(summary_t), intent(inout) :: summary      !! its warnings grow

      type(abilities_t) :: can
      character(:), allocatable :: words
      integer :: p

      call guards%warn(whole%system, summary%warnings)
      do p = 1, size(whole%parts)
         if (has_failed) exit
         words = stiffness_warning(whole%parts(p)%system, whole%parts(p)%method)
         if (words == "") cycle
         call append_text(summary%warnings, words)
         return
      end do
      can = method%abilities()
      if (.not. can%is_explicit .or. can%parts /= "" .or. summary%count%steps < many_steps) return
      call guards%films%warn_of_stiffness(whole%system, summary%method%integrator, summary%warnings)
   end subroutine warn_of_stiffness

   !> The part with the most steps.
   pure integer function busiest(whole) result(p)
      type(whole_motion_t), intent(in) :: whole  !! the motion

      integer :: k

      p = 1
      do k = 2, size(whole%parts)
         if (whole%parts(k)%method%count%n_steps > whole%parts(p)%method%count%n_steps) p = k
      end do
   end function busiest

end module run_summary
