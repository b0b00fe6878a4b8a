!> `gudgeon run DECK --accuracy X`: the tolerance that a motion needs, put into its scene before it is run.
module accurate_run
   use accuracy_results, only: accuracy_t, claim_none, claim_reached
   use accuracy_search, only: find_accuracy
   use catalogue, only: catalogue_t
   use channel_names, only: scalar_name, scalar_t
   use channels, only: list_scalars, match_word, select_channels, selection_t
   use errors, only: error_t, exit_audit, exit_integration, exit_usage, set_error
   use integration_settings, only: takes_steps
   use jobs, only: copy_job, job_t
   use kept_run, only: numbers_of, sort_of
   use kinds, only: wp
   use load, only: loaded_t
   use options, only: options_t
   use output_plan, only: output_plan_t
   use progress, only: progress_t
   use scene, only: analysis_dynamic
   use text, only: real_text, text_t
   use time_budget, only: time_budget_t
   use time_plan, only: last_instant
   implicit none (type, external)
   private
   public :: budget_of, check_accuracy, choose_tolerance, tell_accuracy

   real(wp), parameter :: most_kept = 2.0e6_wp  !! numbers that are kept of a run: beyond, of fewer instants [1]

   !> Quantities that have no true value but zero, or none between two.
   character(*), parameter :: left_out = " violation violation_rate residual state "

contains

   !> Time that comparisons of a deck may take: that of the command line, or of its section [precision]; 0: no limit.
   real(wp) function budget_of(options, loaded) result(budget)
      type(options_t), intent(in) :: options    !! the command line
      type(loaded_t), intent(in) :: loaded      !! the deck

      budget = options%digits%budget
      if (budget <= 0.0_wp) budget = loaded%scene%settings%precision%number("budget")
   end function budget_of

   !> What the option goes together with.
   subroutine check_accuracy(options, loaded, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(in) :: loaded                 !! the deck
      type(error_t), allocatable, intent(out) :: error     !! what it does not go together with

      character(:), allocatable :: hint, maker

      if (options%digits%accuracy <= 0.0_wp) then
         if (options%digits%budget > 0.0_wp .and. .not. options%digits%with_horizon) then
            call set_error(error, exit_usage, "option --budget of 'run' needs --accuracy or --horizon")
         end if
      else if (loaded%scene%analysis /= analysis_dynamic) then
         call set_error(error, exit_usage, "option --accuracy needs a run of [analysis.dynamic]: a kinematic or static "// &
                        "analysis already solves its equations to its tolerance")
      else if (options%change%tolerance > 0.0_wp) then
         call set_error(error, exit_usage, "options --accuracy and --tolerance exclude each other: --accuracy chooses the "// &
            "tolerance")
      else if (allocated(options%legacy%way)) then
         call set_error(error, exit_usage, "options --accuracy and --legacy exclude each other: --legacy takes fixed steps")
      else
         associate (method => loaded%scene%settings%integration%method, &
                    stabiliser => loaded%scene%settings%integration%stabilisation%name)
            maker = method
            hint = "choose another method, as with --method verner"
            if (.not. takes_steps(method, "")) then
               maker = stabiliser
               hint = "choose another stabilisation method, as stabilise = projection"
            end if
            if (.not. takes_steps(method, stabiliser)) return
         end associate
         call set_error(error, exit_usage, "option --accuracy chooses a tolerance, but '"//maker//"' takes fixed steps"// &
                        new_line("a")//"  = "//hint)
      end if
   end subroutine check_accuracy

   !> Find the tolerance and give it to the scene; what is known of the errors goes to the plan of the output.
   subroutine choose_tolerance(options, loaded, plan, error)
      type(options_t), intent(in) :: options               !! the command line
      type(loaded_t), intent(inout) :: loaded              !! the deck; its tolerance is set
      type(output_plan_t), intent(inout) :: plan           !! accuracy is set
      type(error_t), allocatable, intent(out) :: error     !! no run came to its end

      type(job_t) :: job
      type(progress_t) :: display
      type(scalar_t), allocatable :: scalars(:)
      type(time_budget_t) :: budget
      integer, allocatable :: asked(:, :)
      integer :: k, stride

      call find_asked(plan%channels, loaded%catalogue, scalars)
      if (size(scalars) == 0) then
         call set_error(error, exit_usage, "no channel selected in [output] has a numerical error: --accuracy controls "// &
                        "positions, velocities, forces and energies")
         return
      end if
      call copy_job(loaded%job_t, job)
      asked = reshape([(scalars(k)%group, scalars(k)%component, scalars(k)%item, k=1, size(scalars))], [3, size(scalars)])
      stride = ceiling(real(last_instant(loaded%plan) + 1, wp)*real(count_kept(loaded%catalogue) + 3*size(scalars), wp)/most_kept)
      plan%accuracy%asked = options%digits%accuracy
      call budget%begin(budget_of(options, loaded))
      call display%start(plan%with%progress)
      call find_accuracy(job, budget, loaded%scene%settings%integration%method, asked, stride, display, plan%accuracy)
      call display%finish()
      if (plan%accuracy%end <= 0.0_wp) then
         if (len(plan%accuracy%reason) == 0) then
            call set_error(error, exit_integration, "--accuracy has nothing to examine: the run stops at its start, by a "// &
                           "condition of 'stop'")
         else
            call set_error(error, exit_integration, "no run was completed: "//plan%accuracy%reason)
         end if
         return
      end if
      do k = 1, size(plan%accuracy%extremes)
         plan%accuracy%extremes(k)%name = scalar_name(loaded%catalogue, scalars(k))
         plan%accuracy%extremes(k)%unit = loaded%catalogue%groups(scalars(k)%group)%channel%unit
      end do
      associate (controls => loaded%scene%settings%integration%controls)
         controls%tolerance = plan%accuracy%tolerance
         controls%fixed_step = 0.0_wp
      end associate
   end subroutine choose_tolerance

   !> The channels that the deck's words name; without words positions, velocities and reactions.
   subroutine find_asked(words, catalogue, scalars)
      type(text_t), intent(in) :: words(:)                      !! (any) words that the run knows
      type(catalogue_t), intent(in) :: catalogue                !! what can be recorded
      type(scalar_t), allocatable, intent(out) :: scalars(:)    !! (n) channels

      type(scalar_t), allocatable :: all(:)
      type(selection_t) :: selection
      character(:), allocatable :: hint, message
      integer :: bad, k
      logical, allocatable :: is_asked(:)

      if (size(words) > 0) then
         call select_channels(words, catalogue, selection, bad, message, hint)
      else
         call match_word("*", catalogue, selection, message, hint)
      end if
      all = list_scalars(selection)
      allocate (is_asked(size(all)))
      do k = 1, size(all)
         associate (group => catalogue%groups(all(k)%group))
            is_asked(k) = index(left_out, " "//group%channel%name//" ") == 0
            if (size(words) == 0) is_asked(k) = sort_of(group%item_group, group%channel%name) > 0
         end associate
      end do
      scalars = pack(all, is_asked)
   end subroutine find_asked

   !> Numbers of positions, velocities and reactions in a catalogue.
   pure integer function count_kept(catalogue) result(n)
      type(catalogue_t), intent(in) :: catalogue  !! what can be recorded

      integer :: k

      n = 0
      do k = 1, size(catalogue%groups)
         associate (group => catalogue%groups(k))
            if (sort_of(group%item_group, group%channel%name) > 0) n = n + numbers_of(group)*size(group%has)
         end associate
      end do
   end function count_kept

   !> A run that has not the accuracy asked for ends with an error, after all is written.
   subroutine tell_accuracy(accuracy, error)
      type(accuracy_t), intent(in) :: accuracy                 !! what is known of the errors
      type(error_t), allocatable, intent(inout) :: error       !! of the run; set if the accuracy was not reached

      character(:), allocatable :: reached

      if (allocated(error) .or. accuracy%asked <= 0.0_wp) return
      if (accuracy%claim /= claim_none .and. accuracy%claim /= claim_reached) return
      reached = "the error of this run is unknown"
      if (accuracy%claim == claim_reached) reached = "reached "//real_text(accuracy%error, 2)
      call set_error(error, exit_audit, "accuracy "//real_text(accuracy%asked, 3)//" was requested, "//reached//": "// &
                     accuracy%reason)
   end subroutine tell_accuracy

end module accurate_run
