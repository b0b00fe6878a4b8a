!> Events and instants of a motion, which derivatives and results go across.
!>
!> Refused, with the time: contacts that come to rest (their speed of rest is set by the program), events at one instant that part
!> when the parameter changes, events at instants of functions of time, and onsets next to grazing.
module derived_events
   use contact_memory, only: rests
   use derived_motion, only: motion_t, refuse, take_over_memory
   use errors, only: error_t
   use friction_law, only: memory_bristle
   use kinds, only: eps, wp
   use moving_part, only: handle_part_events, pass_part_instant
   use sensitivity_column, only: derivative
   use sensitivity_results, only: found_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: pass_events, pass_instant

   real(wp), parameter :: apart = 1.0e-6_wp          !! shift between events at one instant, of the shift of the first [1]
   real(wp), parameter :: far = 1.0e3_wp             !! a change that is never made, of the parameter [1]
   real(wp), parameter :: min_distance = 1.0e-7_wp   !! change at which an onset would graze, of the parameter, at least [1]

contains

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
            if (is_onset(k)) then
               found%onset = [found%onset, method%t]
               found%contact = [found%contact, touched(3, k)]
               found%speed = [found%speed, rates(k)]
            end if
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

end module derived_events
