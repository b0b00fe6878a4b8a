!> Conditions on channels that end a run: `stop = gudgeon.penetration > 0.1mm`.
!>
!> After each step every channel is looked at in its middle and at its end; where the parabola through these and the value at
!> its start has a maximum beyond the limit, there too. A step with output instants in it, or in which a body turns far, is
!> looked at in so many parts, so that no row of the run is beyond a limit before its end. The time is located by halving on the
!> interpolant of the step. A channel that jumps is met at the jump; what is no number meets nothing. Limits: a channel that
!> passes its limit and comes back twice between two output instants, with no body turning, within one step; bodies that turn
!> by more than 2000 rad in a step; `energy.residual` is that of the step before.
module stop_condition
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use catalogue, only: catalogue_t
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism_report, only: report_state
   use mechanism, only: mechanism_t
   use archive, only: archive_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: cut_step, stop_t

   integer, parameter :: n_halving = 50        !! halvings of a step
   real(wp), parameter :: most_turn = 0.2_wp   !! of a body between places that are looked at [rad]
   real(wp), parameter :: most_parts = 1.0e4_wp  !! of a step that are looked at for turning bodies [1]
   real(wp), parameter :: maximum = 1.0e150_wp  !! numbers beyond it have no square [any]

   !> One condition.
   type :: condition_t
      character(:), allocatable :: words   !! as in the deck
      integer :: group = 0                 !! group of the catalogue
      integer :: component = 0             !! its component
      integer :: item = 0                  !! its item
      logical :: is_above = .true.         !! met above the limit, or below it
      real(wp) :: limit = 0.0_wp           !! SI [any]
   end type condition_t

   !> Conditions, any of which ends the run; without any it continues to its end.
   type :: stop_t
      integer :: n = 0                           !! number of conditions
      type(condition_t), allocatable :: list(:)  !! (n or more) the conditions
      real(wp), allocatable :: before(:)         !! (n) how far beyond the limit at the start of the step [any]
      real(wp) :: turning = 0.0_wp               !! maximum angular speed of a body there [rad/s]
      real(wp) :: t = 0.0_wp                     !! when the run ended [s]
      integer :: met = 0                         !! the condition that ended it, 0: none
   contains
      procedure :: add => stop_add
      procedure :: wants => stop_wants
      procedure :: look => stop_look
      procedure :: message => stop_message
      procedure :: save => stop_save
      procedure :: load => stop_load
   end type stop_t

contains

   !> Append a condition.
   subroutine stop_add(self, words, group, component, item, is_above, limit)
      class(stop_t), intent(inout) :: self    !! the conditions
      character(*), intent(in) :: words       !! as in the deck
      integer, intent(in) :: group            !! group of the catalogue
      integer, intent(in) :: component        !! its component
      integer, intent(in) :: item             !! its item
      logical, intent(in) :: is_above         !! met above the limit, or below it
      real(wp), intent(in) :: limit           !! SI [any]

      type(condition_t), allocatable :: longer(:)

      if (.not. allocated(self%list)) allocate (self%list(4))
      if (self%n == size(self%list)) then
         allocate (longer(2*self%n))
         longer(:self%n) = self%list
         call move_alloc(longer, self%list)
      end if
      self%n = self%n + 1
      self%list(self%n) = condition_t(words, group, component, item, is_above, limit)
   end subroutine stop_add

   !> Whether a condition reads the value of a quantity of an item.
   pure logical function stop_wants(self, group, item) result(wants)
      class(stop_t), intent(in) :: self       !! the conditions
      integer, intent(in) :: group            !! its group in the catalogue
      integer, intent(in) :: item             !! number of the item in the group's room

      wants = .false.
      if (self%n > 0) wants = any(self%list(:self%n)%group == group .and. self%list(:self%n)%item == item)
   end function stop_wants

   !> After a step; before the first one, a condition that is met already ends the run there. If none is met the system is left
   !> at the end of the step.
   subroutine stop_look(self, system, method, residual, catalogue, rows, status)
      class(stop_t), intent(inout) :: self              !! the conditions
      type(mechanism_t), intent(inout) :: system        !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step or at the start
      real(wp), intent(in) :: residual                  !! of the ledger [J]
      type(catalogue_t), intent(inout) :: catalogue     !! what is reported
      real(wp), intent(in) :: rows(2)                   !! (2) first output instant, time between two [s]
      integer, intent(out) :: status                    !! 0: looked at

      real(wp), dimension(self%n) :: at_end, before
      real(wp) :: left, parts, right, turning

      if (.not. allocated(self%before)) then
         call values_at(1.0_wp, before, status)
         self%before = before
         self%turning = max_turning()
         if (.not. any(before > 0.0_wp)) return
         self%met = maxloc(before, dim=1)
         self%t = method%t
         return
      end if
      call method%prepare_output(system, status)
      if (status == 0) call values_at(1.0_wp, at_end, status)
      if (status /= 0) return
      turning = max(self%turning, max_turning())
      self%turning = max_turning()
      before = self%before
      left = 0.0_wp
      do while (left < 1.0_wp)
         parts = max(1.0_wp, min(turning*method%step%h/most_turn, most_parts))
         right = min(left + 1.0_wp/parts, next_row(left))
         if (right > 1.0_wp - epsilon(1.0_wp)) right = 1.0_wp
         call look_between(left, right, before, status)
         if (status /= 0 .or. self%met > 0) return
         left = right
      end do
      self%before = before
      call values_at(1.0_wp, at_end, status)

   contains

      !> Maximum angular speed of a body at the motion that is set [rad/s].
      pure real(wp) function max_turning()
         max_turning = sqrt(maxval(sum(system%linkage%motion%omega**2, dim=1)))
      end function max_turning

      !> Place of the first output instant after another place.
      pure real(wp) function next_row(place)
         real(wp), intent(in) :: place   !! place in the step [1]

         associate (after => (method%step%t0 + place*method%step%h - rows(1))/rows(2))
            next_row = rows(1) + max(0.0_wp, aint(max(after, -1.0_wp) + 1.0_wp + 1.0e-9_wp))*rows(2)
            next_row = (next_row - method%step%t0)/method%step%h
         end associate
         if (next_row <= place + 1.0e-9_wp) next_row = huge(1.0_wp)
      end function next_row

      !> Look between two places of the step.
      subroutine look_between(left, right, before, status)
         real(wp), intent(in) :: left          !! the first [1]
         real(wp), intent(in) :: right         !! the second [1]
         real(wp), intent(inout) :: before(:)  !! (n) how far each channel is beyond its limit at the first, then the second [any]
         integer, intent(out) :: status        !! 0: looked at

         real(wp), dimension(self%n) :: at_right, here, middle
         real(wp) :: bend, high, low, place, slope
         integer :: i, k

         call values_at(0.5_wp*(left + right), middle, status)
         if (status == 0) call values_at(right, at_right, status)
         if (status /= 0) return
         high = huge(1.0_wp)
         if (any(at_right > 0.0_wp)) high = right
         if (any(middle > 0.0_wp)) high = 0.5_wp*(left + right)
         do k = 1, self%n
            slope = 4.0_wp*middle(k) - 3.0_wp*before(k) - at_right(k)
            bend = 2.0_wp*(before(k) + at_right(k)) - 4.0_wp*middle(k)
            if (.not. bend < 0.0_wp) cycle
            place = left - 0.5_wp*(right - left)*slope/bend
            if (place <= left .or. place >= min(high, right) .or. before(k) - 0.25_wp*slope**2/bend <= 0.0_wp) cycle
            call values_at(place, here, status)
            if (status /= 0) return
            if (any(here > 0.0_wp)) high = place
         end do
         before = at_right
         if (high > right) return
         low = left
         do i = 1, n_halving
            place = 0.5_wp*(low + high)
            call values_at(place, here, status)
            if (status /= 0) return
            if (any(here > 0.0_wp)) then
               high = place
            else
               low = place
            end if
         end do
         call values_at(high, here, status)
         self%met = maxloc(here, dim=1)
         self%t = merge(method%t, method%step%t0 + high*method%step%h, high >= 1.0_wp)
         self%t = min(method%t, max(self%t, method%step%t0 + 1.0e-12_wp*method%step%h, nearest(method%step%t0, 1.0_wp)))
      end subroutine look_between

      !> How far each channel is beyond its limit at a place of the step.
      subroutine values_at(place, values, status)
         real(wp), intent(in) :: place         !! place in the step [1]
         real(wp), intent(out) :: values(:)    !! (n) positive: met [any]
         integer, intent(out) :: status        !! of the evaluation

         real(wp), dimension(system%n) :: y, ydot
         real(wp) :: t

         t = merge(method%t, method%step%t0 + place*method%step%h, place >= 1.0_wp)
         call method%state_at(system, t, y)
         call report_state(system, t, y, ydot, residual, catalogue, status)
         values = beyond(self, catalogue)
      end subroutine values_at

   end subroutine stop_look

   !> End the last step at a time within it, where the motion is over: by interpolation, so that nothing continues from there.
   subroutine cut_step(system, method, t, status)
      type(mechanism_t), intent(inout) :: system     !! the system; at the end of what remains afterwards
      class(integrator_t), intent(inout) :: method   !! the integrator, after a step
      real(wp), intent(in) :: t                      !! the time [s]
      integer, intent(out) :: status                 !! of the evaluation there

      real(wp) :: y(system%n)

      call method%reach(system, t, y)
      status = 0
      if (system%holds) call system%hold(t, y, status)
      if (status /= 0) return
      method%step%y1 = y
      method%step%h = t - method%step%t0
      method%step%has_inner = .false.
      method%t = t
      call system%evaluate(t, method%step%y1, method%step%f1, status)
   end subroutine cut_step

   !> How far each channel is beyond its limit.
   pure function beyond(self, catalogue) result(values)
      class(stop_t), intent(in) :: self             !! the conditions
      type(catalogue_t), intent(in) :: catalogue    !! values of the channels
      real(wp) :: values(self%n)          !! (n) positive: met [any]

      integer :: k

      do k = 1, self%n
         associate (condition => self%list(k))
            values(k) = -1.0_wp
            associate (x => catalogue%values(catalogue%place(condition%group, condition%component, condition%item)))
               if (ieee_is_nan(x)) cycle
               values(k) = min(max(x, -maximum), maximum) - condition%limit
            end associate
            if (.not. condition%is_above) values(k) = -values(k)
         end associate
      end do
   end function beyond

   !> Why the run ended.
   function stop_message(self) result(words)
      class(stop_t), intent(in) :: self      !! the conditions, one of them met
      character(:), allocatable :: words     !! condition and time

      words = "stopped as requested at t = "//real_text(self%t, 9)//" s: "//self%list(self%met)%words
   end function stop_message

   !> Write how far each condition is from being met.
   subroutine stop_save(self, archive)
      class(stop_t), intent(in) :: self     !! the conditions, none of them met
      type(archive_t), intent(inout) :: archive   !! what is remembered

      if (self%n > 0) call archive%put([self%turning, self%before])
   end subroutine stop_save

   !> Take it back.
   subroutine stop_load(self, archive)
      class(stop_t), intent(inout) :: self  !! the conditions, looked at at the start
      type(archive_t), intent(inout) :: archive   !! what was remembered

      if (self%n == 0) return
      call archive%get(self%turning)
      call archive%get(self%before)
   end subroutine stop_load

end module stop_condition
