!> A motion under way, with the derivatives that go along with it and the results that are looked for.
module derived_motion
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use contact_peaks, only: look, trend_t
   use contact_places, only: touch_function
   use kinds, only: wp
   use mover, only: mover_t
   use result_tracker, only: tracker_t
   use sensitivity_column, only: column_t
   use sensitivity_results, only: found_t
   use step_map, only: section_function, section_t, section_time, step_map_t
   use text, only: real_text
   use varied_system, only: variation_t
   implicit none (type, external)
   private
   public :: find_section, list_touched, motion_t, note_failures, refuse, restore, take_over_memory

   real(wp), parameter :: late = 0.25_wp             !! time to the end of a contact that parts, of the time since its onset [1]
   real(wp), parameter :: fast = 0.3_wp              !! the same, times its characteristic rate: not next to a turn [1]

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

end module derived_motion
