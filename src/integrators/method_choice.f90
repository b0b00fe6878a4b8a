!> When `auto` goes over from an explicit method to an implicit one, and back.
!>
!> What counts is the number of evaluations for a second of the motion. The explicit method is left where its stability keeps the
!> steps short (`stability_limit`). Its evaluations per second are those of the steps since then. The implicit one is on trial first:
!> after `settling` steps, in which its steps grow, those of a window are compared. It stays if it takes less than 1/`gain` of
!> them, for each of its evaluations carries more of other work. Else the explicit method goes on, and the next trial has to wait
!> until the last one has cost no more than a small part of all evaluations, each time twice as long.
!>
!> The implicit method is left where the explicit one, at the bound of its stability, would take less than `gain` times its
!> evaluations, with something to spare. That bound follows from the spectral radius of the Jacobian (`spectral_radius`), which is
!> found now and then, and after events.
!>
!> Source: L. Petzold, Automatic selection of methods for solving stiff and nonstiff systems of ordinary differential equations,
!> SIAM J. Sci. Stat. Comput. 4 (1983) 136-148, in its idea. Limits: none of the clock, so that every run chooses the same.
module method_choice
   use kinds, only: i8, wp
   use memory, only: get, put
   implicit none (type, external)
   private
   public :: method_choice_t, most_told, n_choice_number

   integer, parameter :: settling = 12           !! steps of the implicit method before its evaluations count
   integer, parameter :: window = 12             !! steps whose evaluations are compared
   integer, parameter :: most_told = 8           !! changes that are told with their time
   integer, parameter :: n_choice_number = 20 + 2*most_told  !! numbers of a checkpoint
   real(wp), parameter :: gain = 2.5_wp          !! evaluations of the explicit method over those of the implicit one, at least [1]
   real(wp), parameter :: spare = 1.5_wp         !! the same for the way back, by this less [1]
   integer(i8), parameter :: first_wait = 20     !! evaluations until the next trial, of those of one that failed
   integer(i8), parameter :: longest_wait = 2_i8**40   !! evaluations that a trial waits, at most
   integer(i8), parameter :: most_on_trial = 4000      !! evaluations of a trial, at most
   integer(i8), parameter :: at_rest = 500       !! evaluations of the explicit method after it was better again, at least
   integer(i8), parameter :: between = 20        !! evaluations from one spectral radius to the next, of those that it takes

   !> What was chosen, and what the next choice hangs on.
   !> Components: costs of both methods, and what is told of them.
   type :: method_choice_t
      logical :: is_implicit = .false.          !! whether the next step is one of the implicit method
      logical :: is_trial = .false.             !! whether that has yet to show its worth
      logical :: is_at_event = .false.          !! an event has come since the spectral radius was found
      real(wp) :: cost_explicit = 0.0_wp        !! evaluations per second of the motion, explicit [1/s]
      real(wp) :: cost_implicit = 0.0_wp        !! implicit [1/s]
      real(wp) :: h_before = 0.0_wp             !! step that the next method begins with [s]
      real(wp) :: product_back = 0.0_wp         !! step times spectral radius where the implicit method is left; 0: not known [1]
      integer, private :: n_in_window = 0       !! steps of the implicit method since the window began
      real(wp), private :: t_window = 0.0_wp    !! when it began [s]
      integer(i8), private :: n_window = 0      !! evaluations until then
      integer(i8), private :: n_begin = 0       !! evaluations when the implicit method began
      integer(i8), private :: n_wait = 0        !! evaluations before which there is no trial
      integer(i8), private :: patience = first_wait  !! how long the next one waits if it fails
      integer(i8), private :: n_radius = 10     !! evaluations that the last spectral radius took
      integer(i8), private :: n_last = 0        !! evaluations when it was found
      ! what is told
      integer(i8) :: n_change = 0               !! changes of the method, failed trials too
      integer(i8) :: n_step = 0                 !! steps of the implicit method
      integer(i8) :: n_evaluation = 0           !! evaluations of the implicit method
      real(wp) :: time = 0.0_wp                 !! time that it led through [s]
      real(wp) :: t_begin = 0.0_wp              !! when it began last [s]
      real(wp) :: t_change(most_told) = 0.0_wp  !! (change) when the first ones were [s]
      real(wp) :: product(most_told) = 0.0_wp   !! (change) step times spectral radius there [1]
   contains
      procedure :: may_leave
      procedure :: begin_implicit
      procedure :: note_step
      procedure :: give_up
      procedure :: wants_radius
      procedure :: note_radius
      procedure :: begin_explicit
      procedure :: save => save_choice
      procedure :: load => load_choice
   end type method_choice_t

contains

   !> Whether the explicit method, whose steps stability keeps short, may be left now.
   pure logical function may_leave(self, n_evaluation)
      class(method_choice_t), intent(in) :: self    !! the choice
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      may_leave = n_evaluation >= self%n_wait
   end function may_leave

   !> The implicit method begins, on trial.
   pure subroutine begin_implicit(self, cost_explicit, product, h, t, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice
      real(wp), intent(in) :: cost_explicit         !! evaluations per second of the explicit method [1/s]
      real(wp), intent(in) :: product               !! its step times the fastest rate [1]
      real(wp), intent(in) :: h                     !! its step [s]
      real(wp), intent(in) :: t                     !! time [s]
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      self%is_implicit = .true.
      self%is_trial = .true.
      self%is_at_event = .false.
      self%cost_explicit = cost_explicit
      self%h_before = h
      self%n_in_window = -settling
      self%t_begin = t
      self%n_begin = n_evaluation
      self%n_last = n_evaluation
      call note_change(self, t, product)
   end subroutine begin_implicit

   !> A step of the implicit method.
   pure subroutine note_step(self, h, t, n_new, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice; `is_implicit` is false if the trial has failed
      real(wp), intent(in) :: h                     !! its length [s]
      real(wp), intent(in) :: t                     !! time at its end [s]
      integer(i8), intent(in) :: n_new              !! evaluations that it took
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      logical :: is_over

      self%n_step = self%n_step + 1
      self%n_evaluation = self%n_evaluation + n_new
      self%time = self%time + h
      self%n_in_window = self%n_in_window + 1
      if (self%n_in_window == 0) then
         self%t_window = t
         self%n_window = n_evaluation
      end if
      is_over = self%n_in_window >= window
      if (is_over .and. t > self%t_window) then
         self%cost_implicit = real(n_evaluation - self%n_window, wp)/(t - self%t_window)
         self%n_in_window = 0
         self%t_window = t
         self%n_window = n_evaluation
      end if
      if (.not. self%is_trial) return
      if (.not. is_over .and. n_evaluation - self%n_begin > most_on_trial) then
         is_over = .true.
         self%cost_implicit = real(n_evaluation - self%n_begin, wp)/max(t - self%t_begin, tiny(1.0_wp))
      end if
      if (.not. is_over) return
      self%is_trial = .false.
      self%is_implicit = self%cost_explicit > gain*self%cost_implicit
      if (self%is_implicit) self%patience = first_wait
      if (.not. self%is_implicit) call self%give_up(n_evaluation)
   end subroutine note_step

   !> The implicit method has shown to be worth nothing here: the next trial waits.
   pure subroutine give_up(self, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      self%is_implicit = .false.
      self%is_trial = .false.
      self%n_wait = n_evaluation + self%patience*(n_evaluation - self%n_begin)
      if (self%n_wait - n_evaluation < longest_wait) self%patience = 2*self%patience
   end subroutine give_up

   !> Whether it is time to find the spectral radius.
   pure logical function wants_radius(self, n_evaluation) result(wants)
      class(method_choice_t), intent(in) :: self    !! the choice
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      wants = .not. self%is_trial .and. n_evaluation - self%n_last >= merge(between/4, between, self%is_at_event)*self%n_radius
   end function wants_radius

   !> The spectral radius was found: whether the explicit method is better again.
   pure subroutine note_radius(self, cost_explicit, n_radius, n_evaluation)
      class(method_choice_t), intent(inout) :: self !! the choice; `is_implicit` is false if it is
      real(wp), intent(in) :: cost_explicit         !! evaluations per second of the explicit method at its bound [1/s]
      integer, intent(in) :: n_radius               !! evaluations that it took
      integer(i8), intent(in) :: n_evaluation       !! evaluations so far

      self%n_radius = max(n_radius, 1)
      self%n_last = n_evaluation
      self%n_evaluation = self%n_evaluation + n_radius
      self%is_at_event = .false.
      self%cost_explicit = cost_explicit
      self%is_implicit = spare*cost_explicit > gain*self%cost_implicit
      if (.not. self%is_implicit) self%n_wait = n_evaluation + at_rest
   end subroutine note_radius

   !> The explicit method goes on.
   pure subroutine begin_explicit(self, product, t)
      class(method_choice_t), intent(inout) :: self !! the choice
      real(wp), intent(in) :: product               !! step of the implicit method times spectral radius, 0: not known [1]
      real(wp), intent(in) :: t                     !! time [s]

      self%is_implicit = .false.
      self%is_trial = .false.
      call note_change(self, t, product)
   end subroutine begin_explicit

   !> A change to be told.
   pure subroutine note_change(self, t, product)
      class(method_choice_t), intent(inout) :: self !! the choice
      real(wp), intent(in) :: t                     !! time [s]
      real(wp), intent(in) :: product               !! step times spectral radius [1]

      self%n_change = self%n_change + 1
      if (self%n_change > most_told) return
      self%t_change(self%n_change) = t
      self%product(self%n_change) = product
   end subroutine note_change

   !> Write it.
   subroutine save_choice(self, row, place)
      class(method_choice_t), intent(in) :: self  !! the choice
      real(wp), intent(inout) :: row(:)           !! (any) checkpoint [any]
      integer, intent(inout) :: place             !! last place used

      integer(i8) :: counts(10)
      integer :: k

      call put(row, place, self%is_implicit)
      call put(row, place, self%is_trial)
      call put(row, place, self%is_at_event)
      call put(row, place, [self%cost_explicit, self%cost_implicit, self%h_before, self%t_window, self%time, self%t_begin, &
                            self%product_back])
      counts = [int(self%n_in_window, i8), self%n_window, self%n_begin, self%n_wait, self%patience, self%n_radius, self%n_last, &
                self%n_change, self%n_step, self%n_evaluation]
      do k = 1, size(counts)
         call put(row, place, counts(k))
      end do
      call put(row, place, self%t_change)
      call put(row, place, self%product)
   end subroutine save_choice

   !> Read it.
   subroutine load_choice(self, row, place)
      class(method_choice_t), intent(inout) :: self  !! the choice
      real(wp), intent(in) :: row(:)                 !! (any) checkpoint [any]
      integer, intent(inout) :: place                !! last place used

      integer(i8) :: counts(10)
      integer :: k

      call get(row, place, self%is_implicit)
      call get(row, place, self%is_trial)
      call get(row, place, self%is_at_event)
      call get(row, place, self%cost_explicit)
      call get(row, place, self%cost_implicit)
      call get(row, place, self%h_before)
      call get(row, place, self%t_window)
      call get(row, place, self%time)
      call get(row, place, self%t_begin)
      call get(row, place, self%product_back)
      do k = 1, size(counts)
         call get(row, place, counts(k))
      end do
      self%n_in_window = int(counts(1))
      self%n_window = counts(2)
      self%n_begin = counts(3)
      self%n_wait = counts(4)
      self%patience = counts(5)
      self%n_radius = counts(6)
      self%n_last = counts(7)
      self%n_change = counts(8)
      self%n_step = counts(9)
      self%n_evaluation = counts(10)
      call get(row, place, self%t_change)
      call get(row, place, self%product)
   end subroutine load_choice

end module method_choice
