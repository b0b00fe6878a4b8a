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
      real(wp) :: cpu = 0.0_wp      !! processor time of the program at the start [s]
   contains
      procedure, public :: begin
      procedure, public :: elapsed
      procedure, public :: left
      procedure, public :: cpu_left
      procedure, public :: part_after
   end type time_budget_t

contains

   !> Begin to count.
   subroutine begin(self, budget)
      class(time_budget_t), intent(inout) :: self  !! the time
      real(wp), intent(in) :: budget               !! allowed, 0: no limit [s]

      self%limit = budget - min(for_drawing, most_for_drawing*budget)
      call system_clock(self%begun, self%rate)
      call cpu_time(self%cpu)
   end subroutine begin

   !> Time since the start.
   real(wp) function elapsed(self)
      class(time_budget_t), intent(in) :: self  !! the time

      integer(i8) :: now

      call system_clock(now)
      elapsed = real(now - self%begun, wp)/real(self%rate, wp)
   end function elapsed

   !> Time left for what may go on up to a part of the budget.
   real(wp) function left(self, part)
      class(time_budget_t), intent(in) :: self  !! the time
      real(wp), intent(in) :: part              !! of the budget [1]

      left = for_ever
      if (self%limit > 0.0_wp) left = part*self%limit - self%elapsed()
   end function left

   !> The same as processor time, by the share of a processor that the program has had so far; at least a little, 0: no limit.
   real(wp) function cpu_left(self, part)
      class(time_budget_t), intent(in) :: self  !! the time
      real(wp), intent(in) :: part              !! of the budget [1]

      real(wp) :: now, share

      cpu_left = 0.0_wp
      if (self%limit <= 0.0_wp) return
      call cpu_time(now)
      share = min(1.0_wp, (now - self%cpu)/max(self%elapsed(), tiny(1.0_wp)))
      if (self%elapsed() < 0.1_wp) share = 1.0_wp
      cpu_left = max(1.0e-3_wp, share*self%left(part))
   end function cpu_left

   !> The part of the budget that will be over when some more time is; without a limit all of it.
   real(wp) function part_after(self, time) result(part)
      class(time_budget_t), intent(in) :: self  !! the time
      real(wp), intent(in) :: time              !! from now on [s]

      part = 1.0_wp
      if (self%limit > 0.0_wp) part = (self%elapsed() + time)/self%limit
   end function part_after

end module time_budget
