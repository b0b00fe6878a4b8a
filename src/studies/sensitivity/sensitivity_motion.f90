!> One motion of a deck with the derivatives of its results by some parameters.
!>
!> The motion is integrated as in a run, as one part; after each step the derivatives follow (`sensitivity_column`), then results
!> are looked for (`result_tracker`), then events and instants are handled, which the mechanisms beside take over.
!>
!> Refused, with the time: contacts that come to rest (their speed of rest is set by the program), events at one instant that part
!> when the parameter changes, events at instants of functions of time, and onsets next to grazing.
module sensitivity_motion
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use contact_memory, only: rests
   use contact_peaks, only: look, trend_t
   use contact_places, only: touch_function
   use errors, only: error_t, exit_integration, set_error
   use friction_law, only: memory_bristle
   use integration_method, only: abilities_t
   use integration_settings, only: integration_t
   use integrator, only: advance_event
   use jobs, only: job_t
   use kinds, only: eps, wp
   use mechanism_catalogue, only: build_catalogue
   use mover, only: mover_t
   use moving_part, only: advance_part, handle_part_events, pass_part_instant
   use parameter_source, only: parameter_source_t
   use precision_info, only: reference_setting, setting_t
   use result_tracker, only: tracker_t
   use sensitivity_column, only: column_t, derivative
   use sensitivity_results, only: found_t, is_extreme, is_of_contact, result_peak_penetration, result_value, sensitivity_plan_t
   use step_map, only: section_function, section_t, section_time, step_map_t
   use text, only: real_text
   use varied_system, only: instants_of, variation_t, want_only
   implicit none (type, external)
   private
   public :: find_motion

   real(wp), parameter :: late = 0.25_wp             !! time to the end of a contact that parts, of the time since its onset [1]
   real(wp), parameter :: fast = 0.3_wp              !! the same, times its characteristic rate: not next to a turn [1]
   real(wp), parameter :: apart = 1.0e-6_wp          !! shift between events at one instant, of the shift of the first [1]
   real(wp), parameter :: far = 1.0e3_wp             !! a change that is never made, of the parameter [1]
   real(wp), parameter :: min_distance = 1.0e-7_wp   !! change at which an onset would graze, of the parameter, at least [1]

   !> A motion that is under way. It must be a target.
   type :: motion_t
      type(mover_t) :: mover                         !! the mechanism in motion
      type(catalogue_t) :: catalogue                 !! of its channels
      type(step_map_t) :: map                        !! of the last step
      type(variation_t) :: variation                 !! how mechanisms beside are made
      type(column_t), allocatable :: columns(:)      !! (parameters) derivatives
      type(tracker_t), allocatable :: results(:)     !! (results) what is looked for
      real(wp) :: behind = 0.0_wp                    !! time after the last onset at which a force that jumps is seen; 0: none [s]
      logical :: is_behind_events = .false.          !! the step in hand starts there
   end type motion_t

contains

   !> Find the results and their derivatives.
   subroutine find_motion(job, source, plan, tolerance, part, found, error)
      type(job_t), intent(inout) :: job                              !! scene and times; left as it is
      class(parameter_source_t), target, intent(inout) :: source     !! where scenes with other parameters come from
      type(sensitivity_plan_t), intent(in) :: plan                   !! what is asked for
      real(wp), intent(in) :: tolerance                              !! of the motion [1]
      real(wp), intent(in) :: part                                   !! first e, of the parameters [1]
      type(found_t), intent(out) :: found                            !! what it gives
      type(error_t), allocatable, intent(out) :: error               !! it cannot start, or the integration failed

      type(motion_t), target :: motion
      real(wp) :: until

      call found%start(size(plan%results), size(plan%parameters))
      call begin(motion, job, source, plan, tolerance, part, found, error)
      if (allocated(error)) return
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
            call after_step(motion, plan%end, found, error)
            if (allocated(error)) exit
         end do
      end associate
   end subroutine find_motion

   !> The start of the motion and of its derivatives.
   subroutine begin(motion, job, source, plan, tolerance, part, found, error)
      type(motion_t), target, intent(inout) :: motion                !! the motion
      type(job_t), intent(inout) :: job                              !! scene and times
      class(parameter_source_t), target, intent(inout) :: source     !! where scenes with other parameters come from
      type(sensitivity_plan_t), intent(in) :: plan                   !! what is asked for
      real(wp), intent(in) :: tolerance                              !! of the motion [1]
      real(wp), intent(in) :: part                                   !! first e, of the parameters [1]
      type(found_t), intent(inout) :: found                          !! results
      type(error_t), allocatable, intent(out) :: error               !! it cannot start

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
         call want_only(mover%system, variation%channels, motion%catalogue)
         variation%instants = instants_of(job, mover%system)
         do k = 1, size(motion%columns)
            call motion%columns(k)%begin(variation, k, plan%values(k), part, mover%method)
         end do
      end associate
      motion%is_behind_events = .true.
      call take_over_memory(motion)
      call note_failures(motion, found)
      do k = 1, size(motion%results)
         call motion%results(k)%at_start(motion%mover%system, motion%mover%method, motion%catalogue, motion%columns, found)
      end do
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
   subroutine after_step(motion, end, found, error)
      type(motion_t), target, intent(inout) :: motion      !! the motion
      real(wp), intent(in) :: end                          !! of the motion [s]
      type(found_t), intent(inout) :: found                !! results
      type(error_t), allocatable, intent(out) :: error     !! no way to continue

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

   !> The mechanism as it is at the present state.
   subroutine restore(motion)
      type(motion_t), intent(inout) :: motion    !! the motion

      real(wp) :: ydot(motion%mover%system%n)
      integer :: status

      call motion%mover%system%evaluate(motion%mover%method%t, motion%mover%method%step%y1, ydot, status)
   end subroutine restore

   !> Where steps beside end: at the event, at an instant, or, as a contact parts, at its penetration.
   subroutine find_section(motion, is_event, is_instant, section)
      type(motion_t), intent(inout) :: motion        !! the motion, after a step
      logical, intent(in) :: is_event                !! which ended at an event
      logical, intent(in) :: is_instant              !! or at an instant
      type(section_t), intent(out) :: section        !! where steps beside end

      real(wp), dimension(motion%mover%system%n_event) :: g, rate
      real(wp) :: first
      integer :: i, k, number

      if (is_instant) section%kind = section_time
      associate (method => motion%mover%method, system => motion%mover%system)
         if (system%n_event == 0) return
         call system%events(method%t, method%step%y1, g, rate)
         if (is_event) then
            section = section_t(section_function, method%events%happened(1), g(method%events%happened(1)))
            return
         end if
         if (is_instant) return
         first = huge(1.0_wp)
         do k = 1, size(system%clearance_joints%sets)
            associate (set => system%clearance_joints%sets(k)%set)
               do i = 1, set%n_contact
                  if (.not. set%contact(i)%is_touching) cycle
                  number = set%before%contacts + i
                  if (.not. (rate(number) > 0.0_wp .and. g(number) < 0.0_wp)) cycle
                  associate (left => -g(number)/rate(number))
                     if (left > late*(method%t - set%contact(i)%onset) .or. left >= first) cycle
                     if (left*set%contact(i)%contact_rate > fast) cycle
                     first = left
                     section = section_t(section_function, number, g(number))
                  end associate
               end do
            end associate
         end do
      end associate
   end subroutine find_section

   !> Contacts that start or end at the events in hand, and their penetration rates.
   subroutine list_touched(motion, is_event, touched, rates)
      type(motion_t), intent(inout) :: motion                !! the motion, at events that are not handled
      logical, intent(in) :: is_event                        !! there are any
      integer, allocatable, intent(out) :: touched(:, :)     !! (3, n) set, contact of it, number
      real(wp), allocatable, intent(out) :: rates(:)         !! (n) penetration rates [m/s]

      type(trend_t) :: force, penetration
      integer :: i, k, m, n

      associate (method => motion%mover%method, system => motion%mover%system)
         allocate (touched(3, merge(method%events%n_happened, 0, is_event)))
         allocate (rates(size(touched, 2)))
         n = 0
         do m = 1, size(touched, 2)
            if (system%clearance_joints%functions%kind_of(method%events%happened(m)) /= touch_function) cycle
            call system%find_contact(method%events%happened(m), k, i)
            call system%linkage%set_motion(method%t, method%step%y1)
            call look(system, k, i, force, penetration)
            n = n + 1
            touched(:, n) = [k, i, method%events%happened(m)]
            rates(n) = penetration%rate
         end do
      end associate
      touched = touched(:, :n)
      rates = rates(:n)
   end subroutine list_touched

   !> Handle events; derivatives and results go across.
   subroutine pass_events(motion, touched, rates, found, error)
      type(motion_t), target, intent(inout) :: motion      !! the motion, at events
      integer, intent(in) :: touched(:, :)                 !! (3, n) contacts that start or end: set, contact of it, number
      real(wp), intent(in) :: rates(:)                     !! (n) penetration rates [m/s]
      type(found_t), intent(inout) :: found                !! results
      type(error_t), allocatable, intent(out) :: error     !! no way to continue

      logical :: is_onset(size(rates))
      integer :: c, i, k

      associate (mover => motion%mover, method => motion%mover%method, system => motion%mover%system)
         call look_for_parting_events(motion)
         do k = 1, size(rates)
            is_onset(k) = .not. system%clearance_joints%sets(touched(1, k))%set%contact(touched(2, k))%is_touching
            if (is_onset(k)) found%onset = [found%onset, method%t]
            if (is_onset(k)) call look_for_grazing(motion, touched(3, k), rates(k), found)
            do i = 1, size(motion%results)
               call motion%results(i)%at_touch(touched(3, k), touched(1, k), touched(2, k), is_onset(k), method%t, rates(k), &
                                               motion%columns, found)
            end do
         end do
         found%n_event = found%n_event + 1
         call handle_part_events(mover%part, mover%tally, mover%nothing, error)
         if (allocated(error)) return
         motion%behind = mover%part%monitor%shift
         motion%is_behind_events = .true.
         do c = 1, size(motion%columns)
            do k = 1, size(rates)
               motion%columns(c)%u(touched(3, k)) = merge(motion%columns(c)%rate(touched(3, k)), 0.0_wp, is_onset(k))
            end do
         end do
         call drop_deflections(motion, touched)
      end associate
      call take_over_memory(motion)
      call look_for_rest(motion)
      do k = 1, size(motion%results)
         call motion%results(k)%at_start(motion%mover%system, motion%mover%method, motion%catalogue, motion%columns, found)
      end do
   end subroutine pass_events

   !> Deflections of bristles of contacts that start or end start at nothing, whenever that is.
   subroutine drop_deflections(motion, touched)
      type(motion_t), intent(inout) :: motion    !! the motion, behind the events
      integer, intent(in) :: touched(:, :)       !! (3, n) the contacts: set, contact of it, number

      integer :: c, k

      do k = 1, size(touched, 2)
         associate (stick_slip => motion%mover%system%clearance_joints%sets(touched(1, k))%set%stick_slip, &
                    place => motion%mover%system%bristle_place(touched(1, k), touched(2, k)))
            if (stick_slip%memory /= memory_bristle) cycle
            do c = 1, size(motion%columns)
               motion%columns(c)%s(place + 1:place + stick_slip%n_component) = 0.0_wp
            end do
         end associate
      end do
   end subroutine drop_deflections

   !> The mechanisms beside take over what that of the deck remembers.
   subroutine take_over_memory(motion)
      type(motion_t), intent(inout) :: motion    !! the motion

      type(archive_t) :: none
      integer :: k

      motion%variation%memory = none
      call motion%mover%system%save(motion%variation%memory)
      do k = 1, size(motion%columns)
         if (motion%columns(k)%is_active) call motion%columns(k)%remember(motion%variation)
      end do
   end subroutine take_over_memory

   !> Events at one instant that are not at one instant when the parameter changes: the motion has no derivative there.
   subroutine look_for_parting_events(motion)
      type(motion_t), intent(inout) :: motion    !! the motion, at the events

      real(wp), dimension(motion%mover%system%n_event) :: g, rate
      integer :: c, k

      associate (method => motion%mover%method, system => motion%mover%system)
         if (method%events%n_happened < 2) return
         call system%events(method%t, method%step%y1, g, rate)
         do c = 1, size(motion%columns)
            associate (column => motion%columns(c))
               if (.not. column%is_active) cycle
               do k = 2, method%events%n_happened
                  associate (n => method%events%happened(k))
                     if (abs(column%gap(n)) <= apart*abs(rate(n))*(abs(column%theta) + eps*method%t/column%size)) cycle
                     if (abs(column%gap(n))*abs(column%beside(1)%e) <= 100.0_wp*eps*system%linkage%scales%length) cycle
                     call refuse(motion, c, "events at one instant are apart when the parameter changes")
                  end associate
               end do
            end associate
         end do
      end associate
   end subroutine look_for_parting_events

   !> The change of the parameter at which an onset would graze: it must not be next to nothing.
   subroutine look_for_grazing(motion, contact, rate, found)
      type(motion_t), intent(inout) :: motion    !! the motion, at the onset
      integer, intent(in) :: contact             !! its number
      real(wp), intent(in) :: rate               !! impact speed [m/s]
      type(found_t), intent(inout) :: found      !! distances follow

      real(wp) :: distance
      integer :: c

      do c = 1, size(motion%columns)
         associate (column => motion%columns(c))
            if (.not. column%is_active .or. .not. abs(column%rate(contact)) > 0.0_wp) cycle
            distance = abs(rate/column%rate(contact))
            if (distance > far*column%size) cycle
            found%grazing(c) = min(found%grazing(c), distance)
            if (distance < min_distance*column%size) call refuse(motion, c, "an onset grazes when the parameter changes by "// &
                                                                 real_text(distance, 2)//" SI units")
         end associate
      end do
   end subroutine look_for_grazing

   !> A contact that comes to rest has a maximum rate that the program sets, once.
   subroutine look_for_rest(motion)
      type(motion_t), intent(inout) :: motion    !! the motion, behind events

      integer :: c, k

      do k = 1, size(motion%mover%system%clearance_joints%sets)
         associate (set => motion%mover%system%clearance_joints%sets(k)%set)
            if (.not. any(set%contact%is_touching .and. set%contact%course == rests)) cycle
            do c = 1, size(motion%columns)
               call refuse(motion, c, "a contact whose normal law jumps where it turns comes to rest, which is not supported")
            end do
         end associate
      end do
   end subroutine look_for_rest

   !> Pass an instant at which functions of time are not smooth; velocities may jump with drivers.
   subroutine pass_instant(motion, error)
      type(motion_t), target, intent(inout) :: motion      !! the motion, at the instant
      type(error_t), allocatable, intent(out) :: error     !! no way to continue

      integer :: c, i, k, status

      associate (mover => motion%mover, method => motion%mover%method, tool => motion%map%tool)
         do c = 1, size(motion%columns)
            if (motion%columns(c)%is_active .and. abs(motion%columns(c)%theta) > 0.0_wp) then
               call refuse(motion, c, "an event happens at an instant at which a function of time is not smooth")
            end if
            if (.not. motion%columns(c)%is_active) cycle
            do k = 1, 4
               associate (b => motion%columns(c)%beside(k))
                  b%y = method%step%y1 + b%e*motion%columns(c)%s
                  tool%step%y1 = b%y
                  tool%t = method%t
                  call b%jumps%before_instant(b%system, tool)
               end associate
            end do
         end do
         call pass_part_instant(mover%part, mover%tally, mover%nothing, error)
         if (allocated(error)) return
         motion%behind = 0.0_wp
         motion%is_behind_events = .true.
         call take_over_memory(motion)
         do c = 1, size(motion%columns)
            if (.not. motion%columns(c)%is_active) cycle
            do k = 1, 4
               associate (b => motion%columns(c)%beside(k))
                  tool%step%y1 = b%y
                  tool%t = method%t
                  call b%jumps%after_instant(b%system, tool, status)
                  b%y = tool%step%y1
               end associate
               if (status /= 0) call refuse(motion, c, "velocities jump, and the equations cannot be solved beside")
            end do
            associate (b => motion%columns(c)%beside)
               do i = 1, size(motion%columns(c)%s)
                  motion%columns(c)%s(i) = derivative([b(1)%y(i), b(2)%y(i), b(3)%y(i), b(4)%y(i)], b%e)
               end do
            end associate
         end do
         if (method%events%n_happened == 0) return
         do c = 1, size(motion%columns)
            call refuse(motion, c, "an instant at which a function of time is not smooth brings an event about")
         end do
         call handle_part_events(mover%part, mover%tally, mover%nothing, error)
      end associate
   end subroutine pass_instant

   !> The derivative by a parameter ends here.
   subroutine refuse(motion, c, reason)
      type(motion_t), intent(inout) :: motion    !! the motion
      integer, intent(in) :: c                   !! number of the parameter
      character(*), intent(in) :: reason         !! why

      if (.not. motion%columns(c)%is_active) return
      motion%columns(c)%is_active = .false.
      motion%columns(c)%reason = reason
   end subroutine refuse

   !> Since when derivatives have ended, and why.
   subroutine note_failures(motion, found)
      type(motion_t), intent(in) :: motion       !! the motion
      type(found_t), intent(inout) :: found      !! reasons follow

      integer :: c

      do c = 1, size(motion%columns)
         if (motion%columns(c)%is_active .or. found%reason(c)%s /= "") cycle
         found%until(c) = motion%mover%method%t
         found%reason(c)%s = motion%columns(c)%reason//" (t = "//real_text(motion%mover%method%t, 6)//" s)"
      end do
   end subroutine note_failures

end module sensitivity_motion
