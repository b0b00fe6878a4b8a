!> The time that a comparison may take, by the clock on the wall, given to its parts one after the other.
module time_budget
   use kinds, only: i8, wp
   implicit none (type, external)
   private
   public :: time_budget_t

   real(wp), parameter :: for_drawing = 2.0_wp        !! kept back for files and figures [s]
   real(wp), parameter :: most_for_drawing = 0.4_wp   !! but at most this part of a small budget [1]
   real(wp), parameter :: for_ever = 1.0e9_wp         !! what is left without a budget [s]

   !> The time.
   type :: time_budget_t
      private
      real(wp) :: limit = 0.0_wp    !! for all but files and figures, 0: none [s]
      integer(i8) :: begun = 0_i8   !! count of the clock at the start
      integer(i8) :: rate = 1_i8    !! its counts per second
   contains
      procedure, public :: begin
      procedure, public :: elapsed
      procedure, public :: left
      procedure, public :: clock_left
      procedure, public :: part_after
   end type time_budget_t

contains

   !> Start to count.
   subroutine begin(self, budget)
      class(time_budget_t), intent(inout) :: self  !! the time
      real(wp), intent(in) :: budget               !! allowed, 0: no limit [s]

      self%limit = budget - min(for_drawing, most_for_drawing*budget)
      call system_clock(self%begun, self%rate)
   end subroutine begin

   !> Time since the start.
   real(wp) function elapsed(self)
      class(time_budget_t), intent(in) :: self  !! the time

      integer(i8) :: now

      call system_clock(now)
      elapsed = real(now - self%begun, wp)/real(self%rate, wp)
   end function elapsed

   !> Time left for what may continue up to a part of the budget.
   real(wp) function left(self, part)
      class(time_budget_t), intent(in) :: self  !! the time
      real(wp), intent(in) :: part              !! of the budget [1]

      left = for_ever
      if (self%limit > 0.0_wp) left = part*self%limit - self%elapsed()
   end function left

   !> The same for a run that starts now: at least a little, 0: no limit.
   real(wp) function clock_left(self, part)
      class(time_budget_t), intent(in) :: self  !! the time
      real(wp), intent(in) :: part              !! of the budget [1]

      clock_left = 0.0_wp
      if (self%limit > 0.0_wp) clock_left = max(1.0e-3_wp, self%left(part))
   end function clock_left

   !> The part of the budget that will be over when some more time is; without a limit all of it.
   real(wp) function part_after(self, time) result(part)
      class(time_budget_t), intent(in) :: self  !! the time
      real(wp), intent(in) :: time              !! from now on [s]

      part = 1.0_wp
      if (self%limit > 0.0_wp) part = (self%elapsed() + time)/self%limit
   end function part_after

end module time_budget
