!> A mechanism with one parameter changed a little, which goes beside the mechanism of the deck.
!>
!> It has the same coordinates, contacts and event functions, and the contacts are in the same states: what the mechanism of the
!> deck remembers is copied after every event. Limits: a parameter on which the number of coordinates, contacts or event functions
!> depends, or an instant at which a function of time is not smooth.
module varied_system
   use archive, only: archive_t
   use catalogue, only: catalogue_t
   use errors, only: error_t
   use jobs, only: first_line, job_t, start_job, started_t
   use kinds, only: eps, wp
   use build_system, only: new_system
   use mechanism, only: mechanism_t
   use mechanism_catalogue, only: bind_channels, build_catalogue
   use output_times, only: new_output_times, output_times_t
   use parameter_source, only: parameter_source_t
   use precision_info, only: setting_t
   use smooth_segment, only: smooth_segment_t
   use velocity_jumps, only: velocity_jumps_t
   implicit none (type, external)
   private
   public :: free_mechanisms, instants_of, variation_t, varied_t, want_only

   integer, parameter :: n_instant_compared = 1000    !! instants of functions of time that are compared
   real(wp), parameter :: same_instant = 8.0_wp*eps   !! difference of instants that is round-off, of the time [1]

   !> How mechanisms beside that of the deck are made. Source and mechanism of the deck must be targets.
   type :: variation_t
      class(parameter_source_t), pointer :: source => null()   !! where scenes come from
      type(mechanism_t), pointer :: base => null()             !! the mechanism of the deck
      type(setting_t) :: setting                 !! of the integration
      real(wp) :: tolerance = 0.0_wp             !! of the integration [1]
      integer, allocatable :: channels(:, :)     !! (3, n) group, component and item of those that are reported
      real(wp), allocatable :: instants(:)       !! (m) at which functions of time are not smooth [s]
      type(archive_t) :: memory                  !! what the mechanism of the deck remembers since the last event
   end type variation_t

   !> The mechanism beside.
   type :: varied_t
      type(mechanism_t) :: system                !! its equations
      type(catalogue_t) :: catalogue             !! what it reports: the channels that are asked for
      type(velocity_jumps_t) :: jumps            !! drivers whose velocities jump
      real(wp) :: e = 0.0_wp                     !! the parameter less its value in the deck [any]
      real(wp), allocatable :: start(:)          !! (n) state at t = 0 [any]
      real(wp), allocatable :: y(:)              !! (n) state at the end of the step in hand [any]
      real(wp), allocatable :: ydot(:)           !! (n) scratch [any]
      real(wp), allocatable :: speed(:)          !! (contacts) impact speeds of those that start there [m/s]
      real(wp) :: t = 0.0_wp                     !! time at the end of the step in hand [s]
      real(wp) :: h = 0.0_wp                     !! length of this step [s]
   contains
      procedure :: make => make_varied
      procedure :: remember
   end type varied_t

contains

   !> Make the mechanism with another value of the parameter.
   subroutine make_varied(self, variation, number, value, reason, is_lasting)
      class(varied_t), target, intent(inout) :: self       !! the mechanism
      type(variation_t), intent(inout) :: variation        !! how it is made
      integer, intent(in) :: number                        !! of the parameter
      real(wp), intent(in) :: value                        !! of the parameter [any]
      character(:), allocatable, intent(out) :: reason     !! why it cannot be; blank: it can
      logical, intent(out) :: is_lasting                   !! nor can it be with another value

      type(error_t), allocatable :: error
      type(job_t) :: job
      type(started_t) :: begin
      real(wp), allocatable :: own(:)

      is_lasting = .false.
      call variation%source%make(number, value, job, reason)
      if (reason /= "") return
      call variation%setting%apply(variation%tolerance, job%scene%settings%integration)
      call new_system(job%scene, job%levels, self%system)
      associate (system => self%system, base => variation%base, instants => variation%instants)
         if (system%n /= base%n .or. system%n_position /= base%n_position .or. system%n_event /= base%n_event .or. &
             system%clearance_joints%n_contact /= base%clearance_joints%n_contact) then
            reason = "the coordinates or the contacts of the mechanism depend on it"
            is_lasting = .true.
            return
         end if
         call start_job(job, system, begin, error)
         if (allocated(error)) then
            reason = "no start beside that of the deck: "//first_line(error%message)
            return
         end if
         self%start = begin%y
         if (.not. allocated(self%y)) then
            allocate (self%y(system%n), self%ydot(system%n), self%speed(system%clearance_joints%n_contact), source=0.0_wp)
         end if
         call build_catalogue(system, self%catalogue)
         call want_only(system, variation%channels, self%catalogue)
         call system%begin_pace(0.0_wp, begin%y, job%plan%end)
         own = instants_of(job, system)
         if (size(own) /= size(instants)) then
            reason = "instants at which functions of time are not smooth depend on it"
         else if (any(abs(own - instants) > same_instant*abs(instants))) then
            reason = "instants at which functions of time are not smooth depend on it"
         end if
         is_lasting = reason /= ""
      end associate
   end subroutine make_varied

   !> Free mechanisms with all that they hold, which `deallocate` of a pointer does not do (gfortran 12).
   subroutine free_mechanisms(list)
      type(varied_t), pointer, intent(inout) :: list(:)   !! (any) the mechanisms; null afterwards

      integer :: k

      do k = 1, size(list)
         call forget(list(k))
      end do
      deallocate (list)

   contains

      !> Free what a mechanism holds.
      subroutine forget(one)
         type(varied_t), intent(out) :: one   !! the mechanism
      end subroutine forget

   end subroutine free_mechanisms

   !> Report some channels only.
   subroutine want_only(system, channels, catalogue)
      type(mechanism_t), intent(in) :: system          !! the system
      integer, intent(in) :: channels(:, :)            !! (3, n) group, component and item
      type(catalogue_t), intent(inout) :: catalogue    !! what it can report

      integer :: k

      do k = 1, size(catalogue%groups)
         catalogue%groups(k)%is_wanted = .false.
      end do
      do k = 1, size(channels, 2)
         catalogue%groups(channels(1, k))%is_wanted(channels(3, k)) = .true.
      end do
      call bind_channels(system, catalogue)
   end subroutine want_only

   !> The instants of a scene at which its functions of time are not smooth.
   function instants_of(job, system) result(times)
      type(job_t), intent(in) :: job                !! the scene
      type(mechanism_t), intent(in) :: system       !! its system
      real(wp), allocatable :: times(:)             !! (any) up to the end of the motion, the first ones [s]

      type(output_times_t) :: output_times
      type(smooth_segment_t) :: segment

      times = [real(wp) ::]
      call new_output_times(job%scene, job%plan%end, system%clearance_joints%n > 0, output_times)
      call output_times%begin(job%plan%end, segment)
      do while (output_times%next%at < job%plan%end .and. size(times) < n_instant_compared)
         times = [times, output_times%next%at]
         call output_times%pass(segment)
      end do
   end function instants_of

   !> Take over what the mechanism of the deck remembers, and the impact speeds beside its own.
   subroutine remember(self, variation, change)
      class(varied_t), intent(inout) :: self        !! the mechanism
      type(variation_t), intent(in) :: variation    !! what the mechanism of the deck remembers
      real(wp), intent(in) :: change(:)             !! (contacts) derivative of its impact speeds [any]

      type(archive_t) :: copy
      integer :: i, k, number

      copy = variation%memory
      copy%place = 0
      call self%system%load(copy)
      do k = 1, size(variation%base%clearance_joints%sets)
         associate (set => variation%base%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               if (.not. set%contact(i)%is_touching) cycle
               number = set%before%contacts + i
               call self%system%clearance_joints%sets(k)%set%set_impact_speed(i, set%contact(i)%impact_speed &
                                                                              + self%e*change(number))
            end do
         end associate
      end do
   end subroutine remember

end module varied_system
