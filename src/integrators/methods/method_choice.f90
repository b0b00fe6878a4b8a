!> When `auto` changes from an explicit method to an implicit one, and back.
!>
!> The other method is tried first: some steps from the present state, which are then discarded (`method_trial`). They take n
!> evaluations to come to a time t_1. The present method continues from the same state. If it takes `advantage` n evaluations to
!> come to t_1, or before it comes there, the other method makes the next steps. So it does where `usual_trial` evaluations show
!> that it will take `decisive` times as many. Else the present one remains, and the next trial waits until the last one is a small
!> part of all evaluations, each time twice as long.
!>
!> The implicit method is tried where stability keeps the explicit steps short (`stability_limit`), and in any case after
!> `first_regular` evaluations of the explicit one, twice as many, four times as many, and so on. The explicit method is tried now
!> and then, and sooner after events.
!>
!> Source: L. Petzold, Automatic selection of methods for solving stiff and nonstiff systems of ordinary differential equations,
!> SIAM J. Sci. Stat. Comput. 4 (1983) 136-148, in its idea. Limits: counts decide, never the clock, so that every run chooses
!> the same. Evaluations for output do not count.
module method_choice
   use kinds, only: i8, wp
   use archive, only: archive_t
   use method_trial, only: trial_t
   implicit none (type, external)
   private
   public :: method_choice_t, most_changes

   integer, parameter :: most_changes = 8        !! changes that are reported with their time
   real(wp), parameter :: advantage(2) = [2.0_wp, 1.0_wp]  !! (to implicit, to explicit) evaluations of the present method over
                                                           !! those of the other one, from which on it is left [1]
   integer(i8), parameter :: first_regular = 6000_i8       !! evaluations after which the implicit method is tried in any case
   integer(i8), parameter :: first_wait = 20_i8  !! evaluations until the next trial, of those of the last one
   integer(i8), parameter :: usual_trial = 100_i8          !! evaluations of a usual trial
   real(wp), parameter :: decisive = 10.0_wp     !! expected evaluations over those that end a comparison, which end it early [1]
   integer(i8), parameter :: longest_wait(2) = [2_i8**40, 80_i8]  !! (of the implicit, of the explicit method) the same, at most

   !> The choice, and what the next one hangs on.
   !> Components: the comparison that is continuing, and what is reported.
   type :: method_choice_t
      logical :: is_implicit = .false.          !! whether the next step is one of the implicit method
      logical :: is_at_event = .false.          !! an event has come since the last trial
      logical :: is_comparing = .false.         !! whether the present method is compared with the last trial
      type(trial_t) :: trial                    !! outcome of that
      integer(i8), private :: n_begin = 0       !! evaluations when the comparison started
      integer(i8), private :: n_trial = 0       !! evaluations when the last trial was over
      integer(i8), private :: n_wait = 0        !! evaluations from there to the next one
      integer(i8), private :: n_regular = first_regular  !! evaluations after which the implicit method is tried in any case
      integer(i8), private :: interval = first_regular   !! evaluations between two such trials
      integer(i8), private :: patience = first_wait  !! how long the next trial waits, of the evaluations of this one
      ! what is reported
      integer(i8) :: n_tried = 0                !! evaluations of all trials
      integer(i8) :: n_change = 0               !! changes of the method
      integer(i8) :: n_step = 0                 !! steps of the implicit method
      real(wp) :: time = 0.0_wp                 !! time that they lead through [s]
      real(wp) :: product_now = 0.0_wp          !! step times spectral radius of the explicit method when the trial started [1]
      real(wp) :: t_change(most_changes) = 0.0_wp  !! (change) time [s]
      real(wp) :: product(most_changes) = 0.0_wp   !! (change) step times spectral radius, 0: it is not that [1]
   contains
      procedure :: wants_trial
      procedure :: note_trial
      procedure :: compare
      procedure :: note_step
      procedure :: give_up
      procedure :: save => save_choice
      procedure :: load => load_choice
   end type method_choice_t

contains

   !> Whether it is time to try the other method.
   pure logical function wants_trial(self, n_evaluation, is_stiff)
      class(method_choice_t), intent(in) :: self    !! the choice
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far
      logical, intent(in) :: is_stiff               !! whether stability keeps explicit steps short

      integer(i8) :: n_wait

      n_wait = merge(self%n_wait/4, self%n_wait, self%is_implicit .and. self%is_at_event)
      wants_trial = .not. self%is_comparing .and. n_evaluation >= self%n_trial + n_wait .and. (self%is_implicit .or. is_stiff)
      wants_trial = wants_trial .or. (.not. (self%is_comparing .or. self%is_implicit) .and. n_evaluation >= self%n_regular)
   end function wants_trial

   !> A trial of the other method is over: the comparison starts.
   pure subroutine note_trial(self, trial, n_evaluation, product)
      class(method_choice_t), intent(inout) :: self !! the choice
      type(trial_t), intent(in) :: trial            !! outcome
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far, those of the trial too
      real(wp), intent(in) :: product               !! step of the explicit method times spectral radius, 0: not large [1]

      self%trial = trial
      self%n_tried = self%n_tried + trial%n_evaluation
      self%product_now = product
      self%n_begin = n_evaluation
      self%n_trial = n_evaluation
      self%is_comparing = .true.
      self%is_at_event = .false.
      if (.not. trial%t_end > trial%t_begin) call lose(self)
   end subroutine note_trial

   !> The present method has made a step: whether the comparison is over, and the other method better.
   pure subroutine compare(self, t, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice; `is_implicit` changes if it is
      real(wp), intent(in) :: t                     !! time [s]
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      real(wp) :: expected, n_most, n_used

      if (.not. self%is_comparing) return
      associate (trial => self%trial)
         n_used = real(n_evaluation - self%n_begin, wp)
         expected = n_used*(trial%t_end - trial%t_begin)/max(t - trial%t_begin, tiny(1.0_wp))
         if (t > trial%t_end) n_used = expected
         n_most = advantage(merge(2, 1, self%is_implicit))*real(trial%n_evaluation, wp)
      end associate
      if (n_used >= n_most .or. (n_used >= usual_trial .and. expected >= decisive*n_most)) then
         call change(self, t, n_evaluation)
      else if (t >= self%trial%t_end) then
         call lose(self)
      end if
   end subroutine compare

   !> The present method remains.
   pure subroutine lose(self)
      class(method_choice_t), intent(inout) :: self !! the choice

      self%is_comparing = .false.
      self%n_wait = self%patience*self%trial%n_evaluation
      if (.not. self%is_implicit) self%interval = 2*self%interval
      self%n_regular = self%n_trial + self%interval
      self%patience = min(2*self%patience, longest_wait(merge(2, 1, self%is_implicit)))
   end subroutine lose

   !> The other method makes the next step.
   pure subroutine change(self, t, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice
      real(wp), intent(in) :: t                     !! time [s]
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      self%is_implicit = .not. self%is_implicit
      self%is_comparing = .false.
      self%n_trial = n_evaluation
      self%n_wait = first_wait*min(self%trial%n_evaluation, usual_trial)
      self%patience = first_wait
      self%interval = first_regular
      self%n_regular = n_evaluation + self%interval
      self%n_change = self%n_change + 1
      if (self%n_change > most_changes) return
      self%t_change(self%n_change) = t
      if (self%is_implicit) self%product(self%n_change) = self%product_now
   end subroutine change

   !> A step of the implicit method.
   pure subroutine note_step(self, h)
      class(method_choice_t), intent(inout) :: self !! the choice
      real(wp), intent(in) :: h                     !! its length [s]

      self%n_step = self%n_step + 1
      self%time = self%time + h
   end subroutine note_step

   !> The implicit method has failed: the explicit one continues.
   pure subroutine give_up(self, t, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice
      real(wp), intent(in) :: t                     !! time [s]
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      call change(self, t, n_evaluation)
      self%n_wait = first_wait*max(self%trial%n_evaluation, first_regular)
      self%interval = self%n_wait
      self%n_regular = n_evaluation + self%interval
   end subroutine give_up

   !> Write it.
   subroutine save_choice(self, archive)
      class(method_choice_t), intent(in) :: self  !! the choice
      type(archive_t), intent(inout) :: archive   !! the checkpoint

      integer(i8) :: counts(10)
      integer :: k

      call archive%put(self%is_implicit)
      call archive%put(self%is_at_event)
      call archive%put(self%is_comparing)
      call archive%put([self%trial%t_begin, self%trial%t_end, self%trial%h, self%time, self%product_now])
      counts = [self%trial%n_evaluation, self%n_begin, self%n_trial, self%n_wait, self%n_regular, self%interval, self%patience, &
                self%n_tried, self%n_change, self%n_step]
      do k = 1, size(counts)
         call archive%put(counts(k))
      end do
      call archive%put(self%t_change)
      call archive%put(self%product)
   end subroutine save_choice

   !> Read it.
   subroutine load_choice(self, archive)
      class(method_choice_t), intent(inout) :: self  !! the choice
      type(archive_t), intent(inout) :: archive      !! the checkpoint

      call archive%get(self%is_implicit)
      call archive%get(self%is_at_event)
      call archive%get(self%is_comparing)
      call archive%get(self%trial%t_begin)
      call archive%get(self%trial%t_end)
      call archive%get(self%trial%h)
      call archive%get(self%time)
      call archive%get(self%product_now)
      call archive%get(self%trial%n_evaluation)
      call archive%get(self%n_begin)
      call archive%get(self%n_trial)
      call archive%get(self%n_wait)
      call archive%get(self%n_regular)
      call archive%get(self%interval)
      call archive%get(self%patience)
      call archive%get(self%n_tried)
      call archive%get(self%n_change)
      call archive%get(self%n_step)
      call archive%get(self%t_change)
      call archive%get(self%product)
   end subroutine load_choice

end module method_choice
