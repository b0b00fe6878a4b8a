!> One motion of a deck with the derivatives of its results by some parameters.
!>
!> The motion is integrated as in a run, as one part; after each step the derivatives follow (`sensitivity_column`), then results
!> are looked for (`result_tracker`), then events and instants are handled, which the mechanisms beside take over
!> (`derived_events`).
module sensitivity_motion
   use catalogue, only: catalogue_t
   use derived_events, only: pass_events, pass_instant
   use derived_motion, only: find_section, list_touched, motion_t, note_failures, restore, take_over_memory
   use errors, only: error_t, exit_integration, set_error
   use integration_method, only: abilities_t
   use integration_settings, only: integration_t
   use integrator, only: advance_event
   use jobs, only: job_t
   use kinds, only: wp
   use mechanism_catalogue, only: build_catalogue
   use moving_part, only: advance_part
   use parameter_source, only: parameter_source_t
   use precision_info, only: reference_setting, setting_t
   use result_tracker, only: tracker_t
   use sensitivity_results, only: found_t, is_of_contact, result_peak_penetration, result_value, sensitivity_plan_t
   use step_map, only: section_t
   use step_viewer, only: step_viewer_t
   use text, only: real_text
   use varied_system, only: instants_of, want_only
   implicit none (type, external)
   private
   public :: after_step, find_motion, setting_of

contains

   !> Find the results and their derivatives.
   subroutine find_motion(job, source, plan, tolerance, part, found, error, viewer)
      type(job_t), intent(inout) :: job                              !! scene and times; left as it is
      class(parameter_source_t), target, intent(inout) :: source     !! where scenes with other parameters come from
      type(sensitivity_plan_t), intent(in) :: plan                   !! what is asked for
      real(wp), intent(in) :: tolerance                              !! of the motion [1]
      real(wp), intent(in) :: part                                   !! first e, of the parameters [1]
      type(found_t), intent(out) :: found                            !! what it gives
      type(error_t), allocatable, intent(out) :: error               !! it cannot start, or the integration failed
      class(step_viewer_t), intent(inout), optional :: viewer        !! looks at every step

      type(motion_t), target :: motion
      real(wp) :: until
      integer :: k

      call found%start(size(plan%results), size(plan%parameters))
      call begin(motion, job, source, plan, tolerance, part, found, error, viewer)
      if (allocated(error)) return  ! before any column has started
      associate (mover => motion%mover)
         do while (mover%method%t < plan%end)
            until = plan%end
            associate (asked => plan%results)
               if (any(asked%kind == result_value .and. asked%t > mover%method%t)) then
                  until = min(until, minval(asked%t, mask=asked%kind == result_value .and. asked%t > mover%method%t))
               end if
            end associate
            call advance_part(mover%part, mover%tally, error, until)
            if (allocated(error)) exit
            if (mover%budget%is_spent()) then
               call set_error(error, exit_integration, "CPU time limit reached at t = "//real_text(mover%method%t, 4)//" s")
               exit
            end if
            found%n_step = found%n_step + 1
            call after_step(motion, plan%end, found, error, viewer)
            if (allocated(error)) exit
         end do
      end associate
      do k = 1, size(motion%columns)
         call motion%columns(k)%free()
      end do
   end subroutine find_motion

   !> The start of the motion and of its derivatives.
   subroutine begin(motion, job, source, plan, tolerance, part, found, error, viewer)
      type(motion_t), target, intent(inout) :: motion                !! the motion
      type(job_t), intent(inout) :: job                              !! scene and times
      class(parameter_source_t), target, intent(inout) :: source     !! where scenes with other parameters come from
      type(sensitivity_plan_t), intent(in) :: plan                   !! what is asked for
      real(wp), intent(in) :: tolerance                              !! of the motion [1]
      real(wp), intent(in) :: part                                   !! first e, of the parameters [1]
      type(found_t), intent(inout) :: found                          !! results
      type(error_t), allocatable, intent(out) :: error               !! it cannot start
      class(step_viewer_t), intent(inout), optional :: viewer        !! looks at every step

      type(integration_t) :: settings
      integer :: k

      associate (variation => motion%variation, mover => motion%mover)
         variation%setting = setting_of(job%scene%settings%integration)
         variation%tolerance = tolerance
         call mover%start(job, variation%setting, tolerance, plan%end, error)
         if (allocated(error)) return
         variation%source => source
         variation%base => mover%system
         allocate (variation%channels(3, count(.not. is_of_contact(plan%results%kind))))
         allocate (motion%results(size(plan%results)), motion%columns(size(plan%parameters)))
         settings = job%scene%settings%integration
         call variation%setting%apply(tolerance, settings)
         call motion%map%begin(settings, mover%system, mover%method%step%y1, plan%end, k)
         call build_catalogue(mover%system, motion%catalogue)
         call list_results(plan, motion%catalogue, motion%results, variation%channels)
         if (present(viewer)) variation%channels = reshape([variation%channels, viewer%channels], &
                                                           [3, size(variation%channels, 2) + size(viewer%channels, 2)])
         call want_only(mover%system, variation%channels, motion%catalogue)
         variation%instants = instants_of(job, mover%system)
         do k = 1, size(motion%columns)
            if (allocated(plan%spans)) then
               call motion%columns(k)%begin(variation, k, plan%values(k), part, mover%method, plan%spans(k))
            else
               call motion%columns(k)%begin(variation, k, plan%values(k), part, mover%method)
            end if
         end do
      end associate
      motion%is_behind_events = .true.
      call take_over_memory(motion)
      call note_failures(motion, found)
      do k = 1, size(motion%results)
         call motion%results(k)%at_start(motion%mover%system, motion%mover%method, motion%catalogue, motion%columns, found)
      end do
      if (present(viewer)) call viewer%see_start(motion)
      call restore(motion)
   end subroutine begin

   !> The method of the deck; for one that chooses among others by its steps the first of those that confirm others.
   function setting_of(settings) result(setting)
      type(integration_t), intent(in) :: settings    !! of the deck
      type(setting_t) :: setting                     !! method; stabilisation and solver as in the deck

      type(abilities_t) :: can

      setting = reference_setting("")
      can = settings%can()
      if (can%parts == "") setting%method = settings%method
   end function setting_of

   !> Results to trackers, and the channels that they need.
   subroutine list_results(plan, catalogue, results, channels)
      type(sensitivity_plan_t), intent(in) :: plan         !! what is asked for
      type(catalogue_t), intent(in) :: catalogue           !! of the motion
      type(tracker_t), intent(inout) :: results(:)         !! (results) set
      integer, intent(out) :: channels(:, :)               !! (3, n) group, component and item of channels

      integer :: k, n

      n = 0
      do k = 1, size(results)
         results(k)%asked = plan%results(k)
         results(k)%number = k
         results(k)%what%is_force = plan%results(k)%kind /= result_peak_penetration
         if (is_of_contact(plan%results(k)%kind)) cycle
         n = n + 1
         channels(:, n) = plan%results(k)%channel
         results(k)%what%place = catalogue%place(channels(1, n), channels(2, n), channels(3, n))
      end do
   end subroutine list_results

   !> What follows a step: derivatives, results, events, instants.
   subroutine after_step(motion, end, found, error, viewer)
      type(motion_t), target, intent(inout) :: motion      !! the motion
      real(wp), intent(in) :: end                          !! of the motion [s]
      type(found_t), intent(inout) :: found                !! results
      type(error_t), allocatable, intent(out) :: error     !! no way to continue
      class(step_viewer_t), intent(inout), optional :: viewer  !! looks at the step

      type(section_t) :: section
      integer, allocatable :: touched(:, :)
      real(wp), allocatable :: rates(:)
      real(wp) :: behind
      integer :: k
      logical :: is_event, is_instant

      associate (mover => motion%mover, method => motion%mover%method, system => motion%mover%system)
         if (mover%part%must_follow) call take_over_memory(motion)
         is_event = mover%part%status == advance_event
         is_instant = mover%part%output_times%is_at(method%t)
         behind = merge(motion%behind, 0.0_wp, motion%is_behind_events)
         call motion%map%take_step(method)
         do k = 1, size(motion%results)
            call motion%results(k)%in_step(motion%map, system, method, motion%catalogue, motion%columns, behind, found)
         end do
         if (present(viewer)) call viewer%see_step(motion, behind)
         call motion%map%take_step(method)
         call find_section(motion, is_event, is_instant .or. method%t >= end, section)
         call list_touched(motion, is_event, touched, rates)
         do k = 1, size(motion%columns)
            if (.not. motion%columns(k)%is_active) cycle
            call motion%columns(k)%follow(motion%map, method, motion%variation, section, behind, touched)
         end do
         do k = 1, size(motion%results)
            call motion%results(k)%at_end(method, motion%columns, found)
         end do
         motion%is_behind_events = .false.
         if (is_event) call pass_events(motion, touched, rates, found, error)
         if (allocated(error)) return
         if (is_instant) call pass_instant(motion, error)
         call restore(motion)
         call note_failures(motion, found)
      end associate
   end subroutine after_step

end module sensitivity_motion
