!> Conditions on channels that end a run: `stop = gudgeon.penetration > 0.1mm`.
!>
!> After each step every channel is looked at in its middle and at its end; where the parabola through these and the value at
!> its start has a maximum beyond the limit, there too. The time is located by halving on the interpolant of the step. A channel
!> that jumps is met at the jump. Limits: a channel that passes its limit and comes back twice within one step.
module stop_condition
   use catalogue, only: catalogue_t
   use integrator, only: integrator_t
   use kinds, only: wp
   use mechanism_report, only: report_state
   use mechanism, only: mechanism_t
   use tape, only: tape_t
   use text, only: real_text
   implicit none (type, external)
   private
   public :: stop_t

   integer, parameter :: n_halving = 50  !! halvings of a step

   !> One condition.
   type :: condition_t
      character(:), allocatable :: words   !! as in the deck
      integer :: group = 0                 !! group of the catalogue
      integer :: component = 0             !! its component
      integer :: item = 0                  !! its item
      logical :: is_above = .true.         !! met above the limit, or below it
      real(wp) :: limit = 0.0_wp           !! SI [any]
   end type condition_t

   !> Conditions, any of which ends the run; without any it goes on to its end.
   type :: stop_t
      integer :: n = 0                           !! number of conditions
      type(condition_t), allocatable :: list(:)  !! (n) the conditions
      real(wp), allocatable :: before(:)         !! (n) how far beyond the limit at the start of the step [any]
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

      allocate (longer(self%n + 1))
      if (self%n > 0) longer(:self%n) = self%list
      longer(self%n + 1) = condition_t(words, group, component, item, is_above, limit)
      call move_alloc(longer, self%list)
      self%n = size(self%list)
   end subroutine stop_add

   !> Whether a condition reads the value of a quantity of an item.
   pure logical function stop_wants(self, group, item) result(wants)
      class(stop_t), intent(in) :: self       !! the conditions
      integer, intent(in) :: group            !! its group in the catalogue
      integer, intent(in) :: item             !! number of the item in the group's room

      wants = .false.
      if (self%n > 0) wants = any(self%list%group == group .and. self%list%item == item)
   end function stop_wants

   !> After a step; before the first one, a condition that is met already ends the run there.
   subroutine stop_look(self, system, method, residual, catalogue, status)
      class(stop_t), intent(inout) :: self              !! the conditions
      type(mechanism_t), intent(inout) :: system    !! the system
      class(integrator_t), intent(inout) :: method      !! the integrator, after a step or at the start
      real(wp), intent(in) :: residual                  !! of the ledger [J]
      type(catalogue_t), intent(inout) :: catalogue     !! what is reported
      integer, intent(out) :: status                    !! 0: looked at

      real(wp), dimension(self%n) :: at_end, here, middle
      real(wp), dimension(system%n) :: y, ydot
      real(wp) :: bend, high, low, place, slope
      integer :: i, k

      if (.not. allocated(self%before)) then
         call values_at(1.0_wp, here)
         self%before = here
         if (.not. any(here > 0.0_wp)) return
         self%met = maxloc(here, dim=1)
         self%t = method%t
         return
      end if
      call method%prepare_output(system, status)
      if (status == 0) call values_at(0.5_wp, middle)
      if (status == 0) call values_at(1.0_wp, at_end)
      if (status /= 0) return
      low = 0.0_wp
      high = 2.0_wp
      if (any(at_end > 0.0_wp)) high = 1.0_wp
      if (any(middle > 0.0_wp)) high = 0.5_wp
      do k = 1, self%n
         slope = 4.0_wp*middle(k) - 3.0_wp*self%before(k) - at_end(k)
         bend = 2.0_wp*(self%before(k) + at_end(k)) - 4.0_wp*middle(k)
         if (.not. bend < 0.0_wp) cycle
         place = -0.5_wp*slope/bend
         if (place <= 0.0_wp .or. place >= min(high, 1.0_wp) .or. self%before(k) - 0.25_wp*slope**2/bend <= 0.0_wp) cycle
         call values_at(place, here)
         if (status /= 0) return
         if (any(here > 0.0_wp)) high = place
      end do
      self%before = at_end
      if (high > 1.0_wp) return
      do i = 1, n_halving
         place = 0.5_wp*(low + high)
         call values_at(place, here)
         if (status /= 0) return
         if (any(here > 0.0_wp)) then
            high = place
         else
            low = place
         end if
      end do
      call values_at(high, here)
      self%met = maxloc(here, dim=1)
      self%t = method%step%t0 + high*method%step%h

   contains

      !> How far each channel is beyond its limit at a place of the step.
      subroutine values_at(place, values)
         real(wp), intent(in) :: place         !! place in the step [1]
         real(wp), intent(out) :: values(:)    !! (n) positive: met [any]

         real(wp) :: t

         t = merge(method%t, method%step%t0 + place*method%step%h, place >= 1.0_wp)
         call method%state_at(system, t, y)
         call report_state(system, t, y, ydot, residual, catalogue, status)
         values = beyond(self, catalogue)
      end subroutine values_at

   end subroutine stop_look

   !> How far each channel is beyond its limit.
   pure function beyond(self, catalogue) result(values)
      class(stop_t), intent(in) :: self             !! the conditions
      type(catalogue_t), intent(in) :: catalogue    !! values of the channels
      real(wp) :: values(self%n)          !! (n) positive: met [any]

      integer :: k

      do k = 1, self%n
         associate (condition => self%list(k))
            values(k) = catalogue%values(catalogue%place(condition%group, condition%component, condition%item)) - condition%limit
            if (.not. condition%is_above) values(k) = -values(k)
         end associate
      end do
   end function beyond

   !> Why the run ended.
   function stop_message(self) result(words)
      class(stop_t), intent(in) :: self      !! the conditions, one of them met
      character(:), allocatable :: words     !! condition and time

      words = "stopped by intent at t = "//real_text(self%t, 9)//" s: "//self%list(self%met)%words
   end function stop_message

   !> Write how far each condition is from being met.
   subroutine stop_save(self, tape)
      class(stop_t), intent(in) :: self     !! the conditions, none of them met
      type(tape_t), intent(inout) :: tape   !! what is remembered

      if (self%n > 0) call tape%put(self%before)
   end subroutine stop_save

   !> Take it back.
   subroutine stop_load(self, tape)
      class(stop_t), intent(inout) :: self  !! the conditions, looked at at the start
      type(tape_t), intent(inout) :: tape   !! what was remembered

      if (self%n > 0) call tape%get(self%before)
   end subroutine stop_load

end module stop_condition
