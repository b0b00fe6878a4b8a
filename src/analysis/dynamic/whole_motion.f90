!> The motion of a whole mechanism, whose parts make their own steps.
!>
!> The part that is behind steps next, so that all parts have steps that hold the time that all have reached; there the state of
!> the whole is put together, for reports. A mechanism whose bodies are all joined is one part, and its state is that of the
!> integrator.
module whole_motion
   use contact_places, only: n_loss, n_quadratures, place_of_film_loss, place_of_joint_loss, place_of_loss
   use friction_law, only: memory_bristle
   use guards, only: guards_t
   use output_times, only: output_times_t
   use integrator, only: advance_event, integrator_t
   use kinds, only: wp
   use mechanism, only: mechanism_t
   use moving_part, only: moving_part_t, new_part
   use run_audit, only: limits_t
   use subsystems, only: subsystem_t
   use time_queue, only: time_queue_t
   implicit none (type, external)
   private
   public :: new_whole_motion, whole_motion_t

   !> All parts, and how far they are.
   type :: whole_motion_t
      type(mechanism_t), pointer :: system => null()         !! the whole, for reports
      type(moving_part_t), allocatable :: parts(:)           !! (parts) its parts
      real(wp) :: t = 0.0_wp                                 !! time that all have reached [s]
      integer, allocatable :: front(:)                       !! (parts) those that are there, the first n_front
      integer :: n_front = 0                                 !! how many
      logical :: is_smooth = .true.                          !! the motion continues as it is: no part there has an event or an
                                                             !! instant, or a guard that ends the run
      integer :: n_peak = 0                                  !! parts with peaks to be reported
      type(output_times_t) :: output_times  !! of several parts: when functions of time of any are not smooth
      type(subsystem_t), pointer, private :: places(:) => null()  !! (parts) where they are in the whole; a single part: none
      type(time_queue_t), private :: queue                   !! parts that are ahead, by their time
      integer, allocatable, private :: with_peak(:)          !! (parts) those with peaks to be reported, the first n_peak
      real(wp), allocatable, private :: q(:), v(:)           !! (n_q bodies), (n_v bodies) scratch: coordinates and rates [any]
      real(wp), allocatable, private :: y(:)                 !! (most of a part) scratch: state of a part [any]
   contains
      procedure :: scatter => whole_scatter
      procedure :: move_front => whole_move_front
      procedure :: next_peak => whole_next_peak
      procedure :: drop_peaks => whole_drop_peaks
      procedure :: note_row => whole_note_row
      procedure :: owes_row => whole_owes_row
      procedure :: state_at => whole_state_at
      procedure :: is_evaluated => whole_is_evaluated
      procedure :: seen => whole_observed
      procedure :: is_together => whole_is_together
   end type whole_motion_t

contains

   !> The whole as one part, or as several.
   subroutine new_whole_motion(system, method, subsystems, limits, output_times, whole)
      type(mechanism_t), intent(inout), target :: system           !! the whole
      class(integrator_t), intent(inout), target :: method         !! its integrator, if it is one part
      type(subsystem_t), intent(inout), target :: subsystems(:)    !! (parts) its parts; none: it is one
      type(limits_t), intent(in) :: limits                         !! guards of the whole
      type(output_times_t), intent(in) :: output_times                     !! when functions of time of any are not smooth
      type(whole_motion_t), intent(out) :: whole                   !! at the start; points at the arguments

      type(guards_t) :: guards
      integer :: k, n

      n = max(size(subsystems), 1)
      whole%system => system
      whole%n_front = n
      allocate (whole%parts(n), whole%front(n), whole%with_peak(n))
      whole%front = [(k, k=1, n)]
      call whole%queue%start(n)
      if (size(subsystems) == 0) then
         call new_part(system, method, output_times, limits%guards, whole%parts(1))
         whole%parts(1)%monitor%wear%from = limits%wear_from
         return
      end if
      whole%places => subsystems
      whole%output_times = output_times
      associate (coordinates => system%linkage%coordinates, n_body => system%linkage%bodies%n)
         allocate (whole%q(coordinates%n_q*n_body), whole%v(coordinates%n_v*n_body), source=0.0_wp)
      end associate
      allocate (whole%y(maxval([(subsystems(k)%system%n, k=1, n)])), source=0.0_wp)
      do k = 1, n
         call limits%guards%share(contacts_of(system, subsystems(k)), guards)
         call new_part(subsystems(k)%system, subsystems(k)%method, subsystems(k)%output_times, guards, whole%parts(k))
         whole%parts(k)%monitor%wear%from = limits%wear_from
      end do
   end subroutine new_whole_motion

   !> Numbers of the contacts of a part among those of the whole.
   pure function contacts_of(system, place) result(numbers)
      type(mechanism_t), intent(in) :: system    !! the whole
      type(subsystem_t), intent(in) :: place     !! the part
      integer, allocatable :: numbers(:)         !! (contacts of the part) numbers in the whole

      integer :: k

      allocate (numbers(size(place%slot)))
      do k = 1, size(numbers)
         numbers(k) = system%clearance_joints%sets(place%slot(k))%set%before%contacts + place%contact(k)
      end do
   end function contacts_of

   !> The state of a part from one of the whole.
   subroutine whole_scatter(self, part, y_whole, y)
      class(whole_motion_t), intent(inout) :: self        !! the motion
      integer, intent(in) :: part                         !! number of the part
      real(wp), intent(in) :: y_whole(:)                  !! (n of the whole) state at the start [any]
      real(wp), allocatable, intent(out) :: y(:)          !! (n of the part) its state [any]

      integer :: k

      if (.not. associated(self%places)) then
         y = y_whole
         return
      end if
      associate (system => self%parts(part)%system, place => self%places(part), coordinates => self%system%linkage%coordinates)
         if (part == 1) call self%system%linkage%set_motion(0.0_wp, y_whole)
         associate (n_q => coordinates%n_q, n_v => coordinates%n_v)
            do k = 1, size(place%body)
               call coordinates%read_motion(self%system%linkage%motion, place%body(k), self%q(n_q*(k - 1) + 1:n_q*k), &
                                            self%v(n_v*(k - 1) + 1:n_v*k))
            end do
            allocate (y(system%n), source=0.0_wp)
            call system%linkage%take_state(self%q(:n_q*size(place%body)), self%v(:n_v*size(place%body)), y)
         end associate
      end associate
   end subroutine whole_scatter

   !> All parts of the front have made a step: those that are behind now are the front. A single part is always there.
   pure subroutine whole_move_front(self)
      class(whole_motion_t), intent(inout) :: self   !! the motion

      integer :: k

      if (.not. associated(self%places)) then
         self%t = self%parts(1)%method%t
         if (self%parts(1)%monitor%n_peak > 0) call note_peak(self, 1)
         self%is_smooth = goes_on(self%parts(1))
         return
      end if
      do k = 1, self%n_front
         call self%queue%add(self%parts(self%front(k))%method%t, self%front(k))
         if (self%parts(self%front(k))%monitor%n_peak > 0) call note_peak(self, self%front(k))
      end do
      call self%queue%take_first(self%t, self%front, self%n_front)
      self%is_smooth = .true.
      do k = 1, self%n_front
         self%is_smooth = self%is_smooth .and. goes_on(self%parts(self%front(k)))
      end do
   end subroutine whole_move_front

   !> Note that a part has peaks to be reported.
   pure subroutine note_peak(self, part)
      type(whole_motion_t), intent(inout) :: self   !! the motion
      integer, intent(in) :: part                   !! number of the part

      self%n_peak = self%n_peak + 1
      self%with_peak(self%n_peak) = part
   end subroutine note_peak

   !> Whether a part continues as it is: without an event or an instant where it is, or a guard that ends the run.
   pure logical function goes_on(part)
      type(moving_part_t), intent(in) :: part   !! the part

      goes_on = .not. (part%status == advance_event .or. part%method%t >= part%output_times%next%at &
                       .or. allocated(part%guards%reason))
   end function goes_on

   !> Time of the first peak that is not reported; far away if there is none.
   pure real(wp) function whole_next_peak(self) result(t)
      class(whole_motion_t), intent(in) :: self   !! the motion

      integer :: k

      t = huge(1.0_wp)
      do k = 1, self%n_peak
         t = min(t, self%parts(self%with_peak(k))%monitor%peaks(1)%t)
      end do
   end function whole_next_peak

   !> The peaks up to a time are reported, or need not be.
   subroutine whole_drop_peaks(self, t)
      class(whole_motion_t), intent(inout) :: self   !! the motion
      real(wp), intent(in) :: t                      !! the time [s]

      integer :: k, n

      n = 0
      do k = 1, self%n_peak
         associate (monitor => self%parts(self%with_peak(k))%monitor)
            call monitor%drop_peaks(t)
            if (monitor%n_peak == 0) cycle
         end associate
         n = n + 1
         self%with_peak(n) = self%with_peak(k)
      end do
      self%n_peak = n
   end subroutine whole_drop_peaks

   !> A row was written at the time that all have reached: parts that are there owe none.
   subroutine whole_note_row(self)
      class(whole_motion_t), intent(inout) :: self   !! the motion

      integer :: k

      do k = 1, self%n_front
         call self%parts(self%front(k))%monitor%note_row()
      end do
   end subroutine whole_note_row

   !> Whether the present force of a contact of a part at the front is its maximum so far, and no row reports it.
   pure logical function whole_owes_row(self) result(owes)
      class(whole_motion_t), intent(in) :: self   !! the motion

      integer :: k

      owes = .false.
      do k = 1, self%n_front
         owes = owes .or. any(self%parts(self%front(k))%monitor%owes_row)
      end do
   end function whole_owes_row

   !> Whether all parts have come to the same time.
   pure logical function whole_is_together(self) result(is_together)
      class(whole_motion_t), intent(in) :: self   !! the motion

      is_together = self%n_front == size(self%parts)
   end function whole_is_together

   !> What the guards of all parts have seen.
   subroutine whole_observed(self, guards)
      class(whole_motion_t), intent(in) :: self   !! the motion
      type(guards_t), intent(inout) :: guards     !! of the whole

      integer :: p

      if (.not. associated(self%places)) then
         guards = self%parts(1)%guards
         return
      end if
      call guards%begin(self%system)
      do p = 1, size(self%parts)
         call guards%gather(self%parts(p)%guards, self%places(p)%body, contacts_of(self%system, self%places(p)))
      end do
   end subroutine whole_observed

   !> State of the whole at a time that the last steps of all parts hold; the contacts of the whole become as those of the parts.
   subroutine whole_state_at(self, t, at_peak, shift, y)
      class(whole_motion_t), intent(inout) :: self        !! the motion
      real(wp), intent(in) :: t                           !! the time [s]
      logical, intent(in) :: at_peak                      !! with the states of peaks at just this time
      real(wp), intent(in) :: shift                       !! so much beyond it along the motion, for parts whose step ends there [s]
      real(wp), intent(inout), contiguous :: y(:)         !! (n of the whole) the state [any]

      integer :: k, p

      if (.not. associated(self%places)) then
         call part_state_at(self%parts(1), t, at_peak, shift, y)
         return
      end if
      y = 0.0_wp
      do p = 1, size(self%parts)
         associate (part => self%parts(p), place => self%places(p), coordinates => self%system%linkage%coordinates, &
                    own => self%y(:self%parts(p)%system%n))
            call part_state_at(part, t, at_peak, shift, own)
            call part%system%linkage%set_motion(t, own)
            associate (n_q => coordinates%n_q, n_v => coordinates%n_v)
               do k = 1, size(place%body)
                  call coordinates%read_motion(part%system%linkage%motion, k, &
                                               self%q(n_q*(place%body(k) - 1) + 1:n_q*place%body(k)), &
                                               self%v(n_v*(place%body(k) - 1) + 1:n_v*place%body(k)))
               end do
            end associate
            call add_contacts(self%system, place, part%system, own, y)
         end associate
      end do
      call self%system%linkage%take_state(self%q, self%v, y)
   end subroutine whole_state_at

   !> Whether a time is the end of the last step of a single part, and its system was evaluated there and nowhere since. Not
   !> where friction is iterated: the last digits of an evaluation depend on the evaluation before.
   pure logical function whole_is_evaluated(self, t) result(is_evaluated)
      class(whole_motion_t), intent(in) :: self  !! the motion
      real(wp), intent(in) :: t                  !! the time [s]

      is_evaluated = .false.
      if (associated(self%places)) return
      associate (part => self%parts(1), friction => self%parts(1)%system%friction)
         if (friction%stick_slips%n_slip > 0 .or. friction%rubbing%n > 0) return
         is_evaluated = part%n_evaluations == part%system%n_evaluations .and. .not. abs(t - part%method%t) > 0.0_wp
      end associate
   end function whole_is_evaluated

   !> State of a part at a time that its last step holds.
   subroutine part_state_at(part, t, at_peak, shift, y)
      type(moving_part_t), intent(inout) :: part   !! the part
      real(wp), intent(in) :: t                    !! the time [s]
      logical, intent(in) :: at_peak               !! that of a peak at just this time, if there is one
      real(wp), intent(in) :: shift                !! so much beyond it along the motion, if the step ends there [s]
      real(wp), intent(inout) :: y(part%system%n)  !! (n) the state [any]

      integer :: k

      if (at_peak) then
         do k = 1, part%monitor%n_peak
            if (part%monitor%peaks(k)%t < t .or. part%monitor%peaks(k)%t > t) cycle
            y = part%monitor%peaks(k)%y
            return
         end do
      end if
      call part%method%reach(part%system, t, y)
      if (shift > 0.0_wp .and. t >= part%method%t) y = y + shift*part%method%step%f1
   end subroutine part_state_at

   !> Contacts and joints with friction of a part in the whole: what they remember, and their places in the state; works and losses
   !> of the ledger.
   subroutine add_contacts(whole, place, system, own, y)
      type(mechanism_t), intent(inout) :: whole        !! the whole
      type(subsystem_t), intent(in) :: place           !! the part
      type(mechanism_t), intent(in) :: system          !! its system
      real(wp), intent(in) :: own(:)                   !! (n of the part) its state [any]
      real(wp), intent(inout) :: y(:)                  !! (n of the whole) state of the whole [any]

      integer :: from, i, k, m, to

      m = 0
      do k = 1, size(system%clearance_joints%sets)
         associate (set => system%clearance_joints%sets(k)%set)
            do i = 1, set%n_contact
               m = m + 1
               associate (target => whole%clearance_joints%sets(place%slot(m))%set, c => place%contact(m))
                  call target%adopt(c, set, i)
                  if (set%stick_slip%memory == memory_bristle) then
                     from = system%bristle_place(k, i)
                     to = whole%bristle_place(place%slot(m), c)
                     y(to + 1:to + set%stick_slip%n_component) = own(from + 1:from + set%stick_slip%n_component)
                  end if
                  y(whole%place_of_impulse(target%before%contacts + c)) = own(system%place_of_impulse(m))
                  if (system%n_wear > 0) then
                     y(whole%place_of_wear(target%before%contacts + c)) = own(system%place_of_wear(m))
                  end if
                  if (.not. system%ledger%is_kept) cycle
                  from = system%in_state(place_of_loss(m, 1))
                  to = whole%in_state(place_of_loss(target%before%contacts + c, 1))
                  y(to:to + n_loss - 1) = own(from:from + n_loss - 1)
               end associate
            end do
         end associate
      end do
      do k = 1, system%friction%rubbing%n
         if (system%friction%rubbing%bristle(k) == 0) cycle
         y(whole%rubbing_place(place%rubbing(k))) = own(system%rubbing_place(k))
      end do
      if (.not. system%ledger%is_kept) return
      if (system%friction%rubbing%n > 0) then
         from = system%in_state(place_of_joint_loss(system%clearance_joints%n_contact))
         to = whole%in_state(place_of_joint_loss(whole%clearance_joints%n_contact))
         y(to) = y(to) + own(from)
      end if
      if (system%clearance_joints%has_films) then
         from = system%in_state(place_of_film_loss(system%clearance_joints%n_contact, system%friction%rubbing%n > 0))
         to = whole%in_state(place_of_film_loss(whole%clearance_joints%n_contact, whole%friction%rubbing%n > 0))
         y(to) = y(to) + own(from)
      end if
      from = system%in_state(0)
      to = whole%in_state(0)
      y(to + 1:to + n_quadratures(0)) = y(to + 1:to + n_quadratures(0)) + own(from + 1:from + n_quadratures(0))
   end subroutine add_contacts

end module whole_motion
