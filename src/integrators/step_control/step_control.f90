!> Length of the steps of a one-step method, from its error estimates and the events that are predicted.
!>
!> A step is accepted if the norm E of the error estimate over the tolerance is at most 1. With p the order of the method and E_0
!> the norm of the step before, but at least 0.01,
!>
!> $$ h' = 0.93 E^{-0.8125/p} E_0^{0.25/p} h, $$
!>
!> at most 4 h, and no more than h right after a rejection. A step that was rejected is tried again with h' = 0.93 E^(-1/p) h, at
!> minimum h/10.
!>
!> A force like delta^1.5 that starts or ends in a step leaves an error of the order h^2.5, whatever the method. Where a step is
!> rejected right after a restart, or across an event, 2.5 stands for p; where it is rejected again, what the two estimates show.
!> A method that can let time go as a square (`step_course`) does so in the first step of a contact and in the last one: 4.5 then.
!>
!> Contacts: their first step is a part of the step that suits them, and so is the last one; from contact to contact the estimates
!> report how great a part. What comes before the last step ends there, and what comes after the first one is smooth: it is
!> up to twice as long, whatever the estimate of the first.
!>
!> Events: a step that would continue beyond an event predicted (`event_prediction`) ends a little behind it. If it is rejected, its
!> estimate reports from where on a step across will do; until then each step takes a part of the way to the event. An event much
!> nearer than a step is long is not worth one, until such a step is rejected.
!>
!> After a restart with a step that suits what starts, the step of before is kept for when it has ended.
!>
!> Source: E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), section II.4; the
!> norm of the step before: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.2.
!> Limits: without an estimate (fixed steps) nothing here is called.
module step_control
   use kinds, only: wp
   use archive, only: archive_t
   use step_course, only: course_even, course_from_root, course_to_root
   implicit none (type, external)
   private
   public :: step_control_t

   real(wp), parameter :: safety = 0.93_wp     !! of the step that the estimate would allow [1]
   real(wp), parameter :: contact_rate = 0.25_wp      !! how far the step of before counts; of what that takes, three quarters [1]
   real(wp), parameter :: min_norm = 0.01_wp !! of the step before, where it counts [1]
   real(wp), parameter :: growth = 4.0_wp      !! maximum ratio of successive steps [1]
   real(wp), parameter :: shrinkage = 0.1_wp   !! minimum ratio of successive steps [1]
   real(wp), parameter :: rough = 2.5_wp       !! order where the right-hand side is not smooth [1]
   real(wp), parameter :: bent = 4.5_wp        !! the same, where time goes as a square [1]
   real(wp), parameter :: after_root = 2.0_wp  !! ratio of the second step of a contact to the first, at most [1]
   real(wp), parameter :: behind = 1.02_wp     !! end of a step across an event, of the way to it [1]
   real(wp), parameter :: nearer = 0.6_wp      !! end of a step towards an event, of the way to it [1]
   real(wp), parameter :: ahead = 0.8_wp       !! last step of a contact that the one before leaves, of the longest that will do [1]
   real(wp), parameter :: longer = 2.0_wp      !! last step of a contact, of an even one there, at most [1]
   real(wp), parameter :: worth = 0.01_wp      !! minimum part of a step that it is shortened to for an event [1]

   !> The control.
   type :: step_control_t
      real(wp) :: order = 1.0_wp                  !! p of the method [1]
      real(wp) :: h_most = huge(1.0_wp)           !! longest step that the method can make [s]
      real(wp) :: h_next = 0.0_wp                 !! step to try next [s]
      real(wp) :: h_before = 0.0_wp               !! step before a disturbance started, 0: none [s]
      real(wp) :: h_event = huge(1.0_wp)          !! time to the next event predicted, huge: none [s]
      logical :: is_parting = .false.             !! it is the end of a contact
      logical :: bends = .false.                  !! time may go as a square
      integer :: course = course_even             !! how it goes in the step in hand
      real(wp), private :: h_contact = 0.0_wp     !! step that suits the contact that started last, 0: none yet [s]
      real(wp), private :: first = 1.0_wp         !! first step of a contact, of that [1]
      real(wp), private :: last = huge(1.0_wp)    !! last step of a contact, of that, if less than the first [1]
      logical, private :: is_onset = .false.      !! a contact has just started
      real(wp), private :: log_before = 0.0_wp    !! logarithm of E of the step before [1]
      real(wp), private :: h_across = huge(1.0_wp) !! longest step across an event that will do, as far as is known [s]
      logical, private :: is_fresh = .true.       !! nothing was accepted since the start or a restart
      ! of the step in hand
      logical, private :: is_short = .false.      !! shortened for an event
      logical, private :: is_across = .false.     !! it ends behind an event
      real(wp), private :: h_rejected = 0.0_wp    !! length that was rejected last [s]
      real(wp), private :: norm_rejected = 0.0_wp !! its E, 0: none, huge: not known [1]
   contains
      procedure :: begin => begin_step
      procedure :: length
      procedure :: accept
      procedure :: reject
      procedure :: disturb
      procedure :: save => save_control
      procedure :: load => load_control
   end type step_control_t

contains

   !> A step starts.
   pure subroutine begin_step(self)
      class(step_control_t), intent(inout) :: self  !! the control

      self%norm_rejected = 0.0_wp
   end subroutine begin_step

   !> Length to try.
   real(wp) function length(self) result(h)
      class(step_control_t), intent(inout) :: self  !! the control

      real(wp) :: h_last, wanted

      h = min(self%h_next, self%h_most)
      self%course = merge(course_from_root, course_even, self%bends .and. self%is_fresh .and. self%is_onset)
      self%is_across = .false.
      self%is_short = .false.
      if (.not. self%h_event < huge(1.0_wp)) return
      if (self%is_parting .and. self%bends .and. self%h_contact > 0.0_wp .and. behind*self%h_event > worth*h) then
         h_last = min(self%first, self%last)*self%h_contact
         self%is_across = self%h_event <= min(h_last, longer*h)
         wanted = h
         if (self%is_across) then
            self%course = course_to_root
            h = behind*self%h_event
         else if (self%h_event < h + h_last) then
            h = min(h, max(self%h_event - ahead*h_last, nearer*self%h_event))
         end if
         self%is_short = self%is_across .or. h < wanted
         return
      end if
      self%is_across = behind*self%h_event < h .and. self%h_event <= self%h_across &
                       .and. (behind*self%h_event > worth*h .or. self%h_across < huge(1.0_wp))
      self%is_short = self%is_across .or. (nearer*self%h_event < h .and. self%h_event > min(h/behind, self%h_across))
      if (self%is_across) then
         h = behind*self%h_event
      else if (self%is_short) then
         h = nearer*self%h_event
      end if
   end function length

   !> A step was rejected: what to try instead.
   pure subroutine reject(self, h, norm)
      class(step_control_t), intent(inout) :: self  !! the control
      real(wp), intent(in) :: h                     !! its length [s]
      real(wp), intent(in) :: norm                  !! E; huge: not known [1]

      real(wp) :: power

      power = self%order
      if (self%is_fresh .or. self%is_across) power = merge(rough, bent, self%course == course_even)
      if (self%course == course_to_root) then
         self%last = h/self%h_contact*max(shrinkage, safety*norm**(-1.0_wp/power))
      else if (self%is_across) then
         self%h_across = h*max(shrinkage**2, safety*norm**(-1.0_wp/power))/behind
      end if
      if (self%norm_rejected > norm .and. self%norm_rejected < huge(1.0_wp)) then
         power = min(max(log(self%norm_rejected/norm)/log(self%h_rejected/h), 1.0_wp), self%order)
      end if
      if (self%is_across) then
         self%h_next = nearer*self%h_event
      else
         self%h_next = h*max(shrinkage, safety*norm**(-1.0_wp/power))
      end if
      self%h_rejected = h
      self%norm_rejected = norm
   end subroutine reject

   !> A step was accepted: the length of the next one. A step cut short says little about it.
   pure subroutine accept(self, h, norm, is_last)
      class(step_control_t), intent(inout) :: self  !! the control
      real(wp), intent(in) :: h                     !! its length [s]
      real(wp), intent(in) :: norm                  !! E [1]
      logical, intent(in) :: is_last                !! cut short by the end of a stretch

      real(wp) :: allowed, log_norm, wanted

      log_norm = log(max(norm, tiny(1.0_wp)))
      allowed = safety*exp(((0.75_wp*contact_rate - 1.0_wp)*log_norm + contact_rate*self%log_before)/self%order)
      wanted = h*min(merge(1.0_wp, growth, self%norm_rejected > 0.0_wp), allowed)
      if (self%is_fresh .and. self%is_onset) then
         wanted = max(wanted, after_root*h)
         self%first = part_of_contact(merge(rough, bent, self%course == course_even))
      end if
      if (self%course == course_to_root) self%last = part_of_contact(bent)
      if (is_last .or. self%is_short) then
         self%h_next = max(self%h_next, wanted)
      else
         self%h_next = wanted
      end if
      self%is_fresh = .false.
      self%log_before = max(log_norm, log(min_norm))

   contains

      !> What the first step of a contact, or the last one, may be of the step that suits it.
      pure real(wp) function part_of_contact(power) result(part)
         real(wp), intent(in) :: power   !! of the step in its error [1]

         part = h/self%h_contact*min(growth, safety*max(norm, tiny(1.0_wp))**(-1.0_wp/power))
      end function part_of_contact

   end subroutine accept

   !> The system has changed: nothing is known of what is ahead.
   pure subroutine disturb(self, step_hint, is_onset)
      class(step_control_t), intent(inout) :: self  !! the control
      real(wp), intent(in) :: step_hint             !! step that suits what starts now; 0: as before it started [s]
      logical, intent(in) :: is_onset               !! a contact starts

      self%h_event = huge(1.0_wp)
      self%h_across = huge(1.0_wp)
      self%is_fresh = .true.
      self%log_before = 0.0_wp
      self%is_onset = is_onset .and. step_hint > 0.0_wp
      if (self%is_onset) self%h_contact = step_hint
      if (step_hint > 0.0_wp) then
         self%h_before = max(self%h_before, self%h_next)
         self%h_next = min(self%h_next, step_hint*merge(self%first, 1.0_wp, self%is_onset))
      else
         self%h_next = max(self%h_before, self%h_next)
         self%h_before = 0.0_wp
      end if
   end subroutine disturb

   !> Write what the control remembers.
   subroutine save_control(self, archive)
      class(step_control_t), intent(in) :: self  !! the control
      type(archive_t), intent(inout) :: archive  !! the checkpoint

      call archive%put([self%h_next, self%h_before, self%h_event, self%h_across])
      call archive%put([self%h_contact, self%first, self%last, self%log_before])
      call archive%put(self%is_fresh)
      call archive%put(self%is_onset)
      call archive%put(self%is_parting)
   end subroutine save_control

   !> Read what the control remembers.
   subroutine load_control(self, archive)
      class(step_control_t), intent(inout) :: self  !! the control
      type(archive_t), intent(inout) :: archive     !! the checkpoint

      call archive%get(self%h_next)
      call archive%get(self%h_before)
      call archive%get(self%h_event)
      call archive%get(self%h_across)
      call archive%get(self%h_contact)
      call archive%get(self%first)
      call archive%get(self%last)
      call archive%get(self%log_before)
      call archive%get(self%is_fresh)
      call archive%get(self%is_onset)
      call archive%get(self%is_parting)
   end subroutine load_control

end module step_control
